//! Ranges of the assumptions about a recorder.

/// An assumption about a recorder that is not in its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{name} of the recorder is {value}: write a number from {least} to {greatest}")]
pub struct AssumptionOutOfRange {
    /// The name of the field.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
}

/// Checks that each value lies in its range. The error is the first that does not, by the name of its field.
pub(crate) fn in_ranges(fields: &[(&'static str, f64, [f64; 2])]) -> Result<(), AssumptionOutOfRange> {
    let is_out = |(_, value, [least, greatest]): &&(_, f64, [f64; 2])| !(*least..=*greatest).contains(value);
    match fields.iter().find(is_out) {
        Some(&(name, value, [least, greatest])) => Err(AssumptionOutOfRange { name, value, least, greatest }),
        None => Ok(()),
    }
}
