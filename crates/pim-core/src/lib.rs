//! Planar impact mechanics (PIM): the effect of a collision on two vehicles, from impulse and momentum.
//!
//! ```
//! use pim_core::{Body, Contact, Law, Motion, Participant, Tangential};
//!
//! // SAE 980025, appendix: a GMC Jimmy at 75 ft/s meets a Nissan Altima at 10 mph (SI units, radians).
//! let jimmy = Participant::polar(Body::new(1676.5, 3304.1)?, 180_f64.to_radians(), 1.920, -22.4_f64.to_radians())?;
//! let altima = Participant::polar(Body::new(1548.1, 2935.3)?, 67_f64.to_radians(), 1.158, -39_f64.to_radians())?;
//! let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
//!
//! let before = [Motion::along(180_f64.to_radians(), 22.86), Motion::along(67_f64.to_radians(), 4.4704)];
//! let outcome = contact.impact(before, &Law::new(0.3, Tangential::Critical)?)?;
//!
//! let [dv1, dv2] = outcome.delta_v_magnitude();
//! assert!((dv1 - 12.12).abs() < 0.05 && (dv2 - 13.13).abs() < 0.05); // the paper: 12.12 and 13.13 m/s
//! assert!((outcome.energy.normal_work / 1.41e5 - 1.0).abs() < 0.005); // the crush energy, 1.41e5 N·m
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The types: a [`Body`] with heading and arm is a [`Participant`]; two of them and a crush plane make a
//! [`Contact`]; the contact, two [`Motion`]s and a [`Law`] give an [`Outcome`]. Each number may be any
//! [`Real`]; plain `f64` is the default. A [`VehicleId`] identifies one of the two vehicles.
//!
//! # Frames and signs
//!
//! ```text
//!        y │                 vehicle 1, heading θ₁                n  (scene angle Γ, from vehicle 2
//!   scene  │                       ╭───────────╮                  ▲   towards vehicle 1)
//!          └──── x           ◄─────┤   CG₁ •   │                  │
//!                                  ╰──────╲────╯                  │
//!   angles counter-clockwise               ╲ r₁ = d₁ at θ₁+φ₁     │
//!   from +x; yaw rates too        ──────────• C ──────────  t ◄───┘  crush plane; t is n turned by +90°
//!                                          ╱ r₂
//!                                  ╭──────╱────╮             P acts on vehicle 1 at C, −P on vehicle 2;
//!                                  │   CG₂ •   ├─────►       a push has P_n > 0
//!                                  ╰───────────╯             u is vehicle 1 relative to vehicle 2 at C;
//!                            vehicle 2, heading θ₂           an approach has u_n < 0
//! ```
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `crush_plane`, `normal_angle` | Γ | scene angle of the crush plane's normal: as given, and that of n | rad |
//! | `forward` | (cos θ, sin θ) | unit vector of the vehicle's own forward axis | – |
//! | `arm`, `arms` | r_i | vector from CG_i to C; in n–t axes (d_d, d_c) and (d_b, d_a) of the paper's Eq 2 | m |
//! | `inverse_mass` | K | contact inverse-mass matrix, U = u + K P | 1/kg |
//! | `approach`, `separation` | u, U | relative velocity at C before and after | m/s |
//! | `impulse` | P | on vehicle 1 | N·s |
//! | `restitution` | e | U_n = −e u_n | – |
//! | `impulse_ratio` | μ | P_t/P_n | – |
//! | `critical_impulse_ratio` | μ_c | the ratio that gives U_t = 0 | – |
//! | `loss` | E_L | kinetic energy taken by the impact | J |
//! | `normal_work`, `tangential_work` | W_n, W_t | its two parts | J |
//! | `moment_impulse`, `moment_work` | M, W_m | moment impulse on vehicle 1, and its part of the loss | N·m·s, J |
//! | `mirrored` | | the same in axes of the other handedness: y to the right, clockwise positive, t on the other side of n | |
//! | `pdof` | PDOF | direction from which the force comes, clockwise from the heading | rad |
//!
//! # Which impact law?
//!
//! The table at [`Law`] has the two conditions of each law, its source, when it fits, and what it assumes
//! about the tangential direction. If restitution depends on the closing speed, a [`RestitutionCurve`] makes
//! the law a [`VaryingLaw`].
//!
//! `examples/impact.rs` is the paper's impact forward, `examples/laws.rs` one geometry under several laws.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | nothing. Without it the crate is `no_std` and needs `alloc`; results have the same bits |
//! | `serde` | serialisation of inputs and results, not of errors. Reading calls the constructors, so that impossible values are refused |
//!
//! # What it does not do
//!
//! No crush (see `crash3`), no search for an unknown speed (see `reconcile`), no motion before or after the
//! impact, no units other than SI, no third dimension: roll, pitch and suspension forces are outside planar
//! impact mechanics. An impact is refused if an energy leaves the range of double precision; with numbers as
//! extreme as a yaw inertia of 1e-300 kg·m², other results may leave it nevertheless.
//!
//! # References
//!
//! R. M. Brach and R. M. Brach, *Crush Energy and Planar Impact Mechanics for Accident Reconstruction*, SAE
//! 980025 (1998), called *the paper*. Some of its equations are misprinted; those here were derived afresh,
//! and departures from print are marked `ERRATUM`.

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

extern crate alloc;

mod body;
mod border;
pub mod check;
mod contact;
#[cfg(feature = "serde")]
mod data;
mod error;
mod impact;
mod law;
mod mirror;
mod restitution;
mod vehicle_id;

pub use body::{Body, Motion, Participant};
pub use border::{Border, Switch};
pub use contact::{Approach, Contact, InverseMass, NormalTangential};
pub use error::{ImpactError, InvalidInput};
pub use impact::{Energy, Outcome, direction, normal_work, pdof};
pub use law::{Law, LawImpulse, Regime, Tangential};
pub use nalgebra::{self, Vector2};
pub use real::Real;
pub use restitution::{RestitutionCurve, VaryingLaw};
pub use vehicle_id::VehicleId;
