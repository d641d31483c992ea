//! The questions about a collision and their answers, once for the program, the Python package and the page,
//! which add arguments, files, threads and the display of progress.
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use requests::{Answer, Request, RequestOptions};
//!
//! let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! let request = Request::read("reconstruct", &RequestOptions::default())?;
//! let answer = request.answer(&file.case, &mut |_, _, _| ControlFlow::Continue(()))?;
//!
//! let Answer::Analysis(solved) = &answer else { return Err("no analysis".into()) };
//! assert!((solved.analysis.delta_v()[0] - 12.15).abs() < 0.005);
//! // SAE 980025: 75 ft/s
//! assert!(answer.document(&file, report::Units::Us).text().contains("75.03 ft/s"));
//! assert!(answer.json(&file)?.contains("\"admissible_roots\": 1"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Request`] is a command with its options, which have a type for each command. [`Request::read`] takes
//! them by their names, and [`Request::check`] refuses those that fit no case. [`Request::answer`] finds an
//! [`Answer`], which has a [document](Answer::document), a [report to hand over](Answer::page), its
//! [JSON](Answer::json), a [row](Answer::row) among those of many cases, and its
//! [samples](Answer::write_samples).
//!
//! [`plots`] draws an uncertainty, and [`site_plan_beside`] reads the picture behind a motion. [`RowRefusal`]
//! states on one line why a row has no answer.
//!
//! # A new command
//!
//! Its options, and its document and JSON if no other crate has them, are a file of this crate, whose enums
//! get another variant. The command line gives it a name and a help text; the page finds it by its name.
//!
//! # What it does not do
//!
//! It computes nothing itself, and depends on no terminal, no Python and no browser.

mod avoid;
mod beside;
mod estimate;
mod options;
mod picture;
mod progress;
mod records;
mod refusal;
mod sensitivity;
mod solved;
mod uncertainty;

use std::io::{self, Write};

use analysis::{Avoidance, Comparison, Judgement, NoEstimate, RecorderReading, Sensitivity, Uncertainty};
use case::{Case, CaseFile};
use report::{CsvStyle, Document, RowAnswer, SitePlan, Table, Units};
use serde::Serialize;

pub use avoid::{AvoidOptions, no_probability};
pub use estimate::{EstimateAnswer, EstimateOptions};
pub use options::{OptionError, RequestOptions};
pub use picture::{plan_path, read_picture, site_plan_beside};
pub use progress::RequestProgress;
pub use records::read_records_beside;
pub use refusal::{NoPage, RowRefusal, Unanswered};
pub use sensitivity::SensitivityOptions;
use solved::CONTRADICTION;
pub use solved::{ReconstructOptions, SolvedCase, weigh};
pub use uncertainty::{UncertaintyOptions, plots};

/// A command that answers for a case, with its options: enough to repeat the answer to the last bit.
///
/// It is serialised as its command and its options, which [`read`](Self::read) takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(tag = "command", content = "options", rename_all = "lowercase")]
pub enum Request {
    /// The speed that makes impact and crush agree, or both speeds.
    Reconstruct(ReconstructOptions),
    /// The impact of two known speeds.
    Impact,
    /// The motion to rest, or back from it.
    Motion,
    /// CRASH3 alone.
    Crush,
    /// The commands that the case allows, without solving it.
    Check,
    /// The answers of every impact law.
    Compare,
    /// The readings of the recorders on their own.
    Recorder,
    /// How much the answer depends on each input.
    Sensitivity(SensitivityOptions),
    /// The intervals of the results that follow from the ranges of the case.
    Uncertainty(UncertaintyOptions),
    /// The speeds from all evidence.
    Estimate(EstimateOptions),
    /// Whether the collision was avoidable.
    Avoid(AvoidOptions),
}

/// A [`Request`] that takes long, with its results so far.
#[derive(Debug)]
pub enum Begun<'a> {
    /// Its exact solution is found.
    Reconstruct(&'a ReconstructOptions, Box<SolvedCase>),
    /// No result yet.
    Uncertainty(&'a UncertaintyOptions),
    /// No result yet.
    Estimate(&'a EstimateOptions),
    /// No result yet.
    Avoid(&'a AvoidOptions),
}

impl Begun<'_> {
    /// The answer for the same case. It reports its progress, and runs on the threads of the rayon pool in
    /// which it is called if the features `parallel` of the crates below are on; its bits depend on neither.
    ///
    /// # Errors
    /// [`Unanswered`].
    pub fn finish(self, case: &Case, progress: &mut RequestProgress<'_>) -> Result<Answer, Unanswered> {
        Ok(match self {
            Self::Reconstruct(options, solved) => {
                Answer::Analysis(Box::new(solved.completed(options, case, progress)))
            }
            Self::Uncertainty(options) => Answer::Uncertainty(Box::new(options.answer(case, progress)?)),
            Self::Estimate(options) => Answer::Estimate(Box::new(options.answer(case, progress)?)),
            Self::Avoid(options) => Answer::Avoidance(Box::new(options.answer(case, progress)?)),
        })
    }
}

/// The answer to a [`Request`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Answer {
    /// The answer to [`Request::Reconstruct`], [`Request::Impact`], [`Request::Motion`] and
    /// [`Request::Crush`].
    Analysis(Box<SolvedCase>),
    /// The answer to [`Request::Check`].
    Judgement(Box<Judgement>),
    /// The answer to [`Request::Compare`].
    Comparison(Box<Comparison>),
    /// The answer to [`Request::Recorder`].
    Recorders(Box<RecorderReading>),
    /// The answer to [`Request::Sensitivity`].
    Sensitivity(Box<Sensitivity>),
    /// The answer to [`Request::Uncertainty`].
    Uncertainty(Box<Uncertainty>),
    /// The answer to [`Request::Estimate`].
    Estimate(Box<EstimateAnswer>),
    /// The answer to [`Request::Avoid`].
    Avoidance(Box<Avoidance>),
}

impl From<analysis::Analysis> for Answer {
    fn from(analysis: analysis::Analysis) -> Self {
        Self::Analysis(Box::new(analysis.into()))
    }
}

impl Request {
    /// The request for a command, by its name and the names of its options.
    ///
    /// # Errors
    /// [`OptionError`] if no command has this name, the command has no such option, or it cannot be read.
    pub fn read(command: &str, options: &RequestOptions) -> Result<Self, OptionError> {
        let request = match command {
            "reconstruct" => Self::Reconstruct(ReconstructOptions::read(options)?),
            "impact" => Self::Impact,
            "motion" => Self::Motion,
            "crush" => Self::Crush,
            "check" => Self::Check,
            "compare" => Self::Compare,
            "recorder" => Self::Recorder,
            "sensitivity" => Self::Sensitivity(SensitivityOptions::read(options)?),
            "uncertainty" => Self::Uncertainty(UncertaintyOptions::read(options)?),
            "estimate" => Self::Estimate(EstimateOptions::read(options)?),
            "avoid" => Self::Avoid(AvoidOptions::read(options)?),
            other => return Err(OptionError::Command(other.to_owned())),
        };
        options.are_known(command)?;
        Ok(request)
    }

    /// Refuses options that no case could have.
    ///
    /// # Errors
    /// [`OptionError`], with a valid value to give instead.
    pub fn check(&self) -> Result<(), OptionError> {
        match self {
            Self::Sensitivity(options) => options.check(),
            Self::Uncertainty(options) => options.check(),
            Self::Estimate(options) => options.check(),
            Self::Avoid(options) => options.check(),
            Self::Reconstruct(_) | Self::Impact | Self::Motion | Self::Crush => Ok(()),
            Self::Check | Self::Compare | Self::Recorder => Ok(()),
        }
    }

    /// The answer: [begun](Self::begin) and, if that is not all, [finished](Begun::finish).
    ///
    /// # Errors
    /// [`Unanswered`].
    pub fn answer(&self, case: &Case, progress: &mut RequestProgress<'_>) -> Result<Answer, Unanswered> {
        match self.begin(case) {
            Ok(answer) => answer,
            Err(begun) => begun.finish(case, progress),
        }
    }

    /// The answer of a quick command, on this thread and without progress.
    ///
    /// # Errors
    /// [`Begun`] if the answer takes long.
    pub fn begin(&self, case: &Case) -> Result<Result<Answer, Unanswered>, Begun<'_>> {
        let answer = match self {
            Self::Uncertainty(options) => return Err(Begun::Uncertainty(options)),
            Self::Estimate(options) => return Err(Begun::Estimate(options)),
            Self::Avoid(options) => return Err(Begun::Avoid(options)),
            Self::Reconstruct(options) => match analysis::reconstruct(case) {
                Ok(exact) => {
                    let solved = Box::new(SolvedCase::from(exact));
                    if solved.leaves_open(options, case) {
                        return Err(Begun::Reconstruct(options, solved));
                    }
                    Ok(Answer::Analysis(solved))
                }
                Err(failure) => Err(failure),
            },
            Self::Impact => analysis::impact(case).map(Answer::from),
            Self::Motion => analysis::motion(case).map(Answer::from),
            Self::Crush => analysis::crush(case).map(Answer::from),
            Self::Check => Ok(Answer::Judgement(Box::new(analysis::judge(case)))),
            Self::Compare => analysis::compare(case).map(|found| Answer::Comparison(Box::new(found))),
            Self::Recorder => analysis::recorders(case).map(|found| Answer::Recorders(Box::new(found))),
            Self::Sensitivity(options) => {
                let found = analysis::sensitivity(case, options.sweep());
                found.map(|found| Answer::Sensitivity(Box::new(found)))
            }
        };
        Ok(answer.map_err(Unanswered::from))
    }

    /// The table of its rows, one or more for each case; `None` for a command about a single case.
    #[must_use]
    pub fn rows(&self) -> Option<Table> {
        match self {
            Self::Reconstruct(_) | Self::Impact | Self::Motion | Self::Crush => Some(Table::Analyses),
            Self::Compare => Some(Table::Comparisons),
            Self::Uncertainty(_) => Some(Table::Uncertainties),
            Self::Check | Self::Recorder | Self::Sensitivity(_) | Self::Estimate(_) | Self::Avoid(_) => None,
        }
    }

    /// The request for a row, which has room only for an exact solution.
    #[must_use]
    pub fn of_row(&self) -> Self {
        match self {
            Self::Reconstruct(_) => Self::Reconstruct(ReconstructOptions::default()),
            other => other.clone(),
        }
    }
}

impl Answer {
    /// The document that the program prints.
    #[must_use]
    pub fn document(&self, file: &CaseFile, units: Units) -> Document {
        let case = &file.case;
        match self {
            Self::Analysis(solved) => solved.document(case, units),
            Self::Judgement(judgement) => report::judgement(file, judgement, units),
            Self::Comparison(comparison) => report::comparison(case, comparison, units),
            Self::Recorders(reading) => report::recorders(file, reading, units),
            Self::Sensitivity(sensitivity) => report::sensitivity(case, sensitivity, units),
            Self::Uncertainty(uncertainty) => report::uncertainty(case, uncertainty, units),
            Self::Estimate(answer) => report::estimate(case, &answer.estimated, &answer.asked, units),
            Self::Avoidance(found) => report::avoid(case, found, units),
        }
    }

    /// The report to hand over: for an analysis with all steps and drawings, otherwise the document.
    ///
    /// # Errors
    /// [`NoPage`].
    pub fn page(
        &self,
        file: &CaseFile,
        site_plan: Option<&SitePlan>,
        units: Units,
        progress: &mut RequestProgress<'_>,
    ) -> Result<Document, NoPage> {
        match self {
            Self::Analysis(solved) => solved.page(file, site_plan, units, progress),
            other => Ok(other.document(file, units)),
        }
    }

    /// Whether its page shows the site plan of the case.
    #[must_use]
    pub fn shows_site_plan(&self) -> bool {
        matches!(self, Self::Analysis(solved) if solved.is_followed())
    }

    /// The JSON document: SI units and radians, with stable keys.
    ///
    /// # Errors
    /// If serialisation fails, which no answer causes.
    pub fn json(&self, file: &CaseFile) -> Result<String, serde_json::Error> {
        match self {
            Self::Analysis(solved) => solved.json(file),
            Self::Judgement(judgement) => report::judgement_json(file, judgement),
            Self::Comparison(comparison) => report::comparison_json(file, comparison),
            Self::Recorders(reading) => report::recorders_json(file, reading),
            Self::Sensitivity(sensitivity) => report::sensitivity_json(file, sensitivity),
            Self::Uncertainty(uncertainty) => report::uncertainty_json(file, uncertainty),
            Self::Estimate(answer) => report::estimate_json(file, &answer.estimated, &answer.asked),
            Self::Avoidance(found) => report::avoid_json(file, found),
        }
    }

    /// The content of its row; `None` if [`Request::rows`] has no table.
    #[must_use]
    pub fn row(&self) -> Option<RowAnswer<'_>> {
        match self {
            Self::Analysis(solved) => Some(RowAnswer::Analysis(&solved.analysis)),
            Self::Comparison(comparison) => Some(RowAnswer::Comparison(comparison)),
            Self::Uncertainty(uncertainty) => Some(RowAnswer::Uncertainty(uncertainty)),
            Self::Judgement(_)
            | Self::Recorders(_)
            | Self::Sensitivity(_)
            | Self::Estimate(_)
            | Self::Avoidance(_) => None,
        }
    }

    /// The first lines of its document; for an uncertainty, the intervals.
    #[must_use]
    pub fn headline(&self, document: &Document, units: Units) -> Vec<String> {
        match self {
            Self::Uncertainty(uncertainty) => report::uncertain_headline(uncertainty, units),
            _ => document.headline().to_vec(),
        }
    }

    /// The reason why it is not an answer: the evidence contradicts itself, or the run has not converged. The
    /// document says more.
    #[must_use]
    pub fn no_answer(&self) -> Option<&'static str> {
        match self {
            Self::Analysis(solved) => solved.no_answer(),
            Self::Estimate(answer) => Some(match answer.estimated.no_answer()? {
                NoEstimate::Unconverged => {
                    "the run has not converged: the report says why, and gives no intervals"
                }
                NoEstimate::Contradicted(_) => CONTRADICTION,
            }),
            Self::Avoidance(found) => found.speed_doubt.as_ref().map(no_probability),
            Self::Judgement(_) | Self::Comparison(_) | Self::Recorders(_) | Self::Sensitivity(_) => None,
            Self::Uncertainty(_) => None,
        }
    }

    /// Writes the samples or draws as CSV or, for recorders, the data that they stored before the impact;
    /// nothing if it is [not an answer](Self::no_answer) or has no samples.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write_samples(&self, style: CsvStyle, out: &mut dyn Write) -> io::Result<()> {
        if self.no_answer().is_some() {
            return Ok(());
        }
        match self {
            Self::Analysis(solved) => solved.write_draws(style, out),
            Self::Uncertainty(uncertainty) => report::write_samples(uncertainty, style, out),
            Self::Estimate(answer) => report::write_draws(&answer.estimated, style, out),
            Self::Recorders(reading) => report::write_records(reading, style, out),
            Self::Judgement(_) | Self::Comparison(_) | Self::Sensitivity(_) | Self::Avoidance(_) => Ok(()),
        }
    }
}
