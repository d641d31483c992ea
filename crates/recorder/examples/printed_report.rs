//! A table copied out of a printed report: how fast was the vehicle at the impact, and how far away before?

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use recorder::{ImpactSpeed, ImpactSpeedErrors, PreCrash, SpeedLimits, read_tables};

const COPIED: &str = "\
Time (sec) -4.6 -3.6 -2.6 -1.6 -0.6 0 (TRG)
Vehicle Speed (MPH [km/h]) 36 [58] 35 [56] 35 [56] 32 [52] 22 [36] 17 [28]
Brake Switch OFF OFF OFF ON ON ON
";

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let tables = read_tables(COPIED)?;
    let Some(table) = tables.first() else { return Ok(()) };
    for column in &table.columns {
        println!("\"{}\" is the {}, in {}", column.heading, column.channel.name(), column.unit.name);
    }
    let record = PreCrash::from_table(table)?;
    for (time, distance) in record.distances_to_last(&SpeedLimits::default()) {
        println!(
            "{time:5.1} s: {:5.1} m, at least {:5.1}, at most {:5.1}",
            distance.between, distance.at_least, distance.at_most
        );
    }
    let speed = ImpactSpeed::of(&record, &ImpactSpeedErrors::default())?;
    let [low, high] = speed.interval(0.95);
    println!("at the impact {:.0} km/h, 95 %: {:.0} to {:.0}", speed.mean * 3.6, low * 3.6, high * 3.6);
    for part in &speed.parts {
        println!("  {}: {:.0} %", part.source.name(), 100.0 * part.variance / (speed.sd * speed.sd));
    }
    assert!(low * 3.6 > 22.0 && high * 3.6 < 36.0);
    Ok(())
}
