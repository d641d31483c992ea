//! Reading a case: TOML to a spanned tree, and the tree to a [`Case`], with every problem on the way.

mod impact;
mod range;
mod tree;
mod values;
mod vehicle;

use toml::de::DeTable;

use crate::axes::Axes;
use crate::case::{Case, Reconstruct, Vehicle};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::foreign;
use crate::problem::Problem;
use crate::quantity::Quantity;
use crate::schema::{IMPACT, MOST_RANGES, RECONSTRUCT, SCENE, TOP};
use crate::source::{Source, Spans};
use crash3::EnergyBasis;
use reconcile::Unknown;
use tree::{Reader, Table};

/// A case and the text it came from.
#[derive(Clone, Debug)]
pub struct CaseFile {
    /// What the file says.
    pub case: Case,
    /// The file, for problems that show only in a computation.
    pub source: Source,
}

impl CaseFile {
    /// A problem with a well-formed case, placed at a key such as `"vehicle1.crush.width"` or a table such as
    /// `"vehicle1"`; where that is absent, at the nearest table around it.
    #[must_use]
    pub fn problem(&self, path: &str, message: impl Into<String>, help: Option<String>) -> Diagnostic {
        Diagnostic::new(self.source.nearest_span(path), Problem::CrossCheck { message: message.into(), help })
    }

    /// A problem with the case as a whole.
    #[must_use]
    pub fn refusal(&self, message: impl Into<String>, help: Option<String>) -> Diagnostics {
        let problem = Problem::CrossCheck { message: message.into(), help };
        Diagnostics::new(self.source.clone(), vec![Diagnostic::new(None, problem)])
    }

    /// Ends a round of such checks.
    ///
    /// # Errors
    ///
    /// The problems, if there are any.
    pub fn accept(&self, problems: Vec<Diagnostic>) -> Result<(), Diagnostics> {
        if problems.is_empty() { Ok(()) } else { Err(Diagnostics::new(self.source.clone(), problems)) }
    }
}

impl Case {
    /// (bytes) the largest file that is read: a case is a page of text, and two profiles of 10,000 stations fill a quarter of this. A text
    /// that is wrong at every byte costs the TOML parser 200 times its size in memory, which this bounds.
    pub const LARGEST_FILE: usize = 1_000_000;

    /// Reads the text of a case file; `name` is what errors call it.
    ///
    /// ```
    /// let file = case::Case::parse("barrier.toml", r#"
    ///     [vehicle1]
    ///     mass  = "1676 kg"
    ///     speed = "35 mph"
    ///     [vehicle2]
    ///     fixed = true
    /// "#)?;
    /// assert!(file.case.vehicles[1].fixed);
    ///
    /// let error = case::Case::parse("barrier.toml", "[vehicle1]\nspeed = 35\n[vehicle2]\nfixed = true").unwrap_err();
    /// assert!(error.to_string().contains("barrier.toml:2:9"));
    /// # Ok::<(), case::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// All problems of the file at once: see [`Problem`] for the kinds.
    pub fn parse(name: &str, text: &str) -> Result<CaseFile, Diagnostics> {
        Self::parse_bytes(name, text.as_bytes())
    }

    /// The same of the bytes of a file, which may turn out to be no text at all. One that is cut off behind [`LARGEST_FILE`](Self::LARGEST_FILE) is refused for
    /// its length.
    ///
    /// # Errors
    ///
    /// As [`parse`](Self::parse); of a file of another kind, one that says which.
    pub fn parse_bytes(name: &str, bytes: &[u8]) -> Result<CaseFile, Diagnostics> {
        let text = foreign::text(bytes, Self::LARGEST_FILE).map_err(|problem| {
            let source = Source::new(name, "", Spans::default());
            Diagnostics::new(source, vec![Diagnostic::new(None, problem)])
        })?;
        let (document, errors) = DeTable::parse_recoverable(text);
        let mut reader = Reader::new(text, document.get_ref());
        let case = reader.case(document.get_ref());
        let (spans, problems) = reader.finish(&errors);
        let source = Source::new(name, text, spans);
        match case {
            Some(case) if problems.is_empty() => Ok(CaseFile { case, source }),
            _ => Err(Diagnostics::new(source, problems)),
        }
    }
}

impl<'t> Reader<'t> {
    fn case(&mut self, document: &'t DeTable<'t>) -> Option<Case> {
        let top = self.document(document, &TOP);
        let title = self.text(&top, "title");
        let source = self.text(&top, "source");
        let axes = self.child(&top, "scene", &SCENE).and_then(|scene| self.axes(&scene)).unwrap_or_default();
        let first = self.vehicle(&top, "vehicle1");
        let second = self.vehicle(&top, "vehicle2");
        let impact = self.child(&top, "impact", &IMPACT).map(|table| self.impact(&table));
        let reconstruct = self.child(&top, "reconstruct", &RECONSTRUCT).map(|table| self.reconstruct(&table));

        let vehicles = [first?, second?];
        if let [Vehicle { fixed: true, .. }, Vehicle { fixed: true, .. }] = vehicles {
            self.report_path("vehicle2.fixed", Problem::BothFixed);
        } else if let Some(Some(Reconstruct { find, .. })) = reconstruct {
            let (vehicle, other, name) = match find {
                Unknown::Speed1 => (&vehicles[0], "vehicle2", "vehicle1"),
                Unknown::Speed2 => (&vehicles[1], "vehicle1", "vehicle2"),
            };
            if vehicle.fixed {
                self.report_path("reconstruct.find", Problem::FindsFixed { vehicle: name, other });
            }
        }
        self.evidence(&vehicles);
        let (impact, reconstruct) = (optional(impact)?, optional(reconstruct)?);
        let mut case = Case { title, source, axes, vehicles, impact, reconstruct, ranges: Vec::new() };
        case.ranges = case.inputs().iter().filter_map(|input| self.take_range(&input.path)).collect();
        if let Some(first_too_many) = case.ranges.get(MOST_RANGES) {
            let problem = Problem::TooManyRanges { count: case.ranges.len(), limit: MOST_RANGES };
            self.report_path(&first_too_many.path, problem);
        }
        Some(case)
    }

    fn axes(&mut self, scene: &Table<'t>) -> Option<Axes> {
        const FORMS: &str = "\"z-up\", with y to the left and angles counter-clockwise positive, or \"z-down\", those of SAE J670, with y to the right \
                             and angles clockwise positive";
        self.choice_among(scene, "axes", &Axes::ALL.map(|axes| (axes.name(), axes)), FORMS)
    }

    /// A crush that is inferred needs one that was measured.
    fn evidence(&mut self, vehicles: &[Vehicle; 2]) {
        let inferred = vehicles.each_ref().map(|v| v.crush.as_ref().is_some_and(|c| c.from_force_balance));
        let problem = |i: usize| {
            let names = ["vehicle1", "vehicle2"];
            Problem::NothingMeasured { vehicle: names[i], other: names[1 - i] }
        };
        match inferred {
            [true, true] => self.report_path("vehicle2.crush.from_force_balance", Problem::BothInferred),
            [true, false] if vehicles[1].crush.is_none() => {
                self.report_path("vehicle1.crush.from_force_balance", problem(0));
            }
            [false, true] if vehicles[0].crush.is_none() => {
                self.report_path("vehicle2.crush.from_force_balance", problem(1));
            }
            _ => {}
        }
    }

    fn reconstruct(&mut self, table: &Table<'t>) -> Option<Reconstruct> {
        self.require(table, &["find"]);
        let find = self.choice(
            table,
            "find",
            &[("vehicle1.speed", Unknown::Speed1), ("vehicle2.speed", Unknown::Speed2)],
        );
        let choices = [("dissipated", EnergyBasis::Dissipated), ("absorbed", EnergyBasis::Absorbed)];
        let energy_basis = self.choice(table, "energy_basis", &choices);
        Some(Reconstruct { find: find?, energy_basis: energy_basis.unwrap_or_default() })
    }
}

/// A part that is there has to be sound; one that is not there is no fault.
fn optional<T>(part: Option<Option<T>>) -> Option<Option<T>> {
    match part {
        Some(None) => None,
        Some(sound) => Some(sound),
        None => Some(None),
    }
}

/// Whether two quantities of one dimension differ by more than the share `tolerance` of the first.
fn differ(first: &Quantity, second_si: f64, tolerance: f64) -> bool {
    (first.si() - second_si).abs() > tolerance * first.si()
}
