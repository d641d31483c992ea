//! Drawings.

use analysis::Analysis;
use report::Subject;
use serde_json::{Value, json};

use crate::given::{Given, Refused, made};

pub(crate) fn draw(text: &str, what: &str, units: &str) -> Value {
    made(Given::read(text, None, units).and_then(|given| {
        let subject = subject(what)?;
        let analysis = solved(&given, subject)?;
        let drawing = report::drawing(&given.file, &analysis, given.units, subject);
        let drawing = drawing.map_err(|error| Refused::message(error.to_string()))?;
        Ok(json!({
            "ok": true,
            "svg": drawing.svg(),
            "title": drawing.title(),
            "description": drawing.description(),
        }))
    }))
}

fn subject(what: &str) -> Result<Subject, Refused> {
    let subject = Subject::ALL.into_iter().find(|subject| subject.name() == what);
    subject.ok_or_else(|| Refused::message(format!("there is no drawing \"{}\"", case::shown(what))))
}

/// What a subject is drawn of.
fn solved(given: &Given, subject: Subject) -> Result<Analysis, Refused> {
    let case = &given.file.case;
    let is_motion = matches!(subject, Subject::Motion | Subject::MotionCurves);
    // What a case lacks for an impact does not keep its motion after the impact from being drawn.
    let analysis = match analysis::furthest(case) {
        Ok(analysis) if !is_motion || analysis.travel.iter().any(Option::is_some) => Ok(analysis),
        Err(failure) if !is_motion => Err(failure),
        _ => analysis::motion(case),
    };
    given.answered(analysis)
}
