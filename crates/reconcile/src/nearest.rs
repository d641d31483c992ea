//! The nearest impact to a problem without an answer.

use core::iter::{once, successors};

use pim_core::{ImpactError, Outcome};

use crate::answer::Iteration;
use crate::posed::Posed;
use crate::problem::Problem;

/// The scan of approach speeds goes from this fraction of the one that a frictionless impact would need …
const SCAN_START: f64 = 1.0 / 1024.0;
/// … by this factor, 2^¹⁄₃₂, …
const SCAN_RATIO: f64 = 1.021_897_148_654_116_7;
/// … to 1024 times that speed.
const SCAN_SAMPLES: usize = 641;
/// The range about the best sample is narrowed by thirds, (2/3)⁴⁴ ≈ 2⁻²⁶, which locates the extremum of W_n
/// to rounding.
const TURN_STEPS: usize = 44;

impl Problem {
    /// (J) W_n + λ W_t of an impact, which is compared with the crush energy.
    fn held_against_crush(&self, outcome: &Outcome) -> f64 {
        let tangential = if self.tangential_share == 0.0 {
            0.0
        } else {
            self.tangential_share * outcome.energy.tangential_work
        };
        outcome.energy.normal_work + tangential
    }

    /// The possible impact whose normal work is nearest to the one sought, to report with
    /// [`NotReached`](crate::ReconcileError::NotReached). It is found by a scan of the approach speed.
    ///
    /// # Errors
    /// If no impact is possible: the reason at the approach speed that a frictionless impact would need.
    pub fn nearest(&self) -> Result<Iteration, ImpactError> {
        let posed = Posed { problem: self, line: self.line() };
        let frictionless = posed.frictionless_approach_speed();
        // Relative, because under a restitution curve the value sought depends on the speed.
        let miss = |x: f64| match self.impact(posed.line.speed(x)) {
            Ok((law, outcome)) => (self.held_against_crush(&outcome) / self.sought(&law) - 1.0).abs(),
            Err(_) => f64::INFINITY,
        };
        let scan = successors(Some(frictionless * SCAN_START), |x| Some(x * SCAN_RATIO));
        let best = once(frictionless)
            .chain(scan.take(SCAN_SAMPLES))
            .min_by(|&a, &b| miss(a).total_cmp(&miss(b)))
            .unwrap_or(frictionless);
        let (mut low, mut high) = (best / SCAN_RATIO, best * SCAN_RATIO);
        for _ in 0..TURN_STEPS {
            let [left, right] = thirds(low, high);
            if miss(left) < miss(right) {
                high = right;
            } else {
                low = left;
            }
        }
        let speed = posed.line.speed(if miss(low) < miss(best) { low } else { best });
        self.impact(speed)
            .map(|(_, outcome)| Iteration { speed, normal_work: self.held_against_crush(&outcome) })
    }
}

fn thirds(a: f64, b: f64) -> [f64; 2] {
    [(2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0]
}
