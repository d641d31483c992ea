//! The results of each draw.

use ::estimate::{Evidence, Hurdle, Part, Posterior, Prior};
use ::uncertainty::{LANES, Lanes};
use evidence::{Impacted, Impacts, Model};
use inputs::Axes;
use pim_core::VehicleId;

use super::impacts::CaseImpacts;
use crate::quantities::{Kind, quantity};
use crate::sensitivity::{Output, WayNumber};
use crate::uncertainty::beside;

/// A result of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimateOutput {
    /// One that other analyses have, too.
    Result(Output),
    /// (–) e.
    Restitution,
    /// (–) μ.
    ImpulseRatio,
    /// (J) crush energy of both vehicles.
    CrushEnergy,
    /// (m/s) speed where the skid of a vehicle before the impact begins.
    SkidSpeed(VehicleId),
}

impl EstimateOutput {
    /// The key of the JSON that names it.
    #[must_use]
    pub fn path(self) -> String {
        match self {
            Self::Result(output) => output.path(),
            Self::Restitution => "impact.restitution".to_owned(),
            Self::ImpulseRatio => "impact.impulse_ratio".to_owned(),
            Self::CrushEnergy => "crush_energy".to_owned(),
            Self::SkidSpeed(vehicle) => format!("vehicle{vehicle}.skid.speed"),
        }
    }

    /// What kind of number it is.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::Result(output) => quantity(output.key()).map_or(Kind::Speed, |row| row.kind),
            Self::Restitution | Self::ImpulseRatio => Kind::Ratio,
            Self::CrushEnergy => Kind::Energy,
            Self::SkidSpeed(_) => Kind::Speed,
        }
    }

    /// The vehicle that it belongs to; none for one of the collision.
    #[must_use]
    pub fn vehicle(self) -> Option<VehicleId> {
        match self {
            Self::Result(output) => output.vehicle(),
            Self::SkidSpeed(vehicle) => Some(vehicle),
            Self::Restitution | Self::ImpulseRatio | Self::CrushEnergy => None,
        }
    }
}

/// The model of a case, with the results that are told of each draw.
pub(super) struct Told<'a> {
    model: &'a Model<CaseImpacts>,
    outputs: Vec<EstimateOutput>,
    /// (rad) PDOF of both vehicles if the force were normal to the crush plane: the angles are counted
    /// beside them.
    reference: [f64; 2],
}

/// The results that a case has.
pub(super) fn of(impacts: &CaseImpacts, axes: Axes) -> Vec<EstimateOutput> {
    let case = &impacts.impact.case;
    let moves = |id: VehicleId| !case.vehicles[id.index()].fixed;
    let movers: Vec<VehicleId> = VehicleId::ALL.into_iter().filter(|id| moves(*id)).collect();
    let each = |of: fn(VehicleId, Axes) -> Output| movers.iter().map(move |&id| of(id, axes));
    let results = each(|vehicle, _| Output::Speed { vehicle })
        .chain(each(|vehicle, _| Output::DeltaV { vehicle }))
        .chain(each(|vehicle, _| Output::DeltaVLongitudinal { vehicle }))
        .chain(each(|vehicle, axes| Output::DeltaVLateral { vehicle, axes }))
        .chain(each(|vehicle, _| Output::Pdof { vehicle }))
        .chain([Output::ClosingSpeed, Output::EnergyLoss, Output::NormalWork, Output::TangentialWork]);
    let mut outputs: Vec<EstimateOutput> = results.map(EstimateOutput::Result).collect();
    outputs.extend([EstimateOutput::Restitution, EstimateOutput::ImpulseRatio, EstimateOutput::CrushEnergy]);
    let skids = movers.iter().filter(|id| impacts.skids[id.index()].is_some());
    outputs.extend(skids.map(|id| EstimateOutput::SkidSpeed(*id)));
    for vehicle in movers {
        if impacts.followed[vehicle.index()] {
            let numbers = [WayNumber::RestX, WayNumber::RestY, WayNumber::RestHeading];
            let ways = numbers.map(|number| EstimateOutput::Result(Output::Way { vehicle, number, axes }));
            outputs.extend(ways);
        }
    }
    outputs
}

impl<'a> Told<'a> {
    pub(super) fn new(model: &'a Model<CaseImpacts>, axes: Axes, reference: [f64; 2]) -> Self {
        let outputs = of(model.leads(), axes);
        Self { model, outputs, reference }
    }

    pub(super) fn outputs(&self) -> &[EstimateOutput] {
        &self.outputs
    }

    /// The place among the outputs of the speed of a vehicle that moves.
    pub(super) fn speed_place(&self, id: VehicleId) -> Option<usize> {
        let wanted = EstimateOutput::Result(Output::Speed { vehicle: id });
        self.outputs.iter().position(|output| *output == wanted)
    }

    /// (m/s) the draws of the speed of a vehicle that moves.
    pub(super) fn speed<'p>(&self, posterior: &'p Posterior, id: VehicleId) -> Option<&'p [f64]> {
        posterior.outputs().get(self.speed_place(id)?).map(Vec::as_slice)
    }

    fn value(&self, output: EstimateOutput, impacted: &Impacted) -> f64 {
        let outcome = &impacted.outcome;
        match output {
            EstimateOutput::Result(Output::Way { vehicle, number, axes }) => {
                let way = impacted.ways[vehicle.index()].as_ref();
                way.map_or(0.0, |way| match number {
                    WayNumber::RestX => way.position.x,
                    WayNumber::RestY => axes.lateral(way.position.y),
                    _ => axes.lateral(way.heading),
                })
            }
            EstimateOutput::Result(output @ Output::Pdof { vehicle }) => {
                beside(output.value(0.0, outcome), self.reference[vehicle.index()])
            }
            EstimateOutput::Result(Output::Speed { vehicle }) => impacted.speeds[vehicle.index()],
            EstimateOutput::Result(output) => output.value(0.0, outcome),
            // e = −U_n/u_n
            EstimateOutput::Restitution => -outcome.separation.normal / outcome.approach.normal,
            EstimateOutput::ImpulseRatio => outcome.impulse_ratio,
            EstimateOutput::CrushEnergy => impacted.crush_energies[0] + impacted.crush_energies[1],
            EstimateOutput::SkidSpeed(vehicle) => impacted.skid_speeds[vehicle.index()].unwrap_or_default(),
        }
    }
}

impl Prior for Told<'_> {
    fn values_count(&self) -> usize {
        self.model.values_count()
    }

    fn values(&self, standard: &[Lanes], values: &mut [Lanes]) {
        self.model.values(standard, values);
    }
}

impl Evidence for Told<'_> {
    fn terms_count(&self) -> usize {
        self.model.terms_count()
    }

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
