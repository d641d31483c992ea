//! Reads the types with an invariant: their fields are the arguments of their constructors, which it calls.

use alloc::vec::Vec;

use real::read_as;

use crate::barrier_test::BarrierTest;
use crate::direction::{DamagedFace, Side};
use crate::error::CrushError;
use crate::profile::Profile;
use crate::stiffness::Stiffness;

read_as!(CrushError; Profile { depths: Vec<T>, spacings: Vec<T> } => Self::new(depths, spacings));
read_as!(CrushError; Stiffness { a: T, b: T, g: T, saturation_force: Option<T> } => {
    let rising = Self::from_abg(a, b, g)?;
    saturation_force.map_or(Ok(rising), |force| rising.with_saturation_force(force))
});
read_as!(CrushError; BarrierTest { mass: T, speed: T, profile: Profile<T>, no_damage_speed: T } => {
    Self::new(mass, speed, profile, no_damage_speed)
});
read_as!(CrushError; DamagedFace { side: Side, distance: T, offset: T } => Self::new(side, distance, offset));
