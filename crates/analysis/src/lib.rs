//! From a case to a finished analysis: reconstruct, impact or crush, with every warning that a careful
//! reconstructionist would raise.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! let analysis = analysis::reconstruct(&file.case)?;
//! let found = analysis.found.as_ref().ok_or("a reconstruction finds a speed")?;
//! assert!((found.speed - 22.9).abs() < 0.05); // SAE 980025, appendix: 22.9 m/s
//! # Ok(())
//! # }
//! ```
//!
//! [`compare`] shows the answers of all impact laws and of CRASH3 side by side, and those of the damage, of
//! the momentum after the impact and of both. [`sensitivity`] shows how sensitive the answer is to each
//! input, and [`uncertainty()`] propagates input ranges to the results. [`work_curve`] gives the work of the
//! normal impulse against the speed, for a drawing.
//!
//! [`judge`] checks a case without solving it: which analyses it allows, which assumptions it needs, and the
//! warnings that need no answer.
//!
//! [`QUANTITIES`] has a row for every number that an analysis gives: its key, label, symbol, kind, source and
//! how to read it. Each is a constant of [`quantities`], and an [`Output`] is one of them of one vehicle.
//!
//! [`beside`] adds the other contents of a report to an analysis.
//!
//! The types: [`reconstruct`], [`impact`] and [`crush`] each return an [`Analysis`]: the impact, each
//! vehicle's damage, CRASH3's own answer for comparison, and [`Warning`]s. A [`Failure`] says whether the
//! case or the physics is to blame.
//!
//! `examples/reconstruct.rs` reconstructs a file and lists its warnings, `examples/influence.rs` ranks its
//! numbers.
//!
//! # What it does not do
//!
//! It adds no equation: those are in `pim-core`, `crash3` and `reconcile`. It reads no file (`case` does) and
//! writes no text (`report` does), so a case can also be built in code from the types of `inputs`.

mod analysis;
mod aside;
mod avoid;
mod beside;
mod both;
mod check;
mod checks;
mod codes;
mod columns;
mod commands;
mod compare;
mod curve;
mod damage;
mod errors;
mod estimate;
mod evidence;
mod evident;
mod exchange;
mod excluded;
mod failure;
mod found;
mod given;
mod goal;
mod headline;
mod impact;
mod judged;
mod judgement;
mod normal_force;
mod output;
mod phases;
pub mod quantities;
mod recorded;
mod seen;
mod sensitivity;
mod solve;
mod speeds;
mod thresholds;
mod travel;
mod uncertainty;
mod unsolved;
mod usual;
mod vehicle;
mod warning;

pub use self::analysis::Analysis;
pub use self::estimate::{
    Agreement, Assumed, CONTRADICTS, DOUBTFUL, EstimatePlan, EstimateStage, Estimated, EstimatedOutput,
    MISSED, NoEstimate, PieceDetail, PieceFound, SameTwice, Stood, TOLD_BELOW, UnknownNumber, Unused,
    UnusedReason, estimate, estimate_evidence, estimate_outputs, injury,
};
pub use self::evidence::{ByEvidence, EvidenceAnswer, EvidenceMethod, NoEvidence};
pub use self::uncertainty::{
    Doubt, Doubtful, ExactValue, Plan, REASONS, Reason, SampleBlock, Samples, Stage, TakenAsExact,
    UncertainInput, UncertainOutput, Uncertainty, is_searched_back, is_uncertain, samples,
};
pub use avoid::{
    ActualRun, AvoidChance, AvoidCourse, AvoidInfluence, AvoidInterval, AvoidPlan, AvoidRun, AvoidScene,
    AvoidStage, Avoidance, BRAKES, Clears, DrivenBy, Enough, GIVES_WAY, Hiding, Hypothesis, Meeting,
    NEARLY_ALONG, SIGHT_LOOK_BACK, SameLine, Sight, SightIntervals, SpeedSource, Unbraked, View, avoid,
    avoid_at_once, obstacle_name, without_source,
};
pub use beside::{BACKWARD_SAMPLES, Beside, SAMPLES, beside, is_estimated_beside, usual_samples};
pub use check::{Check, CheckedQuantity, limit_factor};
pub use commands::{compare, crush, furthest, impact, reconstruct, sensitivity, uncertainty, uncertainty_of};
pub use compare::{Comparison, LawRow};
pub use curve::{WorkPoint, first_push, work_curve};
pub use damage::{Correction, Crash3};
pub use evident::Evident;
pub use exchange::{AtContact, Exchange};
pub use excluded::Impossible;
pub use failure::Failure;
pub use found::Found;
pub use headline::{FASTEST_BACK, NEARLY_STOOD, Solution, Weighed, WhyNotExact, weigh};
pub use impact::Impact;
pub use judgement::{Ability, Assumption, AxleMeasure, Judgement, assumptions, judge, nearest_class};
pub use output::{Kind, Of, Output, OutputQuantity, Values};
pub use quantities::{QUANTITIES, quantity};
pub use recorded::{ClockedSample, OfImpact, RecorderReading, VehicleReading, recorders};
pub use seen::{Seen, SeenWarning};
pub use sensitivity::{Derivative, LEAST_BY_DEGREE, MOST_BY_DEGREE, Sensitivity, Sweep, SweepRow};
pub use solve::{geometry, motion};
pub use speeds::{BothFound, BothMethod, CgLine, Combination};
pub use thresholds::{
    DELTA_V_DIFFERENCE, ENERGY_DIFFERENCE, FAST_CLOSING, FASTEST_BELIEVED, HIGH_RESTITUTION, POINT_MISSED,
};
pub use travel::{ClosedForm, Pass, SolvedSkid, THREAD_STACK, Travel, TravelOrigin, UNLIKELY_TURN};
pub use vehicle::{Damage, EnergyAlone, Inferred, Oblique, Vehicle};
pub use warning::{Drive, EnergyShown, JumpSide, Magnitude, Warning};
