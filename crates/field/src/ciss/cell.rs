//! A cell of a table, without NHTSA's codes for unknown values.

use std::fmt;

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum CissCell {
    /// Missing, or one of NHTSA's codes for an unknown value.
    Nothing,
    /// A code, a count, or a measurement without decimals.
    Whole(i64),
    /// A measurement.
    Number(f64),
    /// A text as it is.
    Text(String),
}

/// As in a table of comma-separated values.
impl fmt::Display for CissCell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => Ok(()),
            Self::Whole(number) => write!(f, "{number}"),
            // With ".0" if it is whole.
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Text(text) if text.contains([',', '"', '\r', '\n']) => {
                write!(f, "\"{}\"", text.replace('"', "\"\""))
            }
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// The kind of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The case file knows the codes of each quantity, so a value of a recorder is kept as a text.
    Text,
    /// Codes and counts: an unknown value is a code among others.
    Code,
    /// (°) an angle.
    Angle,
    /// (km/h) a value that a recorder stored.
    Recorded,
    /// (cm, kg, km/h, J) any other measurement.
    Measure,
}

pub(super) fn kind(column: &str) -> Kind {
    match column {
        "CDCPLANE" | "CDC" | "PTIME" | "PVALUE" => Kind::Text,
        "PDOF" | "HEADINGANG" | "DVANGTHIS" => Kind::Angle,
        "MAXDVLONG" | "MAXDVLAT" => Kind::Recorded,
        "YEAR" | "CRASHYEAR" | "CASEID" | "EVENTNO" | "VEHNO" | "CDCEVENT" | "OBJCONT" | "VEHNUM"
        | "MAKE" | "MODEL" | "BODYTYPE" | "EDRSUMMNO" | "EDREVENTNO" | "PCODE" => Kind::Code,
        _ => Kind::Measure,
    }
}

/// (–) beyond this, numbers of 64 bits are not all whole.
const MOST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Reads a cell of a column.
///
/// # Errors
/// The kind of value that the cell should contain.
pub(super) fn read(column: &str, text: &str) -> Result<CissCell, &'static str> {
    let (kind, text) = (kind(column), text.trim());
    // SAS writes a missing value as a point.
    if text.is_empty() || text == "." {
        return Ok(CissCell::Nothing);
    }
    if kind == Kind::Text {
        return Ok(CissCell::Text(text.to_owned()));
    }
    let number: f64 = text.parse().map_err(|_| "a number, or nothing where it is missing")?;
    if !number.is_finite() {
        return Ok(CissCell::Nothing);
    }
    Ok(match (kind, whole(number)) {
        (Kind::Code, None) => return Err("a whole number"),
        (Kind::Code, Some(number)) => CissCell::Whole(number),
        _ if is_unknown(number) => CissCell::Nothing,
        (Kind::Angle, _) if !(0.0..=360.0).contains(&number) => CissCell::Nothing,
        (Kind::Recorded, _) | (_, None) => CissCell::Number(number),
        (_, Some(number)) => CissCell::Whole(number),
    })
}

#[expect(clippy::cast_possible_truncation, reason = "it is whole and below 2^53")]
fn whole(number: f64) -> Option<i64> {
    (number.fract() == 0.0 && number.abs() <= MOST_WHOLE).then_some(number as i64)
}

/// Whether a number, of either sign, is one of NHTSA's codes for an unknown value: three to seven digits that
/// are all 8, or all 9 except for a last digit of 5 to 9. A measurement of that size is lost, too.
fn is_unknown(number: f64) -> bool {
    let number = number.abs();
    [1e3, 1e4, 1e5, 1e6, 1e7].into_iter().any(|end| {
        number == 8.0 * (end - 1.0) / 9.0 || (number.fract() == 0.0 && (end - 5.0..end).contains(&number))
    })
}

#[cfg(test)]
mod tests {
    use super::{CissCell, read};

    /// The codes are those of the CISS Analytical User's Manual.
    #[test]
    fn codes_of_what_is_not_known_are_missing() {
        for text in
            ["888", "8888", "88888", "888888", "8888888", "995", "999", "-999", "9995", "9999997", ".", " "]
        {
            assert_eq!(read("C1", text), Ok(CissCell::Nothing), "{text}");
        }
        for (text, number) in
            [("88", 88), ("994", 994), ("1000", 1000), ("9994", 9994), ("88888888", 88_888_888)]
        {
            assert_eq!(read("C1", text), Ok(CissCell::Whole(number)), "{text}");
        }
        assert_eq!(read("C1", "997.5"), Ok(CissCell::Number(997.5)));
        assert_eq!(
            (read("MAKE", "999"), read("PVALUE", "888")),
            (Ok(CissCell::Whole(999)), Ok(CissCell::Text("888".to_owned())))
        );
        assert_eq!(
            (read("PDOF", "361"), read("PDOF", "360")),
            (Ok(CissCell::Nothing), Ok(CissCell::Whole(360)))
        );
    }

    #[test]
    fn a_recorder_has_numbers_and_a_code_is_whole() {
        assert_eq!(read("MAXDVLONG", "-20"), Ok(CissCell::Number(-20.0)));
        assert_eq!(read("C1", "12.50"), Ok(CissCell::Number(12.5)));
        assert_eq!(read("CASEID", "7.0"), Ok(CissCell::Whole(7)));
        assert_eq!(read("CASEID", "7.5"), Err("a whole number"));
        assert_eq!(read("CASEID", "1e300"), Err("a whole number"));
        assert!(read("C1", "deep").is_err_and(|wanted| wanted.starts_with("a number")));
    }

    #[test]
    fn cells_are_written_so_that_they_come_back() {
        for (cell, text) in [
            (CissCell::Nothing, ""),
            (CissCell::Whole(-3), "-3"),
            (CissCell::Number(-20.0), "-20.0"),
            (CissCell::Number(12.25), "12.25"),
            (CissCell::Text("a \"b\", c".to_owned()), "\"a \"\"b\"\", c\""),
        ] {
            assert_eq!(cell.to_string(), text);
        }
    }
}
