//! Time and distance: printed examples, a simulation in small steps, inverses.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

#[cfg(test)]
mod closed_forms;
#[cfg(test)]
mod courses;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod printed;
#[cfg(test)]
mod recorded;
#[cfg(test)]
mod written;
