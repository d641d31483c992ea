//! What obstacles hide.

use pim_core::Vector2;

/// Halvings after which a moment is known to the last bit.
const MOST_HALVINGS: usize = 100;

/// Whether the line from one point to another is free of an obstacle: the outline, a polygon, whose corners
/// come in their order. A line that only touches it is free.
#[must_use]
pub fn sees(from: Vector2<f64>, to: Vector2<f64>, outline: &[Vector2<f64>]) -> bool {
    let Some(last) = outline.last() else { return true };
    let mut before = *last;
    for corner in outline {
        if cross(from, to, before, *corner) {
            return false;
        }
        before = *corner;
    }
    // No side is crossed: it is free unless it lies inside.
    !(contains(outline, from) && contains(outline, to))
}

/// (s) the first moment, from `from` (s) to `to` (s), from which on one road user sees the other until it
/// does not any more; `None` where it never does. The positions at a time are those of the two; the sight is
/// asked in `steps` equal steps, and its moment is found between two of them.
pub fn first_sight(
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
    [from, to]: [f64; 2],
    steps: u32,
) -> Option<f64> {
    let is_seen = |time: f64| is_seen(positions(time), obstacles);
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps.max(1));
    if is_seen(from) {
        return Some(from);
    }
    let first = (1..=steps.max(1)).find(|&step| is_seen(at(step)))?;
    Some(between(at(first - 1), at(first), is_seen))
}

/// (s) since when one road user has seen the other without a break, at the time `to` (s); `from` (s) where it
/// has all the time since then, and `None` where it does not at `to`. The sight is asked as by
/// [`first_sight`].
pub fn free_since(
    positions: impl Fn(f64) -> [Vector2<f64>; 2],
    obstacles: &[&[Vector2<f64>]],
    [from, to]: [f64; 2],
    steps: u32,
) -> Option<f64> {
    let is_seen = |time: f64| is_seen(positions(time), obstacles);
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps.max(1));
    let last = (0..=steps.max(1)).rev().find(|&step| !is_seen(at(step)));
    match last {
        None => Some(from),
        Some(last) if last >= steps.max(1) => None,
        Some(last) => Some(between(at(last), at(last + 1), is_seen)),
    }
}

fn is_seen([one, other]: [Vector2<f64>; 2], obstacles: &[&[Vector2<f64>]]) -> bool {
    obstacles.iter().all(|outline| sees(one, other, outline))
}

/// The moment between one at which it is hidden and one at which it is seen.
fn between(mut hidden: f64, mut seen: f64, is_seen: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..MOST_HALVINGS {
        let middle = f64::midpoint(hidden, seen);
        if middle <= hidden || middle >= seen {
            break;
        }
        if is_seen(middle) { seen = middle } else { hidden = middle }
    }
    seen
}

/// Twice the area of the triangle, positive where it runs counter-clockwise.
fn area(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether two segments cross inside of both.
fn cross(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>, d: Vector2<f64>) -> bool {
    area(a, b, c) * area(a, b, d) < 0.0 && area(c, d, a) * area(c, d, b) < 0.0
}

/// Whether an outline contains a point: a ray from it crosses an odd number of sides.
fn contains(outline: &[Vector2<f64>], point: Vector2<f64>) -> bool {
    let Some(last) = outline.last() else { return false };
    let (mut inside, mut before) = (false, *last);
    for corner in outline {
        let is_between = (before.y > point.y) != (corner.y > point.y);
        if is_between {
            let x = before.x + (point.y - before.y) / (corner.y - before.y) * (corner.x - before.x);
            inside ^= point.x < x;
        }
        before = *corner;
    }
    inside
}
