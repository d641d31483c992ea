//! Checks a case without solving it: which analyses it allows, which assumptions it needs, and the warnings
//! that need no answer.

use crash3::{Side, SideStiffness, VehicleClass};
use inputs::{
    Axes, Basis, Case, Crush, CrushEvidence, Faults, Fit, GivenVehicle, ImpactLaw, InferredWidth, Purpose,
    StiffnessForm, StiffnessLine, TypicalStiffness, VehicleData, VehicleKind, Velocity, YawSource,
};
use pim_core::VehicleId;

use crate::aside;
use crate::avoid::avoid_at_once;
use crate::estimate::estimate_evidence;
use crate::failure::Failure;
use crate::goal::Goal;
use crate::recorded::{OfImpact, told_records};
use crate::solve::furthest_solver;
use crate::uncertainty;
use crate::unsolved;
use crate::warning::Warning;

/// The result of checking a case without solving it.
#[derive(Debug)]
pub struct Judgement {
    /// The analyses that it can be used for: `reconstruct`, `impact`, `crush`, `motion` if it has data on
    /// that, `uncertainty`, `estimate` if it has evidence that nothing else reads, `compare`, `sensitivity`
    /// and `draw`.
    pub abilities: Vec<Ability>,
    /// The assumptions for values that the case does not give, in the order of its keys.
    pub assumptions: Vec<Assumption>,
    /// The warnings that need no answer, in the axes of the engine; [`Warning::seen`] converts them to
    /// those of a reader.
    pub warnings: Vec<Warning>,
    /// The records of recorders under their keys, if a vehicle has several, or if its only one is probably
    /// not of this impact.
    pub records: Vec<(String, OfImpact)>,
}

/// Whether a case has everything that a purpose needs. Whether it also has an answer is only known when it is
/// solved.
#[derive(Debug)]
pub struct Ability {
    /// The purpose.
    pub purpose: Purpose,
    /// Which of the first three purposes supplies its answer; the purpose itself for those three.
    pub on: Purpose,
    /// The values that are missing or contradict each other, if any.
    pub obstacle: Option<Faults>,
    /// The keys of the evidence that its exact answer does not use; none for an estimate.
    pub left_aside: Vec<String>,
}

impl Judgement {
    /// The purpose with the most complete answer: the one whose answer uses all the evidence.
    #[must_use]
    pub fn answers_most(&self) -> Option<Purpose> {
        let able = |purpose: Purpose| {
            self.abilities.iter().find(|one| one.purpose == purpose && one.obstacle.is_none())
        };
        // If the exact solution does not use all evidence, `reconstruct` weighs all of it.
        let order =
            [Purpose::Reconstruct, Purpose::Estimate, Purpose::Impact, Purpose::Crush, Purpose::Motion];
        order.into_iter().find(|purpose| able(*purpose).is_some())
    }
}

/// An assumption for a value that the case does not give. Values are in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Assumption {
    /// The axes are z-up.
    ZUp,
    /// Positions after the impact are relative to the point where the impulse acted.
    ImpactAtOrigin,
    /// The ground is level.
    LevelGround,
    /// A, B and G are those of many cars.
    TypicalStiffness {
        /// The damaged vehicle.
        vehicle: VehicleId,
        /// The cars.
        typical: TypicalStiffness,
        /// The damaged side.
        side: Side,
        /// (N/m, N/m², N) A, B and G.
        abg: [f64; 3],
    },
    /// No yaw rate before the impact.
    YawRate {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// The radius of gyration is that of CRASH3's size class.
    ClassInertia {
        /// The vehicle.
        vehicle: VehicleId,
        /// The class, 1 to 6.
        class: u8,
        /// (kg·m²) the resulting yaw inertia.
        yaw_inertia: f64,
    },
    /// Burg's estimate of the yaw inertia, from wheelbase and length.
    BurgInertia {
        /// The vehicle.
        vehicle: VehicleId,
        /// (kg·m²) the estimate.
        yaw_inertia: f64,
    },
    /// The contact point is the centroid of the damage.
    ContactPlaced {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m) the point, forward and left of the CG or, in z-down axes, right.
        point: [f64; 2],
    },
    /// Drawings use the outline of CRASH3's size class.
    Outline {
        /// The vehicle.
        vehicle: VehicleId,
        /// The class whose radius of gyration is nearest, 1 to 6.
        class: u8,
    },
    /// An axle dimension is that of CRASH3's size class.
    Axle {
        /// The vehicle.
        vehicle: VehicleId,
        /// The class, 1 to 6.
        class: u8,
        /// The dimension.
        measure: AxleMeasure,
        /// (m) the value.
        value: f64,
    },
    /// The front wheels stay straight after the impact.
    StraightWheels {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// The friction of the skid before the impact is that of the ground.
    SkidFriction {
        /// The vehicle.
        vehicle: VehicleId,
        /// (–) that friction.
        friction: f64,
    },
    /// The file gives a speed for the vehicle whose speed is to be found; it is not used.
    SpeedUnused {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) as given.
        given: f64,
        /// Whether it is a vector, whose direction is used.
        is_direction_used: bool,
    },
    /// The stations of the profile are equally spaced over the width.
    EqualSpacing {
        /// The damaged vehicle.
        vehicle: VehicleId,
    },
    /// G = A²/2B.
    EnergyWithoutCrush {
        /// The vehicle.
        vehicle: VehicleId,
        /// (N) one value or, by zone, several.
        g: Vec<f64>,
    },
    /// The line through the barrier test is the exact one.
    ExactFit {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// The width of an inferred damage lies within what the vehicle's dimensions allow.
    InferredWidth {
        /// The damaged vehicle.
        vehicle: VehicleId,
    },
    /// The middle of the damage lies on the vehicle's axis or, for damage to a side, level with its CG.
    Centred {
        /// The damaged vehicle.
        vehicle: VehicleId,
        /// The damaged side.
        side: Side,
    },
    /// The direction of the force is derived from the other vehicle's PDOF or, if that is not given either,
    /// from the impulse.
    Pdof {
        /// The vehicle on which the force acts.
        vehicle: VehicleId,
        /// (rad) by Newton's third law, if the file gives the other PDOF and both headings.
        opposite: Option<f64>,
    },
    /// CRASH3's correction for oblique forces, at most a factor of 2.
    CappedCorrection {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// Brach's impact law.
    BrachLaw,
    /// No moment impulse: e_m = −1.
    NoMoment,
    /// The crush energy is the energy dissipated by the normal impulse.
    Dissipated,
}

/// A dimension that locates the axles of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxleMeasure {
    /// Between the axles.
    Wheelbase,
    /// Between the wheels of an axle.
    Track,
    /// From the CG forward to the front axle, as the same share of the wheelbase as in the class.
    CgToFrontAxle,
}

impl AxleMeasure {
    /// Its key in the table of the vehicle.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Wheelbase => "wheelbase",
            Self::Track => "track",
            Self::CgToFrontAxle => "cg_to_front_axle",
        }
    }
}

impl Assumption {
    /// The key of the case that would replace the assumption.
    #[must_use]
    pub fn key(&self) -> String {
        let (vehicle, key) = match self {
            Self::ZUp => return "scene.axes".to_owned(),
            Self::ImpactAtOrigin => return "scene.contact".to_owned(),
            Self::LevelGround => return "surface.grade".to_owned(),
            Self::Axle { vehicle, measure, .. } => (vehicle, measure.key()),
            Self::StraightWheels { vehicle } => (vehicle, "after.steer"),
            Self::SkidFriction { vehicle, .. } => (vehicle, "before.skid.friction"),
            Self::YawRate { vehicle } => (vehicle, "yaw_rate"),
            Self::ClassInertia { vehicle, .. } | Self::BurgInertia { vehicle, .. } => {
                (vehicle, "yaw_inertia")
            }
            Self::ContactPlaced { vehicle, .. } => (vehicle, "contact"),
            Self::Outline { vehicle, .. } => (vehicle, "length"),
            Self::SpeedUnused { vehicle, is_direction_used: true, .. } => (vehicle, "velocity"),
            Self::SpeedUnused { vehicle, .. } => (vehicle, "speed"),
            Self::TypicalStiffness { vehicle, .. } => (vehicle, "crush.stiffness"),
            Self::EqualSpacing { vehicle } => (vehicle, "crush.spacing"),
            Self::EnergyWithoutCrush { vehicle, .. } => (vehicle, "crush.stiffness.G"),
            Self::ExactFit { vehicle } => (vehicle, "crush.stiffness.test.fit"),
            Self::InferredWidth { vehicle } => (vehicle, "crush.width"),
            Self::Centred { vehicle, .. } => (vehicle, "crush.offset"),
            Self::Pdof { vehicle, .. } => (vehicle, "crush.pdof"),
            Self::CappedCorrection { vehicle } => (vehicle, "crush.oblique"),
            Self::BrachLaw => return "impact.law".to_owned(),
            Self::NoMoment => return "impact.moment_restitution".to_owned(),
            Self::Dissipated => return "reconstruct.energy_basis".to_owned(),
        };
        format!("vehicle{vehicle}.{key}")
    }
}

/// Maximum difference of the radius of gyration from that of the nearest size class, as a share of that, and
/// (m) maximum distance of the contact point outside the outline of the class: cars of the same class differ
/// by this much.
const CLASS_RADIUS: f64 = 0.15;
const CLASS_OUTLINE: f64 = 0.6;

/// The CRASH3 size class with the nearest radius of gyration, and its typical dimensions, which drawings show
/// for a car without an outline. `None` if the vehicle is not a car, by its kind, its radius of gyration or
/// its contact point.
#[must_use]
pub fn nearest_class(vehicle: &VehicleData) -> Option<(u8, VehicleClass)> {
    let inertia = vehicle.inertia.filter(|_| vehicle.kind.unwrap_or_default() == VehicleKind::Car)?;
    // k = √(I/m)
    let radius = (inertia.yaw_inertia? / inertia.mass).sqrt();
    let distance = |class: &VehicleClass| (class.yaw_radius - radius).abs();
    let known = (1..=6).filter_map(|class| VehicleClass::new(class).ok().map(|known| (class, known)));
    let (class, known) = known.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
    let is_on_it = vehicle.contact.is_none_or(|[forward, left]| {
        let ahead = (forward - known.cg_to_front).max(known.cg_to_front - known.length - forward);
        ahead.max(left.abs() - known.width / 2.0) <= CLASS_OUTLINE
    });
    (distance(&known) <= CLASS_RADIUS * known.yaw_radius && is_on_it).then_some((class, known))
}

/// Judges a case without solving it.
///
/// Warnings are those of the analysis for which the case is made, as far as they need neither the impulse nor
/// the unknown speed; if the file gives a direction of force, also those that follow from it.
#[must_use]
pub fn judge(case: &Case) -> Judgement {
    let seeks = case.reconstruct.is_some();
    let goal = Goal::of(case);
    let is_both = goal == Goal::BothSpeeds;
    let reconstruction = if is_both {
        case.two_speeds().map(|input| input.collision())
    } else {
        case.reconstruction().map(|input| Some(input.collision))
    };
    let impact = case.collision();
    let collision = match (&reconstruction, &impact) {
        (Ok(collision), _) => collision.as_ref(),
        (_, Ok(input)) => Some(&input.collision),
        _ => None,
    };
    let warnings = unsolved::warnings(case, collision);
    let unpropagated = goal.obstacle(case).or_else(|| uncertainty::inputs(case).err());
    let lacking = [
        (Purpose::Reconstruct, reconstruction.err()),
        (Purpose::Impact, impact.err()),
        (Purpose::Crush, case.damage().err()),
        (Purpose::Motion, case.motion().err()),
    ];
    let of = |purpose, on| {
        let obstacle =
            lacking.iter().find(|(purpose, _)| *purpose == on).and_then(|(_, obstacle)| obstacle.clone());
        Ability { purpose, on, obstacle, left_aside: aside::of_purpose(case, on) }
    };
    let solved = if seeks { Purpose::Reconstruct } else { Purpose::Impact };
    let (furthest, _) = furthest_solver(case);
    let mut abilities = vec![
        of(Purpose::Reconstruct, Purpose::Reconstruct),
        of(Purpose::Impact, Purpose::Impact),
        of(Purpose::Crush, Purpose::Crush),
    ];
    // A case without data after the impact is not asked for any.
    if case.vehicles.iter().any(|vehicle| vehicle.after.is_some()) {
        abilities.push(of(Purpose::Motion, Purpose::Motion));
    }
    let differentiated = match goal {
        Goal::Motion | Goal::Damage => goal.purpose(),
        _ => furthest,
    };
    let on = goal.purpose();
    let left_aside = aside::of_purpose(case, on);
    abilities.push(Ability { purpose: Purpose::Uncertainty, on, obstacle: unpropagated, left_aside });
    let is_asked = is_for_estimate(case);
    let estimated = (is_asked || seeks_speed(case)).then(|| match estimate_evidence(case) {
        Err(Failure::Case(faults)) => Some(faults),
        // Other faults are only found when it is solved.
        _ => None,
    });
    if let Some(obstacle) = estimated.filter(|obstacle| is_asked || obstacle.is_none()) {
        let purpose = Purpose::Estimate;
        abilities.push(Ability { purpose, on: purpose, obstacle, left_aside: Vec::new() });
    }
    abilities.extend([
        of(Purpose::Compare, solved),
        of(Purpose::Sensitivity, differentiated),
        of(Purpose::Draw, furthest),
    ]);
    if case.avoid.is_some() {
        let purpose = Purpose::Avoid;
        abilities.push(Ability {
            purpose,
            on: purpose,
            // Numbers that contradict each other are no scene, either.
            obstacle: match avoid_at_once(case) {
                Err(Failure::Case(faults)) => Some(faults),
                _ => None,
            },
            left_aside: Vec::new(),
        });
    }
    Judgement { abilities, assumptions: assumptions(case), warnings, records: told_records(case) }
}

/// Whether a speed is to be found.
fn seeks_speed(case: &Case) -> bool {
    let is_open = |vehicle: &GivenVehicle| !vehicle.fixed && !vehicle.is_absent() && vehicle.motion.is_none();
    case.reconstruct.is_some() || case.vehicles.iter().any(is_open)
}

/// Whether a case has keys that only an estimate reads.
fn is_for_estimate(case: &Case) -> bool {
    let has_evidence = |vehicle: &GivenVehicle| {
        let skids = vehicle.before.as_ref().is_some_and(|before| before.speed.is_some());
        vehicle.recorder.is_some() || vehicle.certain_speed.is_some() || skids
    };
    case.estimate.is_some() || case.vehicles.iter().any(has_evidence)
}

/// The values that are assumed if the case gives none, in the order of its keys, for any analysis that uses
/// them.
#[must_use]
pub fn assumptions(case: &Case) -> Vec<Assumption> {
    assumed(case, &case.subjects())
}

fn assumed(case: &Case, subjects: &[Option<VehicleData>; 2]) -> Vec<Assumption> {
    let mut assumptions = Vec::new();
    if case.left_out.axes && case.axes == Axes::default() {
        assumptions.push(Assumption::ZUp);
    }
    if VehicleId::ALL.into_iter().any(|id| is_followed(case, id)) {
        let has_place = case.vehicles.iter().any(|vehicle| vehicle.position.is_some());
        if case.scene_contact.is_none() && !has_place {
            assumptions.push(Assumption::ImpactAtOrigin);
        }
        if case.surface.as_ref().is_some_and(|surface| surface.grade.is_none()) {
            assumptions.push(Assumption::LevelGround);
        }
    }
    for (id, (vehicle, subject)) in VehicleId::ALL.into_iter().zip(case.vehicles.iter().zip(subjects)) {
        if vehicle.fixed || vehicle.is_absent() {
            continue;
        }
        if let Some(inertia) = subject.as_ref().and_then(|subject| subject.inertia) {
            let assumed = |yaw_inertia| match inertia.yaw_source {
                YawSource::Given | YawSource::Unknown => None,
                YawSource::Class(class) => Some(Assumption::ClassInertia { vehicle: id, class, yaw_inertia }),
                YawSource::Burg => Some(Assumption::BurgInertia { vehicle: id, yaw_inertia }),
            };
            assumptions.extend(inertia.yaw_inertia.and_then(assumed));
        }
        if let Some(VehicleData { contact: Some([forward, left]), contact_is_placed: true, .. }) = subject {
            let point = [*forward, case.axes.lateral(*left)];
            assumptions.push(Assumption::ContactPlaced { vehicle: id, point });
        }
        if let Some(subject @ VehicleData { dimensions: None, .. }) = subject
            && let Some((class, _)) = nearest_class(subject)
        {
            assumptions.push(Assumption::Outline { vehicle: id, class });
        }
        if is_followed(case, id) {
            of_axles(id, vehicle, &mut assumptions);
        }
        let sought = case.reconstruct.is_some_and(|reconstruct| reconstruct.find.seeks(id));
        if let Some(motion) = vehicle.motion.filter(|_| sought) {
            let is_direction_used = matches!(motion, Velocity::Vector { .. });
            assumptions.push(Assumption::SpeedUnused {
                vehicle: id,
                given: motion.size(),
                is_direction_used,
            });
        }
        if vehicle.yaw_rate.is_none() && case.impact.is_some() {
            assumptions.push(Assumption::YawRate { vehicle: id });
        }
        if let Some(crush) = &vehicle.crush {
            of_crush(id, crush, subject.as_ref(), case.left_out.fit[id.index()], &mut assumptions);
        }
        if let Some(VehicleData { energy: Some(_), force, .. }) = subject
            && force.moment_arm.is_none()
            && (force.pdof.is_none() || force.pdof_follows)
        {
            assumptions.push(Assumption::Pdof { vehicle: id, opposite: force.pdof });
        }
        let takes_friction = vehicle.skid().is_some_and(|skid| skid.friction.is_none());
        if let Some(surface) = case.surface.as_ref().filter(|_| takes_friction) {
            assumptions.push(Assumption::SkidFriction { vehicle: id, friction: surface.friction });
        }
        if is_followed(case, id) && vehicle.after.as_ref().is_some_and(|after| after.steer.is_none()) {
            assumptions.push(Assumption::StraightWheels { vehicle: id });
        }
    }
    if case.vehicles.iter().any(GivenVehicle::is_absent) {
        // If no direction of the force is known, no correction for it is assumed.
        let is_directed = subjects.iter().flatten().any(|subject| subject.force.pdof.is_some());
        assumptions.retain(|assumption| match assumption {
            Assumption::Pdof { .. } => false,
            Assumption::CappedCorrection { .. } => is_directed,
            _ => true,
        });
    }
    if let Some(impact) = &case.impact {
        if case.left_out.law && matches!(impact.law, ImpactLaw::Brach { .. }) {
            assumptions.push(Assumption::BrachLaw);
        }
        if matches!(impact.law, ImpactLaw::Brach { moment_restitution: None, .. }) {
            assumptions.push(Assumption::NoMoment);
        }
    }
    // It matters if a crush energy is compared with an impact.
    let has_crush = case.vehicles.iter().any(GivenVehicle::has_damage_data);
    let is_default = case
        .reconstruct
        .is_none_or(|reconstruct| case.left_out.energy_basis && reconstruct.energy_basis == Basis::default());
    if case.impact.is_some() && has_crush && is_default {
        assumptions.push(Assumption::Dissipated);
    }
    assumptions
}

/// Whether a vehicle is followed from the impact to rest, or back from rest.
fn is_followed(case: &Case, id: VehicleId) -> bool {
    !case.vehicles[id.index()].fixed && case.can_follow(id)
}

/// Axle dimensions of the class that the vehicle lacks.
fn of_axles(id: VehicleId, vehicle: &GivenVehicle, assumptions: &mut Vec<Assumption>) {
    let is_car = vehicle.kind.unwrap_or_default() == VehicleKind::Car;
    let class = vehicle.class.filter(|_| is_car);
    let Some((class, known)) = class.and_then(|class| Some((class, VehicleClass::new(class).ok()?))) else {
        return;
    };
    let wheelbase = vehicle.wheelbase.map_or(known.wheelbase, |wheelbase| wheelbase.si());
    // a = l · a_c/l_c of the class
    let ahead = wheelbase * known.cg_to_front_axle / known.wheelbase;
    for (measure, given, value) in [
        (AxleMeasure::Wheelbase, &vehicle.wheelbase, known.wheelbase),
        (AxleMeasure::Track, &vehicle.track, known.track),
        (AxleMeasure::CgToFrontAxle, &vehicle.cg_to_front_axle, ahead),
    ] {
        if given.is_none() {
            assumptions.push(Assumption::Axle { vehicle: id, class, measure, value });
        }
    }
}

fn of_crush(
    vehicle: VehicleId,
    crush: &Crush,
    subject: Option<&VehicleData>,
    fit_left_out: bool,
    assumptions: &mut Vec<Assumption>,
) {
    let damage = subject.and_then(|subject| subject.damage.as_ref());
    if crush.from_force_balance {
        let evidence = damage.map(|damage| &damage.evidence);
        if let Some(CrushEvidence::ForceBalance { width: InferredWidth::Bounded { .. }, .. }) = evidence {
            assumptions.push(Assumption::InferredWidth { vehicle });
        }
    } else if crush.spacing.is_none() && crush.depths.len() > 2 {
        assumptions.push(Assumption::EqualSpacing { vehicle });
    }
    let has_no_g = |line: &StiffnessLine| match line {
        StiffnessLine::Crush { g, .. } | StiffnessLine::Root { g, .. } => g.is_none(),
    };
    let derives_g = match &crush.stiffness {
        StiffnessForm::Line(line) => has_no_g(line),
        StiffnessForm::Zones(zones) => zones.iter().any(has_no_g),
        StiffnessForm::Typical(_) | StiffnessForm::Test(_) => false,
    };
    if let Some(typical) = crush.stiffness.typical()
        && let Ok(stiffness) = typical.stiffness::<f64>(crush.side)
    {
        let abg = [stiffness.a(), stiffness.b(), stiffness.g()];
        assumptions.push(Assumption::TypicalStiffness { vehicle, typical, side: crush.side, abg });
    }
    if let Ok(structure) = crush.stiffness.structure(crush.side)
        && derives_g
    {
        let g = match structure {
            SideStiffness::Uniform(stiffness) => vec![stiffness.g()],
            SideStiffness::Zones(zones) => zones.iter().map(crash3::Stiffness::g).collect(),
        };
        assumptions.push(Assumption::EnergyWithoutCrush { vehicle, g });
    }
    if let StiffnessForm::Test(test) = &crush.stiffness
        && fit_left_out
        && test.fit == Fit::default()
    {
        assumptions.push(Assumption::ExactFit { vehicle });
    }
    let acts_at_centroid = crush.moment_arm.is_none()
        && subject.is_some_and(|subject| subject.contact.is_none())
        && damage.is_some_and(|damage| damage.face.is_some());
    if acts_at_centroid && crush.offset.is_none() {
        assumptions.push(Assumption::Centred { vehicle, side: crush.side });
    }
    if crush.pdof.is_none() && (crush.oblique_angle.is_none() || crush.moment_arm.is_none()) {
        let opposite = subject.and_then(|subject| subject.force.pdof);
        assumptions.push(Assumption::Pdof { vehicle, opposite });
    }
    if crush.oblique.is_none() {
        assumptions.push(Assumption::CappedCorrection { vehicle });
    }
}
