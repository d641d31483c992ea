//! A pedestrian steps onto the road 30 m ahead of a car at 60 km/h. Was the collision avoidable at 50 km/h?

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use time_distance::{InvalidInput, Response, Swell};

const KMH: f64 = 1.0 / 3.6;

pub(crate) fn main() -> Result<(), InvalidInput> {
    let response = Response::new(1.0, 0.2, 7.5, Swell::Linear)?;
    let (place, driven, limit) = (30.0, 60.0 * KMH, 50.0 * KMH);
    let spatial = response.speed_to_stop_within(place);
    println!("It stops before the place from {:.1} km/h or less.", spatial / KMH);
    println!("At 60 km/h it arrives with {:.1} km/h,", response.speed_after(driven, place) / KMH);
    println!("at 50 km/h with {:.1} km/h.", response.speed_after(limit, place) / KMH);
    // The pedestrian has 2.4 m to go at 1.4 m/s when the car arrives.
    let Some(arrival) = response.arrival(driven, place) else { return Ok(()) };
    let temporal = response.speed_to_arrive_after(place, arrival + 2.4 / 1.4);
    println!("From {:.1} km/h or less it arrives after the pedestrian has left.", temporal / KMH);
    // v²/2a + v τ − a t_S²/24 = s, with τ = 1.1 s
    assert!((spatial * spatial / 15.0 + spatial * 1.1 - 7.5 * 0.04 / 24.0 - place).abs() < 1e-9);
    assert!(temporal >= spatial && temporal < driven);
    Ok(())
}
