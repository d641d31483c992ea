//! The threads of a command.

use anyhow::{Context as _, Result};
use rayon::{ThreadPool, ThreadPoolBuilder};

pub(crate) fn pool(threads: Option<u16>) -> Result<ThreadPool> {
    // Without a number, rayon takes one thread for each processor.
    let threads = threads.map_or(0, usize::from);
    let builder = ThreadPoolBuilder::new().num_threads(threads).stack_size(analysis::THREAD_STACK);
    builder.build().context("cannot start the threads")
}
