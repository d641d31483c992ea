//! One column, of any type that holds numbers, texts or flags.

use std::ops::Range;

use arrow_array::cast::AsArray as _;
use arrow_array::types::{
    Decimal128Type, Decimal256Type, DecimalType, Float16Type, Float32Type, Float64Type, Int8Type, Int16Type,
    Int32Type, Int64Type, UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{
    Array, BooleanArray, FixedSizeListArray, LargeListArray, LargeStringArray, ListArray, PrimitiveArray,
    StringArray, StringViewArray,
};
use arrow_buffer::NullBuffer;
use arrow_schema::DataType;

/// The value in one row of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cell<'a> {
    Number(f64),
    Text(&'a str),
    Flag(bool),
}

/// A column without structs or lists.
pub(crate) struct Column<'a> {
    values: Values<'a>,
    /// For a dictionary, the index of each row's value.
    places: Option<Vec<usize>>,
    nulls: Option<NullBuffer>,
}

enum Values<'a> {
    Null,
    Double(&'a PrimitiveArray<Float64Type>),
    Single(&'a PrimitiveArray<Float32Type>),
    Whole(Vec<f64>),
    Utf8(&'a StringArray),
    LargeUtf8(&'a LargeStringArray),
    Utf8View(&'a StringViewArray),
    Flags(&'a BooleanArray),
}

impl<'a> Column<'a> {
    /// Whether a column of this type holds numbers.
    pub(crate) fn is_number(data_type: &DataType) -> bool {
        match data_type {
            DataType::Dictionary(_, values) => Self::is_number(values),
            DataType::Null | DataType::Float64 | DataType::Float32 | DataType::Float16 => true,
            DataType::Decimal128(..) | DataType::Decimal256(..) => true,
            other => other.is_integer(),
        }
    }

    /// Whether a column of this type holds texts.
    pub(crate) fn is_text(data_type: &DataType) -> bool {
        match data_type {
            DataType::Dictionary(_, values) => Self::is_text(values),
            other => {
                matches!(other, DataType::Null | DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View)
            }
        }
    }

    /// Whether a column of this type holds true and false.
    pub(crate) fn is_flag(data_type: &DataType) -> bool {
        match data_type {
            DataType::Dictionary(_, values) => Self::is_flag(values),
            other => matches!(other, DataType::Null | DataType::Boolean),
        }
    }

    /// The column; `None` if [`reads`](Self::reads) does not know its type. `gate` marks the rows whose
    /// struct is null, which have no value.
    pub(crate) fn of(array: &'a dyn Array, gate: Option<&NullBuffer>) -> Option<Self> {
        let nulls = NullBuffer::union(array.logical_nulls().as_ref(), gate);
        if let Some(dictionary) = array.as_any_dictionary_opt() {
            let inner = Self::of(dictionary.values().as_ref(), None)?;
            if dictionary.values().is_empty() {
                return Some(Self { values: Values::Null, places: None, nulls: None });
            }
            return Some(Self { values: inner.values, places: Some(dictionary.normalized_keys()), nulls });
        }
        macro_rules! whole {
            ($type:ty) => {
                Values::Whole(array.as_primitive::<$type>().values().iter().map(|&v| v as f64).collect())
            };
        }
        let values = match array.data_type() {
            DataType::Null => Values::Null,
            DataType::Float64 => Values::Double(array.as_primitive()),
            DataType::Float32 => Values::Single(array.as_primitive()),
            DataType::Float16 => {
                let halves = array.as_primitive::<Float16Type>().values();
                Values::Whole(halves.iter().map(|half| half.to_f64()).collect())
            }
            DataType::Decimal128(..) => Values::Whole(decimals(array.as_primitive::<Decimal128Type>())),
            DataType::Decimal256(..) => Values::Whole(decimals(array.as_primitive::<Decimal256Type>())),
            DataType::Int8 => whole!(Int8Type),
            DataType::Int16 => whole!(Int16Type),
            DataType::Int32 => whole!(Int32Type),
            DataType::Int64 => whole!(Int64Type),
            DataType::UInt8 => whole!(UInt8Type),
            DataType::UInt16 => whole!(UInt16Type),
            DataType::UInt32 => whole!(UInt32Type),
            DataType::UInt64 => whole!(UInt64Type),
            DataType::Utf8 => Values::Utf8(array.as_string()),
            DataType::LargeUtf8 => Values::LargeUtf8(array.as_string()),
            DataType::Utf8View => Values::Utf8View(array.as_string_view()),
            DataType::Boolean => Values::Flags(array.as_boolean()),
            _ => return None,
        };
        Some(Self { values, places: None, nulls })
    }

    /// The value in a row; `None` if it is null or a blank text.
    pub(crate) fn cell(&self, row: usize) -> Option<Cell<'a>> {
        if self.nulls.as_ref().is_some_and(|nulls| nulls.is_null(row)) {
            return None;
        }
        let place = self.places.as_ref().map_or(row, |places| places[row]);
        let text = |text: &'a str| (!text.trim().is_empty()).then_some(Cell::Text(text));
        match &self.values {
            Values::Null => None,
            Values::Double(array) => Some(Cell::Number(array.value(place))),
            Values::Single(array) => Some(Cell::Number(f64::from(array.value(place)))),
            Values::Whole(numbers) => Some(Cell::Number(numbers[place])),
            Values::Utf8(array) => text(array.value(place)),
            Values::LargeUtf8(array) => text(array.value(place)),
            Values::Utf8View(array) => text(array.value(place)),
            Values::Flags(array) => Some(Cell::Flag(array.value(place))),
        }
    }
}

/// Decimal numbers, each as the nearest double.
fn decimals<D: DecimalType>(array: &PrimitiveArray<D>) -> Vec<f64> {
    let number = |row: usize| {
        if array.is_null(row) { f64::NAN } else { array.value_as_string(row).parse().unwrap_or(f64::NAN) }
    };
    (0..array.len()).map(number).collect()
}

/// A column of lists.
pub(crate) struct Lists<'a> {
    lists: Kind<'a>,
    nulls: Option<NullBuffer>,
}

enum Kind<'a> {
    Small(&'a ListArray),
    Large(&'a LargeListArray),
    Fixed(&'a FixedSizeListArray),
}

impl<'a> Lists<'a> {
    /// `gate` marks the rows whose struct is null, which have no value.
    pub(crate) fn of(array: &'a dyn Array, gate: Option<&NullBuffer>) -> Option<Self> {
        let lists = match array.data_type() {
            DataType::List(_) => Kind::Small(array.as_list()),
            DataType::LargeList(_) => Kind::Large(array.as_list()),
            DataType::FixedSizeList(..) => Kind::Fixed(array.as_fixed_size_list()),
            _ => return None,
        };
        Some(Self { lists, nulls: NullBuffer::union(array.nulls(), gate) })
    }

    /// The elements of all rows.
    pub(crate) fn values(&self) -> &'a dyn Array {
        match self.lists {
            Kind::Small(list) => list.values().as_ref(),
            Kind::Large(list) => list.values().as_ref(),
            Kind::Fixed(list) => list.values().as_ref(),
        }
    }

    /// The indices of a row's elements in [`values`](Self::values); `None` if the row is null.
    pub(crate) fn places(&self, row: usize) -> Option<Range<usize>> {
        if self.nulls.as_ref().is_some_and(|nulls| nulls.is_null(row)) {
            return None;
        }
        let place = |offset: i64| usize::try_from(offset).unwrap_or_default();
        Some(match self.lists {
            Kind::Small(list) => {
                let offsets = list.value_offsets();
                place(offsets[row].into())..place(offsets[row + 1].into())
            }
            Kind::Large(list) => {
                let offsets = list.value_offsets();
                place(offsets[row])..place(offsets[row + 1])
            }
            Kind::Fixed(list) => {
                let begin = place(list.value_offset(row).into());
                begin..begin + place(list.value_length().into())
            }
        })
    }
}
