//! The state of a vehicle, the record of its path, and its rest.

use pim_core::{Motion, Vector2};
use real::Real;

/// (m/s) greatest speed along either axis at a start, three times that of light: an estimate follows draws of
/// its prior that no vehicle reaches.
pub const GREATEST_SPEED: f64 = 1e9;
/// (rad/s) greatest yaw rate at a start, to either side.
pub const GREATEST_YAW_RATE: f64 = 1e9;

/// Position and motion of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct State<T = f64> {
    /// (m) position of the CG in the scene.
    pub position: Vector2<T>,
    /// (rad) heading in the scene, including full turns.
    pub heading: T,
    /// Velocity and yaw rate.
    pub motion: Motion<T>,
}

impl<T: Real> State<T> {
    /// The plain numbers, without derivatives.
    #[must_use]
    pub fn values(&self) -> State<f64> {
        let plain = |vector: Vector2<T>| Vector2::new(vector.x.value(), vector.y.value());
        State {
            position: plain(self.position),
            heading: self.heading.value(),
            motion: Motion { velocity: plain(self.motion.velocity), yaw_rate: self.motion.yaw_rate.value() },
        }
    }
}

/// One instant of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Sample<T = f64> {
    /// (s) since the start.
    pub time: T,
    /// (m) length of the path since the start.
    pub distance: T,
    /// Position and motion.
    pub state: State<T>,
    /// Whether each tyre slides and leaves marks: front left, front right, rear left, rear right.
    pub sliding: [bool; 4],
    /// (–) friction of the ground under each wheel.
    pub friction: [T; 4],
}

impl<T: Real> Sample<T> {
    /// Position and motion at a time (s) between this sample and the `next`, by the cubic with the positions
    /// and velocities of both.
    #[must_use]
    pub fn between(&self, next: &Self, time: T) -> State<T> {
        let span = next.time - self.time;
        if span.value() <= 0.0 {
            return self.state;
        }
        let s = (time - self.time) / span;
        let (from, to) = (&self.state, &next.state);
        let cubic = |p0, p1, v0, v1| cubic(s, span, [p0, p1], [v0, v1]);
        let (v0, v1) = (from.motion.velocity, to.motion.velocity);
        let (x, vx) = cubic(from.position.x, to.position.x, v0.x, v1.x);
        let (y, vy) = cubic(from.position.y, to.position.y, v0.y, v1.y);
        let (heading, yaw_rate) = cubic(from.heading, to.heading, from.motion.yaw_rate, to.motion.yaw_rate);
        let motion = Motion { velocity: Vector2::new(vx, vy), yaw_rate };
        State { position: Vector2::new(x, y), heading, motion }
    }
}

/// Value and rate, at the fraction `s` of a time span, of the cubic with these values and rates at its ends
/// (Hermite).
#[inline(always)]
pub(crate) fn cubic<T: Real>(s: T, span: T, [p0, p1]: [T; 2], [v0, v1]: [T; 2]) -> (T, T) {
    let (m0, m1, rise) = (v0 * span, v1 * span, p1 - p0);
    // p = p₀ + s (m₀ + s (3Δ − 2m₀ − m₁ + s (m₀ + m₁ − 2Δ)))
    let (square, cube) = (rise * 3.0 - m0 * 2.0 - m1, m0 + m1 - rise * 2.0);
    let value = p0 + s * (m0 + s * (square + s * cube));
    let rate = (m0 + s * (square * 2.0 + s * cube * 3.0)) / span;
    (value, rate)
}

/// The energy balance of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MotionEnergy<T = f64> {
    /// (J) kinetic energy at the start.
    pub start: T,
    /// (J) absorbed by the tyres.
    pub friction: T,
    /// (J) given by the grade, negative uphill.
    pub grade: T,
    /// (J) remainder of the balance of the three above: the error of the integration.
    pub remainder: T,
}

/// The rest of a vehicle, and its motion to it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: Real + serde::Serialize + serde::de::DeserializeOwned"))]
pub struct Rest<T = f64> {
    /// (m) position of the CG in the scene.
    pub position: Vector2<T>,
    /// (rad) heading in the scene, including full turns since the start.
    pub heading: T,
    /// (s) since the start.
    pub time: T,
    /// (m) length of the path of the CG.
    pub distance: T,
    /// The energy balance of the motion.
    pub energy: MotionEnergy<T>,
    /// Steps of the integration, including rejected ones.
    pub steps: u32,
}

impl<T: Real> Rest<T> {
    /// The plain numbers, without derivatives.
    pub(crate) fn values(&self) -> Rest<f64> {
        let MotionEnergy { start, friction, grade, remainder } = self.energy;
        Rest {
            position: Vector2::new(self.position.x.value(), self.position.y.value()),
            heading: self.heading.value(),
            time: self.time.value(),
            distance: self.distance.value(),
            energy: MotionEnergy {
                start: start.value(),
                friction: friction.value(),
                grade: grade.value(),
                remainder: remainder.value(),
            },
            steps: self.steps,
        }
    }
}

/// Accuracy and limits of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Control {
    /// (m) error that a step may add to the rest position of the CG and of each wheel.
    pub tolerance: f64,
    /// (s) time after which a moving vehicle is given up.
    pub longest_time: f64,
    /// (s) longest step, for a fine record of the path.
    pub longest_step: f64,
    /// Steps after which a motion is given up.
    pub most_steps: u32,
    /// Whether the final phase, in which the motion only fades, is one step in closed form. Its derivatives
    /// are those of motions that fade in the same way: those of a straight roll lack the tyre forces across
    /// it. So exact derivatives need steps down to rest, and a tolerance far below that of the path: where
    /// the forces kink, the error of a derivative falls with the step, and that of the path with its square.
    pub closed_end: bool,
}

impl Default for Control {
    /// About 1 mm at rest, and at most five minutes, in which freely rolling wheels stop from 30 m/s.
    fn default() -> Self {
        Self { tolerance: 1e-4, longest_time: 300.0, longest_step: 1.0, most_steps: 20_000, closed_end: true }
    }
}
