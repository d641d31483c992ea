//! Equations with numbers in place of their symbols.
//!
//! An equation is written once, in symbols: `½ m_1 (v_1x² + v_1y²)`. Each symbol stands for the result of an
//! earlier step, or for a number that the step brings along.

use case::Quantity;

use crate::units::{Units, significant};

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Amount {
    /// In SI units or degrees. All equations hold in any coherent system of units, so a reader of US units
    /// gets the same steps in ft, lb, s and slug (lb·s²/ft).
    Plain(f64, &'static str),
    /// A number of the file in the unit of the equations: `3300 lb · 0.453592 kg/lb`, or unchanged if the
    /// file has that unit.
    Given(Quantity, &'static str),
}

/// A number with its unit.
pub(super) fn n(value: f64, unit: &'static str) -> Amount {
    Amount::Plain(value, unit)
}

/// An angle (rad).
pub(super) fn angle(rad: f64) -> Amount {
    n(rad.to_degrees(), "°")
}

/// Symbols and what they stand for.
pub(super) type Known = Vec<(String, Amount)>;

impl Amount {
    /// In the coherent units of the reader, in parentheses if it is negative or a product, or has to be.
    fn printed(self, units: Units, is_enclosed: bool) -> String {
        match self {
            Self::Plain(value, unit) => {
                let (size, unit) = units.coherent(unit);
                let text = with_unit(value / size, unit);
                if is_enclosed { format!("({text})") } else { bracketed(text) }
            }
            Self::Given(quantity, unit) => {
                let own = quantity.unit().spelling().replace(' ', "·").replace("^2", "²");
                let (size, unit) = units.coherent(unit);
                let number = bracketed(with_unit(quantity.number(), &own));
                match quantity.unit().factor() / size {
                    same if is_one(same) => number,
                    factor => {
                        let own = if own.contains('·') { format!("({own})") } else { own };
                        format!("{number} · {}", bracketed(with_unit(factor, &format!("{unit}/{own}"))))
                    }
                }
            }
        }
    }
}

const FUNCTIONS: [&str; 5] = ["sin", "cos", "tan", "min", "atan2"];

/// The equation with numbers: `½ · 1500 kg · ((12 m/s)² + (0 m/s)²)`. Later symbols hide earlier ones.
pub(super) fn filled(formula: &str, known: &Known, own: &Known, units: Units) -> String {
    let mut out = String::new();
    let mut rest = formula;
    // A space multiplies between two factors.
    let mut has_factor = false;
    // What follows the argument of a function that has no parentheses in symbols.
    let mut closing = None;
    while let Some(letter) = rest.chars().next() {
        let mut length = letter.len_utf8();
        match letter {
            ' ' if has_factor && rest[1..].starts_with(begins_factor) => {
                out.push_str(" · ");
                has_factor = false;
            }
            '(' | '[' | '{' => {
                out.push('(');
                has_factor = false;
            }
            ')' | ']' | '}' => {
                out.push(')');
                has_factor = true;
            }
            '|' => {
                out.push_str(if has_factor { ")" } else { "abs(" });
                has_factor = !has_factor;
            }
            '/' => {
                out.push_str(" / ");
                has_factor = false;
            }
            ' ' | '²' => out.push(letter),
            letter if letter.is_alphabetic() => {
                if let Some((symbol, amount)) = meaning(rest, known, own) {
                    length = symbol.len();
                    let is_raised = rest[length..].starts_with('²');
                    let end: Option<&str> = closing.take();
                    out.push_str(&amount.printed(units, is_raised || end.is_some()));
                    out.push_str(end.unwrap_or_default());
                    has_factor = true;
                } else {
                    let name = &rest[..rest.find(|c: char| !is_of_name(c)).unwrap_or(rest.len())];
                    length = name.len();
                    if FUNCTIONS.contains(&name) {
                        let is_squared = rest[length..].starts_with('²');
                        let argument = rest[length..].trim_start_matches(['²', ' ']);
                        length = rest.len() - argument.len();
                        // `cos θ` stands for cos(θ), and `tan² α` for (tan(α))².
                        closing = (!argument.starts_with('(')).then_some(if is_squared { ")²" } else { "" });
                        out.push_str(if is_squared { "(" } else { "" });
                    }
                    out.push_str(name);
                }
            }
            letter => {
                out.push(letter);
                has_factor = letter.is_numeric();
            }
        }
        rest = &rest[length..];
    }
    out
}

fn begins_factor(letter: char) -> bool {
    letter.is_alphanumeric() || matches!(letter, '(' | '[' | '{' | '|' | '√')
}

/// Whether a letter continues the name of a symbol. The square follows it.
fn is_of_name(letter: char) -> bool {
    letter != '²' && (letter.is_alphanumeric() || matches!(letter, '_' | '\''))
}

/// The longest symbol with which a text begins, and what it stands for: `u_t,rest` is not `u_t`.
fn meaning<'a>(text: &str, known: &'a Known, own: &'a Known) -> Option<(&'a str, Amount)> {
    let ends = |rest: &str| {
        let mut letters = rest.chars();
        match letters.next() {
            Some(',') => !letters.next().is_some_and(is_of_name),
            next => !next.is_some_and(is_of_name),
        }
    };
    let symbols =
        known.iter().chain(own).filter(|(symbol, _)| text.strip_prefix(&**symbol).is_some_and(ends));
    symbols.max_by_key(|(symbol, _)| symbol.len()).map(|(symbol, amount)| (&**symbol, *amount))
}

/// Whether a number of the file needs no conversion.
pub(super) fn is_coherent(quantity: &Quantity, unit: &str, units: Units) -> bool {
    is_one(quantity.unit().factor() / units.coherent(unit).0)
}

/// Whether a factor is 1, except for the rounding of a product of factors.
fn is_one(factor: f64) -> bool {
    (factor - 1.0).abs() < 1e-12
}

fn bracketed(text: String) -> String {
    if text.starts_with('−') || text.contains('·') && text.contains("10") && !text.contains('\u{a0}') {
        format!("({text})")
    } else {
        text
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { digits(value) } else { format!("{}\u{a0}{unit}", digits(value)) }
}

/// (digits) of a rounded number.
const DIGITS: usize = 6;

/// A smaller number is a rounded zero: no quantity of a collision is so small in SI units.
const NOTHING: f64 = 1e-12;

/// A number as printed: exact if that takes fewer than six digits, else with six. The error of a unit
/// conversion in the thirteenth digit does not count.
pub(crate) fn digits(value: f64) -> String {
    let value = if value.abs() < NOTHING { 0.0 } else { value };
    let text = match format!("{value:.11e}").parse::<f64>() {
        Ok(plain) if is_short(plain) => format!("{plain}"),
        _ => rounded(value),
    };
    text.replace('-', "−")
}

/// A smaller number has at least three zeros after the point.
const LONG: f64 = 1e-3;

fn is_short(value: f64) -> bool {
    let text = format!("{value}");
    let digits = text.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count();
    digits < DIGITS && (value == 0.0 || (1e-5..1e6).contains(&value.abs()))
}

/// Six significant digits, with a power of ten only where the number would be long.
fn rounded(value: f64) -> String {
    if (1e5..1e12).contains(&value.abs()) {
        return format!("{value:.0}");
    }
    if value.abs() >= LONG {
        let text = significant(value, DIGITS);
        if !text.contains('e') {
            return text;
        }
        // Zeros after the point, and then all six digits.
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

#[cfg(test)]
mod tests {
    use super::{Known, angle, filled, n};
    use crate::units::Units;

    /// No-break spaces, which keep a number and its unit together, are written as `~` here.
    #[test]
    fn symbols_give_way_to_numbers() {
        let known: Known = [
            ("m_1", n(1500.0, "kg")),
            ("u", n(9.0, "m/s")),
            ("u_t", n(-2.0, "m/s")),
            ("u_t,rest", n(3.0, "m/s")),
            ("k_1", n(1.5, "m")),
            ("E'", n(8.0, "J")),
            ("E", n(7.0, "J")),
            ("det K", n(0.5, "1/kg²")),
            ("θ_1", angle(-std::f64::consts::FRAC_PI_2)),
            ("Γ", n(30.0, "°")),
        ]
        .map(|(symbol, amount)| (symbol.to_owned(), amount))
        .to_vec();
        let own: Known = vec![("u".to_owned(), n(4.0, "m/s")), ("k_1²".to_owned(), n(6.0, "m²"))];
        for (formula, numbers) in [
            ("½ m_1 (u² + u_t²)", "½ · 1500~kg · ((4~m/s)² + (−2~m/s)²)"),
            ("u_t,rest − u_t", "3~m/s − (−2~m/s)"),
            ("√(2 E'/[m_1])/m_1", "√(2 · 8~J / (1500~kg)) / 1500~kg"),
            ("u cos θ_1 + u_t sin (θ_1 + Γ)", "4~m/s · cos(−90~°) + (−2~m/s) · sin((−90~°) + 30~°)"),
            ("1 + min(|tan Γ|, u) |tan Γ|", "1 + min(abs(tan(30~°)), 4~m/s) · abs(tan(30~°))"),
            ("1 + tan² Γ", "1 + (tan(30~°))²"),
            ("atan2(u sin Γ, −u)", "atan2(4~m/s · sin(30~°), −4~m/s)"),
            ("[(1 + u) E]/det K", "((1 + 4~m/s) · 7~J) / 0.5~1/kg²"),
            // A symbol with its square is one symbol, if there is a number for it.
            ("m_1 k_1²", "1500~kg · 6~m²"),
        ] {
            assert_eq!(filled(formula, &known, &own, Units::Si).replace('\u{a0}', "~"), numbers, "{formula}");
        }
        assert_eq!(
            filled("m_1 k_1²", &known, &Known::new(), Units::Si).replace('\u{a0}', "~"),
            "1500~kg · (1.5~m)²"
        );
    }
}
