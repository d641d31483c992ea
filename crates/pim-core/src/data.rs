//! The serialised form of the types with an invariant: the arguments of their constructors. Reading calls the
//! constructors.

use alloc::vec::Vec;

use nalgebra::Vector2;
use real::{Real, read_as};
use serde::de::Error as _;
use serde::ser::SerializeStruct as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::body::{Body, Participant};
use crate::check;
use crate::contact::Contact;
use crate::error::InvalidInput;
use crate::law::{Law, Tangential};
use crate::restitution::{RestitutionCurve, VaryingLaw};

/// Writes a type as these fields, and reads it from them by the expression after the arrow, so that the types
/// themselves do not depend on this file.
macro_rules! written_as {
    ($value:ident: $type:ident { $($field:ident: $kind:ty = $of:expr),* $(,)? } => $read:expr) => {
        impl<T: Real + Serialize> Serialize for $type<T> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $value = self;
                let fields = [$(stringify!($field)),*].len();
                let mut written = serializer.serialize_struct(stringify!($type), fields)?;
                $(written.serialize_field(stringify!($field), &$of)?;)*
                written.end()
            }
        }

        read_as!(InvalidInput; $type { $($field: $kind),* } => $read);
    };
}

/// Bounds of the forward axis' length: a unit vector, within the rounding of a text with few digits.
const UNIT_LENGTH: [f64; 2] = [1.0 - 1e-6, 1.0 + 1e-6];

#[derive(Serialize, Deserialize)]
#[serde(rename = "Body")]
enum BodyData<T> {
    Fixed,
    Movable { mass: T, yaw_inertia: T },
}

impl<T: Real + Serialize> Serialize for Body<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let data = if self.is_fixed() {
            BodyData::Fixed
        } else {
            BodyData::Movable { mass: self.mass(), yaw_inertia: self.yaw_inertia() }
        };
        data.serialize(serializer)
    }
}

impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for Body<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match BodyData::deserialize(deserializer)? {
            BodyData::Fixed => Ok(Self::fixed()),
            BodyData::Movable { mass, yaw_inertia } => Self::new(mass, yaw_inertia).map_err(D::Error::custom),
        }
    }
}

written_as!(participant: Participant {
    body: Body<T> = participant.body,
    forward: Vector2<T> = participant.forward,
    // The forward axis if absent.
    course: Option<Vector2<T>> = Some(participant.course),
    arm: Vector2<T> = participant.arm,
} => {
    let course = course.unwrap_or(forward);
    let length = |vector: Vector2<T>| (vector.x * vector.x + vector.y * vector.y).sqrt().value();
    let [low, high] = UNIT_LENGTH;
    check::within("length of the forward axis", length(forward), low, high)?;
    check::within("length of the course", length(course), low, high)?;
    check::finite("distance to the contact point along x", arm.x.value())?;
    check::finite("distance to the contact point along y", arm.y.value())?;
    Ok(Self { body, forward, course, arm })
});

written_as!(contact: Contact {
    participants: [Participant<T>; 2] = contact.participants,
    crush_plane: T = contact.crush_plane,
} => Self::new(participants, crush_plane));

written_as!(law: Law {
    restitution: T = law.restitution,
    tangential: Tangential<T> = law.tangential,
    moment_restitution: T = law.moment_restitution,
} => Self::new(restitution, tangential)?.with_moment_restitution(moment_restitution));

written_as!(curve: RestitutionCurve { points: Vec<(T, T)> = curve.points } => Self::new(points));

written_as!(varying: VaryingLaw {
    law: Law<T> = varying.nominal,
    curve: Option<RestitutionCurve<T>> = varying.curve,
} => Ok(match curve {
    Some(curve) => law.with_restitution_curve(curve),
    None => law.into(),
}));
