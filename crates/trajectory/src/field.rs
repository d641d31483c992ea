//! The accelerations of a vehicle as a function of its motion.

use real::Real;

use crate::chassis::Chassis;
use crate::ground::Ground;
use crate::number::{Direction, Number, three};
#[cfg(feature = "std")]
use crate::tyre::TYRE_NUMBERS;
use crate::tyre::{self, CORNERING_STIFFNESS, FADING, Slip, Slope, Tyre};

/// (m/s²) standard gravity (ISO 80000-3).
pub const GRAVITY: f64 = 9.806_65;

/// The two wheels of an axle on their ground.
#[derive(Clone, Copy, Debug)]
struct Axle<T> {
    /// (m) from the CG.
    forward: T,
    left: Tyre<T>,
    right: Tyre<T>,
}

/// A vehicle on its ground, per unit mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<T> {
    /// The axle with the steered wheels.
    front: Axle<T>,
    rear: Axle<T>,
    /// (m) from the centre line to the wheels on either side.
    half_track: T,
    /// (m/s²) component of gravity along the plane, downhill.
    pub(crate) gravity: [T; 2],
    /// (1/m²) m/I.
    inverse_radius_squared: T,
    /// (m²) k² = I/m.
    pub(crate) radius_squared: T,
}

/// The effect of the forces at one instant.
#[derive(Clone, Copy)]
pub(crate) struct Acceleration<T: Number> {
    /// (m/s², m/s², rad/s²) rates of (v_x, v_y, ω).
    pub(crate) rates: [T; 3],
    /// (W/kg) power of the tyres' forces, negative.
    pub(crate) power: T,
    /// (1/s) approximate maximum of the change of the forces with the motion.
    pub(crate) stiffness: T::Plain,
    pub(crate) sliding: [T::Mask; 4],
    /// The locked wheels, as the sum of their numbers 1, 2, 4 and 8.
    pub(crate) locked: T::Plain,
}

impl<T: Real> Field<T> {
    /// The field with each wheel on the given zone.
    pub(crate) fn new<G: Real>(chassis: &Chassis<T>, ground: &Ground<'_, G>, zones: [usize; 4]) -> Self
    where
        T: From<G>,
    {
        let grade: [T; 2] = [ground.grade.x.into(), ground.grade.y.into()];
        // cos θ = 1/√(1 + |G|²), and the pull along the plane is g sin θ = g |G| cos θ
        let cos = T::ONE / (grade[0] * grade[0] + grade[1] * grade[1] + 1.0).sqrt();
        let normal = cos * GRAVITY;
        let wheels = chassis.wheels();
        let tyre = |i: usize| {
            let (load, friction) = (wheels[i].load * normal, T::from(ground.friction_in(zones[i])));
            Tyre::new(load * friction, load * wheels[i].drag, load * CORNERING_STIFFNESS)
        };
        let body = chassis.body();
        Self {
            front: Axle { forward: wheels[0].forward, left: tyre(0), right: tyre(1) },
            rear: Axle { forward: wheels[2].forward, left: tyre(2), right: tyre(3) },
            half_track: wheels[0].left,
            gravity: [-(grade[0] * normal), -(grade[1] * normal)],
            inverse_radius_squared: body.mass() * body.inverse_yaw_inertia(),
            radius_squared: body.yaw_inertia() * body.inverse_mass(),
        }
    }

    /// (m/s²) the pull that the wheels resist at rest, along the vehicle's axis and in any direction.
    pub(crate) fn hold(&self) -> [f64; 2] {
        let tyres = [&self.front.left, &self.front.right, &self.rear.left, &self.rear.right];
        tyres.into_iter().fold([0.0; 2], |[rolling, sliding], tyre| {
            let (friction, drag) = (tyre.friction.value(), tyre.drag.value());
            [rolling + Real::min(drag, friction), sliding + friction]
        })
    }
}

/// Number of values in a [`Field`].
#[cfg(feature = "std")]
pub(crate) const FIELD_NUMBERS: usize = 2 * AXLE_NUMBERS + 5;
#[cfg(feature = "std")]
const AXLE_NUMBERS: usize = 2 * TYRE_NUMBERS + 1;

#[cfg(feature = "std")]
impl<T: Number> Axle<T> {
    fn numbers(&self) -> [T; AXLE_NUMBERS] {
        let mut numbers = [self.forward; AXLE_NUMBERS];
        numbers[1..=TYRE_NUMBERS].copy_from_slice(&self.left.numbers());
        numbers[TYRE_NUMBERS + 1..].copy_from_slice(&self.right.numbers());
        numbers
    }

    #[inline(always)]
    fn of(numbers: [T; AXLE_NUMBERS]) -> Self {
        let tyre = |first: usize| {
            let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5];
            Tyre::of([
                numbers[first + a],
                numbers[first + b],
                numbers[first + c],
                numbers[first + d],
                numbers[first + e],
                numbers[first + f],
            ])
        };
        Self { forward: numbers[0], left: tyre(1), right: tyre(1 + TYRE_NUMBERS) }
    }
}

#[cfg(feature = "std")]
impl<T: Number> Field<T> {
    pub(crate) fn numbers(&self) -> [T; FIELD_NUMBERS] {
        let Self { front, rear, half_track, gravity: [x, y], inverse_radius_squared, radius_squared } = self;
        let mut numbers = [*half_track; FIELD_NUMBERS];
        numbers[..AXLE_NUMBERS].copy_from_slice(&front.numbers());
        numbers[AXLE_NUMBERS..2 * AXLE_NUMBERS].copy_from_slice(&rear.numbers());
        numbers[2 * AXLE_NUMBERS + 1..].copy_from_slice(&[*x, *y, *inverse_radius_squared, *radius_squared]);
        numbers
    }

    /// The field with these values.
    #[inline(always)]
    pub(crate) fn of(numbers: [T; FIELD_NUMBERS]) -> Self {
        let mut front = [numbers[0]; AXLE_NUMBERS];
        let mut rear = front;
        let mut i = 0;
        while i < AXLE_NUMBERS {
            front[i] = numbers[i];
            rear[i] = numbers[AXLE_NUMBERS + i];
            i += 1;
        }
        let rest = 2 * AXLE_NUMBERS;
        Self {
            front: Axle::of(front),
            rear: Axle::of(rear),
            half_track: numbers[rest],
            gravity: [numbers[rest + 1], numbers[rest + 2]],
            inverse_radius_squared: numbers[rest + 3],
            radius_squared: numbers[rest + 4],
        }
    }
}

impl<T: Number> Axle<T> {
    #[inline(always)]
    fn plain(&self) -> Axle<T::Plain> {
        Axle { forward: self.forward.plain(), left: self.left.plain(), right: self.right.plain() }
    }
}

impl<T: Number> Field<T> {
    /// The field without derivatives.
    #[inline(always)]
    pub(crate) fn plain(&self) -> Field<T::Plain> {
        Field {
            front: self.front.plain(),
            rear: self.rear.plain(),
            half_track: self.half_track.plain(),
            gravity: [self.gravity[0].plain(), self.gravity[1].plain()],
            inverse_radius_squared: self.inverse_radius_squared.plain(),
            radius_squared: self.radius_squared.plain(),
        }
    }

    /// (m²/s²) twice the kinetic energy per unit mass.
    #[inline(always)]
    pub(crate) fn energy(&self, w: [T; 3]) -> T {
        self.product(w, w)
    }

    /// The inner product of two motions; that of a motion with itself is twice its kinetic energy per unit
    /// mass.
    #[inline(always)]
    pub(crate) fn product(&self, a: [T; 3], b: [T; 3]) -> T {
        // v·v′ + k² ω ω′
        a[0] * b[0] + a[1] * b[1] + self.radius_squared * a[2] * b[2]
    }

    /// (m²/s²) square of the slip speed below which a wheel's friction fades.
    #[inline(always)]
    fn fading_squared(&self, w: [T; 3]) -> T {
        // ε² V² = ε² (v² + k² ω²); kept above zero, so that no force acts on a vehicle at rest
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
        if const { T::CALLS } {
            self.called_acceleration(heading, w, steer)
        } else {
            self.inlined_acceleration(heading, w, steer)
        }
    }

    #[inline(never)]
    fn called_acceleration(&self, heading: Direction<T>, w: [T; 3], steer: Direction<T>) -> Acceleration<T> {
        self.inlined_acceleration(heading, w, steer)
    }

    #[inline(always)]
    fn inlined_acceleration(&self, heading: Direction<T>, w: [T; 3], steer: Direction<T>) -> Acceleration<T> {
        let Direction { sin, cos } = heading;
        let [vx, vy, omega] = w;
        // The motion in the vehicle's own axes.
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let Self { front, rear, .. } = self;
        let [front_left, front_right, rear_left, rear_right] =
            tyre::grips(self.slips([u, v, omega], steer), self.fading_squared(w));
        // The forces of an axle, and the excess of the left one, turned from its wheels' axes to the
        // vehicle's.
        let [front_forward, front_left_force, front_more] = {
            let Direction { sin, cos } = steer;
            let (x, y) = (front_left.forward + front_right.forward, front_left.left + front_right.left);
            let (more_x, more_y) =
                (front_left.forward - front_right.forward, front_left.left - front_right.left);
            [x * cos - y * sin, x * sin + y * cos, more_x * cos - more_y * sin]
        };
        let rear_left_force = rear_left.left + rear_right.left;
        let forward = front_forward + (rear_left.forward + rear_right.forward);
        let left = front_left_force + rear_left_force;
        // M = Σ r × F
        let more = front_more + (rear_left.forward - rear_right.forward);
        let moment =
            (front_left_force * front.forward + rear_left_force * rear.forward) - more * self.half_track;
        // P = F·v + M ω
        let power = -(forward * u + left * v + moment * omega);
        let rates = [
            self.gravity[0] - (forward * cos - left * sin),
            self.gravity[1] - (forward * sin + left * cos),
            -(moment * self.inverse_radius_squared),
        ];
        let stiffness =
            (front_left.stiffness + front_right.stiffness) + (rear_left.stiffness + rear_right.stiffness);
        let sliding = [front_left.sliding, front_right.sliding, rear_left.sliding, rear_right.sliding];
        let zero = omega.plain().constant(0.0);
        let bit = |mask: T::Mask, bit: f64| <T::Plain as Number>::select(mask, zero.constant(bit), zero);
        let locked = (bit(front_left.locked, 1.0) + bit(front_right.locked, 2.0))
            + (bit(rear_left.locked, 4.0) + bit(rear_right.locked, 8.0));
        Acceleration { rates, power, stiffness, sliding, locked }
    }

    /// Rough derivatives of the accelerations with respect to (v_x, v_y, ω).
    #[inline(always)]
    pub(crate) fn slope(&self, heading: Direction<T>, w: [T; 3], steer: Direction<T>) -> Matrix<T> {
        let Direction { sin, cos } = heading;
        let [vx, vy, omega] = w;
        let zero = omega.constant(0.0);
        let (u, v) = (vx * cos + vy * sin, vy * cos - vx * sin);
        let [front_left, front_right, rear_left, rear_right] =
            tyre::slopes(self.slips([u, v, omega], steer), self.fading_squared(w));
        let straight = Direction { sin: zero, cos: zero.constant(1.0) };
        let (half, by_inertia) = (self.half_track, self.inverse_radius_squared);
        let [a, b, c, d] = [
            front_left.in_vehicle([self.front.forward, half], steer, by_inertia),
            front_right.in_vehicle([self.front.forward, -half], steer, by_inertia),
            rear_left.in_vehicle([self.rear.forward, half], straight, by_inertia),
            rear_right.in_vehicle([self.rear.forward, -half], straight, by_inertia),
        ];
        let body = three(|i| three(|j| (a[i][j] + b[i][j]) + (c[i][j] + d[i][j])));
        turned(body, sin, cos)
    }

    /// The slip of the wheels of a vehicle that moves with (u, v) (m/s) forward and left and turns with ω
    /// (rad/s).
    #[inline(always)]
    fn slips(&self, [u, v, omega]: [T; 3], steer: Direction<T>) -> [Slip<'_, T>; 4] {
        let Self { front, rear, half_track, .. } = self;
        // v_w = v + ω × r: at the centre of an axle, and the difference of a wheel from it
        let swing = omega * *half_track;
        let Direction { sin, cos } = steer;
        let across = v + omega * front.forward;
        let (along, across) = (u * cos + across * sin, across * cos - u * sin);
        let (ahead, aside) = (swing * cos, swing * sin);
        let behind = v + omega * rear.forward;
        [
            Slip { u: along - ahead, v: across + aside, tyre: &front.left },
            Slip { u: along + ahead, v: across - aside, tyre: &front.right },
            Slip { u: u - swing, v: behind, tyre: &rear.left },
            Slip { u: u + swing, v: behind, tyre: &rear.right },
        ]
    }
}

impl<T: Number> Slope<T> {
    /// The contribution of the wheel at (`ahead`, `aside`) (m), forward and left of the CG, to the
    /// derivatives of the accelerations with respect to (u, v, ω), in the vehicle's axes.
    #[inline(always)]
    fn in_vehicle(&self, [ahead, aside]: [T; 2], steer: Direction<T>, by_inertia: T) -> Matrix<T> {
        let [[uu, uv], [vu, vv]] = self.rows;
        let Direction { sin: s, cos: c } = steer;
        // From the wheel's axes to the vehicle's: R D Rᵀ.
        let (sum, difference) = ((uv + vu) * (s * c), (uu - vv) * (s * c));
        let (xx, yy) = (uu * (c * c) + vv * (s * s) - sum, uu * (s * s) + vv * (c * c) + sum);
        let (xy, yx) = (uv * (c * c) - vu * (s * s) + difference, vu * (c * c) - uv * (s * s) + difference);
        // ∂u_w/∂ω = −l, ∂v_w/∂ω = f
        let (x_omega, y_omega) = (xy * ahead - xx * aside, yy * ahead - yx * aside);
        let moment = |x: T, y: T| (y * ahead - x * aside) * by_inertia;
        [[xx, xy, x_omega], [yx, yy, y_omega], [moment(xx, yx), moment(xy, yy), moment(x_omega, y_omega)]]
    }
}

/// Rows of a matrix that acts on (v_x, v_y, ω).
pub(crate) type Matrix<T> = [[T; 3]; 3];

/// Transforms a matrix from the vehicle's axes to those of the scene: R A Rᵀ.
#[inline(always)]
fn turned<T: Number>(a: Matrix<T>, sin: T, cos: T) -> Matrix<T> {
    let rows = [three(|j| cos * a[0][j] - sin * a[1][j]), three(|j| sin * a[0][j] + cos * a[1][j]), a[2]];
    three(|i| {
        let [x, y, omega] = rows[i];
        [cos * x - sin * y, sin * x + cos * y, omega]
    })
}

/// (1 − γh A)⁻¹, with the `step` γh; not finite if there is none.
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
