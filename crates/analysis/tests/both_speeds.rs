//! Both speeds from rests and velocities after the impact, against hand calculations and the impact itself.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use analysis::quantities::{
    IMPACT_ENERGY_LOSS, IMPACT_MOMENT_WORK, IMPACT_NORMAL_WORK, IMPACT_TANGENTIAL_WORK,
};
use analysis::{
    Analysis, BothMethod, Check, CheckedQuantity, Magnitude, OutputQuantity, TravelOrigin, Warning, impact,
    motion, reconstruct,
};
use case::{Axes, Case, CaseFile};
use pim_core::VehicleId;

const REAR_END: &str = include_str!("../../../fixtures/rear-end-rest.toml");
const G: f64 = 9.80665;

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

fn speeds(analysis: &Analysis) -> [f64; 2] {
    analysis.both.as_ref().unwrap().speeds
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// Neither car spun, so each left straight towards its rest: V = √(2 μ g f S). The contact points are 2.05 m
/// ahead of the one centre of gravity and 2 m behind the other.
#[test]
fn a_rear_end_collision_follows_from_slides_momentum_and_crush() {
    let analysis = reconstruct(&read(REAR_END)).unwrap();
    let ways: [[f64; 2]; 2] = [[2.6 + 2.05, 0.1], [19.0 - 2.0, 0.3]];
    let decelerations = [0.7 * G, 0.25 * G];
    let left: Vec<f64> = (0..2)
        .map(|i| (2.0 * decelerations[i] * (ways[i][0] * ways[i][0] + ways[i][1] * ways[i][1]).sqrt()).sqrt())
        .collect();
    for (i, travel) in analysis.travel.iter().enumerate() {
        let travel = travel.as_ref().unwrap();
        assert_eq!(travel.origin, TravelOrigin::StraightRest);
        // The rolling car turns a little on its path, so that it comes to rest some millimetres off the
        // straight line.
        assert_near(travel.start.motion.velocity.norm(), left[i], 0.005 * left[i]);
    }
    // Momentum along the road, by the velocities that were found.
    let [v1, v2] = speeds(&analysis);
    let along = |i: usize| analysis.travel[i].as_ref().unwrap().start.motion.velocity.x;
    assert_near(1500.0 * v1 + 1300.0 * v2, 1500.0 * along(0) + 1300.0 * along(1), 1e-6);
    // W_n of two masses on one line with e = 0.1, the plane 2° off: the crush energy.
    let reduced = 1500.0 * 1300.0 / 2800.0;
    let energy: f64 = analysis.vehicles.iter().map(|vehicle| vehicle.crush_energy().unwrap()).sum();
    let closing = (2.0 * energy / (reduced * (1.0 - 0.01))).sqrt();
    assert_near(v1 - v2, closing, 0.01 * closing);
    assert!(matches!(analysis.both.unwrap().method, BothMethod::MomentumAndCrush { .. }));
    // A skid of 8 m before the impact: v² + 2 μ g S.
    let skid = analysis.skids[0].unwrap();
    assert_near(skid.speed, (v1 * v1 + 2.0 * 0.7 * G * 8.0).sqrt(), 1e-9);
}

/// Point masses travel along their courses, not along their headings: with equal masses and the velocities V
/// of both at 45°, v_1 cos β_1 = 2 V cos 45° and v_1 sin β_1 + v_2 = 2 V sin 45°.
#[test]
fn point_masses_travel_with_their_sideslip() {
    let at = |sideslip: f64, find: &str, axes: &str| {
        let turned = if axes == "z-down" { -1.0 } else { 1.0 };
        let speed = if find.contains("vehicle2") { "" } else { "speed = \"8.994 m/s\"\n" };
        let text = format!(
            "[scene]\naxes = \"{axes}\"\n[vehicle1]\nmass = \"1000 kg\"\nheading = \"0 deg\"\nsideslip = \"{} deg\"\n\
             [vehicle1.after]\nspeed = \"10 m/s\"\ndirection = \"{a} deg\"\n\
             [vehicle2]\nmass = \"1000 kg\"\nheading = \"{} deg\"\n{speed}\
             [vehicle2.after]\nspeed = \"10 m/s\"\ndirection = \"{a} deg\"\n\
             [reconstruct]\nfind = {find}\n",
            turned * sideslip,
            turned * 90.0,
            a = turned * 45.0
        );
        reconstruct(&read(&text)).unwrap()
    };
    for sideslip in [20.0_f64, 0.0, -35.0] {
        let (sin, cos) = sideslip.to_radians().sin_cos();
        let both = 20.0 * std::f64::consts::FRAC_1_SQRT_2;
        let expected = [both / cos, both - both / cos * sin];
        for axes in ["z-up", "z-down"] {
            let found = speeds(&at(sideslip, "[\"vehicle1.speed\", \"vehicle2.speed\"]", axes));
            for (found, expected) in found.into_iter().zip(expected) {
                assert_near(found, expected, 1e-12 * both);
            }
        }
    }
    // One speed with a known one that fits: no momentum across the course of vehicle 1 is left over.
    let one = at(20.0, "\"vehicle1.speed\"", "z-up");
    assert_near(speeds(&one)[0], 20.0 * std::f64::consts::FRAC_1_SQRT_2 / 20.0_f64.to_radians().cos(), 1e-3);
    assert!(one.checks.iter().all(Check::passed), "{:?}", one.checks);
}

/// A turn of more than 10°, and the rest follows from the motion itself.
#[test]
fn a_vehicle_that_turned_by_more_than_ten_degrees_is_followed_back() {
    for (heading, origin) in [
        ("9.9 deg", TravelOrigin::StraightRest),
        ("-9.9 deg", TravelOrigin::StraightRest),
        ("10.1 deg", TravelOrigin::Rest),
        ("-10.1 deg", TravelOrigin::Rest),
    ] {
        let text = REAR_END.replace("heading = \"-3 deg\"", &format!("heading = \"{heading}\""));
        assert_ne!(text, REAR_END);
        let analysis = motion(&read(&text)).unwrap();
        assert_eq!(analysis.travel[1].as_ref().unwrap().origin, origin, "{heading}");
    }
}

/// An intersection: both speeds are chosen, the impact throws the cars out, and they spin to rest.
const CROSSING: &str = r#"
[scene]
contact = { x = "3 m", y = "-1 m" }
[surface]
friction = 0.7
[vehicle1]
mass = "1500 kg"
class = 3
heading = "0 deg"
speed = "15 m/s"
contact = { x = "2.0 m", y = "0.1 m" }
[vehicle1.after]
drag = 0.15
[vehicle2]
mass = "1300 kg"
class = 2
heading = "90 deg"
speed = "12 m/s"
contact = { x = "0.9 m", y = "0.75 m" }
[vehicle2.after]
drag = 0.15
[impact]
crush_plane = "180 deg"
restitution = 0.1
tangential = { friction = 0.6 }
"#;

/// The rests of the forward run lead back to the speeds that were chosen. The turns are given: a heading
/// alone fits several motions.
#[test]
fn rests_of_an_impact_lead_back_to_its_speeds() {
    let forward = impact(&read(CROSSING)).unwrap();
    let mut text = CROSSING.replace("speed = \"15 m/s\"\n", "").replace("speed = \"12 m/s\"\n", "");
    for (i, travel) in forward.travel.iter().enumerate() {
        let travel = travel.as_ref().unwrap();
        assert_eq!(travel.origin, TravelOrigin::Impact);
        let (at, turned) = (travel.rest.position, travel.rest.heading - travel.start.heading);
        assert!(turned.abs() > 1.0, "{turned}");
        let rest = format!(
            "[vehicle{n}.after]\nrest = {{ x = \"{x} m\", y = \"{y} m\", turned = \"{turned} rad\" }}\n",
            n = i + 1,
            x = at.x,
            y = at.y,
        );
        text = text.replace(&format!("[vehicle{}.after]\n", i + 1), &rest);
    }
    text.push_str("[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n");
    let back = reconstruct(&read(&text)).unwrap();
    assert_eq!(back.both.as_ref().unwrap().method, BothMethod::Momentum);
    let [v1, v2] = speeds(&back);
    assert_near(v1, 15.0, 0.02);
    assert_near(v2, 12.0, 0.02);
    assert!(back.checks.iter().filter(|check| check.is_of_momentum()).all(Check::passed));
}

/// Several motions lead to one rest if only its heading is known, without the full turns. A point on the path
/// of any of them, with the heading there, picks out that motion; if that heading is off, the result shows by
/// how much.
#[test]
fn a_point_with_a_heading_tells_which_motion_led_to_a_rest() {
    let forward = impact(&read(CROSSING)).unwrap();
    let rest = forward.travel[0].as_ref().unwrap().rest;
    let one = CROSSING.split_once("[vehicle2]").unwrap().0.replace("speed = \"15 m/s\"\n", "");
    let with = |after: &str| format!("{one}{after}\n");
    let [x, y, heading] = [rest.position.x, rest.position.y, rest.heading];
    let at_rest = format!("rest = {{ x = \"{x} m\", y = \"{y} m\", heading = \"{heading} rad\" }}");
    let bare = motion(&read(&with(&at_rest))).unwrap().travel[0].clone().unwrap();
    assert!(bare.passes.is_empty() && !bare.others.is_empty());
    let starts: Vec<_> =
        std::iter::once(bare.start.motion).chain(bare.others.iter().map(|other| other.motion)).collect();
    for start in &starts {
        let [vx, vy] = [start.velocity.x, start.velocity.y];
        let given = format!(
            "speed = \"{} m/s\"\ndirection = \"{} rad\"\nyaw_rate = \"{} rad/s\"",
            vx.hypot(vy),
            vy.atan2(vx),
            start.yaw_rate
        );
        let way = motion(&read(&with(&given))).unwrap().travel[0].clone().unwrap();
        // Where it has turned by half of its whole turn.
        let turn = way.rest.heading - way.start.heading;
        let half = |state: &trajectory::State| (state.heading - way.start.heading) / turn >= 0.5;
        let middle = way.samples.iter().map(|sample| sample.state).find(half).unwrap();
        let point = |off: f64| {
            format!(
                "{at_rest}\npoints = [{{ x = \"{} m\", y = \"{} m\", heading = \"{} rad\" }}]",
                middle.position.x,
                middle.position.y,
                middle.heading + off
            )
        };
        let back = motion(&read(&with(&point(0.0)))).unwrap().travel[0].clone().unwrap();
        let found = back.start.motion;
        assert_near(found.velocity.x, vx, 1e-3);
        assert_near(found.velocity.y, vy, 1e-3);
        assert_near(found.yaw_rate, start.yaw_rate, 1e-3);
        let [pass] = back.passes[..] else { panic!("{:?}", back.passes) };
        assert!(pass.miss < 0.01 && pass.turned.unwrap().abs() < 0.01, "{pass:?}");
        // By 0.2 rad on, and full turns do not count.
        for off in [0.2, 0.2 - std::f64::consts::TAU] {
            let off = motion(&read(&with(&point(off)))).unwrap().travel[0].clone().unwrap();
            assert_near(off.passes[0].turned.unwrap(), 0.2, 0.01);
        }
        let off = motion(&read(&with(&point(0.2)))).unwrap();
        let seen = off.seen(Axes::ZDown);
        assert_near(seen.travel[0].as_ref().unwrap().passes[0].turned.unwrap(), -0.2, 0.01);
        let is_of_point = |check: &&Check| matches!(check.quantity, CheckedQuantity::PointMissed { .. });
        let checks: Vec<&Check> = seen.checks.iter().filter(is_of_point).collect();
        let [check] = checks[..] else { panic!("{:?}", seen.checks) };
        let CheckedQuantity::PointMissed { vehicle: VehicleId::One, point: 1, pass } = check.quantity else {
            panic!("{check:?}")
        };
        assert_near(pass.turned.unwrap(), -0.2, 0.01);
    }
}

/// A car that spins, and where each of its wheels is when it has turned by half of its whole turn: the mark
/// of a wheel is held against the path of that wheel, in either axes.
#[test]
fn a_mark_is_held_against_the_path_of_its_wheel() {
    let forward = impact(&read(CROSSING)).unwrap();
    let way = forward.travel[0].as_ref().unwrap();
    let turn = way.rest.heading - way.start.heading;
    assert!(turn.abs() > 0.5, "{turn}");
    // The same path, in shorter steps, so that its points lie between those of the steps of the analysis.
    let control = trajectory::Control { tolerance: 1e-8, longest_step: 0.005, ..Default::default() };
    let (ground, held) = (trajectory::Ground::level(way.friction), trajectory::Steer::Held(way.steer));
    let mut states = Vec::new();
    trajectory::to_rest(&way.chassis, held, &ground, &way.start, &control, |sample| {
        states.push(sample.state);
    })
    .unwrap();
    let half = |state: &&trajectory::State| (state.heading - way.start.heading) / turn >= 0.5;
    let middle = states.iter().find(half).unwrap();
    let [front_left, _, rear_left, _] = *way.chassis.wheels();
    let half_track = front_left.left;
    let wheels = [
        ("front left", front_left.forward, half_track),
        ("front right", front_left.forward, -half_track),
        ("rear left", rear_left.forward, half_track),
        ("rear right", rear_left.forward, -half_track),
    ];
    // The CG, and from there ahead along the heading and to the left of it.
    let place = |ahead: f64, left: f64| {
        let (sin, cos) = middle.heading.sin_cos();
        [middle.position.x + ahead * cos - left * sin, middle.position.y + ahead * sin + left * cos]
    };
    let passes = |[x, y]: [f64; 2], wheel: &str| {
        let points = format!("drag = 0.15\npoints = [{{ x = \"{x} m\", y = \"{y} m\"{wheel} }}]\n");
        let text = CROSSING.replacen("drag = 0.15\n", &points, 1);
        assert_ne!(text, CROSSING);
        let travel = impact(&read(&text)).unwrap().travel[0].clone().unwrap();
        let [pass] = travel.passes[..] else { panic!("{:?}", travel.passes) };
        pass.miss
    };
    for (name, ahead, left) in wheels {
        let at = place(ahead, left);
        let own = passes(at, &format!(", wheel = \"{name}\""));
        assert!(own < 0.002, "{name}: {own}");
        for (other, ..) in wheels.iter().filter(|(other, ..)| *other != name) {
            let miss = passes(at, &format!(", wheel = \"{other}\""));
            assert!(miss > 5.0 * own + 0.05, "{other} at {name}: {miss}");
        }
    }
    // Without a wheel it is the CG.
    assert!(passes(place(0.0, 0.0), "") < 0.002);
    assert!(passes(place(0.0, 0.0), ", wheel = \"front left\"") > 0.1);
}

/// A car slides with locked wheels from a friction of 0.7 onto slicker ground, whose edge the front axle
/// reaches after 1.8 m and the rear axle after 4.4 m: ½ V² = g Σ μ S, with the loads 1.4/2.6 in front and
/// 1.2/2.6 behind. There the path grows far faster than the square of the speed.
#[test]
fn a_slide_onto_slick_ground_is_traced_back() {
    for slick in [0.1, 0.2, 0.35, 0.6] {
        let mixed = (1.4 * slick + 1.2 * 0.7) / 2.6;
        for rest in [4.6, 5.5, 6.5, 8.0, 10.0, 10.5, 14.0] {
            let text = format!(
                r#"
[scene]
contact = {{ x = "0 m", y = "0 m" }}
[surface]
friction = 0.7
zone = [{{ friction = {slick}, edge = [{{ x = "3 m", y = "-20 m" }}, {{ x = "3 m", y = "20 m" }}], side = "right" }}]
[vehicle1]
mass = "1400 kg"
yaw_radius = "1.3 m"
heading = "0 deg"
position = {{ x = "0 m", y = "0 m" }}
wheelbase = "2.6 m"
track = "1.5 m"
cg_to_front_axle = "1.2 m"
[vehicle1.after]
drag = "locked"
rest = {{ x = "{rest} m", y = "0 m", heading = "0 deg" }}
"#
            );
            let analysis = motion(&read(&text)).unwrap_or_else(|failure| panic!("{slick} {rest}: {failure}"));
            let found = analysis.travel[0].as_ref().unwrap().start.motion.velocity.norm();
            let expected = (2.0 * G * (0.7 * 1.8 + mixed * 2.6 + slick * (rest - 4.4))).sqrt();
            assert!((found - expected).abs() < 1e-3, "{slick} {rest}: {found} {expected}");
        }
    }
}

/// A mark of a front wheel, 42 cm beside the path of a car that turned by 66°, as tyre marks are surveyed. A
/// spin of a full turn more passes it at 24 cm, which does not make it the motion; a mark that only another
/// spin comes near does.
#[test]
fn half_a_metre_of_a_point_chooses_no_spin() {
    let turned = |points: &str| {
        let text = format!(
            r#"
[surface]
friction = 0.7
[vehicle1]
weight = "3400 lb"
class = 3
heading = "0 deg"
position = {{ x = "95 ft", y = "48.3333 ft" }}
wheelbase = "107 in"
track = "61 in"
cg_to_front_axle = "45 in"
[vehicle1.after]
drag = ["locked", 0.02, 0.02, 0.02]
rest = {{ x = "95.0 ft", y = "42.4 ft", heading = "66 deg" }}
{points}
"#
        );
        let analysis = motion(&read(&text)).unwrap();
        let travel = analysis.travel[0].as_ref().unwrap();
        let turned = (travel.rest.heading - travel.start.heading).to_degrees().round();
        (turned, travel.passes.first().map_or(0.0, |pass| pass.miss))
    };
    let point = |x: f64, y: f64| {
        turned(&format!("points = [{{ x = \"{x} ft\", y = \"{y} ft\", wheel = \"front left\" }}]"))
    };
    assert_eq!(turned("").0, 66.0);
    let (turn, miss) = point(96.9, 48.7);
    assert!(turn == 66.0 && (0.4..0.45).contains(&miss), "{turn} {miss}");
    let (turn, miss) = point(92.0, 47.5);
    assert!(turn == -294.0 && miss < 0.5, "{turn} {miss}");
}

/// A car with locked wheels slides 10²/(2·0.7 g) = 7.284 m along x, so that a point 15 % of that to the side,
/// or where the heading would make 15 % of it on the wheelbase, just counts as one on its path.
#[test]
fn a_point_that_the_way_misses_is_told() {
    let slid = 100.0 / (2.0 * 0.7 * G);
    let told = |off: f64, turned: f64| {
        let text = format!(
            r#"
[scene]
contact = {{ x = "3 m", y = "-1 m" }}
[surface]
friction = 0.7
[vehicle1]
mass = "1500 kg"
class = 3
wheelbase = "2.8 m"
heading = "0 deg"
contact = {{ x = "2.0 m", y = "0.1 m" }}
[vehicle1.after]
drag = "locked"
speed = "10 m/s"
direction = "0 deg"
yaw_rate = "0 deg/s"
points = [{{ x = "2 m", y = "-1.1 m" }}, {{ x = "4 m", y = "{} m", heading = "{turned} rad" }}]
"#,
            -1.1 + off
        );
        motion(&read(&text)).unwrap()
    };
    for (off, turned) in [(slid, 0.0), (0.01, slid / 2.8), (-slid, -0.01), (0.0, -slid / 2.8)] {
        for (share, passes) in [(0.149, true), (0.151, false)] {
            let analysis = told(off * share, turned * share);
            let [first, second] = analysis.checks[..] else { panic!("{:?}", analysis.checks) };
            assert!(first.passed() && first.value < 1e-9, "{first:?}");
            assert_near(second.value, share, 1e-6);
            assert_eq!((second.passed(), second.code()), (passes, "point-missed"));
            assert_eq!(second.quantity.vehicle(), Some(VehicleId::One));
            let warned = analysis.warnings.iter().filter(|warning| warning.code() == "point-missed");
            assert_eq!(warned.count(), usize::from(!passes));
        }
    }
}

/// m₁ v₁ = (p × ê₂)/(ê₁ × ê₂) with velocities that the case gives, so that no ground is needed; the headings
/// are 0° and 90°, so that each speed is given by one component.
#[test]
fn given_velocities_need_no_ground() {
    let text = CROSSING
        .replace("[surface]\nfriction = 0.7\n", "")
        .replace("speed = \"15 m/s\"\n", "")
        .replace("speed = \"12 m/s\"\n", "")
        .replacen("drag = 0.15", "speed = \"9 m/s\"\ndirection = \"21 deg\"", 1)
        .replacen("drag = 0.15", "speed = \"11 m/s\"\ndirection = \"47 deg\"", 1)
        + "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n";
    let analysis = reconstruct(&read(&text)).unwrap();
    let [a, b] = [21_f64, 47.0].map(f64::to_radians);
    let px = 1500.0 * 9.0 * a.cos() + 1300.0 * 11.0 * b.cos();
    let py = 1500.0 * 9.0 * a.sin() + 1300.0 * 11.0 * b.sin();
    let [v1, v2] = speeds(&analysis);
    assert_near(v1, px / 1500.0, 1e-12 * v1);
    assert_near(v2, py / 1300.0, 1e-12 * v2);
    assert!(analysis.travel.iter().all(Option::is_none));
}

/// The loss by momentum, from the motions that the case gives, is divided among the works without a
/// remainder.
#[test]
fn the_works_by_momentum_are_the_loss() {
    let told = "after = { speed = \"30 km/h\", direction = \"40 deg\", yaw_rate = \"30 deg/s\" }";
    let text = format!(
        "[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\n\
         contact = {{ x = \"2.05 m\", y = \"0.2 m\" }}\n{told}\n[vehicle2]\nmass = \"1300 kg\"\n\
         yaw_radius = \"1.3 m\"\nheading = \"90 deg\"\ncontact = {{ x = \"0.5 m\", y = \"0.8 m\" }}\n\
         speed = \"40 km/h\"\nafter = {{ speed = \"35 km/h\", direction = \"60 deg\", yaw_rate = \"-40 deg/s\" }}\n\
         [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n\
         [reconstruct]\nfind = \"vehicle1.speed\"\n"
    );
    let analysis = reconstruct(&read(&text)).unwrap();
    let [v1, v2] = speeds(&analysis);
    // ½ m v² + ½ m k² ω² of both, before and after.
    let kinetic = |m: f64, v: f64, k: f64, omega: f64| 0.5 * m * (v * v + (k * omega.to_radians()).powi(2));
    let loss = kinetic(1500.0, v1, 1.4, 0.0) + kinetic(1300.0, v2, 1.3, 0.0)
        - kinetic(1500.0, 30.0 / 3.6, 1.4, 30.0)
        - kinetic(1300.0, 35.0 / 3.6, 1.3, 40.0);
    let seen = analysis.seen(Axes::ZUp);
    let work = |row: &'static OutputQuantity| row.value(&seen, None).unwrap();
    assert_near(work(&IMPACT_ENERGY_LOSS), loss, 1e-9 * loss);
    let works = [&IMPACT_NORMAL_WORK, &IMPACT_TANGENTIAL_WORK, &IMPACT_MOMENT_WORK].map(work);
    assert!(works[2].abs() > 1e-3 * loss, "{works:?}");
    assert_near(works.iter().sum::<f64>(), loss, 1e-12 * loss);
}

/// Two vehicles locked together move as one, and only one of them is followed to rest.
#[test]
fn a_wreck_that_is_followed_alone_is_told() {
    let of = |text: &str| {
        let analysis = reconstruct(&read(text)).unwrap();
        let codes = analysis.warnings.iter().filter(|warning| warning.code() == "wreck-alone");
        codes.filter_map(Warning::vehicle).collect::<Vec<_>>()
    };
    assert_eq!(of(REAR_END), []);
    let locked = format!("{REAR_END}\n").replacen("[scene]\n", "[scene]\nlocked_together = true\n", 1);
    assert_eq!(of(&locked), VehicleId::ALL);
}

/// Two cars that jam with μ = −8 in axes that point down: the refusal has the signs of the file.
const JAMS: &str = r#"
[scene]
axes = "z-down"
[vehicle1]
mass = "1420 kg"
yaw_radius = "1.36 m"
heading = "0 deg"
contact = { x = "1.75 m", y = "-0.45 m" }
after = { speed = "3 m/s", direction = "-10 deg" }
[vehicle1.crush]
side = "front"
width = "100 cm"
depths = "30 30 cm"
stiffness = { category = 3 }
[vehicle2]
mass = "1180 kg"
yaw_radius = "1.28 m"
heading = "-176 deg"
contact = { x = "1.60 m", y = "-0.42 m" }
after = { speed = "3 m/s", direction = "-10 deg" }
[vehicle2.crush]
side = "front"
width = "96 cm"
depths = "30 30 cm"
stiffness = { category = 2 }
[impact]
crush_plane = "-2 deg"
restitution = 0.1
tangential = { ratio = -8 }
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
energy_basis = "dissipated"
"#;

#[test]
fn a_refusal_has_the_signs_of_the_axes() {
    let said = |text: &str| reconstruct(&read(text)).unwrap_err().to_string();
    let one = JAMS
        .replace("[\"vehicle1.speed\", \"vehicle2.speed\"]", "\"vehicle1.speed\"")
        .replace("[vehicle2]", "[vehicle2]\nspeed = \"10 m/s\"");
    for text in [JAMS, &one] {
        let error = said(text);
        assert!(error.contains("the impulse ratio μ = -8") && error.contains("needs μ above -"), "{error}");
    }
    // Seen from below: the same numbers with the other signs.
    let up = JAMS.replace("z-down", "z-up").replace("ratio = -8", "ratio = 8").replace("-2 deg", "2 deg");
    let up = up.replace("-10 deg", "10 deg").replace("-176 deg", "176 deg").replace("y = \"-", "y = \"");
    let limit = |error: &str, before: &str| {
        let (_, rest) = error.split_once(before).unwrap_or_else(|| panic!("{error}"));
        rest.split(':').next().unwrap().to_owned()
    };
    assert!(said(&up).contains("the impulse ratio μ = 8"));
    assert_eq!(limit(&said(&up), "needs μ below "), limit(&said(JAMS), "needs μ above -"));
}

/// Two cars that cross, with damage; the body of vehicle 1 is turned against its direction of travel.
fn crossing_with_damage(turned: f64, [after_1, after_2]: [&str; 2]) -> String {
    let damage = |side: &str, pdof: &str| {
        format!(
            "crush = {{ side = \"{side}\", width = \"1.6 m\", depths = \"30 30 30 30 30 cm\", pdof = \"{pdof}\", \
             stiffness = {{ A = \"500 N/cm\", B = \"60 N/cm^2\" }} }}"
        )
    };
    format!(
        "[vehicle1]\nmass = \"1500 kg\"\nyaw_inertia = \"2500 kg m^2\"\nheading = \"{turned} deg\"\n\
         sideslip = \"{} deg\"\ncontact = {{ distance = \"1.5 m\", angle = \"{} deg\" }}\n{}\n\
         [vehicle1.after]\n{after_1}\n\
         [vehicle2]\nmass = \"1400 kg\"\nyaw_inertia = \"2300 kg m^2\"\nheading = \"90 deg\"\n\
         contact = {{ distance = \"1.6 m\", angle = \"40 deg\" }}\n{}\n[vehicle2.after]\n{after_2}\n\
         [impact]\ncrush_plane = \"180 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n\
         [reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n",
        -turned,
        10.0 - turned,
        damage("front", "0 deg"),
        damage("left", "-90 deg")
    )
}

const LEFT: [&str; 2] = [
    "speed = \"9 m/s\"\ndirection = \"40 deg\"\nyaw_rate = \"60 deg/s\"",
    "speed = \"10 m/s\"\ndirection = \"50 deg\"\nyaw_rate = \"-30 deg/s\"",
];

/// The impulse, its work and the yaw rates depend on where C is and on how the vehicles travelled, not on
/// which way a body points: the same collision has the same checks with the same limits, even where the
/// headings lie along one line.
#[test]
fn the_limits_of_the_checks_are_those_of_the_directions_of_travel() {
    let checks = |turned: f64| {
        let analysis = reconstruct(&read(&crossing_with_damage(turned, LEFT))).unwrap();
        let momentum = analysis.checks.into_iter().filter(|check| {
            matches!(
                check.quantity,
                CheckedQuantity::MomentumYawRate { .. }
                    | CheckedQuantity::MomentumEnergy { .. }
                    | CheckedQuantity::MomentumRestitution { .. }
                    | CheckedQuantity::MomentumRatio { .. }
            )
        });
        momentum.map(|check| [check.value, check.limit]).collect::<Vec<_>>()
    };
    let straight = checks(0.0);
    assert_eq!(straight.len(), 5);
    for turned in [-60.0, 85.0, 120.0] {
        let found = checks(turned);
        assert_eq!(found.len(), 5, "{turned}");
        for (found, expected) in found.iter().flatten().zip(straight.iter().flatten()) {
            assert_near(*found, *expected, 1e-6 * expected.abs());
        }
    }
}

/// The impact by the law is only a check where momentum gives the speeds, so that no warning compares the
/// damage with it. With ΔV = |V − v| of 1500 kg and 1400 kg, v_1 = 9 cos 40° + 14/15 · 10 cos 50° and
/// v_2 = 10 sin 50° + 15/14 · 9 sin 40°.
#[test]
fn what_momentum_gives_is_not_judged_by_the_impact_law() {
    let analysis = reconstruct(&read(&crossing_with_damage(0.0, LEFT))).unwrap();
    let ([s1, c1], [s2, c2]) = (
        [40.0_f64.to_radians().sin(), 40.0_f64.to_radians().cos()],
        [50.0_f64.to_radians().sin(), 50.0_f64.to_radians().cos()],
    );
    let v1 = 9.0 * c1 + 14.0 / 15.0 * 10.0 * c2;
    assert_near(analysis.delta_v()[0], (9.0 * c1 - v1).hypot(9.0 * s1), 1e-9);
    let v2 = 10.0 * s2 + 15.0 / 14.0 * 9.0 * s1;
    assert_near(speeds(&analysis)[1], v2, 1e-9);
    // CRASH3's ΔV is within 10 % of that.
    let crash3 = analysis.crash3.as_ref().unwrap();
    let whole = crash3.corrected.as_ref().unwrap().delta_v[0] * crash3.restitution_factor.unwrap_or(1.0);
    assert!((whole / analysis.delta_v()[0] - 1.0).abs() < 0.1);
    let codes: Vec<&str> = analysis.warnings.iter().map(Warning::code).collect();
    for code in ["pdof-differs", "delta-v-differs", "damage-energy-differs"] {
        assert!(!codes.contains(&code), "{codes:?}");
    }
    assert!(codes.contains(&"momentum-differs"), "{codes:?}");
    let is_of_law = |check: &Check| matches!(check.quantity, CheckedQuantity::DamageEnergy { .. });
    assert!(!analysis.checks.iter().any(is_of_law));
}

/// A force from straight ahead at C, 0.26 m to the left, turns vehicle 1 to the left; by the case, it left
/// turning to the right by 60 °/s, whatever the law would give.
#[test]
fn the_turn_that_opposes_the_damage_is_the_told_one() {
    let [one, two] = LEFT;
    let one = one.replace("60 deg/s", "-60 deg/s");
    let analysis = reconstruct(&read(&crossing_with_damage(0.0, [&one, two]))).unwrap();
    let turned = analysis.warnings.iter().find_map(|warning| match warning {
        Warning::RotationOpposes { vehicle: VehicleId::One, turned, .. } => Some(*turned),
        _ => None,
    });
    assert_near(turned.unwrap(), -std::f64::consts::FRAC_PI_3, 1e-12);
}

/// Speeds by momentum are results: they have no unit in the file that could be checked. With
/// 60 m/s after the impact, v_1 = 60 cos 40° + 14/15 · 60 cos 50° = 81.96 m/s and v_2 = 87.28 m/s; with and
/// without an impact law.
#[test]
fn speeds_by_momentum_that_are_too_fast_are_found_ones() {
    let after = ["speed = \"60 m/s\"\ndirection = \"40 deg\"", "speed = \"60 m/s\"\ndirection = \"50 deg\""];
    let whole = crossing_with_damage(0.0, after);
    let is_of_points =
        |line: &&str| !["contact", "crush", "yaw_inertia"].iter().any(|key| line.starts_with(key));
    let points: String = whole.lines().filter(is_of_points).map(|line| format!("{line}\n")).collect();
    let points = points.split("[impact]").next().unwrap().to_owned()
        + "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n";
    for text in [whole, points] {
        let analysis = reconstruct(&read(&text)).unwrap();
        let implausible: Vec<_> = analysis
            .warnings
            .iter()
            .filter_map(|warning| match warning {
                Warning::Implausible { vehicle, magnitude, value, .. } => {
                    Some((*vehicle, *magnitude, *value))
                }
                _ => None,
            })
            .collect();
        let [(VehicleId::One, Magnitude::SpeedFound, v1), (VehicleId::Two, Magnitude::SpeedFound, v2)] =
            implausible[..]
        else {
            panic!("{implausible:?}")
        };
        assert_near(v1, 81.96, 0.01);
        assert_near(v2, 87.28, 0.01);
    }
}
