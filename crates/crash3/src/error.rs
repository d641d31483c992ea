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
        "a force at {:.1}° to the normal of the damaged side does not push on it: |α| must be less than 90°",
        .angle.to_degrees()
    )]
    NotPushing {
        /// (rad) α.
        angle: f64,
    },
    /// The force cannot be limited to less than it begins with.
    #[error(
        "the force per width cannot be limited to {limit:.0} N/m where A, at which crush begins, is {a:.0} N/m"
    )]
    LimitBelowStart {
        /// (N/m) F_s.
        limit: f64,
        /// (N/m) A.
        a: f64,
    },
    /// Each zone between two stations has its own stiffness.
    #[error("the profile has {zones} zones between its stations, and stiffness is given for {stiffnesses}")]
    ZoneCount {
        /// Number of zones.
        zones: usize,
        /// Number of stiffnesses.
        stiffnesses: usize,
    },
    /// A barrier test at this speed would leave no crush.
    #[error(
        "the barrier test at {speed:.3} m/s crushed the car, so the speed without damage must be less than that, and is \
         {no_damage_speed:.3} m/s"
    )]
    NoDamageSpeed {
        /// (m/s) b_0.
        no_damage_speed: f64,
        /// (m/s) V.
        speed: f64,
    },
    /// A barrier test without crush tells no stiffness.
    #[error("the barrier test left no crush, so no stiffness follows from it")]
    NoCrushInTest,
    /// A stiffness category that CRASH3 has not.
    #[error("CRASH3 has no stiffness category {category} for the {side}: it has {known}")]
    NoCategory {
        /// As asked for.
        category: u8,
        /// front, rear or side.
        side: &'static str,
        /// Those that there are.
        known: &'static str,
    },
    /// A size class that CRASH3 has not.
    #[error("CRASH3 has no vehicle class {class}: it has {known}")]
    NoClass {
        /// As asked for.
        class: u8,
        /// Those that there are.
        known: &'static str,
    },
    /// The force balance asks more of a structure than it can bear.
    #[error(
        "the force of the other vehicle asks for {force_per_width:.0} N/m, more than the {limit:.0} N/m to which the force per \
         width is limited: the crush cannot be inferred"
    )]
    ForceAboveLimit {
        /// (N/m) as asked for.
        force_per_width: f64,
        /// (N/m) F_s.
        limit: f64,
    },
    /// With B = 0 every crush has the same force.
    #[error("with B = 0 the force is the same at every depth: the crush cannot be inferred from it")]
    NoCrushFromForce,
    /// Not even a crush as deep as the CG and as wide as the side bears the force.
    #[error(
        "the force of the other vehicle is {force:.0} N, and the damaged side bears no more than {most:.0} N even where it is \
         crushed over its whole length and as deep as the centre of gravity"
    )]
    ForceTooGreat {
        /// (N) normal to the side.
        force: f64,
        /// (N) the most that the side bears.
        most: f64,
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

#[inline(always)]
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), CrushError> {
    if value.is_finite() { Ok(()) } else { Err(CrushError::NotFinite { what, value }) }
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
