//! The speed at which the impact absorbs the crush energy, on both energy bases.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use pim_core::{Body, Contact, Law, Motion, Participant, Tangential, VehicleId};
use reconcile::{EnergyBasis, Problem};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix: the GMC Jimmy's speed is sought, the Nissan Altima had 10 mph.
    let headings = [180_f64.to_radians(), 67_f64.to_radians()];
    let jimmy = Participant::polar(Body::new(1676.5, 3304.1)?, headings[0], 1.920, -22.4_f64.to_radians())?;
    let altima = Participant::polar(Body::new(1548.1, 2935.3)?, headings[1], 1.158, -39_f64.to_radians())?;
    let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
    let motions = [Motion::rest(), Motion::along(headings[1], 4.4704)];
    let law = Law::new(0.3, Tangential::Critical)?;

    let mut speeds = Vec::new();
    for basis in [EnergyBasis::Dissipated, EnergyBasis::Absorbed] {
        let law = law.into();
        let problem = Problem {
            contact,
            law,
            motions,
            unknown: VehicleId::One,
            crush_energy: 1.41e5,
            basis,
            tangential_share: 0.0,
        };
        let answer = problem.solve()?;
        println!("{basis:?}: {:.2} m/s, of {} admissible", answer.speed, answer.admissible);
        // The impact does the work that was sought.
        assert!((answer.outcome.energy.normal_work - problem.normal_work_sought()).abs() < 1e-6);
        speeds.push(answer.speed);
    }
    // The paper takes the energy as dissipated and prints 22.9 m/s.
    assert!((speeds[0] - 22.9).abs() <= 0.05);
    // Restitution returns e² of the absorbed energy, so a lower speed is enough.
    assert!(speeds[1] < speeds[0]);
    Ok(())
}
