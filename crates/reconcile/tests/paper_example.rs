//! The example of SAE 980025 (its section "Using PIM and CRASH3 in combination" and its appendix), in its
//! original US units.
//!
//! The expected figures are those of the corrected equations, and the paper's where they are right. Where
//! they are not, `ERRATUM` marks it and the test shows the difference.

use crash3::{
    EnergyBasis, ObliqueCorrection, Profile, Stiffness, StruckVehicle, crush_energy, delta_v, moment_arm,
};
use oracle::compare::{assert_close, assert_printed, assert_relative};
use pim_core::{Body, Contact, Law, Motion, Participant, Tangential, VehicleId};
use reconcile::{Problem, Reconciliation, SolutionMethod};

use crate::reconciliation::posed;

/// (m).
pub(crate) const FOOT: f64 = 0.3048;
/// (m).
const INCH: f64 = FOOT / 12.0;
/// (m/s).
const MPH: f64 = 5280.0 * FOOT / 3600.0;
/// (m/s²) standard gravity.
const GRAVITY: f64 = 9.80665;
/// (N) the weight of 0.45359237 kg.
pub(crate) const POUND_FORCE: f64 = 0.453_592_37 * GRAVITY;

/// Vehicle 1 and vehicle 2, as in the appendix.
const WEIGHTS: [f64; 2] = [3696.0, 3413.0];
const INERTIAS: [f64; 2] = [2437.0, 2165.0];
/// ERRATUM: the appendix prints θ₁ = 0 with v_x = −75 ft/s: the vehicle's heading is 180°.
const HEADINGS: [f64; 2] = [180.0, 67.0];
const CONTACT_DISTANCES: [f64; 2] = [6.3, 3.8];
const CONTACT_ANGLES: [f64; 2] = [-22.4, -39.0];
pub(crate) const DEPTHS: [[f64; 6]; 2] =
    [[21.3, 20.3, 13.8, 11.3, 5.3, 4.8], [3.0, 15.8, 13.5, 6.7, 3.3, 5.0]];
pub(crate) const WIDTHS: [f64; 2] = [65.0, 84.0];
pub(crate) const D0: [f64; 2] = [35.0, 30.0];
pub(crate) const D1: [f64; 2] = [115.0, 77.5];
const CRUSH_PLANE: f64 = -23.0;
const RESTITUTION: f64 = 0.3;

fn mass(i: usize) -> f64 {
    WEIGHTS[i] * POUND_FORCE / GRAVITY
}

fn yaw_inertia(i: usize) -> f64 {
    INERTIAS[i] * POUND_FORCE * FOOT
}

fn contact() -> Contact {
    let place = |i: usize| {
        Participant::polar(
            Body::new(mass(i), yaw_inertia(i)).unwrap(),
            HEADINGS[i].to_radians(),
            CONTACT_DISTANCES[i] * FOOT,
            CONTACT_ANGLES[i].to_radians(),
        )
        .unwrap()
    };
    Contact::new([place(0), place(1)], CRUSH_PLANE.to_radians()).unwrap()
}

fn stiffness(i: usize) -> Stiffness {
    Stiffness::from_d0_d1(D0[i] * POUND_FORCE.sqrt(), D1[i] * POUND_FORCE.sqrt() / FOOT).unwrap()
}

/// (J) crush energies of vehicle 1 and vehicle 2.
fn energies() -> [f64; 2] {
    [0, 1].map(|i| {
        let depths = DEPTHS[i].map(|depth| depth * INCH).to_vec();
        crush_energy(&Profile::equally_spaced(depths, WIDTHS[i] * INCH).unwrap(), &stiffness(i))
    })
}

fn problem() -> Problem {
    let [e1, e2] = energies();
    let law = Law::new(RESTITUTION, Tangential::Critical).unwrap();
    let motions = [Motion::rest(), Motion::along(HEADINGS[1].to_radians(), 10.0 * MPH)];
    posed(contact(), law, motions, VehicleId::One, e1 + e2, EnergyBasis::Dissipated).unwrap()
}

pub(crate) fn reconciliation() -> Reconciliation {
    problem().solve().unwrap()
}

/// h of both vehicles, for the direction of the impact's impulse.
fn moment_arms() -> [f64; 2] {
    let outcome = reconciliation().outcome;
    [0, 1].map(|i| {
        let angle = CONTACT_ANGLES[i].to_radians();
        let distance = CONTACT_DISTANCES[i] * FOOT;
        moment_arm([distance * angle.cos(), distance * angle.sin()], outcome.pdof()[i])
    })
}

#[test]
fn the_crush_takes_the_energy_that_the_paper_says() {
    let [e1, e2] = energies();
    assert_printed(e1, "102165");
    assert_printed(e2, "38657");
    assert_printed(e1 + e2, "140821");
    assert_printed(e1, "1.02e5");
    assert_printed(e2, "3.87e4");
    assert_printed(e1 + e2, "1.41e5");
    let foot_pounds = POUND_FORCE * FOOT;
    assert_printed(e2 / foot_pounds, "2.85e4");
    assert_printed((e1 + e2) / foot_pounds, "1.04e5");
    // The appendix has 7.54e4 ft·lb, the text 7.53e4: the value lies between the two, at 7.5353e4.
    assert_printed(e1 / foot_pounds, "7.54e4");
}

#[test]
fn the_stiffness_is_the_paper_s_in_both_units() {
    // Appendix: A in N/cm, B in N/cm².
    for (i, a, b) in [(0, "587.4", "63.3"), (1, "339.3", "28.8")] {
        assert_printed(stiffness(i).a() / 100.0, a);
        assert_printed(stiffness(i).b() / 1e4, b);
    }
}

#[test]
fn the_speed_is_the_one_that_the_paper_finds() {
    let answer = reconciliation();
    assert_printed(answer.speed, "22.869");
    assert_printed(answer.speed / FOOT, "75.03");
    assert_printed(answer.speed / FOOT, "75");
    assert_printed(answer.speed, "22.9");
    assert_eq!(answer.admissible, 1);
    assert!(problem().speeds().eq([answer.speed]));
    assert!(matches!(answer.method, SolutionMethod::ClosedForm));
    assert_relative("W_n", answer.outcome.energy.normal_work, energies().iter().sum(), 1e-12);
    assert_relative("W_n", problem().normal_work(answer.speed), energies().iter().sum(), 1e-12);
    let [before, _] = answer.outcome.before;
    assert_close("v_1 along y", before.velocity.y, 0.0, 1e-12);
    assert_printed(before.velocity.x / FOOT, "-75.03");
}

#[test]
fn the_impact_is_the_one_that_the_paper_prints() {
    let answer = reconciliation();
    let outcome = answer.outcome;
    assert_printed(outcome.impulse_ratio, "0.36885");
    assert_printed(outcome.critical_impulse_ratio.unwrap(), "0.36885");
    assert_printed(outcome.impulse.normal, "19113");
    assert_printed(outcome.impulse.tangential, "7050");
    assert_printed(outcome.energy.loss, "188076");
    assert_printed(outcome.energy.loss / outcome.energy.before * 100.0, "41.4");
    assert_printed(outcome.energy.loss / 1e5, "1.88");
    assert_printed(outcome.energy.normal_work / outcome.energy.before * 100.0, "31.0");
    let [after1, after2] = outcome.after;
    for (value, corrected, paper) in [
        (after1.velocity.x / FOOT, "-35.21", -35.3),
        (after1.velocity.y / FOOT, "-1.92", -1.8),
        (after1.yaw_rate, "-3.98", -4.0),
        (after2.velocity.x / FOOT, "-37.39", -37.3),
        (after2.velocity.y / FOOT, "15.57", 15.5),
        (after2.yaw_rate, "4.11", 4.1),
    ] {
        assert_printed(value, corrected);
        // The paper rounds μ_c to 0.371 and the speed to 75 ft/s.
        assert_close("the paper's motion", value, paper, 0.13);
    }
    let [dv1, dv2] = outcome.delta_v_magnitude();
    assert_printed(dv1 / MPH, "27.18");
    assert_printed(dv2 / MPH, "29.44");
    assert_printed(dv2 / MPH, "29.4");
    // The paper truncates 27.18 to 27.1.
    assert_close("the paper's ΔV_1", dv1 / MPH, 27.1, 0.1);
    assert_close("the paper's ΔV_1", dv1, 12.12, 0.035);
    assert_close("the paper's ΔV_2", dv2, 13.13, 0.035);
    assert_relative("the paper's μ_c", outcome.impulse_ratio, 0.371, 0.006);
    assert_relative("the paper's P_n", outcome.impulse.normal, 19_045.0, 0.004);
    // ERRATUM: the appendix prints P_t = 1064 N; its own 1588.2 lbf·s and its μ P_n are 7064 N·s.
    assert_relative("the paper's P_t, mended", outcome.impulse.tangential, 7064.0, 0.003);
    assert_printed(1588.2 * POUND_FORCE, "7065");
    assert_relative("the paper's resultant", outcome.impulse_vector.norm(), 20_313.0, 0.004);
}

/// ERRATUM: the appendix prints v_2x = −5.7 and V_2y = −15.5 ft/s. Only with the other sign of both is
/// momentum conserved.
#[test]
fn the_signs_of_vehicle_2_are_those_that_balance_the_momentum() {
    let change = |weight: f64, before: f64, after: f64| weight * (after - before);
    let x = |v2x: f64| change(3696.0, -75.0, -35.3) + change(3413.0, v2x, -37.3);
    let y = |v2y: f64| change(3696.0, 0.0, -1.8) + change(3413.0, 13.5, v2y);
    // In lb ft/s, out of some 147,000 exchanged; a tenth of a ft/s is 350.
    assert!(x(5.7).abs() < 700.0 && y(15.5).abs() < 700.0, "{} {}", x(5.7), y(15.5));
    assert!(x(-5.7).abs() > 30_000.0 && y(-15.5).abs() > 90_000.0);
    let [_, before] = reconciliation().outcome.before;
    assert_printed(before.velocity.x / FOOT, "5.7");
    assert_printed(before.velocity.y / FOOT, "13.5");
}

#[test]
fn crash3_alone_needs_the_arms() {
    let [h1, h2] = moment_arms();
    assert_printed(h1, "0.646");
    assert_printed(h2, "0.592");
    assert_printed(h2 / FOOT, "1.943");
    let inertia = |i: usize, h: f64| StruckVehicle::new(mass(i), yaw_inertia(i), h).unwrap();
    let energy: f64 = energies().iter().sum();
    assert_printed(inertia(0, h1).effective_mass_ratio(), "0.825");
    assert_printed(inertia(1, h2).effective_mass_ratio(), "0.844");
    let [dv1, dv2] = delta_v(energy, [inertia(0, h1), inertia(1, h2)]).unwrap();
    assert_printed(dv1 / FOOT, "26.9");
    assert_printed(dv2 / FOOT, "29.2");
    // The paper does not state its arms: h₂ = 1.215 ft reproduces its figures.
    let [dv1, dv2] = delta_v(energy, [inertia(0, h1), inertia(1, 1.215 * FOOT)]).unwrap();
    assert_printed(dv1 / FOOT, "27.6");
    assert_printed(dv2 / FOOT, "29.9");
    assert_printed(dv1 / MPH, "18.8");
    assert_printed(dv2 / MPH, "20.4");
    assert_close("the paper's ΔV_1", dv1, 8.41, 0.01);
    // ERRATUM: the appendix prints 9.91 m/s for 29.9 ft/s.
    assert_printed(dv2, "9.11");
}

#[test]
fn the_corrected_energies_follow_from_the_paper_s_angles() {
    let factor = |degrees: f64| {
        ObliqueCorrection::Capped.factor(degrees.to_radians()).map(|oblique| oblique.factor).unwrap()
    };
    let [e1, e2] = energies();
    let (corrected1, corrected2) = (e1 * factor(20.36), e2 * factor(43.36));
    assert_printed(corrected1, "1.16e5");
    assert_printed(corrected2, "7.31e4");
    assert_printed(corrected1 + corrected2, "1.89e5");
    // 20.36° is the angle of friction at the paper's μ_c.
    assert_close("α_1", 0.371_f64.atan().to_degrees(), 20.36, 0.01);
    // ERRATUM: "13 % below the total energy loss of the PIM solution". It is half a per cent above it.
    let difference = (corrected1 + corrected2) / reconciliation().outcome.energy.loss - 1.0;
    assert_close("the difference of the totals", difference, 0.005, 0.002);
    // ERRATUM: the text prints 1 + tan² 30° = 1.25.
    assert_printed(factor(30.0), "1.333");
}

/// The basis is a choice: if the energy is that absorbed at maximum engagement, less is dissipated, and the
/// speed is lower.
#[test]
fn absorbed_energy_asks_for_a_lower_speed() {
    let [e1, e2] = energies();
    let law = Law::new(RESTITUTION, Tangential::Critical).unwrap();
    let motions = [Motion::rest(), Motion::along(HEADINGS[1].to_radians(), 10.0 * MPH)];
    let absorbed = posed(contact(), law, motions, VehicleId::One, e1 + e2, EnergyBasis::Absorbed).unwrap();
    assert_relative("W_n", absorbed.normal_work_sought(), 0.91 * (e1 + e2), 1e-14);
    let answer = absorbed.solve().unwrap();
    assert_relative("W_n", answer.outcome.energy.normal_work, 0.91 * (e1 + e2), 1e-12);
    assert_relative("W_n", answer.normal_work, 0.91 * (e1 + e2), 1e-14);
    assert!(answer.speed < reconciliation().speed);
}
