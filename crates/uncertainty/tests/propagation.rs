//! Propagation: exact answers, standard errors, failures, early ends, the same bits everywhere.
#![expect(clippy::unwrap_used, reason = "clippy's exemption for tests leaves out the helpers beside them")]
#![expect(clippy::disallowed_methods, reason = "squares of errors, no bits of which are compared")]

use std::ops::ControlFlow;
use uncertainty::{
    Distribution, Function, Instructions, InvalidRequest, LANES, Lanes, Model, NOT_FINITE, Propagation,
    SUCCEEDED, Sampler, SamplingMethod, Settings, propagate,
};

const METHODS: [SamplingMethod; 3] =
    [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube, SamplingMethod::Sobol];

fn run<M: Model>(model: &M, inputs: &[Distribution], settings: &Settings) -> Propagation {
    propagate(model, inputs, settings, &mut |_, _| ControlFlow::Continue(())).unwrap()
}

fn normal(mean: f64, sd: f64) -> Distribution {
    Distribution::normal(mean, sd).unwrap()
}

/// 3x₀ − 2x₁ + 10 and x₀, in blocks like a vectorised model.
struct Linear;

impl Model for Linear {
    fn outputs(&self) -> usize {
        2
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], _reasons: &mut [u8; LANES]) {
        for lane in 0..LANES {
            outputs[0][lane] = inputs[0][lane] * 3.0 - inputs[1][lane] * 2.0 + 10.0;
            outputs[1][lane] = inputs[0][lane];
        }
    }
}

/// For N(1, 1) and N(2, 2): mean 3 − 4 + 10 = 9, standard deviation √(9 + 16) = 5, quantiles 9 ± 5z.
#[test]
fn a_linear_model_is_exact_within_its_standard_errors() {
    for method in METHODS {
        let result = run(&Linear, &[normal(1.0, 1.0), normal(2.0, 2.0)], &Settings::new(method, 1 << 17, 9));
        let summary = result.summaries()[0].unwrap();
        // z at 75, 95, 97.5 and 99.5 % (mpmath).
        let z = [0.674_489_750_196_082, 1.644_853_626_951_472, 1.959_963_984_540_054, 2.575_829_303_548_901];
        let mut checks = vec![(summary.mean, 9.0), (summary.sd, 5.0), (summary.median, 9.0)];
        for (interval, z) in summary.intervals.iter().zip(z) {
            checks.extend([(interval.low, 9.0 - 5.0 * z), (interval.high, 9.0 + 5.0 * z)]);
        }
        for (estimate, exact) in checks {
            let error = estimate.standard_error.unwrap();
            // Student's t with 15 degrees of freedom is beyond 5 once in 6000.
            assert!(
                (estimate.value - exact).abs() < 5.0 * error,
                "{method:?}: {estimate:?}, exactly {exact}"
            );
            assert!(error < 0.1, "{method:?}: {error}");
        }
    }
}

/// A stated standard error must agree with repetitions with other seeds.
#[test]
fn standard_errors_are_the_spread_over_seeds() {
    let seeds = 200;
    let inputs = [normal(1.0, 0.5), Distribution::uniform(0.0, 2.0).unwrap(), normal(0.0, 1.0)];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] * x[0] + x[1] + 0.5 * x[2];
        Ok(())
    });
    for method in METHODS {
        // Value and stated error of mean, deviation, median and the ends of the 90 % interval.
        let mut estimates: [Vec<(f64, f64)>; 5] = Default::default();
        for seed in 0..seeds {
            let summary = run(&model, &inputs, &Settings::new(method, 1 << 12, seed)).summaries()[0].unwrap();
            let [_, interval, ..] = summary.intervals;
            let all = [summary.mean, summary.sd, summary.median, interval.low, interval.high];
            for (list, estimate) in estimates.iter_mut().zip(all) {
                list.push((estimate.value, estimate.standard_error.unwrap()));
            }
        }
        for (number, list) in estimates.iter().enumerate() {
            let count = list.len() as f64;
            let mean = list.iter().map(|(value, _)| value).sum::<f64>() / count;
            let spread = list.iter().map(|(value, _)| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
            let stated = list.iter().map(|(_, error)| error * error).sum::<f64>() / count;
            // The spread of 200 is uncertain by 1/√400 = 5 %, times four; the error of a quantile includes
            // one place more.
            let ratio = (stated / spread).sqrt();
            assert!((0.8..1.25).contains(&ratio), "{method:?}, estimate {number}: {ratio}");
        }
    }
}

/// Ratio of the spread of the 2.5 %, 50 % and 97.5 % quantile over the seeds to their stated errors.
fn ratios<M: Model>(model: &M, inputs: &[Distribution], method: SamplingMethod, samples: usize) -> [f64; 3] {
    let seeds: u64 = 100;
    let mut estimates = [(); 3].map(|()| Vec::new());
    for seed in 0..seeds {
        let summary = run(model, inputs, &Settings::new(method, samples, seed)).summaries()[0].unwrap();
        let interval = summary.intervals[2];
        for (list, estimate) in estimates.iter_mut().zip([interval.low, summary.median, interval.high]) {
            list.push((estimate.value, estimate.standard_error.unwrap()));
        }
    }
    estimates.map(|list| {
        let count = list.len() as f64;
        let mean = list.iter().map(|(value, _)| value).sum::<f64>() / count;
        let spread = list.iter().map(|(value, _)| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let stated = list.iter().map(|(_, error)| error * error).sum::<f64>() / count;
        (spread / stated).sqrt()
    })
}

/// If one input dominates the result, its strata determine it, and the quantiles of the replicates do not
/// show the error of the quantile of all samples. The spread over 100 seeds is uncertain by 7 %, times three.
/// If the quantile lies between two strata of all replicates, like the median of a power of two, the one
/// place that is always added is more than twice what is needed.
#[test]
fn errors_of_quantiles_are_honest_where_one_input_rules() {
    let alone = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] + 10.0;
        Ok(())
    });
    let nearly = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] + 0.1 * x[1];
        if x[1] > 23.0 { Err(1) } else { Ok(()) }
    });
    let two = [normal(20.0, 3.0); 2];
    for method in [SamplingMethod::LatinHypercube, SamplingMethod::Sobol] {
        for samples in [1024, 2500, 4096] {
            let found = ratios(&alone, &[normal(20.0, 3.0)], method, samples);
            assert!(found.iter().all(|ratio| (0.3..1.2).contains(ratio)), "{method:?}, {samples}: {found:?}");
            let found = ratios(&nearly, &two, method, samples);
            assert!(found.iter().all(|ratio| (0.6..1.2).contains(ratio)), "{method:?}, {samples}: {found:?}");
        }
    }
}

/// Many inputs, some of which interact: the errors are those of chance.
#[test]
fn errors_of_quantiles_are_honest_with_many_inputs() {
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        let sum: f64 = x.iter().zip(1..).map(|(x, number)| x / (1.0 + 0.3 * f64::from(number))).sum();
        y[0] = sum + 0.3 * (x[3] * x[7] + x[20] * x[25] + x[1] * x[12] * x[30]);
        Ok(())
    });
    let inputs = [normal(0.0, 1.0); 31];
    for method in [SamplingMethod::LatinHypercube, SamplingMethod::Sobol] {
        let found = ratios(&model, &inputs, method, 1024);
        assert!(found.iter().all(|ratio| (0.7..1.25).contains(ratio)), "{method:?}: {found:?}");
    }
}

/// On a smooth function, Latin hypercube and Sobol' points must be far better than chance.
#[test]
fn even_points_converge_faster() {
    let inputs = vec![Distribution::uniform(0.0, 1.0).unwrap(); 5];
    // Π (1 + (xᵢ − ½)/2), mean 1
    let product = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x.iter().map(|x| 1.0 + 0.5 * (x - 0.5)).product();
        Ok(())
    });
    let error = |method, samples| {
        let seeds = 20;
        let squares: f64 = (0..seeds)
            .map(|seed| {
                let summary =
                    run(&product, &inputs, &Settings::new(method, samples, seed)).summaries()[0].unwrap();
                (summary.mean.value - 1.0).powi(2)
            })
            .sum();
        (squares / seeds as f64).sqrt()
    };
    let [chance, latin, sobol] = METHODS.map(|method| error(method, 1 << 14));
    assert!(latin < chance / 3.0, "{latin}, by chance {chance}");
    assert!(sobol < chance / 50.0, "{sobol}, by chance {chance}");
    // Four times as many points halve an error of chance, and divide that of scrambled Sobol' points by
    // nearly 8 (Owen 1997).
    let finer = error(SamplingMethod::Sobol, 1 << 16);
    assert!(finer < sobol / 4.0, "{finer} after {sobol}");
}

#[test]
fn failures_are_counted_by_reason() {
    // √x fails below 0 with reason 3; above 0.75 it gives no number but does not report it.
    let inputs = [Distribution::uniform(-1.0, 1.0).unwrap()];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = if x[0] > 0.75 { f64::NAN } else { x[0].sqrt() };
        if x[0] < 0.0 { Err(3) } else { Ok(()) }
    });
    // Sixteen replicates of 64 strata each: exactly half fail, and an eighth are not finite.
    let settings = Settings::new(SamplingMethod::LatinHypercube, 1024, 2);
    let result = run(&model, &inputs, &settings);
    assert_eq!(result.failures().iter().collect::<Vec<_>>(), [(&3, &512), (&NOT_FINITE, &128)]);
    assert_eq!((result.requested(), result.evaluated(), result.succeeded()), (1024, 1024, 384));
    assert_eq!(result.summaries()[0].unwrap().samples, 384);
    assert!(result.summaries()[0].unwrap().mean.value < 0.75_f64.sqrt());

    // The sampler regenerates the inputs, and the reasons match them.
    let sampler = Sampler::new(&inputs, &settings).unwrap();
    let mut columns = [Lanes::ZERO];
    for (block, reasons) in result.reasons().chunks(LANES).enumerate() {
        sampler.fill(block as u64, &mut columns);
        for (lane, (x, reason)) in columns[0].iter().zip(reasons).enumerate() {
            let y = result.columns()[0][block * LANES + lane];
            match *reason {
                SUCCEEDED => assert_eq!(y, x.sqrt()),
                3 => assert!(*x < 0.0 && y.is_nan()),
                reason => assert!(reason == NOT_FINITE && *x > 0.75 && y.is_nan()),
            }
        }
    }

    // A failure without a reason is one, too: the output of the sample before is not its own.
    let untold = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0];
        if x[0] < 0.0 { Err(SUCCEEDED) } else { Ok(()) }
    });
    let result = run(&untold, &inputs, &settings);
    assert_eq!(result.failures().iter().collect::<Vec<_>>(), [(&NOT_FINITE, &512)]);
    assert!(result.columns()[0].iter().all(|y| y.is_nan() || *y >= 0.0));

    let never = Function::new(1, |_: &[f64], _: &mut [f64]| Err(1));
    let result = run(&never, &inputs, &settings);
    assert_eq!((result.succeeded(), result.summaries()[0]), (0, None));
}

#[test]
fn a_block_beyond_the_last_is_filled_with_something() {
    for method in METHODS {
        let inputs = [normal(1.0, 1.0)];
        let sampler = Sampler::new(&inputs, &Settings::new(method, 256, 1)).unwrap();
        let mut columns = [Lanes::splat(f64::NAN)];
        sampler.fill(u64::MAX, &mut columns);
        assert!(columns[0].iter().all(|x| x.is_finite()), "{method:?}");
    }
}

#[test]
fn an_early_end_leaves_the_first_samples_of_the_whole_run() {
    let inputs = [normal(0.0, 1.0), normal(5.0, 2.0)];
    for method in METHODS {
        let settings = Settings::new(method, 50_000, 4);
        let whole = run(&Linear, &inputs, &settings);
        let mut told = Vec::new();
        let part = propagate(&Linear, &inputs, &settings, &mut |done, total| {
            told.push(done);
            assert_eq!(total, 50_000);
            if told.len() > 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
        // Spans of 4096.
        assert_eq!((part.requested(), part.evaluated()), (50_000, 3 * 4096));
        for (part, whole) in part.columns().iter().zip(whole.columns()) {
            assert_eq!(*part, &whole[..3 * 4096]);
        }
        let summary = part.summaries()[1].unwrap();
        assert!(summary.mean.value.abs() < 6.0 * summary.mean.standard_error.unwrap(), "{method:?}");
        assert!(told.is_sorted());
    }
    let none = propagate(&Linear, &inputs, &Settings::new(SamplingMethod::Sobol, 100, 4), &mut |_, _| {
        ControlFlow::Break(())
    })
    .unwrap();
    assert_eq!((none.evaluated(), none.summaries()[0]), (0, None));
}

/// FNV-1a, 64 bits, over all samples and statistics.
fn hash(result: &Propagation) -> u64 {
    let statistics = result.summaries().iter().flatten().flat_map(|summary| {
        let ends = summary.intervals.into_iter().flat_map(|interval| [interval.low, interval.high]);
        let estimates = [summary.mean, summary.sd, summary.median].into_iter().chain(ends);
        estimates
            .flat_map(|estimate| [estimate.value, estimate.standard_error.unwrap_or(-1.0)])
            .collect::<Vec<_>>()
    });
    let samples = result.columns().iter().flatten().copied();
    samples
        .chain(statistics)
        .flat_map(|value| value.to_bits().to_le_bytes())
        .fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        })
}

fn of_every_kind() -> [Distribution; 4] {
    [
        normal(1.0, 0.25),
        Distribution::truncated_normal(0.3, 0.2, 0.0, 1.0).unwrap(),
        Distribution::uniform(-1.0, 4.0).unwrap(),
        Distribution::triangular(0.0, 1.0, 3.0).unwrap(),
    ]
}

/// Two outputs of all four inputs, one of them by division.
struct Mixed;

impl Model for Mixed {
    fn outputs(&self) -> usize {
        2
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], reasons: &mut [u8; LANES]) {
        for lane in 0..LANES {
            let [a, b, c, d] = [0, 1, 2, 3].map(|input: usize| inputs[input][lane]);
            outputs[0][lane] = a * b + c / (d + 1.0);
            outputs[1][lane] = a - c;
            reasons[lane] = if c > 3.9 { 7 } else { SUCCEEDED };
        }
    }
}

/// The pins do not test correctness, which the tests above do. They guarantee the same bits on every
/// platform, for any number of threads, for each instruction set, with and without the feature `parallel`,
/// and at every optimisation level. Renew them only for an intended change.
#[test]
fn bits_are_pinned_for_every_instruction_set() {
    let available = Instructions::available();
    assert!(!available.is_empty());
    let pins = [0x2736_AA27_2EE3_3C28, 0x446C_92BA_494C_B389, 0x02DA_D485_25DF_71FF];
    let hashes = METHODS.map(|method| {
        let hashes: Vec<u64> = available
            .iter()
            .map(|&instructions| {
                let settings = Settings { instructions, ..Settings::new(method, 20_011, 42) };
                hash(&run(&Mixed, &of_every_kind(), &settings))
            })
            .collect();
        assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{method:?}: {hashes:x?}");
        hashes[0]
    });
    assert_eq!(hashes, pins, "{hashes:#018X?}");
}

/// Needs the feature `parallel`, which the benchmarks enable for the whole workspace.
#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let settings = Settings::new(SamplingMethod::LatinHypercube, 30_001, 5);
    let hashes: Vec<u64> = (1..=7)
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| hash(&run(&Mixed, &of_every_kind(), &settings)))
        })
        .collect();
    assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:x?}");
}

#[test]
fn requests_that_make_no_sense_are_refused() {
    let refusal = |inputs: &[Distribution], samples| {
        let settings = Settings::new(SamplingMethod::MonteCarlo, samples, 1);
        propagate(&Linear, inputs, &settings, &mut |_, _| ControlFlow::Continue(())).unwrap_err()
    };
    assert_eq!(refusal(&[], 1000), InvalidRequest::NoInputs);
    let few = refusal(&[normal(0.0, 1.0); 2], 10);
    assert_eq!(few.to_string(), "the number of samples must be between 64 and 10000000, but is 10");
    // Eight bytes each; √(0.025 · 0.975/10⁸)/0.0584 = 0.027 %.
    let many = refusal(&[normal(0.0, 1.0); 2], 100_000_000).to_string();
    assert!(many.contains("800 MB of memory"), "{many}");
    assert!(many.ends_with("from 0.084 % to 0.027 % of its standard deviation"), "{many}");
}
