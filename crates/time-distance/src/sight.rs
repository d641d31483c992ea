//! The sight past obstacles.

use pim_core::Vector2;

use crate::course::first_that_holds;

/// Steps of the secant after which it has long converged.
const MOST_SECANTS: usize = 12;

/// (–) accuracy of the moment when a corner comes into line, as a share of its step.
const IN_LINE: f64 = 1e-12;

/// Whether the line from one point to another is free of an obstacle: the outline, a polygon, whose corners
/// come in their order. A line that only touches it, at a corner or along a side, is free; none is free if a
/// coordinate is not finite.
#[must_use]
pub fn sees(from: Vector2<f64>, to: Vector2<f64>, outline: &[Vector2<f64>]) -> bool {
    if ![from.x, from.y, to.x, to.y].into_iter().all(f64::is_finite) {
        return false;
    }
    for (one, other) in sides(outline) {
        let across = area(from, to, one) * area(from, to, other);
        if across.is_nan() || across < 0.0 && area(one, other, from) * area(one, other, to) < 0.0 {
            return false;
        }
    }
    // No side is crossed: each piece of the line between the corners on it is all inside or all outside.
    let way = to - from;
    // (–) s = (c − a)·(b − a)/|b − a|²
    let along = |corner: Vector2<f64>| (corner - from).dot(&way) / way.dot(&way);
    let is_on_line = |corner: Vector2<f64>| area(from, to, corner) == 0.0;
    let mut begin = 0.0;
    while begin < 1.0 {
        let corners = outline.iter().filter(|corner| is_on_line(**corner)).map(|corner| along(*corner));
        let end = corners.filter(|share| *share > begin).fold(1.0, f64::min);
        let middle = f64::midpoint(begin, end);
        let runs_along = |(one, other)| {
            is_on_line(one) && is_on_line(other) && (along(one) < middle) != (along(other) < middle)
        };
        if contains(outline, from + way * middle) && !sides(outline).any(runs_along) {
            return false;
        }
        begin = end;
    }
    true
}

/// (s) the first moment, from `from` (s) to `to` (s), at which one road user sees the other; `None` if it
/// never does. `positions` gives the positions of both at a time; the sight is tested at `steps` equal steps,
/// and its moment is found between two of them.
pub fn first_sight(
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
    [from, to]: [f64; 2],
    steps: u32,
) -> Option<f64> {
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps.max(1));
    let seen = |&step: &u32| is_seen(positions(at(step)), obstacles);
    match (0..=steps.max(1)).find(seen)? {
        0 => Some(from),
        first => Some(between([at(first - 1), at(first)], positions, obstacles)),
    }
}

/// (s) the moment from which one road user sees the other without a break until `to` (s): `from` (s) if it
/// always does, and `None` if it does not at `to`. The sight is tested as by [`first_sight`].
pub fn free_since(
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
    [from, to]: [f64; 2],
    steps: u32,
) -> Option<f64> {
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps.max(1));
    let hidden = |&step: &u32| !is_seen(positions(at(step)), obstacles);
    match (0..=steps.max(1)).rev().find(hidden) {
        None => Some(from),
        Some(last) if last >= steps.max(1) => None,
        Some(last) => Some(between([at(last), at(last + 1)], positions, obstacles)),
    }
}

fn is_seen([one, other]: [Vector2<f64>; 2], obstacles: &[&[Vector2<f64>]]) -> bool {
    obstacles.iter().all(|outline| sees(one, other, outline))
}

/// The moment between one when it is hidden and one when it is seen.
fn between(
    [hidden, seen]: [f64; 2],
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
) -> f64 {
    let is_seen = |time: f64| is_seen(positions(time), obstacles);
    if let Some(moment) = in_line([hidden, seen], &positions, obstacles) {
        let about = IN_LINE * (seen - hidden);
        // Usually it is a corner that comes out of the line; where it is something else, halvings find it.
        if !is_seen(moment - about) && is_seen(moment + about) {
            return moment;
        }
    }
    first_that_holds([hidden, seen], is_seen)
}

/// The moment between two when a corner lies on the line from one road user to the other, if there is just
/// one such corner.
fn in_line(
    [first, last]: [f64; 2],
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
) -> Option<f64> {
    let [[one, other], [one_last, other_last]] = [positions(first), positions(last)];
    let sides = |corner: Vector2<f64>| [area(one, other, corner), area(one_last, other_last, corner)];
    let corners = obstacles.iter().flat_map(|outline| outline.iter().copied());
    let mut passing = corners.map(|corner| (corner, sides(corner))).filter(|(_, [a, b])| a * b < 0.0);
    let (corner, [mut f_a, mut f_b]) = passing.next()?;
    if passing.next().is_some() {
        return None;
    }
    // Regula falsi, by the Illinois rule.
    let [mut a, mut b] = [first, last];
    for _ in 0..MOST_SECANTS {
        let next = b - f_b * (b - a) / (f_b - f_a);
        let [one, other] = positions(next);
        let f = area(one, other, corner);
        if f * f_b < 0.0 {
            (a, f_a) = (b, f_b);
        } else {
            f_a *= 0.5;
        }
        let is_found = f == 0.0 || (next - b).abs() < 0.25 * IN_LINE * (last - first);
        (b, f_b) = (next, f);
        if is_found {
            return Some(b);
        }
    }
    None
}

/// Twice the area of the triangle, positive where it runs counter-clockwise.
fn area(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// The sides of an outline, each from one corner to the next.
fn sides(outline: &[Vector2<f64>]) -> impl Iterator<Item = (Vector2<f64>, Vector2<f64>)> {
    outline.last().into_iter().chain(outline).copied().zip(outline.iter().copied())
}

/// Whether an outline contains a point: a ray from it crosses an odd number of sides.
fn contains(outline: &[Vector2<f64>], point: Vector2<f64>) -> bool {
    let is_crossed = |(one, other): &(Vector2<f64>, Vector2<f64>)| {
        (one.y > point.y) != (other.y > point.y)
            && point.x < one.x + (point.y - one.y) / (other.y - one.y) * (other.x - one.x)
    };
    sides(outline).filter(is_crossed).count() % 2 == 1
}
