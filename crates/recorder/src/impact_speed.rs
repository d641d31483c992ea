//! The speed at the impact as a distribution, from the last samples before it.

use uncertainty::normal::quantiles;

use crate::channel::GRAVITY;
use crate::pre_crash::PreCrash;
use crate::spread::{Draws, radical_point};

/// (km/h) in m/s.
const KMH: f64 = 1.0 / 3.6;

/// The errors of a stored speed as the speed at impact. Each is a default that may be changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactSpeedErrors {
    /// (m/s) step in which speeds are stored, to the nearest: 1 km/h in 49 CFR 563 and UN R160.
    pub step: f64,
    /// (1) fraction by which the speed reads low while the wheels roll: 1.4 % on average (18 runs of
    /// a 2010 Ford Flex against GPS, steady at 113 km/h).
    pub steady_low: f64,
    /// (1) standard deviation of that share: 0.43 %, from "within 2.5 % at 99 %" of the same runs.
    pub steady_sd: f64,
    /// (1) standard deviation of the fraction by which worn or different tyres change the speed: 0.7 %. 7 mm
    /// of tread are 2.2 % of a radius of 320 mm; worn by any part of that, the standard deviation is 0.6 %.
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
    /// (1) probability that the brake, off in the last sample, came on in the gap: 0.25 in each half second.
    pub brake_comes_on: f64,
    /// (s) greatest age of a stored speed at the time that the record gives for it: 0.1 s, at any part of it.
    /// The wheels' control unit sends it every 10 to 100 ms, and the recorder takes the last one that came.
    pub latency: f64,
    /// (1) probability that a last speed that fell by more than `g` allows is not that of the vehicle before
    /// the impact: 0.5. It is then slip, or the impact itself, and the sample before it counts.
    pub last_is_of_impact: f64,
}

impl Default for ImpactSpeedErrors {
    fn default() -> Self {
        Self {
            step: KMH,
            steady_low: 0.014,
            steady_sd: 0.0043,
            tyre_sd: 0.007,
            slip_low: 3.0 * KMH,
            slip_sd: 2.1 * KMH,
            friction: 0.75,
            coasting: 1.0,
            brake_comes_on: 0.25,
            latency: 0.1,
            last_is_of_impact: 0.5,
        }
    }
}

/// What a part of the error of the speed at impact comes from.
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
        }
    }
}

/// What one source does to the speed at impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedErrorPart {
    /// Which.
    pub source: SpeedErrorSource,
    /// (m/s) by how much it moves the mean.
    pub shift: f64,
    /// (m²/s²) its part of the variance. The parts add up to the whole.
    pub variance: f64,
}

/// The last speed fell faster than by 1 g since the sample before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteepFall {
    /// (m/s²) deceleration between the two, positive.
    pub deceleration: f64,
    /// (s) time of the sample before.
    pub time: f64,
    /// (m/s) its speed.
    pub speed: f64,
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
    /// (m/s²) deceleration between the last two samples with a speed, positive where it slowed.
    pub deceleration: Option<f64>,
    /// (m/s) mean of the speed at impact.
    pub mean: f64,
    /// (m/s) its standard deviation.
    pub sd: f64,
    /// What it comes from, in the order of the sources.
    pub parts: Vec<SpeedErrorPart>,
    /// Where the last speed fell by more than 1 g.
    pub steep_fall: Option<SteepFall>,
    draws: Draws,
}

/// Why the errors give no distribution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{name} of the recorder's speed is {value}: write a number from {least} to {greatest}")]
pub struct SpeedErrorOutOfRange {
    /// Of which field.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
}

impl ImpactSpeedErrors {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// The first that is not in its range.
    pub fn check(&self) -> Result<(), SpeedErrorOutOfRange> {
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
            ("latency", self.latency, 2.0),
            ("last_is_of_impact", self.last_is_of_impact, 1.0),
        ];
        for (name, value, greatest) in fields {
            if !(0.0..=greatest).contains(&value) {
                return Err(SpeedErrorOutOfRange { name, value, least: 0.0, greatest });
            }
        }
        Ok(())
    }
}

/// From one sample to t = 0.
#[derive(Clone, Copy)]
struct Leg {
    stored: f64,
    /// (s) from the sample to t = 0.
    gap: f64,
    /// (1) by how much of hard braking the wheels slip, 0 to 1.
    hard: f64,
    /// (m/s²) the accelerations in the gap, from the least to the greatest.
    brakes: [f64; 2],
    coasts: [f64; 2],
    /// Probability of the first.
    braked: f64,
}

/// Mean and variance of a uniform number.
fn uniform([least, greatest]: [f64; 2]) -> [f64; 2] {
    let width = greatest - least;
    // σ² = w²/12
    [0.5 * (least + greatest), width * width / 12.0]
}

impl Leg {
    /// Mean and variance of the acceleration.
    fn acceleration(&self) -> [f64; 2] {
        let [[m1, v1], [m2, v2]] = [uniform(self.brakes), uniform(self.coasts)];
        let p = self.braked;
        let mean = p * m1 + (1.0 - p) * m2;
        // σ² = p (σ₁² + m₁²) + (1 − p) (σ₂² + m₂²) − m²
        [mean, p * (v1 + m1 * m1) + (1.0 - p) * (v2 + m2 * m2) - mean * mean]
    }

    /// Mean and standard deviation of what slip takes off the stored speed.
    fn slip(&self, errors: &ImpactSpeedErrors) -> [f64; 2] {
        let rolling = 1.0 - self.hard;
        let mean = self.hard * errors.slip_low + rolling * errors.steady_low * self.stored;
        let [braked, steady] = [self.hard * errors.slip_sd, rolling * errors.steady_sd * self.stored];
        [mean, (braked * braked + steady * steady).sqrt()]
    }

    fn parts(&self, errors: &ImpactSpeedErrors) -> Vec<SpeedErrorPart> {
        let part = |source, shift, variance| SpeedErrorPart { source, shift, variance };
        let [slip, slip_sd] = self.slip(errors);
        let tyres = errors.tyre_sd * self.stored;
        let [mean, variance] = self.acceleration();
        let [age, age_variance] = uniform([0.0, errors.latency]);
        let all = self.gap + age;
        // Var(a (g + ℓ)) = Var(a) ((g + ℓ)² + Var(ℓ)) + a² Var(ℓ), of which Var(a) g² is of the gap alone.
        let whole = variance * (all * all + age_variance) + mean * mean * age_variance;
        let gap = variance * self.gap * self.gap;
        vec![
            part(SpeedErrorSource::Rounding, 0.0, errors.step * errors.step / 12.0),
            part(SpeedErrorSource::Slip, slip, slip_sd * slip_sd),
            part(SpeedErrorSource::Tyres, 0.0, tyres * tyres),
            part(SpeedErrorSource::Gap, mean * self.gap, gap),
            part(SpeedErrorSource::Latency, mean * age, whole - gap),
        ]
    }

    /// (m/s) the speed at impact for a point of the unit cube.
    fn draw(&self, point: &[f64; 6], errors: &ImpactSpeedErrors) -> f64 {
        let between = |[least, greatest]: [f64; 2], share: f64| least + (greatest - least) * share;
        let [slip, slip_sd] = self.slip(errors);
        let rounding = between([-0.5 * errors.step, 0.5 * errors.step], point[0]);
        let mut normal = [point[1], point[2]];
        quantiles(&mut normal);
        let slip = slip + slip_sd * normal[0];
        let tyres = self.stored * errors.tyre_sd * normal[1];
        let age = errors.latency * point[3];
        let acceleration = if point[4] < self.braked {
            between(self.brakes, point[4] / self.braked)
        } else {
            between(self.coasts, (point[4] - self.braked) / (1.0 - self.braked))
        };
        // v₀ = v + e + s + t + a (g + ℓ)
        self.stored + rounding + slip + tyres + acceleration * (self.gap + age)
    }
}

/// (1) by how much of hard braking (m/s²) the wheels slip, by the switches of brake and ABS and by how much
/// the stored speed fell (m/s²).
fn slips([brake, abs]: [Option<bool>; 2], slowed: f64, hard: f64) -> f64 {
    match (abs, brake) {
        (Some(true), _) => 1.0,
        (_, Some(false)) => 0.0,
        _ if hard > 0.0 => (slowed / hard).clamp(0.0, 1.0),
        _ => 0.0,
    }
}

/// How fast a vehicle was when a sample was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleSpeed {
    /// (s) time of the sample, negative before the impact.
    pub time: f64,
    /// (m/s) the speed that was stored, with what the wheels slipped on average.
    pub speed: f64,
    /// (m/s) standard deviation of its error, which the samples share: slip and tyres. Rounding is left
    /// aside.
    pub sd: f64,
}

/// How fast the vehicle was at each sample with a speed, the earliest first. What the age of a stored speed
/// does is left aside.
fn sample_speeds(
    record: &PreCrash,
    errors: &ImpactSpeedErrors,
) -> Result<Vec<SampleSpeed>, SpeedErrorOutOfRange> {
    errors.check()?;
    let hard = errors.friction * GRAVITY;
    let mut before: Option<(f64, f64)> = None;
    let samples = record.speeds().map(|(sample, stored)| {
        let slowed = before.map_or(0.0, |(time, speed)| (speed - stored) / (sample.time - time));
        before = Some((sample.time, stored));
        let hard = slips([sample.brake, sample.abs], slowed, hard);
        let leg = Leg { stored, gap: 0.0, hard, brakes: [0.0; 2], coasts: [0.0; 2], braked: 0.0 };
        let [slip, slip_sd] = leg.slip(errors);
        let tyres = errors.tyre_sd * stored;
        // A vehicle that stood has nothing that slips.
        let moved = if stored > 0.0 { 1.0 } else { 0.0 };
        SampleSpeed {
            time: sample.time,
            speed: stored + moved * slip,
            sd: moved * (slip_sd * slip_sd + tyres * tyres).sqrt(),
        }
    });
    Ok(samples.collect())
}

/// (–) standard deviations by which a speed at the impact may differ from the recorder's for its samples to
/// err likewise; one that differs by more does so for another reason.
const MOST_SHARED: f64 = 2.0;

/// How a vehicle came to the impact, by the samples that its recorder stored before.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledApproach {
    /// Its speed at each sample, the earliest first.
    pub samples: Vec<SampleSpeed>,
    /// (m/s) mean and standard deviation of its speed at the impact.
    pub at_impact: [f64; 2],
}

impl SampledApproach {
    /// The approach by the samples of a record.
    ///
    /// # Errors
    /// Errors beyond their range.
    pub fn of(record: &PreCrash, errors: &ImpactSpeedErrors) -> Result<Self, SpeedErrorOutOfRange> {
        let samples = sample_speeds(record, errors)?;
        let ImpactSpeed { mean, sd, .. } = ImpactSpeed::of(record, errors)?;
        Ok(Self { samples, at_impact: [mean, sd] })
    }

    /// (–) mean and standard deviation of the error that the samples share, in standard deviations of each,
    /// where the speed at the impact (m/s) is known: slip and tyres are a part of what that one is off by.
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

/// How many points stand for the distribution.
const POINTS: u32 = 2048;

impl ImpactSpeed {
    /// The speed at impact from the last samples.
    ///
    /// # Errors
    ///
    /// Errors beyond their range.
    pub fn of(record: &PreCrash, errors: &ImpactSpeedErrors) -> Result<Self, SpeedErrorOutOfRange> {
        errors.check()?;
        let points: Vec<_> = record.speeds().map(|(sample, speed)| (*sample, speed)).collect();
        let hard = errors.friction * GRAVITY;
        // A record without a speed is refused where it is made, so that this default is never taken.
        let (last, stored) = points.last().copied().unwrap_or_default();
        let before = points.len().checked_sub(2).map(|k| points[k]);
        let deceleration = before.map(|(sample, speed)| (speed - stored) / (last.time - sample.time));
        let allowed =
            |slowed: f64| slowed - errors.step / before.map_or(1.0, |(one, _)| last.time - one.time);
        let steep = deceleration.filter(|slowed| allowed(*slowed) > GRAVITY);
        let coasts = [-errors.coasting, errors.coasting];
        let leg = |time: f64, stored: f64, brake: Option<bool>, abs: Option<bool>, slowed: f64| {
            let gap = if time < 0.0 { -time } else { 0.0 };
            let slips = slips([brake, abs], slowed, hard);
            // Without a sample in the gap nobody knows when the brake came on. 0.25 in half a second.
            let comes_on = (errors.brake_comes_on * gap / 0.5).min(1.0);
            let braked = match brake {
                Some(true) => 1.0,
                Some(false) => comes_on,
                None => 0.5_f64.max(comes_on),
            };
            Leg { stored, gap, hard: slips, brakes: [-hard, 0.0], coasts, braked }
        };
        let slowed = deceleration.unwrap_or(0.0);
        let own = leg(last.time, stored, last.brake, last.abs, slowed);
        let mut legs = vec![(1.0, own)];
        let mut steep_fall = None;
        if let (Some(deceleration), Some((sample, speed))) = (steep, before) {
            steep_fall = Some(SteepFall { deceleration, time: sample.time, speed });
            let doubt = errors.last_is_of_impact;
            // Braked somewhere between the two samples, if the brake was on at either.
            let brake = if last.brake == Some(true) { last.brake } else { sample.brake };
            let earlier = leg(sample.time, speed, brake, sample.abs, 0.0);
            legs = vec![(1.0 - doubt, own), (doubt, earlier)];
        }
        let parts = parts(&legs, errors);
        let draws = draws(&legs, errors);
        let [mean, sd] = draws.moments();
        let (time, brake) = (last.time, last.brake);
        Ok(Self { time, stored, brake, deceleration, mean, sd, parts, steep_fall, draws })
    }

    /// (m/s) the speed that is not exceeded with this probability.
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        self.draws.quantile(probability)
    }

    /// (m/s) the interval that holds the speed with this probability, as much of the rest on either side.
    #[must_use]
    pub fn interval(&self, probability: f64) -> [f64; 2] {
        let tail = 0.5 * (1.0 - probability);
        [self.quantile(tail), self.quantile(1.0 - tail)]
    }

    /// (s/m) the density of the speed in this many equal bins, each with its lower edge (m/s).
    #[must_use]
    pub fn density(&self, bins: usize) -> Vec<(f64, f64)> {
        self.draws.density(bins)
    }
}

/// Mean and variance by source, over the legs.
fn parts(legs: &[(f64, Leg)], errors: &ImpactSpeedErrors) -> Vec<SpeedErrorPart> {
    let each: Vec<(f64, f64, Vec<SpeedErrorPart>)> =
        legs.iter().map(|(weight, leg)| (*weight, leg.stored, leg.parts(errors))).collect();
    let Some((_, stored, first)) = each.first() else { return Vec::new() };
    let mut all: Vec<SpeedErrorPart> = first
        .iter()
        .enumerate()
        .map(|(k, part)| {
            let sum = |of: fn(&SpeedErrorPart) -> f64| -> f64 {
                each.iter().map(|(weight, _, parts)| weight * of(&parts[k])).sum()
            };
            // Zero has no sign, on no machine.
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

fn draws(legs: &[(f64, Leg)], errors: &ImpactSpeedErrors) -> Draws {
    let draw = |k: u32| {
        let point = radical_point(k);
        let mut share = point[5];
        let mut chosen = legs[0].1;
        for (weight, leg) in legs {
            chosen = *leg;
            if share < *weight {
                break;
            }
            share -= weight;
        }
        // No vehicle drives backward into its record.
        chosen.draw(&point, errors).max(0.0) + 0.0
    };
    Draws::new((0..POINTS).map(draw).collect())
}
