//! What the motion after the impact needs of a case, in the types of its engine.

use pim_core::{Contact, Motion, Real, VaryingLaw, Vector2, VehicleId};
use reconcile::Departure;
use trajectory::{Chassis, Region, Steer, Zone};

use crate::after::MarkedWheel;
use crate::basis::Basis;
use crate::data::{Collision, VehicleData};
use crate::text::Text;

/// The vehicles after the impact, and the ground on which they move.
#[derive(Clone, Debug)]
pub struct MotionInput<T = f64> {
    /// The ground.
    pub surface: SurfaceData<T>,
    /// Each vehicle; `None` for one that is fixed or absent, or of which the case does not tell enough to
    /// follow it.
    pub vehicles: [Option<VehicleMotion<T>>; 2],
}

/// The ground, in the axes of the engine.
#[derive(Clone, Debug)]
pub struct SurfaceData<T = f64> {
    /// (–) coefficient of friction outside of all zones.
    pub friction: T,
    /// (–) rise per horizontal length along x and along y.
    pub grade: Vector2<T>,
    /// Parts with a friction of their own; where two overlap, the later one counts.
    pub zones: Vec<ZoneData<T>>,
}

impl<T: Copy> SurfaceData<T> {
    /// The zones as the engine takes them, for the field of a [`trajectory::Ground`].
    #[must_use]
    pub fn zones(&self) -> Vec<Zone<'_, T>> {
        self.zones.iter().map(|zone| Zone { region: zone.region.region(), friction: zone.friction }).collect()
    }
}

/// A part of the ground.
#[derive(Clone, Debug)]
pub struct ZoneData<T = f64> {
    /// Its name.
    pub name: Option<Text>,
    /// (–) its coefficient of friction.
    pub friction: T,
    /// Where it lies.
    pub region: RegionData,
}

/// Where a part of the ground lies, in the axes of the engine.
#[derive(Clone, Debug)]
pub enum RegionData {
    /// All on one side of a straight line.
    HalfPlane {
        /// (m) a point of the line.
        point: Vector2<f64>,
        /// (rad) direction at right angles to the line, into the region.
        into: f64,
    },
    /// (m) the inside of a closed line through these corners.
    Polygon(Vec<Vector2<f64>>),
}

impl RegionData {
    /// As the engine takes it.
    #[must_use]
    pub fn region(&self) -> Region<'_> {
        match self {
            Self::HalfPlane { point, into } => Region::half_plane(*point, *into),
            Self::Polygon(corners) => Region::Polygon(corners),
        }
    }
}

/// Where the CG of a vehicle passed, or one of its wheels, in the axes of the engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointData<T = f64> {
    /// (m) the place.
    pub position: Vector2<T>,
    /// (rad) its heading there, where that is known, without full turns.
    pub heading: Option<T>,
    /// The wheel, if it is one that passed there.
    pub wheel: Option<MarkedWheel>,
}

/// A vehicle after the impact, in the axes of the engine.
#[derive(Clone, Debug)]
pub struct VehicleMotion<T = f64> {
    /// The body on its wheels.
    pub chassis: Chassis<T>,
    /// How its front wheels are steered.
    pub steer: SteerData<T>,
    /// (–) coefficient of friction on its path outside of all zones, where it is not that of the ground.
    pub friction: Option<T>,
    /// (m) place of the CG at the impact: as given, or from that of C. Where the case gives neither C nor any
    /// place of this vehicle, C is the origin; where it does not tell either how the CG lies to C, the CG is.
    pub position: Vector2<T>,
    /// (rad) heading at the impact.
    pub heading: T,
    /// How it left the impact, where the case tells speed and direction.
    pub velocity: Option<Departure<T>>,
    /// Where it came to rest.
    pub rest: Option<RestData<T>>,
    /// (m) places that the CG or a wheel passed, from the impact to the rest.
    pub points: Vec<PointData<T>>,
}

impl<T: Copy> VehicleMotion<T> {
    /// (–) coefficient of friction on its path, outside of all zones.
    #[must_use]
    pub fn friction_on(&self, surface: &SurfaceData<T>) -> T {
        self.friction.unwrap_or(surface.friction)
    }
}

/// How the front wheels are steered.
#[derive(Clone, Debug)]
pub enum SteerData<T = f64> {
    /// (rad) the same angle all the time.
    Held(T),
    /// Times (s) and angles (rad).
    Over(Vec<(T, T)>),
}

impl<T: Real> SteerData<T> {
    /// As the engine takes it.
    #[must_use]
    pub fn steer(&self) -> Steer<'_, T> {
        match self {
            Self::Held(angle) => Steer::Held(*angle),
            Self::Over(points) => Steer::Over(points),
        }
    }
}

/// Where a vehicle came to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestData<T = f64> {
    /// (m) place of the CG.
    pub position: Vector2<T>,
    /// How it stands there.
    pub heading: RestHeadingData<T>,
}

/// How a vehicle stands at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestHeadingData<T = f64> {
    /// (rad) its heading; any number of full turns may lie before it.
    Heading(T),
    /// (rad) by how much it turned since the impact, full turns included.
    Turned(T),
}

impl<T: Real> RestHeadingData<T> {
    /// (rad) the heading at rest of a vehicle that had the heading `at_impact` (rad); where only the heading
    /// is known, without the full turns before it.
    #[must_use]
    pub fn heading(self, at_impact: T) -> T {
        match self {
            Self::Heading(heading) => heading,
            Self::Turned(turn) => at_impact + turn,
        }
    }

    /// Whether the full turns before the rest are known.
    #[must_use]
    pub fn turns_are_known(self) -> bool {
        matches!(self, Self::Turned(_))
    }
}

/// Skid marks before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkidData<T = f64> {
    /// (m) their length.
    pub length: T,
    /// (–) coefficient of friction there.
    pub friction: T,
}

/// A collision whose speeds are sought from how the vehicles left it.
#[derive(Clone, Debug)]
pub struct TwoSpeedInput<T = f64> {
    /// Which speeds.
    pub sought: Sought<T>,
    /// How much of the contact is known.
    pub geometry: Geometry,
    /// The contact. Of point masses it has masses and headings alone.
    pub contact: Contact<T>,
    /// The impact law; `None` where the contact is not known, or the case gives none.
    pub law: Option<VaryingLaw<T>>,
    /// (rad/s) yaw rates before the impact.
    pub yaw_rates: [T; 2],
    /// The data of each vehicle.
    pub vehicles: [VehicleData<T>; 2],
    /// The velocity after the impact of each vehicle of which the case gives it. Of every other one that
    /// moves, `motion` has the rest, or it is locked to one of these.
    pub departures: [Option<Departure<T>>; 2],
    /// Whether the vehicles left the impact locked together.
    pub locked_together: bool,
    /// The motion after the impact, of the vehicles that can be followed; `None` where no rest is given and
    /// the ground is not known.
    pub motion: Option<MotionInput<T>>,
    /// The energy basis.
    pub basis: Basis<T>,
    /// Whether the crush energy of every vehicle that moves is known. It is where both speeds are sought and
    /// the approaches are collinear.
    pub has_crush: bool,
}

impl<T: Real> TwoSpeedInput<T> {
    /// The collision, the vehicles at rest in it but for their yaw rates; `None` where the contact or the law
    /// is not known.
    #[must_use]
    pub fn collision(&self) -> Option<Collision<T>> {
        if self.geometry != Geometry::Given {
            return None;
        }
        Some(Collision {
            contact: self.contact,
            law: self.law.clone()?,
            motions: self.yaw_rates.map(|yaw_rate| Motion::rest().with_yaw_rate(yaw_rate)),
            vehicles: self.vehicles.clone(),
        })
    }
}

/// Which speeds are sought from the momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sought<T = f64> {
    /// Both.
    Both,
    /// That of one vehicle.
    Beside {
        /// Which.
        vehicle: VehicleId,
        /// (m/s) the speed of the other along its heading.
        known: T,
    },
    /// That of one vehicle, which hit a fixed object.
    IntoWall {
        /// Which.
        vehicle: VehicleId,
    },
}

/// How much is known of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// Contact points, yaw inertias and crush plane.
    Given,
    /// The crush plane at a fixed object alone: the impulse is taken to act towards the CG.
    Plane,
    /// Masses and headings alone.
    PointMasses,
}
