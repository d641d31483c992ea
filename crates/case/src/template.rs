//! Templates: case files to start from.

use inputs::UnitSystem;

/// A commented, runnable case of one kind. The numbers are invented.
///
/// ```
/// use case::{CaseFile, Template, UnitSystem};
///
/// let file = CaseFile::parse("case.toml", Template::Barrier.text(UnitSystem::Us))?;
/// assert!(file.case.vehicles[1].fixed);
/// # Ok::<(), case::Diagnostics>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Template {
    /// The front of one vehicle against the side of the other, at an intersection.
    FrontSide,
    /// Two fronts, offset.
    HeadOn,
    /// A front against the rear of a stationary vehicle.
    RearEnd,
    /// A front against the rear of a waiting vehicle, both rest positions known and neither speed.
    RearEndRest,
    /// Two vehicles that cross, both rest positions known and neither speed.
    Intersection,
    /// A vehicle against a fixed object.
    Barrier,
    /// Two vehicles that scrape along each other.
    Sideswipe,
    /// Two cars with known energy equivalent speeds.
    Ees,
    /// A car against a heavy truck with negligible damage.
    HeavyTruck,
    /// The damage of one vehicle alone.
    OneVehicle,
}

impl Template {
    /// All templates.
    pub const ALL: [Self; 10] = [
        Self::FrontSide,
        Self::HeadOn,
        Self::RearEnd,
        Self::RearEndRest,
        Self::Intersection,
        Self::Barrier,
        Self::Sideswipe,
        Self::Ees,
        Self::HeavyTruck,
        Self::OneVehicle,
    ];

    /// Its name in one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FrontSide => "front-side",
            Self::HeadOn => "head-on",
            Self::RearEnd => "rear-end",
            Self::RearEndRest => "rear-end-rest",
            Self::Intersection => "intersection",
            Self::Barrier => "barrier",
            Self::Sideswipe => "sideswipe",
            Self::Ees => "ees",
            Self::HeavyTruck => "heavy-truck",
            Self::OneVehicle => "one-vehicle",
        }
    }

    /// The case file in the given unit system. Its numbers are round in those units, so the two files
    /// describe two similar collisions, not the same one.
    #[must_use]
    pub fn text(self, units: UnitSystem) -> &'static str {
        match (self, units) {
            (Self::FrontSide, UnitSystem::Si) => include_str!("../templates/si/front-side.toml"),
            (Self::HeadOn, UnitSystem::Si) => include_str!("../templates/si/head-on.toml"),
            (Self::RearEnd, UnitSystem::Si) => include_str!("../templates/si/rear-end.toml"),
            (Self::RearEndRest, UnitSystem::Si) => {
                include_str!("../templates/si/rear-end-rest.toml")
            }
            (Self::Intersection, UnitSystem::Si) => include_str!("../templates/si/intersection.toml"),
            (Self::Barrier, UnitSystem::Si) => include_str!("../templates/si/barrier.toml"),
            (Self::Sideswipe, UnitSystem::Si) => include_str!("../templates/si/sideswipe.toml"),
            (Self::Ees, UnitSystem::Si) => include_str!("../templates/si/ees.toml"),
            (Self::HeavyTruck, UnitSystem::Si) => include_str!("../templates/si/heavy-truck.toml"),
            (Self::OneVehicle, UnitSystem::Si) => include_str!("../templates/si/one-vehicle.toml"),
            (Self::FrontSide, UnitSystem::Us) => include_str!("../templates/us/front-side.toml"),
            (Self::HeadOn, UnitSystem::Us) => include_str!("../templates/us/head-on.toml"),
            (Self::RearEnd, UnitSystem::Us) => include_str!("../templates/us/rear-end.toml"),
            (Self::RearEndRest, UnitSystem::Us) => {
                include_str!("../templates/us/rear-end-rest.toml")
            }
            (Self::Intersection, UnitSystem::Us) => include_str!("../templates/us/intersection.toml"),
            (Self::Barrier, UnitSystem::Us) => include_str!("../templates/us/barrier.toml"),
            (Self::Sideswipe, UnitSystem::Us) => include_str!("../templates/us/sideswipe.toml"),
            (Self::Ees, UnitSystem::Us) => include_str!("../templates/us/ees.toml"),
            (Self::HeavyTruck, UnitSystem::Us) => include_str!("../templates/us/heavy-truck.toml"),
            (Self::OneVehicle, UnitSystem::Us) => include_str!("../templates/us/one-vehicle.toml"),
        }
    }
}
