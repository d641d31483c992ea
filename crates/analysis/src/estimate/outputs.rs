//! The results of each draw.

use ::estimate::{Evidence, Hurdle, Part, Posterior, Prior};
use ::uncertainty::{LANES, Lanes};
use evidence::{CollisionModel, Impacted, Impacts};
use inputs::Axes;
use pim_core::VehicleId;

use super::impacts::CaseImpacts;
use crate::output::Output;
use crate::quantities::{SKID_SPEED, SPEED};
use crate::uncertainty::beside;

/// The model of a case, with the results that are computed for each draw.
pub(super) struct Told<'a> {
    model: &'a CollisionModel<CaseImpacts>,
    outputs: Vec<Output>,
    axes: Axes,
    /// (rad) PDOF of both vehicles if the force were normal to the crush plane: the PDOFs of all draws are
    /// within half a turn of them.
    reference: [f64; 2],
}

/// The results that a case has: none for a fixed object, and those of a skid or of a path if there is one.
pub(super) fn of(impacts: &CaseImpacts) -> Vec<Output> {
    let is_told = |output: &Output| {
        output.vehicle().is_none_or(|vehicle| {
            let id = vehicle.index();
            let is_seen = match output.quantity() {
                row if row.is_of_path() => impacts.followed[id],
                _ => !output.is(&SKID_SPEED) || impacts.skids[id].is_some(),
            };
            is_seen && !impacts.impact.case.vehicles[id].fixed
        })
    };
    Output::drawn().into_iter().filter(is_told).collect()
}

impl<'a> Told<'a> {
    pub(super) fn new(model: &'a CollisionModel<CaseImpacts>, axes: Axes, reference: [f64; 2]) -> Self {
        let outputs = of(model.leads());
        Self { model, outputs, axes, reference }
    }

    pub(super) fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// The place of an output.
    pub(super) fn place(&self, wanted: Output) -> Option<usize> {
        self.outputs.iter().position(|output| *output == wanted)
    }

    /// The place among the outputs of the speed of a vehicle that moves.
    pub(super) fn speed_place(&self, id: VehicleId) -> Option<usize> {
        self.place(SPEED.of_vehicle(id))
    }

    /// Whether it is the speed of a vehicle that the case gives.
    pub(super) fn is_given(&self, output: Output) -> bool {
        let given = output.vehicle().filter(|_| output.is(&SPEED));
        given.is_some_and(|vehicle| !self.model.leads().speeds.is_open(vehicle))
    }

    /// (SI) the draws of an output.
    pub(super) fn draws<'p>(&self, posterior: &'p Posterior, wanted: Output) -> Option<&'p [f64]> {
        posterior.outputs().get(self.place(wanted)?).map(Vec::as_slice)
    }

    /// (m/s) the draws of the speed of a vehicle that moves.
    pub(super) fn speed<'p>(&self, posterior: &'p Posterior, id: VehicleId) -> Option<&'p [f64]> {
        self.draws(posterior, SPEED.of_vehicle(id))
    }

    fn value(&self, output: Output, impacted: &Impacted) -> f64 {
        let value = output.of_draw(self.axes, impacted);
        match output.vehicle() {
            Some(vehicle) if output.quantity().is_direction => beside(value, self.reference[vehicle.index()]),
            _ => value,
        }
    }
}

impl Prior for Told<'_> {
    fn values_count(&self) -> usize {
        self.model.values_count()
    }

    #[inline(always)]
    fn values(&self, standard: &[Lanes], values: &mut [Lanes]) {
        self.model.values(standard, values);
    }
}

impl Evidence for Told<'_> {
    fn terms_count(&self) -> usize {
        self.model.terms_count()
    }

    #[inline(always)]
    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        self.model.log_likelihood(values, terms, reasons);
    }

    fn log_likelihood_of_used(
        &self,
        values: &[Lanes],
        used: &[bool],
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        self.model.log_likelihood_of_used(values, used, terms, reasons);
    }

    fn log_likelihood_of_proposals(
        &self,
        values: &[Lanes],
        hurdle: &Hurdle<'_>,
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> bool {
        self.model.log_likelihood_of_proposals(values, hurdle, terms, reasons)
    }

    fn parts(&self) -> Vec<Part> {
        self.model.parts()
    }

    fn score_on_circle(&self, part: usize, error: f64) -> f64 {
        self.model.score_on_circle(part, error)
    }

    fn outputs_count(&self) -> usize {
        self.outputs.len()
    }

    fn describe(&self, values: &[Lanes], outputs: &mut [Lanes], residuals: &mut [Lanes]) {
        let impacts = self.model.leads().impacts(values);
        for (column, output) in outputs.iter_mut().zip(&self.outputs) {
            for (number, impacted) in column.iter_mut().zip(&impacts) {
                *number = self.value(*output, impacted);
            }
        }
        self.model.score(&impacts, residuals);
    }
}
