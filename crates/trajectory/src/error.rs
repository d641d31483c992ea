//! Errors of a motion that does not come to rest.

use pim_core::InvalidInput;

use crate::state::State;

/// Why a vehicle did not come to rest.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoRest {
    /// An input is impossible.
    #[error(transparent)]
    Invalid(#[from] InvalidInput),
    /// The vehicle keeps moving.
    #[error(
        "after {time:.1} s the vehicle still moves at {:.3} m/s; check the drag of its wheels, the friction and the \
         grade", speed(.state)
    )]
    StillMoving {
        /// (s) time for which it was followed.
        time: f64,
        /// Its state then.
        state: State,
    },
    /// The vehicle stops on a grade that pulls harder than its wheels hold.
    #[error(
        "after {time:.2} s the vehicle stops on a grade that pulls with {pull:.3} of its weight along its axis, \
         while its wheels hold {hold:.3}: it rolls back; check the grade, or give its wheels more drag"
    )]
    RollsBack {
        /// (s) time at which it stopped.
        time: f64,
        /// Its state at the stop.
        state: State,
        /// (–) pull of the grade, as a fraction of the weight.
        pull: f64,
        /// (–) pull that the wheels hold, as a fraction of the weight.
        hold: f64,
    },
    /// The vehicle stops on a grade on which its tyres slide.
    #[error(
        "after {time:.2} s the vehicle stops on a grade that pulls with {pull:.3} of its weight, while the \
         friction of its tyres holds {hold:.3}: it slides down; check the grade and the friction"
    )]
    SlidesDown {
        /// (s) time at which it stopped.
        time: f64,
        /// Its state at the stop.
        state: State,
        /// (–) pull of the grade, as a fraction of the weight.
        pull: f64,
        /// (–) pull that the tyres hold, as a fraction of the weight.
        hold: f64,
    },
    /// The integration needs more steps than allowed.
    #[error(
        "the motion needs more than {steps} steps: at {time:.2} s the vehicle still moves at {:.3} m/s; allow \
         more steps or a greater tolerance", speed(.state)
    )]
    TooManySteps {
        /// Steps taken.
        steps: u32,
        /// (s) time reached.
        time: f64,
        /// Its state then.
        state: State,
    },
}

/// (m/s) speed of the CG.
fn speed(state: &State) -> f64 {
    let v = state.motion.velocity;
    real::elementary::sqrt(v.x * v.x + v.y * v.y)
}
