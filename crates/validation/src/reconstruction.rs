//! The speed of vehicle 1 found from crush energy, compared with the true one, and its dependence on the
//! analyst's choices.

use crate::claim::Cell;
use crate::error::ValidationError;
use crate::published::{DEGREE, FOOT_POUND};
use crate::staged::Staged;
use crate::statistics::ErrorRate;

/// The energies of SAE 871993 agree within 1 %, and energy goes with the square of speed.
const SPEED: f64 = 0.005;

/// Reconstructions of one test. Vehicle 2's motion, e and μ are those of the test.
#[derive(Clone, Debug, PartialEq)]
pub struct Reconstruction {
    /// The test.
    pub test: u8,
    /// (m/s) true speed of vehicle 1.
    pub true_speed: f64,
    /// (J) crush energy of both vehicles from the published profiles and CRASH3's stiffness.
    pub crush_energy: f64,
    /// (m/s) the speed found from it: the answer of `deltav reconstruct`.
    pub found: f64,
    /// (J) crush energy that the paper's own numbers imply.
    pub implied_energy: f64,
    /// (m/s) the speed found from it.
    pub found_implied: f64,
    /// (J) the loss in the normal direction that SAE 871993 prints for PIM.
    pub printed_normal_loss: f64,
    /// (m/s) the speed found from it, compared with the true one: a round trip through the printed energy.
    pub round_trip: Cell,
    /// The choices.
    pub choices: Choices,
}

impl Reconstruction {
    /// (m/s) the speed found from the published profiles, less the true one.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.found - self.true_speed
    }
}

/// The answers with other choices of the analyst. Crush energy from the published profiles.
#[derive(Clone, Debug, PartialEq)]
pub struct Choices {
    /// (m/s) speed of vehicle 1 with μ = μ_c and e of SAE 871993.
    pub critical: f64,
    /// (m/s) the same with e = 0.
    pub critical_plastic: f64,
    /// CRASH3's corrected velocity changes with the PDOF turned by −10°, 0 and +10°. The reconstruction does
    /// not use the PDOF.
    pub pdof: [TurnedPdof; 3],
}

/// CRASH3's answer for a direction of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedPdof {
    /// (rad) rotation of the direction of the impulse, counter-clockwise.
    pub turn: f64,
    /// (m/s) corrected velocity changes.
    pub delta_v: [f64; 2],
}

pub(crate) fn reconstruction(staged: &Staged) -> Result<Reconstruction, ValidationError> {
    let total = |[e1, e2]: [f64; 2]| e1 + e2;
    let crush_energy = total(staged.from_profiles);
    let implied_energy = total(staged.implied);
    let printed_normal_loss = staged.printed.energy.normal * FOOT_POUND;
    let turned = |degrees: f64| {
        let turn = degrees * DEGREE;
        Ok::<_, ValidationError>(TurnedPdof {
            turn,
            delta_v: staged.crash3(staged.from_profiles, turn)?.corrected,
        })
    };
    Ok(Reconstruction {
        test: staged.printed.test,
        true_speed: staged.true_speed,
        crush_energy,
        found: staged.found,
        implied_energy,
        found_implied: staged.speed(implied_energy, None)?,
        printed_normal_loss,
        round_trip: Cell::claimed(
            staged.speed(printed_normal_loss, None)?,
            staged.true_speed,
            SPEED * staged.true_speed,
        ),
        choices: Choices {
            critical: staged.speed(crush_energy, Some(staged.critical(None)?))?,
            critical_plastic: staged.speed(crush_energy, Some(staged.critical(Some(0.0))?))?,
            pdof: [turned(-10.0)?, turned(0.0)?, turned(10.0)?],
        },
    })
}

/// Errors of the speed of vehicle 1, over all collisions: in m/s, and as shares of the true speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedErrors {
    /// From the published profiles.
    pub profiles: [ErrorRate; 2],
    /// From the energies that the paper's numbers imply.
    pub implied: [ErrorRate; 2],
    /// From the printed PIM energies.
    pub round_trip: [ErrorRate; 2],
}

pub(crate) fn speed_errors(reconstructions: &[Reconstruction]) -> SpeedErrors {
    let rate = |found: fn(&Reconstruction) -> f64| {
        let errors: Vec<f64> = reconstructions.iter().map(|r| found(r) - r.true_speed).collect();
        let relative: Vec<f64> =
            errors.iter().zip(reconstructions).map(|(error, r)| error / r.true_speed).collect();
        [ErrorRate::of(&errors), ErrorRate::of(&relative)]
    };
    SpeedErrors {
        profiles: rate(|r| r.found),
        implied: rate(|r| r.found_implied),
        round_trip: rate(|r| r.round_trip.ours),
    }
}
