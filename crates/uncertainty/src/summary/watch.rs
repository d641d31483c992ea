//! Some of the values of a column in their order, by one pass over it.
//!
//! The first span tells about where each quantile lies, and how far from there the quantile of all values
//! may be. What lies in this window is taken out; of the rest it is only counted how much lies below. Each
//! thread watches the spans that it does. Now and then the windows of all threads are narrowed, alike, by
//! what they have seen together. In the end the values at the wanted places are sought among the few that
//! were taken out. A window that was predicted wrong, or that holds too many values, is seen by its counts:
//! then [`Order`](super::order::Order) has to find the place by further passes.

use std::ops::Range;
use std::{iter, mem, slice};

use fearless_simd::dispatch;

use super::QUANTILES;
use super::order::{key, value_of};
use super::powers::{Powers, Sums};
use crate::limits::REPLICATES;
use crate::model::{LANES, Lanes};
use crate::run::Instructions;

/// How a column is watched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watching {
    /// How many values are to come.
    pub(crate) planned: usize,
    pub(crate) is_replicated: bool,
    pub(crate) instructions: Instructions,
    pub(crate) caution: Caution,
}

/// How surely a quantile is in its window, and what that may cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Caution {
    /// (standard deviations) from a quantile of some values to that of all.
    pub(crate) deviations: f64,
    /// Values that may be taken out of one window: as many times the square root of their number, and `few`
    /// at least.
    pub(crate) roots: f64,
    pub(crate) few: usize,
}

impl Caution {
    /// One window in a million is missed, and its column gone over again.
    pub(crate) const USUAL: Self = Self { deviations: 5.0, roots: 64.0, few: 1 << 15 };
}

/// The probabilities of the quantiles, in ascending order.
const SHARES: [f64; QUANTILES] = [0.005, 0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975, 0.995];

/// What is known of a column.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    of: Watching,
    pub(super) cells: Cells,
    /// A value in the middle, from which deviations are counted.
    pub(super) centre: f64,
    /// In ascending order.
    pub(super) windows: Vec<Window>,
    open: Open,
    seen: u64,
}

/// A span while its blocks come.
#[derive(Clone, Debug)]
struct Open {
    /// The cells of each window; nowhere, where it was lost before this span.
    ranges: [[i16; 2]; QUANTILES],
    /// How many values lie below each window, of each lane.
    below: [[i16; LANES]; QUANTILES],
    sums: Sums,
}

impl Open {
    fn new(windows: &[Window]) -> Self {
        let mut ranges = [[NOWHERE; 2]; QUANTILES];
        for (range, window) in ranges.iter_mut().zip(windows) {
            *range = if window.is_lost { [NOWHERE; 2] } else { window.cells };
        }
        Self { ranges, below: [[0; LANES]; QUANTILES], sums: Sums::default() }
    }
}

/// Neighbouring cells that hold some quantiles, as far as is known.
#[derive(Clone, Debug)]
pub(super) struct Window {
    /// Which of the [shares](SHARES).
    shares: Range<usize>,
    /// The first and the last cell.
    pub(super) cells: [i16; 2],
    /// Values below the first cell, of each replicate.
    pub(super) below: [u64; REPLICATES],
    /// Values inside, and the replicate of each, where there are replicates.
    pub(super) taken: Vec<f64>,
    pub(super) replicates: Vec<u8>,
    /// And those which are all the same.
    pub(super) clump: Option<Clump>,
    /// Too many values were inside.
    pub(super) is_lost: bool,
}

#[derive(Clone, Debug)]
pub(super) struct Clump {
    pub(super) value: f64,
    /// Values of each replicate.
    pub(super) counts: [u64; REPLICATES],
}

impl Watch {
    /// Before the first span, which is `pilot`, in which NaN stands for samples that failed.
    pub(crate) fn new(pilot: &[f64], of: Watching) -> Self {
        let cells = Cells::of(pilot, of.instructions);
        let mut before = [0_u32; BUCKETS];
        let of_pilot = cells.of_all(pilot);
        for cell in of_pilot.iter().filter(|cell| **cell != MISSING) {
            before[bucket(*cell)] += 1;
        }
        let mut seen = 0;
        for count in &mut before {
            seen += *count;
            *count = seen;
        }
        // That in which the value at a place lies.
        let bucket_at = |place: f64| before.partition_point(|before| f64::from(*before) <= place);
        let middle = bucket_at(0.5 * f64::from(seen));
        let centre = pilot.iter().zip(&of_pilot).find(|(_, cell)| bucket(**cell) == middle);
        let (centre, seen) = (centre.map_or(0.0, |(value, _)| *value), u64::from(seen));
        let (windows, open) = (Vec::new(), Open::new(&[]));
        let mut watch = Self { of, cells, centre, windows, open, seen };
        let last = seen as f64 - 1.0;
        let windows = (0..QUANTILES).map(|share| {
            let [from, to] = of.reach(SHARES[share], seen);
            let low = if from > 0.0 { first_cell(bucket_at(from)) } else { 0 };
            let high = if to < last { last_cell(bucket_at(to)) } else { LAST };
            (share, [low, high])
        });
        watch.windows = apart(windows).map(|(shares, cells)| Window::new(shares, cells)).collect();
        watch.open = Open::new(&watch.windows);
        watch.seen = 0;
        watch
    }

    /// One with the same windows that has seen nothing yet, and has room for about as many values as will be
    /// taken out: lists that grow would leave much memory behind.
    pub(crate) fn unwatched(&self) -> Self {
        let window = |window: &Window| Window::new(window.shares.clone(), window.cells).with_room(&self.of);
        let windows: Vec<_> = self.windows.iter().map(window).collect();
        let open = Open::new(&windows);
        Self { windows, open, seen: 0, ..*self }
    }

    /// The samples of a span, NaN where they failed.
    pub(crate) fn add(&mut self, span: &[f64]) -> [Powers; REPLICATES] {
        for part in span.chunks(LANES) {
            let mut block = Lanes::splat(f64::NAN);
            block[..part.len()].copy_from_slice(part);
            Self::add_blocks(slice::from_mut(self), &[block]);
        }
        self.end_span()
    }

    /// A block of each column, NaN where a sample failed. The first sample of a block belongs to the first
    /// replicate.
    pub(crate) fn add_blocks(watches: &mut [Self], blocks: &[Lanes]) {
        let Some(first) = watches.first() else { return };
        dispatch!(first.of.instructions.level(), _simd => Self::add_blocks_with(watches, blocks));
    }

    #[inline(always)]
    fn add_blocks_with(watches: &mut [Self], blocks: &[Lanes]) {
        for (watch, block) in watches.iter_mut().zip(blocks) {
            watch.add_block(block);
        }
    }

    /// What the blocks since the last span add to the powers.
    pub(crate) fn end_span(&mut self) -> [Powers; REPLICATES] {
        let powers = self.open.sums.powers();
        for (window, below) in self.windows.iter_mut().zip(&self.open.below) {
            for row in below.as_chunks::<REPLICATES>().0 {
                for (total, count) in window.below.iter_mut().zip(row) {
                    *total += u64::from(count.unsigned_abs());
                }
            }
        }
        self.seen += powers.iter().map(|powers| powers.count).sum::<u64>();
        self.open = Open::new(&self.windows);
        powers
    }

    #[inline(always)]
    fn add_block(&mut self, block: &Lanes) {
        self.open.sums.add(block, self.centre);
        let mut cells = [MISSING; LANES];
        for (cell, value) in cells.iter_mut().zip(block) {
            *cell = self.cells.cell(*value);
        }
        // The number of the window that a value is inside, counted from one.
        let mut inside = [0_i16; LANES];
        let Open { ranges, below, .. } = &mut self.open;
        let windows = ranges.iter().zip(below).take(self.windows.len());
        for (number, ([low, high], below)) in (1..).zip(windows) {
            for lane in 0..LANES {
                below[lane] += i16::from(cells[lane] < *low);
                let is_inside = (cells[lane] >= *low) & (cells[lane] <= *high);
                inside[lane] = if is_inside { number } else { inside[lane] };
            }
        }
        // A bit for each value inside a window, so that only these are gone through.
        let mut noted = 0_u64;
        for (lane, number) in inside.iter().enumerate() {
            noted |= u64::from(*number != 0) << lane;
        }
        while noted != 0 {
            let lane = noted.trailing_zeros() as usize;
            noted &= noted - 1;
            if let Some(window) =
                self.windows.get_mut(usize::from(inside[lane].unsigned_abs()).wrapping_sub(1))
            {
                window.take(block[lane], lane % REPLICATES, &self.of);
            }
        }
    }

    /// Leaves of each window what may hold a quantile of all values, by what this one and others have seen
    /// together. They have the same windows, before and after it.
    pub(crate) fn narrow<'a>(&'a mut self, others: impl IntoIterator<Item = &'a mut Self>) {
        let Self { of, cells, .. } = *self;
        let mut watches: Vec<&mut Self> = iter::once(self).chain(others).collect();
        let seen = watches.iter().map(|watch| watch.seen).sum();
        let reaches = SHARES.map(|share| of.reach(share, seen));
        let mut waiting: Vec<_> =
            watches.iter_mut().map(|watch| mem::take(&mut watch.windows).into_iter()).collect();
        loop {
            let windows: Vec<Window> = waiting.iter_mut().filter_map(Iterator::next).collect();
            let Some(Window { shares, .. }) = windows.first() else { break };
            let is_lost = windows.iter().any(|window| window.is_lost);
            let parts = if is_lost {
                Vec::new()
            } else {
                let ends = Ends::of(&windows, &cells, PARTS);
                apart(shares.clone().map(|share| (share, ends.cells_between(reaches[share])))).collect()
            };
            for (number, (watch, mut window)) in watches.iter_mut().zip(windows).enumerate() {
                if is_lost {
                    window.lose();
                    watch.windows.push(window);
                    continue;
                }
                for part in window.parted(&parts, &cells) {
                    // The others go on.
                    watch.windows.push(if number == 0 { part } else { part.with_room(&of) });
                }
            }
        }
        for watch in watches {
            watch.open = Open::new(&watch.windows);
        }
    }
}

impl Watching {
    /// The first and the last place among the values seen between which this quantile of all values lies,
    /// with the places about it that its standard error wants.
    fn reach(&self, share: f64, seen: u64) -> [f64; 2] {
        let (seen, planned) = (seen as f64, self.planned as f64);
        let left = (1.0 - seen / planned).max(0.0);
        // √(p(1 − p))
        let deviation = (share * (1.0 - share)).sqrt();
        let beside = 2.0 * deviation / planned.sqrt() + 2.0 / planned;
        let far = self.caution.deviations;
        // z √(s p(1 − p)(1 − s/n)), and some more for those that lie few beyond a quantile, whose number is
        // not normally distributed.
        let margin = far * deviation * (seen * left).sqrt() + 0.5 * far * far * left + 1.0;
        [seen * (share - beside) - margin, seen * (share + beside) + margin]
    }
}

impl Window {
    fn new(shares: Range<usize>, cells: [i16; 2]) -> Self {
        let (taken, replicates) = (Vec::new(), Vec::new());
        Self { shares, cells, below: [0; REPLICATES], taken, replicates, clump: None, is_lost: false }
    }

    /// With room for about as many values as are to be taken out: lists that grow would leave much memory
    /// behind.
    fn with_room(mut self, of: &Watching) -> Self {
        // Half as many again as a window holds that was narrowed after a quarter of all values: there it is
        // 2 z √(p(1 − p)/(n/4)) of them.
        let deviations = self.shares.clone().map(|share| (SHARES[share] * (1.0 - SHARES[share])).sqrt());
        let room = 6.0 * of.caution.deviations * deviations.sum::<f64>() * (of.planned as f64).sqrt();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let room = (room as usize).min(of.planned);
        self.taken.reserve(room.saturating_sub(self.taken.len()));
        if of.is_replicated {
            self.replicates.reserve(room.saturating_sub(self.replicates.len()));
        }
        self
    }

    #[inline]
    fn take(&mut self, value: f64, replicate: usize, of: &Watching) {
        if let Some(clump) = &mut self.clump
            && clump.value.to_bits() == value.to_bits()
        {
            clump.counts[replicate] += 1;
            return;
        }
        if self.taken.len() == self.taken.capacity() && self.taken.len() >= of.caution.few {
            self.make_room(of);
        }
        if !self.is_lost {
            self.taken.push(value);
            if of.is_replicated {
                #[expect(clippy::cast_possible_truncation, reason = "below 16")]
                self.replicates.push(replicate as u8);
            }
        }
    }

    /// Where there are many values: if half of them are the same, these are counted from now on; otherwise
    /// the window is lost where there are too many.
    #[cold]
    fn make_room(&mut self, of: &Watching) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let most = ((of.planned as f64).sqrt() * of.caution.roots) as usize;
        if self.taken.len() < most.max(of.caution.few) {
            return;
        }
        let mut sorted = self.taken.clone();
        let (_, middle, _) = sorted.select_nth_unstable_by(self.taken.len() / 2, f64::total_cmp);
        let value = *middle;
        let is_alike = |other: f64| other.to_bits() == value.to_bits();
        let alike: Vec<bool> = self.taken.iter().map(|taken| is_alike(*taken)).collect();
        let count = alike.iter().filter(|is_alike| **is_alike).count();
        if self.clump.is_some() || count < self.taken.len() / 2 {
            self.lose();
            return;
        }
        let mut clump = Clump { value, counts: [0; REPLICATES] };
        self.retain(&alike, |is_alike, replicate| {
            clump.counts[replicate] += u64::from(is_alike);
            !is_alike
        });
        self.clump = Some(clump);
    }

    fn lose(&mut self) {
        (self.taken, self.replicates, self.clump, self.is_lost) = (Vec::new(), Vec::new(), None, true);
    }

    /// Leaves those of the values taken out that are to stay, by what is known of each and its replicate. By
    /// Monte Carlo all have one replicate.
    fn retain<T: Copy>(&mut self, of_values: &[T], mut stays: impl FnMut(T, usize) -> bool) {
        // Moved in any case, as which of them stay cannot be predicted.
        let mut left = 0;
        for (place, of_value) in of_values.iter().enumerate() {
            let value = self.taken[place];
            let replicate = self.replicates.get(place).copied().unwrap_or(0);
            self.taken[left] = value;
            if let Some(own) = self.replicates.get_mut(left) {
                *own = replicate;
            }
            left += usize::from(stays(*of_value, usize::from(replicate) % REPLICATES));
        }
        self.taken.truncate(left);
        self.replicates.truncate(left);
    }

    /// Leaves these cells.
    fn restrict(&mut self, cells: &Cells, [low, high]: [i16; 2]) {
        if self.cells == [low, high] {
            return;
        }
        let mut below = self.below;
        let of_taken = cells.of_all(&self.taken);
        self.retain(&of_taken, |cell, replicate| {
            below[replicate] += u64::from(cell < low);
            (low <= cell) & (cell <= high)
        });
        if let Some(clump) = self.clump.take() {
            let cell = cells.cell(clump.value);
            if cell < low {
                for (below, count) in below.iter_mut().zip(clump.counts) {
                    *below += count;
                }
            } else if cell <= high {
                self.clump = Some(clump);
            }
        }
        (self.below, self.cells) = (below, [low, high]);
    }

    fn restricted(&self, cells: &Cells, parts: [i16; 2]) -> Self {
        let mut part = self.clone();
        part.restrict(cells, parts);
        part
    }

    /// A window for each of these parts.
    fn parted(mut self, parts: &[(Range<usize>, [i16; 2])], cells: &Cells) -> Vec<Self> {
        let Some(((shares, last), before)) = parts.split_last() else { return Vec::new() };
        let part = |(shares, part): &(Range<usize>, [i16; 2])| Self {
            shares: shares.clone(),
            ..self.restricted(cells, *part)
        };
        let mut parted: Vec<Self> = before.iter().map(part).collect();
        self.restrict(cells, *last);
        self.shares = shares.clone();
        parted.push(self);
        parted
    }
}

/// How the values inside some cells are spread over these.
#[derive(Debug)]
pub(super) struct Ends {
    pub(super) cells: [i16; 2],
    /// Two to this power of the cells are one part.
    shift: u32,
    /// How many values lie below the first cell.
    pub(super) first: usize,
    /// The place after the last value of each part.
    pub(super) of_parts: Vec<usize>,
}

impl Ends {
    /// Of windows that have the same cells, in so many parts or up to twice as many, unless there are fewer
    /// cells.
    pub(super) fn of(windows: &[Window], cells: &Cells, parts: usize) -> Self {
        let [low, high] = windows.first().map_or([0, LAST], |window| window.cells);
        let width = (high - low).unsigned_abs();
        let shift = ((usize::from(width) + 1) / parts).max(1).ilog2();
        let mut ends = Self { cells: [low, high], shift, first: 0, of_parts: Vec::new() };
        let mut counts = vec![0; usize::from(width >> shift) + 1];
        for window in windows {
            cells.of_all(&window.taken).into_iter().for_each(|cell| counts[ends.part(cell)] += 1);
            let clump = window.clump.iter();
            clump.for_each(|clump| counts[ends.part(cells.cell(clump.value))] += clump.count());
        }
        let counted: u64 = windows.iter().flat_map(|window| window.below).sum();
        ends.first = usize::try_from(counted).unwrap_or(usize::MAX);
        let mut end = ends.first;
        for count in &mut counts {
            end += *count;
            *count = end;
        }
        ends.of_parts = counts;
        ends
    }

    /// The part that a cell belongs to, which is not below the first one.
    pub(super) fn part(&self, cell: i16) -> usize {
        usize::from((cell - self.cells[0]).unsigned_abs() >> self.shift)
    }

    /// The place after the last of the values.
    pub(super) fn last(&self) -> usize {
        self.of_parts.last().map_or(self.first, |end| *end)
    }

    /// The cells of the parts between the places `from` and `to`, as far as they are here.
    fn cells_between(&self, [from, to]: [f64; 2]) -> [i16; 2] {
        let [first, last] = self.cells;
        let at = |cell: usize| i16::try_from(cell).unwrap_or(last).min(last);
        // The first cell of the part that holds a place, or of one after it.
        let begin = |place: f64, after: usize| {
            let part = self.of_parts.partition_point(|end| *end as f64 <= place) + after;
            usize::from(first.unsigned_abs()) + (part << self.shift)
        };
        let low = if from > self.first as f64 { at(begin(from, 0)) } else { first };
        let high = if to < self.last() as f64 - 1.0 { at(begin(to, 1) - 1) } else { last };
        [low, high]
    }
}

/// Windows that overlap become one. Shares and cells ascend.
fn apart(windows: impl Iterator<Item = (usize, [i16; 2])>) -> impl Iterator<Item = (Range<usize>, [i16; 2])> {
    let mut windows = windows.peekable();
    iter::from_fn(move || {
        let (share, [low, mut high]) = windows.next()?;
        let mut shares = share..share + 1;
        while let Some((share, [_, next])) = windows.next_if(|(_, [low, _])| *low <= high) {
            (shares.end, high) = (share + 1, high.max(next));
        }
        Some((shares, [low, high]))
    })
}

impl Clump {
    pub(super) fn count(&self) -> usize {
        usize::try_from(self.counts.iter().sum::<u64>()).unwrap_or(usize::MAX)
    }
}

/// The last cell; the first one is 0.
pub(super) const LAST: i16 = i16::MAX - 1;

/// The cell of a sample that failed, beyond all windows.
const MISSING: i16 = i16::MAX;

/// Below all cells.
const NOWHERE: i16 = i16::MIN;

/// Parts of a window in which its values are counted before it is narrowed: a few hundred values decide.
const PARTS: usize = 1 << 10;

/// Cells that are counted together.
const TOGETHER: u32 = 4;
const BUCKETS: usize = 1 << (15 - TOGETHER);

fn bucket(cell: i16) -> usize {
    usize::from(cell.unsigned_abs()) >> TOGETHER
}

fn first_cell(bucket: usize) -> i16 {
    i16::try_from(bucket << TOGETHER).unwrap_or(LAST)
}

fn last_cell(bucket: usize) -> i16 {
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
    fn of(values: &[f64], instructions: Instructions) -> Self {
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

#[cfg(test)]
mod tests {
    use std::slice;

    use super::{Caution, Cells, Ends, LAST, PARTS, SHARES, Watch, Watching, Window};
    use crate::random::{bits, unit};
    use crate::run::Instructions;
    use crate::summary::{PROBABILITIES, SPAN};

    #[test]
    fn shares_are_the_probabilities_in_order() {
        let mut sorted = PROBABILITIES;
        sorted.sort_unstable_by(f64::total_cmp);
        assert_eq!(sorted, SHARES);
    }

    /// Of a million values a few thousand are taken out of each window, whatever the first span has told.
    #[test]
    fn windows_are_narrowed_and_parted() {
        let value = |index: u64| unit(bits(5, index)) + unit(bits(6, index));
        let column: Vec<f64> = (0..1_000_000).map(value).collect();
        let watching = Watching {
            planned: column.len(),
            is_replicated: false,
            instructions: Instructions::best(),
            caution: Caution::USUAL,
        };
        let mut watch = Watch::new(&column[..SPAN], watching);
        assert!(watch.windows.len() < SHARES.len());
        for (number, span) in (1_usize..).zip(column.chunks(SPAN)) {
            watch.add(span);
            if number.is_power_of_two() && number.ilog2() % 2 == 0 {
                watch.narrow([]);
            }
        }
        assert_eq!(watch.windows.len(), SHARES.len());
        let taken: usize = watch.windows.iter().map(|window| window.taken.len()).sum();
        assert!((20_000..100_000).contains(&taken), "{taken}");
    }

    /// Of a window that holds all values: from the first cell of the part with the value at one place to the
    /// last cell of that with the value at another.
    #[test]
    fn cells_reach_from_place_to_place() {
        let column: Vec<f64> = (0..3000).map(|index| unit(bits(8, index))).collect();
        let mut sorted = column.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let cells = Cells::of(&column, Instructions::best());
        let window = Window { taken: column, ..Window::new(0..SHARES.len(), [0, LAST]) };
        for parts in [64, PARTS, 1 << 15] {
            let ends = Ends::of(slice::from_ref(&window), &cells, parts);
            assert!(
                (parts.min(usize::from(LAST.unsigned_abs()) + 1)..=2 * parts).contains(&ends.of_parts.len())
            );
            for [from, to] in [[0, 0], [5, 9], [100, 180], [1490, 1515], [2960, 2998], [7, 2999]] {
                let [low, high] = ends.cells_between([from, to].map(f64::from));
                let part = |place: i32| ends.part(cells.cell(sorted[usize::try_from(place).unwrap()]));
                assert_eq!([ends.part(low), ends.part(high)], [part(from), part(to)], "{from}, {to}");
                assert!(low == 0 || ends.part(low - 1) < ends.part(low));
                assert!(high == LAST || ends.part(high + 1) > ends.part(high));
            }
        }
    }
}
