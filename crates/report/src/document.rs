//! The content of a document, independent of its format: the sections fill its parts, and the writers write
//! them.

use std::fmt;
use std::sync::Arc;

use ::drawing::Drawing;
use case::Text;

use crate::steps::StepGroup;
use crate::words;

/// A document of the program. [`text`](Self::text), [`markdown`](Self::markdown) and [`html`](Self::html)
/// write it.
#[derive(Clone, Debug)]
pub struct Document {
    pub(crate) blocks: Vec<Block>,
    /// (columns) of a line of text: the smallest number that its tables need, and the largest that they use.
    pub(crate) columns: [usize; 2],
}

/// (columns) of a page of text, unless a terminal says otherwise.
pub(crate) const LINE: usize = 98;

/// A part of a document.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// The title of the document, and the source of the case.
    Title {
        title: String,
        source: Option<String>,
    },
    Heading(String),
    Subheading(String),
    Paragraph(String),
    /// The findings, one line each, and the method.
    Answer {
        found: Vec<String>,
        how: String,
    },
    /// The number of warnings, which are listed under this heading.
    Notice {
        count: String,
        heading: Option<&'static str>,
    },
    /// Codes and sentences, with a note below them.
    Warnings {
        warnings: Vec<(&'static str, String)>,
        more: &'static str,
    },
    List(Vec<String>),
    /// Numbered from 1.
    Notes(Vec<String>),
    /// Name and value.
    Facts {
        title: &'static str,
        facts: Vec<(&'static str, String)>,
    },
    /// Names and their explanations, which may take several lines.
    Entries(Vec<(String, String)>),
    Table(Table),
    Steps(StepGroup),
    Drawing(Box<Drawing>),
    /// A drawing in HTML; in other formats the equivalent table, if there is one.
    Chart {
        /// Unique among the drawings of the page, for [`Drawing::svg_named`].
        name: String,
        drawing: Undrawn,
        instead: Option<Table>,
    },
    /// A drawing that is a file of its own next to a page of Markdown.
    Picture {
        file: &'static str,
        says: &'static str,
        drawing: Box<Drawing>,
    },
    /// A text to keep verbatim.
    Listing {
        language: &'static str,
        text: String,
    },
}

/// A drawing that is made on demand, because only HTML shows it.
#[derive(Clone)]
pub(crate) struct Undrawn(Arc<dyn Fn() -> Drawing + Send + Sync>);

impl Undrawn {
    pub(crate) fn new(draw: impl Fn() -> Drawing + Send + Sync + 'static) -> Self {
        Self(Arc::new(draw))
    }

    pub(crate) fn draw(&self) -> Drawing {
        (self.0)()
    }
}

impl fmt::Debug for Undrawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Undrawn").finish_non_exhaustive()
    }
}

/// Rows under named columns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// Empty if the first column has a name of its own.
    pub(crate) title: String,
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Row>,
    /// Sentences about the table, right below it.
    pub(crate) notes: Vec<String>,
}

#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) name: String,
    /// Below the name.
    pub(crate) unit: String,
    /// Between name and unit on one line.
    joint: &'static str,
    pub(crate) cells: Cells,
    pub(crate) width: Width,
}

/// The kind of cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cells {
    /// Left-aligned.
    Words,
    /// Right-aligned.
    Numbers,
    /// Bars made of characters, in which every blank counts.
    Bars,
}

/// The width of a column of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    /// This many characters, including the blanks before the next column.
    Fixed(usize),
    /// As its longest cell, at least this many characters if there is room, and two blanks before the next
    /// column.
    Fit(usize),
    /// The width that the others leave, divided among all columns with this width.
    Share,
}

/// A number alone is that of characters.
impl From<usize> for Width {
    fn from(characters: usize) -> Self {
        Self::Fixed(characters)
    }
}

#[derive(Clone, Debug)]
pub(crate) enum Row {
    /// One cell for each column; a cell may have several lines.
    Cells(Vec<String>),
    /// A value that belongs to all columns between the first and the last.
    Shared { label: String, value: String, source: String },
    /// A sentence about the row above.
    Detail(String),
}

impl Column {
    pub(crate) fn words(name: impl Into<String>, width: impl Into<Width>) -> Self {
        Self { name: name.into(), unit: String::new(), joint: ", ", cells: Cells::Words, width: width.into() }
    }

    pub(crate) fn numbers(name: impl Into<String>, width: impl Into<Width>) -> Self {
        Self { cells: Cells::Numbers, ..Self::words(name, width) }
    }

    pub(crate) fn bars(name: impl Into<String>, width: impl Into<Width>) -> Self {
        Self { cells: Cells::Bars, ..Self::words(name, width) }
    }

    pub(crate) fn unit(self, unit: impl Into<String>) -> Self {
        Self { unit: unit.into(), ..self }
    }

    /// With the rest of its name in place of a unit.
    pub(crate) fn goes_on(self, rest: impl Into<String>) -> Self {
        Self { unit: rest.into(), joint: " ", ..self }
    }

    /// Name and unit on one line.
    pub(crate) fn heading(&self) -> String {
        match (self.name.as_str(), self.unit.as_str()) {
            ("", unit) => unit.to_owned(),
            (name, "") => name.to_owned(),
            (name, unit) => format!("{name}{}{unit}", self.joint),
        }
    }
}

/// The placeholder for a missing value.
pub(crate) const NONE: &str = "–";

impl Table {
    /// A table without columns yet.
    pub(crate) fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// With these columns.
    pub(crate) fn columns(self, columns: impl Into<Vec<Column>>) -> Self {
        Self { columns: columns.into(), ..self }
    }

    /// A table of values for both vehicles, each row with its source.
    pub(crate) fn of_vehicles(title: &str) -> Self {
        Self::of_two(title, ["vehicle 1", "vehicle 2", "source"])
    }

    /// A table of values for any two things, with their source.
    pub(crate) fn of_two(title: &str, [first, second, source]: [&str; 3]) -> Self {
        Self::new(title).columns([
            Column::words("", 32),
            Column::words(first, Width::Share),
            Column::words(second, Width::Share),
            Column::words(source, 12),
        ])
    }

    pub(crate) fn cells(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(Row::Cells(cells.into_iter().collect()));
    }

    pub(crate) fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(Row::Cells(cells.into()));
    }

    /// A sentence about the table, right below it.
    pub(crate) fn note(&mut self, words: impl Into<String>) {
        self.notes.push(words.into());
    }

    /// A row with a value or a dash for each vehicle; no row if neither has a value.
    pub(crate) fn pair(&mut self, label: &str, values: [Option<String>; 2], source: &str) {
        if values.iter().any(Option::is_some) {
            let [first, second] = values.map(|value| value.unwrap_or_else(|| NONE.to_owned()));
            self.row([label.to_owned(), first, second, source.to_owned()]);
        }
    }

    /// A row with one value, which belongs to neither vehicle.
    pub(crate) fn shared(&mut self, label: &str, value: &str, source: &str) {
        let [label, value, source] = [label, value, source].map(str::to_owned);
        self.rows.push(Row::Shared { label, value, source });
    }
}

impl From<Table> for Block {
    fn from(table: Table) -> Self {
        Self::Table(table)
    }
}

impl Document {
    pub(crate) fn new() -> Self {
        Self { blocks: Vec::new(), columns: [LINE, LINE] }
    }

    /// For lines of fewer or more columns.
    pub(crate) fn with_columns(self, columns: [usize; 2]) -> Self {
        Self { columns, ..self }
    }

    pub(crate) fn push(&mut self, block: impl Into<Block>) {
        self.blocks.push(block.into());
    }

    pub(crate) fn tables(&mut self, tables: impl IntoIterator<Item = Table>) {
        self.blocks.extend(tables.into_iter().map(Block::Table));
    }

    /// A chart, which is drawn only if it is shown, without an equivalent table.
    pub(crate) fn chart(
        &mut self,
        name: impl Into<String>,
        draw: impl Fn() -> Drawing + Send + Sync + 'static,
    ) {
        self.push(Block::Chart { name: name.into(), drawing: Undrawn::new(draw), instead: None });
    }

    pub(crate) fn title(&mut self, case: &case::Case) {
        let source = case.source.as_ref().map(Text::to_string);
        self.push(Block::Title { title: words::title(case), source });
    }

    /// A new document with only the title of a case.
    ///
    /// ```
    /// let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
    /// let mut page = report::Document::of_case(&file.case);
    /// page.heading("Stop");
    /// page.facts("", vec![("Time", "1.5 s".to_owned())]);
    /// page.paragraph("From 54 km/h at 10 m/s².");
    /// assert!(page.text().contains("1.5 s"));
    /// # Ok::<(), case::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn of_case(case: &case::Case) -> Self {
        let mut page = Self::new();
        page.title(case);
        page
    }

    /// Adds names and values.
    pub fn facts(&mut self, title: &'static str, facts: Vec<(&'static str, String)>) {
        self.push(Block::Facts { title, facts });
    }

    /// Begins a part.
    pub fn heading(&mut self, heading: impl Into<String>) {
        self.push(Block::Heading(heading.into()));
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, words: impl Into<String>) {
        self.push(Block::Paragraph(words.into()));
    }

    /// Adds another document as one of its parts: without its title and warnings, and with its headings one
    /// level lower.
    pub(crate) fn part(&mut self, heading: &str, part: Self) {
        self.heading(heading);
        self.blocks.extend(part.blocks.into_iter().filter_map(|block| match block {
            Block::Title { .. } | Block::Notice { .. } | Block::Warnings { .. } => None,
            Block::Heading(heading) => Some(Block::Subheading(heading)),
            other => Some(other),
        }));
    }

    /// The charts that appear in its HTML but not in its text, each with its name.
    pub fn charts(&self) -> impl Iterator<Item = (&str, Drawing)> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Chart { name, drawing, .. } => Some((name.as_str(), drawing.draw())),
            _ => None,
        })
    }

    /// The findings, one line each; empty if the document has many answers.
    #[must_use]
    pub fn headline(&self) -> &[String] {
        let answers = self.blocks.iter().find_map(|block| match block {
            Block::Answer { found, .. } => Some(found.as_slice()),
            _ => None,
        });
        answers.unwrap_or_default()
    }
}
