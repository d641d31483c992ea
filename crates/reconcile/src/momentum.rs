//! Both speeds from the velocities after impact.

mod crush;
mod error;
mod implied;
mod together;
mod wall;
mod weighed;

use pim_core::{Body, Contact, InvalidInput, Motion, Participant, Real, Vector2, VehicleId};

use crate::answer::is_too_fast;

pub use crush::{BothSpeeds, MomentumAndCrush};
pub use error::MomentumError;
pub use implied::Implied;
pub use weighed::{EvidenceErrors, MomentumBesideCrush, WeighedSpeeds};

/// (rad) 10°. Approaches are collinear if their directions, or one direction and the opposite of the other,
/// differ by no more: EDCRASH's rule (its manual, chapter 2). At this angle an error of the momentum across
/// the axis is magnified by 1/sin 10° = 5.8 in the speeds.
pub const COLLINEAR: f64 = 0.174_532_925_199_432_95;

/// Whether directions that enclose this angle (rad, from 0 to π) lie within [`COLLINEAR`] of one line.
#[must_use]
pub fn are_collinear(angle: f64) -> bool {
    angle <= COLLINEAR || angle >= core::f64::consts::PI - COLLINEAR
}

/// sin 10°.
const COLLINEAR_SINE: f64 = 0.173_648_177_666_930_35;

/// Headings of 170° and 180° differ by 10° but for rounding, which is relatively far below this.
const SINE_ROUNDING: f64 = 1e-9;

/// Motion of a vehicle after the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Departure<T = f64> {
    /// (m/s) V, the velocity of the CG after impact in the scene frame.
    pub velocity: Vector2<T>,
    /// (rad/s) Ω, the yaw rate after impact, if known.
    pub yaw_rate: Option<T>,
}

/// A collision with two unknown speeds and known motions after it, from rest positions, from marks or as
/// given.
///
/// External forces are negligible during the impact, so momentum is conserved. Each vehicle moved along its
/// course ê_i, which is part of the [`Contact`]:
///
/// m_1 v_1 ê_1 + m_2 v_2 ê_2 = m_1 V_1 + m_2 V_2
///
/// In the plane these are two equations for two speeds. [`speeds`](Self::speeds) solves them if the
/// approaches cross. If they are collinear, one equation is left, and [`MomentumAndCrush`] replaces the other
/// by the crush energy. [`implied`](Self::implied) gives everything else that follows from the speeds.
///
/// The fields may hold any values; [`check`](Self::check) tests whether they are valid.
///
/// ```
/// use pim_core::{Body, Contact, Participant, Vector2};
/// use reconcile::{Departure, Momentum};
///
/// // Two cars of 1500 kg meet at right angles and leave together, at 10 m/s in either direction.
/// let body = Body::new(1500.0, 2500.0)?;
/// let one = Participant::new(body, 0.0, 1.5, -1.5)?;
/// let two = Participant::new(body, std::f64::consts::FRAC_PI_2, 1.5, 1.5)?;
/// let together = Departure { velocity: Vector2::new(10.0, 10.0), yaw_rate: None };
/// let contact = Contact::new([one, two], 0.0)?;
/// let momentum = Momentum { contact, yaw_rates: [0.0; 2], after: [together; 2] };
///
/// let [v1, v2] = momentum.speeds()?;
/// assert!((v1 - 20.0).abs() < 1e-12 && (v2 - 20.0).abs() < 1e-12);
/// assert!((momentum.implied([v1, v2])?.energy_loss - 3e5).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Momentum<T = f64> {
    /// The geometry.
    pub contact: Contact<T>,
    /// (rad/s) yaw rates before impact.
    pub yaw_rates: [T; 2],
    /// Motions of the vehicles after the impact.
    pub after: [Departure<T>; 2],
}

impl<T: Real> Momentum<T> {
    /// Whether both vehicles can move and all numbers are finite.
    ///
    /// # Errors
    /// [`MomentumError::Fixed`] and [`MomentumError::Invalid`].
    pub fn check(&self) -> Result<(), MomentumError> {
        for (i, vehicle) in VehicleId::ALL.into_iter().enumerate() {
            if self.contact.participants()[i].body().is_fixed() {
                return Err(MomentumError::Fixed { vehicle });
            }
        }
        self.check_numbers()
    }

    /// Whether all numbers are finite.
    fn check_numbers(&self) -> Result<(), MomentumError> {
        for i in 0..2 {
            let Departure { velocity, yaw_rate } = self.after[i];
            finite("velocity along x after impact", velocity.x)?;
            finite("velocity along y after impact", velocity.y)?;
            finite("yaw rate after impact", yaw_rate.unwrap_or(T::ZERO))?;
            finite("yaw rate", self.yaw_rates[i])?;
        }
        Ok(())
    }

    /// (kg·m/s) the momentum of both vehicles in the scene frame.
    #[inline(always)]
    #[must_use]
    pub fn total(&self) -> Vector2<T> {
        let [m1, m2] = self.masses();
        let [one, two] = &self.after;
        // p = m₁ V₁ + m₂ V₂
        one.velocity * m1 + two.velocity * m2
    }

    /// (rad) the angle from the course of vehicle 1 to that of vehicle 2, in [−π, π].
    #[must_use]
    pub fn angle(&self) -> T {
        let [e1, e2] = self.courses();
        cross(e1, e2).atan2(dot(e1, e2))
    }

    /// (–) the sine of that angle, which shows how well momentum alone determines the speeds. An error δp of
    /// the momentum moves the speed of vehicle i by up to δp/(m_i |sine|).
    #[inline(always)]
    #[must_use]
    pub fn sine(&self) -> T {
        let [e1, e2] = self.courses();
        cross(e1, e2)
    }

    /// Whether the courses lie within [`COLLINEAR`] of one line, so that momentum alone does not determine
    /// both speeds.
    #[inline(always)]
    #[must_use]
    pub fn is_collinear(&self) -> bool {
        self.sine().abs() <= T::from(COLLINEAR_SINE * (1.0 + SINE_ROUNDING))
    }

    /// Unit vector of the common line of collinear approaches: it bisects the angle between the courses, or
    /// between one and the opposite of the other.
    #[must_use]
    pub fn common_axis(&self) -> Vector2<T> {
        let [e1, e2] = self.courses();
        // â = (ê₁ ± ê₂)/|ê₁ ± ê₂| with the sign of ê₁·ê₂
        let sum = if dot(e1, e2) < T::ZERO { e1 - e2 } else { e1 + e2 };
        sum / dot(sum, sum).sqrt()
    }

    /// (m/s) both speeds along the courses, from momentum alone.
    ///
    /// # Errors
    /// Those of [`check`](Self::check), or if the approaches are collinear.
    pub fn speeds(&self) -> Result<[T; 2], MomentumError> {
        self.check()?;
        if self.is_collinear() {
            return Err(MomentumError::Collinear { angle: self.angle().value() });
        }
        let [v1, v2] = self.speeds_with(self.total());
        Ok([possible(VehicleId::One, v1)?, possible(VehicleId::Two, v2)?])
    }

    /// (m/s) the speeds along the courses that have the momentum p (kg·m/s), however nearly collinear these
    /// are, and however fast the vehicles then were.
    #[must_use]
    pub fn speeds_with(&self, p: Vector2<T>) -> [T; 2] {
        let [m1, m2] = self.masses();
        let [e1, e2] = self.courses();
        // v₁ = (p × ê₂)/(m₁ ê₁ × ê₂),  v₂ = (ê₁ × p)/(m₂ ê₁ × ê₂)
        [cross(p, e2) / (m1 * self.sine()), cross(e1, p) / (m2 * self.sine())]
    }

    /// (m/s) the speed of one vehicle along its course, from the momentum along this course and the `known`
    /// speed (m/s) of the other, for any angle between the courses. The momentum across the course remains as
    /// a check.
    ///
    /// # Errors
    /// Those of [`check`](Self::check), or if the known speed is not finite or no vehicle can have the other.
    pub fn speed_beside(&self, unknown: VehicleId, known: T) -> Result<T, MomentumError> {
        self.check()?;
        finite("speed of the other vehicle", known)?;
        let (i, j) = (unknown.index(), unknown.other().index());
        let (m, e) = (self.masses(), self.courses());
        // v_i = (p − m_j v_j ê_j)·ê_i/m_i
        possible(unknown, dot(self.total() - e[j] * (m[j] * known), e[i]) / m[i])
    }

    /// (N·s) the momentum across the heading of one vehicle after the impact less that before it, at these
    /// speeds (m/s): positive to the left of the heading. It would be zero without measurement errors.
    #[must_use]
    pub fn surplus_across(&self, vehicle: VehicleId, speeds: [T; 2]) -> T {
        let (m, e) = (self.masses(), self.courses());
        let before = e[0] * (m[0] * speeds[0]) + e[1] * (m[1] * speeds[1]);
        // ê_i × (p − Σ m v ê)
        cross(e[vehicle.index()], self.total() - before)
    }

    /// (N·s) standard deviation of that surplus, if each velocity after the impact has independent errors of
    /// its size (as a fraction of it) and of its direction (rad).
    #[must_use]
    pub fn spread_across(&self, vehicle: VehicleId, share: f64, direction: f64) -> T {
        let (m, e) = (self.masses(), self.courses()[vehicle.index()]);
        let variance = |i: usize| {
            let velocity = self.after[i].velocity;
            let (across, along) = (cross(e, velocity) * share, dot(e, velocity) * direction);
            // m² [(σ_V ê×V)² + (σ_δ ê·V)²]
            (across * across + along * along) * (m[i] * m[i])
        };
        (variance(0) + variance(1)).sqrt()
    }

    /// The same collision between point masses: the impulse at these speeds (m/s) acts along the line between
    /// the CGs and turns neither vehicle, and this line is the normal of the crush plane.
    ///
    /// # Errors
    /// If the velocities do not change.
    pub fn central(&self, speeds: [T; 2]) -> Result<Self, MomentumError> {
        let before = self.motions_at(speeds);
        let m = self.masses();
        let push = |i: usize| (self.after[i].velocity - before[i].velocity) * m[i];
        let impulse = push(0) - push(1);
        let size = dot(impulse, impulse).sqrt();
        if size <= T::ZERO {
            return Err(MomentumError::NoImpulse);
        }
        let contact = central_contact(self.contact.participants(), impulse / size)?;
        let after = self.after.map(|departure| Departure { yaw_rate: None, ..departure });
        Ok(Self { contact, yaw_rates: [T::ZERO; 2], after })
    }

    /// The motions before impact at these speeds (m/s).
    #[inline(always)]
    #[must_use]
    pub fn motions_at(&self, speeds: [T; 2]) -> [Motion<T>; 2] {
        let [e1, e2] = self.courses();
        let ([v1, v2], [w1, w2]) = (speeds, self.yaw_rates);
        [Motion { velocity: e1 * v1, yaw_rate: w1 }, Motion { velocity: e2 * v2, yaw_rate: w2 }]
    }

    #[inline(always)]
    fn courses(&self) -> [Vector2<T>; 2] {
        self.contact.participants().each_ref().map(|participant| participant.course())
    }

    #[inline(always)]
    fn masses(&self) -> [T; 2] {
        self.contact.participants().each_ref().map(|participant| participant.body().mass())
    }
}

/// (m/s) a speed, if a vehicle can have it.
fn possible<T: Real>(vehicle: VehicleId, speed: T) -> Result<T, MomentumError> {
    if speed.is_finite() && !is_too_fast(speed) {
        Ok(speed)
    } else {
        Err(MomentumError::TooFast { vehicle, speed: speed.value() })
    }
}

/// Both bodies with their headings, and C on the line between their CGs along the unit vector n, which points
/// from vehicle 2 to vehicle 1, so that the impulse turns neither.
///
/// # Errors
/// If a number is not finite.
pub fn central_contact<T: Real>(
    participants: &[Participant<T>; 2],
    normal: Vector2<T>,
) -> Result<Contact<T>, InvalidInput> {
    // Any distance will do: r × P = 0.
    let placed = |i: usize, arm: Vector2<T>| {
        let (body, forward, course) =
            (participants[i].body(), participants[i].forward(), participants[i].course());
        let angle = |direction: Vector2<T>| direction.y.atan2(direction.x);
        let placed = Participant::new(*body, angle(forward), dot(arm, forward), cross(forward, arm))?;
        placed.with_course(angle(course))
    };
    let [one, two] = [placed(0, -normal)?, placed(1, normal)?];
    Contact::new([one, two], normal.y.atan2(normal.x))
}

/// Two vehicles of known mass (kg), heading (rad) and course (rad), the direction of travel, as if their CGs
/// met: enough for [`Momentum::speeds`] and [`Momentum::speed_beside`]. The mass of a fixed object is `None`.
///
/// # Errors
/// If a mass or an angle is impossible.
pub fn point_masses<T: Real>(
    masses: [Option<T>; 2],
    headings: [T; 2],
    courses: [T; 2],
) -> Result<Contact<T>, InvalidInput> {
    let body = |i: usize| match masses[i] {
        // Any yaw inertia will do: nothing turns.
        Some(mass) => Body::new(mass, mass),
        None => Ok(Body::fixed()),
    };
    let placed =
        |i: usize| Participant::new(body(i)?, headings[i], T::ZERO, T::ZERO)?.with_course(courses[i]);
    let participants = [placed(0)?, placed(1)?];
    // Any line that turns with the scene will do.
    central_contact(&participants, -participants[0].forward())
}

fn finite<T: Real>(what: &'static str, value: T) -> Result<(), InvalidInput> {
    if value.is_finite() { Ok(()) } else { Err(InvalidInput::NotFinite { what, value: value.value() }) }
}

#[inline(always)]
fn dot<T: Real>(a: Vector2<T>, b: Vector2<T>) -> T {
    a.x * b.x + a.y * b.y
}

/// The scalar cross product.
#[inline(always)]
fn cross<T: Real>(a: Vector2<T>, b: Vector2<T>) -> T {
    a.x * b.y - a.y * b.x
}
