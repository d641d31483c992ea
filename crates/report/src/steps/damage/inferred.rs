//! A crush that follows from the force on the other vehicle.

use analysis::{Damage, Inferred};
use crash3::Stiffness;
use pim_core::VehicleId;

use super::super::{Step, angle, n, p, step};
use crate::units::Measure;

pub(super) fn steps(damage: &Damage, inferred: &Inferred, stiffness: &Stiffness, i: VehicleId) -> Vec<Step> {
    let (force, width) = (inferred.force, inferred.crush.width);
    let mut steps = vec![
        step(format!("peak force of vehicle {i}"), format!("F_{i}"))
            .is(force, "N", "theory 5")
            .of(Measure::Force),
        step(format!("width of the damage of vehicle {i}"), format!("w_{i}"))
            .is(width, "m", "theory 5")
            .of(Measure::Crush),
    ];
    if inferred.crush.depth > 0.0 {
        steps.extend(crushed(damage, inferred, stiffness, i));
    } else {
        steps.push(elastic(damage, inferred, stiffness, i));
    }
    steps
}

/// Depth and energy of the crush.
fn crushed(damage: &Damage, inferred: &Inferred, stiffness: &Stiffness, i: VehicleId) -> [Step; 2] {
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let (width, depth) = (inferred.crush.width, inferred.crush.depth);
    let crush = step(format!("inferred crush of vehicle {i}"), format!("C_{i}"))
        .equals(
            format!("(F_{i} cos α_{i}/w_{i} − A_{i})/B_{i}"),
            format!(
                "({} · cos{} / {} − {}) / {}",
                n(inferred.force, "N"),
                // A force balance needs α, so there is one.
                angle(damage.oblique_angle.unwrap_or_default()),
                n(width, "m"),
                n(a, "N/m"),
                n(b, "N/m²")
            ),
        )
        .is(depth, "m", "theory 5");
    let (name, symbol) = (format!("crush energy of vehicle {i}"), format!("E_{i}"));
    // At its limit the force per width no longer determines the depth.
    let limited = stiffness.saturation_force().is_some_and(|limit| a + b * depth > limit * (1.0 + 1e-9));
    let energy = if limited {
        step(name, symbol).is(damage.crush_energy, "J", "theory 5")
    } else {
        step(name, symbol)
            .equals(
                format!("w_{i} (A_{i} C_{i} + B_{i} C_{i}²/2 + G_{i})"),
                format!(
                    "{} · ({} · {} + {} · {}² / 2 + {})",
                    n(width, "m"),
                    n(a, "N/m"),
                    n(depth, "m"),
                    n(b, "N/m²"),
                    p(depth, "m"),
                    n(g, "N")
                ),
            )
            .is(damage.crush_energy, "J", "Eq 5")
    };
    [crush.of(Measure::Crush), energy]
}

/// The energy of a force that leaves no residual crush.
fn elastic(damage: &Damage, inferred: &Inferred, stiffness: &Stiffness, i: VehicleId) -> Step {
    let width = n(inferred.crush.width, "m");
    step(format!("elastic energy of vehicle {i}"), format!("E_{i}"))
        .equals(
            format!("w_{i} G_{i} (F_{i} cos α_{i}/(A_{i} w_{i}))²"),
            format!(
                "{width} · {} · ({} · cos{} / ({} · {width}))²",
                n(stiffness.g(), "N"),
                n(inferred.force, "N"),
                // A force balance needs α, so there is one.
                angle(damage.oblique_angle.unwrap_or_default()),
                n(stiffness.a(), "N/m")
            ),
        )
        .is(damage.crush_energy, "J", "theory 5")
}
