//! Both speeds, found from how the vehicles left the impact.

mod choice;

use inputs::{Basis, Case, Geometry, Sought, TwoSpeedInput};
use pim_core::{Law, Outcome, Real, VaryingLaw, Vector2, VehicleId};
use reconcile::{Departure, Implied, Momentum, MomentumAndCrush, MomentumError};

use crate::analysis::Analysis;
use crate::checks;
use crate::damage;
use crate::errors::errors;
use crate::failure::Failure;
use crate::impact::Impact;
use crate::judged::judged;
use crate::speeds::{BothFound, BothMethod, CgLine, Combination};
use crate::travel::{Record, TravelOrigin, Way, Ways, departures};
use crate::warning;

/// (m) from the CG of vehicle 1 to that of vehicle 2: between the given positions, or by the arms to the
/// contact point.
fn between_cgs(case: &Case, momentum: &Momentum) -> Vector2<f64> {
    let given = case.vehicles.each_ref().map(|vehicle| {
        let place = vehicle.position.as_ref()?;
        Some(Vector2::new(place.x.si(), case.axes.lateral(place.y.si())))
    });
    if let [Some(one), Some(two)] = given {
        return two - one;
    }
    let [one, two] = momentum.contact.participants();
    // CG₂ − CG₁ = (C − r₂) − (C − r₁)
    one.arm() - two.arm()
}

/// The equation for both speeds.
pub(crate) struct Posed<T = f64> {
    /// Momentum, and how the vehicles left the impact.
    pub(crate) momentum: Momentum<T>,
    /// The crush energy, if momentum alone does not separate the speeds.
    pub(crate) by_crush: Option<ByCrush<T>>,
    /// The paths that show how the vehicles left the impact, or follow from it.
    pub(crate) ways: [Option<Way<T>>; 2],
    /// The law, if the case gives it and the contact.
    pub(crate) law: Option<VaryingLaw<T>>,
    sought: Sought<T>,
    geometry: Geometry,
    locked_together: bool,
    /// As [`BothFound::one_velocity`].
    pub(crate) one_velocity: bool,
}

/// The law at the closing speed, and the impact by it.
type ByLaw<T> = (Law<T>, Outcome<T>);

/// The additional data for momentum along one line.
pub(crate) struct ByCrush<T = f64> {
    pub(crate) search: MomentumAndCrush<T>,
    /// (J) crush energy of both vehicles.
    crush_energy: T,
}

impl ByCrush {
    /// The same with another momentum.
    fn with(&self, momentum: Momentum, law: VaryingLaw, basis: Basis) -> Result<Self, MomentumError> {
        let (energy, share) = (basis.energy(), basis.tangential_share());
        let axis = momentum.common_axis();
        let search = MomentumAndCrush::new(momentum, axis, law, self.crush_energy, energy, share)?;
        Ok(Self { search, crush_energy: self.crush_energy })
    }
}

impl<T: Real> Posed<T> {
    /// The impact at both speeds (m/s) by the law, and the law at its closing speed.
    pub(crate) fn impact(&self, speeds: [T; 2]) -> Option<Result<ByLaw<T>, Failure>> {
        let (contact, before) = (self.momentum.contact, self.momentum.motions_at(speeds));
        let law = self.law.as_ref()?.at(-contact.approach(&before).velocity.normal);
        Some(contact.impact(before, &law).map(|outcome| (law, outcome)).map_err(Failure::from))
    }

    /// (m/s) both speeds, if they do not need the crush energy.
    pub(crate) fn speeds(&self) -> Result<[T; 2], Failure> {
        let momentum = &self.momentum;
        let beside = |vehicle: VehicleId, found: T, other: T| match vehicle {
            VehicleId::One => [found, other],
            VehicleId::Two => [other, found],
        };
        Ok(match self.sought {
            Sought::Both => momentum.speeds()?,
            Sought::Beside { vehicle, known } => {
                beside(vehicle, momentum.speed_beside(vehicle, known)?, known)
            }
            Sought::IntoWall { vehicle } => {
                let restitution = self.wall_restitution(vehicle)?;
                beside(vehicle, momentum.speed_into_wall(vehicle, restitution)?, T::ZERO)
            }
        })
    }

    /// (–) e at a fixed object; with a restitution curve, the value at the closing speed that follows from
    /// it.
    fn wall_restitution(&self, vehicle: VehicleId) -> Result<T, Failure> {
        let Some(law) = &self.law else { return Err(MomentumError::Fixed { vehicle }.into()) };
        let mut e = law.at(T::ZERO).restitution();
        if law.curve().is_none() {
            return Ok(e);
        }
        // e ← e(−u_n(e)) settles within a few rounds, as e falls slowly with the speed.
        for _ in 0..WALL_ROUNDS {
            let speed = self.momentum.speed_into_wall(vehicle, e)?;
            let mut speeds = [T::ZERO; 2];
            speeds[vehicle.index()] = speed;
            let before = self.momentum.motions_at(speeds);
            e = law.at(-self.momentum.contact.approach(&before).velocity.normal).restitution();
        }
        Ok(e)
    }

    /// The implications of the speeds (m/s): for point masses, along the line of the impulse; for vehicles
    /// that left as one body, with the common yaw rate that they then have.
    pub(crate) fn implied(&self, speeds: [T; 2]) -> Result<(Momentum<T>, Implied<T>), Failure> {
        let momentum = match self.geometry {
            Geometry::PointMasses => self.momentum.central(speeds)?,
            Geometry::Given if self.locked_together && is_yaw_open(&self.momentum.after) => {
                self.momentum.locked_together(speeds)
            }
            Geometry::Given if self.one_velocity => self.momentum.of_one_velocity(),
            Geometry::Given | Geometry::Plane => self.momentum,
        };
        let implied = momentum.implied(speeds)?;
        Ok((momentum, implied))
    }
}

/// Whether both vehicles have the same velocity, and neither has a known yaw rate.
fn is_yaw_open<T: Real>(after: &[Departure<T>; 2]) -> bool {
    let [one, two] = after;
    one.yaw_rate.is_none() && two.yaw_rate.is_none() && one.velocity == two.velocity
}

/// Number of iterations for a restitution curve: each one reduces the error of the speed by a factor of about
/// the steepness of the curve, and 40 factors of one half leave 1e-12 of it.
const WALL_ROUNDS: usize = 40;

/// Poses the equation for both speeds.
pub(crate) fn pose<T: Real>(input: TwoSpeedInput<T>, ways: &mut impl Ways<T>) -> Result<Posed<T>, Failure> {
    let [(one, way_1), (two, way_2)] = departures(input.motion.as_ref(), input.departures, ways)?;
    let [body_1, body_2] = input.contact.participants().each_ref().map(|participant| participant.body());
    // A fixed object stays where it is.
    let stays = Departure { velocity: Vector2::new(T::ZERO, T::ZERO), yaw_rate: Some(T::ZERO) };
    let one = if body_1.is_fixed() { Some(stays) } else { one };
    let two = if body_2.is_fixed() { Some(stays) } else { two };
    let [arm_1, arm_2] = input.contact.participants().each_ref().map(|participant| participant.arm());
    // The relative position of the CGs of point masses is unknown.
    let apart = match input.geometry {
        Geometry::Given => arm_1 - arm_2,
        Geometry::Plane | Geometry::PointMasses => Vector2::new(T::ZERO, T::ZERO),
    };
    let after = match (one, two) {
        (Some(one), Some(two)) => [one, two],
        (Some(one), None) if input.locked_together => [one, one.of_locked(apart)],
        (None, Some(two)) if input.locked_together => [two.of_locked(-apart), two],
        (one, _) => {
            let vehicle = if one.is_none() { VehicleId::One } else { VehicleId::Two };
            return Err(MomentumError::Fixed { vehicle }.into());
        }
    };
    let TwoSpeedInput { contact, law, yaw_rates, vehicles, sought, geometry, locked_together, .. } = input;
    let momentum = Momentum { contact, yaw_rates, after };
    let by_crush = match (&law, sought) {
        (Some(law), Sought::Both) if momentum.is_collinear() => {
            let crush_energy = damage::uncorrected(vehicles)?;
            let axis = momentum.common_axis();
            let (basis, share) = (input.basis.energy(), input.basis.tangential_share());
            let search = MomentumAndCrush::new(momentum, axis, law.clone(), crush_energy, basis, share)?;
            Some(ByCrush { search, crush_energy })
        }
        _ => None,
    };
    // V₂ = V₁ + Ω × d with V₂ = V₁: a wreck that did not turn.
    let one_velocity = geometry == Geometry::Given && !locked_together && is_yaw_open(&momentum.after);
    let ways = [way_1, way_2];
    Ok(Posed { momentum, by_crush, ways, law, sought, geometry, locked_together, one_velocity })
}

/// The equation for both speeds, with the starts that agree best with the impulse, all combinations of
/// starts, and the evidence with which they were compared.
struct Agreed {
    posed: Posed,
    combinations: Vec<Combination>,
    evidence: choice::Evidence,
}

impl Agreed {
    fn new(case: &Case, input: TwoSpeedInput, record: &mut Record) -> Result<Self, Failure> {
        let (basis, motion) = (input.basis, input.motion.clone());
        let vehicles = input.has_crush.then(|| input.vehicles.clone());
        let mut posed = pose(input, record)?;
        let is_held = posed.by_crush.is_none();
        let crush_energy = match vehicles.filter(|_| is_held) {
            Some(vehicles) => Some(damage::uncorrected(vehicles)?),
            None => None,
        };
        let evidence = choice::Evidence {
            crush_energy: crush_energy.filter(|energy| *energy > 0.0),
            basis,
            crush_ln: errors(case).crush_ln,
        };
        // One speed next to a known one, and point masses, have too little evidence for the choice.
        let is_chosen = posed.sought == Sought::Both && posed.geometry == Geometry::Given;
        let combinations = if is_chosen && posed.law.is_some() {
            choice::agreeing(&mut posed, record, motion.as_ref(), &evidence)?
        } else {
            Vec::new()
        };
        Ok(Self { posed, combinations, evidence })
    }
}

/// [`pose`] with the starts that agree best with the impulse.
pub(crate) fn pose_agreeing(case: &Case, input: TwoSpeedInput) -> Result<Posed, Failure> {
    Ok(Agreed::new(case, input, &mut Record::of(TravelOrigin::Given))?.posed)
}

/// (m/s) a vehicle found to move backward more slowly than this may have stood still: 1 km/h.
const STOOD: f64 = 1.0 / 3.6;

/// Finds both speeds, or one from the momentum.
pub(crate) fn reconstruct(case: &Case) -> Result<Analysis, Failure> {
    let input = case.two_speeds()?;
    let (basis, has_crush, vehicles) = (input.basis, input.has_crush, input.vehicles.clone());
    let surface = input.motion.as_ref().map(|motion| motion.surface.clone());
    let mut record = Record::of(TravelOrigin::Given);
    let Agreed { posed, combinations, evidence } = Agreed::new(case, input, &mut record)?;
    let (speeds, method) = match (&posed.by_crush, posed.sought) {
        (Some(ByCrush { search, crush_energy }), _) => {
            let answer = search.solve()?;
            let method = BothMethod::MomentumAndCrush {
                crush_energy: *crush_energy,
                normal_work: answer.normal_work,
                relative_speed: answer.relative,
                admissible: search.speeds().collect(),
            };
            (answer.speeds, method)
        }
        (None, Sought::Both) => (posed.speeds()?, BothMethod::Momentum),
        (None, Sought::Beside { vehicle, .. }) => {
            (posed.speeds()?, BothMethod::MomentumAndSpeed { given: vehicle.other() })
        }
        (None, Sought::IntoWall { vehicle }) => {
            let restitution = posed.wall_restitution(vehicle)?;
            (posed.speeds()?, BothMethod::Wall { vehicle, restitution })
        }
    };
    let (momentum, implied) = posed.implied(speeds)?;
    let impact = posed
        .impact(speeds)
        .transpose()?
        .zip(posed.law.clone())
        .map(|((law_here, outcome), law)| Impact::new(posed.momentum.contact, law, law_here, outcome));
    let vehicles = damage::assess(vehicles, implied.pdof.map(Some))?;
    let restitution = impact.as_ref().map(|impact| impact.law.restitution());
    let delta_v = match (&method, &impact) {
        (BothMethod::MomentumAndCrush { .. }, Some(impact)) => impact.outcome.delta_v_magnitude(),
        _ => implied.delta_v.map(|change| change.norm()),
    };
    let geometry = posed.geometry;
    let is_spread = geometry == Geometry::Given
        && !posed.momentum.contact.participants().iter().any(|one| one.body().is_fixed());
    let spread = restitution
        .filter(|_| is_spread)
        .and_then(|restitution| choice::spread(&momentum, speeds, &evidence, restitution));
    let velocities = |motions: [pim_core::Motion; 2]| motions.map(|motion| motion.velocity);
    let after = momentum.after.map(|departure| departure.velocity);
    // The positions of the CGs of point masses are unknown.
    let cg_line = match geometry {
        Geometry::Given => CgLine::new(between_cgs(case, &momentum), velocities(implied.before), after),
        Geometry::Plane | Geometry::PointMasses => None,
    };
    let (locked_together, one_velocity) = (posed.locked_together, posed.one_velocity);
    let both = BothFound {
        speeds,
        method,
        delta_v,
        momentum,
        geometry,
        implied,
        locked_together,
        one_velocity,
        combinations,
        cg_line,
    };
    let mut warnings = Vec::new();
    warnings.extend(both.is_by_crush().then(|| warning::of_typical(case, &vehicles)).into_iter().flatten());
    for (vehicle, speed) in both.vehicles().map(|vehicle| (vehicle, speeds[vehicle.index()])) {
        warnings.extend(warning::of_given_speed(case, vehicle, speed));
        // Rest positions and velocities after the impact are this inaccurate for a vehicle that stood.
        if speed < -STOOD {
            warning::of_found_speed(vehicle, speed, &mut warnings);
        }
    }
    let solved = Analysis { basis, both: Some(both), impact, warnings, ..Analysis::unsolved(vehicles) };
    let mut analysis = judged(case, solved, restitution)?;
    // The part of the crush energy that the impact dissipates, on the case's basis.
    let crush_energy = restitution.filter(|_| has_crush).map(|restitution| {
        (basis.energy().dissipated(damage::crush_energy(&analysis.vehicles), restitution), basis)
    });
    let of_momentum = |both: &BothFound| {
        let impact = analysis.impact.as_ref();
        checks::of_momentum(both, impact, &analysis.vehicles, crush_energy, spread.as_ref())
    };
    let checks = analysis.both.as_ref().map(of_momentum).unwrap_or_default();
    warning::of_momentum(&checks, &mut analysis.warnings);
    analysis.warnings.extend(analysis.both.as_ref().and_then(warning::of_wreck_apart));
    analysis.checks.extend(checks);
    Ok(analysis.with_travel(record.travel, surface).beside_the_rest(case))
}
