//! The data that the damage of a vehicle needs from a case, and the direction of the force on it.

use crash3::{DamagedFace, Profile, SideStiffness};
use pim_core::{Real, VehicleId};

use super::{Demand, table};
use crate::crush::{Crush, KnownEnergy, StiffnessForm, StiffnessLine};
use crate::data::{CrushEvidence, DamageData, ForceData, InferredWidth, StiffnessSource, VehicleData};
use crate::dimensions::Dimensions;
use crate::form::CrushForm;
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::vehicle::GivenVehicle;

/// How to find a speed without any damage.
const WITHOUT_DAMAGE: &str = "; without damage data momentum gives the speed, from how the vehicles left the impact: leave `crush` out of both, and in [vehicle1.after] and \
                              [vehicle2.after] give `speed` and `direction`, or `rest` with `drag`";

/// Where one PDOF and both headings are given, the other PDOF follows by Newton's third law.
pub(super) fn fill_opposite_pdof<T: Real>(
    headings: [Option<T>; 2],
    vehicles: [Option<&mut VehicleData<T>>; 2],
) {
    let [Some(h1), Some(h2)] = headings else { return };
    let given = vehicles.each_ref().map(|vehicle| {
        let force = vehicle.as_ref()?.force;
        Some((force.pdof?, force.pdof_is_hour))
    });
    let follows = [
        given[1].map(|(pdof, is_hour)| (crash3::opposite_pdof(pdof, [h2, h1]), is_hour)),
        given[0].map(|(pdof, is_hour)| (crash3::opposite_pdof(pdof, [h1, h2]), is_hour)),
    ];
    for (vehicle, follows) in vehicles.into_iter().zip(follows) {
        let Some(vehicle) = vehicle.filter(|vehicle| vehicle.force.pdof.is_none()) else { continue };
        let Some((pdof, pdof_is_hour)) = follows else { continue };
        if vehicle.damage.is_some() || vehicle.energy.is_some() {
            vehicle.force = ForceData { pdof: Some(pdof), pdof_follows: true, pdof_is_hour, ..vehicle.force };
        }
    }
}

/// What to give of a vehicle that could not be inspected, after a list of other ways.
pub(super) const UNINSPECTED: &str = "; for a vehicle that could not be inspected, give side, stiffness and `from_force_balance = true`: its crush \
                                      then follows from the force on the other vehicle";

impl<T: Real> Demand<'_, T> {
    pub(super) fn missing_crush(&mut self, id: VehicleId) {
        let other = self.case.vehicles[id.other().index()].crush.as_ref();
        let is_measured = other.is_some_and(|crush| !crush.from_force_balance);
        let inferred = if is_measured { UNINSPECTED } else { "" };
        let example = format!(
            "a table with side, width, depths and stiffness{inferred}; or `ees = \"45 km/h\"` alone, if the energy equivalent speed is known; or \
             `crush = \"none\"` in [{}], if the other vehicle alone was damaged{}",
            table(id),
            if self.purpose == Purpose::Reconstruct { WITHOUT_DAMAGE } else { "" }
        );
        self.missing(format_args!("{}.crush", table(id)), &example);
    }

    pub(super) fn damage(
        &mut self,
        id: VehicleId,
        form: &CrushForm<'_, T>,
        dimensions: Option<Dimensions<T>>,
    ) -> Option<DamageData<T>> {
        let crush = form.crush;
        let structure = self.accepted(format_args!("{}.crush.stiffness", table(id)), form.structure());
        let evidence = if crush.from_force_balance {
            let width = self.inferred_width(id, crush, dimensions)?;
            match structure? {
                SideStiffness::Uniform(stiffness) => CrushEvidence::ForceBalance { stiffness, width },
                SideStiffness::Zones(_) => {
                    let reason =
                        "zones lie between stations, but a crush from the force balance has no stations";
                    return self.accepted(format_args!("{}.crush.stiffness.zones", table(id)), Err(reason));
                }
            }
        } else {
            let profile = self.profile(id, form);
            CrushEvidence::Measured { profile: profile?, structure: structure? }
        };
        let offset = crush.offset.as_ref().map(|offset| self.case.axes.along_face(crush.side, offset.si()));
        let face = match dimensions {
            Some(dimensions) => {
                let face =
                    DamagedFace::new(crush.side, dimensions.face(crush.side), offset.unwrap_or(T::ZERO));
                Some(self.accepted(format_args!("{}.cg_to_front", table(id)), face)?)
            }
            None => None,
        };
        Some(DamageData {
            side: crush.side,
            evidence,
            stiffness_source: match &crush.stiffness {
                StiffnessForm::Line(StiffnessLine::Crush { .. }) => StiffnessSource::Coefficients,
                StiffnessForm::Line(StiffnessLine::Root { .. }) => StiffnessSource::Roots,
                StiffnessForm::Typical(typical) => StiffnessSource::Typical(*typical),
                StiffnessForm::Test(test) => StiffnessSource::Test(test.fit),
                StiffnessForm::Zones(_) => StiffnessSource::Zones,
            },
            face,
            offset,
            correction: crush.oblique.unwrap_or_default(),
            oblique_angle: crush.oblique_angle.as_ref().map(Quantity::si),
        })
    }

    fn profile(&mut self, id: VehicleId, crush: &CrushForm<'_, T>) -> Option<Profile<T>> {
        let Some(profile) = crush.profile() else {
            self.missing(format_args!("{}.crush.width", table(id)), "`width = \"65 in\"` or `spacing`");
            return None;
        };
        self.accepted(format_args!("{}.crush.depths", table(id)), profile)
    }

    fn inferred_width(
        &mut self,
        id: VehicleId,
        crush: &Crush<T>,
        dimensions: Option<Dimensions<T>>,
    ) -> Option<InferredWidth<T>> {
        if let Some(width) = &crush.width {
            return Some(InferredWidth::Given(width.si()));
        }
        let Some(dimensions) = dimensions else {
            self.missing(
                format_args!("{}.crush.width", table(id)),
                "the width of the damage, which the force does not determine; or, to bound it, the vehicle's `length`, `width` and \
                 `cg_to_front`, or its `class`",
            );
            return None;
        };
        Some(InferredWidth::Bounded {
            widest: dimensions.extent(crush.side),
            deepest: dimensions.face(crush.side),
        })
    }

    /// Whether the case gives the PDOF of a vehicle, or the other vehicle's PDOF and both headings.
    fn has_pdof(&self, id: VehicleId) -> bool {
        let given = |id: VehicleId| {
            let vehicle = &self.case.vehicles[id.index()];
            let of_ees = vehicle.energy.as_ref().and_then(KnownEnergy::ees).and_then(|given| given.pdof);
            vehicle.crush.as_ref().and_then(|crush| crush.pdof).or(of_ees).is_some()
        };
        given(id) || (given(id.other()) && self.case.headings().iter().all(Option::is_some))
    }

    /// A force balance between two crushes needs the angle of the force to each.
    pub(super) fn directions_for_balance(&mut self) {
        for id in VehicleId::ALL {
            let has_angle = self.case.vehicles[id.index()]
                .crush
                .as_ref()
                .is_some_and(|crush| crush.oblique_angle.is_some());
            if !has_angle && !self.has_pdof(id) {
                self.missing(
                    format_args!("{}.crush.pdof", table(id)),
                    "the direction of the force, which the force balance needs: `pdof` of one vehicle, from which the other's follows, or \
                     `oblique_angle` of both",
                );
            }
        }
    }

    /// `crush` has no impulse that gives the direction of the force.
    pub(super) fn direction_of_force(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) {
        let table = table(id);
        let of_ees = vehicle.energy.as_ref().map(|known| known.ees().and_then(|given| given.moment_arm));
        let of_crush = vehicle.crush.as_ref().map(|crush| (crush.oblique_angle.is_some(), crush.moment_arm));
        // The energy of an EES is not corrected for an oblique force, so it takes no angle.
        let Some((has_angle, moment_arm)) = of_crush.or(of_ees.map(|moment_arm| (true, moment_arm))) else {
            self.missing_crush(id);
            return;
        };
        if !self.has_pdof(id) && (!has_angle || moment_arm.is_none()) {
            self.missing(
                format_args!("{table}.crush.pdof"),
                &format!(
                    "the direction from which the force came, clockwise from the heading: `pdof = \"2.7 deg\"` or `pdof = \"2 o'clock\"`; the \
                     other vehicle's `pdof` is enough if both have a `heading`; or give {}",
                    if vehicle.energy.is_some() { "`moment_arm`" } else { "both `oblique_angle` and `moment_arm`" }
                ),
            );
        } else if moment_arm.is_none() && vehicle.contact.is_none() && vehicle.energy.is_some() {
            self.missing(
                format_args!("{table}.contact"),
                "the point where the force acts: `contact = { x = \"1.78 m\", y = \"-0.73 m\" }`; or, in a table crush with `ees`, the distance of \
                 its line of action from the CG, `moment_arm = \"2.1 ft\"`",
            );
        } else if moment_arm.is_none() && vehicle.contact.is_none() && !vehicle.has_outline() {
            self.missing(
                format_args!("{table}.crush.moment_arm"),
                "the distance of the force's line of action from the CG: `moment_arm = \"2.1 ft\"`, or the vehicle's `contact` point; or, if \
                 the force acts through the centroid of the damage, `length`, `width` and `cg_to_front`, or `class`",
            );
        }
    }
}
