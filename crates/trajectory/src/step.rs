//! One step of the integration, by one of two methods of order 3 that estimate their error by one of order 2.
//!
//! Both estimate well where a wheel begins to slide or to roll, and the forces bend: there a method of higher
//! order, which counts on smooth forces, errs by more than it tells. While the vehicle spins, the method is
//! explicit. Tyres stiffen as it slows: the rates with which a rolling vehicle straightens are about 9g/u,
//! and an explicit method then takes hundreds of steps to the rest. So the last part is left to one that is
//! linearly implicit and L-stable, and as a W-method keeps its order with a rough matrix of derivatives.

use real::Real;

use crate::field::{Acceleration, Field, Matrix, resolvent};
use crate::number::{Direction, Number, direction_of_turn, three};
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

/// What b_i differ by from b̂_i.
const IMPLICIT_ERROR: [f64; 4] =
    [WEIGHTS[0] - EMBEDDED[0], WEIGHTS[1] - EMBEDDED[1], WEIGHTS[2] - EMBEDDED[2], WEIGHTS[3] - EMBEDDED[3]];

/// Place and motion as the integration has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase<T> {
    /// (m, m, rad) x, y, ψ.
    pub(crate) q: [T; 3],
    /// (m/s, m/s, rad/s) v_x, v_y, ω.
    pub(crate) w: [T; 3],
}

/// Where a step leads.
#[derive(Clone, Copy)]
pub(crate) struct Step<T: Number> {
    pub(crate) end: Phase<T>,
    /// The direction of the heading and the acceleration there, where the method has them.
    pub(crate) there: Option<(Direction<T>, Acceleration<T>)>,
    /// (J/kg) work of the tyres' forces, negative.
    pub(crate) work: T,
    /// (m, m, rad) estimated error of x, y, ψ.
    pub(crate) error_q: [T::Plain; 3],
    /// (m/s, m/s, rad/s) estimated error of v_x, v_y, ω.
    pub(crate) error_w: [T::Plain; 3],
}

/// The steering, with what can be computed once.
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

/// Where a step begins.
#[derive(Clone, Copy)]
pub(crate) struct Start<T: Number> {
    pub(crate) time: T,
    pub(crate) phase: Phase<T>,
    /// That of the heading.
    pub(crate) direction: Direction<T>,
    pub(crate) acceleration: Acceleration<T>,
    /// (1/s) the derivatives of the accelerations by (v_x, v_y, ω), roughly, for the implicit method.
    pub(crate) slope: Option<Matrix<T::Plain>>,
}

impl<T: Number> Start<T> {
    /// A step of the length `h` (s), by the implicit method where there is a slope.
    #[inline(always)]
    pub(crate) fn step(&self, field: &Field<T>, steer: impl Fn(T) -> Direction<T>, h: T) -> Step<T> {
        match &self.slope {
            Some(slope) => self.implicit(field, steer, h, *slope),
            None => self.explicit(field, steer, h),
        }
    }

    /// The acceleration `elapsed` (s) into the step, where the motion has become `w`, and the heading has
    /// turned by `turn` (rad).
    #[inline(always)]
    fn stage(
        &self,
        field: &Field<T>,
        steer: &impl Fn(T) -> Direction<T>,
        elapsed: T,
        turn: T,
        w: [T; 3],
    ) -> (Direction<T>, Acceleration<T>) {
        let heading = self.direction.turned(direction_of_turn(turn));
        (heading, field.acceleration(heading, w, steer(self.time + elapsed)))
    }

    /// Bogacki & Shampine, Appl. Math. Lett. 2 (1989) 321. Its last stage is the first of the next step.
    #[inline(always)]
    fn explicit(&self, field: &Field<T>, steer: impl Fn(T) -> Direction<T>, h: T) -> Step<T> {
        let Phase { q, w: w1 } = self.phase;
        let (a1, p1) = (self.acceleration.rates, self.acceleration.power);
        // w₂ = w₁ + h a₁/2
        let part = h * 0.5;
        let w2 = three(|i| w1[i] + part * a1[i]);
        let (_, second) = self.stage(field, &steer, part, part * w1[2], w2);
        let (a2, p2) = (second.rates, second.power);
        // w₃ = w₁ + 3h a₂/4
        let part = h * 0.75;
        let w3 = three(|i| w1[i] + part * a2[i]);
        let (_, third) = self.stage(field, &steer, part, part * w2[2], w3);
        let (a3, p3) = (third.rates, third.power);
        // Δ = h (2k₁ + 3k₂ + 4k₃)/9
        let ninth = h * (1.0 / 9.0);
        let sum = |k1: T, k2: T, k3: T| ninth * (k1 * 2.0 + k2 * 3.0 + k3 * 4.0);
        let way = three(|i| sum(w1[i], w2[i], w3[i]));
        let w4 = three(|i| w1[i] + sum(a1[i], a2[i], a3[i]));
        let there = self.stage(field, &steer, h, way[2], w4);
        let a4 = there.1.rates;
        // The weights of order 2 are 7/24, 1/4, 1/3 and 1/8: e = h (−5k₁ + 6k₂ + 8k₃ − 9k₄)/72.
        let part = h.plain() * (1.0 / 72.0);
        let off = |k1: T, k2: T, k3: T, k4: T| {
            let sum = (k2.plain() * 6.0 - k1.plain() * 5.0) + (k3.plain() * 8.0 - k4.plain() * 9.0);
            (part * sum).abs()
        };
        Step {
            end: Phase { q: three(|i| q[i] + way[i]), w: w4 },
            there: Some(there),
            work: sum(p1, p2, p3),
            error_q: three(|i| off(w1[i], w2[i], w3[i], w4[i])),
            error_w: three(|i| off(a1[i], a2[i], a3[i], a4[i])),
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
        let matrix = resolvent(slope, h.plain() * GAMMA);
        let Phase { q, w } = self.phase;
        let zero = h.constant(0.0);
        // Slopes of the stages.
        let mut kq = [[zero; 3]; 4];
        let mut kw = [[zero; 3]; 4];
        let mut power = [zero; 4];
        for stage in 0..4 {
            let (here, acceleration) = if stage == 0 {
                (w, self.acceleration)
            } else {
                let alpha = &ALPHA[stage - 1];
                // Y_i = y + h Σ α_ij k_j
                let sum = |k: &[[T; 3]; 4], i: usize| {
                    h * (k[0][i] * alpha[0] + k[1][i] * alpha[1] + k[2][i] * alpha[2])
                };
                let at = three(|i| w[i] + sum(&kw, i));
                let elapsed = h * (alpha[0] + alpha[1] + alpha[2]);
                (at, self.stage(field, &steer, elapsed, sum(&kq, 2), at).1)
            };
            power[stage] = acceleration.power;
            let gamma = if stage == 0 { &[0.0; 3] } else { &GAMMAS[stage - 1] };
            // g_i = Σ_{j<i} γ_ij k_j/γ
            let carried =
                three(|i| (kw[0][i] * gamma[0] + kw[1][i] * gamma[1] + kw[2][i] * gamma[2]) * (1.0 / GAMMA));
            // k_i = (1 − γhJ)⁻¹ (f(Y_i) + g_i) − g_i
            let [a, b, c] = three(|i| acceleration.rates[i] + carried[i]);
            kw[stage] = three(|i| {
                a.scaled(matrix[i][0]) + b.scaled(matrix[i][1]) + c.scaled(matrix[i][2]) - carried[i]
            });
            // For the places J is exactly 1: k_i = w_i + h Σ γ_ij k_j of the motion
            kq[stage] = three(|i| here[i] + h * (carried[i] + kw[stage][i]) * GAMMA);
        }
        let combine = |k: &[[T; 3]; 4], by: &[f64; 4], i: usize| {
            h * (k[0][i] * by[0] + k[1][i] * by[1] + k[2][i] * by[2] + k[3][i] * by[3])
        };
        let off = IMPLICIT_ERROR;
        let end = Phase {
            q: three(|i| q[i] + combine(&kq, &WEIGHTS, i)),
            w: three(|i| w[i] + combine(&kw, &WEIGHTS, i)),
        };
        let [p1, p2, p3, p4] = power;
        let work = h * (p1 * WEIGHTS[0] + p2 * WEIGHTS[1] + p3 * WEIGHTS[2] + p4 * WEIGHTS[3]);
        let error_of = |k: &[[T; 3]; 4], i: usize| {
            let [k1, k2, k3, k4] = [k[0][i].plain(), k[1][i].plain(), k[2][i].plain(), k[3][i].plain()];
            (h.plain() * (k1 * off[0] + k2 * off[1] + k3 * off[2] + k4 * off[3])).abs()
        };
        Step {
            end,
            there: None,
            work,
            error_q: three(|i| error_of(&kq, i)),
            error_w: three(|i| error_of(&kw, i)),
        }
    }
}
