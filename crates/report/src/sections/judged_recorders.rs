//! Speeds before the impact by all other evidence, compared with those that recorders stored.

use field::Recorders;

use super::field::CHOSEN;
use crate::data::judged_recorders::doubt;
use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::units::number;

/// The speeds and the ΔV of a table of crashes, compared with those that recorders stored.
#[must_use]
pub fn judged_recorders(recorders: &Recorders, file: &str) -> Document {
    let mut document = Document::new();
    document.push(Block::Title {
        title: "Speeds before the impact against recorders".to_owned(),
        source: Some(file.to_owned()),
    });
    let (speeds, delta_vs) = (&recorders.other_speed, &recorders.delta_v_from_speeds);
    document.paragraph(format!(
        "The file has {} rows. In {} of them, the recorders of both vehicles stored a speed that can be judged. The \
         speed of each vehicle is estimated from all evidence but its own recorder: the crush, the PDOF, the headings \
         and the other vehicle's recorder.",
        recorders.finished,
        speeds.n / 2
    ));
    if recorders.injured {
        document.paragraph(CHOSEN);
    }
    let kmh = |speed: Option<f64>| speed.map_or(NONE.to_owned(), |speed| number(3.6 * speed, 1));
    if let Some([half, eighty, most]) = speeds.coverage {
        let columns = vec![
            Column::words("", 26),
            Column::numbers("vehicles", Width::Fit(8)),
            Column::numbers("bias", Width::Fit(8)).unit("km/h"),
            Column::numbers("rms", Width::Fit(8)).unit("km/h"),
            Column::numbers("in 50 %", Width::Fit(8)).unit("%"),
            Column::numbers("in 80 %", Width::Fit(8)).unit("%"),
            Column::numbers("in 95 %", Width::Fit(8)).unit("%"),
            Column::numbers("half width", Width::Fit(10)).unit("km/h"),
        ];
        let mut table = Table::new("Speed of a vehicle").columns(columns);
        let share = |share: f64| number(100.0 * share, 1);
        let shares = [half, eighty, most].map(share);
        let mut cells =
            vec!["by all other evidence".to_owned(), speeds.n.to_string(), kmh(speeds.bias), kmh(speeds.rms)];
        cells.extend(shares);
        cells.push(kmh(speeds.half_width));
        table.cells(cells);
        document.push(table);
        let parts = speeds.half_width_without.iter();
        let parts = parts.map(|(part, width)| format!("{} {}", part.name(), kmh(Some(*width))));
        document.paragraph(format!(
            "half width: the median of half the widths of the 95 % intervals. If one part of the evidence \
             were exact, it would be (km/h): {}.",
            parts.collect::<Vec<_>>().join(", ")
        ));
    }
    if delta_vs.n > 0 {
        let columns = vec![
            Column::words("", 38),
            Column::numbers("vehicles", Width::Fit(8)),
            Column::numbers("bias of ln", Width::Fit(10)),
            Column::numbers("rms of ln", Width::Fit(10)),
        ];
        let mut table = Table::new("ΔV from the speeds of both recorders").columns(columns);
        for (method, figures) in [
            ("momentum to one common velocity", delta_vs),
            ("estimate, with crush and PDOF", &recorders.delta_v_by_estimate),
        ] {
            let figure = |figure: Option<f64>| figure.map_or(NONE.to_owned(), |figure| number(figure, 3));
            let figures = [figures.n.to_string(), figure(figures.bias), figure(figures.rms)];
            table.cells([method.to_owned()].into_iter().chain(figures));
        }
        document.push(table);
    }
    if !recorders.speeds.is_empty() {
        let columns = vec![
            Column::words("Crash", Width::Fit(8)),
            Column::numbers("vehicle", Width::Fit(7)),
            Column::numbers("recorded", Width::Fit(8)).unit("km/h"),
            Column::numbers("estimated", Width::Fit(9)).unit("km/h"),
            Column::numbers("95 % from", Width::Fit(9)).unit("km/h"),
            Column::numbers("to", Width::Fit(6)).unit("km/h"),
        ];
        let mut table = Table::new("").columns(columns);
        for judged in &recorders.speeds {
            let [low, high] = judged.intervals[2];
            let mut cells = vec![judged.case.clone(), (judged.vehicle.index() + 1).to_string()];
            cells.extend([judged.recorded, judged.median, low, high].map(|speed| kmh(Some(speed))));
            table.cells(cells);
        }
        document.push(table);
    }
    for record in &recorders.doubted {
        document.paragraph(format!(
            "Doubted: crash {}, vehicle {}: {}.",
            record.case,
            record.vehicle.index() + 1,
            doubt(record)
        ));
    }
    for (case, reason) in &recorders.refused {
        document.paragraph(format!("Not judged: crash {case}: {reason}."));
    }
    document
}
