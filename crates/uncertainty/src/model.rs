//! The model: any function of the inputs.

use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::slice;

use crate::dispatch;

use crate::run::Instructions;

/// Number of samples that a model receives at once.
pub const LANES: usize = 64;

/// One number for each sample of a block, in an array aligned to cache lines, so that no vector spans two
/// lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<T = f64>([T; LANES]);

impl Lanes {
    /// All zeros.
    pub const ZERO: Self = Self::splat(0.0);
}

impl<T: Copy> Lanes<T> {
    /// The same number in each lane.
    #[inline(always)]
    #[must_use]
    pub const fn splat(number: T) -> Self {
        Self([number; LANES])
    }
}

impl<T> From<[T; LANES]> for Lanes<T> {
    #[inline(always)]
    fn from(numbers: [T; LANES]) -> Self {
        Self(numbers)
    }
}

impl<T> Deref for Lanes<T> {
    type Target = [T; LANES];

    #[inline(always)]
    fn deref(&self) -> &[T; LANES] {
        &self.0
    }
}

impl<T> DerefMut for Lanes<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T; LANES] {
        &mut self.0
    }
}

impl<'a, T> IntoIterator for &'a Lanes<T> {
    type Item = &'a T;
    type IntoIter = slice::Iter<'a, T>;

    #[inline(always)]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'a, T> IntoIterator for &'a mut Lanes<T> {
    type Item = &'a mut T;
    type IntoIter = slice::IterMut<'a, T>;

    #[inline(always)]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter_mut()
    }
}

/// The reason code of a sample with an answer.
pub const SUCCEEDED: u8 = 0;

/// The reason code of a sample that the model accepted although an output is infinite or NaN. The model's own
/// codes lie between [`SUCCEEDED`] and this.
pub const NOT_FINITE: u8 = u8::MAX;

/// Number of failed samples, by reason code.
pub type Failures = BTreeMap<u8, usize>;

/// A function of the inputs that is evaluated for [`LANES`] samples at once.
///
/// If [`evaluate`](Self::evaluate) and all functions that it calls are marked `#[inline(always)]` and cannot
/// panic, it is compiled for each instruction set of [`crate::Instructions`], and its loop over the lanes is
/// vectorised. Each lane must depend only on its own inputs; then the results have the same bits for any
/// number of threads. [`Function`] turns a function of one sample into a model.
pub trait Model: Sync {
    /// Number of outputs.
    fn outputs(&self) -> usize;

    /// Evaluates a block: `inputs` and `outputs` hold a column for each input and output. A sample without an
    /// answer gets a reason from 1 to 254 in `reasons`, which are initially [`SUCCEEDED`]; its outputs are
    /// then ignored. The `instructions` are those for which this function is compiled: a large model compiles
    /// faster if its parts are separate functions that are dispatched to the same instructions.
    fn evaluate(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    );
}

/// A model from a function of one sample.
#[derive(Clone, Debug)]
pub struct Function<F> {
    outputs: usize,
    function: F,
}

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> Function<F> {
    /// A model from a function that reads the inputs of a sample and writes its outputs, or fails with a
    /// reason from 1 to 254; another counts as [`NOT_FINITE`].
    pub fn new(outputs: usize, function: F) -> Self {
        Self { outputs, function }
    }
}

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> Model for Function<F> {
    fn outputs(&self) -> usize {
        self.outputs
    }

    #[inline(always)]
    fn evaluate(
        &self,
        _instructions: Instructions,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        evaluate_each(inputs, outputs, reasons, |_| true, &self.function);
    }
}

/// Evaluates the wanted samples of a block one by one, by a function as that of [`Function`].
#[inline(always)]
pub fn evaluate_each(
    inputs: &[Lanes],
    outputs: &mut [Lanes],
    reasons: &mut [u8; LANES],
    is_wanted: impl Fn(usize) -> bool,
    function: impl Fn(&[f64], &mut [f64]) -> Result<(), u8>,
) {
    let mut sample = vec![0.0; inputs.len()];
    let mut answer = vec![0.0; outputs.len()];
    for (lane, reason) in reasons.iter_mut().enumerate().filter(|(lane, _)| is_wanted(*lane)) {
        for (value, column) in sample.iter_mut().zip(inputs) {
            *value = column[lane];
        }
        match function(&sample, &mut answer) {
            Ok(()) => {
                for (value, column) in answer.iter().zip(outputs.iter_mut()) {
                    column[lane] = *value;
                }
            }
            Err(SUCCEEDED) => *reason = NOT_FINITE,
            Err(code) => *reason = code,
        }
    }
}

/// Evaluates a block, and marks the samples whose outputs are not all finite. The outputs of failed samples
/// become NaN.
///
/// All sampling calls this function, so that a model is compiled only once for each instruction set.
#[inline(never)]
pub(crate) fn evaluate<M: Model>(
    instructions: Instructions,
    model: &M,
    inputs: &[Lanes],
    outputs: &mut [Lanes],
    reasons: &mut [u8; LANES],
) {
    dispatch!(instructions, evaluate_with(instructions, model, inputs, outputs, reasons));
}

#[inline(always)]
fn evaluate_with<M: Model>(
    instructions: Instructions,
    model: &M,
    inputs: &[Lanes],
    outputs: &mut [Lanes],
    reasons: &mut [u8; LANES],
) {
    *reasons = [SUCCEEDED; LANES];
    model.evaluate(instructions, inputs, outputs, reasons);
    for column in outputs.iter() {
        for (value, reason) in column.iter().zip(reasons.iter_mut()) {
            let failed = *reason == SUCCEEDED && !value.is_finite();
            *reason = if failed { NOT_FINITE } else { *reason };
        }
    }
    if *reasons != [SUCCEEDED; LANES] {
        for column in outputs {
            for (value, reason) in column.iter_mut().zip(reasons.iter()) {
                *value = if *reason == SUCCEEDED { *value } else { f64::NAN };
            }
        }
    }
}

/// Counts the reasons of failed samples.
pub(crate) fn count_failures(failures: &mut Failures, reasons: &[u8]) {
    for &reason in reasons {
        if reason != SUCCEEDED {
            *failures.entry(reason).or_default() += 1;
        }
    }
}
