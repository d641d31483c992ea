//! Finds the file of a table, and reads its columns.

use std::borrow::Cow;

use super::cell::{self, CissCell};
use super::error::CissError;
use super::found::CissCrashes;
use super::sas;
use crate::lines::Lines;

/// The files of one year.
pub trait CissFiles {
    /// Why a file cannot be read.
    type Error: From<CissError>;

    /// Their names, with the folders in front of them. Those of folders end in `/`.
    fn names(&self) -> Vec<String>;

    /// The content of one by its place among the names, as it was downloaded.
    ///
    /// # Errors
    /// If it cannot be read.
    fn read(&mut self, place: usize) -> Result<Vec<u8>, Self::Error>;
}

/// A table: its name, the columns that it must have, and those that it may have, with blanks between them.
pub(super) struct Layout {
    pub(super) name: &'static str,
    pub(super) needed: &'static str,
    pub(super) optional: &'static str,
}

pub(super) const CRASH: Layout = Layout { name: "CRASH", needed: "CASEID CRASHYEAR", optional: "" };

pub(super) const GV: Layout = Layout {
    name: "GV",
    needed: "CASEID VEHNO MAKE MODEL MODELYR BODYTYPE CURBWT CARGOWT DVANGTHIS",
    optional: "",
};

pub(super) const CDC: Layout = Layout {
    name: "CDC",
    needed: "CASEID EVENTNO VEHNO CDCPLANE CDC PDOF HEADINGANG FIELDL FIELDLD DIRECTL DIRECTD C1 C2 C3 \
             C4 C5 C6 CMAX DVTOTAL DVLONG DVLAT DVENERGY",
    optional: "OBJCONT",
};

pub(super) const EDREVENT: Layout =
    Layout { name: "EDREVENT", needed: "CASEID VEHNO CDCEVENT MAXDVLONG MAXDVLAT", optional: "" };

pub(super) const EVENT: Layout =
    Layout { name: "EVENT", needed: "CASEID EVENTNO VEHNUM OBJCONT", optional: "" };

/// Whether a folder, by the names of its files, has one of the tables from which pairs are made.
#[must_use]
pub fn has_tables(names: &[String]) -> bool {
    [CRASH, GV, CDC, EDREVENT]
        .iter()
        .any(|table| ENDINGS.iter().any(|ending| named(names, table, ending).next().is_some()))
}

const CSV: &str = ".csv";
const SAS: &str = ".sas7bdat";
const ENDINGS: [&str; 2] = [CSV, SAS];

/// The places of files with the name of a table, in upper or lower case.
fn named<'a>(
    names: &'a [String],
    table: &'a Layout,
    ending: &'a str,
) -> impl Iterator<Item = (usize, &'a String)> {
    let wanted = format!("{}{ending}", table.name);
    let is_named = move |name: &str| {
        name.rsplit(['/', '\\']).next().is_some_and(|file| file.eq_ignore_ascii_case(&wanted))
    };
    names.iter().enumerate().filter(move |(_, name)| is_named(name))
}

/// The place of the file with a table: CSV before SAS.
fn find(names: &[String], table: &Layout) -> Result<usize, CissError> {
    for ending in ENDINGS {
        let mut found = named(names, table, ending);
        match (found.next(), found.next()) {
            (None, _) => {}
            (Some((place, _)), None) => return Ok(place),
            (Some((_, first)), Some((_, second))) => {
                return Err(CissError::Twice { table: table.name, files: [first.clone(), second.clone()] });
            }
        }
    }
    Err(missing(names, table))
}

fn missing(names: &[String], table: &Layout) -> CissError {
    let has = |name| {
        let layout = Layout { name, needed: "", optional: "" };
        ENDINGS.iter().any(|ending| named(names, &layout, ending).next().is_some())
    };
    if has("ACCIDENT") && has("VE") {
        return CissError::Nass;
    }
    let mut files = names.to_vec();
    files.sort();
    CissError::NoTable { table: table.name, files }
}

/// The rows of a table.
pub(super) struct Rows {
    columns: Vec<&'static str>,
    cells: Vec<Vec<CissCell>>,
    /// Its file.
    pub(super) file: String,
    /// (–) number of rows in the file.
    pub(super) count: usize,
}

/// A row.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    columns: &'a [&'static str],
    cells: &'a [CissCell],
}

impl<'a> Row<'a> {
    /// Its cell in a column; `None` if the table lacks the column.
    pub(super) fn cell(self, column: &str) -> Option<&'a CissCell> {
        let place = self.columns.iter().position(|name| *name == column)?;
        self.cells.get(place)
    }

    pub(super) fn number(self, column: &str) -> Option<f64> {
        match self.cell(column)? {
            CissCell::Whole(number) => Some(*number as f64),
            CissCell::Number(number) => Some(*number),
            CissCell::Nothing | CissCell::Text(_) => None,
        }
    }

    pub(super) fn whole(self, column: &str) -> Option<i64> {
        match self.cell(column)? {
            CissCell::Whole(number) => Some(*number),
            _ => None,
        }
    }

    /// A key of several columns; `None` if one of them is empty.
    pub(super) fn key<const N: usize>(self, columns: [&str; N]) -> Option<[i64; N]> {
        let mut key = [0; N];
        for (part, column) in key.iter_mut().zip(columns) {
            *part = self.whole(column)?;
        }
        Some(key)
    }
}

impl Rows {
    /// Reads the rows of a table that are to be kept.
    pub(super) fn read<F: CissFiles>(
        files: &mut F,
        table: &Layout,
        keep: impl Fn(Row<'_>) -> bool,
    ) -> Result<Self, F::Error> {
        let names = files.names();
        let place = find(&names, table)?;
        let content = files.read(place)?;
        let file = names.get(place).cloned().unwrap_or_default();
        let content = if file.to_lowercase().ends_with(SAS) { sas::as_csv(&file, content)? } else { content };
        Ok(Self::of(table, file, &decoded(&content), keep)?)
    }

    fn of(
        table: &Layout,
        file: String,
        text: &str,
        keep: impl Fn(Row<'_>) -> bool,
    ) -> Result<Self, CissError> {
        let mut sheet = Sheet::open(&file, text)?;
        let places = sheet.places(table)?;
        let columns: Vec<_> = places.iter().map(|place| place.column).collect();
        let (mut kept, mut count) = (Vec::new(), 0);
        sheet.cells(&places, |cells| {
            count += 1;
            if keep(Row { columns: &columns, cells: &cells }) {
                kept.push(cells);
            }
        })?;
        Ok(Self { columns, cells: kept, file, count })
    }

    pub(super) fn has(&self, column: &str) -> bool {
        self.columns.contains(&column)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Row<'_>> {
        self.cells.iter().map(|cells| Row { columns: &self.columns, cells })
    }
}

/// Reads a saved table of pairs: a row for each pair with a cell for each of its
/// [columns](CissCrashes::columns).
///
/// # Errors
/// If it is another table, with the file, the line and the column.
pub fn read_pairs(file: &str, content: &[u8]) -> Result<Vec<Vec<CissCell>>, CissError> {
    let columns = CissCrashes::columns(false);
    let text = decoded(content);
    let mut sheet = Sheet::open(file, &text)?;
    let place = |column: &'_ str| {
        sheet
            .place(column)?
            .ok_or_else(|| CissError::NoPairColumn { file: file.to_owned(), column: column.to_owned() })
    };
    let places: Vec<_> = columns
        .iter()
        .map(|column| Ok(Place { column: &column.name, of: column.of, place: place(&column.name)? }))
        .collect::<Result<_, CissError>>()?;
    let mut rows = Vec::new();
    sheet.cells(&places, |cells| rows.push(cells))?;
    Ok(rows)
}

/// A column that is read.
struct Place<'a> {
    column: &'a str,
    /// Its name at NHTSA.
    of: &'static str,
    /// Its place in the header.
    place: usize,
}

/// A file of comma-separated values.
struct Sheet<'a> {
    file: &'a str,
    reader: csv::Reader<&'a [u8]>,
    header: csv::StringRecord,
    lines: Lines<'a>,
}

impl<'a> Sheet<'a> {
    fn open(file: &'a str, text: &'a str) -> Result<Self, CissError> {
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
        let header = reader.headers().map_err(|reason| not_table(file, reason))?.clone();
        Ok(Self { file, reader, header, lines: Lines::of(text) })
    }

    fn place(&self, column: &str) -> Result<Option<usize>, CissError> {
        let is_it = |name: &str| name.trim().eq_ignore_ascii_case(column);
        let mut places =
            self.header.iter().enumerate().filter(|(_, name)| is_it(name)).map(|(place, _)| place);
        match (places.next(), places.next()) {
            (Some(_), Some(_)) => {
                Err(CissError::ColumnTwice { file: self.file.to_owned(), column: column.to_owned() })
            }
            (found, _) => Ok(found),
        }
    }

    /// The columns of a table that are read.
    fn places(&self, table: &Layout) -> Result<Vec<Place<'static>>, CissError> {
        let (mut found, mut missing) = (Vec::new(), Vec::new());
        for column in table.needed.split(' ') {
            match self.place(column)? {
                Some(place) => found.push(Place { column, of: column, place }),
                None => missing.push(column),
            }
        }
        for column in table.optional.split_whitespace() {
            found.extend(self.place(column)?.map(|place| Place { column, of: column, place }));
        }
        if missing.is_empty() {
            return Ok(found);
        }
        let has = self.header.iter().map(|name| name.trim().to_owned()).collect();
        Err(CissError::NoColumn { table: table.name, file: self.file.to_owned(), columns: missing, has })
    }

    /// The cells of each row in turn.
    fn cells(&mut self, places: &[Place<'_>], mut each: impl FnMut(Vec<CissCell>)) -> Result<(), CissError> {
        let mut record = csv::StringRecord::new();
        while self.reader.read_record(&mut record).map_err(|reason| not_table(self.file, reason))? {
            let line = self.lines.place(&record);
            let (cells, columns) = (record.len(), self.header.len());
            if cells != columns {
                return Err(CissError::Cells { file: self.file.to_owned(), line, cells, columns });
            }
            let cell = |place: &Place<'_>| {
                let text = record.get(place.place).unwrap_or_default();
                cell::read(place.of, text).map_err(|wanted| CissError::Cell {
                    file: self.file.to_owned(),
                    line,
                    column: place.column.to_owned(),
                    text: text.trim().to_owned(),
                    wanted,
                })
            };
            each(places.iter().map(cell).collect::<Result<_, _>>()?);
        }
        Ok(())
    }
}

fn not_table(file: &str, reason: csv::Error) -> CissError {
    CissError::Table { file: file.to_owned(), reason }
}

/// A text in UTF-8, or else in Latin-1.
fn decoded(content: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(content) {
        Ok(text) => Cow::Borrowed(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(_) => Cow::Owned(content.iter().copied().map(char::from).collect()),
    }
}
