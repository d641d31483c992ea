//! The progress of a request.

use std::ops::ControlFlow;

use analysis::{EstimateStage, Stage};

/// Receives the name of what is counted, the number done and the total, and may end the run.
pub type RequestProgress<'a> = dyn FnMut(&'static str, usize, usize) -> ControlFlow<()> + Send + 'a;

/// What is counted while samples are drawn.
pub(crate) fn counted(stage: Stage) -> &'static str {
    match stage {
        Stage::Samples => "samples",
        Stage::Indices => "rows for the indices",
    }
}

/// Passes on the progress of an estimate.
pub(crate) fn of_estimate<'a>(
    progress: &'a mut RequestProgress<'_>,
) -> impl FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send + 'a {
    |stage, done, total| progress(counted_of_estimate(stage), done, total)
}

/// What is counted while evidence is weighed.
pub(crate) fn counted_of_estimate(stage: EstimateStage) -> &'static str {
    match stage {
        EstimateStage::All => "particles",
        EstimateStage::Prior => "particles before the evidence",
        EstimateStage::Piece => "pieces of evidence",
    }
}
