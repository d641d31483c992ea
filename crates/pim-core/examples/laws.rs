//! One geometry under several impact laws: which of the answers depends on the choice?

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use pim_core::{Body, Contact, Law, Motion, Participant, Tangential};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // SAE 980025, appendix.
    let headings = [180_f64.to_radians(), 67_f64.to_radians()];
    let jimmy = Participant::polar(Body::new(1676.5, 3304.1)?, headings[0], 1.920, -22.4_f64.to_radians())?;
    let altima = Participant::polar(Body::new(1548.1, 2935.3)?, headings[1], 1.158, -39_f64.to_radians())?;
    let contact = Contact::new([jimmy, altima], -23_f64.to_radians())?;
    let before = [Motion::along(headings[0], 22.86), Motion::along(headings[1], 4.4704)];

    let laws = [
        ("sliding ends", Law::new(0.3, Tangential::Critical)?),
        ("friction of at most 0.5", Law::new(0.3, Tangential::Friction(0.5))?),
        ("friction of at most 0.2", Law::new(0.3, Tangential::Friction(0.2))?),
        ("no friction", Law::new(0.3, Tangential::Ratio(0.0))?),
    ];
    let mut delta_v = Vec::new();
    for (name, law) in laws {
        let outcome = contact.impact(before, &law)?;
        let [dv1, dv2] = outcome.delta_v_magnitude();
        println!("{name:24} ΔV {dv1:5.2} and {dv2:5.2} m/s, μ {:.3}", outcome.impulse_ratio);
        // Third law: equal and opposite impulses.
        assert!((1676.5 * dv1 - 1548.1 * dv2).abs() < 1e-9);
        delta_v.push(dv1);
    }
    // The paper's μ_c of 0.371 is below the limit of 0.5, which does not bind, and above that of 0.2, which
    // does.
    assert!((delta_v[0] - delta_v[1]).abs() < 1e-9);
    assert!((delta_v[1] - delta_v[2]).abs() > 0.1);
    Ok(())
}
