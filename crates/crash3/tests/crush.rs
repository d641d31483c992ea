//! Crush energy, forces and velocity changes of `crash3`, compared with integrals, hand calculations and an
//! independent two-body impact.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crash3::{
    CrushError, EnergyBasis, ObliqueCorrection, Profile, Side, Stiffness, StruckVehicle, crush_energy,
    crush_range_from_force, delta_v, energy_equivalent_speed, equal_spacing, moment_arm, peak_force,
    zone_force,
};
use oracle::compare::{assert_close, assert_direction, assert_relative};
use oracle::scenes::{Scene, for_all, scene_under};
use pim_core::Tangential;
use proptest::prelude::*;

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// A profile in plain numbers: the depths, and one spacing fewer.
pub(crate) type Plain = (Vec<f64>, Vec<f64>);

/// 2 to 12 stations, some of them without crush.
pub(crate) fn profile() -> impl Strategy<Value = Plain> {
    let depth = || prop_oneof![1 => Just(0.0), 4 => 0.0..1.5];
    (2_usize..12).prop_flat_map(move |stations| {
        (proptest::collection::vec(depth(), stations), proptest::collection::vec(0.01..1.0, stations - 1))
    })
}

/// A, B and G as in stiffness tables, with G independent of A and B.
pub(crate) fn stiffness() -> impl Strategy<Value = (f64, f64, f64)> {
    (0.0..200e3, 0.0..3e6, 0.0..10e3)
}

pub(crate) fn make((depths, spacings): &Plain) -> Profile {
    Profile::new(depths.clone(), spacings.clone()).unwrap()
}

/// ∫ f over [0, end] by Simpson's rule, which is exact for cubics.
fn simpson(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    end / 6.0 * (f(0.0) + 4.0 * f(0.5 * end) + f(end))
}

/// ∫ over the zone's width of `f` at the depth there.
pub(crate) fn over_width((depths, spacings): &Plain, f: impl Fn(f64) -> f64) -> f64 {
    let zone =
        |i: usize| simpson(spacings[i], |w| f(depths[i] + (depths[i + 1] - depths[i]) * w / spacings[i]));
    (0..spacings.len()).map(zone).sum()
}

#[test]
fn the_energy_is_the_integral_of_the_force() {
    for_all(20_000, 1.0, (profile(), stiffness()), |(plain, (a, b, g))| {
        let energy = crush_energy(&make(&plain), &Stiffness::from_abg(a, b, g).unwrap());
        // ∫∫ (A + B c) dc dw + ∫ G dw
        let expected = over_width(&plain, |depth| simpson(depth, |c| a + b * c) + g);
        assert_relative("E", energy, expected, 1e-13);
        true
    });
}

#[test]
fn the_peak_force_is_the_integral_of_the_force_per_width() {
    for_all(5000, 1.0, (profile(), stiffness(), -1.5..1.5), |(plain, (a, b, g), angle)| {
        let force = peak_force(&make(&plain), &Stiffness::from_abg(a, b, g).unwrap(), angle).unwrap();
        let expected = over_width(&plain, |depth| a + b * depth) / angle.cos();
        assert_relative("F", force, expected, 1e-12);
        true
    });
}

/// The integrals of C and C²/2 over the width, their means, and the energy and force computed from them.
#[test]
fn the_sums_of_a_profile_are_integrals_and_give_its_energy_and_force() {
    for_all(5000, 0.9, (profile(), stiffness()), |(plain, (a, b, g))| {
        let (profile, stiffness) = (make(&plain), Stiffness::from_abg(a, b, g).unwrap());
        let sums = profile.sums();
        let width: f64 = plain.1.iter().sum();
        assert_relative("L", sums.width, width, 1e-15);
        assert_relative("S_1", sums.area, over_width(&plain, |depth| depth), 1e-13);
        assert_relative("S_2", sums.second_moment, over_width(&plain, |depth| depth * depth / 2.0), 1e-13);
        let (mean, square) = (sums.mean_depth(), sums.mean_square_depth());
        assert_relative("C̄", mean, over_width(&plain, |depth| depth) / width, 1e-13);
        assert_relative("Q", square, over_width(&plain, |depth| depth * depth) / width, 1e-13);
        let energy = a * sums.area + b * sums.second_moment + g * width;
        assert_relative("E", crush_energy(&profile, &stiffness), energy, 1e-12);
        let force: f64 = profile.zones().map(|zone| zone_force(zone, &stiffness)).sum();
        assert_relative("F", force, a * width + b * sums.area, 1e-12);
        assert_relative("F", peak_force(&profile, &stiffness, 0.0).unwrap(), force, 1e-14);
        sums.area > 0.0
    });
}

#[test]
fn a_station_on_the_line_between_two_changes_nothing() {
    for_all(
        5000,
        1.0,
        (profile(), stiffness(), any::<prop::sample::Index>(), 0.01..0.99),
        |((depths, spacings), (a, b, g), zone, share): (Plain, _, _, f64)| {
            let stiffness = Stiffness::from_abg(a, b, g).unwrap();
            let i = zone.index(spacings.len());
            let (mut more_depths, mut more_spacings) = (depths.clone(), spacings.clone());
            more_depths.insert(i + 1, depths[i] + share * (depths[i + 1] - depths[i]));
            more_spacings[i] = share * spacings[i];
            more_spacings.insert(i + 1, (1.0 - share) * spacings[i]);
            let (profile, finer) = (make(&(depths, spacings)), make(&(more_depths, more_spacings)));
            let energy = crush_energy(&profile, &stiffness);
            assert_relative("E", crush_energy(&finer, &stiffness), energy, 1e-12);
            let force = |profile: &Profile| peak_force(profile, &stiffness, 0.3).unwrap();
            assert_relative("F", force(&finer), force(&profile), 1e-12);
            assert_relative("L", finer.width(), profile.width(), 1e-12);
            true
        },
    );
}

#[test]
fn fewer_than_two_stations_have_no_spacing() {
    assert_eq!(
        [0, 1, 2, 5].map(|stations| equal_spacing(1.0, stations)),
        [f64::INFINITY, f64::INFINITY, 1.0, 0.25]
    );
}

#[test]
fn equal_spacing_is_a_case_of_given_spacing() {
    for_all(2000, 1.0, (profile(), 0.1..3.0), |((depths, _), width)| {
        let intervals = u32::try_from(depths.len() - 1).unwrap();
        let equal = Profile::equally_spaced(depths.clone(), width).unwrap();
        let given =
            Profile::new(depths.clone(), vec![width / f64::from(intervals); depths.len() - 1]).unwrap();
        assert_eq!(equal, given);
        assert_eq!(equal.depths(), depths);
        assert_relative("L", equal.width(), width, 1e-14);
        assert_eq!(equal.zones().count(), depths.len() - 1);
        for (i, zone) in equal.zones().enumerate() {
            assert_eq!(zone.depths, [depths[i], depths[i + 1]]);
        }
        true
    });
}

/// SAE 980025, Eq 5, with its brackets corrected (theory, section 5).
#[test]
fn six_stations_are_the_paper_s_eq_5() {
    let depths = || proptest::array::uniform6(0.0..1.5);
    for_all(5000, 1.0, (depths(), 0.1..3.0, stiffness()), |(depths, width, (a, b, g))| {
        let [c1, c2, c3, c4, c5, c6]: [f64; 6] = depths;
        let expected = (width / 5.0)
            * ((a / 2.0) * (c1 + 2.0 * c2 + 2.0 * c3 + 2.0 * c4 + 2.0 * c5 + c6)
                + (b / 6.0)
                    * (c1 * c1
                        + 2.0 * c2 * c2
                        + 2.0 * c3 * c3
                        + 2.0 * c4 * c4
                        + 2.0 * c5 * c5
                        + c6 * c6
                        + c1 * c2
                        + c2 * c3
                        + c3 * c4
                        + c4 * c5
                        + c5 * c6)
                + 5.0 * g);
        let profile = Profile::equally_spaced(depths.to_vec(), width).unwrap();
        let energy = crush_energy(&profile, &Stiffness::from_abg(a, b, g).unwrap());
        assert_relative("E", energy, expected, 1e-13);
        true
    });
}

/// By hand: L (A C + B C²/2 + A²/2B) = 1.5 (15,000 + 45,000 + 1,250), and with C from 0 to 0.3 m 1.5 (7,500 +
/// 15,000 + 1,250).
#[test]
fn simple_profiles_have_the_energy_that_a_hand_calculation_gives() {
    let stiffness = Stiffness::from_ab(50e3, 1e6).unwrap();
    let energy =
        |depths: &[f64]| crush_energy(&Profile::equally_spaced(depths.to_vec(), 1.5).unwrap(), &stiffness);
    assert_close("2 stations", energy(&[0.3; 2]), 91_875.0, 1e-9);
    assert_close("4 stations", energy(&[0.3; 4]), 91_875.0, 1e-9);
    assert_close("6 stations", energy(&[0.3; 6]), 91_875.0, 1e-9);
    assert_close("a wedge", energy(&[0.0, 0.3]), 35_625.0, 1e-9);
    assert_close("a wedge", energy(&[0.0, 0.06, 0.12, 0.18, 0.24, 0.3]), 35_625.0, 1e-9);
    // F = 1.5 (50 kN/m + 300 kN/m), and at 60° twice that.
    let uniform = Profile::equally_spaced(vec![0.3; 6], 1.5).unwrap();
    assert_close("F", peak_force(&uniform, &stiffness, 0.0).unwrap(), 525e3, 1e-8);
    assert_close("F at 60°", peak_force(&uniform, &stiffness, PI / 3.0).unwrap(), 1050e3, 1e-8);
}

#[test]
fn the_forms_of_stiffness_are_one() {
    for_all(5000, 1.0, (0.0..300.0, 10.0..2000.0), |(d0, d1): (f64, f64)| {
        let by_d = Stiffness::from_d0_d1(d0, d1).unwrap();
        let (a, b) = (d0 * d1, d1 * d1);
        let by_ab = Stiffness::from_ab(a, b).unwrap();
        let by_abg = Stiffness::from_abg(a, b, a * a / (2.0 * b)).unwrap();
        let by_dg = Stiffness::from_d0_d1_g(d0, d1, d0 * d0 / 2.0).unwrap();
        for stiffness in [by_d, by_ab, by_abg, by_dg] {
            assert_relative("A", stiffness.a(), a, 1e-14);
            assert_relative("B", stiffness.b(), b, 1e-14);
            assert_relative("G", stiffness.g(), 0.5 * d0 * d0, 1e-14);
        }
        true
    });
    let own = Stiffness::from_d0_d1_g(30.0, 1000.0, 7.0).unwrap();
    assert_eq!([own.a(), own.b(), own.g()], [30e3, 1e6, 7.0]);
}

/// (m₁, m₂), (I₁, I₂), (h₁, h₂), E.
type Vehicles = ([f64; 2], [f64; 2], [f64; 2], f64);

fn vehicles() -> impl Strategy<Value = Vehicles> {
    ([500.0..40e3, 500.0..40e3], [300.0..200e3, 300.0..200e3], [-3.0..3.0, -3.0..3.0], 0.0..1e6)
}

#[test]
fn velocity_changes_are_the_paper_s_eq_6_and_eq_7() {
    for_all(10_000, 1.0, vehicles(), |(masses, inertias, arms, energy)| {
        let inertia = [0, 1].map(|i| StruckVehicle::new(masses[i], inertias[i], arms[i]).unwrap());
        let [m1, m2] = masses;
        // γ = k²/(k² + h²),  k² = I/m
        let [g1, g2] = [0, 1].map(|i| {
            let k2 = inertias[i] / masses[i];
            k2 / (k2 + arms[i] * arms[i])
        });
        assert_relative("γ_1", inertia[0].effective_mass_ratio(), g1, 1e-14);
        assert_relative("γ_2", inertia[1].effective_mass_ratio(), g2, 1e-14);
        let eq6 = (2.0 * g1 * energy / (m1 * (1.0 + g1 * m1 / (g2 * m2)))).sqrt();
        let eq7 = (2.0 * g2 * energy / (m2 * (1.0 + g2 * m2 / (g1 * m1)))).sqrt();
        let [dv1, dv2] = delta_v(energy, inertia).unwrap();
        assert_relative("ΔV_1", dv1, eq6, 1e-13);
        assert_relative("ΔV_2", dv2, eq7, 1e-13);
        assert_relative("m ΔV", m1 * dv1, m2 * dv2, 1e-14);
        // The numbering of the vehicles does not matter.
        let [swapped2, swapped1] = delta_v(energy, [inertia[1], inertia[0]]).unwrap();
        assert_relative("ΔV_1", swapped1, dv1, 1e-14);
        assert_relative("ΔV_2", swapped2, dv2, 1e-14);
        true
    });
}

/// Against a barrier all the energy comes from one vehicle: ½ γ m ΔV² = E.
#[test]
fn a_barrier_takes_no_velocity() {
    for_all(2000, 1.0, vehicles(), |(masses, inertias, arms, energy)| {
        let car = StruckVehicle::new(masses[0], inertias[0], arms[0]).unwrap();
        let expected = (2.0 * energy * car.effective_mass_ratio() / masses[0]).sqrt();
        let [dv, none] = delta_v(energy, [car, StruckVehicle::fixed()]).unwrap();
        assert_relative("ΔV", dv, expected, 1e-13);
        assert_eq!(none, 0.0);
        assert_eq!(delta_v(energy, [StruckVehicle::fixed(), car]).unwrap(), [0.0, dv]);
        true
    });
    assert_eq!(StruckVehicle::<f64>::fixed().effective_mass_ratio(), 1.0);
}

/// A collinear impact of two point masses, from momentum and restitution alone.
#[test]
fn restitution_raises_velocity_changes_as_a_two_body_impact_does() {
    let points = ([500.0..40e3, 500.0..40e3], [1.0..60.0, -60.0..0.0], 0.0..0.999);
    for_all(10_000, 1.0, points, |([m1, m2], [v1, v2], e): ([f64; 2], [f64; 2], f64)| {
        let kinetic = |a: f64, b: f64| 0.5 * m1 * a * a + 0.5 * m2 * b * b;
        let common = (m1 * v1 + m2 * v2) / (m1 + m2);
        // Each body's velocity relative to the common one is reversed and multiplied by e.
        let [after1, after2] = [v1, v2].map(|v| common - e * (v - common));
        let absorbed = kinetic(v1, v2) - kinetic(common, common);
        let dissipated = kinetic(v1, v2) - kinetic(after1, after2);
        let at_cg = [m1, m2].map(|m| StruckVehicle::new(m, 1.0, 0.0).unwrap());
        for (basis, energy) in [(EnergyBasis::Dissipated, dissipated), (EnergyBasis::Absorbed, absorbed)] {
            let factor = basis.restitution_factor(e).unwrap();
            let [dv1, dv2] = delta_v(energy, at_cg).unwrap();
            // The energies are differences of larger numbers.
            let tolerance = 1e-13 * kinetic(v1, v2) / dissipated;
            assert_relative("ΔV_1", dv1 * factor, (after1 - v1).abs(), tolerance);
            assert_relative("ΔV_2", dv2 * factor, (after2 - v2).abs(), tolerance);
            assert_relative("W_n", basis.dissipated(energy, e), dissipated, tolerance);
        }
        true
    });
    assert_eq!(EnergyBasis::default(), EnergyBasis::Dissipated);
}

/// The two methods agree if the force is normal to the crush plane: CRASH3 with the energy of a frictionless
/// impact gives its ΔV.
#[test]
fn crash3_agrees_with_an_impact_without_friction() {
    for_all(10_000, 0.7, scene_under(Just(Tangential::Ratio(0.0))), |scene| {
        let Ok(outcome) = scene.impact() else { return false };
        let e = scene.restitution;
        if e > 0.999 {
            return false;
        }
        let arms = scene.contact().arms();
        let inertia = |i: usize| {
            let car = scene.cars[i];
            if car.fixed {
                StruckVehicle::fixed()
            } else {
                StruckVehicle::new(car.mass, car.mass * car.yaw_radius.powi(2), arms[i].tangential).unwrap()
            }
        };
        let dissipated = outcome.energy.normal_work;
        let absorbed = dissipated / (1.0 - e * e);
        for (basis, energy) in [(EnergyBasis::Dissipated, dissipated), (EnergyBasis::Absorbed, absorbed)] {
            let factor = basis.restitution_factor(e).unwrap();
            let dv = delta_v(energy, [inertia(0), inertia(1)]).unwrap();
            for (dv, expected) in dv.into_iter().zip(outcome.delta_v_magnitude()) {
                // W_n is known to a rounding error of ½ P_n u_n, of which it is the fraction 1 − e.
                assert_close(
                    "ΔV",
                    dv * factor,
                    expected,
                    expected * 1e-12 / (1.0 - e) * (1.0 + 60.0 / outcome.approach.normal.abs()),
                );
            }
        }
        true
    });
}

/// The arm of the impact force is the one that turns the vehicle: I ΔΩ = m ΔV h.
#[test]
fn the_moment_arm_is_the_one_that_the_impact_turns_the_vehicle_with() {
    for_all(10_000, 0.5, oracle::scenes::scene(), |scene: Scene| {
        // A moment impulse turns it too.
        let Ok(outcome) = scene.without_moment().impact() else { return false };
        let impulse = outcome.impulse_vector.norm();
        if impulse < 1.0 {
            return false;
        }
        for (i, car) in scene.cars.iter().enumerate().filter(|(_, car)| !car.fixed) {
            let (sin, cos) = car.angle.sin_cos();
            let h = moment_arm([car.distance * cos, car.distance * sin], outcome.pdof()[i]);
            let turn = outcome.after[i].yaw_rate - outcome.before[i].yaw_rate;
            let moment = (turn * car.mass * car.yaw_radius * car.yaw_radius).abs();
            // Yaw rates of some rad/s are accurate to 1e-15.
            let inertia = car.mass * car.yaw_radius * car.yaw_radius;
            let yaw = outcome.after[i].yaw_rate.abs() + car.yaw_rate.abs();
            assert_close("m ΔV h", impulse * h, moment, impulse * 6.0 * 1e-12 + inertia * yaw * 1e-14);
        }
        true
    });
}

#[test]
fn moment_arms_by_hand() {
    // A push from straight ahead on the left front corner passes the CG at the distance to the left.
    assert_close("from ahead", moment_arm([2.0, 0.7], 0.0), 0.7, 1e-15);
    assert_close("from the right", moment_arm([2.0, 0.7], FRAC_PI_2), 2.0, 1e-15);
    assert_close("from behind", moment_arm([2.0, -0.7], PI), 0.7, 1e-15);
    // The 3-4-5 triangle: a force from C towards the CG has no arm; the PDOF is clockwise, so C to the right
    // has a positive one.
    assert_close("through the CG", moment_arm([4.0, -3.0], f64::atan2(3.0, 4.0)), 0.0, 1e-15);
    assert_close("across", moment_arm([4.0, -3.0], f64::atan2(3.0, 4.0) + FRAC_PI_2), 5.0, 1e-14);
    // f = (−4, 3)/5 from the right front, at (4, 3): |4·3 − 3·(−4)|/5.
    assert_close("from the right front", moment_arm([4.0, 3.0], f64::atan2(3.0, 4.0)), 4.8, 1e-14);
}

#[test]
fn oblique_angles_are_measured_from_the_side_s_normal() {
    for (side, square) in
        [(Side::Front, 0.0), (Side::Right, FRAC_PI_2), (Side::Rear, PI), (Side::Left, -FRAC_PI_2)]
    {
        assert_eq!(side.square_pdof(), square);
        assert_close("a square hit", side.oblique_angle(square), 0.0, 0.0);
        for_all(1000, 1.0, -PI..PI, |pdof| {
            let angle = side.oblique_angle(pdof);
            assert!(angle > -PI && angle <= PI, "{angle}");
            assert_direction("α", angle, pdof - square, 1e-15 * 8.0);
            true
        });
    }
    // From the opposite side: half a turn is positive.
    assert_eq!(Side::Rear.oblique_angle(0.0), PI);
    assert_eq!(Side::Right.oblique_angle(-FRAC_PI_2), PI);
    assert_eq!(Side::Left.oblique_angle(FRAC_PI_2), PI);
    let degrees = |side: Side, pdof: f64| side.oblique_angle(pdof.to_radians()).to_degrees();
    assert_close("clockwise", degrees(Side::Front, 20.0), 20.0, 1e-13);
    assert_close("counter-clockwise", degrees(Side::Right, 60.0), -30.0, 1e-13);
    assert_close("behind, on the right", degrees(Side::Rear, 170.0), -10.0, 1e-12);
    assert_close("behind, on the left", degrees(Side::Rear, -170.0), 10.0, 1e-12);
    assert_close("across the jump", degrees(Side::Left, 180.0), -90.0, 1e-12);
}

/// SAE 980025, Eq 8: 1 + tan²α; CRASH3 limits α to 45°.
#[test]
fn the_oblique_factor_is_limited_at_45_degrees() {
    for_all(5000, 1.0, -1.5..1.5, |angle: f64| {
        let exact = 1.0 + angle.tan().powi(2);
        let uncapped = ObliqueCorrection::Uncapped.factor(angle).unwrap();
        assert_relative("1 + tan²α", uncapped.factor, exact, 1e-13);
        assert!(!uncapped.capped);
        let capped = ObliqueCorrection::Capped.factor(angle).unwrap();
        assert_relative("limited", capped.factor, exact.min(2.0), 1e-13);
        assert_eq!(capped.capped, angle.abs() > FRAC_PI_4);
        let none = ObliqueCorrection::None.factor(angle).unwrap();
        assert_eq!((none.factor, none.capped), (1.0, false));
        true
    });
    for angle in [FRAC_PI_4, -FRAC_PI_4] {
        let at_limit = ObliqueCorrection::Capped.factor(angle).unwrap();
        assert_relative("at 45°", at_limit.factor, 2.0, 1e-15);
        assert!(!at_limit.capped);
        // Nor one rounding error beyond.
        for ulps in [1, 2] {
            let next = f64::from_bits(FRAC_PI_4.to_bits() + ulps);
            assert!(!ObliqueCorrection::Capped.factor(next).unwrap().capped);
        }
        let beyond = ObliqueCorrection::Capped.factor(angle * (1.0 + 1e-9)).unwrap();
        assert_eq!((beyond.factor, beyond.capped), (2.0, true));
    }
    assert_eq!(ObliqueCorrection::<f64>::default(), ObliqueCorrection::Capped);
}

#[test]
fn a_force_along_or_from_behind_the_side_does_not_push() {
    let profile = Profile::equally_spaced(vec![0.3; 2], 1.5).unwrap();
    let stiffness = Stiffness::from_ab(50e3, 1e6).unwrap();
    for angle in [FRAC_PI_2, -FRAC_PI_2, 2.0, -3.0, PI, f64::NAN, f64::INFINITY] {
        for correction in [ObliqueCorrection::Capped, ObliqueCorrection::Uncapped] {
            let refused = correction.factor(angle);
            assert!(
                matches!(refused, Err(CrushError::NotPushing { angle: named }) if named.to_bits() == angle.to_bits())
            );
        }
        assert!(matches!(peak_force(&profile, &stiffness, angle), Err(CrushError::NotPushing { .. })));
    }
    for angle in [FRAC_PI_2, 3.0] {
        assert_eq!(ObliqueCorrection::None.factor(angle).unwrap().factor, 1.0);
    }
    // A degree below 90° is still accepted.
    assert!(ObliqueCorrection::Capped.factor(89_f64.to_radians()).is_ok());
    assert_eq!(
        ObliqueCorrection::Capped.factor(2.0).unwrap_err().to_string(),
        "a force at 114.6° to the normal of the damaged side does not push on it: |α| must be less than 90°"
    );
}

#[test]
fn the_energy_equivalent_speed_is_the_speed_of_that_energy() {
    for_all(2000, 1.0, (500.0..40e3, 0.0..60.0), |(mass, speed): (f64, f64)| {
        let ees = energy_equivalent_speed(0.5 * mass * speed * speed, mass).unwrap();
        assert_relative("EES", ees, speed, 1e-14);
        true
    });
    assert_eq!(energy_equivalent_speed(0.0, 1500.0), Ok(0.0));
}

#[test]
fn profiles_refuse_what_no_damage_can_be() {
    let few = |stations| Err(CrushError::TooFewStations { stations });
    assert_eq!(Profile::<f64>::new(vec![], vec![]), few(0));
    assert_eq!(Profile::new(vec![0.1], vec![]), few(1));
    assert_eq!(Profile::<f64>::equally_spaced(vec![], 1.0), few(0));
    assert_eq!(Profile::equally_spaced(vec![0.1], 1.0), few(1));
    for spacings in [0, 1, 3] {
        assert_eq!(
            Profile::new(vec![0.1; 3], vec![0.2; spacings]),
            Err(CrushError::SpacingCount { stations: 3, spacings })
        );
    }
    assert_eq!(
        CrushError::SpacingCount { stations: 3, spacings: 1 }.to_string(),
        "3 stations need 2 spacings between them, but 1 are given"
    );
    for at in 0..3 {
        let with = |bad: f64| {
            let mut depths = vec![0.1; 3];
            depths[at] = bad;
            Profile::new(depths, vec![0.2; 2])
        };
        assert_eq!(with(-0.01), Err(CrushError::Negative { what: "crush depth", value: -0.01 }));
        assert!(with(0.0).is_ok());
        for bad in NOT_FINITE {
            assert!(matches!(with(bad), Err(CrushError::NotFinite { what: "crush depth", .. })));
        }
    }
    for at in 0..2 {
        let with = |bad: f64| {
            let mut spacings = vec![0.2; 2];
            spacings[at] = bad;
            Profile::new(vec![0.1; 3], spacings)
        };
        for bad in [0.0, -0.2] {
            assert!(matches!(with(bad), Err(CrushError::NotPositive { value, .. }) if value == bad));
        }
        for bad in NOT_FINITE {
            assert!(matches!(with(bad), Err(CrushError::NotFinite { .. })));
        }
    }
    for bad in [0.0, -1.0] {
        assert_eq!(
            Profile::equally_spaced(vec![0.1; 3], bad),
            Err(CrushError::NotPositive { what: "damage width", value: bad })
        );
    }
    for bad in NOT_FINITE {
        assert!(matches!(
            Profile::equally_spaced(vec![0.1; 3], bad),
            Err(CrushError::NotFinite { what: "damage width", .. })
        ));
    }
}

#[test]
fn stiffnesses_refuse_what_no_structure_has() {
    let good = [50e3, 1e6, 1e3];
    for (at, name) in [(0, "stiffness A"), (1, "stiffness B"), (2, "stiffness G")] {
        let with = |bad: f64| {
            let mut all = good;
            all[at] = bad;
            let [a, b, g] = all;
            Stiffness::from_abg(a, b, g)
        };
        assert_eq!(with(-1.0), Err(CrushError::Negative { what: name, value: -1.0 }));
        assert!(with(0.0).is_ok());
        for bad in NOT_FINITE {
            assert!(matches!(with(bad), Err(CrushError::NotFinite { what, .. }) if what == name));
        }
    }
    assert_eq!(Stiffness::from_ab(50e3, 0.0), Err(CrushError::NoRise));
    assert_eq!(
        Stiffness::from_ab(50e3, -1.0),
        Err(CrushError::NotPositive { what: "stiffness B", value: -1.0 })
    );
    assert_eq!(Stiffness::from_ab(-1.0, 1e6), Err(CrushError::Negative { what: "stiffness A", value: -1.0 }));
    for bad in NOT_FINITE {
        assert!(matches!(
            Stiffness::from_ab(bad, 1e6),
            Err(CrushError::NotFinite { what: "stiffness A", .. })
        ));
        assert!(matches!(
            Stiffness::from_ab(50e3, bad),
            Err(CrushError::NotFinite { what: "stiffness B", .. })
        ));
        assert!(matches!(
            Stiffness::from_d0_d1(bad, 1e3),
            Err(CrushError::NotFinite { what: "stiffness d0", .. })
        ));
        assert!(matches!(
            Stiffness::from_d0_d1(50.0, bad),
            Err(CrushError::NotFinite { what: "stiffness d1", .. })
        ));
        assert!(matches!(
            Stiffness::from_d0_d1_g(50.0, 1e3, bad),
            Err(CrushError::NotFinite { what: "stiffness G", .. })
        ));
    }
    // Both negative: their product A would pass.
    assert_eq!(
        Stiffness::from_d0_d1(-50.0, -1e3),
        Err(CrushError::Negative { what: "stiffness d0", value: -50.0 })
    );
    assert_eq!(
        Stiffness::from_d0_d1(50.0, -1e3),
        Err(CrushError::Negative { what: "stiffness d1", value: -1e3 })
    );
    assert_eq!(
        Stiffness::from_d0_d1_g(50.0, 1e3, -1.0),
        Err(CrushError::Negative { what: "stiffness G", value: -1.0 })
    );
}

#[test]
fn velocity_changes_refuse_what_no_vehicle_has() {
    for bad in [0.0, -1.0] {
        assert_eq!(
            StruckVehicle::new(bad, 1.0, 0.0),
            Err(CrushError::NotPositive { what: "mass", value: bad })
        );
        assert_eq!(
            StruckVehicle::new(1.0, bad, 0.0),
            Err(CrushError::NotPositive { what: "yaw inertia", value: bad })
        );
        assert_eq!(
            energy_equivalent_speed(1.0, bad),
            Err(CrushError::NotPositive { what: "mass", value: bad })
        );
    }
    for bad in NOT_FINITE {
        let not_finite =
            |error: CrushError| assert!(matches!(error, CrushError::NotFinite { .. }), "{error:?}");
        not_finite(StruckVehicle::new(bad, 1.0, 0.0).unwrap_err());
        not_finite(StruckVehicle::new(1.0, bad, 0.0).unwrap_err());
        not_finite(StruckVehicle::new(1.0, 1.0, bad).unwrap_err());
        not_finite(delta_v(bad, [StruckVehicle::new(1.0, 1.0, 0.0).unwrap(); 2]).unwrap_err());
        not_finite(energy_equivalent_speed(bad, 1.0).unwrap_err());
        not_finite(energy_equivalent_speed(1.0, bad).unwrap_err());
    }
    let car = StruckVehicle::new(1500.0, 2700.0, 0.5).unwrap();
    let negative = CrushError::Negative { what: "crush energy", value: -1.0 };
    assert_eq!(delta_v(-1.0, [car; 2]), Err(negative));
    assert_eq!(energy_equivalent_speed(-1.0, 1500.0), Err(negative));
    assert_eq!(delta_v(0.0, [car; 2]), Ok([0.0; 2]));
    assert_eq!(delta_v(1.0, [StruckVehicle::fixed(); 2]), Err(CrushError::BothFixed));
    for basis in [EnergyBasis::Dissipated, EnergyBasis::Absorbed] {
        for bad in [1.0, 1.5, -0.1, f64::NAN, f64::INFINITY] {
            let refused = basis.restitution_factor(bad);
            assert!(
                matches!(refused, Err(CrushError::Restitution { value }) if value.to_bits() == bad.to_bits())
            );
        }
        assert_eq!(basis.restitution_factor(0.0), Ok(1.0));
    }
}

/// 200 kN on a side of 2 m with 50 kN/m at first and 850 kN/m at a depth of 1 m, that of the CG: widths from
/// 0.235 m to 2 m are possible. The nominal width is the given one, or the nearest of these.
#[test]
fn an_inferred_crush_has_the_nearest_possible_width() {
    let stiffness = Stiffness::from_abg(50e3, 800e3, 3125.0).unwrap();
    let narrowest = 200e3 / 850e3;
    for (asked, width) in [(0.1, narrowest), (1.0, 1.0), (3.0, 2.0)] {
        let range = crush_range_from_force(200e3, 0.0, &stiffness, asked, 2.0, 1.0).unwrap();
        assert_relative("w", range.nominal.width, width, 1e-12);
        assert_relative("C", range.nominal.depth, (200e3 / width - 50e3) / 800e3, 1e-12);
    }
}

/// Up to G = A²/B = 3125 N the widest damage takes the least energy; a greater G moves the minimum to F/√(2BG
/// − A²), and can move the maximum to the widest.
#[test]
fn the_least_energy_is_not_always_that_of_the_widest_damage() {
    for (g, least, greatest) in [
        (1562.5, 2.0, 200e3 / 850e3),
        (3125.0, 2.0, 200e3 / 850e3),
        (20e3, 200e3 / 29.5e9_f64.sqrt(), 200e3 / 850e3),
        (80e3, 200e3 / 125.5e9_f64.sqrt(), 2.0),
    ] {
        let stiffness = Stiffness::from_abg(50e3, 800e3, g).unwrap();
        let range = crush_range_from_force(200e3, 0.0, &stiffness, 1.0, 2.0, 1.0).unwrap();
        assert_relative("least", range.lowest.width, least, 1e-12);
        assert_relative("greatest", range.highest.width, greatest, 1e-12);
        // E = w (A C + B C²/2 + G) at every width between.
        for step in 0..=1000 {
            let width = 200e3 / 850e3 + (2.0 - 200e3 / 850e3) * f64::from(step) / 1000.0;
            let depth = (200e3 / width - 50e3) / 800e3;
            let energy = width * (50e3 * depth + 400e3 * depth * depth + g);
            let rounding = 1e-12 * energy;
            assert!(energy >= range.lowest.energy - rounding && energy <= range.highest.energy + rounding);
        }
    }
}
