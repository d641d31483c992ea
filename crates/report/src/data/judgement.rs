//! A case judged without solving it, as JSON.

use analysis::{Ability, Judgement};
use case::{CaseFile, Faults, Input, Purpose, Unit, UnitSystem};
use serde_json::json;

use super::json::warning;
use super::recorder::which;
use super::{followed, identified, list, object, pretty, title};
use crate::PROGRAM;
use crate::pictures::drawn;
use crate::sections::judgement::{RECORDER, recorder_faults};
use crate::understood::{choices, converted, message, numbers, spread};
use crate::units::Units;

/// The judgement as indented JSON, ending in a line break: `commands`, `inputs` (as written, in SI and in US
/// units), `choices`, `assumptions` and `warnings`. SI units here are those with the factor 1: m, kg, N, rad.
///
/// # Errors
/// If serialisation fails, which no judgement causes.
pub fn judgement_json(file: &CaseFile, judgement: &Judgement) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let mut ranges = case.ranges.iter().peekable();
    let problems = |faults: &Faults| -> Vec<String> {
        let diagnostics = file.diagnostics(faults, &PROGRAM);
        diagnostics.list().iter().map(|one| one.problem().to_string()).collect()
    };
    let command = |name: &str, obstacle: Option<&Faults>, left_aside: &[String]| {
        object! {
            "command": name,
            "runs": obstacle.is_none(),
            "obstacles": obstacle.map(problems).unwrap_or_default(),
            // Keys of evidence that its exact answer does not use.
            "left_aside"?: left_aside,
        }
    };
    let of_ability = |Ability { purpose, obstacle, left_aside, .. }: &Ability| {
        if *purpose != Purpose::Draw {
            return command(purpose.name(), obstacle.as_ref(), left_aside);
        }
        // If something can be drawn, data missing for other drawings are not an obstacle. `draws` has values
        // of the option `--what`.
        let draws = drawn(case, judgement);
        let obstacle = obstacle.as_ref().filter(|_| draws.is_empty());
        followed(command(purpose.name(), obstacle, left_aside), json!({ "draws": draws }))
    };
    let of_recorder = recorder_faults(case).map(|faults| command(RECORDER, faults.as_ref(), &[]));
    let input = |input: Input| {
        let (us, us_unit) = converted(&input, UnitSystem::Us);
        object! {
            "path": input.path,
            "number": input.number,
            "unit": input.unit.map(Unit::spelling),
            "si": input.si(),
            "si_unit": input.unit.map(|unit| unit.dimension().si_unit()),
            "us": us,
            "us_unit": us_unit.map(Unit::spelling),
            "range"?: ranges.next_if(|range| range.path == input.path).map(spread),
        }
    };
    let document = object! {
        "title": title(case),
        // The axes of all signed values: `z-up` or `z-down`.
        "axes": case.axes.name(),
        "commands": judgement.abilities.iter().map(of_ability).chain(of_recorder).collect::<Vec<_>>(),
        // The command that uses most of the data of the case.
        "answers_most": judgement.answers_most().map(Purpose::name),
        "inputs": list(numbers(case), input),
        "choices": list(choices(case), |(path, value)| json!({ "path": path, "value": value })),
        // If a vehicle has several records, or one that is probably not of this impact.
        "records"?: list(&judgement.records, |(key, found)| which(key, found)),
        "assumptions": list(&judgement.assumptions, |assumption| json!({
            "key": assumption.key(),
            "message": message(assumption, Units::Si),
        })),
        "warnings": list(&judgement.warnings, |one| warning(&one.seen(case.axes))),
    };
    pretty(&identified(file, document))
}
