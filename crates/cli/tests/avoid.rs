//! `deltav avoid`: printed examples through the case file, the keys of its JSON, and what it refuses.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

const KMH: f64 = 1.0 / 3.6;

fn temporary(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("avoid");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn written(name: &str, case: &str) -> String {
    let path = temporary(name);
    fs::write(&path, case).unwrap();
    path.display().to_string()
}

fn deltav(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_deltav"));
    command.args(arguments).env("DELTAV_PROGRESS", "off").output().unwrap()
}

/// The block `avoid` of the JSON.
#[track_caller]
fn avoid(name: &str, case: &str) -> Value {
    let output = deltav(&["avoid", &written(name, case), "--format", "json"]);
    assert_eq!((output.status.code(), &*String::from_utf8_lossy(&output.stderr)), (Some(0), ""));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    document["avoid"].clone()
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}: {value}"))
}

#[track_caller]
fn near(value: &Value, pointer: &str, expected: f64, tolerance: f64) {
    let found = number(value, pointer);
    assert!((found - expected).abs() <= tolerance, "{pointer}: {found}, not {expected}");
}

/// tp-lernen-100kmh-50m: 100 km/h, 1.0 s, 7 m/s², 50 m: stops after 82.89 m, not avoidable; recomputed, it
/// hits with 77.25 km/h and would have stopped from 73.32 km/h.
#[test]
fn a_printed_stop_on_a_road() {
    let found = avoid(
        "tp-lernen.toml",
        r#"
        [avoid]
        speed = "100 km/h"
        limit = "80 km/h"
        reaction_time = "1 s"
        deceleration = "7 m/s^2"
        demand = { distance = "50 m" }
        "#,
    );
    near(&found, "/stopping_distance", 82.89, 0.005);
    near(&found, "/spatial/speed", 73.324_312 * KMH, 1e-6);
    assert_eq!(found["spatial"]["avoidable_at_limit"], false);
    assert_eq!(found["temporal"], Value::Null);
    assert_eq!(found["probability"], Value::Null);
    assert_eq!(found["at_limit"]["delta_v"], Value::Null);
    near(&found, "/runs/0/collision_speed", 77.252_832 * KMH, 1e-6);
    assert_eq!(found["actual"], "responded");
}

/// sicher-auto-30-50: 1.0 s, 6.5 m/s², 20 m: 13.7 m and no collision from 30 km/h, 38.3 km/h from 50 km/h
/// after 1.5 s; recomputed, 39.19 km/h just avoid it.
#[test]
fn a_printed_comparison_of_two_speeds() {
    let found = avoid(
        "sicher-auto.toml",
        r#"
        [avoid]
        speed = "50 km/h"
        limit = "30 km/h"
        reaction_time = "1 s"
        deceleration = "6.5 m/s^2"
        demand = { distance = "20 m" }
        "#,
    );
    near(&found, "/speed", 50.0 * KMH, 1e-12);
    near(&found, "/demand/distance", 20.0, 1e-12);
    near(&found, "/demand/time", 1.498_043, 1e-6);
    near(&found, "/stopping_distance", 28.727_445, 1e-6);
    near(&found, "/runs/0/collision_speed", 38.3 * KMH, 0.05 * KMH);
    near(&found, "/spatial/speed", 39.187_219 * KMH, 1e-6);
    assert_eq!(found["spatial"]["avoidable_at_limit"], true);
    near(&found, "/at_limit/collision_speed", 0.0, 0.0);
}

/// george-bill-crossing: 100 ft/s, 30 ft/s² at once, 125 ft to the crossing; the other enters it after 4.67 s
/// and the car has left it after 1.88 s. Seen from the other side: the one with 30 ft/s that comes to the
/// crossing, 150 ft ahead, in 5 s is late enough by far.
#[test]
fn a_printed_crossing_is_avoided_in_time_only() {
    let found = avoid(
        "george-bill.toml",
        r#"
        [avoid]
        speed = "100 ft/s"
        limit = "90 ft/s"
        reaction_time = "0 s"
        deceleration = "30 ft/s^2"
        demand = { distance = "125 ft" }
        clear = { distance = "10 ft", speed = "30 ft/s" }
        "#,
    );
    // 166.7 ft to the stop, and so not in space.
    near(&found, "/stopping_distance", 166.666_667 * 0.3048, 1e-6);
    assert_eq!(found["spatial"]["avoidable_at_limit"], false);
    // By hand: T = (100 − √(100² − 2·30·125))/30 = 1.6667 s, and 1/3 s more until it is clear; then
    // v_t = (125 + 15·2²)/2 = 92.5 ft/s.
    near(&found, "/demand/time", 5.0 / 3.0, 1e-9);
    near(&found, "/temporal/speed", 92.5 * 0.3048, 1e-9);
    assert_eq!(found["temporal"]["avoidable_at_limit"], true);
}

/// Haufe's conventions: the same numbers, the swell at full speed, linear and at half.
#[test]
fn the_convention_of_the_swell_changes_the_stopping_distance() {
    for (form, stops) in [("full speed", 26.75), ("linear", 25.35), ("half", 25.32)] {
        let case = format!(
            r#"
            [avoid]
            speed = "50 km/h"
            limit = "30 km/h"
            reaction_time = "0.8 s"
            swell = "0.2 s"
            swell_form = "{form}"
            deceleration = "7.5 m/s^2"
            demand = {{ distance = "20 m" }}
            "#
        );
        near(&avoid("haufe.toml", &case), "/stopping_distance", stops, 0.005);
    }
}

/// A case that is right, each line of which can be replaced.
const RIGHT: [(&str, &str); 5] = [
    ("speed", "speed = \"60 km/h\""),
    ("limit", "limit = \"50 km/h\""),
    ("reaction_time", "reaction_time = \"1 s\""),
    ("deceleration", "deceleration = \"7 m/s^2\""),
    ("demand", "demand = { distance = \"30 m\" }"),
];

#[track_caller]
fn refused(name: &str, key: &str, line: &str, more: &str, says: &[&str]) {
    let lines = RIGHT.map(|(of, right)| if of == key { line } else { right });
    let case = format!("[avoid]\n{}\n{more}", lines.join("\n"));
    let output = deltav(&["avoid", &written(name, &case)]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    for words in says {
        assert!(message.contains(words), "{words:?} is not in: {message}");
    }
    assert!(message.contains(&format!("{name}:")), "{message}");
}

#[test]
fn bad_input_gets_a_sentence_with_its_place() {
    refused(
        "t.toml",
        "reaction_time",
        "",
        "",
        &["`avoid.reaction_time` is missing", "Dettinger", "t.toml:1:1"],
    );
    refused("a.toml", "deceleration", "", "", &["`avoid.deceleration` is missing", "m/s^2", "friction"]);
    refused("d.toml", "demand", "", "", &["`avoid.demand` is missing", "first be recognized"]);
    refused("v.toml", "speed", "", "", &["`avoid.speed` is missing"]);
    let never = "clear = { distance = \"2 m\", speed = \"0 m/s\" }";
    refused("c.toml", "", "", never, &["clear.speed", "must be greater than zero", "c.toml:7:37"]);
    refused("r.toml", "reaction_time", "reaction_time = \"-0.5 s\"", "", &["reaction_time", "negative"]);
    // The brakes took hold 36 m before the impact, and the demand is at 30 m.
    let skid = "\n[vehicle1.before]\nskid = { length = \"34 m\", friction = 0.7 }\n";
    refused("b.toml", "speed", "", &format!("{skid}[vehicle1]\nspeed = \"5 m/s\"\n"), &[]);
    let early = &["the brakes took effect 34 m before the impact", "b.toml:6:23"];
    let case = format!(
        "[avoid]\n\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\n\
         [vehicle1]\nspeed = \"5 m/s\"\n{skid}"
    );
    let output = deltav(&["avoid", &written("b.toml", &case)]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    for words in early {
        assert!(message.contains(words), "{message}");
    }
    let twice = "\n[vehicle1]\nspeed = \"40 km/h\"\n";
    refused("2.toml", "", "", twice, &["given twice", "2.toml:2:9"]);
    let output = deltav(&["avoid", &written("n.toml", "[vehicle1]\nmass = \"1 t\"\n")]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("`avoid` is missing: `deltav avoid` needs it"));
}

#[test]
fn a_vehicle_that_would_have_stopped_reacted_late() {
    let found = avoid(
        "late.toml",
        r#"
        [avoid]
        speed = "30 km/h"
        limit = "25 km/h"
        reaction_time = "1 s"
        deceleration = "6.5 m/s^2"
        demand = { distance = "20 m" }
        "#,
    );
    assert_eq!(found["actual"], "late or not at all");
    near(&found, "/demand/time", 20.0 / (30.0 * KMH), 1e-12);
    // 20 m less 5.34 m of braking, at 30 km/h
    near(&found, "/enough/reaction_time", (20.0 - 5.341_88) / (30.0 * KMH), 1e-5);
}

/// The twelve things that a report shows.
#[test]
fn the_report_shows_all_that_it_should() {
    let path = temporary("report.toml");
    let name = path.to_str().unwrap();
    for units in ["si", "us"] {
        let _ = fs::remove_file(&path);
        assert!(deltav(&["new", "--template", "avoid", "--units", units, "-o", name]).status.success());
        let output = deltav(&["avoid", name, "--format", "html"]);
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
        let html = String::from_utf8(output.stdout).unwrap();
        for words in [
            "visible once past the front of the parked van",
            "EDCRASH manual",
            "without the swell",
            "What happened, and what would have",
            "in space",
            "in time",
            "just avoid",
            "stops before the place",
            "Probability",
            "Davis 2003",
            "says nothing about guilt",
            "Convention of the swell",
            "path-time",
            "doubtful for pedestrians",
        ] {
            assert!(
                html.contains(words) || units == "us" && words == "without the swell",
                "{units}: {words}"
            );
        }
        // What the template states of itself.
        let text = fs::read_to_string(&path).unwrap();
        let stated = text.split("just avoided from ").nth(1).unwrap().split_whitespace().next().unwrap();
        let found = deltav(&["avoid", name, "--format", "json"]);
        let document: Value = serde_json::from_slice(&found.stdout).unwrap();
        let size = if units == "si" { KMH } else { 0.447_04 };
        let speed = number(&document, "/avoid/enough/speed") / size;
        assert_eq!(format!("{speed:.1}"), stated, "{units}");
    }
}

/// The speed from the evidence of the collision: the draws of the estimate make the probability.
#[test]
fn evidence_makes_a_probability() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/avoid/evidence.toml");
    let output = deltav(&["avoid", case, "--format", "json"]);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let found = &document["avoid"];
    assert_eq!(found["speed_source"], "estimate");
    // `deltav estimate` with the same seed says how probable it is that the vehicle was above the limit.
    let alone = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/estimate.toml");
    let question =
        ["estimate", alone, "--no-pieces", "--above", "vehicle1.speed 50 km/h", "--format", "json"];
    let estimated: Value = serde_json::from_slice(&deltav(&question).stdout).unwrap();
    let above = number(&estimated, "/questions/0/probability");
    near(found, "/probability/above_limit", above, 1e-12);
    assert!(number(found, "/probability/mc_error") > 0.0);
    assert!(found["at_limit"]["delta_v"].is_array());
    // ΔV of what happened is that of the estimate, and the others are in proportion.
    for vehicle in [0, 1] {
        let estimated = number(&estimated, &format!("/outputs/vehicle{}.delta_v/median", vehicle + 1));
        near(found, &format!("/runs/0/delta_v/{vehicle}"), estimated, 1e-9);
    }
}

/// The crush energy by a category of a car against a tree leaves its speed open, and a recorder tells it.
#[test]
fn a_speed_that_the_evidence_leaves_open_is_said_to_be() {
    let tree = include_str!("../../../fixtures/leaning-tree.toml");
    let with = |more: &str| {
        format!(
            "{tree}{more}[avoid]\nlimit = \"30 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ distance = \"30 m\" }}\n"
        )
    };
    let open = "a speed that the evidence does not determine, taken as";
    for (more, is_open) in [("", true), ("[vehicle1.recorder]\nspeed = \"35 km/h\"\n", false)] {
        let case = with(more);
        let output = deltav(&["avoid", &written("tree.toml", &case)]);
        let text = String::from_utf8(output.stdout).unwrap();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(text.contains(open), is_open, "{text}");
        assert_eq!(text.contains("the probabilities depend on what is assumed"), is_open, "{text}");
        assert_eq!(avoid("tree.toml", &case)["speed_determined"], !is_open);
    }
}

#[test]
fn no_vehicle_brakes_with_seven_g() {
    refused(
        "seven-g.toml",
        "deceleration",
        "deceleration = \"75 m/s^2\"",
        "",
        &["no vehicle brakes with 7.6 g", "at most 2 g, 19.6 m/s^2", "decimal point"],
    );
}

const OBSTACLE: &str = "[[avoid.obstacle]]\nname = \"van\"\npolygon = [{ x = \"-8 m\", y = \"-1.8 m\" }, { x = \"-3 m\", y = \"-1.8 m\" }, { x = \"-3 m\", y = \"-3.8 m\" }, { x = \"-8 m\", y = \"-3.8 m\" }]\n";
const WAYS: &str =
    "[avoid.sight]\nheading = \"0 deg\"\nother_heading = \"90 deg\"\nother_speed = \"1.5 m/s\"\n";

#[test]
fn the_sight_is_told_and_drawn() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/avoid/sight.toml");
    let output = deltav(&["avoid", case, "--samples", "2000", "--format", "json"]);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let found = &document["avoid"];
    // What the keys say of each other.
    let [time, subject] = ["/sight/time", "/sight/distance_subject"].map(|key| number(found, key));
    assert_eq!(number(found, "/demand/time").to_bits(), time.to_bits());
    assert_eq!(number(found, "/demand/distance").to_bits(), subject.to_bits());
    near(found, "/sight/distance_other", 1.6 * time, 1e-12);
    assert_eq!(found["sight"]["hidden_by"], 1);
    let [low, high] = ["low", "high"].map(|end| number(found, &format!("/intervals/sight/time/{end}")));
    assert!(low < time && time < high);
    let html = deltav(&["avoid", case, "--samples", "2000", "--format", "html"]).stdout;
    let html = String::from_utf8(html).unwrap();
    for words in [
        "parked van",
        "source: survey",
        "the view becomes free",
        "id=\"sight-obstacle-1\"",
        "at the place given",
    ] {
        assert!(html.contains(words), "{words}");
    }
    let svg = String::from_utf8(deltav(&["draw", case, "--what", "sight"]).stdout).unwrap();
    assert!(svg.contains("id=\"sight-line\"") && svg.contains("parked van"));
    let none = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/avoid/pedestrian.toml");
    // Without obstacles, the plan has the places of both: 13.9 m apart in each second at 50 km/h.
    let both = temporary("both.toml");
    let ways = "eye = { x = \"0 m\", y = \"0 m\" }\n";
    fs::write(&both, format!("{}\n{WAYS}{ways}", fs::read_to_string(none).unwrap())).unwrap();
    let svg = deltav(&["draw", both.to_str().unwrap(), "--what", "sight"]).stdout;
    let svg = String::from_utf8(svg).unwrap();
    assert!(svg.contains("eye of the driver of vehicle 1") && !svg.contains("obstacle"), "{svg}");
    let message = deltav(&["draw", none, "--what", "sight"]).stderr;
    assert!(String::from_utf8_lossy(&message).contains("no [[avoid.obstacle]]"));
}

#[test]
fn a_sight_that_cannot_be_gets_a_sentence() {
    let sight = "demand = { sight = true }";
    refused("s1.toml", "demand", sight, "", &["`avoid.obstacle` is missing", "polygon = "]);
    refused(
        "s2.toml",
        "",
        "",
        "[avoid.sight]\nheading = \"0 deg\"\n",
        &["`avoid.sight.other_heading` is missing"],
    );
    let lacks = &[
        "`avoid.sight.heading` is missing",
        "`avoid.sight.other_heading` is missing",
        "`avoid.sight.other_speed` is missing",
    ];
    refused("s3.toml", "demand", sight, OBSTACLE, lacks);
    let moved = |x: &str, y: &str| {
        let mut text = OBSTACLE.to_owned();
        for (from, to) in [
            ("-8 m", format!("{x}5 m")),
            ("-3 m", format!("{x}0 m")),
            ("-1.8 m", format!("{y}1 m")),
            ("-3.8 m", format!("{y}3 m")),
        ] {
            text = text.replace(from, &to);
        }
        format!("{WAYS}{text}")
    };
    // Around the origin, which is the place of the impact.
    let over = format!("{WAYS}{}", OBSTACLE.replace("-3 m", "3 m").replace("-1.8 m", "1.8 m"));
    refused(
        "s4.toml",
        "demand",
        sight,
        &over,
        &["the obstacle \"van\" lies on the place of the impact", "s4.toml:11:1"],
    );
    // Across the way of the car, 25 m to 20 m before the impact.
    let across = format!(
        "{WAYS}{}",
        OBSTACLE.replace("-8 m", "-25 m").replace("-3 m", "-20 m").replace("-1.8 m", "1.8 m")
    );
    refused(
        "s5.toml",
        "demand",
        sight,
        &across,
        &["driver's eye", "runs through the obstacle \"van\"", "s5.toml:11:1"],
    );
    // Far beyond the impact.
    refused(
        "s6.toml",
        "demand",
        sight,
        &moved("1", "7"),
        &["no obstacle hides the other party in the 10 s", "s6.toml:6:20"],
    );
    let open = format!("[avoid]\n{}\n{}", RIGHT.map(|(_, line)| line).join("\n"), moved("1", "7"));
    let output = deltav(&["avoid", &written("s7.toml", &open)]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("The obstacles never hide the other party in the 10 s"), "{text}");
    // A skid of 34 m before the view became free, 20.7 m before the impact.
    let skid =
        "[vehicle1]\nspeed = \"5 m/s\"\n[vehicle1.before]\nskid = { length = \"34 m\", friction = 0.7 }\n";
    let early = format!(
        "{skid}[avoid]\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n{sight}\n{WAYS}{OBSTACLE}"
    );
    let output = deltav(&["avoid", &written("s8.toml", &early)]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("which is the moment when the view became free"), "{message}");
}

#[test]
fn braking_beyond_what_is_known_of_dry_roads_is_warned_of() {
    for (deceleration, warns) in
        [("1.0 g", false), ("9.8 m/s^2", false), ("10.3 m/s^2", true), ("1.2 g", true)]
    {
        let lines = RIGHT.map(|(_, line)| line).join("\n").replace("7 m/s^2", deceleration);
        let found = avoid("hard.toml", &format!("[avoid]\n{lines}\n"));
        let warnings = found["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), usize::from(warns), "{deceleration}: {warnings:?}");
        let text = deltav(&["avoid", &temporary("hard.toml").display().to_string()]).stdout;
        assert_eq!(String::from_utf8_lossy(&text).contains("Warning: The deceleration of the inputs"), warns);
    }
    // A demand before the other party came into sight.
    let lines = RIGHT.map(|(_, line)| line).join("\n");
    let early = avoid("early.toml", &format!("[avoid]\n{lines}\n{WAYS}{OBSTACLE}"));
    assert!(early["warnings"][0].as_str().unwrap().contains("came into sight"), "{early}");
}
