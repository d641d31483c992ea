//! The first view has the same content as the other functions.

use serde_json::Value;

use crate::{fixture, json, made};

fn look(text: &str, command: &str, what: &str) -> Value {
    json(deltav_web::look(text, command, "", what, ""))
}

#[test]
fn a_look_is_the_answer_and_the_scene() {
    let mut scenes = 0;
    for name in [
        "sae-980025.toml",
        "sae-980025-z-down.toml",
        "sae-980025-crush.toml",
        "rear-end-rest.toml",
        "one-vehicle.toml",
        "motion/ricsac-6.toml",
        "ricsac/03.toml",
    ] {
        let text = fixture(name);
        let able = look(&text, "", "none")["able"].clone();
        assert!(!able.as_array().unwrap().is_empty(), "{name}");
        for command in able.as_array().unwrap().iter().map(|command| command.as_str().unwrap()) {
            let answer = made(deltav_web::answer(&text, command, "", None));
            for what in ["scene", "motion", "", "none"] {
                let look = look(&text, command, what);
                assert_eq!(look["ok"], true, "{name} {command} {look:#}");
                for same in ["command", "headline", "warnings"] {
                    assert_eq!(look[same], answer[same], "{name} {command} {same}");
                }
                let own = json(deltav_web::scene(&text, what, "", ""));
                let usual = json(deltav_web::scene(&text, "", "", ""));
                let expected = [own, usual].into_iter().find(|scene| scene["ok"] == true);
                let expected = expected.filter(|_| what != "none").unwrap_or_default();
                scenes += usize::from(!expected.is_null());
                assert_eq!(look["scene"], expected, "{name} {command} {what}");
            }
        }
    }
    assert!(scenes > 20, "{scenes}");
}

#[test]
fn a_case_is_asked_for_what_it_is_made_for() {
    let text = fixture("sae-980025.toml");
    for (asked, expected) in [("", "reconstruct"), ("impact", "reconstruct"), ("reconstruct", "reconstruct")]
    {
        let look = look(&text, asked, "");
        assert_eq!((&look["command"], &look["units"]), (&expected.into(), &"us".into()), "{asked}");
    }
    let rest = fixture("rear-end-rest.toml");
    assert_eq!(look(&rest, "motion", "")["command"], "motion");
    // A viewport keeps the picture still.
    let viewport = r#"{"left":-4,"bottom":-3,"right":4,"top":3}"#;
    let still = made(deltav_web::look(&text, "", "", "scene", viewport));
    assert_eq!(still["scene"], made(deltav_web::scene(&text, "scene", "", viewport)));
}

#[test]
fn what_is_wrong_is_said() {
    let unreadable = look("[vehicle1", "", "");
    assert_eq!(unreadable["ok"], false);
    assert_eq!(unreadable["problems"], json(deltav_web::check("[vehicle1", None))["problems"]);
    assert!(unreadable["command"].is_null() && unreadable["scene"].is_null());
    // It can be read, and has no answer: the reason is that of the answer.
    for name in ["no-answer/not-reached.toml", "no-answer/jam.toml"] {
        let text = fixture(name);
        let look = look(&text, "", "");
        let answer = json(deltav_web::answer(&text, look["command"].as_str().unwrap(), "", None));
        assert_eq!(look["ok"], false, "{name}");
        assert!(look["message"].as_str().unwrap().len() > 20);
        assert_eq!(
            (&look["message"], &look["problems"]),
            (&answer["message"], &answer["problems"]),
            "{name}"
        );
    }
}

/// A case with more evidence than its exact solution uses gets its answer from an estimate: the page receives
/// a flag for that, and no speed to show.
#[test]
fn a_look_says_whether_all_the_evidence_has_to_be_weighed() {
    let text = fixture("rear-end.toml") + "\n[estimate]\ncrush_bias = \"100 %\"\n";
    assert_eq!(look(&text, "", "none")["weigh"], false);
    let more = format!("{text}\n[vehicle1.recorder]\nspeed = \"20 km/h\"\n");
    let look = look(&more, "", "scene");
    assert_eq!(look["weigh"], true);
    let headline = look["headline"].to_string();
    assert!(!headline.contains("km/h") && !headline.contains("mph"), "{headline}");
    assert!(look["scene"]["svg"].as_str().unwrap().contains("not the answer"));
}
