//! Cases as tables: nested in the exported schema, and flat.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::builder::{BooleanBuilder, Float64Builder, Int64Builder, StringBuilder};
use arrow_array::{ArrayRef, Float64Array, ListArray, RecordBatch, StringArray, StructArray};
use arrow_buffer::{NullBuffer, OffsetBuffer};
use arrow_schema::{DataType, Field, Fields, Schema};
use case::{Value, ValueTable};
use tables::{Numbers, case_schema};

/// Cases in SI units as rows of the exported schema, ranges included.
pub(crate) fn nested(cases: &[&ValueTable<'_>]) -> RecordBatch {
    let schema = case_schema(Numbers::Ranges);
    let columns = schema.fields().iter().map(|field| {
        let values: Vec<Option<&Value<'_>>> = cases.iter().map(|case| case.get(field.name())).collect();
        array(field.data_type(), &values)
    });
    let columns: Vec<ArrayRef> = columns.collect();
    RecordBatch::try_new(Arc::new(schema), columns).unwrap()
}

/// The values as a column of a type that has a place for each.
fn array(data_type: &DataType, values: &[Option<&Value<'_>>]) -> ArrayRef {
    match data_type {
        DataType::Struct(fields) => structs(fields, values),
        DataType::List(item) => {
            let mut lengths = Vec::new();
            let mut flat: Vec<Option<&Value<'_>>> = Vec::new();
            for value in values {
                // A single word in place of a list of several is not in brackets in the file.
                match value {
                    Some(Value::List(list)) => {
                        flat.extend(list.iter().map(Some));
                        lengths.push(list.len());
                    }
                    Some(other) => {
                        flat.push(Some(other));
                        lengths.push(1);
                    }
                    None => lengths.push(0),
                }
            }
            let nulls: NullBuffer = values.iter().map(Option::is_some).collect();
            let listed = array(item.data_type(), &flat);
            Arc::new(ListArray::new(item.clone(), OffsetBuffer::from_lengths(lengths), listed, Some(nulls)))
        }
        DataType::Float64 => {
            let mut numbers = Float64Builder::new();
            for value in values {
                numbers.append_option(value.map(|value| match value {
                    Value::Number(number) | Value::Quantity(number, _) => *number,
                    Value::Text(text) => text.trim_end_matches(['%', ' ']).parse().unwrap(),
                    other => panic!("{other:?} is no number"),
                }));
            }
            Arc::new(numbers.finish())
        }
        DataType::Int64 => {
            let mut numbers = Int64Builder::new();
            for value in values {
                #[expect(clippy::cast_possible_truncation, reason = "counts")]
                numbers.append_option(value.map(|value| match value {
                    Value::Number(number) => *number as i64,
                    other => panic!("{other:?} is no count"),
                }));
            }
            Arc::new(numbers.finish())
        }
        DataType::Boolean => {
            let mut flags = BooleanBuilder::new();
            for value in values {
                flags.append_option(value.map(|value| *value == Value::Flag(true)));
            }
            Arc::new(flags.finish())
        }
        DataType::Utf8 => {
            let mut texts = StringBuilder::new();
            for value in values {
                texts.append_option(value.map(|value| match value {
                    Value::Text(text) => text.to_string(),
                    Value::Quantity(number, unit) => format!("{number} {unit}"),
                    other => panic!("{other:?} is no text"),
                }));
            }
            Arc::new(texts.finish())
        }
        other => panic!("no column has the type {other}"),
    }
}

fn structs(fields: &Fields, values: &[Option<&Value<'_>>]) -> ArrayRef {
    let has = |name: &str| fields.find(name).is_some();
    let columns = fields.iter().map(|field| {
        let of_field: Vec<Option<&Value<'_>>> = values
            .iter()
            .map(|value| match (value.as_ref()?, field.name().as_str()) {
                (Value::Table(table), name) => table.get(name),
                (list @ Value::List(_), "wheels" | "over_time") => Some(*list),
                (list @ Value::List(_), "values") => Some(*list),
                (Value::List(_), _) => None,
                (word @ Value::Text(_), "word") => Some(*word),
                (text @ Value::Text(_), "value") if !has("word") => Some(*text),
                (number @ (Value::Number(_) | Value::Quantity(..)), "value") => Some(*number),
                _ => None,
            })
            .collect();
        array(field.data_type(), &of_field)
    });
    let columns: Vec<ArrayRef> = columns.collect();
    let nulls: NullBuffer = values.iter().map(Option::is_some).collect();
    Arc::new(StructArray::try_new_with_length(fields.clone(), columns, Some(nulls), values.len()).unwrap())
}

/// The naming of the columns of a flat table.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Names {
    /// `vehicle1.mass [lb]`
    Dotted,
    /// `vehicle1__mass`, and the unit in the metadata.
    Underscored,
    /// `vehicle1.mass [lb]`, and every number a text.
    Texts,
}

/// A case as a table of one row with a column for each number.
pub(crate) fn flat(case: &ValueTable<'_>, names: Names) -> RecordBatch {
    let mut columns = Vec::new();
    flatten(case, "", names, &mut columns);
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns.into_iter().unzip();
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).unwrap()
}

fn flatten(table: &ValueTable<'_>, within: &str, names: Names, columns: &mut Vec<(Field, ArrayRef)>) {
    for (key, value) in table.iter() {
        let dot = if names == Names::Underscored { "__" } else { "." };
        let path = if within.is_empty() { key.to_owned() } else { format!("{within}{dot}{key}") };
        leaf(value, &path, names, columns);
    }
}

fn leaf(value: &Value<'_>, path: &str, names: Names, columns: &mut Vec<(Field, ArrayRef)>) {
    let number = |number: f64| -> ArrayRef {
        match names {
            Names::Texts => Arc::new(StringArray::from(vec![number.to_string()])),
            _ => Arc::new(Float64Array::from(vec![number])),
        }
    };
    let mut add = |name: &str, array: ArrayRef, unit: Option<&str>| {
        let field = Field::new(name, array.data_type().clone(), true);
        let metadata = unit.map(|unit| HashMap::from([("unit".to_owned(), unit.to_owned())]));
        columns.push((field.with_metadata(metadata.unwrap_or_default()), array));
    };
    match value {
        Value::Number(of) => add(path, number(*of), None),
        Value::Quantity(of, unit) if names == Names::Underscored => {
            add(path, number(*of), Some(unit.spelling()));
        }
        Value::Quantity(of, unit) => add(&format!("{path} [{unit}]"), number(*of), None),
        Value::Text(text) => add(path, Arc::new(StringArray::from(vec![text.to_string()])), None),
        Value::Flag(flag) => {
            let array: ArrayRef = match names {
                Names::Texts => Arc::new(StringArray::from(vec![flag.to_string()])),
                _ => Arc::new(arrow_array::BooleanArray::from(vec![*flag])),
            };
            add(path, array, None);
        }
        Value::Table(table) => flatten(table, path, names, columns),
        Value::List(list) => {
            for (index, one) in list.iter().enumerate() {
                let path = match names {
                    Names::Underscored => format!("{path}__{}", index + 1),
                    _ => format!("{path}[{}]", index + 1),
                };
                leaf(one, &path, names, columns);
            }
        }
    }
}
