//! Avoidability and recorders: what is seen at once, the box for a table, and what the page asks at first.

use serde_json::Value;

use crate::{fixture, json, made};

fn look(text: &str) -> Value {
    json(deltav_web::look(text, "", "", "scene", ""))
}

#[test]
fn a_case_of_avoidability_alone_leads_there() {
    let looked = look(&fixture("avoid/pedestrian.toml"));
    assert_eq!((&looked["ok"], &looked["command"]), (&true.into(), &"avoid".into()), "{looked:#}");
    assert_eq!(looked["able"], serde_json::json!(["avoid"]));
    // From 30 km/h = 25/3 m/s: 25/3 (0.8 + 0.2/2) + (25/3)²/15 − 7.5 · 0.2²/24 = 12.117 m of the 20 m, which
    // leaves 7.88 m.
    let headline = looked["headline"].to_string();
    assert!(headline.contains("Avoidable in space at 30") && headline.contains("7.88 m"), "{headline}");
    assert!(looked["scene"].is_null());
    // Below the limit, it is asked of the speed driven.
    let above = fixture("avoid/pedestrian.toml").replace("\"30 km/h\"", "\"60 km/h\"");
    assert!(look(&above)["headline"].to_string().contains("at the speed driven"));
}

#[test]
fn other_cases_have_avoidability_as_one_of_their_questions() {
    let checked = json(deltav_web::check(&fixture("avoid/evidence.toml"), None));
    assert_eq!(checked["commands"]["avoid"]["able"], true);
    let without = json(deltav_web::check(&fixture("sae-980025.toml"), None));
    assert_eq!(without["commands"]["avoid"]["able"], false);
    assert_eq!(without["commands"]["recorder"]["able"], false);
    // A speed that is sought takes its time: there is no headline yet.
    let sought = json(deltav_web::look(&fixture("avoid/evidence.toml"), "avoid", "", "none", ""));
    assert_eq!((&sought["ok"], &sought["headline"]), (&true.into(), &serde_json::json!([])));
}

const BARE: &str = "title = \"A table\" # kept\n";
const TABLE: &str = "Times (sec)\tSpeed, Vehicle Indicated MPH [km/h]\tService Brake (On, Off)\r\n\
                     -1.0\t36 [58]\tOff\r\n-0.5\t34 [55]\tOn\r\n0.0\t30 [48]\tOn\r\n";

#[test]
fn a_table_is_pasted_as_it_was_copied() {
    let pasted = made(deltav_web::paste(BARE, "vehicle1.recorder.pre_crash", TABLE));
    let text = pasted["text"].as_str().unwrap();
    assert!(
        text.starts_with("title = \"A table\" # kept\n") && text.contains("-0.5\t34 [55]\tOn\n"),
        "{text}"
    );
    let answer = made(deltav_web::answer(text, "recorder", "si", None));
    let data: Value = serde_json::from_str(answer["json"].as_str().unwrap()).unwrap();
    let speed = data.to_string();
    // 58, 55 and 48 km/h, of which the last is 40/3 m/s.
    assert!(speed.contains("13.333333333333"), "{speed}");
    assert_eq!(answer["charts"].as_array().unwrap().len(), 1);
    assert!(answer["csv"].as_str().unwrap().lines().count() > 3);
    assert_eq!(look(text)["able"], serde_json::json!(["recorder"]));
    // Another table takes its place.
    let again = made(deltav_web::paste(text, "vehicle1.recorder.pre_crash", &TABLE.replace("58", "59")));
    assert!(!again["text"].as_str().unwrap().contains("[58]"));
}

#[test]
fn quotes_and_backslashes_of_a_table_stay_what_they_are() {
    let table = "Times (sec) \"Speed\" (km/h) \\n\n-1 50\n0 40\n";
    let pasted = made(deltav_web::paste("[vehicle1]\nname = \"a\"\n", "vehicle1.recorder.pre_crash", table));
    let file = case::CaseFile::parse("case.toml", pasted["text"].as_str().unwrap()).unwrap();
    let recorder = file.case.vehicles[0].recorder.as_ref().unwrap();
    let case::SeriesSource::Text(text) = &recorder.pre_crash.as_ref().unwrap().source else {
        panic!("no text")
    };
    assert_eq!(text.as_given(), table);
}

#[test]
fn what_is_no_table_is_refused_and_says_why() {
    for table in ["", "  \n", "hello, this is my crash", "Times (sec) Speed (km/h)\n"] {
        let refused = json(deltav_web::paste(BARE, "vehicle1.recorder.pre_crash", table));
        assert_eq!(refused["ok"], false, "{table}");
        assert!(refused["message"].as_str().unwrap().len() > 20, "{refused:#}");
    }
    // Errors elsewhere do not keep a table out.
    let elsewhere = "[vehicle2]\nmass = \"heavy\"\n";
    made(deltav_web::paste(elsewhere, "vehicle1.recorder.pre_crash", TABLE));
    // A file that is not TOML has to be corrected first.
    let broken = json(deltav_web::paste("[vehicle1", "vehicle1.recorder.pre_crash", TABLE));
    assert!(broken["message"].as_str().unwrap().contains("TOML"));
}

/// A table of the other kind says which it is, and which is to be chosen.
#[test]
fn a_table_of_the_other_kind_says_where_it_belongs() {
    const PULSE: &str = "Time (msec)\tLongitudinal Delta-V (km/h)\n0\t0\n10\t-4\n20\t-9\n";
    for (table, wrong, right, kind, wanted) in [
        (PULSE, "pre_crash", "pulse", "ΔV over time", "speeds before the impact"),
        (TABLE, "pulse", "pre_crash", "speeds before the impact", "ΔV over time"),
    ] {
        let refused = json(deltav_web::paste(BARE, &format!("vehicle1.recorder.{wrong}"), table));
        assert_eq!(refused["ok"], false, "{refused:#}");
        let problem = &refused["problems"][0];
        let title = format!("this is a table of {kind}, not of {wanted}: the program read \"Time");
        assert!(problem["title"].as_str().unwrap().starts_with(&title), "{refused:#}");
        assert_eq!(problem["help"], format!("give it as `{right}`"));
        made(deltav_web::paste(BARE, &format!("vehicle1.recorder.{right}"), table));
    }
}

#[test]
fn every_template_says_what_it_is_for() {
    for template in json(deltav_web::templates()).as_array().unwrap() {
        let purpose = template["purpose"].as_str().unwrap();
        assert!(purpose.len() > 60 && purpose.len() < 700, "{}: {purpose}", template["name"]);
        assert!(!purpose.contains("for editors") && !purpose.contains('#'), "{purpose}");
        let first = purpose.split_whitespace().take(4).collect::<Vec<_>>().join(" ");
        assert!(template["text_us"].as_str().unwrap().contains(&first), "{first}");
    }
    let example = &json(deltav_web::templates())[0]["purpose"];
    assert!(example.as_str().unwrap().starts_with("The example of SAE 980025"), "{example}");
    let avoid = json(deltav_web::templates());
    let avoid = avoid.as_array().unwrap().iter().find(|one| one["name"] == "avoid").unwrap();
    assert!(avoid["purpose"].as_str().unwrap().contains("pedestrian"));
}
