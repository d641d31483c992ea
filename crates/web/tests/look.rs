//! The first view has the same content as the other functions.

use serde_json::Value;

use crate::{fixture, json, made, number};

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
                // Any other question is answered by what it asks for.
                assert!(command == "reconstruct" || look["exact"].is_null(), "{name} {command} {look:#}");
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
/// the exact solution as what is not the answer, and no speed to show as the answer.
#[test]
fn a_look_has_the_exact_solution_that_is_not_the_answer() {
    let text = fixture("rear-end.toml") + "\n[estimate]\ncrush_bias = \"100 %\"\n";
    assert_eq!(look(&text, "", "none")["exact"], Value::Null);
    let more = format!("{text}\n[vehicle1.recorder]\nspeed = \"20 km/h\"\n");
    let looked = look(&more, "", "scene");
    let exact = &looked["exact"];
    assert_eq!(exact["by"], "damage and the given speed");
    let headline = looked["headline"].to_string();
    assert!(!headline.contains("km/h") && !headline.contains("mph"), "{headline}");
    // The figures are those of the program.
    let answer = made(deltav_web::answer(&more, "", "", None));
    let data: Value = serde_json::from_str(answer["json"].as_str().unwrap()).unwrap();
    let speed = number(&data["found"]["value"]);
    for (units, figure) in
        [("si", format!("{:.1} km/h", speed * 3.6)), ("us", format!("{:.2} mph", speed / 0.44704))]
    {
        let exact = &made(deltav_web::look(&more, "", units, "none", ""))["exact"];
        assert_eq!(exact["speeds"][0], figure);
        // The row of the table has the four figures in their order.
        let row = ["speeds", "delta_v"].into_iter().flat_map(|of| [&exact[of][0], &exact[of][1]]);
        let row: Vec<&str> = row.map(|figure| figure.as_str().unwrap()).collect();
        let page = made(deltav_web::answer(&more, "", units, None));
        let page = page["text"].as_str().unwrap();
        let line = page.lines().find(|line| line.starts_with("damage and the given speed")).unwrap();
        let words = line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(words, format!("damage and the given speed {}", row.join(" ")));
    }
    // The sentence is that of the drawings.
    let caveat = exact["caveat"].as_str().unwrap();
    assert_eq!(
        caveat,
        "Exact solution by damage and the given speed, not the answer: other evidence of the case contradicts it."
    );
    assert!(looked["scene"]["description"].as_str().unwrap().ends_with(caveat), "{looked:#}");
}

#[test]
fn a_fixed_object_has_no_figure() {
    let given = "{ A = \"317 lb/in\", B = \"56 lb/in^2\", G = \"901 lb\" }";
    let text = fixture("barrier.toml").replace(given, "{ category = 3 }");
    let exact = &look(&text, "", "none")["exact"];
    for figures in ["speeds", "delta_v"] {
        assert!(exact[figures][0].is_string() && exact[figures][1].is_null(), "{exact:#}");
    }
}

/// Warnings on an exact solution that is not the answer are told apart from those on the case.
#[test]
fn a_warning_is_aside_if_it_concerns_only_what_is_not_the_answer() {
    let codes = |name: &str, aside: bool| {
        let looked = look(&fixture(name), "", "none");
        let warnings = looked["warnings"].as_array().unwrap().iter();
        let of_kind = warnings.filter(|warning| warning["aside"] == aside);
        of_kind.map(|warning| warning["code"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    for (name, own, aside) in [
        (
            "edcrash-tutorial.toml",
            &["contact-apart", "contact-placed", "contact-placed"][..],
            &["momentum-differs"][..],
        ),
        ("rear-end.toml", &[], &["category-energy"]),
        // The exact solution is the answer.
        ("ricsac/03.toml", &["given-speed-unused", "contact-outside", "contact-off-damage"], &[]),
    ] {
        assert_eq!(codes(name, false), own, "{name}");
        assert_eq!(codes(name, true), aside, "{name}");
    }
}
