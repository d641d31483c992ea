//! The serialised form of the types with an invariant: the arguments of their constructors. Reading calls the
//! constructors.

use alloc::vec::Vec;

use real::Real;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::barrier_test::BarrierTest;
use crate::direction::{DamagedFace, Side};
use crate::error::CrushError;
use crate::profile::Profile;
use crate::stiffness::Stiffness;

/// Serialises a type as another one, so that the types themselves do not depend on this file.
macro_rules! written_as {
    ($type:ident, $data:ident) => {
        impl<T: Real + Serialize> Serialize for $type<T> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $data::from(Self::clone(self)).serialize(serializer)
            }
        }

        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for $type<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Self::try_from($data::deserialize(deserializer)?).map_err(D::Error::custom)
            }
        }
    };
}

written_as!(Profile, ProfileData);
written_as!(Stiffness, StiffnessData);
written_as!(BarrierTest, BarrierTestData);
written_as!(DamagedFace, DamagedFaceData);

#[derive(Serialize, Deserialize)]
#[serde(rename = "Profile")]
struct ProfileData<T> {
    depths: Vec<T>,
    spacings: Vec<T>,
}

impl<T: Real> From<Profile<T>> for ProfileData<T> {
    fn from(Profile { depths, spacings }: Profile<T>) -> Self {
        Self { depths, spacings }
    }
}

impl<T: Real> TryFrom<ProfileData<T>> for Profile<T> {
    type Error = CrushError;

    fn try_from(data: ProfileData<T>) -> Result<Self, CrushError> {
        Self::new(data.depths, data.spacings)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Stiffness")]
struct StiffnessData<T> {
    a: T,
    b: T,
    g: T,
    saturation_force: Option<T>,
}

impl<T: Real> From<Stiffness<T>> for StiffnessData<T> {
    fn from(stiffness: Stiffness<T>) -> Self {
        Self {
            a: stiffness.a(),
            b: stiffness.b(),
            g: stiffness.g(),
            saturation_force: stiffness.saturation_force(),
        }
    }
}

impl<T: Real> TryFrom<StiffnessData<T>> for Stiffness<T> {
    type Error = CrushError;

    fn try_from(data: StiffnessData<T>) -> Result<Self, CrushError> {
        let rising = Self::from_abg(data.a, data.b, data.g)?;
        data.saturation_force.map_or(Ok(rising), |force| rising.with_saturation_force(force))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(
    rename = "BarrierTest",
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
struct BarrierTestData<T> {
    mass: T,
    speed: T,
    profile: Profile<T>,
    no_damage_speed: T,
}

impl<T: Real> From<BarrierTest<T>> for BarrierTestData<T> {
    fn from(BarrierTest { mass, speed, profile, no_damage_speed }: BarrierTest<T>) -> Self {
        Self { mass, speed, profile, no_damage_speed }
    }
}

impl<T: Real> TryFrom<BarrierTestData<T>> for BarrierTest<T> {
    type Error = CrushError;

    fn try_from(data: BarrierTestData<T>) -> Result<Self, CrushError> {
        Self::new(data.mass, data.speed, data.profile, data.no_damage_speed)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "DamagedFace")]
struct DamagedFaceData<T> {
    side: Side,
    distance: T,
    offset: T,
}

impl<T: Real> From<DamagedFace<T>> for DamagedFaceData<T> {
    fn from(DamagedFace { side, distance, offset }: DamagedFace<T>) -> Self {
        Self { side, distance, offset }
    }
}

impl<T: Real> TryFrom<DamagedFaceData<T>> for DamagedFace<T> {
    type Error = CrushError;

    fn try_from(data: DamagedFaceData<T>) -> Result<Self, CrushError> {
        Self::new(data.side, data.distance, data.offset)
    }
}
