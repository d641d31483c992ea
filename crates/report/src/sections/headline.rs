//! The headline of a reconstruction: the exact solution if the case is just determined; all the evidence
//! weighed if there is more, followed by the exact solutions and the objections to each.

use analysis::{Analysis, EnergyShown, Seen, Solution, Weighed, WhyNotExact};
use pim_core::VehicleId;

use super::chosen::or_none;
use crate::checks;
use crate::document::{Block, Column, Document, Row, Table};
use crate::estimates::Asked;
use crate::pictures;
use crate::units::{Measure, Units, number};
use crate::warnings::vehicles;
use crate::words;

/// The headline of a document on a reconstruction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Headline<'a> {
    /// The exact solution: the case just determines it.
    Exact,
    /// Nothing: the case has more evidence, which was not weighed here.
    Unweighed(&'a WhyNotExact),
    /// All the evidence.
    Weighed(&'a Weighed),
}

/// An exact solution that is not the answer of its case, with its figures as the reader sees them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactSolution {
    /// The part of the evidence that it uses.
    pub by: &'static str,
    /// The speeds of the vehicles that move.
    pub speeds: [Option<String>; 2],
    /// The ΔV of the vehicles that move.
    pub delta_v: [Option<String>; 2],
    /// That it is not the answer, and why: the sentence below the title of its drawings.
    pub caveat: String,
}

impl ExactSolution {
    /// The exact solution of an analysis; `None` if it is the answer, and if there is none.
    #[must_use]
    pub fn not_the_answer(analysis: &Analysis, units: Units) -> Option<Self> {
        let why = analysis.why_not_exact()?;
        let [speeds, delta_v] = figures(analysis, units);
        Some(Self { by: words::solution(why.solved_by), speeds, delta_v, caveat: pictures::caveat(analysis) })
    }
}

/// The heading of the details of an exact solution that is not the answer.
pub(crate) const DETAIL: &str = "The exact solution in detail";

/// (columns) of the name of a solution, and of a speed.
const NAME: usize = 32;
const SPEED: usize = 14;

impl<'a> Headline<'a> {
    /// The blocks of the headline; none if it is the exact solution.
    pub(crate) fn lead(self, analysis: &Seen, units: Units) -> Vec<Block> {
        match self {
            Self::Exact => Vec::new(),
            Self::Unweighed(why) => {
                let why_not = if !why.left_aside.is_empty() {
                    "The case has more evidence than any one exact solution uses"
                } else if why.is_contradicted || !why.refuted_by.is_empty() {
                    "Evidence refutes the exact solution"
                } else if why.takes_bound {
                    "The damage only bounds the speed"
                } else if !why.nearly_stood.is_empty() {
                    "A vehicle was probably stationary"
                } else {
                    "The crush energies are too small on average"
                };
                let found = vec![format!("{why_not}: the answer is the estimate from all evidence.")];
                let how = format!(
                    "{} `deltav estimate` weighs all the evidence. The exact solution below takes its part of the evidence \
                     as free of errors.",
                    because(why, analysis, units)
                );
                vec![Block::Answer { found, how }, Block::Table(exact(why, analysis, units))]
            }
            Self::Weighed(weighed) => {
                let asked = Asked { plan: weighed.plan, questions: Vec::new() };
                let mut page = Document::new();
                let (because, missed) = (because(&weighed.why, analysis, units), &weighed.estimated.missed);
                if missed.is_empty() {
                    page.blocks = super::estimate::headline(&weighed.estimated, &asked, units);
                    page.paragraph(format!(
                        "{because} So all the evidence was weighed, each piece by its error; the intervals \
                         also include the errors of the method. {} `deltav estimate` shows the effect of each piece.",
                        super::estimate::severity(&weighed.estimated)
                    ));
                } else {
                    page.push(Block::Answer {
                        found: vec![super::estimate::NO_COLLISION.to_owned()],
                        how: format!(
                            "{because} So all the evidence was weighed. {} Each exact solution below takes a part of the evidence as \
                             free of errors.",
                            super::estimate::missed(missed, &weighed.estimated.certain)
                        ),
                    });
                }
                page.push(Block::Table(solutions(weighed, analysis, units)));
                page.blocks
            }
        }
    }

    /// All the evidence, if that is the answer.
    pub(crate) fn weighed(self) -> Option<&'a Weighed> {
        if let Self::Weighed(weighed) = self { Some(weighed) } else { None }
    }

    /// Whether the exact solution is the answer.
    pub(crate) fn is_exact(self) -> bool {
        matches!(self, Self::Exact)
    }
}

/// Why no exact solution is the answer.
fn because(why: &WhyNotExact, analysis: &Seen, units: Units) -> String {
    let mut reasons = Vec::new();
    if !why.left_aside.is_empty() {
        let keys = words::quoted(&why.left_aside, ", ");
        reasons.push(format!("The exact solution detailed below does not use {keys}."));
    }
    if !why.refuted_by.is_empty() {
        let whose = if reasons.is_empty() { "The checks of the exact solution" } else { "Its own checks" };
        reasons.push(format!("{whose} refute it: {}.", refuted(analysis, units).join("; ")));
    }
    if why.is_contradicted {
        let which = if reasons.is_empty() { "the exact solution" } else { "it" };
        reasons.push(format!("Evidence contradicts {which}, as the warnings say."));
    }
    for vehicle in &why.nearly_stood {
        let which = if reasons.is_empty() { "The exact solution" } else { "It" };
        let backward = units.format(Measure::RoadSpeed, analysis.speed(*vehicle).abs());
        reasons.push(format!(
            "{which} has vehicle {vehicle} move backward at {backward}; if the inputs are slightly off, a stationary vehicle \
             comes out like this."
        ));
    }
    if let Some(taken) = takes(&why.energies_shown) {
        let which = if reasons.is_empty() { "The exact solution" } else { "It" };
        reasons.push(format!("{which} {taken}."));
    }
    if why.takes_bound {
        let which = if reasons.is_empty() { "The exact solution" } else { "It" };
        reasons.push(format!(
            "{which} equates the energy of the impact with the energy at which residual crush begins. No vehicle has residual \
             crush, so the impact may have taken much less."
        ));
    }
    reasons.join(" ")
}

/// What an exact solution does with crush energies that on average show these shares of the impact's energy.
fn takes(shown: &[EnergyShown]) -> Option<String> {
    let percent = |shown: &EnergyShown| format!("{} %", number(100.0 * shown.share, 0));
    let (taken, shares) = match shown {
        [] => return None,
        [both] if both.of == [true; 2] => ("crush energies".to_owned(), percent(both)),
        [one] => (format!("the crush energy of {}", vehicles(one.of)), percent(one)),
        several => {
            let each = several.iter().map(|one| format!("{} ({})", percent(one), vehicles(one.of)));
            ("crush energies".to_owned(), each.collect::<Vec<_>>().join(" and "))
        }
    };
    Some(format!(
        "takes {taken} from a typical stiffness at face value, although such energies are on average {shares} of the energy \
         of the impact"
    ))
}

/// The checks of the exact solution that refute it, with what they found.
fn refuted(analysis: &Seen, units: Units) -> Vec<String> {
    let said = |check| {
        let [label, found, limit] = checks::said(check, analysis, units);
        format!("{label}: {found} (limit: {limit})")
    };
    analysis.refuting().map(said).collect()
}

fn columns() -> Vec<Column> {
    let speeds = ["speed 1", "speed 2", "ΔV 1", "ΔV 2"];
    std::iter::once(Column::words("", NAME)).chain(speeds.map(|name| Column::numbers(name, SPEED))).collect()
}

/// The exact solution of an analysis, if nothing else was solved.
fn exact(why: &WhyNotExact, analysis: &Seen, units: Units) -> Table {
    let mut table = Table::new("Exact solution").columns(columns());
    let figures = figures(analysis, units).into_iter().flatten().map(or_none);
    table.cells(std::iter::once(words::solution(why.solved_by).to_owned()).chain(figures));
    table
}

/// The speeds of an exact solution and the ΔV, of the vehicles that move.
fn figures<W>(analysis: &Analysis<W>, units: Units) -> [[Option<String>; 2]; 2] {
    let delta_v = analysis.both.as_ref().map(|both| both.delta_v);
    let delta_v = delta_v.or_else(|| Some(analysis.impact.as_ref()?.outcome.delta_v_magnitude()));
    let of_moving = |of: &dyn Fn(VehicleId) -> Option<f64>| {
        VehicleId::ALL.map(|id| {
            let found = of(id).filter(|_| analysis.moves(id))?;
            Some(units.format(Measure::RoadSpeed, found))
        })
    };
    [of_moving(&|id| Some(analysis.speed(id))), of_moving(&|id| Some(delta_v?[id.index()]))]
}

/// The exact solutions, each with the objections to it.
fn solutions(weighed: &Weighed, analysis: &Seen, units: Units) -> Table {
    let mut table = Table::new("Exact solutions, each by a part of the evidence").columns(columns());
    for solution in &weighed.solutions {
        let cell = |si: Option<f64>| or_none(si.map(|si| units.format(Measure::RoadSpeed, si)));
        let name = words::solution(solution.by).to_owned();
        let figures = solution.speeds.into_iter().chain(solution.delta_v).map(cell);
        table.cells(std::iter::once(name).chain(figures));
        table.rows.push(Row::Detail(against(solution, weighed, analysis, units)));
    }
    table
}

/// The objections to a solution.
fn against(solution: &Solution, weighed: &Weighed, analysis: &Seen, units: Units) -> String {
    let mut reasons = Vec::new();
    let [speeds, changes] = solution.outside;
    let of = |what: &str, outside: [bool; 2]| {
        VehicleId::ALL
            .into_iter()
            .filter(|id| outside[id.index()])
            .map(|id| format!("{what} {id}"))
            .collect::<Vec<_>>()
    };
    let outside = [of("speed", speeds), of("ΔV", changes)].concat();
    // Without an answer there is no interval to lie outside of.
    if !outside.is_empty() && weighed.is_answer() {
        reasons.push(format!("outside the 95 % interval from all the evidence: {}", outside.join(", ")));
    }
    for id in VehicleId::ALL {
        let [found, given] = [solution.speeds, solution.differs_from].map(|speeds| speeds[id.index()]);
        if let (Some(found), Some(given)) = (found, given) {
            let [found, given] = [found, given].map(|si| units.format(Measure::RoadSpeed, si));
            reasons.push(format!("gives vehicle {id} {found}, but the case has {given}"));
        }
    }
    reasons.extend(takes(&solution.energies_shown));
    if weighed.why.takes_bound && solution.by.is_by_damage() {
        reasons.push("takes the crush energy for known, although it is only an upper bound".to_owned());
    }
    if solution.has_wrong_pdof {
        reasons.push("takes a PDOF as exact that the other evidence contradicts".to_owned());
    }
    if !solution.failed.is_empty() {
        reasons.push(format!("checks that fail: {}", refuted(analysis, units).join("; ")));
    }
    if solution.is_detailed && !weighed.why.left_aside.is_empty() {
        reasons.push(format!("does not use {}", weighed.why.left_aside.join(", ")));
    }
    if reasons.is_empty() {
        let compared = if weighed.is_answer() {
            "nothing contradicts it"
        } else {
            "it was not compared with the rest of the evidence"
        };
        format!("{compared}; it has no interval because its evidence is taken as exact")
    } else {
        format!("against it: {}", reasons.join("; "))
    }
}
