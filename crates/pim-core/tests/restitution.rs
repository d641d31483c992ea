//! Restitution that depends on the closing speed: the curve, and laws with it.

use oracle::compare::assert_close;
use pim_core::{InvalidInput, Law, RestitutionCurve, Tangential, VaryingLaw};

fn curve(points: &[(f64, f64)]) -> RestitutionCurve {
    RestitutionCurve::new(points.to_vec()).unwrap()
}

#[test]
fn a_curve_is_linear_between_its_points_and_constant_outside() {
    let points = [(2.0, 0.4), (6.0, 0.2), (10.0, 0.1)];
    let through = curve(&points);
    assert_eq!(through.points(), points);
    for (speed, e) in [
        (0.0, 0.4),
        (1.9, 0.4),
        (2.0, 0.4),
        (3.0, 0.35),
        (4.0, 0.3),
        (6.0, 0.2),
        (8.0, 0.15),
        (9.0, 0.125),
        (10.0, 0.1),
        (1e9, 0.1),
    ] {
        assert_close("e", through.at(speed), e, 1e-15);
    }
    let constant = curve(&[(3.0, 0.25)]);
    for speed in [0.0, 3.0, 5.0] {
        assert_eq!(constant.at(speed), 0.25);
    }
}

#[test]
fn a_curve_changes_the_restitution_of_a_law_and_nothing_else() {
    let law = |e: f64| Law::new(e, Tangential::Friction(0.6)).unwrap().with_moment_restitution(-0.5).unwrap();
    let varying = law(0.9).with_restitution_curve(curve(&[(2.0, 0.5), (6.0, 0.25)]));
    assert_eq!(varying.at(4.0), law(0.375));
    assert_eq!(varying.nominal(), law(0.5), "that of the first point");
    assert_eq!(varying.curve().unwrap().around(4.0), [Some((2.0, 0.5)), Some((6.0, 0.25))]);
    assert_eq!(varying.curve().unwrap().around(6.0), [Some((6.0, 0.25)), None]);
    assert_eq!(varying.curve().unwrap().around(1.0), [None, Some((2.0, 0.5))]);
    let constant = VaryingLaw::from(law(0.9));
    assert_eq!([constant.at(0.0), constant.at(4.0)], [law(0.9); 2]);
    assert!(constant.curve().is_none());
}

#[test]
fn a_curve_needs_ascending_speeds_and_coefficients() {
    let refused = |points: &[(f64, f64)]| RestitutionCurve::new(points.to_vec()).unwrap_err();
    assert_eq!(refused(&[]), InvalidInput::NoPoints);
    for (points, before, value) in [
        (vec![(-1.0, 0.3)], 0.0, -1.0),
        (vec![(1.0, 0.3), (1.0, 0.2)], 1.0, 1.0),
        (vec![(0.0, 0.3), (0.0, 0.2)], 0.0, 0.0),
        (vec![(0.0, 0.3), (5.0, 0.2), (4.0, 0.1)], 5.0, 4.0),
    ] {
        assert_eq!(refused(&points), InvalidInput::NotAscending { before, value });
    }
    for bad in [-0.1, 1.1] {
        let refusal = refused(&[(0.0, 0.3), (1.0, bad)]);
        assert!(matches!(refusal, InvalidInput::OutOfRange { value, .. } if value == bad), "{refusal:?}");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        for point in [(bad, 0.1), (1.0, bad)] {
            let refusal = refused(&[(0.5, 0.2), point]);
            assert!(matches!(refusal, InvalidInput::NotFinite { .. }), "{refusal:?}");
        }
    }
    let text = refused(&[(3.0, 0.3), (2.0, 0.2)]).to_string();
    assert!(text.contains("2 m/s follows 3 m/s"), "{text}");
    assert!(RestitutionCurve::new(vec![(0.0, 1.0), (1e-9, 0.0)]).is_ok());
}
