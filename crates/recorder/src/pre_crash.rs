//! The data that a recorder stored before the impact, and the distance travelled between its samples.

use crate::assumption::{AssumptionOutOfRange, in_ranges};
use crate::channel::{Channel, GRAVITY, MPH};
use crate::table::RecorderTable;

/// The data that a recorder stored for one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PreCrashSample {
    /// (s) time, negative before the impact.
    pub time: f64,
    /// (m/s) indicated speed.
    pub speed: Option<f64>,
    /// Whether the service brake was on.
    pub brake: Option<bool>,
    /// Whether the antilock brakes were at work.
    pub abs: Option<bool>,
    /// (%) accelerator pedal.
    pub accelerator: Option<f64>,
    /// (%) engine throttle.
    pub throttle: Option<f64>,
    /// (rev/min) engine speed.
    pub engine_speed: Option<f64>,
    /// (rad) steering wheel, in the sense of the recorder.
    pub steering: Option<f64>,
    /// (rad/s) yaw rate, in the sense of the recorder.
    pub yaw_rate: Option<f64>,
}

/// The samples before an impact, whose times rise.
#[derive(Clone, Debug, PartialEq)]
pub struct PreCrash {
    samples: Vec<PreCrashSample>,
    step: (f64, StepSource),
}

/// (m/s) step in which speeds are stored by 49 CFR 563 and UN R160: 1 km/h.
pub(crate) const REGULAR_STEP: f64 = 1.0 / 3.6;

/// How the step in which speeds are stored was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepSource {
    /// It is the one of 49 CFR 563 and UN R160, 1 km/h: the speeds show no other.
    Regular,
    /// All speeds are whole numbers of the unit of their column.
    Unit,
    /// All of this many different speeds are multiples of it.
    Multiples(usize),
    /// All of this many different speeds, in km/h, are whole miles per hour, converted and rounded.
    Miles(usize),
}

impl StepSource {
    /// Its key in JSON.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::Unit => "unit",
            Self::Multiples(_) => "multiples",
            Self::Miles(_) => "miles",
        }
    }
}

/// Steps in units of a column, and how many different speeds that are all multiples show each. Of 4 whole
/// numbers all are multiples of 5 by chance with a probability of 1/625, and of 6 all are even with 1/64; an
/// even deceleration makes both more likely.
const SHOW_MULTIPLES: [(f64, usize); 2] = [(5.0, 4), (2.0, 6)];
/// How many different speeds in whole km/h show whole miles per hour. Of all whole km/h, 62 % are a whole
/// mile per hour after rounding: 8 are all by chance with a probability of 1/44.
const SHOW_MILES: usize = 8;
/// As [`SHOW_MILES`], of speeds in km/h with one decimal: two are whole miles to 0.05 km/h in one of 250
/// pairs.
const SHOW_MILES_BY_DECIMALS: usize = 2;

/// (m/s) the step in which these speeds (m/s) of a column in `unit` (m/s) are stored, and how it was found.
fn stored_step(speeds: &[f64], unit: f64) -> (f64, StepSource) {
    let mut moving: Vec<f64> = speeds.iter().copied().filter(|speed| *speed > 0.0).collect();
    moving.sort_by(f64::total_cmp);
    moving.dedup();
    let count = moving.len();
    let are_whole = |step: f64, error: f64| {
        moving.iter().all(|speed| (speed - (speed / step).round() * step).abs() <= error * (1.0 + 1e-6))
    };
    let is_metric = (unit - REGULAR_STEP).abs() < EXACT;
    if !are_whole(unit, EXACT) {
        // Tables of NHTSA have miles per hour, converted to km/h with one decimal.
        let are_miles = is_metric && count >= SHOW_MILES_BY_DECIMALS && are_whole(MPH, 0.05 * REGULAR_STEP);
        return if are_miles { (MPH, StepSource::Miles(count)) } else { (REGULAR_STEP, StepSource::Regular) };
    }
    let shows = |(times, least): &(f64, usize)| count >= *least && are_whole(times * unit, EXACT);
    match SHOW_MULTIPLES.into_iter().find(shows) {
        Some((times, _)) => (times * unit, StepSource::Multiples(count)),
        _ if is_metric && count >= SHOW_MILES && are_whole(MPH, 0.5 * REGULAR_STEP) => {
            (MPH, StepSource::Miles(count))
        }
        _ if speeds.is_empty() || is_metric => (REGULAR_STEP, StepSource::Regular),
        _ => (unit, StepSource::Unit),
    }
}

/// (m/s) numbers that differ by less are the same number, converted.
const EXACT: f64 = 1e-6;

/// Why samples are not a record before an impact.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PreCrashFault {
    /// No sample at all.
    #[error("the record has no sample")]
    NoSample,
    /// A time or a value that is not a number.
    #[error("sample {sample}: a time, speed or other value is not a finite number")]
    NotFinite {
        /// From 1.
        sample: usize,
    },
    /// A speed below zero.
    #[error("sample {sample}: the speed {speed} m/s is negative; a recorder stores speeds without a sign")]
    NegativeSpeed {
        /// From 1.
        sample: usize,
        /// (m/s) the speed.
        speed: f64,
    },
    /// A number that no recorder stores, and no table is read with.
    #[error("sample {sample}: the {} {value} (SI) is beyond what a recorder stores", .channel.name())]
    OutOfRange {
        /// From 1.
        sample: usize,
        /// Which number.
        channel: Channel,
        /// (SI) its value.
        value: f64,
    },
    /// Times that do not rise.
    #[error("sample {sample}: its time {time} s is not later than {before} s of the one before it")]
    TimesTurn {
        /// From 1.
        sample: usize,
        /// (s) its time.
        time: f64,
        /// (s) the time before.
        before: f64,
    },
    /// A time after the impact.
    #[error(
        "sample {sample}: {time} s is after the impact at 0: leave out the rows after 0; times before it are \
         negative, or count down to 0"
    )]
    AfterImpact {
        /// From 1.
        sample: usize,
        /// (s) its time.
        time: f64,
    },
}

impl PreCrashFault {
    /// The sample that is at fault, from 1.
    #[must_use]
    pub fn sample(&self) -> Option<usize> {
        match self {
            Self::NoSample => None,
            Self::NotFinite { sample }
            | Self::NegativeSpeed { sample, .. }
            | Self::OutOfRange { sample, .. }
            | Self::TimesTurn { sample, .. }
            | Self::AfterImpact { sample, .. } => Some(*sample),
        }
    }
}

/// How the speed may change between samples, and how exactly it was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLimits {
    /// (m/s) greatest error of a stored speed, either way. 0.5 km/h: 49 CFR 563 and UN R160 have it stored in
    /// steps of 1 km/h.
    pub rounding: f64,
    /// (m/s²) greatest deceleration, positive: 1 g.
    pub deceleration: f64,
    /// (m/s²) greatest acceleration: 1 g, since a wheel that regains its grip under ABS is as quick.
    pub acceleration: f64,
}

impl Default for SpeedLimits {
    fn default() -> Self {
        Self { rounding: 0.5 * REGULAR_STEP, deceleration: GRAVITY, acceleration: GRAVITY }
    }
}

/// (m) a distance between two samples by the speed of the wheels: its bounds, and the three sums that
/// practice prints. Where the wheels slip, as in braking, the vehicle moves farther, and may move farther
/// than `at_most`.
///
/// `at_least` and `at_most` hold for every course of the wheel speed that keeps [`SpeedLimits`]: between
/// samples it need be neither monotonic nor straight. Where two samples differ by more than those limits
/// allow ([`PreCrash::steep_changes`]), they hold for every course that keeps the limit of the other sense.
/// The sums `left` and `right` bound the distance only of a speed that falls, or rises, throughout and is not
/// rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DistanceBounds {
    /// (m) the least.
    pub at_least: f64,
    /// (m) each speed held until the next sample: the left sum.
    pub left: f64,
    /// (m) straight between the samples: the trapezium.
    pub between: f64,
    /// (m) each speed held since the sample before: the right sum.
    pub right: f64,
    /// (m) the greatest.
    pub at_most: f64,
}

impl SpeedLimits {
    /// The usual limits, for speeds stored to the nearest `step` (m/s).
    #[must_use]
    pub fn stored_in(step: f64) -> Self {
        Self { rounding: 0.5 * step, ..Self::default() }
    }

    /// Checks every field. With limits out of range, the bounds mean nothing.
    ///
    /// # Errors
    ///
    /// The first that is not in its range.
    pub fn check(&self) -> Result<(), AssumptionOutOfRange> {
        in_ranges(&[
            ("rounding", self.rounding, [0.0, 10.0]),
            ("deceleration", self.deceleration, [0.0, 100.0]),
            ("acceleration", self.acceleration, [0.0, 100.0]),
        ])
    }

    /// (m/s²) the mean acceleration of a change of the speed (m/s) in `step` (s) that is beyond the limits,
    /// however the two speeds were rounded.
    pub(crate) fn beyond(&self, step: f64, change: f64) -> Option<f64> {
        // A change of exactly the limit is within it.
        let within = |limit: f64| (limit * step + 2.0 * self.rounding) * (1.0 + 1e-9);
        let is_beyond = -change > within(self.deceleration) || change > within(self.acceleration);
        is_beyond.then_some(change / step)
    }
}

/// Two samples between which the speed changes by more than the limits allow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteepChange {
    /// (s) the times of the two.
    pub times: [f64; 2],
    /// (m/s²) the mean acceleration between them, negative where the speed falls.
    pub acceleration: f64,
}

impl DistanceBounds {
    fn plus(self, other: Self) -> Self {
        Self {
            at_least: self.at_least + other.at_least,
            left: self.left + other.left,
            between: self.between + other.between,
            right: self.right + other.right,
            at_most: self.at_most + other.at_most,
        }
    }
}

/// (m) area below a line that starts at `speed` and falls by `slope`, where it is above zero, within `time`.
fn falling(speed: f64, slope: f64, time: f64) -> f64 {
    let speed = speed.max(0.0);
    let end = (speed - slope * time).max(0.0);
    if slope <= 0.0 {
        return speed * time;
    }
    // s = (v² − v_e²) / 2a
    (speed * speed - end * end) / (2.0 * slope)
}

/// (m) area below a line that starts at `speed` and rises by `slope` within `time`.
fn rising(speed: f64, slope: f64, time: f64) -> f64 {
    // s = v t + a t²/2
    speed * time + 0.5 * slope * time * time
}

/// The distance in `step` (s) between two speeds (m/s).
fn within(step: f64, [first, last]: [f64; 2], limits: &SpeedLimits) -> DistanceBounds {
    let error = limits.rounding;
    let change = last - first;
    let (fall, rise) = (limits.deceleration.max(1e-9), limits.acceleration.max(1e-9));
    let (left, right) = (first * step, last * step);
    let sums =
        |at_least, at_most| DistanceBounds { at_least, left, between: 0.5 * (left + right), right, at_most };
    // A change beyond the limits happened nevertheless, at any instant: only the other limit then holds. The
    // speed fell at the end at the latest, and at the beginning at the earliest.
    match limits.beyond(step, change) {
        Some(slope) if slope < 0.0 => {
            return sums(falling(last - error, rise, step), rising(first + error, rise, step));
        }
        Some(_) => return sums(falling(first - error, fall, step), rising(last + error, fall, step)),
        None => {}
    }
    // The quickest course rises from the first sample, and falls to the last: v₁ + e + r t = v₂ + e + f (h −
    // t)
    let turn = ((change + fall * step) / (rise + fall)).clamp(0.0, step);
    let at_most = rising(first + error, rise, turn) + rising(last + error, fall, step - turn);
    // The slowest falls first, and rises to the last, but never below zero: v₁ − e − f t = v₂ − e − r (h − t)
    let turn = ((rise * step - change) / (rise + fall)).clamp(0.0, step);
    let at_least = falling(first - error, fall, turn) + falling(last - error, rise, step - turn);
    sums(at_least, at_most)
}

/// The distance in `gap` (s) from a stored speed to one (m/s) that was not stored but inferred.
fn open_end(gap: f64, [first, last]: [f64; 2], limits: &SpeedLimits) -> DistanceBounds {
    let (left, right) = (first * gap, last * gap);
    DistanceBounds {
        at_least: falling(first.min(last) - limits.rounding, limits.deceleration, gap),
        left,
        between: 0.5 * (left + right),
        right,
        at_most: rising(first.max(last) + limits.rounding, limits.acceleration, gap),
    }
}

impl PreCrash {
    /// A record of these samples.
    ///
    /// # Errors
    ///
    /// [`PreCrashFault`] names the sample.
    pub fn new(samples: Vec<PreCrashSample>) -> Result<Self, PreCrashFault> {
        if samples.is_empty() {
            return Err(PreCrashFault::NoSample);
        }
        let mut before = f64::NEG_INFINITY;
        for (k, one) in samples.iter().enumerate() {
            let sample = k + 1;
            let numbers = [
                (Channel::Time, Some(one.time)),
                (Channel::Speed, one.speed),
                (Channel::Accelerator, one.accelerator),
                (Channel::Throttle, one.throttle),
                (Channel::EngineSpeed, one.engine_speed),
                (Channel::Steering, one.steering),
                (Channel::YawRate, one.yaw_rate),
            ];
            let mut numbers = numbers.into_iter().filter_map(|(channel, value)| Some((channel, value?)));
            if numbers.clone().any(|(_, value)| !value.is_finite()) {
                return Err(PreCrashFault::NotFinite { sample });
            }
            if let Some(speed) = one.speed.filter(|speed| *speed < 0.0) {
                return Err(PreCrashFault::NegativeSpeed { sample, speed });
            }
            if one.time <= before {
                return Err(PreCrashFault::TimesTurn { sample, time: one.time, before });
            }
            if one.time > 0.0 {
                return Err(PreCrashFault::AfterImpact { sample, time: one.time });
            }
            let is_out = |(channel, value): &(Channel, f64)| {
                let [least, greatest] = channel.range();
                !(least..=greatest).contains(value)
            };
            if let Some((channel, value)) = numbers.find(is_out) {
                return Err(PreCrashFault::OutOfRange { sample, channel, value });
            }
            before = one.time;
        }
        let speeds: Vec<f64> = samples.iter().filter_map(|one| one.speed).collect();
        Ok(Self { samples, step: stored_step(&speeds, REGULAR_STEP) })
    }

    /// The record in a table that was read from a text. Its [`step`](Self::step) is a whole number of the
    /// unit of the speeds, if all of them are, and otherwise as of [`PreCrash::new`].
    ///
    /// # Errors
    ///
    /// As [`PreCrash::new`].
    pub fn from_table(table: &RecorderTable) -> Result<Self, PreCrashFault> {
        let times = table.times();
        let number = |channel, k: usize| table.column(channel).and_then(|column| column.values[k]);
        let switch = |channel, k| number(channel, k).map(|on| on > 0.5);
        let sample = |(k, time): (usize, f64)| PreCrashSample {
            time,
            speed: number(Channel::Speed, k),
            brake: switch(Channel::Brake, k),
            abs: switch(Channel::Abs, k),
            accelerator: number(Channel::Accelerator, k),
            throttle: number(Channel::Throttle, k),
            engine_speed: number(Channel::EngineSpeed, k),
            steering: number(Channel::Steering, k),
            yaw_rate: number(Channel::YawRate, k),
        };
        let record = Self::new(times.into_iter().enumerate().map(sample).collect())?;
        let Some(column) = table.column(Channel::Speed) else { return Ok(record) };
        let speeds: Vec<f64> = column.values.iter().flatten().copied().collect();
        Ok(Self { step: stored_step(&speeds, column.unit.factor), ..record })
    }

    /// (m/s) the step in which its speeds are stored: 1 km/h, unless they show another.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step.0
    }

    /// How that step was found.
    #[must_use]
    pub fn step_source(&self) -> StepSource {
        self.step.1
    }

    /// The samples, the earliest first.
    #[must_use]
    pub fn samples(&self) -> &[PreCrashSample] {
        &self.samples
    }

    /// The samples that have a speed, with it (m/s).
    pub fn speeds(&self) -> impl Iterator<Item = (&PreCrashSample, f64)> {
        self.samples.iter().filter_map(|sample| sample.speed.map(|speed| (sample, speed)))
    }

    /// The distance from the first sample with a speed at or after `from` (s) to the last at or before `to`
    /// (s). Samples without a speed are passed over, which widens the bounds.
    #[must_use]
    pub fn distance(&self, from: f64, to: f64, limits: &SpeedLimits) -> DistanceBounds {
        let within_times: Vec<(f64, f64)> = self
            .speeds()
            .map(|(sample, speed)| (sample.time, speed))
            .filter(|(time, _)| (from..=to).contains(time))
            .collect();
        within_times.windows(2).fold(DistanceBounds::default(), |sum, pair| {
            let [(begin, first), (end, last)] = [pair[0], pair[1]];
            sum.plus(within(end - begin, [first, last], limits))
        })
    }

    /// Where the speed changes between two samples by more than the limits allow. The bounds then let it
    /// change there at any instant, and apply only the limit in the other sense.
    #[must_use]
    pub fn steep_changes(&self, limits: &SpeedLimits) -> Vec<SteepChange> {
        let points: Vec<(f64, f64)> = self.speeds().map(|(sample, speed)| (sample.time, speed)).collect();
        let steep = |pair: &[(f64, f64)]| {
            let [(begin, first), (end, last)] = [pair[0], pair[1]];
            let acceleration = limits.beyond(end - begin, last - first)?;
            Some(SteepChange { times: [begin, end], acceleration })
        };
        points.windows(2).filter_map(steep).collect()
    }

    /// The distance from each sample with a speed to the last of them, the earliest first, with its time (s).
    #[must_use]
    pub fn distances_to_last(&self, limits: &SpeedLimits) -> Vec<(f64, DistanceBounds)> {
        let points: Vec<(f64, f64)> = self.speeds().map(|(sample, speed)| (sample.time, speed)).collect();
        let mut found = Vec::with_capacity(points.len());
        let mut sum = DistanceBounds::default();
        for k in (0..points.len()).rev() {
            if let Some(next) = points.get(k + 1) {
                sum = sum.plus(within(next.0 - points[k].0, [points[k].1, next.1], limits));
            }
            found.push((points[k].0, sum));
        }
        found.reverse();
        found
    }

    /// The distance from each sample with a speed to the impact at 0, the earliest first, with its time (s);
    /// the last is the impact itself.
    ///
    /// From the last speed to the impact the deceleration is constant for `between`, and leads to the speed
    /// `at_impact` (m/s). The bounds there let the speed change by the limits, from the last stored speed or
    /// to that at the impact.
    #[must_use]
    pub fn distances_to_impact(&self, at_impact: f64, limits: &SpeedLimits) -> Vec<(f64, DistanceBounds)> {
        let mut found = self.distances_to_last(limits);
        let Some((last, speed)) = self.speeds().last().filter(|(last, _)| last.time < 0.0) else {
            return found;
        };
        let gap = open_end(0.0 - last.time, [speed, at_impact], limits);
        found.iter_mut().for_each(|(_, sum)| *sum = sum.plus(gap));
        found.push((0.0, DistanceBounds::default()));
        found
    }
}
