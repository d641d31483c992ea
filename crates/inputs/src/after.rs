//! The motion of a vehicle before and after the impact: the tables `[vehicleN.before]` and
//! `[vehicleN.after]`.

use std::fmt::Display;

use crate::choices;
use crate::quantity::Quantity;
use crate::scene::Place;
use crate::text::Text;
use crate::walk::{Element, Key, Walk};

/// Between impact and rest: how the vehicle could roll, its path, and how it left the impact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct After<T = f64> {
    /// (–) coefficient of friction on its path, outside all zones, in place of that of the surface.
    pub friction: Option<T>,
    /// The rolling resistance of its wheels.
    pub drag: Option<Drag<T>>,
    /// How its front wheels are steered; straight if absent.
    pub steer: Option<GivenSteer<T>>,
    /// Its rest position.
    pub rest: Option<GivenRest<T>>,
    /// Points that its centre of gravity passed, from impact to rest.
    pub points: Vec<PathPoint<T>>,
    /// (m/s) speed of the centre of gravity after the impact.
    pub speed: Option<Quantity<T>>,
    /// (rad) scene angle of its velocity after the impact, in the sense of the axes.
    pub direction: Option<Quantity<T>>,
    /// (rad/s) yaw rate after the impact, in the sense of the axes.
    pub yaw_rate: Option<Quantity<T>>,
}

/// The drag of the wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drag<T = f64> {
    /// The same at every wheel.
    Every(WheelDrag<T>),
    /// Front left, front right, rear left, rear right.
    Each([WheelDrag<T>; 4]),
}

impl<T: Copy> Drag<T> {
    /// The drag of each wheel: front left, front right, rear left, rear right.
    #[must_use]
    pub fn wheels(&self) -> [WheelDrag<T>; 4] {
        match self {
            Self::Every(drag) => [*drag; 4],
            Self::Each(wheels) => *wheels,
        }
    }
}

/// The drag of a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WheelDrag<T = f64> {
    /// `"locked"`: it does not turn, and slides.
    Locked,
    /// (–) force that resists its rolling, as a share of the load on it; zero or more.
    Share(T),
}

impl WheelDrag {
    /// The word for the drag that has no number.
    pub const WORDS: [(&str, Self); 1] = [("locked", Self::Locked)];
}

/// How the front wheels are steered.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenSteer<T = f64> {
    /// (rad) angle from the vehicle's axis, in the sense of the axes.
    Held(Quantity<T>),
    /// Linear between these points, and constant outside them; at least one.
    Over(Vec<SteerPoint<T>>),
}

/// The steer angle at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteerPoint<T = f64> {
    /// (s) since the impact.
    pub time: Quantity<T>,
    /// (rad) angle from the vehicle's axis, in the sense of the axes.
    pub angle: Quantity<T>,
}

/// The rest position of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenRest<T = f64> {
    /// The position of its centre of gravity.
    pub place: Place<T>,
    /// Its orientation there.
    pub heading: RestHeading<T>,
}

// In the order of a vehicle's wheels.
choices! {
    /// A wheel that left a mark.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MarkedWheel {
        /// `"front left"`.
        FrontLeft = "front left",
        /// `"front right"`.
        FrontRight = "front right",
        /// `"rear left"`.
        RearLeft = "rear left",
        /// `"rear right"`.
        RearRight = "rear right",
    }
}

/// A point that the centre of gravity of a vehicle passed, or one of its wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint<T = f64> {
    /// The place.
    pub place: Place<T>,
    /// (rad) scene angle of its forward axis there, in the sense of the axes, if marks show it: at the end of
    /// its rotation, that of the rest position.
    pub heading: Option<Quantity<T>>,
    /// The wheel that passed there, if the point is on its mark.
    pub wheel: Option<MarkedWheel>,
}

/// The orientation of a vehicle at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestHeading<T = f64> {
    /// (rad) scene angle of its forward axis, in the sense of the axes. The number and the direction of its
    /// turns are unknown.
    Heading(Quantity<T>),
    /// (rad) its rotation since the impact, full turns included, in the sense of the axes.
    Turned(Quantity<T>),
}

/// Before the impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Before<T = f64> {
    /// The marks of its locked wheels, up to the impact.
    pub skid: Option<Skid<T>>,
    /// (m/s) speed at their start, as given by a recorder, a tachograph or a camera.
    pub speed: Option<Quantity<T>>,
    /// How it moved, in the order of time: the last phase ends at the impact.
    pub phases: Vec<GivenPhase<T>>,
}

/// A stretch of constant acceleration before the impact: an entry of `[[vehicle1.before.phase]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenPhase<T = f64> {
    /// Its numbers.
    pub form: PhaseForm<T>,
    /// The source of these numbers.
    pub source: Option<Text>,
}

/// The numbers of such a stretch: two of them determine the others once the speed at its end is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseForm<T = f64> {
    /// (m) its length.
    pub distance: Option<Quantity<T>>,
    /// (s) how long it lasts.
    pub time: Option<Quantity<T>>,
    /// (m/s) the speed where it begins.
    pub speed: Option<Quantity<T>>,
    /// (m/s²) acceleration, negative where the vehicle brakes.
    pub acceleration: Option<Quantity<T>>,
}

impl<T> PhaseForm<T> {
    /// How many of its numbers are given.
    #[must_use]
    pub fn given(&self) -> usize {
        let Self { distance, time, speed, acceleration } = self;
        [distance, time, speed, acceleration].into_iter().filter(|number| number.is_some()).count()
    }

    /// Whether the speed at its beginning and two more of its numbers are given, which determine the speed at
    /// its end.
    #[must_use]
    pub fn leads_on(&self) -> bool {
        self.speed.is_some() && self.given() == 3
    }

    /// The same with other numbers; `of` is called in the order of the fields.
    pub fn map<U>(self, mut of: impl FnMut(Quantity<T>) -> Quantity<U>) -> PhaseForm<U> {
        let Self { distance, time, speed, acceleration } = self;
        PhaseForm {
            distance: distance.map(&mut of),
            time: time.map(&mut of),
            speed: speed.map(&mut of),
            acceleration: acceleration.map(&mut of),
        }
    }
}

/// Skid marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skid<T = f64> {
    /// Their length.
    pub begin: SkidBegin<T>,
    /// (–) coefficient of friction there; that of the surface if absent.
    pub friction: Option<T>,
}

/// How the case gives the length of skid marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SkidBegin<T = f64> {
    /// (m) from their start to the impact.
    Length(Quantity<T>),
    /// The position of the centre of gravity at their start: they end at its position at impact.
    From(Place<T>),
}

impl<U> Walk<'_, U> {
    pub(crate) fn after(&mut self, table: &dyn Display, after: &After) -> After<U> {
        let at = |key| Key(table, key);
        After {
            friction: after.friction.map(|friction| self.number(&at("friction"), friction)),
            drag: after.drag.as_ref().map(|drag| self.drag(&at("drag"), drag)),
            steer: after.steer.as_ref().map(|steer| self.steer(&at("steer"), steer)),
            rest: after.rest.as_ref().map(|rest| self.rest(&at("rest"), rest)),
            points: self.each(&at("points"), &after.points, Self::path_point),
            speed: self.maybe(&at("speed"), after.speed.as_ref()),
            direction: self.maybe(&at("direction"), after.direction.as_ref()),
            yaw_rate: self.maybe(&at("yaw_rate"), after.yaw_rate.as_ref()),
        }
    }

    fn path_point(&mut self, table: &dyn Display, point: &PathPoint) -> PathPoint<U> {
        PathPoint {
            place: self.place(table, &point.place),
            heading: self.maybe(&Key(table, "heading"), point.heading.as_ref()),
            wheel: point.wheel.map(|wheel| self.choice(&Key(table, "wheel"), &MarkedWheel::WORDS, wheel)),
        }
    }

    fn drag(&mut self, path: &dyn Display, drag: &Drag) -> Drag<U> {
        match drag {
            Drag::Every(drag) => Drag::Every(self.wheel_drag(path, *drag)),
            Drag::Each([front_left, front_right, rear_left, rear_right]) => Drag::Each([
                self.wheel_drag(&Element(path, 0), *front_left),
                self.wheel_drag(&Element(path, 1), *front_right),
                self.wheel_drag(&Element(path, 2), *rear_left),
                self.wheel_drag(&Element(path, 3), *rear_right),
            ]),
        }
    }

    fn wheel_drag(&mut self, path: &dyn Display, drag: WheelDrag) -> WheelDrag<U> {
        match drag {
            WheelDrag::Locked => {
                self.choice(path, &WheelDrag::WORDS, WheelDrag::Locked);
                WheelDrag::Locked
            }
            WheelDrag::Share(share) => WheelDrag::Share(self.number(path, share)),
        }
    }

    fn steer(&mut self, path: &dyn Display, steer: &GivenSteer) -> GivenSteer<U> {
        match steer {
            GivenSteer::Held(angle) => GivenSteer::Held(self.quantity(path, angle)),
            GivenSteer::Over(points) => {
                GivenSteer::Over(self.each(path, points, |walk, table, point| SteerPoint {
                    time: walk.quantity(&Key(table, "time"), &point.time),
                    angle: walk.quantity(&Key(table, "angle"), &point.angle),
                }))
            }
        }
    }

    fn rest(&mut self, path: &dyn Display, rest: &GivenRest) -> GivenRest<U> {
        GivenRest {
            place: self.place(path, &rest.place),
            heading: match &rest.heading {
                RestHeading::Heading(heading) => {
                    RestHeading::Heading(self.quantity(&Key(path, "heading"), heading))
                }
                RestHeading::Turned(turned) => {
                    RestHeading::Turned(self.quantity(&Key(path, "turned"), turned))
                }
            },
        }
    }

    pub(crate) fn before(&mut self, table: &dyn Display, before: &Before) -> Before<U> {
        let phases = self.each(&Key(table, "phase"), &before.phases, Self::phase);
        let skid = Key(table, "skid");
        Before {
            skid: before.skid.as_ref().map(|of| self.skid(&skid, of)),
            speed: self.maybe(&Key(table, "speed"), before.speed.as_ref()),
            phases,
        }
    }

    fn skid(&mut self, skid: &dyn Display, of: &Skid) -> Skid<U> {
        Skid {
            begin: match &of.begin {
                SkidBegin::Length(length) => SkidBegin::Length(self.quantity(&Key(skid, "length"), length)),
                SkidBegin::From(place) => SkidBegin::From(self.place(&Key(skid, "from"), place)),
            },
            friction: of.friction.map(|mu| self.number(&Key(skid, "friction"), mu)),
        }
    }

    fn phase(&mut self, table: &dyn Display, phase: &GivenPhase) -> GivenPhase<U> {
        let PhaseForm { distance, time, speed, acceleration } = &phase.form;
        GivenPhase {
            form: PhaseForm {
                distance: self.maybe(&Key(table, "distance"), distance.as_ref()),
                time: self.maybe(&Key(table, "time"), time.as_ref()),
                speed: self.maybe(&Key(table, "speed"), speed.as_ref()),
                acceleration: self.maybe(&Key(table, "acceleration"), acceleration.as_ref()),
            },
            source: self.text(&Key(table, "source"), phase.source.as_ref()),
        }
    }
}
