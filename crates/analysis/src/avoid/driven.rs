//! How the vehicle moved before the impact, if phases or the table of its recorder show it.

use std::sync::Arc;

use ::uncertainty::random;
use inputs::{BrakingForm, PhaseForm, Quantity, RecordedError, STANDARD_GRAVITY};
use pim_core::InvalidInput;
use recorder::{SampleSpeed, SampledApproach};
use time_distance::{Course, Leg, Phase, Response, approach};

use super::posing::{Since, Unposed};
use crate::phases::starts;

/// (s) the speed at the impact replaces the samples of a recorder so close to it: it was found from them,
/// with all their errors.
pub const GIVES_WAY: f64 = 0.2;

/// (m/s²) a vehicle that slows by more than this brakes; one that slows by less may coast.
pub const BRAKES: f64 = 1.5;

/// A motion up to the impact, whose times and positions count from the reaction demand. The legs before that
/// have negative ones.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Driven(pub(super) Arc<[Leg]>);

/// What a vehicle gains in its reaction by the accelerations that it had.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gain {
    /// (m/s) of speed.
    pub(super) speed: f64,
    /// (m) of distance, against driving on at the speed at the demand.
    pub(super) distance: f64,
}

impl Driven {
    /// The motion, with the distance (m) and the time (s) from the demand to the impact.
    pub(super) fn new(approach: Approach, since: Since) -> Result<(Self, f64, f64), Unposed> {
        let mut legs = approach.legs;
        let Some(first) = legs.first().copied() else { return Err(Unposed::Stands) };
        // What was before the first phase is unknown: the vehicle is taken to have had the speed at its
        // beginning.
        legs.insert(0, Leg { acceleration: 0.0, jerk: 0.0, ..first });
        if let Some(last) = legs.last().copied()
            && last.acceleration < 0.0
        {
            let stops = last.speed / -last.acceleration;
            legs.push(Leg { speed: 0.0, acceleration: 0.0, ..last.after(stops) });
        }
        let course = Course::new(&legs).ok_or(Unposed::Stands)?;
        let (distance, time) = match since {
            Since::Time(time) => (-course.at(-time).position, time),
            Since::Distance(distance) => {
                let beyond = -distance - first.position;
                let time = if beyond >= 0.0 {
                    course.reaches(-distance).ok_or(Unposed::Stands)?
                } else if first.speed > 0.0 {
                    first.time + beyond / first.speed
                } else {
                    return Err(Unposed::SetsOutLater { distance: -first.position });
                };
                (distance, -time)
            }
        };
        let from_demand = |leg: Leg| Leg { time: leg.time + time, position: leg.position + distance, ..leg };
        Ok((Self(legs.into_iter().map(from_demand).collect()), distance, time))
    }

    /// (s) how long after the demand the motion is known; it is steady until then.
    pub(super) fn begins(&self) -> f64 {
        self.0.first().map_or(0.0, |leg| leg.time)
    }

    pub(super) fn at(&self, time: f64) -> Leg {
        Course::new(&self.0).map_or(Leg::at_rest(time, 0.0), |course| course.at(time))
    }

    pub(super) fn reaches(&self, position: f64) -> Option<f64> {
        Course::new(&self.0)?.reaches(position)
    }

    /// (m) where it stops; `None` if it does not.
    pub(super) fn stop(&self) -> Option<f64> {
        self.rest().map(|rest| rest.position)
    }

    /// (s) when it stops; `None` if it does not.
    pub(super) fn stops_after(&self) -> Option<f64> {
        self.rest().map(|rest| rest.time)
    }

    /// The last leg, if the vehicle is then at rest.
    fn rest(&self) -> Option<&Leg> {
        self.0.last().filter(|last| last.speed <= 0.0 && last.acceleration <= 0.0)
    }

    /// (m/s) the greatest speed from the demand to a time (s).
    pub(super) fn greatest(&self, until: f64) -> f64 {
        let begins = self.0.iter().map(|leg| leg.time).filter(|time| (0.0..until).contains(time));
        begins.chain([0.0, until]).map(|time| self.at(time).speed).fold(0.0, f64::max)
    }

    /// (s) when it begins to brake; `None` if it does so before the demand, or not up to a time (s).
    pub(super) fn brakes(&self, until: f64) -> Option<f64> {
        let is_braked = |leg: &&Leg| leg.acceleration < -BRAKES;
        if self.at(0.0).acceleration < -BRAKES {
            return None;
        }
        self.0.iter().filter(is_braked).map(|leg| leg.time).find(|time| (0.0..until).contains(time))
    }

    /// The accelerations from the demand on, each with the time (s) at which it ends.
    fn accelerations(&self) -> impl Iterator<Item = (f64, f64)> {
        let ends = self.0.iter().skip(1).map(|next| next.time).chain([f64::INFINITY]);
        self.0.iter().zip(ends).filter(|(_, end)| *end > 0.0).map(|(leg, end)| (leg.acceleration, end))
    }

    /// The same accelerations from another speed (m/s) at the demand on, and never faster than `greatest`
    /// (m/s).
    pub(super) fn beginning_with(&self, speed: f64, greatest: f64) -> Self {
        let mut stretches = Stretches::new(speed, greatest);
        for (acceleration, end) in self.accelerations() {
            stretches.push(acceleration, end);
        }
        Self(stretches.legs.into())
    }

    /// As it was driven until the reaction (s) ends, but for its braking, from a speed (m/s) at the demand on
    /// and never faster than `greatest` (m/s).
    fn unaware(&self, speed: f64, reaction: f64, greatest: f64) -> Stretches {
        let mut stretches = Stretches::new(speed, greatest);
        for (acceleration, end) in self.accelerations() {
            stretches.push(acceleration.max(0.0), end.min(reaction));
            if end >= reaction {
                break;
            }
        }
        stretches
    }

    /// What it gains until a time (s), from a speed (m/s) at the demand on and never faster than `greatest`
    /// (m/s).
    pub(super) fn gain(&self, until: f64, from: f64, greatest: f64) -> Gain {
        let Leg { position, speed, .. } = self.unaware(from, until, greatest).end;
        Gain { speed: speed - from, distance: position - from * until }
    }

    /// With a reaction to the demand and braking, from a speed (m/s) there on and never faster than
    /// `greatest` (m/s).
    pub(super) fn with_response(&self, response: &Response, speed: f64, greatest: f64) -> Self {
        let Stretches { mut legs, end, .. } = self.unaware(speed, response.reaction(), greatest);
        let braked = response.with_reaction(0.0).legs(end.speed);
        legs.extend(braked.map(|leg| Leg {
            time: leg.time + end.time,
            position: leg.position + end.position,
            ..leg
        }));
        Self(legs.into())
    }
}

/// Legs of constant acceleration, one after the other.
struct Stretches {
    legs: Vec<Leg>,
    end: Leg,
    /// (m/s)
    greatest: f64,
}

impl Stretches {
    fn new(speed: f64, greatest: f64) -> Self {
        Self { legs: Vec::new(), end: Leg { speed, ..Leg::at_rest(0.0, 0.0) }, greatest }
    }

    /// An acceleration (m/s²) until a time (s). A vehicle that has stopped stays at rest, and one at the
    /// greatest speed keeps it.
    fn push(&mut self, acceleration: f64, until: f64) {
        let lasts = until - self.end.time;
        let room = if acceleration > 0.0 { self.greatest - self.end.speed } else { -self.end.speed };
        let reaches = if acceleration == 0.0 { f64::INFINITY } else { (room / acceleration).max(0.0) };
        if reaches >= lasts {
            self.leg(acceleration, lasts);
            return;
        }
        self.leg(acceleration, reaches);
        self.end.speed = if acceleration > 0.0 { self.end.speed } else { 0.0 };
        self.leg(0.0, lasts - reaches);
    }

    fn leg(&mut self, acceleration: f64, lasts: f64) {
        let leg = Leg { acceleration, jerk: 0.0, ..self.end };
        self.legs.push(leg);
        if lasts.is_finite() {
            self.end = leg.after(lasts);
        }
    }
}

/// (m/s) the speed at the impact that follows from the phases of the other vehicle.
pub(super) fn end_of(phases: &[PhaseForm]) -> Result<f64, Unposed> {
    Ok(starts(phases).map_err(Unposed::OtherPhases)?.last().copied().unwrap_or_default())
}

/// How a vehicle approached the impact: legs whose times and positions count from there.
pub(super) struct Approach {
    pub(super) legs: Vec<Leg>,
    /// (m/s)
    pub(super) at_impact: f64,
}

impl Approach {
    /// By phases or a recorder; `None` without them. A skid has its reaction, too, and is posed by itself.
    pub(super) fn of(braking: &BrakingForm, at_impact: Option<f64>) -> Result<Option<Self>, Unposed> {
        if matches!(braking, BrakingForm::Skid { .. }) {
            return Ok(None);
        }
        let (phases, at_impact) = stretches(braking, at_impact).map_err(Unposed::Phases)?;
        let Some(at_impact) = at_impact.filter(|_| !phases.is_empty()) else { return Ok(None) };
        Self::back(&phases, at_impact).map(Some).map_err(Unposed::Phases)
    }

    /// Of another vehicle, with its speed at the impact (m/s): steady if nothing is known of it. Before a
    /// skid, its brakes build up as those of the response do. The last leg is after the impact: it keeps its
    /// deceleration until it stops, or else its speed.
    pub(super) fn of_other(
        braking: &BrakingForm,
        at_impact: f64,
        response: &Response,
    ) -> Result<Self, Unposed> {
        let mut approach = if let BrakingForm::Skid { length, friction } = braking {
            let slowed = response.with_reaction(0.0).with_deceleration(friction * STANDARD_GRAVITY);
            Self::skidded(&slowed, at_impact, length.si())
        } else {
            let back = |(phases, leads_to): (Vec<Phase>, Option<f64>)| {
                Self::back(&phases, leads_to.unwrap_or(at_impact))
            };
            stretches(braking, Some(at_impact)).and_then(back).map_err(Unposed::OtherPhases)?
        };
        let speed = approach.at_impact;
        let last = approach.legs.last().map_or(0.0, |leg| leg.acceleration);
        let acceleration = if speed > 0.0 { last.min(0.0) } else { 0.0 };
        approach.legs.push(Leg { speed, acceleration, ..Leg::at_rest(0.0, 0.0) });
        Ok(approach)
    }

    /// Braked at once, with full deceleration over a length (m).
    fn skidded(slowed: &Response, at_impact: f64, length: f64) -> Self {
        let before = slowed.demand_before(at_impact, length);
        let from_impact = |leg: &Leg| Leg {
            time: leg.time - before.time,
            position: leg.position - before.distance,
            ..*leg
        };
        // The last leg is the rest.
        let [reaction, swell, full, _] = slowed.legs(before.speed);
        Self { legs: [reaction, swell, full].iter().map(from_impact).collect(), at_impact }
    }

    fn back(phases: &[Phase], at_impact: f64) -> Result<Self, InvalidInput> {
        let mut end = Leg { speed: at_impact, ..Leg::at_rest(0.0, 0.0) };
        let mut legs = Vec::with_capacity(phases.len());
        for phase in phases.iter().rev() {
            end = approach(&end, *phase)?;
            legs.push(end);
        }
        legs.reverse();
        Ok(Self { legs, at_impact })
    }
}

/// The phases before the impact, and the speed there (m/s): that given, unless the phases begin with a known
/// one and lead to it.
fn stretches(
    braking: &BrakingForm,
    at_impact: Option<f64>,
) -> Result<(Vec<Phase>, Option<f64>), InvalidInput> {
    let phases = match braking {
        BrakingForm::Phases(given) if braking.leads_on() => {
            let starts = starts(given)?;
            let phases = given.iter().zip(&starts).map(|(form, start)| backwards(form, Some(*start)));
            return Ok((phases.collect(), starts.last().copied()));
        }
        BrakingForm::Phases(given) => given.iter().map(|form| backwards(form, None)).collect(),
        BrakingForm::Recorded { approach, error } => {
            at_impact.map_or_else(Vec::new, |speed| recorded(approach, speed, *error))
        }
        BrakingForm::Skid { .. } | BrakingForm::Unknown | BrakingForm::Unbraked => Vec::new(),
    };
    Ok((phases, at_impact))
}

/// The samples as phases up to the impact with this speed (m/s) and this error.
fn recorded(approach: &SampledApproach, at_impact: f64, error: RecordedError) -> Vec<Phase> {
    let [mean, sd] = approach.shared_error(at_impact);
    let shared = mean + sd * error.shared;
    // Speeds that are stored alike are rounded alike, as those of a vehicle at a constant speed are.
    let rounding = |speed: f64| match error.rounding {
        Some(key) if speed > 0.0 => approach.step * (random::unit(random::bits(key, speed.to_bits())) - 0.5),
        _ => 0.0,
    };
    let kept: Vec<&SampleSpeed> = approach.samples.iter().filter(|sample| sample.time < -GIVES_WAY).collect();
    let ends = kept.iter().skip(1).map(|sample| sample.time).chain([0.0]);
    let phase = |(sample, end): (&&SampleSpeed, f64)| Phase::FromFor {
        speed: (sample.speed + shared * sample.sd + rounding(sample.speed)).max(0.0),
        time: end - sample.time,
    };
    kept.iter().zip(ends).map(phase).collect()
}

/// A phase by two of its numbers; `start` (m/s) is the speed where it begins, if that is known from the one
/// before.
fn backwards(form: &PhaseForm, start: Option<f64>) -> Phase {
    let [distance, time, speed, acceleration] = [&form.distance, &form.time, &form.speed, &form.acceleration]
        .map(|given| given.as_ref().map(Quantity::si));
    let acceleration = acceleration.unwrap_or_default();
    match (start.or(speed), distance, time) {
        (Some(speed), Some(distance), _) => Phase::FromOver { speed, distance },
        (Some(speed), None, Some(time)) => Phase::FromFor { speed, time },
        (Some(speed), None, None) => Phase::From { speed, acceleration },
        (None, Some(distance), Some(time)) => Phase::OverFor { distance, time },
        (None, Some(distance), None) => Phase::Over { distance, acceleration },
        (None, None, time) => Phase::For { time: time.unwrap_or_default(), acceleration },
    }
}
