//! Random collisions with one unknown speed, the same in every run.

use std::f64::consts::PI;

use oracle::scenes::{Car, Scene, is_brach};
use oracle::{approach, orientation};
use pim_core::{RestitutionCurve, Tangential, VehicleId};
use reconcile::{EnergyBasis, Problem, ReconcileError};

use crate::reconciliation::{posed, with_curve};

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
pub(crate) struct Draws(u64);

impl Draws {
    /// The sequence of case `index` for a seed: no case depends on the number of draws of another.
    pub(crate) fn new(seed: u64, index: u64) -> Self {
        let mut draws = Self(seed ^ index.wrapping_mul(0xD1B5_4A32_D192_ED03));
        draws.0 = draws.bits();
        draws
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        // The leading 52 bits as the mantissa of 1 + k·2⁻⁵².
        f64::from_bits(1.0_f64.to_bits() | (self.bits() >> 12)) - 1.0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Log-uniform.
    pub(crate) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// True with this probability.
    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % u64::try_from(count).unwrap()).unwrap()
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }
}

/// A collision in which one vehicle moves along its heading at an unknown speed, in plain numbers.
#[derive(Clone, Debug)]
pub(crate) struct Sought {
    /// The velocity of the vehicle whose speed is sought is not used, nor is the restitution if there is a
    /// curve.
    pub(crate) scene: Scene,
    /// (closing speed in m/s, e); empty if the restitution is the scene's.
    pub(crate) curve: Vec<(f64, f64)>,
    pub(crate) unknown: VehicleId,
    pub(crate) basis: EnergyBasis,
}

impl Sought {
    /// The program's result for a crush energy (J), which `look` extracts from the problem.
    pub(crate) fn ask<R>(
        &self,
        energy: f64,
        look: impl FnOnce(&Problem) -> Result<R, ReconcileError>,
    ) -> Result<R, ReconcileError> {
        let scene = &self.scene;
        let curve = (!self.curve.is_empty()).then(|| RestitutionCurve::new(self.curve.clone()).unwrap());
        let problem =
            posed(scene.contact(), scene.law(), scene.motions(), self.unknown, energy, self.basis).unwrap();
        match curve {
            Some(curve) => look(&with_curve(&problem, &curve)),
            None => look(&problem),
        }
    }

    /// e at a closing speed (m/s).
    pub(crate) fn restitution(&self, closing: f64) -> f64 {
        let (Some(&first), Some(&last)) = (self.curve.first(), self.curve.last()) else {
            return self.scene.restitution;
        };
        if closing <= first.0 {
            return first.1;
        }
        let pair = self.curve.windows(2).find(|pair| closing <= pair[1].0);
        // e = e_a (1 − w) + e_b w,  w = (v − v_a)/(v_b − v_a)
        pair.map_or(last.1, |pair| {
            let share = (closing - pair[0].0) / (pair[1].0 - pair[0].0);
            pair[0].1 * (1.0 - share) + pair[1].1 * share
        })
    }

    /// The collision at a speed (m/s), with the restitution there.
    pub(crate) fn at(&self, speed: f64) -> Scene {
        let scene = self.scene.at_speed(self.unknown.index(), speed);
        Scene { restitution: self.restitution(-approach(&scene)[0]), ..scene }
    }
}

/// Any valid collision: every law, with and without moment impulse, curve, barrier and yaw.
pub(crate) fn sought(draws: &mut Draws) -> Sought {
    loop {
        let mut scene = scene(draws);
        let barrier = draws.chance(0.2).then(|| draws.below(2));
        if let Some(i) = barrier {
            scene.cars[i] = Car { fixed: true, velocity: [0.0; 2], yaw_rate: 0.0, ..scene.cars[i] };
        }
        let moving = barrier.map_or_else(|| draws.below(2), |i| 1 - i);
        let unknown = [VehicleId::One, VehicleId::Two][moving];
        let basis = [EnergyBasis::Dissipated, EnergyBasis::Absorbed][draws.below(2)];
        let curve = if draws.chance(0.5) { curve(draws) } else { Vec::new() };
        // The component along the normal of a speed of 1 m/s along the heading.
        let slope = approach(&scene.at_speed(moving, 1.0))[0] - approach(&scene.at_speed(moving, 0.0))[0];
        if orientation(&scene) > 1e-3 && slope.abs() > 0.02 {
            return Sought { scene, curve, unknown, basis };
        }
    }
}

fn scene(draws: &mut Draws) -> Scene {
    let cars = [car(draws), car(draws)];
    let tangential = tangential(draws);
    let moment = if is_brach(&tangential) && draws.chance(0.5) {
        match draws.below(8) {
            0 => 0.0,
            1 => 1.0,
            _ => draws.between(-1.0, 1.0),
        }
    } else {
        -1.0
    };
    let restitution = if draws.chance(0.2) { 0.0 } else { draws.between(0.0, 0.95) };
    Scene { cars, crush_plane: draws.between(-PI, PI), restitution, tangential, moment }
}

fn car(draws: &mut Draws) -> Car {
    let mass =
        if draws.chance(0.7) { draws.between(700.0, 4000.0) } else { draws.log_between(500.0, 40_000.0) };
    let reach = if draws.chance(0.7) { 2.5 } else { 4.0 };
    let (forward, left) = (draws.between(-reach, reach), draws.between(-reach, reach));
    let (speed, course) = (draws.between(0.0, 60.0), draws.between(-PI, PI));
    Car {
        fixed: false,
        mass,
        yaw_radius: if draws.chance(0.7) { draws.between(1.0, 2.0) } else { draws.between(0.5, 4.0) },
        heading: draws.between(-PI, PI),
        distance: forward.hypot(left),
        angle: left.atan2(forward),
        velocity: if draws.chance(0.15) { [0.0; 2] } else { [speed * course.cos(), speed * course.sin()] },
        yaw_rate: if draws.chance(0.4) { 0.0 } else { draws.between(-6.0, 6.0) },
    }
}

fn tangential(draws: &mut Draws) -> Tangential {
    let limit = |draws: &mut Draws| match draws.below(8) {
        0 => 0.0,
        1 => draws.log_between(1e-3, 3.0),
        _ => draws.between(0.05, 1.5),
    };
    match draws.below(10) {
        0 => Tangential::Critical,
        1 => Tangential::Ratio(if draws.chance(0.1) { 0.0 } else { draws.between(-1.5, 1.5) }),
        2 | 3 => Tangential::FractionOfCritical(match draws.below(8) {
            0 => 0.0,
            1 => 1.0,
            _ => draws.between(0.0, 1.0),
        }),
        4 | 5 => Tangential::Friction(limit(draws)),
        6 => Tangential::VelocityChange(draws.between(-20.0, 20.0)),
        7 => Tangential::Restitution(match draws.below(6) {
            0 => 0.0,
            1 => -1.0,
            _ => draws.between(-1.0, 1.0),
        }),
        _ => Tangential::FullOrSliding(limit(draws)),
    }
}

/// One to eight points: falling, zigzag, with values of 1, or close together.
fn curve(draws: &mut Draws) -> Vec<(f64, f64)> {
    let (kind, count) = (draws.below(4), 1 + draws.below(8));
    let mut speed = if draws.chance(0.1) { 0.0 } else { draws.between(0.1, 20.0) };
    let mut e = draws.between(0.2, 0.9);
    let mut points = Vec::new();
    for _ in 0..count {
        points.push((speed, e));
        speed += if kind == 3 { draws.log_between(1e-4, 1.0) } else { draws.log_between(0.3, 15.0) };
        e = match kind {
            0 => e * draws.between(0.3, 1.0),
            2 if draws.chance(0.3) => 1.0,
            _ => draws.between(0.0, 0.97),
        };
    }
    points
}
