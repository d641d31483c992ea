//! Tests across the crates, in one binary.
//!
//! What is expected comes from a source (the paper, with its misprints corrected as docs/theory.md has them)
//! or from a method that shares no code with the crates: [`oracle`] solves the raw equations of impulse and
//! momentum for the random collisions of [`scenes`]. These are the same at every run; `PROPTEST_RNG_SEED=2
//! cargo test -p deltav-tests` draws others.

#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

#[cfg(test)]
mod advisories;
#[cfg(test)]
mod all_speeds;
#[cfg(test)]
mod allocation;
#[cfg(test)]
mod benchmarks;
#[cfg(test)]
mod binaries;
#[cfg(test)]
mod circles;
#[cfg(test)]
mod comments;
mod compare;
#[cfg(test)]
mod coulomb;
#[cfg(test)]
mod crush;
#[cfg(test)]
mod derivatives;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod invariants;
#[cfg(test)]
mod jumps;
#[cfg(test)]
mod laws;
#[cfg(test)]
mod licences;
#[cfg(test)]
mod line_of_action;
#[cfg(test)]
mod maps;
#[cfg(test)]
mod momentum;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod packages;
#[cfg(test)]
mod paper_equations;
#[cfg(test)]
mod paper_example;
#[cfg(test)]
mod reconciliation;
#[cfg(test)]
mod refusals;
#[cfg(test)]
mod restitution;
#[cfg(test)]
mod root_finding;
#[cfg(test)]
mod scenes;
#[cfg(test)]
mod structures;
#[cfg(test)]
mod tangential_share;
#[cfg(test)]
mod turns;
#[cfg(test)]
mod twins;
#[cfg(test)]
mod written;
