//! The probability density of a number, before and after evidence.

use kurbo::Rect;

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::marks::{IntervalMarks, ValueMark};
use crate::pens::{AXIS, BOUND, EQUALITY, FILL, OUTLINE, Pen};
use crate::vector::polyline;

/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 48.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 364.0);
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 5];
const BEFORE: Pen = EQUALITY;

/// The density of a number before and after the evidence, with lines at the ends of an interval and at the
/// median.
#[derive(Clone, Debug, PartialEq)]
pub struct DensityPicture {
    /// The first part of the `id`s in its SVG.
    pub name: &'static str,
    /// The number, with its unit.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it; the labels of the lines are added to it.
    pub description: String,
    /// The horizontal axis, whose unit the labels use.
    pub across: Axis,
    /// Minimum number of decimals in the labels, which never have fewer than the axis.
    pub decimals: usize,
    /// The vertical axis.
    pub upward: Axis,
    /// The curve before the evidence, from the left; empty if unknown.
    pub before: Vec<[f64; 2]>,
    /// The curve after the evidence, at least two points.
    pub after: Vec<[f64; 2]>,
    /// The ends of the interval.
    pub interval: [ValueMark; 2],
    /// The median.
    pub median: ValueMark,
    /// Legend entries of the curves before and after, of the interval and of the median.
    pub legend: [String; 4],
}

impl DensityPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let chart = self.chart();
        let on = (&chart, &self.across, MOST[0]);
        let marks = IntervalMarks::new(&self.interval, ("median", &self.median), on, self.decimals);

        let has_before = !self.before.is_empty();
        let mut canvas = legend::page(self.name, WIDTH, &self.title, &self.subtitle);
        chart.draw(&mut canvas, &self.across, &self.upward, MOST);
        let curve =
            |points: &[[f64; 2]]| polyline(points.iter().map(|&[across, upward]| chart.at(across, upward)));
        let mut filled = curve(&self.after);
        for end in [self.after.last(), self.after.first()].into_iter().flatten() {
            filled.line_to(chart.at(end[0], 0.0));
        }
        filled.close_path();
        canvas.path("after-area", &filled, None, FILL[0]);
        canvas.path("after", &curve(&self.after), Some(OUTLINE[0]), "none");
        if has_before {
            canvas.path("before", &curve(&self.before), Some(BEFORE), "none");
        }
        marks.draw(&mut canvas, &chart);

        let [before, after, interval, median] = self.legend.clone();
        let mut entries = vec![
            (Sample::Box(OUTLINE[0], FILL[0].to_owned()), after),
            (Sample::Line(BOUND), interval),
            (Sample::Line(AXIS), median),
        ];
        if has_before {
            entries.insert(1, (Sample::Line(BEFORE), before));
        }
        canvas.height = legend::legend(&mut canvas, PLOT.y1 + BELOW, 2, &entries) + 6.0;
        let description = format!("{} {}.", self.description, marks.words());
        Drawing::new(self.title.clone(), description, canvas)
    }

    fn chart(&self) -> Chart {
        let points = || self.before.iter().chain(&self.after);
        let marks = [self.interval[0].value, self.median.value, self.interval[1].value];
        let all = || points().map(|point| point[0]).chain(marks);
        let across = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
        let most = points().map(|point| point[1]).fold(0.0, f64::max);
        let upward = [0.0, IntervalMarks::upward(PLOT, most)];
        Chart::new(PLOT, EDGE, across, upward)
    }
}
