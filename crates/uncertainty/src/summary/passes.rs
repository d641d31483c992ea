//! A summary from one pass over a column, and from further ones where that one does not suffice.

use super::order::Order;
use super::powers::{Moments, Powers};
use super::watched::Watched;
use super::{Below, Errors, PROBABILITIES, Place, QUANTILES, Summary, tail_is_populated};
use crate::limits::REPLICATES;

/// What a [`Summary`] follows from: nearly always what a first pass has found, and otherwise more passes, in
/// each of which the column has to come whole. Whichever it takes, the summary has the same bits.
#[derive(Debug)]
pub(crate) struct Passes<'m> {
    /// Of all samples, and of those of each replicate, where there are replicates.
    moments: Moments,
    replicates: Vec<Powers>,
    order: Order<'m>,
    stage: Stage,
    quantiles: [f64; QUANTILES],
    summary: Option<Summary>,
}

/// What the next pass is for.
#[derive(Debug)]
enum Stage {
    /// Some order statistics are still to be found.
    Quantiles(Box<[Place; QUANTILES]>),
    Below(Box<Below>),
    Distances(Box<[[Place; 2]; QUANTILES]>),
    Done,
}

impl<'m> Passes<'m> {
    /// After the first pass over a column, which was watched; `powers` are those of each replicate, or by
    /// Monte Carlo of all samples. `most` is how many values may be taken out at once.
    pub(crate) fn new(watched: Watched<'m>, powers: &[Powers], most: usize) -> Self {
        let moments = Powers::of_all(powers).moments(watched.centre);
        let replicates = if powers.len() == REPLICATES { powers.to_vec() } else { Vec::new() };
        let order = Order::new(watched, most);
        let (stage, quantiles) = (Stage::Done, [f64::NAN; QUANTILES]);
        let mut passes = Self { moments, replicates, order, stage, quantiles, summary: None };
        if moments.count >= 2 {
            let places = Box::new(PROBABILITIES.map(|probability| Place::of(probability, moments.count)));
            let are_known = passes.order.seek(places.iter().flat_map(Place::wanted), moments.count);
            passes.stage = if are_known { passes.after_quantiles(&places) } else { Stage::Quantiles(places) };
        }
        passes
    }

    /// The samples that follow, from the first replicate on.
    pub(crate) fn add(&mut self, column: &[f64]) {
        match &mut self.stage {
            Stage::Quantiles(_) | Stage::Distances(_) => self.order.take(column),
            Stage::Below(below) => below.add(column),
            Stage::Done => {}
        }
    }

    /// Ends a pass, and tells whether another one is wanted.
    pub(crate) fn go_on(&mut self) -> bool {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Quantiles(places) if self.order.settle() => self.after_quantiles(&places),
            Stage::Below(below) => self.after_below(&below),
            Stage::Distances(ends) if self.order.settle() => self.after_distances(&ends),
            unsettled => unsettled,
        };
        !self.are_done()
    }

    fn after_quantiles(&mut self, places: &[Place; QUANTILES]) -> Stage {
        self.quantiles = places.each_ref().map(|place| place.value(&self.order));
        if self.replicates.is_empty() {
            return self.done(places.each_ref().map(|place| place.half_distance(&self.order)));
        }
        if self.replicates.iter().any(|powers| powers.count < 2) {
            return self.done([None; QUANTILES]);
        }
        let mut below = Below::new(self.quantiles);
        match self.order.watched().twice_below(&self.quantiles) {
            Some(twice) => {
                below.twice = twice;
                self.after_below(&below)
            }
            None => Stage::Below(Box::new(below)),
        }
    }

    fn after_below(&mut self, below: &Below) -> Stage {
        let counts = std::array::from_fn(|own| self.replicates.get(own).map_or(0, |powers| powers.count));
        let ends = Box::new(below.ends(&counts));
        if self.order.seek(ends.iter().flatten().flat_map(Place::wanted), self.moments.count) {
            self.after_distances(&ends)
        } else {
            Stage::Distances(ends)
        }
    }

    fn after_distances(&mut self, ends: &[[Place; 2]; QUANTILES]) -> Stage {
        let distance =
            |[before, after]: &[Place; 2]| 0.5 * (after.value(&self.order) - before.value(&self.order));
        let found = ends.each_ref().map(distance);
        let populated = PROBABILITIES.map(|probability| tail_is_populated(probability, self.moments.count));
        self.done(std::array::from_fn(|place| populated[place].then_some(found[place])))
    }

    /// With the standard errors of the quantiles, the summary is known.
    fn done(&mut self, errors: [Option<f64>; QUANTILES]) -> Stage {
        let errors = if self.replicates.is_empty() {
            Errors::by_formula(&self.moments, errors)
        } else {
            let centre = self.order.watched().centre;
            let answered = self.replicates.iter().filter(|powers| powers.count >= 2);
            let replicates: Vec<Moments> = answered.map(|powers| powers.moments(centre)).collect();
            Errors::by_replicates(&replicates, errors)
        };
        self.summary = Some(Summary::new(&self.moments, &self.quantiles, &errors));
        Stage::Done
    }

    /// Whether no pass is wanted any more.
    pub(crate) fn are_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// `None` where fewer than two samples have an answer, and before the last pass.
    pub(crate) fn summary(&self) -> Option<Summary> {
        self.summary
    }
}
