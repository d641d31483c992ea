//! The JSON Schema: the committed one is current, and it agrees with the reader.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use case::{
    CaseFile, CaseProblem, Dimension, QuantityError, Template, UnitSystem, json_schema, read_quantity,
};
use jsonschema::Validator;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use serde_json::{Value, json};
use toml::de::{DeTable, DeValue};

use crate::changes::invalid_cases;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn schema() -> Value {
    serde_json::from_str(&json_schema()).unwrap()
}

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema()).unwrap()
}

/// TOML as an editor passes it to its validator; `None` if it is not TOML.
fn document(text: &str) -> Option<Value> {
    let (document, errors) = DeTable::parse_recoverable(text);
    errors.is_empty().then(|| table(document.get_ref()))
}

fn table(table: &DeTable<'_>) -> Value {
    Value::Object(table.iter().map(|(key, one)| (key.get_ref().to_string(), value(one.get_ref()))).collect())
}

fn value(toml: &DeValue<'_>) -> Value {
    match toml {
        DeValue::String(text) => json!(text),
        DeValue::Integer(number) => json!(i64::from_str_radix(number.as_str(), number.radix()).unwrap()),
        DeValue::Float(number) => json!(number.as_str().parse::<f64>().unwrap()),
        DeValue::Boolean(flag) => json!(flag),
        DeValue::Datetime(datetime) => json!(datetime.to_string()),
        DeValue::Array(array) => array.iter().map(|one| value(one.get_ref())).collect(),
        DeValue::Table(entries) => table(entries),
    }
}

/// The names and texts of the cases of a folder of fixtures.
fn cases(folder: &str) -> Vec<(String, String)> {
    let mut cases = Vec::new();
    for entry in fs::read_dir(root().join("fixtures").join(folder)).unwrap() {
        let path = entry.unwrap().path();
        // The printed results of the RICSAC collisions are not a case.
        if path.extension().is_some_and(|ending| ending == "toml") && !path.ends_with("published.toml") {
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            cases.push((name, fs::read_to_string(path).unwrap()));
        }
    }
    cases.sort();
    cases
}

#[test]
fn the_committed_schema_is_current() {
    let path = root().join("docs/case.schema.json");
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, json_schema()).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap();
    assert!(
        committed == json_schema(),
        "docs/case.schema.json is not current: UPDATE=1 cargo test -p deltav-case writes it anew"
    );
}

#[test]
fn it_is_a_schema_of_its_draft() {
    if let Err(error) = jsonschema::meta::validate(&schema()) {
        panic!("{}: {error}", error.instance_path());
    }
}

#[test]
fn valid_cases_are_valid() {
    let validator = validator();
    let mut read = 0;
    let fixtures = ["", "avoid", "laws", "no-answer", "ricsac", "roots"].into_iter().flat_map(cases);
    let templates = Template::WORDS.into_iter().flat_map(|(name, template)| {
        [UnitSystem::Si, UnitSystem::Us]
            .map(|units| (format!("{name} {units:?}"), template.text(units).to_owned()))
    });
    for (name, text) in fixtures.chain(templates) {
        let document = document(&text).unwrap();
        let errors: Vec<String> = validator
            .iter_errors(&document)
            .map(|error| format!("{name}: {}: {error}", error.instance_path()))
            .collect();
        assert!(errors.is_empty(), "{}", errors.join("\n"));
        read += 1;
    }
    assert!(read >= 35, "only {read} cases were found");
}

/// The invalid cases that a schema cannot refuse, by reason.
const BEYOND: &[(&str, &[&str])] = &[
    ("the order of two limits", &["certain-speed-equal", "certain-speed-order", "certain-speed-outside"]),
    (
        "magnitudes",
        &[
            "implausible",
            "implausible-depth",
            "infinite-quantity",
            "mass-tiny",
            "oblique-angle-range",
            "range-oblique-angle",
            "steer-beyond",
            "steer-degrees",
        ],
    ),
    (
        "keys that other tables give",
        &[
            "uncertainty-exact-contact-given",
            "uncertainty-shared-dimensions",
            "uncertainty-shared-no-number",
            "uncertainty-shared-twice",
            "uncertainty-shared-unknown",
        ],
    ),
    (
        "ranges",
        &[
            "range-empty-width",
            "range-mode-outside",
            "range-reversed",
            "range-of-depths-zero",
            "range-within-of-zero",
        ],
    ),
    (
        "lists",
        &[
            "curve-count",
            "curve-not-ascending",
            "curve-repeated-speed",
            "range-of-depths-one",
            "spacing-count",
            "spacing-sum",
            "steer-times-fall",
            "stiffness-zones-count",
            "zone-edge-one-place",
        ],
    ),
    (
        "what belongs to another vehicle",
        &["both-fixed", "find-both-fixed", "find-fixed", "force-balance-alone", "force-balance-both"],
    ),
    ("one table that depends on another", &["force-balance-zones", "stiffness-zero-b"]),
    ("names of files", &["site-plan-elsewhere"]),
    ("tables that are of cars alone", &["kind-category", "kind-fleet", "kind-class"]),
    ("mechanics", &["stiffness-limit", "stiffness-limit-root", "test-no-crush", "test-no-damage-speed"]),
    ("TOML says the same number in several ways", &["restitution-hexadecimal"]),
];

#[test]
fn invalid_cases_are_invalid_unless_it_takes_arithmetic() {
    let validator = validator();
    let beyond: BTreeSet<&str> = BEYOND.iter().flat_map(|(_, names)| *names).copied().collect();
    let mut wrong = Vec::new();
    for (name, text) in invalid_cases() {
        // A text that is not TOML does not get as far as the schema.
        let Some(document) = document(&text) else { continue };
        if validator.is_valid(&document) != beyond.contains(name.as_str()) {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "the schema does not judge these as the list says: {wrong:?}");
}

/// Every key, as its path and its schema.
fn keys(schema: &Value) -> Vec<(String, Value)> {
    fn walk(root: &Value, node: &Value, path: &str, found: &mut Vec<(String, Value)>) {
        let node = match node["$ref"].as_str() {
            Some(reference) => root.pointer(&reference[1..]).unwrap(),
            None => node,
        };
        for (key, property) in node["properties"].as_object().into_iter().flatten() {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            found.push((path.clone(), property.clone()));
            walk(root, property, &path, found);
        }
        let parts = node["anyOf"].as_array().into_iter().flatten();
        for part in parts.chain(node.get("items")).chain(node.get("else")) {
            walk(root, part, path, found);
        }
    }
    let mut found = Vec::new();
    walk(schema, schema, "", &mut found);
    found
}

#[test]
fn every_key_says_what_it_is() {
    let keys = keys(&schema());
    assert!(keys.len() > 200, "only {} keys", keys.len());
    for (path, key) in keys {
        let text = |name: &str| key[name].as_str().unwrap_or_default().to_owned();
        assert!(text("title").len() > 3 && text("title").len() < 90, "{path}: title {}", text("title"));
        assert!(text("description").len() > 10, "{path}: description");
        // The examples of a table are those of its keys; of most parts of a range, those of the key around
        // it.
        let tables = [
            "report",
            "scene",
            "surface",
            "vehicle1",
            "vehicle2",
            "crush",
            "before",
            "after",
            "recorder",
            "impact",
            "reconstruct",
            "estimate",
            "avoid",
            "sight",
            "uncertainty",
        ];
        let is_table = tables.iter().any(|table| path == *table || path.ends_with(&format!(".{table}")));
        let is_amount = key.get("$ref").is_some() || path.ends_with(".values") || key["type"] == "number";
        assert!(!key["examples"][0].is_null() || is_table || is_amount, "{path}: no example");
    }
}

/// Every table with keys is closed.
#[test]
fn no_table_takes_unknown_keys() {
    fn walk(node: &Value, closed: &mut usize) {
        match node {
            Value::Object(entries) => {
                let is_table = entries.contains_key("properties") && entries.contains_key("type");
                if is_table {
                    assert_eq!(entries.get("additionalProperties"), Some(&json!(false)), "{entries:?}");
                    *closed += 1;
                }
                entries.values().for_each(|one| walk(one, closed));
            }
            Value::Array(items) => items.iter().for_each(|one| walk(one, closed)),
            _ => {}
        }
    }
    let mut closed = 0;
    walk(&schema(), &mut closed);
    assert!(closed > 50, "only {closed} tables");
}

/// Values of every kind, right for some keys and wrong for the others.
fn values() -> Vec<String> {
    let mut values: Vec<String> = [
        "0", "1", "2", "3", "5", "6", "7", "0.5", "-0.5", "-1", "-2", "1.5", "3.0", "true", "false", "[]", "{}",
        "\"\"", "\" \"", "\"1\"", "\"0.3\"", "\"text\"", "[0.3]", "[0.3, 0.2]", "[2]",
        "[-0.1, 0.2]", "\"0 %\"", "\"2 %\"", "\"-2 %\"", "[{}]", "{ time = \"0 10 ms\" }",
        "{ time = \"0 10 ms\", delta_v_lateral = \"0 4 km/h\" }", "{ sight = true }", "{ sight = false }", "[\"0.3\"]", "[[0.3]]", "[{ low = 0.1, high = 0.2 }, 0.3]", "{ low = 0.2, high = 0.4 }",
        "{ low = -0.4, high = 0.4 }", "{ low = 0.2, mode = 0.3, high = 0.4 }", "{ value = 0.3, sd = 0.1 }",
        "{ value = 0.3, sd = 0 }", "{ value = 0.3, sd = -0.1 }", "{ value = 0.3 }", "{ sd = 0.3 }", "{ low = 0.3 }",
        "{ value = 0.3, within = \"10 %\", confidence = 0.95 }", "{ value = 0.3, within = \"10 %\" }",
        "{ value = 0.3, within = 10, confidence = 0.95 }", "{ value = 0.3, within = \"10\", confidence = 0.95 }",
        "{ value = 0.3, within = \"0 %\", confidence = 0.95 }", "{ value = 0.3, within = \"10 %\", confidence = 1 }",
        "{ value = 0.3, sd = 0.1, low = 0.1 }", "{ value = 0.3, sigma = 0.1 }", "{ value = \"0.3\", sd = 0.1 }",
        "{ friction = 0.5 }", "{ friction = -0.5 }", "{ friction = \"0.5\" }", "{ ratio = -0.3 }", "{ fraction = 0.9 }",
        "{ fraction = 1.9 }", "{ fraction = 0.9, friction = 0.5 }", "{ x = \"1 m\", y = \"-1 m\" }", "{ x = \"1 m\" }",
        "{ x = \"1 m/s\", y = \"-1 m/s\" }", "{ x = \"1 m\", z = \"1 m\" }", "{ distance = \"1 m\", angle = \"-1 deg\" }",
        "{ distance = \"-1 m\", angle = \"1 deg\" }", "{ distance = \"1 m\", y = \"1 m\" }",
        "{ speeds = \"2 5 m/s\", values = [0.3, 0.2] }", "{ speeds = \"2 5 m/s\" }", "{ speeds = \"2 5 m\", values = [0.3, 0.2] }",
        "{ speeds = [\"2 m/s\", \"5 mph\"], values = [0.3, 1.2] }", "\"1 o'clock\"", "\"12 o’clock\"", "\"13 o'clock\"",
        "\"0 o'clock\"", "\" 02o'clock \"", "\"1 2 m\"", "\"1 0.5 m\"", "\"1 -2 m\"", "[\"1 m\", \"2 ft\"]", "[\"1 m\", 2]",
        "[\"1 m\", { low = \"1 m\", high = \"2 m\" }]", "{ values = \"1 2 m\", sd = \"0.1 m\" }", "{ values = \"1 2 m\" }",
        "{ values = \"1 2 m\", sd = \"0 m\" }", "{ values = \"1 2 m/s\", sd = \"0.1 m\" }", "{ values = [\"1 m\", \"2 m\"], sd = \"1 cm\" }",
        "{ values = [{ value = \"1 m\", sd = \"1 cm\" }, \"2 m\"], sd = \"1 cm\" }", "{ value = \"1 2 m\", sd = \"0.1 m\" }",
        "{ values = \"1 2 m\", within = \"5 %\", confidence = 0.9 }", "{ category = 3 }", "{ category = 6 }",
        "{ A = \"1 N/m\", B = \"1 N/m^2\" }", "{ A = \"1 N/m\" }", "{ A = \"1 N/m\", d1 = \"1 lb^0.5/ft\" }",
        "{ d0 = \"1 √lb\", d1 = \"1 lb^0.5/ft\", G = \"1 lb\", limit = \"90 kN/m\" }", "{ category = 3, G = \"1 lb\" }",
        "{ zones = [{ A = \"1 N/m\", B = \"1 N/m^2\" }] }", "{ zones = [{ A = \"1 N/m\" }] }", "{ zones = {} }",
        "{ test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 cm\", no_damage_speed = \"8 km/h\" } }",
        "{ test = { weight = \"3000 lb\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 cm\", no_damage_speed = \"8 km/h\", fit = \"mean\" } }",
        "{ test = { speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 cm\", no_damage_speed = \"8 km/h\" } }",
        "{ test = { mass = \"1500 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 cm\", no_damage_speed = \"8 km/h\" } }",
    ]
    .map(str::to_owned)
    .to_vec();
    for word in words() {
        values.push(format!("\"{word}\""));
    }
    for unit in Dimension::ALL.into_iter().flat_map(Dimension::units) {
        for number in ["3", "-3", "0", "0.0", "-0", "+.5", "3e-1", "0e5"] {
            values.push(format!("\"{number} {unit}\""));
        }
        values.push(format!("{{ low = \"1 {unit}\", high = \"2 {unit}\" }}"));
        values.push(format!("{{ low = \"-1 {unit}\", high = \"2 {unit}\" }}"));
        values.push(format!("{{ low = \"1 {unit}\", mode = \"1.5 {unit}\", high = \"2 {unit}\" }}"));
        values.push(format!("{{ value = \"1 {unit}\", sd = \"0.1 {unit}\" }}"));
        values.push(format!("{{ value = \"1 {unit}\", sd = 0.1 }}"));
    }
    values
}

/// Every word that the reader offers somewhere, and some that it does not.
fn words() -> BTreeSet<String> {
    let mut words: BTreeSet<String> = ["Front", "top", "brach-law"].map(str::to_owned).into();
    for (path, _) in keys(&schema()) {
        for text in of_key(&path, "\"\u{1}\"") {
            for diagnostic in CaseFile::parse("case.toml", &text).unwrap_err().list() {
                if let CaseProblem::UnknownChoice { choices, .. } = diagnostic.problem() {
                    words.extend(choices.split('"').skip(1).step_by(2).map(str::to_owned));
                }
            }
        }
    }
    words
}

/// Cases in which a key has this value: for a key of `[impact]`, one under each law.
fn of_key(path: &str, value: &str) -> Vec<String> {
    let (tables, key) = path.rsplit_once('.').unwrap_or(("", path));
    match tables {
        "" => vec![format!("{key} = {value}")],
        "impact" if key != "law" => ["brach", "woolley", "ishikawa", "kudlich-slibar"]
            .map(|law| format!("[impact]\nlaw = \"{law}\"\n{key} = {value}"))
            .to_vec(),
        // The departure has a speed and a direction.
        "vehicle1.after" if key != "direction" => {
            vec![format!("[{tables}]\ndirection = \"0 deg\"\n{key} = {value}")]
        }
        "scene"
        | "surface"
        | "vehicle1"
        | "vehicle2"
        | "vehicle1.crush"
        | "vehicle2.crush"
        | "vehicle1.before"
        | "vehicle1.before.skid"
        | "vehicle1.after"
        | "vehicle1.recorder"
        | "vehicle1.recorder.errors"
        | "impact"
        | "reconstruct"
        | "estimate"
        | "avoid"
        | "avoid.sight" => vec![format!("[{tables}]\n{key} = {value}")],
        // Values in braces are among the values above.
        _ => Vec::new(),
    }
}

/// Each value at each key, one at a time: the schema refuses what the reader refuses there.
#[test]
fn the_schema_judges_values_as_the_reader_does() {
    let validator = validator();
    let values = values();
    let mut judged = [0, 0];
    let mut wrong: Vec<String> = Vec::new();
    for (path, _) in keys(&schema()) {
        let pointer = format!("/{}", path.replace('.', "/"));
        for value in &values {
            // The reader reports an empty spacing only if there are depths.
            if path.ends_with(".spacing") && value == "[]" {
                continue;
            }
            // Of lists of tables, only that of records must have one.
            if path.ends_with(".records") && value == "[]" {
                continue;
            }
            // The schema has no magnitudes, and 3 s is too old for a stored speed.
            if path.ends_with(".latency") && value == "\"3 s\"" {
                continue;
            }
            let texts = of_key(&path, value);
            // A key of another law is refused whatever it is.
            let mut reader = texts.iter().map(|text| reads(text, value));
            let mut of_schema = texts.iter().map(|text| {
                let document = document(text).unwrap();
                let wrong = validator
                    .iter_errors(&document)
                    .any(|error| error.instance_path().to_string().starts_with(&pointer));
                !wrong
            });
            let (reader, of_schema) = (reader.by_ref().any(|one| one), of_schema.by_ref().any(|one| one));
            if texts.is_empty() {
                continue;
            }
            if of_schema != reader {
                wrong.push(format!("{path} = {value}: the schema says {of_schema}, the reader {reader}"));
            }
            judged[usize::from(reader)] += 1;
        }
    }
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
    assert!(judged[0] > 10_000 && judged[1] > 500, "{judged:?}");
}

/// Whether the reader finds no fault within the value, which is the last of the text.
fn reads(text: &str, value: &str) -> bool {
    let start = text.len() - value.len();
    let Err(errors) = CaseFile::parse("case.toml", text) else { return true };
    !errors.list().iter().any(|one| {
        match one.problem() {
            CaseProblem::KeyOfOtherLaw { .. } => true,
            // Not of this key alone, or arithmetic.
            CaseProblem::HalfOutline { .. } | CaseProblem::NotAcute { .. } => false,
            _ => one.span().is_some_and(|span| span.end > start),
        }
    })
}

/// Pieces of which quantities are made, well and badly.
fn pieces() -> impl Strategy<Value = &'static str> {
    let mut pieces = vec![
        " ", "  ", "·", "*", "-", "/", "^", "^2", "²", "2", "^0.5", "^½", "½", "^1/2", "^(1/2)", "^.5", "√",
        "√(", "sqrt(", ")", "1", ".5", "e3", "+", "−", ",", "m", "ft", "lb", "lbf", "lbs", "pounds", "s",
        "sec", "in", "inches", "N", "kg", "slug", "h", "°", "deg", "feet", "rev/min", "min", "mi", "mph",
        "Pa", "kN", "cm", "rad", "x",
    ];
    pieces.extend(Dimension::ALL.into_iter().flat_map(Dimension::units).flat_map(|unit| unit.spellings()));
    select(pieces)
}

/// A spelling of a unit, with some of its pieces written otherwise.
fn spelt() -> impl Strategy<Value = String> {
    let spellings: Vec<&'static str> =
        Dimension::ALL.into_iter().flat_map(Dimension::units).flat_map(|unit| unit.spellings()).collect();
    let others: [(&str, &[&str]); 12] = [
        ("ft", &["feet", "foot"]),
        ("lb", &["lbs", "lbf", "pounds"]),
        (" ", &["·", "*", "-", " · ", "  "]),
        ("^2", &["²", "2", " ^2", "^ 2", " ²", " 2"]),
        ("lb^0.5", &["√lb", "sqrt(lb)", "√( lb )", "lb ^0.5", "lb½", "lb^(1/2)", "√pounds", "√ lb"]),
        ("/", &[" / ", " /", "per"]),
        ("deg", &["°", "degrees"]),
        ("m", &["meter", "metres"]),
        ("s", &["sec", "seconds"]),
        ("h", &["hr", "hour"]),
        ("in", &["inch", "inches"]),
        ("0.5", &[".5", "1/2", "½", " 0.5"]),
    ];
    (select(spellings), vec((select(others.to_vec()), any::<prop::sample::Index>()), 0..4)).prop_map(
        |(spelling, changes)| {
            changes.iter().fold(spelling.to_owned(), |text, ((from, to), which)| {
                text.replacen(from, which.get::<&str>(to), 1)
            })
        },
    )
}

/// The patterns that the texts of these keys have to match.
static PATTERNS: LazyLock<BTreeMap<&str, Validator>> = LazyLock::new(|| {
    let schema = schema();
    let vehicle = &schema["$defs"]["vehicle"]["properties"];
    let line = &vehicle["crush"]["else"]["properties"]["stiffness"]["else"]["properties"];
    let pattern = |table: &Value, key: &'static str| {
        let pattern = json!({ "type": "string", "pattern": table[key]["pattern"] });
        (key, jsonschema::draft202012::new(&pattern).unwrap())
    };
    let of_vehicle =
        ["mass", "weight", "speed", "yaw_rate", "yaw_inertia", "wheelbase", "heading", "deformation_energy"];
    let of_line = ["A", "B", "G", "d0", "d1"];
    of_vehicle
        .map(|key| pattern(vehicle, key))
        .into_iter()
        .chain(of_line.map(|key| pattern(line, key)))
        .collect()
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn the_schema_knows_the_units_as_the_reader_does(
        number in select(vec!["1", "-2.5", "+3.", ".5e-3", "1 2", "−4", "", "e5", "1,5", "- 1"]),
        gap in select(vec!["", " ", "  ", "-", " ·"]),
        unit in prop_oneof![spelt(), vec(pieces(), 1..5).prop_map(|pieces| pieces.concat())],
        key in select(vec![
            ("mass", Dimension::Mass), ("weight", Dimension::Weight), ("speed", Dimension::Speed), ("yaw_rate", Dimension::YawRate),
            ("yaw_inertia", Dimension::Inertia), ("wheelbase", Dimension::Length), ("heading", Dimension::Angle),
            ("deformation_energy", Dimension::Energy),
        ]),
        stiffness in select(vec![
            ("A", Dimension::StiffnessA), ("B", Dimension::StiffnessB), ("G", Dimension::StiffnessG), ("d0", Dimension::RootForce),
            ("d1", Dimension::RootForcePerLength),
        ]),
    ) {
        let text = format!("{number}{gap}{unit}");
        for (name, dimension) in [key, stiffness] {
            let (takes, reads) = taken_and_read(name, dimension, &text);
            prop_assert_eq!(takes, reads, "{} = {:?}", name, text);
        }
    }
}

/// Whether the schema takes this text for the key, and whether the reader reads it.
fn taken_and_read(key: &str, dimension: Dimension, text: &str) -> (bool, bool) {
    let takes = PATTERNS[key].is_valid(&json!(text));
    let reads = match read_quantity(text, dimension) {
        Ok(quantity) => {
            quantity.number() >= 0.0
                || matches!(dimension, Dimension::Speed | Dimension::YawRate | Dimension::Angle)
        }
        Err(QuantityError::Invalid(_)) => takes,
        Err(_) => false,
    };
    (takes, reads)
}

/// The "lbf" at the beginning of another word is not a pound-force, and the rest of the word is not a unit.
#[test]
fn a_pound_force_is_a_word_of_its_own() {
    for (key, dimension, wrong, right) in [
        ("yaw_inertia", Dimension::Inertia, "+3.lbfm ft^2", "+3.lbm ft^2"),
        ("yaw_inertia", Dimension::Inertia, "3 lbfs ft s^2", "3 lbf ft s^2"),
        ("weight", Dimension::Weight, "3 lbff", "3 lbf"),
        ("A", Dimension::StiffnessA, "3 lbfs/in", "3 lbf/in"),
        ("G", Dimension::StiffnessG, "3 lbff", "3 lbf"),
    ] {
        assert_eq!(taken_and_read(key, dimension, wrong), (false, false), "{key} = {wrong:?}");
        assert_eq!(taken_and_read(key, dimension, right), (true, true), "{key} = {right:?}");
    }
    assert_eq!(taken_and_read("A", Dimension::StiffnessA, "+3.lbfm ft^2"), (false, false));
}
