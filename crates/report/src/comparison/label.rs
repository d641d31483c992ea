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

/// Directions to try, in order: the corners are the least in the way of lines.
const DIRECTIONS: [(i32, i32); 8] = [(1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)];
/// (px) distances to try.
const DISTANCES: [i32; 6] = [8, 12, 17, 23, 30, 38];

/// The middles of labels of the given half sizes for the points, within `bounds`, clear of `obstacles` and of each other as far as the
/// tried places allow. Each label takes the first place with the fewest overlaps.
pub(super) fn place(
    points: &[((i32, i32), (i32, i32))],
    obstacles: &[Area],
    bounds: Area,
) -> Vec<(i32, i32)> {
    let mut taken: Vec<Area> = obstacles.to_vec();
    let mut middles = Vec::new();
    for &((x, y), (half_width, half_height)) in points {
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
