//! The threads of a command.

use anyhow::{Context as _, Result};
use rayon::{ThreadPool, ThreadPoolBuilder};

pub(crate) fn pool(threads: Option<u16>) -> Result<ThreadPool> {
    /// (byte) what a search back from rests needs in a build without optimisation, and more.
    const STACK: usize = 16 << 20;
    // Without a number, rayon takes one thread for each processor.
    let threads = threads.map_or(0, usize::from);
    let builder = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK);
    builder.build().context("cannot start the threads")
}
