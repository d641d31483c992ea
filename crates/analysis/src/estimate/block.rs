//! The collisions of a block of particles, without a case for each.
//!
//! As the block of [`uncertainty`](crate::uncertainty()), with whose parts it reads the vehicles: each
//! particle goes through the functions of the engine through which its case would go, in the same order, so
//! that its impact has the same bits. What has another shape, and every particle of which the engine refuses
//! something, is left to the case.

use ::uncertainty::{LANES, Lanes};
use crash3::{SideStiffness, Stiffness, energy_of_equivalent_speed};
use inputs::{
    Axes, Basis, BrachTangential, Case, GivenImpact, GivenVehicle, ImpactLaw, KnownEnergy, Quantity,
    Restitution, StiffnessForm, scaled_stiffness,
};
use pim_core::{Contact, Law, Motion, Tangential, Vector2, VehicleId};
use real::elementary::sin_cos;

use super::impacts::{OpenSpeeds, Posed};
use crate::uncertainty::lanes::{Crushed, Line, Mover, Number, VehicleLanes, lateral, si};

/// A case of which a block of particles can be posed at once.
#[derive(Debug)]
pub(super) struct Block {
    axes: Axes,
    vehicles: [Vehicle; 2],
    crush_plane: Quantity<Number>,
    restitution: Number,
    tangential: BrachTangential<Number>,
    basis: Basis<Number>,
}

#[derive(Debug)]
struct Vehicle {
    mover: Mover,
    damage: Damage,
}

/// What is known of a damage.
#[derive(Debug)]
enum Damage {
    Unknown,
    Crush(Crushed, Resistance),
    /// An energy equivalent speed; `None` without damage.
    Energy(Option<Quantity<Number>>),
}

/// What a damaged side resisted with.
#[derive(Debug)]
enum Resistance {
    Line(Line),
    /// That of a category, with the factor on A.
    Category(Stiffness, Number),
}

/// Collisions of a block of particles (SI).
pub(super) struct Poses {
    vehicles: [VehicleLanes; 2],
    /// None of a vehicle whose velocity the case gives.
    speeds: [Option<Lanes>; 2],
    crush_plane: Lanes,
    restitution: Lanes,
    tangential: [Tangential; LANES],
    crush_energies: [Lanes; 2],
    basis: [Basis; LANES],
}

impl Block {
    /// `None` where particles are left to the case: where it has another shape, or where one of its unknown
    /// numbers, of which `unknown` enter the impact, is none that a block reads.
    ///
    /// A new key of the case does not compile before somebody has decided what a block does with it.
    pub(super) fn new(case: &Case<Number>, speeds: OpenSpeeds, unknown: usize) -> Option<Self> {
        let Case {
            title: _,
            source: _,
            report: _,
            axes,
            // These are for the motion after the impact, which is followed with the case.
            scene_contact: _,
            site_plan: _,
            surface: _,
            vehicles: [one, two],
            impact,
            reconstruct,
            estimate: _,
            ranges: _,
            uncertainty: _,
            departures,
            left_out: _,
        } = case;
        let GivenImpact { crush_plane, law } = impact.as_ref()?;
        let ImpactLaw::Brach {
            restitution: Restitution::Constant(restitution),
            tangential,
            moment_restitution: None,
        } = law
        else {
            return None;
        };
        let vehicle = |given: &GivenVehicle<Number>, id: VehicleId| {
            let is_sought = match speeds {
                OpenSpeeds::None => false,
                OpenSpeeds::One(open, _) => open == id,
                OpenSpeeds::Both(_) => true,
            };
            let mover = Mover::new(given, departures.yaw_radius[id.index()], is_sought)?;
            let damage = Damage::new(given, departures.stiffness[id.index()])?;
            Some(Vehicle { mover, damage })
        };
        let block = Self {
            axes: *axes,
            vehicles: [vehicle(one, VehicleId::One)?, vehicle(two, VehicleId::Two)?],
            crush_plane: *crush_plane,
            restitution: *restitution,
            tangential: *tangential,
            basis: reconstruct.as_ref().map_or(Basis::Dissipated, |reconstruct| reconstruct.energy_basis),
        };
        let read = block.numbers().into_iter().filter(|number| number.is_uncertain()).count();
        (read == unknown).then_some(block)
    }

    /// Every number that it reads.
    fn numbers(&self) -> Vec<Number> {
        let Self { axes: _, vehicles, crush_plane, restitution, tangential, basis } = self;
        let mut numbers = vec![crush_plane.number(), *restitution];
        match tangential {
            BrachTangential::Critical => {}
            BrachTangential::Ratio(number)
            | BrachTangential::FractionOfCritical(number)
            | BrachTangential::Friction(number) => numbers.push(*number),
        }
        match basis {
            Basis::Dissipated | Basis::Absorbed => {}
            Basis::TangentialShare(share) => numbers.push(*share),
        }
        for Vehicle { mover, damage } in vehicles {
            numbers.extend(mover.numbers());
            match damage {
                Damage::Unknown => {}
                Damage::Crush(crushed, resistance) => {
                    numbers.extend(crushed.numbers());
                    match resistance {
                        Resistance::Line(line) => numbers.extend(line.numbers()),
                        Resistance::Category(_, factor) => numbers.push(*factor),
                    }
                }
                Damage::Energy(ees) => numbers.extend(ees.as_ref().map(Quantity::number)),
            }
        }
        numbers
    }

    pub(super) fn pose(&self, values: &[Lanes], speeds: OpenSpeeds) -> Poses {
        let [one, two] = &self.vehicles;
        let vehicles = [one.mover.lanes(self.axes, values), two.mover.lanes(self.axes, values)];
        let column = |place: usize| values.get(place).copied().unwrap_or([f64::NAN; LANES]);
        let speeds = match speeds {
            OpenSpeeds::None => [None, None],
            OpenSpeeds::One(VehicleId::One, place) => [Some(column(place)), None],
            OpenSpeeds::One(VehicleId::Two, place) => [None, Some(column(place))],
            OpenSpeeds::Both(speeds) => {
                let mut along = [[0.0; LANES]; 2];
                for lane in 0..LANES {
                    let forward = vehicles.each_ref().map(|vehicle| {
                        let (sin, cos) = sin_cos(vehicle.heading[lane]);
                        Vector2::new(cos, sin)
                    });
                    let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
                    [along[0][lane], along[1][lane]] = speeds.map(of).along(forward);
                }
                along.map(Some)
            }
        };
        let tangential = match self.tangential {
            BrachTangential::Critical => [Tangential::Critical; LANES],
            BrachTangential::Ratio(number) => {
                number.lanes(values).map(|mu| Tangential::Ratio(self.axes.lateral(mu)))
            }
            BrachTangential::FractionOfCritical(number) => {
                number.lanes(values).map(Tangential::FractionOfCritical)
            }
            BrachTangential::Friction(number) => number.lanes(values).map(Tangential::Friction),
        };
        let basis = match self.basis {
            Basis::Dissipated => [Basis::Dissipated; LANES],
            Basis::Absorbed => [Basis::Absorbed; LANES],
            Basis::TangentialShare(share) => share.lanes(values).map(Basis::TangentialShare),
        };
        Poses {
            crush_energies: [
                one.damage.energy(values, &vehicles[0].mass),
                two.damage.energy(values, &vehicles[1].mass),
            ],
            vehicles,
            speeds,
            crush_plane: lateral(self.axes, &self.crush_plane, values),
            restitution: self.restitution.lanes(values),
            tangential,
            basis,
        }
    }
}

impl Damage {
    fn new(given: &GivenVehicle<Number>, factor: Option<Number>) -> Option<Self> {
        let Some(crush) = &given.crush else {
            return Some(match &given.energy {
                None => Self::Unknown,
                Some(KnownEnergy::Undamaged) => Self::Energy(None),
                Some(KnownEnergy::Ees(known)) => Self::Energy(Some(known.ees)),
            });
        };
        let (crushed, stiffness) = Crushed::new(crush)?;
        let resistance = match stiffness {
            StiffnessForm::Line(line) => Resistance::Line(Line::new(*line)?),
            StiffnessForm::Category(category) => {
                let known = StiffnessForm::Category(*category).structure(crush.side).ok()?;
                let SideStiffness::Uniform(known) = known else { return None };
                Resistance::Category(known, factor?)
            }
            StiffnessForm::Test(_) | StiffnessForm::Zones(_) => return None,
        };
        Some(Self::Crush(crushed, resistance))
    }

    /// (J) crush energy; not a number where a particle has none.
    fn energy(&self, values: &[Lanes], mass: &Lanes) -> Lanes {
        let mut energy = [0.0; LANES];
        match self {
            Self::Unknown | Self::Energy(None) => {}
            Self::Energy(Some(ees)) => {
                for ((energy, ees), mass) in energy.iter_mut().zip(si(ees, values)).zip(mass) {
                    *energy = energy_of_equivalent_speed(ees, *mass).unwrap_or(f64::NAN);
                }
            }
            Self::Crush(crushed, resistance) => {
                let coefficients = match resistance {
                    Resistance::Line(line) => line.lanes(values),
                    Resistance::Category(stiffness, factor) => {
                        let mut coefficients = [[0.0; LANES]; 3];
                        for (lane, factor) in factor.lanes(values).into_iter().enumerate() {
                            let scaled = scaled_stiffness(stiffness, factor);
                            for (column, number) in coefficients.iter_mut().zip(scaled) {
                                column[lane] = number;
                            }
                        }
                        coefficients
                    }
                };
                crushed.add_energy(values, coefficients, &mut energy);
            }
        }
        energy
    }
}

impl Poses {
    /// The collision of a particle; `None` where the engine refuses something of it.
    pub(super) fn of(&self, lane: usize) -> Option<Posed> {
        let [one, two] = &self.vehicles;
        let ((p1, is_1), (p2, is_2)) = (one.participant(lane), two.participant(lane));
        let (contact, is_contact) = Contact::new_with_validity([p1, p2], self.crush_plane[lane]);
        let (law, is_law) = Law::new_with_validity(self.restitution[lane], self.tangential[lane]);
        let motion = |vehicle: &VehicleLanes, speed: &Option<Lanes>| {
            let given = vehicle.motion(lane);
            match speed {
                Some(speed) => {
                    Motion::along(vehicle.heading[lane], speed[lane]).with_yaw_rate(given.yaw_rate)
                }
                None => given,
            }
        };
        let motions = [motion(one, &self.speeds[0]), motion(two, &self.speeds[1])];
        let [first, second] = self.crush_energies.each_ref().map(|energy| energy[lane]);
        // As those of a case: the sum of both, and what the first leaves of it.
        let crush_energies = [first, first + second - first];
        let is_whole = first.is_finite() & second.is_finite();
        (is_1 & is_2 & is_contact & is_law & is_whole).then(|| Posed {
            contact,
            law: law.into(),
            motions,
            crush_energies,
            basis: self.basis[lane],
        })
    }
}
