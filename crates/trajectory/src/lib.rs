//! The motion of a vehicle from the impact to its rest position.
//!
//! ```
//! use trajectory::{Axles, Body, Chassis, Control, Ground, Motion, State, Steer, Vector2, to_rest};
//!
//! // RICSAC 6: the Rabbit after the impact (Vossou & Koulocheris 2018). It came to rest 21.5 ft away, turned
//! // by 123°.
//! let axles = Axles { cg_to_front: 1.176, cg_to_rear: 1.273, track: 1.387 };
//! let rabbit = Chassis::new(Body::new(1190.0, 2263.0)?, axles, [0.062; 4])?;
//! let start = State {
//!     position: Vector2::new(0.0, 0.0),
//!     heading: 60_f64.to_radians(),
//!     motion: Motion { velocity: Vector2::new(-1.28, 5.49), yaw_rate: -3.14 },
//! };
//! let ground = Ground::level(0.87);
//! let rest = to_rest(&rabbit, Steer::straight(), &ground, &start, &Control::default(), |_| {})?;
//! assert!((rest.position.x.hypot(rest.position.y) - 21.5 * 0.3048).abs() < 0.2);
//! assert!(((rest.heading - start.heading).to_degrees() + 123.0).abs() < 5.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The types: a [`Body`] on its [`Axles`], with the drag of each [`Wheel`], is a [`Chassis`]. It stands on a
//! [`Ground`], which may have [`FrictionZone`]s and a grade, with a [`Steer`] angle of its front wheels.
//! [`to_rest`] follows it from a [`State`] to its [`Rest`] and passes on a [`Sample`] after each step;
//! [`to_start`] finds every motion that leads to a [`Target`], as [`Starts`]. `to_rests` follows many
//! motions, each an `Outset`, eight at a time. The closed forms are in [`closed`].
//!
//! Frames and signs are those of `pim_core`: y to the left of x, angles and yaw rates counter-clockwise.
//! Wheels are ordered front left, front right, rear left, rear right. The equations are in theory, section
//! 11.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `cg_to_front`, `cg_to_rear` | a, b | from the CG to the axles | m |
//! | `load` | F_z/W | fraction of the weight on a wheel | – |
//! | `drag` | d | rolling resistance as a fraction of the load; at the friction and above, the wheel is locked | – |
//! | `friction` | μ | friction of tyres on the ground | – |
//! | `grade` | G = tan θ | rise per horizontal length | – |
//! | `heading`, `turn` | ψ, Δψ | including full turns | rad |
//!
//! # Which drag, which friction?
//!
//! As fractions of the friction (EDCRASH's manual; multiply by μ for `drag`): a rolling tyre 0.01/μ, a partly
//! flat one 0.013/μ, a damaged wheel 0 to 1, an engine in high gear 0.15/μ to 0.20/μ, in low gear 0.2/μ to
//! 0.4/μ, on the driven wheels. The vehicles of the staged RICSAC collisions 3 and 6 reach their rest
//! positions with 0.047 to 0.091 on all wheels. Dry travelled asphalt has 0.60 to 0.80 below 30 mph and 0.55
//! to 0.70 above, wet 0.50 to 0.80 and 0.45 to 0.75, loose gravel 0.40 to 0.70, packed snow 0.30 to 0.55,
//! smooth ice 0.10 to 0.25.
//!
//! # Guarantees
//!
//! - Straight slides, free rolling and spins about the centre agree with their closed forms to 1e-9, even on
//!   a grade and over changing ground.
//! - With the default [`Control`] the rest of 950 of 1000 random spin-outs of five to seven seconds is exact
//!   to 4 mm and 0.03°, of 992 to 1 cm and 0.1°, of all to 7 cm and 0.4°. With a tolerance of 5e-4, which
//!   takes two thirds of the steps, that of 869 is exact to 1 cm and 0.1°, and of 974 of 1000 that spin like
//!   RICSAC 6. Four times the steps make it 100 times better. [`MotionEnergy::remainder`] shows the error of
//!   each run.
//! - Of 300 vehicles that roll far, up to 700 m at drags of 0.005 to 0.05, the rest is exact to 0.03 % of the
//!   path; of 300 with the front wheels steered by up to 6°, to 0.1 % for 285 and to 0.13 % for all.
//! - [`to_start`] found a start for each of 1000 random rests: for 539 the original one, to 1e-6, for the
//!   others one that comes to rest within 1 mm.
//! - A motion followed together with others has the same bits as one followed alone.
//! - Nothing is allocated, and the numbers may carry derivatives, including those of the times when wheels
//!   cross borders.
//!
//! `examples/rest.rs` follows a vehicle to rest and back.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | `to_rests`. Without it the crate is `no_std`; results have the same bits |
//! | `serde` | serialisation of states, samples, rests and the numbers of the closed forms, not of a chassis, [`Ground`], [`Steer`], [`Starts`] or errors |
//!
//! # What it does not do
//!
//! No roll, pitch or load transfer, no curbs, poles or second impacts, no trailers, no driver. A region of
//! ground that a wheel crosses in less than 0.25 m may be overlooked. [`to_start`] looks for one start for
//! each turn of the vehicle; if two motions with the same turn lead to one rest, it finds either.

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

mod backward;
#[cfg(feature = "std")]
mod block;
mod chassis;
pub mod closed;
mod error;
mod field;
mod footing;
mod forward;
mod ground;
#[cfg(feature = "std")]
mod lanes;
mod number;
mod progress;
mod state;
mod steer;
mod step;
mod tyre;

pub use backward::{MOST_STARTS, REACHED, StartMotion, Starts, Target, Unreached, to_start, to_start_near};
#[cfg(feature = "std")]
pub use block::{Outset, to_rests};
pub use chassis::{Axles, Chassis, GREATEST_DRAG, Wheel};
pub use error::NoRest;
pub use field::GRAVITY;
pub use forward::to_rest;
pub use ground::{FrictionZone, GREATEST_FRICTION, GREATEST_GRADE, Ground, Region};
pub use pim_core::{Body, InvalidInput, Motion, Vector2};
pub use real::Real;
pub use state::{Control, GREATEST_SPEED, GREATEST_YAW_RATE, MotionEnergy, Rest, Sample, State};
pub use steer::Steer;
pub use tyre::CORNERING_STIFFNESS;
