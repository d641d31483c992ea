//! The checks and warnings of a result.

use inputs::{Basis, Case, SurfaceData};

use crate::analysis::Analysis;
use crate::aside::{self, Used};
use crate::checks;
use crate::damage;
use crate::failure::Failure;
use crate::found::Found;
use crate::impact::Impact;
use crate::travel::{self, Travel};
use crate::vehicle::Vehicle;
use crate::warning::{self, Warning};

/// CRASH3's answer, and the checks and warnings of the results so far.
pub(crate) fn judged(
    case: &Case,
    vehicles: [Vehicle; 2],
    basis: Basis,
    restitution: Option<f64>,
    (found, impact): (Option<Found>, Option<Impact>),
    mut warnings: Vec<Warning>,
) -> Result<Analysis, Failure> {
    let alone = case.vehicles.iter().any(inputs::GivenVehicle::is_absent);
    let crash3 = if alone { None } else { damage::crash3(&vehicles, basis.energy(), restitution)? };
    // If the speed was found from the crush energy, the normal work equals it by construction.
    let energy = crash3
        .as_ref()
        .filter(|_| found.is_none())
        .map(|crash3| basis.energy().dissipated(crash3.crush_energy, restitution.unwrap_or_default()));
    let checks =
        checks::checks(&vehicles, case.headings(), energy.map(|energy| (energy, basis)), impact.as_ref());
    if let Some(impact) = &impact {
        warning::of_impact(impact, &mut warnings);
    }
    warning::of_outlines(&vehicles, &mut warnings);
    let speeds = impact.as_ref().map(|impact| impact.outcome.before.map(|motion| motion.velocity.norm()));
    warning::of_case(case, &mut warnings);
    let sought = found.as_ref().map(|found| found.unknown.vehicle());
    warning::of_data(&vehicles, speeds.map_or([None; 2], |speeds| speeds.map(Some)), sought, &mut warnings);
    warning::of_assumptions(case, &vehicles, &mut warnings);
    warning::of_damage(&vehicles, &mut warnings);
    if let Some(impact) = &impact {
        warning::of_directions(impact, &vehicles, &mut warnings);
        warning::of_object(&vehicles, impact, &mut warnings);
        if let Some(crash3) = &crash3 {
            warning::of_delta_v(impact, crash3, &vehicles, &mut warnings);
        }
    }
    let marks = case.skids();
    let skids = [0, 1].map(|i| travel::skid(marks[i]?, speeds?[i]));
    warning::of_checks(&checks, &vehicles, impact.as_ref(), basis, &mut warnings);
    Ok(Analysis {
        basis,
        found,
        both: None,
        impact,
        geometry: None,
        travel: [None, None],
        skids,
        surface: None,
        vehicles,
        crash3,
        left_aside: Vec::new(),
        can_be_weighed: false,
        checks,
        warnings,
    })
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
        self.checks.extend(checks);
        self.travel = travel;
        self.surface = surface;
        self
    }
}
