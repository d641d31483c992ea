//! A, B and G from the stiffness in the file.

use case::{StiffnessForm, StiffnessLine, TypicalStiffness};
use crash3::{SideStiffness, Stiffness};
use pim_core::VehicleId;

use super::super::{Draft, n, step};
use super::barrier_test;

pub(super) fn steps(structure: &SideStiffness, form: &StiffnessForm, i: VehicleId) -> Vec<Draft> {
    match (structure, form) {
        (SideStiffness::Uniform(stiffness), StiffnessForm::Typical(typical)) => {
            of_typical(stiffness, *typical, i)
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
fn of_line(stiffness: &Stiffness, line: &StiffnessLine, i: &str, whose: &str) -> Vec<Draft> {
    let of = |what: &str, value: f64, unit: &'static str, source: &'static str| {
        step(format!("stiffness {what} of {whose}"), format!("{what}_{i}"), (value, unit), source)
    };
    let [a, b] = match line {
        StiffnessLine::Root { d0, d1, .. } => {
            let roots = [("d_0", n(d0.si(), "√N")), ("d_1", n(d1.si(), "√N/m"))];
            [("d_0 d_1", "A", stiffness.a(), "N/m"), ("d_1²", "B", stiffness.b(), "N/m²")].map(
                |(formula, what, value, unit)| of(what, value, unit, "theory 5").equals(formula).with(roots),
            )
        }
        StiffnessLine::Crush { .. } => {
            [of("A", stiffness.a(), "N/m", "input"), of("B", stiffness.b(), "N/m²", "input")]
        }
    };
    let derived_g = || of("G", stiffness.g(), "N", "theory 5");
    let g = match line {
        StiffnessLine::Root { g: Some(_), .. } | StiffnessLine::Crush { g: Some(_), .. } => {
            of("G", stiffness.g(), "N", "input")
        }
        StiffnessLine::Root { d0, g: None, .. } => {
            derived_g().equals("d_0²/2").with([("d_0", n(d0.si(), "√N"))])
        }
        StiffnessLine::Crush { g: None, .. } => derived_g().equals(format!("A_{i}²/(2 B_{i})")),
    };
    let mut steps = vec![a, b, g];
    if let Some(limit) = stiffness.saturation_force() {
        let name = format!("stiffness limit of {whose}");
        steps.push(step(name, format!("F_s,{i}"), (limit, "N/m"), "input"));
    }
    steps
}

/// A, B and G from a table.
fn of_typical(stiffness: &Stiffness, typical: TypicalStiffness, i: VehicleId) -> Vec<Draft> {
    let (from, source) = match typical {
        TypicalStiffness::Category(category) => {
            (format!("from category {category} of CRASH3's table"), "SAE 870045, Table 1")
        }
        TypicalStiffness::Fleet => ("of the fleet".to_owned(), "docs/calibration.md"),
    };
    [("A", stiffness.a(), "N/m"), ("B", stiffness.b(), "N/m²"), ("G", stiffness.g(), "N")]
        .map(|(what, value, unit)| {
            let name = format!("stiffness {what} of vehicle {i}, {from}");
            step(name, format!("{what}_{i}"), (value, unit), source)
        })
        .into()
}
