//! Points of one number against another of the same kind, with the line where both are equal.

use kurbo::{Point, Rect};

use crate::canvas::Canvas;
use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::font::{Anchor, SMALL};
use crate::legend::{self, EDGE, HEADER, Sample};
use crate::number::count;
use crate::pens::{BLACK, EQUALITY};
use crate::symbol::Symbol;
use crate::ticks;

/// (px) width of a panel with its tick labels, and side of the plot, which is square.
const PANEL: f64 = 600.0;
const PLOT: f64 = 536.0;
/// (px) from the plot to the right end of its panel: the last tick label extends into it.
const BESIDE: f64 = 16.0;
/// (px) above the plot, for the title of the upward axis, and for the panel's own title if it has one.
const ABOVE: f64 = 34.0;
const TITLE: f64 = 20.0;
/// Length of the axes as a multiple of the largest number, for the label of its point.
const BEYOND: f64 = 1.04;
/// Maximum number of tick labels on each axis.
const MOST: u8 = 8;

/// Panels of points side by side, with the same axes, which begin at zero.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPicture {
    /// The first part of the `id`s in its SVG.
    pub name: &'static str,
    /// Its title.
    pub title: String,
    /// The line below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis of every panel.
    pub across: Axis,
    /// The vertical axis of every panel.
    pub upward: Axis,
    /// From left to right.
    pub panels: Vec<ScatterPanel>,
    /// The meaning of each symbol.
    pub legend: Vec<(Symbol, String)>,
    /// Legend entry of the line where both numbers are equal.
    pub equality: String,
}

/// One plot.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPanel {
    /// Its title; empty if there is only one panel.
    pub title: String,
    /// No coordinate is negative.
    pub points: Vec<ScatterPoint>,
}

/// A point.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterPoint {
    /// Across and upward, in the unit of the data.
    pub at: [f64; 2],
    /// How it is drawn.
    pub symbol: Symbol,
    /// Its label.
    pub label: Option<String>,
}

impl ScatterPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let page = 2.0 * EDGE + PANEL * count(self.panels.len().max(1));
        let columns = 2 * self.panels.len();
        let has_titles = self.panels.iter().any(|panel| !panel.title.is_empty());
        let top = HEADER + ABOVE + if has_titles { TITLE } else { 0.0 };
        let bottom = top + PLOT + BELOW;
        let mut canvas = legend::page(self.name, page, &self.title, &self.subtitle);
        let end = self.end();
        let mut left = EDGE;
        for (number, panel) in (1_usize..).zip(&self.panels) {
            let right = left + PANEL - BESIDE;
            let area = Rect::new(right - PLOT, top, right, top + PLOT);
            let chart = Chart::new(area, left, [0.0, end], [0.0, end]);
            canvas.text(Point::new(left, top - 16.0 - TITLE), &panel.title, SMALL, Anchor::Start, BLACK);
            chart.draw(&mut canvas, &self.across, &self.upward, [MOST, MOST]);
            panel.draw(&mut canvas, &chart, number, end);
            left += PANEL;
        }
        let mut entries: Vec<(Sample, String)> =
            self.legend.iter().map(|(symbol, words)| (Sample::Symbol(*symbol), words.clone())).collect();
        entries.push((Sample::Line(EQUALITY), self.equality.clone()));
        canvas.height = legend::legend(&mut canvas, bottom, columns, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }

    /// The end of both axes: a round number beyond all points.
    fn end(&self) -> f64 {
        let points = self.panels.iter().flat_map(|panel| &panel.points);
        let greatest = points.flat_map(|point| point.at).fold(0.0, f64::max);
        let unit = self.across.unit;
        let (step, _) = ticks::round(greatest * BEYOND / unit / f64::from(MOST));
        (greatest * BEYOND / unit / step).ceil().max(1.0) * step * unit
    }
}

impl ScatterPanel {
    fn draw(&self, canvas: &mut Canvas, chart: &Chart, number: usize, end: f64) {
        canvas.line(&format!("equality-{number}"), chart.at(0.0, 0.0), chart.at(end, end), EQUALITY);
        // Hollow symbols hide nothing, so they go on top.
        for is_filled in [true, false] {
            for (k, point) in (1_usize..).zip(&self.points) {
                if point.symbol.is_filled == is_filled {
                    let at = chart.at(point.at[0], point.at[1]);
                    point.symbol.draw(canvas, &format!("point-{number}-{k}"), at);
                }
            }
        }
        for point in &self.points {
            if let Some(label) = &point.label {
                canvas.labels.label_of_point(chart.at(point.at[0], point.at[1]), label, BLACK);
            }
        }
        canvas.place_labels(chart.area.inset(-2.0));
    }
}
