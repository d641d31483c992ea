//! What a text says.

use analysis::{Failure, Judgement};
use case::{Case, CaseFile, Faults, Purpose, Source};
use report::Units;
use serde_json::{Map, Value, json};

use crate::given::{Given, PAGE, Places, UNNAMED, problems};

pub(crate) fn check(text: &str, name: Option<&str>) -> Value {
    let parsed = CaseFile::parse(name.unwrap_or(UNNAMED), text);
    match parsed {
        Ok(file) => {
            let units = Units::of_case(&file.case);
            let given = Given { file, units };
            let judgement = analysis::judge(&given.file.case);
            json!({
                "ok": true,
                "problems": [],
                "values": values(&given.file.source),
                "commands": commands(&given, &judgement),
                "judgement_html": report::judgement(&given.file, &judgement, units).html_fragment(),
                "units": case::word(&Units::WORDS, &units),
            })
        }
        Err(errors) => {
            let errors = errors.in_words_of(&PAGE);
            json!({
                "ok": false,
                "problems": problems(&errors),
                "values": values(errors.source()),
                "commands": {},
                "judgement_html": "",
                "units": "",
            })
        }
    }
}

/// The place and the text of each key that the file gives.
fn values(source: &Source) -> Value {
    let text = source.text();
    let places = Places::of(text);
    let value = |(key, span): (&str, std::ops::Range<usize>)| {
        let [from, to] = places.of_span(&span);
        let written = text.get(span).unwrap_or_default();
        (key.to_owned(), json!({ "from": from, "to": to, "text": written }))
    };
    Value::Object(source.spans().map(value).collect())
}

/// The commands that can answer, the one that says most first.
pub(crate) fn able(case: &Case) -> Vec<&'static str> {
    let judgement = analysis::judge(case);
    [Purpose::Reconstruct, Purpose::Impact, Purpose::Motion, Purpose::Crush]
        .into_iter()
        .filter(|purpose| obstacle(case, &judgement, *purpose).is_none())
        .map(Purpose::name)
        .collect()
}

/// What a case lacks for a purpose. It is judged for a motion and an estimate where it says something of
/// them; here somebody may want to know.
fn obstacle(case: &Case, judgement: &Judgement, purpose: Purpose) -> Option<Faults> {
    let judged = judgement.abilities.iter().find(|ability| ability.purpose == purpose);
    match (judged, purpose) {
        (Some(ability), _) => ability.obstacle.clone(),
        (None, Purpose::Motion) => case.motion().err(),
        (None, Purpose::Estimate) => match analysis::estimate_evidence(case) {
            Err(Failure::Case(faults)) => Some(faults),
            _ => None,
        },
        (None, _) => None,
    }
}

/// What can be done with the case, and what is missing for the rest.
fn commands(given: &Given, judgement: &Judgement) -> Value {
    let purposes = [
        Purpose::Reconstruct,
        Purpose::Impact,
        Purpose::Motion,
        Purpose::Crush,
        Purpose::Compare,
        Purpose::Sensitivity,
        Purpose::Uncertainty,
        Purpose::Estimate,
    ];
    let mut commands = Map::new();
    for purpose in purposes {
        let obstacle = obstacle(&given.file.case, judgement, purpose);
        let why = |faults: Faults| {
            let diagnostics = given.file.diagnostics(&faults, &PAGE);
            diagnostics.problems().into_iter().map(|problem| problem.message).collect::<Vec<_>>()
        };
        let command = json!({ "able": obstacle.is_none(), "why": obstacle.map(why).unwrap_or_default() });
        commands.insert(purpose.name().to_owned(), command);
    }
    Value::Object(commands)
}
