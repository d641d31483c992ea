//! The tables of `[vehicleN.recorder]`: read, written back, and refused at the place in the text that is
//! wrong.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use case::{CaseFile, SeriesSource, to_toml};

/// A case whose vehicle 1 has these lines in its recorder.
fn of(lines: &str) -> String {
    format!("[vehicle1.recorder]\n{lines}\n[vehicle2]\nfixed = true\n")
}

fn read(lines: &str) -> CaseFile {
    CaseFile::parse("case.toml", &of(lines)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn refused(lines: &str) -> String {
    CaseFile::parse("case.toml", &of(lines)).unwrap_err().to_string()
}

const PASTED: &str = "pre_crash = { text = \"\"\"\nTimes (sec) Speed (km/h) Brake\n-1.0 60 off\n-0.5 58 on\n0.0 47 Invalid\n\"\"\" }";

#[test]
fn a_pasted_table_lists_and_a_file_are_read_and_written_back() {
    let lists = "pre_crash = { time = \"-1 -0.5 0 s\", speed = \"60 58 47 km/h\", brake = \"off on -\" }";
    for lines in [PASTED, lists] {
        let file = read(lines);
        let recorder = file.case.vehicles[0].recorder.as_ref().unwrap();
        let given = recorder.pre_crash.as_ref().unwrap();
        let speeds: Vec<f64> =
            given.record.as_ref().unwrap().speeds().map(|(_, speed)| (speed * 3.6).round()).collect();
        assert_eq!(speeds, [60.0, 58.0, 47.0]);
        assert_eq!(given.tables[0].doubts.len(), 1);
        let again = CaseFile::parse("again.toml", &to_toml(&file.case)).unwrap();
        assert_eq!(again.case, file.case);
    }
    let file = read(
        "pre_crash = { file = \"edr.csv\" }\npulse = { time = \"0 10 20 ms\", delta_v_longitudinal = \"0 -4 -9 km/h\" }\nat = { x = \"-20 cm\", y = \"0 m\" }\nerrors = { slip_low = \"4 km/h\", friction = \"60 %\" }",
    );
    let recorder = file.case.vehicles[0].recorder.as_ref().unwrap();
    let before = recorder.pre_crash.as_ref().unwrap();
    assert!(matches!(before.source, SeriesSource::File(_)) && before.record.is_none());
    // 60 %, and not that of a surface; a slip of 4 km/h.
    let errors = recorder.errors.errors(Some(0.8), None);
    assert_eq!((errors.friction, errors.slip_low * 3.6), (0.6, 4.0));
    assert_eq!(recorder.errors.errors(None, None).latency, 0.1);
    assert_eq!(CaseFile::parse("again.toml", &to_toml(&file.case)).unwrap().case, file.case);
}

/// Two tables of one record in one text are one; data of another record or of the impact are named.
#[test]
fn the_tables_of_a_text_are_joined_or_named() {
    let pedals = "Times (sec) Service Brake Engine RPM\n-1.0 Off 1800\n0.0 On 1700\n";
    let speeds = "Times (sec) Vehicle Speed (km/h)\n-1.0 58\n0.0 48\n";
    let pulse = "Time (ms) Delta-V, longitudinal (km/h)\n0 0\n10 -5\n20 -9\n";
    let second = "Times (sec) Vehicle Speed (mph)\n-1.0 20\n0.0 10\n";
    let file = read(&format!("pre_crash = {{ text = \"\"\"\n{pedals}{speeds}{pulse}{second}\"\"\" }}"));
    let given = file.case.vehicles[0].recorder.as_ref().unwrap().pre_crash.clone().unwrap();
    let samples = given.record.as_ref().unwrap().samples();
    assert_eq!(samples.iter().map(|one| one.brake).collect::<Vec<_>>(), [Some(false), Some(true)]);
    assert_eq!(
        samples.iter().map(|one| (one.speed.unwrap() * 3.6).round()).collect::<Vec<_>>(),
        [58.0, 48.0]
    );
    let ignored: Vec<&str> = given.tables[0].ignored.iter().map(|(heading, _)| heading.as_str()).collect();
    assert_eq!(ignored, ["Delta-V, longitudinal (km/h)", "Vehicle Speed (mph)"]);
    // A pulse in two parts is one.
    let parts = "Time (ms) 0 10 20\nDelta-V, longitudinal (km/h) 0 -5 -9\nTime (ms) 30 40 50\nDelta-V, longitudinal (km/h) -12 -13 -13\n";
    let file = read(&format!("pulse = {{ text = \"\"\"\n{parts}\"\"\" }}"));
    let given = file.case.vehicles[0].recorder.as_ref().unwrap().pulse.clone().unwrap();
    assert_eq!((given.tables.len(), given.record.as_ref().unwrap().samples().len()), (1, 6));
}

/// The place of a cell of a pasted text is that in the case file.
#[test]
fn a_cell_without_a_value_has_its_place_in_the_case() {
    let file = read(PASTED);
    let given = file.case.vehicles[0].recorder.as_ref().unwrap().pre_crash.clone().unwrap();
    let SeriesSource::Text(text) = &given.source else { panic!("{:?}", given.source) };
    let place = given.tables[0].doubts[0].place;
    let at = file.source.place_in_text("vehicle1.recorder.pre_crash.text", text.as_given(), place).unwrap();
    let line = file.source.text().lines().nth(at.line - 1).unwrap();
    assert_eq!((line, at.column), ("0.0 47 Invalid", 8));
}

#[test]
fn what_is_wrong_in_a_table_is_told_at_its_place() {
    for (lines, place, words) in [
        (
            "pre_crash = { text = \"\"\"\nTime (s),Speed (knots)\n-1,3\n0,3\n\"\"\" }",
            "case.toml:3:10",
            "knots",
        ),
        (
            "pre_crash = { text = \"\"\"\nTime (s),Speed (km/h)\n-1,3\n-2,3\n0,3\n\"\"\" }",
            "case.toml:5:1",
            "follows -1",
        ),
        (
            "pre_crash = { text = \"\"\"\nTime (s) Speed (km/h) Brake\n-0.5 52 on\n0 45 on\n0.5 12 on\n\"\"\" }",
            "case.toml:6:1",
            "leave out the rows after 0",
        ),
        (
            "pre_crash = { time = \"-1 0 0.5 s\", speed = \"60 58 47 km/h\" }",
            "case.toml:2:28",
            "leave out the rows after 0",
        ),
        ("pre_crash = { time = \"-1 0 s\", speed = \"60 58 47 km/h\" }", "case.toml:2:47", "3 values"),
        ("pre_crash = { time = \"-1 0 s\", speed = \"60 58\" }", "case.toml:2:41", "no unit"),
        (
            "pre_crash = { text = \"Time (ms) 0 10\\nLongitudinal delta-V (km/h) 0 -4\" }",
            "case.toml:2:22",
            "this is a table of ΔV over time, not of speeds before the impact: the program read \"Time (ms)\" as time",
        ),
        (
            "pre_crash = { text = \"Time (ms) 0 10\\nLongitudinal delta-V (km/h) 0 -4\" }",
            "case.toml:2:22",
            "help: give it as `pulse`",
        ),
        (
            "pulse = { text = \"Time (s) -1 0\\nVehicle speed (km/h) 60 58\" }",
            "case.toml:2:18",
            "this is a table of speeds before the impact, not of ΔV over time: the program read \"Time (s)\" as time",
        ),
        (
            "pulse = { text = \"Time (s) -1 0\\nVehicle speed (km/h) 60 58\" }",
            "case.toml:2:18",
            "help: give it as `pre_crash`",
        ),
        (
            "pulse = { text = \"Time (s) -1 0\\nEngine RPM 900 1500\" }",
            "case.toml:2:18",
            "no table of ΔV over time, with times and a longitudinal or lateral ΔV, was found",
        ),
        (
            "pre_crash = { text = \"CASEID,PCODE,PTIME,PVALUE\" }",
            "case.toml:2:22",
            "no table of speeds before the impact, with times and speeds, was found: the program read nothing",
        ),
        ("pre_crash = { time = \"-1 0 s\" }", "case.toml:2:13", "pre_crash"),
        ("pre_crash = { text = \"a\", file = \"b\" }", "case.toml:2:13", "pre_crash"),
        (
            "speed = \"50 km/h\"\npre_crash = { file = \"edr.csv\" }",
            "case.toml:2:9",
            "both give the speed at impact",
        ),
        (
            "delta_v_longitudinal = \"-9 km/h\"\npulse = { file = \"edr.csv\" }",
            "case.toml:2:24",
            "both give ΔV",
        ),
        ("at = { x = \"1 m\" }", "case.toml:2:6", "y"),
        ("errors = { step = \"50 km/h\" }", "case.toml:2:19", "too large"),
        ("errors = { friction = \"200 %\" }", "case.toml:2:23", "less than 150"),
    ] {
        let error = refused(lines);
        assert!(error.contains(place) && error.contains(words), "{lines}: {error}");
    }
}

#[test]
fn several_records_are_read_and_written_back() {
    let lines = format!(
        "at = {{ x = \"-20 cm\", y = \"0 m\" }}\n[[vehicle1.recorder.records]]\n{PASTED}\ndelta_v_longitudinal = \"-30 km/h\"\n\
         [[vehicle1.recorder.records]]\nsince_previous = \"800 ms\"\nincomplete = true\nspeed = \"12 km/h\"\n\
         pulse = {{ time = \"0 10 20 ms\", delta_v_longitudinal = \"0 -4 -9 km/h\" }}"
    );
    let file = read(&lines);
    let recorder = file.case.vehicles[0].recorder.as_ref().unwrap();
    assert!(recorder.pre_crash.is_none() && recorder.records.len() == 2);
    let [first, second] = [0, 1].map(|index| recorder.record(index).unwrap());
    // The place of the recorder is that of both.
    assert!(first.at.is_some() && first.at == second.at && recorder.records[0].stored.at.is_none());
    assert_eq!(first.pre_crash.as_ref().unwrap().record.as_ref().unwrap().speeds().count(), 3);
    assert!((first.tells_delta_v(file.case.axes, 0.0).unwrap().along.unwrap() * 3.6 + 30.0).abs() < 1e-9);
    assert_eq!(recorder.records[1].since_previous.unwrap().si(), 0.8);
    // A record that was not finished gives no ΔV, but keeps its speed.
    assert_eq!(second.tells_delta_v(file.case.axes, 0.0), None);
    assert!(second.tells_speed(None).is_some());
    assert_eq!(CaseFile::parse("again.toml", &to_toml(&file.case)).unwrap().case, file.case);
}

/// A probability may be 0 or 1; more is none.
#[test]
fn a_probability_may_be_certain() {
    for key in ["brake_comes_on", "last_is_of_impact"] {
        let of_percent = |percent: &str| {
            let lines = format!("{PASTED}\nerrors = {{ {key} = \"{percent} %\" }}");
            CaseFile::parse("case.toml", &of(&lines)).map(drop).map_err(|errors| errors.to_string())
        };
        for percent in ["0", "100"] {
            of_percent(percent).unwrap();
        }
        for percent in ["-1", "100.1"] {
            assert!(of_percent(percent).unwrap_err().contains("from 0 to 100"), "{key} {percent}");
        }
    }
}

/// Pushed to the left by 7 and back by 24 km/h, the force came from the right of the front: atan(7/24) =
/// 16.26° clockwise, and the size is 25 km/h; with the other axes from the left.
#[test]
fn a_record_shows_where_its_force_came_from() {
    let lines = "records = [{ delta_v_longitudinal = \"-24 km/h\", delta_v_lateral = \"7 km/h\" }]";
    for (axes, sense) in [("", 1.0), ("[scene]\naxes = \"z-down\"\n", -1.0)] {
        let file = CaseFile::parse("case.toml", &format!("{axes}{}", of(lines))).unwrap();
        let record = file.case.vehicles[0].recorder.as_ref().unwrap().record(0).unwrap();
        let event = record.event(file.case.axes, 0.0);
        assert!((event.delta_v.unwrap() * 3.6 - 25.0).abs() < 1e-9 && event.complete, "{event:?}");
        let direction = event.force_direction.unwrap().to_degrees();
        assert!((direction - sense * 16.260_204_7).abs() < 1e-6, "{direction}");
    }
}

#[test]
fn records_that_say_too_much_or_nothing_are_refused_at_their_place() {
    for (lines, place, words) in [
        (
            "speed = \"50 km/h\"\nrecords = [{ speed = \"40 km/h\" }]",
            "case.toml:2:9",
            "belongs to one record",
        ),
        ("records = []", "case.toml:2:11", "an empty list"),
        (
            "records = [{ }, { since_previous = \"0.8 s\", speed = \"41 km/h\" }]",
            "case.toml:2:12",
            "records[1]\" gives none of its keys",
        ),
        ("records = [{ since_previous = \"1 s\", speed = \"40 km/h\" }]", "case.toml:2:31", "none before it"),
        (
            "records = [{ speed = \"4 km/h\", pre_crash = { file = \"edr.csv\" } }]",
            "case.toml:2:22",
            "both give the speed at impact",
        ),
        ("records = [{ at = { x = \"1 m\" } }]", "case.toml:2:14", "unknown key"),
        ("speed = \"50 km/h\"\nother_impacts = [{ pdof = \"90 deg\" }]", "case.toml:3", "when"),
        ("speed = \"50 km/h\"\nother_impacts = [{ when = \"after\" }]", "case.toml:3", "pdof"),
        (
            "speed = \"50 km/h\"\nother_impacts = [{ when = \"after\", pdof = \"90 deg\" }, { when = \"before\", pdof = \"0 deg\" }]",
            "case.toml:3:1",
            "write them in the order of time",
        ),
        ("records = [{ pre_crash = { time = \"-1 0 s\", speed = \"60 58 47 km/h\" } }]", "2:60", "3 values"),
    ] {
        let error = refused(lines);
        assert!(error.contains(place) && error.contains(words), "{lines}: {error}");
    }
}

/// A record of a long table of NHTSA, chosen by `rows`, in the case or beside it.
#[test]
fn rows_of_a_long_table_are_chosen() {
    const LONG: &str =
        "VEHNO,EDREVENTNO,PCODE,PTIME,PVALUE\n1,1,1010,-1,58\n1,1,1010,0,40\n1,2,1010,-1,41\n1,2,1010,0,39\n";
    let of = |rows: &str| format!("pre_crash = {{ text = \"\"\"\n{LONG}\"\"\"{rows} }}");
    let file = read(&of(", rows = \"EDREVENTNO 2\""));
    let given = file.case.vehicles[0].recorder.as_ref().unwrap().pre_crash.clone().unwrap();
    let speeds: Vec<f64> = given.record.as_ref().unwrap().speeds().map(|(_, speed)| speed * 3.6).collect();
    assert!((speeds[0] - 41.0).abs() < 1e-9 && (speeds[1] - 39.0).abs() < 1e-9, "{speeds:?}");
    assert_eq!(CaseFile::parse("again.toml", &to_toml(&file.case)).unwrap().case, file.case);
    assert!(refused(&of("")).contains("rows = \"EDREVENTNO 1\""));
    let wrong = refused(&of(", rows = \"EDREVENTNO 7\""));
    assert!(wrong.contains("no row has EDREVENTNO 7") && wrong.contains("case.toml:8:"), "{wrong}");
    let lists = "pre_crash = { time = \"-1 0 s\", speed = \"60 58 km/h\", rows = \"VEHNO 1\" }";
    assert!(refused(lists).contains("pre_crash"));
}
