//! How close a vehicle comes to one ahead of it.

use core::ops::ControlFlow;

use real::Real;

use crate::course::{Course, LONGEST, Leg, first_that_holds};

/// The least distance between two vehicles on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap<T = f64> {
    /// (m) the distance; negative where they would overlap.
    pub distance: T,
    /// (s) its time.
    pub time: T,
    /// (m/s) the closing speed then.
    pub closing: T,
}

/// The least gap between `behind` and `ahead` from time `from` (s) to `to` (s), where the gap at a time is
/// the difference of their positions. The whole motion has to be searched: two vehicles that are apart in the
/// end may have met before; it is searched for 1e9 s at most. The one ahead may come nearer, with a negative
/// speed.
#[must_use]
pub fn least_gap<T: Real>(behind: &Course<'_, T>, ahead: &Course<'_, T>, [from, to]: [T; 2]) -> Gap<T> {
    let mut least = gap_at(behind, ahead, from);
    let _: ControlFlow<()> = pieces(behind, ahead, [from, to], |[_, end]| {
        let gap = gap_at(behind, ahead, end);
        if gap.distance.value() < least.distance.value() {
            least = gap;
        }
        ControlFlow::Continue(())
    });
    least
}

/// The first contact of `behind` with `ahead` from time `from` (s) to `to` (s): the time at which the gap
/// between them is first zero; `None` if it never is within 1e9 s. The one ahead may come nearer, with a
/// negative speed.
#[must_use]
pub fn first_contact<T: Real>(
    behind: &Course<'_, T>,
    ahead: &Course<'_, T>,
    [from, to]: [T; 2],
) -> Option<Gap<T>> {
    let at_first = gap_at(behind, ahead, from);
    if at_first.distance.value() <= 0.0 {
        return Some(at_first);
    }
    let met = pieces(behind, ahead, [from, to], |[begin, end]| {
        if gap_at(behind, ahead, end).distance.value() > 0.0 {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break([begin.value(), end.value()])
    });
    let ControlFlow::Break(between) = met else { return None };
    let gap = |time: f64| gap_at(behind, ahead, T::from(time));
    let met = first_that_holds(between, |time| gap(time).distance.value() <= 0.0);
    // A step of Newton's method gives the derivatives alone.
    let Gap { distance, closing, .. } = gap(met);
    let step = if closing.value() > 0.0 { distance / closing } else { T::ZERO };
    Some(gap_at(behind, ahead, T::from(met) + step - T::from(step.value())))
}

fn gap_at<T: Real>(behind: &Course<'_, T>, ahead: &Course<'_, T>, time: T) -> Gap<T> {
    let (one, other) = (behind.at(time), ahead.at(time));
    Gap { distance: other.position - one.position, time, closing: one.speed - other.speed }
}

/// Goes through the pieces from time `from` (s) to `to` (s) in which the gap only grows or only shrinks, in
/// their order, until the result for one of them breaks the loop.
fn pieces<T: Real, B>(
    behind: &Course<'_, T>,
    ahead: &Course<'_, T>,
    [from, to]: [T; 2],
    mut of: impl FnMut([T; 2]) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let to = to.min(from + T::from(LONGEST));
    let mut begin = from;
    while begin.value() < to.value() {
        let end = next_border(behind, begin).min(next_border(ahead, begin)).min(to);
        // Within a stretch the difference of the speeds is a quadratic: c + b t + a t²/2.
        let (one, other) = (behind.at(begin), ahead.at(begin));
        let c = other.speed - one.speed;
        let (b, a) = (other.acceleration - one.acceleration, other.jerk - one.jerk);
        let lasts = (end - begin).value();
        let mut turns =
            roots(a * 0.5, b, c).map(|root| root.filter(|root| (0.0..lasts).contains(&root.value())));
        if let [Some(one), Some(other)] = turns
            && other.value() < one.value()
        {
            turns = [Some(other), Some(one)];
        }
        let stretch = begin;
        for turn in turns.into_iter().flatten() {
            of([begin, stretch + turn])?;
            begin = stretch + turn;
        }
        of([begin, end])?;
        begin = end;
    }
    ControlFlow::Continue(())
}

/// (s) the time at which the next leg begins; infinite if none follows.
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
