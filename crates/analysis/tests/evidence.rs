//! The results of damage, momentum and both together, for collisions that are worked by hand.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![allow(clippy::disallowed_methods, reason = "the standard library is the independent witness")]

use analysis::{ByEvidence, EvidenceAnswer, EvidenceMethod, NoEvidence, compare};
use case::CaseFile;
use pim_core::VehicleId;

fn evidence(text: &str) -> Option<ByEvidence> {
    let file = CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    compare(&file.case).unwrap().evidence
}

fn close(what: &str, actual: f64, expected: f64) {
    assert!((actual - expected).abs() < 1e-6, "{what}: {actual} is not {expected}");
}

fn close_pair(what: &str, actual: [f64; 2], expected: [f64; 2]) {
    for i in 0..2 {
        close(what, actual[i], expected[i]);
    }
}

fn close_to(what: &str, actual: [f64; 2], expected: [f64; 2], within: f64) {
    for i in 0..2 {
        assert!((actual[i] - expected[i]).abs() < within, "{what}: {actual:?} is not {expected:?}");
    }
}

const ONE: &str = "\"vehicle1.speed\"";
const BOTH: &str = "[\"vehicle1.speed\", \"vehicle2.speed\"]";

/// 1500 kg at 20 m/s run into 1000 kg at 5 m/s in line, with e = 0.2. By hand:
///
/// m = 1500·1000/2500 = 600 kg, P = 1.2·600·15 = 10,800 N·s, ΔV = 7.2 and 10.8 m/s, so that they leave at
/// 12.8 and 15.8 m/s; W_n = ½·600·(1 − 0.04)·15² = 64,800 J, which is `times` the crush energy.
fn in_line(find: &str, basis: &str, times: f64, speed_2: &str) -> String {
    let ees = (2.0 * 64_800.0 * times / 1500.0_f64).sqrt();
    format!(
        r#"
[vehicle1]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
heading = "30 deg"
contact = {{ x = "2 m", y = "0 m" }}
crush = {{ ees = "{ees:?} m/s" }}
[vehicle1.after]
speed = "12.8 m/s"
direction = "30 deg"
[vehicle2]
mass = "1000 kg"
yaw_inertia = "1500 kg m^2"
heading = "30 deg"
contact = {{ x = "-2 m", y = "0 m" }}
crush = "none"
{speed_2}
[vehicle2.after]
speed = "15.8 m/s"
direction = "30 deg"
[impact]
crush_plane = "210 deg"
restitution = 0.2
tangential = "critical"
[reconstruct]
find = {find}
energy_basis = "{basis}"
"#
    )
}

const FIVE: &str = "speed = \"5 m/s\"";

fn answers(evidence: &ByEvidence) -> [&EvidenceAnswer; 3] {
    [&evidence.damage, &evidence.momentum, &evidence.together].map(|answer| answer.as_ref().unwrap())
}

/// Evidence that agrees gives the same collision, whatever is used.
#[test]
fn all_evidence_of_one_collision_gives_it() {
    // The crush energy of a case is ½ m EES², absorbed with e² of it given back: E = W_n/(1 − e²).
    for (basis, times) in [("dissipated", 1.0), ("absorbed", 1.0 / 0.96)] {
        let evidence = evidence(&in_line(ONE, basis, times, FIVE)).unwrap();
        close("measured", evidence.crush_energy.unwrap(), 64_800.0 * times);
        for answer in answers(&evidence) {
            close_pair("speeds", answer.speeds.unwrap(), [20.0, 5.0]);
            close_pair("ΔV", answer.delta_v, [7.2, 10.8]);
            close("closing speed", answer.closing_speed.unwrap(), 15.0);
            close("crush energy needed", answer.crush_energy.unwrap(), 64_800.0 * times);
            close("energy loss", answer.energy_loss.unwrap(), 64_800.0);
        }
        let by = answers(&evidence).map(|answer| answer.by);
        let given = VehicleId::Two;
        assert_eq!(
            by,
            [
                EvidenceMethod::DamageAndSpeed { given },
                EvidenceMethod::MomentumAndSpeed { given },
                EvidenceMethod::MomentumAndDamage
            ]
        );
    }
}

/// Four times the crush energy is twice the closing speed: 30 m/s. The damage adds it to 5 m/s; momentum does
/// not use it; together they divide 30 m/s so that 1500 v_1 + 1000 v_2 = 35,000 N·s.
#[test]
fn evidence_that_disagrees_is_told_apart() {
    let evidence = evidence(&in_line(ONE, "dissipated", 4.0, FIVE)).unwrap();
    let [damage, momentum, together] = answers(&evidence);
    close_pair("damage", damage.speeds.unwrap(), [35.0, 5.0]);
    close_pair("damage, ΔV", damage.delta_v, [14.4, 21.6]);
    close_pair("momentum", momentum.speeds.unwrap(), [20.0, 5.0]);
    close_pair("momentum, ΔV", momentum.delta_v, [7.2, 10.8]);
    close("momentum needs", momentum.crush_energy.unwrap(), 64_800.0);
    close_pair("together", together.speeds.unwrap(), [26.0, -4.0]);
    close_pair("together, ΔV", together.delta_v, [14.4, 21.6]);
}

/// Without a speed, the damage gives the closing speed, and momentum does not separate the speeds; if one is
/// given although both are sought, either method uses it.
#[test]
fn in_line_momentum_or_damage_alone_need_a_speed() {
    let without = evidence(&in_line(BOTH, "dissipated", 1.0, "")).unwrap();
    let damage = without.damage.as_ref().unwrap();
    assert_eq!((damage.by, damage.speeds), (EvidenceMethod::DamageAlongLine, None));
    close_pair("ΔV", damage.delta_v, [7.2, 10.8]);
    close("closing speed", damage.closing_speed.unwrap(), 15.0);
    assert!(matches!(without.momentum, Err(NoEvidence::NeedsSpeed { angle }) if angle.abs() < 1e-12));
    close_pair("together", without.together.unwrap().speeds.unwrap(), [20.0, 5.0]);

    let given = evidence(&in_line(BOTH, "dissipated", 1.0, FIVE)).unwrap();
    for answer in answers(&given) {
        close_pair("speeds", answer.speeds.unwrap(), [20.0, 5.0]);
    }
}

/// 1500 kg at 20 m/s along x and 1000 kg at 15 m/s along y; P = (−9,000, 6,000) N·s on vehicle 1 takes them
/// to (14, 4) and (9, 9). The same with y to the right where `side` is −1.
fn crossing(axes: &str, side: f64, pdof: &str) -> String {
    let angle = |y: f64, x: f64| (side * y.atan2(x)).to_degrees();
    format!(
        r#"
[scene]
axes = "{axes}"
[vehicle1]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
heading = "0 deg"
contact = {{ x = "2 m", y = "0 m" }}
crush = {{ ees = "8 m/s" {pdof} }}
[vehicle1.after]
speed = "{:?} m/s"
direction = "{:?} deg"
[vehicle2]
mass = "1000 kg"
yaw_inertia = "1500 kg m^2"
heading = "{} deg"
contact = {{ x = "0 m", y = "{} m" }}
crush = {{ ees = "6 m/s" }}
[vehicle2.after]
speed = "{:?} m/s"
direction = "{:?} deg"
[impact]
crush_plane = "180 deg"
restitution = 0.1
tangential = "critical"
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#,
        14.0_f64.hypot(4.0),
        angle(4.0, 14.0),
        90.0 * side,
        0.9 * side,
        9.0_f64.hypot(9.0),
        angle(9.0, 9.0),
    )
}

/// Momentum before (30,000, 15,000) N·s; after (21,000 + 9,000, 6,000 + 9,000).
#[test]
fn where_the_approaches_cross_momentum_gives_both_and_the_damage_a_change() {
    for (axes, side) in [("z-up", 1.0), ("z-down", -1.0)] {
        let found = evidence(&crossing(axes, side, "")).unwrap();
        let momentum = found.momentum.as_ref().unwrap();
        assert_eq!(momentum.by, EvidenceMethod::Momentum);
        close_pair("speeds", momentum.speeds.unwrap(), [20.0, 15.0]);
        // ΔV = (−6, 4) and (9, −6)
        close_pair("ΔV", momentum.delta_v, [52.0_f64.sqrt(), 117.0_f64.sqrt()]);
        // ½·1500·8² + ½·1000·6² J
        close("measured", found.crush_energy.unwrap(), 66_000.0);
        let damage = found.damage.as_ref().unwrap();
        assert_eq!((damage.by, damage.speeds), (EvidenceMethod::Crash3 { pdof_is_given: false }, None));
        // Momentum is kept in CRASH3 too.
        close("m ΔV", 1500.0 * damage.delta_v[0], 1000.0 * damage.delta_v[1]);
        // By a search on ever finer grids in another language, with 12 %, 8° and √(0.521² + 0.405²) in ln E.
        let together = found.together.as_ref().unwrap();
        assert!(
            matches!(together.by, EvidenceMethod::Weighed { apart, .. } if (apart - 0.848_197).abs() < 1e-6)
        );
        close_to("speeds", together.speeds.unwrap(), [19.452_739, 15.088_372], 2e-6);
        close_to("ΔV", together.delta_v, [8.957_819, 13.436_728], 2e-6);
        close_to("crush energy needed", [together.crush_energy.unwrap(); 2], [112_387.49; 2], 0.05);
        close_to("energy loss", [together.energy_loss.unwrap(); 2], [142_290.16; 2], 0.05);
        // The closing speed is that of vehicle 1 along x.
        close_to("closing speed", [together.closing_speed.unwrap(); 2], [19.452_739; 2], 2e-6);
        let given = evidence(&crossing(axes, side, ", pdof = \"20 deg\"")).unwrap();
        assert_eq!(given.damage.unwrap().by, EvidenceMethod::Crash3 { pdof_is_given: true });
    }
}

#[test]
fn a_case_without_one_kind_of_evidence_has_no_choice() {
    let text = in_line(ONE, "dissipated", 1.0, FIVE);
    let after = "[vehicle2.after]\nspeed = \"15.8 m/s\"\ndirection = \"30 deg\"\n";
    let without = text.replace(after, "");
    assert_ne!(without, text);
    assert!(evidence(&without).is_none());

    // Where the approaches cross, both speeds need no damage.
    let text = crossing("z-up", 1.0, "");
    let without = text.replace("crush = { ees = \"6 m/s\" }\n", "");
    assert_ne!(without, text);
    assert!(evidence(&text).is_some() && evidence(&without).is_none());
}

/// Vehicles that are locked together depart with one velocity, so that one departure gives that of both.
#[test]
fn one_departure_of_locked_vehicles_is_that_of_both() {
    // 1500 kg at 20 m/s and 1000 kg at 5 m/s leave at 14 m/s: ½ · 600 · 15² = 67,500 J.
    let text = in_line(ONE, "dissipated", 67_500.0 / 64_800.0, FIVE)
        .replace("12.8 m/s", "14 m/s")
        .replace("restitution = 0.2", "restitution = 0");
    let [one, two] = ["[vehicle1.after]\nspeed = \"14 m/s\"", "[vehicle2.after]\nspeed = \"15.8 m/s\""]
        .map(|after| format!("{after}\ndirection = \"30 deg\"\n"));
    assert!(text.contains(&one) && text.contains(&two));
    let locked = format!("[scene]\nlocked_together = true\n{}", text.replace(&two, ""));
    let found = evidence(&locked).unwrap();
    for answer in answers(&found) {
        close_pair("speeds", answer.speeds.unwrap(), [20.0, 5.0]);
    }
    assert!(evidence(&text.replace(&two, "")).is_none());
}

/// A known velocity is the same evidence in each of its forms, and so is one backward. Along the line of
/// vehicle 1, which leaves with 1500 · 12.8 + 1000 · 15.8 = 35,000 N·s, vehicle 2 at 5 m/s off by 6° has
/// 5 cos 6° m/s.
#[test]
fn a_velocity_is_a_speed_with_a_direction() {
    for off in [0.0_f64, 6.0] {
        for speed in [5.0_f64, -5.0] {
            let (sin, cos) = (30.0 + off).to_radians().sin_cos();
            let vector =
                format!("velocity = {{ x = \"{:?} m/s\", y = \"{:?} m/s\" }}", speed * cos, speed * sin);
            let scalar = format!("speed = \"{speed} m/s\"\nsideslip = \"{off} deg\"");
            let [vector, scalar] =
                [vector, scalar].map(|given| evidence(&in_line(ONE, "dissipated", 1.0, &given)).unwrap());
            for (vector, scalar) in answers(&vector).into_iter().zip(answers(&scalar)) {
                assert_eq!(vector.by, scalar.by);
                close_pair("speeds", vector.speeds.unwrap(), scalar.speeds.unwrap());
                close_pair("ΔV", vector.delta_v, scalar.delta_v);
            }
            let [_, momentum, _] = answers(&vector);
            close("given", momentum.speeds.unwrap()[1], speed);
            if off == 0.0 {
                close("found", momentum.speeds.unwrap()[0], (35_000.0 - 1000.0 * speed) / 1500.0);
            }
        }
    }
}
