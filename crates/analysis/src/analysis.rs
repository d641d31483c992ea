//! A finished analysis.

use inputs::{Basis, SurfaceData};
use pim_core::{Contact, VehicleId};

use crate::check::Check;
use crate::damage::Crash3;
use crate::exchange::{Exchange, by_momentum};
use crate::found::Found;
use crate::impact::Impact;
use crate::speeds::BothFound;
use crate::travel::{SolvedSkid, Travel};
use crate::vehicle::Vehicle;
use crate::warning::Warning;

/// A finished analysis in the axes of the engine: y to the left, counter-clockwise positive.
/// [`Analysis::seen`] converts it, with its warnings `W`, to those of a reader.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis<W = Warning> {
    /// The energy that the crush energy has to equal.
    pub basis: Basis,
    /// Whether it is of the damage of one vehicle alone.
    pub is_of_damage: bool,
    /// The speed found, in a reconstruction.
    pub found: Option<Found>,
    /// Both speeds, in a reconstruction that finds both.
    pub both: Option<BothFound>,
    /// The impact by the impact law; `None` in an analysis of only the damage or only the motion, and if
    /// momentum gives the speeds of a case without a law. If momentum gives the speeds, it is only a check
    /// ([`law_check`](Self::law_check)), and the result is [`exchange`](Self::exchange).
    pub impact: Option<Impact>,
    /// How the vehicles touch, in an analysis of only the geometry.
    pub geometry: Option<Contact>,
    /// The path of each vehicle from the impact to rest, if the case has the ground and the drag for it.
    pub travel: [Option<Travel>; 2],
    /// The skid marks of each vehicle before the impact.
    pub skids: [Option<SolvedSkid>; 2],
    /// The ground of these paths.
    pub surface: Option<SurfaceData>,
    /// Both vehicles.
    pub vehicles: [Vehicle; 2],
    /// CRASH3's answer, if the damage of all vehicles is known.
    pub crash3: Option<Crash3>,
    /// The keys of evidence in the case that this answer does not use. An over-determined problem has no
    /// exact solution that takes account of everything.
    pub left_aside: Vec<String>,
    /// Whether the case has enough data to weigh that evidence, or crush energies with a known average error;
    /// only tested if there is any.
    pub can_be_weighed: bool,
    /// The consistency checks, passed or not.
    pub checks: Vec<Check>,
    /// Warnings for a careful reader.
    pub warnings: Vec<W>,
}

impl<W> Analysis<W> {
    /// Whether it is a reconstruction: it found a speed, or both.
    #[must_use]
    pub fn is_reconstruction(&self) -> bool {
        self.found.is_some() || self.both.is_some()
    }

    /// Whether a vehicle can move and is not a fixed object.
    #[must_use]
    pub fn moves(&self, vehicle: VehicleId) -> bool {
        self.vehicles[vehicle.index()].moves()
    }

    /// (m/s) speed of a vehicle before the impact: negative if it moves backward, zero for a fixed object.
    #[must_use]
    pub fn speed(&self, vehicle: VehicleId) -> f64 {
        match (&self.both, &self.impact) {
            (Some(both), _) => both.speeds[vehicle.index()],
            (None, impact) => impact.as_ref().map_or(0.0, |impact| impact.speed(vehicle)),
        }
    }

    /// (m/s) ΔV of both vehicles, for the speeds of a reconstruction or of the impact; zero if there is no
    /// impact.
    #[must_use]
    pub fn delta_v(&self) -> [f64; 2] {
        self.exchange().map(|exchange| exchange.delta_v.map(|change| change.norm())).unwrap_or_default()
    }

    /// The effect of the impact; `None` in an analysis of only the damage or only the motion.
    #[must_use]
    pub fn exchange(&self) -> Option<Exchange> {
        Exchange::of(self.both.as_ref(), self.impact.as_ref())
    }

    /// The impact by the law of the case at the speeds from momentum: a check of the law, not a result.
    #[must_use]
    pub fn law_check(&self) -> Option<&Impact> {
        by_momentum(self.both.as_ref()).and(self.impact.as_ref())
    }
}

impl Analysis {
    /// An analysis of vehicles without any result yet.
    pub(crate) fn unsolved(vehicles: [Vehicle; 2]) -> Self {
        Self {
            basis: Basis::default(),
            is_of_damage: false,
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
