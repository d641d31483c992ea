//! Checks of the numbers of chassis, ground and start.

use pim_core::InvalidInput;
use real::elementary::SIN_COS_LIMIT;

/// Refuses NaN and infinities.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    if value.is_finite() { Ok(()) } else { Err(InvalidInput::NotFinite { what, value }) }
}

/// Refuses all but finite numbers greater than zero.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    finite(what, value)?;
    if value > 0.0 { Ok(()) } else { Err(InvalidInput::NotPositive { what, value }) }
}

/// Refuses all but numbers from `low` to `high`.
pub(crate) fn within(what: &'static str, value: f64, low: f64, high: f64) -> Result<(), InvalidInput> {
    finite(what, value)?;
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(InvalidInput::OutOfRange { what, value, low, high })
    }
}

/// Refuses angles that are not finite or lie beyond what [`real::Real::sin_cos`] reduces exactly.
pub(crate) fn angle(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    within(what, value, -SIN_COS_LIMIT, SIN_COS_LIMIT)
}
