//! The faults of a case, by key.

use std::error::Error;
use std::fmt::{self, Display};

use crate::purpose::Purpose;

/// One key that a case lacks, or whose value is impossible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Path of the key or the table, such as `vehicle1.crush.width`; empty for the case as
    /// a whole.
    pub key: String,
    /// What is wrong with it.
    pub kind: FaultKind,
    /// What to give instead, as a sentence without its full stop.
    pub advice: Option<String>,
}

/// What is wrong with a key.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FaultKind {
    /// It is missing.
    Missing {
        /// The purpose that needs it.
        needed_for: Purpose,
    },
    /// The speeds of both vehicles are missing, and no more than one can be found.
    NoSpeed,
    /// The engine refuses its value.
    Refused {
        /// The engine's reason.
        reason: String,
    },
    /// No number of the case is a range or, with the key `avoid`, none outside of that table.
    NothingUncertain,
}

impl Fault {
    /// A value that is refused, with the reason and what to give instead.
    #[must_use]
    pub fn refused(key: impl Display, reason: impl Display, advice: impl Display) -> Self {
        let kind = FaultKind::Refused { reason: reason.to_string() };
        Self { key: key.to_string(), kind, advice: Some(advice.to_string()) }
    }

    /// Whether a reconstruction or an impact lacks a speed that it takes as known.
    #[must_use]
    pub fn lacks_speed(&self) -> bool {
        match self.kind {
            FaultKind::Missing { needed_for } => {
                matches!(needed_for, Purpose::Reconstruct | Purpose::Impact) && self.key.ends_with(".speed")
            }
            FaultKind::NoSpeed => true,
            FaultKind::Refused { .. } | FaultKind::NothingUncertain => false,
        }
    }

    /// Whether a reconstruction lacks data on how a vehicle left the impact.
    #[must_use]
    pub fn lacks_departure(&self) -> bool {
        matches!(self.kind, FaultKind::Missing { needed_for: Purpose::Reconstruct })
            && self.key.ends_with(".after.rest")
    }

    /// The fault in one sentence. `name` gives the reader's name of a purpose, for example the command of a
    /// program.
    #[must_use]
    pub fn message(&self, name: impl Fn(Purpose) -> String) -> String {
        match &self.kind {
            FaultKind::Missing { needed_for } => {
                format!("`{}` is missing: {} needs it", self.key, name(*needed_for))
            }
            FaultKind::NoSpeed => format!(
                "`vehicle1.speed` and `vehicle2.speed` are missing: {} needs one of them and finds the other",
                name(Purpose::Reconstruct)
            ),
            FaultKind::Refused { reason } => reason.clone(),
            FaultKind::NothingUncertain if self.key == "avoid" => {
                "no number outside of [avoid] is a range, so nothing is uncertain".to_owned()
            }
            FaultKind::NothingUncertain => {
                "no number of this case is a range, so nothing is uncertain".to_owned()
            }
        }
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.message(|purpose| format!("`{purpose}`"));
        match &self.kind {
            FaultKind::Refused { .. } if !self.key.is_empty() => write!(f, "`{}`: {message}", self.key),
            _ => f.write_str(&message),
        }
    }
}

/// All faults that prevent an analysis: at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults {
    list: Vec<Fault>,
}

impl Faults {
    /// Turns the faults of a check into a result.
    ///
    /// # Errors
    ///
    /// The faults, if there are any.
    pub fn none_of(list: Vec<Fault>) -> Result<(), Self> {
        if list.is_empty() { Ok(()) } else { Err(Self { list }) }
    }

    /// The same faults, with `purpose` as the one that needs the missing values through another analysis.
    #[must_use]
    pub fn needed_for(mut self, purpose: Purpose) -> Self {
        for fault in &mut self.list {
            if let FaultKind::Missing { needed_for } = &mut fault.kind {
                *needed_for = purpose;
            }
        }
        self
    }

    /// The faults, in the order in which they were found.
    #[must_use]
    pub fn list(&self) -> &[Fault] {
        &self.list
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Self { list: vec![fault] }
    }
}

impl Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, fault) in self.list.iter().enumerate() {
            if index > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{fault}")?;
            if let Some(advice) = &fault.advice {
                write!(f, "; {advice}")?;
            }
        }
        Ok(())
    }
}

impl Error for Faults {}
