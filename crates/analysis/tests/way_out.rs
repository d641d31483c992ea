//! How far the other vehicle goes until it has left the danger zone, by the outlines of both.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use std::ops::ControlFlow;

use analysis::{AvoidPlan, Avoidance, Failure, estimate};
use case::CaseFile;
use proptest::prelude::*;

use crate::avoid::asked_with;

fn asked(text: &str) -> Result<Avoidance, Failure> {
    asked_with(text, AvoidPlan { samples: 200, ..AvoidPlan::default() })
}

/// Two vehicles that touch: their headings (deg), contact points and bodies (m).
#[derive(Clone, Debug)]
struct Touching {
    headings: [f64; 2],
    contacts: [[f64; 2]; 2],
    /// Length, width, and from the CG to the front.
    bodies: [[f64; 3]; 2],
}

fn turned([x, y]: [f64; 2], degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

impl Touching {
    /// (m) of the CG of the second, from that of the first.
    fn apart(&self) -> [f64; 2] {
        let [one, two] = [0, 1].map(|i| turned(self.contacts[i], self.headings[i]));
        [one[0] - two[0], one[1] - two[1]]
    }

    /// The corners of the second, from its CG.
    fn corners(&self) -> [[f64; 2]; 4] {
        let [length, width, front] = self.bodies[1];
        [front, front - length]
            .map(|x| [0.5, -0.5].map(|side| [x, side * width]))
            .as_flattened()
            .try_into()
            .unwrap()
    }

    /// (m) how far the second is beside the strip of the first, by its corners; negative if it is in it.
    fn beside(&self) -> f64 {
        let across = turned([0.0, 1.0], self.headings[0]);
        let apart = self.apart();
        let aside = self.corners().map(|corner| {
            let at = turned(corner, self.headings[1]);
            (apart[0] + at[0]) * across[0] + (apart[1] + at[1]) * across[1]
        });
        let half = 0.5 * self.bodies[0][1];
        let [least, most] = [f64::min, f64::max].map(|of| aside.into_iter().reduce(of).unwrap());
        (least - half).max(-half - most)
    }

    /// By halvings, how far the second goes, forward (1) or backward (−1), until none of its corners is in
    /// the strip or beyond it, on the side from which it came.
    fn by_corners(&self, sign: f64) -> f64 {
        let half = 0.5 * self.bodies[0][1];
        let ahead = turned([sign, 0.0], self.headings[1]);
        let across = turned([0.0, 1.0], self.headings[0]);
        let side = (ahead[0] * across[0] + ahead[1] * across[1]).signum();
        let is_out = |way: f64| {
            self.corners().iter().all(|corner| {
                let at = turned(*corner, self.headings[1]);
                let apart = self.apart();
                let at = [apart[0] + at[0] + way * ahead[0], apart[1] + at[1] + way * ahead[1]];
                side * (at[0] * across[0] + at[1] * across[1]) >= half
            })
        };
        if is_out(0.0) {
            return 0.0;
        }
        let (mut within, mut out) = (0.0, 1e4);
        assert!(is_out(out));
        for _ in 0..100 {
            let middle = f64::midpoint(within, out);
            if is_out(middle) { out = middle } else { within = middle }
        }
        out
    }

    fn text(&self, axes: &str, by_positions: bool) -> String {
        let sign = if axes == "z-down" { -1.0 } else { 1.0 };
        let apart = self.apart();
        let places = [[3.0, -2.0], [3.0 + apart[0], -2.0 + apart[1]]];
        let vehicle = |i: usize| {
            let [length, width, front] = self.bodies[i];
            let (key, [x, y]) =
                if by_positions { ("position", places[i]) } else { ("contact", self.contacts[i]) };
            format!(
                "[vehicle{}]\nspeed = \"{} m/s\"\nheading = \"{} deg\"\nlength = \"{length} m\"\nwidth = \"{width} m\"\n\
                 cg_to_front = \"{front} m\"\n{key} = {{ x = \"{x} m\", y = \"{} m\" }}\n",
                i + 1,
                20 - 10 * i,
                sign * self.headings[i],
                sign * y
            )
        };
        format!(
            "[scene]\naxes = \"{axes}\"\n{}{}[avoid]\nlimit = \"18 m/s\"\nreaction_time = \"1 s\"\nunbraked = true\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"40 m\" }}\nclear = {{ outlines = true }}\n",
            vehicle(0),
            vehicle(1)
        )
    }
}

fn touching() -> impl Strategy<Value = Touching> {
    let body = || (3.5..5.5_f64, 1.5..2.2_f64, 0.4..0.6_f64).prop_map(|(l, w, share)| [l, w, share * l]);
    let contact = || [-2.0..2.0_f64, -1.0..1.0_f64];
    // Crossing at 6° and more.
    let crossing = (6.0..174.0_f64, any::<bool>());
    (0.0..360.0_f64, crossing, [contact(), contact()], [body(), body()]).prop_map(
        |(first, (angle, is_left), contacts, bodies)| Touching {
            headings: [first, first + if is_left { angle } else { -angle }],
            contacts,
            bodies,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// However the scene is turned, in either axes, by contact points or positions. The other moves on with
    /// the 10 m/s of its table, or backs with them. Contact points may be outside of the outlines, so far
    /// that these do not meet: that is refused.
    #[test]
    fn the_zone_is_clear_when_the_outline_has_left_it(touching in touching()) {
        for sign in [1.0, -1.0] {
            let expected = touching.by_corners(sign);
            for (axes, by_positions) in [("z-up", false), ("z-up", true), ("z-down", false), ("z-down", true)] {
                let speed = format!("speed = \"{} m/s\"", 10.0 * sign);
                let text = touching.text(axes, by_positions).replace("speed = \"10 m/s\"", &speed);
                if touching.beside() > 1e-6 {
                    let refused = asked(&text).unwrap_err().to_string();
                    prop_assert!(refused.contains("by their outlines the vehicles do not meet"), "{refused}");
                    continue;
                }
                let found = asked(&text).unwrap().scene.clears.unwrap();
                prop_assert!((found.distance - expected).abs() < 1e-9 * (1.0 + expected), "{found:?} {expected}");
                prop_assert!((10.0 * found.after - expected).abs() < 1e-9 * (1.0 + expected), "{found:?} {expected}");
                prop_assert_eq!(found.backs, sign < 0.0);
            }
        }
    }
}

const EVIDENCE: &str = include_str!("../../../fixtures/avoid/evidence.toml");

/// Neither speed is known: the other one moves on with that of the same draw.
#[test]
fn the_speed_of_the_other_is_that_of_the_evidence() {
    let found = asked(EVIDENCE).unwrap();
    // A vehicle along x, and one along y whose CG is 0.35 m before its middle: 0.91 + 2.25 + 0.35 m.
    let way = 3.51;
    let speed = way / found.scene.clears.unwrap().after;
    let case = CaseFile::parse("avoid.toml", EVIDENCE).unwrap().case;
    let plan = analysis::EstimatePlan {
        particles: analysis::EstimatePlan::PARTICLES,
        seed: 1,
        prior: None,
        pieces: analysis::PieceDetail::Weighed,
    };
    let evidence = estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
    let other = analysis::quantities::SPEED.of_vehicle(pim_core::VehicleId::Two);
    let interval = &evidence.outputs.iter().find(|one| one.output == other).unwrap().posterior;
    assert!((speed / interval.median.value - 1.0).abs() < 1e-9, "{speed} {:?}", interval.median);
    // The greatest speed that is late enough has an interval whose width follows from those of both speeds.
    let temporal = found.chance.unwrap().temporal.unwrap();
    assert!(temporal.low < 0.85 * temporal.median && temporal.high > 1.15 * temporal.median, "{temporal:?}");
}

#[test]
fn what_does_not_tell_the_way_is_refused() {
    let touching = Touching {
        headings: [0.0, 90.0],
        contacts: [[2.0, 0.0], [0.5, 0.8]],
        bodies: [[4.5, 1.8, 2.1], [4.2, 1.7, 2.0]],
    };
    let text = touching.text("z-up", false);
    let refused = |text: &str| asked(text).unwrap_err().to_string();
    for (from, to, words) in [
        ("heading = \"90 deg\"", "heading = \"181 deg\"", "nearly along one line"),
        ("heading = \"90 deg\"\n", "", "`heading`"),
        ("length = \"4.2 m\"\nwidth = \"1.7 m\"\ncg_to_front = \"2 m\"\n", "", "outline"),
        ("contact = { x = \"0.5 m\", y = \"0.8 m\" }\n", "", "`contact`"),
        ("speed = \"10 m/s\"\n", "", "`speed`"),
        ("speed = \"10 m/s\"", "speed = \"0 m/s\"", "never clears"),
        (
            "heading = \"90 deg\"",
            "heading = \"90 deg\"\nsideslip = \"10 deg\"",
            "does not travel along its heading",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let found = refused(&text.replace(from, to));
        assert!(found.contains(words), "{found}");
    }
}

/// The speed by crush and the recorders' ΔV leaves open whether the other car stood: more probably it did.
const STOOD: &str = r#"
[vehicle1]
name = "Car 1"
mass = { value = "1722 kg", sd = "30 kg" }
yaw_radius = { value = "1.415 m", sd = "0.04 m" }
heading = { value = "-2.44 deg", sd = "3 deg" }
contact = { x = { value = "1.94 m", sd = "0.1 m" }, y = { value = "-0.23 m", sd = "0.15 m" } }
length = "4.77 m"
width = "1.81 m"
cg_to_front = "2.24 m"
wheelbase = "2.813 m"
track = "1.52 m"
cg_to_front_axle = "1.246 m"
[vehicle1.crush]
side = "front"
width = "76.0 cm"
depths = { values = "24.5 40.3 43.5 13.3 26.7 54.4 cm", sd = "2 cm" }
stiffness = { category = 1 }
[vehicle1.recorder]
delta_v_longitudinal = "-23.08 km/h"
delta_v_lateral = "-14.26 km/h"
[vehicle2]
name = "Car 2"
mass = { value = "1659 kg", sd = "30 kg" }
yaw_radius = { value = "1.360 m", sd = "0.04 m" }
heading = { value = "91.48 deg", sd = "3 deg" }
contact = { x = { value = "-0.46 m", sd = "0.1 m" }, y = { value = "0.75 m", sd = "0.15 m" } }
length = "4.71 m"
width = "1.80 m"
cg_to_front = "2.21 m"
wheelbase = "2.778 m"
track = "1.51 m"
cg_to_front_axle = "1.217 m"
[vehicle2.crush]
side = "left"
width = "182.5 cm"
depths = { values = "5.8 8.4 15.0 18.1 16.5 14.6 cm", sd = "2 cm" }
stiffness = { category = 1 }
[vehicle2.recorder]
delta_v_longitudinal = "12.91 km/h"
delta_v_lateral = "-24.14 km/h"
[impact]
crush_plane = { value = "-2.82 deg", sd = "6 deg" }
restitution = 0.1
tangential = "critical"
[avoid]
vehicle = "vehicle1"
other_party = "vehicle"
limit = { value = "40 km/h", source = "assumed" }
reaction_time = { low = "0.824 s", high = "1.490 s", source = "assumed" }
swell = "0.2 s"
deceleration = { low = "5.5 m/s^2", high = "7.5 m/s^2", source = "assumed" }
demand = { time = { value = "1.535 s", sd = "0.15 s" } }
clear = { distance = "5.9 m" }
"#;

/// The central values are those of a car that moved, which clears the danger zone; the probability has both.
#[test]
fn a_vehicle_that_probably_stood_leaves_a_probability() {
    let found = asked_with(STOOD, AvoidPlan::default()).unwrap();
    assert!(
        found.other_may_have_stood().is_some_and(|stood| stood > 0.5),
        "{:?}",
        found.other_may_have_stood()
    );
    let clears = found.scene.clears.unwrap();
    assert!((0.0..100.0).contains(&clears.after), "{clears:?}");
    let chance = found.chance.unwrap();
    assert!((0.05..0.95).contains(&chance.avoided_at_limit), "{}", chance.avoided_at_limit);
}

/// Two fronts of which either may have stood.
const MAY_HAVE_STOOD: &str = r#"
[vehicle1]
mass = { value = "1500 kg", sd = "25 kg" }
yaw_radius = { value = "1.4 m", sd = "0.04 m" }
heading = { value = "37 deg", sd = "2 deg" }
contact = { x = { value = "1.8 m", sd = "0.08 m" }, y = { value = "-0.5 m", sd = "0.1 m" } }
length = "4.6 m"
width = "1.78 m"
cg_to_front = "2.15 m"
[vehicle1.crush]
side = "front"
width = "0.93842 m"
depths = "54.19 54.19 54.19 54.19 cm"
stiffness = { A = "55500 N/m", B = "386000 N/m^2" }

[vehicle2]
mass = { value = "1250 kg", sd = "25 kg" }
yaw_radius = { value = "1.3 m", sd = "0.04 m" }
heading = { value = "-93 deg", sd = "2 deg" }
contact = { x = { value = "1.7 m", sd = "0.08 m" }, y = { value = "0.5 m", sd = "0.1 m" } }
length = "4.3 m"
width = "1.72 m"
cg_to_front = "2.05 m"
[vehicle2.crush]
side = "front"
width = "0.98392 m"
depths = "45.96 45.96 45.96 45.96 cm"
stiffness = { A = "55500 N/m", B = "386000 N/m^2" }

[impact]
crush_plane = { value = "57 deg", sd = "5 deg" }
restitution = 0.08
tangential = { friction = 0.6 }
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
[avoid]
vehicle = "vehicle1"
other_party = "vehicle"
limit = { value = "70 km/h", source = "sign" }
reaction_time = { low = "0.6 s", high = "1.3 s", source = "x" }
swell = { value = "0.2 s", source = "x" }
deceleration = { low = "6 m/s^2", high = "8 m/s^2", source = "x" }
demand = { time = { value = "1.8 s", sd = "0.25 s" }, reason = "x" }
"#;

/// The central values are those of a vehicle that moved, as the probabilities are: a vehicle that stood has
/// no collision to avoid. Unbraked, the speed at the demand is that at the impact.
#[test]
fn the_central_speed_and_the_probability_are_of_a_vehicle_that_moved() {
    let found = asked_with(MAY_HAVE_STOOD, AvoidPlan::default()).unwrap();
    assert!(
        found.may_have_stood().is_some_and(|stood| (0.1..0.3).contains(&stood)),
        "{:?}",
        found.may_have_stood()
    );
    let chance = found.chance.unwrap();
    assert!(chance.stationary > chance.samples / 10, "{}", chance.stationary);
    let (central, median) = (found.scene.speed, chance.speed.median);
    assert!((central / median - 1.0).abs() < 0.03, "{central} {median}");
}
