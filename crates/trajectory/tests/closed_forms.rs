//! Motions that have a closed form, written down here a second time.

use trajectory::{Control, GRAVITY, Ground, Steer, to_rest};

use crate::scenes::{car, start};

/// S = v²/(2 μ g), t = v/(μ g)
#[test]
fn a_straight_slide_with_locked_wheels() {
    for (heading, direction) in [(0.0, 0.0), (0.7, 0.7), (0.7, 2.0), (-2.0, 1.0)] {
        let v = 13.0_f64;
        let start = start(heading, [v * f64::cos(direction), v * f64::sin(direction)], 0.0);
        let chassis = car([1.0; 4]);
        let rest =
            to_rest(&chassis, Steer::straight(), &Ground::level(0.7), &start, &Control::default(), |_| {})
                .unwrap();
        let way = v * v / (2.0 * 0.7 * GRAVITY);
        assert!((rest.position.x - way * f64::cos(direction)).abs() < 1e-9);
        assert!((rest.position.y - way * f64::sin(direction)).abs() < 1e-9);
        assert!((rest.time - v / (0.7 * GRAVITY)).abs() < 1e-9 && (rest.distance - way).abs() < 1e-9);
        assert_eq!(rest.heading, heading);
    }
}
