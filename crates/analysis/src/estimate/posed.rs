//! The collision of a particle, and its speeds in it.

use evidence::Speeds;
use inputs::Basis;
use pim_core::{Contact, Motion, VaryingLaw, Vector2, VehicleId};

/// How the values of a particle encode the unknown speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OpenSpeeds {
    /// Both are in the case.
    None,
    /// That of one vehicle.
    One(VehicleId, Alone),
    /// Both, each with its own value.
    Each([Alone; 2]),
    /// Both together.
    Together(Speeds<usize>),
}

/// How a particle encodes an unknown speed with its own value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alone {
    /// The index of its value.
    pub(super) place: usize,
    /// (m/s) values from 0 to this mean that the vehicle stood still.
    pub(super) standing: f64,
}

impl Alone {
    /// (m/s) the speed for this value (m/s).
    #[inline(always)]
    pub(super) fn speed(self, value: f64) -> f64 {
        // v = x below 0, 0 from 0 to w, x − w above
        value.min(0.0) + (value - self.standing).max(0.0)
    }
}

impl OpenSpeeds {
    /// Whether the speed of a vehicle is unknown.
    pub(super) fn is_open(self, id: VehicleId) -> bool {
        match self {
            Self::None => false,
            Self::One(open, _) => open == id,
            Self::Each(_) | Self::Together(_) => true,
        }
    }

    /// The number of unknown speeds that are uniform before the severity, each in its own value.
    pub(super) fn uniform(self) -> u32 {
        match self {
            Self::None | Self::Together(_) => 0,
            Self::One(..) => 1,
            Self::Each(_) => 2,
        }
    }

    /// (m/s) the unknown speeds of a particle with these values and headings along `forward`.
    #[inline(always)]
    pub(super) fn along(
        self,
        of: impl Fn(usize) -> f64,
        forward: impl FnOnce() -> [Vector2<f64>; 2],
    ) -> [Option<f64>; 2] {
        let alone = |alone: Alone| Some(alone.speed(of(alone.place)));
        match self {
            Self::None => [None, None],
            Self::One(VehicleId::One, open) => [alone(open), None],
            Self::One(VehicleId::Two, open) => [None, alone(open)],
            Self::Each(open) => open.map(alone),
            Self::Together(speeds) => speeds.map(of).along(forward()).map(Some),
        }
    }
}

/// The collision of a particle, with the law of the case.
pub(super) struct Posed {
    pub(super) contact: Contact,
    pub(super) law: VaryingLaw,
    pub(super) motions: [Motion; 2],
    /// (J)
    pub(super) crush_energies: [f64; 2],
    pub(super) basis: Basis,
}
