//! `[vehicleN.recorder]`, `certain_speed` of a vehicle, and `[estimate]`.

use super::tree::{Reader, Table};
use super::values::Place as Position;
use crate::case_problem::CaseProblem;
use crate::schema::{CERTAIN_SPEED, RECORDER};
use inputs::{CertainSpeed, GivenEstimate, Prior, Quantity, Recorder};

const EXACT: &str = "a string with a number and a unit: its error stands beside it, as delta_v_error, speed_error or yaw_rate_error";
const STOOD: &str = "a recorder tells the speed of a vehicle that moved; for one that stood, leave this out and write speed = \"0 km/h\" in the table of the vehicle";
/// (%) upper limit of the probability that a vehicle stood still: two standing vehicles do not collide.
const MOST_STOOD: f64 = 50.0;
const CERTAIN: &str =
    "a string with a number and a unit: an uncertain speed belongs in `speed` of the vehicle, as a range";

impl<'t> Reader<'t> {
    /// Reads the table; one without a key counts as absent.
    pub(super) fn recorder(&mut self, vehicle: &Table<'t>) -> Option<Recorder> {
        let table = self.child(vehicle, "recorder", &RECORDER)?;
        let [delta_v_longitudinal, delta_v_lateral, direction_error, yaw_rate, yaw_rate_error] =
            ["delta_v_longitudinal", "delta_v_lateral", "direction_error", "yaw_rate", "yaw_rate_error"]
                .map(|key| self.exact_quantity(&table, key, EXACT));
        let speed = table.get("speed").zip(table.measure("speed")).and_then(|(value, measure)| {
            self.certain_quantity(&Position::of_key(&table, "speed"), value, measure.positive(STOOD), EXACT)
        });
        let [delta_v_error, speed_error] =
            ["delta_v_error", "speed_error"].map(|key| self.percent(&table, key));
        let needs = [
            ("delta_v_lateral", "delta_v_longitudinal"),
            ("direction_error", "delta_v_lateral"),
            ("yaw_rate_error", "yaw_rate"),
        ];
        for (key, needed) in needs {
            if table.has(key) && !table.has(needed) {
                self.missing(&table, needed);
            }
        }
        let recorder = Recorder {
            delta_v_longitudinal,
            delta_v_lateral,
            delta_v_error,
            direction_error,
            speed,
            speed_error,
            yaw_rate,
            yaw_rate_error,
        };
        (recorder != Recorder::default()).then_some(recorder)
    }

    pub(super) fn certain_speed(&mut self, vehicle: &Table<'t>) -> Option<CertainSpeed> {
        const FORMS: &str =
            "certain_speed = { at_least = \"0 km/h\", at_most = \"60 km/h\" }, or one of these alone";
        let table = self.inline(vehicle, "certain_speed", &CERTAIN_SPEED, "a table in braces", FORMS)?;
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
            let help = Some("a speed that is known exactly belongs in `speed` of the vehicle".to_owned());
            self.report_path(&path, CaseProblem::Fault { message, help });
            return None;
        }
        Some(CertainSpeed { at_least, at_most })
    }

    pub(super) fn estimate(&mut self, table: &Table<'t>) -> GivenEstimate {
        const EXACT_PRIOR: &str = "a string with a number and a unit: its spread is that of real crashes";
        const EXACT_ERROR: &str = "a string with a number and a unit: an error has no range";
        GivenEstimate {
            prior: self.choice(table, "prior", &Prior::WORDS).unwrap_or_default(),
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
