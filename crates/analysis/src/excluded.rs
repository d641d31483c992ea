//! The pieces of evidence that exclude every collision, and their keys.

use ::estimate::Exclusion;
use evidence::Piece;
use inputs::table;
use pim_core::VehicleId;

/// The evidence that excludes every collision that is possible before it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Impossible {
    /// The smallest set that excludes all: no piece if no draw makes an impact, and two if both are possible
    /// alone but not together.
    pub culprits: Vec<Piece>,
    /// Whether it takes more than two pieces.
    pub together: bool,
    /// How many draws each piece excluded.
    pub exclusion: Exclusion,
}

impl std::fmt::Display for Impossible {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let named = |piece: &Piece| format!("`{}`", key(*piece));
        match self.culprits.as_slice() {
            [one] => write!(f, "{} excludes every collision that is otherwise possible", named(one)),
            [one, two] => {
                write!(f, "{} and {} exclude each other: either alone is possible", named(one), named(two))
            }
            _ if self.together => f.write_str("the evidence excludes every collision, though no two pieces of it do"),
            _ if self.exclusion.possible > 0 => write!(
                f,
                "the evidence excludes nearly every collision: {} of {} tried are possible",
                self.exclusion.possible, self.exclusion.drawn
            ),
            _ => f.write_str(
                "no speeds bring the vehicles together: with the headings, contact points and crush plane of the case they do not approach each other",
            ),
        }
    }
}

/// The key of a piece in the case.
pub(crate) fn key(piece: Piece) -> String {
    let of = |id: VehicleId, key: &str| format!("{}.{key}", table(id));
    match piece {
        Piece::Severity => "estimate.prior".to_owned(),
        Piece::Crush | Piece::NoResidualCrush => "crush".to_owned(),
        Piece::Pdof(id) => of(id, "crush.pdof"),
        Piece::SpeedAfter(id) => of(id, "after.speed"),
        Piece::DirectionAfter(id) => of(id, "after.direction"),
        Piece::YawRateAfter(id) => of(id, "after.yaw_rate"),
        Piece::RecordedDeltaV(id) | Piece::LeastDeltaV(id) => of(id, "recorder.delta_v"),
        Piece::RecordedDirection(id) => of(id, "recorder.delta_v_lateral"),
        Piece::Rest(id) => of(id, "after.rest"),
        Piece::Points(id) => of(id, "after.points"),
        Piece::RecordedSpeed(id) => of(id, "recorder.speed"),
        Piece::RecordedYawRate(id) => of(id, "recorder.yaw_rate"),
        Piece::SkidSpeed(id) => of(id, "before.speed"),
        Piece::Limits(id) => of(id, "certain_speed"),
    }
}
