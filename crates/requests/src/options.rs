//! Options of a request by their names.

use std::cell::RefCell;
use std::collections::BTreeSet;

use case::shown;
use serde_json::{Map, Value};

/// The options of a request by their names, as JSON has them. What is left out has its default.
#[derive(Clone, Debug, Default)]
pub struct RequestOptions {
    given: Map<String, Value>,
    /// The names that a command has asked for.
    known: RefCell<BTreeSet<&'static str>>,
}

/// Why a request cannot be put to any case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OptionError {
    /// No command has this name.
    #[error("there is no command \"{}\" that answers", shown(.0))]
    Command(String),
    /// An option that cannot be read: a sentence.
    #[error("{0}")]
    Unreadable(String),
    /// An option that was read, but has an impossible value.
    #[error("{option}={given}: {advice}")]
    Value {
        /// Its name.
        option: &'static str,
        /// What was given.
        given: String,
        /// What to give instead.
        advice: String,
    },
}

impl RequestOptions {
    /// Reads an object in JSON; an empty text has no options.
    ///
    /// # Errors
    /// [`OptionError::Unreadable`] for all else.
    pub fn read(json: &str) -> Result<Self, OptionError> {
        if json.is_empty() {
            return Ok(Self::default());
        }
        let unreadable = |_| OptionError::Unreadable("the options are empty, or an object".to_owned());
        let given = serde_json::from_str(json).map_err(unreadable)?;
        Ok(Self { given, known: RefCell::default() })
    }

    /// Sets a flag to this value unless it is given.
    #[must_use]
    pub fn or(mut self, name: &str, flag: bool) -> Self {
        if self.get(name).is_none() {
            self.given.insert(name.to_owned(), Value::Bool(flag));
        }
        self
    }

    /// What is given under a name, and is not null.
    fn get(&self, name: &str) -> Option<&Value> {
        self.given.get(name).filter(|value| !value.is_null())
    }

    /// Refuses names that no option of the command has asked for.
    pub(crate) fn are_known(&self, command: &str) -> Result<(), OptionError> {
        let known = self.known.borrow();
        let Some(name) = self.given.keys().find(|name| !known.contains(name.as_str())) else { return Ok(()) };
        let known: Vec<&str> = known.iter().copied().collect();
        let has = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
        let name = shown(name);
        Err(OptionError::Unreadable(format!("{command} has no option \"{name}\"; its options: {has}")))
    }

    /// What is given under a name, read as a `T`.
    fn read_as<'a, T>(
        &'a self,
        name: &'static str,
        what: &str,
        read: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Result<Option<T>, OptionError> {
        self.known.borrow_mut().insert(name);
        let Some(value) = self.get(name) else { return Ok(None) };
        let wrong = || OptionError::Unreadable(format!("the option {name} is {what}, not {value}"));
        read(value).map(Some).ok_or_else(wrong)
    }

    /// A whole number.
    pub(crate) fn count(&self, name: &'static str) -> Result<Option<u64>, OptionError> {
        self.read_as(name, "a whole number", Value::as_u64)
    }

    /// A whole number of things in memory.
    pub(crate) fn size(&self, name: &'static str) -> Result<Option<usize>, OptionError> {
        let too_large = |_| OptionError::Unreadable(format!("the option {name} is too large"));
        self.count(name)?.map(|count| usize::try_from(count).map_err(too_large)).transpose()
    }

    /// A number.
    pub(crate) fn number(&self, name: &'static str) -> Result<Option<f64>, OptionError> {
        self.read_as(name, "a number", Value::as_f64)
    }

    pub(crate) fn flag(&self, name: &'static str, default: bool) -> Result<bool, OptionError> {
        Ok(self.read_as(name, "true or false", Value::as_bool)?.unwrap_or(default))
    }

    /// The texts of a list.
    pub(crate) fn texts(&self, name: &'static str) -> Result<Option<Vec<String>>, OptionError> {
        let text = |value: &Value| value.as_str().map(str::to_owned);
        self.read_as(name, "a list of texts", |value| value.as_array()?.iter().map(text).collect())
    }

    /// One of a few words; an empty text is none.
    pub(crate) fn word<T: Copy>(
        &self,
        name: &'static str,
        words: &[(&str, T)],
    ) -> Result<Option<T>, OptionError> {
        let given = self.read_as(name, "a word", Value::as_str)?;
        let Some(asked) = given.filter(|word| !word.is_empty()) else { return Ok(None) };
        let found = words.iter().find(|(word, _)| *word == asked).map(|(_, value)| *value);
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let wrong = || {
            let (known, asked) = (known.join(" or "), shown(asked));
            OptionError::Unreadable(format!("the option {name} is {known}, not \"{asked}\""))
        };
        found.map(Some).ok_or_else(wrong)
    }
}
