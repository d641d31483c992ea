//! Benchmarks of deltav, on the paper's example (SAE 980025, appendix; theory, section 7).
//!
//! | bench target | measures | run with |
//! |---|---|---|
//! | `times` | time, by criterion: for people | `cargo bench -p deltav-benches` |
//! | `instructions` | instructions executed, by gungraun under valgrind: for comparisons | `benches/compare-commits` |
//!
//! Both measure the same operations: an impact under each tangential condition, with and without the geometry
//! of the contact, a crush energy, a reconciliation in closed form and by the root-finder, reading a case
//! file, a motion to rest and back, many motions to rest at once. The scene as SVG, the sampling of 31
//! uncertain inputs, and the preparation before the first sample, are only timed.
//!
//! # Time
//!
//! ```text
//! cargo bench -p deltav-benches                                   # everything
//! cargo bench -p deltav-benches -- impact                         # what has "impact" in its name
//! cargo bench -p deltav-benches -- --save-baseline before         # … then, after a change:
//! cargo bench -p deltav-benches -- --baseline before
//! ```
//!
//! Time on a shared machine varies by 30 %. It shows the cost of an operation, not whether a small change
//! made it slower.
//!
//! # Instructions
//!
//! ```text
//! benches/compare-commits BASE [HEAD] [--limit 2%]
//! ```
//!
//! compares two commits in one run, and exits with 1 if one of the counts grew by more than the limit. No
//! counts are stored: they depend on toolchain and CPU, so only those from the same run can be compared. It
//! needs valgrind, which is why the target requires the feature `instructions`; it installs everything else
//! that it needs below `target/`.

use crash3::{CrushError, Profile, Stiffness, crush_energy};
use pim_core::{Body, Contact, InvalidInput, Law, Motion, Participant, Tangential, VehicleId};
use reconcile::{EnergyBasis, Problem, ReconcileError};
use trajectory::{Axles, Chassis, Control, Ground, Outset, State, Steer, Vector2};

/// (m) one inch.
const INCH: f64 = 0.0254;
/// (m) one foot.
const FOOT: f64 = 0.3048;
/// (kg) the mass that weighs one pound.
const POUND: f64 = 0.453_592_37;
/// (N) one pound of force: a pound under the standard gravity of 9.80665 m/s².
const POUND_FORCE: f64 = POUND * 9.806_65;
/// (m/s) one mile per hour.
const MILE_PER_HOUR: f64 = 0.447_04;

/// (m/s) the speed of vehicle 1 in the impacts measured: 75 ft/s.
const JIMMY_SPEED: f64 = 75.0 * FOOT;

/// Name and text of the paper's example as a case file.
pub const CASE_FILE: (&str, &str) = ("sae-980025.toml", include_str!("../../fixtures/sae-980025.toml"));

/// A vehicle on its ground and its motion after an impact: RICSAC 6.2 (Vossou & Koulocheris 2018) with twice
/// the velocity and on wet asphalt, so that it spins and rolls for about six seconds.
///
/// # Errors
/// None, as its numbers are valid.
pub fn spin_out() -> Result<(Chassis, Ground<'static>, State), Refused> {
    let axles = Axles { cg_to_front: 1.176, cg_to_rear: 1.273, track: 1.387 };
    let chassis = Chassis::new(Body::new(1190.0, 2263.0)?, axles, [0.062; 4])?;
    let start = State {
        position: Vector2::new(0.0, 0.0),
        heading: 60_f64.to_radians(),
        motion: Motion { velocity: Vector2::new(-2.56, 10.98), yaw_rate: -180_f64.to_radians() },
    };
    Ok((chassis, Ground::level(0.6), start))
}

/// Variations of [`spin_out`], with other speeds, drags and friction: between five and seven seconds to rest.
///
/// # Errors
/// None, as its numbers are valid.
pub fn spin_outs(count: u32) -> Result<Vec<Outset<'static>>, Refused> {
    let (_, _, start) = spin_out()?;
    let axles = Axles { cg_to_front: 1.176, cg_to_rear: 1.273, track: 1.387 };
    let sample = |number: u32| {
        // Numbers from −½ to ½ that fill their cube evenly (Kronecker sequence).
        let share = |step: f64| (f64::from(number) * step) % 1.0 - 0.5;
        let (a, b, c) =
            (share(0.819_172_513_396_164_5), share(0.671_043_606_703_789_3), share(0.549_700_477_901_960_4));
        let chassis = Chassis::new(Body::new(1190.0, 2263.0)?, axles, [0.062 + 0.01 * a; 4])?;
        let Motion { velocity, yaw_rate } = start.motion;
        let motion = Motion { velocity: velocity * (1.0 + 0.1 * b), yaw_rate: yaw_rate * (1.0 + 0.3 * a) };
        let (steer, ground) = (Steer::straight(), Ground::level(0.6 + 0.1 * c));
        Ok(Outset { chassis, steer, ground, start: State { motion, ..start } })
    };
    (0..count).map(sample).collect()
}

/// An integration to 1 cm and 0.1° at rest, achieved for 97 of 100 of the [`spin_outs`].
#[must_use]
pub fn centimetre() -> Control {
    Control { tolerance: 5e-4, ..Control::default() }
}

/// A constructor refuses the example.
#[derive(Debug, thiserror::Error)]
#[error("the paper's example is refused: {0}")]
pub enum Refused {
    /// By `pim-core`.
    Impact(#[from] InvalidInput),
    /// By `crash3`.
    Crush(#[from] CrushError),
    /// By `reconcile`.
    Reconcile(#[from] ReconcileError),
}

/// The paper's example in SI units: a 1994 GMC Jimmy (vehicle 1) meets a 1995 Nissan Altima (vehicle 2).
#[derive(Clone, Debug)]
pub struct Example {
    /// Both vehicles with headings and arms.
    pub participants: [Participant; 2],
    /// (rad) Γ.
    pub crush_plane: f64,
    /// Their contact.
    pub contact: Contact,
    /// Motions before impact, vehicle 1 at the 75 ft/s that the paper finds.
    pub motions: [Motion; 2],
    /// Crush of both vehicles, six stations each.
    pub damage: [(Profile, Stiffness); 2],
}

impl Example {
    /// The example.
    ///
    /// # Errors
    /// If a constructor refuses its values, which would be a change of that constructor.
    pub fn new() -> Result<Self, Refused> {
        // ERRATUM (theory, section 8): the appendix prints θ₁ = 0 with vₓ = −75 ft/s. The heading is 180°.
        let headings = [180.0_f64.to_radians(), 67.0_f64.to_radians()];
        let jimmy = Body::new(3696.0 * POUND, 2437.0 * POUND_FORCE * FOOT)?;
        let altima = Body::new(3413.0 * POUND, 2165.0 * POUND_FORCE * FOOT)?;
        let participants = [
            Participant::polar(jimmy, headings[0], 6.3 * FOOT, -22.4_f64.to_radians())?,
            Participant::polar(altima, headings[1], 3.8 * FOOT, -39.0_f64.to_radians())?,
        ];
        let crush_plane = -23.0_f64.to_radians();
        Ok(Self {
            participants,
            crush_plane,
            contact: Contact::new(participants, crush_plane)?,
            motions: [
                Motion::along(headings[0], JIMMY_SPEED),
                Motion::along(headings[1], 10.0 * MILE_PER_HOUR),
            ],
            damage: [
                damage([21.3, 20.3, 13.8, 11.3, 5.3, 4.8], 65.0, 35.0, 115.0)?,
                damage([3.0, 15.8, 13.5, 6.7, 3.3, 5.0], 84.0, 30.0, 77.5)?,
            ],
        })
    }

    /// The example's restitution, e = 0.3, with the given tangential condition.
    ///
    /// # Errors
    /// If [`Law::new`] refuses the condition.
    pub fn law(tangential: Tangential) -> Result<Law, Refused> {
        Ok(Law::new(0.3, tangential)?)
    }

    /// The problem of the speed of vehicle 1 under the given tangential condition.
    ///
    /// # Errors
    /// If [`Law::new`] refuses the condition.
    pub fn problem(&self, tangential: Tangential) -> Result<Problem, Refused> {
        Ok(Problem {
            contact: self.contact,
            law: Self::law(tangential)?.into(),
            motions: self.motions,
            unknown: VehicleId::One,
            crush_energy: self
                .damage
                .iter()
                .map(|(profile, stiffness)| crush_energy(profile, stiffness))
                .sum(),
            basis: EnergyBasis::Dissipated,
            tangential_share: 0.0,
        })
    }
}

/// Depths and width in inches, d_0 in √lbf, d_1 in √lbf/ft.
fn damage(depths: [f64; 6], width: f64, d0: f64, d1: f64) -> Result<(Profile, Stiffness), CrushError> {
    let depths = depths.map(|depth| depth * INCH).to_vec();
    let root_force = POUND_FORCE.sqrt();
    Ok((
        Profile::equally_spaced(depths, width * INCH)?,
        Stiffness::from_d0_d1(d0 * root_force, d1 * root_force / FOOT)?,
    ))
}

/// The impulse ratio printed in the paper.
pub const RATIO: Tangential = Tangential::Ratio(0.371);
/// Nine tenths of the critical ratio, which is 0.36885 in the example.
pub const FRACTION: Tangential = Tangential::FractionOfCritical(0.9);
/// More than the critical ratio, so that the surfaces stick at the speed found.
pub const FRICTION: Tangential = Tangential::Friction(0.5);

/// The sliding of the example, reduced by less than a common velocity would need.
pub const VELOCITY_CHANGE: Tangential = Tangential::VelocityChange(-2.0);
/// A small part of the sliding reversed.
pub const RESTITUTION: Tangential = Tangential::Restitution(0.1);
/// Friction that is enough for the normal coefficient along the surface.
pub const FULL_OR_SLIDING: Tangential = Tangential::FullOrSliding(0.8);

/// Every tangential condition of the law, and a name for its benchmark.
pub const TANGENTIAL_CONDITIONS: [(&str, Tangential); 7] = [
    ("critical", Tangential::Critical),
    ("ratio", RATIO),
    ("fraction", FRACTION),
    ("friction", FRICTION),
    ("velocity change", VELOCITY_CHANGE),
    ("restitution", RESTITUTION),
    ("full or sliding", FULL_OR_SLIDING),
];
