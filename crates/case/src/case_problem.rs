//! The problems a case file can have, each with its sentence and its remedy.

use std::borrow::Cow;

use thiserror::Error;

use crate::nearest::join;
use crate::number_slips;
use crate::program::Program;
use crate::quantity::{Limit, QuantityError, dimension_help, format_limit};
use crate::schema::{RESTITUTION, TANGENTIAL, dimensions_of};
use crate::units::read_unit;
use crate::units_in_use::UnitsInUse;
use inputs::{Amount, Dimension, LawName, Quantity, Unit, format_number};

/// A problem at one place of a case file. `Display` describes it, and [`CaseProblem::help`] says what to
/// write instead.
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the fields carry the names of what the sentence above them says")]
pub enum CaseProblem {
    /// The file is too large to be a case.
    #[error("the file is larger than {limit} bytes, the limit of a case file")]
    TooLarge { limit: usize },
    /// Nothing but blanks.
    #[error("the file is empty")]
    Empty,
    /// Another kind of file.
    #[error("this is {kind}, not a case file")]
    OtherFile { kind: &'static str },
    /// Text in UTF-16, which some Windows programs write.
    #[error("this is text in UTF-16, but a case file must be UTF-8")]
    Utf16 { help: &'static str },
    /// Text in another encoding.
    #[error("the file is not UTF-8 text: line {line} has the first invalid character")]
    NotUtf8 { line: usize, help: &'static str },
    /// Not TOML.
    #[error("this is not valid TOML: {message}")]
    Syntax { message: String, help: Cow<'static, str> },
    /// A key that this table does not have.
    #[error("unknown key \"{key}\" {}", placed(table))]
    UnknownKey {
        table: String,
        key: String,
        nearest: Option<&'static str>,
        belongs: Option<String>,
        known: Vec<&'static str>,
    },
    /// A table that a case does not have.
    #[error("unknown table [{table}]")]
    UnknownTable { table: String, nearest: Option<&'static str> },
    /// A table that every case needs is missing.
    #[error("the table [{table}] is missing")]
    MissingTable { table: &'static str },
    /// A key that its table needs.
    #[error("\"{key}\" is missing from {table}")]
    MissingKey { table: String, key: &'static str, example: &'static str },
    /// A key of another impact law.
    #[error("{table} gives \"{key}\", which {} does not use", law_in_words(law, *is_default))]
    KeyOfOtherLaw {
        table: String,
        key: &'static str,
        law: &'static str,
        is_default: bool,
        keys: String,
        owners: Vec<&'static str>,
    },
    /// A key that the impact law needs.
    #[error("\"{key}\" is missing from {table}: {} needs it", law_in_words(law, *is_default))]
    MissingKeyOfLaw {
        table: String,
        key: &'static str,
        law: &'static str,
        is_default: bool,
        keys: String,
        example: &'static str,
    },
    /// A value of the wrong type.
    #[error("\"{path}\" is {found}, but must be {wanted}")]
    WrongType { path: String, found: &'static str, wanted: &'static str, example: &'static str },
    /// A table written with double brackets, or otherwise as a list.
    #[error("[{path}] is {found}, but must be a table")]
    NotATable { path: String, found: &'static str },
    /// A dimensioned value without quotes and unit.
    #[error("\"{path}\" is the bare number {number}, but needs a unit")]
    BareNumber { path: String, number: String, dimension: Dimension, example: String },
    /// A plain number in quotes.
    #[error("{path} is the string \"{text}\", but must be a plain number")]
    QuotedNumber { path: String, text: String, number: Option<String>, example: &'static str },
    /// A list of plain numbers where each needs a unit.
    #[error("\"{path}\" is a list of bare numbers, but needs a unit")]
    BareNumbers { path: String, dimension: Dimension, example: String },
    /// A quantity that cannot be read; `unit` is used in an example.
    #[error("{error}")]
    Quantity { error: QuantityError, unit: Option<&'static Unit> },
    /// A string that is not a list of quantities.
    #[error("\"{text}\" is not a list of numbers with one unit at its end")]
    BadList { text: String, dimension: Dimension, example: &'static str },
    /// A value that must be greater than zero.
    #[error("{path} is {value}, but must be greater than zero")]
    NotPositive { path: String, value: Quantity, why: &'static str, example: &'static str },
    /// A value that must not be negative.
    #[error("{path} is {value}, but must not be negative")]
    Negative { path: String, value: Quantity },
    /// A positive value that is implausibly small.
    #[error("{path} is {value}, which is implausibly small")]
    TooSmall { path: String, value: Quantity },
    /// An angle that must be acute.
    #[error("{path} is {value}, but must lie between -{limit} and {limit}")]
    NotAcute { path: String, value: Quantity, limit: &'static str },
    /// A plain number out of range.
    #[error("{path} is {}, but must be {range}", format_number(*value))]
    OutOfRange { path: String, value: f64, range: Cow<'static, str>, example: &'static str },
    /// A text that is empty.
    #[error("\"{path}\" is empty")]
    EmptyText { path: String, example: &'static str },
    /// A word that is not one of the choices.
    #[error("\"{path}\" cannot be \"{word}\"")]
    UnknownChoice { path: String, word: String, nearest: Option<&'static str>, choices: String },
    /// Neades' factor as an energy basis, under any spelling.
    #[error("\"{path}\" cannot be \"{word}\": Neades' factor leads to the condition of \"dissipated\"")]
    NeadesBasis { path: String, word: String },
    /// Two keys of which only one may be given.
    #[error("{table} gives both \"{first}\" and \"{second}\"")]
    Both { table: String, first: &'static str, second: &'static str },
    /// Keys that do not make up a valid form of the value.
    #[error("\"{path}\" gives {}", not_valid(given, "set of keys"))]
    NoForm { path: String, given: Vec<&'static str>, forms: &'static str },
    /// A key that another one of its table excludes.
    #[error("{table} {because}, so it cannot give \"{key}\"")]
    CannotGive { table: String, key: &'static str, because: &'static str, instead: &'static str },
    /// An outline with parts missing.
    #[error("{table} gives {} of the outline, but not {}", join(given, "and"), join(missing, "and"))]
    HalfOutline { table: String, given: Vec<&'static str>, missing: Vec<&'static str> },
    /// Too many values in a list.
    #[error("\"{path}\" has {count} values, but at most {limit} are accepted")]
    TooMany { path: String, count: usize, limit: usize },
    /// Too many numbers that are ranges.
    #[error("{count} numbers of this case are ranges, but at most {limit} are accepted")]
    TooManyRanges { count: usize, limit: usize },
    /// A curve of restitution without a point.
    #[error("\"{path}\" is an empty list, but a restitution curve needs at least one point")]
    NoPoints { path: String },
    /// Speeds and coefficients of restitution that do not match.
    #[error("\"{path}\" has {values} for {speeds}, but needs one value for each speed",
        values = counted(*values, "value"), speeds = counted(*speeds, "speed"))]
    ValueCount { path: String, values: usize, speeds: usize },
    /// Closing speeds out of order.
    #[error("{path} is {value}, but must be greater than the {before} before it")]
    NotAscending { path: String, value: Quantity, before: Quantity },
    /// Not an hour.
    #[error("\"{path}\" is \"{text}\", but a clock hour must be a whole number from 1 to 12")]
    NotAnHour { path: String, text: String },
    /// An hour in an unsupported notation.
    #[error("\"{path}\" is \"{text}\", which is not how a clock hour is written here")]
    HourForm { path: String, text: String, hour: Option<u8> },
    /// Keys that do not make up a range.
    #[error("{path} gives {}", not_valid(given, "range"))]
    NoRangeForm { path: String, given: Vec<&'static str>, forms: &'static str },
    /// A range for a value that cannot be one.
    #[error("\"{path}\" is a range, but this key cannot be one")]
    NoRange { path: String, example: &'static str },
    /// The ends of a range in the wrong order.
    #[error("{path} goes from {low} to {high}, but its low end must be below its high end")]
    NotRising { path: String, low: Amount, high: Amount },
    /// A mode outside its range.
    #[error("{path} has the mode {mode}, which is not between {low} and {high}")]
    ModeOutside { path: String, low: Amount, mode: Amount, high: Amount },
    /// A percentage of zero.
    #[error("{path} is {value}, and a percentage of zero gives no range")]
    WithinOfZero { path: String, value: Amount },
    /// A percentage for a standard deviation.
    #[error("{path} is \"{text}\", but a standard deviation cannot be a percentage")]
    PercentAsSd { path: String, text: String },
    /// Not a percentage.
    #[error("{path} is \"{text}\", but must be a percentage")]
    NotPercent { path: String, text: String, example: &'static str },
    /// A fault of a case that can be read.
    #[error("{message}")]
    Fault { message: String, help: Option<String> },
}

impl CaseProblem {
    /// Whether it concerns the case as a whole: when a part of a case is read, missing keys may follow.
    pub(crate) fn is_of_whole(&self) -> bool {
        matches!(
            self,
            Self::MissingTable { .. }
                | Self::MissingKey { .. }
                | Self::KeyOfOtherLaw { .. }
                | Self::MissingKeyOfLaw { .. }
                | Self::NoForm { .. }
                | Self::HalfOutline { .. }
                | Self::NoPoints { .. }
                | Self::ValueCount { .. }
                | Self::NoRangeForm { .. }
                | Self::Fault { .. }
        )
    }

    /// What to write instead, as a sentence without its full stop. [`Diagnostics`](crate::Diagnostics) show
    /// it with examples in the units of the file.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        self.help_in(None, &Program::NONE)
    }

    /// Like [`help`](Self::help), with examples in the units of a file and the command names of a program.
    pub(crate) fn help_in(&self, units_in_use: Option<&UnitsInUse>, program: &Program) -> Option<String> {
        let suited = |place: &str, example: &str| {
            units_in_use
                .map_or_else(|| example.to_owned(), |units_in_use| units_in_use.suited(place, example))
        };
        let help = match self {
            Self::TooLarge { .. } => "a case file is about a page of text; is this the right file?".to_owned(),
            Self::Empty => match program.begins {
                Some(begins) => format!("{begins} writes a template of a case file"),
                None => "a case file is plain text in TOML".to_owned(),
            },
            Self::OtherFile { .. } => {
                let begins = program.begins.map_or_else(String::new, |begins| format!("; {begins} writes a template"));
                format!("a case file is plain text in TOML{begins}; is this the right file?")
            }
            Self::Utf16 { help } | Self::NotUtf8 { help, .. } => (*help).to_owned(),
            Self::Syntax { help, .. } => help.to_string(),
            Self::UnknownKey { belongs, nearest, known, table, key } => match (belongs, nearest) {
                (Some(belongs), None) if key == "grade" && table.contains("zone") => {
                    format!("a zone has no grade of its own: in {belongs} it tilts all of the scene")
                }
                (Some(belongs), None) => format!("it belongs in {belongs}"),
                (Some(belongs), Some(nearest)) => {
                    format!("did you mean \"{nearest}\"? \"{key}\" belongs in {belongs}")
                }
                (None, Some(nearest)) => {
                    let unit = key.strip_prefix(nearest).map(|rest| rest.trim_start_matches(['_', '-', ' ']));
                    let is_unit = |unit: &&str| dimensions_of(nearest).iter().any(|of_key| read_unit(unit, *of_key).is_some());
                    match unit.filter(is_unit) {
                        Some(unit) => format!("write the unit after the number: {nearest} = \"… {unit}\""),
                        None => format!("did you mean \"{nearest}\"?"),
                    }
                }
                (None, None) => format!("the keys {} are {}", placed(table), join(known, "and")),
            },
            Self::UnknownTable { nearest: Some(nearest), .. } => format!("did you mean [{nearest}]?"),
            Self::UnknownTable { table, nearest: None } if table.starts_with("vehicle") => {
                "a case has two vehicles, [vehicle1] and [vehicle2]: write a case for each impact of a chain".to_owned()
            }
            Self::UnknownTable { table, .. } if table == "crush" => {
                "write [vehicle1.crush] or [vehicle2.crush]".to_owned()
            }
            Self::UnknownTable { .. } => "the tables of a case are [vehicle1], [vehicle1.crush], [vehicle2], [vehicle2.crush], [impact] and \
                 [reconstruct]"
                .to_owned(),
            Self::MissingTable { table } => {
                format!("add [{table}]; a case of one vehicle alone describes it there")
            }
            Self::MissingKey { table, example, .. } => format!("add a line such as {}", suited(table, example)),
            Self::KeyOfOtherLaw { key, law, keys, owners, .. } => other_law_help(key, law, keys, owners),
            Self::MissingKeyOfLaw { example, law, keys, .. } => {
                let example = suited("", example);
                format!("add a line such as {example}; law = \"{law}\" uses {keys}")
            }
            Self::WrongType { path, example, .. } => {
                format!("write, for example, {}", suited(path, &pointing(example, program)))
            }
            Self::NotATable { path, found: "a list" } => {
                format!("write [{path}], with single brackets, on a line of its own")
            }
            Self::NotATable { path, .. } => format!("write [{path}] on a line of its own, and its keys below"),
            Self::BareNumber { path, dimension, example, .. } => format!(
                "write the number and its unit as a string, for example {}; {}",
                suited(path, example),
                dimension_help(*dimension)
            ),
            Self::QuotedNumber { text, number, example, .. } => match (number_slips::range(text, None), number) {
                (Some(range), _) => format!("write a range as {range}"),
                (None, Some(number)) => format!("write {number} without quotes"),
                (None, None) => {
                    format!("write a plain number without quotes, for example {}", pointing(example, program))
                }
            },
            Self::BareNumbers { path, dimension, example } => format!(
                "write the numbers and one unit as a string, for example {}; {}",
                suited(path, example),
                dimension_help(*dimension)
            ),
            Self::Quantity { error, unit } => error.help_in(*unit),
            Self::BadList { text, dimension, example } => {
                let comma = if text.contains(',') { ", not commas" } else { "" };
                format!(
                    "write decimal numbers separated by spaces{comma}, and the unit once, at the end: {}; {}",
                    suited("", example),
                    dimension_help(*dimension)
                )
            }
            Self::NotPositive { why: "", path, value, example } => {
                let dimension = value.dimension();
                match *example {
                    "" => format!("write {dimension} greater than zero"),
                    example => format!("write {dimension} greater than zero, as in {}", suited(path, example)),
                }
            }
            Self::NotPositive { why, .. } => (*why).to_owned(),
            Self::Negative { value, .. } => format!("write {} of zero or more", value.dimension()),
            Self::NotAcute { path, .. } if path.contains(".steer") => {
                "the front wheels turn by less than a right angle: 0 deg is straight ahead".to_owned()
            }
            Self::NotAcute { .. } => {
                "it is the angle between the force and the normal of the damaged side: 0 deg if the force is perpendicular to the side".to_owned()
            }
            Self::OutOfRange { example, .. } => format!("write, for example, {}", pointing(example, program)),
            Self::TooMany { .. } => {
                "give fewer: no profile needs more stations or zones, and no restitution curve more points".to_owned()
            }
            Self::TooManyRanges { .. } => {
                "write most of them as plain numbers: the errors of many stations average out, but those of width and stiffness do not".to_owned()
            }
            Self::TooSmall { value, .. } => format!(
                "{} must be at least {} here; check the number and its unit",
                value.dimension(),
                format_limit(value.dimension().least_positive(), value.unit(), Limit::Least)
            ),
            Self::EmptyText { example, .. } => {
                format!("write a text, as in {example}, or leave the line out")
            }
            Self::UnknownChoice { path, word, .. } if path.ends_with("crush.side") && is_of_driver(word) => {
                "write \"left\" or \"right\", as seen by its driver: the driver's side is \"left\" where the steering wheel is \
                 on the left, and \"right\" where it is on the right"
                    .to_owned()
            }
            Self::UnknownChoice { choices, nearest: Some(nearest), .. } => {
                format!("write {choices}; did you mean \"{nearest}\"?")
            }
            Self::UnknownChoice { choices, .. } => format!("write {choices}"),
            Self::NeadesBasis { .. } => "write energy_basis = \"dissipated\": he multiplies the crush energy by (W_n + W_t)/W_n and takes the product for the \
                 whole loss W_n + W_t, which means that the crush energy is W_n; if the damage shows a part \
                 of W_t as well, write energy_basis = { \
                 tangential_share = 0.5 }"
                .to_owned(),
            Self::Both { first, second, .. } => format!("keep only one of the two: {first} or {second}"),
            Self::NoForm { path, forms, .. } => format!("write {}", suited(path, forms)),
            Self::CannotGive { key, instead, .. } => format!("remove {key}, or remove {instead}"),
            Self::HalfOutline { missing, .. } => format!(
                "add {}, or leave out all three of length, width and cg_to_front: a drawing of the body and a check of the \
                 contact point need all of them",
                join(missing, "and")
            ),
            Self::NoPoints { .. } => format!("write, for example, {}", suited("", RESTITUTION_FORMS)),
            Self::ValueCount { .. } => format!(
                "give both lists the same number of points, as in {} and {}",
                suited("", RESTITUTION.example("speeds")),
                RESTITUTION.example("values")
            ),
            Self::NotAscending { .. } => {
                "list the points by ascending closing speed, each speed once, and the values in the same order".to_owned()
            }
            Self::NotAnHour { .. } => {
                "write a whole hour, as in pdof = \"2 o'clock\", or an angle; 12 o'clock is from straight ahead, 3 o'clock from the right"
                    .to_owned()
            }
            Self::HourForm { hour, .. } => format!(
                "write a whole hour, as in pdof = \"{} o'clock\", or an angle; 12 o'clock is from straight ahead, 3 o'clock from \
                 the right, and half an hour is 15 deg",
                hour.unwrap_or(2)
            ),
            Self::NoRangeForm { forms, .. } => format!("write {forms}"),
            Self::NoRange { path, example } => format!("write, for example, {}", suited(path, example)),
            Self::NotRising { low, high, .. } if low.in_unit(high.unit) == high.number => {
                "write the value alone if it is known exactly".to_owned()
            }
            Self::NotRising { .. } => "swap the two; for angles on both sides of 180 deg, count past 180, for example from 175 deg to 185 deg".to_owned(),
            Self::ModeOutside { .. } => "mode is the most likely value of a triangular distribution; it may \
                                         equal low or high".to_owned(),
            Self::WithinOfZero { .. } => "give the standard deviation instead, as sd = …".to_owned(),
            Self::PercentAsSd { text, .. } => format!(
                "replace sd with within = \"{text}\" and confidence, the probability that the value lies within that percentage: \
                 for example 0.95, or 0.683 for one standard deviation"
            ),
            Self::NotPercent { path, .. } if path.ends_with("within\"") => {
                "write a number and a percent sign, as in within = \"10 %\"; for a deviation with a unit, write sd = …".to_owned()
            }
            Self::NotPercent { example, .. } => {
                format!("write a number and a percent sign, as in {example}")
            }
            Self::Fault { help, .. } => return help.clone(),
        };
        Some(help)
    }
}

/// Whether a side is named after its occupant, which differs between countries.
fn is_of_driver(side: &str) -> bool {
    let side = side.to_lowercase().replace([' ', '-', '_'], "");
    ["driver", "passenger", "nearside", "offside"].iter().any(|word| side.contains(word))
}

/// What `class` may look like; [`pointing`] adds the command that describes the classes.
pub(crate) const CLASS_FORMS: &str = "class = 3; 1 to 6 are CRASH3's size classes of cars, from smallest to largest; leave it out if yaw inertia and outline \
                                      are given";

/// An example with a reference to the command that describes it.
fn pointing<'a>(example: &'a str, program: &Program) -> Cow<'a, str> {
    match (program.describes_classes, example.split_once("; leave it out")) {
        (Some(command), Some((classes, _))) if example == CLASS_FORMS => {
            format!("{classes} (see {command}){}", &example[classes.len()..]).into()
        }
        _ => example.into(),
    }
}

/// What `restitution` may look like.
pub(crate) const RESTITUTION_FORMS: &str =
    "restitution = 0.3 or restitution = { speeds = \"2 5 10 20 m/s\", values = [0.3, 0.2, 0.12, 0.05] }";

/// The place of a key that its table, named as by [`Table::label`], does not have.
fn placed(table: &str) -> String {
    format!("{} {table}", if table.starts_with('[') { "in" } else { "at" })
}

fn law_in_words(law: &str, is_default: bool) -> String {
    if is_default { format!("the default law \"{law}\"") } else { format!("law = \"{law}\"") }
}

fn other_law_help(key: &str, law: &str, keys: &str, owners: &[&str]) -> String {
    let owners: Vec<String> = owners.iter().map(|owner| format!("\"{owner}\"")).collect();
    let help = format!("law = \"{law}\" uses {keys}; {key} belongs to law = {}", join(&owners, "or"));
    // A separate key under another law is a form of `tangential` under Brach's.
    if law == LawName::Brach.name() && TANGENTIAL.has(key) {
        format!("{help}; here write tangential = {{ {} }}", TANGENTIAL.example(key))
    } else {
        help
    }
}

pub(crate) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// The given keys, which do not make up a valid `what`.
fn not_valid(given: &[&str], what: &str) -> String {
    if given.is_empty() {
        "none of its keys".to_owned()
    } else {
        format!("{}, which is not a valid {what}", join(given, "and"))
    }
}
