//! The data that the motion after the impact takes from a case, and those that it refuses.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::f64::consts::{FRAC_PI_2, PI};

use case::{Case, CaseFile, Faults};
use inputs::{RegionData, RestHeadingData, SteerData, VehicleMotion};
use pim_core::Real;
use proptest::prelude::*;

/// Two cars that meet at right angles: vehicle 1 drives along x, vehicle 2 along y. C lies 1.5 m ahead of the
/// CG of vehicle 1, and 0.8 m to the left of that of vehicle 2.
const CROSSING: &str = r#"
[scene]
contact = { x = "10 m", y = "20 m" }
[surface]
friction = 0.7
[vehicle1]
mass = "1500 kg"
class = 3
heading = "0 deg"
contact = { x = "1.5 m", y = "0 m" }
[vehicle1.after]
drag = 0.02
rest = { x = "20 m", y = "25 m", heading = "40 deg" }
[vehicle2]
mass = "1200 kg"
yaw_radius = "1.3 m"
wheelbase = "2.5 m"
track = "1.4 m"
cg_to_front_axle = "1.1 m"
heading = "90 deg"
contact = { x = "0 m", y = "0.8 m" }
[vehicle2.after]
drag = [0.01, "locked", 0.3, 0.02]
speed = "36 km/h"
direction = "60 deg"
yaw_rate = "90 deg/s"
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = "critical"
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#;

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
}

/// The case with one text replaced by another.
fn with(old: &str, new: &str) -> Case {
    assert_eq!(CROSSING.matches(old).count(), 1, "{old}");
    read(&CROSSING.replace(old, new))
}

fn close(ours: f64, expected: f64) -> bool {
    (ours - expected).abs() < 1e-12 * (1.0 + expected.abs())
}

/// The keys of the faults, and the first message with its advice.
fn told(faults: &Faults) -> (Vec<&str>, String) {
    (faults.list().iter().map(|fault| fault.key.as_str()).collect(), faults.to_string())
}

/// (m) from the CG to the front axle and to the rear one, and the track.
fn axles(vehicle: &VehicleMotion) -> [f64; 3] {
    let [front_left, front_right, rear_left, _] = vehicle.chassis.wheels();
    [front_left.forward, -rear_left.forward, front_left.left - front_right.left]
}

#[test]
fn the_engine_gets_what_the_case_says() {
    let motion = read(CROSSING).motion().unwrap();
    let [one, two] = motion.vehicles.map(Option::unwrap);
    // C − (1.5, 0), and C − 0.8 m to the left of +y, which is −x.
    assert!(close(one.position.x, 8.5) && close(one.position.y, 20.0), "{}", one.position);
    assert!(close(two.position.x, 10.8) && close(two.position.y, 20.0), "{}", two.position);
    assert!(close(two.heading, FRAC_PI_2));
    // SAE 870045, Table 2, class 3: a = 51.3 in, b = 53.5 in, track 58.9 in.
    let [a, b, track] = axles(&one);
    assert!(close(a, 51.3 * 0.0254) && close(b, 53.5 * 0.0254) && close(track, 58.9 * 0.0254));
    let [a, b, track] = axles(&two);
    assert!(close(a, 1.1) && close(b, 1.4) && close(track, 1.4));
    assert!(close(two.chassis.body().mass(), 1200.0));
    let drag = |vehicle: &VehicleMotion| vehicle.chassis.wheels().map(|wheel| wheel.drag);
    assert_eq!(drag(&one), [0.02; 4]);
    // A locked wheel resists more than any ground can.
    assert_eq!(drag(&two), [0.01, 2.0, 0.3, 0.02]);
    let rest = one.rest.unwrap();
    assert!(close(rest.position.x, 20.0) && close(rest.position.y, 25.0));
    assert!(matches!(rest.heading, RestHeadingData::Heading(angle) if close(angle, 40.0_f64.to_radians())));
    let departure = two.velocity.unwrap();
    // 36 km/h is 10 m/s; cos 60° = 0.5, sin 60° = √3/2
    assert!(close(departure.velocity.x, 5.0) && close(departure.velocity.y, 5.0 * 3.0_f64.sqrt()));
    assert!(close(departure.yaw_rate.unwrap(), FRAC_PI_2));
    assert!(one.velocity.is_none() && two.rest.is_none());
}

#[test]
fn a_wheelbase_of_ones_own_keeps_the_share_of_the_class() {
    let motion = with("class = 3", "class = 3\nwheelbase = \"3 m\"").motion().unwrap();
    let [a, b, _] = axles(motion.vehicles[0].as_ref().unwrap());
    // 51.3/(51.3 + 53.5) of 3 m
    assert!(close(a, 3.0 * 51.3 / 104.8) && close(a + b, 3.0));
}

#[test]
fn the_ground_is_turned_into_the_axes_of_the_engine() {
    let zones = r#"friction = 0.7
grade = { slope = 0.05, uphill = "90 deg" }
[[surface.zone]]
name = "grass"
friction = 0.4
edge = [{ x = "0 m", y = "6 m" }, { x = "50 m", y = "6 m" }]
side = "left"
[[surface.zone]]
friction = 0.2
polygon = [{ x = "0 m", y = "0 m" }, { x = "4 m", y = "0 m" }, { x = "0 m", y = "3 m" }]"#;
    let up = with("friction = 0.7", zones).motion().unwrap().surface;
    assert!(close(up.grade.y, 0.05) && up.grade.x.abs() < 1e-15);
    // To the left of +x is +y.
    assert!(matches!(up.zones[0].region, RegionData::HalfPlane { into, .. } if close(into, FRAC_PI_2)));
    assert_eq!(up.zones[0].name.as_ref().unwrap().to_string(), "grass");
    assert_eq!(up.zones().len(), 2);
    // In z-down axes y = 6 m lies to the right of the engine's x axis, and left of +x is there, too, the left
    // side of someone who looks along +x.
    let down =
        read(&CROSSING.replace("friction = 0.7", zones).replace("[scene]", "[scene]\naxes = \"z-down\""));
    let down = down.motion().unwrap().surface;
    assert!(close(down.grade.y, -0.05));
    let RegionData::HalfPlane { point, into } = down.zones[0].region else { panic!() };
    assert!(close(point.y, -6.0) && close(into, FRAC_PI_2));
    let RegionData::Polygon(corners) = &down.zones[1].region else { panic!() };
    assert!(close(corners[2].y, -3.0));
}

#[test]
fn steer_and_turn_keep_their_sign() {
    let steered = "drag = 0.02\nsteer = [{ time = \"0 s\", angle = \"-5 deg\" }, { time = \"500 ms\", angle = \"5 deg\" }]";
    let case = with("drag = 0.02\nrest", &format!("{steered}\nrest"));
    let motion = case.motion().unwrap();
    let SteerData::Over(points) = &motion.vehicles[0].as_ref().unwrap().steer else { panic!() };
    assert!(close(points[1].0, 0.5) && close(points[1].1, PI / 36.0) && close(points[0].1, -PI / 36.0));
    let turned = with("heading = \"40 deg\"", "turned = \"-320 deg\"").motion().unwrap();
    let rest = turned.vehicles[0].as_ref().unwrap().rest.unwrap();
    assert!(matches!(rest.heading, RestHeadingData::Turned(angle) if close(angle, -16.0 * PI / 9.0)));
}

#[test]
fn what_is_missing_or_impossible_is_told_with_its_key() {
    for (old, new, key, words) in [
        ("[surface]\nfriction = 0.7", "", "surface.friction", "friction = 0.7"),
        ("contact = { x = \"10 m\", y = \"20 m\" }", "", "scene.contact", "same coordinates as the rest"),
        ("drag = 0.02\n", "", "vehicle1.after.drag", "drag = \"locked\""),
        ("contact = { x = \"1.5 m\", y = \"0 m\" }", "", "vehicle1.contact", "contact = {"),
        ("yaw_rate = \"90 deg/s\"", "", "vehicle2.after.yaw_rate", "0 deg/s"),
        ("speed = \"36 km/h\"", "", "vehicle2.after.rest", "`speed` and `direction`"),
        ("class = 3", "yaw_radius = \"1.3 m\"", "vehicle1.wheelbase", "class = 3"),
        ("track = \"1.4 m\"", "", "vehicle2.track", "class = 3"),
        ("track = \"1.4 m\"", "kind = \"heavy-truck\"", "vehicle2.track", "`track = \"1.50 m\"`"),
        ("\"1.1 m\"", "\"2.5 m\"", "vehicle2.cg_to_front_axle", "2.50 m ahead of the CG"),
        ("x = \"20 m\", y = \"25 m\"", "x = \"8.5 m\", y = \"20.005 m\"", "vehicle1.after.rest", "5.0 mm"),
        (
            "rest = { x",
            "points = [{ x = \"15 m\", y = \"20 m\" }, { x = \"13 m\", y = \"21 m\" }]\nrest = { x",
            "vehicle1.after.points[2]",
            "turns by 153°",
        ),
        (
            "rest = { x",
            "points = [{ x = \"25 m\", y = \"27 m\" }]\nrest = { x",
            "vehicle1.after.rest",
            "turns back",
        ),
        (
            "rest = { x",
            "points = [{ x = \"15 m\", y = \"20 m\" }, { x = \"15 m\", y = \"20 m\" }]\nrest = { x",
            "vehicle1.after.points[2]",
            "0.0 mm",
        ),
        ("drag = 0.02\n", "drag = 2.5\n", "vehicle1.after.drag", "2.5"),
    ] {
        let faults = with(old, new).motion().unwrap_err();
        let (keys, text) = told(&faults);
        assert!(keys.contains(&key), "{old} → {new}: {text}");
        assert!(text.contains(words), "{old} → {new}: {text}");
    }
    // As many faults as keys: none is reported twice.
    let bare = CROSSING.replace("heading = \"0 deg\"", "").replace("mass = \"1500 kg\"", "");
    let faults = read(&bare).two_speeds().unwrap_err();
    let (mut keys, text) = told(&faults);
    keys.sort_unstable();
    assert_eq!(keys, ["vehicle1.heading", "vehicle1.weight"], "{text}");
}

#[test]
fn a_case_without_motion_says_what_to_add() {
    let plain = CROSSING.replace("[vehicle1.after]", "[vehicle1.before]\nskid = { length = \"9 m\" }");
    let plain =
        plain.replace("drag = 0.02\nrest = { x = \"20 m\", y = \"25 m\", heading = \"40 deg\" }\n", "");
    let (before, after) = plain.split_once("[vehicle2.after]").unwrap();
    let (_, rest) = after.split_once("[impact]").unwrap();
    let case = read(&format!("{before}[impact]{rest}"));
    assert_eq!(told(&case.motion().unwrap_err()).0, ["vehicle1.after"]);
    assert!(case.run_out().is_none());
    // The friction of the marks is that of the ground.
    let skid = case.skids()[0].unwrap();
    assert!(close(skid.length, 9.0) && close(skid.friction, 0.7));
    let (keys, text) = {
        let faults = case.two_speeds().unwrap_err();
        (faults.list().iter().map(|fault| fault.key.clone()).collect::<Vec<_>>(), faults.to_string())
    };
    assert_eq!(keys, ["vehicle1.after.rest", "vehicle2.after.rest"], "{text}");
}

#[test]
fn after_an_impact_neither_velocity_nor_rest_is_needed() {
    let case = with("speed = \"36 km/h\"\ndirection = \"60 deg\"\nyaw_rate = \"90 deg/s\"", "");
    let motion = case.run_out().unwrap().unwrap();
    assert!(motion.vehicles.iter().all(Option::is_some));
    // Without a drag, a vehicle is not followed.
    let case = with("drag = [0.01, \"locked\", 0.3, 0.02]", "");
    assert!(case.run_out().unwrap().unwrap().vehicles[1].is_none());
}

/// The friction on the path of a vehicle takes the place of that of the ground, which may then be left out;
/// a vehicle with neither is not followed, and the other commands answer as without it.
#[test]
fn friction_of_a_vehicle_needs_no_surface() {
    let bare = CROSSING.replace("[surface]\nfriction = 0.7\n", "");
    assert!(read(&bare).run_out().is_none());
    let one = bare.replace("drag = 0.02", "friction = 0.6\ndrag = 0.02");
    let both = one.replace("drag = [0.01", "friction = 0.5\ndrag = [0.01");
    let motion = read(&both).motion().unwrap();
    let friction = motion.vehicles.each_ref().map(|way| way.as_ref().unwrap().friction_on(&motion.surface));
    assert_eq!(friction, [0.6, 0.5]);
    assert!(read(&both).two_speeds().unwrap().motion.unwrap().vehicles.iter().all(Option::is_some));
    let followed = read(&one).run_out().unwrap().unwrap().vehicles.map(|way| way.is_some());
    assert_eq!(followed, [true, false]);
    assert_eq!(told(&read(&one).motion().unwrap_err()).0, ["surface.friction"]);
}

#[test]
fn axles_are_told_in_the_unit_of_the_file() {
    let text = CROSSING.replace("class = 3", "class = 3\nwheelbase = \"8 ft\"\ncg_to_front_axle = \"9 ft\"");
    let (_, told) = told(&read(&text).motion().unwrap_err());
    assert!(told.contains("9.00 ft ahead of the CG, but the wheelbase is only 8.00 ft"), "{told}");
}

#[test]
fn without_a_survey_the_impact_is_the_origin() {
    let bare = CROSSING
        .replace("[scene]\ncontact = { x = \"10 m\", y = \"20 m\" }\n", "")
        .replace("rest = { x = \"20 m\", y = \"25 m\", heading = \"40 deg\" }", "");
    let [one, two] = read(&bare).run_out().unwrap().unwrap().vehicles.map(Option::unwrap);
    // C lies 1.5 m ahead of vehicle 1, which points along x, and 0.8 m to the left of vehicle 2, along y.
    assert!(close(one.position.x, -1.5) && close(one.position.y, 0.0), "{}", one.position);
    assert!(close(two.position.x, 0.8) && close(two.position.y, 0.0), "{}", two.position);
}

#[test]
fn skid_marks_need_their_friction_in_every_analysis() {
    let skids = CROSSING
        .replace("[surface]\nfriction = 0.7\n", "")
        .replace("[vehicle1.after]", "[vehicle1.before]\nskid = { length = \"9 m\" }\n[vehicle1.after]");
    let both = read(&skids);
    let impact =
        read(&skids.replace("find = [\"vehicle1.speed\", \"vehicle2.speed\"]", "find = \"vehicle1.speed\""));
    for faults in [
        both.two_speeds().unwrap_err(),
        impact.reconstruction().unwrap_err(),
        impact.collision().unwrap_err(),
    ] {
        assert!(told(&faults).0.contains(&"vehicle1.before.skid.friction"), "{faults}");
    }
}

#[test]
fn both_speeds_need_the_departure_of_both() {
    let input = read(CROSSING).two_speeds().unwrap();
    assert!(input.departures[0].is_none() && input.departures[1].is_some() && !input.has_crush);
    assert!(input.motion.unwrap().vehicles.iter().all(Option::is_some));
    // Two velocities need neither ground nor wheels.
    let given = "speed = \"10 m/s\"\ndirection = \"5 deg\"";
    let bare = CROSSING
        .replace("[surface]\nfriction = 0.7", "")
        .replace("drag = 0.02\nrest = { x = \"20 m\", y = \"25 m\", heading = \"40 deg\" }", given)
        .replace("drag = [0.01, \"locked\", 0.3, 0.02]", "")
        .replace("track = \"1.4 m\"", "");
    let input = read(&bare).two_speeds().unwrap();
    assert!(input.motion.is_none() && input.departures.iter().all(Option::is_some));
    // A fixed object has no speed to be found.
    let wall = CROSSING.split_once("[vehicle2]").unwrap().0;
    let wall = format!(
        "{wall}[vehicle2]\nfixed = true\n[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]"
    );
    let errors = CaseFile::parse("case.toml", &wall).unwrap_err().to_string();
    assert!(errors.contains("[vehicle2], which is fixed"), "{errors}");
}

/// A site plan is kept as it is written, and no number of it varies.
#[test]
fn a_site_plan_is_read_and_written() {
    let bare = read(CROSSING);
    let text = CROSSING.replacen(
        "[scene]\n",
        "[scene]\nsite_plan = { file = \"plans/aerial.jpg\", corner = { x = \"-20 m\", y = \"-50 ft\" }, width = \"60 m\", angle = \"15 deg\" }\n",
        1,
    );
    let case = read(&text);
    let plan = case.site_plan.clone().unwrap();
    assert_eq!(plan.file.as_given(), "plans/aerial.jpg");
    let [x, y, width, angle] =
        [plan.corner.x.si(), plan.corner.y.si(), plan.width.si(), plan.angle.unwrap().si().to_degrees()];
    assert_eq!((x, width), (-20.0, 60.0));
    assert!((y + 15.24).abs() < 1e-12 && (angle - 15.0).abs() < 1e-12);
    assert_eq!(case.variables(), bare.variables());
    assert_eq!(read(&case::to_toml(&case)), case);
    assert_eq!(bare.site_plan, None);
}

/// EDCRASH's rule: within 10° of one line, the damage has to give the second equation.
#[test]
fn collinear_approaches_need_the_damage() {
    for (heading, needs) in
        [("9.9", true), ("10.1", false), ("169.9", false), ("170.1", true), ("-175", true)]
    {
        let case = with("heading = \"90 deg\"", &format!("heading = \"{heading} deg\""));
        let result = case.two_speeds();
        match result {
            Ok(_) => assert!(!needs, "{heading}"),
            Err(faults) => {
                let (keys, text) = told(&faults);
                assert!(needs && keys == ["vehicle1.crush", "vehicle2.crush"], "{heading}: {text}");
                assert!(text.contains("momentum alone"), "{text}");
            }
        }
    }
    // With a sideslip, the direction of travel counts.
    let slipping = with("heading = \"90 deg\"", "heading = \"90 deg\"\nsideslip = \"-85 deg\"");
    let (_, text) = told(&slipping.two_speeds().unwrap_err());
    assert!(text.contains("their directions of travel are 5° apart"), "{text}");
    let ees = CROSSING
        .replace("heading = \"90 deg\"", "heading = \"3 deg\"")
        .replace("[vehicle2]", "[vehicle1.crush]\nees = \"20 km/h\"\n[vehicle2]\ncrush = \"none\"");
    assert!(read(&ees).two_speeds().unwrap().has_crush);
}

proptest! {
    /// The place of C, seen from the vehicle that stands at the place of its CG, is `contact`; and the case
    /// written in z-down axes is the same to the engine.
    #[test]
    fn the_cg_lies_where_contact_says(
        degrees in -720.0..720.0_f64, x in -3.0..3.0_f64, y in -1.0..1.0_f64, cx in -99.0..99.0_f64, cy in -99.0..99.0_f64,
    ) {
        let text = |sign: f64, axes: &str| {
            CROSSING
                .replace("[scene]\ncontact = { x = \"10 m\", y = \"20 m\" }",
                    &format!("[scene]\naxes = \"{axes}\"\ncontact = {{ x = \"{cx} m\", y = \"{} m\" }}", sign * cy))
                .replace("heading = \"0 deg\"", &format!("heading = \"{} deg\"", sign * degrees))
                .replace("contact = { x = \"1.5 m\", y = \"0 m\" }",
                    &format!("contact = {{ x = \"{x} m\", y = \"{} m\" }}", sign * y))
                .replace("rest = { x = \"20 m\", y = \"25 m\", heading = \"40 deg\" }",
                    &format!("rest = {{ x = \"120 m\", y = \"{} m\", heading = \"{} deg\" }}", sign * 25.0, sign * 40.0))
        };
        let [up, down] = [text(1.0, "z-up"), text(-1.0, "z-down")]
            .map(|text| read(&text).motion().unwrap().vehicles[0].clone().unwrap());
        // Turned back by the heading.
        let (sin, cos) = Real::sin_cos(degrees.to_radians());
        let arm = [cx - up.position.x, cy - up.position.y];
        prop_assert!((arm[0] * cos + arm[1] * sin - x).abs() < 1e-9);
        prop_assert!((arm[1] * cos - arm[0] * sin - y).abs() < 1e-9);
        prop_assert_eq!(up.position, down.position);
        prop_assert_eq!(up.rest, down.rest);
    }
}

/// Corners and the place of a recorder do not vary; the place of the impact may.
#[test]
fn an_exact_place_has_no_range() {
    let refusals = |lines: &str| {
        let lines = lines.replace("RANGE", "{ value = \"1 m\", sd = \"2 cm\" }");
        CaseFile::parse("case.toml", &lines).unwrap_err().to_string()
    };
    for (lines, key) in [
        (
            "[scene]\nsite_plan = { file = \"a.jpg\", corner = { x = RANGE, y = \"0 m\" }, width = \"6 m\" }",
            "scene.site_plan.corner.x",
        ),
        ("[[surface.zone]]\npolygon = [{ x = \"0 m\", y = RANGE }]", "surface.zone[1].polygon[1].y"),
        ("[vehicle1.recorder]\nat = { x = \"0 m\", y = RANGE }", "vehicle1.recorder.at.y"),
    ] {
        let refused = refusals(lines);
        let expected = format!(
            "\"{key}\" is a table, but must be a string with a number and a unit, because this place is exact"
        );
        assert!(refused.contains(&expected), "{refused}");
    }
    assert!(!refusals("[scene]\ncontact = { x = RANGE, y = \"0 m\" }").contains("scene.contact"));
}
