//! The effect of the ranges of a case on its results.

use analysis::{Failure, Plan, Stage, Uncertainty};
use case::Case;
use report::{Drawing, Units};
use serde::{Serialize, Serializer};
use uncertainty::{MIN_SAMPLES, SamplingMethod, Settings};

use crate::options::{OptionError, RequestOptions};
use crate::progress::{RequestProgress, counted};

/// How samples are drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UncertaintyOptions {
    /// Their number; without, [`analysis::usual_samples`].
    pub samples: Option<usize>,
    /// The random seed: the same seed gives the same results.
    pub seed: u64,
    /// The method of sampling.
    #[serde(serialize_with = "method")]
    pub method: SamplingMethod,
    /// Rows for Sobol' indices; without, there are none.
    pub indices: Option<usize>,
    /// The results that are wanted, by their JSON keys; without, all.
    pub outputs: Option<Vec<String>>,
}

/// The word for it.
fn method<S: Serializer>(method: &SamplingMethod, out: S) -> Result<S::Ok, S::Error> {
    method.name().serialize(out)
}

impl Default for UncertaintyOptions {
    fn default() -> Self {
        Self { samples: None, seed: 1, method: SamplingMethod::MonteCarlo, indices: None, outputs: None }
    }
}

impl UncertaintyOptions {
    pub(crate) fn check(&self) -> Result<(), OptionError> {
        let Some(rows) = self.indices.filter(|rows| *rows < MIN_SAMPLES) else { return Ok(()) };
        let advice = format!("the number of rows must be at least {MIN_SAMPLES}");
        Err(OptionError::Value { option: "sobol", given: rows.to_string(), advice })
    }

    pub(crate) fn read(options: &RequestOptions) -> Result<Self, OptionError> {
        let default = Self::default();
        Ok(Self {
            samples: options.size("samples")?,
            method: options.word("method", &SamplingMethod::WORDS)?.unwrap_or(default.method),
            seed: options.count("seed")?.unwrap_or(default.seed),
            indices: options.size("indices")?,
            outputs: options.texts("outputs")?,
        })
    }

    pub(crate) fn answer(
        &self,
        case: &Case,
        progress: &mut RequestProgress<'_>,
    ) -> Result<Uncertainty, Failure> {
        let samples = self.samples.unwrap_or_else(|| analysis::usual_samples(case));
        let settings = Settings::new(self.method, samples, self.seed);
        let plan = Plan { settings, index_rows: self.indices };
        let wanted =
            |output: analysis::Output| self.outputs.as_ref().is_none_or(|of| of.contains(&output.path()));
        analysis::uncertainty_of(case, &plan, &wanted, &mut |stage: Stage, done, total| {
            progress(counted(stage), done, total)
        })
    }
}

/// The histogram and the tornado of each output that varies, each with its name and the key of the output.
pub fn plots(
    case: &Case,
    uncertainty: &Uncertainty,
    units: Units,
) -> impl Iterator<Item = (&'static str, String, Drawing)> {
    uncertainty.outputs.iter().enumerate().flat_map(move |(place, output)| {
        let drawings = [
            ("histogram", report::histogram(case, uncertainty, place, units)),
            ("tornado", report::tornado(case, uncertainty, place, units)),
        ];
        let key = output.output.path();
        drawings.into_iter().filter_map(move |(name, drawing)| Some((name, key.clone(), drawing?)))
    })
}
