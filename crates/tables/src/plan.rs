//! The columns for each key, found once for a table, and the values of each row.

use arrow_array::cast::AsArray as _;
use arrow_array::{Array, RecordBatch};
use arrow_buffer::NullBuffer;
use arrow_schema::{DataType, Field, Schema};
use case::{Dimension, Unit, Value, ValueTable, list_range_keys, nearest_names, range_keys};

use crate::TableError;
use crate::column::{Cell, Column, Lists};
use crate::name::{Name, Step, unit};
use crate::shape::Shape;

/// The column with the seed of each row.
pub(crate) const SEED: &str = "seed";

/// The metadata of a field with its unit.
pub(crate) const UNIT: &str = "unit";

/// (bytes) longest text: more than ten thousand depths.
const LONGEST_TEXT: usize = 1 << 17;

/// The name of a column in error texts.
type Called = String;

/// The columns that give the value of a key.
struct Part<'a> {
    /// The path as in a case.
    path: String,
    key: &'static str,
    shape: Shape,
    /// The column of the value itself, and those of its other forms in a struct.
    whole: Vec<(Called, Whole<'a>)>,
    /// The parts of its keys.
    keys: Vec<Part<'a>>,
    /// The parts of its elements.
    elements: Vec<Option<Part<'a>>>,
    /// Whether nothing gives the unit of the column, so that bare numbers in it are SI.
    assumes_unit: bool,
}

/// A column of a value.
enum Whole<'a> {
    One(Column<'a>, Kind),
    List(Lists<'a>, Box<Part<'a>>),
}

/// How the cells of a column are read.
#[derive(Clone, Copy)]
enum Kind {
    Text,
    Flag,
    Number,
    Percent,
    Quantity(&'static Unit),
    /// A text with several numbers.
    Numbers,
    /// The same, with a unit at its end or that of the column.
    Quantities(&'static Unit),
    /// A text with several words.
    Names,
    /// The same, or one word.
    Words,
}

/// The keys that the columns of a table give.
pub(crate) struct Plan<'a> {
    case: Part<'a>,
    seed: Option<Column<'a>>,
}

/// The role of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// It gives a key.
    Key,
    Seed,
    /// It is one of the table's own.
    Other,
}

/// The indices of the columns that give no key.
///
/// # Errors
/// [`TableError::UnknownKey`] for one that looks like a key, and [`TableError::NoKey`] if none is one.
pub(crate) fn others(schema: &Schema) -> Result<Vec<usize>, TableError> {
    let mut others = Vec::new();
    for (place, field) in schema.fields().iter().enumerate() {
        if role(field)? == Role::Other {
            others.push(place);
        }
    }
    if !others.is_empty() && others.len() == schema.fields().len() {
        return Err(TableError::NoKey {
            columns: schema.fields().iter().map(|field| field.name().clone()).collect(),
        });
    }
    Ok(others)
}

/// The right spelling of a name that differs from a key in capital letters, or that only ends like one, as
/// `v2.speed` and `mass [kg]` do.
fn meant(name: &str) -> Option<String> {
    let tables = || Shape::case().keys();
    let lower = name.to_lowercase();
    if let Some(key) = tables().find(|key| {
        let rest = lower.strip_prefix(key.name);
        rest.is_some_and(|rest| name != lower && (rest.starts_with('.') || rest.starts_with("__")))
    }) {
        let of = if lower.contains('.') { "." } else { "__" };
        return Some(format!(
            "keys are written in small letters, as \"vehicle2{of}speed\", and units as they are usually \
             written, as in \"{}\"",
            if of == "." { format!("{}.mass [kg]", key.name) } else { format!("{}__mass__kg", key.name) }
        ));
    }
    if lower == SEED {
        return Some(format!("write \"{SEED}\" in small letters"));
    }
    let mut name = Name::of(&lower);
    let mut of = Vec::new();
    keys_ending_in(&name, Shape::case(), "", &mut of);
    if let [Step::Key(_), Step::Key(second), ..] = &name.steps[..] {
        let tables = tables().filter(|key| {
            let table = Shape::case().within(key);
            matches!(table, Shape::Table(_)) && table.keys().any(|inner| inner.name == second)
        });
        of.extend(tables.map(|key| format!("\"{}.{second}\"", key.name)));
    }
    // Without brackets, the unit is the last step.
    if let (None, Some(Step::Key(last))) = (&name.unit, name.steps.last()) {
        name.unit = Some(last.clone());
        name.steps.pop();
        keys_ending_in(&name, Shape::case(), "", &mut of);
    }
    // Of those with the fewest steps.
    let steps = |key: &String| key.matches('.').count();
    let fewest = of.iter().map(steps).min();
    of.retain(|key| Some(steps(key)) == fewest);
    let of = of.join(" or ");
    (!of.is_empty()).then(|| format!("did you mean {of}? If the column is not meant as a key, rename it"))
}

/// Adds the keys in a table that end in this name. A name of one step has to have a unit that fits: a table
/// may have its own column `mass`, but hardly one with a unit in brackets.
fn keys_ending_in(name: &Name, table: Shape, path: &str, found: &mut Vec<String>) {
    for key in table.keys() {
        let inner = table.within(key);
        if !matches!(inner, Shape::Table(_) | Shape::WordOrTable(_)) {
            continue;
        }
        let path = format!("{path}{}.", key.name);
        let fits = inner.at(&name.steps).is_some_and(|last| match &name.unit {
            Some(text) => last.dimension().is_some_and(|dimension| unit(text, dimension).is_some()),
            None => name.steps.len() > 1,
        });
        if fits {
            found.push(format!("\"{path}{}\"", name.path()));
        }
        keys_ending_in(name, inner, &path, found);
    }
}

/// The role of a column: it gives a key if its name begins with the name of a table of the case.
fn role(field: &Field) -> Result<Role, TableError> {
    let name = field.name().trim();
    if name == SEED {
        return Ok(Role::Seed);
    }
    let tables = || Shape::case().keys();
    let of_steps = Name::of(name);
    let Some(Step::Key(first)) = of_steps.steps.first() else { return Ok(Role::Other) };
    if let Some(key) = tables().find(|key| key.name == first) {
        let is_table = matches!(Shape::case().within(key), Shape::Table(_));
        if of_steps.steps.len() > 1 || (is_table && matches!(field.data_type(), DataType::Struct(_))) {
            return Ok(Role::Key);
        }
        // A table may have its own column `source` or `impact`.
        let is_text = !is_table && Column::is_text(field.data_type());
        return Ok(if is_text { Role::Key } else { Role::Other });
    }
    let looks_like =
        tables().filter(|key| matches!(Shape::case().within(key), Shape::Table(_))).find(|key| {
            let rest = name.strip_prefix(key.name);
            let rest = rest.and_then(|rest| rest.strip_prefix(['_', '.', ' ', '-', '/', ':']));
            // A table may have its own column `impact_type`, but hardly one of a vehicle.
            let mut keys = Shape::case().within(key).keys();
            rest.is_some_and(|rest| {
                key.name.starts_with("vehicle") || keys.any(|key| rest.starts_with(key.name))
            })
        });
    let Some(table) = looks_like else {
        return match meant(name) {
            Some(help) => Err(unknown(field.name(), help)),
            None => Ok(Role::Other),
        };
    };
    let rest = &name[table.name.len() + 1..];
    Err(TableError::UnknownKey {
        column: field.name().clone(),
        help: format!(
            "the parts of a key have dots or two underscores between them, as \"{0}.{rest}\" or \
             \"{0}__{rest}\", and the unit is in brackets, as \"vehicle1.mass [kg]\", or at the end, as \
             \"vehicle1__mass__kg\"",
            table.name
        ),
    })
}

impl<'a> Part<'a> {
    fn new(path: String, key: &'static str, shape: Shape) -> Self {
        Self {
            path,
            key,
            shape,
            whole: Vec::new(),
            keys: Vec::new(),
            elements: Vec::new(),
            assumes_unit: false,
        }
    }

    /// The part of a key, added if there is none yet.
    fn key(&mut self, key: &'static str, shape: Shape) -> &mut Self {
        let place = self.keys.iter().position(|part| part.key == key).unwrap_or_else(|| {
            let path = if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) };
            self.keys.push(Self::new(path, key, shape));
            self.keys.len() - 1
        });
        &mut self.keys[place]
    }

    fn element(&mut self, index: usize, shape: Shape) -> &mut Self {
        while self.elements.len() <= index {
            self.elements.push(None);
        }
        let path = format!("{}[{}]", self.path, index + 1);
        self.elements[index].get_or_insert_with(|| Self::new(path, "", shape))
    }

    /// The part at the end of a path in a name, and the unit there.
    fn at(&mut self, steps: &[Step], called: &str) -> Result<(&mut Self, Option<String>), TableError> {
        let Some((step, rest)) = steps.split_first() else { return Ok((self, None)) };
        match step {
            Step::Element(index) => match self.shape.listed() {
                Some(shape) => self.element(*index, shape).at(rest, called),
                None => Err(unknown(called, format!("\"{}\" is not a list", self.path))),
            },
            Step::Key(name) => {
                if let Some(key) = self.shape.keys().find(|key| key.name == name) {
                    let shape = self.shape.within(key);
                    return self.key(key.name, shape).at(rest, called);
                }
                // The last step of a name without brackets may be its unit.
                if rest.is_empty() && self.shape.dimension().is_some_and(|of| unit(name, of).is_some()) {
                    return Ok((self, Some(name.clone())));
                }
                Err(self.unknown_key(called, name))
            }
        }
    }

    /// Assigns a column, or the field of a struct, to this part. `gate` marks the rows in which a struct
    /// around it is null; `own` is the unit in its name, and `around` that of the range or list around it.
    fn take(
        &mut self,
        called: &str,
        (field, array): (&Field, &'a dyn Array),
        gate: Option<&NullBuffer>,
        (own, around): (Option<&str>, Option<&str>),
    ) -> Result<(), TableError> {
        let of_metadata = field.metadata().get(UNIT).map(String::as_str);
        if let (Some(named), Some(stored), Some(of)) = (own, of_metadata, self.shape.dimension())
            && let Some(known) = unit(named, of)
            && unit(stored, of) != Some(known)
        {
            return Err(TableError::Unit {
                column: called.to_owned(),
                unit: named.to_owned(),
                problem: format!("differs from \"{stored}\" in its metadata"),
                help: "state the unit in one place".to_owned(),
            });
        }
        let own = own.or(of_metadata);
        let DataType::Struct(fields) = array.data_type() else {
            let whole = self.whole_of(called, array, gate, (own, around))?;
            if let [(first, _), ..] = &self.whole[..] {
                return Err(TableError::Twice {
                    first: first.clone(),
                    second: called.to_owned(),
                    key: self.path.clone(),
                });
            }
            self.assumes_unit = own.or(around).is_none();
            self.whole.push((called.to_owned(), whole));
            return Ok(());
        };
        if self.shape.keys().next().is_none() {
            return Err(self.wrong_type(called, array));
        }
        let around = match (self.shape.dimension(), own) {
            (Some(_), own) => own.or(around),
            (None, None) => None,
            (None, Some(unit)) => return Err(self.no_unit(called, unit)),
        };
        let structs = array.as_struct();
        let gate = NullBuffer::union(structs.nulls(), gate);
        for (field, array) in fields.iter().zip(structs.columns()) {
            let called = format!("{called}.{}", field.name());
            let (array, gate) = (array.as_ref(), gate.as_ref());
            let aside = self.shape.aside();
            if let Some((_, shape)) = aside.into_iter().find(|(aside, _)| field.name() == aside) {
                let whole =
                    Part::new(self.path.clone(), "", shape).whole_of(&called, array, gate, (None, None))?;
                self.whole.push((called, whole));
                continue;
            }
            let name = Name::of(field.name());
            let (part, end) = self.at(&name.steps, &called)?;
            let own = name.unit.or(end);
            part.take(&called, (field, array), gate, (own.as_deref(), around))?;
        }
        Ok(())
    }

    /// The column as read by this part.
    fn whole_of(
        &self,
        called: &str,
        array: &'a dyn Array,
        gate: Option<&NullBuffer>,
        (own, around): (Option<&str>, Option<&str>),
    ) -> Result<Whole<'a>, TableError> {
        if let (Some(lists), Some(shape)) = (Lists::of(array, gate), self.shape.listed()) {
            let mut listed = Part::new(self.path.clone(), "", shape);
            let values = lists.values();
            // The unit of a list is that of its elements.
            let field = match array.data_type() {
                DataType::List(field) | DataType::LargeList(field) | DataType::FixedSizeList(field, _) => {
                    field.as_ref().clone()
                }
                other => Field::new("item", other.clone(), true),
            };
            let of_list = own.or(around);
            if let (Some(unit), None) = (own, self.shape.dimension()) {
                return Err(self.no_unit(called, unit));
            }
            listed.take(called, (&field, values), None, (None, of_list))?;
            return Ok(Whole::List(lists, Box::new(listed)));
        }
        let data_type = array.data_type();
        let kind = self.kind(called, (own, around))?;
        let fits = match kind {
            _ if matches!(self.shape, Shape::Table(_) | Shape::Tables(_)) => *data_type == DataType::Null,
            Kind::Text | Kind::Names | Kind::Words | Kind::Numbers | Kind::Quantities(_) => {
                Column::is_text(data_type)
            }
            Kind::Flag => Column::is_flag(data_type) || Column::is_text(data_type),
            Kind::Number | Kind::Percent | Kind::Quantity(_) => {
                Column::is_number(data_type) || Column::is_text(data_type)
            }
        };
        let column =
            Column::of(array, gate).filter(|_| fits).ok_or_else(|| self.wrong_type(called, array))?;
        Ok(Whole::One(column, kind))
    }

    /// How a column of this part is read.
    fn kind(&self, called: &str, (own, around): (Option<&str>, Option<&str>)) -> Result<Kind, TableError> {
        let si = |dimension: Dimension| {
            unit(dimension.si_unit(), dimension).ok_or_else(|| unknown(called, "it has no unit".to_owned()))
        };
        let of = |dimension: Dimension| match own.or(around) {
            None => si(dimension),
            Some(spelled) => unit(spelled, dimension).ok_or_else(|| TableError::Unit {
                column: called.to_owned(),
                unit: spelled.to_owned(),
                problem: format!("is none of {}", dimension.name()),
                help: format!("write one of {}", units(dimension)),
            }),
        };
        let kind = match self.shape {
            Shape::Quantity(dimension)
            | Shape::UncertainQuantity(dimension)
            | Shape::Sourced(dimension)
            | Shape::QuantityOrTables(dimension, _) => {
                return of(dimension).map(Kind::Quantity);
            }
            Shape::Angle => return of(Dimension::Angle).map(Kind::Quantity),
            Shape::UncertainQuantities(dimension) => {
                return of(dimension).map(Kind::Quantities);
            }
            Shape::Text | Shape::Word | Shape::WordOrTable(_) => Kind::Text,
            Shape::Words => Kind::Words,
            Shape::Flag => Kind::Flag,
            Shape::Percent => Kind::Percent,
            Shape::Names => Kind::Names,
            Shape::Numbers => Kind::Numbers,
            // Only a column of nulls can be one of these.
            Shape::Table(_) | Shape::Tables(_) => Kind::Text,
            Shape::Number
            | Shape::Count
            | Shape::Uncertain
            | Shape::Wheels
            | Shape::Wheel
            | Shape::NumberOrTable(_) => Kind::Number,
        };
        match (own, kind) {
            (None, kind) => Ok(kind),
            (Some("%"), Kind::Percent) => Ok(kind),
            (Some(unit), _) => Err(self.no_unit(called, unit)),
        }
    }

    fn no_unit(&self, called: &str, unit: &str) -> TableError {
        TableError::Unit {
            column: called.to_owned(),
            unit: unit.to_owned(),
            problem: format!("\"{}\" does not have", self.path),
            help: "leave it out".to_owned(),
        }
    }

    fn wrong_type(&self, called: &str, array: &dyn Array) -> TableError {
        TableError::Type {
            column: called.to_owned(),
            found: array.data_type().clone(),
            wanted: self.shape.wanted().to_owned(),
        }
    }

    fn unknown_key(&self, called: &str, name: &str) -> TableError {
        let (bare, spelled) = name.rsplit_once('_').unwrap_or((name, ""));
        let names: Vec<&str> = self.shape.keys().map(|key| key.name).collect();
        let of_unit =
            self.shape.keys().find(|key| key.name == bare).filter(|key| {
                self.shape.within(key).dimension().is_some_and(|of| unit(spelled, of).is_some())
            });
        let table = if self.path.is_empty() { "a case".to_owned() } else { format!("\"{}\"", self.path) };
        let help = match (of_unit, nearest_names(name, names.iter().copied()).first()) {
            (Some(key), _) => format!("write the unit in brackets, as \"{} [{spelled}]\"", key.name),
            (None, Some(near)) => format!("{table} has no \"{name}\"; did you mean \"{near}\"?"),
            (None, None) if self.shape.dimension().is_some() => {
                format!("{table} has neither a key nor a unit \"{name}\"")
            }
            (None, None) if names.is_empty() => format!("{table} has no keys"),
            (None, None) => format!("{table} has no \"{name}\"; its keys are {}", names.join(", ")),
        };
        unknown(called, help)
    }

    /// Adds the columns of this part with bare numbers in some of `rows`, which are taken as SI, with their
    /// unit.
    fn add_assumed(&self, rows: usize, assumed: &mut Vec<(String, &'static str)>) {
        for (called, whole) in self.whole.iter().filter(|_| self.assumes_unit) {
            match whole {
                Whole::One(column, kind @ (Kind::Quantity(unit) | Kind::Quantities(unit))) => {
                    let is_bare = |row: usize| {
                        let value = column.cell(row).map(|cell| kind.value(cell));
                        matches!(value, Some(Value::Quantity(..)))
                            || matches!(value, Some(Value::List(list)) if !list.is_empty())
                    };
                    if (0..rows).any(is_bare) {
                        assumed.push((called.clone(), unit.spelling()));
                    }
                }
                Whole::List(lists, part) => part.add_assumed(lists.values().len(), assumed),
                Whole::One(..) => {}
            }
        }
        for part in self.keys.iter().chain(self.elements.iter().flatten()) {
            part.add_assumed(rows, assumed);
        }
    }

    /// The value in a row; `None` if everything is null.
    fn value(&self, row: usize) -> Result<Option<Value<'a>>, String> {
        let mut table = ValueTable::new();
        for part in &self.keys {
            if let Some(value) = part.value(row)? {
                table.insert(part.key, value);
            }
        }
        let mut whole: Option<(&str, Value<'a>)> = None;
        for (called, column) in &self.whole {
            let Some(value) = column.value(row, &self.path)? else { continue };
            if let Some((first, _)) = whole {
                return Err(format!(
                    "\"{first}\" and \"{called}\" both have a value: leave one of them null"
                ));
            }
            whole = Some((called, value));
        }
        if !self.elements.is_empty() {
            let elements =
                self.elements.iter().map(|part| part.as_ref().map_or(Ok(None), |part| part.value(row)));
            if let Some(list) = listed(elements, &self.path)? {
                if let Some((called, _)) = whole {
                    return Err(format!(
                        "\"{called}\" has a value, and columns of its elements have values: leave one or the other null"
                    ));
                }
                whole = Some((&self.path, list));
            }
        }
        match (whole, self.shape.central()) {
            (None, _) if table.is_empty() => Ok(None),
            (None, central) => Ok(Some(alone(table, central))),
            (Some((_, value)), _) if table.is_empty() => Ok(Some(match (self.shape, value) {
                // One word of several is written without a list.
                (Shape::Words, Value::List(mut list)) if list.len() == 1 => list.remove(0),
                (_, value) => value,
            })),
            (Some((_, value)), Some(central)) if table.get(central).is_none() && is_amount(&value) => {
                table.insert(central, value);
                Ok(Some(Value::Table(table)))
            }
            (Some((called, _)), _) => {
                let keys: Vec<String> = table.iter().map(|(key, _)| format!("\"{key}\"")).collect();
                Err(format!(
                    "\"{called}\" has a value, and so has its {}: leave one or the other null",
                    keys.join(", ")
                ))
            }
        }
    }
}

impl<'a> Whole<'a> {
    fn value(&self, row: usize, path: &str) -> Result<Option<Value<'a>>, String> {
        match self {
            Self::One(column, kind) => match column.cell(row) {
                Some(Cell::Text(text)) if text.len() > LONGEST_TEXT => Err(format!(
                    "\"{path}\" has a text of {} bytes, and at most {LONGEST_TEXT} are read",
                    text.len()
                )),
                cell => Ok(cell.map(|cell| kind.value(cell))),
            },
            Self::List(lists, listed_part) => {
                let Some(places) = lists.places(row) else { return Ok(None) };
                if places.is_empty() {
                    return Err(format!("\"{path}\" is an empty list: leave it null to take the template's"));
                }
                listed(places.map(|place| listed_part.value(place)), path)
            }
        }
    }
}

/// The number that a word of a cell is, with the minus sign of print (U+2212), too.
#[must_use]
pub fn read_number(word: &str) -> Option<f64> {
    word.replace('\u{2212}', "-").parse().ok()
}

impl Kind {
    fn value(self, cell: Cell<'_>) -> Value<'_> {
        let text = match cell {
            Cell::Number(number) => {
                return match self {
                    Self::Quantity(unit) | Self::Quantities(unit) => Value::Quantity(number, unit),
                    Self::Percent => Value::Text(format!("{number} %").into()),
                    _ => Value::Number(number),
                };
            }
            Cell::Flag(flag) => return Value::Flag(flag),
            Cell::Text(text) => text,
        };
        let number = || read_number(text.trim());
        let numbers = |of: &dyn Fn(f64) -> Value<'static>| {
            let list = text.split_whitespace().map(|word| read_number(word).map(of));
            list.collect::<Option<Vec<Value<'static>>>>().map(Value::List)
        };
        let read = match self {
            Self::Text => None,
            Self::Flag => match text.trim() {
                "true" | "True" | "TRUE" => Some(Value::Flag(true)),
                "false" | "False" | "FALSE" => Some(Value::Flag(false)),
                _ => None,
            },
            Self::Number => number().map(Value::Number),
            Self::Percent => number().map(|_| Value::Text(format!("{} %", text.trim()).into())),
            Self::Quantity(unit) => number().map(|number| Value::Quantity(number, unit)),
            Self::Numbers => numbers(&Value::Number),
            Self::Quantities(unit) => numbers(&|number| Value::Quantity(number, unit)),
            Self::Words if !text.trim().contains(char::is_whitespace) => None,
            Self::Names | Self::Words => {
                Some(Value::List(text.split_whitespace().map(|word| Value::Text(word.into())).collect()))
            }
        };
        read.unwrap_or(Value::Text(text.into()))
    }
}

/// A list of elements, which ends at the first one without a value; `None` if none has one.
fn listed<'a>(
    elements: impl Iterator<Item = Result<Option<Value<'a>>, String>>,
    path: &str,
) -> Result<Option<Value<'a>>, String> {
    let mut list = Vec::new();
    let mut missing = None;
    for (index, element) in elements.enumerate() {
        match (element?, missing) {
            (Some(_), Some(gap)) => {
                let (gap, next): (usize, usize) = (gap + 1, index + 1);
                return Err(format!(
                    "value {gap} of \"{path}\" is null, but value {next} is not: a list ends at its first null"
                ));
            }
            (Some(value), None) => list.push(value),
            (None, None) => missing = Some(index),
            (None, Some(_)) => {}
        }
    }
    Ok((!list.is_empty()).then_some(Value::List(list)))
}

/// Reduces a range with only a central value to that value.
fn alone<'a>(mut table: ValueTable<'a>, central: Option<&'static str>) -> Value<'a> {
    match central {
        Some(central) if table.len() == 1 => match table.remove(central) {
            Some(value) => value,
            None => Value::Table(table),
        },
        _ => Value::Table(table),
    }
}

/// Whether a value can be the central value of a range.
fn is_amount(value: &Value<'_>) -> bool {
    match value {
        Value::Number(_) | Value::Quantity(..) | Value::Text(_) => true,
        Value::List(list) => list.iter().all(|one| matches!(one, Value::Quantity(..) | Value::Text(_))),
        Value::Flag(_) | Value::Table(_) => false,
    }
}

fn unknown(called: &str, help: String) -> TableError {
    TableError::UnknownKey { column: called.to_owned(), help }
}

fn units(dimension: Dimension) -> String {
    dimension.units().iter().map(Unit::spelling).collect::<Vec<_>>().join(", ")
}

impl<'a> Plan<'a> {
    pub(crate) fn of(batch: &'a RecordBatch) -> Result<Self, TableError> {
        let mut case = Part::new(String::new(), "", Shape::case());
        let mut seed = None;
        let schema = batch.schema_ref();
        others(schema)?;
        for (field, array) in schema.fields().iter().zip(batch.columns()) {
            match role(field)? {
                Role::Other => {}
                Role::Seed => {
                    let data_type = array.data_type();
                    let fits = Column::is_number(data_type) || Column::is_text(data_type);
                    let column = Column::of(array.as_ref(), None).filter(|_| fits);
                    seed = Some(column.ok_or_else(|| TableError::Type {
                        column: field.name().clone(),
                        found: data_type.clone(),
                        wanted: "a seed is a whole number".to_owned(),
                    })?);
                }
                Role::Key => {
                    let name = Name::of(field.name());
                    let (part, end) = case.at(&name.steps, field.name())?;
                    let own = name.unit.or(end);
                    part.take(field.name(), (field, array.as_ref()), None, (own.as_deref(), None))?;
                }
            }
        }
        Ok(Self { case, seed })
    }

    /// The columns whose bare numbers are taken as SI because nothing gives their unit, with the unit.
    pub(crate) fn assumed(&self, rows: usize) -> Vec<(String, &'static str)> {
        let mut assumed = Vec::new();
        self.case.add_assumed(rows, &mut assumed);
        assumed
    }

    /// The values of a row.
    pub(crate) fn row(&self, row: usize) -> Result<ValueTable<'a>, String> {
        match self.case.value(row)? {
            Some(Value::Table(table)) => Ok(table),
            _ => Ok(ValueTable::new()),
        }
    }

    /// The seed of a row; `None` if the table has none.
    pub(crate) fn seed(&self, row: usize) -> Result<Option<u64>, String> {
        /// Largest whole number up to which doubles are exact, 2⁵³.
        const LAST: f64 = 9_007_199_254_740_992.0;
        let Some(cell) = self.seed.as_ref().and_then(|column| column.cell(row)) else { return Ok(None) };
        let number = match cell {
            Cell::Number(number) => Some(number),
            Cell::Text(text) => text.trim().parse().ok(),
            Cell::Flag(_) => None,
        };
        let whole = number.filter(|number| (0.0..=LAST).contains(number) && number.fract() == 0.0);
        match whole {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number in the range"
            )]
            Some(number) => Ok(Some(number as u64)),
            None => Err(format!("\"{SEED}\" is not a whole number from 0 to 2^53")),
        }
    }
}

/// Adds the values of a row to those that all rows share: tables key by key; any other value replaces the
/// shared one. A range without a central value applies to the shared value.
pub(crate) fn merge<'a>(shared: &mut ValueTable<'a>, row: ValueTable<'a>) {
    for (key, value) in row {
        match (shared.get_mut(&key), value) {
            (Some(Value::Table(old)), Value::Table(new)) if !is_range(old) && !is_range(&new) => {
                merge(old, new);
            }
            (Some(old), Value::Table(mut new)) if is_spread(&new) => {
                let central = match &*old {
                    Value::Table(old) => {
                        ["value", "values"].into_iter().find_map(|key| Some((key, old.get(key)?.clone())))
                    }
                    Value::List(_) => Some(("values", old.clone())),
                    other => Some(("value", other.clone())),
                };
                if let Some((key, central)) = central {
                    new.insert(key, central);
                }
                *old = Value::Table(new);
            }
            (Some(old), new) => *old = new,
            (None, new) => shared.insert(key, new),
        }
    }
}

fn is_range(table: &ValueTable<'_>) -> bool {
    let is_curve = table.get("speeds").is_some();
    !is_curve && (range_keys().iter().chain(list_range_keys())).any(|key| table.get(key.name).is_some())
}

/// Whether a table gives the uncertainty of a number, but not the number.
fn is_spread(table: &ValueTable<'_>) -> bool {
    is_range(table) && ["value", "values", "low", "mode", "high"].iter().all(|key| table.get(key).is_none())
}
