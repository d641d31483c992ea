//! The tables of recorders in files next to a case.

use std::fs;
use std::io;
use std::path::Path;
use std::sync::Arc;

use case::{
    CaseFile, Diagnostics, Fault, FaultKind, Faults, GivenSeries, OfTables, Program, Recorder, SeriesRefusal,
    SeriesSource,
};

use crate::beside::beside;

/// Reads the files that `pre_crash` and `pulse` of `[vehicleN.recorder]` name, counted from the folder of the
/// case file, into the case.
///
/// # Errors
/// [`Diagnostics`] in the words of the program: a file that cannot be read, or a table in it.
pub fn read_records_beside(
    case: &Path,
    file: &mut CaseFile,
    program: &'static Program,
) -> Result<(), Diagnostics> {
    let mut faults = Vec::new();
    let mut refuse = |key: String, reason: String, advice: Option<&str>| {
        let advice = advice.map(str::to_owned);
        faults.push(Fault { key, kind: FaultKind::Refused { reason }, advice });
    };
    for (k, vehicle) in file.case.vehicles.iter_mut().enumerate() {
        let Some(recorder) = &mut vehicle.recorder else { continue };
        let table = format!("vehicle{}.recorder", k + 1);
        for (n, one) in recorder.records.iter_mut().enumerate() {
            read_record(case, &format!("{table}.records[{}]", n + 1), &mut one.stored, &mut refuse);
        }
        read_record(case, &table, recorder, &mut refuse);
    }
    Faults::none_of(faults).map_err(|faults| file.diagnostics(&faults, program))
}

/// Reads the files of one record, whose keys are in this table of the case.
fn read_record(
    case: &Path,
    table: &str,
    record: &mut Recorder,
    refuse: &mut dyn FnMut(String, String, Option<&str>),
) {
    read_series(case, &mut record.pre_crash, &format!("{table}.pre_crash.file"), refuse);
    read_series(case, &mut record.pulse, &format!("{table}.pulse.file"), refuse);
}

/// Reads a table from the file that this key names.
fn read_series<R: OfTables>(
    case: &Path,
    series: &mut Option<Arc<GivenSeries<R>>>,
    key: &str,
    refuse: &mut dyn FnMut(String, String, Option<&str>),
) {
    let Some(given) = series else { return };
    let SeriesSource::File(name) = &given.source else { return };
    let text = match text_of(case, name.as_given()) {
        Ok(text) => text,
        Err(error) => {
            let advice = if error.kind() == io::ErrorKind::InvalidData { SAVE_AS_UTF_8 } else { BESIDE };
            return refuse(key.to_owned(), format!("cannot read {name}: {error}"), Some(advice));
        }
    };
    match given.read_file(&text) {
        Ok(read) => *given = Arc::new(read),
        Err(refusal) => {
            refuse(key.to_owned(), placed(&name.to_string(), &refusal), refusal.advice().as_deref());
        }
    }
}

/// What to do about a file that cannot be read.
const BESIDE: &str =
    "put the file next to the case, or its lines into the case: text = \"\"\"…\"\"\" in place of file";

const SAVE_AS_UTF_8: &str =
    "save the file as UTF-8, or put its lines into the case: text = \"\"\"…\"\"\" in place of file";

/// A refusal with its place in the file.
fn placed(name: &str, refusal: &SeriesRefusal) -> String {
    match refusal.place() {
        Some(place) => format!("{name}:{}:{}: {refusal}", place.line, place.column),
        None => format!("{name}: {refusal}"),
    }
}

fn text_of(case: &Path, name: &str) -> io::Result<String> {
    let path = beside(case, name)?;
    if fs::metadata(&path)?.len() > CaseFile::LARGEST_FILE as u64 {
        return Err(io::Error::other(format!("it has more than {} bytes", CaseFile::LARGEST_FILE)));
    }
    String::from_utf8(fs::read(&path)?)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8"))
}
