//! An output: its row, how analyses, samples, derivatives and draws read it, and its vehicle.

use evidence::Impacted;
use inputs::Axes;
use pim_core::{Outcome, Real, VehicleId};
use real::Traced;
use reconcile::Implied;

use crate::goal::{Answer, Crushed};
use crate::seen::Seen;
use crate::travel::{TravelOrigin, Way};

/// A number that a finished analysis gives.
#[derive(Clone, Copy, Debug)]
pub struct OutputQuantity {
    /// Its name in columns and lists of outputs, where a quantity of a vehicle has the prefix `vehicle1.` or
    /// `vehicle2.`.
    pub key: &'static str,
    /// Its place in the JSON (RFC 6901); `#` is the number of the vehicle and `%` one less.
    pub pointer: &'static str,
    /// Its label in a list of outputs.
    pub name: &'static str,
    /// Its label in a table, with its symbol where that helps. The components of a vector share its label.
    pub label: &'static str,
    /// Its symbol in the equations; empty if it has none.
    pub symbol: &'static str,
    /// What kind of number it is.
    pub kind: Kind,
    /// Equation n of SAE 980025 or section n of docs/theory.md; empty if it needs no equation.
    pub source: &'static str,
    /// Its owner, and how to read it. Lateral and rotational numbers are in the axes of the
    /// analysis.
    pub of: Of,
    /// How samples read it.
    pub(crate) sampled: Reading<f64>,
    /// How derivatives read it.
    pub(crate) traced: Reading<Traced>,
    /// How the draws of an estimate read it, if not like samples.
    pub(crate) drawn: Option<fn(&Impacted, VehicleId) -> f64>,
    /// Whether samples and draws read it in the axes of the engine, so that z-down axes change its sign.
    pub(crate) is_lateral: bool,
    /// Whether it is a direction, which is the same after a full turn.
    pub(crate) is_direction: bool,
}

/// What kind of number a quantity is: which units it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Without unit.
    Ratio,
    /// m/s
    Speed,
    /// m
    Length,
    /// rad
    Angle,
    /// rad/s
    YawRate,
    /// J
    Energy,
    /// N·s
    Impulse,
    /// N·m·s
    MomentImpulse,
    /// N
    Force,
    /// s
    Time,
}

/// What a quantity belongs to, with the function that reads it from an analysis, or returns `None` if it is
/// absent.
#[derive(Clone, Copy, Debug)]
pub enum Of {
    /// One number for the whole collision, not for a vehicle.
    Collision(fn(&Seen) -> Option<f64>),
    /// The part along the normal n.
    Normal(fn(&Seen) -> Option<f64>),
    /// The part along the tangent t.
    Tangential(fn(&Seen) -> Option<f64>),
    /// One number for each vehicle.
    Vehicle(fn(&Seen, VehicleId) -> Option<f64>),
}

/// The values of a quantity in one analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// The value of the collision, which a table shows across the columns of both vehicles.
    Shared(Option<f64>),
    /// The values of vehicles 1 and 2.
    Pair([Option<f64>; 2]),
}

/// How a quantity is read from the answer of a case, with plain numbers or with derivatives, in the axes of
/// the engine. A quantity of the collision ignores the vehicle.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reading<T> {
    /// Only a finished analysis has it: it has no interval.
    No,
    /// A speed that was found.
    Found,
    /// From the impact; the second function is for speeds by momentum, which need no impact law.
    OfImpact(fn(&Outcome<T>, VehicleId) -> T, Option<fn(&Implied<T>, VehicleId) -> T>),
    /// From the path to rest.
    OfPath(PathPart, fn(&Way<T>) -> T),
    /// The speed where the skid marks before the impact begin.
    SkidSpeed,
    /// From the damage of one vehicle alone.
    OfDamage(fn(&Crushed<T>) -> T),
}

/// The part of a path to rest to which a number belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PathPart {
    Start,
    Whole,
    End,
}

impl PathPart {
    /// Whether it is a result of the path, and neither a given start nor a measured rest position.
    pub(crate) fn results_from(self, origin: TravelOrigin) -> bool {
        match origin {
            TravelOrigin::Impact => true,
            TravelOrigin::Given => self != Self::Start,
            TravelOrigin::Rest | TravelOrigin::StraightRest => self != Self::End,
        }
    }
}

impl<T: Real> Reading<T> {
    /// NaN if the answer has none.
    fn of_answer(self, answer: &Answer<T>, vehicle: VehicleId) -> T {
        let value = match self {
            Self::No => None,
            Self::Found => answer.speeds[vehicle.index()],
            Self::OfPath(_, get) => answer.ways[vehicle.index()].as_ref().map(get),
            Self::SkidSpeed => answer.skid_speeds[vehicle.index()],
            Self::OfDamage(get) => answer.crushed[vehicle.index()].as_ref().map(get),
            Self::OfImpact(by_law, by_momentum) => match (&answer.implied, &answer.outcome) {
                (Some(implied), _) => by_momentum.map(|get| get(implied, vehicle)),
                (None, outcome) => outcome.as_ref().map(|outcome| by_law(outcome, vehicle)),
            },
        };
        value.unwrap_or(T::from(f64::NAN))
    }
}

impl OutputQuantity {
    /// A row that only a finished analysis has.
    pub(crate) const fn new(
        [key, pointer]: [&'static str; 2],
        [name, label, symbol, source]: [&'static str; 4],
        kind: Kind,
        of: Of,
    ) -> Self {
        let (sampled, traced, drawn) = (Reading::No, Reading::No, None);
        let (is_lateral, is_direction) = (false, false);
        Self {
            key,
            pointer,
            name,
            label,
            symbol,
            kind,
            source,
            of,
            sampled,
            traced,
            drawn,
            is_lateral,
            is_direction,
        }
    }

    pub(crate) const fn sampled(self, sampled: Reading<f64>, traced: Reading<Traced>) -> Self {
        Self { sampled, traced, ..self }
    }

    pub(crate) const fn drawn(self, drawn: fn(&Impacted, VehicleId) -> f64) -> Self {
        Self { drawn: Some(drawn), ..self }
    }

    pub(crate) const fn lateral(self) -> Self {
        Self { is_lateral: true, ..self }
    }

    pub(crate) const fn direction(self) -> Self {
        Self { is_direction: true, ..self }
    }

    /// Its values, in the axes of the analysis.
    #[must_use]
    pub fn values(&self, analysis: &Seen) -> Values {
        // No minus before zero.
        let plain = |value: Option<f64>| value.map(|value| value + 0.0);
        match self.of {
            Of::Collision(get) | Of::Normal(get) | Of::Tangential(get) => {
                Values::Shared(plain(get(analysis)))
            }
            Of::Vehicle(get) => Values::Pair(VehicleId::ALL.map(|id| plain(get(analysis, id)))),
        }
    }

    /// Its value for a vehicle, or that of the collision.
    #[must_use]
    pub fn value(&self, analysis: &Seen, vehicle: Option<VehicleId>) -> Option<f64> {
        match self.values(analysis) {
            Values::Shared(value) => value,
            Values::Pair(values) => values[vehicle?.index()],
        }
    }

    /// Whether each vehicle has one.
    #[must_use]
    pub fn is_of_vehicle(&self) -> bool {
        matches!(self.of, Of::Vehicle(_))
    }

    /// Whether it belongs to a path to rest.
    #[must_use]
    pub fn is_of_path(&self) -> bool {
        matches!(self.sampled, Reading::OfPath(..))
    }

    /// Whether samples read it only where the damage of one vehicle is all there is.
    #[must_use]
    pub fn is_of_damage(&self) -> bool {
        matches!(self.sampled, Reading::OfDamage(_))
    }

    /// The output of this quantity for a vehicle.
    #[inline(always)]
    #[must_use]
    pub const fn of_vehicle(&'static self, vehicle: VehicleId) -> Output {
        Output { quantity: self, vehicle: Some(vehicle) }
    }

    /// The output of this quantity for the collision, or for both vehicles together.
    #[inline(always)]
    #[must_use]
    pub const fn of_collision(&'static self) -> Output {
        Output { quantity: self, vehicle: None }
    }
}

/// A result that is differentiated, sampled or drawn: a quantity and its vehicle.
#[derive(Clone, Copy, Debug)]
pub struct Output {
    quantity: &'static OutputQuantity,
    vehicle: Option<VehicleId>,
}

impl PartialEq for Output {
    fn eq(&self, other: &Self) -> bool {
        self.is(other.quantity) && self.vehicle == other.vehicle
    }
}

impl Eq for Output {}

impl Output {
    /// Its row.
    #[must_use]
    pub fn quantity(self) -> &'static OutputQuantity {
        self.quantity
    }

    /// The vehicle that it belongs to; `None` for the collision.
    #[must_use]
    pub fn vehicle(self) -> Option<VehicleId> {
        self.vehicle
    }

    /// Whether it is this quantity, for either vehicle.
    #[must_use]
    pub fn is(self, quantity: &OutputQuantity) -> bool {
        self.quantity.key == quantity.key
    }

    /// Its key in the table of results.
    #[must_use]
    pub fn key(self) -> &'static str {
        self.quantity.key
    }

    /// The key of the JSON that names it.
    #[must_use]
    pub fn path(self) -> String {
        let key = self.key();
        self.vehicle.map_or_else(|| key.to_owned(), |vehicle| format!("vehicle{vehicle}.{key}"))
    }

    /// The vehicle to read; a quantity of the collision ignores it.
    #[inline(always)]
    fn id(self) -> VehicleId {
        self.vehicle.unwrap_or(VehicleId::One)
    }

    #[inline(always)]
    fn in_axes<T: Real>(self, axes: Axes, value: T) -> T {
        if self.quantity.is_lateral { axes.lateral(value) } else { value }
    }

    /// (SI) its value in the answer of a case; NaN if that has none.
    pub(crate) fn of_answer(self, answer: &Answer, axes: Axes) -> f64 {
        self.in_axes(axes, self.quantity.sampled.of_answer(answer, self.id()))
    }

    /// The same with its derivatives.
    pub(crate) fn traced(self, answer: &Answer<Traced>, axes: Axes) -> Traced {
        self.in_axes(axes, self.quantity.traced.of_answer(answer, self.id()))
    }

    /// (SI) its value in an impact, NaN for anything else; `found` is the speed found.
    #[inline(always)]
    pub(crate) fn of_impact(self, axes: Axes, found: f64, outcome: &Outcome) -> f64 {
        match self.quantity.sampled {
            Reading::Found => found,
            Reading::OfImpact(by_law, _) => self.in_axes(axes, by_law(outcome, self.id())),
            Reading::No | Reading::OfPath(..) | Reading::SkidSpeed | Reading::OfDamage(_) => f64::NAN,
        }
    }

    /// (SI) its value in a draw of an estimate.
    pub(crate) fn of_draw(self, axes: Axes, impacted: &Impacted) -> f64 {
        match self.quantity.drawn {
            Some(get) => self.in_axes(axes, get(impacted, self.id())),
            None => self.of_impact(axes, impacted.speeds[self.id().index()], &impacted.outcome),
        }
    }
}
