//! One inspected vehicle, and substitutes for unknown data: figures by hand, and the warning of each.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use analysis::{Analysis, Warning};
use case::CaseFile;
use pim_core::VehicleId;

#[track_caller]
fn assert_relative(what: &str, actual: f64, expected: f64) {
    assert!((actual / expected - 1.0).abs() < 1e-9, "{what}: {actual} is not {expected}");
}

/// A car that runs into the rear of another, square and in line. The first is crushed by 0.3 m over 1.5 m
/// with A 50 kN/m, B 1 MN/m²: 91,875 J at 1.5 (50 + 300) kN = 525 kN.
fn rear_end(vehicle2: &str, crush2: &str) -> String {
    format!(
        "[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\ncontact = {{ x = \"2 m\", y = \"0 m\" }}\n\
         [vehicle1.crush]\nside = \"front\"\nwidth = \"1.5 m\"\ndepths = \"0.3 0.3 m\"\npdof = \"12 o'clock\"\n\
         stiffness = {{ A = \"50 kN/m\", B = \"1 MN/m^2\" }}\n\
         [vehicle2]\nmass = \"1500 kg\"\nheading = \"0 deg\"\nspeed = \"0 m/s\"\n{vehicle2}\n\
         [vehicle2.crush]\nside = \"rear\"\nfrom_force_balance = true\nstiffness = {{ A = \"40 kN/m\", B = \"0.5 MN/m^2\" }}\n{crush2}\n\
         [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0\ntangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
    )
}

const YAW_AND_CONTACT: &str = "yaw_radius = \"1.4 m\"\ncontact = { x = \"-2 m\", y = \"0 m\" }";

fn crush(text: &str) -> Analysis {
    analysis::crush(&CaseFile::parse("rear-end.toml", text).unwrap().case).unwrap()
}

fn energy(analysis: &Analysis) -> f64 {
    analysis.vehicles[1].damage.as_ref().unwrap().crush_energy
}

#[test]
fn the_force_on_one_vehicle_gives_the_energy_of_the_other() {
    // 525 kN over 2 m: 262.5 kN/m, C = 0.445 m, E = 2 (17,800 + 49,506.25 + 1,600) J.
    let text = rear_end(YAW_AND_CONTACT, "width = \"2 m\"");
    let analysis = crush(&text);
    assert_relative("E_2", energy(&analysis), 137_812.5);
    let damage = analysis.vehicles[1].damage.as_ref().unwrap();
    assert_relative("C", damage.inferred.unwrap().crush.depth, 0.445);
    assert_relative("F", damage.oblique.unwrap().peak_force, 525e3);
    assert!(damage.depths.is_empty());
    assert_relative("E", analysis.crash3.unwrap().crush_energy, 91_875.0 + 137_812.5);
    let [
        Warning::InferredEnergy {
            vehicle: VehicleId::Two,
            force,
            crush: [width, depth],
            energy,
            bounds: None,
        },
    ] = analysis.warnings[..]
    else {
        panic!("{:?}", analysis.warnings)
    };
    assert_relative("F", force, 525e3);
    assert_relative("w", width, 2.0);
    assert_relative("C", depth, 0.445);
    assert_relative("E", energy, 137_812.5);

    // ½ m̄ u² = E with m̄ = 750 kg.
    let found =
        analysis::reconstruct(&CaseFile::parse("rear-end.toml", &text).unwrap().case).unwrap().found.unwrap();
    assert_relative("speed", found.speed, (2.0 * 229_687.5 / 750.0_f64).sqrt());
    assert_relative("E", found.crush_energy, 229_687.5);
}

/// The order of the two vehicles in the file does not matter.
#[test]
fn either_vehicle_may_be_the_inspected_one() {
    let text = rear_end(YAW_AND_CONTACT, "width = \"2 m\"");
    let swapped =
        text.replace("vehicle1", "VEHICLE").replace("vehicle2", "vehicle1").replace("VEHICLE", "vehicle2");
    let analysis = crush(&swapped);
    assert_relative("E_1", analysis.vehicles[0].damage.as_ref().unwrap().crush_energy, 137_812.5);
    assert!(matches!(analysis.warnings[..], [Warning::InferredEnergy { vehicle: VehicleId::One, .. }]));
}

#[test]
fn without_a_width_the_energy_has_bounds() {
    let outline = "yaw_radius = \"1.4 m\"\ncontact = { x = \"-2 m\", y = \"0 m\" }\nlength = \"4.4 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\"";
    let analysis = crush(&rear_end(outline, ""));
    // With G = A²/2B the energy is F²/(2 B w). Nominal: the 1.5 m of vehicle 1. Widest: 1.8 m. Deepest: 2.4 m
    // at 1240 kN/m.
    let e = |width: f64| 525e3 * 525e3 / (1e6 * width);
    assert_relative("nominal", energy(&analysis), e(1.5));
    let Some(Warning::InferredEnergy { bounds: Some([least, most]), .. }) = analysis.warnings.first() else {
        panic!("{:?}", analysis.warnings)
    };
    assert_relative("least", *least, e(1.8));
    assert_relative("most", *most, e(525.0 / 1240.0));
}

#[test]
fn a_force_that_does_not_push_on_the_inspected_side_gives_no_energy() {
    let text = rear_end(YAW_AND_CONTACT, "width = \"2 m\"").replace("12 o'clock", "6 o'clock");
    let error = analysis::crush(&CaseFile::parse("rear-end.toml", &text).unwrap().case).unwrap_err();
    assert!(error.to_string().contains("does not push on it"), "{error}");
}

/// What class, wheelbase and the centroid stand in for.
#[test]
fn every_assumption_is_a_warning() {
    let class = crush(&rear_end("class = 3", "width = \"2 m\"\noffset = \"0.2 m\""));
    let [
        // 2 m at 0.2 m from the axis of a class of 72.6 in.
        Warning::DamageOutside { vehicle: VehicleId::Two, .. },
        Warning::ClassValues {
            vehicle: VehicleId::Two,
            class: 3,
            yaw_inertia: Some(inertia),
            outline: Some([length, _, _]),
        },
        Warning::InferredEnergy { .. },
        Warning::DamageCentroid {
            vehicle: VehicleId::Two, point: [forward, left], offset_given: true, ..
        },
    ] = class.warnings[..]
    else {
        panic!("{:?}", class.warnings)
    };
    // Class 3: k² = 3324 in², length 196.2 in, front 89.8 in.
    assert_relative("I", inertia, 1500.0 * 3324.0 * 0.0254 * 0.0254);
    assert_relative("length", length, 196.2 * 0.0254);
    // Half of the crush of 0.445 m in front of the rear.
    assert_relative("forward", forward, -(196.2 - 89.8) * 0.0254 + 0.2225);
    assert_relative("left", left, 0.2);
    let damage = class.vehicles[1].damage.as_ref().unwrap();
    // The force comes from straight behind, 0.2 m left of the CG.
    assert_relative("h", damage.moment_arm, 0.2);

    let burg = crush(&rear_end(
        "wheelbase = \"2.6 m\"\nlength = \"4.5 m\"\ncontact = { x = \"-2 m\", y = \"0 m\" }",
        "width = \"2 m\"",
    ));
    let [Warning::BurgInertia { vehicle: VehicleId::Two, yaw_inertia }, Warning::InferredEnergy { .. }] =
        burg.warnings[..]
    else {
        panic!("{:?}", burg.warnings)
    };
    assert_relative("I", yaw_inertia, 2_227.095);

    let no_offset = crush(&rear_end("class = 3", "width = \"2 m\""));
    assert!(
        no_offset.warnings.iter().any(|w| matches!(w, Warning::DamageCentroid { offset_given: false, .. }))
    );
}
