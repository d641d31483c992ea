//! How often the 95 % interval of a speed holds the true one: both speeds of each staged collision from its
//! crush and its motion after the impact.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use validation::{AfterImpact, Data, judge_speeds};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    for after_impact in [AfterImpact::Velocities, AfterImpact::VelocitiesAndYawRates] {
        let judgement = judge_speeds(&Data::built_in(), after_impact, 512, 1)?;
        println!(
            "{after_impact:?}: vehicle, true speed, median and 95 % interval (m/s), half width, yaw rates' spread"
        );
        for test in &judgement.tests {
            for speed in &test.speeds {
                let [low, high] = speed.interval;
                println!(
                    "{:2}.{}  {:5.2}  {:5.2}  {low:5.2} to {high:5.2}  {:4.1} %  {:.1} rad/s  {} {}",
                    test.test,
                    speed.vehicle.number(),
                    speed.true_speed,
                    speed.median,
                    100.0 * speed.half_width(),
                    test.yaw_rate_sd.unwrap_or(f64::INFINITY),
                    if speed.is_inside() { "inside" } else { "outside" },
                    if test.converged { "" } else { "not converged" },
                );
            }
        }
        let [mean, largest] = judgement.half_widths();
        println!(
            "{} of {} inside; half width {:.1} % of the true speed in the mean, {:.1} % at most",
            judgement.inside(),
            judgement.speeds().count(),
            100.0 * mean,
            100.0 * largest
        );
    }
    Ok(())
}
