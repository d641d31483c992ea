//! The results of another program, compared with recorders.

use field::{ClaimGroup, Claims};

use super::field::{figure_cells, figure_columns, percent, push_years};
use crate::data::field::FieldData;
use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::units::number;

/// The ΔV of another program, compared with those that recorders stored.
#[must_use]
pub fn claims(claims: &Claims, data: &FieldData<'_>) -> Document {
    let mut document = Document::new();
    document.push(Block::Title {
        title: format!("ΔV by {} against ΔV by recorder", claims.columns.value),
        source: Some(data.name.to_owned()),
    });
    let n = claims.judged.len();
    document.paragraph(format!(
        "The file has {} pairs. {n} of its vehicles have both a usable recorder and a ΔV in the column {}; \
         {} have only a recorder. `deltav validate --field FILE` judges the program's own estimates by the \
         same \
         recorders.",
        claims.pairs, claims.columns.value, claims.unclaimed
    ));
    push_years(&mut document, data.years);
    let mut columns = figure_columns("Against recorder", 20);
    let has_intervals = claims.columns.ends.is_some();
    if has_intervals {
        columns.push(Column::numbers("in 95 %", Width::Fit(11)).unit("%"));
        columns.push(Column::numbers("interval score", Width::Fit(14)).unit("km/h"));
    }
    let mut table = Table::new("").columns(columns);
    for ClaimGroup { name, figures, coverage95, interval_score } in &claims.groups {
        let mut cells = figure_cells(name, figures);
        if has_intervals {
            cells.push(coverage95.map_or(NONE.to_owned(), percent));
            cells.push(interval_score.map_or(NONE.to_owned(), |score| number(3.6 * score, 1)));
        }
        table.cells(cells);
    }
    document.push(table);
    document.paragraph(
        "bias: mean of ln(claimed/recorder). rms: root mean square of the same. ± is a standard error that counts \
         collisions, not vehicles. CRPS: for a single value, the mean absolute error. If a recorder stored only the \
         longitudinal ΔV, its size is compared with the claim, whatever the claim is; for such a recorder, \
         `deltav validate --field FILE` uses WinSMASH's longitudinal ΔV.",
    );
    if has_intervals {
        document.paragraph(
            "Interval score: the width of the 95 % interval, plus 40 times the distance by which it misses the recorder \
             (Gneiting & Raftery 2007); less is better.",
        );
    }
    document
}
