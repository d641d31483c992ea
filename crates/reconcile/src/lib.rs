//! Finds the speed at which the work of the normal impulse equals the crush energy, and both speeds from the
//! momentum after impact.
//!
//! ```
//! use pim_core::{Body, Contact, Law, Motion, Participant, Tangential, VehicleId};
//! use reconcile::{EnergyBasis, Problem};
//!
//! // SAE 980025, appendix: how fast was the GMC Jimmy, if both vehicles' crush took 1.41e5 N·m?
//! let jimmy = Participant::polar(Body::new(1676.5, 3304.1)?, 180_f64.to_radians(), 1.920, -22.4_f64.to_radians())?;
//! let altima = Participant::polar(Body::new(1548.1, 2935.3)?, 67_f64.to_radians(), 1.158, -39_f64.to_radians())?;
//! let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
//! let motions = [Motion::rest(), Motion::along(67_f64.to_radians(), 4.4704)];
//! let law = Law::new(0.3, Tangential::Critical)?;
//!
//! let problem = Problem {
//!     contact,
//!     law: law.into(),
//!     motions,
//!     unknown: VehicleId::One,
//!     crush_energy: 1.41e5,
//!     basis: EnergyBasis::Dissipated,
//!     tangential_share: 0.0,
//! };
//! let answer = problem.solve()?;
//! assert!((answer.speed - 22.9).abs() < 0.05); // the paper: 22.9 m/s
//! assert!((answer.outcome.energy.normal_work - 1.41e5).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The types: a [`Problem`] is a collision with one unknown speed; solving it gives a [`Reconciliation`],
//! which holds the speed, the impact at that speed, and the [`SolutionMethod`] that found it.
//! [`Problem::speeds`] lists all admissible speeds. The intermediate results of a closed form are
//! [`Problem::line`] and, under the law that acts, [`Problem::quadratic`] and [`Problem::affine_impact`].
//!
//! If both velocities after impact are known but neither speed before it, a [`Momentum`] gives both speeds
//! for crossing approaches, and a [`MomentumAndCrush`] for collinear ones. [`Implied`] holds the numbers that
//! are then overdetermined. A [`MomentumBesideCrush`] weighs the momentum of crossing approaches against the
//! crush energy.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `x` | x = −u_n | approach speed | m/s |
//! | `slope` | c_n, c_t | du/ds, with the speed s sought | – |
//! | `at_rest` | u_n0, u_t,rest | u at the speed s = 0 | m/s |
//! | `tangential_slope` | τ | du_t/dx | – |
//! | `tangential_at_zero_approach` | u_t0 | u_t at x = 0 | m/s |
//! | `alpha`, `beta` | α, β | P_n = α x + β in a [`Quadratic`] | kg, N·s |
//! | `c` | c | 2 W_n/(1−e) | J |
//! | `normal` | α_n, β_n | P_n = α_n x + β_n in an [`AffineImpact`] | kg, N·s |
//! | `tangential` | α_t, β_t | P_t = α_t x + β_t | kg, N·s |
//! | `sliding` | η, ζ | u_t + U_t = η x + ζ | –, m/s |
//! | `tangential_share` | λ | share of the tangential work that the crush takes | – |
//! | `axis` | â | unit vector along which momentum is conserved | – |
//! | `relative` | σ | relative speed of the CGs, along the line of speeds that the momentum allows | m/s |
//!
//! # Guarantees
//!
//! - The relative velocity at C is affine in the speed. Under an impact law without a limit, W_n is then
//!   quadratic in it and the answer is a closed form. Under a friction limit it is one of three such
//!   quadratics, for sticking and for sliding in either direction, and a root of one counts if that law
//!   [acts](Reconciliation::acting) there. Under a restitution that depends on the closing speed, signs
//!   isolate the roots of nearly all collisions, and Newton's method finds them. Under a fraction of μ_c, and
//!   if signs do not isolate the roots, W_n is piecewise a ratio of polynomials; the extrema isolate the
//!   roots, which Brent's method ([`brent`]) finds. All methods agree to 1e-10 where they apply.
//! - An admissible speed is at most 1000 m/s, and the vehicles approach, push and lose energy at it. All are
//!   found, however many and however close together; the answer is the one with the slowest approach.
//! - [`Problem::residual`], on numbers that carry their derivatives, gives the exact derivatives of a root.
//! - Nothing is allocated.
//!
//! `examples/speed.rs` finds the paper's speed on both energy bases.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | nothing. Without it the crate is `no_std`; its engines need `alloc`; results have the same bits |
//! | `serde` | serialisation of problems and answers, not of errors, [`MomentumAndCrush`] and [`MomentumBesideCrush`] |
//!
//! # What it does not do
//!
//! Speeds are along the courses, which are the headings unless a vehicle has sideslip. The crate does not
//! evaluate crush (see `crash3`), nor find the velocities after impact from rest positions: [`Momentum`]
//! takes them as given.

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

mod answer;
mod branch;
mod brent;
mod closed_form;
mod cubic;
mod error;
mod fraction;
mod isolated;
mod line;
mod momentum;
mod nearest;
mod pieces;
mod polynomial;
mod posed;
mod problem;
mod quartic;
mod root;
mod search;
mod stretch;

pub use answer::{FASTEST, Iteration, Iterations, Reconciliation, SolutionMethod};
pub use brent::{MAX_STEPS, RootError, brent};
pub use closed_form::{AffineImpact, Quadratic};
pub use crash3::EnergyBasis;
pub use error::ReconcileError;
pub use line::ApproachLine;
pub use momentum::{
    BothSpeeds, COLLINEAR, Departure, EvidenceErrors, Implied, Momentum, MomentumAndCrush,
    MomentumBesideCrush, MomentumError, WeighedSpeeds, are_collinear, central_contact, point_masses,
};
pub use pim_core::{
    Body, Contact, InvalidInput, Law, Motion, Participant, RestitutionCurve, Tangential, VaryingLaw, Vector2,
    VehicleId,
};
pub use problem::Problem;
