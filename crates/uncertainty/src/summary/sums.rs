//! Sums over a column that may come in chunks: wherever it is cut, they have the same bits.

use crate::limits::REPLICATES;
use crate::model::LANES;

/// Values that are added up together.
const SPAN: usize = 64 * LANES;

/// Σ f(x) in a fixed order, of sums over eight lanes and over spans, which keeps the rounding small.
#[derive(Clone, Debug)]
pub(super) struct Sums<const N: usize> {
    totals: [f64; N],
    /// The values after the last whole span.
    rest: Vec<f64>,
}

impl<const N: usize> Sums<N> {
    pub(super) fn new() -> Self {
        Self { totals: [0.0; N], rest: Vec::new() }
    }

    /// Adds f(x) of the values that follow. It has to be the same f in all calls.
    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64], f: impl Fn(f64) -> [f64; N]) {
        let mut values = values;
        if !self.rest.is_empty() {
            let (first, others) = values.split_at(values.len().min(SPAN - self.rest.len()));
            self.rest.extend_from_slice(first);
            values = others;
            if self.rest.len() == SPAN {
                add_span(&mut self.totals, &self.rest, &f);
                self.rest.clear();
            }
        }
        let spans = values.chunks_exact(SPAN);
        self.rest.extend_from_slice(spans.remainder());
        for span in spans {
            add_span(&mut self.totals, span, &f);
        }
    }

    /// The sums, with f(x) of the values that make no whole span.
    pub(super) fn totals(&self, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
        let mut totals = self.totals;
        add_span(&mut totals, &self.rest, &f);
        totals
    }
}

#[inline(always)]
fn add_span<const N: usize>(totals: &mut [f64; N], span: &[f64], f: impl Fn(f64) -> [f64; N]) {
    let mut lanes = [[0.0; 8]; N];
    let (blocks, rest) = span.as_chunks::<8>();
    for block in blocks {
        for (lane, &value) in block.iter().enumerate() {
            for (lanes, term) in lanes.iter_mut().zip(f(value)) {
                lanes[lane] += term;
            }
        }
    }
    let mut of_rest = [0.0; N];
    for &value in rest {
        for (sum, term) in of_rest.iter_mut().zip(f(value)) {
            *sum += term;
        }
    }
    for ((total, lanes), rest) in totals.iter_mut().zip(lanes).zip(of_rest) {
        let lanes: f64 = lanes.into_iter().sum();
        *total += lanes + rest;
    }
}

/// Number, mean and sums of powers of the deviations from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    pub(super) count: usize,
    pub(super) mean: f64,
    squares: f64,
    pub(super) fourth_powers: f64,
}

impl Moments {
    pub(super) fn of(values: &[f64]) -> Self {
        let mut summed = Summed::new();
        summed.add(values);
        let mut spread = summed.spread();
        spread.add(values);
        spread.moments()
    }

    pub(super) fn sd(&self) -> f64 {
        // s² = Σ(x − x̄)²/(n − 1)
        (self.squares / (self.count as f64 - 1.0)).sqrt()
    }
}

/// The first pass of [`Moments`].
#[derive(Clone, Debug)]
pub(super) struct Summed {
    pub(super) count: usize,
    sum: Sums<1>,
}

impl Summed {
    pub(super) fn new() -> Self {
        Self { count: 0, sum: Sums::new() }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64]) {
        self.count += values.len();
        self.sum.add(values, |x| [x]);
    }

    /// The second pass, over the same values.
    pub(super) fn spread(&self) -> Spread {
        let [sum] = self.sum.totals(|x| [x]);
        Spread { count: self.count, mean: sum / self.count as f64, powers: Sums::new() }
    }
}

/// The second pass of [`Moments`].
#[derive(Clone, Debug)]
pub(super) struct Spread {
    count: usize,
    mean: f64,
    powers: Sums<2>,
}

impl Spread {
    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64]) {
        self.powers.add(values, powers(self.mean));
    }

    pub(super) fn moments(&self) -> Moments {
        let [squares, fourth_powers] = self.powers.totals(powers(self.mean));
        Moments { count: self.count, mean: self.mean, squares, fourth_powers }
    }
}

#[inline(always)]
fn powers(mean: f64) -> impl Fn(f64) -> [f64; 2] {
    move |x| {
        let square = (x - mean) * (x - mean);
        [square, square * square]
    }
}

/// Points of each replicate that are dealt at once, so that they stay in the nearest cache.
const DEALT: usize = LANES;

/// Deals a column to its replicates, without what is NaN, a part that stays in the caches at a time.
#[inline(always)]
pub(super) fn deal(column: &[f64], mut take: impl FnMut(usize, &[f64])) {
    let mut dealt = [[0.0; DEALT]; REPLICATES];
    for part in column.chunks(DEALT * REPLICATES) {
        let (rows, rest) = part.as_chunks::<REPLICATES>();
        if rows.len() == DEALT && !has_nan(part) {
            for (place, row) in rows.iter().enumerate() {
                for (own, value) in dealt.iter_mut().zip(row) {
                    own[place] = *value;
                }
            }
            for (replicate, own) in dealt.iter().enumerate() {
                take(replicate, own);
            }
            continue;
        }
        let mut counts = [0; REPLICATES];
        for row in rows.iter().map(<[f64; REPLICATES]>::as_slice).chain([rest]) {
            for ((own, count), value) in dealt.iter_mut().zip(&mut counts).zip(row) {
                own[*count] = *value;
                *count += usize::from(!value.is_nan());
            }
        }
        for (replicate, (own, count)) in dealt.iter().zip(counts).enumerate() {
            take(replicate, &own[..count]);
        }
    }
}

#[inline(always)]
fn has_nan(values: &[f64]) -> bool {
    values.iter().fold(false, |has_nan, value| has_nan | value.is_nan())
}

#[cfg(test)]
mod tests {
    use super::Sums;

    /// Cut anywhere: every value is taken once, and the bits are those of one piece.
    #[test]
    fn sums_take_every_value_once() {
        let double = |x: f64| [x, 2.0 * x];
        let third = |x: f64| [x / 3.0];
        for count in [0, 1, 7, 8, 9, 4095, 4096, 4097, 10_000] {
            let values: Vec<f64> = (1..=count).map(f64::from).collect();
            let total = f64::from(count) * f64::from(count + 1) / 2.0;
            let mut whole = Sums::new();
            whole.add(&values, third);
            for size in [1, 5, 16, 4096, 5000, 20_000] {
                let (mut sums, mut thirds) = (Sums::new(), Sums::new());
                for chunk in values.chunks(size) {
                    sums.add(chunk, double);
                    thirds.add(chunk, third);
                }
                assert_eq!(sums.totals(double), [total, 2.0 * total], "{count} by {size}");
                assert_eq!(thirds.totals(third), whole.totals(third), "{count} by {size}");
            }
        }
    }
}
