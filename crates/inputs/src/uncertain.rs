//! The uncertainty of a case besides the ranges: the table `[uncertainty]`.

use crate::range::Spread;
use crate::units::Unit;
use crate::walk::{Element, GivenValue, Input, Key, Origin, Walk};

/// The table `[uncertainty]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenUncertainty {
    /// Keys of estimates that are taken as exact.
    pub exact: Vec<String>,
    /// Errors that several numbers share.
    pub shared: Vec<SharedError>,
}

/// An error that several numbers share, such as that of the tape that measured them all. Each sample draws it
/// once: it is added to each of the numbers or, as a percentage, multiplies them, in addition to the range of
/// each number.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedError {
    /// Its name.
    pub name: String,
    /// The keys of its numbers; a key of a list means all of its elements.
    pub of: Vec<String>,
    /// Its size: [`Spread::Normal`] about zero, or [`Spread::Within`] of each number.
    pub size: Spread,
}

impl SharedError {
    /// The path of the error among the numbers that may vary.
    #[must_use]
    pub fn path(&self) -> String {
        format!("uncertainty.shared.{}", self.name)
    }

    /// The error without effect: 0 in its unit, or the factor 1.
    pub(crate) fn central(&self) -> (f64, Option<&'static Unit>) {
        match self.size {
            Spread::Normal { sd } => (0.0, sd.unit),
            _ => (1.0, None),
        }
    }

    pub(crate) fn covers(&self, input: &Input) -> bool {
        input.origin == Origin::Given
            && self.of.iter().any(|key| *key == input.path || Some(key.as_str()) == list_of(&input.path))
    }
}

/// The key of the list that contains the element at a path.
#[must_use]
pub fn list_of(path: &str) -> Option<&str> {
    Some(path.strip_suffix(']')?.rsplit_once('[')?.0)
}

impl<U> Walk<'_, U> {
    /// `[uncertainty]` and the errors that it names. Their replacements are dropped:
    /// [`Case::with_numbers`](crate::Case::with_numbers) applies them.
    pub(crate) fn uncertainty(&mut self, uncertainty: &GivenUncertainty) -> GivenUncertainty {
        let GivenUncertainty { exact, shared } = uncertainty;
        for (i, key) in exact.iter().enumerate() {
            self.other(&Element(&"uncertainty.exact", i), || GivenValue::Text(key.clone()));
        }
        for (i, error) in shared.iter().enumerate() {
            let table = &Element(&"uncertainty.shared", i);
            self.other(&Key(table, "name"), || GivenValue::Text(error.name.clone()));
            for (n, key) in error.of.iter().enumerate() {
                self.other(&Element(&Key(table, "of"), n), || GivenValue::Text(key.clone()));
            }
            match error.size {
                Spread::Normal { sd } => {
                    self.other(&Key(table, "sd"), || GivenValue::Number { number: sd.number, unit: sd.unit });
                }
                Spread::Within { percent, confidence } => {
                    self.percent_if(&Key(table, "within"), Some(percent));
                    let confidence = || GivenValue::Number { number: confidence, unit: None };
                    self.other(&Key(table, "confidence"), confidence);
                }
                Spread::Uniform { .. } | Spread::Triangular { .. } => {}
            }
            let (number, unit) = error.central();
            self.replaced(&error.path(), number, unit, Origin::Shared(i));
        }
        uncertainty.clone()
    }
}
