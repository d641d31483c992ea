//! Impact laws and their coefficients in words.

use analysis::Correction;
use case::{BrachTangential, ImpactLaw, OBLIQUE_CORRECTIONS, Restitution, word};
use crash3::ObliqueCorrection;

use crate::units::{Measure, Units};

/// The law with its tangential condition.
pub(crate) fn name(law: &ImpactLaw) -> &'static str {
    match law {
        ImpactLaw::Brach { tangential, moment_restitution, .. } => match (tangential, moment_restitution) {
            (BrachTangential::Critical, Some(0.0)) => "Brach, common yaw rate",
            (_, Some(e_m)) if *e_m > -1.0 => "Brach, moment impulse",
            (BrachTangential::Ratio(_), _) => "Brach, impulse ratio",
            (BrachTangential::FractionOfCritical(_), _) => "Brach, fraction of μ_c",
            (BrachTangential::Friction(_), _) => "Brach, friction limit",
            (BrachTangential::Critical, _) => "Brach, common tangential velocity",
        },
        ImpactLaw::Woolley { tangential_velocity_change: None } => "Woolley",
        ImpactLaw::Woolley { tangential_velocity_change: Some(_) } => "Woolley, sideswipe",
        ImpactLaw::Ishikawa { .. } => "Ishikawa",
        ImpactLaw::KudlichSlibar { .. } => "Kudlich–Slibar",
    }
}

/// Its coefficients: `e 0.3, μ = μ_c`.
pub(crate) fn coefficients(law: &ImpactLaw, units: Units) -> String {
    match law {
        ImpactLaw::Brach { restitution: e, tangential, moment_restitution } => {
            let tangential = match tangential {
                BrachTangential::Ratio(mu) => format!("μ = {mu}"),
                BrachTangential::FractionOfCritical(share) => format!("μ = {share} μ_c"),
                BrachTangential::Friction(limit) => format!("μ at most {limit}"),
                BrachTangential::Critical => "μ = μ_c".to_owned(),
            };
            let moment = moment_restitution.map(|e_m| format!(", e_m {e_m}")).unwrap_or_default();
            format!("e {}, {tangential}{moment}", restitution(e, units))
        }
        ImpactLaw::Woolley { tangential_velocity_change: None } => "e 0, μ = μ_c".to_owned(),
        ImpactLaw::Woolley { tangential_velocity_change: Some(change) } => {
            format!("e 0, U_t − u_t = {}", units.format(Measure::Speed, change.si()))
        }
        ImpactLaw::Ishikawa { restitution: e, tangential_restitution } => {
            format!("e_n {}, e_t {tangential_restitution}", restitution(e, units))
        }
        ImpactLaw::KudlichSlibar { restitution: e, friction } => {
            format!("ε {}, μ at most {friction}", restitution(e, units))
        }
    }
}

fn restitution(restitution: &Restitution, units: Units) -> String {
    match restitution {
        Restitution::Constant(e) => e.to_string(),
        Restitution::OfClosingSpeed { speeds, values } => {
            let points: Vec<String> = speeds
                .iter()
                .zip(values)
                .map(|(speed, e)| format!("{e} at {}", units.format(Measure::Speed, speed.si())))
                .collect();
            points.join(", ")
        }
    }
}

/// The correction's name in the case file.
pub(crate) fn correction_name(correction: ObliqueCorrection) -> &'static str {
    match correction {
        ObliqueCorrection::Friction(_) => "friction",
        without_number => word(&OBLIQUE_CORRECTIONS, &without_number),
    }
}

/// The name of a row of corrections, of one kind for both vehicles.
pub(crate) fn row_name(row: &Correction) -> &'static str {
    let [first, _] = row.corrections;
    correction_name(first)
}

/// The friction limits of a row of corrections that has them.
pub(crate) fn friction_limits(row: &Correction) -> Option<[f64; 2]> {
    match row.corrections {
        [ObliqueCorrection::Friction(first), ObliqueCorrection::Friction(second)] => Some([first, second]),
        _ => None,
    }
}

/// The factor on the crush energy for an oblique force.
pub(crate) fn factor(row: &Correction) -> String {
    let [first, _] = row.corrections;
    match (first, friction_limits(row)) {
        (_, Some([mu_1, mu_2])) if mu_1 != mu_2 => {
            format!("{}, μ_1 = {mu_1}, μ_2 = {mu_2}", friction_factor(&"μ"))
        }
        (ObliqueCorrection::Friction(mu), _) => friction_factor(&mu),
        (ObliqueCorrection::None, _) => "1".to_owned(),
        (ObliqueCorrection::Capped, _) => "1 + tan²α ≤ 2".to_owned(),
        (ObliqueCorrection::Uncapped, _) => "1 + tan²α".to_owned(),
        (ObliqueCorrection::Secant, _) => "1/cos α".to_owned(),
    }
}

/// 1 + |tan α| min(|tan α|, μ), short enough for a label.
pub(crate) fn friction_factor(mu: &dyn std::fmt::Display) -> String {
    format!("1+min(tan²α,{mu}|tanα|)")
}
