//! A finished analysis.

use inputs::{Basis, SurfaceData};
use pim_core::{Contact, VehicleId};

use crate::check::Check;
use crate::damage::Crash3;
use crate::found::Found;
use crate::impact::Impact;
use crate::speeds::BothFound;
use crate::travel::{Skid, Travel};
use crate::vehicle::Vehicle;
use crate::warning::Warning;

/// A finished analysis in the axes of the engine: y to the left, counter-clockwise positive.
/// [`Analysis::seen`] converts it to those of a reader.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// What the crush energy is held equal to.
    pub basis: Basis,
    /// The speed found, in a reconstruction.
    pub found: Option<Found>,
    /// Both speeds, in a reconstruction that seeks them.
    pub both: Option<BothFound>,
    /// The impact by the impact law; `None` in an analysis of the damage alone, or of the motion alone, and
    /// where momentum gives the speeds of a case that has no law. Where momentum gives them, it is a check
    /// ([`law_check`](Self::law_check)): what the impact did is [`exchange`](Self::exchange).
    pub impact: Option<Impact>,
    /// How the vehicles touch, in an analysis of the geometry alone.
    pub geometry: Option<Contact>,
    /// The way of each vehicle from the impact to rest, where the case has the ground and the drag for it.
    pub travel: [Option<Travel>; 2],
    /// The skid marks of each vehicle before the impact.
    pub skids: [Option<Skid>; 2],
    /// The ground on which they are followed.
    pub surface: Option<SurfaceData>,
    /// Both vehicles.
    pub vehicles: [Vehicle; 2],
    /// CRASH3's answer, where the damage of all vehicles is known.
    pub crash3: Option<Crash3>,
    /// The keys of the evidence that the case has and this answer does not use. What is over-determined has
    /// no exact solution that takes account of all.
    pub left_aside: Vec<String>,
    /// Whether the case has what it takes to weigh that evidence; looked at only where there is any.
    pub can_be_weighed: bool,
    /// The consistency checks, passed or not.
    pub checks: Vec<Check>,
    /// What a careful reader should know.
    pub warnings: Vec<Warning>,
}

impl Analysis {
    /// Whether a vehicle can move and is not a fixed object.
    #[must_use]
    pub fn moves(&self, vehicle: VehicleId) -> bool {
        self.vehicles[vehicle.index()].moves()
    }

    /// (m/s) speed of a vehicle before the impact: negative where it moves backwards, zero for a fixed
    /// object.
    #[must_use]
    pub fn speed(&self, vehicle: VehicleId) -> f64 {
        match (&self.both, &self.impact) {
            (Some(both), _) => both.speeds[vehicle.index()],
            (None, impact) => impact.as_ref().map_or(0.0, |impact| impact.speed(vehicle)),
        }
    }

    /// (m/s) ΔV of both vehicles: those that go with the speeds of a reconstruction, or of the impact; zero
    /// where there is no impact.
    #[must_use]
    pub fn delta_v(&self) -> [f64; 2] {
        self.exchange().map(|exchange| exchange.delta_v.map(|change| change.norm())).unwrap_or_default()
    }
}

impl Analysis {
    /// Of vehicles of which nothing was found.
    pub(crate) fn unsolved(vehicles: [Vehicle; 2]) -> Self {
        Self {
            basis: Basis::default(),
            found: None,
            both: None,
            impact: None,
            geometry: None,
            travel: [None, None],
            skids: [None; 2],
            surface: None,
            vehicles,
            crash3: None,
            left_aside: Vec::new(),
            can_be_weighed: false,
            checks: Vec::new(),
            warnings: Vec::new(),
        }
    }
}
