//! How close a vehicle comes to one ahead of it.

use real::Real;

use crate::course::{Course, Leg};

/// The least distance between two vehicles on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap<T = f64> {
    /// (m) the distance; negative where they would overlap.
    pub distance: T,
    /// (s) when.
    pub time: T,
    /// (m/s) the speed with which the one behind then approaches.
    pub closing: T,
}

/// The least gap between `behind` and `ahead` from time `from` (s) to `to` (s), where the gap at a time is
/// the difference of their positions. It has to be looked for during the motion: two vehicles that stand
/// apart in the end may have met before.
#[must_use]
pub fn least_gap<T: Real>(behind: &Course<'_, T>, ahead: &Course<'_, T>, [from, to]: [T; 2]) -> Gap<T> {
    let gap_at = |time: T| {
        let (one, other) = (behind.at(time), ahead.at(time));
        Gap { distance: other.position - one.position, time, closing: one.speed - other.speed }
    };
    let mut least = gap_at(from);
    let mut consider = |time: T| {
        let gap = gap_at(time);
        if gap.distance.value() < least.distance.value() {
            least = gap;
        }
    };
    consider(to);
    let mut begin = from;
    while begin.value() < to.value() {
        let end = next_border(behind, begin).min(next_border(ahead, begin)).min(to);
        consider(end);
        // Within a stretch the difference of the speeds is a quadratic: c + b t + a t²/2.
        let (one, other) = (behind.at(begin), ahead.at(begin));
        let c = other.speed - one.speed;
        let (b, a) = (other.acceleration - one.acceleration, other.jerk - one.jerk);
        for root in roots(a * 0.5, b, c).into_iter().flatten() {
            let time = begin + root;
            if root.value() > 0.0 && time.value() < end.value() {
                consider(time);
            }
        }
        if end.value() <= begin.value() {
            break;
        }
        begin = end;
    }
    least
}

/// (s) the time at which the next leg begins; infinite where none follows.
fn next_border<T: Real>(course: &Course<'_, T>, time: T) -> T {
    let next = course.legs().iter().find(|leg: &&Leg<T>| leg.time.value() > time.value());
    next.map_or(T::from(f64::INFINITY), |leg| leg.time)
}

/// The real roots of a x² + b x + c.
fn roots<T: Real>(a: T, b: T, c: T) -> [Option<T>; 2] {
    if a.value() == 0.0 {
        return [(b.value() != 0.0).then(|| -c / b), None];
    }
    let discriminant = b * b - a * c * 4.0;
    if discriminant.value() < 0.0 {
        return [None; 2];
    }
    let root = if discriminant.value() > 0.0 { discriminant.sqrt() } else { T::ZERO };
    // The sum without cancellation, and Vieta for the other root.
    let sum = if b.value() >= 0.0 { -b - root } else { root - b };
    let first = sum / (a * 2.0);
    [Some(first), (sum.value() != 0.0).then(|| c * 2.0 / sum)]
}
