//! Reads a case: from TOML to a spanned tree, and from the tree to a [`Case`], collecting every problem.

mod after;
mod avoid;
mod impact;
mod range;
mod recorder;
mod scene;
mod tree;
mod uncertainty;
mod values;
mod vehicle;

use toml::de::DeTable;

use crate::case_problem::CaseProblem;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::node::Entries;
use crate::other_files;
use crate::program::Program;
use crate::quantity::shorten;
use crate::schema::{MOST_RANGES, TOP};
use crate::source::{Source, Spans};
use crate::value::ValueTable;
use inputs::{
    Basis, Case, Departures, ENERGY_BASES, FaultKind, Faults, Find, GivenUncertainty, LeftOut, Purpose,
    Reconstruct, ReportHead, UNKNOWNS, contradictions, uncertain_speeds,
};
use tree::{Reader, Table};

/// A case and the text that it came from.
#[derive(Clone, Debug)]
pub struct CaseFile {
    /// The case in the file.
    pub case: Case,
    /// The file, to place faults that only an analysis finds.
    pub source: Source,
}

impl CaseFile {
    /// (bytes) the largest file that is read: a case is a page of text, and two profiles of 10,000 stations
    /// fill a quarter of this. A text that is wrong at every byte costs the TOML parser 200 times its size in
    /// memory, which this bounds.
    pub const LARGEST_FILE: usize = 1_000_000;

    /// Reads the text of a case file; `name` is its name in errors.
    ///
    /// ```
    /// let file = case::CaseFile::parse("barrier.toml", r#"
    ///     [vehicle1]
    ///     mass  = "1676 kg"
    ///     speed = "35 mph"
    ///     [vehicle2]
    ///     fixed = true
    /// "#)?;
    /// assert!(file.case.vehicles[1].fixed);
    ///
    /// let error = case::CaseFile::parse("barrier.toml", "[vehicle1]\nspeed = 35\n[vehicle2]\nfixed = true").unwrap_err();
    /// assert!(error.to_string().contains("barrier.toml:2:9"));
    /// # Ok::<(), case::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// All problems of the file at once: see [`CaseProblem`] for the kinds.
    pub fn parse(name: &str, text: &str) -> Result<Self, Diagnostics> {
        Self::parse_bytes(name, text.as_bytes())
    }

    /// Like [`parse`](Self::parse), but for the bytes of a file, which may not be text. A file longer than
    /// [`LARGEST_FILE`](Self::LARGEST_FILE) is refused.
    ///
    /// # Errors
    ///
    /// As for [`parse`](Self::parse); for a file of another format, an error that names the format.
    pub fn parse_bytes(name: &str, bytes: &[u8]) -> Result<Self, Diagnostics> {
        let text = text_of(name, bytes)?;
        let (document, errors) = DeTable::parse_recoverable(text);
        let document = Entries::of_toml(document.into_inner());
        let (case, spans, problems) = read(text, &document, &errors);
        Self::of(case, Source::new(name, text, spans), problems)
    }

    /// Reads a case from values, by the same rules as from a file. Problems are located by key, as there are
    /// no lines.
    ///
    /// ```
    /// use case::{CaseFile, Dimension, Value, ValueTable};
    ///
    /// let mph = Dimension::Speed.unit("mph").ok_or("a unit of speed")?;
    /// let mut car = ValueTable::new();
    /// car.insert("mass", Value::Text("1676 kg".into()));
    /// car.insert("speed", Value::Quantity(35.0, mph));
    /// let mut barrier = ValueTable::new();
    /// barrier.insert("fixed", Value::Flag(true));
    /// let mut case = ValueTable::new();
    /// case.insert("vehicle1", Value::Table(car.clone()));
    /// case.insert("vehicle2", Value::Table(barrier));
    /// let file = CaseFile::from_values("row 1", &case)?;
    /// assert!(file.case.inputs().iter().any(|input| input.path == "vehicle1.speed" && input.number == 35.0));
    ///
    /// car.insert("speed", Value::Text("35 feets".into()));
    /// case.insert("vehicle1", Value::Table(car));
    /// let error = CaseFile::from_values("row 1", &case).unwrap_err();
    /// assert_eq!(error.one_line(), "vehicle1.speed: \"35 feets\" has an unknown unit \"feets\"");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`parse`](Self::parse).
    pub fn from_values(name: &str, values: &ValueTable<'_>) -> Result<Self, Diagnostics> {
        let (case, spans, problems) = read("", &Entries::of_values(values), &[]);
        Self::of(case, Source::of_values(name, spans), problems)
    }

    fn of(case: Option<Case>, source: Source, problems: Vec<Diagnostic>) -> Result<Self, Diagnostics> {
        match case {
            Some(case) if problems.is_empty() => Ok(Self { case, source }),
            _ => Err(Diagnostics::new(source, problems)),
        }
    }

    /// Reads a part of a case, which values complete before [`from_values`](Self::from_values) reads the
    /// whole. Missing keys and keys that do not fit together are reported then.
    ///
    /// ```
    /// let part = case::CaseFile::part("template.toml", "[impact]\nrestitution = 0.1")?;
    /// assert!(part.get("impact").is_some());
    /// let error = case::CaseFile::part("template.toml", "[impact]\nrestitution = 1.1").unwrap_err();
    /// assert!(error.to_string().contains("template.toml:2:15"));
    /// # Ok::<(), case::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Problems whatever else the case has: invalid TOML, unknown keys, and values that a key cannot have.
    pub fn part(name: &str, text: &str) -> Result<ValueTable<'static>, Diagnostics> {
        let text = text_of(name, text.as_bytes())?;
        let (document, errors) = DeTable::parse_recoverable(text);
        let document = Entries::of_toml(document.into_inner());
        let (_, spans, problems) = read(text, &document, &errors);
        let is_of_whole = |problem: &CaseProblem| errors.is_empty() && problem.is_of_whole();
        let problems: Vec<_> = problems.into_iter().filter(|one| !is_of_whole(one.problem())).collect();
        if problems.is_empty() {
            Ok(document.values(&TOP))
        } else {
            Err(Diagnostics::new(Source::new(name, text, spans), problems))
        }
    }

    /// Places the faults of the case in the file: each at its key or, if the key is absent, at the nearest
    /// table around it. The messages use the names of a program, and the examples the units of the file.
    ///
    /// ```
    /// use case::{CaseFile, Program};
    ///
    /// let file = CaseFile::parse("car.toml", "[vehicle1]\nheading = \"0 deg\"\n[vehicle2]\nfixed = true")?;
    /// let faults = file.case.collision().unwrap_err();
    /// let errors = file.diagnostics(&faults, &Program::NONE).to_string();
    /// assert!(errors.contains("`vehicle1.weight` is missing: `impact` needs it"));
    /// assert!(errors.contains("car.toml:1:1"));
    /// # Ok::<(), case::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn diagnostics(&self, faults: &Faults, program: &'static Program) -> Diagnostics {
        let placed = faults.list().iter().map(|fault| {
            let problem = CaseProblem::Fault {
                message: fault.message(program.name),
                help: fault.advice.as_ref().map(|advice| match fault.kind {
                    // This advice quotes the file itself.
                    FaultKind::NothingUncertain => advice.clone(),
                    _ => {
                        let advice = self.source.units_in_use().suited(&fault.key, advice);
                        let estimate = (program.name)(Purpose::Estimate);
                        if fault.lacks_departure() {
                            return format!(
                                "{advice}; if that is not known, {estimate} finds the speeds from all evidence"
                            );
                        }
                        if !fault.lacks_speed() {
                            return advice;
                        }
                        let explains = program
                            .explains_two_speeds
                            .map(|explains| format!("; {explains} says more"))
                            .unwrap_or_default();
                        format!(
                            "{advice}; if neither speed is known, {estimate} finds both from all evidence{explains}"
                        )
                    }
                }),
            };
            Diagnostic::new(self.source.nearest_span(&fault.key), problem).about(&fault.key)
        });
        Diagnostics::new(self.source.clone(), placed.collect()).in_words_of(program)
    }
}

impl<'t> Reader<'t> {
    fn case(&mut self, document: &'t Entries<'t>) -> Option<Case> {
        let top = self.document(document, &TOP);
        let title = self.text(&top, "title");
        let source = self.text(&top, "source");
        let report = self.child(&top, "report");
        let report = report.map_or_else(ReportHead::default, |table| self.report_head(&table));
        let scene = self.child(&top, "scene");
        let axes = scene.as_ref().and_then(|scene| self.axes(scene)).unwrap_or_default();
        let scene_contact = scene.as_ref().map_or(Some(None), |scene| self.scene_contact(scene));
        let locked_together = scene.as_ref().is_some_and(|scene| self.flag(scene, "locked_together"));
        let site_plan = scene.as_ref().map_or(Some(None), |scene| self.site_plan(scene));
        let surface = self.child(&top, "surface").map(|table| self.surface(&table));
        // Its keys are looked up in the contents of all other tables.
        let uncertainty = self.child(&top, "uncertainty");
        let first = self.vehicle(&top, "vehicle1");
        let second = self.vehicle(&top, "vehicle2");
        let impact = self.child(&top, "impact").map(|table| self.impact(&table));
        let reconstruct = self.child(&top, "reconstruct").map(|table| self.reconstruct(&table));

        let estimate = self.child(&top, "estimate").map(|table| self.estimate(&table));
        let avoid = self.child(&top, "avoid").map(|table| self.avoid(&table));

        let vehicles = [first?, second?];
        let find = reconstruct.flatten().map(|reconstruct| reconstruct.find);
        for fault in contradictions(&vehicles, find).into_iter().chain(uncertain_speeds(&vehicles, find)) {
            let problem =
                CaseProblem::Fault { message: fault.message(Program::NONE.name), help: fault.advice };
            self.report_path(&fault.key, problem);
        }
        let (impact, reconstruct) = (optional(impact)?, optional(reconstruct)?);
        let (scene_contact, site_plan, surface) = (scene_contact?, site_plan?, optional(surface)?);
        let left_out = LeftOut {
            axes: !self.says("scene.axes"),
            law: impact.is_some() && !self.says("impact.law"),
            energy_basis: reconstruct.is_some() && !self.says("reconstruct.energy_basis"),
            fit: ["vehicle1", "vehicle2"].map(|vehicle| {
                let test = format!("{vehicle}.crush.stiffness.test");
                self.says(&test) && !self.says(&format!("{test}.fit"))
            }),
        };
        let mut case = Case {
            title,
            source,
            report,
            axes,
            scene_contact,
            site_plan,
            locked_together,
            surface,
            vehicles,
            impact,
            reconstruct,
            estimate,
            avoid,
            ranges: Vec::new(),
            departures: Departures::default(),
            uncertainty: GivenUncertainty::default(),
            left_out,
        };
        case.ranges = self.take_ranges(&case);
        if let Some(first_too_many) = case.ranges.get(MOST_RANGES) {
            let problem = CaseProblem::TooManyRanges { count: case.ranges.len(), limit: MOST_RANGES };
            self.report_path(&first_too_many.path, problem);
        }
        if let Some(table) = uncertainty {
            case.uncertainty = self.uncertainty(&table, &case)?;
        }
        Some(case)
    }

    fn report_head(&mut self, table: &Table<'t>) -> ReportHead {
        let [analyst, date, file_number, exhibit] =
            ["analyst", "date", "file_number", "exhibit"].map(|key| self.text(table, key));
        ReportHead { analyst, date, file_number, exhibit }
    }

    fn reconstruct(&mut self, table: &Table<'t>) -> Option<Reconstruct> {
        self.require(table, &["find"]);
        let find = self.find(table);
        let energy_basis = self.energy_basis(table);
        Some(Reconstruct { find: find?, energy_basis: energy_basis.unwrap_or_default() })
    }

    /// A word, or the share of the tangential work; the default if neither is there.
    fn energy_basis(&mut self, table: &Table<'t>) -> Option<Basis> {
        const FORMS: &str = "energy_basis = \"dissipated\", \"absorbed\" or { tangential_share = 0.5 }";
        if !table.has("energy_basis") {
            return Some(Basis::default());
        }
        if table.is_string("energy_basis") {
            let value = table.get("energy_basis")?;
            if let Some(word) = value.get_ref().as_str().filter(|word| is_neades(word)) {
                let path = table.path_of("energy_basis");
                return self.unread(value, CaseProblem::NeadesBasis { path, word: shorten(word) });
            }
            return self.choice_among(table, "energy_basis", &ENERGY_BASES, FORMS);
        }
        let share = self.inline_or(table, "energy_basis", "a word or a table in braces", FORMS)?;
        match share.given(&["tangential_share"])[..] {
            [_] => self.number(&share, "tangential_share").map(Basis::TangentialShare),
            _ => self.no_form(&share, FORMS),
        }
    }

    /// One speed, or a list of both.
    fn find(&mut self, table: &Table<'t>) -> Option<Find> {
        const FORMS: &str =
            "\"vehicle1.speed\", \"vehicle2.speed\" or, for both, [\"vehicle1.speed\", \"vehicle2.speed\"]";
        let value = table.get("find")?;
        let Some(list) = value.get_ref().as_array() else {
            return self.choice_among(table, "find", &UNKNOWNS, FORMS).map(Find::One);
        };
        let words: Vec<Option<&str>> = list.iter().map(|word| word.get_ref().as_str()).collect();
        let is_both =
            words.len() == UNKNOWNS.len() && UNKNOWNS.iter().all(|(name, _)| words.contains(&Some(*name)));
        if is_both {
            return Some(Find::Both);
        }
        let message = format!("\"{}\" is a list, but not of both speeds", table.path_of("find"));
        self.refuse(&table.path_of("find"), message, &format!("write find = {FORMS}"))
    }
}

/// The text of a file; an error here concerns the file as a whole.
fn text_of<'t>(name: &str, bytes: &'t [u8]) -> Result<&'t str, Diagnostics> {
    other_files::text(bytes, CaseFile::LARGEST_FILE).map_err(|problem| {
        let source = Source::new(name, "", Spans::default());
        Diagnostics::new(source, vec![Diagnostic::new(None, problem)])
    })
}

/// The case of a document, the places of its keys, and its problems.
fn read(
    text: &str,
    document: &Entries<'_>,
    errors: &[toml::de::Error],
) -> (Option<Case>, Spans, Vec<Diagnostic>) {
    let mut reader = Reader::new(text, document);
    let case = reader.case(document);
    let (spans, problems) = reader.finish(errors);
    (case, spans, problems)
}

/// Whether a word asks for Neades' factor.
fn is_neades(word: &str) -> bool {
    word.to_ascii_lowercase().contains("neades")
}

/// A part that is present must be valid; an absent part is not a fault.
fn optional<T>(part: Option<Option<T>>) -> Option<Option<T>> {
    match part {
        Some(None) => None,
        Some(sound) => Some(sound),
        None => Some(None),
    }
}
