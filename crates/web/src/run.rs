//! The commands that take long: uncertainty, estimate, avoidability, and a reconstruction with the additions
//! of its report.

use std::cell::RefCell;
use std::ops::ControlFlow;

use js_sys::Function;
use report::{Document, Drawing, DrawingRequest, Subject};
use requests::{Answer, Request, RequestOptions};
use serde_json::{Value, json};
use wasm_bindgen::JsValue;

use crate::answer;
use crate::given::{Given, Refused};
use crate::slide;

/// Receives the name of what is counted, the number done and the total; returns whether to continue.
pub(crate) type Progress<'a> = dyn FnMut(&str, usize, usize) -> bool + Send + 'a;

thread_local! {
    /// The function of the page that receives the progress of a run. It cannot leave its thread, although the
    /// engine requires that of a receiver.
    static TOLD: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// Passes progress on to a function of the page.
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

/// A finished run, and its request. Each output is made only when it is requested: the pictures and the file
/// for machines take a good part of the time that the samples take.
#[derive(Debug)]
pub(crate) struct Ran {
    given: Given,
    answer: Answer,
}

impl Ran {
    fn document(&self) -> Document {
        self.answer.document(&self.given.file, self.given.units)
    }

    /// The part that is read first.
    pub(crate) fn answer(&self) -> Value {
        let document = self.document();
        let mut answer = json!({
            "ok": true,
            "converged": self.answer.no_answer().is_none(),
            "headline": self.answer.headline(&document, self.given.units),
            "html": document.html_fragment(),
        });
        if let Answer::Avoidance(found) = &self.answer {
            answer["charts"] = json!(answer::charts(&document));
            answer["sliders"] = json!(slide::sliders(&self.given.file, found));
        }
        answer
    }

    /// The same run in other units. Nothing is computed anew: a run is in SI.
    pub(crate) fn in_units(&mut self, units: &str) -> Result<Value, Refused> {
        self.given.set_units(units)?;
        Ok(self.answer())
    }

    /// An avoidability with its sliders moved.
    pub(crate) fn moved(&self, to: &str, sampled: bool) -> Result<Value, Refused> {
        match &self.answer {
            Answer::Avoidance(found) => slide::moved(&self.given, found, to, sampled),
            _ => Err(Refused::message("only an avoidability has sliders")),
        }
    }

    /// The pictures of each output, or of the estimate.
    pub(crate) fn pictures(&self) -> Vec<Value> {
        let Given { file, units } = &self.given;
        match &self.answer {
            Answer::Uncertainty(one) => {
                let plots = requests::plots(&file.case, one, *units);
                plots.map(|(name, output, drawing)| picture(name, &output, &drawing)).collect()
            }
            Answer::Estimate(one) if self.answer.no_answer().is_none() => {
                let drawing = report::estimate_pictures(&file.case, &one.estimated, &one.asked, *units);
                drawing.iter().map(|drawing| picture("estimate", "", drawing)).collect()
            }
            // The exact solution is drawn at once; only the speeds by all the evidence are missing.
            Answer::Analysis(one) => {
                let plain = |(name, subject)| {
                    let request = DrawingRequest { subject, plain: true };
                    let drawing =
                        request.draw(file, &one.analysis, one.weighed.as_ref(), *units, None).ok()?;
                    let (title, svg) = (drawing.title(), drawing.svg_named(name));
                    Some(json!({ "name": name, "output": "", "title": title, "svg": svg }))
                };
                let subjects = [("plain-scene", Subject::Scene), ("plain-motion", Subject::Motion)];
                subjects.into_iter().filter_map(plain).collect()
            }
            _ => Vec::new(),
        }
    }

    /// As a page of its own; `plan` is the picture that the case names.
    pub(crate) fn html(&self, plan: Option<Vec<u8>>) -> Result<String, Refused> {
        Ok(answer::page(&self.given, &self.answer, plan)?.html())
    }

    /// The same in the page `deltav.html`.
    pub(crate) fn live(&self, page: &str, plan: Option<Vec<u8>>) -> Result<String, Refused> {
        answer::alive(page, &answer::page(&self.given, &self.answer, plan)?, &self.given)
    }

    /// As text.
    pub(crate) fn text(&self) -> String {
        self.document().text()
    }

    /// As JSON.
    pub(crate) fn json(&self) -> Result<String, serde_json::Error> {
        self.answer.json(&self.given.file)
    }

    /// The samples or draws as CSV; none if the draws have not converged.
    pub(crate) fn csv(&self) -> String {
        answer::samples(&self.answer)
    }
}

/// Runs a command that takes long on the text of a case.
pub(crate) fn run(
    command: &str,
    [text, name, units, options]: [&str; 4],
    progress: &mut Progress<'_>,
) -> Result<Ran, Refused> {
    let given = Given::read(text, Some(name), units)?;
    let mut options = RequestOptions::read(options)?;
    // A report has everything that is known in addition to its exact solution.
    if command == "reconstruct" {
        options = options.or("weigh", true).or("method", true);
    }
    let request = Request::read(command, &options)?;
    let mut answer = given.found(request.answer(&given.file.case, &mut |counted, done, total| {
        if progress(counted, done, total) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }))?;
    if let Answer::Analysis(solved) = &mut answer
        && let Some(failure) = solved.unweighed.take()
    {
        return given.answered(Err(failure));
    }
    Ok(Ran { given, answer })
}

fn picture(name: &str, output: &str, drawing: &Drawing) -> Value {
    let id = format!("{name}-{}", output.replace('.', "-"));
    json!({ "name": name, "output": output, "title": drawing.title(), "svg": drawing.svg_named(&id) })
}

#[cfg(test)]
mod tests {
    use case::{Template, UnitSystem};
    use serde_json::Value;

    use super::{Ran, run};

    const NAME: &str = "case.toml";

    fn fixture(name: &str) -> String {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/");
        std::fs::read_to_string(format!("{root}{name}")).unwrap()
    }

    fn samples_of(ran: &Ran) -> Value {
        let data: Value = serde_json::from_str(&ran.json().unwrap()).unwrap();
        data["samples"].clone()
    }

    fn refused(command: &str, text: &str, options: &str, goes_on: bool) -> String {
        let refused = run(command, [text, NAME, "", options], &mut |_, _, _| goes_on).unwrap_err().json();
        assert_eq!(refused["ok"], false, "{options}");
        refused["message"].as_str().unwrap().to_owned()
    }

    #[test]
    fn an_uncertainty_tells_how_far_it_is_and_ends_with_what_it_has() {
        let text = fixture("sae-980025-uncertain.toml");
        let options = "{\"samples\": 40000, \"seed\": 7}";
        let mut told = Vec::new();
        let whole = run("uncertainty", [&text, NAME, "", options], &mut |counted, done, total| {
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
        let part = run("uncertainty", [&text, NAME, "", options], &mut |_, done, _| done == 0).unwrap();
        let some = part.csv().lines().count() - 1;
        assert!(some > 0 && some < 40000, "{some}");
        assert_ne!(samples_of(&part), samples_of(&whole));
        let none = run("uncertainty", [&text, NAME, "", options], &mut |_, _, _| false).unwrap();
        assert_eq!(none.answer()["ok"], true);
        assert_eq!(none.csv().lines().count(), 1);
    }

    /// What a run says in other units is what it says if it is asked in these.
    #[test]
    fn a_run_is_told_in_other_units() {
        for (command, text, options) in [
            ("uncertainty", fixture("sae-980025-uncertain.toml"), "{\"samples\": 500}"),
            ("estimate", fixture("estimate.toml"), "{\"particles\": 128, \"pieces\": false}"),
        ] {
            let asked =
                |units: &str| run(command, [&text, NAME, units, options], &mut |_, _, _| true).unwrap();
            let said =
                |ran: &Ran| (ran.answer(), ran.pictures(), ran.text(), ran.html(None).unwrap(), ran.csv());
            let [si, mut ran] = ["si", "us"].map(asked);
            assert_ne!(ran.answer()["headline"], si.answer()["headline"], "{command}");
            assert_eq!(ran.in_units("si").unwrap(), si.answer(), "{command}");
            assert!(said(&ran) == said(&si), "{command}");
            // The units of the case.
            ran.in_units("").unwrap();
            assert!(said(&ran) == said(&asked("")), "{command}");
            // Units that there are not change nothing.
            assert!(ran.in_units("furlongs").is_err());
            assert!(said(&ran) == said(&asked("")), "{command}");
        }
    }

    #[test]
    fn an_estimate_ends_without_an_answer() {
        let text = fixture("estimate.toml");
        let message = refused("estimate", &text, "{\"particles\": 128, \"pieces\": false}", false);
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
            let message = refused("uncertainty", &text, options, true);
            assert!(message.contains(expected), "{message}");
        }
        let message = refused("estimate", &fixture("estimate.toml"), "{\"above\": [\"x 1\"]}", true);
        assert!(message.contains("no result of this name"), "{message}");
    }
    #[test]
    fn a_case_with_more_evidence_is_weighed_and_another_one_is_not() {
        let over = Template::Intersection;
        let mut told = 0;
        let ran = run("reconstruct", [over.text(UnitSystem::Si), NAME, "", ""], &mut |_, _, _| {
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
        let torn = run("reconstruct", [&fixture("edcrash-tutorial.toml"), NAME, "", ""], &mut |_, _, _| true)
            .unwrap();
        let answer = torn.answer();
        assert_eq!(answer["converged"], false);
        assert!(answer["headline"][0].as_str().unwrap().starts_with("No collision"), "{answer:#}");
        assert_eq!(torn.csv(), "");
        let exact =
            run("reconstruct", [&fixture("sae-980025.toml"), NAME, "", ""], &mut |_, _, _| true).unwrap();
        assert_eq!(exact.csv(), "");
        let json: Value = serde_json::from_str(&exact.json().unwrap()).unwrap();
        assert_ne!(json["headline"]["by"], "estimate");
    }

    fn asked(text: &str) -> Ran {
        run("avoid", [text, NAME, "", ""], &mut |_, _, _| true).unwrap()
    }

    #[test]
    fn sliders_stand_where_the_case_has_its_numbers_and_move_them() {
        let text = fixture("avoid/pedestrian.toml");
        let ran = asked(&text);
        let answer = ran.answer();
        let [limit, reaction] = &answer["sliders"].as_array().unwrap()[..] else { panic!("{answer:#}") };
        assert_eq!(
            (&limit["value"], &limit["unit"], &limit["step"]),
            (&30.0.into(), &"km/h".into(), &1.0.into())
        );
        // Up to the speed driven, 50 km/h, and down to a step above nothing.
        let ends = |slider: &Value| ["least", "most"].map(|end| slider[end].as_f64().unwrap());
        for (found, expected) in [(ends(limit), [1.0, 50.0]), (ends(reaction), [0.05, 3.0])] {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        }
        assert_eq!(answer["charts"][0]["name"], "path-time");
        let moved = ran.moved("{\"avoid.limit\": 45, \"avoid.reaction_time\": 1.2}", false).unwrap();
        let by_hand = text.replace("\"30 km/h\"", "\"45 km/h\"").replace("\"0.8 s\"", "\"1.2 s\"");
        assert_eq!(moved["text"], by_hand);
        // From 45 km/h = 12.5 m/s: 12.5 (1.2 + 0.1) + 12.5²/15 − 7.5 · 0.2²/24 = 26.65 m, more than the 20 m.
        assert!(moved["headline"].to_string().contains("Not avoidable in space at 45"), "{moved:#}");
        let again = asked(&by_hand).answer();
        for same in ["headline", "html", "charts"] {
            assert_eq!(moved[same], again[same], "{same}");
        }
        // Where nothing is moved, the text stays as it is.
        assert_eq!(ran.moved("{\"avoid.limit\": 30}", false).unwrap()["text"], text);
    }

    #[test]
    fn a_range_moves_as_a_whole_and_has_its_probability_when_it_is_sampled() {
        let text = fixture("avoid/skid.toml");
        let ran = asked(&text);
        let answer = ran.answer();
        // 0.5 s to 1.2 s, of which the middle is 0.85 s: it can go down by less than 0.5 s.
        let reaction = &answer["sliders"][1];
        assert!((reaction["value"].as_f64().unwrap() - 0.85).abs() < 1e-9);
        assert!((reaction["least"].as_f64().unwrap() - 0.40).abs() < 1e-9, "{reaction}");
        // Further up than the range is wide.
        let to = "{\"avoid.reaction_time\": 1.85}";
        let by_hand = text.replace("\"0.5 s\", high = \"1.2 s\"", "\"1.50 s\", high = \"2.20 s\"");
        for (sampled, charts) in [(false, 1), (true, 2)] {
            let moved = ran.moved(to, sampled).unwrap();
            assert_eq!(moved["text"], by_hand);
            assert_eq!(moved["charts"].as_array().unwrap().len(), charts);
        }
        assert_eq!(ran.moved(to, true).unwrap()["html"], asked(&by_hand).answer()["html"]);
    }
}
