//! The point and direction of the force, and the crush that it implies for a vehicle that could not be
//! inspected.

use std::f64::consts::PI;

use crash3::{
    CrushError, DamagedFace, ObliqueCorrection, Profile, Side, SideStiffness, Stiffness, StruckVehicle,
    crush_energy, crush_from_force, crush_range_from_force, delta_v, moment_arm, opposite_pdof, peak_force,
};
use oracle::compare::{assert_close, assert_direction, assert_relative};
use oracle::scenes::{for_all, scene};
use proptest::prelude::*;

use crate::crush::{Plain, make, profile};

/// The centroid of the damage, forward and left, from a grid of small squares over the vehicle, each of which
/// is damaged or not.
fn centroid_by_grid(side: Side, distance: f64, offset: f64, (depths, spacings): &Plain) -> [f64; 2] {
    const CELLS: u32 = 300;
    let width: f64 = spacings.iter().sum();
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let depth_at = |s: f64| {
        let mut start = 0.0;
        for (ends, &w) in depths.windows(2).zip(spacings) {
            if s <= start + w {
                return ends[0] + (ends[1] - ends[0]) * (s - start) / w;
            }
            start += w;
        }
        depths[depths.len() - 1]
    };
    let (mut count, mut forward, mut left) = (0.0, 0.0, 0.0);
    for i in 0..CELLS {
        let s = (f64::from(i) + 0.5) / f64::from(CELLS) * width;
        for j in 0..CELLS {
            let deep = (f64::from(j) + 0.5) / f64::from(CELLS) * deepest;
            if deep > depth_at(s) {
                break;
            }
            // The driver looks forward: left to right on front and rear, rear to front on the sides.
            let (f, l) = match side {
                Side::Front => (distance - deep, offset + width / 2.0 - s),
                Side::Rear => (deep - distance, offset + width / 2.0 - s),
                Side::Left => (offset - width / 2.0 + s, distance - deep),
                Side::Right => (offset - width / 2.0 + s, deep - distance),
            };
            count += 1.0;
            forward += f;
            left += l;
        }
    }
    [forward / count, left / count]
}

/// A structure whose energy per width equals the depth: its centroid is that of the area.
fn even() -> SideStiffness {
    SideStiffness::Uniform(Stiffness::from_abg(1.0, 0.0, 0.0).unwrap())
}

#[test]
fn the_centroid_is_that_of_the_damaged_area() {
    let crushed = profile().prop_filter("crush", |(depths, _)| depths.iter().any(|depth| *depth > 0.01));
    let sides = prop::sample::select(vec![Side::Front, Side::Rear, Side::Left, Side::Right]);
    for_all(60, 1.0, (crushed, sides, 0.5..3.0, -1.0..1.0), |(plain, side, distance, offset)| {
        let [forward, left] =
            DamagedFace::new(side, distance, offset).unwrap().centroid(&make(&plain), &even()).unwrap();
        let [f, l] = centroid_by_grid(side, distance, offset, &plain);
        let width: f64 = plain.1.iter().sum();
        // About one cell of 300 in each direction.
        let cell = width.max(1.5) / 100.0;
        assert_close("forward", forward, f, cell);
        assert_close("left", left, l, cell);
        true
    });
}

/// Triangles and rectangles by hand: the centroid of a triangle lies a third from its deep end, a third of
/// its depth below the face.
#[test]
fn simple_damage_has_the_centroid_of_a_hand_calculation() {
    let at = |side, depths: [f64; 2]| {
        let profile = Profile::equally_spaced(depths.to_vec(), 1.2).unwrap();
        DamagedFace::new(side, 2.0, 0.3).unwrap().centroid(&profile, &even()).unwrap()
    };
    for (side, depths, [forward, left]) in [
        (Side::Front, [0.4, 0.4], [1.8, 0.3]),
        // Deep on the left: 0.2 m to the left of the middle.
        (Side::Front, [0.6, 0.0], [1.8, 0.5]),
        (Side::Rear, [0.6, 0.0], [-1.8, 0.5]),
        // Deep at the rear end of the damage: 0.2 m behind its middle.
        (Side::Left, [0.6, 0.0], [0.1, 1.8]),
        (Side::Right, [0.6, 0.0], [0.1, -1.8]),
        (Side::Right, [0.0, 0.6], [0.5, -1.8]),
        // No crush: the middle of the damage on the face.
        (Side::Left, [0.0, 0.0], [0.3, 2.0]),
    ] {
        let [f, l] = at(side, depths);
        assert_close(&format!("{side:?} {depths:?}, forward"), f, forward, 1e-14);
        assert_close(&format!("{side:?} {depths:?}, left"), l, left, 1e-14);
    }
    for [distance, offset] in [[0.0, 0.0], [-1.0, 0.0], [f64::NAN, 0.0], [2.0, f64::INFINITY]] {
        assert!(DamagedFace::new(Side::Front, distance, offset).is_err());
    }
}

/// `pim-core` computes both PDOFs from one impulse: each follows from the other and the headings.
#[test]
fn the_other_vehicle_s_pdof_follows_by_newton_s_third_law() {
    for_all(2000, 0.5, scene(), |scene| {
        let Ok(outcome) = scene.impact() else { return false };
        if outcome.impulse_vector.norm() < 1.0 {
            return false;
        }
        let [first, second] = outcome.pdof();
        let [h1, h2] = scene.cars.map(|car| car.heading);
        assert_direction("of vehicle 2", opposite_pdof(first, [h1, h2]), second, 1e-9);
        assert_direction("of vehicle 1", opposite_pdof(second, [h2, h1]), first, 1e-9);
        true
    });
}

#[test]
fn opposite_pdofs_by_hand() {
    let degrees = |pdof: f64, own: f64, other: f64| {
        opposite_pdof(pdof.to_radians(), [own.to_radians(), other.to_radians()]).to_degrees()
    };
    for (pdof, own, other, expected) in [
        // Head on: both struck in front. From behind: one in front, one in the rear.
        (0.0, 0.0, 180.0, 0.0),
        (0.0, 30.0, 30.0, 180.0),
        // Vehicle 2 goes to the left (north) and is struck in its left side by one that goes east.
        (0.0, 0.0, 90.0, -90.0),
        (20.0, 0.0, 90.0, -70.0),
        (10.0, 720.0, -540.0, 10.0),
    ] {
        assert_close("PDOF", degrees(pdof, own, other), expected, 1e-9);
    }
    assert!((-PI..=PI).contains(&opposite_pdof(1.0, [-700.0, 900.0])));
}

/// Structures with an independent G near A²/2B, limited or not, and a width and a depth.
fn uniform() -> impl Strategy<Value = (Stiffness, f64, f64, f64)> {
    (5e3..100e3, 1e5..3e6, 0.9..1.1, 0.3..3.0, 0.0..1.0, -1.2..1.2).prop_map(
        |(a, b, share, width, depth, angle): (f64, f64, f64, f64, f64, f64)| {
            (Stiffness::from_abg(a, b, share * a * a / (2.0 * b)).unwrap(), width, depth, angle)
        },
    )
}

/// The peak force of a uniform crush gives back that crush and its energy.
#[test]
fn a_force_gives_the_uniform_crush_back_that_made_it() {
    for_all(3000, 1.0, uniform(), |(stiffness, width, depth, angle)| {
        let profile = Profile::equally_spaced(vec![depth; 2], width).unwrap();
        for stiffness in [stiffness, stiffness.with_saturation_force(stiffness.force_per_width(1.0)).unwrap()]
        {
            let force = peak_force(&profile, &stiffness, angle).unwrap();
            let inferred = crush_from_force(force, angle, width, &stiffness).unwrap();
            assert_close("C", inferred.depth, depth, 1e-12);
            assert_relative("E", inferred.energy, crush_energy(&profile, &stiffness), 1e-12);
            assert_eq!(inferred.width.to_bits(), width.to_bits());
        }
        true
    });
}

#[test]
fn a_force_that_leaves_no_crush_is_stored_elastically() {
    let stiffness = Stiffness::from_ab(50e3, 1e6).unwrap();
    // A w = 75 kN. G = A²/2B = 1250 N: the spring of slope B takes (F/w)²/2B per width.
    let half = crush_from_force(37.5e3, 0.0, 1.5, &stiffness).unwrap();
    assert_eq!(half.depth, 0.0);
    assert_relative("E", half.energy, 1.5 * 25e3_f64.powi(2) / 2e6, 1e-14);
    let all = crush_from_force(75e3, 0.0, 1.5, &stiffness).unwrap();
    assert_eq!(all.depth, 0.0);
    assert_relative("w G", all.energy, 1.5 * 1250.0, 1e-14);
    // An oblique force of 75 kN has a smaller normal component.
    let oblique = crush_from_force(75e3, 60_f64.to_radians(), 1.5, &stiffness).unwrap();
    assert_relative("oblique", oblique.energy, half.energy, 1e-14);
}

#[test]
fn forces_that_no_crush_bears_are_refused() {
    let stiffness = Stiffness::from_ab(50e3, 1e6).unwrap().with_saturation_force(200e3).unwrap();
    assert_eq!(
        crush_from_force(400e3, 0.0, 1.5, &stiffness).unwrap_err().to_string(),
        "the force of the other vehicle requires 266667 N/m, more than the limit of 200000 N/m, so the crush cannot be \
         inferred"
    );
    assert!(crush_from_force(300e3, 0.0, 1.5, &stiffness).is_ok());
    assert!(crush_from_force(300e3 * (1.0 + 1e-12), 0.0, 1.5, &stiffness).is_err());
    let level = Stiffness::from_abg(50e3, 0.0, 10.0).unwrap();
    assert_eq!(crush_from_force(80e3, 0.0, 1.5, &level), Err(CrushError::NoCrushFromForce));
    assert!(matches!(crush_from_force(80e3, 1.6, 1.5, &stiffness), Err(CrushError::NotPushing { .. })));
    for (force, width) in [(0.0, 1.5), (-1.0, 1.5), (80e3, 0.0), (f64::NAN, 1.5)] {
        assert!(crush_from_force(force, 0.0, width, &stiffness).is_err());
    }
    // 200 kN/m over 1.5 m is all that the side can bear.
    assert_eq!(
        crush_range_from_force(301e3, 0.0, &stiffness, 1.0, 1.5, 0.9).unwrap_err().to_string(),
        "the force of the other vehicle is 301000 N, but the damaged side can bear no more than 300000 N, even \
         if it is crushed over its whole length and as deep as the centre of gravity"
    );
    for [nominal, widest, deepest] in [[0.0, 1.5, 0.9], [1.0, -1.5, 0.9], [1.0, 1.5, f64::NAN]] {
        assert!(crush_range_from_force(100e3, 0.0, &stiffness, nominal, widest, deepest).is_err());
    }
}

/// No width between the narrowest and the widest gives an energy outside the bounds.
#[test]
fn the_bounds_hold_every_width_that_is_possible() {
    let limit = (0.2..1.5, any::<bool>());
    // An independent G, from zero to four times A²/2B.
    let g = 0.0..4.0;
    for_all(
        1500,
        0.3,
        (uniform(), limit, g, 0.05..1.0),
        |((given, width, depth, angle), (knee, is_limited), g, share)| {
            let (a, b) = (given.a(), given.b());
            let mut stiffness = Stiffness::from_abg(a, b, g * a * a / (2.0 * b)).unwrap();
            if is_limited {
                stiffness = stiffness.with_saturation_force(a + b * knee).unwrap();
            }
            let (widest, deepest) = (3.5, 1.2);
            let profile = Profile::equally_spaced(vec![depth; 2], width).unwrap();
            let force = peak_force(&profile, &stiffness, angle).unwrap();
            let range = crush_range_from_force(force, angle, &stiffness, width, widest, deepest).unwrap();
            let narrow = force * angle.cos() / stiffness.force_per_width(deepest);
            let wide = widest.min(force * angle.cos() / a);
            // Without residual crush the nominal width is the widest, but for rounding.
            assert!(range.lowest.energy <= range.nominal.energy * (1.0 + 1e-12), "{range:?}");
            assert!(range.nominal.energy <= range.highest.energy * (1.0 + 1e-12), "{range:?}");
            let w = narrow * (1.0 + 1e-9) + share * (wide - narrow) * (1.0 - 1e-9);
            let at = crush_from_force(force, angle, w, &stiffness).unwrap();
            assert!(at.energy >= range.lowest.energy * (1.0 - 1e-9), "{at:?} {range:?}");
            assert!(at.energy <= range.highest.energy * (1.0 + 1e-9), "{at:?} {range:?}");
            // The true width lies within, and is the nominal one here.
            assert_relative("nominal", range.nominal.width, width, 1e-12);
            true
        },
    );
}

/// (J/m) ∫ min(A + B c, F_s) dc + G up to the depth, by brute force.
fn integrated(stiffness: &Stiffness, depth: f64) -> f64 {
    let steps = 20_000;
    let dc = depth / f64::from(steps);
    let force = |c: f64| {
        let rising = stiffness.a() + stiffness.b() * c;
        stiffness.saturation_force().map_or(rising, |limit| rising.min(limit))
    };
    (0..steps).map(|i| force((f64::from(i) + 0.5) * dc) * dc).sum::<f64>() + stiffness.g()
}

/// The bounds are tight: some width reaches each of them.
#[test]
fn the_bounds_are_reached() {
    let shape = (uniform(), (0.2..1.5, any::<bool>()), 0.0..40.0, [0.5..4.0, 0.3..1.5, 0.2..3.0]);
    for_all(
        1000,
        0.5,
        shape,
        |((given, width, depth, _), (knee, is_limited), g, [widest, deepest, nominal])| {
            let (a, b) = (given.a(), given.b());
            let mut stiffness = Stiffness::from_abg(a, b, g * a * a / (2.0 * b)).unwrap();
            if is_limited {
                stiffness = stiffness.with_saturation_force(a + b * knee).unwrap();
            }
            let force = peak_force(&Profile::equally_spaced(vec![depth; 2], width).unwrap(), &stiffness, 0.0)
                .unwrap();
            let narrow = force / stiffness.force_per_width(deepest);
            let range = match crush_range_from_force(force, 0.0, &stiffness, nominal, widest, deepest) {
                Ok(range) => {
                    assert!(narrow <= widest);
                    range
                }
                Err(error) => {
                    assert!(matches!(error, CrushError::ForceTooGreat { .. }) && narrow > widest, "{error}");
                    return false;
                }
            };
            let wide = widest.min(force / a);
            assert_relative("nominal", range.nominal.width, nominal.clamp(narrow, wide), 1e-12);
            // The narrowest damage may be as deep as the CG; all others are as deep as the force makes them.
            let deep = narrow * integrated(&stiffness, deepest);
            let energies: Vec<f64> = (0..=2000)
                .map(|i| narrow * (1.0 + 1e-9) + f64::from(i) / 2000.0 * (wide - narrow) * (1.0 - 1e-9))
                .map(|width| crush_from_force(force, 0.0, width, &stiffness).unwrap().energy)
                .chain([deep])
                .collect();
            let lowest = energies.iter().copied().fold(f64::INFINITY, f64::min);
            let highest = energies.iter().copied().fold(0.0, f64::max);
            assert_relative("lowest", range.lowest.energy, lowest, 1e-5);
            assert_relative("highest", range.highest.energy, highest, 1e-5);
            true
        },
    );
}

#[test]
fn the_bounds_by_hand() {
    let stiffness = Stiffness::from_ab(50e3, 1e6).unwrap();
    // 600 kN. As deep as the CG, 0.8 m: f = 850 kN/m, w = 0.70588 m, E = w (40 + 320 + 1.25) kJ.
    let range = crush_range_from_force(600e3, 0.0, &stiffness, 1.5, 4.0, 0.8).unwrap();
    assert_relative("narrowest", range.highest.width, 600.0 / 850.0, 1e-14);
    assert_relative("highest", range.highest.energy, 600.0 / 850.0 * 361.25e3, 1e-13);
    assert_eq!(range.highest.depth, 0.8);
    // Over the side's 4 m: 150 kN/m, C = 0.1 m, E = 4 (5 + 5 + 1.25) kJ.
    assert_relative("lowest", range.lowest.energy, 45e3, 1e-13);
    assert_relative("lowest", range.lowest.depth, 0.1, 1e-13);
    // Over 1.5 m: 400 kN/m, C = 0.35 m, E = 1.5 (17.5 + 61.25 + 1.25) kJ.
    assert_relative("nominal", range.nominal.energy, 120e3, 1e-13);
    // 150 kN leave no crush on 3 m or more: the widest damage is 3 m wide, with w G = 3.75 kJ.
    let weak = crush_range_from_force(150e3, 0.0, &stiffness, 5.0, 4.0, 0.8).unwrap();
    assert_relative("widest", weak.lowest.width, 3.0, 1e-14);
    assert_relative("widest", weak.lowest.energy, 3750.0, 1e-13);
    assert_eq!(weak.nominal, weak.lowest);
    // Limited to 250 kN/m, reached at 0.2 m: at a depth of 0.8 m, E/w = 10 + 20 + 250·0.6 + 1.25 kJ/m, over
    // 600/250 m.
    let limited = stiffness.with_saturation_force(250e3).unwrap();
    let range = crush_range_from_force(600e3, 0.0, &limited, 1.5, 4.0, 0.8).unwrap();
    assert_relative("narrowest", range.highest.width, 2.4, 1e-14);
    assert_relative("highest", range.highest.energy, 2.4 * 181.25e3, 1e-13);
    assert_eq!(range.highest.depth, 0.8);
    assert_relative("lowest", range.lowest.energy, 45e3, 1e-13);
    // 1.5 m cannot bear it: the nearest width that can is 2.4 m, with a crush of 0.2 m: E/w = 10 + 20 + 1.25
    // kJ/m.
    assert_relative("nominal", range.nominal.width, 2.4, 1e-14);
    assert_relative("nominal", range.nominal.energy, 2.4 * 31.25e3, 1e-12);
}

/// One RICSAC collision: masses (kg), yaw inertias (kg·m²), Γ, θ_1, θ_2, φ_1, φ_2 (°), d_1, d_2 (ft), μ, the
/// struck face of vehicle 2, and Table 3's rows: change of the PDOF (°, counter-clockwise), ΔV_1, ΔV_2
/// (ft/s). Energies in ft·lb.
struct Staged {
    test: u8,
    masses: [f64; 2],
    inertias: [f64; 2],
    angles: [f64; 5],
    distances: [f64; 2],
    impulse_ratio: f64,
    struck: Side,
    energies: [f64; 2],
    tolerance: f64,
    rows: [[f64; 3]; 5],
}

/// SAE 980025, Table 3, with the misprints of test 5 corrected (theory, section 8). Geometry: Vossou and
/// Koulocheris (2018); μ: Brach, SAE 871993; masses and inertias: Neades, Appendix D, with the misprint of
/// test 7's vehicle 2 corrected (771 kg for 1184 kg, which the ratio of the ΔV shows; its inertia is in
/// proportion). The distances d and the energies were never published: d follows from the other figures of
/// the paper, and the two energies of each test are fitted to the table's ten numbers. So ten numbers test
/// two.
const TABLE_3: [Staged; 6] = [
    Staged {
        test: 1,
        masses: [2096.0, 1398.0],
        inertias: [5054.0, 2659.0],
        angles: [-30.0, 0.0, 60.0, -19.8, -38.7],
        distances: [7.59, 3.44],
        impulse_ratio: 0.966,
        struck: Side::Right,
        energies: [19_760.0, 26_133.0],
        tolerance: 0.1,
        rows: [
            [20.0, 24.09, 35.92],
            [10.0, 19.78, 29.49],
            [0.0, 17.71, 26.4],
            [-10.0, 16.63, 24.8],
            [-20.0, 16.01, 23.87],
        ],
    },
    Staged {
        test: 3,
        masses: [2244.0, 1415.0],
        inertias: [5413.0, 2692.0],
        angles: [-10.0, 0.0, 170.0, -17.0, 171.4],
        distances: [7.3, 8.19],
        impulse_ratio: -0.065,
        struck: Side::Rear,
        energies: [4345.0, 1797.0],
        tolerance: 0.1,
        rows: [
            [10.0, 5.15, 8.15],
            [5.0, 5.41, 8.57],
            [0.0, 5.64, 8.93],
            [-5.0, 5.8, 9.19],
            [-10.0, 5.89, 9.34],
        ],
    },
    Staged {
        test: 4,
        masses: [2259.0, 1447.0],
        inertias: [5447.0, 2752.0],
        angles: [-10.0, 0.0, 170.0, -18.2, 171.7],
        distances: [5.4, 8.1],
        impulse_ratio: -0.05,
        struck: Side::Rear,
        energies: [11_203.0, 36_302.0],
        // Its row does not fit better.
        tolerance: 0.25,
        rows: [
            [10.0, 14.57, 22.74],
            [5.0, 14.8, 23.11],
            [0.0, 15.36, 23.97],
            [-5.0, 15.78, 24.63],
            [-10.0, 16.05, 25.05],
        ],
    },
    Staged {
        test: 5,
        masses: [2086.0, 1147.0],
        inertias: [5031.0, 1484.0],
        angles: [-10.0, 0.0, 170.0, -20.7, 168.0],
        distances: [7.06, 6.09],
        impulse_ratio: -0.09,
        struck: Side::Rear,
        energies: [4158.0, 24_087.0],
        tolerance: 0.1,
        rows: [
            [10.0, 10.89, 19.78],
            [5.0, 11.35, 20.62],
            [0.0, 11.77, 21.39],
            [-5.0, 12.11, 22.01],
            [-10.0, 12.34, 22.43],
        ],
    },
    Staged {
        test: 6,
        masses: [1950.0, 1190.0],
        inertias: [4703.0, 2263.0],
        angles: [-30.0, 0.0, 60.0, -17.9, -90.0],
        distances: [8.4, 1.99],
        impulse_ratio: 0.824,
        struck: Side::Right,
        energies: [7197.0, 39_151.0],
        tolerance: 0.1,
        rows: [
            [20.0, 23.57, 38.64],
            [10.0, 19.87, 32.58],
            [0.0, 18.09, 29.66],
            [-10.0, 17.26, 28.29],
            [-20.0, 16.83, 27.59],
        ],
    },
    Staged {
        test: 7,
        masses: [1678.0, 1184.0],
        inertias: [4047.0, 1467.0 * 1184.0 / 771.0],
        angles: [-30.0, 0.0, 60.0, -17.9, -90.0],
        distances: [8.44, 2.43],
        impulse_ratio: 0.772,
        struck: Side::Right,
        energies: [11_981.0, 61_811.0],
        tolerance: 0.1,
        rows: [
            [20.0, 31.29, 44.36],
            [10.0, 26.99, 38.28],
            [0.0, 25.03, 35.49],
            [-10.0, 24.14, 34.22],
            [-20.0, 23.78, 33.72],
        ],
    },
];

#[test]
fn table_3_of_the_paper_comes_out() {
    const FOOT: f64 = 0.3048;
    const FOOT_POUND: f64 = FOOT * 4.448_221_615_260_5;
    for staged in &TABLE_3 {
        let [crush_plane, t1, t2, phi1, phi2] = staged.angles.map(f64::to_radians);
        // The tables measure vehicle 1's heading from −x.
        let headings = [PI + t1, t2];
        let points = [(0, phi1), (1, phi2)].map(|(i, phi)| {
            let d = staged.distances[i] * FOOT;
            [d * phi.cos(), d * phi.sin()]
        });
        // The impulse on vehicle 1 has the direction of n turned by atan μ; the force comes from the opposite
        // one.
        let direction = crush_plane + staged.impulse_ratio.atan();
        for [change, dv1, dv2] in staged.rows {
            let turned = direction + change.to_radians();
            let from = turned + PI;
            let pdof1 = headings[0] - from - 2.0 * PI * ((headings[0] - from) / (2.0 * PI)).round();
            let pdof = [pdof1, opposite_pdof(pdof1, headings)];
            let mut energy = 0.0;
            for (i, side) in [Side::Front, staged.struck].into_iter().enumerate() {
                let factor = ObliqueCorrection::Uncapped.factor(side.oblique_angle(pdof[i])).unwrap().factor;
                energy += staged.energies[i] * FOOT_POUND * factor;
            }
            let inertia = |i: usize| {
                StruckVehicle::new(staged.masses[i], staged.inertias[i], moment_arm(points[i], pdof[i]))
                    .unwrap()
            };
            let found = delta_v(energy, [inertia(0), inertia(1)]).unwrap();
            let what = |vehicle: u8| format!("test {}, {change:+}°, vehicle {vehicle}", staged.test);
            assert_close(&what(1), found[0] / FOOT, dv1, staged.tolerance);
            assert_close(&what(2), found[1] / FOOT, dv2, staged.tolerance);
        }
    }
}

/// Numerical quadrature (midpoint rule) over the strips of a damage, with the energy per width `of` depth and
/// zone: (m) forward and left of the CG.
fn centroid_by_strips(
    (side, distance, offset): (Side, f64, f64),
    width: f64,
    depths: &[f64],
    of: impl Fn(usize, f64) -> f64,
) -> [f64; 2] {
    const STRIPS: u32 = 20_000;
    let zones = depths.len() - 1;
    let spacing = width / zones as f64;
    let (mut energy, mut along, mut deep) = (0.0, 0.0, 0.0);
    for zone in 0..zones {
        for strip in 0..STRIPS {
            let share = (f64::from(strip) + 0.5) / f64::from(STRIPS);
            let depth = depths[zone] + (depths[zone + 1] - depths[zone]) * share;
            let weight = of(zone, depth);
            energy += weight;
            along += weight * (zone as f64 + share) * spacing;
            deep += weight * depth / 2.0;
        }
    }
    let (along, depth) = (along / energy - width / 2.0, deep / energy);
    match side {
        Side::Front => [distance - depth, offset - along],
        Side::Rear => [depth - distance, offset - along],
        Side::Left => [offset + along, distance - depth],
        Side::Right => [offset + along, depth - distance],
    }
}

/// Energy per width for A, B and F_s (`limit`): G + A C + B C²/2 until the force is F_s.
fn energy_per_width([a, b, limit]: [f64; 3], depth: f64) -> f64 {
    let knee = (limit - a) / b;
    let g = a * a / (2.0 * b);
    if depth <= knee {
        g + a * depth + b * depth * depth / 2.0
    } else {
        g + a * knee + b * knee * knee / 2.0 + limit * (depth - knee)
    }
}

/// EDCRASH's tutorial (HVE manuals, EDCRASH chapter 5): its printed impulse centres (cm) are within 1 cm of
/// the energy-weighted centroids, but not of those of the area.
#[test]
fn the_centroid_weighs_the_damage_by_its_energy() {
    const SOFT: [f64; 2] = [24_500.0, 500_000.0];
    const STIFF: [f64; 2] = [98_000.0, 2_000_000.0];
    let escort = (Side::Front, 1.7856, 0.0);
    let sentra = (Side::Right, 0.8572, -0.4);
    let front: &[f64] = &[0.75, 0.60, 0.50, 0.45, 0.40, 0.40, 0.45];
    let flank: &[f64] = &[0.20, 0.30, 0.50, 0.45, 0.10];
    // y to the right in the manual, to the left here.
    for (name, face, width, depths, lines, printed) in [
        ("Escort", escort, 1.6942, front, vec![[51_563.0, 709_300.0]; 6], [1.5209, 0.1649]),
        ("Sentra", sentra, 2.2, flank, vec![SOFT; 4], [-0.3493, -0.6559]),
        (
            "Sentra, zone 1 four times as stiff",
            sentra,
            2.2,
            flank,
            vec![STIFF, SOFT, SOFT, SOFT],
            [-0.5848, -0.6765],
        ),
    ] {
        let profile = Profile::equally_spaced(depths.to_vec(), width).unwrap();
        let stiffnesses = lines.iter().map(|&[a, b]| Stiffness::from_ab(a, b).unwrap()).collect();
        let structure = SideStiffness::Zones(stiffnesses);
        let (side, distance, offset) = face;
        let found = DamagedFace::new(side, distance, offset).unwrap().centroid(&profile, &structure).unwrap();
        let expected = centroid_by_strips(face, width, depths, |zone, depth| {
            let [a, b] = lines[zone];
            energy_per_width([a, b, f64::INFINITY], depth)
        });
        for i in 0..2 {
            assert_close(name, found[i], expected[i], 1e-8);
            assert_close(name, found[i], printed[i], 0.01);
        }
    }
}

/// A saturating force: the knee lies within a zone of increasing depth and within one of decreasing depth,
/// but not in the third, which yields throughout.
#[test]
fn the_centroid_weighs_a_force_that_saturates() {
    const LINE: [f64; 3] = [30_000.0, 400_000.0, 150_000.0];
    let depths = [0.1, 0.7, 0.5, 0.05];
    let [a, b, limit] = LINE;
    let stiffness = Stiffness::from_ab(a, b).unwrap().with_saturation_force(limit).unwrap();
    let profile = Profile::equally_spaced(depths.to_vec(), 1.5).unwrap();
    for side in [Side::Front, Side::Rear, Side::Left, Side::Right] {
        let face = DamagedFace::new(side, 1.9, 0.2).unwrap();
        let found = face.centroid(&profile, &SideStiffness::Uniform(stiffness)).unwrap();
        let expected =
            centroid_by_strips((side, 1.9, 0.2), 1.5, &depths, |_, depth| energy_per_width(LINE, depth));
        for i in 0..2 {
            assert_close(&format!("{side:?}"), found[i], expected[i], 1e-7);
        }
    }
}
