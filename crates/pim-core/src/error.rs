//! Errors: invalid inputs of a collision, and impacts without an answer.

use alloc::format;
use alloc::string::String;

use crate::vehicle_id::VehicleId;

/// An input that no body, contact or law can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidInput {
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
    /// Below the least value that the quantity can have.
    #[error("the {what} is {value}, but must be at least {low}")]
    TooSmall {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// Smallest allowed value.
        low: f64,
    },
    /// Outside the interval on which the quantity is defined.
    #[error("the {what} is {value}, but must lie between {low} and {high}")]
    OutOfRange {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
    },
    /// A restitution curve needs at least one point.
    #[error("a restitution that depends on the closing speed needs at least one point")]
    NoPoints,
    /// The speeds of a restitution curve must ascend.
    #[error("the closing speeds of a restitution must ascend from zero: {value} m/s follows {before} m/s")]
    NotAscending {
        /// (m/s) the speed before, or zero.
        before: f64,
        /// (m/s) the speed that is not above it.
        value: f64,
    },
    /// An acceleration with the wrong sign for a change of speed, or zero between two speeds.
    #[error(
        "an acceleration of {acceleration} m/s² does not take the vehicle from {from:.2} m/s to {to:.2} m/s; \
         it must be positive if the vehicle gains speed and negative if it loses speed"
    )]
    NotReached {
        /// (m/s) the speed where the stretch begins.
        from: f64,
        /// (m/s) the speed where it ends.
        to: f64,
        /// (m/s²) the acceleration.
        acceleration: f64,
    },
    /// A stretch of constant acceleration that would begin in reverse.
    #[error(
        "a stretch that ends at {end:.2} m/s would have gained more speed than that, so \
         the vehicle would have begun it in reverse"
    )]
    GainsMore {
        /// (m/s) the speed where it ends.
        end: f64,
    },
    /// A stretch of constant acceleration in which the vehicle would stop and reverse.
    #[error(
        "a stretch that begins at {start:.2} m/s would lose more speed than that: the vehicle would stop before the stretch \
         ends; make the stretch shorter or the deceleration lower"
    )]
    StopsWithin {
        /// (m/s) the speed where it begins.
        start: f64,
    },
    /// Two fixed bodies cannot collide.
    #[error("both bodies are fixed, but at least one must be able to move")]
    BothFixed,
    /// A fixed body was given a velocity or a yaw rate.
    #[error("body {body} is fixed and cannot have a velocity or a yaw rate")]
    FixedBodyMoves {
        /// Which body.
        body: VehicleId,
    },
    /// The crush plane runs along the line between the two CGs, so that neither of its normals points from
    /// vehicle 2 towards vehicle 1.
    #[error(
        "the crush plane normal at {:.2}° is perpendicular to the line between the centres of \
         gravity, so that it cannot be oriented from vehicle 2 towards vehicle 1; check the crush plane's angle, the \
         headings and the contact points",
        .crush_plane.to_degrees()
    )]
    NormalUndefined {
        /// (rad) the crush plane angle Γ.
        crush_plane: f64,
    },
}

/// Why a well-formed collision has no impact.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpactError {
    /// An input is impossible.
    #[error(transparent)]
    Invalid(#[from] InvalidInput),
    /// u_n ≥ 0: the contact points do not approach each other.
    #[error(
        "the vehicles do not approach each other at the contact point: the normal relative velocity u_n is \
         {u_n:.6} m/s, but must be negative; check the headings, the speeds and the crush plane"
    )]
    NotApproaching {
        /// (m/s) normal component of the relative velocity at C before impact.
        u_n: f64,
    },
    /// k_nn + μ k_nt ≤ 0: the geometry jams before the normal velocity can reverse.
    #[error(
        "the contact jams: with the impulse ratio μ = {impulse_ratio:.6} the impulse would have to be infinite \
         or negative, because k_nn + μ k_nt = {k_nn:.6e} + {impulse_ratio:.6} × {k_nt:.6e} 1/kg is not \
         positive; \
         this geometry needs μ {} {:.6}: check its sign and decimal point and the contact points, or give a \
         friction limit instead; the friction law cannot jam", if *.k_nt > 0.0 { "above" } else { "below" }, -.k_nn / .k_nt
    )]
    Jam {
        /// μ = P_t/P_n.
        impulse_ratio: f64,
        /// (1/kg) normal entry of the contact inverse-mass matrix.
        k_nn: f64,
        /// (1/kg) its off-diagonal entry.
        k_nt: f64,
    },
    /// The tangential condition, such as a common tangential velocity at C, would need P_n ≤ 0: the vehicles
    /// would have to pull on each other.
    #[error(
        "the tangential condition would require the vehicles to pull on each other (P_n = \
         {normal_impulse:.6} N·s), because they slide too fast for this geometry; check the contact points \
         and the crush plane or, if the surfaces did slide until they separated, give a friction limit or \
         an impulse ratio instead"
    )]
    Pulling {
        /// (N·s) the normal impulse that the conditions require.
        normal_impulse: f64,
    },
    /// E_L < 0: the coefficients create energy.
    #[error(
        "the coefficients create energy: the energy loss would be {loss:.6e} J ({normal_work:.6e} J is the \
         work of the normal impulse, {tangential_work:.6e} J that of the tangential impulse{}); check that the \
         impulse ratio has the sign that opposes the sliding, and lower its size or the restitution",
        of_moment(*moment_work)
    )]
    EnergyCreated {
        /// (J) the energy loss E_L.
        loss: f64,
        /// (J) W_n.
        normal_work: f64,
        /// (J) W_t.
        tangential_work: f64,
        /// (J) W_m.
        moment_work: f64,
    },
    /// The numbers are too large or too small for double precision.
    #[error(
        "the impact leaves the range of double precision: the {what} would be {value}; check the speeds, masses and \
         inertias, and their units"
    )]
    Overflow {
        /// Which quantity.
        what: &'static str,
        /// Its value, in SI units: infinite or NaN.
        value: f64,
    },
}

/// The share of a moment impulse, if there is one.
fn of_moment(work: f64) -> String {
    if work == 0.0 { String::new() } else { format!(", and {work:.6e} J that of the moment impulse") }
}
