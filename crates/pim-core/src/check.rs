//! Refusals of numbers, for the engines: the checks that return an [`InvalidInput`].

use real::Real;

use crate::error::InvalidInput;

/// Refuses NaN and infinities.
///
/// # Errors
/// [`InvalidInput`], with `what` as the name of the number.
#[inline(always)]
pub fn finite(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    if Real::is_finite(value) { Ok(()) } else { Err(InvalidInput::NotFinite { what, value }) }
}

/// Refuses all but finite numbers greater than zero.
///
/// # Errors
/// [`InvalidInput`], with `what` as the name of the number.
#[inline(always)]
pub fn positive(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    finite(what, value)?;
    if value > 0.0 { Ok(()) } else { Err(InvalidInput::NotPositive { what, value }) }
}

/// Refuses all but finite numbers from `low` up.
///
/// # Errors
/// [`InvalidInput`], with `what` as the name of the number.
#[inline(always)]
pub fn at_least(what: &'static str, value: f64, low: f64) -> Result<(), InvalidInput> {
    finite(what, value)?;
    if value >= low { Ok(()) } else { Err(InvalidInput::TooSmall { what, value, low }) }
}

/// Refuses all but numbers from `low` to `high`.
///
/// # Errors
/// [`InvalidInput`], with `what` as the name of the number.
#[inline(always)]
pub fn within(what: &'static str, value: f64, low: f64, high: f64) -> Result<(), InvalidInput> {
    finite(what, value)?;
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(InvalidInput::OutOfRange { what, value, low, high })
    }
}

/// Refuses angles (rad) that are not finite or lie beyond what [`real::Real::sin_cos`] reduces exactly.
///
/// # Errors
/// [`InvalidInput`], with `what` as the name of the number.
#[inline(always)]
pub fn angle(what: &'static str, value: f64) -> Result<(), InvalidInput> {
    within(what, value, -real::elementary::SIN_COS_LIMIT, real::elementary::SIN_COS_LIMIT)
}
