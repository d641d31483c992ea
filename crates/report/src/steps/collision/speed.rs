//! The speed found.

use analysis::Found;
use case::Basis;
use pim_core::{Law, Tangential, Vector2, VehicleId};
use reconcile::{AffineImpact, ApproachLine, Quadratic};

use super::super::{Step, angle, heading, n, p, step};
use super::Collision;

/// A coefficient in symbols and in numbers.
type Written = (&'static str, String);

/// The normal impulse P_n = α x + β over the approach speed.
struct Push {
    alpha: Written,
    /// `None` if β is zero for every approach speed.
    beta: Option<Written>,
}

/// The further terms for a share of the tangential work: P_t = α_t x + β_t and u_t + U_t = η x + ζ.
struct Slide {
    alpha: Written,
    /// `None` if β_t is zero for every approach speed.
    beta: Option<Written>,
    eta: Written,
    zeta: Written,
}

impl Collision<'_> {
    /// The speed found: in closed form if the reader can follow that, else as a value that the work of the
    /// normal impulse below confirms.
    pub(super) fn speed(&self, found: &Found) -> Vec<Step> {
        let unsolved = || vec![self.solved(found, "", String::new())];
        let Some(quadratic) = &found.quadratic else { return unsolved() };
        // With α > 0 and c > 0, only the root with the sign used below is positive.
        if found.admissible.len() != 1 || quadratic.alpha <= 0.0 || quadratic.c <= 0.0 {
            return unsolved();
        }
        let line = &found.line;
        let Some(push) = self.push(line) else { return unsolved() };
        let share = match self.analysis.basis {
            Basis::TangentialShare(share) if share != 0.0 => Some(share),
            Basis::TangentialShare(_) | Basis::Dissipated | Basis::Absorbed => None,
        };
        let mut steps = self.slopes(found).to_vec();
        steps.push(self.at_rest(found, "n", "u_n0", line.at_rest.normal));
        if push.beta.is_some() || share.is_some() {
            steps.extend(self.tangential(found));
        }
        match share {
            None => steps.extend(self.normal_alone(found, quadratic, push)),
            Some(share) => {
                let Some(affine) = &found.affine_impact else { return unsolved() };
                let Some(slide) = self.slide(line, affine) else { return unsolved() };
                steps.extend(both_impulses(affine, push, slide));
                steps.extend(self.with_share(found, quadratic, affine, share));
            }
        }
        steps.push(self.approach_speed(quadratic));
        let x = -self.impact.outcome.approach.normal;
        let numbers =
            format!("−({} + {}) / {}", n(x, "m/s"), n(line.at_rest.normal, "m/s"), n(line.slope.normal, ""));
        steps.push(self.solved(found, "−(x + u_n0)/c_n", numbers));
        steps
    }

    fn solved(&self, found: &Found, formula: &str, substitution: String) -> Step {
        let k = found.unknown;
        let speed = step(format!("speed of vehicle {k}, found"), format!("s_{k}"));
        speed.equals(formula, substitution).is(found.speed, "m/s", "theory 6")
    }

    /// The law from which the closed form was solved.
    fn acting_law(&self) -> Law {
        let outcome = &self.impact.outcome;
        self.impact.law.acting(outcome.regime, outcome.impulse_ratio)
    }

    /// `None` under a law whose closed form the report does not write out.
    fn push(&self, line: &ApproachLine) -> Option<Push> {
        let (law, k) = (self.acting_law(), self.impact.contact.inverse_mass());
        if law.has_moment() {
            return None;
        }
        let (e, det) = (law.restitution(), n(k.determinant(), "1/kg²"));
        // U_t = −e_t u_t
        let e_t = match law.tangential() {
            Tangential::Critical => 0.0,
            Tangential::Restitution(e_t) => e_t,
            Tangential::Ratio(mu) => {
                let numbers = format!(
                    "(1 + {}) / ({} + {} · {})",
                    n(e, ""),
                    n(k.nn, "1/kg"),
                    n(mu, ""),
                    n(k.nt, "1/kg")
                );
                return Some(Push { alpha: ("(1 + e)/(k_nn + μ k_nt)", numbers), beta: None });
            }
            Tangential::FractionOfCritical(_)
            | Tangential::Friction(_)
            | Tangential::VelocityChange(_)
            | Tangential::FullOrSliding(_) => return None,
        };
        let alpha = format!(
            "({} · (1 + {}) + {} · (1 + {}) · {}) / {det}",
            n(k.tt, "1/kg"),
            n(e, ""),
            n(k.nt, "1/kg"),
            n(e_t, ""),
            n(line.tangential_slope(), "")
        );
        let at_touch = n(line.tangential_at_zero_approach(), "m/s");
        let beta = format!("{} · (1 + {}) · {at_touch} / {det}", n(k.nt, "1/kg"), n(e_t, ""));
        Some(Push {
            alpha: ("[k_tt (1 + e) + k_nt (1 + e_t) τ]/det K", alpha),
            beta: Some(("k_nt (1 + e_t) u_t0/det K", beta)),
        })
    }

    /// `None` under a law whose closed form the report does not write out.
    fn slide(&self, line: &ApproachLine, affine: &AffineImpact) -> Option<Slide> {
        let (law, k) = (self.acting_law(), self.impact.contact.inverse_mass());
        let e = law.restitution();
        let (tau, at_touch) = (n(line.tangential_slope(), ""), n(line.tangential_at_zero_approach(), "m/s"));
        // U_t = −e_t u_t
        let e_t = match law.tangential() {
            Tangential::Critical => 0.0,
            Tangential::Restitution(e_t) => e_t,
            Tangential::Ratio(mu) => {
                let (mu, normal) = (n(mu, ""), n(affine.normal[1], "kg"));
                return Some(Slide {
                    alpha: ("μ α_n", format!("{mu} · {normal}")),
                    beta: None,
                    eta: (
                        "2 τ + (k_nt + μ k_tt) α_n",
                        format!("2 · {tau} + ({} + {mu} · {}) · {normal}", n(k.nt, "1/kg"), n(k.tt, "1/kg")),
                    ),
                    zeta: ("2 u_t0", format!("2 · {at_touch}")),
                });
            }
            Tangential::FractionOfCritical(_)
            | Tangential::Friction(_)
            | Tangential::VelocityChange(_)
            | Tangential::FullOrSliding(_) => return None,
        };
        let det = n(k.determinant(), "1/kg²");
        let (e, e_t) = (n(e, ""), n(e_t, ""));
        Some(Slide {
            alpha: (
                "−[k_nn (1 + e_t) τ + k_nt (1 + e)]/det K",
                format!(
                    "(−1) · ({} · (1 + {e_t}) · {tau} + {} · (1 + {e})) / {det}",
                    n(k.nn, "1/kg"),
                    n(k.nt, "1/kg")
                ),
            ),
            beta: Some((
                "−k_nn (1 + e_t) u_t0/det K",
                format!("(−1) · {} · (1 + {e_t}) · {at_touch} / {det}", n(k.nn, "1/kg")),
            )),
            eta: ("(1 − e_t) τ", format!("(1 − {e_t}) · {tau}")),
            zeta: ("(1 − e_t) u_t0", format!("(1 − {e_t}) · {at_touch}")),
        })
    }

    /// du/ds along n and t.
    fn slopes(&self, found: &Found) -> [Step; 2] {
        let (k, slope) = (found.unknown, found.line.slope);
        // u is vehicle 1 relative to vehicle 2.
        let minus = if k == VehicleId::One { "" } else { "−" };
        let turn = format!("({} − {})", angle(heading(self.case, k)), angle(self.gamma));
        [("n", "cos", slope.normal), ("t", "sin", slope.tangential)].map(|(axis, function, value)| {
            // A number and the minus before it share one pair of parentheses.
            let numbers = if minus.is_empty() {
                format!("{function}{turn}")
            } else {
                format!("(−1) · {function}{turn}")
            };
            step(format!("du_{axis}/ds"), format!("c_{axis}"))
                .equals(format!("{minus}{function}(θ_{k} − Γ)"), numbers)
                .is(value, "", "theory 6")
        })
    }

    /// u along n or t at the speed zero.
    fn at_rest(&self, found: &Found, axis: &str, symbol: &str, value: f64) -> Step {
        let k = found.unknown;
        let mut motions = self.impact.outcome.before;
        motions[k.index()].velocity = Vector2::new(0.0, 0.0);
        let (formula, numbers) = self.relative(axis, &motions);
        let name = format!("u_{axis} with vehicle {k} at rest");
        step(name, symbol).equals(formula, numbers).is(value, "m/s", "theory 1")
    }

    /// How u_t depends on the approach speed.
    fn tangential(&self, found: &Found) -> [Step; 3] {
        let line = &found.line;
        let (at_rest, slope, tau) = (line.at_rest, line.slope, line.tangential_slope());
        [
            step("du_t/dx over the approach speed x = −u_n", "τ")
                .equals("−c_t/c_n", format!("−{} / {}", p(slope.tangential, ""), n(slope.normal, "")))
                .is(tau, "", "theory 6"),
            self.at_rest(found, "t", "u_t,rest", at_rest.tangential),
            step("u_t where the vehicles just touch, x = 0", "u_t0")
                .equals(
                    "u_t,rest + u_n0 τ",
                    format!(
                        "{} + {} · {}",
                        n(at_rest.tangential, "m/s"),
                        n(at_rest.normal, "m/s"),
                        n(tau, "")
                    ),
                )
                .is(line.tangential_at_zero_approach(), "m/s", "theory 6"),
        ]
    }

    /// α, β and c.
    fn normal_alone(&self, found: &Found, quadratic: &Quadratic, push: Push) -> Vec<Step> {
        let Quadratic { alpha, beta, c } = *quadratic;
        let name = "P_n = α x + β";
        let mut steps = vec![coefficient(name, "α", push.alpha, alpha, "kg")];
        steps.extend(push.beta.map(|written| coefficient(name, "β", written, beta, "N·s")));
        let e = self.impact.law.restitution();
        steps.push(
            step("W_n = ½ (1 − e) x P_n, so α x² + β x = c", "c")
                .equals("2 W_n/(1 − e)", format!("2 · {} / (1 − {})", n(found.normal_work, "J"), n(e, "")))
                .is(c, "J", "theory 6"),
        );
        steps
    }

    /// α, β and c, with the share λ of the tangential work.
    fn with_share(
        &self,
        found: &Found,
        quadratic: &Quadratic,
        affine: &AffineImpact,
        share: f64,
    ) -> [Step; 3] {
        let Quadratic { alpha, beta, c } = *quadratic;
        let e = self.impact.law.restitution();
        let AffineImpact { normal: [b_n, a_n], tangential: [b_t, a_t], sliding: [zeta, eta] } = *affine;
        let (lambda, rest) = (n(share, ""), format!("(1 − {})", n(e, "")));
        let (a_n, b_n, a_t, b_t) = (n(a_n, "kg"), n(b_n, "N·s"), n(a_t, "kg"), n(b_t, "N·s"));
        let (eta, zeta) = (n(eta, ""), n(zeta, "m/s"));
        let name = "W_n + λ W_t = ½ (1 − e) x P_n − ½ λ P_t (u_t + U_t), so α x² + β x = c";
        [
            coefficient(
                name,
                "α",
                ("α_n − λ α_t η/(1 − e)", format!("{a_n} − {lambda} · {a_t} · {eta} / {rest}")),
                alpha,
                "kg",
            ),
            coefficient(
                name,
                "β",
                (
                    "β_n − λ (α_t ζ + β_t η)/(1 − e)",
                    format!("{b_n} − {lambda} · ({a_t} · {zeta} + {b_t} · {eta}) / {rest}"),
                ),
                beta,
                "N·s",
            ),
            coefficient(
                name,
                "c",
                (
                    "[2 (W_n + λ W_t) + λ β_t ζ]/(1 − e)",
                    format!("(2 · {} + {lambda} · {b_t} · {zeta}) / {rest}", n(found.normal_work, "J")),
                ),
                c,
                "J",
            ),
        ]
    }

    /// The approach speed that solves the quadratic.
    fn approach_speed(&self, quadratic: &Quadratic) -> Step {
        let Quadratic { alpha, beta, c } = *quadratic;
        let (beta, alpha, c) = (p(beta, "N·s"), n(alpha, "kg"), n(c, "J"));
        step("approach speed", "x")
            .equals(
                "[−β + √(β² + 4 α c)]/(2 α)",
                format!("(−{beta} + √({beta}² + 4 · {alpha} · {c})) / (2 · {alpha})"),
            )
            .is(-self.impact.outcome.approach.normal, "m/s", "theory 6")
    }
}

fn coefficient(
    name: &str,
    symbol: &str,
    (formula, numbers): Written,
    value: f64,
    unit: &'static str,
) -> Step {
    step(name, symbol).equals(formula, numbers).is(value, unit, "theory 6")
}

/// The impulse and the sliding over the approach speed.
fn both_impulses(affine: &AffineImpact, push: Push, slide: Slide) -> Vec<Step> {
    let AffineImpact { normal: [b_n, a_n], tangential: [b_t, a_t], sliding: [zeta, eta] } = *affine;
    let mut steps = Vec::new();
    let name = "P_n = α_n x + β_n";
    steps.push(coefficient(name, "α_n", push.alpha, a_n, "kg"));
    steps.extend(push.beta.map(|written| coefficient(name, "β_n", written, b_n, "N·s")));
    let name = "P_t = α_t x + β_t";
    steps.push(coefficient(name, "α_t", slide.alpha, a_t, "kg"));
    steps.extend(slide.beta.map(|written| coefficient(name, "β_t", written, b_t, "N·s")));
    let name = "u_t + U_t = η x + ζ";
    steps.push(coefficient(name, "η", slide.eta, eta, ""));
    steps.push(coefficient(name, "ζ", slide.zeta, zeta, "m/s"));
    steps
}
