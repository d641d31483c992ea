//! The units in which a file is written, for examples that suit it.

use crate::node::{Entries, Node};
use crate::number::leading_numbers;
use crate::schema::{RANGE, RANGE_OF_LIST, dimensions_of};
use crate::units::read_unit;
use inputs::{Dimension, Unit, UnitSystem, format_number};

/// (–) maximum number of values that are examined: no case has as many keys.
const MOST: usize = 200;

/// The possible units of a number, and the place where it is.
#[derive(Clone, Debug)]
struct Ending {
    key: String,
    in_crush: bool,
    /// A spelling can belong to several dimensions: "lb" is a mass, a weight and a stiffness G.
    units: Vec<&'static Unit>,
}

/// The units in which a file is written.
#[derive(Clone, Debug, Default)]
pub(crate) struct UnitsInUse {
    endings: Vec<Ending>,
}

impl UnitsInUse {
    pub(crate) fn of(document: &Entries<'_>) -> Self {
        let mut endings = Vec::new();
        for (key, value) in document.iter() {
            collect(key.get_ref(), value.get_ref(), false, &mut endings);
        }
        Self { endings }
    }

    /// A unit for an example: that of the same key elsewhere in the file, or else of a value of the same
    /// kind; or one of the system in which most of the file is written. `None` if the file does not show any:
    /// [`usual_units`] are then equally good.
    pub(crate) fn example(&self, path: &str, dimension: Dimension) -> Option<&'static Unit> {
        let path = path.split('[').next().unwrap_or_default();
        let key = path.rsplit('.').find(|key| !is_of_range(key)).unwrap_or_default();
        let small = is_small(path.contains(".crush."), key, dimension);
        self.unit(key, small, dimension)
            .or_else(|| self.system().and_then(|system| first_unit(system, small, dimension)))
            // Damage is mostly measured in centimetres, whatever the units of the rest.
            .or_else(|| if small { first_unit(UnitSystem::Si, small, dimension) } else { None })
    }

    /// A text with its examples in the units of the file: in a file written in feet, `contact = { x = "1.78
    /// m" }` becomes `contact = { x = "5.8 ft" }`. `place` is the path of the table or the key that it is
    /// about.
    pub(crate) fn suited(&self, place: &str, text: &str) -> String {
        let in_crush = place.contains("crush");
        let mut out = String::with_capacity(text.len());
        // Every second part is between quotes.
        for (index, part) in text.split('"').enumerate() {
            if index > 0 {
                out.push('"');
            }
            let converted =
                (index % 2 == 1).then(|| self.converted(key_before(&out), part, in_crush)).flatten();
            out.push_str(converted.as_deref().unwrap_or(part));
        }
        out
    }

    /// The same quantity, or list of them, in a unit of the file; `None` if it is already in one, or is not a
    /// quantity.
    fn converted(&self, key: &str, text: &str, in_crush: bool) -> Option<String> {
        let (numbers, spelling) = leading_numbers(text);
        let units = || Dimension::ALL.into_iter().filter_map(|dimension| read_unit(spelling, dimension));
        // "lb" is a weight, a mass and a stiffness: the key decides.
        let of_key = dimensions_of(key);
        let unit = units().find(|unit| of_key.contains(&unit.dimension())).or_else(|| units().next())?;
        let dimension = unit.dimension();
        let small = is_small(in_crush || ["cm", "in"].contains(&unit.spelling()), key, dimension);
        let of_other_system = |system: &UnitSystem| unit.system().is_some_and(|of_unit| of_unit != *system);
        if !self.endings.iter().any(|ending| ending.key == key) && self.has(unit, small) {
            return None;
        }
        let wanted = self.unit(key, small, dimension).or_else(|| {
            self.system().filter(of_other_system).and_then(|system| first_unit(system, small, dimension))
        })?;
        if wanted == unit || numbers.is_empty() {
            return None;
        }
        let numbers: Vec<String> =
            numbers.iter().map(|(number, _)| round(number * unit.factor() / wanted.factor())).collect();
        Some(format!("{} {wanted}", numbers.join(" ")))
    }

    /// Whether a value of the same kind has this unit.
    fn has(&self, unit: &Unit, small: bool) -> bool {
        self.endings.iter().any(|ending| {
            ending.units.contains(&unit) && is_small(ending.in_crush, &ending.key, unit.dimension()) == small
        })
    }

    /// The unit of the same key elsewhere in the file, or of a value of the same kind.
    fn unit(&self, key: &str, small: bool, dimension: Dimension) -> Option<&'static Unit> {
        let units = || {
            self.endings.iter().filter_map(|ending| {
                let unit = ending.units.iter().copied().find(|unit| unit.dimension() == dimension)?;
                (is_small(ending.in_crush, &ending.key, dimension) == small).then_some((ending, unit))
            })
        };
        let same = units().find(|(ending, _)| ending.key == key);
        same.or_else(|| units().next()).map(|(_, unit)| unit)
    }

    /// The system in which most of the file is written; `None` if both are equally common.
    fn system(&self) -> Option<UnitSystem> {
        let system = |ending: &Ending| ending.units.iter().find_map(|unit| unit.system());
        let of = |wanted| self.endings.iter().filter(|ending| system(ending) == Some(wanted)).count();
        match of(UnitSystem::Us).cmp(&of(UnitSystem::Si)) {
            std::cmp::Ordering::Greater => Some(UnitSystem::Us),
            std::cmp::Ordering::Less => Some(UnitSystem::Si),
            std::cmp::Ordering::Equal => None,
        }
    }
}

/// The first units of a dimension: one if both systems share it, else one of each.
pub(crate) fn usual_units(dimension: Dimension) -> Vec<&'static Unit> {
    let mut units = Vec::new();
    for system in [UnitSystem::Si, UnitSystem::Us] {
        units.extend(first_unit(system, false, dimension).filter(|unit| !units.contains(unit)));
    }
    units
}

/// The lengths of a damage are written in smaller units than those of a vehicle.
fn is_small(in_crush: bool, key: &str, dimension: Dimension) -> bool {
    in_crush && key != "moment_arm" && dimension == Dimension::Length
}

fn first_unit(system: UnitSystem, small: bool, dimension: Dimension) -> Option<&'static Unit> {
    let mut units =
        dimension.units().iter().filter(|unit| unit.system().is_none_or(|of_unit| of_unit == system));
    if small { units.find(|unit| ["cm", "in"].contains(&unit.spelling())) } else { units.next() }
}

/// The key of `… key = "`.
fn key_before(text: &str) -> &str {
    let text = text.trim_end_matches(['"', '=', ' ']);
    text.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default()
}

/// Rounds to two digits: an example needs no more.
fn round(number: f64) -> String {
    let digits = format!("{number:.1e}");
    digits.parse().map_or(digits, format_number)
}

fn collect(key: &str, value: &Node<'_>, in_crush: bool, endings: &mut Vec<Ending>) {
    match value {
        _ if endings.len() == MOST => {}
        Node::String(text) => {
            let (numbers, text) = leading_numbers(text);
            let units: Vec<_> =
                Dimension::ALL.into_iter().filter_map(|dimension| read_unit(text, dimension)).collect();
            if !numbers.is_empty() && !units.is_empty() {
                endings.push(Ending { key: key.to_owned(), in_crush, units });
            }
        }
        Node::Array(list) => {
            // One value shows the unit of the list as well as all.
            if let Some(first) = list.first() {
                collect(key, first.get_ref(), in_crush, endings);
            }
        }
        Node::Table(table) => {
            for (inner, value) in table.iter() {
                let inner: &str = inner.get_ref();
                let name = if is_of_range(inner) { key } else { inner };
                collect(name, value.get_ref(), in_crush || key == "crush", endings);
            }
        }
        _ => {}
    }
}

fn is_of_range(key: &str) -> bool {
    RANGE.has(key) || RANGE_OF_LIST.has(key)
}
