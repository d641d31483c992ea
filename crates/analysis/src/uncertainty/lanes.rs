//! A block of samples of a reconstruction or an impact at once.
//!
//! Each sample goes through the functions of the engine through which a single case goes, in the same order,
//! so that the answers have the same bits. What a case says of its vehicles and their damage becomes columns,
//! and there is nothing between these functions that keeps a compiler from vectorising the loop over the
//! samples: no allocation, no error, no branch. Under the commonest laws the speed has a closed form, which
//! is found for all samples at once. Under any other law, and where a sample has no such answer, the samples
//! are solved from these columns one after the other. That saves what costs a single case most, which is the
//! case itself.
//!
//! What a block cannot say is left to the single case: each [`Alone`], and of an impact a sample whose damage
//! the engine refuses.

use std::collections::BTreeSet;
use std::slice;

use ::uncertainty::dispatch;
use ::uncertainty::{Instructions, LANES, Lanes, SUCCEEDED};
use crash3::{
    CrushError, DamagedFace, EnergyBasis, EnergyMoments, ObliqueCorrection, Profile, Side, SideStiffness,
    Stiffness, VehicleClass, Zone, energy_of_equivalent_speed, equal_spacing, yaw_inertia_burg, zone_energy,
};
use inputs::{
    Axes, Basis, BrachTangential, Case, ContactPoint, Crush, Dimensions, Find, GivenEes, GivenImpact,
    GivenVehicle, ImpactLaw, Kind, KnownEnergy, Mass, Outline, Pdof, Quantity, Reconstruct, Restitution,
    StiffnessForm, StiffnessLine, Velocity, YawInertia, along_face, class_yaw_inertia, placed_contact,
    scaled_stiffness,
};
use pim_core::{
    Body, Contact, Law, Motion, Outcome, Participant, Tangential, VaryingLaw, Vector2, VehicleId,
};
use reconcile::{Problem, Unknown};

use super::{Reason, as_beside};
use crate::found::refused;
use crate::output::Output;
use crate::quantities::{OUTPUTS, of_impact};

/// A number of the case.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    /// The same in every sample.
    Known(f64),
    /// One of the inputs, by its place among them, or one that shares an error, by its place behind these.
    Uncertain(usize),
}

/// A number that is none of the inputs.
static NO_NUMBERS: Lanes = Lanes::splat(f64::NAN);

impl Number {
    #[inline(always)]
    pub(crate) fn lanes(self, inputs: &[Lanes]) -> Lanes {
        *self.column(inputs, &mut None)
    }

    /// The same without a copy: the column of an input where it lies, or `known`, which then has the number.
    #[inline(always)]
    fn column<'a>(self, inputs: &'a [Lanes], known: &'a mut Option<Lanes>) -> &'a Lanes {
        match self {
            Self::Known(number) => known.insert(Lanes::splat(number)),
            Self::Uncertain(place) => inputs.get(place).unwrap_or(&NO_NUMBERS),
        }
    }

    /// In one sample.
    fn at(self, inputs: &[Lanes], lane: usize) -> f64 {
        match self {
            Self::Known(number) => number,
            Self::Uncertain(place) => inputs.get(place).map_or(f64::NAN, |column| column[lane]),
        }
    }

    pub(crate) fn is_uncertain(self) -> bool {
        matches!(self, Self::Uncertain(_))
    }
}

/// Why the samples of a case are solved one by one, each as a case of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Alone {
    /// It asks for both speeds, which are found from the momentum: that comes from the ways to rest.
    BothSpeeds,
    /// It follows vehicles to rest or back: what a sample costs then is its way, not its case.
    Ways,
    /// The damage of a vehicle is not known, or follows from the other's.
    NoDamage,
    /// A vehicle that travels in another direction than its heading, along which its speed counts.
    Course,
    /// What a case has to give is missing, or a result is asked for that an impact does not have.
    Incomplete,
    /// A range of a number that it does not read: one that no result depends on and that is not known to be
    /// idle.
    Unread,
}

/// How many of these numbers are uncertain, each once.
pub(crate) fn uncertain_places(numbers: impl IntoIterator<Item = Number>) -> usize {
    let place = |number| match number {
        Number::Known(_) => None,
        Number::Uncertain(place) => Some(place),
    };
    numbers.into_iter().filter_map(place).collect::<BTreeSet<usize>>().len()
}

/// A case of which a block of samples can be solved at once.
#[derive(Debug)]
pub(super) struct Block {
    axes: Axes,
    vehicles: [Vehicle; 2],
    crush_plane: Quantity<Number>,
    /// What is sought, if not the impact at the speeds that are given.
    sought: Option<Sought>,
    law: ImpactLaw<Number>,
    /// Where the speed has a closed form.
    at_once: Option<AtOnce>,
    /// The place of each output among all that there are, and (SI) the central values of these, 0 where one
    /// is not wanted.
    places: Vec<usize>,
    central: [f64; OUTPUTS],
}

/// A law under which a speed is found for all samples at once. The others are solved one sample after the
/// other, which takes twice as long: a loop for each would take a compiler many times as long.
#[derive(Clone, Copy, Debug)]
struct AtOnce {
    restitution: Number,
    condition: Condition,
}

/// What such a law asks for along the crush plane.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// e_t: zero, U_t = 0, where the law asks for a common tangential velocity.
    Restitution(Number),
    /// μ of a friction limit.
    Friction(Number),
}

/// A speed that the crush energy gives.
#[derive(Clone, Copy, Debug)]
struct Sought {
    unknown: Unknown,
    basis: EnergyBasis,
    /// λ, where the crush takes a share of the tangential work.
    share: Option<Number>,
}

#[derive(Debug)]
struct Vehicle {
    body: Collider,
    damage: Damage,
    /// The damaged side and the body about it, where that is uncertain: no side may lie behind the centre of
    /// gravity.
    face: Option<(Side, Outline<Number>)>,
    /// Numbers on which neither an answer depends nor whether there is one: how the force acted, and where on
    /// its side the damage lies.
    idle: Vec<Number>,
}

/// What collides.
#[derive(Debug)]
enum Collider {
    Moves(Mover),
    /// A fixed object; where the case tells no point of contact, its heading is not read.
    Fixed {
        heading: Option<Quantity<Number>>,
        contact: Option<ContactPoint<Number>>,
    },
}

/// What is known of a damage.
#[derive(Debug)]
pub(crate) enum Damage {
    Unknown,
    Crush(Crushed, Resistance),
    /// An energy equivalent speed; `None` without damage.
    Energy(Option<Quantity<Number>>),
}

/// What a damaged side resisted with.
#[derive(Debug)]
pub(crate) enum Resistance {
    Line(Line),
    /// That of a category, with the factor on A.
    Category(Stiffness, Number),
    /// Of zones, with a limit, or of a barrier test: it is made for one sample at a time.
    Other(Side, StiffnessForm<Number>),
}

/// A vehicle that moves, without its damage.
#[derive(Debug)]
pub(crate) struct Mover {
    mass: Mass<Number>,
    yaw: Yaw,
    heading: Quantity<Number>,
    contact: Contacted,
    /// None of the vehicle whose speed is sought.
    motion: Option<Velocity<Number>>,
    yaw_rate: Option<Quantity<Number>>,
}

/// Where the contact point of a vehicle comes from.
#[derive(Debug)]
enum Contacted {
    Given(ContactPoint<Number>),
    /// The centroid of its damage.
    Placed(Box<Placed>),
}

/// A contact point at the centroid of a damage.
#[derive(Debug)]
struct Placed {
    side: Side,
    outline: BodyOutline,
    offset: Quantity<Number>,
    /// Along the face and inward, where the point may be off.
    moved: [Option<Quantity<Number>>; 2],
    crushed: Crushed,
    resistance: Resistance,
}

/// Where the outline of a body comes from.
#[derive(Debug)]
enum BodyOutline {
    Given(Outline<Number>),
    /// A size class.
    Class(Dimensions),
}

/// Where a yaw inertia comes from.
#[derive(Clone, Copy, Debug)]
enum Yaw {
    Given(YawInertia<Number>),
    /// A size class, with the factor on its radius of gyration.
    Class(VehicleClass, Number),
    /// Burg's formula from wheelbase and length, with the factor on the radius of gyration.
    Burg([Quantity<Number>; 2], Number),
}

/// A crush that was measured at stations.
#[derive(Debug)]
pub(crate) struct Crushed {
    widths: Widths,
    depths: Vec<Quantity<Number>>,
}

/// How far the stations of a crush lie apart.
#[derive(Debug)]
enum Widths {
    /// Equally, over a width.
    Equal(Quantity<Number>),
    Each(Vec<Quantity<Number>>),
}

impl Block {
    /// Why the case is left to [`Sample`](super::Sample), if it is: where it has another shape, or where one
    /// of its `uncertain` numbers, so many, is none that a block reads.
    ///
    /// The structs of the case are taken apart field by field, here and for the vehicles, so that a new key
    /// does not compile before somebody has decided what a block does with it.
    pub(super) fn new(
        case: &Case<Number>,
        uncertain: usize,
        outputs: &[Output],
        central: &[f64],
    ) -> Result<Self, Alone> {
        let Case {
            title: _,
            locked_together: _,
            source: _,
            report: _,
            axes,
            // It places the motion after the impact, which the reconstruction of one speed does not use.
            scene_contact: _,
            site_plan: _,
            surface,
            vehicles: [one, two],
            impact,
            reconstruct,
            // It is for estimates alone, as what was recorded is.
            estimate: _,
            ranges: _,
            // Numbers that share an error are columns that have it.
            uncertainty: _,
            departures,
            left_out: _,
        } = case;
        let sought = match reconstruct {
            None => None,
            Some(Reconstruct { find: Find::Both, .. }) => return Err(Alone::BothSpeeds),
            Some(_) if case.is_by_momentum() => return Err(Alone::BothSpeeds),
            Some(Reconstruct { find: Find::One(unknown), energy_basis }) => Some(Sought {
                unknown: *unknown,
                basis: energy_basis.energy(),
                share: match energy_basis {
                    Basis::Dissipated | Basis::Absorbed => None,
                    Basis::TangentialShare(share) => Some(*share),
                },
            }),
        };
        // Vehicles that are followed to rest have outputs that a block does not compute.
        let has_drag =
            |vehicle: &GivenVehicle<Number>| vehicle.after.as_ref().is_some_and(|after| after.drag.is_some());
        if surface.is_some() && (has_drag(one) || has_drag(two)) {
            return Err(Alone::Ways);
        }
        let GivenImpact { crush_plane, law } = impact.as_ref().ok_or(Alone::Incomplete)?;
        let seeks = sought.map(|sought| sought.unknown.vehicle());
        let all = Output::of_two_vehicles(seeks.unwrap_or(VehicleId::One));
        let place = |wanted: &Output| all.iter().position(|output| output == wanted);
        let places = outputs.iter().map(place).collect::<Option<Vec<usize>>>().ok_or(Alone::Incomplete)?;
        let mut of_all = [0.0; OUTPUTS];
        for (place, central) in places.iter().zip(central) {
            of_all[*place] = *central;
        }
        let vehicle = |given: &GivenVehicle<Number>, id: VehicleId| {
            // A factor that is absent is one.
            let yaw_factor = departures.yaw_radius[id.index()].unwrap_or(Number::Known(1.0));
            let (factor, moved) = (departures.stiffness[id.index()], departures.contact[id.index()]);
            let vehicle = Vehicle::new(given, yaw_factor, factor, moved, seeks == Some(id))?;
            match (seeks, &vehicle.damage) {
                (Some(_), Damage::Unknown) => Err(Alone::NoDamage),
                _ => Ok(vehicle),
            }
        };
        let vehicles = [vehicle(one, VehicleId::One)?, vehicle(two, VehicleId::Two)?];
        let at_once = sought.and_then(|sought| AtOnce::new(&sought, law));
        let (axes, crush_plane, law) = (*axes, *crush_plane, law.clone());
        let block = Self { axes, vehicles, crush_plane, sought, law, at_once, places, central: of_all };
        let read = uncertain_places(block.numbers());
        if read == uncertain { Ok(block) } else { Err(Alone::Unread) }
    }

    /// Every number that it reads.
    fn numbers(&self) -> Vec<Number> {
        // What is solved at once is the same law.
        let Self { axes: _, vehicles, crush_plane, sought, law, at_once: _, places: _, central: _ } = self;
        let mut numbers = vec![crush_plane.number()];
        drop(law.map(|number| numbers.push(number)));
        if let Some(Sought { unknown: _, basis: _, share }) = sought {
            numbers.extend(*share);
        }
        for Vehicle { body, damage, face, idle } in vehicles {
            match body {
                Collider::Moves(mover) => numbers.extend(mover.numbers()),
                Collider::Fixed { contact: None, .. } => {}
                Collider::Fixed { heading, contact: Some(contact) } => {
                    let heading = heading.as_ref().into_iter();
                    numbers.extend(heading.chain(contact.quantities()).map(Quantity::number));
                }
            }
            numbers.extend(damage.numbers());
            let outline = face.iter().flat_map(|(_, outline)| outline.quantities());
            numbers.extend(outline.map(Quantity::number));
            numbers.extend(idle);
        }
        numbers
    }

    /// Solves a block, and tells of each sample whether it is settled: that is its answer, or it has none for
    /// the reason that is noted.
    #[inline(always)]
    pub(super) fn evaluate(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> [bool; LANES] {
        let mut posed = Posed::NOTHING;
        self.pose(inputs, &mut posed);
        let mut settled = [false; LANES];
        if let (Some(law), Some(sought)) = (&self.at_once, self.sought) {
            let e = law.restitution.lanes(inputs);
            let found = match law.condition {
                Condition::Restitution(number) => {
                    let numbers = [&e, &number.lanes(inputs)];
                    self.at_once(instructions, (Tangential::Restitution, numbers), sought, &posed, outputs)
                }
                Condition::Friction(number) => {
                    let numbers = [&e, &number.lanes(inputs)];
                    self.at_once(instructions, (Tangential::Friction, numbers), sought, &posed, outputs)
                }
            };
            (settled, *reasons) = found;
        }
        if settled != [true; LANES] {
            self.in_turn(&posed, inputs, outputs, reasons, &mut settled);
        }
        settled
    }

    /// The vehicles of a block and what is known of their damage, in place of [nothing](Posed::NOTHING): each
    /// column is written where it stays, as together they are some kilobytes.
    #[inline(always)]
    fn pose(&self, inputs: &[Lanes], posed: &mut Posed) {
        let [one, two] = &self.vehicles;
        let Posed { vehicles: [v1, v2], crush_plane, crush_energy, faults } = posed;
        one.fill(self.axes, inputs, v1);
        two.fill(self.axes, inputs, v2);
        lateral(self.axes, &self.crush_plane, inputs, crush_plane);
        *faults = [Reason::Other.code(); LANES];
        one.damage.add_energy(inputs, &v1.mass, crush_energy, faults);
        two.damage.add_energy(inputs, &v2.mass, crush_energy, faults);
        if one.face.is_some() | two.face.is_some() {
            self.refuse_faces(inputs, crush_energy);
        }
    }

    /// How many of these samples of a block have more than one speed that gives their crush energy.
    #[inline(never)]
    pub(super) fn several_speeds(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        lanes: impl Iterator<Item = usize>,
    ) -> usize {
        let Some(sought) = self.sought else { return 0 };
        let mut posed = Posed::NOTHING;
        dispatch!(instructions, self.pose(inputs, &mut posed));
        let has_several = |lane: &usize| {
            let problem = self.problem(&posed, sought, inputs, *lane);
            problem.is_ok_and(|problem| problem.has_several_speeds())
        };
        lanes.filter(has_several).count()
    }

    /// (J) no crush energy where the engine refuses the place of a damaged side.
    #[inline(never)]
    fn refuse_faces(&self, inputs: &[Lanes], crush_energy: &mut Lanes) {
        for (side, outline) in self.vehicles.iter().filter_map(|vehicle| vehicle.face.as_ref()) {
            for (lane, energy) in crush_energy.iter_mut().enumerate() {
                let distance = outline.map(|number| number.at(inputs, lane)).dimensions().face(*side);
                // Where the damage lies along its side is idle.
                if DamagedFace::new(*side, distance, 0.0).is_err() {
                    *energy = f64::NAN;
                }
            }
        }
    }

    /// Which samples are settled, and why those have no answer that have none. A function of its own for each
    /// condition and instruction set: all in one would take a compiler many times as long.
    #[inline(never)]
    fn at_once(
        &self,
        instructions: Instructions,
        law: (impl Fn(f64) -> Tangential, [&Lanes; 2]),
        sought: Sought,
        posed: &Posed,
        outputs: &mut [Lanes],
    ) -> ([bool; LANES], [u8; LANES]) {
        dispatch!(instructions, self.at_once_with(law, sought, posed, outputs))
    }

    #[inline(always)]
    fn at_once_with(
        &self,
        (condition, [e, numbers]): (impl Fn(f64) -> Tangential, [&Lanes; 2]),
        Sought { unknown, basis, share: _ }: Sought,
        posed: &Posed,
        outputs: &mut [Lanes],
    ) -> ([bool; LANES], [u8; LANES]) {
        // On the stack of this function, so that the compiler knows that no column is part of another.
        let mut values = [Lanes::ZERO; OUTPUTS];
        let (mut settled, mut reasons) = ([false; LANES], [SUCCEEDED; LANES]);
        for lane in 0..LANES {
            let (law, is_law) = Law::new_with_validity(e[lane], condition(numbers[lane]));
            let (contact, motions, is_contact) = posed.contact(lane);
            let crush_energy = posed.crush_energy[lane];
            let law = law.into();
            let problem =
                Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share: 0.0 };
            let (speed, outcome, [is_answer, pulls]) = problem.solve_with_verdict();
            let is_taken = is_law & is_contact & !crush_energy.is_nan();
            settled[lane] = !is_taken | is_answer | pulls;
            let reason = if is_answer | !pulls { SUCCEEDED } else { Reason::Pulling.code() };
            reasons[lane] = if is_taken { reason } else { posed.faults[lane] };
            for (column, value) in values.iter_mut().zip(answer(self.axes, &self.central, speed, &outcome)) {
                column[lane] = value;
            }
        }
        for (output, place) in outputs.iter_mut().zip(&self.places) {
            if let Some(column) = values.get(*place) {
                *output = *column;
            }
        }
        (settled, reasons)
    }

    /// Solves those samples that are not `settled` one after the other.
    ///
    /// Compiled once: it gains nothing from a copy for each instruction set.
    #[inline(never)]
    fn in_turn(
        &self,
        posed: &Posed,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
        settled: &mut [bool; LANES],
    ) {
        let unsettled = settled.iter_mut().zip(reasons).enumerate().filter(|(_, (settled, _))| !**settled);
        for (lane, (is_settled, reason)) in unsettled {
            match self.solve(posed, inputs, lane) {
                Ok((speed, outcome)) => {
                    let values = answer(self.axes, &self.central, speed, &outcome);
                    for (output, place) in outputs.iter_mut().zip(&self.places) {
                        if let Some(value) = values.get(*place) {
                            output[lane] = *value;
                        }
                    }
                    *is_settled = true;
                }
                Err(Some(refusal)) => {
                    *reason = refusal.code();
                    *is_settled = true;
                }
                Err(None) => {}
            }
        }
    }

    /// The speed of a sample, not a number where none is asked for, and its impact.
    ///
    /// # Errors
    /// Why there is none; `None` where the single case has to tell.
    fn solve(&self, posed: &Posed, inputs: &[Lanes], lane: usize) -> Result<(f64, Outcome), Option<Reason>> {
        if let Some(sought) = self.sought {
            let problem = self.problem(posed, sought, inputs, lane).map_err(Some)?;
            return problem.speed_and_impact().map_err(|why| Some(Reason::of(&refused(&problem, why))));
        }
        let (contact, law, motions) = self.collision(posed, inputs, lane).map_err(Some)?;
        // A damage of which the engine refuses something has no energy. Of one whose energy is known an
        // impact asks nothing.
        if posed.crush_energy[lane].is_nan() {
            return Err(None);
        }
        let law = law.at(-contact.approach(&motions).velocity.normal);
        match contact.impact(motions, &law) {
            Ok(outcome) => Ok((f64::NAN, outcome)),
            Err(why) => Err(Some(Reason::of_impact(&why))),
        }
    }

    /// The equation for the speed of a sample.
    #[inline(always)]
    fn problem(
        &self,
        posed: &Posed,
        Sought { unknown, basis, share }: Sought,
        inputs: &[Lanes],
        lane: usize,
    ) -> Result<Problem, Reason> {
        let crush_energy = posed.crush_energy[lane];
        if crush_energy.is_nan() {
            return Err(posed.fault(lane));
        }
        let (contact, law, motions) = self.collision(posed, inputs, lane)?;
        let tangential_share = share.map_or(0.0, |share| share.at(inputs, lane));
        Ok(Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share })
    }

    #[inline(always)]
    fn collision(
        &self,
        posed: &Posed,
        inputs: &[Lanes],
        lane: usize,
    ) -> Result<(Contact, VaryingLaw, [Motion; 2]), Reason> {
        let law = self.law.map(|number| number.at(inputs, lane));
        let law = law.of_engine(self.axes).map_err(|_| posed.fault(lane))?;
        let (contact, motions, is_contact) = posed.contact(lane);
        if is_contact { Ok((contact, law, motions)) } else { Err(posed.fault(lane)) }
    }
}

impl AtOnce {
    /// Of no curve of restitution, no moment impulse and no share of the tangential work.
    fn new(sought: &Sought, law: &ImpactLaw<Number>) -> Option<Self> {
        let zero = Number::Known(0.0);
        if sought.share.is_some() {
            return None;
        }
        let (restitution, condition) = match law {
            ImpactLaw::Brach {
                restitution: Restitution::Constant(e),
                tangential,
                moment_restitution: None,
            } => match tangential {
                BrachTangential::Critical => (*e, Condition::Restitution(zero)),
                BrachTangential::Friction(limit) => (*e, Condition::Friction(*limit)),
                BrachTangential::FractionOfCritical(_) | BrachTangential::Ratio(_) => return None,
            },
            ImpactLaw::Ishikawa { restitution: Restitution::Constant(e), tangential_restitution } => {
                (*e, Condition::Restitution(*tangential_restitution))
            }
            // A common velocity along the normal.
            ImpactLaw::Woolley { tangential_velocity_change: None } => (zero, Condition::Restitution(zero)),
            _ => return None,
        };
        Some(Self { restitution, condition })
    }
}

/// The part of a block that does not depend on the law, in SI.
struct Posed {
    vehicles: [VehicleLanes; 2],
    crush_plane: Lanes,
    /// Of both vehicles; not a number where a sample has none.
    crush_energy: Lanes,
    /// [`Reason::code`] of a sample of which the engine refuses something while it takes it in, as
    /// [`Reason::of_case`]: a fault of the case, unless a stiffness has a reason of its own.
    faults: [u8; LANES],
}

impl Posed {
    /// Zeros, which cost the least to make.
    const NOTHING: Self = Self {
        vehicles: [VehicleLanes::NOTHING; 2],
        crush_plane: Lanes::ZERO,
        crush_energy: Lanes::ZERO,
        faults: [0; LANES],
    };

    fn fault(&self, lane: usize) -> Reason {
        Reason::of_code(self.faults[lane])
    }

    /// The contact of one sample and the motions before it, and whether there is one.
    #[inline(always)]
    fn contact(&self, lane: usize) -> (Contact, [Motion; 2], bool) {
        let [v1, v2] = &self.vehicles;
        let ((p1, is_1), (p2, is_2)) = (v1.participant(lane), v2.participant(lane));
        let (contact, is_contact) = Contact::new_with_validity([p1, p2], self.crush_plane[lane]);
        (contact, [v1.motion(lane), v2.motion(lane)], is_1 & is_2 & is_contact)
    }
}

/// The outputs of a reconstruction of two vehicles, in the order of [`Output::of_two_vehicles`].
#[inline(always)]
fn answer(axes: Axes, central: &[f64; OUTPUTS], speed: f64, outcome: &Outcome) -> [f64; OUTPUTS] {
    let mut central = central.iter().copied();
    of_impact!(VehicleId::One, output => {
        as_beside(output, central.next().unwrap_or_default(), output.of_impact(axes, speed, outcome))
    })
}

/// A vehicle of each sample, or a fixed object, in SI.
pub(crate) struct VehicleLanes {
    is_fixed: bool,
    pub(crate) mass: Lanes,
    yaw_inertia: Lanes,
    pub(crate) heading: Lanes,
    forward: Lanes,
    left: Lanes,
    velocity_x: Lanes,
    velocity_y: Lanes,
    yaw_rate: Lanes,
}

impl VehicleLanes {
    /// Before a vehicle or an object comes in its place.
    pub(crate) const NOTHING: Self = {
        const ZERO: Lanes = Lanes::ZERO;
        Self {
            is_fixed: false,
            mass: ZERO,
            yaw_inertia: ZERO,
            heading: ZERO,
            forward: ZERO,
            left: ZERO,
            velocity_x: ZERO,
            velocity_y: ZERO,
            yaw_rate: ZERO,
        }
    };

    /// [Nothing](Self::NOTHING) becomes a fixed object. One of which the case tells no point of contact is a
    /// [barrier](Participant::barrier), with its point in its centre of gravity.
    #[inline(always)]
    fn fix(
        &mut self,
        axes: Axes,
        heading: Option<&Quantity<Number>>,
        contact: Option<&ContactPoint<Number>>,
        inputs: &[Lanes],
    ) {
        self.is_fixed = true;
        let Some(contact) = contact else { return };
        point(axes, contact, inputs, [&mut self.forward, &mut self.left]);
        if let Some(heading) = heading {
            lateral(axes, heading, inputs, &mut self.heading);
        }
    }

    #[inline(always)]
    pub(crate) fn participant(&self, lane: usize) -> (Participant, bool) {
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
    pub(crate) fn motion(&self, lane: usize) -> Motion {
        let velocity = Vector2::new(self.velocity_x[lane], self.velocity_y[lane]);
        Motion { velocity, yaw_rate: self.yaw_rate[lane] }
    }
}

impl Vehicle {
    /// `yaw_factor` is that on the radius of gyration of a size class, `factor` that on the stiffness of a
    /// category, and a contact point that is placed is `moved` along the face and inward.
    fn new(
        given: &GivenVehicle<Number>,
        yaw_factor: Number,
        factor: Option<Number>,
        moved: [Option<Quantity<Number>>; 2],
        is_sought: bool,
    ) -> Result<Self, Alone> {
        if given.fixed {
            let body = Collider::Fixed { heading: given.heading, contact: given.contact };
            return Ok(Self { body, damage: Damage::Energy(None), face: None, idle: Vec::new() });
        }
        let mover = Mover::new(given, [Some(yaw_factor), factor], moved, is_sought)?;
        let damage = Damage::new(given, factor)?;
        let mut idle = Vec::new();
        let ees = given.energy.as_ref().and_then(KnownEnergy::ees);
        if let Some(crush) = &given.crush {
            let quantities = [crush.offset, crush.oblique_angle, crush.moment_arm, angle(crush.pdof)];
            idle.extend(quantities.iter().flatten().map(Quantity::number));
            if let Some(ObliqueCorrection::Friction(friction)) = crush.oblique {
                idle.push(friction);
            }
        }
        if let Some(ees) = ees {
            idle.extend([ees.moment_arm, angle(ees.pdof)].iter().flatten().map(Quantity::number));
        }
        let face = match (&given.crush, given.outline) {
            (Some(crush), Some(outline)) => Some((crush.side, outline)),
            (None, Some(outline)) => {
                idle.extend(outline.quantities().map(Quantity::number));
                None
            }
            (_, None) => None,
        };
        let is_uncertain = |(_, outline): &(Side, Outline<Number>)| {
            outline.quantities().iter().any(|quantity| quantity.number().is_uncertain())
        };
        Ok(Self { body: Collider::Moves(mover), damage, face: face.filter(is_uncertain), idle })
    }

    // A closure for it would be compiled for the least of the instructions.
    #[inline(always)]
    fn fill(&self, axes: Axes, inputs: &[Lanes], lanes: &mut VehicleLanes) {
        match &self.body {
            Collider::Moves(mover) => mover.fill(axes, inputs, lanes),
            Collider::Fixed { heading, contact } => {
                lanes.fix(axes, heading.as_ref(), contact.as_ref(), inputs);
            }
        }
    }
}

/// That of a direction which is given as an angle.
fn angle(pdof: Option<Pdof<Number>>) -> Option<Quantity<Number>> {
    match pdof {
        Some(Pdof::Angle(angle)) => Some(angle),
        Some(Pdof::Clock(_)) | None => None,
    }
}

impl Damage {
    /// `factor` is that on the stiffness of a category.
    pub(crate) fn new(given: &GivenVehicle<Number>, factor: Option<Number>) -> Result<Self, Alone> {
        let Some(crush) = &given.crush else {
            return match &given.energy {
                None => Ok(Self::Unknown),
                Some(KnownEnergy::Undamaged) => Ok(Self::Energy(None)),
                // Neither the side nor how the force acts changes the energy.
                Some(KnownEnergy::Ees(GivenEes { ees, side: _, pdof: _, moment_arm: _ })) => {
                    Ok(Self::Energy(Some(*ees)))
                }
            };
        };
        let (crushed, stiffness) = Crushed::new(crush)?;
        let other = || Resistance::Other(crush.side, stiffness.clone());
        let resistance = match (stiffness, factor) {
            (StiffnessForm::Line(line), _) => Line::new(*line).map_or_else(other, Resistance::Line),
            (StiffnessForm::Category(category), Some(factor)) => {
                let known = StiffnessForm::Category(*category).structure(crush.side);
                let Ok(SideStiffness::Uniform(known)) = known else { return Err(Alone::Incomplete) };
                Resistance::Category(known, factor)
            }
            (StiffnessForm::Category(_), None) => return Err(Alone::Incomplete),
            (StiffnessForm::Test(_) | StiffnessForm::Zones(_), _) => other(),
        };
        Ok(Self::Crush(crushed, resistance))
    }

    /// Every number that it reads.
    pub(crate) fn numbers(&self) -> Vec<Number> {
        let mut numbers = Vec::new();
        match self {
            Self::Unknown | Self::Energy(None) => {}
            Self::Energy(Some(ees)) => numbers.push(ees.number()),
            Self::Crush(crushed, resistance) => {
                numbers.extend(crushed.numbers());
                match resistance {
                    Resistance::Line(line) => numbers.extend(line.numbers()),
                    Resistance::Category(_, factor) => numbers.push(*factor),
                    Resistance::Other(_, stiffness) => {
                        drop(stiffness.map(|number| numbers.push(number)));
                    }
                }
            }
        }
        numbers
    }

    /// (J) adds the crush energy; not a number where a sample has none. Where the stiffness is refused for a
    /// reason of its own, that becomes the code of a fault that has none such yet.
    #[inline(always)]
    pub(crate) fn add_energy(
        &self,
        inputs: &[Lanes],
        mass: &Lanes,
        total: &mut Lanes,
        faults: &mut [u8; LANES],
    ) {
        match self {
            Self::Unknown | Self::Energy(None) => {}
            Self::Energy(Some(ees)) => {
                let mut speeds = Lanes::ZERO;
                si(ees, inputs, &mut speeds);
                for lane in 0..LANES {
                    total[lane] += energy_of_equivalent_speed(speeds[lane], mass[lane]).unwrap_or(f64::NAN);
                }
            }
            Self::Crush(crushed, Resistance::Line(line)) => {
                crushed.add_energy(inputs, &line.lanes(inputs), total);
            }
            Self::Crush(crushed, Resistance::Other(side, stiffness)) => match stiffness {
                StiffnessForm::Line(line) => {
                    crushed.add_energy_by_zones(inputs, slice::from_ref(line), total, faults);
                }
                StiffnessForm::Zones(lines) if lines.len() + 1 == crushed.depths.len() => {
                    crushed.add_energy_by_zones(inputs, lines, total, faults);
                }
                _ => crushed.add_energy_in_turn(inputs, *side, stiffness, total, faults),
            },
            Self::Crush(crushed, Resistance::Category(stiffness, factor)) => {
                crushed.add_energy(inputs, &scaled_lanes(stiffness, *factor, inputs), total);
            }
        }
    }
}

impl Mover {
    /// The factors are that on the radius of gyration of a size class and that on the stiffness of a
    /// category; a contact point that is placed is `moved` along the face and inward.
    pub(crate) fn new(
        vehicle: &GivenVehicle<Number>,
        [yaw_factor, factor]: [Option<Number>; 2],
        moved: [Option<Quantity<Number>>; 2],
        is_sought: bool,
    ) -> Result<Self, Alone> {
        let GivenVehicle {
            name: _,
            kind,
            fixed,
            mass,
            yaw,
            class,
            wheelbase,
            // These are for drawings, warnings and the motion to rest.
            track: _,
            cg_to_front_axle: _,
            length,
            outline,
            diameter: _,
            heading,
            sideslip,
            // It is for the motion before and after the impact.
            position: _,
            // It may be placed on the damage.
            contact: _,
            motion,
            yaw_rate,
            // The damage is read beside this.
            crush: _,
            energy: _,
            // The motion before and after the impact is not used by the impact.
            before: _,
            after: _,
            recorder: _,
            certain_speed: _,
        } = vehicle;
        if *fixed {
            return Err(Alone::Incomplete);
        }
        // The vector of a vehicle whose speed is sought tells its direction.
        if sideslip.is_some() || (is_sought && matches!(motion, Some(Velocity::Vector { .. }))) {
            return Err(Alone::Course);
        }
        let yaw = match (*yaw, *class, yaw_factor) {
            (Some(yaw), ..) => Yaw::Given(yaw),
            (None, Some(class), Some(factor)) => {
                Yaw::Class(VehicleClass::new(class).map_err(|_| Alone::Incomplete)?, factor)
            }
            (None, None, Some(factor)) if kind.unwrap_or_default() == Kind::Car => {
                let length = outline.map(|outline| outline.length).or(*length);
                let lengths = wheelbase.zip(length).ok_or(Alone::Incomplete)?;
                Yaw::Burg(lengths.into(), factor)
            }
            (None, ..) => return Err(Alone::Incomplete),
        };
        Ok(Self {
            mass: mass.ok_or(Alone::Incomplete)?,
            yaw,
            heading: heading.ok_or(Alone::Incomplete)?,
            contact: Contacted::new(vehicle, factor, moved)?,
            motion: if is_sought { None } else { Some(motion.ok_or(Alone::Incomplete)?) },
            yaw_rate: *yaw_rate,
        })
    }

    /// Every number that it reads.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self { mass, yaw, heading, contact, motion, yaw_rate } = self;
        let (Mass::Mass(mass) | Mass::Weight(mass)) = mass;
        let (yaw, lengths) = match yaw {
            Yaw::Given(YawInertia::Inertia(yaw) | YawInertia::Radius(yaw)) => (yaw.number(), None),
            Yaw::Class(_, factor) => (*factor, None),
            Yaw::Burg(lengths, factor) => (*factor, Some(lengths)),
        };
        let (contact, moved) = match contact {
            Contacted::Given(contact) => (Some(contact.quantities()), None),
            // The damage and where it lies are read beside this.
            Contacted::Placed(placed) => (None, Some(&placed.moved)),
        };
        let contact = contact.into_iter().flatten().chain(moved.into_iter().flatten().flatten());
        let motion = match motion {
            None => [None; 2],
            Some(Velocity::Speed(speed)) => [Some(speed), None],
            Some(Velocity::Vector { x, y }) => [Some(x), Some(y)],
        };
        let given = [mass, heading].into_iter().chain(contact).chain(motion.into_iter().flatten());
        let given = given.chain(yaw_rate).chain(lengths.into_iter().flatten());
        given.map(Quantity::number).chain([yaw])
    }

    /// [Nothing](VehicleLanes::NOTHING) becomes this vehicle.
    #[inline(always)]
    pub(crate) fn fill(&self, axes: Axes, inputs: &[Lanes], lanes: &mut VehicleLanes) {
        let VehicleLanes {
            is_fixed: _,
            mass,
            yaw_inertia,
            heading,
            forward,
            left,
            velocity_x,
            velocity_y,
            yaw_rate,
        } = lanes;
        match self.mass {
            Mass::Mass(given) => each(&given, inputs, mass, |mass| Mass::Mass(mass).kg()),
            Mass::Weight(given) => each(&given, inputs, mass, |weight| Mass::Weight(weight).kg()),
        }
        match self.yaw {
            Yaw::Given(YawInertia::Inertia(inertia)) => {
                si(&inertia, inputs, yaw_inertia);
            }
            Yaw::Class(class, factor) => {
                let mut known = None;
                let factors = factor.column(inputs, &mut known);
                for lane in 0..LANES {
                    yaw_inertia[lane] = class_yaw_inertia(&class, mass[lane], factors[lane]);
                }
            }
            Yaw::Burg([wheelbase, length], factor) => {
                let (mut wheelbases, mut lengths) = (Lanes::ZERO, Lanes::ZERO);
                si(&wheelbase, inputs, &mut wheelbases);
                si(&length, inputs, &mut lengths);
                let factors = factor.lanes(inputs);
                for lane in 0..LANES {
                    let estimate = yaw_inertia_burg(mass[lane], wheelbases[lane], lengths[lane]);
                    let factor = factors[lane];
                    yaw_inertia[lane] = estimate.map_or(f64::NAN, |estimate| estimate * factor * factor);
                }
            }
            Yaw::Given(YawInertia::Radius(radius)) => {
                let mut known = None;
                let numbers = radius.number().column(inputs, &mut known);
                for lane in 0..LANES {
                    yaw_inertia[lane] = YawInertia::Radius(radius.with(numbers[lane])).kg_m2(mass[lane]);
                }
            }
        }
        match &self.contact {
            Contacted::Given(contact) => point(axes, contact, inputs, [forward, left]),
            Contacted::Placed(placed) => placed.point(axes, inputs, [forward, left]),
        }
        lateral(axes, &self.heading, inputs, heading);
        match self.motion {
            None => {}
            Some(Velocity::Speed(speed)) => {
                let mut known = None;
                let numbers = speed.number().column(inputs, &mut known);
                for lane in 0..LANES {
                    let velocity = Motion::along(heading[lane], speed.with(numbers[lane]).si()).velocity;
                    (velocity_x[lane], velocity_y[lane]) = (velocity.x, velocity.y);
                }
            }
            Some(Velocity::Vector { x, y }) => {
                si(&x, inputs, velocity_x);
                lateral(axes, &y, inputs, velocity_y);
            }
        }
        if let Some(given) = &self.yaw_rate {
            lateral(axes, given, inputs, yaw_rate);
        }
    }
}

impl Contacted {
    fn new(
        vehicle: &GivenVehicle<Number>,
        factor: Option<Number>,
        moved: [Option<Quantity<Number>>; 2],
    ) -> Result<Self, Alone> {
        if let Some(contact) = vehicle.contact {
            return Ok(Self::Given(contact));
        }
        let crush = vehicle.crush.as_ref().ok_or(Alone::Incomplete)?;
        let outline = match (vehicle.outline, vehicle.class) {
            (Some(outline), _) => BodyOutline::Given(outline),
            (None, Some(class)) => {
                let known = VehicleClass::new(class).map_err(|_| Alone::Incomplete)?;
                BodyOutline::Class(Dimensions::of_class(class, &known))
            }
            (None, None) => return Err(Alone::Incomplete),
        };
        let Damage::Crush(crushed, resistance) = Damage::new(vehicle, factor)? else {
            return Err(Alone::Incomplete);
        };
        let offset = crush.offset.ok_or(Alone::Incomplete)?;
        Ok(Self::Placed(Box::new(Placed { side: crush.side, outline, offset, moved, crushed, resistance })))
    }
}

impl Placed {
    /// (m) forward and left of the centre of gravity; not a number where the engine refuses the damage.
    #[inline(never)]
    fn point(&self, axes: Axes, inputs: &[Lanes], [forward, left]: [&mut Lanes; 2]) {
        let moments = self.moments(inputs);
        for lane in 0..LANES {
            let at = |quantity: &Quantity<Number>| quantity.with(quantity.number().at(inputs, lane)).si();
            let dimensions = match &self.outline {
                BodyOutline::Given(outline) => outline.map(|number| number.at(inputs, lane)).dimensions(),
                BodyOutline::Class(dimensions) => *dimensions,
            };
            let along = |distance: f64| along_face(axes, self.side, distance);
            let [moved, inward] = self.moved.each_ref().map(|moved| moved.as_ref().map_or(0.0, at));
            let moved = [along(moved), inward];
            let placed = moments[lane].and_then(|moments| {
                placed_contact(self.side, &dimensions, along(at(&self.offset)), moved, &moments).ok()
            });
            [forward[lane], left[lane]] = placed.unwrap_or([f64::NAN; 2]);
        }
    }

    /// The crush energy of each sample and its moments; `None` where the engine refuses the damage.
    fn moments(&self, inputs: &[Lanes]) -> [Option<EnergyMoments>; LANES] {
        let uniform = |[a, b, g]: [Lanes; 3]| {
            let mut width = Lanes::ZERO;
            let zones = self.crushed.zones().map(|(number, depths)| {
                self.crushed.width(number, inputs, &mut width);
                (width, depths)
            });
            let zones: Vec<(Lanes, [&Quantity<Number>; 2])> = zones.collect();
            std::array::from_fn(|lane| {
                let (stiffness, is_stiffness) = Stiffness::from_abg_with_validity(a[lane], b[lane], g[lane]);
                let at = |depth: &Quantity<Number>| depth.with(depth.number().at(inputs, lane)).si();
                let mut moments = is_stiffness.then(EnergyMoments::none);
                for (width, depths) in &zones {
                    let zone = Zone { width: width[lane], depths: depths.map(at) };
                    moments =
                        moments.filter(|_| zone.is_valid()).map(|moments| moments.with(zone, &stiffness));
                }
                moments
            })
        };
        match &self.resistance {
            Resistance::Line(line) => uniform(line.lanes(inputs)),
            Resistance::Category(stiffness, factor) => uniform(scaled_lanes(stiffness, *factor, inputs)),
            Resistance::Other(side, stiffness) => std::array::from_fn(|lane| {
                let structure = stiffness.map(|number| number.at(inputs, lane)).structure(*side).ok()?;
                EnergyMoments::of(&self.crushed.profile(inputs, lane).ok()?, &structure).ok()
            }),
        }
    }
}

/// A, B and G of a category with the factor on its stiffness.
#[inline(always)]
fn scaled_lanes(stiffness: &Stiffness, factor: Number, inputs: &[Lanes]) -> [Lanes; 3] {
    let mut known = None;
    let factors = factor.column(inputs, &mut known);
    let mut stiffnesses = [Lanes::ZERO; 3];
    let [a, b, g] = &mut stiffnesses;
    for lane in 0..LANES {
        [a[lane], b[lane], g[lane]] = scaled_stiffness(stiffness, factors[lane]);
    }
    stiffnesses
}

impl Crushed {
    /// With what the side resisted with.
    fn new(crush: &Crush<Number>) -> Result<(Self, &StiffnessForm<Number>), Alone> {
        let Crush {
            from_force_balance,
            width,
            depths,
            spacing,
            stiffness,
            // These are for CRASH3's own answer, which no sample asks for.
            side: _,
            pdof: _,
            oblique: _,
            offset: _,
            oblique_angle: _,
            moment_arm: _,
        } = crush;
        if *from_force_balance {
            return Err(Alone::NoDamage);
        }
        let widths = match (spacing, width) {
            // The width is then that of a drawing.
            (Some(spacing), _) => Widths::Each(spacing.clone()),
            (None, Some(width)) => Widths::Equal(*width),
            (None, None) => return Err(Alone::Incomplete),
        };
        Ok((Self { widths, depths: depths.clone() }, stiffness))
    }

    /// Every number that it reads.
    fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self { widths, depths } = self;
        let widths = match widths {
            Widths::Equal(width) => slice::from_ref(width),
            Widths::Each(widths) => widths,
        };
        widths.iter().chain(depths).map(Quantity::number)
    }

    /// (m) the width of a zone, in place of that of the zone before it.
    #[inline(always)]
    fn width(&self, zone: usize, inputs: &[Lanes], width: &mut Lanes) {
        match &self.widths {
            Widths::Equal(whole) if zone == 0 => {
                each(whole, inputs, width, |whole| equal_spacing(whole.si(), self.depths.len()));
            }
            Widths::Equal(_) => {}
            Widths::Each(widths) => match widths.get(zone) {
                Some(own) => si(own, inputs, width),
                None => *width = NO_NUMBERS,
            },
        }
    }

    /// The number of each zone and the depths at its ends.
    #[inline(always)]
    fn zones(&self) -> impl Iterator<Item = (usize, [&Quantity<Number>; 2])> {
        let ends = self.depths.iter().zip(self.depths.iter().skip(1));
        ends.map(|(one, other)| [one, other]).enumerate()
    }

    /// The profile of one sample.
    fn profile(&self, inputs: &[Lanes], lane: usize) -> Result<Profile, CrushError> {
        let at = |quantity: &Quantity<Number>| quantity.with(quantity.number().at(inputs, lane)).si();
        let depths = self.depths.iter().map(at).collect();
        match &self.widths {
            Widths::Equal(width) => Profile::equally_spaced(depths, at(width)),
            Widths::Each(widths) => Profile::new(depths, widths.iter().map(at).collect()),
        }
    }

    /// (J) adds the crush energy of a structure, one sample after the other; not a number where a sample has
    /// none.
    #[inline(never)]
    fn add_energy_in_turn(
        &self,
        inputs: &[Lanes],
        side: Side,
        stiffness: &StiffnessForm<Number>,
        total: &mut Lanes,
        faults: &mut [u8; LANES],
    ) {
        for (lane, (total, fault)) in total.iter_mut().zip(faults).enumerate() {
            let energy = match stiffness.map(|number| number.at(inputs, lane)).structure(side) {
                Ok(stiffness) => {
                    self.profile(inputs, lane).and_then(|profile| stiffness.crush_energy(&profile)).ok()
                }
                Err(refusal) => {
                    note(fault, &refusal);
                    None
                }
            };
            *total += energy.unwrap_or(f64::NAN);
        }
    }

    /// (J) adds the crush energy where each zone has one of these, or all have the one; not a number where a
    /// sample has none.
    #[inline(never)]
    fn add_energy_by_zones(
        &self,
        inputs: &[Lanes],
        lines: &[StiffnessLine<Number>],
        total: &mut Lanes,
        faults: &mut [u8; LANES],
    ) {
        let (mut own, mut is_structure) = (Lanes::ZERO, [true; LANES]);
        let mut width = Lanes::ZERO;
        for ((number, ends), line) in self.zones().zip(lines.iter().cycle()) {
            self.width(number, inputs, &mut width);
            let mut known = [None; 2];
            let depths = columns(ends, inputs, &mut known);
            let mut known = [None; 4];
            let mut free = known.iter_mut();
            let numbers = line.map(|quantity| {
                let column = free.next().map(|known| quantity.number().column(inputs, known));
                quantity.with(column.unwrap_or(&NO_NUMBERS))
            });
            for lane in 0..LANES {
                let zone = Zone { width: width[lane], depths: si_at(ends, depths, lane) };
                let line = numbers.map(|quantity| quantity.with(quantity.number()[lane]));
                own[lane] += match line.stiffness() {
                    Ok(stiffness) => {
                        let energy = zone_energy(zone, &stiffness);
                        if zone.is_valid() { energy } else { f64::NAN }
                    }
                    Err(refusal) => {
                        // The first refusal is that of the structure.
                        if std::mem::replace(&mut is_structure[lane], false) {
                            note(&mut faults[lane], &refusal);
                        }
                        f64::NAN
                    }
                };
            }
        }
        for (total, own) in total.iter_mut().zip(&own) {
            *total += own;
        }
    }

    /// (J) adds the crush energy with A, B and G; not a number where a sample has none.
    #[inline(always)]
    pub(crate) fn add_energy(&self, inputs: &[Lanes], [a, b, g]: &[Lanes; 3], total: &mut Lanes) {
        let (mut own, mut width) = (Lanes::ZERO, Lanes::ZERO);
        for lane in 0..LANES {
            let (_, is_stiffness) = Stiffness::from_abg_with_validity(a[lane], b[lane], g[lane]);
            own[lane] = if is_stiffness { 0.0 } else { f64::NAN };
        }
        for (number, ends) in self.zones() {
            self.width(number, inputs, &mut width);
            let mut known = [None; 2];
            let depths = columns(ends, inputs, &mut known);
            for lane in 0..LANES {
                let zone = Zone { width: width[lane], depths: si_at(ends, depths, lane) };
                let (stiffness, _) = Stiffness::from_abg_with_validity(a[lane], b[lane], g[lane]);
                let energy = zone_energy(zone, &stiffness);
                own[lane] += if zone.is_valid() { energy } else { f64::NAN };
            }
        }
        for (total, own) in total.iter_mut().zip(&own) {
            *total += own;
        }
    }
}

/// Notes the reason of a refused structure, if it has one of its own and none is noted yet.
#[cold]
fn note(fault: &mut u8, refusal: &CrushError) {
    if *fault == Reason::Other.code() {
        *fault = Reason::of_structure(refusal).unwrap_or(Reason::Other).code();
    }
}

/// A stiffness without a limit, and without a G where that follows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Line {
    Crush([Quantity<Number>; 2]),
    CrushEnergy([Quantity<Number>; 3]),
    Root([Quantity<Number>; 2]),
    RootEnergy([Quantity<Number>; 3]),
}

impl Line {
    pub(crate) fn new(line: StiffnessLine<Number>) -> Option<Self> {
        match line {
            StiffnessLine::Crush { a, b, g: None, limit: None } => Some(Self::Crush([a, b])),
            StiffnessLine::Crush { a, b, g: Some(g), limit: None } => Some(Self::CrushEnergy([a, b, g])),
            StiffnessLine::Root { d0, d1, g: None, limit: None } => Some(Self::Root([d0, d1])),
            StiffnessLine::Root { d0, d1, g: Some(g), limit: None } => Some(Self::RootEnergy([d0, d1, g])),
            _ => None,
        }
    }

    /// Every number that it reads.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = Number> {
        let quantities: &[Quantity<Number>] = match self {
            Self::Crush(two) | Self::Root(two) => two,
            Self::CrushEnergy(three) | Self::RootEnergy(three) => three,
        };
        quantities.iter().map(Quantity::number)
    }

    /// A, B and G; not numbers where there is no such stiffness.
    #[inline(always)]
    pub(crate) fn lanes(&self, inputs: &[Lanes]) -> [Lanes; 3] {
        let limit = None;
        match self {
            Self::Crush(numbers) => {
                coefficients(numbers, inputs, |[a, b]| StiffnessLine::Crush { a, b, g: None, limit })
            }
            Self::CrushEnergy(numbers) => {
                coefficients(numbers, inputs, |[a, b, g]| StiffnessLine::Crush { a, b, g: Some(g), limit })
            }
            Self::Root(numbers) => {
                coefficients(numbers, inputs, |[d0, d1]| StiffnessLine::Root { d0, d1, g: None, limit })
            }
            Self::RootEnergy(numbers) => {
                coefficients(numbers, inputs, |[d0, d1, g]| StiffnessLine::Root { d0, d1, g: Some(g), limit })
            }
        }
    }
}

#[inline(always)]
fn coefficients<const N: usize>(
    quantities: &[Quantity<Number>; N],
    inputs: &[Lanes],
    line: impl Fn([Quantity; N]) -> StiffnessLine,
) -> [Lanes; 3] {
    let mut known = [None; N];
    let numbers = columns(quantities.each_ref(), inputs, &mut known);
    let mut stiffnesses = [Lanes::ZERO; 3];
    let [a, b, g] = &mut stiffnesses;
    for lane in 0..LANES {
        let line = line(std::array::from_fn(|i| quantities[i].with(numbers[i][lane])));
        [a[lane], b[lane], g[lane]] = match line.stiffness() {
            Ok(stiffness) => [stiffness.a(), stiffness.b(), stiffness.g()],
            Err(_) => [f64::NAN; 3],
        };
    }
    stiffnesses
}

/// The numbers of some quantities, each as [`Number::column`].
#[inline(always)]
fn columns<'a, const N: usize>(
    quantities: [&Quantity<Number>; N],
    inputs: &'a [Lanes],
    known: &'a mut [Option<Lanes>; N],
) -> [&'a Lanes; N] {
    let mut columns = [&NO_NUMBERS; N];
    for ((column, known), quantity) in columns.iter_mut().zip(known).zip(quantities) {
        *column = quantity.number().column(inputs, known);
    }
    columns
}

/// What they are in SI in one sample.
#[inline(always)]
fn si_at([one, other]: [&Quantity<Number>; 2], [ones, others]: [&Lanes; 2], lane: usize) -> [f64; 2] {
    [one.with(ones[lane]).si(), other.with(others[lane]).si()]
}

/// What a quantity is in SI, of each sample.
#[inline(always)]
pub(crate) fn si(quantity: &Quantity<Number>, inputs: &[Lanes], column: &mut Lanes) {
    each(quantity, inputs, column, |quantity| quantity.si());
}

/// (m) a point forward and left of the centre of gravity.
#[inline(always)]
fn point(axes: Axes, contact: &ContactPoint<Number>, inputs: &[Lanes], [forward, left]: [&mut Lanes; 2]) {
    let [mut first, mut second] = [None; 2];
    match contact {
        ContactPoint::Polar { distance, angle } => {
            let distances = distance.number().column(inputs, &mut first);
            let angles = angle.number().column(inputs, &mut second);
            for lane in 0..LANES {
                let contact = ContactPoint::Polar {
                    distance: distance.with(distances[lane]),
                    angle: angle.with(angles[lane]),
                };
                let [x, y] = contact.xy();
                (forward[lane], left[lane]) = (x, axes.lateral(y));
            }
        }
        ContactPoint::Cartesian { x, y } => {
            let (xs, ys) = (x.number().column(inputs, &mut first), y.number().column(inputs, &mut second));
            for lane in 0..LANES {
                let contact = ContactPoint::Cartesian { x: x.with(xs[lane]), y: y.with(ys[lane]) };
                let [x, y] = contact.xy();
                (forward[lane], left[lane]) = (x, axes.lateral(y));
            }
        }
    }
}

/// What counts across or turns, in the axes of the engine.
#[inline(always)]
pub(crate) fn lateral(axes: Axes, quantity: &Quantity<Number>, inputs: &[Lanes], column: &mut Lanes) {
    each(quantity, inputs, column, |quantity| axes.lateral(quantity.si()));
}

#[inline(always)]
fn each(quantity: &Quantity<Number>, inputs: &[Lanes], column: &mut Lanes, value: impl Fn(Quantity) -> f64) {
    let mut known = None;
    let numbers = quantity.number().column(inputs, &mut known);
    for (lane, number) in column.iter_mut().zip(numbers) {
        *lane = value(quantity.with(*number));
    }
}
