//! The tests of crush energy, forces and velocity changes, in one binary.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

#[cfg(test)]
mod crush;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod line_of_action;
#[cfg(test)]
mod structures;
#[cfg(test)]
mod twins;
#[cfg(test)]
mod written;
