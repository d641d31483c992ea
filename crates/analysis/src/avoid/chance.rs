//! How probable it is that the collision was avoidable: the scene again for each sample of its numbers.

use ::uncertainty::normal::quantiles;
use ::uncertainty::{Distribution, LANES, Lanes, Sampler, SamplingMethod, Settings, order_statistic, random};
use inputs::{AvoidForm, Input, RecordedError};

use super::posing::{SoughtSpeeds, Unposed};
use super::scene::{AvoidScene, Sight};
use super::sight::{Outlines, pose};
use crate::columns::Number;
use crate::estimate::Estimated;
use crate::failure::Failure;
use crate::uncertainty::UncertainInput;

/// How probable it is that the collision was avoidable.
#[derive(Clone, Debug)]
pub struct AvoidChance {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that make a possible scene; everything below comes from these.
    pub possible: usize,
    /// Number of samples in which the vehicle did not move forward: they are not possible.
    pub stationary: usize,
    /// Number of possible samples in which the vehicle would have stopped with the reaction and braking of
    /// the inputs, so that it is taken as unbraked.
    pub late: usize,
    /// (–) number of independent samples that would be as accurate.
    pub effective: f64,
    /// (–) that the collision is avoided at the limit, with the reaction and the braking of `[avoid]`.
    pub avoided_at_limit: f64,
    /// (–) that the vehicle then stops before the place of the impact.
    pub stopped_at_limit: f64,
    /// (–) that the collision is avoided at the limit with the reaction and the braking of the actual run.
    pub avoided_else_as_it_was: f64,
    /// (–) that the vehicle was faster than the limit.
    pub above_limit: f64,
    /// (–) standard error of `avoided_at_limit` from sampling.
    pub mc_error: f64,
    /// (m/s) speed at the demand.
    pub speed: AvoidInterval,
    /// (m/s) the speed that avoids it in space.
    pub spatial: AvoidInterval,
    /// (m/s) the speed that avoids it in time, with that question.
    pub temporal: Option<AvoidInterval>,
    /// (m/s) what is left of the limit at the place of the impact.
    pub left_at_limit: AvoidInterval,
    /// (m) from the demand to the place of the impact.
    pub distance: AvoidInterval,
    /// (s) from the demand to the impact.
    pub time: AvoidInterval,
    /// From when on the view is free, if obstacles hide the other party.
    pub sight: Option<SightIntervals>,
    /// What moves the probability, the most influential first.
    pub influences: Vec<AvoidInfluence>,
    /// (m/s) the greatest avoiding speeds of the samples, ascending.
    avoiding: Vec<f64>,
}

/// A median, and an interval with a probability of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidInterval {
    /// (SI) its lower end.
    pub low: f64,
    /// (SI) the median.
    pub median: f64,
    /// (SI) its upper end.
    pub high: f64,
}

/// From when on the view is free, among the samples in which something hides the other party before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SightIntervals {
    /// (s) before the impact.
    pub time: AvoidInterval,
    /// (m) distance that the vehicle covers from there to the impact.
    pub distance_subject: AvoidInterval,
    /// (m) distance that the other party covers from there to the impact.
    pub distance_other: AvoidInterval,
    /// (–) share of samples in which nothing hides it in the time examined.
    pub never_hidden: f64,
}

/// How much an uncertain number moves the probability that the collision is avoided at the limit.
#[derive(Clone, Debug)]
pub struct AvoidInfluence {
    /// The number; `None` for the speed by the rest of the case.
    pub input: Option<Input>,
    /// (–) the probability among the samples with the number above its median, minus that among the others.
    pub difference: f64,
}

/// Lower end, median and upper end of an interval with a probability of 95 %, in fortieths.
const OF_INTERVAL: [usize; 3] = [1, 20, 39];
/// (–) standard deviations of a normal error on each side of 95 %.
const Z_95: f64 = 1.96;
/// The purpose of the sequences of random numbers: those of the rest of the case have another.
const PURPOSE: u64 = 0x0061_766F_6964;

/// That of what the samples of a recorder get wrong.
const OF_RECORDER: u64 = 0x7361_6d70_6c65;
/// Of that of the other vehicle.
const OF_OTHER_RECORDER: u64 = 0x006f_7468_6572;

/// Speeds at the impact (m/s) by the rest of the case, one for each sample; NaN for one without an answer.
pub(super) struct Speeds<'a> {
    pub(super) speeds: &'a [f64],
    /// The same for the other vehicle; empty if it is not needed.
    pub(super) other: &'a [f64],
    /// Their estimate, which knows how independent they are.
    pub(super) estimated: Option<&'a Estimated>,
}

/// The samples of the uncertain numbers, or one for each of the speeds. If these lack that of the other
/// vehicle (m/s), `other` may have it.
pub(super) fn chance(
    form: &AvoidForm<Number>,
    inputs: &[UncertainInput],
    speeds: Option<&Speeds<'_>>,
    other: &dyn Fn(usize) -> Option<f64>,
    obstacles: Outlines<'_>,
    [samples, seed]: [u64; 2],
) -> Result<Option<AvoidChance>, Failure> {
    let given = usize::try_from(samples).unwrap_or(usize::MAX);
    let samples = speeds.map_or(given, |speeds| speeds.speeds.len());
    let distributions: Vec<Distribution> = inputs.iter().map(|input| input.distribution).collect();
    let settings = Settings::new(SamplingMethod::MonteCarlo, samples, random::key(seed, &[PURPOSE]));
    let sampler = if inputs.is_empty() { None } else { Some(Sampler::new(&distributions, &settings)?) };
    let keys = [OF_RECORDER, OF_OTHER_RECORDER].map(|purpose| random::key(seed, &[purpose]));
    let is_recorded = form.is_recorded();
    let mut columns = vec![Lanes::ZERO; inputs.len()];
    let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(samples); inputs.len()];
    let mut scenes: Vec<Option<AvoidScene>> = Vec::with_capacity(samples);
    let mut stationary = 0;
    for (block, first) in (0..).zip((0..samples).step_by(LANES)) {
        if let Some(sampler) = &sampler {
            sampler.fill(block, &mut columns);
        }
        let lanes = LANES.min(samples - first);
        for (kept, column) in drawn.iter_mut().zip(&columns) {
            kept.extend_from_slice(&column[..lanes]);
        }
        let errors = is_recorded.then(|| keys.map(|key| errors(key, first)));
        scenes.extend((0..lanes).map(|lane| {
            let of = |speeds: &[f64]| speeds.get(first + lane).copied();
            let sought = SoughtSpeeds {
                subject: speeds.and_then(|told| of(told.speeds)),
                other: speeds.and_then(|told| of(told.other)).or_else(|| other(first + lane)),
            };
            let form = form.map(|number| number.at(&columns, lane));
            let form = match &errors {
                Some(errors) => form.with_errors(errors.each_ref().map(|errors| errors[lane])),
                None => form,
            };
            let posed = pose(&form, sought, obstacles);
            stationary += usize::from(matches!(posed, Err(Unposed::Stands)));
            posed.ok()
        }));
    }
    let told = speeds.map(|speeds| speeds.speeds);
    let varying = inputs.iter().map(|input| Some(&input.input)).zip(drawn.iter().map(Vec::as_slice));
    let varying: Vec<_> = varying.chain(told.map(|speeds| (None, speeds))).collect();
    Ok(of_scenes(&scenes, stationary, &varying, speeds.and_then(|speeds| speeds.estimated)))
}

/// The errors of a recorder's speeds in the samples from `first` on.
fn errors(key: u64, first: usize) -> [RecordedError; LANES] {
    let sample = |lane: usize| (first + lane) as u64;
    let mut shared: [f64; LANES] = std::array::from_fn(|lane| random::unit(random::bits(key, sample(lane))));
    quantiles(&mut shared);
    std::array::from_fn(|lane| RecordedError {
        shared: shared[lane],
        rounding: Some(random::key(key, &[sample(lane)])),
    })
}

fn of_scenes(
    scenes: &[Option<AvoidScene>],
    stationary: usize,
    varying: &[(Option<&Input>, &[f64])],
    estimated: Option<&Estimated>,
) -> Option<AvoidChance> {
    let posed: Vec<&AvoidScene> = scenes.iter().flatten().collect();
    if posed.is_empty() {
        return None;
    }
    let avoiding: Vec<Option<f64>> =
        scenes.iter().map(|scene| scene.as_ref().map(AvoidScene::just_avoiding)).collect();
    let is_avoided: Vec<Option<bool>> = scenes
        .iter()
        .zip(&avoiding)
        .map(|(scene, avoiding)| Some(scene.as_ref()?.kept() <= (*avoiding)?))
        .collect();
    let share = |count: usize| ratio(count, posed.len());
    let avoided = is_avoided.iter().flatten().filter(|is| **is).count();
    let avoided_at_limit = share(avoided);
    // As if with one more success and one more failure, so the error of a probability of 1 is not 0.
    let smoothed = ratio(avoided + 1, posed.len() + 2);
    let independent = (smoothed * (1.0 - smoothed) / ratio(posed.len(), 1)).sqrt();
    // Draws of an estimate depend on each other.
    let of_draws = estimated.and_then(|estimated| {
        let told = |draw: usize| matches!(is_avoided.get(draw), Some(Some(true)));
        estimated.posterior.draws().mean(|draw| if told(draw) { 1.0 } else { 0.0 }).standard_error
    });
    let mc_error = of_draws.unwrap_or(0.0).max(independent);
    let interval =
        |of: &dyn Fn(&AvoidScene) -> f64| AvoidInterval::of(posed.iter().map(|scene| of(scene)).collect());
    let mut influences: Vec<AvoidInfluence> = varying
        .iter()
        .map(|(input, values)| AvoidInfluence {
            input: input.cloned(),
            difference: difference(values, &is_avoided),
        })
        .collect();
    influences.retain(|influence| influence.difference != 0.0);
    influences.sort_by(|a, b| b.difference.abs().total_cmp(&a.difference.abs()));
    let mut greatest: Vec<f64> = avoiding.into_iter().flatten().collect();
    greatest.sort_by(f64::total_cmp);
    let has_temporal = posed.first().is_some_and(|scene| scene.clears.is_some());
    Some(AvoidChance {
        samples: scenes.len(),
        possible: posed.len(),
        stationary,
        late: posed.iter().filter(|scene| scene.reacted_late()).count(),
        effective: smoothed * (1.0 - smoothed) / (mc_error * mc_error),
        avoided_at_limit,
        avoided_else_as_it_was: share(posed.iter().filter(|scene| scene.is_avoided_else_as_it_was()).count()),
        stopped_at_limit: share(posed.iter().filter(|scene| scene.stops_at_limit()).count()),
        above_limit: share(posed.iter().filter(|scene| scene.is_above_limit()).count()),
        mc_error,
        speed: interval(&|scene| scene.speed),
        spatial: interval(&AvoidScene::spatial),
        temporal: has_temporal.then(|| interval(&|scene| scene.temporal().unwrap_or(f64::NAN))),
        left_at_limit: interval(&AvoidScene::left_at_limit),
        distance: interval(&|scene| scene.distance),
        time: interval(&|scene| scene.time),
        sight: of_sights(&posed),
        influences,
        avoiding: greatest,
    })
}

fn of_sights(posed: &[&AvoidScene]) -> Option<SightIntervals> {
    let sights: Vec<Sight> = posed.iter().filter_map(|scene| scene.view.sight()).collect();
    let of = |of: fn(&Sight) -> f64| AvoidInterval::of(sights.iter().map(of).collect());
    (!sights.is_empty()).then(|| SightIntervals {
        time: of(|sight| sight.time),
        distance_subject: of(|sight| sight.distance_subject),
        distance_other: of(|sight| sight.distance_other),
        never_hidden: ratio(posed.len() - sights.len(), posed.len()),
    })
}

impl AvoidChance {
    /// (–) the probability that the collision is avoided from a speed (m/s), and its 95 % interval due to the
    /// number of samples.
    #[must_use]
    pub fn avoided_from(&self, speed: f64) -> [f64; 3] {
        let below = self.avoiding.partition_point(|avoiding| *avoiding < speed);
        let avoided = self.avoiding.len() - below;
        let probability = ratio(avoided, self.avoiding.len());
        let smoothed = ratio(avoided + 1, self.avoiding.len() + 2);
        let error = Z_95 * (smoothed * (1.0 - smoothed) / self.effective.max(1.0)).sqrt();
        [
            (smoothed - error).max(0.0).min(probability),
            probability,
            (smoothed + error).min(1.0).max(probability),
        ]
    }

    /// (m/s) speeds that hold nearly all of the greatest avoiding ones.
    #[must_use]
    pub fn avoiding_range(&self) -> [f64; 2] {
        [0.001, 0.999].map(|probability| quantile(&self.avoiding, probability))
    }
}

impl AvoidInterval {
    pub(super) fn of(mut values: Vec<f64>) -> Self {
        let count = values.len();
        let [low, median, high] = OF_INTERVAL.map(|fortieth| {
            let place = count * fortieth / 40;
            if place < count { *values.select_nth_unstable_by(place, f64::total_cmp).1 } else { f64::NAN }
        });
        Self { low, median, high }
    }
}

/// The value of a sample, below which this share of the values lies.
fn quantile(sorted: &[f64], probability: f64) -> f64 {
    order_statistic(sorted, (probability * ratio(sorted.len(), 1)).floor())
}

#[allow(clippy::cast_precision_loss, reason = "numbers of samples are small")]
fn ratio(count: usize, of: usize) -> f64 {
    count as f64 / of as f64
}

/// The share of avoided ones among those with a value above the median, less that among the others. Equal
/// values are dealt by their order, which has nothing to do with them.
fn difference(values: &[f64], is_avoided: &[Option<bool>]) -> f64 {
    let known = values.iter().zip(is_avoided).enumerate();
    let mut known: Vec<(f64, usize, bool)> =
        known.filter_map(|(place, (value, is))| Some((*value, place, (*is)?))).collect();
    let half = known.len() / 2;
    if half == 0 {
        return 0.0;
    }
    known.select_nth_unstable_by(half, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let share = |part: &[(f64, usize, bool)]| ratio(part.iter().filter(|(_, _, is)| *is).count(), part.len());
    let (below, above) = known.split_at(half);
    share(above) - share(below)
}
