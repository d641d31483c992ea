//! The motion of a vehicle between the impact and where it came to rest.
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

#![cfg_attr(not(feature = "std"), no_std)]

mod backward;
mod chassis;
mod check;
pub mod closed;
mod error;
mod field;
mod forward;
mod ground;
mod state;
mod steer;
mod step;
mod tyre;

pub use backward::{Departure, MOST_STARTS, REACHED, Starts, Target, Unreached, to_start};
pub use chassis::{Axles, Chassis, GREATEST_DRAG, Wheel};
pub use error::NoRest;
pub use field::GRAVITY;
pub use forward::to_rest;
pub use ground::{GREATEST_FRICTION, GREATEST_GRADE, Ground, Region, Zone};
pub use pim_core::{Body, InvalidInput, Motion, Vector2};
pub use real::Real;
pub use state::{Control, EnergyBalance, Rest, Sample, State};
pub use steer::Steer;
pub use tyre::CORNERING_STIFFNESS;
