//! The keys of a case and their contents, for programs that present them in another form than text.

use std::sync::OnceLock;

use crate::schema::{Form, RANGE, RANGE_OF_LIST, Rule, SOURCED_RANGE, Schema, TOP, VEHICLE};
use inputs::{Bounds, Dimension};

/// A key of a case file.
#[derive(Clone, Debug)]
pub struct KeyInfo {
    /// Its name in its table.
    pub name: &'static str,
    /// What it means; the first sentence is its title.
    pub text: &'static str,
    /// The form of its value.
    pub form: KeyForm,
    /// The line that sets it, or the header of its table.
    pub example: &'static str,
    /// Whether its table always needs it.
    pub is_required: bool,
    /// The bounds of its numbers, if it holds any.
    pub bounds: Bounds,
}

impl KeyInfo {
    /// Whether it is a table with its own header.
    #[must_use]
    pub fn has_header(&self) -> bool {
        self.example.starts_with('[')
    }
}

/// The form of the value of a key of a case file. Where noted, the number may be a range, whose keys are
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
    /// A number with its unit, or a range, either with its source: [`sourced_range_keys`].
    Sourced(Dimension),
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
    /// In a range: like the number itself.
    Value,
    /// In a range of a list: the numbers.
    Values,
    /// How far a number may be off, in the unit of that number.
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

/// The keys of a range with its source: those of [`range_keys`] and `source`.
#[must_use]
pub fn sourced_range_keys() -> &'static [KeyInfo] {
    static KEYS: OnceLock<Vec<KeyInfo>> = OnceLock::new();
    KEYS.get_or_init(|| keys_of(&SOURCED_RANGE))
}

/// The keys of a range of several numbers: `values`, `sd`, `within` and `confidence`.
#[must_use]
pub fn list_range_keys() -> &'static [KeyInfo] {
    static KEYS: OnceLock<Vec<KeyInfo>> = OnceLock::new();
    KEYS.get_or_init(|| keys_of(&RANGE_OF_LIST))
}

fn keys_of(schema: &Schema) -> Vec<KeyInfo> {
    let is_required = |name: &str| {
        schema.rules.iter().any(|rule| matches!(rule, Rule::Needs(names) if names.contains(&name)))
    };
    let info = |key: &crate::schema::Key| KeyInfo {
        name: key.name,
        text: key.text(),
        form: form(key.form),
        example: key.example,
        is_required: is_required(key.name),
        bounds: bounds(key.form),
    };
    schema.keys.iter().map(info).collect()
}

fn bounds(form: Form) -> Bounds {
    let of_quantity = form.measure().map(|measure| measure.bounds);
    of_quantity.or_else(|| form.bounds()).unwrap_or(Bounds::None)
}

/// A step of the path to a key, through the tables of a case.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// `None` for an element.
    pub(crate) name: Option<&'static str>,
    /// The index of an element, from 0.
    pub(crate) element: usize,
    /// The position among the keys of its table.
    pub(crate) rank: usize,
    /// Whether it is a table that has a header.
    pub(crate) has_header: bool,
}

/// The steps to a key such as `vehicle1.crush.depths[2]`; `None` if no case has it.
pub(crate) fn way(key: &str) -> Option<Vec<Way>> {
    let mut way = Vec::new();
    let mut tables: Vec<&'static Schema> = vec![&TOP];
    // An empty key is the file.
    for part in key.split('.').filter(|_| !key.is_empty()) {
        let (name, elements) = part.split_at(part.find('[').unwrap_or(part.len()));
        let (rank, key) =
            tables.iter().flat_map(|table| table.keys).enumerate().find(|(_, key)| key.name == name)?;
        let has_header = key.example.starts_with('[');
        way.push(Way { name: Some(key.name), element: 0, rank, has_header });
        for element in elements.split_terminator(']') {
            let number: usize = element.strip_prefix('[')?.parse().ok()?;
            let element = number.checked_sub(1)?;
            way.push(Way { name: None, element, rank: element, has_header: false });
        }
        tables = below(key.form);
    }
    Some(way)
}

/// The tables whose keys may be below a key.
fn below(form: Form) -> Vec<&'static Schema> {
    match form {
        Form::Vehicle => vec![&VEHICLE],
        Form::Table(schema) | Form::Tables(schema) | Form::WordsOrTable(_, schema) => vec![schema],
        Form::Number(_) | Form::Numbers(_) | Form::Quantity(..) | Form::Wheels(..) | Form::AngleOrHour => {
            vec![&RANGE]
        }
        Form::QuantityOrTables(_, _, schema) | Form::NumberOrTable(_, schema) => vec![&RANGE, schema],
        Form::Sourced(..) => vec![&SOURCED_RANGE],
        Form::Quantities(..) => vec![&RANGE_OF_LIST, &RANGE],
        _ => Vec::new(),
    }
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
        Form::Sourced(dimension, _) => KeyForm::Sourced(dimension),
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
