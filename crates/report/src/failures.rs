//! The sentence of each case without an answer.

use ::estimate::NoDraws;
use analysis::{FASTEST_BACK, Failure, Impossible};
use crash3::CrushError;
use evidence::Piece;
use pim_core::{ImpactError, VehicleId};
use reconcile::{COLLINEAR, FASTEST, MomentumError, ReconcileError};
use trajectory::{NoRest, State, Unreached};

use crate::basis;
use crate::units::{Measure, Units, number};

/// Why there is no analysis, and what to check, in the units of the reader. The numbers are in the axes of
/// the case, as [`reconstruct`](analysis::reconstruct) and the others leave them.
#[must_use]
pub fn no_answer(failure: &Failure, units: Units) -> String {
    match failure {
        Failure::Case(_) | Failure::Ranges(_) => failure.to_string(),
        Failure::Excluded(impossible) => excluded(impossible),
        Failure::Estimate(refusal) => of_estimate(refusal),
        Failure::Unjudged { key } => format!(
            "no likelihood of `{key}` can be computed for the collisions that the case allows: write its value \
             with a range, such as {{ value = …, sd = … }}, or leave it out"
        ),
        Failure::Impact(refusal) => of_impact(refusal, units),
        Failure::Crush(refusal) => of_crush(refusal, units),
        Failure::Reconcile(refusal) => of_reconciliation(refusal, units),
        Failure::Momentum(refusal) => of_momentum(refusal, units),
        Failure::NoRest { vehicle, reason } => no_rest(*vehicle, reason, units),
        Failure::NoStart { vehicle, reason } => no_start(*vehicle, reason, units),
        Failure::NotReached { vehicle, energy, tangential_share, nearest: Ok(nearest) }
            if nearest.speed.abs() > FASTEST =>
        {
            format!(
                "no speed of vehicle {vehicle} up to {} makes {} equal to {}; \
                 it would take {}, which gives {}; either the heading lies nearly along the crush plane, or \
                 the crush energy is far too large; check `crush_plane`, the angle of the normal, the \
                 headings, and the units of depths, widths and stiffness",
                fastest(units),
                basis::work_of_share(*tangential_share),
                units.format(Measure::Energy, *energy),
                units.speed(nearest.speed),
                units.format(Measure::Energy, nearest.normal_work)
            )
        }
        Failure::NotReached { vehicle, energy, tangential_share, nearest: Ok(nearest) } => {
            let nearest = format!(
                "; the closest is {}, at {}",
                units.format(Measure::Energy, nearest.normal_work),
                units.speed(nearest.speed)
            );
            not_reached(*vehicle, [*energy, *tangential_share], &nearest, units)
        }
        Failure::NotReached { vehicle, nearest: Err(reason), .. } => {
            format!("no speed of vehicle {vehicle} makes a collision: {}", of_impact(reason, units))
        }
    }
}

/// The evidence that excludes every collision, and what to change.
fn excluded(impossible: &Impossible) -> String {
    let limits = |piece: &Piece| matches!(piece, Piece::Limits(_));
    let what = match impossible.culprits.as_slice() {
        [one] if limits(one) => {
            "either no collision with such a speed brings the vehicles together: check its limits, and the \
             headings, contact points and crush plane of both; or the limits are so close together that no \
             speed tried lies between them: if the speed is known that well, write it as `speed`, with a range"
        }
        [_] => "check its value and unit, and give it a larger error",
        [one, other] if limits(one) && limits(other) => {
            "widen one of the two, and check the headings, contact points and crush plane"
        }
        [_, _] => "check both, and give the one that is less certain a larger error or leave it out",
        _ if impossible.together => "check the units and signs of each, and give larger errors",
        _ if impossible.exclusion.possible > 0 => {
            "widen the limits that are stated as certain, and check the headings, contact points and crush plane"
        }
        _ => &format!(
            "check the headings, the contact points and the crush plane, which is the angle of its normal; a \
             vehicle that backed into the other has a speed below zero, which the case must allow: \
             certain_speed = {{ at_least = \"{:.0} km/h\", at_most = \"0 km/h\" }}",
            -3.6 * FASTEST_BACK
        ),
    };
    format!("{impossible}; {what}")
}

fn of_estimate(refusal: &NoDraws) -> String {
    match refusal {
        NoDraws::NothingUnknown => {
            "nothing is unknown, so there is nothing to estimate: both speeds are given without a range; leave a \
             speed out, or give it a range"
                .to_owned()
        }
        NoDraws::Ended { .. } => "the run was ended before it had an answer".to_owned(),
        NoDraws::NotALikelihood { .. } | NoDraws::NotFinite { .. } => {
            "a number of the case makes a collision that cannot be computed; check the units, and make the \
             widest ranges narrower"
                .to_owned()
        }
        // Faulty settings.
        _ => refusal.to_string(),
    }
}

fn of_reconciliation(refusal: &ReconcileError, units: Units) -> String {
    match refusal {
        ReconcileError::Impact(reason) => of_impact(reason, units),
        ReconcileError::NotReached { vehicle, energy, tangential_share } => {
            not_reached(*vehicle, [*energy, *tangential_share], "", units)
        }
        ReconcileError::NoCrushEnergy { energy } => format!(
            "the crush energy is {}, but must be greater than zero, because without crush no speed follows \
             from the impact; check the depths and the stiffness of both vehicles. If neither was damaged, \
             momentum gives the speed: describe in [vehicle1.after] and [vehicle2.after] how they left the impact",
            units.format(Measure::Energy, *energy)
        ),
        ReconcileError::Inadmissible { vehicle, speed: si, reason } => format!(
            "at {} vehicle {vehicle} would match the crush energy, but {}",
            units.speed(*si),
            of_impact(reason, units)
        ),
        ReconcileError::SpeedWithoutEffect { vehicle, .. } => format!(
            "vehicle {vehicle} heads along the crush plane, at right angles to its normal, so its speed \
             does not change the normal work; `crush_plane` is the angle of the normal, not of the plane, \
             so check whether it is 90° off, check the heading, find the other vehicle's speed instead, or \
             estimate both from all the evidence"
        ),
        ReconcileError::NotConverged { last, residual } => format!(
            "the search for the speed did not converge: {} still misses the crush energy by {}; check the \
             input for extreme values, or try another \
             tangential condition",
            units.speed(*last),
            units.format(Measure::Energy, *residual)
        ),
        // No quantity to convert.
        _ => refusal.to_string(),
    }
}

fn not_reached(vehicle: VehicleId, [energy, share]: [f64; 2], nearest: &str, units: Units) -> String {
    format!(
        "no speed of vehicle {vehicle} up to {} makes {} equal to {} while the vehicles approach and push{nearest}; \
         check the contact points, the crush plane, the headings, the yaw rates, the restitution and the crush energy",
        fastest(units),
        basis::work_of_share(share),
        units.format(Measure::Energy, energy)
    )
}

/// The limit is a judgement, so it has no decimals.
fn fastest(units: Units) -> String {
    format!("{} {}", number(units.value(Measure::Speed, FASTEST), 0), units.name(Measure::Speed))
}

fn of_momentum(refusal: &MomentumError, units: Units) -> String {
    let speeds =
        |[v1, v2]: [f64; 2]| format!("{} of vehicle 1 and {} of vehicle 2", units.speed(v1), units.speed(v2));
    match refusal {
        MomentumError::NoCrushEnergy { energy } => format!(
            "the crush energy is {}, but must be greater than zero, because momentum alone does not give both \
             speeds if the headings lie within {}° of one line; give the damage of the vehicles, or, if one \
             was stationary or its speed is known, that speed, and find = \"vehicle1.speed\" or \"vehicle2.speed\"",
            units.format(Measure::Energy, *energy),
            number(COLLINEAR.to_degrees(), 0)
        ),
        MomentumError::NotReached { energy, tangential_share } => format!(
            "no speeds with the momentum after the impact make {} equal to {} while \
             the vehicles approach and push; check the rest positions, the drag, the crush energy, the crush \
             plane and the restitution",
            basis::work_of_share(*tangential_share),
            units.format(Measure::Energy, *energy)
        ),
        MomentumError::Inadmissible { speeds: found, reason } => format!(
            "{} would match both the momentum and the crush energy, but {}",
            speeds(*found),
            of_impact(reason, units)
        ),
        MomentumError::NotConverged { speeds: found, residual } => format!(
            "the search for the speeds did not converge: {} still miss the crush energy by {}; check the input \
             for extreme values",
            speeds(*found),
            units.format(Measure::Energy, *residual)
        ),
        MomentumError::TooFast { vehicle, speed } => format!(
            "momentum gives vehicle {vehicle} a speed of {}, but no vehicle is faster than {}; check the masses and the \
             motion after the impact, and their units",
            units.speed(*speed),
            fastest(units)
        ),
        MomentumError::LeavesWall { vehicle, speed } => format!(
            "to leave the fixed object like this, vehicle {vehicle} would have approached at {} along its \
             heading, but its heading does not point into the object; check the direction after the impact, \
             the heading and the crush plane",
            units.speed(*speed)
        ),
        MomentumError::Impact(reason) => of_impact(reason, units),
        // No quantity to convert.
        _ => refusal.to_string(),
    }
}

fn no_rest(vehicle: VehicleId, reason: &NoRest, units: Units) -> String {
    let speed = |state: &State| units.speed(state.motion.velocity.norm());
    let time = |si: f64| units.format(Measure::Time, si);
    match reason {
        NoRest::StillMoving { time: after, state } => format!(
            "vehicle {vehicle} does not come to rest: after {} it still moves at {}; check the drag of its \
             wheels, the friction and the grade",
            time(*after),
            speed(state)
        ),
        NoRest::TooManySteps { time: after, state, .. } => format!(
            "the path of vehicle {vehicle} to rest takes too many steps: at {} it still moves at {}; check the \
             drag of its wheels, the friction, the zones of the ground and the steer angle",
            time(*after),
            speed(state)
        ),
        // No quantity that has other units.
        _ => format!("vehicle {vehicle} does not come to rest: {reason}"),
    }
}

fn no_start(vehicle: VehicleId, reason: &Unreached, units: Units) -> String {
    match reason {
        Unreached::NoWay => format!(
            "vehicle {vehicle} rests where the impact was, so there is no motion after the impact to find; check \
             `rest` and `contact` of [scene], or give its speed after the impact as 0"
        ),
        Unreached::Missed { motion, miss, .. } => format!(
            "no motion after the impact brings vehicle {vehicle} to its rest: the nearest, {} and {}, comes to \
             rest {} from it; check the rest, the place of the impact, the drag of the wheels and the friction",
            units.speed(motion.velocity.norm()),
            units.yaw_rate(motion.yaw_rate),
            units.format(Measure::Length, *miss)
        ),
        Unreached::NeverRests(reason) => no_rest(vehicle, reason, units),
        // No quantity to convert.
        _ => format!("no motion after the impact brings vehicle {vehicle} to its rest: {reason}"),
    }
}

fn of_impact(refusal: &ImpactError, units: Units) -> String {
    match refusal {
        ImpactError::NotApproaching { u_n } => format!(
            "the vehicles do not approach each other at the contact point: the normal relative velocity u_n \
             is {}, but must be negative; check the headings, the speeds and the crush plane",
            units.format(Measure::Speed, *u_n)
        ),
        ImpactError::Jam { impulse_ratio, k_nn, k_nt } => format!(
            "the contact jams: with the impulse ratio μ = {impulse_ratio} the impulse would have to be \
             infinite or negative, because k_nn + μ k_nt is not positive; this geometry needs μ {} {}: \
             check its sign and decimal point and the contact points, or give a friction limit instead; the \
             friction law cannot jam",
            if *k_nt > 0.0 { "above" } else { "below" },
            number(-k_nn / k_nt, 4)
        ),
        ImpactError::Pulling { normal_impulse } => format!(
            "the tangential condition would require the vehicles to pull on each other (P_n = {}), because \
             they slide too fast for this geometry; check the contact points and the crush plane or, if the \
             surfaces did slide until they separated, give a friction limit or an impulse ratio instead",
            units.format(Measure::Impulse, *normal_impulse)
        ),
        ImpactError::EnergyCreated { loss, normal_work, tangential_work, moment_work } => {
            let energy = |si: f64| units.format(Measure::Energy, si);
            let of_moment = match *moment_work {
                0.0 => String::new(),
                work => format!(" and {} that of the moment impulse", energy(work)),
            };
            format!(
                "the coefficients create energy: the energy loss would be {} ({} is the work of the normal \
                 impulse, {} that of the tangential impulse{of_moment}); check that the impulse ratio has the \
                 sign that opposes the sliding, and lower its size or the restitution",
                energy(*loss),
                energy(*normal_work),
                energy(*tangential_work)
            )
        }
        // No quantity to convert.
        _ => refusal.to_string(),
    }
}

fn of_crush(refusal: &CrushError, units: Units) -> String {
    match refusal {
        CrushError::ForceAboveLimit { force_per_width, limit } => format!(
            "the force of the other vehicle requires {} of width, more than the limit of {}, so the crush \
             cannot be inferred; check the limit, the stiffness and the other vehicle's crush",
            units.format(Measure::StiffnessA, *force_per_width),
            units.format(Measure::StiffnessA, *limit)
        ),
        CrushError::ForceTooGreat { force, most } => format!(
            "the force of the other vehicle is {}, but the damaged side can bear no more than {}, even if \
             it is crushed over its whole length and as deep as the centre of gravity; check the stiffness \
             of both vehicles and the other vehicle's crush",
            units.format(Measure::Force, *force),
            units.format(Measure::Force, *most)
        ),
        // No quantity, or one that the reader of the file has already refused.
        _ => refusal.to_string(),
    }
}
