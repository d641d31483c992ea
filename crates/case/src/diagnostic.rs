//! The problems of a case file, and how they are displayed.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Element, Group, Level, Origin, Renderer, Snippet};

use inputs::{acts, shown, sign};

use crate::case_problem::CaseProblem;
use crate::program::Program;
use crate::source::Source;

/// Maximum number of problems shown in full; the others are counted.
const SHOWN: usize = 20;

/// (bytes) longest line that is printed; of a longer one, only the place is named.
const LONGEST_LINE: usize = 2000;

/// One problem and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    span: Option<Range<usize>>,
    key: Option<String>,
    problem: CaseProblem,
}

/// A problem in plain fields, for other programs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlainDiagnostic {
    /// The key concerned, such as `vehicle1.crush.width`, or the table; `None` for the file as a whole.
    pub key: Option<String>,
    /// Line and column of its place, both counted from 1; `None` for the file as a whole.
    pub place: Option<[usize; 2]>,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl Diagnostic {
    pub(crate) fn new(span: Option<Range<usize>>, problem: CaseProblem) -> Self {
        Self { span, key: None, problem }
    }

    /// Sets the key that it is about, which need not be in the file.
    pub(crate) fn about(self, key: &str) -> Self {
        Self { key: Some(key.to_owned()), ..self }
    }

    /// (bytes) its place in the text; `None` for the file as a whole.
    #[must_use]
    pub fn span(&self) -> Option<Range<usize>> {
        self.span.clone()
    }

    /// What is wrong.
    #[must_use]
    pub fn problem(&self) -> &CaseProblem {
        &self.problem
    }

    fn render(&self, source: &Source, program: &Program) -> String {
        let title = Level::ERROR.primary_title(shown(&self.problem.to_string()).into_owned());
        let place = self.place(source);
        let help = self
            .problem
            .help_in(Some(source.units_in_use()), program)
            .map(|help| Level::HELP.message(shown(&help).into_owned()));
        let group: Group<'_> = title.element(place).elements(help);
        Renderer::plain().render(&[group])
    }

    /// Where it is and what is wrong, without line breaks: `line 5, column 14: "75 feets/s" has an unknown
    /// unit "feets/s"`.
    fn sentence(&self, source: &Source) -> String {
        self.placed(source, &self.problem.to_string())
    }

    /// A text about it after its place, without line breaks.
    fn placed(&self, source: &Source, text: &str) -> String {
        let text = on_one_line(text);
        if !source.is_text() {
            let key = self.span.as_ref().and_then(|span| source.key_at(span));
            return match key.filter(|key| !text.contains(key)) {
                Some(key) => format!("{key}: {text}"),
                None => text,
            };
        }
        match self.line_and_column(source) {
            Some([line, column]) => format!("line {line}, column {column}: {text}"),
            None => text,
        }
    }

    fn line_and_column(&self, source: &Source) -> Option<[usize; 2]> {
        let span = self.span.as_ref().filter(|_| source.is_text())?;
        let (line, before) = line_before(source.text(), span.start);
        Some([line, before.chars().count() + 1])
    }

    fn handed_on(&self, source: &Source, program: &Program) -> PlainDiagnostic {
        let at_place = || source.key_at(self.span.as_ref()?).map(str::to_owned);
        let help = self.problem.help_in(Some(source.units_in_use()), program);
        PlainDiagnostic {
            key: self.key.clone().or_else(at_place),
            place: self.line_and_column(source),
            message: shown(&self.problem.to_string()).into_owned(),
            help: help.map(|help| shown(&help).into_owned()),
        }
    }

    /// The line, with a caret under the value; of a value that spans several lines, the first.
    fn place<'a>(&self, source: &'a Source) -> Element<'a> {
        let name = source.name().to_string();
        let text = source.text();
        let Some(span) = &self.span else {
            return Origin::path(name).into();
        };
        if !source.is_text() {
            let key = source.key_at(span).map_or_else(String::new, |key| format!(", {key}"));
            return Origin::path(format!("{name}{key}")).into();
        }
        let start = text.floor_char_boundary(span.start);
        let end = text.floor_char_boundary(span.end.max(start));
        let (number, before) = line_before(text, start);
        let line_start = start - before.len();
        let line_end = text[start..].find('\n').map_or(text.len(), |newline| start + newline);
        let line = text[line_start..line_end].trim_end_matches('\r');
        if line.len() > LONGEST_LINE {
            return Origin::path(name).line(number).char_column(before.chars().count() + 1).into();
        }
        let from = (start - line_start).min(line.len());
        let to = (end - line_start).clamp(from, line.len());
        // One character replaces each, so that the column stays right.
        let signed = |part: &str| part.replace(|letter| acts(letter) && sign(letter).is_none(), "\u{fffd}");
        let (from, to) = (signed(&line[..from]).len(), signed(&line[..to]).len());
        Snippet::source(signed(line))
            .path(name)
            .line_start(number)
            .annotation(AnnotationKind::Primary.span(from..to))
            .into()
    }
}

fn on_one_line(text: &str) -> String {
    shown(&text.split_whitespace().collect::<Vec<_>>().join(" ")).into_owned()
}

/// The number of the line of a place in bytes, and what is before it on that line. A byte order mark does not
/// count.
fn line_before(text: &str, at: usize) -> (usize, &str) {
    let before = &text[..text.floor_char_boundary(at)];
    let line = before.rsplit('\n').next().unwrap_or_default();
    (before.matches('\n').count() + 1, line.trim_start_matches('\u{feff}'))
}

/// All problems of a case file, in the order of the text. Its `Display` is meant for the user.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    source: Source,
    /// Of fixed length, to keep errors small.
    list: Box<[Diagnostic]>,
    program: &'static Program,
}

impl Diagnostics {
    pub(crate) fn new(source: Source, mut list: Vec<Diagnostic>) -> Self {
        // Problems of the whole file come last.
        list.sort_by_key(|diagnostic| diagnostic.span().map_or(usize::MAX, |span| span.start));
        list.dedup();
        Self { source, list: list.into_boxed_slice(), program: &Program::NONE }
    }

    /// The same with the command names of a program, to which the remedies then refer.
    #[must_use]
    pub fn in_words_of(self, program: &'static Program) -> Self {
        Self { program, ..self }
    }

    /// The problems, in the order of the text; those of the whole file come last.
    #[must_use]
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// The problems in plain fields, each with its key and with the command names of the program.
    ///
    /// ```
    /// let errors = case::CaseFile::parse("case.toml", "[vehicle1]\nspeed = 35\n[vehicle2]\nfixed = true").unwrap_err();
    /// let [problem] = &errors.problems()[..] else { panic!() };
    /// assert_eq!(problem.key.as_deref(), Some("vehicle1.speed"));
    /// assert_eq!(problem.place, Some([2, 9]));
    /// ```
    #[must_use]
    pub fn problems(&self) -> Vec<PlainDiagnostic> {
        self.list.iter().map(|diagnostic| diagnostic.handed_on(&self.source, self.program)).collect()
    }

    /// All problems on one line, for a row of a table or a line of a log, without the name of the file and
    /// without what to write instead.
    ///
    /// ```
    /// let errors = case::CaseFile::parse("case.toml", "[vehicle1]\nspeed = 35\n[vehicle2]\nfixed = true").unwrap_err();
    /// assert_eq!(errors.one_line(), r#"line 2, column 9: "vehicle1.speed" is the bare number 35, but needs a unit"#);
    /// ```
    #[must_use]
    pub fn one_line(&self) -> String {
        let mut sentences: Vec<String> =
            self.list.iter().take(SHOWN).map(|diagnostic| diagnostic.sentence(&self.source)).collect();
        if let Some(more) = self.list.len().checked_sub(SHOWN).filter(|&more| more > 0) {
            sentences.push(format!("and {more} more"));
        }
        sentences.join("; ")
    }

    /// What to write instead, on one line, to accompany [`one_line`](Self::one_line): with places if several
    /// problems are shown, and empty if there is nothing to say.
    ///
    /// ```
    /// let errors = case::CaseFile::parse("case.toml", "[vehicle1]\nspeed = 35\n[vehicle2]\nfixed = true").unwrap_err();
    /// assert!(errors.help_on_one_line().starts_with(r#"write the number and its unit as a string, for example speed = "35 m/s" or speed = "35 mph""#));
    /// ```
    #[must_use]
    pub fn help_on_one_line(&self) -> String {
        let shown = &self.list[..self.list.len().min(SHOWN)];
        let helps = shown.iter().filter_map(|diagnostic| {
            let help = diagnostic.problem.help_in(Some(self.source.units_in_use()), self.program)?;
            Some(if shown.len() == 1 { on_one_line(&help) } else { diagnostic.placed(&self.source, &help) })
        });
        helps.collect::<Vec<_>>().join("; ")
    }

    /// The text they are about.
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.list.iter().take(SHOWN).enumerate() {
            if index > 0 {
                f.write_str("\n\n")?;
            }
            f.write_str(&diagnostic.render(&self.source, self.program))?;
        }
        match self.list.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, "\n\nand {more} more"),
        }
    }
}

impl Error for Diagnostics {}
