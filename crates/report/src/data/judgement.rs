//! A case judged without solving it, as JSON.

use analysis::{Ability, Judgement};
use case::{CaseFile, Faults, Purpose, Unit, UnitSystem};
use serde::Serialize;
use serde_json::Value;

use super::json::WarningBlock;
use super::recorder::which;
use super::{identified, pretty, title};
use crate::PROGRAM;
use crate::pictures::drawn;
use crate::sections::judgement::{RECORDER, recorder_faults};
use crate::understood::{choices, converted, message, numbers, spread};
use crate::units::Units;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// The axes of all signed values: `z-up` or `z-down`.
    axes: &'static str,
    commands: Vec<CommandBlock>,
    /// The command that uses most of the data of the case.
    answers_most: Option<&'static str>,
    inputs: Vec<InputBlock>,
    choices: Vec<ChoiceBlock>,
    /// If a vehicle has several records, or one that is probably not of this impact.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    records: Vec<Value>,
    assumptions: Vec<AssumptionBlock>,
    warnings: Vec<WarningBlock>,
}

#[derive(Serialize)]
struct CommandBlock {
    command: &'static str,
    runs: bool,
    obstacles: Vec<String>,
    /// Keys of evidence that its exact answer does not use.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_aside: Vec<String>,
    /// For `draw`: what can be drawn, by the values of its option `--what`.
    #[serde(skip_serializing_if = "Option::is_none")]
    draws: Option<Vec<&'static str>>,
}

#[derive(Serialize)]
struct InputBlock {
    path: String,
    number: f64,
    unit: Option<&'static str>,
    si: f64,
    si_unit: Option<&'static str>,
    us: f64,
    us_unit: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<String>,
}

#[derive(Serialize)]
struct ChoiceBlock {
    path: String,
    value: String,
}

#[derive(Serialize)]
struct AssumptionBlock {
    key: String,
    message: String,
}

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
    let of_recorder = recorder_faults(case).map(|faults| CommandBlock {
        command: RECORDER,
        runs: faults.is_none(),
        obstacles: faults.as_ref().map(problems).unwrap_or_default(),
        draws: None,
        left_aside: Vec::new(),
    });
    let document = Document {
        title: title(case),
        axes: case.axes.name(),
        commands: judgement
            .abilities
            .iter()
            .map(|Ability { purpose, obstacle, left_aside, .. }| {
                // If something can be drawn, data missing for other drawings are not an obstacle.
                let draws = (*purpose == Purpose::Draw).then(|| drawn(case, judgement));
                let obstacle =
                    obstacle.as_ref().filter(|_| draws.as_ref().is_none_or(|draws| draws.is_empty()));
                CommandBlock {
                    command: purpose.name(),
                    runs: obstacle.is_none(),
                    obstacles: obstacle.map(problems).unwrap_or_default(),
                    draws,
                    left_aside: left_aside.clone(),
                }
            })
            .chain(of_recorder)
            .collect(),
        answers_most: judgement.answers_most().map(Purpose::name),
        inputs: numbers(case)
            .into_iter()
            .map(|input| {
                let (us, us_unit) = converted(&input, UnitSystem::Us);
                InputBlock {
                    number: input.number,
                    unit: input.unit.map(Unit::spelling),
                    si: input.si(),
                    si_unit: input.unit.map(|unit| unit.dimension().si_unit()),
                    us,
                    us_unit: us_unit.map(Unit::spelling),
                    range: ranges.next_if(|range| range.path == input.path).map(spread),
                    path: input.path,
                }
            })
            .collect(),
        choices: choices(case).into_iter().map(|(path, value)| ChoiceBlock { path, value }).collect(),
        records: judgement.records.iter().map(|(key, found)| which(key, found)).collect(),
        assumptions: judgement
            .assumptions
            .iter()
            .map(|assumption| AssumptionBlock {
                key: assumption.key(),
                message: message(assumption, Units::Si),
            })
            .collect(),
        warnings: judgement
            .warnings
            .iter()
            .map(|warning| WarningBlock::new(&warning.seen(case.axes)))
            .collect(),
    };
    pretty(&identified(file, document))
}
