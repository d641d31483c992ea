//! Reading of the types with an invariant: their fields are the arguments of their constructors, which it
//! calls.

use pim_core::InvalidInput;
use real::Real;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::crossing::{Crossing, Party};
use crate::response::{Response, Swell};

/// Reads a type from these fields by the expression after the arrow, so that the types themselves do not
/// depend on this file.
macro_rules! read_as {
    ($type:ident { $($field:ident: $kind:ty),* } => $read:expr) => {
        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for $type<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                struct $type<T> {
                    $($field: $kind,)*
                }
                let $type { $($field),* } = $type::<T>::deserialize(deserializer)?;
                let read: Result<Self, InvalidInput> = $read;
                read.map_err(D::Error::custom)
            }
        }
    };
}

read_as!(Response { reaction: T, swell: T, deceleration: T, form: Swell } => {
    Self::new(reaction, swell, deceleration, form)
});
read_as!(Crossing { angle: T, parties: [Party<T>; 2] } => Self::new(angle, parties));
