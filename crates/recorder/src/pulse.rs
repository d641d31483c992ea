//! The pulse: ΔV over time, where it begins and ends, and whether the record holds all of it.

use real::elementary::atan2;

use crate::channel::{Channel, GRAVITY};
use crate::table::RecorderTable;

/// ΔV since the beginning of the record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PulseSample {
    /// (s) time.
    pub time: f64,
    /// (m/s) ΔV along the vehicle, positive forward.
    pub longitudinal: Option<f64>,
    /// (m/s) ΔV across the vehicle, positive to the right as in recorders (SAE J1733), unless its sign was
    /// changed.
    pub lateral: Option<f64>,
}

/// ΔV over time, as a recorder stored it.
#[derive(Clone, Debug, PartialEq)]
pub struct CrashPulse {
    samples: Vec<PulseSample>,
    padded_from: Option<f64>,
}

/// Why samples are not a pulse.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PulseFault {
    /// Fewer than two samples with a ΔV.
    #[error("a pulse needs two samples with a ΔV, and has {found}")]
    TooFew {
        /// Their number.
        found: usize,
    },
    /// A value that is not a number.
    #[error("sample {sample}: a time or ΔV is not a finite number")]
    NotFinite {
        /// From 1.
        sample: usize,
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
}

/// The rule for the beginning and the end of a pulse.
///
/// Annex E of ISO/TR 12353-3:2013 computes `t_0` and `t_end` by methods A, B and C; its text is not public,
/// so that the rules here have names of their own. [`PulseRule::Change`] is that of 49 CFR 563.5 and UN R160.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PulseRule {
    /// The impact goes on while ΔV changes by more than `change` (m/s) in each `window` (s): 0.8 km/h in 20
    /// ms in 49 CFR 563.5 and UN R160.
    Change {
        /// (m/s) the change.
        change: f64,
        /// (s) the window.
        window: f64,
    },
    /// The impact lasts as long as the acceleration, averaged over 20 ms, is above this one (m/s²).
    Acceleration(f64),
    /// It begins as by [`PulseRule::CHANGE`], and ends when the resultant ΔV is greatest: before the effect
    /// of the vehicles' rebound is lost in the motion that follows.
    GreatestDeltaV,
}

impl PulseRule {
    /// The rule of 49 CFR 563.5: 0.8 km/h in 20 ms.
    pub const CHANGE: Self = Self::Change { change: 0.8 / 3.6, window: WINDOW };
    /// 2 g, which no tyre reaches.
    pub const TWO_G: Self = Self::Acceleration(2.0 * GRAVITY);
    /// All three, in the order of a report.
    pub const ALL: [Self; 3] = [Self::CHANGE, Self::TWO_G, Self::GreatestDeltaV];

    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Change { .. } => "change of ΔV, 49 CFR 563.5",
            Self::Acceleration(_) => "acceleration in 20 ms",
            Self::GreatestDeltaV => "greatest ΔV",
        }
    }

    /// Its key in JSON.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Change { .. } => "change",
            Self::Acceleration(_) => "acceleration",
            Self::GreatestDeltaV => "greatest_delta_v",
        }
    }
}

/// The part of a record that belongs to the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulseSpan {
    /// The rule.
    pub rule: PulseRule,
    /// (s) where the impact begins.
    pub start: f64,
    /// (s) where it ends, or the record does.
    pub end: f64,
    /// (m/s) longitudinal ΔV from start to end, and lateral ΔV.
    pub delta_v: [Option<f64>; 2],
    /// Whether the impact ends within the record. If not, ΔV is a lower bound.
    pub complete: bool,
}

impl PulseSpan {
    /// (m/s) resultant of the recorded components.
    #[must_use]
    pub fn resultant(&self) -> f64 {
        let [x, y] = self.delta_v.map(|part| part.unwrap_or(0.0));
        (x * x + y * y).sqrt()
    }
}

/// (m/s) ΔV at the center of gravity, from that of a recorder at (`x`, `y`) (m) from it and the change of the
/// yaw rate (rad/s), all in one right-handed frame of the vehicle.
#[must_use]
pub fn delta_v_at_center([along, across]: [f64; 2], yaw_change: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    // ΔV = ΔV_r − ΔΩ × r
    [along + yaw_change * y, across - yaw_change * x]
}

/// (rad) principal direction of force of a ΔV: where the force comes from, clockwise from the front of the
/// vehicle, if lateral ΔV is positive to the right.
#[must_use]
pub fn force_direction([along, to_the_right]: [f64; 2]) -> f64 {
    // θ = atan2(−ΔV_y, −ΔV_x); without a minus zero, whose angle would be −π
    atan2(0.0 - to_the_right, 0.0 - along)
}

impl CrashPulse {
    /// A pulse of these samples. Samples without a ΔV are dropped, and so are the zeros that a recorder
    /// stored as padding. If one of two axes ends before the other, the other continues alone.
    ///
    /// # Errors
    ///
    /// [`PulseFault`] names the sample.
    pub fn new(mut samples: Vec<PulseSample>) -> Result<Self, PulseFault> {
        let mut before = f64::NEG_INFINITY;
        for (k, one) in samples.iter().enumerate() {
            let parts = [one.longitudinal, one.lateral];
            if !one.time.is_finite() || parts.iter().flatten().any(|part| !part.is_finite()) {
                return Err(PulseFault::NotFinite { sample: k + 1 });
            }
            if one.time <= before {
                return Err(PulseFault::TimesTurn { sample: k + 1, time: one.time, before });
            }
            before = one.time;
        }
        // A recorder with one axis has no values for the other; with both axes, a sample needs both until one
        // axis ends.
        let has =
            |of: fn(&PulseSample) -> Option<f64>| samples.iter().filter(|one| of(one).is_some()).count() >= 2;
        let (along, across) = (has(|one| one.longitudinal), has(|one| one.lateral));
        let padded_from = padding(&samples).map(|first| {
            let time = samples[first].time;
            samples.truncate(first);
            time
        });
        let end = |of: fn(&PulseSample) -> Option<f64>| samples.iter().rposition(|one| of(one).is_some());
        let ends = [end(|one| one.longitudinal), end(|one| one.lateral)];
        let whole = |(k, one): &(usize, &PulseSample)| {
            let lacks =
                |has: bool, part: Option<f64>, end: Option<usize>| has && part.is_none() && Some(*k) <= end;
            one.longitudinal.or(one.lateral).is_some()
                && !lacks(along, one.longitudinal, ends[0])
                && !lacks(across, one.lateral, ends[1])
        };
        let kept: Vec<PulseSample> = samples
            .iter()
            .enumerate()
            .filter(whole)
            .map(|(_, one)| PulseSample {
                longitudinal: one.longitudinal.filter(|_| along),
                lateral: one.lateral.filter(|_| across),
                ..*one
            })
            .filter(|one| one.longitudinal.or(one.lateral).is_some())
            .collect();
        if kept.len() < 2 {
            let found = samples.iter().filter(|one| one.longitudinal.or(one.lateral).is_some()).count();
            // Each axis may have two samples, but fewer than two samples have both.
            return Err(PulseFault::TooFew { found: found.min(1) });
        }
        Ok(Self { samples: kept, padded_from })
    }

    /// The pulse in a table that was read from a text.
    ///
    /// # Errors
    ///
    /// As [`CrashPulse::new`].
    pub fn from_table(table: &RecorderTable) -> Result<Self, PulseFault> {
        let (along, across) =
            (table.values(Channel::DeltaVLongitudinal), table.values(Channel::DeltaVLateral));
        let sample = |(k, time)| PulseSample { time, longitudinal: along[k], lateral: across[k] };
        Self::new(table.times().into_iter().enumerate().map(sample).collect())
    }

    /// One pulse from the tables of both axes: at the times of `self`, with the values of `other`
    /// interpolated.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let at = |time: f64, of: fn(&PulseSample) -> Option<f64>| {
            let pair = other.samples.windows(2).find(|pair| (pair[0].time..=pair[1].time).contains(&time))?;
            let [before, after] = [of(&pair[0])?, of(&pair[1])?];
            let share = (time - pair[0].time) / (pair[1].time - pair[0].time);
            Some(before + (after - before) * share)
        };
        let joined = |one: &PulseSample| PulseSample {
            time: one.time,
            longitudinal: one.longitudinal.or_else(|| at(one.time, |one| one.longitudinal)),
            lateral: one.lateral.or_else(|| at(one.time, |one| one.lateral)),
        };
        let samples: Vec<PulseSample> = self.samples.iter().map(joined).collect();
        let earlier = [self.padded_from, other.padded_from].into_iter().flatten().reduce(f64::min);
        match Self::new(samples) {
            Ok(joined) => Self { padded_from: joined.padded_from.or(earlier), ..joined },
            Err(_) => self.clone(),
        }
    }

    /// (s) the time from which the recorder only stored zeros as padding, if it did; they do not count as
    /// samples.
    #[must_use]
    pub fn padded_from(&self) -> Option<f64> {
        self.padded_from
    }

    /// (s) the last time for which both axes have a ΔV, if one of them continues alone.
    #[must_use]
    pub fn alone_from(&self) -> Option<f64> {
        let has_both = |one: &PulseSample| one.longitudinal.is_some() && one.lateral.is_some();
        let last = self.samples.iter().rposition(has_both)?;
        (last + 1 < self.samples.len()).then(|| self.samples[last].time)
    }

    /// (s) beginning and end of a time in which ΔV is constant by the rule of 49 CFR 563.5 before it changes
    /// by more than 2 km/h again: between two impacts, or in one with a pause.
    #[must_use]
    pub fn pause(&self) -> Option<[f64; 2]> {
        let active = self.active(PulseRule::CHANGE);
        let first = active.iter().position(|step| *step)?;
        let end = first + active[first..].iter().position(|step| !step)?;
        let again = end + active[end..].iter().position(|step| *step)?;
        let changes = (again..self.samples.len()).any(|k| self.change(end, k) > TURNED);
        changes.then(|| [self.samples[end].time, self.samples[again].time])
    }

    /// The samples, the earliest first.
    #[must_use]
    pub fn samples(&self) -> &[PulseSample] {
        &self.samples
    }

    /// (m/s) the resultant ΔV from one sample to another.
    fn change(&self, from: usize, to: usize) -> f64 {
        let [first, last] = [&self.samples[from], &self.samples[to]];
        // An axis that has ended changes no more.
        let part = |of: fn(&PulseSample) -> Option<f64>| {
            of(last).zip(of(first)).map_or(0.0, |(last, first)| last - first)
        };
        let (x, y) = (part(|one| one.longitudinal), part(|one| one.lateral));
        (x * x + y * y).sqrt()
    }

    /// The time in the middle of each two samples (s), with the accelerations along and across (m/s²) by the
    /// difference of their ΔV.
    #[must_use]
    pub fn accelerations(&self) -> Vec<(f64, [Option<f64>; 2])> {
        let of_pair = |pair: &[PulseSample]| {
            let step = pair[1].time - pair[0].time;
            // a = ΔV' / Δt
            let part = |of: fn(&PulseSample) -> Option<f64>| Some((of(&pair[1])? - of(&pair[0])?) / step);
            (0.5 * (pair[0].time + pair[1].time), [part(|one| one.longitudinal), part(|one| one.lateral)])
        };
        self.samples.windows(2).map(of_pair).collect()
    }

    /// The time of each sample (s), with the principal direction of force of ΔV until then (rad), if ΔV is at
    /// least `least` (m/s): for a smaller ΔV, rounding dominates.
    #[must_use]
    pub fn force_directions(&self, least: f64) -> Vec<(f64, f64)> {
        let direction = |one: &PulseSample| {
            let [x, y] = [one.longitudinal?, one.lateral?];
            (x * x + y * y >= least * least).then(|| (one.time, force_direction([x, y])))
        };
        self.samples.iter().filter_map(direction).collect()
    }

    /// Whether each step between samples lies in a time of `window` (s) in which ΔV changes by more than
    /// `change` (m/s).
    fn changing(&self, change: f64, window: f64) -> Vec<bool> {
        let steps = self.samples.len() - 1;
        let mut active = vec![false; steps];
        for from in 0..steps {
            // Samples 10 ms apart are 20 ms apart up to rounding.
            let end = self.samples[from].time + window * (1.0 + 1e-9) + 1e-9;
            let to = self.samples.iter().rposition(|one| one.time <= end).unwrap_or(from).max(from + 1);
            if self.change(from, to) > change {
                active[from..to].iter_mut().for_each(|step| *step = true);
            }
        }
        active
    }

    /// Whether each step between samples belongs to the impact.
    fn active(&self, rule: PulseRule) -> Vec<bool> {
        match rule {
            // Over a window, too: between two samples 10 ms apart, rounding to 1 km/h alone is 2.8 g.
            PulseRule::Acceleration(least) => self.changing(least * WINDOW, WINDOW),
            PulseRule::Change { change, window } => self.changing(change, window),
            PulseRule::GreatestDeltaV => self.active(PulseRule::CHANGE),
        }
    }

    /// The part of the record that belongs to the impact: from the first step that changes ΔV to the end of
    /// these steps by the rule, which is their first end by that of 49 CFR 563.5. `None` if no step changes
    /// ΔV.
    #[must_use]
    pub fn span(&self, rule: PulseRule) -> Option<PulseSpan> {
        let active = self.active(rule);
        let first = active.iter().position(|step| *step)?;
        let last = match rule {
            // "End of event": where ΔV no longer changes, and not where its last digit flickers afterwards.
            PulseRule::Change { .. } => first + active[first..].iter().take_while(|step| **step).count(),
            _ => active.iter().rposition(|step| *step)? + 1,
        };
        let ends_within = last < self.samples.len() - 1;
        let end = match rule {
            PulseRule::GreatestDeltaV => (first..=last).fold(first, |best, k| {
                if self.change(first, k) > self.change(first, best) { k } else { best }
            }),
            _ => last,
        };
        // A maximum before the end of the record counts if ΔV then falls by more than its rounding.
        let past = self.change(first, end) - self.change(first, self.samples.len() - 1);
        let complete = match rule {
            PulseRule::GreatestDeltaV => !self.is_cut() || (end < self.samples.len() - 1 && past > TURNED),
            _ => ends_within,
        };
        let [from, to] = [self.samples[first], self.samples[end]];
        let part = |of: fn(&PulseSample) -> Option<f64>| Some(of(&to)? - of(&from).unwrap_or(0.0));
        // What was stored at the first sample counts, too, where the record begins within the impact.
        let begun = |of: fn(&PulseSample) -> Option<f64>| if first == 0 { of(&to) } else { part(of) };
        let delta_v = [begun(|one| one.longitudinal), begun(|one| one.lateral)];
        Some(PulseSpan { rule, start: from.time, end: to.time, delta_v, complete })
    }

    /// Whether the record ends before the impact does: ΔV still changes at its end by the rule of 49 CFR
    /// 563.5, and by more than one step in which it is stored. Its ΔV is then a lower bound. Padding is no
    /// part of the record, so a padded record may be complete.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        const AXES: [fn(&PulseSample) -> Option<f64>; 2] = [|one| one.longitudinal, |one| one.lateral];
        let active = self.active(PulseRule::CHANGE);
        let from = active.iter().rposition(|step| !step).map_or(0, |still| still + 1);
        let values = |of: fn(&PulseSample) -> Option<f64>, from: usize| -> Vec<f64> {
            self.samples[from..].iter().filter_map(of).collect()
        };
        let steps = AXES.map(|of| {
            let values = values(of, 0);
            let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
            steps.filter(|step| *step > SAME_STORED).fold(f64::INFINITY, f64::min)
        });
        let step = steps[0].min(steps[1]);
        let changes = |of| {
            let values = values(of, from);
            let [low, high] = [f64::min, f64::max].map(|least| values.iter().copied().reduce(least));
            low.zip(high).is_some_and(|(low, high)| high - low > FLICKER * step)
        };
        from < active.len() && AXES.into_iter().any(changes)
    }
}

/// (m/s) 5 km/h: a larger ΔV does not fall to 0 from one sample to the next and stay there.
const LEAST_PADDED: f64 = 5.0 / 3.6;

/// The index of the first of the zeros that a recorder stored as padding for a record that it could not
/// finish: two at least, after more than [`LEAST_PADDED`] and more than half of the greatest ΔV.
fn padding(samples: &[PulseSample]) -> Option<usize> {
    let size = |one: &PulseSample| {
        let [x, y] = [one.longitudinal, one.lateral].map(|part| part.unwrap_or(0.0));
        (x * x + y * y).sqrt()
    };
    let is_zero = |one: &PulseSample| one.longitudinal.or(one.lateral).is_some() && size(one) == 0.0;
    let last = samples.iter().rposition(|one| size(one) > 0.0)?;
    let greatest = samples.iter().map(size).fold(0.0, f64::max);
    let falls = size(&samples[last]) > LEAST_PADDED.max(0.5 * greatest);
    let zeros = samples[last + 1..].iter().filter(|one| is_zero(one)).count();
    (falls && zeros >= 2).then_some(last + 1)
}

/// (m/s) values that differ by less were stored alike: no recorder stores hundredths of 1 km/h.
const SAME_STORED: f64 = 0.005 / 3.6;
/// (–) flicker of the last digit of ΔV, in steps in which it is stored, including the rounding of a
/// conversion to another unit.
const FLICKER: f64 = 1.5;

/// (s) the time within which a pulse is tested for a change: that of 49 CFR 563.5.
const WINDOW: f64 = 0.02;

/// (m/s) 2 km/h, twice the step in which ΔV is stored: ΔV has to fall by this much after a maximum for it to
/// count.
const TURNED: f64 = 2.0 / 3.6;
