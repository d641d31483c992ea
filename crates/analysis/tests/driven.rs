//! Avoidability where the approach is given by phases or a recorder: compared with a simulation in small
//! steps.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![allow(clippy::disallowed_methods, reason = "an independent simulation needs no equal bits")]

use analysis::{ActualRun, AvoidPlan, Avoidance, DrivenBy, Failure, Hypothesis, SpeedSource};
use proptest::prelude::*;

use crate::avoid::asked_with;

fn asked(text: &str) -> Result<Avoidance, Failure> {
    asked_with(text, AvoidPlan { samples: 1_000, ..AvoidPlan::default() })
}

/// A vehicle in small steps. Until the reaction ends, it accelerates as it did, and does not brake.
struct Stepped {
    /// (m/s²) each until a time (s) after the demand.
    accelerations: Vec<[f64; 2]>,
    /// (s, s, m/s²) reaction, swell, full deceleration; `None` as it was driven.
    response: Option<[f64; 3]>,
    /// (m/s)
    greatest: f64,
}

const STEP: f64 = 1e-4;
/// (m/s²) a stop from beyond this takes too few steps.
const SHARP: f64 = 100.0;

impl Stepped {
    fn acceleration(&self, time: f64) -> f64 {
        let driven = self.accelerations.iter().find(|[_, end]| time < *end).unwrap()[0];
        match self.response {
            None => driven,
            Some([reaction, ..]) if time < reaction => driven.max(0.0),
            Some([reaction, swell, full]) => -full * ((time - reaction) / swell).min(1.0),
        }
    }

    /// (m/s, s) at a distance (m); `None` if it stops before.
    fn at(&self, speed: f64, distance: f64) -> Option<[f64; 2]> {
        let (mut v, mut s, mut t) = (speed, 0.0, 0.0);
        while s < distance {
            let next = (v + self.acceleration(t + 0.5 * STEP) * STEP).min(self.greatest.max(v)).max(0.0);
            s += 0.5 * (v + next) * STEP;
            (v, t) = (next, t + STEP);
            if v <= 0.0 && self.acceleration(t) <= 0.0 {
                return None;
            }
        }
        Some([v, t])
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// From the demand on: at one speed, accelerating, braking, up to the impact.
    #[test]
    fn a_driven_approach_agrees_with_steps(
        v0 in 6.0..20.0_f64,
        steady in 0.2..1.5_f64,
        [gains, gaining] in [0.5..2.0_f64, 0.3..1.5],
        [brakes, braking] in [2.0..7.0_f64, 0.1..0.6],
        reaction in 0.5..1.5_f64,
        full in 5.0..8.0_f64,
        slower in 0.5..0.95_f64,
        clears in 0.1..2.0_f64,
    ) {
        let speed = v0 + gains * gaining;
        let at_impact = speed - brakes * braking;
        prop_assume!(at_impact > 1.0);
        let (time, limit) = (steady + gaining + braking, v0 * slower);
        let distance = v0 * steady + 0.5 * (v0 + speed) * gaining + 0.5 * (speed + at_impact) * braking;
        // The same in several words: any two numbers of a phase, and the speed at the impact or none.
        let forms = [
            ("[vehicle1]\nspeed = \"AT m/s\"", [
                "time = \"STEADY s\"\nacceleration = \"0 m/s^2\"",
                "time = \"GAINING s\"\nacceleration = \"GAINS m/s^2\"",
                "time = \"BRAKING s\"\nspeed = \"SPEED m/s\"",
            ]),
            ("", [
                "speed = \"V0 m/s\"\ntime = \"STEADY s\"\nacceleration = \"0 m/s^2\"",
                "acceleration = \"GAINS m/s^2\"\ntime = \"GAINING s\"",
                "acceleration = \"-BRAKES m/s^2\"\ntime = \"BRAKING s\"",
            ]),
        ];
        let accelerations =
            vec![[0.0, steady], [gains, steady + gaining], [-brakes, f64::INFINITY]];
        let run = |response, greatest| Stepped { accelerations: accelerations.clone(), response, greatest };
        for (vehicle, phases) in forms {
            let phases: String =
                phases.iter().map(|phase| format!("[[vehicle1.before.phase]]\n{phase}\n")).collect();
            let mut text = format!(
                "[avoid]\nlimit = \"{limit} m/s\"\nreaction_time = \"{reaction} s\"\nswell = \"0.2 s\"\n\
                 deceleration = \"{full} m/s^2\"\ndemand = {{ time = \"{time} s\" }}\n\
                 clear = {{ distance = \"{clears} m\", speed = \"1 m/s\" }}\n{vehicle}\n{phases}"
            );
            for (word, value) in [
                ("STEADY", steady), ("GAINING", gaining), ("GAINS", gains), ("BRAKING", braking), ("BRAKES", brakes),
                ("SPEED", speed), ("V0", v0), ("AT", at_impact),
            ] {
                text = text.replace(word, &value.to_string());
            }
            let found = asked(&text).unwrap();
            let scene = &found.scene;
            prop_assert_eq!(scene.actual, ActualRun::Driven(DrivenBy::Phases));
            for (found, expected) in [
                (scene.speed, v0), (scene.at_impact, at_impact), (scene.distance, distance), (scene.time, time),
                (found.scene.delay().unwrap(), steady + gaining - reaction),
            ] {
                prop_assert!((found - expected).abs() < 1e-9, "{} {}\n{}", found, expected, text);
            }
            let answer = [reaction, 0.2, full];
            for (hypothesis, stepped, from) in [
                (Hypothesis::LimitOnly, run(None, limit), limit),
                (Hypothesis::ReactionAndBraking, run(Some(answer), f64::INFINITY), v0),
                (Hypothesis::All, run(Some(answer), limit), limit),
            ] {
                let of_run = found.run(hypothesis).unwrap();
                match stepped.at(from, distance) {
                    Some([speed, arrival]) if speed > 0.5 => {
                        prop_assert!((of_run.collision_speed - speed).abs() < 2e-2, "{:?} {} {}", hypothesis, of_run.collision_speed, speed);
                        prop_assert!((of_run.arrival.unwrap() - arrival).abs() < 2e-3, "{:?} {:?} {}", hypothesis, of_run.arrival, arrival);
                    }
                    // A few centimetres at the place decide.
                    Some(_) => {}
                    None => prop_assert!(of_run.collision_speed < 0.8, "{:?} {}", hypothesis, of_run.collision_speed),
                }
            }
            // The speeds that just avoid it, which it keeps once it has them: a little faster fails. If it is
            // not that fast before it brakes, it comes faster from the demand on.
            let gained = gains * (reaction - steady).clamp(0.0, gaining);
            let keeping = |greatest: f64| {
                let from = if greatest > v0 + gained { greatest - gained } else { greatest.min(v0) };
                run(Some(answer), greatest).at(from, distance)
            };
            let spatial = scene.spatial();
            prop_assert!(keeping(spatial * 0.999 - 1e-3).is_none(), "{}", spatial);
            prop_assert!(keeping(spatial * 1.001 + 1e-3).is_some(), "{}", spatial);
            let temporal = scene.temporal().unwrap();
            if temporal > spatial + 0.01 {
                let [_, arrival] = keeping(temporal).unwrap();
                prop_assert!((arrival - (time + clears)).abs() < 2e-3, "{} {}", arrival, time + clears);
            }
            // The deceleration or reaction that just avoids it, in space or in time: a slightly better one
            // does, and a slightly worse one does not.
            let cleared = time + clears;
            let avoids = |at: Option<[f64; 2]>| at.is_none_or(|[_, arrival]| arrival > cleared - 2e-3);
            let fails = |at: Option<[f64; 2]>| at.is_some_and(|[_, arrival]| arrival < cleared + 2e-3);
            for (least, v0, greatest) in [
                (found.enough.deceleration_at_limit, limit, limit),
                (found.enough.deceleration, v0, f64::INFINITY),
            ] {
                let with = |full: f64| run(Some([reaction, 0.2, full]), greatest).at(v0, distance);
                match least {
                    Some(0.0) => prop_assert!(avoids(with(1e-6))),
                    Some(least) if least < SHARP => {
                        prop_assert!(avoids(with(least * 1.02)) && fails(with(least * 0.98)), "{}", least);
                    }
                    Some(_) => {}
                    None => prop_assert!(fails(with(0.9 * SHARP))),
                }
            }
            let with = |reaction: f64| run(Some([reaction, 0.2, full]), f64::INFINITY).at(v0, distance);
            match found.enough.reaction {
                Some(longest) => {
                    prop_assert!(longest < 0.01 || avoids(with(longest - 2e-3)), "{}", longest);
                    prop_assert!(longest >= cleared || fails(with(longest + 2e-3)), "{}", longest);
                }
                None => prop_assert!(fails(with(0.0))),
            }
        }
    }
}

/// A skid is a phase, too: the same speed at the demand, distance and time.
#[test]
fn a_skid_as_a_phase_is_the_same_skid() {
    let text = |before: &str| {
        format!(
            "[vehicle1]\nspeed = \"10 m/s\"\n{before}\n[avoid]\nlimit = \"40 km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"40 m\" }}\n"
        )
    };
    let skid = asked(&text("[vehicle1.before]\nskid = { length = \"12 m\", friction = 0.6 }")).unwrap();
    let phase = "[[vehicle1.before.phase]]\ndistance = \"12 m\"\nacceleration = \"-5.88399 m/s^2\"";
    let phase = asked(&text(phase)).unwrap();
    for (one, other) in [
        (skid.scene.speed, phase.scene.speed),
        (skid.scene.time, phase.scene.time),
        (skid.scene.spatial(), phase.scene.spatial()),
        (skid.scene.delay().unwrap(), phase.scene.delay().unwrap()),
        (
            skid.run(Hypothesis::LimitOnly).unwrap().collision_speed,
            phase.run(Hypothesis::LimitOnly).unwrap().collision_speed,
        ),
    ] {
        assert!((one - other).abs() < 1e-9, "{one} {other}");
    }
}

/// A driver who sets out from a stop is asked about the reaction, whatever the limit is; the speed at the
/// impact follows: √(2 · 1.5 · 7.7).
#[test]
fn a_start_from_a_stop_is_followed() {
    let text = |demand: &str| {
        format!(
            "[[vehicle1.before.phase]]\nspeed = \"0 m/s\"\nacceleration = \"1.5 m/s^2\"\ndistance = \"7.7 m\"\n[avoid]\n\
             limit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ {demand} }}\n"
        )
    };
    let found = asked(&text("time = \"2 s\"")).unwrap();
    let lasts = (2.0 * 7.7 / 1.5_f64).sqrt();
    assert_eq!(found.speed_from, SpeedSource::Phases);
    assert!((found.scene.at_impact - 1.5 * lasts).abs() < 1e-12);
    assert!((found.scene.speed - 1.5 * (lasts - 2.0)).abs() < 1e-12);
    // Never faster than the limit: nothing is changed by it.
    let hypotheses: Vec<Hypothesis> = found.runs.iter().map(|run| run.hypothesis).collect();
    assert_eq!(hypotheses, [Hypothesis::Actual, Hypothesis::ReactionAndBraking]);
    assert!(!found.scene.is_above_limit());
    // Before it set out it stood, and a demand farther back has no moment.
    let stood = asked(&text("time = \"5 s\"")).unwrap();
    assert_eq!(stood.scene.speed, 0.0);
    assert!((stood.scene.distance - 7.7).abs() < 1e-12);
    let refused = asked(&text("distance = \"9 m\"")).unwrap_err().to_string();
    assert!(refused.contains("begin with a stop 7.7 m before the impact"), "{refused}");
}

/// One that accelerates up to the impact, which is within its reaction: 2 m/s at the demand, 2 m/s² for
/// 0.8 s. The other party clears the zone 0.01 s later, so that it would have had to keep about the speed
/// with which it takes 0.81 s: 2 t + t² up to that speed c, then c (0.81 − t), is 2.24 m with c = 2 + 2 t.
#[test]
fn a_zone_that_is_clear_before_the_reaction_ends_is_asked_of_the_motion() {
    let text = "[[vehicle1.before.phase]]\nspeed = \"2 m/s\"\nacceleration = \"2 m/s^2\"\ntime = \"0.8 s\"\n[avoid]\n\
                limit = \"3 m/s\"\nreaction_time = \"2 s\"\ndeceleration = \"7 m/s^2\"\ndemand = { time = \"0.8 s\" }\n\
                clear = { distance = \"0.01 m\", speed = \"1 m/s\" }\n";
    let found = asked(text).unwrap();
    assert!((found.scene.distance - 2.24).abs() < 1e-12);
    // 2 t + t² + (2 + 2 t)(0.81 − t) = 2.24: t² − 1.62 t + 0.62 = 0
    let t = 0.81 - (0.81_f64 * 0.81 - 0.62).sqrt();
    let temporal = found.scene.temporal().unwrap();
    assert!((temporal - (2.0 + 2.0 * t)).abs() < 1e-9, "{temporal} {}", 2.0 + 2.0 * t);
    assert_eq!(found.scene.is_late_at_limit(), Some(true));
    let at_limit = found.run(Hypothesis::All).unwrap();
    assert!(at_limit.arrival.unwrap() >= 0.81 && at_limit.is_avoided());
}

/// 5 m/s at the demand, 9 m/s before it brakes to 4: a limit of 7 m/s is below what it drove.
#[test]
fn a_limit_between_the_demand_and_a_later_speed_is_no_contradiction() {
    let text = |limit: &str| {
        format!(
            "[vehicle1]\nspeed = \"4 m/s\"\n[[vehicle1.before.phase]]\nspeed = \"5 m/s\"\ntime = \"2 s\"\n\
             [[vehicle1.before.phase]]\nspeed = \"9 m/s\"\ntime = \"1 s\"\n[avoid]\nlimit = \"{limit} m/s\"\n\
             reaction_time = \"0 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ time = \"3 s\" }}\n"
        )
    };
    let found = asked(&text("7")).unwrap();
    assert!(found.scene.is_above_limit() && found.run(Hypothesis::LimitOnly).is_some());
    // By hand: 2 m/s² up to 7 m/s in 1 s, 6 m; 7 m in 1 s at it; from there 5 m/s² to the stop, 4.9 m. The
    // impact is 14 and 6.5 m from the demand.
    assert!((found.scene.distance - 20.5).abs() < 1e-12);
    let limited = found.run(Hypothesis::LimitOnly).unwrap();
    assert!((limited.course.stop().unwrap() - 17.9).abs() < 1e-9 && limited.stops_before());
    // Above what it drove, the limit changes nothing.
    let hypotheses: Vec<Hypothesis> =
        asked(&text("10")).unwrap().runs.iter().map(|run| run.hypothesis).collect();
    assert_eq!(hypotheses, [Hypothesis::Actual, Hypothesis::ReactionAndBraking]);
}

const RECORDED: &str = r#"
    [avoid]
    limit = "50 km/h"
    reaction_time = "0.8 s"
    deceleration = "7.5 m/s^2"
    demand = { time = "1.9 s" }
    [vehicle1]
    speed = "36 km/h"
    [vehicle1.recorder.pre_crash]
    time = "-2.5 -1.5 -0.5 -0.1 s"
    speed = "72 72 54 43 km/h"
"#;

/// 20 m/s up to 1.5 s before the impact, then evenly to 15 m/s in 1 s and to 10 m/s in 0.5 s: the sample at
/// −0.1 s gives way. Without slip, to begin with.
#[test]
fn the_table_of_a_recorder_is_the_actual_run() {
    let exact = "[vehicle1.recorder.errors]\nsteady_low = \"0 %\"\nslip_low = \"0 km/h\"\nsteady_sd = \"0 %\"\n\
                 slip_sd = \"0 km/h\"\ntyre_sd = \"0 %\"\n";
    let recorded =
        RECORDED.replace("[vehicle1.recorder.pre_crash]", &format!("{exact}[vehicle1.recorder.pre_crash]"));
    let found = asked(&recorded).unwrap();
    assert_eq!(found.scene.actual, ActualRun::Driven(DrivenBy::Recorder));
    assert!((found.scene.speed - 20.0).abs() < 1e-12);
    assert!((found.scene.distance - (0.4 * 20.0 + 17.5 + 6.25)).abs() < 1e-12, "{}", found.scene.distance);
    assert!((found.scene.delay().unwrap() - (0.4 - 0.8)).abs() < 1e-12);
    // On ground of 0.5, a fall of 5 m/s² is all that the brakes do, and its wheels slip by all of 3 km/h.
    let on_ground =
        recorded.replace("slip_low = \"0 km/h\"", "slip_low = \"3 km/h\"") + "[surface]\nfriction = 0.5\n";
    let second = 15.0 + 3.0 / 3.6;
    let distance = 0.4 * 20.0 + 0.5 * (20.0 + second) + 0.25 * (second + 10.0);
    let found = asked(&on_ground).unwrap();
    assert!((found.scene.distance - distance).abs() < 1e-12, "{}", found.scene.distance);
    // By the distance, it is the same moment.
    let by_distance = asked(&recorded.replace("time = \"1.9 s\"", "distance = \"31.75 m\"")).unwrap();
    assert!((by_distance.scene.time - 1.9).abs() < 1e-12);
    // A speed at the demand takes the place of the table.
    let given = RECORDED
        .replace("[vehicle1]\n    speed = \"36 km/h\"\n", "")
        .replace("[avoid]", "[avoid]\nspeed = \"72 km/h\"");
    assert_eq!(asked(&given).unwrap().scene.actual, ActualRun::Responded);
    // Without a speed at the impact, it is taken from the table, too, with its error.
    let alone = asked(&RECORDED.replace("speed = \"36 km/h\"\n", "\n")).unwrap();
    assert_eq!(alone.speed_from, SpeedSource::Recorder);
    assert!((alone.scene.at_impact - 43.0 / 3.6).abs() < 2.0, "{}", alone.scene.at_impact);
    let chance = alone.chance.as_ref().unwrap();
    assert!(chance.distance.low < alone.scene.distance && alone.scene.distance < chance.distance.high);
    // Slip as it is by default, by hand: 1.4 % where the wheels roll, and 3 km/h where they slow by 0.75 g,
    // in between by their shares; sd 0.43 % and 0.7 %.
    let share = 5.0 / (0.75 * 9.80665);
    let rolls = |speed: f64, braked: f64| {
        [braked * 3.0 / 3.6 + (1.0 - braked) * 0.014 * speed, {
            let (hard, steady) = (braked * 2.1 / 3.6, (1.0 - braked) * 0.0043 * speed);
            (hard * hard + steady * steady + (0.007 * speed).powi(2)).sqrt()
        }]
    };
    let [steady, steady_sd] = rolls(20.0, 0.0);
    let [slip, slip_sd] = rolls(15.0, share);
    // The last sample, 11 km/h below the one before in 0.4 s, braked by up to 0.75 g for up to 0.2 s more:
    // the speed at the impact by it, of whose error slip and tyres are a part.
    let stored = 43.0 / 3.6;
    let [last, last_sd] = rolls(stored, 1.0);
    // The brake is not known: as likely as not it was on, else ±1 m/s².
    let hard = 0.75 * 9.80665_f64;
    let mean_a = -0.25 * hard;
    let var_a = 0.5 * (hard * hard / 12.0 + hard * hard / 4.0) + 0.5 * 4.0 / 12.0 - mean_a * mean_a;
    let mean_g = 0.15;
    let whole = var_a * (mean_g * mean_g + 0.01 / 12.0) + mean_a * mean_a * 0.01 / 12.0;
    let sd = (last_sd * last_sd + whole).sqrt();
    let mean = stored + last + mean_a * mean_g;
    for (at_impact, most) in
        [(mean, 0.0), (mean + 0.5, 0.5 / sd), (mean - 0.5, -0.5 / sd), (mean - 4.0, -2.0)]
    {
        let text = RECORDED.replace("speed = \"36 km/h\"", &format!("speed = \"{at_impact} m/s\""));
        // Rounding has a test of its own.
        let text = format!("{text}[vehicle1.recorder.errors]\nstep = \"0.001 km/h\"\n");
        let slips = asked(&text).unwrap();
        let off = most * last_sd / sd;
        let [first, second] = [20.0 + steady + off * steady_sd, 15.0 + slip + off * slip_sd];
        let distance = 0.4 * first + 0.5 * (first + second) + 0.25 * (second + at_impact);
        assert!((slips.scene.speed - first).abs() < 3e-3, "{} {first}", slips.scene.speed);
        assert!((slips.scene.distance - distance).abs() < 1e-2, "{} {distance}", slips.scene.distance);
        let speed = slips.chance.as_ref().unwrap().speed;
        let left = steady_sd * (1.0 - (last_sd / sd).powi(2)).sqrt();
        assert!((speed.high - speed.low - 2.0 * 1.96 * left).abs() < 0.1 * left, "{speed:?} {left}");
    }
}

/// Of two records, the one whose ΔV has the direction of the damage.
#[test]
fn the_record_of_the_impact_is_the_actual_run() {
    let [head, tail] = ["-30", "20"].map(|delta_v| {
        let speeds = if delta_v == "20" { "30 30 30" } else { "72 72 54" };
        format!(
            "[[vehicle1.recorder.records]]\ndelta_v_longitudinal = \"{delta_v} km/h\"\n\
             pre_crash = {{ time = \"-2.5 -1.5 -0.5 s\", speed = \"{speeds} km/h\" }}\n"
        )
    });
    let (before, _) = RECORDED.split_once("[vehicle1.recorder.pre_crash]").unwrap();
    let crush = "[vehicle1.crush]\nside = \"front\"\npdof = \"0 deg\"\nwidth = \"1.5 m\"\ndepths = \"30 30 cm\"\n\
                 stiffness = { category = 3 }\n";
    for records in [[&head, &tail], [&tail, &head]] {
        let found = asked(&format!("{before}{crush}{}{}", records[0], records[1])).unwrap();
        assert_eq!(found.scene.actual, ActualRun::Driven(DrivenBy::Recorder));
        // 72 km/h, and not 30: 1.4 % more, and less what the speed given at the impact shows.
        assert!((found.scene.speed - 20.28).abs() < 0.4, "{}", found.scene.speed);
    }
}

/// Before the demand, too, the eye is where the recorder puts it: 1.5 s before the impact it has 23.75 m to
/// go, and 0.4 s before that, 8 m more.
#[test]
fn the_eye_is_where_the_recorder_tells() {
    let found = asked(&RECORDED.replace("time = \"1.9 s\"", "time = \"0.5 s\"").replace(
        "[vehicle1]",
        "[vehicle1.recorder.errors]\nsteady_low = \"0 %\"\nslip_low = \"0 km/h\"\nsteady_sd = \"0 %\"\n\
         slip_sd = \"0 km/h\"\ntyre_sd = \"0 %\"\n[avoid.sight]\neye = { x = \"0 m\", y = \"0 m\" }\nheading = \"0 deg\"\nother_heading = \"90 deg\"\nother_speed = \"1 m/s\"\n\
         [[avoid.obstacle]]\npolygon = [{ x = \"50 m\", y = \"50 m\" }, { x = \"60 m\", y = \"50 m\" }, { x = \"60 m\", y = \"60 m\" }]\n\
         [vehicle1]",
    ))
    .unwrap();
    for (time, to_go) in [(0.5, 6.25), (1.5, 23.75), (1.9, 31.75)] {
        let [eye, _] = found.eye_and_point(time).unwrap();
        assert!((eye[0] + to_go).abs() < 1e-12 && eye[1].abs() < 1e-12, "{time}: {eye:?}");
    }
}

/// An impossible value is reported with its key.
#[test]
fn phases_that_cannot_be_get_a_sentence() {
    let text = |phases: &str, lines: &str| {
        format!(
            "[vehicle1]\nspeed = \"10 m/s\"\n[vehicle1.before]\nphase = [{phases}]\n[avoid]\nlimit = \"30 km/h\"\n\
             reaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ time = \"2 s\" }}\n{lines}\n"
        )
    };
    for (phases, lines, says) in [
        (
            "{ distance = \"40 m\", acceleration = \"2 m/s^2\" }",
            "",
            "ends at 10.00 m/s would have gained more speed than that",
        ),
        ("{ time = \"2 s\" }", "", "needs two of"),
        ("{ time = \"2 s\", distance = \"20 m\", acceleration = \"0 m/s^2\" }", "", "needs two of"),
        (
            "{ speed = \"2 m/s\", time = \"2 s\", acceleration = \"0 m/s^2\" }",
            "",
            "gives the speed at the impact",
        ),
        (
            "{ time = \"2 s\", acceleration = \"0 m/s^2\" }",
            "unbraked = true",
            "phases before the impact say how",
        ),
        ("{ time = \"2 s\", acceleration = \"0 m/s^2\" }", "speed = \"12 m/s\"", "so do the phases"),
    ] {
        let refused = asked(&text(phases, lines)).unwrap_err().to_string();
        assert!(refused.contains(says), "{phases} {lines}: {refused}");
    }
    // Followed onward: 5 m/s last 5/7 s at 7 m/s², and 25/14 m.
    for short in ["time = \"2 s\"", "distance = \"2 m\""] {
        let leads_on = text(&format!("{{ speed = \"5 m/s\", {short}, acceleration = \"-7 m/s^2\" }}"), "");
        let refused = asked(&leads_on.replacen("speed = \"10 m/s\"\n", "", 1)).unwrap_err().to_string();
        assert!(refused.contains("begins at 5.00 m/s would lose more speed than that"), "{short}: {refused}");
    }
}

/// A path with a corner: the place of the eye by hand. It comes from the south, turns at (−10, 0) and is at
/// (−2, 0) at the impact, 8 m farther.
#[test]
fn paths_may_turn() {
    let found = asked(
        r#"
        [avoid]
        speed = "10 m/s"
        unbraked = true
        limit = "30 km/h"
        reaction_time = "1 s"
        deceleration = "7 m/s^2"
        demand = { time = "2 s" }
        [avoid.sight]
        eye = { x = "-2 m", y = "0 m" }
        path = [{ x = "-10 m", y = "-6 m" }, { x = "-10 m", y = "0 m" }]
        other_path = [{ x = "3 m", y = "4 m" }]
        other_speed = "5 m/s"
        [[avoid.obstacle]]
        polygon = [{ x = "50 m", y = "50 m" }, { x = "60 m", y = "50 m" }, { x = "60 m", y = "60 m" }]
    "#,
    )
    .unwrap();
    for (time, eye, point) in [
        (0.0, [-2.0, 0.0], [0.0, 0.0]),
        (0.5, [-7.0, 0.0], [1.5, 2.0]),
        (1.0, [-10.0, -2.0], [3.0, 4.0]),
        // Before the first point it goes on straight.
        (2.0, [-10.0, -12.0], [6.0, 8.0]),
    ] {
        let places = found.eye_and_point(time).unwrap();
        for (found, expected) in places.iter().flatten().zip(eye.iter().chain(&point)) {
            assert!((found - expected).abs() < 1e-12, "{time}: {places:?}");
        }
    }
}

/// Steady at 30 km/h: v = 30 + U(±step/2) + 30 (1.4 % ± 0.43 % ± 0.7 %) is above 30 with
/// (½ step + 0.42)/step.
#[test]
fn the_probability_has_the_rounding_of_recorded_speeds() {
    for (step, above) in [("1 km/h", 0.857), ("5 km/h", 0.584)] {
        let found = asked_with(
            &format!(
                "[avoid]\nother_party = \"pedestrian\"\nlimit = \"30 km/h\"\nreaction_time = \"1 s\"\nswell = \"0.2 s\"\n\
                 deceleration = \"7 m/s^2\"\ndemand = {{ time = \"1.5 s\" }}\n[vehicle1.recorder]\npre_crash = {{ text = \"\"\"\n\
                 Time (sec)  Speed, vehicle indicated (km/h)  Service brake (On, Off)\n-2.0 30 Off\n-1.5 30 Off\n-1.0 30 Off\n\
                 -0.5 25 On\n0.0 15 On\n\"\"\" }}\nerrors = {{ step = \"{step}\" }}\n"
            ),
            AvoidPlan { samples: 20_000, ..AvoidPlan::default() },
        )
        .unwrap();
        let chance = found.chance.unwrap();
        assert!((chance.above_limit - above).abs() < 0.03, "{step}: {}", chance.above_limit);
    }
}
