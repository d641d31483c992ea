//! The tests of the impact, in one binary.
//!
//! Expected values come from a source, a hand calculation, or [`oracle`], which solves the raw equations of
//! impulse and momentum for random collisions.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

#[cfg(test)]
mod brute_force;
#[cfg(test)]
mod coulomb;
#[cfg(test)]
mod domain;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod invariants;
#[cfg(test)]
mod jumps;
#[cfg(test)]
mod laws;
#[cfg(test)]
mod refusals;
#[cfg(test)]
mod restitution;
#[cfg(test)]
mod twins;
#[cfg(test)]
mod written;
