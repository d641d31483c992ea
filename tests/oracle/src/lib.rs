//! An independent brute-force solution of the equations of impulse and momentum, in scene coordinates.
//!
//! Nine unknowns, V₁x V₁y Ω₁ V₂x V₂y Ω₂ Px Py M, and nine equations: linear and angular momentum of each
//! vehicle, one normal and one tangential condition, and one on the moment impulse. Nothing here uses the
//! matrix K or the ratio μ_c, except the estimate of rounding.
//!
//! [`scenes`] draws random collisions for it, the same in every run; `PROPTEST_RNG_SEED=2 cargo test` draws
//! others. The tests of an engine are in its own `tests` and use both.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]
#![allow(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]
#![allow(missing_docs, reason = "symbols of theory.md")]

pub mod compare;
pub mod field;
pub mod scenes;
pub mod written;

use std::f64::consts::PI;

use pim_core::{Outcome, Tangential, Vector2};

use compare::{assert_close, assert_direction};
use scenes::{Car, Scene};

type Vector = [f64; 2];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Vector from the CG to C in the scene.
pub fn arm(car: &Car) -> Vector {
    let direction = car.heading + car.angle;
    [car.distance * direction.cos(), car.distance * direction.sin()]
}

/// n from vehicle 2 towards vehicle 1, and t at +90° to it.
fn axes(scene: &Scene) -> [Vector; 2] {
    let n = [scene.crush_plane.cos(), scene.crush_plane.sin()];
    let sign = if along_normal(scene) > 0.0 { 1.0 } else { -1.0 };
    let n = n.map(|x| sign * x);
    [n, [-n[1], n[0]]]
}

fn along_normal(scene: &Scene) -> f64 {
    let [r1, r2] = scene.cars.map(|car| arm(&car));
    dot([scene.crush_plane.cos(), scene.crush_plane.sin()], [r2[0] - r1[0], r2[1] - r1[1]])
}

/// (m) distance of the CGs along the normal.
pub fn orientation(scene: &Scene) -> f64 {
    along_normal(scene).abs()
}

/// u along n and t.
pub fn approach(scene: &Scene) -> Vector {
    let [a, b] = scene.cars.map(|car| {
        let r = arm(&car);
        [car.velocity[0] - car.yaw_rate * r[1], car.velocity[1] + car.yaw_rate * r[0]]
    });
    axes(scene).map(|axis| dot(axis, [a[0] - b[0], a[1] - b[1]]))
}

/// The tangential condition of one solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    /// U_t = 0.
    CommonTangential,
    /// P_t = μ P_n.
    Ratio(f64),
    /// U_t − u_t = Δ.
    Change(f64),
    /// U_t = −e_t u_t.
    Restitution(f64),
    /// P = −(1+ε) K⁻¹ u in both components, the normal one too: 1+ε times the impulse that leaves U = 0.
    Full,
}

/// The condition on the moment impulse of one solve.
#[derive(Clone, Copy, Debug)]
enum MomentCondition {
    /// M given.
    Given(f64),
    /// Ω₁ = Ω₂.
    CommonYaw,
}

/// All results of an impact, in plain numbers.
#[derive(Clone, Copy, Debug)]
pub struct Effects {
    /// Along n and t, like the next two.
    pub impulse: Vector,
    pub approach: Vector,
    pub separation: Vector,
    pub impulse_vector: Vector,
    pub velocities: [Vector; 2],
    pub yaw_rates: [f64; 2],
    pub delta_v: [Vector; 2],
    pub ratio: f64,
    pub critical_ratio: Option<f64>,
    pub impulse_direction: f64,
    pub pdof: [f64; 2],
    pub energy_before: f64,
    pub energy_after: f64,
    pub loss: f64,
    pub normal_work: f64,
    pub tangential_work: f64,
    pub moment: f64,
    pub moment_work: f64,
}

impl From<&Outcome> for Effects {
    fn from(outcome: &Outcome) -> Self {
        let array = |v: Vector2<f64>| [v.x, v.y];
        Self {
            impulse: [outcome.impulse.normal, outcome.impulse.tangential],
            approach: [outcome.approach.normal, outcome.approach.tangential],
            separation: [outcome.separation.normal, outcome.separation.tangential],
            impulse_vector: array(outcome.impulse_vector),
            velocities: outcome.after.map(|motion| array(motion.velocity)),
            yaw_rates: outcome.after.map(|motion| motion.yaw_rate),
            delta_v: outcome.delta_v.map(array),
            ratio: outcome.impulse_ratio,
            critical_ratio: outcome.critical_impulse_ratio,
            impulse_direction: outcome.impulse_direction(),
            pdof: outcome.pdof(),
            energy_before: outcome.energy.before,
            energy_after: outcome.energy.after,
            loss: outcome.energy.loss,
            normal_work: outcome.energy.normal_work,
            tangential_work: outcome.energy.tangential_work,
            moment: outcome.moment_impulse,
            moment_work: outcome.energy.moment_work,
        }
    }
}

/// The result of a collision.
#[derive(Clone, Copy, Debug)]
pub enum Verdict {
    Impact(Effects),
    /// u_n ≥ 0.
    NotApproaching,
    /// P_t = μ P_n would need P_n ≤ 0.
    Jam,
    /// The conditions would need this P_n ≤ 0, but not because of a jam.
    Pulling(f64),
    /// The kinetic energy would rise.
    EnergyCreated(Effects),
}

/// (m/s) the speeds at which a work (J; `None` without an impact) equals the energy (J): a scan in steps of
/// 0.1 m/s up to `fastest` (m/s) in both directions, and bisection.
pub fn scanned(work: &dyn Fn(f64) -> Option<f64>, energy: f64, fastest: i32) -> Vec<f64> {
    let missing = |speed: f64| work(speed).map(|work| work - energy);
    // No step coincides with a likely speed of a scene.
    let speed = |step: i32| f64::from(step) * 0.1 + 0.0137;
    let mut found = Vec::new();
    for step in -10 * fastest..10 * fastest {
        let (mut low, mut high) = (speed(step), speed(step + 1));
        let (Some(a), Some(b)) = (missing(low), missing(high)) else { continue };
        if (a < 0.0) == (b < 0.0) {
            continue;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            match missing(middle) {
                Some(value) if (value < 0.0) == (a < 0.0) => low = middle,
                Some(_) => high = middle,
                None => break,
            }
        }
        // A jump of the work is not a root.
        if missing(low).is_some_and(|left| left.abs() < 1e-6 * energy) {
            found.push(low);
        }
    }
    found
}

/// Solves a·x = b by elimination with partial pivoting on rows scaled to 1.
fn eliminate<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> [f64; N] {
    for i in 0..N {
        let size = a[i].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        a[i] = a[i].map(|x| x / size);
        b[i] /= size;
    }
    for i in 0..N {
        let pivot = (i..N).max_by(|&p, &q| a[p][i].abs().total_cmp(&a[q][i].abs())).unwrap();
        a.swap(i, pivot);
        b.swap(i, pivot);
        for row in i + 1..N {
            let factor = a[row][i] / a[i][i];
            let from = a[i];
            for (entry, above) in a[row].iter_mut().zip(from).skip(i) {
                *entry -= factor * above;
            }
            b[row] -= factor * b[i];
        }
    }
    let mut x = [0.0; N];
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|column| a[i][column] * x[column]).sum();
        x[i] = (b[i] - known) / a[i][i];
    }
    x
}

/// (J) kinetic energy of a car with this motion.
pub fn kinetic_energy(car: &Car, velocity: Vector, yaw_rate: f64) -> f64 {
    if car.fixed {
        0.0
    } else {
        0.5 * car.mass * (dot(velocity, velocity) + (car.yaw_radius * yaw_rate).powi(2))
    }
}

/// The motion that satisfies U_n = −e u_n, the tangential condition and the moment's, whether or not a
/// collision can have it.
pub fn solve(scene: &Scene, condition: Condition) -> Effects {
    if scene.moment == -1.0 {
        return solve_with(scene, condition, MomentCondition::Given(0.0));
    }
    // M = (1 + e_m) M_c
    let common = solve_with(scene, condition, MomentCondition::CommonYaw).moment;
    solve_with(scene, condition, MomentCondition::Given((1.0 + scene.moment) * common))
}

fn solve_with(scene: &Scene, condition: Condition, moment: MomentCondition) -> Effects {
    let [c1, c2] = scene.cars;
    let [r1, r2] = [arm(&c1), arm(&c2)];
    let [n, t] = axes(scene);
    let u = approach(scene);
    // The velocity of vehicle 1 at C relative to vehicle 2 along an axis is linear in V₁x V₁y Ω₁ V₂x V₂y Ω₂.
    let relative = |axis: Vector| {
        [axis[0], axis[1], cross(r1, axis), -axis[0], -axis[1], -cross(r2, axis), 0.0, 0.0, 0.0]
    };
    let along = |[x, y]: Vector| [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, x, y, 0.0];
    // The unit of the impulse, chosen so that all columns have the same order of magnitude.
    let unit = 1.0 / (c1.inverse_mass() + c2.inverse_mass());
    let [w1, w2] = [c1.inverse_mass() * unit, c2.inverse_mass() * unit];
    let [j1, j2] = [c1.inverse_yaw_inertia() * unit, c2.inverse_yaw_inertia() * unit];
    let (mut normal, mut normal_value) = (relative(n), -scene.restitution * u[0]);
    let (tangential, tangential_value) = match condition {
        Condition::CommonTangential => (relative(t), 0.0),
        Condition::Ratio(mu) => (along([t[0] - mu * n[0], t[1] - mu * n[1]]), 0.0),
        Condition::Change(change) => (relative(t), u[1] + change),
        Condition::Restitution(e_t) => (relative(t), -e_t * u[1]),
        Condition::Full => {
            let plastic = Scene { restitution: 0.0, ..*scene };
            let p = solve_with(&plastic, Condition::CommonTangential, moment).impulse;
            let [p_n, p_t] = p.map(|p| (1.0 + scene.restitution) * p / unit);
            (normal, normal_value) = (along(n), p_n);
            (along(t), p_t)
        }
    };
    let (turning, turning_value) = match moment {
        MomentCondition::Given(moment) => ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], moment / unit),
        MomentCondition::CommonYaw => ([0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0], 0.0),
    };
    let equations = [
        // V₁ − P/m₁ = v₁,  Ω₁ − (r₁×P + M)/I₁ = ω₁
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -w1, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -w1, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, r1[1] * j1, -r1[0] * j1, -j1],
        // V₂ + P/m₂ = v₂,  Ω₂ + (r₂×P + M)/I₂ = ω₂
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, w2, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, w2, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -r2[1] * j2, r2[0] * j2, j2],
        normal,
        tangential,
        turning,
    ];
    let right = [
        c1.velocity[0],
        c1.velocity[1],
        c1.yaw_rate,
        c2.velocity[0],
        c2.velocity[1],
        c2.yaw_rate,
        normal_value,
        tangential_value,
        turning_value,
    ];
    let [v1x, v1y, o1, v2x, v2y, o2, px, py, m] = eliminate(equations, right);
    let p = [px * unit, py * unit];
    let after = [v1x, v1y, o1, v2x, v2y, o2, 0.0, 0.0, 0.0];
    let separation = [n, t].map(|axis| relative(axis).iter().zip(after).map(|(a, x)| a * x).sum());
    let velocities = [[v1x, v1y], [v2x, v2y]];
    let yaw_rates = [o1, o2];
    let impulse = [dot(p, n), dot(p, t)];
    // The force on vehicle 1 comes from the direction of −P, that on vehicle 2 from the direction of P.
    let from = [(-p[1]).atan2(-p[0]), p[1].atan2(p[0])];
    let energy_before =
        scene.cars.iter().map(|car| kinetic_energy(car, car.velocity, car.yaw_rate)).sum::<f64>();
    let energy_after =
        (0..2).map(|i| kinetic_energy(&scene.cars[i], velocities[i], yaw_rates[i])).sum::<f64>();
    // Kelvin: the impulse times the mean velocity of its point of application before and after.
    let work = |i: usize| -0.5 * impulse[i] * (u[i] + separation[i]);
    let moment = m * unit;
    Effects {
        impulse,
        approach: u,
        separation,
        impulse_vector: p,
        velocities,
        yaw_rates,
        delta_v: [0, 1].map(|i| {
            [velocities[i][0] - scene.cars[i].velocity[0], velocities[i][1] - scene.cars[i].velocity[1]]
        }),
        ratio: impulse[1] / impulse[0],
        critical_ratio: None,
        impulse_direction: p[1].atan2(p[0]),
        pdof: [0, 1].map(|i| clockwise(scene.cars[i].heading - from[i])),
        energy_before,
        energy_after,
        loss: energy_before - energy_after,
        normal_work: work(0),
        tangential_work: work(1),
        moment,
        moment_work: -0.5 * moment * (c1.yaw_rate - c2.yaw_rate + o1 - o2),
    }
}

/// An angle in (−π, π].
fn clockwise(angle: f64) -> f64 {
    PI - (PI - angle).rem_euclid(2.0 * PI)
}

/// Coulomb's law with the coefficient `limit`: the surfaces stick if friction can hold them, else they slide
/// and friction opposes that. Returns the condition that holds, and the motion.
pub fn coulomb(scene: &Scene, limit: f64) -> Option<(Condition, Effects)> {
    let sticking = solve(scene, Condition::CommonTangential);
    if sticking.impulse[0] > 0.0 && sticking.impulse[1].abs() <= limit * sticking.impulse[0] {
        return Some((Condition::CommonTangential, sticking));
    }
    if scene.moment != -1.0 {
        // With part of a moment impulse the answer is a mixture of two, for which only the direction without
        // friction is defined.
        return Some(sliding(scene, limit));
    }
    [limit, -limit].into_iter().map(Condition::Ratio).find_map(|condition| {
        let sliding = solve(scene, condition);
        // Without friction P_t is a rounding error of either sign.
        let opposes = limit == 0.0 || sliding.impulse[1] * sliding.separation[1] <= 0.0;
        (sliding.impulse[0] > 0.0 && opposes).then_some((condition, sliding))
    })
}

/// Sliding with |P_t| = `limit` P_n, against the tangential velocity after a frictionless impact.
fn sliding(scene: &Scene, limit: f64) -> (Condition, Effects) {
    let without_friction = solve(scene, Condition::Ratio(0.0)).separation[1];
    let condition = Condition::Ratio(if without_friction > 0.0 { -limit } else { limit });
    (condition, solve(scene, condition))
}

/// Kudlich and Slibar's law with ε = e: the full impact if friction allows it, else sliding. Returns the
/// condition that holds, and the motion.
pub fn kudlich_slibar(scene: &Scene, limit: f64) -> (Condition, Effects) {
    let full = solve(scene, Condition::Full);
    if full.impulse[0] > 0.0 && full.impulse[1].abs() <= limit * full.impulse[0] {
        return (Condition::Full, full);
    }
    sliding(scene, limit)
}

/// The result of the collision under the scene's law.
pub fn verdict(scene: &Scene) -> Verdict {
    if approach(scene)[0] >= 0.0 {
        return Verdict::NotApproaching;
    }
    let sticking = solve(scene, Condition::CommonTangential);
    let pushes = sticking.impulse[0] > 0.0;
    let under = |condition| (condition, solve(scene, condition));
    let (condition, effects) = match scene.tangential {
        // Without friction, whatever μ_c is.
        Tangential::FractionOfCritical(0.0) => under(Condition::Ratio(0.0)),
        Tangential::FractionOfCritical(_) if !pushes => return Verdict::Pulling(sticking.impulse[0]),
        Tangential::Critical => (Condition::CommonTangential, sticking),
        Tangential::Ratio(mu) => under(Condition::Ratio(mu)),
        Tangential::FractionOfCritical(f) => under(Condition::Ratio(f * sticking.ratio)),
        Tangential::Friction(limit) => match coulomb(scene, limit) {
            Some(answer) => answer,
            None => return Verdict::Jam,
        },
        Tangential::VelocityChange(change) => under(Condition::Change(change)),
        Tangential::Restitution(e_t) => under(Condition::Restitution(e_t)),
        Tangential::FullOrSliding(limit) => kudlich_slibar(scene, limit),
    };
    let effects = Effects { critical_ratio: pushes.then_some(sticking.ratio), ..effects };
    if !(effects.impulse[0] > 0.0 && effects.impulse[0].is_finite()) {
        // A jam also occurs without a moment impulse.
        let plain = solve(&scene.without_moment(), condition).impulse[0];
        if matches!(condition, Condition::Ratio(_)) && !(plain > 0.0 && plain.is_finite()) {
            Verdict::Jam
        } else {
            Verdict::Pulling(effects.impulse[0])
        }
    } else if effects.loss < 0.0 {
        Verdict::EnergyCreated(effects)
    } else {
        Verdict::Impact(effects)
    }
}

/// The scale of comparison of each output: its natural size, times the growth of rounding due to the
/// geometry.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    pub velocity: f64,
    pub impulse: f64,
    pub yaw_rates: [f64; 2],
    pub ratio: f64,
    pub critical_ratio: f64,
    pub direction: f64,
    pub energy: f64,
    pub work: f64,
    pub moment: f64,
}

impl Scale {
    pub fn of(scene: &Scene, effects: &Effects) -> Self {
        let [c1, c2] = scene.cars;
        let [n, t] = axes(scene);
        let entry = |a: Vector, b: Vector| {
            [c1, c2]
                .iter()
                .map(|car| cross(arm(car), a) * cross(arm(car), b) * car.inverse_yaw_inertia())
                .sum::<f64>()
        };
        let translation = c1.inverse_mass() + c2.inverse_mass();
        let (nn, nt, tt) = (translation + entry(n, n), entry(n, t), translation + entry(t, t));
        let one_plus_e = 1.0 + scene.restitution;
        let u = approach(scene);
        // The relative velocity at C is a difference of terms of this size.
        let velocity: f64 = [c1, c2]
            .iter()
            .map(|car| car.velocity[0].hypot(car.velocity[1]) + (car.yaw_rate * car.distance).abs())
            .sum();
        let change =
            if let Tangential::VelocityChange(change) = scene.tangential { change.abs() } else { 0.0 };
        // μ_c is a quotient of two differences, whose denominator may be small compared with its terms.
        let critical = velocity * (one_plus_e * tt + nt.abs()) / (one_plus_e * u[0] * tt - u[1] * nt).abs();
        let critical_ratio = critical * (1.0 + nn / tt + effects.critical_ratio.unwrap_or(0.0).abs());
        let given = |mu: f64| (nn + (mu * nt).abs()) / (nn + mu * nt).abs();
        let sticks =
            effects.critical_ratio.is_some_and(|mu_c| (mu_c - effects.ratio).abs() <= 1e-6 * critical_ratio);
        let (growth, ratio) = match scene.tangential {
            Tangential::Critical => (nn * tt / (nn * tt - nt * nt), critical_ratio),
            Tangential::FractionOfCritical(f) if f != 0.0 => {
                (critical * given(effects.ratio), critical_ratio)
            }
            Tangential::Friction(_) if sticks => (critical * given(effects.ratio), critical_ratio),
            Tangential::Ratio(_) | Tangential::FractionOfCritical(_) | Tangential::Friction(_) => {
                (given(effects.ratio), 1.0 + effects.ratio.abs())
            }
            Tangential::FullOrSliding(limit) if (effects.ratio.abs() - limit).abs() <= 1e-9 * limit => {
                (given(effects.ratio), 1.0 + effects.ratio.abs())
            }
            Tangential::VelocityChange(_) | Tangential::Restitution(_) | Tangential::FullOrSliding(_) => {
                let growth = nn * tt / (nn * tt - nt * nt);
                let impulse = (velocity + change) / translation * growth * growth * (nn + tt) / translation;
                (growth, impulse / effects.impulse[0].abs() * (1.0 + effects.ratio.abs()))
            }
        };
        // The eigenvalues of K lie between 1/m₁ + 1/m₂ and k_nn + k_tt.
        let condition = (nn + tt) / translation;
        let impulse = (velocity + change) / translation * growth * growth * condition;
        let turns = Turning::of(scene, effects, [nn, nt, tt], impulse);
        let impulse = impulse + turns.impulse * growth * condition;
        let (ratio, critical_ratio) = (ratio * turns.growth, critical_ratio * turns.critical_growth);
        let yaw = |car: &Car| {
            velocity / car.yaw_radius + (impulse * car.distance + turns.moment) * car.inverse_yaw_inertia()
        };
        let yaw_rates = [yaw(&c1), yaw(&c2)];
        let after = |car: &Car| velocity + impulse * car.inverse_mass();
        Self {
            velocity: after(&c1).max(after(&c2)),
            impulse,
            yaw_rates,
            ratio,
            critical_ratio,
            direction: impulse / effects.impulse[0].hypot(effects.impulse[1]),
            energy: [c1, c2]
                .iter()
                .zip(yaw_rates)
                .map(|(car, yaw)| kinetic_energy(car, [after(car), 0.0], yaw))
                .sum(),
            work: impulse * (velocity + impulse * (nn + tt)) + turns.moment * (yaw_rates[0] + yaw_rates[1]),
            moment: turns.moment,
        }
    }

    /// The larger of each scale, for a comparison of two collisions.
    pub fn max(self, other: Self) -> Self {
        Self {
            velocity: self.velocity.max(other.velocity),
            impulse: self.impulse.max(other.impulse),
            yaw_rates: [0, 1].map(|i| self.yaw_rates[i].max(other.yaw_rates[i])),
            ratio: self.ratio.max(other.ratio),
            critical_ratio: self.critical_ratio.max(other.critical_ratio),
            direction: self.direction.max(other.direction),
            energy: self.energy.max(other.energy),
            work: self.work.max(other.work),
            moment: self.moment.max(other.moment),
        }
    }
}

/// The contribution of a moment impulse to a [`Scale`].
struct Turning {
    /// (N·m·s) size of the moment impulse.
    moment: f64,
    /// (N·s) size of the impulse that maintains the conditions with it.
    impulse: f64,
    /// Growth of rounding in μ, and in μ_c.
    growth: f64,
    critical_growth: f64,
}

impl Turning {
    fn of(scene: &Scene, effects: &Effects, [nn, nt, tt]: [f64; 3], impulse: f64) -> Self {
        if scene.moment == -1.0 {
            return Self { moment: 0.0, impulse: 0.0, growth: 1.0, critical_growth: 1.0 };
        }
        let axes = axes(scene);
        let mm: f64 = scene.cars.iter().map(Car::inverse_yaw_inertia).sum();
        let [nm, tm] = axes.map(|axis| {
            scene.cars.iter().map(|car| cross(arm(car), axis) * car.inverse_yaw_inertia()).sum::<f64>()
        });
        let det = nn * tt - nt * nt;
        let common = [(nt * tm - tt * nm) / det, (nt * nm - nn * tm) / det];
        let slides = match scene.tangential {
            Tangential::Critical => false,
            Tangential::Friction(limit) => (effects.ratio.abs() - limit).abs() <= 1e-9 * limit,
            _ => true,
        };
        let p_n = -nm / (nn + effects.ratio * nt);
        let kept = if slides { [p_n, effects.ratio * p_n] } else { common };
        let left = |kept: Vector| (mm + nm * kept[0] + tm * kept[1]).abs();
        let growth = |kept: Vector| (mm + (nm * kept[0]).abs() + (tm * kept[1]).abs()) / left(kept);
        let spin =
            scene.cars.iter().map(|car| car.yaw_rate.abs()).sum::<f64>() + (nm.abs() + tm.abs()) * impulse;
        let size = |kept: Vector| (1.0 + scene.moment) * spin / left(kept) * growth(kept);
        let linear = |kept: Vector| size(kept) * (kept[0].abs() + kept[1].abs());
        let share = |kept: Vector, p_n: f64| {
            growth(kept) * (1.0 + linear(kept) / impulse) * (1.0 + impulse / p_n.abs())
        };
        Self {
            moment: size(kept),
            impulse: linear(kept),
            growth: share(kept, effects.impulse[0]),
            critical_growth: share(common, solve(scene, Condition::CommonTangential).impulse[0]),
        }
    }
}

/// Asserts that all outputs agree within `tolerance` relative to their scale.
#[track_caller]
pub fn assert_same(actual: &Effects, expected: &Effects, scale: &Scale, tolerance: f64) {
    let pair = |what: &str, actual: Vector, expected: Vector, scale: f64| {
        for i in 0..2 {
            assert_close(what, actual[i], expected[i], scale * tolerance);
        }
    };
    pair("impulse", actual.impulse, expected.impulse, scale.impulse);
    pair("impulse vector", actual.impulse_vector, expected.impulse_vector, scale.impulse);
    pair("approach", actual.approach, expected.approach, scale.velocity);
    pair("separation", actual.separation, expected.separation, scale.velocity);
    for i in 0..2 {
        pair("velocity", actual.velocities[i], expected.velocities[i], scale.velocity);
        pair("delta-V", actual.delta_v[i], expected.delta_v[i], scale.velocity);
        assert_close("yaw rate", actual.yaw_rates[i], expected.yaw_rates[i], scale.yaw_rates[i] * tolerance);
        // The direction of an impulse is lost if the impulse is.
        if scale.direction * tolerance < 0.1 {
            assert_direction("PDOF", actual.pdof[i], expected.pdof[i], scale.direction * tolerance);
        }
        assert!(actual.pdof[i] > -PI && actual.pdof[i] <= PI, "PDOF {}", actual.pdof[i]);
    }
    if scale.direction * tolerance < 0.1 {
        assert_direction(
            "impulse direction",
            actual.impulse_direction,
            expected.impulse_direction,
            scale.direction * tolerance,
        );
    }
    assert_close("M", actual.moment, expected.moment, scale.moment * tolerance);
    assert_close("W_m", actual.moment_work, expected.moment_work, scale.work * tolerance);
    assert_close("μ", actual.ratio, expected.ratio, scale.ratio * tolerance);
    match (actual.critical_ratio, expected.critical_ratio) {
        (Some(actual), Some(expected)) => {
            assert_close("μ_c", actual, expected, scale.critical_ratio * tolerance);
        }
        (None, None) => {}
        (actual, expected) => panic!("μ_c: {actual:?} is not {expected:?}"),
    }
    assert_close("T", actual.energy_before, expected.energy_before, scale.energy * tolerance);
    assert_close("T′", actual.energy_after, expected.energy_after, scale.energy * tolerance);
    assert_close("E_L", actual.loss, expected.loss, (scale.energy + scale.work) * tolerance);
    assert_close("W_n", actual.normal_work, expected.normal_work, scale.work * tolerance);
    assert_close("W_t", actual.tangential_work, expected.tangential_work, scale.work * tolerance);
}

/// If the change of energy is less than this fraction of its scale, rounding decides whether the coefficients
/// create energy.
pub const ENERGY_UNDECIDED: f64 = 1e-12;
