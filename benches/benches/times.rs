//! Time per operation, by criterion.

use std::error::Error;
use std::hint::black_box;
use std::ops::ControlFlow;

use analysis::{EstimatePlan, Plan};
use case::CaseFile;
use crash3::crush_energy;
use criterion::{Criterion, Throughput};
use deltav_benches::{CASE_FILE, Example, FRICTION, TANGENTIAL_CONDITIONS, centimetre, spin_out, spin_outs};
use estimate::{Evidence, Independent, ParticleSettings, sample_quietly};
use pim_core::{Contact, Tangential};
use report::{Subject, Units};
use trajectory::{State, Steer, Target, to_rest, to_rests, to_start};
use uncertainty::{Distribution, Instructions, LANES, Lanes, Model, SamplingMethod, Settings, propagate};

/// Samples of a spin-out.
const SPIN_OUTS: u32 = 256;

// Not criterion's own macros: an input that is refused ends the run with its reason.
fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    impact(&mut criterion)?;
    crush(&mut criterion)?;
    reconciliation(&mut criterion)?;
    motion(&mut criterion)?;
    case_file(&mut criterion)?;
    picture(&mut criterion)?;
    row_of_a_table(&mut criterion)?;
    sampling(&mut criterion)?;
    recorders(&mut criterion)?;
    estimate(&mut criterion)?;
    all_evidence(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}

fn impact(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let example = Example::new()?;
    let contact = example.contact;
    let mut group = criterion.benchmark_group("impact");
    for (name, tangential) in TANGENTIAL_CONDITIONS {
        let law = Example::law(tangential)?;
        contact.impact(example.motions, &law)?;
        group.bench_function(name, |b| {
            b.iter(|| black_box(&contact).impact(black_box(example.motions), black_box(&law)));
        });
    }
    let law = Example::law(Tangential::Critical)?;
    group.bench_function("critical with contact", |b| {
        b.iter(|| {
            Contact::new(black_box(example.participants), black_box(example.crush_plane))
                .map(|contact| contact.impact(black_box(example.motions), black_box(&law)))
        });
    });
    group.finish();
    Ok(())
}

fn crush(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let [(profile, stiffness), _] = Example::new()?.damage;
    criterion.bench_function("crush energy", |b| {
        b.iter(|| crush_energy(black_box(&profile), black_box(&stiffness)));
    });
    Ok(())
}

fn reconciliation(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let example = Example::new()?;
    let critical = example.problem(Tangential::Critical)?;
    let friction = example.problem(FRICTION)?;
    let mut group = criterion.benchmark_group("reconcile");
    critical.solve()?;
    group.bench_function("closed form", |b| b.iter(|| black_box(&critical).solve()));
    for (name, problem) in [("root-finder, critical", critical), ("root-finder, friction", friction)] {
        problem.root_finder()?;
        group.bench_function(name, |b| b.iter(|| black_box(&problem).root_finder()));
    }
    group.finish();
    Ok(())
}

fn motion(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let (chassis, ground, start) = spin_out()?;
    let (steer, control) = (Steer::straight(), centimetre());
    let forward = |start: &State| to_rest(&chassis, steer, &ground, start, &control, |_| {});
    let rest = forward(&start)?;
    let mut group = criterion.benchmark_group("motion");
    group.bench_function("to rest, 1 cm", |b| b.iter(|| forward(black_box(&start))));
    for (name, turns_known) in [("back from rest", true), ("back from rest, every turn", false)] {
        let target = Target { position: rest.position, heading: rest.heading, turns_known, via: None };
        let backward = |target: &Target| {
            to_start(&chassis, steer, &ground, start.position, start.heading, target, &control)
        };
        backward(&target)?;
        group.bench_function(name, |b| b.iter(|| backward(black_box(&target))));
    }
    let outsets = spin_outs(SPIN_OUTS)?;
    group.throughput(Throughput::Elements(u64::from(SPIN_OUTS)));
    group.bench_function("to rest, 1 cm, in blocks", |b| {
        b.iter(|| to_rests(black_box(&outsets), &control, |_, rest| _ = black_box(rest)));
    });
    group.finish();
    Ok(())
}

fn case_file(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let (name, text) = CASE_FILE;
    CaseFile::parse(name, text)?;
    criterion.bench_function("parse", |b| b.iter(|| CaseFile::parse(black_box(name), black_box(text))));
    Ok(())
}

/// The scene of the paper's example as SVG, with all its labels in their places.
fn picture(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let (name, text) = CASE_FILE;
    let file = CaseFile::parse(name, text)?;
    let analysis = analysis::reconstruct(&file.case).map_err(|failure| failure.to_string())?;
    let draw = || report::drawing(black_box(&file), &analysis, Units::Si, Subject::Scene);
    draw()?;
    criterion.bench_function("scene", |b| b.iter(|| draw().map(|drawing| drawing.svg())));
    Ok(())
}

/// The cost of the paper's example with ranges in each row of a table: without samples, with the run ended
/// before the first one, and with a thousand of them.
fn row_of_a_table(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let text = include_str!("../../fixtures/sae-980025-uncertain.toml");
    let case = CaseFile::parse("sae-980025-uncertain.toml", text)?.case;
    let settings = Settings::new(SamplingMethod::MonteCarlo, 1000, 1);
    let mut group = criterion.benchmark_group("a row of a table");
    let samples = || analysis::samples(black_box(&case), &settings, &mut |_, _| ControlFlow::Break(()));
    samples().map_err(|failure| failure.to_string())?.ok_or("nothing is uncertain")?;
    group.bench_function("samples alone, before the first", |b| b.iter(samples));
    let plan = Plan { settings, index_rows: None };
    let all =
        |flow: ControlFlow<()>| analysis::uncertainty(black_box(&case), &plan, &mut move |_, _, _| flow);
    all(ControlFlow::Continue(())).map_err(|failure| failure.to_string())?;
    let none = || all(ControlFlow::Break(()));
    group.bench_function("with first order and tornado, before the first", |b| b.iter(none));
    // One thread, as the others have rows of their own.
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let thousand = || one.install(|| all(ControlFlow::Continue(())));
    group.bench_function("with a thousand samples, one thread", |b| b.iter(thousand));
    group.finish();
    Ok(())
}

/// A model that costs next to nothing, so that only the sampling of its inputs and the statistics are
/// measured.
struct SumOfSquares;

impl Model for SumOfSquares {
    fn outputs(&self) -> usize {
        1
    }

    #[inline(always)]
    fn evaluate(&self, _: Instructions, inputs: &[Lanes], outputs: &mut [Lanes], _reasons: &mut [u8; LANES]) {
        for output in outputs {
            *output = Lanes::ZERO;
            for input in inputs {
                for (sum, value) in output.iter_mut().zip(input) {
                    *sum += value * value;
                }
            }
        }
    }
}

/// 31 normal inputs, as many as the paper's example has. One thread, then all.
fn sampling(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    const SAMPLES: usize = 1 << 17;
    let inputs = vec![Distribution::normal(1.0, 0.1)?; 31];
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let all = rayon::ThreadPoolBuilder::new().build()?;
    let mut group = criterion.benchmark_group("samples of 31 inputs");
    group.throughput(Throughput::Elements(SAMPLES as u64));
    for (name, method, threads) in [
        ("Monte Carlo, one thread", SamplingMethod::MonteCarlo, &one),
        ("Monte Carlo, all threads", SamplingMethod::MonteCarlo, &all),
        ("Latin hypercube, one thread", SamplingMethod::LatinHypercube, &one),
        ("Sobol', one thread", SamplingMethod::Sobol, &one),
    ] {
        let settings = Settings::new(method, SAMPLES, 1);
        let run = || {
            threads.install(|| {
                propagate(&SumOfSquares, black_box(&inputs), &settings, &mut |_, _| ControlFlow::Continue(()))
            })
        };
        run()?;
        group.bench_function(name, |b| b.iter(run));
    }
    group.finish();
    Ok(())
}

/// Each value measured once, with a tenth of the spread of the prior: next to no cost, so that only the
/// sampler itself is measured.
struct Measured {
    values: usize,
}

impl Evidence for Measured {
    fn terms_count(&self) -> usize {
        self.values
    }

    #[inline(always)]
    fn log_likelihood(&self, values: &[Lanes], terms: &mut [Lanes], _reasons: &mut [u8; LANES]) {
        for (term, value) in terms.iter_mut().zip(values) {
            for (term, value) in term.iter_mut().zip(value) {
                let z = (value - 0.5) * 10.0;
                *term = -0.5 * z * z;
            }
        }
    }
}

/// The recorders of two vehicles alone: tables before the impact and pulses.
fn recorders(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let case = CaseFile::parse("recorder.toml", include_str!("../../fixtures/recorder.toml"))?.case;
    analysis::recorders(&case).map_err(|failure| failure.to_string())?;
    criterion.bench_function("recorder/two vehicles", |b| {
        b.iter(|| analysis::recorders(black_box(&case)).is_ok());
    });
    Ok(())
}

/// 16 islands of 256 particles, 4096 draws. The throughput is that of evaluations of the likelihood.
fn estimate(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut group = criterion.benchmark_group("estimate");
    for values in [5, 20] {
        let prior = Independent(vec![Distribution::normal(0.0, 1.0)?; values]);
        let (evidence, budget) = (Measured { values }, ParticleSettings::new(256, 1));
        let run = || one.install(|| sample_quietly(black_box(&prior), &evidence, &budget));
        group.throughput(Throughput::Elements(run()?.diagnosis().evaluations as u64));
        group.sample_size(10);
        group.bench_function(format!("{values} values, one thread"), |b| b.iter(run));
    }
    group.finish();
    Ok(())
}

/// Both speeds of a case from all its evidence, 16 islands of 128 particles: without and with the motion to
/// rest of both vehicles.
fn all_evidence(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: analysis::PieceDetail::Weighed };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut group = criterion.benchmark_group("both speeds from all evidence");
    group.sample_size(10);
    for (name, text) in [
        ("directions and a recorder", include_str!("../../fixtures/estimate.toml")),
        ("rests", include_str!("../../fixtures/rear-end-rest.toml")),
    ] {
        let case = CaseFile::parse(name, text)?.case;
        let run = || {
            let mut quietly = |_, _, _| ControlFlow::Continue(());
            one.install(|| analysis::estimate(black_box(&case), &plan, &mut quietly))
        };
        run().map_err(|failure| failure.to_string())?;
        group.bench_function(name, |b| b.iter(run));
    }
    group.finish();
    Ok(())
}
