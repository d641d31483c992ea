//! Derivatives of the equations, with [`Duals`] in place of `f64`.

use crash3::{EnergyBasis, Profile, Stiffness, StruckVehicle, crush_energy, delta_v};
use pim_core::VehicleId;
use pim_core::{Body, Contact, Law, Motion, Participant, Real, Tangential};
use real::Duals;

use crate::reconciliation::posed;

/// The inputs of the derivatives: restitution, mass of vehicle 1, crush plane, heading of vehicle 2,
/// stiffness B.
const INPUTS: [f64; 5] = [0.3, 1676.5, -0.4014, 1.1694, 633e3];

/// All results of the chain from damage to motion, at the inputs of [`INPUTS`].
fn chain<T: Real>(
    [restitution, mass, crush_plane, heading, b]: [T; 5],
    tangential: Tangential<T>,
    basis: EnergyBasis,
) -> Vec<T> {
    let t = |x: f64| T::from(x);
    let profile =
        Profile::equally_spaced([0.54, 0.5, 0.35, 0.3, 0.13, 0.12].map(t).to_vec(), t(1.65)).unwrap();
    let stiffness = Stiffness::from_ab(t(58_740.0), b).unwrap();
    let energy = crush_energy(&profile, &stiffness) + 38_657.0;
    let one = Participant::polar(Body::new(mass, t(3304.1)).unwrap(), t(3.1), t(1.92), t(-0.391)).unwrap();
    let two =
        Participant::polar(Body::new(t(1548.1), t(2935.3)).unwrap(), heading, t(1.158), t(-0.68)).unwrap();
    let contact = Contact::new([one, two], crush_plane).unwrap();
    let law = Law::new(restitution, tangential).unwrap();
    let motions = [Motion::rest().with_yaw_rate(t(0.1)), Motion::along(heading, t(4.47))];
    let problem = posed(contact, law, motions, VehicleId::One, energy, basis).unwrap();
    let answer = problem.closed_form().unwrap().unwrap();
    let outcome = answer.outcome;
    let [v1, v2] = outcome.delta_v_magnitude();
    let inertia = [
        StruckVehicle::new(mass, t(3304.1), t(0.646)).unwrap(),
        StruckVehicle::new(t(1548.1), t(2935.3), t(0.592)).unwrap(),
    ];
    let [crash1, _] = delta_v(energy, inertia).unwrap();
    let factor = basis.restitution_factor(restitution).unwrap();
    vec![
        answer.speed,
        v1,
        v2,
        outcome.energy.loss,
        outcome.after[0].yaw_rate,
        outcome.after[1].velocity.y,
        outcome.pdof()[0],
        crash1 * factor,
    ]
}

#[test]
fn derivatives_are_differences_in_the_limit() {
    for (mu, basis) in
        [(None, EnergyBasis::Dissipated), (None, EnergyBasis::Absorbed), (Some(0.3), EnergyBasis::Dissipated)]
    {
        let law = mu.map_or(Tangential::Critical, Tangential::Ratio);
        let dual_law = mu.map_or(Tangential::Critical, |mu| Tangential::Ratio(Duals::from(mu)));
        let values = chain(INPUTS, law, basis);
        let scales = values.iter().map(|value| value.abs());
        let scales: Vec<f64> = scales.collect();
        for input in 0..INPUTS.len() {
            let mut duals = INPUTS.map(Duals::<1>::from);
            duals[input].derivatives = [1.0];
            let duals = chain(duals, dual_law, basis);

            let step = INPUTS[input] * 1e-4;
            let shifted = |steps: f64| {
                let mut inputs = INPUTS;
                inputs[input] += steps * step;
                chain(inputs, law, basis)
            };
            // Central differences at one and two steps, combined so that their error is of fourth order.
            let [low2, low, high, high2] = [-2.0, -1.0, 1.0, 2.0].map(shifted);
            for i in 0..values.len() {
                assert_eq!(duals[i].value.to_bits(), values[i].to_bits(), "value {i}");
                let difference = (8.0 * (high[i] - low[i]) - (high2[i] - low2[i])) / (12.0 * step);
                // A change of the input by its own size changes the output by this much: the scale of a
                // derivative near zero.
                let scale = scales[i] / INPUTS[input].abs();
                let [derivative] = duals[i].derivatives;
                let error = (derivative - difference).abs();
                assert!(
                    error <= 1e-6 * difference.abs().max(1e-3 * scale),
                    "output {i} by input {input}: {derivative} is not {difference}"
                );
            }
        }
    }
}
