//! A finished analysis in words, as data and as drawings; and the program's own validation.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let file = case::CaseFile::parse("sae-980025.toml", case::EXAMPLE)?;
//! let analysis = analysis::reconstruct(&file.case)?;
//! let text = report::results(&file.case, &analysis, report::Units::Us).text();
//! assert!(text.contains("75.03 ft/s")); // SAE 980025: 75 ft/s
//! let json = report::json(&file, &analysis)?;
//! assert!(json.contains("\"admissible_roots\": 1"));
//! # Ok(())
//! # }
//! ```
//!
//! The output of a command is a [`Document`], which writes itself as text, as Markdown and as HTML:
//! [`results`], where every figure names its equation; [`handover`], the report to hand over, with the
//! [`steps`] (every result with its equation and the numbers in it), all drawings and the case file;
//! [`comparison`], [`sensitivity`], [`uncertainty()`], [`estimate()`], [`judgement`] and [`validation()`];
//! [`warnings`] alone; [`explanation`] of a term, symbol, key or warning, from glossary.md.
//!
//! Programs get the same as data in SI units and radians, with stable keys: [`json`], [`comparison_json`] and
//! so on. For many cases, [`Csv`] writes one line each for a spreadsheet, and [`jsonl_row`] one line each for
//! a program; [`write_samples`] writes the samples of an uncertainty.
//!
//! [`message`] is the sentence of a warning and [`no_answer`] that of a case without an answer. All use the
//! [`Axes`](case::Axes) of the case, which each document names, and the [`Units`] of the reader. Results are
//! converted to other units here and nowhere else.
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
//! [`drawing`](drawing()) draws a [`Subject`]: the scene and the damage to scale, the reconciliation, the
//! energy. A [`Drawing`] is SVG, PNG or PDF; the crate `drawing` makes all of them.
//!
//! [`histogram`] and [`tornado`] plot an uncertainty, [`density`] a result of an estimate,
//! [`estimate_pictures`] its speeds and rests one below the other, [`computed_against_measured`] and
//! [`reconstructed_speed`] the validation, [`estimated_against_recorded`] and [`ranks_of_recorders`] the
//! judgement by recorders.
//!
//! [`live`] puts a report into the page of the program, in which its reader can change a number.
//!
//! `examples/text_and_drawing.rs` goes from a file to a text and a drawing.
//!
//! # What it does not do
//!
//! It computes nothing that is not in the analysis, except for the intermediate sums of a step. It uses no
//! terminal and no files.
//!
//! # Inside
//!
//! `sections` fill a `document` with `words`, numbers in `units` and drawings; `writers` write it. `data` is
//! for programs. No arrow points back.

mod axes;
mod basis;
mod checks;
mod data;
mod document;
mod energy;
mod estimates;
mod failures;
mod glossary;
mod law;
mod live;
mod outputs;
mod pictures;
mod sections;
mod steps;
mod understood;
mod units;
mod warnings;
mod words;
mod worth;
mod writers;

pub use ::drawing::{
    Drawing, PictureFormat, PlanBody, PlanStation, PlanView, SitePlan, SitePlanError, Viewport,
};
pub use data::avoid::avoid_json;
pub use data::claims::claims_json;
pub use data::comparison::comparison_json;
pub use data::csv::{Csv, CsvStyle, Refused, Row, RowAnswer, RowError, Table, jsonl_row, no_formula};
pub use data::estimate::{DrawColumn, draw_columns, estimate_json, write_draws};
pub use data::field::{FieldData, FieldYear, field_json};
pub use data::headline::led_by;
pub use data::json::{json, weighed_json};
pub use data::judged_recorders::judged_recorders_json;
pub use data::judgement::judgement_json;
pub use data::recorder::{recorders_json, write_records};
pub use data::samples::write_samples;
pub use data::sensitivity::sensitivity_json;
pub use data::sha256;
pub use data::topics::{topic_json, topics_json};
pub use data::uncertainty::uncertainty_json;
pub use data::validation::validation_json;
pub use document::Document;
pub use estimates::{Asked, Question};
pub use failures::no_answer;
pub use glossary::{Topic, UnknownTopic, topic, topics};
pub use live::{NotLive, live};
pub use outputs::reason_name;
pub use pictures::{
    AvoidPicture, DrawingError, DrawingRequest, Frames, Subject, computed_against_measured, density, drawing,
    estimate_pictures, estimated_against_recorded, frames, histogram, place_of_impact, plan_view,
    ranks_of_recorders, reconstructed_speed, site_plan, site_plan_of, tornado,
};
pub use sections::avoid::{avoid, avoid_warnings};
pub use sections::claims::claims;
pub use sections::comparison::comparison;
pub use sections::estimate::estimate;
pub use sections::field::field;
pub use sections::handover::{Supplements, handover, uncertain_headline};
pub use sections::headline::ExactSolution;
pub use sections::judged_recorders::judged_recorders;
pub use sections::judgement::judgement;
pub use sections::recorder::recorders;
pub use sections::results::{results, weighed};
pub use sections::sensitivity::sensitivity;
pub use sections::topics::{explanation, list_of_topics};
pub use sections::uncertainty::uncertainty;
pub use sections::validation::{both_speeds_headline, validation, validation_headline};
pub use steps::{Step, StepGroup, steps};
pub use units::{Measure, Units};
pub use warnings::{message, warnings};
pub use words::PROGRAM;
