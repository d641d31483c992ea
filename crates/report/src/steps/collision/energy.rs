//! The works of the impact and the energy loss.

use case::Basis;
use pim_core::{Energy, Motion, VehicleId};

use super::super::{Draft, step};
use super::Collision;
use super::motion::yaw_rates;

impl Collision<'_> {
    pub(super) fn energy(&self) -> Vec<Draft> {
        let outcome = &self.impact.outcome;
        let energy = outcome.energy;
        let moving: Vec<VehicleId> = self.moving().collect();
        let mut steps: Vec<Draft> = kinetic(&moving, [&outcome.before, &outcome.after], energy, true).into();
        steps.extend(works(energy));
        // The part of both works that the crush absorbs, if that was sought.
        if let (Basis::TangentialShare(_), Some(found)) = (self.analysis.basis, &self.analysis.found) {
            let name = "crush energy, from the works";
            steps.push(step(name, "E", (found.normal_work, "J"), "theory 6").equals("W_n + λ W_t"));
        }
        let mut works = "W_n + W_t";
        if outcome.moment_impulse != 0.0 {
            works = "W_n + W_t + W_m";
            let moment_work = step("moment work", "W_m", (energy.moment_work, "J"), "theory 4");
            steps.push(
                moment_work
                    .equals("−½ M (ω_1 − ω_2 + Ω_1 − Ω_2)")
                    .with(yaw_rates("ω", &outcome.before))
                    .with(yaw_rates("Ω", &outcome.after)),
            );
        }
        // The loss as the sum of the works, as the difference of the kinetic energies, and as a share.
        let loss = (energy.loss, "J");
        let share = (100.0 * energy.loss / energy.before, "%");
        steps.extend([
            step("energy loss", "E_L", loss, "theory 4").equals(works),
            step("the same from the motions", "E_L", loss, "theory 4").equals("T − T'"),
            step("share of the initial energy", "E_L/T", share, "theory 4").written_out("E_L/T"),
        ]);
        steps
    }
}

/// The kinetic energies before and after the impact; a point mass does not turn.
pub(in super::super) fn kinetic(
    moving: &[VehicleId],
    [before, after]: [&[Motion; 2]; 2],
    energy: Energy,
    has_yaw: bool,
) -> [Draft; 2] {
    let of = |name: &str, symbol: &str, [v, w]: [&str; 2], motions: &[Motion; 2], value: f64| {
        let terms = moving.iter().map(|k| {
            let turning = if has_yaw { format!(" + ½ I_{k} {w}_{k}²") } else { String::new() };
            format!("½ m_{k} ({v}_{k}x² + {v}_{k}y²){turning}")
        });
        let formula = terms.collect::<Vec<_>>().join(" + ");
        step(name, symbol, (value, "J"), "theory 4").equals(formula).with(yaw_rates(w, motions))
    };
    [
        of("kinetic energy before", "T", ["v", "ω"], before, energy.before),
        of("kinetic energy after", "T'", ["V", "Ω"], after, energy.after),
    ]
}

/// The works of the impulse along n and t, from the velocities before and after it.
pub(in super::super) fn works(energy: Energy) -> [Draft; 2] {
    [("normal", "n", energy.normal_work), ("tangential", "t", energy.tangential_work)].map(
        |(name, axis, value)| {
            step(format!("{name} work"), format!("W_{axis}"), (value, "J"), "Eq 4")
                .equals(format!("−½ P_{axis} (u_{axis} + U_{axis})"))
        },
    )
}
