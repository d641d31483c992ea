//! Errors of the damage analysis.

use real::Real;

/// An input or a result that no damage can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CrushError {
    /// NaN or infinite.
    #[error("the {what} is {value}, but must be a finite number")]
    NotFinite {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// Zero or negative, but must be positive.
    #[error("the {what} is {value}, but must be greater than zero")]
    NotPositive {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// Below zero.
    #[error("the {what} is {value}, but must not be negative")]
    Negative {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
    },
    /// A profile needs two stations or more.
    #[error("a crush profile needs at least 2 stations, but has {stations}")]
    TooFewStations {
        /// Their number.
        stations: usize,
    },
    /// There must be one spacing between each two neighbouring stations.
    #[error("{stations} stations need {} spacings between them, but {spacings} are given", .stations - 1)]
    SpacingCount {
        /// Number of stations.
        stations: usize,
        /// Number of spacings.
        spacings: usize,
    },
    /// G = A²/2B does not exist for B = 0.
    #[error("with B = 0, G cannot be computed as A²/2B; give G")]
    NoRise,
    /// The force would come from behind the damaged side.
    #[error(
        "a force at {:.1}° to the normal of the damaged side does not push on it: |α| must be less than 90°",
        .angle.to_degrees()
    )]
    NotPushing {
        /// (rad) α.
        angle: f64,
    },
    /// The limit of the force per width is below A, the force at which crush begins.
    #[error(
        "the limit of the force per width is {limit:.0} N/m, but must be at least A = {a:.0} N/m, at which \
         crush begins"
    )]
    LimitBelowStart {
        /// (N/m) F_s.
        limit: f64,
        /// (N/m) A.
        a: f64,
    },
    /// The number of stiffnesses is not that of the zones between stations.
    #[error("the profile has {zones} zones between its stations, but stiffness is given for {stiffnesses}")]
    ZoneCount {
        /// Number of zones.
        zones: usize,
        /// Number of stiffnesses.
        stiffnesses: usize,
    },
    /// A barrier test at this speed would leave no crush.
    #[error(
        "the speed without damage is {no_damage_speed:.3} m/s, but must be less than {speed:.3} m/s, at \
         which the barrier test crushed the car"
    )]
    NoDamageSpeed {
        /// (m/s) b_0.
        no_damage_speed: f64,
        /// (m/s) V.
        speed: f64,
    },
    /// No stiffness follows from a barrier test without crush.
    #[error("the barrier test left no crush, so no stiffness follows from it")]
    NoCrushInTest,
    /// No such CRASH3 stiffness category.
    #[error("CRASH3 has no stiffness category {category} for the {side}: it has {known}")]
    NoCategory {
        /// As requested.
        category: u8,
        /// front, rear or side.
        side: &'static str,
        /// The available ones.
        known: &'static str,
    },
    /// No such CRASH3 size class.
    #[error("CRASH3 has no vehicle class {class}: it has {known}")]
    NoClass {
        /// As requested.
        class: u8,
        /// The available ones.
        known: &'static str,
    },
    /// The force balance requires more than the structure can bear.
    #[error(
        "the force of the other vehicle requires {force_per_width:.0} N/m, more than the limit of \
         {limit:.0} N/m, so the crush cannot be inferred"
    )]
    ForceAboveLimit {
        /// (N/m) as required.
        force_per_width: f64,
        /// (N/m) F_s.
        limit: f64,
    },
    /// With B = 0 every crush has the same force.
    #[error("with B = 0 the force is the same at every depth, so the crush cannot be inferred from it")]
    NoCrushFromForce,
    /// Even a crush as deep as the CG and as wide as the side cannot bear the force.
    #[error(
        "the force of the other vehicle is {force:.0} N, but the damaged side can bear no more than \
         {most:.0} N, even if it is crushed over its whole length and as deep as the centre of gravity"
    )]
    ForceTooGreat {
        /// (N) normal to the side.
        force: f64,
        /// (N) the greatest force that the side can bear.
        most: f64,
    },
    /// The restitution leaves no dissipated energy, or is not a coefficient of restitution at all.
    #[error("the coefficient of restitution is {value}, but must be at least 0 and less than 1")]
    Restitution {
        /// e.
        value: f64,
    },
    /// Both vehicles are fixed.
    #[error("both vehicles are fixed, but at least one must be able to move")]
    BothFixed,
}

#[inline(always)]
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), CrushError> {
    if Real::is_finite(value) { Ok(()) } else { Err(CrushError::NotFinite { what, value }) }
}

#[inline(always)]
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), CrushError> {
    finite(what, value)?;
    if value > 0.0 { Ok(()) } else { Err(CrushError::NotPositive { what, value }) }
}

#[inline(always)]
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<(), CrushError> {
    finite(what, value)?;
    if value >= 0.0 { Ok(()) } else { Err(CrushError::Negative { what, value }) }
}
