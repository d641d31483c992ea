//! The energy: where the initial kinetic energy went.

use ::drawing::{EnergyBar, EnergyPicture, Loss, number};
use analysis::{Analysis, Check, CheckedQuantity};
use case::{Basis, Case};
use pim_core::VehicleId;

use super::{DrawingError, Subject, caveat, title};
use crate::Units;
use crate::units::Measure;
use crate::{basis, checks};

pub(super) fn picture(case: &Case, analysis: &Analysis, units: Units) -> Result<EnergyPicture, DrawingError> {
    let exchange = analysis.exchange().ok_or(DrawingError::NoImpact { subject: Subject::Energy })?;
    let energy = exchange.energy;
    let known = [0, 1].map(|i| analysis.vehicles[i].crush_energy());
    // A vehicle whose crush is not known has a part of the work, too.
    let is_open = case.vehicles.iter().zip(known).any(|(given, known)| !given.fixed && known.is_none());
    let crush = known.map(|known| known.filter(|_| !is_open).unwrap_or_default());
    let total = crush[0] + crush[1];
    // (%)
    let share = |joule: f64| number(100.0 * joule / energy.before, 1);
    let bar = |name: &str, joule: f64| EnergyBar {
        name: name.to_owned(),
        energy: joule,
        value: format!("{} ({} %)", units.format(Measure::Energy, joule), share(joule)),
        remark: None,
    };
    // A remark on work that is negative as printed, which excludes a rounded zero.
    let driven = |bar: EnergyBar, what: &str| EnergyBar {
        remark: share(bar.energy).starts_with('-').then(|| what.to_owned()),
        ..bar
    };
    let mut losses = Vec::new();
    // Both vehicles share the normal work as their crush energies do, which add up to it in a reconstruction
    // on the basis `dissipated`: only there it is the crush energy.
    if total > 0.0 {
        let work = if is_crush(total, energy.normal_work) { "crush of" } else { "normal work," };
        for (id, loss) in VehicleId::ALL.into_iter().zip([Loss::Vehicle1, Loss::Vehicle2]) {
            let crush = crush[id.index()];
            if crush > 0.0 {
                let name = format!("{work} vehicle {id}");
                losses.push((loss, bar(&name, energy.normal_work * crush / total)));
            }
        }
    } else {
        losses.push((Loss::Normal, bar("normal work", energy.normal_work)));
    }
    let tangential = bar("tangential work (sliding)", energy.tangential_work);
    losses.push((Loss::Tangential, driven(tangential, "drives the sliding")));
    if energy.moment_work != 0.0 {
        losses.push((Loss::Moment, driven(bar("moment work", energy.moment_work), "drives the rotation")));
    }
    Ok(EnergyPicture {
        title: title(case),
        caveat: caveat(analysis),
        initial: bar("initial kinetic energy", energy.before),
        losses,
        rest: bar("final motion", energy.after),
        note: note(analysis, crush, energy.normal_work, units),
    })
}

/// (–) energies that differ by no more than this differ by rounding.
const ROUNDING: f64 = 1e-6;

/// Whether the normal work equals the crush energy except for rounding.
fn is_crush(crush: f64, normal_work: f64) -> bool {
    (crush - normal_work).abs() <= ROUNDING * normal_work.abs()
}

/// How the crush energy compares with the work of the impact on the basis of the case.
enum Agreement {
    /// Equal except for rounding, as for speeds that were found from it.
    Equal,
    /// Within the limit of the check.
    Within,
    Apart,
}

fn agreement(analysis: &Analysis) -> Agreement {
    let of_energy = |check: &&Check| {
        matches!(
            check.quantity,
            CheckedQuantity::DamageEnergy { .. } | CheckedQuantity::MomentumEnergy { .. }
        )
    };
    match checks::told(analysis).find(of_energy) {
        _ if analysis.found.is_some() => Agreement::Equal,
        Some(check) if check.value <= ROUNDING => Agreement::Equal,
        Some(check) if check.passed() => Agreement::Within,
        _ => Agreement::Apart,
    }
}

fn note(analysis: &Analysis, crushes: [f64; 2], normal_work: f64, units: Units) -> String {
    let crush = crushes[0] + crushes[1];
    let mut note = "Each bar begins where the one above it ends.".to_owned();
    if crush > 0.0 && !is_crush(crush, normal_work) {
        let energy = |si: f64| units.format(Measure::Energy, si);
        let why = match (agreement(analysis), analysis.basis) {
            (Agreement::Equal, Basis::Absorbed) => "restitution returns the rest".to_owned(),
            (Agreement::Equal, Basis::TangentialShare(_)) => {
                let share = basis::share(analysis.basis).unwrap_or_default();
                format!("the crush also absorbs {share}")
            }
            (Agreement::Apart, _) => "the damage and the impact do not agree".to_owned(),
            _ => "the consistency check finds no contradiction between them".to_owned(),
        };
        note.push_str(&format!(
            " The crush energy is {}, the normal work {}: {why}.",
            energy(crush),
            energy(normal_work)
        ));
        if crushes.iter().all(|crush| *crush > 0.0) {
            note.push_str(" The bars share the normal work as the crush energies do.");
        }
    }
    note
}
