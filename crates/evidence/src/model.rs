//! The posterior of a collision: the prior, and a likelihood term for each piece of evidence.

use estimate::{Evidence, Hurdle, Independent, Part, Prior};
use pim_core::{Outcome, Vector2, VehicleId};
use real::elementary::{atan2, exp, ln};
use real::{Real, principal_angle};
use uncertainty::normal::cumulative;
use uncertainty::{Distribution, Instructions, LANES, Lanes, dispatch};

use crate::collision::{
    BodyNumbers, CodedPdof, Collision, CrushErrors, CrushNumbers, EnergyError, Measured, MeasuredRest,
    MeasuredSpeed, Observed, ObservedVehicle, RecordedDeltaV, RecordedPart, ShownSpeed, VehicleNumbers,
};
use crate::density::{Freedom, normal, relative, student_of_three, student_of_two};
use crate::figures::{CrushChange, CrushFigures, Mixture};
use crate::impact::{Impacted, Impacts};
use crate::number::{Number, Slot};

/// Reason code of a particle whose vehicles do not approach, or for which the impact law has no impact.
pub const NO_IMPACT: u8 = 1;

/// A piece of evidence, or a part of the prior that is not the distribution of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    /// The usual severity of such collisions: a part of the prior.
    Severity,
    /// The crush energy of both vehicles, or of the one whose crush is known.
    Crush,
    /// The energy at which residual crush begins, where no vehicle has any: the impact took no more.
    NoResidualCrush,
    /// PDOF as coded. One investigator codes those of both vehicles and makes them opposite: only the one
    /// with the smaller error counts, or the mean of two with the same. Of two that
    /// [differ](Observed::pdofs_differ), the one that is nearer to a collision counts.
    Pdof(VehicleId),
    /// Speed after the impact.
    SpeedAfter(VehicleId),
    /// Direction of the velocity after the impact.
    DirectionAfter(VehicleId),
    /// Yaw rate after the impact.
    YawRateAfter(VehicleId),
    /// The recorder's ΔV.
    RecordedDeltaV(VehicleId),
    /// The ΔV that a recorder had stored when its record ended, before the impact did.
    LeastDeltaV(VehicleId),
    /// The direction of the recorder's ΔV.
    RecordedDirection(VehicleId),
    /// The rest position and heading.
    Rest(VehicleId),
    /// The points passed by the CG.
    Points(VehicleId),
    /// The recorder's speed before impact.
    RecordedSpeed(VehicleId),
    /// The recorder's yaw rate after the impact.
    RecordedYawRate(VehicleId),
    /// The speed at the beginning of the skid before the impact.
    SkidSpeed(VehicleId),
    /// Certain limits of the speed.
    Limits(VehicleId),
}

/// A collision as prior and evidence of [`estimate::sample`].
#[derive(Clone, Debug)]
pub struct CollisionModel<I = Placed> {
    impacts: I,
    observed: Observed,
    pieces: Vec<Piece>,
}

/// A collision with the index of each unknown number.
#[derive(Clone, Debug)]
pub struct Placed {
    collision: Collision<Slot>,
    unknown: Independent,
}

impl Impacts for Placed {
    fn unknown(&self) -> &Independent {
        &self.unknown
    }

    #[inline(always)]
    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted> {
        (0..LANES).map(|lane| self.collision.impact(values, lane)).collect()
    }
}

impl Placed {
    /// (–) κ and β of each vehicle, as in [`CrushNumbers`], for a block of particles; 1 if it has no crush.
    #[must_use]
    pub fn crush_factors(&self, values: &[Lanes]) -> [[[f64; 2]; 2]; LANES] {
        core::array::from_fn(|lane| self.collision.crush_factors(values, lane))
    }
}

impl CollisionModel {
    /// The model with all evidence of the collision.
    #[must_use]
    pub fn new(collision: &Collision) -> Self {
        let mut unknown = Vec::new();
        let placed = collision.placed(&mut unknown);
        let has_crush = placed.vehicles.iter().any(|vehicle| vehicle.crush.is_some());
        let mut observed = collision.observed.clone();
        observed.crush = observed.crush.filter(|_| has_crush);
        Self::of(Placed { collision: placed, unknown: Independent(unknown) }, observed)
    }
}

impl<I: Impacts> CollisionModel<I> {
    /// The model that compares the observations of a collision with the impacts of its unknown numbers.
    pub fn of(impacts: I, observed: Observed) -> Self {
        let mut pieces = Vec::new();
        pieces.extend(observed.severity.map(|_| Piece::Severity));
        let of_crush = if observed.crush_is_bound { Piece::NoResidualCrush } else { Piece::Crush };
        pieces.extend(observed.crush.map(|_| of_crush));
        let coded = |id: VehicleId| observed.vehicles[id.index()].pdof.map(|coded| (coded.scale, id));
        let pdof = VehicleId::ALL.into_iter().filter_map(coded).min_by(|a, b| a.0.total_cmp(&b.0));
        pieces.extend(pdof.map(|(_, id)| Piece::Pdof(id)));
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&observed.vehicles) {
            let ObservedVehicle { pdof: _, after, rest, skid_speed, points, recorder, limits } = vehicle;
            pieces.extend(after.speed.map(|_| Piece::SpeedAfter(id)));
            pieces.extend(after.direction.map(|_| Piece::DirectionAfter(id)));
            pieces.extend(after.yaw_rate.map(|_| Piece::YawRateAfter(id)));
            pieces.extend(rest.map(|_| Piece::Rest(id)));
            pieces.extend((!points.is_empty()).then_some(Piece::Points(id)));
            let has_delta_v = recorder.delta_v.is_some() || recorder.longitudinal.is_some();
            let stored = if recorder.ends_early { Piece::LeastDeltaV(id) } else { Piece::RecordedDeltaV(id) };
            pieces.extend(has_delta_v.then_some(stored));
            pieces.extend(recorder.direction.map(|_| Piece::RecordedDirection(id)));
            pieces.extend(recorder.speed.map(|_| Piece::RecordedSpeed(id)));
            pieces.extend(recorder.yaw_rate.map(|_| Piece::RecordedYawRate(id)));
            pieces.extend(skid_speed.map(|_| Piece::SkidSpeed(id)));
            let is_limited = limits.least > f64::NEG_INFINITY || limits.most < f64::INFINITY;
            pieces.extend(is_limited.then_some(Piece::Limits(id)));
        }
        Self { impacts, observed, pieces }
    }

    /// The terms of the likelihood, in order.
    #[must_use]
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The part in each column of [`score`](Self::score).
    #[must_use]
    pub fn parts(&self) -> Vec<Part> {
        self.parts_of_pieces().map(|(term, part)| Part { term, turn: part.turn() }).collect()
    }

    /// The parts of all pieces, with the index of the piece.
    fn parts_of_pieces(&self) -> impl Iterator<Item = (usize, PartOf)> + '_ {
        let parts = |(term, piece): (usize, &Piece)| {
            let parts = match *piece {
                Piece::Pdof(_) | Piece::DirectionAfter(_) | Piece::RecordedDirection(_) => {
                    vec![PartOf::Angle(*piece)]
                }
                Piece::Rest(id) => {
                    let turns =
                        self.observed.vehicles[id.index()].rest.is_some_and(|rest| rest.turns_are_known);
                    let heading = if turns { PartOf::Heading(id) } else { PartOf::HeadingOnCircle(id) };
                    vec![PartOf::Number(*piece), PartOf::Across(id), heading]
                }
                _ => vec![PartOf::Number(*piece)],
            };
            parts.into_iter().map(move |part| (term, part))
        };
        self.pieces.iter().enumerate().flat_map(parts)
    }

    /// Writes the normal score of each part of the pieces, or the error of an angle, a column for each: NaN
    /// for the severity, which is not an observation, and for points, which are several.
    pub fn score(&self, impacts: &[Impacted], residuals: &mut [Lanes]) {
        for (column, (_, part)) in residuals.iter_mut().zip(self.parts_of_pieces()) {
            for (score, impacted) in column.iter_mut().zip(impacts) {
                *score = match part {
                    PartOf::Number(Piece::Severity) => f64::NAN,
                    PartOf::Number(Piece::Crush) => self.score_of_crush(impacted),
                    PartOf::Number(Piece::RecordedSpeed(id)) => self.score_of_speed(id, impacted),
                    PartOf::Number(piece) => self.error(piece, impacted).score(),
                    PartOf::Angle(piece) => self.error(piece, impacted).error,
                    PartOf::Across(id) => {
                        self.rest_errors(id, impacted).map_or(f64::NAN, |[_, across, _]| across.score())
                    }
                    PartOf::Heading(id) => {
                        self.rest_errors(id, impacted).map_or(f64::NAN, |[.., turned]| turned.score())
                    }
                    PartOf::HeadingOnCircle(id) => {
                        self.rest_errors(id, impacted).map_or(f64::NAN, |[.., turned]| turned.error)
                    }
                };
            }
        }
    }

    /// The normal score of the crush energies.
    fn score_of_crush(&self, impacted: &Impacted) -> f64 {
        match (&self.observed.crush, &self.observed.figures) {
            (Some(misfit), Some(figures)) => misfit
                .mixture(figures, &impacted.crush_changes, impacted.crush_energies, impacted.taken)
                .score(),
            _ => self.error(Piece::Crush, impacted).score(),
        }
    }

    /// The normal score of the speed by a recorder.
    fn score_of_speed(&self, id: VehicleId, impacted: &Impacted) -> f64 {
        match self.observed.vehicles[id.index()].recorder.speed {
            Some(ShownSpeed::Either(two)) => of_two(two, impacted.speeds[id.index()]).score(),
            _ => self.error(Piece::RecordedSpeed(id), impacted).score(),
        }
    }

    /// The normal score for an error (rad) of a part that is an angle.
    fn score_of_angle(&self, part: usize, error: f64) -> f64 {
        let of = |vehicle: &ObservedVehicle, part: PartOf| match part {
            PartOf::Angle(Piece::Pdof(_)) => vehicle.pdof.map(|coded| coded.of(error)),
            PartOf::Angle(Piece::RecordedDirection(_)) => {
                vehicle.recorder.direction.map(|shown| shown.of(error))
            }
            PartOf::Angle(_) => vehicle.after.direction.map(|measured| Error::normal(error, measured.sd)),
            _ => vehicle.rest.map(|rest| Error::normal(error, rest.heading_sd)),
        };
        let part = self.parts_of_pieces().nth(part).map(|(_, part)| part);
        part.and_then(|part| of(&self.observed.vehicles[part.vehicle()?.index()], part))
            .map_or(f64::NAN, Error::score)
    }

    /// The errors of a rest along the path, across it and in heading; `None` if the vehicle was not followed.
    #[inline(always)]
    fn rest_errors(&self, id: VehicleId, impacted: &Impacted) -> Option<[Error; 3]> {
        let (measured, way) = (self.observed.vehicles[id.index()].rest?, impacted.ways[id.index()].as_ref()?);
        let MeasuredRest { heading, turns_are_known, heading_sd, .. } = measured;
        let (position_sd, [along, across]) = (measured.position_sd(), measured.apart(way.position));
        let turned = heading - way.heading;
        let turned = if turns_are_known { turned } else { principal_angle(turned) };
        Some([
            Error::normal(along, position_sd),
            Error::normal(across, position_sd),
            Error::normal(turned, heading_sd),
        ])
    }

    /// Whether a piece in use constrains the path of a vehicle to rest.
    fn tells_way(&self, id: VehicleId, used: &[bool]) -> bool {
        let is_of_way = |piece: &Piece| matches!(piece, Piece::Rest(of) | Piece::Points(of) if *of == id);
        self.pieces.iter().zip(used).any(|(piece, used)| *used && is_of_way(piece))
    }

    /// The impacts of the unknown numbers.
    #[must_use]
    pub fn leads(&self) -> &I {
        &self.impacts
    }

    /// Writes the log-likelihood of each piece; for a path that was not followed, its maximum.
    #[inline(always)]
    fn judge(&self, impacts: &[Impacted], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        for (reason, impacted) in reasons.iter_mut().zip(impacts) {
            if !impacted.is_possible {
                *reason = NO_IMPACT;
            }
        }
        for (term, &piece) in terms.iter_mut().zip(&self.pieces) {
            let mut errors = [Error::NONE; LANES];
            for (error, impacted) in errors.iter_mut().zip(impacts) {
                *error = self.error(piece, impacted);
            }
            dispatch!(Instructions::best(), Error::log_likelihoods(&errors, term));
            for (term, impacted) in term.iter_mut().zip(impacts) {
                *term = if impacted.is_possible { *term } else { f64::NEG_INFINITY };
            }
        }
    }

    /// The error of an observation relative to the prediction of a particle.
    #[inline(always)]
    fn error(&self, piece: Piece, impacted: &Impacted) -> Error {
        let vehicle = |id: VehicleId| &self.observed.vehicles[id.index()];
        let after = |id: VehicleId| impacted.outcome.after[id.index()];
        let leaves = |id: VehicleId| {
            if vehicle(id).after.of_common_cg { of_common_cg(&impacted.outcome) } else { after(id).velocity }
        };
        // (m/s) the components of ΔV at a recorder away from the CG.
        let sensed = |id: VehicleId| {
            let at_cg = impacted.outcome.delta_v_components()[id.index()];
            Some(vehicle(id).recorder.place?.sensed(at_cg, after(id).yaw_rate))
        };
        let yaw_rate = |measured: Option<Measured>, id: VehicleId| {
            measured
                .map_or(Error::NONE, |Measured { value, sd }| Error::normal(value - after(id).yaw_rate, sd))
        };
        match piece {
            Piece::Severity => {
                let Some(severity) = self.observed.severity else { return Error::NONE };
                let delta_v = impacted.outcome.delta_v_magnitude();
                let [dv1, dv2] = match delta_v {
                    // A fixed object has no ΔV.
                    [dv, 0.0] | [0.0, dv] => [dv, dv],
                    both => both,
                };
                // m₁ ΔV₁ = m₂ ΔV₂
                let apart = Real::max(dv1 / dv2, dv2 / dv1) / MOST_MASS_RATIO;
                let beyond = if apart > 1.0 { 0.5 * ln(apart) } else { 0.0 };
                let [v1, v2] = impacted.speeds;
                let often = -0.5 * (v1 * v1 + v2 * v2) / (severity.speed * severity.speed);
                let injured = severity.injury.map_or(0.0, |risk| risk.ln_in_either(delta_v));
                let size = 0.5 * ln(dv1 * dv2 / (severity.median * severity.median));
                if self.observed.crush_is_bound {
                    // No more severe than such a collision: P(S ≥ s) = Φ(−ln(s/median)/σ).
                    let bound = Error::of_event(cumulative(-(size + beyond) / severity.ln_sd));
                    return Error { potential: often + injured + bound.potential, ..bound };
                }
                Error {
                    potential: often + injured,
                    ..Error::normal(severity.error(size) + beyond, severity.ln_sd)
                }
            }
            Piece::Crush | Piece::NoResidualCrush => {
                let Some(misfit) = self.observed.crush else { return Error::NONE };
                let (energies, taken) = (impacted.crush_energies, impacted.taken);
                let figures = self.observed.figures.as_ref();
                let mixture =
                    figures.map(|figures| misfit.mixture(figures, &impacted.crush_changes, energies, taken));
                match (mixture, piece) {
                    // P(W ≤ E) = Φ(ε/σ)
                    (None, Piece::NoResidualCrush) => {
                        Error::of_event(cumulative(misfit.error(energies, taken).score()))
                    }
                    (Some(mixture), Piece::NoResidualCrush) => Error::of_event(mixture.below()),
                    (None, _) => misfit.error(energies, taken),
                    (Some(mixture), _) => Error { potential: mixture.log_density(), ..Error::NONE },
                }
            }
            Piece::Pdof(id) => {
                let of = |id: VehicleId| Some((vehicle(id).pdof?, impacted.outcome.pdof()[id.index()]));
                match (of(id), of(id.other())) {
                    (Some((coded, pdof)), Some((other, other_pdof))) if self.observed.pdofs_differ => {
                        // Without a sign, so that a force between the two is off by one of them.
                        let [error, beside] = [coded.pdof - pdof, other.pdof - other_pdof]
                            .map(|error| principal_angle(error).abs());
                        let is_nearer = error * other.scale <= beside * coded.scale;
                        if is_nearer { coded.of(error) } else { other.of(beside) }
                    }
                    (Some((coded, pdof)), Some((other, other_pdof))) if coded.scale == other.scale => {
                        let [error, beside] =
                            [coded.pdof - pdof, other.pdof - other_pdof].map(principal_angle);
                        coded.of(principal_angle(error + 0.5 * principal_angle(beside - error)))
                    }
                    (Some((coded, pdof)), _) => coded.error(pdof),
                    (None, _) => Error::NONE,
                }
            }
            Piece::RecordedDirection(id) => {
                let pdof = match sensed(id) {
                    // Away from the origin of the force; clockwise from the heading.
                    Some([along, left]) => atan2(left, -along),
                    None => impacted.outcome.pdof()[id.index()],
                };
                vehicle(id).recorder.direction.map_or(Error::NONE, |shown| shown.error(pdof))
            }
            Piece::SpeedAfter(id) => match vehicle(id).after.speed {
                Some(measured) => measured.error(length(leaves(id))),
                None => Error::NONE,
            },
            Piece::DirectionAfter(id) => match vehicle(id).after.direction {
                Some(Measured { value, sd }) => {
                    let velocity = leaves(id);
                    Error::normal(principal_angle(value - atan2(velocity.y, velocity.x)), sd)
                }
                None => Error::NONE,
            },
            Piece::YawRateAfter(id) => yaw_rate(vehicle(id).after.yaw_rate, id),
            Piece::RecordedDeltaV(id) | Piece::LeastDeltaV(id) => {
                let outcome = &impacted.outcome;
                let recorder = &vehicle(id).recorder;
                let (whole, along) = match sensed(id) {
                    Some([along, left]) => (Real::sqrt(along * along + left * left), along),
                    None => {
                        (outcome.delta_v_magnitude()[id.index()], outcome.delta_v_components()[id.index()][0])
                    }
                };
                let (error, slows) = match (recorder.delta_v, recorder.longitudinal) {
                    (_, Some(part)) => (part.error(whole, along), part.along < 0.0),
                    (Some(recorded), None) => {
                        let shown = shown_delta_v(whole, along, recorded.is_longitudinal);
                        (recorded.error(shown), false)
                    }
                    (None, None) => (Error::NONE, false),
                };
                if matches!(piece, Piece::LeastDeltaV(_)) { error.or_beyond(slows) } else { error }
            }
            Piece::Rest(id) => match (self.rest_errors(id, impacted), vehicle(id).rest) {
                (Some([along, across, turned]), _) => {
                    Error { potential: across.log_likelihood() + turned.log_likelihood(), ..along }
                }
                // Not followed: the maximum.
                (None, Some(rest)) => {
                    let sd = rest.position_sd();
                    let other = normal(0.0, sd) + normal(0.0, rest.heading_sd);
                    Error { potential: other, ..Error::normal(0.0, sd) }
                }
                (None, None) => Error::NONE,
            },
            Piece::Points(id) => match impacted.ways[id.index()].as_ref().and_then(|way| way.misses.as_ref())
            {
                Some(misses) => {
                    let errors = vehicle(id).points.iter().zip(misses);
                    let potential = errors.map(|(sd, miss)| normal(*miss, *sd)).sum();
                    Error { potential, ..Error::NONE }
                }
                // Not followed: the maximum.
                None => {
                    let potential = vehicle(id).points.iter().map(|sd| normal(0.0, *sd)).sum();
                    Error { potential, ..Error::NONE }
                }
            },
            Piece::RecordedYawRate(id) => yaw_rate(vehicle(id).recorder.yaw_rate, id),
            Piece::RecordedSpeed(id) => match vehicle(id).recorder.speed {
                Some(ShownSpeed::One(measured)) => measured.error(impacted.speeds[id.index()]),
                Some(ShownSpeed::Either(two)) => {
                    let potential = of_two(two, impacted.speeds[id.index()]).log_density();
                    Error { potential, ..Error::NONE }
                }
                None => Error::NONE,
            },
            Piece::SkidSpeed(id) => match (vehicle(id).skid_speed, impacted.skid_speeds[id.index()]) {
                (Some(measured), Some(speed)) => measured.error(speed),
                // Without a skid there is no such speed.
                (Some(_), None) => Error { potential: f64::NEG_INFINITY, ..Error::NONE },
                (None, _) => Error::NONE,
            },
            Piece::Limits(id) => {
                let (limits, speed) = (vehicle(id).limits, impacted.speeds[id.index()]);
                let holds = (limits.least <= speed) & (speed <= limits.most);
                Error { potential: if holds { 0.0 } else { f64::NEG_INFINITY }, ..Error::NONE }
            }
        }
    }
}

/// A part of a piece of evidence with its own p-value.
#[derive(Clone, Copy, Debug)]
enum PartOf {
    /// The piece itself; for a rest its position along the path.
    Number(Piece),
    /// The piece itself, an angle.
    Angle(Piece),
    /// The position of a rest across the path.
    Across(VehicleId),
    /// The heading of a rest with its full turns.
    Heading(VehicleId),
    /// The heading of a rest without them.
    HeadingOnCircle(VehicleId),
}

impl PartOf {
    /// (rad) a full turn, for a part on a circle.
    fn turn(self) -> Option<f64> {
        matches!(self, Self::Angle(_) | Self::HeadingOnCircle(_)).then_some(core::f64::consts::TAU)
    }

    /// The vehicle to which an angle belongs.
    fn vehicle(self) -> Option<VehicleId> {
        match self {
            Self::Angle(Piece::Pdof(id) | Piece::DirectionAfter(id) | Piece::RecordedDirection(id))
            | Self::Across(id)
            | Self::Heading(id)
            | Self::HeadingOnCircle(id) => Some(id),
            Self::Angle(_) | Self::Number(_) => None,
        }
    }
}

/// (–) greatest ratio of two masses in the crashes behind the severity (docs/calibration.md). Beyond it,
/// √(ΔV₁ ΔV₂) would make the usual ΔV of a car grow with the mass of the lorry that it meets; it is that of
/// this ratio.
const MOST_MASS_RATIO: f64 = 2.4;

/// (–) minimum longitudinal component that a recorder stores, as a fraction of ΔV.
const LEAST_SHARE: f64 = 0.05;

/// (m/s) the value that a recorder without errors stores for a ΔV with the size `whole` (m/s) and the
/// longitudinal component `along` (m/s).
///
/// A recorder that stores only the longitudinal component also senses a part of the lateral one.
#[inline(always)]
#[must_use]
pub fn shown_delta_v(whole: f64, along: f64, is_longitudinal: bool) -> f64 {
    if is_longitudinal { Real::max(along.abs(), LEAST_SHARE * whole) } else { whole }
}

impl EnergyError {
    /// (–) the factor that corrects the energy shown by the crush.
    #[must_use]
    pub fn factor(&self) -> f64 {
        exp(-self.bias)
    }
}

impl CrushErrors {
    /// (–) the error, and the share of vehicle 2 in the energy.
    #[inline(always)]
    fn excess(&self, [e1, e2]: [f64; 2], taken: f64) -> [f64; 2] {
        let Self([one, two]) = *self;
        let beside = if one.bias == two.bias { e2 } else { e2 * exp(one.bias - two.bias) };
        let sum = e1 + beside;
        // ε = ln[(E₁ + E₂ exp(b₁ − b₂))/(W_n + λ W_t)] − b₁
        [ln(sum / taken) - one.bias, beside / sum]
    }

    #[inline(always)]
    fn error(&self, energies: [f64; 2], taken: f64) -> Error {
        let [error, share] = self.excess(energies, taken);
        Error::normal(error, Self::ln_sd(self.0, share))
    }

    /// The error with those of the figures behind the energies.
    #[inline(always)]
    fn mixture(
        &self,
        figures: &CrushFigures,
        changes: &[CrushChange; 2],
        energies: [f64; 2],
        taken: f64,
    ) -> Mixture {
        let [error, share] = self.excess(energies, taken);
        let [first, second] = figures.vehicles.map(|vehicle| vehicle.has_spread);
        figures.mixture(error, share, changes, |factor| {
            let of = |error: EnergyError, has_spread: bool| {
                let times = if has_spread { factor } else { 1.0 };
                EnergyError { shared_ln_sd: error.shared_ln_sd * times, ..error }
            };
            let [one, two] = self.0;
            Self::ln_sd([of(one, first), of(two, second)], share)
        })
    }

    /// (–) log-likelihood of crush `energies` (J) if the impulses took `taken` (J).
    #[inline(always)]
    #[must_use]
    pub fn log_likelihood(&self, energies: [f64; 2], taken: f64) -> f64 {
        self.error(energies, taken).log_likelihood()
    }

    /// (–) standard deviation of the error if vehicle 2 has this `share` of the energy.
    #[inline(always)]
    fn ln_sd([one, two]: [EnergyError; 2], share: f64) -> f64 {
        let shared = one.shared_ln_sd + share * (two.shared_ln_sd - one.shared_ln_sd);
        let (own1, own2) = ((1.0 - share) * one.own_ln_sd, share * two.own_ln_sd);
        // σ² = (w₁ c₁ + w₂ c₂)² + (w₁ o₁)² + (w₂ o₂)²
        Real::sqrt(shared * shared + own1 * own1 + own2 * own2)
    }
}

impl CodedPdof {
    /// The error if the force came from `pdof` (rad).
    #[inline(always)]
    fn error(&self, pdof: f64) -> Error {
        self.of(principal_angle(self.pdof - pdof))
    }

    /// An error (rad) with its distribution.
    #[inline(always)]
    fn of(&self, error: f64) -> Error {
        Error::student(error, self.scale, Freedom::Two)
    }
}

impl MeasuredSpeed {
    /// The error for a vehicle with this `speed` (m/s).
    #[inline(always)]
    fn error(&self, speed: f64) -> Error {
        let Self { value, ln_sd, least } = *self;
        if least <= 0.0 && speed <= 0.0 {
            // The speed of a vehicle at rest, or moving backward, has no logarithm.
            Error { potential: f64::NEG_INFINITY, ..Error::NONE }
        } else if ln_sd > 0.0 {
            Error::normal(relative(value, speed, ln_sd, least), ln_sd)
        } else {
            Error::normal(value - speed, least)
        }
    }
}

/// The error (m/s) of one of two speeds, each with its probability, for a vehicle with this `speed` (m/s).
#[inline(always)]
fn of_two([(first, one), (second, two)]: [(f64, Measured); 2], speed: f64) -> Mixture {
    let of = |measured: Measured, weight: f64| [measured.value - speed, measured.sd, weight];
    Mixture([of(one, first), of(one, 0.0), of(two, second)])
}

impl RecordedPart {
    /// The error for a ΔV with the size `whole` (m/s) and the longitudinal component `along` (m/s).
    #[inline(always)]
    fn error(&self, whole: f64, along: f64) -> Error {
        let Self { along: stored, ln_scale, least, freedom } = *self;
        let across = LEAST_SHARE * whole;
        let at_zero = Real::sqrt(least * least + across * across);
        let width = Real::sqrt(ln_scale * ln_scale * stored * stored + at_zero * at_zero);
        // dε/dy = σ/√(σ²y² + a²): a depends on the particle, so this factor is part of the density
        let potential = ln(ln_scale / width);
        Error { potential, ..Error::student(relative(stored, along, ln_scale, at_zero), ln_scale, freedom) }
    }
}

impl RecordedDeltaV {
    #[inline(always)]
    fn error(&self, shown: f64) -> Error {
        let error = relative(self.size, shown, self.ln_scale, self.least);
        Error::student(error, self.ln_scale, self.freedom)
    }

    /// (–) its log-likelihood if a recorder without error stores `shown` (m/s), as [`shown_delta_v`] gives
    /// it.
    #[inline(always)]
    #[must_use]
    pub fn log_likelihood(&self, shown: f64) -> f64 {
        self.error(shown).log_likelihood()
    }
}

/// The error of an observation, with its distribution.
#[derive(Clone, Copy, Debug)]
struct Error {
    error: f64,
    scale: f64,
    /// Degrees of freedom of Student's t; `None` for a normal error.
    freedom: Option<Freedom>,
    /// Whether it is an observation at all.
    is_observed: bool,
    /// Logarithm of a further factor of the likelihood.
    potential: f64,
}

impl Error {
    const NONE: Self = Self { error: 0.0, scale: 1.0, freedom: None, is_observed: false, potential: 0.0 };

    #[inline(always)]
    fn normal(error: f64, scale: f64) -> Self {
        Self { error, scale, freedom: None, is_observed: true, potential: 0.0 }
    }

    /// An observation that is no number, but an event with this probability.
    #[inline(always)]
    fn of_event(probability: f64) -> Self {
        Self { potential: ln(probability.max(f64::MIN_POSITIVE)), ..Self::NONE }
    }

    #[inline(always)]
    fn student(error: f64, scale: f64, freedom: Freedom) -> Self {
        Self { freedom: Some(freedom), ..Self::normal(error, scale) }
    }

    /// The log-likelihoods of the particles of a block.
    #[inline(always)]
    fn log_likelihoods(errors: &[Self; LANES], into: &mut Lanes) {
        let [first, ..] = errors;
        let is_alike =
            |error: &Self| (error.is_observed, error.freedom) == (first.is_observed, first.freedom);
        if !errors.iter().all(is_alike) {
            into.iter_mut().zip(errors).for_each(|(into, error)| *into = error.log_likelihood());
            return;
        }
        // On the stack of this function, so that the compiler knows that the columns do not overlap.
        let (mut xs, mut scales, mut potentials) = (Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);
        for lane in 0..LANES {
            let Self { error, scale, potential, .. } = errors[lane];
            (xs[lane], scales[lane], potentials[lane]) = (error, scale, potential);
        }
        // The distribution is chosen before the loop over the particles, which then goes by vectors. A macro,
        // because a function that is passed would be called for each particle.
        macro_rules! with {
            ($density:ident) => {
                for lane in 0..LANES {
                    into[lane] = $density(xs[lane], scales[lane]) + potentials[lane];
                }
            };
        }
        match (first.is_observed, first.freedom) {
            (false, _) => *into = potentials,
            (true, None) => with!(normal),
            (true, Some(Freedom::Two)) => with!(student_of_two),
            (true, Some(Freedom::Three)) => with!(student_of_three),
        }
    }

    #[inline(always)]
    fn log_likelihood(self) -> f64 {
        let density = match (self.is_observed, self.freedom) {
            (false, _) => 0.0,
            (true, None) => normal(self.error, self.scale),
            (true, Some(freedom)) => freedom.log_density(self.error, self.scale),
        };
        density + self.potential
    }

    /// The likelihood that the recorder would have shown this ΔV at the end of the impact, or a larger one;
    /// for a vehicle that is slowed, a more negative one.
    #[inline(always)]
    fn or_beyond(self, slows: bool) -> Self {
        let Some(freedom) = self.freedom else { return Self::NONE };
        let z = self.error / self.scale;
        // P(Y ≥ y) = F(−ε/σ), P(Y ≤ y) = F(ε/σ)
        Self::of_event(freedom.share_below(if slows { z } else { -z }))
    }

    /// Its normal score.
    fn score(self) -> f64 {
        match (self.is_observed, self.freedom) {
            (false, _) => f64::NAN,
            (true, None) => self.error / self.scale,
            (true, Some(freedom)) => {
                let mut share = [freedom.share_below(self.error / self.scale)];
                uncertainty::normal::quantiles(&mut share);
                share[0]
            }
        }
    }
}

/// (m/s) velocity of the common CG of both vehicles after the impact. The masses are inversely proportional
/// to the sizes of ΔV: V = (|ΔV₂| V₁ + |ΔV₁| V₂)/(|ΔV₁| + |ΔV₂|).
fn of_common_cg(outcome: &Outcome) -> Vector2<f64> {
    let ([one, two], [dv1, dv2]) = (outcome.after, outcome.delta_v_magnitude());
    (one.velocity * dv2 + two.velocity * dv1) * (1.0 / (dv1 + dv2))
}

fn length(vector: Vector2<f64>) -> f64 {
    Real::sqrt(vector.x * vector.x + vector.y * vector.y)
}

impl<I: Impacts> Prior for CollisionModel<I> {
    fn values_count(&self) -> usize {
        self.impacts.unknown().values_count()
    }

    #[inline(always)]
    fn values(&self, standard: &[Lanes], values: &mut [Lanes]) {
        self.impacts.unknown().values(standard, values);
    }
}

impl<I: Impacts> Evidence for CollisionModel<I> {
    fn terms_count(&self) -> usize {
        self.pieces.len()
    }

    #[inline(always)]
    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], reasons: &mut [u8; LANES]) {
        let impacts = self.impacts.impacts(values);
        self.judge(&impacts, terms, reasons);
    }

    #[inline(never)]
    fn log_likelihood_of_used(
        &self,
        values: &[Lanes],
        used: &[bool],
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) {
        let mut wanted = |id: VehicleId, _: &[Impacted]| [self.tells_way(id, used); LANES];
        match self.impacts.impacts_as_wanted(values, &mut wanted) {
            Some(impacts) => self.judge(&impacts, terms, reasons),
            None => self.log_likelihood(values, terms, reasons),
        }
    }

    #[inline(never)]
    fn log_likelihood_of_proposals(
        &self,
        values: &[Lanes],
        hurdle: &Hurdle<'_>,
        terms: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> bool {
        let mut wanted = |id: VehicleId, impacts: &[Impacted]| {
            if !self.tells_way(id, hurdle.used()) {
                return [false; LANES];
            }
            self.judge(impacts, terms, &mut [0; LANES]);
            hurdle.takes(terms)
        };
        let Some(impacts) = self.impacts.impacts_as_wanted(values, &mut wanted) else { return false };
        self.judge(&impacts, terms, reasons);
        true
    }

    fn parts(&self) -> Vec<Part> {
        CollisionModel::parts(self)
    }

    fn score_on_circle(&self, part: usize, error: f64) -> f64 {
        self.score_of_angle(part, error)
    }

    fn outputs_count(&self) -> usize {
        self.impacts.outputs_count()
    }

    fn describe(&self, values: &[Lanes], outputs: &mut [Lanes], residuals: &mut [Lanes]) {
        let impacts = self.impacts.impacts(values);
        for (place, column) in outputs.iter_mut().enumerate() {
            for (number, impacted) in column.iter_mut().zip(&impacts) {
                *number = self.impacts.output(place, impacted);
            }
        }
        self.score(&impacts, residuals);
    }
}

impl Collision {
    /// The collision with the index of each unknown number, which is appended to `unknown`.
    fn placed(&self, unknown: &mut Vec<Distribution>) -> Collision<Slot> {
        let mut place = |number: Number| match number {
            Number::Exact(number) => Slot::Exact(number),
            Number::Unknown(distribution) => {
                unknown.push(distribution);
                Slot::At(unknown.len() - 1)
            }
        };
        // This is the order of the unknown numbers.
        let speeds = self.speeds.map(&mut place);
        let restitution = self.restitution.map(&mut place);
        let (crush_plane, friction, tangential_share) =
            (place(self.crush_plane), place(self.friction), place(self.tangential_share));
        let other_crush = self.other_crush.map(|other| other.map(&mut place));
        let vehicles = self.vehicles.map(|vehicle| {
            let VehicleNumbers { body, heading, contact, yaw_rate, crush } = vehicle;
            VehicleNumbers {
                body: body.map(|BodyNumbers { mass, yaw_radius }| BodyNumbers {
                    mass: place(mass),
                    yaw_radius: place(yaw_radius),
                }),
                heading: place(heading),
                contact: contact.map(&mut place),
                yaw_rate: place(yaw_rate),
                crush: crush.map(|CrushNumbers { constant, linear, square, slope, no_damage_speed }| {
                    CrushNumbers {
                        constant,
                        linear,
                        square,
                        slope: place(slope),
                        no_damage_speed: place(no_damage_speed),
                    }
                }),
            }
        });
        let observed = self.observed.clone();
        Collision {
            vehicles,
            speeds,
            crush_plane,
            restitution,
            friction,
            tangential_share,
            other_crush,
            observed,
        }
    }
}
