//! How wide a text is. The letters of DejaVu Sans are among the widest of the sans-serif faces: what fits
//! with these fits with those of any reader.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider as _};

/// (px) letters of labels.
pub(crate) const SMALL: f64 = 13.0;
/// (px) letters of headings.
pub(crate) const LARGE: f64 = 17.0;
/// (em) of a letter that the font has not: those of East Asian scripts are square.
const UNKNOWN: f64 = 1.0;

/// Which point of a text is given.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// (em) how far a letter moves on.
fn advance() -> impl Fn(char) -> f64 {
    let font = FontRef::new(dejavu::sans::regular()).ok();
    let measures = font.map(|font| {
        let em = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        (font.charmap(), font.glyph_metrics(Size::unscaled(), LocationRef::default()), em)
    });
    move |letter| {
        let known = measures.as_ref().and_then(|(letters, metrics, em)| {
            let units = metrics.advance_width(letters.map(letter)?)?;
            Some(f64::from(units) / em)
        });
        known.unwrap_or(UNKNOWN)
    }
}

/// Whether the font has a letter.
fn known() -> impl Fn(char) -> bool {
    let letters = FontRef::new(dejavu::sans::regular()).ok().map(|font| font.charmap());
    move |letter| letters.as_ref().is_some_and(|letters| letters.map(letter).is_some())
}

/// What is printed of a text that the font has not.
pub(crate) fn missing(text: &str) -> Vec<char> {
    let known = known();
    text.chars().filter(|&letter| !letter.is_control() && !known(letter)).collect()
}

/// The text with a question mark for each letter that the font has not.
pub(crate) fn with_known_letters(text: &str) -> String {
    let known = known();
    text.chars().map(|letter| if letter.is_control() || known(letter) { letter } else { '?' }).collect()
}

/// (px) width of a text in letters of the given size (px).
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance()).sum::<f64>() * size
}

/// The text, cut to the given width (px) with an ellipsis where it is longer.
pub(crate) fn cut(text: &str, size: f64, most: f64) -> String {
    let advance = advance();
    let ellipsis = advance('…');
    // (em) up to each letter; and the end of the last with which an ellipsis still fits.
    let (mut so_far, mut fits) = (0.0, None);
    for (start, letter) in text.char_indices() {
        if (so_far + ellipsis) * size <= most {
            fits = Some(start);
        }
        so_far += advance(letter);
    }
    if so_far * size <= most {
        return text.to_owned();
    }
    fits.map_or_else(String::new, |end| format!("{}…", text[..end].trim_end()))
}

/// The text in lines of at most the given width (px), broken at blanks.
pub(crate) fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let advance = advance();
    let mut lines: Vec<String> = Vec::new();
    // (em) of the last line
    let mut so_far = 0.0;
    for word in text.split(' ') {
        let with_word = word.chars().map(&advance).fold(so_far + advance(' '), |sum, letter| sum + letter);
        match lines.last_mut() {
            Some(line) if with_word * size <= most => {
                line.push(' ');
                line.push_str(word);
                so_far = with_word;
            }
            _ => {
                let word = cut(word, size, most);
                so_far = word.chars().map(&advance).sum();
                lines.push(word);
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{cut, lines, width};

    /// By trying every length.
    fn longest(text: &str, most: f64) -> String {
        if width(text, 10.0) <= most {
            return text.to_owned();
        }
        let ends = (0..text.chars().count()).rev();
        let cuts = ends.map(|end| format!("{}…", text.chars().take(end).collect::<String>().trim_end()));
        cuts.into_iter().find(|cut| width(cut, 10.0) <= most).unwrap_or_default()
    }

    #[test]
    fn as_much_is_kept_as_fits() {
        for text in ["1994 GMC Jimmy", "", "W", "a  b   c", "Škoda 香川 ΔV μ_c", "…"] {
            for most in 0..200 {
                let most = f64::from(most) * 0.75;
                assert_eq!(cut(text, 10.0, most), longest(text, most), "{text} in {most}");
            }
        }
    }

    #[test]
    fn a_line_takes_the_words_that_fit() {
        let text = "Damage: vehicle 1, front, about the axis, as wide as given.";
        for most in [60.0, 90.0, 150.0, 1000.0] {
            let lines = lines(text, 10.0, most);
            assert_eq!(lines.join(" "), text);
            for pair in lines.windows(2) {
                let first = pair[1].split(' ').next().unwrap_or_default();
                assert!(width(&pair[0], 10.0) <= most, "{pair:?}");
                assert!(width(&format!("{} {first}", pair[0]), 10.0) > most, "{pair:?}");
            }
        }
        assert_eq!(lines("Kraftfahrzeughaftpflichtversicherung x", 10.0, 50.0)[1], "x");
    }
}
