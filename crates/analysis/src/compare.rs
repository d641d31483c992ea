//! Compares the answers of all impact laws for one case, and those of all evidence.

use inputs::{BrachTangential, Case, Dimension, ImpactLaw, Quantity, Restitution};

use crate::analysis::Analysis;
use crate::damage::ASSUMED_FRICTION;
use crate::evidence::{ByEvidence, by_evidence};
use crate::failure::Failure;
use crate::solve::{impact, reconstruct};

/// The assumed tangential restitution: interlocking surfaces do not rebound along each other.
const ASSUMED_TANGENTIAL_RESTITUTION: f64 = 0.0;

/// The answers of all laws to one case.
#[derive(Debug)]
pub struct Comparison {
    /// The case under its own law, and CRASH3's answer under every correction for oblique forces.
    pub own: Analysis,
    /// One row for each other law.
    pub laws: Vec<LawRow>,
    /// The answers of the damage, of the momentum and of both together, if the case has all of them.
    pub evidence: Option<ByEvidence>,
}

/// One law's answer.
#[derive(Debug)]
pub struct LawRow {
    /// The law with its coefficients.
    pub law: ImpactLaw,
    /// The coefficients whose values are assumed, with the reason; empty if the case gives all of them.
    pub assumed: &'static str,
    /// The answer, or why there is none.
    pub answer: Result<Analysis, Failure>,
}

/// As [`compare`](crate::compare()).
pub(crate) fn compare(case: &Case) -> Result<Comparison, Failure> {
    let own = solve(case)?;
    let laws = others(case, &own)
        .into_iter()
        .map(|(law, assumed)| {
            let answer = solve(&under(case, &law));
            LawRow { law, assumed, answer }
        })
        .collect();
    let evidence = by_evidence(case, &own);
    Ok(Comparison { own, laws, evidence })
}

/// The case with another law.
pub(crate) fn under(case: &Case, law: &ImpactLaw) -> Case {
    let mut other = case.clone();
    if let Some(impact) = &mut other.impact {
        impact.law = law.clone();
    }
    other
}

fn solve(case: &Case) -> Result<Analysis, Failure> {
    if case.reconstruct.is_some() { reconstruct(case) } else { impact(case) }
}

/// Every law except the case's own, each with the assumptions for its coefficients.
fn others(case: &Case, own: &Analysis) -> Vec<(ImpactLaw, &'static str)> {
    let Some(impact) = &case.impact else { return Vec::new() };
    // Woolley's laws assume no restitution.
    let restitution = impact.law.restitution().cloned().unwrap_or(Restitution::Constant(0.0));
    let brach = |tangential, moment_restitution| ImpactLaw::Brach {
        restitution: restitution.clone(),
        tangential,
        moment_restitution,
    };
    let (friction, assumed_friction) = match impact.law.friction() {
        Some(friction) => (friction, ""),
        None => {
            (ASSUMED_FRICTION, "the friction limit, within the 0.3 to 1.0 that is usual between vehicles")
        }
    };
    let (tangential_restitution, assumed_restitution) = match impact.law {
        ImpactLaw::Ishikawa { tangential_restitution, .. } => (tangential_restitution, ""),
        _ => (ASSUMED_TANGENTIAL_RESTITUTION, "e_t, of surfaces that interlock"),
    };
    let mut laws = vec![
        (brach(BrachTangential::Critical, None), ""),
        (brach(BrachTangential::Friction(friction), None), assumed_friction),
        (brach(BrachTangential::Critical, Some(0.0)), "e_m, which leaves a common yaw rate"),
        (ImpactLaw::Woolley { tangential_velocity_change: None }, ""),
        (
            ImpactLaw::Ishikawa { restitution: restitution.clone(), tangential_restitution },
            assumed_restitution,
        ),
        (ImpactLaw::KudlichSlibar { restitution: restitution.clone(), friction }, assumed_friction),
    ];
    let is_sideswipe = matches!(impact.law, ImpactLaw::Woolley { tangential_velocity_change: Some(_) });
    let own_change = own.impact.as_ref().and_then(|impact| {
        let (u, v) = (impact.outcome.approach, impact.outcome.separation);
        Quantity::from_si(case.axes.lateral(v.tangential - u.tangential), Dimension::Speed).ok()
    });
    if let Some(change) = own_change.filter(|_| !is_sideswipe) {
        let sideswipe = ImpactLaw::Woolley { tangential_velocity_change: Some(change) };
        laws.insert(4, (sideswipe, "U_t − u_t, that of the case's own law"));
    }
    laws.retain(|(law, _)| !is_same(law, &impact.law));
    laws
}

/// Whether two laws have the same conditions: e_m = −1 is the same as none.
fn is_same(a: &ImpactLaw, b: &ImpactLaw) -> bool {
    let without_moment = |law: &ImpactLaw| match law.clone() {
        ImpactLaw::Brach { restitution, tangential, moment_restitution: Some(-1.0) } => {
            ImpactLaw::Brach { restitution, tangential, moment_restitution: None }
        }
        law => law,
    };
    without_moment(a) == without_moment(b)
}
