use super::{Dimension, STANDARD_GRAVITY};

/// (–) half a unit of the seventh digit, the precision of values that SP 811 does not print exactly.
const PRINTED: f64 = 5e-7;

fn factor(dimension: Dimension, spelling: &str) -> f64 {
    dimension.unit(spelling).unwrap_or_else(|| panic!("{dimension} has no unit {spelling}")).factor()
}

#[track_caller]
fn assert_factor(dimension: Dimension, spelling: &str, expected: f64, tolerance: f64) {
    let ours = factor(dimension, spelling);
    let error = (ours / expected - 1.0).abs();
    assert!(error <= tolerance, "{spelling}: {ours} against {expected}, relative error {error:e}");
}

/// NIST Special Publication 811 (2008), appendix B.8; the values in bold there are exact.
#[test]
fn factors_agree_with_nist_sp_811() {
    use Dimension::*;
    // Exact: equal except for the last bit, which the product of two constants may cost.
    for (dimension, spelling, exact) in [
        (Length, "ft", 3.048e-1),
        (Length, "in", 2.54e-2),
        (Mass, "lb", 4.535_923_7e-1),
        (Mass, "t", 1e3),
        (Speed, "mph", 4.4704e-1),
        (Speed, "ft/s", 3.048e-1),
        (Weight, "kgf", 9.80665),
        (StiffnessB, "N/mm^2", 1e6),
        (StiffnessB, "N/cm^2", 1e4),
        (StiffnessB, "kPa", 1e3),
        (Energy, "kJ", 1e3),
        (Energy, "MJ", 1e6),
        (StiffnessA, "N/cm", 1e2),
        (StiffnessA, "N/mm", 1e3),
        (StiffnessA, "kN/m", 1e3),
        (StiffnessA, "kN/cm", 1e5),
        (StiffnessA, "kN/mm", 1e6),
        (StiffnessB, "kN/cm^2", 1e7),
        (RootForcePerLength, "N^0.5/cm", 1e2),
    ] {
        assert_factor(dimension, spelling, exact, f64::EPSILON);
    }
    for (dimension, spelling, printed) in [
        (Mass, "slug", 1.459_390e1),
        (Weight, "lb", 4.448_222),
        (StiffnessG, "lb", 4.448_222),
        (Speed, "km/h", 2.777_778e-1),
        (Speed, "kn", 5.144_444e-1),
        (Angle, "deg", 1.745_329e-2),
        (YawRate, "rpm", 1.047_198e-1),
        (YawRate, "deg/s", 1.745_329e-2),
        (Energy, "ft lb", 1.355_818),
        // foot pound-force and inch pound-force, and the square second is the SI's own
        (Inertia, "lb ft s^2", 1.355_818),
        (Inertia, "lb in s^2", 1.129_848e-1),
        (Inertia, "slug ft^2", 1.355_818),
        // pound foot squared and pound inch squared
        (Inertia, "lb ft^2", 4.214_011e-2),
        (Inertia, "lb in^2", 2.926_397e-4),
        (StiffnessA, "lb/in", 1.751_268e2),
        (StiffnessA, "lb/ft", 1.459_390e1),
        (StiffnessB, "psi", 6.894_757e3),
        (StiffnessB, "psf", 4.788_026e1),
    ] {
        assert_factor(dimension, spelling, printed, PRINTED);
    }
}

/// SP 811 has no row for the roots, but one for each of their squares.
#[test]
fn squared_roots_agree_with_nist_sp_811() {
    let squared = |dimension, spelling| factor(dimension, spelling) * factor(dimension, spelling);
    let close = |ours: f64, printed: f64| (ours / printed - 1.0).abs() <= PRINTED;
    assert!(close(squared(Dimension::RootForce, "lb^0.5"), 4.448_222));
    // d1² is a B: lbf/ft² and lbf/in².
    assert!(close(squared(Dimension::RootForcePerLength, "lb^0.5/ft"), 4.788_026e1));
    assert!(close(squared(Dimension::RootForcePerLength, "lb^0.5/in"), 6.894_757e3));
    // The literal is the correctly rounded root of the exact pound-force.
    assert_eq!(factor(Dimension::RootForce, "lb^0.5"), 4.448_221_615_260_5_f64.sqrt());
}

#[test]
fn every_dimension_has_its_si_unit_with_factor_one() {
    for dimension in Dimension::ALL {
        assert_eq!(factor(dimension, dimension.si_unit()), 1.0, "{dimension}");
        assert!(dimension.units().iter().all(|unit| unit.dimension() == dimension));
    }
}

#[test]
fn a_weight_in_pounds_is_a_mass_in_pounds() {
    let mass = factor(Dimension::Weight, "lb") / STANDARD_GRAVITY;
    assert!((mass / factor(Dimension::Mass, "lb") - 1.0).abs() < 2.0 * f64::EPSILON);
}
