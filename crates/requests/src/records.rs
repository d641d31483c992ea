//! The tables of recorders that lie in files beside a case.

use std::fs;
use std::io;
use std::path::Path;
use std::sync::Arc;

use case::{
    CaseFile, Diagnostics, Fault, FaultKind, Faults, GivenPreCrash, GivenPulse, Program, SeriesRefusal,
    SeriesSource,
};

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
    let folder = case.parent().unwrap_or(Path::new("")).to_owned();
    for (k, vehicle) in file.case.vehicles.iter_mut().enumerate() {
        let Some(recorder) = &mut vehicle.recorder else { continue };
        let mut refuse = |key: &str, reason: String, advice: Option<&str>| {
            let key = format!("vehicle{}.recorder.{key}.file", k + 1);
            faults.push(Fault {
                key,
                kind: FaultKind::Refused { reason },
                advice: advice.map(str::to_owned),
            });
        };
        if let Some(given) = &recorder.pre_crash
            && let SeriesSource::File(name) = &given.source
        {
            let name = name.clone();
            match text_of(&folder, name.as_given()).map(|text| given.read_file(&text)) {
                Ok(Ok(read)) => recorder.pre_crash = Some(Arc::<GivenPreCrash>::new(read)),
                Ok(Err(refusal)) => refuse("pre_crash", placed(&name.to_string(), &refusal), None),
                Err(error) => refuse("pre_crash", format!("cannot read {name}: {error}"), Some(BESIDE)),
            }
        }
        if let Some(given) = &recorder.pulse
            && let SeriesSource::File(name) = &given.source
        {
            let name = name.clone();
            match text_of(&folder, name.as_given()).map(|text| given.read_file(&text)) {
                Ok(Ok(read)) => recorder.pulse = Some(Arc::<GivenPulse>::new(read)),
                Ok(Err(refusal)) => refuse("pulse", placed(&name.to_string(), &refusal), None),
                Err(error) => refuse("pulse", format!("cannot read {name}: {error}"), Some(BESIDE)),
            }
        }
    }
    Faults::none_of(faults).map_err(|faults| file.diagnostics(&faults, program))
}

/// What to do about a file that cannot be read.
const BESIDE: &str =
    "put the file beside the case, or its lines into the case: text = \"\"\"…\"\"\" in place of file";

/// A refusal with its place in the file.
fn placed(name: &str, refusal: &SeriesRefusal) -> String {
    match refusal {
        SeriesRefusal::Text(text) => match text.place() {
            Some(place) => format!("{name}:{}:{}: {refusal}", place.line, place.column),
            None => format!("{name}: {refusal}"),
        },
        _ => format!("{name}: {refusal}"),
    }
}

fn text_of(folder: &Path, name: &str) -> io::Result<String> {
    let path = folder.join(name);
    // A case comes from others: what it names is to lie in its folder, and a link would lead out of it.
    if Path::new(name).is_absolute() || Path::new(name).components().any(|part| part.as_os_str() == "..") {
        return Err(io::Error::other("it lies outside the folder of the case"));
    }
    let metadata = fs::symlink_metadata(&path)?;
    if !metadata.is_file() {
        return Err(io::Error::other("it is no file"));
    }
    if metadata.len() > CaseFile::LARGEST_FILE as u64 {
        return Err(io::Error::other(format!("it has more than {} bytes", CaseFile::LARGEST_FILE)));
    }
    String::from_utf8(fs::read(&path)?).map_err(|_| io::Error::other("it is no text in UTF-8"))
}
