//! The sliders of avoidability: the speed to ask about, and the reaction time.

use analysis::{AvoidPlan, Avoidance};
use case::{CaseFile, Dimension, Quantity};
use report::Document;
use serde_json::{Value, json};

use crate::answer::charts;
use crate::drag::Change;
use crate::given::{Given, Refused};

/// (s) the upper end of a slider for the reaction time, unless the case has more, and its step.
const LONGEST: f64 = 3.0;
const REACTION_STEP: f64 = 0.05;
/// (m/s) units of less than this have steps of one, others of a tenth.
const SMALL_UNIT: f64 = 0.6;
/// (decimals) of a number that a slider writes, and of the ends of a range.
const DECIMALS: u32 = 3;
const DECIMALS_OF_RANGE: u32 = 2;

/// A number that a slider moves, with its places in the unit of the case.
struct Slider {
    key: &'static str,
    dimension: Dimension,
    quantity: Quantity,
    least: f64,
    most: f64,
    step: f64,
    is_range: bool,
}

impl Slider {
    /// Both sliders: the speed goes up to that driven.
    fn both(file: &CaseFile, found: &Avoidance) -> Vec<Self> {
        let Some(given) = &file.case.avoid else { return Vec::new() };
        let of = |key, dimension, sourced: &Option<case::Sourced>, most: f64| {
            Some(Self::of(file, key, dimension, sourced.as_ref()?.quantity, most))
        };
        let driven = found.scene.speed;
        let sliders = [
            of("avoid.limit", Dimension::Speed, &given.limit, driven),
            of("avoid.reaction_time", Dimension::Time, &given.reaction_time, LONGEST),
        ];
        sliders.into_iter().flatten().collect()
    }

    /// `most` (SI) is raised to the number of the case if that is greater.
    fn of(file: &CaseFile, key: &'static str, dimension: Dimension, quantity: Quantity, most: f64) -> Self {
        let factor = quantity.unit().factor();
        let step = match dimension {
            Dimension::Speed if factor < SMALL_UNIT => 1.0,
            Dimension::Speed => 0.1,
            _ => REACTION_STEP / factor,
        };
        let value = quantity.si() / factor;
        let low = Change::of(file.clone()).quantity(&format!("{key}.low"), dimension);
        // The lower end of a range stays above zero.
        let below = low.as_ref().map_or(value, |low| low.si() / factor);
        let down = (below / step - 1e-9).ceil() - 1.0;
        let up = ((most / factor - value) / step + 1e-9).floor().max(0.0);
        Self {
            key,
            dimension,
            quantity,
            least: value - down.max(0.0) * step,
            most: value + up * step,
            step,
            is_range: low.is_some(),
        }
    }

    fn json(&self) -> Value {
        let unit = self.quantity.unit();
        json!({
            "key": self.key,
            "unit": unit.to_string(),
            "value": self.quantity.si() / unit.factor(),
            "least": self.least,
            "most": self.most,
            "step": self.step,
        })
    }

    /// Gives the key a value in its unit; a value that it already has leaves the text unchanged.
    fn put(&self, change: &mut Change, value: f64) -> Result<(), Refused> {
        let factor = self.quantity.unit().factor();
        if (value * factor - self.quantity.si()).abs() <= 1e-9 * self.step * factor {
            return Ok(());
        }
        let least = if self.is_range { DECIMALS_OF_RANGE } else { 0 };
        let is_whole = |number: f64| (number - number.round()).abs() < 1e-6;
        let shift = |decimals: u32| f64::from(10_u32.pow(decimals));
        let mut needed = (least..=DECIMALS).filter(|decimals| is_whole(value * shift(*decimals)));
        let step = 1.0 / shift(needed.next().unwrap_or(DECIMALS));
        change.put(self.key, value * factor, self.dimension, step * factor)
    }
}

/// The sliders of an answer: `[{ key, unit, value, least, most, step }]`.
pub(crate) fn sliders(file: &CaseFile, found: &Avoidance) -> Vec<Value> {
    Slider::both(file, found).iter().map(Slider::json).collect()
}

/// The answer with its sliders moved to `{ key: value }`, and the text that has it; with a probability where
/// that is `sampled`.
pub(crate) fn moved(given: &Given, found: &Avoidance, to: &str, sampled: bool) -> Result<Value, Refused> {
    let to: Value = serde_json::from_str(to).unwrap_or_default();
    let mut change = Change::of(given.file.clone());
    for slider in Slider::both(&given.file, found) {
        if let Some(value) = to.get(slider.key).and_then(Value::as_f64) {
            slider.put(&mut change, value)?;
        }
    }
    let moved = Given { file: change.file, units: given.units };
    let plan = sampled.then(AvoidPlan::default);
    let found = moved.answered(found.again(&moved.file.case, plan.as_ref()))?;
    let document: Document = report::avoid(&moved.file.case, &found, moved.units);
    Ok(json!({
        "ok": true,
        "text": moved.file.source.text(),
        "headline": document.headline(),
        "html": document.html_fragment(),
        "charts": charts(&document),
    }))
}
