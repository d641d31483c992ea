//! Reconstructs a two-vehicle collision from its damage.
//!
//! Measured crush gives the energy absorbed in the collision (CRASH3). Planar impact mechanics gives the
//! speed at which the impact absorbs exactly this energy. The method is that of Brach & Brach, SAE 980025
//! (1998); this is the example in its appendix:
//!
//! ```
//! use deltav::prelude::*;
//!
//! let file = CaseFile::parse("sae-980025.toml", deltav::case::EXAMPLE)?; // or the text of a case file of your own
//! let analysis = reconstruct(&file.case)?;
//! let found = analysis.found.as_ref().ok_or("a reconstruction finds a speed")?;
//! assert!((found.speed - 22.9).abs() < 0.05); // the paper: 22.9 m/s
//!
//! // Every figure with its equation:
//! println!("{}", deltav::report::results(&file.case, &analysis, Units::Us).text());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same from numbers, without a case file. All are in SI units and radians; the crush energies are those
//! printed in the paper:
//!
//! ```
//! use deltav::prelude::*;
//!
//! let jimmy = Participant::polar(Body::new(1676.5, 3304.1)?, 180_f64.to_radians(), 1.920, -22.4_f64.to_radians())?;
//! let altima = Participant::polar(Body::new(1548.1, 2935.3)?, 67_f64.to_radians(), 1.158, -39_f64.to_radians())?;
//! let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
//! let motions = [Motion::rest(), Motion::along(67_f64.to_radians(), 4.4704)];
//! let law = Law::new(0.3, Tangential::Critical)?;
//! let crush_energy = 1.02e5 + 3.87e4;
//! let (law, basis) = (law.into(), EnergyBasis::Dissipated);
//! let (unknown, tangential_share) = (VehicleId::One, 0.0);
//! let problem = Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share };
//! let answer = problem.solve()?;
//! assert!((answer.speed - 22.9).abs() < 0.05); // the paper: 22.9 m/s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The crates
//!
//! Each is a module here under its own name, and can also be used alone.
//!
//! | module | what it is |
//! |---|---|
//! | [`pim_core`] | planar impact mechanics: bodies, contact, impact law, outcome; its page has a figure of the frames and signs |
//! | [`crash3`] | CRASH3 damage: profile, stiffness, crush energy, ΔV |
//! | [`trajectory`] | the motion of a vehicle from the impact to rest |
//! | [`time_distance`] | reaction, braking and sight before a collision |
//! | [`recorder`] | event data recorders: table, speed at impact and pulse |
//! | [`reconcile`] | the speed that makes the two agree |
//! | [`uncertainty`] | propagates input ranges to the results of any function |
//! | [`estimate`] | draws from the posterior of prior and evidence, and shows whether they are reliable |
//! | [`evidence`] | the likelihood of both speeds given crush, PDOF, velocities after impact and recorders |
//! | [`inputs`] | the input of an analysis: numbers with units and ranges, and its requirements on them |
//! | [`case`] | the case file: TOML, its reader and writer, diagnostics |
//! | [`analysis`] | from these inputs to a finished analysis, with its warnings |
//! | [`report`] | a finished analysis as text, JSON, HTML, Markdown and drawings |
//! | [`drawing`] | drawings and plots of a collision, as SVG, PNG and PDF |
//! | [`validation`] | staged collisions compared with the published results |
//! | [`field`] | intervals of ΔV, tested against the recorders of real crashes |
//! | [`real`] | the number type of the equations, with derivatives |
//!
//! With the feature `parallel`, [`uncertainty`] and [`estimate`] run on all cores. The results have the same
//! bits with and without it.
//!
//! # What it does not do
//!
//! It adds nothing to these crates. No rollover, no occupant loads.

pub use {
    analysis, case, crash3, drawing, estimate, evidence, field, inputs, pim_core, real, reconcile, recorder,
    report, time_distance, trajectory, uncertainty, validation,
};

/// The items that most reconstructions need: `use deltav::prelude::*;`.
pub mod prelude {
    pub use analysis::{Analysis, Failure, Warning, crush, impact, reconstruct};
    pub use case::{CaseFile, Diagnostics};
    pub use crash3::{EnergyBasis, ObliqueCorrection, Profile, Side, Stiffness, crush_energy};
    pub use inputs::{Case, Faults};
    pub use pim_core::{
        Body, Contact, Law, Motion, Outcome, Participant, RestitutionCurve, Tangential, VaryingLaw, VehicleId,
    };
    pub use reconcile::{Problem, Reconciliation};
    pub use report::Units;
}
