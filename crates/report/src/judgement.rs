//! A case judged without solving it: what was understood, what was assumed, and what it can be used for.

use analysis::{Ability, Assumption, Judgement, Warning};
use case::{
    BrachTangential, Case, CaseFile, Dimension, Fit, ImpactLaw, Input, Pdof, Purpose, Range, Spread,
    StiffnessForm, StiffnessSource, Unit, UnitSystem, word,
};
use crash3::ObliqueCorrection;
use serde::Serialize;

use crate::json::WarningBlock;
use crate::units::{Quantity, Units, significant};
use crate::warnings;
use crate::words;
use crate::wrap::{LINE, first_cell, hanging};
use crate::{PROGRAM, Subject};

/// Over what the file says in words.
pub(crate) const CHOICES: &str = "Choices";
/// Over what stands in for what it does not say.
pub(crate) const ASSUMED: &str = "Assumed, since the file does not say it";
/// Width of the first column: the longest of the keys that are usual.
const KEY: usize = 38;
/// Width of the column of what the file says.
const WRITTEN: usize = 26;
/// Width of a column of values.
const VALUE: usize = 17;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// Those of all signed values: `z-up` or `z-down`.
    axes: &'static str,
    commands: Vec<CommandBlock>,
    inputs: Vec<InputBlock>,
    choices: Vec<ChoiceBlock>,
    assumptions: Vec<AssumptionBlock>,
    warnings: Vec<WarningBlock>,
}

#[derive(Serialize)]
struct CommandBlock {
    command: &'static str,
    runs: bool,
    obstacles: Vec<String>,
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

/// The judgement as text: every number of the file as written and in both unit systems, the choices, what was assumed, the commands that the case has
/// enough for, and the warnings, whose numbers are in the units of the reader.
#[must_use]
pub fn judgement_text(file: &CaseFile, judgement: &Judgement, units: Units) -> String {
    let case = &file.case;
    let mut text = String::new();
    let mut line = |line: &str| {
        text.push_str(line.trim_end());
        text.push('\n');
    };
    line(case.title.as_deref().unwrap_or("Untitled case"));
    if let Some(source) = &case.source {
        line(&format!("Source: {source}"));
    }
    line("");
    line("The file reads without an error. It was judged, not solved.");

    line("");
    numbers(case).iter().for_each(|row| line(row));
    line("");
    line(CHOICES);
    line(&"─".repeat(LINE));
    for (path, value) in choices(case) {
        line(&format!("{path:<KEY$}{value}"));
    }
    line("");
    line(ASSUMED);
    line(&"─".repeat(LINE));
    for assumption in &judgement.assumptions {
        let key = format!("{:<width$} ", assumption.key(), width = KEY - 1);
        text.push_str(&hanging(&key, &message(assumption, units)));
    }
    if judgement.assumptions.is_empty() {
        text.push_str("nothing\n");
    }
    text.push_str(&format!("\nCommands\n{}\n", "─".repeat(LINE)));
    for Ability { purpose, on, obstacle } in &judgement.abilities {
        let Some(obstacle) = obstacle else {
            let does = format!("has all that it needs{}", good_for(case, *purpose, *on));
            text.push_str(&hanging(&format!("{purpose:<KEY$}"), &does));
            continue;
        };
        // It lacks what another lacks, which was told there.
        let is_told = on != purpose
            && judgement
                .abilities
                .iter()
                .any(|other| other.purpose == *on && other.obstacle.as_ref() == Some(obstacle));
        if is_told {
            text.push_str(&format!("{purpose:<KEY$}cannot run, as {on} cannot\n"));
            continue;
        }
        text.push_str(&format!("{purpose:<KEY$}cannot run\n"));
        // What helps with both vehicles is said once, after the last that it helps with.
        let problems: Vec<_> = file
            .diagnostics(obstacle, &PROGRAM)
            .list()
            .iter()
            .map(|one| (one.problem().to_string(), one.problem().help()))
            .collect();
        for (i, (problem, help)) in problems.iter().enumerate() {
            let is_repeated = problems[i + 1..].iter().any(|(_, later)| later == help);
            let help = help.as_ref().filter(|_| !is_repeated).map(|help| format!("; {help}"));
            text.push_str(&hanging("    ", &format!("{problem}{}", help.unwrap_or_default())));
        }
    }
    text.push('\n');
    if judgement.warnings.is_empty() {
        text.push_str("No warnings as far as they can be told without solving the case.\n");
    }
    let seen: Vec<Warning> = judgement.warnings.iter().map(|warning| warning.in_axes(case.axes)).collect();
    text.push_str(&warnings::lines(&seen, units, case.axes, LINE));
    text
}

/// The rows of the numbers under their heading.
fn numbers(case: &Case) -> Vec<String> {
    let mut ranges = case.ranges.iter().peekable();
    let rows: Vec<[String; 5]> = case
        .inputs()
        .into_iter()
        .map(|input| {
            let spread = ranges.next_if(|range| range.path == input.path).map(spread).unwrap_or_default();
            let [si, us] = [UnitSystem::Si, UnitSystem::Us].map(|system| shown(converted(&input, system)));
            [amount(input.number, input.unit), spread, si, us, input.path]
        })
        .collect();
    let longest = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    // Keys of a barrier test are longer: then the other columns have no more room than they need.
    let path = longest(4);
    let [key, written, si] = if path + 2 <= KEY {
        [KEY, WRITTEN, VALUE]
    } else {
        let si = longest(2) + 2;
        [path + 2, LINE.saturating_sub(path + 2 + si + longest(3)), si]
    };
    let row = |cells: [&str; 4]| {
        let [path, amount, in_si, in_us] = cells;
        format!(
            "{}{amount:<width$} {in_si:<si$}{in_us}",
            first_cell(path, key),
            width = written.saturating_sub(1)
        )
    };
    let mut lines = vec![row(["Numbers as understood", "as written", "SI", "US"]), "─".repeat(LINE)];
    for [amount, spread, in_si, in_us, path] in &rows {
        let whole = if spread.is_empty() { amount.clone() } else { format!("{amount}; {spread}") };
        // A range that is too long for its column stands below its number.
        let is_long = !spread.is_empty() && whole.chars().count() >= written;
        let first = if is_long { format!("{amount};") } else { whole };
        lines.push(row([path, &first, in_si, in_us]));
        if is_long {
            lines.push(format!("{:key$}{spread}", ""));
        }
    }
    lines
}

/// The judgement as indented JSON, ending in a line break: `commands`, `inputs` (as written, in SI and in US units), `choices`, `assumptions` and
/// `warnings`. SI units here are those with a plain 1 before them: m, kg, N, rad.
///
/// # Errors
/// Where serialisation fails, which no judgement causes.
pub fn judgement_json(file: &CaseFile, judgement: &Judgement) -> Result<String, serde_json::Error> {
    let case = &file.case;
    let mut ranges = case.ranges.iter().peekable();
    let document = Document {
        title: case.title.as_deref().unwrap_or_default(),
        axes: case.axes.name(),
        commands: judgement
            .abilities
            .iter()
            .map(|Ability { purpose, obstacle, .. }| CommandBlock {
                command: purpose.name(),
                runs: obstacle.is_none(),
                obstacles: obstacle
                    .iter()
                    .flat_map(|obstacle| file.diagnostics(obstacle, &PROGRAM).list().to_vec())
                    .map(|one| one.problem().to_string())
                    .collect(),
            })
            .collect(),
        inputs: case
            .inputs()
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
            .map(|warning| WarningBlock::new(&warning.in_axes(case.axes), case.axes))
            .collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// What a command that runs is good for in this case.
fn good_for(case: &Case, purpose: Purpose, on: Purpose) -> String {
    match (&case.reconstruct, purpose) {
        (Some(reconstruct), Purpose::Reconstruct) => {
            format!(" to find {}", words::unknown_name(reconstruct.find))
        }
        (_, Purpose::Draw) => {
            let is_damaged = case.vehicles.iter().any(|vehicle| vehicle.crush.is_some());
            let what: Vec<&str> = Subject::ALL
                .into_iter()
                .filter(|subject| match subject {
                    Subject::Scene | Subject::Energy => on != Purpose::Crush,
                    Subject::Damage => is_damaged,
                    Subject::Reconciliation => on == Purpose::Reconstruct,
                })
                .map(Subject::name)
                .collect();
            format!(" for --what {}", what.join(", "))
        }
        _ => String::new(),
    }
}

pub(crate) fn spread(range: &Range) -> String {
    match range.spread {
        Spread::Normal { sd } => format!("sd {sd}"),
        Spread::Uniform { low, high } => format!("{low} to {high}"),
        Spread::Triangular { low, high } => format!("likeliest of {low} to {high}"),
        Spread::Within { percent, confidence } => {
            format!("within {percent} % ({})", significant(confidence, 2))
        }
    }
}

fn amount(number: f64, unit: Option<&'static Unit>) -> String {
    unit.map_or_else(|| number.to_string(), |unit| format!("{number} {unit}"))
}

/// The units in which people of a custom know a quantity; depths and widths of damage in smaller ones than other lengths.
fn usual(dimension: Dimension, in_crush: bool, system: UnitSystem) -> &'static str {
    let (si, us) = match dimension {
        Dimension::Length if in_crush => ("cm", "in"),
        Dimension::Length => ("m", "ft"),
        Dimension::Mass => ("kg", "lb"),
        Dimension::Weight | Dimension::StiffnessG => ("N", "lb"),
        Dimension::Speed => ("m/s", "mph"),
        Dimension::Angle => ("rad", "deg"),
        Dimension::YawRate => ("rad/s", "deg/s"),
        Dimension::Inertia => ("kg m^2", "lb ft s^2"),
        Dimension::StiffnessA => ("N/cm", "lb/in"),
        Dimension::StiffnessB => ("N/cm^2", "lb/in^2"),
        Dimension::RootForce => ("N^0.5", "lb^0.5"),
        Dimension::RootForcePerLength => ("N^0.5/cm", "lb^0.5/in"),
    };
    match system {
        UnitSystem::Si => si,
        UnitSystem::Us => us,
    }
}

fn converted(input: &Input, system: UnitSystem) -> (f64, Option<&'static Unit>) {
    let unit = input.unit.and_then(|unit| {
        let in_crush = input.path.contains(".crush.") && !input.path.ends_with(".moment_arm");
        unit.dimension().unit(usual(unit.dimension(), in_crush, system))
    });
    match unit {
        // As written, without the rounding of two conversions.
        Some(unit) if input.unit == Some(unit) => (input.number, Some(unit)),
        Some(unit) => (input.si() / unit.factor(), Some(unit)),
        None => (input.number, None),
    }
}

/// Six digits are more than any input has, and zeros at the end say nothing.
fn shown((value, unit): (f64, Option<&'static Unit>)) -> String {
    // Through the text of six digits: the shortest decimal that reads back as it has no zeros at its end and no exponent.
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    let digits = if rounded == 0.0 { "0".to_owned() } else { rounded.to_string() };
    unit.map_or_else(|| digits.clone(), |unit| format!("{digits} {unit}"))
}

/// What the file says in words and whole numbers, key by key.
pub(crate) fn choices(case: &Case) -> Vec<(String, String)> {
    let mut choices = vec![("scene.axes".to_owned(), case.axes.name().to_owned())];
    for (i, vehicle) in case.vehicles.iter().enumerate() {
        let mut say = |key: &str, value: String| choices.push((format!("vehicle{}.{key}", i + 1), value));
        if let Some(name) = &vehicle.name {
            say("name", name.clone());
        }
        if vehicle.fixed {
            say("fixed", "true".to_owned());
        }
        if let Some(class) = vehicle.class {
            say("class", class.to_string());
        }
        let Some(crush) = &vehicle.crush else { continue };
        say("crush.side", words::side_name(crush.side).to_owned());
        if crush.from_force_balance {
            say("crush.from_force_balance", "true".to_owned());
        }
        match &crush.stiffness {
            StiffnessForm::Category(category) => say("crush.stiffness.category", category.to_string()),
            StiffnessForm::Test(test) => {
                say("crush.stiffness.test.fit", word(&Fit::WORDS, &test.fit).to_owned());
            }
            _ => {}
        }
        if let Some(Pdof::Clock(hour)) = crush.pdof {
            say("crush.pdof", format!("{hour} o'clock = {}°", clock_degrees(hour)));
        }
        match crush.oblique {
            // Its number stands among the numbers.
            None | Some(ObliqueCorrection::Friction(_)) => {}
            Some(correction) => say("crush.oblique", crate::law::correction_name(correction).to_owned()),
        }
    }
    if let Some(impact) = &case.impact {
        choices.push(("impact.law".to_owned(), impact.law.name().to_owned()));
        if matches!(impact.law, ImpactLaw::Brach { tangential: BrachTangential::Critical, .. }) {
            let critical = word(&BrachTangential::WORDS, &BrachTangential::Critical);
            choices.push(("impact.tangential".to_owned(), critical.to_owned()));
        }
    }
    if let Some(reconstruct) = &case.reconstruct {
        choices.push(("reconstruct.find".to_owned(), words::unknown_name(reconstruct.find).to_owned()));
        let basis = words::basis_name(reconstruct.energy_basis);
        choices.push(("reconstruct.energy_basis".to_owned(), basis.to_owned()));
    }
    choices
}

/// (°) clockwise, in (−180°, 180°].
fn clock_degrees(hour: u8) -> i32 {
    match i32::from(hour % 12) * 30 {
        degrees @ 0..=180 => degrees,
        degrees => degrees - 360,
    }
}

/// What is assumed, in words.
pub(crate) fn message(assumption: &Assumption, units: Units) -> String {
    match assumption {
        Assumption::ZUp => {
            "z-up: y to the left of x, angles and yaw rates counter-clockwise positive".to_owned()
        }
        Assumption::CategoryStiffness { category, side, abg: [a, b, g], .. } => format!(
            "A = {}, B = {}, G = {}: category {category} of CRASH3's table, {}{}",
            units.format(Quantity::StiffnessA, *a),
            units.format(Quantity::StiffnessB, *b),
            units.format(Quantity::StiffnessG, *g),
            words::side_name(*side),
            words::stiffness_doubt(StiffnessSource::Category(*category), *side)
                .map_or_else(String::new, |doubt| format!("; {doubt}"))
        ),
        Assumption::YawRate { .. } => "0: the vehicle does not turn before the impact".to_owned(),
        Assumption::ClassInertia { class, yaw_inertia, .. } => format!(
            "{}, with the radius of gyration of CRASH3's size class {class}",
            units.format(Quantity::YawInertia, *yaw_inertia)
        ),
        Assumption::BurgInertia { yaw_inertia, .. } => format!(
            "{}, Burg's estimate from mass, wheelbase and length",
            units.format(Quantity::YawInertia, *yaw_inertia)
        ),
        Assumption::Outline { class, .. } => format!(
            "not given, nor `width`, `cg_to_front` or `class`: drawings take the outline of CRASH3's size class {class}, nearest by radius of gyration"
        ),
        Assumption::SpeedUnused { given, .. } => format!(
            "unknown: this is the speed to be found, and the {} that the file gives is not used",
            units.format(Quantity::Speed, *given)
        ),
        Assumption::EqualSpacing { .. } => "equal: the stations divide the width into equal parts".to_owned(),
        Assumption::EnergyWithoutCrush { g, .. } => {
            let values: Vec<String> = g.iter().map(|&si| units.format(Quantity::StiffnessG, si)).collect();
            format!("A²/2B (d0²/2) = {}", values.join(", "))
        }
        Assumption::ExactFit { .. } => "exact: the line gives the test's kinetic energy back".to_owned(),
        Assumption::InferredWidth { .. } => {
            "unknown: that of the measured damage, within what the vehicle's dimensions allow".to_owned()
        }
        Assumption::Centred { side, .. } => {
            format!("0: the middle of the damage lies {}", words::undisplaced(*side))
        }
        Assumption::Pdof { opposite: Some(pdof), .. } => {
            format!("{}, opposite to the force on the other vehicle", units.format(Quantity::Angle, *pdof))
        }
        Assumption::Pdof { opposite: None, .. } => {
            "that of the impulse, where an impact is computed".to_owned()
        }
        Assumption::CappedCorrection { .. } => {
            "capped: 1 + tan²α, with α at most 45°, a factor of 2".to_owned()
        }
        Assumption::BrachLaw => "brach".to_owned(),
        Assumption::NoMoment => "-1: no moment impulse".to_owned(),
        Assumption::Dissipated => {
            "dissipated: the crush energy is what the normal impulse dissipates".to_owned()
        }
    }
}
