//! The content of a text.

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

/// The command that evaluates recorders alone. It is not among the purposes of a case.
pub(crate) const RECORDER: &str = "recorder";

/// The commands that can answer, the most complete one first.
pub(crate) fn able(case: &Case) -> Vec<&'static str> {
    let judgement = analysis::judge(case);
    [Purpose::Reconstruct, Purpose::Impact, Purpose::Motion, Purpose::Crush, Purpose::Avoid]
        .into_iter()
        .filter(|purpose| obstacle(case, &judgement, *purpose).is_none())
        .map(Purpose::name)
        .chain(case.has_recorder_table().then_some(RECORDER))
        .collect()
}

/// What a case lacks for a purpose. The judgement covers a motion and an estimate only if the case has data
/// on them; here a user may ask for any purpose.
fn obstacle(case: &Case, judgement: &Judgement, purpose: Purpose) -> Option<Faults> {
    let judged = judgement.abilities.iter().find(|ability| ability.purpose == purpose);
    match (judged, purpose) {
        (Some(ability), _) => ability.obstacle.clone(),
        (None, Purpose::Motion) => case.motion().err(),
        (None, Purpose::Estimate) => match analysis::estimate_evidence(case) {
            Err(Failure::Case(faults)) => Some(faults),
            _ => None,
        },
        (None, Purpose::Avoid) => case.avoidance().err(),
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
        Purpose::Avoid,
    ];
    let case = &given.file.case;
    let of_purposes = purposes.map(|purpose| (purpose.name(), obstacle(case, judgement, purpose)));
    let of_recorders = match analysis::recorders(case) {
        Err(Failure::Case(faults)) => Some(faults),
        _ => None,
    };
    let mut commands = Map::new();
    for (command, obstacle) in of_purposes.into_iter().chain([(RECORDER, of_recorders)]) {
        let why = |faults: Faults| {
            let diagnostics = given.file.diagnostics(&faults, &PAGE);
            diagnostics.problems().into_iter().map(|problem| problem.message).collect::<Vec<_>>()
        };
        let ability = json!({ "able": obstacle.is_none(), "why": obstacle.map(why).unwrap_or_default() });
        commands.insert(command.to_owned(), ability);
    }
    Value::Object(commands)
}
