//! The number of independent draws to which those of an estimate are equivalent, by runs with different
//! seeds.
//!
//! `cargo run --release -p deltav-benches --example worth -- CASE.toml [SEEDS]`. A mean of n independent
//! draws varies between seeds with σ²/n, so that σ² over the variance of the means is the equivalent number
//! for one run, with a relative error of √(2/(SEEDS − 1)). A single run can estimate it only from its
//! islands, and reports the least that they show for any number.

use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;
use std::time::Instant;

use analysis::{EstimatePlan, EstimateStage, Failure};
use case::CaseFile;

const SEEDS: u64 = 48;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("give a case file with evidence, such as fixtures/estimate.toml")?;
    let seeds = arguments.next().map_or(Ok(SEEDS), |seeds| seeds.parse())?.max(2);
    let case = CaseFile::parse(&path, &std::fs::read_to_string(&path)?)?.case;
    let mut quietly = |_: EstimateStage, _: usize, _: usize| ControlFlow::Continue(());
    let mut run = |seed: u64| {
        let started = Instant::now();
        let plan = EstimatePlan {
            particles: EstimatePlan::PARTICLES,
            seed,
            prior: None,
            pieces: analysis::PieceDetail::Weighed,
        };
        let estimated = analysis::estimate(&case, &plan, &mut quietly)?;
        Ok::<_, Failure>((estimated, started.elapsed().as_secs_f64()))
    };
    let runs = (1..=seeds).map(&mut run).collect::<Result<Vec<_>, _>>()?;

    let mut out = std::io::stdout().lock();
    let mut times: Vec<f64> = runs.iter().map(|(_, time)| *time).collect();
    times.sort_by(f64::total_cmp);
    writeln!(out, "{seeds} seeds, {:.2} s each (median)", times[times.len() / 2])?;
    let said = || runs.iter().map(|(estimated, _)| estimated.ess());
    let (least, most) = (said().fold(f64::INFINITY, f64::min), said().fold(0.0, f64::max));
    writeln!(out, "a run says of itself: at least {least:.0} to {most:.0}")?;
    let error = (2.0 / (seeds - 1) as f64).sqrt();
    let mut all = Vec::new();
    for (place, found) in runs[0].0.outputs.iter().enumerate() {
        let summaries = || runs.iter().map(|(estimated, _)| estimated.outputs[place].posterior);
        let count = seeds as f64;
        let mean = summaries().map(|summary| summary.mean.value).sum::<f64>() / count;
        let deviations = summaries().map(|summary| summary.mean.value - mean);
        let square = deviations.map(|deviation| deviation * deviation).sum::<f64>();
        let variance = summaries().map(|summary| summary.sd.value * summary.sd.value).sum::<f64>() / count;
        // n = σ²/Var(mean)
        let worth = variance / (square / (count - 1.0));
        all.push(worth);
        writeln!(out, "{:<32}{worth:>9.0} ± {:.0}", found.output.path(), worth * error)?;
    }
    all.sort_by(f64::total_cmp);
    writeln!(out, "median of these numbers: {:.0}", all[all.len() / 2])?;
    Ok(())
}
