//! How sensitive the answer is to each input.

use analysis::quantities::REST_TIME;
use analysis::{Derivative, Sensitivity, SweepRow};
use case::{Axes, Case, Origin};
use crash3::ObliqueCorrection;
use pim_core::VehicleId;

use super::chosen::or_none;
use crate::data::sensitivity::{held_in_sweep, turned_in_sweep};
use crate::document::{Column, Document, Table};
use crate::outputs::{input_name, output_name, output_quantity};
use crate::units::{Measure, Units, number, significant};
use crate::warnings;
use crate::words::not_the_answer;

/// The derivatives and the sweep as tables, and the warnings of the case as it stands.
#[must_use]
pub fn sensitivity(case: &Case, sensitivity: &Sensitivity, units: Units) -> Document {
    let mut page = Document::of_case(case);
    if let Some(caveat) = not_the_answer("derivatives", &sensitivity.nominal) {
        page.paragraph(caveat);
    }
    for group in sensitivity.derivatives.chunk_by(|a, b| a.output == b.output) {
        if let Some(first) = group.first() {
            page.push(derivatives(first, group, units));
        }
    }
    if !sensitivity.derivatives.is_empty() {
        let of_what = if analysis::is_searched_back(case) {
            "Each derivative follows from the equations, with all other numbers as given (theory 6); if a \
             vehicle is searched back from its rest, it is accurate to about 1 % (theory 11)."
        } else {
            "Each derivative is exact, with all other numbers as given (theory 6)."
        };
        let has_time = sensitivity.derivatives.iter().any(|row| row.output.is(&REST_TIME));
        let of_time = if has_time {
            " Those of a time to rest are taken 1 cm before the rest (theory 11)."
        } else {
            ""
        };
        page.paragraph(format!(
            "{of_what}{of_time} They are ranked by influence: the change of the result in % for 1 % of the input, for \
             1° of an angle, for 10 cm of a coordinate of the scene (the zero of these two is arbitrary), or for \
             1 cm of a contact point that the program placed."
        ));
    }
    if sensitivity.pdof_sweep.is_empty() {
        page.paragraph(
            "No PDOF sweep: it needs the damage, the PDOF and either the contact point or the outline of \
             both vehicles.",
        );
    } else {
        page.push(sweep(sensitivity, units, case));
        page.paragraph(on_the_sweep(sensitivity, case.axes));
    }
    page.blocks.extend(warnings::of_analysis(&sensitivity.nominal, case, units));
    page
}

/// A change smaller than this share of the largest one of its result is a rounded zero.
const ROUNDING: f64 = 1e-12;

/// (SI) by how much a result changes with one of an input's own units, or with all of the input if that is
/// more.
fn size(row: &Derivative) -> f64 {
    (row.value * row.input.factor()).abs() * row.input.number.abs().max(1.0)
}

fn derivatives(first: &Derivative, group: &[Derivative], units: Units) -> Table {
    let quantity = output_quantity(first.output);
    // If there is only one column for a speed, it has the unit of the road.
    let (alone, value) = match quantity {
        Measure::Speed => (Measure::RoadSpeed, units.speed(first.output_value)),
        other => (other, units.format(other, first.output_value)),
    };
    let mut table = Table::new(format!("{}, {value}", output_name(first.output))).columns([
        Column::words("", 34),
        Column::words("", 16),
        Column::numbers("change per unit", 28),
        Column::numbers("% per %", 10),
        Column::numbers("influence", 10),
    ]);
    let largest = group.iter().map(size).fold(0.0, f64::max);
    let (with, without): (Vec<&Derivative>, Vec<&Derivative>) =
        group.iter().partition(|row| size(row) > ROUNDING * largest);
    for row in with {
        let (value, per, step) = match (row.input.origin, row.input.unit) {
            (_, Some(unit)) => (format!("{} {unit}", row.input.number), unit.to_string(), row.input.factor()),
            (Origin::Given | Origin::Shared(_), None) => (row.input.number.to_string(), "1".to_owned(), 1.0),
            (Origin::Estimate(_), None) => ("× 1".to_owned(), "%".to_owned(), 0.01),
        };
        // In the result's unit per one of the input's own.
        let change = significant(units.value(alone, row.value * step), 4);
        table.row([
            input_name(&row.input),
            value,
            format!("{change} {} per {per}", units.name(alone)),
            or_none(row.relative().map(|relative| number(relative, 3))),
            number(100.0 * row.influence(), 2),
        ]);
    }
    let without: Vec<String> = without.iter().map(|row| input_name(&row.input)).collect();
    if !without.is_empty() {
        table.note(format!("no influence: {}", without.join("; ")));
    }
    table
}

fn sweep(sensitivity: &Sensitivity, units: Units, case: &Case) -> Table {
    let speed = units.name(Measure::RoadSpeed);
    let delta_v = |name: &str| Column::numbers(name, 12).unit(speed);
    let mut table = Table::new("PDOF sweep, CRASH3").columns([
        Column::words("", 22).unit("change, °"),
        Column::numbers("PDOF 1", 9).unit("°"),
        Column::numbers("PDOF 2", 9).unit("°"),
        Column::numbers("ΔV", 10).unit("vehicle"),
        delta_v("uncorrected"),
        delta_v("corrected"),
        delta_v("capped"),
        delta_v("uncapped"),
    ]);
    for row in &sensitivity.pdof_sweep {
        // A fixed object has no ΔV.
        for (n, vehicle) in [0, 1].into_iter().filter(|vehicle| !case.vehicles[*vehicle].fixed).enumerate() {
            let [change, first, second] =
                if n == 0 { turned(row, units) } else { [const { String::new() }; 3] };
            let cell =
                |dv: Option<[f64; 2]>| or_none(dv.map(|dv| units.plain(Measure::RoadSpeed, dv[vehicle])));
            table.row([
                change,
                first,
                second,
                (vehicle + 1).to_string(),
                cell(Some(row.crash3.delta_v)),
                cell(row.crash3.corrected.map(|corrected| corrected.delta_v)),
                cell(row.corrected(ObliqueCorrection::Capped)),
                cell(row.corrected(ObliqueCorrection::Uncapped)),
            ]);
        }
    }
    table
}

/// By how much the directions are turned, and both PDOFs.
fn turned(row: &SweepRow, units: Units) -> [String; 3] {
    let nominal = if row.change == 0.0 { " (nominal)" } else { "" };
    let [first, second] = row.pdof.map(|pdof| or_none(pdof.map(|pdof| units.plain(Measure::Angle, pdof))));
    [format!("{}{nominal}", units.signed(Measure::Angle, row.change)), first, second]
}

fn on_the_sweep(sensitivity: &Sensitivity, axes: Axes) -> String {
    let sense = match axes {
        Axes::ZUp => "positive counter-clockwise as in Table 3 of SAE 980025",
        Axes::ZDown => "positive clockwise, opposite to Table 3 of SAE 980025",
    };
    let of = |vehicles: &[VehicleId]| match vehicles {
        [vehicle] => format!("of vehicle {vehicle}"),
        _ => "of both vehicles".to_owned(),
    };
    let mut given = String::new();
    let held = held_in_sweep(sensitivity);
    if !held.is_empty() {
        given.push_str(&format!(" The moment arm {} keeps the value that the file gives.", of(&held)));
    }
    let turned = turned_in_sweep(sensitivity);
    if !turned.is_empty() {
        given.push_str(&format!(
            " The oblique angle {} starts at the value that the file gives, clockwise positive, and turns \
             with the PDOF.",
            of(&turned)
        ));
    }
    format!(
        "The lines of action are turned about the points through which the forces act, {sense}; moment arms \
         and angles to the damaged sides follow.{given} \"corrected\" uses the correction that the case \
         asks for; all values are without restitution (Eq 6–8).",
    )
}
