//! A case that is built in code is the same as that of a file with the same data: its answers and its faults
//! are the same.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use analysis::{Failure, crush, impact, reconstruct};
use case::{CaseFile, Program};
use crash3::Side;
use inputs::{
    Basis, BrachTangential, Case, ContactPoint, Crush, Dimension, Faults, Find, GivenImpact, GivenVehicle,
    ImpactLaw, LeftOut, Mass, Purpose, Quantity, Reconstruct, Restitution, StiffnessForm, StiffnessLine,
    Velocity, YawInertia,
};
use pim_core::VehicleId;

const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");

fn quantity(number: f64, unit: &str, dimension: Dimension) -> Quantity {
    Quantity::new(number, dimension.unit(unit).unwrap()).unwrap()
}

fn degrees(number: f64) -> Quantity {
    quantity(number, "deg", Dimension::Angle)
}

fn damage(side: Side, width: f64, depths: [f64; 6], [d0, d1]: [f64; 2]) -> Crush {
    let inches = |number| quantity(number, "in", Dimension::Length);
    Crush {
        side,
        from_force_balance: false,
        width: Some(inches(width)),
        depths: depths.map(inches).to_vec(),
        spacing: None,
        stiffness: StiffnessForm::Line(StiffnessLine::Root {
            d0: quantity(d0, "lb^0.5", Dimension::RootForce),
            d1: quantity(d1, "lb^0.5/ft", Dimension::RootForcePerLength),
            g: None,
            limit: None,
        }),
        offset: None,
        pdof: None,
        oblique_angle: None,
        moment_arm: None,
        oblique: None,
    }
}

fn vehicle(name: &str, weight: f64, inertia: f64, heading: f64, [distance, angle]: [f64; 2]) -> GivenVehicle {
    GivenVehicle {
        name: Some(name.into()),
        mass: Some(Mass::Weight(quantity(weight, "lb", Dimension::Weight))),
        yaw: Some(YawInertia::Inertia(quantity(inertia, "lb ft s^2", Dimension::Inertia))),
        heading: Some(degrees(heading)),
        contact: Some(ContactPoint::Polar {
            distance: quantity(distance, "ft", Dimension::Length),
            angle: degrees(angle),
        }),
        ..GivenVehicle::default()
    }
}

/// SAE 980025, appendix.
fn built() -> Case {
    let jimmy = GivenVehicle {
        crush: Some(damage(Side::Front, 65.0, [21.3, 20.3, 13.8, 11.3, 5.3, 4.8], [35.0, 115.0])),
        ..vehicle("1994 GMC Jimmy", 3696.0, 2437.0, 180.0, [6.3, -22.4])
    };
    let altima = GivenVehicle {
        motion: Some(Velocity::Speed(quantity(10.0, "mph", Dimension::Speed))),
        crush: Some(damage(Side::Right, 84.0, [3.0, 15.8, 13.5, 6.7, 3.3, 5.0], [30.0, 77.5])),
        ..vehicle("1995 Nissan Altima", 3413.0, 2165.0, 67.0, [3.8, -39.0])
    };
    Case {
        title: Some("Intersection collision, GMC Jimmy and Nissan Altima".into()),
        source: Some("SAE 980025, appendix".into()),
        vehicles: [jimmy, altima],
        impact: Some(GivenImpact {
            crush_plane: degrees(-23.0),
            law: ImpactLaw::Brach {
                restitution: Restitution::Constant(0.3),
                tangential: BrachTangential::Critical,
                moment_restitution: None,
            },
        }),
        reconstruct: Some(Reconstruct { find: Find::One(VehicleId::One), energy_basis: Basis::Dissipated }),
        ..Case::default()
    }
}

fn file(text: &str) -> CaseFile {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn a_case_built_in_code_is_that_of_the_file() {
    let (built, read) = (built(), file(PAPER).case);
    // The file leaves words to their defaults; a case that is built in code has them all.
    assert_eq!(built.left_out, LeftOut::default());
    assert_eq!(Case { left_out: read.left_out, ..built.clone() }, read);
    let [ours, theirs] = [&built, &read].map(|case| reconstruct(case).unwrap());
    assert_eq!(format!("{ours:?}"), format!("{theirs:?}"));
    // 22.9 m/s in the paper.
    assert!((ours.found.unwrap().speed - 22.9).abs() < 0.05);
}

/// A part of a vehicle that is taken out of a case, and its key.
type Part = (&'static str, fn(&mut GivenVehicle));

/// If a part of the first vehicle is removed in code and in the file, the keys and texts of the faults are
/// the same, and have a place in the file.
#[test]
fn what_a_case_built_in_code_lacks_is_told_as_in_a_file() {
    let parts: [Part; 6] = [
        ("weight", |vehicle| vehicle.mass = None),
        ("yaw_inertia", |vehicle| vehicle.yaw = None),
        ("heading", |vehicle| vehicle.heading = None),
        ("contact", |vehicle| vehicle.contact = None),
        ("crush", |vehicle| vehicle.crush = None),
        ("speed", |vehicle| vehicle.motion = None),
    ];
    let mut told = 0;
    for (key, take) in parts {
        // Vehicle 2 has the speed that is given.
        let i = usize::from(key == "speed");
        let mut case = built();
        take(&mut case.vehicles[i]);
        let text = without(PAPER, i, key);
        let file = file(&text);
        for (analyse, purpose) in [
            (reconstruct as fn(&Case) -> _, Purpose::Reconstruct),
            (impact, Purpose::Impact),
            (crush, Purpose::Crush),
        ] {
            let (Err(Failure::Case(ours)), Err(Failure::Case(theirs))) =
                (analyse(&case), analyse(&file.case))
            else {
                assert_eq!(analyse(&case).is_ok(), analyse(&file.case).is_ok(), "{key}");
                continue;
            };
            assert_eq!(ours, theirs, "{key}");
            let path = format!("vehicle{}.{key}", i + 1);
            told += usize::from(tells(&ours, &path, purpose));
            let placed = file.diagnostics(&ours, &Program::NONE);
            let without_place = placed.list().iter().filter(|one| one.span().is_none()).count();
            let of_case = ours.list().iter().filter(|fault| fault.key.is_empty()).count();
            assert_eq!(without_place, of_case, "{placed}");
        }
    }
    // Of 18, the damage alone needs neither heading nor contact point nor speed, and the impact alone no
    // damage.
    assert_eq!(told, 14);
}

/// Whether a key is among the faults, with the purpose that it is missing for.
fn tells(faults: &Faults, key: &str, purpose: Purpose) -> bool {
    let fault = faults.list().iter().find(|fault| fault.key == key);
    fault.is_some_and(|fault| fault.to_string() == format!("`{key}` is missing: `{purpose}` needs it"))
}

/// The text without a key of a vehicle, or without its table.
fn without(text: &str, i: usize, key: &str) -> String {
    let table = format!("[vehicle{}]", i + 1);
    let crush = format!("[vehicle{}.crush]", i + 1);
    let mut inside = "";
    let lines = text.lines().filter(|line| {
        if line.starts_with('[') {
            inside = line.split(']').next().unwrap();
        }
        let is_key =
            table.starts_with(inside) && !inside.is_empty() && line.split([' ', '=']).next() == Some(key);
        let is_table = key == "crush" && crush.starts_with(inside) && inside.len() + 1 == crush.len();
        !(is_key || is_table)
    });
    lines.map(|line| format!("{line}\n")).collect()
}

/// A contradiction that no reader accepts is reported with the same text as by the reader.
#[test]
fn contradictions_are_told_as_the_reader_tells_them() {
    let fixed = GivenVehicle { fixed: true, ..GivenVehicle::default() };
    let both = Case { vehicles: [fixed.clone(), fixed.clone()], ..built() };
    let sought = Case { vehicles: [fixed, built().vehicles[1].clone()], ..built() };
    let mut inferred = built();
    for vehicle in &mut inferred.vehicles {
        let crush = vehicle.crush.as_mut().unwrap();
        (crush.from_force_balance, crush.depths) = (true, Vec::new());
    }
    let mut unmeasured = inferred.clone();
    unmeasured.vehicles[1].crush = None;
    for (case, fixture) in [
        (both, include_str!("../../../fixtures/invalid/both-fixed.txt")),
        (sought, include_str!("../../../fixtures/invalid/find-fixed.txt")),
        (inferred, include_str!("../../../fixtures/invalid/force-balance-both.txt")),
        (unmeasured, include_str!("../../../fixtures/invalid/force-balance-alone.txt")),
    ] {
        let Err(Failure::Case(faults)) = reconstruct(&case) else { panic!("{fixture}") };
        let first = &faults.list()[0];
        let message = first.message(|purpose| purpose.to_string());
        let advice = first.advice.as_ref().unwrap();
        assert!(fixture.contains(&format!("error: {message}\n")), "{message}\n{fixture}");
        assert!(fixture.contains(&format!("help: {advice}\n")), "{advice}\n{fixture}");
    }
}
