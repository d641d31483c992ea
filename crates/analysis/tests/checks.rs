//! The consistency checks, on both sides of their limits, and the warnings that they raise.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use analysis::{Analysis, Check, CheckedQuantity, Failure, Warning, crush, impact, reconstruct};
use case::CaseFile;
use inputs::{Basis, Case};
use pim_core::VehicleId;

const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");

fn analysis(analyse: fn(&Case) -> Result<Analysis, Failure>, text: &str) -> Analysis {
    let file = CaseFile::parse("case.toml", text).unwrap_or_else(|error| panic!("{error}")).case;
    analyse(&file).unwrap_or_else(|error| panic!("{error}"))
}

fn check(analysis: &Analysis, code: &str) -> Option<Check> {
    analysis.checks.iter().copied().find(|check| check.code() == code)
}

fn raises(analysis: &Analysis, code: &str) -> bool {
    analysis.warnings.iter().any(|warning| warning.code() == code)
}

/// Two equal cars that meet head-on, the crush of each 1.5 m wide and 0.3 m deep with A = 40 kN/m and B = 500
/// kN/m²: 54,150 J each.
fn head_on(pdof: [f64; 2], speed: f64, restitution: f64) -> String {
    let vehicle = |i: usize, heading: f64| {
        format!(
            "[vehicle{i}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\nspeed = \"{speed} m/s\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle{i}.crush]\nside = \"front\"\nwidth = \"1.5 m\"\ndepths = \"0.3 0.3 m\"\n\
             stiffness = {{ A = \"40 kN/m\", B = \"500 kN/m^2\" }}\npdof = \"{} deg\"\n",
            pdof[i - 1]
        )
    };
    format!(
        "{}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = {restitution}\ntangential = \"critical\"\n",
        vehicle(1, 0.0),
        vehicle(2, 180.0)
    )
}

#[test]
fn two_given_directions_of_force_have_to_be_opposite() {
    for (second, passed) in [(0.0, true), (9.9, true), (10.1, false), (-9.9, true), (-10.1, false)] {
        // The other way round the circle is the same direction.
        for turns in [0.0, 360.0] {
            let analysis = analysis(crush, &head_on([0.0 + turns, second], 5.0, 0.1));
            let check = check(&analysis, "pdofs-opposite").unwrap();
            assert!((check.value.to_degrees() - f64::abs(second)).abs() < 1e-9, "{check:?}");
            assert_eq!(check.passed(), passed, "{second}");
            assert_eq!(raises(&analysis, "pdofs-not-opposite"), !passed);
        }
    }
}

/// An hour of the clock is 30° wide: 12 and 11 o'clock may be the same direction, and so may 12 and an angle
/// up to 15° from it.
#[test]
fn hours_of_the_clock_are_held_to_half_an_hour_each() {
    for (first, second, limit, passed) in [
        ("12 o'clock", "12 o'clock", 30.0, true),
        ("12 o'clock", "11 o'clock", 30.0, true),
        ("12 o'clock", "10 o'clock", 30.0, false),
        ("14.9 deg", "12 o'clock", 15.0, true),
        ("12 o'clock", "15.1 deg", 15.0, false),
    ] {
        let text = head_on([0.0, 0.0], 5.0, 0.1);
        let text = text.replacen("\"0 deg\"\n[vehicle2]", &format!("\"{first}\"\n[vehicle2]"), 1);
        let text = text.replacen("\"0 deg\"\n[impact]", &format!("\"{second}\"\n[impact]"), 1);
        assert!(text.contains(first) && text.contains(second), "{text}");
        let analysis = analysis(crush, &text);
        let check = check(&analysis, "pdofs-opposite").unwrap();
        // 1e-9: the rounding of radians.
        assert!((check.limit.to_degrees() - limit).abs() < 1e-9, "{check:?}");
        assert_eq!(check.passed(), passed, "{first} {second}");
        assert_eq!(raises(&analysis, "pdofs-not-opposite"), !passed);
    }
}

/// The GMC Jimmy's PDOF is 2.8°, and its line of action turns it the other way beyond 22.4°: 12 o'clock
/// differs by less than half an hour; 1 o'clock (15° to 45°) differs, and part of it turns the vehicle as it
/// turned; no part of 2 o'clock does.
#[test]
fn an_hour_agrees_where_a_part_of_it_does() {
    let arm = |degrees: f64| (22.4 - degrees).to_radians().sin();
    for (hour, differs, best, turns) in
        [(12, false, -15.0, true), (1, true, 15.0, true), (2, true, 45.0, false)]
    {
        let side = "side      = \"front\"";
        let text = PAPER.replace(side, &format!("{side}\npdof      = \"{hour} o'clock\""));
        let analysis = analysis(reconstruct, &text);
        assert_eq!(raises(&analysis, "pdof-differs"), differs, "{hour}");
        assert_eq!(raises(&analysis, "rotation-opposes"), !turns, "{hour}");
        let first = check(&analysis, "rotation").unwrap();
        let p = analysis.impact.as_ref().unwrap().outcome.impulse_vector;
        let expected = 6.3 * 0.3048 * f64::hypot(p.x, p.y) * arm(best);
        assert!((first.value - expected).abs() < 1e-6, "{hour}: {} {expected}", first.value);
    }
}

/// Head-on with equal masses, W_n = m v² (1−e²) for both together, and E = 108,300 J.
#[test]
fn the_normal_work_has_to_be_the_crush_energy() {
    let energy = 2.0 * 54_150.0;
    for (share, passed) in [(0.89, false), (0.91, true), (1.0, true), (1.09, true), (1.11, false)] {
        let restitution: f64 = 0.2;
        let speed = (share * energy / (1500.0 * (1.0 - restitution * restitution))).sqrt();
        let analysis = analysis(impact, &head_on([0.0, 0.0], speed, restitution));
        let check = check(&analysis, "damage-energy").unwrap();
        assert!((check.value - f64::abs(share - 1.0)).abs() < 1e-9, "{check:?}");
        assert_eq!(check.passed(), passed, "{share}");
        let expected: Vec<_> =
            analysis.warnings.iter().filter(|w| matches!(w, Warning::DamageEnergyDiffers { .. })).collect();
        assert_eq!(expected.is_empty(), passed);
    }
    // Twice the speed with e = 0.2: E on one basis is E (1 − e²) or E/(1 − e²) on the other.
    for (basis, of_basis, on_other) in
        [("dissipated", Basis::Dissipated, energy * 0.96), ("absorbed", Basis::Absorbed, energy)]
    {
        let text = head_on([0.0, 0.0], 20.0, 0.2)
            + &format!("[reconstruct]\nfind = \"vehicle1.speed\"\nenergy_basis = \"{basis}\"\n");
        let warnings = analysis(impact, &text).warnings;
        let found = warnings.iter().find_map(|warning| match warning {
            Warning::DamageEnergyDiffers { basis, on_other_basis, .. } => Some((*basis, (*on_other_basis)?)),
            _ => None,
        });
        let (basis, on_other_basis) = found.unwrap();
        assert_eq!(basis, of_basis);
        assert!((on_other_basis - on_other).abs() < 1e-6, "{on_other_basis}");
    }
    // A speed that was found from the energy agrees with it by construction: no check.
    assert_eq!(check(&analysis(reconstruct, PAPER), "damage-energy"), None);
}

/// The GMC Jimmy is struck 22.4° to the right of its axis: a force from more than 22.4° to the right passes
/// the CG on the other side.
#[test]
fn the_line_of_action_has_to_turn_the_vehicle_as_the_impact_does() {
    let given = |degrees: f64| {
        let side = "side      = \"front\"";
        assert_eq!(PAPER.matches(side).count(), 1);
        PAPER.replace(side, &format!("{side}\npdof      = \"{degrees} deg\""))
    };
    for (degrees, passed) in [(2.0, true), (22.3, true), (22.5, false), (40.0, false)] {
        let analysis = analysis(reconstruct, &given(degrees));
        let rotations: Vec<Check> =
            analysis.checks.iter().copied().filter(|check| check.code() == "rotation").collect();
        let [first, second] = rotations[..] else { panic!("{rotations:?}") };
        assert_eq!(first.quantity, CheckedQuantity::Rotation { vehicle: VehicleId::One });
        assert_eq!(second.quantity, CheckedQuantity::Rotation { vehicle: VehicleId::Two });
        // The opposite direction is compared with the Altima's rotation, too.
        assert_eq!((first.passed(), second.passed()), (passed, true), "{degrees}");
        // |r × P| = d |P| sin(22.4° − PDOF)
        let p = analysis.impact.as_ref().unwrap().outcome.impulse_vector;
        let expected = 6.3 * 0.3048 * f64::hypot(p.x, p.y) * (22.4 - degrees).to_radians().sin();
        assert!((first.value - expected).abs() < 1e-6, "{} {expected}", first.value);
        assert_eq!(raises(&analysis, "rotation-opposes"), !passed);
    }
}

/// I ΔΩ = r × P: with the computed line of action alone the check could not fail, and a court would read a
/// proof into it.
#[test]
fn rotation_is_checked_only_against_what_could_contradict_it() {
    let rotations = |text: &str| {
        let analysis = analysis(reconstruct, text);
        analysis.checks.iter().filter(|check| check.code() == "rotation").count()
    };
    assert_eq!(rotations(PAPER), 0);
    let tangential = "tangential  = \"critical\"";
    assert_eq!(PAPER.matches(tangential).count(), 1);
    let with_moment = PAPER.replace(tangential, &format!("{tangential}\nmoment_restitution = -0.5"));
    assert_eq!(rotations(&with_moment), 2);
}

#[test]
fn restitution_has_to_be_in_range() {
    // Both at 7 m/s close at 14 m/s, both at 8 m/s at 16 m/s. At 14 m/s every restitution up to 1 is
    // possible.
    for (speed, restitution, passed) in
        [(7.0, 0.35, None), (7.0, 0.95, None), (8.0, 0.35, Some(false)), (8.0, 0.3, Some(true))]
    {
        let analysis = analysis(impact, &head_on([0.0, 0.0], speed, restitution));
        let check = check(&analysis, "restitution");
        assert_eq!(check.map(|check| check.passed()), passed);
        assert!(check.is_none_or(|check| check.value == restitution));
        assert_eq!(raises(&analysis, "high-restitution"), passed == Some(false));
    }
}

/// A turn a second, half of all restitutions, a factor of four: errors beyond these exclude nothing.
#[test]
fn a_limit_beyond_all_that_happens_is_no_test() {
    let of = |quantity, limit| Check { quantity, value: 0.5, limit }.can_fail();
    let turn = CheckedQuantity::MomentumYawRate { vehicle: VehicleId::One, implied: 0.0, told: 0.5 };
    // A turn a second.
    assert!(of(turn, 6.2) && !of(turn, 6.3));
    let energy = |normal_work: f64, crush_energy: f64| CheckedQuantity::MomentumEnergy {
        normal_work,
        crush_energy,
        tangential_share: 0.0,
    };
    // A factor of four, in either direction.
    assert!(of(energy(2.0, 1.0), 2.9) && !of(energy(2.0, 1.0), 3.1));
    assert!(of(energy(1.0, 2.0), 0.74) && !of(energy(1.0, 2.0), 0.76));
    let bounce = CheckedQuantity::MomentumRestitution { implied: 0.6, given: 0.1 };
    assert!(of(bounce, 0.49) && !of(bounce, 0.51));
}
