#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fmt::Write;
use std::path::Path;

use inputs::Case;

use super::*;

/// The text above the tables of keys.
const HEAD: &str = "\
# The case file

This page lists every table and every key. It is generated from the list that the JSON Schema (`deltav schema`) and the program's error texts also use,
and a test keeps it current. `deltav explain KEY` says more about a key, and [how-do-i.md](how-do-i.md) what to do if a value is not known.

- The file is TOML. A number with a dimension is a text with its unit, `\"6.3 ft\"`; a number without one is bare, `0.3`.
- An unknown key is an error, which suggests the closest known one.
- Any number can be a [range](#a-range). Write several values in one text, `\"21.3 20.3 in\"`, or in a list, `[\"21.3 in\", \"20.3 in\"]`.
- *If left out*: **needed** if the table requires the key, otherwise the default. A dash means that there is no default, or that the text describes it:
  `deltav check` lists what is assumed, and what is missing for which command.
- Limits: 1,000,000 bytes in a file, 10,000 values in a list, 1,000 in a list of zones, and 500 ranges in the whole case.
";

/// What a value looks like.
fn written(form: &Form) -> String {
    match *form {
        Form::Text => "text".to_owned(),
        Form::Flag => "`true` or `false`".to_owned(),
        Form::Words(words) | Form::Law(words) => ticked(words),
        Form::WordOrAll(words) => format!("{}, or a list of both", ticked(words)),
        Form::Count(first, last) => format!("whole number, {first} to {last}"),
        Form::Number(bounds) => format!("number{}", within(bounds)),
        Form::Numbers(bounds) => format!("list of numbers{}", within(bounds)),
        Form::Quantity(dimension, bounds) => format!("{dimension}{}", within(bounds)),
        Form::Exact(dimension, bounds) => format!("{dimension}{}; no range", within(bounds)),
        Form::Sourced(dimension, bounds) => {
            format!("{dimension}{}, which may have a source, {}", within(bounds), link(&SOURCED_RANGE))
        }
        Form::QuantityOrTables(dimension, bounds, schema) => {
            format!("{dimension}{}, or a list of tables, {}", within(bounds), link(schema))
        }
        Form::Wheels(bounds, words) => {
            format!("number{}, or {}; or a list of four of these", within(bounds), ticked(words))
        }
        Form::Quantities(dimension, bounds, least) => {
            format!("{dimension} each{}; {least} or more", within(bounds))
        }
        Form::AngleOrHour => "an angle, or `\"2 o'clock\"`".to_owned(),
        Form::Vehicle => format!("table, {}", link(&VEHICLE)),
        Form::Table(schema) => format!("table, {}", link(schema)),
        Form::Keys(_) => "list of keys".to_owned(),
        Form::Tables(schema, _) => format!("list of tables, {}", link(schema)),
        Form::WordsOrTable(words, schema) => format!("{}, or a table, {}", ticked(words), link(schema)),
        Form::NumberOrTable(bounds, schema) => {
            format!("number{}, or a table, {}", within(bounds), link(schema))
        }
        Form::Value => "like the number it replaces".to_owned(),
        Form::Values => "like the list it replaces".to_owned(),
        Form::Deviation => "like the number it replaces, more than 0".to_owned(),
        Form::Percent(_) => "text, in `%`".to_owned(),
        Form::Probability => "number, more than 0 and less than 1".to_owned(),
    }
}

fn ticked(words: &[&str]) -> String {
    words.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
}

fn within(bounds: Bounds) -> &'static str {
    match bounds {
        Bounds::None => "",
        Bounds::NotNegative => ", 0 or more",
        Bounds::Positive => ", more than 0",
        Bounds::Share => ", 0 to 1",
        Bounds::BelowOne => ", 0 to 1; a range less than 1",
        Bounds::Coefficient => ", -1 to 1",
        Bounds::Friction => ", more than 0 and at most 2",
        Bounds::Acute => ", less than 90° to either side",
    }
}

/// The heading of a table on the page.
fn heading(schema: &Schema) -> String {
    if std::ptr::eq(schema, &TOP) { "Above the first table".to_owned() } else { schema.place.to_owned() }
}

/// The link to it, as GitHub makes them.
fn link(schema: &Schema) -> String {
    let anchor: String = heading(schema)
        .to_lowercase()
        .chars()
        .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect();
    format!("[below](#{anchor})")
}

/// The effect of leaving the key out.
fn absent(schema: &Schema, key: &KeyInfo) -> String {
    let needed = |rule: &Rule| matches!(rule, Rule::Needs(names) if names.contains(&key.name));
    if schema.rules.iter().any(needed) {
        return "**needed**".to_owned();
    }
    if matches!(key.form, Form::Flag) {
        return "`false`".to_owned();
    }
    // The texts say "X (the default)" and "default is X".
    let before = key.text().split_once(" (the default)").map(|(before, _)| before);
    let after = key.text().split_once("default is ").map(|(_, after)| after);
    let word = before
        .and_then(|before| before.split_whitespace().last())
        .or_else(|| after.and_then(|after| after.split_whitespace().next()));
    word.map_or_else(|| "–".to_owned(), |word| format!("`{}`", word.trim_matches(['`', '.'])))
}

fn documentation() -> String {
    let mut page = HEAD.to_owned();
    let tables = [
        &TOP,
        &REPORT,
        &SCENE,
        &SCENE_CONTACT,
        &SITE_PLAN,
        &PLAN_CORNER,
        &SURFACE,
        &GRADE,
        &SURFACE_ZONE,
        &CORNER,
        &VEHICLE,
        &POSITION,
        &VELOCITY,
        &CONTACT,
        &CRUSH,
        &STIFFNESS,
        &ZONE,
        &TEST,
        &OBLIQUE,
        &BEFORE,
        &PHASE,
        &SKID,
        &SKID_FROM,
        &AFTER,
        &REST,
        &POINT,
        &STEER,
        &RECORDER,
        &RECORD,
        &OTHER_IMPACT,
        &PRE_CRASH,
        &PULSE,
        &RECORDER_AT,
        &RECORDER_ERRORS,
        &CERTAIN_SPEED,
        &IMPACT,
        &TANGENTIAL,
        &RESTITUTION,
        &RECONSTRUCT,
        &ENERGY_BASIS,
        &ESTIMATE,
        &AVOID,
        &AVOID_DEMAND,
        &AVOID_OTHER,
        &AVOID_CLEAR,
        &AVOID_SIGHT,
        &SIGHT_PLACE,
        &OBSTACLE,
        &UNCERTAINTY,
        &SHARED,
        &RANGE,
        &SOURCED_RANGE,
        &RANGE_OF_LIST,
    ];
    for schema in tables {
        writeln!(page, "\n## {}\n\n{}\n", heading(schema), schema.text).unwrap();
        page.push_str("| key | what it is | form | example | if left out |\n|---|---|---|---|---|\n");
        for key in schema.keys {
            let (text, form) = (key.text(), written(&key.form));
            writeln!(
                page,
                "| `{}` | {text} | {form} | `{}` | {} |",
                key.name,
                key.example,
                absent(schema, key)
            )
            .unwrap();
        }
    }
    page.push_str("\n## The keys of each law\n\n");
    page.push_str("A key of another law is an error.\n\n| `law` | keys of [impact] |\n|---|---|\n");
    for (_, law) in LawName::WORDS {
        writeln!(page, "| `\"{}\"` | {} |", law.name(), law.keys()).unwrap();
    }
    page.push_str("\n## Units\n\n");
    page.push_str(include_str!("../units.md"));
    page
}

#[test]
fn the_guide_lists_these_keys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide/case-file.md");
    let wanted = documentation();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &wanted).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap();
    assert!(
        written == wanted,
        "docs/guide/case-file.md is not current: UPDATE=1 cargo test -p deltav-case writes it anew"
    );
}

/// No table is missing from the page: every table of a key has its heading there.
#[test]
fn every_table_has_its_place() {
    let page = documentation();
    for schema in ALL {
        assert!(page.contains(&format!("\n## {}\n", heading(schema))), "{}", schema.place);
    }
    let anchors: Vec<&str> = page.split("](#").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(anchors.len() > 10);
}

/// The page is right about absent keys: the default, written out, makes the same case.
#[test]
fn a_default_written_out_changes_nothing() {
    let paper =
        include_str!("../../../../fixtures/sae-980025.toml").replace("energy_basis = \"dissipated\"", "");
    let read = |text: &str| {
        crate::CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
    };
    for (schema, header, name, value) in [
        (&VEHICLE, "[vehicle1]", "fixed", "false"),
        (&CRUSH, "[vehicle1.crush]", "from_force_balance", "false"),
        (&IMPACT, "[impact]", "law", "\"brach\""),
        (&RECONSTRUCT, "[reconstruct]", "energy_basis", "\"dissipated\""),
    ] {
        let key = schema.keys.iter().find(|key| key.name == name).unwrap();
        assert_eq!(absent(schema, key), format!("`{value}`"), "{name}");
        let text = paper.replace(header, &format!("{header}\n{name} = {value}"));
        let (with, without) = (read(&text), read(&paper));
        // Except for the record of absent keys.
        assert_eq!(with, Case { left_out: with.left_out, ..without }, "{name}");
    }
}
