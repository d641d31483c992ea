//! A crash that can be estimated and judged, whatever a vehicle met.

use evidence::{Collision, Fitted};
use pim_core::VehicleId;
use uncertainty::InvalidDistribution;

use crate::figure::Figure;
use crate::pair::{PairVehicle, Plane, Truth};

/// The vehicles whose crush an estimate uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KnownCrush {
    /// That of both vehicles.
    Both,
    /// That of the judged vehicle.
    Judged,
    /// That of the other vehicle.
    Other,
}

/// The surfaces that met, or what was struck.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PairKind {
    /// Two fronts.
    FrontFront,
    /// A front and a side.
    FrontSide,
    /// A front and a rear.
    FrontRear,
    /// Anything else of two vehicles.
    Other,
    /// A tree, a pole or a post.
    TreeOrPole,
    /// A barrier, a wall, a building or a bridge.
    BarrierOrWall,
    /// Any other object.
    OtherObject,
}

impl PairKind {
    /// All of them, in the order of the tables.
    pub const ALL: [Self; 7] = [
        Self::FrontFront,
        Self::FrontSide,
        Self::FrontRear,
        Self::Other,
        Self::TreeOrPole,
        Self::BarrierOrWall,
        Self::OtherObject,
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FrontFront => "front-front",
            Self::FrontSide => "front-side",
            Self::FrontRear => "front-rear",
            Self::Other => "other",
            Self::TreeOrPole => "tree-pole",
            Self::BarrierOrWall => "barrier-wall",
            Self::OtherObject => "other-object",
        }
    }

    /// The kind by the planes of the damage of two vehicles.
    pub(crate) fn of([one, two]: [Plane; 2]) -> Self {
        match (one, two) {
            (Plane::Front, Plane::Front) => Self::FrontFront,
            (Plane::Front, side) | (side, Plane::Front) if side.is_side() => Self::FrontSide,
            (Plane::Front, Plane::Rear) | (Plane::Rear, Plane::Front) => Self::FrontRear,
            _ => Self::Other,
        }
    }
}

/// A crash whose vehicles can be estimated from all evidence except their recorders, and judged by these.
pub trait Crash: Sync {
    /// The figures that are fitted to such crashes.
    const FIGURES: &'static [Figure];
    /// Whether a vehicle met a fixed object.
    const IS_WITH_OBJECT: bool;

    /// Number of the crash.
    fn case(&self) -> &str;

    /// A vehicle; `None` for a fixed object.
    fn vehicle(&self, id: VehicleId) -> Option<&PairVehicle>;

    /// The surfaces that met, or what was struck.
    fn kind(&self) -> PairKind;

    /// Whether both recorders can belong to one collision: m_1 ΔV_1 = m_2 ΔV_2 within a factor of 2.7. `None`
    /// if not both can be judged.
    fn is_one_event(&self) -> Option<bool>;

    /// The collision with unknown speeds, by the crush of the one vehicle `crushed`, or of all; only the
    /// recorders of the vehicles `given` are evidence.
    ///
    /// # Errors
    /// If a figure of `fitted` or of the crash is not a valid distribution.
    fn known(
        &self,
        crushed: Option<VehicleId>,
        fitted: &Fitted,
        given: &[VehicleId],
    ) -> Result<Collision, InvalidDistribution>;

    /// The vehicles whose recorders can be judged, with the stored values.
    fn truths(&self) -> Vec<(VehicleId, Truth)> {
        let truth = |id: VehicleId| Some((id, self.vehicle(id)?.truth()?));
        VehicleId::ALL.into_iter().filter_map(truth).collect()
    }
}
