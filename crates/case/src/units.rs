//! Spellings of units: which texts name a unit of the table, and which unit a misspelt text was meant to be.

mod pattern;
mod spelling;
#[cfg(test)]
mod tests;

use inputs::{Dimension, Unit};

use crate::nearest::LONGEST;

pub(crate) use pattern::{HOUR, list_pattern, pattern, percent_pattern};
pub(crate) use spelling::nearest_unit;
use spelling::{Pound, has_pound_force, is_pound_a_force, is_spelled, normalise};

/// The unit of `dimension` that a text names, if it has one.
///
/// Forgives what does not change the meaning: `·`, `*` and `-` between units, `²`, `√`, spelled-out words,
/// and capitals, except in the letter m, which means mega or milli outside speeds.
///
/// ```
/// use case::{Dimension, Unit, read_unit};
///
/// assert_eq!(read_unit("feet/second", Dimension::Speed).map(Unit::spelling), Some("ft/s"));
/// assert_eq!(read_unit("MPH", Dimension::Speed).map(Unit::spelling), Some("mph"));
/// assert_eq!(read_unit("furlongs", Dimension::Length), None);
/// ```
#[must_use]
pub fn read_unit(text: &str, dimension: Dimension) -> Option<&'static Unit> {
    if text.len() > LONGEST {
        return None;
    }
    // Nearly every unit of a file is written as in the table.
    if let Some(unit) = dimension.unit(text) {
        return Some(unit);
    }
    let wanted = normalise(text, Pound::AsWritten);
    if let Some(unit) = dimension.unit(&wanted) {
        return Some(unit);
    }
    let of_force = has_pound_force(&wanted).then(|| normalise(text, Pound::Force));
    let is_meant = |known: &str| {
        is_spelled(known, &wanted, dimension)
            || is_pound_a_force(known, dimension)
                && of_force.as_deref().is_some_and(|of_force| is_spelled(known, of_force, dimension))
    };
    dimension.units().iter().find(|unit| unit.spellings().any(is_meant))
}
