//! Which answer leads a reconstruction, which evidence it does not use, and which contradicts it.

#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::ops::ControlFlow;

use analysis::quantities::SPEED;
use analysis::{EstimatePlan, EvidenceMethod, Evident, Warning, impact, judge, reconstruct, weigh};
use case::{Case, CaseFile};
use inputs::Purpose;
use pim_core::VehicleId;

const FRONT_SIDE: &str = include_str!("../../case/templates/si/front-side.toml");
const REAR_END: &str = include_str!("../../../fixtures/rear-end.toml");
const FORWARD: &str = include_str!("../../../fixtures/sae-980025-impact.toml");
const BOTH: &str = include_str!("../../../fixtures/rear-end-rest.toml");
/// Few particles: these tests need no precision.
const PLAN: EstimatePlan =
    EstimatePlan { particles: 128, seed: 1, prior: None, pieces: analysis::PieceDetail::Weighed };

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

fn with(text: &str, table: &str) -> Case {
    read(&format!("{text}\n{table}\n"))
}

/// The evidence that contradicts an answer, with (SI) what the case gives.
fn contradicted(warnings: &[Warning]) -> Vec<(VehicleId, Evident, f64)> {
    let differs = |warning: &Warning| match warning {
        Warning::EvidenceDiffers { vehicle, evidence, given, .. } => Some((*vehicle, *evidence, *given)),
        _ => None,
    };
    warnings.iter().filter_map(differs).collect()
}

/// The paper's case has one equation for one speed; so has one whose crush energies are right on average.
#[test]
fn what_is_just_determined_is_solved_exactly() {
    for case in [read(case::EXAMPLE), with(REAR_END, "[estimate]\ncrush_bias = \"100 %\"")] {
        let exact = reconstruct(&case).unwrap();
        assert!(exact.left_aside.is_empty() && exact.why_not_exact().is_none());
        let weighed = weigh(&case, &exact, &PLAN, &mut |_, _, _| panic!("nothing is weighed")).unwrap();
        assert!(weighed.is_none());
    }
}

/// A share of the analyst's own for the crush energies is used by the estimate alone, so that leads, too.
#[test]
fn a_share_of_the_crush_energies_is_not_ignored() {
    let case = with(REAR_END, "[estimate]\ncrush_bias = \"80 %\"");
    let exact = reconstruct(&case).unwrap();
    assert_eq!(exact.left_aside, ["estimate.crush_bias"]);
    assert_eq!(exact.why_not_exact().unwrap().left_aside, ["estimate.crush_bias"]);
    // The impact is solved forward: its crush is only compared.
    assert!(impact(&with(FORWARD, "[estimate]\ncrush_bias = \"80 %\"")).unwrap().left_aside.is_empty());
}

/// A solution that takes the energy at which residual crush begins for that of the impact, although no
/// vehicle has any, does not lead; with crush on one vehicle it does.
#[test]
fn a_solution_by_an_upper_bound_does_not_lead() {
    let text = |depths: &str| {
        let own = |n: u8, side: &str, depths: &str| {
            format!(
                "[vehicle{n}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\n\
                 contact = {{ x = \"{} m\", y = \"0 m\" }}\n[vehicle{n}.crush]\nside = \"{side}\"\nwidth = \"1.5 m\"\n\
                 depths = \"{depths} cm\"\nstiffness = {{ A = \"300 N/cm\", B = \"40 N/cm^2\" }}\n",
                if n == 1 { 2 } else { -2 }
            )
        };
        format!(
            "{}{}[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.3\n\
             tangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n",
            own(1, "front", depths),
            own(2, "rear", "0 0").replace("heading", "speed = \"0 km/h\"\nheading"),
        )
    };
    let exact = reconstruct(&read(&text("0 0"))).unwrap();
    let why = exact.why_not_exact().unwrap();
    assert!(why.takes_bound && why.left_aside.is_empty() && !why.is_contradicted);
    // w A²/2B of both.
    let energy = 2.0 * 1.5 * 30e3_f64.powi(2) / (2.0 * 400e3);
    let found: f64 = exact.vehicles.iter().filter_map(|vehicle| vehicle.crush_energy()).sum();
    assert!((found - energy).abs() < 1e-9 * energy);
    let weighed = weigh(&read(&text("0 0")), &exact, &PLAN, &mut |_, _, _| ControlFlow::Continue(()));
    let weighed = weighed.unwrap().unwrap();
    let speed = weighed.summary(SPEED.of_vehicle(VehicleId::One)).unwrap().median.value;
    assert!(speed < 0.8 * exact.speed(VehicleId::One), "{speed}");
    assert!(reconstruct(&read(&text("0 4"))).unwrap().why_not_exact().is_none());
}

/// Both vehicles go off to one side after a collision on one line: the impulses that their rests imply differ
/// by more than their mean, and nothing is left of momentum.
#[test]
fn rests_that_balance_no_momentum_refute_the_solution() {
    let moved = BOTH
        .replace(
            "x = \"2.6 m\", y = \"0.1 m\", heading = \"2 deg\"",
            "x = \"2.6 m\", y = \"2.6 m\", heading = \"2 deg\"",
        )
        .replace("x = \"19.0 m\", y = \"0.3 m\"", "x = \"14 m\", y = \"14 m\"");
    for (text, fails) in [(BOTH, false), (moved.as_str(), true)] {
        let exact = reconstruct(&read(text)).unwrap();
        let implied = &exact.both.as_ref().unwrap().implied;
        let [one, two] = implied.impulses;
        let apart = (one - two).norm() / (0.5 * (one + two)).norm();
        let check = exact.checks.iter().find(|check| check.code() == "momentum-balance").unwrap();
        assert!((check.value - apart).abs() < 1e-12 * apart && (apart > 1.0) == fails, "{apart}");
        assert_eq!(exact.refuting().any(|check| check.code() == "momentum-balance"), fails);
    }
}

/// Two bodies cannot stand in one place: 2 m apart along their common heading they overlap by their width,
/// more than their crush explains. Where one stands beside the other, or behind it, they do not.
#[test]
fn rests_inside_each_other_are_doubted() {
    let overlap = |x: f64, y: f64, heading: f64| {
        let rest = format!("rest = {{ x = \"{x} m\", y = \"{y} m\", heading = \"{heading} deg\" }}");
        let case =
            read(&BOTH.replace("rest = { x = \"19.0 m\", y = \"0.3 m\", heading = \"-3 deg\" }", &rest));
        let warnings = reconstruct(&case).unwrap().warnings;
        warnings.iter().find_map(|warning| match warning {
            Warning::RestsOverlap { depth } => Some(*depth),
            _ => None,
        })
    };
    let depth = overlap(4.6, 0.1, 2.0).unwrap();
    // Half of each width, of CRASH3's classes 3 and 2.
    assert!((1.5..2.0).contains(&depth), "{depth}");
    assert_eq!([overlap(19.0, 0.3, -3.0), overlap(7.3, 0.1, 2.0), overlap(4.6, 2.3, 2.0)], [None; 3]);
}

/// A PDOF that is a right angle from that of the impact contradicts the solution, one that is 20° off only
/// warns.
#[test]
fn a_pdof_that_cannot_be_right_is_weighed() {
    let case = |pdof: f64| {
        read(&REAR_END.replacen(
            "[vehicle1.crush]\n",
            &format!("[vehicle1.crush]\npdof = \"{pdof} deg\"\n"),
            1,
        ))
    };
    let computed = reconstruct(&read(REAR_END)).unwrap().exchange().unwrap().pdof[0].to_degrees();
    for (off, contradicts) in [(90.0, true), (-60.0, true), (20.0, false)] {
        let exact = reconstruct(&case((computed + off).round())).unwrap();
        assert_eq!(exact.why_not_exact().is_some_and(|why| why.is_contradicted), contradicts, "{off}");
    }
}

/// Each kind of stiffness has its own share (docs/calibration.md, where a side was hit), and the reasons name
/// both.
#[test]
fn a_category_beside_the_fleet_shows_another_share() {
    let text =
        include_str!("../../../fixtures/t-bone-category.toml").replacen("{ category = 4 }", "\"fleet\"", 1);
    let why = reconstruct(&read(&text)).unwrap().why_not_exact().unwrap();
    let shown: Vec<([bool; 2], f64)> =
        why.energies_shown.iter().map(|shown| (shown.of, (100.0 * shown.share).round())).collect();
    assert_eq!(shown, [([false, true], 45.0), ([true, false], 59.0)]);
}

/// Energies by the stiffness of the fleet were on average 59 % of the impact's, those by categories 45 %
/// where a side was hit, 51 % in crashes into fixed objects. A solution that takes them as they are does not
/// lead: the answer is faster.
#[test]
fn a_solution_by_energies_that_are_too_small_on_average_does_not_lead() {
    let tree = include_str!("../../../fixtures/leaning-tree.toml");
    let by_category = FRONT_SIDE.replace("stiffness = \"fleet\"", "stiffness = { category = 3 }");
    for (text, share) in [(FRONT_SIDE, 0.594), (&by_category, 0.45), (tree, 0.51)] {
        let case = read(text);
        let exact = reconstruct(&case).unwrap();
        let why = exact.why_not_exact().unwrap();
        assert!(why.left_aside.is_empty() && why.refuted_by.is_empty() && !why.is_contradicted);
        let [shown] = why.energies_shown[..] else { panic!("{why:?}") };
        assert!((shown.share - share).abs() < 0.005, "{why:?}");

        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let weighed = weigh(&case, &exact, &PLAN, quietly).unwrap().unwrap();
        let median = weighed.summary(SPEED.of_vehicle(VehicleId::One)).unwrap().median.value;
        assert!(median > exact.found.as_ref().unwrap().speed, "{median}");
        assert_eq!(weighed.solutions[0].energies_shown, why.energies_shown);
    }
    let [car, pole] = [REAR_END, tree].map(|text| reconstruct(&read(text)).unwrap().solved_by());
    assert_eq!(car, EvidenceMethod::DamageAndSpeed { given: VehicleId::Two });
    assert_eq!(pole, EvidenceMethod::DamageByObject);
}

/// Fronts with EES 25 km/h close at 50.3 km/h with e = 0.1. A vehicle that comes at 150 km/h would have met
/// one that fled backward at 99.7 km/h, which none does; at 60 km/h, one that backed.
#[test]
fn a_solution_that_backs_too_fast_does_not_lead() {
    let vehicle = |heading: &str, speed: &str| {
        format!(
            "mass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n{speed}crush = {{ side = \"front\", ees = \"25 km/h\" }}\n"
        )
    };
    for (speed, backs, leads) in [(150.0, 99.7, false), (60.0, 9.7, true)] {
        let text = format!(
            "[vehicle1]\n{}[vehicle2]\n{}[impact]\ncrush_plane = \"180 deg\"\nrestitution = 0.1\n\
             tangential = \"critical\"\n[reconstruct]\nfind = \"vehicle2.speed\"\n",
            vehicle("0", &format!("speed = \"{speed} km/h\"\n")),
            vehicle("180", "")
        );
        let exact = reconstruct(&read(&text)).unwrap();
        assert!((exact.speed(VehicleId::Two) * 3.6 + backs).abs() < 0.05, "{}", exact.speed(VehicleId::Two));
        assert_eq!(exact.why_not_exact().is_none(), leads, "{speed}");
    }
}

/// A car that waited was struck from behind. Momentum and crush have it move backward at 4.6 km/h, less than
/// a walk, so the headline weighs all the evidence; not if the case says that it may have backed, and not
/// with a rest farther away, by which it moved forward.
#[test]
fn a_solution_that_backs_slowly_was_a_vehicle_that_stood() {
    let [front, rear] =
        ["{ A = \"56 N/mm\", B = \"0.5 N/mm^2\" }", "{ A = \"66 N/mm\", B = \"0.3 N/mm^2\" }"];
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let text = text.replace("{ category = 3 }", front).replace("{ category = 2 }", rear);
    let at_rest = |x: &str| text.replace("x = \"19.0 m\"", &format!("x = \"{x} m\""));
    let near = at_rest("12.0");
    let exact = reconstruct(&read(&near)).unwrap();
    assert!((exact.speed(VehicleId::Two) * 3.6 + 4.6).abs() < 0.05, "{}", exact.speed(VehicleId::Two));
    let why = exact.why_not_exact().unwrap();
    assert_eq!(why.nearly_stood, [VehicleId::Two]);
    assert!(why.refuted_by.is_empty() && !why.is_contradicted && why.energies_shown.is_empty(), "{why:?}");

    let quietly = &mut |_, _, _| ControlFlow::Continue(());
    let weighed = weigh(&read(&near), &exact, &PLAN, quietly).unwrap().unwrap();
    let stood = weighed.estimated.stood[1].unwrap().after.value;
    assert!(stood > 0.5, "{stood}");
    let backed = Warning::MayHaveBacked { vehicle: VehicleId::Two, speed: Some(exact.speed(VehicleId::Two)) };
    assert!(weighed.estimated.warnings.contains(&backed), "{:?}", weighed.estimated.warnings);

    let may_back = near.replace("[vehicle2]\n", "[vehicle2]\ncertain_speed = { at_least = \"-20 km/h\" }\n");
    assert_eq!(reconstruct(&read(&may_back)).unwrap().why_not_exact(), None);
    let far = reconstruct(&read(&at_rest("35.0"))).unwrap();
    assert!((far.speed(VehicleId::Two) * 3.6 - 4.9).abs() < 0.05, "{}", far.speed(VehicleId::Two));
    assert_eq!(far.why_not_exact(), None);
}

/// A recorder with half the speed by the crush: the headline is near the recorder's, whose error is small,
/// and the exact solution is shown below it as lying outside.
#[test]
fn a_recorder_that_contradicts_the_crush_leads_to_a_weighed_headline() {
    let alone = reconstruct(&read(REAR_END)).unwrap().found.unwrap().speed;
    let recorded = 0.5 * alone;
    let case = with(REAR_END, &format!("[vehicle1.recorder]\nspeed = \"{recorded} m/s\""));
    let exact = reconstruct(&case).unwrap();
    assert_eq!(exact.found.as_ref().unwrap().speed, alone);
    assert_eq!(exact.left_aside, ["vehicle1.recorder.speed"]);
    let told = contradicted(&exact.warnings);
    assert_eq!(told, [(VehicleId::One, Evident::RecordedSpeed, recorded)]);
    assert!(exact.why_not_exact().unwrap().is_contradicted);

    let quietly = &mut |_, _, _| ControlFlow::Continue(());
    let weighed = weigh(&case, &exact, &PLAN, quietly).unwrap().unwrap();
    let median = weighed.summary(SPEED.of_vehicle(VehicleId::One)).unwrap().median.value;
    // Three standard deviations of 4 %.
    assert!((median / recorded).ln().abs() < 0.12, "{median} for {recorded}");
    let own = &weighed.solutions[0];
    assert!(own.is_detailed && own.outside[0][0], "{own:?}");
    assert_eq!(own.speeds[0], Some(alone));
}

/// A recorder that agrees is more evidence, too, but contradicts nothing.
#[test]
fn a_recorder_that_agrees_contradicts_nothing() {
    let alone = reconstruct(&read(REAR_END)).unwrap().found.unwrap().speed;
    let case = with(REAR_END, &format!("[vehicle1.recorder]\nspeed = \"{} m/s\"", 1.05 * alone));
    let exact = reconstruct(&case).unwrap();
    assert!(contradicted(&exact.warnings).is_empty());
    let why = exact.why_not_exact().unwrap();
    assert_eq!((why.left_aside.len(), why.is_contradicted), (1, false));
}

/// A front is slowed down: a longitudinal ΔV is negative there, and one with the wrong sign contradicts the
/// impact, however right its size is. The limit is three standard deviations of 8 %, at least 5 km/h.
#[test]
fn the_sign_of_a_recorder_counts() {
    let plain = impact(&read(FORWARD)).unwrap();
    let [along, _] = plain.impact.as_ref().unwrap().outcome.delta_v_components()[0];
    assert!(along < -6.0, "{along}");
    let told = |value: f64| {
        let table = format!("[vehicle1.recorder]\ndelta_v_longitudinal = \"{value} m/s\"");
        contradicted(&impact(&with(FORWARD, &table)).unwrap().warnings).len()
    };
    assert_eq!([told(along), told(-along), told(0.0)], [0, 1, 1]);
    // As far as three deviations of what is recorded: r − 0.24 r = Δv.
    let border = along / 0.76;
    assert_eq!([told(0.999 * border), told(1.001 * border)], [0, 1]);
}

/// A limit that the answer breaks contradicts it; one that it keeps does not.
#[test]
fn a_certain_speed_that_the_answer_breaks_contradicts_it() {
    let alone = reconstruct(&read(REAR_END)).unwrap().found.unwrap().speed;
    let told = |limit: &str, factor: f64| {
        let line = format!("[vehicle1]\ncertain_speed = {{ {limit} = \"{} m/s\" }}", factor * alone);
        let case = read(&REAR_END.replacen("[vehicle1]", &line, 1));
        contradicted(&reconstruct(&case).unwrap().warnings)
            .into_iter()
            .map(|(_, evidence, _)| evidence)
            .next()
    };
    assert_eq!(told("at_most", 0.9), Some(Evident::AtMost));
    assert_eq!(told("at_most", 1.1), None);
    assert_eq!(told("at_least", 1.1), Some(Evident::AtLeast));
    assert_eq!(told("at_least", 0.9), None);
}

/// A velocity after the impact is not used where the crush energy gives the speed, and is compared with the
/// result.
#[test]
fn what_is_known_after_the_impact_is_held_against_the_damage() {
    let plain = impact(&read(FORWARD)).unwrap();
    let left = plain.impact.as_ref().unwrap().outcome.after[0].velocity;
    let direction = left.y.atan2(left.x).to_degrees();
    let told = |speed: f64, direction: f64| {
        let table = format!("[vehicle1.after]\nspeed = \"{speed} m/s\"\ndirection = \"{direction} deg\"");
        let analysis = impact(&with(FORWARD, &table)).unwrap();
        assert_eq!(analysis.left_aside, ["vehicle1.after.speed", "vehicle1.after.direction"]);
        contradicted(&analysis.warnings).into_iter().map(|(_, evidence, _)| evidence).collect::<Vec<_>>()
    };
    assert!(told(left.norm(), direction).is_empty());
    assert_eq!(told(2.0 * left.norm(), direction), [Evident::SpeedAfter]);
    assert_eq!(told(left.norm(), direction + 180.0), [Evident::DirectionAfter]);
}

/// Before anything is solved, `check` says which command uses what.
#[test]
fn a_judgement_says_what_each_command_leaves_aside() {
    let aside = |case: &Case, purpose: Purpose| {
        let judgement = judge(case);
        judgement.abilities.iter().find(|one| one.purpose == purpose).unwrap().left_aside.clone()
    };
    let case =
        with(REAR_END, "[vehicle1.recorder]\nspeed = \"50 km/h\"\ndelta_v_longitudinal = \"-20 km/h\"");
    let keys = ["vehicle1.recorder.speed", "vehicle1.recorder.delta_v_longitudinal"];
    for purpose in [Purpose::Reconstruct, Purpose::Compare, Purpose::Sensitivity] {
        assert_eq!(aside(&case, purpose), keys);
    }
    assert!(aside(&case, Purpose::Estimate).is_empty());
    assert_eq!(judge(&case).answers_most(), Some(Purpose::Reconstruct));
    // Along one line momentum needs the crush energy; for crossing approaches it does not use it.
    assert!(aside(&read(BOTH), Purpose::Reconstruct).is_empty());
    // One speed without damage is found from the velocities after the impact, too.
    let told = "after = { speed = \"6 m/s\", direction = \"0 deg\" }";
    let one = format!(
        "[vehicle1]\nmass = \"900 kg\"\nheading = \"0 deg\"\n{told}\n[vehicle2]\nmass = \"2400 kg\"\n\
         heading = \"0 deg\"\nspeed = \"0 km/h\"\n{told}\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
    );
    assert!(aside(&read(&one), Purpose::Reconstruct).is_empty());
    let crossing = BOTH.replacen("heading", "heading = \"60 deg\"\n#", 1);
    assert_eq!(aside(&read(&crossing), Purpose::Reconstruct), ["vehicle1.crush", "vehicle2.crush"]);
}

/// A body turned by 120° against its direction of travel travels as fast, and forward: the speed is along the
/// direction of travel.
#[test]
fn a_speed_is_along_the_direction_of_travel_however_the_body_is_turned() {
    let straight = reconstruct(&read(case::EXAMPLE)).unwrap();
    let turned = case::EXAMPLE
        .replace("heading     = \"180 deg\"", "heading = \"300 deg\"\nsideslip = \"-120 deg\"")
        .replace("\"-22.4 deg\"", "\"-142.4 deg\"")
        .replacen("[vehicle1]", "[vehicle1]\ncertain_speed = { at_least = \"30 mph\" }", 1);
    assert!(turned.contains("300 deg") && turned.contains("-142.4 deg"));
    let turned = reconstruct(&read(&turned)).unwrap();
    let expected = straight.speed(VehicleId::One);
    // SAE 980025, appendix: 22.9 m/s.
    assert!((expected - 22.9).abs() < 0.05);
    assert!((turned.found.as_ref().unwrap().speed - expected).abs() < 1e-9);
    assert!((turned.speed(VehicleId::One) - expected).abs() < 1e-9, "{}", turned.speed(VehicleId::One));
    assert!(contradicted(&turned.warnings).is_empty());
}

/// A vehicle that backs at 3 m/s: each exact solution with another speed for it reports the difference from
/// the case, whether the case gives a speed or a vector.
#[test]
fn a_solution_that_differs_from_a_given_velocity_says_so() {
    let vehicle = |n: u8, rest: &str, side: &str, depth: u8, after: u8| {
        format!(
            "[vehicle{n}]\nmass = \"1500 kg\"\nyaw_radius = \"1.3 m\"\nheading = \"0 deg\"\n{rest}\n\
             crush = {{ side = \"{side}\", width = \"1.6 m\", depths = \"{depth} {depth} cm\", \
             stiffness = {{ A = \"500 N/cm\", B = \"60 N/cm^2\" }} }}\n\
             after = {{ speed = \"{after} m/s\", direction = \"0 deg\" }}\n"
        )
    };
    let differs = |velocity: &str| {
        let one = vehicle(1, "contact = { x = \"2 m\", y = \"0 m\" }", "front", 30, 6);
        let two =
            vehicle(2, &format!("contact = {{ x = \"-2 m\", y = \"0 m\" }}\n{velocity}"), "rear", 20, 8);
        let law = "[impact]\ncrush_plane = \"180 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n";
        let case = read(&format!("{one}{two}{law}[reconstruct]\nfind = \"vehicle1.speed\"\n"));
        let exact = reconstruct(&case).unwrap();
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let weighed = weigh(&case, &exact, &PLAN, quietly).unwrap().unwrap();
        assert!(!weighed.output(SPEED.of_vehicle(VehicleId::Two)).unwrap().varies());
        let solutions = weighed.solutions.iter();
        solutions.map(|one| (one.differs_from[1], one.outside[0][1])).collect::<Vec<_>>()
    };
    let speed = differs("speed = \"-3 m/s\"");
    assert!(speed.contains(&(Some(-3.0), false)) && !speed.iter().any(|(_, outside)| *outside), "{speed:?}");
    assert_eq!(differs("velocity = { x = \"-3 m/s\", y = \"0 m/s\" }"), speed);
}

/// Two vehicles that cross at a right angle, with the damage of each and how they left.
fn crossing([one, two]: [&str; 2]) -> String {
    format!(
        r#"
[vehicle1]
mass = "1500 kg"
yaw_radius = "1.4 m"
heading = "0 deg"
contact = {{ x = "2 m", y = "0.3 m" }}
{one}
[vehicle2]
mass = "1300 kg"
yaw_radius = "1.3 m"
heading = "90 deg"
contact = {{ x = "0.3 m", y = "0.8 m" }}
{two}
[impact]
crush_plane = "0 deg"
restitution = 0.1
tangential = {{ friction = 0.5 }}
[reconstruct]
find = ["vehicle1.speed", "vehicle2.speed"]
"#
    )
}

/// Backing at 18 km/h out of a driveway, by the impulse equations with e = 0.1 and no sliding. An estimate
/// takes it as stationary, and says what allows that it backed.
#[test]
fn a_vehicle_that_backed_is_asked_about() {
    let text = crossing([
        "crush = { ees = \"7.525902 m/s\" }\n\
         after = { speed = \"8.240047 m/s\", direction = \"-9.226291 deg\", yaw_rate = \"-0.144058 rad/s\" }",
        "crush = { ees = \"8.084116 m/s\" }\nafter = { speed = \"9.719460 m/s\", direction = \"-20.952275 deg\" }",
    ]);
    let told = |text: &str| {
        let case = read(text);
        let exact = reconstruct(&case).unwrap();
        assert!((exact.speed(VehicleId::Two) + 5.0).abs() < 1e-3);
        let quietly = &mut |_, _, _| ControlFlow::Continue(());
        let weighed = weigh(&case, &exact, &PLAN, quietly).unwrap().unwrap();
        let warnings = weighed.estimated.warnings.into_iter();
        warnings.filter(|warning| warning.code() == "may-have-backed").collect::<Vec<_>>()
    };
    let [Warning::MayHaveBacked { vehicle: VehicleId::Two, speed: Some(speed) }] = told(&text)[..] else {
        panic!("{:?}", told(&text))
    };
    assert!((speed + 5.0).abs() < 1e-3, "{speed}");
    let allowed =
        text.replacen("[vehicle2]\n", "[vehicle2]\ncertain_speed = { at_least = \"-40 km/h\" }\n", 1);
    assert_eq!(told(&allowed), []);
}

/// A restitution of 1.6 is possible under no law, so such a solution is not the answer: velocities after the
/// impact by the impulse equations with it, and μ = 0.1.
#[test]
fn an_impossible_restitution_refutes_a_solution() {
    let text = crossing([
        "after = { speed = \"2.558651630755563 m/s\", direction = \"141.30247551133755 deg\", \
         yaw_rate = \"4.080846594973392 rad/s\" }",
        "after = { speed = \"19.45690975324331 m/s\", direction = \"18.439252906885848 deg\", \
         yaw_rate = \"-2.4028143628846514 rad/s\" }",
    ]);
    let exact = reconstruct(&read(&text)).unwrap();
    let [one, two] = VehicleId::ALL.map(|id| exact.speed(id));
    assert!((one - 14.0).abs() < 1e-6 && (two - 8.0).abs() < 1e-6, "{one} {two}");
    let codes: Vec<_> = exact.why_not_exact().unwrap().refuted_by.iter().map(|check| check.code()).collect();
    assert_eq!(codes, ["momentum-restitution"]);
}
