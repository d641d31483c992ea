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

impl Watch {
    /// Whether these numbers of a sample with an answer are doubtful.
    fn is_doubtful(self, input: impl Fn(usize) -> f64, output: impl Fn(usize) -> f64) -> bool {
        match self {
            Self::NegativeOutput(place) => output(place) < 0.0,
            Self::OutputBeyond(place, limit) => output(place).abs() > limit,
            Self::NegativeInput(place) => input(place) < 0.0,
            Self::Restitution { input: place, closing } => {
                input(place) > HIGH_RESTITUTION && output(closing) > FAST_CLOSING
            }
        }
    }

    fn reads_input(self) -> bool {
        matches!(self, Self::NegativeInput(_) | Self::Restitution { .. })
    }
}

fn marks(case: &Case, sample: &Sample<'_>, inputs: &[UncertainInput]) -> Vec<Mark> {
    let mut marks = Vec::new();
    let mut watch = |doubt: Doubt, number: Watch| marks.push(Mark { doubt, number });
    let output = |wanted: Output| sample.outputs.iter().position(|output| *output == wanted);
    let input = |path: &str| inputs.iter().position(|input| input.input.path == path);
    for vehicle in VehicleId::ALL {
        let Some(place) = output(SPEED.of_vehicle(vehicle)) else { continue };
        if sample.central[place] >= 0.0 {
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
    marks
}

/// Whether this output reveals doubts.
pub(super) fn reads(output: Output) -> bool {
    output.is(&SPEED) || output.is(&IMPACT_CLOSING_SPEED)
}

/// The doubtful samples among those with an answer, whose inputs are drawn again where they count.
pub(super) fn doubtful(
    case: &Case,
    sample: &Sample<'_>,
    inputs: &[UncertainInput],
    settings: &Settings,
    propagation: &Propagation,
) -> Result<Vec<Doubtful>, InvalidRequest> {
    let marks = marks(case, sample, inputs);
    let reads_inputs = marks.iter().any(|mark| mark.number.reads_input());
    let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
    let sampler = Sampler::new(&distributions, settings)?;
    let blocks: Vec<_> = (0..).zip(propagation.reasons().chunks(LANES)).collect();
    let counted = for_each(&blocks, |(number, reasons)| {
        let first = *number * LANES;
        let is_searched = sample.is_by_crush && first < SEARCHED;
        let mut drawn = vec![Lanes::ZERO; inputs.len()];
        if reads_inputs || is_searched {
            sampler.fill(*number as u64, &mut drawn);
        }
        let answered: Vec<usize> = (0..reasons.len()).filter(|lane| reasons[*lane] == SUCCEEDED).collect();
        let count = |mark: &Mark| {
            let is_doubtful = |lane: &&usize| {
                let output = |place: usize| propagation.columns()[place][first + **lane];
                mark.number.is_doubtful(|place| drawn[place][**lane], output)
            };
            answered.iter().filter(is_doubtful).count()
        };
        let marked: Vec<usize> = marks.iter().map(count).collect();
        let searched = if is_searched { answered.len() } else { 0 };
        let several = match searched {
            0 => 0,
            _ => sample.several_speeds(settings.instructions, &drawn, answered.into_iter()),
        };
        (marked, several, searched)
    });
    let of = propagation.succeeded();
    let sum = |(place, mark): (usize, &Mark)| {
        let samples = counted.iter().map(|(marked, ..)| marked[place]).sum();
        Doubtful { doubt: mark.doubt, samples, of }
    };
    let mut found: Vec<Doubtful> = marks.iter().enumerate().map(sum).collect();
    found.push(Doubtful {
        doubt: Doubt::SeveralSpeeds,
        samples: counted.iter().map(|(_, several, _)| several).sum(),
        of: counted.iter().map(|(.., searched)| searched).sum(),
    });
    found.retain(|doubtful| doubtful.samples > 0);
    Ok(found)
}
