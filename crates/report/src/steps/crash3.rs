//! CRASH3's own answer.

use analysis::{Analysis, Damage};
use case::{Axes, Case, Crush};
use crash3::{EnergyBasis, ObliqueCorrection, Structure};

use super::{Step, StepGroup, angle, given, group, n, p, step};
use crate::units::Quantity;

pub(super) fn groups(case: &Case, analysis: &Analysis) -> Vec<StepGroup> {
    let mut groups = Vec::new();
    for (i, vehicle) in analysis.vehicles.iter().enumerate() {
        if let Some(damage) = &vehicle.damage {
            let correction =
                vehicle.subject.damage.as_ref().map(|given| (given.correction, given.side.square_pdof()));
            groups.push(group(
                format!("CRASH3: oblique force on vehicle {}", i + 1),
                oblique(damage, case.vehicles[i].crush.as_ref(), correction, i + 1),
            ));
        }
    }
    groups.push(group("CRASH3: velocity changes", velocity_changes(analysis, case.axes)));
    groups
}

fn oblique(
    damage: &Damage,
    crush: Option<&Crush>,
    correction: Option<(ObliqueCorrection, f64)>,
    i: usize,
) -> Vec<Step> {
    let mut steps = Vec::new();
    let (alpha, of) = (damage.oblique_angle, |what: &str| format!("{what}, vehicle {i}"));
    match (damage.pdof, correction) {
        (Some(pdof), Some((_, square))) if (pdof - square - alpha).abs() < 1e-9 => steps.push(step(
            of("angle of the force to the normal of the damaged side"),
            format!("α_{i}"),
            format!("PDOF_{i} − PDOF of a square hit"),
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
    if let (Structure::Uniform(stiffness), None, Some(crush)) = (&damage.structure, &damage.inferred, crush)
        && stiffness.limit().is_none()
    {
        let area = super::damage::area(damage, crush);
        let force = step(
            of("peak force"),
            format!("F_{i}"),
            format!("(A_{i} L_{i} + B_{i} S_1,{i})/cos α_{i}"),
            format!(
                "({} · {} + {} · {}) / cos{}",
                n(stiffness.a(), "N/m"),
                n(damage.width, "m"),
                n(stiffness.b(), "N/m²"),
                n(area, "m²"),
                angle(alpha)
            ),
            oblique.peak_force,
            "N",
            "theory 5",
        );
        steps.push(force.of(Quantity::Force));
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
        let given_arm = analysis.vehicles[i].subject.damage.as_ref().and_then(|given| given.moment_arm);
        let name = format!("distance of the line of action from CG {k}");
        let point = contact.or(damage.and_then(|damage| damage.centroid));
        steps.push(match (given_arm, point, damage.and_then(|damage| damage.pdof)) {
            (None, Some([x, y]), Some(pdof)) => step(
                name,
                format!("h_{k}"),
                format!("|x_{k} sin PDOF_{k} {left} y_{k} cos PDOF_{k}|"),
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
    let mut change = |name: &str, prime: &str, energy: f64, delta_v: [f64; 2]| {
        for &(i, mass, _) in &vehicles {
            let k = i + 1;
            let (mut formula, mut numbers) = (Vec::new(), Vec::new());
            for &(j, other, _) in &vehicles {
                formula.push(format!("1/(γ_{0} m_{0})", j + 1));
                numbers.push(format!("1 / ({} · {})", n(crash3.effective_mass_ratio[j], ""), n(other, "kg")));
            }
            steps.push(step(
                format!("velocity change of vehicle {k}, {name}"),
                format!("ΔV{prime}_{k}"),
                format!("√(2 E{prime}/[{}])/m_{k}", formula.join(" + ")),
                format!("√(2 · {} / ({})) / {}", n(energy, "J"), numbers.join(" + "), n(mass, "kg")),
                delta_v[i],
                "m/s",
                "Eq 6, 7",
            ));
        }
    };
    change("uncorrected", "", crash3.crush_energy, crash3.delta_v);
    if let Some(corrected) = crash3.corrected {
        change("corrected for the oblique force", "'", corrected.crush_energy, corrected.delta_v);
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
