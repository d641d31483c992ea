//! Templates and the glossary.

use case::{CaseFile, EXAMPLE, Template, UnitSystem};
use serde_json::{Value, json};

pub(crate) fn templates() -> Value {
    let template = |name: &str, si: &str, us: &str| {
        let parsed = CaseFile::parse(name, us);
        let title = parsed.ok().and_then(|file| file.case.title).map(|title| title.as_given().to_owned());
        json!({
            "name": name,
            "title": title.as_deref().unwrap_or(name),
            "purpose": purpose(us),
            "text_si": si,
            "text_us": us,
        })
    };
    let of_kind =
        |(name, one): (&str, Template)| template(name, one.text(UnitSystem::Si), one.text(UnitSystem::Us));
    let example = template("sae-980025", EXAMPLE, EXAMPLE);
    std::iter::once(example).chain(Template::WORDS.into_iter().map(of_kind)).collect()
}

/// The description of a template at its head: the first paragraph after the lines for editors or, for a
/// published example, the whole head.
fn purpose(text: &str) -> String {
    let lines = text.lines().skip_while(|line| line.starts_with("#:schema"));
    let head = lines.map_while(|line| line.strip_prefix('#')).map(str::trim);
    let for_editors = |line: &&str| line.starts_with("The first line is for editors");
    let paragraphs: Vec<&str> = head.collect();
    let mut paragraphs = paragraphs.split(|line| line.is_empty());
    let first = paragraphs.next().unwrap_or_default();
    let own = if first.iter().any(for_editors) { paragraphs.next() } else { Some(first) };
    own.unwrap_or_default().join(" ")
}

pub(crate) fn explain(word: &str) -> Value {
    match report::topic(word) {
        Ok(topic) => json!({ "title": topic.name, "html": report::explanation(topic).html_fragment() }),
        Err(unknown) => json!({ "error": unknown.to_string(), "nearest": unknown.nearest }),
    }
}
