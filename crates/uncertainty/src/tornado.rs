//! One input at a time, from low to high.

use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::model::{LANES, Lanes, Model, SUCCEEDED, evaluate};
use crate::run::Instructions;

/// The default probabilities of a tornado: the ends of a 95 % interval.
pub const TORNADO_PROBABILITIES: [f64; 2] = [0.025, 0.975];

/// The outputs with an input at one end of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// (unit of the input) value of the input.
    pub input: f64,
    /// The outputs, or the reason code if there are none.
    pub outputs: Result<Vec<f64>, u8>,
}

/// The effect of one input while all others keep their central values.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Index of the input.
    pub input: usize,
    /// The end at the lower probability.
    pub low: End,
    /// The end at the upper probability.
    pub high: End,
}

impl Bar {
    /// (unit of the output) change of an output from the low to the high end; `None` if an end has no answer.
    #[must_use]
    pub fn swing(&self, output: usize) -> Option<f64> {
        match (&self.low.outputs, &self.high.outputs) {
            (Ok(low), Ok(high)) => Some(high.get(output)? - low.get(output)?),
            _ => None,
        }
    }
}

/// The bars of all inputs, in order, and the outputs at the central values.
#[derive(Clone, Debug, PartialEq)]
pub struct Tornado {
    /// The outputs with all inputs at their central values, or the reason why there are none.
    pub central: Result<Vec<f64>, u8>,
    /// One for each input.
    pub bars: Vec<Bar>,
}

impl Tornado {
    /// The bars in plotting order for one output: those without an answer first, then from the longest to the
    /// shortest.
    #[must_use]
    pub fn ranked(&self, output: usize) -> Vec<&Bar> {
        let mut bars: Vec<&Bar> = self.bars.iter().collect();
        let length = |bar: &Bar| bar.swing(output).map_or(f64::INFINITY, f64::abs);
        bars.sort_by(|first, second| length(second).total_cmp(&length(first)));
        bars
    }
}

/// Sets each input in turn to the quantiles at two probabilities, and all others to `central`.
///
/// # Errors
/// If there are no inputs, if `central` has a different length, or if the probabilities are not 0 < low <
/// high < 1.
pub fn tornado<M: Model>(
    model: &M,
    inputs: &[Distribution],
    central: &[f64],
    [low, high]: [f64; 2],
) -> Result<Tornado, InvalidRequest> {
    if inputs.is_empty() {
        return Err(InvalidRequest::NoInputs);
    }
    if central.len() != inputs.len() {
        let (expected, given) = (inputs.len(), central.len());
        return Err(InvalidRequest::Length { what: "central value", expected, given });
    }
    if !(0.0 < low && low < high && high < 1.0) {
        return Err(InvalidRequest::Probabilities { low, high });
    }

    let mut points = vec![(None, 0.0)];
    for (input, distribution) in inputs.iter().enumerate() {
        points.extend([low, high].map(|share| (Some(input), distribution.quantile(share))));
    }
    let mut answers = Vec::with_capacity(points.len());
    for block in points.chunks(LANES) {
        let mut columns: Vec<Lanes> = central.iter().map(|&value| Lanes::splat(value)).collect();
        for (lane, &(input, value)) in block.iter().enumerate() {
            if let Some(input) = input {
                columns[input][lane] = value;
            }
        }
        let mut outputs = vec![Lanes::ZERO; model.outputs()];
        let mut reasons = [SUCCEEDED; LANES];
        evaluate(Instructions::best(), model, &columns, &mut outputs, &mut reasons);
        answers.extend((0..block.len()).map(|lane| match reasons[lane] {
            SUCCEEDED => Ok(outputs.iter().map(|column| column[lane]).collect()),
            reason => Err(reason),
        }));
    }

    let mut ends = points.into_iter().zip(answers).map(|((_, input), outputs)| End { input, outputs });
    let central = ends.next().map_or(Ok(Vec::new()), |end| end.outputs);
    let bars = (0..inputs.len())
        .flat_map(|input| Some(Bar { input, low: ends.next()?, high: ends.next()? }))
        .collect();
    Ok(Tornado { central, bars })
}
