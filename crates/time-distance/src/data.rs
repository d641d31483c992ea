//! Reads the types with an invariant: their fields are the arguments of their constructors, which it calls.

use pim_core::InvalidInput;
use real::read_as;

use crate::crossing::{Crossing, Party};
use crate::response::{Response, Swell};

read_as!(InvalidInput; Response { reaction: T, swell: T, deceleration: T, form: Swell } => {
    Self::new(reaction, swell, deceleration, form)
});
read_as!(InvalidInput; Crossing { angle: T, parties: [Party<T>; 2] } => Self::new(angle, parties));
