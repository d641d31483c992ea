//! How sensitive the answer is to each input: exact derivatives, and a sweep of the direction of force.

use crash3::{ObliqueCorrection, principal_angle};
use inputs::{Axes, Case, Dimension, EstimatedInput, Input, Origin};
use pim_core::{ImpactError, Vector2, VehicleId};
use real::Gradient;
use reconcile::{Momentum, point_masses};

use crate::analysis::Analysis;
use crate::damage::{self, Crash3};
use crate::failure::Failure;
use crate::goal::{self, Goal, Known};
use crate::output::Output;
use crate::quantities::{DELTA_V, SKID_SPEED, SPEED};
use crate::solve;
use crate::speeds::BothMethod;
use crate::vehicle::Vehicle;
use crate::warning::Warning;

/// (rad) 1°.
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// (m) 10 cm, 1 % of a path of 10 m.
const DECIMETRE: f64 = 0.1;
/// (m) 1 cm, about 1 % of the distance from the CG to the face of a car.
const CENTIMETRE: f64 = 0.01;

/// The sensitivity of an answer.
#[derive(Debug)]
pub struct Sensitivity {
    /// The answer itself.
    pub nominal: Analysis,
    /// The derivatives of a reconstruction and of the paths to rest, for each output from the most to the
    /// least influential input; empty for a case without `[reconstruct]` whose vehicles are not followed to
    /// rest.
    pub derivatives: Vec<Derivative>,
    /// CRASH3's answer for rotated directions of force, in ascending order; empty if the damage or the PDOF
    /// of a vehicle is unknown.
    pub pdof_sweep: Vec<SweepRow>,
}

/// ∂(output)/∂(input), all other inputs as given.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivative {
    /// The output.
    pub output: Output,
    /// (SI) the value of the output.
    pub output_value: f64,
    /// The input.
    pub input: Input,
    /// (SI per SI) the derivative.
    pub value: f64,
}

impl Derivative {
    /// Per cent per per cent: ∂(ln output)/∂(ln input). `None` for an angle and for a coordinate of the
    /// scene, because their zero is arbitrary, and for an input of zero.
    #[must_use]
    pub fn relative(&self) -> Option<f64> {
        // (x/y) ∂y/∂x
        (!self.is_by_angle() && !self.is_by_coordinate() && self.input.number != 0.0)
            .then(|| self.value * self.input.si() / self.output_value)
    }

    /// The relative change of the output for 1 % of the input, for 1° of an angle, for 10 cm of a coordinate
    /// of the scene, or for 1 cm by which a contact point that was placed is moved. It ranks inputs of every
    /// kind.
    #[must_use]
    pub fn influence(&self) -> f64 {
        if self.is_by_angle() {
            self.value * DEGREE / self.output_value
        } else if matches!(self.input.origin, Origin::Estimate(EstimatedInput::Contact { .. })) {
            self.value * CENTIMETRE / self.output_value
        } else if self.is_by_coordinate() {
            self.value * DECIMETRE / self.output_value
        } else {
            self.relative().unwrap_or_default() / 100.0
        }
    }

    /// Whether the input is a coordinate of the scene, whose origin the case chose.
    fn is_by_coordinate(&self) -> bool {
        let path = self.input.path.as_str();
        let is_of_vehicle = [".contact.", ".recorder."].iter().any(|part| path.contains(part));
        let is_length = self.input.unit.is_some_and(|unit| unit.dimension() == Dimension::Length);
        let is_of_scene = path.starts_with("scene.") || !is_of_vehicle;
        is_length && is_of_scene && (path.ends_with(".x") || path.ends_with(".y"))
    }

    fn is_by_angle(&self) -> bool {
        self.input.unit.is_some_and(|unit| unit.dimension() == Dimension::Angle)
    }
}

/// CRASH3's answer for one rotated direction of force.
#[derive(Clone, Debug)]
pub struct SweepRow {
    /// (rad) rotation of the line of action about its points, in the sense of the axes of the case:
    /// counter-clockwise, or clockwise in z-down axes.
    pub change: f64,
    /// (rad) PDOF of both vehicles; `None` for a fixed object.
    pub pdof: [Option<f64>; 2],
    /// (rad) α of both vehicles; `None` for a fixed object. An angle that the file gives rotates with the
    /// force.
    pub oblique_angle: [Option<f64>; 2],
    /// CRASH3's answer with the angles and arms of that direction; an arm that the file gives is kept.
    pub crash3: Crash3,
}

/// The directions of a sweep: `steps` of `step` (rad) to each side of the nominal one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// (rad) from one direction to the next.
    pub step: f64,
    /// The number of steps to each side.
    pub steps: u32,
}

impl Default for Sweep {
    /// Two steps of 5° to each side.
    fn default() -> Self {
        Self { step: 5_f64.to_radians(), steps: 2 }
    }
}

/// As [`sensitivity`](crate::sensitivity()).
pub(crate) fn sensitivity(case: &Case, sweep: Sweep) -> Result<Sensitivity, Failure> {
    let goal = Goal::of(case);
    let nominal = match goal {
        Goal::Motion | Goal::Damage => goal.solve(case)?,
        _ => solve::furthest(case)?,
    };
    let has_ways = nominal.travel.iter().any(Option::is_some);
    let has_skids = nominal.skids.iter().any(Option::is_some);
    let is_differentiated = nominal.is_reconstruction() || has_ways || has_skids || nominal.is_of_damage;
    let derivatives = if is_differentiated { derivatives(case, &nominal)? } else { Vec::new() };
    let pdof_sweep = pdof_sweep(&nominal, sweep, case.axes)?;
    Ok(Sensitivity { nominal, derivatives, pdof_sweep })
}

fn derivatives(case: &Case, nominal: &Analysis) -> Result<Vec<Derivative>, Failure> {
    let is_shown = |output: &Output| {
        [&SPEED, &DELTA_V, &SKID_SPEED].into_iter().any(|shown| output.is(shown))
            || output.quantity().is_of_path()
            || output.quantity().is_of_damage()
    };
    let outputs: Vec<Output> = Output::of(nominal, case.axes).into_iter().filter(is_shown).collect();
    let gradients = gradients(case, nominal, &outputs)?;
    let mut derivatives = Vec::new();
    for (i, input) in case.variables().into_iter().enumerate() {
        for (&output, gradient) in outputs.iter().zip(&gradients) {
            let (output_value, value) = (gradient.value, gradient.by[i]);
            derivatives.push(Derivative { output, output_value, input: input.clone(), value });
        }
    }
    // The effect of a shared error follows from the rows of the numbers that share it.
    derivatives.retain(|derivative| !matches!(derivative.input.origin, Origin::Shared(_)));
    // A relative change of zero is undefined.
    derivatives.retain(|derivative| derivative.output_value != 0.0);
    let order = |output: Output| outputs.iter().position(|other| *other == output);
    derivatives.sort_by(|a, b| {
        let influence = b.influence().abs().total_cmp(&a.influence().abs());
        order(a.output).cmp(&order(b.output)).then(influence)
    });
    Ok(derivatives)
}

/// (–) the largest change of a speed by one degree of an angle that raises no warning, as a share of that
/// speed.
pub const MOST_BY_DEGREE: f64 = 0.1;
/// (m/s) a change by one degree that is no larger than this never raises a warning.
pub const LEAST_BY_DEGREE: f64 = 1.0;

/// Warns of the angle without a range on which a speed that was found depends most, if one degree changes it
/// considerably.
pub(crate) fn hangs_on_angle(case: &Case, analysis: &Analysis) -> Option<Warning> {
    if !analysis.is_reconstruction() {
        return None;
    }
    // Derivatives through a search back from rest take long, and the impact passes on only its directions.
    if analysis.travel.iter().any(Option::is_some) {
        return hangs_on_direction(case, analysis);
    }
    let is_exact = |derivative: &Derivative| {
        let input = &derivative.input;
        let is_given = !matches!(input.origin, Origin::Estimate(_));
        derivative.is_by_angle() && is_given && !case.ranges.iter().any(|range| range.path == input.path)
    };
    let derivatives = derivatives(case, analysis).ok()?.into_iter();
    let of_speeds = derivatives.filter(|derivative| derivative.output.is(&SPEED) && is_exact(derivative));
    let of_degree = of_speeds.filter_map(|derivative| {
        let change = (derivative.value * DEGREE).abs();
        Some((derivative.output.vehicle()?, derivative.input.path, change, derivative.output_value))
    });
    most_by_degree(of_degree)
}

/// The warning of the greatest of some changes (m/s) of a speed (m/s) by one degree.
fn most_by_degree(changes: impl Iterator<Item = (VehicleId, String, f64, f64)>) -> Option<Warning> {
    let (vehicle, path, change, speed) = changes.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let is_large = change > LEAST_BY_DEGREE && change > MOST_BY_DEGREE * speed.abs();
    is_large.then_some(Warning::HangsOnAngle { vehicle, path, change, speed })
}

/// As [`hangs_on_angle`], for speeds by momentum alone, and the headings and the directions in which the
/// vehicles left the impact towards their rests.
fn hangs_on_direction(case: &Case, analysis: &Analysis) -> Option<Warning> {
    let both = analysis.both.as_ref().filter(|both| both.method == BothMethod::Momentum)?;
    let [Some(one), Some(two)] = case.courses() else { return None };
    let momentum = &both.momentum;
    let total = momentum.total();
    let masses = momentum.contact.participants().each_ref().map(|one| one.body().mass());
    // Point masses have the heading of their course.
    let on_courses = |courses: [f64; 2]| {
        let contact = point_masses(masses.map(Some), courses, courses).ok()?;
        Some(Momentum { contact, ..*momentum }.speeds_with(total))
    };
    let is_exact = |path: &str| !case.ranges.iter().any(|range| range.path.starts_with(path));
    let found = momentum.speeds_with(total);
    let mut changes = Vec::new();
    for id in VehicleId::ALL {
        let mut courses = [one, two];
        courses[id.index()] += DEGREE;
        let own = momentum.after[id.index()].velocity * masses[id.index()];
        let departing = momentum.speeds_with(total + Vector2::new(-own.y, own.x) * DEGREE);
        let after = case.vehicles[id.index()].after.as_ref();
        let departs =
            if after.is_some_and(|after| after.rest.is_some()) { "after.rest" } else { "after.direction" };
        for (key, changed) in [("heading", on_courses(courses)), (departs, Some(departing))] {
            let path = format!("vehicle{id}.{key}");
            let Some(changed) = changed.filter(|_| is_exact(&path)) else { continue };
            for of in VehicleId::ALL {
                let change = (changed[of.index()] - found[of.index()]).abs();
                changes.push((of, path.clone(), change, both.speeds[of.index()]));
            }
        }
    }
    most_by_degree(changes.into_iter())
}

/// Each output, and its derivatives by all variables of the case (SI per SI).
pub(crate) fn gradients(
    case: &Case,
    nominal: &Analysis,
    outputs: &[Output],
) -> Result<Vec<Gradient>, Failure> {
    let inputs = case.variables();
    let mut numbers: Vec<f64> = inputs.iter().map(|input| input.number).collect();
    // The unknowns of the equations are inputs too: the last ones.
    numbers.extend(goal::unknowns(nominal));
    let mut gradients = real::gradients(&numbers, |numbers| {
        let (numbers, unknowns) = numbers.split_at(inputs.len());
        let case = case.with_numbers(numbers.to_vec());
        let mut known = Known::new(unknowns, nominal);
        let answer = goal::answer(Goal::of(&case), &case, &mut known)?;
        let results = outputs.iter().map(|output| output.traced(&answer, case.axes));
        Ok::<_, Failure>(results.chain(known.residuals).collect())
    })?;
    let residuals = gradients.split_off(outputs.len());
    if !residuals.is_empty() {
        let unknowns_by_inputs = unknowns_by_inputs(residuals, inputs.len());
        for gradient in &mut gradients {
            let through = gradient.by.split_off(inputs.len());
            for (through, by_inputs) in through.iter().zip(&unknowns_by_inputs) {
                for (by, unknown_by_input) in gradient.by.iter_mut().zip(by_inputs) {
                    // dy/dp = ∂y/∂p + Σ (∂y/∂x) dx/dp
                    *by += through * unknown_by_input;
                }
            }
        }
    }
    for gradient in &mut gradients {
        for (by, input) in gradient.by.iter_mut().zip(&inputs) {
            // The numbers are in the units of the file.
            *by /= input.factor();
            if !by.is_finite() {
                return Err(ImpactError::Overflow { what: "derivative", value: *by }.into());
            }
        }
    }
    Ok(gradients)
}

/// How the unknowns x that make residuals R(x, p) zero follow the inputs p, dx/dp = −(∂R/∂x)⁻¹ ∂R/∂p: a row
/// for each unknown.
///
/// Gauss's elimination with scaled partial pivoting: some residuals are lengths, and some are energies. A
/// result that cannot be solved for is not finite.
fn unknowns_by_inputs(residuals: Vec<Gradient>, inputs: usize) -> Vec<Vec<f64>> {
    // Of each residual, its derivatives by the unknowns and by the inputs.
    let mut rows: Vec<(Vec<f64>, Vec<f64>)> = residuals
        .into_iter()
        .map(|Gradient { mut by, .. }| {
            let by_unknowns = by.split_off(inputs);
            (by_unknowns, by)
        })
        .collect();
    let count = rows.len();
    for column in 0..count {
        let size = |(row, _): &(Vec<f64>, Vec<f64>)| {
            let largest = row.iter().skip(column).fold(0.0, |largest: f64, by| largest.max(by.abs()));
            if largest > 0.0 { row[column].abs() / largest } else { 0.0 }
        };
        let pivot = (column..count).max_by(|a, b| size(&rows[*a]).total_cmp(&size(&rows[*b])));
        rows.swap(column, pivot.unwrap_or(column));
        let (above, below) = rows.split_at_mut(column + 1);
        let (pivot, right) = &above[column];
        for (row, row_right) in below {
            let factor = row[column] / pivot[column];
            if factor != 0.0 {
                for (by, pivot) in row.iter_mut().zip(pivot).chain(row_right.iter_mut().zip(right)) {
                    *by -= factor * pivot;
                }
            }
        }
    }
    // dx/dp, the last row first.
    let mut solved: Vec<Vec<f64>> = Vec::new();
    for (place, (row, mut right)) in rows.into_iter().enumerate().rev() {
        for (later, solution) in row[place + 1..].iter().zip(solved.iter().rev()) {
            for (right, solution) in right.iter_mut().zip(solution) {
                *right += later * solution;
            }
        }
        for right in &mut right {
            // dx_i/dp = −(∂R_i/∂p + Σ (∂R_i/∂x_j) dx_j/dp)/(∂R_i/∂x_i), j > i
            *right = -(*right / row[place]);
        }
        solved.push(right);
    }
    solved.reverse();
    solved
}

fn pdof_sweep(nominal: &Analysis, sweep: Sweep, axes: Axes) -> Result<Vec<SweepRow>, Failure> {
    let mut rows = Vec::new();
    if nominal.crash3.is_none() {
        return Ok(rows);
    }
    let nominal_pdof = nominal.vehicles.each_ref().map(Vehicle::crash3_pdof);
    let restitution = nominal.impact.as_ref().map(|impact| impact.law.restitution());
    let steps = i64::from(sweep.steps);
    for step in -steps..=steps {
        #[expect(clippy::cast_precision_loss, reason = "a u32 is exact in f64")]
        let change = step as f64 * sweep.step;
        // A line of action that turns counter-clockwise turns both PDOFs, which count clockwise, the other
        // way.
        let turned = |angle: f64| principal_angle(angle - axes.lateral(change));
        let pdof = nominal_pdof.map(|pdof| pdof.map(turned));
        let mut subjects = nominal.vehicles.each_ref().map(|vehicle| vehicle.subject.clone());
        for (subject, pdof) in subjects.iter_mut().zip(pdof) {
            let is_open = subject.energy.is_some() && subject.force.moment_arm.is_none();
            if is_open && (pdof.is_none() || subject.contact.is_none()) {
                return Ok(Vec::new());
            }
            subject.force.pdof = pdof;
            let Some(damage) = &mut subject.damage else { continue };
            // Without a PDOF, or without a point that the force acts through, there is nothing to turn.
            if pdof.is_none() || (subject.contact.is_none() && damage.face.is_none()) {
                return Ok(Vec::new());
            }
            // α = PDOF − PDOF of a square hit: an α in the file thus determines how the damaged surface is
            // oriented, which does not turn with the force. A given arm stays, because no point is known from
            // which to compute it for another direction.
            damage.oblique_angle = damage.oblique_angle.map(turned);
        }
        let vehicles = damage::assess(subjects, [None, None])?;
        let oblique_angle = vehicles
            .each_ref()
            .map(|vehicle| vehicle.damage.as_ref().and_then(|damage| damage.oblique_angle));
        if let Some(crash3) = damage::crash3(&vehicles, nominal.basis.energy(), restitution)? {
            rows.push(SweepRow { change, pdof, oblique_angle, crash3 });
        }
    }
    Ok(rows)
}

impl SweepRow {
    /// The row of one correction for oblique forces; none if a force does not push on its damaged side.
    #[must_use]
    pub fn corrected(&self, correction: ObliqueCorrection) -> Option<[f64; 2]> {
        let mut rows = self.crash3.corrections.iter();
        rows.find(|row| row.corrections == [correction; 2]).map(|row| row.delta_v)
    }
}
