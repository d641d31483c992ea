//! Distance against time before a collision: the actual run of a vehicle and other possible ones, the path of
//! the other party, and the place of the impact.

use kurbo::{Point, Rect};

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::pens::{BLACK, BOUND, COURSES, GREY, OTHER_WAY, PLACE, Pen, ZONE};
use crate::thin::thinned;
use crate::vector::polyline;

const NAME: &str = "path-time";
/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 62.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 474.0);
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 8];
/// (px) height of the bar for the other party's time in the danger zone.
const BAR: f64 = 12.0;

/// Distance against time, from the reaction demand to the place of the impact and beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTimePicture {
    /// Title of the case.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis; its data are in s from the reaction demand.
    pub time: Axis,
    /// The vertical axis; its data are in m from the place of the impact, negative before it.
    pub way: Axis,
    /// (s) where the plot ends.
    pub until: f64,
    /// (m) the ends of the vertical axis.
    pub reach: [f64; 2],
    /// The runs of the vehicle, the actual one first.
    pub courses: Vec<PathTimeCourse>,
    /// The distance of the other party along its own path, if it is known, with its legend.
    pub other: Option<(Vec<[f64; 2]>, String)>,
    /// (s) beginning and end of the other party's time in the danger zone, which may end beyond the plot,
    /// with its legend; `None` if the other moves along the same line.
    pub zone: Option<([f64; 2], String)>,
    /// (s) the impact, with its label.
    pub impact: (f64, String),
    /// The label of the reaction demand.
    pub demand: String,
    /// The legend of the places where brakes take effect.
    pub brakes: String,
}

/// A run of the vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTimeCourse {
    /// Its legend.
    pub legend: String,
    /// Which of [`PENS`](PathTimePicture::PENS) pens draws it; 0 is that of the actual run.
    pub pen: usize,
    /// (s, m) in the order of time.
    pub points: Vec<[f64; 2]>,
    /// (s, m) where the brakes take effect, if they do.
    pub brakes: Option<[f64; 2]>,
}

impl PathTimeCourse {
    fn pen(&self) -> Pen {
        COURSES[self.pen.min(COURSES.len() - 1)]
    }
}

impl PathTimePicture {
    /// Number of pens for runs.
    pub const PENS: usize = COURSES.len();

    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let runs = self.courses.iter().map(|course| (Sample::Line(course.pen()), course.legend.clone()));
        let mut entries: Vec<(Sample, String)> = runs.collect();
        // If it is on the same line, its motion is drawn among the runs, with a pen of its own.
        let other_pen = if self.zone.is_some() { OTHER_WAY } else { Pen { dashes: "12 3 2 3", ..OTHER_WAY } };
        if let Some((_, legend)) = &self.other {
            entries.push((Sample::Line(other_pen), legend.clone()));
        }
        if let Some((_, legend)) = &self.zone {
            entries.push((Sample::Box(Pen { width: 1.0, ..OTHER_WAY }, ZONE.to_owned()), legend.clone()));
        }
        if self.courses.iter().any(|course| course.brakes.is_some()) {
            entries
                .push((Sample::Dot(Some(Pen { width: 1.6, ..COURSES[0] }), "#ffffff"), self.brakes.clone()));
        }
        let mut canvas = legend::page(NAME, WIDTH, &self.title, &self.subtitle);
        let chart = Chart::new(PLOT, EDGE, [0.0, self.until], self.reach);
        chart.draw(&mut canvas, &self.time, &self.way, MOST);

        if let Some((times, _)) = &self.zone {
            let [from, to] = times.map(|time| chart.at(time.clamp(0.0, chart.across[1]), 0.0));
            let bar = Rect::new(from.x, from.y - BAR, to.x.max(from.x + 1.0), to.y);
            canvas.labels.protect(bar);
            canvas.rect("zone", bar, Some(Pen { width: 1.0, dashes: "", ..OTHER_WAY }), ZONE);
        }
        canvas.line("place", chart.at(0.0, 0.0), chart.at(self.until, 0.0), PLACE);
        if let Some((points, _)) = &self.other {
            canvas.path("other", &polyline(self.within(points, &chart)), Some(other_pen), "none");
        }
        // The actual run lies on top.
        for (k, course) in self.courses.iter().enumerate().rev() {
            let points = self.within(&course.points, &chart);
            canvas.path(
                &format!("course-{}", k + 1),
                &polyline(thinned(&points)),
                Some(course.pen()),
                "none",
            );
        }
        for (k, course) in self.courses.iter().enumerate().rev() {
            let is_within = |at: &[f64; 2]| at[0] <= self.until && at[1] <= self.reach[1];
            if let Some([time, way]) = course.brakes.filter(is_within) {
                let ring = Pen { width: 1.6, dashes: "", ..course.pen() };
                canvas.dot(&format!("brakes-{}", k + 1), chart.at(time, way), 4.0, Some(ring), "#ffffff");
            }
        }
        let at = chart.at(self.impact.0, 0.0);
        canvas.dot("impact", at, 5.0, None, BLACK);
        canvas.labels.label(at, &self.impact.1, BLACK);
        let demand = chart
            .at(0.0, self.courses.first().and_then(|course| course.points.first()).map_or(0.0, |at| at[1]));
        canvas.dot("demand", demand, 5.0, None, GREY);
        canvas.line("demand-line", chart.at(0.0, self.reach[0]), chart.at(0.0, self.reach[1]), BOUND);
        canvas.labels.label(demand, &self.demand, BLACK);
        canvas.place_labels(PLOT.inset(-2.0));
        canvas.height = legend::legend(&mut canvas, PLOT.y1 + BELOW, 2, &entries) + 6.0;
        let title = format!("{}: {}", self.title, self.subtitle.lines().next().unwrap_or_default());
        Drawing::new(title, self.description.clone(), canvas)
    }

    /// The points of a line within the plot, cut at its upper end.
    fn within(&self, points: &[[f64; 2]], chart: &Chart) -> Vec<Point> {
        let highest = self.reach[1];
        let mut kept = Vec::with_capacity(points.len());
        for (k, &[time, way]) in points.iter().enumerate() {
            if way > highest {
                if let Some([before, below]) = k.checked_sub(1).and_then(|k| points.get(k)).copied() {
                    let share = (highest - below) / (way - below);
                    kept.push(chart.at(before + share * (time - before), highest));
                }
                break;
            }
            kept.push(chart.at(time.min(self.until), way.max(self.reach[0])));
        }
        kept
    }
}
