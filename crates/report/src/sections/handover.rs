//! The report to hand over: everything that the analysis rests on, and every result with its equation.

mod inputs;

use ::drawing::{Drawing, SitePlan};
use analysis::quantities as rows;
use analysis::{
    Analysis, Estimated, Output, Seen, Sensitivity, UncertainInput, UncertainOutput, Uncertainty, Vehicle,
    Warning, Weighed, is_estimated_beside,
};
use case::{Axes, Basis, Case, CaseFile, EstimatedInput, Origin, ReportHead};
use pim_core::{Energy, VehicleId};
use validation::Validation;

use super::chosen::Chosen;
use super::headline::{DETAIL, Headline};
use super::motion;
use super::results::{other_speeds, search};
use crate::data::sha256;
use crate::document::{Block, Document, Table};
use crate::estimates::{WIDEST, ends};
use crate::outputs::output_name;
use crate::pictures::{DrawingError, DrawingRequest, Subject};
use crate::steps::steps;
use crate::units::{Measure, number};
use crate::{Units, axes, basis, checks, energy, law, warnings, words};

/// The parts of a report in addition to the analysis itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct Supplements<'a> {
    /// The effects of the uncertain inputs of the case on its results.
    pub uncertainty: Option<&'a Uncertainty>,
    /// How sensitive the results are to each input.
    pub sensitivity: Option<&'a Sensitivity>,
    /// The errors of the program in collisions whose true speeds are known.
    pub validation: Option<&'a Validation>,
    /// The site plan on which the motion is drawn.
    pub site_plan: Option<&'a SitePlan>,
    /// All the evidence weighed, if the case has more than its exact solution uses.
    pub weighed: Option<&'a Weighed>,
    /// The same if the exact solution is the answer: its interval contains the errors of the method.
    pub estimated: Option<&'a Estimated>,
}

/// The heading of the warnings and assumptions.
const WARNINGS: &str = "Warnings and assumptions";
const UNCERTAINTY: &str = "Uncertainty";
const ERROR_RATE: &str = "Known error rate";

/// The report to hand over. As HTML, it has all drawings; as Markdown, it describes them, and `deltav draw`
/// makes them.
///
/// # Errors
/// [`DrawingError::Analysis`] if the curve of the reconciliation cannot be computed.
pub fn handover(
    file: &CaseFile,
    analysis: &Analysis,
    supplements: Supplements<'_>,
    units: Units,
) -> Result<Document, DrawingError> {
    let case = &file.case;
    let seen = &analysis.seen(case.axes);
    // One vehicle alone, or a motion alone, has nothing to do with the staged collisions.
    let is_collision = analysis.exchange().is_some() || analysis.crash3.is_some();
    let supplements =
        Supplements { validation: supplements.validation.filter(|_| is_collision), ..supplements };
    let Supplements { uncertainty, sensitivity, validation, site_plan, weighed, estimated: _ } = supplements;
    let why = analysis.why_not_exact();
    let headline = match (weighed, &why) {
        (Some(weighed), _) => Headline::Weighed(weighed),
        (None, Some(why)) => Headline::Unweighed(why),
        (None, None) => Headline::Exact,
    };
    let [of_case, of_solution] = warnings::of_answer(seen, weighed, headline.is_exact());
    let mut page = Document::new();
    page.title(case);
    page.blocks.extend(headline.lead(seen, units));
    let own = answer(&file.case, analysis, supplements, units);
    if headline.is_exact() {
        page.push(own);
        page.blocks.extend(warnings::notice(&of_case, Some(WARNINGS)));
        page.push(Block::Facts { title: "Identification", facts: identification(file, analysis) });
    } else {
        page.blocks.extend(warnings::notice(&of_case, Some(WARNINGS)));
        page.push(Block::Facts { title: "Identification", facts: identification(file, analysis) });
        if let Some(weighed) = weighed {
            page.blocks.extend(super::estimate::pictures(case, weighed, units));
        }
        page.heading(DETAIL);
        if let Block::Answer { found, how } = own {
            page.paragraph(format!("{} {how}", found.join(" ")));
        }
    }
    let glance = if why.is_some() { "The exact solution at a glance" } else { "Results at a glance" };
    page.push(results(glance, seen, units));
    page.tables(motion::momentum(seen, units));
    page.tables(motion::law_check(seen, units).into_iter().flatten());
    page.tables(motion::tables(seen, units));
    if let Some(uncertainty) = uncertainty {
        page.part(UNCERTAINTY, super::uncertainty::uncertainty(case, uncertainty, units));
    }
    if let Some(validation) = validation {
        page.heading(ERROR_RATE);
        error_rate(&mut page, analysis, validation, units);
    }
    let drawings = drawings(file, analysis, site_plan, units)?;
    if !drawings.is_empty() {
        page.heading(if headline.is_exact() { "Drawings" } else { "Drawings of the exact solution" });
    }
    page.blocks.extend(drawings.into_iter().map(|drawing| Block::Drawing(Box::new(drawing))));
    page.heading("Method");
    method(&mut page, analysis, case.axes, units);
    page.heading("Inputs");
    page.paragraph(
        "Every number of the case file in its own unit and in the SI unit that the program uses; what the \
         file gives in words; and what the program assumes where the file gives nothing.",
    );
    page.tables(inputs::tables(file, analysis, units));
    page.heading("Results step by step");
    let system = match units {
        Units::Si | Units::Uk => "Numbers are in SI units and degrees",
        Units::Us => {
            "Numbers are in ft, lb, s, slug (1 slug = 1 lb·s²/ft, so a mass is the weight over 32.174 ft/s²) and \
             degrees"
        }
    };
    page.paragraph(format!(
        "Each result has its equation, the numbers in it, and its source. {system}, so a calculator gives the \
         printed result. A number with fewer than six digits is exact; any other is rounded. Each result is \
         repeated in the units of the other tables. atan2(y, x) is the angle of the point (x, y)."
    ));
    page.blocks.extend(steps(case, analysis, units).into_iter().map(Block::Steps));
    if let Some(exchange) = seen.exchange() {
        page.heading("Energy balance");
        page.push(energy_balance(seen, &exchange.energy, units));
    }
    if let Some(checks) = checks::table(seen, units) {
        page.heading(checks.title.clone());
        page.push(Table { title: "What was given against what was computed".to_owned(), ..checks });
    }
    if let Some(sensitivity) = sensitivity {
        page.part("Sensitivity", super::sensitivity::sensitivity(case, sensitivity, units));
    }
    if !of_solution.is_empty() {
        page.heading("Objections to the exact solution");
        page.push(warnings::block(&of_solution, units));
    }
    page.heading(WARNINGS);
    page.push(warnings::block(&of_case, units));
    page.push(Block::List(assumptions(file, analysis, units)));
    if let Some(table) = crash3(seen, units) {
        page.heading("Appendix: ΔV by CRASH3's formulas");
        if seen.exchange().is_some() {
            let of = match seen.both.as_ref().filter(|both| !both.is_by_crush()) {
                Some(_) => "momentum",
                None => "planar impact mechanics",
            };
            page.paragraph(format!(
                "The ΔV of this report is that of {of}, the first row. CRASH3's formulas are given here for \
                 comparison only."
            ));
        }
        page.push(table);
    }
    page.heading("Case file");
    let name = words::file_name(file.source.name());
    page.paragraph(format!(
        "The complete text of {name}; the program can reproduce this report from it alone."
    ));
    page.push(Block::Listing { language: "toml", text: case::shown_lines(file.source.text()) });
    Ok(page)
}

/// All drawings for which the analysis has data: damage alone gives no scene, and a forward analysis no
/// reconciliation.
fn drawings(
    file: &CaseFile,
    analysis: &Analysis,
    site_plan: Option<&SitePlan>,
    units: Units,
) -> Result<Vec<Drawing>, DrawingError> {
    let mut drawings = Vec::new();
    for subject in Subject::ALL {
        // If momentum gave no speed, its polygon adds nothing to the drawing of the energy.
        let is_by_momentum = analysis.both.as_ref().is_some_and(|both| !both.is_by_crush());
        if subject == Subject::Momentum && !is_by_momentum {
            continue;
        }
        let request = DrawingRequest { subject, plain: false };
        match request.draw(file, analysis, None, units, site_plan.cloned()) {
            Ok(drawing) => drawings.push(drawing),
            Err(
                DrawingError::NoImpact { .. }
                | DrawingError::FixedObject { .. }
                | DrawingError::NoDamage
                | DrawingError::NoReconciliation
                | DrawingError::ByMomentum
                | DrawingError::NoMotion { .. },
            ) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(drawings)
}

fn identification(file: &CaseFile, analysis: &Analysis) -> Vec<(&'static str, String)> {
    let kind = match (&analysis.found, analysis.exchange()) {
        (Some(_), _) if has_all_damage(analysis) => {
            "reconstruction: a speed from the damage of both vehicles"
        }
        (Some(_), _) => "reconstruction: a speed from the crush energy",
        (None, Some(_)) if analysis.both.as_ref().is_some_and(|both| both.sought().is_some()) => {
            "reconstruction: a speed from how the vehicles left the impact"
        }
        (None, Some(_)) if analysis.both.is_some() => {
            "reconstruction: both speeds from how the vehicles left the impact"
        }
        (None, None) if analysis.travel.iter().any(Option::is_some) => "motion after the impact alone",
        (None, Some(_)) => "impact, computed forward from both speeds",
        (None, None) => "damage alone (CRASH3)",
    };
    let ReportHead { analyst, date, file_number, exhibit } = &file.case.report;
    let head = [("Analyst", analyst), ("Date", date), ("File number", file_number), ("Exhibit", exhibit)];
    let head = head.into_iter().filter_map(|(name, text)| Some((name, text.as_ref()?.to_string())));
    let mut facts: Vec<_> = head.collect();
    facts.extend([
        ("Case", words::title(&file.case)),
        ("Case file", words::file_name(file.source.name()).to_string()),
        ("SHA-256 of the case file", sha256(file.source.text().as_bytes())),
        ("Analysis", kind.to_owned()),
        ("Program", format!("deltav {}", env!("CARGO_PKG_VERSION"))),
    ]);
    facts
}

/// The findings, each with its interval first if there is one.
fn answer(case: &Case, analysis: &Analysis, supplements: Supplements<'_>, units: Units) -> Block {
    // Spreads of yaw inertias and contact points alone change a speed little: their interval would be
    // mistaken for one that contains all errors.
    let is_told = |uncertainty: &&Uncertainty| {
        let is_small = |input: &UncertainInput| {
            matches!(
                input.input.origin,
                Origin::Estimate(EstimatedInput::YawRadius { .. } | EstimatedInput::Contact { .. })
            )
        };
        !uncertainty.inputs.iter().all(is_small)
    };
    let uncertainty = supplements.uncertainty.filter(is_told);
    let of_method = supplements.estimated.filter(|estimated| estimated.doubts().is_empty());
    let said = |output: Output, si: f64| {
        let by_ranges = uncertainty.and_then(|uncertainty| interval(uncertainty, output, units));
        let by_all = of_method.and_then(|estimated| with_method(estimated, output, units));
        match (by_all, by_ranges) {
            // The digits follow the wider interval.
            (Some(wide), Some(narrow)) => {
                let central = number(units.value(Measure::RoadSpeed, si), wide.decimals);
                let unit = units.name(Measure::RoadSpeed);
                format!("{}; as solved {central} {unit}, {narrow}", wide.words)
            }
            (Some(wide), None) => {
                let central = number(units.value(Measure::RoadSpeed, si), wide.decimals);
                format!("{}; as solved {central} {}", wide.words, units.name(Measure::RoadSpeed))
            }
            (None, Some(narrow)) => format!("{narrow}; central value {}", units.speed_along(si)),
            (None, None) => units.speed_along(si),
        }
    };
    let changes = |values: [f64; 2]| {
        VehicleId::ALL
            .into_iter()
            .filter(|&id| analysis.moves(id))
            .map(|id| {
                format!("ΔV of vehicle {id}: {}.", said(rows::DELTA_V.of_vehicle(id), values[id.index()]))
            })
            .collect::<Vec<_>>()
    };
    let mut found = Vec::new();
    if let Some(answer) = &analysis.found {
        let vehicle = answer.unknown;
        let speed = said(rows::SPEED.of_vehicle(vehicle), answer.speed);
        found.push(format!("Speed of vehicle {vehicle} before impact: {speed}."));
        found.extend(other_speeds(answer, units).map(|others| format!("{others}.")));
    }
    if let Some(both) = &analysis.both {
        for vehicle in both.vehicles() {
            let speed = said(rows::SPEED.of_vehicle(vehicle), both.speeds[vehicle.index()]);
            found.push(format!("Speed of vehicle {vehicle} before impact: {speed}."));
        }
    }
    let is_motion = analysis.exchange().is_none() && analysis.travel.iter().any(Option::is_some);
    match (analysis.exchange(), &analysis.crash3) {
        _ if is_motion => {
            let ways = VehicleId::ALL.into_iter().zip(&analysis.travel);
            found.extend(
                ways.filter_map(|(id, way)| Some(format!("{}.", motion::answer(id, way.as_ref()?, units)))),
            );
        }
        (Some(_), _) if let Some(both) = &analysis.both => found.extend(changes(both.delta_v)),
        (Some(exchange), _) => found.extend(changes(exchange.delta_v.map(|change| change.norm()))),
        (None, Some(crash3)) => found.extend(changes(crash3.delta_v)),
        (None, None) => found.push("The damage gives the crush energies below.".to_owned()),
    }
    // These figures have no interval if the uncertain inputs affect none of them.
    let has_interval = |uncertainty: &&Uncertainty| {
        let of = |vehicle| [rows::SPEED.of_vehicle(vehicle), rows::DELTA_V.of_vehicle(vehicle)];
        let mut outputs = VehicleId::ALL.into_iter().flat_map(of);
        outputs.any(|output| interval(uncertainty, output, units).is_some())
    };
    let mut how = match uncertainty.filter(has_interval) {
        Some(Uncertainty { inputs, taken_as_exact, .. }) => {
            let by_all = if of_method.is_some() {
                "The first interval includes the errors of the method and the usual errors of all inputs. "
                    .to_owned()
            } else if supplements.weighed.is_none() && !is_estimated_beside(case) {
                "The surface has so many zones that the interval with the errors of the method takes \
                 minutes, so this report omits it: `deltav estimate` computes it. "
                    .to_owned()
            } else {
                String::new()
            };
            format!(
                "{by_all}The interval by the ranges alone includes the errors of {} inputs, but neither those \
                 of the {} taken as exact nor that of the method: \"{UNCERTAINTY}\" lists both.",
                inputs.len(),
                taken_as_exact.len()
            )
        }
        None if of_method.is_some() => {
            "The intervals include the errors of the method and the usual errors of all inputs. The values as solved \
             take both as exact."
                .to_owned()
        }
        None if uncertainty.is_some() => {
            "No input with a range changes these figures, so they have no interval.".to_owned()
        }
        None => "The inputs are taken as exact, so these figures have no interval.".to_owned(),
    };
    if let Some(estimated) = of_method {
        how.push_str(&format!(" {}", super::estimate::tested(estimated.tested)));
    }
    if supplements.validation.is_some() {
        how.push_str(&format!(" \"{ERROR_RATE}\" shows how far the method is off on staged collisions."));
    }
    Block::Answer { found, how }
}

/// An interval with the errors of the method.
struct Wide {
    words: String,
    /// The decimals of a speed that make sense with its width.
    decimals: usize,
}

/// `54 to 101 mph (95 %, with the errors of the method)`; `None` for an output that does not vary.
fn with_method(estimated: &Estimated, output: Output, units: Units) -> Option<Wide> {
    let found = estimated.output(output).filter(|found| found.varies())?;
    let [low, high] = ends(&found.posterior, WIDEST).map(|si| units.value(Measure::RoadSpeed, si));
    // A last digit that is a hundredth of the width is meaningless.
    let decimals = usize::from(high - low < WIDE);
    let words = format!(
        "{} to {} {} ({} %, with the errors of the method)",
        number(low, decimals),
        number(high, decimals),
        units.name(Measure::RoadSpeed),
        100.0 * LEAD
    );
    Some(Wide { words, decimals })
}

/// (km/h or mph) a speed with an interval at least this wide is given without decimals.
const WIDE: f64 = 10.0;

/// `45.8 to 58.0 mph (95 %, by the ranges of the case alone)`; `None` for an output that does not vary.
fn interval(uncertainty: &Uncertainty, output: Output, units: Units) -> Option<String> {
    let place = uncertainty.outputs.iter().position(|other| other.output == output)?;
    let summary = uncertainty.propagation.summaries().get(place)?.as_ref()?;
    if !uncertainty.outputs.get(place)?.varies(summary.sd.value) {
        return None;
    }
    let interval = summary.intervals.iter().find(|interval| interval.level == LEAD)?;
    let [low, high] =
        [interval.low, interval.high].map(|end| number(units.value(Measure::RoadSpeed, end.value), 1));
    Some(format!(
        "{low} to {high} {} ({} %, by the ranges of the case alone)",
        units.name(Measure::RoadSpeed),
        100.0 * LEAD
    ))
}

/// The speeds before the impact and ΔV by the samples, one line each: the interval first, then the value at
/// the central inputs, as at the head of the report. Empty if none of them varies, or if the exact solution
/// is not the answer.
#[must_use]
pub fn uncertain_headline(uncertainty: &Uncertainty, units: Units) -> Vec<String> {
    if uncertainty.nominal.why_not_exact().is_some() {
        return Vec::new();
    }
    let line = |output: &UncertainOutput| {
        let name = match output.output {
            speed if speed.is(&rows::SPEED) => format!("{} before impact", output_name(speed)),
            change if change.is(&rows::DELTA_V) => output_name(change),
            _ => return None,
        };
        let interval = interval(uncertainty, output.output, units)?;
        Some(format!("{name}: {interval}; central value {}.", units.speed_along(output.central)))
    };
    uncertainty.outputs.iter().filter_map(line).collect()
}

/// (–) the level of the interval that the report shows first.
const LEAD: f64 = 0.95;

/// The error rate of the program by the comparison with staged collisions, for this analysis.
fn error_rate(page: &mut Document, analysis: &Analysis, validation: &Validation, units: Units) {
    if !analysis.is_reconstruction() {
        page.paragraph(
            "This report reconstructs no speed; the error rate below is for speeds that the program \
             reconstructs from damage.",
        );
    }
    page.paragraph(if analysis.both.is_some() {
        super::validation::both_speeds_headline(validation, units)
    } else {
        super::validation::validation_headline(validation, units)
    });
    if analysis.exchange().is_some() && VehicleId::ALL.into_iter().any(|id| !analysis.moves(id)) {
        page.paragraph(
            "None of these staged collisions is an impact with a fixed object, in which crush says far less about \
             the speed than between two vehicles (docs/calibration.md).",
        );
    }
    for warning in &analysis.warnings {
        let (made_for, energies, share) = match warning {
            Warning::CategoryEnergy { share, .. } => (
                "The categories of CRASH3 were made for the cars of these tests, of the 1970s. For those of this case,",
                "energies by categories",
                share,
            ),
            Warning::FleetEnergy { share, .. } => (
                "The stiffnesses in these tests are those of their cars. With the stiffness of the fleet,",
                "energies",
                share,
            ),
            _ => continue,
        };
        page.paragraph(format!(
            "{made_for} {energies} are on average {} % of what the impact takes, so that such speeds are on average too low.",
            number(100.0 * share, 0)
        ));
    }
    page.paragraph(
        "`deltav validate` repeats the comparison and prints its data, case by case: the RICSAC collisions of \
         SAE 871993 and SAE 980025. Intervals from the ranges of the inputs alone do not contain this error.",
    );
}

fn method(page: &mut Document, analysis: &Analysis, axes: Axes, units: Units) {
    if let Some(found) = &analysis.found {
        let (agreement, basis) = match analysis.basis {
            Basis::Dissipated => (
                "equals the crush energy",
                "The crush energy is the energy that the normal impulse dissipates, as the paper assumes.",
            ),
            Basis::Absorbed => (
                "is (1 − e²) times the crush energy",
                "The crush energy is the energy absorbed at maximum engagement; restitution returns the share \
                 e² of it.",
            ),
            Basis::TangentialShare(_) => (
                "equals the crush energy",
                "That share is the analyst's choice: the method of the paper counts none of the tangential \
                 work as crush.",
            ),
        };
        let way = search(found);
        let roots = match found.admissible.len() {
            1 => "one admissible speed exists".to_owned(),
            several => format!(
                "{several} admissible speeds exist, and of those within the limits of the vehicle's speed the \
                 answer has the least motion of the vehicles relative to each other"
            ),
        };
        page.paragraph(format!(
            "{} Planar impact mechanics gives {} for any speed of vehicle {}. The speed at which that work {agreement} was \
             found {way}; {roots}. {basis}",
            energy_sources(analysis),
            basis::work(analysis.basis),
            found.unknown
        ));
    } else if let Some(both) = &analysis.both {
        let seen = analysis.seen(axes);
        page.paragraph(motion::how(both, &seen, units));
        page.paragraph(motion::method(&seen, units));
    } else if analysis.impact.is_some() {
        page.paragraph(
            "Planar impact mechanics gives the motion after the impact from that before it: one condition along the normal of the crush plane and one along \
             the plane determine the impulse, and the impulse determines all the rest.",
        );
    } else if analysis.travel.iter().any(Option::is_some) {
        page.paragraph(motion::method(&analysis.seen(axes), units));
    } else if analysis.crash3.is_some() {
        page.paragraph(
            "The CRASH3 algorithm gives the crush energy from damage and stiffness, and the velocity changes from the energy of both vehicles and the principal \
             direction of force.",
        );
    } else {
        page.paragraph(
            "The crush energy follows from the damage, and the EES from the crush energy and the mass.",
        );
    }
    page.paragraph(format!(
        "The method is that of R. M. Brach and R. M. Brach, Crush Energy and Planar Impact Mechanics for Accident Reconstruction, SAE 980025 (1998). Eq n names \
         equation n of that paper, with its misprints corrected; theory n is section n of docs/theory.md, \
         which derives the equations and lists the misprints. \
         {}; n points from vehicle 2 to vehicle 1, t is n turned by +90°.",
        axes::conventions(axes)
    ));
}

fn results(title: &'static str, analysis: &Seen, units: Units) -> Table {
    let chosen = Chosen { analysis, units };
    let mut table = Table::of_vehicles(title);
    if analysis.exchange().is_some() {
        chosen.pair(&mut table, &rows::SKID_SPEED);
        chosen.pair(&mut table, &rows::SPEED);
        chosen.pair(&mut table, &rows::FINAL_SPEED);
        chosen.vectors(&mut table, [&rows::FINAL_VELOCITY_X, &rows::FINAL_VELOCITY_Y]);
        for row in [
            &rows::FINAL_YAW_RATE,
            &rows::DELTA_V,
            &rows::DELTA_V_LONGITUDINAL,
            &rows::DELTA_V_LATERAL,
            &rows::PDOF,
        ] {
            chosen.pair(&mut table, row);
        }
    }
    chosen.pair(&mut table, &rows::CRUSH_ENERGY);
    chosen.pair(&mut table, &rows::EES);
    table
}

fn energy_balance(analysis: &Seen, of: &Energy, units: Units) -> Table {
    let mut table = Table::of_two("Energy balance", ["energy", "share of the initial energy", "source"]);
    for row in [
        &rows::IMPACT_INITIAL_ENERGY,
        &rows::IMPACT_NORMAL_WORK,
        &rows::IMPACT_TANGENTIAL_WORK,
        &rows::IMPACT_MOMENT_WORK,
        &rows::IMPACT_ENERGY_LOSS,
        &rows::IMPACT_FINAL_ENERGY,
    ] {
        let share = |si: f64| energy::share(si, of);
        Chosen { analysis, units }.energy(&mut table, row, "", share);
    }
    table.notes = energy::notes(analysis, units);
    table
}

fn crash3(analysis: &Seen, units: Units) -> Option<Table> {
    let crash3 = analysis.crash3.as_ref()?;
    let mut table = Table::of_vehicles("ΔV by impact mechanics and by CRASH3");
    let pair = |values: [f64; 2]| {
        VehicleId::ALL.map(|id| analysis.moves(id).then(|| units.speed(values[id.index()])))
    };
    if let Some(both) = analysis.both.as_ref().filter(|both| !both.is_by_crush()) {
        table.pair("momentum", pair(both.delta_v), "theory 10");
    }
    if let Some(impact) = &analysis.impact {
        let label = "planar impact mechanics";
        let label = if analysis.law_check().is_some() { "impact law of the case, a check" } else { label };
        table.pair(label, pair(impact.outcome.delta_v_magnitude()), "theory 2");
    }
    table.pair("CRASH3, uncorrected", pair(crash3.delta_v), "Eq 6, 7");
    if let Some(corrected) = crash3.corrected {
        table.pair("CRASH3, corrected for the oblique force", pair(corrected.delta_v), "Eq 6, 7, 8");
        if let Some(factor) = crash3.restitution_factor {
            let label = "CRASH3, corrected, with restitution";
            table.pair(label, pair(corrected.delta_v.map(|dv| dv * factor)), "theory 5");
        }
    }
    for row in &crash3.corrections {
        let label = format!("CRASH3 with factor {}", law::factor(row));
        table.pair(&label, pair(row.delta_v), "theory 5");
    }
    Some(table)
}

/// Whether the crush of both vehicles was measured or follows from that of the other.
fn has_all_damage(analysis: &Analysis) -> bool {
    analysis.vehicles.iter().all(|vehicle| vehicle.subject.damage.is_some())
}

/// How the crush energy was obtained.
fn energy_sources(analysis: &Analysis) -> String {
    if has_all_damage(analysis) {
        return "The crush energy of both vehicles follows from their damage by the CRASH3 algorithm."
            .to_owned();
    }
    let source = |(id, vehicle): (VehicleId, &Vehicle)| {
        let subject = &vehicle.subject;
        let has_ees = subject.energy.is_some_and(|energy| energy.ees.is_some());
        let how = match subject.deformation_energy {
            Some(_) => "as the case gives it",
            None if subject.damage.is_some() => "from its damage by the CRASH3 algorithm",
            None if has_ees => "from its energy equivalent speed",
            None => return None,
        };
        let name = if vehicle.moves() { "vehicle" } else { "object" };
        Some(format!("of {name} {id} {how}"))
    };
    let sources: Vec<String> =
        VehicleId::ALL.into_iter().zip(&analysis.vehicles).filter_map(source).collect();
    format!("The crush energy is that {}.", sources.join(", and that "))
}

/// The assumptions of the analysis, apart from numbers.
fn assumptions(file: &CaseFile, analysis: &Analysis, units: Units) -> Vec<String> {
    let mut assumptions = Vec::new();
    if analysis.exchange().is_some() || analysis.crash3.is_some() {
        assumptions.push(
            "Two rigid bodies collide in the plane in one instantaneous impact, without tyre forces; the crush \
             changes neither positions nor inertias."
                .to_owned(),
        );
    }
    if let Some(impact) = &file.case.impact {
        assumptions.push(format!(
            "Impact law: {}, with {}. The analyst chose {}.",
            law::name(&impact.law),
            law::coefficients(&impact.law, units),
            if analysis.vehicles.iter().any(|vehicle| vehicle.subject.contact_is_placed) {
                "crush plane and coefficients; a contact point that the case does not give was placed at the \
                 centroid of the damage"
            } else {
                "contact point, crush plane and coefficients"
            }
        ));
    }
    if analysis.vehicles.iter().any(|vehicle| vehicle.damage.is_some()) {
        assumptions.push(
            "Crush: the force per width grows linearly with the residual crush, and the profile is straight between its stations.".to_owned(),
        );
    }
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&analysis.vehicles) {
        if let Some(damage) = &vehicle.subject.damage {
            assumptions.push(format!(
                "Stiffness of vehicle {id}: {}.",
                words::stiffness_source(damage.stiffness_source, damage.side)
            ));
        }
        if let Some(deformation_energy) = vehicle.subject.deformation_energy {
            assumptions.push(format!(
                "Object {id}: {} deformed it. The analyst chose this energy; the object did not move.",
                units.format(Measure::Energy, deformation_energy)
            ));
        }
        if let Some(energy) = vehicle.subject.energy {
            assumptions.push(if energy.ees.is_some() {
                format!(
                    "Crush energy of vehicle {id}: from its energy equivalent speed. The analyst chose it; no crush was measured."
                )
            } else {
                format!("Vehicle {id}: no damage that counts, so its crush energy is taken as zero.")
            });
        }
    }
    assumptions
}
