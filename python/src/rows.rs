//! Tables: a row in, a row out.

use std::path::PathBuf;
use std::sync::Arc;

use analysis::EstimatePlan;
use arrow_array::{RecordBatch, StructArray};
use arrow_schema::{ArrowError, Schema, SchemaRef};
use case::SeverityPrior;
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyMapping, PyString};
use pyo3_arrow::ffi::to_schema_pycapsule;
use tables::{Carried, Job, Numbers, RowOptions, RowTemplate, TableError};

use crate::dict;
use crate::errors::wrong_case;
use crate::given::{PyCase, Whole, bytes_of, is_one_word, is_path};
use crate::request::chosen;
use crate::run::{Ending, interruptible, pool};
use crate::stream::{Asked, Parts, RowStream, as_stream, names};
use crate::table::Table;

/// The results of a table, for whatever speaks Arrow: ``polars.DataFrame(rows)``, ``pyarrow.table(rows)``,
/// ``pandas.DataFrame.from_arrow(rows)``.
///
/// Examples
/// --------
/// >>> table = {"id": ["a"], "vehicle1.weight [lb]": [3600.0]}
/// >>> rows = pydeltav.reconstruct_table(table, template=pydeltav.Case.example())
/// >>> len(rows), rows.names[0]
/// (1, 'id')
#[pyclass(name = "Rows", module = "pydeltav", frozen)]
pub(crate) struct Rows {
    schema: SchemaRef,
    batches: Vec<RecordBatch>,
}

impl Rows {
    pub(crate) fn of(schema: SchemaRef, batches: Vec<RecordBatch>) -> Self {
        Self { schema, batches }
    }
}

/// Names and types of columns, for whatever speaks Arrow: ``pyarrow.schema(schema)``.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> "error" in pyarrow.schema(pydeltav.result_schema("crush")).names
/// True
#[pyclass(name = "Schema", module = "pydeltav", frozen)]
pub(crate) struct PySchema(SchemaRef);

fn wrong_table(py: Python<'_>, error: TableError) -> PyErr {
    match error {
        TableError::Template(errors) => wrong_case(py, *errors),
        error => PyValueError::new_err(error.to_string()),
    }
}

fn broken(error: ArrowError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// What all rows share: a case, the text of part of a case file, a dict with its keys, or the path of such a
/// file.
fn template(given: Option<&Bound<'_, PyAny>>) -> PyResult<RowTemplate> {
    let Some(given) = given else { return Ok(RowTemplate::default()) };
    let py = given.py();
    let parsed =
        |name: &str, text: &str| RowTemplate::parse(name, text).map_err(|error| wrong_table(py, error));
    if let Ok(case) = given.cast::<PyCase>() {
        let source = &case.get().0.file.source;
        return parsed(source.name().as_given(), source.text());
    }
    if let Ok(text) = given.cast::<PyString>() {
        let text = text.to_str()?;
        if !is_one_word(text) {
            return parsed("template", text);
        }
        if !is_path(text) {
            let shown = case::shown(text);
            return Err(PyValueError::new_err(format!(
                "template=\"{shown}\": this is neither the text of a case file nor a path that ends in .toml; \
                 give another path as pathlib.Path(\"{shown}\")"
            )));
        }
    } else if given.cast::<PyMapping>().is_ok() {
        return parsed("template", &dict::as_toml(given)?);
    }
    let Ok(path) = given.extract::<PathBuf>() else {
        return Err(PyTypeError::new_err(format!(
            "template= takes a Case, a dict, a text or the path of a case file, not {}",
            given.get_type().name()?
        )));
    };
    let bytes = bytes_of(py, &path)?;
    let text = String::from_utf8(bytes).map_err(|_| {
        PyValueError::new_err(format!(
            "the template {} is not UTF-8: save it as UTF-8",
            case::shown(&path.display().to_string())
        ))
    })?;
    parsed(&path.display().to_string(), &text)
}

fn prior(prior: Option<&str>) -> PyResult<Option<SeverityPrior>> {
    prior.map(|prior| chosen("prior", prior, &SeverityPrior::WORDS)).transpose()
}

fn job(name: &str) -> PyResult<Job> {
    chosen("job", name, &Job::WORDS)
}

fn asked(
    py: Python<'_>,
    table: &Schema,
    job: Job,
    given: Option<&Bound<'_, PyAny>>,
    options: RowOptions,
) -> PyResult<Asked> {
    let template = template(given)?;
    let results = tables::result_schema(job, &options);
    let carried = tables::columns_kept(table).and_then(|kept| Carried::new(table, kept, &results));
    let carried = carried.map_err(|error| wrong_table(py, error))?;
    Ok(Asked { job, template, options, carried })
}

fn solve(
    py: Python<'_>,
    job: Job,
    table: Table,
    given: Option<&Bound<'_, PyAny>>,
    (options, threads): (RowOptions, Option<Whole<usize>>),
) -> PyResult<Rows> {
    let mut reader = table.0;
    let asked = asked(py, &reader.schema(), job, given, options)?;
    let threads = threads.map(|threads| threads.0);
    let mut batches = Vec::new();
    while let Some(batch) = py.detach(|| reader.next()) {
        let batch = batch.map_err(broken)?;
        tables::check_columns(&batch).map_err(|error| wrong_table(py, error))?;
        let rows = interruptible(py, threads, |ending| asked.solve(&batch, ending))?;
        batches.push(rows.map_err(|error| wrong_table(py, error))?);
    }
    Ok(Rows { schema: asked.carried.schema().clone(), batches })
}

fn sampled(samples: Option<Whole<usize>>, seed: Whole<u64>) -> RowOptions {
    RowOptions { samples: samples.map(|samples| samples.0), seed: seed.0, ..RowOptions::default() }
}

/// Reconstructs each row of a table: ``Case.reconstruct``, and with ``samples`` intervals.
///
/// Parameters
/// ----------
/// table
///     Whatever speaks Arrow, of pyarrow, Polars, pandas or DuckDB: a table, a batch or a stream; or a dict
///     of columns, each a list or an array. Columns are keys of the case file, nested as in
///     ``case_schema()`` (SI units and radians) or flat with their unit in brackets,
///     ``"vehicle2.speed [mph]"``; all others are carried over.
/// template : Case, str, Mapping or os.PathLike, optional
///     What all rows share: a case, or part of a case file as a text, a dict or a path. A text that ends in
///     ``.toml`` is a path.
/// samples : int, optional
///     (–) of each row, for the columns of its 95 % interval, ``vehicle1_delta_v_p025`` and ``_p975``.
/// seed : int
///     (–) of the random numbers of every row that has none in a column ``seed``.
/// threads : int, optional
///     By default one for each processor. The results do not depend on it, bit for bit.
///
/// Returns
/// -------
/// Rows
///     The columns that are carried over, the results in SI units and radians, and ``error``: what is wrong
///     with a row, or why it has no answer.
///
/// Raises
/// ------
/// CaseError
///     If the template is wrong.
/// ValueError
///     If the table as a whole is wrong: a column that is not a key, or a unit that does not fit.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> table = {"id": [1, 2], "vehicle2.speed [mph]": [10.0, 1e9]}
/// >>> rows = pyarrow.table(pydeltav.reconstruct_table(table, template=pydeltav.Case.example()))
/// >>> rows.select(["id", "found_value", "error"]).to_pylist()[1]["error"]
/// 'vehicle2.speed: "1000000000 mph" is implausibly large for a speed'
#[pyfunction]
#[pyo3(
    signature = (table, *, template = None, samples = None, seed = Whole(1), threads = None),
    text_signature = "(table, *, template=None, samples=None, seed=1, threads=None)"
)]
pub(crate) fn reconstruct_table(
    py: Python<'_>,
    table: Table,
    template: Option<&Bound<'_, PyAny>>,
    samples: Option<Whole<usize>>,
    seed: Whole<u64>,
    threads: Option<Whole<usize>>,
) -> PyResult<Rows> {
    solve(py, Job::Reconstruct, table, template, (sampled(samples, seed), threads))
}

/// Computes the impact of each row of a table from two known speeds: ``Case.impact``.
///
/// Parameters
/// ----------
/// table
///     As in ``reconstruct_table``.
/// template : Case, str, Mapping or os.PathLike, optional
///     As in ``reconstruct_table``.
/// samples : int, optional
///     (–) of each row, for the columns of its 95 % interval, ``vehicle1_delta_v_p025`` and ``_p975``.
/// seed : int
///     (–) of the random numbers of every row that has none in a column ``seed``.
/// threads : int, optional
///     By default one for each processor. The results do not depend on it, bit for bit.
///
/// Returns
/// -------
/// Rows
///     The columns that are carried over, the results in SI units and radians, and ``error``: what is wrong
///     with a row, or why it has no answer.
///
/// Raises
/// ------
/// CaseError
///     If the template is wrong.
/// ValueError
///     If the table as a whole is wrong: a column that is not a key, or a unit that does not fit.
///
/// Examples
/// --------
/// >>> table = {"vehicle1.speed [mph]": [40.0, 50.0]}
/// >>> len(pydeltav.impact_table(table, template=pydeltav.Case.example()))
/// 2
#[pyfunction]
#[pyo3(
    signature = (table, *, template = None, samples = None, seed = Whole(1), threads = None),
    text_signature = "(table, *, template=None, samples=None, seed=1, threads=None)"
)]
pub(crate) fn impact_table(
    py: Python<'_>,
    table: Table,
    template: Option<&Bound<'_, PyAny>>,
    samples: Option<Whole<usize>>,
    seed: Whole<u64>,
    threads: Option<Whole<usize>>,
) -> PyResult<Rows> {
    solve(py, Job::Impact, table, template, (sampled(samples, seed), threads))
}

/// Computes crush energy and ΔV of each row of a table from damage and PDOF alone: ``Case.crush``.
///
/// Parameters
/// ----------
/// table
///     As in ``reconstruct_table``.
/// template : Case, str, Mapping or os.PathLike, optional
///     As in ``reconstruct_table``.
/// threads : int, optional
///     By default one for each processor. The results do not depend on it, bit for bit.
///
/// Returns
/// -------
/// Rows
///     The columns that are carried over, the results in SI units and radians, and ``error``: what is wrong
///     with a row, or why it has no answer.
///
/// Raises
/// ------
/// CaseError
///     If the template is wrong.
/// ValueError
///     If the table as a whole is wrong: a column that is not a key, or a unit that does not fit.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> crush = {"pdof": "0 deg", "moment_arm": "0 m"}
/// >>> template = {"vehicle1": {"mass": "1500 kg", "class": 3, "crush": crush}, "vehicle2": {"fixed": True}}
/// >>> rows = pydeltav.crush_table({"vehicle1.crush.ees [km/h]": [36.0, 54.0]}, template=template)
/// >>> pyarrow.table(rows)["vehicle1_crash3_delta_v"].to_pylist()
/// [10.0, 15.0]
#[pyfunction]
#[pyo3(signature = (table, *, template = None, threads = None))]
pub(crate) fn crush_table(
    py: Python<'_>,
    table: Table,
    template: Option<&Bound<'_, PyAny>>,
    threads: Option<Whole<usize>>,
) -> PyResult<Rows> {
    solve(py, Job::Crush, table, template, (RowOptions::default(), threads))
}

/// Estimates the speeds of each row of a table from all its evidence: ``Case.estimate``.
///
/// Parameters
/// ----------
/// table
///     As in ``reconstruct_table``.
/// template : Case, str, Mapping or os.PathLike, optional
///     As in ``reconstruct_table``.
/// particles : int
///     (–) of each of 16 islands, a multiple of 128.
/// seed : int
///     (–) of the random numbers of every row that has none in a column ``seed``.
/// prior : {"field", "serious-injury", "flat"}, optional
///     The severity before the evidence, in place of that of the rows.
/// threads : int, optional
///     By default one for each processor. The results do not depend on it, bit for bit.
///
/// Returns
/// -------
/// Rows
///     The columns that are carried over, the results in SI units and radians, and ``error``: what is wrong
///     with a row, or why it has no answer.
///
/// Raises
/// ------
/// CaseError
///     If the template is wrong.
/// ValueError
///     If the table as a whole is wrong: a column that is not a key, or a unit that does not fit.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> rows = pydeltav.estimate_table({"seed": [1]}, template=pydeltav.Case.example(), particles=128)
/// >>> [row] = pyarrow.table(rows).to_pylist()
/// >>> row["vehicle1_speed_p025"] < row["vehicle1_speed_median"] < row["vehicle1_speed_p975"]
/// True
#[pyfunction]
#[pyo3(
    signature = (table, *, template = None, particles = Whole(EstimatePlan::PARTICLES), seed = Whole(1), prior = None, threads = None),
    text_signature = "(table, *, template=None, particles=256, seed=1, prior=None, threads=None)"
)]
pub(crate) fn estimate_table(
    py: Python<'_>,
    table: Table,
    template: Option<&Bound<'_, PyAny>>,
    particles: Whole<usize>,
    seed: Whole<u64>,
    prior: Option<&str>,
    threads: Option<Whole<usize>>,
) -> PyResult<Rows> {
    let prior = self::prior(prior)?;
    let options = RowOptions { particles: particles.0, seed: seed.0, prior, ..RowOptions::default() };
    solve(py, Job::Estimate, table, template, (options, threads))
}

/// Solves the rows of a table as they are read, in constant memory: for a table that does not fit into
/// memory, or for results that another program reads as they come.
///
/// Parameters
/// ----------
/// job : {"reconstruct", "impact", "crush", "estimate", "avoid"}
///     What to compute for each row.
/// table
///     As in ``reconstruct_table``.
/// template : Case, str, Mapping or os.PathLike, optional
///     As in ``reconstruct_table``.
/// samples : int, optional
///     (–) of each row, for the columns of its 95 % interval, ``vehicle1_delta_v_p025`` and ``_p975``.
/// particles : int
///     (–) of each of 16 islands, a multiple of 128.
/// seed : int
///     (–) of the random numbers of every row that has none in a column ``seed``.
/// prior : {"field", "serious-injury", "flat"}, optional
///     The severity before the evidence, in place of that of the rows.
/// threads : int, optional
///     By default one for each processor. The results do not depend on it, bit for bit.
///
/// Returns
/// -------
/// RowStream
///     It can be read once. The error of a row is in its column ``error``.
///
/// Raises
/// ------
/// CaseError
///     If the template is wrong.
/// ValueError
///     If the table as a whole is wrong: a column that is not a key, or a unit that does not fit.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> speeds = {"vehicle2.speed [mph]": [10.0, 12.0]}
/// >>> stream = pydeltav.stream_table("reconstruct", speeds, template=pydeltav.Case.example())
/// >>> reader = pyarrow.RecordBatchReader.from_stream(stream)
/// >>> sum(batch.num_rows for batch in reader)
/// 2
#[pyfunction]
#[pyo3(
    signature = (job, table, *, template = None, samples = None, particles = Whole(EstimatePlan::PARTICLES), seed = Whole(1), prior = None, threads = None),
    text_signature = "(job, table, *, template=None, samples=None, particles=256, seed=1, prior=None, threads=None)"
)]
#[expect(clippy::too_many_arguments, reason = "Python names them")]
pub(crate) fn stream_table(
    py: Python<'_>,
    job: &str,
    table: Table,
    template: Option<&Bound<'_, PyAny>>,
    samples: Option<Whole<usize>>,
    particles: Whole<usize>,
    seed: Whole<u64>,
    prior: Option<&str>,
    threads: Option<Whole<usize>>,
) -> PyResult<RowStream> {
    let job = self::job(job)?;
    let prior = self::prior(prior)?;
    let options = RowOptions { particles: particles.0, prior, ..sampled(samples, seed) };
    let table = table.0;
    let asked = asked(py, &table.schema(), job, template, options)?;
    let pool = pool(threads.map(|threads| threads.0))?;
    // Errors of the table or the options are raised now, and not when somebody reads the stream.
    let none = RecordBatch::new_empty(table.schema());
    asked.solve(&none, &Ending::never()).map_err(|error| wrong_table(py, error))?;
    Ok(RowStream::of(Parts { asked, table, pool, left: None }))
}

/// The schema of a table of cases: structs and lists as in the case file, in SI units and radians.
///
/// Parameters
/// ----------
/// ranges : bool
///     Whether a number is a struct, which can be a range.
///
/// Returns
/// -------
/// Schema
///     For whatever speaks Arrow.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> pyarrow.schema(pydeltav.case_schema()).field("vehicle1").type.field("mass").type
/// DataType(double)
#[pyfunction]
#[pyo3(signature = (*, ranges = false))]
pub(crate) fn case_schema(ranges: bool) -> PySchema {
    let numbers = if ranges { Numbers::Ranges } else { Numbers::Plain };
    PySchema(Arc::new(tables::case_schema(numbers)))
}

/// The schema of the results of a table, which Spark and others need before there are data. Columns that
/// are carried over come before these.
///
/// Parameters
/// ----------
/// job : {"reconstruct", "impact", "crush", "estimate", "avoid"}
///     What to compute for each row.
/// samples : int, optional
///     (–) as for the table; with it there are columns of intervals.
///
/// Returns
/// -------
/// Schema
///     The columns, in SI units and radians.
///
/// Raises
/// ------
/// ValueError
///     If there is no such job.
///
/// Examples
/// --------
/// >>> import pyarrow
/// >>> "vehicle1_delta_v_p975" in pyarrow.schema(pydeltav.result_schema("reconstruct", samples=1000)).names
/// True
#[pyfunction]
#[pyo3(signature = (job = "reconstruct", *, samples = None))]
pub(crate) fn result_schema(job: &str, samples: Option<Whole<usize>>) -> PyResult<PySchema> {
    let job = self::job(job)?;
    let options = RowOptions { samples: samples.map(|samples| samples.0), ..RowOptions::default() };
    Ok(PySchema(tables::result_schema(job, &options)))
}

#[pymethods]
impl Rows {
    /// The names of the columns.
    #[getter]
    fn names(&self) -> Vec<String> {
        names(&self.schema)
    }

    fn __len__(&self) -> usize {
        self.batches.iter().map(RecordBatch::num_rows).sum()
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let arrays =
            self.batches.clone().into_iter().map(|batch| Ok(Arc::new(StructArray::from(batch)) as _));
        as_stream(py, &self.schema, arrays, requested_schema)
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.schema.as_ref())?)
    }

    fn __repr__(&self) -> String {
        format!("<pydeltav.Rows: {} rows of {} columns>", self.__len__(), self.schema.fields().len())
    }
}

#[pymethods]
impl PySchema {
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.0.as_ref())?)
    }

    fn __repr__(&self) -> String {
        let names: Vec<&str> = self.0.fields().iter().map(|field| field.name().as_str()).collect();
        format!("<pydeltav.Schema: {}>", names.join(", "))
    }
}
