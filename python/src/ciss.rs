//! Pairs of vehicles with a recorder: `pydeltav.ciss`.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field as Column, Schema};
use case::SeverityPrior;
use evidence::FITTED;
use field::ciss::{CissCell, CissCrashes, CissError, CissFiles, CissRecord, pairs, read_pairs, records};
use field::{Field, FieldError, KnownCrush, Options, Pair, judge, read};
use pim_core::VehicleId;
use pyo3::IntoPyObjectExt as _;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyDict, PyTuple};

use report::FieldData;

use crate::given::{Given, PyCase, Whole};
use crate::picture::Picture;
use crate::request::chosen;
use crate::rows::Rows;
use crate::run::interruptible;

/// The names of the columns of pairs, and the kinds of their cells.
#[pyfunction(name = "_ciss_columns")]
pub(crate) fn ciss_columns() -> Vec<(String, &'static str)> {
    CissCrashes::columns(false).into_iter().map(|column| (column.name, column.kind)).collect()
}

/// Files that Python reads: their names, and the function that gives the content of the file with an index.
struct PyFiles<'py> {
    names: Vec<String>,
    read: Bound<'py, PyAny>,
}

/// A file that the rules refuse, or the exception that Python raised when it read one.
enum Unread {
    Refused(CissError),
    Raised(PyErr),
}

impl From<CissError> for Unread {
    fn from(error: CissError) -> Self {
        Self::Refused(error)
    }
}

impl CissFiles for PyFiles<'_> {
    type Error = Unread;

    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn read(&mut self, place: usize) -> Result<Vec<u8>, Unread> {
        let content = self.read.call1((place,)).and_then(|content| Ok(content.extract::<PyBackedBytes>()?));
        content.map(|content| content.to_vec()).map_err(Unread::Raised)
    }
}

fn in_source<T>(found: Result<T, Unread>, source: &str) -> PyResult<T> {
    found.map_err(|error| match error {
        Unread::Refused(error) => PyValueError::new_err(format!("{source}: {error}")),
        Unread::Raised(error) => error,
    })
}

type PyRows = Vec<Vec<Py<PyAny>>>;

fn rows_of(py: Python<'_>, rows: &[Vec<CissCell>]) -> PyResult<PyRows> {
    let cell = |cell: &CissCell| match cell {
        CissCell::Nothing => Ok(py.None()),
        CissCell::Whole(number) => number.into_py_any(py),
        CissCell::Number(number) => number.into_py_any(py),
        CissCell::Text(text) => text.into_py_any(py),
    };
    rows.iter().map(|row| row.iter().map(cell).collect()).collect()
}

/// The pairs of a year, and the numbers of those that are left out, by reason.
#[pyfunction(name = "_ciss_pairs")]
pub(crate) fn ciss_pairs(
    py: Python<'_>,
    source: &str,
    names: Vec<String>,
    read: Bound<'_, PyAny>,
) -> PyResult<(PyRows, BTreeMap<&'static str, usize>)> {
    let found = in_source(pairs(&mut PyFiles { names, read }), source)?;
    let left_out = found.left_out.iter().map(|(reason, count)| (reason.why(false), *count));
    Ok((rows_of(py, &found.rows)?, left_out.collect()))
}

/// The pairs of a saved table.
#[pyfunction(name = "_read_pairs")]
pub(crate) fn saved_pairs(py: Python<'_>, file: &str, content: &[u8]) -> PyResult<PyRows> {
    let rows = read_pairs(file, content).map_err(|error| PyValueError::new_err(error.to_string()))?;
    rows_of(py, &rows)
}

/// The records of a recorder, by the names of the keys of a case.
#[pyfunction(name = "_ciss_records")]
pub(crate) fn ciss_records(
    source: &str,
    names: Vec<String>,
    read: Bound<'_, PyAny>,
    crash: i64,
    vehicle: i64,
) -> PyResult<Vec<BTreeMap<&'static str, String>>> {
    let found = in_source(records(&mut PyFiles { names, read }, crash, vehicle), source)?;
    let record = |record: CissRecord| {
        let texts = [("pre_crash", record.pre_crash), ("pulse", record.pulse)];
        texts.into_iter().filter_map(|(key, text)| Some((key, text?))).collect()
    };
    Ok(found.into_iter().map(record).collect())
}

fn refused(error: FieldError) -> PyErr {
    // Without this, Python would not show the underlying reason, such as a line of a table.
    let below = std::error::Error::source(&error).map(|reason| format!(": {reason}")).unwrap_or_default();
    PyValueError::new_err(format!("{error}{below}"))
}

/// The case file of the pair in a table of one line.
#[pyfunction(name = "_case_of_pair")]
pub(crate) fn case_of_pair(
    py: Python<'_>,
    text: &str,
    name: &str,
    recorder: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyCase> {
    let given = match recorder.map(|recorder| recorder.extract::<u8>()) {
        None => None,
        Some(Ok(1)) => Some(VehicleId::One),
        Some(Ok(2)) => Some(VehicleId::Two),
        Some(_) => {
            return Err(PyValueError::new_err("recorder: give 1 or 2, the vehicle it belongs to, or None"));
        }
    };
    let mut pairs = read(text).map_err(|error| match error {
        FieldError::Cell { column, text, wanted, .. } => {
            let text = if text.is_empty() { "nothing".to_owned() } else { format!("\"{text}\"") };
            PyValueError::new_err(format!("{column} of the pair is {text}, not {wanted}"))
        }
        error => refused(error),
    })?;
    let pair: Pair = pairs.remove(0);
    if let Some(vehicle) = given.filter(|vehicle| pair.vehicles[vehicle.index()].truth().is_none()) {
        return Err(PyValueError::new_err(format!(
            "recorder={}: that vehicle has no usable ΔV from a recorder; leave it out",
            vehicle.index() + 1
        )));
    }
    let title = name.replace(['"', '\\', '\n'], " ");
    let text = format!("title = \"{title}\"\n{}", pair.case_text(&FITTED, given.as_slice()));
    Given::parsed(py, name, text.as_bytes(), None)
}

/// How often intervals contain what recorders stored.
#[pyclass(name = "_Judged", module = "pydeltav._pydeltav", frozen)]
pub(crate) struct Judged {
    field: Field,
    /// With the fields below, all that is needed to judge again.
    text: String,
    other: bool,
    prior: SeverityPrior,
    particles: usize,
    seed: u64,
    threads: Option<usize>,
}

/// Judges the pairs in a table.
#[pyfunction(name = "_judge_pairs")]
pub(crate) fn judge_pairs(
    py: Python<'_>,
    text: String,
    other: bool,
    prior: &str,
    particles: Whole<usize>,
    seed: Whole<u64>,
    threads: Option<Whole<usize>>,
) -> PyResult<Judged> {
    let (particles, seed, threads) = (particles.0, seed.0, threads.map(|threads| threads.0));
    let prior = chosen("prior", prior, &SeverityPrior::WORDS[..2])?;
    let injury = analysis::injury(prior);
    let pairs = py.detach(|| read(&text)).map_err(refused)?;
    let options = Options { particles, seed, other, crush: KnownCrush::Both, injury };
    let judged =
        interruptible(py, threads, |ending| judge(&pairs, &FITTED, &options, &mut |_, _| ending.flow()))?;
    let field = judged.map_err(refused)?;
    Ok(Judged { field, text, other, prior, particles, seed, threads })
}

type Draw = fn(&Field) -> report::Drawing;

impl Judged {
    fn data(&self) -> FieldData<'_> {
        FieldData { name: "pairs", table: &self.text, years: &[] }
    }
}

#[pymethods]
impl Judged {
    fn json(&self) -> PyResult<String> {
        report::field_json(&self.field, &self.data())
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| report::field(&self.field, &self.data()).text())
    }

    fn html(&self, py: Python<'_>) -> String {
        py.detach(|| report::field(&self.field, &self.data()).html_fragment())
    }

    fn draw(slf: &Bound<'_, Self>, what: &str) -> PyResult<Picture> {
        let drawings: [(&str, Draw); 2] =
            [("estimates", report::estimated_against_recorded), ("ranks", report::ranks_of_recorders)];
        let drawn = chosen("what", what, &drawings)?(&slf.get().field);
        Picture::new(slf, drawn, ("draw", what), &PyDict::new(slf.py()))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let judged = slf.get();
        let again = slf.py().import("pydeltav._pydeltav")?.getattr("_judge_pairs")?;
        let asked =
            (&judged.text, judged.other, judged.prior.name(), judged.particles, judged.seed, judged.threads);
        Ok((again, asked.into_pyobject(slf.py())?))
    }
}

/// Columns of a table of pairs: name, kind and cells of each.
#[pyfunction(name = "_columns_of_pairs")]
pub(crate) fn columns_of_pairs(columns: Vec<(String, String, Bound<'_, PyAny>)>) -> PyResult<Rows> {
    let mut fields = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for (name, kind, cells) in columns {
        let wrong = |error: PyErr| PyValueError::new_err(format!("column {name}: {error}"));
        let (kind, array): (_, ArrayRef) = match kind.as_str() {
            "text" => {
                let cells: Vec<Option<String>> = cells.extract().map_err(wrong)?;
                (DataType::Utf8, Arc::new(StringArray::from(cells)))
            }
            "integer" => {
                let cells: Vec<Option<i64>> = cells.extract().map_err(wrong)?;
                (DataType::Int64, Arc::new(Int64Array::from(cells)))
            }
            _ => {
                let cells: Vec<Option<f64>> = cells.extract().map_err(wrong)?;
                (DataType::Float64, Arc::new(Float64Array::from(cells)))
            }
        };
        fields.push(Column::new(name, kind, true));
        arrays.push(array);
    }
    let schema = Arc::new(Schema::new(fields));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays);
    let batch = batch.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    Ok(Rows::of(schema, vec![batch]))
}
