//! Distributions of inputs, defined by numbers that an engineer can give.

use real::elementary::exp;

use crate::error::InvalidDistribution;
use crate::model::{LANES, Lanes};
use crate::normal::{self, NormalPair, Tails};
use crate::points::independent;
use crate::random::{bits, bits_of_block, key, unit};

/// Minimum probability of a normal distribution between its bounds.
///
/// If they leave less, nearly all of the distribution is impossible, so the value, the deviation or the
/// bounds are wrong.
pub const MIN_KEPT: f64 = 1e-6;

/// The shape of a distribution, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A value with a standard deviation, before any [`Truncation`].
    Normal {
        /// (unit of the input) μ.
        mean: f64,
        /// (unit of the input) σ.
        sd: f64,
    },
    /// A median times a factor whose logarithm is normally distributed.
    LogNormal {
        /// (unit of the input) the median.
        median: f64,
        /// (–) σ of the natural logarithm.
        ln_sd: f64,
    },
    /// Every value between two bounds is equally likely.
    Uniform {
        /// (unit of the input) least value.
        low: f64,
        /// (unit of the input) greatest value.
        high: f64,
    },
    /// Triangular between two bounds, with the most likely value between them.
    Triangular {
        /// (unit of the input) least value.
        low: f64,
        /// (unit of the input) most likely value.
        mode: f64,
        /// (unit of the input) greatest value.
        high: f64,
    },
}

/// Bounds that truncate a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truncation {
    /// (unit of the input) least value, or −∞.
    pub low: f64,
    /// (unit of the input) greatest value, or +∞.
    pub high: f64,
    /// Probability of the normal distribution between the bounds; 1 if they are too far out to matter.
    pub kept: f64,
}

/// Distribution of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distribution {
    shape: Shape,
    truncation: Option<Truncation>,
    transform: Transform,
}

/// The transform of a uniform number u in (0, 1) into a value.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Transform {
    /// centre + scale·Φ⁻¹(start + span·u), with 1 − u for u if mirrored, clamped to [low, high].
    ///
    /// Bounds above the mean are mirrored to below it, where Φ loses no digits. Values of Φ⁻¹ within ±reach
    /// stay within the bounds.
    Normal { centre: f64, scale: f64, start: f64, span: f64, mirrored: bool, low: f64, high: f64, reach: f64 },
    /// median·exp(scale·Φ⁻¹(u)).
    LogNormal { median: f64, scale: f64 },
    /// low + span·u, at most high.
    Uniform { low: f64, span: f64, high: f64 },
    /// low + √(u·rise) for u below `share`, that of the mode, else high − √((1 − u)·fall).
    Triangular { low: f64, high: f64, rise: f64, fall: f64, share: f64 },
}

impl Distribution {
    /// Normal, with mean and standard deviation.
    ///
    /// # Errors
    /// If a number is not finite or `sd` is not greater than zero.
    pub fn normal(mean: f64, sd: f64) -> Result<Self, InvalidDistribution> {
        for (name, value) in [("mean", mean), ("standard deviation", sd)] {
            finite(name, value)?;
        }
        if sd <= 0.0 {
            return Err(InvalidDistribution::NoDeviation { sd });
        }
        // Samples lie within 8.3 standard deviations.
        finite("end of the range", mean.abs() + 10.0 * sd)?;
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        let transform = Transform::Normal {
            centre: mean,
            scale: sd,
            start: 0.0,
            span: 1.0,
            mirrored: false,
            low,
            high,
            reach: f64::INFINITY,
        };
        Ok(Self { shape: Shape::Normal { mean, sd }, truncation: None, transform })
    }

    /// Normal, truncated to [low, high]: the part of the distribution outside is removed, and the rest is
    /// scaled up to 1.
    ///
    /// `mean` and `sd` are those before truncation; [`mean`](Self::mean) and [`sd`](Self::sd) give those
    /// after it. Either bound may be infinite.
    ///
    /// # Errors
    /// Those of [`normal`](Self::normal), or if a bound is NaN, `low` is not below `high`, or the probability
    /// between them is below [`MIN_KEPT`].
    pub fn truncated_normal(mean: f64, sd: f64, low: f64, high: f64) -> Result<Self, InvalidDistribution> {
        let whole = Self::normal(mean, sd)?;
        for (name, value) in [("lower bound", low), ("upper bound", high)] {
            if value.is_nan() {
                return Err(InvalidDistribution::NotFinite { name, value });
            }
        }
        ordered(low, high)?;

        // α = (low − μ)/σ, β = (high − μ)/σ
        let (alpha, beta) = ((low - mean) / sd, (high - mean) / sd);
        let mirrored = alpha + beta > 0.0;
        let (below, above) = if mirrored { (-beta, -alpha) } else { (alpha, beta) };
        let start = normal::cumulative(below);
        let kept = normal::cumulative(above) - start;
        if kept < MIN_KEPT {
            return Err(InvalidDistribution::NothingKept { mean, sd, low, high, kept });
        }
        let scale = if mirrored { -sd } else { sd };
        let reach = reach(mean, sd, low, high);
        let transform =
            Transform::Normal { centre: mean, scale, start, span: kept, mirrored, low, high, reach };
        Ok(Self { truncation: Some(Truncation { low, high, kept }), transform, ..whole })
    }

    /// Log-normal: the median times e to the power of a normally distributed number with mean 0 and standard
    /// deviation `ln_sd`. All values are greater than zero.
    ///
    /// # Errors
    /// If a number is not finite, or not greater than zero, or the variance is not finite.
    pub fn log_normal(median: f64, ln_sd: f64) -> Result<Self, InvalidDistribution> {
        finite("median", median)?;
        finite("standard deviation", ln_sd)?;
        if median <= 0.0 {
            return Err(InvalidDistribution::MedianNotPositive { median });
        }
        if ln_sd <= 0.0 {
            return Err(InvalidDistribution::NoDeviation { sd: ln_sd });
        }
        // Samples lie within 8.3 standard deviations; the variance needs the square.
        let end = median * exp(10.0 * ln_sd);
        finite("square of the end of the range", end * end)?;
        let transform = Transform::LogNormal { median, scale: ln_sd };
        let distribution = Self { shape: Shape::LogNormal { median, ln_sd }, truncation: None, transform };
        finite("standard deviation of the values", distribution.sd())?;
        Ok(distribution)
    }

    /// Uniform between two bounds.
    ///
    /// # Errors
    /// If a number is not finite or `low` is not below `high`.
    pub fn uniform(low: f64, high: f64) -> Result<Self, InvalidDistribution> {
        bounds(low, high)?;
        let transform = Transform::Uniform { low, span: high - low, high };
        Ok(Self { shape: Shape::Uniform { low, high }, truncation: None, transform })
    }

    /// Triangular between two bounds, with the most likely value at the mode, which may equal a bound.
    ///
    /// # Errors
    /// If a number is not finite, `low` is not below `high` or the mode is outside.
    pub fn triangular(low: f64, mode: f64, high: f64) -> Result<Self, InvalidDistribution> {
        finite("mode", mode)?;
        bounds(low, high)?;
        if !(low..=high).contains(&mode) {
            return Err(InvalidDistribution::ModeOutside { low, mode, high });
        }
        let width = high - low;
        // F(mode) = (mode − low)/(high − low)
        let share = (mode - low) / width;
        let (rise, fall) = (width * (mode - low), width * (high - mode));
        finite("square of the width", width * width)?;
        let transform = Transform::Triangular { low, high, rise, fall, share };
        Ok(Self { shape: Shape::Triangular { low, mode, high }, truncation: None, transform })
    }

    /// The shape and its parameters.
    #[must_use]
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// The bounds that truncate a normal distribution, for reports.
    #[must_use]
    pub fn truncation(&self) -> Option<Truncation> {
        self.truncation
    }

    /// (unit of the input) the quantile at the probability `u`, for 0 ≤ u ≤ 1.
    #[must_use]
    pub fn quantile(&self, u: f64) -> f64 {
        let mut lanes = [u];
        self.transform(&mut lanes);
        lanes[0]
    }

    /// Turns standard normal numbers into values (unit of the input): each is the quantile at the probability
    /// of the number.
    ///
    /// Normal and log-normal distributions use the numbers directly, so that they are unbounded; the others
    /// clip them at 8.2 standard deviations.
    #[inline(always)]
    pub fn from_standard_normals<const N: usize>(&self, lanes: &mut [f64; N]) {
        match self.transform {
            Transform::Normal { centre, scale, .. } if self.truncation.is_none() => {
                for lane in lanes {
                    // x = μ + σ z
                    *lane = centre + scale * *lane;
                }
            }
            Transform::LogNormal { median, scale } => {
                for lane in lanes {
                    // x = m exp(s z)
                    *lane = median * exp(scale * *lane);
                }
            }
            _ => {
                normal::shares(lanes);
                self.transform(lanes);
            }
        }
    }

    /// (unit of the input) mean, after truncation.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.moments().0
    }

    /// (unit of the input) standard deviation, after truncation.
    #[must_use]
    pub fn sd(&self) -> f64 {
        self.moments().1
    }

    fn moments(&self) -> (f64, f64) {
        match (self.shape, self.truncation) {
            (Shape::Normal { mean, sd }, None) => (mean, sd),
            (Shape::Normal { mean, sd }, Some(Truncation { low, high, .. })) => {
                let (shift, factor) = normal::truncated_moments((low - mean) / sd, (high - mean) / sd);
                (mean + sd * shift, sd * factor)
            }
            // μ = m exp(s²/2), σ² = μ² (exp(s²) − 1)
            (Shape::LogNormal { median, ln_sd }, _) => {
                let mean = median * exp(0.5 * ln_sd * ln_sd);
                (mean, mean * (exp(ln_sd * ln_sd) - 1.0).sqrt())
            }
            // μ = (a + b)/2, σ² = (b − a)²/12
            (Shape::Uniform { low, high }, _) => (0.5 * low + 0.5 * high, (high - low) / 12.0_f64.sqrt()),
            // μ = (a + c + b)/3, σ² = (a² + b² + c² − ab − ac − bc)/18 = ((b − a)² + (c − a)² − (b − a)(c −
            // a))/18
            (Shape::Triangular { low, mode, high }, _) => {
                let (width, rise) = (high - low, mode - low);
                let variance = (width * width + rise * rise - width * rise) / 18.0;
                (low / 3.0 + mode / 3.0 + high / 3.0, variance.sqrt())
            }
        }
    }

    /// Independent values from a random sequence, from the sample `first` on: uniform numbers turned into
    /// values by [`transform`](Self::transform), or, for normal and log-normal distributions, by
    /// [`normal::box_muller`].
    #[inline(always)]
    pub(crate) fn draw(&self, key: u64, first: u64, lanes: &mut Lanes) {
        match self.transform {
            Transform::Normal { centre, scale, reach, .. } => {
                // x = μ + σ·z
                if draw_normal(key, first, lanes, reach, |z| centre + scale * z) {
                    self.draw_again(key, first, lanes);
                }
            }
            Transform::LogNormal { median, scale } => {
                draw_normal(key, first, lanes, f64::INFINITY, |z| median * exp(scale * z));
            }
            Transform::Uniform { .. } | Transform::Triangular { .. } => {
                independent(key, first, lanes);
                self.transform(lanes);
            }
        }
    }

    /// Redraws the values beyond a bound, if there are any.
    #[cold]
    #[inline(never)]
    fn draw_again(&self, sequence: u64, first: u64, lanes: &mut Lanes) {
        let Some(Truncation { low, high, .. }) = self.truncation else { return };
        let is_cut = |value: f64| value < low || value > high;
        if !lanes.iter().any(|lane| is_cut(*lane)) {
            return;
        }
        let mut shares = Lanes::ZERO;
        independent(sequence, first, &mut shares);
        for (index, lane) in lanes.iter_mut().enumerate() {
            if is_cut(*lane) {
                // A uniform number independent of the two that led out of the bounds.
                let pair = [shares[index % HALF], shares[index % HALF + HALF]];
                *lane = self.quantile(unit(bits(key(pair[0].to_bits(), &[pair[1].to_bits()]), index as u64)));
            }
        }
    }

    /// Turns uniform numbers in (0, 1) into values. A lane gets the same bits as a single call.
    #[inline(always)]
    pub(crate) fn transform<const N: usize>(&self, lanes: &mut [f64; N]) {
        if self.prepare(lanes) {
            normal::quantiles(lanes);
        }
        self.finish(lanes);
    }

    /// The same for columns of all inputs, repeating the inputs for all columns.
    #[inline(always)]
    pub(crate) fn transform_all(inputs: &[Self], columns: &mut [Lanes]) {
        let mut tails = Tails::new();
        for (index, input) in (0..columns.len()).zip(inputs.iter().cycle()) {
            if let Some(column) = columns.get_mut(index)
                && input.prepare(column)
            {
                tails.gather(column, index * LANES);
            }
            if tails.are_many() {
                tails.settle_groups(|place, quantile| put(columns, place, quantile));
            }
        }
        tails.settle(|place, quantile| put(columns, place, quantile));
        for (column, input) in columns.iter_mut().zip(inputs.iter().cycle()) {
            input.finish(column);
        }
    }

    /// Turns uniform numbers into probabilities of the standard normal distribution, whose quantiles
    /// [`finish`](Self::finish) expects; `false` if it expects the uniform numbers unchanged.
    #[inline(always)]
    fn prepare<const N: usize>(&self, lanes: &mut [f64; N]) -> bool {
        match self.transform {
            Transform::Normal { start, span, mirrored, .. } => {
                // Φ(α) + u·(Φ(β) − Φ(α))
                for lane in lanes {
                    let u = if mirrored { 1.0 - *lane } else { *lane };
                    *lane = start + span * u;
                }
                true
            }
            Transform::LogNormal { .. } => true,
            Transform::Uniform { .. } | Transform::Triangular { .. } => false,
        }
    }

    #[inline(always)]
    fn finish<const N: usize>(&self, lanes: &mut [f64; N]) {
        match self.transform {
            Transform::Normal { centre, scale, low, high, .. } => {
                for lane in lanes {
                    // x = μ ± σ·Φ⁻¹(Φ(α) + u·(Φ(β) − Φ(α)))
                    let x = centre + scale * *lane;
                    let x = if x < low { low } else { x };
                    *lane = if x > high { high } else { x };
                }
            }
            Transform::LogNormal { median, scale } => {
                for lane in lanes {
                    // x = m exp(s Φ⁻¹(u))
                    *lane = median * exp(scale * *lane);
                }
            }
            Transform::Uniform { low, span, high } => {
                for lane in lanes {
                    // x = a + u·(b − a)
                    let x = low + span * *lane;
                    *lane = if x > high { high } else { x };
                }
            }
            Transform::Triangular { low, high, rise, fall, share } => {
                for lane in lanes {
                    let u = *lane;
                    // x = a + √(u(b − a)(c − a)) below the mode, b − √((1 − u)(b − a)(b − c)) above
                    let rising = low + (u * rise).sqrt();
                    let falling = high - ((1.0 - u) * fall).sqrt();
                    *lane = if u < share { rising } else { falling };
                }
            }
        }
    }
}

/// Puts a number at a place in the columns, counted from the first lane of the first column.
#[inline(always)]
fn put(columns: &mut [Lanes], place: usize, number: f64) {
    if let Some(column) = columns.get_mut(place / LANES) {
        column[place % LANES] = number;
    }
}

const HALF: usize = LANES / 2;

/// Draws independent standard normal numbers, transformed by `value` in the same loop, and returns whether a
/// pair of them lies beyond the reach.
#[inline(always)]
fn draw_normal(key: u64, first: u64, lanes: &mut Lanes, reach: f64, value: impl Fn(f64) -> f64) -> bool {
    let (ones, others) = lanes.split_at_mut(HALF);
    let pairs = bits_of_block(key, first).zip(bits_of_block(key, first + HALF as u64));
    let mut is_beyond = false;
    for ((one, other), (first, second)) in ones.iter_mut().zip(others).zip(pairs) {
        let NormalPair { numbers: [z1, z2], radius } = NormalPair::of([unit(first), unit(second)]);
        (*one, *other) = (value(z1), value(z2));
        is_beyond |= radius > reach;
    }
    is_beyond
}

/// Number of standard deviations around the mean that certainly lie within the bounds.
fn reach(mean: f64, sd: f64, low: f64, high: f64) -> f64 {
    /// Allowance for rounding.
    const SURELY: f64 = 1.0 - 1e-9;
    SURELY * (mean - low).min(high - mean) / sd
}

fn finite(name: &'static str, value: f64) -> Result<(), InvalidDistribution> {
    if value.is_finite() { Ok(()) } else { Err(InvalidDistribution::NotFinite { name, value }) }
}

fn ordered(low: f64, high: f64) -> Result<(), InvalidDistribution> {
    if low < high { Ok(()) } else { Err(InvalidDistribution::Empty { low, high }) }
}

fn bounds(low: f64, high: f64) -> Result<(), InvalidDistribution> {
    for (name, value) in [("lower bound", low), ("upper bound", high), ("width of the range", high - low)] {
        finite(name, value)?;
    }
    ordered(low, high)
}

#[cfg(test)]
mod tests {
    use super::Distribution;
    use crate::model::{LANES, Lanes};
    use crate::random::{bits, unit};

    /// Enough normal numbers for those in the tails to fill their room several times over, with other
    /// distributions in between.
    #[test]
    fn columns_together_have_the_bits_of_each_alone() {
        let of = |number: u8| match number % 5 {
            0 => Distribution::uniform(1.0, 2.0),
            1 => Distribution::truncated_normal(3.0, 0.5, 2.5, 4.0),
            2 => Distribution::log_normal(2.0, 0.3),
            _ => Distribution::normal(5.0, f64::from(number)),
        };
        let inputs: Vec<Distribution> = (1..40).map(|number| of(number).unwrap()).collect();
        let share = |index: usize| unit(bits(31, index as u64));
        let shares = |column: usize| Lanes::from(std::array::from_fn(|lane| share(column * LANES + lane)));
        let mut columns: Vec<Lanes> = (0..2 * inputs.len()).map(shares).collect();
        Distribution::transform_all(&inputs, &mut columns);
        for (number, (column, input)) in columns.iter().zip(inputs.iter().cycle()).enumerate() {
            for (lane, value) in column.iter().enumerate() {
                let alone = input.quantile(share(number * LANES + lane));
                assert_eq!(value.to_bits(), alone.to_bits(), "column {number}, lane {lane}");
            }
        }
    }
}
