//! Motion after an impact: closed forms, balances, mirrors, staged collisions.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]

#[cfg(test)]
mod backward;
mod block;
#[cfg(test)]
mod closed_forms;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod integration;
#[cfg(test)]
mod ricsac;
#[cfg(test)]
mod scenes;
#[cfg(test)]
mod steering;
#[cfg(test)]
mod written;
