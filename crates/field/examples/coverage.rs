//! How often the 95 % intervals of ΔV contain what recorders stored, for a file of pairs:
//! `cargo run --release -p deltav-field --example coverage -- PAIRS.csv`.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::ops::ControlFlow;

use evidence::FITTED;
use field::{Options, judge, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(path) = std::env::args().nth(1) else {
        println!("give a file of pairs with the columns of CISS, such as PAIRS.csv");
        return Ok(());
    };
    let pairs = read(&std::fs::read_to_string(path)?)?;
    let options = Options { particles: 128, seed: 1, other: false };
    let field = judge(&pairs, &FITTED, &options, &mut |_, _| ControlFlow::Continue(()))?;
    for group in &field.groups {
        if let Some([_, _, [inside, error]]) = group.ours.coverage {
            println!(
                "{}: {:.1} ± {:.1} % of {} recorders",
                group.name,
                100.0 * inside,
                100.0 * error,
                group.ours.n
            );
        }
    }
    Ok(())
}
