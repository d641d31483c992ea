//! Samples that a careful reader would doubt: those for which a single case has a warning.

use ::uncertainty::{
    Distribution, InvalidRequest, LANES, Lanes, Propagation, SUCCEEDED, Sampler, Settings, for_each,
};
use inputs::Case;
use pim_core::VehicleId;

use super::{Sample, UncertainInput};
use crate::output::Output;
use crate::quantities::{IMPACT_CLOSING_SPEED, SPEED};
use crate::thresholds::{FAST_CLOSING, HIGH_RESTITUTION};
use crate::usual::Usual;

/// Number of samples, from the first, that are searched for [`Doubt::SeveralSpeeds`]: all speeds of a sample
/// take longer than its answer. At least as many are kept of any run.
const SEARCHED: usize = 4096;

/// Why a sample with an answer is doubtful. A single case has the warning of [`code`](Self::code).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// The speed found is negative, and that at the central values is not.
    FoundBackward {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// A given speed is negative, and its central value is not.
    GivenBackward {
        /// The vehicle.
        vehicle: VehicleId,
    },
    /// The speed found is implausibly high.
    FoundTooFast {
        /// The vehicle.
        vehicle: VehicleId,
        /// (m/s) the highest plausible speed of its kind.
        limit: f64,
    },
    /// More than one speed gives the crush energy.
    SeveralSpeeds,
    /// The restitution is greater than usual at the closing speed.
    HighRestitution,
}

impl Doubt {
    /// The code of the warning of a single case.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::FoundBackward { .. } | Self::GivenBackward { .. } => "moves-backward",
            Self::FoundTooFast { .. } => "implausible",
            Self::SeveralSpeeds => "several-speeds",
            Self::HighRestitution => "high-restitution",
        }
    }
}

/// Number of doubtful samples for a reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubtful {
    /// The reason.
    pub doubt: Doubt,
    /// Number of samples.
    pub samples: usize,
    /// Number of samples with an answer that were examined.
    pub of: usize,
}

/// Counted while the samples are drawn, so none has to be kept for it.
#[derive(Debug, Default)]
pub(super) struct Watched {
    marks: Vec<Mark>,
}

/// A number that makes a sample doubtful beyond a limit.
#[derive(Clone, Copy, Debug)]
struct Mark {
    doubt: Doubt,
    number: Watch,
}

/// The number, by its index among the outputs or the inputs.
#[derive(Clone, Copy, Debug)]
enum Watch {
    /// An output below zero.
    NegativeOutput(usize),
    /// An output larger in size than the limit.
    OutputBeyond(usize, f64),
    /// An input below zero.
    NegativeInput(usize),
    /// A restitution above the usual one in a collision with a high closing speed, which is the output.
    Restitution { input: usize, closing: usize },
}

impl Watched {
    pub(super) fn new(case: &Case, inputs: &[UncertainInput], outputs: &[Output], central: &[f64]) -> Self {
        let mut marks = Vec::new();
        let mut watch = |doubt: Doubt, number: Watch| marks.push(Mark { doubt, number });
        let output = |wanted: Output| outputs.iter().position(|output| *output == wanted);
        let input = |path: &str| inputs.iter().position(|input| input.input.path == path);
        for vehicle in VehicleId::ALL {
            let Some(place) = output(SPEED.of_vehicle(vehicle)) else { continue };
            if central[place] >= 0.0 {
                watch(Doubt::FoundBackward { vehicle }, Watch::NegativeOutput(place));
            }
            let kind = case.vehicles[vehicle.index()].kind.unwrap_or_default();
            let [_, limit] = Usual::of(kind).speed;
            watch(Doubt::FoundTooFast { vehicle, limit }, Watch::OutputBeyond(place, limit));
        }
        for vehicle in VehicleId::ALL {
            let Some(place) = input(&format!("vehicle{vehicle}.speed")) else { continue };
            let UncertainInput { input, distribution, .. } = &inputs[place];
            // If the speed itself is negative, half of its samples are expected to be.
            if input.number >= 0.0 && distribution.quantile(0.0) < 0.0 {
                watch(Doubt::GivenBackward { vehicle }, Watch::NegativeInput(place));
            }
        }
        let restitution = input("impact.restitution")
            .filter(|place| inputs[*place].distribution.quantile(1.0) > HIGH_RESTITUTION);
        if let (Some(input), Some(closing)) = (restitution, output(IMPACT_CLOSING_SPEED.of_collision())) {
            watch(Doubt::HighRestitution, Watch::Restitution { input, closing });
        }
        Self { marks }
    }

    pub(super) fn len(&self) -> usize {
        self.marks.len()
    }

    /// Counts the samples of a block for each mark separately.
    #[inline(always)]
    pub(super) fn tally(&self, inputs: &[Lanes], outputs: &[Lanes], reasons: &[u8], tallies: &mut [usize]) {
        for (Mark { number, .. }, tally) in self.marks.iter().zip(tallies) {
            let none = &Lanes::ZERO;
            *tally += match *number {
                Watch::NegativeOutput(place) => {
                    count(reasons, [&outputs[place], none], |speed, _| speed < 0.0)
                }
                Watch::OutputBeyond(place, limit) => {
                    count(reasons, [&outputs[place], none], |speed, _| speed.abs() > limit)
                }
                Watch::NegativeInput(place) => count(reasons, [&inputs[place], none], |speed, _| speed < 0.0),
                Watch::Restitution { input, closing } => {
                    count(reasons, [&inputs[input], &outputs[closing]], |restitution, closing| {
                        (restitution > HIGH_RESTITUTION) & (closing > FAST_CLOSING)
                    })
                }
            };
        }
    }
}

/// Number of samples with an answer whose numbers are marked, branch-free, so that the loop is vectorised.
#[inline(always)]
fn count(reasons: &[u8], [first, second]: [&Lanes; 2], is_marked: impl Fn(f64, f64) -> bool) -> usize {
    let numbers = first.iter().zip(second);
    let marked = reasons
        .iter()
        .zip(numbers)
        .map(|(reason, (first, second))| usize::from((*reason == SUCCEEDED) & is_marked(*first, *second)));
    marked.sum()
}

/// Whether this output reveals doubts.
pub(super) fn reads(output: Output) -> bool {
    output.is(&SPEED) || output.is(&IMPACT_CLOSING_SPEED)
}

/// The doubtful samples among those with an answer. The counts do not depend on the number of threads: they
/// come from the samples alone.
pub(super) fn doubtful(
    sample: &Sample<'_>,
    inputs: &[UncertainInput],
    settings: &Settings,
    propagation: &Propagation,
) -> Result<Vec<Doubtful>, InvalidRequest> {
    let of = propagation.succeeded();
    let counted = sample.watched.marks.iter().zip(propagation.tallies());
    let mut found: Vec<Doubtful> = counted
        .filter(|(_, samples)| **samples > 0)
        .map(|(mark, samples)| Doubtful { doubt: mark.doubt, samples: *samples, of })
        .collect();
    if sample.is_by_crush {
        let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
        let sampler = Sampler::new(&distributions, settings)?;
        let blocks: Vec<_> = (0..).zip(propagation.reasons().chunks(LANES)).take(SEARCHED / LANES).collect();
        let counted = for_each(&blocks, |(number, reasons)| {
            let mut block = vec![Lanes::ZERO; inputs.len()];
            sampler.fill(*number, &mut block);
            let answered = || (0..reasons.len()).filter(|lane| reasons[*lane] == SUCCEEDED);
            (sample.several_speeds(settings.instructions, &block, answered()), answered().count())
        });
        let several = counted.iter().map(|(several, _)| several).sum();
        let searched = counted.iter().map(|(_, searched)| searched).sum();
        if several > 0 {
            found.push(Doubtful { doubt: Doubt::SeveralSpeeds, samples: several, of: searched });
        }
    }
    Ok(found)
}
