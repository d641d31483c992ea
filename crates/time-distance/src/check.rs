//! What no response, path or party can have.

use pim_core::InvalidInput;

/// Refuses all but finite numbers from zero on.
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    if !value.is_finite() {
        Err(InvalidInput::NotFinite { what, value })
    } else if value < 0.0 {
        Err(InvalidInput::OutOfRange { what, value, low: 0.0, high: f64::MAX })
    } else {
        Ok(())
    }
}

/// Refuses all but finite numbers greater than zero.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    if !value.is_finite() {
        Err(InvalidInput::NotFinite { what, value })
    } else if value > 0.0 {
        Ok(())
    } else {
        Err(InvalidInput::NotPositive { what, value })
    }
}

/// Refuses NaN and infinities.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    if value.is_finite() { Ok(()) } else { Err(InvalidInput::NotFinite { what, value }) }
}
