//! The schema of a table of cases, made from the keys of the case file.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_schema::{DataType, Field, Fields, Schema};
use case::KeyInfo;

use crate::plan::UNIT;
use crate::shape::Shape;

/// The metadata of a field with its meaning.
const DESCRIPTION: &str = "description";

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// A double.
    Plain,
    /// A struct of `value`, `sd`, `low`, `mode`, `high`, `within` and `confidence`; with only `value` it is a
    /// plain number.
    Ranges,
}

/// The schema of a table of cases: structs and lists that mirror the case file, with `null` for keys that a
/// row does not give. A number with a unit is in SI units, which the metadata `unit` of its field names; the
/// metadata `description` gives its meaning.
///
/// A table need not have all of these columns, nor exactly these types: see the [crate](crate).
///
/// ```
/// use tables::{Numbers, case_schema};
///
/// let schema = case_schema(Numbers::Plain);
/// let vehicle = schema.field_with_name("vehicle1")?;
/// assert!(vehicle.data_type().to_string().contains("\"depths\": List(Float64"));
/// # Ok::<(), arrow_schema::ArrowError>(())
/// ```
#[must_use]
pub fn case_schema(numbers: Numbers) -> Schema {
    Schema::new(fields(Shape::case(), numbers))
}

fn fields(shape: Shape, numbers: Numbers) -> Fields {
    shape.keys().filter(|key| is_own(shape, key)).map(|key| field(shape.within(key), key, numbers)).collect()
}

/// Whether a key is in the struct of a table that is not a range.
fn is_own(shape: Shape, key: &KeyInfo) -> bool {
    match shape {
        Shape::NumberOrTable(keys) => keys.iter().any(|own| own.name == key.name),
        _ => true,
    }
}

fn field(shape: Shape, key: &KeyInfo, numbers: Numbers) -> Field {
    let mut metadata = HashMap::from([(DESCRIPTION.to_owned(), key.text().to_owned())]);
    let unit = match shape {
        Shape::Percent => Some("%"),
        other => other.dimension().map(|dimension| dimension.si_unit()),
    };
    metadata.extend(unit.map(|unit| (UNIT.to_owned(), unit.to_owned())));
    Field::new(key.name, data_type(shape, numbers), true).with_metadata(metadata)
}

fn list(of: DataType) -> DataType {
    DataType::List(Arc::new(Field::new_list_field(of, true)))
}

fn data_type(shape: Shape, numbers: Numbers) -> DataType {
    match shape {
        Shape::Text | Shape::Word => DataType::Utf8,
        Shape::Flag => DataType::Boolean,
        Shape::Count => DataType::Int64,
        Shape::Number | Shape::Percent | Shape::Quantity(_) => DataType::Float64,
        Shape::Names | Shape::Words => list(DataType::Utf8),
        Shape::Uncertain | Shape::UncertainQuantity(_) | Shape::Sourced(_) => match numbers {
            Numbers::Plain => DataType::Float64,
            Numbers::Ranges => DataType::Struct(fields(shape, numbers)),
        },
        Shape::Numbers => list(data_type(Shape::Uncertain, numbers)),
        Shape::UncertainQuantities(dimension) => match numbers {
            Numbers::Plain => list(DataType::Float64),
            Numbers::Ranges => {
                // One range of all, or a range of each.
                let each = list(data_type(Shape::UncertainQuantity(dimension), numbers));
                let of = |key: &'static KeyInfo| match key.name {
                    "values" => Field::new(key.name, each.clone(), true),
                    _ => field(shape.within(key), key, numbers),
                };
                DataType::Struct(shape.keys().map(of).collect())
            }
        },
        Shape::Table(_) => DataType::Struct(fields(shape, numbers)),
        Shape::Tables(keys) => list(data_type(Shape::Table(keys), numbers)),
        Shape::Angle
        | Shape::QuantityOrTables(..)
        | Shape::Wheels
        | Shape::Wheel
        | Shape::WordOrTable(_)
        | Shape::NumberOrTable(_) => DataType::Struct(with_others(shape, numbers)),
    }
}

/// The fields of a key that may be a number, a word, a list or a table: one for each.
fn with_others(shape: Shape, numbers: Numbers) -> Fields {
    let is_wanted = |key: &KeyInfo| match (numbers, shape) {
        (Numbers::Ranges, _) | (_, Shape::WordOrTable(_)) => true,
        (Numbers::Plain, Shape::NumberOrTable(_)) => key.name == "value" || is_own(shape, key),
        (Numbers::Plain, _) => key.name == "value",
    };
    let keys = shape.keys().filter(|key| is_wanted(key)).map(|key| field(shape.within(key), key, numbers));
    let aside = shape.aside().into_iter().map(|(name, aside)| {
        let data_type = match aside {
            // The list of four.
            Shape::Wheels => list(data_type(Shape::Wheel, numbers)),
            other => data_type(other, numbers),
        };
        Field::new(name, data_type, true)
    });
    aside.chain(keys).collect()
}
