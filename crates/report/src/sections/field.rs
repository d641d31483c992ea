//! How the intervals of ΔV compare with recorders.

use std::collections::BTreeSet;

use field::ciss::CissCrashes;
use field::{Field, Figures, Group, Judged, LEVELS};

use crate::data::field::{FieldData, FieldYear};
use crate::document::{Column, Document, NONE, Table, Width};
use crate::units::number;

/// States that the crashes were chosen for an injury.
pub(super) const CHOSEN: &str = "The crashes are assumed to have been chosen because somebody in either \
                                 vehicle was seriously hurt (MAIS 3 or more). Before the evidence, they are \
                                 more severe than those in which a vehicle was towed.";

/// Intervals of ΔV, estimated without the recorder, compared with the ΔV that it stored.
#[must_use]
pub fn field(field: &Field, data: &FieldData<'_>) -> Document {
    let mut document = Document::new();
    document.push(crate::document::Block::Title {
        title: "ΔV by estimate against ΔV by recorder".to_owned(),
        source: Some(data.name.to_owned()),
    });
    let all = field.groups.first();
    let (n, collisions) = all.map_or((0, 0), |group| (group.ours.n, group.ours.collisions));
    let rows = if field.objects { "vehicles" } else { "pairs" };
    if field.objects {
        document.paragraph(format!(
            "The program estimated the ΔV of {n} vehicles whose front struck an object, in {collisions} \
             collisions, of {} in the file, from the damage, the PDOF and the mass. The recorder is not used \
             as evidence. The speed is unknown, and the object does not move or absorb energy. The intervals \
             are for what the recorder should store, with its own error. Lines with damage other than to the \
             front are not read.",
            field.pairs
        ));
    } else {
        let evidence = if field.other {
            "the damage, the headings, the PDOF, the masses, and the recorder of the other vehicle"
        } else {
            "the damage, the headings, the PDOF and the masses"
        };
        document.paragraph(format!(
            "The program estimated the ΔV of {n} vehicles in {collisions} collisions, of {} pairs in the file, \
             from {evidence}. The recorder of the judged vehicle is not used as evidence. Both speeds are \
             unknown. The intervals are for what the recorder should store, with its own error.",
            field.pairs
        ));
    }
    if field.injured {
        document.paragraph(CHOSEN);
    }
    if field.finished < field.pairs {
        document.paragraph(format!(
            "Ended early: only the first {} {rows} of the file were processed. All figures are for these alone.",
            field.finished
        ));
    }
    push_years(&mut document, data.years);
    document.push(coverage(field));
    document.push(errors(field));
    document.push(tenths(field));
    let unconverged: Vec<&Judged> = field.judged.iter().filter(|judged| !judged.converged).collect();
    if let Some(first) = unconverged.first() {
        document.paragraph(format!(
            "For {} vehicles the run did not converge; the first is vehicle {} of crash {}. More particles help.",
            unconverged.len(),
            first.vehicle,
            first.case
        ));
    }
    if !field.doubted.is_empty() {
        // A vehicle has one record for each event.
        let recorders =
            field.doubted.iter().map(|(case, vehicle)| format!("vehicle {vehicle} of crash {case}"));
        let recorders: Vec<_> = recorders.collect::<BTreeSet<_>>().into_iter().collect();
        document.paragraph(format!(
            "Left out: the recorder of {}. Its records of two events fit these events more than a hundred \
             times better if they are exchanged, judging by their directions and by the momentum that the \
             other vehicle's recorder shows. So it is not known which record is of which event.",
            recorders.join(", of ")
        ));
    }
    if field.other {
        document.paragraph(
            "one-event: without collisions whose two recorders stored different events, because the changes \
             of momentum that they show (mass times ΔV) differ by more than a factor of 2.7. They are in \
             all other rows.",
        );
    }
    document.paragraph(
        "bias: mean of ln(median/recorder). rms: root mean square of the same. ± is a standard error that counts \
         collisions, not vehicles. CRPS: continuous ranked probability score; for a single value it is the mean \
         absolute error. WinSMASH is NHTSA's program; its values come from the file and are not used as input.",
    );
    document
}

/// The tables of NHTSA that were read, and the number of crashes in them that can be judged.
pub(super) fn push_years(document: &mut Document, years: &[FieldYear]) {
    let Some(first) = years.first() else { return };
    document.push(tables_read(years));
    document.push(candidates(years, first.crashes.is_of_objects));
}

fn tables_read(years: &[FieldYear]) -> Table {
    let columns = [
        Column::words("NHTSA's tables", 32),
        Column::numbers("rows", Width::Fit(8)),
        Column::words("file", Width::Share),
    ];
    let mut table = Table::new("").columns(columns);
    for year in years {
        for read in &year.crashes.tables {
            let place = format!("{}: {}", year.source, case::shown(&read.file));
            table.row([read.name.to_owned(), read.rows.to_string(), place]);
        }
    }
    table
}

fn candidates(years: &[FieldYear], is_of_objects: bool) -> Table {
    let what = if is_of_objects { "Vehicles that struck an object" } else { "Pairs of vehicles" };
    let columns = [Column::words(what, 58), Column::numbers("number", Width::Fit(8))];
    let mut table = Table::new("").columns(columns);
    let found: usize = years.iter().map(|year| year.crashes.rows.len()).sum();
    table.row(["in the table that is judged".to_owned(), found.to_string()]);
    for (reason, count) in CissCrashes::left_out_of(years.iter().map(|year| &year.crashes)) {
        table.row([format!("left out, {}", reason.why(is_of_objects)), count.to_string()]);
    }
    table
}

pub(super) fn percent([value, error]: [f64; 2]) -> String {
    with_error([100.0 * value, 100.0 * error], 1)
}

/// Without an error of 0: the spread between collisions is unknown if there is one, or if all are alike.
fn with_error([value, error]: [f64; 2], decimals: usize) -> String {
    let value = number(value, decimals);
    if error == 0.0 { value } else { format!("{value} ± {}", number(error, decimals)) }
}

fn coverage(field: &Field) -> Table {
    let mut columns =
        vec![Column::words("Recorders inside the intervals", 32), Column::numbers("vehicles", Width::Fit(8))];
    columns.extend(
        LEVELS.map(|level| {
            Column::numbers(format!("{} %", number(100.0 * level, 0)), Width::Fit(11)).unit("%")
        }),
    );
    columns.push(Column::numbers("width of 95 %", Width::Fit(13)).unit("of the median"));
    let mut table = Table::new("").columns(columns);
    for Group { name, ours, .. } in &field.groups {
        let mut cells = vec![(*name).to_owned(), ours.n.to_string()];
        match &ours.coverage {
            Some(coverage) => cells.extend(coverage.iter().copied().map(percent)),
            None => cells.extend([NONE; 3].map(str::to_owned)),
        }
        cells.push(ours.width95.map_or(NONE.to_owned(), |width| format!("{} %", number(100.0 * width, 0))));
        table.cells(cells);
    }
    table
}

fn errors(field: &Field) -> Table {
    let mut table = Table::new("").columns(figure_columns("Median against recorder", 32));
    let mut row = |name: &str, figures: &Figures| table.cells(figure_cells(name, figures));
    for Group { name, ours, winsmash, ours_of_these } in &field.groups {
        row(name, ours);
        if let (Some(winsmash), Some(ours)) = (winsmash, ours_of_these) {
            row("  WinSMASH", winsmash);
            row("  ours, the same vehicles", ours);
        }
    }
    table
}

/// The columns of figures against recorders, the first of which has a name and a width.
pub(super) fn figure_columns(name: &str, width: usize) -> Vec<Column> {
    vec![
        Column::words(name, width),
        Column::numbers("vehicles", Width::Fit(8)),
        Column::numbers("bias of ln", Width::Fit(16)),
        Column::numbers("rms of ln", Width::Fit(16)),
        Column::numbers("CRPS", Width::Fit(6)).unit("km/h"),
    ]
}

/// Their cells.
pub(super) fn figure_cells(name: &str, figures: &Figures) -> Vec<String> {
    let with = |figure| with_error(figure, 3);
    let crps = number(3.6 * figures.crps, 2);
    vec![name.to_owned(), figures.n.to_string(), with(figures.bias), with(figures.rms), crps]
}

/// (columns) of the longest bar.
const LONGEST: usize = 40;

fn tenths(field: &Field) -> Table {
    let mut table = Table::new("").columns([
        Column::words("Share expected below recorder", 32),
        Column::numbers("vehicles", Width::Fit(8)),
        Column::bars("", Width::Share),
    ]);
    if let Some(pit) = field.groups.first().and_then(|group| group.ours.pit) {
        let most = pit.iter().copied().max().unwrap_or(1).max(1);
        for (tenth, count) in pit.iter().enumerate() {
            let bar = "█".repeat(count * LONGEST / most);
            table.row([format!("{} to {} %", 10 * tenth, 10 * (tenth + 1)), count.to_string(), bar]);
        }
    }
    table.note("If the intervals are right as often as they say, all bars are about equally long.");
    table
}
