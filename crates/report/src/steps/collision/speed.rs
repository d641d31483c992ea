//! The speed found.

use analysis::Found;
use case::Basis;
use pim_core::{Tangential, Vector2, VehicleId};
use reconcile::{AffineImpact, Quadratic};

use super::super::numbers::Known;
use super::super::{Draft, n, step};
use super::Collision;

/// A law whose closed form the report writes out.
struct ClosedForm {
    /// P_n = α x + β over the approach speed x; β may be zero for every approach speed.
    alpha: &'static str,
    beta: Option<&'static str>,
    /// The same for P_t, where a share of the tangential work counts.
    alpha_t: &'static str,
    beta_t: Option<&'static str>,
    /// u_t + U_t = η x + ζ.
    eta: &'static str,
    zeta: &'static str,
    /// The coefficients of the law.
    own: Known,
}

impl Collision<'_> {
    /// The speed found: in closed form if the reader can follow that, else as a value that the work of the
    /// normal impulse below confirms.
    pub(super) fn speed(&self, found: &Found) -> Vec<Draft> {
        let k = found.unknown;
        let solved =
            step(format!("speed of vehicle {k}, found"), format!("s_{k}"), (found.speed, "m/s"), "theory 6");
        let Some((quadratic, law)) = found.quadratic.as_ref().zip(self.closed_form()) else {
            return vec![solved];
        };
        // With α > 0 and c > 0, only the root with the sign used below is positive.
        if found.admissible.len() != 1 || quadratic.alpha <= 0.0 || quadratic.c <= 0.0 {
            return vec![solved];
        }
        let share = matches!(self.analysis.basis, Basis::TangentialShare(share) if share != 0.0);
        let mut steps: Vec<Draft> = self.slopes(found).into();
        steps.push(self.at_rest(found, "n", "u_n0", found.line.at_rest.normal));
        if law.beta.is_some() || share {
            steps.extend(self.tangential(found));
        }
        if share {
            let Some(affine) = &found.affine_impact else { return vec![solved] };
            steps.extend(with_share(quadratic, affine, &law));
        } else {
            steps.extend(normal_alone(quadratic, &law));
        }
        let x = (-self.impact.outcome.approach.normal, "m/s");
        steps.push(
            step("approach speed", "x", x, "theory 6")
                .equals("[−β + √(β² + 4 α c)]/(2 α)")
                .with([("β", n(quadratic.beta, "N·s"))]),
        );
        steps.push(solved.equals("−(x + u_n0)/c_n"));
        steps
    }

    /// The closed form of the law that acts; `None` for one that the report does not write out.
    fn closed_form(&self) -> Option<ClosedForm> {
        let outcome = &self.impact.outcome;
        let law = self.impact.law.acting(outcome.regime, outcome.impulse_ratio);
        if law.has_moment() {
            return None;
        }
        let (symbol, coefficient) = match law.tangential() {
            // U_t = −e_t u_t
            Tangential::Critical => ("e_t", 0.0),
            Tangential::Restitution(e_t) => ("e_t", e_t),
            Tangential::Ratio(mu) => ("μ", mu),
            Tangential::FractionOfCritical(_)
            | Tangential::Friction(_)
            | Tangential::VelocityChange(_)
            | Tangential::FullOrSliding(_) => return None,
        };
        let own = [("e", law.restitution()), (symbol, coefficient)];
        let own = own.map(|(symbol, value)| (symbol.to_owned(), n(value, ""))).to_vec();
        Some(match symbol {
            "μ" => ClosedForm {
                alpha: "(1 + e)/(k_nn + μ k_nt)",
                beta: None,
                alpha_t: "μ α_n",
                beta_t: None,
                eta: "2 τ + (k_nt + μ k_tt) α_n",
                zeta: "2 u_t0",
                own,
            },
            _ => ClosedForm {
                alpha: "[k_tt (1 + e) + k_nt (1 + e_t) τ]/det K",
                beta: Some("k_nt (1 + e_t) u_t0/det K"),
                alpha_t: "−[k_nn (1 + e_t) τ + k_nt (1 + e)]/det K",
                beta_t: Some("−k_nn (1 + e_t) u_t0/det K"),
                eta: "(1 − e_t) τ",
                zeta: "(1 − e_t) u_t0",
                own,
            },
        })
    }

    /// du/ds along n and t.
    fn slopes(&self, found: &Found) -> [Draft; 2] {
        let (k, slope) = (found.unknown, found.line.slope);
        // u is vehicle 1 relative to vehicle 2.
        let minus = if k == VehicleId::One { "" } else { "−" };
        [("n", "cos", slope.normal), ("t", "sin", slope.tangential)].map(|(axis, function, value)| {
            step(format!("du_{axis}/ds"), format!("c_{axis}"), (value, ""), "theory 6")
                .equals(format!("{minus}{function}(θ_{k} − Γ)"))
        })
    }

    /// u along n or t at the speed zero.
    fn at_rest(&self, found: &Found, axis: &str, symbol: &str, value: f64) -> Draft {
        let k = found.unknown;
        let mut motions = self.impact.outcome.before;
        motions[k.index()].velocity = Vector2::new(0.0, 0.0);
        let (formula, own) = self.relative(axis, &motions);
        let name = format!("u_{axis} with vehicle {k} at rest");
        step(name, symbol, (value, "m/s"), "theory 1").equals(formula).with(own)
    }

    /// How u_t depends on the approach speed.
    fn tangential(&self, found: &Found) -> [Draft; 3] {
        let line = &found.line;
        let (tau, at_touch) = (line.tangential_slope(), line.tangential_at_zero_approach());
        [
            step("du_t/dx over the approach speed x = −u_n", "τ", (tau, ""), "theory 6").equals("−c_t/c_n"),
            self.at_rest(found, "t", "u_t,rest", line.at_rest.tangential),
            step("u_t where the vehicles just touch, x = 0", "u_t0", (at_touch, "m/s"), "theory 6")
                .equals("u_t,rest + u_n0 τ"),
        ]
    }
}

fn coefficient(name: &str, symbol: &str, formula: &str, value: (f64, &'static str), own: &Known) -> Draft {
    step(name, symbol, value, "theory 6").equals(formula).with(own.clone())
}

/// α, β and c.
fn normal_alone(quadratic: &Quadratic, law: &ClosedForm) -> Vec<Draft> {
    let Quadratic { alpha, beta, c } = *quadratic;
    let (name, own) = ("P_n = α x + β", &law.own);
    let mut steps = vec![coefficient(name, "α", law.alpha, (alpha, "kg"), own)];
    steps.extend(law.beta.map(|formula| coefficient(name, "β", formula, (beta, "N·s"), own)));
    let name = "W_n = ½ (1 − e) x P_n, so α x² + β x = c";
    steps.push(coefficient(name, "c", "2 W_n/(1 − e)", (c, "J"), own));
    steps
}

/// The impulse and the sliding over the approach speed; then α, β and c, with the share λ of the tangential
/// work.
fn with_share(quadratic: &Quadratic, affine: &AffineImpact, law: &ClosedForm) -> Vec<Draft> {
    let AffineImpact { normal: [b_n, a_n], tangential: [b_t, a_t], sliding: [zeta, eta] } = *affine;
    let mut own = law.own.clone();
    own.extend([("β_n".to_owned(), n(b_n, "N·s")), ("β_t".to_owned(), n(b_t, "N·s"))]);
    let mut steps = Vec::new();
    for (name, symbol, formula, value) in [
        ("P_n = α_n x + β_n", "α_n", Some(law.alpha), (a_n, "kg")),
        ("P_n = α_n x + β_n", "β_n", law.beta, (b_n, "N·s")),
        ("P_t = α_t x + β_t", "α_t", Some(law.alpha_t), (a_t, "kg")),
        ("P_t = α_t x + β_t", "β_t", law.beta_t, (b_t, "N·s")),
        ("u_t + U_t = η x + ζ", "η", Some(law.eta), (eta, "")),
        ("u_t + U_t = η x + ζ", "ζ", Some(law.zeta), (zeta, "m/s")),
    ] {
        steps.extend(formula.map(|formula| coefficient(name, symbol, formula, value, &law.own)));
    }
    let Quadratic { alpha, beta, c } = *quadratic;
    let name = "W_n + λ W_t = ½ (1 − e) x P_n − ½ λ P_t (u_t + U_t), so α x² + β x = c";
    steps.extend([
        coefficient(name, "α", "α_n − λ α_t η/(1 − e)", (alpha, "kg"), &own),
        coefficient(name, "β", "β_n − λ (α_t ζ + β_t η)/(1 − e)", (beta, "N·s"), &own),
        coefficient(name, "c", "[2 (W_n + λ W_t) + λ β_t ζ]/(1 − e)", (c, "J"), &own),
    ]);
    steps
}
