//! From the rows of a table to their results.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use analysis::{AvoidPlan, EstimatePlan, Failure, NoEstimate, PieceDetail};
use arrow_array::RecordBatch;
use arrow_schema::{Schema, SchemaRef};
use case::{CaseFile, ValueTable};
use report::PROGRAM;
use requests::{RowRefusal, no_probability, read_records_beside};
use uncertainty::{SamplingMethod, Settings};

use crate::error::TableError;
use crate::job::{Job, RowOptions};
use crate::plan::{self, Plan, merge};
use crate::results::{self, Builder, Found, Outcome, Spread};

/// What all rows share: a part of a case.
#[derive(Clone, Debug, Default)]
pub struct RowTemplate {
    shared: ValueTable<'static>,
    /// The files of recorders are sought in its folder.
    path: PathBuf,
}

impl RowTemplate {
    /// Reads a part of a case file; `name` is its path, or its name in errors. A file that `pre_crash` or
    /// `pulse` of a recorder names, here or in a row, is sought in the folder of this path.
    ///
    /// ```
    /// use tables::RowTemplate;
    /// let template = RowTemplate::parse("template.toml", "[impact]\nrestitution = 0.1\ntangential = \"critical\"")?;
    /// let error = RowTemplate::parse("template.toml", "[impact]\nrestituton = 0.1").unwrap_err().to_string();
    /// assert!(error.contains("unknown key \"restituton\""));
    /// # Ok::<(), tables::TableError>(())
    /// ```
    ///
    /// # Errors
    /// [`TableError::Template`] for faults that do not depend on the rows. Missing keys, and keys that do not
    /// fit together, are reported in the rows.
    pub fn parse(name: &str, text: &str) -> Result<Self, TableError> {
        match CaseFile::part(name, text) {
            Ok(shared) => Ok(Self { shared, path: name.into() }),
            Err(errors) => Err(TableError::Template(Box::new(errors.in_words_of(&PROGRAM)))),
        }
    }
}

/// The advice for a row without an answer.
const WHY_NO_ANSWER: &str = "`deltav estimate` on the case says why";

/// Rows that are computed before they are put into columns.
const AT_ONCE: usize = 4096;

/// The faults that were found on reading the rows, one for each row; none if a row is sound, or beyond the
/// end.
pub type RowFaults<'a> = &'a [Option<String>];

/// Receives the number of finished rows and of all, on any thread, and may end the run.
pub type RowProgress<'a> = dyn Fn(usize, usize) -> ControlFlow<()> + Sync + 'a;

/// The schema of the results, which does not depend on the rows.
///
/// ```
/// use tables::{Job, RowOptions, result_schema};
/// let schema = result_schema(Job::Reconstruct, &RowOptions { samples: Some(1000), ..RowOptions::default() });
/// assert!(schema.field_with_name("vehicle1_delta_v").is_ok());
/// assert!(schema.field_with_name("vehicle1_delta_v_p975").is_ok());
/// ```
#[must_use]
pub fn result_schema(job: Job, options: &RowOptions) -> SchemaRef {
    results::schema(job, options)
}

/// Checks once that columns from elsewhere match their types: text in UTF-8, places that exist. Data that
/// other programs hand over in memory are unchecked.
///
/// # Errors
/// [`TableError::Damaged`], with the first column that does not.
pub fn check_columns(batch: &RecordBatch) -> Result<(), TableError> {
    use arrow_array::Array as _;
    for (field, array) in batch.schema_ref().fields().iter().zip(batch.columns()) {
        array
            .to_data()
            .validate_full()
            .map_err(|reason| TableError::Damaged { column: field.name().clone(), reason })?;
    }
    Ok(())
}

/// The columns of a table that give no key and no seed, by their places: those to carry over.
///
/// # Errors
/// [`TableError::UnknownKey`] where a column looks like a key.
pub fn columns_kept(schema: &Schema) -> Result<Vec<usize>, TableError> {
    plan::others(schema)
}

/// [`run`] for [`Job::Reconstruct`], without progress.
///
/// # Errors
/// As for [`run`].
pub fn reconstruct(
    batch: &RecordBatch,
    template: &RowTemplate,
    options: &RowOptions,
) -> Result<RecordBatch, TableError> {
    run(Job::Reconstruct, batch, template, options, &|_, _| ControlFlow::Continue(()))
}

/// The results of each row, in the order of the rows. A row that is wrong, or has no answer, has a sentence
/// in the column `error`.
///
/// With the feature `parallel`, the rows run on the threads of the rayon pool in which this is called.
/// The results have the same bits with any number of them.
///
/// # Errors
/// [`TableError`] if the table as a whole cannot be read, if the options are invalid, or if `progress` ends
/// the run.
pub fn run(
    job: Job,
    batch: &RecordBatch,
    template: &RowTemplate,
    options: &RowOptions,
    progress: &RowProgress<'_>,
) -> Result<RecordBatch, TableError> {
    run_with_faults(job, batch, &[], template, options, progress)
}

/// [`run`] for rows in which reading may have found faults: such a row has its fault in the column `error`.
///
/// # Errors
/// As for [`run`].
pub fn run_with_faults(
    job: Job,
    batch: &RecordBatch,
    faults: RowFaults<'_>,
    template: &RowTemplate,
    options: &RowOptions,
    progress: &RowProgress<'_>,
) -> Result<RecordBatch, TableError> {
    options.check(job)?;
    let plan = Plan::of(batch)?;
    let total = batch.num_rows();
    let row = Row {
        job,
        plan: &plan,
        faults,
        template,
        options,
        progress,
        total,
        done: AtomicUsize::new(0),
        is_ended: AtomicBool::new(false),
    };
    let mut builder = Builder::new(job, options);
    for begin in (0..total).step_by(AT_ONCE) {
        for outcome in row.outcomes(begin..total.min(begin + AT_ONCE)) {
            let Some(outcome) = outcome else {
                return Err(TableError::Ended { finished: builder.finish()?, total });
            };
            builder.push(&outcome);
        }
    }
    builder.finish()
}

/// The columns whose bare numbers are taken as SI because nothing gives their unit, each with the unit.
///
/// # Errors
/// [`TableError`] where the columns cannot be read.
pub fn assumed_units(batch: &RecordBatch) -> Result<Vec<(String, &'static str)>, TableError> {
    Ok(Plan::of(batch)?.assumed(batch.num_rows()))
}

/// The data that all rows share, and their progress.
struct Row<'a> {
    job: Job,
    plan: &'a Plan<'a>,
    faults: RowFaults<'a>,
    template: &'a RowTemplate,
    options: &'a RowOptions,
    progress: &'a RowProgress<'a>,
    total: usize,
    done: AtomicUsize,
    is_ended: AtomicBool,
}

impl Row<'_> {
    /// Rows are begun in their order, so that few are finished after an unfinished one if the run is ended.
    #[cfg(feature = "parallel")]
    fn outcomes(&self, rows: std::ops::Range<usize>) -> Vec<Option<Outcome>> {
        use rayon::iter::{ParallelBridge as _, ParallelIterator as _};
        let mut outcomes: Vec<_> = rows.par_bridge().map(|row| (row, self.outcome(row))).collect();
        outcomes.sort_unstable_by_key(|(row, _)| *row);
        outcomes.into_iter().map(|(_, outcome)| outcome).collect()
    }

    #[cfg(not(feature = "parallel"))]
    fn outcomes(&self, rows: std::ops::Range<usize>) -> Vec<Option<Outcome>> {
        rows.map(|row| self.outcome(row)).collect()
    }

    /// Asks whether to continue; an end applies to all rows.
    fn goes_on(&self) -> ControlFlow<()> {
        let done = self.done.load(Ordering::Relaxed);
        if self.is_ended.load(Ordering::Relaxed) || (self.progress)(done, self.total).is_break() {
            self.is_ended.store(true, Ordering::Relaxed);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// `None` for a row that was not begun, or not finished, before the end.
    fn outcome(&self, row: usize) -> Option<Outcome> {
        if self.is_ended.load(Ordering::Relaxed) {
            return None;
        }
        let outcome =
            self.solved(row).unwrap_or_else(|refusal| Outcome { found: None, refusal: Some(refusal) });
        // A long row asks in between whether the run is ended, and then stops.
        let asks = matches!(self.job, Job::Estimate | Job::Avoid) || self.options.samples.is_some();
        if asks && self.is_ended.load(Ordering::Relaxed) {
            return None;
        }
        self.done.fetch_add(1, Ordering::Relaxed);
        let _ = self.goes_on();
        Some(outcome)
    }

    fn solved(&self, row: usize) -> Result<Outcome, RowRefusal> {
        let of_row = |error: String| RowRefusal { error, help: String::new() };
        if let Some(Some(fault)) = self.faults.get(row) {
            return Err(of_row(fault.clone()));
        }
        let mut values = self.template.shared.borrowed();
        merge(&mut values, self.plan.row(row).map_err(of_row)?);
        let seed = self.plan.seed(row).map_err(of_row)?.unwrap_or(self.options.seed);
        let of_case = |errors| RowRefusal::of_case(errors, &PROGRAM);
        let mut file = CaseFile::from_values("row", &values).map_err(of_case)?;
        read_records_beside(&self.template.path, &mut file, &PROGRAM).map_err(of_case)?;
        let case = &file.case;
        let refused = |failure: Failure| RowRefusal::of(&failure.into(), &file, &PROGRAM);
        let analyse = match self.job {
            Job::Reconstruct => analysis::reconstruct,
            Job::Impact => analysis::impact,
            Job::Crush => analysis::crush,
            Job::Avoid => {
                let samples = self.options.samples.unwrap_or(AvoidPlan::SAMPLES);
                let plan = AvoidPlan { samples, seed, ..AvoidPlan::default() };
                let found = analysis::avoid(case, &plan, &mut |_, _, _| self.goes_on()).map_err(refused)?;
                let refusal = found.speed_doubt.as_ref().map(|doubt| RowRefusal {
                    error: no_probability(doubt).to_owned(),
                    help: WHY_NO_ANSWER.to_owned(),
                });
                return Ok(Outcome { found: Some(Found::of_avoidance(case, &found)), refusal });
            }
            Job::Estimate => {
                let RowOptions { particles, prior, .. } = *self.options;
                let plan = EstimatePlan { particles, seed, prior, pieces: PieceDetail::Compared };
                let estimated =
                    analysis::estimate(case, &plan, &mut |_, _, _| self.goes_on()).map_err(refused)?;
                let refusal = estimated.no_answer().map(|doubt| match doubt {
                    NoEstimate::Unconverged => RowRefusal {
                        error: "the run has not converged, so it gives no intervals".to_owned(),
                        help: format!("{WHY_NO_ANSWER}; more particles may help"),
                    },
                    NoEstimate::Contradicted(_) => RowRefusal {
                        error: "the evidence contradicts itself, so it gives no single answer".to_owned(),
                        help: WHY_NO_ANSWER.to_owned(),
                    },
                });
                return Ok(Outcome { found: Some(Found::of_estimate(case, &estimated)), refusal });
            }
        };
        let analysis = analyse(case).map_err(refused)?;
        // Only uncertain numbers lead to intervals.
        let spread = match self.options.samples {
            None => None,
            Some(samples) => {
                let settings = Settings::new(SamplingMethod::MonteCarlo, samples, seed);
                let samples = analysis::samples(case, &settings, &mut |_, _| self.goes_on());
                samples.map_err(refused)?.as_ref().map(Spread::of)
            }
        };
        Ok(Outcome { found: Some(Found::of_analysis(case, &analysis, spread)), refusal: None })
    }
}
