//! Tables as reports print them, real records, bounds against random traces, errors against draws.

#![expect(clippy::disallowed_methods, reason = "what is expected shares no function with what is tested")]
#![expect(clippy::print_stdout, reason = "a test that is skipped, or counts, says so")]
#![expect(clippy::cast_precision_loss, reason = "counts of draws are small")]

#[cfg(test)]
mod aligned;
#[cfg(test)]
mod bounds;
#[cfg(test)]
mod examples;
#[cfg(test)]
mod layouts;
#[cfg(test)]
mod pulses;
#[cfg(test)]
mod records;
#[cfg(test)]
mod speeds;
