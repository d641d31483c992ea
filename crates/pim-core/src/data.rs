//! The serialised form of the types with an invariant: the arguments of their constructors. Reading calls the
//! constructors.

use alloc::vec::Vec;

use nalgebra::Vector2;
use real::Real;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::body::{Body, Participant};
use crate::check;
use crate::contact::Contact;
use crate::error::InvalidInput;
use crate::law::{Law, Tangential};
use crate::restitution::{RestitutionCurve, VaryingLaw};

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

written_as!(Body, BodyData);
written_as!(Participant, ParticipantData);
written_as!(Contact, ContactData);
written_as!(Law, LawData);
written_as!(RestitutionCurve, RestitutionCurveData);
written_as!(VaryingLaw, VaryingLawData);

/// Bounds of the forward axis' length: a unit vector, within the rounding of a text with few digits.
const UNIT_LENGTH: [f64; 2] = [1.0 - 1e-6, 1.0 + 1e-6];

#[derive(Serialize, Deserialize)]
#[serde(rename = "Body")]
enum BodyData<T> {
    Fixed,
    Movable { mass: T, yaw_inertia: T },
}

impl<T: Real> From<Body<T>> for BodyData<T> {
    fn from(body: Body<T>) -> Self {
        if body.is_fixed() {
            Self::Fixed
        } else {
            Self::Movable { mass: body.mass(), yaw_inertia: body.yaw_inertia() }
        }
    }
}

impl<T: Real> TryFrom<BodyData<T>> for Body<T> {
    type Error = InvalidInput;

    fn try_from(data: BodyData<T>) -> Result<Self, InvalidInput> {
        match data {
            BodyData::Fixed => Ok(Self::fixed()),
            BodyData::Movable { mass, yaw_inertia } => Self::new(mass, yaw_inertia),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(
    rename = "Participant",
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
struct ParticipantData<T> {
    body: Body<T>,
    forward: Vector2<T>,
    /// The forward axis if absent.
    #[serde(default)]
    course: Option<Vector2<T>>,
    arm: Vector2<T>,
}

impl<T: Real> From<Participant<T>> for ParticipantData<T> {
    fn from(Participant { body, forward, course, arm }: Participant<T>) -> Self {
        Self { body, forward, course: Some(course), arm }
    }
}

impl<T: Real> TryFrom<ParticipantData<T>> for Participant<T> {
    type Error = InvalidInput;

    fn try_from(data: ParticipantData<T>) -> Result<Self, InvalidInput> {
        let ParticipantData { body, forward, course, arm } = data;
        let course = course.unwrap_or(forward);
        let length = |vector: Vector2<T>| (vector.x * vector.x + vector.y * vector.y).sqrt().value();
        let [low, high] = UNIT_LENGTH;
        check::within("length of the forward axis", length(forward), low, high)?;
        check::within("length of the course", length(course), low, high)?;
        check::finite("distance to the contact point along x", arm.x.value())?;
        check::finite("distance to the contact point along y", arm.y.value())?;
        Ok(Self { body, forward, course, arm })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(
    rename = "Contact",
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
struct ContactData<T> {
    participants: [Participant<T>; 2],
    crush_plane: T,
}

impl<T: Real> From<Contact<T>> for ContactData<T> {
    fn from(contact: Contact<T>) -> Self {
        Self { participants: contact.participants, crush_plane: contact.crush_plane }
    }
}

impl<T: Real> TryFrom<ContactData<T>> for Contact<T> {
    type Error = InvalidInput;

    fn try_from(data: ContactData<T>) -> Result<Self, InvalidInput> {
        Self::new(data.participants, data.crush_plane)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Law")]
struct LawData<T> {
    restitution: T,
    tangential: Tangential<T>,
    moment_restitution: T,
}

impl<T: Real> From<Law<T>> for LawData<T> {
    fn from(Law { restitution, tangential, moment_restitution }: Law<T>) -> Self {
        Self { restitution, tangential, moment_restitution }
    }
}

impl<T: Real> TryFrom<LawData<T>> for Law<T> {
    type Error = InvalidInput;

    fn try_from(data: LawData<T>) -> Result<Self, InvalidInput> {
        Self::new(data.restitution, data.tangential)?.with_moment_restitution(data.moment_restitution)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "RestitutionCurve")]
struct RestitutionCurveData<T> {
    points: Vec<(T, T)>,
}

impl<T: Real> From<RestitutionCurve<T>> for RestitutionCurveData<T> {
    fn from(curve: RestitutionCurve<T>) -> Self {
        Self { points: curve.points }
    }
}

impl<T: Real> TryFrom<RestitutionCurveData<T>> for RestitutionCurve<T> {
    type Error = InvalidInput;

    fn try_from(data: RestitutionCurveData<T>) -> Result<Self, InvalidInput> {
        Self::new(data.points)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(
    rename = "VaryingLaw",
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
struct VaryingLawData<T> {
    law: Law<T>,
    curve: Option<RestitutionCurve<T>>,
}

impl<T: Real> From<VaryingLaw<T>> for VaryingLawData<T> {
    fn from(VaryingLaw { nominal, curve }: VaryingLaw<T>) -> Self {
        Self { law: nominal, curve }
    }
}

impl<T: Real> From<VaryingLawData<T>> for VaryingLaw<T> {
    fn from(VaryingLawData { law, curve }: VaryingLawData<T>) -> Self {
        match curve {
            Some(curve) => law.with_restitution_curve(curve),
            None => law.into(),
        }
    }
}
