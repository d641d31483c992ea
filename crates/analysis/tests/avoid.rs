//! Avoidability: probabilities against simulated crashes, and what moves a whole case.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![allow(clippy::disallowed_methods, reason = "an independent simulation needs no equal bits")]

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use analysis::{
    ActualRun, AvoidPlan, Avoidance, Failure, Hypothesis, NoEstimate, Sight, SpeedSource, Unbraked, View,
    avoid,
};
use case::{Along, Case, CaseFile};
use drawing::{Axis, Marker, ScatterPanel, ScatterPicture, ScatterPoint, Symbol};

fn parsed(text: &str) -> Case {
    CaseFile::parse("avoid.toml", text).unwrap().case
}

fn asked(text: &str) -> Avoidance {
    asked_with(text, AvoidPlan::default()).unwrap()
}

pub(crate) fn asked_with(text: &str, plan: AvoidPlan) -> Result<Avoidance, Failure> {
    avoid(&parsed(text), &plan, &mut |_, _, _| ControlFlow::Continue(()))
}

/// A car at 20 m/s; from the right, a van sets out with 3.56 m/s² and is hit after 7.7 m, with 3.7 m to go.
#[test]
fn the_other_party_may_set_out_from_a_stop() {
    let text = |other: &str, clear: &str| {
        format!(
            r#"
[avoid]
unbraked = true
speed = "20 m/s"
limit = "50 km/h"
reaction_time = "1 s"
deceleration = "7 m/s^2"
demand = {{ other = {{ distance = "7.7 m", {other} }} }}
clear = {{ distance = "3.7 m"{clear} }}
"#
        )
    };
    let found = asked(&text("acceleration = \"3.56 m/s^2\"", ""));
    let [at_impact, cleared] = [7.7, 11.4].map(|way: f64| (2.0 * way / 3.56).sqrt());
    assert!((found.scene.time - at_impact).abs() < 1e-12);
    assert!((found.scene.distance - 20.0 * at_impact).abs() < 1e-9);
    assert!((found.scene.clears.unwrap().after - (cleared - at_impact)).abs() < 1e-12);
    // 20 t_c = v t − a (t − 1)²/2
    let late = (20.0 * at_impact + 3.5 * (cleared - 1.0).powi(2)) / cleared;
    assert!((found.scene.temporal().unwrap() - late).abs() < 1e-9);
    // It keeps 4 m/s once it has them, after 2.247 m.
    let kept = asked(&text("acceleration = \"3.56 m/s^2\", speed = \"4 m/s\"", ""));
    assert!((kept.scene.time - (7.7 / 4.0 + 4.0 / 7.12)).abs() < 1e-12);
    assert!((kept.scene.clears.unwrap().after - 3.7 / 4.0).abs() < 1e-12);
    // What `clear` says of its speed counts more than how it came.
    let said = asked(&text("acceleration = \"3.56 m/s^2\"", ", speed = \"2 m/s\""));
    assert!((said.scene.clears.unwrap().after - 1.85).abs() < 1e-12);
    // A way on without a speed is that of `demand`, which has to give one.
    let nothing = text("speed = \"4 m/s\"", "")
        .replace("{ other = { distance = \"7.7 m\", speed = \"4 m/s\" } }", "{ time = \"2 s\" }");
    let refused = asked_with(&nothing, AvoidPlan::default()).unwrap_err().to_string();
    assert!(refused.contains("avoid.clear.speed") || refused.contains("goes on as it came"), "{refused}");
}

/// Numbers at random that have nothing to do with those of the program: a multiplicative generator (Lehmer).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0 * 48_271 % 2_147_483_647;
        #[expect(clippy::cast_precision_loss, reason = "below 2^31")]
        let unit = self.0 as f64 / 2_147_483_647.0;
        unit
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn normal(&mut self, mean: f64, sd: f64) -> f64 {
        let (u, v) = (self.unit(), self.unit());
        mean + sd * (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
    }
}

/// A vehicle in small steps: the speed at a distance, and when it is there; `None` if it stops before.
fn stepped(speed: f64, [reaction, swell, deceleration]: [f64; 3], distance: f64) -> Option<[f64; 2]> {
    const STEP: f64 = 1e-4;
    let (mut v, mut s, mut t) = (speed, 0.0, 0.0);
    while s < distance {
        let braking = t + 0.5 * STEP - reaction;
        let share = if braking <= 0.0 { 0.0 } else { (braking / swell).min(1.0) };
        let next = v - share * deceleration * STEP;
        if next <= 0.0 {
            return None;
        }
        s += 0.5 * (v + next) * STEP;
        (v, t) = (next, t + STEP);
    }
    Some([v, t])
}

/// 1,000 crashes, each with true numbers out of the ranges that its case states, and so with an outcome at
/// the limit that is known: among those told a probability, the share that was avoided is that probability.
/// χ² over ten classes, at 1 %: 23.2.
#[test]
fn told_probabilities_are_those_of_simulated_crashes() {
    const CLASSES: usize = 10;
    let mut random = Random(20_261_127);
    let (mut count, mut told, mut variance, mut avoided) =
        ([0_usize; CLASSES], [0.0; CLASSES], [0.0; CLASSES], [0.0; CLASSES]);
    let limit: f64 = 50.0 / 3.6;
    for crash in 0..1_000 {
        // What the case states …
        let speed = random.between(15.0, 20.0);
        let time = random.between(0.9, 1.9);
        let has_clear = crash % 2 == 0;
        let way = random.between(0.2, 1.2);
        let clear = if has_clear {
            format!("clear = {{ distance = \"{way} m\", speed = {{ low = \"1 m/s\", high = \"2 m/s\" }} }}")
        } else {
            String::new()
        };
        let text = format!(
            r#"
            [avoid]
            speed = {{ value = "{speed} m/s", sd = "1 m/s" }}
            limit = "50 km/h"
            reaction_time = {{ low = "0.5 s", high = "1.2 s" }}
            swell = "0.2 s"
            deceleration = {{ value = "7.2 m/s^2", sd = "0.6 m/s^2" }}
            demand = {{ time = {{ value = "{time} s", sd = "0.15 s" }} }}
            unbraked = true
            {clear}
            "#
        );
        let plan = AvoidPlan { samples: 2_000, seed: crash, exact: false };
        let chance = asked_with(&text, plan).unwrap().chance.unwrap();
        // … and what was true.
        let speed = random.normal(speed, 1.0);
        let time = random.normal(time, 0.15);
        let driver = [random.between(0.5, 1.2), 0.2, random.normal(7.2, 0.6)];
        let clears = time + way / random.between(1.0, 2.0);
        let arrives = stepped(limit.min(speed), driver, speed * time);
        let is_avoided = arrives.is_none_or(|[_, arrival]| has_clear && arrival >= clears);

        let p = chance.avoided_at_limit;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "ten classes")]
        let class = ((p * 10.0) as usize).min(CLASSES - 1);
        count[class] += 1;
        told[class] += p;
        variance[class] += p * (1.0 - p);
        avoided[class] += if is_avoided { 1.0 } else { 0.0 };
    }
    let classes = (0..CLASSES).filter(|class| variance[*class] > 1.0);
    let chi2: f64 = classes.map(|k| (avoided[k] - told[k]).powi(2) / variance[k]).sum();
    assert!(chi2 < 23.2, "χ² {chi2}: {count:?} told {told:?}, avoided {avoided:?}");
    assert!(count.iter().all(|count| *count >= 20), "{count:?}");
    assert_drawn(&reliability(&count, [&told, &avoided, &variance]));
}

/// The reliability diagram of docs/calibration.md.
fn reliability(count: &[usize], [told, avoided, variance]: [&[f64]; 3]) -> String {
    let axis = |title: &str| Axis { title: title.to_owned(), unit: 1.0 };
    let filled = Symbol { marker: Marker::Circle, is_filled: true };
    let hollow = Symbol { marker: Marker::Diamond, is_filled: false };
    let points = count.iter().zip(told).zip(avoided).zip(variance);
    let points = points.flat_map(|(((count, told), avoided), variance)| {
        #[expect(clippy::cast_precision_loss, reason = "1,000 crashes")]
        let share = |sum: f64| sum / *count as f64;
        let error = 1.96 * variance.sqrt();
        let at = |of: f64, symbol, label| ScatterPoint {
            at: [share(*told), share(of).clamp(0.0, 1.0)],
            symbol,
            label,
        };
        [
            at(*told - error, hollow, None),
            at(*told + error, hollow, None),
            at(*avoided, filled, Some(count.to_string())),
        ]
    });
    ScatterPicture {
        name: "reliability",
        title: "Probability of avoidance: told, and come true".to_owned(),
        subtitle: "1,000 simulated crashes in ten classes of what they were told, labelled with their number."
            .to_owned(),
        description: "In each class, the share of crashes that the limit would have avoided is about the probability told."
            .to_owned(),
        across: axis("mean of the probabilities told"),
        upward: axis("share avoided"),
        panels: vec![ScatterPanel { title: String::new(), points: points.collect() }],
        legend: vec![
            (filled, "share avoided".to_owned()),
            (hollow, "ends of 95 %, if as told".to_owned()),
        ],
        equality: "as told".to_owned(),
    }
    .draw()
    .svg()
}

#[track_caller]
fn assert_drawn(now: &str) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/images/avoid-reliability.svg");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, now).unwrap();
    }
    let kept = std::fs::read_to_string(path).unwrap_or_default();
    assert!(kept == now, "{path} is not current: write it anew with UPDATE=1 cargo test -p deltav-analysis");
}

const PEDESTRIAN: &str = include_str!("../../../fixtures/avoid/pedestrian.toml");
const SKID: &str = include_str!("../../../fixtures/avoid/skid.toml");

/// The run of a skid, backwards by hand: v_0 = √(v_c² + 2 μ g s) + μ g t_S/2.
#[test]
fn a_skid_gives_the_speed_at_the_demand_and_the_reaction() {
    let found = asked(SKID);
    let a = 0.65 * 9.80665;
    let full = (100.0_f64 + 2.0 * a * 12.0).sqrt();
    let speed = full + a * 0.1;
    assert!((found.scene.speed - speed).abs() < 1e-9);
    // Braked: the swell at v_0 less a t_S²/6, and the skid.
    let braked = speed * 0.2 - a * 0.04 / 6.0 + 12.0;
    let braking = 0.2 + (full - 10.0) / a;
    let reaction = (29.0 - braked) / speed;
    let ActualRun::Skidded(slowed) = found.scene.actual else { unreachable!("a skid") };
    assert!((slowed.reaction() - reaction).abs() < 1e-9);
    assert!((found.scene.time - braking - reaction).abs() < 1e-9);
    assert!((found.scene.delay().unwrap() - (reaction - 0.85)).abs() < 1e-9);
    // A simulation in steps ends at the impact with the speed that is given there.
    let [at_impact, time] = stepped(speed, [reaction, 0.2, a], 29.0).unwrap();
    assert!((at_impact - 10.0).abs() < 1e-3 && (time - found.scene.time).abs() < 1e-3);
    assert_eq!(found.speed_from, SpeedSource::AtImpact);
    // Each other run, in steps.
    for run in &found.runs {
        let response = run.course.response.unwrap();
        let driver = [response.reaction(), 0.2, response.deceleration()];
        match stepped(run.course.speed, driver, 29.0) {
            Some([speed, arrival]) => {
                assert!((run.collision_speed - speed).abs() < 1e-2, "{:?}", run.hypothesis);
                assert!((run.arrival.unwrap() - arrival).abs() < 1e-2, "{:?}", run.hypothesis);
            }
            None => assert!(run.stops_before() && run.arrival.is_none(), "{:?}", run.hypothesis),
        }
    }
    assert_eq!(found.runs.len(), 6);
    assert!(found.run(Hypothesis::LimitOnly).is_some());
}

/// With the same seed the same bits; the probability does not depend on the rest of the file.
#[test]
fn samples_are_the_same_for_the_same_seed() {
    let [one, same, other] = [1, 1, 2].map(|seed| {
        let plan = AvoidPlan { seed, ..AvoidPlan::default() };
        asked_with(SKID, plan).unwrap().chance.unwrap()
    });
    assert_eq!(one.avoided_at_limit.to_bits(), same.avoided_at_limit.to_bits());
    assert_eq!(one.speed, same.speed);
    assert_ne!(one.speed, other.speed);
    assert!((one.avoided_at_limit - other.avoided_at_limit).abs() < 5.0 * (one.mc_error + other.mc_error));
}

#[test]
fn other_analyses_do_not_see_the_question() {
    let alone = include_str!("../../../fixtures/sae-980025-uncertain.toml");
    let asked = format!(
        "{alone}\n[avoid]\nlimit = \"30 mph\"\nreaction_time = {{ low = \"1 s\", high = \"2 s\" }}\ndeceleration = \"0.7 g\"\n\
         demand = {{ distance = {{ value = \"100 ft\", sd = \"5 ft\" }} }}\n"
    );
    let [alone, asked] = [alone, &asked].map(parsed);
    let settings = uncertainty::Settings::new(uncertainty::SamplingMethod::MonteCarlo, 640, 1);
    let of = |case: &Case| {
        let plan = analysis::Plan { settings, index_rows: None };
        analysis::uncertainty(case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap()
    };
    let [alone, asked] = [of(&alone), of(&asked)];
    assert_eq!(alone.inputs.len(), asked.inputs.len());
    assert_eq!(alone.propagation.columns(), asked.propagation.columns());
}

/// A pedestrian case has no vehicles, and no other analysis takes it for one.
#[test]
fn a_case_of_avoidability_alone_is_nothing_else() {
    let case = parsed(PEDESTRIAN);
    assert!(case.vehicles.iter().all(inputs::GivenVehicle::is_absent));
    for refused in [
        analysis::reconstruct(&case).err(),
        analysis::impact(&case).err(),
        analysis::crush(&case).err(),
        analysis::motion(&case).err(),
    ] {
        let Some(Failure::Case(faults)) = refused else { unreachable!("no vehicle") };
        assert!(faults.list().iter().any(|fault| fault.key == "vehicle1"), "{faults}");
    }
    assert!(asked(PEDESTRIAN).chance.is_none());
}

/// The ΔV that is left is that of the impact with the lower speed.
#[test]
fn what_is_left_comes_from_the_impact() {
    let impact = include_str!("../../../fixtures/sae-980025-impact.toml");
    let text = format!(
        "{impact}\n[avoid]\nlimit = \"45 mph\"\nreaction_time = \"1.5 s\"\ndeceleration = \"0.7 g\"\n\
         demand = {{ distance = \"150 ft\" }}\n"
    );
    let found = asked(&text);
    let run = found.run(Hypothesis::All).unwrap();
    assert!(run.collision_speed > 0.0);
    let mut slower = parsed(impact);
    let speed = inputs::Quantity::from_si(run.collision_speed, inputs::Dimension::Speed).unwrap();
    slower.vehicles[0].motion = Some(inputs::Velocity::Speed(speed));
    let expected = analysis::impact(&slower).unwrap().delta_v();
    assert_eq!(run.delta_v.unwrap().map(f64::to_bits), expected.map(f64::to_bits));
    let own = analysis::impact(&parsed(impact)).unwrap().delta_v();
    assert!(own[0] > expected[0]);
}

/// Every combination of the limit, the reaction in time and full braking, each against small steps.
#[test]
fn combinations_agree_with_steps() {
    let text = r#"
        [vehicle1]
        speed = "10 m/s"
        [vehicle1.before]
        skid = { length = "12 m", friction = 0.6 }
        [avoid]
        limit = "57 km/h"
        reaction_time = "0.8 s"
        swell = "0.2 s"
        deceleration = "7.5 m/s^2"
        demand = { distance = "30 m" }
    "#;
    let found = asked(text);
    let ActualRun::Skidded(slowed) = found.scene.actual else { unreachable!("{:?}", found.scene.actual) };
    let (late, skidded, driven, limit) = (slowed.reaction(), 0.6 * 9.80665, found.scene.speed, 57.0 / 3.6);
    assert!(late > 0.8);
    for (hypothesis, speed, reaction, deceleration) in [
        (Hypothesis::LimitOnly, limit, late, skidded),
        (Hypothesis::ReactionInTime, driven, 0.8, skidded),
        (Hypothesis::FullBraking, driven, late, 7.5),
        (Hypothesis::LimitAndReaction, limit, 0.8, skidded),
        (Hypothesis::LimitAndBraking, limit, late, 7.5),
        (Hypothesis::ReactionAndBraking, driven, 0.8, 7.5),
        (Hypothesis::All, limit, 0.8, 7.5),
    ] {
        let run = found.run(hypothesis).unwrap();
        // All of them collide, with speeds apart.
        let expected = stepped(speed, [reaction, 0.2, deceleration], 30.0).unwrap()[0];
        assert!(
            (run.collision_speed - expected).abs() < 2e-2,
            "{hypothesis:?} {} {expected}",
            run.collision_speed
        );
    }
    // What would have been enough at the limit, by hand: v²/2a + v t_R + v t_S/2 − a t_S²/24 = 30 m.
    let reaction = found.enough.reaction_at_limit.unwrap();
    let way = limit * (reaction + 0.1) + limit * limit / 15.0 - 7.5 * 0.04 / 24.0;
    assert!((way - 30.0).abs() < 1e-9, "{way}");
    let a = found.enough.deceleration_at_limit.unwrap();
    let way = limit * 0.9 + limit * limit / (2.0 * a) - a * 0.04 / 24.0;
    assert!((way - 30.0).abs() < 1e-9, "{way}");
}

/// Unbraked at 20 m/s, 30 m away: there after 1.5 s. The other party needs another 0.1 s, so that 1.6 s are
/// enough, far less than to stop takes.
#[test]
fn less_braking_is_enough_in_time_than_in_space() {
    let text = |limit: &str, clear: &str| {
        format!(
            "[vehicle1]\nspeed = \"20 m/s\"\n[avoid]\nunbraked = true\nlimit = \"{limit} m/s\"\n\
             reaction_time = \"1 s\"\nswell = \"0 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ distance = \"30 m\" }}\n{clear}\n"
        )
    };
    let clear = "clear = { distance = \"0.1 m\", speed = \"1 m/s\" }";
    let enough = asked(&text("19", clear)).enough;
    // 30 = 20 · 1.6 − a (1.6 − t_R)²/2
    let deceleration = 2.0 * (20.0 * 1.6 - 30.0) / (0.6 * 0.6);
    assert!((enough.deceleration.unwrap() - deceleration).abs() < 1e-9, "{enough:?}");
    let reaction = 1.6 - f64::sqrt(2.0 * (20.0 * 1.6 - 30.0) / 7.0);
    assert!((enough.reaction.unwrap() - reaction).abs() < 1e-9, "{enough:?}");
    let deceleration = 2.0 * (19.0 * 1.6 - 30.0) / (0.6 * 0.6);
    assert!((enough.deceleration_at_limit.unwrap() - deceleration).abs() < 1e-9, "{enough:?}");
    // At 18 m/s it takes 30/18 = 1.67 s without braking.
    let enough = asked(&text("18", clear)).enough;
    assert_eq!(enough.deceleration_at_limit, Some(0.0));
    assert!((enough.reaction_at_limit.unwrap() - 1.6).abs() < 1e-12, "{enough:?}");
    // In space alone: v²/2a in the 10 m that the reaction leaves, and 28.6 m of the 30 with 7 m/s².
    let enough = asked(&text("18", "")).enough;
    assert!((enough.deceleration.unwrap() - 400.0 / 20.0).abs() < 1e-9, "{enough:?}");
    assert!((enough.reaction.unwrap() - (30.0 - 400.0 / 14.0) / 20.0).abs() < 1e-9, "{enough:?}");
}

/// The case of a pedestrian behind a van, with other lines in `[avoid]` and before it.
fn behind_a_van(before: &str, lines: &str) -> String {
    format!(
        r#"
        {before}
        [avoid]
        limit = "30 km/h"
        reaction_time = "0.8 s"
        swell = "0.2 s"
        deceleration = "7.5 m/s^2"
        {lines}
        [avoid.sight]
        eye = {{ x = "-2 m", y = "0 m" }}
        heading = "0 deg"
        other_heading = "90 deg"
        other_speed = "1.5 m/s"
        [[avoid.obstacle]]
        polygon = [{{ x = "-8 m", y = "-1.8 m" }}, {{ x = "-3 m", y = "-1.8 m" }}, {{ x = "-3 m", y = "-3.8 m" }}, {{ x = "-8 m", y = "-3.8 m" }}]
        "#
    )
}

fn free(found: &Avoidance) -> Sight {
    let View::Free(sight) = found.scene.view else { unreachable!("{:?}", found.scene.view) };
    sight
}

/// The line from the eye (−2 − s, 0) to the pedestrian (0, −u t) passes the corner (−3, −1.8) of the van
/// where u t (s − 1) = 1.8 (s + 2).
fn passes_the_corner(way: f64, time: f64) -> f64 {
    1.5 * time * (way - 1.0) - 1.8 * (way + 2.0)
}

/// Unbraked at 15 m/s: 22.5 t² − 28.5 t − 3.6 = 0, by hand.
#[test]
fn the_view_becomes_free_where_the_line_passes_the_corner() {
    let expected = (28.5 + 1_136.25_f64.sqrt()) / 45.0;
    let unbraked = "speed = \"15 m/s\"\nunbraked = true\ndemand = ";
    for demand in ["{ sight = true }", "{ time = \"1.2 s\" }", "{ distance = \"40 m\" }"] {
        let found = asked(&behind_a_van("", &format!("{unbraked}{demand}")));
        let sight = free(&found);
        assert!((sight.time - expected).abs() < 1e-9, "{demand}: {sight:?}");
        assert!((sight.distance_subject - 15.0 * expected).abs() < 1e-8, "{demand}: {sight:?}");
        assert!((sight.distance_other - 1.5 * expected).abs() < 1e-9, "{demand}: {sight:?}");
        assert!(!found.hiding.unwrap().is_inside);
        assert_eq!(found.hiding.unwrap().by, Some(0));
        assert_eq!(found.scene.time < expected, demand.contains("time"), "{demand}");
    }
    // The same scene from the other side of the axes.
    let text = behind_a_van("[scene]\naxes = \"z-down\"", &format!("{unbraked}{{ sight = true }}"));
    let mirrored = text.replace("y = \"-", "y = \"").replace("\"90 deg\"", "\"-90 deg\"");
    assert!((free(&asked(&mirrored)).time - expected).abs() < 1e-9);
    // Turned by 180°.
    let turned = text
        .replace("= \"-", "= \"+")
        .replace("= \"2 m", "= \"-2 m")
        .replace("heading = \"0 deg", "heading = \"180 deg")
        .replace("\"90 deg", "\"-90 deg")
        .replace("x = \"+", "x = \"")
        .replace("y = \"+", "y = \"");
    assert!((free(&asked(&turned)).time - expected).abs() < 1e-9, "{turned}");
}

/// A case with a house whose corner (−3, −`corner`) hides the other vehicle, which comes along y, and other
/// lines before `[avoid]`.
fn behind_a_house(before: &str, demand: &str, corner: &str) -> String {
    format!(
        r#"
        {before}
        [avoid]
        vehicle = "vehicle1"
        unbraked = true
        limit = "50 km/h"
        reaction_time = "1 s"
        deceleration = "7 m/s^2"
        demand = {demand}
        [[avoid.obstacle]]
        polygon = [{{ x = "-3 m", y = "-{corner} m" }}, {{ x = "-300 m", y = "-{corner} m" }}, {{ x = "-300 m", y = "-300 m" }}, {{ x = "-3 m", y = "-300 m" }}]
        "#
    )
}

/// The other vehicle braked from 13 m/s to 5 m/s in the last 2 s, so that it had d = 5 t + 2 t² to go, and
/// 18 m + 13 (t − 2) before that. The line from the eye (−20 t, 0) to its front (0, −d) passes the corner
/// (−3, −y) of a house where d (1 − 3/(20 t)) = y: for y = 4 m at 2 t² + 4.7 t − 4.75 = 0, and for y = 30 m
/// at 13 t² − 39.95 t + 1.2 = 0, by hand. At a constant 5 m/s it would be t = 0.95 s for the first.
#[test]
fn the_other_vehicle_comes_into_sight_as_its_phases_or_its_skid_tell() {
    let roots = [("4", (60.09_f64.sqrt() - 4.7) / 4.0), ("30", (39.95 + 1_533.602_5_f64.sqrt()) / 26.0)];
    let phase = "phase = [{ time = \"2 s\", acceleration = \"-4 m/s^2\" }]";
    let skid = format!("skid = {{ length = \"18 m\", friction = {} }}", 4.0 / 9.806_65);
    for ((corner, expected), before) in roots.iter().flat_map(|root| [(root, phase), (root, &skid)]) {
        let came = format!(
            "[vehicle1]\nspeed = \"20 m/s\"\nheading = \"0 deg\"\n[vehicle2]\nspeed = \"5 m/s\"\nheading = \"90 deg\"\nbefore.{before}"
        );
        let text = behind_a_house(&came, "{ sight = true }", corner);
        let found = asked(&text);
        let sight = free(&found);
        assert!((sight.time - expected).abs() < 1e-9, "{corner} {before}: {sight:?} for {expected}");
        let to_go = if *expected < 2.0 {
            5.0 * expected + 2.0 * expected * expected
        } else {
            18.0 + 13.0 * (expected - 2.0)
        };
        assert!((sight.distance_other - to_go).abs() < 1e-8, "{sight:?} for {to_go}");
        let [_, [_, y]] = found.eye_and_point(*expected).unwrap();
        assert!((y + to_go).abs() < 1e-8, "{y} for {to_go}");
        // A speed that is given for the sight is constant.
        let text =
            text.replace("[[avoid.obstacle]]", "[avoid.sight]\nother_speed = \"5 m/s\"\n[[avoid.obstacle]]");
        let sight = free(&asked(&text));
        assert!((sight.distance_other - 5.0 * sight.time).abs() < 1e-9, "{sight:?}");
    }
}

/// The same house, 4 m aside, and another vehicle that came with a steady 10 m/s: 10 t − 1.5 = 4. Its
/// recorder tells that alone, with its error, or the other vehicle's speed is to be found, too.
#[test]
fn the_speed_of_the_other_in_sight_is_that_of_its_recorder_or_of_the_evidence() {
    let text = |before: &str| behind_a_house(before, "{ time = \"2 s\" }", "4");
    let recorded = r#"
        [vehicle1]
        speed = "20 m/s"
        heading = "0 deg"
        [vehicle2]
        heading = "90 deg"
        recorder.pre_crash = { time = "-2 -1.5 -1 -0.5 0 s", speed = "36 36 36 36 36 km/h" }
        "#;
    let found = asked(&text(recorded));
    let sight = free(&found);
    assert!((sight.time - 0.55).abs() < 0.02, "{sight:?}");
    let interval = found.chance.unwrap().sight.unwrap().time;
    assert!(
        interval.low < 0.55 && interval.high > 0.55 && interval.high - interval.low > 0.01,
        "{interval:?}"
    );
    // Cars that stuck together: both speeds by momentum, 20 m/s along x and 10 m/s along y.
    let sought = r#"
        [scene]
        locked_together = true
        [vehicle1]
        mass = "1500 kg"
        yaw_radius = "1.4 m"
        heading = "0 deg"
        contact = { x = "2 m", y = "0 m" }
        after = { speed = "11.180339887498949 m/s", direction = "26.565051177077989 deg", yaw_rate = "0 deg/s" }
        [vehicle2]
        mass = "1500 kg"
        yaw_radius = "1.4 m"
        heading = "90 deg"
        contact = { x = "0 m", y = "0.9 m" }
        [reconstruct]
        find = ["vehicle1.speed", "vehicle2.speed"]
        "#;
    let sight = free(&asked(&text(sought)));
    assert!((sight.time - 0.55).abs() < 1e-9, "{sight:?}");
}

/// A driver who brakes as soon as the view is free reaches the place later than without: found by stepping
/// the demand back until the line passes the corner.
#[test]
fn the_demand_by_sight_agrees_with_steps() {
    let found = asked(&behind_a_van("", "speed = \"15 m/s\"\ndemand = { sight = true }"));
    assert_eq!(found.scene.actual, ActualRun::Responded);
    let way = (1..).map(|k| 1e-3 * f64::from(k)).skip(5_000).find(|way| {
        let [_, time] = stepped(15.0, [0.8, 0.2, 7.5], *way).unwrap();
        passes_the_corner(*way, time) > 0.0
    });
    assert!((found.scene.distance - way.unwrap()).abs() < 2e-3, "{} {way:?}", found.scene.distance);
    assert!(passes_the_corner(found.scene.distance, found.scene.time).abs() < 1e-6);
    assert_eq!(free(&found).distance_subject.to_bits(), found.scene.distance.to_bits());
    // A skid up to the impact: by hand, 10 m at 0.7 g to 10 m/s.
    let skid =
        "[vehicle1]\nspeed = \"10 m/s\"\n[vehicle1.before]\nskid = { length = \"10 m\", friction = 0.7 }";
    let found = asked(&behind_a_van(skid, "demand = { sight = true }"));
    let sight = free(&found);
    assert!(passes_the_corner(sight.distance_subject, sight.time).abs() < 1e-6, "{sight:?}");
    assert!((found.scene.time - sight.time).abs() < 1e-12);
    let a = 0.7 * 9.80665;
    // The swell lasts 0.2 s with a mean of a/2, and loses a/10.
    let begins = (100.0 + 2.0 * a * 10.0_f64).sqrt();
    let swell = 0.2 * (begins + a * 0.1) - a * 0.04 / 6.0;
    let braked = (begins - 10.0) / a + 0.2;
    let expected = 10.0 + swell + (begins + a * 0.1) * (sight.time - braked);
    assert!((sight.distance_subject - expected).abs() < 1e-9, "{} {expected}", sight.distance_subject);
}

/// Samples: each has its own moment, and their median is about that of the central values.
#[test]
fn ranges_give_the_sight_an_interval() {
    let text = behind_a_van("", "speed = \"15 m/s\"\nunbraked = true\ndemand = { sight = true }")
        .replace("\"1.5 m/s\"", "{ low = \"1.2 m/s\", high = \"1.8 m/s\" }");
    let found = asked_with(&text, AvoidPlan { samples: 4_000, ..AvoidPlan::default() }).unwrap();
    let sight = found.chance.as_ref().unwrap().sight.unwrap();
    // By hand, as above: 15 u t² − (u + 27) t − 3.6 = 0 at the ends of 95 % of the range, 1.215 and 1.785.
    let at = |u: f64| ((u + 27.0) + ((u + 27.0) * (u + 27.0) + 216.0 * u).sqrt()) / (30.0 * u);
    assert!((sight.time.low - at(1.785)).abs() < 0.01, "{sight:?}");
    assert!((sight.time.high - at(1.215)).abs() < 0.01, "{sight:?}");
    assert_eq!(sight.never_hidden, 0.0);
}

/// Two vehicles on nearly one line meet somewhere else if one of them brakes. Where the speed of the other is
/// not known, or the lines are too far apart, the answer says that it takes the place as fixed.
#[test]
fn a_place_of_the_impact_that_moves_unknown_is_told() {
    let of = |heading: &str, speed: &str| {
        asked(&format!(
            "[vehicle1]\nmass = \"1400 kg\"\nheading = \"0 deg\"\nspeed = \"40 km/h\"\n[vehicle2]\nmass = \"1400 kg\"\n\
             heading = \"{heading} deg\"\n{speed}\n[avoid]\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\nunbraked = true\n"
        ))
        .nearly_along
        .map(|off| (off.along, off.angle.to_degrees().round()))
    };
    assert_eq!(of("0", ""), Some((Along::Ahead, 0.0)));
    assert_eq!(of("-8", ""), Some((Along::Ahead, 8.0)));
    assert_eq!(of("175", ""), Some((Along::Oncoming, 5.0)));
    assert_eq!(of("90", ""), None);
    assert_eq!(of("0", "speed = \"20 km/h\""), None);
    assert_eq!(of("0", "speed = \"0 km/h\""), None);
    // Beyond 10°, a speed that is known does not help.
    for speed in ["", "speed = \"20 km/h\""] {
        assert_eq!(of("11", speed), Some((Along::Ahead, 11.0)));
        assert_eq!(of("-152", speed), Some((Along::Oncoming, 28.0)));
        assert_eq!(of("149", speed), None);
        assert_eq!(of("31", speed), None);
    }
    assert_eq!(of("20", "speed = \"0 km/h\""), None);
}

/// The demand and the rest of the case can each say how fast the other vehicle came.
#[test]
fn a_demand_that_contradicts_the_speed_of_the_other_is_told() {
    let of = |demand: &str, speed: &str| {
        asked(&format!(
            "[vehicle1]\nmass = \"1400 kg\"\nheading = \"0 deg\"\nspeed = \"40 km/h\"\n[vehicle2]\nmass = \"1400 kg\"\n\
             heading = \"90 deg\"\n{speed}\n[avoid]\nother_party = \"vehicle\"\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ other = {{ {demand} }} }}\nunbraked = true\n"
        ))
        .other_speeds
        .map(|speeds| speeds.map(|speed| (speed * 36.0).round() / 10.0))
    };
    let steady = "distance = \"30 m\", speed = \"50 km/h\"";
    assert_eq!(of(steady, "speed = \"26 km/h\""), Some([50.0, 26.0]));
    assert_eq!(of(steady, "speed = \"38 km/h\""), None);
    assert_eq!(of(steady, ""), None);
    // √(2 · 2 · 8) m/s = 20.4 km/h, unless it keeps 10 km/h.
    let from_stop = "distance = \"8 m\", acceleration = \"2 m/s^2\"";
    assert_eq!(of(from_stop, "speed = \"40 km/h\""), Some([20.4, 40.0]));
    assert_eq!(of(from_stop, "speed = \"20 km/h\""), None);
    let kept = "distance = \"8 m\", speed = \"10 km/h\", acceleration = \"2 m/s^2\"";
    assert_eq!(of(kept, "speed = \"20 km/h\""), Some([10.0, 20.0]));
    // Few measure a walking speed to 5 km/h.
    assert_eq!(of(kept, "speed = \"14 km/h\""), None);
}

/// The way out has a speed of its own, which says nothing of how the other came: without it, the sight is the
/// same. The place and the time are those of the test of the phases above.
#[test]
fn the_speed_of_the_way_out_is_not_that_of_the_approach() {
    let came = "[vehicle1]\nspeed = \"20 m/s\"\nheading = \"0 deg\"\n[vehicle2]\nspeed = \"5 m/s\"\nheading = \"90 deg\"\n\
                before.phase = [{ time = \"2 s\", acceleration = \"-4 m/s^2\" }]";
    let clear = "[avoid.clear]\ndistance = \"4 m\"\nspeed = \"9 m/s\"\n";
    let found = asked(&format!("{}\n{clear}", behind_a_house(came, "{ sight = true }", "4")));
    let expected = (60.09_f64.sqrt() - 4.7) / 4.0;
    assert!((free(&found).time - expected).abs() < 1e-9, "{:?} for {expected}", free(&found));
    assert!((found.scene.clears.unwrap().after - 4.0 / 9.0).abs() < 1e-12);
}

/// From a stop over 16 m with 2 m/s², the other comes at √(2·2·16) = 8 m/s, and goes on so.
#[test]
fn the_phases_of_the_other_tell_how_fast_it_goes_on() {
    let found = asked(
        "[vehicle1]\nspeed = \"20 m/s\"\n[vehicle2.before]\n\
         phase = [{ speed = \"0 m/s\", distance = \"16 m\", acceleration = \"2 m/s^2\" }]\n[avoid]\nlimit = \"50 km/h\"\n\
         vehicle = \"vehicle1\"\nunbraked = true\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = { distance = \"30 m\" }\n\
         clear = { distance = \"4 m\" }\n",
    );
    assert!((found.scene.clears.unwrap().after - 0.5).abs() < 1e-12);
}

/// The contact point is behind the CG of vehicle 1 and in front of that of vehicle 2: that one ran into it,
/// unless it was slower. Swapped, vehicle 1 ran into vehicle 2.
#[test]
fn who_is_hit_from_behind_is_not_asked_to_brake() {
    let of = |[own, other]: [&str; 2], heading: &str, speed: &str| {
        let text = format!(
            "[vehicle1]\nheading = \"0 deg\"\nspeed = \"40 km/h\"\ncontact = {{ x = \"{own} m\", y = \"0 m\" }}\n[vehicle2]\n\
             heading = \"{heading} deg\"\n{speed}\ncontact = {{ x = \"{other} m\", y = \"0 m\" }}\n[avoid]\nlimit = \"50 km/h\"\n\
             vehicle = \"vehicle1\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\n\
             unbraked = true\n"
        );
        let refusal = asked_with(&text, AvoidPlan::default()).err().map(|failure| failure.to_string());
        refusal.is_some_and(|refusal| refusal.contains("ran into the rear of vehicle 1"))
    };
    let behind = ["-2.2", "2.1"];
    assert!(of(behind, "0", "") && of(behind, "-25", "") && of(behind, "20", "speed = \"60 km/h\""));
    assert!(!of(behind, "20", "speed = \"20 km/h\"") && !of(behind, "40", "") && !of(behind, "180", ""));
    assert!(!of(["2.1", "-2.2"], "0", "") && !of(["2.1", "0.3"], "0", ""));
    // Without contact points, the damaged sides tell it.
    let by_sides = |own: &str, other: &str| {
        let text = format!(
            "[vehicle1]\nheading = \"0 deg\"\nspeed = \"40 km/h\"\n[vehicle1.crush]\nside = \"{own}\"\nees = \"20 km/h\"\n\
             [vehicle2]\nheading = \"0 deg\"\n[vehicle2.crush]\nside = \"{other}\"\nees = \"20 km/h\"\n[avoid]\n\
             limit = \"50 km/h\"\nvehicle = \"vehicle1\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ distance = \"30 m\" }}\nunbraked = true\n"
        );
        asked_with(&text, AvoidPlan::default()).is_err()
    };
    assert!(by_sides("rear", "front") && !by_sides("front", "rear") && !by_sides("rear", "left"));
}

/// The recorder stored 78 km/h, give or take 4 %: an answer with 50 km/h is told, and one with 76 km/h is
/// not.
#[test]
fn a_speed_that_the_own_recorder_contradicts_is_told() {
    let of = |speed: &str| {
        let text = format!(
            "[vehicle1]\nspeed = \"{speed} km/h\"\nrecorder = {{ speed = \"78 km/h\" }}\n[avoid]\nlimit = \"50 km/h\"\n\
             vehicle = \"vehicle1\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\n\
             unbraked = true\n"
        );
        asked(&text).own_speeds.map(|speeds| speeds.map(|speed| (speed * 36.0).round() / 10.0))
    };
    assert_eq!(of("50"), Some([50.0, 78.0]));
    assert_eq!(of("76"), None);
}

/// The central speed and the probability are of one distribution: that of all evidence, although the exact
/// solution leads `reconstruct`.
#[test]
fn the_speed_is_that_of_the_distribution_behind_the_probability() {
    let text = "[vehicle1]\nmass = \"1400 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\ncontact = { x = \"1.9 m\", y = \"0 m\" }\n\
                [vehicle1.crush]\nside = \"front\"\nees = \"25 km/h\"\n[vehicle2]\nmass = \"1600 kg\"\nyaw_radius = \"1.4 m\"\n\
                heading = \"0 deg\"\nspeed = \"0 km/h\"\ncontact = { x = \"-2.2 m\", y = \"0 m\" }\n\
                [vehicle2.crush]\nside = \"rear\"\nees = \"24 km/h\"\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.15\n\
                tangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n[avoid]\nlimit = \"30 km/h\"\nreaction_time = \"1 s\"\n\
                deceleration = \"7 m/s^2\"\ndemand = { distance = \"30 m\" }\nunbraked = true\n";
    let found = asked(text);
    assert_eq!(found.speed_from, SpeedSource::Estimated);
    let driven = found.chance.as_ref().unwrap().speed;
    assert!((found.scene.speed - driven.median).abs() < 0.02 * driven.median, "{:?}", found.scene.speed);
    // By hand: both EES give 66.0 kJ; along one line that is ½ m (1 − e²) v² with m = 746.7 kg, so 13.44 m/s.
    let energy = 0.5 * (1400.0 * (25.0_f64 / 3.6).powi(2) + 1600.0 * (24.0_f64 / 3.6).powi(2));
    let exact = (2.0 * energy / (1400.0 * 1600.0 / 3000.0) / (1.0 - 0.15 * 0.15)).sqrt();
    assert!((found.exact_speed().unwrap() - exact).abs() < 1e-6, "{:?} {exact}", found.exact_speed());
    let plain = asked_with(text, AvoidPlan { exact: true, ..AvoidPlan::default() }).unwrap();
    assert_eq!((plain.speed_from, plain.exact_speed()), (SpeedSource::Reconstructed, None));
    assert!((plain.scene.at_impact - exact).abs() < 1e-6);
}

/// Evidence that no collision reproduces gives a speed no probability.
#[test]
fn contradicting_evidence_gives_no_probability() {
    let text = "[vehicle1]\nmass = \"1450 kg\"\nyaw_radius = \"1.37 m\"\nheading = \"0 deg\"\n\
                contact = { x = \"2.0 m\", y = \"0.1 m\" }\n\
                after = { speed = \"8 m/s\", direction = \"25 deg\", yaw_rate = \"-300 deg/s\" }\n\
                [vehicle2]\nmass = \"1280 kg\"\nyaw_radius = \"1.30 m\"\nheading = \"90 deg\"\n\
                contact = { x = \"0.9 m\", y = \"0.72 m\" }\n\
                after = { speed = \"10 m/s\", direction = \"35 deg\", yaw_rate = \"400 deg/s\" }\n\
                [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n\
                [reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]\n\
                [avoid]\nlimit = \"40 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
                demand = { distance = \"30 m\" }\nunbraked = true\n";
    let found = asked(text);
    let Some(NoEstimate::Contradicted(keys)) = &found.speed_doubt else { panic!("{:?}", found.speed_doubt) };
    assert!(!keys.is_empty() && found.chance.is_none());
}

/// A driver who kept the limit is asked about the reaction alone, however high the limit is: from 50 km/h
/// with 1 s and 7 m/s², 13.89 + 13.78 = 27.67 m of 30 m. What that leaves of its speed at a place 25 m ahead
/// is √(13.89² − 2 · 7 · 11.11) = 6.12 m/s.
#[test]
fn who_kept_the_limit_is_asked_about_the_reaction() {
    let of = |limit: &str| {
        asked(&format!(
            "[avoid]\nspeed = \"50 km/h\"\nlimit = \"{limit} km/h\"\nreaction_time = \"1 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ distance = \"30 m\" }}\nunbraked = true\n"
        ))
    };
    let v = 50.0 / 3.6;
    for limit in ["50", "50.001", "80"] {
        let found = of(limit);
        assert!((found.scene.stopping_distance() - (v + v * v / 14.0)).abs() < 1e-9);
        assert!((found.scene.at_limit().stop().unwrap() - (v + v * v / 14.0)).abs() < 1e-9, "{limit}");
        assert!(found.scene.stops_at_limit() && !found.scene.is_above_limit());
        let hypotheses: Vec<Hypothesis> = found.runs.iter().map(|run| run.hypothesis).collect();
        assert_eq!(hypotheses, [Hypothesis::Actual, Hypothesis::ReactionAndBraking]);
    }
    assert!(of("40").run(Hypothesis::All).is_some());
    let near = asked(
        "[avoid]\nspeed = \"50 km/h\"\nlimit = \"80 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
         demand = { distance = \"25 m\" }\nunbraked = true\n",
    );
    let left = near.run_at_limit().unwrap().collision_speed;
    assert!((left - (v * v - 14.0 * (25.0 - v)).sqrt()).abs() < 1e-9, "{left}");
    assert_eq!(left, near.scene.left_at_limit());
}

/// A table that shows the vehicle braking is not overruled in silence; a speed in `[avoid]` replaces it.
#[test]
fn unbraked_contradicts_the_table_of_a_recorder() {
    let text = |lines: &str| {
        format!(
            "[vehicle1.recorder]\npre_crash = {{ time = \"-2 -1.5 -1 -0.5 0 s\", speed = \"64 64 63 52 39 km/h\" }}\n\
             [avoid]\nunbraked = true\nlimit = \"50 km/h\"\nreaction_time = \"0.8 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ time = \"1.8 s\" }}\n{lines}"
        )
    };
    let refused = asked_with(&text(""), AvoidPlan::default()).unwrap_err().to_string();
    assert!(refused.contains("the table of its recorder shows how it came"), "{refused}");
    assert_eq!(asked(&text("speed = \"60 km/h\"")).scene.actual, ActualRun::Unbraked(Unbraked::Stated));
}

/// The table of a recorder is the actual run, and not the marks of the same braking, of which not even the
/// length has to be known; without the table, or with a speed in `[avoid]`, the marks are.
#[test]
fn the_table_of_a_recorder_comes_before_a_skid() {
    let text = |table: &str, skid: &str, lines: &str| {
        format!(
            "[vehicle1]\n{skid}{table}\n[surface]\nfriction = 0.7\n[avoid]\nlimit = \"50 km/h\"\n\
             reaction_time = \"0.8 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ time = \"1.8 s\" }}\n{lines}"
        )
    };
    let table = "recorder.pre_crash = { time = \"-2 -1.5 -1 -0.5 0 s\", speed = \"64 64 63 52 39 km/h\" }";
    let [skid, begun] = ["{ length = \"4 m\" }", "{ from = { x = \"-4 m\", y = \"0 m\" } }"]
        .map(|skid| format!("before.skid = {skid}\nposition = {{ x = \"0 m\", y = \"0 m\" }}\n"));
    let recorded = asked(&text(table, "", ""));
    assert!(!matches!(recorded.scene.actual, ActualRun::Skidded(_)));
    for skid in [&skid, &begun] {
        let both = asked(&text(table, skid, ""));
        assert_eq!(both.scene.distance.to_bits(), recorded.scene.distance.to_bits(), "{skid}");
        assert_eq!(both.scene.actual, recorded.scene.actual);
    }
    let given = asked(&text(table, &skid, "speed = \"60 km/h\""));
    assert!(matches!(given.scene.actual, ActualRun::Skidded(_)), "{:?}", given.scene.actual);
    let refused = asked_with(&text(table, &begun, "speed = \"60 km/h\""), AvoidPlan::default());
    assert!(refused.unwrap_err().to_string().contains("needs the length of the skid"));
}

/// Across the strip of a car 1.8 m wide, another of 4.5 m comes from the right, its front 2 m before its CG:
/// it is in the strip with its CG from 2.9 m before its middle to 3.4 m behind it.
#[test]
fn outlines_that_do_not_meet_are_refused() {
    let at = |left: f64| {
        let vehicle = |heading: f64, speed: f64, [x, y]: [f64; 2]| {
            format!(
                "heading = \"{heading} deg\"\nspeed = \"{speed} km/h\"\nlength = \"4.5 m\"\nwidth = \"1.8 m\"\n\
                 cg_to_front = \"2 m\"\nposition = {{ x = \"{x} m\", y = \"{y} m\" }}\n"
            )
        };
        let text = format!(
            "[vehicle1]\n{}[vehicle2]\n{}[avoid]\nlimit = \"40 km/h\"\nreaction_time = \"0.8 s\"\n\
             deceleration = \"7 m/s^2\"\ndemand = {{ time = \"1.5 s\" }}\nclear = {{ outlines = true }}\n",
            vehicle(0.0, 50.0, [0.0, 0.0]),
            vehicle(90.0, 20.0, [3.0, left])
        );
        asked_with(&text, AvoidPlan::default())
    };
    for left in [-2.95, 3.45] {
        let refused = at(left).unwrap_err().to_string();
        assert!(refused.contains("by their outlines the vehicles do not meet"), "{left}: {refused}");
    }
    for left in [-2.85, 0.0, 3.35] {
        let found = at(left).unwrap().scene.clears.unwrap();
        assert!((found.distance - (3.4 - left)).abs() < 1e-9, "{left}: {found:?}");
    }
}

/// From a stop, 0.8 s after the demand, with 2 m/s² over 4 m. A driver who reacts within that time stays; one
/// who reacts x later, from 2 x, stops within x² + (2 x)²/14 of the 4 m: x = √(28/9).
#[test]
fn a_vehicle_that_stands_at_the_demand_does_not_arrive_late() {
    let found = asked(
        "[[vehicle1.before.phase]]\nspeed = \"0 km/h\"\ntime = \"2 s\"\nacceleration = \"2 m/s^2\"\n\
         [avoid]\nlimit = \"20 km/h\"\nreaction_time = \"0.5 s\"\ndeceleration = \"7 m/s^2\"\n\
         demand = { time = \"2.8 s\" }\n",
    );
    assert_eq!(found.enough.deceleration, Some(0.0));
    assert!((found.enough.reaction.unwrap() - (0.8 + (28.0_f64 / 9.0).sqrt())).abs() < 1e-9);
    assert!(!found.scene.is_avoided_unbraked(false) && !found.scene.is_avoided_unbraked(true));
}

/// 6 m/s² over 2 s up to the impact, and a demand 1.5 s before it.
#[test]
fn brakes_before_the_demand_are_known() {
    let at = |demand: &str| {
        let text = format!(
            "[vehicle1]\nspeed = \"30 km/h\"\n[[vehicle1.before.phase]]\ntime = \"2 s\"\nacceleration = \"-6 m/s^2\"\n\
             [avoid]\nlimit = \"50 km/h\"\nreaction_time = \"0.8 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ time = \"{demand}\" }}\n"
        );
        asked(&text).scene
    };
    assert!((at("1.5 s").braked_at_demand().unwrap() - 6.0).abs() < 1e-12);
    assert_eq!(at("1.5 s").delay(), None);
    assert_eq!(at("2.5 s").braked_at_demand(), None);
    // (50 km/h)²/(2 · 6 m/s²) = 16.1 m, and it braked over 25.3 m.
    assert!(at("2.5 s").is_avoided_else_as_it_was());
}

/// 30 to 60 km/h over 24 m: with 0.8 s and 7 m/s², 8.33 to 14.08 m/s stop before, and are taken as unbraked.
#[test]
fn samples_that_would_have_stopped_are_counted() {
    let chance = asked(
        "[avoid]\nspeed = { low = \"30 km/h\", high = \"60 km/h\" }\nlimit = \"40 km/h\"\n\
         reaction_time = \"0.8 s\"\ndeceleration = \"7 m/s^2\"\ndemand = { distance = \"24 m\" }\n",
    )
    .chance
    .unwrap();
    // v t_R + v²/2a = 24 m
    let stops = 7.0 * ((0.64_f64 + 2.0 * 24.0 / 7.0).sqrt() - 0.8);
    let exact = (stops * 3.6 - 30.0) / 30.0;
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let (late, all) = (chance.late as f64, chance.possible as f64);
    assert!((late / all - exact).abs() < 4.0 * (exact * (1.0 - exact) / all).sqrt(), "{late} {all} {exact}");
}
