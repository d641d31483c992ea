//! The collisions of a block of particles, without a case for each.
//!
//! As the block of [`uncertainty`](crate::uncertainty()), with whose parts it reads the vehicles: each
//! particle goes through the functions of the engine through which its case would go, in the same order, so
//! that its impact has the same bits. What has another shape, and every particle of which the engine refuses
//! something, is left to the case.

use ::uncertainty::{LANES, Lanes};
use inputs::{
    Axes, Basis, BrachTangential, Case, GivenImpact, GivenVehicle, ImpactLaw, Quantity, Restitution,
};
use pim_core::{Contact, Law, Motion, Tangential, Vector2, VehicleId};
use real::elementary::sin_cos;

use super::posed::{OpenSpeeds, Posed};
use crate::uncertainty::lanes::{Damage, Mover, Number, VehicleLanes, lateral, uncertain_places};

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
            locked_together: _,
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
                OpenSpeeds::Each(_) | OpenSpeeds::Together(_) => true,
            };
            let (yaw_factor, moved) = (departures.yaw_radius[id.index()], departures.contact[id.index()]);
            let factors = [yaw_factor, departures.stiffness[id.index()]];
            let mover = Mover::new(given, factors, moved, is_sought).ok()?;
            let damage = Damage::new(given, departures.stiffness[id.index()]).ok()?;
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
        (uncertain_places(block.numbers()) == unknown).then_some(block)
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
            numbers.extend(damage.numbers());
        }
        numbers
    }

    pub(super) fn pose(&self, values: &[Lanes], speeds: OpenSpeeds) -> Poses {
        let energy = |damage: &Damage, mass: &Lanes| {
            let mut energy = Lanes::ZERO;
            damage.add_energy(values, mass, &mut energy, &mut [0; LANES]);
            energy
        };
        let [one, two] = &self.vehicles;
        let mut vehicles = [VehicleLanes::NOTHING; 2];
        let [v1, v2] = &mut vehicles;
        one.mover.fill(self.axes, values, v1);
        two.mover.fill(self.axes, values, v2);
        let mut crush_plane = Lanes::ZERO;
        lateral(self.axes, &self.crush_plane, values, &mut crush_plane);
        let mut along = [Lanes::ZERO; 2];
        let mut is_open = [false; 2];
        for lane in 0..LANES {
            let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
            let found = speeds.along(of, || {
                vehicles.each_ref().map(|vehicle| {
                    let (sin, cos) = sin_cos(vehicle.heading[lane]);
                    Vector2::new(cos, sin)
                })
            });
            for ((column, is_open), speed) in along.iter_mut().zip(&mut is_open).zip(found) {
                if let Some(speed) = speed {
                    column[lane] = speed;
                    *is_open = true;
                }
            }
        }
        let [first, second] = along;
        let speeds = [is_open[0].then_some(first), is_open[1].then_some(second)];
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
            crush_energies: [energy(&one.damage, &vehicles[0].mass), energy(&two.damage, &vehicles[1].mass)],
            vehicles,
            speeds,
            crush_plane,
            restitution: self.restitution.lanes(values),
            tangential,
            basis,
        }
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
