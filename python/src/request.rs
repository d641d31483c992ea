//! What is asked of a case, and the answer.

use analysis::{
    Analysis, Comparison, EstimatePlan, Estimated, Failure, Judgement, Plan, Sensitivity, Sweep, Uncertainty,
};
use case::{Case, CaseFile, Prior};
use estimate::{MOST_PARTICLES, PARTICLES_STEP};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use report::{Asked, Document, Question, Units};
use serde::{Deserialize, Serialize};
use uncertainty::{MIN_SAMPLES, SamplingMethod, Settings};

use crate::run::Ending;

/// A method of `Case` with what it was given: enough to get the answer again, to the last bit.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Request {
    Reconstruct,
    Impact,
    Motion,
    Crush,
    Check,
    Compare,
    Sensitivity { pdof_step: f64, pdof_steps: u32 },
    Uncertainty { samples: Option<usize>, seed: u64, method: String, sobol: Option<usize> },
    Estimate { particles: usize, seed: u64, prior: Option<String>, pieces: bool, above: Vec<String> },
}

pub(crate) enum Answer {
    Analysis(Box<Analysis>),
    Judgement(Box<Judgement>),
    Comparison(Box<Comparison>),
    Sensitivity(Box<Sensitivity>),
    Uncertainty(Box<Uncertainty>),
    Estimate(Box<(Estimated, Asked)>),
}

/// One of a few words.
pub(crate) fn chosen<T: Copy>(name: &str, word: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let found = choices.iter().find(|(choice, _)| *choice == word).map(|(_, meaning)| *meaning);
    found.ok_or_else(|| {
        let words: Vec<String> = choices.iter().map(|(choice, _)| format!("\"{choice}\"")).collect();
        PyValueError::new_err(format!("{name}=\"{}\": give one of {}", case::shown(word), words.join(", ")))
    })
}

impl Request {
    /// Refuses what no case could be asked.
    pub(crate) fn check(&self) -> PyResult<()> {
        match self {
            Self::Sensitivity { pdof_step, pdof_steps } => {
                if !(*pdof_step > 0.0 && *pdof_step <= 180.0) {
                    let problem =
                        format!("pdof_step={pdof_step}: give degrees above 0 and up to 180, such as 5");
                    return Err(PyValueError::new_err(problem));
                }
                if *pdof_steps > 180 {
                    let problem = format!("pdof_steps={pdof_steps}: give a whole number from 0 to 180");
                    return Err(PyValueError::new_err(problem));
                }
            }
            Self::Uncertainty { method, sobol, .. } => {
                chosen("method", method, &SamplingMethod::WORDS)?;
                if let Some(rows) = sobol.filter(|rows| *rows < MIN_SAMPLES) {
                    let problem = format!("sobol={rows}: the number of rows must be at least {MIN_SAMPLES}");
                    return Err(PyValueError::new_err(problem));
                }
            }
            Self::Estimate { particles, prior, .. } => {
                if let Some(prior) = prior {
                    chosen("prior", prior, &Prior::WORDS)?;
                }
                if !estimate::Settings::can_have(*particles) {
                    return Err(PyValueError::new_err(format!(
                        "particles={particles}: give a multiple of {PARTICLES_STEP} up to {MOST_PARTICLES}, \
                         such as {}",
                        EstimatePlan::PARTICLES
                    )));
                }
            }
            Self::Reconstruct | Self::Impact | Self::Motion | Self::Crush | Self::Check | Self::Compare => {}
        }
        Ok(())
    }

    /// The class of its result, in Python.
    pub(crate) fn class(&self) -> &'static str {
        match self {
            Self::Reconstruct | Self::Impact | Self::Motion | Self::Crush => "Analysis",
            Self::Check => "Judgement",
            Self::Compare => "Comparison",
            Self::Sensitivity { .. } => "Sensitivity",
            Self::Uncertainty { .. } => "Uncertainty",
            Self::Estimate { .. } => "Estimate",
        }
    }

    /// Whether it takes no longer than to start a thread for it.
    pub(crate) fn is_quick(&self) -> bool {
        matches!(self, Self::Reconstruct | Self::Impact | Self::Motion | Self::Crush | Self::Check)
    }

    /// The questions, which a case has to be able to answer.
    fn questions(above: &[String], case: &Case) -> Result<Vec<Question>, Refused> {
        let outputs = analysis::estimate_outputs(case)?;
        let read = |text: &String| {
            let problem =
                |problem| Refused::Request(format!("above=\"{}\": {problem}", case::shown(text.trim())));
            Question::read(text, &outputs).map_err(problem)
        };
        above.iter().map(read).collect()
    }

    pub(crate) fn answer(&self, case: &Case, ending: &Ending) -> Result<Answer, Refused> {
        let analysis = |solved: Result<Analysis, Failure>| Ok(Answer::Analysis(Box::new(solved?)));
        match self {
            Self::Reconstruct => analysis(analysis::reconstruct(case)),
            Self::Impact => analysis(analysis::impact(case)),
            Self::Motion => analysis(analysis::motion(case)),
            Self::Crush => analysis(analysis::crush(case)),
            Self::Check => Ok(Answer::Judgement(Box::new(analysis::judge(case)))),
            Self::Compare => Ok(Answer::Comparison(Box::new(analysis::compare(case)?))),
            Self::Sensitivity { pdof_step, pdof_steps } => {
                let sweep = Sweep { step: pdof_step.to_radians(), steps: *pdof_steps };
                Ok(Answer::Sensitivity(Box::new(analysis::sensitivity(case, sweep)?)))
            }
            Self::Uncertainty { samples, seed, method, sobol } => {
                let samples = samples.unwrap_or_else(|| analysis::usual_samples(case));
                let method =
                    chosen("method", method, &SamplingMethod::WORDS).unwrap_or(SamplingMethod::MonteCarlo);
                // `columns` promises all samples.
                let settings = Settings::new(method, samples, *seed);
                let plan = Plan { settings, index_rows: *sobol };
                let uncertainty = analysis::uncertainty(case, &plan, &mut |_, _, _| ending.flow())?;
                Ok(Answer::Uncertainty(Box::new(uncertainty)))
            }
            Self::Estimate { particles, seed, prior, pieces, above } => {
                let prior = prior.as_deref().and_then(|prior| chosen("prior", prior, &Prior::WORDS).ok());
                let questions = Self::questions(above, case)?;
                let plan = EstimatePlan { particles: *particles, seed: *seed, prior, pieces: *pieces };
                let estimated = analysis::estimate(case, &plan, &mut |_, _, _| ending.flow())?;
                Ok(Answer::Estimate(Box::new((estimated, Asked { plan, questions }))))
            }
        }
    }
}

/// Why there is no answer.
pub(crate) enum Refused {
    Failure(Failure),
    Request(String),
}

impl From<Failure> for Refused {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

impl Refused {
    pub(crate) fn raised(self, py: Python<'_>, file: &CaseFile) -> PyErr {
        match self {
            Self::Failure(failure) => crate::errors::failed(py, failure, file),
            Self::Request(problem) => PyValueError::new_err(problem),
        }
    }
}

impl Answer {
    /// As the program prints it.
    pub(crate) fn document(&self, file: &CaseFile, units: Units) -> Document {
        let case = &file.case;
        match self {
            Self::Analysis(analysis) => report::results(case, analysis, units),
            Self::Judgement(judgement) => report::judgement(file, judgement, units),
            Self::Comparison(comparison) => report::comparison(case, comparison, units),
            Self::Sensitivity(sensitivity) => report::sensitivity(case, sensitivity, units),
            Self::Uncertainty(uncertainty) => report::uncertainty(case, uncertainty, units),
            Self::Estimate(answer) => report::estimate(case, &answer.0, &answer.1, units),
        }
    }

    pub(crate) fn json(&self, file: &CaseFile) -> Result<String, serde_json::Error> {
        match self {
            Self::Analysis(analysis) => report::json(file, analysis),
            Self::Judgement(judgement) => report::judgement_json(file, judgement),
            Self::Comparison(comparison) => report::comparison_json(file, comparison),
            Self::Sensitivity(sensitivity) => report::sensitivity_json(file, sensitivity),
            Self::Uncertainty(uncertainty) => report::uncertainty_json(file, uncertainty),
            Self::Estimate(answer) => report::estimate_json(file, &answer.0, &answer.1),
        }
    }
}
