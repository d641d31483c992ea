//! Some of the values of a column in their order, by passes over it.

use std::ops::Range;

/// How finely the range of the values is cut, and how many of them may be taken out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    /// Cells of equal width.
    pub(crate) cells: u32,
    /// The most values that are taken out of a cell at once; where it has more, it is cut again.
    pub(crate) most: usize,
}

/// Finds the values at wanted places, counted from zero and ascending, of the values in their order.
///
/// The range of the values is cut into equal cells. One pass counts the values in each; a second one takes
/// out those of the few cells in which a wanted place lies, which alone are put in order. Where a cell has
/// more values than may be taken out, further passes cut it into parts until it is known to hold one value
/// only, or few. However the values lie, this is right; where most lie in one cell, it takes longer.
#[derive(Debug)]
pub(super) struct Order {
    size: Size,
    cells: Option<Cells>,
    counts: Vec<usize>,
    /// Of each cell, its first window, or [`NONE`].
    slots: Vec<u8>,
    windows: Vec<Window>,
    /// Values that were taken out for places of before, and the place of the least of them.
    taken: Vec<(usize, Vec<f64>)>,
    places: Vec<usize>,
    /// Of each wanted place, once it is known.
    values: Vec<Option<f64>>,
}

/// How many of the first values tell where the cells lie.
const TOLD_BY: usize = 1 << 12;

/// Values whose cells are found together.
const AHEAD: usize = 64;

/// No window. There are fewer windows: a summary wants 72 places at most.
const NONE: u8 = u8::MAX;

impl Order {
    pub(super) fn new(size: Size) -> Self {
        let places = size.cells as usize;
        Self {
            size,
            cells: None,
            counts: vec![0; places],
            slots: vec![NONE; places],
            windows: Vec::new(),
            taken: Vec::new(),
            places: Vec::new(),
            values: Vec::new(),
        }
    }

    /// The first pass. The first values that come tell where the cells lie; what lies beyond counts to the
    /// outermost.
    #[inline(always)]
    pub(super) fn count(&mut self, values: &[f64]) {
        if values.is_empty() {
            return;
        }
        let first = &values[..values.len().min(TOLD_BY)];
        let cells = *self.cells.get_or_insert_with(|| Cells::of(first, self.size.cells));
        cells.count(values, &mut self.counts);
    }

    /// The same for values that were counted by these cells.
    pub(super) fn add_counted(&mut self, cells: Cells, counts: &[u32]) {
        self.cells = Some(cells);
        for (count, more) in self.counts.iter_mut().zip(counts) {
            *count += *more as usize;
        }
    }

    /// Asks for the values at these places, and tells whether all are known. If they are not, it begins a
    /// pass with [`take`](Self::take).
    pub(super) fn seek(&mut self, wanted: impl Iterator<Item = usize>) -> bool {
        self.places = wanted.collect();
        self.places.sort_unstable();
        self.places.dedup();
        self.values = vec![None; self.places.len()];
        for (first, taken) in &mut self.taken {
            let here = within(&self.places, *first, taken.len());
            find(taken, *first, &self.places[here.clone()], &mut self.values[here]);
        }
        let unknown = self.places.iter().zip(&self.values).filter(|(_, value)| value.is_none());
        let unknown: Vec<usize> = unknown.map(|(place, _)| *place).collect();
        let (most, all) = (self.size.most, Bounds { least: 0, greatest: u64::MAX });
        let counts = self.counts.iter().map(|&count| (count, all));
        self.windows = windows(&unknown, 0, counts, most);
        self.note_slots();
        self.windows.is_empty()
    }

    /// All values, in any order, once in each pass.
    #[inline(always)]
    pub(super) fn take(&mut self, values: &[f64]) {
        let Self { cells: Some(cells), slots, windows, .. } = self else { return };
        let mut of_each = [0; AHEAD];
        for values in values.chunks(AHEAD) {
            cells.of_each(values, &mut of_each);
            let mut own = [NONE; AHEAD];
            for (slot, cell) in own[..values.len()].iter_mut().zip(of_each) {
                *slot = slots.get(cell as usize).copied().unwrap_or(NONE);
            }
            // A bit for each value whose cell has a window, so that only these are gone through.
            let mut noted = 0_u64;
            for (place, slot) in own.iter().enumerate() {
                noted |= u64::from(*slot != NONE) << place;
            }
            while noted != 0 {
                let place = noted.trailing_zeros() as usize;
                noted &= noted - 1;
                for window in &mut windows[usize::from(own[place])..] {
                    if window.cell != of_each[place] as usize {
                        break;
                    }
                    window.note(values[place]);
                }
            }
        }
    }

    /// Ends a pass with [`take`](Self::take), and tells whether all wanted values are known. If they are not,
    /// another pass is wanted.
    pub(super) fn settle(&mut self) -> bool {
        let mut waiting = Vec::new();
        for window in std::mem::take(&mut self.windows) {
            let here = within(&self.places, window.first, window.count);
            let (places, values) = (&self.places[here.clone()], &mut self.values[here]);
            match window.kind {
                Kind::Taken(mut taken) => {
                    find(&mut taken, window.first, places, values);
                    self.taken.push((window.first, taken));
                }
                Kind::Cut { parts, .. } => {
                    let counts = parts.iter().map(|part| (part.count, part.bounds));
                    for finer in windows(places, window.first, counts, self.size.most) {
                        if let Kind::Equal = finer.kind {
                            let here = within(&self.places, finer.first, finer.count);
                            self.values[here].fill(Some(value_of(finer.bounds.least)));
                        } else {
                            waiting.push(Window { cell: window.cell, ..finer });
                        }
                    }
                }
                Kind::Equal => {}
            }
        }
        self.windows = waiting;
        self.note_slots();
        self.windows.is_empty()
    }

    /// At a place that was wanted, once all are known.
    pub(super) fn at(&self, place: usize) -> f64 {
        let index = self.places.partition_point(|wanted| *wanted < place);
        self.values.get(index).copied().flatten().unwrap_or(f64::NAN)
    }

    fn note_slots(&mut self) {
        self.slots.fill(NONE);
        for (window, number) in self.windows.iter().zip(0..NONE) {
            let slot = &mut self.slots[window.cell];
            *slot = number.min(*slot);
        }
    }
}

/// Which of the places lie among so many values, the least of which has the place `first`.
fn within(places: &[usize], first: usize, count: usize) -> Range<usize> {
    let before = |end: usize| places.partition_point(|place| *place < end);
    before(first)..before(first + count)
}

/// The values at some places among those that were taken out, the least of which has the place `first`.
fn find(taken: &mut [f64], first: usize, places: &[usize], values: &mut [Option<f64>]) {
    select(taken, first, places);
    for (value, place) in values.iter_mut().zip(places) {
        *value = taken.get(place - first).copied();
    }
}

/// A window for each of the cells or parts in which a wanted place lies. The first of their values has the
/// place `start`.
fn windows(
    wanted: &[usize],
    start: usize,
    counts: impl Iterator<Item = (usize, Bounds)>,
    most: usize,
) -> Vec<Window> {
    let mut waiting = wanted.iter().peekable();
    let mut first = start;
    let mut windows = Vec::new();
    for (cell, (count, bounds)) in counts.enumerate() {
        let next = first + count;
        if waiting.peek().is_some_and(|place| **place < next) {
            windows.push(Window::new(cell, first, count, bounds, most));
            while waiting.next_if(|place| **place < next).is_some() {}
        }
        first = next;
    }
    windows
}

/// The least and the greatest of some values, as [`key`] has them.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    least: u64,
    greatest: u64,
}

/// Values that follow each other in their order, some of them at wanted places.
#[derive(Debug)]
struct Window {
    cell: usize,
    /// The place of the least of them.
    first: usize,
    count: usize,
    /// Between these they lie, and no other value of the cell does.
    bounds: Bounds,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    /// They are taken out.
    Taken(Vec<f64>),
    /// They are too many, and are counted by parts.
    Cut { shift: u32, parts: Vec<Part> },
    /// They are all the same, and need no pass.
    Equal,
}

/// Number of parts of a window that is cut.
const PARTS: usize = 1 << 11;

#[derive(Clone, Copy, Debug)]
struct Part {
    count: usize,
    bounds: Bounds,
}

impl Window {
    fn new(cell: usize, first: usize, count: usize, bounds: Bounds, most: usize) -> Self {
        let extent = bounds.greatest - bounds.least;
        let kind = if extent == 0 {
            Kind::Equal
        } else if count <= most {
            Kind::Taken(Vec::with_capacity(count))
        } else {
            // So many that the greatest is in another part than the least.
            let shift = (u64::BITS - extent.leading_zeros()).saturating_sub(PARTS.ilog2());
            let none = Bounds { least: u64::MAX, greatest: 0 };
            Kind::Cut { shift, parts: vec![Part { count: 0, bounds: none }; PARTS] }
        };
        Self { cell, first, count, bounds, kind }
    }

    #[inline]
    fn note(&mut self, value: f64) {
        let Bounds { least, greatest } = self.bounds;
        let key = key(value);
        if key < least || key > greatest {
            return;
        }
        match &mut self.kind {
            Kind::Taken(values) => values.push(value),
            Kind::Cut { shift, parts } => {
                let part = usize::try_from((key - least) >> *shift).ok().and_then(|part| parts.get_mut(part));
                if let Some(Part { count, bounds }) = part {
                    *count += 1;
                    bounds.least = bounds.least.min(key);
                    bounds.greatest = bounds.greatest.max(key);
                }
            }
            Kind::Equal => {}
        }
    }
}

const SIGN: u64 = 1 << 63;

/// A number that grows as the values do in the order of [`f64::total_cmp`].
#[inline]
fn key(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits & SIGN == 0 { bits | SIGN } else { !bits }
}

fn value_of(key: u64) -> f64 {
    f64::from_bits(if key & SIGN == 0 { !key } else { key ^ SIGN })
}

/// Equal parts of the range of some values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    least: f64,
    per_unit: f64,
    last: f64,
}

impl Cells {
    #[inline(always)]
    pub(super) fn of(values: &[f64], cells: u32) -> Self {
        let mut least = [f64::INFINITY; 8];
        let mut greatest = [f64::NEG_INFINITY; 8];
        let (blocks, rest) = values.as_chunks::<8>();
        let mut widen = |lane: usize, value: f64| {
            least[lane] = if value < least[lane] { value } else { least[lane] };
            greatest[lane] = if value > greatest[lane] { value } else { greatest[lane] };
        };
        for block in blocks {
            for (lane, &value) in block.iter().enumerate() {
                widen(lane, value);
            }
        }
        for (lane, &value) in rest.iter().enumerate() {
            widen(lane, value);
        }
        let least = least.into_iter().fold(f64::INFINITY, f64::min);
        let greatest = greatest.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let per_unit = f64::from(cells) / (greatest - least);
        let last = f64::from(cells) - 1.0;
        // One cell for values that are all the same, or too near or too far apart for the quotient.
        if per_unit.is_finite() && per_unit > 0.0 {
            Self { least, per_unit, last }
        } else {
            Self { least: 0.0, per_unit: 0.0, last }
        }
    }

    /// Counts the values in each cell.
    #[inline(always)]
    pub(super) fn count<N: core::ops::AddAssign + From<u8>>(&self, values: &[f64], counts: &mut [N]) {
        let mut cells = [0; AHEAD];
        for values in values.chunks(AHEAD) {
            self.of_each(values, &mut cells);
            for cell in &cells[..values.len()] {
                if let Some(count) = counts.get_mut(*cell as usize) {
                    *count += N::from(1);
                }
            }
        }
    }

    /// The cell of each of at most [`AHEAD`] values, by a loop of its own that is vectorised.
    #[inline(always)]
    fn of_each(&self, values: &[f64], cells: &mut [u32; AHEAD]) {
        if let Ok(values) = <&[f64; AHEAD]>::try_from(values) {
            for (cell, value) in cells.iter_mut().zip(values) {
                *cell = self.cell(*value);
            }
        } else {
            for (cell, value) in cells.iter_mut().zip(values) {
                *cell = self.cell(*value);
            }
        }
    }

    /// Never falls where the value rises.
    #[inline(always)]
    fn cell(&self, value: f64) -> u32 {
        // 2⁵²: its last bits are the rounded sum.
        const TO_INTEGER: f64 = 4_503_599_627_370_496.0;
        let place = (value - self.least) * self.per_unit;
        let place = if place < self.last { place } else { self.last };
        let place = if place > 0.0 { place } else { 0.0 };
        let bits = (place + TO_INTEGER).to_bits() ^ TO_INTEGER.to_bits();
        #[expect(clippy::cast_possible_truncation, reason = "fewer than the cells")]
        let cell = bits as u32;
        cell
    }
}

/// Puts the wanted places of the ordered values right, the middle one first and the others inside its halves.
/// `values` begin at `start`.
fn select(values: &mut [f64], start: usize, wanted: &[usize]) {
    let (before, [middle, after @ ..]) = wanted.split_at(wanted.len() / 2) else { return };
    let place = middle - start;
    let (low, _, high) = values.select_nth_unstable_by(place, f64::total_cmp);
    select(low, start, before);
    select(high, middle + 1, after);
}

#[cfg(test)]
mod tests {
    use super::{Order, Size, key, select, value_of};
    use crate::random::{bits, unit};

    #[test]
    fn selection_puts_all_places_right() {
        let mut values: Vec<f64> = (0..=100).map(|index| f64::from(index * 37 % 101)).collect();
        let wanted = [0, 3, 4, 50, 51, 99, 100];
        select(&mut values, 0, &wanted);
        for place in wanted {
            assert_eq!(values[place], place as f64);
        }
    }

    #[test]
    fn keys_grow_with_the_values() {
        let values =
            [f64::MIN, -1.0, -f64::MIN_POSITIVE, -0.0, 0.0, 1e-310, 1.0, 1.0 + f64::EPSILON, f64::MAX];
        assert!(values.iter().all(|value| value_of(key(*value)).to_bits() == value.to_bits()));
        assert!(values.is_sorted_by(|first, second| key(*first) < key(*second)));
    }

    /// Beside a full sort: values spread evenly, in clumps, all alike but one, all alike, over the whole
    /// range of an `f64`, subnormal, and of both zeros; at once, and in chunks with so few cells and values
    /// at a time that most are cut again.
    #[test]
    fn order_statistics_are_those_of_a_sort() {
        let kinds: [fn(f64) -> f64; 8] = [
            |u| u,
            |u| (7.0 * u).floor() - 3.0,
            |u| if u < 0.9999 { 1.0 } else { 1e300 },
            |_| -2.5,
            |u| (u - 0.5) * f64::MAX * 2.0,
            |u| u * 1e-310,
            |u| if u < 0.5 { -0.0 } else { 0.0 },
            |u| 1.0 / (u * u),
        ];
        let sizes = [
            (usize::MAX, Size { cells: 1 << 11, most: usize::MAX }),
            (100, Size { cells: 16, most: 4 }),
            (4096, Size { cells: 1 << 11, most: 64 }),
        ];
        let mut most_passes = 0;
        for (kind, of) in (0..).zip(kinds) {
            for count in [2, 3, 100, 20_000] {
                let values: Vec<f64> = (0..count).map(|index| of(unit(bits(kind, index)))).collect();
                let mut sorted = values.clone();
                sorted.sort_unstable_by(f64::total_cmp);
                let count = values.len();
                let mut wanted = vec![0, 1, count / 7, count / 2, count / 2 + 1, count * 9 / 10, count - 1];
                wanted.retain(|place| *place < count);
                for (chunk, size) in sizes {
                    let mut order = Order::new(size);
                    values.chunks(chunk.min(count)).for_each(|chunk| order.count(chunk));
                    for wanted in [&wanted[..], &[count - 1]] {
                        order.seek(wanted.iter().copied());
                        let mut passes = 0;
                        loop {
                            values.chunks(chunk.min(count)).for_each(|chunk| order.take(chunk));
                            passes += 1;
                            if order.settle() {
                                break;
                            }
                        }
                        most_passes = most_passes.max(passes);
                        for &place in wanted {
                            let (found, expected) = (order.at(place), sorted[place]);
                            assert_eq!(found.to_bits(), expected.to_bits(), "kind {kind}, {count} values");
                        }
                    }
                }
            }
        }
        assert!((3..=8).contains(&most_passes), "{most_passes} passes");
    }
}
