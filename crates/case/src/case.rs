//! What a case file says, in the units in which it says it.

use std::f64::consts::PI;

use crash3::{CrushError, EnergyBasis, ObliqueCorrection, Profile, Side, Stiffness, Structure};
use pim_core::{Real, Tangential};
use reconcile::Unknown;

use crate::quantity::Quantity;
use crate::schema::LawName;
use crate::units::{STANDARD_GRAVITY, UnitSystem};

/// A whole case: two vehicles, and what is known of the impact. [`Case::parse`](Case::parse) reads it,
/// [`Case::to_toml`](Case::to_toml) writes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// A line to put over the report.
    pub title: Option<String>,
    /// Where the data come from.
    pub source: Option<String>,
    /// `[vehicle1]` and `[vehicle2]`.
    pub vehicles: [Vehicle; 2],
    /// `[impact]`.
    pub impact: Option<Impact>,
    /// `[reconstruct]`.
    pub reconstruct: Option<Reconstruct>,
}

/// A vehicle or, with [`fixed`](Vehicle::fixed), a barrier. What a computation needs beyond what is given is
/// for that computation to demand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vehicle {
    /// Make and model.
    pub name: Option<String>,
    /// A barrier: it has neither mass nor motion nor crush.
    pub fixed: bool,
    /// `mass` or `weight`.
    pub mass: Option<Mass>,
    /// `yaw_inertia` or `yaw_radius`.
    pub yaw: Option<YawInertia>,
    /// CRASH3's size class, 1 to 6: stands in for yaw inertia and outline where they are not given.
    pub class: Option<u8>,
    /// (m) between the axles: with the length, for the yaw inertia where neither that nor a class is given.
    pub wheelbase: Option<Quantity>,
    /// (m) of the body, where it is known without the rest of the outline.
    pub length: Option<Quantity>,
    /// (rad) scene angle of the vehicle's forward axis, counter-clockwise.
    pub heading: Option<Quantity>,
    /// From the centre of gravity to the point where the impulse acts.
    pub contact: Option<ContactPoint>,
    /// `speed` or `velocity`, before the impact.
    pub motion: Option<Velocity>,
    /// (rad/s) yaw rate before the impact, counter-clockwise; 0 where absent.
    pub yaw_rate: Option<Quantity>,
    /// The body seen from above.
    pub outline: Option<Outline>,
    /// `[vehicleN.crush]`.
    pub crush: Option<Crush>,
}

/// How a vehicle's mass is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass {
    /// (kg) `mass`.
    Mass(Quantity),
    /// (N) `weight`.
    Weight(Quantity),
}

impl Mass {
    /// (kg) the mass; a weight is divided by [`STANDARD_GRAVITY`].
    #[must_use]
    pub fn kg(&self) -> f64 {
        match self {
            Self::Mass(mass) => mass.si(),
            // m = W / g
            Self::Weight(weight) => weight.si() / STANDARD_GRAVITY,
        }
    }
}

/// How a vehicle's yaw moment of inertia is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum YawInertia {
    /// (kg·m²) `yaw_inertia`.
    Inertia(Quantity),
    /// (m) `yaw_radius`, the radius of gyration k: I = m k².
    Radius(Quantity),
}

impl YawInertia {
    /// (kg·m²) the inertia of a vehicle of the given mass (kg).
    #[must_use]
    pub fn kg_m2(&self, mass: f64) -> f64 {
        match self {
            Self::Inertia(inertia) => inertia.si(),
            // I = m k²
            Self::Radius(radius) => mass * radius.si() * radius.si(),
        }
    }
}

/// Where the impulse acts, from the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPoint {
    /// Distance and direction.
    Polar {
        /// (m) distance.
        distance: Quantity,
        /// (rad) angle from the vehicle's heading, counter-clockwise.
        angle: Quantity,
    },
    /// Along the vehicle's own axes.
    Cartesian {
        /// (m) forward.
        x: Quantity,
        /// (m) left.
        y: Quantity,
    },
}

impl ContactPoint {
    /// (m) forward and left of the centre of gravity.
    #[must_use]
    pub fn forward_left(&self) -> [f64; 2] {
        match self {
            Self::Polar { distance, angle } => {
                let (sin, cos) = Real::sin_cos(angle.si());
                // (d cos φ, d sin φ)
                [distance.si() * cos, distance.si() * sin]
            }
            Self::Cartesian { x, y } => [x.si(), y.si()],
        }
    }
}

/// Velocity of the centre of gravity before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity {
    /// (m/s) along the heading; negative when reversing.
    Speed(Quantity),
    /// In the scene.
    Vector {
        /// (m/s) along the scene's x.
        x: Quantity,
        /// (m/s) along the scene's y.
        y: Quantity,
    },
}

/// The body seen from above: enough to draw it and to see whether the contact point lies on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// (m) of the body.
    pub length: Quantity,
    /// (m) of the body.
    pub width: Quantity,
    /// (m) from the centre of gravity forward to the front bumper.
    pub cg_to_front: Quantity,
}

/// The damage to one side of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crush {
    /// The damaged side.
    pub side: Side,
    /// The vehicle could not be inspected: its crush follows from the force that the other vehicle's crush shows. It has no depths then.
    pub from_force_balance: bool,
    /// (m) of the whole damage; absent where the spacing gives it, or where it is not known of an inferred crush.
    pub width: Option<Quantity>,
    /// (m) at two stations or more: left to right on front and rear, rear to front on the sides. Empty where the crush is inferred.
    pub depths: Vec<Quantity>,
    /// (m) between neighbouring stations, one fewer than depths; equal spacing where absent.
    pub spacing: Option<Vec<Quantity>>,
    /// The stiffness of that side.
    pub stiffness: StiffnessForm,
    /// (m) of the middle of the damage: left of the vehicle's axis on front and rear, forward of the CG on the sides.
    pub offset: Option<Quantity>,
    /// Principal direction of force, clockwise from the heading: replaces the derived one.
    pub pdof: Option<Pdof>,
    /// (rad) between the force and the normal of the damaged side: replaces the derived one.
    pub oblique_angle: Option<Quantity>,
    /// (m) from the centre of gravity to the line of action: replaces the derived one.
    pub moment_arm: Option<Quantity>,
    /// How the energy is corrected for an oblique force; absent means [`ObliqueCorrection::Capped`].
    pub oblique: Option<ObliqueCorrection>,
}

/// How a principal direction of force is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pdof {
    /// (rad) clockwise from the heading.
    Angle(Quantity),
    /// The hour of a clock, 1 to 12, on which the vehicle points to 12.
    Clock(u8),
}

impl Pdof {
    /// (rad) clockwise from the heading.
    #[must_use]
    pub fn rad(&self) -> f64 {
        match self {
            Self::Angle(angle) => angle.si(),
            // 30° an hour
            Self::Clock(hour) => f64::from(*hour) * PI / 6.0,
        }
    }
}

/// How the stiffness of a damaged side is given.
#[derive(Clone, Debug, PartialEq)]
pub enum StiffnessForm {
    /// Its coefficients.
    Line(StiffnessLine),
    /// Key `category`: that of CRASH3's table for the damaged side, 1 to 5.
    Category(u8),
    /// Key `test`: fitted to a barrier test.
    Test(BarrierTest),
    /// Key `zones`: coefficients of their own for each interval between two stations.
    Zones(Vec<StiffnessLine>),
}

/// Force per width as a straight line over crush; both forms are the same line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StiffnessLine {
    /// Keys `A`, `B`, `G`, `limit`.
    Crush {
        /// (N/m) force per width at which crush begins.
        a: Quantity,
        /// (N/m²) force per width and depth.
        b: Quantity,
        /// (N) energy per width without crush; A²/2B where absent.
        g: Option<Quantity>,
        /// (N/m) force per width beyond which the line is flat.
        limit: Option<Quantity>,
    },
    /// Keys `d0`, `d1`, `G`, `limit`.
    Root {
        /// (√N) A/√B.
        d0: Quantity,
        /// (√N/m) √B.
        d1: Quantity,
        /// (N) energy per width without crush; d₀²/2 where absent.
        g: Option<Quantity>,
        /// (N/m) force per width beyond which the line is flat.
        limit: Option<Quantity>,
    },
}

/// A full-width barrier test to which the stiffness is fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct BarrierTest {
    /// `mass` or `weight` of the tested car.
    pub mass: Mass,
    /// (m/s) against the barrier.
    pub speed: Quantity,
    /// (m) of the damage.
    pub width: Quantity,
    /// (m) residual crush at equally spaced stations.
    pub depths: Vec<Quantity>,
    /// (m/s) at which no crush would have remained.
    pub no_damage_speed: Quantity,
    /// How the line is put through the test.
    pub fit: Fit,
}

/// How a stiffness is fitted to a barrier test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// Gives the test's kinetic energy back.
    #[default]
    Exact,
    /// Through the mean crush: the common shortcut, which over-predicts.
    Mean,
}

impl StiffnessForm {
    /// The stiffness of the damaged side, in SI units.
    ///
    /// # Errors
    /// What no structure, no table and no test can have.
    pub fn structure(&self, side: Side) -> Result<Structure, CrushError> {
        match self {
            Self::Line(line) => line.stiffness().map(Structure::Uniform),
            Self::Category(category) => Stiffness::from_category(side, *category).map(Structure::Uniform),
            Self::Test(test) => test.stiffness().map(Structure::Uniform),
            Self::Zones(zones) => {
                zones.iter().map(StiffnessLine::stiffness).collect::<Result<_, _>>().map(Structure::Zones)
            }
        }
    }
}

impl StiffnessLine {
    pub(crate) fn stiffness(&self) -> Result<Stiffness, CrushError> {
        let (rising, limit) = match self {
            Self::Crush { a, b, g: None, limit } => (Stiffness::from_ab(a.si(), b.si())?, limit),
            Self::Crush { a, b, g: Some(g), limit } => (Stiffness::from_abg(a.si(), b.si(), g.si())?, limit),
            Self::Root { d0, d1, g: None, limit } => (Stiffness::from_d0_d1(d0.si(), d1.si())?, limit),
            Self::Root { d0, d1, g: Some(g), limit } => {
                (Stiffness::from_d0_d1_g(d0.si(), d1.si(), g.si())?, limit)
            }
        };
        limit.map_or(Ok(rising), |limit| rising.with_limit(limit.si()))
    }

    fn quantities(&self) -> impl Iterator<Item = Quantity> + use<> {
        let (Self::Crush { a: first, b: second, g, limit } | Self::Root { d0: first, d1: second, g, limit }) =
            *self;
        [Some(first), Some(second), g, limit].into_iter().flatten()
    }
}

impl BarrierTest {
    pub(crate) fn stiffness(&self) -> Result<Stiffness, CrushError> {
        let depths = self.depths.iter().map(Quantity::si).collect();
        let profile = Profile::equally_spaced(depths, self.width.si())?;
        let test =
            crash3::BarrierTest::new(self.mass.kg(), self.speed.si(), profile, self.no_damage_speed.si())?;
        match self.fit {
            Fit::Exact => test.fit(),
            Fit::Mean => test.fit_mean(),
        }
    }
}

/// How the two vehicles met.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// (rad) Γ, scene angle of the normal of the crush plane.
    pub crush_plane: Quantity,
    /// `law` and its keys.
    pub law: ImpactLaw,
}

/// The impact law that `law` names; [`pim_core::Law`] has their conditions and what each assumes.
#[derive(Clone, Debug, PartialEq)]
pub enum ImpactLaw {
    /// `law = "brach"`, or no `law`.
    Brach {
        /// Normal to the crush plane.
        restitution: Restitution,
        /// Along the crush plane: one of the first four conditions of [`Tangential`]. The others belong to other laws; no file can say
        /// them, and what [`Case::to_toml`] writes of them is refused when it is read.
        tangential: Tangential,
        /// (–) moment coefficient of restitution, −1 to 1; −1 (no moment impulse) where absent.
        moment_restitution: Option<f64>,
    },
    /// `law = "woolley"`.
    Woolley {
        /// (m/s) U_t − u_t of a sideswipe; where absent, a common velocity at C.
        tangential_velocity_change: Option<Quantity>,
    },
    /// `law = "ishikawa"`.
    Ishikawa {
        /// Normal to the crush plane.
        restitution: Restitution,
        /// (–) coefficient of restitution along the crush plane, −1 to 1.
        tangential_restitution: f64,
    },
    /// `law = "kudlich-slibar"`.
    KudlichSlibar {
        /// In both directions while friction suffices.
        restitution: Restitution,
        /// (–) largest coefficient of friction, zero or more.
        friction: f64,
    },
}

impl ImpactLaw {
    /// The value of `law`, such as `"brach"`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let name = match self {
            Self::Brach { .. } => LawName::Brach,
            Self::Woolley { .. } => LawName::Woolley,
            Self::Ishikawa { .. } => LawName::Ishikawa,
            Self::KudlichSlibar { .. } => LawName::KudlichSlibar,
        };
        name.name()
    }

    /// `restitution`; `None` under Woolley's law, which has no such key: there e = 0.
    #[must_use]
    pub fn restitution(&self) -> Option<&Restitution> {
        match self {
            Self::Brach { restitution, .. }
            | Self::Ishikawa { restitution, .. }
            | Self::KudlichSlibar { restitution, .. } => Some(restitution),
            Self::Woolley { .. } => None,
        }
    }

    /// (–) the friction limit, under a law that has one.
    #[must_use]
    pub fn friction(&self) -> Option<f64> {
        match self {
            Self::Brach { tangential: Tangential::Friction(friction), .. }
            | Self::KudlichSlibar { friction, .. } => Some(*friction),
            _ => None,
        }
    }
}

/// How a coefficient of restitution is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Restitution {
    /// (–) the same at every closing speed, 0 to 1.
    Constant(f64),
    /// Keys `speeds`, `values`: linear between the points, constant outside of them.
    OfClosingSpeed {
        /// (m/s) closing speeds at C along the normal, ascending from zero or more; at least one.
        speeds: Vec<Quantity>,
        /// (–) coefficients of restitution, 0 to 1, as many as speeds.
        values: Vec<f64>,
    },
}

impl Restitution {
    /// The points (closing speed in m/s, coefficient of restitution) of a curve, `None` for a constant.
    pub(crate) fn points(&self) -> Option<Vec<(f64, f64)>> {
        match self {
            Self::Constant(_) => None,
            Self::OfClosingSpeed { speeds, values } => {
                Some(speeds.iter().map(Quantity::si).zip(values.iter().copied()).collect())
            }
        }
    }
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reconstruct {
    /// The unknown.
    pub find: Unknown,
    /// The energy that the crush energy is compared with.
    pub energy_basis: EnergyBasis,
}

impl Case {
    /// The custom in which most of the case's quantities are written; SI where they tie.
    #[must_use]
    pub fn unit_system(&self) -> UnitSystem {
        let (mut si, mut us) = (0_usize, 0_usize);
        for quantity in self.quantities() {
            match quantity.unit().system() {
                Some(UnitSystem::Si) => si += 1,
                Some(UnitSystem::Us) => us += 1,
                None => {}
            }
        }
        if us > si { UnitSystem::Us } else { UnitSystem::Si }
    }

    fn quantities(&self) -> Vec<Quantity> {
        let mut all: Vec<Quantity> = self.vehicles.iter().flat_map(Vehicle::quantities).collect();
        all.extend(self.impact.iter().flat_map(Impact::quantities));
        all
    }
}

impl Impact {
    fn quantities(&self) -> Vec<Quantity> {
        let mut all = vec![self.crush_plane];
        if let ImpactLaw::Woolley { tangential_velocity_change } = self.law {
            all.extend(tangential_velocity_change);
        }
        if let Some(Restitution::OfClosingSpeed { speeds, .. }) = self.law.restitution() {
            all.extend(speeds);
        }
        all
    }
}

impl Vehicle {
    fn quantities(&self) -> Vec<Quantity> {
        let mut all = Vec::new();
        all.extend(self.mass.map(|(Mass::Mass(q) | Mass::Weight(q))| q));
        all.extend(self.yaw.map(|(YawInertia::Inertia(q) | YawInertia::Radius(q))| q));
        all.extend([self.wheelbase, self.length, self.heading, self.yaw_rate].into_iter().flatten());
        match self.contact {
            Some(
                ContactPoint::Polar { distance: first, angle: second }
                | ContactPoint::Cartesian { x: first, y: second },
            ) => {
                all.extend([first, second]);
            }
            None => {}
        }
        match self.motion {
            Some(Velocity::Speed(speed)) => all.push(speed),
            Some(Velocity::Vector { x, y }) => all.extend([x, y]),
            None => {}
        }
        if let Some(Outline { length, width, cg_to_front }) = self.outline {
            all.extend([length, width, cg_to_front]);
        }
        if let Some(crush) = &self.crush {
            all.extend(crush.quantities());
        }
        all
    }
}

impl Crush {
    fn quantities(&self) -> Vec<Quantity> {
        let mut all = self.depths.clone();
        all.extend(self.spacing.iter().flatten());
        match &self.stiffness {
            StiffnessForm::Line(line) => all.extend(line.quantities()),
            StiffnessForm::Zones(zones) => all.extend(zones.iter().flat_map(StiffnessLine::quantities)),
            StiffnessForm::Category(_) => {}
            StiffnessForm::Test(test) => {
                let (Mass::Mass(mass) | Mass::Weight(mass)) = test.mass;
                all.extend([mass, test.speed, test.width, test.no_damage_speed]);
                all.extend(&test.depths);
            }
        }
        let pdof = match self.pdof {
            Some(Pdof::Angle(angle)) => Some(angle),
            Some(Pdof::Clock(_)) | None => None,
        };
        let optional = [self.width, self.offset, pdof, self.oblique_angle, self.moment_arm];
        all.extend(optional.into_iter().flatten());
        all
    }
}
