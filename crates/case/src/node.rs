//! The spanned tree that a case is read from, made from a TOML text or from [`ValueTable`]s.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::number::leading_numbers;
use crate::schema::{Form, RANGE, RANGE_OF_LIST, Schema};
use crate::units::read_unit;
use crate::value::{Value, ValueTable};
use inputs::{Quantity, Unit};

/// The schema of a table where none is allowed.
static NO_KEYS: Schema = Schema { place: "", text: "", keys: &[], rules: &[] };

/// One value.
#[derive(Clone, Debug)]
pub(crate) enum Node<'t> {
    String(Cow<'t, str>),
    /// A plain number; if it was written in a file, then in decimal digits.
    Number(f64),
    /// A number that was written with 0x, 0o or 0b.
    NotDecimal,
    /// A number with its unit that is not a text: only from a [`Value`].
    Quantity(f64, &'static Unit),
    Boolean(bool),
    Datetime,
    Array(Vec<Spanned<Self>>),
    Table(Entries<'t>),
}

/// A table: its keys in their order, each with its value.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries<'t>(Vec<(Spanned<Cow<'t, str>>, Spanned<Node<'t>>)>);

impl<'t> Entries<'t> {
    pub(crate) fn get(&self, key: &str) -> Option<&Spanned<Node<'t>>> {
        self.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (&Spanned<Cow<'t, str>>, &Spanned<Node<'t>>)> {
        self.0.iter().map(|(key, value)| (key, value))
    }

    pub(crate) fn keys(&self) -> impl Iterator<Item = &Spanned<Cow<'t, str>>> {
        self.iter().map(|(key, _)| key)
    }

    /// The entries of a TOML table.
    pub(crate) fn of_toml(table: DeTable<'t>) -> Self {
        let entry = |(key, value): (Spanned<Cow<'t, str>>, Spanned<DeValue<'t>>)| (key, Node::of_toml(value));
        Self(table.into_iter().map(entry).collect())
    }

    /// The entries as values; texts of quantities are read if they are valid.
    pub(crate) fn values(&self, schema: &Schema) -> ValueTable<'static> {
        let value = |(key, value): (&Spanned<Cow<'_, str>>, &Spanned<Node<'_>>)| {
            let key: &str = key.get_ref();
            let form = schema.key(key).map(|key| key.form);
            (Cow::Owned(key.to_owned()), value.get_ref().value(form))
        };
        self.iter().map(value).collect()
    }

    /// A range of a key of this form, as values.
    fn range_values(&self, form: Option<Form>) -> ValueTable<'static> {
        let value = |(key, value): (&Spanned<Cow<'_, str>>, &Spanned<Node<'_>>)| {
            let key: &str = key.get_ref();
            let form = form.filter(|_| !matches!(key, "within" | "confidence"));
            // All numbers of a range except those of the list are single.
            let form = match form {
                Some(Form::Quantities(dimension, bounds, _)) if key != "values" => {
                    Some(Form::Quantity(dimension, bounds))
                }
                form => form,
            };
            (Cow::Owned(key.to_owned()), value.get_ref().value(form))
        };
        self.iter().map(value).collect()
    }

    /// The entries of values. Places are counted: each key, value, table and list has a number, and the
    /// contents of a table or list lie between its first and its last.
    pub(crate) fn of_values(table: &'t ValueTable<'_>) -> Self {
        // Zero means no place.
        Self::numbered(table, &mut 1)
    }

    fn numbered(table: &'t ValueTable<'_>, place: &mut usize) -> Self {
        let entry = |(key, value): (&'t str, &'t Value<'_>)| {
            let begin = *place;
            *place += 1;
            (Spanned::new(begin..*place, Cow::Borrowed(key)), Node::numbered(value, place))
        };
        Self(table.iter().map(entry).collect())
    }
}

impl<'t> Node<'t> {
    fn of_toml(value: Spanned<DeValue<'t>>) -> Spanned<Self> {
        let span = value.span();
        let node = match value.into_inner() {
            DeValue::String(text) => Self::String(text),
            DeValue::Integer(integer) if integer.radix() == 10 => {
                integer.as_str().parse().map_or(Self::NotDecimal, Self::Number)
            }
            DeValue::Integer(_) => Self::NotDecimal,
            DeValue::Float(float) => float.as_str().parse().map_or(Self::NotDecimal, Self::Number),
            DeValue::Boolean(flag) => Self::Boolean(flag),
            DeValue::Datetime(_) => Self::Datetime,
            DeValue::Array(array) => Self::Array(array.into_iter().map(Self::of_toml).collect()),
            DeValue::Table(table) => Self::Table(Entries::of_toml(table)),
        };
        Spanned::new(span, node)
    }

    fn numbered(value: &'t Value<'_>, place: &mut usize) -> Spanned<Self> {
        let begin = *place;
        *place += 1;
        let node = match value {
            Value::Text(text) => Self::String(Cow::Borrowed(text)),
            Value::Number(number) => Self::Number(*number),
            Value::Quantity(number, unit) => Self::Quantity(*number, unit),
            Value::Flag(flag) => Self::Boolean(*flag),
            Value::List(list) => Self::Array(list.iter().map(|one| Self::numbered(one, place)).collect()),
            Value::Table(table) => Self::Table(Entries::numbered(table, place)),
        };
        Spanned::new(begin..*place, node)
    }

    /// The value of a key of this form.
    fn value(&self, form: Option<Form>) -> Value<'static> {
        match self {
            Self::String(text) => {
                form.and_then(|form| read_text(text, form)).unwrap_or_else(|| text_of(text))
            }
            Self::Number(number) => Value::Number(*number),
            Self::Quantity(number, unit) => Value::Quantity(*number, unit),
            Self::Boolean(flag) => Value::Flag(*flag),
            Self::Array(list) => {
                // Each element is a single quantity.
                let form = match form {
                    Some(Form::Quantities(dimension, bounds, _)) => Some(Form::Quantity(dimension, bounds)),
                    form => form,
                };
                Value::List(list.iter().map(|one| one.get_ref().value(form)).collect())
            }
            // The numbers of a range are of the same form.
            Self::Table(table) if self.is_range() => Value::Table(table.range_values(form)),
            Self::Table(table) => Value::Table(table.values(form.and_then(Form::table).unwrap_or(&NO_KEYS))),
            // Neither is a value of any key.
            Self::NotDecimal | Self::Datetime => Value::Text(Cow::Borrowed("")),
        }
    }

    /// Whether it is a table with the keys of a range, and not a curve of restitution.
    fn is_range(&self) -> bool {
        let is_curve = |table: &Entries<'_>| table.get("speeds").is_some();
        let of_range = |key: &str| RANGE.has(key) || RANGE_OF_LIST.has(key);
        self.as_table()
            .is_some_and(|table| !is_curve(table) && table.keys().any(|key| of_range(key.get_ref())))
    }

    pub(crate) fn as_bool(&self) -> Option<bool> {
        match self {
            Self::Boolean(flag) => Some(*flag),
            _ => None,
        }
    }

    pub(crate) fn as_str(&self) -> Option<&str> {
        match self {
            Self::String(text) => Some(text),
            _ => None,
        }
    }

    pub(crate) fn is_str(&self) -> bool {
        self.as_str().is_some()
    }

    pub(crate) fn as_array(&self) -> Option<&Vec<Spanned<Self>>> {
        match self {
            Self::Array(array) => Some(array),
            _ => None,
        }
    }

    pub(crate) fn is_array(&self) -> bool {
        self.as_array().is_some()
    }

    pub(crate) fn as_table(&self) -> Option<&Entries<'t>> {
        match self {
            Self::Table(table) => Some(table),
            _ => None,
        }
    }

    pub(crate) fn is_table(&self) -> bool {
        self.as_table().is_some()
    }
}

fn text_of(text: &str) -> Value<'static> {
    Value::Text(Cow::Owned(text.to_owned()))
}

/// The quantity in a text, or the list of several.
fn read_text(text: &str, form: Form) -> Option<Value<'static>> {
    let dimension = form.measure()?.dimension;
    let (numbers, unit) = leading_numbers(text);
    let unit = read_unit(unit, dimension)?;
    let numbers: Option<Vec<Value<'static>>> = numbers
        .into_iter()
        .map(|(number, _)| Quantity::new(number, unit).ok().map(|_| Value::Quantity(number, unit)))
        .collect();
    let mut numbers = numbers?;
    match form {
        Form::Quantities(..) => (!numbers.is_empty()).then_some(Value::List(numbers)),
        _ => {
            if numbers.len() == 1 {
                numbers.pop()
            } else {
                None
            }
        }
    }
}
