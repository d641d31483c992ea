//! How often the 95 % intervals of ΔV contain what recorders stored, for a file of pairs:
//! `cargo run --release -p deltav-field --example coverage -- PAIRS.csv`. A further argument, `own` or
//! `other`, uses one crush alone: that of the vehicle that is judged, or that of the other. With `categories`
//! behind it, the stiffnesses are those of CRASH3's categories.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::ops::ControlFlow;

use evidence::FITTED;
use field::{KnownCrush, Options, PairByCategory, judge, judge_by, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(path) = std::env::args().nth(1) else {
        println!("give a file of pairs with the columns of CISS, such as PAIRS.csv");
        return Ok(());
    };
    let pairs = read(&std::fs::read_to_string(path)?)?;
    let crush = match std::env::args().nth(2).as_deref() {
        None => KnownCrush::Both,
        Some("own") => KnownCrush::Judged,
        Some("other") => KnownCrush::Other,
        Some("both") => KnownCrush::Both,
        Some(_) => return Err("behind the file stands `both`, `own`, `other` or nothing".into()),
    };
    let options = Options { particles: 128, seed: 1, other: false, crush, injury: None };
    let (all, mut progress) = (pairs, |_, _| ControlFlow::Continue(()));
    let field = if std::env::args().nth(3).as_deref() == Some("categories") {
        let pairs: Vec<PairByCategory> = all.into_iter().map(PairByCategory::new).collect();
        judge_by(&pairs, &PairByCategory::fitted, &options, &mut progress)?
    } else {
        judge(&all, &FITTED, &options, &mut progress)?
    };
    for group in &field.groups {
        print!("{:<12}{:>4} recorders, inside their interval of 50, 80 and 95 %:", group.name, group.ours.n);
        for [inside, error] in group.ours.coverage.iter().flatten() {
            print!(" {:.1} ± {:.1} %", 100.0 * inside, 100.0 * error);
        }
        println!("; rms of ln {:.3}, bias {:+.3}", group.ours.rms[0], group.ours.bias[0]);
    }
    Ok(())
}
