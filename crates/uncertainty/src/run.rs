//! Runs spans of samples in order, on one thread or several, with the CPU's instruction sets.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use fearless_simd::Level;

/// An instruction set of this CPU, for which a model's loops are compiled. All give the same bits and differ
/// only in speed.
#[derive(Clone, Copy, Debug)]
pub struct Instructions(Level);

impl Instructions {
    /// The best instruction set of this CPU.
    #[must_use]
    pub fn best() -> Self {
        Self(Level::new())
    }

    /// All instruction sets of this CPU, the best first, for tests that compare them.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let best = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let others = [
            best.as_avx512().map(Level::Avx512),
            best.as_avx2().map(Level::Avx2),
            best.as_sse2().map(Level::Sse2),
        ];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let others = [Some(best)];
        others.into_iter().flatten().map(Self).collect()
    }

    /// The level for [`dispatch!`](crate::dispatch).
    #[must_use]
    pub fn level(self) -> Level {
        self.0
    }
}

/// Evaluates a call with the given [`Instructions`]. It must be a single call of an `#[inline(always)]`
/// function: anything else, even a closure, would be compiled for the baseline instruction set.
///
/// SSE4.2 gains little over the baseline of x86-64 and has no code of its own, because each copy of a model
/// takes long to compile.
#[macro_export]
macro_rules! dispatch {
    ($instructions:expr, $call:expr) => {{
        let level = $crate::Instructions::level($instructions);
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            if let Some(avx512) = level.as_avx512() {
                $crate::simd::Simd::vectorize(
                    avx512,
                    #[inline(always)]
                    || $call,
                )
            } else if let Some(avx2) = level.as_avx2() {
                $crate::simd::Simd::vectorize(
                    avx2,
                    #[inline(always)]
                    || $call,
                )
            } else {
                $call
            }
        }
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        {
            $crate::simd::dispatch!(level, _simd => $call)
        }
    }};
}

impl Default for Instructions {
    fn default() -> Self {
        Self::best()
    }
}

/// Receives the number of finished samples and of all samples whenever a span of some thousand samples
/// begins, and ends the run by returning [`ControlFlow::Break`]. It may be called from any thread, but only
/// by one at a time.
pub type Progress<'a> = dyn FnMut(usize, usize) -> ControlFlow<()> + Send + 'a;

/// A span of work, with its number of samples.
#[derive(Clone, Copy, Debug)]
pub struct Span<S> {
    /// Number of samples.
    pub samples: usize,
    /// The work.
    pub work: S,
}

/// State shared by the workers.
struct Queue<'a, I> {
    waiting: I,
    done: usize,
    progress: &'a mut Progress<'a>,
}

/// Runs the spans in order until `progress` breaks, and returns their results in order.
///
/// A span that has begun is finished, so the results are those of the first spans, without a gap.
pub fn in_order<S: Send, T: Send>(
    spans: Vec<Span<S>>,
    work: impl Fn(S) -> T + Sync,
    progress: &mut Progress<'_>,
) -> Vec<T> {
    let total = spans.iter().map(|span| span.samples).sum();
    let workers = workers().min(spans.len());
    let mut shared = |done: usize, total: usize| progress(done, total);
    let queue = Mutex::new(Queue { waiting: spans.into_iter().enumerate(), done: 0, progress: &mut shared });
    let results = Mutex::new(Vec::new());
    let worker = || {
        let mut own = Vec::new();
        let mut finished = 0;
        loop {
            let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
            queue.done += finished;
            let done = queue.done;
            if queue.waiting.len() == 0 || (queue.progress)(done, total).is_break() {
                // No worker begins another span.
                queue.waiting.by_ref().for_each(drop);
                break;
            }
            let Some((index, span)) = queue.waiting.next() else { break };
            drop(queue);
            finished = span.samples;
            own.push((index, work(span.work)));
        }
        results.lock().unwrap_or_else(PoisonError::into_inner).append(&mut own);
    };
    on_threads(workers, &worker);
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_unstable_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

/// The results of `work` for each item, in order.
pub fn for_each<S: Send, T: Send>(
    items: impl IntoIterator<Item = S>,
    work: impl Fn(S) -> T + Sync,
) -> Vec<T> {
    let spans = items.into_iter().map(|work| Span { samples: 0, work }).collect();
    in_order(spans, work, &mut |_, _| ControlFlow::Continue(()))
}

/// The results of both: the second runs after the first, or in parallel with it if the caller is one of
/// rayon's threads. Handing both to rayon from another thread, and waiting, may take longer than running
/// them.
pub fn join<A: Send, B: Send>(first: impl FnOnce() -> A + Send, second: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "parallel")]
    if rayon::current_thread_index().is_some() {
        return rayon::join(first, second);
    }
    (first(), second())
}

#[cfg(feature = "parallel")]
fn workers() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "parallel"))]
fn workers() -> usize {
    1
}

#[cfg(feature = "parallel")]
fn on_threads(workers: usize, worker: &(impl Fn() + Sync)) {
    // A thread outside rayon would hand even this to one of rayon's, and wait.
    if workers <= 1 {
        worker();
        return;
    }
    rayon::scope(|scope| {
        for _ in 1..workers {
            scope.spawn(|_| worker());
        }
        worker();
    });
}

#[cfg(not(feature = "parallel"))]
fn on_threads(_workers: usize, worker: &(impl Fn() + Sync)) {
    worker();
}

#[cfg(test)]
mod tests {
    use super::{Span, in_order, join};
    use std::ops::ControlFlow;

    fn spans(count: u64) -> Vec<Span<u64>> {
        (0..count).map(|work| Span { samples: 10, work }).collect()
    }

    #[test]
    fn results_come_in_order_and_progress_counts_up() {
        let mut seen = Vec::new();
        let results = in_order(spans(100), |work| work * work, &mut |done, total| {
            seen.push((done, total));
            ControlFlow::Continue(())
        });
        assert!(results.into_iter().eq((0..100).map(|work| work * work)));
        assert_eq!(seen.len(), 100);
        assert_eq!(seen[0], (0, 1000));
        assert!(seen.is_sorted() && seen.iter().all(|&(done, total)| done < 1000 && total == 1000));
    }

    #[test]
    fn both_are_done_wherever_they_are() {
        let spans = || in_order(spans(9), |work| work, &mut |_, _| ControlFlow::Continue(()));
        let both = || join(|| join(|| 1, spans), || "two");
        let expected = ((1, (0..9).collect()), "two");
        assert_eq!(both(), expected);
        #[cfg(feature = "parallel")]
        rayon::scope(|_| assert_eq!(both(), expected));
    }

    #[test]
    fn a_break_leaves_the_first_spans() {
        let mut calls = 0;
        let results = in_order(spans(100), |work| work, &mut |_, _| {
            calls += 1;
            if calls > 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(results.into_iter().eq(0..7));
        assert_eq!(calls, 8);
    }
}
