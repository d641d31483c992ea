//! The accelerations of a vehicle by its motion.

use real::Real;

use crate::chassis::Chassis;
use crate::ground::Ground;
use crate::tyre::{self, FADING};

/// (m/s²) standard gravity (ISO 80000-3).
pub const GRAVITY: f64 = 9.806_65;

/// A wheel on its ground.
#[derive(Clone, Copy, Debug)]
struct Footing<T> {
    /// (m) from the CG.
    forward: T,
    left: T,
    /// (m/s²) what its load would accelerate the vehicle with.
    load: T,
    /// (–)
    drag: T,
    friction: T,
    steered: bool,
}

/// A vehicle on its ground, by its mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<T> {
    wheels: [Footing<T>; 4],
    /// (m/s²) along the plane, downhill.
    pub(crate) gravity: [T; 2],
    /// (1/m²) m/I.
    inverse_radius_squared: T,
    /// (m²) k² = I/m.
    pub(crate) radius_squared: T,
}

/// What the forces do at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Acceleration<T> {
    /// (m/s², m/s², rad/s²) rates of (v_x, v_y, ω).
    pub(crate) rates: [T; 3],
    /// (W/kg) power of the tyres' forces, negative.
    pub(crate) power: T,
    pub(crate) sliding: [bool; 4],
}

impl<T: Real> Field<T> {
    /// The wheels on level ground without friction, until [`stand`](Self::stand) says on which zones they
    /// are.
    pub(crate) fn new<G: Real>(chassis: &Chassis<T>, ground: &Ground<'_, G>) -> Self
    where
        T: From<G>,
    {
        let grade: [T; 2] = [ground.grade.x.into(), ground.grade.y.into()];
        // cos θ = 1/√(1 + |G|²), and the pull along the plane is g sin θ = g |G| cos θ
        let cos = T::ONE / (grade[0] * grade[0] + grade[1] * grade[1] + 1.0).sqrt();
        let normal = cos * GRAVITY;
        let wheels = chassis.wheels().map(|wheel| Footing {
            forward: wheel.forward,
            left: wheel.left,
            load: wheel.load * normal,
            drag: wheel.drag,
            friction: ground.friction.into(),
            steered: wheel.steered,
        });
        let body = chassis.body();
        Self {
            wheels,
            gravity: [-(grade[0] * normal), -(grade[1] * normal)],
            inverse_radius_squared: body.mass() * body.inverse_yaw_inertia(),
            radius_squared: body.yaw_inertia() * body.inverse_mass(),
        }
    }

    /// Puts each wheel on the zone of this number.
    pub(crate) fn stand<G: Real>(&mut self, ground: &Ground<'_, G>, zones: [usize; 4])
    where
        T: From<G>,
    {
        for (wheel, zone) in self.wheels.iter_mut().zip(zones) {
            wheel.friction = ground.friction_in(zone).into();
        }
    }

    /// (–) friction under each wheel.
    pub(crate) fn friction(&self) -> [T; 4] {
        self.wheels.map(|wheel| wheel.friction)
    }

    /// (m/s²) what the wheels hold at rest against a pull along the vehicle's axis, and against one in any
    /// direction.
    pub(crate) fn hold(&self) -> [f64; 2] {
        self.wheels.iter().fold([0.0; 2], |[rolling, sliding], wheel| {
            let (load, friction) = (wheel.load.value(), wheel.friction.value());
            [rolling + load * Real::min(wheel.drag.value(), friction), sliding + load * friction]
        })
    }

    /// (m²/s²) twice the kinetic energy by the mass.
    #[inline(always)]
    pub(crate) fn energy(&self, w: [T; 3]) -> T {
        self.product(w, w)
    }

    /// The product of two motions that gives twice the kinetic energy of one by the mass.
    #[inline(always)]
    pub(crate) fn product(&self, a: [T; 3], b: [T; 3]) -> T {
        // v·v′ + k² ω ω′
        a[0] * b[0] + a[1] * b[1] + self.radius_squared * a[2] * b[2]
    }

    /// The accelerations at a heading, given as its (sin, cos), with the motion `w` = (v_x, v_y, ω) and the
    /// steer angle, given as its (sin, cos).
    #[inline(always)]
    pub(crate) fn acceleration(&self, heading: (T, T), w: [T; 3], steer: (T, T)) -> Acceleration<T> {
        let (sin, cos) = heading;
        let [vx, vy, omega] = w;
        // The motion in the vehicle's own axes.
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        // V² = v² + k² ω²
        let fading_speed = self.energy(w).sqrt() * FADING;
        let (mut forward, mut left, mut moment) = (T::ZERO, T::ZERO, T::ZERO);
        let mut sliding = [false; 4];
        for (wheel, sliding) in self.wheels.iter().zip(&mut sliding) {
            // v_w = v + ω × r
            let (u, v) = (u - omega * wheel.left, v + omega * wheel.forward);
            let (sin, cos) = if wheel.steered { steer } else { (T::ZERO, T::ONE) };
            let grip =
                tyre::grip(u * cos + v * sin, v * cos - u * sin, wheel.friction, wheel.drag, fading_speed);
            let fx = (grip.forward * cos - grip.left * sin) * wheel.load;
            let fy = (grip.forward * sin + grip.left * cos) * wheel.load;
            forward += fx;
            left += fy;
            // M = r × F
            moment += fy * wheel.forward - fx * wheel.left;
            *sliding = grip.sliding;
        }
        // P = F·v + M ω
        let power = forward * u + left * v + moment * omega;
        let rates = [
            forward * cos - left * sin + self.gravity[0],
            forward * sin + left * cos + self.gravity[1],
            moment * self.inverse_radius_squared,
        ];
        Acceleration { rates, power, sliding }
    }

    /// How the accelerations change with (v_x, v_y, ω): a matrix of plain numbers, roughly.
    #[inline(always)]
    pub(crate) fn slope(&self, heading: (T, T), w: [T; 3], steer: (T, T)) -> Matrix {
        let (sin, cos) = (heading.0.value(), heading.1.value());
        let [vx, vy, omega] = w.map(Real::value);
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let fading_speed = Real::sqrt(self.energy(w).value()) * FADING;
        let inverse_radius_squared = self.inverse_radius_squared.value();
        let mut body = [[0.0; 3]; 3];
        for wheel in &self.wheels {
            let (ahead, aside) = (wheel.forward.value(), wheel.left.value());
            let (u, v) = (u - omega * aside, v + omega * ahead);
            let (s, c) = if wheel.steered { (steer.0.value(), steer.1.value()) } else { (0.0, 1.0) };
            let [[uu, uv], [vu, vv]] = tyre::slope(
                u * c + v * s,
                v * c - u * s,
                wheel.friction.value(),
                wheel.drag.value(),
                fading_speed,
            );
            // From the wheel's axes to the vehicle's: R D Rᵀ.
            let load = wheel.load.value();
            let (across, turned) = (uv + vu, uu - vv);
            let xx = load * (uu * c * c + vv * s * s - across * s * c);
            let yy = load * (uu * s * s + vv * c * c + across * s * c);
            let xy = load * (uv * c * c - vu * s * s + turned * s * c);
            let yx = load * (vu * c * c - uv * s * s + turned * s * c);
            // ∂u_w/∂ω = −l, ∂v_w/∂ω = f
            let (x_omega, y_omega) = (xy * ahead - xx * aside, yy * ahead - yx * aside);
            body[0][0] += xx;
            body[0][1] += xy;
            body[0][2] += x_omega;
            body[1][0] += yx;
            body[1][1] += yy;
            body[1][2] += y_omega;
            body[2][0] += (yx * ahead - xx * aside) * inverse_radius_squared;
            body[2][1] += (yy * ahead - xy * aside) * inverse_radius_squared;
            body[2][2] += (y_omega * ahead - x_omega * aside) * inverse_radius_squared;
        }
        turned(body, sin, cos)
    }
}

/// Rows of a matrix that acts on (v_x, v_y, ω).
pub(crate) type Matrix = [[f64; 3]; 3];

/// A matrix that acts on a motion in the vehicle's axes, as one that acts on it in those of the scene: R A
/// Rᵀ.
#[inline(always)]
fn turned(a: Matrix, sin: f64, cos: f64) -> Matrix {
    let rows = [
        [0, 1, 2].map(|j| cos * a[0][j] - sin * a[1][j]),
        [0, 1, 2].map(|j| sin * a[0][j] + cos * a[1][j]),
        a[2],
    ];
    rows.map(|[x, y, omega]| [cos * x - sin * y, sin * x + cos * y, omega])
}

/// (1 − γh A)⁻¹, or the unit matrix where there is none.
#[inline(always)]
pub(crate) fn resolvent(a: Matrix, step: f64) -> Matrix {
    let m = [0, 1, 2].map(|i| [0, 1, 2].map(|j| f64::from(u8::from(i == j)) - step * a[i][j]));
    // Cofactors by cyclic indices.
    let cofactor = |i: usize, j: usize| {
        let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]
    };
    let determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    let inverse = 1.0 / determinant;
    if inverse.is_finite() {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) * inverse))
    } else {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    }
}

/// √ of a plain number, with the same bits everywhere.
#[inline(always)]
pub(crate) fn root(x: f64) -> f64 {
    Real::sqrt(x)
}
