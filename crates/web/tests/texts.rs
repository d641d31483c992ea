//! The problems of a text, with their places as a browser counts them.

use case::CaseFile;
use serde_json::Value;

use crate::{example, fixture, json, made, number};

/// The text that a browser has between two of its places.
fn cut(text: &str, value: &Value) -> String {
    let units: Vec<u16> = text.encode_utf16().collect();
    let [from, to] = ["from", "to"].map(|end| usize::try_from(value[end].as_u64().unwrap()).unwrap());
    String::from_utf16(&units[from..to]).unwrap()
}

#[test]
fn places_are_those_of_a_browser() {
    // Two bytes and one unit; three and one; four and two.
    let text =
        "title = \"Δ√😀\"\n[vehicle1]\nmass = \"1500 kg\" # µ😀\nspeed = 35\n[vehicle2]\nfixed = true\n";
    let checked = json(deltav_web::check(text, None));
    assert_eq!(checked["ok"], false);
    let [problem] = &checked["problems"].as_array().unwrap()[..] else { panic!("{checked:#}") };
    assert_eq!(cut(text, problem), "35");
    assert_eq!(problem["key"], "vehicle1.speed");
    assert_eq!([&problem["line"], &problem["column"]], [4, 9]);
    assert!(problem["help"].as_str().unwrap().contains("speed = \""));
    for (key, written) in
        [("title", "\"Δ√😀\""), ("vehicle1.mass", "\"1500 kg\""), ("vehicle2.fixed", "true")]
    {
        let value = &checked["values"][key];
        assert_eq!(cut(text, value), written);
        assert_eq!(value["text"], written);
    }
    let edited = made(deltav_web::edit(text, "vehicle1.speed", "\"35 mph\""));
    let text = edited["text"].as_str().unwrap();
    assert_eq!(cut(text, &edited), "\"35 mph\"");
    assert_eq!(json(deltav_web::check(text, None))["ok"], true);
    assert_eq!(
        made(deltav_web::edit(text, "vehicle1.speed", ""))["text"],
        text.replace("speed = \"35 mph\"\n", "")
    );
}

#[test]
fn a_case_says_what_it_can_be_used_for() {
    let checked = json(deltav_web::check(&example(), None));
    assert_eq!(checked["units"], "us");
    for command in ["reconstruct", "compare", "sensitivity"] {
        assert_eq!(checked["commands"][command]["able"], true, "{command}");
    }
    for (command, lacks) in [("impact", "speed"), ("motion", "surface"), ("crush", "pdof")] {
        assert_eq!(checked["commands"][command]["able"], false, "{command}");
        let why = checked["commands"][command]["why"].to_string();
        assert!(why.contains(lacks), "{command}: {why}");
    }
    assert!(checked["judgement_html"].as_str().unwrap().contains("3696 lb"));
}

#[test]
fn the_example_has_the_answer_of_the_paper() {
    let answer = made(deltav_web::answer(&example(), "", "", Some("sae-980025.toml".to_owned())));
    assert_eq!(answer["command"], "reconstruct");
    // SAE 980025, appendix: 75 ft/s, which is 51.1 mph.
    assert!(answer["text"].as_str().unwrap().contains("75.03 ft/s"));
    let data: Value = serde_json::from_str(answer["json"].as_str().unwrap()).unwrap();
    assert!((number(&data["found"]["value"]) - 22.9).abs() < 0.05);
    let codes: Vec<&str> = answer["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|warning| warning["code"].as_str().unwrap())
        .collect();
    let warned: Vec<&str> = data["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|warning| warning["code"].as_str().unwrap())
        .collect();
    assert_eq!(codes, warned);
    for warning in answer["warnings"].as_array().unwrap() {
        let keys: Vec<&str> =
            warning["keys"].as_array().unwrap().iter().map(|key| key.as_str().unwrap()).collect();
        assert!(!keys.is_empty() && keys.iter().all(|key| report::topic(key).is_ok()), "{warning:#}");
    }
    assert!(answer["csv"].as_str().unwrap().lines().count() == 2);
    for command in ["compare", "sensitivity"] {
        assert!(
            made(deltav_web::answer(&example(), command, "si", None))["html"].as_str().unwrap().len() > 100
        );
    }
}

#[test]
fn the_data_is_that_of_the_library_for_every_unit() {
    for name in ["sae-980025.toml", "rear-end-rest.toml", "sae-980025-z-down.toml"] {
        let text = fixture(name);
        let file = CaseFile::parse(name, &text).unwrap();
        let expected = report::json(&file, &analysis::reconstruct(&file.case).unwrap()).unwrap();
        for units in ["", "si", "us"] {
            let answer = made(deltav_web::answer(&text, "reconstruct", units, Some(name.to_owned())));
            assert_eq!(answer["json"], expected, "{name}");
        }
    }
}

#[test]
fn what_cannot_be_done_is_said_in_sentences() {
    let wrong = json(deltav_web::answer("[vehicle1", "", "", None));
    assert_eq!(wrong["ok"], false);
    assert!(!wrong["problems"].as_array().unwrap().is_empty());
    let lacks = json(deltav_web::answer(&example(), "impact", "", None));
    let [problem] = &lacks["problems"].as_array().unwrap()[..] else { panic!("{lacks:#}") };
    assert_eq!(problem["key"], "vehicle1.speed");
    let jam = json(deltav_web::answer(&fixture("no-answer/not-reached.toml"), "reconstruct", "", None));
    assert!(jam["problems"].as_array().unwrap().is_empty() && jam["message"].as_str().unwrap().len() > 20);
    for (answer, expected) in [
        (deltav_web::answer(&example(), "solve", "", None), "no command \"solve\""),
        (deltav_web::answer(&example(), "", "imperial", None), "not \"imperial\""),
        (deltav_web::draw(&example(), "photo", ""), "no drawing \"photo\""),
        (deltav_web::draw(&example(), "motion", ""), "the motion to rest needs it"),
        (deltav_web::edit(&example(), "vehicle1.wieght", "1"), "no key \"vehicle1.wieght\""),
        (deltav_web::edit("[", "title", "\"a\""), "cannot be read as TOML"),
        (deltav_web::convert("10 mph", "kg"), "not a quantity"),
        (deltav_web::scene(&example(), "", "", "{"), "a viewport is"),
        (deltav_web::motion(&fixture("rear-end-rest.toml"), "", "1"), "times are"),
    ] {
        let answer = json(answer);
        assert_eq!(answer["ok"], false);
        assert!(answer["message"].as_str().unwrap().contains(expected), "{answer:#}");
    }
}

/// By the definitions of the units: 1 mph is 1.609344 km/h (NIST SP 811, B.8).
#[test]
fn quantities_are_converted() {
    for (text, unit, expected) in [
        ("10 mph", "km/h", "16.09344 km/h"),
        ("65 in", "cm", "165.1 cm"),
        ("3696 lb", "kg", "1676.4774 kg"),
        ("-23 deg", "rad", "-0.401425728 rad"),
    ] {
        assert_eq!(made(deltav_web::convert(text, unit))["text"], expected);
    }
}

#[test]
fn every_drawing_is_that_of_the_library() {
    let text = fixture("rear-end-rest.toml");
    let file = CaseFile::parse("case.toml", &text).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    for subject in report::Subject::ALL {
        let ours = json(deltav_web::draw(&text, subject.name(), ""));
        match report::drawing(&file, &analysis, report::Units::Si, subject) {
            Ok(drawing) => assert_eq!(ours["svg"], drawing.svg(), "{}", subject.name()),
            Err(error) => assert_eq!(ours["message"], error.to_string()),
        }
    }
}

#[test]
fn the_page_speaks_of_what_it_has_and_not_of_commands() {
    for text in ["", "[vehicle1]\nmass = \"1000 kg\"\n", &example().replace("speed", "# speed")] {
        let said = json(deltav_web::check(text, None));
        let looked = json(deltav_web::look(text, "", "", "none", ""));
        for said in [&said["problems"], &said["commands"], &looked["problems"], &looked["message"]] {
            assert!(!said.to_string().contains("`deltav "), "{said:#}");
        }
    }
}

#[test]
fn a_comparison_and_a_sensitivity_are_pages_of_their_own() {
    for (command, part) in [("compare", "ishikawa"), ("sensitivity", "impact.crush_plane")] {
        let page = made(deltav_web::report(&example(), "example.toml", command, "", None));
        let html = page["html"].as_str().unwrap();
        assert!(html.starts_with("<!DOCTYPE html>"), "{command}");
        assert!(html.to_lowercase().contains(part), "{command}");
    }
}
