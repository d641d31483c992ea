//! The contribution of each input to the variance of an output.
//!
//! # References
//!
//! A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto and S. Tarantola, *Variance based sensitivity
//! analysis of model output*, Comput. Phys. Commun. 181 (2010): the sampling, and table 2 (b) and (f) for the
//! estimators, which are those of M. J. W. Jansen, *Analysis of variance designs for model output*, Comput.
//! Phys. Commun. 117 (1999). B. Efron and R. J. Tibshirani, *An Introduction to the Bootstrap* (1993),
//! chapter 11: the jackknife.

use std::ops::Range;

use crate::distribution::Distribution;
use crate::error::InvalidRequest;
use crate::limits::REPLICATES;
use crate::model::{Failures, LANES, Lanes, Model, SUCCEEDED, count_failures, evaluate};
use crate::points::Points;
use crate::run::{Instructions, Progress, Span, in_order};
use crate::sampler::{Settings, fill};

/// Student's t for a two-sided 95 % interval with 15 degrees of freedom, one less than the replicates.
const STUDENT_95: f64 = 2.131_449_545_559_323;

/// Number of blocks that a thread takes at a time, unless there would be too many spans.
const SPAN_BLOCKS: usize = 16;
/// Maximum number of spans: the sums of each are kept until all are done.
const MAX_SPANS: usize = 256;

/// A sensitivity index and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// Fraction of the variance. With few samples it may lie below 0 or above 1, by about the standard error.
    pub value: f64,
    /// Its standard error, by the jackknife over [`REPLICATES`] groups of rows; `None` if a group has no
    /// rows.
    pub standard_error: Option<f64>,
}

impl Index {
    /// The 95 % confidence interval.
    #[must_use]
    pub fn interval95(&self) -> Option<[f64; 2]> {
        let half = STUDENT_95 * self.standard_error?;
        Some([self.value - half, self.value + half])
    }
}

/// Indices of one input for one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indices {
    /// Sᵢ: the fraction of the variance that would vanish if only this input were known.
    pub first_order: Index,
    /// Tᵢ: the fraction that would remain if all others were known; greater than Sᵢ by the interactions of
    /// this input with others.
    pub total: Index,
}

/// The result of a sensitivity analysis.
#[derive(Clone, Debug)]
pub struct SobolIndices {
    requested: usize,
    rows: usize,
    used: usize,
    failures: Failures,
    evaluations: usize,
    indices: Vec<Option<Vec<Indices>>>,
}

impl SobolIndices {
    /// Number of rows requested.
    #[must_use]
    pub fn requested(&self) -> usize {
        self.requested
    }

    /// Number of rows evaluated: fewer than requested if the run was ended early.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of rows in which all samples have an answer. Only these count.
    #[must_use]
    pub fn used(&self) -> usize {
        self.used
    }

    /// Number of evaluations of the model in these rows: inputs + 2 in each.
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// Number of evaluations without an answer, by the model's reason code, or [`crate::NOT_FINITE`].
    #[must_use]
    pub fn failures(&self) -> &Failures {
        &self.failures
    }

    /// The indices of all inputs, for each output; `None` if the output does not vary, or if fewer than two
    /// rows could be used.
    #[must_use]
    pub fn indices(&self) -> &[Option<Vec<Indices>>] {
        &self.indices
    }
}

/// Variance-based sensitivity: evaluates the model inputs + 2 times in each of `settings.samples` rows.
///
/// A row consists of two independent samples A and B, and for each input the sample A with this one input
/// from B. Sobol' points work best if the number of rows is a power of two; they need two dimensions for each
/// input.
///
/// # Errors
/// If there are no inputs or too many, or if the number of rows is out of range.
pub fn sensitivity<M: Model>(
    model: &M,
    inputs: &[Distribution],
    settings: &Settings,
    progress: &mut Progress<'_>,
) -> Result<SobolIndices, InvalidRequest> {
    if inputs.is_empty() {
        return Err(InvalidRequest::NoInputs);
    }
    let points = Points::new(settings.method, settings.seed, 2 * inputs.len(), settings.samples).map_err(
        |refusal| match refusal {
            InvalidRequest::Samples { samples: rows } | InvalidRequest::TooManySamples { samples: rows } => {
                InvalidRequest::Rows { rows }
            }
            refusal => refusal,
        },
    )?;
    let instructions = settings.instructions;
    let design = Design { model, inputs, points, shifts: shifts(instructions, model, inputs), instructions };

    let blocks = settings.samples.div_ceil(LANES);
    let span_blocks = SPAN_BLOCKS.max(blocks.div_ceil(MAX_SPANS));
    let spans = (0..blocks)
        .step_by(span_blocks)
        .map(|first| {
            let start = first * LANES;
            let end = settings.samples.min(start + span_blocks * LANES);
            Span { samples: end - start, work: start..end }
        })
        .collect();
    let parts = in_order(spans, |rows| design.evaluate(rows), progress);

    let mut all = Part::new(inputs.len(), model.outputs());
    for part in parts {
        all.add(part);
    }
    let used = all.sums.first().map_or(0, |sums| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let rows = sums.groups.iter().map(|group| group.rows).sum::<f64>() as usize;
        rows
    });
    Ok(SobolIndices {
        requested: settings.samples,
        rows: all.rows,
        used,
        evaluations: all.rows * (inputs.len() + 2),
        failures: all.failures,
        indices: all.sums.iter().map(Sums::indices).collect(),
    })
}

/// The outputs with all inputs at their medians, a central value: squares of the differences from it lose no
/// digits.
fn shifts<M: Model>(instructions: Instructions, model: &M, inputs: &[Distribution]) -> Vec<f64> {
    let columns: Vec<Lanes> = inputs.iter().map(|input| Lanes::splat(input.quantile(0.5))).collect();
    let mut outputs = vec![Lanes::ZERO; model.outputs()];
    let mut reasons = [SUCCEEDED; LANES];
    evaluate(instructions, model, &columns, &mut outputs, &mut reasons);
    outputs.iter().map(|column| if reasons[0] == SUCCEEDED { column[0] } else { 0.0 }).collect()
}

/// Data common to all rows.
struct Design<'a, M> {
    model: &'a M,
    inputs: &'a [Distribution],
    points: Points,
    shifts: Vec<f64>,
    instructions: Instructions,
}

impl<M: Model> Design<'_, M> {
    fn evaluate(&self, rows: Range<usize>) -> Part {
        let inputs = self.inputs.len();
        let outputs = self.model.outputs();
        let mut part = Part::new(inputs, outputs);
        let mut columns = vec![Lanes::ZERO; 2 * inputs];
        // Outputs of A, of B, and of A with each input from B.
        let mut answers = vec![Lanes::ZERO; (inputs + 2) * outputs];
        let mut reasons = [SUCCEEDED; LANES];
        for start in rows.clone().step_by(LANES) {
            let count = LANES.min(rows.end - start);
            fill(self.instructions, &self.points, self.inputs, (start / LANES) as u64, &mut columns);
            let (a, b) = columns.split_at_mut(inputs);

            let mut complete = [true; LANES];
            for sample in 0..inputs + 2 {
                let answers = &mut answers[sample * outputs..(sample + 1) * outputs];
                let mut answer =
                    |inputs: &[Lanes]| evaluate(self.instructions, self.model, inputs, answers, &mut reasons);
                match sample.checked_sub(2) {
                    None if sample == 0 => answer(a),
                    None => answer(b),
                    Some(input) => {
                        std::mem::swap(&mut a[input], &mut b[input]);
                        answer(a);
                        std::mem::swap(&mut a[input], &mut b[input]);
                    }
                }
                count_failures(&mut part.failures, &reasons[..count]);
                for (complete, reason) in complete.iter_mut().zip(&reasons) {
                    *complete &= *reason == SUCCEEDED;
                }
            }
            complete[count..].fill(false);
            part.rows += count;
            for (output, sums) in part.sums.iter_mut().enumerate() {
                let of = |sample: usize| &answers[sample * outputs + output];
                let from_b = (0..inputs).map(|input| of(input + 2));
                sums.note(of(0), of(1), from_b, &complete, self.shifts[output]);
            }
        }
        part
    }
}

/// Sums over a number of rows.
struct Part {
    rows: usize,
    failures: Failures,
    sums: Vec<Sums>,
}

impl Part {
    fn new(inputs: usize, outputs: usize) -> Self {
        Self { rows: 0, failures: Failures::new(), sums: vec![Sums::new(inputs); outputs] }
    }

    fn add(&mut self, other: Self) {
        self.rows += other.rows;
        for (reason, count) in other.failures {
            *self.failures.entry(reason).or_default() += count;
        }
        for (sums, more) in self.sums.iter_mut().zip(other.sums) {
            for (group, more) in sums.groups.iter_mut().zip(more.groups) {
                group.add(&more);
            }
        }
    }
}

/// Sums of one output, separate for each group of rows.
#[derive(Clone)]
struct Sums {
    groups: Vec<Group>,
}

#[derive(Clone)]
struct Group {
    rows: f64,
    /// Σ (f(A) + f(B)), and of the squares, less the shift.
    values: f64,
    squares: f64,
    /// For each input, Σ (f(B) − f(Aᵢ))² and Σ (f(A) − f(Aᵢ))², Aᵢ being A with input i from B.
    differences: Vec<(f64, f64)>,
}

impl Group {
    fn new(inputs: usize) -> Self {
        Self { rows: 0.0, values: 0.0, squares: 0.0, differences: vec![(0.0, 0.0); inputs] }
    }

    fn add(&mut self, other: &Self) {
        self.rows += other.rows;
        self.values += other.values;
        self.squares += other.squares;
        for (sum, more) in self.differences.iter_mut().zip(&other.differences) {
            sum.0 += more.0;
            sum.1 += more.1;
        }
    }

    /// Variance of the output over A and B.
    fn variance(&self) -> f64 {
        let count = 2.0 * self.rows;
        // V = (Σf² − (Σf)²/m)/(m − 1)
        (self.squares - self.values * self.values / count) / (count - 1.0)
    }

    /// First-order and total index of an input.
    fn indices(&self, input: usize) -> (f64, f64) {
        let (to_b, to_a) = self.differences[input];
        let scale = 2.0 * self.rows * self.variance();
        // Sᵢ = 1 − Σ (f(B) − f(Aᵢ))²/(2nV), Tᵢ = Σ (f(A) − f(Aᵢ))²/(2nV)
        (1.0 - to_b / scale, to_a / scale)
    }
}

impl Sums {
    fn new(inputs: usize) -> Self {
        Self { groups: vec![Group::new(inputs); REPLICATES] }
    }

    /// Adds the complete rows of a block.
    #[inline(always)]
    fn note<'a>(
        &mut self,
        a: &Lanes,
        b: &Lanes,
        from_b: impl Iterator<Item = &'a Lanes>,
        complete: &[bool; LANES],
        shift: f64,
    ) {
        for (lane, _) in complete.iter().enumerate().filter(|(_, complete)| **complete) {
            let group = &mut self.groups[lane % REPLICATES];
            let (a, b) = (a[lane] - shift, b[lane] - shift);
            group.rows += 1.0;
            group.values += a + b;
            group.squares += a * a + b * b;
        }
        for (input, mixed) in from_b.enumerate() {
            for (lane, _) in complete.iter().enumerate().filter(|(_, complete)| **complete) {
                let sums = &mut self.groups[lane % REPLICATES].differences[input];
                let (to_b, to_a) = (b[lane] - mixed[lane], a[lane] - mixed[lane]);
                sums.0 += to_b * to_b;
                sums.1 += to_a * to_a;
            }
        }
    }

    fn indices(&self) -> Option<Vec<Indices>> {
        let inputs = self.groups.first()?.differences.len();
        let sum_without = |left_out: Option<usize>| {
            let mut sum = Group::new(inputs);
            for (number, group) in self.groups.iter().enumerate() {
                if Some(number) != left_out {
                    sum.add(group);
                }
            }
            sum
        };
        let whole = sum_without(None);
        // Rounding noise in the variance of a constant output.
        let noise = whole.squares * 1e-14 / (2.0 * whole.rows);
        if whole.rows < 2.0 || whole.variance() <= noise {
            return None;
        }
        let populated = self.groups.iter().all(|group| group.rows > 0.0);
        let without: Vec<Group> = (0..REPLICATES).map(|number| sum_without(Some(number))).collect();
        let index = |pick: &dyn Fn(&Group) -> f64| {
            let left_out: Vec<f64> = without.iter().map(pick).collect();
            let standard_error = populated.then(|| jackknife(&left_out));
            Index { value: pick(&whole), standard_error }
        };
        let indices = (0..inputs)
            .map(|input| Indices {
                first_order: index(&|group| group.indices(input).0),
                total: index(&|group| group.indices(input).1),
            })
            .collect();
        Some(indices)
    }
}

/// √((R − 1)/R·Σ(θᵣ − θ̄)²), θᵣ without group r.
fn jackknife(left_out: &[f64]) -> f64 {
    let count = left_out.len() as f64;
    let mean = left_out.iter().sum::<f64>() / count;
    let squares: f64 = left_out.iter().map(|value| (value - mean) * (value - mean)).sum();
    ((count - 1.0) / count * squares).sqrt()
}
