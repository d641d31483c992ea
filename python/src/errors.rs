//! The exceptions that are raised in Python.

use analysis::Failure;
use case::{CaseFile, Diagnostics, Program, Purpose};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use report::{DrawingError, Units};

/// The methods of this package, for errors that point to them.
pub(crate) static METHODS: Program =
    Program { name: method, begins: None, describes_classes: None, explains_two_speeds: None };

fn method(purpose: Purpose) -> String {
    format!("`{purpose}()`")
}

static CASE_ERROR: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static NO_ANSWER_ERROR: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static PROBLEM: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// A class of `pydeltav._errors`.
fn class<'py>(
    py: Python<'py>,
    cell: &'static PyOnceLock<Py<PyType>>,
    name: &str,
) -> PyResult<Bound<'py, PyType>> {
    Ok(cell.import(py, "pydeltav._errors", name)?.clone())
}

fn raised(made: PyResult<Bound<'_, PyAny>>) -> PyErr {
    made.map_or_else(|error| error, PyErr::from_value)
}

/// All that is wrong with a case.
pub(crate) fn wrong_case(py: Python<'_>, errors: Diagnostics) -> PyErr {
    let errors = errors.in_words_of(&METHODS);
    let make = || {
        let problem = class(py, &PROBLEM, "Problem")?;
        let problems = errors.problems().into_iter().map(|each| {
            let [line, column] = each.place.map_or([None; 2], |place| place.map(Some));
            problem.call1((each.key, line, column, each.message, each.help))
        });
        let problems = problems.collect::<PyResult<Vec<_>>>()?;
        class(py, &CASE_ERROR, "CaseError")?.call1((errors.to_string(), problems))
    };
    raised(make())
}

/// A well-formed case has no answer.
pub(crate) fn no_answer(py: Python<'_>, text: String) -> PyErr {
    raised(class(py, &NO_ANSWER_ERROR, "NoAnswerError").and_then(|class| class.call1((text,))))
}

/// Why there is no answer: the case, the request, or the physics.
pub(crate) fn failed(py: Python<'_>, failure: Failure, file: &CaseFile) -> PyErr {
    match failure {
        Failure::Case(faults) => wrong_case(py, file.diagnostics(&faults, &METHODS)),
        Failure::Ranges(_) => PyValueError::new_err(failure.to_string()),
        failure => no_answer(py, report::no_answer(&failure, Units::of_case(&file.case))),
    }
}

pub(crate) fn not_drawn(py: Python<'_>, error: DrawingError, file: &CaseFile) -> PyErr {
    match error {
        DrawingError::Analysis(failure) => failed(py, failure, file),
        error => no_answer(py, error.to_string()),
    }
}

/// A value of a dict that no case file can have.
pub(crate) fn wrong_value(py: Python<'_>, key: &str, message: &str, help: &str) -> PyErr {
    let make = || {
        let problem = class(py, &PROBLEM, "Problem")?;
        let place = (!key.is_empty()).then_some(key);
        let problem = problem.call1((place, None::<usize>, None::<usize>, message, help))?;
        let named = place.map_or_else(String::new, |key| format!("{key}: "));
        class(py, &CASE_ERROR, "CaseError")?.call1((format!("{named}{message}; {help}"), vec![problem]))
    };
    raised(make())
}
