//! The units in which a file is written, for examples that suit it.

use std::cell::OnceCell;

use toml::de::{DeTable, DeValue};

use super::values::leading_numbers;
use crate::schema::{RANGE, RANGE_OF_LIST};
use crate::units::{Dimension, Unit, UnitSystem};

/// (–) more are not looked at: no case has as many keys.
const MOST: usize = 200;

/// What may be the unit of a number, and where it stands.
struct Ending<'t> {
    key: &'t str,
    in_crush: bool,
    /// Those of several dimensions: "lb" is a mass, a weight and a stiffness G.
    units: Vec<&'static Unit>,
}

/// The units in which a file is written: looked for at the first error that wants an example.
pub(super) struct Written<'t> {
    document: &'t DeTable<'t>,
    endings: OnceCell<Vec<Ending<'t>>>,
}

impl<'t> Written<'t> {
    pub(super) fn of(document: &'t DeTable<'t>) -> Self {
        Self { document, endings: OnceCell::new() }
    }

    fn endings(&self) -> &[Ending<'t>] {
        self.endings.get_or_init(|| {
            let mut endings = Vec::new();
            for (key, value) in self.document {
                collect(key.get_ref(), value.get_ref(), false, &mut endings);
            }
            endings
        })
    }

    /// A unit for an example: that in which the file has the same key elsewhere, or else something of the same kind; or one of the system in which most of it is
    /// written.
    pub(super) fn example(&self, path: &str, dimension: Dimension) -> Option<&'static Unit> {
        let path = path.split('[').next().unwrap_or_default();
        let key = path.rsplit('.').find(|key| !is_of_range(key)).unwrap_or_default();
        let is_small =
            |in_crush: bool, key: &str| in_crush && key != "moment_arm" && dimension == Dimension::Length;
        let small = is_small(path.contains(".crush."), key);
        let unit =
            |ending: &Ending<'_>| ending.units.iter().copied().find(|unit| unit.dimension() == dimension);
        let units = || self.endings().iter().filter_map(|ending| Some((ending, unit(ending)?)));
        let same =
            units().find(|(ending, _)| ending.key == key && is_small(ending.in_crush, ending.key) == small);
        let alike = || units().find(|(ending, _)| is_small(ending.in_crush, ending.key) == small);
        if let Some((_, unit)) = same.or_else(alike) {
            return Some(unit);
        }
        let of_system = |unit: &&Unit| unit.system().is_none_or(|system| system == self.system());
        let mut units = dimension.units().iter().filter(of_system);
        if small { units.find(|unit| ["cm", "in"].contains(&unit.spelling())) } else { units.next() }
    }

    fn system(&self) -> UnitSystem {
        let system = |ending: &Ending<'_>| ending.units.iter().find_map(|unit| unit.system());
        let of = |wanted| self.endings().iter().filter(|ending| system(ending) == Some(wanted)).count();
        if of(UnitSystem::Us) > of(UnitSystem::Si) { UnitSystem::Us } else { UnitSystem::Si }
    }
}

fn collect<'t>(key: &'t str, value: &'t DeValue<'t>, in_crush: bool, endings: &mut Vec<Ending<'t>>) {
    match value {
        _ if endings.len() == MOST => {}
        DeValue::String(text) => {
            let (numbers, text) = leading_numbers(text);
            let units: Vec<_> =
                Dimension::ALL.into_iter().filter_map(|dimension| dimension.unit(text)).collect();
            if !numbers.is_empty() && !units.is_empty() {
                endings.push(Ending { key, in_crush, units });
            }
        }
        DeValue::Array(list) => {
            // One value tells the unit of the list as well as all.
            if let Some(first) = list.first() {
                collect(key, first.get_ref(), in_crush, endings);
            }
        }
        DeValue::Table(table) => {
            for (inner, value) in table {
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
