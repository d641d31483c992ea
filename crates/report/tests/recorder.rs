//! The pulse of a recorder in reports.

use std::ops::ControlFlow;

use analysis::{EstimatePlan, PieceDetail, reconstruct, weigh};
use case::CaseFile;
use report::Units;
use serde_json::Value;

/// An axis that ends before the other was stored all the same, unlike one that was not.
#[test]
fn an_axis_that_ends_early_was_stored() {
    let told = |lateral: &str| {
        let text = format!(
            "[vehicle1.recorder]\npulse = {{ time = \"0 10 20 30 40 50 60 ms\", \
             delta_v_longitudinal = \"0 -5 -12 -18 -20 -20 -20 km/h\"{lateral} }}\n"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text()
    };
    let (alone, ended) = ("Only longitudinal ΔV was stored", "After 30 ms only one axis has a ΔV");
    let both = ", delta_v_lateral = \"0 1 3 5 5 5 5 km/h\"";
    let early = ", delta_v_lateral = \"0 1 3 5 - - - km/h\"";
    for (lateral, is_alone, has_ended) in [("", true, false), (both, false, false), (early, false, true)] {
        let text = told(lateral);
        assert_eq!([text.contains(alone), text.contains(ended)], [is_alone, has_ended], "{text}");
    }
}

/// The same recorder with a complete record, one that was cut off, and one whose place makes no bound of its
/// ΔV: by hand, 0.9 m · π/2 rad/s = 5.09 km/h less than the 23 km/h at its place, and of 4 km/h nothing.
/// Without the yaw rate, ΔV applies at the place of the recorder.
#[test]
fn the_headline_says_where_delta_v_holds() {
    let cut = "-2 -5 -9 -13 -16 -18 -20 -21 -22 -23 km/h";
    let whole = "-2 -5 -9 -13 -16 -18 -23 -23 -23 -23 km/h";
    let small = "0 -1 -1 -2 -2 -2 -3 -3 -3 -4 km/h";
    let yaw_rate = "yaw_rate = \"90 deg/s\"";
    let expected = [
        (
            whole,
            yaw_rate,
            "17.9 km/h (longitudinal only) at its centre of gravity, at",
            "where ΔV is 17.9 km/h backward",
        ),
        (
            cut,
            yaw_rate,
            "at least 17.9 km/h (longitudinal only) at its centre of gravity, because",
            "where ΔV is at least 17.9 km/h backward",
        ),
        (
            small,
            yaw_rate,
            "at least 4.0 km/h (longitudinal only) at the place of its recorder, because",
            "gives no lower bound of ΔV",
        ),
        (
            cut,
            "",
            "at least 23.0 km/h (longitudinal only) at the place of its recorder, because",
            "ΔV applies at the place of the recorder",
        ),
    ];
    for (pulse, yaw_rate, headline, place) in expected {
        let text = format!(
            "[vehicle1.recorder]\nat = {{ x = \"-1 m\", y = \"0.9 m\" }}\n{yaw_rate}\npulse = {{ time = \
             \"10 20 30 40 50 60 70 80 90 100 ms\", delta_v_longitudinal = \"{pulse}\" }}\n"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(&format!("ΔV of vehicle 1: {headline}")) && text.contains(place), "{text}");
    }
}

/// (m/s) of the JSON of a recorder in these axes: -20 km/h along and 10 to the right, whole or cut off; 0.9 m
/// to the left of the centre of gravity, where ΔV along it is less by 0.9 m · π/2 rad/s = 5.09 km/h.
#[test]
fn delta_v_in_json_is_in_the_axes_of_the_case() {
    let pulse = |axes: &str, side: &str, lines: &str, end: &str| {
        let text = format!(
            "[scene]\naxes = \"{axes}\"\n[vehicle1.recorder]\nat = {{ x = \"0 m\", y = \"{side}\" }}\n{lines}\n\
             pulse = {{ time = \"0 10 20 30 40 50 60 ms\", delta_v_longitudinal = \"0 -5 -10 -15 {end} km/h\", \
             delta_v_lateral = \"0 3 5 8 10 10 10 km/h\" }}\n"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let reading = analysis::recorders(&file.case).unwrap();
        let json: Value = serde_json::from_str(&report::recorders_json(&file, &reading).unwrap()).unwrap();
        json["vehicles"][0]["pulse"].clone()
    };
    let kmh = |pair: &Value| [0, 1].map(|k| (pair[k].as_f64().unwrap() * 360.0).round() / 100.0);
    let whole = "-20 -20 -20";
    for (axes, side, yaw_rate, across) in
        [("z-up", "0.9 m", "90 deg/s", -10.0), ("z-down", "-0.9 m", "-90 deg/s", 10.0)]
    {
        let turned = format!("yaw_rate = \"{yaw_rate}\"");
        let found = pulse(axes, side, &turned, whole);
        assert_eq!(kmh(&found["delta_v_at_recorder"]), [-20.0, across], "{found}");
        assert_eq!(kmh(&found["delta_v_at_center"]), [-14.91, across], "{found}");
        assert!(found["least_delta_v_at_recorder"].is_null() && found["least_delta_v_at_center"].is_null());
        // As stored, whatever the axes.
        assert!((found["spans"][2]["lateral"].as_f64().unwrap() * 3.6 - 10.0).abs() < 1e-9, "{found}");
        let cut = pulse(axes, side, &turned, "-20 -25 -30");
        assert_eq!(kmh(&cut["least_delta_v_at_recorder"]), [-30.0, across], "{cut}");
        assert_eq!(kmh(&cut["least_delta_v_at_center"]), [-24.91, across], "{cut}");
        assert!(cut["delta_v_at_recorder"].is_null() && cut["delta_v_at_center"].is_null());
        // Without the yaw rate, nothing is converted.
        let alone = pulse(axes, side, "", whole);
        assert_eq!(kmh(&alone["delta_v_at_recorder"]), [-20.0, across], "{alone}");
        assert!(alone["delta_v_at_center"].is_null(), "{alone}");
    }
}

/// A second table is read if all its times are before the impact, and it gives nothing twice.
#[test]
fn a_table_that_is_not_read_has_a_reason() {
    let told = |second: &str| {
        let first = "Time (s) Vehicle speed (km/h)\n-1.0 60\n-0.5 55\n0.0 50\n\n";
        let text = format!("[vehicle1.recorder]\npre_crash = {{ text = \"\"\"\n{first}{second}\"\"\" }}\n");
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let pedals = "Time (s) Brake Steering (deg)\n-1.0 Off 0\n-0.5 On 0\n0.0 On 5\n";
    assert!(!told(pedals).contains("Not read"));
    for (second, reason) in [
        (
            pedals.replace("0.0 On", "0.25 On"),
            "Not read: \"Brake\", \"Steering (deg)\", because the table has a time after the impact, 0.250 s.",
        ),
        (
            "Time (s) Vehicle speed (km/h) Brake\n-0.8 31 Off\n-0.3 30 On\n".to_owned(),
            "Not read: \"Vehicle speed (km/h)\", \"Brake\", because the table that was read has a speed for the same times, from -0.800 s on.",
        ),
    ] {
        assert!(told(&second).contains(reason), "{}", told(&second));
    }
}

/// 30 km/h along and 40 km/h across are 50 km/h; each axis alone is named.
#[test]
fn the_headline_names_the_axis_that_was_stored() {
    let rising =
        |size: i32| (0..15).map(|k| (size * k.min(10) / 10).to_string()).collect::<Vec<_>>().join(" ");
    let axis = |name: &str, size: i32| format!(", delta_v_{name} = \"{} km/h\"", rising(size));
    let (along, across) = (axis("longitudinal", -30), axis("lateral", 40));
    let expected = [
        (along.clone(), "30.0 km/h (longitudinal only), at"),
        (across.clone(), "40.0 km/h (lateral only), at"),
        (along + &across, "50.0 km/h, at"),
    ];
    for (axes, headline) in expected {
        let times = (0..15).map(|k| (10 * k).to_string()).collect::<Vec<_>>().join(" ");
        let text = format!("[vehicle1.recorder]\npulse = {{ time = \"{times} ms\"{axes} }}\n");
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
        assert!(text.contains(&format!("ΔV of vehicle 1: {headline}")), "{text}");
    }
}

/// Where all the evidence gives the answer, a bound above its interval is a warning on the answer, as in an
/// estimate, and on the exact solution that is shown with it.
#[test]
fn a_record_above_all_answers_is_told_where_all_evidence_leads() {
    let codes = |list: &Value| -> Vec<String> {
        let list = list.as_array().into_iter().flatten();
        list.map(|one| one["code"].as_str().unwrap().to_owned()).collect()
    };
    let crossing = include_str!("../../case/templates/si/intersection.toml");
    for (speed, is_below) in [(10, false), (200, true)] {
        let recorder =
            format!("\n[vehicle1.recorder]\nincomplete = true\ndelta_v_longitudinal = \"-{speed} km/h\"\n");
        let file = CaseFile::parse("case.toml", &(crossing.to_owned() + &recorder)).unwrap();
        let exact = reconstruct(&file.case).unwrap();
        let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: PieceDetail::Weighed };
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let weighed = weigh(&file.case, &exact, &plan, quietly).unwrap().unwrap();
        let text = report::weighed(&file.case, &exact, &weighed, Units::Si).text();
        assert_eq!(text.matches("[below-record]").count(), if is_below { 2 } else { 0 }, "{text}");
        let json: Value =
            serde_json::from_str(&report::weighed_json(&file, &exact, &weighed).unwrap()).unwrap();
        for list in ["warnings", "solution_warnings"] {
            let told = codes(&json[list]).contains(&"below-record".to_owned());
            assert_eq!(told, is_below, "{list}: {}", json[list]);
        }
    }
}

/// 60 km/h with the brake off and 1 s left, and no error but that the brake may come on, with 25 % in each
/// half second: 1 − 0.75² = 0.4375, at any instant, so for 0.5 s on average, at 0.375 g on average. The mean
/// falls by 0.4375 · 0.5 · 0.375 · 9.80665 = 0.8045 m/s = 2.90 km/h; the median stays, as it did not come on
/// with 56 %.
#[test]
fn the_headline_is_the_median_and_the_account_the_mean() {
    let text = "[vehicle1.recorder]\npre_crash = { time = \"-3 -2 -1 s\", speed = \"60 60 60 km/h\", brake = \"off off off\" }\n\
                errors = { step = \"0 km/h\", steady_low = \"0 %\", steady_sd = \"0 %\", tyre_sd = \"0 %\", slip_low = \"0 km/h\", \
                slip_sd = \"0 km/h\", friction = \"75 %\", coasting = \"0 %\", brake_comes_on = \"25 %\", latency = \"0 s\" }\n";
    let file = CaseFile::parse("case.toml", text).unwrap();
    let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
    assert!(text.contains("Speed of vehicle 1 at the impact: 60.0 km/h (95 %: "), "{text}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("mean at the impact 57.1 "), "{text}");
    assert!(words.contains("median at the impact: as above 60.0 "), "{text}");
}

/// The step is that of the speeds, unless the case states one.
#[test]
fn the_report_says_how_the_step_was_found() {
    let told = |speeds: &str, errors: &str| {
        let text = format!(
            "[vehicle1.recorder]\npre_crash = {{ time = \"-5 -4 -3 -2 -1 0 s\", speed = \"{speeds}\" }}\n{errors}"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let reading = analysis::recorders(&file.case).unwrap();
        let json: Value = serde_json::from_str(&report::recorders_json(&file, &reading).unwrap()).unwrap();
        let text = report::recorders(&file, &reading, Units::Si).text();
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        (
            words,
            json["vehicles"][0]["step"].as_f64().unwrap() * 3.6,
            json["vehicles"][0]["step_source"].clone(),
        )
    };
    let fives = "70 65 60 55 50 45 km/h";
    for (speeds, errors, words, step, source) in [
        (fives, "", "to 5.0 km/h (all 6 different speeds are multiples of it)", 5.0, "multiples"),
        (fives, "errors = { step = \"1 km/h\" }\n", "to 1.0 km/h (`step` of the case)", 1.0, "case"),
        ("70 65 61 55 50 45 km/h", "", "to 1.0 km/h (the step of 49 CFR 563, as", 1.0, "regular"),
    ] {
        let (text, found, how) = told(speeds, errors);
        assert!(text.contains(&format!("Rounding: {words}")), "{text}");
        assert!((found - step).abs() < 1e-9 && how == source, "{found} {how}");
    }
}

/// The threshold of the text is that of the weight: a fall of 1.13 g is rare, one of more than 1.2 g no
/// tyre's.
#[test]
fn a_steep_fall_has_one_threshold() {
    let text = "[vehicle1.recorder]\npre_crash = { time = \"-1 -0.5 0 s\", speed = \"80 78 57 km/h\", brake = \"on on on\" }\n";
    let file = CaseFile::parse("case.toml", text).unwrap();
    let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("Few tyres do that, and none more than 1.2 g"), "{text}");
    assert!(words.contains("more than 1 g, and none by more than 1.2 g"), "{text}");
}

/// Neither speed after a steep fall is hidden behind the median of both. Hard braking reads 3 km/h low and
/// takes 0.66 km/h in the age of the speed: 42.3. The other is 108 km/h, 1.74 low, less 3.97 in half a second
/// of braking: 105.8.
#[test]
fn a_steep_fall_has_both_speeds_in_the_headline() {
    let text = "[vehicle1.recorder]\npre_crash = { time = \"-1 -0.5 0 s\", speed = \"110 108 40 km/h\", brake = \"on on on\" }\n";
    let file = CaseFile::parse("case.toml", text).unwrap();
    let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("it is about 42.3 km/h (50 %) or about 105.8 km/h (50 %), hardly in between"),
        "{text}"
    );
}

/// Two records of one axis: their ΔV is marked, and they have no PDOF.
#[test]
fn a_record_of_one_axis_is_marked() {
    let text = "[vehicle1.crush]\nside = \"front\"\nwidth = \"1.5 m\"\ndepths = \"30 30 cm\"\nstiffness = { category = 3 }\n\
                pdof = \"30 deg\"\n[[vehicle1.recorder.records]]\ndelta_v_longitudinal = \"-9 km/h\"\n\
                [[vehicle1.recorder.records]]\nsince_previous = \"1 s\"\ndelta_v_longitudinal = \"-30 km/h\"\n\
                delta_v_lateral = \"4 km/h\"\n";
    let file = CaseFile::parse("case.toml", text).unwrap();
    let reading = analysis::recorders(&file.case).unwrap();
    let page = report::recorders(&file, &reading, Units::Si).text();
    let row = page.lines().find(|line| line.contains("9.0 x")).unwrap_or_else(|| panic!("{page}"));
    assert!(row.contains('–'), "{page}");
    assert!(page.contains("x: along the vehicle only"), "{page}");
    assert_eq!(page.matches(" x ").count(), 1, "{page}");
    let json: Value = serde_json::from_str(&report::recorders_json(&file, &reading).unwrap()).unwrap();
    let vehicle = &json["vehicles"][0];
    let records = [&vehicle["record"], &vehicle["other_records"][0]["record"]];
    let one = records.iter().find(|record| record["axis"] == "longitudinal").unwrap();
    assert!(one["pdof"].is_null() && (one["delta_v"].as_f64().unwrap() * 3.6 - 9.0).abs() < 1e-9, "{one}");
    assert_eq!(records.iter().filter(|record| record["axis"].is_null()).count(), 1);
}

/// The command that evaluates recorders alone is listed where a recorder has a table: a file that was not
/// read prevents it, and stored numbers do not need it.
#[test]
fn what_a_case_can_do_includes_its_recorder() {
    let columns = "pre_crash = { time = \"-1 0 s\", speed = \"50 50 km/h\" }";
    let expected = [
        (columns, Some(true), "recorder has all that it needs"),
        (
            "pre_crash = { file = \"edr.csv\" }",
            Some(false),
            "recorder cannot run the file edr.csv of the recorder was not read",
        ),
        ("speed = \"50 km/h\"", None, "Commands"),
    ];
    for (lines, runs, words) in expected {
        let file = CaseFile::parse("case.toml", &format!("[vehicle1.recorder]\n{lines}\n")).unwrap();
        let judgement = analysis::judge(&file.case);
        let text = report::judgement(&file, &judgement, Units::Si).text();
        assert!(text.split_whitespace().collect::<Vec<_>>().join(" ").contains(words), "{text}");
        let json: Value = serde_json::from_str(&report::judgement_json(&file, &judgement).unwrap()).unwrap();
        let commands = json["commands"].as_array().unwrap();
        let found = commands.iter().find(|one| one["command"] == "recorder");
        assert_eq!(found.map(|one| one["runs"].as_bool().unwrap()), runs, "{json}");
    }
}

/// Stored 0 km/h, rounded to 1: the true speed was between 0 and 0.5 km/h, never below 0. The table adds up.
#[test]
fn the_speed_of_a_vehicle_that_stood_adds_up() {
    let text = "[vehicle1.recorder.pre_crash]\ntime = \"-2.0 -1.5 -1.0 -0.5 0.0 s\"\nspeed = \"0 0 0 0 0 km/h\"\n\
                brake = \"off off off off off\"\n";
    let file = CaseFile::parse("case.toml", text).unwrap();
    let text = report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text();
    let number = |row: &str| -> f64 {
        let line = text
            .lines()
            .find(|line| line.trim_start().starts_with(row))
            .unwrap_or_else(|| panic!("{row}: {text}"));
        line.trim_start()[row.len()..].split_whitespace().next().unwrap().parse().unwrap()
    };
    let cut = number("cut off at 0: it did not go backward");
    assert!(cut > 0.0 && (cut - number("mean at the impact")).abs() < 1e-9, "{text}");
}

/// The charts over time have one axis, each stored value is a dot, and only the end that the program found is
/// dashed. Nothing is explained that no chart has.
#[test]
fn the_charts_show_what_was_stored() {
    let svg = |speed: &str, pulse: &str| {
        let text = format!(
            "[vehicle1.recorder]\npre_crash = {{ time = \"-5 -4 -3 -2 -1 0 s\", speed = \"{speed}\", \
             brake = \"off off off on on -\" }}\n{pulse}"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).html()
    };
    let attribute = |svg: &str, id: &str, name: &str| -> f64 {
        let start = svg.find(&format!("id=\"{id}\"")).unwrap_or_else(|| panic!("{id}"));
        let value = svg[start..].split_once(&format!("{name}=\"")).unwrap().1;
        value.split_once('"').unwrap().0.parse().unwrap()
    };
    let dots = |svg: &str, chart: u8| svg.matches(&format!("id=\"recorder-1-sample-{chart}-")).count();
    let explained = |svg: &str, words: &str| svg.contains(&format!(">{words}<"));
    let [stored, found_end] = ["stored value", "to the median of the speed at impact"];
    // The last speed is missing, so that of the impact is found; a speed in between is missing, too.
    let found = svg("60 - 58 55 50 - km/h", "");
    assert_eq!([dots(&found, 1), dots(&found, 2), dots(&found, 3)], [4, 5, 4]);
    let [first, last] = [1, 5].map(|k| attribute(&found, &format!("recorder-1-sample-2-{k}"), "cx"));
    let [start, end] = [1, 4].map(|k| attribute(&found, &format!("recorder-1-sample-1-{k}"), "cx"));
    assert_eq!([first, last], [start, end], "-5 s and -1 s stand at two places");
    assert!(found.contains("id=\"recorder-1-computed-1\"") && found.contains("id=\"recorder-1-computed-3\""));
    assert!(!found.contains("id=\"recorder-1-computed-2\""));
    assert!(explained(&found, stored) && explained(&found, found_end));
    let whole = svg("60 59 58 55 50 45 km/h", "");
    assert_eq!(dots(&whole, 1), 6);
    assert!(!whole.contains("recorder-1-computed") && !explained(&whole, found_end));
    // A pulse along one axis alone.
    let pulse = "pulse = { time = \"0 10 20 30 40 50 60 ms\", delta_v_longitudinal = \"0 -5 -12 -18 -20 -20 -20 km/h\" }\n";
    let along = svg("60 59 58 55 50 45 km/h", pulse);
    assert!(explained(&along, "longitudinal ΔV, positive forward"));
    assert!(!explained(&along, "lateral ΔV, positive to the right"));
    assert!(explained(&along, "begin and end of the impact, 49 CFR 563.5"));
    let shown =
        "Charts of vehicle 1: speed over time, service brake, speed over distance, ΔV during the impact";
    assert!(along.contains(shown));
}
