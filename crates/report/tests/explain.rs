//! The glossary explains whatever the program can name.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use analysis::{Analysis, CheckedQuantity, Warning};
use case::CaseFile;
use report::{explanation, list_of_topics, topic, topic_json, topics, topics_json};

/// Every valid case of the fixtures.
fn cases() -> Vec<CaseFile> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut cases = Vec::new();
    for folder in ["", "laws", "ricsac", "no-answer"] {
        let mut paths: Vec<PathBuf> =
            fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "toml")) {
            cases.extend(CaseFile::parse(&path.display().to_string(), &fs::read_to_string(path).unwrap()));
        }
    }
    assert!(cases.len() > 30);
    cases
}

fn analyses(file: &CaseFile) -> impl Iterator<Item = Analysis> {
    [analysis::reconstruct(&file.case), analysis::impact(&file.case), analysis::crush(&file.case)]
        .into_iter()
        .flatten()
}

#[track_caller]
fn explained(word: &str, by: &str) {
    assert_eq!(topic(word).map(|topic| topic.name), Ok(by), "{word}");
}

#[test]
fn every_warning_has_a_topic_of_its_own() {
    let mut names = BTreeSet::new();
    for code in Warning::CODES {
        let topic = topic(code).unwrap();
        assert_eq!(topic.group, "Warnings", "{code}");
        assert_eq!(topic.name, code);
        names.insert(topic.name);
    }
    assert_eq!(names.len(), Warning::CODES.len());
    assert_eq!(topics().iter().filter(|topic| topic.group == "Warnings").count(), names.len());
}

#[test]
fn every_check_has_a_topic() {
    for code in CheckedQuantity::CODES {
        assert!(topic(code).is_ok(), "{code}");
    }
}

#[test]
fn every_symbol_of_a_report_has_a_topic() {
    let mut symbols = BTreeSet::new();
    for file in cases() {
        for analysis in analyses(&file) {
            let groups = report::steps(&file.case, &analysis, report::Units::Si);
            symbols.extend(groups.into_iter().flat_map(|group| group.steps).map(|step| step.symbol));
        }
    }
    assert!(symbols.len() > 90, "{}", symbols.len());
    for symbol in &symbols {
        assert!(topic(symbol).is_ok(), "{symbol}");
    }
    // Further names in the labels of the text and of the drawings.
    for symbol in [
        "θ", "C", "Γ", "u", "U", "P", "μ", "μ_c", "n", "t", "v", "V", "ω", "Ω", "ΔV", "PDOF", "E_L", "W_n",
        "W_t", "W_m", "E", "EBS", "α", "h", "γ", "A", "B", "G", "M", "e", "e_n", "e_t", "e_m", "ε", "EES",
    ] {
        assert!(topic(symbol).is_ok(), "{symbol}");
    }
}

#[test]
fn every_key_of_a_case_has_a_topic() {
    // Labels, and tables whose keys are explained one by one.
    let plain = ["title", "source", "name", "vehicle1", "vehicle2", "crush"];
    let mut keys: BTreeSet<String> = case::keys().into_iter().collect();
    assert!(keys.len() > 100, "{}", keys.len());
    keys.retain(|path| !plain.contains(&path.rsplit('.').next().unwrap()));
    // With the places in lists.
    for file in cases() {
        keys.extend(file.case.inputs().into_iter().map(|input| input.path));
        keys.extend(analysis::judge(&file.case).assumptions.iter().map(analysis::Assumption::key));
    }
    let of_ranges = ["value", "values", "sd", "low", "mode", "high", "within", "confidence"];
    let without: Vec<&str> =
        keys.iter().map(String::as_str).chain(of_ranges).filter(|key| topic(key).is_err()).collect();
    assert!(without.is_empty(), "{without:?}");
}

#[test]
fn a_symbol_or_key_means_what_it_means_there() {
    explained("u", "relative velocity");
    explained("U", "relative velocity");
    explained("e", "restitution");
    explained("E", "CRASH3");
    explained("m", "mass and weight");
    explained("M", "moment impulse");
    explained("t", "crush plane");
    explained("T", "energy loss");
    explained("Γ", "crush plane");
    explained("γ_2", "effective mass ratio");
    explained("C", "contact point");
    explained("C_2", "crush depth");
    explained("x_1", "contact point");
    explained("x", "closing speed");
    explained("E'_2", "oblique correction");
    explained("ΔV''_1", "ΔV");
    explained("S_2,1", "crush profile sums");
    explained("k_1²", "radius of gyration");
    explained("Ω_1", "yaw rate");
    explained("V_1x", "relative velocity");
    explained("vehicle1.width", "outline");
    explained("vehicle1.crush.width", "damage width");
    explained("vehicle1.crush.stiffness.test.width", "barrier test");
    explained("vehicle2.crush.depths[3]", "crush depth");
    explained("impact.friction", "friction limit");
    explained("vehicle1.crush.oblique.friction", "oblique correction");
    explained("force balance", "force balance");
    explained("force-balance", "force-balance");
    explained("crush-plane", "crush-plane");
    explained("Crush plane", "crush plane");
    explained("Sobol index", "Sobol' index");
    explained("Energy Basis", "energy basis");
    // Names used by people who have not read the glossary.
    explained("J670", "axes");
    explained("heading angle", "heading");
    explained("CDC", "PDOF");
    explained("edr", "EDR");
    explained("rest positions", "rest");
    explained("drag factor", "drag");
    explained("skid", "skid");
    explained("both speeds", "two unknown speeds");
    explained("articulated", "outside the model");
    explained("pedestrian", "outside the model");
    explained("truck", "kind");
    explained("lorry", "kind");
    explained("motorcycle", "kind");
    explained("tree", "fixed object");
    explained("pole", "fixed object");
    explained("momentum", "impulse");
    explained("trapezoid", "crush profile sums");
    explained("A and B", "A, B, G");
    explained("crush stiffness", "A, B, G");
    explained("effective mass", "effective mass ratio");
    explained("mu_c", "critical impulse ratio");
    explained("mu", "impulse ratio");
    explained("C1", "crush depth");
    explained("C6", "crush depth");
    explained("E2", "CRASH3");
    explained("d0", "d0 and d1");
    explained("b1", "barrier test");
    explained("kN", "units");
    explained("kn", "units");
    explained("units", "units");
    for equation in 1..=8 {
        assert!(topic(&format!("Eq {equation}")).is_ok(), "Eq {equation}");
    }
}

#[test]
fn names_are_unique_and_texts_are_short_and_cite_their_source() {
    let mut names = BTreeSet::new();
    for topic in topics() {
        for name in std::iter::once(&topic.name).chain(&topic.aliases) {
            assert!(names.insert(*name), "{name} stands twice");
        }
        let words = topic.text.split_whitespace().count();
        assert!((40..=120).contains(&words), "{}: {words} words", topic.name);
        let cites = ["Theory ", "theory ", "`deltav ", "`--method ", "JCGM", "warning", "measure"];
        assert!(cites.iter().any(|source| topic.text.contains(source)), "{}", topic.name);
    }
}

#[test]
fn an_unknown_topic_names_its_neighbours() {
    let error = topic("crush plain").unwrap_err();
    assert_eq!(error.nearest.first(), Some(&"crush plane"));
    assert!(error.to_string().contains("did you mean \"crush plane\""));
    // A topic of several names is named once.
    let near: BTreeSet<&str> = error.nearest.iter().map(|name| topic(name).unwrap().name).collect();
    assert_eq!(near.len(), error.nearest.len(), "{error}");
    // A part of a name is enough for it to be suggested.
    assert!(topic("hypercub").unwrap_err().nearest.contains(&"Latin hypercube"));
    assert_eq!(topic("xyzzy").unwrap_err().nearest, [""; 0]);
    assert!(topic("").is_err());
}

#[test]
fn lines_fit_and_equations_keep_theirs() {
    for topic in topics() {
        let text = explanation(topic).text_within(80);
        assert!(text.starts_with(topic.name) && text.ends_with('\n'));
        for line in text.lines().filter(|line| !line.starts_with("    ")) {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
    let text = explanation(topic("EES").unwrap()).text_within(60);
    assert!(text.contains("\n    EES = √(2 E/m)\n"), "{text}");
    let list = list_of_topics().text_within(80);
    assert!(topics().iter().all(|topic| list.replace('\n', " ").contains(topic.name)));
}

#[test]
fn the_json_has_the_texts_of_the_glossary() {
    let all: serde_json::Value = serde_json::from_str(&topics_json().unwrap()).unwrap();
    let all = all.as_array().unwrap();
    assert_eq!(all.len(), topics().len());
    let glossary = fs::read_to_string(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("glossary.md")).unwrap();
    for (entry, one) in all.iter().zip(topics()) {
        let text = |key: &str| entry[key].as_str().unwrap();
        assert!(glossary.contains(&format!("\n### {}\n", text("term"))) && glossary.contains(text("text")));
        assert!(glossary.contains(&format!("\n## {}\n", text("kind"))));
        assert_eq!(*entry, serde_json::from_str::<serde_json::Value>(&topic_json(one).unwrap()).unwrap());
        for other in entry["see_also"].as_array().unwrap() {
            let other = topic(other.as_str().unwrap()).unwrap();
            assert_ne!(other.name, one.name);
        }
    }
    // "in z-down axes", "with a `sideslip`", "The heading turns contact point, PDOF and speed into the
    // scene": and not itself, nor "scene frame".
    assert_eq!(topic("heading").unwrap().see_also(), ["axes", "sideslip", "contact point", "PDOF"]);
    assert_eq!(topic("heading").unwrap().aliases[..3], ["θ", "theta", "heading angle"]);
}

/// Words that practitioners use, and the topic that explains each: of Fricke, of Brach, of Daily, Shigemura
/// and Daily, of EDCRASH's manual and of ISO 12353-1.
#[test]
fn the_words_of_the_trade_are_explained() {
    for (by, words) in [
        ("which command", "which command; where to begin; command"),
        (
            "two unknown speeds",
            "COLM; conservation of linear momentum; linear momentum; momentum analysis; T-bone; broadside",
        ),
        (
            "skid",
            "speed from skid; skid to stop; minimum speed; speed from skid marks; ABS marks; skip skid; gap skid; \
             impending skid; pre-impact braking",
        ),
        ("combined speed", "combined speed; combined speeds; combining speeds; sum of squares"),
        (
            "critical speed",
            "critical speed; yaw mark; yaw marks; critical speed yaw; chord; middle ordinate; scuff marks; radius",
        ),
        ("airborne", "vault; airborne; free fall; takeoff speed; flip"),
        ("deceleration", "deceleration; braking efficiency; effective drag factor; braking; percent braking"),
        ("drag", "drag factor; lock-up; rolling resistance; locked wheel"),
        (
            "EES",
            "BEV; KEES; CEES; EBS; ETS; barrier equivalent velocity; kinetic energy equivalent speed; \
             equivalent barrier speed",
        ),
        ("heading", "approach angle; impact angle; yaw angle; orientation"),
        (
            "velocity after the impact",
            "post-impact speed; post-impact velocity; separation; departure angle; exit speed; separation speed",
        ),
        (
            "common velocity",
            "common velocity; stuck together; plastic impact; locked together; inelastic collision; entangled",
        ),
        ("stopped vehicle", "stopped vehicle; parked car; stationary vehicle; did not move"),
        ("in-line collision", "rear-end; in-line; collinear; head-on; rear-end collision"),
        ("outside the model", "override; underride; throw distance; rollover; pedestrian"),
        ("yaw inertia", "mass moment of inertia; polar moment of inertia; moment of inertia"),
        (
            "crush depth",
            "crush; induced damage; direct damage; residual crush; maximum crush; deformation; crush profile",
        ),
        ("force balance", "missing vehicle; missing vehicle algorithm"),
        ("other programs", "WinSMASH; SMASH; EDCRASH; PC-Crash; SMAC; Virtual CRASH"),
        ("guardrail", "guardrail; crash cushion; cable barrier"),
        ("friction limit", "inter-vehicle friction; friction between the vehicles; sideswipe"),
        ("occupant", "occupant; occupants; injury; acceleration; crash pulse; seat belt; airbag"),
        ("several impacts", "chain collision; second impact; secondary impact; pile-up; three vehicles"),
        ("sideslip", "sideslip; slip; slip angle; course; drift"),
        ("contact point", "impulse center; impulse centre; center of impulse"),
        ("time and distance", "avoid; avoidance; speed limit; time to collision; TTC"),
        ("sight", "sight; sight distance; visibility; line of sight; obstacle"),
        ("reaction time", "reaction time; perception-reaction time"),
        ("stopping distance", "stopping distance; braking distance"),
        ("impulse ratio", "impulse ratio; mu"),
        ("closing speed", "closing velocity; approach speed; closing speed"),
        ("ΔV", "change in velocity; crash severity; delta v; delta-v"),
        ("EDR", "CDR; crash data retrieval; ACM; pre-crash data; black box"),
        ("restitution", "elastic; rebound; coefficient of restitution"),
        ("energy loss", "kinetic energy; conservation of energy; dissipated energy"),
        ("peak force", "Newton's third law; third law"),
        ("yaw rate", "angular momentum; conservation of angular momentum; angular velocity"),
        ("place of the impact", "point of impact; POI; area of impact; gouge; debris; maximum engagement"),
        ("rest", "final rest; spin-out; rollout; final rest position"),
        ("surface", "coefficient of friction; drag sled; asphalt; test skid"),
        ("grade", "superelevation; percent grade; slope"),
        ("barrier test", "crash test; NCAP"),
        ("axles", "center of gravity; weight distribution"),
        ("moment arm", "lever arm; eccentric impact; central impact"),
        ("CRASH3", "damage algorithm; deformation energy; crush energy"),
    ] {
        for word in words.split("; ") {
            explained(word, by);
        }
    }
    // A term that is often misread begins with that.
    let drag = topic("drag factor").unwrap();
    assert!(drag.text.starts_with("`drag` is not the drag factor f of a skid"), "{}", drag.text);
    assert!(drag.text.contains("`drag = 0.7` means fully braked wheels"));
}

/// The topic on two unknown speeds, and the list of topics, lead to the command that weighs everything.
#[test]
fn the_topics_of_unknown_speeds_name_the_estimate() {
    for word in ["two unknown speeds", "which command", "stopped vehicle"] {
        assert!(topic(word).unwrap().text.contains("`deltav estimate"), "{word}");
    }
}
