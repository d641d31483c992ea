//! A request from its names and back, the values that it refuses, and the promised content of its answer.

use std::ops::ControlFlow;

use case::{CaseFile, EXAMPLE, SeverityPrior};
use report::{PROGRAM, Units};
use requests::{Answer, OptionError, Request, RequestOptions, RowRefusal, Unanswered};
use uncertainty::SamplingMethod;

const COMMANDS: [&str; 11] = [
    "reconstruct",
    "impact",
    "motion",
    "crush",
    "check",
    "compare",
    "recorder",
    "sensitivity",
    "uncertainty",
    "estimate",
    "avoid",
];

#[track_caller]
fn read(command: &str, options: &str) -> Request {
    Request::read(command, &RequestOptions::read(options).unwrap()).unwrap()
}

fn file(name: &str) -> CaseFile {
    let path = format!("{}/../../fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    CaseFile::parse(name, &std::fs::read_to_string(path).unwrap()).unwrap()
}

fn answer(request: &Request, file: &CaseFile) -> Result<Answer, Unanswered> {
    request.answer(&file.case, &mut |_, _, _| ControlFlow::Continue(()))
}

#[test]
fn what_is_written_is_read_again() {
    for (command, options) in [
        ("reconstruct", r#"{"weigh":true,"method":false}"#),
        ("reconstruct", r#"{"weigh":false,"method":true}"#),
        ("sensitivity", r#"{"pdof_step":2.5,"pdof_steps":3}"#),
        (
            "uncertainty",
            r#"{"samples":4096,"seed":18446744073709551615,"method":"sobol","indices":64,"outputs":["vehicle1.speed"]}"#,
        ),
        (
            "uncertainty",
            r#"{"samples":null,"seed":1,"method":"latin-hypercube","indices":null,"outputs":null}"#,
        ),
        (
            "estimate",
            r#"{"particles":128,"seed":7,"prior":"flat","pieces":false,"above":["vehicle1.speed 50 km/h"]}"#,
        ),
        ("estimate", r#"{"particles":256,"seed":1,"prior":null,"pieces":true,"above":[]}"#),
        ("avoid", r#"{"samples":1000,"seed":3,"exact":true}"#),
    ] {
        let written = serde_json::to_string(&read(command, options)).unwrap();
        assert_eq!(written, format!(r#"{{"command":"{command}","options":{options}}}"#));
    }
    for command in COMMANDS {
        let request = read(command, "");
        let written = serde_json::to_value(&request).unwrap();
        assert_eq!(written["command"], command);
        let options = written.get("options").map(ToString::to_string).unwrap_or_default();
        assert_eq!(read(command, &options), request);
    }
    let Request::Uncertainty(options) = read("uncertainty", r#"{"method":"sobol"}"#) else { panic!() };
    assert_eq!(options.method, SamplingMethod::Sobol);
    let Request::Estimate(options) = read("estimate", r#"{"prior":"flat"}"#) else { panic!() };
    assert_eq!((options.prior, options.pieces), (Some(SeverityPrior::Flat), true));
}

#[test]
fn what_no_case_could_be_asked_is_refused() {
    let unread = |command: &str, options: &str| {
        let options = RequestOptions::read(options);
        options.and_then(|options| Request::read(command, &options)).unwrap_err().to_string()
    };
    assert_eq!(unread("guess", ""), "there is no command \"guess\" that answers");
    assert_eq!(unread("check", r#"{"seed":1}"#), "check has no option \"seed\"; its options: none");
    assert_eq!(
        unread("avoid", r#"{"seed":1,"sample":100}"#),
        "avoid has no option \"sample\"; its options: exact, samples, seed"
    );
    assert_eq!(unread("check", "[1]"), "the options are empty, or an object");
    assert_eq!(unread("estimate", r#"{"seed":-1}"#), "the option seed is a whole number, not -1");
    assert_eq!(unread("sensitivity", r#"{"pdof_step":"5"}"#), "the option pdof_step is a number, not \"5\"");
    assert_eq!(
        unread("estimate", r#"{"prior":"x"}"#),
        "the option prior is field or serious-injury or flat, not \"x\""
    );
    for (command, options, option) in [
        ("sensitivity", r#"{"pdof_step":0}"#, "pdof_step"),
        ("sensitivity", r#"{"pdof_step":180.5}"#, "pdof_step"),
        ("sensitivity", r#"{"pdof_steps":181}"#, "pdof_steps"),
        ("sensitivity", r#"{"pdof_steps":4294967296}"#, "pdof_steps"),
        ("uncertainty", r#"{"indices":1}"#, "sobol"),
        ("estimate", r#"{"particles":100}"#, "particles"),
        ("avoid", r#"{"samples":1}"#, "samples"),
    ] {
        let error = read(command, options).check().unwrap_err();
        assert!(matches!(error, OptionError::Value { option: of, .. } if of == option), "{error}");
    }
    for command in COMMANDS {
        assert_eq!(read(command, "").check(), Ok(()), "{command}");
    }
}

/// Only the case of the motion follows a vehicle to rest, and has a place for a site plan.
#[test]
fn an_answer_has_what_its_request_promises() {
    let example = CaseFile::parse("sae-980025.toml", EXAMPLE).unwrap();
    let (impact, motion) = (file("sae-980025-impact.toml"), file("rear-end-rest.toml"));
    let crush = file("sae-980025-crush.toml");
    let skid = file("avoid/skid.toml");
    let (ranges, evidence) = (file("sae-980025-uncertain.toml"), file("estimate.toml"));
    for (command, options, file) in [
        ("reconstruct", "", &example),
        ("impact", "", &impact),
        ("motion", "", &motion),
        ("crush", "", &crush),
        ("check", "", &example),
        ("compare", "", &example),
        ("sensitivity", "", &example),
        ("uncertainty", r#"{"samples":100}"#, &ranges),
        ("estimate", r#"{"particles":128,"pieces":false}"#, &evidence),
        ("avoid", r#"{"samples":640}"#, &skid),
    ] {
        let request = read(command, options);
        let found = answer(&request, file).unwrap();
        assert_eq!(found.row().is_some(), request.rows().is_some(), "{command}");
        assert!(found.json(file).unwrap().contains("\"sha256\": \""), "{command}");
        assert!(found.document(file, Units::Si).text().len() > 100, "{command}");
        let at_once = request.begin(&file.case).ok().map(|found| found.unwrap().json(file).unwrap());
        let takes_long = ["uncertainty", "estimate", "avoid"].contains(&command);
        assert_eq!(at_once, (!takes_long).then(|| found.json(file).unwrap()), "{command}");
        assert_eq!(found.shows_site_plan(), command == "motion", "{command}");
        let mut samples = Vec::new();
        found.write_samples(report::CsvStyle::International, &mut samples).unwrap();
        let has_samples = takes_long && command != "avoid" && found.no_answer().is_none();
        assert_eq!(!samples.is_empty(), has_samples, "{command}");
    }
}

/// Both rest positions are known in addition to the damage: more evidence than an exact solution uses.
#[test]
fn more_evidence_is_weighed_where_it_is_asked_for() {
    let over = file("edcrash-tutorial.toml");
    let exact = read("reconstruct", "");
    assert!(matches!(exact.begin(&over.case), Ok(Ok(Answer::Analysis(solved))) if solved.weighed.is_none()));
    let weighed = read("reconstruct", r#"{"weigh":true}"#);
    assert!(weighed.begin(&over.case).is_err());
    let row = weighed.of_row();
    assert_eq!(row, exact);
    let found = answer(&weighed, &over).unwrap();
    let Answer::Analysis(solved) = &found else { panic!() };
    assert!(solved.weighed.is_some() && solved.unweighed.is_none());
    // The evidence of this case contradicts itself.
    assert!(found.no_answer().unwrap().starts_with("the evidence contradicts itself"));
}

#[test]
fn a_row_is_refused_on_one_line() {
    assert_eq!(RowRefusal::sentence("no\n  answer").error, "no answer");
    let example = CaseFile::parse("sae-980025.toml", EXAMPLE).unwrap();
    let refused = answer(&read("impact", ""), &example).unwrap_err();
    let RowRefusal { error, help } = RowRefusal::of(&refused, &example, &PROGRAM);
    assert!(error.contains("`vehicle1.speed` is missing") && !error.contains('\n'), "{error}");
    assert!(!help.contains('\n'), "{help}");
    let request = read("estimate", r#"{"above":["  nothing 5 m "]}"#);
    let refused = answer(&request, &file("estimate.toml")).unwrap_err();
    assert!(refused.to_string().starts_with("\"nothing 5 m\": the case has no result"), "{refused}");
}
