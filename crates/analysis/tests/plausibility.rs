//! Inputs that are wrong but have an answer all the same: each warning on both sides of its threshold, in
//! both labellings, axes and senses of the crush plane's normal.
//!
//! The values follow from the arithmetic next to each case.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use analysis::{Analysis, Drive, Failure, Magnitude, Warning};
use case::CaseFile;
use crash3::Side;
use inputs::{Axes, Case, StiffnessSource, VehicleKind};
use pim_core::VehicleId;

type Analyse = fn(&Case) -> Result<Analysis, Failure>;

fn parsed(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

/// The warnings with that code, in the axes of the case.
fn raised(analyse: Analyse, text: &str, code: &str) -> Vec<Warning> {
    let file = parsed(text);
    let analysis = analyse(&file).unwrap_or_else(|error| panic!("{error}\n{text}")).seen(file.axes);
    let warnings = analysis.warnings.iter().map(|seen| seen.warning().clone());
    warnings.filter(|warning| warning.code() == code).collect()
}

#[track_caller]
fn assert_close(actual: f64, expected: f64, tolerance: f64) {
    assert!((actual - expected).abs() <= tolerance, "{actual} is not {expected} within {tolerance:e}");
}

/// A car of 1000 kg with k = 2 m that drives with 10 m/s squarely onto a wall, skids along it with a velocity
/// of its own, and may turn; C lies 2 m ahead of its CG and `left` of it, in m. It is `car`; in z-down axes
/// all that counts across is turned.
///
/// By hand, with n towards the car's rear: u_n = −10 m/s, K = (1.25, −0.5; −0.5, 2)/m for `left` = 1 m, and
/// (1, 0; 0, 2)/m for 0.
struct Skid {
    car: VehicleId,
    axes: Axes,
    crush_plane: f64,
}

const SKIDS: [Skid; 4] = [
    Skid { car: VehicleId::One, axes: Axes::ZUp, crush_plane: 0.0 },
    Skid { car: VehicleId::One, axes: Axes::ZUp, crush_plane: 180.0 },
    Skid { car: VehicleId::Two, axes: Axes::ZUp, crush_plane: 0.0 },
    Skid { car: VehicleId::One, axes: Axes::ZDown, crush_plane: 0.0 },
];

impl Skid {
    /// +1, or −1 where t and yaw rates are the other way round.
    fn sign(&self) -> f64 {
        self.axes.lateral(1.0)
    }

    /// u_t (m/s) at C, C `left` of the CG, ω (rad/s), and the keys of the law.
    fn text(&self, sliding: f64, left: f64, yaw_rate: f64, law: &str) -> String {
        let Self { car, axes, crush_plane } = self;
        let (sign, wall) = (self.sign(), car.other());
        // t points to the right: u_t = −(v_y + 2 ω), and u_n = −(v_x − left ω)
        let (vx, vy) = (10.0 + left * yaw_rate, sign * (-sliding - 2.0 * yaw_rate));
        format!(
            "[scene]\naxes = \"{}\"\n[vehicle{wall}]\nfixed = true\n[vehicle{car}]\nmass = \"1000 kg\"\nyaw_radius = \"2 m\"\nheading = \"0 deg\"\n\
             contact = {{ x = \"2 m\", y = \"{} m\" }}\nvelocity = {{ x = \"{vx} m/s\", y = \"{vy} m/s\" }}\nyaw_rate = \"{} rad/s\"\n[impact]\n\
             crush_plane = \"{crush_plane} deg\"\n{law}\n",
            axes.name(),
            sign * left,
            sign * yaw_rate,
        )
    }

    fn ratio(&self, mu: f64) -> String {
        format!("restitution = 0\ntangential = {{ ratio = {:?} }}", self.sign() * mu)
    }
}

/// With C on the axis, P_n = 10 m and P_t = 10 μ m: with z = 10 μ, W_n = 50 m and W_t = −z (u_t + z) m, which
/// is −2 % of E_L = W_n + W_t where z (u_t + z) = 1/1.02: at z = −0.2317 and 4.2317 for u_t = −4 m/s, at z =
/// ±0.9901 for u_t = 0.
#[test]
fn a_ratio_that_drives_the_sliding() {
    for skid in &SKIDS {
        let sign = skid.sign();
        let at = |sliding: f64, mu: f64| {
            raised(analysis::impact, &skid.text(sliding, 0.0, 0.0, &skid.ratio(mu)), "sliding-driven")
        };
        for (sliding, mu) in
            [(-4.0, -0.0231), (-4.0, 0.2), (-4.0, 0.4231), (0.0, 0.0990), (0.0, -0.0990), (0.0, 0.0)]
        {
            assert_eq!(at(sliding, mu), [], "{sliding} {mu}");
        }
        for (sliding, mu, expected) in [
            (-4.0, -0.0232, Drive::RatioAlong { impulse_ratio: sign * -0.0232 }),
            (4.0, 0.0232, Drive::RatioAlong { impulse_ratio: sign * 0.0232 }),
            (0.0, 0.0991, Drive::RatioWithoutSliding { impulse_ratio: sign * 0.0991 }),
            (0.0, -0.0991, Drive::RatioWithoutSliding { impulse_ratio: sign * -0.0991 }),
            // μ_c = 4/20
            (-4.0, 0.4233, Drive::RatioBeyond { impulse_ratio: sign * 0.4233, critical: Some(sign * 0.2) }),
        ] {
            let found = at(sliding, mu);
            let [Warning::SlidingDriven { tangential_work, energy_loss, sliding: slid, cause }] = found[..]
            else {
                panic!("{sliding} {mu}: {found:?}")
            };
            let work = -10.0 * mu * (sliding + 10.0 * mu) * 1000.0;
            assert_close(tangential_work, work, 1e-9);
            assert_close(energy_loss, 50_000.0 + work, 1e-9);
            assert_close(slid, sign * sliding, 1e-14);
            match (cause, expected) {
                (
                    Drive::RatioBeyond { impulse_ratio, critical: Some(critical) },
                    Drive::RatioBeyond { impulse_ratio: mu, critical: Some(expected) },
                ) => {
                    assert_close(critical, expected, 1e-15);
                    assert_close(impulse_ratio, mu, 0.0);
                }
                _ => assert_eq!(cause, expected),
            }
        }
    }
}

/// P_t = c m/2 for a change c of the tangential velocity, so that W_t = −c (2 u_t + c) m/4.
#[test]
fn a_change_of_velocity_that_drives_the_sliding() {
    for skid in &SKIDS {
        let at = |change: f64| {
            let law =
                format!("law = \"woolley\"\ntangential_velocity_change = \"{} m/s\"", skid.sign() * change);
            raised(analysis::impact, &skid.text(-4.0, 0.0, 0.0, &law), "sliding-driven")
        };
        assert_eq!(at(4.0), []);
        assert_eq!(at(8.0), []);
        for change in [-1.0, 9.0] {
            let found = at(change);
            let [Warning::SlidingDriven { tangential_work, cause: Drive::Change { change: named }, .. }] =
                found[..]
            else {
                panic!("{change}: {found:?}")
            };
            assert_close(tangential_work, -2250.0, 1e-9);
            assert_close(named, skid.sign() * change, 0.0);
        }
    }
}

/// With C 1 m beside the axis, U = 0 takes P = (20 − u_t/2, 5 − 5 u_t/4) m/2.25: the push along n alone would
/// make U_t of u_t = 1 m/s negative, so that P_t is positive. W_n = 5 P_n and W_t = −½ P_t u_t: −1.96 % of
/// E_L at 1 m/s, −2.09 % at 1.1 m/s; from 4 m/s on P_t is against the sliding.
#[test]
fn a_push_that_turns_the_sliding_round() {
    for skid in &SKIDS {
        let at = |sliding: f64| {
            let law = "restitution = 0\ntangential = \"critical\"";
            raised(analysis::impact, &skid.text(sliding, 1.0, 0.0, law), "sliding-driven")
        };
        assert_eq!(at(1.0), []);
        assert_eq!(at(-2.0), []);
        assert_eq!(at(5.0), []);
        for sliding in [1.1, 2.0] {
            let found = at(sliding);
            let [Warning::SlidingDriven { tangential_work, sliding: slid, cause: Drive::Coupling, .. }] =
                found[..]
            else {
                panic!("{sliding}: {found:?}")
            };
            assert_close(tangential_work, -500.0 * (5.0 - 1.25 * sliding) / 2.25 * sliding, 1e-9);
            assert_close(slid, skid.sign() * sliding, 1e-14);
        }
    }
}

/// Ω without a moment is ω − 5 μ, M = −4 (1 + e_m)(ω − 5 μ) m and Ω = −e_m (ω − 5 μ), so that W_m = −½ M (ω +
/// Ω). For u_t = −4 m/s, μ = 0.2 and ω = 0 that is −2 e_m (1 + e_m) m, and U_t = −2 (1 + e_m) m/s: −2.7 % of
/// E_L for e_m = 0.5, −1.4 % for 0.3. With ω = 1 rad/s, u_t = −8 m/s, μ = 0.4 and e_m = 0 it is −2 m of 68 m.
#[test]
fn a_moment_that_drives_the_rotation() {
    for skid in &SKIDS {
        let at = |sliding: f64, yaw_rate: f64, mu: f64, e_m: f64| {
            let law = skid.ratio(mu) + &format!("\nmoment_restitution = {e_m:?}");
            raised(analysis::impact, &skid.text(sliding, 0.0, yaw_rate, &law), "rotation-driven")
        };
        assert_eq!(at(-4.0, 0.0, 0.2, 0.3), []);
        assert_eq!(at(-4.0, 0.0, 0.2, -0.5), []);
        assert_eq!(at(-8.0, 1.0, 0.2, 0.0), []);
        for (sliding, yaw_rate, mu, e_m, work) in
            [(-4.0, 0.0, 0.2, 0.5, -1500.0), (-8.0, 1.0, 0.4, 0.0, -2000.0)]
        {
            let found = at(sliding, yaw_rate, mu, e_m);
            let [Warning::RotationDriven { moment_work, moment_restitution, .. }] = found[..] else {
                panic!("{found:?}")
            };
            assert_close(moment_work, work, 1e-9);
            assert_close(moment_restitution, e_m, 0.0);
        }
    }
}

/// The critical ratio is −u_t/20.
#[test]
fn a_ratio_above_one() {
    for skid in &SKIDS {
        let at = |sliding: f64, law: &str| {
            raised(analysis::impact, &skid.text(sliding, 0.0, 0.0, law), "large-impulse-ratio")
        };
        let critical = "restitution = 0\ntangential = \"critical\"";
        let fraction = "restitution = 0\ntangential = { fraction = 0.5 }";
        let friction = "restitution = 0\ntangential = { friction = 1.2 }";
        for (sliding, law, mu, limits) in [
            (-20.1, critical, 1.005, false),
            (20.1, critical, -1.005, false),
            (-40.2, fraction, 1.005, false),
            (-40.0, &skid.ratio(1.001), 1.001, false),
            (-40.0, friction, 1.2, true),
        ] {
            let found = at(sliding, law);
            let [Warning::LargeImpulseRatio { impulse_ratio, limited }] = found[..] else {
                panic!("{found:?}")
            };
            assert_close(impulse_ratio, skid.sign() * mu, 1e-12);
            assert_eq!(limited, limits);
        }
        assert_eq!(at(-19.9, critical), []);
        assert_eq!(at(-39.8, fraction), []);
        assert_eq!(at(-40.0, &skid.ratio(0.999)), []);
        assert_eq!(at(-19.9, friction), []);
    }
}

const OUTLINE: &str = "length = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\"\n";

/// A car of 1500 kg with known damage; `of_car` and `of_crush` are further keys of it.
fn damaged(car: VehicleId, of_car: &str, side: &str, width: f64, depths: &str, of_crush: &str) -> String {
    format!(
        "[vehicle{}]\nfixed = true\n[vehicle{car}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\n{of_car}[vehicle{car}.crush]\nside = \"{side}\"\n\
         width = \"{width} m\"\ndepths = \"{depths} m\"\nmoment_arm = \"0 m\"\npdof = \"0 deg\"\n{of_crush}\n",
        car.other()
    )
}

const MICRO: &str = "length = \"2.5 m\"\nwidth = \"1.3 m\"\ncg_to_front = \"1.2 m\"\n";
const SOFT: &str = "stiffness = { A = \"40 kN/m\", B = \"500 kN/m^2\" }";

#[test]
fn a_contact_point_beside_the_damage() {
    for car in VehicleId::ALL {
        let at = |side: &str, along: f64, offset: &str| {
            let contact = match side {
                "front" => [2.0, along],
                "rear" => [-2.0, along],
                "left" => [along, 0.8],
                _ => [along, -0.8],
            };
            let [x, y] = contact;
            let of_car = format!("contact = {{ x = \"{x} m\", y = \"{y} m\" }}\n");
            let text = damaged(car, &of_car, side, 1.5, "0.3 0.3", &format!("{SOFT}\n{offset}"));
            raised(analysis::crush, &text, "contact-off-damage")
        };
        for (name, side) in
            [("front", Side::Front), ("rear", Side::Rear), ("left", Side::Left), ("right", Side::Right)]
        {
            // The damage reaches from −0.55 to 0.95 m; 10 cm beyond are allowed.
            for (along, beyond) in
                [(1.049, None), (1.051, Some(0.101)), (-0.649, None), (-0.651, Some(0.101))]
            {
                let found = at(name, along, "offset = \"0.2 m\"");
                match (&found[..], beyond) {
                    ([], None) => {}
                    ([Warning::ContactOffDamage { vehicle, side: named, distance }], Some(beyond)) => {
                        assert_eq!((*vehicle, *named), (car, side));
                        assert_close(*distance, beyond, 1e-12);
                    }
                    _ => panic!("{name} {along}: {found:?}"),
                }
            }
            assert_eq!(at(name, 1.051, ""), []);
        }
    }
}

#[test]
fn a_contact_point_on_the_other_half() {
    for car in VehicleId::ALL {
        for (name, side, outward) in [
            ("front", Side::Front, [1.0, 0.0]),
            ("rear", Side::Rear, [-1.0, 0.0]),
            ("left", Side::Left, [0.0, 1.0]),
            ("right", Side::Right, [0.0, -1.0]),
        ] {
            for (distance, expected) in [(2.0, false), (-0.099, false), (-0.101, true)] {
                let [x, y] = outward.map(|share: f64| share * distance);
                let of_car = format!("contact = {{ x = \"{x} m\", y = \"{y} m\" }}\n");
                let text = damaged(car, &of_car, name, 1.5, "0.3 0.3", SOFT);
                let found = raised(analysis::crush, &text, "contact-other-half");
                match (&found[..], expected) {
                    ([], false) => {}
                    ([Warning::ContactOtherHalf { vehicle, side: named, distance }], true) => {
                        assert_eq!((*vehicle, *named), (car, side));
                        assert_close(*distance, 0.101, 1e-12);
                    }
                    _ => panic!("{name} {distance}: {found:?}"),
                }
            }
        }
    }
}

/// The outline reaches 2 m forward, 2.5 m back and 0.9 m to each side, the crush 0.2 to 0.3 m into it. On
/// front and rear 60 cm behind the deepest are allowed, on the sides 30 cm; the other half has a warning of
/// its own from 10 cm on.
#[test]
fn a_contact_point_behind_the_damage() {
    for (axes, left) in [("z-up", 1.0), ("z-down", -1.0)] {
        for car in VehicleId::ALL {
            for (name, side, face, limit, outward) in [
                ("front", Side::Front, 2.0, 0.6, [1.0, 0.0]),
                ("rear", Side::Rear, 2.5, 0.6, [-1.0, 0.0]),
                ("left", Side::Left, 0.9, 0.3, [0.0, left]),
                ("right", Side::Right, 0.9, 0.3, [0.0, -left]),
            ] {
                let at = |forward: f64, aside: f64, of_car: &str| {
                    let contact = format!("contact = {{ x = \"{forward} m\", y = \"{aside} m\" }}\n{of_car}");
                    let text = damaged(car, &contact, name, 1.2, "0.2 0.3 0.25", SOFT);
                    raised(analysis::crush, &format!("[scene]\naxes = \"{axes}\"\n{text}"), "contact-depth")
                };
                for (behind, expected) in [
                    (-0.5, false),
                    (limit - 0.001, false),
                    (limit + 0.001, true),
                    (face - 0.3, true),
                    (face - 0.3 + 0.099, true),
                    (face - 0.3 + 0.101, false),
                ] {
                    // The place along the side does not count.
                    for along in [-0.4, 0.0, 0.4] {
                        let [x, y] = outward.map(|share: f64| {
                            share * (face - 0.3 - behind) + if share == 0.0 { along } else { 0.0 }
                        });
                        match (&at(x, y, OUTLINE)[..], expected) {
                            ([], false) => {}
                            ([Warning::ContactDepth { vehicle, side: named, distance }], true) => {
                                assert_eq!((*vehicle, *named), (car, side));
                                assert_close(*distance, behind, 1e-12);
                            }
                            (found, _) => panic!("{axes} {name} {behind}: {found:?}"),
                        }
                    }
                }
                // Without an outline the position of the side is not known.
                let [x, y] = outward.map(|share| share * 0.2);
                assert_eq!(at(x, y, ""), []);
                // The outline of a class will do: class 1 has its front 76.0 in from the CG, its rear 83.8 in
                // and its sides 30.4 in, so that these are 0.27 m from it.
                assert_eq!(at(x, y, "class = 1\n").len(), usize::from(face > 0.9), "{name}");
            }
        }
    }
}

/// A front 99 in ahead of the CG with a crush of at most 14.5 in, so that the deepest is 84.5 in ahead.
#[test]
fn a_contact_point_measured_from_the_bumper() {
    const OUTLINE: &str = "length = \"200 in\"\nwidth = \"72 in\"\ncg_to_front = \"99 in\"\n";
    for (forward, behind) in [
        (84.5, None),
        (78.0, None),
        (60.0, Some(24.5)),
        (40.0, Some(44.5)),
        (20.0, Some(64.5)),
        (5.0, Some(79.5)),
    ] {
        let of_car = format!("{OUTLINE}contact = {{ x = \"{forward} in\", y = \"2 in\" }}\n");
        let depths = [3.0, 6.5, 8.8, 10.0, 11.2, 14.5].map(|inches| (inches * 0.0254).to_string()).join(" ");
        let text = damaged(VehicleId::One, &of_car, "front", 1.5, &depths, SOFT);
        match (&raised(analysis::crush, &text, "contact-depth")[..], behind) {
            ([], None) => {}
            ([Warning::ContactDepth { distance, .. }], Some(behind)) => {
                assert_close(*distance, behind * 0.0254, 1e-12);
            }
            (found, _) => panic!("{forward} in: {found:?}"),
        }
    }
}

/// In front of the face by more than 5 cm, a point lies outside of the outline; this warning needs the damage
/// alone, too.
#[test]
fn a_contact_point_in_front_of_the_damage() {
    for (name, contact) in
        [("front", [2.0, 0.0]), ("rear", [-2.5, 0.0]), ("left", [0.0, 0.9]), ("right", [0.0, -0.9])]
    {
        for (ahead, expected) in [(0.049_f64, 0), (0.051, 1)] {
            let [x, y] = contact.map(|at: f64| if at == 0.0 { at } else { at + ahead.copysign(at) });
            let of_car = format!("{OUTLINE}contact = {{ x = \"{x} m\", y = \"{y} m\" }}\n");
            let text = damaged(VehicleId::One, &of_car, name, 1.2, "0.3 0.3", SOFT);
            assert_eq!(raised(analysis::crush, &text, "contact-outside").len(), expected, "{name}");
        }
    }
}

/// The outline reaches 0.9 m to each side, 2 m forward and 2.5 m back; 10 cm beyond are allowed.
#[test]
fn a_damage_beyond_the_outline() {
    for car in VehicleId::ALL {
        for (side, offset, beyond) in [
            ("front", 0.249, false),
            ("front", 0.251, true),
            ("rear", -0.249, false),
            ("rear", -0.251, true),
            ("left", 1.349, false),
            ("left", 1.351, true),
            ("right", -1.849, false),
            ("right", -1.851, true),
        ] {
            let of_crush = format!("{SOFT}\noffset = \"{offset} m\"");
            let text = damaged(car, OUTLINE, side, 1.5, "0.3 0.3", &of_crush);
            let found = raised(analysis::crush, &text, "damage-outside");
            match (&found[..], beyond) {
                ([], false) => {}
                ([Warning::DamageOutside { vehicle, distance, .. }], true) => {
                    assert_eq!(*vehicle, car);
                    assert_close(*distance, 0.101, 1e-12);
                }
                _ => panic!("{side} {offset}: {found:?}"),
            }
            let text = damaged(car, "", side, 1.5, "0.3 0.3", &of_crush);
            assert_eq!(raised(analysis::crush, &text, "damage-outside"), []);
        }
    }
}

#[test]
fn numbers_that_no_vehicle_has() {
    use Magnitude::{BodyWidth, CrushDepth, DamageWidth, Length, Mass, YawRadius};
    for car in VehicleId::ALL {
        let found = |text: &str| raised(analysis::crush, text, "implausible");
        let check = |text: &str, expected: Option<(Magnitude, f64, [f64; 2])>| {
            let found = found(text);
            match (&found[..], expected) {
                ([], None) => {}
                (
                    [
                        Warning::Implausible {
                            vehicle, magnitude, value, usual, kind: VehicleKind::Car, ..
                        },
                    ],
                    Some((what, number, range)),
                ) => {
                    assert_eq!((*vehicle, *magnitude), (car, what));
                    assert_close(*value, number, 1e-9);
                    assert_close(usual[0], range[0], 1e-12);
                    assert_close(usual[1], range[1], 1e-9);
                }
                _ => panic!("{found:?} of\n{text}"),
            }
        };
        let plain = damaged(car, "", "front", 1.5, "0.3 0.3", SOFT);
        check(&plain, None);
        let with_outline = damaged(car, OUTLINE, "front", 1.5, "0.3 0.3", SOFT);
        check(&with_outline, None);
        for (text, mass, usual) in [
            (&plain, 299.0, Some([300.0, 5000.0])),
            (&plain, 301.0, None),
            (&plain, 4999.0, None),
            (&plain, 5001.0, Some([300.0, 5000.0])),
            // 100 and 350 kg/m² on 4.5 m by 1.8 m
            (&with_outline, 2834.0, None),
            (&with_outline, 2836.0, Some([810.0, 2835.0])),
            (&with_outline, 811.0, None),
            (&with_outline, 809.0, Some([810.0, 2835.0])),
        ] {
            let text = text.replace("1500 kg", &format!("{mass} kg"));
            check(&text, usual.map(|usual| (Mass, mass, usual)));
        }
        for (radius, unusual) in [(0.79, true), (0.81, false), (2.19, false), (2.21, true)] {
            let text = plain.replace("1.4 m", &format!("{radius} m"));
            check(&text, unusual.then_some((YawRadius, radius, [0.8, 2.2])));
        }
        // I = m k²
        let text = plain.replace("yaw_radius = \"1.4 m\"", "yaw_inertia = \"37500 kg m^2\"");
        check(&text, Some((YawRadius, 5.0, [0.8, 2.2])));
        for (of_car, side, most) in [
            ("", "front", 1.5),
            ("", "left", 1.5),
            (OUTLINE, "front", 1.5),
            (OUTLINE, "right", 1.5),
            (MICRO, "front", 1.25),
            (MICRO, "rear", 1.25),
            (MICRO, "left", 1.3),
            (MICRO, "right", 1.3),
        ] {
            // A mass for all three sizes.
            let at = |depth: f64| {
                damaged(car, of_car, side, 1.3, &format!("0.3 {depth} 0.3"), SOFT)
                    .replace("1500 kg", "1000 kg")
            };
            check(&at(most - 0.01), None);
            check(&at(most + 0.01), Some((CrushDepth, most + 0.01, [0.0, most])));
        }
        for (of_car, side, most) in [
            ("", "front", 2.6),
            ("", "rear", 2.6),
            ("", "left", 6.0),
            ("", "right", 6.0),
            (OUTLINE, "front", 1.98),
            (OUTLINE, "left", 4.95),
        ] {
            let at = |width: f64| damaged(car, of_car, side, width, "0.3 0.3", SOFT);
            check(&at(most - 0.01), None);
            check(&at(most + 0.01), Some((DamageWidth, most + 0.01, [0.0, most])));
        }
        let body = |length: f64, width: f64| {
            let of_car = format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"0.9 m\"\n");
            let mass = (150.0 * length * width).max(400.0);
            damaged(car, &of_car, "front", 0.5, "0.3 0.3", SOFT).replace("1500 kg", &format!("{mass} kg"))
        };
        for (length, width, unusual) in [
            (2.21, 1.21, None),
            (7.49, 2.59, None),
            (2.19, 1.21, Some((Length, 2.19, [2.2, 7.5]))),
            (7.51, 2.59, Some((Length, 7.51, [2.2, 7.5]))),
            (2.21, 1.19, Some((BodyWidth, 1.19, [1.2, 2.6]))),
            (7.49, 2.61, Some((BodyWidth, 2.61, [1.2, 2.6]))),
        ] {
            check(&body(length, width), unusual);
        }
        // 4.5 ft and 0.6 ft of length and width: no bounds follow from such a body for mass, depth and width
        // of the damage.
        let text = body(1.37, 0.18);
        assert_eq!(found(&text).len(), 2, "{:?}", found(&text));
    }
}

/// Sizes as published: a loaded five-axle combination at the legal US limit, its box trailer, a middleweight
/// motorcycle with its rider, and a delivery van of 3.5 t.
#[test]
fn each_kind_has_usual_sizes_of_its_own() {
    let body = |[length, width]: [f64; 2]| {
        format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"{} m\"\n", length / 2.0)
    };
    for (kind, mass, radius, size, fits) in [
        ("heavy-truck", 36_287.0, 16.0 * 0.3048, [21.0, 2.6], vec!["heavy-truck", "trailer"]),
        ("trailer", 30_000.0, 4.0, [13.6, 2.55], vec!["heavy-truck", "trailer"]),
        ("motorcycle", 290.0, 0.55, [2.1, 0.58], vec!["trailer", "motorcycle"]),
        ("car", 3500.0, 1.7, [5.9, 2.0], vec![]),
    ] {
        let case = |of_car: &str| {
            damaged(VehicleId::One, of_car, "front", 0.5, "0.2 0.2", SOFT)
                .replace("1500 kg", &format!("{mass} kg"))
                .replace("1.4 m", &format!("{radius} m"))
        };
        let with_kind = case(&format!("kind = \"{kind}\"\n{}", body(size)));
        for code in ["implausible", "low-no-damage-speed", "high-no-damage-speed"] {
            assert_eq!(raised(analysis::crush, &with_kind, code), [], "{kind}");
        }
        // If the file does not give the kind of vehicle, the first warning about its mass names the possible
        // kinds.
        let unsaid = raised(analysis::crush, &case(""), "implausible");
        let of_mass = unsaid.iter().find_map(|warning| match warning {
            Warning::Implausible { magnitude: Magnitude::Mass, others, .. } => Some(others.clone()),
            _ => None,
        });
        let names: Vec<&str> = of_mass.into_iter().flatten().map(VehicleKind::name).collect();
        assert_eq!(names, fits, "{kind}");
    }
    // A kind that is given is not doubted.
    let car =
        damaged(VehicleId::One, "kind = \"car\"\n", "front", 0.5, "0.2 0.2", SOFT).replace("1500 kg", "30 t");
    let found = raised(analysis::crush, &car, "implausible");
    assert!(
        matches!(&found[..], [Warning::Implausible { kind: VehicleKind::Car, others, .. }] if others.is_empty()),
        "{found:?}"
    );
    // A wall may have any size.
    let wall = damaged(VehicleId::One, "", "front", 0.5, "0.2 0.2", SOFT)
        .replace("fixed = true\n", &format!("fixed = true\n{}", body([0.55, 60.0])));
    assert_eq!(raised(analysis::crush, &wall, "implausible"), []);
}

#[test]
fn speeds_that_no_vehicle_has() {
    for skid in &SKIDS {
        let text = skid.text(-4.0, 0.0, 0.0, "restitution = 0\ntangential = { friction = 0.4 }");
        // (v, 0): along the wall nothing moves.
        let at = |speed: f64| {
            let start = text.find("velocity").unwrap();
            let end = start + text[start..].find('\n').unwrap();
            let text = format!("{}speed = \"{speed} m/s\"{}", &text[..start], &text[end..]);
            raised(analysis::impact, &text, "implausible")
        };
        // 250 km/h
        assert_eq!(at(69.44), []);
        let found = at(69.45);
        let [Warning::Implausible { vehicle, magnitude: Magnitude::Speed, value, usual, others, .. }] =
            &found[..]
        else {
            panic!("{found:?}")
        };
        assert_eq!((*vehicle, *usual), (skid.car, [0.0, 250.0 / 3.6]));
        assert_eq!(*others, [VehicleKind::Motorcycle]);
        assert_close(*value, 69.45, 1e-12);
    }
}

/// One that is found: the crush of two equal cars head-on, e = 0, W_n = ½ (m/2) x² = 2 E, with E = w B/2 (C +
/// A/B)² of each.
#[test]
fn a_speed_found_that_no_vehicle_has() {
    let at = |speed: f64| {
        // C + A/B = x √(m/(4 w B)) of an empty A.
        let depth = speed * (1500.0_f64 / (4.0 * 1.5 * 2e6)).sqrt();
        let car = |heading: f64| {
            format!(
                "mass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\ncontact = {{ x = \"1.5 m\", y = \"0 m\" }}\n"
            )
        };
        let crush = format!(
            "side = \"front\"\nwidth = \"1.5 m\"\ndepths = \"{depth} {depth} m\"\nstiffness = {{ A = \"0 N/m\", B = \"2000 kN/m^2\" }}\n"
        );
        format!(
            "[vehicle1]\n{}[vehicle1.crush]\n{crush}[vehicle2]\n{}speed = \"0 m/s\"\n[vehicle2.crush]\n{crush}[impact]\ncrush_plane = \"0 deg\"\n\
             restitution = 0\ntangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n",
            car(0.0),
            car(180.0)
        )
    };
    assert_eq!(raised(analysis::reconstruct, &at(69.44), "implausible"), []);
    let found = raised(analysis::reconstruct, &at(69.45), "implausible");
    let [Warning::Implausible { vehicle: VehicleId::One, magnitude: Magnitude::SpeedFound, value, .. }] =
        found[..]
    else {
        panic!("{found:?}")
    };
    assert_close(value, 69.45, 1e-9);
}

/// b_0 = √(2 G w/m): 6.7056 m/s at G = 22,482.5 N on 1.5 m and 1500 kg.
#[test]
fn a_stiffness_that_withstands_too_much() {
    for car in VehicleId::ALL {
        let speed = |stiffness: &str, stations: &str| {
            let text = damaged(car, "", "front", 1.5, stations, stiffness);
            let analysis = analysis::crush(&parsed(&text)).unwrap();
            assert_eq!(analysis.vehicles[car.other().index()].no_damage_speed(), None);
            (
                analysis.vehicles[car.index()].no_damage_speed().unwrap(),
                raised(analysis::crush, &text, "high-no-damage-speed"),
            )
        };
        let high = 15.0 * 0.447_04;
        let (low, found) =
            speed("stiffness = { A = \"40 kN/m\", B = \"500 kN/m^2\", G = \"22482 N\" }", "0.3 0.3");
        assert_close(low, high, 1e-4);
        assert_eq!(found, []);
        // A = √(2 G B) and d_0 = √(2 G) beyond.
        for (stiffness, source) in [
            ("{ A = \"40 kN/m\", B = \"500 kN/m^2\", G = \"22483 N\" }", StiffnessSource::Coefficients),
            ("{ A = \"149943.5 N/m\", B = \"500 kN/m^2\" }", StiffnessSource::Coefficients),
            ("{ d0 = \"212.0522 N^0.5\", d1 = \"700 N^0.5/m\" }", StiffnessSource::Roots),
        ] {
            let (found, warning) = speed(&format!("stiffness = {stiffness}"), "0.3 0.3");
            assert_close(found, high, 1e-3);
            assert_eq!(
                warning,
                [Warning::HighNoDamageSpeed { vehicle: car, speed: found, source }],
                "{stiffness}"
            );
        }
        // Σ G w of two zones of 0.75 m: 30,000 N · 1.5 m /2 + 14,970 N · 1.5 m /2 is 22,485 N · 1.5 m.
        let zone = |g: f64| format!("{{ A = \"40 kN/m\", B = \"500 kN/m^2\", G = \"{g} N\" }}");
        let zones = format!("stiffness = {{ zones = [{}, {}] }}", zone(30_000.0), zone(14_970.0));
        let (found, warning) = speed(&zones, "0.3 0.2 0.3");
        assert_close(found, (2.0 * 22_485.0 * 1.5 / 1500.0_f64).sqrt(), 1e-12);
        assert!(matches!(warning[..], [Warning::HighNoDamageSpeed { source: StiffnessSource::Zones, .. }]));
        // A fit to a test of the same car gives the test's own b_0 back.
        let test = |b_0: f64| {
            format!(
                "stiffness = {{ test = {{ mass = \"1500 kg\", speed = \"15 m/s\", width = \"1.5 m\", depths = \"0.5 0.5 m\", no_damage_speed = \"{b_0} m/s\" }} }}"
            )
        };
        let (found, warning) = speed(&test(2.2), "0.3 0.3");
        assert_close(found, 2.2, 1e-12);
        assert_eq!(warning, []);
        let (_, warning) = speed(&test(6.71), "0.3 0.3");
        assert!(matches!(warning[..], [Warning::HighNoDamageSpeed { source: StiffnessSource::Test(_), .. }]));
    }
}

/// b_0 = √(2 G w/m): 0.447 04 m/s, 1 mph, at G = 99.922 N on 1.5 m and 1500 kg; A = √(2 G B).
#[test]
fn a_stiffness_that_withstands_too_little() {
    for car in VehicleId::ALL {
        let found = |stiffness: &str| {
            let text = damaged(car, "", "front", 1.5, "0.3 0.3", &format!("stiffness = {stiffness}"));
            raised(analysis::crush, &text, "low-no-damage-speed")
        };
        let given = |a: &str, g: &str| format!("{{ A = \"{a}\", B = \"500 kN/m^2\"{g} }}");
        assert_eq!(found(&given("40 kN/m", ", G = \"99.93 N\"")), []);
        assert_eq!(found(&given("9997 N/m", "")), []);
        for (stiffness, source) in [
            (given("40 kN/m", ", G = \"99.91 N\""), StiffnessSource::Coefficients),
            (given("9995 N/m", ""), StiffnessSource::Coefficients),
            ("{ d0 = \"14.135 N^0.5\", d1 = \"700 N^0.5/m\" }".to_owned(), StiffnessSource::Roots),
        ] {
            let found = found(&stiffness);
            let [Warning::LowNoDamageSpeed { vehicle, speed, source: of }] = found[..] else {
                panic!("{stiffness}: {found:?}")
            };
            assert_eq!((vehicle, of), (car, source));
            assert_close(speed, 0.447_04, 1e-3);
        }
        // A line through the origin is meant.
        assert_eq!(found(&given("0 N/m", "")), []);
    }
}

#[test]
fn a_barrier_test_that_no_car_has() {
    use Magnitude::{TestDepth, TestMass, TestSpeed, TestWidth};
    for car in VehicleId::ALL {
        for (side, keys, expected) in [
            ("front", ["1500 kg", "15 m/s", "1.5 m", "0.5 0.5 m"], None),
            ("front", ["301 kg", "2.1 m/s", "2.59 m", "0.1 1.49 m"], None),
            ("front", ["299 kg", "15 m/s", "1.5 m", "0.5 0.5 m"], Some((TestMass, 299.0, [300.0, 5000.0]))),
            (
                "front",
                ["1500 kg", "1.9 m/s", "1.5 m", "0.5 0.5 m"],
                Some((TestSpeed, 1.9, [2.0, 100.0 / 3.6])),
            ),
            (
                "front",
                ["1500 kg", "27.8 m/s", "1.5 m", "0.5 0.5 m"],
                Some((TestSpeed, 27.8, [2.0, 100.0 / 3.6])),
            ),
            ("front", ["1500 kg", "15 m/s", "2.61 m", "0.5 0.5 m"], Some((TestWidth, 2.61, [0.0, 2.6]))),
            ("left", ["1500 kg", "15 m/s", "2.61 m", "0.5 0.5 m"], None),
            ("front", ["1500 kg", "15 m/s", "1.5 m", "0.5 1.51 m"], Some((TestDepth, 1.51, [0.0, 1.5]))),
        ] {
            let [mass, speed, width, depths] = keys;
            let stiffness = format!(
                "stiffness = {{ test = {{ mass = \"{mass}\", speed = \"{speed}\", width = \"{width}\", depths = \"{depths}\", no_damage_speed = \"1.5 m/s\" }} }}"
            );
            let text = damaged(car, "", side, 1.5, "0.3 0.3", &stiffness);
            let found = raised(analysis::crush, &text, "implausible");
            match (&found[..], expected) {
                ([], None) => {}
                (
                    [
                        Warning::Implausible {
                            vehicle, magnitude, value, usual, kind: VehicleKind::Car, ..
                        },
                    ],
                    Some(expected),
                ) => {
                    assert_eq!((*vehicle, (*magnitude, *value, *usual)), (car, expected), "{stiffness}");
                }
                _ => panic!("{stiffness}: {found:?}"),
            }
            assert_eq!(
                analysis::judge(&parsed(&text))
                    .warnings
                    .iter()
                    .filter(|one| one.code() == "implausible")
                    .count(),
                found.len()
            );
        }
    }
}

#[test]
fn a_friction_limit_that_vehicles_have_not() {
    for skid in &SKIDS {
        for law in [
            "law = \"brach\"\nrestitution = 0.1\ntangential = { friction = MU }",
            "law = \"kudlich-slibar\"\nrestitution = 0.1\nfriction = MU",
        ] {
            for (friction, unusual) in
                [(0.09, true), (0.11, false), (0.99, false), (1.01, true), (45.0, true), (0.0, true)]
            {
                let text = skid.text(-4.0, 0.0, 0.0, &law.replace("MU", &format!("{friction:?}")));
                let expected = if unusual { vec![Warning::UnusualFriction { friction }] } else { Vec::new() };
                assert_eq!(raised(analysis::impact, &text, "unusual-friction"), expected);
            }
            let text = skid.text(-4.0, 0.0, 0.0, &law.replace("MU", "1.01"));
            let judged = analysis::judge(&parsed(&text)).warnings;
            assert!(judged.contains(&Warning::UnusualFriction { friction: 1.01 }));
        }
    }
}

/// The cars of the fleet are of 1991 to 2018, and their depths go over the whole end (docs/calibration.md).
#[test]
fn a_car_that_the_fleet_does_not_have() {
    let text = |year: &str, side: &str, width: &str, stiffness: &str| {
        format!(
            "[vehicle1]\nmass = \"1500 kg\"\nlength = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\"\n{year}\n\
             [vehicle1.crush]\nside = \"{side}\"\nwidth = \"{width}\"\ndepths = \"20 20 cm\"\nstiffness = {stiffness}\n"
        )
    };
    let fleet = "\"fleet\"";
    for (year, side, width, stiffness, expected) in [
        ("model_year = 1990", "front", "170 cm", fleet, Some((Some(1990), None))),
        ("model_year = 1991", "front", "136 cm", fleet, None),
        ("model_year = 2018", "rear", "136 cm", fleet, None),
        ("model_year = 2019", "left", "60 cm", fleet, Some((Some(2019), None))),
        ("", "front", "134 cm", fleet, Some((None, Some([1.34, 1.8])))),
        ("model_year = 1972", "rear", "80 cm", fleet, Some((Some(1972), Some([0.8, 1.8])))),
        ("", "left", "60 cm", fleet, None),
        ("model_year = 1972", "front", "80 cm", "{ category = 3 }", None),
    ] {
        let judged = analysis::judge(&parsed(&text(year, side, width, stiffness))).warnings;
        let found = judged.iter().find_map(|warning| match warning {
            Warning::UnlikeFleet { vehicle: VehicleId::One, model_year, widths } => {
                Some((*model_year, *widths))
            }
            _ => None,
        });
        assert_eq!(found, expected, "{year} {side} {width} {stiffness}");
    }
}

/// EDCRASH manual: smooth ice has 0.07 and more, new dry asphalt up to 1.2.
#[test]
fn a_friction_that_no_ground_has() {
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let own = "[vehicle1.after]\n";
    let skid = "skid = { length = \"8 m\"";
    assert!(text.contains("friction = 0.7\n") && text.contains(own) && text.contains(skid));
    for (friction, is_unusual) in [(0.069, true), (0.071, false), (1.19, false), (1.21, true), (0.001, true)]
    {
        for (path, text) in [
            ("surface.friction", text.replace("friction = 0.7\n", &format!("friction = {friction:?}\n"))),
            ("vehicle1.after.friction", text.replace(own, &format!("{own}friction = {friction:?}\n"))),
            (
                "vehicle1.before.skid.friction",
                text.replace(skid, &format!("{skid}, friction = {friction:?}")),
            ),
        ] {
            let judged = analysis::judge(&parsed(&text)).warnings;
            let of = |warning: &Warning| match warning {
                Warning::GroundFriction { path, friction, usual: [0.07, 1.2] } => {
                    Some((path.clone(), *friction))
                }
                _ => None,
            };
            let found: Vec<(String, f64)> = judged.iter().filter_map(of).collect();
            let expected = if is_unusual { vec![(path.to_owned(), friction)] } else { Vec::new() };
            assert_eq!(found, expected);
        }
    }
}

/// A speed that is given although it is sought is not used, whatever its sign.
#[test]
fn a_speed_that_is_given_backwards() {
    for skid in &SKIDS {
        let law = "restitution = 0\ntangential = { friction = 0.4 }";
        let text = skid.text(-4.0, 0.0, 0.0, law);
        assert_eq!(raised(analysis::impact, &text, "moves-backward"), []);
        let start = text.find("velocity").unwrap();
        let end = start + text[start..].find('\n').unwrap();
        let backwards = |speed: &str| {
            // It drives onto the wall in reverse.
            let text = format!("{}speed = \"{speed}\"{}", &text[..start], &text[end..]);
            text.replace("x = \"2 m\"", "x = \"-2 m\"")
        };
        let expected = Warning::MovesBackward { vehicle: skid.car, speed: -10.0, found: false };
        assert_eq!(
            raised(analysis::impact, &backwards("-10 m/s"), "moves-backward"),
            std::slice::from_ref(&expected)
        );
        assert!(analysis::judge(&parsed(&backwards("-10 m/s"))).warnings.contains(&expected));
        let sought = backwards("-10 m/s") + &format!("[reconstruct]\nfind = \"vehicle{}.speed\"\n", skid.car);
        assert!(!analysis::judge(&parsed(&sought)).warnings.iter().any(|one| one.code() == "moves-backward"));
    }
}

/// CRASH3's own categories stay below over the width of any of its cars, but for the rear of category 4.
#[test]
fn crash3_s_categories_withstand_less() {
    for (side, category, mass, width) in [
        // Length and width of SAE 870045, Table 2; masses of cars of those sizes.
        ("front", 1, 950, 1.54),
        ("front", 2, 1200, 1.71),
        ("front", 3, 1500, 1.84),
        ("front", 4, 1800, 1.96),
        ("front", 5, 2100, 2.01),
        ("rear", 1, 950, 1.54),
        ("rear", 2, 1200, 1.71),
        ("rear", 3, 1500, 1.84),
        ("rear", 5, 2100, 2.01),
        ("left", 1, 950, 2.0),
        ("right", 5, 2100, 2.0),
    ] {
        let text = damaged(
            VehicleId::One,
            "",
            side,
            width,
            "0.3 0.3",
            &format!("stiffness = {{ category = {category} }}"),
        )
        .replace("1500 kg", &format!("{mass} kg"));
        let speed =
            analysis::crush(&parsed(&text)).unwrap().vehicles[0].no_damage_speed().unwrap() / 0.447_04;
        assert!((2.5..11.5).contains(&speed), "{side} {category}: {speed} mph");
    }
}

#[test]
fn angles_of_more_than_a_turn() {
    let skid = &SKIDS[0];
    let text = skid.text(-4.0, 0.0, 0.0, "restitution = 0\ntangential = { friction = 0.4 }");
    let at = |from: &str, to: &str| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        raised(analysis::impact, &text.replace(from, to), "large-angle")
    };
    for to in ["360 deg", "-360 deg", "6.28 rad"] {
        assert_eq!(at("heading = \"0 deg\"", &format!("heading = \"{to}\"")), []);
    }
    // 10 rad and 361° in turns of 2π and 360°.
    for (from, key, to, path, expected, degrees) in [
        ("heading = \"0 deg\"", "heading", "-361 deg", "vehicle1.heading", 361.0 / 360.0, true),
        (
            "crush_plane = \"0 deg\"",
            "crush_plane",
            "10 rad",
            "impact.crush_plane",
            5.0 / std::f64::consts::PI,
            false,
        ),
    ] {
        let found = at(from, &format!("{key} = \"{to}\""));
        let [Warning::LargeAngle { path: named, turns, in_degrees }] = &found[..] else {
            panic!("{found:?}")
        };
        assert_eq!((&**named, *in_degrees), (path, degrees));
        assert_close(*turns, expected, 1e-14);
    }
    let text = damaged(VehicleId::Two, "", "front", 1.5, "0.3 0.3", SOFT)
        .replace("pdof = \"0 deg\"", "pdof = \"365 deg\"");
    let found = raised(analysis::crush, &text, "large-angle");
    assert!(
        matches!(&found[..], [Warning::LargeAngle { path, .. }] if path == "vehicle2.crush.pdof"),
        "{found:?}"
    );
}

#[test]
fn no_crush_is_an_upper_bound() {
    for car in VehicleId::ALL {
        let at = |depths: &str| {
            let text = damaged(car, "", "front", 1.5, depths, SOFT);
            raised(analysis::crush, &text, "no-residual-crush")
        };
        assert_eq!(at("0 0.001 0"), []);
        let found = at("0 0 0");
        let [Warning::NoResidualCrush { vehicle, energy }] = found[..] else { panic!("{found:?}") };
        assert_eq!(vehicle, car);
        // w A²/2B = 1.5 · 40²/1000 kJ
        assert_close(energy, 2400.0, 1e-9);
    }
}

/// From (18, 15) m to the CG at (6, 13.75) m is a direction of atan2(−1.25, −12) = −174.05°, and a heading of
/// 195° with a sideslip of −4.35° one of −169.35°. With the sign of x wrong, the marks come from the
/// other side.
#[test]
fn skid_marks_from_elsewhere_are_told() {
    let text = include_str!("../../../fixtures/edcrash-tutorial.toml");
    let at = |text: &str| raised(analysis::reconstruct, text, "skid-direction");
    assert_eq!(at(text), []);
    let found = at(&text.replace("from = { x = \"18.00 m\"", "from = { x = \"-18.00 m\""));
    let [Warning::SkidDirection { vehicle, skid, course }] = found[..] else { panic!("{found:?}") };
    assert_eq!(vehicle, VehicleId::One);
    assert_close(skid, real::elementary::atan2(13.75 - 15.0, 6.0 + 18.0), 1e-12);
    assert_close(course, (195.0_f64 - 4.35 - 360.0).to_radians(), 1e-12);
}

/// A grade of the ground changes the speed by a skid, unless the skid's own friction contains it.
#[test]
fn a_skid_on_a_grade_is_told() {
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let graded =
        text.replace("friction = 0.7\n", "friction = 0.7\ngrade = { slope = 0.1, uphill = \"0 deg\" }\n");
    let at = |text: &str| raised(analysis::reconstruct, text, "skid-on-grade");
    assert_eq!(at(text), []);
    assert_eq!(at(&graded), [Warning::SkidOnGrade { vehicle: VehicleId::One }]);
    assert_eq!(at(&graded.replace("length = \"8 m\"", "length = \"8 m\", friction = 0.8")), []);
    // Along the slope, the skid neither rises nor falls: 10 % sin 5° = 0.9 %.
    assert_eq!(at(&graded.replace("\"0 deg\" }", "\"85 deg\" }")), []);
    assert_eq!(at(&graded.replace("\"0 deg\" }", "\"80 deg\" }")).len(), 1);
}

/// Without friction and lever arm, a wall takes the velocity across it, v cos φ, and leaves v sin φ along it.
#[test]
fn an_object_that_took_energy_is_not_passed() {
    let at = |angle: f64, energy: &str| {
        let text = format!(
            "[vehicle1]\nmass = \"1000 kg\"\nyaw_radius = \"2 m\"\nheading = \"{angle} deg\"\n\
             speed = \"10 m/s\"\ncontact = {{ distance = \"2 m\", angle = \"{} deg\" }}\n\
             [vehicle2]\nfixed = true\n{energy}\n\
             [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0\ntangential = {{ friction = 0 }}\n",
            -angle
        );
        raised(analysis::impact, &text, "object-passed")
    };
    let bent = "deformation_energy = \"5 kJ\"";
    // sin 29° < 0.5 < sin 31°
    assert_eq!(at(29.0, bent), []);
    assert_eq!(at(31.0, ""), []);
    for angle in [31.0_f64, 70.0] {
        let found = at(angle, bent);
        let [Warning::ObjectPassed { vehicle, speeds: [before, after] }] = found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(vehicle, VehicleId::One);
        assert_close(before, 10.0, 1e-12);
        assert_close(after, 10.0 * real::Real::sin_cos(angle.to_radians()).0, 1e-12);
    }
}

/// PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180° (theory 5) is what every command takes.
#[test]
fn one_pdof_gives_the_other_to_every_command() {
    let text = include_str!("../../../fixtures/sae-980025.toml");
    for (side, other, given, opposite) in [
        ("front", VehicleId::Two, 20.0, 67.0 - 180.0 + 20.0 - 180.0 + 360.0),
        ("right", VehicleId::One, 80.0, 180.0 - 67.0 + 80.0 - 180.0),
    ] {
        let line = format!("side      = \"{side}\"");
        assert_eq!(text.matches(&line).count(), 1);
        let file = parsed(&text.replace(&line, &format!("{line}\npdof = \"{given} deg\"")));
        let reconstructed = analysis::reconstruct(&file).unwrap();
        let crushed = analysis::crush(&file).unwrap();
        let compared = analysis::compare(&file).unwrap().own;
        let sweep = analysis::Sweep { step: 0.1, steps: 1 };
        let swept = analysis::sensitivity(&file, sweep).unwrap();
        for analysis in [&reconstructed, &crushed, &compared, &swept.nominal] {
            let pdof = |id: VehicleId| {
                analysis.vehicles[id.index()].damage.as_ref().unwrap().pdof.unwrap().to_degrees()
            };
            assert_close(pdof(other.other()), given, 1e-12);
            assert_close(pdof(other), opposite, 1e-12);
            // The file gives one: there is nothing to compare it with but the impulse.
            assert!(analysis.checks.iter().all(|check| check.code() != "pdofs-opposite"));
            assert_eq!(
                format!("{:?}", analysis.crash3.as_ref().map(|crash3| crash3.corrected)),
                format!("{:?}", crushed.crash3.as_ref().map(|crash3| crash3.corrected)),
            );
        }
        assert_close(swept.pdof_sweep[1].pdof[other.index()].unwrap().to_degrees(), opposite, 1e-12);
        // The impulse's are 2.8° and 69.8° (paper, appendix).
        let differ: Vec<&Warning> =
            reconstructed.warnings.iter().filter(|warning| warning.code() == "pdof-differs").collect();
        assert!(
            matches!(differ[..], [Warning::PdofDiffers { vehicle, .. }] if *vehicle == other.other()),
            "{differ:?}"
        );
    }
}
