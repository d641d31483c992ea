//! The report to hand over: one document, written as HTML or as Markdown.

mod html;
mod inputs;
mod markdown;

use analysis::{Analysis, Found};
use case::{Axes, CaseFile};
use crash3::EnergyBasis;
use sha2::{Digest as _, Sha256};

use crate::drawing::{Drawing, DrawingError, Subject, drawing};
use crate::steps::{StepGroup, steps};
use crate::text::search;
use crate::units::Quantity;
use crate::{Units, axes, checks, energy, law, warnings, words};

/// All that the report says, in its order.
struct Page {
    title: String,
    source: Option<String>,
    /// What was found, in one sentence.
    answer: String,
    /// How many warnings there are.
    notice: Option<String>,
    /// Name and value.
    identification: Vec<(&'static str, String)>,
    drawings: Vec<Drawing>,
    method: Vec<String>,
    inputs: Vec<Table>,
    results: Table,
    steps: Vec<StepGroup>,
    units: Units,
    energy: Option<Table>,
    /// Below the energy balance.
    energy_notes: Vec<String>,
    crash3: Option<Table>,
    checks: Option<Table>,
    warnings: Vec<(&'static str, String)>,
    assumptions: Vec<String>,
    supplements: Vec<Supplement>,
    case_name: String,
    case_text: String,
}

/// A part of the report that comes as text in columns, such as that of `deltav uncertainty`.
#[derive(Clone, Debug)]
pub struct Supplement {
    /// Its heading.
    pub title: &'static str,
    /// Its lines.
    pub text: String,
}

/// A table; its first column names the rows.
struct Table {
    caption: &'static str,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// The report as one self-contained HTML file: no scripts, nothing from a network, made to be printed on A4 or Letter.
///
/// # Errors
/// [`DrawingError::Analysis`] where the curve of the reconciliation cannot be computed.
pub fn html(
    file: &CaseFile,
    analysis: &Analysis,
    supplements: Vec<Supplement>,
    units: Units,
) -> Result<String, DrawingError> {
    Ok(html::write(&Page::new(file, analysis, supplements, units)?))
}

/// The report as Markdown. Its drawings are not in it: `deltav draw` makes them.
///
/// # Errors
/// As [`html`].
pub fn markdown(
    file: &CaseFile,
    analysis: &Analysis,
    supplements: Vec<Supplement>,
    units: Units,
) -> Result<String, DrawingError> {
    Ok(markdown::write(&Page::new(file, analysis, supplements, units)?))
}

impl Page {
    fn new(
        file: &CaseFile,
        analysis: &Analysis,
        supplements: Vec<Supplement>,
        units: Units,
    ) -> Result<Self, DrawingError> {
        let case = &file.case;
        let seen = &analysis.in_axes(case.axes);
        let mut drawings = Vec::new();
        for subject in Subject::ALL {
            match drawing(file, analysis, units, subject) {
                Ok(drawing) => drawings.push(drawing),
                // An analysis of damage alone has no scene, a forward one no reconciliation.
                Err(
                    DrawingError::NoImpact { .. } | DrawingError::NoDamage | DrawingError::NoReconciliation,
                ) => {}
                Err(error) => return Err(error),
            }
        }
        let kind = match (&analysis.found, &analysis.impact) {
            (Some(_), _) => "reconstruction: a speed from the damage of both vehicles",
            (None, Some(_)) => "impact, computed forward from both speeds",
            (None, None) => "damage alone (CRASH3)",
        };
        let identification = vec![
            ("Case", case.title.clone().unwrap_or_else(|| "untitled".to_owned())),
            ("Case file", file.source.name().to_owned()),
            ("SHA-256 of the case file", sha256(file.source.text())),
            ("Analysis", kind.to_owned()),
            ("Program", format!("deltav {}", env!("CARGO_PKG_VERSION"))),
        ];
        Ok(Self {
            title: case.title.clone().unwrap_or_else(|| "Untitled case".to_owned()),
            source: case.source.clone(),
            answer: answer(analysis, units),
            notice: warnings::count(&seen.warnings),
            identification,
            drawings,
            method: method(analysis, case.axes),
            inputs: inputs::tables(file, analysis, units),
            results: results(seen, units),
            steps: steps(case, analysis),
            units,
            energy: seen.impact.as_ref().map(|impact| energy_balance(impact, units)),
            energy_notes: energy::notes(seen, units),
            crash3: crash3(seen, units),
            checks: consistency(seen, units),
            warnings: seen
                .warnings
                .iter()
                .map(|warning| (warning.code(), warnings::message(warning, units, case.axes)))
                .collect(),
            assumptions: assumptions(file, analysis, units),
            supplements,
            case_name: file.source.name().to_owned(),
            case_text: file.source.text().to_owned(),
        })
    }
}

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn both(units: Units, si: f64) -> String {
    format!("{} = {}", units.format(Quantity::Speed, si), units.road_speed(si))
}

fn answer(analysis: &Analysis, units: Units) -> String {
    let found = |found: &Found| {
        format!("Speed of vehicle {} before impact: {}.", found.unknown.index() + 1, both(units, found.speed))
    };
    match (&analysis.found, &analysis.impact, &analysis.crash3) {
        (Some(answer), ..) => found(answer),
        (None, Some(impact), _) => {
            let [first, second] = impact.outcome.delta_v_magnitude().map(|dv| both(units, dv));
            format!("Velocity changes: {first} of vehicle 1 and {second} of vehicle 2.")
        }
        (None, None, Some(crash3)) => {
            let [first, second] = crash3.delta_v.map(|dv| both(units, dv));
            format!("CRASH3's velocity changes: {first} of vehicle 1 and {second} of vehicle 2.")
        }
        (None, None, None) => "The damage gives the crush energies below.".to_owned(),
    }
}

fn method(analysis: &Analysis, axes: Axes) -> Vec<String> {
    let mut paragraphs = Vec::new();
    if let Some(found) = &analysis.found {
        let (agreement, basis) = match analysis.basis {
            EnergyBasis::Dissipated => (
                "equals the crush energy",
                "The crush energy is taken as the energy that the normal impulse dissipates, as in the paper.",
            ),
            EnergyBasis::Absorbed => (
                "is (1 − e²) times the crush energy",
                "The crush energy is taken as the energy absorbed at maximum engagement, of which restitution gives the share e² back.",
            ),
        };
        let way = search(found);
        let roots = match found.admissible.len() {
            1 => "one admissible speed exists".to_owned(),
            several => format!(
                "{several} admissible speeds exist, and the one with the slowest approach is the answer"
            ),
        };
        paragraphs.push(format!(
            "The crush energy of both vehicles follows from their damage by the CRASH3 algorithm. Planar impact mechanics gives the work of the normal impulse \
             for any speed of vehicle {}. The speed at which that work {agreement} was found {way}; {roots}. {basis}",
            found.unknown.index() + 1
        ));
    } else if analysis.impact.is_some() {
        paragraphs.push(
            "Planar impact mechanics gives the motion after the impact from that before it: one condition along the normal of the crush plane and one along \
             the plane determine the impulse, and the impulse all the rest."
                .to_owned(),
        );
    } else {
        paragraphs.push(
            "The CRASH3 algorithm gives the crush energy from damage and stiffness, and the velocity changes from the energy of both vehicles and the principal \
             direction of force."
                .to_owned(),
        );
    }
    paragraphs.push(format!(
        "The method is that of R. M. Brach and R. M. Brach, Crush Energy and Planar Impact Mechanics for Accident Reconstruction, SAE 980025 (1998). Eq n names \
         equation n of that paper, its misprints mended; theory n is section n of docs/theory.md, which derives the equations and lists the misprints. \
         {}; n points from vehicle 2 to vehicle 1, t is n turned by +90°.",
        axes::conventions(axes)
    ));
    paragraphs
}

fn table(caption: &'static str, header: [&str; 3]) -> Table {
    Table { caption, header: header.map(str::to_owned).to_vec(), rows: Vec::new() }
}

impl Table {
    /// A row of which each vehicle has a value or a dash.
    fn pair(&mut self, label: &str, values: [Option<String>; 2]) {
        if values.iter().any(Option::is_some) {
            let [first, second] = values.map(|value| value.unwrap_or_else(|| "–".to_owned()));
            self.rows.push(vec![label.to_owned(), first, second]);
        }
    }
}

fn results(analysis: &Analysis, units: Units) -> Table {
    let mut results = table("Results at a glance", ["", "vehicle 1", "vehicle 2"]);
    let moves = |i: usize| analysis.vehicles[i].subject.inertia.is_some();
    if let Some(impact) = &analysis.impact {
        let outcome = &impact.outcome;
        let each = |f: &dyn Fn(usize) -> String| [0, 1].map(|i| moves(i).then(|| f(i)));
        results.pair("speed before impact", each(&|i| both(units, analysis.speed(i))));
        let vector = |v: pim_core::Vector2<f64>| units.format_vector(Quantity::Speed, v.into());
        results.pair("velocity after impact", each(&|i| vector(outcome.after[i].velocity)));
        results.pair("yaw rate after impact", each(&|i| units.yaw_rate(outcome.after[i].yaw_rate)));
        results.pair("ΔV", each(&|i| both(units, outcome.delta_v_magnitude()[i])));
        results.pair(
            "PDOF, clockwise from the heading",
            each(&|i| units.format(Quantity::Angle, impact.pdof[i])),
        );
    }
    let damage =
        |f: &dyn Fn(&analysis::Damage) -> String| [0, 1].map(|i| analysis.vehicles[i].damage.as_ref().map(f));
    results.pair("crush energy", damage(&|d| units.format(Quantity::Energy, d.crush_energy)));
    results.pair("energy equivalent speed EES", damage(&|d| both(units, d.ees)));
    results
}

fn energy_balance(impact: &analysis::Impact, units: Units) -> Table {
    let works = impact.outcome.energy;
    let mut balance = table("Energy balance", ["", "energy", "share of the initial energy"]);
    let mut rows = vec![
        ("initial kinetic energy", works.before),
        ("normal work W_n", works.normal_work),
        ("tangential work W_t", works.tangential_work),
    ];
    if impact.outcome.moment_impulse != 0.0 {
        rows.push(("moment work W_m", works.moment_work));
    }
    rows.extend([("energy loss E_L", works.loss), ("final kinetic energy", works.after)]);
    for (name, value) in rows {
        let share = energy::share(value, &works);
        balance.rows.push(vec![name.to_owned(), units.format(Quantity::Energy, value), share]);
    }
    balance
}

fn crash3(analysis: &Analysis, units: Units) -> Option<Table> {
    let crash3 = analysis.crash3.as_ref()?;
    let mut comparison = table("ΔV by impact mechanics and by CRASH3", ["", "vehicle 1", "vehicle 2"]);
    let pair = |values: [f64; 2]| {
        [0, 1].map(|i| analysis.vehicles[i].subject.inertia.is_some().then(|| both(units, values[i])))
    };
    if let Some(impact) = &analysis.impact {
        comparison.pair("planar impact mechanics", pair(impact.outcome.delta_v_magnitude()));
    }
    comparison.pair("CRASH3, uncorrected (Eq 6, 7)", pair(crash3.delta_v));
    if let Some(corrected) = crash3.corrected {
        comparison.pair("CRASH3, corrected for the oblique force (Eq 8)", pair(corrected.delta_v));
        if let Some(factor) = crash3.restitution_factor {
            let label = "CRASH3, corrected, with restitution (theory 5)";
            comparison.pair(label, pair(corrected.delta_v.map(|dv| dv * factor)));
        }
    }
    for row in &crash3.corrections {
        let label = format!("CRASH3 with factor {} (theory 5)", law::factor(row));
        comparison.pair(&label, pair(row.delta_v));
    }
    Some(comparison)
}

/// The same rows as in the text.
fn consistency(analysis: &Analysis, units: Units) -> Option<Table> {
    let mut header = vec![String::new()];
    header.extend(checks::COLUMNS.map(str::to_owned));
    let rows: Vec<Vec<String>> = checks::rows(analysis, units)
        .into_iter()
        .map(|checks::Row { label, cells }| std::iter::once(label).chain(cells).collect())
        .collect();
    (!rows.is_empty()).then_some(Table { caption: "What was given against what was computed", header, rows })
}

/// What the analysis rests on besides the numbers.
fn assumptions(file: &CaseFile, analysis: &Analysis, units: Units) -> Vec<String> {
    let mut assumptions = vec![
        "Two rigid bodies in the plane, one impact without duration: no tyre forces during it, no change of position or of inertia by the crush.".to_owned(),
    ];
    if let Some(impact) = &file.case.impact {
        assumptions.push(format!(
            "Impact law: {}, with {}. Contact point, crush plane and coefficients are the analyst's.",
            law::name(&impact.law),
            law::coefficients(&impact.law, units)
        ));
    }
    if analysis.vehicles.iter().any(|vehicle| vehicle.damage.is_some()) {
        assumptions.push(
            "Crush: the force per width grows linearly with the residual crush, and the profile is straight between its stations.".to_owned(),
        );
    }
    for (i, vehicle) in analysis.vehicles.iter().enumerate() {
        if let Some(damage) = &vehicle.subject.damage {
            assumptions.push(format!(
                "Stiffness of vehicle {}: {}.",
                i + 1,
                words::stiffness_source_and_doubt(damage.stiffness_source, damage.side)
            ));
        }
    }
    assumptions
}
