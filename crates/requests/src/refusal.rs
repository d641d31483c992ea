//! Why there is no answer.

use analysis::Failure;
use case::{CaseFile, Diagnostics, Program, shown};
use report::{DrawingError, Units};
use validation::ValidationError;

/// The reason why a request has no answer.
#[derive(Debug, thiserror::Error)]
pub enum Unanswered {
    /// The case has none.
    #[error(transparent)]
    Failure(#[from] Failure),
    /// A question that cannot be put to the case.
    #[error("\"{}\": {problem}", shown(text))]
    Question {
        /// The question.
        text: String,
        /// A sentence.
        problem: String,
    },
}

/// The reason why there is no report to hand over.
#[derive(Debug, thiserror::Error)]
pub enum NoPage {
    /// The additions to the answer cannot be computed.
    #[error(transparent)]
    Failure(#[from] Failure),
    /// A drawing cannot be made.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    /// The built-in data of the validation.
    #[error(transparent)]
    Validation(#[from] ValidationError),
}

/// The reason why a row has no answer, and what to write instead, each on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowRefusal {
    /// What is wrong, and where.
    pub error: String,
    /// What to write instead; empty if the error suffices.
    pub help: String,
}

impl RowRefusal {
    /// A sentence.
    #[must_use]
    pub fn sentence(text: &str) -> Self {
        Self { error: text.split_whitespace().collect::<Vec<_>>().join(" "), help: String::new() }
    }

    /// The refusal of a case that cannot be read, in the words of a program.
    #[must_use]
    pub fn of_case(errors: Diagnostics, program: &'static Program) -> Self {
        let errors = errors.in_words_of(program);
        Self { error: errors.one_line(), help: errors.help_on_one_line() }
    }

    /// The refusal of a case without an answer.
    #[must_use]
    pub fn of(refused: &Unanswered, file: &CaseFile, program: &'static Program) -> Self {
        match refused {
            Unanswered::Failure(Failure::Case(faults)) => {
                Self::of_case(file.diagnostics(faults, program), program)
            }
            Unanswered::Failure(failure) => {
                Self::sentence(&report::no_answer(failure, Units::of_case(&file.case)))
            }
            Unanswered::Question { .. } => Self::sentence(&refused.to_string()),
        }
    }
}
