//! What a careful reconstructionist would raise.

use case::YawSource;
use crash3::principal_angle;
use pim_core::{Contact, Outcome};

use crate::checks::{Check, CheckedQuantity};
use crate::damage::Crash3;
use crate::{Found, Impact, Vehicle};

/// Newton's third law: the peak forces of the two vehicles should be the same. Stiffness and crush are uncertain, but not by
/// more than this factor.
pub(crate) const FORCE_RATIO: f64 = 2.0;
/// (rad) how far a PDOF judged by eye may be from the computed one: 10°.
pub(crate) const PDOF_DIFFERENCE: f64 = 10.0 * std::f64::consts::PI / 180.0;
/// Restitution falls with closing speed: above [`FAST_CLOSING`], more than this is not seen in vehicle collisions.
pub(crate) const HIGH_RESTITUTION: f64 = 0.3;
/// (m/s)
pub(crate) const FAST_CLOSING: f64 = 15.0;
/// How far CRASH3's ΔV may be from that of the impact.
const DELTA_V_DIFFERENCE: f64 = 0.1;
/// (m) how far the contact point may be outside of the outline: the roundness of a bumper.
const OUTLINE_TOLERANCE: f64 = 0.05;

/// Something that does not stop the analysis but should be known to who defends it. Values are in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// The crush plane does not separate the two CGs.
    PlaneDoesNotSeparate,
    /// The contact point lies outside of the vehicle's outline.
    ContactOutside {
        /// 1 or 2.
        vehicle: usize,
        /// (m) by how much.
        distance: f64,
    },
    /// More restitution than a collision of this speed has.
    HighRestitution {
        /// e.
        restitution: f64,
        /// (m/s) closing speed at C.
        closing_speed: f64,
    },
    /// The peak forces of the two vehicles differ by more than a factor of 2.
    ForceBalance {
        /// (N) peak forces.
        forces: [f64; 2],
    },
    /// The PDOF that the file gives is not that of the impulse.
    PdofDiffers {
        /// 1 or 2.
        vehicle: usize,
        /// (rad) as given.
        given: f64,
        /// (rad) as computed.
        computed: f64,
    },
    /// α was limited to 45°.
    AngleCapped {
        /// 1 or 2.
        vehicle: usize,
        /// (rad) α.
        oblique_angle: f64,
    },
    /// The force does not push on the side that is said to be damaged.
    SideNotPushed {
        /// 1 or 2.
        vehicle: usize,
        /// (rad) α.
        oblique_angle: f64,
    },
    /// CRASH3's ΔV is not that of the impact.
    DeltaVDiffers {
        /// (m/s) ΔV of the impact.
        impact: [f64; 2],
        /// (m/s) CRASH3's, corrected for oblique forces where possible.
        crash3: [f64; 2],
    },
    /// More than one speed gives the crush energy.
    SeveralSpeeds {
        /// (m/s) all of them; the answer is the first.
        speeds: Vec<f64>,
    },
    /// The speed found is negative.
    MovesBackward {
        /// 1 or 2.
        vehicle: usize,
        /// (m/s) the speed found.
        speed: f64,
    },
    /// CRASH3's size class stands in for what is not known of the vehicle.
    ClassValues {
        /// 1 or 2.
        vehicle: usize,
        /// 1 to 6.
        class: u8,
        /// (kg·m²) the yaw inertia, where that was taken from the class.
        yaw_inertia: Option<f64>,
        /// (m) length, width and distance from the CG to the front, where those were taken from the class.
        outline: Option<[f64; 3]>,
    },
    /// The yaw inertia was estimated from wheelbase and length.
    BurgInertia {
        /// 1 or 2.
        vehicle: usize,
        /// (kg·m²) the estimate.
        yaw_inertia: f64,
    },
    /// The crush of the vehicle was not measured.
    InferredEnergy {
        /// 1 or 2.
        vehicle: usize,
        /// (N) the peak force on the other vehicle.
        force: f64,
        /// (m) width of the uniform crush; (m) its depth.
        crush: [f64; 2],
        /// (J) its energy.
        energy: f64,
        /// (J) the least and the greatest that are possible, where the width is not known.
        bounds: Option<[f64; 2]>,
    },
    /// The force was taken to act through the centroid of the damage.
    DamageCentroid {
        /// 1 or 2.
        vehicle: usize,
        /// (m) the centroid, forward and left of the CG or, in z-down axes, right.
        point: [f64; 2],
        /// Whether the file says where on the face the damage lies.
        offset_given: bool,
    },
    /// The two directions of force that the file gives are not opposite in the scene.
    PdofsNotOpposite {
        /// (rad) by how much.
        angle: f64,
    },
    /// The work of the normal impulse is not the crush energy.
    DamageEnergyDiffers {
        /// (J) W_n.
        normal_work: f64,
        /// (J) the crush energy on its basis.
        crush_energy: f64,
    },
    /// The line of action passes the CG on the side from which it would turn the vehicle the other way than the impact did.
    RotationOpposes {
        /// 1 or 2.
        vehicle: usize,
        /// (rad) the PDOF that the line of action has.
        pdof: f64,
        /// (rad/s) change of the yaw rate.
        turned: f64,
    },
    /// The file gives a speed for the vehicle whose speed was to be found.
    GivenSpeedUnused {
        /// 1 or 2.
        vehicle: usize,
        /// (m/s) as given.
        given: f64,
        /// (m/s) as found.
        found: f64,
    },
}

impl Warning {
    /// Every code that there is.
    pub const CODES: [&'static str; 18] = [
        "crush-plane",
        "contact-outside",
        "high-restitution",
        "force-balance",
        "pdof-differs",
        "angle-capped",
        "side-not-pushed",
        "delta-v-differs",
        "several-speeds",
        "moves-backward",
        "class-values",
        "burg-inertia",
        "inferred-energy",
        "damage-centroid",
        "pdofs-not-opposite",
        "damage-energy-differs",
        "rotation-opposes",
        "given-speed-unused",
    ];

    /// The code that names this warning in JSON and text.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::PlaneDoesNotSeparate => "crush-plane",
            Self::ContactOutside { .. } => "contact-outside",
            Self::HighRestitution { .. } => "high-restitution",
            Self::ForceBalance { .. } => "force-balance",
            Self::PdofDiffers { .. } => "pdof-differs",
            Self::AngleCapped { .. } => "angle-capped",
            Self::SideNotPushed { .. } => "side-not-pushed",
            Self::DeltaVDiffers { .. } => "delta-v-differs",
            Self::SeveralSpeeds { .. } => "several-speeds",
            Self::MovesBackward { .. } => "moves-backward",
            Self::ClassValues { .. } => "class-values",
            Self::BurgInertia { .. } => "burg-inertia",
            Self::InferredEnergy { .. } => "inferred-energy",
            Self::DamageCentroid { .. } => "damage-centroid",
            Self::PdofsNotOpposite { .. } => "pdofs-not-opposite",
            Self::DamageEnergyDiffers { .. } => "damage-energy-differs",
            Self::RotationOpposes { .. } => "rotation-opposes",
            Self::GivenSpeedUnused { .. } => "given-speed-unused",
        }
    }
}

pub(crate) fn of_found(found: &Found, given_speed: Option<f64>) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let vehicle = found.unknown.index() + 1;
    if let Some(given) = given_speed {
        warnings.push(Warning::GivenSpeedUnused { vehicle, given, found: found.speed });
    }
    if found.admissible.len() > 1 {
        warnings.push(Warning::SeveralSpeeds { speeds: found.admissible.clone() });
    }
    if found.speed < 0.0 {
        warnings.push(Warning::MovesBackward { vehicle, speed: found.speed });
    }
    warnings
}

pub(crate) fn of_impact(impact: &Impact, warnings: &mut Vec<Warning>) {
    of_plane(&impact.contact, warnings);
    of_restitution(impact.law.restitution(), -impact.outcome.approach.normal, warnings);
}

pub(crate) fn of_plane(contact: &Contact, warnings: &mut Vec<Warning>) {
    if !contact.separates_centres() {
        warnings.push(Warning::PlaneDoesNotSeparate);
    }
}

/// Of a restitution at a closing speed (m/s).
pub(crate) fn of_restitution(restitution: f64, closing_speed: f64, warnings: &mut Vec<Warning>) {
    if restitution > HIGH_RESTITUTION && closing_speed > FAST_CLOSING {
        warnings.push(Warning::HighRestitution { restitution, closing_speed });
    }
}

pub(crate) fn of_outlines(vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (i, vehicle) in vehicles.iter().enumerate() {
        let (Some([forward, left]), Some(outline)) = (vehicle.subject.contact, vehicle.subject.dimensions)
        else {
            continue;
        };
        let front = outline.cg_to_front;
        let ahead = (forward - front).max(front - outline.length - forward);
        let aside = left.abs() - outline.width / 2.0;
        let distance = ahead.max(aside);
        if distance > OUTLINE_TOLERANCE {
            warnings.push(Warning::ContactOutside { vehicle: i + 1, distance });
        }
    }
}

/// What stands in for what is not known.
pub(crate) fn of_assumptions(vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (i, vehicle) in vehicles.iter().enumerate() {
        let (number, subject) = (i + 1, &vehicle.subject);
        let from_class = subject.dimensions.and_then(|dimensions| {
            let outline = [dimensions.length, dimensions.width, dimensions.cg_to_front];
            dimensions.class.map(|class| (class, outline))
        });
        let (mut class, mut yaw_inertia) = (from_class.map(|(class, _)| class), None);
        if let Some(inertia) = subject.inertia {
            match inertia.yaw_source {
                YawSource::Given => {}
                YawSource::Class(of_yaw) => {
                    class = Some(of_yaw);
                    yaw_inertia = Some(inertia.yaw_inertia);
                }
                YawSource::Burg => {
                    warnings.push(Warning::BurgInertia { vehicle: number, yaw_inertia: inertia.yaw_inertia });
                }
            }
        }
        if let Some(class) = class {
            let outline = from_class.map(|(_, outline)| outline);
            warnings.push(Warning::ClassValues { vehicle: number, class, yaw_inertia, outline });
        }
        let Some(damage) = &vehicle.damage else { continue };
        if let Some(inferred) = damage.inferred {
            warnings.push(Warning::InferredEnergy {
                vehicle: number,
                force: inferred.force,
                crush: [inferred.crush.width, inferred.crush.depth],
                energy: inferred.crush.energy,
                bounds: inferred.range.map(|range| [range.lowest.energy, range.highest.energy]),
            });
        }
        if let Some(point) = damage.centroid {
            let offset_given = subject.damage.as_ref().is_some_and(|given| given.offset.is_some());
            warnings.push(Warning::DamageCentroid { vehicle: number, point, offset_given });
        }
    }
}

pub(crate) fn of_damage(vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    let mut peak_forces = [None; 2];
    for (i, vehicle) in vehicles.iter().enumerate() {
        let Some(damage) = &vehicle.damage else { continue };
        let oblique_angle = damage.oblique_angle;
        match damage.oblique {
            Some(oblique) => {
                peak_forces[i] = Some(oblique.peak_force);
                if oblique.factor.capped {
                    warnings.push(Warning::AngleCapped { vehicle: i + 1, oblique_angle });
                }
            }
            None => warnings.push(Warning::SideNotPushed { vehicle: i + 1, oblique_angle }),
        }
    }
    if let [Some(f1), Some(f2)] = peak_forces
        && f1.max(f2) > FORCE_RATIO * f1.min(f2)
    {
        warnings.push(Warning::ForceBalance { forces: [f1, f2] });
    }
}

pub(crate) fn of_directions(impact: &Impact, vehicles: &[Vehicle; 2], warnings: &mut Vec<Warning>) {
    for (i, (vehicle, computed)) in vehicles.iter().zip(impact.pdof).enumerate() {
        let Some(given) = vehicle.subject.damage.as_ref().and_then(|damage| damage.pdof) else { continue };
        // The difference of two directions, the short way round.
        if principal_angle(given - computed).abs() > PDOF_DIFFERENCE {
            warnings.push(Warning::PdofDiffers { vehicle: i + 1, given, computed });
        }
    }
}

/// What the checks are not content with and no other warning says.
pub(crate) fn of_checks(
    checks: &[Check],
    vehicles: &[Vehicle; 2],
    impact: Option<&Impact>,
    warnings: &mut Vec<Warning>,
) {
    for check in checks.iter().filter(|check| !check.passed()) {
        match (check.quantity, impact) {
            (CheckedQuantity::PdofsOpposite, _) => {
                warnings.push(Warning::PdofsNotOpposite { angle: check.value });
            }
            (CheckedQuantity::DamageEnergy { normal_work, crush_energy }, _) => {
                warnings.push(Warning::DamageEnergyDiffers { normal_work, crush_energy });
            }
            (CheckedQuantity::Rotation { vehicle }, Some(impact)) => {
                let [before, after] = [&impact.outcome.before, &impact.outcome.after];
                if let Some(pdof) = vehicles[vehicle - 1].damage.as_ref().and_then(|damage| damage.pdof) {
                    let turned = after[vehicle - 1].yaw_rate - before[vehicle - 1].yaw_rate;
                    warnings.push(Warning::RotationOpposes { vehicle, pdof, turned });
                }
            }
            _ => {}
        }
    }
}

pub(crate) fn of_delta_v(impact: &Impact, crash3: &Crash3, warnings: &mut Vec<Warning>) {
    let of_impact = Outcome::delta_v_magnitude(&impact.outcome);
    let of_crash3 = crash3.corrected.map_or(crash3.delta_v, |corrected| corrected.delta_v);
    let differs = |(a, b): (f64, f64)| (a - b).abs() > DELTA_V_DIFFERENCE * a;
    if of_impact.into_iter().zip(of_crash3).any(differs) {
        warnings.push(Warning::DeltaVDiffers { impact: of_impact, crash3: of_crash3 });
    }
}

#[cfg(test)]
mod tests {
    use super::Warning;

    #[test]
    fn every_code_is_listed() {
        // The arms of `code`, as they stand in this file.
        let source = include_str!("warning.rs");
        let arms: Vec<&str> = source
            .lines()
            .filter_map(|line| {
                line.trim().strip_prefix("Self::")?.split_once(" => \"")?.1.strip_suffix("\",")
            })
            .collect();
        assert_eq!(arms, Warning::CODES);
    }
}
