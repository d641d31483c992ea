//! From an investigator's record to a collision with unknown speeds.

use std::f64::consts::{FRAC_PI_2, PI};

use crash3::Stiffness;
use evidence::{
    Behind, BodyNumbers, Collision, CrushNumbers, DamagedSide, Fitted, Number, Observed, ObservedVehicle,
    OtherCrush, RecordedData, RecordedDeltaV, Speeds, VehicleNumbers,
};
use pim_core::VehicleId;
use real::Real;
use real::elementary::{atan2, exp, ln, sin_cos};
use uncertainty::{Distribution, InvalidDistribution};

use crate::crash::{Crash, PairKind};
use crate::figure::Figure;
use crate::pair::{Pair, PairVehicle, Plane, Truth};

/// (kg, m, m) mass, length and width of an average car of the fleet: if no size is known, lengths grow with
/// the cube root of the mass and widths with its sixth root.
const CAR: [f64; 3] = [1650.0, 4.7, 1.8];
/// (–) radius of gyration by length.
const YAW_RADIUS: f64 = 0.295;
/// (–) from the CG to the front, by length.
pub(crate) const TO_FRONT: f64 = 0.46;
/// (m) width of the damage to a side by something without front or rear, or by something unknown.
const SIDE_WIDTH: f64 = 1.8;
/// (–) ln of the ratio of the momentum changes by two recorders beyond which they stored two events: four
/// standard deviations of both, each with about 0.17 and the error of its mass.
const ANOTHER_EVENT: f64 = 1.0;

/// The results of a vehicle's own data.
pub(crate) struct Shape {
    pub(crate) mass: f64,
    pub(crate) yaw_radius: f64,
    /// (m) length and width of the vehicle.
    pub(crate) outline: [f64; 2],
    /// (m) contact point ahead of the CG and to its left.
    pub(crate) contact: [f64; 2],
    /// (m) width of its own damage.
    pub(crate) width: f64,
    /// (m, m²) mean and mean square depth.
    pub(crate) depths: [f64; 2],
}

impl Shape {
    pub(crate) fn of(vehicle: &PairVehicle) -> Self {
        let mass = vehicle.mass();
        let [car, length, width] = CAR;
        let scale = exp(ln(mass / car) / 3.0);
        let length = vehicle.length.unwrap_or(length * scale);
        let width = vehicle.width.unwrap_or(width * Real::sqrt(scale));
        // C̄ and C²̄ of straight lines between the stations
        let spans = || vehicle.depths.windows(2);
        let mean = spans().map(|ends| 0.5 * (ends[0] + ends[1])).sum::<f64>() / 5.0;
        let square = |a: f64, b: f64| (a * a + a * b + b * b) / 3.0;
        let mean_square = spans().map(|ends| square(ends[0], ends[1])).sum::<f64>() / 5.0;
        let depth = if mean > 0.0 { 0.5 * mean_square / mean } else { 0.0 };
        let offset = vehicle.direct_offset.unwrap_or(0.0);
        let contact = match vehicle.plane {
            Plane::Front => [TO_FRONT * length - depth, -offset],
            Plane::Rear => [depth - (1.0 - TO_FRONT) * length, -offset],
            Plane::Left => [offset, 0.5 * width - depth],
            Plane::Right => [offset, depth - 0.5 * width],
        };
        let damage = [vehicle.field_length, vehicle.direct_length].into_iter().flatten().fold(0.0, f64::max);
        Self {
            mass,
            yaw_radius: YAW_RADIUS * length,
            outline: [length, width],
            contact,
            width: damage,
            depths: [mean, mean_square],
        }
    }
}

/// (rad) from the heading, counter-clockwise, to the normal that points out of the plane.
pub(crate) fn outward(plane: Plane) -> f64 {
    match plane {
        Plane::Front => 0.0,
        Plane::Rear => PI,
        Plane::Left => FRAC_PI_2,
        Plane::Right => -FRAC_PI_2,
    }
}

/// How the vehicles met: common to the collision and the case file of a pair.
pub(crate) struct Layout {
    pub(crate) shapes: [Shape; 2],
    /// (rad) counter-clockwise from north.
    pub(crate) headings: [f64; 2],
    /// (rad) their errors: 0 if the scene may be turned with the vehicle.
    pub(crate) heading_sds: [f64; 2],
    /// (rad) direction of the normal, which points from vehicle 2 to vehicle 1.
    pub(crate) crush_plane: f64,
    /// (rad) its error.
    pub(crate) crush_plane_sd: f64,
    /// (m) width over which each vehicle was crushed.
    pub(crate) widths: [f64; 2],
    /// Where each was hit.
    pub(crate) damages: [DamagedSide; 2],
}

impl Layout {
    pub(crate) fn of(pair: &Pair, fitted: &Fitted) -> Self {
        let [one, two] = &pair.vehicles;
        let shapes = pair.vehicles.each_ref().map(Shape::of);
        // Compass angles are clockwise.
        let pdof = pair.vehicles.each_ref().map(|vehicle| -vehicle.pdof);
        let headings = match (one.heading, two.heading) {
            (Some(one), Some(two)) => [-one, -two],
            // The forces are opposite: θ₁ + p₁ = θ₂ + p₂ + π
            (one, _) => {
                let one = one.map_or(0.0, |one| -one);
                [one, one + pdof[0] - pdof[1] + PI]
            }
        };
        // The vehicle whose plane is the crush plane: a side ranks before a rear, and a rear before a front.
        let damages = pair.vehicles.each_ref().map(|vehicle| DamagedSide::from(vehicle.plane));
        let [first, second] = damages;
        let [w1, w2] = [f64::from(u8::from(first >= second)), f64::from(u8::from(second >= first))];
        let normals = [0, 1].map(|i| sin_cos(headings[i] + outward(pair.vehicles[i].plane)));
        let [(s1, c1), (s2, c2)] = normals;
        // n points from 2 to 1.
        let crush_plane = atan2(w2 * s2 - w1 * s1, w2 * c2 - w1 * c1);
        // The scene may be turned, so the vehicle whose plane it is has no error of its own.
        let (plane, heading) = (fitted.crush_plane_sd, fitted.heading_sd);
        let (heading_sds, crush_plane_sd) = if first == second {
            // The plane is turned by the mean of both errors.
            ([heading; 2], Real::sqrt(Real::max(plane * plane - 0.5 * heading * heading, 0.0)))
        } else {
            let relative = heading * std::f64::consts::SQRT_2;
            (if first > second { [0.0, relative] } else { [relative, 0.0] }, plane)
        };
        let width = |i: usize| {
            // A side is crushed over the width of the other vehicle.
            match (pair.vehicles[i].plane.is_side(), pair.vehicles[1 - i].plane.is_side()) {
                (false, _) => shapes[i].width,
                (true, false) => shapes[1 - i].width,
                (true, true) => SIDE_WIDTH,
            }
        };
        let widths = [0, 1].map(width);
        Self { shapes, headings, heading_sds, crush_plane, crush_plane_sd, widths, damages }
    }
}

/// A number with a normal error, or without one.
pub(crate) fn normal(mean: f64, sd: f64) -> Result<Number, InvalidDistribution> {
    if sd > 0.0 { Distribution::normal(mean, sd).map(Number::Unknown) } else { Ok(Number::Exact(mean)) }
}

/// A vehicle in the scene.
pub(crate) struct Placed<'a> {
    pub(crate) vehicle: &'a PairVehicle,
    pub(crate) shape: &'a Shape,
    /// (rad) heading, and its error.
    pub(crate) heading: [f64; 2],
    /// (m) width over which it was crushed.
    pub(crate) width: f64,
}

impl PairVehicle {
    /// The crush by its category or by the fleet's stiffness, from the width (m) of the damage, mean depth
    /// (m) and mean square depth (m²). Slope and no-damage speed are left at 1.
    pub(crate) fn crush(&self, fitted: &Fitted, width: f64, [mean, mean_square]: [f64; 2]) -> CrushNumbers {
        let of_category = |category| Stiffness::<f64>::from_category(self.plane, category).ok();
        let Some(stiffness) = self.category.and_then(of_category) else {
            return fitted.crush_of(self.plane.into(), width, mean, mean_square);
        };
        CrushNumbers {
            constant: width * stiffness.g(),
            linear: width * stiffness.a() * mean,
            square: 0.5 * width * stiffness.b() * mean_square,
            slope: 1.0.into(),
            no_damage_speed: 1.0.into(),
        }
    }

    /// The fitted figures behind its crush energy.
    pub(crate) fn behind(&self) -> Behind {
        match self.category {
            Some(_) => Behind::Misfit { bias: true, spread: true },
            None => Behind::Stiffness(self.plane.into()),
        }
    }
}

impl Placed<'_> {
    /// The vehicle of a collision.
    pub(crate) fn vehicle(&self, fitted: &Fitted) -> Result<VehicleNumbers, InvalidDistribution> {
        let factor = |ln_sd| Distribution::log_normal(1.0, ln_sd).map(Number::Unknown);
        let shape = self.shape;
        let mut crush = self.vehicle.crush(fitted, self.width, shape.depths);
        crush.slope = factor(fitted.slope_ln_sd)?;
        crush.no_damage_speed = factor(fitted.no_damage_speed_ln_sd)?;
        let [ahead, left] = shape.contact;
        let contact = if self.vehicle.plane.is_side() {
            [normal(ahead, fitted.contact_sd)?, left.into()]
        } else {
            [ahead.into(), normal(left, fitted.contact_sd)?]
        };
        let [heading, heading_sd] = self.heading;
        Ok(VehicleNumbers {
            body: Some(BodyNumbers {
                mass: Distribution::log_normal(shape.mass, fitted.mass_ln_sd)?.into(),
                yaw_radius: shape.yaw_radius.into(),
            }),
            heading: normal(heading, heading_sd)?,
            contact,
            yaw_rate: 0.0.into(),
            crush: Some(crush),
        })
    }
}

/// The observations of a vehicle: its PDOF if that is known, and its recorder if that is given.
pub(crate) fn observed(
    vehicle: &PairVehicle,
    is_given: bool,
    has_pdof: bool,
    fitted: &Fitted,
) -> ObservedVehicle {
    let recorded = vehicle.truth().filter(|_| is_given);
    ObservedVehicle {
        pdof: has_pdof.then(|| fitted.coded(vehicle.pdof, vehicle.plane.is_side())),
        recorder: RecordedData {
            delta_v: recorded.map(|truth| RecordedDeltaV {
                size: truth.delta_v,
                is_longitudinal: truth.is_longitudinal,
                ln_scale: fitted.recorder_ln_scale,
                least: 0.0,
                freedom: fitted.recorder_freedom,
            }),
            direction: recorded
                .and_then(|truth| truth.direction)
                .map(|from| fitted.recorded_direction(from, vehicle.plane.is_side())),
            ..RecordedData::default()
        },
        ..ObservedVehicle::default()
    }
}

impl Crash for Pair {
    const FIGURES: &'static [Figure] = &Figure::ALL;
    const IS_WITH_OBJECT: bool = false;

    fn case(&self) -> &str {
        &self.case
    }

    fn vehicle(&self, id: VehicleId) -> Option<&PairVehicle> {
        Some(&self.vehicles[id.index()])
    }

    fn kind(&self) -> PairKind {
        PairKind::of(self.vehicles.each_ref().map(|vehicle| vehicle.plane))
    }

    fn is_one_event(&self) -> Option<bool> {
        let [one, two] = self.vehicles.each_ref().map(|vehicle| {
            let Truth { delta_v, is_longitudinal, direction: _ } = vehicle.truth()?;
            let along = if is_longitudinal { sin_cos(vehicle.pdof).1.abs() } else { 1.0 };
            Some(ln(vehicle.mass() * delta_v / along))
        });
        Some((one? - two?).abs() <= ANOTHER_EVENT)
    }

    fn known(
        &self,
        crushed: Option<VehicleId>,
        fitted: &Fitted,
        given: &[VehicleId],
    ) -> Result<Collision, InvalidDistribution> {
        match crushed {
            None => self.collision(fitted, given),
            Some(known) => self.collision_by_crush_of(known, fitted, given),
        }
    }
}

impl Pair {
    /// The collision with both speeds unknown. Only the recorders of the vehicles `given` are evidence.
    ///
    /// # Errors
    /// If a figure of `fitted` or of the pair is not a valid distribution.
    pub fn collision(&self, fitted: &Fitted, given: &[VehicleId]) -> Result<Collision, InvalidDistribution> {
        let layout = Layout::of(self, fitted);
        let of = |id: VehicleId| {
            let i = id.index();
            let subject = Placed {
                vehicle: &self.vehicles[i],
                shape: &layout.shapes[i],
                heading: [layout.headings[i], layout.heading_sds[i]],
                width: layout.widths[i],
            };
            subject.vehicle(fitted)
        };
        let observed =
            |id: VehicleId| observed(&self.vehicles[id.index()], given.contains(&id), true, fitted);
        Ok(Collision {
            vehicles: [of(VehicleId::One)?, of(VehicleId::Two)?],
            speeds: Speeds::Together {
                ln_relative: Speeds::any_ln_relative()?.into(),
                split: Speeds::any_split()?.into(),
            },
            crush_plane: normal(layout.crush_plane, layout.crush_plane_sd)?,
            restitution: fitted.restitution_with(fitted.restitution_factor()?.into()),
            friction: fitted.any_friction()?.into(),
            tangential_share: fitted.any_tangential_share()?.into(),
            other_crush: None,
            observed: Observed {
                vehicles: VehicleId::ALL.map(observed),
                pdofs_differ: false,
                crush_is_bound: false,
                severity: Some(fitted.severity_of(&layout.damages)),
                crush: Some(fitted.crush_misfit(&layout.damages).into()),
                figures: fitted
                    .crush_figures(&layout.damages, self.vehicles.each_ref().map(PairVehicle::behind)),
            },
        })
    }

    /// [`Pair::collision`], if only the crush of one vehicle is `known`.
    ///
    /// # Errors
    /// As [`Pair::collision`].
    pub fn collision_by_crush_of(
        &self,
        known: VehicleId,
        fitted: &Fitted,
        given: &[VehicleId],
    ) -> Result<Collision, InvalidDistribution> {
        let mut collision = self.collision(fitted, given)?;
        let (layout, other) = (Layout::of(self, fitted), known.other());
        let damages = layout.damages;
        if self.vehicles[known.index()].plane.is_side()
            && let Some(crush) = &mut collision.vehicles[known.index()].crush
        {
            // The object that crushed it, and the width, are unknown.
            let depths = layout.shapes[known.index()].depths;
            let narrow = self.vehicles[known.index()].crush(fitted, SIDE_WIDTH, depths);
            *crush = CrushNumbers { slope: crush.slope, no_damage_speed: crush.no_damage_speed, ..narrow };
        }
        collision.vehicles[other.index()].crush = None;
        // The energy of the other vehicle follows from that of this one, with all its errors.
        collision.observed.figures =
            fitted.crush_figures(&damages, [self.vehicles[known.index()].behind(); 2]);
        let ratio = fitted.other_crush(damages[other.index()], damages[known.index()])?;
        collision.other_crush = Some(OtherCrush { vehicle: other, ratio: ratio.into() });
        Ok(collision)
    }
}
