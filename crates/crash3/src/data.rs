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

/// Reads a type as another one, so that the types themselves do not depend on this file.
macro_rules! read_as {
    ($type:ident, $data:ident) => {
        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for $type<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Self::try_from($data::deserialize(deserializer)?).map_err(D::Error::custom)
            }
        }
    };
}

read_as!(Profile, ProfileData);
read_as!(Stiffness, StiffnessData);
read_as!(BarrierTest, BarrierTestData);
read_as!(DamagedFace, DamagedFaceData);

#[derive(Deserialize)]
#[serde(rename = "Profile")]
struct ProfileData<T> {
    depths: Vec<T>,
    spacings: Vec<T>,
}

impl<T: Real> TryFrom<ProfileData<T>> for Profile<T> {
    type Error = CrushError;

    fn try_from(data: ProfileData<T>) -> Result<Self, CrushError> {
        Self::new(data.depths, data.spacings)
    }
}

#[derive(Deserialize)]
#[serde(rename = "Stiffness")]
struct StiffnessData<T> {
    a: T,
    b: T,
    g: T,
    saturation_force: Option<T>,
}

impl<T: Real> TryFrom<StiffnessData<T>> for Stiffness<T> {
    type Error = CrushError;

    fn try_from(data: StiffnessData<T>) -> Result<Self, CrushError> {
        let rising = Self::from_abg(data.a, data.b, data.g)?;
        data.saturation_force.map_or(Ok(rising), |force| rising.with_saturation_force(force))
    }
}

#[derive(Deserialize)]
#[serde(rename = "BarrierTest", bound(deserialize = "T: Real + Deserialize<'de>"))]
struct BarrierTestData<T> {
    mass: T,
    speed: T,
    profile: Profile<T>,
    no_damage_speed: T,
}

impl<T: Real> TryFrom<BarrierTestData<T>> for BarrierTest<T> {
    type Error = CrushError;

    fn try_from(data: BarrierTestData<T>) -> Result<Self, CrushError> {
        Self::new(data.mass, data.speed, data.profile, data.no_damage_speed)
    }
}

#[derive(Deserialize)]
#[serde(rename = "DamagedFace")]
struct DamagedFaceData<T> {
    side: Side,
    distance: T,
    offset: T,
}

impl<T: Real> TryFrom<DamagedFaceData<T>> for DamagedFace<T> {
    type Error = CrushError;

    fn try_from(data: DamagedFaceData<T>) -> Result<Self, CrushError> {
        Self::new(data.side, data.distance, data.offset)
    }
}
