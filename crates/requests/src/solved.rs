//! An exact solution, and what a report adds to it.

use std::io::{self, Write};

use analysis::{Analysis, Beside, Estimated, Failure, NoEstimate, Weighed};
use case::{Case, CaseFile, Geometry};
use report::{CsvStyle, Document, SitePlan, Subject, Supplements, Units};
use serde::Serialize;
use validation::Data;

use crate::estimate::WEIGHING;
use crate::options::{OptionError, RequestOptions};
use crate::progress::{RequestProgress, counted, of_estimate};
use crate::refusal::NoPage;

/// The reason why evidence that contradicts itself has no answer.
pub(crate) const CONTRADICTION: &str =
    "the evidence contradicts itself: the report says where, and gives no single answer";

/// What a reconstruction adds to its exact solution; by default nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ReconstructOptions {
    /// All the evidence weighed, if the case has more than its exact solution uses.
    pub weigh: bool,
    /// The intervals with the errors of the method, if the exact solution is the answer and the case has
    /// ranges: intervals by the ranges alone would be read as the whole uncertainty.
    pub method: bool,
}

impl ReconstructOptions {
    pub(crate) fn read(options: &RequestOptions) -> Result<Self, OptionError> {
        Ok(Self { weigh: options.flag("weigh", false)?, method: options.flag("method", false)? })
    }

    /// Whether the case gets intervals with the errors of the method. If they would take minutes, the report
    /// says so instead.
    fn has_method(&self, case: &Case) -> bool {
        self.method && analysis::is_uncertain(case) && analysis::is_estimated_beside(case)
    }
}

/// All the evidence of a case, weighed, where `exact` is its exact solution; `None` if that is the answer.
///
/// # Errors
/// [`Failure`].
pub fn weigh(
    case: &Case,
    exact: &Analysis,
    progress: &mut RequestProgress<'_>,
) -> Result<Option<Weighed>, Failure> {
    analysis::weigh(case, exact, &WEIGHING, &mut of_estimate(progress))
}

/// An exact solution, and what else is known of the case.
#[derive(Debug)]
pub struct SolvedCase {
    /// The exact solution.
    pub analysis: Analysis,
    /// All the evidence, if it was weighed.
    pub weighed: Option<Weighed>,
    /// The reason why it could not be weighed, if that was asked for.
    pub unweighed: Option<Failure>,
    /// The intervals with the errors of the method, if the exact solution is the answer.
    pub estimated: Option<Estimated>,
}

impl From<Analysis> for SolvedCase {
    fn from(analysis: Analysis) -> Self {
        Self { analysis, weighed: None, unweighed: None, estimated: None }
    }
}

impl SolvedCase {
    /// Whether the options ask for more than the exact solution.
    pub(crate) fn leaves_open(&self, options: &ReconstructOptions, case: &Case) -> bool {
        (options.weigh && self.analysis.why_not_exact().is_some()) || options.has_method(case)
    }

    pub(crate) fn completed(
        mut self,
        options: &ReconstructOptions,
        case: &Case,
        progress: &mut RequestProgress<'_>,
    ) -> Self {
        if options.weigh {
            match weigh(case, &self.analysis, progress) {
                Ok(weighed) => self.weighed = weighed,
                Err(failure) => self.unweighed = Some(failure),
            }
        }
        if self.weighed.is_none() && options.has_method(case) {
            self.estimated = analysis::estimate(case, &WEIGHING, &mut of_estimate(progress)).ok();
        }
        self
    }

    /// The reason why weighing the evidence gave no answer.
    pub(crate) fn no_answer(&self) -> Option<&'static str> {
        Some(match self.weighed.as_ref()?.estimated.no_answer()? {
            NoEstimate::Contradicted(_) => CONTRADICTION,
            NoEstimate::Unconverged => {
                "the evidence was weighed, but the run has not converged: the report says why, and gives no interval"
            }
        })
    }

    pub(crate) fn document(&self, case: &Case, units: Units) -> Document {
        match &self.weighed {
            Some(weighed) => report::weighed(case, &self.analysis, weighed, units),
            None => report::results(case, &self.analysis, units),
        }
    }

    pub(crate) fn json(&self, file: &CaseFile) -> Result<String, serde_json::Error> {
        match &self.weighed {
            Some(weighed) => report::weighed_json(file, &self.analysis, weighed),
            None => report::json(file, &self.analysis),
        }
    }

    pub(crate) fn page(
        &self,
        file: &CaseFile,
        site_plan: Option<&SitePlan>,
        units: Units,
        progress: &mut RequestProgress<'_>,
    ) -> Result<Document, NoPage> {
        let Self { analysis, weighed, estimated, .. } = self;
        let told = &mut |stage, done, total| progress(counted(stage), done, total);
        let Beside { uncertainty, sensitivity } = analysis::beside(&file.case, analysis, told)?;
        let validation = validation::validate(&Data::built_in())?;
        let supplements = Supplements {
            uncertainty: uncertainty.as_ref(),
            sensitivity: sensitivity.as_ref(),
            validation: Some(&validation),
            site_plan,
            weighed: weighed.as_ref(),
            estimated: estimated.as_ref(),
        };
        Ok(report::handover(file, analysis, supplements, units)?)
    }

    pub(crate) fn write_draws(&self, style: CsvStyle, out: &mut dyn Write) -> io::Result<()> {
        match &self.weighed {
            Some(weighed) => report::write_draws(&weighed.estimated, style, out),
            None => Ok(()),
        }
    }

    /// The drawing that shows most of it; `None` if the case has nothing to draw.
    #[must_use]
    pub fn first_subject(&self) -> Option<Subject> {
        let Self { analysis, .. } = self;
        // The relative position of point masses is not known.
        let is_placed = analysis.both.as_ref().is_none_or(|both| both.geometry == Geometry::Given);
        if analysis.impact.is_some() && is_placed {
            Some(Subject::Scene)
        } else if self.is_followed() {
            Some(Subject::Motion)
        } else {
            analysis.vehicles.iter().any(|vehicle| vehicle.damage.is_some()).then_some(Subject::Damage)
        }
    }

    /// Whether a vehicle is followed to rest: its motion is drawn on the site plan of the case.
    pub(crate) fn is_followed(&self) -> bool {
        self.analysis.travel.iter().any(Option::is_some)
    }
}
