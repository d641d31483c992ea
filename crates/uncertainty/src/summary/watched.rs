//! What the windows of a column tell, whoever has watched which of its spans.

use std::iter;
use std::ops::Range;

use super::QUANTILES;
use super::cells::{Cells, LAST, TOGETHER};
use super::order::Bracket;
use super::taken::{Ends, Ranges, Taken};
use super::watch::{Clump, Watch, add_counts};
use crate::limits::REPLICATES;
use crate::run::for_each;

/// A column of which all spans have been watched.
#[derive(Debug)]
pub(crate) struct Watched<'m> {
    cells: Cells,
    /// Of which every watch has kept the values. In ascending order.
    held: Vec<Held>,
    ranges: Ranges,
    ends: Ends,
    /// The values inside them, by each watch.
    taken: Vec<Taken<'m>>,
    /// A value in the middle, from which deviations are counted.
    pub(super) centre: f64,
}

/// Two to this power of the cells are one part where places are found: the values of a few parts are sorted.
/// Before windows are narrowed there are so few values that to count them in such parts takes longer.
const FINE: u32 = 1;

/// Some places inside a window.
struct Sought {
    /// Which of all places.
    inside: Range<usize>,
    /// Of each, how many values come before it in the parts that hold a place.
    among: Vec<usize>,
    /// The values in these parts, each with how often it is there.
    sorted: Vec<(f64, usize)>,
}

/// A window, whoever has watched it.
#[derive(Debug, Default)]
struct Held {
    /// Values below, of each replicate.
    below: [u64; REPLICATES],
    clumps: Vec<Clump>,
}

impl<'m> Watched<'m> {
    /// By watches that have the same windows.
    pub(crate) fn by(watch: Watch<'m>, others: impl IntoIterator<Item = Watch<'m>>) -> Self {
        let (cells, centre, windows) = (watch.cells, watch.centre, watch.windows.len());
        let mut watches: Vec<Watch<'_>> = iter::once(watch).chain(others).collect();
        let is_lost = |window: usize| watches.iter().any(|watch| watch.windows[window].is_lost);
        let lost: Vec<bool> = (0..windows).map(is_lost).collect();
        let mut held = Vec::new();
        held.resize_with(lost.iter().filter(|is_lost| !**is_lost).count(), Held::default);
        for watch in &mut watches {
            let mut lost = lost.iter();
            watch.windows.retain(|_| lost.next().is_some_and(|is_lost| !is_lost));
            for (held, window) in held.iter_mut().zip(&watch.windows) {
                add_counts(&mut held.below, &window.below);
                held.clumps.extend(window.clump.clone());
            }
        }
        let shift = if watches.iter().any(|watch| watch.is_narrowed) { FINE } else { TOGETHER };
        let ends = Ends::of(watches.iter(), shift);
        let ranges = Ranges::of(watches.iter().take(1).flat_map(|watch| &watch.windows));
        let taken = watches.into_iter().map(|watch| watch.taken).collect();
        Self { cells, held, ranges, ends, taken, centre }
    }

    /// The values at places that ascend; `None` where they are not among those that were taken out. Only the
    /// parts that hold a place are put in order.
    pub(super) fn find(&self, places: &[usize]) -> Vec<Option<f64>> {
        let before = |end: usize| places.partition_point(|place| *place < end);
        let mut is_wanted = vec![false; self.ends.parts()];
        let sought = self.ends.windows().map(|window| {
            let Range { start, end } = self.ends.places(window);
            let inside = before(start)..before(end);
            let among = self.among(window, &places[inside.clone()], &mut is_wanted);
            Sought { inside, among, sorted: Vec::new() }
        });
        let mut sought: Vec<Sought> = sought.collect();
        let is_wanted = |cell: i16| is_wanted[self.ends.part(cell)];
        for (value, cell) in for_each(&self.taken, |taken| taken.in_cells(is_wanted)).into_iter().flatten() {
            if let Some(window) = self.ranges.number(cell) {
                sought[window].sorted.push((value, 1));
            }
        }
        let mut values = vec![None; places.len()];
        for (window, Sought { inside, among, mut sorted }) in sought.into_iter().enumerate() {
            let clumps = self.held[window].clumps.iter();
            let wanted = clumps.filter(|clump| is_wanted(self.cells.cell(clump.value)));
            sorted.extend(wanted.map(|clump| (clump.value, clump.count())));
            sorted.sort_unstable_by(|(one, _), (other, _)| one.total_cmp(other));
            let mut sorted = sorted.into_iter();
            let (mut known, mut before) = (None, 0);
            for (value, place) in values[inside].iter_mut().zip(among) {
                while before <= place
                    && let Some((next, count)) = sorted.next()
                {
                    known = Some(next);
                    before += count;
                }
                *value = known.filter(|_| place < before);
            }
        }
        values
    }

    /// Notes the parts of a window that hold one of the places inside it. Of each place, how many values in
    /// such parts come before.
    fn among(&self, window: usize, places: &[usize], is_wanted: &mut [bool]) -> Vec<usize> {
        let (first_part, ends) = self.ends.of_window(window);
        let first = self.ends.places(window).start;
        let mut among = Vec::with_capacity(places.len());
        let (mut part, mut begin, mut skipped) = (0, first, 0);
        for place in places {
            while let Some(end) = ends.get(part)
                && end <= place
            {
                skipped += if is_wanted[first_part + part] { 0 } else { end - begin };
                begin = *end;
                part += 1;
            }
            is_wanted[first_part + part] = true;
            among.push(place - first - skipped);
        }
        among
    }

    /// The values between which a place lies, of `count` in all.
    pub(super) fn bracket(&self, place: usize, count: usize) -> Bracket {
        let mut bracket = Bracket { first: 0, count, least: 0, greatest: u64::MAX };
        let mut part = |before: usize, cell: i16| {
            let end = self.cells.key_of(cell);
            if before <= place {
                (bracket.first, bracket.least) = (before, end);
                bracket.count = count - before;
            } else if bracket.greatest == u64::MAX {
                bracket.greatest = end - 1;
                bracket.count = before - bracket.first;
            }
        };
        for window in self.ends.windows() {
            let ([low, high], Range { start, end }) = (self.ends.cells(window), self.ends.places(window));
            if low > 0 {
                part(start, low);
            }
            if high < LAST {
                part(end, high + 1);
            }
        }
        bracket
    }

    /// Twice the number of values of each replicate below each of these, so that one at the value itself
    /// counts by half; `None` where one of them lies in no window.
    pub(super) fn twice_below(&self, values: &[f64; QUANTILES]) -> Option<[[u64; REPLICATES]; QUANTILES]> {
        let of = |other: f64, value: f64| u64::from(other < value) + u64::from(other <= value);
        let mut twice = [[0; REPLICATES]; QUANTILES];
        let mut inside = vec![Vec::new(); self.held.len()];
        for (index, (twice, value)) in twice.iter_mut().zip(values).enumerate() {
            let cell = self.cells.cell(*value);
            let window = self.ranges.number(cell)?;
            let Held { below, clumps } = &self.held[window];
            *twice = below.map(|below| 2 * below);
            for Clump { value: other, counts } in clumps {
                for (twice, count) in twice.iter_mut().zip(counts) {
                    *twice += count * of(*other, *value);
                }
            }
            inside[window].push((index, *value));
        }
        for taken in &self.taken {
            taken.in_ranges(&self.ranges, |window, other, replicate| {
                for (index, value) in &inside[window] {
                    twice[*index][replicate] += of(other, *value);
                }
            });
        }
        Some(twice)
    }
}
