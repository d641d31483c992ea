//! A crush that follows from the force on the other vehicle.

use analysis::{Damage, Inferred};
use crash3::Stiffness;
use pim_core::VehicleId;

use super::super::{Draft, angle, step};
use crate::units::Measure;

pub(super) fn steps(damage: &Damage, inferred: &Inferred, stiffness: &Stiffness, i: VehicleId) -> Vec<Draft> {
    let (force, width, depth) = (inferred.force, inferred.crush.width, inferred.crush.depth);
    let mut steps = vec![
        step(format!("peak force of vehicle {i}"), format!("F_{i}"), (force, "N"), "theory 5")
            .of(Measure::Force),
        step(format!("width of the damage of vehicle {i}"), format!("w_{i}"), (width, "m"), "theory 5")
            .of(Measure::Crush),
    ];
    // A force balance needs α, so there is one.
    let alpha = [(format!("α_{i}"), angle(damage.oblique_angle.unwrap_or_default()))];
    let (energy, symbol) = ((damage.crush_energy, "J"), format!("E_{i}"));
    if depth > 0.0 {
        steps.push(
            step(format!("inferred crush of vehicle {i}"), format!("C_{i}"), (depth, "m"), "theory 5")
                .equals(format!("(F_{i} cos α_{i}/w_{i} − A_{i})/B_{i}"))
                .with(alpha)
                .of(Measure::Crush),
        );
        let name = format!("crush energy of vehicle {i}");
        // At its limit the force per width no longer determines the depth.
        let force = stiffness.a() + stiffness.b() * depth;
        let limited = stiffness.saturation_force().is_some_and(|limit| force > limit * (1.0 + 1e-9));
        steps.push(if limited {
            step(name, symbol, energy, "theory 5")
        } else {
            let formula = format!("w_{i} (A_{i} C_{i} + B_{i} C_{i}²/2 + G_{i})");
            step(name, symbol, energy, "Eq 5").equals(formula)
        });
    } else {
        // The energy of a force that leaves no residual crush.
        let formula = format!("w_{i} G_{i} (F_{i} cos α_{i}/(A_{i} w_{i}))²");
        let name = format!("elastic energy of vehicle {i}");
        steps.push(step(name, symbol, energy, "theory 5").equals(formula).with(alpha));
    }
    steps
}
