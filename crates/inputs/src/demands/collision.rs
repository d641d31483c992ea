//! The data that an impact needs from a case: geometry, law and motions of both vehicles, and the speed to
//! find.

use crash3::{EnergyMoments, Side};
use pim_core::{Body, Contact, Motion, Participant, Real, VaryingLaw, VehicleId};

use super::{Demand, fill_opposite_pdof, table};
use crate::axes::Axes;
use crate::data::{CollisionData, CrushEvidence, DamageData, InertiaData, VehicleData};
use crate::fault::{Fault, FaultKind};
use crate::form::PlacedContact;
use crate::vehicle::{GivenVehicle, Velocity};

const SPEED_FORMS: &str =
    "`speed = \"10 mph\"` along the heading, or `velocity` by its components `x` and `y` in the scene";

impl<T: Real> Demand<'_, T> {
    /// (m) C forward and left of the CG.
    pub(super) fn contact_point(&self, vehicle: &GivenVehicle<T>) -> Option<[T; 2]> {
        vehicle.contact.as_ref().map(|contact| contact.point(self.case.axes))
    }

    /// (m) C forward and left of the CG, at the centroid of a damage whose position the case gives.
    pub(super) fn placed_contact(
        &mut self,
        id: VehicleId,
        placed: &PlacedContact<T>,
        damage: &DamageData<T>,
    ) -> Option<[T; 2]> {
        let CrushEvidence::Measured { profile, structure } = &damage.evidence else { return None };
        let point =
            EnergyMoments::of(profile, structure).and_then(|moments| placed.point(self.case.axes, &moments));
        self.accepted(format_args!("{}.contact", table(id)), point)
    }

    /// Reports that a vehicle has no contact point, and the data that would let the program place it.
    fn missing_contact(&mut self, id: VehicleId) {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        let mut lacking = Vec::new();
        if let Some(crush) = vehicle.crush.as_ref().filter(|crush| !crush.from_force_balance) {
            if crush.width.is_none() && crush.spacing.is_none() {
                lacking.push("the `width` of the damage".to_owned());
            }
            if crush.offset.is_none() {
                let from = match crush.side {
                    Side::Front | Side::Rear => "from the vehicle's axis",
                    Side::Left | Side::Right => "forward of the centre of gravity",
                };
                lacking.push(format!(
                    "`offset = \"12 in\"` in [{table}.crush], the middle of the damage {from}"
                ));
            }
            if !vehicle.has_outline() {
                lacking.push("`length`, `width` and `cg_to_front`, or `class`".to_owned());
            }
        }
        let instead = match lacking.as_slice() {
            [] => String::new(),
            list => format!(
                "; if C is not known, give in its place {}: C is then placed at the centroid of the damage",
                list.join(", and ")
            ),
        };
        self.missing(
            format_args!("{table}.contact"),
            &format!(
                "`contact = {{ distance = \"6.3 ft\", angle = \"-22.4 deg\" }}` or `contact = {{ x = \"1.78 m\", y = \"-0.73 m\" }}`{instead}"
            ),
        );
    }

    pub(super) fn unknown(&mut self) -> Option<VehicleId> {
        let is_open = self.case.vehicles.each_ref().map(|vehicle| !vehicle.fixed && vehicle.motion.is_none());
        if let Some(reconstruct) = &self.case.reconstruct {
            let unknown = reconstruct.find.unknown();
            if let Some(sought) = unknown
                && is_open[sought.other().index()]
                && !is_open[sought.index()]
            {
                let other = sought.other();
                let reason = format!(
                    "`find` asks for the speed of vehicle {sought}, which the case gives; it does not give that of vehicle {other}"
                );
                let advice = format!("write find = \"vehicle{other}.speed\"");
                self.refuse("reconstruct.find", reason, advice);
                return None;
            }
            if unknown.is_none() {
                let reason = "`reconstruct.find` asks for both speeds, but only one is to be found here";
                let advice = "write find = \"vehicle1.speed\" and give the speed of vehicle 2";
                self.refuse("reconstruct.find", reason, advice);
            }
            return unknown;
        }
        // No speed can be found for a vehicle alone.
        if self.case.vehicles.iter().any(GivenVehicle::is_absent) {
            return None;
        }
        // A moving vehicle without a speed is the one whose speed is to be found.
        let found = if is_open == [false, true] { "vehicle2.speed" } else { "vehicle1.speed" };
        self.missing(
            "reconstruct.find",
            &format!("`find = \"{found}\"`, the speed to find, in a table [reconstruct]"),
        );
        if is_open == [true, true] {
            let advice = Some(format!("give one vehicle {SPEED_FORMS}"));
            self.faults.push(Fault { key: String::new(), kind: FaultKind::NoSpeed, advice });
        }
        None
    }

    /// Whether the case has both vehicles; reports the missing one.
    pub(super) fn both_tables(&mut self) -> bool {
        let absent = VehicleId::ALL.into_iter().find(|id| self.case.vehicles[id.index()].is_absent());
        if let Some(id) = absent {
            let advice = "a table of its own for each vehicle, with `fixed = true` for a barrier, a wall or \
                          a pole; for one vehicle alone, its crush energy and EES can be found, but no speed";
            self.missing(table(id), advice);
        }
        absent.is_none()
    }

    /// The collision; `needs_speed` says whether a vehicle must have a speed.
    pub(super) fn collision(&mut self, needs_speed: impl Fn(VehicleId) -> bool) -> Option<CollisionData<T>> {
        if !self.both_tables() {
            return None;
        }
        let vehicles = VehicleId::ALL.map(|id| self.subject(id));
        let participants = VehicleId::ALL.map(|id| self.participant(id, vehicles[id.index()].as_ref()));
        let motions = VehicleId::ALL.map(|id| self.motion(id, needs_speed(id)));
        let law = self.law();
        self.skids();
        let ([v1, v2], [p1, p2], [m1, m2]) = (vehicles, participants, motions);
        let contact = self.contact([p1?, p2?])?;
        let law = law?;
        let mut vehicles = [v1?, v2?];
        fill_opposite_pdof(self.case.headings(), vehicles.each_mut().map(Some));
        Some(CollisionData { contact, law, motions: [m1?, m2?], vehicles })
    }

    fn participant(&mut self, id: VehicleId, data: Option<&VehicleData<T>>) -> Option<Participant<T>> {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        let heading = self.case.headings()[id.index()];
        let contact = data.map_or_else(|| self.contact_point(vehicle), |data| data.contact);
        if vehicle.fixed {
            // The heading and the contact point of a fixed object are optional: they only help to orient the
            // normal of the crush plane.
            return match contact {
                Some([forward, left]) => {
                    let placed = Participant::new(Body::fixed(), heading.unwrap_or(T::ZERO), forward, left);
                    self.accepted(format_args!("{table}.contact"), placed)
                }
                None => Some(Participant::barrier()),
            };
        }
        let heading = self.given(heading, format_args!("{table}.heading"), "`heading = \"180 deg\"`");
        if contact.is_none() && !vehicle.places_contact() {
            self.missing_contact(id);
        }
        let InertiaData { mass, yaw_inertia, .. } = data?.inertia?;
        let ([forward, left], heading) = (contact?, heading?);
        let body = self.accepted(table, Body::new(mass, yaw_inertia?))?;
        let participant = self.accepted(table, Participant::new(body, heading, forward, left))?;
        match self.case.course(id) {
            Some(course) => self.accepted(format_args!("{table}.sideslip"), participant.with_course(course)),
            None => Some(participant),
        }
    }

    pub(super) fn motion(&mut self, id: VehicleId, needs_speed: bool) -> Option<Motion<T>> {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        if vehicle.fixed {
            return Some(Motion::rest());
        }
        let yaw_rate = vehicle.yaw_rate.as_ref().map_or(T::ZERO, |rate| self.lateral(rate));
        if !needs_speed {
            return Some(Motion::rest().with_yaw_rate(yaw_rate));
        }
        let Some(velocity) = &vehicle.motion else {
            self.missing(format_args!("{table}.speed"), SPEED_FORMS);
            return None;
        };
        let course = match velocity {
            Velocity::Speed(_) => self.case.course(id).or(self.case.headings()[id.index()])?,
            // A vector has its own direction.
            Velocity::Vector { .. } => T::ZERO,
        };
        Some(Motion { velocity: velocity.vector(self.case.axes, course), yaw_rate })
    }

    pub(super) fn law(&mut self) -> Option<VaryingLaw<T>> {
        let Some(impact) = &self.case.impact else {
            self.missing("impact", "a table [impact] with crush_plane, restitution and tangential");
            return None;
        };
        match impact.law.of_engine(self.case.axes) {
            Ok(law) => Some(law),
            Err((key, refusal)) => self.accepted(key, Err(refusal)),
        }
    }

    fn contact(&mut self, participants: [Participant<T>; 2]) -> Option<Contact<T>> {
        let axes = self.case.axes;
        let crush_plane = self.lateral(&self.case.impact.as_ref()?.crush_plane);
        let contact = Contact::new(participants, crush_plane);
        let contact = contact.map_err(|refused| match axes {
            Axes::ZUp => refused,
            Axes::ZDown => refused.mirrored(),
        });
        self.accepted("impact.crush_plane", contact)
    }
}
