//! The checks and warnings of a result.

use std::mem;

use inputs::{Case, SurfaceData};
use pim_core::VehicleId;

use crate::analysis::Analysis;
use crate::aside::{self, Used};
use crate::checks;
use crate::damage;
use crate::exchange::{Exchange, by_momentum};
use crate::failure::Failure;
use crate::impact::Impact;
use crate::travel::{SolvedSkid, Travel};
use crate::warning;

/// Adds CRASH3's answer, and the checks and warnings of the results so far.
pub(crate) fn judged(
    case: &Case,
    mut analysis: Analysis,
    restitution: Option<f64>,
) -> Result<Analysis, Failure> {
    let basis = analysis.basis;
    let alone = case.vehicles.iter().any(inputs::GivenVehicle::is_absent);
    if !alone {
        analysis.crash3 = damage::crash3(&analysis.vehicles, basis.energy(), restitution)?;
    }
    let mut warnings = mem::take(&mut analysis.warnings);
    let Analysis { found, both, impact, vehicles, crash3, .. } = &analysis;
    let by_momentum = by_momentum(both.as_ref()).is_some();
    // The impact whose effect is the result: by momentum, the one by the law is only a check of the law.
    let result = impact.as_ref().filter(|_| !by_momentum);
    // If the speed was found from the crush energy, the normal work equals it by construction.
    let energy = crash3
        .as_ref()
        .filter(|_| found.is_none() && !by_momentum)
        .map(|crash3| basis.energy().dissipated(crash3.crush_energy, restitution.unwrap_or_default()));
    let exchange = Exchange::of(both.as_ref(), impact.as_ref());
    let checks = checks::checks(
        vehicles,
        case.headings(),
        energy.map(|energy| (energy, basis)),
        impact.as_ref(),
        exchange.as_ref(),
    );
    if let Some(impact) = impact {
        warning::of_impact(impact, &mut warnings);
    }
    warning::of_outlines(vehicles, &mut warnings);
    let before = |impact: &Impact| impact.outcome.before.map(|motion| motion.velocity.norm());
    let of_both = both.as_ref().map(|both| both.speeds.map(f64::abs));
    let speeds = of_both.or_else(|| impact.as_ref().map(before));
    warning::of_case(case, &mut warnings);
    let is_found = VehicleId::ALL.map(|id| {
        found.as_ref().is_some_and(|found| found.unknown == id)
            || both.as_ref().is_some_and(|both| both.vehicles().any(|vehicle| vehicle == id))
    });
    warning::of_data(vehicles, speeds.map_or([None; 2], |speeds| speeds.map(Some)), is_found, &mut warnings);
    warning::of_assumptions(case, vehicles, &mut warnings);
    warning::of_damage(vehicles, &mut warnings);
    if let Some(impact) = result {
        warning::of_directions(impact, vehicles, &mut warnings);
        if let Some(crash3) = crash3 {
            warning::of_delta_v(impact, crash3, vehicles, &mut warnings);
        }
    }
    if let Some(exchange) = &exchange {
        warning::of_object(vehicles, exchange, &mut warnings);
    }
    warning::of_checks(&checks, vehicles, impact.as_ref(), exchange.as_ref(), basis, &mut warnings);
    let marks = case.skids();
    analysis.skids = [0, 1].map(|i| SolvedSkid::to(marks[i]?, speeds?[i]));
    (analysis.checks, analysis.warnings) = (checks, warnings);
    Ok(analysis)
}

impl Analysis {
    /// Adds the evidence that the answer does not use, and its contradictions.
    pub(crate) fn beside_the_rest(mut self, case: &Case) -> Self {
        let used = Used::of(self.found.as_ref(), self.both.as_ref().map(|both| &both.method));
        self.left_aside = aside::left_aside(case, used);
        let contradictions = aside::contradictions(case, &self, used);
        self.warnings.extend(contradictions);
        self
    }

    /// Adds the paths to rest, and the checks and warnings about them.
    pub(crate) fn with_travel(mut self, travel: [Option<Travel>; 2], surface: Option<SurfaceData>) -> Self {
        let checks = checks::of_travel(&travel);
        warning::of_travel(&travel, self.both.as_ref(), &checks, &mut self.warnings);
        self.warnings.extend(warning::of_rests(&travel, &self.vehicles));
        self.checks.extend(checks);
        self.travel = travel;
        self.surface = surface;
        self
    }
}
