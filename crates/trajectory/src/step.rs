//! One step of the integration: a linearly implicit Runge–Kutta method of order 3.
//!
//! Tyres stiffen as the vehicle slows: the rates with which a rolling vehicle straightens are about 9g/u. An
//! explicit method then takes hundreds of steps to the rest. This one is L-stable, and as a W-method keeps
//! its order with a rough matrix of derivatives.

use real::Real;

use crate::field::{Acceleration, Field, resolvent};
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

/// Place and motion as the integration has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase<T> {
    /// (m, m, rad) x, y, ψ.
    pub(crate) q: [T; 3],
    /// (m/s, m/s, rad/s) v_x, v_y, ω.
    pub(crate) w: [T; 3],
}

/// Where a step leads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<T> {
    pub(crate) end: Phase<T>,
    /// (J/kg) work of the tyres' forces, negative.
    pub(crate) work: T,
    /// (m, m, rad) estimated error of x, y, ψ.
    pub(crate) error_q: [f64; 3],
    /// (m/s, m/s, rad/s) estimated error of v_x, v_y, ω.
    pub(crate) error_w: [f64; 3],
}

/// The steering, with what can be computed once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Steering<'a, T, G> {
    Held((T, T)),
    Over(Steer<'a, G>),
}

impl<'a, T: Real + From<G>, G: Real> Steering<'a, T, G> {
    pub(crate) fn new(steer: Steer<'a, G>) -> Self {
        match steer {
            Steer::Held(angle) => Self::Held(T::from(angle).sin_cos()),
            Steer::Over(_) => Self::Over(steer),
        }
    }

    /// (sin, cos) of the steer angle at a time (s).
    #[inline(always)]
    pub(crate) fn at(&self, time: T) -> (T, T) {
        match self {
            Self::Held(sin_cos) => *sin_cos,
            Self::Over(steer) => steer.angle(time).sin_cos(),
        }
    }
}

/// Where a step begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<T> {
    pub(crate) time: T,
    pub(crate) phase: Phase<T>,
    pub(crate) acceleration: Acceleration<T>,
    /// (1/s) the derivatives of the accelerations by (v_x, v_y, ω), roughly.
    pub(crate) slope: [[f64; 3]; 3],
}

/// A step of the length `h` (s).
#[inline]
pub(crate) fn step<T: Real + From<G>, G: Real>(
    field: &Field<T>,
    steering: &Steering<'_, T, G>,
    start: &Start<T>,
    h: T,
) -> Step<T> {
    let matrix = resolvent(start.slope, h.value() * GAMMA);
    let Phase { q, w } = start.phase;
    // Slopes of the stages.
    let mut kq = [[T::ZERO; 3]; 4];
    let mut kw = [[T::ZERO; 3]; 4];
    let mut power = [T::ZERO; 4];
    for stage in 0..4 {
        let (here, acceleration) = if stage == 0 {
            (w, start.acceleration)
        } else {
            let alpha = &ALPHA[stage - 1];
            // Y_i = y + h Σ α_ij k_j
            let sum = |of: T, k: &[[T; 3]; 4], i: usize| {
                of + h * (k[0][i] * alpha[0] + k[1][i] * alpha[1] + k[2][i] * alpha[2])
            };
            let at = [sum(w[0], &kw, 0), sum(w[1], &kw, 1), sum(w[2], &kw, 2)];
            let heading = sum(q[2], &kq, 2).sin_cos();
            let steer = steering.at(start.time + h * (alpha[0] + alpha[1] + alpha[2]));
            (at, field.acceleration(heading, at, steer))
        };
        power[stage] = acceleration.power;
        let gamma = if stage == 0 { &[0.0; 3] } else { &GAMMAS[stage - 1] };
        // g_i = Σ_{j<i} γ_ij k_j/γ
        let carried =
            |i: usize| (kw[0][i] * gamma[0] + kw[1][i] * gamma[1] + kw[2][i] * gamma[2]) * (1.0 / GAMMA);
        let carried = [carried(0), carried(1), carried(2)];
        // k_i = (1 − γhJ)⁻¹ (f(Y_i) + g_i) − g_i
        let [a, b, c] = [0, 1, 2].map(|i| acceleration.rates[i] + carried[i]);
        kw[stage] = [0, 1, 2].map(|i| a * matrix[i][0] + b * matrix[i][1] + c * matrix[i][2] - carried[i]);
        // For the places J is exactly 1: k_i = w_i + h Σ γ_ij k_j of the motion
        kq[stage] = [0, 1, 2].map(|i| here[i] + h * (carried[i] + kw[stage][i]) * GAMMA);
    }
    let combine = |k: &[[T; 3]; 4], by: &[f64; 4], i: usize| {
        h * (k[0][i] * by[0] + k[1][i] * by[1] + k[2][i] * by[2] + k[3][i] * by[3])
    };
    let off: [f64; 4] = [0, 1, 2, 3].map(|i| WEIGHTS[i] - EMBEDDED[i]);
    let end = Phase {
        q: [0, 1, 2].map(|i| q[i] + combine(&kq, &WEIGHTS, i)),
        w: [0, 1, 2].map(|i| w[i] + combine(&kw, &WEIGHTS, i)),
    };
    let work =
        h * (power[0] * WEIGHTS[0] + power[1] * WEIGHTS[1] + power[2] * WEIGHTS[2] + power[3] * WEIGHTS[3]);
    let error_of = |k: &[[T; 3]; 4], i: usize| {
        let sum = k[0][i].value() * off[0]
            + k[1][i].value() * off[1]
            + k[2][i].value() * off[2]
            + k[3][i].value() * off[3];
        (h.value() * sum).abs()
    };
    Step {
        end,
        work,
        error_q: [0, 1, 2].map(|i| error_of(&kq, i)),
        error_w: [0, 1, 2].map(|i| error_of(&kw, i)),
    }
}
