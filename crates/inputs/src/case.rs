//! What is known of a collision, in the units in which it is given.

use std::cell::RefCell;
use std::fmt::Display;

use pim_core::{Real, VehicleId};
use reconcile::Unknown;

use crate::axes::Axes;
use crate::basis::Basis;
use crate::estimate::Departures;
use crate::impact::GivenImpact;
use crate::quantity::Quantity;
use crate::range::Range;
use crate::recorder::GivenEstimate;
use crate::scene::{GivenSitePlan, Place, Surface};
use crate::text::Text;
use crate::uncertain::GivenUncertainty;
use crate::units::{Unit, UnitSystem};
use crate::vehicle::{GivenVehicle, Velocity};
use crate::walk::{Element, Input, Origin, Others, Replace, Value, Variable, Walk};
use crate::words::UNKNOWNS;

/// A whole case: two vehicles, and what is known of the impact. The crate `case` reads it from a file and
/// writes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case<T = f64> {
    /// The title, which heads every report.
    pub title: Option<Text>,
    /// Where the data come from.
    pub source: Option<Text>,
    /// `[report]`.
    pub report: ReportHead,
    /// `axes` of `[scene]`: the axes in which all numbers of this case are given.
    pub axes: Axes,
    /// `contact` of `[scene]`: where the impulse of the impact acted, in the coordinates of the survey.
    pub scene_contact: Option<Place<T>>,
    /// `site_plan` of `[scene]`: what lies behind the motion in drawings.
    pub site_plan: Option<GivenSitePlan>,
    /// `locked_together` of `[scene]`: whether the vehicles left the impact as one.
    pub locked_together: bool,
    /// `[surface]`.
    pub surface: Option<Surface<T>>,
    /// `[vehicle1]` and `[vehicle2]`.
    pub vehicles: [GivenVehicle<T>; 2],
    /// `[impact]`.
    pub impact: Option<GivenImpact<T>>,
    /// `[reconstruct]`.
    pub reconstruct: Option<Reconstruct<T>>,
    /// `[estimate]`.
    pub estimate: Option<GivenEstimate>,
    /// Which of the numbers are not known exactly, in the order of [`inputs`](Case::inputs). The numbers
    /// themselves are the central values.
    pub ranges: Vec<Range>,
    /// `[uncertainty]`.
    pub uncertainty: GivenUncertainty,
    /// How far estimates are varied: nothing that the case says, and not at all in the case itself.
    pub departures: Departures<T>,
    /// Which optional words the case leaves out.
    pub left_out: LeftOut,
}

/// What the head of a report says of its making.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportHead {
    /// Who made the analysis.
    pub analyst: Option<Text>,
    /// Of the report.
    pub date: Option<Text>,
    /// The number under which the matter is kept.
    pub file_number: Option<Text>,
    /// The number of the report as an exhibit.
    pub exhibit: Option<Text>,
}

/// Which optional words a case leaves out. The case then holds their defaults, so no result depends on these
/// flags: they only serve to report what is assumed. A flag is false if the whole table is absent.
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

/// Which speed to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reconstruct<T = f64> {
    /// What is unknown.
    pub find: Find,
    /// What the crush energy is held equal to.
    pub energy_basis: Basis<T>,
}

/// The speeds that a reconstruction is to find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Find {
    /// One; the other is known.
    One(Unknown),
    /// Those of both vehicles.
    Both,
}

impl Find {
    /// The one that is unknown; `None` where both are.
    #[must_use]
    pub fn unknown(self) -> Option<Unknown> {
        match self {
            Self::One(unknown) => Some(unknown),
            Self::Both => None,
        }
    }

    /// Whether the speed of a vehicle is sought.
    #[must_use]
    pub fn seeks(self, vehicle: VehicleId) -> bool {
        self.unknown().is_none_or(|unknown| unknown.vehicle() == vehicle)
    }
}

impl<T: Real> Case<T> {
    /// (rad) of both vehicles, in the axes of the engine.
    #[must_use]
    pub fn headings(&self) -> [Option<T>; 2] {
        let heading = |vehicle: &GivenVehicle<T>| vehicle.heading.as_ref().map(Quantity::si);
        self.vehicles.each_ref().map(|vehicle| heading(vehicle).map(|heading| self.axes.lateral(heading)))
    }
}

impl<T: Real> Case<T> {
    /// (rad) the direction in which a vehicle travels before the impact and along which its speed counts, in
    /// the axes of the engine; `None` where it is that of the heading.
    ///
    /// The velocity vector of a vehicle whose speed is sought has a direction of its own. A vehicle that
    /// moves backward counts its speed against it.
    #[must_use]
    pub fn course(&self, vehicle: VehicleId) -> Option<T> {
        let heading = self.headings()[vehicle.index()]?;
        let given = &self.vehicles[vehicle.index()];
        if let Some(sideslip) = &given.sideslip {
            // ψ = θ + β
            return Some(heading + self.axes.lateral(sideslip.si()));
        }
        if !self.reconstruct.as_ref().is_some_and(|reconstruct| reconstruct.find.seeks(vehicle)) {
            return None;
        }
        let Some(Velocity::Vector { x, y }) = &given.motion else { return None };
        let (x, y) = (x.si(), self.axes.lateral(y.si()));
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

impl Case {
    /// Returns the case with its numbers replaced. `replace` receives them in the order of
    /// [`variables`](Self::variables). The new numbers are certain: the [`ranges`](Case::ranges) are dropped.
    pub fn map<U>(&self, mut replace: impl FnMut(Input) -> U) -> Case<U> {
        let input =
            |path: &dyn Display, number, unit, origin| Input { path: path.to_string(), number, unit, origin };
        self.walk(&mut |path, number, unit, origin| replace(input(path, number, unit, origin)), None)
    }

    /// Like [`map`](Self::map), but without building the path of each number, which makes it fast. The
    /// numbers come in the order of [`variables`](Self::variables).
    pub fn map_numbers<U>(&self, mut replace: impl FnMut(f64) -> U) -> Case<U> {
        self.walk(&mut |_, number, _, _| replace(number), None)
    }

    /// Every number that the case gives.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        let mut inputs = self.variables();
        inputs.retain(|input| input.origin == Origin::Given);
        inputs
    }

    /// Every number that may vary: those that the case gives, and after them the departures of its
    /// estimates, and the errors that some of them share.
    #[must_use]
    pub fn variables(&self) -> Vec<Input> {
        let mut inputs = Vec::new();
        self.map(|input| inputs.push(input));
        inputs
    }

    /// Those of the [`variables`](Self::variables) that are wanted, each with its place among all. The others
    /// have their paths only shown, not built.
    pub fn variables_where(&self, mut wanted: impl FnMut(&Variable<'_>) -> bool) -> Vec<(usize, Input)> {
        let (mut place, mut found) = (0, Vec::new());
        let mut look = |path: &dyn Display, number, unit, origin| {
            if wanted(&Variable { path, number, unit, origin }) {
                found.push((place, Input { path: path.to_string(), number, unit, origin }));
            }
            place += 1;
        };
        self.walk(&mut look, None);
        found
    }

    /// Every value of the case, number or not, each under its path. Values that it [leaves
    /// out](Self::left_out) are not listed.
    #[must_use]
    pub fn values(&self) -> Vec<(String, Value)> {
        let values = RefCell::new(Vec::new());
        let tell = |path: String, value| values.borrow_mut().push((path, value));
        self.walk(
            &mut |path, number, unit, origin| {
                if origin == Origin::Given {
                    tell(path.to_string(), Value::Number { number, unit });
                }
            },
            Some(&mut |path, value| tell(path.to_string(), value)),
        );
        values.into_inner()
    }

    fn walk<'a, U>(&self, replace: &'a mut Replace<'a, U>, others: Option<&'a mut Others<'a>>) -> Case<U> {
        let mut walk = Walk::new(replace, others);
        let [v1, v2] = &self.vehicles;
        let LeftOut { axes: axes_out, law: law_out, energy_basis: basis_out, fit: [fit1_out, fit2_out] } =
            self.left_out;
        Case {
            title: walk.text(&"title", self.title.as_ref()),
            source: walk.text(&"source", self.source.as_ref()),
            report: ReportHead {
                analyst: walk.text(&"report.analyst", self.report.analyst.as_ref()),
                date: walk.text(&"report.date", self.report.date.as_ref()),
                file_number: walk.text(&"report.file_number", self.report.file_number.as_ref()),
                exhibit: walk.text(&"report.exhibit", self.report.exhibit.as_ref()),
            },
            axes: walk.default(&"scene.axes", &Axes::WORDS, self.axes, axes_out),
            scene_contact: self.scene_contact.as_ref().map(|place| walk.place(&"scene.contact", place)),
            site_plan: self.site_plan.as_ref().map(|plan| walk.site_plan(plan)),
            locked_together: walk.flag(&"scene.locked_together", self.locked_together),
            surface: self.surface.as_ref().map(|surface| walk.surface(surface)),
            vehicles: [walk.vehicle(&"vehicle1", v1, fit1_out), walk.vehicle(&"vehicle2", v2, fit2_out)],
            impact: self.impact.as_ref().map(|impact| walk.impact(impact, law_out)),
            reconstruct: self.reconstruct.map(|Reconstruct { find, energy_basis }| Reconstruct {
                find: match find {
                    Find::One(unknown) => Find::One(walk.choice(&"reconstruct.find", &UNKNOWNS, unknown)),
                    Find::Both => {
                        for (index, (_, unknown)) in UNKNOWNS.into_iter().enumerate() {
                            walk.choice(&Element(&"reconstruct.find", index), &UNKNOWNS, unknown);
                        }
                        Find::Both
                    }
                },
                energy_basis: walk.basis(energy_basis, basis_out),
            }),
            estimate: self.estimate.as_ref().map(|estimate| walk.estimate(estimate)),
            ranges: Vec::new(),
            departures: walk.departures(self),
            uncertainty: walk.uncertainty(&self.uncertainty),
            left_out: self.left_out,
        }
    }

    /// The unit system in which most of the case's quantities are written; SI if there are as many of each.
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
