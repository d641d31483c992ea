//! Each term against the formula, computed by hand for a central impact.

use std::f64::consts::PI;

use estimate::Evidence;
use evidence::{
    After, BodyNumbers, CodedPdof, Collision, Crush, CrushMisfit, Freedom, Limits, Measured, Model, Number,
    Piece, RecordedDeltaV, Recorder, Restitution, Severity, Speeds, Vehicle,
};
use pim_core::VehicleId::{One, Two};
use uncertainty::LANES;

pub(crate) fn vehicle(mass: f64, ahead: f64) -> Vehicle {
    Vehicle {
        body: Some(BodyNumbers { mass: mass.into(), yaw_radius: 1.4.into() }),
        heading: 0.0.into(),
        contact: [ahead.into(), 0.0.into()],
        yaw_rate: 0.0.into(),
        crush: None,
        pdof: None,
        after: After::default(),
        recorder: Recorder::default(),
        limits: Limits::default(),
    }
}

/// Vehicle 1, 1500 kg, runs at 15 m/s squarely into the rear of vehicle 2, 1000 kg, which stands; e = 0.1.
///
/// ΔV₁ = (1 + e) v m₂/(m₁ + m₂) = 6.6 m/s, ΔV₂ = 9.9 m/s, V₁ = 8.4 m/s, V₂ = 9.9 m/s,
/// E_L = ½ (1 − e²) m₁m₂/(m₁ + m₂) v² = 66825 J.
pub(crate) fn rear_end() -> Collision {
    Collision {
        vehicles: [vehicle(1500.0, 2.0), vehicle(1000.0, -2.0)],
        speeds: Speeds::Each([15.0.into(), 0.0.into()]),
        crush_plane: 0.0.into(),
        restitution: Restitution::Constant(0.1.into()),
        friction: 0.7.into(),
        tangential_share: 0.5.into(),
        severity: None,
        crush: None,
    }
}

fn terms(collision: &Collision) -> Vec<(Piece, f64)> {
    let model = Model::new(collision);
    let mut terms = vec![[0.0; LANES]; model.terms_count()];
    let mut reasons = [0; LANES];
    model.log_likelihood(&[], &mut terms, &mut reasons);
    assert!(reasons.iter().all(|reason| *reason == 0));
    assert!(terms.iter().all(|lanes| lanes.iter().all(|term| *term == lanes[0])));
    model.pieces().iter().copied().zip(terms.iter().map(|lanes| lanes[0])).collect()
}

fn close(ours: f64, expected: f64) {
    assert!((ours - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{ours} {expected}");
}

fn normal(z: f64, sd: f64) -> f64 {
    -0.5 * z * z - (sd * (2.0 * PI).sqrt()).ln()
}

#[test]
fn the_crush_energy_is_that_of_the_normal_work() {
    let mut collision = rear_end();
    // Of a profile: 10 + 20 + 15 kJ, κ = 1.1 and β = 0.9 change it to 8.1 + 19.8 + 18.15 kJ.
    let crush = |slope: f64, no_damage_speed: f64| Crush {
        constant: 10e3,
        linear: 20e3,
        square: 15e3,
        slope: slope.into(),
        no_damage_speed: no_damage_speed.into(),
    };
    collision.vehicles[0].crush = Some(crush(1.0, 1.0));
    collision.vehicles[1].crush = Some(crush(1.1, 0.9));
    collision.crush = Some(CrushMisfit { bias: -0.2, ln_sd: 0.4 });
    let [(Piece::Crush, term)] = terms(&collision)[..] else { panic!() };
    let energy = 45e3 + 8.1e3 + 19.8e3 + 18.15e3;
    close(term, normal(((energy / 66_825.0_f64).ln() + 0.2) / 0.4, 0.4));
}

#[test]
fn velocities_after_the_impact_have_normal_errors() {
    let mut collision = rear_end();
    collision.vehicles[1].after = After {
        speed: Some(Measured { value: 11.0, sd: 0.12 }),
        direction: Some(Measured { value: 2.0 * PI - 0.1, sd: 0.14 }),
        yaw_rate: Some(Measured { value: 0.3, sd: 0.2 }),
    };
    let terms = terms(&collision);
    let pieces: Vec<Piece> = terms.iter().map(|(piece, _)| *piece).collect();
    assert_eq!(pieces, [Piece::SpeedAfter(Two), Piece::DirectionAfter(Two), Piece::YawRateAfter(Two)]);
    close(terms[0].1, normal((11.0_f64 / 9.9).ln() / 0.12, 0.12));
    close(terms[1].1, normal(0.1 / 0.14, 0.14));
    close(terms[2].1, normal(1.5, 0.2));
}

#[test]
fn a_recorder_and_a_pdof_have_heavy_tails() {
    let mut collision = rear_end();
    let (ln_scale, freedom) = (0.16, Freedom::Three);
    let delta_v = Some(RecordedDeltaV { size: 6.0, is_longitudinal: true, ln_scale, freedom });
    collision.vehicles[0].recorder = Recorder { delta_v, speed: Some(Measured { value: 16.0, sd: 0.05 }) };
    collision.vehicles[0].pdof = Some(CodedPdof { pdof: 0.2, scale: 0.1 });
    // The wider of two PDOFs does not count: both are one observation.
    collision.vehicles[1].pdof = Some(CodedPdof { pdof: PI, scale: 0.15 });
    let terms = terms(&collision);
    let pieces: Vec<Piece> = terms.iter().map(|(piece, _)| *piece).collect();
    assert_eq!(pieces, [Piece::Pdof(One), Piece::RecordedDeltaV(One), Piece::RecordedSpeed(One)]);
    // f(z) = (1 + z²/2)^(−3/2)/√8 with z = 2
    close(terms[0].1, (3.0_f64.powf(-1.5) / (8.0_f64.sqrt() * 0.1)).ln());
    // f(z) = 2/(π√3 (1 + z²/3)²)
    let z = (6.0_f64 / 6.6).ln() / ln_scale;
    close(terms[1].1, (2.0 / (PI * 3.0_f64.sqrt() * (1.0 + z * z / 3.0).powi(2) * ln_scale)).ln());
    close(terms[2].1, normal((16.0_f64 / 15.0).ln() / 0.05, 0.05));
}

#[test]
fn limits_hold() {
    for (limits, term) in [
        (Limits { least: 0.0, most: 15.0 }, 0.0),
        (Limits { least: 15.5, most: 30.0 }, f64::NEG_INFINITY),
        (Limits { least: 0.0, most: 14.5 }, f64::NEG_INFINITY),
    ] {
        let mut collision = rear_end();
        collision.vehicles[0].limits = limits;
        assert_eq!(terms(&collision), [(Piece::Limits(One), term)]);
    }
}

#[test]
fn severity_is_that_of_the_mean_delta_v() {
    let mut collision = rear_end();
    collision.severity = Some(Severity { median: 7.0, ln_sd: 0.5, speed: 25.0 });
    let z = ((6.6_f64 * 9.9).sqrt() / 7.0).ln() / 0.5;
    assert_eq!(terms(&collision).len(), 1);
    close(terms(&collision)[0].1, normal(z, 0.5) - 0.5 * (15.0_f64 / 25.0).powi(2));
}

#[test]
fn restitution_falls_with_the_closing_speed() {
    let mut collision = rear_end();
    let factor = Number::Exact(0.5);
    collision.restitution =
        Restitution::ByClosingSpeed { low: 0.08, rise: 0.32, fade: 5.0, factor, most: 0.7 };
    let e = 0.5 * (0.08 + 0.32 * (-3.0_f64).exp());
    collision.vehicles[0].after.speed = Some(Measured { value: 9.0 - 6.0 * e, sd: 0.01 });
    // V₁ = (m₁ − e m₂) v/(m₁ + m₂)
    close(terms(&collision)[0].1, normal(0.0, 0.01));
}

#[test]
fn together_the_speeds_have_their_relative_speed_and_split() {
    let mut collision = rear_end();
    // At right angles, with 5 and 12 m/s, they are 13 m/s apart.
    collision.vehicles[1].heading = (0.5 * PI).into();
    collision.vehicles[1].contact = [0.0.into(), 0.5.into()];
    collision.speeds = Speeds::Together {
        ln_relative: Number::Exact(13.0_f64.ln()),
        split: Number::Exact((12.0_f64 / 5.0).atan()),
    };
    for (k, speed) in [(0, 5.0), (1, 12.0)] {
        collision.vehicles[k].recorder.speed = Some(Measured { value: speed, sd: 0.01 });
    }
    for (_, term) in terms(&collision) {
        close(term, normal(0.0, 0.01));
    }
}

#[test]
fn vehicles_that_do_not_meet_have_no_impact() {
    let mut collision = rear_end();
    collision.speeds = Speeds::Each([5.0.into(), 6.0.into()]);
    let model = Model::new(&collision);
    let mut reasons = [0; LANES];
    model.log_likelihood(&[], &mut [], &mut reasons);
    assert_eq!(reasons, [1; LANES]);
}
