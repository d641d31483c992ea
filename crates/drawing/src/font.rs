//! Widths of texts. DejaVu Sans is among the widest sans-serif fonts, so a text that fits in it also fits in
//! the fonts of any reader.

use std::sync::LazyLock;

/// Consecutive letters: the first, and the advance of each, in units of the em. A line of the table that
/// cannot be read is left out, and a test compares all letters with the font.
static ADVANCES: LazyLock<Vec<(char, Vec<u16>)>> = LazyLock::new(|| {
    let run = |line: &str| {
        let (first, units) = line.split_once(": ")?;
        let first = char::from_u32(u32::from_str_radix(first, 16).ok()?)?;
        Some((first, units.split(' ').map_while(|units| units.parse().ok()).collect()))
    };
    include_str!("font/advances.txt").lines().filter_map(run).collect()
});
/// Units of the em.
const EM: f64 = 2048.0;

/// (px) font size of labels.
pub(crate) const SMALL: f64 = 13.0;
/// (px) font size of headings.
pub(crate) const LARGE: f64 = 17.0;
/// (em) advance of a character missing from the font: East Asian characters are square.
const UNKNOWN: f64 = 1.0;

/// The point of a text whose position is given.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// (em) advance of a character; `None` if it is missing from the font.
///
/// Advances come from a table: drawing for a web page needs the font for nothing else, and it would make up a
/// seventh of the page's size.
fn known(letter: char) -> Option<f64> {
    let after = ADVANCES.partition_point(|&(first, _)| first <= letter);
    let (first, units) = ADVANCES.get(after.checked_sub(1)?)?;
    let place = usize::try_from(u32::from(letter) - u32::from(*first)).ok()?;
    Some(f64::from(*units.get(place)?) / EM)
}

/// (em) advance of any character.
fn advance(letter: char) -> f64 {
    known(letter).unwrap_or(UNKNOWN)
}

/// The printable characters of a text that are missing from the font.
pub(crate) fn missing(text: &str) -> Vec<char> {
    text.chars().filter(|&letter| !letter.is_control() && known(letter).is_none()).collect()
}

/// The text with a question mark for each character missing from the font.
pub(crate) fn with_known_letters(text: &str) -> String {
    let is_known = |letter: char| letter.is_control() || known(letter).is_some();
    text.chars().map(|letter| if is_known(letter) { letter } else { '?' }).collect()
}

/// (px) width of a text at the given font size (px).
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// The text, cut with an ellipsis if it is wider than the given width (px).
pub(crate) fn cut(text: &str, size: f64, most: f64) -> String {
    let ellipsis = advance('…');
    // (em) width up to each letter, and the end of the last one after which an ellipsis still fits.
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

/// The text in lines of at most the given width (px), broken at spaces.
pub(crate) fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    // (em) width of the last line
    let mut so_far = 0.0;
    for word in text.split(' ') {
        let with_word = word.chars().map(advance).fold(so_far + advance(' '), |sum, letter| sum + letter);
        match lines.last_mut() {
            Some(line) if with_word * size <= most => {
                line.push(' ');
                line.push_str(word);
                so_far = with_word;
            }
            _ => {
                let word = cut(word, size, most);
                so_far = word.chars().map(advance).sum();
                lines.push(word);
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use skrifa::instance::{LocationRef, Size};
    use skrifa::{FontRef, MetadataProvider as _};

    use super::{cut, known, lines, width};

    /// Units per em, and all characters of the font with their advances.
    fn of_the_font() -> (u16, Vec<(char, f32)>) {
        let font = FontRef::new(dejavu::sans::regular()).unwrap();
        let metrics = font.glyph_metrics(Size::unscaled(), LocationRef::default());
        let mut letters: Vec<(char, f32)> = font
            .charmap()
            .mappings()
            .map(|(letter, glyph)| (char::from_u32(letter).unwrap(), metrics.advance_width(glyph).unwrap()))
            .collect();
        letters.sort_unstable_by_key(|(letter, _)| *letter);
        (font.metrics(Size::unscaled(), LocationRef::default()).units_per_em, letters)
    }

    fn table(em: u16, letters: &[(char, f32)]) -> String {
        let mut table = format!(
            "# How far the letters of DejaVu Sans move on, in units of which an em has {em}: the first of letters \
             that follow one\n# another, as a hexadecimal number, and the units of each. Made by a test: \
             `UPDATE=1 cargo test -p deltav-drawing the_table`.\n"
        );
        for run in letters.chunk_by(|one, next| u32::from(one.0) + 1 == u32::from(next.0)) {
            let units: Vec<String> = run.iter().map(|(_, units)| units.to_string()).collect();
            table += &format!("{:x}: {}\n", u32::from(run[0].0), units.join(" "));
        }
        table
    }

    #[test]
    fn the_table_is_that_of_the_font() {
        let (em, letters) = of_the_font();
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/font/advances.txt");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, table(em, &letters)).unwrap();
            return;
        }
        assert_eq!(super::EM, f64::from(em));
        assert_eq!(include_str!("font/advances.txt"), table(em, &letters));
        assert!(letters.len() > 5000);
        for &(letter, units) in &letters {
            assert_eq!(known(letter), Some(f64::from(units) / f64::from(em)), "{letter:?}");
        }
        let all = ('\0'..=char::MAX).filter(|&letter| known(letter).is_some()).count();
        assert_eq!(all, letters.len());
    }

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
