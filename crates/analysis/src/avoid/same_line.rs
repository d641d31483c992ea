//! Another vehicle on the line of the judged one: the place of a collision moves with it.

use std::sync::Arc;

use inputs::{Along, BrakingForm, SameLineForm};
use time_distance::{Course, Gap, Leg, Response, first_contact, least_gap};

use super::driven::{Approach, Driven};
use super::posing::{FAR, Since, Unposed};

/// How another vehicle moves along the line of the judged one: up to the impact as it did, and from then on
/// as it would have.
#[derive(Clone, Debug, PartialEq)]
pub struct SameLine {
    /// In which direction.
    pub along: Along,
    /// (m/s) its speed at the impact.
    pub speed: f64,
    /// (m/s²) its deceleration at the impact, which it keeps until it stops; zero if it was steady or
    /// accelerated, and then keeps its speed.
    pub deceleration: f64,
    /// (m) how far it is from the vehicle at the demand.
    pub gap: f64,
    /// Its motion since the demand, in places and speeds along the path of the vehicle.
    legs: Arc<[Leg]>,
}

/// The arrival of a vehicle at the place of the impact, or at another one that moves along its line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// (s) when, after the demand.
    pub time: f64,
    /// (m/s) its speed.
    pub speed: f64,
    /// (m/s) the speed of the other vehicle, if that moves along its line.
    pub other: Option<f64>,
}

impl SameLine {
    /// With its speed at the impact (m/s), if the rest of the case gives it, from the distance (m) and the
    /// time (s) of the demand before the impact on; `None` if it was stationary, or its speed is not known.
    /// Its brakes build up as those of the response do.
    pub(super) fn of(
        form: &SameLineForm,
        sought: Option<f64>,
        response: &Response,
        [distance, time]: [f64; 2],
    ) -> Result<Option<Self>, Unposed> {
        let Some(speed) = form.motion.speed_at_impact(sought) else { return Ok(None) };
        if speed == 0.0 && matches!(form.motion.braking, BrakingForm::Unknown) {
            return Ok(None);
        }
        // A vehicle that backs moves the other way, and its phases describe that motion.
        let (along, speed) = match form.along {
            along if speed >= 0.0 => (along, speed),
            Along::Ahead => (Along::Oncoming, -speed),
            Along::Oncoming => (Along::Ahead, -speed),
        };
        let approach = Approach::of_other(&form.motion.braking, speed, response)?;
        let speed = approach.at_impact;
        let deceleration = approach.legs.last().map_or(0.0, |after| 0.0 - after.acceleration);
        let (driven, own, _) = Driven::new(approach, Since::Time(time))?;
        let sign = match along {
            Along::Ahead => 1.0,
            Along::Oncoming => -1.0,
        };
        // Both are at the place of the impact when it happens.
        let on_the_way = |leg: &Leg| Leg {
            time: leg.time,
            position: distance + sign * (leg.position - own),
            speed: sign * leg.speed,
            acceleration: sign * leg.acceleration,
            jerk: sign * leg.jerk,
        };
        let legs: Arc<[Leg]> = driven.0.iter().map(on_the_way).collect();
        let gap = distance - sign * own;
        Ok(Some(Self { along, speed, deceleration, gap, legs }))
    }

    /// Where it is at a time (s) after the demand, and how fast, along the path of the vehicle: negative
    /// towards it.
    #[must_use]
    pub fn at(&self, time: f64) -> Leg {
        Course::new(&self.legs).map_or(Leg::at_rest(time, f64::NAN), |course| course.at(time))
    }

    /// (m) the least distance to a vehicle with these legs until a time (s) after the demand.
    pub(super) fn least_gap(&self, legs: &[Leg], until: f64) -> f64 {
        let of = |[own, other]: [Course<'_>; 2]| least_gap(&own, &other, [0.0, until.min(FAR)]).distance;
        self.with(legs).map_or(f64::NAN, of)
    }

    /// The first contact with a vehicle with these legs.
    pub(super) fn contact(&self, legs: &[Leg]) -> Option<Meeting> {
        let [own, other] = self.with(legs)?;
        let Gap { time, .. } = first_contact(&own, &other, [0.0, FAR])?;
        Some(Meeting { time, speed: own.at(time).speed, other: Some(other.at(time).speed.abs()) })
    }

    fn with<'a>(&'a self, legs: &'a [Leg]) -> Option<[Course<'a>; 2]> {
        Some([Course::new(legs)?, Course::new(&self.legs)?])
    }
}
