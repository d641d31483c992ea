//! The damage: each vehicle with its crush profile in place.

use ::drawing::{CrushProfile, DamagePicture, DamagedVehicle};
use analysis::{Analysis, Damage};
use case::Case;
use pim_core::VehicleId;

use super::vehicle::{Body, DrawnOutline, profile};
use super::{DrawingError, scale_unit, title};
use crate::Units;
use crate::units::Measure;
use crate::words;

/// Maximum number of stations whose depths the caption lists; for more it gives their range.
const LISTED: usize = 50;
/// (m) how far damage may reach beyond an outline before the caption says so: bodies have no sharp corners.
const BEYOND: f64 = 0.1;

pub(super) fn picture(case: &Case, analysis: &Analysis, units: Units) -> Result<DamagePicture, DrawingError> {
    let vehicles = VehicleId::ALL.map(|id| {
        let i = id.index();
        let vehicle = &analysis.vehicles[i];
        let damage = vehicle.damage.as_ref()?;
        let body = Body::of(&case.vehicles[i], vehicle);
        let from_cg = |side| body.as_ref().map_or(0.0, |body| body.dimensions.face(side));
        let profile = profile(case, vehicle, from_cg, damage, i)?;
        let name = case.vehicles[i].name.as_ref().map(|name| format!(" · {name}")).unwrap_or_default();
        Some(DamagedVehicle {
            name: format!("Vehicle {id}{name}"),
            caption: caption(&case.vehicles[i], body.as_ref(), &profile, damage, units),
            footprint: body.map(|body| body.footprint()),
            crush: profile,
            has_stations: damage.inferred.is_none(),
        })
    });
    if vehicles.iter().all(Option::is_none) {
        return Err(DrawingError::NoDamage);
    }
    Ok(DamagePicture { title: title(case), vehicles, length: scale_unit(units, Measure::Length) })
}

fn caption(
    vehicle: &case::GivenVehicle,
    body: Option<&Body>,
    profile: &CrushProfile,
    damage: &Damage,
    units: Units,
) -> Vec<String> {
    let side = vehicle.crush.as_ref().map_or("", |crush| words::side_name(crush.side));
    let width = units.format(Measure::Crush, damage.width);
    // Keeps the unit on the line of the last number.
    let unit = &format!(" {}", units.name(Measure::Crush));
    let crush = match &damage.inferred {
        Some(inferred) => format!(
            "{side}, {width} wide; inferred from the force: {} deep",
            units.format(Measure::Crush, inferred.crush.depth)
        ),
        None if damage.depths.len() > LISTED => format!(
            "{side}, {width} wide; C1 to C{}: {} to {} deep",
            damage.depths.len(),
            units.format(Measure::Crush, damage.depths.iter().copied().fold(f64::INFINITY, f64::min)),
            units.format(Measure::Crush, damage.depths.iter().copied().fold(0.0, f64::max)),
        ),
        None => format!(
            "{side}, {width} wide; C1 to C{}: {}",
            damage.depths.len(),
            units
                .format_all(Measure::Crush, &damage.depths)
                .replace(unit, &format!("\u{a0}{}", unit.trim_start()))
        ),
    };
    let energy = units.format(Measure::Energy, damage.crush_energy);
    let mut sentences = vec![format!("Damage: {crush}."), format!("Crush energy {energy}.")];
    let Some(body) = body else {
        let alone = "The outline is not known, so the profile is drawn alone: give length, width and \
        cg_to_front to put it in its place.";
        sentences.push(alone.to_owned());
        return sentences;
    };
    if let Some(crush) = vehicle.crush.as_ref().filter(|crush| crush.offset.is_none()) {
        let middle = words::undisplaced(crush.side);
        sentences.push(format!("No offset is given: drawn {middle}."));
    }
    let outline = match body.outline {
        DrawnOutline::Given => None,
        DrawnOutline::OfClass(class) => Some(format!("Outline: typical of CRASH3's size class {class}.")),
        DrawnOutline::Nearest(class) => {
            Some(format!("Outline: CRASH3's size class {class}, assumed, nearest by radius of gyration."))
        }
    };
    let beyond: Vec<String> = body
        .beyond(profile.face.iter().chain(&profile.crushed).copied())
        .into_iter()
        .filter(|(_, by)| *by > BEYOND)
        .map(|(side, by)| format!("{} past its {}", units.format(Measure::Crush, by), words::side_name(side)))
        .collect();
    let beyond = (!beyond.is_empty())
        .then(|| format!("The damage reaches beyond the outline as drawn: {}.", beyond.join(", ")));
    sentences.extend([outline, beyond].into_iter().flatten());
    sentences
}
