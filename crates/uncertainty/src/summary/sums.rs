//! Sums over a column that may come in chunks: wherever it is cut, they have the same bits.

use crate::limits::REPLICATES;
use crate::model::LANES;

/// Values that are added up together, and samples that one thread takes at a time.
pub(crate) const SPAN: usize = 64 * LANES;

/// N sums Σ f(x) in a fixed order, of sums over eight lanes and over spans, which keeps the rounding small.
#[derive(Clone, Debug)]
pub(super) struct Sums<const N: usize> {
    /// How many values there are.
    count: usize,
    totals: [f64; N],
    /// The values after the last whole span.
    rest: Vec<f64>,
}

impl<const N: usize> Sums<N> {
    pub(super) fn new() -> Self {
        Self { count: 0, totals: [0.0; N], rest: Vec::new() }
    }

    /// Adds f(x) of the values that follow, given the number of the sum. It has to be the same f in all
    /// calls.
    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64], f: impl Fn(usize, f64) -> f64) {
        self.count += values.len();
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
    pub(super) fn totals(&self, f: impl Fn(usize, f64) -> f64) -> [f64; N] {
        let mut totals = self.totals;
        add_span(&mut totals, &self.rest, &f);
        totals
    }
}

#[inline(always)]
fn add_span<const N: usize>(totals: &mut [f64; N], span: &[f64], f: impl Fn(usize, f64) -> f64) {
    // One after the other: beside each other, a compiler makes vectors of what two sums do, and not of lanes.
    for (number, total) in totals.iter_mut().enumerate() {
        *total += sum_of_span(span, |x| f(number, x));
    }
}

/// What the values of a span add to a sum.
#[inline(always)]
pub(super) fn sum_of_span(span: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let mut lanes = [0.0; 8];
    let (blocks, rest) = span.as_chunks::<8>();
    for block in blocks {
        for (sum, value) in lanes.iter_mut().zip(block) {
            *sum += f(*value);
        }
    }
    let mut of_rest = 0.0;
    for value in rest {
        of_rest += f(*value);
    }
    let lanes: f64 = lanes.into_iter().sum();
    lanes + of_rest
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
    sum: Sums<1>,
}

impl Summed {
    pub(super) fn new() -> Self {
        Self { sum: Sums::new() }
    }

    /// Of so many values, given what each of their [spans](sum_of_span) adds.
    pub(super) fn of_spans(count: usize, spans: impl Iterator<Item = f64>) -> Self {
        let total = spans.fold(0.0, |total, span| total + span);
        Self { sum: Sums { count, totals: [total], rest: Vec::new() } }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64]) {
        self.sum.add(values, |_, x| x);
    }

    /// Those of a column to its replicates.
    #[inline(always)]
    pub(super) fn add_dealt(replicates: &mut [Self], column: &[f64]) {
        add_dealt(replicates, |own| &mut own.sum, column, |_, _, x| x);
    }

    pub(super) fn count(&self) -> usize {
        self.sum.count
    }

    /// The second pass, over the same values.
    pub(super) fn spread(&self) -> Spread {
        let [sum] = self.sum.totals(|_, x| x);
        Spread { mean: sum / self.count() as f64, powers: Sums::new() }
    }
}

/// The second pass of [`Moments`].
#[derive(Clone, Debug)]
pub(super) struct Spread {
    mean: f64,
    powers: Sums<2>,
}

impl Spread {
    #[inline(always)]
    pub(super) fn add(&mut self, values: &[f64]) {
        self.powers.add(values, |number, x| power(number, x - self.mean));
    }

    /// Those of a column to its replicates.
    #[inline(always)]
    pub(super) fn add_dealt(replicates: &mut [Self], column: &[f64]) {
        let means: [f64; ROW] =
            std::array::from_fn(|place| replicates.get(place % REPLICATES).map_or(f64::NAN, |own| own.mean));
        add_dealt(
            replicates,
            |own| &mut own.powers,
            column,
            |place, number, x| power(number, x - means[place % ROW]),
        );
    }

    pub(super) fn moments(&self) -> Moments {
        let [squares, fourth_powers] = self.powers.totals(|number, x| power(number, x - self.mean));
        Moments { count: self.powers.count, mean: self.mean, squares, fourth_powers }
    }
}

/// The square of a deviation, and its fourth power.
#[inline(always)]
fn power(number: usize, deviation: f64) -> f64 {
    let square = deviation * deviation;
    if number == 0 { square } else { square * square }
}

/// Adds f(x) of a column to the sums of its replicates, without what is NaN. Before the number of the sum, f
/// has the place of the replicate, or this and a multiple of [`REPLICATES`] below [`ROW`].
///
/// As long as none is NaN, the sums of all replicates are made beside each other as the values lie.
#[inline(always)]
pub(super) fn add_dealt<S, const N: usize>(
    replicates: &mut [S],
    sums: impl Fn(&mut S) -> &mut Sums<N>,
    column: &[f64],
    f: impl Fn(usize, usize, f64) -> f64,
) {
    let mut column = column;
    while replicates.iter_mut().all(|own| sums(own).rest.is_empty())
        && let Some((span, after)) = column.split_at_checked(SPAN * REPLICATES)
        && !has_nan(span)
    {
        let totals: [_; N] = totals_beside(span, &f);
        for (replicate, own) in replicates.iter_mut().enumerate() {
            let sums = sums(own);
            sums.count += SPAN;
            for (total, of_all) in sums.totals.iter_mut().zip(&totals) {
                *total += of_all[replicate];
            }
        }
        column = after;
    }
    deal(column, |replicate, own| {
        sums(&mut replicates[replicate]).add(own, |number, x| f(replicate, number, x));
    });
}

/// Values in which each replicate has one for each of the lanes that [`add_span`] adds up.
pub(super) const ROW: usize = 8 * REPLICATES;

/// What [`add_span`] adds for each replicate.
#[inline(always)]
fn totals_beside<const N: usize>(
    span: &[f64],
    f: impl Fn(usize, usize, f64) -> f64,
) -> [[f64; REPLICATES]; N] {
    let mut lanes = [[0.0; ROW]; N];
    let (rows, _) = span.as_chunks::<ROW>();
    for row in rows {
        for (number, lanes) in lanes.iter_mut().enumerate() {
            for (place, (sum, value)) in lanes.iter_mut().zip(row).enumerate() {
                *sum += f(place, number, *value);
            }
        }
    }
    lanes.map(|lanes| std::array::from_fn(|replicate| lanes.iter().skip(replicate).step_by(REPLICATES).sum()))
}

/// Points of each replicate that are dealt at once, so that they stay in the nearest cache.
const DEALT: usize = LANES;

/// Deals a column to its replicates, without what is NaN, a part that stays in the caches at a time.
#[inline(always)]
fn deal(column: &[f64], mut take: impl FnMut(usize, &[f64])) {
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
    use super::{Spread, Summed, Sums};
    use crate::limits::REPLICATES;
    use crate::random::{bits, unit};

    /// Cut anywhere: every value is taken once, and the bits are those of one piece.
    #[test]
    fn sums_take_every_value_once() {
        let double = |number: usize, x: f64| (number + 1) as f64 * x;
        let third = |_: usize, x: f64| x / 3.0;
        for count in [0, 1, 7, 8, 9, 4095, 4096, 4097, 10_000] {
            let values: Vec<f64> = (1..=count).map(f64::from).collect();
            let total = f64::from(count) * f64::from(count + 1) / 2.0;
            let mut whole = Sums::<1>::new();
            whole.add(&values, third);
            for size in [1, 5, 16, 4096, 5000, 20_000] {
                let (mut sums, mut thirds) = (Sums::<2>::new(), Sums::<1>::new());
                for chunk in values.chunks(size) {
                    sums.add(chunk, double);
                    thirds.add(chunk, third);
                }
                assert_eq!(sums.totals(double), [total, 2.0 * total], "{count} by {size}");
                assert_eq!(thirds.totals(third), whole.totals(third), "{count} by {size}");
            }
        }
    }

    /// Beside each other and one by one, with a value that is not a number in the second span of all
    /// replicates or in none.
    #[test]
    fn replicates_have_the_sums_of_their_own_values() {
        for failed in [None, Some(100_000)] {
            let mut column: Vec<f64> = (0..200_000).map(|index| unit(bits(1, index))).collect();
            if let Some(place) = failed {
                column[place] = f64::NAN;
            }
            let mut summed = vec![Summed::new(); REPLICATES];
            column.chunks(3 * 65_536).for_each(|chunk| Summed::add_dealt(&mut summed, chunk));
            let mut spreads: Vec<Spread> = summed.iter().map(Summed::spread).collect();
            column.chunks(65_536).for_each(|chunk| Spread::add_dealt(&mut spreads, chunk));
            for (replicate, spread) in spreads.iter().enumerate() {
                let own = column.iter().skip(replicate).step_by(REPLICATES);
                let own: Vec<f64> = own.copied().filter(|value| !value.is_nan()).collect();
                let (beside, alone) = (spread.moments(), super::Moments::of(&own));
                assert_eq!(
                    [beside.mean, beside.squares, beside.fourth_powers].map(f64::to_bits),
                    [alone.mean, alone.squares, alone.fourth_powers].map(f64::to_bits),
                );
                assert_eq!(beside.count, own.len());
            }
        }
    }
}
