//! Rows of tables, chosen by key from the table of results: label, unit and source stand there.

use analysis::{Kind, OutputQuantity, Seen, Values, quantity};

use crate::document::{NONE, Table};
use crate::outputs::printed;
use crate::units::{Measure, Units, number};

/// The numbers of an analysis, in the axes of the case and the units of the reader.
#[derive(Clone, Copy)]
pub(crate) struct Chosen<'a> {
    pub(crate) analysis: &'a Seen,
    pub(crate) units: Units,
}

impl Chosen<'_> {
    /// A number as its kind is printed, a speed in the unit of the equations and that of the road.
    pub(crate) fn format(self, kind: Kind, si: f64) -> String {
        match printed(kind) {
            None => number(si, 4),
            Some(Measure::Speed) => self.units.speed(si),
            Some(Measure::YawRate) => self.units.yaw_rate(si),
            Some(quantity) => self.units.format(quantity, si),
        }
    }

    fn values(self, row: &OutputQuantity) -> [Option<f64>; 2] {
        match row.values(self.analysis) {
            Values::Pair(values) => values,
            Values::Shared(value) => [value, None],
        }
    }

    /// A row of both vehicles under the label of the quantity, or under another one where that says more.
    pub(crate) fn pair(self, table: &mut Table, key: &str) {
        self.pair_with(table, key, |_, value| value);
    }

    /// The same, each value worded further, by the index of its vehicle.
    pub(crate) fn pair_with(self, table: &mut Table, key: &str, worded: impl Fn(usize, String) -> String) {
        let Some(row) = quantity(key) else { return };
        let values = self.values(row);
        let cells = [0, 1].map(|i| values[i].map(|si| worded(i, self.format(row.kind, si))));
        table.pair(row.label, cells, row.source);
    }

    /// A row of the vectors of both vehicles, whose components have the keys `key.x` and `key.y`.
    pub(crate) fn vectors(self, table: &mut Table, key: &str) {
        let [Some(x), Some(y)] = ["x", "y"].map(|axis| quantity(&format!("{key}.{axis}"))) else { return };
        let components = [x, y].map(|row| self.values(row));
        let cells = [0, 1].map(|i| {
            let vector = [components[0][i]?, components[1][i]?];
            Some(self.units.format_vector(printed(x.kind)?, vector))
        });
        table.pair(x.label, cells, x.source);
    }

    /// A row of one vector that belongs to neither vehicle, with the keys `key.x` and `key.y`.
    pub(crate) fn shared_vector(self, table: &mut Table, key: &str) {
        let [Some(x), Some(y)] = ["x", "y"].map(|axis| quantity(&format!("{key}.{axis}"))) else { return };
        if let [[Some(first), _], [Some(second), _]] = [x, y].map(|row| self.values(row)) {
            let vector = [first, second];
            let cell = match printed(x.kind) {
                Some(quantity) => self.units.format_vector(quantity, vector),
                None => format!("({})", vector.map(|part| number(part, 4)).join(", ")),
            };
            table.shared(x.label, &cell, x.source);
        }
    }

    /// A row of the parts along n and t.
    pub(crate) fn along(self, table: &mut Table, [normal, tangential]: [&str; 2]) {
        let [Some(n), Some(t)] = [normal, tangential].map(quantity) else { return };
        let cells = [n, t].map(|row| {
            let [si, _] = self.values(row);
            si.map(|si| printed(row.kind).map_or_else(|| number(si, 4), |kind| self.units.format(kind, si)))
        });
        table.pair(n.label, cells, n.source);
    }

    /// A row of a number that belongs to neither vehicle.
    pub(crate) fn shared(self, table: &mut Table, key: &str) {
        self.shared_with(table, key, |value| value);
    }

    /// The same, the value worded further.
    pub(crate) fn shared_with(self, table: &mut Table, key: &str, worded: impl Fn(String) -> String) {
        let Some(row) = quantity(key) else { return };
        if let [Some(si), _] = self.values(row) {
            table.shared(row.label, &worded(self.format(row.kind, si)), row.source);
        }
    }

    /// A row of an energy and its share (%) of the initial one.
    pub(crate) fn energy(self, table: &mut Table, key: &str, indent: &str, share: impl Fn(f64) -> String) {
        let Some(row) = quantity(key) else { return };
        if let [Some(si), _] = self.values(row) {
            let label = format!("{indent}{}", row.label);
            table.row([label, self.units.format(Measure::Energy, si), share(si), row.source.to_owned()]);
        }
    }
}

/// The label of a quantity; its key if it has no row.
pub(crate) fn label(key: &'static str) -> &'static str {
    quantity(key).map_or(key, |row| row.label)
}

/// A value, or a dash.
pub(crate) fn or_none(value: Option<String>) -> String {
    value.unwrap_or_else(|| NONE.to_owned())
}
