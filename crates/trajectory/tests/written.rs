//! Values written with the feature `serde` are read back unchanged.

use oracle::written::assert_again;
use trajectory::{Control, Ground, Steer, Target, to_rest, to_start_near};

use crate::scenes::{car, start};

#[test]
fn motions_to_rest_and_back() {
    let (chassis, ground, control) = (car([0.3; 4]), Ground::level(0.7), Control::default());
    let start = start(0.3, [12.0, 3.0], 1.5);
    let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, assert_again).unwrap();
    assert_again(&rest);
    assert_again(&control);
    let target = Target { position: rest.position, heading: rest.heading, turns_known: true, via: None };
    let (position, heading) = (start.position, start.heading);
    let found = to_start_near(
        &chassis,
        Steer::straight(),
        &ground,
        position,
        heading,
        &target,
        &control,
        &start.motion,
    );
    assert_again(&found.unwrap());
}
