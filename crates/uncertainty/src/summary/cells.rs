//! Equal parts of the range of a column, by which it is told quickly about where a value lies.

use fearless_simd::dispatch;

use super::order::{key, value_of};
use crate::run::Instructions;

/// The last cell; the first one is 0.
pub(super) const LAST: i16 = i16::MAX - 1;

/// The cell of a sample that failed, beyond all windows.
pub(super) const MISSING: i16 = i16::MAX;

/// Below all cells.
pub(super) const NOWHERE: i16 = i16::MIN;

/// Two to this power of the cells are counted together in the first span: its windows begin and end where
/// such parts do.
pub(super) const TOGETHER: u32 = 4;
pub(super) const BUCKETS: usize = 1 << (15 - TOGETHER);

pub(super) fn bucket(cell: i16) -> usize {
    usize::from(cell.unsigned_abs()) >> TOGETHER
}

pub(super) fn first_cell(bucket: usize) -> i16 {
    i16::try_from(bucket << TOGETHER).unwrap_or(LAST)
}

pub(super) fn last_cell(bucket: usize) -> i16 {
    i16::try_from((bucket << TOGETHER) + (1 << TOGETHER) - 1).unwrap_or(LAST).min(LAST)
}

/// Equal parts of the range of some values. What lies beyond belongs to the outermost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    least: f64,
    per_unit: f64,
    instructions: Instructions,
}

impl Cells {
    pub(super) fn of(values: &[f64], instructions: Instructions) -> Self {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let per_unit = f64::from(LAST) / (greatest - least);
        // One cell for values that are all the same, or too near or too far apart for the quotient.
        if per_unit.is_finite() && per_unit > 0.0 {
            Self { least, per_unit, instructions }
        } else {
            Self { least: 0.0, per_unit: 0.0, instructions }
        }
    }

    /// Never falls where the value rises.
    #[inline(always)]
    pub(super) fn cell(&self, value: f64) -> i16 {
        // 2⁵²: its last bits are the rounded sum.
        const TO_INTEGER: f64 = 4_503_599_627_370_496.0;
        const GREATEST: f64 = LAST as f64;
        let place = (value - self.least) * self.per_unit;
        let place = if place < GREATEST { place } else { GREATEST };
        let place = if place > 0.0 { place } else { 0.0 };
        let bits = (place + TO_INTEGER).to_bits() ^ TO_INTEGER.to_bits();
        #[expect(clippy::cast_possible_truncation, reason = "at most the last")]
        let cell = bits as i16;
        if value.is_nan() { MISSING } else { cell }
    }

    /// That of each value.
    pub(super) fn of_all(&self, values: &[f64]) -> Vec<i16> {
        let mut cells = vec![MISSING; values.len()];
        dispatch!(self.instructions.level(), _simd => self.note(values, &mut cells));
        cells
    }

    #[inline(always)]
    fn note(&self, values: &[f64], cells: &mut [i16]) {
        for (cell, value) in cells.iter_mut().zip(values) {
            *cell = self.cell(*value);
        }
    }

    /// The [`key`] of the least value in this cell or above it.
    pub(super) fn key_of(&self, cell: i16) -> u64 {
        let (mut low, mut high) = (key(f64::MIN), key(f64::MAX));
        while low < high {
            let middle = low + (high - low) / 2;
            if self.cell(value_of(middle)) < cell {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }
}
