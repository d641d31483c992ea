//! Walks through a case: visits every value with its path, and can replace each number.

use std::fmt::{self, Display, Write};

use crate::estimate::EstimatedInput;
use crate::quantity::Quantity;
use crate::text::Text;
use crate::units::Unit;
use crate::words::word;

/// One number of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its path, such as `vehicle1.contact.angle`; the first of a list is `vehicle1.crush.depths[1]`, the C_1
    /// of the equations.
    pub path: String,
    /// The number as written.
    pub number: f64,
    /// The unit as written; `None` for a coefficient without a unit.
    pub unit: Option<&'static Unit>,
    /// Its origin.
    pub origin: Origin,
}

/// An [`Input`] whose path is not built yet.
pub struct Variable<'a> {
    pub(crate) path: &'a dyn Display,
    /// The number as written.
    pub number: f64,
    /// The unit as written; `None` for a coefficient without a unit.
    pub unit: Option<&'static Unit>,
    /// Its origin.
    pub origin: Origin,
}

impl Variable<'_> {
    /// Whether this is its path.
    #[must_use]
    pub fn is_at(&self, path: &str) -> bool {
        let mut rest = Rest(path);
        write!(rest, "{}", self.path).is_ok() && rest.0.is_empty()
    }
}

/// The rest of a text after a prefix; writing anything else than its next characters fails.
struct Rest<'a>(&'a str);

impl Write for Rest<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0 = self.0.strip_prefix(text).ok_or(fmt::Error)?;
        Ok(())
    }
}

/// The origin of a number that may vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The case gives it.
    Given,
    /// It is the factor of an estimate, 1 unless it is varied, or the displacement of a placed contact point,
    /// 0 unless it is varied.
    Estimate(EstimatedInput),
    /// It is a shared error, by its index among those of the case: 0 in its unit or, for a percentage, the
    /// factor 1, unless it is varied.
    Shared(usize),
}

impl Input {
    /// The value in SI.
    #[must_use]
    pub fn si(&self) -> f64 {
        self.number * self.factor()
    }

    /// The size of its unit in SI.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.unit.map_or(1.0, Unit::factor)
    }
}

/// A value of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenValue {
    /// A number in its unit, or a coefficient without a unit.
    Number {
        /// The number as given.
        number: f64,
        /// The unit as given.
        unit: Option<&'static Unit>,
    },
    /// A text, or the word for a choice.
    Text(String),
    /// True.
    Flag,
    /// A number from a list, such as a size class.
    Count(u16),
    /// The hour of a clock.
    Hour(u8),
}

/// Receives the path, the number, its unit and its origin; returns the replacement of the number.
pub(crate) type Replace<'a, U> = dyn FnMut(&dyn Display, f64, Option<&'static Unit>, Origin) -> U + 'a;
/// Receives the path and a value that is not a number.
pub(crate) type Others<'a> = dyn FnMut(&dyn Display, GivenValue) + 'a;

/// Visits the values of a case, table by table. Each table implements its part next to its fields.
pub(crate) struct Walk<'a, U> {
    replace: &'a mut Replace<'a, U>,
    /// `None` if only the numbers are of interest.
    others: Option<&'a mut Others<'a>>,
}

/// The path of a key in a table, formatted only on demand.
pub(crate) struct Key<'a>(pub(crate) &'a dyn Display, pub(crate) &'a str);

impl Display for Key<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.0, self.1)
    }
}

/// The path of an element of a list, counted from 1.
pub(crate) struct Element<'a>(pub(crate) &'a dyn Display, pub(crate) usize);

impl Display for Element<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", self.0, self.1 + 1)
    }
}

impl<'a, U> Walk<'a, U> {
    pub(crate) fn new(replace: &'a mut Replace<'a, U>, others: Option<&'a mut Others<'a>>) -> Self {
        Self { replace, others }
    }

    /// The replacement of a number, which need not be given by the case.
    pub(crate) fn replaced(
        &mut self,
        path: &dyn Display,
        number: f64,
        unit: Option<&'static Unit>,
        origin: Origin,
    ) -> U {
        (self.replace)(path, number, unit, origin)
    }

    pub(crate) fn number(&mut self, path: &dyn Display, number: f64) -> U {
        self.replaced(path, number, None, Origin::Given)
    }

    pub(crate) fn quantity(&mut self, path: &dyn Display, quantity: &Quantity) -> Quantity<U> {
        quantity.with(self.replaced(path, quantity.number(), Some(quantity.unit()), Origin::Given))
    }

    pub(crate) fn maybe(&mut self, path: &dyn Display, quantity: Option<&Quantity>) -> Option<Quantity<U>> {
        quantity.map(|quantity| self.quantity(path, quantity))
    }

    pub(crate) fn list(&mut self, path: &dyn Display, quantities: &[Quantity]) -> Vec<Quantity<U>> {
        self.each(path, quantities, Self::quantity)
    }

    /// The elements of a list, each with its path.
    pub(crate) fn each<V, W>(
        &mut self,
        path: &dyn Display,
        elements: &[V],
        mut of: impl FnMut(&mut Self, &dyn Display, &V) -> W,
    ) -> Vec<W> {
        elements.iter().enumerate().map(|(i, element)| of(self, &Element(path, i), element)).collect()
    }

    /// A quantity that does not vary.
    pub(crate) fn exact(&mut self, path: &dyn Display, quantity: &Quantity) {
        self.other(path, || GivenValue::Number { number: quantity.number(), unit: Some(quantity.unit()) });
    }

    pub(crate) fn other(&mut self, path: &dyn Display, value: impl FnOnce() -> GivenValue) {
        if let Some(others) = &mut self.others {
            others(path, value());
        }
    }

    pub(crate) fn text(&mut self, path: &dyn Display, text: Option<&Text>) -> Option<Text> {
        if let Some(text) = text {
            self.other(path, || GivenValue::Text(text.as_given().to_owned()));
        }
        text.cloned()
    }

    pub(crate) fn flag(&mut self, path: &dyn Display, flag: bool) -> bool {
        if flag {
            self.other(path, || GivenValue::Flag);
        }
        flag
    }

    pub(crate) fn count<N: Copy + Into<u16>>(&mut self, path: &dyn Display, count: N) -> N {
        self.other(path, || GivenValue::Count(count.into()));
        count
    }

    pub(crate) fn hour(&mut self, path: &dyn Display, hour: u8) -> u8 {
        self.other(path, || GivenValue::Hour(hour));
        hour
    }

    /// A choice, by its word in a table.
    pub(crate) fn choice<T: PartialEq + Copy>(
        &mut self,
        path: &dyn Display,
        table: &[(&'static str, T)],
        choice: T,
    ) -> T {
        self.other(path, || GivenValue::Text(word(table, &choice).to_owned()));
        choice
    }

    /// A choice whose default may be left out.
    pub(crate) fn default<T: PartialEq + Copy + Default>(
        &mut self,
        path: &dyn Display,
        table: &[(&'static str, T)],
        choice: T,
        is_left_out: bool,
    ) -> T {
        if is_left_out && choice == T::default() { choice } else { self.choice(path, table, choice) }
    }
}
