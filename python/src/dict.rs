//! A case as a Python mapping, written as TOML for the reader of case files.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};

use crate::errors::wrong_value;

/// No case has tables nested as deeply as this.
const DEEPEST: usize = 16;

/// A table of up to so many keys is written on one line.
const SHORT: usize = 3;

/// The value of a key.
enum Node {
    /// As it is written in TOML.
    Word(String),
    List(Vec<Node>),
    Table(Vec<(String, Node)>),
}

/// The text of a case file with the same keys and values.
pub(crate) fn as_toml(case: &Bound<'_, PyAny>) -> PyResult<String> {
    let Ok(case) = case.cast::<PyMapping>() else {
        let kind = case.get_type().name()?;
        let problem = format!(
            "from_dict() takes a dict, not {kind}: Case.read(path) reads a file, and Case.parse(text) a text"
        );
        return Err(PyTypeError::new_err(problem));
    };
    let mut lines = String::new();
    write_section("", &table(case, "", 1)?, &mut lines);
    Ok(lines)
}

fn table(mapping: &Bound<'_, PyMapping>, path: &str, depth: usize) -> PyResult<Vec<(String, Node)>> {
    let mut entries = Vec::new();
    for item in mapping.items()?.iter() {
        let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
        let Ok(key) = key.extract::<String>() else {
            let message = format!("the key {} is not a text", key.repr()?);
            return Err(wrong_value(
                mapping.py(),
                path,
                &message,
                "keys are those of the case file, as \"vehicle1\"",
            ));
        };
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        entries.push((key, node(&value, &path, depth)?));
    }
    Ok(entries)
}

fn node(value: &Bound<'_, PyAny>, path: &str, depth: usize) -> PyResult<Node> {
    let py = value.py();
    if depth > DEEPEST {
        return Err(wrong_value(py, path, "tables are nested too deeply", "a case has four levels at most"));
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Node::Word(flag.is_true().to_string()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Node::Word(quoted(text.to_str()?)));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Node::Word(float(value.extract()?)));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(Node::Word(value.str()?.to_str()?.to_owned()));
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        return table(mapping, path, depth + 1).map(Node::Table);
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let elements = value.try_iter()?.enumerate();
        let elements =
            elements.map(|(place, element)| node(&element?, &format!("{path}[{place}]"), depth + 1));
        return elements.collect::<PyResult<_>>().map(Node::List);
    }
    // Arrays and numbers of NumPy.
    if value.hasattr("tolist")? {
        return node(&value.call_method0("tolist")?, path, depth + 1);
    }
    if value.is_none() {
        return Err(wrong_value(py, path, "the value is None", "leave the key out where nothing is known"));
    }
    let message = format!("the value is of the type {}", value.get_type().name()?);
    Err(wrong_value(
        py,
        path,
        &message,
        "give what the case file has: a text with a unit, a number, a list or a dict",
    ))
}

/// The shortest number that reads back as the same.
fn float(number: f64) -> String {
    if number.is_nan() { "nan".to_owned() } else { format!("{number:?}") }
}

/// A basic TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            letter if letter.is_ascii_control() => out.push_str(&format!("\\u{:04X}", u32::from(letter))),
            letter => out.push(letter),
        }
    }
    out.push('"');
    out
}

fn key(name: &str) -> String {
    let is_bare = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '-';
    if !name.is_empty() && name.chars().all(is_bare) { name.to_owned() } else { quoted(name) }
}

/// A table: its values, and below them the longer tables in it with headers of their own.
fn write_section(path: &str, entries: &[(String, Node)], lines: &mut String) {
    let is_below = |node: &Node| match node {
        Node::Table(inner) => path.is_empty() || inner.len() > SHORT,
        Node::Word(_) | Node::List(_) => false,
    };
    if !path.is_empty() {
        lines.push_str(&format!("[{path}]\n"));
    }
    for (name, node) in entries.iter().filter(|(_, node)| !is_below(node)) {
        lines.push_str(&format!("{} = {}\n", key(name), written(node)));
    }
    for (name, node) in entries.iter().filter(|(_, node)| is_below(node)) {
        if let Node::Table(inner) = node {
            let path = if path.is_empty() { key(name) } else { format!("{path}.{}", key(name)) };
            lines.push('\n');
            write_section(&path, inner, lines);
        }
    }
}

fn written(node: &Node) -> String {
    match node {
        Node::Word(word) => word.clone(),
        Node::List(elements) => format!("[{}]", elements.iter().map(written).collect::<Vec<_>>().join(", ")),
        Node::Table(entries) => {
            let entries = entries.iter().map(|(name, node)| format!("{} = {}", key(name), written(node)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}
