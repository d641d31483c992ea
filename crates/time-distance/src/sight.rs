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
    let is_seen = |time: f64| {
        let [one, other] = positions(time);
        obstacles.iter().all(|outline| sees(one, other, outline))
    };
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps.max(1));
    if is_seen(from) {
        return Some(from);
    }
    let first = (1..=steps.max(1)).find(|&step| is_seen(at(step)))?;
    let (mut hidden, mut seen) = (at(first - 1), at(first));
    for _ in 0..MOST_HALVINGS {
        let middle = f64::midpoint(hidden, seen);
        if middle <= hidden || middle >= seen {
            break;
        }
        if is_seen(middle) { seen = middle } else { hidden = middle }
    }
    Some(seen)
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
