//! The impulse at C, and the relative velocity that remains.

use pim_core::{Regime, Tangential};

use super::super::{Step, angle, n, p, step};
use super::Collision;

/// P_n and P_t, each in symbols and in numbers.
type Components = [(&'static str, String); 2];

impl Collision<'_> {
    /// e: a number of the file, or between two points of its curve.
    fn restitution(&self) -> Step {
        let e = self.impact.law.restitution();
        let plain = |name: &str| step(name, "e").is(e, "", "input");
        let Some(curve) = self.impact.given_law.curve() else { return plain("coefficient of restitution") };
        let normal = self.impact.outcome.approach.normal;
        let [Some((slow, e_slow)), Some((fast, e_fast))] = curve.around(-normal) else {
            return plain("coefficient of restitution, at the nearer end of its curve");
        };
        step("coefficient of restitution, between two points (a, b) of its curve", "e")
            .equals(
                "e_a + (e_b − e_a) (−u_n − v_a)/(v_b − v_a)",
                format!(
                    "{} + ({} − {}) · (−{} − {}) / ({} − {})",
                    n(e_slow, ""),
                    n(e_fast, ""),
                    n(e_slow, ""),
                    p(normal, "m/s"),
                    n(slow, "m/s"),
                    n(fast, "m/s"),
                    n(slow, "m/s")
                ),
            )
            .is(e, "", "theory 3")
    }

    pub(super) fn impulse(&self) -> Vec<Step> {
        let mut steps = vec![self.restitution()];
        if self.impact.law.has_moment() {
            steps.extend(self.with_moment());
            steps.push(self.ratio());
        } else {
            steps.extend(self.critical_ratio());
            // The two components at once, if the law has a condition on U_t.
            let sliding = self.impact.outcome.regime == Some(Regime::Sliding);
            let components = match self.impact.law.tangential() {
                Tangential::Restitution(e_t) => Some(self.by_restitution(e_t)),
                Tangential::FullOrSliding(_) if !sliding => {
                    Some(self.by_restitution(self.impact.law.restitution()))
                }
                Tangential::VelocityChange(change) => Some(self.by_change(change)),
                Tangential::Critical
                | Tangential::Ratio(_)
                | Tangential::FractionOfCritical(_)
                | Tangential::Friction(_)
                | Tangential::FullOrSliding(_) => None,
            };
            match components {
                Some(components) => {
                    steps.extend(self.components(components));
                    steps.push(self.ratio());
                }
                None => {
                    steps.push(self.ratio_of_law(sliding));
                    steps.extend(self.components(self.by_ratio()));
                }
            }
        }
        steps.extend(self.separation());
        steps
    }

    /// The impulse under a law with three conditions.
    fn with_moment(&self) -> [Step; 3] {
        let outcome = &self.impact.outcome;
        let solved = |name: &str, symbol: &str, value: f64, unit: &'static str| {
            step(name, symbol).is(value, unit, "theory 3")
        };
        [
            solved(
                "normal impulse on vehicle 1, by the law's three conditions",
                "P_n",
                outcome.impulse.normal,
                "N·s",
            ),
            solved("tangential impulse on vehicle 1, likewise", "P_t", outcome.impulse.tangential, "N·s"),
            solved("moment impulse on vehicle 1, likewise", "M", outcome.moment_impulse, "N·m·s"),
        ]
    }

    fn critical_ratio(&self) -> Option<Step> {
        let (e, k, u) =
            (self.impact.law.restitution(), self.impact.contact.inverse_mass(), self.impact.outcome.approach);
        let critical = self.impact.outcome.critical_impulse_ratio?;
        Some(
            step("critical impulse ratio, which ends the sliding", "μ_c")
                .equals(
                    "[(1 + e) u_n k_nt − u_t k_nn]/[u_t k_nt − (1 + e) u_n k_tt]",
                    format!(
                        "((1 + {0}) · {1} · {2} − {3} · {4}) / ({3} · {2} − (1 + {0}) · {1} · {5})",
                        n(e, ""),
                        n(u.normal, "m/s"),
                        n(k.nt, "1/kg"),
                        n(u.tangential, "m/s"),
                        n(k.nn, "1/kg"),
                        n(k.tt, "1/kg")
                    ),
                )
                .is(critical, "", "theory 3"),
        )
    }

    /// P_n and P_t from the conditions of the law.
    fn components(&self, [normal, along]: Components) -> [Step; 2] {
        let impulse = self.impact.outcome.impulse;
        [("normal", "P_n", normal, impulse.normal), ("tangential", "P_t", along, impulse.tangential)].map(
            |(axis, symbol, (formula, numbers), value)| {
                let name = format!("{axis} impulse on vehicle 1");
                step(name, symbol).equals(formula, numbers).is(value, "N·s", "theory 3")
            },
        )
    }

    /// U_n = −e u_n and U_t = −e_t u_t.
    fn by_restitution(&self, e_t: f64) -> Components {
        let (k, u) = (self.impact.contact.inverse_mass(), self.impact.outcome.approach);
        let (e, e_t) = (n(self.impact.law.restitution(), ""), n(e_t, ""));
        let (u_n, u_t) = (n(u.normal, "m/s"), n(u.tangential, "m/s"));
        let [nn, nt, tt] = [k.nn, k.nt, k.tt].map(|entry| n(entry, "1/kg"));
        let det = n(k.determinant(), "1/kg²");
        [
            (
                "[(1 + e_t) u_t k_nt − (1 + e) u_n k_tt]/det K",
                format!("((1 + {e_t}) · {u_t} · {nt} − (1 + {e}) · {u_n} · {tt}) / {det}"),
            ),
            (
                "[(1 + e) u_n k_nt − (1 + e_t) u_t k_nn]/det K",
                format!("((1 + {e}) · {u_n} · {nt} − (1 + {e_t}) · {u_t} · {nn}) / {det}"),
            ),
        ]
    }

    /// U_n = −e u_n and U_t − u_t as given.
    fn by_change(&self, change: f64) -> Components {
        let k = self.impact.contact.inverse_mass();
        let (e, u_n) = (n(self.impact.law.restitution(), ""), n(self.impact.outcome.approach.normal, "m/s"));
        let (change, det) = (n(change, "m/s"), n(k.determinant(), "1/kg²"));
        let [nn, nt, tt] = [k.nn, k.nt, k.tt].map(|entry| n(entry, "1/kg"));
        [
            (
                "[−(1 + e) u_n k_tt − k_nt (U_t − u_t)]/det K",
                format!("((−1) · (1 + {e}) · {u_n} · {tt} − {nt} · {change}) / {det}"),
            ),
            (
                "[k_nn (U_t − u_t) + (1 + e) u_n k_nt]/det K",
                format!("({nn} · {change} + (1 + {e}) · {u_n} · {nt}) / {det}"),
            ),
        ]
    }

    /// U_n = −e u_n and P_t = μ P_n.
    fn by_ratio(&self) -> Components {
        let (k, outcome) = (self.impact.contact.inverse_mass(), &self.impact.outcome);
        let mu = n(outcome.impulse_ratio, "");
        let normal = format!(
            "(−1) · (1 + {}) · {} / ({} + {mu} · {})",
            n(self.impact.law.restitution(), ""),
            n(outcome.approach.normal, "m/s"),
            n(k.nn, "1/kg"),
            n(k.nt, "1/kg")
        );
        [
            ("−(1 + e) u_n/(k_nn + μ k_nt)", normal),
            ("μ P_n", format!("{mu} · {}", n(outcome.impulse.normal, "N·s"))),
        ]
    }

    /// μ under a law that gives it, or its limit.
    fn ratio_of_law(&self, sliding: bool) -> Step {
        let outcome = &self.impact.outcome;
        // Without sliding that a push can end there is no μ_c, and no tangential impulse.
        let critical =
            outcome.critical_impulse_ratio.map_or_else(|| "none".to_owned(), |critical| n(critical, ""));
        let (formula, numbers) = match self.impact.law.tangential() {
            Tangential::FractionOfCritical(f) => ("f μ_c", format!("{} · {critical}", n(f, ""))),
            Tangential::Friction(_) | Tangential::FullOrSliding(_) if sliding => ("", String::new()),
            Tangential::Ratio(_) => ("", String::new()),
            _ => ("μ_c", critical),
        };
        let name =
            if sliding { "impulse ratio: the friction limit, against the sliding" } else { "impulse ratio" };
        step(name, "μ").equals(formula, numbers).is(outcome.impulse_ratio, "", "theory 3")
    }

    fn ratio(&self) -> Step {
        let outcome = &self.impact.outcome;
        let p_ = outcome.impulse;
        step("impulse ratio", "μ")
            .equals("P_t/P_n", format!("{} / {}", n(p_.tangential, "N·s"), n(p_.normal, "N·s")))
            .is(outcome.impulse_ratio, "", "theory 3")
    }

    fn separation(&self) -> Vec<Step> {
        let (impact, outcome) = (self.impact, &self.impact.outcome);
        let (k, u, p_, after) =
            (impact.contact.inverse_mass(), outcome.approach, outcome.impulse, outcome.separation);
        let moment = |coefficient: f64, name: &str| {
            if impact.law.has_moment() {
                (
                    format!(" + {name} M"),
                    format!(" + {} · {}", n(coefficient, "1/(kg·m)"), n(outcome.moment_impulse, "N·m·s")),
                )
            } else {
                (String::new(), String::new())
            }
        };
        let row = |axis: &str,
                   before: f64,
                   [along_n, along_t]: [f64; 2],
                   names: [&str; 2],
                   (formula, numbers): (String, String),
                   value: f64| {
            step(format!("relative velocity at C along {axis}, after"), format!("U_{axis}"))
                .equals(
                    format!("u_{axis} + {} P_n + {} P_t{formula}", names[0], names[1]),
                    format!(
                        "{} + {} · {} + {} · {}{numbers}",
                        n(before, "m/s"),
                        n(along_n, "1/kg"),
                        n(p_.normal, "N·s"),
                        n(along_t, "1/kg"),
                        n(p_.tangential, "N·s")
                    ),
                )
                .is(value, "m/s", "theory 2")
        };
        vec![
            row("n", u.normal, [k.nn, k.nt], ["k_nn", "k_nt"], moment(k.nm, "k_nm"), after.normal),
            row("t", u.tangential, [k.nt, k.tt], ["k_nt", "k_tt"], moment(k.tm, "k_tm"), after.tangential),
        ]
    }

    pub(super) fn impulse_in_scene(&self) -> Vec<Step> {
        let (outcome, gamma) = (&self.impact.outcome, self.gamma);
        let (p_, vector) = (outcome.impulse, outcome.impulse_vector);
        let row = |axis: &str, sign: char, [of_normal, of_tangential]: [&str; 2], value: f64| {
            step(format!("impulse on vehicle 1 along {axis}"), format!("P_{axis}"))
                .equals(
                    format!("P_n {of_normal} Γ {sign} P_t {of_tangential} Γ"),
                    format!(
                        "{} · {of_normal}{2} {sign} {} · {of_tangential}{2}",
                        n(p_.normal, "N·s"),
                        n(p_.tangential, "N·s"),
                        angle(gamma)
                    ),
                )
                .is(value, "N·s", "theory 1")
        };
        vec![row("x", '−', ["cos", "sin"], vector.x), row("y", '+', ["sin", "cos"], vector.y)]
    }
}
