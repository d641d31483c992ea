//! A case judged without solving it gets the same statements as the solved one, as far as possible.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::fs;
use std::path::PathBuf;

use analysis::{Ability, Assumption, AxleMeasure, Judgement, Sweep, Warning, judge};
use case::CaseFile;
use inputs::{Case, Purpose, TypicalStiffness};
use pim_core::VehicleId;

const PAPER: &str = include_str!("../../../fixtures/sae-980025.toml");
const FORWARD: &str = include_str!("../../../fixtures/sae-980025-impact.toml");
const UNCERTAIN: &str = include_str!("../../../fixtures/sae-980025-uncertain.toml");
const DAMAGE: &str = include_str!("../../../fixtures/sae-980025-crush.toml");
const INSPECTED: &str = include_str!("../../../fixtures/one-inspected.toml");

fn parsed(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case
}

#[track_caller]
fn changed(text: &str, from: &str, to: &str) -> Judgement {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    judge(&parsed(&text.replace(from, to)))
}

fn runs(judgement: &Judgement) -> Vec<&'static str> {
    let able = judgement.abilities.iter().filter(|ability| ability.obstacle.is_none());
    able.map(|ability| ability.purpose.name()).collect()
}

fn with_codes(warnings: &[Warning], codes: &[&str]) -> Vec<Warning> {
    warnings.iter().filter(|warning| codes.contains(&warning.code())).cloned().collect()
}

/// Warnings that need neither the impulse nor the speed sought.
const GEOMETRY: [&str; 12] = [
    "crush-plane",
    "contact-outside",
    "class-values",
    "burg-inertia",
    "pdofs-not-opposite",
    "contact-off-damage",
    "contact-other-half",
    "contact-depth",
    "damage-outside",
    "high-no-damage-speed",
    "large-angle",
    "no-residual-crush",
];

#[test]
fn warnings_are_those_of_the_solved_case() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let (mut solved, mut compared) = (0, 0);
    for folder in ["", "laws", "ricsac", "no-answer"] {
        for entry in fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let Ok(text) = fs::read_to_string(&path) else { continue };
            let Ok(CaseFile { case: file, .. }) = CaseFile::parse("case.toml", &text) else { continue };
            let judgement = judge(&file);
            let place = path.display();
            if file.reconstruct.is_some() {
                let Ok(analysis) = analysis::reconstruct(&file) else { continue };
                assert_eq!(
                    with_codes(&judgement.warnings, &GEOMETRY),
                    with_codes(&analysis.warnings, &GEOMETRY),
                    "{place}"
                );
                compared += with_codes(&analysis.warnings, &GEOMETRY).len();
                solved += 1;
            } else if let Ok(analysis) = analysis::impact(&file) {
                let codes = [&GEOMETRY[..], &["high-restitution"]].concat();
                assert_eq!(
                    with_codes(&judgement.warnings, &codes),
                    with_codes(&analysis.warnings, &codes),
                    "{place}"
                );
                solved += 1;
            }
            if let Ok(analysis) = analysis::crush(&file) {
                // Damage alone is judged in full.
                // The same centroid is where an impact places C, and the line of action of the damage alone.
                // An energy by a category is a warning about an answer.
                let collision = [
                    "crush-plane",
                    "high-restitution",
                    "contact-placed",
                    "damage-centroid",
                    "contact-apart",
                    "category-energy",
                ];
                let of_damage = |warnings: &[Warning]| -> Vec<Warning> {
                    warnings.iter().filter(|w| !collision.contains(&w.code())).cloned().collect()
                };
                let damage = of_damage(&judgement.warnings);
                assert_eq!(damage, of_damage(&analysis.warnings), "{place}");
                compared += damage.len();
                solved += 1;
            }
        }
    }
    assert!(solved >= 30 && compared > 5, "{solved} {compared}");
}

#[test]
fn a_case_runs_what_it_has_all_for() {
    assert_eq!(runs(&judge(&parsed(PAPER))), ["reconstruct", "estimate", "compare", "sensitivity", "draw"]);
    assert_eq!(runs(&judge(&parsed(FORWARD))), ["impact", "compare", "sensitivity", "draw"]);
    assert_eq!(runs(&judge(&parsed(DAMAGE))), ["crush", "sensitivity", "draw"]);
    assert_eq!(runs(&judge(&parsed(INSPECTED))), ["crush", "sensitivity", "draw"]);
    assert_eq!(
        runs(&judge(&parsed(UNCERTAIN))),
        ["reconstruct", "uncertainty", "estimate", "compare", "sensitivity", "draw"]
    );
    let nothing = judge(&parsed("[vehicle1]\nname = \"car\"\n[vehicle2]\nfixed = true\n"));
    assert_eq!(runs(&nothing), [""; 0]);
    let obstacles: Vec<usize> =
        nothing.abilities.iter().map(|ability| ability.obstacle.as_ref().unwrap().list().len()).collect();
    assert!(obstacles.iter().all(|&count| count > 0), "{obstacles:?}");
}

/// By hand: a skid of 20 m at 5 m/s² that ends with 10 m/s takes (√300 − 10)/5 = 1.46 s, and so began before
/// a demand 1 s before the impact, and not before one at 2 s.
#[test]
fn a_demand_after_the_braking_is_told_without_solving() {
    let text = |demand: f64| {
        format!(
            "[vehicle1]\nspeed = \"10 m/s\"\nbefore.skid = {{ length = \"20 m\", friction = {} }}\n[avoid]\nlimit = \"50 km/h\"\n\
             reaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\ndemand = {{ time = \"{demand} s\" }}\n",
            5.0 / 9.806_65
        )
    };
    let obstacle = |demand: f64| {
        let judgement = judge(&parsed(&text(demand)));
        let of_avoid = judgement.abilities.into_iter().find(|ability| ability.purpose == Purpose::Avoid);
        of_avoid.unwrap().obstacle
    };
    assert_eq!(obstacle(2.0), None);
    let faults = obstacle(1.0).unwrap();
    assert_eq!(faults.list()[0].key, "avoid.demand.time");
}

/// A truck whose yaw inertia is missing: the estimate that would tell the speed cannot run, and so neither
/// can the question.
#[test]
fn a_speed_that_cannot_be_found_is_told_without_solving() {
    let text = |inertia: &str| {
        format!(
            "[vehicle1]\nmass = \"1300 kg\"\nclass = 3\nheading = \"0 deg\"\ncontact = {{ x = \"1.5 m\", y = \"0 m\" }}\n\
             [vehicle1.crush]\nside = \"front\"\nees = \"40 km/h\"\n[vehicle2]\nkind = \"heavy-truck\"\nmass = \"26 t\"\n{inertia}\n\
             heading = \"0 deg\"\ncontact = {{ x = \"-6 m\", y = \"0 m\" }}\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.05\n\
             tangential = \"critical\"\n[avoid]\nlimit = \"50 km/h\"\nreaction_time = \"1 s\"\ndeceleration = \"7 m/s^2\"\n\
             demand = {{ distance = \"30 m\" }}\n"
        )
    };
    let obstacle = |inertia: &str| {
        let judgement = judge(&parsed(&text(inertia)));
        let of_avoid = judgement.abilities.into_iter().find(|ability| ability.purpose == Purpose::Avoid);
        of_avoid.unwrap().obstacle
    };
    assert_eq!(obstacle("yaw_radius = \"3.5 m\""), None);
    assert_eq!(obstacle("").unwrap().list()[0].key, "vehicle2.yaw_inertia");
}

/// The ranges of [avoid] count for that question alone.
#[test]
fn ranges_of_avoid_are_not_those_of_the_impact() {
    let nothing_uncertain = |deceleration: &str| {
        let avoid = format!("\n[avoid]\ndemand = {{ time = \"2 s\" }}\ndeceleration = {deceleration}\n");
        let judgement = judge(&parsed(&(FORWARD.to_owned() + &avoid)));
        let found = judgement.abilities.iter().find(|one| one.purpose == Purpose::Uncertainty).unwrap();
        let fault = found.obstacle.as_ref().unwrap().list()[0].clone();
        (fault.to_string(), fault.advice.unwrap())
    };
    let (message, _) = nothing_uncertain("\"7 m/s^2\"");
    assert_eq!(message, "no number of this case is a range, so nothing is uncertain");
    let (message, advice) = nothing_uncertain("{ low = \"6 m/s^2\", high = \"8 m/s^2\" }");
    assert_eq!(message, "no number outside of [avoid] is a range, so nothing is uncertain");
    assert!(!advice.contains("[avoid]"), "{advice}");
}

/// The commands do what `check` says about them.
#[test]
fn what_runs_runs_and_what_does_not_lacks_something() {
    let sweep = Sweep { step: 0.1, steps: 1 };
    for text in [PAPER, FORWARD, DAMAGE, INSPECTED, UNCERTAIN] {
        let file = parsed(text);
        for Ability { purpose, obstacle, .. } in judge(&file).abilities {
            let failure = match purpose {
                Purpose::Reconstruct => analysis::reconstruct(&file).err(),
                Purpose::Impact => analysis::impact(&file).err(),
                Purpose::Crush => analysis::crush(&file).err(),
                Purpose::Compare => analysis::compare(&file).err(),
                Purpose::Sensitivity => analysis::sensitivity(&file, sweep).err(),
                Purpose::Draw => analysis::furthest(&file).err(),
                Purpose::Motion => analysis::motion(&file).err(),
                Purpose::Uncertainty | Purpose::Estimate | Purpose::Avoid => continue,
            };
            assert_eq!(obstacle.is_none(), failure.is_none(), "{purpose}: {failure:?}");
        }
    }
}

/// An estimate has a row if it can run; and, with the missing keys, if the case has evidence that no other
/// command reads.
#[test]
fn evidence_is_judged() {
    let estimate = |judgement: &Judgement| {
        let found = judgement.abilities.iter().find(|ability| ability.purpose == Purpose::Estimate);
        found.map(|ability| ability.obstacle.as_ref().map(|faults| faults.list()[0].clone()))
    };
    assert!(matches!(estimate(&judge(&parsed(PAPER))), Some(None)));
    // The speeds of both are given.
    assert!(estimate(&judge(&parsed(FORWARD))).is_none());
    let recorder = "[vehicle1.recorder]\ndelta_v_longitudinal = \"-12 mph\"\n[impact]";
    let recorded = PAPER.replace("[impact]", recorder);
    assert!(matches!(estimate(&judge(&parsed(&recorded))), Some(None)));
    let evidence = analysis::estimate_evidence(&parsed(&recorded)).unwrap();
    assert_eq!(evidence, ["crush", "vehicle1.recorder.delta_v"]);
    let lacking = recorded.replace("heading     = \"180 deg\"\n", "");
    assert_ne!(lacking, recorded);
    // It is the estimate that needs it, although it is found to be missing where the impact is set up.
    let Some(Some(fault)) = estimate(&judge(&parsed(&lacking))) else { panic!() };
    assert_eq!(fault.key, "vehicle1.heading");
    let message = fault.message(|purpose| format!("`deltav {purpose}`"));
    assert_eq!(message, "`vehicle1.heading` is missing: `deltav estimate` needs it");
    // The speed where a skid begins is read by nothing else.
    let before =
        "[vehicle1.before]\nskid = { length = \"30 ft\", friction = 0.7 }\nspeed = \"50 mph\"\n[impact]";
    let skidded = parsed(&PAPER.replace("[impact]", before));
    assert!(matches!(estimate(&judge(&skidded)), Some(None)));
    assert_eq!(analysis::estimate_evidence(&skidded).unwrap(), ["crush", "vehicle1.before.speed"]);
}

/// SAE 870045, Table 1, side, category 2: 140 lb/in, 67 lb/in², 148 lb; the pound-force is 4.448222 N, the
/// inch 0.0254 m.
#[test]
fn the_stiffness_of_a_category_is_told() {
    let from = "stiffness = { d0 = \"30 lb^0.5\", d1 = \"77.5 lb^0.5/ft\" }";
    let judgement = changed(PAPER, from, "stiffness = { category = 2 }");
    let told = judgement.assumptions.iter().find_map(|assumption| match assumption {
        Assumption::TypicalStiffness { vehicle: VehicleId::Two, typical, abg, .. }
            if *typical == TypicalStiffness::Category(2) =>
        {
            Some(*abg)
        }
        _ => None,
    });
    let [a, b, g] = told.unwrap();
    assert!((a / (140.0 * 4.448_222 / 0.0254) - 1.0).abs() < 1e-6, "{a}");
    assert!((b / (67.0 * 4.448_222 / 0.0254 / 0.0254) - 1.0).abs() < 1e-6, "{b}");
    assert!((g / (148.0 * 4.448_222) - 1.0).abs() < 1e-6, "{g}");
}

#[test]
fn a_plane_that_does_not_separate_is_seen_before_a_speed_is_sought() {
    // r_1 = 6.3 ft at 180° − 22.4°, r_2 = 3.8 ft at 67° − 39°: along y they reach 2.40 ft and 1.78 ft from C,
    // to the same side.
    let judgement = changed(PAPER, "crush_plane = \"-23 deg\"", "crush_plane = \"90 deg\"");
    assert_eq!(with_codes(&judgement.warnings, &["crush-plane"]), [Warning::PlaneDoesNotSeparate]);
    assert_eq!(judge(&parsed(PAPER)).warnings, []);
}

#[test]
fn a_contact_point_outside_is_seen() {
    // C lies 6.3 ft cos 22.4° = 5.825 ft ahead of the CG; 5.825 − 5.5 = 0.325 ft ahead of the front.
    let outline = "[vehicle1]\nlength = \"14 ft\"\nwidth = \"6 ft\"\ncg_to_front = \"5.5 ft\"\n";
    let judgement = changed(PAPER, "[vehicle1]\n", outline);
    match judgement.warnings[..] {
        [Warning::ContactOutside { vehicle: VehicleId::One, distance }] => {
            assert!((distance / 0.3048 - 0.3246).abs() < 1e-3, "{distance}");
        }
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn a_high_restitution_needs_the_closing_speed() {
    let high = "restitution = 0.5";
    let forward = changed(FORWARD, "restitution = 0.3", high);
    match with_codes(&forward.warnings, &["high-restitution"])[..] {
        // Section 7 of docs/theory.md: the speeds of the paper, which close at 21.05 m/s along n.
        [Warning::HighRestitution { restitution, closing_speed }] => {
            assert!((restitution, (closing_speed - 21.05).abs() < 0.05) == (0.5, true), "{closing_speed}");
        }
        ref other => panic!("{other:?}"),
    }
    assert_eq!(changed(PAPER, "restitution = 0.3", high).warnings, []);
}

#[test]
fn directions_that_are_not_opposite_are_seen() {
    // θ_1 − PDOF_1 = 180°, θ_2 − PDOF_2 = 67° − 90° = −23°: 203° apart, 23° from opposite.
    let given = PAPER
        .replace("side      = \"front\"", "side = \"front\"\npdof = \"0 deg\"")
        .replace("side      = \"right\"", "side = \"right\"\npdof = \"90 deg\"");
    let judgement = judge(&parsed(&given));
    match with_codes(&judgement.warnings, &["pdofs-not-opposite"])[..] {
        [Warning::PdofsNotOpposite { angle }] => assert!((angle.to_degrees() - 23.0).abs() < 1e-9),
        ref other => panic!("{other:?}"),
    }
    // 0° on the front and 90° on the right are square hits.
    assert_eq!(with_codes(&judgement.warnings, &["angle-capped", "side-not-pushed"]), []);
}

#[test]
fn a_force_that_pulls_is_seen_only_where_its_direction_is_given() {
    let judgement = changed(PAPER, "side      = \"front\"", "side = \"front\"\npdof = \"120 deg\"");
    let pulled = with_codes(&judgement.warnings, &["side-not-pushed"]);
    assert!(matches!(pulled[..], [Warning::SideNotPushed { vehicle: VehicleId::One, .. }, ..]), "{pulled:?}");
    // A side half as stiff has half the force, if it is hit squarely; at what angle it is hit is known only
    // from the impulse.
    assert_eq!(changed(PAPER, "77.5 lb^0.5/ft", "50 lb^0.5/ft").warnings, []);
}

#[test]
fn what_is_assumed_is_listed_and_what_is_written_is_not() {
    let assumptions = judge(&parsed(PAPER)).assumptions;
    // G = d_0²/2: 35²/2 = 612.5 lbf and 30²/2 = 450 lbf.
    let g: Vec<f64> = assumptions
        .iter()
        .filter_map(|assumption| match assumption {
            Assumption::EnergyWithoutCrush { g, .. } => Some(g[0] / 4.448_221_615_260_5),
            _ => None,
        })
        .collect();
    assert!(g.len() == 2 && (g[0] - 612.5).abs() < 1e-9 && (g[1] - 450.0).abs() < 1e-9, "{g:?}");
    for assumed in [
        Assumption::YawRate { vehicle: VehicleId::One },
        Assumption::YawRate { vehicle: VehicleId::Two },
        Assumption::EqualSpacing { vehicle: VehicleId::Two },
        Assumption::Pdof { vehicle: VehicleId::One, opposite: None },
        Assumption::CappedCorrection { vehicle: VehicleId::Two },
        Assumption::BrachLaw,
        Assumption::NoMoment,
    ] {
        assert!(assumptions.contains(&assumed), "{assumed:?}");
    }
    assert!(!assumptions.contains(&Assumption::Dissipated), "the file says it");

    let says = |text: &str, assumption: &Assumption| judge(&parsed(text)).assumptions.contains(assumption);
    let without = PAPER.replace("energy_basis = \"dissipated\"", "");
    assert!(says(&without, &Assumption::Dissipated));
    let law = PAPER.replace("[impact]", "[impact]\nlaw = \"brach\"\nmoment_restitution = -1.0");
    assert!(!says(&law, &Assumption::BrachLaw) && !says(&law, &Assumption::NoMoment));
    let still = PAPER.replace("[vehicle1]\n", "[vehicle1]\nyaw_rate = \"0 deg/s\"\n");
    assert!(!says(&still, &Assumption::YawRate { vehicle: VehicleId::One }));
    assert!(says(&still, &Assumption::YawRate { vehicle: VehicleId::Two }));
    let fast = PAPER.replace("[vehicle1]\n", "[vehicle1]\nspeed = \"10 m/s\"\n");
    assert!(says(
        &fast,
        &Assumption::SpeedUnused { vehicle: VehicleId::One, given: 10.0, is_direction_used: false }
    ));
}

#[test]
fn what_the_motion_after_the_impact_assumes_is_listed() {
    let text = include_str!("../../../fixtures/rear-end-rest.toml");
    let of = |text: &str| judge(&parsed(text)).assumptions;
    let assumptions = of(text);
    let class = crash3::VehicleClass::new(3).unwrap();
    let vehicle = VehicleId::One;
    let axle = |measure, value| Assumption::Axle { vehicle, class: 3, measure, value };
    for assumed in [
        Assumption::LevelGround,
        Assumption::StraightWheels { vehicle: VehicleId::One },
        Assumption::StraightWheels { vehicle: VehicleId::Two },
        Assumption::SkidFriction { vehicle: VehicleId::One, friction: 0.7 },
        axle(AxleMeasure::Wheelbase, class.wheelbase),
        axle(AxleMeasure::Track, class.track),
        axle(AxleMeasure::CgToFrontAxle, class.cg_to_front_axle),
    ] {
        assert!(assumptions.contains(&assumed), "{assumed:?}");
    }
    assert!(!assumptions.contains(&Assumption::ImpactAtOrigin), "the file says it");
    for (from, to, key) in [
        ("[surface]", "[surface]\ngrade = { slope = 0.02, uphill = \"0 deg\" }", "surface.grade"),
        ("length = \"8 m\"", "length = \"8 m\", friction = 0.6", "vehicle1.before.skid.friction"),
        ("drag = \"locked\"", "drag = \"locked\"\nsteer = \"0 deg\"", "vehicle1.after.steer"),
        ("[vehicle2]\n", "[vehicle2]\ntrack = \"1.5 m\"\n", "vehicle2.track"),
    ] {
        let said = text.replace(from, to);
        assert_ne!(said, text);
        let lists = |text: &str| of(text).iter().any(|one| one.key() == key);
        assert!(lists(text) && !lists(&said), "{key}");
    }
    // With a wheelbase of its own, the CG lies at the same share of it.
    let longer =
        text.replace("[vehicle1]\n", &format!("[vehicle1]\nwheelbase = \"{} m\"\n", 2.0 * class.wheelbase));
    assert!(of(&longer).contains(&axle(AxleMeasure::CgToFrontAxle, 2.0 * class.cg_to_front_axle)));
    // Without friction of the ground nothing is followed; from the impact to rest, no survey is needed.
    let places = ["rest = { x = \"2.6 m\"", "rest = { x = \"19.0 m\"", "contact = { x = \"0 m\""];
    let bare: String = text
        .lines()
        .filter(|line| !places.iter().any(|place| line.starts_with(place)) && !line.starts_with("[scene]"))
        .map(|line| format!("{line}\n"))
        .collect();
    assert!(of(&bare).contains(&Assumption::ImpactAtOrigin));
    let nowhere = bare.replace("[surface]\nfriction = 0.7\n", "");
    assert!(!of(&nowhere).iter().any(|one| one.key().contains("after.") || one.key().starts_with("surface")));
}

#[test]
fn what_stands_in_for_an_unknown_vehicle_is_listed() {
    let assumptions = judge(&parsed(INSPECTED)).assumptions;
    let keys: Vec<String> = assumptions.iter().map(Assumption::key).collect();
    for key in [
        "vehicle1.yaw_inertia",
        "vehicle2.yaw_inertia",
        "vehicle1.crush.stiffness.test.fit",
        "vehicle2.crush.width",
        "vehicle2.crush.offset",
        "vehicle2.crush.pdof",
    ] {
        assert!(keys.iter().any(|known| known == key), "{key} of {keys:?}");
    }
    // The file gives offset and PDOF of vehicle 1, and the correction of vehicle 2.
    for key in ["vehicle1.crush.offset", "vehicle1.crush.pdof", "vehicle2.crush.oblique"] {
        assert!(!keys.iter().any(|known| known == key), "{key}");
    }
    // Burg: 0.1269 × mass × wheelbase × length, of 1480 kg, 2.72 m and 4.75 m.
    let burg = 0.1269 * 2.72 * 4.75 * 1480.0;
    let of_burg = assumptions.iter().find_map(|assumption| match assumption {
        Assumption::BurgInertia { vehicle: VehicleId::Two, yaw_inertia } => Some(*yaw_inertia),
        _ => None,
    });
    assert!((of_burg.unwrap() - burg).abs() < 1e-9);
    // PDOF_2 = θ_2 − θ_1 + PDOF_1 − 180° = 75° − 0° − 30° − 180° = −135°.
    let opposite = assumptions.iter().find_map(|assumption| match assumption {
        Assumption::Pdof { vehicle: VehicleId::Two, opposite } => *opposite,
        _ => None,
    });
    assert!((opposite.unwrap().to_degrees() + 135.0).abs() < 1e-9);
}

/// Radii of gyration of CRASH3's classes: SAE 870045, Table 2.
#[test]
fn an_outline_that_is_not_given_is_that_of_the_nearest_class() {
    let outlines = |of_car: &str| -> Vec<Assumption> {
        let text = PAPER.replace("yaw_inertia = \"2437 lb ft s^2\"", of_car);
        assert_ne!(text, PAPER);
        let assumed = judge(&parsed(&text)).assumptions.into_iter();
        assumed.filter(|one| matches!(one, Assumption::Outline { vehicle: VehicleId::One, .. })).collect()
    };
    for class in 1..=6 {
        let radius = crash3::VehicleClass::new(class).unwrap().yaw_radius;
        for off in [-0.001, 0.0, 0.001] {
            let expected = Assumption::Outline { vehicle: VehicleId::One, class };
            assert_eq!(outlines(&format!("yaw_radius = \"{} m\"", radius + off)), [expected]);
        }
    }
    // Class 6 has 65.03 in: 15 % more are 74.8 in. Class 1 has 44.79 in: 15 % less are 38.07 in.
    let assumed = |radius: &str| !outlines(&format!("yaw_radius = \"{radius} in\"")).is_empty();
    assert_eq!(["38.0", "38.2", "74.7", "74.9"].map(assumed), [false, true, true, false]);
    // The body of class 3 reaches 89.8 in ahead of the CG and 36.3 in to its left; 0.6 m are 23.6 in.
    let contact = |x: &str, y: &str| {
        let radius = "yaw_radius = \"1.4645 m\"";
        let text = PAPER.replace("yaw_inertia = \"2437 lb ft s^2\"", radius).replace(
            "contact     = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }",
            &format!("contact = {{ x = \"{x} in\", y = \"{y} in\" }}"),
        );
        let assumed = judge(&parsed(&text)).assumptions;
        assumed.iter().any(|one| matches!(one, Assumption::Outline { vehicle: VehicleId::One, class: 3 }))
    };
    assert!(contact("113", "0") && !contact("114", "0") && contact("0", "59") && !contact("0", "60.5"));
    assert!(contact("-129", "0") && !contact("-131", "0"));
    for known in
        ["class = 4", "yaw_radius = \"1.4 m\"\nlength = \"4.5 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"2 m\""]
    {
        assert_eq!(outlines(known), []);
    }
}

/// A case of one vehicle has no other one about which anything could be assumed, even if it has a table of
/// the impact.
#[test]
fn nothing_is_assumed_of_a_vehicle_that_is_not_there() {
    let text = include_str!("../../../fixtures/one-vehicle.toml").to_owned()
        + "[impact]\ncrush_plane = \"180 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n";
    let assumptions = judge(&parsed(&text)).assumptions;
    assert!(assumptions.contains(&Assumption::YawRate { vehicle: VehicleId::One }), "{assumptions:?}");
    assert!(!assumptions.contains(&Assumption::YawRate { vehicle: VehicleId::Two }), "{assumptions:?}");
}

/// `find` names the vehicle whose speed is given, and the other one has none.
#[test]
fn a_speed_that_is_sought_and_given_is_told() {
    let judged = changed(PAPER, "= \"vehicle1.speed\"", "= \"vehicle2.speed\"");
    let reconstruct =
        judged.abilities.iter().find(|ability| ability.purpose == Purpose::Reconstruct).unwrap();
    let faults = reconstruct.obstacle.as_ref().unwrap().list();
    let [fault] = faults else { panic!("{faults:?}") };
    assert_eq!(
        (fault.key.as_str(), fault.advice.as_deref()),
        ("reconstruct.find", Some("write find = \"vehicle1.speed\""))
    );
}
