//! The effect of each piece of evidence.

use std::f64::consts::FRAC_PI_2;

use ::estimate::{
    CannotReweight, Draws, DrawsSummary, ESS_LIMIT, PieceCheck, Posterior, SamplerDoubt, Verdict, Weights,
};
use ::uncertainty::Estimate;
use evidence::Piece;
use pim_core::VehicleId;

use super::PieceDetail;
use super::impacts::CaseImpacts;
use crate::excluded::key;

/// A piece of evidence, and its effect on the answer.
#[derive(Clone, Debug)]
pub struct PieceFound {
    /// The piece.
    pub piece: Piece,
    /// Its key in the case.
    pub key: String,
    /// (m/s) the speeds of the moving vehicles by this piece alone, in addition to what is known before the
    /// evidence; `None` if not requested, or if that run did not converge.
    pub alone: Option<[Option<DrawsSummary>; 2]>,
    /// (m/s) the speeds by all other pieces.
    pub without: Option<[Option<DrawsSummary>; 2]>,
    /// (–) probability that all other pieces give an observation at least as far off; `None` if the piece is
    /// not a single measurement, or if it cannot be computed.
    pub p_value: Option<Estimate>,
    /// Whether it contradicts all other pieces in direction: a direction by more than a right angle, or a
    /// longitudinal ΔV by its sign.
    pub reversed: bool,
}

/// Two pieces that may count the same observation twice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SameTwice {
    /// Their keys.
    pub keys: [String; 2],
}

/// Existing draws, from which most effects of a piece can be computed.
#[derive(Clone, Copy)]
pub(super) struct There<'a> {
    /// Given all evidence.
    pub(super) posterior: &'a Posterior,
    /// Before the evidence; `None` if that run did not converge.
    pub(super) before: Option<&'a Posterior>,
}

/// Another run, to show the effect of a piece.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    /// With only these terms.
    Only(Vec<usize>),
    /// All but this one, from the draws with it.
    Without(usize),
    /// All but this one, from the prior: if the piece contradicts the rest, too few of the draws with it lead
    /// there.
    WithoutAnew(usize),
}

/// Runs with other terms; `None` if that fails.
pub(super) type Again<'a> = dyn FnMut(Wanted) -> Option<Posterior> + 'a;

/// Minimum effective sample size of a run that only yields a median and an interval, rounded to few digits:
/// the ends of the interval are then known to about a quarter of the standard deviation.
const BESIDE_ESS: f64 = 100.0;

/// Whether an additional run yields a median and an interval: it may have a smaller effective sample size
/// than an answer, but no other doubts.
fn suffices(run: &Posterior) -> bool {
    let is_by_few_draws = |doubt: &SamplerDoubt| match doubt {
        SamplerDoubt::FewDraws { ess, .. } => *ess >= BESIDE_ESS,
        // Both follow from the same spread between the islands as the effective sample size.
        SamplerDoubt::Disagreement { .. } | SamplerDoubt::Extremes { .. } => {
            run.diagnosis().ess() >= BESIDE_ESS
        }
        _ => false,
    };
    match run.verdict() {
        Verdict::Converged => true,
        Verdict::NotConverged(doubts) => doubts.iter().all(is_by_few_draws),
    }
}

/// The effect of a piece on the answer, in as much detail as is asked for. It is found from the existing
/// draws, reweighted, if enough of these count, and otherwise by `again`. `always` are the terms of every
/// run.
pub(super) fn found(
    (term, piece): (usize, Piece),
    impacts: &CaseImpacts,
    there: There<'_>,
    always: &[usize],
    (detail, again): (PieceDetail, &mut Again<'_>),
) -> PieceFound {
    let There { posterior, before } = there;
    let check = posterior.check(term).ok();
    let is_behind = |check: &PieceCheck| check.mean_on_circle.is_some_and(|error| error.abs() > FRAC_PI_2);
    let mut reversed = check.as_ref().is_some_and(is_behind);
    let is_unclear = check.as_ref().is_some_and(|check| !check.is_reliable());
    let mut p_value = check.filter(PieceCheck::is_reliable).map(|check| check.p_value);
    let (mut alone, mut without) = (None, None);
    let speeds = |run: &Posterior, draws: Draws<'_>| {
        VehicleId::ALL.map(|id| Some(draws.summary(impacts.speed(run, id)?)))
    };
    let mut run = |wanted: Wanted| again(wanted).filter(suffices);
    if detail == PieceDetail::Apart {
        let weighted = |run: &Posterior, weights: Result<Weights, CannotReweight>| {
            let weights = weights.ok()?;
            let suffice = weights.are_reliable() && run.worth(&weights) >= ESS_LIMIT;
            suffice.then(|| speeds(run, run.weighted(&weights)))
        };
        alone = before.and_then(|before| weighted(before, before.with(term))).or_else(|| {
            let only = always.iter().copied().chain([term]).collect();
            run(Wanted::Only(only)).map(|run| speeds(&run, run.draws()))
        });
        without = weighted(posterior, posterior.without(&[term]));
    }
    let is_wanted = match detail {
        PieceDetail::Weighed => false,
        PieceDetail::Compared => is_unclear,
        PieceDetail::Apart => without.is_none(),
    };
    if is_wanted && let Some(run) = run(Wanted::Without(term)).or_else(|| run(Wanted::WithoutAnew(term))) {
        if p_value.is_none()
            && let Ok(check) = run.check(term)
        {
            reversed = is_behind(&check);
            p_value = Some(check.p_value);
        }
        without = (detail == PieceDetail::Apart).then(|| speeds(&run, run.draws()));
    }
    PieceFound { piece, key: key(piece), alone, without, p_value, reversed }
}

/// The motion after the impact is usually found from the rest position, which is then counted twice. A
/// recorder that stores the speed at the impact measures it with the same wheels as the speed before braking.
/// And the coder of a PDOF may have read the recorder.
pub(super) fn same_twice(pieces: &[Piece]) -> Vec<SameTwice> {
    let of = |id: VehicleId| {
        [
            [Piece::SpeedAfter(id), Piece::Rest(id)],
            [Piece::DirectionAfter(id), Piece::Rest(id)],
            [Piece::YawRateAfter(id), Piece::Rest(id)],
            [Piece::Pdof(id), Piece::RecordedDirection(id)],
            [Piece::YawRateAfter(id), Piece::RecordedYawRate(id)],
            [Piece::SkidSpeed(id), Piece::RecordedSpeed(id)],
        ]
    };
    VehicleId::ALL
        .into_iter()
        .flat_map(of)
        .filter(|both| both.iter().all(|piece| pieces.contains(piece)))
        .map(|both| SameTwice { keys: both.map(key) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::same_twice;
    use evidence::Piece;
    use pim_core::VehicleId::{One, Two};

    /// Only if both are present, for the same vehicle.
    #[test]
    fn what_says_the_same_twice_is_named() {
        let keys =
            |pieces: &[Piece]| same_twice(pieces).into_iter().map(|same| same.keys).collect::<Vec<_>>();
        let pairs = [
            (Piece::SpeedAfter(One), Piece::Rest(One), ["vehicle1.after.speed", "vehicle1.after.rest"]),
            (
                Piece::DirectionAfter(Two),
                Piece::Rest(Two),
                ["vehicle2.after.direction", "vehicle2.after.rest"],
            ),
            (Piece::YawRateAfter(One), Piece::Rest(One), ["vehicle1.after.yaw_rate", "vehicle1.after.rest"]),
            (
                Piece::Pdof(Two),
                Piece::RecordedDirection(Two),
                ["vehicle2.crush.pdof", "vehicle2.recorder.delta_v_lateral"],
            ),
            (
                Piece::YawRateAfter(Two),
                Piece::RecordedYawRate(Two),
                ["vehicle2.after.yaw_rate", "vehicle2.recorder.yaw_rate"],
            ),
            (
                Piece::SkidSpeed(One),
                Piece::RecordedSpeed(One),
                ["vehicle1.before.speed", "vehicle1.recorder.speed"],
            ),
        ];
        for (one, other, expected) in pairs {
            assert_eq!(keys(&[one, Piece::Crush, other]), [expected.map(str::to_owned)]);
            assert!(keys(&[one, Piece::Crush]).is_empty() && keys(&[other]).is_empty());
        }
        assert!(keys(&[Piece::SpeedAfter(One), Piece::Rest(Two)]).is_empty());
    }
}
