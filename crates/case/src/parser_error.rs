//! Classifies the errors of the TOML parser by their messages, because it gives no other information.
//!
//! Another version may change the messages. `Cargo.toml` therefore pins the minor version of `toml`, and the
//! tests below cover every kind.

/// What the parser found wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A key or a table that appears twice.
    Duplicate,
    /// Tables or lists nested too deeply.
    TooDeep,
    /// Something about a table in braces.
    InlineTable,
    /// Something about a list, or about the header of a list of tables.
    List,
    /// A second equals sign.
    ExtraEquals,
    /// A key without an equals sign after it.
    KeyWithoutValue,
    /// A value that may be a text without quotes.
    Unquoted,
    /// A text without an opening quote.
    NoOpeningQuote,
    /// A text that does not end, or that contains a forbidden character.
    BrokenText,
    /// A backslash that starts no valid escape sequence.
    Escape,
    /// A word that is not a number, true or false.
    BadScalar,
    /// Anything else.
    Other,
}

/// An error of the parser.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ParserError<'t> {
    /// The message of the parser.
    pub(crate) message: &'t str,
    pub(crate) kind: Kind,
    /// Whether it names a key or a table.
    pub(crate) names_key: bool,
    /// Whether it names an equals sign.
    pub(crate) names_equals: bool,
    /// Whether it names a text.
    pub(crate) names_text: bool,
    /// Whether the line should have ended.
    pub(crate) expects_newline: bool,
}

impl<'t> ParserError<'t> {
    pub(crate) fn of(message: &'t str) -> Self {
        let says = |part: &str| message.contains(part);
        let any = |parts: &[&str]| parts.iter().any(|part| says(part));
        let kind = if says("duplicate") {
            Kind::Duplicate
        } else if says("recurs") {
            Kind::TooDeep
        } else if any(&["inline table", "key-value pairs"]) {
            Kind::InlineTable
        } else if says("array") {
            Kind::List
        } else if says("extra `=`") {
            Kind::ExtraEquals
        } else if says("no value") {
            Kind::KeyWithoutValue
        } else if says("must be quoted") {
            Kind::Unquoted
        } else if says("opening quote") {
            Kind::NoOpeningQuote
        } else if any(&["escape", "unicode", "hexadecimal"]) {
            Kind::Escape
        } else if any(&["invalid basic", "invalid literal"]) {
            Kind::BrokenText
        } else if any(&["invalid boolean", "invalid float", "invalid integer", "invalid fraction"]) {
            Kind::BadScalar
        } else {
            Kind::Other
        };
        Self {
            message,
            kind,
            names_key: any(&["key", "table"]),
            names_equals: says("="),
            names_text: says("string"),
            expects_newline: says("expected newline"),
        }
    }
}

#[cfg(test)]
mod tests {
    use toml::de::DeTable;

    use super::{Kind, ParserError};

    /// The kinds of the errors of a text, in its order.
    fn kinds(text: &str) -> Vec<Kind> {
        let (_, mut errors) = DeTable::parse_recoverable(text);
        errors.sort_by_key(|error| error.span().map(|span| span.start));
        errors.iter().map(|error| ParserError::of(error.message()).kind).collect()
    }

    fn expects_newline(text: &str) -> bool {
        let (_, errors) = DeTable::parse_recoverable(text);
        errors.iter().any(|error| ParserError::of(error.message()).expects_newline)
    }

    #[test]
    fn each_kind_is_told_from_the_parsers_sentence() {
        let deep = format!("a = {}", "[".repeat(500));
        for (text, kind) in [
            ("a = 1\na = 2", Kind::Duplicate),
            ("[a]\n[a]", Kind::Duplicate),
            ("a = { b = 1, b = 2 }", Kind::Duplicate),
            (&deep, Kind::TooDeep),
            ("a = { b = 1", Kind::InlineTable),
            ("a = { b 1 }", Kind::InlineTable),
            ("a = { b = \"1\" c = \"2\" }", Kind::InlineTable),
            ("a = [\"1\" \"2\"]", Kind::List),
            ("a = [1, 2", Kind::List),
            ("a = [1,, 2]", Kind::List),
            ("[[a]", Kind::List),
            ("a == 1", Kind::ExtraEquals),
            ("a", Kind::KeyWithoutValue),
            ("a b = 1", Kind::KeyWithoutValue),
            ("a = b", Kind::Unquoted),
            ("a = b\"", Kind::NoOpeningQuote),
            ("a = \"b", Kind::BrokenText),
            ("a = 'b", Kind::BrokenText),
            ("a = \"\\c\"", Kind::Escape),
            ("a = \"\\u12\"", Kind::Escape),
            ("a = True", Kind::BadScalar),
            ("a = 1,5", Kind::Other),
            ("a = \"b\" c", Kind::Other),
            ("[a", Kind::Other),
        ] {
            assert_eq!(kinds(text).first(), Some(&kind), "{text}");
        }
    }

    #[test]
    fn what_stands_behind_a_value_is_told_from_the_parsers_sentence() {
        assert!(expects_newline("a = \"b\" c"));
        assert!(!expects_newline("a = b"));
    }
}
