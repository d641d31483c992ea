//! A finished analysis as text for people, as JSON for programs, as a report to hand over and as drawings; and the program's own validation.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let file = case::Case::parse("sae-980025.toml", include_str!("../../../fixtures/sae-980025.toml"))?;
//! let analysis = analysis::reconstruct(&file)?;
//! let text = report::text(&file.case, &analysis, report::Units::Us);
//! assert!(text.contains("75.03 ft/s")); // SAE 980025: 75 ft/s
//! let json = report::json(&file.case, &analysis)?;
//! assert!(json.contains("\"admissible_roots\": 1"));
//! # Ok(())
//! # }
//! ```
//!
//! The functions: [`text`] in the [`Units`] of the reader, where every figure names its equation; [`json`] in SI units and radians, with keys that are kept;
//! [`message`], the sentence of a warning ([`warnings_text`] has all of an analysis), and [`no_answer`], that of a case without an answer. All speak the [`Axes`](case::Axes) of the case, which each document names. Results are converted to other units here and nowhere else.
//!
//! [`html`] is the report to hand over, one self-contained file; [`markdown`] the same without drawings. Both show the [`steps`]: every result with its
//! equation, the numbers put into it, and its source.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let file = case::Case::parse("sae-980025.toml", include_str!("../../../fixtures/sae-980025.toml"))?;
//! # let analysis = analysis::reconstruct(&file)?;
//! let scene = report::drawing(&file, &analysis, report::Units::Us, report::Subject::Scene)?;
//! assert!(scene.svg().starts_with("<svg"));
//! # Ok(())
//! # }
//! ```
//!
//! [`drawing`] draws a [`Subject`]: the scene and the damage to scale, the reconciliation, the energy. A [`Drawing`] is SVG, or PNG with the letters of
//! DejaVu Sans, which the crate carries. Colours are told apart with any colour vision, and dashes, heads and hatching say the same in grey.
//!
//! [`validation_text`], [`validation_json`] and [`validation_markdown`] write the comparison with the RICSAC collisions;
//! [`computed_against_measured`] and [`reconstructed_speed`] plot it as SVG.
//!
//! [`uncertainty_text`] and [`uncertainty_json`] say between what and what the results of a case with ranges lie; [`histogram`] and [`tornado`] plot
//! that, and [`write_samples`] gives the samples themselves.
//!
//! [`judgement_text`] and [`judgement_json`] say what was understood of a case before it is solved; [`explain`](explain()) has a short text on each term,
//! symbol, key and warning, from docs/glossary.md.
//!
//! Of many cases, [`csv_row`] under [`csv_header`] gives a line each for a spreadsheet, and [`jsonl_row`] for a program.
//!
//! `examples/text_and_drawing.rs` goes from a file to a text and a drawing.
//!
//! # What it does not do
//!
//! It computes nothing that the analysis does not hold, but the sums that a step of the report shows on the way. No terminal, no files.

mod axes;
mod checks;
mod comparison;
mod drawing;
mod energy;
mod explain;
mod failures;
mod json;
mod judgement;
mod law;
mod page;
mod rows;
mod sensitivity;
mod staged;
mod steps;
mod text;
mod uncertainty;
mod units;
mod warnings;

pub use comparison::{comparison_json, comparison_text};
pub use drawing::{Drawing, DrawingError, Subject, drawing};
pub use explain::{Topic, UnknownTopic, explain, topic, topic_json, topics, topics_json, topics_text};
pub use failures::no_answer;
pub use json::json;
pub use judgement::{judgement_json, judgement_text};
pub use page::{Supplement, html, markdown};
pub use rows::{Refused, Row, RowError, csv_columns, csv_header, csv_row, jsonl_row};
pub use sensitivity::{sensitivity_json, sensitivity_text};
pub use staged::{
    PlotError, computed_against_measured, reconstructed_speed, validation_headline, validation_json,
    validation_markdown, validation_text,
};
pub use steps::{Step, StepGroup, steps};
pub use text::{text, text_within};
pub use uncertainty::{histogram, tornado, uncertainty_json, uncertainty_text, write_samples};
pub use units::Units;
pub use warnings::{message, warnings_text};

use case::{Fit, StiffnessSource};
use crash3::{EnergyBasis, Side};
use reconcile::Unknown;

fn basis_name(basis: EnergyBasis) -> &'static str {
    match basis {
        EnergyBasis::Dissipated => "dissipated",
        EnergyBasis::Absorbed => "absorbed",
    }
}

fn unknown_name(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::Speed1 => "vehicle1.speed",
        Unknown::Speed2 => "vehicle2.speed",
    }
}

/// Whether damage is laid off from the vehicle's axis, and not from beside its CG.
fn is_end(side: Side) -> bool {
    matches!(side, Side::Front | Side::Rear)
}

/// Where the middle of a damage without an offset lies.
fn undisplaced(side: Side) -> &'static str {
    if is_end(side) { "on the vehicle's axis" } else { "beside the centre of gravity" }
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::Front => "front",
        Side::Right => "right",
        Side::Rear => "rear",
        Side::Left => "left",
    }
}

/// Where a stiffness comes from, short enough for a column.
fn stiffness_source(source: StiffnessSource, side: Side) -> String {
    match source {
        StiffnessSource::Coefficients => "A and B as given".to_owned(),
        StiffnessSource::Roots => "d0 and d1 as given".to_owned(),
        StiffnessSource::Category(category) => {
            let side = match side {
                Side::Left | Side::Right => "side",
                Side::Front | Side::Rear => side_name(side),
            };
            format!("CRASH3 category {category}, {side}")
        }
        StiffnessSource::Test(Fit::Exact) => "barrier test, exact fit".to_owned(),
        StiffnessSource::Test(Fit::Mean) => "barrier test, mean crush".to_owned(),
        StiffnessSource::Zones => "zone by zone as given".to_owned(),
    }
}

/// What is in doubt of a stiffness from a table: of SAE 870045's Table 1 one digit.
fn stiffness_doubt(source: StiffnessSource, side: Side) -> Option<&'static str> {
    (source == StiffnessSource::Category(2) && side == Side::Rear).then_some(
        "G of category 2, rear, is in doubt: the scan of the table reads 1074 lb; 1874 lb is taken, as A²/2B = 1864 lb asks",
    )
}

/// The same with what is in doubt of it, where there is room.
fn stiffness_source_and_doubt(source: StiffnessSource, side: Side) -> String {
    let doubt = stiffness_doubt(source, side).map_or_else(String::new, |doubt| format!("; {doubt}"));
    stiffness_source(source, side) + &doubt
}
