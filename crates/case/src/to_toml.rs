//! Writes a case back in the layout of the documentation's example, with the user's own units and numbers.
//!
//! The case lists its values with their paths. The schema gives the order of the keys and says which tables
//! have a header, so no key is named here.

use std::collections::BTreeMap;

use inputs::{Amount, Case, GivenValue, Spread, format_number};

use crate::schema::{Rule, Schema, TOP};

/// The case as a file. Reading that file gives the same case: the same numbers, in the same units.
///
/// ```
/// use case::{CaseFile, EXAMPLE, to_toml};
///
/// let case = CaseFile::parse("sae-980025.toml", EXAMPLE)?.case;
/// assert_eq!(CaseFile::parse("again.toml", &to_toml(&case))?.case, case);
/// # Ok::<(), case::Diagnostics>(())
/// ```
#[must_use]
pub fn to_toml(case: &Case) -> String {
    let ranges: BTreeMap<&str, Spread> =
        case.ranges.iter().map(|range| (range.path.as_str(), range.spread)).collect();
    let mut top = Table::default();
    // A vehicle is needed, even if nothing is known about it, unless the case only asks about avoidability.
    for rule in TOP.rules {
        if let Rule::NeedsIf(_, keys) = rule
            && case.avoid.is_none()
        {
            top.extend(keys.iter().map(|key| ((*key).to_owned(), Node::Table(Table::default()))));
        }
    }
    for (path, value) in case.values() {
        let leaf = match value {
            GivenValue::Number { number, unit } => {
                Node::Number(Amount { number, unit }, ranges.get(path.as_str()).copied())
            }
            GivenValue::Text(text) => Node::Word(quoted(&text)),
            GivenValue::Flag => Node::Word("true".to_owned()),
            GivenValue::Count(count) => Node::Word(count.to_string()),
            GivenValue::Hour(hour) => Node::Word(quoted(&format!("{hour} o'clock"))),
        };
        insert(&mut top, &path, leaf);
    }
    let mut sections = Vec::new();
    write_section("", &TOP, &top, &mut sections);
    sections.join("\n")
}

type Table = BTreeMap<String, Node>;

/// The value at a path.
enum Node {
    /// A number, and its spread if it is uncertain.
    Number(Amount, Option<Spread>),
    /// The same with its source, as it is written.
    Sourced(Amount, Option<Spread>, String),
    /// Any other value, as it is written.
    Word(String),
    List(Vec<Node>),
    Table(Table),
}

/// Inserts a value into its table: `vehicle1.crush.depths[1]`. The elements of a list come in their order.
fn insert(table: &mut Table, path: &str, leaf: Node) {
    let (key, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
    let (name, index) = match key.strip_suffix(']').and_then(|key| key.split_once('[')) {
        Some((name, index)) => (name, index.parse::<usize>().ok()),
        None => (key, None),
    };
    let Some(index) = index else {
        match rest {
            None => {
                table.insert(name.to_owned(), leaf);
            }
            Some(rest) => insert_into(
                table.entry(name.to_owned()).or_insert_with(|| Node::Table(Table::default())),
                rest,
                leaf,
            ),
        }
        return;
    };
    let list = table.entry(name.to_owned()).or_insert_with(|| Node::List(Vec::new()));
    let Node::List(elements) = list else { return };
    match (rest, elements.get_mut(index.saturating_sub(1))) {
        (None, _) => elements.push(leaf),
        (Some(rest), Some(element)) => insert_into(element, rest, leaf),
        (Some(rest), None) => {
            let mut element = Node::Table(Table::default());
            insert_into(&mut element, rest, leaf);
            elements.push(element);
        }
    }
}

fn insert_into(node: &mut Node, rest: &str, leaf: Node) {
    match (&mut *node, leaf) {
        (Node::Table(table), leaf) => insert(table, rest, leaf),
        // The source of a number comes after the number.
        (Node::Number(amount, spread), Node::Word(source)) => {
            *node = Node::Sourced(*amount, *spread, source);
        }
        _ => {}
    }
}

/// The keys of a table that have a value, in the order of its schema, each with the schema of its own table.
fn in_order<'n>(
    schema: &'static Schema,
    table: &'n Table,
) -> impl Iterator<Item = (&'static str, &'n Node, &'static Schema, bool)> {
    schema.keys.iter().filter_map(|key| {
        let inner = key.form.table().unwrap_or(schema);
        Some((key.name, table.get(key.name)?, inner, key.has_header()))
    })
}

/// Writes a table with its header, its keys with aligned equals signs, and then the tables in it that have
/// their own header.
fn write_section(path: &str, schema: &'static Schema, table: &Table, sections: &mut Vec<String>) {
    let mut lines = Vec::new();
    let mut tables = Vec::new();
    for (key, node, inner, has_header) in in_order(schema, table) {
        match node {
            Node::Table(table) if has_header => {
                let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
                tables.push((path, inner, table));
            }
            node => lines.push((key, written(node, inner))),
        }
    }
    let width = lines.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
    let header = if path.is_empty() { String::new() } else { format!("[{path}]\n") };
    let lines: String = lines.iter().map(|(key, value)| format!("{key:width$} = {value}\n")).collect();
    if !(header.is_empty() && lines.is_empty()) {
        sections.push(header + &lines);
    }
    for (path, inner, table) in tables {
        write_section(&path, inner, table, sections);
    }
}

/// A value; the schema is that of a table in it.
fn written(node: &Node, schema: &'static Schema) -> String {
    match node {
        Node::Number(value, spread) => amount(*value, spread.as_ref()),
        Node::Sourced(value, spread, source) => {
            let value = amount(*value, spread.as_ref());
            match value.strip_suffix(" }") {
                Some(range) => format!("{range}, source = {source} }}"),
                None => format!("{{ value = {value}, source = {source} }}"),
            }
        }
        Node::Word(word) => word.clone(),
        Node::List(elements) => list(elements, schema),
        Node::Table(table) => {
            let pairs: Vec<String> = in_order(schema, table)
                .map(|(key, node, inner, _)| format!("{key} = {}", written(node, inner)))
                .collect();
            format!("{{ {} }}", pairs.join(", "))
        }
    }
}

/// A number, or a range.
fn amount(value: Amount, spread: Option<&Spread>) -> String {
    let one = single(value);
    match spread {
        None => one,
        Some(Spread::Uniform { low, high }) => {
            format!("{{ low = {}, high = {} }}", single(*low), single(*high))
        }
        Some(Spread::Triangular { low, high }) => {
            format!("{{ low = {}, mode = {one}, high = {} }}", single(*low), single(*high))
        }
        Some(about @ (Spread::Normal { .. } | Spread::Within { .. })) => {
            format!("{{ value = {one}, {} }}", spread_about(about).unwrap_or_default())
        }
    }
}

/// The keys that accompany `value`; `None` for a range without `value`.
fn spread_about(spread: &Spread) -> Option<String> {
    match spread {
        Spread::Normal { sd } => Some(format!("sd = {}", single(*sd))),
        Spread::Within { percent, confidence } => Some(format!(
            "within = \"{} %\", confidence = {}",
            format_number(*percent),
            format_number(*confidence)
        )),
        Spread::Uniform { .. } | Spread::Triangular { .. } => None,
    }
}

fn single(amount: Amount) -> String {
    match amount.unit {
        Some(_) => quoted(&amount.to_string()),
        None => amount.to_string(),
    }
}

/// Quantities are one string if all share a unit, else a list of strings, together with the spread if all
/// share one. Anything else is a list.
fn list(elements: &[Node], schema: &'static Schema) -> String {
    shared_list(elements).unwrap_or_else(|| {
        let each: Vec<String> = elements.iter().map(|element| written(element, schema)).collect();
        format!("[{}]", each.join(", "))
    })
}

/// `None` if the elements are not quantities, or do not share a spread that can be written once.
fn shared_list(elements: &[Node]) -> Option<String> {
    let quantities: Vec<(Amount, Option<Spread>)> = elements
        .iter()
        .map(|element| match element {
            Node::Number(amount, spread) => amount.unit.map(|_| (*amount, *spread)),
            _ => None,
        })
        .collect::<Option<_>>()?;
    let (first, spread) = *quantities.first()?;
    let beside = match &spread {
        None => None,
        Some(spread) => Some(spread_about(spread)?),
    };
    if quantities.iter().any(|(_, other)| *other != spread) {
        return None;
    }
    let values = if quantities.iter().all(|(amount, _)| amount.unit == first.unit) {
        let numbers: Vec<String> =
            quantities.iter().map(|(amount, _)| format_number(amount.number)).collect();
        let unit = first.unit.map(ToString::to_string).unwrap_or_default();
        quoted(&format!("{} {unit}", numbers.join(" ")))
    } else {
        let each: Vec<String> = quantities.iter().map(|(amount, _)| single(*amount)).collect();
        format!("[{}]", each.join(", "))
    };
    Some(match beside {
        Some(spread) => format!("{{ values = {values}, {spread} }}"),
        None => values,
    })
}

/// A basic TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            // TOML forbids the other control characters in a string.
            c if c.is_ascii_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
