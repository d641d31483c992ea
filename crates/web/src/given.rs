//! The input: a text, its units, and its faults.

use std::ops::Range;

use analysis::Failure;
use case::{CaseFile, Diagnostics, Program, Purpose};
use report::Units;
use requests::{NoPage, OptionError, Unanswered};
use serde_json::{Value, json};

/// The names of purposes and commands in errors on the page: it has no command line.
pub(crate) static PAGE: Program = Program {
    name: |purpose| {
        match purpose {
            Purpose::Reconstruct => "the reconstruction",
            Purpose::Impact => "the impact from given speeds",
            Purpose::Crush => "the answer from the damage alone",
            Purpose::Motion => "the motion to rest",
            Purpose::Uncertainty => "the uncertainty",
            Purpose::Estimate => "the estimate",
            Purpose::Compare => "the comparison of the laws",
            Purpose::Sensitivity => "the sensitivity",
            Purpose::Draw => "the drawing",
            Purpose::Avoid => "the avoidability",
        }
        .to_owned()
    },
    begins: Some("\"New case…\""),
    describes_classes: None,
    explains_two_speeds: None,
};

/// The name of a file that has none.
pub(crate) const UNNAMED: &str = "case.toml";

/// Why there is no answer.
#[derive(Debug)]
pub(crate) struct Refused {
    problems: Vec<Value>,
    message: String,
}

impl Refused {
    pub(crate) fn message(message: impl Into<String>) -> Self {
        Self { problems: Vec::new(), message: message.into() }
    }

    pub(crate) fn of(diagnostics: &Diagnostics) -> Self {
        Self { problems: problems(diagnostics), message: diagnostics.to_string() }
    }

    /// From a failed analysis; faults of the file are reported in the units of the file.
    pub(crate) fn failed(failure: &Failure, file: &CaseFile, units: Units) -> Self {
        match failure {
            Failure::Case(faults) => Self::of(&file.diagnostics(faults, &PAGE)),
            failure => Self::message(report::no_answer(failure, units)),
        }
    }

    /// From a failed report to hand over.
    pub(crate) fn of_page(error: &NoPage, file: &CaseFile, units: Units) -> Self {
        match error {
            NoPage::Failure(failure) => Self::failed(failure, file, units),
            other => Self::message(other.to_string()),
        }
    }

    pub(crate) fn json(self) -> Value {
        json!({ "ok": false, "problems": self.problems, "message": self.message })
    }
}

impl From<OptionError> for Refused {
    fn from(error: OptionError) -> Self {
        Self::message(error.to_string())
    }
}

/// The result of a function, or why there is none.
pub(crate) fn made(value: Result<Value, Refused>) -> Value {
    value.unwrap_or_else(Refused::json)
}

/// A case, and the units that the reader wants.
#[derive(Debug)]
pub(crate) struct Given {
    pub(crate) file: CaseFile,
    pub(crate) units: Units,
}

impl Given {
    pub(crate) fn read(text: &str, name: Option<&str>, asked: &str) -> Result<Self, Refused> {
        let parsed = CaseFile::parse(name.unwrap_or(UNNAMED), text);
        let file = parsed.map_err(|errors| Refused::of(&errors.in_words_of(&PAGE)))?;
        let units = Units::of_case(&file.case);
        let mut given = Self { file, units };
        given.set_units(asked)?;
        Ok(given)
    }

    /// The units that the reader wants from now on.
    pub(crate) fn set_units(&mut self, asked: &str) -> Result<(), Refused> {
        let known = Units::WORDS.into_iter().find(|(word, _)| *word == asked).map(|(_, units)| units);
        let of_case = || asked.is_empty().then(|| Units::of_case(&self.file.case));
        self.units = known.or_else(of_case).ok_or_else(|| {
            Refused::message(format!("units are \"si\", \"us\", \"uk\" or \"\", not \"{asked}\""))
        })?;
        Ok(())
    }

    pub(crate) fn found<T>(&self, answer: Result<T, Unanswered>) -> Result<T, Refused> {
        answer.map_err(|refused| match refused {
            Unanswered::Failure(failure) => Refused::failed(&failure, &self.file, self.units),
            question @ Unanswered::Question { .. } => Refused::message(question.to_string()),
        })
    }

    pub(crate) fn answered<T>(&self, answer: Result<T, Failure>) -> Result<T, Refused> {
        answer.map_err(|failure| Refused::failed(&failure, &self.file, self.units))
    }
}

/// The places of the bytes of a text as a browser counts them.
pub(crate) struct Places {
    /// For each byte, the UTF-16 units before it; `None` for a text in which both are the same.
    units: Option<Vec<usize>>,
}

impl Places {
    pub(crate) fn of(text: &str) -> Self {
        if text.is_ascii() {
            return Self { units: None };
        }
        let mut units = Vec::with_capacity(text.len() + 1);
        let mut before = 0;
        for letter in text.chars() {
            units.extend(std::iter::repeat_n(before, letter.len_utf8()));
            before += letter.len_utf16();
        }
        units.push(before);
        Self { units: Some(units) }
    }

    /// `from` and `to` of a place.
    pub(crate) fn of_span(&self, span: &Range<usize>) -> [usize; 2] {
        [span.start, span.end].map(|byte| match &self.units {
            None => byte,
            Some(units) => units.get(byte).or(units.last()).copied().unwrap_or_default(),
        })
    }
}

pub(crate) fn problems(diagnostics: &Diagnostics) -> Vec<Value> {
    let places = Places::of(diagnostics.source().text());
    let handed_on = diagnostics.problems().into_iter();
    diagnostics
        .list()
        .iter()
        .zip(handed_on)
        .map(|(diagnostic, problem)| {
            let [from, to] = places.of_span(&diagnostic.span().unwrap_or_default());
            let [line, column] = problem.place.map_or([None; 2], |place| place.map(Some));
            json!({
                "from": from,
                "to": to,
                "line": line,
                "column": column,
                "key": problem.key,
                "title": problem.message,
                "help": problem.help,
            })
        })
        .collect()
}
