//! A block of samples of a reconstruction at once.
//!
//! Each sample goes through the functions of the engine through which a single case goes, in the same order,
//! so that the answers have the same bits. But there is nothing between them that keeps a compiler from
//! vectorising the loop over the samples: no allocation, no error, no branch. What cannot be said so is left
//! to the single case: each [`Alone`], and every sample that fails.

use ::uncertainty::{LANES, Lanes};
use crash3::{
    EnergyBasis, SideStiffness, Stiffness, VehicleClass, Zone, energy_of_equivalent_speed, equal_spacing,
    zone_energy,
};
use inputs::{
    Axes, Basis, BrachTangential, Case, ContactPoint, Crush, Find, GivenEes, GivenImpact, GivenVehicle,
    ImpactLaw, KnownEnergy, Mass, Quantity, Reconstruct, Restitution, StiffnessForm, StiffnessLine, Velocity,
    YawInertia, class_yaw_inertia, scaled_stiffness,
};
use pim_core::{Body, Contact, Law, Motion, Outcome, Participant, Tangential, Vector2, VehicleId};
use reconcile::{Problem, Unknown};

use super::value;
use crate::sensitivity::Output;

/// A number of the case.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    /// The same in every sample.
    Known(f64),
    /// One of the inputs, by its place among them.
    Uncertain(usize),
}

impl Number {
    #[inline(always)]
    pub(crate) fn lanes(self, inputs: &[Lanes]) -> Lanes {
        match self {
            Self::Known(number) => [number; LANES],
            Self::Uncertain(place) => inputs.get(place).copied().unwrap_or([f64::NAN; LANES]),
        }
    }

    pub(crate) fn is_uncertain(self) -> bool {
        matches!(self, Self::Uncertain(_))
    }
}

/// Why the samples of a case are solved one by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Alone {
    /// It asks for no speed: there is no crush energy to meet, and another list of outputs.
    NoSpeed,
    /// It asks for both speeds, which are searched for from the momentum.
    BothSpeeds,
    /// It follows vehicles to rest or back, step by step.
    Ways,
    /// A search finds the speed: a friction limit switches, a fraction of μ_c makes the work cubic, and a
    /// restitution that varies changes what is sought.
    Search,
    /// The law has a closed form that no block is compiled for: an impulse ratio, a change of velocity, a
    /// moment impulse.
    OtherLaw,
    /// One of them is a fixed object, whose mass is none.
    Fixed,
    /// A yaw inertia by Burg's formula.
    Burg,
    /// A contact point that is placed on the damage.
    PlacedContact,
    /// The damage of a vehicle is not known, or follows from the other's.
    NoDamage,
    /// Stations that are not equally spaced.
    Spacing,
    /// A correction for an oblique force, or a PDOF for it.
    Oblique,
    /// A stiffness of a barrier test or of zones, or one with a limit.
    Structure,
    /// What a case has to give is missing, or a result is asked for that an impact does not have.
    Incomplete,
    /// A range of a number that it does not read: one that several share, or one that no result depends on.
    Unread,
}

/// A reconstruction of which a block of samples can be solved at once.
#[derive(Debug)]
pub(super) struct Block {
    axes: Axes,
    unknown: Unknown,
    basis: EnergyBasis,
    /// λ, where the crush takes a share of the tangential work.
    share: Option<Number>,
    vehicles: [Vehicle; 2],
    crush_plane: Quantity<Number>,
    restitution: Number,
    /// e_t: zero, U_t = 0, where the law asks for a common tangential velocity.
    tangential_restitution: Number,
    /// The place of each output among all that there are, and (SI) the central values of these, 0 where one
    /// is not wanted.
    places: Vec<usize>,
    central: [f64; OUTPUTS],
}

#[derive(Debug)]
struct Vehicle {
    mover: Mover,
    damage: Damage,
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
}

/// A vehicle that moves, without its damage.
#[derive(Debug)]
pub(crate) struct Mover {
    mass: Mass<Number>,
    yaw: Yaw,
    heading: Quantity<Number>,
    contact: ContactPoint<Number>,
    /// None of the vehicle whose speed is sought.
    motion: Option<Velocity<Number>>,
    yaw_rate: Option<Quantity<Number>>,
}

/// Where a yaw inertia comes from.
#[derive(Clone, Copy, Debug)]
enum Yaw {
    Given(YawInertia<Number>),
    /// A size class, with the factor on its radius of gyration.
    Class(VehicleClass, Number),
}

/// A crush that was measured at stations of equal spacing.
#[derive(Debug)]
pub(crate) struct Crushed {
    width: Quantity<Number>,
    depths: Vec<Quantity<Number>>,
}

impl Block {
    /// Why the case is left to [`Sample`](super::Sample), if it is: where it has another shape, or where one
    /// of its uncertain numbers, of which there are `inputs`, is none that a block reads.
    ///
    /// The structs of the case are taken apart field by field, here and for the vehicles, so that a new key
    /// does not compile before somebody has decided what a block does with it.
    pub(super) fn new(
        case: &Case<Number>,
        inputs: usize,
        outputs: &[Output],
        central: &[f64],
    ) -> Result<Self, Alone> {
        let Case {
            title: _,
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
            // A block reads no shared errors.
            uncertainty: _,
            departures,
            left_out: _,
        } = case;
        let Some(Reconstruct { find, energy_basis }) = reconstruct else { return Err(Alone::NoSpeed) };
        let Find::One(unknown) = find else { return Err(Alone::BothSpeeds) };
        // Vehicles that are followed to rest have outputs that a block does not compute.
        let has_drag =
            |vehicle: &GivenVehicle<Number>| vehicle.after.as_ref().is_some_and(|after| after.drag.is_some());
        if surface.is_some() && (has_drag(one) || has_drag(two)) {
            return Err(Alone::Ways);
        }
        let share = match energy_basis {
            Basis::Dissipated | Basis::Absorbed => None,
            Basis::TangentialShare(share) => Some(*share),
        };
        let GivenImpact { crush_plane, law } = impact.as_ref().ok_or(Alone::Incomplete)?;
        let zero = Number::Known(0.0);
        let (restitution, tangential_restitution) = match law {
            ImpactLaw::Brach {
                restitution: Restitution::Constant(restitution),
                tangential: BrachTangential::Critical,
                moment_restitution: None,
            } => (*restitution, zero),
            ImpactLaw::Ishikawa {
                restitution: Restitution::Constant(restitution),
                tangential_restitution,
            } => (*restitution, *tangential_restitution),
            // A common velocity.
            ImpactLaw::Woolley { tangential_velocity_change: None } => (zero, zero),
            ImpactLaw::KudlichSlibar { .. }
            | ImpactLaw::Brach { restitution: Restitution::OfClosingSpeed { .. }, .. }
            | ImpactLaw::Ishikawa { restitution: Restitution::OfClosingSpeed { .. }, .. }
            | ImpactLaw::Brach {
                tangential: BrachTangential::FractionOfCritical(_) | BrachTangential::Friction(_),
                ..
            } => return Err(Alone::Search),
            ImpactLaw::Brach { tangential: BrachTangential::Ratio(_), .. }
            | ImpactLaw::Brach { moment_restitution: Some(_), .. }
            | ImpactLaw::Woolley { tangential_velocity_change: Some(_) } => return Err(Alone::OtherLaw),
        };
        let all = Output::of_two_vehicles(unknown.vehicle(), *axes);
        let place = |wanted: &Output| all.iter().position(|output| output == wanted);
        let places = outputs.iter().map(place).collect::<Option<Vec<usize>>>().ok_or(Alone::Incomplete)?;
        let mut of_all = [0.0; OUTPUTS];
        for (place, central) in places.iter().zip(central) {
            of_all[*place] = *central;
        }
        let vehicle = |given: &GivenVehicle<Number>, id: VehicleId| {
            // A factor that is absent is one.
            let yaw_factor = departures.yaw_radius[id.index()].unwrap_or(Number::Known(1.0));
            let mover = Mover::new(given, Some(yaw_factor), unknown.vehicle() == id)?;
            let damage = Damage::new(given, departures.stiffness[id.index()])?;
            Vehicle::new(given, mover, damage)
        };
        let block = Self {
            axes: *axes,
            unknown: *unknown,
            basis: energy_basis.energy(),
            share,
            vehicles: [vehicle(one, VehicleId::One)?, vehicle(two, VehicleId::Two)?],
            crush_plane: *crush_plane,
            restitution,
            tangential_restitution,
            places,
            central: of_all,
        };
        let read = block.numbers().filter(|number| number.is_uncertain()).count();
        if read == inputs { Ok(block) } else { Err(Alone::Unread) }
    }

    /// Every number that it reads.
    fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self {
            axes: _,
            unknown: _,
            basis: _,
            share,
            vehicles,
            crush_plane,
            restitution,
            tangential_restitution,
            places: _,
            central: _,
        } = self;
        let of_vehicles = vehicles.iter().flat_map(|vehicle| {
            let Vehicle { mover, damage } = vehicle;
            mover.numbers().chain(damage.numbers())
        });
        of_vehicles.chain([crush_plane.number(), *restitution, *tangential_restitution]).chain(*share)
    }

    /// Solves a block for the outputs of a reconstruction of two vehicles, and tells of each sample whether
    /// that is its answer.
    #[inline(always)]
    pub(super) fn evaluate(&self, inputs: &[Lanes], outputs: &mut [Lanes]) -> [bool; LANES] {
        // Compiled twice: what the share needs would cost all others time.
        match self.share {
            None => self.evaluate_with(&NoShare, inputs, outputs),
            Some(share) => self.evaluate_with(&share.lanes(inputs), inputs, outputs),
        }
    }

    #[inline(always)]
    fn evaluate_with(&self, share: &impl Share, inputs: &[Lanes], outputs: &mut [Lanes]) -> [bool; LANES] {
        let (e, e_t) = (self.restitution.lanes(inputs), self.tangential_restitution.lanes(inputs));
        let [one, two] = &self.vehicles;
        let (v1, v2) = (one.mover.lanes(self.axes, inputs), two.mover.lanes(self.axes, inputs));
        let crush_plane = lateral(self.axes, &self.crush_plane, inputs);
        let mut crush_energy = [0.0; LANES];
        one.damage.add_energy(inputs, &v1.mass, &mut crush_energy);
        two.damage.add_energy(inputs, &v2.mass, &mut crush_energy);
        // On the stack of this function, so that the compiler knows that no column is part of another.
        let mut values = [[0.0; LANES]; OUTPUTS];
        let mut answered = [false; LANES];
        for lane in 0..LANES {
            let (law, is_law) = Law::new_with_validity(e[lane], Tangential::Restitution(e_t[lane]));
            let ((p1, is_1), (p2, is_2)) = (v1.participant(lane), v2.participant(lane));
            let (contact, is_contact) = Contact::new_with_validity([p1, p2], crush_plane[lane]);
            let problem = Problem {
                contact,
                law: law.into(),
                motions: [v1.motion(lane), v2.motion(lane)],
                unknown: self.unknown,
                crush_energy: crush_energy[lane],
                basis: self.basis,
                tangential_share: share.at(lane),
            };
            let (speed, outcome, is_answer) = problem.solve_with_validity();
            answered[lane] = is_law & is_1 & is_2 & is_contact & is_answer;
            for (column, value) in values.iter_mut().zip(answer(self.axes, &self.central, speed, &outcome)) {
                column[lane] = value;
            }
        }
        for (output, place) in outputs.iter_mut().zip(&self.places) {
            if let Some(column) = values.get(*place) {
                *output = *column;
            }
        }
        answered
    }
}

/// λ of each sample.
trait Share {
    fn at(&self, lane: usize) -> f64;
}

struct NoShare;

impl Share for NoShare {
    #[inline(always)]
    fn at(&self, _lane: usize) -> f64 {
        0.0
    }
}

impl Share for Lanes {
    #[inline(always)]
    fn at(&self, lane: usize) -> f64 {
        self[lane]
    }
}

/// Number of outputs of a reconstruction of two vehicles: with one more or fewer of them, the list in
/// [`answer`] does not compile.
const OUTPUTS: usize = Output::of_two_vehicles(VehicleId::One, Axes::ZUp).len();

/// Its outputs, in the order of [`Output::of_two_vehicles`]. A list, as a closure or a loop over it would not
/// be inlined.
#[inline(always)]
fn answer(axes: Axes, central: &[f64; OUTPUTS], speed: f64, outcome: &Outcome) -> [f64; OUTPUTS] {
    [
        value(Output::Speed { vehicle: VehicleId::One }, central[0], speed, outcome),
        value(Output::DeltaV { vehicle: VehicleId::One }, central[1], speed, outcome),
        value(Output::DeltaV { vehicle: VehicleId::Two }, central[2], speed, outcome),
        value(Output::Pdof { vehicle: VehicleId::One }, central[3], speed, outcome),
        value(Output::Pdof { vehicle: VehicleId::Two }, central[4], speed, outcome),
        value(Output::ClosingSpeed, central[5], speed, outcome),
        value(Output::EnergyLoss, central[6], speed, outcome),
        value(Output::NormalWork, central[7], speed, outcome),
        value(Output::TangentialWork, central[8], speed, outcome),
        value(Output::DeltaVLongitudinal { vehicle: VehicleId::One }, central[9], speed, outcome),
        value(Output::DeltaVLateral { vehicle: VehicleId::One, axes }, central[10], speed, outcome),
        value(Output::DeltaVLongitudinal { vehicle: VehicleId::Two }, central[11], speed, outcome),
        value(Output::DeltaVLateral { vehicle: VehicleId::Two, axes }, central[12], speed, outcome),
    ]
}

/// The part of a block that does not depend on the law, in SI.
pub(crate) struct VehicleLanes {
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
    #[inline(always)]
    pub(crate) fn participant(&self, lane: usize) -> (Participant, bool) {
        let (body, is_body) = Body::new_with_validity(self.mass[lane], self.yaw_inertia[lane]);
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
    fn new(given: &GivenVehicle<Number>, mover: Mover, damage: Damage) -> Result<Self, Alone> {
        if let Damage::Unknown = damage {
            return Err(Alone::NoDamage);
        }
        // How the force acts has no part in the speed, but a sample is refused where it makes no sense.
        let of_crush =
            given.crush.as_ref().is_some_and(|crush| crush.pdof.is_some() | crush.oblique.is_some());
        let of_ees = given.energy.as_ref().and_then(KnownEnergy::ees);
        if of_crush || of_ees.is_some_and(|ees| ees.pdof.is_some() | ees.moment_arm.is_some()) {
            return Err(Alone::Oblique);
        }
        Ok(Self { mover, damage })
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
        let resistance = match stiffness {
            StiffnessForm::Line(line) => Resistance::Line(Line::new(*line).ok_or(Alone::Structure)?),
            StiffnessForm::Category(category) => {
                let known = StiffnessForm::Category(*category).structure(crush.side);
                let (Ok(SideStiffness::Uniform(known)), Some(factor)) = (known, factor) else {
                    return Err(Alone::Structure);
                };
                Resistance::Category(known, factor)
            }
            StiffnessForm::Test(_) | StiffnessForm::Zones(_) => return Err(Alone::Structure),
        };
        Ok(Self::Crush(crushed, resistance))
    }

    /// Every number that it reads.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = Number> {
        let (crush, ees) = match self {
            Self::Unknown => (None, None),
            Self::Crush(crushed, resistance) => (Some((crushed, resistance)), None),
            Self::Energy(ees) => (None, ees.as_ref()),
        };
        let of_crush = crush.into_iter().flat_map(|(crushed, resistance)| {
            let (line, factor) = match resistance {
                Resistance::Line(line) => (Some(line), None),
                Resistance::Category(_, factor) => (None, Some(*factor)),
            };
            crushed.numbers().chain(line.into_iter().flat_map(Line::numbers)).chain(factor)
        });
        of_crush.chain(ees.map(Quantity::number))
    }

    /// (J) adds the crush energy; not a number where a sample has none.
    #[inline(always)]
    pub(crate) fn add_energy(&self, inputs: &[Lanes], mass: &Lanes, total: &mut Lanes) {
        match self {
            Self::Unknown | Self::Energy(None) => {}
            Self::Energy(Some(ees)) => {
                let speeds = si(ees, inputs);
                for lane in 0..LANES {
                    total[lane] += energy_of_equivalent_speed(speeds[lane], mass[lane]).unwrap_or(f64::NAN);
                }
            }
            Self::Crush(crushed, Resistance::Line(line)) => {
                crushed.add_energy(inputs, line.lanes(inputs), total);
            }
            Self::Crush(crushed, Resistance::Category(stiffness, factor)) => {
                let factors = factor.lanes(inputs);
                let [mut a, mut b, mut g] = [[0.0; LANES]; 3];
                for lane in 0..LANES {
                    [a[lane], b[lane], g[lane]] = scaled_stiffness(stiffness, factors[lane]);
                }
                crushed.add_energy(inputs, [a, b, g], total);
            }
        }
    }
}

impl Mover {
    /// `yaw_factor` is that on the radius of gyration of a size class.
    pub(crate) fn new(
        vehicle: &GivenVehicle<Number>,
        yaw_factor: Option<Number>,
        is_sought: bool,
    ) -> Result<Self, Alone> {
        let GivenVehicle {
            name: _,
            kind: _,
            fixed,
            mass,
            yaw,
            class,
            // Where mass, inertia and contact are given, as a block asks for, these are for drawings and
            // warnings.
            wheelbase: _,
            track: _,
            cg_to_front_axle: _,
            length: _,
            outline: _,
            diameter: _,
            heading,
            contact,
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
            return Err(Alone::Fixed);
        }
        let yaw = match (*yaw, *class, yaw_factor) {
            (Some(yaw), ..) => Yaw::Given(yaw),
            (None, Some(class), Some(factor)) => {
                Yaw::Class(VehicleClass::new(class).map_err(|_| Alone::Incomplete)?, factor)
            }
            (None, Some(_), None) => return Err(Alone::Incomplete),
            (None, None, _) => return Err(Alone::Burg),
        };
        Ok(Self {
            mass: mass.ok_or(Alone::Incomplete)?,
            yaw,
            heading: heading.ok_or(Alone::Incomplete)?,
            contact: contact.ok_or(Alone::PlacedContact)?,
            motion: if is_sought { None } else { Some(motion.ok_or(Alone::Incomplete)?) },
            yaw_rate: *yaw_rate,
        })
    }

    /// Every number that it reads.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self { mass, yaw, heading, contact, motion, yaw_rate } = self;
        let (Mass::Mass(mass) | Mass::Weight(mass)) = mass;
        let yaw = match yaw {
            Yaw::Given(YawInertia::Inertia(yaw) | YawInertia::Radius(yaw)) => yaw.number(),
            Yaw::Class(_, factor) => *factor,
        };
        let contact = match contact {
            ContactPoint::Polar { distance, angle } => [distance, angle],
            ContactPoint::Cartesian { x, y } => [x, y],
        };
        let motion = match motion {
            None => [None; 2],
            Some(Velocity::Speed(speed)) => [Some(speed), None],
            Some(Velocity::Vector { x, y }) => [Some(x), Some(y)],
        };
        let given = [mass, heading].into_iter().chain(contact).chain(motion.into_iter().flatten());
        given.chain(yaw_rate).map(Quantity::number).chain([yaw])
    }

    #[inline(always)]
    pub(crate) fn lanes(&self, axes: Axes, inputs: &[Lanes]) -> VehicleLanes {
        let mass = match self.mass {
            Mass::Mass(mass) => each(&mass, inputs, |mass| Mass::Mass(mass).kg()),
            Mass::Weight(weight) => each(&weight, inputs, |weight| Mass::Weight(weight).kg()),
        };
        let mut yaw_inertia = [0.0; LANES];
        match self.yaw {
            Yaw::Given(YawInertia::Inertia(inertia)) => {
                let numbers = inertia.number().lanes(inputs);
                for lane in 0..LANES {
                    yaw_inertia[lane] = YawInertia::Inertia(inertia.with(numbers[lane])).kg_m2(mass[lane]);
                }
            }
            Yaw::Class(class, factor) => {
                let factors = factor.lanes(inputs);
                for lane in 0..LANES {
                    yaw_inertia[lane] = class_yaw_inertia(&class, mass[lane], factors[lane]);
                }
            }
            Yaw::Given(YawInertia::Radius(radius)) => {
                let numbers = radius.number().lanes(inputs);
                for lane in 0..LANES {
                    yaw_inertia[lane] = YawInertia::Radius(radius.with(numbers[lane])).kg_m2(mass[lane]);
                }
            }
        }
        let (mut forward, mut left) = ([0.0; LANES], [0.0; LANES]);
        match self.contact {
            ContactPoint::Polar { distance, angle } => {
                let (distances, angles) = (distance.number().lanes(inputs), angle.number().lanes(inputs));
                for lane in 0..LANES {
                    let contact = ContactPoint::Polar {
                        distance: distance.with(distances[lane]),
                        angle: angle.with(angles[lane]),
                    };
                    [forward[lane], left[lane]] = contact.xy();
                }
            }
            ContactPoint::Cartesian { x, y } => {
                let (xs, ys) = (x.number().lanes(inputs), y.number().lanes(inputs));
                for lane in 0..LANES {
                    let contact = ContactPoint::Cartesian { x: x.with(xs[lane]), y: y.with(ys[lane]) };
                    [forward[lane], left[lane]] = contact.xy();
                }
            }
        }
        for left in &mut left {
            *left = axes.lateral(*left);
        }
        let heading = lateral(axes, &self.heading, inputs);
        let (mut velocity_x, mut velocity_y) = ([0.0; LANES], [0.0; LANES]);
        match self.motion {
            None => {}
            Some(Velocity::Speed(speed)) => {
                let speed = si(&speed, inputs);
                for lane in 0..LANES {
                    let velocity = Motion::along(heading[lane], speed[lane]).velocity;
                    (velocity_x[lane], velocity_y[lane]) = (velocity.x, velocity.y);
                }
            }
            Some(Velocity::Vector { x, y }) => {
                velocity_x = si(&x, inputs);
                velocity_y = lateral(axes, &y, inputs);
            }
        }
        let yaw_rate = self.yaw_rate.map_or([0.0; LANES], |yaw_rate| lateral(axes, &yaw_rate, inputs));
        VehicleLanes { mass, yaw_inertia, heading, forward, left, velocity_x, velocity_y, yaw_rate }
    }
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
        let Some(width) = width.filter(|_| spacing.is_none()) else { return Err(Alone::Spacing) };
        Ok((Self { width, depths: depths.clone() }, stiffness))
    }

    /// Every number that it reads.
    fn numbers(&self) -> impl Iterator<Item = Number> {
        let Self { width, depths } = self;
        [width].into_iter().chain(depths).map(Quantity::number)
    }

    /// (J) adds the crush energy with A, B and G; not a number where a sample has none.
    #[inline(always)]
    pub(crate) fn add_energy(&self, inputs: &[Lanes], [a, b, g]: [Lanes; 3], total: &mut Lanes) {
        let stations = self.depths.len();
        let mut spacing = si(&self.width, inputs);
        for width in &mut spacing {
            *width = equal_spacing(*width, stations);
        }
        let mut own = [0.0; LANES];
        for ends in self.depths.windows(2) {
            let [c1, c2] = ends else { continue };
            let (c1, c2) = (si(c1, inputs), si(c2, inputs));
            for lane in 0..LANES {
                let zone = Zone { width: spacing[lane], depths: [c1[lane], c2[lane]] };
                let (stiffness, is_stiffness) = Stiffness::from_abg_with_validity(a[lane], b[lane], g[lane]);
                let energy = zone_energy(zone, &stiffness);
                own[lane] += if is_stiffness & zone.is_valid() { energy } else { f64::NAN };
            }
        }
        for (total, own) in total.iter_mut().zip(own) {
            *total += own;
        }
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
    let numbers = quantities.map(|quantity| quantity.number().lanes(inputs));
    let [mut a, mut b, mut g] = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        let line = line(std::array::from_fn(|i| quantities[i].with(numbers[i][lane])));
        [a[lane], b[lane], g[lane]] = match line.stiffness() {
            Ok(stiffness) => [stiffness.a(), stiffness.b(), stiffness.g()],
            Err(_) => [f64::NAN; 3],
        };
    }
    [a, b, g]
}

#[inline(always)]
pub(crate) fn si(quantity: &Quantity<Number>, inputs: &[Lanes]) -> Lanes {
    each(quantity, inputs, |quantity| quantity.si())
}

/// What counts across or turns, in the axes of the engine.
#[inline(always)]
pub(crate) fn lateral(axes: Axes, quantity: &Quantity<Number>, inputs: &[Lanes]) -> Lanes {
    each(quantity, inputs, |quantity| axes.lateral(quantity.si()))
}

#[inline(always)]
fn each(quantity: &Quantity<Number>, inputs: &[Lanes], value: impl Fn(Quantity) -> f64) -> Lanes {
    let mut lanes = quantity.number().lanes(inputs);
    for lane in &mut lanes {
        *lane = value(quantity.with(*lane));
    }
    lanes
}
