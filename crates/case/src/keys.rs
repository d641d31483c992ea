//! The keys of a case and what each holds, for whoever lays them out in another way than a text.

use std::sync::OnceLock;

use crate::schema::{Form, RANGE, RANGE_OF_LIST, Schema, TOP, VEHICLE};
use inputs::Dimension;

/// A key of a case file.
#[derive(Clone, Debug)]
pub struct KeyInfo {
    /// Its name in its table.
    pub name: &'static str,
    /// What it means; the first sentence is its title.
    pub text: &'static str,
    /// What it holds.
    pub form: KeyForm,
}

/// What a key of a case file holds. Where it says so, the number may be a range, whose keys are
/// [`range_keys`].
#[derive(Clone, Debug)]
pub enum KeyForm {
    /// A text.
    Text,
    /// True or false.
    Flag,
    /// One of these words.
    Word(&'static [&'static str]),
    /// One of these words, or a list of all of them.
    WordOrAll(&'static [&'static str]),
    /// A whole number from 1 to this.
    Count(u8),
    /// A list of keys.
    Names,
    /// A plain number, or a range.
    Number,
    /// A list of plain numbers and of ranges.
    Numbers,
    /// A number with its unit, or a range.
    Quantity(Dimension),
    /// A number with its unit.
    Exact(Dimension),
    /// Several numbers with their unit, each of which can be a range, or one range of all:
    /// [`list_range_keys`].
    Quantities(Dimension),
    /// A number with its unit, a range, or a list of tables with these keys.
    QuantityOrTables(Dimension, Vec<KeyInfo>),
    /// A plain number, a range or one of these words; or a list of four of these.
    Wheels(&'static [&'static str]),
    /// An angle, a range, or the hour of a clock.
    AngleOrHour,
    /// A table with these keys.
    Table(Vec<KeyInfo>),
    /// A list of tables with these keys.
    Tables(Vec<KeyInfo>),
    /// One of these words, or a table with these keys.
    WordOrTable(&'static [&'static str], Vec<KeyInfo>),
    /// A plain number, a range, or a table with these keys.
    NumberOrTable(Vec<KeyInfo>),
    /// A percentage.
    Percent,
    /// A number between 0 and 1.
    Probability,
    /// In a range: as the number itself.
    Value,
    /// In a range of a list: the numbers.
    Values,
    /// How far a number may be off, in the unit of what it belongs to.
    Deviation,
}

/// The keys of a case, tables within tables.
///
/// ```
/// let vehicle = case::key_tree().iter().find(|key| key.name == "vehicle1").ok_or("a case has vehicles")?;
/// let case::KeyForm::Table(keys) = &vehicle.form else { return Err("a vehicle is a table") };
/// assert!(keys.iter().any(|key| key.name == "mass"));
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn key_tree() -> &'static [KeyInfo] {
    static KEYS: OnceLock<Vec<KeyInfo>> = OnceLock::new();
    KEYS.get_or_init(|| keys_of(&TOP))
}

/// The keys of a range, in place of a number: `value`, `sd`, `low`, …
#[must_use]
pub fn range_keys() -> &'static [KeyInfo] {
    static KEYS: OnceLock<Vec<KeyInfo>> = OnceLock::new();
    KEYS.get_or_init(|| keys_of(&RANGE))
}

/// The keys of a range of several numbers: `values`, `sd`, `within` and `confidence`.
#[must_use]
pub fn list_range_keys() -> &'static [KeyInfo] {
    static KEYS: OnceLock<Vec<KeyInfo>> = OnceLock::new();
    KEYS.get_or_init(|| keys_of(&RANGE_OF_LIST))
}

fn keys_of(schema: &Schema) -> Vec<KeyInfo> {
    let info = |key: &crate::schema::Key| KeyInfo { name: key.name, text: key.text(), form: form(key.form) };
    schema.keys.iter().map(info).collect()
}

fn form(form: Form) -> KeyForm {
    match form {
        Form::Text => KeyForm::Text,
        Form::Flag => KeyForm::Flag,
        Form::Words(words) | Form::Law(words) => KeyForm::Word(words),
        Form::WordOrAll(words) => KeyForm::WordOrAll(words),
        Form::Count(last) => KeyForm::Count(last),
        Form::Keys(_) => KeyForm::Names,
        Form::Number(_) => KeyForm::Number,
        Form::Numbers(_) => KeyForm::Numbers,
        Form::Quantity(dimension, _) => KeyForm::Quantity(dimension),
        Form::Exact(dimension, _) => KeyForm::Exact(dimension),
        Form::Quantities(dimension, ..) => KeyForm::Quantities(dimension),
        Form::QuantityOrTables(dimension, _, schema) => KeyForm::QuantityOrTables(dimension, keys_of(schema)),
        Form::Wheels(_, words) => KeyForm::Wheels(words),
        Form::AngleOrHour => KeyForm::AngleOrHour,
        Form::Vehicle => KeyForm::Table(keys_of(&VEHICLE)),
        Form::Table(schema) => KeyForm::Table(keys_of(schema)),
        Form::Tables(schema) => KeyForm::Tables(keys_of(schema)),
        Form::WordsOrTable(words, schema) => KeyForm::WordOrTable(words, keys_of(schema)),
        Form::NumberOrTable(_, schema) => KeyForm::NumberOrTable(keys_of(schema)),
        Form::Value => KeyForm::Value,
        Form::Values => KeyForm::Values,
        Form::Deviation => KeyForm::Deviation,
        Form::Percent => KeyForm::Percent,
        Form::Probability => KeyForm::Probability,
    }
}
