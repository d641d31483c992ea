//! Geometry, speed, impulse, motion and energy.

use analysis::{Analysis, Found, Impact};
use case::{Axes, Case, ContactPoint, Restitution, Velocity};
use pim_core::{NormalTangential, Real, Regime, Tangential};

use super::{Step, StepGroup, angle, given, group, n, p, step};
use crate::axes;

/// The numbers that most steps share.
struct Collision<'a> {
    case: &'a Case,
    analysis: &'a Analysis,
    impact: &'a Impact,
    /// (rad) scene angle of n, oriented from vehicle 2 to vehicle 1.
    gamma: f64,
    /// (kg, kg·m²) of each vehicle that can move.
    inertia: [Option<(f64, f64)>; 2],
}

pub(super) fn groups(case: &Case, analysis: &Analysis) -> Vec<StepGroup> {
    let Some(impact) = &analysis.impact else { return Vec::new() };
    let normal = impact.contact.normal();
    let collision = Collision {
        case,
        analysis,
        impact,
        gamma: Real::atan2(normal.y, normal.x),
        inertia: [0, 1].map(|i| analysis.vehicles[i].subject.inertia.map(|v| (v.mass, v.yaw_inertia))),
    };
    vec![
        group("Geometry", collision.geometry()),
        group("Contact inverse mass", collision.inverse_mass()),
        group("Speed", analysis.found.as_ref().map_or_else(Vec::new, |found| collision.speed(found))),
        group("Approach", collision.approach()),
        group("Impulse", collision.impulse()),
        group("Impulse in the scene", collision.impulse_in_scene()),
        group("Motion of vehicle 1 after impact", collision.motion(0)),
        group("Motion of vehicle 2 after impact", collision.motion(1)),
        group("Energy balance", collision.energy()),
    ]
}

impl Collision<'_> {
    fn moving(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        self.inertia.iter().enumerate().filter_map(|(i, v)| v.map(|(m, inertia)| (i, m, inertia)))
    }

    /// (rad)
    fn heading(&self, i: usize) -> f64 {
        self.case.vehicles[i].heading.as_ref().map_or(0.0, case::Quantity::si)
    }

    fn geometry(&self) -> Vec<Step> {
        let mut steps = Vec::new();
        let stated = self.case.impact.as_ref().map_or(0.0, |impact| impact.crush_plane.si());
        let (gamma, n_) = (self.gamma, self.impact.contact.normal());
        let turned = (stated.sin_cos_f64().1 * n_.x + stated.sin_cos_f64().0 * n_.y) < 0.0;
        let mut direction =
            given("direction of n, from vehicle 2 to vehicle 1", "Γ", gamma.to_degrees(), "°", "theory 1");
        if turned {
            direction.name.push_str(" (the file's crush plane, turned by 180°)");
        }
        steps.push(direction);
        for i in [0, 1] {
            let vehicle = &self.case.vehicles[i];
            let Some(contact) = &vehicle.contact else { continue };
            let k = i + 1;
            let [forward, aside] = contact.xy();
            if let ContactPoint::Polar { distance, angle: phi } = contact {
                let (d, phi) = (distance.si(), phi.si());
                steps.push(step(
                    format!("contact point forward of CG {k}"),
                    format!("x_{k}"),
                    format!("d_{k} cos φ_{k}"),
                    format!("{} · cos{}", n(d, "m"), angle(phi)),
                    forward,
                    "m",
                    "theory 1",
                ));
                steps.push(step(
                    format!("contact point {} of CG {k}", axes::side_of_y(self.case.axes)),
                    format!("y_{k}"),
                    format!("d_{k} sin φ_{k}"),
                    format!("{} · sin{}", n(d, "m"), angle(phi)),
                    aside,
                    "m",
                    "theory 1",
                ));
            }
            let theta = self.heading(i);
            let arm = self.impact.contact.arms()[i];
            let turn = format!("({}\u{a0}° − {})", super::digits(theta.to_degrees()), angle(gamma));
            steps.push(step(
                format!("arm of vehicle {k} along n"),
                format!("r_{k}n"),
                format!("x_{k} cos(θ_{k} − Γ) − y_{k} sin(θ_{k} − Γ)"),
                format!("{} · cos{turn} − {} · sin{turn}", n(forward, "m"), n(aside, "m")),
                arm.normal,
                "m",
                "Eq 2",
            ));
            steps.push(step(
                format!("arm of vehicle {k} along t"),
                format!("r_{k}t"),
                format!("x_{k} sin(θ_{k} − Γ) + y_{k} cos(θ_{k} − Γ)"),
                format!("{} · sin{turn} + {} · cos{turn}", n(forward, "m"), n(aside, "m")),
                arm.tangential,
                "m",
                "Eq 2",
            ));
        }
        steps
    }

    /// A sum over the vehicles that can move, in symbols and in numbers.
    fn sum(
        &self,
        symbols: &dyn Fn(usize) -> String,
        numbers: &dyn Fn(usize, f64, f64) -> String,
    ) -> (String, String) {
        let formula: Vec<String> = self.moving().map(|(i, ..)| symbols(i + 1)).collect();
        let substitution: Vec<String> = self.moving().map(|(i, m, inertia)| numbers(i, m, inertia)).collect();
        (formula.join(" + "), substitution.join(" + "))
    }

    fn inverse_mass(&self) -> Vec<Step> {
        let k = self.impact.contact.inverse_mass();
        let arms = self.impact.contact.arms();
        let mut steps = Vec::new();
        let mut push =
            |symbol: &str, (formula, substitution): (String, String), value: f64, unit: &'static str| {
                steps.push(step("", symbol, formula, substitution, value, unit, "theory 2"));
            };
        push(
            "k_nn",
            self.sum(&|i| format!("1/m_{i} + r_{i}t²/I_{i}"), &|i, m, inertia| {
                format!("1 / {} + {}² / {}", n(m, "kg"), p(arms[i].tangential, "m"), n(inertia, "kg·m²"))
            }),
            k.nn,
            "1/kg",
        );
        push(
            "k_nt",
            self.sum(&|i| format!("(−r_{i}n r_{i}t)/I_{i}"), &|i, _, inertia| {
                format!(
                    "(−{} · {}) / {}",
                    p(arms[i].normal, "m"),
                    n(arms[i].tangential, "m"),
                    n(inertia, "kg·m²")
                )
            }),
            k.nt,
            "1/kg",
        );
        push(
            "k_tt",
            self.sum(&|i| format!("1/m_{i} + r_{i}n²/I_{i}"), &|i, m, inertia| {
                format!("1 / {} + {}² / {}", n(m, "kg"), p(arms[i].normal, "m"), n(inertia, "kg·m²"))
            }),
            k.tt,
            "1/kg",
        );
        if self.impact.law.has_moment() {
            push(
                "k_nm",
                self.sum(&|i| format!("(−r_{i}t)/I_{i}"), &|i, _, inertia| {
                    format!("(−{}) / {}", p(arms[i].tangential, "m"), n(inertia, "kg·m²"))
                }),
                k.nm,
                "1/(kg·m)",
            );
            push(
                "k_tm",
                self.sum(&|i| format!("r_{i}n/I_{i}"), &|i, _, inertia| {
                    format!("{} / {}", n(arms[i].normal, "m"), n(inertia, "kg·m²"))
                }),
                k.tm,
                "1/(kg·m)",
            );
        }
        let det = k.determinant();
        steps.push(step(
            "determinant of K",
            "det K",
            "k_nn k_tt − k_nt²",
            format!("{} · {} − {}²", n(k.nn, "1/kg"), n(k.tt, "1/kg"), p(k.nt, "1/kg")),
            det,
            "1/kg²",
            "theory 2",
        ));
        for step in &mut steps {
            if step.name.is_empty() {
                step.name = "inverse mass at C".to_owned();
            }
        }
        steps
    }

    /// e_t of the laws of which W_n is a quadratic in the speed and that are solved here: U_t = −e_t u_t.
    fn tangential_restitution(&self) -> Option<f64> {
        if self.impact.law.has_moment() {
            return None;
        }
        match self.impact.law.tangential() {
            Tangential::Critical => Some(0.0),
            Tangential::Restitution(e_t) => Some(e_t),
            _ => None,
        }
    }

    /// The speed found: in closed form where the reader can follow that, else as what the work of the normal impulse below confirms.
    fn speed(&self, found: &Found) -> Vec<Step> {
        let vehicle = found.unknown.index();
        let k = vehicle + 1;
        let sign = if vehicle == 0 { 1.0 } else { -1.0 };
        let (impact, gamma) = (self.impact, self.gamma);
        let theta = self.heading(vehicle);
        let forward = impact.contact.resolve(impact.contact.participants()[vehicle].forward());
        let slope = NormalTangential { normal: sign * forward.normal, tangential: sign * forward.tangential };
        let mut motions = impact.outcome.before;
        motions[vehicle].velocity = pim_core::Vector2::new(0.0, 0.0);
        let rest = impact.contact.approach(&motions).velocity;
        let x = -impact.outcome.approach.normal;
        let k_matrix = impact.contact.inverse_mass();
        let det = k_matrix.determinant();
        let e = impact.law.restitution();
        let solved = |formula: &str, substitution: String| {
            step(
                format!("speed of vehicle {k}, found"),
                format!("s_{k}"),
                formula,
                substitution,
                found.speed,
                "m/s",
                "theory 6",
            )
        };
        let closed = found.iterations.is_none() && found.admissible.len() == 1 && self.curve().is_none();
        let (alpha, beta, alpha_formula, alpha_numbers, beta_formula, beta_numbers);
        let tau = -slope.tangential / slope.normal;
        let at_touch = rest.tangential + rest.normal * tau;
        match (closed, self.tangential_restitution(), impact.law.tangential()) {
            (true, Some(e_t), _) => {
                // P_n = [k_tt (1+e) x + k_nt (1+e_t) u_t]/det K with u_t = u_t(0) + τ x
                alpha = (k_matrix.tt * (1.0 + e) + k_matrix.nt * (1.0 + e_t) * tau) / det;
                beta = k_matrix.nt * (1.0 + e_t) * at_touch / det;
                alpha_formula = "[k_tt (1 + e) + k_nt (1 + e_t) τ]/det K";
                alpha_numbers = format!(
                    "({} · (1 + {}) + {} · (1 + {}) · {}) / {}",
                    n(k_matrix.tt, "1/kg"),
                    n(e, ""),
                    n(k_matrix.nt, "1/kg"),
                    n(e_t, ""),
                    n(tau, ""),
                    n(det, "1/kg²")
                );
                beta_formula = "k_nt (1 + e_t) u_t0/det K";
                beta_numbers = format!(
                    "{} · (1 + {}) · {} / {}",
                    n(k_matrix.nt, "1/kg"),
                    n(e_t, ""),
                    n(at_touch, "m/s"),
                    n(det, "1/kg²")
                );
            }
            (true, None, Tangential::Ratio(mu)) if !impact.law.has_moment() => {
                // P_n = (1+e) x/(k_nn + μ k_nt)
                alpha = (1.0 + e) / (k_matrix.nn + mu * k_matrix.nt);
                beta = 0.0;
                alpha_formula = "(1 + e)/(k_nn + μ k_nt)";
                alpha_numbers = format!(
                    "(1 + {}) / ({} + {} · {})",
                    n(e, ""),
                    n(k_matrix.nn, "1/kg"),
                    n(mu, ""),
                    n(k_matrix.nt, "1/kg")
                );
                beta_formula = "";
                beta_numbers = String::new();
            }
            _ => {
                return vec![solved("", String::new())];
            }
        }
        // Of two approaches that give the energy, the paper's is the one that this sign gives: α > 0.
        if alpha <= 0.0 {
            return vec![solved("", String::new())];
        }
        let (sine, minus) = (angle(theta), if vehicle == 0 { "" } else { "−" });
        let turn = format!("({} − {})", sine, angle(gamma));
        // A number and a minus before it stand in one pair of parentheses.
        let signed = |function: &str| {
            if minus.is_empty() { format!("{function}{turn}") } else { format!("(−1) · {function}{turn}") }
        };
        let at_rest = |axis: &str, symbol: &str, value: f64| {
            let (formula, numbers) = self.relative(axis, &motions);
            let name = format!("u_{axis} with vehicle {k} at rest");
            step(name, symbol, formula, numbers, value, "m/s", "theory 1")
        };
        let mut steps = vec![
            step(
                "du_n/ds",
                "c_n",
                format!("{minus}cos(θ_{k} − Γ)"),
                signed("cos"),
                slope.normal,
                "",
                "theory 6",
            ),
            step(
                "du_t/ds",
                "c_t",
                format!("{minus}sin(θ_{k} − Γ)"),
                signed("sin"),
                slope.tangential,
                "",
                "theory 6",
            ),
            at_rest("n", "u_n0", rest.normal),
        ];
        let beta_step = !beta_formula.is_empty();
        if beta_step {
            steps.push(step(
                "du_t/dx over the approach speed x = −u_n",
                "τ",
                "−c_t/c_n",
                format!("−{} / {}", p(slope.tangential, ""), n(slope.normal, "")),
                tau,
                "",
                "theory 6",
            ));
            steps.push(at_rest("t", "u_t,rest", rest.tangential));
            steps.push(step(
                "u_t where the vehicles just touch, x = 0",
                "u_t0",
                "u_t,rest + u_n0 τ",
                format!("{} + {} · {}", n(rest.tangential, "m/s"), n(rest.normal, "m/s"), n(tau, "")),
                at_touch,
                "m/s",
                "theory 6",
            ));
        }
        steps.push(step("P_n = α x + β", "α", alpha_formula, alpha_numbers, alpha, "kg", "theory 6"));
        if beta_step {
            steps.push(step("P_n = α x + β", "β", beta_formula, beta_numbers, beta, "N·s", "theory 6"));
        }
        // c = 2 W_n/(1−e)
        let c = 2.0 * found.normal_work / (1.0 - e);
        steps.push(step(
            "W_n = ½ (1 − e) x P_n, so α x² + β x = c",
            "c",
            "2 W_n/(1 − e)",
            format!("2 · {} / (1 − {})", n(found.normal_work, "J"), n(e, "")),
            c,
            "J",
            "theory 6",
        ));
        steps.push(step(
            "approach speed",
            "x",
            "[−β + √(β² + 4 α c)]/(2 α)",
            format!(
                "(−{0} + √({0}² + 4 · {1} · {2})) / (2 · {1})",
                p(beta, "N·s"),
                n(alpha, "kg"),
                n(c, "J")
            ),
            x,
            "m/s",
            "theory 6",
        ));
        steps.push(solved(
            "−(x + u_n0)/c_n",
            format!("−({} + {}) / {}", n(x, "m/s"), n(rest.normal, "m/s"), n(slope.normal, "")),
        ));
        steps
    }

    /// (m/s, –) the points of e over the closing speed, where the file gives a curve.
    fn curve(&self) -> Option<Vec<[f64; 2]>> {
        match self.case.impact.as_ref()?.law.restitution()? {
            Restitution::Constant(_) => None,
            Restitution::OfClosingSpeed { speeds, values } => {
                Some(speeds.iter().zip(values).map(|(speed, &e)| [speed.si(), e]).collect())
            }
        }
    }

    /// e: a number of the file, or between two points of its curve.
    fn restitution(&self) -> Step {
        let e = self.impact.law.restitution();
        let plain = |name: &str| given(name, "e", e, "", "input");
        let Some(points) = self.curve() else { return plain("coefficient of restitution") };
        let normal = self.impact.outcome.approach.normal;
        let around = points.windows(2).find(|pair| (pair[0][0]..pair[1][0]).contains(&-normal));
        let Some(&[[slow, e_slow], [fast, e_fast]]) = around else {
            return plain("coefficient of restitution, of the nearer end of its curve");
        };
        step(
            "coefficient of restitution, between two points (a, b) of its curve",
            "e",
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
            e,
            "",
            "theory 3",
        )
    }

    fn approach(&self) -> Vec<Step> {
        let outcome = &self.impact.outcome;
        let u = outcome.approach;
        let mut steps = Vec::new();
        let found = self.analysis.found.as_ref();
        for (i, ..) in self.moving() {
            let k = i + 1;
            let v = outcome.before[i].velocity;
            let speed = match (found, &self.case.vehicles[i].motion) {
                (Some(found), _) if found.unknown.index() == i => Some(found.speed),
                (_, Some(Velocity::Speed(speed))) => Some(speed.si()),
                _ => None,
            };
            let theta = angle(self.heading(i));
            for (axis, function, value) in [("x", "cos", v.x), ("y", "sin", v.y)] {
                let (name, symbol) =
                    (format!("velocity of vehicle {k} along {axis}"), format!("v_{k}{axis}"));
                steps.push(match speed {
                    Some(s) => step(
                        name,
                        symbol,
                        format!("s_{k} {function} θ_{k}"),
                        format!("{} · {function}{theta}", n(s, "m/s")),
                        value,
                        "m/s",
                        "theory 1",
                    ),
                    None => given(name, symbol, value, "m/s", "input"),
                });
            }
            if outcome.before[i].yaw_rate != 0.0 {
                steps.push(given(
                    format!("yaw rate of vehicle {k}"),
                    format!("ω_{k}"),
                    outcome.before[i].yaw_rate,
                    "rad/s",
                    "input",
                ));
            }
        }
        for (axis, value) in [("n", u.normal), ("t", u.tangential)] {
            let (formula, numbers) = self.relative(axis, &outcome.before);
            let name = format!("relative velocity at C along {axis}");
            steps.push(step(name, format!("u_{axis}"), formula, numbers, value, "m/s", "theory 1"));
        }
        steps
    }

    /// The velocity of vehicle 1 relative to vehicle 2 at C along n or t, in symbols and in numbers.
    fn relative(&self, axis: &str, motions: &[pim_core::Motion<f64>; 2]) -> (String, String) {
        let (gamma, arms) = (angle(self.gamma), self.impact.contact.arms());
        let (mut formula, mut numbers) = (String::new(), String::new());
        for (i, ..) in self.moving() {
            let (k, v, omega) = (i + 1, motions[i].velocity, motions[i].yaw_rate);
            let (x, y) = (n(v.x, "m/s"), n(v.y, "m/s"));
            let (symbols, along, turning) = match axis {
                "n" => (
                    format!("(v_{k}x cos Γ + v_{k}y sin Γ − ω_{k} r_{k}t)"),
                    format!("{x} · cos{gamma} + {y} · sin{gamma}"),
                    format!(" − {} · {}", n(omega, "rad/s"), n(arms[i].tangential, "m")),
                ),
                _ => (
                    format!("(v_{k}y cos Γ − v_{k}x sin Γ + ω_{k} r_{k}n)"),
                    format!("{y} · cos{gamma} − {x} · sin{gamma}"),
                    format!(" + {} · {}", n(omega, "rad/s"), n(arms[i].normal, "m")),
                ),
            };
            let turning = if omega == 0.0 { "" } else { &turning };
            // u is vehicle 1 relative to vehicle 2.
            let lead = match (i, numbers.is_empty()) {
                (0, _) => "",
                (_, true) => "−",
                (_, false) => " − ",
            };
            formula.push_str(&format!("{lead}{symbols}"));
            numbers.push_str(&format!("{lead}({along}{turning})"));
        }
        (formula, numbers)
    }

    fn impulse(&self) -> Vec<Step> {
        let (impact, outcome) = (self.impact, &self.impact.outcome);
        let (k, u, p_) = (impact.contact.inverse_mass(), outcome.approach, outcome.impulse);
        let (e, mu, det) = (impact.law.restitution(), outcome.impulse_ratio, k.determinant());
        let mut steps = vec![self.restitution()];
        if impact.law.has_moment() {
            steps.push(given(
                "normal impulse on vehicle 1, by the law's three conditions",
                "P_n",
                p_.normal,
                "N·s",
                "theory 3",
            ));
            steps.push(given(
                "tangential impulse on vehicle 1, likewise",
                "P_t",
                p_.tangential,
                "N·s",
                "theory 3",
            ));
            steps.push(given(
                "moment impulse on vehicle 1, likewise",
                "M",
                outcome.moment_impulse,
                "N·m·s",
                "theory 3",
            ));
            steps.push(self.ratio());
            steps.extend(self.separation());
            return steps;
        }
        let tangential = impact.law.tangential();
        let sliding = outcome.regime == Some(Regime::Sliding);
        let e_t = match tangential {
            Tangential::Restitution(e_t) => Some(e_t),
            Tangential::FullOrSliding(_) if !sliding => Some(e),
            _ => None,
        };
        if let Some(critical) = outcome.critical_impulse_ratio {
            steps.push(step(
                "critical impulse ratio, which ends the sliding",
                "μ_c",
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
                critical,
                "",
                "theory 3",
            ));
        }
        // The two components at once, where the law has a condition on U_t.
        let pair = match (tangential, e_t) {
            (_, Some(e_t)) => Some((
                "[(1 + e_t) u_t k_nt − (1 + e) u_n k_tt]/det K",
                format!(
                    "((1 + {}) · {} · {} − (1 + {}) · {} · {}) / {}",
                    n(e_t, ""),
                    n(u.tangential, "m/s"),
                    n(k.nt, "1/kg"),
                    n(e, ""),
                    n(u.normal, "m/s"),
                    n(k.tt, "1/kg"),
                    n(det, "1/kg²")
                ),
                "[(1 + e) u_n k_nt − (1 + e_t) u_t k_nn]/det K",
                format!(
                    "((1 + {}) · {} · {} − (1 + {}) · {} · {}) / {}",
                    n(e, ""),
                    n(u.normal, "m/s"),
                    n(k.nt, "1/kg"),
                    n(e_t, ""),
                    n(u.tangential, "m/s"),
                    n(k.nn, "1/kg"),
                    n(det, "1/kg²")
                ),
            )),
            (Tangential::VelocityChange(change), None) => Some((
                "[−(1 + e) u_n k_tt − k_nt (U_t − u_t)]/det K",
                format!(
                    "((−1) · (1 + {}) · {} · {} − {} · {}) / {}",
                    n(e, ""),
                    n(u.normal, "m/s"),
                    n(k.tt, "1/kg"),
                    n(k.nt, "1/kg"),
                    n(change, "m/s"),
                    n(det, "1/kg²")
                ),
                "[k_nn (U_t − u_t) + (1 + e) u_n k_nt]/det K",
                format!(
                    "({} · {} + (1 + {}) · {} · {}) / {}",
                    n(k.nn, "1/kg"),
                    n(change, "m/s"),
                    n(e, ""),
                    n(u.normal, "m/s"),
                    n(k.nt, "1/kg"),
                    n(det, "1/kg²")
                ),
            )),
            _ => None,
        };
        if let Some((normal, normal_numbers, along, along_numbers)) = pair {
            steps.push(step(
                "normal impulse on vehicle 1",
                "P_n",
                normal,
                normal_numbers,
                p_.normal,
                "N·s",
                "theory 3",
            ));
            steps.push(step(
                "tangential impulse on vehicle 1",
                "P_t",
                along,
                along_numbers,
                p_.tangential,
                "N·s",
                "theory 3",
            ));
            steps.push(self.ratio());
        } else {
            let critical = outcome.critical_impulse_ratio.unwrap_or(f64::NAN);
            let (formula, numbers) = match tangential {
                Tangential::FractionOfCritical(f) => ("f μ_c", format!("{} · {}", n(f, ""), n(critical, ""))),
                Tangential::Friction(_) | Tangential::FullOrSliding(_) if sliding => ("", String::new()),
                Tangential::Ratio(_) => ("", String::new()),
                _ => ("μ_c", n(critical, "")),
            };
            let name = if sliding {
                "impulse ratio: the friction limit, against the sliding"
            } else {
                "impulse ratio"
            };
            steps.push(step(name, "μ", formula, numbers, mu, "", "theory 3"));
            steps.push(step(
                "normal impulse on vehicle 1",
                "P_n",
                "−(1 + e) u_n/(k_nn + μ k_nt)",
                format!(
                    "(−1) · (1 + {}) · {} / ({} + {} · {})",
                    n(e, ""),
                    n(u.normal, "m/s"),
                    n(k.nn, "1/kg"),
                    n(mu, ""),
                    n(k.nt, "1/kg")
                ),
                p_.normal,
                "N·s",
                "theory 3",
            ));
            steps.push(step(
                "tangential impulse on vehicle 1",
                "P_t",
                "μ P_n",
                format!("{} · {}", n(mu, ""), n(p_.normal, "N·s")),
                p_.tangential,
                "N·s",
                "theory 3",
            ));
        }
        steps.extend(self.separation());
        steps
    }

    fn ratio(&self) -> Step {
        let outcome = &self.impact.outcome;
        let p_ = outcome.impulse;
        step(
            "impulse ratio",
            "μ",
            "P_t/P_n",
            format!("{} / {}", n(p_.tangential, "N·s"), n(p_.normal, "N·s")),
            outcome.impulse_ratio,
            "",
            "theory 3",
        )
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
            step(
                format!("relative velocity at C along {axis}, after"),
                format!("U_{axis}"),
                format!("u_{axis} + {} P_n + {} P_t{formula}", names[0], names[1]),
                format!(
                    "{} + {} · {} + {} · {}{numbers}",
                    n(before, "m/s"),
                    n(along_n, "1/kg"),
                    n(p_.normal, "N·s"),
                    n(along_t, "1/kg"),
                    n(p_.tangential, "N·s")
                ),
                value,
                "m/s",
                "theory 2",
            )
        };
        vec![
            row("n", u.normal, [k.nn, k.nt], ["k_nn", "k_nt"], moment(k.nm, "k_nm"), after.normal),
            row("t", u.tangential, [k.nt, k.tt], ["k_nt", "k_tt"], moment(k.tm, "k_tm"), after.tangential),
        ]
    }

    fn impulse_in_scene(&self) -> Vec<Step> {
        let (outcome, gamma) = (&self.impact.outcome, self.gamma);
        let (p_, vector) = (outcome.impulse, outcome.impulse_vector);
        vec![
            step(
                "impulse on vehicle 1 along x",
                "P_x",
                "P_n cos Γ − P_t sin Γ",
                format!(
                    "{} · cos{1} − {2} · sin{1}",
                    n(p_.normal, "N·s"),
                    angle(gamma),
                    n(p_.tangential, "N·s")
                ),
                vector.x,
                "N·s",
                "theory 1",
            ),
            step(
                "impulse on vehicle 1 along y",
                "P_y",
                "P_n sin Γ + P_t cos Γ",
                format!(
                    "{} · sin{1} + {2} · cos{1}",
                    n(p_.normal, "N·s"),
                    angle(gamma),
                    n(p_.tangential, "N·s")
                ),
                vector.y,
                "N·s",
                "theory 1",
            ),
        ]
    }

    fn motion(&self, i: usize) -> Vec<Step> {
        let outcome = &self.impact.outcome;
        let (p_, vector, arms) = (outcome.impulse, outcome.impulse_vector, self.impact.contact.arms());
        let mut steps = Vec::new();
        if let Some((m, inertia)) = self.inertia[i] {
            let k = i + 1;
            let (before, after) = (outcome.before[i], outcome.after[i]);
            let sign = if i == 0 { "+" } else { "−" };
            for (axis, v, impulse, value) in [
                ("x", before.velocity.x, vector.x, after.velocity.x),
                ("y", before.velocity.y, vector.y, after.velocity.y),
            ] {
                steps.push(step(
                    format!("velocity of vehicle {k} along {axis}, after"),
                    format!("V_{k}{axis}"),
                    format!("v_{k}{axis} {sign} P_{axis}/m_{k}"),
                    format!("{} {sign} {} / {}", n(v, "m/s"), n(impulse, "N·s"), n(m, "kg")),
                    value,
                    "m/s",
                    "theory 2",
                ));
            }
            let arm = arms[i];
            let (moment, moment_number) = if outcome.moment_impulse == 0.0 {
                ("", String::new())
            } else {
                (" + M", format!(" + {}", n(outcome.moment_impulse, "N·m·s")))
            };
            steps.push(step(
                format!("yaw rate of vehicle {k}, after"),
                format!("Ω_{k}"),
                format!("ω_{k} {sign} (r_{k}n P_t − r_{k}t P_n{moment})/I_{k}"),
                format!(
                    "{} {sign} ({} · {} − {} · {}{moment_number}) / {}",
                    n(before.yaw_rate, "rad/s"),
                    n(arm.normal, "m"),
                    n(p_.tangential, "N·s"),
                    n(arm.tangential, "m"),
                    n(p_.normal, "N·s"),
                    n(inertia, "kg·m²")
                ),
                after.yaw_rate,
                "rad/s",
                "theory 2",
            ));
            steps.push(step(
                format!("velocity change of vehicle {k}"),
                format!("ΔV_{k}"),
                format!("√(P_x² + P_y²)/m_{k}"),
                format!("√({}² + {}²) / {}", p(vector.x, "N·s"), p(vector.y, "N·s"), n(m, "kg")),
                outcome.delta_v_magnitude()[i],
                "m/s",
                "theory 2",
            ));
            let (theta, x, y) = (angle(self.heading(i)), n(vector.x, "N·s"), n(vector.y, "N·s"));
            // The force on vehicle 2 is −P. A PDOF is clockwise in any axes: what counts is the component to the left, which in z-down axes is −y.
            let (left, left_numbers) = if (i == 0) == (self.case.axes == Axes::ZUp) {
                (format!("P_y cos θ_{k} − P_x sin θ_{k}"), format!("{y} · cos{theta} − {x} · sin{theta}"))
            } else {
                (format!("P_x sin θ_{k} − P_y cos θ_{k}"), format!("{x} · sin{theta} − {y} · cos{theta}"))
            };
            let (behind, behind_numbers) = if i == 0 {
                (
                    format!("−P_x cos θ_{k} − P_y sin θ_{k}"),
                    format!("(−1) · {x} · cos{theta} − {y} · sin{theta}"),
                )
            } else {
                (format!("P_x cos θ_{k} + P_y sin θ_{k}"), format!("{x} · cos{theta} + {y} · sin{theta}"))
            };
            let numbers = format!("atan2({left_numbers}, {behind_numbers})");
            steps.push(step(
                format!("principal direction of force on vehicle {k}, clockwise from its heading"),
                format!("PDOF_{k}"),
                format!("atan2({left}, {behind})"),
                numbers,
                self.impact.pdof[i].to_degrees(),
                "°",
                "theory 4",
            ));
        }
        steps
    }

    fn energy(&self) -> Vec<Step> {
        let outcome = &self.impact.outcome;
        let energy = outcome.energy;
        let kinetic = |name: &str,
                       symbol: &str,
                       letters: [&str; 2],
                       motions: &[pim_core::Motion<f64>; 2],
                       value: f64| {
            let [v, w] = letters;
            let (formula, numbers) = self.sum(
                &|i| format!("½ m_{i} ({v}_{i}x² + {v}_{i}y²) + ½ I_{i} {w}_{i}²"),
                &|i, m, inertia| {
                    let motion = motions[i];
                    format!(
                        "½ · {} · ({}² + {}²) + ½ · {} · {}²",
                        n(m, "kg"),
                        p(motion.velocity.x, "m/s"),
                        p(motion.velocity.y, "m/s"),
                        n(inertia, "kg·m²"),
                        p(motion.yaw_rate, "rad/s")
                    )
                },
            );
            step(name, symbol, formula, numbers, value, "J", "theory 4")
        };
        let work = |name: &str, axis: &str, impulse: f64, before: f64, after: f64, value: f64| {
            step(
                name,
                format!("W_{axis}"),
                format!("−½ P_{axis} (u_{axis} + U_{axis})"),
                format!("(−½) · {} · ({} + {})", n(impulse, "N·s"), n(before, "m/s"), n(after, "m/s")),
                value,
                "J",
                "Eq 4",
            )
        };
        let (p_, u, v) = (outcome.impulse, outcome.approach, outcome.separation);
        let mut steps = vec![
            kinetic("kinetic energy before", "T", ["v", "ω"], &outcome.before, energy.before),
            kinetic("kinetic energy after", "T'", ["V", "Ω"], &outcome.after, energy.after),
            work("normal work", "n", p_.normal, u.normal, v.normal, energy.normal_work),
            work("tangential work", "t", p_.tangential, u.tangential, v.tangential, energy.tangential_work),
        ];
        let mut parts = (
            "W_n + W_t".to_owned(),
            format!("{} + {}", n(energy.normal_work, "J"), n(energy.tangential_work, "J")),
        );
        if outcome.moment_impulse != 0.0 {
            let spin = |motions: &[pim_core::Motion<f64>; 2]| motions[0].yaw_rate - motions[1].yaw_rate;
            steps.push(step(
                "moment work",
                "W_m",
                "−½ M (ω_1 − ω_2 + Ω_1 − Ω_2)",
                format!(
                    "(−½) · {} · ({} + {})",
                    n(outcome.moment_impulse, "N·m·s"),
                    n(spin(&outcome.before), "rad/s"),
                    n(spin(&outcome.after), "rad/s")
                ),
                energy.moment_work,
                "J",
                "theory 4",
            ));
            parts = (format!("{} + W_m", parts.0), format!("{} + {}", parts.1, n(energy.moment_work, "J")));
        }
        steps.push(step("energy loss", "E_L", parts.0, parts.1, energy.loss, "J", "theory 4"));
        steps.push(step(
            "the same from the motions",
            "E_L",
            "T − T'",
            format!("{} − {}", n(energy.before, "J"), n(energy.after, "J")),
            energy.loss,
            "J",
            "theory 4",
        ));
        steps.push(step(
            "share of the initial energy",
            "E_L/T",
            "",
            format!("{} / {}", n(energy.loss, "J"), n(energy.before, "J")),
            100.0 * energy.loss / energy.before,
            "%",
            "theory 4",
        ));
        steps
    }
}

/// Sine and cosine by the workspace's own functions.
trait SinCos {
    fn sin_cos_f64(self) -> (f64, f64);
}

impl SinCos for f64 {
    fn sin_cos_f64(self) -> (f64, f64) {
        Real::sin_cos(self)
    }
}
