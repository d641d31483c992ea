//! What the windows of a column tell, whoever has watched which of its spans.

use std::iter;

use super::order::Bracket;
use super::watch::{Cells, Ends, LAST, Watch, Window};
use crate::limits::REPLICATES;

/// A column of which all spans have been watched.
#[derive(Debug)]
pub(crate) struct Watched {
    cells: Cells,
    /// In ascending order.
    held: Vec<Held>,
    /// A value in the middle, from which deviations are counted.
    pub(super) centre: f64,
}

/// Cells of which every watch has kept the values.
#[derive(Debug)]
struct Held {
    /// Of each watch.
    windows: Vec<Window>,
    ends: Ends,
}

/// Parts of a window are as many as its values, at most, or so many.
const FEW: usize = 64;

impl Watched {
    /// By watches that have the same windows.
    pub(crate) fn by(watch: Watch, others: impl IntoIterator<Item = Watch>) -> Self {
        let Watch { cells, centre, windows, .. } = watch;
        let mut others: Vec<_> = others.into_iter().map(|other| other.windows.into_iter()).collect();
        let held = windows.into_iter().filter_map(|window| {
            let windows: Vec<Window> =
                iter::once(window).chain(others.iter_mut().filter_map(Iterator::next)).collect();
            if windows.iter().any(|window| window.is_lost) {
                return None;
            }
            let values: usize = windows.iter().map(|window| window.taken.len()).sum();
            let ends = Ends::of(&windows, &cells, values.max(FEW));
            Some(Held { windows, ends })
        });
        Self { cells, held: held.collect(), centre }
    }

    /// The values at places that ascend; `None` where they are not among those that were taken out.
    pub(super) fn find(&self, places: &[usize]) -> Vec<Option<f64>> {
        let mut values = vec![None; places.len()];
        for held in &self.held {
            let before = |end: usize| places.partition_point(|place| *place < end);
            let inside = before(held.ends.first)..before(held.ends.last());
            if !inside.is_empty() {
                self.find_in(held, &places[inside.clone()], &mut values[inside]);
            }
        }
        values
    }

    /// Only the parts that hold a place are put in order.
    fn find_in(&self, Held { windows, ends }: &Held, places: &[usize], values: &mut [Option<f64>]) {
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
        let holds = |cell: i16| is_wanted[ends.part(cell)];
        // Each with how often it is there.
        let mut sorted: Vec<(f64, usize)> = Vec::new();
        for window in windows {
            let of_taken = self.cells.of_all(&window.taken);
            let taken = window.taken.iter().zip(of_taken).filter(|(_, cell)| holds(*cell));
            sorted.extend(taken.map(|(value, _)| (*value, 1)));
            let clump = window.clump.iter().filter(|clump| holds(self.cells.cell(clump.value)));
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
        for Held { ends, .. } in &self.held {
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
        let cell = self.cells.cell(value);
        let holds = |held: &&Held| held.ends.cells[0] <= cell && cell <= held.ends.cells[1];
        let Held { windows, .. } = self.held.iter().find(holds)?;
        let of = |other: f64| u64::from(other < value) + u64::from(other <= value);
        let mut twice = [0; REPLICATES];
        for window in windows {
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
