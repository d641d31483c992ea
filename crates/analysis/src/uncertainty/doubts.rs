//! Which samples a careful reader would doubt: those of which a single case has a warning.

use ::uncertainty::{Distribution, InvalidRequest, LANES, Lanes, Propagation, SUCCEEDED, Sampler, Settings};
use pim_core::VehicleId;

use super::{Sample, UncertainInput};
use crate::sensitivity::Output;
use crate::thresholds::{FAST_CLOSING, HIGH_RESTITUTION};
use crate::usual::Usual;

/// Samples in which [`Doubt::SeveralSpeeds`] is looked for, the first ones: all speeds of a sample take
/// longer than its answer.
const SEARCHED: usize = 4096;

/// Why a sample that has an answer is doubtful. A single case has the warning of [`code`](Self::code).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// The speed found is negative, and that at the central values is not.
    FoundBackward {
        /// Which vehicle.
        vehicle: VehicleId,
    },
    /// A given speed is negative, and its central value is not.
    GivenBackward {
        /// Which vehicle.
        vehicle: VehicleId,
    },
    /// The speed found is greater than is plausible.
    FoundTooFast {
        /// Which vehicle.
        vehicle: VehicleId,
        /// (m/s) the greatest speed that is plausible of its kind.
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

/// How many samples are doubtful for a reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubtful {
    /// The reason.
    pub doubt: Doubt,
    /// Number of samples.
    pub samples: usize,
    /// Of so many samples with an answer that were looked at.
    pub of: usize,
}

/// What is sampled that may be doubtful by itself, by its place among the inputs.
struct Watched {
    speeds: Vec<(VehicleId, usize)>,
    restitution: Option<usize>,
}

impl Watched {
    fn new(inputs: &[UncertainInput]) -> Self {
        let place = |path: &str| inputs.iter().position(|input| input.input.path == path);
        let speed = |vehicle: VehicleId| {
            let place = place(&format!("vehicle{vehicle}.speed"))?;
            let input = &inputs[place];
            // Half of the samples of a speed that is negative itself are no surprise.
            let may_be_negative = input.input.number >= 0.0 && input.distribution.quantile(0.0) < 0.0;
            may_be_negative.then_some((vehicle, place))
        };
        Self {
            speeds: VehicleId::ALL.into_iter().filter_map(speed).collect(),
            restitution: place("impact.restitution")
                .filter(|place| inputs[*place].distribution.quantile(1.0) > HIGH_RESTITUTION),
        }
    }

    fn is_empty(&self) -> bool {
        self.speeds.is_empty() && self.restitution.is_none()
    }
}

/// Whether doubts are seen by this output.
pub(super) fn reads(output: Output) -> bool {
    matches!(output, Output::Speed { .. } | Output::ClosingSpeed)
}

/// Counts the doubtful among the samples that have an answer. The counts are the same for any number of
/// threads, as they come from the samples alone.
pub(super) fn doubtful(
    sample: &Sample<'_>,
    inputs: &[UncertainInput],
    settings: &Settings,
    propagation: &Propagation,
) -> Result<Vec<Doubtful>, InvalidRequest> {
    let column = |output: Output| {
        let place = sample.outputs.iter().position(|other| *other == output)?;
        Some((sample.central[place], propagation.columns()[place].as_slice()))
    };
    let of = propagation.succeeded();
    let mut found = Vec::new();
    let mut tell = |doubt: Doubt, samples: usize, of: usize| {
        if samples > 0 {
            found.push(Doubtful { doubt, samples, of });
        }
    };
    for vehicle in VehicleId::ALL {
        let Some((central, speeds)) = column(Output::Speed { vehicle }) else { continue };
        // A sample without an answer is NaN, which is neither.
        if central >= 0.0 {
            let backward = speeds.iter().filter(|speed| **speed < 0.0).count();
            tell(Doubt::FoundBackward { vehicle }, backward, of);
        }
        let kind = sample.case.vehicles[vehicle.index()].kind.unwrap_or_default();
        let [_, limit] = Usual::of(kind).speed;
        let too_fast = speeds.iter().filter(|speed| speed.abs() > limit).count();
        tell(Doubt::FoundTooFast { vehicle, limit }, too_fast, of);
    }

    let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
    let sampler = Sampler::new(&distributions, settings)?;
    let mut block: Vec<Lanes> = vec![[0.0; LANES]; inputs.len()];
    let watched = Watched::new(inputs);
    if !watched.is_empty() {
        let closing = column(Output::ClosingSpeed).map_or(&[][..], |(_, speeds)| speeds);
        let mut backward = vec![0; watched.speeds.len()];
        let mut high_restitution = 0;
        for ((number, reasons), closing) in
            (0..).zip(propagation.reasons().chunks(LANES)).zip(closing.chunks(LANES))
        {
            sampler.fill(number, &mut block);
            for (lane, closing) in closing.iter().enumerate().filter(|(lane, _)| reasons[*lane] == SUCCEEDED)
            {
                for ((_, place), count) in watched.speeds.iter().zip(&mut backward) {
                    *count += usize::from(block[*place][lane] < 0.0);
                }
                if let Some(place) = watched.restitution {
                    let is_high = block[place][lane] > HIGH_RESTITUTION && *closing > FAST_CLOSING;
                    high_restitution += usize::from(is_high);
                }
            }
        }
        for ((vehicle, _), count) in watched.speeds.iter().zip(backward) {
            tell(Doubt::GivenBackward { vehicle: *vehicle }, count, of);
        }
        tell(Doubt::HighRestitution, high_restitution, of);
    }

    if sample.is_by_crush {
        let (mut several, mut searched) = (0, 0);
        let mut numbers = vec![0.0; inputs.len()];
        for (number, reasons) in (0..).zip(propagation.reasons().chunks(LANES)).take(SEARCHED / LANES) {
            sampler.fill(number, &mut block);
            for lane in (0..reasons.len()).filter(|lane| reasons[*lane] == SUCCEEDED) {
                for (number, column) in numbers.iter_mut().zip(&block) {
                    *number = column[lane];
                }
                searched += 1;
                several += usize::from(sample.has_several_speeds(&numbers));
            }
        }
        tell(Doubt::SeveralSpeeds, several, searched);
    }
    Ok(found)
}
