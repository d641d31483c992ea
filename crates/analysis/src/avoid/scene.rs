//! One scene before a collision, with every number known: what the vehicle did, and what it would have done.

use inputs::{AvoidForm, BrakingForm, ClearForm, DemandForm, Quantity, STANDARD_GRAVITY, SpeedForm};
use pim_core::InvalidInput;
use time_distance::{Advance, Course, Leg, Response};

/// How the vehicle came to the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ActualRun {
    /// As the driver would have reacted and braked by `[avoid]`: nothing says otherwise.
    Responded,
    /// Without braking.
    Unbraked(Unbraked),
    /// Its wheels skidded up to the impact, as marks show.
    Skidded(Response),
}

/// Why a run is taken to be without braking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unbraked {
    /// The case says so.
    Stated,
    /// The case has the speed at the impact, and nothing that says that it braked before.
    NothingKnown,
    /// With a timely reaction, it would have stopped before the place of the impact: it reacted late, or not
    /// at all.
    WouldHaveStopped,
}

/// One scene before a collision, with every number known. Time and distance count from the reaction demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidScene {
    /// (m/s) speed at the demand.
    pub speed: f64,
    /// (m/s) speed at the impact.
    pub at_impact: f64,
    /// (m) from the demand to the place of the impact.
    pub distance: f64,
    /// (s) from the demand to the impact.
    pub time: f64,
    /// (m/s) the speed for which it is asked.
    pub limit: f64,
    /// What the driver could have done.
    pub response: Response,
    /// (s) after the impact, the other party would have left the danger zone, if it would have moved on.
    pub clears_after: Option<f64>,
    /// What the driver did.
    pub actual: ActualRun,
    /// What obstacles do to the view.
    pub view: View,
}

/// Since when the view of the other party has been free, without a break up to the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// (s) before the impact.
    pub time: f64,
    /// (m) distance that the vehicle covers from there to the impact.
    pub distance_subject: f64,
    /// (m) distance that the other party covers from there to the impact.
    pub distance_other: f64,
}

/// What obstacles do to the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// There are none.
    Open,
    /// They hide nothing in the [time before the impact](super::SIGHT_LOOK_BACK) that is looked at.
    NeverHidden,
    /// They hide the other party until then.
    Free(Sight),
}

impl View {
    /// Since when it is free, if something hides the other party before.
    #[must_use]
    pub fn sight(self) -> Option<Sight> {
        match self {
            Self::Free(sight) => Some(sight),
            Self::Open | Self::NeverHidden => None,
        }
    }
}

/// From where or when on a scene counts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Since {
    /// (m) distance of the vehicle before the impact.
    Distance(f64),
    /// (s) time before the impact.
    Time(f64),
}

/// Why the numbers are not those of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unposed {
    /// The vehicle braked already where or when the danger could first be recognized.
    BrakedBefore {
        /// (m) from the first effect of the brakes to the impact.
        distance: f64,
        /// (s) likewise.
        time: f64,
    },
    /// From this speed, the skid ends before the impact.
    SkidTooLong,
    /// The vehicle did not move forward.
    Stands,
    /// Obstacles hide nothing before the impact, so that their end is no demand.
    NeverHidden,
    /// An obstacle hides the other party at the impact.
    HiddenAtImpact,
    /// The engine refuses a number.
    Engine(InvalidInput),
}

impl From<InvalidInput> for Unposed {
    fn from(refusal: InvalidInput) -> Self {
        Self::Engine(refusal)
    }
}

/// What a vehicle did, or would have done, up to the place of the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidCourse {
    /// (m/s) speed at the demand.
    pub speed: f64,
    /// What the driver did; `None` without braking.
    pub response: Option<Response>,
}

impl AvoidCourse {
    /// (m/s) the speed at a distance (m) from the demand; 0 if it stops before.
    #[must_use]
    pub fn speed_at(&self, distance: f64) -> f64 {
        self.response.map_or(self.speed, |response| response.speed_after(self.speed, distance))
    }

    /// (s) when it is at a distance (m) from the demand; `None` if it stops before.
    #[must_use]
    pub fn arrival(&self, distance: f64) -> Option<f64> {
        match self.response {
            Some(response) => response.arrival(self.speed, distance),
            None => (self.speed > 0.0).then(|| distance / self.speed),
        }
    }

    /// (m) where it stops; `None` without braking.
    #[must_use]
    pub fn stop(&self) -> Option<f64> {
        Some(self.response?.stopping_distance(self.speed))
    }

    /// (m) where it is at a time (s) after the demand.
    #[must_use]
    pub fn position(&self, time: f64) -> f64 {
        let Some(response) = self.response else { return self.speed * time };
        let legs: [Leg; 4] = response.legs(self.speed);
        Course::new(&legs).map_or(0.0, |course| course.at(time).position)
    }
}

impl AvoidScene {
    /// The scene of these numbers, whose speed is `at_impact` (m/s) if it is sought, from where or when on
    /// `since` says; without obstacles.
    pub(crate) fn since(form: &AvoidForm, at_impact: Option<f64>, since: Since) -> Result<Self, Unposed> {
        let swell = form.swell.as_ref().map_or(0.0, Quantity::si);
        let of = |reaction, deceleration| Response::new(reaction, swell, deceleration, form.swell_form);
        let response = of(form.reaction_time.si(), form.deceleration.si())?;
        let (at_demand, at_impact) = match &form.speed {
            SpeedForm::AtDemand(speed) => (Some(speed.si()), None),
            SpeedForm::AtImpact(speed) => (None, Some(speed.si())),
            SpeedForm::Sought => (None, at_impact),
        };
        if !at_demand.or(at_impact).is_some_and(|speed| speed > 0.0) {
            return Err(Unposed::Stands);
        }
        let clears_after = form.clear.as_ref().map(|clear| clears_after(clear, &form.demand)).transpose()?;
        let partly = Self {
            speed: 0.0,
            at_impact: 0.0,
            distance: 0.0,
            time: 0.0,
            limit: form.limit.si(),
            response,
            clears_after,
            actual: ActualRun::Responded,
            view: View::Open,
        };
        match (&form.braking, at_demand, at_impact) {
            (BrakingForm::Skid { length, friction }, at_demand, at_impact) => {
                let slowed = of(response.reaction(), friction * STANDARD_GRAVITY)?;
                partly.skidded(since, slowed, length.si(), [at_demand, at_impact])
            }
            (BrakingForm::Unknown, Some(speed), _) => Ok(partly.responded(since, speed)),
            (BrakingForm::Unbraked, Some(speed), _) | (BrakingForm::Unbraked, None, Some(speed)) => {
                Ok(partly.unbraked(since, speed, Unbraked::Stated))
            }
            (BrakingForm::Unknown, None, Some(speed)) => {
                Ok(partly.unbraked(since, speed, Unbraked::NothingKnown))
            }
            (_, None, None) => Err(Unposed::Stands),
        }
    }

    /// With the reaction and braking of `[avoid]`; without braking, if the vehicle would then have stopped.
    fn responded(self, since: Since, speed: f64) -> Self {
        let course = AvoidCourse { speed, response: Some(self.response) };
        let stops = Unbraked::WouldHaveStopped;
        let (distance, time) = match since {
            Since::Distance(distance) => match course.arrival(distance) {
                Some(time) if course.speed_at(distance) > 0.0 => (distance, time),
                _ => return self.unbraked(since, speed, stops),
            },
            Since::Time(time) if time < self.response.stopping_time(speed) => (course.position(time), time),
            Since::Time(_) => return self.unbraked(since, speed, stops),
        };
        Self { speed, at_impact: course.speed_at(distance), distance, time, ..self }
    }

    fn unbraked(self, since: Since, speed: f64, why: Unbraked) -> Self {
        let (distance, time) = match since {
            Since::Distance(distance) => (distance, distance / speed),
            Since::Time(time) => (speed * time, time),
        };
        Self { speed, at_impact: speed, distance, time, actual: ActualRun::Unbraked(why), ..self }
    }

    fn skidded(
        self,
        since: Since,
        slowed: Response,
        length: f64,
        [at_demand, at_impact]: [Option<f64>; 2],
    ) -> Result<Self, Unposed> {
        let at_impact = match (at_impact, at_demand) {
            (Some(speed), _) => speed,
            (None, Some(speed)) => {
                // A vehicle that stands at the end of the swell has lost all of its speed in it.
                let lost = slowed.demand_before(0.0, 0.0).speed;
                // v_c² = (v_0 − lost)² − 2 a s
                let square = (speed - lost) * (speed - lost) - 2.0 * slowed.deceleration() * length;
                if speed < lost || square < 0.0 {
                    return Err(Unposed::SkidTooLong);
                }
                square.sqrt()
            }
            (None, None) => return Err(Unposed::Stands),
        };
        let before = slowed.demand_before(at_impact, length);
        let speed = at_demand.unwrap_or(before.speed);
        // From the first effect of the brakes to the impact.
        let braked = before.distance - before.speed * slowed.reaction();
        let braking = before.time - slowed.reaction();
        let (distance, time) = match since {
            Since::Distance(distance) => (distance, braking + (distance - braked) / speed),
            Since::Time(time) => (braked + speed * (time - braking), time),
        };
        if distance < braked || time < braking {
            return Err(Unposed::BrakedBefore { distance: braked, time: braking });
        }
        let actual = ActualRun::Skidded(slowed.with_reaction(time - braking));
        Ok(Self { speed, at_impact, distance, time, actual, ..self })
    }

    /// (m/s) the greatest speed from which the vehicle stops before the place of the impact.
    #[must_use]
    pub fn spatial(&self) -> f64 {
        self.response.speed_to_stop_within(self.distance)
    }

    /// (m/s) the greatest speed with which it comes so late that the other party has cleared the danger
    /// zone, if that would have moved on.
    #[must_use]
    pub fn temporal(&self) -> Option<f64> {
        let cleared = self.time + self.clears_after?;
        Some(self.response.speed_to_arrive_after(self.distance, cleared))
    }

    /// (m/s) the greatest speed from which the collision is avoided, in space or in time.
    #[must_use]
    pub fn just_avoiding(&self) -> f64 {
        self.temporal().unwrap_or(0.0).max(self.spatial())
    }

    /// (m/s) what is left of the limit at the place of the impact.
    #[must_use]
    pub fn left_at_limit(&self) -> f64 {
        self.response.speed_after(self.limit, self.distance)
    }

    /// Whether the collision is avoided at the limit, with the reaction and the braking of the actual run.
    #[must_use]
    pub fn is_avoided_else_as_it_was(&self) -> bool {
        let course = AvoidCourse { speed: self.limit, ..self.course() };
        let clears = self.clears_after.map(|after| self.time + after);
        match course.arrival(self.distance) {
            Some(arrival) if course.speed_at(self.distance) > 0.0 => {
                clears.is_some_and(|clears| arrival >= clears)
            }
            _ => true,
        }
    }

    /// What the vehicle did.
    #[must_use]
    pub fn course(&self) -> AvoidCourse {
        let response = match self.actual {
            ActualRun::Responded => Some(self.response),
            ActualRun::Unbraked(_) => None,
            ActualRun::Skidded(slowed) => Some(slowed),
        };
        AvoidCourse { speed: self.speed, response }
    }
}

/// Where or when the demand is; `None` if obstacles decide.
pub(super) fn given_demand(form: &AvoidForm) -> Result<Option<Since>, InvalidInput> {
    Ok(match &form.demand {
        DemandForm::Distance(distance) => Some(Since::Distance(distance.si())),
        DemandForm::Time(time) => Some(Since::Time(time.si())),
        DemandForm::Other(other) => Some(Since::Time(other.time()?)),
        DemandForm::Sight => None,
    })
}

/// (s) after the impact, the other party has cleared the danger zone.
fn clears_after(clear: &ClearForm, demand: &DemandForm) -> Result<f64, InvalidInput> {
    let distance = clear.distance.si();
    match (&clear.speed, demand) {
        (None, DemandForm::Other(other)) => {
            Ok(other.advance().time_over(other.distance.si() + distance)? - other.time()?)
        }
        (speed, _) => {
            let speed = speed.as_ref().map_or(0.0, Quantity::si);
            Advance::Steady { speed }.time_over(distance)
        }
    }
}
