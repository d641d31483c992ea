//! Where the labels of the lines of a histogram, and of the bars of a tornado, go.

/// A vertical line with a label.
#[derive(Clone, Copy)]
pub(super) struct Mark {
    /// (px) where it stands.
    pub(super) x: i32,
    /// (px) width of the label.
    pub(super) width: i32,
}

/// Where a label begins, and its row: 0 is the top one. The line of the label reaches up to this row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) row: usize,
    /// (px)
    pub(super) left: i32,
}

/// (px) from a line to its label.
const BESIDE: i32 = 4;
/// What a label costs that leaves the plot, one with a line through it, and one to the left of its line.
const OUTSIDE: i32 = 1000;
const CROSSED: i32 = 10;
const TO_THE_LEFT: i32 = 1;

/// The labels between `left` and `right` (px), each in a row of its own, so that none is on another: with the fewest lines through them, to the right of
/// their own lines where there is a choice.
pub(super) fn place(marks: [Mark; 3], left: i32, right: i32) -> [Place; 3] {
    const ROWS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let all = ROWS.into_iter().flat_map(|rows| {
        (0..8_u8).map(move |sides| {
            [0, 1, 2].map(|i| {
                let Mark { x, width } = marks[i];
                let is_left = sides >> i & 1 == 1;
                Place { row: rows[i], left: if is_left { x - BESIDE - width } else { x + BESIDE } }
            })
        })
    });
    let cost = |places: &[Place; 3]| {
        let mut cost = 0;
        for (mark, place) in marks.iter().zip(places) {
            let end = place.left + mark.width;
            if place.left < left || end > right {
                cost += OUTSIDE;
            }
            if end < mark.x {
                cost += TO_THE_LEFT;
            }
            for (other, its) in marks.iter().zip(places) {
                // A line that ends further down does not reach the label.
                if its.row < place.row && (place.left..=end).contains(&other.x) {
                    cost += CROSSED;
                }
            }
        }
        cost
    };
    // There are 48, never none.
    all.min_by_key(cost).unwrap_or(marks.map(|mark| Place { row: 0, left: mark.x + BESIDE }))
}

/// The labels of a bar of a tornado from what its two ends give to the central value: each with the end that it stands at. Two ends that are printed alike
/// have one label, and so have two on one side, where the shorter part of the bar lies on the longer one.
pub(super) fn of_bar(
    ends: [Option<f64>; 2],
    central: f64,
    print: impl Fn(f64) -> String,
) -> Vec<(f64, String)> {
    if let [Some(low), Some(high)] = ends {
        let longer = if (low - central).abs() > (high - central).abs() { low } else { high };
        let [one, other] = [low, high].map(&print);
        if one == other {
            return vec![(longer, other)];
        }
        if (low < central) == (high < central) {
            return vec![(longer, format!("low {one}, high {other}"))];
        }
    }
    ends.into_iter().flatten().map(|end| (end, print(end))).collect()
}

#[cfg(test)]
mod tests {
    use super::{Mark, Place, of_bar, place};

    const LEFT: i32 = 70;
    const RIGHT: i32 = 700;

    /// Every few pixels, each of the three lines: all labels on the plot, in rows of their own, none with a line through it.
    #[test]
    fn labels_stay_on_the_plot_off_each_other_and_off_the_lines() {
        for low in (LEFT..=RIGHT).step_by(17) {
            for central in (LEFT..=RIGHT).step_by(13) {
                for high in (low..=RIGHT).step_by(11) {
                    let marks = [(low, 80), (central, 95), (high, 130)].map(|(x, width)| Mark { x, width });
                    let places = place(marks, LEFT, RIGHT);
                    let mut rows = places.map(|place| place.row);
                    rows.sort_unstable();
                    assert_eq!(rows, [0, 1, 2]);
                    for (mark, Place { row, left }) in marks.iter().zip(places) {
                        let end = left + mark.width;
                        assert!(left >= LEFT && end <= RIGHT, "{low} {central} {high}: {left} to {end}");
                        // Beside its own line.
                        assert!(left - mark.x == 4 || mark.x - end == 4);
                        for (other, its) in marks.iter().zip(places) {
                            let is_crossed = its.row < row && left <= other.x && other.x <= end;
                            assert!(!is_crossed, "{low} {central} {high}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_bar_prints_no_value_twice() {
        let print = |value: f64| format!("{value:.1}");
        let labels = |low, high| of_bar([low, high], 10.0, print);
        let one = |end: f64, text: &str| vec![(end, text.to_owned())];
        assert_eq!(labels(Some(10.0), Some(10.0)), one(10.0, "10.0"));
        assert_eq!(labels(Some(9.99), Some(10.01)), one(10.01, "10.0"));
        assert_eq!(labels(Some(12.01), Some(12.0)), one(12.01, "12.0"));
        assert_eq!(labels(Some(11.0), Some(13.0)), one(13.0, "low 11.0, high 13.0"));
        assert_eq!(labels(Some(7.0), Some(8.0)), one(7.0, "low 7.0, high 8.0"));
        assert_eq!(labels(Some(12.0), Some(9.0)), [(12.0, "12.0".to_owned()), (9.0, "9.0".to_owned())]);
        assert_eq!(labels(None, Some(9.0)), one(9.0, "9.0"));
        assert!(labels(None, None).is_empty());
    }
}
