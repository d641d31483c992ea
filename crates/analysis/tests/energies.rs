//! Damage with only a known energy, no damage at all, and one vehicle alone.
//!
//! The expected values follow from the arithmetic next to them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::ops::ControlFlow;

use analysis::quantities::SPEED;
use analysis::{Analysis, EstimatePlan, Estimated, Failure, Unused, UnusedReason, Warning, estimate};
use case::CaseFile;
use evidence::{CrushErrors, EnergyError, EnergyMethod};
use inputs::{Case, FaultKind, SeverityPrior};
use pim_core::VehicleId;

fn parsed(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

fn reconstructed(text: &str) -> Analysis {
    analysis::reconstruct(&parsed(text)).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[track_caller]
fn assert_close(actual: f64, expected: f64) {
    assert!((actual - expected).abs() <= 1e-9 * expected.abs(), "{actual} is not {expected}");
}

/// Two vehicles of 1200 kg and 1800 kg that meet centrally, the first with the speed that is sought.
fn central(mover: VehicleId, crush: [&str; 2], more: &str) -> String {
    let [heading, other_heading] = ["0 deg", "180 deg"];
    let of = |id: VehicleId, mass: u32, heading: &str, crush: &str, speed: &str| {
        let (inline, table) = if crush.starts_with("crush") { (crush, "") } else { ("", crush) };
        let table = if table.is_empty() { String::new() } else { format!("[vehicle{id}.crush]\n{table}\n") };
        format!(
            "[vehicle{id}]\nmass = \"{mass} kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading}\"\ncontact = {{ x = \"2 m\", y = \"0 m\" }}\n{speed}{inline}\n{table}"
        )
    };
    of(mover, 1200, heading, crush[0], "")
        + &of(mover.other(), 1800, other_heading, crush[1], "speed = \"5 m/s\"\n")
        + &format!(
            "[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.2\ntangential = \"critical\"\n[reconstruct]\nfind = \"vehicle{mover}.speed\"\n{more}"
        )
}

/// W_n = ½ m̄ (1 − e²) u² with m̄ = 720 kg, and u = v_1 + 5 m/s.
fn central_speed(energy: f64, share: f64) -> f64 {
    (2.0 * energy / (720.0 * share)).sqrt() - 5.0
}

#[test]
fn an_ees_gives_the_energy() {
    for mover in VehicleId::ALL {
        // ½ 1200 · 12² + ½ 1800 · 8²
        let [e1, e2] = [86_400.0, 57_600.0];
        let text = central(mover, ["ees = \"43.2 km/h\"", "ees = \"8 m/s\"\nside = \"front\""], "");
        let analysis = reconstructed(&text);
        let found = analysis.found.as_ref().unwrap();
        assert_close(found.crush_energy, e1 + e2);
        assert_close(found.speed, central_speed(e1 + e2, 1.0 - 0.04));
        let [first, second] = [mover, mover.other()].map(|id| &analysis.vehicles[id.index()]);
        assert_close(first.crush_energy().unwrap(), e1);
        assert_close(second.ees().unwrap(), 8.0);
        assert_eq!(analysis.warnings, [], "{text}");
        // The basis counts for it as for any crush energy.
        let absorbed = reconstructed(&(text + "energy_basis = \"absorbed\"\n"));
        assert_close(absorbed.found.unwrap().speed, central_speed(e1 + e2, 1.0));
    }
}

/// A car of 1500 kg straight into an object that gave way: E_1 = ½ 1500 · 8² J, and what the object took.
fn into_object(car: VehicleId, deformation_energy: &str, more: &str) -> String {
    format!(
        "[vehicle{car}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"40 deg\"\n\
         contact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle{car}.crush]\nees = \"8 m/s\"\nside = \"front\"\n\
         pdof = \"0 deg\"\n[vehicle{}]\nfixed = true\n{deformation_energy}\n[impact]\ncrush_plane = \"40 deg\"\n\
         restitution = 0.2\ntangential = \"critical\"\n{more}",
        car.other()
    )
}

#[test]
fn what_an_object_took_adds_to_the_crush_energy() {
    for (car, basis, share) in [
        (VehicleId::One, "dissipated", 0.96),
        (VehicleId::Two, "dissipated", 0.96),
        (VehicleId::One, "absorbed", 1.0),
    ] {
        let seek = format!("[reconstruct]\nfind = \"vehicle{car}.speed\"\nenergy_basis = \"{basis}\"\n");
        for (deformation_energy, energy) in [("", 0.0), ("deformation_energy = \"15 kJ\"", 15_000.0)] {
            let analysis = reconstructed(&into_object(car, deformation_energy, &seek));
            let found = analysis.found.as_ref().unwrap();
            assert_close(found.crush_energy, 48_000.0 + energy);
            // W_n = ½ m (1 − e²) u², and no mass but that of the car
            assert_close(found.speed, (2.0 * (48_000.0 + energy) / (1500.0 * share)).sqrt());
            let object = &analysis.vehicles[car.other().index()];
            assert_eq!(object.crush_energy(), (energy > 0.0).then_some(energy));
            assert_eq!((object.ees(), object.moment_arm()), (None, None));
            // CRASH3 with a common velocity: ΔV = √(2 E/m)
            let crash3 = analysis.crash3.as_ref().unwrap();
            let delta_v = (2.0 * (48_000.0 + energy) / 1500.0).sqrt();
            assert_close(crash3.delta_v[car.index()], delta_v);
            assert_close(crash3.corrected.unwrap().delta_v[car.index()], delta_v);
            for correction in &crash3.corrections {
                assert_close(correction.delta_v[car.index()], delta_v);
            }
        }
    }
}

/// The misfit of the crush goes with the car's part alone; the object's own error is 30 %, or its range.
#[test]
fn an_estimate_takes_what_an_object_took_with_its_own_error() {
    let plan = EstimatePlan {
        particles: 128,
        seed: 1,
        prior: Some(SeverityPrior::Flat),
        pieces: analysis::PieceDetail::Weighed,
    };
    let of = |deformation_energy: &str, car: VehicleId| {
        estimate(&parsed(&into_object(car, deformation_energy, "")), &plan, &mut |_, _, _| {
            ControlFlow::Continue(())
        })
        .unwrap()
    };
    for car in VehicleId::ALL {
        let other = car.other().index();
        let bare = of("", car);
        assert_eq!(bare.energies[other], None);
        for (deformation_energy, own) in [
            ("deformation_energy = \"144 kJ\"", 0.3),
            ("deformation_energy = { value = \"144 kJ\", sd = \"1 kJ\" }", 0.0),
        ] {
            let found = of(deformation_energy, car);
            assert_eq!(found.energies[other], Some(EnergyMethod::OfObject));
            let CrushErrors(errors) = found.observed.crush.unwrap();
            assert_eq!(errors[other], EnergyError { bias: 0.0, shared_ln_sd: 0.2, own_ln_sd: own });
            assert_eq!(errors[car.index()].shared_ln_sd, 0.2);
            // Four times the energy is twice the speed, but for the errors and the prior.
            let wanted = SPEED.of_vehicle(car);
            let median = |found: &Estimated| {
                found.outputs.iter().find(|found| found.output == wanted).unwrap().posterior.median.value
            };
            let ratio = median(&found) / median(&bare);
            assert!((1.85..2.1).contains(&ratio), "{ratio}");
        }
    }
}

/// Nothing that the case gives is left out in silence.
#[test]
fn what_an_object_took_is_no_evidence_without_the_crush_of_the_vehicle() {
    let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: analysis::PieceDetail::Weighed };
    let case = into_object(VehicleId::One, "deformation_energy = \"15 kJ\"", "");
    let crush = "[vehicle1.crush]\nees = \"8 m/s\"\nside = \"front\"\npdof = \"0 deg\"\n";
    let recorder = "[vehicle1.recorder]\ndelta_v_longitudinal = \"-30 km/h\"\n";
    assert!(case.contains(crush));
    let of = |text: &str| estimate(&parsed(text), &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    let without = of(&case.replace(crush, recorder));
    let unused = Unused { key: "vehicle2.deformation_energy".to_owned(), reason: UnusedReason::NoCrush };
    assert_eq!((without.unused, without.observed.crush), (vec![unused], None));
    // Without damage of the car that counts, only the energy of the object is left.
    let undamaged = of(&case.replace(crush, "").replace("[vehicle1]\n", "[vehicle1]\ncrush = \"none\"\n"));
    assert_eq!((undamaged.unused, undamaged.energies), (vec![], [None, Some(EnergyMethod::OfObject)]));
    assert!(undamaged.observed.crush.is_some());
}

#[test]
fn an_ees_is_not_corrected_for_an_oblique_force() {
    let text = central(VehicleId::One, ["ees = \"12 m/s\"\npdof = \"40 deg\"", "ees = \"8 m/s\""], "");
    let analysis = reconstructed(&text);
    let crash3 = analysis.crash3.unwrap();
    assert_close(crash3.corrected.unwrap().crush_energy, 144_000.0);
    for correction in crash3.corrections {
        assert_close(correction.crush_energy, 144_000.0);
    }
    // h = 2 sin 40°
    assert_close(crash3.moment_arm[0], 2.0 * 0.642_787_609_686_539);
}

#[test]
fn a_vehicle_without_damage_takes_no_energy() {
    for mover in VehicleId::ALL {
        let analysis = reconstructed(&central(mover, ["ees = \"12 m/s\"", "crush = \"none\""], ""));
        let other = &analysis.vehicles[mover.other().index()];
        assert_eq!((other.crush_energy(), other.ees()), (Some(0.0), Some(0.0)));
        assert_close(analysis.found.as_ref().unwrap().speed, central_speed(86_400.0, 0.96));
        // ΔV = √(2 E/m̄) m̄/m of CRASH3, for a central impact
        let delta_v = analysis.crash3.unwrap().delta_v[mover.index()];
        assert_close(delta_v, (2.0 * 86_400.0 / 720.0_f64).sqrt() * 720.0 / 1200.0);
        assert_eq!(analysis.warnings, []);
    }
    let neither = parsed(&central(VehicleId::One, ["crush = \"none\"", "crush = \"none\""], ""));
    assert!(matches!(analysis::reconstruct(&neither), Err(Failure::Reconcile(_))));
}

#[test]
fn a_lorry_without_damage_raises_no_warning_of_its_own() {
    let analysis = reconstructed(include_str!("../../../fixtures/lorry.toml"));
    let [Warning::CategoryEnergy { .. }] = analysis.warnings[..] else { panic!("{:?}", analysis.warnings) };
}

/// docs/calibration.md: energies by categories were on average 45 % of what the impact took where a side was
/// hit, and 51 % where a front met a fixed object.
#[test]
fn a_speed_by_categories_is_told_to_be_low() {
    let fleet = "stiffness = \"fleet\"";
    let text = &include_str!("../../case/templates/si/front-side.toml")
        .replacen(fleet, "stiffness = { category = 3 }", 1)
        .replacen(fleet, "stiffness = { category = 2 }", 1);
    let of = |text: &str| -> Vec<([bool; 2], f64)> {
        let warnings = reconstructed(text).warnings;
        let of = |warning: &Warning| match warning {
            Warning::CategoryEnergy { of, share, .. } => Some((*of, *share)),
            _ => None,
        };
        warnings.iter().filter_map(of).collect()
    };
    let [(both, share)] = of(text)[..] else { panic!() };
    assert!(both == [true; 2] && (share - 0.45).abs() < 0.005, "{both:?} {share}");
    let measured = "{ A = \"555 N/cm\", B = \"40 N/cm^2\" }";
    let one = text.replace("{ category = 3 }", measured);
    assert!(matches!(of(&one)[..], [([false, true], _)]), "{:?}", of(&one));
    assert_eq!(of(&one.replace("{ category = 2 }", measured)), []);
    // The case itself gives the bias of its energies.
    assert_eq!(of(&format!("{text}\n[estimate]\ncrush_bias = \"80 %\"\n")), []);
    // Cars as old as the table have right energies; the newer of two counts.
    let old = |text: &str, id: u8| {
        text.replace(&format!("[vehicle{id}] "), &format!("[vehicle{id}]\nmodel_year = 1976\n#"))
    };
    assert!(matches!(of(&old(text, 1))[..], [(_, share)] if (share - 0.45).abs() < 0.005));
    assert_eq!(of(&old(&old(text, 1), 2)), []);
    // A front against an object has figures of its own.
    let wall = include_str!("../../../fixtures/leaning-tree.toml");
    assert!(matches!(of(wall)[..], [(_, share)] if (share - 0.51).abs() < 0.005), "{:?}", of(wall));
    let side = wall
        .replace("side      = \"front\"", "side = \"right\"")
        .replace("heading    = \"0 deg\"", "heading = \"90 deg\"\nsideslip = \"-90 deg\"")
        .replace("{ x = \"1.85 m\", y = \"0.2 m\" }", "{ x = \"0.2 m\", y = \"-0.8 m\" }")
        .replace("pdof      = \"0 deg\"", "pdof = \"90 deg\"");
    assert!(matches!(of(&side)[..], [(_, share)] if (share - 0.45).abs() < 0.005), "{:?}", of(&side));
    // Speeds by momentum do not use them.
    let crossing = include_str!("../../case/templates/si/intersection.toml");
    assert_eq!(of(crossing), []);
}

/// 60 in of 8, 12, 14 and 10 in with A = 300 lb/in, B = 50 lb/in² and G = 900 lb: 300 · 700 + 50 · 4160 + 900
/// · 60 = 472,000 lb·in, and EES = √(2 · 39,333 ft·lb · 32.174 ft/s² / 3200 lb) = 28.124 ft/s.
/// docs/calibration.md: energies by the stiffness of the fleet are on average e^−0.521 of what the impact
/// takes, and e^−0.77 where a front met a fixed object.
#[test]
fn a_speed_by_the_fleet_is_told_to_be_low() {
    let of = |text: &str| -> Vec<(&'static str, [bool; 2], f64)> {
        let warnings = reconstructed(text).warnings;
        let of = |warning: &Warning| match warning {
            Warning::CategoryEnergy { of, share, .. } | Warning::FleetEnergy { of, share, .. } => {
                Some((warning.code(), *of, *share))
            }
            _ => None,
        };
        warnings.iter().filter_map(of).collect()
    };
    let text = include_str!("../../../fixtures/t-bone-category.toml");
    let mixed = text.replace("{ category = 4 }", "\"fleet\"");
    let both = mixed.replace("{ category = 2 }", "\"fleet\"");
    let [("fleet-energy", [true, true], share)] = of(&both)[..] else { panic!("{:?}", of(&both)) };
    assert!((share - 0.594).abs() < 0.001, "{share}");
    let [("category-energy", [false, true], _), ("fleet-energy", [true, false], _)] = of(&mixed)[..] else {
        panic!("{:?}", of(&mixed))
    };
    let wall = include_str!("../../../fixtures/leaning-tree.toml").replace("{ category = 3 }", "\"fleet\"");
    assert!(matches!(of(&wall)[..], [(_, _, share)] if (share - 0.463).abs() < 0.001), "{:?}", of(&wall));
    assert_eq!(of(&format!("{both}\n[estimate]\ncrush_bias = \"80 %\"\n")), []);
}

#[test]
fn one_vehicle_alone_has_an_energy() {
    let text = include_str!("../../../fixtures/one-vehicle.toml");
    let turned = text.replace("vehicle1", "vehicle2") + "[vehicle1]\n";
    for (text, i) in [(text, 0), (&turned, 1)] {
        let case = parsed(text);
        let analysis = analysis::crush(&case).unwrap();
        let vehicle = &analysis.vehicles[i];
        let foot_pound = 4.448_221_615_260_5 * 0.3048;
        assert_close(vehicle.crush_energy().unwrap(), 472_000.0 / 12.0 * foot_pound);
        assert!((vehicle.ees().unwrap() / 0.3048 - 28.124).abs() < 5e-4);
        assert!(analysis.crash3.is_none());
        assert_eq!(analysis.warnings, []);
        // Without a direction of the force there is no angle to the side.
        assert_eq!(vehicle.damage.as_ref().unwrap().oblique_angle, None);
        let Err(Failure::Case(faults)) = analysis::reconstruct(&case) else {
            panic!("it needs two vehicles")
        };
        let [fault] = faults.list() else { panic!("{faults}") };
        assert_eq!(fault.key, ["vehicle2", "vehicle1"][i]);
        assert!(matches!(fault.kind, FaultKind::Missing { .. }));
    }
    // With a direction there is one, and the correction for it: 1 + tan² 20°.
    let with_pdof = text.to_owned() + "pdof = \"20 deg\"\n";
    let analysis = analysis::crush(&parsed(&with_pdof)).unwrap();
    let factor = analysis.vehicles[0].damage.as_ref().unwrap().oblique.unwrap().factor.factor;
    let tangent: f64 = 0.363_970_234_266_202;
    assert_close(factor, 1.0 + tangent * tangent);
}
