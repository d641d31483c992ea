//! The functions of the page, called on this machine.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![allow(
    clippy::disallowed_methods,
    reason = "the expected values do not come from the functions of the program"
)]
#![allow(clippy::cast_possible_truncation, reason = "numbers of vehicles and of stations")]

mod avoid;
mod drag;
mod look;
mod pages;
mod scene;
mod texts;

use serde_json::Value;

fn json(text: String) -> Value {
    serde_json::from_str(&text).unwrap()
}

fn example() -> String {
    case::EXAMPLE.to_owned()
}

fn fixture(name: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/");
    std::fs::read_to_string(format!("{root}{name}")).unwrap()
}

#[track_caller]
fn made(text: String) -> Value {
    let value = json(text);
    assert_eq!(value["ok"], true, "{value:#}");
    value
}

#[track_caller]
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

#[track_caller]
fn assert_near(one: f64, other: f64, tolerance: f64) {
    assert!((one - other).abs() <= tolerance, "{one} and {other}");
}
