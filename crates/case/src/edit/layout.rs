//! The layout of a file: the places of its tables, its keys, and the contents of braces and brackets.

use std::ops::Range;

use toml_parser::decoder::Encoding;
use toml_parser::parser::{Event, EventKind, parse_document};
use toml_parser::{Source, Span};

/// One step of the path to a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Key(String),
    /// The index of an element, from 0.
    Element(usize),
}

/// A part of the file that holds entries.
#[derive(Clone, Debug)]
pub(super) struct Container {
    pub(super) kind: Kind,
    /// Path of the table or the list.
    pub(super) path: Vec<Step>,
    /// (bytes) from the header to the next one, or from brace to brace.
    pub(super) span: Range<usize>,
    /// (bytes) the header; empty if it has none.
    pub(super) header: Range<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Everything below a header, or above the first one.
    Section,
    Braces,
    Brackets,
}

/// A key with its value, or an element of a list.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    /// The path from the top of the file.
    pub(super) path: Vec<Step>,
    /// (bytes) the key as written; empty for an element.
    pub(super) key: Range<usize>,
    /// (bytes)
    pub(super) value: Range<usize>,
    /// The index of its container.
    pub(super) within: usize,
}

/// The parts of a file. Containers and entries are in the order of the text, and the entry of a container
/// follows those within it.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) containers: Vec<Container>,
    pub(super) entries: Vec<Entry>,
}

impl Layout {
    /// The layout of a text that is TOML.
    pub(super) fn of(text: &str) -> Self {
        let source = Source::new(text);
        let tokens = source.lex().into_vec();
        let top = Container { kind: Kind::Section, path: Vec::new(), span: 0..text.len(), header: 0..0 };
        let mut reading = Reading {
            source,
            layout: Self { containers: vec![top], entries: Vec::new() },
            open: vec![Open { container: 0, next: 0 }],
            keys: vec![Keys::default()],
            header: None,
        };
        parse_document(&tokens, &mut |event: Event| reading.take(event), &mut ());
        reading.layout
    }

    pub(super) fn entry(&self, path: &[Step]) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.path == path)
    }

    /// The container of a table or of a list.
    pub(super) fn container(&self, path: &[Step]) -> Option<usize> {
        self.containers.iter().position(|container| container.path == path)
    }

    pub(super) fn within(&self, container: usize) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.within == container)
    }

    /// The tables with headers at and below a path.
    pub(super) fn sections(&self, path: &[Step]) -> impl Iterator<Item = &Container> {
        self.containers.iter().filter(move |one| {
            one.kind == Kind::Section && !one.header.is_empty() && one.path.starts_with(path)
        })
    }
}

/// A container that is not closed yet.
struct Open {
    container: usize,
    /// For a list: the index of its next element.
    next: usize,
}

/// The parts of a key that is being read.
#[derive(Default)]
struct Keys {
    steps: Vec<Step>,
    span: Range<usize>,
}

struct Reading<'t> {
    source: Source<'t>,
    layout: Layout,
    open: Vec<Open>,
    /// One for each of `open`.
    keys: Vec<Keys>,
    /// The start of the header that is being read.
    header: Option<usize>,
}

impl Reading<'_> {
    fn take(&mut self, event: Event) {
        let span = event.span();
        match event.kind() {
            EventKind::StdTableOpen | EventKind::ArrayTableOpen => {
                self.header = Some(span.start());
                self.keys = vec![Keys::default()];
                self.open.truncate(1);
            }
            EventKind::StdTableClose => self.section(span.end(), false),
            EventKind::ArrayTableClose => self.section(span.end(), true),
            EventKind::SimpleKey => self.key(span, event.encoding()),
            EventKind::Scalar => self.value(span.start()..span.end()),
            EventKind::InlineTableOpen => self.begin(Kind::Braces, span.start()),
            EventKind::ArrayOpen => self.begin(Kind::Brackets, span.start()),
            EventKind::InlineTableClose | EventKind::ArrayClose => self.end(span.end()),
            _ => {}
        }
    }

    fn key(&mut self, span: Span, encoding: Option<Encoding>) {
        let mut name = String::new();
        if let Some(raw) = self.source.get(span) {
            let raw = toml_parser::Raw::new_unchecked(raw.as_str(), encoding, span);
            raw.decode_key(&mut name, &mut ());
        }
        let Some(keys) = self.keys.last_mut() else { return };
        if keys.steps.is_empty() {
            keys.span.start = span.start();
        }
        keys.span.end = span.end();
        keys.steps.push(Step::Key(name));
    }

    fn section(&mut self, end: usize, is_element: bool) {
        let Some(start) = self.header.take() else { return };
        let keys = self.keys.last_mut().map(std::mem::take).unwrap_or_default();
        let mut path: Vec<Step> = Vec::new();
        let count = keys.steps.len();
        for (n, step) in keys.steps.into_iter().enumerate() {
            path.push(step);
            // Keys below a list of tables belong to its last table.
            let elements = self.elements(&path);
            match elements {
                _ if n + 1 == count && is_element => path.push(Step::Element(elements)),
                0 => {}
                _ => path.push(Step::Element(elements - 1)),
            }
        }
        // The section before ends here.
        if let Some(last) = self.layout.containers.iter_mut().rfind(|one| one.kind == Kind::Section) {
            last.span.end = start;
        }
        let text_end = self.source.input().len();
        let section = Container { kind: Kind::Section, path, span: start..text_end, header: start..end };
        self.layout.containers.push(section);
        self.open = vec![Open { container: self.layout.containers.len() - 1, next: 0 }];
    }

    /// Number of tables with this header, each with a header of its own.
    fn elements(&self, path: &[Step]) -> usize {
        let is_one = |section: &&Container| {
            section.path.len() == path.len() + 1
                && section.path.starts_with(path)
                && matches!(section.path.last(), Some(Step::Element(_)))
        };
        self.layout.sections(path).filter(is_one).count()
    }

    /// The path of the value that begins here.
    fn path(&self) -> Vec<Step> {
        let (Some(open), Some(keys)) = (self.open.last(), self.keys.last()) else { return Vec::new() };
        let Some(container) = self.layout.containers.get(open.container) else { return Vec::new() };
        let mut path = container.path.clone();
        match container.kind {
            Kind::Brackets => path.push(Step::Element(open.next)),
            Kind::Section | Kind::Braces => path.extend(keys.steps.iter().cloned()),
        }
        path
    }

    fn begin(&mut self, kind: Kind, start: usize) {
        let container = Container { kind, path: self.path(), span: start..start, header: 0..0 };
        self.layout.containers.push(container);
        self.open.push(Open { container: self.layout.containers.len() - 1, next: 0 });
        self.keys.push(Keys::default());
    }

    fn end(&mut self, end: usize) {
        let Some(closed) = self.open.pop() else { return };
        self.keys.pop();
        let Some(container) = self.layout.containers.get_mut(closed.container) else { return };
        container.span.end = end;
        let span = container.span.clone();
        self.value(span);
    }

    fn value(&mut self, value: Range<usize>) {
        let path = self.path();
        let (Some(open), Some(keys)) = (self.open.last_mut(), self.keys.last_mut()) else { return };
        open.next += 1;
        let keys = std::mem::take(keys);
        let key = if keys.steps.is_empty() { value.start..value.start } else { keys.span };
        self.layout.entries.push(Entry { path, key, value, within: open.container });
    }
}
