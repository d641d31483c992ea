//! Reading of the types with an invariant: their fields are the arguments of their constructors, which it
//! calls.

use alloc::vec::Vec;

use real::Real;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::barrier_test::BarrierTest;
use crate::direction::{DamagedFace, Side};
use crate::error::CrushError;
use crate::profile::Profile;
use crate::stiffness::Stiffness;

/// Reads a type from these fields by the expression after the arrow, so that the types themselves do not
/// depend on this file.
macro_rules! read_as {
    ($type:ident { $($field:ident: $kind:ty),* } => $read:expr) => {
        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for $type<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(bound(deserialize = "T: Real + Deserialize<'de>"))]
                struct $type<T> {
                    $($field: $kind,)*
                }
                let $type { $($field),* } = $type::<T>::deserialize(deserializer)?;
                let read = || -> Result<Self, CrushError> { $read };
                read().map_err(D::Error::custom)
            }
        }
    };
}

read_as!(Profile { depths: Vec<T>, spacings: Vec<T> } => Self::new(depths, spacings));
read_as!(Stiffness { a: T, b: T, g: T, saturation_force: Option<T> } => {
    let rising = Self::from_abg(a, b, g)?;
    saturation_force.map_or(Ok(rising), |force| rising.with_saturation_force(force))
});
read_as!(BarrierTest { mass: T, speed: T, profile: Profile<T>, no_damage_speed: T } => {
    Self::new(mass, speed, profile, no_damage_speed)
});
read_as!(DamagedFace { side: Side, distance: T, offset: T } => Self::new(side, distance, offset));
