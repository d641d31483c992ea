//! The answers of several laws side by side.

use analysis::quantities::{
    DELTA_V, FINAL_YAW_RATE, IMPACT_ENERGY_LOSS, IMPACT_NORMAL_WORK, IMPACT_TANGENTIAL_WORK, PDOF,
};
use analysis::{ByEvidence, Comparison, EvidenceAnswer, OutputQuantity};
use case::Case;

use super::chosen::or_none;
use crate::data::comparison::{Row, evidence_words, rows};
use crate::document::{Block, Column, Document, Table, Width};
use crate::units::{Measure, Units, number};
use crate::words::not_the_answer;
use crate::{axes, warnings};

/// (columns) minimum for the name of a law, and for a number.
const NAME: usize = 34;
const COLUMN: usize = 7;

/// (columns) of the labels of answers by evidence.
const SAID: usize = 26;

/// The comparison as tables: the answer by each kind of evidence, if the case has more than one; then the
/// answers of all laws, the coefficients behind them, and the warnings of the case as it stands.
#[must_use]
pub fn comparison(case: &Case, comparison: &Comparison, units: Units) -> Document {
    let rows = rows(case, comparison, units);
    let answered = || rows.iter().filter(|row| row.error.is_none());
    let name = |quantity: Measure| units.name(quantity);
    let plain = |quantity: Measure, value: Option<f64>| value.map(|si| units.plain(quantity, si));
    // A fixed object has neither motion nor heading.
    let of = |pair: Option<[f64; 2]>, i: usize| pair.filter(|_| !case.vehicles[i].fixed).map(|pair| pair[i]);
    let mut page = Document::of_case(case);

    if let Some(by) = &comparison.evidence {
        by_evidence(&mut page, by, units);
    }
    if case.impact.is_none() {
        page.paragraph("The file has no [impact], so there are no impact laws to compare.".to_owned());
        page.blocks.extend(warnings::of_analysis(&comparison.own, case, units));
        return page;
    }
    if let Some(caveat) = not_the_answer("figures of impact laws", &comparison.own) {
        page.paragraph(caveat);
    }
    let seeks_both = comparison.own.both.is_some();
    for quantity in [Measure::RoadSpeed, Measure::Speed] {
        let value = |si: Option<f64>| plain(quantity, si);
        let change = |si: Option<f64>| si.map(|si| units.signed(quantity, si));
        let pair = |values: Option<[f64; 2]>, changes: Option<[f64; 2]>| {
            [0, 1].map(|i| [value(of(values, i)), change(of(changes, i))]).concat()
        };
        let speed_of = |vehicle: u8| format!("speed {vehicle}");
        let speed = name(quantity);
        let with_change = |names: &[String]| -> Vec<(String, &str)> {
            names.iter().flat_map(|name| [(name.clone(), speed), (String::new(), "change")]).collect()
        };
        let delta_v = [1, 2].map(|vehicle| of_vehicle(&DELTA_V, vehicle));
        if seeks_both {
            // CRASH3 gives no speeds.
            let speeds = answered().filter(|row| row.values.speeds.is_some());
            page.push(table(
                &with_change(&[1, 2].map(speed_of)),
                speeds.map(|row| (row.law, pair(row.values.speeds, row.speeds_difference))),
            ));
        }
        let found = if seeks_both { Vec::new() } else { vec!["speed".to_owned()] };
        page.push(table(
            &with_change(&[found, delta_v.to_vec()].concat()),
            answered().map(|row| {
                let mut cells = pair(row.values.delta_v, row.delta_v_difference);
                if !seeks_both {
                    cells.splice(0..0, [value(row.values.found), change(row.found_difference)]);
                }
                (row.law, cells)
            }),
        ));
    }
    page.push(table(
        &[
            (of_vehicle(&PDOF, 1), "°"),
            (of_vehicle(&PDOF, 2), "°"),
            (IMPACT_ENERGY_LOSS.symbol.to_owned(), name(Measure::Energy)),
            (IMPACT_NORMAL_WORK.symbol.to_owned(), "%"),
            (IMPACT_TANGENTIAL_WORK.symbol.to_owned(), "%"),
        ],
        answered().map(|row| {
            let share = |share: Option<f64>| share.map(|share| number(100.0 * share, 1));
            let values = &row.values;
            let cells = vec![
                plain(Measure::Angle, values.pdof.and_then(|pdof| pdof[0])),
                plain(Measure::Angle, values.pdof.and_then(|pdof| pdof[1])),
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
            (of_vehicle(&FINAL_YAW_RATE, 1), radians),
            (String::new(), degrees),
            (of_vehicle(&FINAL_YAW_RATE, 2), radians),
            (String::new(), degrees),
        ],
        // CRASH3 gives no rotation.
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
        "The first row is the case's own law; the changes are relative to it and computed before rounding, \
         so they may differ by one in the last digit from the differences of the printed figures. E_L is \
         the energy loss, for CRASH3 the crush energy; \
         W_n and W_t are the work of the normal and the tangential impulse in % of the initial kinetic energy; Ω is the \
         yaw rate after impact, {} positive. Sources: theory 3 (laws), SAE 980025 Eq 5–8 (CRASH3).",
        axes::sense(case.axes)
    ));
    if comparison.own.both.as_ref().is_some_and(|both| !both.is_by_crush()) {
        page.paragraph(
            "Momentum gives the speeds of this case, so no law changes them. The other figures of each row are \
             those of an impact by that law at these speeds; `deltav reconstruct` gives ΔV by momentum itself."
                .to_owned(),
        );
    }
    page.blocks.extend(warnings::of_analysis(&comparison.own, case, units));
    page
}

/// The answers by damage, by momentum and by both, each with its method or why it has none.
fn by_evidence(page: &mut Document, by: &ByEvidence, units: Units) {
    let columns =
        [("damage only", &by.damage), ("momentum only", &by.momentum), ("momentum and damage", &by.together)];
    let mut table = Table::new("By evidence").columns(
        std::iter::once(Column::words("", SAID))
            .chain(columns.map(|(name, _)| Column::words(name, Width::Share)))
            .collect::<Vec<_>>(),
    );
    let mut row = |label: &str, value: &dyn Fn(Option<&EvidenceAnswer>) -> Option<String>| {
        let cells = columns.map(|(_, answer)| or_none(value(answer.as_ref().ok())));
        table.cells(std::iter::once(label.to_owned()).chain(cells));
    };
    for i in [0, 1] {
        row(&format!("speed of vehicle {}", i + 1), &|answer| Some(units.speed(answer?.speeds?[i])));
    }
    for i in [0, 1] {
        row(&format!("ΔV of vehicle {}", i + 1), &|answer| Some(units.speed(answer?.delta_v[i])));
    }
    let energy = |si: f64| units.format(Measure::Energy, si);
    row("closing speed −u_n", &|answer| Some(units.speed(answer?.closing_speed?)));
    row("crush energy needed", &|answer| Some(energy(answer?.crush_energy?)));
    row("crush energy measured", &|_| by.crush_energy.map(energy));
    row("energy loss E_L", &|answer| Some(energy(answer?.energy_loss?)));
    page.push(table);
    let said = columns.map(|(name, answer)| (name.to_owned(), evidence_words(answer, units)));
    page.push(Block::Entries(said.to_vec()));
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

/// The symbol with the number of the vehicle.
fn of_vehicle(row: &OutputQuantity, vehicle: u8) -> String {
    format!("{} {vehicle}", row.symbol)
}

/// Numbers of several laws, under a name and a unit.
fn table(
    columns: &[(String, &str)],
    rows: impl Iterator<Item = (&'static str, Vec<Option<String>>)>,
) -> Table {
    let numbers =
        columns.iter().map(|(name, unit)| Column::numbers(name.clone(), Width::Fit(COLUMN)).unit(*unit));
    let law = Column::words("law", Width::Fit(NAME));
    let mut table = Table::new("").columns(std::iter::once(law).chain(numbers).collect::<Vec<_>>());
    for (law, values) in rows {
        table.cells(std::iter::once(law.to_owned()).chain(values.into_iter().map(or_none)));
    }
    table
}
