//! The progress of a motion, its outlook to rest, and the length of its next step.

use crate::field::{Acceleration, Field, GRAVITY};
use crate::number::{Number, choose, rarely, three};
use crate::state::Control;
use crate::step::{Phase, Step};

/// A step is stiff if its length times the stiffness of the tyres is at least this. The explicit method is
/// stable up to 2.5.
const STIFF: f64 = 2.0;

/// Number of consecutive stiff steps after which the implicit method takes over: a wheel whose slip changes
/// direction is stiff only for a moment.
const STIFF_STEPS: f64 = 2.0;

/// Fraction that a step may take of the time to rest under unchanged forces.
const SHARE_OF_THE_REST: f64 = 0.8;

/// Fraction of the estimated error that counts if no wheel begins or ceases to be locked in the step. The
/// estimate is of order 2, the step of order 3; at a kink of the forces all of it counts.
const SMOOTH: f64 = 0.5;

/// (s) time in which an error of the motion across the heading, and of the yaw rate, decays: the tyres
/// straighten a rolling vehicle.
const FORGOTTEN: f64 = 1.0;

/// (m) a remaining path shorter than this counts as straight if the forces hardly turn the motion.
const SHORT: f64 = 0.3;

/// (m) a remaining path that steps down to rest need not resolve: below it the derivatives of the motion are
/// large against the motion, and the derivatives of the forces mostly rounding.
const NEGLIGIBLE: f64 = 1e-6;

/// Relative rounding error of an acceleration.
const ROUNDING: f64 = 1e-13;

/// (m/s²) upper bound of the transverse acceleration of a motion that is straight but for rounding.
const NEARLY_STRAIGHT: f64 = 1e-10;

/// Lower bounds of the squared relative errors of this step and of the one before.
const LEAST_SQUARE: f64 = 1e-16;
const LEAST_SQUARE_BEFORE: f64 = 1e-8;

/// A motion under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress<T> {
    pub(crate) phase: Phase<T>,
    /// (s)
    pub(crate) time: T,
    /// (m)
    pub(crate) distance: T,
    /// (J/kg) work of the tyres' forces so far, negative.
    pub(crate) work: T,
    /// (m/s) of the CG.
    pub(crate) speed: T,
}

impl<T: Number> Progress<T> {
    /// At the start.
    #[inline(always)]
    pub(crate) fn new(phase: Phase<T>) -> Self {
        let [u, v, _] = phase.w;
        let zero = u.constant(0.0);
        Self { phase, time: zero, distance: zero, work: zero, speed: length([u, v]) }
    }

    /// The progress after a step of the length `h` (s) to `end`, in which the tyres' forces did the `work`
    /// (J/kg).
    #[inline(always)]
    pub(crate) fn after(&self, end: Phase<T>, work: T, h: T) -> Self {
        let ([x0, y0, _], [x1, y1, _]) = (self.phase.q, end.q);
        let ([u0, v0, _], [u1, v1, _]) = (self.phase.w, end.w);
        // Simpson's rule with the velocity at the midpoint of the cubic: S = (h|v₀| + |6Δ − h(v₀ + v₁)| +
        // h|v₁|)/6
        let middle = [(x1 - x0) * 6.0 - h * (u0 + u1), (y1 - y0) * 6.0 - h * (v0 + v1)];
        let speed = length([u1, v1]);
        let ways = h * (self.speed + speed) + length(middle);
        Self {
            phase: end,
            time: self.time + h,
            distance: self.distance + ways * (1.0 / 6.0),
            work: self.work + work,
            speed,
        }
    }

    /// The progress at rest, after the final phase in closed form, which takes `time` (s).
    #[inline(always)]
    pub(crate) fn faded(&self, acceleration: &Acceleration<T>, time: T) -> Self {
        let Phase { q, w } = self.phase;
        let half = time * 0.5;
        let rest = half.constant(0.0);
        Self {
            // q + w t/2
            phase: Phase { q: three(|i| q[i] + w[i] * half), w: [rest; 3] },
            time: self.time + time,
            distance: self.distance + self.speed * half,
            // The forces keep their directions while the motion fades, so their power falls in proportion to
            // the speed.
            work: self.work + acceleration.power * half,
            speed: rest,
        }
    }
}

/// Length of a vector; zero with zero derivatives for the zero vector.
#[inline(always)]
fn length<T: Number>([x, y]: [T; 2]) -> T {
    let square = x * x + y * y;
    let zero = square.constant(0.0);
    choose!(T, zero.below(square), square.sqrt(), zero)
}

/// The rest of a motion if the forces only slow it down.
#[derive(Clone, Copy)]
pub(crate) struct Outlook<P: Number> {
    /// (s) the time to rest in that case; infinite if the vehicle does not lose speed.
    pub(crate) to_rest: P,
    /// Whether the forces only slow it down, to within the tolerance.
    pub(crate) fades: P::Mask,
}

impl<P: Number<Plain = P>> Outlook<P> {
    /// For a motion `w` with its `rates` of change; `lever` (m) converts a turn into a distance.
    #[inline(always)]
    pub(crate) fn new(field: &Field<P>, w: [P; 3], rates: [P; 3], lever: P, control: &Control) -> Self {
        let (energy, power) = (field.energy(w), field.product(rates, w));
        let zero = energy.constant(0.0);
        let (rests, slows) = (zero.at_least(energy), power.below(zero));
        // t = 2T/|P|
        let t = P::select(slows, -(energy / power), zero.constant(f64::INFINITY));
        let t = P::select(rests, zero, t);
        let half = t * 0.5;
        let speed_squared = w[0] * w[0] + w[1] * w[1];
        let (way_squared, turn) = (speed_squared * (half * half), w[2].abs() * half);
        let swing = turn * lever;
        let size_squared = P::greater(way_squared, swing * swing);
        let most = |size: f64| zero.constant(size * size);
        let least = control.tolerance / 10.0;
        let negligible =
            size_squared.below(most(if control.closed_end { least } else { least.max(NEGLIGIBLE) }));
        let closed = if control.closed_end { SHORT } else { 0.0 };
        let short = size_squared.below(most(closed));
        // The acceleration that turns the motion: a⊥ = a − (a·w/w²) w, here times w²
        let [ax, ay, alpha] = three(|i| energy * rates[i] - power * w[i]);
        let across_squared = ax * ax + ay * ay;
        // A longer path must be straight but for rounding; most are far from it.
        let nearly = if control.closed_end { NEARLY_STRAIGHT } else { 0.0 };
        let straight = across_squared.below(most(nearly) * (energy * energy));
        let excess = rarely!(
            P,
            P::one_of(short, straight),
            {
                let strength = (rates[0] * rates[0] + rates[1] * rates[1]).sqrt();
                // The forces turn with the vehicle; in a pure spin there are none.
                let carried = P::select(zero.below(way_squared), strength * turn, zero);
                let (across, alpha) = (across_squared.sqrt() / energy, alpha.abs() / energy);
                let miss = P::greater(across + carried, alpha * lever) * (t * half);
                let rounding = (strength + GRAVITY) * (t * t) * ROUNDING;
                let allowed = P::select(short, zero + control.tolerance / 4.0, rounding);
                miss - P::greater(allowed, rounding)
            },
            zero + 1.0,
        );
        let fades = P::one_of(negligible, zero.at_least(excess));
        Self { to_rest: t, fades: P::one_of(rests, P::both(slows, fades)) }
    }
}

/// Step length control, and the choice of the method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace<P> {
    /// (s) length to try next.
    pub(crate) length: P,
    /// Square of the error of the last step relative to the tolerance.
    before: P,
    /// Number of consecutive stiff steps; after [`STIFF_STEPS`] the integrator switches permanently to the
    /// implicit method.
    stiff: P,
}

impl<P: Number<Plain = P>> Pace<P> {
    /// The pace of the first step, in the number type of `one`.
    #[inline(always)]
    pub(crate) fn new(one: P) -> Self {
        // A first guess, which the first error corrects.
        Self { length: one.constant(0.05), before: one.constant(1.0), stiff: one.constant(0.0) }
    }

    /// All values, for [`of`](Self::of).
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [P; 3] {
        [self.length, self.before, self.stiff]
    }

    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn of([length, before, stiff]: [P; 3]) -> Self {
        Self { length, before, stiff }
    }

    #[inline(always)]
    pub(crate) fn is_implicit(&self) -> P::Mask {
        self.stiff.at_least(self.stiff.constant(STIFF_STEPS))
    }

    /// (s) length of the next step, limited by the time to rest `to_rest` (s) and the time `left` (s).
    #[inline(always)]
    pub(crate) fn next(&self, to_rest: P, left: P, control: &Control) -> P {
        let most = P::lesser(to_rest * SHARE_OF_THE_REST, left);
        P::lesser(P::lesser(self.length, most), most.constant(control.longest_step))
    }

    /// Records an accepted step of the length `h` (s), with the square of its error relative to the
    /// tolerance; `again` if a longer step was rejected before.
    #[inline(always)]
    pub(crate) fn accept(&mut self, h: P, error_squared: P, again: P::Mask) {
        let now = P::greater(error_squared, h.constant(LEAST_SQUARE));
        // h ← 0.9 h e^−¼ e₋₁^⅛: a PI controller for order 3 (Gustafsson, ACM TOMS 17 (1991) 533, has e^−0.7/3
        // and e₋₁^0.4/3)
        let grow = now.rough_inverse_root(3) * self.before.rough_root(4) * 0.85;
        let most = P::select(again, h.constant(1.0), h.constant(5.0));
        self.length = h * P::greater(P::lesser(grow, most), h.constant(0.2));
        self.before = P::greater(now, h.constant(LEAST_SQUARE_BEFORE));
    }

    /// The length (s) to try after a step of `h` (s) was rejected with this squared error.
    #[inline(always)]
    pub(crate) fn shorter(h: P, error_squared: P) -> P {
        // At a kink of the forces the error falls only as h².
        let shrink = error_squared.rough_inverse_root(2) * 0.85;
        h * P::greater(P::lesser(shrink, h.constant(0.9)), h.constant(0.1))
    }

    /// Counts stiff steps, by the stiffness (1/s) at the end of the step.
    #[inline(always)]
    pub(crate) fn count(&mut self, stiffness: P) {
        let is_stiff = (stiffness * self.length).at_least(stiffness.constant(STIFF));
        let counted = P::select(is_stiff, self.stiff + 1.0, self.stiff.constant(0.0));
        self.stiff = P::select(self.is_implicit(), self.stiff, counted);
    }
}

/// Square of the error that a step adds to the rest, relative to the tolerance, if the vehicle takes about
/// `to_rest` (s) more.
#[inline(always)]
pub(crate) fn error_squared<T: Number>(
    step: &Step<T>,
    to_rest: T::Plain,
    lever: T::Plain,
    control: &Control,
) -> T::Plain {
    let left = T::Plain::lesser(to_rest, to_rest.constant(FORGOTTEN)) * 0.5;
    let [x, y, heading] = three(|i| step.error_q[i].abs() + step.error_w[i].abs() * left);
    let swing = heading * lever;
    let square = T::Plain::greater(x * x + y * y, swing * swing);
    // The tyres do not reduce an error of the speed: δs = δu t/2 with δu = δw·w/|w|
    let [u, v, _] = step.end.w.map(|part| part.plain());
    let gain = step.error_w[0] * u + step.error_w[1] * v;
    let left = T::Plain::lesser(to_rest, to_rest.constant(control.longest_time)) * 0.5;
    let stretch_squared = gain * gain * (left * left) / (u * u + v * v + f64::MIN_POSITIVE);
    let square = T::Plain::greater(square, stretch_squared);
    let counts = <T::Plain as Number>::select(step.smooth, square * (SMOOTH * SMOOTH), square);
    counts * (1.0 / (control.tolerance * control.tolerance))
}
