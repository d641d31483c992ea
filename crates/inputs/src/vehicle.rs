//! A vehicle: the content of the tables `[vehicle1]` and `[vehicle2]`.

use std::fmt::Display;

use crash3::{Side, VehicleClass};
use pim_core::{Motion, Real, Vector2};

use crate::after::{After, Before, GivenPhase, Skid};
use crate::axes::Axes;
use crate::choices;
use crate::crush::{Crush, KnownEnergy};
use crate::dimensions::Dimensions;
use crate::inertia::{Mass, YawInertia};
use crate::quantity::Quantity;
use crate::recorder::{CertainSpeed, Recorder};
use crate::scene::Place;
use crate::text::Text;
use crate::walk::{Key, Walk};

choices! {
    /// The kind of a vehicle: its plausible sizes, the tables that apply to it and its drawing depend on it.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum VehicleKind {
        /// `"car"`: a car, a van or a pickup.
        #[default]
        Car = "car",
        /// `"heavy-truck"`: a lorry, a bus, or a tractor with its semitrailer, taken as one rigid body.
        HeavyTruck = "heavy-truck",
        /// `"trailer"`: a trailer or semitrailer alone.
        Trailer = "trailer",
        /// `"motorcycle"`: a motorcycle, a scooter or a moped.
        Motorcycle = "motorcycle",
    }
}

/// A vehicle or, with [`fixed`](GivenVehicle::fixed), a barrier. Every value is optional here; each
/// computation reports the values that it needs and does not find.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenVehicle<T = f64> {
    /// Make and model.
    pub name: Option<Text>,
    /// A barrier: it has neither mass nor motion nor crush.
    pub fixed: bool,
    /// Its kind; [`VehicleKind::Car`] if absent.
    pub kind: Option<VehicleKind>,
    /// `mass` or `weight`.
    pub mass: Option<Mass<T>>,
    /// `yaw_inertia` or `yaw_radius`.
    pub yaw: Option<YawInertia<T>>,
    /// CRASH3's size class, 1 to 6: supplies the yaw inertia and the outline if they are not given.
    pub class: Option<u8>,
    /// Model year: the errors of an energy by a category of stiffness depend on it.
    pub model_year: Option<u16>,
    /// (m) wheelbase: with the length, it gives the yaw inertia if neither that nor a class is given.
    pub wheelbase: Option<Quantity<T>>,
    /// (m) between the wheels of an axle: for the motion after the impact.
    pub track: Option<Quantity<T>>,
    /// (m) from the centre of gravity forward to the front axle: for the motion after the impact.
    pub cg_to_front_axle: Option<Quantity<T>>,
    /// (m) length of the body, if the rest of the outline is unknown.
    pub length: Option<Quantity<T>>,
    /// (rad) scene angle of the vehicle's forward axis, in the sense of the axes.
    pub heading: Option<Quantity<T>>,
    /// (rad) from the heading to the direction of travel before the impact, in the sense of the axes; 0 where
    /// absent.
    pub sideslip: Option<Quantity<T>>,
    /// Position of the centre of gravity at the impact, in the coordinates of the survey.
    pub position: Option<Place<T>>,
    /// From the centre of gravity to the point where the impulse acts. If it is absent, an impact takes the
    /// centroid of the damage, provided that the case gives [its position](Self::places_contact).
    pub contact: Option<ContactPoint<T>>,
    /// `speed` or `velocity`, before the impact.
    pub motion: Option<Velocity<T>>,
    /// (rad/s) yaw rate before the impact, in the sense of the axes; 0 where absent.
    pub yaw_rate: Option<Quantity<T>>,
    /// The body seen from above.
    pub outline: Option<Outline<T>>,
    /// (m) of a pole or a tree: a fixed object that is round.
    pub diameter: Option<Quantity<T>>,
    /// (J) energy that a fixed object absorbed where it bent, cracked or leaned.
    pub deformation_energy: Option<Quantity<T>>,
    /// `[vehicleN.crush]` with a measured or inferred crush.
    pub crush: Option<Crush<T>>,
    /// `[vehicleN.crush]` with `ees`, or `crush = "none"`, in place of a crush.
    pub energy: Option<KnownEnergy<T>>,
    /// `[vehicleN.before]`.
    pub before: Option<Before<T>>,
    /// `[vehicleN.after]`.
    pub after: Option<After<T>>,
    /// `[vehicleN.recorder]`.
    pub recorder: Option<Recorder>,
    /// `certain_speed`.
    pub certain_speed: Option<CertainSpeed>,
}

impl GivenVehicle {
    /// (rad/s) yaw rate before the impact, in the sense of the axes; 0 where the case gives none.
    #[must_use]
    pub fn yaw_rate_before(&self) -> f64 {
        self.yaw_rate.as_ref().map_or(0.0, Quantity::si)
    }
}

impl<T> GivenVehicle<T> {
    /// Whether the case gives the crush energy, in one form or another.
    #[must_use]
    pub fn has_damage_data(&self) -> bool {
        self.crush.is_some() || self.energy.is_some()
    }

    /// Whether the contact point of an impact is placed at the centroid of the damage: the case does not give
    /// the point, but a measured crush, its place on the face, and the outline or the size class.
    #[must_use]
    pub fn places_contact(&self) -> bool {
        let is_placed = self.crush.as_ref().is_some_and(|crush| {
            let has_width = crush.width.is_some() || crush.spacing.is_some();
            !crush.from_force_balance && has_width && crush.offset.is_some()
        });
        !self.fixed && self.contact.is_none() && is_placed && self.has_outline()
    }

    /// The side that was damaged, by its crush or its EES.
    #[must_use]
    pub fn damaged_side(&self) -> Option<Side> {
        match (&self.crush, &self.energy) {
            (Some(crush), _) => Some(crush.side),
            (None, Some(KnownEnergy::Ees(ees))) => ees.side,
            (None, Some(KnownEnergy::Undamaged) | None) => None,
        }
    }

    /// The skid marks before the impact.
    #[must_use]
    pub fn skid(&self) -> Option<&Skid<T>> {
        self.before.as_ref()?.skid.as_ref()
    }

    /// How it moved before the impact, in the order of time.
    #[must_use]
    pub fn phases(&self) -> &[GivenPhase<T>] {
        self.before.as_ref().map_or(&[], |before| &before.phases)
    }

    /// Whether the outline is known: as given, or from the size class.
    pub(crate) fn has_outline(&self) -> bool {
        self.outline.is_some() || self.class.is_some()
    }

    /// Whether the case has no data on it, so that the other vehicle is alone.
    #[must_use]
    pub fn is_absent(&self) -> bool {
        // Without `..`: a new field does not compile before it counts here.
        matches!(
            self,
            Self {
                name: None,
                fixed: false,
                kind: None,
                mass: None,
                yaw: None,
                class: None,
                model_year: None,
                wheelbase: None,
                track: None,
                cg_to_front_axle: None,
                length: None,
                heading: None,
                sideslip: None,
                position: None,
                contact: None,
                motion: None,
                yaw_rate: None,
                outline: None,
                diameter: None,
                deformation_energy: None,
                crush: None,
                energy: None,
                before: None,
                after: None,
                recorder: None,
                certain_speed: None,
            }
        )
    }
}

/// Where the impulse acts, from the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPoint<T = f64> {
    /// Distance and direction.
    Polar {
        /// (m) distance.
        distance: Quantity<T>,
        /// (rad) angle from the vehicle's heading, in the sense of the axes.
        angle: Quantity<T>,
    },
    /// Along the vehicle's own axes.
    Cartesian {
        /// (m) forward.
        x: Quantity<T>,
        /// (m) left, or right in z-down axes.
        y: Quantity<T>,
    },
}

impl<T: Copy> ContactPoint<T> {
    /// Both numbers.
    #[must_use]
    pub fn quantities(&self) -> [&Quantity<T>; 2] {
        match self {
            Self::Polar { distance, angle } => [distance, angle],
            Self::Cartesian { x, y } => [x, y],
        }
    }

    /// The same with other numbers.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> ContactPoint<U> {
        self.map_quantities(|_, quantity| quantity.map(&mut number))
    }

    /// The same with other quantities, which come with their keys.
    #[inline(always)]
    pub(crate) fn map_quantities<U>(
        self,
        mut of: impl FnMut(&'static str, Quantity<T>) -> Quantity<U>,
    ) -> ContactPoint<U> {
        match self {
            Self::Polar { distance, angle } => {
                ContactPoint::Polar { distance: of("distance", distance), angle: of("angle", angle) }
            }
            Self::Cartesian { x, y } => ContactPoint::Cartesian { x: of("x", x), y: of("y", y) },
        }
    }
}

impl<T: Real> ContactPoint<T> {
    /// (m) forward of the centre of gravity, and left of it or, in z-down axes, right.
    #[inline(always)]
    #[must_use]
    pub fn xy(&self) -> [T; 2] {
        match self {
            Self::Polar { distance, angle } => {
                let (sin, cos) = angle.si().sin_cos();
                // (d cos φ, d sin φ)
                [distance.si() * cos, distance.si() * sin]
            }
            Self::Cartesian { x, y } => [x.si(), y.si()],
        }
    }

    /// (m) forward and left of the centre of gravity.
    #[inline(always)]
    #[must_use]
    pub fn point(&self, axes: Axes) -> [T; 2] {
        let [x, y] = self.xy();
        [x, axes.lateral(y)]
    }
}

/// Velocity of the centre of gravity before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity<T = f64> {
    /// (m/s) along the heading, or along the direction of travel where the case gives a sideslip; negative
    /// when reversing.
    Speed(Quantity<T>),
    /// In the scene.
    Vector {
        /// (m/s) along the scene's x.
        x: Quantity<T>,
        /// (m/s) along the scene's y.
        y: Quantity<T>,
    },
}

impl<T: Copy> Velocity<T> {
    /// The same with other numbers.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> Velocity<U> {
        self.map_quantities(|_, quantity| quantity.map(&mut number))
    }

    #[inline(always)]
    fn map_quantities<U>(self, mut of: impl FnMut(&'static str, Quantity<T>) -> Quantity<U>) -> Velocity<U> {
        match self {
            Self::Speed(speed) => Velocity::Speed(of("speed", speed)),
            Self::Vector { x, y } => Velocity::Vector { x: of("velocity.x", x), y: of("velocity.y", y) },
        }
    }
}

impl<T: Real> Velocity<T> {
    /// (m/s) in the axes of the engine, of a vehicle that travels in the direction `course` (rad).
    #[inline(always)]
    #[must_use]
    pub fn vector(&self, axes: Axes, course: T) -> Vector2<T> {
        match self {
            Self::Speed(speed) => Motion::along(course, speed.si()).velocity,
            Self::Vector { x, y } => Vector2::new(x.si(), axes.lateral(y.si())),
        }
    }

    /// (m/s) the speed; of a vector, its length.
    #[must_use]
    pub fn size(&self) -> T {
        match self {
            Self::Speed(speed) => speed.si(),
            // |v| = √(v_x² + v_y²)
            Self::Vector { x, y } => (x.si() * x.si() + y.si() * y.si()).sqrt(),
        }
    }
}

/// The body seen from above: enough to draw it and to see whether the contact point lies on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline<T = f64> {
    /// (m) of the body.
    pub length: Quantity<T>,
    /// (m) of the body.
    pub width: Quantity<T>,
    /// (m) from the centre of gravity forward to the front bumper.
    pub cg_to_front: Quantity<T>,
}

impl<T: Copy> Outline<T> {
    /// Its numbers.
    #[must_use]
    pub fn quantities(&self) -> [&Quantity<T>; 3] {
        let Self { length, width, cg_to_front } = self;
        [length, width, cg_to_front]
    }

    /// The same with other numbers.
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> Outline<U> {
        self.map_quantities(|quantity| quantity.map(&mut number))
    }

    pub(crate) fn map_quantities<U>(self, mut of: impl FnMut(Quantity<T>) -> Quantity<U>) -> Outline<U> {
        let Self { length, width, cg_to_front } = self;
        Outline { length: of(length), width: of(width), cg_to_front: of(cg_to_front) }
    }
}

impl<T: From<f64>> Outline<T> {
    /// That of a size class.
    pub(crate) fn of_class(class: &VehicleClass) -> Self {
        let [length, width, cg_to_front] =
            [class.length, class.width, class.cg_to_front].map(Quantity::metres);
        Self { length, width, cg_to_front }
    }
}

impl<T: Real> Outline<T> {
    /// In SI.
    #[must_use]
    pub fn dimensions(&self) -> Dimensions<T> {
        let [length, width, cg_to_front] = self.quantities().map(Quantity::si);
        Dimensions { length, width, cg_to_front, class: None }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn vehicle(
        &mut self,
        table: &dyn Display,
        vehicle: &GivenVehicle,
        fit_left_out: bool,
    ) -> GivenVehicle<U> {
        let at = |key| Key(table, key);
        GivenVehicle {
            name: self.text(&at("name"), vehicle.name.as_ref()),
            fixed: self.flag(&at("fixed"), vehicle.fixed),
            kind: vehicle.kind.map(|kind| self.choice(&at("kind"), &VehicleKind::WORDS, kind)),
            mass: vehicle.mass.as_ref().map(|mass| self.mass(table, mass)),
            yaw: vehicle.yaw.as_ref().map(|yaw| match yaw {
                YawInertia::Inertia(q) => YawInertia::Inertia(self.quantity(&at("yaw_inertia"), q)),
                YawInertia::Radius(q) => YawInertia::Radius(self.quantity(&at("yaw_radius"), q)),
            }),
            class: vehicle.class.map(|class| self.count(&at("class"), class)),
            model_year: vehicle.model_year.map(|year| self.count(&at("model_year"), year)),
            wheelbase: self.maybe(&at("wheelbase"), vehicle.wheelbase.as_ref()),
            track: self.maybe(&at("track"), vehicle.track.as_ref()),
            cg_to_front_axle: self.maybe(&at("cg_to_front_axle"), vehicle.cg_to_front_axle.as_ref()),
            length: self.maybe(&at("length"), vehicle.length.as_ref()),
            heading: self.maybe(&at("heading"), vehicle.heading.as_ref()),
            sideslip: self.maybe(&at("sideslip"), vehicle.sideslip.as_ref()),
            position: vehicle.position.as_ref().map(|place| self.place(&at("position"), place)),
            contact: vehicle
                .contact
                .map(|contact| contact.map_quantities(|key, q| self.quantity(&Key(&at("contact"), key), &q))),
            motion: vehicle.motion.map(|motion| motion.map_quantities(|key, q| self.quantity(&at(key), &q))),
            yaw_rate: self.maybe(&at("yaw_rate"), vehicle.yaw_rate.as_ref()),
            outline: vehicle.outline.as_ref().map(|outline| Outline {
                length: self.quantity(&at("length"), &outline.length),
                width: self.quantity(&at("width"), &outline.width),
                cg_to_front: self.quantity(&at("cg_to_front"), &outline.cg_to_front),
            }),
            diameter: self.maybe(&at("diameter"), vehicle.diameter.as_ref()),
            deformation_energy: self.maybe(&at("deformation_energy"), vehicle.deformation_energy.as_ref()),
            crush: vehicle.crush.as_ref().map(|crush| self.crush(&at("crush"), crush, fit_left_out)),
            energy: vehicle.energy.as_ref().map(|known| self.known_energy(&at("crush"), known)),
            before: vehicle.before.as_ref().map(|before| self.before(&at("before"), before)),
            after: vehicle.after.as_ref().map(|after| self.after(&at("after"), after)),
            recorder: vehicle.recorder.as_ref().map(|recorder| self.recorder(&at("recorder"), recorder)),
            certain_speed: vehicle
                .certain_speed
                .as_ref()
                .map(|certain| self.certain_speed(&at("certain_speed"), certain)),
        }
    }
}
