//! Results as data for programs: JSON in SI units and radians, CSV, samples. No sentence for people is
//! written here.

pub(crate) mod comparison;
pub(crate) mod csv;
pub(crate) mod json;
pub(crate) mod judgement;
pub(crate) mod samples;
pub(crate) mod sensitivity;
pub(crate) mod topics;
pub(crate) mod uncertainty;
pub(crate) mod validation;
