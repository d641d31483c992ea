//! What each piece of evidence says.

use std::f64::consts::FRAC_PI_2;

use ::estimate::{
    CannotReweight, Draws, DrawsSummary, ESS_LIMIT, PieceCheck, Posterior, SamplerDoubt, Verdict, Weights,
};
use ::uncertainty::Estimate;
use evidence::Piece;
use pim_core::VehicleId;

use super::outputs::Told;
use crate::excluded::key;

/// A piece of evidence, and what it does to the answer.
#[derive(Clone, Debug)]
pub struct PieceFound {
    /// Which.
    pub piece: Piece,
    /// Its key in the case.
    pub key: String,
    /// (m/s) the speeds of the vehicles that move by this piece alone, beside what is known before the
    /// evidence; `None` where it was not asked for, or where that run did not converge.
    pub alone: Option<[Option<DrawsSummary>; 2]>,
    /// (m/s) the speeds by all other pieces.
    pub without: Option<[Option<DrawsSummary>; 2]>,
    /// (–) probability that all other pieces give an observation at least as far off; `None` of a piece that
    /// is no single measurement, or where it cannot be told.
    pub p_value: Option<Estimate>,
    /// Whether it points the other way than all other pieces say: a direction by more than a right angle, and
    /// a longitudinal ΔV by its sign.
    pub reversed: bool,
}

/// Two pieces that may say the same thing twice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SameTwice {
    /// Their keys.
    pub keys: [String; 2],
}

/// Draws that are there already, from which most of what a piece says can be told.
#[derive(Clone, Copy)]
pub(super) struct There<'a> {
    /// By all evidence.
    pub(super) posterior: &'a Posterior,
    /// Before it; `None` where that run did not converge.
    pub(super) before: Option<&'a Posterior>,
}

/// Another run that shows what a piece does.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    /// With these terms alone.
    Only(Vec<usize>),
    /// All but this one, from the draws with it.
    Without(usize),
    /// All but this one, from the prior: where the piece contradicts the rest, too few of the draws with it
    /// lead there.
    WithoutAnew(usize),
}

/// Runs with other terms; `None` where that fails.
pub(super) type Again<'a> = dyn FnMut(Wanted) -> Option<Posterior> + 'a;

/// The least effective sample size of a run of which only a median and an interval are shown, rounded to few
/// digits: the ends of the interval are then known to about a quarter of the standard deviation.
const BESIDE_ESS: f64 = 100.0;

/// Whether a run beside the answer shows a median and an interval: it may be worth fewer draws than an
/// answer, but must not be wrong otherwise.
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

/// What a piece does to the answer. The speeds by it alone and without it are those of the draws that are
/// there, under other weights where enough of these count, and of `again` where not; without `again` they are
/// left out. `always` are the terms that hold in every run.
pub(super) fn found(
    (term, piece): (usize, Piece),
    told: &Told<'_>,
    there: There<'_>,
    always: &[usize],
    again: Option<&mut Again<'_>>,
) -> PieceFound {
    let There { posterior, before } = there;
    let check = posterior.check(term).ok();
    let is_behind = |check: &PieceCheck| check.mean_on_circle.is_some_and(|error| error.abs() > FRAC_PI_2);
    let mut reversed = check.as_ref().is_some_and(is_behind);
    let mut p_value = check.filter(PieceCheck::is_reliable).map(|check| check.p_value);
    let (mut alone, mut without) = (None, None);
    if let Some(again) = again {
        let speeds = |run: &Posterior, draws: Draws<'_>| {
            VehicleId::ALL.map(|id| Some(draws.summary(told.speed(run, id)?)))
        };
        let weighted = |run: &Posterior, weights: Result<Weights, CannotReweight>| {
            let weights = weights.ok()?;
            let suffice = weights.are_reliable() && run.worth(&weights) >= ESS_LIMIT;
            suffice.then(|| speeds(run, run.weighted(&weights)))
        };
        let mut run = |wanted: Wanted| again(wanted).filter(suffices);
        alone = before.and_then(|before| weighted(before, before.with(term))).or_else(|| {
            let only = always.iter().copied().chain([term]).collect();
            run(Wanted::Only(only)).map(|run| speeds(&run, run.draws()))
        });
        without = weighted(posterior, posterior.without(&[term]));
        if without.is_none()
            && let Some(run) = run(Wanted::Without(term)).or_else(|| run(Wanted::WithoutAnew(term)))
        {
            if p_value.is_none()
                && let Ok(check) = run.check(term)
            {
                reversed = is_behind(&check);
                p_value = Some(check.p_value);
            }
            without = Some(speeds(&run, run.draws()));
        }
    }
    PieceFound { piece, key: key(piece), alone, without, p_value, reversed }
}

/// The motion after the impact is usually found from the rest, and the same rest is then counted twice. A
/// recorder that stores the speed at the impact stores that before the brakes, too, by the same wheels. And
/// who codes a PDOF may have read the recorder.
pub(super) fn same_twice(pieces: &[Piece]) -> Vec<SameTwice> {
    let of = |id: VehicleId| {
        [
            [Piece::SpeedAfter(id), Piece::Rest(id)],
            [Piece::DirectionAfter(id), Piece::Rest(id)],
            [Piece::YawRateAfter(id), Piece::Rest(id)],
            [Piece::Pdof(id), Piece::RecordedDirection(id)],
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

    /// Only where both are there, and of one vehicle.
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
