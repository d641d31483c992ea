//! Finds the speed that makes the work of the normal impulse equal the crush energy, and both speeds from the
//! momentum after impact.
//!
//! ```
//! use pim_core::{Body, Contact, Law, Motion, Participant, Tangential};
//! use reconcile::{EnergyBasis, Problem, Unknown};
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
//!     unknown: Unknown::Speed1,
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
//! The types: a [`Problem`] is a collision with one [`Unknown`] speed; solving it gives a [`Reconciliation`],
//! which holds the speed, the impact at that speed, and the [`SolutionMethod`] that found it.
//! [`Problem::speeds`] lists all admissible speeds. The numbers on the way to a closed form are
//! [`Problem::line`], and under the law that acts [`Problem::quadratic`] and [`Problem::affine_impact`].
//!
//! Where neither speed is known, but both velocities after impact are, a [`Momentum`] gives both speeds if
//! the approaches cross, and a [`MomentumAndCrush`] if they are collinear. [`Implied`] is what is then known
//! twice. A [`MomentumBesideCrush`] weighs momentum that gives both speeds against the crush energy.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `x` | x = −u_n | approach speed | m/s |
//! | `slope` | c_n, c_t | du/ds, by the speed s that is sought | – |
//! | `at_rest` | u_n0, u_t,rest | u at the speed s = 0 | m/s |
//! | `tangential_slope` | τ | du_t/dx | – |
//! | `tangential_at_zero_approach` | u_t0 | u_t at x = 0 | m/s |
//! | `alpha`, `beta` | α, β | P_n = α x + β in a [`Quadratic`] | kg, N·s |
//! | `c` | c | 2 W_n/(1−e) | J |
//! | `normal` | α_n, β_n | P_n = α_n x + β_n in an [`AffineImpact`] | kg, N·s |
//! | `tangential` | α_t, β_t | P_t = α_t x + β_t | kg, N·s |
//! | `sliding` | η, ζ | u_t + U_t = η x + ζ | –, m/s |
//! | `tangential_share` | λ | share of the tangential work that the crush takes | – |
//! | `axis` | â | unit vector along which momentum is kept | – |
//! | `relative` | σ | relative speed of the CGs along the line of speeds that the momentum allows | m/s |
//!
//! # Guarantees
//!
//! - The relative velocity at C is affine in the speed. Under an impact law without a limit, W_n is then
//!   quadratic in it and the answer is a closed form. Under a friction limit it is one of three such
//!   quadratics, that of sticking or of sliding one way or the other, and a root of one is a speed where that
//!   law [acts](Reconciliation::acting). Under a restitution that depends on the closing speed, signs isolate
//!   the roots of nearly all collisions, and Newton's method finds them. Under a fraction of μ_c, and where
//!   signs leave roots open, W_n is a ratio of polynomials piece by piece; their extrema isolate the roots,
//!   which Brent's method ([`brent`]) finds. All agree to 1e-10 where they apply.
//! - An admissible speed is one of at most 1000 m/s at which the vehicles approach, push, and lose energy.
//!   All are found, however many and however near to each other; the answer is the one with the slowest
//!   approach.
//! - [`Problem::residual`] gives the exact derivatives of a root, on numbers that carry their derivative.
//! - Nothing is allocated.
//!
//! `examples/speed.rs` finds the paper's speed on both energy bases.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | nothing of its own. Without it the crate is `no_std`; its engines need `alloc`; results have the same bits |
//! | `serde` | problems and answers can be written and read, errors cannot |
//!
//! # What it does not do
//!
//! Speeds are along the courses, which are the headings where no vehicle has a sideslip. It does not measure
//! crush (see `crash3`), nor does it find the velocities after impact from rest positions: [`Momentum`] takes
//! them as given.

#![cfg_attr(not(feature = "std"), no_std)]

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
    MomentumBesideCrush, MomentumError, WeighedSpeeds, central_contact, point_masses,
};
pub use problem::{Problem, Unknown};
