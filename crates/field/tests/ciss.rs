//! From tables with the layout of CISS to crashes.

use std::collections::BTreeMap;

use field::ciss::{
    CissCell, CissCrashes, CissError, CissFiles, CissLeftOut, has_tables, objects, pairs, read_pairs, records,
};

/// Files in memory.
#[derive(Clone)]
struct Files(Vec<(String, String)>);

impl CissFiles for Files {
    type Error = CissError;

    fn names(&self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    fn read(&mut self, place: usize) -> Result<Vec<u8>, CissError> {
        Ok(self.0[place].1.clone().into_bytes())
    }
}

impl Files {
    fn file(&mut self, name: &str) -> &mut String {
        &mut self.0.iter_mut().find(|(file, _)| file == name).unwrap().1
    }

    fn with(&self, name: &str, from: &str, to: &str) -> Self {
        let mut files = self.clone();
        let text = files.file(name);
        assert!(text.contains(from), "{from} in {text}");
        *text = text.replacen(from, to, 1);
        files
    }

    fn without(&self, name: &str) -> Self {
        Self(self.0.iter().filter(|(file, _)| file != name).cloned().collect())
    }
}

/// Crash 7: vehicles 1 and 2 struck each other in event 1, and vehicle 2 a tree in event 2. Made up.
fn tables() -> Files {
    let text = |lines: &[&str]| lines.join("\n");
    let files = [
        ("CRASH.csv", text(&["CRASHYEAR,CASEID,PSU", "2017,7,10"])),
        (
            "gv.CSV",
            text(&[
                "CASEID,VEHNO,MAKE,MODEL,MODELYR,BODYTYPE,CURBWT,CARGOWT,DVANGTHIS",
                "7,2,20,999,2012,4,1400,9999,361",
                "7,1,99,401,9999,88,1500,0,90",
            ]),
        ),
        (
            "CDC.csv",
            text(&[
                "CASEID,EVENTNO,VEHNO,OBJCONT,CDCPLANE,CDC,PDOF,HEADINGANG,FIELDL,FIELDLD,DIRECTL,DIRECTD,\
                 C1,C2,C3,C4,C5,C6,CMAX,DVTOTAL,DVLONG,DVLAT,DVENERGY",
                "7,1,2,1,L,10LYEW02,290,888,191,95,888,109,3,20,28,17,13,18,28,22,-14,17,47152",
                "7,1,1,2,F,\"01FDEW02\",40,350,154,-0,154,12.5,3,20,31,32,40,40,999,25,-19,-16,9999997",
                "7,2,2,42,F,12FDEW02,888,888,120,0,120,0,1,2,3,4,5,6,6,,,,",
            ]),
        ),
        (
            "EDREVENT.csv",
            text(&[
                "CASEID,VEHNO,EDRSUMMNO,EDREVENTNO,CDCEVENT,MAXDVLONG,MAXDVLAT",
                "7,1,1,1,1,-12,997",
                "7,1,1,2,1,-20,5.25",
                "7,1,1,3,97,-40,0",
                "7,2,1,1,2,-15.5,.",
            ]),
        ),
    ];
    Files(files.map(|(name, text)| (name.to_owned(), text)).to_vec())
}

fn refusal(mut files: Files) -> String {
    pairs(&mut files).unwrap_err().to_string()
}

/// By hand: the vehicle with the lower number first; 999, 888, 9999, 9999997 and 361° are not known, 20 and
/// 999 of makes and models are; of the two records of event 1 the larger.
#[test]
fn a_pair_has_the_cells_of_its_tables() {
    let found = pairs(&mut tables()).unwrap();
    let header = |vehicle| {
        let names = "VEHNO,MAKE,MODEL,MODELYR,BODYTYPE,CURBWT,CARGOWT,CDCPLANE,CDC,PDOF,HEADINGANG,DVANGTHIS,FIELDL,\
                     FIELDLD,DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,CMAX,DVTOTAL,DVLONG,DVLAT,DVENERGY,MAXDVLONG,MAXDVLAT";
        names.split(',').map(|name| format!("{name}_{vehicle}")).collect::<Vec<_>>().join(",")
    };
    let one =
        "1,99,401,,88,1500,0,F,01FDEW02,40,350,90,154,0,154,12.5,3,20,31,32,40,40,,25,-19,-16,,-20.0,5.25";
    let two = "2,20,999,2012,4,1400,,L,10LYEW02,290,,,191,95,,109,3,20,28,17,13,18,28,22,-14,17,47152,,";
    let csv = format!("YEAR,CASEID,EVENTNO,{},{}\n2017,7,1,{one},{two}\n", header(1), header(2));
    assert_eq!(found.csv(), csv);
    assert!(found.left_out.is_empty());
    let counts: Vec<_> =
        found.tables.iter().map(|table| (table.name, table.file.as_str(), table.rows)).collect();
    let expected = [
        ("CRASH", "CRASH.csv", 1),
        ("GV", "gv.CSV", 2),
        ("CDC", "CDC.csv", 3),
        ("EDREVENT", "EDREVENT.csv", 4),
    ];
    assert_eq!(counts, expected);
    // The reader of tables of pairs reads it, and gives the same.
    assert_eq!(field::read(&csv).unwrap().len(), 1);
    assert_eq!(read_pairs("pairs.csv", csv.as_bytes()).unwrap(), found.rows);
    let columns = CissCrashes::columns(false);
    assert_eq!(columns.len(), 61);
    let kinds: Vec<_> =
        [0, 11, 19, 30].map(|place: usize| (columns[place].name.as_str(), columns[place].kind)).to_vec();
    assert_eq!(
        kinds,
        [("YEAR", "integer"), ("CDC_1", "text"), ("C1_1", "number"), ("MAXDVLONG_1", "number")]
    );
}

#[test]
fn a_vehicle_that_struck_a_tree_has_its_cells() {
    let found = objects(&mut tables()).unwrap();
    let row = "2017,7,2,2,20,999,2012,4,1400,,F,12FDEW02,,,,120,0,120,0,1,2,3,4,5,6,6,,,,,-15.5,,42\n";
    let csv = found.csv();
    assert_eq!(csv.split_once('\n').unwrap().1, row);
    assert!(csv.starts_with("YEAR,CASEID,EVENTNO,VEHNO,MAKE,") && csv.contains("MAXDVLAT,OBJCONT\n"));
    assert_eq!(field::read_objects(&csv).unwrap().unwrap()[0].kind, field::PairKind::TreeOrPole);
    // Another vehicle, and the ground in a rollover, are not fixed objects.
    let mut other = tables().with("CDC.csv", "7,2,2,42", "7,2,2,30");
    assert_eq!(
        (objects(&mut other).unwrap().rows.len(), objects(&mut other).unwrap().left_out.len()),
        (0, 0)
    );
}

#[test]
fn what_a_pair_lacks_is_counted() {
    for (file, from, to, reason) in [
        ("CDC.csv", "7,2,2,42", "7,1,2,42", CissLeftOut::SeveralDamages),
        ("CDC.csv", ",L,", ",T,", CissLeftOut::Plane),
        ("CDC.csv", "109,3,20", "109,3,999", CissLeftOut::Crush),
        ("CDC.csv", "191,95,888", "888,95,888", CissLeftOut::Crush),
        ("CDC.csv", ",290,", ",888,", CissLeftOut::Pdof),
        ("gv.CSV", ",1400,", ",9999,", CissLeftOut::Mass),
        ("gv.CSV", ",1400,", ",0,", CissLeftOut::Mass),
        ("gv.CSV", "7,2,20", "7,3,20", CissLeftOut::Mass),
        ("gv.CSV", ",1400,", ",140000,", CissLeftOut::Implausible),
        ("EDREVENT.csv", "1,-20,5.25", "1,-655.35,0", CissLeftOut::Implausible),
    ] {
        let found = pairs(&mut tables().with(file, from, to)).unwrap();
        assert!(found.rows.is_empty(), "{from} → {to}");
        assert_eq!(found.left_out, BTreeMap::from([(reason, 1)]), "{from} → {to}");
    }
    // Of both records, none is of this event.
    let mut none =
        tables().with("EDREVENT.csv", "1,1,1,-12", "1,1,2,-12").with("EDREVENT.csv", "1,2,1,-20", "1,2,,-20");
    assert_eq!(pairs(&mut none).unwrap().left_out, BTreeMap::from([(CissLeftOut::Recorder, 1)]));
    // Only vehicle 1 names the other: no pair at all.
    let found = pairs(&mut tables().with("CDC.csv", "7,1,2,1,L", "7,1,2,77,L")).unwrap();
    assert_eq!((found.rows.len(), found.left_out.len()), (0, 0));
}

#[test]
fn contacts_come_from_event_if_the_damages_name_none() {
    let expected = pairs(&mut tables()).unwrap();
    let mut files = tables().with("CDC.csv", "OBJCONT", "STRUCK");
    assert!(refusal(files.clone()).starts_with(
        "there is no table EVENT (EVENT.csv or event.sas7bdat); there are CDC.csv, CRASH.csv, EDREVENT.csv, gv.CSV"
    ));
    files.0.push(("EVENT.csv".to_owned(), "CASEID,EVENTNO,VEHNUM,OBJCONT\n7,1,1,2\n7,2,2,42\n".to_owned()));
    let found = pairs(&mut files).unwrap();
    assert_eq!(found.csv(), expected.csv());
    assert_eq!(found.tables.len(), 5);
    assert_eq!(objects(&mut files).unwrap().csv(), objects(&mut tables()).unwrap().csv());
}

#[test]
fn letters_folders_line_ends_and_encodings_do_not_matter() {
    let expected = pairs(&mut tables()).unwrap().csv();
    let mut files = Files(
        tables()
            .0
            .into_iter()
            .map(|(name, text)| {
                (
                    format!("CISS_2017/{}", name.to_lowercase()),
                    format!("\u{feff}{}\r\n", text.to_lowercase().replace('\n', "\r\n")),
                )
            })
            .collect(),
    );
    let lower = files.file("CISS_2017/cdc.csv");
    *lower =
        lower.replace(",l,", ",L,").replace(",f,", ",F,").replace("fdew", "FDEW").replace("lyew", "LYEW");
    assert_eq!(pairs(&mut files).unwrap().csv(), expected);

    /// A table in Latin-1.
    struct Latin(Files);
    impl CissFiles for Latin {
        type Error = CissError;
        fn names(&self) -> Vec<String> {
            self.0.names()
        }
        fn read(&mut self, place: usize) -> Result<Vec<u8>, CissError> {
            Ok(self.0.read(place)?.into_iter().map(|byte| if byte == b'~' { 0xe9 } else { byte }).collect())
        }
    }
    let place = tables().with("CRASH.csv", "2017,7,10", "2017,7,Caf~");
    assert_eq!(pairs(&mut Latin(place)).unwrap().csv(), expected);
}

#[test]
fn what_is_wrong_is_named_with_file_line_and_column() {
    let base = tables();
    for (files, said) in [
        (
            base.without("gv.CSV"),
            "there is no table GV (GV.csv or gv.sas7bdat); there are CDC.csv, CRASH.csv, EDREVENT.csv",
        ),
        (Files(Vec::new()), "there is no table CRASH (CRASH.csv or crash.sas7bdat); there is no file"),
        (
            base.with("CDC.csv", "C3,C4", "C3,AVGC4"),
            "the table CDC (CDC.csv) has no column C4; it has CASEID, EVENTNO, VEHNO, OBJCONT, CDCPLANE",
        ),
        (
            base.with("CDC.csv", "C1,C2,", "C1,c1,"),
            "CDC.csv, line 1: there are two columns C1; leave one of them",
        ),
        (
            base.with("CDC.csv", "\n7,1,1,2", "\r\n\r\n7,1,1,2").with("CDC.csv", "32,40,40", "32,40,deep"),
            "CDC.csv, line 4, column C6: \"deep\" is not a number, or nothing where it is missing",
        ),
        (
            base.with("EDREVENT.csv", "7,1,1,2,1", "7,1.5,1,2,1"),
            "EDREVENT.csv, line 3, column VEHNO: \"1.5\" is not a whole number",
        ),
        (
            base.with("gv.CSV", "1400,9999,361", "1400,9,999,361"),
            "gv.CSV, line 2: the row has 10 cells, and the header 9; a text with a comma needs",
        ),
        (
            base.with("CRASH.csv", "2017,7,", "2017,8,"),
            "the table CRASH has no row of crash 7, which CDC has",
        ),
        (
            base.with("gv.CSV", "7,1,99", "7,2,99"),
            "the table GV has two rows of CASEID 7, VEHNO 2: give the tables of one year",
        ),
    ] {
        let message = refusal(files);
        assert!(message.starts_with(said), "{message}\n{said}");
    }
    let named =
        |names: &[&str]| Files(names.iter().map(|name| ((*name).to_owned(), String::new())).collect());
    let message = refusal(named(&["a/CRASH.csv", "b/crash.CSV"]));
    assert!(
        message.starts_with("the table CRASH appears twice: a/CRASH.csv and b/crash.CSV; give"),
        "{message}"
    );
    assert!(refusal(named(&["accident.sas7bdat", "ve.sas7bdat"])).contains("NASS-CDS (ACCIDENT, VE)"));
    let message = refusal(named(&["crash.sas7bdat"]));
    assert!(message.starts_with("crash.sas7bdat: it cannot be read as a SAS file: "), "{message}");
    let many: Vec<_> = (10..60).map(|number| format!("{number}.txt")).collect();
    let many: Vec<_> = many.iter().map(String::as_str).collect();
    assert!(refusal(named(&many)).ends_with("48.txt, 49.txt and 10 more"));
    assert!(has_tables(&tables().names()) && !has_tables(&["XCRASH.csv".to_owned(), "GV.txt".to_owned()]));
    assert!(
        read_pairs("a.csv", b"CASEID\n1\n")
            .unwrap_err()
            .to_string()
            .starts_with("a.csv: there is no column YEAR; give a file")
    );
}

#[test]
fn records_have_their_values_as_texts() {
    let before = "CASEID,VEHNO,EDRSUMMNO,EDREVENTNO,PCODE,PTIME,PVALUE\n\
                  7,1,1,2,1010,-1.0,41\n7,1,1,1,1010,-1.0,60\n7,1,1,1,1050,0.0,888\n7,2,1,1,1010,0,9\n7,1,1,4,1050,0,8\n";
    let during = "CASEID,VEHNO,EDREVENTNO,PCODE,PTIME,PVALUE,EDRSUMMNO\n7,1,2,2020,50,-12,1\n";
    let files = [("edrprecrash.csv", before), ("EDRPOSTCRASH.csv", during)];
    let mut files = Files(files.map(|(name, text)| (name.to_owned(), text.to_owned())).to_vec());
    let found = records(&mut files, 7, 1).unwrap();
    let text = |lines: &str| Some(format!("PCODE,PTIME,PVALUE\n{lines}"));
    assert_eq!(found.len(), 2);
    assert_eq!((&found[0].pre_crash, &found[0].pulse), (&text("1010,-1.0,60\n1050,0.0,888"), &None));
    assert_eq!((&found[1].pre_crash, &found[1].pulse), (&text("1010,-1.0,41"), &text("2020,50,-12")));
    let refused = records(&mut files, 7, 3).unwrap_err().to_string();
    assert_eq!(refused, "the recorder of vehicle 3 in crash 7 has no record with a speed or a ΔV");
    assert_eq!(CissCell::Text("-1.0".to_owned()).to_string(), "-1.0");
}
