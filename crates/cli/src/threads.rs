//! The threads of a command.

use anyhow::{Context as _, Result};
use rayon::{ThreadPool, ThreadPoolBuilder};
use requests::RequestProgress;

use crate::progress::Progress;

pub(crate) fn pool(threads: Option<u16>) -> Result<ThreadPool> {
    // Without a number, rayon takes one thread for each processor.
    let threads = threads.map_or(0, usize::from);
    let builder = ThreadPoolBuilder::new().num_threads(threads).stack_size(analysis::THREAD_STACK);
    builder.build().context("cannot start the threads")
}

/// Runs a long task in a pool, with a bar on the terminal.
pub(crate) fn in_pool<T: Send>(
    pool: &ThreadPool,
    run: impl FnOnce(&mut RequestProgress<'_>) -> T + Send,
) -> Result<T> {
    let mut progress = Progress::new()?;
    Ok(pool.install(|| run(&mut |counted, done, total| progress.at(counted, done, total))))
}
