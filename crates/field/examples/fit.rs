//! The misfits of the model, fitted on a file of pairs, with their standard errors: `cargo run --release -p
//! deltav-field --example fit -- PAIRS.csv`. With `--categories` the stiffnesses are those of CRASH3's
//! categories, and each kind of pair has figures of its own. With `--folds 5` the figures fitted without each
//! fifth are printed next to them, and each crash is then judged with those that were fitted without it: five
//! minutes for 300 pairs on two cores.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example prints")]

use std::ops::ControlFlow;

use evidence::{DamagedSide, FITTED, Fitted, ObjectFigures};
use field::{
    Crash, Field, FieldError, FigureFit, FitOptions, Folds, KnownCrush, Options, Pair, PairByCategory,
    PairKind, fit, fit_direction, fit_folds, fit_share, judge_by, read, read_objects, usual_category,
};

/// Particles of each island: of the draws behind the fit, and of those behind each judgement.
const PARTICLES: [usize; 2] = [256, 128];
const SEED: u64 = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (path, rest) = arguments.split_first().ok_or("give a file of pairs with the columns of CISS")?;
    let has_categories = rest.iter().any(|option| option == "--categories");
    let rest: Vec<&str> =
        rest.iter().map(String::as_str).filter(|option| *option != "--categories").collect();
    let folds = match rest[..] {
        [] => None,
        ["--folds", folds] => Some(folds.parse()?),
        _ => return Err("after the file stand --folds 5, --categories, both or nothing".into()),
    };
    let text = std::fs::read_to_string(path)?;
    if let Some(mut crashes) = read_objects(&text)? {
        for crash in &mut crashes {
            crash.vehicle.category = has_categories.then(|| usual_category(crash.vehicle.curb_mass));
        }
        let base = if has_categories { FITTED.by_category(&[DamagedSide::Front]) } else { FITTED };
        let (fit, folds) = fitted(&crashes, &base, folds)?;
        let ObjectFigures { severity, misfit, covariance } = fit.fitted.objects;
        println!("\n{severity:.3?}\n{misfit:.3?}\ncovariance: {covariance:.5?}");
        return held_out(&crashes, &fit, folds.as_ref(), &[false]);
    }
    let pairs = read(&text)?;
    if has_categories {
        return by_categories(pairs, folds);
    }
    let (fit, folds) = fitted(&pairs, &FITTED, folds)?;
    let Fitted { crush_bias, crush_ln_sd, slope, slope_ln_sd, no_damage_speed, recorder_ln_scale, .. } =
        fit.fitted;
    println!("\ncrush_bias: {crush_bias:.3},\ncrush_ln_sd: {crush_ln_sd:.3?},");
    println!("slope: {slope:.1?},\nslope_ln_sd: {slope_ln_sd:.2},");
    println!("no_damage_speed: {no_damage_speed:.2?},\nrecorder_ln_scale: {recorder_ln_scale:.3},");
    println!("covariance: [");
    for row in fit.fitted.errors.covariance {
        println!("    {row:.5?},");
    }
    println!("],");
    print_share(&pairs, &fit.fitted)?;
    let direction = fit_direction(&pairs, &fit.fitted)?;
    let [scale, error] = direction.scale.map(f64::to_degrees);
    println!("\ndirections of {} recorders: scale {scale:.2}° ± {error:.2}°", direction.recorders);
    held_out(&pairs, &fit, folds.as_ref(), &[false, true])
}

fn print_share(pairs: &[Pair], fitted: &Fitted) -> Result<(), FieldError> {
    let share = fit_share(pairs, fitted)?;
    let ([side, side_error], [ln_sd, error]) = (share.side_crush, share.ln_sd);
    println!("\nshares of the crush energy in {} pairs", share.pairs);
    println!("side_crush: {side:.3}, standard error of its logarithm {side_error:.3},");
    println!("other_crush_ln_sd: {ln_sd:.3} ± {error:.3},");
    Ok(())
}

/// The misfit of energies by CRASH3's categories, for each kind of pair alone.
fn by_categories(pairs: Vec<Pair>, folds: Option<usize>) -> Result<(), Box<dyn std::error::Error>> {
    let pairs: Vec<PairByCategory> = pairs.into_iter().map(PairByCategory::new).collect();
    for (kind, place) in [(PairKind::FrontFront, 1), (PairKind::FrontRear, 2), (PairKind::FrontSide, 3)] {
        let of_kind: Vec<PairByCategory> = pairs.iter().filter(|pair| pair.kind() == kind).cloned().collect();
        println!("\n{}", kind.name());
        let base = of_kind.first().map_or(FITTED, PairByCategory::fitted);
        let (fit, folds) = fitted(&of_kind, &base, folds)?;
        let Fitted { crush_bias: bias, crush_ln_sd, errors, .. } = fit.fitted;
        let all = errors.covariance;
        let covariance = [[all[0][0], all[0][place]], [all[place][0], all[place][place]]];
        println!("\nbias: {bias:.3}, ln_sd: {:.3}, covariance: {covariance:.5?}", crush_ln_sd[place - 1]);
        let plain: Vec<Pair> = of_kind.iter().map(|pair| pair.pair().clone()).collect();
        print_share(&plain, &fit.fitted)?;
        held_out(&of_kind, &fit, folds.as_ref(), &[false, true])?;
    }
    Ok(())
}

fn progress(done: usize, all: usize) -> ControlFlow<()> {
    if done.is_multiple_of(100) {
        eprintln!("{done} of {all}");
    }
    ControlFlow::Continue(())
}

/// The fit of all crashes, printed, and those without each fold.
fn fitted<C: Crash>(
    crashes: &[C],
    base: &Fitted,
    folds: Option<usize>,
) -> Result<(FigureFit, Option<Folds>), FieldError> {
    let options = FitOptions { particles: PARTICLES[0], seed: SEED };
    let (fit, folds) = match folds {
        None => (fit(crashes, base, &options, &mut progress)?, None),
        Some(folds) => {
            let (fit, folds) = fit_folds(crashes, base, folds, &options, &mut progress)?;
            (fit, Some(folds))
        }
    };
    println!("{} recorders in {} crashes, ln p {:.2}", fit.recorders, fit.pairs, fit.log_likelihood);
    println!("Draws of a crash are worth {:.0} independent ones or more.\n", fit.least_draws);
    println!("figure, standard error clustered by crash, by the second derivatives alone, without each fold");
    for ((figure, error), of_model) in fit.figures.iter().zip(&fit.errors).zip(&fit.errors_of_model) {
        print!("{:<56}{:>7.3} ± {error:.3} {of_model:.3}", figure.name(), figure.of(&fit.fitted));
        for fitted in folds.iter().flat_map(|folds| folds.fitted()) {
            print!("{:>8.3}", figure.of(fitted));
        }
        println!();
    }
    Ok((fit, folds))
}

/// Judges each crash with the figures that were fitted without it.
fn held_out<C: Crash>(
    crashes: &[C],
    fit: &FigureFit,
    folds: Option<&Folds>,
    others: &[bool],
) -> Result<(), Box<dyn std::error::Error>> {
    let Some(folds) = folds else { return Ok(()) };
    for other in others {
        let options = Options {
            particles: PARTICLES[1],
            seed: SEED,
            other: *other,
            crush: KnownCrush::Both,
            injury: None,
        };
        let of = |crash: &_| folds.of(crash).unwrap_or(fit.fitted);
        print(&judge_by(crashes, &of, &options, &mut progress)?);
    }
    Ok(())
}

fn print(field: &Field) {
    let given = if field.other { "the other vehicle's recorder given" } else { "no recorder given" };
    println!("\nheld out, {given}");
    println!(
        "               vehicles          50 %          80 %          95 %    bias             rms  CRPS, km/h"
    );
    for group in &field.groups {
        print!("{:<14}{:>9}", group.name, group.ours.n);
        for [inside, error] in group.ours.coverage.iter().flatten() {
            print!("{:>7.1} ± {:>4.1}", 100.0 * inside, 100.0 * error);
        }
        let ([bias, _], [rms, error]) = (group.ours.bias, group.ours.rms);
        print!("{bias:>+8.3}{rms:>8.3} ± {error:.3}{:>12.2}", 3.6 * group.ours.crps);
        match &group.winsmash {
            Some(theirs) => {
                println!("   WinSMASH {}{:>+8.3}{:>8.3}", theirs.n, theirs.bias[0], theirs.rms[0]);
            }
            None => println!(),
        }
    }
}
