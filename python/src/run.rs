//! Long work: without the interpreter's lock, on threads of this process, and ended by Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The longest time until Ctrl-C is noticed.
const PATIENCE: Duration = Duration::from_millis(50);

/// The most threads that can be asked for.
const MOST_THREADS: usize = 1024;

/// Pools by process and number of threads. A forked process has none of its parent's threads, and would wait
/// for them for ever; so it gets a pool of its own.
type Pools = Vec<(u32, usize, Arc<ThreadPool>)>;
static POOLS: Mutex<Pools> = Mutex::new(Vec::new());

/// The pool of this process with so many threads; without a number, with one for each processor.
pub(crate) fn pool(threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    let threads = match threads {
        None => 0,
        Some(threads) if (1..=MOST_THREADS).contains(&threads) => threads,
        Some(threads) => {
            return Err(PyValueError::new_err(format!(
                "threads={threads}: give a number from 1 to {MOST_THREADS}, or None for one for each \
                 processor"
            )));
        }
    };
    let process = std::process::id();
    // If another thread held the lock at the moment of a fork, it is never released in the child.
    let mut pools = POOLS.try_lock().ok();
    let known = pools.iter().flat_map(|pools| pools.iter());
    if let Some((_, _, pool)) = known.into_iter().find(|(of, size, _)| (*of, *size) == (process, threads)) {
        return Ok(Arc::clone(pool));
    }
    // A stack that overflows would end the interpreter.
    let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(analysis::THREAD_STACK).build();
    let pool = Arc::new(
        pool.map_err(|error| PyRuntimeError::new_err(format!("cannot start the threads: {error}")))?,
    );
    if let Some(pools) = &mut pools {
        pools.push((process, threads, Arc::clone(&pool)));
    }
    Ok(pool)
}

/// Whether the work is to end early.
pub(crate) struct Ending(AtomicBool);

impl Ending {
    /// For work that is too short to be interrupted.
    pub(crate) fn never() -> Self {
        Self(AtomicBool::new(false))
    }

    /// The value that a `progress` callback returns.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Does the work on a pool, and listens to signals meanwhile: Python's handler runs on the calling thread. An
/// exception that it raises is passed on as soon as the work has ended.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce(&Ending) -> T + Send,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let ending = Ending::never();
    let (send, receive) = sync_channel(1);
    let (ending, work_of_pool) = (&ending, work);
    let receive = Mutex::new(receive);
    let mut raised = None;
    let answer = pool.in_place_scope(|scope| {
        scope.spawn(move |_| {
            // Sending fails if the calling thread no longer waits for the answer.
            let _ = send.send(work_of_pool(ending));
        });
        loop {
            let wait = || receive.lock().ok().map(|receive| receive.recv_timeout(PATIENCE));
            match py.detach(wait) {
                Some(Ok(answer)) => return Some(answer),
                Some(Err(RecvTimeoutError::Timeout)) => {}
                _ => return None,
            }
            if raised.is_none()
                && let Err(signal) = py.check_signals()
            {
                ending.0.store(true, Ordering::Relaxed);
                raised = Some(signal);
            }
        }
    });
    match (raised, answer) {
        (Some(signal), _) => Err(signal),
        (None, Some(answer)) => Ok(answer),
        (None, None) => Err(PyRuntimeError::new_err("a thread ended before its work was done")),
    }
}
