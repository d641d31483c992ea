//! A finished analysis as text for people, as JSON for programs, as a report to hand over and as drawings; and the program's own validation.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! let analysis = analysis::reconstruct(&file.case)?;
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
//! # let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! # let analysis = analysis::reconstruct(&file.case)?;
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
//! symbol, key and warning, from glossary.md.
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
mod words;
mod wrap;

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
pub use words::PROGRAM;
