//! The momentum polygon: the momentum of both vehicles before and after the impact.

use ::drawing::{MomentumPicture, SceneArrow};
use analysis::{Analysis, Exchange};
use case::{Axes, Case};
use pim_core::{Participant, Vector2};

use super::{DrawingError, Subject, caveat, scale_unit, title, with_caveat};
use crate::Units;
use crate::units::Measure;

pub(super) fn picture(
    case: &Case,
    analysis: &Analysis,
    units: Units,
) -> Result<MomentumPicture, DrawingError> {
    let no_impact = || DrawingError::NoImpact { subject: Subject::Momentum };
    let exchange = analysis.exchange().ok_or_else(no_impact)?;
    if let Some(obstacle @ DrawingError::FixedObject { .. }) = Subject::Momentum.obstacle(case) {
        return Err(obstacle);
    }
    let masses = masses(analysis).ok_or_else(no_impact)?;
    let Exchange { before, velocities, delta_v, .. } = exchange;
    // p = m v
    let before = [0, 1].map(|i| before[i].velocity * masses[i]);
    let after = [0, 1].map(|i| velocities[i] * masses[i]);
    let (total, left) = (before[0] + before[1], after[0] + after[1]);
    let size = |momentum: Vector2<f64>| units.format(Measure::Momentum, momentum.norm());
    let arrow = |vector: Vector2<f64>, symbol: &str| SceneArrow {
        vector: vector.into(),
        label: format!("{symbol} {}", size(vector)),
    };
    let gap = left - total;
    // A gap due to rounding does not count.
    let is_closed = units.plain(Measure::Momentum, gap.norm()) == units.plain(Measure::Momentum, 0.0);
    let change = delta_v[0] * masses[0];
    let speed = |velocity: Vector2<f64>| units.format(Measure::RoadSpeed, velocity.norm());
    let description = format!(
        "The momenta of both vehicles, tip to tail. Before the impact that of vehicle 1 is {}, that of vehicle \
         2 {}; after it {} and {}. The total is {}. The impact changes that of vehicle 1 by {}, which is its \
         mass times its ΔV of {}, and that of vehicle 2 by as much in the opposite direction, at a ΔV of {}.{}",
        size(before[0]),
        size(before[1]),
        size(after[0]),
        size(after[1]),
        size(total),
        size(change),
        speed(delta_v[0]),
        speed(delta_v[1]),
        if is_closed { String::new() } else { format!(" After the impact {} are left over.", size(gap)) },
    );
    let caveat = caveat(analysis);
    Ok(MomentumPicture {
        title: title(case),
        description: with_caveat(description, &caveat),
        caveat,
        is_z_down: case.axes == Axes::ZDown,
        before: [arrow(before[0], "m₁v₁"), arrow(before[1], "m₂v₂")],
        after: [arrow(after[0], "m₁V₁"), arrow(after[1], "m₂V₂")],
        total: arrow(total, "total"),
        change: arrow(change, "m₁ΔV₁"),
        gap: (!is_closed).then(|| arrow(gap, "left over")),
        momentum: scale_unit(units, Measure::Momentum),
    })
}

/// (kg)
fn masses(analysis: &Analysis) -> Option<[f64; 2]> {
    let of = |participants: &[Participant; 2]| participants.each_ref().map(|one| one.body().mass());
    let both = analysis.both.as_ref().map(|both| of(both.momentum.contact.participants()));
    both.or_else(|| Some(of(analysis.impact.as_ref()?.contact.participants())))
}
