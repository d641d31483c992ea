//! Where a scene begins, and why numbers make none.

use pim_core::InvalidInput;

/// (m, s) beyond all values of interest; stands for anything farther, such as the arrival of a vehicle that
/// stops before.
pub(super) const FAR: f64 = 1e6;

/// Where or when a scene begins.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Since {
    /// (m) distance of the vehicle before the impact.
    Distance(f64),
    /// (s) time before the impact.
    Time(f64),
}

/// (m/s) unknown speeds just before the impact, found from the rest of the case.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SoughtSpeeds {
    /// Of the vehicle whose driver is judged.
    pub(crate) subject: Option<f64>,
    /// Of the other.
    pub(crate) other: Option<f64>,
}

/// Why the numbers make no scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unposed {
    /// The vehicle already braked where or when the danger could first be recognized.
    BrakedBefore {
        /// (m) from the first effect of the brakes to the impact.
        distance: f64,
        /// (s) likewise.
        time: f64,
    },
    /// From this speed, the skid ends before the impact.
    SkidTooLong,
    /// The vehicle sets out from a stop at this distance (m) from the impact, after the place of the demand.
    SetsOutLater {
        /// (m)
        distance: f64,
    },
    /// The phases before the impact cannot be.
    Phases(InvalidInput),
    /// Those of the other vehicle cannot be.
    OtherPhases(InvalidInput),
    /// By their speeds, the vehicle does not come up to the other one on their line.
    Parts,
    /// The other vehicle ran into its rear.
    FromBehind,
    /// The vehicle did not move forward.
    Stands,
    /// The other vehicle did not move forward, so it never clears the danger zone.
    OtherStands,
    /// At the impact, the other vehicle is outside of the strip that the outline of the vehicle sweeps.
    Outside,
    /// Nothing says how fast the other party moves, on which the sight depends.
    OtherUnknown,
    /// Obstacles hide nothing before the impact, so their end is no demand.
    NeverHidden,
    /// An obstacle hides the other party at the impact.
    HiddenAtImpact,
    /// The engine refuses a number.
    Engine(InvalidInput),
}

impl From<InvalidInput> for Unposed {
    fn from(refusal: InvalidInput) -> Self {
        Self::Engine(refusal)
    }
}
