use std::ops::ControlFlow;

use super::{Propagation, propagate};
use crate::distribution::Distribution;
use crate::model::{LANES, Lanes, Model, SUCCEEDED};
use crate::points::SamplingMethod;
use crate::run::Instructions;
use crate::sampler::{Sampler, Settings};
use crate::summary::Classes;

/// A sum, a quotient with a long tail, one of three numbers, and a constant; some samples fail.
struct Mixed;

impl Model for Mixed {
    fn outputs(&self) -> usize {
        4
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], reasons: &mut [u8; LANES]) {
        for lane in 0..LANES {
            let [a, b] = [inputs[0][lane], inputs[1][lane]];
            let values = [a + b, b / a, (b * 0.75).floor(), 7.0];
            for (output, value) in outputs.iter_mut().zip(values) {
                output[lane] = value;
            }
            reasons[lane] = if b > 3.5 && a > 0.5 { 7 } else { SUCCEEDED };
        }
    }
}

fn inputs() -> [Distribution; 2] {
    [Distribution::normal(1.0, 0.7).unwrap(), Distribution::uniform(0.0, 4.0).unwrap()]
}

fn run(settings: &Settings) -> Propagation {
    propagate(&Mixed, &inputs(), settings, &mut |_, _| ControlFlow::Continue(())).unwrap()
}

/// Needs the feature `parallel`, which the benchmarks enable for the whole workspace.
#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (_, method) in SamplingMethod::WORDS {
        let settings = Settings::new(method, 60_001, 5);
        let results: Vec<String> = (1..=5)
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let run = pool.install(|| run(&settings));
                format!("{:?} {:?}", run.summaries(), run.failures)
            })
            .collect();
        assert!(results.iter().all(|result| *result == results[0]), "{method:?}");
    }
}

/// All results, compared with the model of one sample: a column for each output, NaN for failed
/// samples, histograms of all outputs that vary, and the counts.
#[test]
fn all_samples_are_kept() {
    for (_, method) in SamplingMethod::WORDS {
        for samples in [64, 1000, 4096, 3 * 4096, 3 * 4096 + 1, 50_001] {
            let settings = Settings::new(method, samples, 11);
            let found = run(&settings);
            assert_eq!((found.evaluated(), found.requested(), found.columns().len()), (samples, samples, 4));
            let inputs = inputs();
            let sampler = Sampler::new(&inputs, &settings).unwrap();
            let mut drawn = [Lanes::ZERO; 2];
            let mut failed = 0;
            for sample in 0..samples {
                if sample % LANES == 0 {
                    sampler.fill((sample / LANES) as u64, &mut drawn);
                }
                let [a, b] = drawn.map(|column| column[sample % LANES]);
                let fails = b > 3.5 && a > 0.5;
                failed += usize::from(fails);
                assert_eq!(found.reasons()[sample], if fails { 7 } else { SUCCEEDED });
                for (column, value) in found.columns().iter().zip([a + b, b / a, (b * 0.75).floor(), 7.0]) {
                    let value = if fails { f64::NAN } else { value };
                    assert_eq!(column[sample].to_bits(), value.to_bits(), "{method:?}, sample {sample}");
                }
            }
            assert_eq!(found.failures().get(&7).copied().unwrap_or(0), failed);
            assert!(samples < 1000 || failed > 0);
            for output in 0..5 {
                for classes in Classes::ALL {
                    assert_eq!(found.histogram(output, classes).is_some(), output < 3, "{output}");
                }
            }
        }
    }
}

#[test]
fn an_early_end_leaves_the_first_samples_of_the_whole_run() {
    for (_, method) in SamplingMethod::WORDS {
        let settings = Settings::new(method, 50_000, 4);
        let whole = run(&settings);
        let mut told = Vec::new();
        let mut progress = |done: usize, total: usize| {
            told.push(done);
            assert_eq!(total, 50_000);
            if told.len() > 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let part = propagate(&Mixed, &inputs(), &settings, &mut progress).unwrap();
        let evaluated = part.evaluated();
        assert!(evaluated > 0 && evaluated < 50_000 && evaluated % LANES == 0, "{evaluated}");
        assert_eq!((part.requested(), part.reasons().len()), (50_000, evaluated));
        assert!(told.is_sorted() && told.iter().all(|done| *done <= 50_000), "{told:?}");
        let bits = |column: &[f64]| column.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        for (part, whole) in part.columns().iter().zip(whole.columns()) {
            assert_eq!(bits(part), bits(&whole[..evaluated]));
        }
        let failed = whole.reasons()[..evaluated].iter().filter(|reason| **reason != SUCCEEDED).count();
        assert_eq!(part.succeeded(), evaluated - failed);
        assert_eq!(part.summaries()[0].map(|summary| summary.samples), Some(part.succeeded()));
    }
    let settings = Settings::new(SamplingMethod::Sobol, 50_000, 4);
    let none = propagate(&Mixed, &inputs(), &settings, &mut |_, _| ControlFlow::Break(())).unwrap();
    assert_eq!((none.evaluated(), none.summaries()[0]), (0, None));
}
