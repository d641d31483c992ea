//! Time and distance before a collision.
//!
//! ```
//! use time_distance::{Response, Swell};
//!
//! // 50 km/h, reaction 0.8 s, brakes that take hold in 0.2 s, 7.5 m/s².
//! let response = Response::new(0.8, 0.2, 7.5, Swell::Linear)?;
//! let speed = 50.0 / 3.6;
//! assert!((response.stopping_distance(speed) - 25.35).abs() < 0.01);
//! // The danger could be seen 20 m ahead: the vehicle hits it at 32.2 km/h, and would have stopped from
//! // 42.6 km/h.
//! assert!((response.speed_after(speed, 20.0) * 3.6 - 32.2).abs() < 0.1);
//! assert!((response.speed_to_stop_within(20.0) * 3.6 - 42.6).abs() < 0.1);
//! # Ok::<(), time_distance::InvalidInput>(())
//! ```
//!
//! A [`Response`] is what a driver does from the reaction demand on, the moment when the danger could first
//! be recognized: a reaction at constant speed, a swell in which the brakes take hold, then a constant
//! deceleration to a stop. Its methods are closed forms. [`Response::legs`] gives the same motion as
//! [`Leg`]s, stretches of constant jerk. A [`Course`] consists of legs: that of a vehicle before the impact
//! ([`approach`]), of a driver who brakes, of a pedestrian. [`Advance`] is how the other road user moves:
//! steadily, or from a stop. [`Crossing`] gives the zone where two paths meet and the times that each road
//! user is in it, [`least_gap`] how close one vehicle comes to another ahead of it, [`first_contact`] when it
//! reaches it, and [`sees`], [`first_sight`] and [`free_since`] when obstacles leave the view free.
//!
//! `examples/avoidable.rs` asks whether a collision was avoidable.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `reaction` | t_R | from the demand to the first effect of the brakes | s |
//! | `swell` | t_S | from there to the full deceleration | s |
//! | `deceleration` | a | full deceleration, positive | m/s² |
//! | `delay` | τ = t_R + t_S/2 | the time that counts as driven at full speed | s |
//! | `distance` | s | from the place of the demand along the path | m |
//!
//! # Guarantees
//!
//! - The closed forms agree to 1e-9 of their scale with a simulation in small steps, on a million random
//!   scenes.
//! - Stopping distance and avoidance speed, braked distance and speed at the demand, collision speed and
//!   arrival are inverses of each other.
//! - The numbers may carry derivatives, which are exact, also where an equation is solved by iteration.
//! - Nothing is allocated.
//!
//! # What it does not do
//!
//! No steering: each road user follows a path that is given, and only its speed varies. No impact: what
//! happens at the place of the collision is for `pim_core`. It states no reaction time and no deceleration of
//! its own.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | nothing but that of the crates below. Without it the crate is `no_std`; results have the same bits |
//! | `serde` | responses, legs, phases and crossings can be written and read |

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

mod advance;
mod approach;
mod course;
mod crossing;
#[cfg(feature = "serde")]
mod data;
mod gap;
mod response;
mod sight;

pub use advance::Advance;
pub use approach::{Phase, approach};
pub use course::{Course, Leg};
pub use crossing::{Crossing, Occupancy, Party};
pub use gap::{Gap, first_contact, least_gap};
pub use pim_core::{InvalidInput, Vector2};
pub use real::Real;
pub use response::{Demand, Response, Swell};
pub use sight::{first_sight, free_since, sees};
