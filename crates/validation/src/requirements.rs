//! The requirements of the methods, and the results of their tests: a laboratory's record of the validation
//! (ISO/IEC 17025:2017, 7.2.2.4).

use crate::{Cell, Validation};

/// (–) largest difference of the energy lost from the work of the impulses, as a share of it.
const BALANCE: f64 = 1e-12;

/// A requirement, its test, its acceptance criterion and the result.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// Its name.
    pub code: &'static str,
    /// The requirement.
    pub requirement: &'static str,
    /// The test.
    pub test: &'static str,
    /// The acceptance criterion.
    pub acceptance: &'static str,
    /// Number of values that were compared.
    pub compared: usize,
    /// Number of those that are beyond their tolerance, or are not a number.
    pub failed: usize,
    /// (–) largest difference as a share of its tolerance; infinite if a value is not a number.
    pub worst: f64,
}

impl Requirement {
    /// Whether every value is within its tolerance.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.failed == 0
    }

    /// From differences as shares of their tolerances.
    fn judged(
        [code, requirement, test, acceptance]: [&'static str; 4],
        shares: impl Iterator<Item = f64>,
    ) -> Self {
        let mut found = Self { code, requirement, test, acceptance, compared: 0, failed: 0, worst: 0.0 };
        for share in shares.map(|share| if share.is_nan() { f64::INFINITY } else { share }) {
            found.compared += 1;
            found.failed += usize::from(share > 1.0);
            found.worst = found.worst.max(share);
        }
        found
    }
}

const PRINTED: &str = "the tolerance in its table";

/// The requirements about printed numbers: how the names of their cells begin, and their texts.
const OF_CELLS: [(&str, [&str; 4]); 8] = [
    ("Table 1", ["rms", "The rms errors of ΔV are those of SAE 980025", "Table 1", PRINTED]),
    ("Table 2", ["delta-v", "ΔV by PIM and by CRASH3 are those of SAE 980025", "Table 2", PRINTED]),
    ("Table 3", ["turned", "The same with the direction of the force turned", "Table 3", PRINTED]),
    (
        "SAE 871993",
        ["energies", "The energies of each impact are those of SAE 871993", "its Table 1", PRINTED],
    ),
    ("appendix", ["example", "The worked example is that of SAE 980025", "its appendix", PRINTED]),
    (
        "reconstruction",
        ["speed", "The speed that gave an energy is found from it", "reconstruction, round trip", PRINTED],
    ),
    (
        "motion to rest",
        ["motion", "Vehicles come to rest where published simulations end", "SAE 871993 and CRASH3", PRINTED],
    ),
    (
        "back from rest",
        ["rest", "The motion that led to a rest is found from it", "back from rest, round trip", PRINTED],
    ),
];

impl Validation {
    /// The requirements with their results.
    #[must_use]
    pub fn requirements(&self) -> Vec<Requirement> {
        let cells = self.cells();
        let of_cells = OF_CELLS.map(|(place, words)| {
            let own = cells.iter().filter(|(name, _)| name.starts_with(place));
            Requirement::judged(words, own.filter_map(|(_, cell)| share_of_tolerance(cell)))
        });
        // W_n + W_t = E_L
        let balance = self.energies.iter().map(|row| {
            let lost = row.total.ours;
            (row.normal.ours + row.tangential.ours - lost).abs() / (lost.abs() * BALANCE)
        });
        let words = [
            "balance",
            "The work of the impulses is the energy lost",
            "W_n + W_t = E_L in every collision",
            "1e-12 of E_L",
        ];
        of_cells.into_iter().chain([Requirement::judged(words, balance)]).collect()
    }
}

/// (–) the difference of a claimed number as a share of its tolerance.
fn share_of_tolerance(cell: &Cell) -> Option<f64> {
    Some(cell.difference().abs() / cell.tolerance()?)
}
