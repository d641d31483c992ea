//! Changes one key of a case file, and keeps every other character as it is.
//!
//! The parser of `toml` gives the place of each key and value (`layout`), and the text is cut there.
//! `toml_edit`, which writes the whole file anew from its tree, would also change other characters: it drops
//! `\r` and a byte order mark, sorts dotted keys by their table, removes the comment above a removed key, and
//! adds a key only at the end of its table: see the test `toml_edit_would_change_more_than_the_key`.

mod layout;

use std::ops::Range;

use thiserror::Error;
use toml::de::DeTable;

use crate::keys::{Way, way};
use layout::{Container, Entry, Kind, Layout, Step};

/// A text with the new value of a key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edited {
    /// The whole text.
    pub text: String,
    /// (bytes) place of the new value in it.
    pub span: Range<usize>,
}

/// Why a key cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EditError {
    /// The text is not TOML, so its keys cannot be located.
    #[error("the file cannot be read as TOML: {message}; correct that first")]
    NotToml {
        /// What is wrong with it.
        message: String,
        /// (bytes) place of the error.
        span: Option<Range<usize>>,
    },
    /// No case has this key.
    #[error("a case file has no key \"{}\"", inputs::shown(key))]
    UnknownKey {
        /// The requested key.
        key: String,
    },
    /// The value is not a TOML value such as `"10 mph"`, `0.3` or `{ x = "1 m", y = "2 m" }`.
    #[error(
        "{} is not a value of TOML: write a number with its unit in quotation marks",
        inputs::shown(value)
    )]
    NotAValue {
        /// The given value.
        value: String,
    },
    /// The list ends before this element, but not right before it.
    #[error("the list of \"{}\" is too short to have this element", inputs::shown(key))]
    NoElement {
        /// The requested key.
        key: String,
    },
}

/// Sets a key to a value, which is TOML: `"\"10 mph\""`, `"0.3"`, `"{ x = \"1 m\", y = \"2 m\" }"`. An
/// existing value is replaced. A missing key is added after those that usually precede it, with the table
/// that it needs. Everything else, comments included, stays as it is.
///
/// ```
/// let text = "[vehicle1]\nmass = \"1500 kg\" # weighed\n";
/// let edited = case::edit::set(text, "vehicle1.mass", "\"1520 kg\"")?;
/// assert_eq!(edited.text, "[vehicle1]\nmass = \"1520 kg\" # weighed\n");
/// let edited = case::edit::set(&edited.text, "vehicle1.crush.side", "\"front\"")?;
/// assert_eq!(edited.text, "[vehicle1]\nmass = \"1520 kg\" # weighed\n\n[vehicle1.crush]\nside = \"front\"\n");
/// # Ok::<(), case::edit::EditError>(())
/// ```
///
/// # Errors
///
/// [`EditError`].
pub fn set(text: &str, key: &str, value: &str) -> Result<Edited, EditError> {
    let value = checked_value(value)?;
    let way = way(key).ok_or_else(|| EditError::UnknownKey { key: key.to_owned() })?;
    is_toml(text)?;
    Editor::new(text).set(key, &way, value)
}

/// Removes a key with its line or, if it is a table, the whole table. An inline table without another key
/// goes as well, unless it is a list element followed by others, whose indices would change. A text without
/// this key stays as it is.
///
/// ```
/// let text = "[impact]\nlaw = \"woolley\" # a sideswipe\ntangential_velocity_change = \"3 m/s\"\n";
/// assert_eq!(case::edit::remove(text, "impact.tangential_velocity_change")?, "[impact]\nlaw = \"woolley\" # a sideswipe\n");
/// assert_eq!(case::edit::remove(text, "impact.restitution")?, text);
/// # Ok::<(), case::edit::EditError>(())
/// ```
///
/// # Errors
///
/// [`EditError`].
pub fn remove(text: &str, key: &str) -> Result<String, EditError> {
    let way = way(key).ok_or_else(|| EditError::UnknownKey { key: key.to_owned() })?;
    is_toml(text)?;
    Ok(Editor::new(text).remove(&steps(&way)))
}

fn steps(way: &[Way]) -> Vec<Step> {
    way.iter()
        .map(|way| way.name.map_or(Step::Element(way.element), |name| Step::Key(name.to_owned())))
        .collect()
}

/// The value without surrounding spaces, if it is a TOML value.
fn checked_value(value: &str) -> Result<&str, EditError> {
    let trimmed = value.trim();
    let line = format!("x = {trimmed}\n");
    let parsed = DeTable::parse(&line).ok();
    let is_whole = parsed.is_some_and(|table| {
        let table = table.into_inner();
        let span = table.get("x").map(toml::Spanned::span);
        table.len() == 1 && span == Some(4..4 + trimmed.len())
    });
    if is_whole { Ok(trimmed) } else { Err(EditError::NotAValue { value: value.to_owned() }) }
}

fn is_toml(text: &str) -> Result<(), EditError> {
    let error = |error: toml::de::Error| EditError::NotToml {
        message: error.message().to_owned(),
        span: error.span(),
    };
    DeTable::parse(text).map(drop).map_err(error)
}

struct Editor<'t> {
    text: &'t str,
    layout: Layout,
    newline: &'static str,
}

impl<'t> Editor<'t> {
    fn new(text: &'t str) -> Self {
        let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
        Self { text, layout: Layout::of(text), newline }
    }

    /// The text with a place replaced, and the place of the new value.
    fn replaced(&self, place: Range<usize>, before: &str, value: &str, after: &str) -> Edited {
        let Self { text, .. } = self;
        let start = place.start + before.len();
        Edited {
            text: [&text[..place.start], before, value, after, &text[place.end..]].concat(),
            span: start..start + value.len(),
        }
    }

    fn set(&self, key: &str, way: &[Way], value: &str) -> Result<Edited, EditError> {
        let path = steps(way);
        if let Some(entry) = self.layout.entry(&path) {
            return Ok(self.replaced(entry.value.clone(), "", value, ""));
        }
        // A word or number becomes a table, or the other way round.
        let in_the_way = (1..path.len()).find_map(|n| {
            let entry = self.layout.entry(&path[..n])?;
            self.layout.container(&path[..n]).is_none().then_some((n, entry))
        });
        if let Some((n, entry)) = in_the_way {
            if way[n - 1].has_header {
                let text = self.remove(&path[..n]);
                return Editor::new(&text).set(key, way, value);
            }
            let (before, after) = nested(&way[n..], key)?;
            return Ok(self.replaced(entry.value.clone(), &before, value, &after));
        }
        if self.is_in_parts(&path) {
            let text = self.remove(&path);
            return Editor::new(&text).set(key, way, value);
        }
        self.add(key, way, &path, value)
    }

    /// Whether it is a table with headers or with dotted keys.
    fn is_in_parts(&self, path: &[Step]) -> bool {
        self.layout.sections(path).next().is_some() || self.dotted(path).next().is_some()
    }

    /// Entries below a path, whose container is above it.
    fn dotted<'a>(&'a self, path: &'a [Step]) -> impl Iterator<Item = &'a Entry> {
        let entries = self.layout.entries.iter();
        entries.filter(move |entry| {
            let container = self.layout.containers.get(entry.within);
            entry.path.starts_with(path)
                && entry.path.len() > path.len()
                && container.is_some_and(|container| container.path.len() < path.len())
        })
    }

    fn add(&self, key: &str, way: &[Way], path: &[Step], value: &str) -> Result<Edited, EditError> {
        for depth in (0..path.len()).rev() {
            if let Some(index) = self.layout.container(&path[..depth]) {
                return self.add_within(index, depth, key, way, value);
            }
            if let Some(entry) = self.dotted(&path[..depth]).last() {
                let depth = self.layout.containers.get(entry.within).map_or(0, |one| one.path.len());
                let dotted = path.len();
                let names: Vec<&str> = way[depth..dotted].iter().filter_map(|way| way.name).collect();
                let entry = entry.clone();
                return Ok(self.behind(&entry, &names.join("."), value));
            }
            if let Some(Step::Element(element)) = path.get(depth)
                && let Some(last) = self.last_element(&path[..depth])
            {
                // A list of tables, each with its own header.
                if last + 1 != *element || depth + 1 == path.len() {
                    return Err(EditError::NoElement { key: key.to_owned() });
                }
                return self.add_section(depth + 1, true, key, way, value);
            }
        }
        // The top of the file is a container.
        Err(EditError::NoElement { key: key.to_owned() })
    }

    fn last_element(&self, path: &[Step]) -> Option<usize> {
        self.layout
            .sections(path)
            .filter_map(|section| match section.path.get(path.len()) {
                Some(Step::Element(element)) => Some(*element),
                _ => None,
            })
            .max()
    }

    /// Adds the key to the container of the first `depth` steps.
    fn add_within(
        &self,
        index: usize,
        depth: usize,
        key: &str,
        way: &[Way],
        value: &str,
    ) -> Result<Edited, EditError> {
        let Some(container) = self.layout.containers.get(index) else {
            return Err(EditError::NoElement { key: key.to_owned() });
        };
        let rest = &way[depth..];
        match container.kind {
            Kind::Brackets => {
                let last = self.layout.within(index).last();
                if rest.first().map(|way| way.element) != Some(self.layout.within(index).count()) {
                    return Err(EditError::NoElement { key: key.to_owned() });
                }
                let (before, after) = nested(&rest[1..], key)?;
                Ok(match last {
                    Some(last) => {
                        let end = last.value.end;
                        self.replaced(end..end, &format!(", {before}"), value, &after)
                    }
                    None => {
                        let inside = container.span.start + 1..container.span.end - 1;
                        self.replaced(inside, &before, value, &after)
                    }
                })
            }
            // A table has no elements.
            Kind::Braces | Kind::Section if rest.first().is_some_and(|way| way.name.is_none()) => {
                Err(EditError::NoElement { key: key.to_owned() })
            }
            Kind::Braces => {
                let (before, after) = nested(rest, key)?;
                // Without the braces of this table itself.
                let before = before.trim_start_matches('{').trim_start();
                let after = after.strip_suffix(" }").unwrap_or(&after);
                Ok(match (self.neighbour(index, rest), self.layout.within(index).next()) {
                    (Some(entry), _) => {
                        let end = entry.value.end;
                        self.replaced(end..end, &format!(", {before}"), value, after)
                    }
                    (None, Some(first)) => {
                        let start = first.key.start;
                        self.replaced(start..start, before, value, &format!("{after}, "))
                    }
                    (None, None) => {
                        let inside = container.span.start + 1..container.span.end - 1;
                        self.replaced(inside, &format!(" {before}"), value, &format!("{after} "))
                    }
                })
            }
            Kind::Section => {
                let headers = rest[..rest.len() - 1].iter().take_while(|way| way.has_header).count();
                if headers > 0 {
                    return self.add_section(depth + headers, false, key, way, value);
                }
                let (before, after) = nested(&rest[1..], key)?;
                let name = rest.first().and_then(|way| way.name).unwrap_or_default();
                let value_of_line = format!("{before}{value}{after}");
                let edited = match (self.neighbour(index, rest), self.layout.within(index).next()) {
                    (Some(entry), _) => self.behind(entry, name, &value_of_line),
                    (None, Some(first)) if container.header.is_empty() => {
                        let start = self.line_start(first.key.start);
                        let line = self.line_like(first, name);
                        self.replaced(start..start, &line, &value_of_line, self.newline)
                    }
                    (None, first) if !container.header.is_empty() => {
                        let line =
                            first.map_or_else(|| format!("{name} = "), |first| self.line_like(first, name));
                        self.new_line(self.line_end(container.header.end), &line, &value_of_line, "")
                    }
                    (None, _) => {
                        let at = self.end_of(container);
                        let gap = if at < self.text.len() { self.newline } else { "" };
                        self.new_line(at, &format!("{name} = "), &value_of_line, gap)
                    }
                };
                let start = edited.span.start + before.len();
                Ok(Edited { span: start..start + value.len(), ..edited })
            }
        }
    }

    /// The last of the entries that usually precede it.
    fn neighbour(&self, index: usize, rest: &[Way]) -> Option<&Entry> {
        let depth = self.layout.containers.get(index)?.path.len();
        let rank = rest.first()?.rank;
        let of = |entry: &&Entry| {
            let way = way(&written(&entry.path))?;
            way.get(depth).map(|way| way.rank)
        };
        let before = self.layout.within(index).filter(|entry| of(entry).is_some_and(|other| other < rank));
        before.max_by_key(|entry| (of(entry), entry.value.end))
    }

    /// Adds a key after an entry: on its own line, or within the same braces.
    fn behind(&self, entry: &Entry, name: &str, value: &str) -> Edited {
        if self.layout.containers.get(entry.within).is_some_and(|one| one.kind == Kind::Braces) {
            let end = entry.value.end;
            return self.replaced(end..end, &format!(", {name} = "), value, "");
        }
        self.new_line(self.line_end(entry.value.end), &self.line_like(entry, name), value, "")
    }

    /// Adds a line below the one that ends here.
    fn new_line(&self, at: usize, before: &str, value: &str, after: &str) -> Edited {
        let newline = self.newline;
        if at == 0 || self.text[..at].ends_with('\n') {
            return self.replaced(at..at, before, value, &format!("{newline}{after}"));
        }
        self.replaced(at..at, &format!("{newline}{before}"), value, &format!("{newline}{after}"))
    }

    /// A line up to its value, indented and aligned like another one of its table.
    fn line_like(&self, entry: &Entry, name: &str) -> String {
        let start = self.line_start(entry.key.start);
        let indent: String =
            self.text[start..entry.key.start].chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
        let column = self
            .layout
            .within(entry.within)
            .filter_map(|entry| {
                let between = &self.text[entry.key.end..entry.value.start];
                let blanks = between.find('=')?;
                // A single space is not an alignment.
                (blanks > 1).then_some(entry.key.len() + blanks)
            })
            .max()
            .unwrap_or(0);
        let blanks = " ".repeat(column.saturating_sub(name.len()).max(1));
        format!("{indent}{name}{blanks}= ")
    }

    fn line_start(&self, at: usize) -> usize {
        let start = self.text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        // Nothing precedes a byte order mark.
        if self.text[start..].starts_with('\u{feff}') { start + '\u{feff}'.len_utf8() } else { start }
    }

    /// The place after the line break.
    fn line_end(&self, at: usize) -> usize {
        self.text[at..].find('\n').map_or(self.text.len(), |newline| at + newline + 1)
    }

    /// Adds a table of the first `depth` steps with its own header.
    fn add_section(
        &self,
        depth: usize,
        is_element: bool,
        key: &str,
        way: &[Way],
        value: &str,
    ) -> Result<Edited, EditError> {
        let names: Vec<&str> = way[..depth].iter().filter_map(|way| way.name).collect();
        let name = names.join(".");
        let header = if is_element { format!("[[{name}]]") } else { format!("[{name}]") };
        let (before, after) = nested(&way[depth + 1..], key)?;
        let last = way[depth].name.unwrap_or_default();
        let rank = |path: &[Step]| -> Option<Vec<usize>> {
            let way = crate::keys::way(&written(path))?;
            Some(way.iter().map(|way| way.rank).collect())
        };
        let own: Vec<usize> = way[..depth].iter().map(|way| way.rank).collect();
        let sections = self.layout.containers.iter().filter(|one| one.kind == Kind::Section);
        let before_it = sections.filter(|section| rank(&section.path).is_some_and(|other| other < own));
        let place = before_it.max_by_key(|section| (rank(&section.path), section.span.start));
        let at = place.map_or(0, |section| self.end_of(section));
        let newline = self.newline;
        let mut lead = String::new();
        if at > 0 && !self.text[..at].ends_with('\n') {
            lead.push_str(newline);
        }
        if !self.text[..at].trim_start_matches('\u{feff}').is_empty() {
            lead.push_str(newline);
        }
        let rest = &self.text[at..];
        let begins_blank = rest.is_empty() || rest.starts_with('\n') || rest.starts_with("\r\n");
        let gap = if begins_blank { "" } else { newline };
        let before = format!("{lead}{header}{newline}{last} = {before}");
        Ok(self.replaced(at..at, &before, value, &format!("{after}{newline}{gap}")))
    }

    /// The end of the last line that belongs to a section: comments right above the next header belong to
    /// that header.
    fn end_of(&self, section: &Container) -> usize {
        let mut end = section.span.end;
        let body = section.header.end.max(self.line_start(0));
        let line_before = |end: usize| {
            let start = self.text[..end.saturating_sub(1)].rfind('\n').map_or(0, |newline| newline + 1);
            start.max(body)
        };
        if end < self.text.len() {
            let mut start = end;
            while start > body && self.text[line_before(start)..start].trim_start().starts_with('#') {
                start = line_before(start);
            }
            // Comments at the very top belong to the file.
            if start > body || !section.header.is_empty() {
                end = start;
            }
        }
        while end > body && self.text[line_before(end)..end].trim().is_empty() {
            end = line_before(end);
        }
        end
    }

    fn remove(&self, path: &[Step]) -> String {
        if let Some(entry) = self.layout.entry(path) {
            return self.without(entry);
        }
        let of_dotted = self.dotted(path).map(|entry| self.place_of(entry));
        let of_sections = self.layout.sections(path).map(|section| {
            let start = self.line_start(section.header.start);
            let mut end = self.end_of(section);
            // With the blank lines below it, because those above it stay.
            while end < section.span.end && self.text[end..self.line_end(end)].trim().is_empty() {
                end = self.line_end(end);
            }
            start..end
        });
        let mut places: Vec<Range<usize>> = of_dotted.chain(of_sections).collect();
        places.sort_by_key(|place| place.start);
        let mut text = String::new();
        let mut done = 0;
        for place in places {
            text.push_str(&self.text[done..place.start.max(done)]);
            done = done.max(place.end);
        }
        text.push_str(&self.text[done..]);
        text
    }

    fn without(&self, entry: &Entry) -> String {
        let Some(container) = self.layout.containers.get(entry.within) else { return self.text.to_owned() };
        let is_alone = self.layout.within(entry.within).count() == 1;
        if container.kind != Kind::Section && is_alone {
            // An element of a list of tables has no entry of its own. The elements after an inline table keep
            // their indices.
            if let Some(of_container) = self.layout.entry(&container.path)
                && !self.is_followed(of_container)
            {
                return self.without(of_container);
            }
        }
        let place = self.place_of(entry);
        [&self.text[..place.start], &self.text[place.end..]].concat()
    }

    /// Whether it is an element of a list with others after it.
    fn is_followed(&self, entry: &Entry) -> bool {
        matches!(entry.path.last(), Some(Step::Element(_)))
            && self.layout.within(entry.within).any(|other| other.value.start > entry.value.start)
    }

    /// (bytes) an entry with its line or its comma.
    fn place_of(&self, entry: &Entry) -> Range<usize> {
        let is_section =
            self.layout.containers.get(entry.within).is_some_and(|one| one.kind == Kind::Section);
        if is_section {
            return self.line_start(entry.key.start)..self.line_end(entry.value.end);
        }
        let siblings: Vec<&Entry> = self.layout.within(entry.within).collect();
        let at = siblings.iter().position(|one| one.value == entry.value).unwrap_or_default();
        match (siblings.get(at + 1), at.checked_sub(1).and_then(|before| siblings.get(before))) {
            (Some(next), _) => entry.key.start..next.key.start,
            (None, Some(before)) => before.value.end..entry.value.end,
            (None, None) => entry.key.start..entry.value.end,
        }
    }
}

/// The text before and after a value that is nested in inline tables of these steps.
fn nested(way: &[Way], key: &str) -> Result<(String, String), EditError> {
    let (mut before, mut after) = (String::new(), String::new());
    for way in way {
        match way.name {
            Some(name) => {
                before.push_str(&format!("{{ {name} = "));
                after.insert_str(0, " }");
            }
            None if way.element == 0 => {
                before.push('[');
                after.insert(0, ']');
            }
            None => return Err(EditError::NoElement { key: key.to_owned() }),
        }
    }
    Ok((before, after))
}

/// A path written as a key.
fn written(path: &[Step]) -> String {
    let mut key = String::new();
    for step in path {
        match step {
            Step::Key(name) if key.is_empty() => key.push_str(name),
            Step::Key(name) => key.push_str(&format!(".{name}")),
            Step::Element(element) => key.push_str(&format!("[{}]", element + 1)),
        }
    }
    key
}
