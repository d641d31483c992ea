//! The force of one tyre on the ground.

use real::Real;

/// (1/rad) cornering stiffness of a tyre by its load: 9 F_z per radian (EDSMAC4's tables have 8 to 11).
pub const CORNERING_STIFFNESS: f64 = 9.0;

/// Where a wheel slips slower than this share of the vehicle's speed, its friction fades to nothing, so that
/// it has a direction at every moment.
///
/// A vehicle that spins about one of its wheels would otherwise turn the force there by half a revolution at
/// once. A share, and not a speed, leaves the forces independent of the size of the motion.
pub(crate) const FADING: f64 = 0.01;

/// A tyre's force by its load, in the wheel's own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grip<T> {
    /// (–) along the wheel.
    pub(crate) forward: T,
    /// (–) to its left.
    pub(crate) left: T,
    /// Whether all of the tread slides: it leaves a mark.
    pub(crate) sliding: bool,
}

/// The force of a tyre whose wheel moves with (`u`, `v`) (m/s) forward and left, by its load.
///
/// A brake holds a wheel no faster than the ground drags it: a wheel is locked where its drag is more than
/// friction against the slip would give along it. Slipping sideways, every wheel is then as good as locked,
/// and the force is continuous where u changes its sign. EDSMAC4's −sgn(u) d F_z jumps there.
#[inline(always)]
pub(crate) fn grip<T: Real>(u: T, v: T, friction: T, drag: T, fading_speed: T) -> Grip<T> {
    let slip_squared = u * u + v * v;
    let fades = slip_squared.value() < (fading_speed * fading_speed).value();
    if fades && slip_squared.value() == 0.0 {
        return Grip { forward: T::ZERO, left: T::ZERO, sliding: false };
    }
    let slip = slip_squared.sqrt();
    // μ′ = 2ρ/(1 + ρ²) μ for ρ = S/(εV) < 1, which goes over into μ without a bend
    let friction = if fades {
        friction * (slip * fading_speed * 2.0) / (slip_squared + fading_speed * fading_speed)
    } else {
        friction
    };
    let ahead = u.abs();
    if (drag * slip).value() >= (friction * ahead).value() {
        // F = −μ F_z S/|S|
        let by_slip = -(friction / slip);
        return Grip { forward: by_slip * u, left: by_slip * v, sliding: true };
    }
    let forward = if u.value() < 0.0 { drag } else { -drag };
    // F_y,max² = (μ F_z)² − (d F_z)²
    let most = (friction * friction - drag * drag).sqrt();
    // q = C_α tan α/(3 F_y,max), at most ±1
    let (reach, lateral) = (most * ahead * (3.0 / CORNERING_STIFFNESS), v.abs());
    let sliding = lateral.value() >= reach.value();
    let left = if sliding {
        if v.value() < 0.0 { most } else { -most }
    } else {
        let q = v / reach;
        // F_y = −F_y,max (3q − 3q|q| + q³)
        -(most * q * (q * q - q.abs() * 3.0 + 3.0))
    };
    Grip { forward, left, sliding }
}

/// How the force by load (1/(m/s)) changes with the motion of the wheel: [[∂F_x/∂u, ∂F_x/∂v], [∂F_y/∂u,
/// ∂F_y/∂v]].
///
/// It steers the implicit method, which needs it only roughly: where friction fades it is taken as if the
/// force pointed to the slip.
#[inline(always)]
pub(crate) fn slope(u: f64, v: f64, friction: f64, drag: f64, fading_speed: f64) -> [[f64; 2]; 2] {
    let slip_squared = u * u + v * v;
    let fading_squared = fading_speed * fading_speed;
    if slip_squared < fading_squared {
        // ∂F/∂S = −2μεV/(S² + ε²V²) along every direction
        let slope = -2.0 * friction * fading_speed / (slip_squared + fading_squared);
        return [[slope, 0.0], [0.0, slope]];
    }
    let ahead = u.abs();
    // d² S² ≥ μ² u²
    if drag * drag * slip_squared >= friction * friction * u * u {
        // ∂F/∂S = −μ/|S| (1 − s sᵀ), s the direction of the slip
        let slope = -friction / (slip_squared * Real::sqrt(slip_squared));
        return [[slope * v * v, -slope * u * v], [-slope * u * v, slope * u * u]];
    }
    let most = Real::sqrt(friction * friction - drag * drag);
    let reach = most * ahead * (3.0 / CORNERING_STIFFNESS);
    if v.abs() >= reach {
        return [[0.0; 2]; 2];
    }
    let left = 1.0 - v.abs() / reach;
    // ∂F_y/∂v = −C_α (1 − |q|)²/|u|, ∂F_y/∂u = −(v/u) ∂F_y/∂v
    let by_v = -CORNERING_STIFFNESS * left * left / ahead;
    [[0.0, 0.0], [-by_v * v / u, by_v]]
}
