//! Where the labels of points go, so that they cover neither each other nor a point.

/// A box in pixels.
#[derive(Clone, Copy)]
pub(super) struct Area {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

impl Area {
    pub(super) fn around((x, y): (i32, i32), half_width: i32, half_height: i32) -> Self {
        Self { left: x - half_width, top: y - half_height, right: x + half_width, bottom: y + half_height }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }
}

/// A label that wants a place: the point it belongs to, and half its width and height (px).
pub(super) struct Wanted {
    pub(super) point: (i32, i32),
    pub(super) half: (i32, i32),
}

/// Directions to try, in order: the corners are the least in the way of lines.
const DIRECTIONS: [(i32, i32); 8] = [(1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)];
/// (px) distances to try.
const DISTANCES: [i32; 6] = [8, 12, 17, 23, 30, 38];

/// The middles of the labels, within `bounds`, clear of `obstacles` and of each other as far as the
/// tried places allow. Each label takes the first place with the fewest overlaps.
pub(super) fn place(labels: &[Wanted], obstacles: &[Area], bounds: Area) -> Vec<(i32, i32)> {
    let mut taken: Vec<Area> = obstacles.to_vec();
    let mut middles = Vec::new();
    for &Wanted { point: (x, y), half: (half_width, half_height) } in labels {
        let places = DISTANCES.iter().flat_map(|&distance| {
            DIRECTIONS.iter().map(move |&(right, down)| {
                // In a corner the label may come nearer, as its own corner points to the point.
                let reach = |half: i32, other: i32| {
                    if other == 0 { half + distance } else { half + distance * 2 / 3 }
                };
                (x + right * reach(half_width, down), y + down * reach(half_height, right))
            })
        });
        let cost = |middle: &(i32, i32)| {
            let area = Area::around(*middle, half_width, half_height);
            let outside = if bounds.contains(&area) { 0 } else { 100 };
            outside + taken.iter().filter(|other| area.overlaps(other)).count()
        };
        let middle = places.min_by_key(cost).unwrap_or((x, y));
        taken.push(Area::around(middle, half_width, half_height));
        middles.push(middle);
    }
    middles
}

#[cfg(test)]
mod tests {
    use super::{Area, Wanted, place};

    /// Six points on one spot in a corner of the panel: the labels have to keep clear of it, of each other and of the edge.
    #[test]
    fn labels_of_a_crowd_stay_apart_and_inside() {
        let bounds = Area { left: 0, top: 0, right: 120, bottom: 120 };
        let points = [(10, 10); 6];
        let markers = points.map(|point| Area::around(point, 6, 6));
        let labels = points.map(|point| Wanted { point, half: (8, 6) });
        let areas: Vec<Area> =
            place(&labels, &markers, bounds).into_iter().map(|middle| Area::around(middle, 8, 6)).collect();
        assert_eq!(areas.len(), 6);
        for (i, area) in areas.iter().enumerate() {
            assert!(bounds.contains(area));
            assert!(markers.iter().chain(&areas[..i]).all(|other| !area.overlaps(other)));
        }
    }

    #[test]
    fn a_lone_label_is_beside_its_point() {
        let bounds = Area { left: 0, top: 0, right: 100, bottom: 100 };
        let label = Wanted { point: (50, 50), half: (4, 6) };
        let [(x, y)] = place(&[label], &[Area::around((50, 50), 6, 6)], bounds)[..] else { panic!() };
        assert!((x - 50).abs() <= 16 && (y - 50).abs() <= 16);
    }
}
