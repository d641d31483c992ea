//! Some of the values of a column in their order, by one pass over it.
//!
//! The first span tells about where each quantile lies, and how far from there the quantile of all values
//! may be. What lies in this window is taken out; of the rest it is only counted how much lies below. Each
//! thread watches the spans that it does. Now and then the windows of all threads are narrowed, alike, by
//! what they have seen together. In the end the values at the wanted places are sought among the few that
//! were taken out. A window that was predicted wrong, or that holds too many values, is seen by its counts:
//! then [`Order`](super::order::Order) has to find the place by further passes.

use std::ops::Range;
use std::sync::Arc;
use std::{iter, slice};

use fearless_simd::dispatch;

use super::QUANTILES;
use super::cells::{BUCKETS, Cells, LAST, MISSING, NOWHERE, bucket, first_cell, last_cell};
use super::powers::{Powers, Sums};
use super::room::Room;
use super::taken::{Ends, Ranges, Taken};
use crate::limits::REPLICATES;
use crate::model::{LANES, Lanes};
use crate::run::{Instructions, for_each};

/// How a column is watched.
#[derive(Clone, Debug)]
pub(crate) struct Watching<'m> {
    /// How many values are to come.
    pub(crate) planned: usize,
    pub(crate) instructions: Instructions,
    pub(crate) caution: Caution,
    /// Where values are that are taken out.
    pub(crate) room: Arc<Room<'m>>,
}

/// Two to this power of the cells are counted together where windows are narrowed: the counts then fit into
/// the nearest cache. Windows begin and end where such parts do.
const COARSE: u32 = 2;

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
#[derive(Debug)]
pub(crate) struct Watch<'m> {
    of: Watching<'m>,
    pub(super) cells: Cells,
    /// A value in the middle, from which deviations are counted.
    pub(super) centre: f64,
    /// In ascending order.
    pub(super) windows: Vec<Window>,
    /// The values inside them, and how many of these there may be before windows are looked at one by one.
    pub(super) taken: Taken<'m>,
    many: usize,
    open: Open,
    seen: u64,
    /// Its windows then begin and end between the parts of the first span.
    pub(super) is_narrowed: bool,
}

/// A span while its blocks come.
#[derive(Clone, Debug)]
struct Open {
    /// The cells of each window; nowhere, where it was lost before this span.
    ranges: [[i16; 2]; QUANTILES],
    /// How many values lie below each window, of each lane.
    below: [Lanes<i16>; QUANTILES],
    sums: Sums,
    has_clumps: bool,
}

impl Open {
    fn new(windows: &[Window]) -> Self {
        let mut ranges = [[NOWHERE; 2]; QUANTILES];
        for (range, window) in ranges.iter_mut().zip(windows) {
            *range = if window.is_lost { [NOWHERE; 2] } else { window.cells };
        }
        let has_clumps = windows.iter().any(|window| window.clump.is_some());
        Self { ranges, below: [Lanes::splat(0); QUANTILES], sums: Sums::default(), has_clumps }
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
    /// Values inside which are all the same, and are not taken out.
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

impl<'m> Watch<'m> {
    /// Before the first span, which is `pilot`, in which NaN stands for samples that failed.
    pub(crate) fn new(pilot: &[f64], of: Watching<'m>) -> Self {
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
        let last = seen as f64 - 1.0;
        let windows = (0..QUANTILES).map(|share| {
            let [from, to] = of.reach(SHARES[share], seen);
            let low = if from > 0.0 { first_cell(bucket_at(from)) } else { 0 };
            let high = if to < last { last_cell(bucket_at(to)) } else { LAST };
            (share, [low, high])
        });
        let windows: Vec<_> = apart(windows).map(|(shares, cells)| Window::new(shares, cells)).collect();
        Self::unseen(of, cells, centre, windows)
    }

    /// One with the same windows that has seen nothing yet.
    pub(crate) fn unwatched(&self) -> Self {
        let window = |window: &Window| Window::new(window.shares.clone(), window.cells);
        Self::unseen(self.of.clone(), self.cells, self.centre, self.windows.iter().map(window).collect())
    }

    fn unseen(of: Watching<'m>, cells: Cells, centre: f64, windows: Vec<Window>) -> Self {
        let taken = Taken::new(&of.room, of.instructions);
        let (many, open) = (of.most(), Open::new(&windows));
        Self { of, cells, centre, windows, taken, many, open, seen: 0, is_narrowed: false }
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
        let mut cells = Lanes::splat(MISSING);
        for (cell, value) in cells.iter_mut().zip(block) {
            *cell = self.cells.cell(*value);
        }
        // The number of the window that a value is inside, counted from one.
        let mut inside = Lanes::splat(0_i16);
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
        if self.open.has_clumps {
            noted &= !self.count_clumps(noted, &inside, block);
        }
        // Of a window that has just been lost or found to have a clump, a few values may still come.
        while noted != 0 {
            if self.taken.is_full() {
                self.make_place();
            }
            self.taken.take(&mut noted, block, &cells);
        }
    }

    /// Counts those values of a block for which there is a bit that are the clump of their window: the bits
    /// of these.
    #[cold]
    fn count_clumps(&mut self, mut noted: u64, inside: &Lanes<i16>, block: &Lanes) -> u64 {
        let mut counted = 0;
        while noted != 0 {
            let lane = noted.trailing_zeros() as usize;
            noted &= noted - 1;
            let window = usize::from(inside[lane].unsigned_abs()) - 1;
            if let Some(clump) = &mut self.windows[window].clump
                && clump.value.to_bits() == block[lane].to_bits()
            {
                clump.counts[lane % REPLICATES] += 1;
                counted |= 1 << lane;
            }
        }
        counted
    }

    #[cold]
    fn make_place(&mut self) {
        if self.taken.count() >= self.many {
            self.thin_out();
            self.many = self.many_from_here();
        }
        self.taken.make_place(&self.of.room);
    }

    /// To look at all values takes time, so it waits until there are half as many again.
    fn many_from_here(&self) -> usize {
        let count = self.taken.count();
        self.of.most().max(count + count / 2)
    }

    /// Where a window has too many values: if half of them are the same, these are counted from now on;
    /// otherwise the window is lost.
    fn thin_out(&mut self) {
        let ranges = Ranges::of(&self.windows);
        let mut of_windows = vec![0; self.windows.len()];
        for window in self.taken.iter().filter_map(|(_, cell, _)| ranges.number(cell)) {
            of_windows[window] += 1;
        }
        let most = self.of.most();
        let crowded = (0..of_windows.len()).filter(|window| of_windows[*window] >= most);
        for window in crowded.collect::<Vec<_>>() {
            let of_window = self.taken.iter().filter(|(_, cell, _)| ranges.number(*cell) == Some(window));
            let mut values: Vec<f64> = of_window.map(|(value, _, _)| value).collect();
            let middle = values.len() / 2;
            let value = *values.select_nth_unstable_by(middle, f64::total_cmp).1;
            let is_alike = |other: f64| other.to_bits() == value.to_bits();
            let alike = values.iter().filter(|value| is_alike(**value)).count();
            let own = &mut self.windows[window];
            if own.clump.is_some() || alike < middle {
                (own.clump, own.is_lost) = (None, true);
                self.open.ranges[window] = [NOWHERE; 2];
                self.taken.retain(&ranges, |_, _, of| of != window);
                continue;
            }
            let mut counts = [0; REPLICATES];
            self.taken.retain(&ranges, |value, replicate, of| {
                let goes = of == window && is_alike(value);
                counts[replicate] += u64::from(goes);
                !goes
            });
            own.clump = Some(Clump { value, counts });
            self.open.has_clumps = true;
        }
    }

    /// Leaves of each window what may hold a quantile of all values, by what this one and others have seen
    /// together. They have the same windows, before and after it.
    pub(crate) fn narrow<'a>(&'a mut self, others: impl IntoIterator<Item = &'a mut Self>)
    where
        'm: 'a,
    {
        let watches: Vec<&mut Self> = iter::once(self).chain(others).collect();
        let seen = watches.iter().map(|watch| watch.seen).sum();
        let reaches = SHARES.map(|share| watches[0].of.reach(share, seen));
        let ends = Ends::of(watches.iter().map(|watch| &**watch), COARSE);
        let parts_of = |window: usize| {
            if watches.iter().any(|watch| watch.windows[window].is_lost) {
                return Vec::new();
            }
            let shares = watches[0].windows[window].shares.clone();
            apart(shares.map(|share| (share, ends.cells_between(window, reaches[share])))).collect()
        };
        let parts: Vec<_> = ends.windows().map(parts_of).collect();
        for_each(watches, |watch| watch.leave(&parts));
    }

    /// Leaves these parts of each window, which ascend. A window without parts is lost.
    fn leave(&mut self, parts: &[Vec<(Range<usize>, [i16; 2])>]) {
        let mut windows = Vec::new();
        for (window, parts) in self.windows.iter().zip(parts) {
            let part = |(shares, part): &(_, _)| window.part(Range::clone(shares), *part, &self.cells);
            windows.extend(parts.iter().map(part));
            if parts.is_empty() {
                let lost = Window::new(window.shares.clone(), window.cells);
                windows.push(Window { is_lost: true, ..lost });
            }
        }
        let [old, new] = [&self.windows, &windows].map(Ranges::of);
        let begun = self.taken.leave(&old, &new);
        let mut new = windows.iter_mut().enumerate();
        for (begun, parts) in begun.iter().skip(1).zip(parts) {
            for (place, window) in new.by_ref().take(parts.len().max(1)) {
                // A value lies below those that have not begun at its cell.
                begun[..=place].iter().for_each(|counts| window.add_below(counts));
            }
        }
        self.open = Open::new(&windows);
        self.windows = windows;
        self.many = self.many_from_here();
        self.is_narrowed = true;
    }
}

impl Watching<'_> {
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

    /// Values that may be taken out of one window.
    fn most(&self) -> usize {
        let Caution { roots, few, .. } = self.caution;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number")]
        let most = ((self.planned as f64).sqrt() * roots) as usize;
        most.max(few)
    }
}

impl Window {
    fn new(shares: Range<usize>, cells: [i16; 2]) -> Self {
        Self { shares, cells, below: [0; REPLICATES], clump: None, is_lost: false }
    }

    /// Some of its cells. What was taken out below is still to be counted.
    fn part(&self, shares: Range<usize>, [low, high]: [i16; 2], cells: &Cells) -> Self {
        let mut part = Self { below: self.below, ..Self::new(shares, [low, high]) };
        if let Some(clump) = &self.clump {
            let cell = cells.cell(clump.value);
            if cell < low {
                part.add_below(&clump.counts);
            } else if cell <= high {
                part.clump = Some(clump.clone());
            }
        }
        part
    }

    fn add_below(&mut self, counts: &[u64; REPLICATES]) {
        add_counts(&mut self.below, counts);
    }
}

/// Adds what was counted of each replicate.
pub(super) fn add_counts(counts: &mut [u64; REPLICATES], more: &[u64; REPLICATES]) {
    for (count, more) in counts.iter_mut().zip(more) {
        *count += more;
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

#[cfg(test)]
mod tests {
    use std::iter;
    use std::sync::Arc;

    use super::{
        COARSE, Caution, Cells, Clump, Ends, LAST, Open, REPLICATES, SHARES, Watch, Watching, Window,
    };
    use crate::random::{bits, unit};
    use crate::run::Instructions;
    use crate::summary::{PROBABILITIES, SPAN, Store};

    fn watching(planned: usize, store: &mut Store) -> Watching<'_> {
        Watching {
            planned,
            instructions: Instructions::best(),
            caution: Caution::USUAL,
            room: Arc::new(store.room()),
        }
    }

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
        let mut store = Store::new(1, column.len(), false);
        let watching = watching(column.len(), &mut store);
        let mut watch = Watch::new(&column[..SPAN], watching);
        assert!(watch.windows.len() < SHARES.len());
        for (number, span) in (1_usize..).zip(column.chunks(SPAN)) {
            watch.add(span);
            if number.is_power_of_two() && number.ilog2() % 2 == 0 {
                watch.narrow([]);
            }
        }
        assert_eq!(watch.windows.len(), SHARES.len());
        let taken = watch.taken.count();
        assert!((20_000..100_000).contains(&taken), "{taken}");
    }

    /// Values that are all the same are below a part of their window, in it, or beyond it.
    #[test]
    fn a_clump_is_counted_where_it_lies() {
        let cells = Cells::of(&[0.0, 1.0], Instructions::best());
        let counts = [7; REPLICATES];
        let clump = Some(Clump { value: 0.5, counts });
        let window = Window { below: [2; REPLICATES], clump, ..Window::new(0..3, [0, LAST]) };
        let own = cells.cell(0.5);
        for (part, below, is_inside) in
            [([0, own - 1], 2, false), ([own, own], 2, true), ([own + 1, LAST], 9, false)]
        {
            let part = window.part(1..2, part, &cells);
            assert_eq!((part.below, part.clump.is_some()), ([below; REPLICATES], is_inside));
        }
    }

    /// Of a window that holds all values: from the first cell of the part with the value at one place to the
    /// last cell of that with the value at another.
    #[test]
    fn cells_reach_from_place_to_place() {
        let column: Vec<f64> = (0..3000).map(|index| unit(bits(8, index))).collect();
        let mut sorted = column.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let mut store = Store::new(1, column.len(), false);
        let watching = watching(column.len(), &mut store);
        let mut watch = Watch::new(&column, watching);
        watch.windows = vec![Window::new(0..SHARES.len(), [0, LAST])];
        watch.open = Open::new(&watch.windows);
        watch.add(&column);
        let cells = watch.cells;
        let ends = Ends::of(iter::once(&watch), COARSE);
        let part = |cell: i16| ends.part(cell);
        let part_of = |place: i32| part(cells.cell(sorted[usize::try_from(place).unwrap()]));
        for [from, to] in [[0, 0], [5, 9], [100, 180], [1490, 1515], [2960, 2998], [7, 2999]] {
            let [low, high] = ends.cells_between(0, [from, to].map(f64::from));
            assert_eq!([part(low), part(high)], [part_of(from), part_of(to)], "{from}, {to}");
            assert!(low == 0 || part(low - 1) < part(low));
            assert!(high == LAST || part(high + 1) > part(high));
        }
    }
}
