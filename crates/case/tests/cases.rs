//! Reading, writing back, and surviving arbitrary files.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use std::fs;
use std::path::Path;

use case::{
    After, Amount, Axes, Before, Bounds, Case, CaseFile, CaseProblem, CollisionData, ContactPoint, Crush,
    CrushEvidence, Diagnostics, Dimension, Drag, EdgeSide, Faults, Find, Fit, GivenEes, GivenImpact,
    GivenPhase, GivenRest, GivenSteer, GivenTest, GivenVehicle, Grade, ImpactLaw, KnownEnergy, LeftOut,
    MarkedWheel, Mass, Outline, PathPoint, Pdof, PhaseForm, Place, Program, Quantity, Reconstruct,
    ReportHead, RestHeading, Restitution, Skid, SkidBegin, Spread, SteerPoint, StiffnessForm, StiffnessLine,
    Surface, SurfaceRegion, SurfaceZone, Text, TypicalStiffness, Unit, UnitSystem, VehicleKind, Velocity,
    WheelDrag, YawInertia, read_quantity, to_toml,
};
use crash3::ObliqueCorrection;
use crash3::Side;
use inputs::{
    Basis, BrachTangential, CertainSpeed, Fault, FaultKind, GivenEstimate, Recorder, SeverityPrior,
};
use pim_core::VehicleId;
use pim_core::{Law, Tangential};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{Index, select};

fn fixtures() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

fn paper() -> String {
    fs::read_to_string(fixtures().join("sae-980025.toml")).unwrap()
}

fn uncertain() -> String {
    fs::read_to_string(fixtures().join("sae-980025-uncertain.toml")).unwrap()
}

#[track_caller]
fn read(text: &str) -> CaseFile {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn quantity(text: &str, dimension: Dimension) -> Quantity {
    read_quantity(text, dimension).unwrap()
}

/// The problems of a text that has to be refused.
#[track_caller]
fn problems(text: &str) -> Vec<CaseProblem> {
    let errors = CaseFile::parse("case.toml", text).expect_err("the case is accepted");
    errors.list().iter().map(|diagnostic| diagnostic.problem().clone()).collect()
}

fn messages(text: &str) -> Vec<String> {
    problems(text).iter().map(ToString::to_string).collect()
}

/// The faults that prevent the reconstruction of a case, in its file.
fn faults(text: &str) -> Diagnostics {
    let file = read(text);
    let faults = file.case.reconstruction().unwrap_err();
    file.diagnostics(&faults, &Program::NONE)
}

/// The crate contains a copy, as a package has no files from outside of it. The path to the schema leads
/// nowhere there.
#[test]
fn the_example_of_the_crate_is_that_of_the_fixtures() {
    let (schema, rest) =
        paper().split_once('\n').map(|(line, rest)| (line.to_owned(), rest.to_owned())).unwrap();
    assert_eq!(schema, "#:schema ../docs/case.schema.json");
    assert!(
        case::EXAMPLE == rest,
        "crates/case/sae-980025.toml is not fixtures/sae-980025.toml without its first line"
    );
}

/// SAE 980025, appendix: the paper prints metric values beside some of its own.
#[test]
fn the_papers_example_is_read() {
    let case = read(&paper()).case;
    let [jimmy, altima] = &case.vehicles;
    assert_eq!(jimmy.name, Some("1994 GMC Jimmy".into()));
    // 3696 lb and 3413 lb, with NIST SP 811's exact pound of 0.453 592 37 kg.
    assert!((jimmy.mass.unwrap().kg() - 3696.0 * 0.453_592_37).abs() < 1e-9);
    assert!((altima.mass.unwrap().kg() - 3413.0 * 0.453_592_37).abs() < 1e-9);
    let Some(YawInertia::Inertia(inertia)) = jimmy.yaw else { panic!("{:?}", jimmy.yaw) };
    // SP 811: 1 ft·lbf = 1.355 818 J.
    assert!((inertia.si() / (2437.0 * 1.355_818) - 1.0).abs() < 5e-7);
    assert_eq!(jimmy.motion, None);
    let Some(Velocity::Speed(speed)) = altima.motion else { panic!("{:?}", altima.motion) };
    assert!((speed.si() - 4.4704).abs() < 1e-12);
    let crush = [jimmy.crush.as_ref().unwrap(), altima.crush.as_ref().unwrap()];
    assert_eq!([crush[0].side, crush[1].side], [Side::Front, Side::Right]);
    // "Crush Width: Veh 1, 1.65 m (65 in); Veh 2, 2.13 m (84 in)"
    for (crush, printed) in crush.iter().zip([1.65, 2.13]) {
        assert!((crush.width.unwrap().si() - printed).abs() < 0.005);
        assert_eq!(crush.depths.len(), 6);
    }
    // "A = 587.4 N/cm, B = 63.3 N/cm²; A = 339.3 N/cm, B = 28.8 N/cm²" beside d_0 and d_1: A = d_0 d_1, B =
    // d_1².
    for (crush, [a, b]) in crush.iter().zip([[587.4e2, 63.3e4], [339.3e2, 28.8e4]]) {
        let StiffnessForm::Line(StiffnessLine::Root { d0, d1, g: None, limit: None }) = crush.stiffness
        else {
            panic!("{:?}", crush.stiffness)
        };
        assert!((d0.si() * d1.si() / a - 1.0).abs() < 2e-3, "A {} against {a}", d0.si() * d1.si());
        assert!((d1.si() * d1.si() / b - 1.0).abs() < 2e-3, "B {} against {b}", d1.si() * d1.si());
    }
    let impact = case.impact.as_ref().unwrap();
    let law = ImpactLaw::Brach {
        restitution: Restitution::Constant(0.3),
        tangential: BrachTangential::Critical,
        moment_restitution: None,
    };
    assert_eq!(impact.law, law);
    assert!((impact.crush_plane.si() + 23.0 * std::f64::consts::PI / 180.0).abs() < 1e-15);
    let wanted = Reconstruct { find: Find::One(VehicleId::One), energy_basis: Basis::Dissipated };
    assert_eq!(case.reconstruct, Some(wanted));
    assert_eq!(case.unit_system(), UnitSystem::Us);
}

/// Every form that the paper's example does not use.
const OTHER_FORMS: &str = r#"
[vehicle1]
mass = "1500 kg"
yaw_radius = "1.4 m"
heading = "0 rad"
velocity = { x = "-20 m/s", y = "1.5 m/s" }
yaw_rate = "-5 deg/s"
contact = { x = "1.78 m", y = "-0.73 m" }
length = "4.5 m"
width = "1.75 m"
cg_to_front = "2 m"
[vehicle1.crush]
side = "left"
spacing = ["10 cm", "0.2 m"]
depths = ["0 cm", "100 mm", "0.1 m"]
stiffness = { A = "587 N/cm", B = "0 N/cm^2", G = "2.5 kN" }
offset = "-30 cm"
pdof = "-90 deg"
oblique_angle = "-20 deg"
moment_arm = "0 m"
oblique = "none"
[vehicle2]
fixed = true
heading = "90 deg"
[impact]
crush_plane = "0 deg"
restitution = 0
tangential = { friction = 0.5 }
[reconstruct]
find = "vehicle1.speed"
energy_basis = "absorbed"
"#;

/// A restitution that depends on the closing speed, in US units.
const CURVE: &str =
    "restitution = { speeds = \"5 11 22 mph\", values = [0.3, 0.2, 0.12] }\ntangential = \"critical\"";

#[test]
fn the_other_forms_are_read() {
    let case = read(OTHER_FORMS).case;
    let length = |text| quantity(text, Dimension::Length);
    let speed = |text| quantity(text, Dimension::Speed);
    let angle = |text| quantity(text, Dimension::Angle);
    let vehicle = GivenVehicle {
        name: None,
        fixed: false,
        kind: None,
        mass: Some(Mass::Mass(quantity("1500 kg", Dimension::Mass))),
        yaw: Some(YawInertia::Radius(length("1.4 m"))),
        class: None,
        model_year: None,
        wheelbase: None,
        track: None,
        cg_to_front_axle: None,
        length: None,
        heading: Some(angle("0 rad")),
        contact: Some(ContactPoint::Cartesian { x: length("1.78 m"), y: length("-0.73 m") }),
        sideslip: None,
        position: None,
        motion: Some(Velocity::Vector { x: speed("-20 m/s"), y: speed("1.5 m/s") }),
        yaw_rate: Some(quantity("-5 deg/s", Dimension::YawRate)),
        outline: Some(Outline {
            length: length("4.5 m"),
            width: length("1.75 m"),
            cg_to_front: length("2 m"),
        }),
        deformation_energy: None,
        diameter: None,
        energy: None,
        crush: Some(Crush {
            side: Side::Left,
            from_force_balance: false,
            width: None,
            depths: vec![length("0 cm"), length("100 mm"), length("0.1 m")],
            spacing: Some(vec![length("10 cm"), length("0.2 m")]),
            stiffness: StiffnessForm::Line(StiffnessLine::Crush {
                a: quantity("587 N/cm", Dimension::StiffnessA),
                b: quantity("0 N/cm^2", Dimension::StiffnessB),
                g: Some(quantity("2.5 kN", Dimension::StiffnessG)),
                limit: None,
            }),
            offset: Some(length("-30 cm")),
            pdof: Some(Pdof::Angle(angle("-90 deg"))),
            oblique_angle: Some(angle("-20 deg")),
            moment_arm: Some(length("0 m")),
            oblique: Some(ObliqueCorrection::None),
        }),
        before: None,
        after: None,
        recorder: None,
        certain_speed: None,
    };
    let wall = GivenVehicle { fixed: true, heading: Some(angle("90 deg")), ..GivenVehicle::default() };
    let expected = Case {
        title: None,
        source: None,
        report: ReportHead::default(),
        axes: Axes::ZUp,
        vehicles: [vehicle, wall],
        impact: Some(GivenImpact {
            crush_plane: angle("0 deg"),
            law: ImpactLaw::Brach {
                restitution: Restitution::Constant(0.0),
                tangential: BrachTangential::Friction(0.5),
                moment_restitution: None,
            },
        }),
        reconstruct: Some(Reconstruct { find: Find::One(VehicleId::One), energy_basis: Basis::Absorbed }),
        ranges: Vec::new(),
        left_out: LeftOut { axes: true, law: true, energy_basis: false, fit: [false; 2] },
        ..Case::default()
    };
    assert_eq!(case, expected);
    assert_eq!(case.unit_system(), UnitSystem::Si);
}

/// Every form of a range, at a number of every kind of place.
const RANGES: &str = r#"
[vehicle1]
mass = { value = "1500 kg", sd = "50 lb" }
yaw_radius = { low = "1.3 m", mode = "1.4 m", high = "150 cm" }
heading = { low = "0 rad", high = "90 deg" }
velocity = { x = { value = "-20 m/s", within = "5 %", confidence = 0.9 }, y = "1.5 m/s" }
contact = { x = "1.78 m", y = { value = "-0.73 m", sd = "0.1 m" } }
[vehicle1.crush]
side = "left"
spacing = { values = "10 20 cm", sd = "1 cm" }
depths = [{ low = "1 cm", high = "3 cm" }, "4 cm", { value = "0 cm", sd = "5 mm" }]
stiffness = { zones = [{ A = "587 N/cm", B = { value = "63.3 N/cm^2", sd = "5 N/cm^2" } }, { A = "400 N/cm", B = "50 N/cm^2" }] }
oblique_angle = { value = "-20 deg", sd = "5 deg" }
oblique = { friction = { value = 0.5, sd = 0.1 } }
[vehicle2]
mass = "1400 kg"
[vehicle2.crush]
side = "front"
width = "1.5 m"
depths = { values = ["10 cm", "0.2 m"], within = "10 %", confidence = 0.5 }
stiffness = { test = { mass = "1500 kg", speed = { value = "56 km/h", sd = "1 km/h" }, width = "1.6 m", depths = { values = "42 50 cm", sd = "2 cm" }, no_damage_speed = "8 km/h" } }
[impact]
crush_plane = "0 deg"
restitution = { speeds = "2 5 m/s", values = [{ low = 0.2, high = 0.4 }, 0.2] }
tangential = { fraction = { low = 0.8, mode = 1.0, high = 1.0 } }
"#;

/// The data of the file on each uncertain number: its path, central value (in the unit written) and spread.
#[test]
fn ranges_are_read_beside_the_central_values() {
    use Dimension::{Angle, Length, Mass, Speed};
    let case = read(RANGES).case;
    let of = |number, unit: Option<&'static Unit>| Amount { number, unit };
    let quantity = |number, dimension: Dimension, unit: &str| of(number, Some(dimension.unit(unit).unwrap()));
    let metres = |number, unit| quantity(number, Length, unit);
    let normal = |sd| Spread::Normal { sd };
    let uniform = |low, high| Spread::Uniform { low, high };
    let b = |number| quantity(number, Dimension::StiffnessB, "N/cm^2");
    let within = Spread::Within { percent: 10.0, confidence: 0.5 };
    let third = Spread::Within { percent: 5.0, confidence: 0.9 };
    // The middle of 0 rad and 90° is π/4 rad, in the unit of the low end.
    let eighth = std::f64::consts::FRAC_PI_4;
    let crush = "vehicle1.crush";
    let test = "vehicle2.crush.stiffness.test";
    let expected = [
        ("vehicle1.mass".to_owned(), 1500.0, normal(quantity(50.0, Mass, "lb")), Bounds::Positive),
        (
            "vehicle1.yaw_radius".to_owned(),
            1.4,
            Spread::Triangular { low: metres(1.3, "m"), high: metres(150.0, "cm") },
            Bounds::Positive,
        ),
        (
            "vehicle1.heading".to_owned(),
            eighth,
            uniform(quantity(0.0, Angle, "rad"), quantity(90.0, Angle, "deg")),
            Bounds::None,
        ),
        ("vehicle1.contact.y".to_owned(), -0.73, normal(metres(0.1, "m")), Bounds::None),
        ("vehicle1.velocity.x".to_owned(), -20.0, third, Bounds::None),
        (
            format!("{crush}.depths[1]"),
            2.0,
            uniform(metres(1.0, "cm"), metres(3.0, "cm")),
            Bounds::NotNegative,
        ),
        (format!("{crush}.depths[3]"), 0.0, normal(metres(5.0, "mm")), Bounds::NotNegative),
        (format!("{crush}.spacing[1]"), 10.0, normal(metres(1.0, "cm")), Bounds::Positive),
        (format!("{crush}.spacing[2]"), 20.0, normal(metres(1.0, "cm")), Bounds::Positive),
        (format!("{crush}.stiffness.zones[1].B"), 63.3, normal(b(5.0)), Bounds::Positive),
        (format!("{crush}.oblique_angle"), -20.0, normal(quantity(5.0, Angle, "deg")), Bounds::Acute),
        (format!("{crush}.oblique.friction"), 0.5, normal(of(0.1, None)), Bounds::NotNegative),
        ("vehicle2.crush.depths[1]".to_owned(), 10.0, within, Bounds::NotNegative),
        ("vehicle2.crush.depths[2]".to_owned(), 0.2, within, Bounds::NotNegative),
        (format!("{test}.speed"), 56.0, normal(quantity(1.0, Speed, "km/h")), Bounds::Positive),
        (format!("{test}.depths[1]"), 42.0, normal(metres(2.0, "cm")), Bounds::NotNegative),
        (format!("{test}.depths[2]"), 50.0, normal(metres(2.0, "cm")), Bounds::NotNegative),
        (
            "impact.restitution.values[1]".to_owned(),
            0.3,
            uniform(of(0.2, None), of(0.4, None)),
            Bounds::BelowOne,
        ),
        (
            "impact.tangential.fraction".to_owned(),
            1.0,
            Spread::Triangular { low: of(0.8, None), high: of(1.0, None) },
            Bounds::Share,
        ),
    ];
    let inputs = case.inputs();
    let read: Vec<_> = case
        .ranges
        .iter()
        .map(|range| {
            let input = inputs.iter().find(|input| input.path == range.path).unwrap();
            (range.path.clone(), input.number, range.spread, range.bounds)
        })
        .collect();
    assert_eq!(read.len(), expected.len());
    for ((path, number, spread, bounds), expected) in read.into_iter().zip(expected) {
        assert!((number - expected.1).abs() < 1e-15, "{path} {number}");
        assert_eq!((path, spread, bounds), (expected.0, expected.2, expected.3));
    }
}

#[test]
fn ranges_are_written_back() {
    for text in [RANGES.to_owned(), uncertain()] {
        let case = read(&text).case;
        let written = to_toml(&case);
        assert_eq!(read(&written).case, case, "{written}");
    }
    let written = to_toml(&read(&uncertain()).case);
    assert!(
        written.contains("{ values = \"21.3 20.3 13.8 11.3 5.3 4.8 in\", sd = \"0.5 in\" }"),
        "{written}"
    );
}

/// Ranges do not move the central values, which are all that the other commands use.
#[test]
fn the_uncertain_example_is_the_papers_at_its_centre() {
    let uncertain = read(&uncertain()).case;
    let numbers =
        |case: &Case| case.inputs().iter().map(|input| (input.path.clone(), input.si())).collect::<Vec<_>>();
    let paper = read(&paper()).case;
    assert_eq!(uncertain.ranges.len(), 31);
    let all: Vec<String> = uncertain.inputs().into_iter().map(|input| input.path).collect();
    assert!(uncertain.ranges.iter().map(|range| &range.path).eq(&all));
    for ((path, value), (wanted, of_paper)) in numbers(&uncertain).into_iter().zip(numbers(&paper)) {
        assert_eq!(path, wanted);
        assert_eq!(value, of_paper, "{path}");
    }
}

#[test]
fn bounds_are_those_of_physics() {
    let metre = Dimension::Length.unit("m");
    let degree = Dimension::Angle.unit("deg");
    assert_eq!(Bounds::None.interval(metre), [f64::NEG_INFINITY, f64::INFINITY]);
    assert_eq!(Bounds::NotNegative.interval(metre), [0.0, f64::INFINITY]);
    let [least, most] = Bounds::Positive.interval(metre);
    assert!(0.0 < least && least <= 1e-6 && most.is_infinite());
    let [zero, below_one] = Bounds::BelowOne.interval(None);
    assert!(zero == 0.0 && (0.999..1.0).contains(&below_one));
    let [left, right] = Bounds::Acute.interval(degree);
    assert!(left == -right && (89.999..90.0).contains(&right));
    assert_eq!(Bounds::Coefficient.interval(None), [-1.0, 1.0]);
}

/// The paper's example with other lines in `[impact]`.
fn with_impact(lines: &str) -> String {
    let paper = paper();
    let (before, after) = paper.split_once("[impact]").unwrap();
    let (_, after) = after.split_once("[reconstruct]").unwrap();
    format!("{before}[impact]\ncrush_plane = \"-23 deg\"\n{lines}\n[reconstruct]{after}")
}

/// Each law of a file, the law of the mechanics that it means, and how it is written back.
#[test]
fn the_laws_are_read_passed_on_and_written() {
    let metres_per_second = |text| quantity(text, Dimension::Speed);
    let e = Restitution::Constant(0.3);
    let brach = |moment_restitution| ImpactLaw::Brach {
        restitution: e.clone(),
        tangential: BrachTangential::Ratio(0.2),
        moment_restitution,
    };
    let plain = Law::new(0.3, Tangential::Ratio(0.2)).unwrap();
    let cases = [
        ("restitution = 0.3\ntangential  = { ratio = 0.2 }", "brach", brach(None), plain),
        (
            "restitution        = 0.3\ntangential         = { ratio = 0.2 }\nmoment_restitution = -0.8",
            "brach",
            brach(Some(-0.8)),
            plain.with_moment_restitution(-0.8).unwrap(),
        ),
        (
            "law         = \"woolley\"",
            "woolley",
            ImpactLaw::Woolley { tangential_velocity_change: None },
            Law::new(0.0, Tangential::Critical).unwrap(),
        ),
        (
            "law                        = \"woolley\"\ntangential_velocity_change = \"-36 km/h\"",
            "woolley",
            ImpactLaw::Woolley { tangential_velocity_change: Some(metres_per_second("-36 km/h")) },
            Law::new(0.0, Tangential::VelocityChange(-10.0)).unwrap(),
        ),
        (
            "law                    = \"ishikawa\"\nrestitution            = 0.3\ntangential_restitution = -0.2",
            "ishikawa",
            ImpactLaw::Ishikawa { restitution: e.clone(), tangential_restitution: -0.2 },
            Law::new(0.3, Tangential::Restitution(-0.2)).unwrap(),
        ),
        (
            "law         = \"kudlich-slibar\"\nrestitution = 0.3\nfriction    = 0.5",
            "kudlich-slibar",
            ImpactLaw::KudlichSlibar { restitution: e.clone(), friction: 0.5 },
            Law::new(0.3, Tangential::FullOrSliding(0.5)).unwrap(),
        ),
    ];
    for (lines, name, read_as, law) in cases {
        let file = read(&with_impact(lines));
        let impact = file.case.impact.clone().unwrap();
        assert_eq!(impact.law, read_as, "{lines}");
        assert_eq!(impact.law.name(), name);
        let collision = file.case.reconstruction().unwrap().collision;
        assert_eq!(collision.law.curve(), None);
        let [wanted, found] = [law, collision.law.nominal()];
        assert_eq!(found.restitution(), wanted.restitution(), "{lines}");
        assert_eq!(found.moment_restitution(), wanted.moment_restitution(), "{lines}");
        match (found.tangential(), wanted.tangential()) {
            (Tangential::VelocityChange(found), Tangential::VelocityChange(wanted)) => {
                assert!((found - wanted).abs() < 1e-12, "{found}");
            }
            (found, wanted) => assert_eq!(found, wanted, "{lines}"),
        }
        // The equals signs are aligned, also those of the keys above.
        let written = to_toml(&file.case);
        assert!(written.contains(&format!("{lines}\n\n[reconstruct]")), "{written}");
    }
}

#[test]
fn the_brach_law_may_be_named() {
    let named = read(&with_impact("law = \"brach\"\nrestitution = 0.3\ntangential = \"critical\""));
    let mut unnamed = read(&paper()).case;
    assert!(unnamed.left_out.law);
    unnamed.left_out.law = false;
    assert_eq!(named.case, unnamed);
}

#[test]
fn a_curve_of_restitution_is_read_passed_on_and_written() {
    let speed = |text| quantity(text, Dimension::Speed);
    let lines = |speeds: &str| {
        format!("restitution = {{ speeds = {speeds}, values = [0.3, 0, 1] }}\ntangential  = \"critical\"")
    };
    for (written, speeds) in [
        ("\"0 18 72 km/h\"", ["0 km/h", "18 km/h", "72 km/h"]),
        ("[\"0 m/s\", \"18 km/h\", \"20 m/s\"]", ["0 m/s", "18 km/h", "20 m/s"]),
    ] {
        let file = read(&with_impact(&lines(written)));
        let curve =
            Restitution::OfClosingSpeed { speeds: speeds.map(speed).to_vec(), values: vec![0.3, 0.0, 1.0] };
        let impact = file.case.impact.clone().unwrap();
        assert_eq!(impact.law.restitution(), Some(&curve));
        assert!(to_toml(&file.case).contains(&lines(written)), "{}", to_toml(&file.case));

        let collision = file.case.reconstruction().unwrap().collision;
        assert_eq!(collision.law.nominal().restitution(), 0.3, "that of the first point");
        let curve = collision.law.curve().unwrap();
        // By hand: 0.3 at 0 m/s, 0 at 5 m/s, 1 at 20 m/s, and halfway between them.
        for (at, e) in [(0.0, 0.3), (2.5, 0.15), (5.0, 0.0), (12.5, 0.5), (20.0, 1.0), (30.0, 1.0)] {
            assert!((curve.at(at) - e).abs() < 1e-12, "{at} m/s: {}", curve.at(at));
        }
    }
}

/// An answer without any number would look like one without any warning.
#[test]
fn damage_that_no_vehicle_has_is_missing() {
    for text in ["[vehicle1]\n[vehicle2]\n", "[vehicle1]\nmass = \"1500 kg\"\n[vehicle2]\nfixed = true\n"] {
        let missing = read(text).case.damage().unwrap_err().to_string();
        assert!(missing.contains("vehicle1.crush"), "{missing}");
    }
}

/// For the damage alone, e is required only if it is one number.
#[test]
fn crush_alone_has_the_restitution_of_the_law() {
    let text = fs::read_to_string(fixtures().join("sae-980025-crush.toml")).unwrap();
    let text = text.split("[impact]").next().unwrap();
    let restitution = |lines: &str| {
        let text = format!("{text}\n[impact]\ncrush_plane = \"-23 deg\"\n{lines}");
        read(&text).case.damage().unwrap().restitution
    };
    assert_eq!(restitution("restitution = 0.2\ntangential = \"critical\""), Some(0.2));
    assert_eq!(restitution("law = \"kudlich-slibar\"\nrestitution = 0.2\nfriction = 1"), Some(0.2));
    assert_eq!(restitution("law = \"woolley\""), Some(0.0));
    let curve = "restitution = { speeds = \"2 m/s\", values = [0.2] }\ntangential = \"critical\"";
    assert_eq!(restitution(curve), None);
    assert_eq!(read(text).case.damage().unwrap().restitution, None);
}

/// Every key of `[impact]` under every law: accepted if the law uses it, and reported as missing if the law
/// needs it.
#[test]
fn each_law_has_its_own_keys() {
    let keys = [
        ("restitution", "0.3"),
        ("tangential", "\"critical\""),
        ("moment_restitution", "-0.5"),
        ("tangential_velocity_change", "\"5 m/s\""),
        ("tangential_restitution", "0.1"),
        ("friction", "0.5"),
    ];
    let laws = [
        ("brach", &["restitution", "tangential"][..], &["moment_restitution"][..]),
        ("woolley", &[], &["tangential_velocity_change"]),
        ("ishikawa", &["restitution", "tangential_restitution"], &[]),
        ("kudlich-slibar", &["restitution", "friction"], &[]),
    ];
    for (law, needed, optional) in laws {
        let with = |wanted: &dyn Fn(&str) -> bool| {
            let lines = keys.iter().filter(|(key, _)| wanted(key));
            let lines: String = lines.map(|(key, value)| format!("{key} = {value}\n")).collect();
            with_impact(&format!("law = \"{law}\"\n{lines}"))
        };
        read(&with(&|key| needed.contains(&key)));
        for (tried, _) in keys {
            let uses = needed.contains(&tried) || optional.contains(&tried);
            let added = with(&|key| needed.contains(&key) || key == tried);
            if uses {
                read(&added);
            } else {
                let found = problems(&added);
                let owners: Vec<&str> = laws
                    .iter()
                    .filter(|(_, needed, optional)| needed.contains(&tried) || optional.contains(&tried))
                    .map(|(law, ..)| *law)
                    .collect();
                assert!(
                    matches!(&found[..], [CaseProblem::KeyOfOtherLaw { key, law: named, owners: named_owners, .. }]
                        if (*key, *named) == (tried, law) && *named_owners == owners),
                    "{tried} under {law}: {found:?}"
                );
            }
            if needed.contains(&tried) {
                let found = problems(&with(&|key| needed.contains(&key) && key != tried));
                assert!(
                    matches!(&found[..], [CaseProblem::MissingKeyOfLaw { key, law: named, .. }]
                        if (*key, *named) == (tried, law)),
                    "{law} without {tried}: {found:?}"
                );
            }
        }
    }
}

#[test]
fn the_limits_of_the_laws_are_accepted() {
    let read_with = |lines: &str, value: &str| {
        let text = with_impact(&lines.replace("VALUE", value));
        CaseFile::parse("case.toml", &text).map(|_| ()).map_err(|errors| errors.to_string())
    };
    let signed = [
        "law = \"ishikawa\"\nrestitution = 0\ntangential_restitution = VALUE",
        "restitution = 0\ntangential = \"critical\"\nmoment_restitution = VALUE",
    ];
    for lines in signed {
        for value in ["-1", "0", "1.0"] {
            assert_eq!(read_with(lines, value), Ok(()));
        }
        for value in ["-1.001", "1.001", "nan", "inf"] {
            assert!(read_with(lines, value).is_err(), "{lines} {value}");
        }
    }
    let friction = "law = \"kudlich-slibar\"\nrestitution = 0\nfriction = VALUE";
    assert_eq!(read_with(friction, "0"), Ok(()));
    for value in ["-0.001", "inf", "nan"] {
        assert!(read_with(friction, value).is_err(), "{value}");
    }
    let curve = "restitution = { speeds = \"0 1 m/s\", values = [VALUE] }\ntangential = \"critical\"";
    assert_eq!(read_with(curve, "0, 1"), Ok(()));
    for value in ["0.5, 1.001", "-0.001, 0.5", "nan, 0.5", "0x1, 0", "0.5", "0.5, 0.5, 0.5", ""] {
        assert!(read_with(curve, value).is_err(), "{value}");
    }
}

/// In either form of the list, and whatever the units.
#[test]
fn closing_speeds_out_of_order_are_pointed_at() {
    for (speeds, wrong) in [
        ("\"2 5 4 6 m/s\"", "4"),
        ("\"2 5 5 6 m/s\"", "5"),
        ("[\"2 m/s\", \"5 m/s\", \"10 km/h\", \"6 m/s\"]", "\"10 km/h\""),
    ] {
        let lines = format!(
            "restitution = {{ speeds = {speeds}, values = [0.1, 0.1, 0.1, 0.1] }}\ntangential = \"critical\""
        );
        let text = with_impact(&lines);
        let errors = CaseFile::parse("case.toml", &text).unwrap_err();
        let [diagnostic] = errors.list() else { panic!("{errors}") };
        assert!(matches!(diagnostic.problem(), CaseProblem::NotAscending { .. }), "{errors}");
        assert_eq!(&text[diagnostic.span().unwrap()], wrong);
    }
}

/// The case files of other laws than the paper's have an answer: a speed at which the normal impulse does the
/// work of the crush.
#[test]
fn the_fixtures_of_the_laws_can_be_reconstructed() {
    let mut names = Vec::new();
    for entry in fs::read_dir(fixtures().join("laws")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let input = read(&fs::read_to_string(&path).unwrap()).case.reconstruction().unwrap();
        let CollisionData { contact, law, motions, vehicles } = input.collision;
        let crush = vehicles.map(|vehicle| {
            let damage = vehicle.damage.unwrap();
            let CrushEvidence::Measured { profile, structure } = damage.evidence else { panic!("{name}") };
            structure.crush_energy(&profile).unwrap()
        });
        let crush_energy: f64 = crush.iter().sum();
        let (unknown, basis, tangential_share) =
            (input.unknown, input.basis.energy(), input.basis.tangential_share());
        let problem =
            reconcile::Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share };
        let answer = problem.solve().unwrap_or_else(|error| panic!("{name}: {error}"));
        // The paper's crush energy, 1.41e5 N·m.
        let work = answer.outcome.energy.normal_work;
        assert!((work / 1.41e5 - 1.0).abs() < 0.005, "{name}: {work}");
        names.push(name);
    }
    names.sort();
    let wanted =
        ["ishikawa", "kudlich-slibar", "moment", "restitution-curve", "woolley", "woolley-sideswipe"];
    assert_eq!(names, wanted);
}

#[test]
fn a_tie_of_units_is_si() {
    let text =
        "[vehicle1]\nmass = \"1 kg\"\nheading = \"1 deg\"\n[vehicle2]\nmass = \"1 lb\"\nyaw_rate = \"1 rpm\"";
    assert_eq!(read(text).case.unit_system(), UnitSystem::Si);
    assert_eq!(read(&text.replace("1 kg", "1 slug")).case.unit_system(), UnitSystem::Us);
    // The speeds of an impact law count as well.
    let with =
        |lines: &str| read(&format!("{text}\n[impact]\ncrush_plane = \"0 deg\"\n{lines}")).case.unit_system();
    assert_eq!(with("law = \"woolley\"\ntangential_velocity_change = \"5 mph\""), UnitSystem::Us);
    assert_eq!(with(CURVE), UnitSystem::Us);
}

#[test]
fn the_layout_is_the_documented_one() {
    let case = read(&paper()).case;
    let expected = r#"title  = "Intersection collision, GMC Jimmy and Nissan Altima"
source = "SAE 980025, appendix"

[vehicle1]
name        = "1994 GMC Jimmy"
weight      = "3696 lb"
yaw_inertia = "2437 lb ft s^2"
heading     = "180 deg"
contact     = { distance = "6.3 ft", angle = "-22.4 deg" }

[vehicle1.crush]
side      = "front"
width     = "65 in"
depths    = "21.3 20.3 13.8 11.3 5.3 4.8 in"
stiffness = { d0 = "35 lb^0.5", d1 = "115 lb^0.5/ft" }

[vehicle2]
name        = "1995 Nissan Altima"
weight      = "3413 lb"
yaw_inertia = "2165 lb ft s^2"
heading     = "67 deg"
speed       = "10 mph"
contact     = { distance = "3.8 ft", angle = "-39 deg" }

[vehicle2.crush]
side      = "right"
width     = "84 in"
depths    = "3 15.8 13.5 6.7 3.3 5 in"
stiffness = { d0 = "30 lb^0.5", d1 = "77.5 lb^0.5/ft" }

[impact]
crush_plane = "-23 deg"
restitution = 0.3
tangential  = "critical"

[reconstruct]
find         = "vehicle1.speed"
energy_basis = "dissipated"
"#;
    assert_eq!(to_toml(&case), expected);
}

#[test]
fn every_valid_fixture_is_read_and_written_back() {
    let mut read_files = 0;
    let folders = ["", "laws", "no-answer", "ricsac", "roots"].map(|folder| fixtures().join(folder));
    for entry in folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        // The printed results of the RICSAC collisions are not a case.
        if path.extension().is_some_and(|extension| extension == "toml") && !path.ends_with("published.toml")
        {
            let case = read(&fs::read_to_string(&path).unwrap()).case;
            assert_eq!(read(&to_toml(&case)).case, case, "{}", path.display());
            read_files += 1;
        }
    }
    assert!(read_files >= 30, "only {read_files} cases were found");
    for text in [OTHER_FORMS.to_owned(), with_impact(CURVE)] {
        let case = read(&text).case;
        assert_eq!(read(&to_toml(&case)).case, case);
    }
}

#[test]
fn the_limits_themselves_are_accepted() {
    let with = |old: &str, new: &str| {
        assert!(OTHER_FORMS.contains(old), "{old}");
        CaseFile::parse("case.toml", &OTHER_FORMS.replace(old, new))
    };
    let accepted = |old, new| with(old, new).map(|_| ()).map_err(|errors| errors.to_string());
    let refused = |old, new| with(old, new).is_err();
    assert_eq!(accepted("restitution = 0\n", "restitution = 1\n"), Ok(()));
    assert!(refused("restitution = 0\n", "restitution = -0.001\n"));
    assert_eq!(accepted("{ friction = 0.5 }", "{ fraction = 1.0 }"), Ok(()));
    assert!(refused("{ friction = 0.5 }", "{ fraction = 1.001 }"));
    assert_eq!(accepted("{ friction = 0.5 }", "{ ratio = -3 }"), Ok(()));
    assert!(refused("{ friction = 0.5 }", "{ ratio = inf }"));
    assert!(refused("{ friction = 0.5 }", "{ friction = inf }"));
    assert_eq!(accepted("\"-20 deg\"", "\"-89.9 deg\""), Ok(()));
    assert!(refused("\"-20 deg\"", "\"-90 deg\""));
    assert!(refused("\"-20 deg\"", "\"1.5708 rad\""));
    assert!(refused("G = \"2.5 kN\"", "G = \"-1 N\""));
    assert!(refused("B = \"0 N/cm^2\"", "B = \"-1 N/cm^2\""));
    assert!(refused("B = \"0 N/cm^2\"", "B = \"1e-300 N/cm^2\""));
    assert!(refused("A = \"587 N/cm\"", "A = \"-1 N/cm\""));
    assert!(refused("moment_arm = \"0 m\"", "moment_arm = \"-1 m\""));
    // 0.3 m of spacing: the width may differ by 0.1 %.
    assert_eq!(accepted("side = \"left\"", "side = \"left\"\nwidth = \"30.02 cm\""), Ok(()));
    assert!(refused("side = \"left\"", "side = \"left\"\nwidth = \"30.04 cm\""));
    assert!(refused("side = \"left\"", "side = \"left\"\nwidth = \"29.96 cm\""));
}

/// Every key that may not have every sign, with a line that sets it to zero.
#[test]
fn every_key_has_its_sign() {
    let vehicle = |line: &str| format!("[vehicle1]\n{line}\n[vehicle2]\n");
    let crush = |line: &str| {
        let rest = [("depths", "\"1 1 m\""), ("stiffness", "{ d0 = \"1 N^0.5\", d1 = \"1 N^0.5/m\" }")];
        let rest = rest.iter().filter(|(key, _)| !line.starts_with(key));
        let rest: String = rest.map(|(key, value)| format!("{key} = {value}\n")).collect();
        let width =
            if line.starts_with("width") || line.starts_with("spacing") { "" } else { "width = \"1 m\"\n" };
        format!("[vehicle1]\n[vehicle1.crush]\nside = \"rear\"\n{width}{rest}{line}\n[vehicle2]\n")
    };
    let impact =
        |lines: &str| format!("[vehicle1]\n[vehicle2]\n[impact]\ncrush_plane = \"1 deg\"\n{lines}\n");
    let outline = |length: &str, width: &str, front: &str| {
        vehicle(&format!("length = \"{length} m\"\nwidth = \"{width} m\"\ncg_to_front = \"{front} m\""))
    };
    let positive = [
        vehicle("mass = \"0 kg\""),
        vehicle("weight = \"0 lb\""),
        vehicle("yaw_inertia = \"0 kg m^2\""),
        vehicle("yaw_radius = \"0 m\""),
        outline("0", "2", "0.5"),
        outline("4", "0", "2"),
        outline("4", "2", "0"),
        crush("width = \"0 m\""),
        crush("spacing = \"0 m\""),
        crush("stiffness = { d0 = \"1 N^0.5\", d1 = \"0 N^0.5/m\" }"),
        crush("stiffness = { A = \"1 N/m\", B = \"0 N/m^2\" }"),
    ];
    for zero in &positive {
        assert!(matches!(problems(zero)[..], [CaseProblem::NotPositive { .. }]), "{zero}");
        read(&zero.replace("\"0 ", "\"1 "));
        assert!(
            matches!(problems(&zero.replace("\"0 ", "\"-1 "))[..], [CaseProblem::NotPositive { .. }]),
            "{zero}"
        );
        // Smaller than any limit, and still a number.
        let tiny = problems(&zero.replace("\"0 ", "\"5e-324 "));
        assert!(matches!(tiny[..], [CaseProblem::TooSmall { .. }]), "{zero}: {tiny:?}");
    }
    let not_negative = [
        vehicle("contact = { distance = \"0 m\", angle = \"1 deg\" }"),
        crush("depths = \"0 1 m\""),
        crush("moment_arm = \"0 m\""),
        crush("stiffness = { d0 = \"0 N^0.5\", d1 = \"1 N^0.5/m\" }"),
        crush("stiffness = { d0 = \"1 N^0.5\", d1 = \"1 N^0.5/m\", G = \"0 N\" }"),
        crush("stiffness = { A = \"0 N/m\", B = \"1 N/m^2\" }"),
        crush("stiffness = { A = \"1 N/m\", B = \"0 N/m^2\", G = \"1 N\" }"),
        impact("tangential = \"critical\"\nrestitution = { speeds = \"0 m/s\", values = [0.1] }"),
        impact(
            "tangential = \"critical\"\nrestitution = { speeds = [\"0 m/s\", \"2 m/s\"], values = [0.1, 0.1] }",
        ),
    ];
    for zero in &not_negative {
        read(zero);
        assert!(
            matches!(problems(&zero.replace("\"0 ", "\"-1 "))[..], [CaseProblem::Negative { .. }]),
            "{zero}"
        );
    }
    let change = impact("law = \"woolley\"\ntangential_velocity_change = \"0 m/s\"");
    for any in ["0 m/s", "-1 m/s", "1 m/s"] {
        read(&change.replace("0 m/s", any));
    }
}

#[test]
fn a_fixed_object_has_nothing_that_moves() {
    let with = |line: &str| format!("[vehicle1]\n[vehicle2]\nfixed = true\n{line}\n");
    let crush = "[vehicle2.crush]\nside = \"rear\"\nwidth = \"1 m\"\ndepths = \"1 1 m\"\n\
                 stiffness = { d0 = \"1 N^0.5\", d1 = \"1 N^0.5/m\" }";
    for (key, line) in [
        ("mass", "mass = \"1 kg\""),
        ("weight", "weight = \"1 lb\""),
        ("yaw_inertia", "yaw_inertia = \"1 kg m^2\""),
        ("yaw_radius", "yaw_radius = \"1 m\""),
        ("speed", "speed = \"0 mph\""),
        ("velocity", "velocity = { x = \"0 m/s\", y = \"0 m/s\" }"),
        ("yaw_rate", "yaw_rate = \"0 deg/s\""),
        ("crush", crush),
    ] {
        let message = format!("[vehicle2] is fixed, so it cannot give \"{key}\"");
        assert_eq!(messages(&with(line)), [message]);
        read(&with(line).replace("fixed = true", "fixed = false"));
    }
    for key in ["diameter", "deformation_energy"] {
        let line = if key == "diameter" { "diameter = \"30 cm\"" } else { "deformation_energy = \"15 kJ\"" };
        read(&with(line));
        let moves = with(line).replace("fixed = true", "fixed = false");
        assert_eq!(messages(&moves), [format!("[vehicle2] gives \"{key}\", which only a fixed object has")]);
    }
    read(&with("name = \"wall\"\nheading = \"90 deg\"\ncontact = { x = \"0 m\", y = \"0 m\" }"));
}

#[test]
fn a_profile_has_two_to_ten_thousand_stations() {
    let with = |depths: String| {
        let text = OTHER_FORMS.replace("spacing = [\"10 cm\", \"0.2 m\"]", "width = \"1 m\"");
        text.replace("[\"0 cm\", \"100 mm\", \"0.1 m\"]", &depths)
    };
    let string = |count: usize| with(format!("\"{} cm\"", vec!["1"; count].join(" ")));
    let list = |count: usize| with(format!("[{}]", vec!["\"1 cm\""; count].join(", ")));
    for count in [2, 10_000] {
        for text in [string(count), list(count)] {
            assert_eq!(read(&text).case.vehicles[0].crush.as_ref().unwrap().depths.len(), count);
        }
    }
    for text in [string(1), list(1)] {
        let message = "\"vehicle1.crush.depths\" has 1 station, but a profile needs at least two";
        assert_eq!(messages(&text), [message]);
    }
    for text in [string(10_001), list(10_001)] {
        assert!(matches!(problems(&text)[..], [CaseProblem::TooMany { count: 10_001, limit: 10_000, .. }]));
    }
    let message = "\"vehicle1.crush.depths\" has 0 stations, but a profile needs at least two";
    assert_eq!(messages(&list(0)), [message]);
}

#[test]
fn a_case_has_five_hundred_ranges_at_most() {
    let with = |depths: &str, width: &str| {
        let width = format!("width = {width}");
        let text = OTHER_FORMS.replace("spacing = [\"10 cm\", \"0.2 m\"]", &width);
        text.replace("[\"0 cm\", \"100 mm\", \"0.1 m\"]", depths)
    };
    let width = "{ value = \"1 m\", sd = \"1 cm\" }";
    for spread in [
        |count: usize| format!("[{}]", vec!["{ value = \"9 cm\", sd = \"1 cm\" }"; count].join(", ")),
        |count: usize| format!("{{ values = \"{} cm\", sd = \"1 cm\" }}", vec!["9"; count].join(" ")),
    ] {
        assert_eq!(read(&with(&spread(499), width)).case.ranges.len(), 500);
        assert_eq!(read(&with(&spread(500), "\"1 m\"")).case.ranges.len(), 500);
        let text = with(&spread(500), width);
        assert_eq!(problems(&text), [CaseProblem::TooManyRanges { count: 501, limit: 500 }]);
        // The width is before the depths: the last of the depths is one too many.
        let diagnostics = CaseFile::parse("test.toml", &text).unwrap_err();
        let span = diagnostics.list()[0].span().unwrap();
        assert!(["{ value = \"9 cm\", sd = \"1 cm\" }", "9"].contains(&&text[span]));
    }
}

#[test]
fn all_problems_are_reported_at_once() {
    let text = OTHER_FORMS
        .replace("\"1500 kg\"", "1500")
        .replace("yaw_rate = \"-5 deg/s\"", "yaw_rate = -5 deg/s")
        .replace("side = \"left\"", "syde = \"left\"")
        .replace("restitution = 0", "restitution = 2");
    let found = problems(&text);
    assert!(
        matches!(
            found[..],
            [
                CaseProblem::BareNumber { .. },
                CaseProblem::Syntax { .. },
                CaseProblem::UnknownKey { nearest: Some("side"), .. },
                CaseProblem::OutOfRange { .. }
            ]
        ),
        "{found:?}"
    );
}

#[test]
fn a_misspelt_key_is_not_missing_as_well() {
    let vehicles = "[vehicle1]\n[vehicel2]\n";
    assert!(matches!(problems(vehicles)[..], [CaseProblem::UnknownTable { nearest: Some("vehicle2"), .. }]));
}

#[test]
fn a_thousand_zones_are_read_and_no_more() {
    let text = |zones: usize| {
        let depths = "1 ".repeat(zones + 1);
        let zone = "{ A = \"300 lb/in\", B = \"40 lb/in^2\" }, ";
        format!(
            "[vehicle1]\n[vehicle1.crush]\nside = \"front\"\nwidth = \"60 in\"\ndepths = \"{depths}in\"\n\
             stiffness = {{ zones = [{}] }}\n[vehicle2]\nfixed = true",
            zone.repeat(zones)
        )
    };
    let crush = read(&text(1000)).case.vehicles[0].crush.clone().unwrap();
    assert!(matches!(crush.stiffness, StiffnessForm::Zones(zones) if zones.len() == 1000));
    let refused = problems(&text(1001));
    assert!(matches!(refused[..], [CaseProblem::TooMany { count: 1001, limit: 1000, .. }]), "{refused:?}");
}

/// One of the speeds is sought: only the other one is required.
#[test]
fn a_reconstruction_asks_for_one_of_the_two_speeds() {
    let paper = paper();
    let (before, _) = paper.split_once("[reconstruct]").unwrap();
    let asked = |text: &str| {
        let errors = faults(text);
        errors
            .list()
            .iter()
            .map(|one| (one.problem().to_string(), one.problem().help().unwrap()))
            .collect::<Vec<_>>()
    };
    // The paper gives the speed of vehicle 2, and that of vehicle 1 is sought.
    let one = asked(before);
    assert_eq!(one.len(), 1, "{one:?}");
    assert!(one[0].0.starts_with("`reconstruct.find` is missing"), "{one:?}");
    assert!(one[0].1.contains("`find = \"vehicle1.speed\"`"), "{one:?}");
    let other = before
        .replace("[vehicle1]", "[vehicle1]\nspeed = \"75 ft/s\"")
        .replace("speed       = \"10 mph\"", "");
    assert!(asked(&other)[0].1.contains("`find = \"vehicle2.speed\"`"), "{:?}", asked(&other));
    let none = asked(&before.replace("speed       = \"10 mph\"", ""));
    assert_eq!(none.len(), 2, "{none:?}");
    assert!(none.iter().any(|(what, _)| what.contains("needs one of them and finds the other")), "{none:?}");
    // If the speed sought is named, the other is required.
    let named = asked(&paper.replace("speed       = \"10 mph\"", ""));
    assert!(matches!(&named[..], [(what, _)] if what.starts_with("`vehicle2.speed`")), "{named:?}");
}

/// The user's own values are not converted, only the examples are.
#[test]
fn a_number_of_the_user_keeps_its_unit() {
    let text = "[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nwheelbase = \"5' 11\\\"\"\n\
                contact = { x = \"1 m\" }\n[vehicle2]\nfixed = true";
    let errors = CaseFile::parse("case.toml", text).unwrap_err().to_string();
    assert!(errors.contains("write \"71 in\""), "{errors}");
    // 6.3 ft are 1.92 m.
    assert!(errors.contains("distance = \"1.9 m\""), "{errors}");
}

/// A bracket that is left open is one error, and the text before it is still checked.
#[test]
fn an_open_bracket_hides_nothing_before_it() {
    let text =
        "[vehicle1]\nspeed = 35\ncontact = { x = \"1 m\", y = \"2 m\"\nmass = 12\n[vehicle2]\nfixed = 1\n";
    let found = problems(text);
    assert!(matches!(found[..], [CaseProblem::BareNumber { .. }, CaseProblem::Syntax { .. }]), "{found:?}");
    // A table over several lines is not an error, but the comma in it is.
    let text = "[vehicle1]\ncontact = {\n  x = \"1 m\"\n  y = \"2 m\"\n}\n[vehicle2]\nfixed = true\n";
    let found = CaseFile::parse("case.toml", text).unwrap_err().to_string();
    assert!(found.contains("case.toml:4:3") && found.contains("with commas between"), "{found}");
}

#[test]
fn a_file_of_a_megabyte_is_read_and_a_larger_one_is_not() {
    let padded = |length: usize| format!("{OTHER_FORMS}#{}", "x".repeat(length - OTHER_FORMS.len() - 1));
    assert!(CaseFile::parse("case.toml", &padded(1_000_000)).is_ok());
    assert_eq!(problems(&padded(1_000_001)), [CaseProblem::TooLarge { limit: 1_000_000 }]);
}

#[test]
fn a_vehicle_that_was_not_inspected_can_be_inferred() {
    let paper = include_str!("../../../fixtures/sae-980025.toml");
    let (head, damage) = paper.split_once("[vehicle2.crush]").unwrap();
    let (_, tail) = damage.split_once("[impact]").unwrap();
    let help = |text: &str| -> Vec<String> {
        let errors = faults(text);
        errors.list().iter().filter_map(|one| one.problem().help()).collect()
    };
    let one = help(&format!("{head}[impact]{tail}"));
    assert!(matches!(&one[..], [help] if help.contains("`from_force_balance = true`")), "{one:?}");
    // A crush cannot follow from one that was not measured.
    let (before, damage) = head.split_once("[vehicle1.crush]").unwrap();
    let (_, after) = damage.split_once("[vehicle2]").unwrap();
    let none = help(&format!("{before}[vehicle2]{after}[impact]{tail}"));
    assert!(none.len() == 2 && none.iter().all(|help| !help.contains("from_force_balance")), "{none:?}");
}

/// An example suits the file: in the units of the same key, of the same kind, or of the system that most of
/// the case uses.
#[test]
fn an_example_has_a_unit_of_the_file() {
    let examples = |text: &str| -> Vec<String> {
        let errors = CaseFile::parse("case.toml", text).unwrap_err();
        let help = errors.list().iter().filter_map(|one| one.problem().help());
        help.map(|help| {
            help.split(['"', '=']).find(|part| part.starts_with('7')).unwrap_or_default().to_owned()
        })
        .collect()
    };
    let of = |first: &str, second: &str| {
        examples(&format!(
            "[vehicle1]\n{first}\n[vehicle1.crush]\nside = \"front\"\nstiffness = {{ category = 1 }}\n{second}\n[vehicle2]\nfixed = true"
        ))
    };
    let depths = "depths = \"7 8\"";
    // The unit of the width next to them; that of a system; centimetres if neither is known.
    assert_eq!(of("mass = \"1 t\"", &format!("width = \"60 in\"\n{depths}")), ["7 8 in"]);
    assert_eq!(of("mass = \"1 t\"", &format!("width = \"600 mm\"\n{depths}")), ["7 8 mm"]);
    assert_eq!(
        of("weight = \"3000 lb\"\nlength = \"15 ft\"", &format!("width = \"7\"\n{depths}")),
        ["", "7 in", "7 8 in"]
    );
    assert_eq!(of("", &format!("width = \"7\"\n{depths}")), ["7 cm", "7 8 cm"]);
    // Not that of a damage for the body, nor the other way round.
    assert_eq!(of("wheelbase = \"7\"", "width = \"60 in\"\ndepths = \"1 2 in\""), ["7 ft"]);
    assert_eq!(
        of("wheelbase = \"108 in\"\nyaw_radius = \"7\"", "width = \"60 cm\"\ndepths = \"1 2 cm\""),
        ["7 in"]
    );
    assert_eq!(
        of("mass = { value = \"3000 lb\", sd = 7 }", "width = \"60 cm\"\ndepths = \"1 2 cm\""),
        ["7 lb"]
    );
    assert_eq!(of("speed = \"7\"\nmass = \"1 t\"", "width = \"60 cm\"\ndepths = \"1 2 cm\""), ["7 m/s"]);
}

/// A search that is quick for a word of ten letters can be quadratic in its length.
#[test]
fn a_megabyte_of_one_value_is_refused_at_once() {
    let unit =
        |part: &str| format!("[vehicle1]\nmass = \"1 {}\"\n[vehicle2]", part.repeat(900_000 / part.len()));
    for text in [unit("√("), unit("√"), unit("sqrt(a)"), unit("lb "), unit("x")] {
        assert!(matches!(
            problems(&text)[..],
            [CaseProblem::Quantity {
                error: case::QuantityError::UnknownUnit { .. } | case::QuantityError::BadNumber { .. },
                ..
            }]
        ));
    }
    let count = 450_000;
    let depths =
        OTHER_FORMS.replace("[\"0 cm\", \"100 mm\", \"0.1 m\"]", &format!("\"{}cm\"", "1 ".repeat(count)));
    assert!(matches!(problems(&depths)[..], [CaseProblem::TooMany { count: 450_000, .. }]));
    let key = format!("{} = 1\n[vehicle1]\n[vehicle2]", "k".repeat(900_000));
    assert!(matches!(problems(&key)[..], [CaseProblem::UnknownKey { nearest: None, .. }]));
}

#[test]
fn deep_nesting_is_refused() {
    for text in
        ["[", "{a=", "a.", "[[", "\"\"."].map(|part| format!("a = {0}\n{0}a = 1", part.repeat(20_000)))
    {
        assert!(matches!(problems(&text)[0], CaseProblem::Syntax { .. }));
    }
    let dotted = format!("[vehicle1]\n{}a = 1\n[vehicle2]", "mass.".repeat(10_000));
    assert!(!problems(&dotted).is_empty());
}

#[test]
fn a_fault_is_placed_at_its_key() {
    let file = read(&paper());
    let fault = |key: &str, reason: &str, advice: Option<&str>| Fault {
        key: key.to_owned(),
        kind: FaultKind::Refused { reason: reason.to_owned() },
        advice: advice.map(str::to_owned),
    };
    let placed = |faults: Vec<Fault>| file.diagnostics(&Faults::none_of(faults).unwrap_err(), &Program::NONE);
    let at = |key: &str| {
        placed(vec![fault(key, "m", None)]).list()[0].span().map(|span| &file.source.text()[span])
    };
    assert_eq!(at("vehicle1.crush.width"), Some("\"65 in\""));
    assert_eq!(at("vehicle2.contact.angle"), Some("\"-39 deg\""));
    assert_eq!(at("vehicle2"), Some("[vehicle2]"));
    assert_eq!(at("vehicle1.speed"), Some("[vehicle1]"), "absent: the table that should have it");
    assert_eq!(at("vehicle2.crush.pdof"), Some("[vehicle2.crush]"));
    assert_eq!(at("uncertainty.samples"), None, "absent with all its tables: the file");

    assert!(Faults::none_of(Vec::new()).is_ok());
    let later = fault("vehicle2.speed", "too fast", Some("brake"));
    let earlier = fault("vehicle1.heading", "wrong way", None);
    let text = placed(vec![later, earlier]).to_string();
    let places = ["heading     = \"180 deg\"", "speed       = \"10 mph\""].map(|line| {
        let above = file.source.text().split(line).next().unwrap();
        format!("case.toml:{}:15", above.lines().count() + 1)
    });
    let positions = places.map(|place| text.find(&place).unwrap_or_else(|| panic!("{place}: {text}")));
    assert!(positions[0] < positions[1], "{text}");
    assert!(text.contains("error: too fast") && text.contains("help: brake"), "{text}");
}

// ---- generated cases ----

#[derive(Clone, Copy, PartialEq)]
enum Signs {
    Any,
    NotNegative,
    Positive,
}

fn unit_of(dimension: Dimension) -> impl Strategy<Value = &'static Unit> {
    any::<Index>().prop_map(move |index| index.get(dimension.units()))
}

/// Magnitudes over the whole accepted range; long fractions and short ones; zero and minus where allowed.
fn any_quantity(dimension: Dimension, range: Signs) -> impl Strategy<Value = Quantity> {
    let decade = |si: f64| format!("{si:e}").split('e').nth(1).unwrap().parse::<i32>().unwrap();
    let magnitude = (1.0..10.0_f64, decade(dimension.least_positive())..=decade(dimension.bound()))
        .prop_map(|(mantissa, exponent)| format!("{mantissa}e{exponent}").parse::<f64>().unwrap());
    (unit_of(dimension), magnitude, any::<bool>(), 0..10_u8).prop_filter_map(
        "rounding may leave the range",
        move |(unit, magnitude, is_short, kind)| {
            let number = magnitude / unit.factor();
            let number = if is_short { format!("{number:.2e}").parse().unwrap() } else { number };
            let number = match (range, kind) {
                (Signs::Any | Signs::NotNegative, 0) => 0.0,
                (Signs::Any, 1..5) => -number,
                _ => number,
            };
            let quantity = Quantity::new(number, unit).ok()?;
            (range != Signs::Positive || quantity.si() >= dimension.least_positive()).then_some(quantity)
        },
    )
}

fn words() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ -~]{1,30}",
        "\\PC{1,12}",
        vec(any::<char>(), 1..12).prop_map(|chars| chars.into_iter().collect()),
        Just("quote \" backslash \\ tab \t return \r\n nul \0 delete \u{7f}".to_owned()),
    ]
    .prop_filter("a text is not empty", |text: &String| !text.trim().is_empty())
}

fn any_line() -> impl Strategy<Value = StiffnessLine> {
    use Signs::{NotNegative, Positive};
    let a = || any_quantity(Dimension::StiffnessA, NotNegative);
    let g = || any_quantity(Dimension::StiffnessG, NotNegative);
    let limit = || option::of(a());
    prop_oneof![
        (a(), any_quantity(Dimension::StiffnessB, Positive), option::of(g()), limit())
            .prop_map(|(a, b, g, limit)| StiffnessLine::Crush { a, b, g, limit }),
        (a(), unit_of(Dimension::StiffnessB), g()).prop_map(|(a, unit, g)| StiffnessLine::Crush {
            a,
            b: Quantity::new(0.0, unit).unwrap(),
            g: Some(g),
            limit: None
        }),
        (
            any_quantity(Dimension::RootForce, NotNegative),
            any_quantity(Dimension::RootForcePerLength, Positive),
            option::of(g()),
            limit()
        )
            .prop_map(|(d0, d1, g, limit)| StiffnessLine::Root { d0, d1, g, limit }),
    ]
    .prop_filter("a limit is not below A", |line| {
        let (a, limit) = match line {
            StiffnessLine::Crush { a, limit, .. } => (a.si(), limit),
            StiffnessLine::Root { d0, d1, limit, .. } => (d0.si() * d1.si(), limit),
        };
        limit.is_none_or(|limit| limit.si() >= a)
    })
}

fn any_test() -> impl Strategy<Value = GivenTest> {
    let parse = |text: String, dimension| read_quantity(&text, dimension).unwrap();
    let mass = prop_oneof![
        (500..5000_u32).prop_map(move |kg| Mass::Mass(parse(format!("{kg} kg"), Dimension::Mass))),
        (5..50_u32).prop_map(move |kn| Mass::Weight(parse(format!("{kn} kN"), Dimension::Weight))),
    ];
    let fit = select(vec![Fit::Exact, Fit::Mean]);
    (mass, 20..90_u32, 100..200_u32, vec(1..90_u32, 2..8), 0..19_u32, fit).prop_map(
        move |(mass, speed, width, depths, no_damage, fit)| GivenTest {
            mass,
            speed: parse(format!("{speed} km/h"), Dimension::Speed),
            width: parse(format!("{width} cm"), Dimension::Length),
            depths: depths.iter().map(|cm| parse(format!("{cm} cm"), Dimension::Length)).collect(),
            no_damage_speed: parse(format!("{no_damage} km/h"), Dimension::Speed),
            fit,
        },
    )
}

/// With as many zones as the profile has, if it has any.
fn any_stiffness(zones: usize) -> impl Strategy<Value = StiffnessForm> {
    let zones = if zones == 0 {
        any_line().prop_map(StiffnessForm::Line).boxed()
    } else {
        vec(any_line(), zones).prop_map(StiffnessForm::Zones).boxed()
    };
    prop_oneof![
        4 => any_line().prop_map(StiffnessForm::Line),
        1 => (1..=5_u8).prop_map(|category| StiffnessForm::Typical(TypicalStiffness::Category(category))),
        1 => Just(StiffnessForm::Typical(TypicalStiffness::Fleet)),
        1 => any_test().prop_map(StiffnessForm::Test),
        1 => zones,
    ]
}

/// Depths with or without one unit, and a width, a spacing, or both in agreement.
fn any_profile() -> impl Strategy<Value = (Option<Quantity>, Vec<Quantity>, Option<Vec<Quantity>>)> {
    let depth = || any_quantity(Dimension::Length, Signs::NotNegative);
    let share_unit = |quantities: Vec<Quantity>, is_shared: bool| -> Vec<Quantity> {
        let unit = quantities[0].unit();
        if !is_shared {
            return quantities;
        }
        quantities.iter().map(|q| Quantity::new(q.number().min(1.0), unit).unwrap()).collect()
    };
    let width = any_quantity(Dimension::Length, Signs::Positive);
    let gaps = vec((unit_of(Dimension::Length), 1_u32..1000), 7);
    (vec(depth(), 2..8), any::<[bool; 3]>(), width, gaps).prop_map(
        move |(depths, [depths_share, has_width, has_spacing], width, gaps)| {
            let depths = share_unit(depths, depths_share);
            if !has_spacing {
                return (Some(width), depths, None);
            }
            let gaps = gaps.iter().take(depths.len() - 1);
            let spacing: Vec<Quantity> = gaps
                .map(|(unit, mm)| Quantity::new(f64::from(*mm) / 1000.0 / unit.factor(), unit).unwrap())
                .collect();
            let metre = Dimension::Length.unit("m").unwrap();
            let sum = Quantity::new(spacing.iter().map(Quantity::si).sum(), metre).unwrap();
            (has_width.then_some(sum), depths, Some(spacing))
        },
    )
}

fn any_energy() -> impl Strategy<Value = KnownEnergy> {
    let side = select(vec![Side::Front, Side::Rear, Side::Left, Side::Right]);
    let pdof = prop_oneof![
        any_quantity(Dimension::Angle, Signs::Any).prop_map(Pdof::Angle),
        (1..=12_u8).prop_map(Pdof::Clock)
    ];
    let arm = any_quantity(Dimension::Length, Signs::NotNegative);
    let ees = any_quantity(Dimension::Speed, Signs::NotNegative);
    let given = (ees, option::of(side), option::of(pdof), option::of(arm))
        .prop_map(|(ees, side, pdof, moment_arm)| KnownEnergy::Ees(GivenEes { ees, side, pdof, moment_arm }));
    prop_oneof![given, Just(KnownEnergy::Undamaged)]
}

fn any_crush() -> impl Strategy<Value = Crush> {
    let side = select(vec![Side::Front, Side::Rear, Side::Left, Side::Right]);
    let oblique = option::of(select(vec![
        ObliqueCorrection::Capped,
        ObliqueCorrection::Uncapped,
        ObliqueCorrection::None,
        ObliqueCorrection::Secant,
        ObliqueCorrection::Friction(0.55),
    ]));
    let degree = Dimension::Angle.unit("deg").unwrap();
    let acute = (-89.99..89.99_f64).prop_map(move |number| Quantity::new(number, degree).unwrap());
    let angle = prop_oneof![
        3 => any_quantity(Dimension::Angle, Signs::Any).prop_map(Pdof::Angle),
        1 => (1..=12_u8).prop_map(Pdof::Clock),
    ];
    let offset = any_quantity(Dimension::Length, Signs::Any);
    let arm = any_quantity(Dimension::Length, Signs::NotNegative);
    let optional = (option::of(offset), option::of(angle), option::of(acute), option::of(arm));
    let profile_and_stiffness = (any_profile(), any::<bool>()).prop_flat_map(|(profile, inferred)| {
        let zones = if inferred { 0 } else { profile.1.len() - 1 };
        let profile = if inferred { (profile.0, Vec::new(), None) } else { profile };
        (Just(profile), any_stiffness(zones))
    });
    (side, profile_and_stiffness, optional, oblique).prop_map(
        |(
            side,
            ((width, depths, spacing), stiffness),
            (offset, pdof, oblique_angle, moment_arm),
            oblique,
        )| {
            Crush {
                side,
                from_force_balance: depths.is_empty(),
                width,
                depths,
                spacing,
                stiffness,
                offset,
                pdof,
                oblique_angle,
                moment_arm,
                oblique,
            }
        },
    )
}

fn any_place() -> impl Strategy<Value = Place> {
    let coordinate = || any_quantity(Dimension::Length, Signs::Any);
    (coordinate(), coordinate()).prop_map(|(x, y)| Place { x, y })
}

fn any_surface() -> impl Strategy<Value = Surface> {
    let friction = || 1e-3..2.0_f64;
    let grade = (0.0..=1.0_f64, any_quantity(Dimension::Angle, Signs::Any))
        .prop_map(|(slope, uphill)| Grade { slope, uphill });
    let metres =
        |number: i32| Quantity::new(f64::from(number) / 10.0, Dimension::Length.unit("m").unwrap()).unwrap();
    let corner = move |x, y| Place { x: metres(x), y: metres(y) };
    let place = || (-900..900_i32, -900..900_i32);
    let edge = (place(), 1..90_i32, select(vec![EdgeSide::Left, EdgeSide::Right])).prop_map(
        move |((x, y), by, side)| SurfaceRegion::Beside {
            edge: [corner(x, y), corner(x - by, y + by)],
            side,
        },
    );
    // A triangle, or a square with or without a notch.
    let polygon = (place(), 2..90_i32, 0..3_u8).prop_map(move |((x, y), by, shape)| {
        let far = [(x + 2 * by, y), (x + 2 * by, y + 2 * by)];
        let rest = match shape {
            0 => vec![],
            1 => vec![(x, y + 2 * by)],
            _ => vec![(x + by, y + by), (x, y + 2 * by)],
        };
        SurfaceRegion::Polygon(
            [(x, y)].into_iter().chain(far).chain(rest).map(|(x, y)| corner(x, y)).collect(),
        )
    });
    let zone = (option::of(words()), friction(), prop_oneof![edge, polygon])
        .prop_map(|(name, friction, region)| SurfaceZone { name: name.map(Text::from), friction, region });
    (friction(), option::of(grade), vec(zone, 0..3)).prop_map(|(friction, grade, zones)| Surface {
        friction,
        grade,
        zones,
    })
}

fn any_before() -> impl Strategy<Value = Before> {
    let speed = option::of(any_quantity(Dimension::Speed, Signs::Positive));
    let begin = prop_oneof![
        any_quantity(Dimension::Length, Signs::Positive).prop_map(SkidBegin::Length),
        any_place().prop_map(SkidBegin::From),
    ];
    let skid = (begin, option::of(1e-3..2.0_f64), speed).prop_map(|(begin, friction, speed)| Before {
        skid: Some(Skid { begin, friction }),
        speed,
        phases: Vec::new(),
    });
    let phases = vec(any_phase(), 1..4).prop_map(|phases| Before { skid: None, speed: None, phases });
    prop_oneof![skid, phases]
}

fn any_phase() -> impl Strategy<Value = GivenPhase> {
    let form = (
        option::of(any_quantity(Dimension::Length, Signs::Positive)),
        option::of(any_quantity(Dimension::Time, Signs::Positive)),
        option::of(any_quantity(Dimension::Speed, Signs::Positive)),
        any_quantity(Dimension::Acceleration, Signs::Any),
    );
    (form, option::of(words())).prop_map(|((distance, time, speed, acceleration), source)| GivenPhase {
        form: PhaseForm { distance, time, speed, acceleration: Some(acceleration) },
        source: source.map(Text::from),
    })
}

fn any_after() -> impl Strategy<Value = After> {
    let angle = || any_quantity(Dimension::Angle, Signs::Any);
    let wheel = || prop_oneof![Just(WheelDrag::Locked), (0.0..10.0_f64).prop_map(WheelDrag::Share)];
    let drag = prop_oneof![
        wheel().prop_map(Drag::Every),
        [wheel(), wheel(), wheel(), wheel()].prop_map(Drag::Each),
    ];
    let unit = Dimension::Time.unit("ms").unwrap();
    let degree = Dimension::Angle.unit("deg").unwrap();
    let turned = || (-89.999..90.0_f64).prop_map(|turn| Quantity::new(turn, degree).unwrap());
    let over = vec((1..9_i32, turned()), 1..4).prop_map(move |steps| {
        let mut time = 0;
        let points = steps.into_iter().map(|(step, angle)| {
            time += step;
            SteerPoint { time: Quantity::new(f64::from(time), unit).unwrap(), angle }
        });
        GivenSteer::Over(points.collect())
    });
    let steer = prop_oneof![turned().prop_map(GivenSteer::Held), over];
    let heading = prop_oneof![angle().prop_map(RestHeading::Heading), angle().prop_map(RestHeading::Turned)];
    let rest = (any_place(), heading).prop_map(|(place, heading)| GivenRest { place, heading });
    let velocity = (
        option::of(any_quantity(Dimension::Speed, Signs::NotNegative)),
        option::of(angle()),
        option::of(any_quantity(Dimension::YawRate, Signs::Any)),
    );
    let wheel = option::of(select(MarkedWheel::WORDS.map(|(_, wheel)| wheel).to_vec()));
    let point = (any_place(), option::of(angle()), wheel).prop_map(|(place, heading, wheel)| PathPoint {
        place,
        heading,
        wheel,
    });
    let wheels = (option::of(drag), option::of(1e-3..2.0_f64));
    (wheels, option::of(steer), option::of(rest), vec(point, 0..3), velocity).prop_map(
        |((drag, friction), steer, rest, points, (speed, direction, yaw_rate))| After {
            drag,
            friction,
            steer,
            rest,
            points,
            // A speed has a direction.
            speed: speed.filter(|_| direction.is_some()),
            direction,
            yaw_rate,
        },
    )
}

fn any_recorder() -> impl Strategy<Value = Recorder> {
    let speed = || option::of(any_quantity(Dimension::Speed, Signs::Any));
    let error = || option::of(1e-3..1e3_f64);
    let delta_v = (speed(), speed(), error());
    let of_speed = (option::of(any_quantity(Dimension::Speed, Signs::Positive)), error());
    let yaw_rate = option::of((
        any_quantity(Dimension::YawRate, Signs::Any),
        option::of(any_quantity(Dimension::YawRate, Signs::Positive)),
    ));
    let direction_error = option::of(any_quantity(Dimension::Angle, Signs::Positive));
    (delta_v, direction_error, of_speed, yaw_rate).prop_map(
        |((along, across, delta_v_error), direction_error, (speed, speed_error), yaw_rate)| {
            // A component across the vehicle requires one along it, and an error what it is of.
            let delta_v_lateral = across.filter(|_| along.is_some());
            Recorder {
                delta_v_error: delta_v_error.filter(|_| along.is_some()),
                delta_v_longitudinal: along,
                delta_v_lateral,
                direction_error: direction_error.filter(|_| delta_v_lateral.is_some()),
                speed_error: speed_error.filter(|_| speed.is_some()),
                speed,
                yaw_rate: yaw_rate.map(|(rate, _)| rate),
                yaw_rate_error: yaw_rate.and_then(|(_, error)| error),
                ..Recorder::default()
            }
        },
    )
}

fn any_certain_speed() -> impl Strategy<Value = CertainSpeed> {
    let speed = || option::of(any_quantity(Dimension::Speed, Signs::Any));
    (speed(), speed()).prop_filter_map("a limit, and the lower one first", |(at_least, at_most)| {
        match (&at_least, &at_most) {
            (None, None) => None,
            (Some(low), Some(high)) if low.si() >= high.si() => None,
            _ => Some(CertainSpeed { at_least, at_most }),
        }
    })
}

fn any_estimate() -> impl Strategy<Value = GivenEstimate> {
    let median = option::of(any_quantity(Dimension::Speed, Signs::Positive));
    let prior = select(SeverityPrior::WORDS.map(|(_, prior)| prior).to_vec());
    let percent = || option::of(1e-3..1e3_f64);
    let least = option::of(any_quantity(Dimension::Length, Signs::Positive));
    let heading = option::of(any_quantity(Dimension::Angle, Signs::Positive));
    let given = (prior, median, percent(), percent(), percent(), least, heading, option::of(0.0..49.0_f64));
    given.prop_map(|given| {
        let (prior, delta_v_median, crush_error, crush_bias, rest_error, least, heading, stood) = given;
        GivenEstimate {
            prior,
            delta_v_median,
            crush_error,
            crush_bias,
            rest_error,
            rest_least_error: least,
            rest_heading_error: heading,
            stood,
        }
    })
}

fn any_vehicle() -> impl Strategy<Value = GivenVehicle> {
    use Signs::{Any, NotNegative, Positive};
    let length = |range| any_quantity(Dimension::Length, range);
    let speed = || any_quantity(Dimension::Speed, Any);
    let angle = || any_quantity(Dimension::Angle, Any);
    let mass = prop_oneof![
        any_quantity(Dimension::Mass, Positive).prop_map(Mass::Mass),
        any_quantity(Dimension::Weight, Positive).prop_map(Mass::Weight),
    ];
    let yaw = prop_oneof![
        any_quantity(Dimension::Inertia, Positive).prop_map(YawInertia::Inertia),
        length(Positive).prop_map(YawInertia::Radius),
    ];
    let contact = prop_oneof![
        (length(NotNegative), angle()).prop_map(|(distance, angle)| ContactPoint::Polar { distance, angle }),
        (length(Any), length(Any)).prop_map(|(x, y)| ContactPoint::Cartesian { x, y }),
    ];
    let motion = prop_oneof![
        speed().prop_map(Velocity::Speed),
        (speed(), speed()).prop_map(|(x, y)| Velocity::Vector { x, y }),
    ];
    let outline = (length(Positive), length(Positive), length(Positive)).prop_filter_map(
        "the CG lies within the vehicle",
        |(length, width, cg_to_front)| {
            (cg_to_front.si() < length.si()).then_some(Outline { length, width, cg_to_front })
        },
    );
    let kind = option::of(select(VehicleKind::WORDS.map(|(_, kind)| kind).to_vec()));
    let typical = (kind, option::of(1..=6_u8), [(); 4].map(|()| option::of(length(Positive))));
    let moving = (option::of(any_before()), option::of(any_after().boxed()));
    let told = (option::of(any_recorder()), option::of(any_certain_speed()));
    let place = (option::of(contact), option::of(any_place()));
    let of_both = (option::of(words()), option::of(angle()), place, option::of(outline));
    let turning = (option::of(any_quantity(Dimension::YawRate, Any)), option::of(angle()));
    let of_vehicles = (
        option::of(mass),
        option::of(yaw),
        option::of(motion),
        turning,
        (option::of(any_crush()), option::of(any_energy())),
    );
    (of_both, of_vehicles, typical, moving, told).prop_map(
        |(
            (name, heading, (contact, position), outline),
            (mass, yaw, motion, (yaw_rate, sideslip), (crush, energy)),
            (kind, class, [wheelbase, track, cg_to_front_axle, length]),
            (before, after),
            (recorder, certain_speed),
        )| {
            // Tables of cars are for cars.
            let is_of_table = |crush: &Crush| matches!(crush.stiffness, StiffnessForm::Typical(_));
            let kind = kind.filter(|_| !crush.as_ref().is_some_and(is_of_table));
            let energy = energy.filter(|_| crush.is_none());
            GivenVehicle {
                name: name.map(Text::from),
                fixed: false,
                kind,
                mass,
                yaw,
                class: class.filter(|_| kind.unwrap_or_default() == VehicleKind::Car),
                model_year: class.map(|class| 2000 + u16::from(class)),
                wheelbase,
                track,
                cg_to_front_axle,
                length: length.filter(|_| wheelbase.is_some() && outline.is_none()),
                heading,
                contact,
                // A vector has its direction.
                sideslip: sideslip.filter(|_| !matches!(motion, Some(Velocity::Vector { .. }))),
                position,
                motion,
                yaw_rate,
                outline,
                deformation_energy: None,
                diameter: None,
                crush,
                energy,
                before,
                // A table without a key has no content.
                after: after.filter(|after| *after != After::default()),
                recorder: recorder.filter(|recorder| *recorder != Recorder::default()),
                // A known speed lies within its limits.
                certain_speed: certain_speed.filter(|_| !matches!(motion, Some(Velocity::Speed(_)))),
            }
        },
    )
}

/// Up to eight points of any units and ascending speeds.
fn any_restitution() -> impl Strategy<Value = Restitution> {
    let e = || 0.0..=1.0_f64;
    let points = vec((any_quantity(Dimension::Speed, Signs::NotNegative), e()), 1..8);
    let curve = (points, any::<bool>()).prop_map(|(mut points, is_shared)| {
        let unit = points[0].0.unit();
        for (speed, _) in &mut points {
            if is_shared {
                *speed = Quantity::new(speed.number().min(100.0), unit).unwrap();
            }
        }
        points.sort_by(|(one, _), (other, _)| one.si().total_cmp(&other.si()));
        points.dedup_by(|(one, _), (other, _)| one.si() == other.si());
        let (speeds, values) = points.into_iter().unzip();
        Restitution::OfClosingSpeed { speeds, values }
    });
    prop_oneof![e().prop_map(Restitution::Constant), curve]
}

fn any_law() -> impl Strategy<Value = ImpactLaw> {
    let tangential = prop_oneof![
        Just(BrachTangential::Critical),
        (-1e9..1e9_f64).prop_map(BrachTangential::Ratio),
        (0.0..=1.0_f64).prop_map(BrachTangential::FractionOfCritical),
        (0.0..1e9_f64).prop_map(BrachTangential::Friction),
    ];
    let coefficient = || -1.0..=1.0_f64;
    prop_oneof![
        (any_restitution(), tangential, option::of(coefficient())).prop_map(
            |(restitution, tangential, moment_restitution)| ImpactLaw::Brach {
                restitution,
                tangential,
                moment_restitution
            }
        ),
        option::of(any_quantity(Dimension::Speed, Signs::Any))
            .prop_map(|tangential_velocity_change| ImpactLaw::Woolley { tangential_velocity_change }),
        (any_restitution(), coefficient()).prop_map(|(restitution, tangential_restitution)| {
            ImpactLaw::Ishikawa { restitution, tangential_restitution }
        }),
        (any_restitution(), 0.0..1e9_f64)
            .prop_map(|(restitution, friction)| ImpactLaw::KudlichSlibar { restitution, friction }),
    ]
}

fn any_basis() -> impl Strategy<Value = Basis> {
    prop_oneof![
        select(vec![Basis::Dissipated, Basis::Absorbed]),
        (0.0..=1.0_f64).prop_map(Basis::TangentialShare),
    ]
}

fn any_case() -> impl Strategy<Value = Case> {
    let impact = (any_quantity(Dimension::Angle, Signs::Any), any_law())
        .prop_map(|(crush_plane, law)| GivenImpact { crush_plane, law });
    let finds = vec![Find::One(VehicleId::One), Find::One(VehicleId::Two), Find::Both];
    let reconstruct =
        (select(finds), any_basis()).prop_map(|(find, energy_basis)| Reconstruct { find, energy_basis });
    let ground = (option::of(any_place()), option::of(any_surface().boxed()));
    // Boxed, because the strategies are too large for the stack of a test.
    let vehicles = [any_vehicle().boxed(), any_vehicle().boxed()];
    let texts = [(); 6].map(|()| option::of(words()));
    let barrier = option::of(0..2_usize);
    let reconstruct = (option::of(reconstruct), option::of(any_estimate()));
    let axes = select(vec![Axes::ZUp, Axes::ZDown]);
    let axes = (axes, any::<[bool; 5]>());
    (texts, axes, ground, vehicles, barrier, option::of(impact), reconstruct).prop_map(
        |(
            texts,
            (axes, leaves_out),
            (scene_contact, surface),
            mut vehicles,
            barrier,
            impact,
            (mut reconstruct, estimate),
        )| {
            if let Some(index) = barrier {
                let GivenVehicle { name, heading, contact, outline, .. } = vehicles[index].clone();
                // One of the two, or neither.
                let diameter = vehicles[index].wheelbase.filter(|_| outline.is_none());
                vehicles[index] = GivenVehicle {
                    name,
                    fixed: true,
                    heading,
                    contact,
                    outline,
                    diameter,
                    ..GivenVehicle::default()
                };
                let moving = Find::One([VehicleId::Two, VehicleId::One][index]);
                reconstruct = reconstruct.map(|wanted| Reconstruct { find: moving, ..wanted });
            }
            // A crush can be inferred only from one that was measured.
            for (i, other) in [(0, 1), (1, 0)] {
                let measured =
                    |v: &GivenVehicle| v.crush.as_ref().is_some_and(|crush| !crush.from_force_balance);
                if !measured(&vehicles[i]) && !measured(&vehicles[other]) {
                    vehicles[i].crush = None;
                }
            }
            // Only a default can be left out, and only in a table that exists.
            let [axes_out, law_out, basis_out, fits_out @ ..] = leaves_out;
            let has_exact_fit = |vehicle: &GivenVehicle| {
                let stiffness = vehicle.crush.as_ref().map(|crush| &crush.stiffness);
                matches!(stiffness, Some(StiffnessForm::Test(GivenTest { fit: Fit::Exact, .. })))
            };
            let left_out = LeftOut {
                axes: axes_out && axes == Axes::ZUp,
                law: law_out && impact.as_ref().is_some_and(|impact| impact.law.name() == "brach"),
                energy_basis: basis_out
                    && reconstruct.is_some_and(|table| table.energy_basis == Basis::Dissipated),
                fit: [0, 1].map(|i| fits_out[i] && has_exact_fit(&vehicles[i])),
            };
            let [title, source, analyst, date, file_number, exhibit] = texts.map(|text| text.map(Text::from));
            let report = ReportHead { analyst, date, file_number, exhibit };
            Case {
                title,
                source,
                report,
                axes,
                scene_contact,
                surface,
                vehicles,
                impact,
                reconstruct,
                estimate,
                ranges: Vec::new(),
                left_out,
                ..Case::default()
            }
        },
    )
}

/// One change of a file.
#[derive(Clone, Debug)]
enum Change {
    Delete(Index, usize),
    Insert(Index, &'static str),
    Digit(Index, char),
    Line(Index, Index),
}

fn any_change() -> impl Strategy<Value = Change> {
    let odd = [
        "\"",
        "'",
        "[",
        "]",
        "{",
        "}",
        "=",
        ".",
        ",",
        "#",
        "\n",
        "\r\n",
        "\\",
        "\0",
        "\u{feff}",
        "\u{202e}",
        "é",
        "🚗",
        "−",
        "√",
        "^",
        "½",
        "\t",
        "e999",
        "nan",
        "[[",
        "\"\"\"",
        "-",
        "1_0",
        "0x",
        "fixed = true\n",
        "speed = 1\n",
        " ",
    ];
    let digit = select("0123456789.-".chars().collect::<Vec<char>>());
    prop_oneof![
        (any::<Index>(), 1..40_usize).prop_map(|(at, length)| Change::Delete(at, length)),
        (any::<Index>(), select(odd.to_vec())).prop_map(|(at, text)| Change::Insert(at, text)),
        (any::<Index>(), digit).prop_map(|(at, digit)| Change::Digit(at, digit)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Change::Line(from, to)),
    ]
}

fn apply(text: &str, change: &Change) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    if chars.is_empty() {
        return String::new();
    }
    match change {
        Change::Delete(at, length) => {
            let at = at.index(chars.len());
            chars.drain(at..(at + length).min(chars.len()));
        }
        Change::Insert(at, text) => {
            let at = at.index(chars.len());
            chars.splice(at..at, text.chars());
        }
        Change::Digit(at, digit) => {
            let digits: Vec<usize> = (0..chars.len()).filter(|&i| chars[i].is_ascii_digit()).collect();
            if !digits.is_empty() {
                chars[*at.get(&digits)] = *digit;
            }
        }
        Change::Line(from, to) => {
            let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
            let line = *from.get(&lines);
            lines.insert(to.index(lines.len()), line);
            return lines.concat();
        }
    }
    chars.into_iter().collect()
}

/// A text is either refused with reasons or accepted as a case that can be written back.
fn survives(text: &str) -> Result<(), TestCaseError> {
    match CaseFile::parse("case.toml", text) {
        Ok(file) => {
            let written = to_toml(&file.case);
            let again = CaseFile::parse("written.toml", &written).map(|file| file.case);
            prop_assert_eq!(again.map_err(|errors| errors.to_string()), Ok(file.case));
        }
        Err(errors) => {
            prop_assert!(!errors.list().is_empty(), "refused without a reason");
            let rendered = errors.to_string();
            prop_assert!(rendered.starts_with("error: "), "{}", rendered);
            let controls = rendered.chars().filter(|c| c.is_control() && *c != '\n').count();
            prop_assert_eq!(controls, 0, "control characters reach the terminal: {:?}", rendered);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn writing_and_reading_gives_the_same_case(case in any_case()) {
        let text = to_toml(&case);
        let again = CaseFile::parse("written.toml", &text).map(|file| file.case);
        prop_assert_eq!(again.map_err(|errors| errors.to_string()), Ok(case), "{}", text);
    }

    /// The mechanics accept every law that a file can give.
    #[test]
    fn every_law_is_one_of_the_mechanics(law in any_law()) {
        let mut file = read(&paper());
        file.case.impact = file.case.impact.map(|impact| GivenImpact { law, ..impact });
        let errors = file.case.reconstruction().err().map(|errors| errors.to_string());
        prop_assert_eq!(errors, None);
    }

    #[test]
    fn a_damaged_file_is_survived(changes in vec(any_change(), 1..12), base in 0..6_u8) {
        let mut text = match base {
            0 => paper(),
            1 => OTHER_FORMS.to_owned(),
            2 => with_impact(CURVE),
            3 => RANGES.to_owned(),
            4 => uncertain(),
            _ => with_impact("law = \"kudlich-slibar\"\nrestitution = 0.3\nfriction = 0.5"),
        };
        for change in &changes {
            text = apply(&text, change);
        }
        survives(&text)?;
    }

    #[test]
    fn any_text_is_survived(text in any::<String>()) {
        survives(&text)?;
    }

    #[test]
    fn any_value_is_survived(value in "[-+−.,eE0-9 √½^/()a-z²·°_*]{0,24}", key in 0..6_usize) {
        let key = ["mass", "yaw_inertia", "heading", "speed", "yaw_rate", "length"][key];
        survives(&format!("[vehicle1]\n{key} = \"{value}\"\n[vehicle2]\n"))?;
        survives(&format!("[vehicle1.crush]\ndepths = \"{value}\"\nstiffness = {{ d0 = \"{value}\" }}\n[vehicle2]\n"))?;
    }
}

/// Inline tables give the same help as those with a header: by their own rows.
#[test]
fn keys_of_tables_in_braces_get_the_help_of_their_rows() {
    for (text, says) in [
        ("[surface]\nfriction = 0.7\ngrade = { slope = 0.03, uphill_deg = \"90\" }", "uphill = \"… deg\""),
        (
            "[vehicle1.after]\nrest = { x = \"1 m\", y = \"1 m\", turned_deg = \"-220\" }",
            "turned = \"… deg\"",
        ),
        ("[vehicle1.after]\nturned = \"3 deg\"", "it belongs in rest = { … }"),
        ("[surface]\nfriction = 0.7\nuphill = \"90 deg\"", "it belongs in grade = { … }"),
        ("[vehicle1.before]\nskid = { length = \"0 m\" }", "as in length = \"18 m\""),
    ] {
        let told = CaseFile::parse("case.toml", text).unwrap_err().to_string();
        assert!(told.contains(says), "{text}: {told}");
    }
}

/// No vehicle has its centre of gravity behind the rear.
#[test]
fn a_centre_of_gravity_lies_within_its_vehicle() {
    let refused = |cg_to_front: &str| {
        let text =
            format!("[vehicle1]\nlength = \"13 ft\"\nwidth = \"6 ft\"\ncg_to_front = \"{cg_to_front}\"\n");
        CaseFile::parse("x.toml", &text).err().map(|errors| errors.to_string())
    };
    assert_eq!(refused("5 ft"), None);
    let said = refused("15 ft").unwrap();
    assert!(said.contains("15 ft behind the front") && said.contains("13 ft long"), "{said}");
    assert!(refused("13 ft").is_some());
}
