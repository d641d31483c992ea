//! The counts of classes that are expected to hold equally many.

use kurbo::Rect;

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::number::count;
use crate::pens::{AXIS, BOUND, CLASS, FILL};

/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 48.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 334.0);
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [11, 6];
/// Height of the upward axis as a multiple of the highest bar.
const BEYOND: f64 = 1.1;

/// A bar for each class, from 0 to 1 across, and the count expected of each.
#[derive(Clone, Debug, PartialEq)]
pub struct RanksPicture {
    /// The first part of the `id`s in its SVG.
    pub name: &'static str,
    /// The numbers that are counted.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis, from 0 to 1.
    pub across: Axis,
    /// The vertical axis, for the counts.
    pub upward: Axis,
    /// The count of each class; at least one class.
    pub counts: Vec<f64>,
    /// The expected count of each class.
    pub expected: f64,
    /// The range in which most counts lie if the expectation is right.
    pub band: [f64; 2],
    /// Legend entries of a class, of the line and of the band.
    pub legend: [String; 3],
}

impl RanksPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let most = self.counts.iter().copied().fold(self.band[1], f64::max) * BEYOND;
        let chart = Chart::new(PLOT, EDGE, [0.0, 1.0], [0.0, most]);
        let mut canvas = legend::page(self.name, WIDTH, &self.title, &self.subtitle);
        chart.draw(&mut canvas, &self.across, &self.upward, MOST);
        chart.bars(&mut canvas, 0.0, 1.0 / count(self.counts.len().max(1)), &self.counts);
        let [low, high] = self.band;
        for (id, level, pen) in
            [("low", low, BOUND), ("high", high, BOUND), ("expected", self.expected, AXIS)]
        {
            canvas.line(id, chart.at(0.0, level), chart.at(1.0, level), pen);
        }
        let [classes, expected, band] = self.legend.clone();
        let entries = [
            (Sample::Box(CLASS, FILL[0].to_owned()), classes),
            (Sample::Line(AXIS), expected),
            (Sample::Line(BOUND), band),
        ];
        canvas.height = legend::legend(&mut canvas, PLOT.y1 + BELOW, 3, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }
}
