//! Elements that are moved with the mouse are written into the text.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::{assert_near, example, fixture, json as read, made, number, pair};

fn handles(text: &str, what: &str) -> Vec<Value> {
    made(deltav_web::scene(text, what, "", ""))["handles"].as_array().unwrap().clone()
}

#[track_caller]
fn dragged(text: &str, handle: &Value, to: &Value) -> String {
    let made = made(deltav_web::drag(text, &handle.to_string(), &to.to_string()));
    made["text"].as_str().unwrap().to_owned()
}

#[track_caller]
fn find<'a>(handles: &'a [Value], kind: &str, vehicle: Value, index: Value) -> &'a Value {
    let found =
        handles.iter().find(|one| one["kind"] == kind && one["vehicle"] == vehicle && one["index"] == index);
    found.unwrap_or_else(|| panic!("no {kind}"))
}

/// A moved element is then where it was moved to, within its digits.
#[test]
fn every_handle_goes_where_it_is_moved() {
    let mut kinds = BTreeSet::new();
    for (name, what) in [
        ("sae-980025.toml", "scene"),
        ("sae-980025-z-down.toml", "scene"),
        ("sae-980025-uncertain.toml", "scene"),
        ("oncoming-sideswipe.toml", "scene"),
        ("estimate.toml", "scene"),
        ("depths-independent.toml", "scene"),
        ("rear-end-rest.toml", "motion"),
        ("motion/ricsac-6.toml", "motion"),
    ] {
        let text = fixture(name);
        let scene = read(deltav_web::scene(&text, what, "", ""));
        let (Value::Array(handles), bodies) = (&scene["handles"], &scene["bodies"]) else { continue };
        for handle in handles {
            let kind = handle["kind"].as_str().unwrap();
            let [at, centre] = [pair(&handle["at"]), pair(&handle["centre"])];
            // A little to the side; a station into the vehicle, where there is something to crush.
            let to = match kind {
                "station" => {
                    let [cg, face] =
                        [pair(&bodies[handle["vehicle"].as_u64().unwrap() as usize - 1]["centre"]), centre];
                    [at[0] + 0.1 * (cg[0] - face[0]), at[1] + 0.1 * (cg[1] - face[1])]
                }
                _ => [at[0] + 0.13, at[1] - 0.21],
            };
            let new = dragged(&text, handle, &json!({ "at": to }));
            assert_ne!(new, text, "{name} {kind}");
            // Comments stay.
            let comments = |text: &str| {
                text.lines().filter_map(|line| Some(line[line.find('#')?..].to_owned())).collect::<Vec<_>>()
            };
            assert_eq!(comments(&new), comments(&text), "{name} {kind}");
            let drawn = read(deltav_web::scene(&new, what, "", ""));
            let Value::Array(moved) = &drawn["handles"] else { continue };
            let now = find(moved, kind, handle["vehicle"].clone(), handle["index"].clone());
            let [there, pivot] = [pair(&now["at"]), pair(&now["centre"])];
            kinds.insert(kind.to_owned());
            let angle = |from: [f64; 2], to: [f64; 2]| (to[1] - from[1]).atan2(to[0] - from[0]);
            match kind {
                "heading" | "plane" | "rest_heading" => {
                    let off = angle(pivot, there) - angle(centre, to);
                    let turns = (off / std::f64::consts::TAU).round() * std::f64::consts::TAU;
                    assert!((off - turns).abs() < 0.1_f64.to_radians(), "{name} {kind}: {off}");
                }
                // The contact point is the origin of the scene, and the vehicle moves back by the same
                // distance.
                "contact" => {
                    assert_near(pivot[0], centre[0] - to[0] + at[0], 0.02);
                    assert_near(pivot[1], centre[1] - to[1] + at[1], 0.02);
                }
                "station" => {
                    let inwards = ((to[0] - at[0]).powi(2) + (to[1] - at[1]).powi(2)).sqrt();
                    let gone = ((there[0] - at[0]).powi(2) + (there[1] - at[1]).powi(2)).sqrt();
                    assert!(gone <= inwards + 0.02 && gone > 0.0, "{name} {kind}: {gone} of {inwards}");
                }
                _ => {
                    assert_near(there[0], to[0], 0.02);
                    assert_near(there[1], to[1], 0.02);
                }
            }
        }
    }
    let all = ["body", "contact", "heading", "plane", "rest", "rest_heading", "station"];
    assert!(all.iter().all(|kind| kinds.contains(*kind)), "{kinds:?}");
}

#[test]
fn numbers_keep_their_units() {
    let text = example();
    let handles = handles(&text, "scene");
    let heading = find(&handles, "heading", json!(2), Value::Null);
    let new = dragged(&text, heading, &json!({ "angle": 33.8_f64.to_radians() }));
    assert_eq!(new, text.replace("heading     = \"67 deg\"", "heading     = \"33.8 deg\""));
    // 0.1 m is 3.94 in: the third station of vehicle 1, which is 13.8 in deep, pushed in along its axis,
    // which points to −x.
    let station = find(&handles, "station", json!(1), json!(2));
    let [x, y] = pair(&station["at"]);
    let new = dragged(&text, station, &json!({ "at": [x + 0.1, y] }));
    assert_eq!(new, text.replace("21.3 20.3 13.8 11.3", "21.3 20.3 17.7 11.3"));
    // Not out of the vehicle.
    let new = dragged(&text, station, &json!({ "at": [x - 5.0, y] }));
    assert_eq!(new, text.replace("21.3 20.3 13.8 11.3", "21.3 20.3 0.0 11.3"));
    // The contact point is given by distance and angle, in feet and degrees.
    let body = find(&handles, "body", json!(1), Value::Null);
    let new = dragged(&text, body, &json!({ "at": body["at"] }));
    assert_eq!(new, text.replace("distance = \"6.3 ft\"", "distance = \"6.30 ft\""));
}

#[test]
fn a_range_moves_as_a_whole() {
    let text = example()
        .replace("heading     = \"67 deg\"", "heading     = { low = \"60 deg\", high = \"74 deg\" }")
        .replace("crush_plane = \"-23 deg\"", "crush_plane = { value = \"-23 deg\", sd = \"2 deg\" }");
    let handles = handles(&text, "scene");
    let heading = find(&handles, "heading", json!(2), Value::Null);
    let new = dragged(&text, heading, &json!({ "angle": 70_f64.to_radians() }));
    assert_eq!(
        new,
        text.replace("low = \"60 deg\", high = \"74 deg\"", "low = \"63.0 deg\", high = \"77.0 deg\"")
    );
    let plane = find(&handles, "plane", Value::Null, Value::Null);
    let [x, y] = pair(&plane["at"]);
    let turned = 5_f64.to_radians();
    let to = [x * turned.cos() - y * turned.sin(), x * turned.sin() + y * turned.cos()];
    let new = dragged(&text, plane, &json!({ "at": to }));
    assert_eq!(new, text.replace("value = \"-23 deg\"", "value = \"-18.0 deg\""));
}

#[test]
fn what_is_no_handle_is_refused() {
    for (handle, to) in [
        ("{}", "{}"),
        ("{\"kind\": \"wheel\", \"vehicle\": 1, \"at\": [0, 0]}", "{\"at\": [1, 1]}"),
        ("{\"kind\": \"heading\", \"vehicle\": 3, \"at\": [0, 0]}", "{\"at\": [1, 1]}"),
        ("{\"kind\": \"heading\", \"vehicle\": 1, \"at\": [0, 0]}", "{\"at\": [1]}"),
        ("{\"kind\": \"heading\", \"vehicle\": 1, \"at\": [0, 0]}", "{\"angle\": 1e999}"),
        ("{\"kind\": \"station\", \"vehicle\": 1, \"index\": 99, \"at\": [0, 0]}", "{\"at\": [1, 1]}"),
        ("{\"kind\": \"rest_heading\", \"vehicle\": 1, \"at\": [0, 0]}", "{\"at\": [1, 1]}"),
    ] {
        let refused = read(deltav_web::drag(&example(), handle, to));
        assert_eq!(refused["ok"], false, "{handle}");
        assert!(number(&json!(refused["message"].as_str().unwrap().len())) > 10.0);
    }
}

/// A site plan stays where it was placed, in both axes and both unit systems, and the program draws it there.
#[test]
fn a_site_plan_is_kept_where_it_lies() {
    let plan = json!({ "file": "aerial.jpg", "corner": [-12.34, 5.67], "width": 40.5, "angle": 0.35 });
    for (name, y) in
        [("motion/ricsac-6.toml", 5.67), ("sae-980025.toml", 5.67), ("sae-980025-z-down.toml", -5.67)]
    {
        let text = fixture(name);
        let before = read(deltav_web::scene(&text, "", "", ""));
        assert_eq!(before["plan"], Value::Null, "{name}");
        let mut kept = text.clone();
        // The first time its keys are added, then they are changed where they are.
        for moved in [[7.0, 8.0], [-12.34, 5.67]] {
            let mut plan = plan.clone();
            plan["corner"] = json!(moved);
            let made = made(deltav_web::keep_plan(&kept, &plan.to_string()));
            made["text"].as_str().unwrap().clone_into(&mut kept);
        }
        let file = case::CaseFile::parse(name, &kept).unwrap();
        let site_plan = file.case.site_plan.unwrap();
        // A mouse places a centimetre, a hundredth of a foot and a tenth of a degree.
        for (given, expected) in [
            (site_plan.corner.x.si(), -12.34),
            (site_plan.corner.y.si(), y),
            (site_plan.width.si(), 40.5),
            (site_plan.angle.unwrap().si(), 0.35_f64.copysign(y)),
        ] {
            assert_near(given, expected, 0.006);
        }
        let scene = read(deltav_web::scene(&kept, "", "", ""));
        let [x, y] = pair(&scene["plan"]["corner"]);
        assert_near(x, -12.34, 0.006);
        assert_near(y, 5.67, 0.006);
        assert_near(number(&scene["plan"]["angle"]), 0.35, 0.001);
        // No result depends on it.
        assert_eq!(
            made(deltav_web::look(&kept, "", "", "none", ""))["headline"],
            made(deltav_web::look(&text, "", "", "none", ""))["headline"],
            "{name}"
        );
    }
    let text = example();
    for wrong in ["", "{}", "{ \"file\": \"a.png\", \"corner\": [0, 0], \"width\": \"1 m\", \"angle\": 0 }"] {
        assert_eq!(read(deltav_web::keep_plan(&text, wrong))["ok"], false, "{wrong}");
    }
    let outside = json!({ "file": "../aerial.jpg", "corner": [0, 0], "width": 1, "angle": 0 });
    assert_eq!(read(deltav_web::keep_plan(&text, &outside.to_string()))["ok"], false);
}

/// A place of the ground is the same in the picture of the impact and in that of the motion.
#[test]
fn both_views_have_the_same_survey() {
    let text = fixture("rear-end-rest.toml");
    let text = made(deltav_web::edit(&text, "scene.contact", "{ x = \"12.5 m\", y = \"-3.25 m\" }"));
    let text = text["text"].as_str().unwrap();
    let [scene, motion] = ["scene", "motion"].map(|what| made(deltav_web::scene(text, what, "", "")));
    assert_eq!(motion["survey"], json!([0.0, 0.0]));
    for vehicle in 0..2 {
        let place = |view: &Value| {
            let [centre, survey] = [&view["bodies"][vehicle]["centre"], &view["survey"]].map(pair);
            [0, 1].map(|axis| centre[axis] + survey[axis])
        };
        for axis in 0..2 {
            assert_near(place(&scene)[axis], place(&motion)[axis], 1e-9);
        }
    }
}

/// TOML's literal strings, in single quotes, are texts like others.
#[test]
fn numbers_in_single_quotes_keep_their_units() {
    let text = example().replacen("heading     = \"180 deg\"", "heading = '3.14 rad'", 1).replacen(
        "\"21.3 20.3 13.8 11.3 5.3 4.8 in\"",
        "'21.3 20.3 13.8 11.3 5.3 4.8 in'",
        1,
    );
    let handles = handles(&text, "scene");
    let of = |kind: &str| {
        handles.iter().find(|handle| handle["kind"] == kind && handle["vehicle"] == 1).unwrap().clone()
    };
    let turned = dragged(&text, &of("heading"), &json!({ "angle": 0.5 }));
    let line = turned.lines().find(|line| line.starts_with("heading")).unwrap();
    assert!(line.contains("0.5") && line.ends_with(" rad\""), "{line}");
    let station = of("station");
    let [x, y] = pair(&station["at"]);
    let crushed = dragged(&text, &station, &json!({ "at": [x + 0.1, y + 0.1] }));
    assert_ne!(crushed, text);
    assert!(crushed.contains(" 20.3 13.8 11.3 5.3 4.8 in\""), "{crushed}");
}
