//! A case as values instead of text: from a row of a table, or from a program that already has its numbers.

use std::borrow::Cow;

use inputs::Unit;

/// The value of a key of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// A text: a word, a name, or a quantity as in a file, `"3696 lb"`.
    Text(Cow<'a, str>),
    /// A number without a unit.
    Number(f64),
    /// A number in a unit.
    Quantity(f64, &'static Unit),
    /// True or false.
    Flag(bool),
    /// A list.
    List(Vec<Self>),
    /// A table, or a range.
    Table(ValueTable<'a>),
}

/// The keys of a table of a case, in their order, each with its value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ValueTable<'a>(Vec<(Cow<'a, str>, Value<'a>)>);

impl<'a> ValueTable<'a> {
    /// A table without keys.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The value of a key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Value<'a>> {
        self.0.iter().find(|(name, _)| name == key).map(|(_, value)| value)
    }

    /// The value of a key, to change it.
    pub fn get_mut(&mut self, key: &str) -> Option<&mut Value<'a>> {
        self.0.iter_mut().find(|(name, _)| name == key).map(|(_, value)| value)
    }

    /// Sets the value of a key, replacing any that it has.
    pub fn insert(&mut self, key: impl Into<Cow<'a, str>>, value: Value<'a>) {
        let key = key.into();
        match self.get_mut(&key) {
            Some(old) => *old = value,
            None => self.0.push((key, value)),
        }
    }

    /// Removes a key.
    pub fn remove(&mut self, key: &str) -> Option<Value<'a>> {
        let place = self.0.iter().position(|(name, _)| name == key)?;
        Some(self.0.remove(place).1)
    }

    /// The keys and their values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value<'a>)> {
        self.0.iter().map(|(key, value)| (&**key, value))
    }

    /// Number of keys.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether it has no keys.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The same, borrowing its texts.
    #[must_use]
    pub fn borrowed(&self) -> ValueTable<'_> {
        ValueTable(self.0.iter().map(|(key, value)| (Cow::Borrowed(&**key), value.borrowed())).collect())
    }
}

impl<'a> Value<'a> {
    /// The same, borrowing its texts.
    #[must_use]
    pub fn borrowed(&self) -> Value<'_> {
        match self {
            Self::Text(text) => Value::Text(Cow::Borrowed(text)),
            Self::Number(number) => Value::Number(*number),
            Self::Quantity(number, unit) => Value::Quantity(*number, unit),
            Self::Flag(flag) => Value::Flag(*flag),
            Self::List(list) => Value::List(list.iter().map(Self::borrowed).collect()),
            Self::Table(table) => Value::Table(table.borrowed()),
        }
    }
}

impl<'a> FromIterator<(Cow<'a, str>, Value<'a>)> for ValueTable<'a> {
    fn from_iter<I: IntoIterator<Item = (Cow<'a, str>, Value<'a>)>>(entries: I) -> Self {
        let mut table = Self::new();
        for (key, value) in entries {
            table.insert(key, value);
        }
        table
    }
}

impl<'a> IntoIterator for ValueTable<'a> {
    type Item = (Cow<'a, str>, Value<'a>);
    type IntoIter = std::vec::IntoIter<Self::Item>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}
