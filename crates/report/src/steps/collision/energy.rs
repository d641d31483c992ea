//! The works of the impact and the energy loss.

use case::Basis;
use pim_core::{Motion, VehicleId};

use super::super::{Step, n, p, step};
use super::Collision;

impl Collision<'_> {
    pub(super) fn energy(&self) -> Vec<Step> {
        let outcome = &self.impact.outcome;
        let energy = outcome.energy;
        let (impulse, u, v) = (outcome.impulse, outcome.approach, outcome.separation);
        let moving: Vec<_> = self.moving().map(|(k, mass, inertia)| (k, mass, Some(inertia))).collect();
        let [before, after] =
            kinetic(&moving, [&outcome.before, &outcome.after], [energy.before, energy.after]);
        let mut steps = vec![
            before,
            after,
            work("normal work", "n", [impulse.normal, u.normal, v.normal], energy.normal_work),
            work(
                "tangential work",
                "t",
                [impulse.tangential, u.tangential, v.tangential],
                energy.tangential_work,
            ),
        ];
        steps.extend(self.taken_by_crush());
        let has_moment = outcome.moment_impulse != 0.0;
        if has_moment {
            steps.push(self.moment_work());
        }
        steps.extend(self.loss(has_moment));
        steps
    }

    /// The part of both works that the crush absorbs, if that was sought.
    fn taken_by_crush(&self) -> Option<Step> {
        let Basis::TangentialShare(share) = self.analysis.basis else { return None };
        let found = self.analysis.found.as_ref()?;
        let energy = self.impact.outcome.energy;
        let numbers =
            format!("{} + {} · {}", n(energy.normal_work, "J"), n(share, ""), p(energy.tangential_work, "J"));
        let crush = step("crush energy, from the works", "E").equals("W_n + λ W_t", numbers);
        Some(crush.is(found.normal_work, "J", "theory 6"))
    }

    fn moment_work(&self) -> Step {
        let outcome = &self.impact.outcome;
        let [before, after] = outcome.relative_yaw_rate();
        step("moment work", "W_m")
            .equals(
                "−½ M (ω_1 − ω_2 + Ω_1 − Ω_2)",
                format!(
                    "(−½) · {} · ({} + {})",
                    n(outcome.moment_impulse, "N·m·s"),
                    n(before, "rad/s"),
                    n(after, "rad/s")
                ),
            )
            .is(outcome.energy.moment_work, "J", "theory 4")
    }

    /// The loss as the sum of the works, as the difference of the kinetic energies, and as a share.
    fn loss(&self, has_moment: bool) -> [Step; 3] {
        let energy = self.impact.outcome.energy;
        let (mut formula, mut numbers) = (
            "W_n + W_t".to_owned(),
            format!("{} + {}", n(energy.normal_work, "J"), n(energy.tangential_work, "J")),
        );
        if has_moment {
            formula.push_str(" + W_m");
            numbers.push_str(&format!(" + {}", n(energy.moment_work, "J")));
        }
        [
            step("energy loss", "E_L").equals(formula, numbers).is(energy.loss, "J", "theory 4"),
            step("the same from the motions", "E_L")
                .equals("T − T'", format!("{} − {}", n(energy.before, "J"), n(energy.after, "J")))
                .is(energy.loss, "J", "theory 4"),
            step("share of the initial energy", "E_L/T")
                .equals("", format!("{} / {}", n(energy.loss, "J"), n(energy.before, "J")))
                .is(100.0 * energy.loss / energy.before, "%", "theory 4"),
        ]
    }
}

/// The kinetic energies before and after the impact, from the mass (kg) and the yaw inertia (kg·m²) of each
/// vehicle that can move; a point mass has no yaw inertia.
pub(in super::super) fn kinetic(
    moving: &[(VehicleId, f64, Option<f64>)],
    [before, after]: [&[Motion; 2]; 2],
    values: [f64; 2],
) -> [Step; 2] {
    let of = |name: &str, symbol: &str, [v, w]: [&str; 2], motions: &[Motion; 2], value: f64| {
        let term = |&(k, mass, yaw_inertia): &(VehicleId, f64, Option<f64>)| {
            let Motion { velocity, yaw_rate, .. } = motions[k.index()];
            let (x, y) = (p(velocity.x, "m/s"), p(velocity.y, "m/s"));
            let mut formula = format!("½ m_{k} ({v}_{k}x² + {v}_{k}y²)");
            let mut numbers = format!("½ · {} · ({x}² + {y}²)", n(mass, "kg"));
            if let Some(inertia) = yaw_inertia {
                formula.push_str(&format!(" + ½ I_{k} {w}_{k}²"));
                numbers.push_str(&format!(" + ½ · {} · {}²", n(inertia, "kg·m²"), p(yaw_rate, "rad/s")));
            }
            (formula, numbers)
        };
        let (formula, numbers): (Vec<String>, Vec<String>) = moving.iter().map(term).unzip();
        step(name, symbol).equals(formula.join(" + "), numbers.join(" + ")).is(value, "J", "theory 4")
    };
    [
        of("kinetic energy before", "T", ["v", "ω"], before, values[0]),
        of("kinetic energy after", "T'", ["V", "Ω"], after, values[1]),
    ]
}

/// The work along n or t of an impulse, from the velocities before and after it.
pub(in super::super) fn work(name: &str, axis: &str, [impulse, before, after]: [f64; 3], value: f64) -> Step {
    step(name, format!("W_{axis}"))
        .equals(
            format!("−½ P_{axis} (u_{axis} + U_{axis})"),
            format!("(−½) · {} · ({} + {})", n(impulse, "N·s"), n(before, "m/s"), n(after, "m/s")),
        )
        .is(value, "J", "Eq 4")
}
