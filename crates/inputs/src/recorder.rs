//! Recorder data, certain speeds and the assumptions of an estimate: `[vehicleN.recorder]`, `certain_speed`
//! and `[estimate]`. These numbers are compared with the impact and do not enter it, so no other analysis
//! varies them.

use std::fmt::Display;

use crate::quantity::{Quantity, format_number};
use crate::walk::{Key, Value, Walk};
use crate::words::word;

/// The data of a vehicle's event data recorder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recorder {
    /// (m/s) largest part of ΔV along the vehicle, positive forward.
    pub delta_v_longitudinal: Option<Quantity>,
    /// (m/s) largest part of ΔV across the vehicle, positive in the sense of the axes.
    pub delta_v_lateral: Option<Quantity>,
    /// (%) standard deviation of the error of ΔV.
    pub delta_v_error: Option<f64>,
    /// (rad) scale of the error of the direction of ΔV.
    pub direction_error: Option<Quantity>,
    /// (m/s) speed before the impact.
    pub speed: Option<Quantity>,
    /// (%) standard deviation of the error of that speed.
    pub speed_error: Option<f64>,
    /// (rad/s) yaw rate after the impact, in the sense of the axes.
    pub yaw_rate: Option<Quantity>,
    /// (rad/s) standard deviation of the error of that yaw rate.
    pub yaw_rate_error: Option<Quantity>,
}

/// Certain limits of the speed of a vehicle before the impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CertainSpeed {
    /// (m/s) it was not slower.
    pub at_least: Option<Quantity>,
    /// (m/s) it was not faster.
    pub at_most: Option<Quantity>,
}

/// The assumptions of an estimate before the evidence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GivenEstimate {
    /// The prior for the severity of the collision.
    pub prior: Prior,
    /// (m/s) median of √(ΔV₁ ΔV₂) before the evidence, in place of the median of the field.
    pub delta_v_median: Option<Quantity>,
    /// (%) standard deviation of the error of crush energies as measures of the energy absorbed in the
    /// impact, in place of the default for the method by which each was obtained.
    pub crush_error: Option<f64>,
    /// (%) average ratio of the crush energy to the energy absorbed in the impact, in place of the default
    /// for the method by which it was obtained.
    pub crush_bias: Option<f64>,
    /// (%) part of the error of a computed rest position that is proportional to the path length.
    pub rest_error: Option<f64>,
    /// (m) part of that error that even a short path has.
    pub rest_least_error: Option<Quantity>,
    /// (rad) error of a computed heading at rest.
    pub rest_heading_error: Option<Quantity>,
    /// (%) probability, before the evidence, that a vehicle of unknown speed stood still.
    pub stood: Option<f64>,
}

/// The severity of a collision before the evidence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Prior {
    /// `"field"`: like that of collisions after which a vehicle was towed.
    #[default]
    Field,
    /// `"flat"`: any speed is as likely as any other.
    Flat,
}

impl Prior {
    /// Each with its word.
    pub const WORDS: [(&str, Self); 2] = [("field", Self::Field), ("flat", Self::Flat)];

    /// Its word.
    #[must_use]
    pub fn name(self) -> &'static str {
        word(&Self::WORDS, &self)
    }
}

impl<U> Walk<'_, U> {
    fn exact_if(&mut self, path: &dyn Display, quantity: Option<&Quantity>) {
        if let Some(quantity) = quantity {
            self.exact(path, quantity);
        }
    }

    fn percent_if(&mut self, path: &dyn Display, percent: Option<f64>) {
        if let Some(percent) = percent {
            self.other(path, || Value::Text(format!("{} %", format_number(percent))));
        }
    }

    pub(crate) fn recorder(&mut self, table: &dyn Display, recorder: &Recorder) -> Recorder {
        let at = |key| Key(table, key);
        self.exact_if(&at("delta_v_longitudinal"), recorder.delta_v_longitudinal.as_ref());
        self.exact_if(&at("delta_v_lateral"), recorder.delta_v_lateral.as_ref());
        self.percent_if(&at("delta_v_error"), recorder.delta_v_error);
        self.exact_if(&at("direction_error"), recorder.direction_error.as_ref());
        self.exact_if(&at("speed"), recorder.speed.as_ref());
        self.percent_if(&at("speed_error"), recorder.speed_error);
        self.exact_if(&at("yaw_rate"), recorder.yaw_rate.as_ref());
        self.exact_if(&at("yaw_rate_error"), recorder.yaw_rate_error.as_ref());
        *recorder
    }

    pub(crate) fn certain_speed(&mut self, table: &dyn Display, certain: &CertainSpeed) -> CertainSpeed {
        self.exact_if(&Key(table, "at_least"), certain.at_least.as_ref());
        self.exact_if(&Key(table, "at_most"), certain.at_most.as_ref());
        *certain
    }

    pub(crate) fn estimate(&mut self, estimate: &GivenEstimate) -> GivenEstimate {
        self.choice(&"estimate.prior", &Prior::WORDS, estimate.prior);
        self.exact_if(&"estimate.delta_v_median", estimate.delta_v_median.as_ref());
        self.percent_if(&"estimate.crush_error", estimate.crush_error);
        self.percent_if(&"estimate.crush_bias", estimate.crush_bias);
        self.percent_if(&"estimate.rest_error", estimate.rest_error);
        self.exact_if(&"estimate.rest_least_error", estimate.rest_least_error.as_ref());
        self.exact_if(&"estimate.rest_heading_error", estimate.rest_heading_error.as_ref());
        self.percent_if(&"estimate.stood", estimate.stood);
        *estimate
    }
}
