//! The numbers of a case, each under its path: what derivatives are taken by and what may be uncertain.

use std::fmt::{self, Display};

use crash3::ObliqueCorrection;

use crate::case::{
    BarrierTest, BrachTangential, Case, ContactPoint, Crush, Impact, ImpactLaw, Mass, Outline, Pdof,
    Restitution, StiffnessForm, StiffnessLine, Vehicle, Velocity, YawInertia,
};
use crate::quantity::Quantity;
use crate::units::Unit;

/// One number of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Where it stands, such as `vehicle1.contact.angle`; the first of a list is `vehicle1.crush.depths[1]`, the C_1 of the equations.
    pub path: String,
    /// The number as written.
    pub number: f64,
    /// The unit as written; `None` of a coefficient that has none.
    pub unit: Option<&'static Unit>,
}

impl Input {
    /// The value in SI.
    #[must_use]
    pub fn si(&self) -> f64 {
        self.number * self.factor()
    }

    /// One of its unit in SI.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.unit.map_or(1.0, Unit::factor)
    }
}

impl Case {
    /// The same case with other numbers in the place of its own, which `replace` is given in the order of [`inputs`](Self::inputs).
    /// They are certain: no [`ranges`](Case::ranges) are taken over.
    pub fn map<U>(&self, mut replace: impl FnMut(Input) -> U) -> Case<U> {
        self.walk(&mut |path, number, unit| replace(Input { path: path.to_string(), number, unit }))
    }

    /// The same case with other numbers, given in the order of [`inputs`](Self::inputs) beside those that they replace. No path is
    /// made for any, so that this is quick.
    pub fn map_numbers<U>(&self, mut replace: impl FnMut(f64) -> U) -> Case<U> {
        self.walk(&mut |_, number, _| replace(number))
    }

    fn walk<U>(&self, replace: &mut Replace<'_, U>) -> Case<U> {
        let mut walk = Walk { replace };
        let [v1, v2] = &self.vehicles;
        Case {
            title: self.title.clone(),
            source: self.source.clone(),
            axes: self.axes,
            vehicles: [walk.vehicle(&"vehicle1", v1), walk.vehicle(&"vehicle2", v2)],
            impact: self.impact.as_ref().map(|impact| walk.impact(impact)),
            reconstruct: self.reconstruct,
            ranges: Vec::new(),
            left_out: self.left_out,
        }
    }

    /// Every number of the case.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        let mut inputs = Vec::new();
        self.map(|input| inputs.push(input));
        inputs
    }
}

/// Told the path, the number and its unit.
type Replace<'a, U> = dyn FnMut(&dyn Display, f64, Option<&'static Unit>) -> U + 'a;

struct Walk<'a, 'r, U> {
    replace: &'a mut Replace<'r, U>,
}

/// The path of a key in a table, spelled only when asked for.
struct Key<'a>(&'a dyn Display, &'a str);

impl Display for Key<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.0, self.1)
    }
}

/// The path of an element of a list, counted from 1.
struct Element<'a>(&'a dyn Display, usize);

impl Display for Element<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", self.0, self.1 + 1)
    }
}

impl<U> Walk<'_, '_, U> {
    fn number(&mut self, path: &dyn Display, number: f64) -> U {
        (self.replace)(path, number, None)
    }

    fn quantity(&mut self, path: &dyn Display, quantity: &Quantity) -> Quantity<U> {
        quantity.with((self.replace)(path, quantity.number(), Some(quantity.unit())))
    }

    fn maybe(&mut self, path: &dyn Display, quantity: Option<&Quantity>) -> Option<Quantity<U>> {
        quantity.map(|quantity| self.quantity(path, quantity))
    }

    fn list(&mut self, path: &dyn Display, quantities: &[Quantity]) -> Vec<Quantity<U>> {
        let element = |(i, quantity)| self.quantity(&Element(path, i), quantity);
        quantities.iter().enumerate().map(element).collect()
    }

    fn vehicle(&mut self, table: &dyn Display, vehicle: &Vehicle) -> Vehicle<U> {
        let at = |key| Key(table, key);
        Vehicle {
            name: vehicle.name.clone(),
            fixed: vehicle.fixed,
            mass: vehicle.mass.as_ref().map(|mass| self.mass(table, mass)),
            yaw: vehicle.yaw.as_ref().map(|yaw| match yaw {
                YawInertia::Inertia(q) => YawInertia::Inertia(self.quantity(&at("yaw_inertia"), q)),
                YawInertia::Radius(q) => YawInertia::Radius(self.quantity(&at("yaw_radius"), q)),
            }),
            class: vehicle.class,
            wheelbase: self.maybe(&at("wheelbase"), vehicle.wheelbase.as_ref()),
            length: self.maybe(&at("length"), vehicle.length.as_ref()),
            heading: self.maybe(&at("heading"), vehicle.heading.as_ref()),
            contact: vehicle.contact.as_ref().map(|contact| match contact {
                ContactPoint::Polar { distance, angle } => ContactPoint::Polar {
                    distance: self.quantity(&at("contact.distance"), distance),
                    angle: self.quantity(&at("contact.angle"), angle),
                },
                ContactPoint::Cartesian { x, y } => ContactPoint::Cartesian {
                    x: self.quantity(&at("contact.x"), x),
                    y: self.quantity(&at("contact.y"), y),
                },
            }),
            motion: vehicle.motion.as_ref().map(|motion| match motion {
                Velocity::Speed(q) => Velocity::Speed(self.quantity(&at("speed"), q)),
                Velocity::Vector { x, y } => Velocity::Vector {
                    x: self.quantity(&at("velocity.x"), x),
                    y: self.quantity(&at("velocity.y"), y),
                },
            }),
            yaw_rate: self.maybe(&at("yaw_rate"), vehicle.yaw_rate.as_ref()),
            outline: vehicle.outline.as_ref().map(|outline| Outline {
                length: self.quantity(&at("length"), &outline.length),
                width: self.quantity(&at("width"), &outline.width),
                cg_to_front: self.quantity(&at("cg_to_front"), &outline.cg_to_front),
            }),
            crush: vehicle.crush.as_ref().map(|crush| self.crush(&at("crush"), crush)),
        }
    }

    fn mass(&mut self, table: &dyn Display, mass: &Mass) -> Mass<U> {
        match mass {
            Mass::Mass(q) => Mass::Mass(self.quantity(&Key(table, "mass"), q)),
            Mass::Weight(q) => Mass::Weight(self.quantity(&Key(table, "weight"), q)),
        }
    }

    fn crush(&mut self, table: &dyn Display, crush: &Crush) -> Crush<U> {
        let at = |key| Key(table, key);
        Crush {
            side: crush.side,
            from_force_balance: crush.from_force_balance,
            width: self.maybe(&at("width"), crush.width.as_ref()),
            depths: self.list(&at("depths"), &crush.depths),
            spacing: crush.spacing.as_ref().map(|spacing| self.list(&at("spacing"), spacing)),
            stiffness: self.stiffness(&at("stiffness"), &crush.stiffness),
            offset: self.maybe(&at("offset"), crush.offset.as_ref()),
            pdof: crush.pdof.as_ref().map(|pdof| match pdof {
                Pdof::Angle(q) => Pdof::Angle(self.quantity(&at("pdof"), q)),
                Pdof::Clock(hour) => Pdof::Clock(*hour),
            }),
            oblique_angle: self.maybe(&at("oblique_angle"), crush.oblique_angle.as_ref()),
            moment_arm: self.maybe(&at("moment_arm"), crush.moment_arm.as_ref()),
            oblique: crush.oblique.map(|oblique| match oblique {
                ObliqueCorrection::Capped => ObliqueCorrection::Capped,
                ObliqueCorrection::Uncapped => ObliqueCorrection::Uncapped,
                ObliqueCorrection::None => ObliqueCorrection::None,
                ObliqueCorrection::Friction(mu) => {
                    ObliqueCorrection::Friction(self.number(&at("oblique.friction"), mu))
                }
                ObliqueCorrection::Secant => ObliqueCorrection::Secant,
            }),
        }
    }

    fn stiffness(&mut self, table: &dyn Display, stiffness: &StiffnessForm) -> StiffnessForm<U> {
        match stiffness {
            StiffnessForm::Line(line) => StiffnessForm::Line(self.line(table, line)),
            StiffnessForm::Category(category) => StiffnessForm::Category(*category),
            StiffnessForm::Test(test) => {
                let table = &Key(table, "test");
                let at = |key| Key(table, key);
                StiffnessForm::Test(BarrierTest {
                    mass: self.mass(table, &test.mass),
                    speed: self.quantity(&at("speed"), &test.speed),
                    width: self.quantity(&at("width"), &test.width),
                    depths: self.list(&at("depths"), &test.depths),
                    no_damage_speed: self.quantity(&at("no_damage_speed"), &test.no_damage_speed),
                    fit: test.fit,
                })
            }
            StiffnessForm::Zones(zones) => {
                let zones_path = Key(table, "zones");
                let zone = |(i, line)| self.line(&Element(&zones_path, i), line);
                StiffnessForm::Zones(zones.iter().enumerate().map(zone).collect())
            }
        }
    }

    fn line(&mut self, table: &dyn Display, line: &StiffnessLine) -> StiffnessLine<U> {
        let at = |key| Key(table, key);
        match line {
            StiffnessLine::Crush { a, b, g, limit } => StiffnessLine::Crush {
                a: self.quantity(&at("A"), a),
                b: self.quantity(&at("B"), b),
                g: self.maybe(&at("G"), g.as_ref()),
                limit: self.maybe(&at("limit"), limit.as_ref()),
            },
            StiffnessLine::Root { d0, d1, g, limit } => StiffnessLine::Root {
                d0: self.quantity(&at("d0"), d0),
                d1: self.quantity(&at("d1"), d1),
                g: self.maybe(&at("G"), g.as_ref()),
                limit: self.maybe(&at("limit"), limit.as_ref()),
            },
        }
    }

    fn impact(&mut self, impact: &Impact) -> Impact<U> {
        let crush_plane = self.quantity(&"impact.crush_plane", &impact.crush_plane);
        let law = match &impact.law {
            ImpactLaw::Brach { restitution, tangential, moment_restitution } => ImpactLaw::Brach {
                restitution: self.restitution(restitution),
                tangential: self.tangential(*tangential),
                moment_restitution: moment_restitution
                    .map(|e_m| self.number(&"impact.moment_restitution", e_m)),
            },
            ImpactLaw::Woolley { tangential_velocity_change } => ImpactLaw::Woolley {
                tangential_velocity_change: self
                    .maybe(&"impact.tangential_velocity_change", tangential_velocity_change.as_ref()),
            },
            ImpactLaw::Ishikawa { restitution, tangential_restitution } => ImpactLaw::Ishikawa {
                restitution: self.restitution(restitution),
                tangential_restitution: self
                    .number(&"impact.tangential_restitution", *tangential_restitution),
            },
            ImpactLaw::KudlichSlibar { restitution, friction } => ImpactLaw::KudlichSlibar {
                restitution: self.restitution(restitution),
                friction: self.number(&"impact.friction", *friction),
            },
        };
        Impact { crush_plane, law }
    }

    fn restitution(&mut self, restitution: &Restitution) -> Restitution<U> {
        match restitution {
            Restitution::Constant(e) => Restitution::Constant(self.number(&"impact.restitution", *e)),
            Restitution::OfClosingSpeed { speeds, values } => {
                let speeds = self.list(&"impact.restitution.speeds", speeds);
                let value =
                    |(i, e): (usize, &f64)| self.number(&Element(&"impact.restitution.values", i), *e);
                Restitution::OfClosingSpeed { speeds, values: values.iter().enumerate().map(value).collect() }
            }
        }
    }

    fn tangential(&mut self, tangential: BrachTangential) -> BrachTangential<U> {
        match tangential {
            BrachTangential::Critical => BrachTangential::Critical,
            BrachTangential::Ratio(mu) => BrachTangential::Ratio(self.number(&"impact.tangential.ratio", mu)),
            BrachTangential::FractionOfCritical(f) => {
                BrachTangential::FractionOfCritical(self.number(&"impact.tangential.fraction", f))
            }
            BrachTangential::Friction(mu) => {
                BrachTangential::Friction(self.number(&"impact.tangential.friction", mu))
            }
        }
    }
}
