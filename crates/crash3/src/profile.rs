//! The measured crush depths along the damaged side.

use alloc::vec;
use alloc::vec::Vec;

use real::Real;

use crate::error::{self, CrushError};

/// A crush profile: residual crush depths C_1 … C_N at stations along the damage, linear between them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Profile<T = f64> {
    pub(crate) depths: Vec<T>,
    pub(crate) spacings: Vec<T>,
}

/// One trapezoid of a profile, between two neighbouring stations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Zone<T = f64> {
    /// (m) w_j, distance between the stations.
    pub width: T,
    /// (m) depths C_j and C_{j+1} at its two ends.
    pub depths: [T; 2],
}

/// (m) w = L/(N−1): the spacing of N = `stations`, two or more, over the damage width L = `width` (m);
/// infinite for fewer.
#[inline(always)]
#[must_use]
pub fn equal_spacing<T: Real>(width: T, stations: usize) -> T {
    #[expect(clippy::cast_precision_loss, reason = "station counts are small")]
    let intervals = stations.saturating_sub(1) as f64;
    width / intervals
}

impl<T: Real> Zone<T> {
    /// Whether the zone can be part of a profile: its width is greater than zero, and no depth is negative.
    #[inline(always)]
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let [c1, c2] = self.depths.map(T::value);
        error::positive("spacing between stations", self.width.value()).is_ok()
            & error::not_negative("crush depth", c1).is_ok()
            & error::not_negative("crush depth", c2).is_ok()
    }

    /// (m) mean depth C̄ = (C_1 + C_2)/2.
    #[inline(always)]
    #[must_use]
    pub fn mean_depth(&self) -> T {
        let [c1, c2] = self.depths;
        (c1 + c2) / 2.0
    }

    /// (m²) mean of the squared depth Q = (C_1² + C_1 C_2 + C_2²)/3.
    #[inline(always)]
    #[must_use]
    pub fn mean_square_depth(&self) -> T {
        let [c1, c2] = self.depths;
        (c1 * c1 + c1 * c2 + c2 * c2) / 3.0
    }

    /// (m²) ∫ C ds over the width.
    #[inline(always)]
    #[must_use]
    pub fn area(&self) -> T {
        // w C̄
        self.width * self.mean_depth()
    }

    /// (m³) ∫ C²/2 ds over the width.
    #[inline(always)]
    #[must_use]
    pub fn second_moment(&self) -> T {
        // w Q/2
        self.width * self.mean_square_depth() / 2.0
    }
}

/// The integrals of a profile. For a stiffness without saturation the crush energy is A S_1 + B S_2 + G L,
/// and the force normal to the side A L + B S_1; [`crush_energy`](crate::crush_energy) adds up the zones
/// instead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProfileSums<T = f64> {
    /// (m) L, the width of the damage.
    pub width: T,
    /// (m²) S_1 = Σ w_j (C_j + C_{j+1})/2, the area of the crush.
    pub area: T,
    /// (m³) S_2 = Σ w_j (C_j² + C_j C_{j+1} + C_{j+1}²)/6, its moment about the undamaged face.
    pub second_moment: T,
}

impl<T: Real> ProfileSums<T> {
    /// (m) C̄, the mean depth over the width.
    #[must_use]
    pub fn mean_depth(&self) -> T {
        // C̄ = S₁/L
        self.area / self.width
    }

    /// (m²) Q, the mean of the squared depth over the width.
    #[must_use]
    pub fn mean_square_depth(&self) -> T {
        // Q = 2 S₂/L
        self.second_moment * 2.0 / self.width
    }
}

impl<T: Real> Profile<T> {
    /// N `depths` (m) at equal spacing over the damage width L = `width` (m): w = L/(N−1).
    ///
    /// # Errors
    /// If there are fewer than two stations, a depth is negative, or the width is not positive.
    pub fn equally_spaced(depths: Vec<T>, width: T) -> Result<Self, CrushError> {
        error::positive("damage width", width.value())?;
        let stations = depths.len();
        if stations < 2 {
            return Err(CrushError::TooFewStations { stations });
        }
        Self::new(depths, vec![equal_spacing(width, stations); stations - 1])
    }

    /// N `depths` (m) with the N−1 `spacings` (m) between their stations.
    ///
    /// # Errors
    /// If there are fewer than two stations, the numbers of depths and spacings do not fit, a depth is
    /// negative, or a spacing is not positive.
    pub fn new(depths: Vec<T>, spacings: Vec<T>) -> Result<Self, CrushError> {
        if depths.len() < 2 {
            return Err(CrushError::TooFewStations { stations: depths.len() });
        }
        if spacings.len() != depths.len() - 1 {
            return Err(CrushError::SpacingCount { stations: depths.len(), spacings: spacings.len() });
        }
        for depth in &depths {
            error::not_negative("crush depth", depth.value())?;
        }
        for spacing in &spacings {
            error::positive("spacing between stations", spacing.value())?;
        }
        Ok(Self { depths, spacings })
    }

    /// (m) the depths C_1 … C_N.
    #[must_use]
    pub fn depths(&self) -> &[T] {
        &self.depths
    }

    /// (m) L, the width of the damage.
    #[must_use]
    pub fn width(&self) -> T {
        self.spacings.iter().fold(T::ZERO, |sum, &w| sum + w)
    }

    /// Width, area and second moment.
    #[must_use]
    pub fn sums(&self) -> ProfileSums<T> {
        let mut sums = ProfileSums { width: self.width(), area: T::ZERO, second_moment: T::ZERO };
        for zone in self.zones() {
            sums.area += zone.area();
            sums.second_moment += zone.second_moment();
        }
        sums
    }

    /// The trapezoids between neighbouring stations.
    #[inline(always)]
    pub fn zones(&self) -> impl Iterator<Item = Zone<T>> {
        self.spacings
            .iter()
            .zip(self.depths.windows(2))
            .map(|(&width, ends)| Zone { width, depths: [ends[0], ends[1]] })
    }
}
