//! The records of a recorder, for a case.

use std::collections::BTreeMap;

use super::error::CissError;
use super::table::{CissFiles, Layout, Row, Rows};

/// The data that a recorder stored of an event, in the form for `records` of a case: comma-separated values
/// with the columns PCODE, PTIME and PVALUE.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CissRecord {
    /// Before the impact, if it has a speed.
    pub pre_crash: Option<String>,
    /// During it, if it has a ΔV.
    pub pulse: Option<String>,
}

const NEEDED: &str = "CASEID VEHNO EDREVENTNO PCODE PTIME PVALUE";
const PRE_CRASH: Layout = Layout { name: "EDRPRECRASH", needed: NEEDED, optional: "EDRSUMMNO" };
const POST_CRASH: Layout = Layout { name: "EDRPOSTCRASH", needed: NEEDED, optional: "EDRSUMMNO" };

/// PCODE of a speed before the impact, and of a ΔV along and across.
const SPEED: [i64; 1] = [1010];
const DELTA_V: [i64; 2] = [2010, 2020];

/// The records of the recorder of a vehicle (VEHNO) in a crash (CASEID), from the tables EDRPRECRASH and
/// EDRPOSTCRASH, in the order of the recorder's numbers EDRSUMMNO and EDREVENTNO, which need not be that of
/// time. A record without a speed and without a ΔV is left out.
///
/// # Errors
/// If a table or a column is missing, a cell is no number, or there is no record.
pub fn records<F: CissFiles>(files: &mut F, crash: i64, vehicle: i64) -> Result<Vec<CissRecord>, F::Error> {
    let is_of = |row: Row<'_>| row.key(["CASEID", "VEHNO"]) == Some([crash, vehicle]);
    let before = Rows::read(files, &PRE_CRASH, is_of)?;
    let during = Rows::read(files, &POST_CRASH, is_of)?;
    let mut found: BTreeMap<[i64; 2], CissRecord> = BTreeMap::new();
    for (number, text) in texts(&before, &SPEED) {
        found.entry(number).or_default().pre_crash = Some(text);
    }
    for (number, text) in texts(&during, &DELTA_V) {
        found.entry(number).or_default().pulse = Some(text);
    }
    if found.is_empty() {
        Err(CissError::NoRecord { crash, vehicle }.into())
    } else {
        Ok(found.into_values().collect())
    }
}

/// The records that have one of these codes, by their numbers.
fn texts(rows: &Rows, codes: &[i64]) -> BTreeMap<[i64; 2], String> {
    let mut records: BTreeMap<[i64; 2], (bool, String)> = BTreeMap::new();
    for row in rows.iter() {
        let number = ["EDRSUMMNO", "EDREVENTNO"].map(|column| row.whole(column).unwrap_or(0));
        let (has_code, text) =
            records.entry(number).or_insert_with(|| (false, "PCODE,PTIME,PVALUE".to_owned()));
        *has_code |= row.whole("PCODE").is_some_and(|code| codes.contains(&code));
        let cells = ["PCODE", "PTIME", "PVALUE"]
            .map(|column| row.cell(column).map_or(String::new(), ToString::to_string));
        text.push('\n');
        text.push_str(&cells.join(","));
    }
    records
        .into_iter()
        .filter(|(_, (has_code, _))| *has_code)
        .map(|(number, (_, text))| (number, text))
        .collect()
}
