//! Lists the values of a case, and replaces its numbers.

use std::cell::RefCell;
use std::fmt::Display;

use super::{Case, Find, LeftOut, Reconstruct, ReportHead};
use crate::axes::Axes;
use crate::estimate::{Departures, EstimatedInput};
use crate::units::{Unit, UnitSystem};
use crate::walk::{Element, GivenValue, Input, Origin, Others, Replace, Variable, Walk};
use crate::words::UNKNOWNS;

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

    /// Every number that may vary: those that the case gives, then the departures of its estimates, and the
    /// errors that some numbers share.
    #[must_use]
    pub fn variables(&self) -> Vec<Input> {
        let mut inputs = Vec::new();
        self.map(|input| inputs.push(input));
        inputs
    }

    /// The wanted ones of the [`variables`](Self::variables), each with its index among all. For the others,
    /// the path is only shown, not built.
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
    pub fn values(&self) -> Vec<(String, GivenValue)> {
        let values = RefCell::new(Vec::new());
        let tell = |path: String, value| values.borrow_mut().push((path, value));
        self.walk(
            &mut |path, number, unit, origin| {
                if origin == Origin::Given {
                    tell(path.to_string(), GivenValue::Number { number, unit });
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
            // After all numbers of the collision, whose places do not depend on it.
            avoid: self.avoid.as_ref().map(|avoid| walk.avoid(avoid)),
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

impl<U> Walk<'_, U> {
    /// The departures of the estimates of a case: an absent factor is 1, and an absent distance is 0.
    fn departures(&mut self, case: &Case) -> Departures<U> {
        let Departures { stiffness, yaw_radius, contact } = &case.departures;
        let mut replaced = Departures {
            stiffness: [None, None],
            yaw_radius: [None, None],
            contact: [[None, None], [None, None]],
        };
        for estimate in case.estimates() {
            let mut replace =
                |number, unit| self.replaced(&estimate, number, unit, Origin::Estimate(estimate));
            match estimate {
                EstimatedInput::Stiffness { vehicle, .. } => {
                    let factor = stiffness[vehicle.index()].unwrap_or(1.0);
                    replaced.stiffness[vehicle.index()] = Some(replace(factor, None));
                }
                EstimatedInput::YawRadius { vehicle, .. } => {
                    let factor = yaw_radius[vehicle.index()].unwrap_or(1.0);
                    replaced.yaw_radius[vehicle.index()] = Some(replace(factor, None));
                }
                EstimatedInput::Contact { vehicle, axis } => {
                    let (vehicle, place) = (vehicle.index(), axis.index());
                    // In the unit of the offset; without an offset no point is placed.
                    let offset = case.vehicles[vehicle].crush.as_ref().and_then(|crush| crush.offset);
                    let moved = contact[vehicle][place].or(offset.map(|offset| offset.with(0.0)));
                    replaced.contact[vehicle][place] =
                        moved.map(|moved| moved.with(replace(moved.number(), Some(moved.unit()))));
                }
            }
        }
        replaced
    }
}
