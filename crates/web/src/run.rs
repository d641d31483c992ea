//! What takes long: uncertainty, estimate, and a reconstruction with what its report has beside it.

use std::cell::RefCell;
use std::ops::ControlFlow;

use analysis::{Analysis, EstimatePlan, EstimateStage, Estimated, Plan, Stage, Uncertainty, Weighed};
use case::Prior;
use js_sys::Function;
use report::{Asked, CsvStyle, Document, Drawing, Question, Subject};
use serde_json::{Value, json};
use uncertainty::{SamplingMethod, Settings};
use wasm_bindgen::JsValue;

use crate::answer::{self, Known};
use crate::given::{Given, Refused};
use crate::picture;

/// Is told what is counted, how many are done and how many there are; whether to go on.
pub(crate) type Progress<'a> = dyn FnMut(&str, usize, usize) -> bool + Send + 'a;

thread_local! {
    /// The function of the page that is told how far a run is: it cannot leave its thread, which the engine
    /// wants of whom it tells.
    static TOLD: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// Tells a function of the page.
pub(crate) fn told(progress: &Function) -> impl FnMut(&str, usize, usize) -> bool + Send + use<> {
    TOLD.with(|told| told.replace(Some(progress.clone())));
    |counted, done, total| {
        let count = |n: usize| JsValue::from(u32::try_from(n).unwrap_or(u32::MAX));
        let progress = TOLD.with(|told| told.borrow().clone());
        let told =
            progress.map(|told| told.call3(&JsValue::NULL, &counted.into(), &count(done), &count(total)));
        // A function that fails does not end the run.
        told.and_then(Result::ok).and_then(|answer| answer.as_bool()).unwrap_or(true)
    }
}

fn flow(goes_on: bool) -> ControlFlow<()> {
    if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
}

/// What was asked for besides the case.
pub(crate) struct Options(Value);

impl Options {
    fn read(text: &str) -> Result<Self, Refused> {
        let read = if text.is_empty() { Ok(json!({})) } else { serde_json::from_str(text) };
        match read {
            Ok(Value::Object(options)) => Ok(Self(Value::Object(options))),
            _ => Err(Refused::message("the options are empty, or an object")),
        }
    }

    fn count(&self, name: &str) -> Result<Option<u64>, Refused> {
        let number = |value: &Value| {
            value
                .as_u64()
                .ok_or_else(|| Refused::message(format!("the option {name} is a whole number, not {value}")))
        };
        self.0.get(name).filter(|value| !value.is_null()).map(number).transpose()
    }

    fn size(&self, name: &str) -> Result<Option<usize>, Refused> {
        let too_large = |_| Refused::message(format!("the option {name} is too large"));
        self.count(name)?.map(|count| usize::try_from(count).map_err(too_large)).transpose()
    }

    fn flag(&self, name: &str, default: bool) -> bool {
        self.0.get(name).and_then(Value::as_bool).unwrap_or(default)
    }

    fn word<T: Copy>(&self, name: &str, words: &[(&str, T)]) -> Result<Option<T>, Refused> {
        let Some(asked) = self.0.get(name).and_then(Value::as_str).filter(|word| !word.is_empty()) else {
            return Ok(None);
        };
        let found = words.iter().find(|(word, _)| *word == asked).map(|(_, value)| *value);
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let wrong = || {
            Refused::message(format!(
                "the option {name} is {}, not \"{}\"",
                known.join(" or "),
                case::shown(asked)
            ))
        };
        found.map(Some).ok_or_else(wrong)
    }
}

/// A run that has ended, and what it is of. Each thing that is said of it is made when it is asked for: the
/// pictures and the file for machines take a good part of the time that the samples take.
#[derive(Debug)]
pub(crate) struct Ran {
    given: Given,
    drawn: Drawn,
}

/// What has samples or draws.
#[derive(Debug)]
pub(crate) enum Drawn {
    Uncertainty(Box<Uncertainty>),
    Estimate(Box<Estimated>, Asked),
    Reconstruction(Box<Reconstruction>),
}

/// An exact solution, and what a report has beside it.
#[derive(Debug)]
pub(crate) struct Reconstruction {
    analysis: Analysis,
    /// All the evidence, where the case has more than its exact solution uses.
    weighed: Option<Weighed>,
    /// The intervals with the errors of the method, where the exact solution is the answer.
    estimated: Option<Estimated>,
}

impl Ran {
    fn document(&self) -> Document {
        let Given { file, units } = &self.given;
        match &self.drawn {
            Drawn::Uncertainty(one) => report::uncertainty(&file.case, one, *units),
            Drawn::Estimate(one, asked) => report::estimate(&file.case, one, asked, *units),
            Drawn::Reconstruction(one) => match &one.weighed {
                Some(weighed) => report::weighed(&file.case, &one.analysis, weighed, *units),
                None => report::results(&file.case, &one.analysis, *units),
            },
        }
    }

    /// What is handed over; of a reconstruction the report with all drawings, `plan` being the picture that
    /// the case names.
    fn handed_over(&self, plan: Option<Vec<u8>>) -> Result<Document, Refused> {
        let Drawn::Reconstruction(one) = &self.drawn else { return Ok(self.document()) };
        let known = Known { weighed: one.weighed.as_ref(), estimated: one.estimated.as_ref() };
        answer::handed_over(&self.given, &one.analysis, known, plan)
    }

    /// Draws that have not converged are no answer.
    fn has_converged(&self) -> bool {
        match &self.drawn {
            Drawn::Uncertainty(_) => true,
            Drawn::Estimate(one, _) => one.doubts().is_empty(),
            Drawn::Reconstruction(one) => one.weighed.as_ref().is_none_or(Weighed::is_answer),
        }
    }

    /// What is read first.
    pub(crate) fn answer(&self) -> Value {
        let document = self.document();
        let headline = match &self.drawn {
            Drawn::Uncertainty(one) => json!(report::uncertain_headline(one, self.given.units)),
            Drawn::Estimate(..) | Drawn::Reconstruction(_) => json!(document.headline()),
        };
        json!({
            "ok": true,
            "converged": self.has_converged(),
            "headline": headline,
            "html": document.html_fragment(),
        })
    }

    /// Of each output, or of the estimate.
    pub(crate) fn pictures(&self) -> Vec<Value> {
        let Given { file, units } = &self.given;
        match &self.drawn {
            Drawn::Uncertainty(one) => {
                let outputs = one.outputs.iter().enumerate();
                let drawings = outputs.flat_map(|(place, output)| {
                    let path = output.output.path();
                    let drawings = [
                        ("histogram", report::histogram(&file.case, one, place, *units)),
                        ("tornado", report::tornado(&file.case, one, place, *units)),
                    ];
                    drawings.map(|(name, drawing)| drawing.map(|drawing| picture(name, &path, &drawing)))
                });
                drawings.flatten().collect()
            }
            Drawn::Estimate(one, asked) => {
                let has_converged = self.has_converged();
                let drawings =
                    has_converged.then(|| report::estimate_pictures(&file.case, one, asked, *units));
                drawings.flatten().iter().map(|drawing| picture("estimate", "", drawing)).collect()
            }
            // The exact solution is drawn at once; what it lacks are the speeds by all the evidence.
            Drawn::Reconstruction(one) => {
                let plain = |(name, subject)| {
                    let drawing = picture::plain(&self.given, &one.analysis, one.weighed.as_ref(), subject);
                    drawing.ok().map(|drawing| {
                        json!({ "name": name, "output": "", "title": drawing.title(), "svg": drawing.svg_named(name) })
                    })
                };
                let subjects = [("plain-scene", Subject::Scene), ("plain-motion", Subject::Motion)];
                subjects.into_iter().filter_map(plain).collect()
            }
        }
    }

    /// As a page of its own.
    pub(crate) fn html(&self, plan: Option<Vec<u8>>) -> Result<String, Refused> {
        Ok(self.handed_over(plan)?.html())
    }

    /// That in the page `deltav.html`.
    pub(crate) fn live(&self, page: &str, plan: Option<Vec<u8>>) -> Result<String, Refused> {
        answer::alive(page, &self.handed_over(plan)?, &self.given)
    }

    /// As text.
    pub(crate) fn text(&self) -> String {
        self.document().text()
    }

    /// As JSON.
    pub(crate) fn json(&self) -> Result<String, serde_json::Error> {
        let Given { file, .. } = &self.given;
        match &self.drawn {
            Drawn::Uncertainty(one) => report::uncertainty_json(file, one),
            Drawn::Estimate(one, asked) => report::estimate_json(file, one, asked),
            Drawn::Reconstruction(one) => match &one.weighed {
                Some(weighed) => report::weighed_json(file, &one.analysis, weighed),
                None => report::json(file, &one.analysis),
            },
        }
    }

    /// The samples or draws as CSV; of draws that have not converged none.
    pub(crate) fn csv(&self) -> String {
        let mut bytes = Vec::new();
        let draws = match &self.drawn {
            Drawn::Uncertainty(_) => None,
            Drawn::Estimate(one, _) => Some(&**one),
            Drawn::Reconstruction(one) => one.weighed.as_ref().map(|weighed| &weighed.estimated),
        };
        let written = match (&self.drawn, draws) {
            (Drawn::Uncertainty(one), _) => report::write_samples(one, CsvStyle::International, &mut bytes),
            (_, Some(draws)) if self.has_converged() => {
                report::write_draws(draws, CsvStyle::International, &mut bytes)
            }
            _ => Ok(()),
        };
        // Nothing keeps a text from being written to the memory.
        written.ok().and_then(|()| String::from_utf8(bytes).ok()).unwrap_or_default()
    }
}

/// A command that takes long.
pub(crate) type Command = fn(&Given, &Options, &mut Progress<'_>) -> Result<Drawn, Refused>;

pub(crate) fn run(
    command: Command,
    text: &str,
    name: &str,
    units: &str,
    options: &str,
    progress: &mut Progress<'_>,
) -> Result<Ran, Refused> {
    let given = Given::read(text, Some(name), units)?;
    let drawn = command(&given, &Options::read(options)?, progress)?;
    Ok(Ran { given, drawn })
}

fn picture(name: &str, output: &str, drawing: &Drawing) -> Value {
    let id = format!("{name}-{}", output.replace('.', "-"));
    json!({ "name": name, "output": output, "title": drawing.title(), "svg": drawing.svg_named(&id) })
}

pub(crate) fn uncertainty(
    given: &Given,
    options: &Options,
    progress: &mut Progress<'_>,
) -> Result<Drawn, Refused> {
    let case = &given.file.case;
    let samples = options.size("samples")?.unwrap_or_else(|| analysis::usual_samples(case));
    let method = options.word("method", &SamplingMethod::WORDS)?.unwrap_or(SamplingMethod::MonteCarlo);
    let settings = Settings::new(method, samples, options.count("seed")?.unwrap_or(1));
    let plan = Plan { settings, index_rows: options.size("indices")? };
    let uncertainty = analysis::uncertainty(case, &plan, &mut |stage, done, total| {
        let counted = match stage {
            Stage::Samples => "samples",
            Stage::Indices => "rows for the indices",
        };
        flow(progress(counted, done, total))
    });
    Ok(Drawn::Uncertainty(Box::new(given.answered(uncertainty)?)))
}

pub(crate) fn estimate(
    given: &Given,
    options: &Options,
    progress: &mut Progress<'_>,
) -> Result<Drawn, Refused> {
    let case = &given.file.case;
    let outputs = given.answered(analysis::estimate_outputs(case))?;
    let above = options.0.get("above").and_then(Value::as_array).into_iter().flatten();
    let question = |text: &str| {
        let problem = |problem| Refused::message(format!("\"{}\": {problem}", case::shown(text.trim())));
        Question::read(text, &outputs).map_err(problem)
    };
    let questions =
        above.filter_map(Value::as_str).map(question).collect::<Result<Vec<Question>, Refused>>()?;
    let plan = EstimatePlan {
        particles: options.size("particles")?.unwrap_or(EstimatePlan::PARTICLES),
        seed: options.count("seed")?.unwrap_or(1),
        prior: options.word("prior", &Prior::WORDS)?,
        pieces: options.flag("pieces", true),
    };
    let estimated = analysis::estimate(case, &plan, &mut staged(progress));
    let estimated = given.answered(estimated)?;
    Ok(Drawn::Estimate(Box::new(estimated), Asked { plan, questions }))
}

/// Tells how far an estimate is.
fn staged<'a>(
    progress: &'a mut Progress<'_>,
) -> impl FnMut(EstimateStage, usize, usize) -> ControlFlow<()> + Send + 'a {
    |stage, done, total| {
        let counted = match stage {
            EstimateStage::All => "particles",
            EstimateStage::Prior => "particles before the evidence",
            EstimateStage::Piece => "pieces of evidence",
        };
        flow(progress(counted, done, total))
    }
}

/// As `deltav reconstruct` weighs: as an estimate without further options.
const WEIGHING: EstimatePlan =
    EstimatePlan { particles: EstimatePlan::PARTICLES, seed: 1, prior: None, pieces: false };

pub(crate) fn reconstruct(
    given: &Given,
    options: &Options,
    progress: &mut Progress<'_>,
) -> Result<Drawn, Refused> {
    let case = &given.file.case;
    let analysis = given.answered(analysis::reconstruct(case))?;
    let weighed = given.answered(analysis::weigh(case, &analysis, &WEIGHING, &mut staged(progress)))?;
    // Intervals by the ranges alone would be read as those of all.
    let is_completed = weighed.is_none() && options.flag("method", true) && analysis::is_uncertain(case);
    let estimated =
        if is_completed { analysis::estimate(case, &WEIGHING, &mut staged(progress)).ok() } else { None };
    Ok(Drawn::Reconstruction(Box::new(Reconstruction { analysis, weighed, estimated })))
}

#[cfg(test)]
mod tests {
    use case::{Template, UnitSystem};
    use serde_json::Value;

    use super::{Command, Ran, estimate, reconstruct, run, uncertainty};

    const NAME: &str = "case.toml";

    fn fixture(name: &str) -> String {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/");
        std::fs::read_to_string(format!("{root}{name}")).unwrap()
    }

    fn samples_of(ran: &Ran) -> Value {
        let data: Value = serde_json::from_str(&ran.json().unwrap()).unwrap();
        data["samples"].clone()
    }

    fn refused(command: Command, text: &str, options: &str, goes_on: bool) -> String {
        let refused = run(command, text, NAME, "", options, &mut |_, _, _| goes_on).unwrap_err().json();
        assert_eq!(refused["ok"], false, "{options}");
        refused["message"].as_str().unwrap().to_owned()
    }

    #[test]
    fn an_uncertainty_tells_how_far_it_is_and_ends_with_what_it_has() {
        let text = fixture("sae-980025-uncertain.toml");
        let options = "{\"samples\": 40000, \"seed\": 7}";
        let mut told = Vec::new();
        let whole = run(uncertainty, &text, NAME, "", options, &mut |counted, done, total| {
            told.push((counted.to_owned(), done, total));
            true
        });
        let whole = whole.unwrap();
        assert!(
            told.iter()
                .all(|(counted, done, total)| counted == "samples" && done <= total && *total == 40000)
        );
        assert!(told.len() > 2 && told.windows(2).all(|pair| pair[0].1 <= pair[1].1));
        assert_eq!(whole.csv().lines().count(), 40001);
        let answer = whole.answer();
        assert_eq!(answer["ok"], true, "{answer:#}");
        let headline = answer["headline"][0].as_str().unwrap();
        assert!(headline.contains("(95 %, by the ranges of the case alone)"), "{headline}");
        assert!(whole.pictures().len() > 1);
        let part = run(uncertainty, &text, NAME, "", options, &mut |_, done, _| done == 0).unwrap();
        let some = part.csv().lines().count() - 1;
        assert!(some > 0 && some < 40000, "{some}");
        assert_ne!(samples_of(&part), samples_of(&whole));
        let none = run(uncertainty, &text, NAME, "", options, &mut |_, _, _| false).unwrap();
        assert_eq!(none.answer()["ok"], true);
        assert_eq!(none.csv().lines().count(), 1);
    }

    #[test]
    fn an_estimate_ends_without_an_answer() {
        let text = fixture("estimate.toml");
        let message = refused(estimate, &text, "{\"particles\": 128, \"pieces\": false}", false);
        assert!(message.len() > 10, "{message}");
    }

    #[test]
    fn options_that_are_none_are_refused() {
        let text = fixture("sae-980025-uncertain.toml");
        for (options, expected) in [
            ("[]", "the options are"),
            ("{\"samples\": -1}", "samples is a whole number, not -1"),
            ("{\"samples\": \"many\"}", "not \"many\""),
            ("{\"method\": \"dice\"}", "monte-carlo or latin-hypercube or sobol, not \"dice\""),
        ] {
            let message = refused(uncertainty, &text, options, true);
            assert!(message.contains(expected), "{message}");
        }
        let message = refused(estimate, &fixture("estimate.toml"), "{\"above\": [\"x 1\"]}", true);
        assert!(message.contains("no result of this name"), "{message}");
    }
    #[test]
    fn a_case_with_more_evidence_is_weighed_and_another_one_is_not() {
        let over = Template::ALL.into_iter().find(|one| one.name() == "intersection").unwrap();
        let mut told = 0;
        let ran = run(reconstruct, over.text(UnitSystem::Si), NAME, "", "", &mut |_, _, _| {
            told += 1;
            true
        });
        let ran = ran.unwrap();
        assert!(told > 3, "{told}");
        let answer = ran.answer();
        let headline = answer["headline"][0].as_str().unwrap();
        assert!(headline.contains("95 %"), "{headline}");
        let said = &headline[..headline.find(" (95 %").unwrap()];
        let json: Value = serde_json::from_str(&ran.json().unwrap()).unwrap();
        assert_eq!(json["headline"]["by"], "estimate");
        for document in [ran.html(None).unwrap(), ran.text()] {
            assert!(document.contains(said), "{said}");
        }
        assert!(ran.csv().lines().count() > 1000);
        // Evidence that contradicts itself has no one answer, and no draws of one.
        let torn =
            run(reconstruct, &fixture("edcrash-tutorial.toml"), NAME, "", "", &mut |_, _, _| true).unwrap();
        let answer = torn.answer();
        assert_eq!(answer["converged"], false);
        assert!(answer["headline"][0].as_str().unwrap().starts_with("No collision"), "{answer:#}");
        assert_eq!(torn.csv(), "");
        let exact = run(reconstruct, &fixture("sae-980025.toml"), NAME, "", "", &mut |_, _, _| true).unwrap();
        assert_eq!(exact.csv(), "");
        let json: Value = serde_json::from_str(&exact.json().unwrap()).unwrap();
        assert_ne!(json["headline"]["by"], "estimate");
    }
}
