#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests fail by panicking; the slow one prints what it finds"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "expected values by other functions than the crate's; no bits are compared"
)]

use std::ops::ControlFlow;

use estimate::{Evidence, ParticleSettings, sample_quietly};
use evidence::{CollisionModel, DrawnOutput, FITTED, FigureErrors, Fitted, Impacts, Piece, shown_delta_v};
use pim_core::VehicleId;
use uncertainty::random::{bits, key, unit};
use uncertainty::{LANES, Lanes, Sampler, SamplingMethod};

use super::{Drawn, FitOptions, Likelihood, fit, point, step};
use crate::figure::{Figure, Guess};
use crate::pair::{Pair, PairVehicle, Plane};

/// Made-up damage of two cars, with what their recorders stored (m/s).
fn pair(case: &str, planes: [Plane; 2], depth: f64, recorders: [Option<f64>; 2]) -> Pair {
    // (°) heading, and PDOF, which are opposite forces.
    let angles = match planes {
        [Plane::Front, Plane::Rear] => [[0.0, 0.0], [0.0, 180.0]],
        [Plane::Front, Plane::Left] => [[0.0, 20.0], [270.0, 290.0]],
        _ => [[0.0, 10.0], [190.0, 0.0]],
    };
    let vehicle = |i: usize| PairVehicle {
        number: None,
        curb_mass: [1400.0, 1700.0][i],
        cargo: None,
        length: None,
        width: None,
        plane: planes[i],
        pdof: f64::to_radians(angles[i][1]),
        heading: Some(f64::to_radians(angles[i][0])),
        field_length: Some(1.3),
        direct_length: Some(1.1),
        direct_offset: Some([0.1, -0.2][i]),
        depths: [0.8, 1.0, 1.2, 1.2, 1.0, 0.8].map(|factor| factor * depth),
        winsmash: [None; 2],
        recorder: [recorders[i], Some(0.0)],
        is_record_doubted: false,
        category: None,
    };
    Pair { case: case.to_owned(), vehicles: [vehicle(0), vehicle(1)] }
}

fn figures(bias: f64, slope_ln_sd: f64, recorder_ln_scale: f64) -> Fitted {
    Fitted { crush_bias: bias, slope_ln_sd, recorder_ln_scale, errors: FigureErrors::NONE, ..FITTED }
}

/// ln p(recorders | all else) from draws of the prior, each with all of its terms.
fn by_the_prior(pair: &Pair, fitted: &Fitted) -> f64 {
    let model = CollisionModel::new(&pair.collision(fitted, &VehicleId::ALL).unwrap());
    let inputs = &model.leads().unknown().0;
    let samples = 1 << 18;
    let sampler =
        Sampler::new(inputs, &uncertainty::Settings::new(SamplingMethod::Sobol, samples, 1)).unwrap();
    let mut values = vec![Lanes::ZERO; inputs.len()];
    let mut sums = [0.0; 2];
    for block in 0..(samples / LANES) as u64 {
        sampler.fill(block, &mut values);
        let mut terms = vec![Lanes::ZERO; model.terms_count()];
        model.log_likelihood(&values, &mut terms, &mut [0; LANES]);
        for lane in 0..LANES {
            let sum = |is_wanted: fn(Piece) -> bool| {
                let terms = terms.iter().zip(model.pieces()).filter(|(_, piece)| is_wanted(**piece));
                terms.map(|(term, _)| term[lane]).sum::<f64>().exp()
            };
            // The fit only uses the sizes.
            sums[0] += sum(|piece| !matches!(piece, Piece::RecordedDirection(_)));
            sums[1] += sum(|piece| !matches!(piece, Piece::RecordedDeltaV(_) | Piece::RecordedDirection(_)));
        }
    }
    (sums[0] / sums[1]).ln()
}

#[test]
fn the_likelihood_is_that_of_the_recorders_given_all_else() {
    let drawn_by = figures(-0.2, 0.3, 0.13);
    let options = FitOptions { particles: 1024, seed: 1 };
    for (planes, recorders) in
        [([Plane::Front, Plane::Left], [6.0, 5.0]), ([Plane::Front, Plane::Rear], [4.0, 5.0])]
    {
        let pair = pair("1", planes, 0.25, recorders.map(Some));
        let drawn = Drawn::new(&pair, &drawn_by, &options).unwrap();
        for fitted in [drawn_by, figures(-0.5, 0.15, 0.2)] {
            let ours = drawn.log_likelihood(&fitted).unwrap().0;
            let exact = by_the_prior(&pair, &fitted);
            assert!((ours - exact).abs() < 0.06, "{planes:?} {ours} {exact}");
        }
    }
}

/// The derivatives at a point, compared with those over three times the step.
#[test]
fn the_expansion_has_the_derivatives() {
    let pairs = [pair("1", [Plane::Front, Plane::Left], 0.25, [Some(6.0), Some(5.0)])];
    let options = FitOptions { particles: 128, seed: 1 };
    let likelihood =
        Likelihood::new(&pairs, &FITTED, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    let at = point(&Figure::ALL, &FITTED);
    let expansion = likelihood.expansion(&at, &|_| true);
    let value = |point| likelihood.at(&[point], &|_| true)[0];
    let n = Figure::ALL.len();
    for k in 0..n {
        for l in 0..n {
            let (a, b) = (step(n, k) * 3.0, step(n, l) * 3.0);
            let second = (value(&at + &a + &b) - value(&at + &a - &b) - value(&at - &a + &b)
                + value(&at - &a - &b))
                / 0.0036;
            assert!((expansion.curvature[(k, l)] + second).abs() < 0.03 * (1.0 + second.abs()), "{k} {l}");
        }
        let slope = (value(&at + step(n, k) * 3.0) - value(&at - step(n, k) * 3.0)) / 0.06;
        assert!((expansion.gradient[k] - slope).abs() < 0.02 * (1.0 + slope.abs()), "{k}");
    }
}

/// A single pair is weak evidence: the figures stay near their guesses, nearly as uncertain. For kinds of
/// vehicle that it lacks, it is not evidence at all.
#[test]
fn a_single_pair_hardly_changes_the_guesses() {
    let pairs = [pair("1", [Plane::Front, Plane::Left], 0.25, [Some(6.0), Some(5.0)])];
    let options = FitOptions { particles: 128, seed: 1 };
    let fit = fit(&pairs, &FITTED, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert_eq!((fit.pairs, fit.recorders), (1, 2));
    for (figure, error) in Figure::ALL.into_iter().zip(fit.errors_of_model.iter().copied()) {
        let value = figure.of(&fit.fitted);
        let (moved, error, sd) = match figure.guess() {
            Guess::Normal { mean, sd } => (value - mean, error, sd),
            Guess::LogNormal { median, ln_sd } => ((value / median).ln(), error / value, ln_sd),
        };
        assert!(moved.abs() < sd && error < 1.02 * sd && error > 0.5 * sd, "{figure:?} {moved} {error}");
        if matches!(figure, Figure::SlopeOfRears | Figure::SpreadOfRears | Figure::SpreadOfFronts) {
            assert!(moved.abs() < 1e-3 && (error - sd).abs() < 1e-3);
        }
    }
}

/// Independent standard normal numbers (Box–Muller).
fn normals(stream: u64, index: u64) -> [f64; 4] {
    let u = |k: u64| unit(bits(key(stream, &[index]), k));
    let two = |k| {
        let (radius, turn) = ((-2.0 * u(k).ln()).sqrt(), std::f64::consts::TAU * u(k + 1));
        [radius * turn.cos(), radius * turn.sin()]
    };
    let ([a, b], [c, d]) = (two(0), two(2));
    [a, b, c, d]
}

/// Crashes whose recorders are drawn from the model: a draw of the collision given all other evidence, and an
/// error with Student's t.
fn simulated(truth: &Fitted, count: u64) -> Vec<Pair> {
    let made = |number: u64| {
        let other = [Plane::Left, Plane::Rear, Plane::Front, Plane::Left][(number % 4) as usize];
        let [a, ..] = normals(1, number);
        let depth = 0.2 * (0.5 * a).exp();
        let pair_of = |recorders| pair(&number.to_string(), [Plane::Front, other], depth, recorders);
        let model = CollisionModel::new(&pair_of([None; 2]).collision(truth, &[]).unwrap());
        let posterior = sample_quietly(&model, &model, &ParticleSettings::new(128, number + 1)).unwrap();
        let draw = usize::try_from(bits(2, number) % posterior.count() as u64).unwrap();
        let recorders = VehicleId::ALL.map(|id| {
            let column = |output: DrawnOutput| posterior.outputs()[output.column()][draw];
            let (whole, along) =
                (column(DrawnOutput::DeltaV(id)), column(DrawnOutput::LongitudinalDeltaV(id)));
            let [z, a, b, c] = normals(3 + id.index() as u64, number);
            // t₃ = z/√(χ²₃/3)
            let t = z / ((a * a + b * b + c * c) / 3.0).sqrt();
            Some(shown_delta_v(whole, along, false) * (truth.recorder_ln_scale * t).exp())
        });
        pair_of(recorders)
    };
    (0..count).map(made).collect()
}

/// `cargo test --release -p deltav-field simulated -- --ignored --nocapture`, some minutes.
#[test]
#[ignore = "takes some minutes"]
fn simulated_crashes_give_the_figures_that_they_were_drawn_with() {
    let mut truth = FITTED;
    truth.errors = FigureErrors::NONE;
    truth.crush_bias = 0.3;
    truth.crush_ln_sd = [0.2, 0.45, 0.3];
    truth.slope = [27.7, 35.0, 22.0];
    truth.slope_ln_sd = 0.25;
    truth.no_damage_speed = [3.0, 3.0, 2.0];
    truth.recorder_ln_scale = 0.08;
    let pairs = simulated(&truth, 300);
    let options = FitOptions { particles: 128, seed: 7 };
    let fit = fit(&pairs, &FITTED, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    let mut squares = 0.0;
    for (figure, error) in Figure::ALL.into_iter().zip(fit.errors.iter().copied()) {
        let (ours, exact) = (figure.of(&fit.fitted), figure.of(&truth));
        println!("{:<56} {exact:>6.3} {ours:>7.3} ± {error:.3}", figure.name());
        assert!((ours - exact).abs() < 3.0 * error, "{figure:?}");
        squares += ((ours - exact) / error).powi(2);
    }
    // χ² of 10: 99.9 % are below 29.6.
    assert!(squares < 29.6, "{squares}");
}

/// Two pairs alike: as two crashes their gradients add as squares, and as one crash as numbers.
#[test]
fn the_errors_count_crashes() {
    let of = |case| pair(case, [Plane::Front, Plane::Left], 0.25, [Some(6.0), Some(5.0)]);
    let options = FitOptions { particles: 128, seed: 1 };
    let spread = |pairs: &[Pair]| {
        let likelihood =
            Likelihood::new(pairs, &FITTED, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
        likelihood.spread_of_gradients(&point(&Figure::ALL, &FITTED), &|_| true)
    };
    let one = spread(&[of("1")]);
    assert!(one[(0, 0)] > 1e-4, "{one}");
    assert!((spread(&[of("1"), of("2")]) - &one * 2.0).abs().max() < 1e-9);
    assert!((spread(&[of("1"), of("1")]) - &one * 4.0).abs().max() < 1e-9);
}
