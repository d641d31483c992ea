//! Densities of an estimate, both speeds at once, and the rest positions of the draws.

use ::drawing::{
    Axis, DensityPicture, Drawing, Footprint, FoundAtRest, JointPicture, RestsPicture, ValueMark,
};
use ::estimate::DrawsSummary;
use analysis::quantities::{REST_X, REST_Y, SPEED};
use analysis::{Estimated, EstimatedOutput, Output};
use case::{Case, Dimensions, VehicleKind};
use pim_core::{Real, VehicleId};

use super::vehicle::{name_of, shape};
use super::{scale_unit, title};
use crate::document::Undrawn;
use crate::estimates::Asked;
use crate::outputs::{label, pictured};
use crate::units::{Measure, Units, grouped, number};

/// Points of a curve, and places of a grid along each axis.
const POINTS: usize = 240;
const PLACES: usize = 96;
/// Maximum number of draws in a picture.
const SHOWN: usize = 1200;
/// (–) ratio of the bandwidth of a biweight kernel to that of a normal one that smooths as much.
const BIWEIGHT: f64 = 2.62;

/// The data that reproduce the numbers.
fn origin(case: &Case, estimated: &Estimated, asked: &Asked) -> String {
    format!(
        "{}. deltav {}, {} draws, seed {}",
        title(case),
        env!("CARGO_PKG_VERSION"),
        grouped(estimated.posterior.count()),
        asked.plan.seed
    )
}

/// The density of a result, before the evidence and after it. `None` if it does not vary, or if the run has
/// not converged.
#[must_use]
pub fn density(
    case: &Case,
    estimated: &Estimated,
    asked: &Asked,
    output: Output,
    units: Units,
) -> Option<Drawing> {
    Some(density_picture(case, estimated, asked, output, units)?.draw())
}

fn density_picture(
    case: &Case,
    estimated: &Estimated,
    asked: &Asked,
    output: Output,
    units: Units,
) -> Option<DensityPicture> {
    let found = answer(estimated, output)?;
    let draws = estimated.draws(output)?;
    let before = estimated.draws_before(output);
    let summary = &found.posterior;
    let own = curve(draws, estimated.ess(), None)?;
    let ends = [own.first()?[0], own.last()?[0]];
    // Only as much of the prior as leaves the curve of the answer wide enough.
    let wide = before.zip(found.prior.as_ref()).map(|(draws, prior)| {
        let [low, high] = [prior.intervals[2].low.value, prior.intervals[2].high.value];
        let most = 1.5 * (ends[1] - ends[0]);
        (draws, [ends[0].min(low).max(ends[0] - most), ends[1].max(high).min(ends[1] + most)])
    });
    let before = wide.and_then(|(draws, ends)| curve(draws, estimated.ess(), Some(ends)));
    let stationary = match 100.0 * stationary(draws) {
        share if share > 0.0 => {
            format!(", without the {} % for a stationary vehicle", number(share, usize::from(share < 1.0)))
        }
        _ => String::new(),
    };
    let measure = pictured(output);
    let unit = units.size(measure);
    let label = label(output, measure, units);
    let decimals = if measure == Measure::Ratio { 3 } else { units.decimals(measure).min(1) };
    let [low, high] = [summary.intervals[3].low.value, summary.intervals[3].high.value];
    let mark = |value: f64, lead: &str| ValueMark { value, lead: lead.to_owned() };
    let per = match units.name(measure) {
        "" => String::new(),
        unit => format!(" per {unit}"),
    };
    // Per unit of the reader, in per cent.
    let share = 0.01 / unit;
    Some(DensityPicture {
        name: "density",
        subtitle: format!(
            "How probable each value is, before the evidence and after it{stationary}\n{}",
            origin(case, estimated, asked)
        ),
        description: format!(
            "{label}: how probable each value is, given all evidence{stationary}. 95 % interval and median:"
        ),
        across: Axis { title: label.clone(), unit },
        title: label,
        decimals,
        upward: Axis { title: format!("%{per}"), unit: share },
        before: before.unwrap_or_default(),
        after: own,
        interval: [mark(low, "2.5 %:"), mark(high, "97.5 %:")],
        median: mark(summary.median.value, "median:"),
        legend: ["before the evidence", "by all evidence", "ends of the 95 % interval", "median"]
            .map(str::to_owned),
    })
}

/// A result that varies, of a run that has converged.
fn answer(estimated: &Estimated, output: Output) -> Option<&EstimatedOutput> {
    estimated.output(output).filter(|found| estimated.doubts().is_empty() && found.varies())
}

/// (–) the share of draws that are exactly zero: speeds of a stationary vehicle.
#[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
fn stationary(draws: &[f64]) -> f64 {
    draws.iter().filter(|draw| **draw == 0.0).count() as f64 / draws.len() as f64
}

/// (unit of the draws) the reach of a kernel for sorted draws that are worth `independent` independent ones.
fn bandwidth(sorted: &[f64], independent: f64, power: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
    let count = sorted.len() as f64;
    let mean = sorted.iter().sum::<f64>() / count;
    let square = sorted.iter().map(|draw| (draw - mean) * (draw - mean)).sum::<f64>() / count;
    let at = |quarter: usize| sorted[(sorted.len() - 1) * quarter / 4];
    let spread = Real::min(Real::sqrt(square), (at(3) - at(1)) / 1.349);
    // Silverman's rule of thumb.
    BIWEIGHT * 0.9 * spread * Real::power(Real::max(independent, 2.0), power)
}

/// (–) the biweight kernel, 15/16 (1 − u²)².
fn kernel(u: f64) -> f64 {
    let rest = 1.0 - u * u;
    if rest > 0.0 { 0.9375 * rest * rest } else { 0.0 }
}

/// The density of the draws that are not zero; between their extremes, or in a range.
fn curve(draws: &[f64], ess: f64, ends: Option<[f64; 2]>) -> Option<Vec<[f64; 2]>> {
    let mut sorted: Vec<f64> = draws.iter().copied().filter(|draw| *draw != 0.0).collect();
    if sorted.is_empty() {
        return None;
    }
    sorted.sort_by(f64::total_cmp);
    let reach = bandwidth(&sorted, ess * (1.0 - stationary(draws)), -0.2);
    if !(reach.is_finite() && reach > 0.0) {
        return None;
    }
    let at = |share: usize| sorted.get((sorted.len() - 1) * share / 1000).copied();
    let [low, high] = match ends {
        Some(ends) => ends,
        None => [at(1)? - reach, at(999)? + reach],
    };
    #[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
    let (steps, count) = ((POINTS - 1) as f64, draws.len() as f64);
    // If no draw is below zero, the part of a kernel below zero is reflected.
    let is_bounded = sorted.first().is_some_and(|least| *least >= 0.0);
    let low = if is_bounded { low.max(0.0) } else { low };
    let density = |x: f64| -> f64 {
        let near = sorted.partition_point(|draw| *draw < x - reach);
        let within = sorted[near..].iter().take_while(|draw| **draw < x + reach);
        within.map(|draw| kernel((x - draw) / reach)).sum()
    };
    let points = (0..POINTS).map(|k| {
        #[expect(clippy::cast_precision_loss, reason = "some hundred points")]
        let x = low + (high - low) * k as f64 / steps;
        let sum = density(x) + if is_bounded { density(-x) } else { 0.0 };
        [x, sum / (count * reach)]
    });
    Some(points.collect())
}

/// Both speeds at once. `None` if one of them is known, or if the run has not converged.
fn joint_picture(case: &Case, estimated: &Estimated, asked: &Asked, units: Units) -> Option<JointPicture> {
    let outputs = VehicleId::ALL.map(|vehicle| SPEED.of_vehicle(vehicle));
    let [one, two] = outputs.map(|output| answer(estimated, output));
    let summaries = [&one?.posterior, &two?.posterior];
    let [first, second] = outputs.map(|output| estimated.draws(output));
    let columns = [first?, second?];
    // The regions are those of the draws in which both vehicles move.
    let both = || columns[0].iter().zip(columns[1]).filter(|(x, y)| **x != 0.0 && **y != 0.0);
    let moving: [Vec<f64>; 2] = [both().map(|(x, _)| *x).collect(), both().map(|(_, y)| *y).collect()];
    #[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
    let share = moving[0].len() as f64 / columns[0].len() as f64;
    let sorted = moving.each_ref().map(|column| {
        let mut sorted = column.clone();
        sorted.sort_by(f64::total_cmp);
        sorted
    });
    let last = sorted[0].len().checked_sub(1)?;
    let reaches = sorted.each_ref().map(|sorted| bandwidth(sorted, share * estimated.ess(), -1.0 / 6.0));
    let ends = [0, 1].map(|axis| {
        let [low, high] = [2, 998].map(|part| sorted[axis][last * part / 1000]);
        let [low, high] = [low - reaches[axis], high + reaches[axis]];
        // A stationary vehicle lies within.
        if stationary(columns[axis]) > 0.0 {
            [low.min(-0.02 * high), high.max(0.02 * -low)]
        } else {
            [low, high]
        }
    });
    let grid = Grid::of([&moving[0], &moving[1]], reaches, ends);
    let mut at_draws: Vec<f64> = both().map(|(x, y)| grid.density([*x, *y])).collect();
    at_draws.sort_by(f64::total_cmp);
    let of_moving = if share < 1.0 { " in which both move" } else { "" };
    let is_inside =
        |draw: &[f64; 2]| (0..2).all(|axis| ends[axis][0] < draw[axis] && draw[axis] < ends[axis][1]);
    let step = columns[0].len().div_ceil(SHOWN).max(1);
    let draws = columns[0].iter().zip(columns[1]).step_by(step).map(|(x, y)| [*x, *y]);
    let axis = |output| Axis {
        title: label(output, Measure::RoadSpeed, units),
        unit: units.size(Measure::RoadSpeed),
    };
    let speed = |summary: &DrawsSummary| units.format(Measure::RoadSpeed, summary.median.value);
    Some(JointPicture {
        name: "joint-speeds",
        title: "Both speeds".to_owned(),
        subtitle: format!("Which speeds go together\n{}", origin(case, estimated, asked)),
        description: format!(
            "Draws of both speeds, around {} of vehicle 1 and {} of vehicle 2, with the regions that hold half and \
             95 % of those{of_moving}.",
            speed(summaries[0]),
            speed(summaries[1])
        ),
        across: axis(outputs[0]),
        upward: axis(outputs[1]),
        ends,
        draws: draws.filter(is_inside).collect(),
        levels: [at_draws[last / 2], at_draws[last / 20]],
        density: grid.rows,
        legend: [
            "draws".to_owned(),
            format!("region that holds 50 % of those{of_moving}"),
            "region that holds 95 %".to_owned(),
        ],
    })
}

/// A density on an equally spaced grid.
struct Grid {
    rows: Vec<Vec<f64>>,
    ends: [[f64; 2]; 2],
}

#[expect(clippy::cast_precision_loss, reason = "a grid of some hundred places")]
const LAST: f64 = (PLACES - 1) as f64;

impl Grid {
    fn of(columns: [&[f64]; 2], reaches: [f64; 2], ends: [[f64; 2]; 2]) -> Self {
        let mut rows = vec![vec![0.0; PLACES]; PLACES];
        let steps = ends.map(|[low, high]| (high - low) / LAST);
        for (x, y) in columns[0].iter().zip(columns[1]) {
            let at = [*x, *y];
            let [across, upward] = [0, 1].map(|axis| {
                let place = |value: f64| place(value, ends[axis], steps[axis]);
                let (from, to) = (place(at[axis] - reaches[axis]), place(at[axis] + reaches[axis]));
                (from..=to.min(PLACES - 1)).map(move |k| {
                    #[expect(clippy::cast_precision_loss, reason = "a grid of some hundred places")]
                    let value = ends[axis][0] + steps[axis] * k as f64;
                    (k, kernel((value - at[axis]) / reaches[axis]))
                })
            });
            let across: Vec<(usize, f64)> = across.collect();
            for (j, weight) in upward {
                for (i, other) in &across {
                    rows[j][*i] += weight * other;
                }
            }
        }
        Self { rows, ends }
    }

    /// The density at the nearest place of the grid.
    fn density(&self, at: [f64; 2]) -> f64 {
        let [i, j] = [0, 1].map(|axis| {
            let [low, high] = self.ends[axis];
            let step = (high - low) / LAST;
            place(at[axis] + 0.5 * step, self.ends[axis], step).min(PLACES - 1)
        });
        self.rows[j][i]
    }
}

/// The last place that is not above a value; the first where the value is below all.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cut to the places of a grid")]
fn place(value: f64, [low, _]: [f64; 2], step: f64) -> usize {
    ((value - low) / step).floor().clamp(0.0, LAST) as usize
}

/// The rest positions of the vehicles in the draws, and the measured ones. `None` if none is followed, or if
/// the run has not converged.
fn rests_picture(case: &Case, estimated: &Estimated, asked: &Asked, units: Units) -> Option<RestsPicture> {
    let subjects = case.subjects();
    let vehicles = VehicleId::ALL.into_iter().filter_map(|vehicle| {
        let axes = case.axes;
        let x = estimated.draws(REST_X.of_vehicle(vehicle))?;
        let y = estimated.draws(REST_Y.of_vehicle(vehicle))?;
        let step = x.len().div_ceil(SHOWN / 2).max(1);
        let draws = x.iter().zip(y).step_by(step).map(|(x, y)| [*x, axes.lateral(*y)]).collect();
        let measured = estimated.observed.vehicles[vehicle.index()].rest;
        let (sin, cos) = Real::sin_cos(measured.map_or(0.0, |rest| rest.heading));
        let given = &case.vehicles[vehicle.index()];
        let dimensions = subjects[vehicle.index()].as_ref().and_then(|subject| subject.dimensions);
        let found = FoundAtRest {
            label: name_of(vehicle, given),
            footprint: dimensions.map(|dimensions| footprint(dimensions, given.kind.unwrap_or_default())),
            position: measured.map(|rest| [rest.position.x, rest.position.y]),
            forward: [cos, sin],
            draws,
            legend: format!("rest of vehicle {vehicle} in the draws"),
        };
        Some((vehicle.index(), found))
    });
    let vehicles: Vec<(usize, FoundAtRest)> = vehicles.collect();
    if vehicles.is_empty() || !estimated.doubts().is_empty() {
        return None;
    }
    let impact = case.contact_place().map_or([0.0; 2], Into::into);
    Some(RestsPicture {
        name: "rests",
        title: "Rest positions".to_owned(),
        subtitle: format!(
            "Where the vehicles come to rest in the draws, and where they were found\n{}",
            origin(case, estimated, asked)
        ),
        description:
            "Dots where each draw comes to rest, around the outlines of the vehicles where they were \
                      found."
                .to_owned(),
        impact,
        vehicles,
        scale: scale_unit(units, Measure::Length),
    })
}

fn footprint(dimensions: Dimensions, kind: VehicleKind) -> Footprint {
    let Dimensions { length, width, cg_to_front, .. } = dimensions;
    Footprint { length, width, cg_to_front, shape: shape(kind) }
}

/// All pictures of an estimate, one below the other. `None` if no result varies, or if the run has not
/// converged.
#[must_use]
pub fn estimate_pictures(case: &Case, estimated: &Estimated, asked: &Asked, units: Units) -> Option<Drawing> {
    let drawings: Vec<(String, Drawing)> = all(case, estimated, asked, units)
        .into_iter()
        .map(|(name, drawing)| (name, drawing.draw()))
        .collect();
    (!drawings.is_empty()).then(|| Drawing::stacked("estimate", title(case), &drawings))
}

/// All pictures of an estimate, in the order of a report: the speeds one by one, both at once, and the rests.
pub(crate) fn all(case: &Case, estimated: &Estimated, asked: &Asked, units: Units) -> Vec<(String, Undrawn)> {
    let speeds = VehicleId::ALL.into_iter().filter_map(|vehicle| {
        let output = SPEED.of_vehicle(vehicle);
        let picture = density_picture(case, estimated, asked, output, units)?;
        Some((format!("density-speed-{vehicle}"), Undrawn::new(move || picture.draw())))
    });
    let both = joint_picture(case, estimated, asked, units)
        .map(|picture| ("joint-speeds".to_owned(), Undrawn::new(move || picture.draw())));
    let rests = rests_picture(case, estimated, asked, units)
        .map(|picture| ("rests".to_owned(), Undrawn::new(move || picture.draw())));
    speeds.chain(both).chain(rests).collect()
}
