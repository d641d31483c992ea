//! Sensitivity indices and tornado, for functions with known answers.
#![expect(clippy::unwrap_used, reason = "clippy's exemption for tests leaves out the helpers beside them")]
#![expect(
    clippy::disallowed_methods,
    reason = "the Ishigami function has a sine, and no bits of it are compared"
)]

use std::f64::consts::PI;
use std::ops::ControlFlow;
use uncertainty::{
    Distribution, FirstOrder, Function, Indices, InvalidRequest, Model, NOT_FINITE, SamplingMethod, Settings,
    SobolIndices, TORNADO_PROBABILITIES, sensitivity, tornado,
};

const METHODS: [SamplingMethod; 3] =
    [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube, SamplingMethod::Sobol];

fn run<M: Model>(model: &M, inputs: &[Distribution], settings: &Settings) -> SobolIndices {
    sensitivity(model, inputs, settings, &mut |_, _| ControlFlow::Continue(())).unwrap()
}

/// Within five stated errors, which must themselves be below a limit. Student's t with 15 degrees of freedom
/// is beyond 5 once in 6000.
fn assert_indices(found: &[Indices], exact: &[(f64, f64)], limit: f64) {
    assert_eq!(found.len(), exact.len());
    for (found, exact) in found.iter().zip(exact) {
        for (index, exact) in [(found.first_order, exact.0), (found.total, exact.1)] {
            let error = index.standard_error.unwrap();
            assert!((index.value - exact).abs() <= 5.0 * error + 1e-12, "{found:?}, exactly {exact:?}");
            assert!(error < limit, "{found:?}");
        }
    }
}

/// T. Ishigami and T. Homma (1990): sin x₁ + 7 sin² x₂ + 0.1 x₃⁴ sin x₁ on [−π, π]³. With a = 7 and b = 0.1,
/// V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = b²π⁸(1/18 − 1/50), all others 0.
#[test]
fn the_ishigami_function_has_its_indices() {
    let (a, b) = (7.0, 0.1);
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin();
        Ok(())
    });
    let inputs = [Distribution::uniform(-PI, PI).unwrap(); 3];
    let v1 = (1.0 + b * PI.powi(4) / 5.0).powi(2) / 2.0;
    let v2 = a * a / 8.0;
    let v13 = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
    let v = v1 + v2 + v13;
    let exact = [(v1 / v, (v1 + v13) / v), (v2 / v, v2 / v), (0.0, v13 / v)];
    // Saltelli and others, *Global sensitivity analysis: the primer* (2008): 0.3139, 0.4424, 0; 0.5576,
    // 0.4424, 0.2437.
    assert!((exact[0].0 - 0.3139).abs() < 5e-5 && (exact[0].1 - 0.5576).abs() < 5e-5);
    for (method, limit) in METHODS.into_iter().zip([0.02, 0.02, 0.005]) {
        let result = run(&model, &inputs, &Settings::new(method, 1 << 15, 1));
        assert_indices(result.indices()[0].as_ref().unwrap(), &exact, limit);
        assert_eq!((result.rows(), result.used(), result.evaluations()), (1 << 15, 1 << 15, 5 << 15));
    }
}

/// y = Σ cᵢxᵢ: Sᵢ = Tᵢ = (cᵢσᵢ)²/Σ(cᵢσᵢ)², which is also the first-order share. Far from zero, so that naive
/// squares would lose digits.
#[test]
fn a_linear_model_has_the_shares_of_first_order() {
    let inputs = [
        Distribution::normal(1e9, 2.0).unwrap(),
        Distribution::uniform(0.0, 12.0).unwrap(),
        Distribution::normal(0.0, 1.0).unwrap(),
    ];
    let model = Function::new(2, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] - x[1];
        y[1] = 3.0;
        Ok(())
    });
    let sds = inputs.each_ref().map(Distribution::sd);
    let first_order = FirstOrder::new(&[1.0, -1.0, 0.0], &sds).unwrap();
    // 4 and 144/12 = 12
    assert!((first_order.shares[0] - 0.25).abs() < 1e-15 && (first_order.sd - 4.0).abs() < 1e-14);
    let exact: Vec<_> = first_order.shares.iter().map(|&share| (share, share)).collect();
    for method in METHODS {
        let result = run(&model, &inputs, &Settings::new(method, 1 << 14, 7));
        assert_indices(result.indices()[0].as_ref().unwrap(), &exact, 0.02);
        assert_eq!(result.indices()[0].as_ref().unwrap()[2].total.value, 0.0);
        assert_eq!(result.indices()[1], None);
    }
}

/// The intervals must hold the exact index as often as stated: for 200 seeds and six indices at 95 %.
#[test]
fn confidence_intervals_hold_the_exact_index() {
    let inputs = [Distribution::normal(0.0, 1.0).unwrap(); 3];
    // x₀x₁ + x₂: V = 2, S = 0, 0, ½, T = ½, ½, ½
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] * x[1] + x[2];
        Ok(())
    });
    let exact = [(0.0, 0.5), (0.0, 0.5), (0.5, 0.5)];
    for method in METHODS {
        let (mut held, mut all) = (0.0, 0.0);
        for seed in 0..200 {
            let result = run(&model, &inputs, &Settings::new(method, 1 << 11, seed));
            for (indices, exact) in result.indices()[0].as_ref().unwrap().iter().zip(exact) {
                for (index, exact) in [(indices.first_order, exact.0), (indices.total, exact.1)] {
                    let [low, high] = index.interval95().unwrap();
                    all += 1.0;
                    held += if low <= exact && exact <= high { 1.0 } else { 0.0 };
                }
            }
        }
        let share = held / all;
        // 1200 that are not independent, but count as at least 200: √(0.05·0.95/200) = 1.5 %.
        assert!((0.9..0.99).contains(&share), "{method:?}: {share}");
    }
}

/// Fails for x₀ > 0.5, and is not finite for x₁ > 0.9: rows in which A, B or any mixture fails are left out.
#[test]
fn rows_with_failures_are_left_out_and_counted() {
    let inputs = [Distribution::uniform(0.0, 1.0).unwrap(); 2];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = if x[1] > 0.9 { f64::INFINITY } else { x[0] + x[1] };
        if x[0] > 0.5 { Err(5) } else { Ok(()) }
    });
    let rows = 1 << 14;
    let result = run(&model, &inputs, &Settings::new(SamplingMethod::MonteCarlo, rows, 3));
    // A row is complete if both x₀ are below 0.5 and both x₁ below 0.9.
    let expected = rows as f64 * 0.25 * 0.81;
    let deviation = (expected * (1.0 - 0.25 * 0.81)).sqrt();
    assert!((result.used() as f64 - expected).abs() < 5.0 * deviation, "{}", result.used());
    // Of four evaluations per row, half fail, and a tenth of the others are not finite.
    let (failed, infinite) = (result.failures()[&5] as f64, result.failures()[&NOT_FINITE] as f64);
    assert!((failed / result.evaluations() as f64 - 0.5).abs() < 0.02);
    assert!((infinite / result.evaluations() as f64 - 0.05).abs() < 0.01);
    // The rest is uniform on [0, 0.5] × [0, 0.9]: shares 25 and 81 of 106.
    let exact = [(25.0 / 106.0, 25.0 / 106.0), (81.0 / 106.0, 81.0 / 106.0)];
    assert_indices(result.indices()[0].as_ref().unwrap(), &exact, 0.05);

    let never = Function::new(1, |_: &[f64], _: &mut [f64]| Err(1));
    let result = run(&never, &inputs, &Settings::new(SamplingMethod::MonteCarlo, 64, 3));
    assert_eq!((result.used(), result.indices()[0].as_ref()), (0, None));
}

#[test]
fn sensitivity_ends_early_with_the_first_rows() {
    let inputs = [Distribution::uniform(0.0, 1.0).unwrap(); 2];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] + 2.0 * x[1];
        Ok(())
    });
    let mut calls = 0;
    let settings = Settings::new(SamplingMethod::Sobol, 1 << 14, 3);
    let result = sensitivity(&model, &inputs, &settings, &mut |_, total| {
        calls += 1;
        assert_eq!(total, 1 << 14);
        if calls > 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .unwrap();
    assert_eq!((result.requested(), result.rows(), result.used()), (1 << 14, 4096, 4096));
    assert_indices(result.indices()[0].as_ref().unwrap(), &[(0.2, 0.2), (0.8, 0.8)], 0.02);
}

/// Numbers of rows that leave the last block, and the last span, partly empty.
#[test]
fn odd_numbers_of_rows_are_all_used() {
    let inputs = [Distribution::uniform(0.0, 1.0).unwrap()];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0];
        Ok(())
    });
    for rows in [64, 65, 1023, 1025, 5000] {
        let result = run(&model, &inputs, &Settings::new(SamplingMethod::LatinHypercube, rows, 3));
        assert_eq!((result.rows(), result.used()), (rows, rows));
    }
}

#[cfg(feature = "parallel")]
#[test]
fn any_number_of_threads_gives_the_same_indices() {
    let inputs = [Distribution::normal(0.0, 1.0).unwrap(); 3];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] * x[1] + x[2];
        Ok(())
    });
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&model, &inputs, &Settings::new(SamplingMethod::MonteCarlo, 10_000, 6)))
            .indices()
            .to_vec()
    };
    let alone = of(1);
    assert!((2..=7).all(|threads| of(threads) == alone));
}

/// x₀² + x₁ with x₀ uniform on [0, 4] and x₁ on [−1, 1], at 25 and 75 %: 1 and 9 about 4; −½ and ½.
#[test]
fn a_tornado_moves_one_input_at_a_time() {
    let inputs = [
        Distribution::uniform(-1.0, 1.0).unwrap(),
        Distribution::uniform(0.0, 4.0).unwrap(),
        Distribution::uniform(0.0, 8.0).unwrap(),
    ];
    let model = Function::new(2, |x: &[f64], y: &mut [f64]| {
        y[0] = x[0] + x[1] * x[1];
        y[1] = x[0];
        if x[2] > 5.0 { Err(9) } else { Ok(()) }
    });
    let result = tornado(&model, &inputs, &[0.0, 2.0, 4.0], [0.25, 0.75]).unwrap();
    assert_eq!(result.central, Ok(vec![4.0, 0.0]));
    let outputs: Vec<_> =
        result.bars.iter().map(|bar| (bar.low.outputs.clone(), bar.high.outputs.clone())).collect();
    assert_eq!(outputs[0], (Ok(vec![3.5, -0.5]), Ok(vec![4.5, 0.5])));
    assert_eq!(outputs[1], (Ok(vec![1.0, 0.0]), Ok(vec![9.0, 0.0])));
    assert_eq!(outputs[2], (Ok(vec![4.0, 0.0]), Err(9)));
    assert_eq!((result.bars[1].low.input, result.bars[1].high.input), (1.0, 3.0));
    assert_eq!(
        (result.bars[1].swing(0), result.bars[2].swing(0), result.bars[0].swing(2)),
        (Some(8.0), None, None)
    );
    let order = |output| result.ranked(output).iter().map(|bar| bar.input).collect::<Vec<_>>();
    assert_eq!((order(0), order(1)), (vec![2, 1, 0], vec![2, 0, 1]));
}

#[test]
fn a_tornado_of_many_inputs_fills_more_than_one_block() {
    let inputs = vec![Distribution::uniform(-1.0, 1.0).unwrap(); 100];
    let model = Function::new(1, |x: &[f64], y: &mut [f64]| {
        y[0] = x.iter().zip(1..).map(|(x, weight)| x * f64::from(weight)).sum();
        Ok(())
    });
    let result = tornado(&model, &inputs, &[0.0; 100], TORNADO_PROBABILITIES).unwrap();
    for (bar, weight) in result.bars.iter().zip(1..) {
        assert!((bar.swing(0).unwrap() - 1.9 * f64::from(weight)).abs() < 1e-12);
    }
    assert_eq!(result.ranked(0)[0].input, 99);
}

#[test]
fn requests_that_make_no_sense_are_refused() {
    let inputs = [Distribution::uniform(0.0, 1.0).unwrap(); 2];
    let model = Function::new(1, |_: &[f64], _: &mut [f64]| Ok(()));
    let refusal = |inputs: &[Distribution], central: &[f64], shares| {
        tornado(&model, inputs, central, shares).unwrap_err()
    };
    assert_eq!(refusal(&[], &[], [0.1, 0.9]), InvalidRequest::NoInputs);
    let length = InvalidRequest::Length { what: "central value", expected: 2, given: 1 };
    assert_eq!(refusal(&inputs, &[0.0], [0.1, 0.9]), length);
    for (low, high) in [(0.0, 0.9), (0.9, 0.1), (0.1, 1.0)] {
        assert_eq!(refusal(&inputs, &[0.0; 2], [low, high]), InvalidRequest::Probabilities { low, high });
    }
    let many = vec![inputs[0]; 129];
    let settings = Settings::new(SamplingMethod::Sobol, 64, 1);
    let refused = sensitivity(&model, &many, &settings, &mut |_, _| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(refused, InvalidRequest::TooManyInputs { inputs: 258, limit: 256 });
    let settings = Settings::new(SamplingMethod::Sobol, 63, 1);
    let refused = sensitivity(&model, &inputs, &settings, &mut |_, _| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(refused.to_string(), "the number of rows must be between 64 and 10000000, but is 63");
}
