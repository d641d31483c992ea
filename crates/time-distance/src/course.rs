//! A motion along a path, in legs of constant jerk.

use real::Real;

/// Halvings of an interval after which nothing is left of it.
const MOST_HALVINGS: usize = 200;

/// (–) rounding error of the square of a speed at a stop, as a share of that at the beginning of the leg.
const ROUNDING: f64 = 1e-14;

/// (s) longest time after which a road user still counts as arriving.
pub(crate) const LONGEST: f64 = 1e9;

/// The beginning of a stretch of constant jerk, which lasts until the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Leg<T = f64> {
    /// (s) time.
    pub time: T,
    /// (m) position along the path.
    pub position: T,
    /// (m/s) speed.
    pub speed: T,
    /// (m/s²) acceleration.
    pub acceleration: T,
    /// (m/s³) jerk, throughout.
    pub jerk: T,
}

impl<T: Real> Leg<T> {
    /// A road user at rest at a position (m) from a time (s) on.
    #[must_use]
    pub fn at_rest(time: T, position: T) -> Self {
        Self { time, position, speed: T::ZERO, acceleration: T::ZERO, jerk: T::ZERO }
    }

    /// Its state after a while (s), with its acceleration then and its jerk.
    #[must_use]
    pub fn after(&self, while_: T) -> Self {
        let t = while_;
        // s = s₀ + v t + a t²/2 + j t³/6 and its derivatives
        let acceleration = self.acceleration + self.jerk * t;
        let speed = self.speed + t * (self.acceleration + self.jerk * t * 0.5);
        let position = self.position + t * (self.speed + t * (self.acceleration * 0.5 + self.jerk * t / 6.0));
        Self { time: self.time + t, position, speed, acceleration, jerk: self.jerk }
    }
}

/// A motion: its legs in the order of their times. Before the first leg it moves as in the first, after the
/// last as in the last. The speed must not be negative anywhere, so that a position is reached once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course<'a, T = f64> {
    legs: &'a [Leg<T>],
}

impl<'a, T: Real> Course<'a, T> {
    /// From its legs; `None` without any.
    #[must_use]
    pub fn new(legs: &'a [Leg<T>]) -> Option<Self> {
        (!legs.is_empty()).then_some(Self { legs })
    }

    /// Its legs.
    #[must_use]
    pub fn legs(&self) -> &'a [Leg<T>] {
        self.legs
    }

    /// Its state at a time (s).
    #[must_use]
    pub fn at(&self, time: T) -> Leg<T> {
        let after = self.legs.partition_point(|leg| leg.time.value() <= time.value());
        match self.legs.get(after.saturating_sub(1)) {
            Some(leg) => leg.after(time - leg.time),
            None => Leg::at_rest(time, T::ZERO),
        }
    }

    /// (s) the time at which it first reaches a position (m), from its first leg on; `None` if it never does.
    #[must_use]
    pub fn reaches(&self, position: T) -> Option<T> {
        let first = self.legs.first()?;
        if position.value() <= first.position.value() {
            return Some(first.time);
        }
        let ends = self.legs.iter().skip(1).map(Some).chain([None]);
        for (leg, next) in self.legs.iter().zip(ends) {
            if next.is_some_and(|next| next.position.value() < position.value()) {
                continue;
            }
            return leg_reaches(leg, next.map(|next| next.time), position);
        }
        None
    }
}

/// (s) the time at which a leg reaches a position that lies within it.
fn leg_reaches<T: Real>(leg: &Leg<T>, end: Option<T>, position: T) -> Option<T> {
    let lasts = if leg.jerk.value() == 0.0 {
        at_constant_acceleration(leg, end.is_some(), position)?
    } else {
        by_halvings(leg, end, position)?
    };
    // A step of Newton's method gives the derivatives alone: its value, where the speed is nearly zero, is
    // rounding over rounding.
    let near = leg.after(T::from(lasts));
    let time = leg.time + lasts;
    if near.speed.value() <= 0.0 {
        return Some(time);
    }
    let step = (near.position - position) / near.speed;
    Some(time - (step - T::from(step.value())))
}

/// (s) from the beginning of the leg; `None` if it stops before, which a leg that ends does not.
fn at_constant_acceleration<T: Real>(leg: &Leg<T>, ends: bool, position: T) -> Option<f64> {
    let [speed, acceleration] = [leg.speed.value(), leg.acceleration.value()];
    let way = position.value() - leg.position.value();
    if way <= 0.0 {
        return Some(0.0);
    }
    // s = v t + a t²/2: t = 2 s/(v + √(v² + 2 a s))
    let square = speed * speed + acceleration * way * 2.0;
    let sum = speed + Real::sqrt(f64::max(square, 0.0));
    ((ends || square >= -ROUNDING * speed * speed) && sum > 0.0).then(|| way * 2.0 / sum)
}

/// (s) from the beginning of the leg.
fn by_halvings<T: Real>(leg: &Leg<T>, end: Option<T>, position: T) -> Option<f64> {
    let missing = |time: f64| leg.after(T::from(time)).position.value() - position.value();
    let mut low = 0.0;
    let mut high = match end {
        Some(end) => end.value() - leg.time.value(),
        None => 1.0,
    };
    if end.is_none() {
        // The last leg lasts as long as its speed allows.
        while missing(high) < 0.0 {
            if leg.after(T::from(high)).speed.value() <= 0.0 || high > LONGEST {
                return None;
            }
            (low, high) = (high, high * 2.0);
        }
    }
    Some(first_that_holds([low, high], |time| missing(time) >= 0.0))
}

/// The first of the numbers up to one that holds, from one that does not: to the last bit.
pub(crate) fn first_that_holds([mut not, mut holding]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..MOST_HALVINGS {
        let middle = f64::midpoint(not, holding);
        if middle <= not || middle >= holding {
            break;
        }
        if holds(middle) { holding = middle } else { not = middle }
    }
    holding
}
