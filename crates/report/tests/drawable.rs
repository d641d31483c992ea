//! The drawings that `check` lists are those that are drawn.

#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::fs;
use std::path::PathBuf;

use analysis::Failure;
use case::CaseFile;
use report::{DrawingError, DrawingRequest, Subject, Units};
use serde_json::Value;

/// Both vehicles are known but for their speeds.
const NO_SPEEDS: &str = include_str!("../../../fixtures/estimate.toml");

fn fixtures() -> Vec<CaseFile> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut files = Vec::new();
    for folder in ["", "laws", "no-answer", "motion", "roots"] {
        let mut paths: Vec<PathBuf> =
            fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "toml")) {
            let name = path.file_name().unwrap().to_str().unwrap();
            files.push(CaseFile::parse(name, &fs::read_to_string(path).unwrap()).unwrap());
        }
    }
    // Two vehicles with only known damage, both with and without the direction of force.
    let crush_only = NO_SPEEDS.replace("[impact]", "[other]").split("[other]").next().unwrap().to_owned();
    files.push(CaseFile::parse("crush-only.toml", &crush_only).unwrap());
    files.push(CaseFile::parse("no-pdof.toml", &NO_SPEEDS.replace("pdof = \"15 deg\"", "")).unwrap());
    // One speed by momentum, without damage.
    let told = "after = { speed = \"6 m/s\", direction = \"0 deg\" }";
    let momentum = format!(
        "[vehicle1]\nmass = \"900 kg\"\nheading = \"0 deg\"\n{told}\n[vehicle2]\nmass = \"2400 kg\"\n\
         heading = \"0 deg\"\nspeed = \"0 km/h\"\n{told}\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
    );
    files.push(CaseFile::parse("momentum.toml", &momentum).unwrap());
    files
}

/// The drawings that `check` lists for a case, from its JSON and from its text.
fn listed(file: &CaseFile) -> Vec<String> {
    let judgement = analysis::judge(&file.case);
    let json: Value = serde_json::from_str(&report::judgement_json(file, &judgement).unwrap()).unwrap();
    let commands = json["commands"].as_array().unwrap();
    let draw = commands.iter().find(|command| command["command"] == "draw").unwrap();
    let draws: Vec<String> =
        draw["draws"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect();
    let text = report::judgement(file, &judgement, Units::Si).text();
    let told = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let sentence = format!("draw has all that it needs for --what {}", draws.join(", "));
    assert_eq!(told.contains(&sentence), !draws.is_empty(), "{sentence}\n{text}");
    draws
}

#[test]
fn what_check_lists_is_what_is_drawn() {
    let (mut drawn, mut refused) = (0, 0);
    for file in fixtures() {
        let draws = listed(&file);
        for subject in Subject::ALL {
            let place = format!("{} of {}", subject.name(), file.source.name());
            let is_listed = draws.iter().any(|name| name == subject.name());
            assert_eq!(is_listed, subject.obstacle(&file.case).is_none(), "{place}");
            let drawing = match subject.analysis(&file.case) {
                Ok(analysis) => report::drawing(&file, &analysis, Units::Si, subject),
                // Whether a case has an answer shows only when it is solved.
                Err(failure) if !matches!(failure, Failure::Case(_)) => continue,
                Err(failure) => Err(failure.into()),
            };
            match drawing {
                Ok(_) if is_listed => drawn += 1,
                Err(DrawingError::Analysis(failure)) if !matches!(failure, Failure::Case(_)) => {}
                Err(_) if !is_listed => refused += 1,
                Ok(_) => panic!("{place} is drawn, but not listed"),
                Err(error) => panic!("{place} is listed, but not drawn: {error}"),
            }
        }
    }
    assert!(drawn > 100 && refused > 30, "{drawn} {refused}");
}

/// A case that only an estimate answers shows where its vehicles touched, with their damage.
#[test]
fn a_scene_needs_no_speeds() {
    for text in [NO_SPEEDS.to_owned(), NO_SPEEDS.replace("pdof = \"15 deg\"", "")] {
        let file = CaseFile::parse("estimate.toml", &text).unwrap();
        let analysis = Subject::Scene.analysis(&file.case).unwrap();
        let drawing = report::drawing(&file, &analysis, Units::Si, Subject::Scene).unwrap();
        let svg = drawing.svg();
        for shown in ["outline-1", "damaged-1", "outline-2", "damaged-2", "crush-plane", "cg-1", "cg-2"] {
            assert!(svg.contains(&format!("id=\"scene-{shown}\"")), "{shown}");
        }
        for unknown in ["velocity", "impulse", "pdof", "speed"] {
            assert!(!svg.contains(&format!("id=\"scene-{unknown}")), "{unknown}");
        }
        assert!(drawing.description().contains("The speeds are not known."));
        let plain = DrawingRequest { subject: Subject::Scene, plain: true }
            .draw(&file, &analysis, None, Units::Si, None)
            .unwrap();
        assert!(plain.svg().contains("Focus") && !plain.description().contains("km/h"));
    }
}

/// The contact points of both vehicles lie in one place: C of the scene, r = d (cos(θ + φ), sin(θ + φ)) from
/// each centre of gravity.
#[test]
fn a_scene_without_speeds_has_the_vehicles_in_their_places() {
    let file = CaseFile::parse("estimate.toml", NO_SPEEDS).unwrap();
    let analysis = Subject::Scene.analysis(&file.case).unwrap();
    let (_, view) = report::plan_view(&file, &analysis, Units::Si, Subject::Scene, None).unwrap();
    let [one, two] = view.bodies.map(|body| body.unwrap().cg);
    // Heading 0°, C 1.9 m forward and 0.25 m to the left; heading 90°, 0.6 m forward and 0.75 m to the left.
    for (cg, expected) in [(one, [-1.9, -0.25]), (two, [0.75, -0.6])] {
        assert!((cg[0] - expected[0]).abs() < 1e-12 && (cg[1] - expected[1]).abs() < 1e-12, "{cg:?}");
    }
}
