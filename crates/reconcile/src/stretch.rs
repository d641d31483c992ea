//! Ranges of approach speeds in which e is linear, and their parts.

use pim_core::Law;

use crate::polynomial::Polynomial;

/// A range of approach speeds x = start + length t in which e is linear in t.
#[derive(Clone, Copy)]
pub(crate) struct Stretch {
    pub(crate) start: f64,
    pub(crate) length: f64,
    /// e at t = 0 and at t = 1.
    pub(crate) restitution: [f64; 2],
    /// (s/m) e′ = de/dx
    pub(crate) rise: f64,
    /// (m/s) the approach speeds that belong to it.
    pub(crate) range: [f64; 2],
}

impl Stretch {
    /// Between two neighbouring points (m/s, e) of a curve.
    #[inline(always)]
    pub(crate) fn between([(from, e0), (to, e1)]: [(f64, f64); 2]) -> Self {
        let length = to - from;
        Self { start: from, length, restitution: [e0, e1], rise: (e1 - e0) / length, range: [from, to] }
    }

    /// A stretch of constant restitution.
    #[inline(always)]
    pub(crate) fn constant(e: f64, size: f64, range: [f64; 2]) -> Self {
        Self { start: 0.0, length: size, restitution: [e; 2], rise: 0.0, range }
    }

    /// The part within the given approach speeds.
    #[inline(always)]
    pub(crate) fn within(self, [least, most]: [f64; 2]) -> Self {
        let [from, to] = self.range;
        Self { range: [from.max(least), to.min(most)], ..self }
    }

    #[inline(always)]
    pub(crate) fn has_length(&self) -> bool {
        let [from, to] = self.range;
        from < to
    }

    /// Whether e = 1 throughout.
    #[inline(always)]
    pub(crate) fn is_elastic(&self) -> bool {
        let [e0, e1] = self.restitution;
        (e0 == 1.0) & (e1 == 1.0)
    }

    /// (m/s) the middle of a range.
    #[inline(always)]
    pub(crate) fn middle([low, high]: [f64; 2]) -> f64 {
        0.5 * (low + high)
    }

    pub(crate) fn parameter(&self, x: f64) -> f64 {
        (x - self.start) / self.length
    }

    pub(crate) fn approach_speed(&self, t: f64) -> f64 {
        let [low, high] = self.range;
        (self.start + self.length * t).max(low).min(high)
    }

    /// e at an approach speed.
    #[inline(always)]
    pub(crate) fn restitution_at(&self, x: f64) -> f64 {
        // e = e₀ + e′ (x − x₀)
        self.restitution[0] + self.rise * (x - self.start)
    }

    /// The interval of t.
    pub(crate) fn interval(&self) -> [f64; 2] {
        self.range.map(|x| self.parameter(x))
    }

    /// x(t).
    pub(crate) fn x(&self) -> Polynomial {
        Polynomial::new([self.start, self.length])
    }

    /// 1 + c e(t).
    pub(crate) fn one_plus(&self, c: f64) -> Polynomial {
        let [e0, e1] = self.restitution;
        if e0 == e1 {
            Polynomial::new([1.0 + c * e0])
        } else {
            Polynomial::new([1.0 + c * e0, c * (e1 - e0)])
        }
    }

    /// A quantity that is affine in x and affine in e, as a polynomial in t.
    pub(crate) fn polynomial(&self, law: &Law, value: impl Fn(&Law, f64) -> f64) -> Polynomial {
        self.corners(law, value).polynomial(|value| *value)
    }

    /// A quantity at both ends of the stretch, under the law with the restitution of each end.
    pub(crate) fn corners<V>(&self, law: &Law, value: impl Fn(&Law, f64) -> V) -> Corners<V> {
        let ends = [self.start, self.start + self.length];
        let [from, to] = self.restitution;
        let of = |e: f64| {
            let law = law.restituting(e);
            ends.map(|x| value(&law, x))
        };
        Corners { from: of(from), to: (from != to).then(|| of(to)) }
    }
}

/// A stretch in parts: the slowest is searched first, and halved if it may have several roots.
pub(crate) struct Parts {
    stretch: Option<Stretch>,
    /// (m/s) the beginning of the slowest part.
    low: f64,
    /// (m/s) the end of each part, the fastest first.
    ends: [f64; HALVINGS + 1],
    count: usize,
}

/// A stretch is halved at most this many times: roots closer together need the polynomials of its pieces.
const HALVINGS: usize = 5;

impl Parts {
    pub(crate) fn none() -> Self {
        Self { stretch: None, low: 0.0, ends: [0.0; HALVINGS + 1], count: 0 }
    }

    pub(crate) fn begin(&mut self, stretch: Stretch) -> Stretch {
        let [low, high] = stretch.range;
        (self.stretch, self.low, self.ends[0], self.count) = (Some(stretch), low, high, 1);
        stretch
    }

    pub(crate) fn slowest(&self) -> Option<Stretch> {
        let high = *self.ends[..self.count].last()?;
        self.stretch.map(|stretch| Stretch { range: [self.low, high], ..stretch })
    }

    /// Halves the slowest part if possible, and returns whether it did.
    pub(crate) fn halve(&mut self) -> bool {
        let (Some(high), true) = (self.ends[..self.count].last(), self.count <= HALVINGS) else {
            return false;
        };
        self.ends[self.count] = Stretch::middle([self.low, *high]);
        self.count += 1;
        true
    }

    /// Marks the slowest part as searched.
    pub(crate) fn finish(&mut self) {
        if let Some(high) = self.ends[..self.count].last() {
            self.low = *high;
            self.count -= 1;
        }
    }
}

/// A quantity at t = 0 and t = 1, under the law of each end; for one law only if both are the same.
pub(crate) struct Corners<V> {
    from: [V; 2],
    to: Option<[V; 2]>,
}

impl<V> Corners<V> {
    /// A component that is affine in x and affine in e, as a polynomial in t.
    pub(crate) fn polynomial(&self, part: impl Fn(&V) -> f64) -> Polynomial {
        let [a, b] = self.from.each_ref().map(&part);
        let Some(to) = &self.to else { return Polynomial::new([a, b - a]) };
        let [c, d] = to.each_ref().map(&part);
        // a (1−t)² + (b + c) t (1−t) + d t²
        let middle = b + c;
        Polynomial::new([a, middle - 2.0 * a, a + d - middle])
    }
}
