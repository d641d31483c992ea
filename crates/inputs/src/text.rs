//! Texts written by somebody else.

use std::borrow::Cow;
use std::fmt;

/// A title, a name, a source or a file name. A case file may come from the other side, so
/// [`Display`](fmt::Display) writes such texts as [`shown`] does; [`as_given`](Self::as_given) returns the
/// exact characters.
///
/// ```
/// let title = inputs::Text::from("Elm St.\nSpeed of vehicle 1: 20 mph");
/// assert_eq!(title.to_string(), "Elm St.␊Speed of vehicle 1: 20 mph");
/// assert_eq!(title.as_given(), "Elm St.\nSpeed of vehicle 1: 20 mph");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text(String);

impl Text {
    /// The exact characters.
    #[must_use]
    pub fn as_given(&self) -> &str {
        &self.0
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&shown(&self.0))
    }
}

/// The same text on one line, without characters that would act on the reader's terminal or on adjacent
/// characters: each is replaced by its [`sign`] or, if it has none, by its number, as ⟨U+202E⟩.
///
/// ```
/// assert_eq!(inputs::shown("\u{1b}[8mhidden\u{202e}"), "␛[8mhidden⟨U+202E⟩");
/// ```
#[must_use]
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        match sign(letter) {
            Some(sign) => shown.push(sign),
            None if acts(letter) => shown.push_str(&format!("⟨U+{:04X}⟩", u32::from(letter))),
            None => shown.push(letter),
        }
    }
    Cow::Owned(shown)
}

/// The same for each line of a text, keeping line breaks and tabs.
///
/// ```
/// assert_eq!(inputs::shown_lines("a\r\n\tb\u{1b}\n"), "a\n\tb␛\n");
/// ```
#[must_use]
pub fn shown_lines(text: &str) -> String {
    let line = |line: &str| line.split('\t').map(shown).collect::<Vec<_>>().join("\t") + "\n";
    text.lines().map(line).collect()
}

/// Whether a character acts or hides instead of being read: a control character, a line or paragraph
/// separator, one that changes the direction of writing (`Bidi_Control` of the Unicode Character Database),
/// or an invisible one, which makes two different names look the same (`Default_Ignorable_Code_Point`, the
/// braille blank and the anchors of annotations).
///
/// The joiners of Persian, Hindi and emoji (U+200C, U+200D) and the variation selectors (U+FE00 to U+FE0F)
/// change the shape of their neighbours, and belong to the text.
#[must_use]
pub fn acts(letter: char) -> bool {
    letter.is_control()
        || matches!(
            letter,
            '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        )
        || hides(letter)
}

fn hides(letter: char) -> bool {
    matches!(
        letter,
        '\u{00ad}'
            | '\u{034f}'
            | '\u{115f}'..='\u{1160}'
            | '\u{17b4}'..='\u{17b5}'
            | '\u{180b}'..='\u{180f}'
            | '\u{200b}'
            | '\u{2060}'..='\u{2065}'
            | '\u{206a}'..='\u{206f}'
            | '\u{2800}'
            | '\u{3164}'
            | '\u{feff}'
            | '\u{ffa0}'
            | '\u{fff0}'..='\u{fffb}'
            | '\u{1bca0}'..='\u{1bca3}'
            | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

/// The Unicode symbol for an ASCII control character, such as ␛ for escape.
#[must_use]
pub fn sign(letter: char) -> Option<char> {
    match u32::from(letter) {
        code @ 0..=0x1f => char::from_u32(0x2400 + code),
        0x7f => Some('␡'),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Text, acts, shown, sign};

    /// Every character of Unicode, with the classes copied from its tables: Cc, `Bidi_Control`, Zl, Zp, and
    /// `Default_Ignorable_Code_Point` (DerivedCoreProperties.txt) less joiners and variation selectors.
    #[test]
    fn no_character_that_acts_is_left_and_no_other_changes() {
        let acting =
            [0..=0x1f, 0x7f..=0x9f, 0x61c..=0x61c, 0x200e..=0x200f, 0x2028..=0x202e, 0x2066..=0x2069];
        let ignorable = [
            0xad..=0xad,
            0x34f..=0x34f,
            0x61c..=0x61c,
            0x115f..=0x1160,
            0x17b4..=0x17b5,
            0x180b..=0x180f,
            0x200b..=0x200f,
            0x202a..=0x202e,
            0x2060..=0x206f,
            0x3164..=0x3164,
            0xfe00..=0xfe0f,
            0xfeff..=0xfeff,
            0xffa0..=0xffa0,
            0xfff0..=0xfff8,
            0x1bca0..=0x1bca3,
            0x1d173..=0x1d17a,
            0xe0000..=0xe0fff,
        ];
        let beside = [0x2800..=0x2800, 0xfff9..=0xfffb];
        let is_written = |code: u32| matches!(code, 0x200c | 0x200d | 0xfe00..=0xfe0f);
        for letter in '\0'..=char::MAX {
            let classes = acting.iter().chain(&ignorable).chain(&beside);
            let code = u32::from(letter);
            let is_in_class = classes.into_iter().any(|range| range.contains(&code)) && !is_written(code);
            assert_eq!(acts(letter), is_in_class, "U+{:04X}", u32::from(letter));
            let text = format!("a{letter}b");
            let shown = shown(&text);
            assert_eq!(shown != text, is_in_class, "U+{:04X}", u32::from(letter));
            assert!(!shown.contains(acts), "U+{:04X}", u32::from(letter));
        }
    }

    #[test]
    fn the_signs_are_those_of_unicode() {
        for (letter, expected) in [
            ('\0', '␀'),
            ('\u{7}', '␇'),
            ('\n', '␊'),
            ('\r', '␍'),
            ('\u{1b}', '␛'),
            ('\u{1f}', '␟'),
            ('\u{7f}', '␡'),
        ] {
            assert_eq!(sign(letter), Some(expected));
        }
        assert_eq!(sign('\u{9b}'), None);
        assert_eq!(shown("\u{9b}31m\u{85}"), "⟨U+009B⟩31m⟨U+0085⟩");
    }

    #[test]
    fn a_text_is_shown_in_the_width_that_is_asked_for() {
        assert_eq!(format!("[{:6}]", Text::from("a\nb")), "[a␊b   ]");
    }
}
