//! The reconciliation: the work that is compared with the crush energy, against the unknown speed.

use kurbo::{BezPath, Point, Rect};

use crate::canvas::Canvas;
use crate::chart::{Axis, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::pens::{BLACK, CURVE, LEVEL, Pen, THIN, WHITE};

const NAME: &str = "reconciliation";

/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 92.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 418.0);
/// (px) height of the page.
const HEIGHT: f64 = HEADER + 556.0;
/// How far the plot extends above the highest work of interest.
const ABOVE: f64 = 1.45;
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 6];
/// The root itself.
const ROOT: Pen = Pen { colour: BLACK, width: 2.0, dashes: "" };

/// The work that is compared with the crush energy, against the unknown speed, with the required work and the
/// speed that makes them equal.
#[derive(Clone, Debug, PartialEq)]
pub struct ReconciliationPicture {
    /// Title of the case.
    pub title: String,
    /// The line below it.
    pub subtitle: String,
    /// Why this is not the answer, shown below the subtitle; usually empty.
    pub caveat: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The horizontal axis; its data are in m/s.
    pub speed: Axis,
    /// The vertical axis; its data are in J.
    pub work: Axis,
    /// The curve, in the order of the speeds.
    pub curve: Vec<CurvePoint>,
    /// (m/s, J) where both are equal: the answer.
    pub found: [f64; 2],
    /// Label of the speed found.
    pub found_label: String,
    /// (m/s) other admissible speeds, with their labels.
    pub others: Vec<(f64, String)>,
    /// (m/s, J) steps of the root finder, if there was one.
    pub steps: Vec<[f64; 2]>,
    /// Legend entries of the curve and of the required work.
    pub legend: [String; 2],
}

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// (m/s)
    pub speed: f64,
    /// (J) work that is compared with the crush energy.
    pub work: f64,
    /// (J) required work.
    pub sought: f64,
}

impl ReconciliationPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let chart = self.chart();
        let mut canvas =
            legend::page(NAME, WIDTH, &self.title, &format!("{}\n{}", self.subtitle, self.caveat));
        chart.draw(&mut canvas, &self.speed, &self.work, MOST);

        self.curve(&chart, &mut canvas, "sought", LEVEL, |point| point.sought);
        self.curve(&chart, &mut canvas, "work", CURVE, |point| point.work);
        for (speed, label) in &self.others {
            let at = chart.at(*speed, self.sought_at(*speed));
            canvas.dot("", at, 6.0, Some(ROOT), WHITE);
            canvas.labels.label(at, label, BLACK);
        }
        let root = chart.at(self.found[0], self.found[1]);
        canvas.line("", root, Point::new(root.x, PLOT.y1), Pen { dashes: "2 3", ..THIN });
        canvas.dot("root", root, 6.0, None, BLACK);
        // Drawn over the root: the last steps all lie on it.
        for [speed, work] in &self.steps {
            let top = chart.at(0.0, *work).y.clamp(PLOT.y0, PLOT.y1);
            let at = Point::new(chart.at(*speed, 0.0).x, top);
            canvas.dot("", at, 3.0, Some(THIN), WHITE);
        }
        canvas.labels.label(root, &self.found_label, BLACK);
        canvas.place_labels(PLOT.inset(-2.0));

        let mut entries = vec![
            (Sample::Line(CURVE), self.legend[0].clone()),
            (Sample::Line(LEVEL), self.legend[1].clone()),
            (Sample::Dot(None, BLACK), format!("the speed found: {}", self.found_label)),
        ];
        if !self.steps.is_empty() {
            let steps = format!("steps of the root-finder ({})", self.steps.len());
            entries.push((Sample::Dot(Some(THIN), WHITE), steps));
        }
        legend::legend(&mut canvas, HEIGHT - 74.0, 2, &entries);
        canvas.height = HEIGHT;
        let title = format!("{}: reconciliation", self.title);
        Drawing::new(title, self.description.clone(), canvas)
    }

    fn chart(&self) -> Chart {
        let across = self.curve.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point.speed), high.max(point.speed)]
        });
        // The page does not extend to a pole of the work.
        let most = ABOVE * self.curve.iter().map(|point| point.sought).fold(self.found[1], f64::max);
        Chart::new(PLOT, EDGE, across, [0.0, most])
    }

    /// (J) the required work at a speed between the points of the curve.
    fn sought_at(&self, speed: f64) -> f64 {
        self.curve
            .iter()
            .min_by(|a, b| (a.speed - speed).abs().total_cmp(&(b.speed - speed).abs()))
            .map_or(0.0, |point| point.sought)
    }

    /// The curve within the plot, cut exactly at the plot's edge.
    fn curve(&self, chart: &Chart, canvas: &mut Canvas, id: &str, pen: Pen, of: fn(&CurvePoint) -> f64) {
        let [low, high] = chart.upward;
        let mut path = BezPath::new();
        let mut last: Option<(f64, f64)> = None;
        for point in &self.curve {
            let here = (point.speed, of(point));
            if !here.1.is_finite() {
                last = None;
                continue;
            }
            let inside = |(_, energy): (f64, f64)| (low..=high).contains(&energy);
            if let Some(before) = last {
                let cross = |from: (f64, f64), to: (f64, f64)| {
                    let edge = if from.1 > high { high } else { low };
                    let share = (edge - from.1) / (to.1 - from.1);
                    chart.at(from.0 + share * (to.0 - from.0), edge)
                };
                match (inside(before), inside(here)) {
                    (true, true) => path.line_to(chart.at(here.0, here.1)),
                    (true, false) => path.line_to(cross(here, before)),
                    (false, true) => {
                        path.move_to(cross(before, here));
                        path.line_to(chart.at(here.0, here.1));
                    }
                    (false, false) => {}
                }
            } else if inside(here) {
                path.move_to(chart.at(here.0, here.1));
            }
            last = Some(here);
        }
        canvas.path(id, &path, Some(pen), "none");
    }
}
