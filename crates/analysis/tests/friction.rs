//! Impacts without friction, and the friction limits of CRASH3's correction, against hand calculations.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use analysis::{Analysis, Correction, impact, reconstruct};
use case::CaseFile;
use crash3::ObliqueCorrection;
use inputs::Case;

const NOT_REACHED: &str = include_str!("../../../fixtures/no-answer/not-reached.toml");
const PULLING: &str = include_str!("../../../fixtures/no-answer/pulling.toml");
const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");

fn parsed(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap().case
}

fn with_law(text: &str, law: &str) -> Case {
    assert_eq!(text.matches("\"critical\"").count(), 1);
    parsed(&text.replace("\"critical\"", law))
}

/// Stopping the contact point along the wall takes a pull at every speed; without friction, the crush energy
/// comes at 27.42 m/s.
#[test]
fn a_fraction_of_zero_needs_no_critical_ratio_to_be_found() {
    assert!(reconstruct(&with_law(NOT_REACHED, "{ fraction = 0.002 }")).is_err());
    let answer = reconstruct(&with_law(NOT_REACHED, "{ fraction = 0 }")).unwrap();
    let speed = answer.found.unwrap().speed;
    assert!((speed - 27.42).abs() < 5e-3, "{speed}");
    // 1 m of 5, 10, 15, 20 cm: A C̄ + B Q/2 + A²/2B with C̄ = 0.125 m and Q = 0.1575/9 m².
    let energy = 15e3 * 0.125 + 400e3 * 0.1575 / 18.0 + 15e3 * 15e3 / 800e3;
    // k_nn = (1 + r_t²/k²)/m with r_t along the wall, which is the x axis
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let along = -2.0 * cos - 0.8 * sin;
    let k_nn = (1.0 + along * along / 2.25) / 1500.0;
    // ½ (1 − e²) u_n²/k_nn = E with u_n = v sin 10°
    let expected = (2.0 * energy * k_nn / (1.0 - 0.01)).sqrt() / sin;
    assert!((speed / expected - 1.0).abs() < 1e-9, "{speed} is not {expected}");
}

#[test]
fn a_fraction_of_zero_needs_no_critical_ratio_to_be_computed() {
    assert!(impact(&with_law(PULLING, "{ fraction = 0.002 }")).is_err());
    let outcome = impact(&with_law(PULLING, "{ fraction = 0 }")).unwrap().impact.unwrap().outcome;
    assert_eq!(outcome.critical_impulse_ratio, None);
    assert_eq!(outcome.impulse.tangential, 0.0);
    // P_n = −(1 + e) u_n/k_nn with u_n = −2 m/s, the corner at −2 cos 10° + 0.8 sin 10° along the rail
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let along = -2.0 * cos + 0.8 * sin;
    let expected = 1.1 * 2.0 * 1500.0 / (1.0 + along * along / 2.25);
    assert!((outcome.impulse.normal / expected - 1.0).abs() < 1e-12, "{}", outcome.impulse.normal);
}

fn with_limits([first, second]: [&str; 2]) -> String {
    PAPER
        .replace("[vehicle1.crush]", &format!("[vehicle1.crush]\n{first}"))
        .replace("[vehicle2.crush]", &format!("[vehicle2.crush]\n{second}"))
}

fn swapped(text: &str) -> String {
    text.replace("vehicle1", "first").replace("vehicle2", "vehicle1").replace("first", "vehicle2")
}

fn friction_row(analysis: &Analysis) -> Correction {
    let rows = &analysis.crash3.as_ref().unwrap().corrections;
    *rows.iter().find(|row| matches!(row.corrections[0], ObliqueCorrection::Friction(_))).unwrap()
}

/// Each vehicle's energy is corrected with its own limit, or with that of the other if it has none; so
/// swapped vehicles give a swapped row.
#[test]
fn the_friction_row_has_each_vehicle_s_own_limit() {
    let [none, low, high] = ["", "oblique = { friction = 0.05 }", "oblique = { friction = 0.8 }"];
    for (limits, expected) in [
        ([high, low], [0.8, 0.05]),
        ([low, high], [0.05, 0.8]),
        ([high, none], [0.8; 2]),
        ([none, low], [0.05; 2]),
        ([none, none], [0.5; 2]),
    ] {
        let text = with_limits(limits);
        let analysis = reconstruct(&parsed(&text)).unwrap();
        let row = friction_row(&analysis);
        assert_eq!(row.corrections, expected.map(ObliqueCorrection::Friction));
        let mut energy = 0.0;
        for (i, vehicle) in analysis.vehicles.iter().enumerate() {
            let damage = vehicle.damage.as_ref().unwrap();
            let tan = damage.oblique_angle.unwrap().tan().abs();
            // 1 + min(|tan α|, μ) |tan α|
            let factor = 1.0 + tan.min(expected[i]) * tan;
            assert!((row.factor[i] / factor - 1.0).abs() < 1e-12, "{limits:?}");
            energy += damage.crush_energy * factor;
        }
        let crash3 = analysis.crash3.as_ref().unwrap();
        // ΔV ∝ √E
        let growth = (energy / crash3.crush_energy).sqrt();
        for (corrected, uncorrected) in row.delta_v.into_iter().zip(crash3.delta_v) {
            assert!((corrected / (uncorrected * growth) - 1.0).abs() < 1e-12, "{limits:?}");
        }
        if limits == [high, low] {
            // Where each has a limit, that is the correction that the case itself asks for.
            let own = crash3.corrected.unwrap().delta_v;
            assert!((row.delta_v[0] / own[0] - 1.0).abs() < 1e-12);
        }
        let other = friction_row(&reconstruct(&parsed(&swapped(&text))).unwrap());
        for i in 0..2 {
            assert!((other.delta_v[1 - i] / row.delta_v[i] - 1.0).abs() < 1e-9, "{limits:?}");
        }
    }
}
