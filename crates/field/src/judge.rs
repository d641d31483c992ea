//! Estimates compared with recorders.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use estimate::{ParticleSettings, Posterior, Verdict, sample_quietly};
use evidence::{Collision, CollisionModel, DrawnOutput, Fitted, InjuryRisk, shown_delta_v};
use pim_core::VehicleId;
use real::Real;
use real::elementary::{exp, ln};
use uncertainty::InvalidDistribution;

use crate::crash::{Crash, KnownCrush, PairKind};
use crate::error::FieldError;
use crate::pair::Truth;

/// Levels of the judged intervals.
pub const LEVELS: [f64; 3] = [0.5, 0.8, 0.95];

/// Maximum factor on the number of particles of a pair.
const MOST_TIMES: usize = 4;

/// Settings of the judgement.
#[derive(Clone, Debug)]
pub struct Options {
    /// Number of particles of each island, as in [`ParticleSettings`]; it is doubled up to twice if a run
    /// does not converge.
    pub particles: usize,
    /// The random seed, of every pair.
    pub seed: u64,
    /// Whether the recorder of one vehicle is given, and the other vehicle is judged.
    pub other: bool,
    /// Which crush is known.
    pub crush: KnownCrush,
    /// The injury for which the crashes were chosen, if they were: no crash is in the file without it.
    pub injury: Option<InjuryRisk>,
}

/// One vehicle, estimated without its recorder.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Number of the crash.
    pub case: String,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// The surfaces that met.
    pub kind: PairKind,
    /// Whether both recorders can belong to one collision, as in
    /// [`Crash::is_one_event`](crate::Crash::is_one_event).
    pub is_one_event: Option<bool>,
    /// The value that its recorder stored.
    pub truth: Truth,
    /// (m/s) median of the value that the estimate expects the recorder to store.
    pub median: f64,
    /// (m/s) ends of the intervals of the [`LEVELS`].
    pub intervals: [[f64; 2]; 3],
    /// (–) probability that the estimate gives to values below the truth.
    pub below: f64,
    /// (m/s) continuous ranked probability score: ∫ (F − 1{x ≥ truth})² dx.
    pub crps: f64,
    /// Whether the run converged.
    pub converged: bool,
    /// (m/s) WinSMASH's value.
    pub winsmash: Option<f64>,
}

/// Figures of a group, with their standard errors, clustered by collision.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Number of vehicles.
    pub n: usize,
    /// Number of collisions.
    pub collisions: usize,
    /// (–) mean of ln(median/truth).
    pub bias: [f64; 2],
    /// (–) root mean square of the same number.
    pub rms: [f64; 2],
    /// (–) share of the truths inside the intervals of the [`LEVELS`]; `None` for a method without intervals.
    pub coverage: Option<[[f64; 2]; 3]>,
    /// (–) median ratio of the width of the 95 % interval to the median.
    pub width95: Option<f64>,
    /// (m/s) mean continuous ranked probability score: without intervals, the mean absolute error.
    pub crps: f64,
    /// Numbers of vehicles by tenths of the probability below the truth.
    pub pit: Option<[usize; 10]>,
}

/// A group of collisions, judged by both methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// `all`, the name of a kind, or `one-event`: if the recorder of the other vehicle is given, the
    /// collisions to which both recorders can belong.
    pub name: &'static str,
    /// Ours.
    pub ours: Figures,
    /// Those of WinSMASH, for the vehicles with a WinSMASH value.
    pub winsmash: Option<Figures>,
    /// Ours, for the same vehicles.
    pub ours_of_these: Option<Figures>,
}

/// All judged vehicles.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Whether the other vehicle's recorder was given.
    pub other: bool,
    /// Whether each vehicle struck a fixed object, and no other vehicle.
    pub objects: bool,
    /// Whether the crashes were taken as chosen for an injury.
    pub injured: bool,
    /// Number of pairs of the file, or of vehicles that struck a fixed object.
    pub pairs: usize,
    /// Number of pairs that were finished before the run was ended.
    pub finished: usize,
    /// Crash and vehicle of each record that is neither judged nor given, as it may belong to another event.
    pub doubted: Vec<(String, VehicleId)>,
    /// Each vehicle.
    pub judged: Vec<Judged>,
    /// All collisions, by kind of collision, and those of one event.
    pub groups: Vec<Group>,
}

/// Estimates each vehicle with a recorder from all evidence except that recorder. `progress` gets the number
/// of finished pairs and of all, and may end the run, which then judges the finished pairs.
///
/// # Errors
/// [`FieldError::NothingToJudge`], [`FieldError::Ended`] if no pair was finished, and
/// [`FieldError::Estimate`] if a pair has no estimate.
pub fn judge<C: Crash>(
    pairs: &[C],
    fitted: &Fitted,
    options: &Options,
    progress: &mut (dyn FnMut(usize, usize) -> ControlFlow<()> + Send),
) -> Result<Field, FieldError> {
    judge_by(pairs, &|_| *fitted, options, progress)
}

/// [`judge`], with separate figures for each pair, such as those fitted without its crash.
///
/// # Errors
/// As [`judge`].
pub fn judge_by<C: Crash>(
    pairs: &[C],
    fitted: &dyn Fn(&C) -> Fitted,
    options: &Options,
    progress: &mut (dyn FnMut(usize, usize) -> ControlFlow<()> + Send),
) -> Result<Field, FieldError> {
    let mut judged = Vec::new();
    let mut finished = pairs.len();
    for (done, pair) in pairs.iter().enumerate() {
        if progress(done, pairs.len()).is_break() {
            finished = done;
            break;
        }
        let fitted = &fitted(pair).of_injured(options.injury);
        match (options.other, &pair.truths()[..]) {
            (true, [one, two]) => {
                judged.extend(vehicles(pair, fitted, options, &[two.0], &[*one])?);
                judged.extend(vehicles(pair, fitted, options, &[one.0], &[*two])?);
            }
            (true, _) | (false, []) => {}
            (false, all) if options.crush == KnownCrush::Both => {
                judged.extend(vehicles(pair, fitted, options, &[], all)?);
            }
            (false, all) => {
                for one in all {
                    judged.extend(vehicles(pair, fitted, options, &[], &[*one])?);
                }
            }
        }
    }
    if judged.is_empty() && finished < pairs.len() {
        return Err(FieldError::Ended);
    }
    if judged.is_empty() {
        return Err(FieldError::NothingToJudge { both: options.other });
    }
    let group = |name, of: &dyn Fn(&Judged) -> bool| {
        let all: Vec<&Judged> = judged.iter().filter(|judged| of(judged)).collect();
        Group::of(name, &all)
    };
    let mut groups: Vec<Group> = group("all", &|_| true).into_iter().collect();
    groups.extend(PairKind::ALL.iter().filter_map(|kind| group(kind.name(), &|judged| judged.kind == *kind)));
    if options.other {
        groups.extend(group("one-event", &|judged| judged.is_one_event == Some(true)));
    }
    let doubted = pairs[..finished].iter().flat_map(|pair| {
        let is_doubted = |id: &VehicleId| pair.vehicle(*id).is_some_and(|vehicle| vehicle.is_record_doubted);
        VehicleId::ALL.into_iter().filter(is_doubted).map(|id| (pair.case().to_owned(), id))
    });
    let (other, doubted, objects) = (options.other, doubted.collect(), C::IS_WITH_OBJECT);
    let injured = options.injury.is_some();
    Ok(Field { other, objects, injured, pairs: pairs.len(), finished, doubted, judged, groups })
}

/// The posterior of a crash, and whether its run converged.
pub(crate) fn posterior(
    case: &str,
    collision: Result<Collision, InvalidDistribution>,
    options: &Options,
) -> Result<(Posterior, bool), FieldError> {
    let refused = |reason: String| FieldError::Estimate { case: case.to_owned(), reason };
    let collision = collision.map_err(|error| refused(error.to_string()))?;
    let model = CollisionModel::new(&collision);
    let mut particles = options.particles;
    loop {
        let settings = ParticleSettings::new(particles, options.seed);
        let posterior = sample_quietly(&model, &model, &settings);
        let posterior = posterior.map_err(|failure| refused(failure.to_string()))?;
        let converged = matches!(posterior.verdict(), Verdict::Converged);
        if converged || particles >= MOST_TIMES * options.particles {
            return Ok((posterior, converged));
        }
        particles *= 2;
    }
}

/// The draws of a result.
pub(crate) fn draws(posterior: &Posterior, output: DrawnOutput) -> &[f64] {
    posterior.outputs().get(output.column()).map_or(&[][..], Vec::as_slice)
}

/// (m/s) the draws of the ΔV that the recorder of a vehicle shows.
pub(crate) fn shown(
    posterior: &Posterior,
    vehicle: VehicleId,
    is_longitudinal: bool,
) -> impl Iterator<Item = f64> {
    let along = draws(posterior, DrawnOutput::LongitudinalDeltaV(vehicle));
    let whole = draws(posterior, DrawnOutput::DeltaV(vehicle)).iter();
    whole.zip(along).map(move |(&whole, &along)| shown_delta_v(whole, along, is_longitudinal))
}

/// The intervals of the [`LEVELS`].
pub(crate) fn intervals(quantile: impl Fn(f64) -> f64) -> [[f64; 2]; 3] {
    LEVELS.map(|level| [0.5 * (1.0 - level), 0.5 * (1.0 + level)].map(&quantile))
}

/// Vehicles of one estimate.
fn vehicles<C: Crash>(
    pair: &C,
    fitted: &Fitted,
    options: &Options,
    given: &[VehicleId],
    wanted: &[(VehicleId, Truth)],
) -> Result<Vec<Judged>, FieldError> {
    let collision = match (options.crush, wanted) {
        (KnownCrush::Judged, [(judged, _), ..]) => pair.known(Some(*judged), fitted, given),
        (KnownCrush::Other, [(judged, _), ..]) => pair.known(Some(judged.other()), fitted, given),
        _ => pair.known(None, fitted, given),
    };
    let (posterior, converged) = posterior(pair.case(), collision, options)?;
    Ok(wanted
        .iter()
        .map(|&(vehicle, truth)| {
            let shown: Vec<f64> = shown(&posterior, vehicle, truth.is_longitudinal).map(ln).collect();
            let predictive = Predictive::of(&shown, fitted);
            Judged {
                case: pair.case().to_owned(),
                vehicle,
                kind: pair.kind(),
                is_one_event: pair.is_one_event(),
                truth,
                median: predictive.quantile(0.5),
                intervals: intervals(|share| predictive.quantile(share)),
                below: predictive.below(truth.delta_v),
                crps: predictive.crps(truth.delta_v),
                converged,
                winsmash: pair.vehicle(vehicle).and_then(|vehicle| vehicle.by_winsmash(&truth)),
            }
        })
        .collect())
}

/// The expected value of a recorder: the draws, with the recorder's own error.
struct Predictive {
    /// F at equal steps of ln ΔV.
    cumulative: Vec<f64>,
}

/// (–) ln of the smallest and largest ΔV (m/s) of the steps.
const ENDS: [f64; 2] = [-4.0, 5.0];
/// Number of steps, of 0.9 %.
const STEPS: usize = 1000;

impl Predictive {
    fn of(draws: &[f64], fitted: &Fitted) -> Self {
        let weight = 1.0 / count(draws.len());
        let cumulative = (0..=STEPS).map(|step| {
            let x = Self::at(count(step));
            let below = draws
                .iter()
                .map(|draw| fitted.recorder_freedom.share_below((x - draw) / fitted.recorder_ln_scale));
            below.sum::<f64>() * weight
        });
        Self { cumulative: cumulative.collect() }
    }

    /// (–) ln ΔV at a step.
    fn at(step: f64) -> f64 {
        ENDS[0] + (ENDS[1] - ENDS[0]) * step / count(STEPS)
    }

    /// (m/s)
    fn quantile(&self, share: f64) -> f64 {
        let after = self.cumulative.partition_point(|below| *below < share).clamp(1, STEPS);
        let [low, high] = [after - 1, after].map(|step| self.cumulative[step]);
        exp(Self::at(count(after - 1) + (share - low) / (high - low)))
    }

    /// (–) probability below a ΔV (m/s).
    fn below(&self, delta_v: f64) -> f64 {
        let step = (ln(delta_v) - ENDS[0]) / (ENDS[1] - ENDS[0]) * count(STEPS);
        let before = (0..STEPS).rev().find(|before| count(*before) <= step).unwrap_or(0);
        let [low, high] = [before, before + 1].map(|step| self.cumulative[step]);
        low + (high - low) * (step - count(before))
    }

    /// (m/s)
    fn crps(&self, truth: f64) -> f64 {
        let ends = self.cumulative.windows(2).enumerate();
        let parts = ends.map(|(step, ends)| {
            let (from, to) = (exp(Self::at(count(step))), exp(Self::at(count(step + 1))));
            let below = 0.5 * (ends[0] + ends[1]);
            let square = |indicator: f64| (below - indicator) * (below - indicator);
            // The step that contains the truth has a part on each side.
            let split = truth.clamp(from, to);
            (split - from) * square(0.0) + (to - split) * square(1.0)
        });
        parts.sum()
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts of draws and steps are far below 2⁵³")]
pub(crate) fn count(number: usize) -> f64 {
    number as f64
}

impl Group {
    fn of(name: &'static str, judged: &[&Judged]) -> Option<Self> {
        let ours = Figures::of_intervals(judged)?;
        let both: Vec<&Judged> = judged.iter().copied().filter(|judged| judged.winsmash.is_some()).collect();
        Some(Self {
            name,
            ours,
            winsmash: Figures::of_points(&both),
            ours_of_these: Figures::of_intervals(&both),
        })
    }
}

impl Figures {
    fn of_intervals(judged: &[&Judged]) -> Option<Self> {
        let errors: Vec<f64> = judged.iter().map(|judged| ln(judged.median / judged.truth.delta_v)).collect();
        let cases = cases(judged);
        let mut figures = Self::of(&cases, &errors)?;
        let inside = |level: usize| {
            let is_inside = judged.iter().map(|judged| {
                let [low, high] = judged.intervals[level];
                f64::from(u8::from((low..=high).contains(&judged.truth.delta_v)))
            });
            mean(&cases, &is_inside.collect::<Vec<_>>())
        };
        figures.coverage = Some([0, 1, 2].map(inside));
        let width = |judged: &&Judged| (judged.intervals[2][1] - judged.intervals[2][0]) / judged.median;
        figures.width95 = median(judged.iter().map(width).collect());
        figures.crps = judged.iter().map(|judged| judged.crps).sum::<f64>() / count(judged.len());
        let mut pit = [0; 10];
        for judged in judged {
            let tenth = (1..10).filter(|tenth| judged.below >= count(*tenth) / 10.0).count();
            pit[tenth] += 1;
        }
        figures.pit = Some(pit);
        Some(figures)
    }

    fn of_points(judged: &[&Judged]) -> Option<Self> {
        let values = judged
            .iter()
            .filter_map(|judged| Some((judged.case.as_str(), judged.winsmash?, judged.truth.delta_v)));
        Self::of_values(&values.collect::<Vec<_>>())
    }

    /// The figures of single values: the crash, the value (m/s) and the truth (m/s).
    pub(crate) fn of_values(rows: &[(&str, f64, f64)]) -> Option<Self> {
        let cases: Vec<&str> = rows.iter().map(|(case, _, _)| *case).collect();
        let errors: Vec<f64> = rows.iter().map(|(_, value, truth)| ln(value / truth)).collect();
        let mut figures = Self::of(&cases, &errors)?;
        let distances = rows.iter().map(|(_, value, truth)| (value - truth).abs());
        figures.crps = distances.sum::<f64>() / count(rows.len());
        Some(figures)
    }

    fn of(cases: &[&str], errors: &[f64]) -> Option<Self> {
        if cases.is_empty() {
            return None;
        }
        let squares: Vec<f64> = errors.iter().map(|error| error * error).collect();
        let [square, deviation] = mean(cases, &squares);
        let rms = Real::sqrt(square);
        Some(Self {
            n: cases.len(),
            collisions: cases.iter().collect::<BTreeSet<_>>().len(),
            bias: mean(cases, errors),
            // d√x = dx/2√x
            rms: [rms, if rms > 0.0 { 0.5 * deviation / rms } else { 0.0 }],
            coverage: None,
            width95: None,
            crps: 0.0,
            pit: None,
        })
    }
}

/// The crash of each.
fn cases<'a>(judged: &[&'a Judged]) -> Vec<&'a str> {
    judged.iter().map(|judged| judged.case.as_str()).collect()
}

/// The median; of an even number, the mean of the two in the middle.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.is_empty() {
        None
    } else if values.len() % 2 == 1 {
        values.get(half).copied()
    } else {
        Some(0.5 * (values[half - 1] + values[half]))
    }
}

/// The mean, and its standard error if the errors of the vehicles of a collision are correlated.
pub(crate) fn mean(cases: &[&str], values: &[f64]) -> [f64; 2] {
    let n = count(values.len());
    let mean = values.iter().sum::<f64>() / n;
    let mut collisions: BTreeMap<&str, f64> = BTreeMap::new();
    for (case, value) in cases.iter().zip(values) {
        *collisions.entry(case).or_default() += value - mean;
    }
    let square: f64 = collisions.values().map(|sum| sum * sum).sum();
    [mean, Real::sqrt(square) / n]
}

#[cfg(test)]
mod tests;
