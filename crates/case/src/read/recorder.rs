//! `[vehicleN.recorder]`, `certain_speed` of a vehicle, and `[estimate]`.

use std::sync::Arc;

use recorder::{Channel, TextFault, TextRefusal};

use super::tree::{Reader, Table};
use super::values::Place as Position;
use crate::case_problem::CaseProblem;
use crate::schema::KEYS_OF_RECORD;
use crate::source::span_in_text;
use inputs::{
    CertainSpeed, GivenEstimate, GivenSeries, GivenSpeedErrors, OfTables, OtherImpact, Quantity, Recorder,
    SeriesRefusal, SeriesSource, SeverityPrior, StoredRecord, Text,
};

/// The columns of `pre_crash`, and those of `pulse`.
const BEFORE_IMPACT: [Channel; 10] = [
    Channel::Time,
    Channel::Speed,
    Channel::Brake,
    Channel::Abs,
    Channel::Stability,
    Channel::Accelerator,
    Channel::Throttle,
    Channel::EngineSpeed,
    Channel::Steering,
    Channel::YawRate,
];
const DURING_IMPACT: [Channel; 3] = [Channel::Time, Channel::DeltaVLongitudinal, Channel::DeltaVLateral];

/// How `pre_crash` and `pulse` are written.
const PRE_CRASH_FORMS: &str = "pre_crash = { file = \"edr.csv\" }, { text = \"\"\"…\"\"\" } or { time = \"-1 -0.5 0 s\", speed = \"60 58 47 km/h\", brake = \"off on on\" }";
const PULSE_FORMS: &str = "pulse = { file = \"pulse.csv\" }, { text = \"\"\"…\"\"\" } or { time = \"0 10 20 ms\", delta_v_longitudinal = \"0 -4 -9 km/h\" }";

/// (%) limits of the errors of a recorder.
const MOST_SHARE: f64 = 20.0;
const MOST_FRICTION: f64 = 150.0;
/// Maximum number of records: a recorder keeps a handful.
const MOST_RECORDS: usize = 20;
const WITHOUT_RANGE: &str =
    "a string with a number and a unit: `deltav recorder` compares it with errors of its own";
const TIME_APART: &str = "a string with a number and a unit: the time between two records has no range";
const ERROR: &str = "a string with a number and a unit: an error has no range";

const EXACT: &str = "a string with a number and a unit: its error has a key of its own, as delta_v_error, speed_error or yaw_rate_error";
const STOOD: &str = "a recorder gives the speed of a vehicle that moved; for a stationary one, leave this \
                     out and write speed = \"0 km/h\" in the table of the vehicle";
/// (%) upper limit of the probability that a vehicle stood still: two stationary vehicles do not collide.
const MOST_STOOD: f64 = 50.0;
const CERTAIN: &str =
    "a string with a number and a unit: an uncertain speed belongs in `speed` of the vehicle, as a range";

/// What a recorder stores: the other keys say something about these.
const CONTENTS: [&str; 6] = ["delta_v_longitudinal", "speed", "yaw_rate", "pre_crash", "pulse", "records"];

impl<'t> Reader<'t> {
    /// Reads the table; one without a key counts as absent.
    pub(super) fn recorder(&mut self, vehicle: &Table<'t>) -> Option<Recorder> {
        let table = self.child(vehicle, "recorder")?;
        let at = self.place_of(&table, "at");
        if table.has("at") && table.given(&["delta_v_longitudinal", "pulse", "records"]).is_empty() {
            self.missing(&table, "delta_v_longitudinal");
        }
        let errors = self.child(&table, "errors");
        let errors = errors.map_or_else(GivenSpeedErrors::default, |table| self.speed_errors(&table));
        let records = self.records(&table);
        let other_impacts = self.other_impacts(&table);
        let record = self.record(&table);
        let says_of_record = record.incomplete || table.has("other_impacts");
        if says_of_record && table.given(&CONTENTS).is_empty() {
            self.missing(&table, "speed");
        }
        let recorder = Recorder { at, errors, records, other_impacts, ..record };
        (recorder != Recorder::default()).then_some(recorder)
    }

    /// Several records.
    fn records(&mut self, recorder: &Table<'t>) -> Vec<StoredRecord> {
        const FORMS: &str =
            "records = [{ speed = \"55 km/h\" }, { since_previous = \"0.8 s\", speed = \"41 km/h\" }]";
        let Some(tables) = self.tables(recorder, "records", FORMS, MOST_RECORDS) else {
            return Vec::new();
        };
        for key in recorder.given(&KEYS_OF_RECORD) {
            let path = recorder.path_of(key);
            let message = format!("\"{path}\" belongs to one record, but `records` has several");
            self.refuse::<()>(&path, message, "move it into the record that it belongs to");
        }
        if tables.is_empty() {
            let path = recorder.path_of("records");
            let help = format!("write {FORMS}, or leave it out");
            self.refuse::<()>(&path, format!("\"{path}\" is an empty list"), &help);
        }
        if let Some(first) = tables.first().filter(|first| first.has("since_previous")) {
            let path = first.path_of("since_previous");
            let message = format!("\"{path}\" belongs to the first record, which has none before it");
            let help = "list the records in the order of time, and give this key from the second on";
            self.refuse::<()>(&path, message, help);
        }
        let record = |table: &Table<'t>| {
            self.not_empty(table, FORMS);
            StoredRecord {
                since_previous: self.exact_quantity(table, "since_previous", TIME_APART),
                stored: self.record(table),
            }
        };
        tables.iter().map(record).collect()
    }

    fn other_impacts(&mut self, recorder: &Table<'t>) -> Vec<OtherImpact> {
        const FORMS: &str =
            "other_impacts = [{ when = \"after\", pdof = \"90 deg\", delta_v = \"12 km/h\" }]";
        let tables = self.tables(recorder, "other_impacts", FORMS, MOST_RECORDS);
        let other = |table: &Table<'t>| {
            self.require(table, &["when"]);
            if table.given(&["pdof", "delta_v"]).is_empty() {
                return self.no_form(table, FORMS);
            }
            let [pdof, delta_v] =
                ["pdof", "delta_v"].map(|key| self.exact_quantity(table, key, WITHOUT_RANGE));
            Some(OtherImpact { after: self.choice(table, "when", &OtherImpact::WHEN)?, pdof, delta_v })
        };
        let others: Vec<OtherImpact> = tables.unwrap_or_default().iter().filter_map(other).collect();
        if !others.is_sorted_by_key(|other| other.after) {
            let path = recorder.path_of("other_impacts");
            let message = format!("\"{path}\" lists an impact after that of the case ahead of one before it");
            self.refuse::<()>(&path, message, "write them in the order of time");
        }
        others
    }

    /// The keys of one record.
    fn record(&mut self, table: &Table<'t>) -> Recorder {
        let [delta_v_longitudinal, delta_v_lateral, direction_error, yaw_rate, yaw_rate_error] =
            ["delta_v_longitudinal", "delta_v_lateral", "direction_error", "yaw_rate", "yaw_rate_error"]
                .map(|key| self.exact_quantity(table, key, EXACT));
        let speed = Position::of_key(table, "speed").zip(table.measure("speed"));
        let speed =
            speed.and_then(|(place, measure)| self.certain_quantity(&place, measure.positive(STOOD), EXACT));
        let [delta_v_error, speed_error] =
            ["delta_v_error", "speed_error"].map(|key| self.percent(table, key));
        // Each needs what it says something about, or the table from which that follows.
        let needs = [
            ("delta_v_lateral", "delta_v_longitudinal", None),
            ("direction_error", "delta_v_lateral", None),
            ("yaw_rate_error", "yaw_rate", None),
            ("speed_error", "speed", Some("pre_crash")),
            ("delta_v_error", "delta_v_longitudinal", Some("pulse")),
        ];
        for (key, needed, or) in needs {
            if table.has(key) && !table.has(needed) && !or.is_some_and(|or| table.has(or)) {
                self.missing(table, needed);
            }
        }
        let pre_crash = self.series(table, "pre_crash", &BEFORE_IMPACT, PRE_CRASH_FORMS);
        let pulse = self.series(table, "pulse", &DURING_IMPACT, PULSE_FORMS);
        let excluded = [
            (
                "pre_crash",
                "speed",
                "the speed at impact",
                "the speed at impact follows from the table: leave one of them out",
            ),
            ("pulse", "delta_v_longitudinal", "ΔV", "ΔV follows from the pulse: leave one of them out"),
            ("pulse", "delta_v_lateral", "ΔV", "ΔV follows from the pulse: leave one of them out"),
        ];
        for (of_table, key, what, help) in excluded {
            if table.has(of_table) && table.has(key) {
                let path = table.path_of(key);
                self.refuse::<()>(&path, format!("\"{path}\" and `{of_table}` both give {what}"), help);
            }
        }
        Recorder {
            delta_v_longitudinal,
            delta_v_lateral,
            delta_v_error,
            direction_error,
            speed,
            speed_error,
            yaw_rate,
            yaw_rate_error,
            pre_crash,
            pulse,
            incomplete: self.flag(table, "incomplete"),
            ..Recorder::default()
        }
    }

    fn speed_errors(&mut self, table: &Table<'t>) -> GivenSpeedErrors {
        let [step, slip_low, slip_sd, latency] =
            ["step", "slip_low", "slip_sd", "latency"].map(|key| self.exact_quantity(table, key, ERROR));
        let [steady_low, steady_sd, tyre_sd] =
            ["steady_low", "steady_sd", "tyre_sd"].map(|key| self.percent_below(table, key, MOST_SHARE));
        let [friction, coasting] =
            ["friction", "coasting"].map(|key| self.percent_below(table, key, MOST_FRICTION));
        let [brake_comes_on, keeps_braking, last_is_of_impact] =
            ["brake_comes_on", "keeps_braking", "last_is_of_impact"].map(|key| self.probability(table, key));
        let errors = GivenSpeedErrors {
            step,
            steady_low,
            steady_sd,
            tyre_sd,
            slip_low,
            slip_sd,
            friction,
            coasting,
            brake_comes_on,
            keeps_braking,
            latency,
            last_is_of_impact,
        };
        if let Err(refusal) = errors.errors(None, None).check() {
            let path = table.path_of(refusal.name);
            let help = "it is the error of a speed at impact, and should be about as large as in its example";
            self.refuse::<()>(&path, format!("\"{path}\" is too large"), help);
        }
        errors
    }

    /// A table of samples, in one of its three forms.
    fn series<R: OfTables>(
        &mut self,
        recorder: &Table<'t>,
        key: &'static str,
        columns: &[Channel],
        forms: &'static str,
    ) -> Option<Arc<GivenSeries<R>>> {
        let table = self.inline(recorder, key, forms)?;
        let source = self.series_source(&table, columns, forms)?;
        let rows = self.text(&table, "rows");
        match GivenSeries::read(source, rows) {
            Ok(read) => Some(Arc::new(read)),
            Err(refusal) => self.series_refused(&table, &refusal),
        }
    }

    fn series_source(
        &mut self,
        table: &Table<'t>,
        columns: &[Channel],
        forms: &'static str,
    ) -> Option<SeriesSource> {
        let own = table.given(&["text", "file"]);
        let listed: Vec<Channel> = columns.iter().copied().filter(|one| table.has(one.key())).collect();
        match (own.as_slice(), listed.len()) {
            (["text"], 0) => self.text(table, "text").map(SeriesSource::Text),
            (["file"], 0) => self.text(table, "file").map(SeriesSource::File),
            ([], 2..) if table.has("time") && !table.has("rows") => {
                let columns: Vec<Option<(Channel, Text)>> = listed
                    .into_iter()
                    .map(|channel| Some((channel, self.text(table, channel.key())?)))
                    .collect();
                columns.into_iter().collect::<Option<_>>().map(SeriesSource::Columns)
            }
            _ => self.no_form(table, forms),
        }
    }

    /// Reports a table that cannot be read, at the place in the text that is wrong.
    fn series_refused<T>(&mut self, table: &Table<'t>, refusal: &SeriesRefusal) -> Option<T> {
        let (key, place) = match refusal {
            SeriesRefusal::Text(TextRefusal {
                fault: TextFault::NoSuchRows { .. } | TextFault::NoColumn { .. } | TextFault::NotLong,
                ..
            }) => ("rows", None),
            SeriesRefusal::Text(refusal) => ("text", refusal.place),
            SeriesRefusal::Column(channel, refusal) => (channel.key(), refusal.place),
            _ => (if table.has("text") { "text" } else { "time" }, refusal.place()),
        };
        let problem = CaseProblem::Fault { message: refusal.to_string(), help: refusal.advice() };
        let span = table.get(key).map(|value| {
            let span = value.span();
            let of_place = value.get_ref().as_str().zip(place);
            of_place.and_then(|(text, place)| span_in_text(self.text, &span, text, place)).unwrap_or(span)
        });
        match span {
            Some(span) => self.report(span, problem),
            None => self.report_path(&table.path, problem),
        }
        None
    }

    pub(super) fn certain_speed(&mut self, vehicle: &Table<'t>) -> Option<CertainSpeed> {
        const FORMS: &str =
            "certain_speed = { at_least = \"0 km/h\", at_most = \"60 km/h\" }, or one of these alone";
        let table = self.inline(vehicle, "certain_speed", FORMS)?;
        let [at_least, at_most] =
            ["at_least", "at_most"].map(|key| self.exact_quantity(&table, key, CERTAIN));
        if table.given(&["at_least", "at_most"]).is_empty() {
            return self.no_form(&table, FORMS);
        }
        let [low, high] = [&at_least, &at_most].map(|limit| limit.as_ref().map(Quantity::si));
        if let (Some(low), Some(high)) = (low, high)
            && low >= high
        {
            let path = table.path_of("at_least");
            let message = format!("\"{path}\" is not below `at_most`");
            let help = if low > high {
                "exchange the two: the vehicle was at least as fast as `at_least`, and at most as fast as `at_most`"
            } else {
                "a speed that is known exactly belongs in `speed` of the vehicle"
            };
            return self.refuse(&path, message, help);
        }
        Some(CertainSpeed { at_least, at_most })
    }

    pub(super) fn estimate(&mut self, table: &Table<'t>) -> GivenEstimate {
        const EXACT_PRIOR: &str = "a string with a number and a unit: its spread is that of real crashes";
        const EXACT_ERROR: &str = "a string with a number and a unit: an error has no range";
        GivenEstimate {
            prior: self.choice(table, "prior", &SeverityPrior::WORDS).unwrap_or_default(),
            delta_v_median: self.exact_quantity(table, "delta_v_median", EXACT_PRIOR),
            crush_error: self.percent(table, "crush_error"),
            crush_bias: self.percent(table, "crush_bias"),
            rest_error: self.percent(table, "rest_error"),
            rest_least_error: self.exact_quantity(table, "rest_least_error", EXACT_ERROR),
            rest_heading_error: self.exact_quantity(table, "rest_heading_error", EXACT_ERROR),
            stood: self.percent_below(table, "stood", MOST_STOOD),
        }
    }
}
