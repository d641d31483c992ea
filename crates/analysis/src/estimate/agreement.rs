//! Whether the other evidence agrees with each piece.

use inputs::choices;

use super::Estimated;
use super::pieces::PieceFound;

/// (–) probability that any piece raises a warning if all are right: the smallest p-value has to be below its
/// share of this (Holm).
pub const DOUBTFUL: f64 = 0.05;
/// (–) a piece that raises a warning and has a p-value below this contradicts the rest.
pub const CONTRADICTS: f64 = 0.01;

#[expect(clippy::cast_precision_loss, reason = "a number of pieces")]
fn times(count: usize) -> f64 {
    count as f64
}

choices! {
    /// The verdict of all other evidence on a piece.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Agreement {
        /// It agrees.
        Agrees = "agrees",
        /// It disagrees.
        Doubtful = "doubtful",
        /// It excludes the piece, at a level of one in a hundred.
        Contradicts = "contradicts",
    }
}

impl Agreement {
    /// The verdict on each piece, with its p-value times the number of p-values that are no smaller (S. Holm,
    /// Scandinavian Journal of Statistics 6, 1979), at most 1; `None` without a p-value.
    #[must_use]
    pub fn of_all(pieces: &[PieceFound]) -> Vec<Option<(Self, f64)>> {
        let mut order: Vec<(usize, f64)> = pieces
            .iter()
            .enumerate()
            .filter_map(|(place, piece)| Some((place, piece.p_value?.value)))
            .collect();
        order.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut found = vec![None; pieces.len()];
        let mut greatest: f64 = 0.0;
        let count = order.len();
        for (rank, (place, p)) in order.into_iter().enumerate() {
            // p′ = max over those before of (m − k) p
            greatest = greatest.max((p * times(count - rank)).min(1.0));
            let agreement = match greatest {
                adjusted if adjusted >= DOUBTFUL => Self::Agrees,
                _ if p < CONTRADICTS => Self::Contradicts,
                _ => Self::Doubtful,
            };
            found[place] = Some((agreement, greatest));
        }
        found
    }
}

impl Estimated {
    /// The keys of the pieces on which the other evidence has this verdict. Pieces with which no collision
    /// agrees are among the contradicting ones.
    #[must_use]
    pub fn with_agreement(&self, wanted: Agreement) -> Vec<String> {
        let judged = self.pieces.iter().zip(Agreement::of_all(&self.pieces));
        let is = |agreement: Option<(Agreement, f64)>| agreement.is_some_and(|(is, _)| is == wanted);
        let mut keys: Vec<String> =
            judged.filter(|(_, agreement)| is(*agreement)).map(|(piece, _)| piece.key.clone()).collect();
        let missed = self.missed.iter().filter(|_| wanted == Agreement::Contradicts);
        for key in missed {
            if !keys.contains(key) {
                keys.push(key.clone());
            }
        }
        keys
    }
}
