//! The requests to a case, and the reasons why one has no answer.

use case::CaseFile;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use requests::{NoPage, OptionError, Request, Unanswered};

use crate::errors::{failed, not_drawn};

/// One of a few words.
pub(crate) fn chosen<T: Copy>(name: &str, word: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let found = choices.iter().find(|(choice, _)| *choice == word).map(|(_, meaning)| *meaning);
    found.ok_or_else(|| {
        let words: Vec<String> = choices.iter().map(|(choice, _)| format!("\"{choice}\"")).collect();
        PyValueError::new_err(format!("{name}=\"{}\": give one of {}", case::shown(word), words.join(", ")))
    })
}

/// The Python class of the result of a request: `Result` if the request has none of its own.
pub(crate) fn class(request: &Request) -> &'static str {
    match request {
        Request::Reconstruct(_) | Request::Impact | Request::Motion | Request::Crush => "Analysis",
        Request::Check => "Judgement",
        Request::Compare => "Comparison",
        Request::Sensitivity(_) => "Sensitivity",
        Request::Uncertainty(_) => "Uncertainty",
        Request::Estimate(_) => "Estimate",
        Request::Avoid(_) => "Avoidance",
        _ => "Result",
    }
}

/// Whether a request takes no longer than the start of a thread for it would.
pub(crate) fn is_quick(request: &Request) -> bool {
    matches!(class(request), "Analysis" | "Judgement")
}

pub(crate) fn wrong_option(error: &OptionError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

pub(crate) fn unanswered(py: Python<'_>, refused: Unanswered, file: &CaseFile) -> PyErr {
    match refused {
        Unanswered::Failure(failure) => failed(py, failure, file),
        question @ Unanswered::Question { .. } => PyValueError::new_err(format!("above={question}")),
    }
}

pub(crate) fn no_page(py: Python<'_>, error: NoPage, file: &CaseFile) -> PyErr {
    match error {
        NoPage::Failure(failure) => failed(py, failure, file),
        NoPage::Drawing(error) => not_drawn(py, error, file),
        NoPage::Validation(error) => pyo3::exceptions::PyRuntimeError::new_err(error.to_string()),
    }
}
