//! Stiffness from a barrier test.

use real::Real;

use crate::error::{self, CrushError};
use crate::profile::Profile;
use crate::stiffness::Stiffness;

/// A full-width test against a rigid barrier: the residual crush, and the speed that would have left none.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BarrierTest<T = f64> {
    pub(crate) mass: T,
    pub(crate) speed: T,
    pub(crate) profile: Profile<T>,
    pub(crate) no_damage_speed: T,
}

impl<T: Real> BarrierTest<T> {
    /// A car of the given `mass` (kg) that struck the barrier at `speed` V (m/s) with the residual crush
    /// `profile`. At `no_damage_speed` b_0 (m/s) no crush would have remained.
    ///
    /// # Errors
    /// If mass or speed is not positive, the speed without damage is negative or not below the test's, or
    /// there is no crush.
    pub fn new(mass: T, speed: T, profile: Profile<T>, no_damage_speed: T) -> Result<Self, CrushError> {
        error::positive("mass", mass.value())?;
        error::positive("speed of the barrier test", speed.value())?;
        error::not_negative("speed without damage", no_damage_speed.value())?;
        if no_damage_speed.value() >= speed.value() {
            return Err(CrushError::NoDamageSpeed {
                no_damage_speed: no_damage_speed.value(),
                speed: speed.value(),
            });
        }
        if profile.depths().iter().all(|depth| depth.value() == 0.0) {
            return Err(CrushError::NoCrushInTest);
        }
        Ok(Self { mass, speed, profile, no_damage_speed })
    }

    /// The stiffness for which the crush energy of the test's profile is exactly its kinetic energy ½ m V².
    /// That is the energy *absorbed* at maximum engagement: see [`EnergyBasis`](crate::EnergyBasis).
    ///
    /// # Errors
    /// If the magnitudes differ so much that the stiffness is not finite.
    pub fn fit(&self) -> Result<Stiffness<T>, CrushError> {
        self.stiffness(self.slope())
    }

    /// (1/s) b_1 of [`fit`](Self::fit), the rise of the speed with crush.
    #[must_use]
    pub fn slope(&self) -> T {
        let (b0, v, sums) = (self.no_damage_speed, self.speed, self.profile.sums());
        let (mean, mean_square) = (sums.mean_depth(), sums.mean_square_depth());
        let half = b0 * mean;
        let rest = v * v - b0 * b0;
        // Q b₁² + 2 b₀ C̄ b₁ + b₀² − V² = 0, its positive root written without a difference of near equals:
        // b₁ = (V² − b₀²)/(b₀ C̄ + √(b₀² C̄² + Q (V² − b₀²)))
        rest / (half + (half * half + mean_square * rest).sqrt())
    }

    /// The common shortcut: the line V = b_0 + b_1 C through the mean crush, b_1 = (V − b_0)/C̄. The
    /// profile's energy then exceeds that of the test unless the crush is uniform, by a few per cent for the
    /// usual profiles. For comparison only.
    ///
    /// # Errors
    /// If the magnitudes differ so much that the stiffness is not finite.
    pub fn fit_mean(&self) -> Result<Stiffness<T>, CrushError> {
        self.stiffness(self.mean_slope())
    }

    /// (1/s) b_1 of [`fit_mean`](Self::fit_mean).
    #[must_use]
    pub fn mean_slope(&self) -> T {
        // b₁ = (V − b₀)/C̄
        (self.speed - self.no_damage_speed) / self.profile.sums().mean_depth()
    }

    /// The residual crush that the test left.
    #[must_use]
    pub fn profile(&self) -> &Profile<T> {
        &self.profile
    }

    fn stiffness(&self, b1: T) -> Result<Stiffness<T>, CrushError> {
        let (b0, width) = (self.no_damage_speed, self.profile.width());
        // A = m b₀ b₁/w,  B = m b₁²/w,  G = A²/2B = m b₀²/2w
        let per_width = self.mass / width;
        Stiffness::from_abg(per_width * b0 * b1, per_width * b1 * b1, per_width * b0 * b0 / 2.0)
    }
}
