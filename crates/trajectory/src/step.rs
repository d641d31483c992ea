//! One step of the integration, by one of two methods of order 3 with an embedded error estimate of order 2.
//!
//! Both estimate well at the kinks of the forces, where a wheel begins to slide or to roll: there a method of
//! higher order, which relies on smooth forces, underestimates its error. While the vehicle spins, the method
//! is explicit. The equations become stiff as the vehicle slows: the rates at which a rolling vehicle
//! straightens are about 9g/u, and an explicit method then takes hundreds of steps to the rest. So the last
//! part uses a linearly implicit, L-stable method, a W-method that keeps its order with a rough matrix of
//! derivatives.

use real::Real;

use crate::field::{Acceleration, Field, Matrix, resolvent};
use crate::number::{Direction, Number, direction_of_turn, direction_within_step, three};
use crate::steer::Steer;

/// γ of ROS34PW2 (Rang & Angermann, BIT 45 (2005) 761), the middle root of 6γ³ − 18γ² + 9γ − 1.
const GAMMA: f64 = 0.435_866_521_508_459;
/// α_ij, rows 2 to 4.
const ALPHA: [[f64; 3]; 3] = [
    [0.871_733_043_016_918, 0.0, 0.0],
    [0.844_570_600_153_694_2, -0.112_990_642_364_841_85, 0.0],
    [0.0, 0.0, 1.0],
];
/// γ_ij, rows 2 to 4.
const GAMMAS: [[f64; 3]; 3] = [
    [-0.871_733_043_016_918, 0.0, 0.0],
    [-0.903_380_570_130_440_8, 0.054_180_672_388_095_326, 0.0],
    [0.242_123_807_060_953_46, -1.223_250_583_904_514_7, 0.545_260_255_335_102_1],
];
/// b_i of order 3.
const WEIGHTS: [f64; 4] =
    [0.242_123_807_060_953_46, -1.223_250_583_904_514_7, 1.545_260_255_335_102, 0.435_866_521_508_459];
/// b̂_i of order 2.
const EMBEDDED: [f64; 4] = [0.378_109_031_458_193_7, -0.096_042_292_212_423_18, 0.5, 0.217_933_260_754_229_5];

/// b_i − b̂_i.
const IMPLICIT_ERROR: [f64; 4] =
    [WEIGHTS[0] - EMBEDDED[0], WEIGHTS[1] - EMBEDDED[1], WEIGHTS[2] - EMBEDDED[2], WEIGHTS[3] - EMBEDDED[3]];

/// Position and motion as integrated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase<T> {
    /// (m, m, rad) x, y, ψ.
    pub(crate) q: [T; 3],
    /// (m/s, m/s, rad/s) v_x, v_y, ω.
    pub(crate) w: [T; 3],
}

/// The result of a step.
#[derive(Clone, Copy)]
pub(crate) struct Step<T: Number> {
    pub(crate) end: Phase<T>,
    /// The direction of the heading and the acceleration at the end.
    pub(crate) there: (Direction<T>, Acceleration<T>),
    /// Whether the same wheels are locked at the end as at the start.
    pub(crate) smooth: T::Mask,
    /// (J/kg) work of the tyres' forces, negative.
    pub(crate) work: T,
    /// (m, m, rad) estimated error of x, y, ψ.
    pub(crate) error_q: [T::Plain; 3],
    /// (m/s, m/s, rad/s) estimated error of v_x, v_y, ω.
    pub(crate) error_w: [T::Plain; 3],
}

/// The steering, with constants computed once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Steering<'a, T, G> {
    Held(Direction<T>),
    Over(Steer<'a, G>),
}

impl<'a, T: Real + From<G>, G: Real> Steering<'a, T, G> {
    pub(crate) fn new(steer: Steer<'a, G>) -> Self {
        match steer {
            Steer::Held(angle) => Self::Held(Direction::of(T::from(angle))),
            Steer::Over(_) => Self::Over(steer),
        }
    }

    /// The steer angle at a time (s).
    #[inline(always)]
    pub(crate) fn at(&self, time: T) -> Direction<T> {
        match self {
            Self::Held(direction) => *direction,
            Self::Over(steer) => Direction::of(steer.angle(time)),
        }
    }
}

/// The beginning of a step.
#[derive(Clone, Copy)]
pub(crate) struct Start<T: Number> {
    pub(crate) time: T,
    pub(crate) phase: Phase<T>,
    /// Sine and cosine of the heading.
    pub(crate) direction: Direction<T>,
    pub(crate) acceleration: Acceleration<T>,
    /// (1/s) rough derivatives of the accelerations with respect to (v_x, v_y, ω), for the implicit method.
    pub(crate) slope: Option<Matrix<T::Plain>>,
}

impl<T: Number> Step<T> {
    /// Whether position and heading are finite.
    #[inline(always)]
    pub(crate) fn is_finite(&self) -> T::Mask {
        let [x, y, heading] = self.end.q;
        let sum = (x + y + heading).abs();
        sum.below(sum.constant(f64::INFINITY))
    }
}

impl<T: Number> Start<T> {
    /// A step of the length `h` (s), by the implicit method if there is a slope.
    #[inline(always)]
    pub(crate) fn step(&self, field: &Field<T>, steer: impl Fn(T) -> Direction<T>, h: T) -> Step<T> {
        match &self.slope {
            Some(slope) => self.implicit(field, steer, h, *slope),
            None => self.explicit(field, steer, h),
        }
    }

    /// Whether the same wheels are locked at the end.
    #[inline(always)]
    fn is_smooth(&self, end: &Acceleration<T>) -> T::Mask {
        let difference = (end.locked - self.acceleration.locked).abs();
        difference.below(difference.constant(0.5))
    }

    /// The acceleration `elapsed` (s) into the step, after the heading has turned by `turn` (rad) and the
    /// motion has become `w`.
    #[inline(always)]
    fn stage(
        &self,
        field: &Field<T>,
        steer: &impl Fn(T) -> Direction<T>,
        elapsed: T,
        turn: T,
        w: [T; 3],
    ) -> Acceleration<T> {
        field.acceleration(self.heading(turn), w, steer(self.time + elapsed))
    }

    /// The direction of the heading at a stage of the step, after a turn by `turn` (rad).
    #[inline(always)]
    fn heading(&self, turn: T) -> Direction<T> {
        self.direction.turned(direction_within_step(turn))
    }

    /// The direction at the end of the step, to rounding.
    #[inline(always)]
    fn last_heading(&self, turn: T) -> Direction<T> {
        self.direction.turned(direction_of_turn(turn))
    }

    /// Bogacki & Shampine, Appl. Math. Lett. 2 (1989) 321. Its last stage is the first of the next step.
    #[inline(always)]
    fn explicit(&self, field: &Field<T>, steer: impl Fn(T) -> Direction<T>, h: T) -> Step<T> {
        let Phase { q, w: w1 } = self.phase;
        let (a1, p1) = (self.acceleration.rates, self.acceleration.power);
        // The headings do not depend on the forces of their own stage, so they are computed before them.
        // w₂ = w₁ + h a₁/2
        let (half, most) = (h * 0.5, h * 0.75);
        let w2 = three(|i| w1[i] + half * a1[i]);
        let heading = self.heading(half * w1[2]);
        let next_heading = self.heading(most * w2[2]);
        let second = field.acceleration(heading, w2, steer(self.time + half));
        let (a2, p2) = (second.rates, second.power);
        // w₃ = w₁ + 3h a₂/4
        let w3 = three(|i| w1[i] + most * a2[i]);
        // Δ = h (2k₁ + 3k₂ + 4k₃)/9
        let ninth = h * (1.0 / 9.0);
        let sum = |k1: T, k2: T, k3: T| ninth * (k1 * 2.0 + k2 * 3.0 + k3 * 4.0);
        let way = three(|i| sum(w1[i], w2[i], w3[i]));
        let last_heading = self.last_heading(way[2]);
        let third = field.acceleration(next_heading, w3, steer(self.time + most));
        let (a3, p3) = (third.rates, third.power);
        let gain = three(|i| sum(a1[i], a2[i], a3[i]));
        let w4 = three(|i| w1[i] + gain[i]);
        let there = (last_heading, field.acceleration(last_heading, w4, steer(self.time + h)));
        let a4 = there.1.rates;
        // The weights of order 2 are 7/24, 1/4, 1/3 and 1/8: e = h (−5k₁ + 6k₂ + 8k₃ − 9k₄)/72
        //                                                     = (Δ − h (k₁ + k₄)/2)/4.
        let half = h.plain() * 0.5;
        let off = |change: T, k1: T, k4: T| (change.plain() - half * (k1.plain() + k4.plain())) * 0.25;
        Step {
            end: Phase { q: three(|i| q[i] + way[i]), w: w4 },
            there,
            smooth: self.is_smooth(&there.1),
            work: sum(p1, p2, p3),
            error_q: three(|i| off(way[i], w1[i], w4[i])),
            error_w: three(|i| off(gain[i], a1[i], a4[i])),
        }
    }

    #[inline(always)]
    fn implicit(
        &self,
        field: &Field<T>,
        steer: impl Fn(T) -> Direction<T>,
        h: T,
        slope: Matrix<T::Plain>,
    ) -> Step<T> {
        let Phase { q, w } = self.phase;
        let solver = Solver { matrix: resolvent(slope, h.plain() * GAMMA), h };
        let zero = h.constant(0.0);
        // Y_i = y + h Σ α_ij k_j, g_i = Σ_{j<i} γ_ij k_j/γ
        let first = solver.slopes(w, self.acceleration.rates, [zero; 3]);
        let [[a, ..], [b, c, _], _] = ALPHA;
        let [[d, ..], [e, f, _], [l, m, n]] = GAMMAS.map(|row| row.map(|gamma| gamma / GAMMA));
        let w2 = three(|i| w[i] + h * (first.w[i] * a));
        let second = self.stage(field, &steer, h * a, h * (first.q[2] * a), w2);
        let p2 = second.power;
        let second = solver.slopes(w2, second.rates, three(|i| first.w[i] * d));
        let w3 = three(|i| w[i] + h * (first.w[i] * b + second.w[i] * c));
        let turn = h * (first.q[2] * b + second.q[2] * c);
        let third = self.stage(field, &steer, h * (b + c), turn, w3);
        let p3 = third.power;
        let third = solver.slopes(w3, third.rates, three(|i| first.w[i] * e + second.w[i] * f));
        let w4 = three(|i| w[i] + h * third.w[i]);
        let fourth = self.stage(field, &steer, h, h * third.q[2], w4);
        let p4 = fourth.power;
        let carried = three(|i| first.w[i] * l + second.w[i] * m + third.w[i] * n);
        let fourth = solver.slopes(w4, fourth.rates, carried);
        let kq = three(|i| [first.q[i], second.q[i], third.q[i], fourth.q[i]]);
        let kw = three(|i| [first.w[i], second.w[i], third.w[i], fourth.w[i]]);
        let way = three(|i| combined(h, kq[i], &WEIGHTS));
        let end = Phase { q: three(|i| q[i] + way[i]), w: three(|i| w[i] + combined(h, kw[i], &WEIGHTS)) };
        let heading = self.last_heading(way[2]);
        let work = combined(h, [self.acceleration.power, p2, p3, p4], &WEIGHTS);
        let error_of = |k: [T; 4]| {
            combined(h.plain(), [k[0].plain(), k[1].plain(), k[2].plain(), k[3].plain()], &IMPLICIT_ERROR)
        };
        let there = (heading, field.acceleration(heading, end.w, steer(self.time + h)));
        Step {
            end,
            there,
            smooth: self.is_smooth(&there.1),
            work,
            error_q: three(|i| error_of(kq[i])),
            error_w: three(|i| error_of(kw[i])),
        }
    }
}

/// h Σ b_i k_i
#[inline(always)]
fn combined<T: Number>(h: T, k: [T; 4], by: &[f64; 4]) -> T {
    h * ((k[0] * by[0] + k[1] * by[1]) + (k[2] * by[2] + k[3] * by[3]))
}

/// Data shared by the stages of the implicit method.
struct Solver<T: Number> {
    /// (1 − γhJ)⁻¹
    matrix: Matrix<T::Plain>,
    h: T,
}

/// k_i of the position and of the motion.
struct Slopes<T> {
    q: [T; 3],
    w: [T; 3],
}

impl<T: Number> Solver<T> {
    /// The slopes of a stage with the motion `at` and its `rates`, with g_i `carried` from the earlier
    /// stages.
    #[inline(always)]
    fn slopes(&self, at: [T; 3], rates: [T; 3], carried: [T; 3]) -> Slopes<T> {
        // k_i = (1 − γhJ)⁻¹ (f(Y_i) + g_i) − g_i
        let [a, b, c] = three(|i| rates[i] + carried[i]);
        let m = &self.matrix;
        let sum = three(|i| a.scaled(m[i][0]) + b.scaled(m[i][1]) + c.scaled(m[i][2]));
        // For the position J is exactly 1: k_i = w_i + h Σ γ_ij k_j of the motion
        let q = three(|i| at[i] + self.h * (sum[i] * GAMMA));
        Slopes { q, w: three(|i| sum[i] - carried[i]) }
    }
}
