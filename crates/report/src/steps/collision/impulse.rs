//! The impulse at C, and the relative velocity that remains.

use pim_core::{Regime, Tangential};

use super::super::numbers::Known;
use super::super::{Draft, n, step};
use super::Collision;

/// P_n and P_t under a law's condition, and symbols of that law.
type Components = ([&'static str; 2], Known);

impl Collision<'_> {
    /// e: a number of the file, or between two points of its curve.
    fn restitution(&self) -> Draft {
        let of = |name: &str, source: &'static str| {
            let e = (self.impact.law.restitution(), "");
            step(format!("coefficient of restitution{name}"), "e", e, source)
        };
        let Some(curve) = self.impact.given_law.curve() else { return of("", "input") };
        let normal = self.impact.outcome.approach.normal;
        let [Some((slow, e_slow)), Some((fast, e_fast))] = curve.around(-normal) else {
            return of(", at the nearer end of its curve", "input");
        };
        of(", between two points (a, b) of its curve", "theory 3")
            .equals("e_a + (e_b − e_a) (−u_n − v_a)/(v_b − v_a)")
            .with([
                ("e_a", n(e_slow, "")),
                ("e_b", n(e_fast, "")),
                ("v_a", n(slow, "m/s")),
                ("v_b", n(fast, "m/s")),
            ])
    }

    pub(super) fn impulse(&self) -> Vec<Draft> {
        let mut steps = vec![self.restitution()];
        if self.impact.law.has_moment() {
            steps.extend(self.with_moment());
            steps.push(self.ratio());
        } else {
            steps.extend(self.critical_ratio());
            // The two components at once, if the law has a condition on U_t.
            let sliding = self.impact.outcome.regime == Some(Regime::Sliding);
            let components = match self.impact.law.tangential() {
                Tangential::Restitution(e_t) => Some(by_restitution(e_t)),
                Tangential::FullOrSliding(_) if !sliding => {
                    Some(by_restitution(self.impact.law.restitution()))
                }
                // U_n = −e u_n and U_t − u_t as given.
                Tangential::VelocityChange(change) => Some((
                    [
                        "[−(1 + e) u_n k_tt − k_nt (U_t − u_t)]/det K",
                        "[k_nn (U_t − u_t) + (1 + e) u_n k_nt]/det K",
                    ],
                    vec![("U_t − u_t".to_owned(), n(change, "m/s"))],
                )),
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
                    // U_n = −e u_n and P_t = μ P_n.
                    let by_ratio = ["−(1 + e) u_n/(k_nn + μ k_nt)", "μ P_n"];
                    steps.extend(self.components((by_ratio, Known::new())));
                }
            }
        }
        steps.extend(self.separation());
        steps
    }

    /// The impulse under a law with three conditions.
    fn with_moment(&self) -> [Draft; 3] {
        let outcome = &self.impact.outcome;
        [
            (
                "normal impulse on vehicle 1, by the law's three conditions",
                "P_n",
                outcome.impulse.normal,
                "N·s",
            ),
            ("tangential impulse on vehicle 1, likewise", "P_t", outcome.impulse.tangential, "N·s"),
            ("moment impulse on vehicle 1, likewise", "M", outcome.moment_impulse, "N·m·s"),
        ]
        .map(|(name, symbol, value, unit)| step(name, symbol, (value, unit), "theory 3"))
    }

    fn critical_ratio(&self) -> Option<Draft> {
        let critical = self.impact.outcome.critical_impulse_ratio?;
        Some(
            step("critical impulse ratio, which ends the sliding", "μ_c", (critical, ""), "theory 3")
                .equals("[(1 + e) u_n k_nt − u_t k_nn]/[u_t k_nt − (1 + e) u_n k_tt]"),
        )
    }

    /// P_n and P_t from the conditions of the law.
    fn components(&self, ([normal, along], own): Components) -> [Draft; 2] {
        let impulse = self.impact.outcome.impulse;
        [("normal", "P_n", normal, impulse.normal), ("tangential", "P_t", along, impulse.tangential)].map(
            |(axis, symbol, formula, value)| {
                let name = format!("{axis} impulse on vehicle 1");
                step(name, symbol, (value, "N·s"), "theory 3").equals(formula).with(own.clone())
            },
        )
    }

    /// μ under a law that gives it, or its limit.
    fn ratio_of_law(&self, sliding: bool) -> Draft {
        let outcome = &self.impact.outcome;
        let mut own = None;
        let formula = match self.impact.law.tangential() {
            // Without sliding that a push can end there is no μ_c, and no tangential impulse.
            _ if outcome.critical_impulse_ratio.is_none() => "",
            Tangential::FractionOfCritical(f) => {
                own = Some(("f", n(f, "")));
                "f μ_c"
            }
            Tangential::Friction(_) | Tangential::FullOrSliding(_) if sliding => "",
            Tangential::Ratio(_) => "",
            _ => "μ_c",
        };
        let name =
            if sliding { "impulse ratio: the friction limit, against the sliding" } else { "impulse ratio" };
        step(name, "μ", (outcome.impulse_ratio, ""), "theory 3").equals(formula).with(own)
    }

    fn ratio(&self) -> Draft {
        let ratio = (self.impact.outcome.impulse_ratio, "");
        step("impulse ratio", "μ", ratio, "theory 3").equals("P_t/P_n")
    }

    fn separation(&self) -> [Draft; 2] {
        let (has_moment, after) = (self.impact.law.has_moment(), self.impact.outcome.separation);
        [("n", "k_nn P_n + k_nt P_t", after.normal), ("t", "k_nt P_n + k_tt P_t", after.tangential)].map(
            |(axis, push, value)| {
                let moment = if has_moment { format!(" + k_{axis}m M") } else { String::new() };
                let name = format!("relative velocity at C along {axis}, after");
                step(name, format!("U_{axis}"), (value, "m/s"), "theory 2")
                    .equals(format!("u_{axis} + {push}{moment}"))
            },
        )
    }

    pub(super) fn impulse_in_scene(&self) -> Vec<Draft> {
        let vector = self.impact.outcome.impulse_vector;
        [("x", "P_n cos Γ − P_t sin Γ", vector.x), ("y", "P_n sin Γ + P_t cos Γ", vector.y)]
            .map(|(axis, formula, value)| {
                let name = format!("impulse on vehicle 1 along {axis}");
                step(name, format!("P_{axis}"), (value, "N·s"), "theory 1").equals(formula)
            })
            .into()
    }
}

/// U_n = −e u_n and U_t = −e_t u_t.
fn by_restitution(e_t: f64) -> Components {
    (
        ["[(1 + e_t) u_t k_nt − (1 + e) u_n k_tt]/det K", "[(1 + e) u_n k_nt − (1 + e_t) u_t k_nn]/det K"],
        vec![("e_t".to_owned(), n(e_t, ""))],
    )
}
