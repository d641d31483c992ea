//! Stiffness and crush energy.

use analysis::{Analysis, Damage, Vehicle};
use case::{Case, Crush, Fit, GivenTest, StiffnessForm, StiffnessLine};
use crash3::{EnergyBasis, Stiffness, Structure};

use super::{Step, StepGroup, angle, given, group, inertia, n, p, step};
use crate::units::Quantity;
use crate::words;

pub(super) fn groups(case: &Case, analysis: &Analysis) -> Vec<StepGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in analysis.vehicles.iter().enumerate() {
        if let (Some(damage), Some(crush)) = (&vehicle.damage, &case.vehicles[i].crush) {
            groups.push(group(
                format!("Crush energy of vehicle {}", i + 1),
                energy(vehicle, damage, crush, i + 1),
            ));
        }
    }
    groups.push(group("Energy sought", sought(analysis)));
    groups
}

fn energy(vehicle: &Vehicle, damage: &Damage, crush: &Crush, i: usize) -> Vec<Step> {
    let mut steps = Vec::new();
    match &damage.structure {
        Structure::Uniform(stiffness) => {
            match &crush.stiffness {
                StiffnessForm::Category(category) => of_category(&mut steps, stiffness, *category, i),
                StiffnessForm::Test(test) => of_test(&mut steps, stiffness, test, i),
                StiffnessForm::Line(line) => coefficients(&mut steps, stiffness, line, &i.to_string(), ""),
                // Zones have a structure of their own, below.
                StiffnessForm::Zones(_) => {}
            }
            if let Some(inferred) = &damage.inferred {
                return inferred_energy(steps, damage, inferred, stiffness, i);
            }
            let limited = stiffness.limit().is_some_and(|limit| {
                damage.depths.iter().any(|&depth| stiffness.a() + stiffness.b() * depth > limit)
            });
            if limited {
                zones(&mut steps, damage, crush, &|_| *stiffness, i);
            } else {
                whole(&mut steps, damage, &spacings(damage, crush), stiffness, i);
            }
        }
        Structure::Zones(stiffnesses) => {
            for (j, stiffness) in stiffnesses.iter().enumerate() {
                let StiffnessForm::Zones(lines) = &crush.stiffness else { continue };
                let Some(line) = lines.get(j) else { continue };
                coefficients(
                    &mut steps,
                    stiffness,
                    line,
                    &format!("{i},{}", j + 1),
                    &format!(", zone {}", j + 1),
                );
            }
            zones(&mut steps, damage, crush, &|j| stiffnesses[j], i);
        }
    }
    if let (Structure::Uniform(stiffness), Some(inertia), Some(speed)) =
        (&damage.structure, vehicle.subject.inertia, vehicle.no_damage_speed())
    {
        steps.push(step(
            format!("no-damage speed of vehicle {i}"),
            format!("b_0,{i}"),
            format!("√(2 G_{i} L_{i}/m_{i})"),
            format!(
                "√(2 · {} · {} / {})",
                n(stiffness.g(), "N"),
                n(damage.width, "m"),
                n(inertia.mass, "kg")
            ),
            speed,
            "m/s",
            "theory 5",
        ));
    }
    if let Some(inertia) = vehicle.subject.inertia {
        steps.push(step(
            format!("energy equivalent speed of vehicle {i}"),
            format!("EES_{i}"),
            format!("√(2 E_{i}/m_{i})"),
            format!("√(2 · {} / {})", n(damage.crush_energy, "J"), n(inertia.mass, "kg")),
            damage.ees,
            "m/s",
            "theory 5",
        ));
    }
    steps
}

/// A, B and G, from d_0 and d_1 where the file gives those.
fn coefficients(steps: &mut Vec<Step>, stiffness: &Stiffness, line: &StiffnessLine, i: &str, zone: &str) {
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let of = |what: &str| format!("stiffness {what} of vehicle {}{zone}", i.split(',').next().unwrap_or(i));
    let a_given = || given(of("A"), format!("A_{i}"), a, "N/m", "input");
    let b_given = || given(of("B"), format!("B_{i}"), b, "N/m²", "input");
    match line {
        StiffnessLine::Root { d0, d1, g: given_g, .. } => {
            let (d0, d1) = (d0.si(), d1.si());
            steps.push(step(
                of("A"),
                format!("A_{i}"),
                "d_0 d_1",
                format!("{} · {}", n(d0, "√N"), n(d1, "√N/m")),
                a,
                "N/m",
                "theory 5",
            ));
            steps.push(step(
                of("B"),
                format!("B_{i}"),
                "d_1²",
                format!("{}²", p(d1, "√N/m")),
                b,
                "N/m²",
                "theory 5",
            ));
            steps.push(match given_g {
                Some(_) => given(of("G"), format!("G_{i}"), g, "N", "input"),
                None => step(
                    of("G"),
                    format!("G_{i}"),
                    "d_0²/2",
                    format!("{}² / 2", p(d0, "√N")),
                    g,
                    "N",
                    "theory 5",
                ),
            });
        }
        StiffnessLine::Crush { g: None, .. } => {
            steps.extend([a_given(), b_given()]);
            let formula = format!("A_{i}²/(2 B_{i})");
            steps.push(step(
                of("G"),
                format!("G_{i}"),
                formula,
                format!("{}² / (2 · {})", p(a, "N/m"), n(b, "N/m²")),
                g,
                "N",
                "theory 5",
            ));
        }
        StiffnessLine::Crush { .. } => {
            steps.extend([a_given(), b_given(), given(of("G"), format!("G_{i}"), g, "N", "input")]);
        }
    }
    if let Some(limit) = stiffness.limit() {
        steps.push(given(of("limit"), format!("F_s,{i}"), limit, "N/m", "input"));
    }
}

/// A, B and G as CRASH3's table has them.
fn of_category(steps: &mut Vec<Step>, stiffness: &Stiffness, category: u8, i: usize) {
    for (what, value, unit) in
        [("A", stiffness.a(), "N/m"), ("B", stiffness.b(), "N/m²"), ("G", stiffness.g(), "N")]
    {
        let name = format!("stiffness {what} of vehicle {i}, from category {category} of CRASH3's table");
        steps.push(given(name, format!("{what}_{i}"), value, unit, "SAE 870045, Table 1"));
    }
}

/// A, B and G from a barrier test.
fn of_test(steps: &mut Vec<Step>, stiffness: &Stiffness, test: &GivenTest, i: usize) {
    let of_test = |what: &str| format!("{what} in the barrier test for vehicle {i}");
    let symbol = |what: &str| format!("{what}_T,{i}");
    steps.push(inertia::mass(&test.mass, of_test("mass"), &format!("T,{i}")));
    let (mass, v, b0, width) = (test.mass.kg(), test.speed.si(), test.no_damage_speed.si(), test.width.si());
    let depths: Vec<f64> = test.depths.iter().map(case::Quantity::si).collect();
    #[expect(clippy::cast_precision_loss, reason = "station counts are small")]
    let zones = depths.len().saturating_sub(1).max(1) as f64;
    let sum = |term: &dyn Fn(f64, f64) -> String| {
        let terms: Vec<String> = depths.windows(2).map(|c| term(c[0], c[1])).collect();
        terms.join(" + ")
    };
    // C̄ = Σ (Cⱼ + Cⱼ₊₁)/2n
    let mean = depths.windows(2).map(|c| (c[0] + c[1]) / 2.0).sum::<f64>() / zones;
    let mean_crush = step(
        of_test("mean crush"),
        symbol("C"),
        "Σ ((C_j + C_j+1)/2)/n",
        format!("({}) / {zones}", sum(&|c1, c2| format!("({} + {}) / 2", n(c1, "m"), n(c2, "m")))),
        mean,
        "m",
        "theory 5",
    );
    steps.push(mean_crush.of(Quantity::Crush));
    let (b1, formula, substitution) = match test.fit {
        Fit::Exact => {
            // Q = Σ (Cⱼ² + Cⱼ Cⱼ₊₁ + Cⱼ₊₁²)/3n
            let square =
                depths.windows(2).map(|c| (c[0] * c[0] + c[0] * c[1] + c[1] * c[1]) / 3.0).sum::<f64>()
                    / zones;
            let terms = sum(&|c1, c2| {
                format!("({}² + {} · {} + {}²) / 3", p(c1, "m"), n(c1, "m"), n(c2, "m"), p(c2, "m"))
            });
            steps.push(step(
                of_test("mean square of the crush"),
                symbol("Q"),
                "Σ ((C_j² + C_j C_j+1 + C_j+1²)/3)/n",
                format!("({terms}) / {zones}"),
                square,
                "m²",
                "theory 5",
            ));
            let (half, rest) = (b0 * mean, v * v - b0 * b0);
            let [b0_, v_, mean_, square_] = [p(b0, "m/s"), p(v, "m/s"), n(mean, "m"), n(square, "m²")];
            (
                // b₁ = (V² − b₀²)/(b₀ C̄ + √(b₀² C̄² + Q (V² − b₀²)))
                rest / (half + (half * half + square * rest).sqrt()),
                format!(
                    "(V_T,{i}² − b_0T,{i}²)/(b_0T,{i} C_T,{i} + √(b_0T,{i}² C_T,{i}² + Q_T,{i} (V_T,{i}² − b_0T,{i}²)))"
                ),
                format!(
                    "({v_}² − {b0_}²) / ({b0_} · {mean_} + √({b0_}² · {}² + {square_} · ({v_}² − {b0_}²)))",
                    p(mean, "m")
                ),
            )
        }
        Fit::Mean => (
            // b₁ = (V − b₀)/C̄
            (v - b0) / mean,
            format!("(V_T,{i} − b_0T,{i})/C_T,{i}"),
            format!("({} − {}) / {}", n(v, "m/s"), n(b0, "m/s"), n(mean, "m")),
        ),
    };
    let name = of_test("slope of the speed over the crush");
    steps.push(step(name, symbol("b"), formula, substitution, b1, "1/s", "theory 5"));
    // A = m b₀ b₁/w,  B = m b₁²/w,  G = m b₀²/2w
    let (mass_, width_) = (n(mass, "kg"), n(width, "m"));
    let (m, b) = (symbol("m"), symbol("b"));
    let coefficients = [
        (
            "A",
            format!("{m} b_0T,{i} {b}/w_T,{i}"),
            format!("{mass_} · {} · {} / {width_}", n(b0, "m/s"), n(b1, "1/s")),
            stiffness.a(),
            "N/m",
        ),
        (
            "B",
            format!("{m} {b}²/w_T,{i}"),
            format!("{mass_} · {}² / {width_}", p(b1, "1/s")),
            stiffness.b(),
            "N/m²",
        ),
        (
            "G",
            format!("{m} b_0T,{i}²/(2 w_T,{i})"),
            format!("{mass_} · {}² / (2 · {width_})", p(b0, "m/s")),
            stiffness.g(),
            "N",
        ),
    ];
    for (what, formula, substitution, value, unit) in coefficients {
        let name = format!("stiffness {what} of vehicle {i}, from the barrier test");
        steps.push(step(name, format!("{what}_{i}"), formula, substitution, value, unit, "theory 5"));
    }
}

/// (m) between the stations.
pub(super) fn spacings(damage: &Damage, crush: &Crush) -> Vec<f64> {
    let intervals = damage.depths.len().saturating_sub(1);
    match &crush.spacing {
        Some(spacing) => spacing.iter().map(case::Quantity::si).collect(),
        #[expect(clippy::cast_precision_loss, reason = "station counts are small")]
        None => vec![damage.width / intervals.max(1) as f64; intervals],
    }
}

/// (m²) S₁ = Σ wⱼ (Cⱼ + Cⱼ₊₁)/2, the area of the crush.
pub(super) fn area(damage: &Damage, crush: &Crush) -> f64 {
    let zones = spacings(damage, crush).into_iter().zip(damage.depths.windows(2));
    zones.map(|(w, c)| w * (c[0] + c[1]) / 2.0).sum()
}

/// The same stiffness all along: area and square of the profile first.
fn whole(steps: &mut Vec<Step>, damage: &Damage, spacings: &[f64], stiffness: &Stiffness, i: usize) {
    let zones = || spacings.iter().zip(damage.depths.windows(2));
    // S₁ = Σ wⱼ (Cⱼ + Cⱼ₊₁)/2
    let area: f64 = zones().map(|(w, c)| w * (c[0] + c[1]) / 2.0).sum();
    // S₂ = Σ wⱼ (Cⱼ² + Cⱼ Cⱼ₊₁ + Cⱼ₊₁²)/6
    let square: f64 = zones().map(|(w, c)| w * (c[0] * c[0] + c[0] * c[1] + c[1] * c[1]) / 6.0).sum();
    let sum = |term: &dyn Fn(f64, &[f64]) -> String| {
        zones().map(|(w, c)| term(*w, c)).collect::<Vec<_>>().join(" + ")
    };
    steps.push(step(
        format!("area of the crush of vehicle {i}"),
        format!("S_1,{i}"),
        "Σ w_j (C_j + C_j+1)/2",
        sum(&|w, c| format!("{} · ({} + {}) / 2", n(w, "m"), n(c[0], "m"), n(c[1], "m"))),
        area,
        "m²",
        "Eq 5",
    ));
    steps.push(step(
        format!("second moment of the crush of vehicle {i}"),
        format!("S_2,{i}"),
        "Σ w_j (C_j² + C_j C_j+1 + C_j+1²)/6",
        sum(&|w, c| {
            format!(
                "{} · ({}² + {} · {} + {}²) / 6",
                n(w, "m"),
                p(c[0], "m"),
                n(c[0], "m"),
                n(c[1], "m"),
                p(c[1], "m")
            )
        }),
        square,
        "m³",
        "Eq 5",
    ));
    steps.push(step(
        format!("crush energy of vehicle {i}"),
        format!("E_{i}"),
        format!("A_{i} S_1,{i} + B_{i} S_2,{i} + G_{i} L_{i}"),
        format!(
            "{} · {} + {} · {} + {} · {}",
            n(stiffness.a(), "N/m"),
            n(area, "m²"),
            n(stiffness.b(), "N/m²"),
            n(square, "m³"),
            n(stiffness.g(), "N"),
            n(damage.width, "m")
        ),
        damage.crush_energy,
        "J",
        "Eq 5",
    ));
}

/// Zone by zone, where the stiffness differs or its limit is reached.
fn zones(
    steps: &mut Vec<Step>,
    damage: &Damage,
    crush: &Crush,
    stiffness: &dyn Fn(usize) -> Stiffness,
    i: usize,
) {
    let mut terms = Vec::new();
    for (j, (w, c)) in spacings(damage, crush).into_iter().zip(damage.depths.windows(2)).enumerate() {
        let stiffness = stiffness(j);
        let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
        let (low, high) = (c[0].min(c[1]), c[0].max(c[1]));
        let rising = |c1: f64, c2: f64| {
            format!(
                "{} · ({} + {}) / 2 + {} · ({}² + {} · {} + {}²) / 6",
                n(a, "N/m"),
                n(c1, "m"),
                n(c2, "m"),
                n(b, "N/m²"),
                p(c1, "m"),
                n(c1, "m"),
                n(c2, "m"),
                p(c2, "m")
            )
        };
        // C_s = (F_s − A)/B
        let knee = stiffness.limit().filter(|_| b > 0.0).map(|limit| (limit, (limit - a) / b));
        let (formula, per_width) = match knee {
            Some((limit, knee)) if high > knee => {
                // The energy per width at the knee, (A + F_s) C_s/2, and what the flat part adds.
                let flat = |c1: f64, c2: f64| {
                    format!(
                        "({} + {}) · {} / 2 + {} · (({} + {}) / 2 − {})",
                        n(a, "N/m"),
                        n(limit, "N/m"),
                        n(knee, "m"),
                        n(limit, "N/m"),
                        n(c1, "m"),
                        n(c2, "m"),
                        n(knee, "m")
                    )
                };
                if low >= knee {
                    (
                        "w [(A + F_s) C_s/2 + F_s ((C_j + C_j+1)/2 − C_s) + G], C_s = (F_s − A)/B",
                        flat(low, high),
                    )
                } else {
                    let share = format!(
                        "({} − {}) / ({} − {})",
                        n(knee, "m"),
                        n(low, "m"),
                        n(high, "m"),
                        n(low, "m")
                    );
                    (
                        "w [s e_rising(C_low, C_s) + (1 − s) e_flat(C_s, C_high) + G], s = (C_s − C_low)/(C_high − C_low)",
                        format!("{share} · ({}) + (1 − {share}) · ({})", rising(low, knee), flat(knee, high)),
                    )
                }
            }
            _ => ("w_j [A (C_j + C_j+1)/2 + B (C_j² + C_j C_j+1 + C_j+1²)/6 + G]", rising(c[0], c[1])),
        };
        let zone = crash3::Profile::new(c.to_vec(), vec![w])
            .map(|profile| crash3::crush_energy(&profile, &stiffness));
        let Ok(energy) = zone else { continue };
        terms.push(energy);
        steps.push(step(
            format!("crush energy of vehicle {i}, zone {}", j + 1),
            format!("E_{i},{}", j + 1),
            formula,
            format!("{} · ({per_width} + {})", n(w, "m"), n(g, "N")),
            energy,
            "J",
            "Eq 5",
        ));
    }
    steps.push(step(
        format!("crush energy of vehicle {i}"),
        format!("E_{i}"),
        format!("Σ E_{i},j"),
        terms.iter().map(|&term| n(term, "J")).collect::<Vec<_>>().join(" + "),
        damage.crush_energy,
        "J",
        "Eq 5",
    ));
}

/// From the force on the other vehicle.
fn inferred_energy(
    mut steps: Vec<Step>,
    damage: &Damage,
    inferred: &analysis::Inferred,
    stiffness: &Stiffness,
    i: usize,
) -> Vec<Step> {
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let (force, width, depth) = (inferred.force, inferred.crush.width, inferred.crush.depth);
    let alpha = damage.oblique_angle;
    let of = |what: &str| format!("{what} of vehicle {i}");
    steps.push(given(of("peak force"), format!("F_{i}"), force, "N", "theory 5").of(Quantity::Force));
    steps
        .push(given(of("width of the damage"), format!("w_{i}"), width, "m", "theory 5").of(Quantity::Crush));
    if depth > 0.0 {
        let crush = step(
            of("inferred crush"),
            format!("C_{i}"),
            format!("(F_{i} cos α_{i}/w_{i} − A_{i})/B_{i}"),
            format!(
                "({} · cos{} / {} − {}) / {}",
                n(force, "N"),
                angle(alpha),
                n(width, "m"),
                n(a, "N/m"),
                n(b, "N/m²")
            ),
            depth,
            "m",
            "theory 5",
        );
        steps.push(crush.of(Quantity::Crush));
        let limited = stiffness.limit().is_some_and(|limit| a + b * depth > limit * (1.0 + 1e-9));
        if limited {
            steps.push(given(of("crush energy"), format!("E_{i}"), damage.crush_energy, "J", "theory 5"));
        } else {
            steps.push(step(
                of("crush energy"),
                format!("E_{i}"),
                format!("w_{i} (A_{i} C_{i} + B_{i} C_{i}²/2 + G_{i})"),
                format!(
                    "{} · ({} · {} + {} · {}² / 2 + {})",
                    n(width, "m"),
                    n(a, "N/m"),
                    n(depth, "m"),
                    n(b, "N/m²"),
                    p(depth, "m"),
                    n(g, "N")
                ),
                damage.crush_energy,
                "J",
                "Eq 5",
            ));
        }
    } else {
        steps.push(step(
            of("elastic energy"),
            format!("E_{i}"),
            format!("w_{i} G_{i} (F_{i} cos α_{i}/(A_{i} w_{i}))²"),
            format!(
                "{} · {} · ({} · cos{} / ({} · {}))²",
                n(width, "m"),
                n(g, "N"),
                n(force, "N"),
                angle(alpha),
                n(a, "N/m"),
                n(width, "m")
            ),
            damage.crush_energy,
            "J",
            "theory 5",
        ));
    }
    steps
}

/// The sum over the vehicles that have damage.
pub(super) fn total(analysis: &Analysis, crush_energy: f64, source: &'static str) -> Step {
    let (symbols, numbers): (Vec<String>, Vec<String>) = (1..)
        .zip(&analysis.vehicles)
        .filter_map(|(i, vehicle)| vehicle.damage.as_ref().map(|damage| (i, damage)))
        .map(|(i, damage)| (format!("E_{i}"), n(damage.crush_energy, "J")))
        .unzip();
    let name = if symbols.len() > 1 { "crush energy of both vehicles" } else { "crush energy" };
    step(name, "E", symbols.join(" + "), numbers.join(" + "), crush_energy, "J", source)
}

/// What the impact has to take.
fn sought(analysis: &Analysis) -> Vec<Step> {
    let Some(found) = &analysis.found else { return Vec::new() };
    let both = total(analysis, found.crush_energy, "Eq 4, 5");
    let e = analysis.impact.as_ref().map_or(0.0, |impact| impact.law.restitution());
    let normal_work = match analysis.basis {
        EnergyBasis::Dissipated => ("E", n(found.crush_energy, "J")),
        EnergyBasis::Absorbed => {
            ("E (1 − e²)", format!("{} · (1 − {}²)", n(found.crush_energy, "J"), p(e, "")))
        }
    };
    let name = format!("normal work sought, basis {}", words::basis_name(analysis.basis));
    vec![both, step(name, "W_n", normal_work.0, normal_work.1, found.normal_work, "J", "theory 6")]
}
