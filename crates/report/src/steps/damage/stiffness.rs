//! A, B and G from the stiffness in the file.

use case::{StiffnessForm, StiffnessLine};
use crash3::{SideStiffness, Stiffness};
use pim_core::VehicleId;

use super::super::{Step, n, p, step};
use super::barrier_test;

pub(super) fn steps(structure: &SideStiffness, form: &StiffnessForm, i: VehicleId) -> Vec<Step> {
    match (structure, form) {
        (SideStiffness::Uniform(stiffness), StiffnessForm::Category(category)) => {
            of_category(stiffness, *category, i)
        }
        (SideStiffness::Uniform(stiffness), StiffnessForm::Test(test)) => {
            barrier_test::steps(stiffness, test, i)
        }
        (SideStiffness::Uniform(stiffness), StiffnessForm::Line(line)) => {
            of_line(stiffness, line, &i.to_string(), &format!("vehicle {i}"))
        }
        (SideStiffness::Zones(stiffnesses), StiffnessForm::Zones(lines)) => (1..)
            .zip(stiffnesses.iter().zip(lines))
            .flat_map(|(j, (stiffness, line))| {
                of_line(stiffness, line, &format!("{i},{j}"), &format!("vehicle {i}, zone {j}"))
            })
            .collect(),
        // Does not occur: each zone has a line of its own, and no other form has zones.
        (SideStiffness::Zones(_), _) | (_, StiffnessForm::Zones(_)) => Vec::new(),
    }
}

/// A, B and G, from d_0 and d_1 if the file gives those.
fn of_line(stiffness: &Stiffness, line: &StiffnessLine, i: &str, whose: &str) -> Vec<Step> {
    let of = |what: &str| format!("stiffness {what} of {whose}");
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let given_g = || step(of("G"), format!("G_{i}")).is(g, "N", "input");
    let derived_g = |formula: String, numbers: String| {
        step(of("G"), format!("G_{i}")).equals(formula, numbers).is(g, "N", "theory 5")
    };
    let mut steps = match line {
        StiffnessLine::Root { d0, d1, .. } => of_roots(stiffness, [d0.si(), d1.si()], i, whose).to_vec(),
        StiffnessLine::Crush { .. } => vec![
            step(of("A"), format!("A_{i}")).is(a, "N/m", "input"),
            step(of("B"), format!("B_{i}")).is(b, "N/m²", "input"),
        ],
    };
    steps.push(match line {
        StiffnessLine::Root { g: Some(_), .. } | StiffnessLine::Crush { g: Some(_), .. } => given_g(),
        StiffnessLine::Root { d0, g: None, .. } => {
            derived_g("d_0²/2".to_owned(), format!("{}² / 2", p(d0.si(), "√N")))
        }
        StiffnessLine::Crush { g: None, .. } => {
            derived_g(format!("A_{i}²/(2 B_{i})"), format!("{}² / (2 · {})", p(a, "N/m"), n(b, "N/m²")))
        }
    });
    if let Some(limit) = stiffness.saturation_force() {
        steps.push(step(of("limit"), format!("F_s,{i}")).is(limit, "N/m", "input"));
    }
    steps
}

/// A and B from d_0 and d_1.
fn of_roots(stiffness: &Stiffness, [d0, d1]: [f64; 2], i: &str, whose: &str) -> [Step; 2] {
    [
        step(format!("stiffness A of {whose}"), format!("A_{i}"))
            .equals("d_0 d_1", format!("{} · {}", n(d0, "√N"), n(d1, "√N/m")))
            .is(stiffness.a(), "N/m", "theory 5"),
        step(format!("stiffness B of {whose}"), format!("B_{i}"))
            .equals("d_1²", format!("{}²", p(d1, "√N/m")))
            .is(stiffness.b(), "N/m²", "theory 5"),
    ]
}

/// A, B and G from CRASH3's table.
fn of_category(stiffness: &Stiffness, category: u8, i: VehicleId) -> Vec<Step> {
    [("A", stiffness.a(), "N/m"), ("B", stiffness.b(), "N/m²"), ("G", stiffness.g(), "N")]
        .map(|(what, value, unit)| {
            let name = format!("stiffness {what} of vehicle {i}, from category {category} of CRASH3's table");
            step(name, format!("{what}_{i}")).is(value, unit, "SAE 870045, Table 1")
        })
        .to_vec()
}
