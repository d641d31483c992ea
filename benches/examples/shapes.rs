//! The cost of a sample in every fixture that has an impact, with a normal range on each of its numbers.
//!
//! `cargo run --release -p deltav-benches --example shapes` draws the samples of all fixtures in turn, on one
//! thread, five times, and prints the cost of a sample and input next to that of the paper's example. With
//! the name of a fixture and a number of samples it draws these once, for a profiler or an instruction
//! counter: the difference between runs with two numbers of samples is the cost of the samples.

use std::error::Error;
use std::fs;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use analysis::{Plan, Samples};
use case::{Amount, Bounds, Case, CaseFile, Range, Spread};
use uncertainty::{SamplingMethod, Settings};

/// Runs of two lengths: their difference does not contain the cost before the first sample.
const SAMPLES: [usize; 2] = [20_000, 120_000];

const ROUNDS: usize = 5;

const EXAMPLE: &str = "sae-980025";

/// (–, unit of the file) the standard deviation of a number, as a share of it, and what is added to that.
const SHARE: f64 = 1e-3;
const LEAST: f64 = 1e-6;

type Failure = Box<dyn Error + Send + Sync>;

struct Fixture {
    name: String,
    case: Case,
    inputs: usize,
    /// (s) the cost of a sample and input, in each round.
    costs: Vec<f64>,
}

impl Fixture {
    /// `None` where the case has no impact, or no answer, or where each sample is searched back from a rest,
    /// which takes a thousand times as long.
    fn read(name: String, text: &str) -> Option<Self> {
        let mut case = CaseFile::parse(&name, text).ok()?.case;
        case.ranges = case
            .inputs()
            .into_iter()
            .map(|number| {
                let sd = Amount { number: SHARE * number.number.abs() + LEAST, unit: number.unit };
                Range { path: number.path, spread: Spread::Normal { sd }, bounds: Bounds::None }
            })
            .collect();
        if case.impact.is_none() || analysis::is_searched_back(&case) {
            return None;
        }
        let plan = Plan { settings: settings(100), index_rows: None };
        let inputs =
            analysis::uncertainty(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).ok()?.inputs.len();
        Some(Self { name, case, inputs, costs: Vec::new() })
    }

    fn draw(&self, samples: usize) -> Result<Option<Samples>, Failure> {
        Ok(analysis::samples(&self.case, &settings(samples), &mut |_, _| ControlFlow::Continue(()))?)
    }

    fn time(&mut self) -> Result<(), Failure> {
        let mut times = [0.0; 2];
        for (time, samples) in times.iter_mut().zip(SAMPLES) {
            let start = Instant::now();
            self.draw(samples)?;
            *time = start.elapsed().as_secs_f64();
        }
        self.costs.push((times[1] - times[0]) / (SAMPLES[1] - SAMPLES[0]) as f64 / self.inputs as f64);
        Ok(())
    }

    /// (s) the median.
    fn cost(&self) -> f64 {
        let mut costs = self.costs.clone();
        costs.sort_by(f64::total_cmp);
        costs.get(costs.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

fn settings(samples: usize) -> Settings {
    // As for a row of a table.
    Settings::new(SamplingMethod::MonteCarlo, samples, 1)
}

fn fixtures() -> Result<Vec<Fixture>, Failure> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures");
    let mut found = Vec::new();
    for part in ["", "laws/", "roots/"] {
        for entry in fs::read_dir(folder.join(part))? {
            let path = entry?.path();
            let Some(name) = path.file_name().and_then(|name| name.to_str()?.strip_suffix(".toml")) else {
                continue;
            };
            found.extend(Fixture::read(format!("{part}{name}"), &fs::read_to_string(&path)?));
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

fn run() -> Result<(), Failure> {
    let mut fixtures = fixtures()?;
    let mut arguments = std::env::args().skip(1);
    if let (Some(name), Some(samples)) = (arguments.next(), arguments.next()) {
        let samples = samples.parse()?;
        let fixture = fixtures.iter().find(|fixture| fixture.name == name).ok_or("no such fixture")?;
        fixture.draw(samples)?;
        return Ok(());
    }
    for _ in 0..ROUNDS {
        for fixture in &mut fixtures {
            fixture.time()?;
        }
    }
    let example = fixtures.iter().find(|fixture| fixture.name == EXAMPLE).map_or(f64::NAN, Fixture::cost);
    fixtures.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    let mut out = std::io::stdout().lock();
    writeln!(out, "fixture                        inputs   ns a sample   ns and input   beside the example")?;
    for fixture in &fixtures {
        let cost = fixture.cost();
        let sample = cost * fixture.inputs as f64;
        writeln!(
            out,
            "{:30} {:6} {:13.0} {:14.2} {:20.2}",
            fixture.name,
            fixture.inputs,
            sample * 1e9,
            cost * 1e9,
            cost / example
        )?;
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build()?.install(run)
}
