//! `Columns`: samples and draws for Arrow and NumPy, without a copy.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array as _, ArrayRef, Float64Array, RecordBatch, StringArray, StructArray};
use arrow_buffer::{Buffer, NullBuffer, ScalarBuffer};
use arrow_schema::{DataType, Field, Schema};
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyCapsule, PyTuple};
use pyo3_arrow::buffer::PyArrowBuffer;
use pyo3_arrow::ffi::{ArrayIterator, to_array_pycapsules, to_stream_pycapsule};

/// The samples of an uncertainty, or the draws of an estimate: a column for each number, in SI units and
/// radians. It can be read like a dict of columns by their keys.
///
/// ``columns[key]`` is a NumPy array on the memory of the result, without a copy: it cannot be written to,
/// and outlives the result. A sample without an answer is NaN. Whatever speaks Arrow takes the whole as it
/// is: ``polars.DataFrame(columns)``, ``pyarrow.record_batch(columns)``,
/// ``pandas.DataFrame.from_arrow(columns)``. There the columns are named after their keys, with ``_`` in
/// place of dots and brackets, and ``columns["vehicle1_speed"]`` knows them by these names, too; a sample
/// without an answer is null, and the column ``failed`` says why it has none.
///
/// Raises
/// ------
/// KeyError
///     If there is no such column; the message lists those that exist.
///
/// Examples
/// --------
/// >>> case = pydeltav.Case.parse(pydeltav.Case.example().text.replace(
/// ...     '"10 mph"', '{ low = "8 mph", high = "12 mph" }'))
/// >>> columns = case.uncertainty(1000).columns()
/// >>> columns.rows, columns["vehicle1.speed"].shape, columns["vehicle1.speed"].dtype
/// (1000, (1000,), dtype('float64'))
/// >>> columns.names[:2]
/// ['failed', 'vehicle1_speed']
#[pyclass(name = "Columns", module = "pydeltav", frozen, mapping)]
pub(crate) struct Columns {
    keys: Vec<String>,
    batch: RecordBatch,
}

/// Why samples have no answer; the name of the column.
const FAILED: &str = "failed";

/// `vehicle1.crush.depths[0]` → `vehicle1_crush_depths_0`: a dot is an operator to Spark and SQL.
fn name(key: &str) -> String {
    key.replace("].", "_").replace(['.', '['], "_").replace(']', "")
}

impl Columns {
    /// From the reasons of failed samples, if samples can fail, and the columns with their keys.
    pub(crate) fn new(reasons: Option<Vec<Option<&str>>>, columns: Vec<(String, Buffer)>) -> PyResult<Self> {
        let wrong = |error: arrow_schema::ArrowError| PyRuntimeError::new_err(error.to_string());
        let can_fail = reasons.is_some();
        let mut fields = Vec::new();
        let mut arrays: Vec<ArrayRef> = Vec::new();
        if let Some(reasons) = reasons {
            fields.push(Field::new(FAILED, DataType::Utf8, true));
            arrays.push(Arc::new(StringArray::from(reasons)));
        }
        let mut keys = Vec::new();
        for (key, buffer) in columns {
            let values = ScalarBuffer::<f64>::from(buffer);
            let nulls = can_fail.then(|| values.iter().map(|value| !value.is_nan()).collect::<NullBuffer>());
            let nulls = nulls.filter(|nulls| nulls.null_count() > 0);
            arrays.push(Arc::new(Float64Array::try_new(values, nulls).map_err(wrong)?));
            let of_key = HashMap::from([("key".to_owned(), key.clone())]);
            fields.push(Field::new(name(&key), DataType::Float64, can_fail).with_metadata(of_key));
            keys.push(key);
        }
        let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(wrong)?;
        Ok(Self { keys, batch })
    }

    fn struct_array(&self) -> (Arc<Field>, ArrayRef) {
        let array: ArrayRef = Arc::new(StructArray::from(self.batch.clone()));
        (Arc::new(Field::new("", array.data_type().clone(), false)), array)
    }

    /// The number of columns before those of the keys.
    fn leading(&self) -> usize {
        self.batch.num_columns() - self.keys.len()
    }

    /// The index of a key, which may also be given by the column's name in Arrow.
    fn place(&self, key: &str) -> Option<usize> {
        let exactly = self.keys.iter().position(|known| known == key);
        exactly.or_else(|| self.keys.iter().position(|known| name(known) == key))
    }

    fn buffer(&self, place: usize) -> Option<Buffer> {
        let column =
            self.batch.columns().get(self.leading() + place)?.as_any().downcast_ref::<Float64Array>()?;
        Some(column.values().inner().clone())
    }
}

#[pymethods]
impl Columns {
    /// The keys of the columns, as in the JSON.
    ///
    /// Returns
    /// -------
    /// list of str
    ///     Such as ``"vehicle1.speed"``.
    ///
    /// Examples
    /// --------
    /// >>> columns.keys()[:2]
    /// ['vehicle1.speed', 'vehicle1.delta_v']
    fn keys(&self) -> Vec<String> {
        self.keys.clone()
    }

    /// The columns, in the order of the keys.
    ///
    /// Returns
    /// -------
    /// list of numpy.ndarray
    ///     (SI) each on the memory of the result.
    ///
    /// Examples
    /// --------
    /// >>> len(columns.values()) == len(columns)
    /// True
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.keys.iter().map(|key| self.__getitem__(py, key)).collect()
    }

    /// The keys with their columns.
    ///
    /// Returns
    /// -------
    /// list of (str, numpy.ndarray)
    ///     (SI) each column on the memory of the result.
    ///
    /// Examples
    /// --------
    /// >>> widths = {key: column.max() - column.min() for key, column in columns.items()}
    /// >>> bool(widths["vehicle1.speed"] > 0.0)
    /// True
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        self.keys.iter().map(|key| Ok((key.clone(), self.__getitem__(py, key)?))).collect()
    }

    /// The column of a key, or the default.
    ///
    /// Parameters
    /// ----------
    /// key : str
    ///     As in ``columns[key]``.
    /// default : optional
    ///     Returned if there is no such column.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     (SI) on the memory of the result.
    ///
    /// Examples
    /// --------
    /// >>> columns.get("vehicle3.speed") is None
    /// True
    #[pyo3(signature = (key, default = None))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        key: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let known = key.extract::<String>().ok().filter(|key| self.place(key).is_some());
        known.map_or(Ok(default), |key| self.__getitem__(py, &key).map(Some))
    }

    /// The names of all columns in Arrow.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.batch.schema().fields().iter().map(|field| field.name().clone()).collect()
    }

    /// The number of samples or draws.
    #[getter]
    fn rows(&self) -> usize {
        self.batch.num_rows()
    }

    fn __len__(&self) -> usize {
        self.keys.len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.keys.clone().into_pyobject(py)?.try_iter()?.into_any())
    }

    fn __contains__(&self, key: &Bound<'_, PyAny>) -> bool {
        key.extract::<String>().is_ok_and(|key| self.place(&key).is_some())
    }

    fn __getitem__<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        let Some(buffer) = self.place(key).and_then(|place| self.buffer(place)) else {
            let problem = if key == FAILED && self.leading() > 0 {
                format!("{FAILED} is a column of texts: pyarrow.table(columns)[\"{FAILED}\"] has it")
            } else {
                format!("{}: the columns are {}", case::shown(key), self.keys.join(", "))
            };
            return Err(PyKeyError::new_err(problem));
        };
        let buffer = PyArrowBuffer::new(buffer).into_pyobject(py)?;
        py.import("numpy")?.call_method1("frombuffer", (buffer, "float64"))
    }

    /// An array has no names: ``pandas.DataFrame(columns)``, which makes one array of all columns, would lose
    /// them. The error names the calls that keep them.
    #[pyo3(signature = (dtype = None, copy = None))]
    fn __array__(&self, dtype: Option<&Bound<'_, PyAny>>, copy: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let _ = (dtype, copy);
        Err(PyTypeError::new_err(
            "an array or pandas.DataFrame(columns) would lose the names of the columns: use \
             pandas.DataFrame.from_arrow(columns), pandas.DataFrame(dict(columns)), or \
             numpy.column_stack(columns.values())",
        ))
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (field, array) = self.struct_array();
        Ok(to_array_pycapsules(py, field, &array, requested_schema)?)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let (field, array) = self.struct_array();
        let reader = ArrayIterator::new([Ok(array)].into_iter(), field);
        Ok(to_stream_pycapsule(py, Box::new(reader), requested_schema)?)
    }

    fn __repr__(&self) -> String {
        format!("<pydeltav.Columns: {} rows of {}>", self.rows(), self.names().join(", "))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let restore = py.import("pydeltav._pydeltav")?.getattr("_restore_columns")?;
        let reasons = (self.leading() > 0).then(|| {
            let column = self.batch.column(0).as_any().downcast_ref::<StringArray>();
            column.map(|column| column.iter().map(|reason| reason.map(str::to_owned)).collect::<Vec<_>>())
        });
        let columns: Vec<(&str, Bound<'py, PyBytes>)> = (self.keys.iter().enumerate())
            .filter_map(|(place, key)| Some((key.as_str(), PyBytes::new(py, &self.buffer(place)?))))
            .collect();
        Ok((restore, (reasons.flatten(), columns).into_pyobject(py)?))
    }
}

/// Columns that were pickled.
#[pyfunction]
#[pyo3(name = "_restore_columns")]
pub(crate) fn restore_columns(
    reasons: Option<Vec<Option<String>>>,
    columns: Vec<(String, PyBackedBytes)>,
) -> PyResult<Columns> {
    let reasons = reasons.as_ref().map(|reasons| reasons.iter().map(Option::as_deref).collect());
    let number = |bytes: &[u8]| <[u8; 8]>::try_from(bytes).map_or(f64::NAN, f64::from_ne_bytes);
    let read =
        |bytes: PyBackedBytes| Buffer::from_vec(bytes.chunks_exact(8).map(number).collect::<Vec<f64>>());
    Columns::new(reasons, columns.into_iter().map(|(key, bytes)| (key, read(bytes))).collect())
}
