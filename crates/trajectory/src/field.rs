//! The accelerations of a vehicle by its motion.

use real::Real;

use crate::chassis::Chassis;
use crate::ground::Ground;
use crate::number::{Direction, Number, three};
use crate::tyre::{self, FADING, Tyre};

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
    tyre: Tyre<T>,
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
#[derive(Clone, Copy)]
pub(crate) struct Acceleration<T: Number> {
    /// (m/s², m/s², rad/s²) rates of (v_x, v_y, ω).
    pub(crate) rates: [T; 3],
    /// (W/kg) power of the tyres' forces, negative.
    pub(crate) power: T,
    /// (1/s) how fast the forces change with the motion, at most about.
    pub(crate) stiffness: T::Plain,
    pub(crate) sliding: [T::Mask; 4],
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
            tyre: Tyre::new(ground.friction.into(), wheel.drag),
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
            wheel.tyre = Tyre::new(ground.friction_in(zone).into(), wheel.tyre.drag);
        }
    }

    /// (–) friction under each wheel.
    pub(crate) fn friction(&self) -> [T; 4] {
        self.wheels.map(|wheel| wheel.tyre.friction)
    }

    /// (m/s²) what the wheels hold at rest against a pull along the vehicle's axis, and against one in any
    /// direction.
    pub(crate) fn hold(&self) -> [f64; 2] {
        self.wheels.iter().fold([0.0; 2], |[rolling, sliding], wheel| {
            let (load, friction) = (wheel.load.value(), wheel.tyre.friction.value());
            [rolling + load * Real::min(wheel.tyre.drag.value(), friction), sliding + load * friction]
        })
    }
}

/// Numbers of a [`Field`].
#[cfg(feature = "std")]
pub(crate) const FIELD_NUMBERS: usize = 28;

#[cfg(feature = "std")]
impl<T: Number> Field<T> {
    /// All of it, but for which wheels are steered: the first two.
    pub(crate) fn numbers(&self) -> [T; FIELD_NUMBERS] {
        let [a, b, c, d] = self.wheels.each_ref().map(|wheel| {
            let Footing { forward, left, load, tyre: Tyre { friction, drag, most }, steered: _ } = *wheel;
            [forward, left, load, friction, drag, most]
        });
        let Self { wheels: _, gravity: [x, y], inverse_radius_squared, radius_squared } = *self;
        let rest = [x, y, inverse_radius_squared, radius_squared];
        let mut numbers = [x; FIELD_NUMBERS];
        let all = a.into_iter().chain(b).chain(c).chain(d).chain(rest);
        for (number, value) in numbers.iter_mut().zip(all) {
            *number = value;
        }
        numbers
    }

    /// Of these numbers.
    #[inline(always)]
    pub(crate) fn of(numbers: [T; FIELD_NUMBERS]) -> Self {
        let wheel = |first: usize, steered: bool| Footing {
            forward: numbers[first],
            left: numbers[first + 1],
            load: numbers[first + 2],
            tyre: Tyre { friction: numbers[first + 3], drag: numbers[first + 4], most: numbers[first + 5] },
            steered,
        };
        Self {
            wheels: [wheel(0, true), wheel(6, true), wheel(12, false), wheel(18, false)],
            gravity: [numbers[24], numbers[25]],
            inverse_radius_squared: numbers[26],
            radius_squared: numbers[27],
        }
    }
}

impl<T: Number> Field<T> {
    /// Without derivatives.
    #[inline(always)]
    pub(crate) fn plain(&self) -> Field<T::Plain> {
        Field {
            wheels: self.wheels.map(|Footing { forward, left, load, tyre, steered }| Footing {
                forward: forward.plain(),
                left: left.plain(),
                load: load.plain(),
                tyre: Tyre {
                    friction: tyre.friction.plain(),
                    drag: tyre.drag.plain(),
                    most: tyre.most.plain(),
                },
                steered,
            }),
            gravity: self.gravity.map(T::plain),
            inverse_radius_squared: self.inverse_radius_squared.plain(),
            radius_squared: self.radius_squared.plain(),
        }
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

    /// (m²/s²) square of the slip below which a wheel's friction fades.
    #[inline(always)]
    fn fading_squared(&self, w: [T; 3]) -> T {
        // ε² V² = ε² (v² + k² ω²); above zero, so that a vehicle at rest feels no force
        self.energy(w) * (FADING * FADING) + f64::MIN_POSITIVE
    }

    /// The accelerations at a heading with the motion `w` = (v_x, v_y, ω) and the steer angle.
    #[inline(always)]
    pub(crate) fn acceleration(
        &self,
        heading: Direction<T>,
        w: [T; 3],
        steer: Direction<T>,
    ) -> Acceleration<T> {
        let Direction { sin, cos } = heading;
        let [vx, vy, omega] = w;
        // The motion in the vehicle's own axes.
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let fading_squared = self.fading_squared(w);
        let [front_left, front_right, rear_left, rear_right] = &self.wheels;
        let push = [
            front_left.push(u, v, omega, steer, fading_squared),
            front_right.push(u, v, omega, steer, fading_squared),
            rear_left.push(u, v, omega, steer, fading_squared),
            rear_right.push(u, v, omega, steer, fading_squared),
        ];
        let sum = |[a, b, c, d]: [T; 4]| (a + b) + (c + d);
        let forward = sum([push[0].forward, push[1].forward, push[2].forward, push[3].forward]);
        let left = sum([push[0].left, push[1].left, push[2].left, push[3].left]);
        let moment = sum([push[0].moment, push[1].moment, push[2].moment, push[3].moment]);
        // P = F·v + M ω
        let power = forward * u + left * v + moment * omega;
        let rates = [
            forward * cos - left * sin + self.gravity[0],
            forward * sin + left * cos + self.gravity[1],
            moment * self.inverse_radius_squared,
        ];
        let stiffness = (push[0].stiffness + push[1].stiffness) + (push[2].stiffness + push[3].stiffness);
        let sliding = [push[0].sliding, push[1].sliding, push[2].sliding, push[3].sliding];
        Acceleration { rates, power, stiffness, sliding }
    }

    /// How the accelerations change with (v_x, v_y, ω), roughly.
    #[inline(always)]
    pub(crate) fn slope(&self, heading: Direction<T>, w: [T; 3], steer: Direction<T>) -> Matrix<T> {
        let Direction { sin, cos } = heading;
        let [vx, vy, omega] = w;
        let zero = omega.constant(0.0);
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let fading_squared = self.fading_squared(w);
        let mut body = [[zero; 3]; 3];
        for wheel in &self.wheels {
            let (ahead, aside) = (wheel.forward, wheel.left);
            let (along, across) = wheel.aligned(u - omega * aside, v + omega * ahead, steer);
            let [[uu, uv], [vu, vv]] = tyre::slope(along, across, &wheel.tyre, fading_squared).rows;
            // From the wheel's axes to the vehicle's: R D Rᵀ.
            let [[xx, xy], [yx, yy]] = if wheel.steered {
                let Direction { sin: s, cos: c } = steer;
                let (sum, difference) = ((uv + vu) * (s * c), (uu - vv) * (s * c));
                [
                    [uu * (c * c) + vv * (s * s) - sum, uv * (c * c) - vu * (s * s) + difference],
                    [vu * (c * c) - uv * (s * s) + difference, uu * (s * s) + vv * (c * c) + sum],
                ]
            } else {
                [[uu, uv], [vu, vv]]
            };
            let load = wheel.load;
            let (xx, xy, yx, yy) = (load * xx, load * xy, load * yx, load * yy);
            // ∂u_w/∂ω = −l, ∂v_w/∂ω = f
            let (x_omega, y_omega) = (xy * ahead - xx * aside, yy * ahead - yx * aside);
            body[0][0] += xx;
            body[0][1] += xy;
            body[0][2] += x_omega;
            body[1][0] += yx;
            body[1][1] += yy;
            body[1][2] += y_omega;
            body[2][0] += (yx * ahead - xx * aside) * self.inverse_radius_squared;
            body[2][1] += (yy * ahead - xy * aside) * self.inverse_radius_squared;
            body[2][2] += (y_omega * ahead - x_omega * aside) * self.inverse_radius_squared;
        }
        turned(body, sin, cos)
    }
}

/// What a wheel does to the vehicle, by its mass.
#[derive(Clone, Copy)]
struct Push<T: Number> {
    /// (m/s²) along the vehicle's axes.
    forward: T,
    left: T,
    /// (m²/s²) about the CG.
    moment: T,
    /// (1/s)
    stiffness: T::Plain,
    sliding: T::Mask,
}

impl<T: Number> Footing<T> {
    /// The force where the vehicle moves with (`u`, `v`) (m/s) forward and left and turns with `omega`
    /// (rad/s).
    #[inline(always)]
    fn push(&self, u: T, v: T, omega: T, steer: Direction<T>, fading_squared: T) -> Push<T> {
        // v_w = v + ω × r
        let (along, across) = self.aligned(u - omega * self.left, v + omega * self.forward, steer);
        let grip = tyre::grip(along, across, &self.tyre, fading_squared);
        let (x, y) = self.turned(grip.forward, grip.left, steer);
        let (forward, left) = (x * self.load, y * self.load);
        Push {
            forward,
            left,
            // M = r × F
            moment: left * self.forward - forward * self.left,
            stiffness: grip.stiffness * self.load.plain(),
            sliding: grip.sliding,
        }
    }

    /// What the vehicle's axes have as (x, y), in those of the wheel.
    #[inline(always)]
    fn aligned(&self, x: T, y: T, steer: Direction<T>) -> (T, T) {
        let Direction { sin, cos } = steer;
        if self.steered { (x * cos + y * sin, y * cos - x * sin) } else { (x, y) }
    }

    /// What the wheel's axes have as (x, y), in those of the vehicle.
    #[inline(always)]
    fn turned(&self, x: T, y: T, steer: Direction<T>) -> (T, T) {
        let Direction { sin, cos } = steer;
        if self.steered { (x * cos - y * sin, x * sin + y * cos) } else { (x, y) }
    }
}

/// Rows of a matrix that acts on (v_x, v_y, ω).
pub(crate) type Matrix<T> = [[T; 3]; 3];

/// A matrix that acts on a motion in the vehicle's axes, as one that acts on it in those of the scene: R A
/// Rᵀ.
#[inline(always)]
fn turned<T: Number>(a: Matrix<T>, sin: T, cos: T) -> Matrix<T> {
    let rows = [three(|j| cos * a[0][j] - sin * a[1][j]), three(|j| sin * a[0][j] + cos * a[1][j]), a[2]];
    three(|i| {
        let [x, y, omega] = rows[i];
        [cos * x - sin * y, sin * x + cos * y, omega]
    })
}

/// (1 − γh A)⁻¹, of the `step` γh; not finite where there is none.
#[inline(always)]
pub(crate) fn resolvent<T: Number>(a: Matrix<T>, step: T) -> Matrix<T> {
    let m = three(|i| three(|j| -(step * a[i][j]) + f64::from(u8::from(i == j))));
    // Cofactors by cyclic indices.
    let cofactor = |i: usize, j: usize| {
        let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]
    };
    let determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    let inverse = step.constant(1.0) / determinant;
    three(|i| three(|j| cofactor(j, i) * inverse))
}

/// √ of a plain number, with the same bits everywhere.
#[inline(always)]
pub(crate) fn root(x: f64) -> f64 {
    Real::sqrt(x)
}
