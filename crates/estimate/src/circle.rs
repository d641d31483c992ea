//! Errors of angles, as numbers on a line.

use core::f64::consts::TAU;

use real::elementary::{atan2, sin_cos};

/// Unrolls the errors of an angle, observed − predicted, onto a line that is cut opposite to the mean
/// direction of the predictions, where they are rarest. `turn` is a full turn.
///
/// With errors between −½ and ½ turn, an observation opposite to all predictions would lie below half of them
/// and above the other half, like one in their middle. Returns the mean error.
pub(crate) fn unrolled(errors: &mut [f64], turn: f64) -> f64 {
    let (mut sine, mut cosine) = (0.0, 0.0);
    for error in &*errors {
        let (sin, cos) = sin_cos(error * TAU / turn);
        sine += sin;
        cosine += cos;
    }
    // The mean error, between −½ and ½ turn; for predictions all around the circle it is undefined, and any
    // will do.
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

    /// For predictions about 0° and an observation at 180°, all errors are on one side. Errors about 10° are
    /// unchanged.
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
