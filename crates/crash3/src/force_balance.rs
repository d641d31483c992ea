//! The crush of a vehicle that could not be inspected, from the force on the one that could.

use alloc::vec;

use real::Real;

use crate::energy::pushing_cosine;
use crate::error::{self, CrushError};
use crate::stiffness::{Saturation, Stiffness};

/// A crush of the same depth over its whole width.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UniformCrush<T = f64> {
    /// (m) w.
    pub width: T,
    /// (m) C; zero if the force leaves no residual crush.
    pub depth: T,
    /// (J) its energy.
    pub energy: T,
}

/// The possible crush for a force if the width of the damage is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CrushRange<T = f64> {
    /// The crush of least energy: as a rule the widest.
    pub lowest: UniformCrush<T>,
    /// The crush of the nominal width, or of the nearest possible one.
    pub nominal: UniformCrush<T>,
    /// The crush of greatest energy: as a rule the narrowest, as deep as the CG.
    pub highest: UniformCrush<T>,
}

/// The uniform crush of the given `width` w (m) that bears the peak force F (N) at the angle α (rad) to the
/// normal of the damaged side: C = (F cos α/w − A)/B, with the energy w (A C + B C²/2 + G). By Newton's third
/// law F is the [`peak_force`](crate::peak_force) of the other vehicle.
///
/// A force of less than A w leaves no residual crush. The depth is then zero, and the energy is what the
/// structure stores elastically: w G (F cos α/(A w))², which is all of w G at A w.
///
/// # Errors
/// If |α| ≥ π/2, the force is negative, the width is not positive, B is zero, or the force per width
/// exceeds its limit.
pub fn crush_from_force<T: Real>(
    force: T,
    oblique_angle: T,
    width: T,
    stiffness: &Stiffness<T>,
) -> Result<UniformCrush<T>, CrushError> {
    error::positive("damage width", width.value())?;
    of_normal_force(normal_force(force, oblique_angle, stiffness)?, width, stiffness)
}

/// The same for an unknown width: with the `nominal_width` (m) of the other vehicle's damage, and the bounds
/// of what is possible. The energy is highest for the narrowest damage, where the crush reaches `deepest`
/// (m), the distance of the face from the CG. It is lowest for the widest: the width `widest` (m) of the
/// side, or the width that leaves no residual crush. (If G is far above A²/2B, the bounds lie at other
/// widths, which are found.)
///
/// # Errors
/// Those of [`crush_from_force`], or if the side cannot bear the force however deep it is crushed.
pub fn crush_range_from_force<T: Real>(
    force: T,
    oblique_angle: T,
    stiffness: &Stiffness<T>,
    nominal_width: T,
    widest: T,
    deepest: T,
) -> Result<CrushRange<T>, CrushError> {
    error::positive("nominal damage width", nominal_width.value())?;
    error::positive("length of the damaged side", widest.value())?;
    error::positive("distance of the damaged face from the centre of gravity", deepest.value())?;
    let normal = normal_force(force, oblique_angle, stiffness)?;
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());

    // w_min = F_n/f(c_max)
    let greatest = stiffness.force_per_width(deepest);
    let narrow = normal / greatest;
    if narrow.value() > widest.value() {
        return Err(CrushError::ForceTooGreat { force: normal.value(), most: (greatest * widest).value() });
    }
    // w_max = min(L, F_n/A)
    let wide = if (a * widest).value() > normal.value() { normal / a } else { widest };
    let clamped = |width: T| {
        if width.value() < narrow.value() {
            narrow
        } else if width.value() > wide.value() {
            wide
        } else {
            width
        }
    };
    // At the limit of the force per width every depth up to the deepest bears the same force.
    let energy = narrow * (energy_per_width(stiffness, deepest) + g);
    let deep = UniformCrush { width: narrow, depth: deepest, energy };
    let mut possible =
        vec![of_normal_force(normal, narrow, stiffness)?, of_normal_force(normal, wide, stiffness)?];
    // A table's G may exceed A²/2B. E(w) = F_n²/2Bw + w (G − A²/2B) then has its minimum at w = F_n/√(2BG −
    // A²).
    let turning = normal / (g * b * 2.0 - a * a).sqrt();
    if narrow.value() < turning.value() && turning.value() < wide.value() {
        possible.push(of_normal_force(normal, turning, stiffness)?);
    }
    let (mut lowest, mut highest) = (deep, deep);
    for crush in possible {
        if crush.energy.value() < lowest.energy.value() {
            lowest = crush;
        }
        if crush.energy.value() > highest.energy.value() {
            highest = crush;
        }
    }
    Ok(CrushRange { lowest, nominal: of_normal_force(normal, clamped(nominal_width), stiffness)?, highest })
}

fn normal_force<T: Real>(force: T, oblique_angle: T, stiffness: &Stiffness<T>) -> Result<T, CrushError> {
    error::positive("force of the other vehicle", force.value())?;
    if stiffness.b().value() == 0.0 {
        return Err(CrushError::NoCrushFromForce);
    }
    // F_n = F cos α
    Ok(force * pushing_cosine(oblique_angle)?)
}

fn of_normal_force<T: Real>(
    normal: T,
    width: T,
    stiffness: &Stiffness<T>,
) -> Result<UniformCrush<T>, CrushError> {
    let (a, b, g) = (stiffness.a(), stiffness.b(), stiffness.g());
    let force_per_width = normal / width;
    if let Some(limit) = stiffness.saturation_force()
        // A width computed from the limit itself may be off by a rounding error.
        && force_per_width.value() > limit.value() * (1.0 + f64::EPSILON * 4.0)
    {
        return Err(CrushError::ForceAboveLimit {
            force_per_width: force_per_width.value(),
            limit: limit.value(),
        });
    }
    if force_per_width.value() < a.value() {
        let share = force_per_width / a;
        // E = w G (F_n/(A w))²
        return Ok(UniformCrush { width, depth: T::ZERO, energy: width * g * share * share });
    }
    // C = (F_n/w − A)/B
    let depth = (force_per_width - a) / b;
    // E = w (A C + B C²/2 + G)
    Ok(UniformCrush { width, depth, energy: width * (energy_per_width(stiffness, depth) + g) })
}

/// (N) ∫ min(A + B c, F_s) dc up to the depth C (m).
fn energy_per_width<T: Real>(stiffness: &Stiffness<T>, depth: T) -> T {
    let (a, b) = (stiffness.a(), stiffness.b());
    match stiffness.saturation() {
        Some(Saturation { force, depth: knee }) if depth.value() > knee.value() => {
            // (A + F_s) C_s/2 + F_s (C − C_s)
            (a + force) * knee / 2.0 + force * (depth - knee)
        }
        // A C + B C²/2
        _ => a * depth + b * depth * depth / 2.0,
    }
}
