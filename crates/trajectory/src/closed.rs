//! Closed forms: a straight slide, a spin in Marquard's two phases, a skid before the impact, and EDCRASH's
//! rule for choosing between slide and spin.
//!
//! ```
//! use trajectory::closed::{SPIN_SIDESLIP, Slide, spins};
//!
//! // All wheels locked for 25 m at friction 0.7, on the level: √(2 · 0.7 · 9.80665 · 25) = 18.5 m/s.
//! let slide = Slide { friction: 0.7, drag_share: 1.0, grade: 0.0, distance: 25.0 };
//! assert!((slide.speed_at_start(0.0)? - 18.526).abs() < 0.001);
//! // It left at 4° from its heading and turned by 2° on its path: it did not spin.
//! assert!(!spins(4_f64.to_radians(), 2_f64.to_radians(), 25.0, 2.7, 0.0)?);
//! assert!(spins(SPIN_SIDESLIP + 0.01, 2_f64.to_radians(), 25.0, 2.7, 0.0)?);
//! # Ok::<(), trajectory::InvalidInput>(())
//! ```

use core::f64::consts::{FRAC_PI_2, PI};

use pim_core::InvalidInput;
use real::Real;

use crate::field::GRAVITY;
use crate::ground::{GREATEST_FRICTION, GREATEST_GRADE};
use pim_core::check;

/// (rad) a vehicle that departs with more sideslip than this, 10°, spins (EDCRASH manual, chapter 4).
pub const SPIN_SIDESLIP: f64 = PI / 18.0;

/// (rad) excess of a turn over that of the wheels above which it counts as a spin: 10°, as for the sideslip.
/// The manual gives none, but without one a vehicle with straight wheels that turned by 1° would have spun.
pub const SPIN_TURN: f64 = SPIN_SIDESLIP;

/// A straight path on uniform ground on which the vehicle only loses speed: to rest, or before the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slide<T = f64> {
    /// (–) μ.
    pub friction: T,
    /// (–) f, the fraction of the friction that the wheels use: 1 if all are locked.
    pub drag_share: T,
    /// (–) G, rise per horizontal length along the path, negative downhill.
    pub grade: T,
    /// (m) S, along the ground.
    pub distance: T,
}

impl<T: Real> Slide<T> {
    fn check(&self) -> Result<(), InvalidInput> {
        check::positive("friction", self.friction.value())?;
        check::within("friction", self.friction.value(), 0.0, GREATEST_FRICTION)?;
        check::within("share of the friction that the wheels use", self.drag_share.value(), 0.0, 1.0)?;
        check::within("grade along the path", self.grade.value(), -GREATEST_GRADE, GREATEST_GRADE)?;
        check::at_least("length of the path", self.distance.value(), 0.0)
    }

    /// (m/s²) the deceleration; negative if the speed grows downhill.
    ///
    /// # Errors
    /// If a number is impossible.
    pub fn deceleration(&self) -> Result<T, InvalidInput> {
        self.check()?;
        // a = g (μ f + G)/√(1 + G²)
        Ok((self.friction * self.drag_share + self.grade) * GRAVITY / (self.grade * self.grade + 1.0).sqrt())
    }

    /// (m/s) V, the speed at the beginning of the path, of a vehicle with the speed `at_end` (m/s), 0 at
    /// rest.
    ///
    /// # Errors
    /// If a number is impossible, such as a speed below zero, or a downhill path on which a vehicle gains
    /// more than its speed at the end.
    pub fn speed_at_start(&self, at_end: T) -> Result<T, InvalidInput> {
        check::at_least("speed at the end of the path", at_end.value(), 0.0)?;
        // V² = v² + 2 a S; on the level and to rest V = √(2 μ g f S)
        let square = at_end * at_end + self.deceleration()? * self.distance * 2.0;
        if square.value() < 0.0 {
            return Err(InvalidInput::GainsMore { end: at_end.value() });
        }
        check::finite("square of the speed where the path begins", square.value())?;
        Ok(square.sqrt())
    }
}

/// A spin with wheels that roll freely, from separation to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spin<T = f64> {
    /// (–) μ.
    pub friction: T,
    /// (m) S, length of the path of the CG.
    pub distance: T,
    /// (rad) Δψ, change of the heading, counter-clockwise positive.
    pub turn: T,
    /// (m) k, yaw radius of gyration.
    pub yaw_radius: T,
    /// (m) a + b.
    pub wheelbase: T,
}

/// Initial motion of a vehicle that spun to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpinStart<T = f64> {
    /// (s) T, from separation to rest.
    pub time: T,
    /// (m/s) V_s.
    pub speed: T,
    /// (rad/s) Ω_s, counter-clockwise positive.
    pub yaw_rate: T,
}

impl<T: Real> Spin<T> {
    /// Marquard's two phases, as McHenry uses them: the speed falls while the vehicle slips sideways, the yaw
    /// rate while it rolls, and both reach zero together.
    ///
    /// It is meant for spins with rolling wheels. If the wheels are locked or the vehicle rolls out after its
    /// spin, use [`to_start`](crate::to_start), which follows the motion itself.
    ///
    /// # Errors
    /// If a number is impossible, or both path and turn are zero.
    pub fn start(&self) -> Result<SpinStart<T>, InvalidInput> {
        check::positive("friction", self.friction.value())?;
        check::within("friction", self.friction.value(), 0.0, GREATEST_FRICTION)?;
        check::at_least("length of the path", self.distance.value(), 0.0)?;
        check::angle("change of the heading", self.turn.value())?;
        check::positive("yaw radius of gyration", self.yaw_radius.value())?;
        check::positive("wheelbase", self.wheelbase.value())?;
        let (way, turn) = (self.distance * 2.0, self.turn.abs());
        let turning = self.yaw_radius * self.yaw_radius * turn * 4.0 / self.wheelbase;
        check::positive("path and turn together", (way + turning).value())?;
        // T² = [2S + 4k²|Δψ|/(a + b)]/(μ g)
        let time = ((way + turning) / (self.friction * GRAVITY)).sqrt();
        // V_s = 2S/T, Ω_s = 2Δψ/T
        Ok(SpinStart { time, speed: way / time, yaw_rate: self.turn * 2.0 / time })
    }
}

/// EDCRASH's rule: a vehicle spins if it departs with more than [`SPIN_SIDESLIP`], or if its heading changes
/// on its path to rest by more than its wheelbase and steer angle allow, here by [`SPIN_TURN`] more.
///
/// `sideslip` is the angle (rad) from the heading to the direction of departure, `turn` the change of the
/// heading (rad), `distance` the length of the path (m), `steer` the angle (rad) of the front wheels.
///
/// # Errors
/// If a number is impossible.
pub fn spins(
    sideslip: f64,
    turn: f64,
    distance: f64,
    wheelbase: f64,
    steer: f64,
) -> Result<bool, InvalidInput> {
    check::angle("sideslip at departure", sideslip)?;
    check::angle("change of the heading", turn)?;
    check::at_least("length of the path", distance, 0.0)?;
    check::positive("wheelbase", wheelbase)?;
    check::within("steer angle", steer, -FRAC_PI_2, FRAC_PI_2)?;
    // A rolling vehicle turns by Δψ = S tan δ/L.
    let (sin, cos) = real::elementary::sin_cos(steer);
    let rolled = distance * sin / (wheelbase * cos);
    // The excess of the turn beyond the interval from 0 to that, on either side.
    let beyond = Real::max(turn - Real::max(rolled, 0.0), Real::min(rolled, 0.0) - turn);
    Ok(real::principal_angle(sideslip).abs() > SPIN_SIDESLIP || beyond > SPIN_TURN)
}
