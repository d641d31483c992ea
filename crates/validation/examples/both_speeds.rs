//! How often the 95 % interval of a speed holds the true one: both speeds of each staged collision from its
//! crush and its motion after the impact.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use validation::{AfterImpact, Data, judge_speeds};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    for (after_impact, evidence) in [
        (AfterImpact::Velocities, "Crush and velocities after the impact"),
        (AfterImpact::VelocitiesAndYawRates, "Crush, velocities and yaw rates after the impact"),
    ] {
        let judgement = judge_speeds(&Data::built_in(), after_impact, 512, 1)?;
        println!("{evidence}");
        println!("test  true speed  median  95 % interval   half width  yaw rate's sd");
        println!("             m/s     m/s            m/s  of the true          rad/s");
        for test in &judgement.tests {
            let sd = test.yaw_rate_sd.map_or_else(|| "–".to_owned(), |sd| format!("{sd:.1}"));
            for speed in &test.speeds {
                let [low, high] = speed.interval;
                println!(
                    "{:2}.{}  {:10.2}  {:6.2}  {low:5.2} to {high:5.2}  {:9.1} %  {sd:>13}  {} {}",
                    test.test,
                    speed.vehicle.number(),
                    speed.true_speed,
                    speed.median,
                    100.0 * speed.half_width(),
                    if speed.is_inside() { "inside" } else { "outside" },
                    if test.converged { "" } else { "not converged" },
                );
            }
        }
        let [mean, largest] = judgement.half_widths();
        println!(
            "{} of {} intervals contain the true speed. Half width: mean {:.1} %, largest {:.1} %.\n",
            judgement.inside(),
            judgement.speeds().count(),
            100.0 * mean,
            100.0 * largest
        );
    }
    Ok(())
}
