//! What a case asks for, and the numbers that answer it, on plain numbers and on those with derivatives.

use std::f64::consts::TAU;

use crash3::CrushError;
use inputs::{
    Case, CollisionData, Faults, GivenVehicle, Purpose, ReconstructionInput, RestData, VehicleMotion,
};
use pim_core::{Motion, Outcome, Real, Vector2, VehicleId};
use real::Traced;
use reconcile::{Implied, MomentumAndCrush, Problem, ReconcileError};
use trajectory::{Control, Target, to_start_near};

use crate::analysis::Analysis;
use crate::both::pose;
use crate::damage;
use crate::failure::Failure;
use crate::found::{Found, refused};
use crate::impact::collide;
use crate::speeds::BothMethod;
use crate::travel::{Followed, Record, TravelOrigin, Way, Ways, after_impact, departures, skid_speed};
use crate::vehicle::Vehicle;

/// What a case asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    /// One speed, by the crush energy.
    Speed,
    /// Both speeds, or one without damage, by how the vehicles left the impact.
    BothSpeeds,
    /// The outcome of the impact; both speeds are given.
    Impact,
    /// The motion after the impact, alone.
    Motion,
    /// The damage of one vehicle, alone.
    Damage,
}

impl Goal {
    /// A case with `[reconstruct]` asks for what that table names, a case with data after the impact and
    /// without `[impact]` for the motion, a case of one vehicle for its damage, and any other case for the
    /// impact.
    pub(crate) fn of<T>(case: &Case<T>) -> Self {
        match &case.reconstruct {
            Some(_) if case.is_by_momentum() => Self::BothSpeeds,
            Some(_) => Self::Speed,
            None if case.impact.is_none() && case.vehicles.iter().any(|vehicle| vehicle.after.is_some()) => {
                Self::Motion
            }
            None if case.vehicles.iter().any(GivenVehicle::is_absent) => Self::Damage,
            None => Self::Impact,
        }
    }

    /// The purpose of the analysis that answers it.
    pub(crate) fn purpose(self) -> Purpose {
        match self {
            Self::Speed | Self::BothSpeeds => Purpose::Reconstruct,
            Self::Impact => Purpose::Impact,
            Self::Motion => Purpose::Motion,
            Self::Damage => Purpose::Crush,
        }
    }

    /// What a case lacks for it.
    pub(crate) fn obstacle(self, case: &Case) -> Option<Faults> {
        match self {
            Self::Speed => case.reconstruction().err(),
            Self::BothSpeeds => case.two_speeds().err(),
            Self::Impact => case.collision().err(),
            Self::Motion => case.motion().err(),
            Self::Damage => case.damage().err(),
        }
    }
}

/// The answer from which the outputs of a case are read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer<T = f64> {
    /// (m/s) the speeds found.
    pub(crate) speeds: [Option<T>; 2],
    /// The impact.
    pub(crate) outcome: Option<Outcome<T>>,
    /// The implications of momentum, if it gave the speeds: the impact is then not that of a law.
    pub(crate) implied: Option<Implied<T>>,
    /// (m/s) the speed of each vehicle where its skid marks before the impact begin.
    pub(crate) skid_speeds: [Option<T>; 2],
    /// The path of each vehicle from the impact to rest.
    pub(crate) ways: [Option<Way<T>>; 2],
    /// The damage of one vehicle, if that is all the case asks for.
    pub(crate) crushed: [Option<Crushed<T>>; 2],
}

/// What the damage of a vehicle took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crushed<T> {
    /// (J) E.
    pub(crate) energy: T,
    /// (m/s) EES.
    pub(crate) ees: T,
}

impl<T: Real> Crushed<T> {
    fn of(vehicle: &Vehicle<T>) -> Option<Self> {
        Some(Self { energy: vehicle.crush_energy()?, ees: vehicle.ees()? })
    }
}

impl Answer {
    /// The answer of a finished analysis.
    pub(crate) fn of(analysis: &Analysis) -> Self {
        let mut speeds = [None; 2];
        if let Some(found) = &analysis.found {
            speeds[found.unknown.index()] = Some(found.speed);
        }
        if let Some(both) = &analysis.both {
            speeds = both.speeds.map(Some);
        }
        let way = |id: VehicleId| {
            let travel = analysis.travel[id.index()].as_ref()?;
            Some(Way { start: travel.start.motion, rest: travel.rest })
        };
        Self {
            speeds,
            outcome: analysis.impact.as_ref().map(|impact| impact.outcome),
            implied: analysis.both.as_ref().filter(|both| !both.is_by_crush()).map(|both| both.implied),
            skid_speeds: analysis.skids.map(|skid| skid.map(|skid| skid.speed)),
            ways: VehicleId::ALL.map(way),
            crushed: if analysis.is_of_damage {
                analysis.vehicles.each_ref().map(Crushed::of)
            } else {
                [None, None]
            },
        }
    }
}

impl<T: Real> Answer<T> {
    const NOTHING: Self = Self {
        speeds: [None, None],
        outcome: None,
        implied: None,
        skid_speeds: [None, None],
        ways: [None, None],
        crushed: [None, None],
    };

    /// (m/s) the speeds at the impact; `None` for a case that has no impact.
    fn speeds_at_impact(&self) -> Option<[T; 2]> {
        if let [Some(one), Some(two)] = self.speeds {
            return Some([one.abs(), two.abs()]);
        }
        Some(self.outcome.as_ref()?.before.map(|motion| length(motion.velocity)))
    }
}

/// The source of the numbers for which an equation has to be solved.
pub(crate) trait Solver<T: Real>: Ways<T> {
    /// The speed of a problem, and the impact at it.
    fn speed(&mut self, problem: &Problem<T>) -> Result<(T, Outcome<T>), Failure>;

    /// Whether the vehicles left as one body that did not turn, at the central values: with ranges the
    /// velocities of a sample differ.
    fn left_as_one(&self) -> bool;

    /// (m/s) both speeds, by momentum along a line and the crush energy.
    fn speeds(&mut self, search: &MomentumAndCrush<T>) -> Result<[T; 2], Failure>;
}

/// Answers a case.
///
/// The code for plain numbers and for those with derivatives is the same. Only the unknowns of an equation
/// differ: [`Search`] solves for them, whereas [`Known`] takes the solution and keeps the residual of the
/// equation.
pub(crate) fn answer<T: Real>(
    goal: Goal,
    case: &Case<T>,
    solver: &mut impl Solver<T>,
) -> Result<Answer<T>, Failure> {
    let answer = solved(goal, case, solver)?;
    let mut skid_speeds = [None, None];
    if let Some(speeds) = answer.speeds_at_impact() {
        for ((begin, given), speed) in skid_speeds.iter_mut().zip(case.skids()).zip(speeds) {
            *begin = given.and_then(|given| skid_speed(given, speed));
        }
    }
    Ok(Answer { skid_speeds, ..answer })
}

/// The answer without the skids.
fn solved<T: Real>(goal: Goal, case: &Case<T>, solver: &mut impl Solver<T>) -> Result<Answer<T>, Failure> {
    match goal {
        Goal::Speed => at(case, |problem| {
            let (speed, outcome) = solver.speed(problem)?;
            let mut speeds = [None; 2];
            speeds[problem.unknown.index()] = Some(speed);
            Ok(Answer { speeds, ..carried_on(case, outcome, solver)? })
        }),
        Goal::Impact => {
            let (_, outcome) = collide(&case.collision()?.collision)?;
            carried_on(case, outcome, solver)
        }
        Goal::BothSpeeds => both(case, solver),
        Goal::Motion => {
            let input = case.motion()?;
            let given = input.vehicles.each_ref().map(|way| way.as_ref().and_then(|way| way.velocity));
            let [(_, one), (_, two)] = departures(Some(&input), given, solver)?;
            Ok(Answer { ways: [one, two], ..Answer::NOTHING })
        }
        Goal::Damage => {
            let vehicles = damage::assess(case.damage()?.vehicles, [None, None])?;
            Ok(Answer { crushed: vehicles.each_ref().map(Crushed::of), ..Answer::NOTHING })
        }
    }
}

/// The problem that a case poses, with other numbers.
pub(crate) fn at<T: Real, R>(
    case: &Case<T>,
    evaluate: impl FnOnce(&Problem<T>) -> Result<R, Failure>,
) -> Result<R, Failure> {
    let problem = posed(case.reconstruction()?)?;
    problem.check()?;
    evaluate(&problem)
}

/// The equation for one speed.
pub(crate) fn posed<T: Real>(input: ReconstructionInput<T>) -> Result<Problem<T>, CrushError> {
    let ReconstructionInput { collision, unknown, basis } = input;
    let CollisionData { contact, law, motions, vehicles } = collision;
    Ok(Problem {
        contact,
        law,
        motions,
        unknown,
        crush_energy: damage::uncorrected(vehicles)?,
        basis: basis.energy(),
        tangential_share: basis.tangential_share(),
    })
}

/// An impact, and the paths to rest after it.
fn carried_on<T: Real>(
    case: &Case<T>,
    outcome: Outcome<T>,
    solver: &mut impl Solver<T>,
) -> Result<Answer<T>, Failure> {
    let ways = match case.run_out() {
        Some(input) => after_impact(&input?, outcome.after, solver)?,
        None => [None, None],
    };
    Ok(Answer { outcome: Some(outcome), ways, ..Answer::NOTHING })
}

fn both<T: Real>(case: &Case<T>, solver: &mut impl Solver<T>) -> Result<Answer<T>, Failure> {
    let mut posed = pose(case.two_speeds()?, solver)?;
    posed.one_velocity = solver.left_as_one();
    let speeds = match &posed.by_crush {
        Some(by_crush) => solver.speeds(&by_crush.search)?,
        None => posed.speeds()?,
    };
    let outcome = posed.impact(speeds).transpose()?.map(|(_, outcome)| outcome);
    let implied = match &posed.by_crush {
        Some(_) => None,
        None => Some(posed.implied(speeds)?.1),
    };
    Ok(Answer { speeds: speeds.map(Some), outcome, implied, ways: posed.ways, ..Answer::NOTHING })
}

/// Length of a vector, zero with zero derivatives where it vanishes.
pub(crate) fn length<T: Real>(vector: Vector2<T>) -> T {
    let square = vector.x * vector.x + vector.y * vector.y;
    if square > T::ZERO { square.sqrt() } else { T::ZERO }
}

/// Solves each equation, near to the solution at the central values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search {
    /// The starts that lead to the rest positions of the vehicles at the central values.
    near: [Option<Near>; 2],
    /// Whether they left straight towards their rests there.
    straight: [bool; 2],
    /// Whether they left as one body there.
    as_one: bool,
    /// (m/s) the speed there, if it is not that with the slowest approach.
    pub(crate) chosen: Option<f64>,
    /// Whether more than one pair of speeds has the momentum and the crush energy; only determined on
    /// request, because finding all speeds takes longer than finding one.
    pub(crate) several: Option<bool>,
}

/// A start that leads to a rest.
#[derive(Clone, Copy, Debug)]
struct Near {
    motion: Motion,
    /// (rad) heading at rest, full turns included.
    heading: f64,
}

impl Search {
    /// Beside the solutions of an analysis.
    pub(crate) fn near(analysis: &Analysis) -> Self {
        let near = |id: VehicleId| {
            let travel = analysis.travel[id.index()].as_ref()?;
            let is_found = travel.origin == TravelOrigin::Rest;
            is_found.then_some(Near { motion: travel.start.motion, heading: travel.rest.heading })
        };
        Self {
            near: VehicleId::ALL.map(near),
            straight: leave_straight(analysis),
            as_one: leave_as_one(analysis),
            chosen: analysis.found.as_ref().and_then(Found::chosen),
            several: None,
        }
    }
}

/// Whether both left as one body that did not turn.
fn leave_as_one(analysis: &Analysis) -> bool {
    analysis.both.as_ref().is_some_and(|both| both.one_velocity)
}

/// Which vehicles left straight towards their rests.
fn leave_straight(analysis: &Analysis) -> [bool; 2] {
    VehicleId::ALL.map(|id| {
        let travel = analysis.travel[id.index()].as_ref();
        travel.is_some_and(|travel| travel.origin == TravelOrigin::StraightRest)
    })
}

/// The speed (m/s) of a sample, and its impact: of several admissible speeds the one nearest to that `chosen`
/// at the central values, if one was.
pub(crate) fn speed_and_impact(
    problem: &Problem,
    chosen: Option<f64>,
) -> Result<(f64, Outcome), ReconcileError> {
    match chosen {
        None => problem.speed_and_impact(),
        Some(speed) => problem.solve_near(speed).map(|answer| (answer.speed, answer.outcome)),
    }
}

impl Solver<f64> for Search {
    fn left_as_one(&self) -> bool {
        self.as_one
    }

    fn speed(&mut self, problem: &Problem) -> Result<(f64, Outcome), Failure> {
        speed_and_impact(problem, self.chosen).map_err(|refusal| refused(problem, refusal))
    }

    fn speeds(&mut self, search: &MomentumAndCrush) -> Result<[f64; 2], Failure> {
        if self.several.is_some() {
            self.several = Some(search.speeds().take(2).count() > 1);
        }
        Ok(search.solve()?.speeds)
    }
}

impl Ways<f64> for Search {
    fn follow(&mut self, of: &Followed<'_>, start: Motion) -> Result<Way, Failure> {
        of.to_rest(start, &Control::default(), |_| {})
    }

    /// Near the solution at the central values: if two starts lead to the same rest position, one turning the
    /// short way and one the long way round, a slightly different sample takes the same one.
    fn back(&mut self, of: &Followed<'_>, rest: &RestData) -> Result<Way, Failure> {
        let (way, vehicle) = (of.way, of.vehicle);
        if self.straight[vehicle.index()] {
            return of.straight(rest);
        }
        let Some(near) = &self.near[vehicle.index()] else {
            return Record::of(TravelOrigin::Rest).back(of, rest);
        };
        let target = Target {
            heading: heading_at_rest(way, rest, near.heading),
            turns_known: true,
            via: None,
            ..of.target(rest)
        };
        let (steer, ground, control) = (way.steer.steer(), of.ground(), Control::default());
        let (place, heading, near) = (way.position, way.heading, &near.motion);
        to_start_near(&way.chassis, steer, &ground, place, heading, &target, &control, near)
            .map(|found| Way { start: found.motion, rest: found.rest })
            .map_err(|reason| Failure::NoStart { vehicle, reason })
    }
}

/// (rad) the heading at rest with its full turns; if the case does not give these, the heading is within half
/// a turn of `beside` (rad).
fn heading_at_rest<T: Real>(way: &VehicleMotion<T>, rest: &RestData<T>, beside: f64) -> T {
    let heading = rest.heading.heading(way.heading);
    if rest.heading.turns_are_known() {
        return heading;
    }
    // θ + 2π n
    let turns = ((beside - heading.value()) / TAU).round();
    heading + T::from(TAU * turns)
}

/// (SI) the solutions of the equations of an analysis, in the order in which [`Known`] needs them.
pub(crate) fn unknowns(analysis: &Analysis) -> Vec<f64> {
    let mut unknowns = Vec::new();
    let found = analysis.travel.iter().flatten().filter(|travel| travel.origin.is_by_rest());
    for Motion { velocity, yaw_rate } in found.map(|travel| travel.start.motion) {
        unknowns.extend([velocity.x, velocity.y, yaw_rate]);
    }
    unknowns.extend(analysis.found.as_ref().map(|found| found.speed));
    if let Some(BothMethod::MomentumAndCrush { relative_speed, .. }) =
        analysis.both.as_ref().map(|both| &both.method)
    {
        unknowns.push(*relative_speed);
    }
    unknowns
}

/// The integration of a path with derivatives that takes `time` (s): in steps until the vehicle rests, which
/// are far shorter than the path itself needs. The error of a path grows with the square of the steps that
/// meet a kink of the forces, but that of its derivatives with their length, and the search back from a rest
/// position magnifies it. Of 60 random motions on the level, the derivatives of the motion at the start by
/// the rest and by the radius of gyration then differ from those in steps of 0.5 ms by 0.006 % of their size
/// in the median and by 0.3 % at most; with the steps of the path by 0.3 % and 200 %.
fn differentiated(time: f64) -> Control {
    // A vehicle that rolls for minutes takes few more of them than one that spins to rest in five seconds.
    let longer = (time / 5.0).max(1.0);
    Control {
        tolerance: 1e-8 * longer * longer,
        longest_step: 0.005 * longer,
        most_steps: 200_000,
        closed_end: false,
        ..Control::default()
    }
}

/// Takes the solutions, and keeps the residual of each equation.
#[derive(Debug)]
pub(crate) struct Known<'a> {
    unknowns: std::slice::Iter<'a, Traced>,
    /// Whether the vehicles left straight towards their rests.
    straight: [bool; 2],
    /// Whether they left as one body.
    as_one: bool,
    /// (s) how long their paths to rest take.
    times: [f64; 2],
    /// As many as there are unknowns, each zero at the solution.
    pub(crate) residuals: Vec<Traced>,
}

impl<'a> Known<'a> {
    /// Beside the solutions of an analysis.
    pub(crate) fn new(unknowns: &'a [Traced], nominal: &Analysis) -> Self {
        Self {
            unknowns: unknowns.iter(),
            straight: leave_straight(nominal),
            as_one: leave_as_one(nominal),
            times: nominal.travel.each_ref().map(|travel| travel.as_ref().map_or(0.0, |way| way.rest.time)),
            residuals: Vec::new(),
        }
    }

    fn next(&mut self) -> Traced {
        self.unknowns.next().copied().unwrap_or(Traced::from(f64::NAN))
    }
}

impl Solver<Traced> for Known<'_> {
    fn left_as_one(&self) -> bool {
        self.as_one
    }

    fn speed(&mut self, problem: &Problem<Traced>) -> Result<(Traced, Outcome<Traced>), Failure> {
        let speed = self.next();
        let (_, outcome) = problem.impact(speed)?;
        self.residuals.push(problem.residual(speed));
        Ok((speed, outcome))
    }

    fn speeds(&mut self, search: &MomentumAndCrush<Traced>) -> Result<[Traced; 2], Failure> {
        let relative = self.next();
        self.residuals.push(search.problem().residual(relative));
        Ok(search.speeds_at(relative))
    }
}

impl Ways<Traced> for Known<'_> {
    fn follow(&mut self, of: &Followed<'_, Traced>, start: Motion<Traced>) -> Result<Way<Traced>, Failure> {
        of.to_rest(start, &differentiated(self.times[of.vehicle.index()]), |_| {})
    }

    fn back(&mut self, of: &Followed<'_, Traced>, rest: &RestData<Traced>) -> Result<Way<Traced>, Failure> {
        let way = of.way;
        let velocity = Vector2::new(self.next(), self.next());
        let start = Motion { velocity, yaw_rate: self.next() };
        let found = self.follow(of, start)?.rest;
        if self.straight[of.vehicle.index()] {
            // V along the line to the rest, no yaw, and a path as long as the measured one
            let apart = rest.position - way.position;
            self.residuals.extend([
                velocity.x * apart.y - velocity.y * apart.x,
                start.yaw_rate,
                length(found.position - way.position) - length(apart),
            ]);
            return Ok(Way { start, rest: found });
        }
        let heading = heading_at_rest(way, rest, found.heading.value());
        self.residuals.extend([
            found.position.x - rest.position.x,
            found.position.y - rest.position.y,
            found.heading - heading,
        ]);
        Ok(Way { start, rest: found })
    }
}
