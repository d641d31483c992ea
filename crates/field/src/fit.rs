//! The misfits, fitted to crashes with a recorder.

use std::collections::BTreeMap;

use estimate::{ParticleSettings, sample_quietly};
use evidence::{
    Collision, CollisionModel, CrushErrors, FIGURES, FigureErrors, Fitted, Impacts, ObjectFigures, Severity,
    shown_delta_v,
};
use nalgebra::{DMatrix, DVector};
use pim_core::VehicleId;
use real::Real;
use real::elementary::{exp, ln};
use uncertainty::{LANES, Lanes, Progress, Span, for_each, in_order};

use crate::crash::Crash;
use crate::error::FieldError;
use crate::figure::Figure;

/// The varied numbers.
type Point = DVector<f64>;
type Matrix = DMatrix<f64>;

fn point(set: &[Figure], fitted: &Fitted) -> Point {
    Point::from_iterator(set.len(), set.iter().map(|figure| figure.varied(figure.of(fitted))))
}

fn figures(set: &[Figure], at: &Point, base: &Fitted) -> Fitted {
    let mut fitted = *base;
    for (figure, varied) in set.iter().zip(at.iter()) {
        figure.set(figure.value(*varied), &mut fitted);
    }
    fitted
}

/// (–) ln of the density of all guesses.
fn log_guess(set: &[Figure], at: &Point) -> f64 {
    let densities = set.iter().zip(at.iter());
    densities.map(|(figure, varied)| figure.guess().log_density(figure.value(*varied))).sum()
}

/// Settings of the fit.
#[derive(Clone, Debug)]
pub struct FitOptions {
    /// Number of particles of each island, as in [`ParticleSettings`]: a pair has sixteen times as many
    /// draws.
    pub particles: usize,
    /// The random seed, of every pair.
    pub seed: u64,
}

/// Fitted figures.
#[derive(Clone, Debug)]
pub struct FigureFit {
    /// All figures, including those that were not fitted.
    pub fitted: Fitted,
    /// The figures that were fitted.
    pub figures: &'static [Figure],
    /// Standard error of each, in its unit, clustered by crash.
    pub errors: Vec<f64>,
    /// The same if each crash followed the model: by the second derivatives alone.
    pub errors_of_model: Vec<f64>,
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
struct Drawn<'a, C> {
    pair: &'a C,
    given: Vec<VehicleId>,
    draws: Vec<Draw>,
}

/// The parts of an impact on which the likelihood of the figures depends.
struct Draw {
    /// (J)
    taken: f64,
    /// (–) ln κ of each vehicle divided by its spread: a standard normal number, whatever the spread.
    slopes: [f64; 2],
    /// (–) β of each vehicle.
    no_damage_speeds: [f64; 2],
    /// (m/s) values that recorders without an error would store, for the given ones.
    shown: [f64; 2],
    /// (m/s) geometric mean of both ΔV, as in [`Severity`](evidence::Severity).
    severity: f64,
    /// Logarithm of the likelihood of the crush and of the density of the severity with the figures of the
    /// draws.
    drawn_by: f64,
}

impl Draw {
    /// Logarithm of the likelihood of the crush and of the density of the severity.
    fn crush(&self, collision: &Collision, slope_ln_sd: f64) -> f64 {
        let energy = |i: usize| {
            let factors = [exp(slope_ln_sd * self.slopes[i]), self.no_damage_speeds[i]];
            collision.vehicles[i].crush.map_or(0.0, |crush| crush.energy(factors))
        };
        let misfit = |errors: CrushErrors| errors.log_likelihood([energy(0), energy(1)], self.taken);
        let severity = |of: Severity| {
            let z = ln(self.severity / of.median) / of.ln_sd;
            -0.5 * z * z - ln(of.ln_sd)
        };
        collision.observed.crush.map_or(0.0, misfit) + collision.observed.severity.map_or(0.0, severity)
    }
}

impl<'a, C: Crash> Drawn<'a, C> {
    fn new(pair: &'a C, by: &Fitted, options: &FitOptions) -> Result<Self, FieldError> {
        let refused = |reason: String| FieldError::Estimate { case: pair.case().to_owned(), reason };
        let truths = pair.truths();
        let collision = pair.known(None, by, &[]).map_err(|error| refused(error.to_string()))?;
        let model = CollisionModel::new(&collision);
        let settings = ParticleSettings::new(options.particles, options.seed);
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
                    severity: severity(impacted.outcome.delta_v_magnitude()),
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
        let collision = self.pair.known(None, fitted, &self.given).ok()?;
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

/// (m/s) geometric mean of both ΔV; that of the vehicle if the other is a fixed object.
fn severity(delta_v: [f64; 2]) -> f64 {
    match delta_v {
        [one, 0.0] | [0.0, one] => one,
        [one, two] => Real::sqrt(one * two),
    }
}

/// Draws of all crashes with a recorder.
pub(crate) struct Likelihood<'a, C> {
    drawn: Vec<Drawn<'a, C>>,
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

/// Figures that maximise the likelihood times the guesses, with the covariance of the varied numbers.
struct Maximum {
    fitted: Fitted,
    /// By the gradients of the crashes, whatever their distribution (P. J. Huber, Proceedings of the Fifth
    /// Berkeley Symposium 1 (1967) 221).
    clustered: Matrix,
    /// By the second derivatives alone.
    of_model: Matrix,
}

/// The log-likelihood near a point, to second order.
struct Expansion {
    value: f64,
    gradient: Point,
    /// The negative of the second derivatives.
    curvature: Matrix,
}

impl<'a, C: Crash> Likelihood<'a, C> {
    /// # Errors
    /// If a pair has no estimate, or if `progress` ends the run.
    pub(crate) fn new(
        pairs: &'a [C],
        by: &Fitted,
        options: &FitOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Self, FieldError> {
        let wanted: Vec<&C> = pairs.iter().filter(|pair| !pair.truths().is_empty()).collect();
        if wanted.is_empty() {
            return Err(FieldError::NothingToJudge { both: false });
        }
        let spans = wanted.iter().map(|pair| Span { samples: 1, work: *pair }).collect();
        // The draws are a little wider than the figures, so that no draw has a very large weight.
        let mut wide = exact(by);
        wide.crush_ln_sd = wide.crush_ln_sd.map(|spread| spread * WIDENED);
        wide.objects.misfit.ln_sd *= WIDENED;
        let drawn = in_order(spans, |pair| Drawn::new(pair, &wide, options), progress);
        if drawn.len() < wanted.len() {
            return Err(FieldError::Ended);
        }
        Ok(Self { drawn: drawn.into_iter().collect::<Result<_, _>>()?, base: exact(by) })
    }

    /// Log-likelihood of the recorders of each pair that is used, at each point.
    fn of_pairs(&self, points: &[Point], is_used: &IsUsed<'_, C>) -> Vec<Vec<f64>> {
        let used: Vec<&Drawn<'_, C>> = self.drawn.iter().filter(|drawn| is_used(drawn.pair)).collect();
        for_each(&used, |drawn| {
            let ln_p = |point| drawn.log_likelihood(&figures(C::FIGURES, point, &self.base));
            points.iter().map(|point| ln_p(point).map_or(f64::NEG_INFINITY, |(ln_p, _)| ln_p)).collect()
        })
    }

    /// The sum over the crashes that are used of g gᵀ, with g the gradient of the log-likelihood of a crash.
    fn spread_of_gradients(&self, at: &Point, is_used: &IsUsed<'_, C>) -> Matrix {
        let n = C::FIGURES.len();
        let points: Vec<Point> = (0..n).flat_map(|k| [at + step(n, k), at - step(n, k)]).collect();
        let of_pairs = self.of_pairs(&points, is_used);
        let used = self.drawn.iter().filter(|drawn| is_used(drawn.pair));
        let mut of_crashes: BTreeMap<&str, Point> = BTreeMap::new();
        for (drawn, values) in used.zip(&of_pairs) {
            // ∂f/∂ξ = (f₊ − f₋)/2h
            let gradient = Point::from_fn(n, |k, _| (values[2 * k] - values[2 * k + 1]) / (2.0 * STEP));
            *of_crashes.entry(drawn.pair.case()).or_insert_with(|| Point::zeros(n)) += gradient;
        }
        let squares = of_crashes.values().map(|gradient| gradient * gradient.transpose());
        squares.fold(Matrix::zeros(n, n), |sum, square| sum + square)
    }

    /// Log-likelihood of the recorders of the pairs that are used, plus that of the guesses, at each point.
    fn at(&self, points: &[Point], is_used: &IsUsed<'_, C>) -> Vec<f64> {
        let of_pairs = self.of_pairs(points, is_used);
        let sum = |place: usize| of_pairs.iter().map(|of_pair: &Vec<f64>| of_pair[place]).sum::<f64>();
        points.iter().enumerate().map(|(place, point)| sum(place) + log_guess(C::FIGURES, point)).collect()
    }

    fn expansion(&self, at: &Point, is_used: &IsUsed<'_, C>) -> Expansion {
        let n = C::FIGURES.len();
        let couples: Vec<(usize, usize)> = (0..n).flat_map(|k| (0..k).map(move |l| (k, l))).collect();
        let mut points = vec![at.clone()];
        points.extend((0..n).flat_map(|k| [at + step(n, k), at - step(n, k)]));
        points.extend(
            couples.iter().flat_map(|&(k, l)| [at + step(n, k) + step(n, l), at - step(n, k) - step(n, l)]),
        );
        let values = self.at(&points, is_used);
        let value = values[0];
        // f₊ and f₋ along each axis, and along both of a couple
        let [along, across] = [1..=2 * n, 2 * n + 1..=2 * (n + couples.len())]
            .map(|range| values[range].chunks(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>());
        // ∂f/∂ξ = (f₊ − f₋)/2h
        let gradient = Point::from_fn(n, |k, _| (along[k][0] - along[k][1]) / (2.0 * STEP));
        // ∂²f/∂ξ² = (f₊ + f₋ − 2f)/h²
        let square = STEP * STEP;
        let own = |k: usize| along[k][0] + along[k][1] - 2.0 * value;
        let mut curvature = Matrix::from_diagonal(&Point::from_fn(n, |k, _| -own(k) / square));
        for (&(k, l), [plus, minus]) in couples.iter().zip(across) {
            // (∂_k + ∂_l)² = ∂_k² + ∂_l² + 2 ∂_k ∂_l
            let both = plus + minus - 2.0 * value;
            let mixed = -0.5 * (both - own(k) - own(l)) / square;
            (curvature[(k, l)], curvature[(l, k)]) = (mixed, mixed);
        }
        Expansion { value, gradient, curvature }
    }

    /// The figures that maximise the likelihood times the guesses, by Newton's method.
    ///
    /// # Errors
    /// If no maximum is found.
    fn maximise(&self, from: &Fitted, is_used: &IsUsed<'_, C>) -> Result<Maximum, FieldError> {
        let mut at = point(C::FIGURES, from);
        let n = C::FIGURES.len();
        for _ in 0..MOST_STEPS {
            let Expansion { value, gradient, curvature } = self.expansion(&at, is_used);
            if let Some(triangle) = curvature.clone().cholesky()
                && gradient.dot(&triangle.solve(&gradient)) < LEAST_GAIN
            {
                return Ok(self.maximum(&at, &triangle.inverse(), is_used));
            }
            let better = DAMPING.into_iter().find_map(|damping| {
                let triangle = (&curvature + Matrix::identity(n, n) * damping).cholesky()?;
                let tried = &at + triangle.solve(&gradient);
                (self.at(std::slice::from_ref(&tried), is_used)[0] > value).then_some(tried)
            });
            at = better.ok_or(FieldError::NoMaximum)?;
        }
        Err(FieldError::NoMaximum)
    }

    /// The figures at the maximum with their errors, where `of_model` is the inverse of the negative second
    /// derivatives.
    fn maximum(&self, at: &Point, of_model: &Matrix, is_used: &IsUsed<'_, C>) -> Maximum {
        let mut fitted = figures(C::FIGURES, at, &self.base);
        let information = C::FIGURES.iter().map(|figure| figure.guess().information(figure.of(&fitted)));
        let information = Point::from_iterator(C::FIGURES.len(), information);
        let spread = self.spread_of_gradients(at, is_used) + Matrix::from_diagonal(&information);
        // H⁻¹ (Σ g gᵀ + P) H⁻¹
        let clustered = of_model * spread * of_model;
        keep(&clustered, C::FIGURES, &mut fitted);
        Maximum { fitted, clustered, of_model: of_model.clone() }
    }

    fn fit(&self, from: &Fitted) -> Result<FigureFit, FieldError> {
        let Maximum { fitted, clustered, of_model } = self.maximise(from, &|_| true)?;
        let errors = |covariance: &Matrix| {
            let of = |(k, figure): (usize, &Figure)| {
                figure.slope(figure.of(&fitted)) * Real::sqrt(covariance[(k, k)])
            };
            C::FIGURES.iter().enumerate().map(of).collect()
        };
        let (errors, errors_of_model) = (errors(&clustered), errors(&of_model));
        let of_pairs = for_each(&self.drawn, |drawn| drawn.log_likelihood(&fitted));
        let worths = of_pairs.iter().flatten().flat_map(|(_, worths)| worths);
        Ok(FigureFit {
            fitted,
            figures: C::FIGURES,
            errors,
            errors_of_model,
            log_likelihood: of_pairs.iter().flatten().map(|(ln_p, _)| ln_p).sum(),
            pairs: self.drawn.len(),
            recorders: self.drawn.iter().map(|drawn| drawn.given.len()).sum(),
            least_draws: worths.copied().fold(f64::INFINITY, f64::min),
        })
    }
}

/// Whether a pair is used.
type IsUsed<'a, C> = dyn Fn(&C) -> bool + Sync + 'a;

/// (–) spread of the crush energy in the draws, relative to that of the figures.
const WIDENED: f64 = 1.2;
/// Rounds of draws: the first uses the guesses, each later one the figures of the round before. The third
/// moves no figure by more than the sampling error of the draws.
const ROUNDS: usize = 3;

/// The same figures, taken as exact: the fit needs the consequences of each value.
fn exact(fitted: &Fitted) -> Fitted {
    let errors = FigureErrors { covariance: [[0.0; FIGURES]; FIGURES], ..fitted.errors };
    let objects = ObjectFigures { covariance: [[0.0; 2]; 2], ..fitted.objects };
    Fitted { errors, objects, ..*fitted }
}

/// Keeps the covariance of the varied numbers as the errors of their figures.
fn keep(covariance: &Matrix, set: &[Figure], fitted: &mut Fitted) {
    let entry = |one: usize, two: usize| covariance[(one, two)];
    if set == Figure::OF_OBJECTS {
        fitted.objects.covariance = std::array::from_fn(|k| std::array::from_fn(|l| entry(k, l)));
        return;
    }
    for (k, row) in fitted.errors.covariance.iter_mut().enumerate().take(set.len()) {
        for (l, of) in row.iter_mut().enumerate().take(set.len()) {
            *of = entry(k, l);
        }
    }
}

fn guesses(set: &[Figure], base: &Fitted) -> Fitted {
    let mut fitted = exact(base);
    for figure in set {
        figure.set(figure.guess().middle(), &mut fitted);
    }
    fitted
}

/// Fits the [`Figure`]s of such crashes to the recorded values, given all other evidence of their
/// collisions; the rest of `base` is unchanged.
///
/// The figures maximise Σ ln p(recorders | crush, PDOF, headings), with weak guesses of each figure. They do
/// not depend on those of `base`. `progress` gets the number of finished pairs and of all, once for each
/// round of draws.
///
/// # Errors
/// [`FieldError::NothingToJudge`] without recorders, [`FieldError::Estimate`] if a pair has no estimate,
/// [`FieldError::NoMaximum`], and [`FieldError::Ended`] if `progress` ends the run.
pub fn fit<C: Crash>(
    pairs: &[C],
    base: &Fitted,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<FigureFit, FieldError> {
    Ok(settled(pairs, base, options, progress)?.0)
}

fn settled<'a, C: Crash>(
    pairs: &'a [C],
    base: &Fitted,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<(FigureFit, Likelihood<'a, C>), FieldError> {
    let mut by = guesses(C::FIGURES, base);
    for _ in 1..ROUNDS {
        by = Likelihood::new(pairs, &by, options, progress)?.fit(&by)?.fitted;
    }
    let likelihood = Likelihood::new(pairs, &by, options, progress)?;
    Ok((likelihood.fit(&by)?, likelihood))
}

/// The fit of all pairs, and for each of `folds` folds (at least two) the fit without the crashes of that
/// fold. The fold of a crash is its position in the file, counted by crash, modulo `folds`.
///
/// # Errors
/// As [`fit`].
pub fn fit_folds<C: Crash>(
    pairs: &[C],
    base: &Fitted,
    folds: usize,
    options: &FitOptions,
    progress: &mut Progress<'_>,
) -> Result<(FigureFit, Folds), FieldError> {
    let folds = folds.max(2);
    let mut of_case: BTreeMap<String, usize> = BTreeMap::new();
    for pair in pairs {
        let next = of_case.len() % folds;
        of_case.entry(pair.case().to_owned()).or_insert(next);
    }
    let (fit, likelihood) = settled(pairs, base, options, progress)?;
    let without = |fold: usize| {
        let is_used = |pair: &C| of_case.get(pair.case()).is_none_or(|of| *of != fold);
        likelihood.maximise(&fit.fitted, &is_used).map(|maximum| maximum.fitted)
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
    /// The figures for a crash: fitted to all folds except its own.
    #[must_use]
    pub fn of(&self, crash: &impl Crash) -> Option<Fitted> {
        self.fitted.get(*self.of_case.get(crash.case())?).copied()
    }

    /// The figures of each fold, fitted to all others.
    #[must_use]
    pub fn fitted(&self) -> &[Fitted] {
        &self.fitted
    }
}

fn step(n: usize, k: usize) -> Point {
    let mut step = Point::zeros(n);
    step[k] = STEP;
    step
}

#[cfg(test)]
mod tests;
