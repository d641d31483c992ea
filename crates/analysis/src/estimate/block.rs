//! The collisions of a block of particles, without a case for each.
//!
//! They are posed in [columns](crate::columns), like those of samples. Other shapes of case, and particles
//! that the engine refuses, are left to the single case.

use ::uncertainty::Lanes;
use inputs::{Basis, Case, DamageForm};
use pim_core::{Motion, VehicleId};

use super::posed::{OpenSpeeds, Posed};
use crate::columns::{Collisions, Columns, Number, uncertain_places};

/// A case whose particles can be posed a block at a time.
#[derive(Debug)]
pub(super) struct Block {
    collisions: Collisions,
    speeds: OpenSpeeds,
    basis: Basis<Number>,
}

impl Block {
    /// `None` if the case has another shape, or if a block does not read one of the `unknown` numbers that
    /// enter the impact: particles are then left to the single case.
    pub(super) fn new(case: Case<Number>, speeds: OpenSpeeds, unknown: usize) -> Option<Self> {
        let sought = VehicleId::ALL.map(|id| match speeds {
            OpenSpeeds::None => false,
            OpenSpeeds::One(open, _) => open == id,
            OpenSpeeds::Each(_) | OpenSpeeds::Together(_) => true,
        });
        let collisions = Collisions::new(case, sought);
        let form = collisions.form()?;
        let is_inferred =
            form.vehicles.iter().any(|vehicle| matches!(vehicle.damage, DamageForm::Inferred(_)));
        let is_read = !is_inferred && uncertain_places(form.numbers()) == unknown;
        let basis = form.basis;
        is_read.then_some(Self { collisions, speeds, basis })
    }

    /// Poses the collisions of a block in `columns`, which are empty.
    pub(super) fn pose(&self, values: &[Lanes], columns: &mut Columns) {
        self.collisions.pose(values, columns);
    }

    /// The collision of a particle; `None` if the engine refuses it.
    pub(super) fn of(&self, columns: &Columns, values: &[Lanes], lane: usize) -> Option<Posed> {
        let (contact, law, mut motions) = self.collisions.collision(columns, values, lane)?;
        let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
        let ahead = || contact.participants().each_ref().map(|participant| participant.course());
        for ((motion, speed), vehicle) in
            motions.iter_mut().zip(self.speeds.along(of, ahead)).zip(&columns.vehicles)
        {
            if let Some(speed) = speed {
                *motion = Motion::along(vehicle.course()[lane], speed).with_yaw_rate(motion.yaw_rate);
            }
        }
        let [first, second] = columns.crush_energies.each_ref().map(|energy| energy[lane]);
        // As in a single case: the sum of both, and the difference to the first.
        let crush_energies = [first, first + second - first];
        let is_whole = first.is_finite() & second.is_finite();
        let basis = self.basis.map(|number| number.at(values, lane));
        is_whole.then_some(Posed { contact, law, motions, crush_energies, basis })
    }
}
