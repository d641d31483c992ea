//! The text of the guide, the README and the other pages outside their console blocks: its commands, options,
//! keys and numbers. The console blocks themselves are run by `transcripts.rs`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

mod commands;
mod keys;
mod numbers;
mod prose;
mod recipes;
