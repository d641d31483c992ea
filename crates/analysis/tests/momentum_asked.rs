//! Momentum problems as they are usually posed: one speed known, a common velocity, a fixed object; compared
//! with printed textbook and web cases and hand calculations.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use analysis::quantities::SPEED;
use analysis::{
    Analysis, BothMethod, CheckedQuantity, NoEvidence, QUANTITIES, Sweep, Values, compare, impact, judge,
    quantity, reconstruct, sensitivity,
};
use case::{Axes, Case, CaseFile, Geometry, Purpose};
use pim_core::VehicleId;

const G: f64 = 9.80665;
const MPH: f64 = 0.44704;
const KMH: f64 = 1.0 / 3.6;

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

fn answer(text: &str) -> Analysis {
    reconstruct(&read(text)).unwrap_or_else(|failure| panic!("{failure}\n{text}"))
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// The value of a row, in the collision or of a vehicle.
fn value(analysis: &Analysis, key: &str, vehicle: usize) -> Option<f64> {
    match quantity(key).unwrap().values(&analysis.seen(Axes::ZUp)) {
        Values::Shared(value) => value,
        Values::Pair(pair) => pair[vehicle],
    }
}

/// Two cars in line, of which one stood or had the given speed.
fn in_line(masses: [&str; 2], known: &str, after: [&str; 2]) -> String {
    format!(
        "[vehicle1]\nmass = \"{}\"\nheading = \"0 deg\"\nafter = {{ speed = \"{}\", direction = \"0 deg\" }}\n\
         [vehicle2]\nmass = \"{}\"\nheading = \"0 deg\"\nspeed = \"{known}\"\n\
         after = {{ speed = \"{}\", direction = \"0 deg\" }}\n[reconstruct]\nfind = \"vehicle1.speed\"\n",
        masses[0], after[0], masses[1], after[1]
    )
}

/// tarorigin.com, Inline, collision 1: 3000 lb into a standing 4000 lb, both skid 66 ft at 0.65; 83.59 mph,
/// ΔV 47.8 and 35.8 mph. Neither yaw inertia, contact points nor an impact law change that.
const STANDING: &str = r#"
[scene]
contact = { x = "0 ft", y = "0 ft" }
[surface]
friction = 0.65
[vehicle1]
weight = "3000 lb"
heading = "0 deg"
class = 3
contact = { x = "7 ft", y = "0 ft" }
[vehicle1.after]
drag = "locked"
rest = { x = "59 ft", y = "0 ft", heading = "0 deg" }
[vehicle2]
weight = "4000 lb"
heading = "0 deg"
speed = "0 mph"
class = 4
contact = { x = "-7 ft", y = "0 ft" }
[vehicle2.after]
drag = "locked"
rest = { x = "73 ft", y = "0 ft", heading = "0 deg" }
[impact]
crush_plane = "0 deg"
restitution = 0
tangential = "critical"
[reconstruct]
find = "vehicle1.speed"
"#;

#[test]
fn a_standing_car_struck_in_line_needs_no_crush() {
    let without_law =
        STANDING.split("[impact]").next().unwrap().to_owned() + "[reconstruct]\nfind = \"vehicle1.speed\"\n";
    let undamaged = STANDING.replace("class = 3", "class = 3\ncrush = \"none\"");
    let undamaged = undamaged.replace("class = 4", "class = 4\ncrush = \"none\"");
    for (text, geometry) in [
        (STANDING, Geometry::Given),
        (undamaged.as_str(), Geometry::Given),
        (without_law.as_str(), Geometry::PointMasses),
    ] {
        let analysis = answer(text);
        let both = analysis.both.as_ref().unwrap();
        assert_eq!(both.geometry, geometry);
        assert_eq!(both.method, BothMethod::MomentumAndSpeed { given: VehicleId::Two });
        assert_near(both.speeds[0] / MPH, 83.59, 0.01);
        assert_eq!(both.speeds[1], 0.0);
        assert_near(both.delta_v[0] / MPH, 47.8, 0.05);
        assert_near(both.delta_v[1] / MPH, 35.8, 0.05);
        assert_eq!(value(&analysis, "found.value", 0), Some(both.speeds[0]));
        // They skidded as far from the same speed: e = 0.
        assert_near(value(&analysis, "impact.restitution", 0).unwrap(), 0.0, 1e-3);
        assert!(analysis.checks.iter().all(analysis::Check::passed), "{:?}", analysis.checks);
        // Without damage there is no ΔV of CRASH3 to compare it with.
        assert!(!analysis.warnings.iter().any(|warning| warning.code() == "delta-v-differs"));
    }
}

/// jiskha.com 1319167806 (79.3 km/h), hibiny.ru (24.1 km/h), quesba.com 229937 (40 mph, an impossible e of
/// 1.5).
#[test]
fn printed_cases_of_one_car_into_another_are_answered() {
    let skidded = (2.0 * 0.4 * G * 4.6_f64).sqrt();
    let left = format!("{skidded} m/s");
    let joined = answer(&in_line(["900 kg", "2400 kg"], "0 km/h", [&left, &left]));
    assert_near(joined.both.as_ref().unwrap().speeds[0] / KMH, 79.3, 0.05);
    assert_near(value(&joined, "impact.restitution", 0).unwrap(), 0.0, 1e-12);
    // E_L = ½ m̄ v²
    let reduced = 900.0 * 2400.0 / 3300.0;
    let speed = skidded * 3300.0 / 900.0;
    assert_near(value(&joined, "impact.energy_loss", 0).unwrap(), 0.5 * reduced * speed * speed, 1e-6);

    let stopped = answer(&in_line(["920 kg", "1540 kg"], "0 m/s", ["0 m/s", "4 m/s"]));
    assert_near(stopped.both.as_ref().unwrap().speeds[0] / KMH, 24.1, 0.05);

    let impossible = answer(&in_line(["3000 lb", "2000 lb"], "30 mph", ["30 mph", "45 mph"]));
    assert_near(impossible.both.as_ref().unwrap().speeds[0] / MPH, 40.0, 1e-9);
    assert_near(value(&impossible, "impact.restitution", 0).unwrap(), 1.5, 1e-9);
    let refuted = impossible.checks.iter().find(|check| !check.passed()).unwrap();
    assert!(
        matches!(refuted.quantity, CheckedQuantity::PossibleRestitution { implied } if (implied - 1.5).abs() < 1e-9)
    );
    assert!(impossible.warnings.iter().any(|warning| warning.code() == "momentum-differs"));
}

/// physicsinventions.com: 2674 kg skids 30 m, hits a standing 1100 kg, 12.25 m together; μ = 0.859 is the
/// mean that the source uses of both vehicles; 73.0 km/h at the impact and 109.0 where the skid begins.
#[test]
fn a_skid_before_the_impact_adds_to_the_speed_by_momentum() {
    // V² = 2 μ g S of the joined vehicles, with the friction weighted by mass.
    let friction = (2674.0 * 0.758 + 1100.0 * 0.882) / 3774.0;
    let left = format!("{} m/s", (2.0 * friction * G * 12.25_f64).sqrt());
    let text = in_line(["2674 kg", "1100 kg"], "0 km/h", [&left, &left]).replace(
        "[vehicle2]",
        "[vehicle1.before]\nskid = { length = \"30 m\", friction = 0.859 }\n[vehicle2]",
    );
    let analysis = answer(&text.replace("0.859", "0.8588"));
    let speed = analysis.both.as_ref().unwrap().speeds[0];
    assert_near(speed, (2.0 * friction * G * 12.25_f64).sqrt() * 3774.0 / 2674.0, 1e-9);
    let skid = analysis.skids[0].unwrap().speed;
    assert_near(skid, (speed * speed + 2.0 * 0.8588 * G * 30.0).sqrt(), 1e-9);
}

/// physicsforums.com 139983: 1135 kg west, 1300 kg north, stuck, 19.8 m/s at 150°: 132.5 and 66.8 km/h; the
/// loss is ½ Σ m v² − ½ M V².
const STUCK: &str = r#"
[vehicle1]
class = 3
contact = { x = "2 m", y = "0 m" }
mass = "1135 kg"
heading = "180 deg"
after = { speed = "19.80 m/s", direction = "150 deg", yaw_rate = "0 deg/s" }
[vehicle2]
class = 3
contact = { x = "2 m", y = "0 m" }
mass = "1300 kg"
heading = "90 deg"
after = { speed = "19.80 m/s", direction = "150 deg", yaw_rate = "0 deg/s" }
[impact]
crush_plane = "45 deg"
restitution = 0
tangential = "critical"
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#;

/// (m/s) both speeds and ΔV of that case, by hand.
fn stuck() -> ([f64; 2], [f64; 2], f64) {
    let (sin, cos) = 150_f64.to_radians().sin_cos();
    let [px, py] = [2435.0 * 19.8 * cos, 2435.0 * 19.8 * sin];
    let speeds = [-px / 1135.0, py / 1300.0];
    let [vx, vy] = [19.8 * cos, 19.8 * sin];
    let delta_v = [(vx + speeds[0]).hypot(vy), vx.hypot(vy - speeds[1])];
    let loss = 0.5 * (1135.0 * speeds[0] * speeds[0] + 1300.0 * speeds[1] * speeds[1] - 2435.0 * 19.8 * 19.8);
    (speeds, delta_v, loss)
}

#[test]
fn known_yaw_rates_give_restitution_and_loss() {
    let (speeds, _, loss) = stuck();
    assert_near(loss, 514_205.0, 1.0);
    let analysis = answer(STUCK);
    let both = analysis.both.as_ref().unwrap();
    for i in [0, 1] {
        assert_near(both.speeds[i], speeds[i], 1e-9);
    }
    assert!(both.implied.is_yaw_known);
    for key in ["momentum.restitution", "impact.restitution"] {
        assert_near(value(&analysis, key, 0).unwrap(), 0.0, 1e-12);
    }
    for key in ["momentum.energy_loss", "impact.energy_loss"] {
        assert_near(value(&analysis, key, 0).unwrap(), loss, 1e-6);
    }
    assert!(!analysis.checks.iter().any(|check| {
        matches!(check.quantity, CheckedQuantity::MomentumRestitution { .. }) && !check.passed()
    }));
    // One velocity of both CGs means the same without yaw rates: one body that did not turn.
    let unturned = STUCK.replace(", yaw_rate = \"0 deg/s\"", "");
    let joined = answer(&unturned);
    assert!(joined.both.as_ref().unwrap().one_velocity && !analysis.both.as_ref().unwrap().one_velocity);
    for stuck in [&analysis, &joined] {
        assert_near(value(stuck, "impact.restitution", 0).unwrap(), 0.0, 1e-12);
        assert_near(value(stuck, "impact.energy_loss", 0).unwrap(), loss, 1e-6);
        assert!(stuck.checks.iter().all(analysis::Check::passed), "{:?}", stuck.checks);
    }
    // With two velocities both are free to turn, and that is stated.
    let free = answer(&unturned.replacen("19.80 m/s", "19.81 m/s", 1));
    assert!(!free.both.as_ref().unwrap().implied.is_yaw_known);
    assert_near(value(&free, "momentum.restitution", 0).unwrap(), 0.9118, 2e-3);
}

#[test]
fn a_quantity_has_one_value() {
    let (speeds, delta_v, loss) = stuck();
    let analysis = answer(STUCK);
    for i in [0, 1] {
        assert_near(value(&analysis, "speed", i).unwrap(), speeds[i], 1e-9);
        assert_near(value(&analysis, "delta_v", i).unwrap(), delta_v[i], 1e-9);
        assert_near(value(&analysis, "final_speed", i).unwrap(), 19.8, 1e-12);
        assert_eq!(value(&analysis, "final_yaw_rate", i), Some(0.0));
        let parts = ["delta_v_longitudinal", "delta_v_lateral"].map(|key| value(&analysis, key, i).unwrap());
        assert_near(parts[0].hypot(parts[1]), delta_v[i], 1e-9);
        let scene = ["delta_v.x", "delta_v.y"].map(|key| value(&analysis, key, i).unwrap());
        assert_near(scene[0].hypot(scene[1]), delta_v[i], 1e-9);
    }
    // A quantity with a key of momentum and one without has the same value under both.
    let twice = QUANTITIES.iter().filter_map(|row| {
        let key = row.key.strip_prefix("momentum.")?;
        Some((row.key, [key.to_owned(), format!("impact.{key}")].into_iter().find_map(|key| quantity(&key))?))
    });
    let mut compared = 0;
    for (key, plain) in twice {
        // This one is the yaw rate that the impulse at C would give, a check.
        if key == "momentum.final_yaw_rate" {
            continue;
        }
        for i in [0, 1] {
            assert_eq!(value(&analysis, key, i), value(&analysis, plain.key, i), "{key}");
        }
        compared += 1;
    }
    assert!(compared >= 8, "{compared}");
    // The impact by the law at the same speeds is another collision, and a check.
    let law = analysis.law_check().unwrap();
    assert!((law.outcome.delta_v_magnitude()[0] - delta_v[0]).abs() > 5.0);
    assert!((law.outcome.energy.loss - loss).abs() > 1e5);
    assert!(impact_by_crush().law_check().is_none());
}

/// A rear-end collision whose impact is the law's.
fn impact_by_crush() -> Analysis {
    answer(include_str!("../../../fixtures/rear-end-rest.toml"))
}

#[test]
fn vehicles_locked_together_need_one_way_out() {
    let (speeds, _, loss) = stuck();
    let locked = |text: &str| format!("[scene]\nlocked_together = true\n{text}");
    // Of point masses.
    let bare = r#"
[vehicle1]
mass = "1135 kg"
heading = "180 deg"
after = { speed = "19.80 m/s", direction = "150 deg" }
[vehicle2]
mass = "1300 kg"
heading = "90 deg"
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#;
    let analysis = answer(&locked(bare));
    assert_eq!(analysis.both.as_ref().unwrap().geometry, Geometry::PointMasses);
    for i in [0, 1] {
        assert_near(analysis.both.as_ref().unwrap().speeds[i], speeds[i], 1e-9);
    }
    assert_near(value(&analysis, "impact.energy_loss", 0).unwrap(), loss, 1e-6);
    assert_near(value(&analysis, "impact.restitution", 0).unwrap(), 0.0, 1e-12);
    assert!(value(&analysis, "impact.tangential_work", 0).is_none());
    // Without the key, the other vehicle's departure is missing, and the message names the key.
    let error = reconstruct(&read(bare)).unwrap_err().to_string();
    assert!(error.contains("vehicle2.after.rest"), "{error}");
    let advice = format!("{:?}", read(bare).two_speeds().unwrap_err());
    assert!(advice.contains("locked_together = true"), "{advice}");

    // With contact points and inertias the common yaw rate follows from the momentum about the common CG.
    let turning = answer(&locked(&STUCK.replace(", yaw_rate = \"0 deg/s\"", "")));
    let both = turning.both.as_ref().unwrap();
    let [w1, w2] = both.momentum.after.map(|departure| departure.yaw_rate.unwrap());
    assert_eq!(w1, w2);
    // CG 1 lies 2 m east of C, CG 2 2 m south of it.
    let [i1, i2] = both.momentum.contact.participants().map(|p| p.body().yaw_inertia());
    let reduced = 1135.0 * 1300.0 / 2435.0;
    let (d, v) = ([2.0, 2.0], [-both.speeds[0], -both.speeds[1]]);
    let moment = reduced * (d[0] * v[1] - d[1] * v[0]);
    assert_near(w1, moment / (i1 + i2 + reduced * 8.0), 1e-9);
    // A rigid body has no velocity at C relative to itself.
    assert_near(value(&turning, "impact.restitution", 0).unwrap(), 0.0, 1e-12);
    assert_near(value(&turning, "impact.tangential_velocity.after", 0).unwrap(), 0.0, 1e-9);
}

/// v_n = −V_n/e where the impulse acts towards the CG: 5 km/h out of a wall with e = 0.1 were 50 km/h into
/// it.
#[test]
fn the_way_out_of_a_wall_tells_the_way_in() {
    let wall = r#"
[vehicle1]
mass = "1500 kg"
heading = "0 deg"
after = { speed = "5 km/h", direction = "180 deg" }
[vehicle2]
fixed = true
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = "critical"
[reconstruct]
find = "vehicle1.speed"
"#;
    let analysis = answer(wall);
    let both = analysis.both.as_ref().unwrap();
    assert_eq!(both.method, BothMethod::Wall { vehicle: VehicleId::One, restitution: 0.1 });
    assert_near(both.speeds[0] / KMH, 50.0, 1e-9);
    assert_near(both.delta_v[0] / KMH, 55.0, 1e-9);
    assert_near(
        value(&analysis, "impact.energy_loss", 0).unwrap(),
        750.0 * (50.0_f64.powi(2) - 25.0) * KMH * KMH,
        1e-6,
    );
    assert!(value(&analysis, "delta_v", 1).is_none());
    // The wall may be vehicle 1, and stand at an angle to the heading: v cos 30° = 0.1⁻¹ V cos 30°.
    let oblique = wall.replace("crush_plane = \"0 deg\"", "crush_plane = \"30 deg\"");
    assert_near(answer(&oblique).both.unwrap().speeds[0] / KMH, 50.0, 1e-9);
    let swapped =
        wall.replace("vehicle1", "vehicleX").replace("vehicle2", "vehicle1").replace("vehicleX", "vehicle2");
    assert_near(answer(&swapped).both.unwrap().speeds[1] / KMH, 50.0, 1e-9);
    // Sliding sideways into it, the vehicle has the speed with which it leaves an impact like that.
    let sideways = r#"
[vehicle1]
mass = "1500 kg"
yaw_inertia = "2500 kg m^2"
heading = "0 deg"
contact = { x = "2 m", y = "0.3 m" }
sideslip = "30 deg"
speed = "12 m/s"
[vehicle2]
fixed = true
[impact]
crush_plane = "170 deg"
restitution = 0.3
tangential = { ratio = 0.0 }
"#;
    let left = impact(&read(sideways)).unwrap().impact.unwrap().outcome.after[0].velocity;
    let (speed, direction) = (left.norm(), left.y.atan2(left.x).to_degrees());
    let back = sideways.replace(
        "speed = \"12 m/s\"\n",
        &format!("after = {{ speed = \"{speed} m/s\", direction = \"{direction} deg\" }}\n"),
    ) + "[reconstruct]\nfind = \"vehicle1.speed\"\n";
    assert_near(answer(&back).both.unwrap().speeds[0], 12.0, 1e-9);
    // Without rebound the departure gives no speed, and a departure through the wall is impossible.
    let plastic = wall.replace("restitution = 0.1", "restitution = 0");
    let error = reconstruct(&read(&plastic)).unwrap_err().to_string();
    assert!(error.contains("hardly depends on the speed before"), "{error}");
    let through = wall.replace("direction = \"180 deg\"", "direction = \"0 deg\"");
    let error = reconstruct(&read(&through)).unwrap_err().to_string();
    assert!(error.contains("does not point into the object"), "{error}");
}

/// A known speed with crossing paths: one equation is left over, and is a check.
#[test]
fn across_the_heading_of_the_sought_vehicle_momentum_is_a_check() {
    let crossing = |known: &str| {
        format!(
            "[vehicle1]\nmass = \"1500 kg\"\nheading = \"0 deg\"\nafter = {{ speed = \"8 m/s\", direction = \"30 deg\" }}\n\
             [vehicle2]\nmass = \"1000 kg\"\nheading = \"90 deg\"\nspeed = \"{known}\"\n\
             after = {{ speed = \"9 m/s\", direction = \"20 deg\" }}\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
        )
    };
    let (along, across) = (
        1500.0 * 8.0 * 30_f64.to_radians().cos() + 1000.0 * 9.0 * 20_f64.to_radians().cos(),
        1500.0 * 8.0 * 30_f64.to_radians().sin() + 1000.0 * 9.0 * 20_f64.to_radians().sin(),
    );
    for (known, passes) in [(across / 1000.0, true), (across / 1000.0 - 8.0, false)] {
        let analysis = answer(&crossing(&format!("{known} m/s")));
        assert_near(analysis.both.as_ref().unwrap().speeds[0], along / 1500.0, 1e-9);
        let check = analysis
            .checks
            .iter()
            .find(|check| matches!(check.quantity, CheckedQuantity::MomentumAcross { .. }))
            .unwrap();
        assert_near(check.value, across - 1000.0 * known, 1e-9);
        assert_eq!(check.passed(), passes, "{check:?}");
    }
}

/// A known velocity off the heading is the same as its speed with a sideslip. By hand, along x, of cars of
/// one mass: v_1 + 2 = 10 cos 30° + 10 cos 60°.
#[test]
fn a_known_velocity_off_the_heading_counts_with_its_direction() {
    let of = |known: &str| {
        answer(&format!(
            "[vehicle1]\nmass = \"1500 kg\"\nheading = \"0 deg\"\nafter = {{ speed = \"10 m/s\", direction = \"30 deg\" }}\n\
             [vehicle2]\nmass = \"1500 kg\"\nheading = \"90 deg\"\n{known}\n\
             after = {{ speed = \"10 m/s\", direction = \"60 deg\" }}\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
        ))
        .both
        .unwrap()
        .speeds
    };
    let [found, known] = of("velocity = { x = \"2 m/s\", y = \"10 m/s\" }");
    assert_near(found, 5.0 * 3.0_f64.sqrt() + 3.0, 1e-9);
    assert_near(known, 104.0_f64.sqrt(), 1e-12);
    // tan β = −2/10
    let slip = format!("speed = \"{} m/s\"\nsideslip = \"{} deg\"", known, -(0.2_f64.atan().to_degrees()));
    assert_near(of(&slip)[0], found, 1e-9);
}

#[test]
fn no_vehicle_is_faster_than_the_limit() {
    // Momentum of a car in a vehicle of a gram, in both ways of asking.
    let tiny = in_line(["0.001 kg", "1280 kg"], "0 m/s", ["5 m/s", "5 m/s"]);
    let crossing = STUCK.replace("1135 kg", "0.001 kg");
    for text in [tiny.as_str(), crossing.as_str()] {
        let error = reconstruct(&read(text)).unwrap_err().to_string();
        assert!(error.contains("no vehicle is faster than 1000 m/s"), "{error}");
    }
}

#[test]
fn what_is_missing_or_contradicts_is_said() {
    let text = in_line(["900 kg", "2400 kg"], "0 km/h", ["6 m/s", "6 m/s"]);
    // Both sought in line without crush: the message names the known speed as the solution.
    let both = text.replace("find = \"vehicle1.speed\"", "find = [\"vehicle1.speed\", \"vehicle2.speed\"]");
    let advice = format!("{:?}", read(&both).two_speeds().unwrap_err());
    assert!(advice.contains("find = \\\"vehicle1.speed\\\"` is enough"), "{advice}");
    // Neither crush nor a departure: the help mentions momentum.
    let nothing = text.replace("after = { speed = \"6 m/s\", direction = \"0 deg\" }\n", "");
    let advice = format!("{:?}", read(&nothing).reconstruction().unwrap_err());
    assert!(advice.contains("without damage data momentum gives the speed"), "{advice}");
    let judged = judge(&read(&text));
    assert!(
        judged
            .abilities
            .iter()
            .any(|ability| { ability.purpose == Purpose::Reconstruct && ability.obstacle.is_none() })
    );
}

/// v_1 = (m_1 + m_2)/m_1 V with one velocity after: ∂v_1/∂V_1 = 1, ∂v_1/∂V_2 = m_2/m_1.
#[test]
fn derivatives_and_evidence_know_momentum_alone() {
    let case = read(&in_line(["900 kg", "2400 kg"], "0 km/h", ["6 m/s", "6 m/s"]));
    let found = sensitivity(&case, Sweep::default()).unwrap();
    let by = |path: &str| {
        let of_speed = found
            .derivatives
            .iter()
            .filter(|derivative| derivative.output == SPEED.of_vehicle(VehicleId::One));
        of_speed.into_iter().find(|derivative| derivative.input.path == path).unwrap().value
    };
    assert_near(by("vehicle1.after.speed"), 1.0, 1e-12);
    assert_near(by("vehicle2.after.speed"), 2400.0 / 900.0, 1e-12);
    assert_near(by("vehicle2.mass"), 6.0 / 900.0, 1e-12);
    let evidence = compare(&case).unwrap().evidence.unwrap();
    assert!(evidence.crush_energy.is_none() && matches!(evidence.damage, Err(NoEvidence::NoDamage)));
    assert_near(evidence.momentum.unwrap().speeds.unwrap()[0], 22.0, 1e-12);
}
