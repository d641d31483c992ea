//! What a recorder stored over time, over distance or within the impact, one chart below the other.

use kurbo::Rect;

use crate::canvas::Canvas;
use crate::chart::{Axis, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::pens::{BOUND, OF_VEHICLE, THIN};
use crate::plan::polyline;

const NAME: &str = "record-curves";

/// (px) height of a chart, and distance from its top to that of the next.
const PANEL: f64 = 150.0;
const NEXT: f64 = 242.0;
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 5];
/// How far a chart extends beyond its numbers, as a share of their span.
const BEYOND: f64 = 0.06;

/// What a recorder stored.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordCurvesPicture {
    /// Title of the case.
    pub title: String,
    /// The line below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// From top to bottom.
    pub panels: Vec<RecordCurves>,
    /// Legend entries of first and second curves, if they have any.
    pub legend: [Option<String>; 2],
}

/// One number, or two of a kind, against another.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordCurves {
    /// The horizontal axis.
    pub across: Axis,
    /// The vertical axis.
    pub upward: Axis,
    /// Points of each curve, in the order of the horizontal axis; empty for a second that is not there.
    pub curves: [Vec<[f64; 2]>; 2],
    /// Where a line across marks something, such as the end of the impact.
    pub marks: Vec<f64>,
}

impl RecordCurvesPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let mut canvas = Canvas::new(NAME, WIDTH, HEADER);
        legend::header(&mut canvas, &self.title, &self.subtitle);
        let mut top = HEADER + 34.0;
        for (k, panel) in self.panels.iter().enumerate() {
            let area = Rect::new(EDGE + 76.0, top, WIDTH - EDGE - 16.0, top + PANEL);
            let [across, upward] = [panel.range(0, panel.across.unit), panel.range(1, panel.upward.unit)];
            let chart = Chart { area, left: EDGE, across, upward };
            chart.draw(&mut canvas, &panel.across, &panel.upward, MOST);
            if upward[0] < 0.0 {
                canvas.grid(chart.at(across[0], 0.0), chart.at(across[1], 0.0), THIN);
            }
            for mark in panel.marks.iter().filter(|mark| (across[0]..=across[1]).contains(mark)) {
                canvas.grid(chart.at(*mark, upward[0]), chart.at(*mark, upward[1]), BOUND);
            }
            for (i, curve) in panel.curves.iter().enumerate().filter(|(_, curve)| curve.len() > 1) {
                let points: Vec<_> = curve.iter().map(|&[x, y]| chart.at(x, y)).collect();
                let id = format!("curve-{}-{}", k + 1, i + 1);
                canvas.path(&id, &polyline(points.iter().copied()), Some(OF_VEHICLE[i]), "none");
            }
            top += NEXT;
        }
        let entries = self.legend.iter().zip(OF_VEHICLE);
        let entries: Vec<_> =
            entries.filter_map(|(text, pen)| Some((Sample::Line(pen), text.clone()?))).collect();
        let below = top - 28.0;
        canvas.set_height(below + legend::height(entries.len(), 2) + 10.0);
        legend::legend(&mut canvas, below, 2, &entries);
        let title = format!("{}: {}", self.title, self.subtitle);
        Drawing::new(NAME, title, self.description.clone(), canvas)
    }
}

impl RecordCurves {
    /// The points of a switch as steps: each state lasts until the next sample says another.
    #[must_use]
    pub fn steps(samples: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(2 * samples.len());
        for &[x, y] in samples {
            if let Some(&[_, before]) = points.last().filter(|[_, before]| *before != y) {
                points.push([x, before]);
            }
            points.push([x, y]);
        }
        points
    }

    /// The span of one coordinate; upward it includes zero.
    fn range(&self, coordinate: usize, unit: f64) -> [f64; 2] {
        let values = self.curves.iter().flatten().map(|point| point[coordinate]);
        let first = values.clone().next().unwrap_or(0.0);
        let begin = if coordinate == 1 { [0.0_f64; 2] } else { [first; 2] };
        let [low, high] = values.fold(begin, |[low, high], value| [low.min(value), high.max(value)]);
        let span = high - low;
        if span <= 0.0 {
            return [low, low + unit];
        }
        let beyond = |end: f64| if end == 0.0 || coordinate == 0 { 0.0 } else { BEYOND * span };
        [low - beyond(low), high + beyond(high)]
    }
}

#[cfg(test)]
mod tests {
    use super::RecordCurves;

    /// Off at −1 s and on at 0: off until 0, and no ramp.
    #[test]
    fn a_switch_is_drawn_in_steps() {
        let samples = [[-2.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.0]];
        let steps = RecordCurves::steps(&samples);
        assert!(
            steps.windows(2).all(|pair| pair[0][0] == pair[1][0] || pair[0][1] == pair[1][1]),
            "{steps:?}"
        );
        assert_eq!(steps[2..4], [[0.0, 0.0], [0.0, 1.0]]);
        assert!(samples.iter().all(|sample| steps.contains(sample)));
    }
}
