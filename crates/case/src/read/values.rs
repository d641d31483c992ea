//! The values of keys: quantities, lists of them, plain numbers, texts and choices.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use toml::Spanned;

use super::tree::{Reader, Table, kind};
use crate::case_problem::CaseProblem;
use crate::nearest::{join, nearest};
use crate::node::Node;
use crate::number::{leading_numbers, split_number};
use crate::number_slips;
use crate::quantity::{QuantityError, find_unit, not_a_number, read_quantity, shorten};
use crate::schema::{Form, MOST_STATIONS, Measure};
use crate::units_in_use::usual_units;
use inputs::{Bounds, Dimension, Quantity, Text, Unit, format_number};

/// A key that is given, or an element of its list.
pub(super) struct Place<'t> {
    /// Its path.
    pub(super) path: String,
    /// Its name in error texts.
    pub(super) name: String,
    /// The line that sets the key.
    pub(super) example: &'static str,
    /// Its value.
    pub(super) value: &'t Spanned<Node<'t>>,
}

impl<'t> Place<'t> {
    /// A key of a table; `None` if it is absent.
    pub(super) fn of_key(table: &Table<'t>, key: &str) -> Option<Self> {
        let (value, path) = (table.get(key)?, table.path_of(key));
        Some(Self { name: named(&path), path, example: table.schema.example(key), value })
    }

    pub(super) fn element(&self, index: usize, value: &'t Spanned<Node<'t>>) -> Self {
        Self {
            path: format!("{}[{}]", self.path, index + 1),
            name: format!("value {} of {}", index + 1, self.name),
            example: self.example,
            value,
        }
    }

    /// The value without its place.
    pub(super) fn node(&self) -> &'t Node<'t> {
        self.value.get_ref()
    }
}

impl<'t> Reader<'t> {
    /// A string with its unit, or a range, as required by the row of its key; `None` if it is absent, and
    /// also if it is wrong, which is reported.
    pub(super) fn quantity(&mut self, table: &Table<'t>, key: &'static str) -> Option<Quantity> {
        self.quantity_as(table, key, table.measure(key)?)
    }

    /// Like [`quantity`](Self::quantity), with a measure that differs from the row.
    pub(super) fn quantity_as(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        measure: Measure,
    ) -> Option<Quantity> {
        self.quantity_or_range(&Place::of_key(table, key)?, measure, "a string with a number and a unit")
    }

    fn quantity_or_range(
        &mut self,
        place: &Place<'t>,
        measure: Measure,
        wanted: &'static str,
    ) -> Option<Quantity> {
        if place.node().is_table() {
            return self.range_of_quantity(place, measure);
        }
        self.certain_quantity(place, measure, wanted)
    }

    /// A string with its unit.
    pub(super) fn certain_quantity(
        &mut self,
        place: &Place<'t>,
        measure: Measure,
        wanted: &'static str,
    ) -> Option<Quantity> {
        let read = match place.node() {
            Node::Quantity(number, unit) => in_dimension(*number, unit, measure.dimension),
            _ => read_quantity(self.quantity_text(place, measure.dimension, wanted)?, measure.dimension),
        };
        match read {
            Ok(quantity) => self.signed(&place.name, place.value.span(), quantity, measure),
            Err(error) => self.unreadable(place, error, measure.dimension),
        }
    }

    fn unreadable<T>(&mut self, place: &Place<'t>, error: QuantityError, dimension: Dimension) -> Option<T> {
        let unit = self.units_in_use().example(&place.path, dimension);
        self.unread(place.value, CaseProblem::Quantity { error, unit })
    }

    /// Several quantities: one string with the unit at its end, a list of strings and ranges, or a table with
    /// either of them and a spread for all.
    pub(super) fn quantities(&mut self, table: &Table<'t>, key: &'static str) -> Option<Vec<Quantity>> {
        let (measure, place) = (table.measure(key)?, Place::of_key(table, key)?);
        if place.node().is_table() {
            return self.range_of_quantities(&place, measure);
        }
        self.listed_quantities(&place, measure)
    }

    /// One string with the unit at its end, or a list.
    pub(super) fn listed_quantities(&mut self, place: &Place<'t>, measure: Measure) -> Option<Vec<Quantity>> {
        let read = match place.node() {
            Node::Array(array) => {
                self.not_too_many(&place.path, place.value, array.len(), MOST_STATIONS)?;
                let is_bare = |one: &Spanned<Node<'_>>| plain_number(one.get_ref()).is_some();
                if !array.is_empty() && array.iter().all(is_bare) {
                    return self.bare_numbers(place, measure.dimension);
                }
                let element = |(index, element): (usize, &'t Spanned<Node<'t>>)| {
                    // Anything that is not a quantity makes the whole key wrong, not one element.
                    let of_element = place.element(index, element);
                    let path = if element.get_ref().is_table() { &of_element.path } else { &place.path };
                    let at = Place { path: path.clone(), ..of_element };
                    self.quantity_or_range(&at, measure, "a list of strings")
                };
                // Every element is read before the first fault ends it.
                array.iter().enumerate().map(element).collect::<Vec<Option<Quantity>>>()
            }
            _ => {
                let wanted = "a string with numbers and a unit, or a list of strings";
                let text = self.quantity_text(place, measure.dimension, wanted)?;
                self.split_quantities(place, text, measure)?
            }
        };
        read.into_iter().collect()
    }

    /// A list of only numbers is one fault, not one for each number.
    fn bare_numbers<T>(&mut self, place: &Place<'t>, dimension: Dimension) -> Option<T> {
        const SHOWN: usize = 12;
        let array = place.node().as_array().into_iter().flatten();
        let numbers: Vec<String> = array.take(SHOWN + 1).map(|one| self.written(one)).collect();
        let key = place.path.rsplit('.').next().unwrap_or_default();
        let example = match self.units_in_use().example(&place.path, dimension) {
            Some(unit) if numbers.len() <= SHOWN => format!("{key} = \"{} {unit}\"", numbers.join(" ")),
            None if numbers.len() <= SHOWN => {
                let listed = |unit| format!("{key} = \"{} {unit}\"", numbers.join(" "));
                usual_units(dimension).into_iter().map(listed).collect::<Vec<_>>().join(" or ")
            }
            _ => place.example.to_owned(),
        };
        self.unread(place.value, CaseProblem::BareNumbers { path: place.path.clone(), dimension, example })
    }

    pub(super) fn not_too_many(
        &mut self,
        path: &str,
        value: &'t Spanned<Node<'t>>,
        count: usize,
        limit: usize,
    ) -> Option<()> {
        if count <= limit {
            return Some(());
        }
        self.unread(value, CaseProblem::TooMany { path: path.to_owned(), count, limit })
    }

    fn split_quantities(
        &mut self,
        place: &Place<'t>,
        text: &'t str,
        measure: Measure,
    ) -> Option<Vec<Option<Quantity>>> {
        let (numbers, unit) = leading_numbers(text);
        let (value, dimension, example) = (place.value, measure.dimension, place.example);
        if text.trim().is_empty() {
            return self.unreadable(place, QuantityError::Empty { dimension }, dimension);
        }
        if numbers.is_empty() {
            return self.unreadable(place, not_a_number(text.trim(), dimension), dimension);
        }
        if unit.contains(',') || unit.split_whitespace().any(|word| split_number(word).0.is_some()) {
            return self.unread(value, CaseProblem::BadList { text: shorten(text), dimension, example });
        }
        let unit = match find_unit(text.trim(), unit, dimension) {
            Ok(unit) => unit,
            Err(error) => return self.unreadable(place, error, dimension),
        };
        self.not_too_many(&place.path, value, numbers.len(), MOST_STATIONS)?;
        let start = self.start_of_text(value, text);
        let one = |(index, (number, at)): (usize, (f64, Range<usize>))| {
            let span = start.map_or(value.span(), |start| start + at.start..start + at.end);
            match Quantity::new(number, unit) {
                Ok(quantity) => self.signed(&place.element(index, value).name, span, quantity, measure),
                Err(error) => {
                    self.report(span, CaseProblem::Quantity { error: error.into(), unit: None });
                    None
                }
            }
        };
        Some(numbers.into_iter().enumerate().map(one).collect())
    }

    /// The place of one of several quantities, in either form that [`quantities`](Self::quantities) reads.
    pub(super) fn span_of_element(&self, table: &Table<'t>, key: &str, index: usize) -> Range<usize> {
        let Some(value) = table.get(key) else { return Range::default() };
        let values = values_of(value);
        self.spans_in(values).get(index).cloned().unwrap_or(values.span())
    }

    /// The place of each quantity of a list, as far as it can be found.
    pub(super) fn spans_in(&self, value: &Spanned<Node<'t>>) -> Vec<Range<usize>> {
        match value.get_ref() {
            Node::Array(array) => array.iter().map(Spanned::span).collect(),
            Node::String(text) => self.start_of_text(value, text).map_or_else(Vec::new, |start| {
                let (numbers, _) = leading_numbers(text);
                numbers.into_iter().map(|(_, at)| start + at.start..start + at.end).collect()
            }),
            _ => Vec::new(),
        }
    }

    /// The start of a string, if it is written in the file without escapes.
    fn start_of_text(&self, value: &Spanned<Node<'_>>, text: &str) -> Option<usize> {
        let start = value.span().start + 1;
        (self.text.get(start..start + text.len()) == Some(text)).then_some(start)
    }

    fn quantity_text(
        &mut self,
        place: &Place<'t>,
        dimension: Dimension,
        wanted: &'static str,
    ) -> Option<&'t str> {
        let (path, example) = (place.path.clone(), place.example);
        match place.node() {
            Node::String(text) => Some(text),
            Node::Number(_) | Node::NotDecimal => {
                let number = self.written(place.value);
                let example = match hour_of(&number).filter(|_| place.path.ends_with(".pdof")) {
                    Some(hour) => {
                        format!("pdof = \"{hour} deg\" or, as a clock hour, pdof = \"{hour} o'clock\"")
                    }
                    // The file does not show its units: the example of the schema would choose a system for
                    // it.
                    None if !wanted.contains("list")
                        && self.units_in_use().example(&place.path, dimension).is_none() =>
                    {
                        let key = place.path.rsplit('.').next().unwrap_or_default();
                        let line = |unit| format!("{key} = \"{number} {unit}\"");
                        usual_units(dimension).into_iter().map(line).collect::<Vec<_>>().join(" or ")
                    }
                    None => example.to_owned(),
                };
                self.unread(place.value, CaseProblem::BareNumber { path, number, dimension, example })
            }
            _ => self.wrong_type(place.value, path, wanted, example),
        }
    }

    pub(super) fn signed(
        &mut self,
        path: &str,
        span: Range<usize>,
        value: Quantity,
        measure: Measure,
    ) -> Option<Quantity> {
        let path = path.to_owned();
        let least = value.dimension().least_positive();
        let Measure { bounds, why, example, .. } = measure;
        let problem = match bounds {
            Bounds::Acute if value.si().abs() < FRAC_PI_2 => return Some(value),
            Bounds::Acute => {
                let limit = if value.unit().spelling() == "rad" { "1.5708 rad" } else { "90 deg" };
                CaseProblem::NotAcute { path, value, limit }
            }
            Bounds::NotNegative if value.number() < 0.0 => CaseProblem::Negative { path, value },
            Bounds::Positive if value.number() <= 0.0 => {
                CaseProblem::NotPositive { path, value, why, example }
            }
            Bounds::Positive if value.si() < least => CaseProblem::TooSmall { path, value },
            Bounds::NotNegative | Bounds::Positive => return Some(value),
            // The last four only apply to plain numbers.
            Bounds::None | Bounds::Share | Bounds::BelowOne | Bounds::Coefficient | Bounds::Friction => {
                return Some(value);
            }
        };
        self.report(span, problem);
        None
    }

    /// A plain number within the bounds, or a range.
    pub(super) fn number(&mut self, table: &Table<'t>, key: &'static str) -> Option<f64> {
        self.number_at(&Place::of_key(table, key)?, key, table.bounds(key)?)
    }

    /// Like [`number`](Self::number), for a value that need not belong to a key.
    pub(super) fn number_at(&mut self, place: &Place<'t>, key: &str, bounds: Bounds) -> Option<f64> {
        if place.node().is_table() {
            return self.range_of_number(place, bounds);
        }
        self.certain_number(place, key, words(bounds), |number| accepts(bounds, number))
    }

    /// A plain number for which `accepts` holds; `range` describes the condition in words.
    pub(super) fn certain_number(
        &mut self,
        place: &Place<'t>,
        key: &str,
        range: impl Into<Cow<'static, str>>,
        accepts: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let (path, name, example) = (place.path.clone(), place.name.clone(), place.example);
        let problem = match (plain_number(place.node()), place.node()) {
            (Some(number), _) if accepts(number) => return Some(number),
            (Some(value), _) => CaseProblem::OutOfRange { path: name, value, range: range.into(), example },
            (None, Node::String(text)) => {
                let number =
                    number_slips::plain(text).map(|number| format!("{key} = {}", format_number(number)));
                CaseProblem::QuotedNumber { path: name, text: shorten(text), number, example }
            }
            (None, Node::NotDecimal) => {
                CaseProblem::WrongType { path, found: NOT_DECIMAL, wanted: "a decimal number", example }
            }
            (None, other) => {
                CaseProblem::WrongType { path, found: kind(other), wanted: "a plain number", example }
            }
        };
        self.unread(place.value, problem)
    }

    /// A list of plain numbers within the bounds, and of ranges.
    pub(super) fn numbers(&mut self, table: &Table<'t>, key: &'static str) -> Option<Vec<f64>> {
        const WANTED: &str = "a list of plain numbers";
        let (bounds, whole) = (table.bounds(key)?, Place::of_key(table, key)?);
        let (path, example, range) = (whole.path.clone(), whole.example, words(bounds));
        let Some(array) = whole.node().as_array() else {
            return self.wrong_type(whole.value, path, WANTED, example);
        };
        self.not_too_many(&path, whole.value, array.len(), MOST_STATIONS)?;
        let element = |(index, element): (usize, &'t Spanned<Node<'t>>)| {
            if element.get_ref().is_table() {
                return self.range_of_number(&whole.element(index, element), bounds);
            }
            let place = || whole.element(index, element).name;
            let problem = match (plain_number(element.get_ref()), element.get_ref()) {
                (Some(number), _) if accepts(bounds, number) => return Some(number),
                (Some(value), _) => {
                    CaseProblem::OutOfRange { path: place(), value, range: range.into(), example }
                }
                (None, Node::String(text)) => {
                    let number = number_slips::plain(text).map(format_number);
                    CaseProblem::QuotedNumber { path: place(), text: shorten(text), number, example }
                }
                (None, other) => {
                    let found = if matches!(other, Node::NotDecimal) { NOT_DECIMAL } else { kind(other) };
                    CaseProblem::WrongType { path: path.clone(), found, wanted: WANTED, example }
                }
            };
            self.unread(element, problem)
        };
        // Every element is read before the first fault ends it.
        let read: Vec<Option<f64>> = array.iter().enumerate().map(element).collect();
        read.into_iter().collect()
    }

    /// A whole number in the range that the row of its key allows.
    pub(super) fn counted<N: TryFrom<u16>>(
        &mut self,
        place: &Place<'t>,
        table: &Table<'t>,
        key: &'static str,
    ) -> Option<N> {
        let Form::Count(first, last) = table.schema.key(key)?.form else { return None };
        self.not_a_range(table, key, place.value)?;
        let of = |number: f64| (first..=last).find(|&whole| f64::from(whole) == number);
        let range = format!("a whole number from {first} to {last}");
        let number = self.certain_number(place, key, range, |number| of(number).is_some())?;
        N::try_from(of(number)?).ok()
    }

    /// A text that is not empty.
    pub(super) fn text(&mut self, table: &Table<'t>, key: &'static str) -> Option<Text> {
        let value = table.get(key)?;
        self.not_a_range(table, key, value)?;
        let (path, example) = (table.path_of(key), table.schema.example(key));
        match value.get_ref() {
            Node::String(text) if !text.trim().is_empty() => Some(Text::from(&**text)),
            Node::String(_) => self.unread(value, CaseProblem::EmptyText { path, example }),
            _ => self.wrong_type(value, path, "a text in quotes", example),
        }
    }

    /// True or false; absent is false.
    pub(super) fn flag(&mut self, table: &Table<'t>, key: &'static str) -> bool {
        let Some(value) = table.get(key) else { return false };
        if let Some(flag) = value.get_ref().as_bool() {
            return flag;
        }
        if self.not_a_range(table, key, value).is_some() {
            let (path, example) = (table.path_of(key), table.schema.example(key));
            self.wrong_type::<()>(value, path, "true or false", example);
        }
        false
    }

    /// Refuses a flag that may be left out, but not be false.
    pub(super) fn not_false<U>(&mut self, table: &Table<'t>, key: &str, help: &str) -> Option<U> {
        if table.get(key).and_then(|value| value.get_ref().as_bool()) == Some(false) {
            let path = table.path_of(key);
            self.refuse::<()>(&path, format!("\"{path}\" is false, which has no meaning here"), help);
        }
        None
    }

    /// One of a few words.
    pub(super) fn choice<T: Copy>(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        choices: &[(&'static str, T)],
    ) -> Option<T> {
        let quoted: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        self.choice_among(table, key, choices, &join(&quoted, "or"))
    }

    /// Like [`choice`](Self::choice), for a value that may also have other forms, which `forms` lists.
    pub(super) fn choice_among<T: Copy>(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        choices: &[(&'static str, T)],
        forms: &str,
    ) -> Option<T> {
        let value = table.get(key)?;
        self.not_a_range(table, key, value)?;
        let path = table.path_of(key);
        match value.get_ref() {
            Node::String(word) => self.word(value, path, word, choices, forms),
            _ => self.wrong_type(value, path, "a word in quotes", table.schema.example(key)),
        }
    }

    /// The choice of a word.
    pub(super) fn word<T: Copy>(
        &mut self,
        value: &Spanned<Node<'_>>,
        path: String,
        word: &str,
        choices: &[(&'static str, T)],
        forms: &str,
    ) -> Option<T> {
        if let Some((_, choice)) = choices.iter().find(|(name, _)| *name == word) {
            return Some(*choice);
        }
        let nearest = nearest(word, choices.iter().map(|(name, _)| *name));
        let (word, choices) = (shorten(word), forms.to_owned());
        self.unread(value, CaseProblem::UnknownChoice { path, word, nearest, choices })
    }
}

/// A number in a unit, which has to be one of the dimension.
fn in_dimension(number: f64, unit: &'static Unit, dimension: Dimension) -> Result<Quantity, QuantityError> {
    if unit.dimension() == dimension {
        return Ok(Quantity::new(number, unit)?);
    }
    // Its spelling may be that of another unit: "lb" is a mass, a weight and a stiffness.
    read_quantity(&format!("{} {unit}", format_number(number)), dimension)
}

/// The hour of a clock.
pub(super) fn hour_of(number: &str) -> Option<u8> {
    number.parse().ok().filter(|hour| (1..=12).contains(hour))
}

/// The bounds of a plain number, in words.
pub(super) fn words(bounds: Bounds) -> &'static str {
    match bounds {
        Bounds::None | Bounds::Acute => "a finite number",
        Bounds::NotNegative => "a finite number, zero or more",
        Bounds::Positive => "a finite number, greater than zero",
        Bounds::Share | Bounds::BelowOne => "between 0 and 1",
        Bounds::Coefficient => "between -1 and 1",
        Bounds::Friction => "greater than zero, and at most 2",
    }
}

/// A case may give e = 1; the mechanics then explain that no speed follows from it.
pub(super) fn accepts(bounds: Bounds, number: f64) -> bool {
    let [low, high] = if bounds == Bounds::BelowOne { [0.0, 1.0] } else { bounds.interval(None) };
    number.is_finite() && (low..=high).contains(&number)
}

/// The list itself, also if a table gives it with a spread.
pub(super) fn values_of<'t>(value: &'t Spanned<Node<'t>>) -> &'t Spanned<Node<'t>> {
    value.get_ref().as_table().and_then(|table| table.get("values")).unwrap_or(value)
}

/// The kind of a number written with 0x, 0o or 0b.
const NOT_DECIMAL: &str = "not written in decimal digits";

/// A number in decimal digits without a unit.
fn plain_number(value: &Node<'_>) -> Option<f64> {
    match value {
        Node::Number(number) => Some(*number),
        _ => None,
    }
}

/// A key as named in error texts.
pub(super) fn named(path: &str) -> String {
    format!("\"{path}\"")
}
