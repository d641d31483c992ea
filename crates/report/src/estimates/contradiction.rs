//! Evidence that the other evidence contradicts, in words.

use analysis::{Agreement, PieceFound};
use evidence::Piece;

use super::piece_name;
use crate::units::significant;

/// The pieces that the other evidence contradicts or makes doubtful, one sentence each.
pub(crate) fn contradictions(pieces: &[PieceFound]) -> Vec<String> {
    let judged = pieces.iter().zip(Agreement::of_all(pieces));
    judged.filter_map(|(piece, agreement)| said(piece, agreement?.0)).collect()
}

fn said(piece: &PieceFound, agreement: Agreement) -> Option<String> {
    let name = format!("{} (`{}`)", piece_name(piece.piece), piece.key);
    let p = piece.p_value.map(|p| with_sign(p.value)).unwrap_or_default();
    match agreement {
        Agreement::Contradicts if piece.reversed => Some(format!(
            "{name} contradicts the other evidence: {p}. It points in the opposite direction to all the rest{}.",
            turned_round(piece.piece)
        )),
        Agreement::Contradicts => Some(format!(
            "{name} contradicts the other evidence: {p}. The medians follow the more certain of the two or \
             lie between them, and may be wrong; check what was measured, and its error."
        )),
        Agreement::Doubtful => Some(format!("the other evidence disagrees with {name}: {p}.")),
        Agreement::Agrees => None,
    }
}

/// The probable mistake in a piece that points in the opposite direction.
fn turned_round(piece: Piece) -> &'static str {
    match piece {
        Piece::RecordedDeltaV(_) => {
            ": it may have the wrong sign. The longitudinal ΔV is negative if the vehicle was slowed down, as \
             in a frontal impact, and positive if it was pushed forward"
        }
        Piece::RecordedDirection(_) => {
            ": a sign may be wrong. The longitudinal ΔV is negative if the vehicle was slowed down, as in a \
             frontal impact; the lateral ΔV is positive towards y, which is left, or right in axes with z down"
        }
        Piece::Pdof(_) => {
            ": it may be reversed. The PDOF is where the force came from, clockwise from the heading: 0° at the \
             front, 180° at the rear"
        }
        Piece::DirectionAfter(_) => {
            ": it may be reversed. It is the direction in the scene in which the vehicle left the impact"
        }
        _ => "",
    }
}

pub(crate) fn p_value(p: f64) -> String {
    if p < 0.001 { "< 0.001".to_owned() } else { significant(p, 2) }
}

fn with_sign(p: f64) -> String {
    let value = p_value(p);
    if value.starts_with('<') { format!("p {value}") } else { format!("p = {value}") }
}
