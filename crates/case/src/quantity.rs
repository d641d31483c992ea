//! Reads quantities such as "6.3 ft", and explains what is wrong with a text that is not one.

use inputs::{Dimension, InvalidQuantity, Quantity, Unit, format_number, shown};
use thiserror::Error;

use crate::nearest::join;
use crate::number::split_number;
use crate::number_slips;
use crate::units::{nearest_unit, read_unit};
use crate::units_in_use::usual_units;

/// Reads a text such as `"6.3 ft"`, which must have the given dimension.
///
/// ```
/// use case::{Dimension, read_quantity};
/// let distance = read_quantity("6.3 ft", Dimension::Length)?;
/// assert!((distance.si() - 1.92024).abs() < 1e-12); // NIST SP 811: 1 ft = 0.3048 m
/// assert_eq!(distance.to_string(), "6.3 ft");
/// # Ok::<(), case::QuantityError>(())
/// ```
///
/// # Errors
///
/// Every variant of [`QuantityError`]: each describes the problem, and [`QuantityError::help`] says what to
/// write.
pub fn read_quantity(text: &str, dimension: Dimension) -> Result<Quantity, QuantityError> {
    // Errors quote the text, and no quantity contains a character that is replaced here.
    let text = &*shown(text.trim());
    if text.is_empty() {
        return Err(QuantityError::Empty { dimension });
    }
    let (number, rest) = split_number(text);
    let Some(number) = number else {
        return Err(not_a_number(text, dimension));
    };
    let unit = find_unit(text, rest.trim(), dimension)?;
    if number.is_infinite() {
        // As written: "inf mph" would not show the user's own digits.
        return Err(InvalidQuantity::NotFinite { value: shorten(text) }.into());
    }
    Ok(Quantity::new(number, unit)?)
}

/// The unit of `dimension` that `spelling` names, or an error; `text` is the whole value.
pub(crate) fn find_unit(
    text: &str,
    spelling: &str,
    dimension: Dimension,
) -> Result<&'static Unit, QuantityError> {
    if let Some(unit) = read_unit(spelling, dimension) {
        return Ok(unit);
    }
    let value = shorten(text);
    if spelling.is_empty() {
        return Err(QuantityError::MissingUnit { value, dimension });
    }
    if let Some(range) = number_slips::range(text, Some(dimension)) {
        return Err(QuantityError::RangeInText { value, range });
    }
    if let Some(decimal) = number_slips::decimal(text, dimension) {
        return Err(QuantityError::NotDecimal { value, decimal });
    }
    if let Some((unit, numbers)) = number_slips::mark(spelling, dimension).zip(text.strip_suffix(spelling)) {
        let decimal = format!("{} {unit}", shorten(numbers.trim_end()));
        return Err(QuantityError::NotDecimal { value, decimal });
    }
    // A spelling that continues like a number was meant as one: "6,3 ft", "5 1/2 in", "3.5.2 m".
    let after_sign = spelling.strip_prefix([',', '.', '/', '_', '\'']).unwrap_or(spelling);
    if after_sign.starts_with(|c: char| c.is_ascii_digit()) {
        return Err(match number_slips::grouped(text, dimension) {
            Some(decimal) => QuantityError::NotDecimal { value, decimal },
            None => bad_number(value, dimension),
        });
    }
    let found: Vec<Dimension> =
        Dimension::ALL.into_iter().filter(|other| read_unit(spelling, *other).is_some()).collect();
    let spelling = shorten(spelling);
    if found.is_empty() {
        Err(QuantityError::UnknownUnit { value, spelling, dimension })
    } else {
        Err(QuantityError::WrongDimension { value, spelling, found, dimension })
    }
}

pub(crate) fn not_a_number(text: &str, dimension: Dimension) -> QuantityError {
    let value = shorten(text);
    if read_unit(text, dimension).is_some() {
        QuantityError::MissingNumber { value, dimension }
    } else if let Some(decimal) =
        number_slips::decimal(text, dimension).or_else(|| number_slips::typed(text, dimension))
    {
        QuantityError::NotDecimal { value, decimal }
    } else {
        bad_number(value, dimension)
    }
}

fn bad_number(value: String, dimension: Dimension) -> QuantityError {
    if value.contains(',') {
        QuantityError::Comma { value, dimension }
    } else {
        QuantityError::BadNumber { value, dimension }
    }
}

/// The part of a value that an error text quotes: all of it, unless it is too long to read.
pub(crate) fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// Which side of a limit is accepted.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Limit {
    Most,
    Least,
}

/// A limit, in the user's unit, rounded to four digits towards the side on which it is itself accepted.
pub(crate) fn format_limit(si: f64, unit: &Unit, limit: Limit) -> String {
    // Fifteen digits: the rounding of the division is gone, and what is left decides the direction.
    let digits = format!("{:.14e}", si / unit.factor());
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((&digits, "0"));
    let (four, rest) = mantissa.split_at(mantissa.len().min("9.999".len()));
    let number = |text: &str| text.replace('.', "").parse::<u32>().unwrap_or_default();
    let is_between = limit == Limit::Least && rest.contains(|c| c != '0');
    let last = number(four) + u32::from(is_between);
    let text = format!("{last}e{}", exponent.parse::<i32>().unwrap_or_default() - 3);
    let shortest = text.parse::<f64>().map_or(text, format_number);
    format!("{shortest} {unit}")
}

/// Why a text is not a quantity of the wanted dimension.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum QuantityError {
    /// Nothing between the quotes.
    #[error("the value is empty")]
    Empty {
        /// The required dimension.
        dimension: Dimension,
    },
    /// Only a unit.
    #[error("\"{value}\" is a unit without a number")]
    MissingNumber {
        /// The whole text.
        value: String,
        /// The required dimension.
        dimension: Dimension,
    },
    /// Only a number.
    #[error("\"{value}\" has no unit")]
    MissingUnit {
        /// The whole text.
        value: String,
        /// The required dimension.
        dimension: Dimension,
    },
    /// It does not begin with a number.
    #[error("\"{value}\" does not start with a valid number")]
    BadNumber {
        /// The whole text.
        value: String,
        /// The required dimension.
        dimension: Dimension,
    },
    /// A comma between digits: a decimal comma, or a separator of thousands.
    #[error("\"{value}\" has a comma in its number")]
    Comma {
        /// The whole text.
        value: String,
        /// The required dimension.
        dimension: Dimension,
    },
    /// A fraction, feet and inches, or a mark in place of the unit.
    #[error("\"{value}\" is not a decimal number with a unit")]
    NotDecimal {
        /// The whole text.
        value: String,
        /// The accepted way to write it.
        decimal: String,
    },
    /// Two numbers that stand for a range.
    #[error("\"{value}\" is a range, which cannot be written as one text")]
    RangeInText {
        /// The whole text.
        value: String,
        /// The accepted way to write it.
        range: String,
    },
    /// No dimension has this unit.
    #[error("\"{value}\" has an unknown unit \"{spelling}\"")]
    UnknownUnit {
        /// The whole text.
        value: String,
        /// The unit in it.
        spelling: String,
        /// The required dimension.
        dimension: Dimension,
    },
    /// The unit measures something else.
    #[error("\"{value}\" is {}, but {dimension} is needed here", alternatives(found))]
    WrongDimension {
        /// The whole text.
        value: String,
        /// The unit in it.
        spelling: String,
        /// The dimensions of that unit.
        found: Vec<Dimension>,
        /// The required dimension.
        dimension: Dimension,
    },
    /// The number or its magnitude is not acceptable.
    #[error(transparent)]
    Invalid(#[from] InvalidQuantity),
}

impl QuantityError {
    /// What to write instead.
    #[must_use]
    pub fn help(&self) -> String {
        self.help_in(None)
    }

    /// Like [`help`](Self::help), with an example in the given unit instead of one in each unit system.
    pub(crate) fn help_in(&self, unit: Option<&'static Unit>) -> String {
        let examples = |number: &str, dimension: &Dimension| {
            let units = unit.map_or_else(|| usual_units(*dimension), |unit| vec![unit]);
            let examples: Vec<String> = units.iter().map(|unit| format!("\"{number} {unit}\"")).collect();
            join(&examples, "or")
        };
        match self {
            Self::Empty { dimension } => {
                format!(
                    "write a number and a unit, as in {}; {}",
                    examples("6.3", dimension),
                    dimension_help(*dimension)
                )
            }
            Self::MissingUnit { value, dimension } => {
                format!("add the unit, as in {}; {}", examples(value, dimension), dimension_help(*dimension))
            }
            Self::MissingNumber { value, dimension } => {
                format!("write the number before the unit: \"1 {value}\"; {}", dimension_help(*dimension))
            }
            // "9,3,2 in" and "1.5,2 in" have no one reading.
            Self::Comma { value, dimension } if value.contains('.') || value.matches(',').count() > 1 => {
                format!(
                    "write one number with a decimal point, and its unit, as in {}",
                    examples("6.3", dimension)
                )
            }
            Self::Comma { value, .. } => {
                let (point, none) = (value.replace(',', "."), value.replace(',', ""));
                let thousands = value
                    .split(',')
                    .skip(1)
                    .all(|group| group.bytes().take_while(u8::is_ascii_digit).count() == 3);
                if thousands {
                    format!("write \"{none}\", or \"{point}\" if a decimal comma was meant")
                } else {
                    format!("write a decimal point: \"{point}\"")
                }
            }
            Self::BadNumber { dimension, .. } => format!(
                "write a decimal number and a unit, as in {}; {}",
                examples("6.3", dimension),
                dimension_help(*dimension)
            ),
            Self::NotDecimal { decimal, .. } => format!("write \"{decimal}\""),
            Self::RangeInText { range, .. } => format!("write {range}"),
            Self::UnknownUnit { spelling, dimension, .. } => match nearest_unit(spelling, *dimension) {
                Some(unit) => format!("{}; did you mean \"{unit}\"?", dimension_help(*dimension)),
                None => dimension_help(*dimension),
            },
            Self::WrongDimension { value, found, dimension, .. } => {
                let key = match (dimension, &found[..]) {
                    (Dimension::Weight, [Dimension::Mass]) => Some("mass"),
                    (Dimension::Mass, [Dimension::Weight, ..]) => Some("weight"),
                    (Dimension::Inertia, [Dimension::Length]) => Some("yaw_radius"),
                    (Dimension::Length, [Dimension::Inertia]) => Some("yaw_inertia"),
                    _ => None,
                };
                match key {
                    Some(key) => format!("{}; or give {key} = \"{value}\"", dimension_help(*dimension)),
                    None => dimension_help(*dimension),
                }
            }
            Self::Invalid(InvalidQuantity::NotFinite { .. }) => "write a finite decimal number".to_owned(),
            Self::Invalid(InvalidQuantity::OutOfBounds { unit, .. }) => format!(
                "the largest magnitude accepted for {} is {}; check the number and its unit",
                unit.dimension(),
                format_limit(unit.dimension().bound(), unit, Limit::Most)
            ),
        }
    }
}

/// "the units for a speed are m/s, km/h, mph, ft/s and kn".
pub(crate) fn dimension_help(dimension: Dimension) -> String {
    let units: Vec<_> = dimension.units().iter().map(Unit::spelling).collect();
    format!("the units for {dimension} are {}", join(&units, "and"))
}

fn alternatives(dimensions: &[Dimension]) -> String {
    let names: Vec<&str> = dimensions.iter().map(|dimension| dimension.name()).collect();
    join(&names, "or")
}
