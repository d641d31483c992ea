//! What is asked of a case, and why there is no answer.

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

/// The class of the result of a request, in Python: that of all for what has none of its own.
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

/// Whether it takes no longer than to start a thread for it.
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
