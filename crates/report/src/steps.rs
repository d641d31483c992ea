//! The results one by one, each with its equation and the numbers put into it, so that a reader with a
//! calculator can check them.
//!
//! All numbers of a substitution are in coherent units of the reader, SI or ft, lb, s and slug, and in
//! degrees, except for numbers of the file that it converts, and in the axes of the case: the equations hold
//! in either handedness. The result is repeated in the units of the other tables of the report. A number that
//! is not exact is printed with at least six significant digits, one with five or fewer is exact; each
//! printed result follows from the printed numbers within their rounding.

mod collision;
mod crash3;
mod damage;
mod inertia;
mod momentum;
mod numbers;

use analysis::Analysis;
use case::{Case, Quantity};
use pim_core::VehicleId;

use crate::units::{Measure, Units};
use numbers::{angle, converted, is_coherent, n, name_of, p};

pub(crate) use numbers::digits;

/// One result.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What it is, such as `crush energy of vehicle 1`.
    pub name: String,
    /// Its symbol, such as `E_1`; `_` begins a subscript.
    pub symbol: String,
    /// The equation's right side in symbols; empty if the value is given or solved for, or if the symbol
    /// itself is the equation.
    pub formula: String,
    /// The same with numbers and units: `·` multiplies, a unit follows its number after a no-break space.
    /// Empty if the value is given or solved for.
    pub substitution: String,
    /// The program's own result, in `unit`.
    pub value: f64,
    /// The unit of the result; empty for a pure number.
    pub unit: &'static str,
    /// The result as printed, without its unit.
    pub printed: String,
    /// The result in the units of the rest of the report, like `24.71 ft/s = 16.85 mph`; `None` if these are
    /// its own.
    pub repeated: Option<String>,
    /// Its quantity in the units of the reader, if `unit` alone does not determine it.
    quantity: Option<Measure>,
    /// The number of the file that it repeats; it needs no equation if it has the unit of the equations.
    input: Option<Quantity>,
    /// The source of the equation: `Eq 5` of SAE 980025, or `theory 3`, a section of docs/theory.md. For a
    /// value without an equation, the source of the value: `input`, or a table.
    pub source: &'static str,
}

impl Step {
    /// Converts the step from SI units to those of the reader.
    fn for_reader(self, units: Units) -> Self {
        let quantity = self.quantity.or_else(|| quantity(self.unit));
        let (size, unit) = units.coherent(self.unit);
        let road = (quantity == Some(Measure::Speed)).then_some(Measure::RoadSpeed);
        let shown: Vec<String> = [quantity, road]
            .into_iter()
            .flatten()
            .filter(|&quantity| units.name(quantity) != unit)
            .map(|quantity| units.format(quantity, self.value).replace('-', "−"))
            .collect();
        let value = self.value / size;
        let is_as_given = self.input.is_some_and(|input| is_coherent(&input, self.unit, units));
        let [formula, substitution] = [&self.formula, &self.substitution]
            .map(|text| if is_as_given { String::new() } else { numbers::printed(text, units) });
        Self {
            formula,
            substitution,
            value,
            unit,
            printed: digits(value),
            repeated: (!shown.is_empty()).then(|| shown.join(" = ")),
            ..self
        }
    }

    /// Sets a quantity other than that of its unit alone.
    fn of(self, quantity: Measure) -> Self {
        Self { quantity: Some(quantity), ..self }
    }
}

/// The quantity that has this unit in most steps. Intermediate sums, such as an area, only ever have the unit
/// of the equations.
fn quantity(unit: &str) -> Option<Measure> {
    Some(match unit {
        "m/s" => Measure::Speed,
        "m" => Measure::Length,
        "kg" => Measure::Mass,
        "kg·m²" => Measure::YawInertia,
        "rad/s" => Measure::YawRateDegrees,
        "J" => Measure::Energy,
        "N·s" => Measure::Impulse,
        "N·m·s" => Measure::MomentImpulse,
        "N/m" => Measure::StiffnessA,
        "N/m²" => Measure::StiffnessB,
        "N" => Measure::StiffnessG,
        _ => return None,
    })
}

/// Steps that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct StepGroup {
    /// Its heading.
    pub title: String,
    /// In the order of the calculation.
    pub steps: Vec<Step>,
}

/// All steps of an analysis, in the order in which one follows from the other.
#[must_use]
pub fn steps(case: &Case, analysis: &Analysis, units: Units) -> Vec<StepGroup> {
    let analysis = &analysis.seen(case.axes);
    let mut groups = inertia::groups(case, analysis);
    groups.extend(damage::groups(case, analysis));
    groups.extend(momentum::both(case, analysis));
    groups.extend(collision::groups(case, analysis));
    groups.extend(momentum::ways(analysis));
    groups.extend(crash3::groups(case, analysis));
    groups.retain(|group| !group.steps.is_empty());
    for group in &mut groups {
        let steps = std::mem::take(&mut group.steps);
        group.steps = steps.into_iter().map(|step| step.for_reader(units)).collect();
    }
    groups
}

fn group(title: impl Into<String>, steps: Vec<Step>) -> StepGroup {
    StepGroup { title: title.into(), steps }
}

/// A result before its value: its name and symbol, and its equation if it has one.
struct Unsolved {
    name: String,
    symbol: String,
    formula: String,
    substitution: String,
}

/// A result, or a number of the case or of a table, under its name and symbol.
fn step(name: impl Into<String>, symbol: impl Into<String>) -> Unsolved {
    let (name, symbol) = (name.into(), symbol.into());
    Unsolved { name, symbol, formula: String::new(), substitution: String::new() }
}

impl Unsolved {
    /// Its equation's right side, in symbols and in numbers.
    fn equals(self, formula: impl Into<String>, substitution: String) -> Self {
        Self { formula: formula.into(), substitution, ..self }
    }

    /// The step with the value, in the unit of the equations, and its source.
    fn is(self, value: f64, unit: &'static str, source: &'static str) -> Step {
        let Self { name, symbol, formula, substitution } = self;
        Step {
            name,
            symbol,
            formula,
            substitution,
            value,
            unit,
            printed: String::new(),
            repeated: None,
            quantity: None,
            input: None,
            source,
        }
    }
}

/// (rad) the heading of a vehicle, in the axes of the case.
fn heading(case: &Case, k: VehicleId) -> f64 {
    case.vehicles[k.index()].heading.as_ref().map_or(0.0, Quantity::si)
}

/// (rad) the direction in which a vehicle travels before the impact, in the axes of the case, and its symbol.
fn course(case: &Case, k: VehicleId) -> (f64, String) {
    let course = case.courses()[k.index()].map_or(0.0, |course| case.axes.lateral(course));
    let is_ahead = course == heading(case, k);
    (course, if is_ahead { format!("θ_{k}") } else { format!("(θ_{k} + β_{k})") })
}
