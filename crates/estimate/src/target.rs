//! Evaluates prior and evidence for a block of particles.

use uncertainty::dispatch;
use uncertainty::{Instructions, LANES, Lanes};

use crate::error::NoDraws;
use crate::model::{Evidence, Faded, Hurdle, Prior, sum_of_used};

/// Prior and evidence, and the pieces of evidence used.
#[derive(Clone, Debug)]
pub(crate) struct Target<'a, P, E> {
    pub(crate) prior: &'a P,
    pub(crate) evidence: &'a E,
    pub(crate) used: Vec<bool>,
    pub(crate) faded: Option<Faded>,
    pub(crate) instructions: Instructions,
}

/// The evaluation of one block.
#[derive(Clone, Debug)]
pub(crate) struct Evaluation {
    pub(crate) values: Vec<Lanes>,
    pub(crate) terms: Vec<Lanes>,
    pub(crate) reasons: [u8; LANES],
    /// Sum of the used terms; −∞ if the particle is impossible.
    pub(crate) log_likelihood: Lanes,
}

impl<P: Prior, E: Evidence> Target<'_, P, E> {
    pub(crate) fn dimensions(&self) -> usize {
        self.prior.values_count()
    }

    pub(crate) fn evaluation(&self) -> Evaluation {
        Evaluation {
            values: vec![Lanes::ZERO; self.dimensions()],
            terms: vec![Lanes::ZERO; self.used.len()],
            reasons: [0; LANES],
            log_likelihood: Lanes::ZERO,
        }
    }

    /// Evaluates a block of standard normal numbers, with all terms.
    pub(crate) fn evaluate(&self, standard: &[Lanes], into: &mut Evaluation) -> Result<(), NoDraws> {
        self.evaluate_for(standard, Wanted::All, into)
    }

    /// Evaluates a block of standard normal numbers, with the terms wanted.
    #[inline(never)]
    pub(crate) fn evaluate_for(
        &self,
        standard: &[Lanes],
        wanted: Wanted<'_>,
        into: &mut Evaluation,
    ) -> Result<(), NoDraws> {
        dispatch!(self.instructions, evaluate_with(self, standard, wanted, into));
        // A sum that contains NaN or +∞ is NaN or +∞, even −∞ + ∞.
        let is_likelihood = |sum: &f64| *sum < f64::INFINITY;
        if into.log_likelihood.iter().all(is_likelihood) { Ok(()) } else { Err(self.not_a_likelihood(into)) }
    }

    #[cold]
    fn not_a_likelihood(&self, of: &Evaluation) -> NoDraws {
        let lane = of.log_likelihood.iter().position(|sum| sum.is_nan() || *sum == f64::INFINITY);
        let lane = lane.unwrap_or_default();
        let used = of.terms.iter().zip(&self.used).enumerate().filter(|(_, (_, used))| **used);
        let culprit = used
            .map(|(term, (column, _))| (term, column[lane]))
            .find(|(_, value)| value.is_nan() || *value == f64::INFINITY);
        // If each term is finite, their sum has overflowed.
        let (term, value) = culprit.unwrap_or((0, of.log_likelihood[lane]));
        let values = of.values.iter().map(|column| column[lane]).collect();
        NoDraws::NotALikelihood { term, value, values }
    }
}

/// The terms wanted for a block.
#[derive(Clone, Copy)]
pub(crate) enum Wanted<'a> {
    /// All terms.
    All,
    /// The used terms.
    Used,
    /// The terms of the proposals that a hurdle accepts.
    Taken(&'a Hurdle<'a>),
}

#[inline(always)]
fn evaluate_with<P: Prior, E: Evidence>(
    target: &Target<'_, P, E>,
    standard: &[Lanes],
    wanted: Wanted<'_>,
    into: &mut Evaluation,
) {
    into.reasons = [0; LANES];
    target.prior.values(standard, &mut into.values);
    let Evaluation { values, terms, reasons, .. } = into;
    match wanted {
        Wanted::All => target.evidence.log_likelihood(values, terms, reasons),
        Wanted::Used => target.evidence.log_likelihood_of_used(values, &target.used, terms, reasons),
        Wanted::Taken(hurdle) => {
            if !target.evidence.log_likelihood_of_proposals(values, hurdle, terms, reasons) {
                target.evidence.log_likelihood_of_used(values, &target.used, terms, reasons);
            }
        }
    }
    into.log_likelihood = sum_of_used(terms, &target.used, target.faded);
    for (sum, reason) in into.log_likelihood.iter_mut().zip(&into.reasons) {
        *sum = if *reason == 0 { *sum } else { f64::NEG_INFINITY };
    }
}
