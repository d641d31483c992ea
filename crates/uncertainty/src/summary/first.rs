//! The first pass over the columns of a run, made while its samples are still in the caches.

use std::sync::{Mutex, OnceLock, PoisonError};

use fearless_simd::dispatch;

use super::order::{Cells, Order};
use super::passes::{Passes, Size};
use super::sums::{Summed, sum_of_span};
use crate::run::Instructions;
use crate::sampler::Settings;

/// Counts spans of samples, in any order and from any thread, for the [`Passes`] over their columns.
#[derive(Debug)]
pub(crate) struct First {
    instructions: Instructions,
    /// Of each column. Whichever span comes first tells where they lie, as no result depends on it.
    cells: OnceLock<Vec<Cells>>,
    /// Values in each cell of each column: a list for each thread that counts at the same time.
    counts: Mutex<Vec<Vec<u32>>>,
}

const CELLS: usize = Size::AT_ONCE.cells as usize;

impl First {
    pub(crate) fn new(instructions: Instructions) -> Self {
        Self { instructions, cells: OnceLock::new(), counts: Mutex::new(Vec::new()) }
    }

    /// Counts a span of which all samples have answers, and tells the sum of each column.
    pub(crate) fn add(&self, columns: &[&mut [f64]]) -> Vec<f64> {
        let cells = self
            .cells
            .get_or_init(|| columns.iter().map(|column| Cells::of(column, Size::AT_ONCE.cells)).collect());
        let waiting = self.counts.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut counts = waiting.unwrap_or_else(|| vec![0; columns.len() * CELLS]);
        let each = columns.iter().zip(cells).zip(counts.chunks_mut(CELLS));
        let sums = each.map(|((column, cells), counts)| {
            dispatch!(self.instructions.level(), _simd => add_column(cells, counts, column))
        });
        let sums = sums.collect();
        self.counts.lock().unwrap_or_else(PoisonError::into_inner).push(counts);
        sums
    }

    /// The other passes over each column, given the sums of its spans in their order and the number of its
    /// samples.
    pub(crate) fn passes(self, settings: &Settings, samples: usize, sums: &[Vec<f64>]) -> Vec<Passes> {
        let counts = self.counts.into_inner().unwrap_or_else(PoisonError::into_inner);
        let columns = self.cells.into_inner().unwrap_or_default().into_iter().enumerate();
        let passes = columns.map(|(column, cells)| {
            let mut order = Order::new(Size::AT_ONCE);
            for counts in &counts {
                order.add_counted(cells, &counts[column * CELLS..(column + 1) * CELLS]);
            }
            let summed = Summed::of_spans(samples, sums.iter().map(|sums| sums[column]));
            Passes::after_the_first(settings, order, summed)
        });
        passes.collect()
    }
}

#[inline(always)]
fn add_column(cells: &Cells, counts: &mut [u32], column: &[f64]) -> f64 {
    cells.count(column, counts);
    sum_of_span(column, |x| x)
}
