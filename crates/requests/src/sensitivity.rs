//! How much the answer depends on each input.

use analysis::Sweep;
use serde::Serialize;

use crate::options::{OptionError, RequestOptions};

/// The directions of the sweep of the PDOF.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensitivityOptions {
    /// (degrees) from one direction to the next.
    pub pdof_step: f64,
    /// Number of steps to each side.
    pub pdof_steps: u32,
}

impl Default for SensitivityOptions {
    fn default() -> Self {
        Self { pdof_step: 5.0, pdof_steps: 2 }
    }
}

impl SensitivityOptions {
    /// Maximum number of steps to each side.
    pub const MOST_STEPS: u32 = 180;

    /// Checks a step of the sweep (degrees).
    ///
    /// # Errors
    /// What to give instead.
    pub fn check_step(degrees: f64) -> Result<f64, String> {
        let can_be = degrees > 0.0 && degrees <= 180.0;
        if can_be { Ok(degrees) } else { Err("give degrees above 0 and up to 180, such as 5".to_owned()) }
    }

    pub(crate) fn check(&self) -> Result<(), OptionError> {
        let Self { pdof_step, pdof_steps } = self;
        if let Err(advice) = Self::check_step(*pdof_step) {
            return Err(OptionError::Value { option: "pdof_step", given: pdof_step.to_string(), advice });
        }
        if *pdof_steps > Self::MOST_STEPS {
            let advice = format!("give a whole number from 0 to {}", Self::MOST_STEPS);
            return Err(OptionError::Value { option: "pdof_steps", given: pdof_steps.to_string(), advice });
        }
        Ok(())
    }

    pub(crate) fn read(options: &RequestOptions) -> Result<Self, OptionError> {
        let default = Self::default();
        let steps = options.count("pdof_steps")?.map(|steps| u32::try_from(steps).unwrap_or(u32::MAX));
        Ok(Self {
            pdof_step: options.number("pdof_step")?.unwrap_or(default.pdof_step),
            pdof_steps: steps.unwrap_or(default.pdof_steps),
        })
    }

    pub(crate) fn sweep(&self) -> Sweep {
        Sweep { step: self.pdof_step.to_radians(), steps: self.pdof_steps }
    }
}
