//! The collisions of a block of samples or particles, as columns.
//!
//! Each collision is computed by the same functions as a single case, in the same order, and so has the same
//! bits. The data of the vehicles and their damage become columns. Nothing between these functions keeps the
//! compiler from vectorising the loop over the lanes: no allocation, no error, no branch.

use std::collections::BTreeSet;

use ::uncertainty::{LANES, Lanes};
use crash3::{
    CrushError, DamagedFace, EnergyMoments, Stiffness, Zone, energy_of_equivalent_speed, equal_spacing,
    zone_energy,
};
use inputs::{
    Axes, Case, ContactForm, CrushForm, DamageForm, ImpactForm, PlacedContact, Quantity, StiffnessForm,
    StiffnessLine, VehicleForm, WidthsForm,
};
use pim_core::{Body, Contact, Motion, Participant, VaryingLaw, Vector2};

/// A number of the case.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    /// The same in every lane.
    Known(f64),
    /// A column, by its place.
    Uncertain(usize),
}

/// The column of a number that has none.
static NO_NUMBERS: Lanes = Lanes::splat(f64::NAN);

impl From<f64> for Number {
    fn from(number: f64) -> Self {
        Self::Known(number)
    }
}

impl Number {
    #[inline(always)]
    pub(crate) fn lanes(self, inputs: &[Lanes]) -> Lanes {
        *self.column(inputs, &mut None)
    }

    /// The same without a copy: a reference to the column of an input, or to `known`, filled with the number.
    #[inline(always)]
    fn column<'a>(self, inputs: &'a [Lanes], known: &'a mut Option<Lanes>) -> &'a Lanes {
        match self {
            Self::Known(number) => known.insert(Lanes::splat(number)),
            Self::Uncertain(place) => inputs.get(place).unwrap_or(&NO_NUMBERS),
        }
    }

    /// Its value in one lane.
    pub(crate) fn at(self, inputs: &[Lanes], lane: usize) -> f64 {
        match self {
            Self::Known(number) => number,
            Self::Uncertain(place) => inputs.get(place).map_or(f64::NAN, |column| column[lane]),
        }
    }

    fn is_uncertain(self) -> bool {
        matches!(self, Self::Uncertain(_))
    }
}

/// The number of different columns among these numbers.
pub(crate) fn uncertain_places(numbers: impl IntoIterator<Item = Number>) -> usize {
    let place = |number| match number {
        Number::Known(_) => None,
        Number::Uncertain(place) => Some(place),
    };
    numbers.into_iter().filter_map(place).collect::<BTreeSet<usize>>().len()
}

/// Runs `$body` in each lane, with each `$form` of [`Number`]s converted to the numbers of that lane. A
/// macro, because a closure would be compiled for the baseline instruction set.
macro_rules! each_lane {
    ($inputs:expr, $lane:ident, $($form:ident)+ => $body:expr) => {{
        $(
            let mut known = [None; MOST_NUMBERS];
            let mut free = known.iter_mut();
            let $form = $form.map(|number: Number| match free.next() {
                Some(known) => number.column($inputs, known),
                None => &NO_NUMBERS,
            });
        )+
        for $lane in 0..LANES {
            $(let $form = $form.map(|column| column[$lane]);)+
            $body;
        }
    }};
}

/// The largest form that is read like this has four numbers: A, B, G and the limit of a stiffness line.
const MOST_NUMBERS: usize = 4;

/// The value of a quantity in SI, in each lane.
#[inline(always)]
pub(crate) fn si(quantity: Quantity<Number>, inputs: &[Lanes], column: &mut Lanes) {
    each_lane!(inputs, lane, quantity => column[lane] = quantity.si());
}

/// A case whose collisions can be posed a block at a time.
#[derive(Debug)]
pub(crate) struct Collisions {
    case: Case<Number>,
    /// Whether the speed of each vehicle is unknown.
    sought: [bool; 2],
}

impl Collisions {
    pub(crate) fn new(case: Case<Number>, sought: [bool; 2]) -> Self {
        Self { case, sought }
    }

    /// The inputs of their impacts; `None` if the case lacks one.
    pub(crate) fn form(&self) -> Option<ImpactForm<'_, Number>> {
        self.case.impact_form(self.sought)
    }

    /// Poses a block into columns that hold [nothing](Columns::NOTHING) yet: in place, because together they
    /// are some kilobytes.
    #[inline(always)]
    pub(crate) fn pose(&self, inputs: &[Lanes], columns: &mut Columns) {
        let Some(ImpactForm { axes, vehicles: [one, two], crush_plane: given, law: _, basis: _ }) =
            self.form()
        else {
            return;
        };
        let Columns { vehicles: [v1, v2], crush_plane, crush_energies: [e1, e2] } = columns;
        v1.fill(axes, &one, inputs);
        v2.fill(axes, &two, inputs);
        each_lane!(inputs, lane, given => crush_plane[lane] = axes.lateral(given.si()));
        crush_energy(&one.damage, inputs, &v1.mass, e1);
        crush_energy(&two.damage, inputs, &v2.mass, e2);
        refuse_face(&one, inputs, e1);
        refuse_face(&two, inputs, e2);
    }

    /// The collision of one lane; `None` if the engine refuses it.
    #[inline(always)]
    pub(crate) fn collision(
        &self,
        columns: &Columns,
        inputs: &[Lanes],
        lane: usize,
    ) -> Option<(Contact, VaryingLaw, [Motion; 2])> {
        let law = self.case.impact.as_ref()?.law.map(|number| number.at(inputs, lane));
        let law = law.of_engine(self.case.axes).ok()?;
        let (contact, motions, is_contact) = columns.contact(lane);
        if !is_contact {
            return None;
        }
        if columns.vehicles.iter().all(|vehicle| vehicle.course.is_none()) {
            return Some((contact, law, motions));
        }
        Some((columns.with_courses(&contact, lane)?, law, motions))
    }

    /// The engine's reasons for refusing the stiffnesses of one lane.
    pub(crate) fn refused_stiffnesses(
        &self,
        inputs: &[Lanes],
        lane: usize,
    ) -> impl Iterator<Item = CrushError> {
        self.case.vehicles.iter().filter_map(move |vehicle| {
            let crush = vehicle.crush.as_ref()?;
            crush.stiffness.map(|number| number.at(inputs, lane)).structure(crush.side).err()
        })
    }
}

/// The collisions of a block, in SI and in the axes of the engine.
pub(crate) struct Columns {
    pub(crate) vehicles: [VehicleColumns; 2],
    crush_plane: Lanes,
    /// (J) the crush energy of each vehicle; NaN if the engine refuses its damage.
    pub(crate) crush_energies: [Lanes; 2],
}

impl Columns {
    /// Zeros, which are the cheapest to make.
    pub(crate) const NOTHING: Self = Self {
        vehicles: [VehicleColumns::NOTHING; 2],
        crush_plane: Lanes::ZERO,
        crush_energies: [Lanes::ZERO; 2],
    };

    /// (J) the crush energy of both vehicles in one lane.
    #[inline(always)]
    pub(crate) fn crush_energy(&self, lane: usize) -> f64 {
        let [one, two] = &self.crush_energies;
        one[lane] + two[lane]
    }

    /// The contact of one lane with the direction of travel of each vehicle; `None` if the engine refuses it.
    fn with_courses(&self, contact: &Contact, lane: usize) -> Option<Contact> {
        let [p1, p2] = *contact.participants();
        let [c1, c2] = self.vehicles.each_ref().map(|vehicle| vehicle.course()[lane]);
        Contact::new([p1.with_course(c1).ok()?, p2.with_course(c2).ok()?], self.crush_plane[lane]).ok()
    }

    /// The contact of one lane, the motions before it, and whether it is valid, for vehicles that travel
    /// along their headings.
    #[inline(always)]
    pub(crate) fn contact(&self, lane: usize) -> (Contact, [Motion; 2], bool) {
        let [v1, v2] = &self.vehicles;
        let ((p1, is_1), (p2, is_2)) = (v1.participant(lane), v2.participant(lane));
        let (contact, is_contact) = Contact::new_with_validity([p1, p2], self.crush_plane[lane]);
        (contact, [v1.motion(lane), v2.motion(lane)], is_1 & is_2 & is_contact)
    }
}

/// A vehicle or a fixed object, in each lane.
pub(crate) struct VehicleColumns {
    is_fixed: bool,
    mass: Lanes,
    yaw_inertia: Lanes,
    heading: Lanes,
    /// The direction of travel, if it is not the heading.
    course: Option<Lanes>,
    forward: Lanes,
    left: Lanes,
    velocity_x: Lanes,
    velocity_y: Lanes,
    yaw_rate: Lanes,
}

impl VehicleColumns {
    const NOTHING: Self = {
        const ZERO: Lanes = Lanes::ZERO;
        Self {
            is_fixed: false,
            mass: ZERO,
            yaw_inertia: ZERO,
            heading: ZERO,
            course: None,
            forward: ZERO,
            left: ZERO,
            velocity_x: ZERO,
            velocity_y: ZERO,
            yaw_rate: ZERO,
        }
    };

    /// Fills columns that hold [nothing](Self::NOTHING) yet with this vehicle. A fixed object without a
    /// contact point is a [barrier](Participant::barrier), whose point is its centre of gravity.
    #[inline(always)]
    fn fill(&mut self, axes: Axes, vehicle: &VehicleForm<'_, Number>, inputs: &[Lanes]) {
        let Self {
            is_fixed,
            mass,
            yaw_inertia,
            heading,
            course,
            forward,
            left,
            velocity_x,
            velocity_y,
            yaw_rate,
        } = self;
        *is_fixed = vehicle.fixed;
        if let Some(given) = vehicle.mass {
            each_lane!(inputs, lane, given => mass[lane] = given.kg());
        }
        if let Some(given) = vehicle.yaw {
            each_lane!(inputs, lane, given => {
                yaw_inertia[lane] = given.kg_m2(mass[lane]).unwrap_or(f64::NAN);
            });
        }
        match vehicle.contact {
            None => {}
            Some(ContactForm::Given(given)) => {
                each_lane!(inputs, lane, given => [forward[lane], left[lane]] = given.point(axes));
            }
            Some(ContactForm::Placed(placed)) => {
                place(axes, &placed, &vehicle.damage, inputs, [forward, left]);
            }
        }
        if let Some(given) = vehicle.heading {
            each_lane!(inputs, lane, given => heading[lane] = axes.lateral(given.si()));
        }
        if let Some(given) = vehicle.course {
            let course = course.insert(*heading);
            each_lane!(inputs, lane, given => {
                if let Some(direction) = given.rad(axes, heading[lane]) {
                    course[lane] = direction;
                }
            });
        }
        if let Some(given) = vehicle.velocity {
            let course = course.as_ref().unwrap_or(heading);
            each_lane!(inputs, lane, given => {
                let velocity = given.vector(axes, course[lane]);
                (velocity_x[lane], velocity_y[lane]) = (velocity.x, velocity.y);
            });
        }
        if let Some(given) = vehicle.yaw_rate {
            each_lane!(inputs, lane, given => yaw_rate[lane] = axes.lateral(given.si()));
        }
    }

    /// (rad) its direction of travel.
    pub(crate) fn course(&self) -> &Lanes {
        self.course.as_ref().unwrap_or(&self.heading)
    }

    #[inline(always)]
    fn participant(&self, lane: usize) -> (Participant, bool) {
        let (body, is_body) = if self.is_fixed {
            (Body::fixed(), true)
        } else {
            Body::new_with_validity(self.mass[lane], self.yaw_inertia[lane])
        };
        let (participant, is_placed) =
            Participant::new_with_validity(body, self.heading[lane], self.forward[lane], self.left[lane]);
        (participant, is_body & is_placed)
    }

    #[inline(always)]
    fn motion(&self, lane: usize) -> Motion {
        let velocity = Vector2::new(self.velocity_x[lane], self.velocity_y[lane]);
        Motion { velocity, yaw_rate: self.yaw_rate[lane] }
    }
}

/// (m) a contact point that is placed on a damage, forward and left of the centre of gravity. A refused
/// damage shows in its energy, which is NaN.
#[inline(always)]
fn place(
    axes: Axes,
    placed: &PlacedContact<Number>,
    damage: &DamageForm<'_, Number>,
    inputs: &[Lanes],
    [forward, left]: [&mut Lanes; 2],
) {
    let DamageForm::Measured(crush) = damage else { return };
    let mut moments = [EnergyMoments::none(); LANES];
    let mut zones = ZoneColumns::NOTHING;
    for (number, ends) in crush.zones().enumerate() {
        zones.fill(crush, number, inputs);
        if zones.has_limit {
            add_moments::<true>(&zones, ends, inputs, &mut moments);
        } else {
            add_moments::<false>(&zones, ends, inputs, &mut moments);
        }
    }
    for lane in 0..LANES {
        let placed = placed.map(|number| number.at(inputs, lane));
        [forward[lane], left[lane]] = placed.point(axes, &moments[lane]).unwrap_or([f64::NAN; 2]);
    }
}

/// Adds a zone, without or with a limit of the force.
#[inline(always)]
fn add_moments<const LIMITED: bool>(
    zones: &ZoneColumns,
    [first, second]: [Quantity<Number>; 2],
    inputs: &[Lanes],
    moments: &mut [EnergyMoments; LANES],
) {
    each_lane!(inputs, lane, first second => {
        let (zone, stiffness) = zones.at::<LIMITED>(lane, [first.si(), second.si()]);
        moments[lane] = moments[lane].with(zone, &stiffness);
    });
}

/// (J) the crush energy; NaN if the engine refuses the damage.
#[inline(always)]
fn crush_energy(damage: &DamageForm<'_, Number>, inputs: &[Lanes], mass: &Lanes, energy: &mut Lanes) {
    match *damage {
        DamageForm::Unknown | DamageForm::Undamaged | DamageForm::Inferred(_) => {}
        DamageForm::OfObject(given) => each_lane!(inputs, lane, given => {
            energy[lane] = given.si();
        }),
        DamageForm::Ees(ees) => each_lane!(inputs, lane, ees => {
            energy[lane] = energy_of_equivalent_speed(ees.si(), mass[lane]).unwrap_or(f64::NAN);
        }),
        DamageForm::Measured(crush) => {
            let mut zones = ZoneColumns::NOTHING;
            for (number, ends) in crush.zones().enumerate() {
                zones.fill(&crush, number, inputs);
                if zones.has_limit {
                    add_limited(&zones, ends, inputs, energy);
                } else {
                    add::<false>(&zones, ends, inputs, energy);
                }
            }
        }
    }
}

/// (J) adds the energy of a zone, without or with a limit of the force.
#[inline(always)]
fn add<const LIMITED: bool>(
    zones: &ZoneColumns,
    [first, second]: [Quantity<Number>; 2],
    inputs: &[Lanes],
    energy: &mut Lanes,
) {
    each_lane!(inputs, lane, first second => {
        let (zone, stiffness) = zones.at::<LIMITED>(lane, [first.si(), second.si()]);
        let own = zone_energy(zone, &stiffness);
        energy[lane] += if zone.is_valid() { own } else { f64::NAN };
    });
}

/// Compiled once: the limit is a branch, so a copy for each instruction set gains nothing.
#[inline(never)]
fn add_limited(zones: &ZoneColumns, ends: [Quantity<Number>; 2], inputs: &[Lanes], energy: &mut Lanes) {
    add::<true>(zones, ends, inputs, energy);
}

/// (J) sets the crush energy to NaN if the engine refuses the position of the damaged side. The offset along
/// the side changes nothing.
#[inline(always)]
fn refuse_face(vehicle: &VehicleForm<'_, Number>, inputs: &[Lanes], energy: &mut Lanes) {
    if let (DamageForm::Measured(crush), Some(body)) = (vehicle.damage, vehicle.body)
        && body.quantities().iter().any(|quantity| quantity.number().is_uncertain())
    {
        for (lane, energy) in energy.iter_mut().enumerate() {
            let distance = body.map(|number| number.at(inputs, lane)).dimensions().face(crush.crush.side);
            if DamagedFace::new(crush.crush.side, distance, 0.0).is_err() {
                *energy = f64::NAN;
            }
        }
    }
}

/// The width and stiffness of one zone of a crush at a time.
struct ZoneColumns {
    width: Lanes,
    /// A, B, G and the limit of the force; NaN if there is no such stiffness.
    stiffness: [Lanes; 4],
    has_limit: bool,
}

impl ZoneColumns {
    const NOTHING: Self = Self { width: Lanes::ZERO, stiffness: [Lanes::ZERO; 4], has_limit: false };

    /// Replaces the previous zone by this one.
    #[inline(always)]
    fn fill(&mut self, crush: &CrushForm<'_, Number>, zone: usize, inputs: &[Lanes]) {
        let width = &mut self.width;
        match crush.widths() {
            Some(WidthsForm::Equal(_)) if zone > 0 => {}
            Some(WidthsForm::Equal(whole)) => {
                let stations = crush.crush.depths.len();
                each_lane!(inputs, lane, whole => width[lane] = equal_spacing(whole.si(), stations));
            }
            Some(WidthsForm::Each(widths)) => match widths.get(zone) {
                Some(own) => si(*own, inputs, width),
                None => *width = NO_NUMBERS,
            },
            None => *width = NO_NUMBERS,
        }
        match &crush.crush.stiffness {
            StiffnessForm::Zones(lines) => match lines.get(zone) {
                Some(line) => self.resist(*line, inputs),
                None => self.stiffness = [NO_NUMBERS; 4],
            },
            // All zones have the same stiffness.
            _ if zone > 0 => {}
            StiffnessForm::Line(line) => self.resist(*line, inputs),
            StiffnessForm::Typical(typical) => match (typical.stiffness(crush.crush.side), crush.factor) {
                (Ok(known), Some(factor)) => {
                    let mut one = None;
                    let factors = factor.column(inputs, &mut one);
                    for lane in 0..LANES {
                        self.put(lane, typical.of_car(known, Some(factors[lane])));
                    }
                }
                (known, _) => (0..LANES).for_each(|lane| self.put(lane, known)),
            },
            StiffnessForm::Test(test) => {
                for lane in 0..LANES {
                    self.put(lane, test.map(|number| number.at(inputs, lane)).stiffness());
                }
            }
        }
    }

    #[inline(always)]
    fn resist(&mut self, line: StiffnessLine<Number>, inputs: &[Lanes]) {
        self.has_limit = line.limit().is_some();
        each_lane!(inputs, lane, line => self.put(lane, line.stiffness()));
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, stiffness: Result<Stiffness, CrushError>) {
        let [a, b, g, limit] = &mut self.stiffness;
        [a[lane], b[lane], g[lane], limit[lane]] = match stiffness {
            Ok(known) => [known.a(), known.b(), known.g(), known.saturation_force().unwrap_or(f64::INFINITY)],
            Err(_) => [f64::NAN; 4],
        };
    }

    /// The zone and its stiffness in one lane.
    #[inline(always)]
    fn at<const LIMITED: bool>(&self, lane: usize, depths: [f64; 2]) -> (Zone, Stiffness) {
        let [a, b, g, limit] = &self.stiffness;
        let (rising, _) = Stiffness::from_abg_with_validity(a[lane], b[lane], g[lane]);
        let limited = if LIMITED { rising.with_saturation_force(limit[lane]) } else { Ok(rising) };
        let stiffness = limited.unwrap_or(rising);
        (Zone { width: self.width[lane], depths }, stiffness)
    }
}

#[cfg(test)]
pub(crate) mod tests;
