//! The report to hand over.

use std::path::Path;

use analysis::{Analysis, Beside, Estimated, Weighed};
use anyhow::Result;
use case::CaseFile;
use report::{Document, Supplements, Units};
use validation::Data;

use crate::present::answered;
use crate::progress::{Progress, counted};
use crate::site_plan::plan_of_case;

/// It, with what the uncertain inputs make of the answer.
pub(crate) fn handover(
    path: &Path,
    file: &CaseFile,
    analysis: &Analysis,
    weighed: Option<&Weighed>,
    estimated: Option<&Estimated>,
    units: Units,
) -> Result<Document> {
    let mut progress = Progress::new()?;
    let beside = analysis::beside(&file.case, analysis, &mut |stage, done, total| {
        progress.at(counted(stage), done, total)
    });
    drop(progress);
    let Beside { uncertainty, sensitivity } = answered(beside, file, units)?;
    let is_followed = analysis.travel.iter().any(Option::is_some);
    let site_plan = if is_followed { plan_of_case(path, file)? } else { None };
    let validation = validation::validate(&Data::built_in())?;
    let supplements = Supplements {
        uncertainty: uncertainty.as_ref(),
        sensitivity: sensitivity.as_ref(),
        validation: Some(&validation),
        site_plan: site_plan.as_ref(),
        weighed,
        estimated,
    };
    Ok(report::handover(file, analysis, supplements, units)?)
}
