//! What the windows of a column tell, whoever has watched which of its spans.

use super::order::Bracket;
use super::watch::{Cells, Ends, LAST, Watch, Window};
use crate::limits::REPLICATES;

/// A column of which all spans have been watched.
#[derive(Debug)]
pub(crate) struct Watched {
    watches: Vec<Watch>,
    /// In ascending order.
    shared: Vec<Shared>,
    /// A value in the middle, from which deviations are counted.
    pub(super) centre: f64,
}

/// Cells of which every watch has kept the values.
#[derive(Debug)]
struct Shared {
    /// Which window of each watch has them.
    windows: Vec<usize>,
    ends: Ends,
}

/// Parts of a window are as many as its values, at most, or so many.
const FEW: usize = 64;

impl Watched {
    /// By watches that began alike.
    pub(crate) fn by(watches: Vec<Watch>) -> Self {
        let mut shared = vec![([0, LAST], Vec::new())];
        for watch in &watches {
            shared = cut(&shared, &watch.windows);
        }
        let of = |(cells, windows): ([i16; 2], Vec<usize>)| {
            let sources = sources(&watches, &windows);
            let values: usize = sources.iter().map(|window| window.taken.len()).sum();
            let count = usize::from((cells[1] - cells[0]).unsigned_abs()) + 1;
            let shift = (count / values.max(FEW)).max(1).ilog2();
            let ends = watches.first().map(|watch| Ends::of(&sources, &watch.cells, cells, shift));
            ends.map(|ends| Shared { windows, ends })
        };
        let centre = watches.first().map_or(0.0, |watch| watch.centre);
        let shared = shared.into_iter().filter_map(of).collect();
        Self { watches, shared, centre }
    }

    fn cells(&self) -> Option<Cells> {
        self.watches.first().map(|watch| watch.cells)
    }

    /// The values at places that ascend; `None` where they are not among those that were taken out.
    pub(super) fn find(&self, places: &[usize]) -> Vec<Option<f64>> {
        let mut values = vec![None; places.len()];
        for shared in &self.shared {
            let before = |end: usize| places.partition_point(|place| *place < end);
            let inside = before(shared.ends.first)..before(shared.ends.last());
            if !inside.is_empty() {
                self.find_in(shared, &places[inside.clone()], &mut values[inside]);
            }
        }
        values
    }

    /// Only the parts that hold a place are put in order.
    fn find_in(&self, Shared { windows, ends }: &Shared, places: &[usize], values: &mut [Option<f64>]) {
        let parts = &ends.of_parts;
        let mut is_wanted = vec![false; parts.len()];
        // Of each place, how many values in such parts come before.
        let mut among = Vec::with_capacity(places.len());
        let (mut part, mut begin, mut skipped) = (0, ends.first, 0);
        for place in places {
            while let Some(end) = parts.get(part)
                && end <= place
            {
                skipped += if is_wanted[part] { 0 } else { end - begin };
                begin = *end;
                part += 1;
            }
            if let Some(is_wanted) = is_wanted.get_mut(part) {
                *is_wanted = true;
            }
            among.push(place - ends.first - skipped);
        }
        let Some(cells) = self.cells() else { return };
        let holds = |cell: i16| {
            let [low, high] = ends.cells;
            low <= cell && cell <= high && is_wanted.get(ends.part(cell)).is_some_and(|is_wanted| *is_wanted)
        };
        // Each with how often it is there.
        let mut sorted: Vec<(f64, usize)> = Vec::new();
        for window in sources(&self.watches, windows) {
            let of_taken = cells.of_all(&window.taken);
            let taken = window.taken.iter().zip(of_taken).filter(|(_, cell)| holds(*cell));
            sorted.extend(taken.map(|(value, _)| (*value, 1)));
            let clump = window.clump.iter().filter(|clump| holds(cells.cell(clump.value)));
            sorted.extend(clump.map(|clump| (clump.value, clump.count())));
        }
        sorted.sort_unstable_by(|(one, _), (other, _)| one.total_cmp(other));
        let mut sorted = sorted.into_iter();
        let (mut known, mut before) = (None, 0);
        for (value, place) in values.iter_mut().zip(among) {
            while before <= place
                && let Some((next, count)) = sorted.next()
            {
                known = Some(next);
                before += count;
            }
            *value = known.filter(|_| place < before);
        }
    }

    /// The values between which a place lies, of `count` in all.
    pub(super) fn bracket(&self, place: usize, count: usize) -> Bracket {
        let mut bracket = Bracket { first: 0, count, least: 0, greatest: u64::MAX };
        let Some(watch) = self.watches.first() else { return bracket };
        let mut part = |before: usize, cell: i16| {
            let end = watch.cells.key_of(cell);
            if before <= place {
                (bracket.first, bracket.least) = (before, end);
                bracket.count = count - before;
            } else if bracket.greatest == u64::MAX {
                bracket.greatest = end - 1;
                bracket.count = before - bracket.first;
            }
        };
        for Shared { ends, .. } in &self.shared {
            let [low, high] = ends.cells;
            if low > 0 {
                part(ends.first, low);
            }
            if high < LAST {
                part(ends.last(), high + 1);
            }
        }
        bracket
    }

    /// Twice the number of values of each replicate below a value, so that one at the value itself counts by
    /// half; `None` where it lies in no window.
    pub(super) fn twice_below(&self, value: f64) -> Option<[u64; REPLICATES]> {
        let cell = self.cells()?.cell(value);
        let holds = |shared: &&Shared| shared.ends.cells[0] <= cell && cell <= shared.ends.cells[1];
        let Shared { windows, .. } = self.shared.iter().find(holds)?;
        let of = |other: f64| u64::from(other < value) + u64::from(other <= value);
        let mut twice = [0; REPLICATES];
        for window in sources(&self.watches, windows) {
            for (twice, below) in twice.iter_mut().zip(window.below) {
                *twice += 2 * below;
            }
            for (taken, replicate) in window.taken.iter().zip(&window.replicates) {
                twice[usize::from(*replicate) % REPLICATES] += of(*taken);
            }
            if let Some(clump) = &window.clump {
                for (twice, count) in twice.iter_mut().zip(clump.counts) {
                    *twice += count * of(clump.value);
                }
            }
        }
        Some(twice)
    }
}

/// The window of each watch.
fn sources<'a>(watches: &'a [Watch], windows: &[usize]) -> Vec<&'a Window> {
    watches.iter().zip(windows).filter_map(|(watch, window)| watch.windows.get(*window)).collect()
}

/// What windows have in common with cells, with their numbers.
fn cut(shared: &[([i16; 2], Vec<usize>)], windows: &[Window]) -> Vec<([i16; 2], Vec<usize>)> {
    let mut cut = Vec::new();
    for ([low, high], numbers) in shared {
        for (number, window) in windows.iter().enumerate().filter(|(_, window)| !window.is_lost) {
            let cells = [window.cells[0].max(*low), window.cells[1].min(*high)];
            if cells[0] <= cells[1] {
                cut.push((cells, numbers.iter().copied().chain([number]).collect()));
            }
        }
    }
    cut
}
