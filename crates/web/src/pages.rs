//! Templates and the glossary.

use case::{CaseFile, EXAMPLE, Template, UnitSystem};
use serde_json::{Value, json};

pub(crate) fn templates() -> Value {
    let template = |name: &str, si: &str, us: &str| {
        let parsed = CaseFile::parse(name, us);
        let title = parsed.ok().and_then(|file| file.case.title).map(|title| title.as_given().to_owned());
        json!({ "name": name, "title": title.as_deref().unwrap_or(name), "text_si": si, "text_us": us })
    };
    let mut templates = vec![template("sae-980025", EXAMPLE, EXAMPLE)];
    // The page asks neither whether a collision was avoidable nor what a recorder says alone.
    let is_shown = |one: &Template| !matches!(one, Template::Avoid | Template::Recorder);
    let shown = Template::WORDS.into_iter().filter(|(_, one)| is_shown(one));
    templates
        .extend(shown.map(|(name, one)| template(name, one.text(UnitSystem::Si), one.text(UnitSystem::Us))));
    Value::Array(templates)
}

pub(crate) fn explain(word: &str) -> Value {
    match report::topic(word) {
        Ok(topic) => json!({ "title": topic.name, "html": report::explanation(topic).html_fragment() }),
        Err(unknown) => json!({ "error": unknown.to_string(), "nearest": unknown.nearest }),
    }
}

pub(crate) fn topics() -> Value {
    report::topics().iter().map(|topic| topic.name).collect()
}
