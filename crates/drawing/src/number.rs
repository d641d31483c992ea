//! Numbers as people read them, on a picture and in the text around it.

/// A number with the given decimals, thousands set apart by commas, and no minus before zero.
///
/// ```
/// assert_eq!(drawing::number(-12345.678, 1), "-12,345.7");
/// assert_eq!(drawing::number(-0.04, 1), "0.0");
/// ```
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    let plain = format!("{:.decimals$}", value.abs());
    let (whole, fraction) = plain.split_once('.').map_or((plain.as_str(), None), |(w, f)| (w, Some(f)));
    let mut grouped = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    let negative = value < 0.0 && plain.bytes().any(|b| (b'1'..=b'9').contains(&b));
    let sign = if negative { "-" } else { "" };
    match fraction {
        Some(fraction) => format!("{sign}{grouped}.{fraction}"),
        None => format!("{sign}{grouped}"),
    }
}

/// A number with the given significant digits, as a decimal if that is not long.
///
/// ```
/// assert_eq!(drawing::significant(1.524, 3), "1.52");
/// assert_eq!(drawing::significant(1.524e-9, 3), "1.52e-9");
/// ```
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent.map(|exponent| i32::try_from(digits).unwrap_or(i32::MAX) - 1 - exponent) {
        // Up to six decimals, and no more digits before the point than asked for.
        Some(decimals @ 0..=6) => format!("{value:.*}", usize::try_from(decimals).unwrap_or_default()),
        _ => scientific,
    }
}

/// A count as a number; those here are far below 2³².
pub(crate) fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

/// (px) at most two decimals, as few as are needed.
pub(crate) fn px(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
