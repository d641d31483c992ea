//! The force of one tyre on the ground.

use crate::number::{Choice, Number, choose, four, rarely};

/// (1/rad) cornering stiffness of a tyre relative to its load: 9 F_z per radian (EDSMAC4's tables have 8 to
/// 11).
pub const CORNERING_STIFFNESS: f64 = 9.0;

/// Fraction of the vehicle's speed: the friction of a wheel that slips slower fades to zero with the slip, so
/// that it always has a direction.
///
/// Otherwise the force at a wheel about which the vehicle spins would reverse at once. A fraction, rather
/// than a speed, keeps the forces independent of the magnitude of the motion.
pub(crate) const FADING: f64 = 0.01;

/// The properties of a tyre on its ground. Its forces are per unit mass of the vehicle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tyre<T> {
    /// (m/s²) μ F_z
    pub(crate) friction: T,
    /// (m/s²) d F_z
    pub(crate) drag: T,
    /// (m/s²) F_y,max, zero for a locked wheel.
    pub(crate) most: T,
    /// (m/s²) C_α
    pub(crate) cornering: T,
    /// (–) q over the tangent of the slip angle, C_α/(3 F_y,max); infinite for a locked wheel.
    pub(crate) bend: T,
    /// (–) (d/μ)²: the wheel is locked if u²/S² is not greater.
    pub(crate) locking: T,
}

/// Number of values in a [`Tyre`].
#[cfg(feature = "std")]
pub(crate) const TYRE_NUMBERS: usize = 6;

impl<T: Number> Tyre<T> {
    #[inline(always)]
    pub(crate) fn new(friction: T, drag: T, cornering: T) -> Self {
        // F_y,max² = (μ F_z)² − (d F_z)²
        let square = friction * friction - drag * drag;
        let most = root(square);
        let bend = cornering / (most * 3.0);
        let share = drag / friction;
        Self { friction, drag, most, cornering, bend, locking: share * share }
    }

    /// The tyre without derivatives.
    #[inline(always)]
    pub(crate) fn plain(&self) -> Tyre<T::Plain> {
        let Self { friction, drag, most, cornering, bend, locking } = *self;
        Tyre {
            friction: friction.plain(),
            drag: drag.plain(),
            most: most.plain(),
            cornering: cornering.plain(),
            bend: bend.plain(),
            locking: locking.plain(),
        }
    }

    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [T; TYRE_NUMBERS] {
        let Self { friction, drag, most, cornering, bend, locking } = *self;
        [friction, drag, most, cornering, bend, locking]
    }

    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn of([friction, drag, most, cornering, bend, locking]: [T; TYRE_NUMBERS]) -> Self {
        Self { friction, drag, most, cornering, bend, locking }
    }
}

/// A tyre's force on the ground per unit mass of the vehicle, in the wheel's own axes: in the direction of
/// slip, so that the ground pushes the wheel the other way.
#[derive(Clone, Copy)]
pub(crate) struct Grip<T: Number> {
    /// (m/s²) along the wheel.
    pub(crate) forward: T,
    /// (m/s²) to its left.
    pub(crate) left: T,
    /// (1/s) change of the force with the motion of the wheel.
    pub(crate) stiffness: T::Plain,
    /// Whether the whole tread slides and leaves a mark.
    pub(crate) sliding: T::Mask,
    /// Whether the wheel is locked.
    pub(crate) locked: T::Mask,
}

impl<T: Number> Choice<T> for Grip<T> {
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self {
            forward: <T as Number>::select(mask, yes.forward, no.forward),
            left: <T as Number>::select(mask, yes.left, no.left),
            stiffness: <T::Plain as Number>::select(mask, yes.stiffness, no.stiffness),
            sliding: T::select_mask(mask, yes.sliding, no.sliding),
            locked: T::select_mask(mask, yes.locked, no.locked),
        }
    }
}

/// A wheel moving with (`u`, `v`) (m/s) forward and left.
#[derive(Clone, Copy)]
pub(crate) struct Slip<'a, T> {
    pub(crate) u: T,
    pub(crate) v: T,
    pub(crate) tyre: &'a Tyre<T>,
}

impl<T: Number> Slip<'_, T> {
    #[inline(always)]
    fn squared(&self) -> T {
        self.u * self.u + self.v * self.v
    }

    /// Whether the wheel is locked, if it slips too fast for friction to fade.
    ///
    /// A brake cannot hold a wheel against more drag than the ground provides: a wheel is locked if its drag
    /// exceeds the component along it of friction against the slip. Slipping sideways, every wheel is then
    /// practically locked, and the force is continuous where u changes sign. EDSMAC4's −sgn(u) d F_z jumps
    /// there.
    #[inline(always)]
    fn is_locked(&self, squared: T) -> T::Mask {
        // (d/μ)² S² ≥ u²
        (self.tyre.locking * squared).at_least(self.u * self.u)
    }

    /// The force without fading; `by_speed` (s/m) is 1/S for a locked wheel and 1/|u| for another.
    #[inline(always)]
    fn grip(&self, locked: T::Mask, by_speed: T) -> Grip<T> {
        choose!(
            T,
            locked,
            dragged(self.u, self.v, self.tyre.friction * by_speed, locked),
            rolling(self.u, self.v, by_speed, self.tyre, locked),
        )
    }

    /// The force below the slip speed at which friction fades, whose square is `fading_squared` ((m/s)²).
    #[inline(always)]
    fn faded(&self, squared: T, fading_squared: T) -> Grip<T> {
        let Self { u, v, tyre } = *self;
        let by_slip = faded(tyre, squared, fading_squared);
        let faded = Tyre::new(by_slip * root(squared), tyre.drag, tyre.cornering);
        // d ≥ (μ′/S) |u|
        let locked = tyre.drag.at_least(by_slip * u.abs());
        choose!(
            T,
            locked,
            dragged(u, v, by_slip, locked),
            rolling(u, v, u.abs().reciprocal(), &faded, locked),
        )
    }
}

/// The forces of four tyres; friction fades below a slip speed whose square is `fading_squared` ((m/s)²).
///
/// Four at once, so that lanes check only once whether any of them needs the rare case.
#[inline(always)]
pub(crate) fn grips<T: Number>(slips: [Slip<'_, T>; 4], fading_squared: T) -> [Grip<T>; 4] {
    let squared = four(|i| slips[i].squared());
    let locked = four(|i| slips[i].is_locked(squared[i]));
    let by_speed = inverse_speeds(&slips, squared, locked);
    // A closure this large would otherwise be compiled separately, without the vector instructions of its
    // caller, and would need a call for each operation.
    let grips = four(
        #[inline(always)]
        |i| slips[i].grip(locked[i], by_speed[i]),
    );
    let fades = four(|i| squared[i].below(fading_squared));
    if T::any(T::one_of(T::one_of(fades[0], fades[1]), T::one_of(fades[2], fades[3]))) {
        four(
            #[inline(always)]
            |i| rarely!(T, fades[i], slips[i].faded(squared[i], fading_squared), grips[i]),
        )
    } else {
        grips
    }
}

/// (m/s) smallest divisor; slower wheels take the fading case.
const LEAST_SPEED: f64 = 1e-150;

/// (s/m) 1/S for the locked wheels and 1/|u| for the others.
#[inline(always)]
fn inverse_speeds<T: Number>(slips: &[Slip<'_, T>; 4], squared: [T; 4], locked: [T::Mask; 4]) -> [T; 4] {
    let speeds = speeds(slips, squared, locked);
    let speeds = four(|i| speeds[i].greater(speeds[i].constant(LEAST_SPEED)));
    // One division for two wheels: 1/a = b/(a b)
    let (front, rear) = ((speeds[0] * speeds[1]).reciprocal(), (speeds[2] * speeds[3]).reciprocal());
    [front * speeds[1], front * speeds[0], rear * speeds[3], rear * speeds[2]]
}

/// (m/s) S for the locked wheels and |u| for the others.
#[inline(always)]
fn speeds<T: Number>(slips: &[Slip<'_, T>; 4], squared: [T; 4], locked: [T::Mask; 4]) -> [T; 4] {
    let [a, b, c, d] = locked;
    let (one_in_front, one_of_three) = (T::one_of(a, b), T::one_of(T::one_of(a, b), c));
    if !T::any(T::one_of(one_of_three, d)) {
        return four(|i| slips[i].u.abs());
    }
    let two = T::one_of(T::one_of(T::both(a, b), T::both(one_in_front, c)), T::both(one_of_three, d));
    if T::certain(a).is_some() || T::any(two) {
        return four(|i| choose!(T, locked[i], squared[i].sqrt(), slips[i].u.abs()));
    }
    // If no lane has two locked wheels, one root serves all wheels.
    let select = |mask: T::Mask, yes: T, no: T| <T as Number>::select(mask, yes, no);
    let square = select(a, squared[0], select(b, squared[1], select(c, squared[2], squared[3])));
    let root = square.sqrt();
    four(|i| select(locked[i], root, slips[i].u.abs()))
}

/// (1/s) fading friction divided by slip.
#[inline(always)]
fn faded<T: Number>(tyre: &Tyre<T>, slip_squared: T, fading_squared: T) -> T {
    // μ′/S = 2μ εV/(S² + ε²V²), so that μ′ joins μ without a kink at S = εV
    tyre.friction * (fading_squared.sqrt() * 2.0) / (slip_squared + fading_squared)
}

/// √x; zero with zero derivatives for x ≤ 0.
#[inline(always)]
fn root<T: Number>(x: T) -> T {
    let zero = x.constant(0.0);
    choose!(T, zero.below(x), x.sqrt(), zero)
}

/// The force of a locked wheel: `by_slip` (1/s) times the slip.
#[inline(always)]
fn dragged<T: Number>(u: T, v: T, by_slip: T, locked: T::Mask) -> Grip<T> {
    // −F = μ F_z S/|S|
    let stiffness = by_slip.plain();
    Grip { forward: by_slip * u, left: by_slip * v, stiffness, sliding: locked, locked }
}

/// The force of a rolling wheel; `by_speed` (s/m) is 1/|u|.
#[inline(always)]
fn rolling<T: Number>(u: T, v: T, by_speed: T, tyre: &Tyre<T>, locked: T::Mask) -> Grip<T> {
    // 1 − |q|, q = C_α tan α/(3 F_y,max), until the whole tread slides
    let part = v.abs() * by_speed * tyre.bend;
    let one = u.constant(1.0);
    let adhesion = one - part;
    let zero = u.constant(0.0);
    let sliding = zero.at_least(adhesion);
    let adhesion = adhesion.greater(zero);
    let square = adhesion * adhesion;
    Grip {
        forward: tyre.drag.with_sign_of(u),
        // |F_y| = F_y,max (3q − 3q² + q³) = F_y,max (1 − (1 − q)³)
        left: (tyre.most * (one - square * adhesion)).with_sign_of(v),
        // −∂F_y/∂v = C_α (1 − |q|)²/|u|
        stiffness: (tyre.cornering * square * by_speed).plain(),
        sliding,
        locked,
    }
}

/// (1/s) derivatives of the force, per unit mass of the vehicle, with respect to the motion of the wheel.
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

/// The slopes of [`grips`], for the implicit method, which needs them only roughly: fading friction is
/// treated as if the force pointed along the slip.
#[inline(always)]
pub(crate) fn slopes<T: Number>(slips: [Slip<'_, T>; 4], fading_squared: T) -> [Slope<T>; 4] {
    let squared = four(|i| slips[i].squared());
    let locked = four(|i| slips[i].is_locked(squared[i]));
    let by_speed = inverse_speeds(&slips, squared, locked);
    four(|i| {
        rarely!(
            T,
            squared[i].below(fading_squared),
            {
                let slope = -faded(slips[i].tyre, squared[i], fading_squared);
                let zero = slope.constant(0.0);
                Slope { rows: [[slope, zero], [zero, slope]] }
            },
            slips[i].slope(locked[i], by_speed[i]),
        )
    })
}

impl<T: Number> Slip<'_, T> {
    #[inline(always)]
    fn slope(&self, locked: T::Mask, by_speed: T) -> Slope<T> {
        let Self { u, v, tyre } = *self;
        choose!(
            T,
            locked,
            {
                // ∂F/∂S = −μ/|S| (1 − s sᵀ), s the direction of the slip
                let slope = -(tyre.friction * by_speed * (by_speed * by_speed));
                let across = -(slope * u * v);
                Slope { rows: [[slope * v * v, across], [across, slope * u * u]] }
            },
            {
                // ∂F_y/∂v = −C_α (1 − |q|)²/|u|, ∂F_y/∂u = −(v/u) ∂F_y/∂v
                let zero = u.constant(0.0);
                let adhesion = (u.constant(1.0) - v.abs() * by_speed * tyre.bend).greater(zero);
                let by_v = -(adhesion * adhesion * tyre.cornering) * by_speed;
                let by_u = -(by_v * v) * (u * by_speed * by_speed);
                Slope { rows: [[zero, zero], [by_u, by_v]] }
            },
        )
    }
}
