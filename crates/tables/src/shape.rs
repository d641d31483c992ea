//! The form of a key's value in a column.

use case::{Dimension, Form, KeyInfo, key_tree, list_range_keys, range_keys, sourced_range_keys};

use crate::name::Step;

/// The form of a key's value. A number with a unit is a number; the column's name or metadata has the unit.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    Text,
    /// One of several words.
    Word,
    /// One of several words, or a list of all.
    Words,
    Flag,
    /// A count, a probability or a number of a range.
    Number,
    Count,
    Percent,
    /// A list of texts.
    Names,
    /// A number, or a range.
    Uncertain,
    /// A list of these.
    Numbers,
    Quantity(Dimension),
    UncertainQuantity(Dimension),
    /// The same, which may have a source.
    Sourced(Dimension),
    Angle,
    /// A list of quantities or ranges, or one range for all.
    UncertainQuantities(Dimension),
    QuantityOrTables(Dimension, &'static [KeyInfo]),
    Wheels,
    /// A number, a range or a word: the drag of one wheel.
    Wheel,
    Table(&'static [KeyInfo]),
    Tables(&'static [KeyInfo]),
    WordOrTable(&'static [KeyInfo]),
    NumberOrTable(&'static [KeyInfo]),
}

/// The word of a key that may also have a table or a number, in a struct.
pub(crate) const WORD: &str = "word";
/// The drag of the four wheels, in a struct.
pub(crate) const WHEELS: &str = "wheels";
/// The steer angles against time, in a struct.
pub(crate) const OVER_TIME: &str = "over_time";

impl Shape {
    /// The case itself.
    pub(crate) fn case() -> Self {
        Self::Table(key_tree().keys)
    }

    /// The form of a key's value within this one.
    pub(crate) fn within(self, key: &'static KeyInfo) -> Self {
        let keys = key.form.keys();
        match key.form {
            Form::Text => Self::Text,
            Form::Flag => Self::Flag,
            Form::Words(_) | Form::Law(_) => Self::Word,
            Form::WordOrAll(_) => Self::Words,
            Form::Count(..) => Self::Count,
            Form::Probability => Self::Number,
            Form::Keys(_) => Self::Names,
            Form::Number(_) => Self::Uncertain,
            Form::Numbers(_) => Self::Numbers,
            Form::Quantity(dimension, _) => Self::UncertainQuantity(dimension),
            Form::Sourced(dimension, _) => Self::Sourced(dimension),
            Form::Exact(dimension, _) => Self::Quantity(dimension),
            Form::Quantities(dimension, ..) => Self::UncertainQuantities(dimension),
            Form::QuantityOrTables(dimension, ..) => Self::QuantityOrTables(dimension, keys),
            Form::Wheels(..) => Self::Wheels,
            Form::AngleOrHour => Self::Angle,
            Form::Vehicle | Form::Table(_) => Self::Table(keys),
            Form::Tables(..) => Self::Tables(keys),
            Form::WordsOrTable(..) => Self::WordOrTable(keys),
            Form::NumberOrTable(..) => Self::NumberOrTable(keys),
            Form::Percent(_) => Self::Percent,
            Form::Value => self.dimension().map_or(Self::Number, Self::Quantity),
            Form::Values => self.dimension().map_or(Self::Numbers, Self::UncertainQuantities),
            Form::Deviation => match self {
                // A shared error is in the unit of its numbers, which the column cannot know.
                Self::Table(_) | Self::Tables(_) => Self::Text,
                number => number.dimension().map_or(Self::Number, Self::Quantity),
            },
        }
    }

    /// The form at the end of a path in this one.
    pub(crate) fn at(self, steps: &[Step]) -> Option<Self> {
        steps.iter().try_fold(self, |shape, step| match step {
            Step::Key(name) => Some(shape.within(shape.keys().find(|key| key.name == name)?)),
            Step::Element(_) => shape.listed(),
        })
    }

    /// The dimension of a number with a unit, or of each of several.
    pub(crate) fn dimension(self) -> Option<Dimension> {
        match self {
            Self::Quantity(dimension)
            | Self::UncertainQuantity(dimension)
            | Self::Sourced(dimension)
            | Self::UncertainQuantities(dimension)
            | Self::QuantityOrTables(dimension, _) => Some(dimension),
            Self::Angle => Some(Dimension::Angle),
            _ => None,
        }
    }

    /// The keys of its table, and those of a range.
    pub(crate) fn keys(self) -> impl Iterator<Item = &'static KeyInfo> {
        let (own, of_range): (&[KeyInfo], &[KeyInfo]) = match self {
            Self::Table(keys) | Self::WordOrTable(keys) => (keys, &[]),
            Self::NumberOrTable(keys) => (keys, range_keys()),
            Self::Uncertain
            | Self::UncertainQuantity(_)
            | Self::Angle
            | Self::QuantityOrTables(..)
            | Self::Wheels
            | Self::Wheel => (&[], range_keys()),
            Self::Sourced(_) => (&[], sourced_range_keys()),
            Self::UncertainQuantities(_) => (&[], list_range_keys()),
            _ => (&[], &[]),
        };
        own.iter().chain(of_range)
    }

    /// The name, in a struct, of a form that is neither a number nor a table, and its shape.
    pub(crate) fn aside(self) -> Vec<(&'static str, Self)> {
        match self {
            Self::WordOrTable(_) | Self::Wheel => vec![(WORD, Self::Word)],
            Self::Wheels => vec![(WORD, Self::Word), (WHEELS, self)],
            Self::Angle => vec![(WORD, Self::Text)],
            Self::QuantityOrTables(_, keys) => vec![(OVER_TIME, Self::Tables(keys))],
            _ => Vec::new(),
        }
    }

    /// The form of each element, if it can be a list.
    pub(crate) fn listed(self) -> Option<Self> {
        Some(match self {
            Self::Names => Self::Text,
            Self::Words => Self::Word,
            Self::Numbers => Self::Uncertain,
            Self::UncertainQuantities(dimension) => Self::UncertainQuantity(dimension),
            Self::QuantityOrTables(_, keys) | Self::Tables(keys) => Self::Table(keys),
            Self::Wheels => Self::Wheel,
            _ => return None,
        })
    }

    /// The key of the central value, if a value without a range can be next to the keys of its range.
    pub(crate) fn central(self) -> Option<&'static str> {
        match self {
            Self::Uncertain
            | Self::UncertainQuantity(_)
            | Self::Sourced(_)
            | Self::Angle
            | Self::QuantityOrTables(..)
            | Self::Wheels
            | Self::Wheel
            | Self::NumberOrTable(_) => Some("value"),
            Self::UncertainQuantities(_) => Some("values"),
            _ => None,
        }
    }

    /// The required form of its column, in words.
    pub(crate) fn wanted(self) -> &'static str {
        match self {
            Self::Text => "a text is needed",
            Self::Word | Self::Words => "a word is needed, as text",
            Self::Flag => "true or false is needed",
            Self::Number | Self::Count | Self::Percent => "a number is needed",
            Self::Names => "a list of texts is needed",
            Self::Uncertain
            | Self::UncertainQuantity(_)
            | Self::Sourced(_)
            | Self::Quantity(_)
            | Self::Angle => "a number is needed, or a struct such as {value, sd} or {low, high}",
            Self::Numbers | Self::UncertainQuantities(_) => {
                "a list of numbers is needed, or a text such as \"0.54 0.52 0.35\""
            }
            Self::QuantityOrTables(..) => "a number is needed, or a list of structs {time, angle}",
            Self::Wheels | Self::Wheel => "a number, a word or a list of four is needed",
            Self::Table(_) => "a struct of its keys is needed",
            Self::Tables(_) => "a list of structs is needed",
            Self::WordOrTable(_) => "a word is needed, as text, or a struct of its keys",
            Self::NumberOrTable(_) => "a number is needed, or a struct of its keys",
        }
    }
}
