//! Turns a case into the types of the engines, and reports the data that each purpose needs and the case
//! lacks.

mod avoid;
mod collision;
mod contradictions;
mod crush;
mod motion;
mod vehicle;

use std::fmt::Display;

use pim_core::{Real, Vector2, VehicleId};

use crate::basis::Basis;
use crate::case::Case;
use crate::data::{CollisionData, CrushOnly, ImpactInput, ReconstructionInput, VehicleData};
use crate::fault::{Fault, FaultKind, Faults};
use crate::impact::Restitution;
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::vehicle::GivenVehicle;

pub use contradictions::{contradictions, uncertain_speeds};
use crush::fill_opposite_pdof;

impl<T: Real> Case<T> {
    /// Everything that a reconstruction needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn reconstruction(&self) -> Result<ReconstructionInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Reconstruct);
        let unknown = demand.unknown();
        let collision = demand.collision(|id| unknown.is_some_and(|unknown| unknown != id));
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.vehicles) {
            if !vehicle.fixed && !vehicle.is_absent() && !vehicle.has_damage_data() {
                demand.missing_crush(id);
            }
        }
        if self.vehicles.iter().filter_map(|v| v.crush.as_ref()).any(|crush| crush.from_force_balance) {
            // The crush energy has to be known before the impact is, and so has the direction of the force.
            demand.directions_for_balance();
        }
        let input = collision.zip(unknown).map(|(collision, unknown)| ReconstructionInput {
            collision,
            unknown,
            basis: self.energy_basis(),
        });
        demand.finish(input)
    }

    /// Everything that an impact calculation needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn collision(&self) -> Result<ImpactInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Impact);
        let collision = demand.collision(|_| true);
        demand.finish(collision.map(|collision| ImpactInput { collision, basis: self.energy_basis() }))
    }

    /// The vehicles in their positions at the impact, at rest except for their yaw rates, whether or not
    /// their speeds are known: the data for a picture of them.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn geometry(&self) -> Result<CollisionData<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Draw);
        let collision = demand.collision(|_| false);
        demand.finish(collision)
    }

    /// Everything that an analysis of the damage alone needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn damage(&self) -> Result<CrushOnly<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Crush);
        let vehicles = VehicleId::ALL.map(|id| demand.subject(id));
        // The energy of one vehicle alone needs no direction.
        let alone = self.vehicles.iter().any(GivenVehicle::is_absent);
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.vehicles) {
            if vehicle.fixed || vehicle.is_absent() {
                continue;
            }
            if !alone {
                demand.direction_of_force(id, vehicle);
            } else if !vehicle.has_damage_data() {
                demand.missing_crush(id);
            }
        }
        if self.vehicles.iter().all(|vehicle| vehicle.fixed || vehicle.is_absent()) {
            demand.missing_crush(VehicleId::One);
        }
        let [v1, v2] = vehicles;
        demand.finish(v1.zip(v2).map(|(v1, v2)| {
            let mut vehicles = [v1, v2];
            fill_opposite_pdof(self.headings(), vehicles.each_mut().map(Some));
            CrushOnly {
                vehicles,
                basis: self.energy_basis(),
                restitution: self.impact.as_ref().and_then(|impact| match impact.law.restitution() {
                    Some(Restitution::Constant(e)) => Some(*e),
                    Some(Restitution::OfClosingSpeed { .. }) => None,
                    // Woolley: U_n = 0
                    None => Some(T::ZERO),
                }),
            }
        }))
    }

    fn energy_basis(&self) -> Basis<T> {
        self.reconstruct.as_ref().map_or(Basis::Dissipated, |reconstruct| reconstruct.energy_basis)
    }
}

impl Case {
    /// (m) position of the contact point of the impact, in the axes of the engine, by each source in the
    /// case: as given for the scene, and from the CG of each vehicle and its arm.
    #[must_use]
    pub fn contact_places(&self) -> [Option<Vector2<f64>>; 3] {
        let mut demand = Demand::new(self, self.furthest_purpose());
        let given = self.scene_contact.as_ref().map(|place| demand.place(place));
        let [one, two] = VehicleId::ALL.map(|id| demand.contact_from(id));
        [given, one, two]
    }

    /// (m) position of the contact point of the impact, in the axes of the engine: as given for the scene, or
    /// half-way between the points by both vehicles, or the point by one of them.
    #[must_use]
    pub fn contact_place(&self) -> Option<Vector2<f64>> {
        let [given, one, two] = self.contact_places();
        let between = one.zip(two).map(|(one, two)| (one + two) * 0.5);
        given.or(between).or(one).or(two)
    }

    /// The purpose that takes this case furthest: to find a speed if it asks for one, to solve the impact if
    /// it gives both speeds, else to assess the damage alone.
    #[must_use]
    pub fn furthest_purpose(&self) -> Purpose {
        if self.reconstruct.is_some() {
            Purpose::Reconstruct
        } else if self.impact.is_some() && self.vehicles.iter().all(|v| v.fixed || v.motion.is_some()) {
            Purpose::Impact
        } else {
            Purpose::Crush
        }
    }

    /// The data of each vehicle for the [furthest purpose](Self::furthest_purpose), regardless of what that
    /// would need; `None` for a vehicle whose data are incomplete. If one PDOF and both headings are given,
    /// the other PDOF follows.
    #[must_use]
    pub fn subjects(&self) -> [Option<VehicleData>; 2] {
        let mut demand = Demand::new(self, self.furthest_purpose());
        let mut subjects = VehicleId::ALL.map(|id| demand.subject(id));
        fill_opposite_pdof(self.headings(), subjects.each_mut().map(Option::as_mut));
        subjects
    }
}

/// The key of the table of a vehicle.
#[must_use]
pub fn table(id: VehicleId) -> &'static str {
    match id {
        VehicleId::One => "vehicle1",
        VehicleId::Two => "vehicle2",
    }
}

/// Collects what a purpose needs, and every fault that prevents it.
struct Demand<'a, T> {
    case: &'a Case<T>,
    purpose: Purpose,
    /// Whether nothing turns, so that no yaw inertia and no contact point is needed.
    is_of_point_masses: bool,
    faults: Vec<Fault>,
}

impl<'a, T: Real> Demand<'a, T> {
    fn new(case: &'a Case<T>, purpose: Purpose) -> Self {
        let find = case.reconstruct.as_ref().map(|reconstruct| reconstruct.find);
        let mut faults = contradictions(&case.vehicles, find);
        // A case may consist of `[avoid]` alone.
        if case.avoid.is_some() && case.vehicles.iter().all(GivenVehicle::is_absent) {
            faults.push(Fault {
                key: "vehicle1".to_owned(),
                kind: FaultKind::Missing { needed_for: purpose },
                advice: Some("give the table `[vehicle1]`, and `[vehicle2]` for an impact".to_owned()),
            });
        }
        Self { case, purpose, is_of_point_masses: false, faults }
    }

    /// Reports a missing key; `example` says what to give, with the lines that set it.
    fn missing(&mut self, key: impl Display, example: &str) {
        self.faults.push(Fault {
            key: key.to_string(),
            kind: FaultKind::Missing { needed_for: self.purpose },
            advice: Some(format!("give {example}")),
        });
    }

    fn refuse(&mut self, key: impl Display, reason: impl Display, advice: impl Display) {
        self.faults.push(Fault::refused(key, reason, advice));
    }

    fn given<V: Copy>(&mut self, value: Option<V>, key: impl Display, example: impl Display) -> Option<V> {
        if value.is_none() {
            self.missing(key, &example.to_string());
        }
        value
    }

    /// Turns the engine's refusal into a fault of the key that caused it.
    fn accepted<V>(&mut self, key: impl Display, result: Result<V, impl Display>) -> Option<V> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let kind = FaultKind::Refused { reason: error.to_string() };
                self.faults.push(Fault { key: key.to_string(), kind, advice: None });
                None
            }
        }
    }

    fn finish<V>(self, value: Option<V>) -> Result<V, Faults> {
        // Impact and motion may lack the same.
        let mut faults: Vec<Fault> = Vec::new();
        for fault in self.faults {
            if !faults.iter().any(|told| told.key == fault.key && told.kind == fault.kind) {
                faults.push(fault);
            }
        }
        Faults::none_of(faults)?;
        // A missing value has been reported above, so there is one here.
        value.ok_or_else(|| {
            let reason = "the case cannot be analysed".to_owned();
            Fault { key: String::new(), kind: FaultKind::Refused { reason }, advice: None }.into()
        })
    }

    /// The SI value of a lateral or rotational quantity, in the axes of the engine.
    fn lateral(&self, quantity: &Quantity<T>) -> T {
        self.case.axes.lateral(quantity.si())
    }
}
