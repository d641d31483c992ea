//! `deltav validate --field FILE --judge COLUMN`: another program by the same recorders.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// Two made-up pairs of fronts. The recorders of both vehicles 1 stored 30 km/h along and 40 across: 50 km/h.
fn table() -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("judged.csv");
    let columns = "CURBWT,CARGOWT,CDCPLANE,PDOF,HEADINGANG,FIELDL,DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,DVTOTAL,DVLONG,\
                   MAXDVLONG,MAXDVLAT,LOW,HIGH";
    let of = |vehicle: u8| {
        columns.split(',').map(|name| format!("{name}_{vehicle}")).collect::<Vec<_>>().join(",")
    };
    let vehicle = |ends: &str| format!("1500,,F,0,0,150,150,0,20,20,20,20,20,20,{ends}");
    let mut text = format!("CASEID,{},{}\n", of(1), of(2));
    for (case, one) in [("7", "55,-30,-30,40,45,60"), ("8", "40,-30,-30,40,30,45")] {
        text += &format!("{case},{},{}\n", vehicle(one), vehicle(",,,,,"));
    }
    fs::write(&path, text).unwrap();
    path
}

fn judge(arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_deltav");
    Command::new(program).args(["validate", "--field"]).arg(table()).args(arguments).output().unwrap()
}

#[test]
fn another_program_is_judged_by_the_recorders() {
    let output = judge(&["--judge", "DVTOTAL,LOW,HIGH", "--format", "json"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let all = &json["groups"]["all"];
    // ln(55/50) and ln(40/50); one of two inside; scores of 15 and 15 + 40 · 5 km/h.
    let bias = (1.1_f64.ln() + 0.8_f64.ln()) / 2.0;
    assert!((all["bias"].as_f64().unwrap() - bias).abs() < 1e-12, "{text}");
    assert_eq!((&all["n"], &all["coverage95"]), (&2.into(), &0.5.into()));
    assert!((all["interval_score"].as_f64().unwrap() * 3.6 - 115.0).abs() < 1e-9);
    assert_eq!(json["judged"][0]["case"], "7");
    let output = judge(&["--judge", "DVTOTAL"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("ΔV by DVTOTAL against ΔV by recorder") && text.contains("7.50"), "{text}");
    assert!(!text.contains("in 95 %"), "{text}");
}

#[test]
fn what_is_no_column_is_refused() {
    for (columns, words) in [
        ("MINE", "there is no column MINE_1"),
        ("DVTOTAL,LOW", "write COLUMN, or COLUMN,LOW,HIGH"),
        ("DVTOTAL,HIGH,HIGH", "an end of an interval that contains its own value"),
    ] {
        let output = judge(&["--judge", columns]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) || output.status.code() == Some(1), "{message}");
        assert!(message.contains(words), "{message}");
    }
    let output = judge(&["--judge", "DVTOTAL", "--other"]);
    assert_eq!(output.status.code(), Some(2));
}

/// An option for one kind of table that another kind does not have would be ignored in silence.
#[test]
fn what_a_kind_of_table_has_no_use_for_is_refused() {
    for option in [&["--other"][..], &["--objects"], &["--judge", "DVTOTAL"]] {
        let program = env!("CARGO_BIN_EXE_deltav");
        let output = Command::new(program)
            .args(["validate", "--recorders", "none.csv"])
            .args(option)
            .output()
            .unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("cannot be used with") && message.contains(option[0]), "{message}");
    }
}
