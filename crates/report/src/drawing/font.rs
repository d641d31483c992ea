//! How wide a text is. The letters of DejaVu Sans are among the widest of the sans-serif faces: what fits with these fits with those of any reader.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider as _};

/// (em) of a letter that the font has not: those of East Asian scripts are square.
const UNKNOWN: f64 = 1.0;

/// (px) width of a text in letters of the given size (px).
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let Ok(font) = FontRef::new(dejavu::sans::regular()) else {
        return text.chars().map(|_| UNKNOWN * size).sum();
    };
    let letters = font.charmap();
    let metrics = font.glyph_metrics(Size::unscaled(), LocationRef::default());
    let em = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
    let advance = |letter: char| {
        let known = letters.map(letter).and_then(|glyph| metrics.advance_width(glyph));
        known.map_or(UNKNOWN, |units| f64::from(units) / em)
    };
    text.chars().map(advance).sum::<f64>() * size
}

/// The text, cut to the given width (px) with an ellipsis where it is longer.
pub(super) fn cut(text: &str, size: f64, most: f64) -> String {
    if width(text, size) <= most {
        return text.to_owned();
    }
    let mut kept: Vec<char> = text.chars().collect();
    while !kept.is_empty() {
        kept.pop();
        let shorter = format!("{}…", kept.iter().collect::<String>().trim_end());
        if width(&shorter, size) <= most {
            return shorter;
        }
    }
    String::new()
}

/// The text in lines of at most the given width (px), broken at blanks.
pub(super) fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(cut(word, size, most)),
        }
    }
    lines
}
