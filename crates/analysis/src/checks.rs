//! Checks whether the input is consistent with the results. Each check reports its comparison, passed or not.

use std::f64::consts::PI;

use crash3::principal_angle;
use inputs::Basis;
use pim_core::{Real, VehicleId};
use real::elementary;
use reconcile::{Implied, Momentum};

use crate::check::{Check, CheckedQuantity};
use crate::exchange::Exchange;
use crate::impact::Impact;
use crate::speeds::{BothFound, BothMethod, Spread};
use crate::thresholds::{
    DIRECTION_AFTER_ERROR, ENERGY_DIFFERENCE, FAST_CLOSING, FORCE_RATIO, HIGH_RESTITUTION, PDOF_DIFFERENCE,
    POINT_MISSED, REST_MISSED, RESTITUTION_DIFFERENCE, SPEED_AFTER_ERROR, SURE,
};
use crate::travel::Travel;
use crate::vehicle::Vehicle;

/// (m/s, rad/s) velocities and yaw rates that differ from those of one body by less than this count as such.
const AS_ONE: f64 = 0.1;

/// The implications of both speeds and of the velocities after the impact, compared with all other evidence,
/// each within the limits that its `spread` explains. The crush energy (J) is the part that the impact
/// dissipates on its basis.
pub(crate) fn implied(
    momentum: &Momentum,
    implied: &Implied,
    given: f64,
    crush_energy: Option<(f64, Basis)>,
    spread: &Spread,
    locked_together: bool,
) -> Vec<Check> {
    let mut checks = Vec::new();
    if let Some((crush_energy, basis)) = crush_energy.filter(|(energy, _)| *energy > 0.0) {
        let normal_work = basis.taken_by_crush(implied.normal_work, implied.tangential_work);
        // |W_n + λ W_t − E|/E
        let value = (normal_work - crush_energy).abs() / crush_energy;
        // |ln (W/E)| ≤ 2.58 σ, in W/E − 1
        let most = SURE * spread.energy_ln;
        let is_more = normal_work > crush_energy;
        let limit = (elementary::exp(if is_more { most } else { 0.0 - most }) - 1.0).abs();
        let tangential_share = basis.tangential_share();
        let quantity = CheckedQuantity::MomentumEnergy { normal_work, crush_energy, tangential_share };
        checks.push(Check { quantity, value, limit });
    }
    if let Some(e) = implied.restitution {
        let quantity = CheckedQuantity::MomentumRestitution { implied: e, given };
        checks.push(Check { quantity, value: (e - given).abs(), limit: SURE * spread.restitution });
    }
    if let (Some(mu), Some(critical)) = (implied.impulse_ratio, implied.critical_impulse_ratio) {
        // How far beyond μ_c, or on the other side of 0.
        let along = mu * critical.signum();
        let value = (along - critical.abs()).max(-along).max(0.0);
        let quantity = CheckedQuantity::MomentumRatio { implied: mu, critical };
        checks.push(Check { quantity, value, limit: SURE * spread.impulse_ratio });
    }
    // Vehicles that leave as one body hold each other: an impulse at one point does not give their turn.
    let is_one_body = locked_together || momentum.is_of_one_body(AS_ONE);
    for (i, vehicle) in VehicleId::ALL.into_iter().enumerate() {
        if let Some(told) = momentum.after[i].yaw_rate.filter(|_| !is_one_body) {
            let computed = implied.yaw_rates[i];
            let quantity = CheckedQuantity::MomentumYawRate { vehicle, implied: computed, told };
            let limit = SURE * spread.yaw_rates[i];
            checks.push(Check { quantity, value: (computed - told).abs(), limit });
        }
    }
    checks
}

/// How far a restitution lies outside 0 to 1.
fn possible(e: f64) -> Check {
    let value = (e - 1.0).max(-e).max(0.0);
    let quantity = CheckedQuantity::PossibleRestitution { implied: e };
    Check { quantity, value, limit: RESTITUTION_DIFFERENCE }
}

/// The same for the speeds found, and the PDOF that goes with them. Without a `spread`, as for point masses
/// and a fixed object, only the restitution is checked: whether it is possible.
pub(crate) fn of_momentum(
    both: &BothFound,
    impact: Option<&Impact>,
    vehicles: &[Vehicle; 2],
    crush_energy: Option<(f64, Basis)>,
    spread: Option<&Spread>,
) -> Vec<Check> {
    let mut checks = Vec::new();
    if let BothMethod::MomentumAndSpeed { given } = both.method {
        let (momentum, vehicle) = (&both.momentum, given.other());
        let surplus = momentum.surplus_across(vehicle, both.speeds);
        let spread = momentum.spread_across(vehicle, SPEED_AFTER_ERROR, DIRECTION_AFTER_ERROR);
        let quantity = CheckedQuantity::MomentumAcross { vehicle, surplus };
        checks.push(Check { quantity, value: surplus.abs(), limit: 2.0 * spread });
    }
    let [one, two] = both.implied.impulses;
    let (difference, impulse) = ((one - two).norm(), both.implied.impulse_vector.norm());
    // Two speeds across one another balance both components.
    if both.is_by_crush() && impulse > 0.0 {
        let quantity = CheckedQuantity::MomentumBalance { difference, impulse };
        checks.push(Check { quantity, value: difference / impulse, limit: 1.0 });
    }
    let crush_energy = crush_energy.filter(|_| !both.is_by_crush());
    match (spread, impact) {
        (Some(spread), Some(impact)) => {
            let given = impact.law.restitution();
            let (momentum, locked) = (&both.momentum, both.locked_together);
            checks.extend(implied(momentum, &both.implied, given, crush_energy, spread, locked));
        }
        _ if matches!(both.method, BothMethod::Wall { .. }) => {}
        _ => checks.extend(both.implied.restitution.map(possible)),
    }
    for (i, vehicle) in VehicleId::ALL.into_iter().enumerate() {
        if let Some(given) = vehicles[i].given_pdof() {
            let computed = both.implied.pdof[i];
            let quantity = CheckedQuantity::MomentumPdof { vehicle, implied: computed, given };
            let value = principal_angle(computed - given).abs();
            checks.push(Check { quantity, value, limit: vehicles[i].half_hour().max(PDOF_DIFFERENCE) });
        }
    }
    checks
}

/// How near the paths come to the rest positions for which they were found, and how they pass their points.
pub(crate) fn of_travel(travel: &[Option<Travel>; 2]) -> Vec<Check> {
    let mut checks = Vec::new();
    for (vehicle, travel) in VehicleId::ALL.into_iter().zip(travel) {
        let Some(travel) = travel else { continue };
        if travel.origin.is_by_rest()
            && let Some((miss, _)) = travel.miss()
            && travel.rest.distance > 0.0
        {
            let quantity = CheckedQuantity::RestMissed { vehicle, miss };
            checks.push(Check { quantity, value: miss / travel.rest.distance, limit: REST_MISSED });
        }
        for (i, (pass, value)) in travel.passes.iter().zip(travel.shares_missed()).enumerate() {
            // A vehicle that does not move has no path length to divide by.
            if value.is_finite() {
                let quantity = CheckedQuantity::PointMissed { vehicle, point: i + 1, pass: *pass };
                checks.push(Check { quantity, value, limit: POINT_MISSED });
            }
        }
    }
    checks
}

/// All checks for which there are values: headings (rad) and the part of the crush energy (J) that the impact
/// dissipates on its basis, as far as they are known, with the impact by the law and the effect of the
/// impact, which by momentum is another.
pub(crate) fn checks(
    vehicles: &[Vehicle; 2],
    headings: [Option<f64>; 2],
    crush_energy: Option<(f64, Basis)>,
    impact: Option<&Impact>,
    exchange: Option<&Exchange>,
) -> Vec<Check> {
    let mut checks = Vec::new();
    let damage = vehicles.each_ref().map(|vehicle| vehicle.damage.as_ref());
    let inferred = damage.iter().flatten().any(|damage| damage.inferred.is_some());
    if let [Some(f1), Some(f2)] = damage.map(|d| d.and_then(|d| d.oblique).map(|oblique| oblique.peak_force))
        && !inferred
        // Without a force on one side there is no ratio, which a warning reports.
        && f1.min(f2) > 0.0
    {
        // max F/min F
        let value = f1.max(f2) / f1.min(f2);
        checks.push(Check { quantity: CheckedQuantity::ForceBalance, value, limit: FORCE_RATIO });
    }
    let given = vehicles.each_ref().map(Vehicle::given_pdof);
    if let ([Some(p1), Some(p2)], [Some(h1), Some(h2)]) = (given, headings) {
        // The force comes from the scene angle θ − PDOF.
        let value = principal_angle((h1 - p1) - (h2 - p2) + PI).abs();
        // Two hours of the clock may each be off by half an hour.
        let half_hours: f64 = vehicles.iter().map(Vehicle::half_hour).sum();
        let limit = if half_hours > 0.0 { half_hours } else { PDOF_DIFFERENCE };
        checks.push(Check { quantity: CheckedQuantity::PdofsOpposite, value, limit });
    }
    if let (Some(impact), Some((crush_energy, basis))) = (impact, crush_energy) {
        let energy = &impact.outcome.energy;
        let normal_work = basis.taken_by_crush(energy.normal_work, energy.tangential_work);
        // |W_n + λ W_t − E|/E
        let value = (normal_work - crush_energy).abs() / crush_energy;
        if value.is_finite() {
            let quantity = CheckedQuantity::DamageEnergy { normal_work, crush_energy };
            checks.push(Check { quantity, value, limit: ENERGY_DIFFERENCE });
        }
    }
    if let (Some(impact), Some(exchange)) = (impact, exchange) {
        if -impact.outcome.approach.normal > FAST_CLOSING {
            let value = impact.law.restitution();
            checks.push(Check { quantity: CheckedQuantity::Restitution, value, limit: HIGH_RESTITUTION });
        }
        for id in VehicleId::ALL {
            let has_moment = impact.law.has_moment();
            if let Some(value) = moment_with_rotation(exchange, has_moment, &vehicles[id.index()], id) {
                let quantity = CheckedQuantity::Rotation { vehicle: id };
                checks.push(Check { quantity, value, limit: 0.0 });
            }
        }
    }
    checks
}

/// (N·m·s) `None` if the vehicle does not turn, has no line of action, or has to turn with it in any case.
fn moment_with_rotation(
    exchange: &Exchange,
    has_moment: bool,
    vehicle: &Vehicle,
    id: VehicleId,
) -> Option<f64> {
    let subject = &vehicle.subject;
    subject.inertia?;
    if subject.force.pdof.is_none() && !has_moment {
        return None;
    }
    let centroid = vehicle.damage.as_ref().and_then(|damage| damage.centroid);
    let [forward, left] = subject.contact.or(centroid)?;
    let p = exchange.impulse_vector;
    let size = (p.x * p.x + p.y * p.y).sqrt();
    let turned = exchange.turned(id)?;
    if turned == 0.0 {
        return None;
    }
    let sense = turned.signum();
    // For an hour of the clock, the direction within it that turns the vehicle most in that sense.
    let (given, half_hour) = (vehicle.crash3_pdof()?, vehicle.half_hour());
    let best = Real::atan2(sense * forward, sense * left);
    let pdof = given + principal_angle(best - given).clamp(-half_hour, half_hour);
    let (sin, cos) = Real::sin_cos(pdof);
    // r × P with the push P = |P| (−cos PDOF, sin PDOF) in (forward, left)
    let moment = size * (forward * sin + left * cos);
    Some(sense * moment)
}
