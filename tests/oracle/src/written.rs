//! Writing values and reading them back.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_value, to_value};

/// Writes and reads a value through a tree of values, which keeps every bit of a number.
pub fn again<T: Serialize + DeserializeOwned>(value: &T) -> T {
    from_value(to_value(value).unwrap()).unwrap()
}

/// Asserts that a value is read back unchanged.
#[track_caller]
pub fn assert_again<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    assert_eq!(again(value), *value);
}

/// Asserts that this written form is refused, with these words.
#[track_caller]
pub fn assert_refused<T: DeserializeOwned + Debug>(written: Value, what: &str) {
    let refusal = from_value::<T>(written).unwrap_err().to_string();
    assert!(refusal.contains(what), "{refusal}");
}
