//! The answers of several laws side by side, as JSON.

use std::f64::consts::E;

use analysis::quantities::FOUND_VALUE;
use analysis::{ByEvidence, Comparison, Correction, EvidenceAnswer, EvidenceMethod, NoEvidence, Seen};
use case::{Case, CaseFile};
use crash3::ObliqueCorrection;
use pim_core::{Real, VehicleId};
use serde::Serialize;
use serde_json::{Value, json};

use super::json::all_warnings;
use super::{followed, identified, list, object, present, pretty, title};
use crate::failures::no_answer;
use crate::law;
use crate::units::{Measure, Units, number};
use crate::words::regime_name;

/// One row of the table, in SI units and radians. Values that a row cannot have are left out.
#[derive(Default, Serialize)]
pub(crate) struct Row {
    #[serde(skip)]
    pub(crate) law: &'static str,
    pub(crate) coefficients: String,
    pub(crate) assumed: &'static str,
    /// CRASH3's friction limits by vehicle.
    pub(crate) friction: Option<[f64; 2]>,
    #[serde(flatten)]
    pub(crate) values: Values,
    pub(crate) found_difference: Option<f64>,
    /// For both speeds, if both are sought.
    pub(crate) speeds_difference: Option<[f64; 2]>,
    pub(crate) delta_v_difference: Option<[f64; 2]>,
    pub(crate) error: Option<String>,
}

#[derive(Default, Serialize)]
pub(crate) struct Values {
    pub(crate) found: Option<f64>,
    /// Both, if both are sought.
    pub(crate) speeds: Option<[f64; 2]>,
    pub(crate) regime: Option<&'static str>,
    pub(crate) delta_v: Option<[f64; 2]>,
    /// None for a fixed object.
    pub(crate) pdof: Option<[Option<f64>; 2]>,
    pub(crate) energy_loss: Option<f64>,
    pub(crate) normal_share: Option<f64>,
    pub(crate) tangential_share: Option<f64>,
    pub(crate) moment_share: Option<f64>,
    pub(crate) final_yaw_rate: Option<[f64; 2]>,
}

/// The answer by one kind of evidence in words: how it was found, or why there is none.
pub(crate) fn evidence_words(answer: &Result<EvidenceAnswer, NoEvidence>, units: Units) -> String {
    match answer {
        Ok(answer) => method(answer.by, units),
        Err(reason) => no_evidence(reason, units),
    }
}

/// The same in SI units.
fn evidence(answer: &Result<EvidenceAnswer, NoEvidence>) -> Value {
    let words = evidence_words(answer, Units::Si);
    let Ok(answer) = answer else { return json!({ "error": words }) };
    present(json!({
        "speeds": answer.speeds,
        "delta_v": answer.delta_v,
        "closing_speed": answer.closing_speed,
        // (J) that the impact would need.
        "crush_energy_needed": answer.crush_energy,
        "energy_loss": answer.energy_loss,
        // (–) difference between momentum and crush energy in standard deviations, if both were weighed.
        "standard_deviations_apart": match answer.by {
            EvidenceMethod::Weighed { apart, .. } => Some(apart),
            _ => None,
        },
        "how": words,
    }))
}

/// How an answer was found.
fn method(by: EvidenceMethod, units: Units) -> String {
    match by {
        EvidenceMethod::DamageAndSpeed { given } => {
            format!("from the crush energy and the given speed of vehicle {given} (theory 6)")
        }
        EvidenceMethod::DamageByObject => "from the crush energy by a fixed object (theory 6)".to_owned(),
        EvidenceMethod::DamageAlongLine => {
            "from the crush energy alone (theory 6): along one line it gives the \
             closing speed and both ΔV, but not how much of the closing speed each vehicle had"
                .to_owned()
        }
        EvidenceMethod::Crash3 { pdof_is_given } => {
            let pdof = if pdof_is_given {
                "the direction of force that the file gives"
            } else {
                "the direction of force that the momentum gives, because the file gives no `pdof`"
            };
            format!(
                "CRASH3's corrected ΔV, from the crush energy and {pdof} (Eq 6, 7, 8). The approaches \
                 cross, so the damage gives a speed only if that of the other vehicle is known"
            )
        }
        EvidenceMethod::Momentum => {
            "from momentum and how the vehicles left the impact (theory 10). Neither the crush energy nor any \
             speed in the file is used"
                .to_owned()
        }
        EvidenceMethod::MomentumAndSpeed { given } => format!(
            "from momentum along the heading of vehicle {}, and the given speed of vehicle {given} (theory 10)",
            given.other()
        ),
        EvidenceMethod::Wall { vehicle, restitution } => format!(
            "from how vehicle {vehicle} left the fixed object, and the restitution there, e = {} (theory 10)",
            number(restitution, 4)
        ),
        EvidenceMethod::MomentumAndDamage => {
            "from momentum along the line of the headings and the crush energy (theory 10). Any speed in the \
             file is not used"
                .to_owned()
        }
        EvidenceMethod::Weighed { errors, apart } => format!(
            "from momentum and the crush energy, each weighed by its error (theory 10): {} % and {} of the \
             velocities after the impact, a factor of {} of the crush energy, one standard deviation each. \
             With these the two lie {} standard deviations apart. A speed in the file is not used",
            number(100.0 * errors.speed, 0),
            units.format(Measure::Angle, errors.direction),
            number(E.power(errors.crush_ln), 2),
            number(apart, 1),
        ),
    }
}

/// Why a kind of evidence has no answer.
fn no_evidence(reason: &NoEvidence, units: Units) -> String {
    let angle = |si: f64| units.format(Measure::Angle, si);
    match reason {
        NoEvidence::NeedsSpeedOrPdof => {
            "no answer: the approaches cross, so the damage gives a speed only if that of the other vehicle \
             is known, and the force does not push on the damaged sides, as CRASH3's ΔV needs"
                .to_owned()
        }
        NoEvidence::NeedsSpeed { angle: si } => format!(
            "no answer: the headings differ by {}, within 10° of one line, so momentum alone does not separate \
             the two speeds. If the speed of one vehicle is known, momentum gives the other",
            angle(*si)
        ),
        NoEvidence::NoDamage => {
            "no answer: the file has no damage data (tables [vehicle1.crush] and [vehicle2.crush])".to_owned()
        }
        NoEvidence::NoLaw => {
            "no answer: the file does not give all that the impact law needs: the contact point and the yaw \
             inertia of each vehicle, and [impact]"
                .to_owned()
        }
        NoEvidence::Failed(failure) => format!("no answer: {}", no_answer(failure, units)),
    }
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
        let apart = |pair: Option<[f64; 2]>, own: Option<[f64; 2]>| {
            pair.zip(own).map(|(pair, own)| [pair[0] - own[0], pair[1] - own[1]])
        };
        row.speeds_difference = apart(row.values.speeds, own.values.speeds);
        row.delta_v_difference = apart(row.values.delta_v, own.values.delta_v);
    }
    rows.insert(0, own);
    rows
}

fn values(analysis: &Seen) -> Values {
    let Some(impact) = &analysis.impact else {
        let exchange = analysis.exchange();
        return Values {
            speeds: analysis.both.as_ref().map(|both| both.speeds),
            delta_v: analysis.both.as_ref().map(|both| both.delta_v),
            energy_loss: exchange.map(|exchange| exchange.energy.loss),
            ..Values::default()
        };
    };
    let outcome = &impact.outcome;
    // The impact by each law at the speeds, whatever gave these.
    let energy = &outcome.energy;
    let share = |work: f64| Some(work / energy.before + 0.0).filter(|share| share.is_finite());
    Values {
        found: FOUND_VALUE.value(analysis, None),
        speeds: analysis.both.as_ref().map(|both| both.speeds),
        regime: outcome.regime.map(regime_name),
        // Those of a fixed object are zero.
        delta_v: Some(outcome.delta_v_magnitude()),
        pdof: Some(
            VehicleId::ALL.map(|id| Some(impact.pdof[id.index()] + 0.0).filter(|_| analysis.moves(id))),
        ),
        energy_loss: Some(energy.loss + 0.0),
        normal_share: share(energy.normal_work),
        tangential_share: share(energy.tangential_work),
        moment_share: share(energy.moment_work).filter(|_| impact.law.has_moment()),
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
/// "delta_v": […], …}], "evidence": {"damage": {…}, "momentum": {…}, "momentum_and_damage": {…}}}`. The first
/// row is the case's own law, and the differences are from it. Shares are of the initial kinetic energy.
///
/// # Errors
/// If serialisation fails, which no comparison causes.
pub fn comparison_json(file: &CaseFile, comparison: &Comparison) -> Result<String, serde_json::Error> {
    pretty(&identified(file, document(&file.case, comparison)))
}

/// The content of the JSON.
pub(crate) fn document(case: &Case, comparison: &Comparison) -> Value {
    let by_evidence = |by: &ByEvidence| {
        object! {
            // (J) as measured.
            "crush_energy"?: by.crush_energy,
            "damage": evidence(&by.damage),
            "momentum": evidence(&by.momentum),
            "momentum_and_damage": evidence(&by.together),
        }
    };
    let row = |row: Row| followed(json!({ "law": row.law }), present(json!(row)));
    object! {
        "title": title(case),
        // The axes of the yaw rates and the signed coefficients.
        "axes": case.axes.name(),
        "rows": list(rows(case, comparison, Units::Si), row),
        // The answers by damage, by momentum and by both.
        "evidence"?: comparison.evidence.as_ref().map(by_evidence),
        // Keys of evidence that the rows by law do not use.
        "left_aside"?: comparison.own.left_aside,
        // The warnings of the case itself.
        "warnings": all_warnings(&comparison.own, case),
    }
}
