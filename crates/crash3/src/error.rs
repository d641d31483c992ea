//! What damage data cannot be.

/// An input or a result that no damage can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CrushError {
    /// NaN or infinite.
    #[error("the {what} must be a finite number, and is {value}")]
    NotFinite {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// Zero or negative where physics asks for a positive number.
    #[error("the {what} must be greater than zero, and is {value}")]
    NotPositive {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// Below zero.
    #[error("the {what} must not be negative, and is {value}")]
    Negative {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// A profile needs two stations or more.
    #[error("a crush profile needs at least 2 stations, and has {stations}")]
    TooFewStations {
        /// Their number.
        stations: usize,
    },
    /// One spacing lies between each two neighbouring stations.
    #[error("{stations} stations need {} spacings between them, and {spacings} are given", .stations - 1)]
    SpacingCount {
        /// Number of stations.
        stations: usize,
        /// Number of spacings.
        spacings: usize,
    },
    /// G = A²/2B does not exist for B = 0.
    #[error("with B = 0 the energy G cannot follow as A²/2B: give G")]
    NoRise,
    /// The force would come from behind the damaged side.
    #[error(
        "a force at {angle:.4} rad to the normal of the damaged side does not push on it: |α| must be less than π/2"
    )]
    NotPushing {
        /// (rad) α.
        angle: f64,
    },
    /// The restitution leaves no dissipated energy, or is not a coefficient of restitution at all.
    #[error("the coefficient of restitution must be at least 0 and less than 1, and is {value}")]
    Restitution {
        /// e.
        value: f64,
    },
    /// Both sides are fixed.
    #[error("both vehicles are fixed: at least one must be able to move")]
    BothFixed,
}

pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), CrushError> {
    if value.is_finite() { Ok(()) } else { Err(CrushError::NotFinite { what, value }) }
}

pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), CrushError> {
    finite(what, value)?;
    if value > 0.0 { Ok(()) } else { Err(CrushError::NotPositive { what, value }) }
}

pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<(), CrushError> {
    finite(what, value)?;
    if value >= 0.0 { Ok(()) } else { Err(CrushError::Negative { what, value }) }
}
