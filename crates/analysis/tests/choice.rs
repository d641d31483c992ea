//! Which of several motions is taken, compared with impacts and motions whose truth is chosen.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use analysis::{CheckedQuantity, Warning, impact, motion, reconstruct};
use case::{Case, CaseFile};

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

/// Two cars that cross; vehicle 2 is struck so far (m) ahead of its centre.
fn crossing(speeds: [&str; 2], ahead: f64, rests: &[String; 2], end: &str) -> String {
    format!(
        r#"
[scene]
contact = {{ x = "3 m", y = "-1 m" }}
[surface]
friction = 0.7
[vehicle1]
mass = "1500 kg"
class = 3
heading = "0 deg"
{}
contact = {{ x = "2.0 m", y = "0.1 m" }}
[vehicle1.after]
drag = 0.15
{}
[vehicle2]
mass = "1300 kg"
class = 2
heading = "90 deg"
{}
contact = {{ x = "{ahead} m", y = "0.75 m" }}
[vehicle2.after]
drag = 0.15
{}
[impact]
crush_plane = "180 deg"
restitution = 0.1
tangential = {{ friction = 0.6 }}
{end}
"#,
        speeds[0], rests[0], speeds[1], rests[1]
    )
}

/// Only the heading at rest is given. Among the turns that lead there, the one that the impact caused is
/// found, as it agrees with the impulse.
#[test]
fn the_turn_that_the_impact_made_is_found() {
    let given = ["speed = \"15 m/s\"", "speed = \"12 m/s\""];
    let mut turned_far = 0;
    for ahead in [-1.2, -0.6, 0.6, 0.9, 1.3] {
        let forward = impact(&read(&crossing(given, ahead, &Default::default(), ""))).unwrap();
        let rests = forward.travel.each_ref().map(|travel| {
            let travel = travel.as_ref().unwrap();
            turned_far += usize::from((travel.rest.heading - travel.start.heading).abs() > 3.2);
            let [x, y, heading] = [travel.rest.position.x, travel.rest.position.y, travel.rest.heading];
            format!("rest = {{ x = \"{x} m\", y = \"{y} m\", heading = \"{heading} rad\" }}")
        });
        let end = "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]";
        let back = reconstruct(&read(&crossing(["", ""], ahead, &rests, end))).unwrap();
        let both = back.both.as_ref().unwrap();
        for (found, truth) in both.speeds.into_iter().zip([15.0, 12.0]) {
            assert!((found - truth).abs() < 0.1, "{ahead}: {found} is not {truth}");
        }
        let weights: f64 = both.combinations.iter().map(|combination| combination.weight).sum();
        assert!((weights - 1.0).abs() < 1e-12, "{weights}");
        assert!(both.combinations.is_sorted_by(|a, b| a.misfit <= b.misfit));
        assert!(!back.warnings.iter().any(|warning| matches!(warning, Warning::MomentumDiffers { .. })));
    }
    assert!(turned_far > 0, "the least turn is the true one everywhere");
}

/// A vehicle that rolls off with a sideslip has a curved path: its speed is found again, or a check says by
/// how much its path misses the rest.
#[test]
fn a_bent_way_is_brought_back_or_its_miss_is_told() {
    let with = |after: &str| {
        format!(
            "[surface]\nfriction = 0.7\n[vehicle1]\nmass = \"1500 kg\"\nclass = 3\nheading = \"0 deg\"\n\
             position = {{ x = \"0 m\", y = \"0 m\" }}\n[vehicle1.after]\ndrag = 0.1\n{after}\n"
        )
    };
    for direction in [2_f64, 6.0, 11.0, 15.0, 20.0, 30.0] {
        for yaw_rate in [-20_f64, 0.0, 20.0] {
            let given = format!(
                "speed = \"6 m/s\"\ndirection = \"{direction} deg\"\nyaw_rate = \"{yaw_rate} deg/s\""
            );
            let forward = motion(&read(&with(&given))).unwrap();
            let rest = forward.travel[0].as_ref().unwrap().rest;
            let [x, y, turned] = [rest.position.x, rest.position.y, rest.heading];
            let at = format!("rest = {{ x = \"{x} m\", y = \"{y} m\", turned = \"{turned} rad\" }}");
            let back = motion(&read(&with(&at))).unwrap();
            let found = back.travel[0].as_ref().unwrap().start.motion.velocity.norm();
            let is_told = back
                .checks
                .iter()
                .any(|check| matches!(check.quantity, CheckedQuantity::RestMissed { .. }) && !check.passed());
            assert!((found - 6.0).abs() < 0.4 || is_told, "{direction} {yaw_rate}: {found}");
        }
    }
}

/// A rest to which several likely motions lead, without data that choose among them: neither with a known
/// speed nor of point masses. The warning is that of the motion alone.
#[test]
fn several_motions_are_told_where_nothing_chooses_among_them() {
    let after =
        include_str!("../../../fixtures/motion/ricsac-6.toml").split("[vehicle2.after]").next().unwrap();
    let rest =
        "[vehicle2.after]\ndrag = 0.3\nrest = { x = \"-1.5 m\", y = \"6.2 m\", heading = \"-120 deg\" }\n";
    let alone = format!("{after}{rest}");
    let several = |warnings: Vec<Warning>| {
        warnings
            .into_iter()
            .filter(|warning| matches!(warning, Warning::SeveralStarts { .. }))
            .collect::<Vec<_>>()
    };
    let expected = several(motion(&read(&alone)).unwrap().warnings);
    assert_eq!(expected.len(), 1);
    let beside = alone.replace("[vehicle2]", "[vehicle2]\nspeed = \"9 m/s\"")
        + "[reconstruct]\nfind = \"vehicle1.speed\"\n";
    let points = alone + "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n";
    for text in [beside, points] {
        let analysis = reconstruct(&read(&text)).unwrap();
        assert!(analysis.both.as_ref().unwrap().combinations.is_empty());
        assert_eq!(several(analysis.warnings), expected);
    }
}
