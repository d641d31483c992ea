//! The speed found.

use analysis::Found;
use pim_core::{Tangential, Vector2, VehicleId};
use reconcile::{ApproachLine, Quadratic};

use super::super::{Step, angle, n, p, step};
use super::Collision;

/// The normal impulse P_n = α x + β over the approach speed, each coefficient in symbols and in numbers.
struct Push {
    alpha: (&'static str, String),
    /// `None` where β is zero whatever the approach.
    beta: Option<(&'static str, String)>,
}

impl Collision<'_> {
    /// The speed found: in closed form where the reader can follow that, else as what the work of the normal
    /// impulse below confirms.
    pub(super) fn speed(&self, found: &Found) -> Vec<Step> {
        let unsolved = || vec![self.solved(found, "", String::new())];
        let Some(quadratic) = &found.quadratic else { return unsolved() };
        // Of two approaches that give the energy, the paper's is the one that this sign gives: α > 0.
        if found.admissible.len() != 1 || quadratic.alpha <= 0.0 {
            return unsolved();
        }
        let line = &found.line;
        let Some(push) = self.push(line) else { return unsolved() };
        let mut steps = self.slopes(found).to_vec();
        steps.push(self.at_rest(found, "n", "u_n0", line.at_rest.normal));
        if push.beta.is_some() {
            steps.extend(self.tangential(found));
        }
        steps.extend(self.approach_speed(found, quadratic, push));
        let x = -self.impact.outcome.approach.normal;
        let numbers =
            format!("−({} + {}) / {}", n(x, "m/s"), n(line.at_rest.normal, "m/s"), n(line.slope.normal, ""));
        steps.push(self.solved(found, "−(x + u_n0)/c_n", numbers));
        steps
    }

    fn solved(&self, found: &Found, formula: &str, substitution: String) -> Step {
        let k = found.unknown.vehicle();
        step(
            format!("speed of vehicle {k}, found"),
            format!("s_{k}"),
            formula,
            substitution,
            found.speed,
            "m/s",
            "theory 6",
        )
    }

    /// `None` under a law whose closed form is not written out.
    fn push(&self, line: &ApproachLine) -> Option<Push> {
        let (law, k) = (self.impact.law, self.impact.contact.inverse_mass());
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

    /// du/ds along n and t.
    fn slopes(&self, found: &Found) -> [Step; 2] {
        let (k, slope) = (found.unknown.vehicle(), found.line.slope);
        // u is vehicle 1 relative to vehicle 2.
        let minus = if k == VehicleId::One { "" } else { "−" };
        let turn = format!("({} − {})", angle(self.heading(k)), angle(self.gamma));
        [("n", "cos", slope.normal), ("t", "sin", slope.tangential)].map(|(axis, function, value)| {
            // A number and a minus before it stand in one pair of parentheses.
            let numbers = if minus.is_empty() {
                format!("{function}{turn}")
            } else {
                format!("(−1) · {function}{turn}")
            };
            step(
                format!("du_{axis}/ds"),
                format!("c_{axis}"),
                format!("{minus}{function}(θ_{k} − Γ)"),
                numbers,
                value,
                "",
                "theory 6",
            )
        })
    }

    /// u along n or t at the speed zero.
    fn at_rest(&self, found: &Found, axis: &str, symbol: &str, value: f64) -> Step {
        let k = found.unknown.vehicle();
        let mut motions = self.impact.outcome.before;
        motions[k.index()].velocity = Vector2::new(0.0, 0.0);
        let (formula, numbers) = self.relative(axis, &motions);
        let name = format!("u_{axis} with vehicle {k} at rest");
        step(name, symbol, formula, numbers, value, "m/s", "theory 1")
    }

    /// How u_t goes with the approach speed.
    fn tangential(&self, found: &Found) -> [Step; 3] {
        let line = &found.line;
        let (at_rest, slope, tau) = (line.at_rest, line.slope, line.tangential_slope());
        [
            step(
                "du_t/dx over the approach speed x = −u_n",
                "τ",
                "−c_t/c_n",
                format!("−{} / {}", p(slope.tangential, ""), n(slope.normal, "")),
                tau,
                "",
                "theory 6",
            ),
            self.at_rest(found, "t", "u_t,rest", at_rest.tangential),
            step(
                "u_t where the vehicles just touch, x = 0",
                "u_t0",
                "u_t,rest + u_n0 τ",
                format!("{} + {} · {}", n(at_rest.tangential, "m/s"), n(at_rest.normal, "m/s"), n(tau, "")),
                line.tangential_at_zero_approach(),
                "m/s",
                "theory 6",
            ),
        ]
    }

    /// α, β and c, and the approach speed that solves their quadratic.
    fn approach_speed(&self, found: &Found, quadratic: &Quadratic, push: Push) -> Vec<Step> {
        let Quadratic { alpha, beta, c } = *quadratic;
        let coefficient =
            |symbol: &str, (formula, numbers): (&str, String), value: f64, unit: &'static str| {
                step("P_n = α x + β", symbol, formula, numbers, value, unit, "theory 6")
            };
        let mut steps = vec![coefficient("α", push.alpha, alpha, "kg")];
        steps.extend(push.beta.map(|written| coefficient("β", written, beta, "N·s")));
        let e = self.impact.law.restitution();
        steps.push(step(
            "W_n = ½ (1 − e) x P_n, so α x² + β x = c",
            "c",
            "2 W_n/(1 − e)",
            format!("2 · {} / (1 − {})", n(found.normal_work, "J"), n(e, "")),
            c,
            "J",
            "theory 6",
        ));
        let (beta, alpha, c) = (p(beta, "N·s"), n(alpha, "kg"), n(c, "J"));
        steps.push(step(
            "approach speed",
            "x",
            "[−β + √(β² + 4 α c)]/(2 α)",
            format!("(−{beta} + √({beta}² + 4 · {alpha} · {c})) / (2 · {alpha})"),
            -self.impact.outcome.approach.normal,
            "m/s",
            "theory 6",
        ));
        steps
    }
}
