//! `RowStream`: rows of a table that are solved as they are read.

use std::sync::{Arc, Mutex};

use arrow_array::{ArrayRef, RecordBatch, RecordBatchReader, StructArray};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use pyo3_arrow::ffi::{ArrayIterator, to_schema_pycapsule, to_stream_pycapsule};
use rayon::ThreadPool;
use tables::{Carried, Job, RowOptions, RowTemplate, TableError};

use crate::run::Ending;

/// (rows) of a stream that are solved at once. Larger batches of a stream are cut into such parts.
const PART: usize = 10_000;

/// The task for every row of a table.
pub(crate) struct Asked {
    pub(crate) job: Job,
    pub(crate) template: RowTemplate,
    pub(crate) options: RowOptions,
    /// The columns of the table that are not part of a case, followed by the results.
    pub(crate) carried: Carried,
}

impl Asked {
    pub(crate) fn solve(&self, batch: &RecordBatch, ending: &Ending) -> Result<RecordBatch, TableError> {
        let goes_on = |_, _| ending.flow();
        let solved = tables::run(self.job, batch, &self.template, &self.options, &goes_on)?;
        self.carried.beside(batch, &solved)
    }
}

/// The parts of a table, each of which is solved when it is read.
pub(crate) struct Parts {
    pub(crate) asked: Asked,
    pub(crate) table: Box<dyn RecordBatchReader + Send>,
    pub(crate) pool: Arc<ThreadPool>,
    /// The rest of the last batch.
    pub(crate) left: Option<RecordBatch>,
}

impl Parts {
    /// The next rows, at most [`PART`].
    fn part(&mut self) -> Option<Result<RecordBatch, ArrowError>> {
        let batch = match self.left.take() {
            Some(left) => left,
            None => match self.table.next()? {
                Ok(batch) => match tables::check_columns(&batch) {
                    Ok(()) => batch,
                    Err(error) => return Some(Err(ArrowError::ExternalError(Box::new(error)))),
                },
                Err(error) => return Some(Err(error)),
            },
        };
        let rows = batch.num_rows().min(PART);
        self.left = (rows < batch.num_rows()).then(|| batch.slice(rows, batch.num_rows() - rows));
        Some(Ok(batch.slice(0, rows)))
    }
}

impl Iterator for Parts {
    type Item = Result<ArrayRef, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        let part = self.part()?;
        let (asked, pool) = (&self.asked, &self.pool);
        Some(part.and_then(|part| {
            let solved = pool.install(|| asked.solve(&part, &Ending::never()));
            let solved = solved.map_err(|error| ArrowError::ExternalError(Box::new(error)))?;
            Ok(Arc::new(StructArray::from(solved)) as ArrayRef)
        }))
    }
}

pub(crate) fn names(schema: &Schema) -> Vec<String> {
    schema.fields().iter().map(|field| field.name().clone()).collect()
}

/// Structs of these columns, for any library that reads Arrow's streams.
pub(crate) fn as_stream<'py>(
    py: Python<'py>,
    schema: &Schema,
    arrays: impl Iterator<Item = Result<ArrayRef, ArrowError>> + Send + 'static,
    requested_schema: Option<Bound<'py, PyCapsule>>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let data_type = DataType::Struct(schema.fields().clone());
    let field = Field::new("", data_type, false).with_metadata(schema.metadata().clone());
    let reader = ArrayIterator::new(arrays, Arc::new(field));
    Ok(to_stream_pycapsule(py, Box::new(reader), requested_schema)?)
}

/// The results of a table, computed as they are read: in order, once, in constant memory.
///
/// Whatever reads Arrow's streams takes it, such as ``pyarrow.RecordBatchReader.from_stream(stream)``.
///
/// Raises
/// ------
/// ValueError
///     If it is read a second time.
///
/// Examples
/// --------
/// >>> table = {"id": ["a"], "vehicle1.weight [lb]": [3600.0]}
/// >>> stream = pydeltav.stream_table("reconstruct", table, template=pydeltav.Case.example())
/// >>> stream.names[0]
/// 'id'
#[pyclass(name = "RowStream", module = "pydeltav", frozen)]
pub(crate) struct RowStream {
    schema: SchemaRef,
    parts: Mutex<Option<Parts>>,
}

impl RowStream {
    pub(crate) fn of(parts: Parts) -> Self {
        Self { schema: parts.asked.carried.schema().clone(), parts: Mutex::new(Some(parts)) }
    }
}

#[pymethods]
impl RowStream {
    /// The names of the columns.
    #[getter]
    fn names(&self) -> Vec<String> {
        names(&self.schema)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let parts = self.parts.lock().ok().and_then(|mut parts| parts.take());
        let Some(parts) = parts else {
            let problem = "the rows of this stream have been read: ask for a new one with stream_table";
            return Err(PyValueError::new_err(problem));
        };
        as_stream(py, &self.schema, parts, requested_schema)
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.schema.as_ref())?)
    }

    fn __repr__(&self) -> String {
        format!("<pydeltav.RowStream of {} columns>", self.schema.fields().len())
    }
}
