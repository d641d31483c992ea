//! What the question whether the collision was avoidable needs.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use pim_core::VehicleId;
use real::Real;
use reconcile::are_collinear;
use recorder::SampledApproach;
use trajectory::GREATEST_FRICTION;

use super::{Demand, table};
use crate::after::{PhaseForm, SkidBegin};
use crate::avoid::{
    Along, Avoid, AvoidBasis, AvoidForm, BrakingForm, Clear, GivenDemand, GivenWayOut, OffLine,
    OtherMotionForm, PathForm, PlaceForm, RecordedError, SameLineForm, SightForm, Sourced, SpeedForm,
};
use crate::case::Case;
use crate::fault::Faults;
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::scene::Place;
use crate::units::STANDARD_GRAVITY;
use crate::vehicle::GivenVehicle;
use crate::way_out::{ClearForm, ClearSpeedForm, OutlinesForm, PlacesForm, WayOutForm};

/// What to write for a reaction time; none is assumed, as none is right for every driver and danger.
const REACTION: &str = "`reaction_time`, as in reaction_time = { low = \"0.7 s\", high = \"1.4 s\", source = \"Dettinger 2008, with all of the swell\" } \
     or { value = \"1.25 s\", sd = \"0.46 s\", source = \"brake lamps in traffic, Ergonomics 1993\" }; 1.5 s and 2.5 s (AASHTO) are conventions, \
     and the template \"avoid\" lists more choices with their sources";
/// The same for a deceleration.
const DECELERATION: &str = "`deceleration`, as in deceleration = { value = \"7.5 m/s^2\", source = \"…\" }: the friction of the ground times g where \
     the wheels lock or ABS works, about 6 to 8 m/s^2 on dry asphalt (EDCRASH manual: friction 0.55 to 0.80 where it is travelled)";
const DEMAND: &str = "`demand`, where or when the danger could first be recognized: demand = { distance = \"30 m\" } of this vehicle before \
     the impact, { time = \"2.1 s\" }, by the approach of the other party { other = { distance = \"4 m\", speed = \"1.5 m/s\" } }, \
     or by what hides it: { sight = true }";
const OBSTACLE: &str = "`[[avoid.obstacle]]`, what hides the other party, as in polygon = [{ x = \"-8 m\", y = \"-1.8 m\" }, \
     { x = \"-3 m\", y = \"-1.8 m\" }, { x = \"-3 m\", y = \"-3.8 m\" }]; without one, give `demand` by distance or time";
const LIMIT: &str =
    "`limit`, the speed to ask about, as in limit = { value = \"50 km/h\", source = \"built-up area\" }";

/// The sine of 5°: two vehicles whose headings differ by less travel along one line.
const LEAST_SINE: f64 = 0.087;

impl Case {
    /// The numbers of `[avoid]`, with every number that the question needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn avoidance(&self) -> Result<AvoidForm, Faults> {
        let mut demand =
            Demand { case: self, purpose: Purpose::Avoid, is_of_point_masses: false, faults: Vec::new() };
        let Some(avoid) = &self.avoid else {
            demand.missing("avoid", "the table `[avoid]`, as in the template \"avoid\"");
            return demand.finish(None);
        };
        demand.of_speed(avoid);
        let form = self.avoid_form(&self.avoid_basis());
        demand.lacks([
            (avoid.limit.is_some(), "avoid.limit", LIMIT),
            (avoid.reaction_time.is_some(), "avoid.reaction_time", REACTION),
            (avoid.deceleration.is_some(), "avoid.deceleration", DECELERATION),
            (avoid.demand.is_some(), "avoid.demand", DEMAND),
        ]);
        demand.of_deceleration(avoid);
        demand.of_unbraked(avoid);
        demand.of_skid(avoid);
        demand.of_phases(avoid);
        demand.of_clear(avoid);
        demand.of_sight(avoid);
        demand.finish(form)
    }

    /// Both approaches, seen from above; `None` if the case does not give all of them.
    #[must_use]
    pub fn avoid_plan(&self) -> Option<SightForm> {
        self.sight_form(self.avoid.as_ref()?, &self.avoid_basis())
    }

    /// The part of the question that the central values settle.
    #[must_use]
    pub fn avoid_basis(&self) -> AvoidBasis {
        let (subject, ground) = (self.avoid_subject(), self.ground_friction());
        let recorded = |vehicle: VehicleId| {
            let recorder = self.vehicles[vehicle.index()].recorder.as_ref()?;
            // The reader of a case refuses errors out of their range.
            let stored = recorder.before_impact()?;
            SampledApproach::of(stored, &recorder.speed_errors(ground)).ok().map(Arc::new)
        };
        // A speed at the demand takes the place of the vehicle's own table.
        let has_own = self.avoid.as_ref().is_none_or(|avoid| avoid.speed.is_some());
        let own = if has_own { None } else { recorded(subject) };
        let other = subject.other();
        let recorder = self.vehicles[other.index()].recorder.as_ref();
        let tells_speed = recorder.is_some_and(|recorder| recorder.tells_speed(ground).is_some());
        AvoidBasis {
            recorded: [own, recorded(other)],
            is_recorded: tells_speed && self.known_speed(other).is_none(),
            along: self.other_along(),
        }
    }

    /// How the other vehicle moved along the line of the vehicle asked about, if their headings show that it
    /// did.
    #[must_use]
    pub fn other_along(&self) -> Option<Along> {
        let off = self.off_the_line()?;
        are_collinear(off.angle).then_some(off.along)
    }

    /// The other vehicle's direction of travel relative to that line, if both headings are known.
    #[must_use]
    pub fn off_the_line(&self) -> Option<OffLine> {
        let angle = self.approach_angle()?;
        Some(if angle < FRAC_PI_2 {
            OffLine { along: Along::Ahead, angle }
        } else {
            OffLine { along: Along::Oncoming, angle: PI - angle }
        })
    }
}

impl<T: Copy + From<f64>> Case<T> {
    /// The numbers of `[avoid]`, with what the central values settle; `None` if some are missing, which
    /// [`avoidance`](Case::avoidance) reports.
    #[must_use]
    pub fn avoid_form(&self, basis: &AvoidBasis) -> Option<AvoidForm<T>> {
        let of = |sourced: &Option<Sourced<T>>| sourced.as_ref().map(|sourced| sourced.quantity);
        let avoid = self.avoid.as_ref()?;
        let vehicle = self.avoid_subject();
        let [own, _] = &basis.recorded;
        let braking = if avoid.unbraked { BrakingForm::Unbraked } else { self.braking_form(vehicle, own)? };
        let demand = avoid.demand.as_ref()?.map(|_, given| given.quantity);
        let has_obstacle = !avoid.obstacles.is_empty();
        let sight = if has_obstacle { Some(self.sight_form(avoid, basis)?) } else { None };
        let clear = match &avoid.clear {
            Some(clear) => Some(ClearForm {
                way: match &clear.way {
                    GivenWayOut::Distance(distance) => WayOutForm::Distance(distance.quantity),
                    GivenWayOut::Outlines => WayOutForm::Outlines(Box::new(self.outlines_form()?)),
                },
                speed: self.clear_speed(avoid, clear)?,
            }),
            None => None,
        };
        Some(AvoidForm {
            vehicle,
            speed: self.avoid_speed(),
            limit: of(&avoid.limit)?,
            reaction_time: of(&avoid.reaction_time)?,
            swell: of(&avoid.swell),
            swell_form: avoid.swell_form.unwrap_or_default(),
            deceleration: of(&avoid.deceleration)?,
            demand,
            clear,
            braking,
            sight,
            same_line: self.same_line_form(basis),
        })
    }

    /// The approach of a vehicle, with what its recorder stored; `None` if a number is missing.
    fn braking_form(
        &self,
        vehicle: VehicleId,
        recorded: &Option<Arc<SampledApproach>>,
    ) -> Option<BrakingForm<T>> {
        let of_vehicle = &self.vehicles[vehicle.index()];
        Some(match (of_vehicle.phases(), recorded, of_vehicle.skid()) {
            (phases @ [_, ..], ..) => BrakingForm::Phases(phases.iter().map(|phase| phase.form).collect()),
            (_, Some(approach), _) => {
                BrakingForm::Recorded { approach: approach.clone(), error: RecordedError::default() }
            }
            (_, None, Some(skid)) => {
                let SkidBegin::Length(length) = skid.begin else { return None };
                BrakingForm::Skid { length, friction: skid.friction.or(self.ground_friction())? }
            }
            (_, None, None) => BrakingForm::Unknown,
        })
    }

    /// The other vehicle's approach, if it moved along the same line.
    fn same_line_form(&self, basis: &AvoidBasis) -> Option<SameLineForm<T>> {
        Some(SameLineForm { along: basis.along?, motion: self.vehicle_motion(basis)? })
    }

    /// The other vehicle's approach by its table; `None` if its speed or a number of its braking is not
    /// known.
    fn vehicle_motion(&self, basis: &AvoidBasis) -> Option<OtherMotionForm<T>> {
        let other = self.avoid_subject().other();
        let of_other = &self.vehicles[other.index()];
        if of_other.fixed || of_other.is_absent() {
            return None;
        }
        let [_, recorded] = &basis.recorded;
        let speed = self.known_speed(other).copied();
        let braking = self.braking_form(other, recorded)?;
        let is_sought = matches!(self.avoid_speed(), SpeedForm::Sought);
        let is_told = speed.is_some() || is_sought || basis.is_recorded || braking.leads_on();
        is_told.then_some(OtherMotionForm { speed, braking })
    }

    /// Both vehicles at the impact, seen from above; `None` if the case does not give all of it.
    fn outlines_form(&self) -> Option<OutlinesForm<T>> {
        let parties = self.avoid_parties();
        let [Some(first), Some(second)] = parties.map(|vehicle| vehicle.heading) else { return None };
        let [Some(one), Some(two)] = parties.map(GivenVehicle::body) else { return None };
        // Surveyed positions come first: the line of sight starts from them, too.
        let places = match (parties.map(|vehicle| vehicle.position), parties.map(|vehicle| vehicle.contact)) {
            ([Some(one), Some(two)], _) => PlacesForm::Positions([one, two]),
            (_, [Some(one), Some(two)]) => PlacesForm::Contacts([one, two]),
            _ => return None,
        };
        Some(OutlinesForm { headings: [first, second], bodies: [one, two], places })
    }

    /// The speed of the other party on its way out; `None` if nothing gives it.
    fn clear_speed(&self, avoid: &Avoid<T>, clear: &Clear<T>) -> Option<ClearSpeedForm<T>> {
        let subject = self.avoid_subject();
        let [_, other] = self.avoid_parties();
        match (&clear.speed, &avoid.demand, self.known_speed(subject.other())) {
            (Some(speed), ..) => Some(ClearSpeedForm::Steady(speed.quantity)),
            (None, Some(GivenDemand::Other(_)), _) => Some(ClearSpeedForm::AsItCame),
            (None, _, Some(speed)) => Some(ClearSpeedForm::Steady(*speed)),
            _ if let Some(phases) = self.leading_phases(subject.other()) => {
                Some(ClearSpeedForm::Phases(phases))
            }
            _ if other.is_absent() || other.fixed => None,
            // An analysis that finds one speed also finds the other.
            _ => matches!(self.avoid_speed(), SpeedForm::Sought).then_some(ClearSpeedForm::Sought),
        }
    }

    /// The phases of a vehicle, if they begin with a known speed and so determine the speed at the impact.
    fn leading_phases(&self, vehicle: VehicleId) -> Option<Vec<PhaseForm<T>>> {
        let forms: Vec<_> = self.vehicles[vehicle.index()].phases().iter().map(|phase| phase.form).collect();
        forms.first().is_some_and(PhaseForm::leads_on).then_some(forms)
    }

    /// The eye and the point at the impact, each if the case gives it. If a vehicle has a surveyed position,
    /// the origin is only that of the survey, and nothing is there.
    fn sight_places(&self, avoid: &Avoid<T>) -> [Option<PlaceForm<T>>; 2] {
        let [subject, other] = self.avoid_parties();
        let is_surveyed = subject.position.is_some() || other.position.is_some();
        let place = |given: Option<Place<T>>, of: &GivenVehicle<T>| {
            let known = given.map(PlaceForm::Given).or(of.position.map(PlaceForm::Position));
            let known = known.or(self.scene_contact.map(PlaceForm::Contact));
            known.or((!is_surveyed).then_some(PlaceForm::Origin))
        };
        [place(avoid.sight.eye, subject), place(avoid.sight.point, other)]
    }

    fn sight_form(&self, avoid: &Avoid<T>, basis: &AvoidBasis) -> Option<SightForm<T>> {
        let [eye, point] = self.sight_places(avoid);
        let [path, other_path] = self.sight_paths(avoid);
        Some(SightForm {
            eye: eye?,
            path: path?,
            point: point?,
            other_path: other_path?,
            other: self.other_motion(avoid, basis)?,
        })
    }

    /// The vehicle that `[avoid]` asks about, and the other one.
    fn avoid_parties(&self) -> [&GivenVehicle<T>; 2] {
        let subject = self.avoid_subject();
        [subject, subject.other()].map(|of| &self.vehicles[of.index()])
    }

    /// The paths of both to the impact.
    fn sight_paths(&self, avoid: &Avoid<T>) -> [Option<PathForm<T>>; 2] {
        let [subject, other] = self.avoid_parties();
        let of = |points: &[Place], given: &Option<Sourced<T>>, vehicle: &GivenVehicle<T>| {
            if points.is_empty() {
                let heading = given.as_ref().map(|given| given.quantity).or(vehicle.heading);
                heading.map(PathForm::Straight)
            } else {
                Some(PathForm::Along(points.iter().map(|point| [point.x.si(), point.y.si()]).collect()))
            }
        };
        let sight = &avoid.sight;
        [of(&sight.path, &sight.heading, subject), of(&sight.other_path, &sight.other_heading, other)]
    }

    /// The motion of the other party: at the constant speed that `[avoid]` gives for it, or else as its table
    /// gives it, or else at the speed of `clear`.
    fn other_motion(&self, avoid: &Avoid<T>, basis: &AvoidBasis) -> Option<OtherMotionForm<T>> {
        // A party that starts from a stop has no single speed.
        let of_demand = match &avoid.demand {
            Some(GivenDemand::Other(other)) if other.acceleration.is_none() => other.speed.as_ref(),
            _ => None,
        };
        let of_clear = avoid.clear.as_ref().and_then(|clear| clear.speed.as_ref());
        let given = avoid.sight.other_speed.as_ref().or(of_demand);
        let steady = |given: &Sourced<T>| OtherMotionForm {
            speed: Some(given.quantity),
            braking: BrakingForm::Unknown,
        };
        // Without a collision in the case, no evidence gives the speed that its table leaves open.
        let is_told = |motion: &OtherMotionForm<T>| {
            let by_table = motion.speed.is_some() || basis.is_recorded || motion.braking.leads_on();
            by_table || of_clear.is_none() || self.impact.is_some() || self.reconstruct.is_some()
        };
        let of_vehicle = || self.vehicle_motion(basis).filter(is_told);
        given.map(steady).or_else(of_vehicle).or_else(|| of_clear.map(steady))
    }
}

impl Demand<'_, f64> {
    /// Refuses a deceleration that no vehicle reaches.
    fn of_deceleration(&mut self, avoid: &Avoid) {
        let Some(given) = avoid.deceleration.as_ref() else { return };
        let share = given.quantity.si() / STANDARD_GRAVITY;
        if share > GREATEST_FRICTION {
            let reason = format!(
                "no vehicle brakes with {share:.1} g: [avoid] takes a deceleration of at most {GREATEST_FRICTION} g, \
                 {:.1} m/s^2",
                GREATEST_FRICTION * STANDARD_GRAVITY
            );
            let advice = "check the unit and the decimal point: cars on dry asphalt reach 7 to 10 m/s^2";
            self.refuse("avoid.deceleration", reason, advice);
        }
    }

    fn of_speed(&mut self, avoid: &Avoid) {
        let vehicle = self.case.avoid_subject();
        let given = &self.case.vehicles[vehicle.index()];
        let table = table(vehicle);
        if given.fixed {
            let advice =
                format!("name the vehicle that moved, as in vehicle = \"{}\"", super::table(vehicle.other()));
            self.refuse("avoid.vehicle", format!("[avoid] asks about [{table}], which is fixed"), advice);
            return;
        }
        let other = super::table(vehicle.other());
        let is_described = !self.case.vehicles[vehicle.other().index()].is_absent();
        if avoid.vehicle.is_none() && given.is_absent() && is_described {
            let reason = format!("[avoid] asks about [{table}], but the case has only [{other}]");
            let advice = format!(
                "write vehicle = \"{other}\" in [avoid], or vehicle = \"{table}\" if the question is about the vehicle that the \
                 case does not describe"
            );
            self.refuse("avoid", reason, advice);
            return;
        }
        let sought = self.case.reconstruct.is_some_and(|reconstruct| reconstruct.find.seeks(vehicle));
        match (self.case.avoid_speed(), &given.motion) {
            (SpeedForm::AtDemand(_), Some(_)) if !sought => {
                let reason = format!(
                    "the speed of [{table}] is given twice: here at the reaction demand, and in [{table}] at the impact"
                );
                let advice = "remove one of the two; with the speed at the impact, `skid` of its table `before` gives that at the demand";
                self.refuse("avoid.speed", reason, advice);
            }
            (SpeedForm::Sought, Some(_)) if !sought => {
                let reason = format!("[avoid] needs the speed of [{table}] as one number");
                let advice =
                    format!("write `speed` in [{table}] in place of `velocity`, or `speed` in [avoid]");
                self.refuse(format_args!("{table}.velocity"), reason, advice);
            }
            (SpeedForm::Sought, None)
                if given.recorder.as_ref().is_some_and(|recorder| recorder.before_impact().is_some()) => {}
            (SpeedForm::Sought, None) if given.is_absent() => {
                self.missing(
                    "avoid.speed",
                    "`speed` in [avoid], the speed at the reaction demand, as in speed = \"62 km/h\"; or \
                     describe the vehicle, so that its damage or marks give the speed",
                );
            }
            _ => {}
        }
        if let SpeedForm::AtDemand(speed) | SpeedForm::AtImpact(speed) = self.case.avoid_speed()
            && speed.number() <= 0.0
            && avoid.speed.is_none()
        {
            let reason = format!(
                "[{table}] did not move forward at the impact, so its driver could not have avoided it by braking"
            );
            let advice = format!("ask about the other: vehicle = \"{}\"", super::table(vehicle.other()));
            self.refuse(format_args!("{table}.speed"), reason, advice);
        }
    }

    /// Refuses `unbraked` beside anything that shows how the vehicle came.
    fn of_unbraked(&mut self, avoid: &Avoid) {
        if !avoid.unbraked {
            return;
        }
        let vehicle = self.case.avoid_subject();
        let given = &self.case.vehicles[vehicle.index()];
        let has_table = given.recorder.as_ref().is_some_and(|recorder| recorder.pre_crash.is_some());
        for (is_given, key, what) in [
            (given.skid().is_some(), "before.skid", "its table `before` has skid marks"),
            (!given.phases().is_empty(), "before.phase", "phases before the impact say how it came"),
            // A speed in `[avoid]` replaces the table.
            (
                has_table && avoid.speed.is_none(),
                "recorder.pre_crash",
                "the table of its recorder shows how it came",
            ),
        ] {
            if is_given {
                let reason = format!("`unbraked` says that the vehicle did not brake, but {what}");
                self.refuse("avoid.unbraked", reason, format!("remove it, or `{}.{key}`", table(vehicle)));
            }
        }
    }

    /// Refuses a skid that lacks a number, if it says how the vehicle came: a recorder's table comes first.
    fn of_skid(&mut self, avoid: &Avoid) {
        let vehicle = self.case.avoid_subject();
        let given = &self.case.vehicles[vehicle.index()];
        let has_table = given.recorder.as_ref().is_some_and(|recorder| recorder.pre_crash.is_some());
        let Some(skid) = given.skid().filter(|_| !has_table || avoid.speed.is_some()) else { return };
        let path = format!("{}.before.skid", table(vehicle));
        if matches!(skid.begin, SkidBegin::From(_)) {
            let reason = "[avoid] needs the length of the skid, not the place where it began";
            self.refuse(&path, reason, "write skid = { length = \"18 m\", friction = 0.7 }");
        }
        if skid.friction.is_none() && self.case.surface.is_none() {
            self.missing(format_args!("{path}.friction"), "`friction` of the skid, or that of [surface]");
        }
    }

    /// Refuses phases beside other data on how the vehicle came, and phases that leave a number open.
    fn of_phases(&mut self, avoid: &Avoid) {
        let vehicle = self.case.avoid_subject();
        let given = &self.case.vehicles[vehicle.index()];
        let table = table(vehicle);
        let Some(first) = given.phases().first() else { return };
        let [path, skid] = ["phase", "skid"].map(|key| format!("{table}.before.{key}"));
        for (is_given, key, what) in [
            (avoid.speed.is_some(), "avoid.speed", "the speed at the reaction demand is given here"),
            (given.skid().is_some(), &skid, "a skid says how the vehicle came"),
        ] {
            if is_given {
                let reason = format!("{what}, and so do the phases before the impact");
                self.refuse(key, reason, format!("remove it, or the tables [[{path}]]"));
            }
        }
        let leads_on = first.form.leads_on();
        let is_sought = self.case.reconstruct.is_some_and(|reconstruct| reconstruct.find.seeks(vehicle));
        if leads_on && (is_sought || given.motion.is_some()) {
            let reason = format!(
                "the first phase gives the speed at the impact, and so does [{}]",
                if is_sought { "reconstruct" } else { table }
            );
            let advice = "remove `speed`, `distance` or `time` from the first phase: the program then works back \
                          through the phases from the speed at the impact";
            self.refuse(format_args!("{path}[1]"), reason, advice);
        }
        for (index, phase) in given.phases().iter().enumerate() {
            let (count, has_speed) = (phase.form.given(), phase.form.speed.is_some());
            let is_complete = match (leads_on, index) {
                (true, 0) => true,
                (true, _) => count == 2 && !has_speed,
                (false, _) => count == 2,
            };
            if is_complete {
                continue;
            }
            let reason = if leads_on {
                "the first phase gives the speed at its end, so this phase needs two of `distance`, `time` and `acceleration`, \
                 and no `speed`"
            } else {
                "a phase needs two of `distance`, `time`, `acceleration` and `speed`, the speed where it begins"
            };
            let advice = "as in { distance = \"12 m\", acceleration = \"-4 m/s^2\" }; the first phase may have `speed` and two more \
                          if nothing else gives the speed at the impact, such as { speed = \"0 km/h\", acceleration = \"1.5 m/s^2\", \
                          distance = \"7.7 m\" }";
            self.refuse(format_args!("{path}[{}]", index + 1), reason, advice);
        }
    }

    fn of_clear(&mut self, avoid: &Avoid) {
        let Some(clear) = &avoid.clear else { return };
        if self.case.clear_speed(avoid, clear).is_none() {
            self.missing(
                "avoid.clear.speed",
                "`speed`, the other party's speed on its way out, as in speed = \"1.4 m/s\". You can leave it out only \
                 if `demand` gives the other party's approach as `other`, if the table of its vehicle gives its speed, or \
                 if the speed of the vehicle that you ask about is to be found, too",
            );
        }
        if clear.way == GivenWayOut::Outlines {
            self.of_outlines();
        }
    }

    fn of_outlines(&mut self) {
        let case = self.case;
        let subject = case.avoid_subject();
        let mut lacks = false;
        for vehicle in [subject, subject.other()] {
            let (given, table) = (&case.vehicles[vehicle.index()], table(vehicle));
            for (is_given, key, example) in [
                (given.heading.is_some(), "heading", "`heading`, as in heading = \"90 deg\""),
                (
                    given.body().is_some(),
                    "length",
                    "`length`, `width` and `cg_to_front`, or its `class`, for its outline",
                ),
                (
                    given.contact.is_some() || given.position.is_some(),
                    "contact",
                    "`contact`, where it touches the other, as in contact = { x = \"1.9 m\", y = \"0.2 m\" }, or `position`",
                ),
            ] {
                if !is_given {
                    self.missing(format_args!("{table}.{key}"), example);
                    lacks = true;
                }
            }
            if given.sideslip.is_some() {
                let reason = format!(
                    "[{table}] does not travel along its heading, so that `outlines` cannot say when it is out of the zone"
                );
                let advice = "give `distance` in place of `outlines`";
                self.refuse("avoid.clear.outlines", reason, advice);
                return;
            }
        }
        if lacks {
            return;
        }
        let Some(form) = case.outlines_form() else {
            self.missing(
                format_args!("{}.contact", table(subject)),
                "`contact` of both vehicles, or `position` of both: one of each does not give their positions",
            );
            return;
        };
        let [first, second] = form.headings.each_ref().map(Quantity::si);
        let apart = Real::sin_cos(second - first).0.abs();
        if apart < LEAST_SINE {
            let reason = "both vehicles travel nearly along one line, so that the other does not leave the strip that this one \
                          sweeps";
            let advice = "give `distance` in place of `outlines`, or leave `clear` out";
            self.refuse("avoid.clear.outlines", reason, advice);
        }
    }

    fn of_sight(&mut self, avoid: &Avoid) {
        if avoid.obstacles.is_empty() {
            if matches!(avoid.demand, Some(GivenDemand::Sight)) {
                self.missing("avoid.obstacle", OBSTACLE);
            }
            if avoid.sight.is_absent() {
                return;
            }
        }
        let [eye, point] = self.case.sight_places(avoid);
        let [path, other_path] = self.case.sight_paths(avoid);
        let basis = self.case.avoid_basis();
        let motion = self.case.other_motion(avoid, &basis);
        if let Some(form) = self.case.sight_form(avoid, &basis) {
            for (key, end, place, path) in [
                ("avoid.sight.path", "eye", &form.eye, &form.path),
                ("avoid.sight.other_path", "point", &form.point, &form.other_path),
            ] {
                let end_at = place.place().map_or([0.0; 2], |place| [place.x.si(), place.y.si()]);
                if matches!(path, PathForm::Along(points) if points.iter().all(|point| *point == end_at)) {
                    let reason = format!("all points of the path are at its end, `{end}`");
                    let advice = format!(
                        "give places that were passed before, in their order; the last is `{end}` itself and not listed"
                    );
                    self.refuse(key, reason, advice);
                }
            }
        }
        self.lacks([
            (
                eye.is_some(),
                "avoid.sight.eye",
                "where the driver's eye is at the impact, in the coordinates of the other vehicle's `position`, \
                 as in eye = { x = \"98.1 m\", y = \"50.4 m\" }, or `position` of the vehicle, or `contact` of [scene]",
            ),
            (
                point.is_some(),
                "avoid.sight.point",
                "what the driver sees first of the other party, where it is at the impact, in the coordinates of \
                 the vehicle's `position`, as in point = { x = \"101 m\", y = \"50 m\" }, or `position` of the other \
                 vehicle, or `contact` of [scene]",
            ),
            (
                path.is_some(),
                "avoid.sight.heading",
                "`heading`, the direction in which the vehicle drives, as in heading = \"0 deg\"",
            ),
            (
                other_path.is_some(),
                "avoid.sight.other_heading",
                "`other_heading`, the direction in which the other party moves, as in other_heading = \"90 deg\"",
            ),
            (
                motion.is_some(),
                "avoid.sight.other_speed",
                "`other_speed`, how fast the other party moves, as in other_speed = \"1.5 m/s\"",
            ),
        ]);
    }

    /// Reports the keys that are not given, with what to give.
    fn lacks(&mut self, keys: impl IntoIterator<Item = (bool, &'static str, &'static str)>) {
        for (_, key, example) in keys.into_iter().filter(|(is_given, ..)| !is_given) {
            self.missing(key, example);
        }
    }
}
