//! Errors of angles, as numbers on a line.

use core::f64::consts::TAU;

use real::elementary::{atan2, sin_cos};

/// Turns the errors of an angle, observed − predicted, into those on a line that is cut where predictions are
/// rarest: opposite to their mean direction. `turn` is a full turn.
///
/// With errors between −½ and ½ turn, an observation opposite to all predictions would lie below half of
/// them and above the other half, as one in their midst does. Returns the mean error.
pub(crate) fn unrolled(errors: &mut [f64], turn: f64) -> f64 {
    let (mut sine, mut cosine) = (0.0, 0.0);
    for error in &*errors {
        let (sin, cos) = sin_cos(error * TAU / turn);
        sine += sin;
        cosine += cos;
    }
    // The mean error, between −½ and ½ turn; that of predictions all around the circle has no direction, and
    // any will do.
    let mean = atan2(sine, cosine) * turn / TAU;
    for error in errors {
        // ε = ε̄ + (ε − ε̄) less full turns
        let apart = *error - mean;
        *error = mean + apart - turn * (apart / turn).round();
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::unrolled;

    /// Predictions about 0°, and an observation at 180°: all errors are on one side. About 10°, they stay.
    #[test]
    fn an_observation_opposite_to_all_predictions_is_beyond_all() {
        let mut opposite = [179.0, -178.0, 177.0, -179.0, -179.5];
        let mean = unrolled(&mut opposite, 360.0);
        assert!(mean.abs() > 179.0);
        assert!(opposite.iter().all(|error| error.signum() == mean.signum()), "{opposite:?}");
        let mut near = [-5.0, 3.0, 12.0];
        let mean = unrolled(&mut near, 360.0);
        assert!((mean - 10.0 / 3.0).abs() < 0.1);
        for (found, error) in near.iter().zip([-5.0, 3.0, 12.0]) {
            assert!((found - error).abs() < 1e-12, "{near:?}");
        }
    }
}
