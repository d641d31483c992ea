//! The energy balance in words, for the text and for the page.

use analysis::{Seen, Warning};
use pim_core::Energy;

use crate::units::{Measure, Units, number};

/// A share of the initial energy.
pub(crate) fn share(work: f64, energy: &Energy) -> String {
    format!("{} %", number(100.0 * work / energy.before, 1))
}

/// Notes for a reader who adds up the printed figures.
pub(crate) fn notes(analysis: &Seen, units: Units) -> Vec<String> {
    let Some(exchange) = analysis.exchange() else { return Vec::new() };
    let energy = &exchange.energy;
    let mut notes = Vec::new();
    let printed = |si: f64| units.format(Measure::Energy, si);
    // A zero after rounding counts as no work.
    if printed(energy.tangential_work).starts_with('-') {
        let is_warned =
            analysis.warnings.iter().any(|seen| matches!(seen.warning(), Warning::SlidingDriven { .. }));
        let size = if analysis.both.is_some() {
            "Friction cannot do that: the velocities after the impact, from which the impulse follows, are in error by at \
             least as much, or the contact point or the crush plane is. `deltav estimate` weighs their errors."
        } else if is_warned {
            "Friction alone cannot do that: see the warning sliding-driven."
        } else {
            "Coefficients that were fitted to staged collisions can add as much (deltav explain sliding-driven)."
        };
        notes.push(format!(
            "W_t is negative: the tangential impulse acts along the mean sliding velocity instead of \
             against it, and adds {} to the motion, {} % of E_L. {size}",
            printed(-energy.tangential_work),
            number(-100.0 * energy.tangential_work / energy.loss, 1)
        ));
    }
    if let Some(restitution) = exchange.restitution.filter(|restitution| *restitution < 0.0)
        && analysis.both.is_some()
    {
        let or =
            if exchange.at_contact.is_some() { ", or the contact point or the crush plane is" } else { "" };
        notes.push(format!(
            "e is {}: by these velocities the vehicles still approach each other when the impact ends, which no impact law \
             allows. The velocities are in error{or}.",
            number(restitution, 2)
        ));
    }
    if !adds_up(energy, |work| units.value(Measure::Energy, work).round_ties_even())
        || !adds_up(energy, |work| (1000.0 * work / energy.before).round_ties_even())
    {
        notes.push(
            "Each figure is rounded separately, so a sum of printed figures may be off by one in the last \
             digit."
                .to_owned(),
        );
    }
    notes
}

/// Whether the figures, rounded, are the sums of their rounded parts.
fn adds_up(energy: &Energy, rounded: impl Fn(f64) -> f64) -> bool {
    let parts = [energy.normal_work, energy.tangential_work, energy.moment_work];
    parts.into_iter().map(&rounded).sum::<f64>() == rounded(energy.loss)
        && rounded(energy.loss) + rounded(energy.after) == rounded(energy.before)
}
