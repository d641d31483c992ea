//! Warnings that a careful reconstructionist would raise.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use crash3::{EnergyBasis, Side, principal_angle};
use evidence::{EnergyMethod, FITTED, FLEET_YEARS};
use inputs::{
    After, Basis, Case, ContactSpread, Dimension, FaceAxis, GivenVehicle, Input, Origin, Quantity,
    StiffnessForm, StiffnessSource, TypicalStiffness, Unit, Variable, VehicleKind, Velocity, YawSource,
};
use pim_core::{Contact, Motion, Outcome, Real, Regime, Switch, Tangential, Vector2, VehicleId};
use real::elementary::sin_cos;

use crate::check::{Check, CheckedQuantity};
use crate::codes::codes;
use crate::damage::Crash3;
use crate::errors::{damaged_sides, method_of, misfit};
use crate::evident::Evident;
use crate::exchange::Exchange;
use crate::found::Found;
use crate::given::GivenSpeed;
use crate::impact::Impact;
use crate::recorded::{UncertainRecord, uncertain_record};
use crate::speeds::BothFound;
use crate::thresholds::{DELTA_V_DIFFERENCE, FAST_CLOSING, FORCE_RATIO, HIGH_RESTITUTION, PDOF_DIFFERENCE};
use crate::travel::{Pass, Travel};
use crate::usual::Usual;
use crate::vehicle::{Damage, Vehicle};

/// (m) how far the positions of C may lie apart: a CG is surveyed to some decimetres.
const CONTACT_APART: f64 = 0.3;
/// (m) how far the contact point may be outside the outline: the roundness of a bumper.
const OUTLINE_TOLERANCE: f64 = 0.05;
/// (m) accuracy of the end of a damage, which is a judgement, because the damage fades out into induced
/// damage.
const END_TOLERANCE: f64 = 0.1;
/// (m) how far the contact point may be behind the deepest crush of front or rear: the points of the staged
/// collisions lie up to 0.51 m behind it (RICSAC 10).
const END_DEPTH_TOLERANCE: f64 = 0.6;
/// (m) the same for a side, on which none of those points lies behind it: during the impact the crush was
/// deeper than the residual one, and the position of C is a judgement.
const SIDE_DEPTH_TOLERANCE: f64 = 0.3;
/// Friction dissipates energy. Ratios that were fitted to the staged collisions RICSAC 3 and 5 add 1.5 and
/// 1.7 % of the energy loss, within the accuracy of measurement; this share changes the speed by 1 %.
const DRIVING_SHARE: f64 = 0.02;
/// As a share of the initial energy: the rounding error of a work that is zero.
const ROUNDING: f64 = 1e-9;
/// (m/s) the rounding error of the speed of a vehicle that stood still.
const ROUNDED_SPEED: f64 = 1e-6;
/// As a share of the closing speed: the rounding error of sliding that is zero.
const NO_SLIDING: f64 = 1e-9;
/// A border within this share of the friction limit, or of the sliding before impact, is near: neither is
/// known better than this.
const NEAR: f64 = 0.01;
/// As a share of the change of motion in the impact. Within [`NEAR`], an answer without a jump changes by
/// about as much, so a tenth of that is negligible.
const JUMP: f64 = 0.1 * NEAR;
/// The size of μ above which the surfaces pull harder than they push. Friction between vehicles is mostly
/// about half of that.
const LARGE_RATIO: f64 = 1.0;
/// (m/s) 100 km/h, 62 mph: cars are driven into barriers with up to 64 km/h, and slowly with 8.
const USUAL_TEST_SPEED: [f64; 2] = [2.0, 100.0 / 3.6];
/// Between vehicles 0.3 to 1.0 is observed, and less if they are wet or the surfaces are smooth.
const USUAL_FRICTION: [f64; 2] = [0.1, 1.0];
/// Between tyre and ground: smooth ice above 30 mph, and new dry asphalt or concrete below (EDCRASH manual).
const USUAL_GROUND_FRICTION: [f64; 2] = [0.07, 1.2];
/// A full turn, with a tolerance for rounding.
const FULL_TURN: f64 = TAU * (1.0 + 1e-9);

/// A problem that does not stop the analysis, but that the signer of the report should know. Values are in SI
/// units.
///
/// Matched without a catch-all arm wherever a warning is worded, so that a new one does not compile until it
/// has its words; adding one is a breaking change.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// The crush plane does not separate the two CGs.
    PlaneDoesNotSeparate,
    /// The contact point lies outside the vehicle's outline.
    ContactOutside {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) by how much.
        distance: f64,
    },
    /// The restitution is greater than usual at this closing speed.
    HighRestitution {
        /// e.
        restitution: f64,
        /// (m/s) closing speed at C.
        closing_speed: f64,
    },
    /// The peak forces of the two vehicles differ by more than a factor of 2.
    ForceBalance {
        /// (N) peak forces.
        forces: [f64; 2],
    },
    /// The PDOF that the file gives is not that of the impulse.
    PdofDiffers {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) as given.
        given: f64,
        /// (rad) as computed.
        computed: f64,
        /// (rad) how far apart they may be.
        limit: f64,
    },
    /// An implication of momentum differs from other evidence.
    MomentumDiffers {
        /// The checks that fail.
        checks: Vec<Check>,
    },
    /// The case says that the vehicles left as one body, but their velocities are not those of one.
    NotLocked {
        /// (m/s) the speed at which their CGs part; negative if they close.
        parting: f64,
    },
    /// Evidence that the answer does not use contradicts it.
    EvidenceDiffers {
        /// The vehicle.
        vehicle: VehicleId,
        /// The evidence.
        evidence: Evident,
        /// (SI) as the case gives it.
        given: f64,
        /// (SI) by the answer.
        found: f64,
    },
    /// A record that lacks the end of the impact already has more ΔV than the answer.
    BelowRecord {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) ΔV in the record.
        recorded: f64,
        /// (m/s) ΔV of the answer in the same direction, or the upper end of its 95 % interval.
        found: f64,
    },
    /// The outlines of the vehicles at rest overlap by more than their crush explains.
    RestsOverlap {
        /// (m) how far one lies inside the other.
        depth: f64,
    },
    /// A skid begins faster than any speed that the recorder of the vehicle stored before the impact.
    SkidAboveRecord {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) the greatest stored speed.
        recorded: f64,
        /// (m/s) lower end of the 95 % interval of the speed where the skid begins.
        found: f64,
    },
    /// The answer takes crush energies by the stiffness of the fleet as they are, but on average they are too
    /// small.
    FleetEnergy {
        /// The vehicles with that stiffness.
        of: [bool; 2],
        /// (–) their average share of the energy that recorders show.
        share: f64,
        /// Whether the case has one vehicle, for which there is no estimate.
        is_alone: bool,
    },
    /// The same with categories of stiffness.
    CategoryEnergy {
        /// The vehicles with a category.
        of: [bool; 2],
        /// (–) their average share of the energy that recorders show.
        share: f64,
        /// Whether the case has one vehicle, for which there is no estimate.
        is_alone: bool,
        /// Whether a car of unknown model year is taken for one of the field.
        is_year_assumed: bool,
    },
    /// The skid marks of a vehicle point elsewhere than it travelled.
    SkidDirection {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) direction from the place where the marks begin to that of the impact.
        skid: f64,
        /// (rad) direction in which the vehicle travelled.
        course: f64,
    },
    /// The vehicles left as one wreck, but this one is followed to its rest position as if nothing were
    /// attached to it.
    WreckAlone {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// Skid marks before the impact are taken on level ground, although the ground has a grade.
    SkidOnGrade {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// Several motions after the impact lead to the rest position of a vehicle.
    SeveralStarts {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s, rad/s) speed and yaw rate of the one that is used.
        used: [f64; 2],
        /// (m/s, rad/s) those of the others.
        others: Vec<[f64; 2]>,
    },
    /// The path of a vehicle to rest misses a measured point.
    PointMissed {
        /// The vehicle.
        vehicle: VehicleId,
        /// The number of the point, counted from 1.
        point: usize,
        /// How the path passes it.
        pass: Pass,
    },
    /// The path of a vehicle misses its measured rest position.
    RestMissed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) distance from it.
        miss: f64,
        /// (–) the same as a share of the path.
        share: f64,
    },
    /// α was limited to 45°.
    AngleCapped {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) α.
        oblique_angle: f64,
    },
    /// The force does not push on the damaged side.
    SideNotPushed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) α.
        oblique_angle: f64,
    },
    /// CRASH3's ΔV is not that of the impact.
    DeltaVDiffers {
        /// (m/s) ΔV of the impact; `None` for a fixed object.
        impact: [Option<f64>; 2],
        /// (m/s) CRASH3's, corrected for oblique forces if possible, and with the restitution of the impact
        /// if CRASH3 can use it.
        crash3: [Option<f64>; 2],
        /// Whether it takes restitution into account: not with e = 1.
        restitution: bool,
    },
    /// More than one speed gives the crush energy.
    SeveralSpeeds {
        /// (m/s) the answer.
        answer: f64,
        /// (m/s) the others, from the slowest approach to the fastest.
        others: Vec<f64>,
    },
    /// The speed found or given is negative.
    MovesBackward {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) the speed.
        speed: f64,
        /// Whether it was found.
        found: bool,
    },
    /// CRASH3's size class supplies values that are unknown for the vehicle.
    ClassValues {
        /// The vehicle.
        vehicle: VehicleId,
        /// 1 to 6.
        class: u8,
        /// (kg·m²) the yaw inertia, if it was taken from the class.
        yaw_inertia: Option<f64>,
        /// (m) length, width and distance from the CG to the front, if they were taken from the class.
        outline: Option<[f64; 3]>,
    },
    /// The yaw inertia was estimated from wheelbase and length.
    BurgInertia {
        /// The vehicle.
        vehicle: VehicleId,
        /// (kg·m²) the estimate.
        yaw_inertia: f64,
    },
    /// The crush of the vehicle was not measured.
    InferredEnergy {
        /// The vehicle.
        vehicle: VehicleId,
        /// (N) the peak force on the other vehicle.
        force: f64,
        /// (m) width of the uniform crush; (m) its depth.
        crush: [f64; 2],
        /// (J) its energy.
        energy: f64,
        /// (J) the smallest and the largest possible energy, if the width is unknown.
        bounds: Option<[f64; 2]>,
    },
    /// The force was assumed to act through the centroid of the damage.
    DamageCentroid {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) the centroid, forward and left of the CG or, in z-down axes, right.
        point: [f64; 2],
        /// The damaged side.
        side: Side,
        /// Whether the file gives the position of the damage on the face.
        offset_given: bool,
    },
    /// The contact point was placed at the centroid of the damage.
    ContactPlaced {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) the point, forward and left of the CG or, in z-down axes, right.
        point: [f64; 2],
        /// Its uncertainty in the samples of `uncertainty`, for each [`FaceAxis`].
        spread: [ContactSpread; 2],
    },
    /// The file's data on the position of the contact point disagree.
    ContactApart {
        /// (m) the largest distance between two of the positions.
        distance: f64,
        /// Whether one of them is `contact` of `[scene]`.
        with_scene: bool,
    },
    /// The two directions of force that the file gives are not opposite in the scene.
    PdofsNotOpposite {
        /// (rad) by how much.
        angle: f64,
    },
    /// The work of the normal impulse is not the crush energy.
    DamageEnergyDiffers {
        /// (J) W_n or, if the basis of the case is a share λ of the tangential work, W_n + λ W_t.
        normal_work: f64,
        /// (J) the crush energy on the basis of the case.
        crush_energy: f64,
        /// That basis.
        basis: Basis,
        /// (J) the crush energy on the other of `dissipated` and `absorbed`, which differs only if there is
        /// restitution; `None` with a share of the tangential work.
        on_other_basis: Option<f64>,
    },
    /// The line of action passes the CG on the side from which it would turn the vehicle opposite to the
    /// impact.
    RotationOpposes {
        /// The vehicle.
        vehicle: VehicleId,
        /// (rad) the PDOF of the line of action.
        pdof: f64,
        /// (rad/s) change of the yaw rate.
        turned: f64,
    },
    /// The file gives a speed for the vehicle whose speed was to be found.
    GivenSpeedUnused {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) as given.
        given: f64,
        /// Whether it is a vector, whose direction was used.
        is_direction_used: bool,
        /// (m/s) as found.
        found: f64,
    },
    /// The tangential impulse adds energy, which friction cannot.
    SlidingDriven {
        /// (J) W_t, negative.
        tangential_work: f64,
        /// (J) E_L.
        energy_loss: f64,
        /// (m/s) u_t before the impact.
        sliding: f64,
        /// The cause.
        cause: Drive,
    },
    /// The moment impulse adds energy.
    RotationDriven {
        /// (J) W_m, negative.
        moment_work: f64,
        /// (J) E_L.
        energy_loss: f64,
        /// e_m.
        moment_restitution: f64,
    },
    /// The surfaces pull along the crush plane harder than they push.
    LargeImpulseRatio {
        /// μ.
        impulse_ratio: f64,
        /// Whether the law has a friction limit.
        limited: bool,
    },
    /// The answer lies near a discontinuity of the impact law.
    NearJump {
        /// The switch there, and its threshold.
        border: Switch,
        /// The number of the case that it is compared with: the friction limit, or (m/s) u_t.
        given: f64,
        /// The answers of the law on both sides: the full impulse and sliding, or sliding as in the answer
        /// and in the opposite direction.
        sides: [JumpSide; 2],
    },
    /// Which of the records of a recorder is of the impact is not certain.
    RecordUncertain {
        /// The vehicle.
        vehicle: VehicleId,
        /// The number of the record that is used, from 1; `None` if none is.
        used: Option<usize>,
        /// (1) the probability that it is of the impact, or the greatest of all records.
        probability: f64,
    },
    /// An estimate excludes that a vehicle was backing, but the evidence suggests it.
    MayHaveBacked {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) its speed by an exact solution, if one is negative.
        speed: Option<f64>,
    },
    /// One degree of an angle without a range considerably changes a speed that was found.
    HangsOnAngle {
        /// The vehicle with that speed.
        vehicle: VehicleId,
        /// The key of the angle.
        path: String,
        /// (m/s) by how much, from 1°.
        change: f64,
        /// (m/s) the speed.
        speed: f64,
    },
    /// The contact point lies next to the damage, not on it.
    ContactOffDamage {
        /// The vehicle.
        vehicle: VehicleId,
        /// The damaged side.
        side: Side,
        /// (m) distance beyond the end of the damage, along the side.
        distance: f64,
    },
    /// The contact point lies on the half of the vehicle away from the damaged side.
    ContactOtherHalf {
        /// The vehicle.
        vehicle: VehicleId,
        /// The damaged side.
        side: Side,
        /// (m) distance beyond the CG or the vehicle's axis.
        distance: f64,
    },
    /// The contact point lies deeper in the vehicle than the damage.
    ContactDepth {
        /// The vehicle.
        vehicle: VehicleId,
        /// The damaged side.
        side: Side,
        /// (m) distance behind the deepest crush, seen from the damaged side.
        distance: f64,
    },
    /// The damage extends beyond the end of the damaged side.
    DamageOutside {
        /// The vehicle.
        vehicle: VehicleId,
        /// The damaged side.
        side: Side,
        /// (m) by how much.
        distance: f64,
    },
    /// A number that is unusual for a vehicle or a collision.
    Implausible {
        /// The vehicle.
        vehicle: VehicleId,
        /// The quantity.
        magnitude: Magnitude,
        /// (SI) the number.
        value: f64,
        /// (SI) the usual range of this kind of vehicle.
        usual: [f64; 2],
        /// The kind.
        kind: VehicleKind,
        /// If the file does not give the kind of vehicle: the other kinds for which the number is usual.
        others: Vec<VehicleKind>,
    },
    /// By its stiffness, the side would withstand a fast impact without damage.
    HighNoDamageSpeed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) b_0.
        speed: f64,
        /// The source of the stiffness.
        source: StiffnessSource,
    },
    /// By its stiffness, almost any impact would damage the side.
    LowNoDamageSpeed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) b_0.
        speed: f64,
        /// The source of the stiffness.
        source: StiffnessSource,
    },
    /// The stiffness of the fleet is used for a vehicle or a damage to which it was not fitted.
    UnlikeFleet {
        /// The vehicle.
        vehicle: VehicleId,
        /// Its model year, if that is not one of the fleet.
        model_year: Option<u16>,
        /// (m) the width of the depths, and that of the damaged end, if the depths leave a large part of it
        /// out.
        widths: Option<[f64; 2]>,
    },
    /// A friction limit that is unusual between vehicles.
    UnusualFriction {
        /// The limit.
        friction: f64,
    },
    /// A friction that is unusual between tyre and ground.
    GroundFriction {
        /// The key, such as `surface.friction`.
        path: String,
        /// (–) the friction.
        friction: f64,
        /// (–) the least and the greatest usual one.
        usual: [f64; 2],
    },
    /// An angle of more than a full turn.
    LargeAngle {
        /// The key, such as `vehicle1.heading`.
        path: String,
        /// The angle in full turns, without sign.
        turns: f64,
        /// Whether it is written in degrees.
        in_degrees: bool,
    },
    /// There is no residual crush, but crush energy.
    NoResidualCrush {
        /// The vehicle.
        vehicle: VehicleId,
        /// (J) the energy of G alone.
        energy: f64,
    },
    /// The vehicle passed an object that absorbed energy.
    ObjectPassed {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) its speed before and after the impact.
        speeds: [f64; 2],
    },
}

/// The answer of a law on one side of a jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JumpSide {
    /// (J) W_n.
    pub normal_work: f64,
    /// (N·m·s) M, for a law that has one.
    pub moment: Option<f64>,
    /// (rad/s) Ω; `None` for a fixed object.
    pub yaw_rates: [Option<f64>; 2],
}

/// Why a tangential impulse drives the sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// The file gives μ with the sign of the sliding.
    RatioAlong {
        /// μ.
        impulse_ratio: f64,
    },
    /// The file gives μ, but nothing slides before the impact.
    RatioWithoutSliding {
        /// μ.
        impulse_ratio: f64,
    },
    /// The file gives μ, which ends the sliding and reverses it.
    RatioBeyond {
        /// μ.
        impulse_ratio: f64,
        /// μ_c, if there is one.
        critical: Option<f64>,
    },
    /// The file gives a change of the tangential velocity that adds to the sliding or reverses it.
    Change {
        /// (m/s) U_t − u_t.
        change: f64,
    },
    /// The law finds an impulse that cannot oppose the sliding, because the push along the normal reverses
    /// the sliding.
    Coupling,
}

/// The quantities of a vehicle that are checked for plausibility.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Magnitude {
    /// (kg) mass.
    Mass,
    /// (m) radius of gyration.
    YawRadius,
    /// (m) length of the body.
    Length,
    /// (m) width of the body.
    BodyWidth,
    /// (m/s) speed before the impact, as given.
    Speed,
    /// (m/s) the speed found.
    SpeedFound,
    /// (m) depth of crush.
    CrushDepth,
    /// (m) width of the damage.
    DamageWidth,
    /// (kg) mass of the car in the barrier test.
    TestMass,
    /// (m/s) speed of that car.
    TestSpeed,
    /// (m) depth of its crush.
    TestDepth,
    /// (m) width of its damage.
    TestWidth,
}

impl Warning {
    codes! {
        PlaneDoesNotSeparate => "crush-plane",
        ContactOutside { vehicle } => "contact-outside",
        HighRestitution => "high-restitution",
        ForceBalance => "force-balance",
        PdofDiffers { vehicle } => "pdof-differs",
        MomentumDiffers => "momentum-differs",
        NotLocked => "not-locked",
        EvidenceDiffers { vehicle } => "evidence-differs",
        BelowRecord { vehicle } => "below-record",
        RestsOverlap => "rests-overlap",
        SkidAboveRecord { vehicle } => "skid-above-record",
        SkidDirection { vehicle } => "skid-direction",
        WreckAlone { vehicle } => "wreck-alone",
        SkidOnGrade { vehicle } => "skid-on-grade",
        CategoryEnergy => "category-energy",
        FleetEnergy => "fleet-energy",
        SeveralStarts { vehicle } => "several-starts",
        PointMissed { vehicle } => "point-missed",
        RestMissed { vehicle } => "rest-missed",
        AngleCapped { vehicle } => "angle-capped",
        SideNotPushed { vehicle } => "side-not-pushed",
        DeltaVDiffers => "delta-v-differs",
        SeveralSpeeds => "several-speeds",
        MovesBackward { vehicle } => "moves-backward",
        MayHaveBacked { vehicle } => "may-have-backed",
        RecordUncertain { vehicle } => "record-uncertain",
        ClassValues { vehicle } => "class-values",
        BurgInertia { vehicle } => "burg-inertia",
        InferredEnergy { vehicle } => "inferred-energy",
        DamageCentroid { vehicle } => "damage-centroid",
        ContactPlaced { vehicle } => "contact-placed",
        ContactApart => "contact-apart",
        PdofsNotOpposite => "pdofs-not-opposite",
        DamageEnergyDiffers => "damage-energy-differs",
        RotationOpposes { vehicle } => "rotation-opposes",
        GivenSpeedUnused { vehicle } => "given-speed-unused",
        SlidingDriven => "sliding-driven",
        RotationDriven => "rotation-driven",
        LargeImpulseRatio => "large-impulse-ratio",
        NearJump => "near-jump",
        ContactOffDamage { vehicle } => "contact-off-damage",
        ContactOtherHalf { vehicle } => "contact-other-half",
        ContactDepth { vehicle } => "contact-depth",
        DamageOutside { vehicle } => "damage-outside",
        HangsOnAngle { vehicle } => "hangs-on-angle",
        Implausible { vehicle } => "implausible",
        HighNoDamageSpeed { vehicle } => "high-no-damage-speed",
        LowNoDamageSpeed { vehicle } => "low-no-damage-speed",
        UnlikeFleet { vehicle } => "unlike-fleet",
        UnusualFriction => "unusual-friction",
        GroundFriction => "ground-friction",
        LargeAngle => "large-angle",
        NoResidualCrush { vehicle } => "no-residual-crush",
        ObjectPassed { vehicle } => "object-passed",
    }

    /// How much of the impact's energy crush energies show on average, if that is what it says.
    #[must_use]
    pub fn energy_shown(&self) -> Option<EnergyShown> {
        match *self {
            Self::CategoryEnergy { of, share, .. } | Self::FleetEnergy { of, share, .. } => {
                Some(EnergyShown { of, share })
            }
            _ => None,
        }
    }

    /// Whether it concerns an exact solution, and not the data of the case: if all the evidence is weighed,
    /// it does not apply to the answer.
    #[must_use]
    pub fn is_of_exact_solution(&self) -> bool {
        matches!(
            self,
            Self::MomentumDiffers { .. }
                | Self::EvidenceDiffers { .. }
                | Self::BelowRecord { .. }
                | Self::CategoryEnergy { .. }
                | Self::FleetEnergy { .. }
                | Self::SeveralStarts { .. }
                | Self::DamageEnergyDiffers { .. }
                | Self::DeltaVDiffers { .. }
                | Self::PdofDiffers { .. }
                | Self::SideNotPushed { .. }
                | Self::SeveralSpeeds { .. }
                | Self::MovesBackward { found: true, .. }
                | Self::GivenSpeedUnused { .. }
        )
    }

    /// Whether it doubts the whole answer, and stands next to it.
    #[must_use]
    pub fn doubts_answer(&self) -> bool {
        matches!(self, Self::MayHaveBacked { .. } | Self::SideNotPushed { .. })
    }

    /// Whether the warning only says that the yaw inertia was estimated, which is common.
    #[must_use]
    pub fn is_common(&self) -> bool {
        matches!(self, Self::BurgInertia { .. })
    }
}

/// Warns of a given speed for the vehicle whose speed was found.
pub(crate) fn of_given_speed(case: &Case, vehicle: VehicleId, found: f64) -> Option<Warning> {
    let motion = case.vehicles[vehicle.index()].motion?;
    let is_direction_used = matches!(motion, Velocity::Vector { .. });
    Some(Warning::GivenSpeedUnused { vehicle, given: motion.size(), is_direction_used, found })
}

pub(crate) fn of_found(case: &Case, found: &Found) -> Vec<Warning> {
    let vehicle = found.unknown;
    let mut warnings = Vec::from_iter(of_given_speed(case, vehicle, found.speed));
    let others = Vec::from_iter(found.others());
    if !others.is_empty() {
        warnings.push(Warning::SeveralSpeeds { answer: found.speed, others });
    }
    of_found_speed(vehicle, found.speed, &mut warnings);
    warnings
}

/// How much of the energy of the impact crush energies by a typical stiffness show on average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyShown {
    /// The vehicles whose energies these are.
    pub of: [bool; 2],
    /// (–) the share.
    pub share: f64,
}

/// Warns of crush energies by typical stiffnesses: those of categories, and that of the fleet.
pub(crate) fn of_typical(case: &Case, vehicles: &[Vehicle; 2]) -> Vec<Warning> {
    let is_corrected = case.estimate.is_some_and(|given| given.crush_bias.is_some());
    if is_corrected || case.has_no_residual_crush() {
        return Vec::new();
    }
    let is_alone = case.vehicles.iter().any(GivenVehicle::is_absent);
    let warning = |method: EnergyMethod| {
        let of = vehicles.each_ref().map(|vehicle| {
            let source = vehicle.subject.damage.as_ref().map(|data| data.stiffness_source);
            matches!(source, Some(StiffnessSource::Typical(typical)) if method_of(typical) == method)
        });
        let years = || {
            case.vehicles.iter().zip(of).filter_map(|(vehicle, is_of)| is_of.then_some(vehicle.model_year))
        };
        let misfit = misfit(case, Some(method), &damaged_sides(case));
        let bias = |year| FITTED.energy_error(method, misfit, year, false).bias;
        // The energy of the car that differs more from its kind.
        let bias = years().map(bias).fold(0.0, f64::min);
        let share = real::elementary::exp(bias);
        (bias < 0.0).then(|| match method {
            EnergyMethod::Fleet => Warning::FleetEnergy { of, share, is_alone },
            _ => {
                let is_year_assumed = years().any(|year| year.is_none());
                Warning::CategoryEnergy { of, share, is_alone, is_year_assumed }
            }
        })
    };
    [EnergyMethod::Class, EnergyMethod::Fleet].into_iter().filter_map(warning).collect()
}

/// Warnings about a speed (m/s) that was found.
pub(crate) fn of_found_speed(vehicle: VehicleId, speed: f64, warnings: &mut Vec<Warning>) {
    if speed < -ROUNDED_SPEED {
        warnings.push(Warning::MovesBackward { vehicle, speed, found: true });
    }
}

pub(crate) fn of_impact(impact: &Impact, warnings: &mut Vec<Warning>) {
    of_plane(&impact.contact, warnings);
    of_restitution(impact.law.restitution(), -impact.outcome.approach.normal, warnings);
    of_works(impact, warnings);
    let impulse_ratio = impact.outcome.impulse_ratio;
    if impulse_ratio.abs() > LARGE_RATIO {
        let limited =
            matches!(impact.law.tangential(), Tangential::Friction(_) | Tangential::FullOrSliding(_));
        warnings.push(Warning::LargeImpulseRatio { impulse_ratio, limited });
    }
    of_jumps(impact, warnings);
}

/// (–) share of the speed before the impact: a vehicle that keeps more of it neither stopped at the object
/// nor rebounded from it.
const KEPT: f64 = 0.5;

/// Warns of a vehicle that neither stopped at an object that absorbed energy nor rebounded from it.
pub(crate) fn of_object(vehicles: &[Vehicle; 2], exchange: &Exchange, warnings: &mut Vec<Warning>) {
    for vehicle in VehicleId::ALL {
        let object = &vehicles[vehicle.other().index()].subject;
        let speeds = [exchange.before[vehicle.index()].velocity, exchange.velocities[vehicle.index()]]
            .map(|velocity| velocity.norm());
        if object.deformation_energy.is_some() && speeds[1] > KEPT * speeds[0] {
            warnings.push(Warning::ObjectPassed { vehicle, speeds });
        }
    }
}

/// Warnings about a friction limit near which the law's answer jumps.
fn of_jumps(impact: &Impact, warnings: &mut Vec<Warning>) {
    let (contact, law, before) = (&impact.contact, &impact.law, impact.outcome.before);
    let (Tangential::Friction(limit) | Tangential::FullOrSliding(limit)) = law.tangential() else { return };
    let borders = law.borders(&contact.inverse_mass(), contact.approach(&before));
    for border in borders.into_iter().flatten() {
        let (at, given) = match border.switch {
            Switch::Limit(needed) => (needed, limit),
            Switch::Direction(sliding) => (sliding, impact.outcome.approach.tangential),
        };
        if (at - given).abs() > NEAR * given.abs() {
            continue;
        }
        // If one side has no answer, there are no two answers to choose from.
        let [(one, true), (other, true)] = border.laws.map(|law| contact.impact_with_validity(before, &law))
        else {
            continue;
        };
        if step(contact, [&one, &other]) > JUMP {
            let sides = [one, other].map(|outcome| JumpSide {
                normal_work: outcome.energy.normal_work,
                moment: law.has_moment().then_some(outcome.moment_impulse),
                yaw_rates: [0, 1].map(|i| {
                    let moves = !contact.participants()[i].body().is_fixed();
                    moves.then_some(outcome.after[i].yaw_rate)
                }),
            });
            warnings.push(Warning::NearJump { border: border.switch, given, sides });
        }
    }
}

/// The distance between two answers for the same impact, as a share of the change of motion. The energy
/// weighs velocities and yaw rates against each other: √(T(V − V′)/T(V − v)).
fn step(contact: &Contact, [one, other]: [&Outcome; 2]) -> f64 {
    let energy = |from: &[Motion; 2], to: &[Motion; 2]| -> f64 {
        let bodies = contact.participants().iter().map(|participant| participant.body());
        let changes = from.iter().zip(to).map(|(from, to)| Motion {
            velocity: to.velocity - from.velocity,
            yaw_rate: to.yaw_rate - from.yaw_rate,
        });
        bodies.zip(changes).map(|(body, change)| body.kinetic_energy(&change)).sum()
    };
    (energy(&other.after, &one.after) / energy(&one.before, &one.after)).sqrt()
}

/// Warnings about works that add energy.
fn of_works(impact: &Impact, warnings: &mut Vec<Warning>) {
    let outcome = &impact.outcome;
    let energy = outcome.energy;
    let energy_loss = energy.loss;
    let adds = |work: f64| work < -(DRIVING_SHARE * energy_loss).max(ROUNDING * energy.before);
    if adds(energy.tangential_work) {
        let sliding = outcome.approach.tangential;
        let cause = match impact.law.tangential() {
            Tangential::Ratio(impulse_ratio) => {
                if sliding.abs() <= NO_SLIDING * outcome.approach.normal.abs() {
                    Drive::RatioWithoutSliding { impulse_ratio }
                } else if (impulse_ratio > 0.0) == (sliding > 0.0) {
                    Drive::RatioAlong { impulse_ratio }
                } else {
                    Drive::RatioBeyond { impulse_ratio, critical: outcome.critical_impulse_ratio }
                }
            }
            Tangential::VelocityChange(change) => Drive::Change { change },
            _ => Drive::Coupling,
        };
        let tangential_work = energy.tangential_work;
        warnings.push(Warning::SlidingDriven { tangential_work, energy_loss, sliding, cause });
    }
    if adds(energy.moment_work) {
        warnings.push(Warning::RotationDriven {
            moment_work: energy.moment_work,
            energy_loss,
            moment_restitution: impact.law.moment_restitution(),
        });
    }
}

pub(crate) fn of_plane(contact: &Contact, warnings: &mut Vec<Warning>) {
    if !contact.separates_centres() {
        warnings.push(Warning::PlaneDoesNotSeparate);
    }
}

/// Warnings about a restitution at a closing speed (m/s).
pub(crate) fn of_restitution(restitution: f64, closing_speed: f64, warnings: &mut Vec<Warning>) {
    if restitution > HIGH_RESTITUTION && closing_speed > FAST_CLOSING {
        warnings.push(Warning::HighRestitution { restitution, closing_speed });
    }
}

pub(crate) fn of_outlines(vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(vehicles) {
        let (Some([forward, left]), Some(outline)) = (vehicle.subject.contact, vehicle.subject.dimensions)
        else {
            continue;
        };
        let front = outline.cg_to_front;
        let ahead = (forward - front).max(front - outline.length - forward);
        let aside = left.abs() - outline.width / 2.0;
        let distance = ahead.max(aside);
        if distance > OUTLINE_TOLERANCE {
            warnings.push(Warning::ContactOutside { vehicle: id, distance });
        }
    }
}

/// Warnings about the contact point, if it is also known from the positions of the CGs.
fn of_contact_places(case: &Case, warnings: &mut Vec<Warning>) {
    let places = case.contact_places();
    let mut farthest: Option<(f64, bool)> = None;
    for (i, first) in places.iter().enumerate() {
        for second in &places[i + 1..] {
            let Some((one, two)) = first.zip(*second) else { continue };
            let distance = (one - two).norm();
            if farthest.is_none_or(|(most, _)| distance > most) {
                farthest = Some((distance, i == 0));
            }
        }
    }
    if let Some((distance, with_scene)) = farthest.filter(|(distance, _)| *distance > CONTACT_APART) {
        warnings.push(Warning::ContactApart { distance, with_scene });
    }
}

/// Number of full turns from which on the way to rest is unusual.
const MANY_TURNS: f64 = 3.0;

/// Warnings about numbers of the file that are probably wrong: angles, speeds, friction, barrier tests.
pub(crate) fn of_case(case: &Case, warnings: &mut Vec<Warning>) {
    let large_angles = case.variables_where(|Variable { number, unit, origin, .. }| {
        let is_angle = unit.is_some_and(|unit| unit.dimension() == Dimension::Angle);
        let angle = number.abs() * unit.map_or(1.0, Unit::factor);
        is_angle && *origin == Origin::Given && angle > FULL_TURN
    });
    for (_, input) in large_angles {
        let in_degrees = input.unit.is_some_and(|unit| unit.spelling() == "deg");
        let turns = input.si().abs() / TAU;
        if input.path.ends_with(".turned") && turns < MANY_TURNS {
            continue;
        }
        warnings.push(Warning::LargeAngle { path: input.path, turns, in_degrees });
    }
    of_contact_places(case, warnings);
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        let backward = GivenSpeed::of_known(case, id).filter(|given| given.speed < 0.0);
        if let Some(GivenSpeed { speed, .. }) = backward {
            warnings.push(Warning::MovesBackward { vehicle: id, speed, found: false });
        }
        of_skid(case, id, warnings);
        of_wreck(case, id, warnings);
        of_grade(case, id, warnings);
        warnings.extend(uncertain_record(case, id).map(Warning::from));
        if let Some(crush) = &vehicle.crush
            && let StiffnessForm::Test(test) = &crush.stiffness
        {
            let mut judge = Judge { vehicle: id, kind: vehicle.kind, warnings };
            let deepest = test.depths.iter().map(Quantity::si).fold(0.0, f64::max);
            judge.of(Magnitude::TestMass, test.mass.kg(), |usual| usual.mass(None));
            judge.of(Magnitude::TestSpeed, test.speed.si(), |_| USUAL_TEST_SPEED);
            judge.of(Magnitude::TestDepth, deepest, |usual| usual.depth(None, crush.side));
            judge.of(Magnitude::TestWidth, test.width.si(), |usual| usual.damage_width(None, crush.side));
        }
        warnings.extend(unlike_fleet(id, vehicle));
    }
    if let Some(friction) = case.impact.as_ref().and_then(|impact| impact.law.friction())
        && !is_usual(friction, USUAL_FRICTION)
    {
        warnings.push(Warning::UnusualFriction { friction });
    }
    let usual = USUAL_GROUND_FRICTION;
    let unusual = case.variables_where(|Variable { number, unit, origin, .. }| {
        unit.is_none() && *origin == Origin::Given && !is_usual(*number, usual)
    });
    let is_of_ground = |path: &str| {
        let ends = [".after.friction", ".before.skid.friction"];
        let is_of_surface = path.starts_with("surface.") && path.ends_with(".friction");
        is_of_surface || ends.into_iter().any(|end| path.ends_with(end))
    };
    let of_ground = unusual.into_iter().filter(|(_, input)| is_of_ground(&input.path));
    warnings.extend(of_ground.map(|(_, Input { path, number: friction, .. })| Warning::GroundFriction {
        path,
        friction,
        usual,
    }));
}

/// (–) depths over less than this share of an end count as those of a part of it. The stiffness of the fleet
/// was fitted to depths over the whole width; the share is a choice.
const WHOLE_WIDTH: f64 = 0.75;

/// Warns where the stiffness of the fleet was not fitted to such a vehicle or damage.
fn unlike_fleet(vehicle: VehicleId, given: &GivenVehicle) -> Option<Warning> {
    let crush =
        given.crush.as_ref().filter(|crush| crush.stiffness.typical() == Some(TypicalStiffness::Fleet))?;
    let model_year = given.model_year.filter(|year| !FLEET_YEARS.contains(year));
    let is_end = matches!(crush.side, Side::Front | Side::Rear);
    let widths =
        crush.width.as_ref().zip(given.outline.as_ref()).map(|(own, end)| [own.si(), end.width.si()]);
    let widths = widths.filter(|[own, end]| is_end && *own < WHOLE_WIDTH * end);
    (model_year.is_some() || widths.is_some()).then_some(Warning::UnlikeFleet { vehicle, model_year, widths })
}

impl From<UncertainRecord> for Warning {
    fn from(UncertainRecord { vehicle, used, probability }: UncertainRecord) -> Self {
        Self::RecordUncertain { vehicle, used, probability }
    }
}

fn of_wreck(case: &Case, vehicle: VehicleId, warnings: &mut Vec<Warning>) {
    let after = case.vehicles[vehicle.index()].after.as_ref().filter(|_| case.locked_together);
    let is_by_places =
        |after: &After| after.speed.is_none() && (after.rest.is_some() || !after.points.is_empty());
    if after.is_some_and(is_by_places) {
        warnings.push(Warning::WreckAlone { vehicle });
    }
}

/// (–) a skid on a grade of less than 1 % is as on level ground.
const LEVEL: f64 = 0.01;

/// Warns of skid marks up or down a grade. A friction that is given for the marks may already include that
/// grade.
pub(crate) fn of_grade(case: &Case, vehicle: VehicleId, warnings: &mut Vec<Warning>) {
    let skid = case.vehicles[vehicle.index()].skid().filter(|skid| skid.friction.is_none());
    let grade = case.surface.as_ref().and_then(|surface| surface.grade);
    let Some((_, grade)) = skid.zip(grade) else { return };
    let course = case.skid_direction(vehicle).or(case.courses()[vehicle.index()]);
    // Of an unknown direction, the steepest.
    let uphill = case.axes.lateral(grade.uphill.si());
    let along = course.map_or(1.0, |course| sin_cos(uphill - course).1);
    if (grade.slope * along).abs() >= LEVEL {
        warnings.push(Warning::SkidOnGrade { vehicle });
    }
}

/// (rad) 45°: marks may be curved, but not so much that the vehicle travelled in quite another direction.
const SKID_ASTRAY: f64 = FRAC_PI_4;

fn of_skid(case: &Case, vehicle: VehicleId, warnings: &mut Vec<Warning>) {
    let given = GivenSpeed::of(case, vehicle);
    let course = given.map_or(case.courses()[vehicle.index()], |given| given.course);
    let Some((skid, course)) = case.skid_direction(vehicle).zip(course) else { return };
    let backward = given.is_some_and(|given| given.speed < 0.0);
    let course = principal_angle(if backward { course + PI } else { course });
    if principal_angle(skid - course).abs() > SKID_ASTRAY {
        warnings.push(Warning::SkidDirection { vehicle, skid, course });
    }
}

fn is_usual(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

/// Compares the numbers of a vehicle with those that are usual for its kind.
struct Judge<'a> {
    vehicle: VehicleId,
    kind: Option<VehicleKind>,
    warnings: &'a mut Vec<Warning>,
}

impl Judge<'_> {
    /// Warns if a number is unusual, and returns whether it is usual.
    fn of(&mut self, magnitude: Magnitude, value: f64, range: impl Fn(&Usual) -> [f64; 2]) -> bool {
        let Self { vehicle, kind: given, .. } = *self;
        let kind = given.unwrap_or_default();
        let usual = range(Usual::of(kind));
        let passed = is_usual(value, usual);
        if !passed {
            let fits = |kind: &VehicleKind| given.is_none() && is_usual(value, range(Usual::of(*kind)));
            let others = VehicleKind::WORDS.into_iter().map(|(_, kind)| kind).filter(fits).collect();
            self.warnings.push(Warning::Implausible { vehicle, magnitude, value, usual, kind, others });
        }
        passed
    }
}

/// Warnings about the data of each vehicle, before any analysis; `speeds` (m/s) as far as they are known, and
/// whether each was found.
pub(crate) fn of_data(
    vehicles: &[Vehicle; 2],
    speeds: [Option<f64>; 2],
    is_found: [bool; 2],
    warnings: &mut Vec<Warning>,
) {
    for (id, (vehicle, speed)) in VehicleId::ALL.into_iter().zip(vehicles.iter().zip(speeds)) {
        let subject = &vehicle.subject;
        let mut judge = Judge { vehicle: id, kind: subject.kind, warnings };
        // An impossible body is no reference for what lies within it. A wall or a pole may have any size.
        let moves = subject.inertia.is_some();
        let dimensions = subject.dimensions.as_ref().filter(|body| {
            if !moves {
                return false;
            }
            let [length, width] = [
                judge.of(Magnitude::Length, body.length, |usual| usual.length),
                judge.of(Magnitude::BodyWidth, body.width, |usual| usual.width),
            ];
            length && width
        });
        if let Some(inertia) = subject.inertia {
            judge.of(Magnitude::Mass, inertia.mass, |usual| usual.mass(dimensions));
            // k = √(I/m)
            if let Some(yaw_inertia) = inertia.yaw_inertia {
                let radius = (yaw_inertia / inertia.mass).sqrt();
                judge.of(Magnitude::YawRadius, radius, |usual| usual.yaw_radius);
            }
        }
        if let Some(speed) = speed {
            let magnitude = if is_found[id.index()] { Magnitude::SpeedFound } else { Magnitude::Speed };
            judge.of(magnitude, speed.abs(), |usual| usual.speed);
        }
        if let Some((side, contact)) = subject.energy.and_then(|energy| energy.side).zip(subject.contact) {
            of_half(id, contact, side, judge.warnings);
        }
        if let (Some(damage), Some(given)) = (&vehicle.damage, &subject.damage) {
            let inferred = damage.inferred.map(|inferred| inferred.crush.depth);
            let deepest = damage.depths.iter().copied().chain(inferred).fold(0.0, f64::max);
            judge.of(Magnitude::CrushDepth, deepest, |usual| usual.depth(dimensions, given.side));
            judge
                .of(Magnitude::DamageWidth, damage.width, |usual| usual.damage_width(dimensions, given.side));
            of_stiffness(id, vehicle, damage, given.stiffness_source, warnings);
            of_places(id, vehicle, damage, given, warnings);
        }
    }
}

fn of_stiffness(
    vehicle: VehicleId,
    of: &Vehicle,
    damage: &Damage,
    source: StiffnessSource,
    warnings: &mut Vec<Warning>,
) {
    let usual = Usual::of(of.subject.kind.unwrap_or_default()).no_damage_speed;
    if let (Some(speed), Some([least, most])) = (of.no_damage_speed(), usual) {
        if speed > most {
            warnings.push(Warning::HighNoDamageSpeed { vehicle, speed, source });
        // With A = 0, the line was chosen to go through the origin.
        } else if speed > 0.0 && speed < least {
            warnings.push(Warning::LowNoDamageSpeed { vehicle, speed, source });
        }
    }
    if damage.inferred.is_none() && damage.depths.iter().all(|&depth| depth == 0.0) {
        warnings.push(Warning::NoResidualCrush { vehicle, energy: damage.crush_energy });
    }
}

/// (m) distance of a point from the CG towards a side.
fn outward([forward, left]: [f64; 2], side: Side) -> f64 {
    match side {
        Side::Front => forward,
        Side::Rear => -forward,
        Side::Left => left,
        Side::Right => -left,
    }
}

/// Warnings about a contact point on the half of the vehicle away from the damaged side.
fn of_half(vehicle: VehicleId, contact: [f64; 2], side: Side, warnings: &mut Vec<Warning>) {
    let outward = outward(contact, side);
    if outward < -END_TOLERANCE {
        warnings.push(Warning::ContactOtherHalf { vehicle, side, distance: -outward });
    }
}

/// Warnings about a contact point deeper in the vehicle than the measured crush.
fn of_depth(vehicle: VehicleId, of: &Vehicle, damage: &Damage, side: Side, warnings: &mut Vec<Warning>) {
    let (Some(contact), Some(outline), None) = (of.subject.contact, of.subject.dimensions, damage.inferred)
    else {
        return;
    };
    let outward = outward(contact, side);
    let deepest = damage.depths.iter().copied().fold(0.0, f64::max);
    let distance = outline.face(side) - deepest - outward;
    let tolerance = match side {
        Side::Front | Side::Rear => END_DEPTH_TOLERANCE,
        Side::Left | Side::Right => SIDE_DEPTH_TOLERANCE,
    };
    // On the other half, there is already a warning.
    if distance > tolerance && outward >= -END_TOLERANCE {
        warnings.push(Warning::ContactDepth { vehicle, side, distance });
    }
}

/// Warnings about contact point, damage and outline, which have to fit together.
fn of_places(
    id: VehicleId,
    vehicle: &Vehicle,
    damage: &Damage,
    given: &inputs::DamageData,
    warnings: &mut Vec<Warning>,
) {
    let side = given.side;
    let is_end = matches!(side, Side::Front | Side::Rear);
    if let Some(contact) = vehicle.subject.contact {
        of_half(id, contact, side, warnings);
        of_depth(id, vehicle, damage, side, warnings);
    }
    // A damage of unknown width or position has no ends.
    let has_width = damage.inferred.is_none_or(|inferred| inferred.range.is_none());
    let Some(offset) = given.offset.filter(|_| has_width) else { return };
    if let Some([forward, left]) = vehicle.subject.contact {
        let along = if is_end { left } else { forward };
        let distance = (along - offset).abs() - damage.width / 2.0;
        if distance > END_TOLERANCE {
            warnings.push(Warning::ContactOffDamage { vehicle: id, side, distance });
        }
    }
    if let Some(dimensions) = &vehicle.subject.dimensions {
        let ends = if is_end {
            [-dimensions.width / 2.0, dimensions.width / 2.0]
        } else {
            [dimensions.cg_to_front - dimensions.length, dimensions.cg_to_front]
        };
        let half = damage.width / 2.0;
        let distance = (ends[0] - (offset - half)).max(offset + half - ends[1]);
        if distance > END_TOLERANCE {
            warnings.push(Warning::DamageOutside { vehicle: id, side, distance });
        }
    }
}

/// Warnings about assumed values.
pub(crate) fn of_assumptions(case: &Case, vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(vehicles) {
        let subject = &vehicle.subject;
        let from_class = subject.dimensions.and_then(|dimensions| {
            let outline = [dimensions.length, dimensions.width, dimensions.cg_to_front];
            dimensions.class.map(|class| (class, outline))
        });
        let (mut class, mut yaw_inertia) = (from_class.map(|(class, _)| class), None);
        if let Some(inertia) = subject.inertia {
            match inertia.yaw_source {
                YawSource::Given | YawSource::Unknown => {}
                YawSource::Class(of_yaw) => {
                    class = Some(of_yaw);
                    yaw_inertia = inertia.yaw_inertia;
                }
                YawSource::Burg => {
                    let burg = |yaw_inertia| Warning::BurgInertia { vehicle: id, yaw_inertia };
                    warnings.extend(inertia.yaw_inertia.map(burg));
                }
            }
        }
        if let Some(class) = class {
            let outline = from_class.map(|(_, outline)| outline);
            warnings.push(Warning::ClassValues { vehicle: id, class, yaw_inertia, outline });
        }
        if let Some(point) = subject.contact.filter(|_| subject.contact_is_placed) {
            let spread = FaceAxis::ALL.map(|axis| case.contact_spread(id, axis));
            warnings.push(Warning::ContactPlaced { vehicle: id, point, spread });
        }
        let Some(damage) = &vehicle.damage else { continue };
        if let Some(inferred) = damage.inferred {
            warnings.push(Warning::InferredEnergy {
                vehicle: id,
                force: inferred.force,
                crush: [inferred.crush.width, inferred.crush.depth],
                energy: inferred.crush.energy,
                bounds: inferred.range.map(|range| [range.lowest.energy, range.highest.energy]),
            });
        }
        if let (Some(point), Some(given)) = (damage.centroid, &subject.damage) {
            let (side, offset_given) = (given.side, given.offset.is_some());
            warnings.push(Warning::DamageCentroid { vehicle: id, point, side, offset_given });
        }
    }
}

pub(crate) fn of_damage(vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    let mut peak_forces = [None; 2];
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(vehicles) {
        let Some(damage) = &vehicle.damage else { continue };
        let Some(oblique_angle) = damage.oblique_angle else { continue };
        match damage.oblique {
            Some(oblique) => {
                peak_forces[id.index()] = Some(oblique.peak_force);
                if oblique.factor.capped {
                    warnings.push(Warning::AngleCapped { vehicle: id, oblique_angle });
                }
            }
            None => warnings.push(Warning::SideNotPushed { vehicle: id, oblique_angle }),
        }
    }
    if let [Some(f1), Some(f2)] = peak_forces
        && f1.max(f2) > FORCE_RATIO * f1.min(f2)
    {
        warnings.push(Warning::ForceBalance { forces: [f1, f2] });
    }
}

pub(crate) fn of_directions(impact: &Impact, vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (id, (vehicle, computed)) in VehicleId::ALL.into_iter().zip(vehicles.iter().zip(impact.pdof)) {
        let Some(given) = vehicle.given_pdof() else { continue };
        // The difference of two directions, the short way round.
        let limit = vehicle.half_hour().max(PDOF_DIFFERENCE);
        if principal_angle(given - computed).abs() > limit {
            warnings.push(Warning::PdofDiffers { vehicle: id, given, computed, limit });
        }
    }
}

/// Failed checks that no other warning covers.
pub(crate) fn of_checks(
    checks: &[Check],
    vehicles: &[Vehicle; 2],
    impact: Option<&Impact>,
    exchange: Option<&Exchange>,
    basis: Basis,
    warnings: &mut Vec<Warning>,
) {
    for check in checks.iter().filter(|check| !check.passed()) {
        match (check.quantity, impact) {
            (CheckedQuantity::PdofsOpposite, _) => {
                warnings.push(Warning::PdofsNotOpposite { angle: check.value });
            }
            (CheckedQuantity::DamageEnergy { normal_work, crush_energy }, Some(impact)) => {
                let restitution = impact.law.restitution();
                // 1 − e²
                let dissipated = EnergyBasis::Absorbed.dissipated(1.0, restitution);
                let on_other_basis = match basis {
                    Basis::Dissipated => Some(crush_energy * dissipated),
                    Basis::Absorbed => Some(crush_energy / dissipated),
                    Basis::TangentialShare(_) => None,
                };
                let on_other_basis = on_other_basis.filter(|_| restitution > 0.0);
                warnings.push(Warning::DamageEnergyDiffers {
                    normal_work,
                    crush_energy,
                    basis,
                    on_other_basis,
                });
            }
            (CheckedQuantity::Rotation { vehicle }, _) => {
                let turned = exchange.and_then(|exchange| exchange.turned(vehicle));
                if let Some((pdof, turned)) = vehicles[vehicle.index()].crash3_pdof().zip(turned) {
                    warnings.push(Warning::RotationOpposes { vehicle, pdof, turned });
                }
            }
            _ => {}
        }
    }
}

/// Warnings about disagreement between momentum and other evidence.
pub(crate) fn of_momentum(checks: &[Check], warnings: &mut Vec<Warning>) {
    let checks: Vec<Check> = checks.iter().filter(|check| !check.passed()).copied().collect();
    if !checks.is_empty() {
        warnings.push(Warning::MomentumDiffers { checks });
    }
}

/// (m/s) CGs of one body keep their distance: a greater speed at which they part or close is not measurement.
const APART: f64 = 1.0;

/// Warns of vehicles that are said to have left as one body, with velocities that no body has.
pub(crate) fn of_wreck_apart(both: &BothFound) -> Option<Warning> {
    let parting = both.cg_line?.parting_speed;
    (both.locked_together && parting.abs() > APART).then_some(Warning::NotLocked { parting })
}

/// (m) rest positions are surveyed no better, and bodies are no exact rectangles.
const OVERLAP: f64 = 0.5;

/// Warns if both measured rests cannot be right, because the bodies there overlap.
pub(crate) fn of_rests(travel: &[Option<Travel>; 2], vehicles: &[Vehicle; 2]) -> Option<Warning> {
    // The centre of the body, its axes, and half its length and its width along these.
    let body = |id: VehicleId| {
        let travel = travel[id.index()].as_ref()?;
        let (rest, of) = (travel.measured.as_ref()?, vehicles[id.index()].subject.dimensions?);
        let (sin, cos) = Real::sin_cos(rest.heading.heading(travel.start.heading));
        let axes = [Vector2::new(cos, sin), Vector2::new(0.0 - sin, cos)];
        let centre = rest.position + axes[0] * (of.cg_to_front - 0.5 * of.length);
        Some((centre, axes, [0.5 * of.length, 0.5 * of.width]))
    };
    let [(one, of_one, half_one), (two, of_two, half_two)] = [body(VehicleId::One)?, body(VehicleId::Two)?];
    let depth_along = |axis: &Vector2<f64>| {
        let reach = |axes: [Vector2<f64>; 2], half: [f64; 2]| {
            axes.iter().zip(half).map(|(own, half)| half * own.dot(axis).abs()).sum::<f64>()
        };
        reach(of_one, half_one) + reach(of_two, half_two) - (two - one).dot(axis).abs()
    };
    // Rectangles overlap by the least of these, if all are positive.
    let depth = of_one.iter().chain(&of_two).map(depth_along).fold(f64::INFINITY, f64::min);
    let crush = vehicles.iter().filter_map(|vehicle| vehicle.damage.as_ref());
    let crush: f64 = crush.map(|damage| damage.depths.iter().copied().fold(0.0, f64::max)).sum();
    (depth > OVERLAP + crush).then_some(Warning::RestsOverlap { depth })
}

/// Warnings if a rest position leaves several motions, or if the motion misses a point of the path.
pub(crate) fn of_travel(
    travel: &[Option<Travel>; 2],
    both: Option<&BothFound>,
    checks: &[Check],
    warnings: &mut Vec<Warning>,
) {
    for (vehicle, travel) in VehicleId::ALL.into_iter().zip(travel) {
        let Some(travel) = travel else { continue };
        let told = |motion: Motion| [motion.velocity.norm(), motion.yaw_rate];
        // If the impulse selects one of them, only the others that agree with it about equally count.
        let agrees = |other: &Motion| {
            both.is_none_or(|both| {
                let mut rivals = both.rivals();
                both.combinations.is_empty()
                    || rivals.any(|rival| rival.after[vehicle.index()].velocity == other.velocity)
            })
        };
        let others: Vec<[f64; 2]> = travel
            .likely_others()
            .filter(|other| agrees(&other.motion))
            .map(|other| told(other.motion))
            .collect();
        if !others.is_empty() {
            warnings.push(Warning::SeveralStarts { vehicle, used: told(travel.start.motion), others });
        }
    }
    for check in checks.iter().filter(|check| !check.passed()) {
        if let CheckedQuantity::PointMissed { vehicle, point, pass } = check.quantity {
            warnings.push(Warning::PointMissed { vehicle, point, pass });
        }
        if let CheckedQuantity::RestMissed { vehicle, miss } = check.quantity {
            warnings.push(Warning::RestMissed { vehicle, miss, share: check.value });
        }
    }
}

pub(crate) fn of_delta_v(
    impact: &Impact,
    crash3: &Crash3,
    vehicles: &[Vehicle; 2],
    warnings: &mut Vec<Warning>,
) {
    // CRASH3 has no answer to surfaces that slide until separation.
    if impact.outcome.regime == Some(Regime::Sliding) {
        return;
    }
    // Nor for vehicles without damage, whose ΔV of zero is meaningless.
    if crash3.crush_energy <= 0.0 {
        return;
    }
    let of_impact = Outcome::delta_v_magnitude(&impact.outcome);
    // CRASH3 assumes e = 0; comparing it with an impact that has restitution would be meaningless.
    let factor = crash3.restitution_factor;
    let of_crash3 = crash3
        .corrected
        .map_or(crash3.delta_v, |corrected| corrected.delta_v)
        .map(|delta_v| delta_v * factor.unwrap_or(1.0));
    let differs = |(a, b): (f64, f64)| (a - b).abs() > DELTA_V_DIFFERENCE * a;
    if of_impact.into_iter().zip(of_crash3).any(differs) {
        let of_vehicles =
            |values: [f64; 2]| [0, 1].map(|i| vehicles[i].subject.inertia.is_some().then_some(values[i]));
        warnings.push(Warning::DeltaVDiffers {
            impact: of_vehicles(of_impact),
            crash3: of_vehicles(of_crash3),
            restitution: factor.is_some(),
        });
    }
}
