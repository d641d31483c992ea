//! Rows of tables: label, unit and source come from the table of quantities.

use analysis::{Kind, OutputQuantity, Seen, Values};

use crate::document::{NONE, Table};
use crate::outputs::printed;
use crate::units::{Measure, Units};

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
            Measure::Speed => self.units.speed(si),
            Measure::YawRate => self.units.yaw_rate(si),
            measure => self.units.format(measure, si),
        }
    }

    fn values(self, row: &OutputQuantity) -> [Option<f64>; 2] {
        match row.values(self.analysis) {
            Values::Pair(values) => values,
            Values::Shared(value) => [value, None],
        }
    }

    /// A row for both vehicles under the label of the quantity.
    pub(crate) fn pair(self, table: &mut Table, row: &OutputQuantity) {
        self.pair_with(table, row, |_, value| value);
    }

    /// The same, with words added to each value, by the index of its vehicle.
    pub(crate) fn pair_with(
        self,
        table: &mut Table,
        row: &OutputQuantity,
        worded: impl Fn(usize, String) -> String,
    ) {
        let values = self.values(row);
        let cells = [0, 1].map(|i| values[i].map(|si| worded(i, self.format(row.kind, si))));
        table.pair(row.label, cells, row.source);
    }

    /// A row for the vectors of both vehicles, from their components.
    pub(crate) fn vectors(self, table: &mut Table, [x, y]: [&OutputQuantity; 2]) {
        let components = [x, y].map(|row| self.values(row));
        let cells = [0, 1].map(|i| {
            let vector = [components[0][i]?, components[1][i]?];
            Some(self.units.format_vector(printed(x.kind), vector))
        });
        table.pair(x.label, cells, x.source);
    }

    /// A row for one vector, which belongs to neither vehicle.
    pub(crate) fn shared_vector(self, table: &mut Table, [x, y]: [&OutputQuantity; 2]) {
        if let [[Some(first), _], [Some(second), _]] = [x, y].map(|row| self.values(row)) {
            let cell = self.units.format_vector(printed(x.kind), [first, second]);
            table.shared(x.label, &cell, x.source);
        }
    }

    /// A row for the parts along n and t.
    pub(crate) fn along(self, table: &mut Table, [n, t]: [&OutputQuantity; 2]) {
        let cells = [n, t].map(|row| {
            let [si, _] = self.values(row);
            si.map(|si| self.units.format(printed(row.kind), si))
        });
        table.pair(n.label, cells, n.source);
    }

    /// A row for a number that belongs to neither vehicle.
    pub(crate) fn shared(self, table: &mut Table, row: &OutputQuantity) {
        self.shared_with(table, row, |value| value);
    }

    /// The same, with words added to the value.
    pub(crate) fn shared_with(
        self,
        table: &mut Table,
        row: &OutputQuantity,
        worded: impl Fn(String) -> String,
    ) {
        if let [Some(si), _] = self.values(row) {
            table.shared(row.label, &worded(self.format(row.kind, si)), row.source);
        }
    }

    /// A row for an energy and its share (%) of the initial one.
    pub(crate) fn energy(
        self,
        table: &mut Table,
        row: &OutputQuantity,
        indent: &str,
        share: impl Fn(f64) -> String,
    ) {
        if let [Some(si), _] = self.values(row) {
            let label = format!("{indent}{}", row.label);
            table.row([label, self.units.format(Measure::Energy, si), share(si), row.source.to_owned()]);
        }
    }
}

/// A value, or a dash.
pub(crate) fn or_none(value: Option<String>) -> String {
    value.unwrap_or_else(|| NONE.to_owned())
}
