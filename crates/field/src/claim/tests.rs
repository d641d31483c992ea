#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

use super::{ClaimColumns, judge_claims};
use crate::error::FieldError;
use crate::read::read;

const COLUMNS: [&str; 19] = [
    "CURBWT",
    "CARGOWT",
    "CDCPLANE",
    "PDOF",
    "HEADINGANG",
    "FIELDL",
    "DIRECTL",
    "DIRECTD",
    "C1",
    "C2",
    "C3",
    "C4",
    "C5",
    "C6",
    "DVTOTAL",
    "DVLONG",
    "MAXDVLONG",
    "MAXDVLAT",
    "OURS",
];

/// Pairs of two fronts whose vehicle 1 has a recorder of 30 and 40 km/h, so 50, and a claim of `claims` km/h
/// with an interval between `ends`; vehicle 2 has neither.
fn table(rows: &[(&str, &str, &str)]) -> String {
    let names = |vehicle: u8| COLUMNS.map(|column| format!("{column}_{vehicle}")).join(",");
    let mut text = format!("CASEID,{},{},LOW_1,HIGH_1,LOW_2,HIGH_2\n", names(1), names(2));
    for (number, (ours, low, high)) in rows.iter().enumerate() {
        let vehicle = |recorder: &str, ours: &str| {
            format!("1500,,F,0,0,150,150,0,20,20,20,20,20,20,,,{recorder},{ours}")
        };
        let (one, two) = (vehicle("-30,40", ours), vehicle(",", ""));
        text += &format!("{number},{one},{two},{low},{high},,\n");
    }
    text
}

#[test]
fn a_program_is_judged_by_its_columns() {
    // ln(55/50), ln(40/50); 55 is 5 off, 40 is 10 off.
    let text = table(&[("55", "45", "60"), ("-40", "30", "45"), ("", "", "")]);
    let pairs = read(&text).unwrap();
    let columns: ClaimColumns = "OURS, LOW,HIGH".parse().unwrap();
    let claims = judge_claims(&text, &pairs, &columns).unwrap();
    assert_eq!((claims.pairs, claims.unclaimed, claims.judged.len()), (3, 1, 2));
    let all = &claims.groups[0];
    let expected = ((1.1_f64).ln() + (0.8_f64).ln()) / 2.0;
    assert!((all.figures.bias[0] - expected).abs() < 1e-12, "{:?}", all.figures);
    let square = ((1.1_f64).ln().powi(2) + (0.8_f64).ln().powi(2)) / 2.0;
    assert!((all.figures.rms[0] - square.sqrt()).abs() < 1e-12);
    assert!((all.figures.crps * 3.6 - 7.5).abs() < 1e-12);
    // 50 lies within 45 to 60, and 5 above 30 to 45: widths of 15, and 40 times 5.
    assert_eq!(all.coverage95.unwrap()[0], 0.5);
    assert!((all.interval_score.unwrap() * 3.6 - (15.0 + 15.0 + 200.0) / 2.0).abs() < 1e-9);
    assert_eq!(claims.groups[1].name, "front-front");
    // Without intervals, they have no figures.
    let claims = judge_claims(&text, &pairs, &"OURS".parse().unwrap()).unwrap();
    assert_eq!((claims.groups[0].coverage95, claims.groups[0].interval_score), (None, None));
}

/// WinSMASH's column, judged like any other, gives the figures that accompany every judgement.
#[test]
fn what_cannot_be_judged_is_told_with_its_place() {
    let judge = |row, columns: &str| {
        let text = table(&[row]);
        judge_claims(&text, &read(&text).unwrap(), &columns.parse()?)
    };
    let message = |row, columns| judge(row, columns).unwrap_err().to_string();
    assert_eq!(
        message(("0", "", ""), "OURS"),
        "line 2, column OURS_1: \"0\" is not a ΔV that can be compared: it must not be 0; leave the cell empty where \
         there is none"
    );
    assert_eq!(
        message(("55", "56", "60"), "OURS,LOW,HIGH"),
        "line 2, column LOW_1: \"56\" is not an end of an interval that contains its own value"
    );
    assert!(
        message(("55", "", "60"), "OURS,LOW,HIGH").contains("column LOW_1: the empty cell is not an end")
    );
    assert!(message(("1e300", "", ""), "OURS").contains("plausible"));
    assert!(matches!(judge(("55", "", ""), "THEIRS"), Err(FieldError::NoClaimColumn { .. })));
    assert!(matches!(judge(("", "", ""), "OURS"), Err(FieldError::NoClaims { .. })));
    for columns in ["", "A,B", "A,,B", "A,B,C,D"] {
        assert!(matches!(judge(("55", "", ""), columns), Err(FieldError::ClaimColumns { .. })), "{columns}");
    }
}
