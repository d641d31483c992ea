//! The data that each purpose takes from a case, in the types of the engines.

use crash3::{DamagedFace, ObliqueCorrection, Profile, Side, SideStiffness, Stiffness};
use pim_core::VehicleId;
use pim_core::{Contact, Motion, VaryingLaw};

use crate::basis::Basis;
use crate::crush::Fit;
use crate::dimensions::Dimensions;
use crate::estimate::{TypicalStiffness, YawSource};
use crate::vehicle::VehicleKind;

/// Two vehicles that collide, as the mechanics need them.
#[derive(Clone, Debug)]
pub struct CollisionData<T = f64> {
    /// The geometry.
    pub contact: Contact<T>,
    /// The impact law.
    pub law: VaryingLaw<T>,
    /// Motions before impact. A vehicle whose speed is sought is at rest here except for its yaw rate.
    pub motions: [Motion<T>; 2],
    /// The data of each vehicle.
    pub vehicles: [VehicleData<T>; 2],
}

/// The data of one vehicle, as far as the case gives them.
#[derive(Clone, Debug)]
pub struct VehicleData<T = f64> {
    /// The kind of vehicle, if the case gives it.
    pub kind: Option<VehicleKind>,
    /// Mass and yaw inertia, or `None` for a fixed object.
    pub inertia: Option<InertiaData<T>>,
    /// (m) contact point C forward and left of the CG.
    pub contact: Option<[T; 2]>,
    /// Whether that point was placed at the centroid of the damage, because the case gives none.
    pub contact_is_placed: bool,
    /// The body seen from above.
    pub dimensions: Option<Dimensions<T>>,
    /// The damage, where its crush was measured or is to be inferred.
    pub damage: Option<DamageData<T>>,
    /// (J) energy that it absorbed where it bent, cracked or leaned; only for a fixed object.
    pub deformation_energy: Option<T>,
    /// The damage, where only its energy is known.
    pub energy: Option<EnergyData<T>>,
    /// The force that caused either of them.
    pub force: ForceData<T>,
}

/// What the case gives of the force that caused a damage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceData<T = f64> {
    /// (rad) PDOF: as given, or opposite to the PDOF given for the other vehicle.
    pub pdof: Option<T>,
    /// Whether the PDOF was derived from that of the other vehicle, by Newton's third law.
    pub pdof_follows: bool,
    /// Whether it is an hour of the clock, the given one or that of the other vehicle: each is 30° wide.
    pub pdof_is_hour: bool,
    /// (m) h as given.
    pub moment_arm: Option<T>,
}

impl<T> ForceData<T> {
    /// Nothing is known of it.
    pub const UNKNOWN: Self = Self { pdof: None, pdof_follows: false, pdof_is_hour: false, moment_arm: None };
}

/// A damage known only by its energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyData<T = f64> {
    /// (m/s) energy equivalent speed; `None` without damage.
    pub ees: Option<T>,
    /// The damaged side, if the case gives it.
    pub side: Option<Side>,
}

/// Mass and yaw inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaData<T = f64> {
    /// (kg) mass.
    pub mass: T,
    /// (kg·m²) yaw inertia; only an analysis of the damage of a single vehicle does not need it.
    pub yaw_inertia: Option<T>,
    /// The source of the yaw inertia.
    pub yaw_source: YawSource,
}

/// The damage of a side.
#[derive(Clone, Debug)]
pub struct DamageData<T = f64> {
    /// The damaged side.
    pub side: Side,
    /// The evidence of the crush.
    pub evidence: CrushEvidence<T>,
    /// The source of its stiffness.
    pub stiffness_source: StiffnessSource,
    /// The damaged face and the place of the damage on it, where the dimensions of the vehicle are known.
    pub face: Option<DamagedFace<T>>,
    /// (m) offset of the middle of the damage: to the left of the axis on front and rear, forward of the CG
    /// on the sides. `None` if the case does not give it; it is then taken as zero.
    pub offset: Option<T>,
    /// How oblique forces are corrected.
    pub correction: ObliqueCorrection<T>,
    /// (rad) α as given.
    pub oblique_angle: Option<T>,
}

/// How a crush is known.
#[derive(Clone, Debug)]
pub enum CrushEvidence<T = f64> {
    /// It was measured.
    Measured {
        /// Depths along the side.
        profile: Profile<T>,
        /// The stiffness of the side.
        structure: SideStiffness<T>,
    },
    /// It is to be inferred from the force on the other vehicle.
    ForceBalance {
        /// The stiffness of the side.
        stiffness: Stiffness<T>,
        /// The width of the damage.
        width: InferredWidth<T>,
    },
}

/// The width of a damage that was not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InferredWidth<T = f64> {
    /// (m) width known from another source, for example from photographs.
    Given(T),
    /// Not known: only the vehicle's dimensions bound it.
    Bounded {
        /// (m) length of the side.
        widest: T,
        /// (m) from the face to the CG.
        deepest: T,
    },
}

/// The source of a stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessSource {
    /// A and B as given.
    Coefficients,
    /// d_0 and d_1 as given.
    Roots,
    /// That of many cars.
    Typical(TypicalStiffness),
    /// Fitted to a barrier test.
    Test(Fit),
    /// Coefficients as given, zone by zone.
    Zones,
}

/// The input of a reconstruction.
#[derive(Clone, Debug)]
pub struct ReconstructionInput<T = f64> {
    /// The collision, in which one speed is unknown.
    pub collision: CollisionData<T>,
    /// The unknown speed.
    pub unknown: VehicleId,
    /// The energy basis.
    pub basis: Basis<T>,
}

/// The input of an impact calculation.
#[derive(Clone, Debug)]
pub struct ImpactInput<T = f64> {
    /// The collision, in which both speeds are known.
    pub collision: CollisionData<T>,
    /// The energy basis, for the CRASH3 result.
    pub basis: Basis<T>,
}

/// The input of a CRASH3 analysis from the damage alone.
#[derive(Clone, Debug)]
pub struct CrushOnly<T = f64> {
    /// Both vehicles. The damage of each one that can move has a PDOF, or both an oblique angle and a moment
    /// arm, unless it is the only vehicle of the case.
    pub vehicles: [VehicleData<T>; 2],
    /// The energy basis.
    pub basis: Basis<T>,
    /// e, if it does not depend on the closing speed; 0 for Woolley's law.
    pub restitution: Option<T>,
}
