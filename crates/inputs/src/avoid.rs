//! Whether the collision was avoidable: the table `[avoid]`.

use std::fmt::Display;
use std::sync::Arc;

use pim_core::{InvalidInput, VehicleId};
use recorder::SampledApproach;
use time_distance::{Advance, Swell};

use crate::after::PhaseForm;
use crate::choices;
use crate::quantity::Quantity;
use crate::scene::Place;
use crate::text::Text;
use crate::walk::{Element, Key, Walk};
use crate::way_out::ClearForm;

/// `avoid.vehicle`.
pub const SUBJECTS: [(&str, VehicleId); 2] = [("vehicle1", VehicleId::One), ("vehicle2", VehicleId::Two)];

/// `avoid.swell_form`.
pub const SWELLS: [(&str, Swell); 3] =
    [("linear", Swell::Linear), ("half", Swell::Half), ("full speed", Swell::FullSpeed)];

/// Whether the collision was avoidable: what the driver of one vehicle could have done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Avoid<T = f64> {
    /// The vehicle whose driver the question is about; vehicle 1 if absent.
    pub vehicle: Option<VehicleId>,
    /// (m/s) its speed at the reaction demand.
    pub speed: Option<Sourced<T>>,
    /// (m/s) the speed to ask about, such as the speed limit.
    pub limit: Option<Sourced<T>>,
    /// (s) from the demand to the first effect of the brakes.
    pub reaction_time: Option<Sourced<T>>,
    /// (s) from there to the full deceleration; 0 if absent.
    pub swell: Option<Sourced<T>>,
    /// How the deceleration grows in the swell; linearly if absent.
    pub swell_form: Option<Swell>,
    /// (m/s²) full deceleration, positive.
    pub deceleration: Option<Sourced<T>>,
    /// Where or when the danger could first be recognized.
    pub demand: Option<GivenDemand<T>>,
    /// The reason for the demand.
    pub demand_reason: Option<Text>,
    /// What remains of the other party's path out of the danger zone.
    pub clear: Option<Clear<T>>,
    /// What the other party is.
    pub other_party: Option<OtherParty>,
    /// Whether the vehicle is known not to have braked before the impact.
    pub unbraked: bool,
    /// The line of sight, if there are obstacles.
    pub sight: GivenSight<T>,
    /// What hides the other party.
    pub obstacles: Vec<Obstacle>,
}

/// The driver's line of sight to the other party: `[avoid.sight]`. All places are in the coordinates of the
/// scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenSight<T = f64> {
    /// The driver's eye at the impact; the position of the vehicle if absent.
    pub eye: Option<Place<T>>,
    /// (rad) direction of the vehicle's approach; its heading if absent.
    pub heading: Option<Sourced<T>>,
    /// The point of the other party that the driver sees, at the impact; the other party's position if
    /// absent.
    pub point: Option<Place<T>>,
    /// (rad) direction of the other party's approach; its heading if absent.
    pub other_heading: Option<Sourced<T>>,
    /// (m/s) speed of that approach; that of the demand, of `clear` or of its vehicle if absent.
    pub other_speed: Option<Sourced<T>>,
    /// Points of the path of the driver's eye to the impact, in order, in place of a heading. They are exact.
    pub path: Vec<Place>,
    /// The same for the other party.
    pub other_path: Vec<Place>,
}

impl<T> GivenSight<T> {
    /// Whether the case gives none of it.
    #[must_use]
    pub fn is_absent(&self) -> bool {
        let Self { eye, heading, point, other_heading, other_speed, path, other_path } = self;
        let is_placed = eye.is_some() || point.is_some() || !path.is_empty() || !other_path.is_empty();
        !is_placed && heading.is_none() && other_heading.is_none() && other_speed.is_none()
    }
}

/// Something that nobody sees through: an entry of `[[avoid.obstacle]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its name, such as "parked van".
    pub name: Option<Text>,
    /// The source of its corners.
    pub source: Option<Text>,
    /// Three or more corners in their order. They are exact.
    pub polygon: Vec<Place>,
}

/// A number with its unit and its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Sourced<T = f64> {
    /// The number.
    pub quantity: Quantity<T>,
    /// Its source.
    pub source: Option<Text>,
}

/// Where or when the danger could first be recognized, in numbers of type `N`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReactionDemand<N> {
    /// (m) distance of the vehicle before the impact.
    Distance(N),
    /// (s) time before the impact.
    Time(N),
    /// The time of the other party's approach.
    Other(PartyApproach<N>),
    /// The moment from which no obstacle hides the other party.
    Sight,
}

/// The approach of the other party: at constant speed, or from a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartyApproach<N> {
    /// (m) its distance to the place of the impact.
    pub distance: N,
    /// (m/s) its speed; with an acceleration, the speed that it then kept.
    pub speed: Option<N>,
    /// (m/s²) its acceleration from a stop.
    pub acceleration: Option<N>,
}

/// A [`ReactionDemand`] as given.
pub type GivenDemand<T = f64> = ReactionDemand<Sourced<T>>;
/// A [`ReactionDemand`] without the sources of its numbers.
pub type DemandForm<T = f64> = ReactionDemand<Quantity<T>>;
/// A [`PartyApproach`] as given.
pub type OtherApproach<T = f64> = PartyApproach<Sourced<T>>;
/// A [`PartyApproach`] without the sources of its numbers.
pub type OtherForm<T = f64> = PartyApproach<Quantity<T>>;

impl<N> ReactionDemand<N> {
    /// The same with other numbers, which come with their keys.
    pub(crate) fn map<M>(&self, mut of: impl FnMut(&'static str, &N) -> M) -> ReactionDemand<M> {
        match self {
            Self::Distance(distance) => ReactionDemand::Distance(of("distance", distance)),
            Self::Time(time) => ReactionDemand::Time(of("time", time)),
            Self::Other(PartyApproach { distance, speed, acceleration }) => {
                ReactionDemand::Other(PartyApproach {
                    distance: of("other.distance", distance),
                    speed: speed.as_ref().map(|speed| of("other.speed", speed)),
                    acceleration: acceleration.as_ref().map(|number| of("other.acceleration", number)),
                })
            }
            Self::Sight => ReactionDemand::Sight,
        }
    }
}

/// The way of the other party out of the danger zone.
#[derive(Clone, Debug, PartialEq)]
pub struct Clear<T = f64> {
    /// How far it still has to go.
    pub way: GivenWayOut<T>,
    /// (m/s) its speed. If absent, the speed of its approach, or that of its vehicle.
    pub speed: Option<Sourced<T>>,
}

/// How far the other party still has to go until it has left the danger zone.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenWayOut<T = f64> {
    /// (m) from its place at the impact, its own length or body included.
    Distance(Sourced<T>),
    /// Until its outline has left the strip that the vehicle sweeps.
    Outlines,
}

choices! {
    /// What the other party is.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum OtherParty {
        /// `"pedestrian"`.
        Pedestrian = "pedestrian",
        /// `"cyclist"`.
        Cyclist = "cyclist",
        /// `"vehicle"`.
        Vehicle = "vehicle",
    }
}

/// The inputs of the question whether the collision was avoidable, in numbers of any type.
#[derive(Clone, Debug, PartialEq)]
pub struct AvoidForm<T = f64> {
    /// The vehicle whose driver the question is about.
    pub vehicle: VehicleId,
    /// Its speed.
    pub speed: SpeedForm<T>,
    /// (m/s) the speed to ask about.
    pub limit: Quantity<T>,
    /// (s) from the demand to the first effect of the brakes.
    pub reaction_time: Quantity<T>,
    /// (s) from there to the full deceleration.
    pub swell: Option<Quantity<T>>,
    /// How the deceleration grows in the swell.
    pub swell_form: Swell,
    /// (m/s²) full deceleration.
    pub deceleration: Quantity<T>,
    /// Where or when the danger could first be recognized.
    pub demand: DemandForm<T>,
    /// The other party's way out of the danger zone.
    pub clear: Option<ClearForm<T>>,
    /// The vehicle's approach to the impact.
    pub braking: BrakingForm<T>,
    /// The line of sight, if there are obstacles.
    pub sight: Option<SightForm<T>>,
    /// The other vehicle's approach, if it moved along the same line.
    pub same_line: Option<SameLineForm<T>>,
}

/// The part of the question that the central values of a case settle for all samples.
#[derive(Clone, Debug, Default)]
pub struct AvoidBasis {
    /// The approaches that recorders stored: that of the vehicle asked about, and that of the other.
    pub(crate) recorded: [Option<Arc<SampledApproach>>; 2],
    /// Whether the other vehicle's recorder gives its speed at the impact, and its table does not.
    pub(crate) is_recorded: bool,
    /// How the other vehicle moved along the line of this one, if it did.
    pub(crate) along: Option<Along>,
}

choices! {
    /// The other vehicle's motion along the line of the vehicle asked about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Along {
        /// `"ahead"`: in the same direction.
        Ahead = "ahead",
        /// `"oncoming"`: towards it.
        Oncoming = "oncoming",
    }
}

/// A vehicle's direction of travel relative to the line of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffLine {
    /// In which direction along it.
    pub along: Along,
    /// (rad) the angle between the two lines, at most π/2.
    pub angle: f64,
}

/// The approach of the other party.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherMotionForm<T = f64> {
    /// (m/s) its speed at the impact; `None` if its phases, its recorder or the rest of the case give it.
    pub speed: Option<Quantity<T>>,
    /// How it moved before.
    pub braking: BrakingForm<T>,
}

impl OtherMotionForm {
    /// (m/s) the speed at the impact: as given, or else `sought`, the speed by the rest of the case; `None`
    /// if it is not known. It is 0 for phases that begin with a known speed, which lead to the speed at the
    /// impact.
    #[must_use]
    pub fn speed_at_impact(&self, sought: Option<f64>) -> Option<f64> {
        // A solution in which it moves backward means that it was at rest; a given speed is not changed.
        let known = self.speed.as_ref().map(Quantity::si).or(sought.map(|speed| speed.max(0.0)));
        known.or(self.braking.leads_on().then_some(0.0))
    }
}

impl<T: Copy> OtherMotionForm<T> {
    fn map<U>(&self, number: &mut impl FnMut(T) -> U) -> OtherMotionForm<U> {
        OtherMotionForm {
            speed: self.speed.map(|speed| speed.map(&mut *number)),
            braking: self.braking.map(number),
        }
    }
}

/// The other vehicle's approach along the line of the vehicle asked about.
#[derive(Clone, Debug, PartialEq)]
pub struct SameLineForm<T = f64> {
    /// In which direction.
    pub along: Along,
    /// How it moved.
    pub motion: OtherMotionForm<T>,
}

/// The line of sight, with every number that it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct SightForm<T = f64> {
    /// The driver's eye at the impact.
    pub eye: PlaceForm<T>,
    /// The path of the eye to that place.
    pub path: PathForm<T>,
    /// The point of the other party that the driver sees, at the impact.
    pub point: PlaceForm<T>,
    /// The path of that point.
    pub other_path: PathForm<T>,
    /// How the other party moves on it.
    pub other: OtherMotionForm<T>,
}

/// The path to a place at the impact.
#[derive(Clone, Debug, PartialEq)]
pub enum PathForm<T = f64> {
    /// (rad) straight, in this direction.
    Straight(Quantity<T>),
    /// (m) along points, in their order; straight between them, and before the first.
    Along(Arc<[[f64; 2]]>),
}

impl<T: Copy> PathForm<T> {
    fn map<U>(&self, mut of: impl FnMut(Quantity<T>) -> Quantity<U>) -> PathForm<U> {
        match self {
            Self::Straight(heading) => PathForm::Straight(of(*heading)),
            Self::Along(points) => PathForm::Along(points.clone()),
        }
    }
}

/// A place at the impact, and its source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaceForm<T = f64> {
    /// `[avoid.sight]` gives it.
    Given(Place<T>),
    /// The centre of gravity of the vehicle, which its table gives.
    Position(Place<T>),
    /// The contact point of `[scene]`.
    Contact(Place<T>),
    /// The origin of the scene, as nothing else is given.
    Origin,
}

impl<T: Copy> PlaceForm<T> {
    /// The place; `None` for the origin.
    #[must_use]
    pub fn place(&self) -> Option<&Place<T>> {
        match self {
            Self::Given(place) | Self::Position(place) | Self::Contact(place) => Some(place),
            Self::Origin => None,
        }
    }

    fn map<U>(self, of: impl FnMut(Quantity<T>) -> Quantity<U>) -> PlaceForm<U> {
        match self {
            Self::Given(at) => PlaceForm::Given(at.map_quantities(of)),
            Self::Position(at) => PlaceForm::Position(at.map_quantities(of)),
            Self::Contact(at) => PlaceForm::Contact(at.map_quantities(of)),
            Self::Origin => PlaceForm::Origin,
        }
    }
}

/// The source of the vehicle's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedForm<T = f64> {
    /// (m/s) at the reaction demand.
    AtDemand(Quantity<T>),
    /// (m/s) just before the impact.
    AtImpact(Quantity<T>),
    /// Just before the impact, as the phases before it determine it.
    ByPhases,
    /// Just before the impact, as the rest of the case determines it.
    Sought,
}

impl OtherForm {
    /// How it covers its path.
    #[must_use]
    pub fn advance(&self) -> Advance {
        let speed = self.speed.as_ref().map(Quantity::si);
        match &self.acceleration {
            Some(acceleration) => Advance::FromStop { acceleration: acceleration.si(), up_to: speed },
            None => Advance::Steady { speed: speed.unwrap_or_default() },
        }
    }

    /// (s) from the reaction demand to the impact.
    ///
    /// # Errors
    /// As [`Advance::time_over`].
    pub fn time(&self) -> Result<f64, InvalidInput> {
        self.advance().time_over(self.distance.si())
    }
}

/// The motion of a vehicle before the impact.
#[derive(Clone, Debug, PartialEq)]
pub enum BrakingForm<T = f64> {
    /// Nothing is known of it.
    Unknown,
    /// It did not brake.
    Unbraked,
    /// Its wheels skidded up to the impact.
    Skid {
        /// (m) length of the marks.
        length: Quantity<T>,
        /// (–) friction.
        friction: T,
    },
    /// In phases, in the order of time: the last ends at the impact.
    Phases(Vec<PhaseForm<T>>),
    /// As its recorder stored it.
    Recorded {
        /// The samples.
        approach: Arc<SampledApproach>,
        /// The error of their speeds.
        error: RecordedError,
    },
}

/// The error of recorded speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RecordedError {
    /// (–) the error that all speeds share, in standard deviations of what the speed at the impact leaves
    /// open.
    pub shared: f64,
    /// The random key of the rounding of each stored speed; `None` for speeds that are not rounded.
    pub rounding: Option<u64>,
}

impl<T> AvoidForm<T> {
    /// Whether the table of a recorder gives any of the approaches.
    #[must_use]
    pub fn is_recorded(&self) -> bool {
        let line = self.same_line.as_ref().map(|line| &line.motion.braking);
        let sight = self.sight.as_ref().map(|sight| &sight.other.braking);
        let mut ways = std::iter::once(&self.braking).chain(line).chain(sight);
        ways.any(|way| matches!(way, BrakingForm::Recorded { .. }))
    }

    /// Whether the other vehicle's speed at the impact is needed and not among the numbers.
    #[must_use]
    pub fn lacks_other_speed(&self) -> bool {
        let line = self.same_line.as_ref().map(|line| &line.motion);
        let sight = self.sight.as_ref().map(|sight| &sight.other);
        line.into_iter().chain(sight).any(|motion| motion.speed.is_none())
    }

    /// Sets the errors of the recorded speeds: of the vehicle, and of the other.
    pub fn with_errors(mut self, [own, other]: [RecordedError; 2]) -> Self {
        let line = self.same_line.as_mut().map(|line| (&mut line.motion.braking, other));
        let sight = self.sight.as_mut().map(|sight| (&mut sight.other.braking, other));
        for (way, errs) in std::iter::once((&mut self.braking, own)).chain(line).chain(sight) {
            if let BrakingForm::Recorded { error, .. } = way {
                *error = errs;
            }
        }
        self
    }
}

impl<T: Copy> AvoidForm<T> {
    /// The same with other numbers; `number` is called in the order of the fields.
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> AvoidForm<U> {
        let mut of = |quantity: Quantity<T>| quantity.map(&mut number);
        AvoidForm {
            vehicle: self.vehicle,
            speed: match self.speed {
                SpeedForm::AtDemand(speed) => SpeedForm::AtDemand(of(speed)),
                SpeedForm::AtImpact(speed) => SpeedForm::AtImpact(of(speed)),
                SpeedForm::ByPhases => SpeedForm::ByPhases,
                SpeedForm::Sought => SpeedForm::Sought,
            },
            limit: of(self.limit),
            reaction_time: of(self.reaction_time),
            swell: self.swell.map(&mut of),
            swell_form: self.swell_form,
            deceleration: of(self.deceleration),
            demand: self.demand.map(|_, number| of(*number)),
            clear: self.clear.as_ref().map(|clear| clear.map(&mut of)),
            sight: self.sight.as_ref().map(|sight| {
                let mut of = |quantity: Quantity<T>| quantity.map(&mut number);
                let [eye, point] = [sight.eye.map(&mut of), sight.point.map(&mut of)];
                let [path, other_path] = [sight.path.map(&mut of), sight.other_path.map(&mut of)];
                SightForm { eye, path, point, other_path, other: sight.other.map(&mut number) }
            }),
            braking: self.braking.map(&mut number),
            same_line: self
                .same_line
                .as_ref()
                .map(|line| SameLineForm { along: line.along, motion: line.motion.map(&mut number) }),
        }
    }
}

impl<T> BrakingForm<T> {
    /// Whether its phases begin with a known speed, and so determine the speed at the impact.
    #[must_use]
    pub fn leads_on(&self) -> bool {
        matches!(self, Self::Phases(phases) if phases.first().is_some_and(PhaseForm::leads_on))
    }
}

impl<T: Copy> BrakingForm<T> {
    fn map<U>(&self, number: &mut impl FnMut(T) -> U) -> BrakingForm<U> {
        match self {
            Self::Unknown => BrakingForm::Unknown,
            Self::Unbraked => BrakingForm::Unbraked,
            Self::Skid { length, friction } => {
                BrakingForm::Skid { length: length.map(&mut *number), friction: number(*friction) }
            }
            Self::Phases(phases) => {
                let mut of = |quantity: Quantity<T>| quantity.map(&mut *number);
                BrakingForm::Phases(phases.iter().map(|phase| phase.map(&mut of)).collect())
            }
            Self::Recorded { approach, error } => {
                BrakingForm::Recorded { approach: approach.clone(), error: *error }
            }
        }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn avoid(&mut self, avoid: &Avoid) -> Avoid<U> {
        let at = |key| Key(&"avoid", key);
        Avoid {
            vehicle: avoid.vehicle.map(|vehicle| self.choice(&at("vehicle"), &SUBJECTS, vehicle)),
            speed: self.sourced_if(&at("speed"), avoid.speed.as_ref()),
            limit: self.sourced_if(&at("limit"), avoid.limit.as_ref()),
            reaction_time: self.sourced_if(&at("reaction_time"), avoid.reaction_time.as_ref()),
            swell: self.sourced_if(&at("swell"), avoid.swell.as_ref()),
            swell_form: avoid.swell_form.map(|form| self.choice(&at("swell_form"), &SWELLS, form)),
            deceleration: self.sourced_if(&at("deceleration"), avoid.deceleration.as_ref()),
            demand: avoid.demand.as_ref().map(|demand| self.demand(&at("demand"), demand)),
            demand_reason: self.text(&"avoid.demand.reason", avoid.demand_reason.as_ref()),
            clear: avoid.clear.as_ref().map(|Clear { way, speed }| Clear {
                way: match way {
                    GivenWayOut::Distance(distance) => {
                        GivenWayOut::Distance(self.sourced(&Key(&at("clear"), "distance"), distance))
                    }
                    GivenWayOut::Outlines => {
                        self.flag(&Key(&at("clear"), "outlines"), true);
                        GivenWayOut::Outlines
                    }
                },
                speed: self.sourced_if(&Key(&at("clear"), "speed"), speed.as_ref()),
            }),
            other_party: avoid
                .other_party
                .map(|party| self.choice(&at("other_party"), &OtherParty::WORDS, party)),
            unbraked: self.flag(&at("unbraked"), avoid.unbraked),
            sight: self.sight(&at("sight"), &avoid.sight),
            obstacles: self.obstacles(&avoid.obstacles),
        }
    }

    fn sight(&mut self, path: &dyn Display, sight: &GivenSight) -> GivenSight<U> {
        let at = |key| Key(path, key);
        GivenSight {
            eye: sight.eye.as_ref().map(|eye| self.place(&at("eye"), eye)),
            heading: self.sourced_if(&at("heading"), sight.heading.as_ref()),
            point: sight.point.as_ref().map(|point| self.place(&at("point"), point)),
            other_heading: self.sourced_if(&at("other_heading"), sight.other_heading.as_ref()),
            other_speed: self.sourced_if(&at("other_speed"), sight.other_speed.as_ref()),
            path: self.path(&at("path"), &sight.path),
            other_path: self.path(&at("other_path"), &sight.other_path),
        }
    }

    fn path(&mut self, path: &dyn Display, points: &[Place]) -> Vec<Place> {
        self.exact_places(path, points);
        points.to_vec()
    }

    fn obstacles(&mut self, obstacles: &[Obstacle]) -> Vec<Obstacle> {
        for (index, Obstacle { name, source, polygon }) in obstacles.iter().enumerate() {
            let table = Element(&"avoid.obstacle", index);
            self.text(&Key(&table, "name"), name.as_ref());
            self.text(&Key(&table, "source"), source.as_ref());
            self.exact_places(&Key(&table, "polygon"), polygon);
        }
        obstacles.to_vec()
    }

    fn demand(&mut self, path: &dyn Display, demand: &GivenDemand) -> GivenDemand<U> {
        self.flag(&Key(path, "sight"), matches!(demand, GivenDemand::Sight));
        demand.map(|key, given| self.sourced(&Key(path, key), given))
    }

    fn sourced_if(&mut self, path: &dyn Display, sourced: Option<&Sourced>) -> Option<Sourced<U>> {
        sourced.map(|sourced| self.sourced(path, sourced))
    }

    fn sourced(&mut self, path: &dyn Display, Sourced { quantity, source }: &Sourced) -> Sourced<U> {
        Sourced {
            quantity: self.quantity(path, quantity),
            source: self.text(&Key(path, "source"), source.as_ref()),
        }
    }
}
