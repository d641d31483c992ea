//! Plots of estimates against recorders.

use ::drawing::{Axis, Drawing, Marker, RanksPicture, ScatterPanel, ScatterPicture, ScatterPoint, Symbol};
use field::{Field, Judged, PairKind};
use pim_core::Real;

use crate::units::number;

/// (m/s)
const KM_PER_HOUR: f64 = 1.0 / 3.6;

fn symbol(kind: PairKind) -> Symbol {
    let place = PairKind::ALL.iter().position(|other| *other == kind).unwrap_or_default();
    Symbol { marker: Marker::ALL[place % Marker::ALL.len()], is_filled: false }
}

/// Estimated against recorded ΔV (km/h), and WinSMASH's next to it if the file has it. The same bytes at
/// every run.
#[must_use]
pub fn estimated_against_recorded(field: &Field) -> Drawing {
    let panel = |title: String, of: fn(&Judged) -> Option<f64>| ScatterPanel {
        title,
        points: field
            .judged
            .iter()
            .filter_map(|judged| {
                let at = [judged.truth.delta_v, of(judged)?];
                Some(ScatterPoint { at, symbol: symbol(judged.kind), label: None })
            })
            .collect(),
    };
    let rms = |figures: &field::Figures| number(figures.rms[0], 2);
    let all = field.groups.first();
    let said = |who: &str, figures: Option<&field::Figures>| match figures {
        Some(figures) => {
            format!("{who}: {} vehicles, root mean square of ln(ΔV/recorder) {}", figures.n, rms(figures))
        }
        None => who.to_owned(),
    };
    let ours = panel(said("median of the estimate", all.map(|all| &all.ours)), |judged| Some(judged.median));
    let winsmash =
        panel(said("WinSMASH", all.and_then(|all| all.winsmash.as_ref())), |judged| judged.winsmash);
    let panels: Vec<ScatterPanel> =
        [ours, winsmash].into_iter().filter(|panel| !panel.points.is_empty()).collect();
    let axis = |what: &str| Axis { title: format!("{what} ΔV (km/h)"), unit: KM_PER_HOUR };
    let titles: Vec<&str> = panels.iter().map(|panel| panel.title.as_str()).collect();
    let has = |kind: &PairKind| field.judged.iter().any(|judged| judged.kind == *kind);
    ScatterPicture {
        name: "estimated-against-recorded",
        title: "Estimated against recorded ΔV".to_owned(),
        subtitle: format!("One point for each vehicle with a recorder{}.", given(field)),
        description: format!(
            "Estimated over recorded ΔV of each vehicle, in km/h, by kind of collision. {}.",
            titles.join("; ")
        ),
        across: axis("recorded"),
        upward: axis("estimated"),
        panels,
        legend: PairKind::ALL
            .into_iter()
            .filter(has)
            .map(|kind| (symbol(kind), kind.name().to_owned()))
            .collect(),
        equality: "estimated equals recorded".to_owned(),
    }
    .draw()
}

fn given(field: &Field) -> &'static str {
    if field.other { ", with the recorder of the other vehicle given" } else { "" }
}

/// A histogram, in tenths, of the rank of each recorded ΔV in the distribution that the estimate predicts for
/// it. The same bytes at every run.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "counts of vehicles are far below 2⁵³")]
pub fn ranks_of_recorders(field: &Field) -> Drawing {
    let counts = field.groups.first().and_then(|all| all.ours.pit).unwrap_or_default();
    let n = counts.iter().sum::<usize>() as f64;
    let share = 1.0 / counts.len() as f64;
    // n p ± 2 √(n p (1 − p))
    let beside = 2.0 * Real::sqrt(n * share * (1.0 - share));
    let listed: Vec<String> = counts.iter().map(usize::to_string).collect();
    RanksPicture {
        name: "ranks-of-recorders",
        title: "Where recorders lie in the predicted distributions".to_owned(),
        subtitle: format!(
            "{n} vehicles{}. If intervals contain recorders as often as they say, all bars are about equally high.",
            given(field)
        ),
        description: format!(
            "Number of vehicles by the share of the predictive distribution below what the recorder stored, in \
             tenths from low to high: {}.",
            listed.join(", ")
        ),
        across: Axis { title: "share expected below what the recorder stored (%)".to_owned(), unit: 0.01 },
        upward: Axis { title: "vehicles".to_owned(), unit: 1.0 },
        counts: counts.iter().map(|count| *count as f64).collect(),
        expected: n * share,
        band: [(n * share - beside).max(0.0), n * share + beside],
        legend: ["vehicles", "expected", "two standard deviations of chance"].map(str::to_owned),
    }
    .draw()
}
