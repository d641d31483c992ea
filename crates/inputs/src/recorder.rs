//! Recorder data, certain speeds and the assumptions of an estimate: `[vehicleN.recorder]`, `certain_speed`
//! and `[estimate]`. These numbers are compared with the impact and do not enter it, so no other analysis
//! varies them.

use std::fmt::Display;
use std::sync::Arc;

use recorder::{
    CrashPulse, EventRecord, ImpactSpeed, ImpactSpeedErrors, KnownImpact, PreCrash, PulseRule, SpeedHump,
};

use crate::axes::Axes;
use crate::choices;
use crate::quantity::{Quantity, format_number};
use crate::recorded::{GivenPreCrash, GivenPulse, GivenSpeedErrors};
use crate::scene::Place;
use crate::walk::{Element, GivenValue, Key, Walk};

/// The data of a vehicle's event data recorder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorder {
    /// (m/s) largest part of ΔV along the vehicle, positive forward.
    pub delta_v_longitudinal: Option<Quantity>,
    /// (m/s) largest part of ΔV across the vehicle, positive in the sense of the axes.
    pub delta_v_lateral: Option<Quantity>,
    /// (%) standard deviation of the error of ΔV.
    pub delta_v_error: Option<f64>,
    /// (rad) scale of the error of the direction of ΔV.
    pub direction_error: Option<Quantity>,
    /// (m/s) speed before the impact.
    pub speed: Option<Quantity>,
    /// (%) standard deviation of the error of that speed.
    pub speed_error: Option<f64>,
    /// (rad/s) yaw rate after the impact, in the sense of the axes.
    pub yaw_rate: Option<Quantity>,
    /// (rad/s) standard deviation of the error of that yaw rate.
    pub yaw_rate_error: Option<Quantity>,
    /// The data that it stored before the impact.
    pub pre_crash: Option<Arc<GivenPreCrash>>,
    /// ΔV over time.
    pub pulse: Option<Arc<GivenPulse>>,
    /// Whether the recorder did not finish the record, so that its ΔV is a lower bound.
    pub incomplete: bool,
    /// Its position in the vehicle; at the centre of gravity if absent.
    pub at: Option<Place>,
    /// The errors of a stored speed.
    pub errors: GivenSpeedErrors,
    /// Several records, in the order of time, in place of the one above.
    pub records: Vec<StoredRecord>,
    /// The other impacts of the vehicle in this crash, in the order of time.
    pub other_impacts: Vec<OtherImpact>,
}

/// Another impact of a vehicle in the same crash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherImpact {
    /// Whether it was after the impact of the case.
    pub after: bool,
    /// (rad) principal direction of force, clockwise from the front.
    pub pdof: Option<Quantity>,
    /// (m/s) ΔV of the vehicle.
    pub delta_v: Option<Quantity>,
}

impl OtherImpact {
    /// `when`, with its words.
    pub const WHEN: [(&str, bool); 2] = [("before", false), ("after", true)];

    /// The data of this impact that distinguish it in a record.
    #[must_use]
    pub fn known(&self) -> KnownImpact {
        let si = |of: &Option<Quantity>| of.as_ref().map(Quantity::si);
        KnownImpact { force_direction: si(&self.pdof), delta_v: si(&self.delta_v) }
    }
}

/// One of several records of a recorder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StoredRecord {
    /// Its content; `at` and `errors` belong to the recorder and are not used here.
    pub stored: Recorder,
    /// (s) from the record before it.
    pub since_previous: Option<Quantity>,
}

/// (m/s) 2 km/h: a slower vehicle was at rest or crawling, and the error of its speed is not proportional to
/// it.
const STOOD: f64 = 2.0 / 3.6;

/// The speed at impact by a recorder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordersSpeed {
    /// (m/s) the speed.
    pub speed: f64,
    /// (–) standard deviation of its error as a share of it; `None` if the default applies.
    pub error: Option<f64>,
    /// Whether it follows from the table before the impact, rather than being given as a number.
    pub is_of_table: bool,
    /// The two speeds that the table may mean, if its last speeds fell too steeply.
    pub humps: Option<[SpeedHump; 2]>,
}

/// ΔV by a recorder, along the vehicle and to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordersDeltaV {
    /// (m/s) along the vehicle, positive forward.
    pub along: Option<f64>,
    /// (m/s) across the vehicle, positive to the left.
    pub left: Option<f64>,
    /// Whether it follows from the pulse, rather than being given as numbers.
    pub is_of_table: bool,
    /// (m) the place of the recorder, forward and left of the centre of gravity, if this is the ΔV there;
    /// `None` if it is that of the centre of gravity.
    pub place: Option<[f64; 2]>,
}

impl RecordersDeltaV {
    /// (m/s) resultant of the components that the recorder has.
    #[must_use]
    pub fn size(&self) -> f64 {
        let [along, left] = [self.along, self.left].map(Option::unwrap_or_default);
        (along * along + left * left).sqrt()
    }

    /// (m/s) the component of another ΔV, along and to the left, in the direction of this one; zero if this
    /// one is zero.
    #[must_use]
    pub fn part_of(&self, [along, left]: [f64; 2]) -> f64 {
        let size = self.size();
        let product = self.along.unwrap_or_default() * along + self.left.unwrap_or_default() * left;
        if size > 0.0 { product / size } else { 0.0 }
    }
}

impl Recorder {
    /// Whether it has a table of its own or of several records.
    #[must_use]
    pub fn has_table(&self) -> bool {
        self.pre_crash.is_some() || self.pulse.is_some() || !self.records.is_empty()
    }

    /// The samples before the impact.
    #[must_use]
    pub fn before_impact(&self) -> Option<&PreCrash> {
        self.pre_crash.as_ref()?.record.as_ref()
    }

    /// The pulse.
    #[must_use]
    pub fn during_impact(&self) -> Option<&CrashPulse> {
        self.pulse.as_ref()?.record.as_ref()
    }

    /// The distribution of the speed at impact by the table before the impact; `ground` (–) is the friction
    /// of the surface, if the case gives it. `None` without a table, or with one that has no speed.
    #[must_use]
    pub fn impact_speed(&self, ground: Option<f64>) -> Option<ImpactSpeed> {
        // The reader of a case refuses errors out of their range.
        ImpactSpeed::of(self.before_impact()?, &self.speed_errors(ground)).ok()
    }

    /// The errors of a stored speed, with the defaults for those that the case does not give; `ground` (–) is
    /// the friction of the surface.
    #[must_use]
    pub fn speed_errors(&self, ground: Option<f64>) -> ImpactSpeedErrors {
        self.errors.errors(ground, self.before_impact())
    }

    /// The speed at impact: as given or, if it is not, by the table before the impact. Also `None` if the
    /// vehicle was at rest or crawling according to the table.
    #[must_use]
    pub fn tells_speed(&self, ground: Option<f64>) -> Option<RecordersSpeed> {
        let given = self.speed_error.map(|percent| percent / 100.0);
        if let Some(speed) = &self.speed {
            return Some(RecordersSpeed { speed: speed.si(), error: given, is_of_table: false, humps: None });
        }
        let found = self.impact_speed(ground).filter(|found| found.mean >= STOOD)?;
        let error = given.or(Some(found.sd / found.mean));
        let humps = found.humps.map(|humps| {
            humps.map(|hump| SpeedHump { sd: given.map_or(hump.sd, |share| share * hump.mean), ..hump })
        });
        Some(RecordersSpeed { speed: found.mean, error, is_of_table: true, humps })
    }

    /// ΔV: as given or, if it is not, by the pulse, provided that it ends within the record. If the case
    /// gives the place of the recorder and the yaw rate after the impact, that rate less the one `before` the
    /// impact (rad/s, in the sense of the axes) converts it to the centre of gravity.
    #[must_use]
    pub fn tells_delta_v(&self, axes: Axes, before: f64) -> Option<RecordersDeltaV> {
        self.delta_v(axes, before).filter(|(_, complete)| *complete).map(|(told, _)| told)
    }

    /// A lower bound of ΔV, if the record does not contain all of it: because it ends before the impact does,
    /// or because the recorder did not finish it. `before` as in [`tells_delta_v`](Self::tells_delta_v).
    ///
    /// Each stored component is a bound at the place of the recorder. The whole change of the yaw
    /// rate, if the case gives it, converts the bound to the centre of gravity. A component whose sign this
    /// changes is bounded by 0.
    #[must_use]
    pub fn least_delta_v(&self, axes: Axes, before: f64) -> Option<RecordersDeltaV> {
        let (told, _) = self.delta_v(axes, before).filter(|(_, complete)| !complete)?;
        let [along, left] = self.stored(axes)?.delta_v;
        let bound = |stored: Option<f64>, at_center: Option<f64>| {
            let (stored, at_center) = stored.zip(at_center)?;
            Some(if stored * at_center > 0.0 { at_center } else { 0.0 })
        };
        Some(RecordersDeltaV { along: bound(along, told.along), left: bound(left, told.left), ..told })
    }

    /// One of several records, as the record of a recorder that has one.
    #[must_use]
    pub fn record(&self, index: usize) -> Option<Self> {
        let stored = self.records.get(index)?.stored.clone();
        Some(Self { at: self.at, errors: self.errors, ..stored })
    }

    /// The data of its record that distinguish impacts; `before` as in
    /// [`tells_delta_v`](Self::tells_delta_v).
    #[must_use]
    pub fn event(&self, axes: Axes, before: f64) -> EventRecord {
        let Some((told, complete)) = self.delta_v(axes, before) else { return EventRecord::default() };
        EventRecord::new([told.along, told.left.map(|left| -left)], complete)
    }

    /// ΔV, and whether the record contains all of it.
    fn delta_v(&self, axes: Axes, before: f64) -> Option<(RecordersDeltaV, bool)> {
        let Stored { delta_v: [along, left], complete, is_of_table } = self.stored(axes)?;
        let turned = self.yaw_rate.as_ref().map(|rate| axes.lateral(rate.si() - before));
        let place = self.at.map(|at| [at.x.si(), axes.lateral(at.y.si())]);
        let (along, left) = match (place, turned) {
            (Some(place), Some(turned)) => {
                // The rotation changes each part by its own amount, whether the other is known or not.
                let known = [along, left].map(Option::unwrap_or_default);
                let [at_along, at_left] = recorder::delta_v_at_center(known, turned, place);
                (along.map(|_| at_along), left.map(|_| at_left))
            }
            _ => (along, left),
        };
        let place = place.filter(|_| turned.is_none());
        Some((RecordersDeltaV { along, left, is_of_table, place }, complete))
    }

    /// ΔV at the place of the recorder.
    fn stored(&self, axes: Axes) -> Option<Stored> {
        if self.delta_v_longitudinal.is_some() || self.delta_v_lateral.is_some() {
            let along = self.delta_v_longitudinal.as_ref().map(Quantity::si);
            let left = self.delta_v_lateral.as_ref().map(|across| axes.lateral(across.si()));
            return Some(Stored { delta_v: [along, left], complete: !self.incomplete, is_of_table: false });
        }
        // Up to the greatest ΔV, the record is of the impact.
        let span = self.during_impact()?.span(PulseRule::GreatestDeltaV)?;
        // A recorder stores what is to the right as positive.
        let delta_v = [span.delta_v[0], span.delta_v[1].map(|right| -right)];
        Some(Stored { delta_v, complete: span.complete && !self.incomplete, is_of_table: true })
    }
}

/// ΔV as a recorder stored it.
struct Stored {
    /// (m/s) along the vehicle and to its left.
    delta_v: [Option<f64>; 2],
    /// Whether the record contains all of it.
    complete: bool,
    /// Whether it follows from the pulse.
    is_of_table: bool,
}

/// Certain limits of the speed of a vehicle before the impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CertainSpeed {
    /// (m/s) it was not slower.
    pub at_least: Option<Quantity>,
    /// (m/s) it was not faster.
    pub at_most: Option<Quantity>,
}

/// The assumptions of an estimate before the evidence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GivenEstimate {
    /// The prior for the severity of the collision.
    pub prior: SeverityPrior,
    /// (m/s) median of √(ΔV₁ ΔV₂) before the evidence, in place of the median of the field.
    pub delta_v_median: Option<Quantity>,
    /// (%) standard deviation of the error of crush energies as measures of the energy absorbed in the
    /// impact, in place of the default for the method of each.
    pub crush_error: Option<f64>,
    /// (%) average ratio of the crush energy to the energy absorbed in the impact, in place of the default
    /// for the method.
    pub crush_bias: Option<f64>,
    /// (%) part of the error of a computed rest position that is proportional to the path length.
    pub rest_error: Option<f64>,
    /// (m) part of that error that even a short path has.
    pub rest_least_error: Option<Quantity>,
    /// (rad) error of a computed heading at rest.
    pub rest_heading_error: Option<Quantity>,
    /// (%) probability, before the evidence, that a vehicle of unknown speed was at rest.
    pub stood: Option<f64>,
}

choices! {
    /// The severity of a collision before the evidence.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum SeverityPrior {
        /// `"field"`: like that of collisions after which a vehicle was towed.
        #[default]
        Field = "field",
        /// `"serious-injury"`: like that of those among them in which somebody was seriously hurt.
        SeriousInjury = "serious-injury",
        /// `"flat"`: any speed is as likely as any other.
        Flat = "flat",
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn exact_if(&mut self, path: &dyn Display, quantity: Option<&Quantity>) {
        if let Some(quantity) = quantity {
            self.exact(path, quantity);
        }
    }

    pub(crate) fn percent_if(&mut self, path: &dyn Display, percent: Option<f64>) {
        if let Some(percent) = percent {
            self.other(path, || GivenValue::Text(format!("{} %", format_number(percent))));
        }
    }

    pub(crate) fn recorder(&mut self, table: &dyn Display, recorder: &Recorder) -> Recorder {
        let at = |key| Key(table, key);
        self.exact_if(&at("delta_v_longitudinal"), recorder.delta_v_longitudinal.as_ref());
        self.exact_if(&at("delta_v_lateral"), recorder.delta_v_lateral.as_ref());
        self.percent_if(&at("delta_v_error"), recorder.delta_v_error);
        self.exact_if(&at("direction_error"), recorder.direction_error.as_ref());
        self.exact_if(&at("speed"), recorder.speed.as_ref());
        self.percent_if(&at("speed_error"), recorder.speed_error);
        self.exact_if(&at("yaw_rate"), recorder.yaw_rate.as_ref());
        self.exact_if(&at("yaw_rate_error"), recorder.yaw_rate_error.as_ref());
        self.series(&at("pre_crash"), recorder.pre_crash.as_deref());
        self.series(&at("pulse"), recorder.pulse.as_deref());
        self.flag(&at("incomplete"), recorder.incomplete);
        if let Some(place) = &recorder.at {
            self.exact_place(&at("at"), place);
        }
        self.speed_errors(&at("errors"), &recorder.errors);
        let records = at("records");
        for (index, record) in recorder.records.iter().enumerate() {
            let table = Element(&records, index);
            self.exact_if(&Key(&table, "since_previous"), record.since_previous.as_ref());
            self.recorder(&table, &record.stored);
        }
        let others = at("other_impacts");
        for (index, other) in recorder.other_impacts.iter().enumerate() {
            let table = Element(&others, index);
            self.choice(&Key(&table, "when"), &OtherImpact::WHEN, other.after);
            self.exact_if(&Key(&table, "pdof"), other.pdof.as_ref());
            self.exact_if(&Key(&table, "delta_v"), other.delta_v.as_ref());
        }
        recorder.clone()
    }

    pub(crate) fn certain_speed(&mut self, table: &dyn Display, certain: &CertainSpeed) -> CertainSpeed {
        self.exact_if(&Key(table, "at_least"), certain.at_least.as_ref());
        self.exact_if(&Key(table, "at_most"), certain.at_most.as_ref());
        *certain
    }

    pub(crate) fn estimate(&mut self, estimate: &GivenEstimate) -> GivenEstimate {
        self.choice(&"estimate.prior", &SeverityPrior::WORDS, estimate.prior);
        self.exact_if(&"estimate.delta_v_median", estimate.delta_v_median.as_ref());
        self.percent_if(&"estimate.crush_error", estimate.crush_error);
        self.percent_if(&"estimate.crush_bias", estimate.crush_bias);
        self.percent_if(&"estimate.rest_error", estimate.rest_error);
        self.exact_if(&"estimate.rest_least_error", estimate.rest_least_error.as_ref());
        self.exact_if(&"estimate.rest_heading_error", estimate.rest_heading_error.as_ref());
        self.percent_if(&"estimate.stood", estimate.stood);
        *estimate
    }
}
