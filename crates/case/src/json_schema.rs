//! The JSON Schema of the case file, made from the tables that the reader uses.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};
use toml::de::{DeTable, DeValue};

use crate::schema::{
    Condition, Form, KeyInfo, KeysOfLaw, MOST_STATIONS, MOST_ZONES, RANGE, RANGE_OF_LIST, Rule,
    SOURCED_RANGE, Schema, TOP, VEHICLE, WHEELS,
};
use crate::units::{HOUR, list_pattern, pattern, percent_pattern};
use inputs::{Bounds, Dimension, LawName, Unit};

type Node = Map<String, Value>;

/// The JSON Schema (draft 2020-12) of the case file, for editors that complete and check TOML.
///
/// It covers every table and key, the forms of a value and the units of each dimension. Checks that need
/// arithmetic are left to [`CaseFile::parse`](crate::CaseFile::parse): magnitudes, the order of a range, and
/// the lengths of lists that belong together.
///
/// A file that begins with `#:schema PATH`, the path from the file to the schema, is completed and checked by
/// editors built on Taplo, such as Visual Studio Code with *Even Better TOML*.
///
/// ```
/// let schema = case::json_schema();
/// assert!(schema.contains("https://json-schema.org/draft/2020-12/schema"));
/// assert!(schema.contains("Yaw moment of inertia about the CG"));
/// ```
#[must_use]
pub fn json_schema() -> String {
    let mut generator = Generator::default();
    let mut document = Node::new();
    document.insert("$schema".into(), json!("https://json-schema.org/draft/2020-12/schema"));
    document.extend(generator.table(&TOP));
    document.insert("$defs".into(), generator.definitions());
    format!("{:#}\n", Value::Object(document))
}

/// Collects the parts that are used in several places.
#[derive(Default)]
struct Generator {
    vehicle: Option<Node>,
    quantities: BTreeMap<String, Node>,
    /// Rules about several keys of a range.
    ranges: BTreeMap<&'static str, Value>,
}

/// The kind of number in a range.
#[derive(Clone, Copy)]
enum Kind {
    Quantity(Dimension, Bounds),
    Number(Bounds),
}

impl Generator {
    fn definitions(self) -> Value {
        let vehicle = self.vehicle.into_iter().map(|node| ("vehicle".to_owned(), Value::Object(node)));
        let quantities = self.quantities.into_iter().map(|(name, node)| (name, Value::Object(node)));
        let ranges = self.ranges.into_iter().map(|(name, rules)| (name.to_owned(), rules));
        Value::Object(vehicle.chain(ranges).chain(quantities).collect())
    }

    fn table(&mut self, schema: &'static Schema) -> Node {
        let mut node = texts(schema.text);
        node.insert("type".into(), json!("object"));
        node.extend(self.content(&[schema], None));
        node
    }

    /// The keys of a table or, if it is one of several that are possible here, of all of them; `of` is the
    /// kind of number in a range.
    fn content(&mut self, schemas: &[&'static Schema], of: Option<Kind>) -> Node {
        let keys = schemas.iter().flat_map(|schema| schema.keys);
        let properties: Node =
            keys.map(|key| (key.name.to_owned(), Value::Object(self.key(key, of)))).collect();
        let mut required: Vec<&str> = Vec::new();
        let mut all = Vec::new();
        match schemas {
            [schema] => {
                for rule in schema.rules {
                    match rule {
                        Rule::Needs(keys) => required.extend(*keys),
                        rule => all.extend(conditions(rule, schema)),
                    }
                }
            }
            several => all.push(one_of(several)),
        }
        let mut node = Node::new();
        node.insert("properties".into(), Value::Object(properties));
        node.insert("additionalProperties".into(), json!(false));
        if !required.is_empty() {
            node.insert("required".into(), json!(required));
        }
        if !all.is_empty() {
            // Taplo offers no keys of a table that itself has "allOf": the rules go behind a condition that
            // always holds.
            node.insert("if".into(), json!(true));
            let rules = json!({ "allOf": all });
            let then = match (schemas, of) {
                // They are the same for all ranges.
                ([schema], Some(_)) => {
                    let name = if std::ptr::eq(*schema, &RANGE_OF_LIST) {
                        "range_of_list"
                    } else if std::ptr::eq(*schema, &SOURCED_RANGE) {
                        "sourced_range"
                    } else {
                        "range"
                    };
                    self.ranges.entry(name).or_insert(rules);
                    json!({ "$ref": format!("#/$defs/{name}") })
                }
                _ => rules,
            };
            node.insert("then".into(), then);
        }
        node
    }

    fn key(&mut self, key: &'static KeyInfo, of: Option<Kind>) -> Node {
        let mut node = texts(key.text());
        if let Some(example) = example(key) {
            // Some editors show only the description.
            let text = format!("{}\n\nExample: `{}`", key.text(), key.example);
            node.insert("description".into(), json!(text));
            node.insert("examples".into(), json!([example]));
        }
        node.extend(self.form(key, of));
        node
    }

    fn form(&mut self, key: &KeyInfo, of: Option<Kind>) -> Node {
        match key.form {
            Form::Text => object(json!({ "type": "string", "pattern": r"\S" })),
            Form::Flag => object(json!({ "type": "boolean" })),
            Form::Words(words) => object(json!({ "type": "string", "enum": words })),
            Form::WordOrAll(words) => object(json!({
                "type": ["string", "array"],
                "if": { "type": "string" },
                "then": { "enum": words },
                "else": {
                    "minItems": words.len(),
                    "maxItems": words.len(),
                    "uniqueItems": true,
                    "items": { "type": "string", "enum": words },
                },
            })),
            Form::Law(words) => {
                object(json!({ "type": "string", "enum": words, "default": LawName::default().name() }))
            }
            Form::Count(first, last) => {
                object(json!({ "type": "integer", "minimum": first, "maximum": last }))
            }
            Form::Keys([]) => object(
                json!({ "type": "array", "minItems": 1, "items": { "type": "string", "pattern": r"\S" } }),
            ),
            Form::Keys(keys) => {
                object(json!({ "type": "array", "items": { "type": "string", "enum": keys } }))
            }
            Form::Number(bounds) => self.number_or_table(json!({}), bounds, &[&RANGE]),
            Form::Numbers(bounds) => object(json!({
                "type": "array",
                "maxItems": MOST_STATIONS,
                "items": self.number_or_table(json!({}), bounds, &[&RANGE]),
            })),
            Form::Quantity(dimension, bounds) => self.quantity_or_range(dimension, bounds),
            Form::Exact(dimension, bounds) => self.quantity(dimension, bounds),
            Form::Sourced(dimension, bounds) => self.quantity_or(&SOURCED_RANGE, dimension, bounds),
            Form::QuantityOrTables(dimension, bounds, schema) => {
                let mut node = self.quantity_or_range(dimension, bounds);
                node.insert("type".into(), json!(["string", "object", "array"]));
                node.insert("minItems".into(), json!(1));
                node.insert("maxItems".into(), json!(MOST_ZONES));
                node.insert("items".into(), Value::Object(self.table(schema)));
                node
            }
            Form::Wheels(bounds, words) => {
                let pattern = format!("^(?:{})$", words.join("|"));
                let of_word = json!({ "type": ["number", "object", "string"], "pattern": pattern });
                let wheel = self.number_or_table(of_word, bounds, &[&RANGE]);
                let mut node = wheel.clone();
                node.insert("type".into(), json!(["number", "object", "string", "array"]));
                node.insert("minItems".into(), json!(WHEELS));
                node.insert("maxItems".into(), json!(WHEELS));
                node.insert("items".into(), Value::Object(wheel));
                node
            }
            Form::Quantities(dimension, bounds, least) => {
                let kind = Kind::Quantity(dimension, bounds);
                let mut node = object(json!({
                    "type": ["string", "array", "object"],
                    "pattern": list_pattern(dimension, bounds, least),
                    "minItems": least,
                    "maxItems": MOST_STATIONS,
                    "items": self.quantity_or_range(dimension, bounds),
                }));
                node.extend(self.content(&[&RANGE_OF_LIST], Some(kind)));
                node
            }
            Form::AngleOrHour => {
                let mut node = self.quantity_or_range(Dimension::Angle, Bounds::None);
                let angle = pattern(Dimension::Angle, Bounds::None);
                node.insert("pattern".into(), json!(format!("{angle}|{HOUR}")));
                node
            }
            Form::Vehicle => {
                if self.vehicle.is_none() {
                    self.vehicle = Some(self.table(&VEHICLE));
                }
                object(json!({ "$ref": "#/$defs/vehicle" }))
            }
            Form::Table(schema) => {
                let mut node = object(json!({ "type": "object" }));
                node.extend(self.content(&[schema], None));
                node
            }
            Form::Tables(schema, least) => object(json!({
                "type": "array",
                "minItems": least,
                "maxItems": MOST_ZONES,
                "items": self.table(schema),
            })),
            Form::WordsOrTable(words, schema) => {
                // Not `anyOf`, which reports at the key: errors in a table are marked in the table.
                let table = self.table(schema);
                object(json!({ "if": { "type": "string" }, "then": { "enum": words }, "else": table }))
            }
            Form::NumberOrTable(bounds, schema) => self.number_or_table(json!({}), bounds, &[&RANGE, schema]),
            Form::Value => self.amount(of, false),
            Form::Deviation => self.amount(of, true),
            Form::Values => match of {
                Some(Kind::Quantity(dimension, bounds)) => object(json!({
                    "type": ["string", "array"],
                    "pattern": list_pattern(dimension, bounds, 1),
                    "minItems": 1,
                    "maxItems": MOST_STATIONS,
                    "items": self.quantity(dimension, bounds),
                })),
                _ => Node::new(),
            },
            Form::Percent(bounds) => object(json!({ "type": "string", "pattern": percent_pattern(bounds) })),
            Form::Probability => {
                object(json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 }))
            }
        }
    }

    /// One number of a range.
    fn amount(&mut self, of: Option<Kind>, is_deviation: bool) -> Node {
        match of {
            Some(Kind::Quantity(dimension, bounds)) => {
                self.quantity(dimension, if is_deviation { Bounds::Positive } else { bounds })
            }
            Some(Kind::Number(bounds)) => {
                let mut node = object(json!({ "type": "number" }));
                node.extend(limits(if is_deviation { Bounds::Positive } else { bounds }));
                node
            }
            // Of any kind: several numbers share the error.
            None => object(json!({ "type": ["string", "number"] })),
        }
    }

    /// A reference to a number with its unit.
    fn quantity(&mut self, dimension: Dimension, bounds: Bounds) -> Node {
        let (sign, words) = match bounds {
            Bounds::Positive => ("_positive", ", greater than zero"),
            Bounds::NotNegative => ("_not_negative", ", zero or more"),
            _ => ("", ""),
        };
        let noun = dimension.name().split(" (").next().unwrap_or_default();
        let noun = noun.trim_start_matches("an ").trim_start_matches("a ").replace(' ', "_");
        let name = format!("{noun}{sign}");
        let reference = object(json!({ "$ref": format!("#/$defs/{name}") }));
        let units: Vec<&str> = dimension.units().iter().map(Unit::spelling).collect();
        let description = format!("Number and unit of {dimension}{words}. Units: {}.", units.join(", "));
        self.quantities.entry(name).or_insert_with(|| {
            object(json!({
                "description": description,
                "type": "string",
                "pattern": pattern(dimension, bounds),
            }))
        });
        reference
    }

    fn quantity_or_range(&mut self, dimension: Dimension, bounds: Bounds) -> Node {
        self.quantity_or(&RANGE, dimension, bounds)
    }

    fn quantity_or(&mut self, range: &'static Schema, dimension: Dimension, bounds: Bounds) -> Node {
        let mut node = object(json!({ "type": ["string", "object"], "pattern": pattern(dimension, bounds) }));
        node.extend(self.content(&[range], Some(Kind::Quantity(dimension, bounds))));
        node
    }

    /// A plain number or one of these tables, with other forms that `node` may have.
    fn number_or_table(&mut self, node: Value, bounds: Bounds, tables: &[&'static Schema]) -> Node {
        let mut node = object(node);
        node.entry("type").or_insert_with(|| json!(["number", "object"]));
        node.extend(limits(bounds));
        node.extend(self.content(tables, Some(Kind::Number(bounds))));
        node
    }
}

/// Title and description.
fn texts(text: &str) -> Node {
    let title = text.split_once(". ").map_or(text.trim_end_matches('.'), |(first, _)| first);
    object(json!({ "title": title, "description": text }))
}

fn object(value: Value) -> Node {
    match value {
        Value::Object(node) => node,
        _ => Node::new(),
    }
}

/// The value that the example line of a key sets; the header of a table sets none.
fn example(key: &KeyInfo) -> Option<Value> {
    let (document, errors) = DeTable::parse_recoverable(key.example);
    let value = document.get_ref().get(key.name)?;
    (errors.is_empty() && !key.has_header()).then(|| plain(value.get_ref()))
}

/// TOML as JSON.
fn plain(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => json!(text),
        DeValue::Integer(integer) => json!(integer.as_str().parse::<i64>().ok()),
        DeValue::Float(float) => json!(float.as_str().parse::<f64>().ok()),
        DeValue::Boolean(flag) => json!(flag),
        DeValue::Datetime(datetime) => json!(datetime.to_string()),
        DeValue::Array(array) => array.iter().map(|one| plain(one.get_ref())).collect(),
        DeValue::Table(table) => Value::Object(
            table.iter().map(|(key, one)| (key.get_ref().to_string(), plain(one.get_ref()))).collect(),
        ),
    }
}

/// The limits of a plain number. A case may contain e = 1.
fn limits(bounds: Bounds) -> Node {
    object(match bounds {
        Bounds::None | Bounds::Acute => json!({}),
        Bounds::NotNegative => json!({ "minimum": 0 }),
        Bounds::Positive => json!({ "exclusiveMinimum": 0 }),
        Bounds::Share | Bounds::BelowOne => json!({ "minimum": 0, "maximum": 1 }),
        Bounds::Coefficient => json!({ "minimum": -1, "maximum": 1 }),
        Bounds::Friction => json!({ "exclusiveMinimum": 0, "maximum": bounds.interval(None)[1] }),
    })
}

/// Makes each of these keys an error.
fn never<'a>(keys: impl Iterator<Item = &'a str>) -> Node {
    keys.map(|key| (key.to_owned(), json!(false))).collect()
}

/// The conditions that a rule sets for a table, besides the keys that are always required.
fn conditions(rule: &Rule, schema: &Schema) -> Vec<Value> {
    match rule {
        Rule::Needs(_) => Vec::new(),
        Rule::NeedsIf(conditions, keys) => {
            let all: Vec<Value> = conditions.iter().map(condition).collect();
            vec![json!({ "if": { "allOf": all }, "then": { "required": keys } })]
        }
        Rule::NeverIf(only, keys) => {
            vec![json!({ "if": condition(only), "then": { "properties": never(keys.iter().copied()) } })]
        }
        Rule::OneOf(_) => vec![one_of(&[schema])],
        Rule::NotEmpty => vec![json!({ "minProperties": 1 })],
        Rule::KeysOfLaw => LawName::WORDS.into_iter().map(|(_, law)| keys_of_law(law, schema)).collect(),
    }
}

fn condition(condition: &Condition) -> Value {
    match condition {
        Condition::Has(key) => json!({ "required": [key] }),
        Condition::Lacks(key) => json!({ "not": { "required": [key] } }),
        Condition::True(key) => json!({ "properties": { *key: { "const": true } }, "required": [key] }),
        Condition::NotTrue(key) => {
            json!({ "not": { "properties": { *key: { "const": true } }, "required": [key] } })
        }
    }
}

fn keys_of_law(law: LawName, schema: &Schema) -> Value {
    let named = json!({ "law": { "const": law.name() } });
    // Brach's law need not be named.
    let given = if law == LawName::default() {
        json!({ "properties": named })
    } else {
        json!({ "properties": named, "required": ["law"] })
    };
    let others = schema.names().filter(|key| !law.uses(key));
    json!({ "if": given, "then": { "required": law.needed(), "properties": never(others) } })
}

/// One form of one of these tables.
fn one_of(schemas: &[&Schema]) -> Value {
    let names: Vec<&str> = schemas.iter().flat_map(|schema| schema.names()).collect();
    let form = |needs: &[&str], may: &[&str]| {
        let others = names.iter().copied().filter(|key| !needs.contains(key) && !may.contains(key));
        json!({ "required": needs, "properties": never(others) })
    };
    let mut forms = Vec::new();
    for rule in schemas.iter().flat_map(|schema| schema.rules) {
        match rule {
            Rule::OneOf(of_table) => forms.extend(of_table.iter().map(|one| form(one.needs, one.may))),
            Rule::Needs(keys) => forms.push(form(keys, &[])),
            _ => {}
        }
    }
    json!({ "anyOf": forms })
}
