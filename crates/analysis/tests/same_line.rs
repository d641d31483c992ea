//! Avoidability where the other vehicle moves along the same line: against a simulation of both in small
//! steps, and by hand.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![allow(clippy::disallowed_methods, reason = "an independent simulation needs no equal bits")]

use analysis::{ActualRun, AvoidPlan, Avoidance, Failure, Hypothesis, Unbraked};
use case::Along;
use proptest::prelude::*;

use crate::avoid::asked_with;

const KMH: f64 = 1.0 / 3.6;

fn asked(text: &str) -> Result<Avoidance, Failure> {
    asked_with(text, AvoidPlan { samples: 1_000, ..AvoidPlan::default() })
}

/// One vehicle behind another, both along `heading`: speeds at the impact, what else is known of each, and
/// [avoid].
fn text(headings: [f64; 2], speeds: [f64; 2], more: [&str; 2], avoid: &str) -> String {
    let vehicle = |k: usize| {
        format!(
            "[vehicle{}]\nmass = \"1400 kg\"\nheading = \"{} deg\"\nspeed = \"{} m/s\"\n{}\n",
            k + 1,
            headings[k],
            speeds[k],
            more[k]
        )
    };
    format!("{}{}[avoid]\n{avoid}", vehicle(0), vehicle(1))
}

/// 60 km/h, 35 m and 2.1 s before the impact, behind a car with 20 km/h; 1 s and 7 m/s².
#[test]
fn a_lead_vehicle_moves_on() {
    let avoid = "limit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    let found = asked(&text([30.0; 2], [60.0 * KMH, 20.0 * KMH], [""; 2], avoid)).unwrap();
    let line = found.scene.same_line.as_ref().unwrap();
    assert_eq!((line.along, line.deceleration), (Along::Ahead, 0.0));
    // 35 m take 2.1 s, in which the car ahead covers 11.67 m.
    let gap = 35.0 - 20.0 * KMH * 2.1;
    assert!((line.gap - gap).abs() < 1e-9);
    // Its 40 km/h more take 11.11 m and 11.11²/14 m.
    let faster = 40.0 * KMH;
    let taken = faster + faster * faster / 14.0;
    let run = found.run(Hypothesis::ReactionAndBraking).unwrap();
    assert!(run.is_avoided() && run.stops_before() && found.scene.stops_at_limit());
    assert!((run.gap.unwrap() - (gap - taken)).abs() < 1e-6, "{:?}", run.gap);
    assert!((found.enough.reaction.unwrap() - (gap - faster * faster / 14.0) / faster).abs() < 1e-6);
    let least = faster * faster / (2.0 * (gap - faster));
    assert!((found.enough.deceleration.unwrap() - least).abs() < 1e-6);
    // (v − u) + (v − u)²/2a = gap
    let root = 7.0 * ((1.0 + 2.0 * gap / 7.0_f64).sqrt() - 1.0);
    assert!((found.scene.spatial() - (20.0 * KMH + root)).abs() < 1e-6);
    assert!(found.nearly_along.is_none());
    // A driver who keeps a limit below the speed of the car ahead never reaches it.
    let slow =
        asked(&text([30.0; 2], [60.0 * KMH, 20.0 * KMH], [""; 2], &avoid.replace("60 km/h", "19 km/h")));
    let slow = slow.unwrap();
    assert_eq!(slow.enough.deceleration_at_limit, Some(0.0));
    assert!(slow.scene.stops_at_limit() && slow.scene.is_avoided_else_as_it_was());
}

/// A vehicle that came from ahead, or had the speed to get away, was not hit from behind by this one.
#[test]
fn vehicles_that_part_are_refused() {
    let avoid = "limit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    for speeds in [[10.0, 12.0], [10.0, 10.0]] {
        let failure = asked(&text([0.0; 2], speeds, [""; 2], avoid)).unwrap_err().to_string();
        assert!(failure.contains("vehicle 1 does not catch up with vehicle 2"), "{failure}");
    }
    // It was behind at the demand, and braked harder.
    let braked = "before = { skid = { length = \"14 m\", friction = 0.7 } }";
    let failure = asked(&text([0.0; 2], [10.0, 6.0], ["", braked], avoid)).unwrap_err().to_string();
    assert!(failure.contains("vehicle 1 does not catch up with vehicle 2"), "{failure}");
}

/// An oncoming vehicle that goes on reaches one that stands, too: 25 m apart at a closing speed of 25 m/s.
#[test]
fn an_oncoming_vehicle_comes_nearer() {
    let avoid = "limit = \"54 km/h\"\nreaction_time = \"0.5 s\"\ndeceleration = \"7.5 m/s^2\"\n\
                 demand = { distance = \"30 m\" }\nunbraked = true\n";
    let found = asked(&text([0.0, 180.0], [15.0, 10.0], [""; 2], avoid)).unwrap();
    let line = found.scene.same_line.as_ref().unwrap();
    assert_eq!(line.along, Along::Oncoming);
    assert!((line.gap - 50.0).abs() < 1e-9);
    // It stops after 7.5 + 15 = 22.5 m and 2.5 s; the other is there after (50 − 22.5)/10 = 2.75 s.
    let run = found.run(Hypothesis::ReactionAndBraking).unwrap();
    assert!(!run.is_avoided() && run.collision_speed == 0.0, "{run:?}");
    assert!((run.arrival.unwrap() - 2.75).abs() < 1e-9);
    assert_eq!((found.scene.spatial(), found.enough.deceleration), (0.0, None));
    // If the other braked with 0.5 g up to the impact, and on, it stands 10²/2a = 10.2 m beyond the place.
    let braked = "before = { skid = { length = \"12 m\", friction = 0.5 } }";
    let found = asked(&text([0.0, 180.0], [15.0, 10.0], ["", braked], avoid)).unwrap();
    let a = 0.5 * 9.80665;
    let line = found.scene.same_line.as_ref().unwrap();
    assert!((line.deceleration - a).abs() < 1e-12);
    let before = (100.0 + 2.0 * a * 12.0_f64).sqrt();
    let skidded = (before - 10.0) / a;
    assert!((line.gap - (30.0 + 12.0 + before * (2.0 - skidded))).abs() < 1e-9);
    let stands = 30.0 - 100.0 / (2.0 * a);
    // v t_R + v²/2a = the distance to there
    let most = 7.5 * ((0.25 + 2.0 * stands / 7.5_f64).sqrt() - 0.5);
    assert!((found.scene.spatial() - most).abs() < 1e-6, "{} {most}", found.scene.spatial());
}

/// The brakes of the other build up, too: before 12 m of skid to 10 m/s, with 0.5 g that grew in 0.4 s.
#[test]
fn the_skid_of_the_other_begins_with_the_swell() {
    let a = 0.5 * 9.80665;
    let full = (100.0 + 2.0 * a * 12.0_f64).sqrt();
    for (form, lag, lost) in
        [("linear", a * 0.16 / 6.0, a * 0.2), ("half", a * 0.16 / 4.0, a * 0.2), ("full speed", 0.0, 0.0)]
    {
        let avoid = format!(
            "limit = \"54 km/h\"\nreaction_time = \"0.5 s\"\ndeceleration = \"7.5 m/s^2\"\nswell = \"0.4 s\"\n\
             swell_form = \"{form}\"\ndemand = {{ distance = \"45 m\" }}\nunbraked = true\n"
        );
        let braked = "before = { skid = { length = \"12 m\", friction = 0.5 } }";
        let found = asked(&text([0.0; 2], [15.0, 10.0], ["", braked], &avoid)).unwrap();
        let line = found.scene.same_line.as_ref().unwrap();
        // 45 m take 3 s, of which it drove on steadily in the first.
        let before = full + lost;
        let steady = 3.0 - 0.4 - (full - 10.0) / a;
        let moved = before * (steady + 0.4) - lag + 12.0;
        assert!((line.gap - (45.0 - moved)).abs() < 1e-9, "{form}: {} {}", line.gap, 45.0 - moved);
        assert!((line.at(0.0).speed - before).abs() < 1e-9 && line.deceleration == a, "{form}: {line:?}");
        assert!((line.at(3.0).speed - 10.0).abs() < 1e-9 && (line.at(3.0).position - 45.0).abs() < 1e-9);
    }
}

/// The speed of the other is that of its phases, which begin with a known one, or the one that its recorder
/// stored.
#[test]
fn phases_and_stored_speeds_tell_that_of_the_other() {
    let avoid = "limit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    let of = |more: &str| {
        let text = text([0.0; 2], [60.0 * KMH, 2.0], [""; 2], &format!("{avoid}{more}"));
        asked(&text.replace("speed = \"2 m/s\"\n", "")).unwrap()
    };
    let phase =
        "[[vehicle2.before.phase]]\nspeed = \"10 m/s\"\ntime = \"1.5 s\"\nacceleration = \"-4 m/s^2\"\n";
    let line = of(phase).scene.same_line.unwrap();
    assert!((line.speed - 4.0).abs() < 1e-12 && line.deceleration == 4.0, "{line:?}");
    // 7 m/s over 1.5 s, and before that 10 m/s.
    assert!((line.gap - (35.0 - 10.5 - 10.0 * (2.1 - 1.5))).abs() < 1e-9, "{}", line.gap);
    let found = of("[vehicle2.recorder]\nspeed = \"20 km/h\"\n");
    assert!((found.scene.same_line.as_ref().unwrap().speed - 20.0 * KMH).abs() < 1e-9);
    // Four per cent of it, the default error of a recorder: a faster lead gives more room by (2.1 − the rest
    // of the slope) m for each m/s.
    let by_u = |u: f64| {
        let gap: f64 = 35.0 - 2.1 * u;
        u + 7.0 * ((1.0 + 2.0 * gap / 7.0).sqrt() - 1.0)
    };
    let [low, high] = [-1.96, 1.96].map(|z| by_u(20.0 * KMH * (1.0 + 0.04 * z)));
    let spatial = found.chance.unwrap().spatial;
    let width = (high - low).abs();
    assert!((spatial.high - spatial.low - width).abs() < 0.15 * width, "{spatial:?} {low} {high}");
}

/// A vehicle with only a known speed at the demand: if, with a timely reaction, it would have been slower
/// than the one ahead at the place of the impact, it did not brake.
#[test]
fn who_would_not_have_come_up_to_it_reacted_late() {
    let avoid = |speed: &str| {
        format!(
            "speed = \"{speed}\"\nlimit = \"45 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ distance = \"30 m\" }}\n"
        )
    };
    for speed in [50.0, 55.0, 60.0] {
        let text = text([0.0; 2], [1.0, 26.0 * KMH], [""; 2], &avoid(&format!("{speed} km/h")));
        let found = asked(&text.replace("speed = \"1 m/s\"\n", "")).unwrap();
        // v_k² = v² − 2 a (s − v t_R)
        let v: f64 = speed * KMH;
        let left = (v * v - 14.0 * (30.0 - v)).max(0.0).sqrt();
        let is_unbraked = found.scene.actual == ActualRun::Unbraked(Unbraked::WouldHaveStopped);
        assert_eq!(is_unbraked, left <= 26.0 * KMH, "{speed}");
        let time = if is_unbraked { 30.0 / v } else { 1.0 + (v - left) / 7.0 };
        assert!((found.scene.time - time).abs() < 1e-9, "{speed} {}", found.scene.time);
    }
}

/// One that backs towards the vehicle comes nearer, as an oncoming one does.
#[test]
fn a_vehicle_that_backs_comes_nearer() {
    let avoid = "limit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"30 m\" }\nunbraked = true\n";
    let of = |heading: f64, speed: f64| asked(&text([0.0, heading], [15.0, speed], [""; 2], avoid)).unwrap();
    let [backs, comes] = [of(0.0, -3.0), of(180.0, 3.0)];
    assert_eq!(backs.scene, comes.scene);
    assert_eq!(backs.scene.same_line.as_ref().unwrap().along, Along::Oncoming);
    let [flees, leads] = [of(180.0, -3.0), of(0.0, 3.0)];
    assert_eq!(flees.scene, leads.scene);
    // Its phases are those of the way that it takes.
    let phase = "[[vehicle2.before.phase]]\ntime = \"1 s\"\nacceleration = \"-2 m/s^2\"\n";
    let of = |heading: f64, speed: f64| {
        asked(&text([0.0, heading], [15.0, speed], [""; 2], &format!("{avoid}{phase}"))).unwrap()
    };
    let [backs, comes] = [of(0.0, -3.0), of(180.0, 3.0)];
    assert_eq!(backs.scene, comes.scene);
    assert!((backs.scene.same_line.as_ref().unwrap().at(0.0).speed + 5.0).abs() < 1e-9);
}

/// From 5° on, a motion along one line is an approximation that the answer tells.
#[test]
fn directions_near_the_limit_of_one_line_are_told() {
    let avoid = "limit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"30 m\" }\nunbraked = true\n";
    let of = |heading: f64| asked(&text([0.0, heading], [15.0, 3.0], [""; 2], avoid)).unwrap();
    for (heading, told) in [(4.9, None), (5.1, Some(5.1)), (-9.5, Some(9.5)), (171.0, Some(9.0))] {
        let found = of(heading);
        assert!(found.scene.same_line.is_some());
        let angle = found.nearly_along.map(|off| (10.0 * off.angle.to_degrees()).round() / 10.0);
        assert_eq!(angle, told, "{heading}");
    }
}

/// Phases that begin after the demand say nothing of the time before.
#[test]
fn a_motion_that_is_known_only_later_is_told() {
    let avoid = "limit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { time = \"3 s\" }\n[[vehicle1.before.phase]]\ntime = \"2 s\"\nacceleration = \"-1 m/s^2\"\n";
    let begins = |demand: &str| {
        let avoid = avoid.replace("3 s", demand);
        let found = asked(&text([0.0, 90.0], [15.0, 3.0], [""; 2], &avoid)).unwrap();
        found.scene.begins().unwrap()
    };
    assert!((begins("3 s") - 1.0).abs() < 1e-12 && begins("2 s") <= 1e-12 && begins("1 s") < 0.0);
}

/// A car waiting at a light, which by a solution rolls back at walking pace, counts as standing: it does not
/// come nearer.
#[test]
fn a_solution_that_is_slightly_negative_is_a_stop() {
    let vehicle = |of: &str, mass: f64, contact: &str, side: &str, depth: &str, after: &str| {
        format!(
            "[{of}]\nmass = \"{mass} kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\ncontact = {{ x = \"{contact} m\", y = \"0 m\" }}\n\
             [{of}.crush]\nside = \"{side}\"\nwidth = \"150 cm\"\ndepths = \"{depth} {depth} cm\"\nstiffness = {{ category = 3 }}\n\
             [{of}.after]\nspeed = \"{after} m/s\"\ndirection = \"0 deg\"\nyaw_rate = \"0 deg/s\"\n"
        )
    };
    let case = |after: [&str; 2]| {
        format!(
            "{}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n[reconstruct]\n\
             find = [\"vehicle1.speed\", \"vehicle2.speed\"]\n[avoid]\nlimit = \"30 km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\nunbraked = true\n",
            vehicle("vehicle1", 1500.0, "2", "front", "20", after[0]),
            vehicle("vehicle2", 1300.0, "-2", "rear", "30", after[1]),
        )
    };
    let of =
        |after| asked_with(&case(after), AvoidPlan { samples: 100, exact: true, ..AvoidPlan::default() });
    // 2 m/s less of both after the impact are 2 m/s less of both before it: the crush is the same.
    let [rolls, moves] = [of(["7.7", "10"]), of(["9.7", "12"])].map(|found| found.unwrap().scene);
    let speed = moves.same_line.unwrap().speed;
    assert!((1.0..2.0).contains(&speed), "{speed}");
    assert!((rolls.at_impact - (moves.at_impact - 2.0)).abs() < 1e-9, "{}", rolls.at_impact);
    assert!(rolls.same_line.is_none() && rolls.stops_at_limit(), "{rolls:?}");
}

/// The probability is the share of the speeds of the car ahead that leave enough room.
#[test]
fn the_speed_of_the_other_makes_a_probability() {
    let avoid = "limit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    let range = "\"0 m/s\"\nspeed = { low = \"1 m/s\", high = \"9 m/s\" }";
    let text = text([0.0; 2], [60.0 * KMH, 0.0], [""; 2], avoid).replace("\"0 m/s\"", range);
    let text = text.replace("speed = \"0 m/s\"\nspeed", "speed");
    let found = asked_with(&text, AvoidPlan { samples: 20_000, ..AvoidPlan::default() }).unwrap();
    // 35 − 2.1 u = (v − u) + (v − u)²/14, by halving.
    let lacks = |u: f64| {
        let faster = 60.0 * KMH - u;
        faster + faster * faster / 14.0 - (35.0 - 2.1 * u)
    };
    let [mut low, mut high] = [1.0, 9.0];
    assert!(lacks(low) > 0.0 && lacks(high) < 0.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if lacks(middle) > 0.0 { low = middle } else { high = middle }
    }
    let chance = found.chance.unwrap();
    let expected = (9.0 - low) / 8.0;
    assert!((chance.avoided_at_limit - expected).abs() < 0.015, "{} {expected}", chance.avoided_at_limit);
    assert_eq!(chance.avoided_at_limit, chance.stopped_at_limit);
}

/// The errors of the recorder of the car ahead count: its speeds before the impact determine where it was.
#[test]
fn the_recorder_of_the_other_errs() {
    let avoid = "limit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    let found = |errors: &str| {
        let recorder = format!(
            "[vehicle2.recorder]\npre_crash = {{ time = \"-5 -4 -3 -2 -1 s\", speed = \"20 20 20 20 20 km/h\" }}\n\
             errors = {{ {errors} }}\n"
        );
        let text = text([0.0; 2], [60.0 * KMH, 20.0 * KMH], ["", &recorder], avoid);
        asked_with(&text, AvoidPlan { samples: 4_000, ..AvoidPlan::default() }).unwrap()
    };
    let exact = "step = \"0.001 km/h\", steady_low = \"0 %\", tyre_sd = \"0 %\", slip_low = \"0 km/h\", slip_sd = \"0 km/h\"";
    let gaps = |sd: &str| {
        let found = found(&format!("{exact}, steady_sd = \"{sd} %\""));
        let interval = found.chance.unwrap().spatial;
        (found.scene.same_line.unwrap().gap, interval.high - interval.low)
    };
    // Steadily 20 km/h, 2.1 s before the impact.
    let (gap, narrow) = gaps("0.001");
    assert!((gap - (35.0 - 20.0 * KMH * 2.1)).abs() < 0.05, "{gap}");
    let (_, wide) = gaps("5");
    assert!(narrow < 0.001 && wide > 0.02, "{narrow} {wide}");
}

/// If nothing else gives the speed of the car ahead, its recorder does, and its errors lead to a probability.
#[test]
fn the_recorder_of_the_other_tells_its_speed() {
    let avoid = "speed = \"60 km/h\"\nlimit = \"60 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                 demand = { distance = \"35 m\" }\nunbraked = true\n";
    let recorder = "[vehicle2.recorder]\npre_crash = { time = \"-2 -1 0 s\", speed = \"20 20 20 km/h\", brake = \"off off off\" }\n";
    let text = text([0.0; 2], [1.0, 2.0], ["", recorder], avoid);
    let text = text.replace("speed = \"1 m/s\"\n", "").replace("speed = \"2 m/s\"\n", "");
    let found = asked_with(&text, AvoidPlan { samples: 4_000, ..AvoidPlan::default() }).unwrap();
    let line = found.scene.same_line.as_ref().unwrap();
    // Wheels that roll read low by 1.4 % on average.
    assert!((line.speed - 20.0 * KMH * 1.014).abs() < 0.05, "{}", line.speed);
    assert!((line.gap - (35.0 - line.speed * 2.1)).abs() < 0.1, "{}", line.gap);
    let spatial = found.chance.unwrap().spatial;
    assert!(spatial.high - spatial.low > 0.05, "{spatial:?}");
    assert!((spatial.low..spatial.high).contains(&found.scene.spatial()), "{spatial:?}");
    assert!(found.nearly_along.is_none());
}

const STEP: f64 = 2e-4;
/// (s) how exactly the steps determine when they meet.
const SOFT: f64 = 2e-3;
/// (s) the end of the steps.
const LONGEST: f64 = 30.0;

/// How two vehicles come near each other, in small steps: the least gap, and the first contact with the speed
/// of the first (s, m/s), if any.
fn stepped(speed: f64, response: Option<[f64; 3]>, other: impl Fn(f64) -> f64) -> (f64, Option<[f64; 2]>) {
    let (mut v, mut s, mut t) = (speed, 0.0, 0.0_f64);
    let mut least = f64::INFINITY;
    while t < LONGEST {
        let gap = other(t) - s;
        least = least.min(gap);
        if gap <= 0.0 {
            return (least, Some([t, v]));
        }
        let a = response.map_or(0.0, |[reaction, swell, full]| {
            -full * ((t + 0.5 * STEP - reaction) / swell).clamp(0.0, 1.0)
        });
        let next = (v + a * STEP).max(0.0);
        s += 0.5 * (v + next) * STEP;
        (v, t) = (next, t + STEP);
    }
    (least, None)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// A vehicle that comes unbraked, behind one or towards one that begins to brake some time before the
    /// impact, and brakes on.
    #[test]
    fn both_agree_with_steps(
        heading in -180.0..180.0_f64,
        v in 8.0..30.0_f64,
        [share, brakes, braking] in [0.05..0.9_f64, 0.0..6.0, 0.1..2.0],
        time in 1.0..3.5_f64,
        [reaction, swell, full] in [0.3..1.2_f64, 0.05..0.4, 4.0..9.0],
        lower in 0.4..1.0_f64,
        is_oncoming in any::<bool>(),
        clears in 0.01..4.0_f64,
    ) {
        // One that hardly brakes is reached after the end of the steps.
        let brakes = if brakes < 1.0 { 0.0 } else { brakes };
        let at_impact = share * v;
        let phases = [
            format!("time = \"{} s\"\nacceleration = \"0 m/s^2\"", 20.0),
            format!("time = \"{braking} s\"\nacceleration = \"{} m/s^2\"", -brakes),
        ];
        let phases: String = phases.iter().map(|phase| format!("[[vehicle2.before.phase]]\n{phase}\n")).collect();
        let limit = lower * v;
        let avoid = format!(
            "limit = \"{limit} m/s\"\nreaction_time = \"{reaction} s\"\nswell = \"{swell} s\"\n\
             deceleration = \"{full} m/s^2\"\ndemand = {{ time = \"{time} s\" }}\nunbraked = true\n\
             clear = {{ distance = \"{clears} m\", speed = \"1 m/s\" }}\n{phases}"
        );
        let other_heading = if is_oncoming { heading + 180.0 } else { heading };
        let text = text([heading, other_heading], [v, at_impact], [""; 2], &avoid);
        let place = v * time;
        // Where the other is, by its distance from the place of the impact.
        let u0 = at_impact + brakes * braking;
        let sign = if is_oncoming { -1.0 } else { 1.0 };
        let other = move |t: f64| {
            let since = t - (time - braking);
            let own = |since: f64| if since <= 0.0 {
                u0 * since
            } else if brakes > 0.0 && since > u0 / brakes {
                u0 * u0 / (2.0 * brakes)
            } else {
                u0 * since - 0.5 * brakes * since * since
            };
            place + sign * (own(since) - own(braking))
        };
        let found = asked(&text);
        if other(0.0) < -1e-3 {
            prop_assert!(found.is_err(), "{}", text);
            return Ok(());
        }
        prop_assume!(other(0.0) > 0.1);
        let found = found.unwrap();
        let line = found.scene.same_line.as_ref().unwrap();
        prop_assert!((line.gap - other(0.0)).abs() < 1e-8, "{} {}\n{}", line.gap, other(0.0), text);
        let cleared = time + clears;
        let answer = [reaction, swell, full];
        // Where it comes just when the zone is clear, the steps do not decide.
        let met = |speed: f64, response: Option<[f64; 3]>| stepped(speed, response, other).1.map(|[at, _]| at);
        let avoids = |speed, response| met(speed, response).is_none_or(|at| at > cleared - SOFT);
        let fails = |speed, response| met(speed, response).is_some_and(|at| at < cleared + SOFT);
        for (hypothesis, speed, response) in [
            (Hypothesis::LimitOnly, limit, None),
            (Hypothesis::ReactionAndBraking, v, Some(answer)),
            (Hypothesis::All, limit, Some(answer)),
        ] {
            let run = found.run(hypothesis).unwrap();
            let (least, contact) = stepped(speed, response, other);
            match contact {
                // The steps have ended.
                None if run.arrival.is_some_and(|at| at > LONGEST) => {}
                // They only just touch, or not.
                _ if least.abs() < 0.02 && contact.is_none_or(|[_, speed]| speed < 1.0) => {}
                Some([at, speed]) => {
                    let [found_at, found_speed] = [run.arrival.unwrap(), run.collision_speed];
                    // Where they touch at nearly the same speed, the moment is not sharp.
                    let closing = speed - (other(at + STEP) - other(at)) / STEP;
                    prop_assume!(closing > 0.5);
                    prop_assert!((found_at - at).abs() < 5e-3, "{:?} {} {}\n{}", hypothesis, found_at, at, text);
                    prop_assert!((found_speed - speed).abs() < 0.05, "{:?} {} {}\n{}", hypothesis, found_speed, speed, text);
                    prop_assert!(run.gap.is_none());
                }
                None => {
                    prop_assert!(run.stops_before() && run.is_avoided(), "{:?} {:?}\n{}", hypothesis, run, text);
                    prop_assert!((run.gap.unwrap() - least).abs() < 1e-2, "{:?} {:?} {}\n{}", hypothesis, run.gap, least, text);
                }
            }
        }
        // A little less than what is just enough avoids it, a little more does not.
        let just = found.enough.speed;
        if just > 0.2 && just < 60.0 {
            prop_assert!(avoids(just - 0.1, Some(answer)), "{}\n{}", just, text);
            prop_assert!(fails(just + 0.1, Some(answer)), "{}\n{}", just, text);
        }
        for (at_limit, speed) in [(false, v), (true, limit)] {
            let [deceleration, longest] = if at_limit {
                [found.enough.deceleration_at_limit, found.enough.reaction_at_limit]
            } else {
                [found.enough.deceleration, found.enough.reaction]
            };
            match deceleration {
                Some(0.0) => prop_assert!(avoids(speed, None), "{}", text),
                Some(least) if least < 50.0 => {
                    prop_assert!(avoids(speed, Some([reaction, swell, least * 1.02 + 0.01])), "{}\n{}", least, text);
                    prop_assert!(fails(speed, Some([reaction, swell, least * 0.98 - 0.01])), "{}\n{}", least, text);
                }
                Some(_) => {}
                None => prop_assert!(fails(speed, Some([reaction, swell, 100.0])), "{}", text),
            }
            match longest {
                Some(longest) if longest < 20.0 => {
                    prop_assert!(longest < 0.02 || avoids(speed, Some([longest - 0.02, swell, full])), "{}\n{}", longest, text);
                    prop_assert!(fails(speed, Some([longest + 0.02, swell, full])), "{}\n{}", longest, text);
                }
                Some(_) => prop_assert!(avoids(speed, None), "{}", text),
                None => prop_assert!(fails(speed, Some([0.0, swell, full])) || deceleration.is_none(), "{}", text),
            }
        }
    }
}
