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
use case::{Case, Quantity, STANDARD_GRAVITY};
use pim_core::VehicleId;

use crate::units::{Measure, Units};
use numbers::{Amount, Known, angle, filled, is_coherent, n};

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
    /// The source of the equation: `Eq 5` of SAE 980025, or `theory 3`, a section of docs/theory.md. For a
    /// value without an equation, the source of the value: `input`, or a table.
    pub source: &'static str,
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
    groups.retain(|group| !group.drafts.is_empty());
    let mut known = vec![("g".to_owned(), n(STANDARD_GRAVITY, "m/s²"))];
    for k in VehicleId::ALL {
        let (heading, course) = (heading(case, k), course(case, k).0);
        known.extend([(format!("θ_{k}"), angle(heading)), (format!("β_{k}"), angle(course - heading))]);
    }
    let mut finish = |DraftGroup { title, drafts }: DraftGroup| {
        let steps = drafts.into_iter().map(|draft| {
            let result = (draft.symbol.clone(), n(draft.value, draft.unit));
            let step = draft.step(&known, units);
            known.push(result);
            step
        });
        StepGroup { title, steps: steps.collect() }
    };
    groups.into_iter().map(&mut finish).collect()
}

/// Results that belong together.
struct DraftGroup {
    title: String,
    drafts: Vec<Draft>,
}

fn group(title: impl Into<String>, drafts: Vec<Draft>) -> DraftGroup {
    DraftGroup { title: title.into(), drafts }
}

/// One result in SI units or degrees, its equation in symbols alone.
struct Draft {
    name: String,
    symbol: String,
    formula: String,
    /// The equation into which numbers are put, if that is not the formula.
    numeric: Option<String>,
    /// Symbols of the equation that are no results of earlier steps.
    own: Known,
    value: f64,
    unit: &'static str,
    source: &'static str,
    /// Its quantity in the units of the reader, if `unit` alone does not determine it.
    quantity: Option<Measure>,
    /// The number of the file that it repeats.
    input: Option<Quantity>,
}

/// A result, or a number of the case or of a table, under its name and symbol.
fn step(
    name: impl Into<String>,
    symbol: impl Into<String>,
    (value, unit): (f64, &'static str),
    source: &'static str,
) -> Draft {
    Draft {
        name: name.into(),
        symbol: symbol.into(),
        formula: String::new(),
        numeric: None,
        own: Known::new(),
        value,
        unit,
        source,
        quantity: None,
        input: None,
    }
}

impl Draft {
    /// Its equation's right side, in symbols.
    fn equals(self, formula: impl Into<String>) -> Self {
        Self { formula: formula.into(), ..self }
    }

    /// What symbols of its equation stand for, where that is no result of an earlier step.
    fn with<S: Into<String>>(mut self, own: impl IntoIterator<Item = (S, Amount)>) -> Self {
        self.own.extend(own.into_iter().map(|(symbol, amount)| (symbol.into(), amount)));
        self
    }

    /// The equation into which numbers are put, where the formula abbreviates it.
    fn written_out(self, numeric: impl Into<String>) -> Self {
        Self { numeric: Some(numeric.into()), ..self }
    }

    /// Sets a quantity other than that of its unit alone.
    fn of(self, quantity: Measure) -> Self {
        Self { quantity: Some(quantity), ..self }
    }

    /// The step in the units of the reader.
    fn step(self, known: &Known, units: Units) -> Step {
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
        let substitution = filled(self.numeric.as_ref().unwrap_or(&self.formula), known, &self.own, units);
        // A number of the file needs no equation if it has the unit of the equations.
        let (formula, substitution) = match self.input {
            Some(input) if is_coherent(&input, self.unit, units) => Default::default(),
            Some(_) => (format!("as given, in {unit}"), substitution),
            None => (self.formula, substitution),
        };
        Step {
            name: self.name,
            symbol: self.symbol,
            formula,
            substitution,
            value,
            unit,
            printed: digits(value),
            repeated: (!shown.is_empty()).then(|| shown.join(" = ")),
            source: self.source,
        }
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
