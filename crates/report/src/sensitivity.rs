//! How much the answer moves with each estimate, as text and as JSON.

use analysis::{Derivative, Output, Sensitivity};
use case::{Axes, Case, DamageData};
use crash3::ObliqueCorrection;
use serde::Serialize;

use crate::json::{OfMovable, WarningBlock, of_movable};
use crate::units::{Quantity, Units, number, significant};
use crate::wrap::{LINE, first_cell, wrapped};

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// Those of the inputs and of the turned directions.
    axes: &'static str,
    derivatives: Vec<DerivativeBlock<'a>>,
    pdof_sweep: Vec<SweepBlock>,
    /// What the file gives in place of what would follow from the direction: kept in every row of the sweep.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pdof_sweep_held: Vec<String>,
    /// The same, turned with the direction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pdof_sweep_turned: Vec<String>,
    /// Of the case as it stands.
    warnings: Vec<WarningBlock>,
}

/// SI per SI.
#[derive(Serialize)]
struct DerivativeBlock<'a> {
    output: String,
    input: &'a str,
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    relative: Option<f64>,
    influence: f64,
}

/// SI and radians.
#[derive(Serialize)]
struct SweepBlock {
    change: f64,
    pdof: [Option<f64>; 2],
    oblique_angle: [Option<f64>; 2],
    moment_arm: OfMovable,
    uncorrected_delta_v: OfMovable,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v: Option<OfMovable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capped_delta_v: Option<OfMovable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    uncapped_delta_v: Option<OfMovable>,
}

/// The sensitivity as indented JSON, ending in a line break: `{"derivatives": [{"output": …, "input": …, "value": …}], "pdof_sweep": [{"change": …,
/// "delta_v": […]}]}`. Derivatives are SI per SI, `relative` is per cent per per cent, and
/// `influence` the relative change for 1 % of the input, or for 1° of an angle, by which they are ranked.
///
/// # Errors
/// Where serialisation fails, which no sensitivity causes.
pub fn sensitivity_json(case: &Case, sensitivity: &Sensitivity) -> Result<String, serde_json::Error> {
    let paths = |key: &str, vehicles: Vec<usize>| -> Vec<String> {
        vehicles.into_iter().map(|vehicle| format!("vehicle{vehicle}.crush.{key}")).collect()
    };
    let document = Document {
        pdof_sweep_held: paths("moment_arm", given_in_sweep(sensitivity, |damage| damage.moment_arm)),
        pdof_sweep_turned: paths("oblique_angle", given_in_sweep(sensitivity, |damage| damage.oblique_angle)),
        title: case.title.as_deref().unwrap_or_default(),
        axes: case.axes.name(),
        warnings: WarningBlock::all(&sensitivity.nominal, case),
        derivatives: sensitivity
            .derivatives
            .iter()
            .map(|row| DerivativeBlock {
                output: row.output.path(),
                input: &row.input.path,
                value: row.value + 0.0,
                relative: row.relative().map(|relative| relative + 0.0),
                influence: row.influence() + 0.0,
            })
            .collect(),
        pdof_sweep: sensitivity
            .pdof_sweep
            .iter()
            .map(|row| SweepBlock {
                change: row.change + 0.0,
                pdof: row.pdof,
                oblique_angle: row.oblique_angle.map(|angle| angle.map(|angle| angle + 0.0)),
                moment_arm: of_movable(case, row.crash3.moment_arm),
                uncorrected_delta_v: of_movable(case, row.crash3.delta_v),
                delta_v: row.crash3.corrected.map(|corrected| of_movable(case, corrected.delta_v)),
                capped_delta_v: row.corrected(ObliqueCorrection::Capped).map(|dv| of_movable(case, dv)),
                uncapped_delta_v: row.corrected(ObliqueCorrection::Uncapped).map(|dv| of_movable(case, dv)),
            })
            .collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// The vehicles in the sweep, 1 or 2, of whose damage the file gives something.
fn given_in_sweep(sensitivity: &Sensitivity, given: fn(&DamageData) -> Option<f64>) -> Vec<usize> {
    if sensitivity.pdof_sweep.is_empty() {
        return Vec::new();
    }
    let vehicles = (1..).zip(&sensitivity.nominal.vehicles);
    vehicles
        .filter(|(_, vehicle)| vehicle.subject.damage.as_ref().is_some_and(|damage| given(damage).is_some()))
        .map(|(vehicle, _)| vehicle)
        .collect()
}

/// The sensitivity as tables.
#[must_use]
pub fn sensitivity_text(case: &Case, sensitivity: &Sensitivity, units: Units) -> String {
    let mut text = format!("{}\n", case.title.as_deref().unwrap_or("Untitled case"));
    for group in sensitivity.derivatives.chunk_by(|a, b| a.output == b.output) {
        derivatives(&mut text, group, units);
    }
    if !sensitivity.derivatives.is_empty() {
        text.push('\n');
        text.push_str(&wrapped(
            "Each derivative is exact, with all other numbers as given (theory 6). The influence, by which they are ranked, is the change of the result \
             in % for 1 % of the input, or for 1° of an angle, whose zero is a matter of choice.",
        ));
    }
    sweep(&mut text, sensitivity, units, case);
    text
}

/// An output, as a heading calls it.
pub(crate) fn output_name(output: Output) -> String {
    match output {
        Output::Speed { vehicle } => format!("Speed of vehicle {vehicle}"),
        Output::DeltaV { vehicle } => format!("ΔV of vehicle {vehicle}"),
        Output::Pdof { vehicle } => format!("PDOF of vehicle {vehicle}"),
        Output::ClosingSpeed => "Closing speed".to_owned(),
        Output::EnergyLoss => "Energy loss".to_owned(),
        Output::NormalWork => "Normal work".to_owned(),
        Output::TangentialWork => "Tangential work".to_owned(),
    }
}

/// A change smaller than this share of the largest one of its result is the rounding of zero.
const ROUNDING: f64 = 1e-12;

/// (SI) by how much a result moves with one of an input's own units, or with the whole of it where that is more.
fn size(row: &Derivative) -> f64 {
    (row.value * row.input.factor()).abs() * row.input.number.abs().max(1.0)
}

fn derivatives(text: &mut String, group: &[Derivative], units: Units) {
    let Some(first) = group.first() else { return };
    let name = output_name(first.output);
    let beside = units
        .beside_speed()
        .map_or_else(String::new, |road| format!(" = {}", units.format(road, first.output_value)));
    let value = units.format(Quantity::Speed, first.output_value) + &beside;
    let title = format!("{name}, {value}");
    text.push_str(&format!("\n{title:<50}{:>28}{:>10}{:>10}\n", "change per unit", "% per %", "influence"));
    text.push_str(&"─".repeat(LINE));
    text.push('\n');
    let largest = group.iter().map(size).fold(0.0, f64::max);
    let (with, without): (Vec<&Derivative>, Vec<&Derivative>) =
        group.iter().partition(|row| size(row) > ROUNDING * largest);
    for row in with {
        let (unit, per) = match row.input.unit {
            Some(unit) => (format!(" {unit}"), unit.to_string()),
            None => (String::new(), "1".to_owned()),
        };
        let given = format!("{}{unit}", row.input.number);
        // In the result's unit per one of the input's own.
        let change = significant(units.value(units.speed_alone(), row.value * row.input.factor()), 4);
        let change = format!("{change} {} per {per}", units.name(units.speed_alone()));
        let relative = row.relative().map_or_else(|| "–".to_owned(), |relative| number(relative, 3));
        let influence = number(100.0 * row.influence(), 2);
        // A number with many digits takes from the room before the change, or stands on a line of its own.
        let (end, room) = match 43_usize.checked_sub(given.chars().count()) {
            // Two blanks at least.
            Some(room) if room > change.chars().count() => (' ', room),
            _ => ('\n', 78),
        };
        text.push_str(&format!(
            "{}{given}{end}{change:>room$}{relative:>10}{influence:>10}\n",
            first_cell(&row.input.path, 34)
        ));
    }
    let without: Vec<&str> = without.iter().map(|row| row.input.path.as_str()).collect();
    if !without.is_empty() {
        text.push_str(&wrapped(&format!("no influence: {}", without.join(", "))));
    }
}

fn sweep(text: &mut String, sensitivity: &Sensitivity, units: Units, case: &Case) {
    if sensitivity.pdof_sweep.is_empty() {
        text.push('\n');
        text.push_str(&wrapped(
            "No sweep of the PDOF: it needs the damage and the PDOF of both vehicles, and of each its contact point or its outline.",
        ));
        return;
    }
    let speed = units.name(units.speed_alone());
    text.push_str(&format!(
        "\n{:<22}{:>9}{:>9}{:>10}{:>12}{:>12}{:>12}{:>12}\n",
        "PDOF sweep, CRASH3", "PDOF 1", "PDOF 2", "ΔV", "uncorrected", "corrected", "capped", "uncapped"
    ));
    text.push_str(&format!(
        "{:<22}{:>9}{:>9}{:>10}{speed:>12}{speed:>12}{speed:>12}{speed:>12}\n",
        "change, °", "°", "°", "vehicle"
    ));
    text.push_str(&"─".repeat(LINE));
    text.push('\n');
    for row in &sensitivity.pdof_sweep {
        let angle =
            |pdof: Option<f64>| pdof.map_or("–".to_owned(), |pdof| units.plain(Quantity::Angle, pdof));
        let nominal = if row.change == 0.0 { " (nominal)" } else { "" };
        let change = format!("{}{nominal}", units.signed(Quantity::Angle, row.change));
        let directions = format!("{change:<22}{:>9}{:>9}", angle(row.pdof[0]), angle(row.pdof[1]));
        // What is fixed has no ΔV.
        for vehicle in [0, 1].into_iter().filter(|vehicle| !case.vehicles[*vehicle].fixed) {
            let cell = |dv: Option<[f64; 2]>| {
                let dv = dv.map(|dv| units.plain(units.speed_alone(), dv[vehicle]));
                format!("{:>12}", dv.unwrap_or_else(|| "–".to_owned()))
            };
            let cells = [
                Some(row.crash3.delta_v),
                row.crash3.corrected.map(|corrected| corrected.delta_v),
                row.corrected(ObliqueCorrection::Capped),
                row.corrected(ObliqueCorrection::Uncapped),
            ]
            .map(cell)
            .concat();
            let is_first = vehicle == 0 || case.vehicles[0].fixed;
            let directions = if is_first { directions.as_str() } else { "" };
            text.push_str(&format!("{directions:<40}{:>10}{cells}\n", vehicle + 1));
        }
    }
    text.push('\n');
    let sense = match case.axes {
        Axes::ZUp => "positive counter-clockwise as in Table 3 of SAE 980025",
        Axes::ZDown => "positive clockwise, against the sense of Table 3 of SAE 980025",
    };
    let of = |vehicles: &[usize]| match vehicles {
        [vehicle] => format!("of vehicle {vehicle}"),
        _ => "of both vehicles".to_owned(),
    };
    let mut given = String::new();
    let held = given_in_sweep(sensitivity, |damage| damage.moment_arm);
    if !held.is_empty() {
        given.push_str(&format!(" The moment arm {} is held at the value that the file gives.", of(&held)));
    }
    let turned = given_in_sweep(sensitivity, |damage| damage.oblique_angle);
    if !turned.is_empty() {
        given.push_str(&format!(
            " The oblique angle {} starts from the one that the file gives, clockwise positive, and turns with the PDOF.",
            of(&turned)
        ));
    }
    text.push_str(&wrapped(&format!(
        "The lines of action are turned about the points through which the forces act, {sense}; moment arms \
         and angles to the damaged sides follow.{given} \"corrected\" is by the correction that the case asks for; all are without restitution (Eq 6–8).",
    )));
}
