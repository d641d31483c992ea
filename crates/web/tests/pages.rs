//! Templates, the form, the glossary and reports.

use std::collections::BTreeSet;

use case::{KeyInfo, key_tree};
use serde_json::Value;

use crate::{example, json, made};

#[test]
fn every_template_is_a_case_with_an_answer() {
    let templates = json(deltav_web::templates());
    assert_eq!(templates[0]["text_us"], example());
    assert_eq!(templates.as_array().unwrap().len(), 1 + case::Template::WORDS.len());
    for template in templates.as_array().unwrap() {
        assert!(template["title"].as_str().is_some_and(|title| title.len() > 5), "{template:#}");
        for text in ["text_si", "text_us"] {
            let text = template[text].as_str().unwrap();
            assert_eq!(json(deltav_web::check(text, None))["ok"], true);
            // Long computations are for a worker, and one vehicle alone has tables.
            let looked = made(deltav_web::look(text, "", "", "none", ""));
            let leads = looked["exact"].is_object() || looked["headline"][0].is_string();
            assert!(leads || looked["command"] == "crush", "{looked:#}");
        }
    }
}

/// The paths of all keys but those of ranges.
fn keys(keys: &'static [KeyInfo], above: &str, all: &mut BTreeSet<String>) {
    for key in keys {
        let path = if above.is_empty() { key.name.to_owned() } else { format!("{above}.{}", key.name) };
        self::keys(key.form.keys(), &path, all);
        all.insert(path);
    }
}

fn fields(value: &Value, all: &mut BTreeSet<String>) {
    let key = value["key"].as_str().unwrap();
    if !key.is_empty() {
        assert!(all.insert(key.to_owned()), "{key} twice");
    }
    assert!(!value["title"].as_str().unwrap().is_empty(), "{key}");
    for below in ["fields", "groups"] {
        for one in value[below].as_array().into_iter().flatten() {
            fields(one, all);
        }
    }
}

#[test]
fn the_form_has_every_key_once() {
    let form = json(deltav_web::form());
    let (mut expected, mut found) = (BTreeSet::new(), BTreeSet::new());
    keys(key_tree().keys, "", &mut expected);
    for group in form.as_array().unwrap() {
        fields(group, &mut found);
    }
    assert_eq!(found, expected);
    let vehicle = form.as_array().unwrap().iter().find(|group| group["key"] == "vehicle1").unwrap();
    let field = |name: &str| {
        vehicle["fields"]
            .as_array()
            .unwrap()
            .iter()
            .find(|field| field["key"] == format!("vehicle1.{name}"))
            .unwrap()
    };
    let mass = field("mass");
    assert_eq!(mass["kind"], "quantity");
    assert_eq!(mass["range"], true);
    assert!(mass["units"].as_array().unwrap().iter().any(|unit| unit == "lb"));
    assert_eq!(field("kind")["choices"][0], "car");
    let crush =
        vehicle["groups"].as_array().unwrap().iter().find(|group| group["key"] == "vehicle1.crush").unwrap();
    assert_eq!(crush["choices"], serde_json::json!(["none"]));
}

#[test]
fn topics_are_explained_and_others_proposed() {
    for topic in report::topics() {
        let explained = json(deltav_web::explain(topic.name));
        assert_eq!(explained["title"], topic.name);
        assert!(explained["html"].as_str().unwrap().contains("<p>"));
    }
    let unknown = json(deltav_web::explain("restituton"));
    assert_eq!(unknown["nearest"][0], "restitution");
    assert!(unknown["error"].as_str().unwrap().contains("restituton"));
}

#[test]
fn a_title_with_script_stays_text() {
    let text = example().replace("Intersection collision", "<script>alert(1)</script>");
    let answer = made(deltav_web::answer(&text, "", "", None));
    let report = made(deltav_web::report(&text, "a<b>.toml", "", "", None));
    let scene = made(deltav_web::scene(&text, "", "", ""));
    for html in [&answer["html"], &report["html"], &scene["svg"]] {
        let html = html.as_str().unwrap();
        assert!(!html.contains("<script") && !html.contains("<b>"), "{html}");
        assert!(html.contains("&lt;script&gt;"));
    }
}

#[test]
fn a_live_report_is_made_of_the_report() {
    let page = format!(
        "<meta name=\"deltav-engine\" content=\"{}\"><script type=\"application/json\" id=\"deltav-live\">null</script>",
        report::sha256(b"engine")
    );
    let live = made(deltav_web::live(&page, &example(), "a.toml", "", "", None));
    let report = made(deltav_web::report(&example(), "a.toml", "", "", None));
    let digest = report::sha256(report["html"].as_str().unwrap().as_bytes());
    assert!(live["html"].as_str().unwrap().contains(&digest));
    assert_eq!(json(deltav_web::live("", &example(), "a.toml", "", "", None))["ok"], false);
}
