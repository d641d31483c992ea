//! Options of a request by their names.

use case::shown;
use serde_json::{Map, Value};

/// The options of a request by their names, as JSON has them. What is left out has its default.
#[derive(Clone, Debug, Default)]
pub struct RequestOptions(Map<String, Value>);

/// Why a request cannot be put to any case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OptionError {
    /// No command has this name.
    #[error("there is no command \"{}\" that answers", shown(.0))]
    Command(String),
    /// An option that cannot be read: a sentence.
    #[error("{0}")]
    Unreadable(String),
    /// An option that was read, and cannot be.
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
        serde_json::from_str(json).map(Self).map_err(unreadable)
    }

    /// With a flag as it is where nothing is given.
    #[must_use]
    pub fn or(mut self, name: &str, flag: bool) -> Self {
        self.0.entry(name).or_insert(Value::Bool(flag));
        self
    }

    /// What is given under a name, and is not null.
    fn given(&self, name: &str) -> Option<&Value> {
        self.0.get(name).filter(|value| !value.is_null())
    }

    /// A whole number.
    pub(crate) fn count(&self, name: &str) -> Result<Option<u64>, OptionError> {
        let number = |value: &Value| {
            value.as_u64().ok_or_else(|| {
                OptionError::Unreadable(format!("the option {name} is a whole number, not {value}"))
            })
        };
        self.given(name).map(number).transpose()
    }

    /// A whole number of things in memory.
    pub(crate) fn size(&self, name: &str) -> Result<Option<usize>, OptionError> {
        let too_large = |_| OptionError::Unreadable(format!("the option {name} is too large"));
        self.count(name)?.map(|count| usize::try_from(count).map_err(too_large)).transpose()
    }

    /// A number.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f64>, OptionError> {
        let number = |value: &Value| {
            value
                .as_f64()
                .ok_or_else(|| OptionError::Unreadable(format!("the option {name} is a number, not {value}")))
        };
        self.given(name).map(number).transpose()
    }

    pub(crate) fn flag(&self, name: &str, default: bool) -> bool {
        self.0.get(name).and_then(Value::as_bool).unwrap_or(default)
    }

    /// The texts of a list.
    pub(crate) fn texts(&self, name: &str) -> Option<Vec<String>> {
        let list = self.0.get(name)?.as_array()?.iter();
        Some(list.filter_map(Value::as_str).map(str::to_owned).collect())
    }

    /// One of a few words; an empty text is none.
    pub(crate) fn word<T: Copy>(&self, name: &str, words: &[(&str, T)]) -> Result<Option<T>, OptionError> {
        let Some(asked) = self.0.get(name).and_then(Value::as_str).filter(|word| !word.is_empty()) else {
            return Ok(None);
        };
        let found = words.iter().find(|(word, _)| *word == asked).map(|(_, value)| *value);
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let wrong = || {
            let (known, asked) = (known.join(" or "), shown(asked));
            OptionError::Unreadable(format!("the option {name} is {known}, not \"{asked}\""))
        };
        found.map(Some).ok_or_else(wrong)
    }
}
