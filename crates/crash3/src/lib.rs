//! CRASH3 damage analysis: crush energy and velocity changes from measured crush.
//!
//! ```
//! use crash3::{StruckVehicle, Profile, Stiffness, crush_energy, delta_v};
//!
//! // SAE 980025, appendix: the front of the GMC Jimmy (SI units).
//! let depths = [21.3, 20.3, 13.8, 11.3, 5.3, 4.8].map(|inch| inch * 0.0254);
//! let profile = Profile::equally_spaced(depths.to_vec(), 65.0 * 0.0254)?;
//! let stiffness = Stiffness::from_ab(58_740.0, 633_000.0)?;
//! let energy = crush_energy(&profile, &stiffness);
//! assert!((energy / 1.02e5 - 1.0).abs() < 0.005); // the paper: 1.02e5 N·m
//!
//! // Both vehicles' energies move both of them (the paper's 1.41e5 N·m in all).
//! let jimmy = StruckVehicle::new(1676.5, 3304.1, 0.646)?;
//! let altima = StruckVehicle::new(1548.1, 2935.3, 0.592)?;
//! let [dv1, dv2] = delta_v(1.41e5, [jimmy, altima])?;
//! assert!((1676.5 * dv1 - 1548.1 * dv2).abs() < 1e-9); // equal and opposite momenta
//! # Ok::<(), crash3::CrushError>(())
//! ```
//!
//! The types: a [`Profile`] of depths and a [`Stiffness`] give [`crush_energy`] and [`peak_force`]; an
//! [`ObliqueCorrection`] raises the energy of a force that is not normal to the damaged [`Side`]; two
//! [`StruckVehicle`]s turn the sum of both vehicles' energies into [`delta_v`]; [`EnergyBasis`] takes
//! restitution into account. Each number may be any [`Real`]; plain `f64` is the default.
//!
//! A stiffness comes from its coefficients, from a [`BarrierTest`] or from CRASH3's table
//! ([`Stiffness::from_category`]); a [`SideStiffness`] may differ from zone to zone. The force acts through
//! the centroid of the damage on a [`DamagedFace`]. If only one vehicle could be inspected,
//! [`crush_from_force`] infers the other's crush from the force on both. [`VehicleClass`] and
//! [`yaw_inertia_burg`] replace unknown dimensions and inertia.
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `depths` | C_j | residual crush at station j | m |
//! | `width` | L; w_j | width of the damage; of one zone between stations | m |
//! | `a`, `b`, `g` | A, B, G | stiffness: force per width A + B C, energy per width G before crush | N/m, N/m², N |
//! | `area`, `second_moment` | S_1; S_2 | ∫ C and ∫ C²/2 over the width of a [`ProfileSums`] | m²; m³ |
//! | `mean_depth`, `mean_square_depth` | C̄; Q | mean and mean square of the depth over the width | m; m² |
//! | `slope` | b_1 | rise of the speed with crush in a [`BarrierTest`] | 1/s |
//! | `saturation_force` | F_s | force per width beyond which A + B C is flat | N/m |
//! | `d0`, `d1` | d_0, d_1 | equivalent to A, B and G: A = d_0 d_1, B = d_1², G = d_0²/2 | √N, √N/m |
//! | `oblique_angle` | α | angle between the force and the normal of the damaged side | rad |
//! | `pdof` | PDOF | direction from which the force comes, clockwise from the heading | rad |
//! | `moment_arm` | h | distance from the CG to the force's line of action | m |
//! | `square_radius` | k² | I/m | m² |
//! | `effective_mass_ratio` | γ | k²/(k² + h²) | – |
//!
//! `examples/damage.rs` goes from depths to energy and ΔV, `examples/barrier_test.rs` from a test to a
//! stiffness.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `std`, on by default | nothing. Without it the crate is `no_std` and needs `alloc`; results have the same bits |
//! | `serde` | serialisation of inputs and results, not of errors and [`StruckVehicle`]. Reading calls the constructors, so that impossible values are refused |
//!
//! # What it does not do
//!
//! It does not find the direction of force: the PDOF is an input (`pim-core` computes it from impulse and
//! momentum). It uses SI units only; the module with CRASH3's tables converts them. Inputs have to be finite,
//! but are not limited to what vehicles have: those beyond 1e±50 may have results that are infinite or NaN.
//!
//! # References
//!
//! R. M. Brach and R. M. Brach, *Crush Energy and Planar Impact Mechanics for Accident Reconstruction*, SAE
//! 980025 (1998), called *the paper*.

#![cfg_attr(not(feature = "std"), no_std)]
#![warn(clippy::std_instead_of_core)]

extern crate alloc;

mod barrier_test;
#[cfg(feature = "serde")]
mod data;
mod delta_v;
mod direction;
mod energy;
mod error;
mod force_balance;
mod profile;
mod stiffness;
mod tables;

pub use barrier_test::BarrierTest;
pub use delta_v::{EnergyBasis, StruckVehicle, delta_v, energy_equivalent_speed, energy_of_equivalent_speed};
pub use direction::{DamagedFace, EnergyMoments, Side, moment_arm, opposite_pdof};
pub use energy::{
    ObliqueCorrection, ObliqueFactor, Yielding, crush_energy, peak_force, zone_energy, zone_force,
};
pub use error::CrushError;
pub use force_balance::{CrushRange, UniformCrush, crush_from_force, crush_range_from_force};
pub use profile::{Profile, ProfileSums, Zone, equal_spacing};
pub use real::{Real, principal_angle};
pub use stiffness::{Saturation, SideStiffness, Stiffness};
pub use tables::{BURG, BURG_SPREAD, CLASS_SPREAD, FLEET, FleetStiffness, VehicleClass, yaw_inertia_burg};
