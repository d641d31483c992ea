//! The prior, and the likelihood of the evidence.

use uncertainty::{Distribution, Function, Instructions, LANES, Lanes, Model as _};

/// The prior: transforms independent standard normal numbers into the unknown values.
///
/// [`Independent`] does this for independent values. In a custom prior a value may depend on those before it.
///
/// Mark [`values`](Self::values) `#[inline(always)]`, as explained at [`uncertainty::Model`].
pub trait Prior: Sync {
    /// Number of unknown values, and of the standard normal numbers from which they are computed.
    fn values_count(&self) -> usize;

    /// Turns a block of standard normal numbers into values, a column for each.
    fn values(&self, standard: &[Lanes], values: &mut [Lanes]);
}

/// Independent unknown values.
#[derive(Clone, Debug)]
pub struct Independent(pub Vec<Distribution>);

impl Prior for Independent {
    fn values_count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn values(&self, standard: &[Lanes], values: &mut [Lanes]) {
        for ((value, number), distribution) in values.iter_mut().zip(standard).zip(&self.0) {
            *value = *number;
            distribution.from_standard_normals(value);
        }
    }
}

/// The evidence: a log-likelihood of the unknown values in terms, one for each piece of evidence, for
/// [`LANES`] particles at once.
///
/// Each lane must depend only on its own values; then a run has the same bits for any number of threads. If
/// [`log_likelihood`](Self::log_likelihood) and all functions that it calls are marked `#[inline(always)]`
/// and cannot panic, its loops over the lanes are vectorised. [`LikelihoodFunction`] makes evidence from a
/// function of one particle.
pub trait Evidence: Sync {
    /// Number of pieces of evidence.
    fn terms_count(&self) -> usize;

    /// Writes the log-likelihood of each piece of evidence, a column for each: −∞ if the piece excludes the
    /// particle. It must include the normalising constant if the log evidence is to be meaningful.
    ///
    /// A particle for which the model has no result gets a reason from 1 to 254 in `reasons`, which are
    /// initially 0; it is then impossible, whatever its terms.
    ///
    /// NaN and +∞ are not log-likelihoods: they end the run with an error.
    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]);

    /// The same for the terms that are `used`: the others may be left as they are, so that a model can skip
    /// slow ones. It may then also miss that a particle is impossible, if only an unused term would show it:
    /// the final draws are evaluated with all terms, and impossible ones are removed.
    fn log_likelihood_of_used(
        &self,
        values: &[Lanes],
        used: &[bool],
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        let _ = used;
        self.log_likelihood(values, terms, reasons);
    }

    /// The same for proposals. Only those that `hurdle` accepts matter, so a model can skip slow terms for
    /// the others: if a proposal is rejected even with the maximum of a term, this maximum may replace the
    /// term. Returns whether the model has written the terms; if not,
    /// [`log_likelihood`](Self::log_likelihood) is called.
    ///
    /// The draws have the same bits either way.
    fn log_likelihood_of_proposals(
        &self,
        values: &[Lanes],
        hurdle: &Hurdle<'_>,
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> bool {
        let _ = (values, hurdle, terms, reasons);
        false
    }

    /// Number of further outputs of each draw.
    fn outputs_count(&self) -> usize {
        0
    }

    /// Writes the outputs and residuals of each draw. It is called once, for the final particles, which are
    /// all possible.
    ///
    /// `outputs` has a column for each output, which must become finite. `residuals` has one for each of
    /// [`parts`](Self::parts), initially NaN, for the normal score of the observation: the standard normal
    /// number z for which Φ(z) is the probability that a new observation with these values would lie below
    /// the actual one. For a normal error this is (observed − predicted)/σ. A piece that is not a
    /// measurement, such as a limit, has none. For a part on a circle it is the error itself, observed −
    /// predicted, up to any number of full turns.
    fn describe(&self, values: &[Lanes], outputs: &mut [Lanes], residuals: &mut [Lanes]) {
        let _ = (values, outputs, residuals);
    }

    /// The parts of the pieces of evidence, each with a column of `residuals`: one for each piece, unless a
    /// piece is a vector or an angle.
    fn parts(&self) -> Vec<Part> {
        (0..self.terms_count()).map(Part::of).collect()
    }

    /// The normal score for an error of a part on a circle, which may be greater than half a turn.
    fn score_on_circle(&self, part: usize, error: f64) -> f64 {
        let _ = part;
        error
    }
}

/// One number of a piece of evidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Index of the piece.
    pub term: usize,
    /// (units of the error) a full turn; `None` for a number that is not on a circle.
    pub turn: Option<f64>,
}

impl Part {
    /// The only part of a piece, not on a circle.
    #[must_use]
    pub fn of(term: usize) -> Self {
        Self { term, turn: None }
    }
}

/// Evidence from a function of one particle.
#[derive(Clone, Debug)]
pub struct LikelihoodFunction<F>(Function<F>);

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> LikelihoodFunction<F> {
    /// Evidence from a function that reads the values of a particle and writes its terms, or fails with a
    /// reason from 1 to 254; another counts as [`uncertainty::NOT_FINITE`].
    pub fn new(terms: usize, function: F) -> Self {
        Self(Function::new(terms, function))
    }
}

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> Evidence for LikelihoodFunction<F> {
    fn terms_count(&self) -> usize {
        self.0.outputs()
    }

    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        self.0.evaluate(Instructions::best(), values, terms, reasons);
    }
}

/// The condition on the terms of a block of proposals for acceptance (Metropolis and Hastings).
#[derive(Clone, Copy, Debug)]
pub struct Hurdle<'a> {
    /// For each term, whether it is used.
    pub(crate) used: &'a [bool],
    /// The term that counts only in part.
    pub(crate) faded: Option<Faded>,
    /// (–) β.
    pub(crate) temperature: f64,
    /// (–) l of the present particles.
    pub(crate) before: &'a Lanes,
    /// (–) ln of the ratio of prior and proposal densities.
    pub(crate) log_ratio: &'a Lanes,
    /// (–) ln of a uniform number between 0 and 1.
    pub(crate) log_share: &'a Lanes,
}

/// A term that counts only in part while it is removed from the likelihood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Faded {
    pub(crate) term: usize,
    /// (–) exponent of its likelihood, from 1 to 0.
    pub(crate) share: f64,
}

impl Hurdle<'_> {
    /// For each term, whether it is used.
    #[must_use]
    pub fn used(&self) -> &[bool] {
        self.used
    }

    /// Whether each proposal is accepted with these terms. A proposal that is rejected would also be rejected
    /// with lower terms, whatever the rounding.
    #[must_use]
    pub fn takes(&self, terms: &[Lanes]) -> [bool; LANES] {
        let sums = sum_of_used(terms, self.used, self.faded);
        std::array::from_fn(|lane| self.takes_sum(lane, sums[lane]))
    }

    /// Whether a log-likelihood is high enough.
    #[inline(always)]
    pub(crate) fn takes_sum(&self, lane: usize, log_likelihood: f64) -> bool {
        // ln α = β (l′ − l) + ln of the ratio of prior and proposal densities
        let log_ratio = self.temperature * (log_likelihood - self.before[lane]) + self.log_ratio[lane];
        self.log_share[lane] < log_ratio
    }
}

/// Sum of the used terms, with `faded` weighted by its share.
#[inline(always)]
pub(crate) fn sum_of_used(terms: &[Lanes], used: &[bool], faded: Option<Faded>) -> Lanes {
    let mut sums = Lanes::ZERO;
    for (place, (term, used)) in terms.iter().zip(used).enumerate() {
        if *used {
            let share = faded.filter(|faded| faded.term == place).map_or(1.0, |faded| faded.share);
            for (sum, term) in sums.iter_mut().zip(term) {
                *sum += share * term;
            }
        }
    }
    sums
}

/// The pieces of evidence used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// All.
    #[default]
    All,
    /// All but these.
    Without(Vec<usize>),
    /// Only these.
    Only(Vec<usize>),
}

impl Selection {
    /// For each of `terms` pieces, whether it is used.
    pub(crate) fn flags(&self, terms: usize) -> Vec<bool> {
        let is_used = |term| match self {
            Self::All => true,
            Self::Without(left_out) => !left_out.contains(&term),
            Self::Only(kept) => kept.contains(&term),
        };
        (0..terms).map(is_used).collect()
    }

    /// The pieces named by the selection.
    pub(crate) fn named(&self) -> &[usize] {
        match self {
            Self::All => &[],
            Self::Without(named) | Self::Only(named) => named,
        }
    }
}
