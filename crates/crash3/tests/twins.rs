//! The functions for loops over many samples return a plain validity flag where the others give a reason.

use crash3::{Profile, Zone};

const ODD: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0];

#[test]
fn zones_of_a_profile() {
    for width in ODD.into_iter().chain([0.3]) {
        for c1 in ODD.into_iter().chain([0.2]) {
            for c2 in ODD.into_iter().chain([0.4]) {
                let zone = Zone { width, depths: [c1, c2] };
                // Two depths of zero are a valid zone without damage.
                let depths = vec![c1, c2, 0.1];
                let expected = Profile::new(depths, vec![width, 0.3]).is_ok();
                assert_eq!(zone.is_valid(), expected, "{zone:?}");
            }
        }
    }
}
