//! What is known before the evidence, and what the evidence says.

use uncertainty::{Distribution, LANES, Lanes};

/// What is known before the evidence: how independent standard normal numbers become the unknown values.
///
/// [`Independent`] does this for values that are independent of each other. A prior of one's own may let a
/// value depend on those before it.
///
/// Mark [`values`](Self::values) `#[inline(always)]`, as [`uncertainty::Model`] says.
pub trait Prior: Sync {
    /// Number of unknown values, and of the standard normal numbers that they are made of.
    fn values_count(&self) -> usize;

    /// Turns a block of standard normal numbers into values, a column for each.
    fn values(&self, standard: &[Lanes], values: &mut [Lanes]);
}

/// Unknown values that are independent of each other.
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

/// What the evidence says of unknown values: a log-likelihood in terms, one for each piece of evidence, for
/// [`LANES`] particles at once.
///
/// Each lane must depend only on its own values; then a run has the same bits for any number of threads. If
/// [`log_likelihood`](Self::log_likelihood) and all functions that it calls are marked `#[inline(always)]`
/// and cannot panic, its loops over the lanes are vectorised. [`LikelihoodFunction`] makes evidence of a
/// function of one particle.
pub trait Evidence: Sync {
    /// Number of pieces of evidence.
    fn terms_count(&self) -> usize;

    /// Writes the logarithm of the likelihood of each piece of evidence, a column for each: −∞ where the
    /// piece excludes the particle. The constant that makes it a density belongs in it where the log
    /// evidence is to
    /// mean something.
    ///
    /// A particle of which the model makes nothing at all gets a reason from 1 to 254 in `reasons`, which are
    /// 0 at the start; it is then impossible, whatever its terms.
    ///
    /// Neither NaN nor +∞ is a log-likelihood: they end the run with an error.
    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]);

    /// The same for the terms that are `used`: the others may be left as they are, and a model of which they
    /// take long does without them. What makes a particle impossible may then be left out, too, where only
    /// the terms that are not used would find it: the draws at the end are asked for everything, and those
    /// that are impossible are taken out.
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

    /// The same for proposals, of which nothing matters but those that `hurdle` takes: a model of which some
    /// terms take long may leave the others without them. Where a proposal is not taken even with the most
    /// that a term can be, this most may stand in the term's place. Whether it has written the terms; where
    /// not, [`log_likelihood`](Self::log_likelihood) is asked.
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

    /// Number of further quantities that are wanted of each draw.
    fn outputs_count(&self) -> usize {
        0
    }

    /// What is wanted of each draw beside its values. It is called once for the particles at the end, all of
    /// which are possible.
    ///
    /// `outputs` has a column for each output, which must become finite. `residuals` has one for each of
    /// [`parts`](Self::parts), NaN at the start, for the normal score of what was observed: the standard
    /// normal number z for which Φ(z) is the probability that the part, were it observed anew with these
    /// values, would turn out below what was observed. For a normal error this is (observed − predicted)/σ.
    /// A piece that is no measurement, such as a limit, has none. Of a part on a circle it is the error
    /// itself, observed − predicted, to any number of full turns.
    fn describe(&self, values: &[Lanes], outputs: &mut [Lanes], residuals: &mut [Lanes]) {
        let _ = (values, outputs, residuals);
    }

    /// The numbers of which the pieces of evidence consist, a column of `residuals` for each: one for each
    /// piece, unless a piece is a vector or an angle.
    fn parts(&self) -> Vec<Part> {
        (0..self.terms_count()).map(Part::of).collect()
    }

    /// The normal score of an error of a part on a circle, which may be greater than half a turn.
    fn score_on_circle(&self, part: usize, error: f64) -> f64 {
        let _ = part;
        error
    }
}

/// A number of which a piece of evidence consists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Number of the piece.
    pub term: usize,
    /// (units of the error) what makes a full turn; `None` of a number that is on no circle.
    pub turn: Option<f64>,
}

impl Part {
    /// The only one of a piece, on no circle.
    #[must_use]
    pub fn of(term: usize) -> Self {
        Self { term, turn: None }
    }
}

/// Evidence made of a function of one particle.
#[derive(Clone, Debug)]
pub struct LikelihoodFunction<F> {
    terms: usize,
    function: F,
}

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> LikelihoodFunction<F> {
    /// The function reads the values of a particle and writes its terms, or fails with a reason from 1 to
    /// 254.
    pub fn new(terms: usize, function: F) -> Self {
        Self { terms, function }
    }
}

impl<F: Fn(&[f64], &mut [f64]) -> Result<(), u8> + Sync> Evidence for LikelihoodFunction<F> {
    fn terms_count(&self) -> usize {
        self.terms
    }

    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        let mut particle = vec![0.0; values.len()];
        let mut of_particle = vec![0.0; terms.len()];
        for (lane, reason) in reasons.iter_mut().enumerate() {
            for (value, column) in particle.iter_mut().zip(values) {
                *value = column[lane];
            }
            match (self.function)(&particle, &mut of_particle) {
                Ok(()) => {
                    for (term, column) in of_particle.iter().zip(terms.iter_mut()) {
                        column[lane] = *term;
                    }
                }
                Err(code) => *reason = code,
            }
        }
    }
}

/// What the terms of a block of proposals have to reach for these to be accepted (Metropolis and Hastings).
#[derive(Clone, Copy, Debug)]
pub struct Hurdle<'a> {
    /// For each term, whether it is used.
    pub(crate) used: &'a [bool],
    /// The term that counts by less than all of it.
    pub(crate) faded: Option<Faded>,
    /// (–) β.
    pub(crate) temperature: f64,
    /// (–) l of the particles where they are.
    pub(crate) before: &'a Lanes,
    /// (–) ln of the ratio of priors and proposals.
    pub(crate) log_ratio: &'a Lanes,
    /// (–) ln of a number that is drawn between 0 and 1.
    pub(crate) log_share: &'a Lanes,
}

/// A term of which a share counts, while it is taken out of the likelihood.
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

    /// Which proposals are accepted where these are their terms. One that is not would neither be with lower
    /// terms: no rounding changes that.
    #[must_use]
    pub fn takes(&self, terms: &[Lanes]) -> [bool; LANES] {
        let sums = sum_of_used(terms, self.used, self.faded);
        std::array::from_fn(|lane| self.takes_sum(lane, sums[lane]))
    }

    /// Whether a log-likelihood is enough.
    #[inline(always)]
    pub(crate) fn takes_sum(&self, lane: usize, log_likelihood: f64) -> bool {
        // ln α = β (l′ − l) + ln of the ratio of priors and proposals
        let log_ratio = self.temperature * (log_likelihood - self.before[lane]) + self.log_ratio[lane];
        self.log_share[lane] < log_ratio
    }
}

/// Sum of the terms that are used, of `faded` its share.
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

/// Which pieces of evidence are used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// All.
    #[default]
    All,
    /// All but these.
    Without(Vec<usize>),
    /// These alone.
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

    /// The pieces that it names.
    pub(crate) fn named(&self) -> &[usize] {
        match self {
            Self::All => &[],
            Self::Without(named) | Self::Only(named) => named,
        }
    }
}
