//! The inputs of an impact, as a case gives them.
//!
//! The meaning of each key for the impact is defined here alone. A form holds numbers of any type: plain
//! ones, ones with derivatives, or places of columns in a block of samples. `map` converts it to another
//! type. If its numbers can be computed with, a form computes the inputs of the engines without allocating,
//! or returns the reason why it cannot.

use std::slice;

use crash3::{
    CrushError, DamagedFace, EnergyMoments, ObliqueCorrection, Profile, Side, SideStiffness, VehicleClass,
    yaw_inertia_burg,
};
use pim_core::{Real, VehicleId};

use crate::axes::Axes;
use crate::basis::Basis;
use crate::case::Case;
use crate::crush::{Crush, GivenEes, KnownEnergy, Pdof, StiffnessForm};
use crate::estimate::YawSource;
use crate::impact::{GivenImpact, ImpactLaw};
use crate::inertia::{Mass, YawInertia};
use crate::quantity::Quantity;
use crate::vehicle::{ContactPoint, GivenVehicle, Outline, VehicleKind, Velocity};

/// An impact of two vehicles.
#[derive(Clone, Copy, Debug)]
pub struct ImpactForm<'a, N = f64> {
    /// The axes in which all its numbers are given.
    pub axes: Axes,
    /// Both vehicles.
    pub vehicles: [VehicleForm<'a, N>; 2],
    /// (rad) Γ.
    pub crush_plane: Quantity<N>,
    /// The impact law.
    pub law: &'a ImpactLaw<N>,
    /// The work that the crush energy equals.
    pub basis: Basis<N>,
}

/// A vehicle, or a fixed object, which has only a heading and a contact point.
#[derive(Clone, Copy, Debug)]
pub struct VehicleForm<'a, N = f64> {
    given: &'a GivenVehicle<N>,
    /// Whether it is fixed.
    pub fixed: bool,
    /// Its mass.
    pub mass: Option<Mass<N>>,
    /// Its yaw inertia.
    pub yaw: Option<YawForm<N>>,
    /// The body seen from above.
    pub body: Option<Outline<N>>,
    /// The point where the impulse acts.
    pub contact: Option<ContactForm<N>>,
    /// (rad) its heading. The heading of a fixed object only orients its contact point.
    pub heading: Option<Quantity<N>>,
    /// Its direction of travel, if that is not its heading.
    pub course: Option<CourseForm<N>>,
    /// Its velocity before the impact.
    pub velocity: Option<Velocity<N>>,
    /// (rad/s) its yaw rate before the impact.
    pub yaw_rate: Option<Quantity<N>>,
    /// Its damage.
    pub damage: DamageForm<'a, N>,
}

/// The source of the yaw inertia of a vehicle.
#[derive(Clone, Copy, Debug)]
pub enum YawForm<N = f64> {
    /// The case gives it.
    Given(YawInertia<N>),
    /// A size class.
    Class {
        /// Its number.
        class: u8,
        /// (m) its radius of gyration.
        radius: f64,
        /// (–) the factor on that.
        factor: N,
    },
    /// Burg's formula.
    Burg {
        /// (m) between the axles.
        wheelbase: Quantity<N>,
        /// (m) of the body.
        length: Quantity<N>,
        /// (–) the factor on the radius of gyration.
        factor: N,
    },
}

/// The source of the contact point of a vehicle.
#[derive(Clone, Copy, Debug)]
pub enum ContactForm<N = f64> {
    /// The case gives it.
    Given(ContactPoint<N>),
    /// It is placed at the centroid of the damage.
    Placed(PlacedContact<N>),
}

/// A contact point at the centroid of a damage.
#[derive(Clone, Copy, Debug)]
pub struct PlacedContact<N = f64> {
    side: Side,
    body: Outline<N>,
    offset: Quantity<N>,
    /// Along the face and inward.
    moved: [Option<Quantity<N>>; 2],
}

/// The direction of travel before the impact, along which the speed of a vehicle is measured.
#[derive(Clone, Copy, Debug)]
pub enum CourseForm<N = f64> {
    /// (rad) the angle from the heading to the direction of travel.
    Sideslip(Quantity<N>),
    /// The direction of a velocity in the scene, of a vehicle whose speed is unknown or, for momentum, known.
    /// The speed of a vehicle that moves backward is negative.
    Along {
        /// (m/s) along the scene's x.
        x: Quantity<N>,
        /// (m/s) along the scene's y.
        y: Quantity<N>,
    },
}

/// The known data of a damage.
#[derive(Clone, Copy, Debug)]
pub enum DamageForm<'a, N = f64> {
    /// Nothing.
    Unknown,
    /// There is no damage, or its energy does not count.
    Undamaged,
    /// (J) energy that a fixed object absorbed.
    OfObject(Quantity<N>),
    /// (m/s) its energy equivalent speed.
    Ees(Quantity<N>),
    /// Its crush was measured.
    Measured(CrushForm<'a, N>),
    /// Its crush is to be inferred from the force on the other vehicle.
    Inferred(CrushForm<'a, N>),
}

/// The crush of a side.
#[derive(Clone, Copy, Debug)]
pub struct CrushForm<'a, N = f64> {
    /// As given.
    pub crush: &'a Crush<N>,
    /// (–) the factor on the stiffness, if that is of many cars.
    pub factor: Option<N>,
}

/// The spacing of the stations of a crush.
#[derive(Clone, Copy, Debug)]
pub enum WidthsForm<'a, N = f64> {
    /// (m) equal zones over this width.
    Equal(&'a Quantity<N>),
    /// (m) the width of each zone.
    Each(&'a [Quantity<N>]),
}

impl<N: Copy + From<f64>> Case<N> {
    /// The inputs of the impact if the speeds of the `sought` vehicles are unknown; `None` if the case lacks
    /// one.
    #[must_use]
    pub fn impact_form(&self, sought: [bool; 2]) -> Option<ImpactForm<'_, N>> {
        // Without `..`, as in the functions below: with a new key this does not compile until somebody
        // decides whether the impact depends on it.
        let Self {
            title: _,
            locked_together: _,
            source: _,
            report: _,
            axes,
            // Only the motion after the impact depends on these.
            scene_contact: _,
            site_plan: _,
            surface: _,
            vehicles: _,
            impact,
            reconstruct,
            // Only estimates use it.
            estimate: _,
            // What happened before the impact.
            avoid: _,
            ranges: _,
            // Shared errors are already in the numbers.
            uncertainty: _,
            departures: _,
            left_out: _,
        } = self;
        let GivenImpact { crush_plane, law } = impact.as_ref()?;
        let mut vehicles = VehicleId::ALL.map(|id| self.vehicle_form(id));
        for (vehicle, is_sought) in vehicles.iter_mut().zip(sought) {
            if is_sought {
                vehicle.velocity = None;
            }
            let is_complete = vehicle.mass.is_some()
                && vehicle.yaw.is_some()
                && vehicle.heading.is_some()
                && vehicle.contact.is_some()
                && (is_sought || vehicle.velocity.is_some());
            if !vehicle.fixed && !is_complete {
                return None;
            }
        }
        let basis = reconstruct.as_ref().map_or(Basis::Dissipated, |reconstruct| reconstruct.energy_basis);
        Some(ImpactForm { axes: *axes, vehicles, crush_plane: *crush_plane, law, basis })
    }

    /// The inputs of a vehicle, as far as the case gives them.
    #[must_use]
    pub fn vehicle_form(&self, id: VehicleId) -> VehicleForm<'_, N> {
        let given = &self.vehicles[id.index()];
        let GivenVehicle {
            name: _,
            kind: _,
            fixed,
            mass,
            yaw: _,
            class: _,
            wheelbase: _,
            // Estimates, drawings, warnings and the motion before and after the impact use these.
            model_year: _,
            track: _,
            cg_to_front_axle: _,
            length: _,
            diameter: _,
            deformation_energy,
            position: _,
            before: _,
            after: _,
            outline: _,
            heading,
            // The direction of travel follows from this.
            sideslip: _,
            contact: _,
            motion,
            yaw_rate,
            crush,
            energy,
            // Comparison and estimates use these.
            recorder: _,
            certain_speed: _,
        } = given;
        let factor = self.departures.stiffness[id.index()];
        let contact = given.contact_form(self.departures.contact[id.index()]);
        let form = VehicleForm {
            given,
            fixed: *fixed,
            mass: *mass,
            yaw: given.yaw_form(self.departures.yaw_radius[id.index()].unwrap_or(N::from(1.0))),
            body: given.body(),
            contact,
            heading: *heading,
            course: self.course_form(id),
            velocity: *motion,
            yaw_rate: *yaw_rate,
            damage: match (crush, energy) {
                (Some(crush), _) if crush.from_force_balance => {
                    DamageForm::Inferred(CrushForm { crush, factor })
                }
                (Some(crush), _) => DamageForm::Measured(CrushForm { crush, factor }),
                // The energy depends neither on the side nor on how the force acts.
                (None, Some(KnownEnergy::Ees(GivenEes { ees, side: _, pdof: _, moment_arm: _ }))) => {
                    DamageForm::Ees(*ees)
                }
                (None, Some(KnownEnergy::Undamaged)) => DamageForm::Undamaged,
                (None, None) => DamageForm::Unknown,
            },
        };
        if !*fixed {
            return form;
        }
        VehicleForm {
            mass: None,
            yaw: None,
            // Without a point there is nothing to orient.
            heading: heading.filter(|_| contact.is_some()),
            course: None,
            velocity: None,
            yaw_rate: None,
            damage: deformation_energy.map_or(DamageForm::Undamaged, DamageForm::OfObject),
            ..form
        }
    }
}

impl<N: Copy> Case<N> {
    /// The direction of travel of a vehicle; `None` if it is the heading.
    pub(crate) fn course_form(&self, id: VehicleId) -> Option<CourseForm<N>> {
        let given = &self.vehicles[id.index()];
        if let Some(sideslip) = given.sideslip {
            return Some(CourseForm::Sideslip(sideslip));
        }
        match given.motion {
            // Momentum takes the direction of the known speed, too.
            Some(Velocity::Vector { x, y })
                if self.is_by_momentum() || self.reconstruct.is_some_and(|sought| sought.find.seeks(id)) =>
            {
                Some(CourseForm::Along { x, y })
            }
            _ => None,
        }
    }
}

impl<N: Copy> GivenVehicle<N> {
    /// The source of its yaw inertia: a given value takes precedence over the class, and the class over
    /// Burg's formula, which is for cars. `None` if there is none.
    pub(crate) fn yaw_form(&self, factor: N) -> Option<YawForm<N>> {
        if let Some(yaw) = self.yaw {
            return Some(YawForm::Given(yaw));
        }
        if let Some((class, known)) =
            self.class.and_then(|class| Some((class, VehicleClass::new(class).ok()?)))
        {
            return Some(YawForm::Class { class, radius: known.yaw_radius, factor });
        }
        let length = self.outline.map(|outline| outline.length).or(self.length);
        let is_car = self.kind.unwrap_or_default() == VehicleKind::Car;
        let lengths = self.wheelbase.zip(length).filter(|_| is_car);
        lengths.map(|(wheelbase, length)| YawForm::Burg { wheelbase, length, factor })
    }
}

impl<N: Copy + From<f64>> GivenVehicle<N> {
    /// The body seen from above: as given, or that of the size class.
    pub(crate) fn body(&self) -> Option<Outline<N>> {
        let of_class = |class| VehicleClass::new(class).ok().map(|known| Outline::of_class(&known));
        self.outline.or_else(|| self.class.and_then(of_class))
    }

    fn contact_form(&self, moved: [Option<Quantity<N>>; 2]) -> Option<ContactForm<N>> {
        if !self.places_contact() {
            return self.contact.map(ContactForm::Given);
        }
        let crush = self.crush.as_ref()?;
        let (side, offset) = (crush.side, crush.offset?);
        Some(ContactForm::Placed(PlacedContact { side, body: self.body()?, offset, moved }))
    }
}

impl<N: Copy> YawForm<N> {
    /// The source without its numbers.
    #[must_use]
    pub fn source(&self) -> YawSource {
        match self {
            Self::Given(_) => YawSource::Given,
            Self::Class { class, .. } => YawSource::Class(*class),
            Self::Burg { .. } => YawSource::Burg,
        }
    }

    /// The same with other numbers.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(N) -> U) -> YawForm<U> {
        match *self {
            Self::Given(yaw) => YawForm::Given(yaw.map(number)),
            Self::Class { class, radius, factor } => YawForm::Class { class, radius, factor: number(factor) },
            Self::Burg { wheelbase, length, factor } => YawForm::Burg {
                wheelbase: wheelbase.map(&mut number),
                length: length.map(&mut number),
                factor: number(factor),
            },
        }
    }
}

impl<T: Real> YawForm<T> {
    /// (kg·m²) the yaw inertia of a vehicle of the given mass (kg).
    ///
    /// # Errors
    /// If Burg's formula cannot take the mass, the wheelbase or the length.
    #[inline(always)]
    pub fn kg_m2(&self, mass: T) -> Result<T, CrushError> {
        match *self {
            Self::Given(yaw) => Ok(yaw.kg_m2(mass)),
            Self::Class { class: _, radius, factor } => {
                let yaw_radius = factor * radius;
                // I = m k²
                Ok(mass * yaw_radius * yaw_radius)
            }
            // I = m k²
            Self::Burg { wheelbase, length, factor } => {
                yaw_inertia_burg(mass, wheelbase.si(), length.si()).map(|estimate| estimate * factor * factor)
            }
        }
    }
}

impl<N: Copy> CourseForm<N> {
    /// The same with other numbers.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(N) -> U) -> CourseForm<U> {
        match self {
            Self::Sideslip(sideslip) => CourseForm::Sideslip(sideslip.map(number)),
            Self::Along { x, y } => CourseForm::Along { x: x.map(&mut number), y: y.map(number) },
        }
    }
}

impl<T: Real> CourseForm<T> {
    /// (rad) the direction of a vehicle with this heading (rad), both in the axes of the engine; `None` if
    /// the velocity is zero.
    #[must_use]
    pub fn rad(&self, axes: Axes, heading: T) -> Option<T> {
        match self {
            // ψ = θ + β
            Self::Sideslip(sideslip) => Some(heading + axes.lateral(sideslip.si())),
            Self::Along { x, y } => {
                let (x, y) = (x.si(), axes.lateral(y.si()));
                let (sin, cos) = heading.sin_cos();
                // v·ê and ê × v
                let (along, across) = (x * cos + y * sin, y * cos - x * sin);
                if along.value() == 0.0 && across.value() == 0.0 {
                    return None;
                }
                let (along, across) = if along < T::ZERO { (-along, -across) } else { (along, across) };
                Some(heading + across.atan2(along))
            }
        }
    }
}

impl<N: Copy> ContactForm<N> {
    /// The same with other numbers.
    #[must_use]
    pub fn map<U>(&self, number: impl FnMut(N) -> U) -> ContactForm<U> {
        match self {
            Self::Given(contact) => ContactForm::Given(contact.map(number)),
            Self::Placed(placed) => ContactForm::Placed(placed.map(number)),
        }
    }
}

impl<N: Copy> PlacedContact<N> {
    /// The same with other numbers.
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(N) -> U) -> PlacedContact<U> {
        PlacedContact {
            side: self.side,
            body: self.body.map(&mut number),
            offset: self.offset.map(&mut number),
            moved: self.moved.map(|moved| moved.map(|moved| moved.map(&mut number))),
        }
    }
}

impl<T: Real> PlacedContact<T> {
    /// (m) the point, forward and left of the CG: the centroid of the damage after the whole damage was moved
    /// along the face and inward.
    ///
    /// # Errors
    /// If the face then lies behind the CG, or a number is not finite.
    pub fn point(&self, axes: Axes, moments: &EnergyMoments<T>) -> Result<[T; 2], CrushError> {
        let [along, inward] = self.moved.map(|moved| moved.map_or(T::ZERO, |moved| moved.si()));
        let [offset, along] = [self.offset.si(), along].map(|distance| axes.along_face(self.side, distance));
        let distance = self.body.dimensions().face(self.side) - inward;
        let face = DamagedFace::new(self.side, distance, offset + along)?;
        Ok(face.centroid_of(moments))
    }
}

impl<'a, N: Copy> CrushForm<'a, N> {
    /// The spacing of its stations. If each zone has its own width, the whole width is only for drawings.
    /// `None` if the case gives neither.
    #[must_use]
    pub fn widths(&self) -> Option<WidthsForm<'a, N>> {
        match (&self.crush.spacing, &self.crush.width) {
            (Some(spacing), _) => Some(WidthsForm::Each(spacing)),
            (None, Some(width)) => Some(WidthsForm::Equal(width)),
            (None, None) => None,
        }
    }

    /// The depths at both ends of each zone, in order.
    pub fn zones(self) -> impl Iterator<Item = [Quantity<N>; 2]> {
        let depths = &self.crush.depths;
        depths.iter().zip(depths.iter().skip(1)).map(|(one, other)| [*one, *other])
    }
}

impl<T: Real> CrushForm<'_, T> {
    /// The depths along the side; `None` if the spacing of the stations is unknown.
    ///
    /// # Errors
    /// If they are no valid profile.
    pub fn profile(&self) -> Option<Result<Profile<T>, CrushError>> {
        let depths = self.crush.depths.iter().map(Quantity::si).collect();
        Some(match self.widths()? {
            WidthsForm::Each(widths) => Profile::new(depths, widths.iter().map(Quantity::si).collect()),
            WidthsForm::Equal(width) => Profile::equally_spaced(depths, width.si()),
        })
    }

    /// The stiffness of the side.
    ///
    /// # Errors
    /// If the coefficients, the category or the test are impossible.
    pub fn structure(&self) -> Result<SideStiffness<T>, CrushError> {
        let Crush { stiffness, side, .. } = self.crush;
        match stiffness {
            StiffnessForm::Typical(typical) => {
                typical.of_car(typical.stiffness(*side)?, self.factor).map(SideStiffness::Uniform)
            }
            form => form.structure(*side),
        }
    }
}

impl<N: Copy> ImpactForm<'_, N> {
    /// Every number that the impact depends on, and those of its vehicles that certainly change nothing.
    #[must_use]
    pub fn numbers(&self) -> Vec<N> {
        let Self { axes: _, vehicles, crush_plane, law, basis } = self;
        let mut numbers = vec![crush_plane.number()];
        let mut read = |number| numbers.push(number);
        drop(law.map(&mut read));
        if let Basis::TangentialShare(share) = basis {
            read(*share);
        }
        for vehicle in vehicles {
            vehicle.read(&mut read);
        }
        numbers
    }
}

impl<N: Copy> VehicleForm<'_, N> {
    fn read(&self, read: &mut impl FnMut(N)) {
        let Self { given, fixed, mass, yaw, body: _, contact, heading, course, velocity, yaw_rate, damage } =
            self;
        let _ = mass.map(|mass| mass.map(&mut *read));
        let _ = yaw.map(|yaw| yaw.map(&mut *read));
        let _ = contact.map(|contact| contact.map(&mut *read));
        let _ = heading.map(|heading| heading.map(&mut *read));
        let _ = course.map(|course| course.map(&mut *read));
        let _ = velocity.map(|velocity| velocity.map(&mut *read));
        let _ = yaw_rate.map(|yaw_rate| yaw_rate.map(&mut *read));
        match damage {
            DamageForm::Unknown | DamageForm::Undamaged => {}
            DamageForm::OfObject(energy) => read(energy.number()),
            DamageForm::Ees(ees) => read(ees.number()),
            DamageForm::Measured(crush) | DamageForm::Inferred(crush) => crush.read(read),
        }
        // The outline only affects whether the damaged side lies behind the CG, which is refused; a diameter
        // is for drawings.
        for quantity in given.outline.iter().flat_map(Outline::quantities).chain(&given.diameter) {
            read(quantity.number());
        }
        if *fixed {
            return;
        }
        // The direction of the force changes nothing.
        let ees = given.energy.as_ref().and_then(KnownEnergy::ees);
        let of_ees = ees.map_or([None; 2], |ees| [ees.moment_arm, ees.pdof.and_then(Pdof::angle)]);
        for quantity in of_ees.into_iter().flatten() {
            read(quantity.number());
        }
    }
}

impl<N: Copy> CrushForm<'_, N> {
    fn read(&self, read: &mut impl FnMut(N)) {
        let Crush {
            side: _,
            from_force_balance: _,
            width: _,
            depths,
            spacing: _,
            stiffness,
            // CRASH3's own answer and a placed contact point use these.
            offset,
            pdof,
            oblique_angle,
            moment_arm,
            oblique,
        } = self.crush;
        let widths = match self.widths() {
            None => &[],
            Some(WidthsForm::Equal(width)) => slice::from_ref(width),
            Some(WidthsForm::Each(widths)) => widths,
        };
        let others = [*offset, *oblique_angle, *moment_arm, pdof.and_then(Pdof::angle)];
        for quantity in widths.iter().chain(depths).chain(others.iter().flatten()) {
            read(quantity.number());
        }
        if let Some(ObliqueCorrection::Friction(friction)) = oblique {
            read(*friction);
        }
        drop(stiffness.map(&mut *read));
        if let Some(factor) = self.factor {
            read(factor);
        }
    }
}
