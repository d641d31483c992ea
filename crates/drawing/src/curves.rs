//! Numbers of a motion or of a recorder against time or distance, one chart below the other.

use kurbo::Rect;

use crate::chart::{Axis, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::pens::{BLUE, BOUND, COMPUTED, OF_VEHICLE, THIN};
use crate::thin::thinned;
use crate::vector::polyline;

/// (px) from the bottom of a chart to the top of the next.
const BETWEEN: f64 = 92.0;
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 5];
/// How far a chart extends beyond its numbers, as a share of their span.
const BEYOND: f64 = 0.06;
/// The colour of a stored point, that of the first curve.
const DOT: &str = BLUE;
/// Smaller shares of the unit are rounding errors about zero, such as a yaw rate of 1e-16 rad/s.
const ROUNDING: f64 = 1e-6;

/// Numbers against time or distance.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvesPicture {
    /// The name of the drawing and of the ids in it.
    pub name: &'static str,
    /// Title of the case.
    pub title: String,
    /// The line below it.
    pub subtitle: String,
    /// Why this is not the answer, shown below the subtitle; usually empty.
    pub caveat: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// (px) height of each chart.
    pub height: f64,
    /// Whether points without which a curve looks the same are left out.
    pub is_thinned: bool,
    /// From top to bottom.
    pub panels: Vec<Curves>,
    /// What is in the charts.
    pub legend: Vec<(CurveKind, String)>,
}

/// What a legend entry of curves stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// The first curve of a chart.
    First,
    /// The second.
    Second,
    /// A point of a curve that was stored.
    Sample,
    /// The end of a curve that was computed.
    Computed,
    /// A line across.
    Mark,
}

impl CurveKind {
    fn sample(self) -> Sample {
        match self {
            Self::First => Sample::Line(OF_VEHICLE[0]),
            Self::Second => Sample::Line(OF_VEHICLE[1]),
            Self::Sample => Sample::Dot(None, DOT),
            Self::Computed => Sample::Line(COMPUTED),
            Self::Mark => Sample::Line(BOUND),
        }
    }
}

/// One number, or two of a kind, against another.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// The horizontal axis.
    pub across: Axis,
    /// Its ends; none if they are those of the curves.
    pub ends: Option<[f64; 2]>,
    /// The vertical axis.
    pub upward: Axis,
    /// Points of each curve, in the order of the horizontal axis; empty for a second that is not there.
    pub curves: [Vec<[f64; 2]>; 2],
    /// Points that were stored, each a dot; empty if the curves are not of samples.
    pub samples: Vec<[f64; 2]>,
    /// A computed continuation of the first curve, from its last point; usually empty.
    pub computed: Vec<[f64; 2]>,
    /// Where a line across marks something, such as the end of the impact.
    pub marks: Vec<f64>,
}

impl CurvesPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let mut canvas =
            legend::page(self.name, WIDTH, &self.title, &format!("{}\n{}", self.subtitle, self.caveat));
        let mut top = HEADER + 34.0;
        for (k, panel) in self.panels.iter().enumerate() {
            let area = Rect::new(EDGE + 76.0, top, WIDTH - EDGE - 16.0, top + self.height);
            let across = panel.ends.unwrap_or_else(|| panel.range(0));
            let upward = panel.range(1);
            let chart = Chart::new(area, EDGE, across, upward);
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
                let path = if self.is_thinned { polyline(thinned(&points)) } else { polyline(points) };
                canvas.path(&id, &path, Some(OF_VEHICLE[i]), "none");
            }
            if panel.computed.len() > 1 {
                let points = panel.computed.iter().map(|&[x, y]| chart.at(x, y));
                canvas.path(&format!("computed-{}", k + 1), &polyline(points), Some(COMPUTED), "none");
            }
            for (i, &[x, y]) in panel.samples.iter().enumerate() {
                canvas.dot(&format!("sample-{}-{}", k + 1, i + 1), chart.at(x, y), 3.0, None, DOT);
            }
            top += self.height + BETWEEN;
        }
        let entries: Vec<_> = self.legend.iter().map(|(kind, text)| (kind.sample(), text.clone())).collect();
        canvas.height = legend::legend(&mut canvas, top - 28.0, 2, &entries) + 10.0;
        let title = format!("{}: {}", self.title, self.subtitle);
        Drawing::new(title, self.description.clone(), canvas)
    }
}

impl Curves {
    /// The points of a switch as steps: each state lasts until a sample has another one.
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
    fn range(&self, coordinate: usize) -> [f64; 2] {
        let is_upward = coordinate == 1;
        let unit = if is_upward { self.upward.unit } else { self.across.unit };
        let curves = self.curves.iter().chain([&self.samples, &self.computed]);
        let values = curves.flatten().map(|point| point[coordinate]);
        let first = values.clone().next().filter(|_| !is_upward).unwrap_or(0.0);
        let values = values.filter(|value| !is_upward || value.abs() >= ROUNDING * unit);
        let [low, high] = values.fold([first; 2], |[low, high], value| [low.min(value), high.max(value)]);
        let span = high - low;
        if span <= 0.0 {
            return [low, low + unit];
        }
        let beyond = |end: f64| if end == 0.0 || !is_upward { 0.0 } else { BEYOND * span };
        [low - beyond(low), high + beyond(high)]
    }
}

#[cfg(test)]
mod tests {
    use super::Curves;

    /// Off at −1 s and on at 0: off until 0, and no ramp.
    #[test]
    fn a_switch_is_drawn_in_steps() {
        let samples = [[-2.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.0]];
        let steps = Curves::steps(&samples);
        assert!(
            steps.windows(2).all(|pair| pair[0][0] == pair[1][0] || pair[0][1] == pair[1][1]),
            "{steps:?}"
        );
        assert_eq!(steps[2..4], [[0.0, 0.0], [0.0, 1.0]]);
        assert!(samples.iter().all(|sample| steps.contains(sample)));
    }
}
