//! How the other party leaves the danger zone, for the question whether the collision was avoidable.

use std::f64::consts::PI;

use pim_core::{InvalidInput, Vector2};
use real::Real;
use time_distance::{Crossing, Party};

use crate::after::PhaseForm;
use crate::quantity::Quantity;
use crate::scene::{Place, in_scene};
use crate::vehicle::{ContactPoint, Outline};

/// The path of the other party out of the danger zone.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearForm<T = f64> {
    /// The distance that remains.
    pub way: WayOutForm<T>,
    /// Its speed on the way.
    pub speed: ClearSpeedForm<T>,
}

/// How far the other party still has to go until it has left the danger zone.
#[derive(Clone, Debug, PartialEq)]
pub enum WayOutForm<T = f64> {
    /// (m) as given.
    Distance(Quantity<T>),
    /// By both outlines.
    Outlines(Box<OutlinesForm<T>>),
}

/// The speed of the other party on its way out.
#[derive(Clone, Debug, PartialEq)]
pub enum ClearSpeedForm<T = f64> {
    /// (m/s) as given.
    Steady(Quantity<T>),
    /// That of its approach.
    AsItCame,
    /// The speed that the phases of its vehicle lead to; they begin with a known speed.
    Phases(Vec<PhaseForm<T>>),
    /// That of its vehicle, which the rest of the case gives.
    Sought,
}

/// Two vehicles seen from above at the impact; each travels along its heading.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlinesForm<T = f64> {
    /// (rad) the headings: of the vehicle asked about, and of the other.
    pub headings: [Quantity<T>; 2],
    /// Their bodies.
    pub bodies: [Outline<T>; 2],
    /// Where they are.
    pub places: PlacesForm<T>,
}

/// The source of the positions of two vehicles at the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlacesForm<T = f64> {
    /// By the contact point, from the centre of gravity of each.
    Contacts([ContactPoint<T>; 2]),
    /// By the position of each.
    Positions([Place<T>; 2]),
}

impl<T: Copy> ClearForm<T> {
    /// The same with other numbers; `of` is called in the order of the fields.
    pub(crate) fn map<U>(&self, mut of: impl FnMut(Quantity<T>) -> Quantity<U>) -> ClearForm<U> {
        let way = match &self.way {
            WayOutForm::Distance(distance) => WayOutForm::Distance(of(*distance)),
            WayOutForm::Outlines(outlines) => {
                let OutlinesForm { headings, bodies, places } = &**outlines;
                WayOutForm::Outlines(Box::new(OutlinesForm {
                    headings: headings.map(&mut of),
                    bodies: bodies.map(|body| body.map_quantities(&mut of)),
                    places: match places {
                        PlacesForm::Contacts(points) => PlacesForm::Contacts(
                            points.map(|point| point.map_quantities(|_, quantity| of(quantity))),
                        ),
                        PlacesForm::Positions(places) => {
                            PlacesForm::Positions(places.map(|place| place.map_quantities(&mut of)))
                        }
                    },
                }))
            }
        };
        let speed = match &self.speed {
            ClearSpeedForm::Steady(speed) => ClearSpeedForm::Steady(of(*speed)),
            ClearSpeedForm::Phases(phases) => {
                ClearSpeedForm::Phases(phases.iter().map(|phase| phase.map(&mut of)).collect())
            }
            ClearSpeedForm::AsItCame => ClearSpeedForm::AsItCame,
            ClearSpeedForm::Sought => ClearSpeedForm::Sought,
        };
        ClearForm { way, speed }
    }
}

/// (m) outlines no farther apart than rounding touch.
const TOUCHES: f64 = 1e-6;

impl OutlinesForm {
    /// (m) how far the other vehicle travels straight on, or straight back, until its outline has left the
    /// strip that the outline of the first sweeps; `None` if it is outside of that strip, where the two
    /// cannot collide.
    ///
    /// # Errors
    /// If both travel along one line, or a number is impossible.
    pub fn way_out(&self, backs: bool) -> Result<Option<f64>, InvalidInput> {
        let [first, second] = self.headings.each_ref().map(Quantity::si);
        let apart = match &self.places {
            PlacesForm::Contacts([one, two]) => in_scene(one.xy(), first) - in_scene(two.xy(), second),
            PlacesForm::Positions([one, two]) => {
                Vector2::new(two.x.si() - one.x.si(), two.y.si() - one.y.si())
            }
        };
        let (sin, cos) = Real::sin_cos(first);
        // From the middle of the strip, to the left of the direction in which it is swept.
        let aside = cos * apart.y - sin * apart.x;
        let [subject, mut other] = self.bodies.each_ref().map(|body| {
            let [length, width, front] = body.quantities().map(Quantity::si);
            Party { front, rear: length - front, width }
        });
        let mut angle = second - first;
        if backs {
            angle += PI;
            other = Party { front: other.rear, rear: other.front, ..other };
        }
        let crossing = Crossing::new(angle, [subject, other])?;
        let way = crossing.way_out(aside);
        let meets = way > -TOUCHES && way < crossing.way_through() + TOUCHES;
        Ok(meets.then_some(way.max(0.0)))
    }
}

impl ClearForm {
    /// (m) the distance that remains to the other party, forward or backward; `None` if the outlines cannot
    /// collide.
    ///
    /// # Errors
    /// As [`OutlinesForm::way_out`].
    pub fn distance(&self, backs: bool) -> Result<Option<f64>, InvalidInput> {
        match &self.way {
            WayOutForm::Distance(distance) => Ok(Some(distance.si())),
            WayOutForm::Outlines(outlines) => outlines.way_out(backs),
        }
    }
}
