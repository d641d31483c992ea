//! The places of elements in a picture that the user edits.

use crate::{assert_near, example, fixture, made, number, pair};
use serde_json::{Value, json};

/// The numbers of an attribute of the element with this id.
fn attribute(svg: &str, id: &str, name: &str) -> Vec<f64> {
    let element = svg
        .split('<')
        .find(|element| element.contains(&format!("id=\"{id}\"")))
        .unwrap_or_else(|| panic!("{id}"));
    let value = element.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap();
    value.split([' ', ',']).map(|number| number.parse().unwrap()).collect()
}

/// (px) where a place (m) is in the picture.
fn on_page(scene: &Value, [x, y]: [f64; 2]) -> [f64; 2] {
    let ([left, top], scale) = (pair(&scene["origin"]), number(&scene["scale"]));
    [left + scale * x, top - scale * y]
}

fn handle<'a>(scene: &'a Value, kind: &str, vehicle: u64) -> &'a Value {
    let handles = scene["handles"].as_array().unwrap();
    let found = handles
        .iter()
        .find(|one| one["kind"] == kind && (one["vehicle"].is_null() || one["vehicle"] == vehicle));
    found.unwrap_or_else(|| panic!("no {kind} of {vehicle}"))
}

#[test]
fn places_are_where_the_picture_has_them() {
    let scene = made(deltav_web::scene(&example(), "", "", ""));
    let svg = scene["svg"].as_str().unwrap();
    assert_eq!(scene["what"], "scene");
    // Coordinates in the SVG have two decimals.
    for vehicle in [1, 2] {
        let body = &scene["bodies"][vehicle - 1];
        let there = on_page(&scene, pair(&body["centre"]));
        let drawn = attribute(svg, &format!("scene-velocity-before-{vehicle}"), "data-from");
        assert_near(there[0], drawn[0], 0.006);
        assert_near(there[1], drawn[1], 0.006);
    }
    // The contact point is 6.3 ft from the CG of vehicle 1, 22.4° to the right of its axis, which points to
    // 180°.
    let angle = (180.0_f64 - 22.4).to_radians();
    let arm = [6.3 * 0.3048 * angle.cos(), 6.3 * 0.3048 * angle.sin()];
    let centre = pair(&scene["bodies"][0]["centre"]);
    assert_near(centre[0], -arm[0], 1e-9);
    assert_near(centre[1], -arm[1], 1e-9);
    assert_near(number(&scene["bodies"][1]["heading"]), 67_f64.to_radians(), 1e-12);
    let plane = pair(&handle(&scene, "plane", 1)["at"]);
    // Along the plane, so at a right angle to n, which points to −23° or against that.
    assert_near(
        plane[0] * (-23_f64).to_radians().cos() + plane[1] * (-23_f64).to_radians().sin(),
        0.0,
        1e-12,
    );
    // Six stations, of which the first is 21.3 in deep.
    let stations = scene["handles"].as_array().unwrap().iter().filter(|one| one["kind"] == "station").count();
    assert_eq!(stations, 12);
}

#[test]
fn a_viewport_holds_the_picture_still() {
    let text = example();
    let first = made(deltav_web::scene(&text, "", "", ""));
    let viewport = first["viewport"].to_string();
    let turned = text.replace("heading     = \"67 deg\"", "heading     = \"40 deg\"");
    assert_ne!(turned, text);
    let free = made(deltav_web::scene(&turned, "", "", ""));
    let held = made(deltav_web::scene(&turned, "", "", &viewport));
    assert_ne!(free["origin"], first["origin"]);
    for (one, other) in pair(&held["origin"]).into_iter().zip(pair(&first["origin"])) {
        assert_near(one, other, 1e-9);
    }
    assert_near(number(&held["scale"]), number(&first["scale"]), 1e-9);
    for side in ["left", "bottom", "right", "top"] {
        assert_near(number(&held["viewport"][side]), number(&first["viewport"][side]), 1e-9);
    }
    assert_eq!(made(deltav_web::scene(&text, "", "", &viewport))["svg"], first["svg"]);
    // An invalid part is not accepted.
    let empty = json!({ "left": 1, "bottom": 0, "right": 1, "top": 2 }).to_string();
    assert_eq!(made(deltav_web::scene(&text, "", "", &empty))["svg"], first["svg"]);
}

#[test]
fn a_motion_is_drawn_with_its_rests_and_played() {
    let text = fixture("rear-end-rest.toml");
    let scene = made(deltav_web::scene(&text, "motion", "", ""));
    assert_eq!(pair(&handle(&scene, "rest", 2)["at"]), [19.0, 0.3]);
    let viewport = scene["viewport"].to_string();
    let again = made(deltav_web::scene(&text, "motion", "", &viewport));
    assert_eq!(again["svg"], scene["svg"]);

    let motion = made(deltav_web::motion(&text, "", ""));
    let frames = motion["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 61);
    assert_eq!(number(&frames[0]["time"]), -1.0);
    assert_near(number(&frames[60]["time"]), number(&motion["duration"]), 1e-12);
    // The path ends at the given place; along one line, only its length was sought.
    let answer = made(deltav_web::answer(&text, "", "", None));
    let data: Value = serde_json::from_str(answer["json"].as_str().unwrap()).unwrap();
    for (vehicle, found) in [("vehicle1", 2.6), ("vehicle2", 19.0)] {
        let body = if vehicle == "vehicle1" { 0 } else { 1 };
        let end = pair(&frames[60]["bodies"][body]["centre"]);
        let rest = &data[vehicle]["rest"];
        assert_near(end[0], number(&rest["x"]), 1e-9);
        assert_near(end[1], number(&rest["y"]), 1e-9);
        assert_near(end[0], found, 0.05);
    }
    // The contact point of vehicle 1 is 2.05 m ahead of its CG, and the impact at the origin.
    let some = made(deltav_web::motion(&text, "", "[0, -0.5]"));
    let [now, before] = [0, 1].map(|n| pair(&some["frames"][n]["bodies"][0]["centre"]));
    assert_near(now[0], -2.05, 1e-9);
    assert_near((now[0] - before[0]) / 0.5, number(&data["vehicle1"]["speed"]), 1e-9);
}
