//! Chooses the motions after the impact, of several possible ones, that agree best with the impulse.
//!
//! A rest position with only its heading known allows several starts, and each combination of a start of
//! either vehicle gives its own speeds. Some implications of these are then known twice: the yaw rates by the
//! impulse at C and by the path to rest, a restitution that is neither negative nor high, an impulse ratio
//! between 0 and μ_c, and the crush energy if it was not used. The residuals r of a combination, and their
//! covariance Σ from the usual errors of their causes, give
//!
//! χ² = rᵀ Σ⁻¹ r,  weight ∝ e^(−χ²/2)

use inputs::{Basis, MotionInput};
use pim_core::{Contact, Motion, Participant, Real, Vector2, VehicleId};
use real::elementary;
use reconcile::{Departure, Implied, Momentum, MomentumError};
use trajectory::StartMotion as Start;

use super::{ByCrush, Posed};
use crate::checks;
use crate::failure::Failure;
use crate::speeds::{Combination, Spread};
use crate::thresholds::{
    ARM_ERROR, DIRECTION_AFTER_ERROR, HIGH_RESTITUTION, PLANE_ERROR, RATIO_BEYOND, RESTITUTION_ERROR,
    SPEED_AFTER_ERROR, YAW_RATE_ERROR, YAW_RATE_SHARE,
};
use crate::travel::{Record, TravelOrigin};

/// The evidence with which the speeds of a combination are compared.
#[derive(Clone, Copy)]
pub(super) struct Evidence {
    /// (J) crush energy of both vehicles.
    pub(super) crush_energy: Option<f64>,
    /// The energy that it has to equal.
    pub(super) basis: Basis,
    /// (–) standard deviation of its logarithm.
    pub(super) crush_ln: f64,
}

/// Number of quantities that are known twice: Ω_1, Ω_2, e, the impulse ratio, the crush energy.
const KNOWN_TWICE: usize = 5;
/// Number of their causes: size and direction of both velocities after the impact, both yaw rates, C in the
/// axes of both vehicles, the crush plane, and the crush energy.
const CAUSES: usize = 12;

/// (m/s) minimum approach speed in the evaluation of a restitution: slower vehicles rebound fully.
const SLOWEST_APPROACH: f64 = 3.0;
/// (–) excess of the impulse ratio over its limits if the impulse would pull.
const PULLS: f64 = 2.0;
/// (–) minimum share of the crush energy in the logarithm.
const LEAST_ENERGY: f64 = 0.01;

type Numbers = [f64; KNOWN_TWICE];

/// The differences between momentum and the rest of the evidence, and their covariance.
struct Judged {
    speeds: [f64; 2],
    implied: Implied,
    apart: Numbers,
    /// Σ
    covariance: [Numbers; KNOWN_TWICE],
}

/// The momentum of the combination with slightly different numbers.
fn varied(momentum: &Momentum, by: &[f64; CAUSES]) -> Option<Momentum> {
    let [speed_1, turn_1, speed_2, turn_2, yaw_1, yaw_2, ahead_1, left_1, ahead_2, left_2, plane, _] = *by;
    let participant = |i: usize, ahead: f64, left: f64| {
        let given = &momentum.contact.participants()[i];
        let (axis, arm) = (given.forward(), given.arm());
        let across = Vector2::new(0.0 - axis.y, axis.x);
        let angle = |direction: Vector2<f64>| Real::atan2(direction.y, direction.x);
        let (ahead, left) = (arm.dot(&axis) + ahead, arm.dot(&across) + left);
        let placed = Participant::new(*given.body(), angle(axis), ahead, left).ok()?;
        placed.with_course(angle(given.course())).ok()
    };
    let participants = [participant(0, ahead_1, left_1)?, participant(1, ahead_2, left_2)?];
    let departure = |i: usize, longer: f64, turn: f64, yaw: f64| {
        let Departure { velocity, yaw_rate } = momentum.after[i];
        let (sin, cos) = Real::sin_cos(turn);
        let turned = Vector2::new(velocity.x * cos - velocity.y * sin, velocity.x * sin + velocity.y * cos);
        Departure { velocity: turned * (1.0 + longer), yaw_rate: yaw_rate.map(|rate| rate + yaw) }
    };
    Some(Momentum {
        contact: Contact::new(participants, momentum.contact.crush_plane() + plane).ok()?,
        after: [departure(0, speed_1, turn_1, yaw_1), departure(1, speed_2, turn_2, yaw_2)],
        ..*momentum
    })
}

/// (m/s) speeds with a slightly different momentum. Along one line, the momentum gives the speed of the
/// common centre, and the crush energy the speeds relative to it.
fn speeds_beside(
    from: (&Momentum, [f64; 2]),
    other: &Momentum,
    relative: f64,
) -> Result<[f64; 2], MomentumError> {
    let (momentum, speeds) = from;
    if !momentum.is_collinear() {
        return other.speeds();
    }
    let axis = momentum.common_axis();
    let participants = momentum.contact.participants();
    let masses = [0, 1].map(|i| participants[i].body().mass());
    let cosines = [0, 1].map(|i| participants[i].course().dot(&axis));
    let along = [speeds[0] * cosines[0], speeds[1] * cosines[1]];
    let mass = masses[0] + masses[1];
    let centre = (masses[0] * along[0] + masses[1] * along[1]) / mass;
    let moved = (other.total() - momentum.total()).dot(&axis) / mass;
    Ok([0, 1].map(|i| (centre + moved + (along[i] - centre) * (1.0 + relative)) / cosines[i]))
}

/// The differences between the implications of the speeds and the evidence; for a quantity with an upper and
/// a lower bound, the distance beyond the nearer bound, negative within.
fn apart(momentum: &Momentum, implied: &Implied, evidence: &Evidence, restitution: f64) -> Numbers {
    let told = |i: usize| momentum.after[i].yaw_rate.map_or(0.0, |told| implied.yaw_rates[i] - told);
    // e = −U_n/u_n
    let e = implied.separation.normal / (0.0 - implied.approach.normal).max(SLOWEST_APPROACH);
    let beyond_e = (e - restitution.max(HIGH_RESTITUTION)).max(0.0 - e);
    let beyond_ratio = match (implied.impulse_ratio, implied.critical_impulse_ratio) {
        (Some(mu), Some(critical)) => {
            let along = mu * critical.signum();
            (along - critical.abs()).max(0.0 - along)
        }
        (None, _) => PULLS,
        (Some(_), None) => -1.0,
    };
    let energy = evidence.crush_energy.map_or(0.0, |crush| {
        let work = evidence.basis.taken_by_crush(implied.normal_work, implied.tangential_work);
        let part = evidence.basis.energy().dissipated(crush, restitution);
        elementary::ln((work / part).max(LEAST_ENERGY))
    });
    [told(0), told(1), beyond_e, beyond_ratio, energy]
}

impl Judged {
    fn new(momentum: &Momentum, speeds: [f64; 2], evidence: &Evidence, restitution: f64) -> Option<Self> {
        let implied = momentum.implied(speeds).ok()?;
        let here = apart(momentum, &implied, evidence, restitution);
        let yaw_error = |i: usize| {
            let told = momentum.after[i].yaw_rate.unwrap_or_default();
            Real::sqrt(YAW_RATE_ERROR * YAW_RATE_ERROR + YAW_RATE_SHARE * YAW_RATE_SHARE * told * told)
        };
        let errors = [
            SPEED_AFTER_ERROR,
            DIRECTION_AFTER_ERROR,
            SPEED_AFTER_ERROR,
            DIRECTION_AFTER_ERROR,
            yaw_error(0),
            yaw_error(1),
            ARM_ERROR,
            ARM_ERROR,
            ARM_ERROR,
            ARM_ERROR,
            PLANE_ERROR,
            // v ∝ √E
            if momentum.is_collinear() { 0.5 * evidence.crush_ln } else { 0.0 },
        ];
        // Errors of the assumptions of an impulse at one point C, a known restitution and a constant ratio.
        let crush = if momentum.is_collinear() { 1.0 } else { evidence.crush_ln };
        let own = [0.0, 0.0, RESTITUTION_ERROR, RATIO_BEYOND, crush];
        let mut covariance = [[0.0; KNOWN_TWICE]; KNOWN_TWICE];
        for (i, own) in own.into_iter().enumerate() {
            covariance[i][i] = own * own;
        }
        for (cause, &error) in errors.iter().enumerate() {
            if error == 0.0 {
                continue;
            }
            let at = |side: f64| {
                let mut by = [0.0; CAUSES];
                by[cause] = side * error;
                let other = varied(momentum, &by)?;
                let speeds = speeds_beside((momentum, speeds), &other, by[CAUSES - 1]).ok()?;
                Some(apart(&other, &other.implied(speeds).ok()?, evidence, restitution))
            };
            let (above, below) = (at(1.0)?, at(-1.0)?);
            let change: [f64; KNOWN_TWICE] = std::array::from_fn(|i| 0.5 * (above[i] - below[i]));
            for i in 0..KNOWN_TWICE {
                for j in 0..KNOWN_TWICE {
                    // Σ = Σ_k (∂r/∂x_k)(∂r/∂x_k)ᵀ σ_k²
                    covariance[i][j] += change[i] * change[j];
                }
            }
        }
        let is_finite = covariance.as_flattened().iter().chain(&here).all(|number| number.is_finite());
        is_finite.then_some(Self { speeds, implied, apart: here, covariance })
    }

    /// χ² of the quantities that are known and not met: a bound that is kept does not count.
    fn misfit(&self, momentum: &Momentum, evidence: &Evidence) -> f64 {
        let counts = [
            momentum.after[0].yaw_rate.is_some(),
            momentum.after[1].yaw_rate.is_some(),
            self.apart[2] > 0.0,
            self.apart[3] > 0.0,
            evidence.crush_energy.is_some(),
        ];
        let which: Vec<usize> = (0..KNOWN_TWICE).filter(|&i| counts[i]).collect();
        // Σ = L Lᵀ (Cholesky), L y = r, χ² = |y|²
        let mut lower: Vec<Vec<f64>> = Vec::new();
        let mut solved: Vec<f64> = Vec::new();
        for (row, &i) in which.iter().enumerate() {
            let mut line: Vec<f64> = Vec::new();
            for (column, &j) in which.iter().enumerate().take(row) {
                let known: f64 = line.iter().zip(&lower[column]).map(|(a, b)| a * b).sum();
                line.push((self.covariance[i][j] - known) / lower[column][column]);
            }
            let known: f64 = line.iter().map(|number| number * number).sum();
            let pivot = Real::sqrt((self.covariance[i][i] - known).max(f64::MIN_POSITIVE));
            let before: f64 = line.iter().zip(&solved).map(|(a, b)| a * b).sum();
            solved.push((self.apart[i] - before) / pivot);
            line.push(pivot);
            lower.push(line);
        }
        solved.iter().map(|number| number * number).sum()
    }

    fn spread(&self) -> Spread {
        let [one, two, restitution, impulse_ratio, energy_ln] =
            std::array::from_fn(|i| Real::sqrt(self.covariance[i][i]));
        Spread { yaw_rates: [one, two], restitution, impulse_ratio, energy_ln }
    }
}

/// The uncertainty of the implications of momentum at these speeds (m/s) against the other evidence.
pub(super) fn spread(
    momentum: &Momentum,
    speeds: [f64; 2],
    evidence: &Evidence,
    restitution: f64,
) -> Option<Spread> {
    Judged::new(momentum, speeds, evidence, restitution).map(|judged| judged.spread())
}

/// A start of a vehicle; `None` if its motion is not searched for.
type Sought = Option<Start>;

/// Chooses the starts of both vehicles that agree best with the impulse, and keeps their paths in the record.
/// Returns all combinations, the best first.
pub(super) fn agreeing(
    posed: &mut Posed,
    record: &mut Record,
    input: Option<&MotionInput>,
    evidence: &Evidence,
) -> Result<Vec<Combination>, Failure> {
    let starts = VehicleId::ALL.map(|id| starts(record, id));
    let mut found: Vec<(Combination, [Sought; 2])> = Vec::new();
    for &one in &starts[0] {
        for &two in &starts[1] {
            if let Some(combination) = combined(posed, record, [one, two], evidence) {
                found.push((combination, [one, two]));
            }
        }
    }
    // If two agree equally, the order of the starts remains: the smallest turn first.
    found.sort_by(|(a, _), (b, _)| a.misfit.total_cmp(&b.misfit));
    let least = found.first().map_or(0.0, |(best, _)| best.misfit);
    // w = e^(−½ (χ² − χ²_min))/Σ
    let share = |misfit: f64| elementary::exp(-0.5 * (misfit - least));
    let sum: f64 = found.iter().map(|(combination, _)| share(combination.misfit)).sum();
    for (combination, _) in &mut found {
        combination.weight = share(combination.misfit) / sum;
    }
    if let (Some((best, chosen)), Some(input)) = (found.first(), input) {
        let after = best.after;
        for id in VehicleId::ALL {
            let is_used = after[id.index()] == posed.momentum.after[id.index()];
            if let Some(start) = chosen[id.index()].filter(|_| !is_used)
                && let Some(way) = record.choose(id, input, start)?
            {
                posed.ways[id.index()] = Some(way);
            }
        }
        let momentum = Momentum { after, ..posed.momentum };
        posed.by_crush = again(posed, momentum, evidence.basis)?;
        posed.momentum = momentum;
    }
    Ok(found.into_iter().map(|(combination, _)| combination).collect())
}

/// The search for both speeds by the crush energy with another momentum, if there is one.
fn again(posed: &Posed, momentum: Momentum, basis: Basis) -> Result<Option<ByCrush>, Failure> {
    let search = posed.by_crush.as_ref().zip(posed.law.clone());
    Ok(search.map(|(by_crush, law)| by_crush.with(momentum, law, basis)).transpose()?)
}

/// The starts that lead to the rest position of a vehicle, the one of the record first.
fn starts(record: &Record, id: VehicleId) -> Vec<Sought> {
    let travel = record.travel[id.index()].as_ref().filter(|travel| travel.origin == TravelOrigin::Rest);
    travel.map_or_else(
        || vec![None],
        |travel| std::iter::once(travel.used()).chain(travel.others.iter().copied()).map(Some).collect(),
    )
}

fn combined(posed: &Posed, record: &Record, starts: [Sought; 2], evidence: &Evidence) -> Option<Combination> {
    let departure = |start: Start| {
        let Motion { velocity, yaw_rate } = start.motion;
        Departure { velocity, yaw_rate: Some(yaw_rate) }
    };
    let after = [0, 1].map(|i| starts[i].map_or(posed.momentum.after[i], departure));
    let momentum = Momentum { after, ..posed.momentum };
    let speeds = match again(posed, momentum, evidence.basis).ok()? {
        Some(by_crush) => by_crush.search.solve().ok()?.speeds,
        None => momentum.speeds().ok()?,
    };
    let closing = 0.0 - momentum.contact.approach(&momentum.motions_at(speeds)).velocity.normal;
    let restitution = posed.law.as_ref()?.at(closing).restitution();
    let judged = Judged::new(&momentum, speeds, evidence, restitution)?;
    let energy = evidence
        .crush_energy
        .map(|crush| (evidence.basis.energy().dissipated(crush, restitution), evidence.basis));
    let (spread, locked) = (judged.spread(), posed.locked_together);
    let checks = checks::implied(&momentum, &judged.implied, restitution, energy, &spread, locked);
    let turn = |i: usize| {
        starts[i].map(|start| start.turn).or_else(|| {
            let travel = record.travel[i].as_ref()?;
            Some(travel.rest.heading - travel.start.heading)
        })
    };
    Some(Combination {
        after,
        turns: [turn(0), turn(1)],
        speeds: judged.speeds,
        misfit: judged.misfit(&momentum, evidence),
        weight: 1.0,
        against: checks.into_iter().filter(|check| !check.passed()).collect(),
    })
}
