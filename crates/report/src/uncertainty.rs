//! Between what and what the answer lies: as text, JSON, samples and plots.

mod json;
mod marks;
mod page;
mod plot;
mod samples;

pub use json::uncertainty_json;
pub use page::uncertainty_text;
pub use plot::{histogram, tornado};
pub use samples::write_samples;

use ::uncertainty::{SamplingMethod, Summary};
use analysis::{Output, Reason};

use crate::units::Quantity;

/// The key of the JSON and of the samples.
fn reason_name(reason: Reason) -> &'static str {
    match reason {
        Reason::NotApproaching => "not_approaching",
        Reason::NoRoot => "no_root",
        Reason::EnergyCreated => "energy_created",
        Reason::Jam => "jam",
        Reason::Pulling => "pulling",
        Reason::NoDamageSpeed => "no_damage_speed",
        Reason::LimitBelowStart => "limit_below_start",
        Reason::Other => "other",
    }
}

/// As the command line has it.
fn method_name(method: SamplingMethod) -> &'static str {
    match method {
        SamplingMethod::MonteCarlo => "monte-carlo",
        SamplingMethod::LatinHypercube => "latin-hypercube",
        SamplingMethod::Sobol => "sobol",
        _ => "other",
    }
}

fn quantity(output: Output) -> Quantity {
    match output {
        Output::Speed { .. } | Output::DeltaV { .. } | Output::ClosingSpeed => Quantity::Speed,
        Output::Pdof { .. } => Quantity::Angle,
        Output::EnergyLoss | Output::NormalWork | Output::TangentialWork => Quantity::Energy,
    }
}

/// In a picture: people read speeds in mph and km/h.
fn pictured(output: Output) -> Quantity {
    match quantity(output) {
        Quantity::Speed => Quantity::RoadSpeed,
        other => other,
    }
}

/// How many samples lie in each of some classes of the same width.
struct Histogram {
    /// (unit of the output) lower end of the first class.
    low: f64,
    /// (unit of the output) width of a class.
    width: f64,
    counts: Vec<usize>,
    /// Samples below the first and above the last class.
    outside: [usize; 2],
}

impl Histogram {
    /// Of the middle 99 % of the samples that have an answer; `None` where they do not differ.
    fn new(column: &[f64], summary: &Summary, classes: u32) -> Option<Self> {
        let [.., widest] = summary.intervals;
        let (low, high) = (widest.low.value, widest.high.value);
        let width = (high - low) / f64::from(classes);
        if width.is_nan() || width <= 0.0 {
            return None;
        }
        let mut counts = vec![0; usize::try_from(classes).ok()?];
        let mut outside = [0; 2];
        for value in column.iter().filter(|value| !value.is_nan()) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a class between 0 and their number"
            )]
            let class = ((value - low) / width).floor().max(0.0) as usize;
            if *value < low {
                outside[0] += 1;
            } else if *value > high {
                outside[1] += 1;
            } else {
                // The upper end belongs to the last class.
                let last = counts.len() - 1;
                counts[class.min(last)] += 1;
            }
        }
        Some(Self { low, width, counts, outside })
    }
}
