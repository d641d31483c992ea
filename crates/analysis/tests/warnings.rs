//! Every warning, on both sides of its threshold: data that raise it, with which values, and data that just
//! do not.
//!
//! The values follow from the geometry and the arithmetic next to each case.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use std::f64::consts::PI;

use analysis::{Analysis, Failure, JumpSide, Warning};
use case::CaseFile;
use inputs::Case;
use pim_core::{Switch, VehicleId};

const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");
const PAPER_FORWARD: &str = include_str!("../../../fixtures/sae-980025-impact.toml");

type Analyse = fn(&Case) -> Result<Analysis, Failure>;

fn warnings(analyse: Analyse, text: &str) -> Vec<Warning> {
    let file = CaseFile::parse("case.toml", text).unwrap_or_else(|error| panic!("{error}")).case;
    analyse(&file).unwrap_or_else(|error| panic!("{error}")).warnings
}

/// The warnings with that code.
fn raised(analyse: Analyse, text: &str, code: &str) -> Vec<Warning> {
    warnings(analyse, text).into_iter().filter(|warning| warning.code() == code).collect()
}

/// `text` with one place replaced.
#[track_caller]
fn with(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} has to stand once in the case");
    text.replace(old, new)
}

#[track_caller]
fn assert_close(what: &str, actual: f64, expected: f64, tolerance: f64) {
    assert!(
        (actual - expected).abs() <= tolerance,
        "{what}: {actual} is not {expected} within {tolerance:e}"
    );
}

/// A case of damage alone: equal cars but for the damage, each `side, depth in m, direction of force` of a
/// crush of 1.5 m width and the same depth throughout, with A = 40 kN/m and B = 500 kN/m².
fn damaged([first, second]: [(&str, f64, &str); 2]) -> String {
    let vehicle = |id: VehicleId, (side, depth, force): (&str, f64, &str)| {
        format!(
            "[vehicle{id}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\n[vehicle{id}.crush]\nside = \"{side}\"\nwidth = \"1.5 m\"\n\
             depths = \"{depth} {depth} m\"\nstiffness = {{ A = \"40 kN/m\", B = \"500 kN/m^2\" }}\nmoment_arm = \"0 m\"\n{force}\n"
        )
    };
    vehicle(VehicleId::One, first) + &vehicle(VehicleId::Two, second)
}

/// (J) energy of a crush of 0.3 m depth in [`damaged`]: L (A C + B C²/2 + A²/2B) = L B/2 (C + A/B)² = 1.5 ·
/// 250,000 · 0.38².
const ENERGY: f64 = 54_150.0;

/// A car of 1500 kg that meets a wall squarely, its CG behind C: `car` says which vehicle it is, `heading`
/// and `forward` (m) give its direction and the place of C, `speed` is in m/s; its crush is that of
/// [`ENERGY`].
fn against_a_wall(car: VehicleId, forward: f64, speed: f64, crush: &str) -> String {
    let wall = car.other();
    format!(
        "[vehicle{wall}]\nfixed = true\n[vehicle{car}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"40 deg\"\n\
         speed = \"{speed} m/s\"\ncontact = {{ x = \"{forward} m\", y = \"0 m\" }}\n[vehicle{car}.crush]\nwidth = \"1.5 m\"\n\
         depths = \"0.3 0.3 m\"\nstiffness = {{ A = \"40 kN/m\", B = \"500 kN/m^2\" }}\n{crush}\n\
         [impact]\ncrush_plane = \"40 deg\"\nrestitution = 0\ntangential = \"critical\"\n"
    )
}

/// By docs/theory.md and the paper's appendix ΔV is 27.18 and 29.44 mph by the impact, and about 27.4 and
/// 29.7 ft/s by CRASH3 without restitution; √(1.3/0.7) of that, for e = 0.3, is 25.5 and 27.6 mph: 6 % less.
#[test]
fn the_papers_example_raises_no_warning() {
    assert_eq!(warnings(analysis::reconstruct, PAPER), []);
    assert_eq!(warnings(analysis::impact, PAPER_FORWARD), []);
}

/// r_1 points to 180° − 22.4° = 157.6° and r_2 to 67° − 39° = 28°: n·r_1 < 0 < n·r_2 for Γ from 28° − 90° =
/// −62° to 157.6° − 90° = 67.6°.
#[test]
fn crush_plane() {
    for (angle, expected) in
        [("-61.9", 0), ("-62.1", 1), ("67.5", 0), ("67.7", 1), ("247.5", 0), ("247.7", 1)]
    {
        let text = with(PAPER_FORWARD, "\"-23 deg\"", &format!("\"{angle} deg\""));
        // Friction, because a common tangential velocity is out of reach in the steepest of these.
        let text = with(&text, "\"critical\"", "{ friction = 0.4 }");
        let found = raised(analysis::impact, &text, "crush-plane");
        assert_eq!(found, vec![Warning::PlaneDoesNotSeparate; expected], "{angle}°");
    }
}

/// The outline reaches 2.0 m forward, 2.5 m back and 0.9 m to each side; 5 cm beyond are allowed.
#[test]
fn contact_outside() {
    let outline = "length = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2.0 m\"\n";
    let contacts = [
        (VehicleId::One, "{ distance = \"6.3 ft\", angle = \"-22.4 deg\" }"),
        (VehicleId::Two, "{ distance = \"3.8 ft\", angle = \"-39 deg\" }"),
    ];
    for (vehicle, contact) in contacts {
        let text = with(PAPER, &format!("[vehicle{vehicle}]\n"), &format!("[vehicle{vehicle}]\n{outline}"));
        // The speed sought goes either way, so that the vehicles meet wherever the points are; friction has
        // an answer everywhere.
        let text = with(&text, "\"critical\"", "{ friction = 0.4 }");
        for ([x, y], beyond) in [
            ([2.049, 0.5], None),
            ([2.051, 0.5], Some(0.051)),
            ([-2.549, 0.5], None),
            ([-2.551, 0.5], Some(0.051)),
            ([0.5, 0.949], None),
            ([0.5, 0.951], Some(0.051)),
            ([0.5, -0.949], None),
            ([0.5, -0.951], Some(0.051)),
            // Past a corner the larger of the two counts.
            ([2.1, 1.2], Some(0.3)),
        ] {
            let moved = with(&text, contact, &format!("{{ x = \"{x} m\", y = \"{y} m\" }}"));
            let found = raised(analysis::reconstruct, &moved, "contact-outside");
            match (&found[..], beyond) {
                ([], None) => {}
                ([Warning::ContactOutside { vehicle: named, distance }], Some(beyond)) => {
                    assert_eq!(*named, vehicle);
                    assert_close("distance", *distance, beyond, 1e-12);
                }
                _ => panic!("vehicle {vehicle}, [{x}, {y}]: {found:?}"),
            }
        }
    }
}

/// Vehicle 2 drives along the crush plane (67° + 23° = 90°), so that the closing speed is that of vehicle 1
/// times cos 23°.
#[test]
fn high_restitution() {
    let at = |restitution: f64, closing: f64| {
        let speed = closing / 23_f64.to_radians().cos();
        let text = with(PAPER_FORWARD, "\"75 ft/s\"", &format!("\"{speed} m/s\""));
        raised(
            analysis::impact,
            &with(&text, "restitution = 0.3", &format!("restitution = {restitution}")),
            "high-restitution",
        )
    };
    let found = at(0.301, 15.01);
    let [Warning::HighRestitution { restitution, closing_speed }] = found[..] else { panic!("{found:?}") };
    assert_eq!(restitution, 0.301);
    assert_close("closing speed", closing_speed, 15.01, 1e-12);
    assert_eq!(at(0.3, 15.01), []);
    assert_eq!(at(0.301, 14.99), []);
    assert_eq!(at(0.9, 14.99), []);
    assert_eq!(at(0.3, 30.0), []);
}

/// F = L (A + B C) / cos α: 1.5 m · 190 kN/m = 285 kN at 0.3 m, half of that at 0.11 m.
#[test]
fn force_balance() {
    let at = |c1: f64, a1: &str, c2: f64, a2: &str| {
        let force = |angle: &str| format!("oblique_angle = \"{angle} deg\"\noblique = \"uncapped\"");
        raised(
            analysis::crush,
            &damaged([("front", c1, &force(a1)), ("rear", c2, &force(a2))]),
            "force-balance",
        )
    };
    assert_eq!(at(0.3, "0", 0.1101, "0"), []);
    assert_eq!(at(0.1101, "0", 0.3, "0"), []);
    for (found, expected) in [
        (at(0.3, "0", 0.1099, "0"), [285_000.0, 142_425.0]),
        (at(0.1099, "0", 0.3, "0"), [142_425.0, 285_000.0]),
        // cos 60° = ½ makes two of one and one of two.
        (at(0.31, "60", 0.3, "0"), [585_000.0, 285_000.0]),
    ] {
        let [Warning::ForceBalance { forces }] = found[..] else { panic!("{found:?}") };
        for (actual, expected) in forces.into_iter().zip(expected) {
            assert_close("peak force", actual, expected, 1e-6);
        }
    }
    assert_eq!(at(0.11, "60", 0.3, "0"), []);
}

/// A car that meets a wall squarely with its front has a PDOF of 0°, with its rear one of 180°.
#[test]
fn pdof_differs() {
    for car in VehicleId::ALL {
        for (forward, speed, side, computed, given, expected) in [
            (2.0, 10.0, "front", 0.0, 9.99, false),
            (2.0, 10.0, "front", 0.0, 10.01, true),
            (2.0, 10.0, "front", 0.0, -9.99, false),
            (2.0, 10.0, "front", 0.0, -10.01, true),
            // 360° and a little is that little.
            (2.0, 10.0, "front", 0.0, 369.99, false),
            (-2.0, -10.0, "rear", 180.0, 170.01, false),
            (-2.0, -10.0, "rear", 180.0, 169.99, true),
            // The short way round.
            (-2.0, -10.0, "rear", 180.0, -170.01, false),
            (-2.0, -10.0, "rear", 180.0, -169.99, true),
        ] {
            let text =
                against_a_wall(car, forward, speed, &format!("side = \"{side}\"\npdof = \"{given} deg\""));
            let found = raised(analysis::impact, &text, "pdof-differs");
            match (&found[..], expected) {
                ([], false) => {}
                ([Warning::PdofDiffers { vehicle, given: named, computed: pdof, .. }], true) => {
                    assert_eq!(*vehicle, car);
                    assert_close("given", *named, f64::to_radians(given), 1e-14);
                    // −180° and 180° are one direction, and rounding decides between them.
                    assert_close("computed", (pdof - f64::to_radians(computed)).sin(), 0.0, 1e-14);
                    assert_close("computed", pdof.abs(), f64::to_radians(computed), 1e-14);
                }
                _ => panic!("car {car}, {given}°: {found:?}"),
            }
        }
        // Without one in the file there is nothing to compare.
        assert_eq!(
            raised(analysis::impact, &against_a_wall(car, 2.0, 10.0, "side = \"front\""), "pdof-differs"),
            []
        );
    }
}

#[test]
fn angle_capped() {
    let at = |vehicle: VehicleId, angle: &str, correction: &str| {
        let mut damage =
            [("front", 0.3, "oblique_angle = \"0 deg\""), ("left", 0.3, "oblique_angle = \"0 deg\"")];
        let force = format!("oblique_angle = \"{angle} deg\"\noblique = \"{correction}\"");
        damage[vehicle.index()].2 = &force;
        raised(analysis::crush, &damaged(damage), "angle-capped")
    };
    for vehicle in VehicleId::ALL {
        for (angle, expected) in [("45.01", 45.01), ("-45.01", -45.01), ("80", 80.0)] {
            let found = at(vehicle, angle, "capped");
            let [Warning::AngleCapped { vehicle: named, oblique_angle }] = found[..] else {
                panic!("{found:?}")
            };
            assert_eq!(named, vehicle);
            assert_close("α", oblique_angle, f64::to_radians(expected), 1e-14);
            assert_eq!(at(vehicle, angle, "uncapped"), []);
            assert_eq!(at(vehicle, angle, "none"), []);
        }
        for angle in ["45", "-45", "44.99", "0"] {
            assert_eq!(at(vehicle, angle, "capped"), []);
        }
    }
}

/// A force pushes on a side where it makes less than 90° with its normal: which PDOF that is depends on the
/// side.
#[test]
fn side_not_pushed() {
    for (side, pdof, angle) in [
        ("front", 89.9, None),
        ("front", 90.1, Some(90.1)),
        ("front", -90.1, Some(-90.1)),
        ("front", 90.0, Some(90.0)),
        ("right", 0.1, None),
        ("right", -0.1, Some(-90.1)),
        ("right", 179.9, None),
        ("right", -179.9, Some(90.1)),
        ("rear", 90.1, None),
        ("rear", -90.1, None),
        ("rear", 89.9, Some(-90.1)),
        ("left", -0.1, None),
        ("left", 0.1, Some(90.1)),
    ] {
        for vehicle in VehicleId::ALL {
            // Whether or not its energy would be corrected for the angle.
            for correction in ["capped", "uncapped", "none"] {
                let force = format!("pdof = \"{pdof} deg\"\noblique = \"{correction}\"");
                let mut damage = [("front", 0.3, "pdof = \"0 deg\""); 2];
                damage[vehicle.index()] = (side, 0.3, &force);
                let found = raised(analysis::crush, &damaged(damage), "side-not-pushed");
                match (&found[..], angle) {
                    ([], None) => {}
                    ([Warning::SideNotPushed { vehicle: named, oblique_angle }], Some(angle)) => {
                        assert_eq!(*named, vehicle);
                        assert_close("α", *oblique_angle, f64::to_radians(angle), 1e-13);
                    }
                    _ => panic!("{side}, {pdof}°: {found:?}"),
                }
            }
        }
    }
}

/// A car that hits a wall squarely with e = 0 loses its speed, for which CRASH3 gives √(2E/m): equal to 10 %
/// for speeds from that divided by 1.1 to that divided by 0.9. With restitution the impact's ΔV is
/// (1 + e) v, and CRASH3's √((1 + e)/(1 − e)) times as much where E is dissipated, 1 + e times where it is
/// absorbed.
#[test]
fn delta_v_differs() {
    let plain = (2.0 * ENERGY / 1500.0_f64).sqrt();
    for car in VehicleId::ALL {
        for (e, basis, factor) in [
            (0.0, "dissipated", 1.0),
            (0.0, "absorbed", 1.0),
            (0.28, "dissipated", (1.28 / 0.72_f64).sqrt()),
            (0.28, "absorbed", 1.28),
        ] {
            // CRASH3's ΔV in speeds of the impact.
            let crash3 = plain * factor / (1.0 + e);
            let at = |speed: f64, force: &str| {
                let text = against_a_wall(car, 2.0, speed, &format!("side = \"front\"\n{force}"));
                let text = with(&text, "restitution = 0", &format!("restitution = {e}"));
                let basis =
                    format!("[reconstruct]\nfind = \"vehicle{car}.speed\"\nenergy_basis = \"{basis}\"\n");
                raised(analysis::impact, &(text + &basis), "delta-v-differs")
            };
            for (speed, factor, force) in [
                (crash3 / 0.9 + 1e-3, 1.0, ""),
                (crash3 / 1.1 - 1e-3, 1.0, ""),
                // tan 45° doubles the energy.
                (crash3, 2.0, "oblique_angle = \"45 deg\""),
                // A force that does not push on the side leaves the energy as it is.
                (crash3 / 0.9 + 1e-3, 1.0, "pdof = \"100 deg\"\nmoment_arm = \"0 m\""),
            ] {
                let found = at(speed, force);
                let [Warning::DeltaVDiffers { impact, crash3: named, restitution: true }] = found[..] else {
                    panic!("{speed}: {found:?}")
                };
                let of_car = |values: [Option<f64>; 2]| values[car.index()].unwrap();
                assert_close("ΔV", of_car(impact), (1.0 + e) * speed, 1e-12 * speed);
                let expected = (1.0 + e) * crash3 * f64::sqrt(factor);
                assert_close("CRASH3's ΔV", of_car(named), expected, 1e-12 * expected);
                // A wall has none.
                let wall = car.other().index();
                assert_eq!([impact[wall], named[wall]], [None, None]);
            }
            assert_eq!(at(crash3 / 0.9 - 1e-3, ""), []);
            assert_eq!(at(crash3 / 1.1 + 1e-3, ""), []);
            assert_eq!(at(crash3 * 2_f64.sqrt(), "oblique_angle = \"45 deg\""), []);
            assert_eq!(at(crash3, "pdof = \"100 deg\"\nmoment_arm = \"0 m\""), []);
        }
    }
}

/// e = 1 leaves nothing dissipated, and no factor; a car that skids along the wall to the end under a
/// friction limit is none of CRASH3's.
#[test]
fn delta_v_without_restitution_and_with_sliding() {
    let crash3 = (2.0 * ENERGY / 1500.0_f64).sqrt();
    let text = against_a_wall(VehicleId::One, 2.0, crash3, "side = \"front\"");
    let elastic = with(&text, "restitution = 0", "restitution = 1");
    let found = raised(analysis::impact, &elastic, "delta-v-differs");
    assert!(matches!(found[..], [Warning::DeltaVDiffers { restitution: false, .. }]), "{found:?}");

    // Twice the speed of the damage, and three times along the wall: by 40° − 90° it goes to the right.
    let [n, t] = [(40_f64).to_radians(), (-50_f64).to_radians()].map(|angle| [angle.cos(), angle.sin()]);
    let along = |share: f64| [0, 1].map(|i| 2.0 * crash3 * (n[i] + share * t[i]));
    for (share, friction, expected) in [(3.0, 0.1, 0), (0.0, 0.1, 1), (0.3, 5.0, 1)] {
        let [x, y] = along(share);
        let speed = format!("speed = \"{crash3} m/s\"");
        let text = with(&text, &speed, &format!("velocity = {{ x = \"{x} m/s\", y = \"{y} m/s\" }}"));
        let text = with(&text, "\"critical\"", &format!("{{ friction = {friction} }}"));
        assert_eq!(raised(analysis::impact, &text, "delta-v-differs").len(), expected, "{share} {friction}");
    }
}

/// Mass 1 kg and radius of gyration 1 m, C at (−1, −1) m of the CG in the scene, a wall below, e = 0, a yaw
/// rate ω of 5 rad/s, and a heading of `across` for 1 down. The crush, 1 m deep and wide with A = 0 and B = 3
/// N/m², took 1.5 J.
pub(crate) fn spinning(across: f64) -> String {
    let heading = f64::atan2(-1.0, across);
    format!(
        "[vehicle1]\nmass = \"1 kg\"\nyaw_radius = \"1 m\"\nyaw_rate = \"5 rad/s\"\nheading = \"{heading} rad\"\n\
         contact = {{ distance = \"{} m\", angle = \"{} rad\" }}\n[vehicle1.crush]\nside = \"right\"\nwidth = \"1 m\"\n\
         depths = \"1 1 m\"\nstiffness = {{ A = \"0 N/m\", B = \"3 N/m^2\" }}\n[vehicle2]\nfixed = true\n[impact]\n\
         crush_plane = \"90 deg\"\nrestitution = 0\ntangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n",
        2_f64.sqrt(),
        -0.75 * PI - heading,
    )
}

/// By hand, along n = +y and t = −x: k_nn = k_tt = 2 and k_nt = 1, u = −(ω + s′, ω + a s′) where a is
/// `across` and s′ = s/√(a² + 1). In the approach speed x = ω + s′ a common tangential velocity takes P_n =
/// ((2 − a) x + (a − 1) ω)/3, so that W_n = x P_n/2 = 1.5 J is (2 − a) x² + (a − 1) ω x − 9 = 0: two positive
/// roots for a > 2 and one for a < 2.
///
/// Of −12.6 and 12.6 m/s (a = 3) only the second is forward, and both are as fast; of −7.7 and 112.4 m/s (a =
/// 2.1) neither is between 0 and 70 m/s, and the first is slower.
#[test]
fn several_speeds() {
    let limits = |given: &str| format!("[vehicle1]\ncertain_speed = {{ {given} }}");
    for (across, certain, answer) in [
        (2.1_f64, "", 0),
        (2.1, "at_most = \"120 m/s\"", 1),
        (3.0, "", 1),
        (3.0, "at_most = \"-5 m/s\"", 0),
        (3.0, "at_least = \"-20 m/s\"", 0),
        (3.0, "at_least = \"5 m/s\", at_most = \"12 m/s\"", 0),
    ] {
        let (square, linear) = (2.0 - across, 5.0 * (across - 1.0));
        let root = (linear * linear + 36.0 * square).sqrt();
        let roots = [1.0, -1.0].map(|sign| {
            let x = (-linear + sign * root) / (2.0 * square);
            (x - 5.0) * (across * across + 1.0_f64).sqrt()
        });
        let text = spinning(across);
        let text = if certain.is_empty() { text } else { text.replacen("[vehicle1]", &limits(certain), 1) };
        let found = raised(analysis::reconstruct, &text, "several-speeds");
        let [Warning::SeveralSpeeds { answer: speed, others }] = &found[..] else { panic!("{found:?}") };
        assert_close("answer", *speed, roots[answer], 1e-10 * roots[answer].abs());
        assert_eq!(others.len(), 1, "{across} {certain}");
        assert_close("other", others[0], roots[1 - answer], 1e-10 * roots[1 - answer].abs());
    }
    assert_eq!(raised(analysis::reconstruct, &spinning(1.9), "several-speeds"), []);
}

/// A collision simulated by the raw equations, in which vehicle 2 had 3.138 867 093 155 m/s. Three speeds
/// have its crush energy: |v_1 − v_2| is 13.6 m/s with that one, and 26 m/s and more with the others, one of
/// which has a slower approach at the contact point.
#[test]
fn of_several_speeds_the_one_with_the_least_relative_speed_leads() {
    let text = r#"
        [scene]
        axes = "z-down"
        [vehicle1]
        mass = "3172.1437427514988 lb"
        yaw_radius = "4.2853592692129929 ft"
        heading = "11.916570072427358 deg"
        contact = { x = "6.4511666142151078 ft", y = "-2.1813193102130906 ft" }
        speed = "29.717991295516111 mph"
        crush = { ees = "14.035592860094411 mph" }
        [vehicle2]
        mass = "4758.2955529418696 lb"
        yaw_radius = "3.7051505524832118 ft"
        heading = "100.64038144851916 deg"
        contact = { x = "-0.9856562717117261 ft", y = "2.7216700533777538 ft" }
        crush = { ees = "13.614910953747518 mph" }
        [impact]
        crush_plane = "13.879587013949987 deg"
        restitution = 0
        law = "kudlich-slibar"
        friction = 0.69172189157775499
        [reconstruct]
        find = "vehicle2.speed"
        "#;
    let found = raised(analysis::reconstruct, text, "several-speeds");
    let [Warning::SeveralSpeeds { answer, others }] = &found[..] else { panic!("{found:?}") };
    assert_close("answer", *answer, 3.138_867_093_155_077_7, 1e-9);
    let known = 29.717_991_295_516_11 * 0.447_04;
    let between = (100.640_381_448_519_16_f64 - 11.916_570_072_427_358).to_radians();
    let relative = |speed: f64| (known * known + speed * speed - 2.0 * known * speed * between.cos()).sqrt();
    assert_eq!(others.len(), 2);
    assert!(others.iter().all(|other| relative(*other) > 26.0) && relative(*answer) < 14.0, "{others:?}");
    let analysis = analysis::reconstruct(&CaseFile::parse("case.toml", text).unwrap().case).unwrap();
    let all = analysis.found.unwrap().admissible;
    assert!(all[0] != *answer, "it has the slowest approach: {all:?}");
}

/// Two equal cars head-on, e = 0: W_n = ½ (m/2) x² takes the crush energy of both at the closing speed x =
/// √(8 E/m). Where the one drives faster than that, the other has to have backed away.
#[test]
fn moves_backward() {
    let closing = (8.0 * ENERGY / 1500.0_f64).sqrt();
    for sought in VehicleId::ALL {
        let at = |known: f64| {
            let other = sought.other();
            let places = "contact = { x = \"2 m\", y = \"0 m\" }";
            let text = damaged([("front", 0.3, "pdof = \"0 deg\""), ("front", 0.3, "pdof = \"0 deg\"")]);
            let text = with(&text, "[vehicle1]\n", &format!("[vehicle1]\nheading = \"0 deg\"\n{places}\n"));
            let text = with(&text, "[vehicle2]\n", &format!("[vehicle2]\nheading = \"180 deg\"\n{places}\n"));
            let text = with(
                &text,
                &format!("[vehicle{other}]\n"),
                &format!("[vehicle{other}]\nspeed = \"{known} m/s\"\n"),
            );
            let text = text
                + "[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0\ntangential = \"critical\"\n"
                + &format!("[reconstruct]\nfind = \"vehicle{sought}.speed\"\n");
            raised(analysis::reconstruct, &text, "moves-backward")
        };
        assert_eq!(at(closing - 1e-3), []);
        let found = at(closing + 1e-3);
        let [Warning::MovesBackward { vehicle, speed, found: true }] = found[..] else { panic!("{found:?}") };
        assert_eq!(vehicle, sought);
        assert_close("speed", speed, -1e-3, 1e-12);
    }
}

#[test]
fn given_speed_unused() {
    assert_eq!(raised(analysis::reconstruct, PAPER, "given-speed-unused"), []);
    let text = with(PAPER, "[vehicle1]\n", "[vehicle1]\nspeed = \"70 ft/s\"\n");
    let found = raised(analysis::reconstruct, &text, "given-speed-unused");
    let [Warning::GivenSpeedUnused { vehicle, given, found, is_direction_used: false }] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(vehicle, VehicleId::One);
    assert_close("given", given, 70.0 * 0.3048, 1e-12);
    // docs/theory.md: 75.03 ft/s.
    assert_close("found", found, 75.03 * 0.3048, 0.005 * 0.3048);
}

/// The one warning of a jump: what switches and what it is compared with, and both sides.
#[track_caller]
fn jump(text: &str) -> (Switch, f64, [JumpSide; 2]) {
    let found = raised(analysis::impact, text, "near-jump");
    let [Warning::NearJump { border, given, sides }] = found[..] else { panic!("{found:?}") };
    (border, given, sides)
}

/// Sticking and sliding as an elimination of the nine equations of impulse and momentum gives them at
/// |P_t|/P_n of the full impulse.
#[test]
fn a_moment_beside_the_friction_limit() {
    const NEEDED: f64 = 0.394_697_104_361_8;
    let full = include_str!("../../../fixtures/jump-full.toml");
    let sliding = include_str!("../../../fixtures/jump-sliding.toml");
    let limit = "0.39469710475650066";
    for text in [full, sliding] {
        let (border, given, sides) = jump(text);
        let Switch::Limit(needed) = border else { panic!("{border:?}") };
        assert_close("needed", needed, NEEDED, 1e-12);
        assert_close("given", given, NEEDED, 1e-9);
        for (side, [work, moment, one, other]) in sides.iter().zip([
            [153_239.336, 7_683.260, -2.320_443, 1.723_542],
            [152_959.230, 7_502.851, -2.366_552, 1.777_068],
        ]) {
            assert_close("W_n", side.normal_work, work, 0.001);
            assert_close("M", side.moment.unwrap(), moment, 0.001);
            assert_close("Ω_1", side.yaw_rates[0].unwrap(), one, 1e-6);
            assert_close("Ω_2", side.yaw_rates[1].unwrap(), other, 1e-6);
        }
        // The answer itself is one of the two.
        let file = CaseFile::parse("case.toml", text).unwrap().case;
        let work = analysis::impact(&file).unwrap().impact.unwrap().outcome.energy.normal_work;
        let here = if text == full { 153_239.336 } else { 152_959.230 };
        assert_close("W_n of the answer", work, here, 0.001);
    }
    for (share, expected) in
        [(0.98, 0), (0.9900, 0), (0.9902, 1), (1.0, 1), (1.0101, 1), (1.0102, 0), (1.02, 0)]
    {
        let near = with(full, limit, &format!("{}", NEEDED * share));
        assert_eq!(raised(analysis::impact, &near, "near-jump").len(), expected, "{share}");
    }
    // With e_m = 0 and without a moment the ratio is 0.416608 and 0.368885, and there is no jump.
    for (moment, needed) in [("0", 0.416_608), ("-1", 0.368_885)] {
        let text = with(full, "= -0.5 ", &format!("= {moment} "));
        for share in [0.995, 1.0, 1.005] {
            let at = with(&text, limit, &format!("{}", needed * share));
            assert_eq!(raised(analysis::impact, &at, "near-jump"), [], "{moment} {share}");
        }
    }
}

/// A car of 1000 kg and k = 1 m meets a wall 1 m ahead and 1 m beside its CG, so that K = (2 1; 1 2)/1000 kg,
/// with u_n = −1 m/s.
fn turned_round(sliding: f64, limit: f64, contact: f64, axes: &str) -> String {
    let across = -sliding * -contact;
    format!(
        "[scene]\naxes = \"{axes}\"\n[vehicle2]\nfixed = true\n[vehicle1]\nmass = \"1000 kg\"\nyaw_radius = \"1 m\"\n\
         heading = \"0 deg\"\ncontact = {{ x = \"1 m\", y = \"{contact} m\" }}\nvelocity = {{ x = \"1 m/s\", y = \"{across} m/s\" }}\n\
         [impact]\ncrush_plane = \"0 deg\"\nlaw = \"kudlich-slibar\"\nrestitution = 0.5\nfriction = {limit}\n"
    )
}

/// By hand with ε = ½: without friction P_n = 750 N·s and U_t = u_t + ¾.
///
/// u_t = −0.6: U_t = 0.15, but the full impulse is (700, 100) N·s, which needs μ = 1/7, and sliding has μ =
/// −1/7: P_n = 1500/(2 − 1/7). W_n = P_n/4 m/s and Ω = −(P_n + P_t)/1000 kg·m. u_t = −0.75: U_t = 0, and the
/// full impulse (625, 250) N·s needs μ = 0.4; with 0.2 it slides with P_n = 1500/2.2 where U_t < 0, and with
/// 1500/1.8 where U_t > 0.
#[test]
fn a_full_impact_against_the_sliding_without_friction() {
    let assert_sides = |sides: [JumpSide; 2], expected: [[f64; 2]; 2]| {
        for (side, [normal, tangential]) in sides.iter().zip(expected) {
            assert_close("W_n", side.normal_work, normal / 4.0, 1e-9);
            assert_close("Ω", side.yaw_rates[0].unwrap(), -(normal + tangential) / 1000.0, 1e-12);
            assert_eq!((side.moment, side.yaw_rates[1]), (None, None));
        }
    };
    let seventh = 1.0 / 7.0;
    let slid = 1500.0 / (2.0 - seventh);
    for limit in [seventh * 0.9901, seventh * 1.0099] {
        let (border, given, sides) = jump(&turned_round(-0.6, limit, -1.0, "z-up"));
        let Switch::Limit(needed) = border else { panic!("{border:?}") };
        assert_close("needed", needed, seventh, 1e-12);
        assert_close("given", given, limit, 1e-15);
        assert_sides(sides, [[700.0, 100.0], [slid, -seventh * slid]]);
    }
    for limit in [seventh * 0.98, seventh * 1.02] {
        assert_eq!(raised(analysis::impact, &turned_round(-0.6, limit, -1.0, "z-up"), "near-jump"), []);
    }
    let [against, along] = [[1500.0 / 2.2, 300.0 / 2.2], [1500.0 / 1.8, -300.0 / 1.8]];
    for (sliding, expected) in
        [(-0.768, None), (-0.757, Some([against, along])), (-0.743, Some([along, against])), (-0.732, None)]
    {
        let text = turned_round(sliding, 0.2, -1.0, "z-up");
        let Some(expected) = expected else {
            assert_eq!(raised(analysis::impact, &text, "near-jump"), [], "{sliding}");
            continue;
        };
        let (border, given, sides) = jump(&text);
        let Switch::Direction(at) = border else { panic!("{border:?}") };
        assert_close("u_t", at, -0.75, 1e-12);
        assert_close("given", given, sliding, 1e-12);
        assert_sides(sides, expected);
        // The same scene written down in the other axes.
        let mirrored = turned_round(sliding, 0.2, 1.0, "z-down");
        let seen = raised(analysis::impact, &mirrored, "near-jump");
        let [Warning::NearJump { border: Switch::Direction(seen_at), given: seen_given, sides: seen }] =
            seen.iter().map(|warning| warning.seen(case::Axes::ZDown).warning().clone()).collect::<Vec<_>>()
                [..]
        else {
            panic!("{seen:?}")
        };
        assert_close("u_t seen", seen_at, 0.75, 1e-12);
        assert_close("given seen", seen_given, -sliding, 1e-12);
        for (seen, side) in seen.iter().zip(sides) {
            assert_close("Ω seen", seen.yaw_rates[0].unwrap(), -side.yaw_rates[0].unwrap(), 1e-12);
        }
    }
    // With a limit of 0.4 and more the full impact is possible on both sides of u_t = −0.75.
    assert_eq!(raised(analysis::impact, &turned_round(-0.752, 0.41, -1.0, "z-up"), "near-jump"), []);
}

/// A car overtakes another one and sideswipes it: `heading` in degrees, and further angles.
fn overtaking(heading: &str, plane: &str) -> String {
    format!(
        r#"
[vehicle1]
mass = "1700 kg"
yaw_radius = "1.4 m"
heading = {heading}
contact = {{ x = "1.5 m", y = "-0.85 m" }}
[vehicle1.crush]
side = "right"
width = "2 m"
depths = "1 3 4 2 cm"
offset = "80 cm"
stiffness = {{ A = "30 kN/m", B = "600 kN/m^2" }}
[vehicle2]
mass = "1400 kg"
yaw_radius = "1.3 m"
heading = {{ value = "0 deg", sd = "1 deg" }}
contact = {{ x = "-1.0 m", y = "0.85 m" }}
speed = "40 km/h"
[vehicle2.crush]
side = "left"
width = "2 m"
depths = "2 3 4 2 cm"
offset = "-80 cm"
stiffness = {{ A = "30 kN/m", B = "600 kN/m^2" }}
[impact]
crush_plane = {plane}
restitution = 0.1
tangential = {{ friction = 0.5 }}
[reconstruct]
find = "vehicle1.speed"
"#
    )
}

/// The answer is sensitive to a degree where the path lies nearly along the crush plane, by differences of
/// one hundredth of a degree; an angle with a range says so itself.
#[test]
fn an_answer_that_hangs_on_a_degree_is_told() {
    let plane = "{ value = \"90 deg\", sd = \"1 deg\" }";
    let speed = |degrees: f64| {
        let text = overtaking(&format!("\"{degrees} deg\""), plane);
        let case = CaseFile::parse("case.toml", &text).unwrap().case;
        analysis::reconstruct(&case).unwrap().speed(VehicleId::One)
    };
    let of = |degrees: f64| {
        let text = overtaking(&format!("\"{degrees} deg\""), plane);
        raised(analysis::reconstruct, &text, "hangs-on-angle")
    };
    let mut told = 0;
    for degrees in [-4.0, -6.0, -9.0, -12.0, -20.0, -30.0, -45.0] {
        let by_degree = (speed(degrees + 0.01) - speed(degrees - 0.01)).abs() / 0.02;
        let share = by_degree / speed(degrees);
        assert!((share - 0.1).abs() > 1e-3 && by_degree > 1.0 || share < 0.1, "{degrees} decides nothing");
        match &of(degrees)[..] {
            [] => assert!(share < 0.1, "{degrees} {share}"),
            [Warning::HangsOnAngle { vehicle: VehicleId::One, path, change, speed: at }] => {
                assert!(share > 0.1, "{degrees} {share}");
                assert_eq!(path, "vehicle1.heading");
                assert_close("change", *change, by_degree, 1e-3 * by_degree);
                assert_close("speed", *at, speed(degrees), 1e-12 * at);
                told += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!((1..7).contains(&told), "{told}");
    // The other angle counts where that one has a range, and none where both have.
    let ranged = "{ value = \"-4 deg\", sd = \"1 deg\" }";
    let found = raised(analysis::reconstruct, &overtaking(ranged, "\"90 deg\""), "hangs-on-angle");
    assert!(
        matches!(&found[..], [Warning::HangsOnAngle { path, .. }] if path == "impact.crush_plane"),
        "{found:?}"
    );
    assert_eq!(raised(analysis::reconstruct, &overtaking(ranged, plane), "hangs-on-angle"), []);
    assert_eq!(raised(analysis::reconstruct, PAPER, "hangs-on-angle"), []);
}

/// A car of 1200 kg and a truck of 16 t that rolls on: one degree of the truck's way turns its momentum by
/// 16,000 · V · π/180, which the car's speed has to make good.
#[test]
fn a_speed_by_rests_that_hangs_on_a_degree_is_told() {
    let text = |mass: &str| {
        format!(
            r#"
[scene]
contact = {{ x = "0 m", y = "0 m" }}
[surface]
friction = 0.7
[vehicle1]
mass = "1200 kg"
yaw_radius = "1.35 m"
heading = "90 deg"
wheelbase = "2.7 m"
track = "1.5 m"
contact = {{ x = "2 m", y = "0.3 m" }}
after = {{ speed = "6 m/s", direction = "10 deg", yaw_rate = "0 deg/s" }}
[vehicle2]
mass = "{mass}"
yaw_radius = "2.8 m"
heading = "0 deg"
wheelbase = "5.5 m"
track = "2 m"
cg_to_front_axle = "2.5 m"
contact = {{ x = "1 m", y = "-1 m" }}
after = {{ drag = 0.05, rest = {{ x = "60 m", y = "2.5 m", turned = "1 deg" }} }}
[impact]
crush_plane = "90 deg"
restitution = 0.1
tangential = {{ friction = 0.5 }}
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#
        )
    };
    let of = |mass: &str| raised(analysis::reconstruct, &text(mass), "hangs-on-angle");
    let [Warning::HangsOnAngle { vehicle: VehicleId::One, path, change, .. }] = &of("16000 kg")[..] else {
        panic!("{:?}", of("16000 kg"))
    };
    let case = CaseFile::parse("case.toml", &text("16000 kg")).unwrap().case;
    let both = analysis::reconstruct(&case).unwrap().both.unwrap();
    let after = both.momentum.after[1].velocity;
    // One degree of its heading moves as much of its momentum across, m₂ v₂ sin 1°.
    let by_way = 16_000.0 * after.x * 1_f64.to_radians() / 1200.0;
    let by_heading = 16_000.0 * both.speeds[1] * 1_f64.to_radians() / 1200.0;
    let (expected, key) =
        if by_heading > by_way { (by_heading, "vehicle2.heading") } else { (by_way, "vehicle2.after.rest") };
    assert_eq!(path, key);
    assert_close("change", *change, expected, 0.02 * expected);
    assert_eq!(of("1600 kg"), []);
}

/// CG 1 lies at (−2, −0.3) m from C, and CG 2 at (0.8, −0.3), so that they part along x, with
/// 13.5437 cos 16.348° − 8.5566 cos 12.992°.
#[test]
fn a_wreck_whose_parts_separate_is_told() {
    let text = |speed: &str, direction: &str| {
        format!(
            r#"
[scene]
locked_together = true
[vehicle1]
mass = "1500 kg"
yaw_radius = "1.4 m"
heading = "0 deg"
contact = {{ x = "2 m", y = "0.3 m" }}
after = {{ speed = "8.556643 m/s", direction = "12.992374 deg" }}
[vehicle2]
mass = "1300 kg"
yaw_radius = "1.3 m"
heading = "90 deg"
contact = {{ x = "0.3 m", y = "0.8 m" }}
after = {{ speed = "{speed} m/s", direction = "{direction} deg" }}
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = {{ friction = 0.5 }}
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#
        )
    };
    let of = |speed, direction| raised(analysis::reconstruct, &text(speed, direction), "not-locked");
    let [Warning::NotLocked { parting }] = of("13.543710", "16.347913")[..] else { panic!() };
    let expected =
        13.543_71 * 16.347_913_f64.to_radians().cos() - 8.556_643 * 12.992_374_f64.to_radians().cos();
    assert_close("parting", parting, expected, 1e-9);
    // As fast along the line, and across it by the turn.
    assert_eq!(of("8.556643", "12.992374"), []);
}
