//! What is known of a collision, in the units in which it is given.

use std::f64::consts::PI;

use crash3::{CrushError, EnergyBasis, ObliqueCorrection, Profile, Side, Stiffness, Structure};
use pim_core::{Real, Tangential};
use reconcile::Unknown;

use crate::axes::Axes;
use crate::quantity::Quantity;
use crate::range::Range;
use crate::units::{STANDARD_GRAVITY, Unit, UnitSystem};
use crate::words::word;

/// A whole case: two vehicles, and what is known of the impact. The crate `case` reads it from a file and writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case<T = f64> {
    /// A line to put over the report.
    pub title: Option<String>,
    /// Where the data come from.
    pub source: Option<String>,
    /// `axes` of `[scene]`: those in which all numbers of this case stand.
    pub axes: Axes,
    /// `[vehicle1]` and `[vehicle2]`.
    pub vehicles: [Vehicle<T>; 2],
    /// `[impact]`.
    pub impact: Option<Impact<T>>,
    /// `[reconstruct]`.
    pub reconstruct: Option<Reconstruct>,
    /// Which of the numbers are not known exactly, in the order of [`inputs`](Case::inputs). The numbers themselves are the central
    /// values.
    pub ranges: Vec<Range>,
    /// Which words it leaves to their defaults.
    pub left_out: LeftOut,
}

/// Which words a case leaves to their defaults. Its values are then these defaults, so that no number depends on this: it is for
/// telling what is assumed. None is left out of a table that is not there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// `scene.axes`.
    pub axes: bool,
    /// `impact.law`.
    pub law: bool,
    /// `reconstruct.energy_basis`.
    pub energy_basis: bool,
    /// `crush.stiffness.test.fit` of each vehicle.
    pub fit: [bool; 2],
}

/// A vehicle or, with [`fixed`](Vehicle::fixed), a barrier. What a computation needs beyond what is given is
/// for that computation to demand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vehicle<T = f64> {
    /// Make and model.
    pub name: Option<String>,
    /// A barrier: it has neither mass nor motion nor crush.
    pub fixed: bool,
    /// `mass` or `weight`.
    pub mass: Option<Mass<T>>,
    /// `yaw_inertia` or `yaw_radius`.
    pub yaw: Option<YawInertia<T>>,
    /// CRASH3's size class, 1 to 6: stands in for yaw inertia and outline where they are not given.
    pub class: Option<u8>,
    /// (m) between the axles: with the length, for the yaw inertia where neither that nor a class is given.
    pub wheelbase: Option<Quantity<T>>,
    /// (m) of the body, where it is known without the rest of the outline.
    pub length: Option<Quantity<T>>,
    /// (rad) scene angle of the vehicle's forward axis, in the sense of the axes.
    pub heading: Option<Quantity<T>>,
    /// From the centre of gravity to the point where the impulse acts.
    pub contact: Option<ContactPoint<T>>,
    /// `speed` or `velocity`, before the impact.
    pub motion: Option<Velocity<T>>,
    /// (rad/s) yaw rate before the impact, in the sense of the axes; 0 where absent.
    pub yaw_rate: Option<Quantity<T>>,
    /// The body seen from above.
    pub outline: Option<Outline<T>>,
    /// `[vehicleN.crush]`.
    pub crush: Option<Crush<T>>,
}

/// How a vehicle's mass is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass<T = f64> {
    /// (kg) `mass`.
    Mass(Quantity<T>),
    /// (N) `weight`.
    Weight(Quantity<T>),
}

impl<T: Real> Mass<T> {
    /// (kg) the mass; a weight is divided by [`STANDARD_GRAVITY`].
    #[inline(always)]
    #[must_use]
    pub fn kg(&self) -> T {
        match self {
            Self::Mass(mass) => mass.si(),
            // m = W / g
            Self::Weight(weight) => weight.si() / STANDARD_GRAVITY,
        }
    }
}

/// How a vehicle's yaw moment of inertia is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum YawInertia<T = f64> {
    /// (kg·m²) `yaw_inertia`.
    Inertia(Quantity<T>),
    /// (m) `yaw_radius`, the radius of gyration k: I = m k².
    Radius(Quantity<T>),
}

impl<T: Real> YawInertia<T> {
    /// (kg·m²) the inertia of a vehicle of the given mass (kg).
    #[inline(always)]
    #[must_use]
    pub fn kg_m2(&self, mass: T) -> T {
        match self {
            Self::Inertia(inertia) => inertia.si(),
            // I = m k²
            Self::Radius(radius) => mass * radius.si() * radius.si(),
        }
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
}

/// Velocity of the centre of gravity before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity<T = f64> {
    /// (m/s) along the heading; negative when reversing.
    Speed(Quantity<T>),
    /// In the scene.
    Vector {
        /// (m/s) along the scene's x.
        x: Quantity<T>,
        /// (m/s) along the scene's y.
        y: Quantity<T>,
    },
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

/// The damage to one side of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crush<T = f64> {
    /// The damaged side.
    pub side: Side,
    /// The vehicle could not be inspected: its crush follows from the force that the other vehicle's crush shows. It has no depths then.
    pub from_force_balance: bool,
    /// (m) of the whole damage; absent where the spacing gives it, or where it is not known of an inferred crush.
    pub width: Option<Quantity<T>>,
    /// (m) at two stations or more: left to right on front and rear, rear to front on the sides. Empty where the crush is inferred.
    pub depths: Vec<Quantity<T>>,
    /// (m) between neighbouring stations, one fewer than depths; equal spacing where absent.
    pub spacing: Option<Vec<Quantity<T>>>,
    /// The stiffness of that side.
    pub stiffness: StiffnessForm<T>,
    /// (m) of the middle of the damage: along the vehicle's y from its axis on front and rear, forward of the CG on the sides.
    pub offset: Option<Quantity<T>>,
    /// Principal direction of force, clockwise from the heading in any axes: replaces the derived one.
    pub pdof: Option<Pdof<T>>,
    /// (rad) between the force and the normal of the damaged side: replaces the derived one.
    pub oblique_angle: Option<Quantity<T>>,
    /// (m) from the centre of gravity to the line of action: replaces the derived one.
    pub moment_arm: Option<Quantity<T>>,
    /// How the energy is corrected for an oblique force; absent means [`ObliqueCorrection::Capped`].
    pub oblique: Option<ObliqueCorrection<T>>,
}

/// How a principal direction of force is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pdof<T = f64> {
    /// (rad) clockwise from the heading.
    Angle(Quantity<T>),
    /// The hour of a clock, 1 to 12, on which the vehicle points to 12.
    Clock(u8),
}

impl<T: Real> Pdof<T> {
    /// (rad) clockwise from the heading.
    #[must_use]
    pub fn rad(&self) -> T {
        match self {
            Self::Angle(angle) => angle.si(),
            // 30° an hour
            Self::Clock(hour) => T::from(f64::from(*hour) * PI / 6.0),
        }
    }
}

/// How the stiffness of a damaged side is given.
#[derive(Clone, Debug, PartialEq)]
pub enum StiffnessForm<T = f64> {
    /// Its coefficients.
    Line(StiffnessLine<T>),
    /// Key `category`: that of CRASH3's table for the damaged side, 1 to 5.
    Category(u8),
    /// Key `test`: fitted to a barrier test.
    Test(BarrierTest<T>),
    /// Key `zones`: coefficients of their own for each interval between two stations.
    Zones(Vec<StiffnessLine<T>>),
}

/// Force per width as a straight line over crush; both forms are the same line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StiffnessLine<T = f64> {
    /// Keys `A`, `B`, `G`, `limit`.
    Crush {
        /// (N/m) force per width at which crush begins.
        a: Quantity<T>,
        /// (N/m²) force per width and depth.
        b: Quantity<T>,
        /// (N) energy per width without crush; A²/2B where absent.
        g: Option<Quantity<T>>,
        /// (N/m) force per width beyond which the line is flat.
        limit: Option<Quantity<T>>,
    },
    /// Keys `d0`, `d1`, `G`, `limit`.
    Root {
        /// (√N) A/√B.
        d0: Quantity<T>,
        /// (√N/m) √B.
        d1: Quantity<T>,
        /// (N) energy per width without crush; d₀²/2 where absent.
        g: Option<Quantity<T>>,
        /// (N/m) force per width beyond which the line is flat.
        limit: Option<Quantity<T>>,
    },
}

/// A full-width barrier test to which the stiffness is fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct BarrierTest<T = f64> {
    /// `mass` or `weight` of the tested car.
    pub mass: Mass<T>,
    /// (m/s) against the barrier.
    pub speed: Quantity<T>,
    /// (m) of the damage.
    pub width: Quantity<T>,
    /// (m) residual crush at equally spaced stations.
    pub depths: Vec<Quantity<T>>,
    /// (m/s) at which no crush would have remained.
    pub no_damage_speed: Quantity<T>,
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

impl Fit {
    /// Each under its word.
    pub const WORDS: [(&str, Self); 2] = [("exact", Self::Exact), ("mean", Self::Mean)];
}

impl<T: Real> StiffnessForm<T> {
    /// The stiffness of the damaged side, in SI units.
    ///
    /// # Errors
    /// What no structure, no table and no test can have.
    pub fn structure(&self, side: Side) -> Result<Structure<T>, CrushError> {
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

impl<T: Real> StiffnessLine<T> {
    /// The stiffness, in SI units.
    ///
    /// # Errors
    /// What no structure can have.
    #[inline(always)]
    pub fn stiffness(&self) -> Result<Stiffness<T>, CrushError> {
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
}

impl<T: Real> BarrierTest<T> {
    /// The stiffness that is fitted to the test, in SI units.
    ///
    /// # Errors
    /// What no test can have.
    pub fn stiffness(&self) -> Result<Stiffness<T>, CrushError> {
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
pub struct Impact<T = f64> {
    /// (rad) Γ, scene angle of the normal of the crush plane.
    pub crush_plane: Quantity<T>,
    /// `law` and its keys.
    pub law: ImpactLaw<T>,
}

/// The impact law that `law` names; [`pim_core::Law`] has their conditions and what each assumes.
#[derive(Clone, Debug, PartialEq)]
pub enum ImpactLaw<T = f64> {
    /// `law = "brach"`, or no `law`.
    Brach {
        /// Normal to the crush plane.
        restitution: Restitution<T>,
        /// Along the crush plane.
        tangential: BrachTangential<T>,
        /// (–) moment coefficient of restitution, −1 to 1; −1 (no moment impulse) where absent.
        moment_restitution: Option<T>,
    },
    /// `law = "woolley"`.
    Woolley {
        /// (m/s) U_t − u_t of a sideswipe; where absent, a common velocity at C.
        tangential_velocity_change: Option<Quantity<T>>,
    },
    /// `law = "ishikawa"`.
    Ishikawa {
        /// Normal to the crush plane.
        restitution: Restitution<T>,
        /// (–) coefficient of restitution along the crush plane, −1 to 1.
        tangential_restitution: T,
    },
    /// `law = "kudlich-slibar"`.
    KudlichSlibar {
        /// In both directions while friction suffices.
        restitution: Restitution<T>,
        /// (–) largest coefficient of friction, zero or more.
        friction: T,
    },
}

/// An impact law without its coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LawName {
    /// Brach's, which holds where none is named.
    #[default]
    Brach,
    /// Woolley's.
    Woolley,
    /// Ishikawa's.
    Ishikawa,
    /// Kudlich's and Slibar's.
    KudlichSlibar,
}

impl LawName {
    /// Each under its word.
    pub const WORDS: [(&str, Self); 4] = [
        ("brach", Self::Brach),
        ("woolley", Self::Woolley),
        ("ishikawa", Self::Ishikawa),
        ("kudlich-slibar", Self::KudlichSlibar),
    ];

    /// Its word.
    #[must_use]
    pub fn name(self) -> &'static str {
        word(&Self::WORDS, &self)
    }
}

/// What happens along the crush plane under Brach's law; the other laws have conditions of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BrachTangential<T = f64> {
    /// Sliding ends by separation: the critical impulse ratio.
    Critical,
    /// (–) the impulse ratio μ = P_t/P_n, with its sign.
    Ratio(T),
    /// (–) this share of the critical impulse ratio, 0 to 1.
    FractionOfCritical(T),
    /// (–) friction that ends the sliding, or limits the impulse where it cannot; zero or more.
    Friction(T),
}

impl BrachTangential {
    /// Those that have no number, each under its word.
    pub const WORDS: [(&str, Self); 1] = [("critical", Self::Critical)];
}

impl<T> From<BrachTangential<T>> for Tangential<T> {
    fn from(tangential: BrachTangential<T>) -> Self {
        match tangential {
            BrachTangential::Critical => Self::Critical,
            BrachTangential::Ratio(mu) => Self::Ratio(mu),
            BrachTangential::FractionOfCritical(share) => Self::FractionOfCritical(share),
            BrachTangential::Friction(mu) => Self::Friction(mu),
        }
    }
}

impl<T: Copy> ImpactLaw<T> {
    /// Which one it is.
    #[must_use]
    pub fn law(&self) -> LawName {
        match self {
            Self::Brach { .. } => LawName::Brach,
            Self::Woolley { .. } => LawName::Woolley,
            Self::Ishikawa { .. } => LawName::Ishikawa,
            Self::KudlichSlibar { .. } => LawName::KudlichSlibar,
        }
    }

    /// The value of `law`, such as `"brach"`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.law().name()
    }

    /// `restitution`; `None` under Woolley's law, which has no such key: there e = 0.
    #[must_use]
    pub fn restitution(&self) -> Option<&Restitution<T>> {
        match self {
            Self::Brach { restitution, .. }
            | Self::Ishikawa { restitution, .. }
            | Self::KudlichSlibar { restitution, .. } => Some(restitution),
            Self::Woolley { .. } => None,
        }
    }

    /// (–) the friction limit, under a law that has one.
    #[must_use]
    pub fn friction(&self) -> Option<T> {
        match self {
            Self::Brach { tangential: BrachTangential::Friction(friction), .. }
            | Self::KudlichSlibar { friction, .. } => Some(*friction),
            _ => None,
        }
    }
}

/// How a coefficient of restitution is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Restitution<T = f64> {
    /// (–) the same at every closing speed, 0 to 1.
    Constant(T),
    /// Keys `speeds`, `values`: linear between the points, constant outside of them.
    OfClosingSpeed {
        /// (m/s) closing speeds at C along the normal, ascending from zero or more; at least one.
        speeds: Vec<Quantity<T>>,
        /// (–) coefficients of restitution, 0 to 1, as many as speeds.
        values: Vec<T>,
    },
}

impl<T: Real> Restitution<T> {
    /// The points (closing speed in m/s, coefficient of restitution) of a curve, `None` for a constant.
    pub(crate) fn points(&self) -> Option<Vec<(T, T)>> {
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

impl<T: Real> Case<T> {
    /// (rad) of both vehicles, in the axes of the engine.
    #[must_use]
    pub fn headings(&self) -> [Option<T>; 2] {
        let heading = |vehicle: &Vehicle<T>| vehicle.heading.as_ref().map(Quantity::si);
        self.vehicles.each_ref().map(|vehicle| heading(vehicle).map(|heading| self.axes.lateral(heading)))
    }
}

impl Case {
    /// The custom in which most of the case's quantities are written; SI where they tie.
    #[must_use]
    pub fn unit_system(&self) -> UnitSystem {
        let (mut si, mut us) = (0_usize, 0_usize);
        self.map(|number| match number.unit.and_then(Unit::system) {
            Some(UnitSystem::Si) => si += 1,
            Some(UnitSystem::Us) => us += 1,
            None => {}
        });
        if us > si { UnitSystem::Us } else { UnitSystem::Si }
    }
}
