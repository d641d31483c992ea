//! The misfits, fitted to crashes with a recorder.

use std::collections::BTreeMap;

use estimate::{Settings, sample_quietly};
use evidence::{Collision, CrushErrors, Fitted, Impacts, Model, shown_delta_v};
use nalgebra::{SMatrix, SVector};
use pim_core::VehicleId;
use real::Real;
use real::elementary::{exp, ln};
use uncertainty::{LANES, Lanes, Progress, Span, for_each, in_order};

use crate::error::FieldError;
use crate::pair::Pair;

/// A figure that is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// (–) by how much ln of the crush energy exceeds that of the energy absorbed in the impact.
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
}

/// Number of figures.
const N: usize = 10;

/// The guess of a figure before the fit.
#[derive(Clone, Copy, Debug)]
enum Guess {
    /// The figure has a normal error.
    Normal { mean: f64, sd: f64 },
    /// The logarithm of the figure has a normal error.
    LogNormal { median: f64, ln_sd: f64 },
}

impl Figure {
    /// All figures, in order.
    pub const ALL: [Self; N] = [
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
        }
    }

    fn set(self, value: f64, fitted: &mut Fitted) {
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
        }
    }

    fn guess(self) -> Guess {
        match self {
            Self::Bias => Guess::Normal { mean: 0.0, sd: 1.0 },
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
        }
    }

    /// Whether the fit varies the logarithm of the figure, which has to be positive, instead of the figure.
    fn is_varied_by_logarithm(self) -> bool {
        self != Self::Bias
    }

    fn value(self, varied: f64) -> f64 {
        if self.is_varied_by_logarithm() { exp(varied) } else { varied }
    }

    fn varied(self, value: f64) -> f64 {
        if self.is_varied_by_logarithm() { ln(value) } else { value }
    }

    /// dx/dξ of a figure x with respect to the varied number.
    fn slope(self, value: f64) -> f64 {
        if self.is_varied_by_logarithm() { value } else { 1.0 }
    }
}

impl Guess {
    fn middle(self) -> f64 {
        match self {
            Self::Normal { mean: middle, .. } | Self::LogNormal { median: middle, .. } => middle,
        }
    }

    /// (–) logarithm of the density, without its constant.
    fn log_density(self, value: f64) -> f64 {
        let z = match self {
            Self::Normal { mean, sd } => (value - mean) / sd,
            Self::LogNormal { median, ln_sd } => ln(value / median) / ln_sd,
        };
        -0.5 * z * z
    }
}

/// The varied numbers.
type Point = SVector<f64, N>;
type Matrix = SMatrix<f64, N, N>;

fn point(fitted: &Fitted) -> Point {
    Point::from_fn(|row, _| Figure::ALL[row].varied(Figure::ALL[row].of(fitted)))
}

fn figures(at: &Point, base: &Fitted) -> Fitted {
    let mut fitted = *base;
    for (figure, varied) in Figure::ALL.into_iter().zip(at.iter()) {
        figure.set(figure.value(*varied), &mut fitted);
    }
    fitted
}

/// (–) ln of the density of all guesses.
fn log_guess(at: &Point) -> f64 {
    let densities = Figure::ALL.into_iter().zip(at.iter());
    densities.map(|(figure, varied)| figure.guess().log_density(figure.value(*varied))).sum()
}

/// Settings of the fit.
#[derive(Clone, Debug)]
pub struct FitOptions {
    /// Number of particles of each island, as in [`Settings`]: a pair has sixteen times as many draws.
    pub particles: usize,
    /// The random seed, of every pair.
    pub seed: u64,
}

/// Fitted figures.
#[derive(Clone, Debug)]
pub struct FigureFit {
    /// All figures, including those that were not fitted.
    pub fitted: Fitted,
    /// Standard error of each of [`Figure::ALL`], in its unit.
    pub errors: [f64; N],
    /// (–) Σ ln p(recorders | all else).
    pub log_likelihood: f64,
    /// Number of pairs with a recorder.
    pub pairs: usize,
    /// Number of recorders.
    pub recorders: usize,
    /// (–) effective sample size of the draws of the worst pair.
    pub least_draws: f64,
}

/// A pair, with draws of its collision given all evidence except the recorders.
struct Drawn<'a> {
    pair: &'a Pair,
    given: Vec<VehicleId>,
    draws: Vec<Draw>,
}

/// The parts of an impact on whose likelihood the figures depend: nothing else depends on them.
struct Draw {
    /// (J)
    taken: f64,
    /// (–) ln κ of each vehicle divided by its spread: a standard normal number, whatever the spread.
    slopes: [f64; 2],
    /// (–) β of each vehicle.
    no_damage_speeds: [f64; 2],
    /// (m/s) values that recorders without an error would store, for the given ones.
    shown: [f64; 2],
    /// Logarithm of the likelihood of the crush with the figures of the draws.
    drawn_by: f64,
}

impl Draw {
    /// Logarithm of the likelihood of the crush.
    fn crush(&self, collision: &Collision, slope_ln_sd: f64) -> f64 {
        let energy = |i: usize| {
            let factors = [exp(slope_ln_sd * self.slopes[i]), self.no_damage_speeds[i]];
            collision.vehicles[i].crush.map_or(0.0, |crush| crush.energy(factors))
        };
        let misfit = |errors: CrushErrors| errors.log_likelihood([energy(0), energy(1)], self.taken);
        collision.observed.crush.map_or(0.0, misfit)
    }
}

impl<'a> Drawn<'a> {
    fn new(pair: &'a Pair, by: &Fitted, options: &FitOptions) -> Result<Self, FieldError> {
        let refused = |reason: String| FieldError::Estimate { case: pair.case.clone(), reason };
        let truths = pair.truths();
        let collision = pair.collision(by, &[]).map_err(|error| refused(error.to_string()))?;
        let model = Model::new(&collision);
        let settings = Settings::new(options.particles, options.seed);
        let posterior =
            sample_quietly(&model, &model, &settings).map_err(|failure| refused(failure.to_string()))?;
        let mut draws = Vec::with_capacity(posterior.count());
        for block in 0..posterior.count() / LANES {
            let lanes = |column: &Vec<f64>| std::array::from_fn(|lane| column[block * LANES + lane]);
            let values: Vec<Lanes> = posterior.values().iter().map(lanes).map(Lanes::from).collect();
            let (impacts, factors) = (model.leads().impacts(&values), model.leads().crush_factors(&values));
            for (impacted, factors) in impacts.iter().zip(factors) {
                let mut draw = Draw {
                    taken: impacted.taken,
                    slopes: factors.map(|[slope, _]| ln(slope) / by.slope_ln_sd),
                    no_damage_speeds: factors.map(|[_, no_damage_speed]| no_damage_speed),
                    shown: [0.0; 2],
                    drawn_by: 0.0,
                };
                for (id, truth) in &truths {
                    let whole = impacted.outcome.delta_v_magnitude()[id.index()];
                    let along = impacted.outcome.delta_v_components()[id.index()][0];
                    draw.shown[id.index()] = shown_delta_v(whole, along, truth.is_longitudinal);
                }
                draw.drawn_by = draw.crush(&collision, by.slope_ln_sd);
                draws.push(draw);
            }
        }
        Ok(Self { pair, given: truths.into_iter().map(|(id, _)| id).collect(), draws })
    }

    /// ln p(recorders | all else), and effective sample sizes without and with the recorders.
    fn log_likelihood(&self, fitted: &Fitted) -> Option<(f64, [f64; 2])> {
        let collision = self.pair.collision(fitted, &self.given).ok()?;
        let recorders = collision.observed.vehicles.each_ref().map(|vehicle| vehicle.recorder.delta_v);
        let recorders =
            || recorders.iter().enumerate().filter_map(|(i, recorder)| Some((i, recorder.as_ref()?)));
        let (mut without, mut with) = (Sum::default(), Sum::default());
        for draw in &self.draws {
            // w = p(crush | x, figures)/p(crush | x, figures of the draws)
            let weight = draw.crush(&collision, fitted.slope_ln_sd) - draw.drawn_by;
            let stored: f64 = recorders().map(|(i, recorder)| recorder.log_likelihood(draw.shown[i])).sum();
            without.add(weight);
            with.add(weight + stored);
        }
        // p(recorders | all else) = Σ w p(recorders | x)/Σ w
        Some((with.ln() - without.ln(), [without.worth(), with.worth()]))
    }
}

/// Σ exp x, for numbers x that may be large.
struct Sum {
    greatest: f64,
    /// Σ exp(x − greatest), and the sum of the squares.
    sums: [f64; 2],
}

impl Default for Sum {
    fn default() -> Self {
        Self { greatest: f64::NEG_INFINITY, sums: [0.0; 2] }
    }
}

impl Sum {
    fn add(&mut self, x: f64) {
        if x == f64::NEG_INFINITY {
            return;
        }
        if x > self.greatest {
            let shrink = exp(self.greatest - x);
            self.sums = [self.sums[0] * shrink, self.sums[1] * shrink * shrink];
            self.greatest = x;
        }
        let term = exp(x - self.greatest);
        self.sums = [self.sums[0] + term, self.sums[1] + term * term];
    }

    fn ln(&self) -> f64 {
        self.greatest + ln(self.sums[0])
    }

    /// (Σ w)²/Σ w²
    fn worth(&self) -> f64 {
        self.sums[0] * self.sums[0] / self.sums[1]
    }
}

/// Draws of all pairs with a recorder.
pub(crate) struct Likelihood<'a> {
    drawn: Vec<Drawn<'a>>,
    base: Fitted,
}

/// (–) step of the differences, in the varied numbers: less than a tenth of the standard error.
const STEP: f64 = 0.01;
/// (–) a step that promises a smaller increase of the log-likelihood is not taken: it would change no figure
/// by more than a fiftieth of its standard error.
const LEAST_GAIN: f64 = 2e-4;
/// Maximum number of steps of one ascent.
const MOST_STEPS: usize = 30;
/// (–) damping that is added to the second derivatives, one value after the other, until a step leads upward.
/// At the maximum they are 10 to 1000.
const DAMPING: [f64; 6] = [0.0, 10.0, 1e2, 1e3, 1e4, 1e5];

/// The log-likelihood near a point, to second order.
struct Expansion {
    value: f64,
    gradient: Point,
    /// The negative of the second derivatives.
    curvature: Matrix,
}

impl<'a> Likelihood<'a> {
    /// # Errors
    /// If a pair has no estimate, or if `progress` ends the run.
    pub(crate) fn new(
        pairs: &'a [Pair],
        by: &Fitted,
        options: &FitOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Self, FieldError> {
        let wanted: Vec<&Pair> = pairs.iter().filter(|pair| !pair.truths().is_empty()).collect();
        if wanted.is_empty() {
            return Err(FieldError::NothingToJudge { both: false });
        }
        let spans = wanted.iter().map(|pair| Span { samples: 1, work: *pair }).collect();
        // The draws are a little wider than the figures, so that no draw has a very large weight.
        let mut wide = *by;
        wide.crush_ln_sd = wide.crush_ln_sd.map(|spread| spread * WIDENED);
        let drawn = in_order(spans, |pair| Drawn::new(pair, &wide, options), progress);
        if drawn.len() < wanted.len() {
            return Err(FieldError::Ended);
        }
        Ok(Self { drawn: drawn.into_iter().collect::<Result<_, _>>()?, base: *by })
    }

    /// Log-likelihood of the recorders of the pairs that are used, plus that of the guesses, at each point.
    fn at(&self, points: &[Point], is_used: &IsUsed<'_>) -> Vec<f64> {
        let used: Vec<&Drawn<'_>> = self.drawn.iter().filter(|drawn| is_used(drawn.pair)).collect();
        let of_pairs = for_each(&used, |drawn| {
            let ln_p = |point| drawn.log_likelihood(&figures(point, &self.base));
            points.iter().map(|point| ln_p(point).map_or(f64::NEG_INFINITY, |(ln_p, _)| ln_p)).collect()
        });
        let sum = |place: usize| of_pairs.iter().map(|of_pair: &Vec<f64>| of_pair[place]).sum::<f64>();
        points.iter().enumerate().map(|(place, point)| sum(place) + log_guess(point)).collect()
    }

    fn expansion(&self, at: &Point, is_used: &IsUsed<'_>) -> Expansion {
        let couples: Vec<(usize, usize)> = (0..N).flat_map(|k| (0..k).map(move |l| (k, l))).collect();
        let mut points = vec![*at];
        points.extend((0..N).flat_map(|k| [at + step(k), at - step(k)]));
        points.extend(couples.iter().flat_map(|&(k, l)| [at + step(k) + step(l), at - step(k) - step(l)]));
        let values = self.at(&points, is_used);
        let value = values[0];
        // f₊ and f₋ along each axis, and along both of a couple
        let [along, across] = [1..=2 * N, 2 * N + 1..=2 * (N + couples.len())]
            .map(|range| values[range].chunks(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>());
        // ∂f/∂ξ = (f₊ − f₋)/2h
        let gradient = Point::from_fn(|k, _| (along[k][0] - along[k][1]) / (2.0 * STEP));
        // ∂²f/∂ξ² = (f₊ + f₋ − 2f)/h²
        let square = STEP * STEP;
        let own = |k: usize| along[k][0] + along[k][1] - 2.0 * value;
        let mut curvature = Matrix::from_diagonal(&Point::from_fn(|k, _| -own(k) / square));
        for (&(k, l), [plus, minus]) in couples.iter().zip(across) {
            // (∂_k + ∂_l)² = ∂_k² + ∂_l² + 2 ∂_k ∂_l
            let both = plus + minus - 2.0 * value;
            let mixed = -0.5 * (both - own(k) - own(l)) / square;
            (curvature[(k, l)], curvature[(l, k)]) = (mixed, mixed);
        }
        Expansion { value, gradient, curvature }
    }

    /// The figures that maximise the likelihood times the guesses, by Newton's method, and the inverse of the
    /// negative second derivatives there.
    ///
    /// # Errors
    /// If no maximum is found.
    fn maximise(&self, from: &Fitted, is_used: &IsUsed<'_>) -> Result<(Fitted, Matrix), FieldError> {
        let mut at = point(from);
        for _ in 0..MOST_STEPS {
            let Expansion { value, gradient, curvature } = self.expansion(&at, is_used);
            if let Some(triangle) = curvature.cholesky()
                && gradient.dot(&triangle.solve(&gradient)) < LEAST_GAIN
            {
                return Ok((figures(&at, &self.base), triangle.inverse()));
            }
            let better = DAMPING.into_iter().find_map(|damping| {
                let triangle = (curvature + Matrix::identity() * damping).cholesky()?;
                let tried = at + triangle.solve(&gradient);
                (self.at(&[tried], is_used)[0] > value).then_some(tried)
            });
            at = better.ok_or(FieldError::NoMaximum)?;
        }
        Err(FieldError::NoMaximum)
    }

    fn fit(&self, from: &Fitted) -> Result<FigureFit, FieldError> {
        let all = |_: &Pair| true;
        let (fitted, covariance) = self.maximise(from, &all)?;
        let errors = std::array::from_fn(|k| {
            let figure = Figure::ALL[k];
            figure.slope(figure.of(&fitted)) * Real::sqrt(covariance[(k, k)])
        });
        let of_pairs = for_each(&self.drawn, |drawn| drawn.log_likelihood(&fitted));
        let worths = of_pairs.iter().flatten().flat_map(|(_, worths)| worths);
        Ok(FigureFit {
            fitted,
            errors,
            log_likelihood: of_pairs.iter().flatten().map(|(ln_p, _)| ln_p).sum(),
            pairs: self.drawn.len(),
            recorders: self.drawn.iter().map(|drawn| drawn.given.len()).sum(),
            least_draws: worths.copied().fold(f64::INFINITY, f64::min),
        })
    }
}

/// Whether a pair is used.
type IsUsed<'a> = dyn Fn(&Pair) -> bool + Sync + 'a;

/// (–) spread of the crush energy in the draws, relative to that of the figures.
const WIDENED: f64 = 1.2;
/// Rounds of draws: the first uses the guesses, each later one the figures of the round before. The third
/// moves no figure by more than the sampling error of the draws.
const ROUNDS: usize = 3;

fn guesses(base: &Fitted) -> Fitted {
    let mut fitted = *base;
    for figure in Figure::ALL {
        figure.set(figure.guess().middle(), &mut fitted);
    }
    fitted
}

/// Fits the [`Figure`]s to the recorded values, given all other evidence of their collisions; the rest of
/// `base` is unchanged.
///
/// The figures maximise Σ ln p(recorders | crush, PDOF, headings), with weak guesses of each figure. They do
/// not depend on those of `base`. `progress` gets the number of finished pairs and of all, once for each
/// round of draws.
///
/// # Errors
/// [`FieldError::NothingToJudge`] without recorders, [`FieldError::Estimate`] if a pair has no estimate,
/// [`FieldError::NoMaximum`], and [`FieldError::Ended`] if `progress` ends the run.
pub fn fit(
    pairs: &[Pair],
    base: &Fitted,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<FigureFit, FieldError> {
    Ok(settled(pairs, base, options, progress)?.0)
}

fn settled<'a>(
    pairs: &'a [Pair],
    base: &Fitted,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<(FigureFit, Likelihood<'a>), FieldError> {
    let mut by = guesses(base);
    for _ in 1..ROUNDS {
        by = Likelihood::new(pairs, &by, options, progress)?.fit(&by)?.fitted;
    }
    let likelihood = Likelihood::new(pairs, &by, options, progress)?;
    Ok((likelihood.fit(&by)?, likelihood))
}

/// The fit of all pairs, and the fits without the crashes of each of `folds` folds, of which there are at
/// least two. The fold of a crash is its position in the file, counted by crash, modulo `folds`.
///
/// # Errors
/// As [`fit`].
pub fn fit_folds(
    pairs: &[Pair],
    base: &Fitted,
    folds: usize,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<(FigureFit, Folds), FieldError> {
    let folds = folds.max(2);
    let mut of_case: BTreeMap<String, usize> = BTreeMap::new();
    for pair in pairs {
        let next = of_case.len() % folds;
        of_case.entry(pair.case.clone()).or_insert(next);
    }
    let (fit, likelihood) = settled(pairs, base, options, progress)?;
    let without = |fold: usize| {
        let is_used = |pair: &Pair| of_case.get(&pair.case).is_none_or(|of| *of != fold);
        likelihood.maximise(&fit.fitted, &is_used).map(|(fitted, _)| fitted)
    };
    let fitted = (0..folds).map(without).collect::<Result<_, _>>()?;
    Ok((fit, Folds { of_case, fitted }))
}

/// Figures for crashes that were not used in their fit.
#[derive(Clone, Debug)]
pub struct Folds {
    of_case: BTreeMap<String, usize>,
    fitted: Vec<Fitted>,
}

impl Folds {
    /// The figures for a pair: fitted to all folds except that of its crash.
    #[must_use]
    pub fn of(&self, pair: &Pair) -> Option<Fitted> {
        self.fitted.get(*self.of_case.get(&pair.case)?).copied()
    }

    /// The figures of each fold, fitted to all others.
    #[must_use]
    pub fn fitted(&self) -> &[Fitted] {
        &self.fitted
    }
}

fn step(k: usize) -> Point {
    let mut step = Point::zeros();
    step[k] = STEP;
    step
}

#[cfg(test)]
mod tests;
