//! The document of each command.

pub(crate) mod avoid;
mod chosen;
pub(crate) mod claims;
pub(crate) mod comparison;
pub(crate) mod estimate;
pub(crate) mod field;
pub(crate) mod handover;
pub(crate) mod headline;
pub(crate) mod judged_recorders;
pub(crate) mod judgement;
pub(crate) mod motion;
pub(crate) mod recorder;
pub(crate) mod results;
pub(crate) mod sensitivity;
pub(crate) mod topics;
pub(crate) mod uncertainty;
pub(crate) mod validation;
