//! The reconciliation: work of the normal impulse over the speed sought.

use analysis::{Analysis, Found, WorkPoint, first_push, work_curve};
use case::CaseFile;
use crash3::EnergyBasis;
use kurbo::{BezPath, Point, Rect};

use super::canvas::{Anchor, Canvas, SMALL};
use super::legend::{self, EDGE, HEADER, Sample, WIDTH};
use super::pens::{BLACK, CURVE, GREY, GRID, LEVEL, Pen, THIN, WHITE};
use super::{Drawing, DrawingError, Subject, ticks};
use crate::Units;
use crate::units::{Quantity, number};

/// Steps of the curve.
const SAMPLES: usize = 240;
/// (px) of the plot.
const PLOT: Rect = Rect::new(EDGE + 92.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 418.0);
/// (px) height of the page.
const HEIGHT: f64 = HEADER + 556.0;
/// How far the plot reaches above the highest work of interest.
const ABOVE: f64 = 1.45;
/// The root itself.
const ROOT: Pen = Pen { colour: BLACK, width: 2.0, dashes: "" };

pub(super) fn draw(file: &CaseFile, analysis: &Analysis, units: Units) -> Result<Drawing, DrawingError> {
    let found = analysis.found.as_ref().ok_or(DrawingError::NoReconciliation)?;
    let curve = work_curve(&file.case, found, SAMPLES)?;
    let axes = Axes::new(&curve, found, units);
    let mut canvas = Canvas::new(Subject::Reconciliation.name(), WIDTH, HEIGHT);
    let title = file.case.title.as_deref().unwrap_or("Untitled case");
    let vehicle = found.unknown.index() + 1;
    legend::header(
        &mut canvas,
        title,
        &format!("Reconciliation: work of the normal impulse over the speed of vehicle {vehicle}"),
    );
    axes.draw(&mut canvas, vehicle);

    axes.curve(&mut canvas, "sought", &curve, LEVEL, |point| point.sought);
    axes.curve(&mut canvas, "work", &curve, CURVE, |point| point.normal_work);
    let top = |energy: f64| axes.at(0.0, energy).y.clamp(PLOT.y0, PLOT.y1);
    for &speed in found.admissible.iter().skip(1) {
        let at = axes.at(speed, axes.sought(&curve, speed));
        canvas.dot("", at, 6.0, Some(ROOT), WHITE);
        canvas.label(at, &format!("also {}", units.format(Quantity::RoadSpeed, speed)), BLACK);
    }
    let root = axes.at(found.speed, found.normal_work);
    canvas.line("", root, Point::new(root.x, PLOT.y1), Pen { dashes: "2 3", ..THIN });
    canvas.dot("root", root, 6.0, None, BLACK);
    // Over the root: the last steps are all on it.
    for step in found.iterations.iter().flatten() {
        let at = Point::new(axes.at(step.speed, 0.0).x, top(step.normal_work));
        canvas.dot("", at, 3.0, Some(THIN), WHITE);
    }
    let answer = units.road_speed(found.speed);
    canvas.label(root, &answer, BLACK);
    canvas.place_labels(PLOT.inset(-2.0));

    let energy = units.format(Quantity::Energy, found.normal_work);
    // What is sought may depend on the speed: an inferred crush, or a basis that restitution has a part in.
    let varies = curve.iter().any(|point| units.format(Quantity::Energy, point.sought) != energy);
    let there = if varies { " at the speed found" } else { "" };
    let mut entries = vec![
        (Sample::Line(CURVE), "Wₙ: work of the normal impulse".to_owned()),
        (Sample::Line(LEVEL), format!("Wₙ sought: {energy}{there}")),
        (Sample::Dot(None, BLACK), format!("the speed found: {answer}")),
    ];
    if let Some(steps) = found.iterations.as_ref().filter(|steps| !steps.is_empty()) {
        let steps = format!("steps of the root-finder ({})", steps.len());
        entries.push((Sample::Dot(Some(THIN), WHITE), steps));
    }
    legend::legend(&mut canvas, HEIGHT - 74.0, 2, &entries);
    let speed = |si: f64| units.format(Quantity::RoadSpeed, si);
    let touch = speed(curve.first().map_or(0.0, |point| point.speed));
    // An interval whose ends look the same is none to the reader.
    let begins = match first_push(&file.case, &curve)?.filter(|&begins| speed(begins) != touch) {
        None => format!("It is zero where the vehicles just touch, at {touch},"),
        Some(begins) => format!(
            "It begins at {}, where the normal impulse becomes a push (Pₙ > 0); from {touch}, where the vehicles just touch, up to there they would have to \
             pull at each other. It rises from zero",
            speed(begins)
        ),
    };
    let crush = match analysis.basis {
        EnergyBasis::Dissipated => format!("the crush energy, {energy},"),
        EnergyBasis::Absorbed => format!(
            "{energy}, which is (1 − e²) times the crush energy of {},",
            units.format(Quantity::Energy, found.crush_energy)
        ),
    };
    let description = format!(
        "Work of the normal impulse over the speed of vehicle {vehicle}. {begins} and reaches {crush} at {answer}. Admissible speeds: {}.",
        found.admissible.iter().map(|&si| speed(si)).collect::<Vec<_>>().join(", "),
    );
    Ok(Drawing::new(Subject::Reconciliation, format!("{title}: reconciliation"), description, canvas))
}

struct Axes {
    units: Units,
    /// (m/s)
    speeds: [f64; 2],
    /// (J)
    energies: [f64; 2],
}

impl Axes {
    fn new(curve: &[WorkPoint], found: &Found, units: Units) -> Self {
        let speeds = curve.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point.speed), high.max(point.speed)]
        });
        // Where W_n runs away, at a pole, the page does not follow.
        let most = ABOVE * curve.iter().map(|point| point.sought).fold(found.normal_work, f64::max);
        Self { units, speeds, energies: [0.0, most] }
    }

    fn at(&self, speed: f64, energy: f64) -> Point {
        let share = |[low, high]: [f64; 2], value: f64| (value - low) / (high - low);
        Point::new(
            PLOT.x0 + share(self.speeds, speed) * PLOT.width(),
            PLOT.y1 - share(self.energies, energy) * PLOT.height(),
        )
    }

    /// (J) the work sought at a speed between the samples.
    fn sought(&self, curve: &[WorkPoint], speed: f64) -> f64 {
        curve
            .iter()
            .min_by(|a, b| (a.speed - speed).abs().total_cmp(&(b.speed - speed).abs()))
            .map_or(0.0, |point| point.sought)
    }

    fn draw(&self, canvas: &mut Canvas, vehicle: usize) {
        let units = self.units;
        canvas.rect("", PLOT, Some(THIN), "none");
        let scaled = |[low, high]: [f64; 2], quantity: Quantity| {
            [units.value(quantity, low), units.value(quantity, high)]
        };
        let [low, high] = scaled(self.speeds, Quantity::RoadSpeed);
        let (values, decimals) = ticks::between(low, high, 10.0);
        for value in values {
            let x = self.at(value * units.size(Quantity::RoadSpeed), 0.0).x;
            canvas.grid(Point::new(x, PLOT.y0), Point::new(x, PLOT.y1), GRID);
            let at = Point::new(x, PLOT.y1 + 18.0);
            canvas.text(at, &number(value, decimals), SMALL, Anchor::Middle, BLACK);
        }
        let [low, high] = scaled(self.energies, Quantity::Energy);
        let (values, decimals) = ticks::between(low, high, 6.0);
        for value in values {
            let y = self.at(0.0, value * units.size(Quantity::Energy)).y;
            canvas.grid(Point::new(PLOT.x0, y), Point::new(PLOT.x1, y), GRID);
            let at = Point::new(PLOT.x0 - 8.0, y + 4.5);
            canvas.text(at, &number(value, decimals), SMALL, Anchor::End, BLACK);
        }
        let below = Point::new(PLOT.center().x, PLOT.y1 + 40.0);
        let speed = format!("speed of vehicle {vehicle} ({})", units.name(Quantity::RoadSpeed));
        canvas.text(below, &speed, SMALL, Anchor::Middle, GREY);
        let above = Point::new(EDGE, PLOT.y0 - 16.0);
        let work = format!("Wₙ ({})", units.name(Quantity::Energy));
        canvas.text(above, &work, SMALL, Anchor::Start, GREY);
    }

    /// The curve, where it is within the plot; it is cut exactly at its edge.
    fn curve(&self, canvas: &mut Canvas, id: &str, curve: &[WorkPoint], pen: Pen, of: fn(&WorkPoint) -> f64) {
        let [low, high] = self.energies;
        let mut path = BezPath::new();
        let mut last: Option<(f64, f64)> = None;
        for point in curve {
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
                    self.at(from.0 + share * (to.0 - from.0), edge)
                };
                match (inside(before), inside(here)) {
                    (true, true) => path.line_to(self.at(here.0, here.1)),
                    (true, false) => path.line_to(cross(here, before)),
                    (false, true) => {
                        path.move_to(cross(before, here));
                        path.line_to(self.at(here.0, here.1));
                    }
                    (false, false) => {}
                }
            } else if inside(here) {
                path.move_to(self.at(here.0, here.1));
            }
            last = Some(here);
        }
        canvas.path(id, &path, Some(pen), "none");
    }
}
