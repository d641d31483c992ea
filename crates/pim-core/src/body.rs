//! The colliding bodies, their position and their motion.

use nalgebra::Vector2;
use real::Real;

use crate::check;
use crate::error::InvalidInput;

/// A rigid body in the plane: mass and yaw inertia, or fixed to the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<T = f64> {
    // All four are zero for a fixed body, so that the equations need no special case: it takes an impulse
    // without moving and has no kinetic energy.
    mass: T,
    yaw_inertia: T,
    inverse_mass: T,
    inverse_yaw_inertia: T,
}

impl<T: Real> Body<T> {
    /// A vehicle of mass m (kg) and yaw inertia I about its CG (kg·m²).
    ///
    /// # Errors
    /// If either is not a finite number greater than zero.
    #[inline(always)]
    pub fn new(mass: T, yaw_inertia: T) -> Result<Self, InvalidInput> {
        let body = Self::of(mass, yaw_inertia);
        body.check()?;
        Ok(body)
    }

    /// Like [`new`](Self::new), but returns a validity flag in place of an error, so that loops over many
    /// samples vectorise.
    #[inline(always)]
    #[must_use]
    pub fn new_with_validity(mass: T, yaw_inertia: T) -> (Self, bool) {
        let body = Self::of(mass, yaw_inertia);
        (body, body.check().is_ok())
    }

    #[inline(always)]
    fn of(mass: T, yaw_inertia: T) -> Self {
        Self { mass, yaw_inertia, inverse_mass: T::ONE / mass, inverse_yaw_inertia: T::ONE / yaw_inertia }
    }

    #[inline(always)]
    fn check(&self) -> Result<(), InvalidInput> {
        check::positive("mass", self.mass.value())?;
        check::positive("yaw inertia", self.yaw_inertia.value())
    }

    /// A barrier, pole or wall: 1/m = 0 and 1/I = 0.
    #[inline(always)]
    #[must_use]
    pub fn fixed() -> Self {
        Self { mass: T::ZERO, yaw_inertia: T::ZERO, inverse_mass: T::ZERO, inverse_yaw_inertia: T::ZERO }
    }

    /// Whether this is a barrier.
    #[inline(always)]
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.inverse_mass == T::ZERO
    }

    /// (kg) m, zero for a fixed body.
    #[inline(always)]
    #[must_use]
    pub fn mass(&self) -> T {
        self.mass
    }

    /// (kg·m²) I about the CG, zero for a fixed body.
    #[inline(always)]
    #[must_use]
    pub fn yaw_inertia(&self) -> T {
        self.yaw_inertia
    }

    /// (1/kg) 1/m, zero for a fixed body.
    #[inline(always)]
    #[must_use]
    pub fn inverse_mass(&self) -> T {
        self.inverse_mass
    }

    /// (1/(kg·m²)) 1/I, zero for a fixed body.
    #[inline(always)]
    #[must_use]
    pub fn inverse_yaw_inertia(&self) -> T {
        self.inverse_yaw_inertia
    }

    /// (J) kinetic energy in the given motion.
    #[inline(always)]
    #[must_use]
    pub fn kinetic_energy(&self, motion: &Motion<T>) -> T {
        let v = motion.velocity;
        // T = ½ m v² + ½ I ω²
        (self.mass * (v.x * v.x + v.y * v.y) + self.yaw_inertia * motion.yaw_rate * motion.yaw_rate) * 0.5
    }
}

/// How a body moves: scene velocity of its CG and yaw rate.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Motion<T = f64> {
    /// (m/s) velocity of the CG in the scene frame.
    pub velocity: Vector2<T>,
    /// (rad/s) yaw rate, counter-clockwise positive.
    pub yaw_rate: T,
}

impl<T: Real> Motion<T> {
    /// At rest.
    #[inline(always)]
    #[must_use]
    pub fn rest() -> Self {
        Self { velocity: Vector2::new(T::ZERO, T::ZERO), yaw_rate: T::ZERO }
    }

    /// Moving at `speed` (m/s) along `heading` (rad) without yaw.
    #[inline(always)]
    #[must_use]
    pub fn along(heading: T, speed: T) -> Self {
        let (sin, cos) = heading.sin_cos();
        Self { velocity: Vector2::new(speed * cos, speed * sin), yaw_rate: T::ZERO }
    }

    /// The same with a yaw rate (rad/s).
    #[inline(always)]
    #[must_use]
    pub fn with_yaw_rate(self, yaw_rate: T) -> Self {
        Self { yaw_rate, ..self }
    }
}

/// One of the two bodies in the collision: its heading, course, and the arm from its CG to the contact point
/// C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Participant<T = f64> {
    pub(crate) body: Body<T>,
    /// Unit vector of the body's own forward axis in the scene.
    pub(crate) forward: Vector2<T>,
    /// Unit vector in the scene of the direction of its speed before impact.
    pub(crate) course: Vector2<T>,
    /// r: vector from the CG to C in the scene.
    pub(crate) arm: Vector2<T>,
}

impl<T: Real> Participant<T> {
    /// A body with heading θ (rad) whose contact point lies at (`forward`, `left`) (m) of its CG, in its own
    /// axes.
    ///
    /// # Errors
    /// If a number is not finite.
    #[inline(always)]
    pub fn new(body: Body<T>, heading: T, forward: T, left: T) -> Result<Self, InvalidInput> {
        Self::check(heading, forward, left)?;
        Ok(Self::of(body, heading, forward, left))
    }

    /// Like [`new`](Self::new), but returns a validity flag in place of an error, so that loops over many
    /// samples vectorise.
    #[inline(always)]
    #[must_use]
    pub fn new_with_validity(body: Body<T>, heading: T, forward: T, left: T) -> (Self, bool) {
        (Self::of(body, heading, forward, left), Self::check(heading, forward, left).is_ok())
    }

    #[inline(always)]
    fn of(body: Body<T>, heading: T, forward: T, left: T) -> Self {
        let (sin, cos) = heading.sin_cos();
        let arm = Vector2::new(forward * cos - left * sin, forward * sin + left * cos);
        let forward = Vector2::new(cos, sin);
        Self { body, forward, course: forward, arm }
    }

    /// The same body travelling in the scene direction `course` (rad), which is the heading unless there is
    /// sideslip.
    ///
    /// # Errors
    /// If the number is not finite.
    #[inline(always)]
    pub fn with_course(self, course: T) -> Result<Self, InvalidInput> {
        check::angle("course", course.value())?;
        let (sin, cos) = course.sin_cos();
        Ok(Self { course: Vector2::new(cos, sin), ..self })
    }

    #[inline(always)]
    fn check(heading: T, forward: T, left: T) -> Result<(), InvalidInput> {
        check::angle("heading", heading.value())?;
        check::finite("forward distance to the contact point", forward.value())?;
        check::finite("left distance to the contact point", left.value())
    }

    /// Like [`new`](Self::new), with the contact point in polar form: `distance` d (m) from the CG, at
    /// `angle` φ (rad) from the heading θ.
    ///
    /// # Errors
    /// If a number is not finite.
    #[inline(always)]
    pub fn polar(body: Body<T>, heading: T, distance: T, angle: T) -> Result<Self, InvalidInput> {
        check::angle("contact angle", angle.value())?;
        let (sin, cos) = angle.sin_cos();
        Self::new(body, heading, distance * cos, distance * sin)
    }

    /// A barrier without a known geometry. Only the other body's arm then orients the normal of the crush
    /// plane.
    #[inline(always)]
    #[must_use]
    pub fn barrier() -> Self {
        Self {
            body: Body::fixed(),
            forward: Vector2::new(T::ONE, T::ZERO),
            course: Vector2::new(T::ONE, T::ZERO),
            arm: Vector2::new(T::ZERO, T::ZERO),
        }
    }

    /// The body.
    #[inline(always)]
    #[must_use]
    pub fn body(&self) -> &Body<T> {
        &self.body
    }

    /// Unit vector of the body's own forward axis in the scene frame.
    #[inline(always)]
    #[must_use]
    pub fn forward(&self) -> Vector2<T> {
        self.forward
    }

    /// Unit vector in the scene frame of the direction of the body's speed before impact: its forward axis,
    /// unless it [travels in another direction](Self::with_course).
    #[inline(always)]
    #[must_use]
    pub fn course(&self) -> Vector2<T> {
        self.course
    }

    /// (m) vector from the CG to the contact point C in the scene frame, r of theory, section 1.
    #[inline(always)]
    #[must_use]
    pub fn arm(&self) -> Vector2<T> {
        self.arm
    }
}
