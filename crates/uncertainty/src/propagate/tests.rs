use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::{Limits, Propagation, propagate, propagate_by};
use crate::distribution::Distribution;
use crate::model::{LANES, Lanes, Model, SUCCEEDED};
use crate::points::SamplingMethod;
use crate::run::Instructions;
use crate::sampler::Settings;
use crate::summary::{Caution, Classes};

/// A sum, a quotient with a long tail, one of three numbers, and a constant; some samples fail.
struct Mixed;

impl Model for Mixed {
    fn outputs(&self) -> usize {
        5
    }

    fn summarised(&self) -> usize {
        4
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], reasons: &mut [u8; LANES]) {
        for lane in 0..LANES {
            let [a, b] = [inputs[0][lane], inputs[1][lane]];
            let values = [a + b, b / a, (b * 0.75).floor(), 7.0, a];
            for (output, value) in outputs.iter_mut().zip(values) {
                output[lane] = value;
            }
            reasons[lane] = if b > 3.5 && a > 0.5 { 7 } else { SUCCEEDED };
        }
    }

    fn tallies(&self) -> usize {
        1
    }

    /// The samples with an answer of which the output that nobody asked for is negative.
    fn tally(&self, _: &[Lanes], outputs: &[Lanes], reasons: &[u8], tallies: &mut [usize]) {
        let samples = reasons.iter().zip(&outputs[4]);
        tallies[0] += samples.filter(|(reason, a)| **reason == SUCCEEDED && **a < 0.0).count();
    }
}

fn inputs() -> [Distribution; 2] {
    [Distribution::normal(1.0, 0.7).unwrap(), Distribution::uniform(0.0, 4.0).unwrap()]
}

/// With so little caution, and so few values at a time, that it takes further passes.
const FEW: Limits = Limits {
    group: 2,
    again: 3 * 4096 * 4,
    caution: Caution { deviations: 0.01, roots: 0.0, few: 100 },
    most: 100,
};

fn again(settings: &Settings, limits: &Limits) -> Propagation {
    let settings = Settings { keep: 0, ..*settings };
    propagate_by(&Mixed, &inputs(), &settings, &mut |_, _| ControlFlow::Continue(()), limits).unwrap()
}

#[test]
fn a_run_that_is_drawn_again_has_the_bits_of_one_that_is_kept() {
    for (_, method) in SamplingMethod::WORDS {
        for samples in [64, 1000, 4096, 3 * 4096, 3 * 4096 + 1, 50_001] {
            let settings = Settings::new(method, samples, 11);
            let kept =
                propagate(&Mixed, &inputs(), &settings, &mut |_, _| ControlFlow::Continue(())).unwrap();
            assert!(kept.is_kept() && kept.columns().len() == 4);
            assert!(samples < 1000 || (kept.failures()[&7] > 0 && kept.tallies()[0] > 0));
            for limits in [FEW, Limits { again: 1, ..FEW }, Limits::USUAL] {
                let again = again(&settings, &limits);
                // Whole spans, so that up to here nothing is left out.
                assert_eq!(again.is_kept(), samples <= 4096);
                assert_eq!(again.evaluated(), samples);
                assert_eq!((again.failures(), again.tallies()), (kept.failures(), kept.tallies()));
                // Debug prints an f64 so that it reads back as the same.
                assert_eq!(
                    format!("{:?}", again.summaries()),
                    format!("{:?}", kept.summaries()),
                    "{method:?}, {samples} samples"
                );
                for output in 0..5 {
                    for classes in Classes::ALL {
                        let histogram = kept.histogram(output, classes);
                        assert_eq!(again.histogram(output, classes), histogram);
                        assert_eq!(histogram.is_some(), output < 3, "{output}");
                    }
                }
                let first = samples.min(4096);
                assert_eq!(again.reasons(), &kept.reasons()[..first]);
                let bits = |column: &[f64]| column.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                for (again, kept) in again.columns().iter().zip(kept.columns()) {
                    assert_eq!(bits(again), bits(&kept[..first]));
                }
            }
        }
    }
}

/// Needs the feature `parallel`, which the benchmarks switch on for the whole workspace.
#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_gives_the_same_bits_when_drawn_again() {
    for (_, method) in SamplingMethod::WORDS {
        let settings = Settings::new(method, 60_001, 5);
        let results: Vec<String> = (1..=5)
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let run = pool.install(|| again(&settings, &FEW));
                format!("{:?} {:?} {:?}", run.summaries(), run.totals, run.histograms)
            })
            .collect();
        assert!(results.iter().all(|result| *result == results[0]), "{method:?}");
    }
}

/// The first time that the samples are drawn; later the answer of `progress` is not heard.
#[test]
fn an_early_end_leaves_the_first_samples_of_the_whole_run() {
    for (_, method) in SamplingMethod::WORDS {
        let settings = Settings::new(method, 50_000, 4);
        let mut told = Vec::new();
        let mut progress = |done: usize, total: usize| {
            told.push(done);
            assert_eq!(total, 50_000);
            if told.len() > 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let chunked = Settings { keep: 0, ..settings };
        let part = propagate_by(&Mixed, &inputs(), &chunked, &mut progress, &FEW).unwrap();
        assert_eq!((part.requested(), part.evaluated()), (50_000, 5 * 4096));
        assert!(told.is_sorted() && told.len() > 10 && told.iter().all(|done| *done <= 50_000), "{told:?}");
        let mut calls = 0;
        let mut progress = |_: usize, _: usize| {
            calls += 1;
            if calls > 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let kept = propagate(&Mixed, &inputs(), &settings, &mut progress).unwrap();
        assert_eq!(format!("{:?}", part.summaries()), format!("{:?}", kept.summaries()));
        assert_eq!((part.failures(), part.tallies()), (kept.failures(), kept.tallies()));
    }
    let chunked = Settings { keep: 0, ..Settings::new(SamplingMethod::Sobol, 50_000, 4) };
    let none = propagate_by(&Mixed, &inputs(), &chunked, &mut |_, _| ControlFlow::Break(()), &FEW).unwrap();
    assert_eq!((none.evaluated(), none.summaries()[0]), (0, None));
}

/// One column of four, and none: summaries and histograms are the same, as far as there are any.
#[test]
fn columns_that_nobody_wants_are_not_kept() {
    for (_, method) in SamplingMethod::WORDS {
        let settings = Settings::new(method, 50_001, 3);
        let run = |settings: &Settings, limits: &Limits| {
            propagate_by(&Mixed, &inputs(), settings, &mut |_, _| ControlFlow::Continue(()), limits).unwrap()
        };
        let all = run(&settings, &Limits::USUAL);
        for (columns, keep) in [(0, usize::MAX), (1, usize::MAX), (1, 0), (3, usize::MAX), (3, 0)] {
            for limits in [FEW, Limits::USUAL] {
                let some = run(&Settings { columns, keep, ..settings }, &limits);
                assert_eq!(format!("{:?}", some.summaries()), format!("{:?}", all.summaries()));
                assert_eq!((some.failures(), some.tallies()), (all.failures(), all.tallies()));
                assert_eq!((some.is_kept(), some.columns().len()), (false, 4));
                assert_eq!(some.reasons(), &all.reasons()[..4096]);
                let first: Vec<&[f64]> = all.columns().into_iter().map(|column| &column[..4096]).collect();
                assert_eq!(format!("{:?}", some.columns()), format!("{first:?}"));
                for (output, classes) in
                    (0..4).flat_map(|output| Classes::ALL.map(|classes| (output, classes)))
                {
                    let expected = all.histogram(output, classes).filter(|_| output < columns);
                    assert_eq!(some.histogram(output, classes), expected, "{output} of {columns}");
                }
            }
        }
    }
}

/// However many samples there are, only the first thousands are kept.
#[test]
fn nothing_but_the_first_samples_is_kept() {
    let settings = Settings::new(SamplingMethod::MonteCarlo, 200_000, 1);
    let run = again(&settings, &FEW);
    assert_eq!((run.reasons().len(), run.columns()[0].len(), run.is_kept()), (4096, 4096, false));
    assert_eq!(run.summaries()[0].unwrap().samples, run.succeeded());
}

/// One output, its input, and how many blocks were evaluated.
struct Counted(AtomicUsize);

impl Model for Counted {
    fn outputs(&self) -> usize {
        1
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], reasons: &mut [u8; LANES]) {
        self.0.fetch_add(1, Ordering::Relaxed);
        outputs[0] = inputs[0];
        reasons.fill(SUCCEEDED);
    }
}

/// By the first span alone, the window of the median of 400,000 samples would hold 8 % of them:
/// 10 √(0.25/4096). After 25 spans, a quarter of all, it holds 10 √(0.25·0.75/102,400), 1.4 %, and few more
/// were taken before. So 12,000 are enough for any window, and nothing is drawn again.
#[test]
fn windows_are_narrowed_while_a_run_goes_on() {
    let few = Limits { caution: Caution { roots: 0.0, few: 12_000, ..Caution::USUAL }, ..Limits::USUAL };
    let mut settings = Settings::new(SamplingMethod::MonteCarlo, 400_000, 6);
    (settings.columns, settings.classes) = (0, &[]);
    let model = Counted(AtomicUsize::new(0));
    let on = &mut |_: usize, _: usize| ControlFlow::Continue(());
    let run = propagate_by(&model, &inputs()[1..], &settings, on, &few).unwrap();
    assert!(run.summaries()[0].is_some());
    assert_eq!(model.0.into_inner(), 400_000 / LANES);
}
