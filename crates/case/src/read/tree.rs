//! The spanned tree: tables, their keys, and the problems of both.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range as Span;

use toml::Spanned;
use toml::de::Error;

use crate::case_problem::CaseProblem;
use crate::diagnostic::Diagnostic;
use crate::nearest::nearest;
use crate::node::{Entries, Node};
use crate::parser_error::{Kind, ParserError};
use crate::quantity::shorten;
use crate::schema::{Measure, Schema};
use crate::source::Spans;
use crate::toml_slips;
use crate::units_in_use::UnitsInUse;
use inputs::{Bounds, Case, Range, format_number};

/// Maximum number of broken lines that are examined: more than are shown.
const EXPLAINED: usize = 50;

/// Walks the tree, and records the places of everything and the problems.
pub(super) struct Reader<'t> {
    pub(super) text: &'t str,
    spans: Spans,
    problems: Vec<Diagnostic>,
    ranges: BTreeMap<String, Range>,
    document: &'t Entries<'t>,
    units_in_use: OnceCell<UnitsInUse>,
}

/// One table of the file.
pub(super) struct Table<'t> {
    pub(super) path: String,
    pub(super) schema: &'static Schema,
    entries: &'t Entries<'t>,
    /// Known keys that a misspelt one was meant to be: reporting them as missing too would be noise.
    meant: Vec<&'static str>,
}

impl<'t> Table<'t> {
    pub(super) fn get(&self, key: &str) -> Option<&'t Spanned<Node<'t>>> {
        self.entries.get(key)
    }

    /// The value of a key, and the table that it may be, or of which it may be a list.
    fn table_of(&self, key: &str) -> Option<(&'t Spanned<Node<'t>>, &'static Schema)> {
        Some((self.get(key)?, self.schema.key(key)?.form.table()?))
    }

    /// The measure in the row of a key.
    pub(super) fn measure(&self, key: &str) -> Option<Measure> {
        let row = self.schema.key(key)?;
        Some(Measure { example: row.example, ..row.form.measure()? })
    }

    /// The bounds in the row of a plain number.
    pub(super) fn bounds(&self, key: &str) -> Option<Bounds> {
        self.schema.key(key)?.form.bounds()
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    pub(super) fn is_string(&self, key: &str) -> bool {
        self.get(key).is_some_and(|value| value.get_ref().is_str())
    }

    pub(super) fn is_table_or_list(&self, key: &str) -> bool {
        self.get(key).is_some_and(|value| value.get_ref().is_table() || value.get_ref().is_array())
    }

    /// Whether a misspelt key explains what is missing.
    pub(super) fn has_misspelt(&self) -> bool {
        !self.meant.is_empty()
    }

    /// Whether a misspelt key was meant to be this one.
    pub(super) fn means(&self, key: &str) -> bool {
        self.meant.contains(&key)
    }

    /// The place of the key itself, not of its value; empty if it is absent.
    pub(super) fn key_span(&self, key: &str) -> Span<usize> {
        self.entries.keys().find(|name| name.get_ref() == key).map(Spanned::span).unwrap_or_default()
    }

    /// Those of the keys that are present.
    pub(super) fn given(&self, keys: &[&'static str]) -> Vec<&'static str> {
        keys.iter().copied().filter(|key| self.has(key)).collect()
    }

    /// The path of a key, as `vehicle1.crush.width`.
    pub(super) fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() {
            return key.to_owned();
        }
        // Every key of a file passes here, and formatting takes four times as long.
        [&self.path, ".", key].concat()
    }

    /// The name of the table in error texts.
    pub(super) fn label(&self) -> String {
        if self.path.is_empty() { "the top of the file".to_owned() } else { format!("[{}]", self.path) }
    }
}

impl<'t> Reader<'t> {
    pub(super) fn new(text: &'t str, document: &'t Entries<'t>) -> Self {
        Self {
            text,
            spans: Spans::default(),
            problems: Vec::new(),
            ranges: BTreeMap::new(),
            document,
            units_in_use: OnceCell::new(),
        }
    }

    /// A plain number as it was written.
    pub(super) fn written(&self, value: &Spanned<Node<'_>>) -> String {
        let number = match value.get_ref() {
            Node::Number(number) => format_number(*number),
            _ => String::new(),
        };
        self.text.get(value.span()).map_or(number, shorten)
    }

    /// The units of the file, found when the first error needs an example.
    pub(super) fn units_in_use(&self) -> &UnitsInUse {
        self.units_in_use.get_or_init(|| UnitsInUse::of(self.document))
    }

    pub(super) fn report(&mut self, span: Span<usize>, problem: CaseProblem) {
        self.problems.push(Diagnostic::new(Some(span), problem));
    }

    /// Reports what is wrong with a value, which is then not read.
    pub(super) fn unread<T>(&mut self, value: &Spanned<Node<'_>>, problem: CaseProblem) -> Option<T> {
        self.report(value.span(), problem);
        None
    }

    /// Reports a value of the wrong type.
    pub(super) fn wrong_type<T>(
        &mut self,
        value: &Spanned<Node<'_>>,
        path: String,
        wanted: &'static str,
        example: &'static str,
    ) -> Option<T> {
        let found = kind(value.get_ref());
        self.unread(value, CaseProblem::WrongType { path, found, wanted, example })
    }

    /// Whether the file has this key.
    pub(super) fn says(&self, path: &str) -> bool {
        self.spans.get(path).is_some()
    }

    /// Records that a number is uncertain, and its place.
    pub(super) fn add_range(&mut self, span: Span<usize>, range: Range) {
        self.spans.insert(range.path.clone(), span);
        self.ranges.insert(range.path.clone(), range);
    }

    /// The ranges of a case, in the order of its numbers.
    pub(super) fn take_ranges(&mut self, case: &Case) -> Vec<Range> {
        // Most files have none.
        if self.ranges.is_empty() {
            return Vec::new();
        }
        case.inputs().iter().filter_map(|input| self.ranges.remove(&input.path)).collect()
    }

    /// Reports a problem at a key, or at the table that should have it.
    pub(super) fn report_path(&mut self, path: &str, problem: CaseProblem) {
        let span = self.spans.nearest(path);
        self.problems.push(Diagnostic::new(span, problem).about(path));
    }

    /// Reports what is wrong at a key, in a sentence that no other fault has.
    pub(super) fn refuse<T>(&mut self, path: &str, message: String, help: &str) -> Option<T> {
        self.report_path(path, CaseProblem::Fault { message, help: Some(help.to_owned()) });
        None
    }

    /// The document itself, as a table.
    pub(super) fn document(&mut self, entries: &'t Entries<'t>, schema: &'static Schema) -> Table<'t> {
        self.open(String::new(), entries, schema)
    }

    /// A table below another; absent tables and wrong types are `None`, and the latter are reported.
    pub(super) fn child(&mut self, parent: &Table<'t>, key: &'static str) -> Option<Table<'t>> {
        let (value, schema) = parent.table_of(key)?;
        let path = parent.path_of(key);
        if let Some(entries) = value.get_ref().as_table() {
            return Some(self.open(path, entries, schema));
        }
        self.unread(value, CaseProblem::NotATable { path, found: kind(value.get_ref()) })
    }

    /// An inline table; `forms` lists the possible forms of the value.
    pub(super) fn inline(
        &mut self,
        parent: &Table<'t>,
        key: &'static str,
        forms: &'static str,
    ) -> Option<Table<'t>> {
        self.inline_or(parent, key, "a table in braces", forms)
    }

    /// Like [`inline`](Self::inline), for a value that may also be something else.
    pub(super) fn inline_or(
        &mut self,
        parent: &Table<'t>,
        key: &'static str,
        wanted: &'static str,
        forms: &'static str,
    ) -> Option<Table<'t>> {
        let (value, schema) = parent.table_of(key)?;
        let path = parent.path_of(key);
        match value.get_ref().as_table() {
            Some(entries) => Some(self.open(path, entries, schema)),
            None => self.wrong_type(value, path, wanted, forms),
        }
    }

    /// A list of at most `most` tables; `forms` lists the possible forms of the value.
    pub(super) fn tables(
        &mut self,
        parent: &Table<'t>,
        key: &'static str,
        forms: &'static str,
        most: usize,
    ) -> Option<Vec<Table<'t>>> {
        let (value, schema) = parent.table_of(key)?;
        let path = parent.path_of(key);
        let Some(array) = value.get_ref().as_array() else {
            return self.wrong_type(value, path, "a list of tables in braces", forms);
        };
        self.not_too_many(&path, value, array.len(), most)?;
        let mut tables = Vec::new();
        for (index, element) in array.iter().enumerate() {
            let path = format!("{path}[{}]", index + 1);
            if let Some(entries) = element.get_ref().as_table() {
                self.spans.insert(path.clone(), element.span());
                tables.push(self.open(path, entries, schema));
            } else {
                self.wrong_type::<()>(element, path, "a table in braces", forms);
            }
        }
        (tables.len() == array.len()).then_some(tables)
    }

    pub(super) fn open(
        &mut self,
        path: String,
        entries: &'t Entries<'t>,
        schema: &'static Schema,
    ) -> Table<'t> {
        let mut table = Table { path, schema, entries, meant: Vec::new() };
        for (key, value) in entries.iter() {
            let name: &str = key.get_ref();
            if schema.has(name) {
                self.spans.insert(table.path_of(name), value.span());
                continue;
            }
            let other_name = schema.of_other_name(name);
            let meant =
                other_name.or_else(|| schema.without_unit(name)).or_else(|| nearest(name, schema.names()));
            table.meant.extend(meant);
            let is_table = value.get_ref().is_table()
                && self.text.get(value.span()).is_some_and(|text| text.starts_with('['));
            let belongs = if other_name.is_some() { None } else { Schema::belongs(name) };
            let problem = if table.path.is_empty() && is_table && (belongs.is_none() || name == "crush") {
                // "vehicle3" resembles both vehicles, and is neither.
                let nearest =
                    meant.filter(|_| !name.trim_end_matches(|c: char| c.is_ascii_digit()).eq("vehicle"));
                CaseProblem::UnknownTable { table: shorten(name), nearest }
            } else {
                CaseProblem::UnknownKey {
                    table: table.label(),
                    key: shorten(name),
                    nearest: meant,
                    belongs,
                    known: schema.names().collect(),
                }
            };
            self.problems.push(Diagnostic::new(Some(key.span()), problem).about(&table.path_of(name)));
        }
        table
    }

    /// Reports required keys that the table lacks.
    pub(super) fn require(&mut self, table: &Table<'t>, keys: &[&'static str]) {
        for key in keys {
            if !table.has(key) {
                self.missing(table, key);
            }
        }
    }

    pub(super) fn missing(&mut self, table: &Table<'t>, key: &'static str) {
        if table.means(key) {
            return;
        }
        let problem = if table.path.is_empty() {
            CaseProblem::MissingTable { table: key }
        } else {
            CaseProblem::MissingKey { table: table.label(), key, example: table.schema.example(key) }
        };
        self.report_path(&table.path_of(key), problem);
    }

    /// Reports a table whose keys make up none of its forms, unless a misspelt key explains that.
    pub(super) fn no_form<T>(&mut self, table: &Table<'t>, forms: &'static str) -> Option<T> {
        if !table.has_misspelt() {
            let names: Vec<&'static str> = table.schema.names().collect();
            let given = table.given(&names);
            self.report_path(&table.path, CaseProblem::NoForm { path: table.path.clone(), given, forms });
        }
        None
    }

    /// Reports an element of a list that has no key: it would count as an element, but could not be written
    /// back.
    pub(super) fn not_empty(&mut self, table: &Table<'t>, forms: &'static str) {
        let names: Vec<&'static str> = table.schema.names().collect();
        if table.given(&names).is_empty() {
            self.no_form::<()>(table, forms);
        }
    }

    /// The places of all keys, and the problems: those of TOML, and those of the tree that do not follow from
    /// them.
    pub(super) fn finish(self, errors: &[Error]) -> (Spans, Vec<Diagnostic>) {
        let mut errors: Vec<_> =
            errors.iter().map(|error| (error.span().unwrap_or_default(), error.message())).collect();
        errors.sort_by_key(|(span, _)| span.start);

        let newlines: Vec<usize> = self.text.match_indices('\n').map(|(at, _)| at).collect();
        let line = |span: &Span<usize>| newlines.partition_point(|&newline| newline < span.start);
        let mut all = Vec::new();
        let mut broken_lines = BTreeSet::new();
        let mut in_array = false;
        // (bytes) where an unclosed brace or bracket begins: the parser takes everything after it for its
        // content.
        let mut end = usize::MAX;
        // The next line with content after one that runs on into it.
        let mut run_into = None;
        // (bytes) a table with a repeated header, which is reported once.
        let mut double = 0..0;
        for (span, message) in errors {
            let error = ParserError::of(message);
            let is_double = error.kind == Kind::Duplicate;
            if is_double && double.contains(&span.start) {
                continue;
            }
            // The first error of a line causes the others, and an unclosed list makes every later line an
            // error.
            let first_of_line = broken_lines.insert(line(&span));
            let follows = in_array && error.kind == Kind::List;
            in_array |= error.kind == Kind::List;
            if !first_of_line || follows {
                continue;
            }
            if run_into == Some(line(&span)) {
                end = span.start;
                break;
            }
            if toml_slips::runs_on(self.text, span.start) {
                let has_content = |text: &str| !text.trim().is_empty() && !text.trim_start().starts_with('#');
                let mut after = self.text.lines().enumerate().skip(line(&span) + 1);
                run_into = after.find(|(_, text)| has_content(text)).map(|(place, _)| place);
            }
            if is_double && let Some(section) = toml_slips::section_of_header(self.text, span.start) {
                double = section;
            }
            if let Some(open) =
                all.is_empty().then(|| toml_slips::unclosed(self.text, &span, error.kind)).flatten()
            {
                end = open.span.start;
                broken_lines.insert(line(&open.span));
                all.push(Diagnostic::new(Some(open.span), open.problem));
                break;
            }
            let problem = if all.len() < EXPLAINED {
                toml_slips::problem(self.text, &span, error, self.units_in_use())
            } else {
                toml_slips::unexplained(error)
            };
            all.push(Diagnostic::new(Some(span), problem));
        }
        // Keys that seem to be missing may be in the part that could not be read.
        let is_whole = all.is_empty();
        let from_tree = self.problems.into_iter().filter(|diagnostic| {
            let is_missing = matches!(
                diagnostic.problem(),
                CaseProblem::MissingTable { .. }
                    | CaseProblem::MissingKey { .. }
                    | CaseProblem::MissingKeyOfLaw { .. }
                    // The line that names another law may be the one that could not be read.
                    | CaseProblem::KeyOfOtherLaw { is_default: true, .. }
                    | CaseProblem::NoForm { .. }
                    | CaseProblem::NoRangeForm { .. }
            );
            let Some(span) = diagnostic.span() else { return is_whole || !is_missing };
            // The parser puts an empty value where it found none.
            let is_made_up = !is_whole && span.is_empty();
            (is_whole || !is_missing)
                && !is_made_up
                && span.start < end
                && !broken_lines.contains(&line(&span))
        });
        all.extend(from_tree);
        (self.spans, all)
    }
}

/// The kind of a value, as named in error texts.
pub(super) fn kind(value: &Node<'_>) -> &'static str {
    match value {
        Node::String(_) => "a string",
        Node::Number(_) | Node::NotDecimal => "a plain number",
        Node::Quantity(..) => "a number with a unit",
        Node::Boolean(_) => "true or false",
        Node::Datetime => "a date or time",
        Node::Array(_) => "a list",
        Node::Table(_) => "a table",
    }
}
