//! Some of the values of a column in their order, by passes over it.

use std::ops::Range;

use super::watched::Watched;

/// Finds the values at wanted places, counted from zero and ascending, of the values in their order.
///
/// Those that a first pass has not taken out are sought between the values about which it tells how many
/// come before. Where no more values lie there than may be taken out, the next pass takes them out; otherwise
/// passes cut the range into parts until it is known to hold one value only, or few. However the values lie,
/// this is right; where most lie close together, it takes longer.
#[derive(Debug)]
pub(super) struct Order<'m> {
    watched: Watched<'m>,
    /// The most values that are taken out at once.
    most: usize,
    windows: Vec<Window>,
    places: Vec<usize>,
    /// Of each wanted place, once it is known.
    values: Vec<Option<f64>>,
}

/// Values among which a place lies: as many, after so many others, between these [keys](key).
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) least: u64,
    pub(super) greatest: u64,
}

impl<'m> Order<'m> {
    pub(super) fn new(watched: Watched<'m>, most: usize) -> Self {
        Self { watched, most, windows: Vec::new(), places: Vec::new(), values: Vec::new() }
    }

    pub(super) fn watched(&self) -> &Watched<'m> {
        &self.watched
    }

    /// Asks for the values at these places of so many values, and tells whether all are known. If they are
    /// not, it begins a pass with [`take`](Self::take).
    pub(super) fn seek(&mut self, wanted: impl Iterator<Item = usize>, count: usize) -> bool {
        let known = std::mem::take(&mut self.places).into_iter().zip(std::mem::take(&mut self.values));
        let known: Vec<(usize, Option<f64>)> = known.collect();
        self.places = wanted.collect();
        self.places.sort_unstable();
        self.places.dedup();
        self.values = self.watched.find(&self.places);
        for (place, value) in self.places.iter().zip(&mut self.values) {
            if value.is_none() {
                *value = known.iter().find(|(other, _)| other == place).and_then(|(_, value)| *value);
            }
        }
        let unknown = self.places.iter().zip(&self.values).filter(|(_, value)| value.is_none());
        self.windows.clear();
        for (place, _) in unknown {
            let Bracket { first, count, least, greatest } = self.watched.bracket(*place, count);
            if self.windows.last().is_none_or(|window| window.first + window.count <= *place) {
                self.windows.push(Window::new(first, count, Bounds { least, greatest }, self.most));
            }
        }
        self.settle_equal();
        self.windows.is_empty()
    }

    /// All values, in any order, once in each pass. NaN is none.
    pub(super) fn take(&mut self, values: &[f64]) {
        for value in values.iter().filter(|value| !value.is_nan()) {
            let key = key(*value);
            for window in &mut self.windows {
                window.note(key);
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
                    taken.sort_unstable();
                    for (value, place) in values.iter_mut().zip(places) {
                        *value = taken.get(place - window.first).map(|key| value_of(*key));
                    }
                }
                Kind::Cut { parts, .. } => {
                    let mut first = window.first;
                    for Part { count, bounds } in parts {
                        if !within(places, first, count).is_empty() {
                            waiting.push(Window::new(first, count, bounds, self.most));
                        }
                        first += count;
                    }
                }
                Kind::Equal => waiting.push(window),
            }
        }
        self.windows = waiting;
        self.settle_equal();
        self.windows.is_empty()
    }

    /// Values that are all the same need no pass.
    fn settle_equal(&mut self) {
        let (places, values) = (&self.places, &mut self.values);
        self.windows.retain(|window| {
            let is_equal = matches!(window.kind, Kind::Equal);
            if is_equal {
                values[within(places, window.first, window.count)].fill(Some(value_of(window.bounds.least)));
            }
            !is_equal
        });
    }

    /// At a place that was wanted, once all are known.
    pub(super) fn at(&self, place: usize) -> f64 {
        let index = self.places.partition_point(|wanted| *wanted < place);
        self.values.get(index).copied().flatten().unwrap_or(f64::NAN)
    }
}

/// Which of the places lie among so many values, the least of which has the place `first`.
fn within(places: &[usize], first: usize, count: usize) -> Range<usize> {
    let before = |end: usize| places.partition_point(|place| *place < end);
    before(first)..before(first + count)
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
    /// The place of the least of them.
    first: usize,
    count: usize,
    /// Between these they lie, and no other value does.
    bounds: Bounds,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    /// Their keys are taken out.
    Taken(Vec<u64>),
    /// They are too many, and are counted by parts.
    Cut { shift: u32, parts: Vec<Part> },
    /// They are all the same.
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
    fn new(first: usize, count: usize, bounds: Bounds, most: usize) -> Self {
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
        Self { first, count, bounds, kind }
    }

    #[inline]
    fn note(&mut self, key: u64) {
        let Bounds { least, greatest } = self.bounds;
        if key < least || key > greatest {
            return;
        }
        match &mut self.kind {
            Kind::Taken(keys) => keys.push(key),
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
pub(super) fn key(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits & SIGN == 0 { bits | SIGN } else { !bits }
}

pub(super) fn value_of(key: u64) -> f64 {
    f64::from_bits(if key & SIGN == 0 { !key } else { key ^ SIGN })
}
