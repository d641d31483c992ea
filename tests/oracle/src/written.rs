//! What is written and read again.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_value, to_value};

/// Through a tree of values, which keeps every bit of a number.
pub fn again<T: Serialize + DeserializeOwned>(value: &T) -> T {
    from_value(to_value(value).unwrap()).unwrap()
}

/// Asserts that a value that is written and read is the same.
#[track_caller]
pub fn assert_again<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    assert_eq!(again(value), *value);
}

/// Asserts that what is written like this is refused, with these words.
#[track_caller]
pub fn assert_refused<T: DeserializeOwned + Debug>(written: Value, what: &str) {
    let refusal = from_value::<T>(written).unwrap_err().to_string();
    assert!(refusal.contains(what), "{refusal}");
}
