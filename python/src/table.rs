//! A table as users pass it: from any library that uses Arrow, or a dict of columns.

use std::sync::Arc;

use arrow_array::types::Float64Type;
use arrow_array::{
    ArrayRef, BooleanArray, Float64Array, Int64Array, ListArray, NullArray, RecordBatch, RecordBatchIterator,
    RecordBatchReader, StringArray,
};
use arrow_schema::{Field, Schema};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyList, PyMapping, PyString, PyTuple};
use pyo3_arrow::input::AnyRecordBatch;

/// The rows of a table, read as they are needed.
pub(crate) struct Table(pub(crate) Box<dyn RecordBatchReader + Send>);

/// The forms that a table can have.
const WANTED: &str = "give a table of pyarrow, Polars, pandas or DuckDB, or a dict of columns, such as \
                      {\"vehicle2.speed [mph]\": [10.0, 12.0]}";

impl FromPyObject<'_, '_> for Table {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        let kind = given.get_type().name()?;
        if given.hasattr("__arrow_c_stream__")? || given.hasattr("__arrow_c_array__")? {
            let table = given.extract::<AnyRecordBatch>().and_then(AnyRecordBatch::into_reader);
            return table.map(Self).map_err(|error| {
                let reason = error.value(given.py());
                PyTypeError::new_err(format!("the {kind} is not a table of columns ({reason}): {WANTED}"))
            });
        }
        let Ok(columns) = given.cast::<PyMapping>() else {
            return Err(PyTypeError::new_err(format!("a {kind} is not a table: {WANTED}")));
        };
        let batch = of_columns(&columns)?;
        let schema = batch.schema();
        Ok(Self(Box::new(RecordBatchIterator::new([Ok(batch)], schema))))
    }
}

/// The columns of a dict, each a list or an array.
fn of_columns(columns: &Bound<'_, PyMapping>) -> PyResult<RecordBatch> {
    let mut fields: Vec<Field> = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for item in columns.items()?.iter() {
        let (name, values) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
        let Ok(name) = name.extract::<String>() else {
            let problem = format!("the name of a column is a text, not {}", name.repr()?);
            return Err(PyTypeError::new_err(problem));
        };
        let array = column(&name, &values)?;
        if let (Some(first), Some(of_first)) = (arrays.first(), fields.first())
            && first.len() != array.len()
        {
            return Err(PyValueError::new_err(format!(
                "the columns \"{}\" and \"{}\" have {} and {} rows: give all the same number",
                case::shown(of_first.name()),
                case::shown(&name),
                first.len(),
                array.len()
            )));
        }
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    if arrays.is_empty() {
        return Err(PyValueError::new_err(format!("the dict has no columns: {WANTED}")));
    }
    let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays);
    batch.map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The value of a row in a column.
enum Cell {
    Nothing,
    Flag(bool),
    /// A whole number, and the nearest floating-point number.
    Whole(i64, f64),
    Number(f64),
    Text(String),
    Numbers(Vec<Option<f64>>),
}

/// The common kind of the rows of a column.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Nothing,
    Flag,
    Whole,
    Number,
    Text,
    Numbers,
}

impl Cell {
    fn kind(&self) -> Kind {
        match self {
            Self::Nothing => Kind::Nothing,
            Self::Flag(_) => Kind::Flag,
            Self::Whole(..) => Kind::Whole,
            Self::Number(_) => Kind::Number,
            Self::Text(_) => Kind::Text,
            Self::Numbers(_) => Kind::Numbers,
        }
    }

    fn number(&self) -> Option<f64> {
        match self {
            Self::Whole(_, number) | Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}

impl Kind {
    /// The kind of a column that contains both; `None` if no column can.
    fn with(self, other: Self) -> Option<Self> {
        match (self, other) {
            (kind, Self::Nothing) | (Self::Nothing, kind) => Some(kind),
            (Self::Whole, Self::Number) | (Self::Number, Self::Whole) => Some(Self::Number),
            (one, two) => (one == two).then_some(one),
        }
    }

    fn in_words(self) -> &'static str {
        match self {
            Self::Nothing => "None",
            Self::Flag => "flags",
            Self::Whole | Self::Number => "numbers",
            Self::Text => "texts",
            Self::Numbers => "lists of numbers",
        }
    }
}

fn column(name: &str, values: &Bound<'_, PyAny>) -> PyResult<ArrayRef> {
    let shown = case::shown(name);
    let mut cells = Vec::new();
    let mut kind = Kind::Nothing;
    for (row, value) in listed(shown.as_ref(), values)?.iter().enumerate() {
        let Some(cell) = cell(&value)? else {
            let (of, row) = (value.get_type().name()?, row + 1);
            return Err(PyTypeError::new_err(format!(
                "column \"{shown}\", row {row}: a {of} is not a number, text, flag, None or list of \
                 numbers; a pyarrow.table or a Polars frame has columns of other types"
            )));
        };
        let Some(of_both) = kind.with(cell.kind()) else {
            let (before, here, row) = (kind.in_words(), cell.kind().in_words(), row + 1);
            return Err(PyTypeError::new_err(format!(
                "column \"{shown}\" has {before}, and in row {row} {here}: give one kind in a column"
            )));
        };
        kind = of_both;
        cells.push(cell);
    }
    Ok(match kind {
        Kind::Nothing => Arc::new(NullArray::new(cells.len())),
        Kind::Flag => Arc::new(BooleanArray::from_iter(cells.iter().map(|cell| match cell {
            Cell::Flag(flag) => Some(*flag),
            _ => None,
        }))),
        Kind::Whole => Arc::new(Int64Array::from_iter(cells.iter().map(|cell| match cell {
            Cell::Whole(number, _) => Some(*number),
            _ => None,
        }))),
        Kind::Number => Arc::new(Float64Array::from_iter(cells.iter().map(Cell::number))),
        Kind::Text => Arc::new(StringArray::from_iter(cells.iter().map(|cell| match cell {
            Cell::Text(text) => Some(text),
            _ => None,
        }))),
        Kind::Numbers => {
            Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(cells.into_iter().map(|cell| {
                match cell {
                    Cell::Numbers(numbers) => Some(numbers),
                    _ => None,
                }
            })))
        }
    })
}

/// The values of a column as objects of Python.
fn listed<'py>(shown: &str, values: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyList>> {
    let py = values.py();
    let one = values.is_instance_of::<PyString>()
        || values.is_instance_of::<PyBytes>()
        || values.cast::<PyMapping>().is_ok();
    // Arrays of NumPy and pyarrow, series of pandas; of Polars.
    for method in ["tolist", "to_list"] {
        if !one
            && values.hasattr(method)?
            && let Ok(list) = values.call_method0(method)?.cast_into::<PyList>()
        {
            return Ok(list);
        }
    }
    if one || !values.hasattr("__iter__")? {
        let kind = values.get_type().name()?;
        let problem = format!(
            "column \"{shown}\" is one {kind}: give a list or an array with a value for each row, or put what \
             all rows share into template="
        );
        return Err(PyTypeError::new_err(problem));
    }
    PyList::new(py, values.try_iter()?.collect::<PyResult<Vec<_>>>()?)
}

/// The value of a row; `None` for a value that no column can contain.
fn cell(value: &Bound<'_, PyAny>) -> PyResult<Option<Cell>> {
    if value.is_none() {
        return Ok(Some(Cell::Nothing));
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Some(Cell::Flag(flag.is_true())));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Some(Cell::Text(text.to_str()?.to_owned())));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return numbers(value);
    }
    // Numbers, flags and arrays of NumPy.
    if value.hasattr("tolist")? {
        let plain = value.call_method0("tolist")?;
        return if plain.hasattr("tolist")? { Ok(None) } else { cell(&plain) };
    }
    let Ok(number) = value.extract::<f64>() else { return Ok(None) };
    Ok(Some(value.extract::<i64>().map_or(Cell::Number(number), |whole| Cell::Whole(whole, number))))
}

/// A list of numbers, such as the depths of a crush.
fn numbers(list: &Bound<'_, PyAny>) -> PyResult<Option<Cell>> {
    let mut numbers = Vec::new();
    for value in list.try_iter()? {
        let value = value?;
        // A list of lists is not a value of a case, and a list may contain itself.
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            return Ok(None);
        }
        match cell(&value)? {
            Some(Cell::Nothing) => numbers.push(None),
            Some(one) => match one.number() {
                Some(number) => numbers.push(Some(number)),
                None => return Ok(None),
            },
            None => return Ok(None),
        }
    }
    Ok(Some(Cell::Numbers(numbers)))
}
