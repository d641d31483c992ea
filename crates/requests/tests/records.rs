//! `recorder`: the tables of recorders, in a case and in files next to it.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use case::CaseFile;
use report::{CsvStyle, PROGRAM, Units};
use requests::{Answer, Request, RequestOptions, Unanswered, read_records_beside};

fn fixture() -> CaseFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/recorder.toml");
    CaseFile::parse("recorder.toml", &fs::read_to_string(path).unwrap()).unwrap()
}

fn asked(file: &CaseFile) -> Result<Answer, Unanswered> {
    let request = Request::read("recorder", &RequestOptions::default()).unwrap();
    request.answer(&file.case, &mut |_, _, _| ControlFlow::Continue(()))
}

#[test]
fn a_recorder_is_shown_in_every_format() {
    let file = fixture();
    let answer = asked(&file).unwrap();
    let page = answer.document(&file, Units::Si);
    let text = page.text();
    for words in [
        "at the impact",
        "MPH [km/h]",
        "service brake",
        "\"Invalid\"",
        "at least",
        "49 CFR 563.5",
        "complete",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    // The place of the cell is that in the case file.
    let line =
        1 + file.source.text().lines().position(|line| line.ends_with("On Non-Engaged Invalid")).unwrap();
    assert!(text.contains(&format!("line {line}, column")), "{text}");
    assert!(page.html().contains("<svg") && page.html().contains("distance of both vehicles"));
    let json: serde_json::Value = serde_json::from_str(&answer.json(&file).unwrap()).unwrap();
    let speed = &json["vehicles"][0]["speed_at_impact"];
    assert!((speed["stored"].as_f64().unwrap() * 3.6 - 48.0).abs() < 1e-9);
    assert!(speed["mean"].as_f64() > speed["stored"].as_f64(), "braked wheels read low");
    let low = speed["interval_95"][0].as_f64().unwrap() * 3.6;
    let high = speed["interval_95"][1].as_f64().unwrap() * 3.6;
    assert!(low > 42.0 && low < 48.0 && high > 50.0 && high < 56.0, "{low} {high}");
    let pulse = &json["vehicles"][1]["pulse"];
    assert_eq!(pulse["ends_before_impact"], false);
    // 9 km/h along and 26 across
    let size = pulse["spans"][2]["delta_v"].as_f64().unwrap() * 3.6;
    assert!((size - 757_f64.sqrt()).abs() < 0.6, "{size}");
    let mut csv = Vec::new();
    answer.write_samples(CsvStyle::International, &mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    assert_eq!(csv.lines().count(), 1 + 6 + 5);
    assert!(csv.lines().nth(1).unwrap().starts_with("1,-2.5,16.38"), "{csv}");
    // From the last sample on, no distance is left.
    assert!(csv.lines().nth(6).unwrap().ends_with(",0,0,0,1"), "{csv}");
}

/// One record ends 0.5 s before the impact, the other at it: on the common clock, both are at distance 0 at
/// time 0, and the first is 0.5 s at 60 km/h or a little less before it at its last sample.
#[test]
fn both_paths_end_at_the_impact() {
    let vehicle = |n: u8, time: &str, speed: &str| {
        format!(
            "[vehicle{n}.recorder.pre_crash]\ntime = \"{time} s\"\nspeed = \"{speed} km/h\"\nbrake = \"off off off\"\n"
        )
    };
    let text = vehicle(1, "-2.5 -1.5 -0.5", "60 60 60") + &vehicle(2, "-2 -1 0", "40 40 40");
    let file = CaseFile::parse("case.toml", &text).unwrap();
    let answer = asked(&file).unwrap();
    let mut csv = Vec::new();
    answer.write_samples(CsvStyle::International, &mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let [time, distance, is_stored] = ["time", "distance", "speed_is_stored"]
        .map(|name| rows[0].iter().position(|own| *own == name).unwrap());
    let at = |vehicle: &str| rows.iter().filter(|row| row[0] == vehicle).collect::<Vec<_>>();
    let (one, two) = (at("1"), at("2"));
    for path in [&one, &two] {
        let last = path.last().unwrap();
        assert_eq!((last[time], last[distance]), ("0", "0"), "{csv}");
    }
    let before: f64 = one[2][distance].parse().unwrap();
    assert!(one[2][time] == "-0.5" && (8.0..8.5).contains(&before), "{csv}");
    assert_eq!((one.len(), one[2][is_stored], one[3][is_stored], two[2][is_stored]), (4, "1", "0", "1"));
    let json: serde_json::Value = serde_json::from_str(&answer.json(&file).unwrap()).unwrap();
    let [first, second] = [0, 1].map(|k| &json["vehicles"][k]);
    let impact = &first["samples"][3];
    assert_eq!((&impact["time"], &impact["speed_is_stored"]), (&0.0.into(), &false.into()));
    assert_eq!(impact["speed"], first["speed_at_impact"]["median"]);
    assert_eq!(second["samples"].as_array().unwrap().len(), 3);
    let page = answer.document(&file, Units::Si).text();
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("The last speed was stored at -0.50 s. The row at 0 s has the median"), "{page}");
    assert_eq!(words.matches("The row at 0 s").count(), 1, "{page}");
}

#[test]
fn a_case_without_a_table_says_what_to_give() {
    let file = CaseFile::parse("case.toml", "[vehicle1]\n[vehicle2]\nfixed = true\n").unwrap();
    let Err(Unanswered::Failure(analysis::Failure::Case(faults))) = asked(&file) else { panic!() };
    let said = file.diagnostics(&faults, &PROGRAM).to_string();
    assert!(said.contains("no recorder of the case has a table") && said.contains("pre_crash = "), "{said}");
}

#[test]
fn files_beside_a_case_are_read_or_refused() {
    let folder = std::env::temp_dir().join(format!("deltav-records-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let case = folder.join("case.toml");
    let with = |name: &str| {
        let text =
            format!("[vehicle1.recorder]\npre_crash = {{ file = \"{name}\" }}\n[vehicle2]\nfixed = true\n");
        let mut file = CaseFile::parse("case.toml", &text).unwrap();
        let read = read_records_beside(&case, &mut file, &PROGRAM);
        (file, read)
    };
    fs::write(folder.join("edr.csv"), "Time (s),Speed (km/h)\n-1,60\n0,50\n").unwrap();
    fs::write(folder.join("bad.csv"), "Time (s),Speed (km/h)\n-1,60\n0,50,4\n").unwrap();
    fs::write(folder.join("pulse.csv"), "Time (ms),Longitudinal delta-V (km/h)\n0,0\n10,-4\n").unwrap();
    let (file, read) = with("edr.csv");
    read.unwrap();
    assert!(asked(&file).is_ok());
    for (name, words) in [
        ("bad.csv", "bad.csv:3:1: 3 values"),
        ("pulse.csv", "pulse.csv: this is a table of ΔV over time, not of speeds before the impact"),
        ("pulse.csv", "help: give it as `pulse`"),
        ("absent.csv", "cannot read absent.csv"),
        ("../edr.csv", "outside the folder"),
        ("/etc/hostname", "outside the folder"),
        (".", "not a file"),
    ] {
        let (file, read) = with(name);
        let error = read.unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("case.toml:2:"), "{name}: {error}");
        // What nobody read is no answer either.
        assert!(asked(&file).is_err());
    }
    fs::remove_dir_all(&folder).unwrap();
}

const TWO_RECORDS: &str = r#"
[vehicle1]
mass = "1500 kg"
yaw_radius = "1.4 m"
heading = "0 deg"
contact = { x = "2 m", y = "0 m" }
crush = { side = "front", width = "150 cm", depths = "40 40 cm", stiffness = { category = 3 }, pdof = "0 deg" }

[[vehicle1.recorder.records]]
pulse = { time = "0 20 40 60 80 100 ms", delta_v_longitudinal = "0 3 6 7 7 7 km/h", delta_v_lateral = "0 0 0 0 0 0 km/h" }
pre_crash = { time = "-1 0 s", speed = "52 51 km/h" }

[[vehicle1.recorder.records]]
since_previous = "0.9 s"
pulse = { time = "0 20 40 60 80 100 ms", delta_v_longitudinal = "0 -20 -35 -44 -44 -44 km/h", delta_v_lateral = "0 0 1 1 1 1 km/h" }
pre_crash = { file = "edr.csv" }

[vehicle2]
mass = "1500 kg"
yaw_radius = "1.4 m"
heading = "180 deg"
contact = { x = "2 m", y = "0 m" }
crush = { side = "front", width = "150 cm", depths = "40 40 cm", stiffness = { category = 3 } }
"#;

/// A push from behind, and 0.9 s later the impact.
#[test]
fn several_records_are_told_apart_in_every_format() {
    let folder = std::env::temp_dir().join(format!("deltav-several-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("edr.csv"), "Time (s),Speed (km/h)\n-1,57\n0,50\n").unwrap();
    let mut file = CaseFile::parse("case.toml", TWO_RECORDS).unwrap();
    // What nobody read is no answer.
    assert!(asked(&file).is_err());
    read_records_beside(&folder.join("case.toml"), &mut file, &PROGRAM).unwrap();
    let answer = asked(&file).unwrap();
    let page = answer.document(&file, Units::Si);
    for words in [
        "Which record is of this impact",
        "is of this impact: over 99 %",
        "cannot be of this impact: its",
        "Before the impact: record 1",
        "Before the impact: record 2",
        "Speed of vehicle 1 at the impact: 5",
    ] {
        assert!(page.text().contains(words), "{words}: {}", page.text());
    }
    assert!(page.html().contains("cannot be of this impact"));
    let json: serde_json::Value = serde_json::from_str(&answer.json(&file).unwrap()).unwrap();
    let vehicle = &json["vehicles"][0];
    assert_eq!(vehicle["record"]["key"], "vehicle1.recorder.records[2]");
    assert_eq!(vehicle["record"]["is_taken"], true);
    assert!(vehicle["record"]["probability"].as_f64().unwrap() > 0.95);
    assert_eq!(vehicle["record"]["since_previous"], 0.9);
    assert_eq!(vehicle["other_records"][0]["record"]["is_taken"], false);
    assert_eq!(vehicle["other_records"][0]["samples"].as_array().unwrap().len(), 2);
    let check = Request::read("check", &RequestOptions::default()).unwrap();
    let check = check.answer(&file.case, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    let text = check.document(&file, Units::Si).text();
    for words in ["vehicle1.recorder.records[1].pre_crash", "cannot be of this impact", "is of this impact: "]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    // The same two files, one of which is not there.
    fs::remove_dir_all(&folder).unwrap();
    let mut file = CaseFile::parse("case.toml", TWO_RECORDS).unwrap();
    let error = read_records_beside(&folder.join("case.toml"), &mut file, &PROGRAM).unwrap_err().to_string();
    assert!(error.contains("cannot read edr.csv") && error.contains("case.toml:16:22"), "{error}");
}

/// A folder on the path to a file may be a link, and so may the file itself.
#[cfg(unix)]
#[test]
fn nothing_that_a_case_names_lies_behind_a_link() {
    use std::os::unix::fs::symlink;
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("behind-a-link");
    let (folder, elsewhere) = (root.join("case"), root.join("elsewhere"));
    drop(fs::remove_dir_all(&root));
    fs::create_dir_all(&folder).unwrap();
    fs::create_dir_all(&elsewhere).unwrap();
    fs::write(elsewhere.join("edr.csv"), "Time (s),Speed (km/h)\n-1,60\n0,50\n").unwrap();
    fs::copy(elsewhere.join("edr.csv"), folder.join("own.csv")).unwrap();
    symlink(&elsewhere, folder.join("sub")).unwrap();
    symlink("own.csv", folder.join("link.csv")).unwrap();
    let case = folder.join("case.toml");
    let read = |name: &str| {
        let text = format!("[vehicle1.recorder]\npre_crash = {{ file = \"{name}\" }}\n");
        let mut file = CaseFile::parse("case.toml", &text).unwrap();
        read_records_beside(&case, &mut file, &PROGRAM).map_err(|error| error.to_string())
    };
    read("own.csv").unwrap();
    let behind = read("sub/edr.csv").unwrap_err();
    assert!(behind.contains("outside the folder of the case"), "{behind}");
    let link = read("link.csv").unwrap_err();
    assert!(link.contains("it is a link"), "{link}");
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let plan =
        "site_plan = { file = \"sub/edr.csv\", corner = { x = \"0 m\", y = \"0 m\" }, width = \"60 m\" }\n";
    let file =
        CaseFile::parse("case.toml", &text.replace("\n[scene]\n", &format!("\n[scene]\n{plan}"))).unwrap();
    let refused = requests::site_plan_beside(&case, &file, &PROGRAM).unwrap_err().to_string();
    assert!(refused.contains("outside the folder of the case"), "{refused}");
    fs::remove_dir_all(&root).unwrap();
}

#[test]
fn an_option_of_the_wrong_type_is_refused() {
    let read = |command: &str, options: &str| {
        Request::read(command, &RequestOptions::read(options).unwrap())
            .map(drop)
            .map_err(|error| error.to_string())
    };
    for (command, options, says) in [
        ("reconstruct", r#"{"weigh": "yes"}"#, "the option weigh is true or false, not \"yes\""),
        ("avoid", r#"{"exact": 1}"#, "the option exact is true or false, not 1"),
        ("uncertainty", r#"{"outputs": "vehicle1.speed"}"#, "the option outputs is a list of texts"),
        ("uncertainty", r#"{"outputs": ["vehicle1.speed", 2]}"#, "the option outputs is a list of texts"),
        ("estimate", r#"{"prior": 3}"#, "the option prior is a word, not 3"),
    ] {
        let error = read(command, options).unwrap_err();
        assert!(error.contains(says), "{error}");
    }
    read("estimate", r#"{"prior": null, "pieces": null, "above": null}"#).unwrap();
    // Null is as good as nothing.
    let weighed = RequestOptions::read(r#"{"weigh": null}"#).unwrap().or("weigh", true);
    let Request::Reconstruct(asked) = Request::read("reconstruct", &weighed).unwrap() else { panic!() };
    assert!(asked.weigh);
}
