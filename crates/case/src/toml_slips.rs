//! Explains lines that are not valid TOML: what is wrong with them, and how to write them.
//!
//! The parser only says what it expected, see [`ParserError`]. The line itself shows what was meant: each of
//! [`SLIPS`] recognises one notation that is common elsewhere.

use std::ops::Range;

use crate::case_problem::CaseProblem;
use crate::number_slips::{keyboard, plain};
use crate::parser_error::{Kind, ParserError};
use crate::quantity::shorten;
use crate::schema::{dimensions_of, example_of};
use crate::units::read_unit;
use crate::units_in_use::UnitsInUse;
use inputs::{Dimension, acts, format_number};

/// A brace or bracket that nothing closes.
pub(crate) struct Unclosed {
    pub(crate) span: Range<usize>,
    pub(crate) problem: CaseProblem,
}

/// Typographic quotes, and other characters typed in place of quotes.
const FOREIGN_QUOTES: [char; 13] = ['“', '”', '„', '‟', '‘', '’', '‚', '‛', '«', '»', '´', '`', '＂'];

/// How comments start in other formats.
const FOREIGN_COMMENTS: [&str; 5] = ["//", ";", "--", "/*", "%"];

/// The line of an error, taken apart.
struct Line<'t> {
    /// Without its comment.
    text: &'t str,
    /// (bytes) place of the error in the line.
    at: usize,
    /// The key before the equals sign that precedes the error.
    key: &'t str,
    /// The text after that sign: to the end of the line or, in an inline table, to the next comma before a
    /// key.
    value: &'t str,
    /// What the parser found.
    error: ParserError<'t>,
}

/// The text of a problem: what is wrong, and what to write.
type Found = Option<(String, String)>;

/// The recognisers of slips, the most reliable first.
const SLIPS: [fn(&Line<'_>, &UnitsInUse) -> Found; 15] = [
    depth,
    invisible,
    no_value,
    inch_mark,
    typographic_quotes,
    backslash,
    other_comment,
    foreign_letter,
    key_of_other_form,
    lost_quote,
    quotes_within,
    behind_the_value,
    other_brackets,
    number,
    bare_text,
];

/// The problem at the place of an error of the parser.
pub(crate) fn problem(
    text: &str,
    span: &Range<usize>,
    error: ParserError<'_>,
    units_in_use: &UnitsInUse,
) -> CaseProblem {
    if error.kind == Kind::Duplicate {
        let message = repeated(text, span.start).unwrap_or_else(|| error.message.to_owned());
        return CaseProblem::Syntax { message, help: help(error).into() };
    }
    let line = Line::at(text, span.start, error);
    match SLIPS.iter().find_map(|slip| slip(&line, units_in_use)) {
        Some((message, help)) => CaseProblem::Syntax { message, help: help.into() },
        None => CaseProblem::Syntax {
            message: error.message.to_owned(),
            help: units_in_use.suited("", help(error)).into(),
        },
    }
}

/// Like [`problem`], but without examining the line, for problems beyond those that are shown.
pub(crate) fn unexplained(error: ParserError<'_>) -> CaseProblem {
    CaseProblem::Syntax { message: error.message.to_owned(), help: help(error).into() }
}

fn help(error: ParserError<'_>) -> &'static str {
    match error.kind {
        Kind::Duplicate => "each key and each table may appear only once; remove one of the two",
        Kind::InlineTable => {
            "write a one-line table as { x = \"1.78 m\", y = \"-0.73 m\" }, with commas between its keys and a } at the end"
        }
        Kind::List => {
            "write a list as [\"21.3 in\", \"20.3 in\"], with commas between its values and a ] at the end"
        }
        _ if error.names_key => {
            "write key = value, where the key is one word; start a table with its name in brackets, as in [vehicle1], and a comment with #"
        }
        _ => {
            "write one key = value per line, and put text and quantities in quotes, as in speed = \"10 mph\""
        }
    }
}

/// The key or table that appears twice, and the line of the first, if each is on a line of its own.
fn repeated(text: &str, at: usize) -> Option<String> {
    let (start, end) = bounds_of_line(text, at);
    let line = without_comment(&text[start..end]).trim();
    let before = || text[..start].lines().map(|line| without_comment(line).trim()).enumerate();
    if let Some(name) = name_of_table(line) {
        let (first, _) = before().find(|(_, line)| name_of_table(line).as_ref() == Some(&name))?;
        return Some(format!("the table [{}] appears twice, first on line {}", shorten(&name), first + 1));
    }
    // A key in braces is not looked for.
    let key = line.split_once('=')?.0.trim();
    if !text[start..at.min(end)].trim().is_empty() {
        return None;
    }
    let of_table = before().filter(|(_, line)| name_of_table(line).is_some()).last();
    let is_same = |line: &str| line.split_once('=').is_some_and(|(other, _)| other.trim() == key);
    let (first, _) =
        before().skip(of_table.map_or(0, |(header, _)| header)).find(|(_, line)| is_same(line))?;
    Some(format!("the key \"{}\" appears twice, first on line {}", shorten(key), first + 1))
}

/// The name in the header of a table, without spaces.
fn name_of_table(line: &str) -> Option<String> {
    let name = line.strip_prefix('[')?.strip_suffix(']')?;
    let is_name = name.chars().all(|c| c.is_alphanumeric() || "_-. ".contains(c));
    is_name.then(|| name.replace(' ', ""))
}

/// (bytes) from a repeated header to the next header: everything between them is repeated as well.
pub(crate) fn section_of_header(text: &str, at: usize) -> Option<Range<usize>> {
    let (start, end) = bounds_of_line(text, at);
    name_of_table(without_comment(&text[start..end]).trim())?;
    let next = text[end..].find("\n[").map_or(text.len(), |next| end + next);
    Some(start..next)
}

/// The brace or bracket around an error, if its own line leaves it open and is not meant to continue.
pub(crate) fn unclosed(text: &str, error: &Range<usize>, kind: Kind) -> Option<Unclosed> {
    if kind == Kind::TooDeep {
        return None;
    }
    let open = *openers(text, 0, error.start).last()?;
    let (start, end) = bounds_of_line(text, open);
    let of_line = openers(text, start, end);
    // Those that were opened before on the line are closed after it.
    if !of_line.contains(&open) || has_odd_quotes(&text[start..end]) {
        return None;
    }
    let line = without_comment(&text[start..end]).trim_end();
    let goes_on = line.ends_with([',', '{', '[']);
    if goes_on {
        return None;
    }
    let closers: String = of_line
        .iter()
        .rev()
        .map(|&at| if text[at..].starts_with('{') { '}' } else { ']' })
        .take(60)
        .collect();
    let name = &text[open..=open];
    let message = format!("the {name} is not closed on its line");
    let help = match line.chars().last() {
        Some(wrong @ (')' | '}' | ']' | '>')) if !closers.contains(wrong) => {
            format!("replace the {wrong} at the end of the line with {closers}")
        }
        _ => format!("add {closers} at the end of the line"),
    };
    Some(Unclosed { span: open..open + 1, problem: CaseProblem::Syntax { message, help: help.into() } })
}

/// (bytes) the braces and brackets between two places that are open at the second, except those in texts and
/// comments.
fn openers(text: &str, from: usize, to: usize) -> Vec<usize> {
    let bytes = &text.as_bytes()[..to.min(text.len())];
    let mut open = Vec::new();
    let mut at = from;
    while let Some(&byte) = bytes.get(at) {
        let rest = &bytes[at..];
        let length = match byte {
            b'"' | b'\'' => length_of_text(rest, byte),
            b'#' => rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len()),
            b'{' | b'[' => {
                open.push(at);
                1
            }
            b'}' | b']' => {
                let opener = if byte == b'}' { b'{' } else { b'[' };
                if open.last().is_some_and(|&last| bytes[last] == opener) {
                    open.pop();
                }
                1
            }
            _ => 1,
        };
        at += length;
    }
    open
}

/// (bytes) length of the quoted text that begins here. One that is not closed ends with its line.
fn length_of_text(bytes: &[u8], quote: u8) -> usize {
    let triple = [quote; 3];
    if bytes.starts_with(&triple) {
        let inside = &bytes[3..];
        return inside.windows(3).position(|three| three == triple).map_or(bytes.len(), |end| end + 6);
    }
    let mut at = 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\n' => return at,
            b'\\' if quote == b'"' && bytes.get(at + 1).is_some_and(|&next| next != b'\n') => at += 2,
            _ if byte == quote => return at + 1,
            _ => at += 1,
        }
    }
    bytes.len()
}

fn bounds_of_line(text: &str, at: usize) -> (usize, usize) {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let end = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
    (start, end)
}

/// A line up to the # of its comment.
fn without_comment(line: &str) -> &str {
    let bytes = line.as_bytes();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'#' => return &line[..at],
            b'"' | b'\'' => at += length_of_text(&bytes[at..], byte),
            _ => at += 1,
        }
    }
    line
}

/// A line without the texts in it.
fn without_texts(line: &str) -> String {
    let (mut outside, mut rest) = (String::new(), line);
    while let Some(at) = rest.find(['"', '\'']) {
        outside.push_str(&rest[..at]);
        rest = &rest[at + length_of_text(&rest.as_bytes()[at..], rest.as_bytes()[at])..];
    }
    outside + rest
}

/// Whether a text on this line lacks a quote, within a brace or bracket that the line opens: the parser then
/// takes the next lines for more of its content.
pub(crate) fn runs_on(text: &str, at: usize) -> bool {
    let (start, end) = bounds_of_line(text, at);
    has_odd_quotes(&text[start..end]) && !openers(text, start, end).is_empty()
}

fn has_odd_quotes(line: &str) -> bool {
    let escaped = line.matches("\\\"").count();
    (line.matches('"').count() - escaped) % 2 == 1
}

impl<'t> Line<'t> {
    fn at(text: &'t str, at: usize, error: ParserError<'t>) -> Self {
        // (bytes) a longer line is not a typing error.
        const LONGEST: usize = 2000;
        let at = text.floor_char_boundary(at);
        let (start, end) = bounds_of_line(text, at);
        let whole = if end - start > LONGEST { "" } else { &text[start..end] };
        let line = without_comment(whole).trim_end_matches([' ', '\t', '\r']);
        let at = (at - start).min(line.len());
        let equals = line[..at].rfind('=').or_else(|| line.find('='));
        let (key, value) =
            equals.map_or(("", ""), |equals| (line[..equals].trim_end(), line[equals + 1..].trim_start()));
        let key = key.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default();
        let is_in_table = equals.is_some_and(|equals| line[..equals].contains('{'));
        let value = if is_in_table { in_table(value) } else { value };
        Self { text: line, at, key, value, error }
    }

    /// The key before the place of the error and the value after it, as they have to be written.
    fn assignment(&self) -> String {
        let key = self.text[..self.at]
            .trim_end_matches([' ', '=', ':'])
            .rsplit([' ', '{', ','])
            .next()
            .unwrap_or_default();
        let value = self.rest().trim_start_matches([' ', '=', ':']);
        // In an inline table, more keys may follow.
        let value = if value.starts_with('"') {
            value.split_inclusive('"').take(2).collect()
        } else {
            value.to_owned()
        };
        if key.is_empty() || value.is_empty() {
            "write key = value".to_owned()
        } else {
            format!("write {} = {}", shorten(key), shorten(&value))
        }
    }

    /// What follows the place of the error.
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }
}

/// A value in an inline table: up to its end, or to the next key.
fn in_table(value: &str) -> &str {
    let next = value.find('=').and_then(|equals| value[..equals].rfind(','));
    value[..next.unwrap_or(value.len())].trim_end_matches(['}', ']', ' '])
}

fn found(message: impl Into<String>, help: impl Into<String>) -> Found {
    Some((message.into(), help.into()))
}

fn depth(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let is_deep = line.error.kind == Kind::TooDeep;
    is_deep.then(|| (line.error.message.to_owned(), "no value of a case needs such deep nesting".to_owned()))
}

/// Whether a character has no shape, or that of a space, without being one.
fn is_invisible(c: char) -> bool {
    !c.is_ascii() && (c.is_whitespace() || acts(c) || matches!(c, '\u{200c}' | '\u{200d}'))
}

/// A character outside of the texts that cannot be seen, unless it groups digits.
fn invisible(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let letters: Vec<char> = without_texts(line.text).chars().collect();
    let is_digit = |at: usize| letters.get(at).is_some_and(char::is_ascii_digit);
    let groups = |at: usize| at > 0 && is_digit(at - 1) && is_digit(at + 1);
    let (_, c) = letters.iter().enumerate().find(|&(at, c)| is_invisible(*c) && !groups(at))?;
    found(
        format!("this line has an invisible character, U+{:04X}, which is not a plain space", u32::from(*c)),
        "delete it, or type a space in its place",
    )
}

/// A letter in the name of a key or a table that is none of TOML's, such as a Cyrillic one.
fn foreign_letter(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let text = without_texts(line.text);
    let name = match text.split_once('=') {
        Some((name, _)) => name,
        None => text.trim_start().strip_prefix('[')?,
    };
    let foreign = name.chars().find(|c| !c.is_ascii() && c.is_alphabetic())?;
    found(
        format!("the letter {foreign} (U+{:04X}) in this name is not one of a to z", u32::from(foreign)),
        "type the name again",
    )
}

fn no_value(line: &Line<'_>, units_in_use: &UnitsInUse) -> Found {
    let is_empty = line.value.is_empty() && line.text.ends_with('=') && line.error.kind == Kind::Unquoted;
    is_empty.then(|| {
        let help = "put text and quantities in quotes, as in speed = \"10 mph\", or leave the line out if the value is unknown";
        ("there is no value after the equals sign".to_owned(), units_in_use.suited("", help))
    })
}

/// `"70""`: the mark of inches.
fn inch_mark(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let before = line.text[..line.at].strip_suffix('"')?;
    let is_mark = line.rest().starts_with('"') && before.ends_with(|c: char| c.is_ascii_digit());
    is_mark.then(|| {
        let help = "write the unit in letters, as in \"70 in\", because a quote ends the text";
        ("there is a quote after the end of the text".to_owned(), help.to_owned())
    })
}

/// The text from `at` on, without the quotes of any kind around it.
fn unquoted(text: &str) -> String {
    let is_quote = |c: char| c == '"' || c == '\'' || FOREIGN_QUOTES.contains(&c);
    let text = text.trim().trim_start_matches(is_quote);
    let text = text.split(is_quote).next().unwrap_or_default();
    shorten(text.trim())
}

fn typographic_quotes(line: &Line<'_>, _: &UnitsInUse) -> Found {
    // A mark of feet or inches is not one of the value's quotes.
    let begins = line.value.starts_with(FOREIGN_QUOTES);
    let ends = line.value.starts_with(['"', '\'']) && line.value.ends_with(FOREIGN_QUOTES);
    let key = line.key.is_empty().then(|| line.text.trim_start().starts_with(FOREIGN_QUOTES));
    if !(begins || ends) || key == Some(true) {
        return None;
    }
    found(
        "this quote is typographic, like “ ” or ‘ ’, and cannot enclose a text",
        format!("write straight quotes: \"{}\"", unquoted(line.value)),
    )
}

fn backslash(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let is_escape = line.error.kind == Kind::Escape;
    let text = line.value.strip_prefix('"').filter(|text| is_escape && text.contains('\\'))?;
    let text = shorten(text.trim_end_matches('"'));
    let help = if text.contains('\'') {
        format!("write each backslash as \\\\: \"{}\"", text.replace('\\', "\\\\"))
    } else {
        format!("write '{text}' in single quotes, or write each backslash as \\\\")
    };
    found("in double quotes, a backslash starts an escape sequence, but this is not a valid one", help)
}

fn other_comment(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let is_comment = FOREIGN_COMMENTS.iter().any(|begin| {
        let after = |text: &str| text.strip_prefix(begin).map(|after| !after.trim().is_empty());
        after(line.text.trim_start()) == Some(true) || after(line.rest()) == Some(true)
    });
    is_comment.then(|| ("this is not a comment".to_owned(), "start a comment with #".to_owned()))
}

/// Another notation where a key and its equals sign are due.
fn key_of_other_form(line: &Line<'_>, units_in_use: &UnitsInUse) -> Found {
    let ParserError { kind, names_key, names_equals, .. } = line.error;
    if kind == Kind::Duplicate || !(names_key || names_equals) {
        return None;
    }
    let rest = line.rest();
    let text = line.text.trim();
    if rest.starts_with("==") || kind == Kind::ExtraEquals {
        return found("there are two equals signs", line.assignment());
    }
    if rest.starts_with(':') {
        return found("there is a colon instead of an equals sign", line.assignment());
    }
    let name = text.trim_matches(|c: char| "[](){}<>".contains(c)).trim();
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "_. /-".contains(c));
    if is_name && name.len() < text.len() {
        let name = shorten(name).replace([' ', '/'], ".");
        return found("this is not a valid table header", format!("write [{name}] on a line of its own"));
    }
    let (before, after) = text.split_once('=').unwrap_or((text, ""));
    let words = before.split_whitespace().count();
    if words > 1 && !after.is_empty() && kind == Kind::KeyWithoutValue {
        let help = "write only the key before the equals sign; a unit goes after its number, as in speed = \"10 mph\"";
        return found(
            "there is something between the key and its equals sign",
            units_in_use.suited("", help),
        );
    }
    if after.is_empty() && text.contains('"') && kind == Kind::KeyWithoutValue {
        return found("there is no equals sign after the key", line.assignment());
    }
    None
}

fn lost_quote(line: &Line<'_>, _: &UnitsInUse) -> Found {
    if !has_odd_quotes(line.text) && !line.error.names_text {
        return None;
    }
    let quote = if line.value.starts_with('\'') { '\'' } else { '"' };
    let help = |text: &str| format!("write {quote}{}{quote}", shorten(text.trim()));
    match line.value.strip_prefix(quote) {
        Some(text) if line.error.kind == Kind::BrokenText => {
            found("this text has no closing quote", help(text))
        }
        None if line.error.kind == Kind::NoOpeningQuote && line.value.ends_with('"') => {
            let text = line.value.trim_end_matches('"');
            let is_number_with_mark = text.contains('\'');
            if is_number_with_mark {
                return found(
                    "this text has no opening quote",
                    "write the number and its unit in quotes, and the unit in letters: 5' 3\" is \"63 in\"",
                );
            }
            found("this text has no opening quote", help(text))
        }
        _ if has_odd_quotes(line.text) => found(
            "a quote is missing on this line",
            "put a quote before and after each text, as in { x = \"1.78 m\", y = \"-0.73 m\" }",
        ),
        _ => None,
    }
}

/// `"2012 Toyota "Camry""`, and `'it's a car'`.
fn quotes_within(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let quote = line.value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let text = line.value.strip_prefix(quote)?.strip_suffix(quote)?;
    if !text.contains(quote) || text.contains('=') {
        return None;
    }
    if text.split(quote).skip(1).step_by(2).all(|between| between.trim() == ",") {
        return found(
            "several values need brackets around them",
            format!("write them as a list: [{}]", shorten(line.value)),
        );
    }
    let help = match quote {
        '"' if text.contains('\'') => {
            format!("write the inner quotes as \\\": \"{}\"", shorten(&text.replace('"', "\\\"")))
        }
        '"' => format!("write the whole text in single quotes: '{}'", shorten(text)),
        _ => format!("write the whole text in double quotes: \"{}\"", shorten(text)),
    };
    found("a quote inside this text ends it", help)
}

/// Text after a complete value.
fn behind_the_value(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let rest = line.rest().trim();
    let value = line.value.strip_suffix(rest)?.trim();
    if !line.error.expects_newline || !value.starts_with(['"', '\'', '{', '[']) {
        return None;
    }
    if let "," | ";" | "." = rest {
        return found(format!("there is a {rest} after the value"), format!("remove the {rest}"));
    }
    let is_unit = |text: &str| Dimension::ALL.iter().any(|dimension| read_unit(text, *dimension).is_some());
    let text = value.trim_matches(['"', '\'']);
    if is_unit(rest) {
        return found("the unit is outside the quotes", format!("write \"{} {rest}\"", shorten(text)));
    }
    None
}

/// Parentheses, brackets around a table, and braces around a list.
fn other_brackets(line: &Line<'_>, _: &UnitsInUse) -> Found {
    let value = line.text.split_once('=')?.1.trim();
    let inside = value.strip_prefix(['(', '[', '{', '<'])?.trim_end_matches([')', ']', '}', '>']).trim();
    let has_keys = inside.split('"').step_by(2).any(|part| part.contains(['=', ':']));
    let wanted = if has_keys { ('{', '}') } else { ('[', ']') };
    if inside.is_empty() || value.starts_with(wanted.0) && value.ends_with(wanted.1) {
        return None;
    }
    let (open, close) = wanted;
    let what = if has_keys { "a one-line table needs braces" } else { "a list needs brackets" };
    found(what, format!("write {open} {} {close}", shorten(inside)))
}

/// A number that TOML does not read.
fn number(line: &Line<'_>, units_in_use: &UnitsInUse) -> Found {
    let number = plain(line.value)?;
    let key = Some(line.key).filter(|key| !key.is_empty())?;
    let message = format!("{} is not a valid number", shorten(line.value));
    let of_key = dimensions_of(key);
    if let Some(dimension) = of_key.first() {
        let example = units_in_use.suited("", example_of(key, *dimension)?);
        return found(
            message,
            format!("write the number and its unit in quotes, with a decimal point, as in {example}"),
        );
    }
    let point = if line.value.contains(',') { ", with a decimal point" } else { "" };
    found(message, format!("write {key} = {}{point}", format_number(number)))
}

/// A value without quotes.
fn bare_text(line: &Line<'_>, units_in_use: &UnitsInUse) -> Found {
    let is_value = line.error.expects_newline || matches!(line.error.kind, Kind::Unquoted | Kind::BadScalar);
    if line.value.is_empty() || !is_value {
        return None;
    }
    let word = line.value.to_lowercase();
    match word.as_str() {
        "true" | "yes" | "on" => {
            return found("this must be true or false", "write true in lower case and without quotes");
        }
        "false" | "no" | "off" => {
            return found("this must be true or false", "write false in lower case and without quotes");
        }
        "none" | "null" | "nan" | "nil" | "unknown" | "?" => {
            return found(
                "TOML has no value that means unknown",
                "leave the line out if the value is unknown",
            );
        }
        _ => {}
    }
    if line.value.starts_with(|c: char| "\"'[{(".contains(c)) || line.value.contains('"') {
        return None;
    }
    let text: String = line.value.chars().map(keyboard).collect();
    let example = match dimensions_of(line.key).first() {
        Some(dimension) if !text.contains(char::is_alphabetic) => {
            let example = units_in_use.suited("", example_of(line.key, *dimension)?);
            return found(
                "a quantity needs a unit, and quotes around both",
                format!("write it as in {example}"),
            );
        }
        _ => shorten(text.trim()),
    };
    found("a text or a quantity needs quotes", format!("write {} = \"{example}\"", line.key))
}
