//! CRASH3's own answer.

use analysis::{Analysis, Damage, Vehicle};
use case::{Axes, Case, Crush};
use crash3::{EnergyBasis, ObliqueCorrection, Profile, Stiffness, Structure};

use super::{Step, StepGroup, angle, given, group, n, p, step};
use crate::units::Quantity;

pub(super) fn groups(case: &Case, analysis: &Analysis) -> Vec<StepGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in analysis.vehicles.iter().enumerate() {
        if let Some(damage) = &vehicle.damage {
            let correction =
                vehicle.subject.damage.as_ref().map(|given| (given.correction, given.side.square_pdof()));
            let mut steps = Vec::new();
            steps.extend(pdof_of_file(vehicle, analysis.impact.is_some(), i + 1));
            let pdof = pdof_symbol(vehicle, i + 1);
            steps.extend(oblique(damage, case.vehicles[i].crush.as_ref(), correction, &pdof, i + 1));
            groups.push(group(format!("CRASH3: oblique force on vehicle {}", i + 1), steps));
        }
    }
    groups.push(group("CRASH3: velocity changes", velocity_changes(analysis, case.axes)));
    groups
}

/// The symbol of the PDOF that CRASH3 uses: that of the impulse has one of its own, above.
fn pdof_symbol(vehicle: &Vehicle, i: usize) -> String {
    match vehicle.subject.damage.as_ref().filter(|given| given.pdof.is_some()) {
        Some(given) if given.pdof_follows => format!("PDOF_opposite,{i}"),
        Some(_) => format!("PDOF_given,{i}"),
        None => format!("PDOF_{i}"),
    }
}

/// The PDOF that the file gives for the vehicle or, by that of the other, for the force opposite to it.
fn pdof_of_file(vehicle: &Vehicle, has_impulse: bool, i: usize) -> Option<Step> {
    let written = vehicle.subject.damage.as_ref()?;
    let (what, source) = if written.pdof_follows {
        ("opposite to the given force on the other vehicle", "theory 5")
    } else {
        ("as given", "input")
    };
    let instead = if has_impulse { ", used for CRASH3 in place of that of the impulse" } else { "" };
    let name = format!("PDOF of vehicle {i} {what}{instead}");
    Some(given(name, pdof_symbol(vehicle, i), written.pdof?.to_degrees(), "°", source))
}

fn oblique(
    damage: &Damage,
    crush: Option<&Crush>,
    correction: Option<(ObliqueCorrection, f64)>,
    pdof_symbol: &str,
    i: usize,
) -> Vec<Step> {
    let mut steps = Vec::new();
    let (alpha, of) = (damage.oblique_angle, |what: &str| format!("{what}, vehicle {i}"));
    match (damage.pdof, correction) {
        (Some(pdof), Some((_, square))) if (pdof - square - alpha).abs() < 1e-9 => steps.push(step(
            of("angle of the force to the normal of the damaged side"),
            format!("α_{i}"),
            format!("{pdof_symbol} − PDOF of a square hit"),
            format!("{} − {}", angle(pdof), angle(square)),
            alpha.to_degrees(),
            "°",
            "theory 5",
        )),
        _ => steps.push(given(
            of("angle of the force to the normal of the damaged side"),
            format!("α_{i}"),
            alpha.to_degrees(),
            "°",
            "theory 5",
        )),
    }
    let Some(oblique) = &damage.oblique else { return steps };
    if let (None, Some(crush)) = (&damage.inferred, crush) {
        steps.extend(peak_force(damage, crush, oblique.peak_force, i));
    }
    let tangent = format!("tan{}", angle(alpha));
    let (formula, numbers) = match correction.map(|(correction, _)| correction) {
        Some(ObliqueCorrection::None) => (String::new(), String::new()),
        Some(ObliqueCorrection::Capped) if oblique.factor.capped => (String::new(), String::new()),
        Some(ObliqueCorrection::Friction(mu)) => (
            format!("1 + min(|tan α_{i}|, μ) |tan α_{i}|"),
            format!("1 + min(abs({tangent}), {}) · abs({tangent})", n(mu, "")),
        ),
        Some(ObliqueCorrection::Secant) => (format!("1/cos α_{i}"), format!("1 / cos{}", angle(alpha))),
        _ => (format!("1 + tan² α_{i}"), format!("1 + ({tangent})²")),
    };
    let capped = if oblique.factor.capped { ", at CRASH3's limit of 45°" } else { "" };
    steps.push(step(
        of(&format!("factor of the oblique correction{capped}")),
        format!("f_{i}"),
        formula,
        numbers,
        oblique.factor.factor,
        "",
        "Eq 8",
    ));
    steps.push(step(
        of("corrected crush energy"),
        format!("E'_{i}"),
        format!("E_{i} f_{i}"),
        format!("{} · {}", n(damage.crush_energy, "J"), n(oblique.factor.factor, "")),
        oblique.corrected_crush_energy,
        "J",
        "Eq 8",
    ));
    steps
}

/// The force at maximum crush: of the whole side where the same line holds all along, else zone by zone.
fn peak_force(damage: &Damage, crush: &Crush, peak: f64, i: usize) -> Vec<Step> {
    let alpha = damage.oblique_angle;
    let total = |formula: String, substitution: String| {
        step(
            format!("peak force, vehicle {i}"),
            format!("F_{i}"),
            formula,
            substitution,
            peak,
            "N",
            "theory 5",
        )
        .of(Quantity::Force)
    };
    if let Structure::Uniform(stiffness) = &damage.structure
        && stiffness.limit().is_none()
    {
        let area = super::damage::area(damage, crush);
        return vec![total(
            format!("(A_{i} L_{i} + B_{i} S_1,{i})/cos α_{i}"),
            format!(
                "({} · {} + {} · {}) / cos{}",
                n(stiffness.a(), "N/m"),
                n(damage.width, "m"),
                n(stiffness.b(), "N/m²"),
                n(area, "m²"),
                angle(alpha)
            ),
        )];
    }
    let (mut steps, mut terms) = (Vec::new(), Vec::new());
    let zones = super::damage::spacings(damage, crush).into_iter().zip(damage.depths.windows(2));
    for (j, (w, c)) in zones.enumerate() {
        let stiffness = match &damage.structure {
            Structure::Uniform(stiffness) => Some(stiffness),
            Structure::Zones(stiffnesses) => stiffnesses.get(j),
        };
        let Some(stiffness) = stiffness else { continue };
        // Square to the side: α stands below the sum.
        let zone = Profile::new(c.to_vec(), vec![w])
            .and_then(|profile| crash3::peak_force(&profile, stiffness, 0.0));
        let Ok(force) = zone else { continue };
        let (formula, per_width) = force_per_width(stiffness, [c[0], c[1]]);
        terms.push(n(force, "N"));
        steps.push(
            step(
                format!("peak force square to the side, vehicle {i}, zone {}", j + 1),
                format!("F_{i},{}", j + 1),
                formula,
                format!("{} · ({per_width})", n(w, "m")),
                force,
                "N",
                "theory 5",
            )
            .of(Quantity::Force),
        );
    }
    steps.push(total(
        format!("(Σ F_{i},j)/cos α_{i}"),
        format!("({}) / cos{}", terms.join(" + "), angle(alpha)),
    ));
    steps
}

/// The force of a zone in symbols, and its mean per width in numbers.
fn force_per_width(stiffness: &Stiffness, [c1, c2]: [f64; 2]) -> (&'static str, String) {
    let (a, b) = (stiffness.a(), stiffness.b());
    let (low, high) = (c1.min(c2), c1.max(c2));
    let rising = |c1: f64, c2: f64| {
        format!("{} + {} · ({} + {}) / 2", n(a, "N/m"), n(b, "N/m²"), n(c1, "m"), n(c2, "m"))
    };
    // C_s = (F_s − A)/B
    match stiffness.limit().filter(|_| b > 0.0).map(|limit| (limit, (limit - a) / b)) {
        Some((limit, knee)) if low >= knee => ("w_j F_s", n(limit, "N/m")),
        Some((limit, knee)) if high > knee => {
            let share =
                format!("({} − {}) / ({} − {})", n(knee, "m"), n(low, "m"), n(high, "m"), n(low, "m"));
            (
                "w_j {s [A + B (C_low + C_s)/2] + (1 − s) F_s}, s = (C_s − C_low)/(C_high − C_low)",
                format!("{share} · ({}) + (1 − {share}) · {}", rising(low, knee), n(limit, "N/m")),
            )
        }
        _ => ("w_j [A + B (C_j + C_j+1)/2]", rising(c1, c2)),
    }
}

fn velocity_changes(analysis: &Analysis, axes: Axes) -> Vec<Step> {
    let Some(crash3) = &analysis.crash3 else { return Vec::new() };
    // Across the force, which comes from the PDOF, clockwise in any axes.
    let left = match axes {
        Axes::ZUp => "+",
        Axes::ZDown => "−",
    };
    let mut steps = Vec::new();
    let vehicles: Vec<(usize, f64, f64)> = analysis
        .vehicles
        .iter()
        .enumerate()
        .filter_map(|(i, vehicle)| {
            vehicle.subject.inertia.map(|inertia| (i, inertia.mass, inertia.yaw_inertia))
        })
        .collect();
    for &(i, mass, inertia) in &vehicles {
        let (k, arm, ratio) = (i + 1, crash3.moment_arm[i], crash3.effective_mass_ratio[i]);
        let contact = analysis.vehicles[i].subject.contact;
        let damage = analysis.vehicles[i].damage.as_ref();
        let direction = pdof_symbol(&analysis.vehicles[i], k);
        let given_arm = analysis.vehicles[i].subject.damage.as_ref().and_then(|given| given.moment_arm);
        let name = format!("distance of the line of action from CG {k}");
        let point = contact.or(damage.and_then(|damage| damage.centroid));
        steps.push(match (given_arm, point, damage.and_then(|damage| damage.pdof)) {
            (None, Some([x, y]), Some(pdof)) => step(
                name,
                format!("h_{k}"),
                format!("|x_{k} sin {direction} {left} y_{k} cos {direction}|"),
                format!("abs({} · sin{2} {left} {1} · cos{2})", n(x, "m"), n(y, "m"), angle(pdof)),
                arm,
                "m",
                "theory 5",
            ),
            _ => given(name, format!("h_{k}"), arm, "m", "input"),
        });
        // k² = I/m
        let square = inertia / mass;
        steps.push(step(
            format!("square of the radius of gyration, vehicle {k}"),
            format!("k_{k}²"),
            format!("I_{k}/m_{k}"),
            format!("{} / {}", n(inertia, "kg·m²"), n(mass, "kg")),
            square,
            "m²",
            "theory 5",
        ));
        steps.push(step(
            format!("effective mass ratio, vehicle {k}"),
            format!("γ_{k}"),
            format!("k_{k}²/(k_{k}² + h_{k}²)"),
            format!("{0} / ({0} + {1}²)", n(square, "m²"), p(arm, "m")),
            ratio,
            "",
            "theory 5",
        ));
    }
    steps.push(super::damage::total(analysis, crash3.crush_energy, "Eq 5"));
    // The impulse has a ΔV_1 of its own.
    let change = |steps: &mut Vec<Step>, name: &str, prime: &str, energy: f64, delta_v: [f64; 2]| {
        let symbol = if prime.is_empty() { "ΔV_CRASH3,".to_owned() } else { format!("ΔV{prime}_") };
        for &(i, mass, _) in &vehicles {
            let k = i + 1;
            let (mut formula, mut numbers) = (Vec::new(), Vec::new());
            for &(j, other, _) in &vehicles {
                formula.push(format!("1/(γ_{0} m_{0})", j + 1));
                numbers.push(format!("1 / ({} · {})", n(crash3.effective_mass_ratio[j], ""), n(other, "kg")));
            }
            steps.push(step(
                format!("velocity change of vehicle {k}, {name}"),
                format!("{symbol}{k}"),
                format!("√(2 E{prime}/[{}])/m_{k}", formula.join(" + ")),
                format!("√(2 · {} / ({})) / {}", n(energy, "J"), numbers.join(" + "), n(mass, "kg")),
                delta_v[i],
                "m/s",
                "Eq 6, 7",
            ));
        }
    };
    change(&mut steps, "uncorrected", "", crash3.crush_energy, crash3.delta_v);
    if let Some(corrected) = crash3.corrected {
        steps.push(corrected_total(analysis, corrected.crush_energy));
        let name = "corrected for the oblique force";
        change(&mut steps, name, "'", corrected.crush_energy, corrected.delta_v);
        let e = analysis.impact.as_ref().map(|impact| impact.law.restitution());
        if let (Some(factor), Some(e)) = (crash3.restitution_factor, e) {
            let (formula, numbers) = match analysis.basis {
                EnergyBasis::Dissipated => {
                    ("√((1 + e)/(1 − e))", format!("√((1 + {0}) / (1 − {0}))", n(e, "")))
                }
                EnergyBasis::Absorbed => ("1 + e", format!("1 + {}", n(e, ""))),
            };
            steps.push(step("factor for restitution", "f_e", formula, numbers, factor, "", "theory 5"));
            for &(i, ..) in &vehicles {
                let k = i + 1;
                let dv = corrected.delta_v[i];
                steps.push(step(
                    format!("velocity change of vehicle {k}, corrected, with restitution"),
                    format!("ΔV''_{k}"),
                    format!("ΔV'_{k} f_e"),
                    format!("{} · {}", n(dv, "m/s"), n(factor, "")),
                    dv * factor,
                    "m/s",
                    "theory 5",
                ));
            }
        }
    }
    steps
}

/// The sum over the vehicles that have damage, each with its correction.
fn corrected_total(analysis: &Analysis, crush_energy: f64) -> Step {
    let (symbols, numbers): (Vec<String>, Vec<String>) = (1..)
        .zip(&analysis.vehicles)
        .filter_map(|(i, vehicle)| vehicle.damage.as_ref()?.oblique.map(|oblique| (i, oblique)))
        .map(|(i, oblique)| (format!("E'_{i}"), n(oblique.corrected_crush_energy, "J")))
        .unzip();
    let name =
        if symbols.len() > 1 { "corrected crush energy of both vehicles" } else { "corrected crush energy" };
    step(name, "E'", symbols.join(" + "), numbers.join(" + "), crush_energy, "J", "Eq 8")
}
