//! Plots of computed against measured and of reconstructed against true.

use ::drawing::{Axis, Drawing, Marker, ScatterPanel, ScatterPicture, ScatterPoint, Symbol};
use validation::{DeltaVRow, FOOT_PER_SECOND, Reconstruction, Table1Row, Validation};

use crate::units::number;

const fn filled(marker: Marker) -> Symbol {
    Symbol { marker, is_filled: true }
}

const fn hollow(marker: Marker) -> Symbol {
    Symbol { marker, is_filled: false }
}

/// The range of the differences between the computed and the measured numbers, in words.
fn differences(points: &[ScatterPoint], Axis { unit, .. }: &Axis) -> String {
    let difference = |point: &ScatterPoint| (point.at[1] - point.at[0]) / unit;
    let least = points.iter().map(difference).fold(f64::INFINITY, f64::min);
    let most = points.iter().map(difference).fold(f64::NEG_INFINITY, f64::max);
    format!("{} points, differences from {} to {}", points.len(), number(least, 1), number(most, 1))
}

/// Computed against measured ΔV (ft/s) of all vehicles, PIM next to CRASH3. The same bytes at every run.
#[must_use]
pub fn computed_against_measured(validation: &Validation) -> Drawing {
    // One marker for each geometry of Table 1, where each method has a row.
    let geometries: Vec<&Table1Row> =
        validation.table1.iter().filter(|row| row.method == validation::Method::Pim).collect();
    let marker = |test: u8| {
        let place = geometries.iter().position(|row| row.tests.contains(&test)).unwrap_or_default();
        Marker::ALL[place % Marker::ALL.len()]
    };
    let panel = |row: DeltaVRow, title: &str| ScatterPanel {
        title: title.to_owned(),
        points: validation
            .table2
            .iter()
            .filter(|line| line.row == row)
            .flat_map(|line| {
                [0, 1].map(|i| ScatterPoint {
                    at: [line.measured[i], line.cells[i].ours],
                    symbol: Symbol { marker: marker(line.test), is_filled: i == 0 },
                    label: Some(line.test.to_string()),
                })
            })
            .collect(),
    };
    let panels = vec![
        panel(DeltaVRow::PimTotal, "PIM, total ΔV"),
        panel(DeltaVRow::CrashCorrected, "CRASH3, corrected ΔV from the published profiles"),
    ];
    let axis = |what: &str| Axis { title: format!("{what} ΔV (ft/s)"), unit: FOOT_PER_SECOND };
    let (across, upward) = (axis("measured"), axis("computed"));
    let said: Vec<String> = panels
        .iter()
        .map(|panel| format!("{}: {}", panel.title, differences(&panel.points, &across)))
        .collect();
    let geometries = geometries.iter().zip(Marker::ALL);
    ScatterPicture {
        name: "computed-against-measured",
        title: "Computed against measured ΔV".to_owned(),
        subtitle: "One point for each vehicle, labelled with its test. Filled: vehicle 1; hollow: vehicle 2."
            .to_owned(),
        description: format!("Computed over measured ΔV of each vehicle, in ft/s. {}.", said.join("; ")),
        across,
        upward,
        panels,
        legend: geometries.map(|(row, marker)| (filled(marker), row.geometry.clone())).collect(),
        equality: "computed equals measured".to_owned(),
    }
    .draw()
}

/// Reconstructed against true speed (m/s) of vehicle 1, by source of the crush energy. The same bytes at
/// every run.
#[must_use]
pub fn reconstructed_speed(validation: &Validation) -> Drawing {
    let across = Axis { title: "true speed of vehicle 1 (m/s)".to_owned(), unit: 1.0 };
    let source = |name: &str, found: fn(&Reconstruction) -> f64, symbol: Symbol, is_labelled: bool| {
        let points: Vec<ScatterPoint> = validation
            .reconstructions
            .iter()
            .map(|line| ScatterPoint {
                at: [line.true_speed, found(line)],
                symbol,
                label: is_labelled.then(|| line.test.to_string()),
            })
            .collect();
        let said = format!("{name}: {}", differences(&points, &across));
        ((symbol, name.to_owned()), said, points)
    };
    let (mut points, mut legend, mut said) = (Vec::new(), Vec::new(), Vec::new());
    for (entry, words, of_source) in [
        source("published profiles", |line| line.found, filled(Marker::Circle), true),
        source("energy implied by the paper", |line| line.found_implied, hollow(Marker::Triangle), true),
        source("energy of SAE 871993", |line| line.round_trip.ours, hollow(Marker::Diamond), false),
    ] {
        legend.push(entry);
        said.push(words);
        points.extend(of_source);
    }
    ScatterPicture {
        name: "reconstructed-speed",
        title: "Speed from crush energy".to_owned(),
        subtitle:
            "One point for each test and source of the energy. Labels: test. The diamonds lie on the line."
                .to_owned(),
        description: format!(
            "Reconstructed over true speed of vehicle 1, in m/s, by source of the crush energy. From {}.",
            said.join("; from ")
        ),
        across,
        upward: Axis { title: "reconstructed speed of vehicle 1 (m/s)".to_owned(), unit: 1.0 },
        panels: vec![ScatterPanel { title: String::new(), points }],
        legend,
        equality: "found equals true".to_owned(),
    }
    .draw()
}
