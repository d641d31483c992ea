//! Which errors make the intervals of both speeds of the staged collisions wide: each in turn is reduced to
//! next to nothing, while all others stay.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;

use validation::{AfterImpact, AssumedErrors, Data, judge_speeds_assuming};

/// (–) in place of a spread.
const NEXT_TO_NOTHING: f64 = 0.02;
/// (rad) in place of the spread of a direction: a degree.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// An error, and how it is reduced.
type Source = (&'static str, fn(&mut AssumedErrors));

const ERRORS: [Source; 11] = [
    ("none", |_| {}),
    ("restitution", |assumed| assumed.fitted.restitution[3] = NEXT_TO_NOTHING),
    ("greatest impulse ratio", |assumed| assumed.fitted.friction[1] = NEXT_TO_NOTHING),
    ("λ", |assumed| assumed.fitted.tangential_share[1] = NEXT_TO_NOTHING),
    ("stiffness", |assumed| assumed.fitted.slope_ln_sd = NEXT_TO_NOTHING),
    ("no-damage speed", |assumed| assumed.fitted.no_damage_speed_ln_sd = NEXT_TO_NOTHING),
    ("crush plane, contact point", |assumed| {
        assumed.fitted.crush_plane_sd = DEGREE;
        assumed.fitted.contact_sd = NEXT_TO_NOTHING;
    }),
    ("all of these", |assumed| {
        for (_, reduce) in &ERRORS[1..7] {
            reduce(assumed);
        }
    }),
    ("misfit of the crush energy, to a tenth", |assumed| {
        assumed.fitted.crush_ln_sd = assumed.fitted.crush_ln_sd.map(|sd| 0.1 * sd);
    }),
    ("direction after the impact, to 1°", |assumed| assumed.direction_sd = DEGREE),
    ("speed after the impact, to 2 %", |assumed| assumed.speed_ln_sd = NEXT_TO_NOTHING),
];

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("Crush and velocities after the impact, with one error reduced to next to nothing");
    println!("{:44} half width  largest  inside", "error that is reduced");
    for (name, reduce) in ERRORS {
        let mut assumed = AssumedErrors::STATED;
        reduce(&mut assumed);
        let judgement = judge_speeds_assuming(&Data::built_in(), AfterImpact::Velocities, &assumed, 512, 1)?;
        let [mean, largest] = judgement.half_widths().map(|share| 100.0 * share);
        let (inside, all) = (judgement.inside(), judgement.speeds().count());
        println!("{name:44} {mean:8.1} %  {largest:5.1} %  {inside} of {all}");
    }
    Ok(())
}
