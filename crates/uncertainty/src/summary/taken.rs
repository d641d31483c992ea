//! The values of a column that were taken out of it, and about how they are spread.

use std::ops::Range;

use fearless_simd::dispatch;

use super::QUANTILES;
use super::cells::{LAST, MISSING, NOWHERE};
use super::room::{PIECE, Piece, Room};
use super::watch::{Watch, Window};
use crate::limits::REPLICATES;
use crate::model::Lanes;
use crate::run::Instructions;

/// Values that were taken out, of all windows, in no order. Where windows are narrowed, their places are used
/// again.
#[derive(Debug)]
pub(super) struct Taken<'m> {
    pieces: Vec<Piece<'m>>,
    /// The one to which values are added.
    current: usize,
    instructions: Instructions,
}

impl<'m> Taken<'m> {
    pub(super) fn new(room: &Room<'m>, instructions: Instructions) -> Self {
        Self { pieces: vec![Piece::new(room)], current: 0, instructions }
    }

    pub(super) fn count(&self) -> usize {
        self.pieces.iter().map(Piece::len).sum()
    }

    /// Whether there is no place for another value before [`make_place`](Self::make_place).
    #[inline]
    pub(super) fn is_full(&self) -> bool {
        self.pieces[self.current].is_full()
    }

    pub(super) fn make_place(&mut self, room: &Room<'m>) {
        let with_room = self.pieces.iter().position(|piece| !piece.is_full());
        self.current = with_room.unwrap_or(self.pieces.len());
        if with_room.is_none() {
            self.pieces.push(Piece::new(room));
        }
    }

    /// Adds the values of a block for which there is a bit, as many as there is place for. Leaves the bits of
    /// the others.
    #[inline]
    pub(super) fn take(&mut self, noted: &mut u64, block: &Lanes, cells: &Lanes<i16>) {
        self.pieces[self.current].take(noted, block, cells);
    }

    /// Each value with its cell and replicate.
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = (f64, i16, usize)> {
        self.pieces.iter().flat_map(Piece::iter)
    }

    /// The values in some of the cells, each with its own.
    pub(super) fn in_cells(&self, are_wanted: impl Fn(i16) -> bool) -> Vec<(f64, i16)> {
        let mut found = Vec::new();
        for piece in &self.pieces {
            let wanted = piece.cells().iter().zip(piece.values()).filter(|(cell, _)| are_wanted(**cell));
            found.extend(wanted.map(|(cell, value)| (*value, *cell)));
        }
        found
    }

    /// Shows the values inside ranges: the number of the range, the value and its replicate.
    pub(super) fn in_ranges(&self, ranges: &Ranges, mut show: impl FnMut(usize, f64, usize)) {
        let mut begun = [0; PIECE];
        for piece in &self.pieces {
            ranges.count_begun(self.instructions, piece.cells(), &mut begun);
            for ((value, cell, replicate), begun) in piece.iter().zip(begun) {
                if ranges.is_inside(cell, begun) {
                    show(usize::from(begun.unsigned_abs()) - 1, value, replicate);
                }
            }
        }
    }

    /// Leaves the values inside the `new` ranges. Of those inside each old one it is counted how many new
    /// ones begin at their cells or below, and for each replicate.
    pub(super) fn leave(&mut self, old: &Ranges, new: &Ranges) -> Box<Begun> {
        let mut counts = Box::new([[[0; REPLICATES]; QUANTILES + 1]; QUANTILES + 1]);
        let [mut begun_old, mut begun_new] = [[0; PIECE]; 2];
        for piece in &mut self.pieces {
            old.count_begun(self.instructions, piece.cells(), &mut begun_old);
            new.count_begun(self.instructions, piece.cells(), &mut begun_new);
            piece.retain(|place, (_, cell, replicate)| {
                let [from, to] = [begun_old[place], begun_new[place]];
                let [from_old, from_new] = [from, to].map(|begun| usize::from(begun.unsigned_abs()));
                counts[from_old][from_new][replicate] += 1;
                new.is_inside(cell, to)
            });
        }
        counts
    }

    /// Leaves those that are to stay, by their values, replicates and ranges. Those in no range go.
    pub(super) fn retain(&mut self, ranges: &Ranges, mut stays: impl FnMut(f64, usize, usize) -> bool) {
        for piece in &mut self.pieces {
            piece.retain(|_, (value, cell, replicate)| {
                ranges.number(cell).is_some_and(|range| stays(value, replicate, range))
            });
        }
    }
}

/// How many values there are inside each old range, that have so many new ones begun, of each replicate.
pub(super) type Begun = [[[u64; REPLICATES]; QUANTILES + 1]; QUANTILES + 1];

/// Cells from the first to the last, that ascend.
#[derive(Clone, Debug)]
pub(super) struct Ranges {
    lows: [i16; QUANTILES],
    /// The last cell of what begins nowhere, which holds none, and then of each.
    highs: [i16; HIGHS],
}

/// A power of two beyond the number of ranges.
const HIGHS: usize = (QUANTILES + 1).next_power_of_two();

impl Ranges {
    /// No value is inside a window that is lost.
    pub(super) fn of<'a>(windows: impl IntoIterator<Item = &'a Window>) -> Self {
        let mut ranges = Self { lows: [MISSING; QUANTILES], highs: [NOWHERE; HIGHS] };
        let ends = ranges.lows.iter_mut().zip(&mut ranges.highs[1..]);
        for ((low, high), window) in ends.zip(windows) {
            (*low, *high) = (window.cells[0], if window.is_lost { NOWHERE } else { window.cells[1] });
        }
        ranges
    }

    /// How many begin at each cell or below.
    fn count_begun(&self, instructions: Instructions, cells: &[i16], begun: &mut [i16; PIECE]) {
        dispatch!(instructions.level(), _simd => self.count_begun_with(cells, begun));
    }

    #[inline(always)]
    fn count_begun_with(&self, cells: &[i16], begun: &mut [i16; PIECE]) {
        begun.fill(0);
        for low in self.lows {
            for (begun, cell) in begun.iter_mut().zip(cells) {
                *begun += i16::from(low <= *cell);
            }
        }
    }

    /// The number of the one that holds a cell.
    pub(super) fn number(&self, cell: i16) -> Option<usize> {
        let begun: i16 = self.lows.iter().map(|low| i16::from(*low <= cell)).sum();
        self.is_inside(cell, begun).then(|| usize::from(begun.unsigned_abs()) - 1)
    }

    #[inline(always)]
    fn is_inside(&self, cell: i16, begun: i16) -> bool {
        cell <= self.highs[usize::from(begun.unsigned_abs()) % HIGHS]
    }
}

/// How the values inside some windows are spread over their parts.
#[derive(Debug)]
pub(super) struct Ends {
    /// Two to this power of the cells are one part.
    shift: u32,
    windows: Vec<Spread>,
}

/// Of one window, which begins and ends where parts do.
#[derive(Debug)]
struct Spread {
    cells: [i16; 2],
    /// How many values lie below the first cell.
    first: usize,
    /// The place after the last value of each part.
    ends: Vec<usize>,
}

impl Ends {
    /// Of the windows of watches that have the same ones. Two to the power of `shift` of the cells are one
    /// part.
    pub(super) fn of<'a, 'm: 'a>(watches: impl Iterator<Item = &'a Watch<'m>> + Clone, shift: u32) -> Self {
        let mut ends = Self { shift, windows: Vec::new() };
        let part = |cell: i16| ends.part(cell);
        let mut counts = vec![0_u32; ends.parts()];
        for watch in watches.clone() {
            for cell in watch.taken.pieces.iter().flat_map(Piece::cells) {
                counts[part(*cell)] += 1;
            }
        }
        let windows = watches.clone().next().map_or(0, |watch| watch.windows.len());
        let spread = |number: usize| {
            let windows = watches.clone().map(|watch| (&watch.windows[number], &watch.cells));
            let cells = windows.clone().next().map_or([0, LAST], |(window, _)| window.cells);
            let [from, to] = cells.map(part);
            let mut ends: Vec<usize> = counts[from..=to].iter().map(|count| *count as usize).collect();
            let mut below = 0;
            for (window, cells) in windows {
                below += window.below.iter().sum::<u64>();
                if let Some(clump) = &window.clump {
                    ends[part(cells.cell(clump.value)) - from] += clump.count();
                }
            }
            let first = usize::try_from(below).unwrap_or(usize::MAX);
            let mut end = first;
            for count in &mut ends {
                end += *count;
                *count = end;
            }
            Spread { cells, first, ends }
        };
        ends.windows = (0..windows).map(spread).collect();
        ends
    }

    /// How many parts all cells have.
    pub(super) fn parts(&self) -> usize {
        self.part(LAST) + 1
    }

    /// The part that a cell belongs to.
    #[inline]
    pub(super) fn part(&self, cell: i16) -> usize {
        usize::from(cell.unsigned_abs() >> self.shift)
    }

    pub(super) fn windows(&self) -> Range<usize> {
        0..self.windows.len()
    }

    pub(super) fn cells(&self, window: usize) -> [i16; 2] {
        self.windows[window].cells
    }

    /// The places of the values inside a window.
    pub(super) fn places(&self, window: usize) -> Range<usize> {
        let Spread { first, ends, .. } = &self.windows[window];
        *first..ends.last().map_or(*first, |end| *end)
    }

    /// The number of the first part of a window, and the place after the last value of each.
    pub(super) fn of_window(&self, window: usize) -> (usize, &[usize]) {
        let Spread { cells: [low, _], ends, .. } = &self.windows[window];
        (self.part(*low), ends)
    }

    /// The cells of the parts between the places `from` and `to`, as far as they are inside a window.
    pub(super) fn cells_between(&self, window: usize, [from, to]: [f64; 2]) -> [i16; 2] {
        let [first, last] = self.cells(window);
        let (first_part, ends) = self.of_window(window);
        let places = self.places(window);
        let at = |cell: usize| i16::try_from(cell).unwrap_or(last).min(last);
        // The first cell of the part that holds a place, or of one after it.
        let begin = |place: f64, after: usize| {
            let part = ends.partition_point(|end| *end as f64 <= place) + after;
            (first_part + part) << self.shift
        };
        let low = if from > places.start as f64 { at(begin(from, 0)) } else { first };
        let high = if to < places.end as f64 - 1.0 { at(begin(to, 1) - 1) } else { last };
        [low, high]
    }
}
