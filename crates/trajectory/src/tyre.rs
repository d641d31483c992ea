//! The force of one tyre on the ground.

use crate::number::{Choice, Number, choose, rarely};

/// (1/rad) cornering stiffness of a tyre by its load: 9 F_z per radian (EDSMAC4's tables have 8 to 11).
pub const CORNERING_STIFFNESS: f64 = 9.0;

/// Where a wheel slips slower than this share of the vehicle's speed, its friction fades to nothing, so that
/// it has a direction at every moment.
///
/// A vehicle that spins about one of its wheels would otherwise turn the force there by half a revolution at
/// once. A share, and not a speed, leaves the forces independent of the size of the motion.
pub(crate) const FADING: f64 = 0.01;

/// What a tyre can do on its ground, by its load.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tyre<T> {
    /// (–) μ.
    pub(crate) friction: T,
    /// (–) d.
    pub(crate) drag: T,
    /// (–) F_y,max, zero where the wheel is locked.
    pub(crate) most: T,
}

impl<T: Number> Tyre<T> {
    #[inline(always)]
    pub(crate) fn new(friction: T, drag: T) -> Self {
        // F_y,max² = (μ F_z)² − (d F_z)²
        let square = friction * friction - drag * drag;
        let zero = square.constant(0.0);
        let most = choose!(T, zero.below(square), square.sqrt(), zero);
        Self { friction, drag, most }
    }
}

/// A tyre's force by its load, in the wheel's own axes.
#[derive(Clone, Copy)]
pub(crate) struct Grip<T: Number> {
    /// (–) along the wheel.
    pub(crate) forward: T,
    /// (–) to its left.
    pub(crate) left: T,
    /// (1/(m/s)) how fast the force changes with the motion of the wheel.
    pub(crate) stiffness: T::Plain,
    /// Whether all of the tread slides: it leaves a mark.
    pub(crate) sliding: T::Mask,
}

impl<T: Number> Choice<T> for Grip<T> {
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self {
            forward: <T as Number>::select(mask, yes.forward, no.forward),
            left: <T as Number>::select(mask, yes.left, no.left),
            stiffness: <T::Plain as Number>::select(mask, yes.stiffness, no.stiffness),
            sliding: T::select_mask(mask, yes.sliding, no.sliding),
        }
    }
}

/// The force of a tyre whose wheel moves with (`u`, `v`) (m/s) forward and left, by its load, where friction
/// fades below a slip whose square is `fading_squared` ((m/s)²).
///
/// A brake holds a wheel no faster than the ground drags it: a wheel is locked where its drag is more than
/// friction against the slip would give along it. Slipping sideways, every wheel is then as good as locked,
/// and the force is continuous where u changes its sign. EDSMAC4's −sgn(u) d F_z jumps there.
#[inline(always)]
pub(crate) fn grip<T: Number>(u: T, v: T, tyre: &Tyre<T>, fading_squared: T) -> Grip<T> {
    let slip_squared = u * u + v * v;
    rarely!(
        T,
        slip_squared.below(fading_squared),
        {
            let by_slip = faded(tyre, slip_squared, fading_squared);
            let faded = Tyre::new(by_slip * root(slip_squared), tyre.drag);
            // d ≥ (μ′/S) |u|
            let locked = tyre.drag.at_least(by_slip * u.abs());
            choose!(T, locked, dragged(u, v, by_slip, locked), rolling(u, v, &faded))
        },
        {
            let locked = is_locked(u, tyre, slip_squared);
            choose!(
                T,
                locked,
                dragged(u, v, tyre.friction / slip_squared.sqrt(), locked),
                rolling(u, v, tyre),
            )
        },
    )
}

/// (1/(m/s)) friction by slip where it fades.
#[inline(always)]
fn faded<T: Number>(tyre: &Tyre<T>, slip_squared: T, fading_squared: T) -> T {
    // μ′/S = 2μ εV/(S² + ε²V²), so that μ′ goes over into μ without a bend at S = εV
    tyre.friction * (fading_squared.sqrt() * 2.0) / (slip_squared + fading_squared)
}

/// √x, with zero derivatives at zero.
#[inline(always)]
fn root<T: Number>(x: T) -> T {
    let zero = x.constant(0.0);
    choose!(T, zero.below(x), x.sqrt(), zero)
}

#[inline(always)]
fn is_locked<T: Number>(u: T, tyre: &Tyre<T>, slip_squared: T) -> T::Mask {
    // d² S² ≥ μ² u²
    (tyre.drag * tyre.drag * slip_squared).at_least(tyre.friction * tyre.friction * (u * u))
}

/// The force of a locked wheel: `by_slip` (1/(m/s)) times the slip.
#[inline(always)]
fn dragged<T: Number>(u: T, v: T, by_slip: T, sliding: T::Mask) -> Grip<T> {
    // F = −μ F_z S/|S|
    Grip { forward: -(by_slip * u), left: -(by_slip * v), stiffness: by_slip.plain(), sliding }
}

/// The force of a wheel that turns.
#[inline(always)]
fn rolling<T: Number>(u: T, v: T, tyre: &Tyre<T>) -> Grip<T> {
    let zero = u.constant(0.0);
    let (ahead, lateral) = (u.abs(), v.abs());
    let forward = <T as Number>::select(u.below(zero), tyre.drag, -tyre.drag);
    // q = C_α tan α/(3 F_y,max), at most ±1
    let reach = tyre.most * ahead * (3.0 / CORNERING_STIFFNESS);
    let sliding = lateral.at_least(reach);
    choose!(
        T,
        sliding,
        {
            let left = <T as Number>::select(v.below(zero), tyre.most, -tyre.most);
            Grip { forward, left, stiffness: zero.plain(), sliding }
        },
        {
            let q = v / reach;
            // F_y = −F_y,max (3q − 3q|q| + q³)
            let left = -(tyre.most * q * (q * q - q.abs() * 3.0 + 3.0));
            // −∂F_y/∂v = C_α (1 − |q|)²/|u|
            let share = (T::plain(zero) + 1.0) - q.abs().plain();
            let stiffness = share * share * CORNERING_STIFFNESS / ahead.plain();
            Grip { forward, left, stiffness, sliding }
        },
    )
}

/// How the force by load (1/(m/s)) changes with the motion of the wheel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<T> {
    /// [[∂F_x/∂u, ∂F_x/∂v], [∂F_y/∂u, ∂F_y/∂v]]
    pub(crate) rows: [[T; 2]; 2],
}

impl<T: Number> Choice<T> for Slope<T> {
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        let select = |i: usize, j: usize| <T as Number>::select(mask, yes.rows[i][j], no.rows[i][j]);
        Self { rows: [[select(0, 0), select(0, 1)], [select(1, 0), select(1, 1)]] }
    }
}

/// The slope of [`grip`]. It steers the implicit method, which needs it only roughly: where friction fades it
/// is taken as if the force pointed to the slip.
#[inline(always)]
pub(crate) fn slope<T: Number>(u: T, v: T, tyre: &Tyre<T>, fading_squared: T) -> Slope<T> {
    let zero = u.constant(0.0);
    let slip_squared = u * u + v * v;
    rarely!(
        T,
        slip_squared.below(fading_squared),
        {
            let slope = -faded(tyre, slip_squared, fading_squared);
            Slope { rows: [[slope, zero], [zero, slope]] }
        },
        {
            choose!(
                T,
                is_locked(u, tyre, slip_squared),
                {
                    // ∂F/∂S = −μ/|S| (1 − s sᵀ), s the direction of the slip
                    let slope = -tyre.friction / (slip_squared * slip_squared.sqrt());
                    let across = -(slope * u * v);
                    Slope { rows: [[slope * v * v, across], [across, slope * u * u]] }
                },
                {
                    let reach = tyre.most * u.abs() * (3.0 / CORNERING_STIFFNESS);
                    choose!(T, v.abs().at_least(reach), Slope { rows: [[zero; 2]; 2] }, {
                        let left = (zero + 1.0) - v.abs() / reach;
                        // ∂F_y/∂v = −C_α (1 − |q|)²/|u|, ∂F_y/∂u = −(v/u) ∂F_y/∂v
                        let by_v = -(left * left * CORNERING_STIFFNESS) / u.abs();
                        Slope { rows: [[zero, zero], [-(by_v * v) / u, by_v]] }
                    },)
                },
            )
        },
    )
}
