//! The results one by one, each with its equation and the numbers put into it: what a reader with a
//! calculator can check.
//!
//! The result stands in SI units and in those of the report. All numbers of a substitution are in SI units
//! and degrees, but for those of the file that it converts, and in the axes of the case: the equations hold
//! in either handedness. A number that is not exact is printed with at least six significant digits, one with
//! five or fewer is exact; each printed result follows from the printed numbers within their rounding.

mod collision;
mod crash3;
mod damage;
mod inertia;

use analysis::Analysis;
use case::Case;

use crate::units::{Measure, Units, significant};

/// One result.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What it is, such as `crush energy of vehicle 1`.
    pub name: String,
    /// Its symbol, such as `E_1`; `_` begins a subscript.
    pub symbol: String,
    /// The equation's right side in symbols; empty where the value is given or solved for, and where the
    /// symbol itself is the equation.
    pub formula: String,
    /// The same with numbers and units: `·` multiplies, a unit follows its number after a no-break space.
    /// Empty where the value is given or solved for.
    pub substitution: String,
    /// The program's own result, in `unit`.
    pub value: f64,
    /// The unit of the result; empty for a pure number.
    pub unit: &'static str,
    /// The result as printed, without its unit.
    pub printed: String,
    /// What it is in the units of the reader, where `unit` alone does not tell.
    quantity: Option<Measure>,
    /// Where the equation stands: `Eq 5` of SAE 980025, or `theory 3`, a section of docs/theory.md. For a
    /// value without one, where it comes from: `input`, or a table.
    pub source: &'static str,
}

impl Step {
    /// The result as the rest of a report in these units has it, like `24.71 ft/s = 16.85 mph`; `None` where
    /// that is no other unit than its own.
    #[must_use]
    pub fn in_units(&self, units: Units) -> Option<String> {
        let quantity = self.quantity.or_else(|| quantity(self.unit))?;
        let shown: Vec<String> = [Some(quantity), (quantity == Measure::Speed).then_some(Measure::RoadSpeed)]
            .into_iter()
            .flatten()
            .filter(|&quantity| units.name(quantity) != self.unit)
            .map(|quantity| units.format(quantity, self.value).replace('-', "−"))
            .collect();
        (!shown.is_empty()).then(|| shown.join(" = "))
    }

    /// Which is not what its unit alone would say.
    fn of(self, quantity: Measure) -> Self {
        Self { quantity: Some(quantity), ..self }
    }
}

/// What has the unit in most steps. Sums on the way, such as an area, are in no other unit anywhere.
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
pub fn steps(case: &Case, analysis: &Analysis) -> Vec<StepGroup> {
    let analysis = &analysis.seen(case.axes);
    let mut groups = inertia::groups(case, analysis);
    groups.extend(damage::groups(case, analysis));
    groups.extend(collision::groups(case, analysis));
    groups.extend(crash3::groups(case, analysis));
    groups.retain(|group| !group.steps.is_empty());
    groups
}

fn group(title: impl Into<String>, steps: Vec<Step>) -> StepGroup {
    StepGroup { title: title.into(), steps }
}

/// A result with its equation.
fn step(
    name: impl Into<String>,
    symbol: impl Into<String>,
    formula: impl Into<String>,
    substitution: String,
    value: f64,
    unit: &'static str,
    source: &'static str,
) -> Step {
    Step {
        name: name.into(),
        symbol: symbol.into(),
        formula: formula.into(),
        substitution,
        value,
        unit,
        printed: digits(value),
        quantity: None,
        source,
    }
}

/// A number of the case or of a table, as it goes into the equations.
fn given(
    name: impl Into<String>,
    symbol: impl Into<String>,
    value: f64,
    unit: &'static str,
    source: &'static str,
) -> Step {
    step(name, symbol, "", String::new(), value, unit, source)
}

/// (digits) that say that a number is rounded.
const DIGITS: usize = 6;

/// What is smaller is the rounding of a zero: no quantity of a collision is as small in SI units.
const NOTHING: f64 = 1e-12;

/// A number as it is printed: exact where that takes fewer than six digits, else with six. What a conversion
/// of units leaves in the thirteenth digit does not count.
pub(crate) fn digits(value: f64) -> String {
    let value = if value.abs() < NOTHING { 0.0 } else { value };
    let text = match format!("{value:.11e}").parse::<f64>() {
        Ok(plain) if is_short(plain) => format!("{plain}"),
        _ => rounded(value),
    };
    text.replace('-', "−")
}

/// What is smaller has more than two zeros behind the point.
const LONG: f64 = 1e-3;

fn is_short(value: f64) -> bool {
    let text = format!("{value}");
    let digits = text.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count();
    digits < DIGITS && (value == 0.0 || (1e-5..1e6).contains(&value.abs()))
}

/// Six significant digits; a factor of a power of ten only where the number would be long.
fn rounded(value: f64) -> String {
    if (1e5..1e12).contains(&value.abs()) {
        return format!("{value:.0}");
    }
    if value.abs() >= LONG {
        let text = significant(value, DIGITS);
        if !text.contains('e') {
            return text;
        }
        // Behind the point stand zeros, and then all six.
        let zeros = if value.abs() < 0.01 { 2 } else { 1 };
        return format!("{value:.*}", DIGITS + zeros);
    }
    let scientific = format!("{value:.*e}", DIGITS - 1);
    match scientific.split_once('e') {
        Some((mantissa, exponent)) => format!("{mantissa}·10{}", superscript(exponent)),
        None => scientific,
    }
}

fn superscript(exponent: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .chars()
        .map(|c| match c.to_digit(10) {
            Some(digit) => usize::try_from(digit).ok().and_then(|d| RAISED.get(d).copied()).unwrap_or(c),
            None => '⁻',
        })
        .collect()
}

/// A number with its unit, in parentheses where it is negative or a product.
fn n(value: f64, unit: &str) -> String {
    let text = with_unit(value, unit);
    if text.starts_with('−') || text.contains('·') && text.contains("10") && !text.contains('\u{a0}') {
        format!("({text})")
    } else {
        text
    }
}

/// A number with its unit in parentheses, to be raised to a power.
fn p(value: f64, unit: &str) -> String {
    format!("({})", with_unit(value, unit))
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { digits(value) } else { format!("{}\u{a0}{unit}", digits(value)) }
}

/// An angle as the argument of a function.
fn angle(rad: f64) -> String {
    format!("({}\u{a0}°)", digits(rad.to_degrees()))
}
