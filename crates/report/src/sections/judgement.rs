//! A case judged without solving it: what was understood, what was assumed, and what it can be used for.

use analysis::{Ability, Failure, Judgement, OfImpact, SeenWarning};
use case::{Case, CaseFile, Faults, Purpose, UnitSystem};

use crate::PROGRAM;
use crate::document::{Block, Column, Document, Row, Table, Width};
use crate::pictures::drawn;
use crate::understood::{amount, choices, converted, message, shown, spread};
use crate::units::Units;
use crate::{understood, warnings, words};

/// The heading of the numbers of the file.
pub(crate) const NUMBERS: &str = "Numbers as understood";
/// The heading of the words of the file.
pub(crate) const CHOICES: &str = "Choices";
/// Heading of the assumptions: values that the file does not give.
pub(crate) const ASSUMED: &str = "Assumed, because the file does not say";
/// (columns) of usual keys.
const KEY: usize = 36;
/// (columns) of the values as written in the file.
const WRITTEN: usize = 22;
/// (columns) of a value.
const VALUE: usize = 14;

/// Every number of the file as written and in both unit systems, the choices, what was assumed, the commands
/// that the case has enough for, and the warnings, whose numbers are in the units of the reader.
#[must_use]
pub fn judgement(file: &CaseFile, judgement: &Judgement, units: Units) -> Document {
    let case = &file.case;
    let mut page = Document::of_case(case);
    page.paragraph("The case file is valid. It has been checked but not solved.");
    page.push(numbers(case));
    page.heading(CHOICES);
    page.push(Block::Entries(choices(case)));
    if !judgement.records.is_empty() {
        page.heading(super::recorder::WHICH);
        let verdict = |(key, one): &(String, OfImpact)| (key.clone(), super::recorder::verdict(one));
        page.push(Block::Entries(judgement.records.iter().map(verdict).collect()));
    }
    page.heading(ASSUMED);
    let assumed = judgement.assumptions.iter().map(|one| (one.key(), message(one, units)));
    if judgement.assumptions.is_empty() {
        page.paragraph("nothing");
    } else {
        page.push(Block::Entries(assumed.collect()));
    }
    page.push(commands(file, judgement));
    if let Some(purpose) = judgement.answers_most() {
        let can_estimate =
            |ability: &Ability| ability.purpose == Purpose::Estimate && ability.obstacle.is_none();
        let beside = if purpose != Purpose::Estimate && judgement.abilities.iter().any(can_estimate) {
            " `deltav estimate` also includes the errors of the method: report its intervals."
        } else {
            ""
        };
        page.paragraph(format!("`deltav {purpose}` makes the fullest use of what this case has.{beside}"));
    }
    if judgement.warnings.is_empty() {
        page.paragraph("No warnings (checks that need a solution were not run).");
    } else {
        let seen: Vec<SeenWarning> =
            judgement.warnings.iter().map(|warning| warning.seen(case.axes)).collect();
        page.push(warnings::block(&seen, units));
    }
    page
}

/// The command that evaluates recorders alone. It is not among the purposes of a case.
pub(crate) const RECORDER: &str = "recorder";

/// For a case with a table of a recorder, the faults by which that command cannot run: none if it can.
pub(crate) fn recorder_faults(case: &Case) -> Option<Option<Faults>> {
    case.has_recorder_table().then(|| match analysis::recorders(case) {
        Err(Failure::Case(faults)) => Some(faults),
        _ => None,
    })
}

/// The problems of faults, with what to write instead. Help that applies to both vehicles is given once,
/// after the last problem that it solves.
fn problems(file: &CaseFile, faults: &Faults) -> Vec<Row> {
    let diagnostics = file.diagnostics(faults, &PROGRAM);
    let problems: Vec<_> =
        diagnostics.list().iter().map(|one| (one.problem().to_string(), one.problem().help())).collect();
    let row = |(i, (problem, help)): (usize, &(String, Option<String>))| {
        let is_repeated = problems[i + 1..].iter().any(|(_, later)| later == help);
        let help = help.as_ref().filter(|_| !is_repeated).map(|help| format!("; {help}"));
        Row::Detail(format!("{problem}{}", help.unwrap_or_default()))
    };
    problems.iter().enumerate().map(row).collect()
}

fn commands(file: &CaseFile, judgement: &Judgement) -> Table {
    let columns = [Column::words("", KEY + 2), Column::words("", Width::Share)];
    let mut table = Table::new("Commands").columns(columns);
    for Ability { purpose, on, obstacle, left_aside } in &judgement.abilities {
        let drawn = if *purpose == Purpose::Draw { drawn(&file.case, judgement) } else { Vec::new() };
        let Some(obstacle) = obstacle.as_ref().filter(|_| drawn.is_empty()) else {
            let good_for = match drawn.as_slice() {
                [] => good_for(&file.case, *purpose),
                drawn => format!(" for --what {}", drawn.join(", ")),
            };
            table.row([purpose.to_string(), format!("has all that it needs{good_for}")]);
            let computes = !matches!(purpose, Purpose::Draw | Purpose::Motion);
            if computes && !left_aside.is_empty() {
                let keys = left_aside.join(", ");
                table.rows.push(Row::Detail(match purpose {
                    Purpose::Reconstruct => {
                        format!("its exact solution does not use {keys}, so it weighs all the evidence")
                    }
                    _ => format!("does not use {keys}"),
                }));
            }
            continue;
        };
        // It lacks the same data as another command, for which this was reported.
        let is_told = on != purpose
            && judgement
                .abilities
                .iter()
                .any(|other| other.purpose == *on && other.obstacle.as_ref() == Some(obstacle));
        if is_told {
            table.row([purpose.to_string(), format!("cannot run because {on} cannot")]);
            continue;
        }
        table.row([purpose.to_string(), "cannot run".to_owned()]);
        table.rows.extend(problems(file, obstacle));
    }
    match recorder_faults(&file.case) {
        Some(None) => table.row([RECORDER.to_owned(), "has all that it needs".to_owned()]),
        Some(Some(faults)) => {
            table.row([RECORDER.to_owned(), "cannot run".to_owned()]);
            table.rows.extend(problems(file, &faults));
        }
        None => {}
    }
    table
}

fn numbers(case: &Case) -> Table {
    let mut table = Table::new(NUMBERS).columns([
        Column::words("", Width::Fit(KEY)),
        Column::words("as written", Width::Fit(WRITTEN)),
        Column::words("SI", Width::Fit(VALUE)),
        Column::words("US", Width::Fit(0)),
    ]);
    let mut ranges = case.ranges.iter().peekable();
    for input in understood::numbers(case) {
        let spread = ranges.next_if(|range| range.path == input.path).map(spread);
        let amount = amount(input.number, input.unit);
        let written = match spread {
            None => amount,
            // A range that is too long for the column is below its number.
            Some(spread) if amount.chars().count() + spread.chars().count() + 2 > WRITTEN => {
                format!("{amount};\n{spread}")
            }
            Some(spread) => format!("{amount}; {spread}"),
        };
        let [si, us] = [UnitSystem::Si, UnitSystem::Us].map(|system| shown(converted(&input, system)));
        table.row([input.path, written, si, us]);
    }
    table
}

/// The use of a command that can run, in this case.
fn good_for(case: &Case, purpose: Purpose) -> String {
    match (&case.reconstruct, purpose) {
        (Some(reconstruct), Purpose::Reconstruct) => {
            format!(" to find {}", words::find_names(reconstruct.find))
        }
        (_, Purpose::Estimate) => match analysis::estimate_evidence(case) {
            Ok(keys) if !keys.is_empty() => format!("; the evidence: {}", keys.join(", ")),
            _ => "; but there is no evidence".to_owned(),
        },
        _ => String::new(),
    }
}
