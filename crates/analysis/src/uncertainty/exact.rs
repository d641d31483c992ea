//! The numbers of a case that all samples share: their errors are not in the intervals.

use inputs::{
    BrachTangential, Case, ContactSpread, EstimatedInput, FaceAxis, ImpactLaw, Input, Origin, SharedEffects,
};
use pim_core::VehicleId;
use real::Gradient;

use super::UncertainInput;

/// A value that all samples share.
#[derive(Clone, Debug, PartialEq)]
pub struct TakenAsExact {
    /// Its key, such as `vehicle1.crush.depths`; for an estimate, the key of the estimated value.
    pub key: String,
    /// The value.
    pub value: ExactValue,
}

/// The kind of a value that all samples share.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactValue {
    /// A number, or the numbers of a list that are not ranges.
    Numbers(Vec<Input>),
    /// A value from a table or a formula.
    Estimate(EstimatedInput),
    /// A choice, as a word.
    Word(&'static str),
}

/// Every number of a case that is neither among the uncertain `inputs` nor has a shared error, and that
/// affects the results according to their derivatives; the numbers of a list together.
pub(super) fn taken_as_exact(
    case: &Case,
    inputs: &[UncertainInput],
    gradients: &[Gradient],
) -> Vec<TakenAsExact> {
    let shared = SharedEffects::of(case);
    let mut uncertain = inputs.iter().map(|input| &input.input.path).peekable();
    // A list affects the results if one of its numbers does.
    let mut lists: Vec<(String, ExactValue, bool)> = Vec::new();
    for (place, input) in case.variables().into_iter().enumerate() {
        if uncertain.next_if(|path| **path == input.path).is_some() || shared.cover(place) {
            continue;
        }
        if is_covered_by_contact(case, &input) {
            continue;
        }
        let key = match input.origin {
            Origin::Given => input.path.split('[').next().unwrap_or_default().to_owned(),
            // Its error is that of the numbers that determine it.
            Origin::Estimate(EstimatedInput::Contact { vehicle, axis })
                if case.contact_spread(vehicle, axis) == ContactSpread::OfInputs =>
            {
                continue;
            }
            Origin::Estimate(estimate) => estimate.key(),
            Origin::Shared(_) => continue,
        };
        // A friction limit that is not reached affects the results too.
        let has_part =
            key.starts_with("impact.") || gradients.iter().any(|gradient| gradient.by[place] != 0.0);
        match (lists.last_mut(), input.origin) {
            // A point is one value, even if it may move in two directions.
            (Some((last, ExactValue::Estimate(_), point_has_part)), _) if *last == key => {
                *point_has_part |= has_part;
            }
            (_, Origin::Estimate(estimate)) => lists.push((key, ExactValue::Estimate(estimate), has_part)),
            (Some((last, ExactValue::Numbers(numbers), list_has_part)), _) if *last == key => {
                numbers.push(input);
                *list_has_part |= has_part;
            }
            _ => lists.push((key, ExactValue::Numbers(vec![input]), has_part)),
        }
    }
    lists.retain(|(_, _, has_part)| *has_part);
    let mut exact: Vec<TakenAsExact> =
        lists.into_iter().map(|(key, value, _)| TakenAsExact { key, value }).collect();
    if let Some(ImpactLaw::Brach { tangential: BrachTangential::Critical, .. }) =
        case.impact.as_ref().map(|impact| &impact.law)
    {
        exact.push(TakenAsExact { key: "impact.tangential".to_owned(), value: ExactValue::Word("critical") });
    }
    exact
}

/// Whether a number is the offset of a damage at which the contact point was placed: the error of the point
/// is that of the offset, which affects nothing else.
fn is_covered_by_contact(case: &Case, input: &Input) -> bool {
    VehicleId::ALL.into_iter().any(|vehicle| {
        case.vehicles[vehicle.index()].places_contact()
            && input.path == format!("vehicle{vehicle}.crush.offset")
            && matches!(case.contact_spread(vehicle, FaceAxis::Along), ContactSpread::Default(_))
    })
}
