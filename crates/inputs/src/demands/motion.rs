//! The data that the motion after the impact, and finding both speeds, need from a case.

use std::f64::consts::FRAC_PI_2;

use pim_core::{Body, Contact, Real, VaryingLaw, Vector2, VehicleId};
use real::elementary;
use reconcile::{Departure, are_collinear, central_contact, point_masses};
use trajectory::{Axles, Chassis, GREATEST_DRAG};

use super::crush::UNINSPECTED;
use super::{Demand, fill_opposite_pdof, table};
use crate::after::{After, GivenSteer, RestHeading, Skid, SkidBegin, WheelDrag};
use crate::axes::Axes;
use crate::case::{Case, Find};
use crate::data::{CollisionData, VehicleData};
use crate::fault::{FaultKind, Faults};
use crate::motion::{
    Geometry, MotionInput, PointData, RegionData, RestData, RestHeadingData, SkidData, Sought, SteerData,
    SurfaceData, TwoSpeedInput, VehicleMotion, ZoneData,
};
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::scene::{EdgeSide, Place, SurfaceRegion, in_scene};
use crate::vehicle::{GivenVehicle, VehicleKind};

/// (m) a vehicle that came to rest no farther than this from its place at the impact has no path that could
/// give a speed: no survey is more exact.
const LEAST_PATH: f64 = 0.01;

/// The required data on how a vehicle left the impact.
#[derive(Clone, Copy, PartialEq)]
enum Departed {
    /// None: it follows from the impact.
    ByImpact,
    /// All of its motion, or its rest position.
    Wholly,
}

impl<T> Case<T> {
    /// Whether the speeds that are sought follow from how the vehicles left the impact: always if both are
    /// sought; for one speed, only if no vehicle has damage that could give it.
    #[must_use]
    pub fn is_by_momentum(&self) -> bool {
        let Some(reconstruct) = &self.reconstruct else { return false };
        let is_told = self.movers().any(|id| self.tells_departure(id));
        reconstruct.find == Find::Both || (is_told && !self.vehicles.iter().any(has_crush))
    }

    /// Whether the case has what a vehicle needs to be followed on the ground: its drag, and the friction on
    /// its path, its own or that of the ground.
    #[must_use]
    pub fn can_follow(&self, id: VehicleId) -> bool {
        let after = self.vehicles[id.index()].after.as_ref();
        after
            .is_some_and(|after| after.drag.is_some() && (after.friction.is_some() || self.surface.is_some()))
    }

    /// The vehicles that can move.
    fn movers(&self) -> impl Iterator<Item = VehicleId> {
        VehicleId::ALL.into_iter().filter(|id| {
            let vehicle = &self.vehicles[id.index()];
            !vehicle.fixed && !vehicle.is_absent()
        })
    }

    /// Whether the case gives how a vehicle left the impact.
    fn tells_departure(&self, id: VehicleId) -> bool {
        let after = self.vehicles[id.index()].after.as_ref();
        after.is_some_and(|after| after.rest.is_some() || after.speed.is_some())
    }
}

impl<T: Real> Case<T> {
    /// Everything that the motion after the impact needs, from velocities after the impact or from rest
    /// positions.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn motion(&self) -> Result<MotionInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Motion);
        let told = VehicleId::ALL.map(|id| self.vehicles[id.index()].after.is_some());
        if told == [false, false] {
            demand.missing(
                "vehicle1.after",
                "a table [vehicle1.after] with `drag`, and with `rest` or `speed`, `direction` and `yaw_rate`",
            );
        }
        let vehicles = VehicleId::ALL.map(|id| {
            let subject = if told[id.index()] { demand.subject(id) } else { None };
            demand.vehicle_motion(id, subject.as_ref(), Departed::Wholly)
        });
        let surface = demand.surface(told);
        demand.finish(surface.map(|surface| MotionInput { surface, vehicles }))
    }

    /// The data to follow the vehicles from the impact to rest: `None` if the case has drag and friction for
    /// neither vehicle. A vehicle without them is left out.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    #[must_use]
    pub fn run_out(&self) -> Option<Result<MotionInput<T>, Faults>> {
        let followed = VehicleId::ALL.map(|id| self.can_follow(id));
        if followed == [false, false] {
            return None;
        }
        let mut demand = Demand::new(self, Purpose::Motion);
        let mut motion = |id: VehicleId| {
            if !followed[id.index()] {
                return None;
            }
            let subject = demand.subject(id);
            demand.vehicle_motion(id, subject.as_ref(), Departed::ByImpact)
        };
        // `map` of an array would copy them once more, for each particle of an estimate.
        let vehicles = [motion(VehicleId::One), motion(VehicleId::Two)];
        let surface = demand.surface(followed);
        Some(demand.finish(surface.map(|surface| MotionInput { surface, vehicles })))
    }

    /// The skid marks of each vehicle before the impact, where their friction is known too.
    #[must_use]
    pub fn skids(&self) -> [Option<SkidData<T>>; 2] {
        let ground = self.ground_friction();
        VehicleId::ALL.map(|id| {
            let skid = self.vehicles[id.index()].skid()?;
            Some(SkidData { length: self.skid_length(id, skid)?, friction: skid.friction.or(ground)? })
        })
    }

    /// (m) of the skid marks of a vehicle; `None` where they begin at a place and its place at the impact is
    /// not known.
    fn skid_length(&self, id: VehicleId, skid: &Skid<T>) -> Option<T> {
        match &skid.begin {
            SkidBegin::Length(length) => Some(length.si()),
            SkidBegin::From(place) => {
                let apart = self.skidded(id, place)?;
                // S = |r − r_b|
                Some((apart.x * apart.x + apart.y * apart.y).sqrt())
            }
        }
    }

    /// (m) from the place where a skid began to that of the vehicle at the impact.
    fn skidded(&self, id: VehicleId, begin: &Place<T>) -> Option<Vector2<T>> {
        let mut demand = Demand::new(self, Purpose::Impact);
        Some(demand.cg_at_impact(id)? - demand.place(begin))
    }

    /// (rad) the direction in which the skid marks of a vehicle lead, in the axes of the engine; `None` where
    /// their length is given, or the place of the vehicle at the impact is not known.
    #[must_use]
    pub fn skid_direction(&self, id: VehicleId) -> Option<T> {
        let SkidBegin::From(place) = &self.vehicles[id.index()].skid()?.begin else { return None };
        let apart = self.skidded(id, place)?;
        Some(Real::atan2(apart.y, apart.x))
    }

    /// Everything that finding speeds from the motion after the impact needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn two_speeds(&self) -> Result<TwoSpeedInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Reconstruct);
        if self.reconstruct.is_none() {
            let example = "`find = [\"vehicle1.speed\", \"vehicle2.speed\"]` in a table [reconstruct]";
            demand.missing("reconstruct.find", example);
        }
        demand.both_tables();
        demand.skids();
        let fixed = VehicleId::ALL.into_iter().find(|id| self.vehicles[id.index()].fixed);
        let sought = demand.sought(fixed);
        let contact = demand.momentum_contact(fixed);
        let departures = VehicleId::ALL.map(|id| demand.departure(id));
        let any_told = self.movers().any(|id| self.tells_departure(id));
        let mut vehicles = [None, None];
        let mut followed = [false; 2];
        for id in self.movers() {
            let after = self.vehicles[id.index()].after.as_ref();
            let has_rest = after.is_some_and(|after| after.rest.is_some());
            if departures[id.index()].is_none() && !has_rest && !(self.locked_together && any_told) {
                demand.missing_departure(id);
            }
            // A vehicle that only has a velocity need not be followed.
            if has_rest || self.can_follow(id) {
                followed[id.index()] = true;
                demand.is_of_point_masses = false;
                let subject = demand.subject(id);
                vehicles[id.index()] = demand.vehicle_motion(id, subject.as_ref(), Departed::ByImpact);
            }
        }
        let needs_ground = self.surface.is_some() || followed != [false, false];
        let surface = if needs_ground { demand.surface(followed) } else { None };
        let has_crush = self.movers().all(|id| self.vehicles[id.index()].has_damage_data());
        let find = self.reconstruct.as_ref().map(|reconstruct| reconstruct.find);
        if find == Some(Find::Both) {
            demand.crush_of_collinear();
        }
        demand.finish(contact.zip(sought).map(|(known, sought)| TwoSpeedInput {
            sought,
            geometry: known.geometry,
            contact: known.contact,
            law: known.law,
            yaw_rates: known.yaw_rates,
            vehicles: known.vehicles,
            departures,
            locked_together: self.locked_together,
            motion: surface.map(|surface| MotionInput { surface, vehicles }),
            basis: self.energy_basis(),
            has_crush,
        }))
    }
}

/// Whether there is damage that took energy.
fn has_crush<T>(vehicle: &GivenVehicle<T>) -> bool {
    vehicle.crush.is_some() || vehicle.energy.as_ref().is_some_and(|energy| energy.ees().is_some())
}

/// The known data on the contact of vehicles whose speeds are sought from momentum.
struct KnownContact<T> {
    geometry: Geometry,
    contact: Contact<T>,
    law: Option<VaryingLaw<T>>,
    yaw_rates: [T; 2],
    vehicles: [VehicleData<T>; 2],
}

impl<T: Real> Demand<'_, T> {
    /// Which speeds are sought.
    fn sought(&mut self, fixed: Option<VehicleId>) -> Option<Sought<T>> {
        let find = self.case.reconstruct.as_ref()?.find;
        let Some(vehicle) = find.unknown() else { return Some(Sought::Both) };
        if fixed.is_some() {
            return Some(Sought::IntoWall { vehicle });
        }
        let other = vehicle.other();
        let motion = self.motion(other, true)?;
        let course = self.case.courses()[other.index()]?;
        let (sin, cos) = course.sin_cos();
        // u = v·ê: the course is that of the velocity.
        let known = motion.velocity.x * cos + motion.velocity.y * sin;
        Some(Sought::Beside { vehicle, known })
    }

    /// The contact, as far as the case gives it: data that momentum does not need are not required.
    fn momentum_contact(&mut self, fixed: Option<VehicleId>) -> Option<KnownContact<T>> {
        let mut whole = Demand::new(self.case, self.purpose);
        let collision = whole.collision(|_| false);
        let only_lacks = whole.faults.iter().all(|fault| matches!(fault.kind, FaultKind::Missing { .. }));
        let needs_all = self.case.reconstruct.as_ref().is_some_and(|find| find.find == Find::Both)
            && self.collinear_angle().is_some();
        if !only_lacks || needs_all || (collision.is_some() && whole.faults.is_empty()) {
            self.faults.append(&mut whole.faults);
            return collision.map(|CollisionData { contact, law, motions, vehicles }| KnownContact {
                geometry: Geometry::Given,
                contact,
                law: Some(law),
                yaw_rates: motions.map(|motion| motion.yaw_rate),
                vehicles,
            });
        }
        self.is_of_point_masses = true;
        let vehicles = VehicleId::ALL.map(|id| self.subject(id));
        let headings = VehicleId::ALL.map(|id| {
            let heading = self.case.headings()[id.index()];
            if fixed == Some(id) {
                return Some(heading.unwrap_or(T::ZERO));
            }
            self.given(heading, format_args!("{}.heading", table(id)), "`heading = \"180 deg\"`")
        });
        // The rebound from a fixed object follows from its plane and the restitution.
        let law = if fixed.is_some() { Some(self.law()?) } else { None };
        let ([Some(one), Some(two)], [Some(h1), Some(h2)]) = (vehicles, headings) else { return None };
        let mut vehicles = [one, two];
        let masses = vehicles.each_ref().map(|vehicle| vehicle.inertia.map(|inertia| inertia.mass));
        let courses = self.case.courses().map(|course| course.unwrap_or(T::ZERO));
        let contact = self.accepted("vehicle1", point_masses(masses, [h1, h2], courses))?;
        let (geometry, contact) = match fixed {
            None => (Geometry::PointMasses, contact),
            Some(id) => {
                let (sin, cos) = self.lateral(&self.case.impact.as_ref()?.crush_plane).sin_cos();
                let normal = Vector2::new(cos, sin);
                let course = contact.participants()[id.other().index()].course();
                // The object lies ahead, so n from vehicle 2 to vehicle 1 points against the course of 1.
                let ahead = normal.x * course.x + normal.y * course.y > T::ZERO;
                let normal = if ahead == (id == VehicleId::Two) { -normal } else { normal };
                let contact = central_contact(contact.participants(), normal);
                (Geometry::Plane, self.accepted("impact.crush_plane", contact)?)
            }
        };
        fill_opposite_pdof(self.case.headings(), vehicles.each_mut().map(Some));
        Some(KnownContact { geometry, contact, law, yaw_rates: [T::ZERO; 2], vehicles })
    }

    /// (m) a place in the axes of the engine.
    pub(super) fn place(&self, place: &Place<T>) -> Vector2<T> {
        Vector2::new(place.x.si(), self.lateral(&place.y))
    }

    /// The ground. It needs no table `[surface]` where every vehicle that is followed has its own friction.
    fn surface(&mut self, followed: [bool; 2]) -> Option<SurfaceData<T>> {
        let Some(surface) = &self.case.surface else {
            let own = VehicleId::ALL
                .into_iter()
                .filter(|id| followed[id.index()])
                .map(|id| self.case.vehicles[id.index()].after.as_ref().and_then(|after| after.friction));
            if let Some(friction) = own.reduce(Option::and).flatten() {
                let grade = Vector2::new(T::ZERO, T::ZERO);
                return Some(SurfaceData { friction, grade, zones: Vec::new() });
            }
            self.missing(
                "surface.friction",
                "the friction between the tyres and the ground on which the vehicles came to rest: `friction = 0.7` in a table [surface]",
            );
            return None;
        };
        let grade = surface.grade.as_ref().map_or(Vector2::new(T::ZERO, T::ZERO), |grade| {
            let (sin, cos) = self.lateral(&grade.uphill).sin_cos();
            // i = s (cos φ, sin φ)
            Vector2::new(grade.slope * cos, grade.slope * sin)
        });
        let axes = self.case.axes;
        let zones = surface.zones.iter().map(|zone| ZoneData {
            name: zone.name.clone(),
            friction: zone.friction,
            region: region(axes, &zone.region),
        });
        let data = SurfaceData { friction: surface.friction, grade, zones: zones.collect() };
        let ground = trajectory::Ground { friction: data.friction, zones: &[], grade };
        self.accepted("surface", ground.check())?;
        for (index, zone) in data.zones().iter().enumerate() {
            let ground = trajectory::Ground { friction: zone.friction, zones: &[*zone], grade };
            self.accepted(format_args!("surface.zone[{}].friction", index + 1), ground.check())?;
        }
        Some(data)
    }

    /// Speed and direction after the impact; the case file gives no speed without a direction.
    fn departure(&self, id: VehicleId) -> Option<Departure<T>> {
        let after = self.case.vehicles[id.index()].after.as_ref()?;
        let (speed, direction) = (after.speed.as_ref()?, after.direction.as_ref()?);
        let (sin, cos) = self.lateral(direction).sin_cos();
        Some(Departure {
            // V = |V| (cos φ, sin φ)
            velocity: Vector2::new(speed.si() * cos, speed.si() * sin),
            yaw_rate: after.yaw_rate.as_ref().map(|rate| self.lateral(rate)),
        })
    }

    fn missing_departure(&mut self, id: VehicleId) {
        let table = table(id);
        self.missing(
            format_args!("{table}.after.rest"),
            &format!(
                "how vehicle {id} left the impact, in a table [{table}.after]: `rest = {{ x = \"31.2 m\", y = \"9.8 m\", heading = \"140 deg\" }}` \
                 with `drag`, or `speed` and `direction` just after the impact; if both left it as one \
                 wreck, this is enough for one of them, with `locked_together = true` in [scene]"
            ),
        );
    }

    /// A vehicle that moves and has a table `after`.
    fn vehicle_motion(
        &mut self,
        id: VehicleId,
        subject: Option<&VehicleData<T>>,
        departed: Departed,
    ) -> Option<VehicleMotion<T>> {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        let after = vehicle.after.as_ref()?;
        let velocity = self.departure(id);
        if departed == Departed::Wholly && after.rest.is_none() {
            match &velocity {
                None => self.missing_departure(id),
                Some(Departure { yaw_rate: None, .. }) => self.missing(
                    format_args!("{table}.after.yaw_rate"),
                    "the yaw rate just after the impact, `yaw_rate = \"90 deg/s\"`, which is \"0 deg/s\" if the vehicle did not turn",
                ),
                Some(_) => {}
            }
        }
        let heading = self.case.headings()[id.index()];
        let heading = self.given(heading, format_args!("{table}.heading"), "`heading = \"180 deg\"`");
        let position = self.position_at_impact(id, subject, after);
        let axles = self.axles(id, vehicle);
        let drag = self.drag(id, after);
        let rest = after.rest.as_ref().map(|rest| RestData {
            position: self.place(&rest.place),
            heading: match &rest.heading {
                RestHeading::Heading(heading) => RestHeadingData::Heading(self.lateral(heading)),
                RestHeading::Turned(turned) => RestHeadingData::Turned(self.lateral(turned)),
            },
        });
        let points: Vec<PointData<T>> = after
            .points
            .iter()
            .map(|point| PointData {
                position: self.place(&point.place),
                heading: point.heading.as_ref().map(|heading| self.lateral(heading)),
                wheel: point.wheel,
            })
            .collect();
        let steer = self.steer(after);
        let inertia = subject.and_then(|subject| subject.inertia);
        let yaw_inertia = inertia.and_then(|inertia| {
            self.given(
                inertia.yaw_inertia,
                format_args!("{table}.yaw_inertia"),
                "`yaw_inertia = \"2437 lb ft s^2\"`, the radius of gyration, `yaw_radius = \"1.40 m\"`, or CRASH3's size class, `class = 3`",
            )
        });
        let (position, inertia) = (position?, inertia?);
        self.path(id, position, rest.as_ref().map(|rest| rest.position), &points);
        let body = self.accepted(table, Body::new(inertia.mass, yaw_inertia?))?;
        let (axles, drag) = (axles?, drag?);
        if let Some(friction) = after.friction {
            let ground = trajectory::Ground { friction, zones: &[], grade: Vector2::new(T::ZERO, T::ZERO) };
            self.accepted(format_args!("{table}.after.friction"), ground.check())?;
        }
        let friction = after.friction;
        let chassis = self.accepted(format_args!("{table}.after.drag"), Chassis::new(body, axles, drag))?;
        Some(VehicleMotion { chassis, steer, friction, position, heading: heading?, velocity, rest, points })
    }

    /// The place of the CG at the impact.
    fn position_at_impact(
        &mut self,
        id: VehicleId,
        subject: Option<&VehicleData<T>>,
        after: &After<T>,
    ) -> Option<Vector2<T>> {
        let table = table(id);
        if let Some(position) = &self.case.vehicles[id.index()].position {
            return Some(self.place(position));
        }
        let has_places = after.rest.is_some() || !after.points.is_empty();
        let has_zones = self.case.surface.as_ref().is_some_and(|surface| !surface.zones.is_empty());
        let heading = self.case.headings()[id.index()];
        let Some(contact) = self.contact_in_scene(id.other()) else {
            if !has_places && !has_zones {
                let arm = subject.and_then(|subject| subject.contact).zip(heading);
                return Some(
                    arm.map_or(Vector2::new(T::ZERO, T::ZERO), |(arm, heading)| -in_scene(arm, heading)),
                );
            }
            self.missing(
                "scene.contact",
                &format!(
                    "the place of the impact, from which the path begins: `contact = {{ x = \"12.4 m\", y = \"3.1 m\" }}` in a table [scene], or \
                     that of the CG at the impact, `position = {{ x = \"10.8 m\", y = \"3.9 m\" }}` in [{table}], in the same coordinates as the \
                     rest"
                ),
            );
            return None;
        };
        // Without a subject, the missing data have already been reported.
        let arm = self.given(
            subject?.contact,
            format_args!("{table}.contact"),
            "`contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }` or `contact = { x = \"1.78 m\", y = \"-0.73 m\" }`",
        );
        Some(contact - in_scene(arm?, heading?))
    }

    /// (m) position of the contact point: as given for the scene, or from the CG of `vehicle` and its arm.
    fn contact_in_scene(&mut self, vehicle: VehicleId) -> Option<Vector2<T>> {
        match &self.case.scene_contact {
            Some(place) => Some(self.place(place)),
            None => self.contact_from(vehicle),
        }
    }

    /// (m) position of the contact point from the given CG of a vehicle and its arm.
    pub(super) fn contact_from(&mut self, vehicle: VehicleId) -> Option<Vector2<T>> {
        let position = self.place(self.case.vehicles[vehicle.index()].position.as_ref()?);
        let heading = self.case.headings()[vehicle.index()]?;
        Some(position + in_scene(self.subject(vehicle)?.contact?, heading))
    }

    /// (m) the position of the CG at the impact if the case gives it, without a fault if it does not.
    fn cg_at_impact(&mut self, id: VehicleId) -> Option<Vector2<T>> {
        if let Some(position) = &self.case.vehicles[id.index()].position {
            return Some(self.place(position));
        }
        let heading = self.case.headings()[id.index()]?;
        let contact = self.contact_in_scene(id.other())?;
        Some(contact - in_scene(self.subject(id)?.contact?, heading))
    }

    /// Given values take precedence over those of the class.
    fn axles(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) -> Option<Axles<T>> {
        let table = table(id);
        let is_car = vehicle.kind.unwrap_or_default() == VehicleKind::Car;
        let of_class = if is_car { self.class(id, vehicle) } else { None };
        let class = of_class.map(|(_, class)| class);
        let given = |quantity: &Option<Quantity<T>>| quantity.as_ref().map(Quantity::si);
        let or_class = if is_car { ", or CRASH3's size class, `class = 3`" } else { "" };
        let wheelbase = given(&vehicle.wheelbase).or(class.map(|class| T::from(class.wheelbase)));
        let wheelbase = self.given(
            wheelbase,
            format_args!("{table}.wheelbase"),
            format_args!("`wheelbase = \"2.62 m\"`{or_class}"),
        );
        let track = given(&vehicle.track).or(class.map(|class| T::from(class.track)));
        let track =
            self.given(track, format_args!("{table}.track"), format_args!("`track = \"1.50 m\"`{or_class}"));
        // a = l · a_c/l_c of the class
        let share = class.map(|class| class.cg_to_front_axle / class.wheelbase);
        let of_class = share.zip(wheelbase).map(|(share, wheelbase)| wheelbase * share);
        let cg_to_front = self.given(
            given(&vehicle.cg_to_front_axle).or(of_class),
            format_args!("{table}.cg_to_front_axle"),
            format_args!("`cg_to_front_axle = \"1.10 m\"`{or_class}"),
        );
        let (wheelbase, track, cg_to_front) = (wheelbase?, track?, cg_to_front?);
        // The share of a class is less than one.
        if let Some(given) = vehicle.cg_to_front_axle
            && cg_to_front.value() >= wheelbase.value()
        {
            let unit = given.unit();
            let [ahead, wheelbase] = [cg_to_front, wheelbase].map(|length| length.value() / unit.factor());
            self.refuse(
                format_args!("{table}.cg_to_front_axle"),
                format_args!(
                    "the front axle lies {ahead:.2} {unit} ahead of the CG, but the wheelbase is only {wheelbase:.2} {unit}"
                ),
                "measure both from the front axle: the CG lies between the axles",
            );
            return None;
        }
        Some(Axles { cg_to_front, cg_to_rear: wheelbase - cg_to_front, track })
    }

    fn drag(&mut self, id: VehicleId, after: &After<T>) -> Option<[T; 4]> {
        let drag = self.given(
            after.drag,
            format_args!("{}.after.drag", table(id)),
            "what slowed the wheels: `drag = 0.01` if all rolled freely, `drag = \"locked\"` if none turned, or, front left, front right, \
             rear left, rear right, `drag = [0.01, \"locked\", 0.01, 0.01]`",
        )?;
        Some(drag.wheels().map(|wheel| match wheel {
            WheelDrag::Locked => T::from(GREATEST_DRAG),
            WheelDrag::Share(share) => share,
        }))
    }

    fn steer(&self, after: &After<T>) -> SteerData<T> {
        match &after.steer {
            None => SteerData::Held(T::ZERO),
            Some(GivenSteer::Held(angle)) => SteerData::Held(self.lateral(angle)),
            Some(GivenSteer::Over(points)) => SteerData::Over(
                points.iter().map(|point| (point.time.si(), self.lateral(&point.angle))).collect(),
            ),
        }
    }

    /// Whether the places lie one after the other, as those of a path do.
    fn path(&mut self, id: VehicleId, from: Vector2<T>, rest: Option<Vector2<T>>, points: &[PointData<T>]) {
        let table = table(id);
        let last = points.len();
        let key = |index: usize| {
            if index == last {
                format!("{table}.after.rest")
            } else {
                format!("{table}.after.points[{}]", index + 1)
            }
        };
        let at = |place: &Vector2<T>| [place.x.value(), place.y.value()];
        let mut before = at(&from);
        let mut leg_before: Option<[f64; 2]> = None;
        // The wheels of a spinning vehicle go to and fro.
        let places = points.iter().enumerate().filter(|(_, point)| point.wheel.is_none());
        let places = places.map(|(index, point)| (index, &point.position));
        for (index, place) in places.chain(rest.iter().map(|rest| (last, rest))) {
            let place = at(place);
            let leg = [place[0] - before[0], place[1] - before[1]];
            let distance = (leg[0] * leg[0] + leg[1] * leg[1]).sqrt();
            if distance.is_nan() || distance < LEAST_PATH {
                let of = if leg_before.is_none() {
                    "the place of its CG at the impact"
                } else {
                    "the point before it"
                };
                self.refuse(
                    key(index),
                    format_args!("this place is {:.1} mm from {of}, so there is no path", 1000.0 * distance),
                    "give the places of the CG in the coordinates of [scene] contact; a vehicle that did not move has no speed to be found \
                     from its rest",
                );
                return;
            }
            // cos ψ of the angle between the legs: negative beyond 90°
            let turn = leg_before.map(|other| {
                let cross = other[0] * leg[1] - other[1] * leg[0];
                elementary::atan2(cross, other[0] * leg[0] + other[1] * leg[1])
            });
            if let Some(turn) = turn.filter(|turn| turn.abs() > FRAC_PI_2) {
                self.refuse(
                    key(index),
                    format_args!(
                        "the path turns back: to get here it turns by {:.0}° at the place before",
                        turn.abs().to_degrees()
                    ),
                    "list the points in the order in which the CG passed them, from the impact to the rest, and leave out a point that is \
                     nearer to the next one than both are known; a second impact or a rebound ends the path before it",
                );
                return;
            }
            (before, leg_before) = (place, Some(leg));
        }
    }

    /// (rad) the angle between approaches that are collinear; `None` of those that cross.
    fn collinear_angle(&self) -> Option<f64> {
        self.case.approach_angle().filter(|angle| are_collinear(*angle))
    }

    /// Where the approaches are collinear, momentum gives one equation for two speeds.
    fn crush_of_collinear(&mut self) {
        let Some(angle) = self.collinear_angle() else { return };
        let known = VehicleId::ALL.into_iter().find(|id| self.case.vehicles[id.index()].motion.is_some());
        let find = known.map_or("vehicle1.speed", |known| match known {
            VehicleId::One => "vehicle2.speed",
            VehicleId::Two => "vehicle1.speed",
        });
        let speed = match known {
            Some(known) => {
                format!("as the file gives the speed of vehicle {known}, `find = \"{find}\"` is enough")
            }
            None => format!(
                "if one vehicle was stationary or its speed is known, `speed = \"0 km/h\"` in its table and \
                 `find = \"{find}\"` (or that of \
                 vehicle 2)"
            ),
        };
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.case.vehicles) {
            if !vehicle.fixed && !vehicle.is_absent() && !vehicle.has_damage_data() {
                let degrees = angle.to_degrees();
                self.missing(
                    format_args!("{}.crush", table(id)),
                    &format!(
                        "the damage of both vehicles: their directions of travel are {degrees:.0}° apart, within 10° of one line, and along one line \
                         momentum alone does not distinguish one speed from the other; a table with side, width, depths and stiffness, or \
                         `ees`{UNINSPECTED}; or \
                         `crush = \"none\"` in [{}], if the other vehicle alone was damaged. Without damage: {speed}",
                        table(id)
                    ),
                );
            }
        }
    }

    /// Refuses skid marks whose friction is not known.
    pub(super) fn skids(&mut self) {
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.case.vehicles) {
            let Some(skid) = vehicle.skid() else { continue };
            match (self.case.skid_length(id, skid), &skid.begin) {
                (None, _) => self.missing(
                    format_args!("{}.position", table(id)),
                    "the place of the CG at the impact, where the skid ends that begins at `from`: \
                     `position = { x = \"10.8 m\", y = \"3.9 m\" }`, \
                     or `contact` in a table [scene] and in that of the vehicle",
                ),
                (Some(length), SkidBegin::From(_))
                    if length.value().is_nan() || length.value() < LEAST_PATH =>
                {
                    self.refuse(
                        format_args!("{}.before.skid.from", table(id)),
                        format_args!(
                            "the skid begins {:.1} mm from the place of the CG at the impact, so it has no length",
                            1000.0 * length.value()
                        ),
                        "give where the CG was when the wheels locked, in the coordinates of `position`",
                    );
                }
                (Some(_), _) => {}
            }
            if skid.friction.is_none() && self.case.surface.is_none() {
                self.missing(
                    format_args!("{}.before.skid.friction", table(id)),
                    "the friction of the ground on which the wheels skidded: `skid = { length = \"18 m\", friction = 0.7 }`, or `friction` in a table [surface]",
                );
            }
        }
    }
}

/// A region in the axes of the engine.
fn region(axes: Axes, region: &SurfaceRegion) -> RegionData {
    let at = |place: &Place| Vector2::new(place.x.si(), axes.lateral(place.y.si()));
    match region {
        SurfaceRegion::Polygon(corners) => RegionData::Polygon(corners.iter().map(at).collect()),
        SurfaceRegion::Beside { edge: [from, to], side } => {
            let (from, to) = (at(from), at(to));
            let along = elementary::atan2(to.y - from.y, to.x - from.x);
            // Left and right are those seen from above, in any axes.
            let into = match side {
                EdgeSide::Left => along + FRAC_PI_2,
                EdgeSide::Right => along - FRAC_PI_2,
            };
            RegionData::HalfPlane { point: from, into }
        }
    }
}
