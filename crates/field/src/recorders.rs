//! Speeds before impact and ΔV by all other evidence, judged by recorders.

use std::ops::ControlFlow;

use evidence::{Collision, CrushErrors, DrawnOutput, Fitted, MeasuredSpeed, shown_delta_v};
use pim_core::VehicleId;
use real::Real;
use real::elementary::{ln, sin_cos};
use uncertainty::{Distribution, InvalidDistribution, order_statistic};

use crate::crash::Crash as _;
use crate::error::FieldError;
use crate::judge::{Options, count, draws, intervals, median, posterior, shown};
use crate::pair::Truth;
use crate::recorded::{LastSpeed, RecordedPair, RecorderRow};

/// A quantity of one vehicle, estimated and stored.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedRecord {
    /// Number of the crash.
    pub case: String,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// (m/s) the last speed that its recorder stored.
    pub recorded: f64,
    /// (m/s) median of the value that the estimate expects the recorder to have stored.
    pub median: f64,
    /// (m/s) ends of the intervals of the [`LEVELS`](crate::LEVELS).
    pub intervals: [[f64; 2]; 3],
    /// Whether the run converged.
    pub converged: bool,
}

/// ΔV of one vehicle from the speeds of both recorders.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedDeltaV {
    /// Number of the crash.
    pub case: String,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// The value that its recorder stored.
    pub truth: Truth,
    /// (m/s) by momentum to one common velocity.
    pub common: f64,
    /// (m/s) median of the estimate by all evidence except the ΔV of recorders.
    pub median: f64,
}

/// A record that is probably not of the impact that the row describes.
#[derive(Clone, Debug, PartialEq)]
pub struct DoubtedRecord {
    /// Number of the crash.
    pub case: String,
    /// The vehicle.
    pub vehicle: VehicleId,
    /// (m/s) ΔV that it stored.
    pub stored: f64,
    /// (m/s) ΔV to a common velocity from the speeds of both recorders.
    pub common: f64,
}

/// A part of the evidence that [`judge_recorders`] takes as exact, to show its share of the width of an
/// interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WidthPart {
    /// The headings and the direction of the crush plane.
    Headings,
    /// The contact point.
    Contact,
    /// The crush energy.
    Crush,
    /// The other vehicle's recorder.
    Recorder,
}

impl WidthPart {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Headings, Self::Contact, Self::Crush, Self::Recorder];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Headings => "headings",
            Self::Contact => "contact",
            Self::Crush => "crush",
            Self::Recorder => "recorder",
        }
    }
}

/// Figures of the speeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpeedFigures {
    /// Number of vehicles.
    pub n: usize,
    /// (m/s) mean of median − recorded.
    pub bias: Option<f64>,
    /// (m/s) root mean square of the same.
    pub rms: Option<f64>,
    /// (–) share of the recorded speeds inside the intervals of the [`LEVELS`](crate::LEVELS).
    pub coverage: Option<[f64; 3]>,
    /// (m/s) median of half the widths of the 95 % intervals.
    pub half_width: Option<f64>,
    /// (m/s) the same with a part of the evidence exact.
    pub half_width_without: Vec<(WidthPart, f64)>,
}

/// Figures of ΔV from the speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeltaVFigures {
    /// Number of vehicles.
    pub n: usize,
    /// (–) mean of ln(median/stored).
    pub bias: Option<f64>,
    /// (–) root mean square of the same.
    pub rms: Option<f64>,
}

/// The judgement of a whole table.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorders {
    /// Number of rows.
    pub rows: usize,
    /// Number of rows that were finished before the run was ended.
    pub finished: usize,
    /// Whether the crashes were taken as chosen for an injury.
    pub injured: bool,
    /// The speed of each vehicle by all evidence except its recorder.
    pub speeds: Vec<JudgedRecord>,
    /// Their figures.
    pub other_speed: SpeedFigures,
    /// ΔV of each vehicle from the speeds of both recorders.
    pub delta_vs: Vec<JudgedDeltaV>,
    /// Their figures by momentum to one common velocity.
    pub delta_v_from_speeds: DeltaVFigures,
    /// Their figures by the estimate.
    pub delta_v_by_estimate: DeltaVFigures,
    /// Crash and reason of each row that cannot be judged.
    pub refused: Vec<(String, String)>,
    /// The records that are neither judged nor evidence.
    pub doubted: Vec<DoubtedRecord>,
}

/// (–) |ln| of the ratio of a stored ΔV to that of a common velocity beyond which it is doubted: seven times
/// the rms of 17 records (0.153, CIREN), and more than the reduction of ΔV in a sideswipe, which is between a
/// full impact and no impact at all.
const ANOTHER_IMPACT: f64 = 1.0;

impl LastSpeed {
    fn as_evidence(&self, exact: bool) -> MeasuredSpeed {
        let [mean, sd] = self.to_impact;
        MeasuredSpeed { value: self.speed + mean, ln_sd: 0.0, least: if exact { 0.1 * sd } else { sd } }
    }

    /// (m/s) the speed at impact that it shows.
    fn at_impact(&self) -> f64 {
        (self.speed + self.to_impact[0]).max(0.0)
    }
}

impl RecordedPair {
    /// (m/s) the ΔV of both from the recorded speeds to one common velocity, if the headings are known:
    /// ΔV_i = m_j |v_2 − v_1|/(m_1 + m_2); positive in the sense that the recorder of each stores, forward
    /// and to the right.
    #[must_use]
    pub fn to_common_velocity(&self) -> Option<[[f64; 2]; 2]> {
        let [one, two] = &self.pair.vehicles;
        let headings = [one.heading?, two.heading?];
        // Clockwise from north: x north, y east.
        let velocity = |i: usize| {
            let (sin, cos) = sin_cos(headings[i]);
            let speed = self.last[i].at_impact();
            [speed * cos, speed * sin]
        };
        let [v1, v2] = [velocity(0), velocity(1)];
        let masses = [one.mass(), two.mass()];
        let sum = masses[0] + masses[1];
        Some([0, 1].map(|i| {
            let sign = if i == 0 { 1.0 } else { -1.0 };
            let share = sign * masses[1 - i] / sum;
            let [north, east] = [(v2[0] - v1[0]) * share, (v2[1] - v1[1]) * share];
            let (sin, cos) = sin_cos(headings[i]);
            [north * cos + east * sin, east * cos - north * sin]
        }))
    }

    /// The vehicles whose recorders can be judged, with the stored values and those to one common velocity
    /// (m/s).
    fn compared(&self) -> Vec<(VehicleId, Truth, f64)> {
        let Some(common) = self.to_common_velocity() else { return Vec::new() };
        let shown = |(id, truth): (VehicleId, Truth)| {
            let [along, across] = common[id.index()];
            let whole = Real::sqrt(along * along + across * across);
            (id, truth, shown_delta_v(whole, along, truth.is_longitudinal))
        };
        self.pair.truths().into_iter().map(shown).filter(|(.., common)| *common > 0.0).collect()
    }

    /// The records that are probably not of this impact.
    fn doubted(&self) -> Vec<DoubtedRecord> {
        let compared = self.compared().into_iter();
        let far = compared.filter(|(_, truth, common)| ln(truth.delta_v / common).abs() > ANOTHER_IMPACT);
        far.map(|(vehicle, truth, common)| {
            let (case, stored) = (self.pair.case.clone(), truth.delta_v);
            DoubtedRecord { case, vehicle, stored, common }
        })
        .collect()
    }

    /// The collision with the ΔV of the vehicles `given` and the speeds of the vehicles `with_speed` as
    /// evidence, and with one part of the evidence exact.
    fn collision(
        &self,
        fitted: &Fitted,
        given: &[VehicleId],
        with_speed: &[VehicleId],
        exact: Option<WidthPart>,
    ) -> Result<Collision, InvalidDistribution> {
        let mut fitted = *fitted;
        match exact {
            Some(WidthPart::Headings) => (fitted.heading_sd, fitted.crush_plane_sd) = (0.0, 0.0),
            Some(WidthPart::Contact) => fitted.contact_sd = 0.0,
            Some(WidthPart::Recorder) => fitted.recorder_ln_scale *= 0.1,
            Some(WidthPart::Crush) | None => {}
        }
        let known = match self.is_measured {
            [true, false] => Some(VehicleId::One),
            [false, true] => Some(VehicleId::Two),
            _ => None,
        };
        let mut collision = self.pair.known(known, &fitted, given)?;
        for id in with_speed {
            let speed = self.last[id.index()].as_evidence(exact == Some(WidthPart::Recorder));
            collision.observed.vehicles[id.index()].recorder.speed = Some(speed.into());
        }
        if exact == Some(WidthPart::Crush) {
            collision.observed.crush = collision.observed.crush.map(|CrushErrors(errors)| {
                CrushErrors(errors.map(|mut error| {
                    error.shared_ln_sd *= 0.1;
                    error.own_ln_sd *= 0.1;
                    error
                }))
            });
        }
        Ok(collision)
    }
}

/// (m/s) quantiles of the value that a recorder stores for speeds at impact, with its own error.
struct Stored(Vec<f64>);

impl Stored {
    fn of(draws: &[f64], last: &LastSpeed) -> Result<Self, InvalidDistribution> {
        /// Steps of the recorder's error, of equal probability.
        const STEPS: u8 = 20;
        let [mean, sd] = last.to_impact;
        let error = Distribution::normal(mean, sd)?;
        let errors = (0..STEPS).map(|step| error.quantile((f64::from(step) + 0.5) / f64::from(STEPS)));
        let errors: Vec<f64> = errors.collect();
        // A recorder stores no speed below 0.
        let stored = draws.iter().flat_map(|draw| errors.iter().map(move |error| (draw - error).max(0.0)));
        let mut stored: Vec<f64> = stored.collect();
        stored.sort_by(f64::total_cmp);
        Ok(Self(stored))
    }

    fn quantile(&self, share: f64) -> f64 {
        order_statistic(&self.0, (share * count(self.0.len())).floor())
    }
}

/// Mean and root mean square.
fn moments(errors: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for error in errors {
        n += 1.0;
        sum += error;
        squares += error * error;
    }
    (n > 0.0).then(|| [sum / n, Real::sqrt(squares / n)])
}

/// Estimates, for each crash whose two recorders stored a speed before the impact, the speed of each vehicle
/// from all evidence except its own recorder, and ΔV of both from both speeds: by momentum to one common
/// velocity, and by the estimate.
/// `progress` gets the number of finished rows and of all, and may end the run, which then judges the
/// finished rows.
///
/// # Errors
/// [`FieldError::Ended`] if no row was finished, and [`FieldError::Estimate`] if a pair has no estimate.
pub fn judge_recorders(
    rows: &[RecorderRow],
    fitted: &Fitted,
    options: &Options,
    progress: &mut (dyn FnMut(usize, usize) -> ControlFlow<()> + Send),
) -> Result<Recorders, FieldError> {
    let mut found = Recorders {
        rows: rows.len(),
        finished: rows.len(),
        injured: options.injury.is_some(),
        speeds: Vec::new(),
        other_speed: SpeedFigures::default(),
        delta_vs: Vec::new(),
        delta_v_from_speeds: DeltaVFigures::default(),
        delta_v_by_estimate: DeltaVFigures::default(),
        refused: Vec::new(),
        doubted: Vec::new(),
    };
    let mut halves: [Vec<f64>; 4] = Default::default();
    let fitted = &fitted.of_injured(options.injury);
    for (done, row) in rows.iter().enumerate() {
        if progress(done, rows.len()).is_break() {
            found.finished = done;
            break;
        }
        let pair = match &row.pair {
            Ok(pair) => pair,
            Err(reason) => {
                found.refused.push((row.case.clone(), reason.clone()));
                continue;
            }
        };
        let doubted = pair.doubted();
        if !doubted.is_empty() {
            // A record of another impact does not have the speed before this one, either.
            found.doubted.extend(doubted);
            continue;
        }
        for id in VehicleId::ALL {
            let judged = pair.speed(id, fitted, options, None)?;
            for (part, halves) in WidthPart::ALL.into_iter().zip(&mut halves) {
                halves.push(pair.speed(id, fitted, options, Some(part))?.half_width());
            }
            found.speeds.push(judged);
        }
        found.delta_vs.extend(pair.delta_vs(fitted, options)?);
    }
    if found.finished == 0 && found.rows > 0 {
        return Err(FieldError::Ended);
    }
    found.other_speed = SpeedFigures::of(&found.speeds, halves);
    found.delta_v_from_speeds = DeltaVFigures::of(&found.delta_vs, |judged| judged.common);
    found.delta_v_by_estimate = DeltaVFigures::of(&found.delta_vs, |judged| judged.median);
    Ok(found)
}

impl JudgedRecord {
    fn half_width(&self) -> f64 {
        let [low, high] = self.intervals[2];
        0.5 * (high - low)
    }
}

impl DeltaVFigures {
    fn of(judged: &[JudgedDeltaV], value: impl Fn(&JudgedDeltaV) -> f64) -> Self {
        let figures = moments(judged.iter().map(|judged| ln(value(judged) / judged.truth.delta_v)));
        Self { n: judged.len(), bias: figures.map(|[bias, _]| bias), rms: figures.map(|[_, rms]| rms) }
    }
}

impl SpeedFigures {
    fn of(speeds: &[JudgedRecord], halves: [Vec<f64>; 4]) -> Self {
        let figures = moments(speeds.iter().map(|judged| judged.median - judged.recorded));
        let inside = |level: usize| {
            let is_inside = speeds.iter().map(|judged| {
                let [low, high] = judged.intervals[level];
                f64::from(u8::from((low..=high).contains(&judged.recorded)))
            });
            moments(is_inside).map_or(0.0, |[share, _]| share)
        };
        Self {
            n: speeds.len(),
            bias: figures.map(|[bias, _]| bias),
            rms: figures.map(|[_, rms]| rms),
            coverage: figures.map(|_| [0, 1, 2].map(inside)),
            half_width: median(speeds.iter().map(JudgedRecord::half_width).collect()),
            half_width_without: WidthPart::ALL
                .into_iter()
                .zip(halves)
                .filter_map(|(part, halves)| Some((part, median(halves)?)))
                .collect(),
        }
    }
}

impl RecordedPair {
    /// The speed of a vehicle by all evidence except its own recorder.
    fn speed(
        &self,
        id: VehicleId,
        fitted: &Fitted,
        options: &Options,
        exact: Option<WidthPart>,
    ) -> Result<JudgedRecord, FieldError> {
        let case = self.pair.case.clone();
        let other = [id.other()];
        let collision = self.collision(fitted, &other, &other, exact);
        let (posterior, converged) = posterior(&case, collision, options)?;
        let last = &self.last[id.index()];
        let stored = match Stored::of(draws(&posterior, DrawnOutput::Speed(id)), last) {
            Ok(stored) => stored,
            Err(error) => return Err(FieldError::Estimate { case, reason: error.to_string() }),
        };
        Ok(JudgedRecord {
            case,
            vehicle: id,
            recorded: last.speed,
            median: stored.quantile(0.5),
            intervals: intervals(|share| stored.quantile(share)),
            converged,
        })
    }

    /// ΔV of the vehicles with a recorder, from the speeds of both recorders.
    fn delta_vs(&self, fitted: &Fitted, options: &Options) -> Result<Vec<JudgedDeltaV>, FieldError> {
        let compared = self.compared();
        if compared.is_empty() {
            return Ok(Vec::new());
        }
        let collision = self.collision(fitted, &[], &VehicleId::ALL, None);
        let (posterior, _) = posterior(&self.pair.case, collision, options)?;
        let judged = compared.into_iter().filter_map(|(vehicle, truth, common)| {
            let median = median(shown(&posterior, vehicle, truth.is_longitudinal).collect())?;
            Some(JudgedDeltaV { case: self.pair.case.clone(), vehicle, truth, common, median })
        });
        Ok(judged.collect())
    }
}

#[cfg(test)]
mod tests;
