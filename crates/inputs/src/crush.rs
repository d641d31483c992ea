//! The damage of a vehicle: the content of its table `crush`.

use std::f64::consts::PI;
use std::fmt::Display;

use crash3::{CrushError, ObliqueCorrection, Profile, Side, SideStiffness, Stiffness};
use pim_core::Real;

use crate::choices;
use crate::estimate::TypicalStiffness;
use crate::inertia::Mass;
use crate::quantity::Quantity;
use crate::text::Text;
use crate::walk::{Key, Walk};
use crate::words::{FLEET_STIFFNESS, OBLIQUE_CORRECTIONS, SIDES, UNDAMAGED};

/// The damage to one side of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crush<T = f64> {
    /// The damaged side.
    pub side: Side,
    /// The vehicle could not be inspected, so its crush is inferred from the force on the other vehicle. It
    /// then has no depths.
    pub from_force_balance: bool,
    /// (m) width of the whole damage; absent if the spacing gives it, or if it is unknown for an inferred
    /// crush.
    pub width: Option<Quantity<T>>,
    /// (m) depths at two or more stations: left to right on front and rear, rear to front on the sides. Empty
    /// if the crush is inferred.
    pub depths: Vec<Quantity<T>>,
    /// (m) widths between neighbouring stations, one fewer than there are depths; equal if absent.
    pub spacing: Option<Vec<Quantity<T>>>,
    /// The stiffness of that side.
    pub stiffness: StiffnessForm<T>,
    /// (m) offset of the middle of the damage: along the vehicle's y from its axis on front and rear, forward
    /// of the CG on the sides.
    pub offset: Option<Quantity<T>>,
    /// Principal direction of force, clockwise from the heading in any axes: replaces the derived one.
    pub pdof: Option<Pdof<T>>,
    /// (rad) angle between the force and the normal of the damaged side; replaces the derived one.
    pub oblique_angle: Option<Quantity<T>>,
    /// (m) distance from the centre of gravity to the line of action; replaces the derived one.
    pub moment_arm: Option<Quantity<T>>,
    /// How the energy is corrected for an oblique force; absent means [`ObliqueCorrection::Capped`].
    pub oblique: Option<ObliqueCorrection<T>>,
}

impl<T: Real> Crush<T> {
    /// Whether it was measured, and all its depths are zero.
    #[must_use]
    pub fn has_no_residual(&self) -> bool {
        !self.depths.is_empty() && self.depths.iter().all(|depth| depth.si().value() == 0.0)
    }
}

/// A damage whose energy is known, but not its crush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KnownEnergy<T = f64> {
    /// `ees` in the table `crush`.
    Ees(GivenEes<T>),
    /// `crush = "none"`: no damage, or none whose energy counts.
    Undamaged,
}

/// `ees` and the keys that accompany it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenEes<T = f64> {
    /// (m/s) energy equivalent speed: ½ m EES² is the energy of all plastic deformation.
    pub ees: Quantity<T>,
    /// The damaged side.
    pub side: Option<Side>,
    /// Principal direction of force, clockwise from the heading in any axes.
    pub pdof: Option<Pdof<T>>,
    /// (m) distance from the centre of gravity to the line of action; replaces the derived one.
    pub moment_arm: Option<Quantity<T>>,
}

impl<T> KnownEnergy<T> {
    /// `ees` and the keys that accompany it; `None` without damage.
    #[must_use]
    pub fn ees(&self) -> Option<&GivenEes<T>> {
        match self {
            Self::Ees(given) => Some(given),
            Self::Undamaged => None,
        }
    }
}

/// How a principal direction of force is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pdof<T = f64> {
    /// (rad) clockwise from the heading.
    Angle(Quantity<T>),
    /// The clock hour, 1 to 12; 12 is straight ahead.
    Clock(u8),
}

impl<T> Pdof<T> {
    /// (rad) clockwise from the heading, where it is given as an angle.
    pub(crate) fn angle(self) -> Option<Quantity<T>> {
        match self {
            Self::Angle(angle) => Some(angle),
            Self::Clock(_) => None,
        }
    }
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
    /// Key `category`, or the word [`FLEET_STIFFNESS`]: that of many cars.
    Typical(TypicalStiffness),
    /// Key `test`: fitted to a barrier test.
    Test(GivenTest<T>),
    /// Key `zones`: separate coefficients for each interval between two stations.
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
pub struct GivenTest<T = f64> {
    /// `mass` or `weight` of the tested car.
    pub mass: Mass<T>,
    /// (m/s) its impact speed.
    pub speed: Quantity<T>,
    /// (m) width of the damage.
    pub width: Quantity<T>,
    /// (m) residual crush at equally spaced stations.
    pub depths: Vec<Quantity<T>>,
    /// (m/s) speed that would have left no crush.
    pub no_damage_speed: Quantity<T>,
    /// How the line is fitted to the test.
    pub fit: Fit,
}

choices! {
    /// How a stiffness is fitted to a barrier test.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Fit {
        /// Reproduces the kinetic energy of the test.
        #[default]
        Exact = "exact",
        /// Through the mean crush: the common shortcut, which over-predicts.
        Mean = "mean",
    }
}

impl<T> StiffnessForm<T> {
    /// That of many cars, if it is that.
    #[must_use]
    pub fn typical(&self) -> Option<TypicalStiffness> {
        if let Self::Typical(typical) = self { Some(*typical) } else { None }
    }
}

impl<T: Copy> StiffnessForm<T> {
    /// The same with other numbers; `number` is called once for each.
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> StiffnessForm<U> {
        match self {
            Self::Line(line) => StiffnessForm::Line(line.map(number)),
            Self::Typical(typical) => StiffnessForm::Typical(*typical),
            Self::Test(test) => StiffnessForm::Test(test.map(number)),
            Self::Zones(zones) => {
                StiffnessForm::Zones(zones.iter().map(|line| line.map(&mut number)).collect())
            }
        }
    }
}

impl<T: Copy> GivenTest<T> {
    /// The same with other numbers; `number` is called once for each.
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> GivenTest<U> {
        let Self { mass, speed, width, depths, no_damage_speed, fit } = self;
        GivenTest {
            mass: mass.map(&mut number),
            speed: speed.map(&mut number),
            width: width.map(&mut number),
            depths: depths.iter().map(|depth| depth.map(&mut number)).collect(),
            no_damage_speed: no_damage_speed.map(number),
            fit: *fit,
        }
    }
}

impl<T: Copy> StiffnessLine<T> {
    /// The same with other numbers; `number` is called once for each.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(&self, mut number: impl FnMut(T) -> U) -> StiffnessLine<U> {
        self.map_quantities(|_, quantity| quantity.map(&mut number))
    }

    /// The same with other quantities, which come with their keys.
    #[inline(always)]
    fn map_quantities<U>(
        self,
        mut of: impl FnMut(&'static str, Quantity<T>) -> Quantity<U>,
    ) -> StiffnessLine<U> {
        match self {
            Self::Crush { a, b, g, limit } => StiffnessLine::Crush {
                a: of("A", a),
                b: of("B", b),
                g: g.map(|g| of("G", g)),
                limit: limit.map(|limit| of("limit", limit)),
            },
            Self::Root { d0, d1, g, limit } => StiffnessLine::Root {
                d0: of("d0", d0),
                d1: of("d1", d1),
                g: g.map(|g| of("G", g)),
                limit: limit.map(|limit| of("limit", limit)),
            },
        }
    }

    /// (N/m) `limit`.
    #[must_use]
    pub fn limit(&self) -> Option<&Quantity<T>> {
        match self {
            Self::Crush { limit, .. } | Self::Root { limit, .. } => limit.as_ref(),
        }
    }
}

impl<T: Real> StiffnessForm<T> {
    /// The stiffness of the damaged side, in SI units.
    ///
    /// # Errors
    /// If the coefficients, the category or the test are impossible.
    pub fn structure(&self, side: Side) -> Result<SideStiffness<T>, CrushError> {
        match self {
            Self::Line(line) => line.stiffness().map(SideStiffness::Uniform),
            Self::Typical(typical) => typical.stiffness(side).map(SideStiffness::Uniform),
            Self::Test(test) => test.stiffness().map(SideStiffness::Uniform),
            Self::Zones(zones) => {
                zones.iter().map(StiffnessLine::stiffness).collect::<Result<_, _>>().map(SideStiffness::Zones)
            }
        }
    }
}

impl<T: Real> StiffnessLine<T> {
    /// The stiffness, in SI units.
    ///
    /// # Errors
    /// If the coefficients are impossible.
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
        limit.map_or(Ok(rising), |limit| rising.with_saturation_force(limit.si()))
    }
}

impl<T: Real> GivenTest<T> {
    /// The test, in SI units.
    ///
    /// # Errors
    /// If the numbers of the test are impossible.
    pub fn test(&self) -> Result<crash3::BarrierTest<T>, CrushError> {
        let depths = self.depths.iter().map(Quantity::si).collect();
        let profile = Profile::equally_spaced(depths, self.width.si())?;
        crash3::BarrierTest::new(self.mass.kg(), self.speed.si(), profile, self.no_damage_speed.si())
    }

    /// The stiffness that is fitted to the test, in SI units.
    ///
    /// # Errors
    /// If the numbers of the test are impossible.
    pub fn stiffness(&self) -> Result<Stiffness<T>, CrushError> {
        let test = self.test()?;
        match self.fit {
            Fit::Exact => test.fit(),
            Fit::Mean => test.fit_mean(),
        }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn known_energy(&mut self, table: &dyn Display, known: &KnownEnergy) -> KnownEnergy<U> {
        let at = |key| Key(table, key);
        match known {
            KnownEnergy::Undamaged => {
                self.text(table, Some(&Text::from(UNDAMAGED.to_owned())));
                KnownEnergy::Undamaged
            }
            KnownEnergy::Ees(given) => KnownEnergy::Ees(GivenEes {
                ees: self.quantity(&at("ees"), &given.ees),
                side: given.side.map(|side| self.choice(&at("side"), &SIDES, side)),
                pdof: given.pdof.as_ref().map(|pdof| self.pdof(&at("pdof"), pdof)),
                moment_arm: self.maybe(&at("moment_arm"), given.moment_arm.as_ref()),
            }),
        }
    }

    fn pdof(&mut self, path: &dyn Display, pdof: &Pdof) -> Pdof<U> {
        match pdof {
            Pdof::Angle(q) => Pdof::Angle(self.quantity(path, q)),
            Pdof::Clock(hour) => Pdof::Clock(self.hour(path, *hour)),
        }
    }

    pub(crate) fn crush(&mut self, table: &dyn Display, crush: &Crush, fit_left_out: bool) -> Crush<U> {
        let at = |key| Key(table, key);
        Crush {
            side: self.choice(&at("side"), &SIDES, crush.side),
            from_force_balance: self.flag(&at("from_force_balance"), crush.from_force_balance),
            width: self.maybe(&at("width"), crush.width.as_ref()),
            depths: self.list(&at("depths"), &crush.depths),
            spacing: crush.spacing.as_ref().map(|spacing| self.list(&at("spacing"), spacing)),
            stiffness: self.stiffness(&at("stiffness"), &crush.stiffness, fit_left_out),
            offset: self.maybe(&at("offset"), crush.offset.as_ref()),
            pdof: crush.pdof.as_ref().map(|pdof| self.pdof(&at("pdof"), pdof)),
            oblique_angle: self.maybe(&at("oblique_angle"), crush.oblique_angle.as_ref()),
            moment_arm: self.maybe(&at("moment_arm"), crush.moment_arm.as_ref()),
            oblique: crush.oblique.map(|oblique| {
                if !matches!(oblique, ObliqueCorrection::Friction(_)) {
                    self.choice(&at("oblique"), &OBLIQUE_CORRECTIONS, oblique);
                }
                match oblique {
                    ObliqueCorrection::Capped => ObliqueCorrection::Capped,
                    ObliqueCorrection::Uncapped => ObliqueCorrection::Uncapped,
                    ObliqueCorrection::None => ObliqueCorrection::None,
                    ObliqueCorrection::Friction(mu) => {
                        ObliqueCorrection::Friction(self.number(&at("oblique.friction"), mu))
                    }
                    ObliqueCorrection::Secant => ObliqueCorrection::Secant,
                }
            }),
        }
    }

    fn stiffness(
        &mut self,
        table: &dyn Display,
        stiffness: &StiffnessForm,
        fit_left_out: bool,
    ) -> StiffnessForm<U> {
        match stiffness {
            StiffnessForm::Line(line) => StiffnessForm::Line(self.line(table, line)),
            StiffnessForm::Typical(typical) => StiffnessForm::Typical(match *typical {
                TypicalStiffness::Category(category) => {
                    TypicalStiffness::Category(self.count(&Key(table, "category"), category))
                }
                TypicalStiffness::Fleet => {
                    self.text(table, Some(&Text::from(FLEET_STIFFNESS.to_owned())));
                    TypicalStiffness::Fleet
                }
            }),
            StiffnessForm::Test(test) => {
                let table = &Key(table, "test");
                let at = |key| Key(table, key);
                StiffnessForm::Test(GivenTest {
                    mass: self.mass(table, &test.mass),
                    speed: self.quantity(&at("speed"), &test.speed),
                    width: self.quantity(&at("width"), &test.width),
                    depths: self.list(&at("depths"), &test.depths),
                    no_damage_speed: self.quantity(&at("no_damage_speed"), &test.no_damage_speed),
                    fit: self.default(&at("fit"), &Fit::WORDS, test.fit, fit_left_out),
                })
            }
            StiffnessForm::Zones(zones) => {
                StiffnessForm::Zones(self.each(&Key(table, "zones"), zones, Self::line))
            }
        }
    }

    fn line(&mut self, table: &dyn Display, line: &StiffnessLine) -> StiffnessLine<U> {
        line.map_quantities(|key, quantity| self.quantity(&Key(table, key), &quantity))
    }
}
