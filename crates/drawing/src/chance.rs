//! A probability against a number, with its band.

use kurbo::Rect;

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::marks::ValueMark;
use crate::number::number;
use crate::pens::{BLACK, BOUND, CLASS, CURVE, FILL};
use crate::vector::{polygon, polyline};

const NAME: &str = "chance";
/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 48.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 334.0);
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 5];

/// A probability against a number.
#[derive(Clone, Debug, PartialEq)]
pub struct ChancePicture {
    /// The event whose probability is shown.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis.
    pub across: Axis,
    /// Minimum number of decimals in the labels.
    pub decimals: usize,
    /// The vertical axis.
    pub upward: Axis,
    /// The number, and the lower end, the probability and the upper end there, from the left.
    pub points: Vec<[f64; 4]>,
    /// Numbers with a line and a label.
    pub marks: Vec<ValueMark>,
    /// Legend entries of the curve and of its band.
    pub legend: [String; 2],
}

impl ChancePicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let all = || self.points.iter().map(|point| point[0]).chain(self.marks.iter().map(|mark| mark.value));
        let across = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
        let chart = Chart::new(PLOT, EDGE, across, [0.0, 1.0]);
        let mut canvas = legend::page(NAME, WIDTH, &self.title, &self.subtitle);
        chart.draw(&mut canvas, &self.across, &self.upward, MOST);
        let edge = |of: usize| self.points.iter().map(move |point| (point[0], point[of]));
        let around = edge(3).chain(edge(1).rev()).map(|(x, y)| chart.at(x, y));
        canvas.path("band", &polygon(around), None, FILL[0]);
        canvas.path("curve", &polyline(edge(2).map(|(x, y)| chart.at(x, y))), Some(CURVE), "none");
        for (k, mark) in (1_usize..).zip(&self.marks) {
            let [low, high] = [0.0, 1.0].map(|end| chart.at(mark.value, end));
            canvas.line(&format!("mark-{k}"), low, high, BOUND);
            let value = number(mark.value / self.across.unit, self.decimals);
            canvas.labels.label(chart.at(mark.value, 0.5), &format!("{} {value}", mark.lead), BLACK);
        }
        canvas.place_labels(PLOT.inset(-2.0));
        let [curve, of_band] = self.legend.clone();
        let entries = [(Sample::Line(CURVE), curve), (Sample::Box(CLASS, FILL[0].to_owned()), of_band)];
        canvas.height = legend::legend(&mut canvas, PLOT.y1 + BELOW, 2, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }
}
