//! Draws of two numbers at once, with the regions that hold most of them.

use kurbo::{BezPath, Point, Rect};

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample};
use crate::number::count;
use crate::pens::{BLUE, Pen};

/// (px) side of the plot, which is square.
const PLOT: f64 = 536.0;
/// (px) from the left edge of the page to the plot, and above the plot.
const LEFT: f64 = EDGE + 64.0;
const ABOVE: f64 = 34.0;
/// (px) width of the page.
const PAGE: f64 = LEFT + PLOT + 40.0 + EDGE;
/// Maximum number of tick labels on each axis.
const MOST: u8 = 8;
/// (px) radius of the dot of a draw.
const RADIUS: f64 = 1.4;
const DRAW: &str = "#9cc4e0";
/// Borders of the inner and the outer region. They are drawn cell by cell, so dashes would not show.
const REGIONS: [Pen; 2] =
    [Pen { colour: BLUE, width: 2.8, dashes: "" }, Pen { colour: BLUE, width: 1.2, dashes: "" }];

/// Dots of draws, and lines around the regions of the highest density.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPicture {
    /// The first part of the `id`s in its SVG.
    pub name: &'static str,
    /// Its title.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The first number.
    pub across: Axis,
    /// The second number.
    pub upward: Axis,
    /// The ends of both axes, in the units of the data.
    pub ends: [[f64; 2]; 2],
    /// The draws that are shown, within the ends.
    pub draws: Vec<[f64; 2]>,
    /// The density on an even grid between the ends, a row for each position upward; all rows have the same
    /// length, at least two.
    pub density: Vec<Vec<f64>>,
    /// The density on the border of the inner region, and of the outer one.
    pub levels: [f64; 2],
    /// Legend entries of the draws and of both regions.
    pub legend: [String; 3],
}

impl JointPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let top = HEADER + ABOVE;
        let bottom = top + PLOT + BELOW;
        let mut canvas = legend::page(self.name, PAGE, &self.title, &self.subtitle);
        let [across, upward] = self.ends;
        let area = Rect::new(LEFT, top, LEFT + PLOT, top + PLOT);
        let chart = Chart::new(area, EDGE, across, upward);
        chart.draw(&mut canvas, &self.across, &self.upward, [MOST, MOST]);
        for draw in &self.draws {
            canvas.dot("", chart.at(draw[0], draw[1]), RADIUS, None, DRAW);
        }
        for ((id, level), pen) in
            [("inner", self.levels[0]), ("outer", self.levels[1])].into_iter().zip(REGIONS)
        {
            canvas.path(id, &self.border(&chart, level), Some(pen), "none");
        }
        let [draws, inner, outer] = self.legend.clone();
        let entries = [
            (Sample::Dot(None, DRAW), draws),
            (Sample::Line(REGIONS[0]), inner),
            (Sample::Line(REGIONS[1]), outer),
        ];
        canvas.height = legend::legend(&mut canvas, bottom, 1, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }

    /// The contour of the density `level`: a piece for each cell of the grid that it crosses.
    fn border(&self, chart: &Chart, level: f64) -> BezPath {
        let place = |k: usize, places: usize, [low, high]: [f64; 2]| {
            low + (high - low) * count(k) / count(places.max(2) - 1)
        };
        let rows = self.density.len();
        let mut path = BezPath::new();
        for (j, pair) in self.density.windows(2).enumerate() {
            let columns = pair[0].len();
            for i in 0..columns.saturating_sub(1) {
                // Corners counter-clockwise from the lower left.
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                    let at = chart.at(place(i, columns, self.ends[0]), place(j, rows, self.ends[1]));
                    (at, self.density[j][i] - level)
                });
                let crossings: Vec<Point> = (0..4)
                    .filter_map(|k| {
                        let ((from, low), (to, high)) = (corners[k], corners[(k + 1) % 4]);
                        ((low > 0.0) != (high > 0.0)).then(|| from.lerp(to, low / (low - high)))
                    })
                    .collect();
                for ends in crossings.chunks_exact(2) {
                    path.move_to(ends[0]);
                    path.line_to(ends[1]);
                }
            }
        }
        path
    }
}
