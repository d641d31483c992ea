//! What the guide, the README and the other pages say beside their console blocks: commands, options, keys
//! and numbers in the text. The console blocks themselves are run by `transcripts.rs`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

mod commands;
mod keys;
mod numbers;
mod prose;
mod recipes;
