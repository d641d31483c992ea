//! The tables read from a text: columns, the quantity that each heading was taken for, and cells without a
//! value.

use std::fmt;

use crate::channel::{Channel, ChannelUnit};

/// A place in a text, from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextPlace {
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

impl fmt::Display for TextPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// The layout of a table in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextLayout {
    /// Fields with this character between them.
    Delimited(char),
    /// Columns with two spaces or more between them.
    Aligned,
    /// A row in each line, words and values with single spaces.
    RowLines,
    /// The values of a row one below the other, row after row.
    RowAfterRow,
    /// The values of a column one below the other, column after column.
    ColumnAfterColumn,
    /// A quantity in each row, a time in each column.
    Transposed,
    /// A value in each row, as in the tables of NHTSA.
    Long,
    /// Separate columns, each a text.
    Columns,
}

impl TextLayout {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Delimited(',') => "columns with commas between them",
            Self::Delimited(';') => "columns with semicolons between them",
            Self::Delimited('|') => "columns with bars between them",
            Self::Delimited(_) => "columns with tabs between them",
            Self::Aligned => "aligned columns",
            Self::RowLines => "one row in each line",
            Self::RowAfterRow => "one value in each line, row after row",
            Self::ColumnAfterColumn => "one value in each line, column after column",
            Self::Transposed => "one quantity in each row",
            Self::Long => "one value in each row, by the codes of NHTSA",
            Self::Columns => "a list for each column",
        }
    }
}

/// A column of a table, read.
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// As in the text.
    pub heading: String,
    /// The quantity that its heading was taken for.
    pub channel: Channel,
    /// The unit of the numbers that were read.
    pub unit: ChannelUnit,
    /// The place of the heading.
    pub place: TextPlace,
    /// (SI) one for each row, `None` if the cell has none.
    pub values: Vec<Option<f64>>,
}

/// (s) times that differ by less are the same.
const SAME_TIME: f64 = 1e-6;

/// The row of a time among times that rise.
fn row_at(times: &[f64], at: f64) -> Option<usize> {
    let row = times.partition_point(|time| *time < at - SAME_TIME);
    times.get(row).filter(|time| **time < at + SAME_TIME).map(|_| row)
}

/// Why a cell has no value.
#[derive(Clone, Debug, PartialEq)]
pub enum NoValue {
    /// It is empty.
    Empty,
    /// A word that means no value: `Invalid`, `SNA`.
    Word(String),
    /// A number that a recorder stores for a missing value, such as 255.
    Code(String),
    /// Beyond what a recorder stores.
    OutOfRange {
        /// As printed.
        printed: String,
        /// (unit of the column) the least and the greatest.
        range: [f64; 2],
    },
    /// Neither a number nor, for a switch, on or off.
    Unreadable(String),
    /// The step to the next row is longer than those before and after it.
    SampleMissing {
        /// (s) to the next row.
        gap: f64,
        /// (s) the other steps.
        step: f64,
    },
}

impl fmt::Display for NoValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the cell is empty"),
            Self::Word(word) => write!(f, "the recorder says \"{word}\""),
            Self::Code(code) => write!(f, "{code} is the recorder's code for \"no value\""),
            Self::OutOfRange { printed, range: [least, greatest] } => {
                write!(f, "{printed} is not between {least:.0} and {greatest:.0}, so no recorder stored it")
            }
            Self::Unreadable(text) => write!(f, "\"{text}\" is not a value of this column"),
            Self::SampleMissing { gap, step } => {
                write!(f, "{gap:.3} s to the next row, {step:.3} s between the others: a sample is missing")
            }
        }
    }
}

/// A cell without a value, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct CellDoubt {
    /// Its place.
    pub place: TextPlace,
    /// Its column.
    pub channel: Channel,
    /// Why.
    pub reason: NoValue,
}

impl fmt::Display for CellDoubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}: {}", self.place, self.channel.name(), self.reason)
    }
}

/// Why a table of a text was not joined to the one that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Apart {
    /// It has a ΔV, and a table before the impact was wanted.
    HasDeltaV,
    /// It has no ΔV, and a pulse was wanted.
    HasNoDeltaV,
    /// It goes beyond the impact.
    AfterImpact {
        /// (s) its first time after the impact.
        time: f64,
    },
    /// It has a quantity that the other table also has, at the same times.
    GivenTwice {
        /// The quantity.
        channel: Channel,
        /// (s) the time from which both have it.
        time: f64,
    },
}

impl fmt::Display for Apart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HasDeltaV => write!(f, "the table has ΔV, which belongs in `pulse`"),
            Self::HasNoDeltaV => write!(f, "the table has no ΔV"),
            Self::AfterImpact { time } => write!(f, "the table has a time after the impact, {time:.3} s"),
            Self::GivenTwice { channel, time } => {
                write!(
                    f,
                    "the table that was read has a {} for the same times, from {time:.3} s on",
                    channel.name()
                )
            }
        }
    }
}

/// The headings of a table of the same text that was not read, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftTable {
    /// Its headings other than the time.
    pub headings: Vec<String>,
    /// Why.
    pub reason: Apart,
}

/// A table of a recorder: times rise, values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderTable {
    /// Its layout in the text.
    pub layout: TextLayout,
    /// The recognised columns, the time first.
    pub columns: Vec<TableColumn>,
    /// The place of the time of each row.
    pub rows: Vec<TextPlace>,
    /// Headings that were not taken for a quantity, or for one that another heading names better, and lines
    /// that were not read.
    pub ignored: Vec<(String, TextPlace)>,
    /// Other tables of the text, whose headings are among the ignored ones.
    pub left: Vec<LeftTable>,
    /// Cells without a value.
    pub doubts: Vec<CellDoubt>,
    /// Whether the text gives times before the impact as positive numbers.
    pub counted_down: bool,
}

impl RecorderTable {
    /// The column of a channel.
    #[must_use]
    pub fn column(&self, channel: Channel) -> Option<&TableColumn> {
        self.columns.iter().find(|column| column.channel == channel)
    }

    /// (s) the times, which rise.
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        let time = self.column(Channel::Time);
        time.map(|column| column.values.iter().flatten().copied().collect()).unwrap_or_default()
    }

    /// (SI) the values of a channel, all `None` if the table has no such column.
    #[must_use]
    pub fn values(&self, channel: Channel) -> Vec<Option<f64>> {
        let rows = self.columns.first().map_or(0, |column| column.values.len());
        self.column(channel).map_or_else(|| vec![None; rows], |column| column.values.clone())
    }

    /// The headings that were read, with the quantities that they were taken for, and those that were not, in
    /// words.
    #[must_use]
    pub fn headings(&self) -> String {
        let read =
            self.columns.iter().map(|column| format!("\"{}\" as {}", column.heading, column.channel.name()));
        let mut words = read.collect::<Vec<_>>().join(", ");
        if !self.ignored.is_empty() {
            let unread: Vec<String> = self.ignored.iter().map(|(text, _)| format!("\"{text}\"")).collect();
            words = format!("{words}; it did not read {}", unread.join(", "));
        }
        words
    }

    /// The columns other than the times.
    fn quantities(&self) -> impl Iterator<Item = &TableColumn> {
        self.columns.iter().filter(|column| column.channel != Channel::Time)
    }

    /// The first quantity that both tables have.
    fn shared_with(&self, other: &Self) -> Option<Channel> {
        let shared = other.quantities().find(|column| self.column(column.channel).is_some());
        shared.map(|column| column.channel)
    }

    /// Whether the tables have a quantity in common.
    #[must_use]
    pub fn shares_a_quantity(&self, other: &Self) -> bool {
        self.shared_with(other).is_some()
    }

    /// Why it is not a table before the impact; `None` if it is one.
    #[must_use]
    pub fn not_before_impact(&self) -> Option<Apart> {
        if self.is_pulse() {
            return Some(Apart::HasDeltaV);
        }
        self.times().into_iter().find(|time| *time > 0.0).map(|time| Apart::AfterImpact { time })
    }

    /// Why another table is not of the same record; `None` if it is: it has other quantities, or continues
    /// where this one ends.
    #[must_use]
    pub fn not_with(&self, other: &Self) -> Option<Apart> {
        let channel = self.shared_with(other)?;
        let [own, others] = [self, other].map(Self::times);
        if own.last() < others.first() || others.last() < own.first() {
            return None;
        }
        let time = own.first()?.max(*others.first()?);
        Some(Apart::GivenTwice { channel, time })
    }

    /// Merges a table of the same record, at the times of both. At times that only one table has, the columns
    /// of the other have no value.
    pub fn join(&mut self, other: Self) {
        let [own, others] = [&*self, &other].map(Self::times);
        let mut rows: Vec<(f64, TextPlace)> = own.iter().copied().zip(self.rows.iter().copied()).collect();
        let new = others.iter().copied().zip(other.rows.iter().copied());
        rows.extend(new.filter(|(time, _)| row_at(&own, *time).is_none()));
        rows.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let value = |times: &[f64], values: &[Option<f64>], at: f64| {
            row_at(times, at).and_then(|row| values.get(row).copied().flatten())
        };
        for column in &mut self.columns {
            let theirs = other.values(column.channel);
            let at = |(time, _): &(f64, TextPlace)| {
                value(&own, &column.values, *time).or_else(|| value(&others, &theirs, *time))
            };
            column.values = rows.iter().map(at).collect();
        }
        for column in other.columns {
            if self.column(column.channel).is_none() {
                let values = rows.iter().map(|(time, _)| value(&others, &column.values, *time)).collect();
                self.columns.push(TableColumn { values, ..column });
            }
        }
        self.rows = rows.into_iter().map(|(_, place)| place).collect();
        self.ignored.extend(other.ignored);
        self.left.extend(other.left);
        self.doubts.extend(other.doubts);
        self.sort();
    }

    /// Lists the quantities of a table that is not used among the ignored ones, with the reason.
    pub fn leave(&mut self, other: Self, reason: Apart) {
        let headings = other.quantities().map(|column| (column.heading.clone(), column.place));
        self.ignored.extend(headings);
        let headings = other.quantities().map(|column| column.heading.clone()).collect();
        self.left.push(LeftTable { headings, reason });
        self.left.extend(other.left);
        self.ignored.extend(other.ignored);
        self.sort();
    }

    fn sort(&mut self) {
        self.ignored.sort_by_key(|(_, place)| *place);
        self.doubts.sort_by_key(|doubt| doubt.place);
    }

    /// Whether it has speeds before the impact.
    #[must_use]
    pub fn is_pre_crash(&self) -> bool {
        self.column(Channel::Speed).is_some()
    }

    /// Whether it has ΔV over time.
    #[must_use]
    pub fn is_pulse(&self) -> bool {
        self.column(Channel::DeltaVLongitudinal).is_some() || self.column(Channel::DeltaVLateral).is_some()
    }
}

/// What a text lacks to be a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TextFault {
    /// Nothing but blanks.
    #[error("the text is empty: copy the table with its heading")]
    Empty,
    /// No heading with a time and a quantity.
    #[error(
        "no heading names a time and a quantity, such as \"Time (s)\" and \"Speed (km/h)\": copy the table with \
         its heading; the text begins with \"{begins}\""
    )]
    NoHeading {
        /// The beginning of its first line.
        begins: String,
    },
    /// Quantities without times.
    #[error("\"{heading}\" has no times here: copy the column or row of times, too")]
    NoTime {
        /// The first heading.
        heading: String,
    },
    /// Values one below the other that may be of rows or of columns.
    #[error(
        "the values below this heading may be those of one row after the other, or of one column after the \
         other: write each row in one line"
    )]
    EitherWay,
    /// A heading without a known place for its times.
    #[error(
        "the times of \"{heading}\" are not its first column: put them first, or write a semicolon between \
         the columns"
    )]
    TimeNotFirst {
        /// The heading.
        heading: String,
    },
    /// Times without a quantity.
    #[error("no quantity other than the times was recognised{found}; known are {known}")]
    NoQuantity {
        /// The other headings of the table, to follow the words before.
        found: String,
        /// Some headings.
        known: &'static str,
    },
    /// A heading without rows.
    #[error("no values follow the heading \"{heading}\"")]
    NoRows {
        /// The heading.
        heading: String,
    },
    /// A heading with no unit, or with an unknown one.
    #[error("the heading \"{heading}\" has no unit that is known for a {channel}: write one of {units}")]
    Unit {
        /// The heading.
        heading: String,
        /// The quantity that it was taken for.
        channel: &'static str,
        /// The units that it may have.
        units: String,
    },
    /// A list of values without a unit, or with an unknown one.
    #[error("these values have no unit that is known for a {channel}: write one of {units} after the last")]
    UnitOfList {
        /// Its quantity.
        channel: &'static str,
        /// The units that it may have.
        units: String,
    },
    /// The number of values in a row differs from that of the headings.
    #[error("{found} value{}, where {expected} are needed: {columns}", if *found == 1 { "" } else { "s" })]
    Uneven {
        /// Number of values.
        found: usize,
        /// Number of headings.
        expected: usize,
        /// The headings.
        columns: String,
    },
    /// A cell in aligned columns that stands in none of them for sure.
    #[error(
        "\"{text}\" stands in no column for sure: line it up with the rows above and below, write - for a \
         value that is empty, or write the table with a semicolon between its columns"
    )]
    CellUnplaced {
        /// The cells.
        text: String,
    },
    /// A part of a heading in aligned columns that stands over none of them for sure.
    #[error(
        "it is not sure over which columns the heading \"{text}\" stands: write the whole heading of each \
         column in one line, with a semicolon between the columns of the heading and of the rows"
    )]
    HeadingUnplaced {
        /// The heading.
        text: String,
    },
    /// A heading that says how its values are meant, in words that are not clear.
    #[error("the heading \"{heading}\" says how its values are meant, but not clearly: {instead}")]
    Legend {
        /// The heading.
        heading: String,
        /// What to write instead.
        instead: &'static str,
    },
    /// Rows of several records.
    #[error("the table holds several records: {records}; choose one with rows = \"{example}\"")]
    SeveralRecords {
        /// The columns with several values, and these.
        records: String,
        /// The choice of one record.
        example: String,
    },
    /// No row with this value.
    #[error("no row has {name} {value}; there are {known}")]
    NoSuchRows {
        /// The column.
        name: String,
        /// The value.
        value: String,
        /// The values that there are.
        known: String,
    },
    /// The name of a column that cannot choose rows.
    #[error(
        "rows cannot be chosen by {name}; write one of {known} with its value, such as \"VEHNO 1, EDREVENTNO 2\""
    )]
    NoColumn {
        /// What was written.
        name: String,
        /// The columns that can choose rows.
        known: String,
    },
    /// A long table without any of NHTSA's codes for values before or during the impact.
    #[error(
        "no PCODE begins with 1, as before the impact, or 2, as during it; there are {known}; write NHTSA's codes, \
         or a table with a column for each quantity"
    )]
    NoCodes {
        /// The codes that there are.
        known: String,
    },
    /// A choice of rows in a table whose rows are times.
    #[error(
        "`rows` chooses from a long table of NHTSA, with the columns PCODE, PTIME and PVALUE; this table is not one: leave `rows` out"
    )]
    NotLong,
    /// A row without a time.
    #[error(
        "\"{text}\" is not a time; write the time of each row as a number, and leave a row without one out"
    )]
    TimeUnreadable {
        /// The text there.
        text: String,
    },
    /// A time that no record of a crash has.
    #[error(
        "the time \"{text}\" is beyond {} to {} in the unit of its heading, farther from the impact than a record \
         goes; should the heading say ms?", range[0], range[1]
    )]
    TimeFar {
        /// The text there.
        text: String,
        /// (unit of the heading) the least and the greatest possible time.
        range: [f64; 2],
    },
    /// A time that also appears in the row before.
    #[error("the time {time} s appears twice; leave out the row that is wrong")]
    TimeTwice {
        /// (s) the time.
        time: f64,
    },
    /// Two columns of one quantity with different values.
    #[error("two columns give the {channel}, and disagree: {said}; leave out the one that is wrong")]
    Disagree {
        /// The quantity.
        channel: &'static str,
        /// Both values with their headings.
        said: String,
    },
    /// Times that change from rising to falling, or the reverse.
    #[error("the time {time} s follows {before} s, where most times {sense}")]
    TimesTurn {
        /// (s) the time.
        time: f64,
        /// (s) the one before.
        before: f64,
        /// `rise` or `fall`.
        sense: &'static str,
    },
}

impl TextFault {
    /// The refusal of a text for this fault at a place.
    #[must_use]
    pub fn at(self, place: TextPlace) -> TextRefusal {
        TextRefusal { place: Some(place), fault: self }
    }
}

/// Why a text gives no table, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{fault}", place.map(|place| format!("{place}: ")).unwrap_or_default())]
pub struct TextRefusal {
    /// The place in the text, if the fault has one.
    pub place: Option<TextPlace>,
    /// What is wrong there: the message for a caller that shows the place separately.
    pub fault: TextFault,
}

impl From<TextFault> for TextRefusal {
    fn from(fault: TextFault) -> Self {
        Self { place: None, fault }
    }
}
