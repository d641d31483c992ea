//! The answers of several laws side by side.

use analysis::{Comparison, quantity};
use case::Case;

use crate::data::comparison::{Row, rows};
use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::units::{Measure, Units, number};
use crate::{axes, warnings};

/// (columns) of the name of a law, and of a number, at least.
const NAME: usize = 34;
const COLUMN: usize = 7;

/// The comparison as tables, the coefficients behind them, and the warnings of the case as it stands.
#[must_use]
pub fn comparison(case: &Case, comparison: &Comparison, units: Units) -> Document {
    let rows = rows(case, comparison, units);
    let answered = || rows.iter().filter(|row| row.error.is_none());
    let name = |quantity: Measure| units.name(quantity);
    let plain = |quantity: Measure, value: Option<f64>| value.map(|si| units.plain(quantity, si));
    // A fixed object has neither motion nor heading.
    let of = |pair: Option<[f64; 2]>, i: usize| pair.filter(|_| !case.vehicles[i].fixed).map(|pair| pair[i]);
    let mut page = Document::new();
    page.title(case);

    for quantity in [Measure::RoadSpeed, Measure::Speed] {
        let speed = name(quantity);
        let columns = [
            ("speed".to_owned(), speed),
            (String::new(), "change"),
            (of_vehicle("delta_v", 1), speed),
            (String::new(), "change"),
            (of_vehicle("delta_v", 2), speed),
            (String::new(), "change"),
        ];
        page.push(table(
            &columns,
            answered().map(|row| {
                let value = |si: Option<f64>| plain(quantity, si);
                let change = |si: Option<f64>| si.map(|si| units.signed(quantity, si));
                let (dv, dv_change) = (row.values.delta_v, row.delta_v_difference);
                let cells = vec![
                    value(row.values.found),
                    change(row.found_difference),
                    value(of(dv, 0)),
                    change(of(dv_change, 0)),
                    value(of(dv, 1)),
                    change(of(dv_change, 1)),
                ];
                (row.law, cells)
            }),
        ));
    }
    page.push(table(
        &[
            (of_vehicle("pdof", 1), "°"),
            (of_vehicle("pdof", 2), "°"),
            (symbol("impact.energy_loss").to_owned(), name(Measure::Energy)),
            (symbol("impact.normal_work").to_owned(), "%"),
            (symbol("impact.tangential_work").to_owned(), "%"),
        ],
        answered().map(|row| {
            let share = |share: Option<f64>| share.map(|share| number(100.0 * share, 1));
            let values = &row.values;
            let cells = vec![
                plain(Measure::Angle, of(values.pdof, 0)),
                plain(Measure::Angle, of(values.pdof, 1)),
                plain(Measure::Energy, values.energy_loss),
                share(values.normal_share),
                share(values.tangential_share),
            ];
            (row.law, cells)
        }),
    ));
    let rates = [Measure::YawRate, Measure::YawRateDegrees];
    let [radians, degrees] = rates.map(name);
    page.push(table(
        &[
            (of_vehicle("final_yaw_rate", 1), radians),
            (String::new(), degrees),
            (of_vehicle("final_yaw_rate", 2), radians),
            (String::new(), degrees),
        ],
        // CRASH3 knows no rotation.
        answered().filter(|row| row.values.final_yaw_rate.is_some()).map(|row| {
            let cells = [0, 1].map(|i| rates.map(|rate| plain(rate, of(row.values.final_yaw_rate, i))));
            (row.law, cells.concat())
        }),
    ));
    page.heading("Coefficients");
    page.push(Block::Entries(rows.iter().map(|row| (row.law.to_owned(), coefficients(row))).collect()));
    for row in &rows {
        if let Some(error) = &row.error {
            page.paragraph(format!("{} has no answer: {error}", row.law));
        }
    }
    page.paragraph(format!(
        "The first row is the case's own law; the changes are from it, computed before rounding, so that they may \
         be off by one in the last digit from the differences of the printed figures. E_L is the energy loss, for CRASH3 the crush energy; \
         W_n and W_t are the work of the normal and the tangential impulse in % of the initial kinetic energy; Ω is the \
         yaw rate after impact, {} positive. Sources: theory 3 (laws), SAE 980025 Eq 5–8 (CRASH3).",
        axes::sense(case.axes)
    ));
    page.blocks.extend(warnings::of_analysis(&comparison.own, case, units));
    page
}

fn coefficients(row: &Row) -> String {
    let sliding =
        if row.values.regime == Some("sliding") { "; sliding continues until separation" } else { "" };
    let assumed = match row.assumed {
        "" => String::new(),
        assumed => format!("; assumed: {assumed}"),
    };
    format!("{}{sliding}{assumed}", row.coefficients)
}

/// As the table of results has it.
fn symbol(key: &str) -> &'static str {
    quantity(key).map_or("", |row| row.symbol)
}

/// The symbol with the number of the vehicle.
fn of_vehicle(key: &str, vehicle: u8) -> String {
    format!("{} {vehicle}", symbol(key))
}

/// Numbers of several laws, under a name and a unit.
fn table(
    columns: &[(String, &str)],
    rows: impl Iterator<Item = (&'static str, Vec<Option<String>>)>,
) -> Table {
    let numbers =
        columns.iter().map(|(name, unit)| Column::numbers(name.clone(), Width::Fit(COLUMN)).unit(*unit));
    let law = Column::words("law", Width::Fit(NAME));
    let mut table = Table::new("", std::iter::once(law).chain(numbers).collect::<Vec<_>>());
    for (law, values) in rows {
        let values = values.into_iter().map(|value| value.unwrap_or_else(|| NONE.to_owned()));
        table.cells(std::iter::once(law.to_owned()).chain(values));
    }
    table
}
