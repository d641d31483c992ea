//! The answers of several laws side by side, as JSON.

use analysis::{Comparison, Correction, Seen, quantity};
use case::{Case, CaseFile};
use crash3::ObliqueCorrection;
use serde::Serialize;

use super::json::WarningBlock;
use super::{identified, pretty, title};
use crate::failures::no_answer;
use crate::law;
use crate::units::Units;
use crate::words::regime_name;

/// One row of the table, in SI units and radians. What a row cannot have is left out.
#[derive(Default, Serialize)]
pub(crate) struct Row {
    pub(crate) law: &'static str,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) coefficients: String,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) assumed: &'static str,
    /// CRASH3's friction limits by vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) friction: Option<[f64; 2]>,
    #[serde(flatten)]
    pub(crate) values: Values,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) found_difference: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) delta_v_difference: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<String>,
}

#[derive(Default, Serialize)]
pub(crate) struct Values {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) found: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) regime: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) delta_v: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pdof: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) energy_loss: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) normal_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tangential_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) moment_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) final_yaw_rate: Option<[f64; 2]>,
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
pub(crate) fn rows(case: &Case, comparison: &Comparison, units: Units) -> Vec<Row> {
    let mut own = Row { values: values(&comparison.own.seen(case.axes)), ..Row::default() };
    if let Some(impact) = &case.impact {
        own.law = law::name(&impact.law);
        own.coefficients = law::coefficients(&impact.law, units);
    }
    let laws = comparison.laws.iter().map(|row| {
        let (values, error) = match &row.answer {
            Ok(analysis) => (values(&analysis.seen(case.axes)), None),
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

fn values(analysis: &Seen) -> Values {
    let Some(impact) = &analysis.impact else { return Values::default() };
    let outcome = &impact.outcome;
    let of_collision = |key: &str| match quantity(key)?.values(analysis) {
        analysis::Values::Shared(value) => value,
        analysis::Values::Pair(_) => None,
    };
    let share = |key: &str| Some(of_collision(key)? / of_collision("impact.initial_energy")? + 0.0);
    Values {
        found: of_collision("found.value"),
        regime: outcome.regime.map(regime_name),
        // Those of a fixed object are zero.
        delta_v: Some(outcome.delta_v_magnitude()),
        pdof: Some(impact.pdof.map(|pdof| pdof + 0.0)),
        energy_loss: of_collision("impact.energy_loss"),
        normal_share: share("impact.normal_work"),
        tangential_share: share("impact.tangential_work"),
        moment_share: share("impact.moment_work"),
        final_yaw_rate: Some(outcome.after.map(|motion| motion.yaw_rate + 0.0)),
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

/// The comparison as indented JSON, ending in a line break: `{"title": …, "rows": [{"law": …, "found": …,
/// "delta_v": […], …}]}`. The first row is the case's own law, and the differences are to it. Shares are of
/// the initial kinetic energy.
///
/// # Errors
/// Where serialisation fails, which no comparison causes.
pub fn comparison_json(file: &CaseFile, comparison: &Comparison) -> Result<String, serde_json::Error> {
    pretty(&identified(file, document(&file.case, comparison)))
}

/// What the JSON says.
pub(crate) fn document<'a>(case: &'a Case, comparison: &Comparison) -> impl Serialize + use<'a> {
    Document {
        title: title(case),
        axes: case.axes.name(),
        rows: rows(case, comparison, Units::Si),
        warnings: WarningBlock::all(&comparison.own, case),
    }
}
