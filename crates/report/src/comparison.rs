//! The answers of several laws side by side, as text and as JSON.

use analysis::{Analysis, Comparison, Correction};
use case::{Axes, Case};
use crash3::ObliqueCorrection;
use serde::Serialize;

use crate::axes;
use crate::failures::no_answer;
use crate::json::WarningBlock;
use crate::law;
use crate::units::{Quantity, Units, number};
use crate::words::regime_name;
use crate::wrap::{LINE, hanging, wrapped};

/// One row of the table, in SI units and radians. What a row cannot have is left out.
#[derive(Default, Serialize)]
struct Row {
    law: &'static str,
    #[serde(skip_serializing_if = "String::is_empty")]
    coefficients: String,
    #[serde(skip_serializing_if = "str::is_empty")]
    assumed: &'static str,
    /// CRASH3's friction limits by vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<[f64; 2]>,
    #[serde(flatten)]
    values: Values,
    #[serde(skip_serializing_if = "Option::is_none")]
    found_difference: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v_difference: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

#[derive(Default, Serialize)]
struct Values {
    #[serde(skip_serializing_if = "Option::is_none")]
    found: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    regime: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_v: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pdof: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_loss: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangential_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moment_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    final_yaw_rate: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// Those of the yaw rates and the signed coefficients.
    axes: &'static str,
    rows: Vec<Row>,
    /// Of the case as it stands.
    warnings: Vec<WarningBlock>,
}

/// The case's own law first.
fn rows(case: &Case, comparison: &Comparison, units: Units) -> Vec<Row> {
    let mut own = Row { values: values(&comparison.own, case.axes), ..Row::default() };
    if let Some(impact) = &case.impact {
        own.law = law::name(&impact.law);
        own.coefficients = law::coefficients(&impact.law, units);
    }
    let laws = comparison.laws.iter().map(|row| {
        let (values, error) = match &row.answer {
            Ok(analysis) => (values(analysis, case.axes), None),
            Err(failure) => (Values::default(), Some(no_answer(failure, units))),
        };
        let coefficients = law::coefficients(&row.law, units);
        Row { law: law::name(&row.law), coefficients, assumed: row.assumed, values, error, ..Row::default() }
    });
    let corrections = comparison.own.crash3.iter().flat_map(|crash3| &crash3.corrections);
    let mut rows: Vec<Row> = laws.chain(corrections.map(crash3_row)).collect();
    for row in &mut rows {
        row.found_difference = row.values.found.zip(own.values.found).map(|(found, own)| found - own);
        row.delta_v_difference =
            row.values.delta_v.zip(own.values.delta_v).map(|(dv, own)| [dv[0] - own[0], dv[1] - own[1]]);
    }
    rows.insert(0, own);
    rows
}

fn values(analysis: &Analysis, axes: Axes) -> Values {
    let Some(impact) = &analysis.impact else { return Values::default() };
    let outcome = &impact.outcome;
    let energy = outcome.energy;
    let share = |work: f64| work / energy.before + 0.0;
    Values {
        found: analysis.found.as_ref().map(|found| found.speed + 0.0),
        regime: outcome.regime.map(regime_name),
        delta_v: Some(outcome.delta_v_magnitude()),
        pdof: Some(impact.pdof.map(|pdof| pdof + 0.0)),
        energy_loss: Some(energy.loss + 0.0),
        normal_share: Some(share(energy.normal_work)),
        tangential_share: Some(share(energy.tangential_work)),
        moment_share: impact.law.has_moment().then(|| share(energy.moment_work)),
        final_yaw_rate: Some(outcome.after.map(|motion| axes.lateral(motion.yaw_rate) + 0.0)),
    }
}

fn crash3_row(row: &Correction) -> Row {
    let [correction, _] = row.corrections;
    let law = match correction {
        ObliqueCorrection::None => "CRASH3, uncorrected",
        ObliqueCorrection::Capped => "CRASH3, corrected",
        ObliqueCorrection::Uncapped => "CRASH3, corrected, no cap",
        ObliqueCorrection::Friction(_) => "CRASH3, friction-limited",
        ObliqueCorrection::Secant => "CRASH3, 1/cos α",
    };
    let values =
        Values { delta_v: Some(row.delta_v), energy_loss: Some(row.crush_energy), ..Values::default() };
    let coefficients = format!("common normal velocity; energy times {}", law::factor(row));
    Row { law, coefficients, values, friction: law::friction_limits(row), ..Row::default() }
}

/// The comparison as indented JSON, ending in a line break: `{"title": …, "rows": [{"law": …, "found": …, "delta_v": […], …}]}`. The
/// first row is the case's own law, and the differences are to it. Shares are of the initial kinetic energy.
///
/// # Errors
/// Where serialisation fails, which no comparison causes.
pub fn comparison_json(case: &Case, comparison: &Comparison) -> Result<String, serde_json::Error> {
    let title = case.title.as_deref().unwrap_or_default();
    let document = Document {
        title,
        axes: case.axes.name(),
        rows: rows(case, comparison, Units::Si),
        warnings: WarningBlock::all(&comparison.own, case),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// The comparison as tables and the coefficients behind them, in text of at most 98 columns.
#[must_use]
pub fn comparison_text(case: &Case, comparison: &Comparison, units: Units) -> String {
    let rows = rows(case, comparison, units);
    let answered = || rows.iter().filter(|row| row.error.is_none());
    let name = |quantity: Quantity| units.name(quantity);
    let plain = |quantity: Quantity, value: Option<f64>| value.map(|si| units.plain(quantity, si));
    // A fixed object has neither motion nor heading.
    let of = |pair: Option<[f64; 2]>, i: usize| pair.filter(|_| !case.vehicles[i].fixed).map(|pair| pair[i]);
    let mut text = format!("{}\n\n", case.title.as_deref().unwrap_or("Untitled case"));

    for quantity in [Some(Quantity::Speed), units.beside_speed()].into_iter().flatten() {
        let speed = name(quantity);
        table(
            &mut text,
            &[
                ("speed", speed),
                ("", "change"),
                ("ΔV 1", speed),
                ("", "change"),
                ("ΔV 2", speed),
                ("", "change"),
            ],
            answered().map(|row| {
                let value = |si: Option<f64>| plain(quantity, si);
                let change = |si: Option<f64>| si.map(|si| units.signed(quantity, si));
                let (dv, dv_change) = (row.values.delta_v, row.delta_v_difference);
                let cells = vec![
                    value(row.values.found),
                    change(row.found_difference),
                    value(of(dv, 0)),
                    change(of(dv_change, 0)),
                    value(of(dv, 1)),
                    change(of(dv_change, 1)),
                ];
                (row.law, cells)
            }),
        );
        text.push('\n');
    }
    table(
        &mut text,
        &[("PDOF 1", "°"), ("PDOF 2", "°"), ("E_L", name(Quantity::Energy)), ("W_n", "%"), ("W_t", "%")],
        answered().map(|row| {
            let share = |share: Option<f64>| share.map(|share| number(100.0 * share, 1));
            let values = &row.values;
            let cells = vec![
                plain(Quantity::Angle, of(values.pdof, 0)),
                plain(Quantity::Angle, of(values.pdof, 1)),
                plain(Quantity::Energy, values.energy_loss),
                share(values.normal_share),
                share(values.tangential_share),
            ];
            (row.law, cells)
        }),
    );
    text.push('\n');
    let rates = [Quantity::YawRate, Quantity::YawRateDegrees];
    let [radians, degrees] = rates.map(name);
    table(
        &mut text,
        &[("Ω 1", radians), ("", degrees), ("Ω 2", radians), ("", degrees)],
        // CRASH3 knows no rotation.
        answered().filter(|row| row.values.final_yaw_rate.is_some()).map(|row| {
            let cells = [0, 1].map(|i| rates.map(|rate| plain(rate, of(row.values.final_yaw_rate, i))));
            (row.law, cells.concat())
        }),
    );
    text.push_str("\nCoefficients\n");
    for row in &rows {
        let sliding =
            if row.values.regime == Some("sliding") { "; sliding continues until separation" } else { "" };
        let assumed = match row.assumed {
            "" => String::new(),
            assumed => format!("; assumed: {assumed}"),
        };
        let name = format!("{:<NAME$}", row.law);
        text.push_str(&hanging(&name, &format!("{}{sliding}{assumed}", row.coefficients)));
    }
    for row in &rows {
        if let Some(error) = &row.error {
            text.push('\n');
            text.push_str(&wrapped(&format!("{} has no answer: {error}", row.law)));
        }
    }
    text.push('\n');
    text.push_str(&wrapped(&format!(
        "The first row is the case's own law; the changes are from it, computed before rounding, so that they may \
         be off by one in the last digit from the differences of the printed figures. E_L is the energy loss, for CRASH3 the crush energy; \
         W_n and W_t are the work of the normal and the tangential impulse in % of the initial kinetic energy; Ω is the \
         yaw rate after impact, {} positive. Sources: theory 3 (laws), SAE 980025 Eq 5–8 (CRASH3).",
        axes::sense(case.axes)
    )));
    text
}

const NAME: usize = 34;
const COLUMN: usize = 9;

fn table(
    text: &mut String,
    columns: &[(&str, &str)],
    rows: impl Iterator<Item = (&'static str, Vec<Option<String>>)>,
) {
    let mut line = |name: &str, cells: Vec<String>| {
        let cells: String =
            cells.into_iter().map(|cell| format!("  {cell:>width$}", width = COLUMN - 2)).collect();
        text.push_str(format!("{name:<NAME$}{cells}").trim_end());
        text.push('\n');
    };
    line("law", columns.iter().map(|(title, _)| (*title).to_owned()).collect());
    line("", columns.iter().map(|(_, unit)| (*unit).to_owned()).collect());
    line(&"─".repeat(LINE), Vec::new());
    for (name, cells) in rows {
        line(name, cells.into_iter().map(|cell| cell.unwrap_or_else(|| "–".to_owned())).collect());
    }
}
