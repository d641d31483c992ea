//! All pictures: what they show, in the units of the reader. The crate `drawing` draws them.

pub(crate) mod avoid;
mod damage;
mod energy;
pub(crate) mod estimate;
mod field;
mod momentum;
mod motion;
mod reconciliation;
pub(crate) mod recorder;
mod scene;
mod spread;
mod staged;
mod vehicle;

pub use avoid::AvoidPicture;
pub use estimate::{density, estimate_pictures};
pub use field::{estimated_against_recorded, ranks_of_recorders};
pub use motion::place_of_impact;
pub use spread::{histogram, tornado};
pub(crate) use spread::{histogram_picture, tornado_picture};
pub use staged::{computed_against_measured, reconstructed_speed};

use ::drawing::Drawing;
use ::drawing::{Axis, PlanBody, PlanPlace, PlanView, ScaleUnit, SitePlan, SitePlanError, Viewport};
use analysis::quantities::SPEED;
use analysis::{Analysis, EstimatedOutput, Failure, Judgement, Weighed};
use case::{Axes, Case, CaseFile, Faults, Purpose, Quantity, choices};
use pim_core::{Real, VehicleId};

use crate::Units;
use crate::estimates::{contradictions, told_speed};
use crate::units::Measure;
use crate::words::{self, title};

choices! {
    /// What to draw, in the order of a report. Its name is that on the command line, and [`Drawing::name`].
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Subject {
        /// Plan view at impact: outlines, contact point, crush plane, impulse, velocities, PDOF.
        Scene = "scene",
        /// Plan view of both vehicles from the approach through the impact to rest.
        Motion = "motion",
        /// Speed, yaw rate and heading of both vehicles over time, from the impact to rest.
        MotionCurves = "motion-curves",
        /// The momenta of both vehicles before and after the impact, tip to tail.
        Momentum = "momentum",
        /// Each damaged vehicle with its crush profile in place.
        Damage = "damage",
        /// Work of the normal impulse over the speed sought, with the crush energy.
        Reconciliation = "reconciliation",
        /// Where the initial kinetic energy went.
        Energy = "energy",
    }
}

impl Subject {
    /// The analysis of a case from which it is drawn: the furthest that the case allows or, if that does not
    /// have it, the motion after the impact or the geometry alone.
    ///
    /// # Errors
    /// If the case has no such analysis; [`obstacle`](Self::obstacle) says what it lacks for this subject.
    pub fn analysis(self, case: &Case) -> Result<Analysis, Failure> {
        let furthest = analysis::furthest(case);
        match (self, &furthest) {
            // What a case lacks for an impact does not prevent a drawing of its motion after the impact,
            (Self::Motion | Self::MotionCurves, Ok(analysis))
                if analysis.travel.iter().any(Option::is_some) =>
            {
                furthest
            }
            (Self::Motion | Self::MotionCurves, _) => analysis::motion(case),
            // nor of its vehicles where they touched.
            (Self::Scene, Ok(analysis)) if analysis.impact.is_none() => analysis::geometry(case).or(furthest),
            (Self::Scene | Self::Damage, Err(Failure::Case(_))) => analysis::geometry(case).or(furthest),
            _ => furthest,
        }
    }

    /// The subjects that a case has enough for, in the order of a report. Whether it also has an answer shows
    /// only when it is solved.
    #[must_use]
    pub fn of_case(case: &Case) -> Vec<Self> {
        Self::ALL.into_iter().filter(|subject| subject.obstacle(case).is_none()).collect()
    }

    /// Why the case lacks what this drawing needs; `None` if it lacks nothing.
    #[must_use]
    pub fn obstacle(self, case: &Case) -> Option<DrawingError> {
        let purpose = case.furthest_purpose();
        let find = case.reconstruct.as_ref().map(|reconstruct| reconstruct.find);
        let lacking = match purpose {
            Purpose::Reconstruct if case.is_by_momentum() => case.two_speeds().err(),
            Purpose::Reconstruct => case.reconstruction().err(),
            Purpose::Impact => case.collision().err(),
            _ => case.damage().err(),
        };
        let geometry = || case.geometry().err();
        let of_impact = |lacking: Option<Faults>| match purpose {
            Purpose::Crush => Some(DrawingError::NoImpact { subject: self }),
            _ => lacking.map(Into::into),
        };
        match self {
            Self::Scene => geometry().and_then(|geometry| match purpose {
                // Point masses touch nowhere.
                Purpose::Reconstruct if lacking.is_none() => Some(DrawingError::NoImpact { subject: self }),
                Purpose::Crush if case.impact.is_some() && !case.vehicles.iter().any(|v| v.is_absent()) => {
                    Some(geometry.into())
                }
                _ => of_impact(lacking),
            }),
            Self::Damage => match case.vehicles.iter().any(|vehicle| vehicle.crush.is_some()) {
                false => Some(DrawingError::NoDamage),
                true => lacking.filter(|_| geometry().is_some()).map(Into::into),
            },
            Self::Reconciliation => match find {
                None => Some(DrawingError::NoReconciliation),
                Some(_) if case.is_by_momentum() => Some(DrawingError::ByMomentum),
                Some(_) => of_impact(lacking),
            },
            Self::Energy => of_impact(lacking),
            Self::Momentum => match VehicleId::ALL.into_iter().find(|id| case.vehicles[id.index()].fixed) {
                Some(vehicle) => Some(DrawingError::FixedObject { vehicle }),
                None => of_impact(lacking),
            },
            Self::Motion | Self::MotionCurves => case.motion().err().and_then(|lacks| {
                let follows = purpose != Purpose::Crush
                    && lacking.is_none()
                    && case.run_out().is_some_and(|input| input.is_ok());
                (!follows).then(|| lacks.into())
            }),
        }
    }
}

/// What `deltav draw` can draw of a case, by the values of its option `--what`.
pub(crate) fn drawn(case: &Case, judgement: &Judgement) -> Vec<&'static str> {
    let can = |purpose: Purpose| {
        judgement.abilities.iter().any(|one| one.purpose == purpose && one.obstacle.is_none())
    };
    let of_avoid = if can(Purpose::Avoid) { AvoidPicture::of_case(case) } else { Vec::new() };
    let subjects = Subject::of_case(case).into_iter().map(Subject::name);
    let estimate = can(Purpose::Estimate).then_some("estimate");
    subjects.chain(estimate).chain(of_avoid.into_iter().map(AvoidPicture::name)).collect()
}

/// Why there is no drawing.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// The scene and the energy are those of an impact.
    #[error(
        "there is no {} to draw: it takes an [impact] table and {}",
        subject.name(),
        if *.subject == Subject::Scene { "heading and contact point of both vehicles" } else { "the speeds" }
    )]
    NoImpact {
        /// What was asked for.
        subject: Subject,
    },
    /// A fixed object passes the momentum on to the ground.
    #[error(
        "there is no momentum polygon to draw: vehicle {vehicle} is a fixed object, and the ground takes the momentum"
    )]
    FixedObject {
        /// Which.
        vehicle: VehicleId,
    },
    /// Nothing is damaged.
    #[error("there is no damage to draw: no vehicle of the case has a crush profile")]
    NoDamage,
    /// No speed was sought.
    #[error(
        "there is no reconciliation to draw: it shows the work of the impact over the unknown speed, and the \
         case has no [reconstruct] table"
    )]
    NoReconciliation,
    /// The speeds follow from how the vehicles left the impact.
    #[error(
        "there is no reconciliation to draw: it shows the work of the impact over one speed that the crush \
         energy decides, and the speeds of this case follow from how the vehicles left the impact"
    )]
    ByMomentum,
    /// No vehicle is followed to rest.
    #[error(
        "there is no {} to draw: the case says nothing about the path to rest; give it [surface] friction \
         and [vehicle1.after] with drag, and with rest or with speed, direction and yaw_rate", subject.name()
    )]
    NoMotion {
        /// What was asked for.
        subject: Subject,
    },
    /// The curve of the reconciliation could not be computed.
    #[error(transparent)]
    Analysis(#[from] Failure),
}

impl From<Faults> for DrawingError {
    fn from(faults: Faults) -> Self {
        Self::Analysis(faults.into())
    }
}

/// The drawing to make of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawingRequest {
    /// The subject.
    pub subject: Subject,
    /// Whether it is for readers who are not engineers, such as a jury: the vehicles by name, and their
    /// speeds before and after the impact in words; no symbols, axes or forces.
    pub plain: bool,
}

impl DrawingRequest {
    /// Whether there is a form of the subject for readers who are not engineers.
    #[must_use]
    pub fn can_be(self) -> bool {
        !self.plain || matches!(self.subject, Subject::Scene | Subject::Motion)
    }

    /// Draws it, a motion on its site plan. If the case has more evidence than an exact solution uses, the
    /// speeds of a plain drawing are those of all the evidence, `weighed`, or none if that has no answer.
    ///
    /// # Errors
    /// [`DrawingError`]: mostly that the analysis has nothing of this kind.
    pub fn draw(
        self,
        file: &CaseFile,
        analysis: &Analysis,
        weighed: Option<&Weighed>,
        units: Units,
        site_plan: Option<SitePlan>,
    ) -> Result<Drawing, DrawingError> {
        let case = &file.case;
        let plain = self.plain.then(|| VehicleId::ALL.map(|id| PlainSpeed::of(analysis, weighed, id)));
        Ok(match (self.subject, plain) {
            (Subject::Motion, plain) => motion::picture(case, analysis, units, plain, site_plan)?.draw(),
            (_, Some(speeds)) => scene::plain(case, analysis, speeds, units)?.draw(),
            (Subject::Scene, None) => scene::picture(case, analysis, units)?.draw(),
            (Subject::Damage, None) => damage::picture(case, analysis, units)?.draw(),
            (Subject::Reconciliation, None) => reconciliation::picture(file, analysis, units)?.draw(),
            (Subject::Energy, None) => energy::picture(case, analysis, units)?.draw(),
            (Subject::Momentum, None) => momentum::picture(case, analysis, units)?.draw(),
            (Subject::MotionCurves, None) => motion::curves(case, analysis, units)?.draw(),
        })
    }
}

/// Draws one subject of an analysis, in the units of the reader.
///
/// # Errors
/// [`DrawingError`]: mostly that the analysis has nothing of this kind.
pub fn drawing(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
    subject: Subject,
) -> Result<Drawing, DrawingError> {
    DrawingRequest { subject, plain: false }.draw(file, analysis, None, units, None)
}

/// Why the drawing of an exact solution is not the answer; empty if it is.
pub(crate) fn caveat(analysis: &Analysis) -> String {
    let Some(why) = analysis.why_not_exact() else { return String::new() };
    let reason = if !why.refuted_by.is_empty() {
        "its own checks refute it"
    } else if why.is_contradicted {
        "other evidence of the case contradicts it"
    } else if !why.left_aside.is_empty() {
        "the case has more evidence than it uses"
    } else if !why.nearly_stood.is_empty() {
        "a vehicle that it has move backward was probably stationary"
    } else if why.takes_bound {
        "its crush energy is only an upper bound"
    } else {
        "it does not correct the average error of its crush energies"
    };
    format!("Exact solution by {}, not the answer: {reason}.", words::solution(analysis.solved_by()))
}

/// A description with the caveat of the drawing.
fn with_caveat(description: String, caveat: &str) -> String {
    if caveat.is_empty() { description } else { format!("{description} {caveat}") }
}

/// The speed before the impact for readers who are not engineers.
#[derive(Clone, Copy)]
enum PlainSpeed<'a> {
    /// That of the exact solution, which is the answer.
    Exact,
    /// The estimate from all the evidence, and whether pieces of that contradict the others.
    Weighed(&'a EstimatedOutput, bool),
    /// The case gives it.
    Given,
    /// The exact solution is not the answer, and nothing else is.
    Unknown,
}

impl<'a> PlainSpeed<'a> {
    fn of(analysis: &Analysis, weighed: Option<&'a Weighed>, vehicle: VehicleId) -> Self {
        if analysis.why_not_exact().is_none() {
            return Self::Exact;
        }
        let of_found = analysis.found.as_ref().map(|found| found.unknown);
        let sought = of_found.or_else(|| analysis.both.as_ref()?.sought());
        if sought.is_some_and(|sought| sought != vehicle) {
            return Self::Given;
        }
        let weighed = weighed.filter(|weighed| weighed.is_answer());
        let found = weighed.and_then(|weighed| {
            let is_contradicted = !contradictions(&weighed.estimated.pieces).is_empty();
            Some(Self::Weighed(weighed.output(SPEED.of_vehicle(vehicle))?, is_contradicted))
        });
        found.unwrap_or(Self::Unknown)
    }

    /// In words, like `before: 40.5 km/h (95 %: 37.7 to 43.5 km/h)`.
    fn label(self, exact: f64, units: Units) -> Option<String> {
        match self {
            Self::Exact | Self::Given => Some(format!("before: {}", units.speed_in_words(exact))),
            Self::Weighed(found, _) => Some(format!("before: {}", told_speed(found, units))),
            Self::Unknown => None,
        }
    }

    /// (m/s) along the heading; `None` if the evidence does not determine it.
    fn along(self, exact: f64) -> Option<f64> {
        match self {
            Self::Exact | Self::Given => Some(exact),
            Self::Weighed(found, _) if found.varies() && !found.is_told() => None,
            Self::Weighed(found, _) => Some(found.posterior.median.value),
            Self::Unknown => None,
        }
    }

    /// The caveat below the title of a drawing with the speeds of both vehicles.
    fn caveat(speeds: [Self; 2]) -> &'static str {
        let is_open =
            |speed: &Self| matches!(speed, Self::Weighed(found, _) if found.varies() && !found.is_told());
        if speeds.iter().any(is_open) {
            "All the evidence together does not determine the speed that is not drawn: the report gives its range."
        } else if speeds.iter().any(|speed| matches!(speed, Self::Weighed(_, true))) {
            "Speeds by all the evidence together, each with the range that contains it with a probability of 95 % under \
             the assumptions of the report. Some pieces of the evidence contradict the others: the report says which."
        } else if speeds.iter().any(|speed| matches!(speed, Self::Weighed(_, false))) {
            "Speeds by all the evidence together, each with the range that contains it with a probability of 95 % under \
             the assumptions of the report."
        } else if speeds.iter().any(|speed| matches!(speed, Self::Unknown)) {
            "Without the speeds to be found: the exact solution is not the answer."
        } else {
            ""
        }
    }
}

/// Draws the scene or the motion, all of it or the part within a viewport, and returns the places of
/// everything in it: in metres, y to the left of x whatever the axes of the case. In a scene the contact
/// point is the origin.
///
/// # Errors
/// [`DrawingError`]: the analysis has nothing of this kind; for any other subject, that it has no motion.
pub fn plan_view(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
    subject: Subject,
    viewport: Option<Viewport>,
) -> Result<(Drawing, PlanView), DrawingError> {
    match subject {
        Subject::Scene => Ok(scene::picture(&file.case, analysis, units)?.draw_within(viewport)),
        Subject::Motion => {
            Ok(motion::picture(&file.case, analysis, units, None, None)?.draw_within(viewport))
        }
        subject => Err(DrawingError::NoMotion { subject }),
    }
}

/// Both vehicles at times of their motion.
#[derive(Clone, Debug)]
pub struct Frames {
    /// (s) how long the last vehicle moves after the impact.
    pub duration: f64,
    /// Each time (s) since the impact, less than zero before it, with vehicles 1 and 2 then.
    pub frames: Vec<(f64, [Option<PlanBody>; 2])>,
}

/// The positions of both vehicles, as in the drawing of the motion; `times` chooses the times (s) since the
/// impact from the duration (s) of the motion.
///
/// # Errors
/// [`DrawingError::NoMotion`].
pub fn frames(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
    times: impl FnOnce(f64) -> Vec<f64>,
) -> Result<Frames, DrawingError> {
    let picture = motion::picture(&file.case, analysis, units, None, None)?;
    let duration = picture.duration();
    let frames = times(duration).into_iter().map(|time| (time, picture.bodies_at(time))).collect();
    Ok(Frames { duration, frames })
}

/// A site plan, a PNG or a JPEG, in its place: its lower left corner (m) and the angle (rad) from the scene's
/// x axis to its lower edge are in the axes of the case; the lower edge is `width` (m) long.
///
/// # Errors
/// [`SitePlanError`].
pub fn site_plan(
    picture: Vec<u8>,
    axes: Axes,
    [x, y]: [f64; 2],
    angle: f64,
    width: f64,
) -> Result<SitePlan, SitePlanError> {
    let (sin, cos) = Real::sin_cos(axes.lateral(angle));
    SitePlan::new(picture, PlanPlace { corner: [x, axes.lateral(y)], along: [cos, sin], width })
}

/// The site plan that a case names, from its file as the caller read it; `None` if it names none.
///
/// # Errors
/// [`SitePlanError`].
pub fn site_plan_of(case: &Case, picture: Vec<u8>) -> Result<Option<SitePlan>, SitePlanError> {
    let Some(plan) = &case.site_plan else { return Ok(None) };
    let corner = [plan.corner.x.si(), plan.corner.y.si()];
    let angle = plan.angle.as_ref().map_or(0.0, Quantity::si);
    site_plan(picture, case.axes, corner, angle, plan.width.si()).map(Some)
}

/// An axis with its unit in the label.
fn axis(units: Units, words: &str, quantity: Measure) -> Axis {
    Axis { title: format!("{words}, {}", units.name(quantity)), unit: units.size(quantity) }
}

/// A unit of the reader, for a scale bar.
fn scale_unit(units: Units, quantity: Measure) -> ScaleUnit {
    ScaleUnit { name: units.name(quantity).to_owned(), size: units.size(quantity) }
}
