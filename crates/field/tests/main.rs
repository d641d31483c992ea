//! Reading a table of pairs, and the collision that is made from a pair.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

mod ciss;

use std::f64::consts::PI;
use std::ops::ControlFlow;

use estimate::Evidence;
use evidence::{CollisionModel, CrushMisfit, FITTED, Fitted, Number, ObjectFigures, Severity};
use field::{Crash as _, KnownCrush, Options, PairKind, Plane, judge, read, read_objects};
use pim_core::VehicleId;
use real::elementary::ln;

/// A front against a side at right angles; made up. Vehicle 1 drives north, vehicle 2 west.
const HEADER: &str = "CASEID,CURBWT_1,CARGOWT_1,CDCPLANE_1,PDOF_1,HEADINGANG_1,FIELDL_1,DIRECTL_1,DIRECTD_1,C1_1,C2_1,C3_1,C4_1,C5_1,C6_1,DVTOTAL_1,DVLONG_1,MAXDVLONG_1,MAXDVLAT_1,CURBWT_2,CARGOWT_2,CDCPLANE_2,PDOF_2,HEADINGANG_2,FIELDL_2,DIRECTL_2,DIRECTD_2,C1_2,C2_2,C3_2,C4_2,C5_2,C6_2,DVTOTAL_2,DVLONG_2,MAXDVLONG_2,MAXDVLAT_2";
const LINE: &str = "17,1500,,F,20,0,120,150,10,20,22,24,26,28,30,18,-17,-24,7,1400,0,L,290,270,200,180,30,10,20,30,30,20,10,20,,,";

fn table(line: &str) -> String {
    format!("{HEADER}\n{line}\n")
}

#[test]
fn a_line_is_read_in_si() {
    let pairs = read(&table(LINE)).unwrap();
    let [one, two] = pairs[0].vehicles;
    assert_eq!((pairs[0].case.as_str(), one.plane, two.plane), ("17", Plane::Front, Plane::Left));
    assert_eq!((one.curb_mass, one.cargo, two.cargo), (1500.0, None, Some(0.0)));
    assert!((one.pdof - PI / 9.0).abs() < 1e-12 && (two.heading.unwrap() - 1.5 * PI).abs() < 1e-12);
    assert_eq!((one.depths[5], one.direct_length, one.direct_offset), (0.30, Some(1.5), Some(0.10)));
    // √(24² + 7²) = 25 km/h
    let truth = one.truth().unwrap();
    assert!((truth.delta_v - 25.0 / 3.6).abs() < 1e-12 && !truth.is_longitudinal);
    assert!((one.by_winsmash(&truth).unwrap() - 5.0).abs() < 1e-12);
    assert!(two.truth().is_none());
}

#[test]
fn what_cannot_be_read_is_named() {
    for (from, to, said) in [
        ("17,1500,", "17,heavy,", "line 2, column CURBWT_1: \"heavy\" is not a number"),
        ("17,1500,", "17,,", "line 2, column CURBWT_1: the empty cell is not a number: without it"),
        ("17,1500,", "17,-5,", "line 2, column CURBWT_1: \"-5\" is not a mass above 0 kg"),
        ("1400,0,L", "1400,0,T", "line 2, column CDCPLANE_2: \"T\" is not F, B, L or R"),
        ("-24,7,", "-24,1e300,", "line 2, column MAXDVLAT_1: \"1e300\" is not a plausible number"),
        ("-24,7,", "-1e4,7,", "line 2, column MAXDVLONG_1: \"-1e4\" is not a plausible number"),
        ("120,150,10", "1e300,150,10", "line 2, column FIELDL_1: \"1e300\" is not a plausible number"),
        ("120,150,10", "120,1e300,10", "line 2, column DIRECTL_1: \"1e300\" is not a plausible number"),
        ("17,1500,", "17,1e9,", "line 2, column CURBWT_1: \"1e9\" is not a plausible number"),
        ("F,20,", "F,1e6,", "line 2, column PDOF_1: \"1e6\" is not a plausible number"),
        ("120,150,10", ",,10", "line 2, column FIELDL_1: the empty cell is not a length above 0 cm"),
        ("120,150,10", "0,-3,10", "line 2, column FIELDL_1: \"0\" is not a length above 0 cm"),
    ] {
        assert_eq!(LINE.matches(from).count(), 1);
        let error = read(&table(&LINE.replace(from, to))).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    // Blank lines and line breaks within a cell count, as an editor counts them.
    let bad = LINE.replace("17,1500,", "17,heavy,");
    for (lines, at) in [(format!("{LINE}\n\n\n{bad}"), 5), (format!("\"1\n7\"{}\n{bad}", &LINE[2..]), 4)] {
        let error = read(&table(&lines)).unwrap_err().to_string();
        assert!(error.starts_with(&format!("line {at}, column CURBWT_1")), "{error}");
    }
    let error = read(&format!("{HEADER},C1_1\n{LINE},99\n")).unwrap_err().to_string();
    assert!(error.starts_with("the column C1_1 appears twice"), "{error}");
    let error = read(&format!("{HEADER}\n")).unwrap_err().to_string();
    assert!(error.starts_with("the file has no pair of vehicles"), "{error}");
    let error = read("CASEID,CURBWT_1\n1,2\n").unwrap_err().to_string();
    assert!(error.starts_with("there is no column CDCPLANE_1; the file needs CASEID and"), "{error}");
}

#[test]
fn recorders_count_only_where_they_can_be_judged() {
    for (recorder, expected) in
        [("-24,7", Some(25.0)), ("-24,", Some(24.0)), (",7", None), ("-6,4", None), ("-7.9,", None)]
    {
        let pairs = read(&table(&LINE.replace("-24,7", recorder))).unwrap();
        let truth = pairs[0].vehicles[0].truth();
        assert_eq!(truth.map(|truth| (3.6 * truth.delta_v).round()), expected, "{recorder}");
        // The same on the struck side: the longitudinal part is not evidence on the push across the vehicle.
        let sides =
            read(&table(&LINE.replace("-24,7", ",").replace("20,,,", &format!("20,,{recorder}")))).unwrap();
        let both = recorder == "-24,7";
        assert_eq!(sides[0].vehicles[1].truth().is_some(), both, "{recorder}");
    }
}

#[test]
fn the_collision_has_the_geometry_of_the_damage() {
    let pair = read(&table(LINE)).unwrap().remove(0);
    let collision = pair.collision(&FITTED, &[]).unwrap();
    let exact = |number: Number| match number {
        Number::Exact(number) => number,
        Number::Unknown(distribution) => distribution.quantile(0.5),
    };
    let [one, two] = collision.vehicles;
    // North is along x, so west is counter-clockwise from it: headings 0 and 90° (−270°).
    assert!(exact(one.heading).abs() < 1e-12);
    assert!((exact(two.heading) + 1.5 * PI).abs() < 1e-12);
    // The left side of vehicle 2 faces south: n, from 2 to 1, points along −x.
    assert!((exact(collision.crush_plane).abs() - PI).abs() < 1e-9);
    // 10 cm to the right on the front, 30 cm forward on the side.
    assert!((exact(one.contact[1]) + 0.10).abs() < 1e-12 && (exact(two.contact[0]) - 0.30).abs() < 1e-12);
    // 1500 + 75 kg and 1400 + 75 kg; the width of the side is that of the front, 150 cm.
    assert!((exact(one.body.unwrap().mass) - 1575.0).abs() < 1e-9);
    let (front, side) = (one.crush.unwrap(), two.crush.unwrap());
    // G₀ L = ½ m₀/w₀ b₀² L
    let constant = |b0: f64| 0.5 * 1000.0 * b0 * b0 * 1.5;
    assert!((front.constant - constant(2.22)).abs() < 1e-9 && (side.constant - constant(1.58)).abs() < 1e-9);
    // A₀ C̄ L with C̄ = (20/2 + 22 + 24 + 26 + 28 + 30/2)/5 = 25 cm
    assert!((front.linear - 1000.0 * 2.22 * 27.7 * 0.25 * 1.5).abs() < 1e-6);
    // The recorder is not evidence, unless it is given.
    assert!(collision.observed.vehicles[0].recorder.delta_v.is_none());
    let given = pair.collision(&FITTED, &[VehicleId::One]).unwrap();
    assert!((given.observed.vehicles[0].recorder.delta_v.unwrap().size - 25.0 / 3.6).abs() < 1e-12);
    // The force came from the direction opposite to 24 km/h backward and 7 to the right.
    let direction = given.observed.vehicles[0].recorder.direction.unwrap();
    // tan p = −7/24
    assert!((direction.pdof + 0.283_794_109_208_327_9).abs() < 1e-12);
    assert!((direction.scale - FITTED.recorder_direction_scale).abs() < 1e-12);
    assert_eq!(CollisionModel::new(&collision).terms_count() + 2, CollisionModel::new(&given).terms_count());
}

/// 1575 kg · √(24² + 7²) km/h beside 1475 kg · √(3² + 26²) km/h: 2 % apart.
#[test]
fn recorders_of_two_events_are_told() {
    let both = LINE.replace("20,,,", "20,,3,-26");
    let event = |line: &str| read(&table(line)).unwrap()[0].is_one_event();
    assert_eq!(event(LINE), None);
    assert_eq!(event(&both), Some(true));
    // 3.1, 2.9 and 2.3 times as much.
    assert_eq!(event(&both.replace("-24,7", "-72,21")), Some(false));
    assert_eq!(event(&both.replace("3,-26", "9,-78")), Some(false));
    assert_eq!(event(&both.replace("3,-26", "7,-62")), Some(true));
    // Of the part along the vehicle alone, the whole follows from the PDOF: 2.6 times as much at 0° and 5.3
    // times at 60°. Below 8 km/h there is no truth.
    for (along, pdof, expected) in
        [(-18.0, 0.0, Some(true)), (-18.0, 60.0, Some(false)), (-5.0, 60.0, Some(true)), (-2.0, 60.0, None)]
    {
        let mut pair = read(&table(&both)).unwrap().remove(0);
        pair.vehicles[0].recorder = [Some(along), None];
        pair.vehicles[0].pdof = f64::to_radians(pdof);
        assert_eq!(pair.is_one_event(), expected, "{along} m/s at {pdof}°");
    }
}

#[test]
fn a_pair_is_judged_without_its_recorder() {
    let options = |other| Options { particles: 128, seed: 1, other, crush: KnownCrush::Both, injury: None };
    let mut progress = |_, _| ControlFlow::Continue(());
    let run =
        |line: &str, other| judge(&read(&table(line)).unwrap(), &FITTED, &options(other), &mut progress);
    let mut run = run;
    let field = run(LINE, false).unwrap();
    let [judged] = &field.judged[..] else { panic!() };
    assert_eq!((judged.vehicle, judged.kind), (VehicleId::One, PairKind::FrontSide));
    // Another truth changes the judgement, and not the estimate.
    let other = run(&LINE.replace("-24,7", "-48,14"), false).unwrap();
    assert_eq!((other.judged[0].median, other.judged[0].intervals), (judged.median, judged.intervals));
    assert!(other.judged[0].below > judged.below);
    // The other vehicle's recorder does.
    let both = LINE.replace("20,,,", "20,,3,-26");
    let given = run(&both, true).unwrap();
    assert_eq!(given.judged.len(), 2);
    assert_ne!(given.judged[0].median, judged.median);
    let refusal = run(LINE, true).unwrap_err().to_string();
    assert!(refusal.contains("for --other those of both vehicles"), "{refusal}");
}

#[test]
fn the_case_file_of_a_pair_has_its_numbers() {
    let pair = read(&table(&LINE.replace("20,,,", "20,,3,-26"))).unwrap().remove(0);
    let text = pair.case_text(&FITTED, &[VehicleId::Two]);
    let case = case::CaseFile::parse("pair", &text).unwrap().case;
    let [one, two] = &case.vehicles;
    let kg = |vehicle: &inputs::GivenVehicle| vehicle.mass.as_ref().unwrap().kg();
    assert!((kg(one) - 1575.0).abs() < 0.1 && (kg(two) - 1475.0).abs() < 0.1);
    // Counter-clockwise from north; the plane is that of the side, so the front has the error of both,
    // 10° √2.
    for (given, degrees) in [
        ("[vehicle1]", "heading = { value = \"0.00 deg\", sd = \"14.14 deg\" }"),
        ("[vehicle2]", "heading = \"90.00 deg\""),
    ] {
        let table = text.split(given).nth(1).unwrap().split("\n\n").next().unwrap();
        assert!(table.contains(degrees), "{table}");
    }
    // 10 cm to the right on the front, 30 cm forward on the side: the place along each face is uncertain.
    assert!(text.contains("y = { value = \"-0.100 m\", sd = \"0.250 m\" }"), "{text}");
    assert!(text.contains("x = { value = \"0.300 m\", sd = \"0.250 m\" }"), "{text}");
    // The normal points along −x.
    assert!(text.contains("crush_plane = { value = \"180.00 deg\", sd = \"10.00 deg\" }"), "{text}");
    // E = ½ ∫ (d₀ + d₁ C)² dl with d₀ = √(m₀/w₀) b₀: √1000 · 2.22 and 27.7 of a front.
    assert!(text.contains("d0 = { value = \"70.20 N^0.5\", sd = \"26.68 N^0.5\" }"), "{text}");
    assert!(text.contains("d1 = { value = \"875.95 N^0.5/m\", sd = \"157.67 N^0.5/m\" }"), "{text}");
    assert!(one.recorder.is_none());
    let recorder = two.recorder.as_ref().unwrap();
    let kmh = |stored: &Option<inputs::Quantity>| 3.6 * stored.as_ref().unwrap().si();
    assert!((kmh(&recorder.delta_v_longitudinal) - 3.0).abs() < 1e-9);
    // CISS counts to the right, the case file to the left.
    assert!((kmh(&recorder.delta_v_lateral) - 26.0).abs() < 1e-9);
    // Each plane, against each.
    for (plane, pdof) in [('F', 10), ('B', 180), ('L', 290), ('R', 70)] {
        let line = LINE.replace("1400,0,L,290,", &format!("1400,0,{plane},{pdof},"));
        let pair = read(&table(&line)).unwrap().remove(0);
        let text = pair.case_text(&FITTED, &[]);
        case::CaseFile::parse("pair", &text).unwrap();
        assert!(!text.contains("recorder"));
    }
}

/// A run that is ended early reports how far it came.
#[test]
fn an_ended_judgement_says_so() {
    use field::FieldError;
    use std::ops::ControlFlow;
    let pairs = read(&format!("{HEADER}\n{LINE}\n{LINE}\n{LINE}\n")).unwrap();
    let options = Options { particles: 128, seed: 1, other: false, crush: KnownCrush::Both, injury: None };
    let until = |last: usize| {
        judge(&pairs, &FITTED, &options, &mut |done, _| {
            if done < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })
    };
    let judged = until(2).unwrap();
    assert_eq!((judged.pairs, judged.finished, judged.judged.len()), (3, 2, 2));
    assert_eq!(until(3).unwrap().finished, 3);
    assert!(matches!(until(0), Err(FieldError::Ended)));
}

/// Fronts against a pole, a wall and an animal, and a side against a tree; made up.
const OBJECTS: &str = "CASEID,OBJCONT,CURBWT,CARGOWT,CDCPLANE,PDOF,HEADINGANG,FIELDL,DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,DVTOTAL,DVLONG,MAXDVLONG,MAXDVLAT
1,51,1500,,F,,,120,150,-20,30,30,30,30,30,30,30,-29,-40,
2,58.0,1500,,F,10,,150,150,0,30,30,30,30,30,30,,,-30,40
3,42,1500,,L,270,,90,90,0,9,9,9,9,9,9,,,3,30
4,76,1500,,F,0,,150,150,0,9,9,9,9,9,9,,,-7,
";

#[test]
fn fronts_that_struck_an_object_are_read() {
    let crashes = read_objects(OBJECTS).unwrap().unwrap();
    let of: Vec<_> = crashes.iter().map(|crash| (crash.case(), crash.kind(), crash.has_pdof)).collect();
    let expected = [
        ("1", PairKind::TreeOrPole, false),
        ("2", PairKind::BarrierOrWall, true),
        ("4", PairKind::OtherObject, true),
    ];
    assert_eq!(of, expected);
    // 40 km/h along; √(30² + 40²) km/h; too small to be judged.
    let truths: Vec<_> =
        crashes.iter().map(|crash| crash.truths().first().map(|of| of.1.delta_v * 3.6)).collect();
    assert!((truths[0].unwrap() - 40.0).abs() < 1e-9 && (truths[1].unwrap() - 50.0).abs() < 1e-9);
    assert_eq!(truths[2], None);
    // A table of pairs is not one of objects, with lines or without.
    assert_eq!(read_objects(&table(LINE)).unwrap(), None);
    assert_eq!(read_objects(&format!("{HEADER}\n")).unwrap(), None);
    for (from, to, said) in [
        ("1,51,", "1,pole,", "line 2, column OBJCONT: \"pole\" is not a whole number"),
        ("1,51,1500,", "1,51,,", "line 2, column CURBWT: the empty cell is not a number"),
        ("C1,", "D1,", "there is no column C1;"),
    ] {
        let error = read_objects(&OBJECTS.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    let sides: String =
        OBJECTS.lines().filter(|line| !line.contains(",F,")).map(|line| format!("{line}\n")).collect();
    assert!(read_objects(&sides).unwrap_err().to_string().contains("no line of the file has a front"));
}

/// With hardly any error but that of the speed, all crush energy is that of the speed: ½ m v² = E.
#[test]
fn an_object_takes_no_energy_and_does_not_move() {
    let objects = ObjectFigures {
        severity: Severity { median: 10.0, ln_sd: 3.0, speed: 1e3, injury: None, uniform_speeds: 0 },
        misfit: CrushMisfit { bias: 0.0, ln_sd: 0.02 },
        covariance: [[0.0; 2]; 2],
    };
    let fitted = Fitted {
        objects,
        slope_ln_sd: 1e-3,
        no_damage_speed_ln_sd: 1e-3,
        restitution: [1e-4, 0.0, 5.0, 1e-3],
        crush_plane_sd: 1e-3,
        contact_sd: 1e-3,
        mass_ln_sd: 1e-3,
        recorder_ln_scale: 0.01,
        ..FITTED
    };
    let options = Options { particles: 128, seed: 1, other: false, crush: KnownCrush::Both, injury: None };
    let crashes = read_objects(&OBJECTS.replace("150,150,0,30", "150,150,0,20")).unwrap().unwrap();
    let field = judge(&crashes, &fitted, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert!(field.objects && field.judged.len() == 2);
    // ½ m₀/w₀ w (b₀ + b₁ C)², with m₀/w₀ = 1000 kg/m, w = 1.5 m, b₀ = 2.22 m/s, b₁ = 27.7 1/s, C = 30 cm
    let root = 2.22_f64 + 27.7 * 0.3;
    let energy = 0.5 * 1000.0 * 1.5 * root * root;
    let speed = (2.0 * energy / 1575.0).sqrt();
    // The pole was struck 20 cm to the left of the middle, so that the car also turns: k = 0.295 · 4.63 m.
    let shown = field.judged[0].median;
    assert!(shown < speed && shown > 0.96 * speed, "{shown} {speed}");
    let names: Vec<_> = field.groups.iter().map(|group| group.name).collect();
    assert_eq!(names, ["all", "tree-pole", "barrier-wall"]);
    // WinSMASH's 29 km/h along the vehicle.
    assert!((field.judged[0].winsmash.unwrap() - 29.0 / 3.6).abs() < 1e-12);
    // More energy than the impulse took, by the bias: ΔV falls by half of it.
    let biased = Fitted {
        objects: ObjectFigures { misfit: CrushMisfit { bias: 0.5, ln_sd: 0.02 }, ..objects },
        ..fitted
    };
    let lower = judge(&crashes, &biased, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert!((ln(lower.judged[0].median / shown) + 0.25).abs() < 0.01);
}

/// NHTSA numbers the crashes of all years in one row, which a table need not do.
#[test]
fn two_years_with_the_same_number_are_two_crashes() {
    let with = |years: [&str; 2]| {
        let [one, two] = years.map(|year| format!("{year},{LINE}"));
        let pairs = read(&format!("YEAR,{HEADER}\n{one}\n{two}\n")).unwrap();
        pairs.into_iter().map(|pair| pair.case).collect::<Vec<_>>()
    };
    assert_eq!(with(["2017", "2018"]), ["17 of 2017", "17 of 2018"]);
    assert_eq!(with(["2017", "2017"]), ["17", "17"]);
}
