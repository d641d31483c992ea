//! The outline of a vehicle, and its damage in place.

use ::drawing::{BodyShape, CrushProfile, Footprint};
use analysis::{Damage, Vehicle};
use case::{Case, Dimensions, GivenVehicle, VehicleKind};
use crash3::Side;
use pim_core::{Vector2, VehicleId};

/// The body seen from above, in its own axes: x forward, y left of the CG (m).
#[derive(Clone, Copy)]
pub(super) struct Body {
    pub(super) dimensions: Dimensions,
    pub(super) outline: DrawnOutline,
    shape: BodyShape,
}

/// The source of an outline.
#[derive(Clone, Copy)]
pub(super) enum DrawnOutline {
    /// The file gives it.
    Given,
    /// The file gives the CRASH3 class, whose typical outline it is.
    OfClass(u8),
    /// The file gives neither: that of the CRASH3 class whose radius of gyration is nearest.
    Nearest(u8),
}

/// How the kind of a vehicle is drawn.
pub(super) fn shape(kind: VehicleKind) -> BodyShape {
    match kind {
        VehicleKind::Car => BodyShape::Car,
        VehicleKind::HeavyTruck | VehicleKind::Trailer => BodyShape::Box,
        VehicleKind::Motorcycle => BodyShape::Motorcycle,
    }
}

/// The name of a vehicle in a picture.
pub(super) fn name_of(id: VehicleId, given: &GivenVehicle) -> String {
    match (&given.name, given.fixed) {
        (Some(name), _) => format!("{id} · {name}"),
        (None, true) => format!("{id} · fixed object"),
        (None, false) => format!("vehicle {id}"),
    }
}

impl Body {
    /// The class whose outline it has, in the words of a legend; `None` for an outline of its own.
    pub(super) fn class_legend(&self, id: VehicleId) -> Option<String> {
        match self.outline {
            DrawnOutline::Given => None,
            DrawnOutline::OfClass(class) => Some(format!("outline {id}: CRASH3 class {class}")),
            DrawnOutline::Nearest(class) => Some(format!("outline {id}: CRASH3 class {class}, assumed")),
        }
    }

    /// The vehicle's own outline, else that of the CRASH3 class whose radius of gyration is nearest; `None`
    /// if the vehicle is not like a car of a class.
    pub(super) fn of(given: &GivenVehicle, vehicle: &Vehicle) -> Option<Self> {
        let shape = if given.fixed { BodyShape::Fixed } else { shape(given.kind.unwrap_or_default()) };
        if let Some(dimensions) = vehicle.subject.dimensions {
            let outline = dimensions.class.map_or(DrawnOutline::Given, DrawnOutline::OfClass);
            return Some(Self { dimensions, outline, shape });
        }
        let (class, known) = analysis::nearest_class(&vehicle.subject)?;
        let dimensions = Dimensions {
            length: known.length,
            width: known.width,
            cg_to_front: known.cg_to_front,
            class: Some(class),
        };
        Some(Self { dimensions, outline: DrawnOutline::Nearest(class), shape })
    }

    /// The outline for the drawing.
    pub(super) fn footprint(&self) -> Footprint {
        let Dimensions { length, width, cg_to_front, .. } = self.dimensions;
        Footprint { length, width, cg_to_front, shape: self.shape }
    }

    /// (m) how far points lie beyond the front, the rear, the left and the right of the body; negative where
    /// none does.
    pub(super) fn beyond(&self, points: impl Iterator<Item = [f64; 2]>) -> [(Side, f64); 4] {
        let Dimensions { length, width, cg_to_front: front, .. } = self.dimensions;
        let (rear, left, right) = (front - length, width / 2.0, -width / 2.0);
        let mut beyond =
            [Side::Front, Side::Rear, Side::Left, Side::Right].map(|side| (side, f64::NEG_INFINITY));
        for [x, y] in points {
            let here = [x - front, rear - x, y - left, right - y];
            for ((_, most), here) in beyond.iter_mut().zip(here) {
                *most = most.max(here);
            }
        }
        beyond
    }
}

/// The crush of vehicle `i` in its place: its damaged face is `face` (m) from its CG, or from an arbitrary
/// point if its outline is not known.
pub(super) fn profile(
    case: &Case,
    vehicle: &Vehicle,
    face: impl FnOnce(Side) -> f64,
    damage: &Damage,
    i: usize,
) -> Option<CrushProfile> {
    let crush = case.vehicles[i].crush.as_ref()?;
    let given = vehicle.subject.damage.as_ref()?;
    let (side, offset) = (given.side, given.offset.unwrap_or_default());
    let (depths, spacings) = match &damage.inferred {
        Some(inferred) => (vec![inferred.crush.depth; 2], vec![inferred.crush.width]),
        None => {
            let intervals = damage.depths.len().saturating_sub(1);
            #[expect(clippy::cast_precision_loss, reason = "station counts are small")]
            let equal = vec![damage.width / intervals.max(1) as f64; intervals];
            let given = crush.spacing.as_ref().map(|s| s.iter().map(case::Quantity::si).collect());
            (damage.depths.clone(), given.unwrap_or(equal))
        }
    };
    if depths.len() < 2 {
        return None;
    }
    let outward = match side {
        Side::Front => Vector2::new(1.0, 0.0),
        Side::Rear => Vector2::new(-1.0, 0.0),
        Side::Left => Vector2::new(0.0, 1.0),
        Side::Right => Vector2::new(0.0, -1.0),
    };
    // Stations run from left to right on front and rear, from rear to front on the sides; the offset is to
    // the left, or forward.
    let (along, start) = match side {
        Side::Front | Side::Rear => (Vector2::new(0.0, -1.0), Vector2::new(0.0, offset)),
        Side::Left | Side::Right => (Vector2::new(1.0, 0.0), Vector2::new(offset, 0.0)),
    };
    let start = start + outward * face(side) - along * (damage.width / 2.0);
    let mut face = Vec::new();
    let mut done = 0.0;
    for j in 0..depths.len() {
        face.push(start + along * done);
        done += spacings.get(j).copied().unwrap_or(0.0);
    }
    let crushed = face.iter().zip(&depths).map(|(at, depth)| (at - outward * *depth).into()).collect();
    let face = face.into_iter().map(Vector2::into).collect();
    Some(CrushProfile { face, crushed, outward: outward.into() })
}
