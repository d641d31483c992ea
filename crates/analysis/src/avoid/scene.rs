//! One scene before a collision, with every number known: what the vehicle did, and what it would have done.

use std::borrow::Cow;

use inputs::{
    AvoidForm, BrakingForm, ClearForm, ClearSpeedForm, DemandForm, Quantity, STANDARD_GRAVITY, SameLineForm,
    SpeedForm,
};
use pim_core::InvalidInput;
use reconcile::brent;
use time_distance::{Advance, Course, Leg, Response};

use super::driven::{Approach, BRAKES, Driven, Gain, end_of};
use super::posing::{FAR, Since, SoughtSpeeds, Unposed};
use super::same_line::{Meeting, SameLine};

/// How the vehicle approached the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ActualRun {
    /// As the driver would have reacted and braked by `[avoid]`: nothing says otherwise.
    Responded,
    /// Without braking.
    Unbraked(Unbraked),
    /// Its wheels skidded up to the impact, as marks show.
    Skidded(Response),
    /// It moved as phases or the table of its recorder show.
    Driven(DrivenBy),
}

/// What shows how the vehicle moved before the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivenBy {
    /// The phases of `[[vehicleN.before.phase]]`.
    Phases,
    /// The table of its recorder.
    Recorder,
}

/// Why a run is taken to be without braking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unbraked {
    /// The case says so.
    Stated,
    /// The case has the speed at the impact, and no braking before it.
    NothingKnown,
    /// With a timely reaction, it would have stopped before the place of the impact, or would not have come
    /// up to another vehicle on its line there: it reacted late, or not at all.
    WouldHaveStopped,
}

/// One scene before a collision, with every number known. Time and distance count from the reaction demand.
#[derive(Clone, Debug, PartialEq)]
pub struct AvoidScene {
    /// (m/s) speed at the demand.
    pub speed: f64,
    /// (m/s) speed at the impact.
    pub at_impact: f64,
    /// (m) from the demand to the place of the impact.
    pub distance: f64,
    /// (s) from the demand to the impact.
    pub time: f64,
    /// (m/s) the speed limit of the question.
    pub limit: f64,
    /// What the driver could have done.
    pub response: Response,
    /// How the other party would have left the danger zone, if it would have moved on.
    pub clears: Option<Clears>,
    /// What the driver did.
    pub actual: ActualRun,
    /// What obstacles do to the view.
    pub view: View,
    /// The other vehicle, if it moves along the same line: the place of a collision then moves with it.
    pub same_line: Option<SameLine>,
    /// How the vehicle moved, if phases or a recorder show it.
    pub(super) driven: Option<Driven>,
}

/// How the other party would have left the danger zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clears {
    /// (m) how far it still had to go.
    pub distance: f64,
    /// (s) after the impact.
    pub after: f64,
    /// Whether it backs.
    pub backs: bool,
}

impl Clears {
    fn of(clear: &ClearForm, demand: &DemandForm, sought: Option<f64>) -> Result<Self, Unposed> {
        let speed = match (&clear.speed, demand) {
            (ClearSpeedForm::AsItCame, DemandForm::Other(other)) => {
                let distance = clear.distance(false)?.ok_or(Unposed::Outside)?;
                let in_all = other.advance().time_over(other.distance.si() + distance)?;
                return Ok(Self { distance, after: in_all - other.time()?, backs: false });
            }
            (ClearSpeedForm::Steady(speed), _) => Some(speed.si()),
            (ClearSpeedForm::Phases(phases), _) => Some(end_of(phases)?),
            // A solution that lets it move backward means that it was stationary.
            (ClearSpeedForm::AsItCame | ClearSpeedForm::Sought, _) => sought.map(|speed| speed.max(0.0)),
        };
        let backs = speed.is_some_and(|speed| speed < 0.0);
        let distance = clear.distance(backs)?.ok_or(Unposed::Outside)?;
        let after = match (speed, &clear.speed) {
            (Some(speed), _) if speed != 0.0 => Advance::Steady { speed: speed.abs() }.time_over(distance)?,
            // Among samples in which it moves, a stationary one never clears it.
            (Some(_), ClearSpeedForm::AsItCame | ClearSpeedForm::Sought) => FAR,
            (Some(_), ClearSpeedForm::Steady(_) | ClearSpeedForm::Phases(_)) | (None, _) => {
                return Err(Unposed::OtherStands);
            }
        };
        Ok(Self { distance, after, backs })
    }
}

/// From when on the other party was continuously in view up to the impact.
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
    /// They hide nothing in the [time examined](super::SIGHT_LOOK_BACK) before the impact.
    NeverHidden,
    /// They hide the other party until then.
    Free(Sight),
}

impl View {
    /// From when on it is free, if something hides the other party before.
    #[must_use]
    pub fn sight(self) -> Option<Sight> {
        match self {
            Self::Free(sight) => Some(sight),
            Self::Open | Self::NeverHidden => None,
        }
    }
}

/// What a vehicle did, or would have done, up to the place of the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct AvoidCourse {
    /// (m/s) speed at the demand.
    pub speed: f64,
    /// What the driver did; `None` without braking, or if phases or a recorder show how the vehicle moved.
    pub response: Option<Response>,
    /// How it moves, if it accelerates or brakes otherwise than by the response alone.
    pub(super) driven: Option<Driven>,
}

impl AvoidCourse {
    /// (m/s) the speed at a distance (m) from the demand; 0 if it stops before.
    fn speed_at(&self, distance: f64) -> f64 {
        if let Some(driven) = &self.driven {
            return driven.reaches(distance).map_or(0.0, |time| driven.at(time).speed);
        }
        self.response.map_or(self.speed, |response| response.speed_after(self.speed, distance))
    }

    /// (s) when it is at a distance (m) from the demand; `None` if it stops before.
    fn arrival(&self, distance: f64) -> Option<f64> {
        match (&self.driven, self.response) {
            (Some(driven), _) => driven.reaches(distance),
            (None, Some(response)) => response.arrival(self.speed, distance),
            (None, None) => (self.speed > 0.0).then(|| distance / self.speed),
        }
    }

    /// Its legs since the demand.
    fn legs(&self) -> Cow<'_, [Leg]> {
        match (&self.driven, self.response) {
            (Some(driven), _) => Cow::Borrowed(&driven.0),
            (None, Some(response)) => Cow::Owned(response.legs(self.speed).into()),
            (None, None) => Cow::Owned(vec![Leg { speed: self.speed, ..Leg::at_rest(0.0, 0.0) }]),
        }
    }

    /// (m) where it stops; `None` without braking.
    #[must_use]
    pub fn stop(&self) -> Option<f64> {
        if let Some(driven) = &self.driven {
            return driven.stop();
        }
        Some(self.response?.stopping_distance(self.speed))
    }

    /// (s) when it stops, after the demand; `None` without braking.
    #[must_use]
    pub fn stops_after(&self) -> Option<f64> {
        if let Some(driven) = &self.driven {
            return driven.stops_after();
        }
        Some(self.response?.stopping_time(self.speed))
    }

    /// (m) where it is at a time (s) after the demand.
    #[must_use]
    pub fn position(&self, time: f64) -> f64 {
        Course::new(&self.legs()).map_or(0.0, |course| course.at(time).position)
    }
}

impl AvoidScene {
    /// The scene of these numbers, with the unknown speeds, from the place or time `since` on; without
    /// obstacles.
    pub(crate) fn since(form: &AvoidForm, sought: SoughtSpeeds, since: Since) -> Result<Self, Unposed> {
        let scene = Self::of_vehicle(form, sought, since)?;
        let Some(line) = &form.same_line else { return Ok(scene) };
        match scene.clone().on_line(line, sought.other) {
            // With a timely reaction it would not have come up to the other: its driver reacted late, or not
            // at all.
            Err(Unposed::Parts) if scene.actual == ActualRun::Responded => {
                let speed = scene.speed;
                scene.unbraked(since, speed, Unbraked::WouldHaveStopped).on_line(line, sought.other)
            }
            posed => posed,
        }
    }

    /// The same with the other vehicle on its line, with the unknown speed (m/s).
    fn on_line(self, line: &SameLineForm, sought: Option<f64>) -> Result<Self, Unposed> {
        let same_line = SameLine::of(line, sought, &self.response, [self.distance, self.time])?;
        if let Some(line) = &same_line
            && (line.gap < 0.0 || self.at_impact <= line.at(self.time).speed)
        {
            return Err(Unposed::Parts);
        }
        Ok(Self { same_line, ..self })
    }

    /// The same, wherever the other vehicle is.
    pub(super) fn of_vehicle(form: &AvoidForm, sought: SoughtSpeeds, since: Since) -> Result<Self, Unposed> {
        let response = response(form)?;
        let (at_demand, at_impact) = match &form.speed {
            SpeedForm::AtDemand(speed) => (Some(speed.si()), None),
            SpeedForm::AtImpact(speed) => (None, Some(speed.si())),
            SpeedForm::ByPhases => (None, None),
            SpeedForm::Sought => (None, sought.subject),
        };
        let approach = Approach::of(&form.braking, at_impact)?;
        let at_impact = approach.as_ref().map(|approach| approach.at_impact).or(at_impact);
        if !at_demand.or(at_impact).is_some_and(|speed| speed > 0.0) {
            return Err(Unposed::Stands);
        }
        let clear = form.clear.as_ref();
        let clears = clear.map(|clear| Clears::of(clear, &form.demand, sought.other)).transpose()?;
        let partly = Self {
            speed: 0.0,
            at_impact: 0.0,
            distance: 0.0,
            time: 0.0,
            limit: form.limit.si(),
            response,
            clears,
            actual: ActualRun::Responded,
            view: View::Open,
            same_line: None,
            driven: None,
        };
        if let Some(approach) = approach {
            let by = match form.braking {
                BrakingForm::Recorded { .. } => DrivenBy::Recorder,
                _ => DrivenBy::Phases,
            };
            return partly.driven(since, approach, by);
        }
        match (&form.braking, at_demand, at_impact) {
            (BrakingForm::Skid { length, friction }, at_demand, at_impact) => {
                let full = friction * STANDARD_GRAVITY;
                let slowed = Response::new(response.reaction(), response.swell(), full, response.form())?;
                partly.skidded(since, slowed, length.si(), [at_demand, at_impact])
            }
            (BrakingForm::Unknown, Some(speed), _) => Ok(partly.responded(since, speed)),
            (BrakingForm::Unbraked, Some(speed), _) | (BrakingForm::Unbraked, None, Some(speed)) => {
                Ok(partly.unbraked(since, speed, Unbraked::Stated))
            }
            // A recorder that stored only the last moment says nothing about the approach.
            (
                BrakingForm::Unknown | BrakingForm::Phases(_) | BrakingForm::Recorded { .. },
                _,
                Some(speed),
            ) => Ok(partly.unbraked(since, speed, Unbraked::NothingKnown)),
            (BrakingForm::Phases(_) | BrakingForm::Recorded { .. }, Some(_), None) | (_, None, None) => {
                Err(Unposed::Stands)
            }
        }
    }

    fn driven(self, since: Since, approach: Approach, by: DrivenBy) -> Result<Self, Unposed> {
        let at_impact = approach.at_impact;
        let (driven, distance, time) = Driven::new(approach, since)?;
        let speed = driven.at(0.0).speed;
        let driven = Some(driven);
        Ok(Self { speed, at_impact, distance, time, actual: ActualRun::Driven(by), driven, ..self })
    }

    /// (s) with the reaction and braking of `[avoid]`, it covers a distance (m) from a speed (m/s) and moves
    /// on; `None` if it stops.
    fn arrives(&self, speed: f64, distance: f64) -> Option<f64> {
        let time = self.response.arrival(speed, distance)?;
        (time < self.response.stopping_time(speed)).then_some(time)
    }

    /// (s) over a distance (m) from the demand, from a speed (m/s) there, if nothing is known about the
    /// braking.
    pub(super) fn time_responded(&self, distance: f64, speed: f64) -> f64 {
        self.arrives(speed, distance).unwrap_or(distance / speed)
    }

    /// With the reaction and braking of `[avoid]`; without braking, if the vehicle would then have stopped.
    fn responded(self, since: Since, speed: f64) -> Self {
        let course = AvoidCourse { speed, response: Some(self.response), driven: None };
        let stops = Unbraked::WouldHaveStopped;
        let (distance, time) = match since {
            Since::Distance(distance) => match self.arrives(speed, distance) {
                Some(time) => (distance, time),
                None => return self.unbraked(since, speed, stops),
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
                // A vehicle at rest at the end of the swell has lost all of its speed in it.
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

    /// What the vehicle gains until a time (s), from a speed (m/s) at the demand on and never faster than
    /// `greatest` (m/s), if it accelerated.
    fn gain(&self, until: f64, speed: f64, greatest: f64) -> Gain {
        self.driven.as_ref().map_or_else(Gain::default, |driven| driven.gain(until, speed, greatest))
    }

    /// The scene of a vehicle that drove steadily at the speed that this one has when it begins to brake, and
    /// comes to every place when this one does: that speed (m/s), and its distance (m) to the place of the
    /// impact.
    fn as_if_steady(&self, speed: f64, greatest: f64) -> [f64; 2] {
        let reaction = self.response.reaction();
        let gain = self.gain(reaction, speed, greatest);
        // s' = s + Δv t_R − Δs
        [speed + gain.speed, self.distance + gain.speed * reaction - gain.distance]
    }

    /// Where a course reaches the place of the impact, or a vehicle that moves along the line; `None` if it
    /// never does.
    #[must_use]
    pub fn meeting(&self, course: &AvoidCourse) -> Option<Meeting> {
        let Some(line) = &self.same_line else {
            let time = course.arrival(self.distance)?;
            return Some(Meeting { time, speed: course.speed_at(self.distance), other: None });
        };
        line.contact(&course.legs())
    }

    /// (m) how near a course comes to a vehicle that moves along the line; `None` without one.
    #[must_use]
    pub fn least_gap(&self, course: &AvoidCourse) -> Option<f64> {
        Some(self.same_line.as_ref()?.least_gap(&course.legs(), FAR))
    }

    /// (m/s) the greatest speed from which the vehicle stops before the place of the impact, or does not
    /// reach another that moves along the line. One that accelerates in its reaction keeps that speed once it
    /// has it.
    #[must_use]
    pub fn spatial(&self) -> f64 {
        if let Some(line) = &self.same_line {
            return self.just_apart(line, FAR);
        }
        self.just(&|distance| self.response.speed_to_stop_within(distance), &|course| {
            course.stop().map_or(f64::INFINITY, |stop| stop - self.distance)
        })
    }

    /// (m/s) the greatest speed at which it arrives so late that the other party has cleared the danger zone,
    /// if that would have moved on; likewise.
    #[must_use]
    pub fn temporal(&self) -> Option<f64> {
        let cleared = self.cleared()?;
        if let Some(line) = &self.same_line {
            return Some(self.just_apart(line, cleared));
        }
        let early = |course: &AvoidCourse| cleared - course.arrival(self.distance).unwrap_or(f64::INFINITY);
        Some(self.just(&|distance| self.response.speed_to_arrive_after(distance, cleared), &early))
    }

    /// (m/s) the greatest speed at which it does not reach a vehicle on the same line until a time (s).
    fn just_apart(&self, line: &SameLine, until: f64) -> f64 {
        let reached = self.reached();
        let overlaps = |greatest: f64| {
            let beyond = (greatest - reached).max(0.0);
            let course = self.responding(self.speed.min(greatest) + beyond, self.response, greatest);
            -line.least_gap(&course.legs(), until).clamp(-FAR, FAR)
        };
        if overlaps(0.0) > 0.0 {
            return 0.0;
        }
        let mut most = self.greatest_speed().max(reached);
        while overlaps(most) <= 0.0 {
            if most > FAR {
                return f64::INFINITY;
            }
            most *= 2.0;
        }
        last_that_holds(|speed| overlaps(speed) <= 0.0, [0.0, most])
    }

    /// (m/s) the greatest speed at which a course just does not fail: by the closed form of a distance (m)
    /// for a steady speed, or where `fails_by`, which rises with the speed, is zero.
    fn just(&self, steadily: &dyn Fn(f64) -> f64, fails_by: &dyn Fn(&AvoidCourse) -> f64) -> f64 {
        let steady = steadily(self.distance);
        let [reached, distance] = self.as_if_steady(self.speed, f64::INFINITY);
        // Slower than at the demand, it has no room to accelerate.
        if steady <= self.speed || reached <= self.speed {
            return steady;
        }
        let fails =
            |greatest: f64| fails_by(&self.responding(self.speed, self.response, greatest)).clamp(-FAR, FAR);
        // It may come faster from the demand on than it did.
        if fails(reached) <= 0.0 {
            return steadily(distance).max(reached);
        }
        brent(fails, [self.speed, reached], TOLERANCE, |_, _| ()).unwrap_or(self.speed)
    }

    /// (m/s) the greatest speed from which the collision is avoided, in space or in time.
    #[must_use]
    pub fn just_avoiding(&self) -> f64 {
        self.temporal().unwrap_or(0.0).max(self.spatial())
    }

    /// (m/s) the speed at the demand of a vehicle that keeps the limit: its own if that was lower.
    fn lowered(&self) -> f64 {
        self.limit.min(self.speed)
    }

    /// (m/s) the speed that a vehicle that keeps the limit does not exceed.
    pub(super) fn kept(&self) -> f64 {
        self.limit.min(self.reached())
    }

    /// (m/s) the speed that it has when a reaction in time ends, if nothing limits it.
    fn reached(&self) -> f64 {
        self.as_if_steady(self.speed, f64::INFINITY)[0]
    }

    /// (s) how long after the demand its motion is known, if phases or a recorder show it.
    #[must_use]
    pub fn begins(&self) -> Option<f64> {
        self.driven.as_ref().map(Driven::begins)
    }

    /// Whether it accelerates in the time of the reaction.
    #[must_use]
    pub fn accelerates(&self) -> bool {
        self.reached() > self.speed
    }

    /// (m/s) its greatest speed from the demand to the impact.
    #[must_use]
    pub fn greatest_speed(&self) -> f64 {
        self.driven.as_ref().map_or(self.speed, |driven| driven.greatest(self.time))
    }

    /// Whether it was faster than the limit, at the demand or later.
    #[must_use]
    pub fn is_above_limit(&self) -> bool {
        self.greatest_speed() > self.limit
    }

    /// With a reaction to the demand, from a speed (m/s) there on.
    #[must_use]
    pub fn with_response(&self, speed: f64, response: Response) -> AvoidCourse {
        self.responding(speed, response, f64::INFINITY)
    }

    /// (m) from the demand to the stop, at the speed driven and with the reaction and the braking of
    /// `[avoid]`.
    #[must_use]
    pub fn stopping_distance(&self) -> f64 {
        self.with_response(self.speed, self.response).stop().unwrap_or(f64::NAN)
    }

    /// At the limit, with the reaction and the braking of `[avoid]`.
    #[must_use]
    pub fn at_limit(&self) -> AvoidCourse {
        self.responding(self.lowered(), self.response, self.limit)
    }

    fn responding(&self, speed: f64, response: Response, greatest: f64) -> AvoidCourse {
        let gains = |driven: &&Driven| driven.gain(response.reaction(), speed, greatest).speed > 0.0;
        let accelerates = self.driven.as_ref().filter(gains);
        let driven = accelerates.map(|driven| driven.with_response(&response, speed, greatest));
        AvoidCourse { speed, response: Some(response), driven }
    }

    /// At the limit, with the reaction and the braking of the actual run.
    #[must_use]
    pub fn at_limit_else_as_it_was(&self) -> AvoidCourse {
        let driven = self.driven.as_ref().map(|driven| driven.beginning_with(self.lowered(), self.limit));
        AvoidCourse { speed: self.lowered(), driven, ..self.course() }
    }

    /// (m/s) what is left of the limit at the place of the impact.
    #[must_use]
    pub fn left_at_limit(&self) -> f64 {
        self.meeting(&self.at_limit()).map_or(0.0, |meeting| meeting.speed)
    }

    /// Whether the vehicle stops before the place of the impact at the limit, with the reaction and the
    /// braking of `[avoid]`.
    #[must_use]
    pub fn stops_at_limit(&self) -> bool {
        self.kept() <= self.spatial()
    }

    /// Whether it then arrives after the other party has left the danger zone; `None` without that question.
    #[must_use]
    pub fn is_late_at_limit(&self) -> Option<bool> {
        Some(self.kept() <= self.temporal()?)
    }

    /// Whether the collision is avoided at the limit, with the reaction and the braking of the actual run.
    #[must_use]
    pub fn is_avoided_else_as_it_was(&self) -> bool {
        self.avoids(&self.at_limit_else_as_it_was())
    }

    /// Whether a course has no collision.
    fn avoids(&self, course: &AvoidCourse) -> bool {
        self.meeting(course).is_none_or(|meeting| self.is_late(meeting.time) || self.is_end(&meeting))
    }

    /// Whether the vehicle stops just where it would meet the other party.
    pub(super) fn is_end(&self, meeting: &Meeting) -> bool {
        self.same_line.is_none() && meeting.speed <= 0.0
    }

    /// Whether the vehicle is taken as unbraked because it would have stopped with the reaction and braking
    /// of the inputs.
    #[must_use]
    pub fn reacted_late(&self) -> bool {
        self.actual == ActualRun::Unbraked(Unbraked::WouldHaveStopped)
    }

    /// Whether the collision is avoided without any braking, from the speed driven or from the limit.
    #[must_use]
    pub fn is_avoided_unbraked(&self, is_at_limit: bool) -> bool {
        let [speed, greatest] = self.asked(is_at_limit);
        let course = self.responding(speed, self.response.with_reaction(LONGEST_REACTION), greatest);
        if self.same_line.is_some() { self.avoids(&course) } else { self.comes_late(&course) }
    }

    /// (m/s²) if it already brakes at the demand, its deceleration there.
    #[must_use]
    pub fn braked_at_demand(&self) -> Option<f64> {
        let acceleration = self.driven.as_ref()?.at(0.0).acceleration;
        (acceleration < -BRAKES).then_some(-acceleration)
    }

    /// (m/s²) the least deceleration that avoids the collision from the speed driven, or from the limit: the
    /// vehicle stops before the place of the impact, or arrives there after the other party has left the
    /// danger zone, zero if it does so without braking; `None` if no deceleration does.
    #[must_use]
    pub fn least_deceleration(&self, is_at_limit: bool) -> Option<f64> {
        let [speed, greatest] = self.asked(is_at_limit);
        if self.same_line.is_some() {
            let avoids = |deceleration: f64| {
                self.avoids(&self.responding(speed, self.response.with_deceleration(deceleration), greatest))
            };
            if avoids(LEAST_DECELERATION) {
                return Some(0.0);
            }
            let most = MOST_DECELERATION;
            return avoids(most).then(|| last_that_holds(avoids, [most, LEAST_DECELERATION]));
        }
        let [steady, distance] = self.as_if_steady(speed, greatest);
        let in_space = self.response.deceleration_to_stop_within(steady, distance);
        let is_late = |deceleration: f64| {
            self.comes_late(&self.responding(speed, self.response.with_deceleration(deceleration), greatest))
        };
        let most = in_space.unwrap_or(MOST_DECELERATION);
        let in_time = if is_late(LEAST_DECELERATION) {
            Some(0.0)
        } else {
            is_late(most).then(|| last_that_holds(is_late, [most, LEAST_DECELERATION]))
        };
        in_time.or(in_space)
    }

    /// (s) the longest reaction that avoids the collision, likewise; if it is avoided without braking, the
    /// time that the other party takes.
    #[must_use]
    pub fn longest_reaction(&self, is_at_limit: bool) -> Option<f64> {
        let [speed, greatest] = self.asked(is_at_limit);
        let course = |reaction: f64| self.responding(speed, self.response.with_reaction(reaction), greatest);
        if self.same_line.is_some() {
            let avoids = |reaction: f64| self.avoids(&course(reaction));
            return avoids(0.0).then(|| last_that_holds(avoids, [0.0, LONGEST_REACTION]));
        }
        let stops = |reaction: f64| course(reaction).stop().is_some_and(|stop| stop <= self.distance);
        let in_space = if self.gain(self.time, speed, greatest).speed <= 0.0 {
            self.response.reaction_to_stop_within(speed, self.distance)
        } else {
            stops(0.0).then(|| last_that_holds(stops, [0.0, self.time]))
        };
        let is_late = |reaction: f64| self.comes_late(&course(reaction));
        let in_time = self
            .cleared()
            .filter(|_| is_late(0.0))
            .map(|cleared| if is_late(cleared) { cleared } else { last_that_holds(is_late, [0.0, cleared]) });
        // The later of both: a vehicle that stops before the place never arrives, so it is late enough, too.
        in_time.or(in_space)
    }

    /// (s) after the demand, the other party has left the danger zone; `None` without that question.
    pub(super) fn cleared(&self) -> Option<f64> {
        self.clears.map(|clears| self.time + clears.after)
    }

    /// Whether an arrival (s) at the place of the impact is after the other party has left the danger zone;
    /// never true without that question.
    fn is_late(&self, arrival: f64) -> bool {
        self.cleared().is_some_and(|cleared| arrival >= cleared)
    }

    /// Whether a course reaches the place that late, or never; never true without that question.
    fn comes_late(&self, course: &AvoidCourse) -> bool {
        self.clears.is_some() && course.arrival(self.distance).is_none_or(|arrival| self.is_late(arrival))
    }

    /// (m/s) the speed at the demand, and the one that is not exceeded later.
    fn asked(&self, is_at_limit: bool) -> [f64; 2] {
        if is_at_limit { [self.lowered(), self.limit] } else { [self.speed, f64::INFINITY] }
    }

    /// (s) by how much the brakes took effect later than with the reaction of `[avoid]`; `None` if it is not
    /// known.
    #[must_use]
    pub fn delay(&self) -> Option<f64> {
        let taken = match (self.actual, &self.driven) {
            (ActualRun::Skidded(slowed), _) => slowed.reaction(),
            (_, Some(driven)) => driven.brakes(self.time)?,
            _ => return None,
        };
        Some(taken - self.response.reaction())
    }

    /// What the vehicle did.
    #[must_use]
    pub fn course(&self) -> AvoidCourse {
        let response = match self.actual {
            ActualRun::Responded => Some(self.response),
            ActualRun::Unbraked(_) | ActualRun::Driven(_) => None,
            ActualRun::Skidded(slowed) => Some(slowed),
        };
        AvoidCourse { speed: self.speed, response, driven: self.driven.clone() }
    }
}

/// Halvings after which a number is known to the last bit.
const MOST_HALVINGS: u32 = 60;

/// (m/s²) as good as no braking, and more than any vehicle has.
const LEAST_DECELERATION: f64 = 1e-6;
const MOST_DECELERATION: f64 = 1e3;

/// (s) nobody reacts later.
const LONGEST_REACTION: f64 = 100.0;

/// The last number for which it holds, between one that holds and one that does not.
fn last_that_holds(holds: impl Fn(f64) -> bool, [mut held, mut failed]: [f64; 2]) -> f64 {
    for _ in 0..MOST_HALVINGS {
        let middle = f64::midpoint(held, failed);
        if holds(middle) { held = middle } else { failed = middle }
    }
    held
}

/// (m/s) accuracy of a speed that just avoids the collision.
const TOLERANCE: f64 = 1e-10;

/// What the driver could have done.
pub(super) fn response(form: &AvoidForm) -> Result<Response, InvalidInput> {
    let swell = form.swell.as_ref().map_or(0.0, Quantity::si);
    Response::new(form.reaction_time.si(), swell, form.deceleration.si(), form.swell_form)
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
