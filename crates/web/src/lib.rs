//! The engine of the program in a browser: the text of a case in, JSON out.
//!
//! The text is the only state. No function throws for a bad case: its faults are in the JSON. Every place is
//! given as a browser counts, in UTF-16 units from the beginning of the text, as `from` and `to`. `units` is
//! `si`, `us`, `uk`, or empty for those of the case. If no name is given, the file is called `case.toml`.
//!
//! A problem is `{ from, to, line, column, key, title, help }`; `line` and `column` count from 1 and are
//! `null` if it concerns the file as a whole.
//!
//! ```
//! // A mile is 1.609344 km.
//! assert_eq!(deltav_web::convert("10 mph", "km/h"), r#"{"ok":true,"text":"16.09344 km/h"}"#);
//! assert!(deltav_web::convert("10 mph", "kg").starts_with(r#"{"ok":false,"message":"#));
//! ```

mod answer;
mod check;
mod drag;
mod edit;
mod form;
mod given;
mod pages;
mod picture;
mod run;
mod slide;
mod warned;

use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// The version of the engine, which is that of the program.
#[wasm_bindgen]
#[must_use]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Cases to start from: `[{ name, title, purpose, text_si, text_us }]`, the paper's example first. `purpose`
/// is the description of its use from the head of the text.
#[wasm_bindgen]
#[must_use]
pub fn templates() -> String {
    pages::templates().to_string()
}

/// The form of a case: `[{ key, title, help, fields, groups }]`, a group for each table.
///
/// A field is `{ key, kind, title, help, required, range, units, choices, fields }`. `kind` is `quantity`,
/// `number`, `numbers`, `quantities`, `text`, `flag`, `choice`, `integer`, `names`, `wheels`,
/// `angle-or-hour`, `table` or `tables`; `units` are the spellings that the field can have, the usual one
/// first. `fields` are the keys of the table that can stand in place of a word or a number, and `groups` are
/// the tables with a header of their own. `explain` gives the glossary's text on a key, by its path.
#[wasm_bindgen]
#[must_use]
pub fn form() -> String {
    form::form().to_string()
}

/// A topic of the glossary, by its name, a symbol, a key or the code of a warning: `{ title, html }`, or `{
/// error, nearest }`.
#[wasm_bindgen]
#[must_use]
pub fn explain(word: &str) -> String {
    pages::explain(word).to_string()
}

/// The content of a text: `{ ok, problems, values, commands, judgement_html, units }`.
///
/// `values` has the place of each key that the file gives and its value as written: `{ from, to, text }`.
/// `commands` has `{ able, why }` for `reconstruct`, `impact`, `motion`, `crush`, `compare`, `sensitivity`,
/// `uncertainty`, `estimate`, `avoid` and `recorder`; it is empty if the file is wrong.
#[wasm_bindgen]
#[must_use]
pub fn check(text: &str, name: Option<String>) -> String {
    check::check(text, name.as_deref()).to_string()
}

/// The answer of a quick command: `reconstruct`, `impact`, `motion`, `crush`, `check`, `compare`,
/// `sensitivity` or `recorder`. An empty one is the most complete that the case allows.
///
/// `{ ok: true, command, headline, html, charts: [{ name, title, svg }], text, json, csv, warnings: [{ code,
/// message, vehicle, keys, aside }] }`, or `{ ok: false, problems, message }`. `html` has no charts. `json`
/// is byte for byte what the program writes; `csv` is `null` if the command has none; for `recorder`, it has
/// the stored data. A warning is `aside` if it concerns only an exact solution that is not the answer.
#[wasm_bindgen]
#[must_use]
pub fn answer(text: &str, command: &str, units: &str, name: Option<String>) -> String {
    answer::answer(text, command, units, name.as_deref()).to_string()
}

/// The first view of a text, from one reading, one analysis and one drawing: for each move of a mouse.
/// `command` is the one that is wanted; a case without the data for it gets the most complete answer that it
/// allows. `what` and `viewport` are those of `scene`; a case without that view shows the other one, and
/// `none` draws nothing.
///
/// `{ ok: true, headline, exact, warnings, command, able: [command], units, scene }`, or `{ ok: false,
/// problems, message, command, able, units, scene }`, without the last four if the text cannot be read.
/// `warnings` are those of `answer`, and `scene` is what `scene` gives, or `null`. `able` may have `avoid`,
/// whose headline is that of the central values, or empty if its speed has to be found first; and `recorder`.
///
/// `exact` is `null` unless the case has an exact solution that is not the answer: then the answer is that
/// of an estimate, `headline` only says so, and `exact` is `{ by, speeds, delta_v, caveat }`. `by` names the
/// part of the evidence that the solution uses; `speeds` and `delta_v` have a text for each vehicle, `null`
/// for one that does not move; `caveat` says why the solution is not the answer.
#[wasm_bindgen]
#[must_use]
pub fn look(text: &str, command: &str, units: &str, what: &str, viewport: &str) -> String {
    answer::look(text, command, units, what, viewport).to_string()
}

/// A drawing of an answer: `what` is `scene`, `motion`, `motion-curves`, `momentum`, `damage`,
/// `reconciliation` or `energy`, or `plain-scene` or `plain-motion` for readers who are not engineers;
/// without speeds if the exact solution is not the answer. `{ ok: true, svg, title, description }`, or `{ ok:
/// false, problems, message }`.
#[wasm_bindgen]
#[must_use]
pub fn draw(text: &str, what: &str, units: &str) -> String {
    picture::draw(text, what, units).to_string()
}

/// The scene or the motion, to be edited: `what` is `scene`, `motion`, or empty for the first that the case
/// has. `viewport` is empty, or that of an earlier picture, so that the view stays the same.
///
/// `{ ok: true, what, svg, title, description, viewport: { left, bottom, right, top }, origin, scale,
/// contact, bodies, handles, survey, plan }`, or `{ ok: false, problems, message }`. Places are in metres, y
/// upwards, whatever the axes of the case; a place x, y is at `origin[0] + scale x`, `origin[1] - scale y` in
/// the units of the SVG. A body is `{ vehicle, outline, centre, heading }`, or `null`. A handle is `{ kind,
/// vehicle, index, at, centre, keys }`: `heading`, `body` and `contact` of a vehicle, `plane`, `station` of
/// its crush, `rest`, `rest_heading` and `point`; `index` counts from 0, and a handle that turns does so
/// around `centre`. `survey` is to be added to a place to convert it to the coordinates of the survey, in
/// which `plan` has the site plan of the case, `{ file, corner, width, angle }`, or `null`: its lower left
/// corner, and the length of its lower edge and its angle (rad) from the x axis.
#[wasm_bindgen]
#[must_use]
pub fn scene(text: &str, what: &str, units: &str, viewport: &str) -> String {
    picture::scene(text, what, units, viewport).to_string()
}

/// The text with a handle of `scene` moved: `handle` as it was given, and `to` is `{ at: [x, y] }` in metres
/// or, for a handle that turns, `{ angle }` in radians from the x axis to its new direction. The numbers keep
/// their units and their comments, and have as many digits as the accuracy of a mouse justifies.
///
/// `{ ok: true, text, changed: [key] }`, or `{ ok: false, problems, message }`.
#[wasm_bindgen]
#[must_use]
pub fn drag(text: &str, handle: &str, to: &str) -> String {
    drag::drag(text, handle, to).to_string()
}

/// The text with a picture of the scene from above kept in it, as `site_plan` of `[scene]`; `plan` is as
/// `scene` gives it. Answers as `drag`.
#[wasm_bindgen]
#[must_use]
pub fn keep_plan(text: &str, plan: &str) -> String {
    drag::keep_plan(text, plan).to_string()
}

/// The positions of both vehicles at these times (a list of seconds since the impact, negative before it) or,
/// for an empty text, at equal intervals from one second before the impact to rest.
///
/// `{ ok: true, duration, frames: [{ time, bodies: [{ outline, centre, heading }] }] }`, or `{ ok: false,
/// problems, message }`; places are those of `scene` with `motion`.
#[wasm_bindgen]
#[must_use]
pub fn motion(text: &str, units: &str, times: &str) -> String {
    picture::motion(text, units, times).to_string()
}

/// The HTML report to hand over, byte for byte that of the program: `{ ok: true, html }`, or `{ ok: false,
/// problems, message }`. `command` is `reconstruct`, `impact`, `motion`, `crush` or empty, or `compare` or
/// `sensitivity`; `plan` is the picture that `site_plan` of the case names, if the motion is to be drawn on
/// it.
#[wasm_bindgen]
#[must_use]
pub fn report(text: &str, name: &str, command: &str, units: &str, plan: Option<Vec<u8>>) -> String {
    answer::report(text, name, command, units, plan).to_string()
}

/// Gives a key a value of TOML, or removes the key if the value is empty; comments are kept: `{ ok: true,
/// text, from, to }`, or `{ ok: false, message }`.
#[wasm_bindgen]
#[must_use]
pub fn edit(text: &str, key: &str, value: &str) -> String {
    edit::edit(text, key, value).to_string()
}

/// The text with a recorder's table in it, as copied out of a printed report; `key` is `pre_crash` or `pulse`
/// of a table `[vehicleN.recorder]`: `{ ok: true, text }`, or `{ ok: false, problems, message }`.
#[wasm_bindgen]
#[must_use]
pub fn paste(text: &str, key: &str, table: &str) -> String {
    edit::paste(text, key, table).to_string()
}

/// A quantity in another unit: `"10 mph"` in `km/h` is `{ ok: true, text: "16.09344 km/h" }`; else `{ ok:
/// false, message }`.
#[wasm_bindgen]
#[must_use]
pub fn convert(text: &str, unit: &str) -> String {
    edit::convert(text, unit).to_string()
}

/// The report of [`report()`] put into the page `deltav.html`, whose text is `page`: `{ ok: true, html }`, or
/// `{ ok: false, problems, message }`.
#[wasm_bindgen]
#[must_use]
pub fn live(page: &str, text: &str, name: &str, command: &str, units: &str, plan: Option<Vec<u8>>) -> String {
    answer::live(page, text, name, command, units, plan).to_string()
}

/// The commands that take long, for a worker. `progress` is called with the name of what is counted, the
/// number done and the total; if it returns `false`, the run ends: an uncertainty with the samples that it
/// has, an estimate without an answer.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Run {
    ran: Option<run::Ran>,
}

#[wasm_bindgen]
impl Run {
    /// A run that has nothing yet.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Runs a command; each of its `options` may be left out:
    ///
    /// - `uncertainty` propagates the ranges of the case: `{ samples, seed, method: "monte-carlo" |
    ///   "latin-hypercube" | "sobol", indices }`;
    /// - `estimate` finds the speeds from all evidence: `{ particles, seed, prior: "field" |
    ///   "serious-injury" | "flat", pieces, above: [question] }`;
    /// - `reconstruct` finds an exact solution. If the case has more evidence than that uses, it weighs all
    ///   of it; else, if the case has ranges, it finds the intervals with the errors of the method, which `{
    ///   method: false }` leaves out, as they take as long as the first;
    /// - `avoid` asks whether the collision was avoidable: `{ samples, seed, exact }`. Its answer has
    ///   `charts` as well, and `sliders`, `[{ key, unit, value, least, most, step }]` in the units of the
    ///   case;
    /// - every command that [`answer()`] takes.
    ///
    /// `{ ok: true, converged, headline, html }`, or `{ ok: false, problems, message }`. The rest is made
    /// when it is asked for: [`pictures`](Self::pictures), [`html`](Self::html), [`text`](Self::text),
    /// [`json`](Self::json), [`samples`](Self::samples).
    pub fn ask(
        &mut self,
        command: &str,
        text: &str,
        name: &str,
        units: &str,
        options: &str,
        progress: &js_sys::Function,
    ) -> String {
        self.ran = None;
        match run::run(command, [text, name, units, options], &mut run::told(progress)) {
            Ok(ran) => self.ran.insert(ran).answer(),
            Err(refused) => refused.json(),
        }
        .to_string()
    }

    /// The last run in other units: what [`ask`](Self::ask) answers in these, without running again.
    pub fn in_units(&mut self, units: &str) -> String {
        let told = self.ran.as_mut().map(|ran| ran.in_units(units));
        given::made(told.unwrap_or_else(Self::no_run)).to_string()
    }

    /// The last run, an avoidability, with its sliders moved to `{ key: value }`: `{ ok: true, text,
    /// headline, html, charts }`, or `{ ok: false, problems, message }`. `text` is the case that has these
    /// numbers. A speed that follows from the rest of the case is not computed again; a probability is only
    /// found if it is `sampled`.
    #[must_use]
    pub fn moved(&self, to: &str, sampled: bool) -> String {
        self.made(|ran| ran.moved(to, sampled))
    }

    /// The pictures of the last run: `[{ name, output, title, svg }]`; none for an estimate that has not
    /// converged, the plain ones for a reconstruction.
    #[must_use]
    pub fn pictures(&self) -> String {
        serde_json::Value::from(self.of(run::Ran::pictures)).to_string()
    }

    /// The last run as a page of its own, byte for byte the HTML of the program: `{ ok: true, html }`, or `{
    /// ok: false, problems, message }`. `plan` is that of [`report()`].
    #[must_use]
    pub fn html(&self, plan: Option<Vec<u8>>) -> String {
        self.handed_over(|ran| ran.html(plan))
    }

    /// The same, put into the page `deltav.html`, whose text is `page`; answers as [`html`](Self::html).
    #[must_use]
    pub fn live(&self, page: &str, plan: Option<Vec<u8>>) -> String {
        self.handed_over(|ran| ran.live(page, plan))
    }

    /// The last run as text, as the program prints it.
    #[must_use]
    pub fn text(&self) -> String {
        self.of(run::Ran::text)
    }

    /// The last run as JSON, byte for byte that of the program.
    ///
    /// # Errors
    /// It cannot be written, which no run is known to cause.
    pub fn json(&self) -> Result<String, JsError> {
        Ok(self.ran.as_ref().map(run::Ran::json).transpose()?.unwrap_or_default())
    }

    /// The samples or draws of the last run as CSV, as `--samples-out` writes them; empty if there are none.
    #[must_use]
    pub fn samples(&self) -> String {
        self.of(run::Ran::csv)
    }
}

impl Run {
    fn handed_over(&self, make: impl FnOnce(&run::Ran) -> Result<String, given::Refused>) -> String {
        self.made(|ran| Ok(serde_json::json!({ "ok": true, "html": make(ran)? })))
    }

    fn made(&self, make: impl FnOnce(&run::Ran) -> Result<serde_json::Value, given::Refused>) -> String {
        let made = self.ran.as_ref().map(make);
        given::made(made.unwrap_or_else(Self::no_run)).to_string()
    }

    fn no_run() -> Result<serde_json::Value, given::Refused> {
        Err(given::Refused::message("there is no run yet"))
    }

    /// An empty value if there is no run.
    fn of<T: Default>(&self, said: impl FnOnce(&run::Ran) -> T) -> T {
        self.ran.as_ref().map(said).unwrap_or_default()
    }
}
