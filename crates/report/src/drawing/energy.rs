//! The energy: where the initial kinetic energy went.

use analysis::Analysis;
use case::Case;
use kurbo::{Point, Rect};

use super::canvas::{Anchor, Canvas, SMALL};
use super::font;
use super::legend::{self, EDGE, HEADER, WIDTH};
use super::pens::{BLACK, FILL, GREY, OUTLINE, PALE, Pen, THIN, WHITE};
use super::{Drawing, DrawingError, Subject};
use crate::Units;
use crate::units::{Quantity, number};

/// (px) of the bars' room: names to the left, values to the right.
const LEFT: f64 = EDGE + 196.0;
const RIGHT: f64 = WIDTH - EDGE - 190.0;
/// (px) from bar to bar, and the height of a bar.
const STEP: f64 = 46.0;
const BAR: f64 = 28.0;

struct Row {
    id: &'static str,
    name: String,
    energy: f64,
    fill: String,
    edge: Pen,
    /// What it means that the work is negative.
    driven: &'static str,
}

pub(super) fn draw(case: &Case, analysis: &Analysis, units: Units) -> Result<Drawing, DrawingError> {
    let impact = analysis.impact.as_ref().ok_or(DrawingError::NoImpact { subject: Subject::Energy })?;
    let energy = impact.outcome.energy;
    let crush =
        [0, 1].map(|i| analysis.vehicles[i].damage.as_ref().map_or(0.0, |damage| damage.crush_energy));
    let total = crush[0] + crush[1];

    let mut canvas = Canvas::new(Subject::Energy.name(), WIDTH, 10.0);
    let pattern = |name: &str| canvas.pattern(name);
    let black = Pen { colour: BLACK, width: 1.4, dashes: "" };
    let mut losses = Vec::new();
    // Both vehicles share the normal work as their crush energies do, which add up to it in a reconstruction on the basis `dissipated`: there alone it
    // is the crush energy.
    if total > 0.0 {
        let work = if is_crush(total, energy.normal_work) { "crush of" } else { "normal work," };
        for (i, id) in ["crush-1", "crush-2"].into_iter().enumerate() {
            if crush[i] > 0.0 {
                let name = format!("{work} vehicle {}", i + 1);
                let fill = pattern(["stripes-1", "stripes-2"][i]);
                let energy = energy.normal_work * crush[i] / total;
                losses.push(Row { id, name, energy, fill, edge: OUTLINE[i], driven: "" });
            }
        }
    } else {
        let name = "normal work".to_owned();
        losses.push(Row {
            id: "normal",
            name,
            energy: energy.normal_work,
            fill: pattern("stripes-1"),
            edge: OUTLINE[0],
            driven: "",
        });
    }
    let name = "tangential work (sliding)".to_owned();
    losses.push(Row {
        id: "tangential",
        name,
        energy: energy.tangential_work,
        fill: pattern("stripes-t"),
        edge: black,
        driven: "drives the sliding",
    });
    if energy.moment_work != 0.0 {
        let name = "moment work".to_owned();
        losses.push(Row {
            id: "moment",
            name,
            energy: energy.moment_work,
            fill: PALE.to_owned(),
            edge: black,
            driven: "drives the rotation",
        });
    }

    #[expect(clippy::cast_precision_loss, reason = "there are few rows")]
    let bottom = HEADER + STEP * (losses.len() as f64 + 2.0) + 6.0;
    let note = note(analysis, total, energy.normal_work, units);
    let lines = font::lines(&note, SMALL, WIDTH - 2.0 * EDGE);
    #[expect(clippy::cast_precision_loss, reason = "a note has few lines")]
    let height = bottom + 18.0 * (lines.len() as f64 + 1.0);
    canvas = Canvas::new(Subject::Energy.name(), WIDTH, height);
    canvas.define_stripes("stripes-1", OUTLINE[0].colour, FILL[0], 45, 7.0);
    canvas.define_stripes("stripes-2", OUTLINE[1].colour, FILL[1], -45, 7.0);
    canvas.define_stripes("stripes-t", GREY, WHITE, 90, 6.0);
    let title = case.title.as_deref().unwrap_or("Untitled case");
    legend::header(&mut canvas, title, "Energy: where the initial kinetic energy went");

    // What is taken away goes from the right to the left; what is left is the final motion. Work that gives energy back goes to the right.
    let highest = losses
        .iter()
        .scan(energy.before, |left, row| {
            *left -= row.energy;
            Some(*left)
        })
        .fold(energy.before, f64::max);
    let x = |joule: f64| LEFT + joule.max(0.0) / highest * (RIGHT - LEFT);
    let mut y = HEADER + STEP / 2.0;
    let initial = Row {
        id: "initial",
        name: "initial kinetic energy".to_owned(),
        energy: energy.before,
        fill: PALE.to_owned(),
        edge: black,
        driven: "",
    };
    bar(&mut canvas, &initial, [x(0.0), x(energy.before)], y, energy.before, units);
    let mut left = energy.before;
    for row in &losses {
        let from = left;
        left -= row.energy;
        let mark = Point::new(x(from), y + BAR / 2.0);
        y += STEP;
        canvas.grid(mark, Point::new(x(from), y - BAR / 2.0), THIN);
        bar(&mut canvas, row, [x(left), x(from)], y, energy.before, units);
    }
    let mark = Point::new(x(left), y + BAR / 2.0);
    y += STEP;
    canvas.grid(mark, Point::new(x(left), y - BAR / 2.0), THIN);
    let last = Row {
        id: "final",
        name: "final motion".to_owned(),
        energy: energy.after,
        fill: WHITE.to_owned(),
        edge: black,
        driven: "",
    };
    bar(&mut canvas, &last, [x(0.0), x(energy.after)], y, energy.before, units);

    for (k, line) in lines.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a note has few lines")]
        let y = bottom + 18.0 * (k as f64 + 1.0);
        canvas.text(Point::new(EDGE, y), line, SMALL, Anchor::Start, GREY);
    }
    let parts: Vec<String> = std::iter::once(&initial)
        .chain(&losses)
        .chain([&last])
        .map(|row| {
            let remark = remark(row, energy.before).map(|remark| format!(", {remark}")).unwrap_or_default();
            format!("{} {}{remark}", row.name, value(row, energy.before, units))
        })
        .collect();
    Ok(Drawing::new(
        Subject::Energy,
        format!("{title}: energy"),
        format!("Bars from the initial kinetic energy to what is left of it: {}. {note}", parts.join("; ")),
        canvas,
    ))
}

fn value(row: &Row, initial: f64, units: Units) -> String {
    format!("{} ({} %)", units.format(Quantity::Energy, row.energy), share(row, initial))
}

/// (%)
fn share(row: &Row, initial: f64) -> String {
    number(100.0 * row.energy / initial, 1)
}

/// Where the share is negative as printed: not for the rounding of zero.
fn remark(row: &Row, initial: f64) -> Option<&'static str> {
    (!row.driven.is_empty() && share(row, initial).starts_with('-')).then_some(row.driven)
}

fn bar(canvas: &mut Canvas, row: &Row, [from, to]: [f64; 2], y: f64, initial: f64, units: Units) {
    let area = Rect::new(from.min(to), y - BAR / 2.0, from.max(to), y + BAR / 2.0);
    canvas.rect(row.id, area, Some(row.edge), &row.fill);
    let base = y + 4.5;
    canvas.text(Point::new(LEFT - 12.0, base), &row.name, SMALL, Anchor::End, BLACK);
    canvas.text(Point::new(RIGHT + 12.0, base), &value(row, initial, units), SMALL, Anchor::Start, BLACK);
    if let Some(remark) = remark(row, initial) {
        canvas.text(Point::new(RIGHT + 12.0, base + 17.0), remark, SMALL, Anchor::Start, BLACK);
    }
}

/// Whether the normal work is the crush energy, but for rounding.
fn is_crush(crush: f64, normal_work: f64) -> bool {
    (crush - normal_work).abs() <= 1e-6 * normal_work.abs()
}

fn note(analysis: &Analysis, crush: f64, normal_work: f64, units: Units) -> String {
    let mut note = "Each bar begins where the one above it ends.".to_owned();
    if crush > 0.0 && !is_crush(crush, normal_work) {
        let energy = |si: f64| units.format(Quantity::Energy, si);
        let why = match (&analysis.found, analysis.basis) {
            (Some(_), crash3::EnergyBasis::Absorbed) => "restitution gives the rest back",
            _ => "the damage and the impact do not agree",
        };
        note.push_str(&format!(
            " The crush energy is {}, the normal work {}: {why}. The bars share the normal work as the crush energies do.",
            energy(crush),
            energy(normal_work)
        ));
    }
    note
}
