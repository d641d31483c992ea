//! The tests of the speed at which the impact takes the crush energy, in one binary.
//!
//! Expected values come from the paper, with its misprints corrected as in docs/theory.md, from the impact
//! that is undone, or from scans of [`oracle`]'s impacts.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

#[cfg(test)]
mod all_speeds;
#[cfg(test)]
mod derivatives;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod momentum;
#[cfg(test)]
mod paper_equations;
#[cfg(test)]
mod paper_example;
#[cfg(test)]
mod reconciliation;
#[cfg(test)]
mod restitution;
#[cfg(test)]
mod root_finding;
#[cfg(test)]
mod tangential_share;
#[cfg(test)]
mod turns;
#[cfg(test)]
mod twins;
#[cfg(test)]
mod written;
