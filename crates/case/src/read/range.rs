//! Numbers that are not known exactly: `{ value, sd }`, `{ low, high }`, `{ low, mode, high }`, `{ value,
//! within, confidence }`.

use std::borrow::Cow;

use toml::Spanned;

use super::tree::{Reader, Table};
use super::values::{Place, accepts, named, words};
use crate::case_problem::CaseProblem;
use crate::node::Node;
use crate::number::split_number;
use crate::quantity::shorten;
use crate::schema::{Measure, RANGE, RANGE_OF_LIST, RESTITUTION, SOURCED_RANGE, Schema};
use crate::units_in_use::usual_units;
use inputs::{Amount, Bounds, Dimension, Quantity, Range, Sourced, Spread};

const FORMS: &str = "{ value = …, sd = … }, { low = …, high = … }, { low = …, mode = …, high = … } or \
                     { value = …, within = \"10 %\", confidence = 0.95 }";
const SOURCED_FORMS: &str = "{ value = …, source = … }, { value = …, sd = … }, { low = …, high = … }, { low = …, mode = …, high = … } \
                             or { value = …, within = \"10 %\", confidence = 0.95 }, each with or without a `source`";
const LIST_FORMS: &str = "{ values = …, sd = … } or { values = …, within = \"10 %\", confidence = 0.95 }; if the \
                          uncertainties differ, write a list: [{ value = …, sd = … }, …]";

/// The kind of number in a range.
#[derive(Clone, Copy)]
enum Kind {
    Quantity(Measure),
    Number(Bounds),
}

/// Whether a value is a table with a key of a range, and with none of a curve of restitution.
pub(super) fn is_range(table: &Table<'_>, key: &str) -> bool {
    let entries = table.get(key).and_then(|value| value.get_ref().as_table());
    let has =
        |schema: &Schema| entries.is_some_and(|entries| entries.keys().any(|key| schema.has(key.get_ref())));
    has(&RANGE) && !has(&RESTITUTION)
}

impl<'t> Reader<'t> {
    /// Reports a range where none is allowed.
    pub(super) fn not_a_range(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        value: &'t Spanned<Node<'t>>,
    ) -> Option<()> {
        if !is_range(table, key) {
            return Some(());
        }
        let (path, example) = (table.path_of(key), table.schema.example(key));
        self.unread(value, CaseProblem::NoRange { path, example })
    }

    /// Reads a range, and returns its central value.
    pub(super) fn range_of_quantity(&mut self, place: &Place<'t>, measure: Measure) -> Option<Quantity> {
        let table = self.range_table(place, &RANGE)?;
        let central = self.range(&table, place, Kind::Quantity(measure))?;
        Quantity::new(central.number, central.unit?).ok()
    }

    /// Reads a range, and returns its central value.
    pub(super) fn range_of_number(&mut self, place: &Place<'t>, bounds: Bounds) -> Option<f64> {
        let table = self.range_table(place, &RANGE)?;
        Some(self.range(&table, place, Kind::Number(bounds))?.number)
    }

    /// Reads a quantity with its source, whether it is a range or not.
    pub(super) fn sourced(&mut self, table: &Table<'t>, key: &'static str) -> Option<Sourced> {
        let (measure, place) = (table.measure(key)?, Place::of_key(table, key)?);
        if !place.node().is_table() {
            let quantity = self.certain_quantity(&place, measure, "a string with a number and a unit")?;
            return Some(Sourced { quantity, source: None });
        }
        let range = self.range_table(&place, &SOURCED_RANGE)?;
        let source = self.text(&range, "source");
        let kind = Kind::Quantity(measure);
        let central = if let ["value", "source"] =
            range.given(&["value", "source", "sd", "low", "mode", "high", "within", "confidence"])[..]
        {
            self.amount(&range, "value", kind)?
        } else {
            self.range(&range, &place, kind)?
        };
        let quantity = Quantity::new(central.number, central.unit?).ok()?;
        Some(Sourced { quantity, source })
    }

    /// Reads several numbers with one spread, and returns their central values.
    pub(super) fn range_of_quantities(
        &mut self,
        place: &Place<'t>,
        measure: Measure,
    ) -> Option<Vec<Quantity>> {
        let table = self.range_table(place, &RANGE_OF_LIST)?;
        let kind = Kind::Quantity(measure);
        let values = Place::of_key(&table, "values").and_then(|list| {
            let list = Place { example: place.example, ..list };
            self.certain_quantities(&list, measure).map(|values| (list.value, values))
        });
        let spread = self.spread_about(&table, kind);
        let is_complete = matches!(
            table.given(&["values", "sd", "within", "confidence"])[..],
            ["values", "sd"] | ["values", "within", "confidence"]
        );
        if !is_complete {
            return self.no_range(&table, place.value, LIST_FORMS);
        }
        let ((list, values), spread) = (values?, spread?);
        // Found once for all values, because a text has to be read from its beginning.
        let spans = self.spans_in(list);
        for (index, value) in values.iter().enumerate() {
            let amount = Amount { number: value.number(), unit: Some(value.unit()) };
            let span = spans.get(index).cloned().unwrap_or(list.span());
            let name = format!("value {} of {}", index + 1, named(&table.path_of("values")));
            self.not_within_zero(&name, span.clone(), amount, spread)?;
            let path = format!("{}[{}]", place.path, index + 1);
            self.add_range(span, Range { path, spread, bounds: measure.bounds });
        }
        Some(values)
    }

    /// A list without ranges in it.
    fn certain_quantities(&mut self, place: &Place<'t>, measure: Measure) -> Option<Vec<Quantity>> {
        let list = place.node().as_array();
        if let Some(nested) = list.and_then(|list| list.iter().find(|one| one.get_ref().is_table())) {
            let wanted = "a list of strings, because the spread next to it applies to all";
            let example = RANGE_OF_LIST.example("values");
            return self.wrong_type(nested, place.path.clone(), wanted, example);
        }
        self.listed_quantities(place, measure)
    }

    fn range_table(&mut self, place: &Place<'t>, schema: &'static Schema) -> Option<Table<'t>> {
        let entries = place.node().as_table()?;
        Some(self.open(place.path.clone(), entries, schema))
    }

    /// Records a range, and returns its central value.
    fn range(&mut self, table: &Table<'t>, place: &Place<'t>, kind: Kind) -> Option<Amount> {
        let (central, spread) = self.central_and_spread(table, place, kind)?;
        let (Kind::Quantity(Measure { bounds, .. }) | Kind::Number(bounds)) = kind;
        self.add_range(place.value.span(), Range { path: place.path.clone(), spread, bounds });
        Some(central)
    }

    fn central_and_spread(
        &mut self,
        table: &Table<'t>,
        place: &Place<'t>,
        kind: Kind,
    ) -> Option<(Amount, Spread)> {
        let value = place.value;
        let central = self.amount(table, "value", kind);
        let spread = self.spread_about(table, kind);
        let [low, mode, high] = ["low", "mode", "high"].map(|key| self.amount(table, key, kind));
        match table.given(&["value", "sd", "low", "mode", "high", "within", "confidence"])[..] {
            ["value", "sd"] | ["value", "within", "confidence"] => {
                let (central, spread) = (central?, spread?);
                self.not_within_zero(&named(&table.path_of("value")), value.span(), central, spread)?;
                Some((central, spread))
            }
            ["low", "high"] => {
                let (low, high) = (low?, high?);
                self.rising(place, low, high)?;
                // The middle, in the unit of the low end: (a + b)/2
                let number = decimal(0.5 * low.number + 0.5 * high.in_unit(low.unit));
                Some((Amount { number, ..low }, Spread::Uniform { low, high }))
            }
            ["low", "mode", "high"] => {
                let (low, mode, high) = (low?, mode?, high?);
                self.rising(place, low, high)?;
                if !(low.in_unit(mode.unit)..=high.in_unit(mode.unit)).contains(&mode.number) {
                    let path = place.name.clone();
                    self.report_path(
                        &table.path_of("mode"),
                        CaseProblem::ModeOutside { path, low, mode, high },
                    );
                    return None;
                }
                Some((mode, Spread::Triangular { low, high }))
            }
            _ if table.schema.has("source") => self.no_range(table, value, SOURCED_FORMS),
            _ => self.no_range(table, value, FORMS),
        }
    }

    fn rising(&mut self, place: &Place<'t>, low: Amount, high: Amount) -> Option<()> {
        if low.in_unit(high.unit) < high.number && low.number < high.in_unit(low.unit) {
            return Some(());
        }
        self.unread(place.value, CaseProblem::NotRising { path: place.name.clone(), low, high })
    }

    fn not_within_zero(
        &mut self,
        name: &str,
        span: std::ops::Range<usize>,
        value: Amount,
        spread: Spread,
    ) -> Option<()> {
        if value.number != 0.0 || !matches!(spread, Spread::Within { .. }) {
            return Some(());
        }
        self.report(span, CaseProblem::WithinOfZero { path: name.to_owned(), value });
        None
    }

    fn no_range<T>(
        &mut self,
        table: &Table<'t>,
        value: &'t Spanned<Node<'t>>,
        forms: &'static str,
    ) -> Option<T> {
        if !table.has_misspelt() {
            let names: Vec<&'static str> = table.schema.names().collect();
            let (path, given) = (named(&table.path), table.given(&names));
            self.report(value.span(), CaseProblem::NoRangeForm { path, given, forms });
        }
        None
    }

    /// One number of a range.
    fn amount(&mut self, table: &Table<'t>, key: &'static str, range: Kind) -> Option<Amount> {
        let place = Place::of_key(table, key)?;
        if place.node().is_table() {
            return self.wrong_type(place.value, place.path, "a single value", FORMS);
        }
        match range {
            Kind::Quantity(Measure { dimension, .. })
                if matches!(place.node(), Node::Number(_) | Node::NotDecimal) =>
            {
                let number = self.written(place.value);
                let unit = self.units_in_use().example(&place.path, dimension);
                let units = unit.map_or_else(|| usual_units(dimension), |unit| vec![unit]);
                let examples: Vec<String> =
                    units.iter().map(|unit| format!("{key} = \"{number} {unit}\"")).collect();
                let example = examples.join(" or ");
                let path = place.path;
                self.unread(place.value, CaseProblem::BareNumber { path, number, dimension, example })
            }
            Kind::Quantity(measure) => {
                let wanted = "a string with a number and a unit";
                let quantity = self.certain_quantity(&place, measure, wanted)?;
                Some(Amount { number: quantity.number(), unit: Some(quantity.unit()) })
            }
            Kind::Number(bounds) => {
                let accepted = |number| accepts(bounds, number);
                let example = match key {
                    "low" | "high" => "{ low = 0.2, high = 0.4 }",
                    "mode" => "{ low = 0.2, mode = 0.3, high = 0.4 }",
                    _ => "{ value = 0.3, sd = 0.05 }",
                };
                let place = Place { example, ..place };
                let number = self.certain_number(&place, key, words(bounds), accepted)?;
                Some(Amount { number, unit: None })
            }
        }
    }

    /// The size of an error of numbers with this dimension: `sd`, or `within` and `confidence`.
    pub(super) fn size_of_error(
        &mut self,
        table: &Table<'t>,
        dimension: Option<Dimension>,
    ) -> Option<Spread> {
        let bounds = Bounds::None;
        self.spread_about(
            table,
            match dimension {
                Some(dimension) => Kind::Quantity(Measure { dimension, bounds, why: "", example: "" }),
                None => Kind::Number(bounds),
            },
        )
    }

    /// `sd`, or `within` and `confidence`.
    fn spread_about(&mut self, table: &Table<'t>, range: Kind) -> Option<Spread> {
        const WHY: &str =
            "a standard deviation must be greater than zero; write the value alone if it is known exactly";
        let deviation = match range {
            Kind::Quantity(measure) => Kind::Quantity(measure.positive(WHY)),
            Kind::Number(_) => Kind::Number(Bounds::Positive),
        };
        let sd = self.standard_deviation(table, deviation).map(|sd| Spread::Normal { sd });
        let percent = self.percent(table, "within");
        let confidence = Place::of_key(table, "confidence").and_then(|place| {
            let inside = |number: f64| 0.0 < number && number < 1.0;
            self.certain_number(&place, "confidence", "greater than 0 and less than 1", inside)
        });
        let within = percent.zip(confidence);
        sd.or(within.map(|(percent, confidence)| Spread::Within { percent, confidence }))
    }

    fn standard_deviation(&mut self, table: &Table<'t>, kind: Kind) -> Option<Amount> {
        let value = table.get("sd")?;
        match value.get_ref() {
            Node::String(text) if text.trim_end().ends_with('%') => {
                let (path, text) = (named(&table.path_of("sd")), shorten(text.trim()));
                self.unread(value, CaseProblem::PercentAsSd { path, text })
            }
            _ => self.amount(table, "sd", kind),
        }
    }

    /// (%) a percentage greater than zero.
    pub(super) fn percent(&mut self, table: &Table<'t>, key: &'static str) -> Option<f64> {
        self.percent_within(table, key, |number| number > 0.0, "greater than zero")
    }

    /// A percentage of 0 or more, below a limit.
    pub(super) fn percent_below(&mut self, table: &Table<'t>, key: &'static str, most: f64) -> Option<f64> {
        let range = format!("0 or more, and less than {most}");
        self.percent_within(table, key, |number| (0.0..most).contains(&number), range)
    }

    /// A probability in per cent, from 0 to 100.
    pub(super) fn probability(&mut self, table: &Table<'t>, key: &'static str) -> Option<f64> {
        self.percent_within(table, key, |number| (0.0..=100.0).contains(&number), "from 0 to 100")
    }

    fn percent_within(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        holds: impl FnOnce(f64) -> bool,
        range: impl Into<Cow<'static, str>>,
    ) -> Option<f64> {
        let value = table.get(key)?;
        let (path, example) = (table.path_of(key), table.schema.example(key));
        let text = match value.get_ref() {
            Node::String(text) => match split_number(text.trim()) {
                (Some(number), rest) if rest.trim() == "%" && number.is_finite() => {
                    if holds(number) {
                        return Some(number);
                    }
                    let (path, range) = (named(&path), range.into());
                    return self
                        .unread(value, CaseProblem::OutOfRange { path, value: number, range, example });
                }
                _ => shorten(text),
            },
            Node::Number(_) | Node::NotDecimal => self.written(value),
            _ => return self.wrong_type(value, path, "a percentage in quotes", example),
        };
        self.unread(value, CaseProblem::NotPercent { path: named(&path), text, example })
    }
}

/// The number in fifteen digits, like all numbers that are written: the middle of 0.2 and 0.4 is 0.3, not
/// 0.300 000 000 000 000 04, which is the sum of their halves.
fn decimal(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}
