//! The speed at the impact as a distribution, from the last samples before it.

use real::Real;
use real::elementary::{exp, ln};
use uncertainty::normal::quantiles;

use crate::assumption::{AssumptionOutOfRange, in_ranges};
use crate::channel::GRAVITY;
use crate::pre_crash::{PreCrash, PreCrashSample, REGULAR_STEP, SpeedLimits};
use crate::spread::{DIMENSIONS, Draws, radical_point};

/// (km/h) in m/s.
const KMH: f64 = 1.0 / 3.6;

/// The errors of a stored speed as the speed at impact. Each is a default that may be changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactSpeedErrors {
    /// (m/s) step in which speeds are stored, to the nearest: 1 km/h in 49 CFR 563 and UN R160.
    pub step: f64,
    /// (1) relative error by which a stored speed is too low while the wheels roll: 1.4 % on average (18 runs
    /// of a 2010 Ford Flex against GPS, steady at 113 km/h).
    pub steady_low: f64,
    /// (1) standard deviation of that share: 0.43 %, from "within 2.5 % at 99 %" of the same runs.
    pub steady_sd: f64,
    /// (1) standard deviation of the relative error of the speed with worn or different tyres: 0.7 %. 7 mm of
    /// tread are 2.2 % of a radius of 320 mm; worn by any part of that, the standard deviation is 0.6 %.
    pub tyre_sd: f64,
    /// (m/s) how much the speed reads low in hard braking with ABS at work: 3 km/h on average over the same
    /// runs.
    pub slip_low: f64,
    /// (m/s) standard deviation of that: 2.1 km/h. The worst of 18 runs was 6.8 km/h, 3.8 above the mean, and
    /// the greatest of 18 normal numbers lies 1.82 standard deviations above it.
    pub slip_sd: f64,
    /// (1) drag factor of hard braking on this ground: 0.75, dry asphalt.
    pub friction: f64,
    /// (m/s²) greatest acceleration and deceleration with the brake off: 1.0, an engine that brakes or pulls.
    pub coasting: f64,
    /// (1) probability that a brake that was off in the last sample came on in half a second: 0.25; in the
    /// gap g, 1 − (1 − 0.25)^(g/0.5 s).
    pub brake_comes_on: f64,
    /// (1) probability that a driver who braked in the last two samples kept the deceleration that their
    /// speeds show, within 0.1 g: 0.65; otherwise he braked at anything up to that of hard braking. In 216
    /// pairs of half seconds of 39 crashes (CIREN 2017, 2018 and 2020), with the brake on before and
    /// between, the most likely values are 0.65 and 0.1 g, and 0.70 and 0.1 g for the whole second after.
    pub keeps_braking: f64,
    /// (s) largest age of a stored speed at the time that the record gives for it: 0.1 s; any age up to this
    /// is equally likely. The wheels' control unit sends it every 10 to 100 ms, and the recorder takes the
    /// last one that came.
    pub latency: f64,
    /// (1) probability that a last speed that fell by more than `g` allows is not that of the vehicle before
    /// the impact: 0.5 where no tyre allows it (1.2 g), and less down to `g`. It is then slip, or the impact
    /// itself, and the sample before it counts.
    pub last_is_of_impact: f64,
}

impl Default for ImpactSpeedErrors {
    fn default() -> Self {
        Self {
            step: REGULAR_STEP,
            steady_low: 0.014,
            steady_sd: 0.0043,
            tyre_sd: 0.007,
            slip_low: 3.0 * KMH,
            slip_sd: 2.1 * KMH,
            friction: 0.75,
            coasting: 1.0,
            brake_comes_on: 0.25,
            keeps_braking: 0.65,
            latency: 0.1,
            last_is_of_impact: 0.5,
        }
    }
}

/// The source of a part of the error of the speed at impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedErrorSource {
    /// The speed is stored in steps.
    Rounding,
    /// The wheels turn more slowly than the vehicle moves: in steady driving a little, in hard braking much.
    Slip,
    /// Worn or other tyres.
    Tyres,
    /// Braking between the last sample and t = 0.
    Gap,
    /// The stored speed is older than its time.
    Latency,
    /// The last speed fell by more than the ground allows: it may be of the impact itself.
    LastSample,
    /// Speeds below 0, by braking or rounding, are cut off: the vehicle did not go backward.
    CutOff,
}

impl SpeedErrorSource {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rounding => "rounding of the stored speed",
            Self::Slip => "slip of the wheels",
            Self::Tyres => "size of the tyres",
            Self::Gap => "braking between the last sample and the impact",
            Self::Latency => "age of the stored speed",
            Self::LastSample => "whether the last sample is of the impact itself",
            Self::CutOff => "cut off at 0: it did not go backward",
        }
    }

    /// Its key in JSON.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Rounding => "rounding",
            Self::Slip => "slip",
            Self::Tyres => "tyres",
            Self::Gap => "gap",
            Self::Latency => "latency",
            Self::LastSample => "last_sample",
            Self::CutOff => "cut_off",
        }
    }
}

/// The effect of one source on the speed at impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedErrorPart {
    /// The source.
    pub source: SpeedErrorSource,
    /// (m/s) its shift of the mean.
    pub shift: f64,
    /// (m²/s²) its part of the variance. The parts add up to the whole; what is cut off at 0 narrows it.
    pub variance: f64,
}

/// The last speeds are lower than a deceleration of 1 g from the one before them allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteepFall {
    /// (m/s²) deceleration from the sample before to the last, positive.
    pub deceleration: f64,
    /// (s) time of the sample before.
    pub time: f64,
    /// (m/s) its speed.
    pub speed: f64,
    /// Whether several samples are that low: the wheels slipped or locked long before the impact. A single
    /// low last sample may be of the impact itself.
    pub is_slip: bool,
    /// (1) probability that the sample before the fall counts, not the last one.
    pub probability: f64,
}

/// One of the two speeds at t = 0 that a record may mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedHump {
    /// (1) how probable it is.
    pub probability: f64,
    /// (m/s) its mean.
    pub mean: f64,
    /// (m/s) its standard deviation.
    pub sd: f64,
}

/// The speed at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpactSpeed {
    /// (s) time of the last sample with a speed.
    pub time: f64,
    /// (m/s) the speed stored then.
    pub stored: f64,
    /// Whether the brake was on then.
    pub brake: Option<bool>,
    /// (m/s²) deceleration between the last two samples with a speed, positive if the vehicle slowed.
    pub deceleration: Option<f64>,
    /// (m/s) mean of the speed at impact.
    pub mean: f64,
    /// (m/s) its standard deviation.
    pub sd: f64,
    /// The parts of the error, in the order of the sources.
    pub parts: Vec<SpeedErrorPart>,
    /// The steep fall, if the last speeds fell by more than 1 g.
    pub steep_fall: Option<SteepFall>,
    /// After a steep fall the speed by the last sample and by the one before the fall, if either may be
    /// right: hardly any speed between them is possible.
    pub humps: Option<[SpeedHump; 2]>,
    draws: Draws,
}

/// Why a record gives no speed at impact.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ImpactSpeedFault {
    /// No sample has a speed.
    #[error("no sample has a speed")]
    NoSpeed,
    /// An error beyond its range.
    #[error(transparent)]
    OutOfRange(#[from] AssumptionOutOfRange),
}

impl ImpactSpeedErrors {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// The first that is not in its range.
    pub fn check(&self) -> Result<(), AssumptionOutOfRange> {
        let fields = [
            ("step", self.step, 10.0),
            ("steady_low", self.steady_low, 0.2),
            ("steady_sd", self.steady_sd, 0.2),
            ("tyre_sd", self.tyre_sd, 0.2),
            ("slip_low", self.slip_low, 20.0),
            ("slip_sd", self.slip_sd, 20.0),
            ("friction", self.friction, 1.5),
            ("coasting", self.coasting, 10.0),
            ("brake_comes_on", self.brake_comes_on, 1.0),
            ("keeps_braking", self.keeps_braking, 1.0),
            ("latency", self.latency, 2.0),
            ("last_is_of_impact", self.last_is_of_impact, 1.0),
        ];
        in_ranges(&fields.map(|(name, value, greatest)| (name, value, [0.0, greatest])))
    }
}

/// (s) the time in which the brake comes on with the probability `brake_comes_on`.
const HALF_SECOND: f64 = 0.5;
/// (1) probability that the brake was on if no sample shows its state.
const UNKNOWN_BRAKE: f64 = 0.5;

/// How the brake may have been used from a sample to t = 0.
#[derive(Clone, Copy, Debug)]
struct BrakeCourse {
    /// (1) how probable this is.
    probability: f64,
    /// (s) time with the brake on.
    braked: f64,
    /// (s) time in which it came on or went off at an unknown instant: braked for any part of it.
    open: f64,
    /// Whether it was on at the sample.
    is_on: bool,
    /// (m/s²) the accelerations while it was on, from the least to the greatest.
    braking: [f64; 2],
}

/// The probability that a brake that was off comes on within `time` (s).
fn comes_on(time: f64, errors: &ImpactSpeedErrors) -> f64 {
    let stays_off = 1.0 - errors.brake_comes_on;
    if stays_off <= 0.0 {
        return if time > 0.0 { 1.0 } else { 0.0 };
    }
    // P = 1 − (1 − p)^(t / 0.5 s)
    1.0 - exp(ln(stays_off) * time / HALF_SECOND)
}

/// (m/s²) 0.1 g: a driver who keeps a deceleration keeps it within this.
pub const KEPT_WITHIN: f64 = 0.1 * GRAVITY;

/// How the brake may have been used between a sample at `from` (s) and t = 0, by all samples that store it. A
/// deceleration (m/s²) that was `shown` with the brake on may have been kept.
fn brake_courses(
    record: &PreCrash,
    from: f64,
    shown: Option<f64>,
    errors: &ImpactSpeedErrors,
) -> Vec<BrakeCourse> {
    let known: Vec<(f64, bool)> =
        record.samples().iter().filter_map(|one| Some((one.time, one.brake?))).collect();
    let (before, after) = known.split_at(known.partition_point(|(time, _)| *time <= from));
    let after_of = |probability: f64, since: f64, is_on: bool, braking: [f64; 2]| {
        courses_after(
            BrakeCourse { probability, braked: 0.0, open: 0.0, is_on, braking },
            [since, from],
            after,
            errors,
        )
    };
    let any = errors.braking();
    let courses = match (before.last(), shown) {
        (Some((since, true)), Some(shown)) => {
            let kept = shown.clamp(0.0, -any[0]);
            let kept = [Real::max(any[0], -kept - KEPT_WITHIN), Real::min(KEPT_WITHIN - kept, 0.0)];
            let keeps = errors.keeps_braking;
            [after_of(keeps, *since, true, kept), after_of(1.0 - keeps, *since, true, any)]
        }
        (Some((since, is_on)), _) => [after_of(1.0, *since, *is_on, any), Vec::new()],
        (None, _) => {
            [after_of(UNKNOWN_BRAKE, from, true, any), after_of(1.0 - UNKNOWN_BRAKE, from, false, any)]
        }
    };
    courses.concat()
}

/// The courses that continue from `first`, whose brake is known since the first of the times (s); only the
/// time after the second counts.
fn courses_after(
    first: BrakeCourse,
    [mut since, from]: [f64; 2],
    samples: &[(f64, bool)],
    errors: &ImpactSpeedErrors,
) -> Vec<BrakeCourse> {
    let (mut course, mut was_on) = (first, first.is_on);
    for (time, is_on) in samples {
        let length = time - since.max(from);
        match (was_on, *is_on) {
            (true, true) => course.braked += length,
            (false, false) => {}
            _ => course.open += length,
        }
        (since, was_on) = (*time, *is_on);
    }
    let rest = 0.0 - since.max(from);
    if was_on {
        return vec![BrakeCourse { braked: course.braked + rest, ..course }];
    }
    // The brake may have come on after the last sample in which it is off.
    let later = comes_on(0.0 - since, errors);
    let comes = BrakeCourse { probability: course.probability * later, open: course.open + rest, ..course };
    vec![comes, BrakeCourse { probability: course.probability * (1.0 - later), ..course }]
}

/// From one sample to t = 0.
#[derive(Clone, Debug)]
struct Leg {
    stored: f64,
    /// (s) from the sample to t = 0.
    gap: f64,
    /// (1) slip of the wheels as a share of that in hard braking, 0 to 1: mean and variance.
    hard: [f64; 2],
    /// How the brake may have been used; the probabilities add up to 1.
    courses: Vec<BrakeCourse>,
}

/// Mean and variance of a uniform number.
fn uniform([least, greatest]: [f64; 2]) -> [f64; 2] {
    let width = greatest - least;
    // σ² = w²/12
    [0.5 * (least + greatest), width * width / 12.0]
}

impl ImpactSpeedErrors {
    /// (m/s²) the accelerations with the brake on, from the least to the greatest.
    fn braking(&self) -> [f64; 2] {
        [-self.friction * GRAVITY, 0.0]
    }

    /// (m/s²) those with the brake off.
    fn coasting(&self) -> [f64; 2] {
        [-self.coasting, self.coasting]
    }
}

/// (m/s) mean and standard deviation of the reduction of a stored speed by slip, from mean and variance of
/// the share of hard braking.
fn slip(stored: f64, [hard, variance]: [f64; 2], errors: &ImpactSpeedErrors) -> [f64; 2] {
    let rolling = 1.0 - hard;
    let (low, steady) = (errors.slip_low, errors.steady_low * stored);
    let (sd, steady_sd) = (errors.slip_sd, errors.steady_sd * stored);
    // s = h s_b + (1 − h) s_r, of independent h, s_b and s_r
    let spread = (hard * hard + variance) * sd * sd
        + (rolling * rolling + variance) * steady_sd * steady_sd
        + variance * (low - steady) * (low - steady);
    [hard * low + rolling * steady, spread.sqrt()]
}

impl Leg {
    /// Mean and variance (m/s) of the change of speed by braking and coasting, for the age (s) of the stored
    /// speed, given as a mean and a variance.
    fn change(&self, [age, age_variance]: [f64; 2], errors: &ImpactSpeedErrors) -> [f64; 2] {
        let [coasts, coasts_variance] = uniform(errors.coasting());
        let (mut mean, mut square) = (0.0, 0.0);
        for course in &self.courses {
            let [brakes, brakes_variance] = uniform(course.braking);
            let [share, open_variance] = uniform([0.0, course.open]);
            let (while_on, while_off) = if course.is_on { (1.0, 0.0) } else { (0.0, 1.0) };
            let braked = course.braked + share + while_on * age;
            let coasted = self.gap - course.braked - share + while_off * age;
            let braked_variance = open_variance + while_on * age_variance;
            let coasted_variance = open_variance + while_off * age_variance;
            // Δv = a_b B + a_c C, of independent a_b and a_c; the mean of a_c is 0.
            mean += course.probability * (brakes * braked + coasts * coasted);
            square += course.probability
                * ((brakes_variance + brakes * brakes) * (braked * braked + braked_variance)
                    + (coasts_variance + coasts * coasts) * (coasted * coasted + coasted_variance));
        }
        [mean, square - mean * mean]
    }

    fn parts(&self, errors: &ImpactSpeedErrors) -> Vec<SpeedErrorPart> {
        let part = |source, shift, variance| SpeedErrorPart { source, shift, variance };
        let [slip, slip_sd] = slip(self.stored, self.hard, errors);
        let tyres = errors.tyre_sd * self.stored;
        let [gap, gap_variance] = self.change([0.0, 0.0], errors);
        // The part of the whole change that is not due to the gap alone is due to the age.
        let [whole, variance] = self.change(uniform([0.0, errors.latency]), errors);
        vec![
            part(SpeedErrorSource::Rounding, 0.0, errors.step * errors.step / 12.0),
            part(SpeedErrorSource::Slip, slip, slip_sd * slip_sd),
            part(SpeedErrorSource::Tyres, 0.0, tyres * tyres),
            part(SpeedErrorSource::Gap, gap, gap_variance),
            part(SpeedErrorSource::Latency, whole - gap, variance - gap_variance),
        ]
    }

    fn hump(&self, probability: f64, errors: &ImpactSpeedErrors) -> SpeedHump {
        let parts = self.parts(errors);
        let mean = self.stored + parts.iter().map(|part| part.shift).sum::<f64>();
        let variance: f64 = parts.iter().map(|part| part.variance).sum();
        SpeedHump { probability, mean: mean.max(0.0), sd: variance.sqrt() }
    }

    /// The course of the brake at this cumulative probability, and the position within that course.
    fn course(&self, mut share: f64) -> (BrakeCourse, f64) {
        let mut chosen = (self.courses[0], share);
        for course in self.courses.iter().filter(|course| course.probability > 0.0) {
            chosen = (*course, (share / course.probability).min(1.0));
            if share < course.probability {
                break;
            }
            share -= course.probability;
        }
        chosen
    }

    /// (m/s) the speed at impact for a point of the unit cube.
    fn draw(&self, point: &[f64; DIMENSIONS], errors: &ImpactSpeedErrors) -> f64 {
        let between = |[least, greatest]: [f64; 2], share: f64| least + (greatest - least) * share;
        let [slip, slip_sd] = slip(self.stored, self.hard, errors);
        let rounding = between([-0.5 * errors.step, 0.5 * errors.step], point[0]);
        let mut normal = [point[1], point[2]];
        quantiles(&mut normal);
        let slip = slip + slip_sd * normal[0];
        let tyres = self.stored * errors.tyre_sd * normal[1];
        let age = errors.latency * point[3];
        let (course, first) = self.course(point[4]);
        let braked = course.braked + course.open * point[6];
        // The driver's action at the sample also lasts through the age, and takes the finer of the two
        // coordinates.
        let (brakes, coasts, braked, coasted) = if course.is_on {
            (first, point[7], braked + age, self.gap - braked)
        } else {
            (point[7], first, braked, self.gap - braked + age)
        };
        let changed = between(course.braking, brakes) * braked + between(errors.coasting(), coasts) * coasted;
        // v₀ = v + e + s + t + a_b B + a_c C
        self.stored + rounding + slip + tyres + changed
    }
}

/// (1) slip of the wheels as a share of that in hard braking, mean and variance, from the switches of a
/// sample and from how fast the stored speed fell to it (m/s²), if that is known.
fn slips(
    sample: &PreCrashSample,
    before: Option<&PreCrashSample>,
    slowed: Option<f64>,
    errors: &ImpactSpeedErrors,
) -> [f64; 2] {
    let hard = errors.friction * GRAVITY;
    match (sample.abs, slowed) {
        (Some(true), _) => [1.0, 0.0],
        (_, Some(slowed)) => {
            // With the brake off, an engine that brakes makes no wheel slip.
            let from = if sample.brake == Some(false) { errors.coasting } else { 0.0 };
            let share = if hard > from { ((slowed - from) / (hard - from)).clamp(0.0, 1.0) } else { 0.0 };
            let came_on = sample.brake == Some(true) && before.and_then(|before| before.brake) == Some(false);
            if came_on && share > 0.0 && share < 1.0 {
                // It acted for a part f of the time, h f = share. With uniform f and h, h has a density ~ 1/h
                // from the share to 1: E(h) = (1 − share)/ln(1/share), E(h²) = (1 − share²)/(2 ln(1/share))
                let span = -ln(share);
                let mean = (1.0 - share) / span;
                return [mean, (1.0 - share * share) / (2.0 * span) - mean * mean];
            }
            [share, 0.0]
        }
        (_, None) => {
            let on = sample.brake.map_or(UNKNOWN_BRAKE, |on| if on { 1.0 } else { 0.0 });
            // Braked by any part of hard braking if it was on: E(h) = p/2, E(h²) = p/3
            [on / 2.0, on / 3.0 - on * on / 4.0]
        }
    }
}

/// (m/s²) how fast the stored speed fell to the sample at this place: over the half second before it in which
/// the brake was as it is there, or at least since the sample before. Over a tenth of a second, the steps in
/// which speeds are stored hide the deceleration.
fn slowed(points: &[(&PreCrashSample, f64)], k: usize) -> Option<f64> {
    let (sample, speed) = points[k];
    let is_near = |(one, _): &&(&PreCrashSample, f64)| {
        one.brake == sample.brake && sample.time - one.time < HALF_SECOND * (1.0 + 1e-9)
    };
    let earlier = &points[..k];
    let fall = |(before, first): &(&PreCrashSample, f64)| (first - speed) / (sample.time - before.time);
    let window = earlier.iter().rev().take_while(is_near).last().map(fall);
    // A steeper fall is not that of the vehicle.
    window.filter(|fall| *fall <= GRAVITY).or_else(|| earlier.last().map(fall))
}

/// The speed of a vehicle when a sample was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleSpeed {
    /// (s) time of the sample, negative before the impact.
    pub time: f64,
    /// (m/s) the stored speed, corrected for the average slip of the wheels.
    pub speed: f64,
    /// (m/s) standard deviation of the error that the samples share: slip and tyres, without rounding.
    pub sd: f64,
}

/// (m/s²) 1.2 g: no tyre slows a vehicle by more. The manual of EDCRASH lists friction of at most 1.00 above
/// 48 km/h, on new dry asphalt or concrete, and of at most 1.20 below.
pub const BEYOND_TYRES: f64 = 1.2 * GRAVITY;

/// Samples at the end whose speeds are all lower than 1 g from the sample before them allows.
struct Fallen {
    /// The place of the first.
    first: usize,
    /// (1) the probability that no tyre does this: from 0 at 1 g to 1 at [`BEYOND_TYRES`].
    probability: f64,
}

impl Fallen {
    fn of(points: &[(&PreCrashSample, f64)], step: f64) -> Option<Self> {
        let limits = SpeedLimits::stored_in(step);
        // (m/s²) the least deceleration, however the two speeds were rounded, if it is beyond the limit.
        let least = |(one, first): (&PreCrashSample, f64), (other, later): (&PreCrashSample, f64)| {
            let time = other.time - one.time;
            let is_below = later < first && limits.beyond(time, later - first).is_some();
            is_below.then(|| (first - later - step) / time)
        };
        (1..points.len()).find_map(|k| {
            let later = points[k..].iter().map(|later| least(points[k - 1], *later));
            let least = later.reduce(|one, other| Some(one?.min(other?))).flatten()?;
            // Without braking, wheels neither slip nor lock: something slowed the vehicle itself.
            let fallen = &points[k..];
            let rolls = fallen.len() > 1 && fallen.iter().all(|(sample, _)| sample.brake == Some(false));
            let probability = ((least - GRAVITY) / (BEYOND_TYRES - GRAVITY)).clamp(0.0, 1.0);
            (!rolls).then_some(Self { first: k, probability })
        })
    }
}

/// The speed of the vehicle at each sample that has one, the earliest first. If several samples at the end
/// show slipping wheels, only those before them count. The effect of the age of a stored speed is ignored.
fn sample_speeds(record: &PreCrash, errors: &ImpactSpeedErrors) -> Vec<SampleSpeed> {
    let mut points: Vec<_> = record.speeds().collect();
    let fallen = Fallen::of(&points, errors.step).filter(|fallen| fallen.first + 1 < points.len());
    if let Some(fallen) = fallen.filter(|fallen| fallen.probability > 0.5) {
        points.truncate(fallen.first);
    }
    let samples = points.iter().enumerate().map(|(k, (sample, stored))| {
        let before = k.checked_sub(1).map(|before| points[before].0);
        // The first is judged by the one after it.
        let slowed = slowed(&points, k).or_else(|| (points.len() > 1).then(|| slowed(&points, 1)).flatten());
        let [slip, slip_sd] = slip(*stored, slips(sample, before, slowed, errors), errors);
        let tyres = errors.tyre_sd * stored;
        // The wheels of a vehicle at rest did not slip.
        let moved = if *stored > 0.0 { 1.0 } else { 0.0 };
        SampleSpeed {
            time: sample.time,
            speed: stored + moved * slip,
            sd: moved * (slip_sd * slip_sd + tyres * tyres).sqrt(),
        }
    });
    samples.collect()
}

/// (–) largest difference, in standard deviations, between a speed at the impact and the recorder's that the
/// errors of the samples explain; whatever exceeds it has another cause.
const MOST_SHARED: f64 = 2.0;

/// The approach of a vehicle to the impact, by the samples that its recorder stored before.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledApproach {
    /// Its speed at each sample, the earliest first.
    pub samples: Vec<SampleSpeed>,
    /// (m/s) mean and standard deviation of its speed at the impact.
    pub at_impact: [f64; 2],
    /// (m/s) the step in which the speeds are stored: each is rounded by up to half of it.
    pub step: f64,
}

impl SampledApproach {
    /// The approach by the samples of a record.
    ///
    /// # Errors
    /// Errors beyond their range, or a record without a speed.
    pub fn of(record: &PreCrash, errors: &ImpactSpeedErrors) -> Result<Self, ImpactSpeedFault> {
        let ImpactSpeed { mean, sd, .. } = ImpactSpeed::of(record, errors)?;
        Ok(Self { samples: sample_speeds(record, errors), at_impact: [mean, sd], step: errors.step })
    }

    /// (–) mean and standard deviation of the error that the samples share, in standard deviations of each,
    /// if the speed at the impact (m/s) is known: slip and tyres are a part of the error of the recorder's.
    #[must_use]
    pub fn shared_error(&self, at_impact: f64) -> [f64; 2] {
        let [mean, sd] = self.at_impact;
        let last = self.samples.last().map_or(0.0, |sample| sample.sd);
        // Of two jointly normal numbers with the correlation ρ = σ_n/σ: ρ z ± √(1 − ρ²)
        let share = if sd > 0.0 { (last / sd).min(1.0) } else { 0.0 };
        // Slip and tyres explain no more than that.
        let off = if sd > 0.0 { ((at_impact - mean) / sd).clamp(-MOST_SHARED, MOST_SHARED) } else { 0.0 };
        [share * off, (1.0 - share * share).sqrt()]
    }
}

/// Number of points that represent the distribution.
const POINTS: u32 = 2048;

impl ImpactSpeed {
    /// The speed at impact from the last samples.
    ///
    /// # Errors
    ///
    /// Errors beyond their range, or a record without a speed.
    pub fn of(record: &PreCrash, errors: &ImpactSpeedErrors) -> Result<Self, ImpactSpeedFault> {
        errors.check()?;
        let points: Vec<_> = record.speeds().collect();
        let (last, stored) = *points.last().ok_or(ImpactSpeedFault::NoSpeed)?;
        // (m/s²) how fast the speed fell to the sample at this place.
        let fall = |k: usize| {
            let [(one, first), (two, second)] = [points[k.checked_sub(1)?], points[k]];
            Some((first - second) / (two.time - one.time))
        };
        let leg = |k: usize| {
            let (sample, stored) = points[k];
            let before = k.checked_sub(1).map(|before| points[before].0);
            let shown = slowed(&points, k);
            let hard = slips(sample, before, shown, errors);
            let braked = |place: usize| points[place].0.brake == Some(true);
            // A steeper fall is not that of the vehicle.
            let kept = shown.filter(|fall| *fall <= GRAVITY && braked(k) && braked(k - 1));
            let courses = brake_courses(record, sample.time, kept, errors);
            Leg { stored, gap: 0.0 - sample.time, hard, courses }
        };
        let end = points.len() - 1;
        let deceleration = fall(end);
        let mut legs = vec![(1.0, leg(end))];
        let mut steep_fall = None;
        if let Some(Fallen { first, probability }) = Fallen::of(&points, errors.step) {
            let (sample, speed) = points[first - 1];
            let deceleration = (speed - stored) / (last.time - sample.time);
            let is_slip = first < end;
            let doubt = probability * if is_slip { 1.0 } else { errors.last_is_of_impact };
            steep_fall =
                Some(SteepFall { deceleration, time: sample.time, speed, is_slip, probability: doubt });
            legs = vec![(1.0 - doubt, leg(end)), (doubt, leg(first - 1))];
        }
        let humps = match &legs[..] {
            [(last, low), (earlier, high)] if *last > 0.0 && *earlier > 0.0 => {
                Some([low.hump(*last, errors), high.hump(*earlier, errors)])
            }
            _ => None,
        };
        let (speeds, shares) = drawn(&legs, errors);
        let mut parts = parts(&legs, &shares, errors);
        let is_cut = speeds.iter().any(|speed| *speed < 0.0);
        let draws = Draws::new(speeds.into_iter().map(|speed| speed.max(0.0) + 0.0).collect());
        let [mean, sd] = draws.moments();
        if is_cut {
            let sum = |of: fn(&SpeedErrorPart) -> f64| parts.iter().map(of).sum::<f64>();
            let shift = mean - stored - sum(|part| part.shift);
            let variance = sd * sd - sum(|part| part.variance);
            parts.push(SpeedErrorPart { source: SpeedErrorSource::CutOff, shift, variance });
        }
        let (time, brake) = (last.time, last.brake);
        Ok(Self { time, stored, brake, deceleration, mean, sd, parts, steep_fall, humps, draws })
    }

    /// (m/s) the speed that is not exceeded with this probability.
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        self.draws.quantile(probability)
    }

    /// (m/s) the interval that contains the speed with this probability (from 0 to 1), with half of the rest
    /// on either side.
    #[must_use]
    pub fn interval(&self, probability: f64) -> [f64; 2] {
        let tail = 0.5 * (1.0 - probability.clamp(0.0, 1.0));
        [self.quantile(tail), self.quantile(1.0 - tail)]
    }
}

/// Mean and variance by source, over the legs with these shares of the points.
fn parts(legs: &[(f64, Leg)], shares: &[f64], errors: &ImpactSpeedErrors) -> Vec<SpeedErrorPart> {
    let each: Vec<(f64, f64, Vec<SpeedErrorPart>)> =
        legs.iter().zip(shares).map(|((_, leg), share)| (*share, leg.stored, leg.parts(errors))).collect();
    let Some((_, stored, first)) = each.first() else { return Vec::new() };
    let mut all: Vec<SpeedErrorPart> = first
        .iter()
        .enumerate()
        .map(|(k, part)| {
            let sum = |of: fn(&SpeedErrorPart) -> f64| -> f64 {
                each.iter().map(|(weight, _, parts)| weight * of(&parts[k])).sum()
            };
            // Zero has no sign on any machine.
            let shift = sum(|p| p.shift) + 0.0;
            SpeedErrorPart { source: part.source, shift, variance: sum(|p| p.variance) }
        })
        .collect();
    if each.len() > 1 {
        let mean_of =
            |parts: &[SpeedErrorPart], stored: f64| stored + parts.iter().map(|p| p.shift).sum::<f64>();
        let mean: f64 = each.iter().map(|(weight, stored, parts)| weight * mean_of(parts, *stored)).sum();
        // Var(v) = E(Var(v | leg)) + Var(E(v | leg))
        let variance: f64 = each
            .iter()
            .map(|(weight, stored, parts)| {
                weight * (mean_of(parts, *stored) - mean) * (mean_of(parts, *stored) - mean)
            })
            .sum();
        let shifted: f64 = each.iter().map(|(weight, own, _)| weight * (own - stored)).sum();
        all.push(SpeedErrorPart { source: SpeedErrorSource::LastSample, shift: shifted, variance });
    }
    all
}

/// The place of the leg that a point of the unit cube chooses.
fn leg_of(point: &[f64; DIMENSIONS], legs: &[(f64, Leg)]) -> usize {
    let mut share = point[5];
    let is_within = |(weight, _): &(f64, Leg)| {
        let is_within = share < *weight;
        share -= weight;
        is_within
    };
    legs.iter().position(is_within).unwrap_or(legs.len() - 1)
}

/// (m/s) evenly spread speeds at the impact: one below 0 is that of a vehicle that stopped before. Also the
/// share of them that each leg has, which differs a little from its probability.
fn drawn(legs: &[(f64, Leg)], errors: &ImpactSpeedErrors) -> (Vec<f64>, Vec<f64>) {
    let mut shares = vec![0.0; legs.len()];
    let draw = |k: u32| {
        let point = radical_point(k);
        let leg = leg_of(&point, legs);
        shares[leg] += 1.0 / f64::from(POINTS);
        legs[leg].1.draw(&point, errors)
    };
    let speeds = (0..POINTS).map(draw).collect();
    (speeds, shares)
}
