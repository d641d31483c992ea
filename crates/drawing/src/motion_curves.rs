//! Numbers of a motion against time, such as speed and yaw rate, one chart below the other.

use kurbo::Rect;

use crate::canvas::Canvas;
use crate::chart::{Axis, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::pens::{OF_VEHICLE, THIN};
use crate::plan::polyline;
use crate::thin::thinned;

const NAME: &str = "motion-curves";

/// (px) height of a chart, and distance from its top to that of the next.
const PANEL: f64 = 170.0;
const NEXT: f64 = 262.0;
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 5];
/// How far a chart extends beyond its numbers, as a share of their span.
const BEYOND: f64 = 0.06;
/// Smaller shares of the unit are rounding errors about zero, such as a yaw rate of 1e-16 rad/s.
const ROUNDING: f64 = 1e-6;

/// Numbers of both vehicles against the time since the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionCurvesPicture {
    /// Title of the case.
    pub title: String,
    /// The line below it.
    pub subtitle: String,
    /// Why this is not the answer, shown below the subtitle; usually empty.
    pub caveat: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis; its data are in s.
    pub time: Axis,
    /// From top to bottom.
    pub panels: Vec<MotionCurves>,
    /// Legend entries of the curves of vehicles 1 and 2, if they have any.
    pub legend: [Option<String>; 2],
}

/// One number against time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionCurves {
    /// The vertical axis.
    pub upward: Axis,
    /// Of vehicles 1 and 2: time (s) and number, in the order of time. Empty for one that does not move.
    pub curves: [Vec<[f64; 2]>; 2],
}

impl MotionCurvesPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let mut canvas = Canvas::new(NAME, WIDTH, HEADER);
        legend::header(&mut canvas, &self.title, &format!("{}\n{}", self.subtitle, self.caveat));
        let all = || self.panels.iter().flat_map(|panel| panel.curves.iter().flatten());
        let last = all().map(|[time, _]| *time).fold(0.0, f64::max);
        let across = [0.0, if last > 0.0 { last } else { self.time.unit }];
        let mut top = HEADER + 34.0;
        for (k, panel) in self.panels.iter().enumerate() {
            let area = Rect::new(EDGE + 76.0, top, WIDTH - EDGE - 16.0, top + PANEL);
            let chart = Chart { area, left: EDGE, across, upward: panel.range() };
            chart.draw(&mut canvas, &self.time, &panel.upward, MOST);
            let zero = [across[0], across[1]].map(|time| chart.at(time, 0.0));
            if chart.upward[0] < 0.0 {
                canvas.grid(zero[0], zero[1], THIN);
            }
            for (i, curve) in panel.curves.iter().enumerate().filter(|(_, curve)| curve.len() > 1) {
                let points: Vec<_> = curve.iter().map(|&[time, value]| chart.at(time, value)).collect();
                let id = format!("curve-{}-{}", k + 1, i + 1);
                canvas.path(&id, &polyline(thinned(&points)), Some(OF_VEHICLE[i]), "none");
            }
            top += NEXT;
        }
        let entries = self
            .legend
            .iter()
            .zip(OF_VEHICLE)
            .filter_map(|(text, pen)| Some((Sample::Line(pen), text.clone()?)));
        let entries: Vec<_> = entries.collect();
        let below = top - 28.0;
        canvas.set_height(below + legend::height(entries.len(), 2) + 10.0);
        legend::legend(&mut canvas, below, 2, &entries);
        let title = format!("{}: {}", self.title, self.subtitle);
        Drawing::new(NAME, title, self.description.clone(), canvas)
    }
}

impl MotionCurves {
    /// The span of the numbers, extended to include zero.
    fn range(&self) -> [f64; 2] {
        let values = self.curves.iter().flatten().map(|[_, value]| *value);
        let values = values.filter(|value| value.abs() >= ROUNDING * self.upward.unit);
        let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
        let span = high - low;
        if span == 0.0 {
            return [0.0, self.upward.unit];
        }
        let beyond = |end: f64| if end == 0.0 { 0.0 } else { BEYOND * span };
        [low - beyond(low), high + beyond(high)]
    }
}
