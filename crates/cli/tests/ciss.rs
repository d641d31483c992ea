//! `deltav validate --field` with NHTSA's download of CISS.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Crash 7: vehicles 1 and 2 struck each other in event 1, and vehicle 2 a tree in event 2; the pair of crash
/// 8 has no PDOF. Made up, in the layout of CISS.
const TABLES: [(&str, &str); 4] = [
    ("CRASH.csv", "CASEID,CRASHYEAR,PSU\n7,2017,10\n8,2017,10\n"),
    (
        "GV.csv",
        "CASEID,VEHNO,MAKE,MODEL,MODELYR,BODYTYPE,CURBWT,CARGOWT,DVANGTHIS\n7,2,20,999,2012,4,1400,9999,361\n\
         7,1,99,401,9999,88,1500,0,90\n8,1,20,401,2012,4,1500,0,90\n8,2,20,401,2012,4,1500,0,90\n",
    ),
    (
        "CDC.csv",
        "CASEID,EVENTNO,VEHNO,OBJCONT,CDCPLANE,CDC,PDOF,HEADINGANG,FIELDL,FIELDLD,DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,\
         CMAX,DVTOTAL,DVLONG,DVLAT,DVENERGY\n\
         7,1,2,1,L,10LYEW02,290,888,191,95,888,109,3,20,28,17,13,18,28,22,-14,17,47152\n\
         7,1,1,2,F,01FDEW02,40,350,154,0,154,12.5,3,20,31,32,40,40,999,25,-19,-16,9999997\n\
         7,2,2,42,F,12FDEW02,888,888,120,0,120,0,1,2,3,4,5,6,6,,,,\n\
         8,1,1,2,F,01FDEW02,888,350,154,0,154,12,3,20,31,32,40,40,40,,,,\n\
         8,1,2,1,F,01FDEW02,0,350,154,0,154,12,3,20,31,32,40,40,40,,,,\n",
    ),
    (
        "EDREVENT.csv",
        "CASEID,VEHNO,EDRSUMMNO,EDREVENTNO,CDCEVENT,MAXDVLONG,MAXDVLAT\n7,1,1,1,1,-12,997\n7,1,1,2,1,-20,5.25\n\
         7,2,1,1,2,-15.5,.\n",
    ),
];

/// The same tables as SAS files, which ReadStat wrote.
const SAS: &[u8] = include_bytes!("ciss-sas.zip");

/// The pair of crash 7, by hand.
const PAIR: &str = "2017,7,1,1,99,401,,88,1500,0,F,01FDEW02,40,350,90,154,0,154,12.5,3,20,31,32,40,40,,25,-19,-16,,\
                    -20.0,5.25,2,20,999,2012,4,1400,,L,10LYEW02,290,,,191,95,,109,3,20,28,17,13,18,28,22,-14,17,47152,,\n";

/// The table of pairs that contains these lines.
fn pairs(lines: &[&str]) -> String {
    let names = "VEHNO,MAKE,MODEL,MODELYR,BODYTYPE,CURBWT,CARGOWT,CDCPLANE,CDC,PDOF,HEADINGANG,DVANGTHIS,FIELDL,FIELDLD,\
                 DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,CMAX,DVTOTAL,DVLONG,DVLAT,DVENERGY,MAXDVLONG,MAXDVLAT";
    let of = |vehicle| names.split(',').map(|name| format!("{name}_{vehicle}")).collect::<Vec<_>>().join(",");
    format!("YEAR,CASEID,EVENTNO,{},{}\n{}", of(1), of(2), lines.concat())
}

/// An empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("ciss").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn write_folder(folder: &Path, change: impl Fn(&str) -> String) {
    fs::create_dir_all(folder).unwrap();
    for (name, text) in TABLES {
        fs::write(folder.join(name), change(text)).unwrap();
    }
}

/// Half of the tables as they are, half packed, in a folder, with a name in small letters.
fn write_zip(path: &Path, leave_out: &str, change: impl Fn(&str) -> String) {
    let mut writer = ZipWriter::new(File::create(path).unwrap());
    for (place, (name, text)) in TABLES.into_iter().enumerate() {
        let method = [CompressionMethod::Stored, CompressionMethod::Deflated][place % 2];
        if name != leave_out {
            let options = SimpleFileOptions::default().compression_method(method);
            writer.start_file(format!("../CISS/{}", name.to_lowercase()), options).unwrap();
            writer.write_all(change(text).as_bytes()).unwrap();
        }
    }
    writer.finish().unwrap();
}

/// The exit status, and what is written to standard output and standard error.
fn validate(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_deltav"));
    let output = command.current_dir(folder).arg("validate").args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let (status, text, message) = validate(folder, &[arguments, &["--format", "json"]].concat());
    assert_eq!(status, Some(0), "{message}");
    serde_json::from_str(&text).unwrap()
}

/// From a folder, from a ZIP file and from the table by hand: one judgement, to the last bit.
#[test]
fn the_download_is_judged_as_the_table_that_it_makes() {
    let work = folder("same");
    write_folder(&work.join("CISS_2017"), str::to_owned);
    write_zip(&work.join("2017.zip"), "", |text| text.replace('\n', "\r\n"));
    fs::write(work.join("sas.zip"), SAS).unwrap();
    let table = pairs(&[PAIR]);
    fs::write(work.join("pairs.csv"), &table).unwrap();
    let mut by_hand = json(&work, &["--field", "pairs.csv"]);
    assert_eq!(by_hand["data"].as_object_mut().unwrap().len(), 1);
    assert_eq!(by_hand["data"]["sha256"], report::sha256(table.as_bytes()).as_str());
    assert_eq!((&by_hand["program"]["name"], &by_hand["pairs"]), (&"deltav".into(), &1.into()));
    for source in ["CISS_2017", "2017.zip", "sas.zip"] {
        let mut found = json(&work, &["--field", source]);
        let years = found["data"].as_object_mut().unwrap().remove("years").unwrap();
        assert_eq!(found, by_hand, "{source}");
        let [year] = years.as_array().unwrap().as_slice() else { unreachable!("one year") };
        assert_eq!((&year["source"], &year["crashes"]), (&source.into(), &1.into()));
        assert_eq!(year["left_out"], serde_json::json!({ "without PDOF of both": 1 }));
        let tables: Vec<_> =
            year["tables"].as_array().unwrap().iter().map(|table| (&table["name"], &table["rows"])).collect();
        let rows = [("CRASH", 2), ("GV", 4), ("CDC", 5), ("EDREVENT", 3)]
            .map(|(name, rows)| (Value::from(name), Value::from(rows)));
        assert_eq!(tables, rows.each_ref().map(|(name, rows)| (name, rows)));
    }
    let years = &json(&work, &["--field", "CISS_2017"])["data"]["years"];
    assert_eq!(years[0]["tables"][0]["sha256"], report::sha256(TABLES[0].1.as_bytes()).as_str());
    let (_, text, _) = validate(&work, &["--field", "2017.zip", "--judge", "DVTOTAL"]);
    let lines: Vec<Vec<_>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    for line in ["CDC 5 2017.zip: ../CISS/cdc.csv", "left out, without PDOF of both 1"] {
        assert!(lines.contains(&line.split(' ').collect()), "{text}");
    }
}

#[test]
fn several_years_are_judged_together() {
    let work = folder("years");
    write_zip(&work.join("a.ZIP"), "", str::to_owned);
    let later = |text: &str| text.replace("2017", "2018");
    write_folder(&work.join("later"), later);
    fs::write(work.join("readme.txt"), "not a table").unwrap();
    let mut manual = ZipWriter::new(File::create(work.join("manual.zip")).unwrap());
    manual.start_file("manual.pdf", SimpleFileOptions::default()).unwrap();
    manual.finish().unwrap();
    let both = json(&work, &["--field", "a.ZIP", "--field", "later"]);
    let cases: Vec<_> = both["judged"].as_array().unwrap().iter().map(|judged| &judged["case"]).collect();
    assert_eq!(cases, ["7 of 2017", "7 of 2018"]);
    let table = pairs(&[PAIR, &later(PAIR)]);
    assert_eq!(both["data"]["sha256"], report::sha256(table.as_bytes()).as_str());
    // The folder that contains both, and other files.
    let mut of_folder = json(&work, &["--field", "."]);
    let years = of_folder["data"]["years"].as_array_mut().unwrap();
    assert_eq!(years.len(), 2);
    assert_eq!(of_folder["judged"], both["judged"]);
}

#[test]
fn objects_of_the_download_are_judged_instead_of_pairs() {
    let work = folder("objects");
    write_folder(&work, str::to_owned);
    let found = json(&work, &["--field", ".", "--objects"]);
    assert_eq!(
        (&found["objects"], &found["pairs"], &found["judged"][0]["kind"]),
        (&true.into(), &1.into(), &"tree-pole".into())
    );
    let (status, _, message) = validate(&work, &["--field", ".", "--objects", "--other"]);
    assert_eq!(status, Some(2), "{message}");
}

#[test]
fn what_is_wrong_with_a_download_is_named() {
    let work = folder("wrong");
    write_zip(&work.join("good.zip"), "", str::to_owned);
    write_zip(&work.join("no-gv.zip"), "GV.csv", str::to_owned);
    write_zip(&work.join("deep.zip"), "", |text| text.replace("32,40,40,999", "32,40,deep,999"));
    write_zip(&work.join("none.zip"), "", |text| text.replace("7,1,1,2,F", "7,1,1,77,F"));
    let whole = fs::read(work.join("good.zip")).unwrap();
    fs::write(work.join("cut.zip"), &whole[..whole.len() / 2]).unwrap();
    let place = whole.windows(8).position(|bytes| bytes == b"7,2017,1").unwrap();
    let mut damaged = whole;
    damaged[place] = b'9';
    fs::write(work.join("damaged.zip"), damaged).unwrap();
    fs::write(work.join("page.zip"), "<html>not found</html>").unwrap();
    fs::write(work.join("pairs.csv"), pairs(&[PAIR])).unwrap();
    fs::write(work.join("gv.csv"), TABLES[1].1).unwrap();
    fs::write(work.join("cdc.sas7bdat"), "").unwrap();
    let sas = work.join("sas");
    fs::create_dir(&sas).unwrap();
    fs::write(sas.join("crash.sas7bdat"), "").unwrap();
    for (arguments, said) in [
        (
            &["--field", "no-gv.zip"][..],
            "no-gv.zip: there is no table GV (GV.csv or gv.sas7bdat); there are ../CISS/cdc.csv, ../CISS/crash.csv, ../CISS/edrevent.csv",
        ),
        (
            &["--field", "deep.zip"],
            "deep.zip: ../CISS/cdc.csv, line 3, column C6: \"deep\" is not a number, or nothing where it is missing",
        ),
        (
            &["--field", "none.zip"],
            "none.zip: the tables have no pair of vehicles that name each other as what they struck (OBJCONT) and can be \
             judged; left out: 1 without PDOF of both",
        ),
        (
            &["--field", "cut.zip"],
            "cannot read cut.zip as a ZIP file: if the download is not complete, repeat it",
        ),
        (&["--field", "damaged.zip"], "damaged.zip: cannot read ../CISS/crash.csv: Invalid checksum"),
        (
            &["--field", "page.zip"],
            "page.zip is named as a ZIP file, but is not one: the download may have failed",
        ),
        (&["--field", "nowhere.zip"], "cannot read nowhere.zip: "),
        (
            &["--field", "gv.csv"],
            "gv.csv is one table of NHTSA's download: give the folder or the ZIP file with all",
        ),
        (
            &["--field", "good.zip", "--field", "pairs.csv"],
            "pairs.csv is neither a folder nor a ZIP file: give NHTSA's",
        ),
        (
            &["--field", "good.zip", "--field", "./good.zip"],
            "crash 7 of 2017 is in good.zip and in ./good.zip: give each",
        ),
        (
            &["--field", "good.zip", "--field", "good.zip"],
            "crash 7 of 2017 is in good.zip and in good.zip: give each",
        ),
        (&["--field", "pairs.csv", "--objects"], "pairs.csv is a table: --objects is for NHTSA's download"),
        (&["--field", "sas"], "sas: crash.sas7bdat: it cannot be read as a SAS file: "),
        (
            &["--field", "cdc.sas7bdat"],
            "cdc.sas7bdat is one table of NHTSA's download: give the folder or the ZIP file with all",
        ),
    ] {
        let (status, _, message) = validate(&work, arguments);
        assert_eq!(status, Some(2), "{message}");
        assert!(message.starts_with(&format!("error: {said}")), "{message}\n{said}");
    }
}

#[test]
fn the_tables_of_a_download_are_not_written_over() {
    let work = folder("kept");
    write_folder(&work.join("2017"), str::to_owned);
    for source in ["2017", "."] {
        let (status, _, message) = validate(&work, &["--field", source, "-o", "2017/CDC.csv"]);
        assert_eq!(status, Some(2), "{message}");
        assert!(message.contains("would overwrite"), "{message}");
    }
    assert_eq!(fs::read_to_string(work.join("2017/CDC.csv")).unwrap(), TABLES[2].1);
}

/// The first bytes of a pipe, once read to recognise its kind, are gone.
#[cfg(unix)]
#[test]
fn a_table_of_pairs_may_come_through_a_pipe() {
    use std::process::Stdio;
    let mut child = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .args(["validate", "--field", "/dev/stdin", "--format", "json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(pairs(&[PAIR]).as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let judged: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(judged["data"]["sha256"], report::sha256(pairs(&[PAIR]).as_bytes()).as_str());
}
