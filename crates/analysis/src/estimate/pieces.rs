//! What each piece of evidence says.

use ::estimate::{Posterior, Summary, Verdict};
use ::uncertainty::Estimate;
use evidence::Piece;
use pim_core::VehicleId;

use super::outputs::Told;
use super::table;

/// A piece of evidence, and what it does to the answer.
#[derive(Clone, Debug)]
pub struct PieceFound {
    /// Which.
    pub piece: Piece,
    /// Its key in the case.
    pub key: String,
    /// (m/s) the speeds of the vehicles that move by this piece alone, beside what is known before the
    /// evidence; `None` where it was not asked for, or where that run did not converge.
    pub alone: Option<[Option<Summary>; 2]>,
    /// (m/s) the speeds by all other pieces.
    pub without: Option<[Option<Summary>; 2]>,
    /// (–) probability that all other pieces give an observation at least as far off; `None` of a piece that
    /// is no single measurement, or where it cannot be told.
    pub p_value: Option<Estimate>,
}

/// Two pieces that may say the same thing twice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SameTwice {
    /// Their keys.
    pub keys: [String; 2],
}

/// The key of a piece in the case.
pub(super) fn key(piece: Piece) -> String {
    let of = |id: VehicleId, key: &str| format!("{}.{key}", table(id));
    match piece {
        Piece::Severity => "estimate.prior".to_owned(),
        Piece::Crush => "crush".to_owned(),
        Piece::Pdof(id) => of(id, "crush.pdof"),
        Piece::SpeedAfter(id) => of(id, "after.speed"),
        Piece::DirectionAfter(id) => of(id, "after.direction"),
        Piece::YawRateAfter(id) => of(id, "after.yaw_rate"),
        Piece::RecordedDeltaV(id) => of(id, "recorder.delta_v"),
        Piece::Rest(id) => of(id, "after.rest"),
        Piece::Points(id) => of(id, "after.points"),
        Piece::RecordedSpeed(id) => of(id, "recorder.speed"),
        Piece::RecordedYawRate(id) => of(id, "recorder.yaw_rate"),
        Piece::Limits(id) => of(id, "certain_speed"),
    }
}

pub(super) fn found(
    piece: Piece,
    term: usize,
    told: &Told<'_>,
    posterior: &Posterior,
    alone: Option<Posterior>,
    without: Option<Posterior>,
) -> PieceFound {
    let check = posterior.check(term).ok();
    let p_value = match check {
        Some(check) if check.is_reliable() => Some(check.p_value),
        // From the draws without it.
        _ => without
            .as_ref()
            .filter(|without| without.verdict() == Verdict::Converged)
            .and_then(|without| Some(without.check(term).ok()?.p_value)),
    };
    let speeds = |run: Option<Posterior>| {
        let run = run.filter(|run| run.verdict() == Verdict::Converged)?;
        Some(VehicleId::ALL.map(|id| Some(run.draws().summary(told.speed(&run, id)?))))
    };
    PieceFound { piece, key: key(piece), alone: speeds(alone), without: speeds(without), p_value }
}

/// The motion after the impact is usually found from the rest, and the same rest is then counted twice.
pub(super) fn same_twice(pieces: &[Piece]) -> Vec<SameTwice> {
    let has = |piece: Piece| pieces.contains(&piece);
    VehicleId::ALL
        .into_iter()
        .flat_map(|id| {
            let rest = has(Piece::Rest(id));
            [Piece::SpeedAfter(id), Piece::DirectionAfter(id), Piece::YawRateAfter(id)]
                .into_iter()
                .filter(move |piece| rest && has(*piece))
                .map(move |piece| SameTwice { keys: [key(piece), key(Piece::Rest(id))] })
        })
        .collect()
}
