//! Additions of a report to the analysis itself.

use std::ops::ControlFlow;

use ::uncertainty::{SamplingMethod, Settings};
use inputs::Case;

use crate::analysis::Analysis;
use crate::commands::{sensitivity, uncertainty};
use crate::failure::Failure;
use crate::sensitivity::{Sensitivity, Sweep};
use crate::uncertainty::{Plan, Stage, Uncertainty, is_searched_back, is_uncertain};

/// Default number of samples: enough for three digits, in a blink.
pub const SAMPLES: usize = 100_000;

/// Default number of samples if the vehicles are traced back from rest: each takes some milliseconds. Their
/// 95 % interval is known to a few per cent of its width.
pub const BACKWARD_SAMPLES: usize = 1_000;

/// Samples of a report on a case with very many numbers, all of which every sample uses: the minimum, and the
/// maximum of samples times numbers, some seconds' work. The report states the number of samples; any other
/// case has the default number.
const LEAST_REPORT_SAMPLES: usize = 500;
const REPORT_NUMBERS: usize = 100_000_000;

/// [`SAMPLES`], or [`BACKWARD_SAMPLES`] if each is traced back from rest.
#[must_use]
pub fn usual_samples(case: &Case) -> usize {
    if is_searched_back(case) { BACKWARD_SAMPLES } else { SAMPLES }
}

/// The effects of the uncertain inputs on an analysis.
#[derive(Debug, Default)]
pub struct Beside {
    /// If the case has uncertain inputs, and the analysis is one of an impact or a motion.
    pub uncertainty: Option<Uncertainty>,
    /// If, in addition, a speed or a motion was found.
    pub sensitivity: Option<Sensitivity>,
}

/// With more zones of ground than this, all of which are examined at every step, fewer samples are taken: in
/// inverse proportion to the number of zones, but not below the minimum. An estimate then takes minutes.
const ZONES: usize = 10;
const LEAST_BACKWARD_SAMPLES: usize = 100;

/// The additions of a report to an analysis of the case.
///
/// `progress` receives the stage, the work done of it and its total, and may end the sampling.
///
/// # Errors
/// [`Failure`], as [`uncertainty()`] and [`sensitivity()`].
pub fn beside(
    case: &Case,
    analysis: &Analysis,
    progress: &mut (dyn FnMut(Stage, usize, usize) -> ControlFlow<()> + Send),
) -> Result<Beside, Failure> {
    let is_followed = analysis.travel.iter().any(Option::is_some);
    // Only the motion is propagated if the case has nothing else to find.
    let is_motion = is_followed && case.impact.is_none() && case.reconstruct.is_none();
    if !((analysis.exchange().is_some() || is_motion) && is_uncertain(case)) {
        return Ok(Beside::default());
    }
    let samples =
        if is_followed { backward_samples(zones(case)) } else { report_samples(case.inputs().len()) };
    let plan = Plan { settings: Settings::new(SamplingMethod::MonteCarlo, samples, 1), index_rows: None };
    let uncertainty = uncertainty(case, &plan, progress)?;
    let is_differentiated = analysis.is_reconstruction() || is_motion;
    let sensitivity = is_differentiated.then(|| sensitivity(case, Sweep::default())).transpose()?;
    Ok(Beside { uncertainty: Some(uncertainty), sensitivity })
}

/// Whether an estimate is quick enough to be added to an exact solution without a request: it follows some
/// 10,000 motions, and each has to find the borders of all zones that it meets.
#[must_use]
pub fn is_estimated_beside(case: &Case) -> bool {
    zones(case) <= ZONES
}

fn zones(case: &Case) -> usize {
    case.surface.as_ref().map_or(0, |surface| surface.zones.len())
}

fn backward_samples(zones: usize) -> usize {
    (BACKWARD_SAMPLES * ZONES / zones.max(ZONES)).max(LEAST_BACKWARD_SAMPLES)
}

fn report_samples(numbers: usize) -> usize {
    (REPORT_NUMBERS / numbers.max(1)).clamp(LEAST_REPORT_SAMPLES, SAMPLES)
}

#[cfg(test)]
mod tests {
    use super::{backward_samples, report_samples};

    #[test]
    fn a_report_on_very_many_numbers_takes_fewer_samples() {
        assert_eq!([0, 31, 1000].map(report_samples), [100_000; 3]);
        assert_eq!(report_samples(10_000), 10_000);
        assert_eq!([0, 10, 20, 100, 1000].map(backward_samples), [1000, 1000, 500, 100, 100]);
        assert_eq!(report_samples(1_000_000), 500);
    }
}
