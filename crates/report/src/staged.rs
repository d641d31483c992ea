//! The comparison with the RICSAC collisions as text, JSON, Markdown and plots.

mod json;
mod layout;
mod page;
mod plot;

pub use json::validation_json;
pub use plot::{computed_against_measured, reconstructed_speed};

use validation::Validation;

/// The comparison as text of at most 98 columns.
#[must_use]
pub fn validation_text(validation: &Validation) -> String {
    layout::text(&page::page(validation))
}

/// The comparison as a Markdown page: `docs/validation.md`.
#[must_use]
pub fn validation_markdown(validation: &Validation) -> String {
    layout::markdown(&page::page(validation))
}

/// How far reconstructed speeds are from true ones, and why: the paragraph that stands in the README.
#[must_use]
pub fn validation_headline(validation: &Validation) -> String {
    page::headline(validation)
}
