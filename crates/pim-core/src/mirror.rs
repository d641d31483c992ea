//! The same collision mirrored along x: in axes of the other handedness, with y to the right and clockwise
//! positive.
//!
//! The equations hold in both. y and t components, angles, yaw rates, moments and the impulse ratio change
//! sign; x and n components, energies and all other coefficients do not. Only a PDOF is clockwise in any
//! axes, so that [`Outcome::pdof`] of a mirrored outcome is minus that of the outcome itself.

use nalgebra::Vector2;
use real::Real;

use crate::body::{Motion, Participant};
use crate::contact::{Contact, InverseMass, NormalTangential};
use crate::error::{ImpactError, InvalidInput};
use crate::impact::Outcome;
use crate::law::Law;
use crate::restitution::VaryingLaw;

/// Subtracts from zero, because −0.0 would print as "-0".
fn flipped<T: Real>(value: T) -> T {
    T::ZERO - value
}

fn across<T: Real>(v: Vector2<T>) -> Vector2<T> {
    Vector2::new(v.x, flipped(v.y))
}

impl<T: Real> NormalTangential<T> {
    /// The same vector in axes of the other handedness.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { normal: self.normal, tangential: flipped(self.tangential) }
    }
}

impl<T: Real> Motion<T> {
    /// The same motion in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { velocity: across(self.velocity), yaw_rate: flipped(self.yaw_rate) }
    }
}

impl<T: Real> Participant<T> {
    fn mirrored(&self) -> Self {
        Self {
            body: self.body,
            forward: across(self.forward),
            course: across(self.course),
            arm: across(self.arm),
        }
    }
}

impl<T: Real> Contact<T> {
    /// The same contact in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let InverseMass { nn, nt, tt, nm, tm, mm } = self.inverse_mass;
        Self {
            participants: self.participants.each_ref().map(Participant::mirrored),
            crush_plane: flipped(self.crush_plane),
            turned: self.turned,
            normal: across(self.normal),
            arms: self.arms.map(|arm| arm.mirrored()),
            // A product of n and t changes sign, as does one of n and the moment; one of t and the moment
            // does not.
            inverse_mass: InverseMass { nn, nt: flipped(nt), tt, nm: flipped(nm), tm, mm },
        }
    }
}

impl<T: Real> Law<T> {
    /// The same law in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        use crate::law::Tangential::{Ratio, VelocityChange};
        let tangential = match self.tangential {
            Ratio(mu) => Ratio(flipped(mu)),
            VelocityChange(change) => VelocityChange(flipped(change)),
            unsigned => unsigned,
        };
        Self { tangential, ..*self }
    }
}

impl<T: Real> VaryingLaw<T> {
    /// The same law in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { nominal: self.nominal.mirrored(), curve: self.curve.clone() }
    }
}

impl<T: Real> Outcome<T> {
    /// The same outcome in axes of the other handedness.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            impulse: self.impulse.mirrored(),
            impulse_vector: across(self.impulse_vector),
            moment_impulse: flipped(self.moment_impulse),
            regime: self.regime,
            impulse_ratio: flipped(self.impulse_ratio),
            critical_impulse_ratio: self.critical_impulse_ratio.map(flipped),
            approach: self.approach.mirrored(),
            separation: self.separation.mirrored(),
            before: self.before.each_ref().map(Motion::mirrored),
            after: self.after.each_ref().map(Motion::mirrored),
            delta_v: self.delta_v.map(across),
            forward: self.forward.map(across),
            energy: self.energy,
        }
    }
}

impl InvalidInput {
    /// The same refusal in axes of the other handedness.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::NormalUndefined { crush_plane } => {
                Self::NormalUndefined { crush_plane: flipped(crush_plane) }
            }
            unsigned => unsigned,
        }
    }
}

impl ImpactError {
    /// The same refusal in axes of the other handedness.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Jam { impulse_ratio, k_nn, k_nt } => {
                Self::Jam { impulse_ratio: flipped(impulse_ratio), k_nn, k_nt: flipped(k_nt) }
            }
            Self::Invalid(invalid) => Self::Invalid(invalid.mirrored()),
            unsigned => unsigned,
        }
    }
}
