//! The figures that can be fitted, and the guesses of them before the fit.

use evidence::Fitted;
use real::elementary::{exp, ln};

/// A figure that is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// (–) mean excess of ln of the crush energy over ln of the energy absorbed in the impact.
    Bias,
    /// (–) its spread between fronts.
    SpreadOfFronts,
    /// (–) its spread for a damaged rear.
    SpreadOfRears,
    /// (–) its spread for a damaged side.
    SpreadOfSides,
    /// (–) ratio of b₁ of sides to that of fronts.
    SlopeOfSides,
    /// (–) ratio of b₁ of rears to that of fronts.
    SlopeOfRears,
    /// (–) spread of ln b₁ between vehicles of a kind.
    SlopeSpread,
    /// (m/s) b₀ of fronts and rears.
    NoDamageOfEnds,
    /// (m/s) b₀ of sides.
    NoDamageOfSides,
    /// (–) scale of the error of ln of a recorder's ΔV, including that of its mass.
    RecorderScale,
    /// (–) mean excess of ln of the crush energy over ln of the energy absorbed in the impact with a fixed
    /// object.
    BiasOfObjects,
    /// (–) its spread.
    SpreadOfObjects,
    /// (–) spread of ln of the ΔV of vehicles that struck a fixed object.
    SeverityOfObjects,
}

/// The guess of a figure before the fit.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Guess {
    /// The figure has a normal error.
    Normal { mean: f64, sd: f64 },
    /// The logarithm of the figure has a normal error.
    LogNormal { median: f64, ln_sd: f64 },
}

impl Figure {
    /// Those of two vehicles, in order.
    pub const ALL: [Self; 10] = [
        Self::Bias,
        Self::SpreadOfFronts,
        Self::SpreadOfRears,
        Self::SpreadOfSides,
        Self::SlopeOfSides,
        Self::SlopeOfRears,
        Self::SlopeSpread,
        Self::NoDamageOfEnds,
        Self::NoDamageOfSides,
        Self::RecorderScale,
    ];

    /// Those of two vehicles whose stiffnesses are those of categories: the first of [`ALL`](Self::ALL).
    pub const OF_CATEGORIES: [Self; 4] =
        [Self::Bias, Self::SpreadOfFronts, Self::SpreadOfRears, Self::SpreadOfSides];

    /// Those of a vehicle that struck a fixed object, in order.
    pub const OF_OBJECTS: [Self; 3] = [Self::BiasOfObjects, Self::SpreadOfObjects, Self::SeverityOfObjects];

    /// Its description.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bias => "β, crush energy above what the impact took, ln",
            Self::SpreadOfFronts => "σ_c, its spread between fronts, ln",
            Self::SpreadOfRears => "σ_c where a rear was hit, ln",
            Self::SpreadOfSides => "σ_c where a side was hit, ln",
            Self::SlopeOfSides => "b_1 of sides, by that of fronts",
            Self::SlopeOfRears => "b_1 of rears, by that of fronts",
            Self::SlopeSpread => "spread of b_1 between vehicles of a kind, ln",
            Self::NoDamageOfEnds => "b_0 of fronts and rears, m/s",
            Self::NoDamageOfSides => "b_0 of sides, m/s",
            Self::RecorderScale => "scale of a recorder's error with that of its mass, ln",
            Self::BiasOfObjects => "β, crush energy above what the impact took, ln",
            Self::SpreadOfObjects => "σ_c, its spread, ln",
            Self::SeverityOfObjects => "spread of ΔV before the evidence, ln",
        }
    }

    /// Its value.
    #[must_use]
    pub fn of(self, fitted: &Fitted) -> f64 {
        let ([front, rear, side], [end, _, flank]) = (fitted.slope, fitted.no_damage_speed);
        match self {
            Self::Bias => fitted.crush_bias,
            Self::SpreadOfFronts => fitted.crush_ln_sd[0],
            Self::SpreadOfRears => fitted.crush_ln_sd[1],
            Self::SpreadOfSides => fitted.crush_ln_sd[2],
            Self::SlopeOfSides => side / front,
            Self::SlopeOfRears => rear / front,
            Self::SlopeSpread => fitted.slope_ln_sd,
            Self::NoDamageOfEnds => end,
            Self::NoDamageOfSides => flank,
            Self::RecorderScale => fitted.recorder_ln_scale,
            Self::BiasOfObjects => fitted.objects.misfit.bias,
            Self::SpreadOfObjects => fitted.objects.misfit.ln_sd,
            Self::SeverityOfObjects => fitted.objects.severity.ln_sd,
        }
    }

    pub(crate) fn set(self, value: f64, fitted: &mut Fitted) {
        let (front, speeds) = (fitted.slope[0], &mut fitted.no_damage_speed);
        match self {
            Self::Bias => fitted.crush_bias = value,
            Self::SpreadOfFronts => fitted.crush_ln_sd[0] = value,
            Self::SpreadOfRears => fitted.crush_ln_sd[1] = value,
            Self::SpreadOfSides => fitted.crush_ln_sd[2] = value,
            Self::SlopeOfSides => fitted.slope[2] = value * front,
            Self::SlopeOfRears => fitted.slope[1] = value * front,
            Self::SlopeSpread => fitted.slope_ln_sd = value,
            Self::NoDamageOfEnds => *speeds = [value, value, speeds[2]],
            Self::NoDamageOfSides => speeds[2] = value,
            Self::RecorderScale => fitted.recorder_ln_scale = value,
            Self::BiasOfObjects => fitted.objects.misfit.bias = value,
            Self::SpreadOfObjects => fitted.objects.misfit.ln_sd = value,
            Self::SeverityOfObjects => fitted.objects.severity.ln_sd = value,
        }
    }

    pub(crate) fn guess(self) -> Guess {
        match self {
            Self::Bias | Self::BiasOfObjects => Guess::Normal { mean: 0.0, sd: 1.0 },
            Self::SpreadOfFronts | Self::SpreadOfRears | Self::SpreadOfSides => {
                Guess::LogNormal { median: 0.5, ln_sd: 0.5 }
            }
            Self::SlopeOfSides | Self::SlopeOfRears => Guess::LogNormal { median: 1.0, ln_sd: 0.5 },
            // Half of the spread of ln B between 698 fronts in barrier tests.
            Self::SlopeSpread => Guess::Normal { mean: 0.295, sd: 0.1 },
            // The customary 8 km/h.
            Self::NoDamageOfEnds | Self::NoDamageOfSides => {
                Guess::LogNormal { median: 8.0 / 3.6, ln_sd: 0.4 }
            }
            Self::RecorderScale => Guess::LogNormal { median: 0.13, ln_sd: 0.5 },
            Self::SpreadOfObjects => Guess::LogNormal { median: 0.5, ln_sd: 1.0 },
            Self::SeverityOfObjects => Guess::LogNormal { median: 0.5, ln_sd: 0.5 },
        }
    }

    /// Whether the fit varies the logarithm of the figure, which has to be positive, instead of the figure.
    fn is_varied_by_logarithm(self) -> bool {
        !matches!(self, Self::Bias | Self::BiasOfObjects)
    }

    pub(crate) fn value(self, varied: f64) -> f64 {
        if self.is_varied_by_logarithm() { exp(varied) } else { varied }
    }

    pub(crate) fn varied(self, value: f64) -> f64 {
        if self.is_varied_by_logarithm() { ln(value) } else { value }
    }

    /// dx/dξ of a figure x with respect to the varied number.
    pub(crate) fn slope(self, value: f64) -> f64 {
        if self.is_varied_by_logarithm() { value } else { 1.0 }
    }
}

impl Guess {
    pub(crate) fn middle(self) -> f64 {
        match self {
            Self::Normal { mean: middle, .. } | Self::LogNormal { median: middle, .. } => middle,
        }
    }

    /// (–) logarithm of the density, without its constant.
    pub(crate) fn log_density(self, value: f64) -> f64 {
        let z = match self {
            Self::Normal { mean, sd } => (value - mean) / sd,
            Self::LogNormal { median, ln_sd } => ln(value / median) / ln_sd,
        };
        -0.5 * z * z
    }

    /// (–) its information on the varied number of a figure with this value.
    pub(crate) fn information(self, value: f64) -> f64 {
        let per_sd = match self {
            Self::Normal { sd, .. } => value / sd,
            Self::LogNormal { ln_sd, .. } => ln_sd.recip(),
        };
        per_sd * per_sd
    }
}
