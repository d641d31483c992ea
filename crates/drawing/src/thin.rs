//! Fewer points for the same line.

use kurbo::{Line, ParamCurveNearest as _, Point};

/// (px) maximum distance of the thinned line from the given one, too small to be seen.
const TOLERANCE: f64 = 0.1;

/// A subset of the points that keeps the line in place (D. Douglas and T. Peucker, *Algorithms for the
/// reduction of the number of points required to represent a digitized line*, 1973).
pub(crate) fn thinned(points: &[Point]) -> Vec<Point> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut is_kept = vec![false; points.len()];
    is_kept[0] = true;
    is_kept[last] = true;
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let line = Line::new(points[from], points[to]);
        let far = |k: &usize| line.nearest(points[*k], 1e-9).distance_sq;
        let farthest = (from + 1..to).max_by(|one, other| far(one).total_cmp(&far(other)));
        if let Some(farthest) = farthest.filter(|k| far(k) > TOLERANCE * TOLERANCE) {
            is_kept[farthest] = true;
            open.extend([(from, farthest), (farthest, to)]);
        }
    }
    points.iter().zip(is_kept).filter_map(|(point, is_kept)| is_kept.then_some(*point)).collect()
}

#[cfg(test)]
mod tests {
    use kurbo::{Line, ParamCurveNearest as _, Point};

    use super::{TOLERANCE, thinned};

    #[test]
    fn the_line_stays_where_it_was() {
        // A parabola of 5,000 points that doubles back on itself.
        let points: Vec<Point> = (0..5000)
            .map(|k| f64::from(k) * 0.05)
            .map(|x| Point::new(x, 0.01 * x * x))
            .chain([Point::new(100.0, 50.0)])
            .collect();
        let few = thinned(&points);
        assert!(few.len() < 100, "{}", few.len());
        assert_eq!((few.first(), few.last()), (points.first(), points.last()));
        for &point in &points {
            let lines = few.windows(2).map(|pair| Line::new(pair[0], pair[1]));
            let nearest = lines.map(|line| line.nearest(point, 1e-9).distance_sq).fold(f64::MAX, f64::min);
            assert!(nearest.sqrt() <= TOLERANCE + 1e-9, "{point}");
        }
    }

    #[test]
    fn a_straight_line_has_two_points_and_nothing_stays_nothing() {
        let line: Vec<Point> = (0..1000).map(|k| Point::new(f64::from(k), 2.0 * f64::from(k))).collect();
        assert_eq!(thinned(&line), [line[0], line[999]]);
        assert_eq!(thinned(&line[..1]), line[..1]);
        assert!(thinned(&[]).is_empty());
    }
}
