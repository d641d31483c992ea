//! Histogram of the samples of an output.

use crate::dispatch;

use super::Summary;
use crate::run::{Instructions, for_each};

/// Number of classes of a [`Histogram`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Classes {
    /// 15, for text.
    Coarse,
    /// 40, for a plot.
    Fine,
}

impl Classes {
    /// All variants.
    pub const ALL: [Self; 2] = [Self::Coarse, Self::Fine];

    /// The number of classes.
    #[must_use]
    pub fn count(self) -> u8 {
        match self {
            Self::Coarse => 15,
            Self::Fine => 40,
        }
    }
}

/// Number of samples in each class; the classes have the same width and cover the middle 99 %.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// (unit of the output) lower end of the first class.
    pub low: f64,
    /// (unit of the output) width of a class.
    pub width: f64,
    /// Samples in each class. The upper end belongs to the last one.
    pub counts: Vec<usize>,
    /// Samples below the first and above the last class.
    pub outside: [usize; 2],
    high: f64,
    classes: Classes,
}

impl Histogram {
    /// An empty histogram; `None` if the ends are equal.
    fn between([low, high]: [f64; 2], classes: Classes) -> Option<Self> {
        let width = (high - low) / f64::from(classes.count());
        let is_wide = width.is_finite() && width > 0.0;
        let counts = || vec![0; usize::from(classes.count())];
        is_wide.then(|| Self { low, width, counts: counts(), outside: [0; 2], high, classes })
    }

    /// The histogram of a column in which NaN marks failed samples.
    pub(crate) fn of(column: &[f64], summary: &Summary, classes: Classes) -> Option<Self> {
        /// Values that one thread takes at a time.
        const AT_ONCE: usize = 1 << 16;
        let [.., widest] = summary.intervals;
        let mut histogram = Self::between([widest.low.value, widest.high.value], classes)?;
        let counted = for_each(column.chunks(AT_ONCE), |part| {
            let mut counted = histogram.clone();
            counted.add(part);
            counted
        });
        for part in counted {
            histogram.join(&part);
        }
        Some(histogram)
    }

    /// Adds the counts of another histogram with the same classes.
    fn join(&mut self, more: &Self) {
        let own = self.counts.iter_mut().chain(&mut self.outside);
        for (count, more) in own.zip(more.counts.iter().chain(&more.outside)) {
            *count += more;
        }
    }

    /// Adds more values of such a column.
    fn add(&mut self, values: &[f64]) {
        dispatch!(Instructions::best(), self.add_with(values));
    }

    #[inline(always)]
    fn add_with(&mut self, values: &[f64]) {
        /// Number of values whose places are computed together, in a separate vectorised loop.
        const AHEAD: usize = 64;
        // Below the first class, each class, above the last one, and NaN. Neighbouring values have separate
        // counts, because a count that was just written is not yet available.
        let classes = self.classes.count();
        let mut counts = [[0_usize; PLACES]; 4];
        for values in values.chunks(AHEAD) {
            let mut places = [0_u8; AHEAD];
            for (place, value) in places.iter_mut().zip(values) {
                *place = self.place(*value, classes);
            }
            for (number, place) in places[..values.len()].iter().enumerate() {
                counts[number % 4][usize::from(*place) % PLACES] += 1;
            }
        }
        let [below, of_classes @ ..] = counts
            .into_iter()
            .fold([0; PLACES], |sums, counts| std::array::from_fn(|place| sums[place] + counts[place]));
        self.outside[0] += below;
        self.outside[1] += of_classes[usize::from(classes)];
        for (count, more) in self.counts.iter_mut().zip(of_classes) {
            *count += more;
        }
    }

    /// 0 below the first class, from 1 on the classes, then above the last class, then NaN.
    #[inline(always)]
    fn place(&self, value: f64, classes: u8) -> u8 {
        let class = (value - self.low) / self.width;
        let last = f64::from(classes - 1);
        let class = if class < last { class } else { last };
        let class = if class > 0.0 { class } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "one of the classes")]
        let class = class as u8;
        let place = if value < self.low { 0 } else { class + 1 };
        let place = if value > self.high { classes + 1 } else { place };
        if value.is_nan() { classes + 2 } else { place }
    }
}

/// More than the number of classes plus three.
const PLACES: usize = 64;

#[cfg(test)]
mod tests {
    use super::{Classes, Histogram};
    use crate::random::{bits, unit};

    /// Values at the ends of the classes and next to them, beyond the range, and NaN, compared with a linear
    /// search for the class.
    #[test]
    fn every_value_is_in_its_class() {
        for classes in Classes::ALL {
            let ends =
                (0..=classes.count()).map(|end| 1.0 + f64::from(end) * (2.0 / f64::from(classes.count())));
            let mut values: Vec<f64> = ends.flat_map(|end| [end.next_down(), end, end.next_up()]).collect();
            values.extend((0..1000).map(|index| 4.0 * unit(bits(1, index))));
            values.extend([f64::NAN, -1e300, 1e300]);
            let mut histogram = Histogram::between([1.0, 3.0], classes).unwrap();
            histogram.add(&values);

            let class =
                |value: f64| ((value - 1.0) / histogram.width).floor().min(f64::from(classes.count() - 1));
            for (number, count) in (0_u8..).zip(&histogram.counts) {
                let is_in =
                    |value: &&f64| (1.0..=3.0).contains(*value) && class(**value) == f64::from(number);
                assert_eq!(values.iter().filter(is_in).count(), *count, "class {number}");
            }
            let below = values.iter().filter(|value| **value < 1.0).count();
            let above = values.iter().filter(|value| **value > 3.0).count();
            assert_eq!(histogram.outside, [below, above]);
        }
    }
}
