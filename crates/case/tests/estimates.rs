//! Substitutes for unknown values: stiffness from tables and tests, size classes, PDOFs by the clock or
//! from the other vehicle, and a crush that was not measured.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]

use case::{
    CaseFile, CrushEvidence, DamageData, Fit, InferredWidth, StiffnessSource, TypicalStiffness, VehicleData,
    YawSource, to_toml,
};
use crash3::{ObliqueCorrection, Side, SideStiffness, Stiffness, crush_energy};

/// Two cars, each with the lines given for it and for its crush.
fn cars([first, second]: [(&str, &str); 2]) -> CaseFile {
    let text = format!(
        "[vehicle1]\nmass = \"1500 kg\"\n{}\n[vehicle1.crush]\n{}\n[vehicle2]\nmass = \"1200 kg\"\n{}\n[vehicle2.crush]\n{}\n",
        first.0, first.1, second.0, second.1
    );
    let file = CaseFile::parse("cars.toml", &text).map_err(|error| error.to_string()).unwrap();
    // Written back and read again it is the same case.
    assert_eq!(CaseFile::parse("again.toml", &to_toml(&file.case)).unwrap().case, file.case);
    file
}

const YAW: &str = "yaw_radius = \"1.4 m\"";
const FRONT: &str = "side = \"front\"\nwidth = \"1.5 m\"\ndepths = \"0.3 0.3 m\"";
const FORCE: &str = "oblique_angle = \"0 deg\"\nmoment_arm = \"0 m\"";

fn damages(file: &CaseFile) -> [DamageData; 2] {
    vehicles(file).map(|vehicle| vehicle.damage.unwrap())
}

fn vehicles(file: &CaseFile) -> [VehicleData; 2] {
    file.case.damage().map_err(|error| error.to_string()).unwrap().vehicles
}

/// The stiffness that these lines give the front of vehicle 1.
fn read_stiffness(stiffness: &str) -> (SideStiffness, StiffnessSource) {
    let other = format!("{FRONT}\nstiffness = {{ category = 1 }}\n{FORCE}");
    let file = cars([(YAW, &format!("{FRONT}\nstiffness = {stiffness}\n{FORCE}")), (YAW, &other)]);
    let [damage, _] = damages(&file);
    let CrushEvidence::Measured { structure, .. } = damage.evidence else { panic!("measured") };
    (structure, damage.stiffness_source)
}

#[test]
fn every_stiffness_names_its_source() {
    let (structure, source) = read_stiffness("{ category = 4 }");
    assert_eq!(source, StiffnessSource::Typical(TypicalStiffness::Category(4)));
    let SideStiffness::Uniform(known) = structure else { panic!("uniform") };
    // SAE 870045, Table 1, front, category 4: A 356 lb/in.
    assert!((known.a() * 0.0254 / 4.448_221_615_260_5 - 356.0).abs() < 1e-9);

    let (structure, source) = read_stiffness("\"fleet\"");
    assert_eq!(source, StiffnessSource::Typical(TypicalStiffness::Fleet));
    let SideStiffness::Uniform(known) = structure else { panic!("uniform") };
    // docs/calibration.md: b₀ = 2.22 m/s and b₁ = 27.7 1/s of a car of 1600 kg on 1.6 m.
    // A = m b₀ b₁/w, B = m b₁²/w, G = m b₀²/2w
    for (found, expected) in [(known.a(), 61_494.0), (known.b(), 767_290.0), (known.g(), 2_464.2)] {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
    }

    let limited = "{ A = \"50 kN/m\", B = \"1 MN/m^2\", limit = \"200 kN/m\" }";
    let expected = Stiffness::from_ab(50e3, 1e6).unwrap().with_saturation_force(200e3).unwrap();
    assert_eq!(read_stiffness(limited), (SideStiffness::Uniform(expected), StiffnessSource::Coefficients));

    let roots = "{ d0 = \"40 N^0.5\", d1 = \"1000 N^0.5/m\", G = \"900 N\", limit = \"0.3 kN/mm\" }";
    let roots = roots.replace("0.3 kN/mm", "300 N/mm");
    let expected =
        Stiffness::from_d0_d1_g(40.0, 1000.0, 900.0).unwrap().with_saturation_force(300e3).unwrap();
    assert_eq!(read_stiffness(&roots), (SideStiffness::Uniform(expected), StiffnessSource::Roots));

    let zones = "{ zones = [{ A = \"50 kN/m\", B = \"1 MN/m^2\" }] }";
    let expected = SideStiffness::Zones(vec![Stiffness::from_ab(50e3, 1e6).unwrap()]);
    assert_eq!(read_stiffness(zones), (expected, StiffnessSource::Zones));
}

#[test]
fn a_barrier_test_gives_its_energy_back_through_the_file() {
    let test = "{ test = { mass = \"1400 kg\", speed = \"56 km/h\", width = \"1.6 m\", depths = \"38 52 60 61 53 36 cm\", \
                no_damage_speed = \"8 km/h\" } }";
    let profile = crash3::Profile::equally_spaced(
        [38.0, 52.0, 60.0, 61.0, 53.0, 36.0].map(|cm| cm / 100.0).to_vec(),
        1.6,
    )
    .unwrap();
    let speed = 56.0 / 3.6;
    let kinetic = 0.5 * 1400.0 * speed * speed;
    let energy = |stiffness: &str| {
        let (structure, source) = read_stiffness(stiffness);
        let SideStiffness::Uniform(stiffness) = structure else { panic!("uniform") };
        (crush_energy(&profile, &stiffness) / kinetic, source)
    };
    let (exact, source) = energy(test);
    assert!((exact - 1.0).abs() < 1e-12, "{exact}");
    assert_eq!(source, StiffnessSource::Test(Fit::Exact));
    let (mean, source) = energy(&test.replace("\"8 km/h\"", "\"8 km/h\", fit = \"mean\""));
    assert!((1.01..1.05).contains(&mean), "{mean}");
    assert_eq!(source, StiffnessSource::Test(Fit::Mean));
    // As a weight, 1400 kg are 13,729.31 N.
    let (by_weight, _) = energy(&test.replace("mass = \"1400 kg\"", "weight = \"13729.31 N\""));
    assert!((by_weight - 1.0).abs() < 1e-12, "{by_weight}");
}

#[test]
fn corrections_are_read() {
    for (text, expected) in [
        ("\"secant\"", ObliqueCorrection::Secant),
        ("\"uncapped\"", ObliqueCorrection::Uncapped),
        ("{ friction = 0.5 }", ObliqueCorrection::Friction(0.5)),
    ] {
        let crush = format!("{FRONT}\nstiffness = {{ category = 1 }}\n{FORCE}\noblique = {text}");
        let [damage, _] = damages(&cars([(YAW, &crush), (YAW, &crush)]));
        assert_eq!(damage.correction, expected);
    }
}

#[test]
fn yaw_inertia_comes_from_the_file_then_the_class_then_burg() {
    let crush = format!("{FRONT}\nstiffness = {{ category = 1 }}\n{FORCE}");
    let inertia = |lines: &str| {
        let file = cars([(lines, &crush), (YAW, &crush)]);
        let [first, _] = file.case.damage().unwrap().vehicles;
        let inertia = first.inertia.unwrap();
        (inertia.yaw_inertia.unwrap(), inertia.yaw_source, first.dimensions)
    };
    let wheelbase = "wheelbase = \"2.6 m\"\nlength = \"4.5 m\"";
    // 0.1269 · 1500 · 2.6 · 4.5
    let (burg, source, dimensions) = inertia(wheelbase);
    assert!((burg - 2_227.095).abs() < 1e-9, "{burg}");
    assert_eq!((source, dimensions), (YawSource::Burg, None));
    // Class 3: 3324 in².
    let (of_class, source, dimensions) = inertia(&format!("class = 3\n{wheelbase}"));
    assert!((of_class - 1500.0 * 3324.0 * 0.0254 * 0.0254).abs() < 1e-9, "{of_class}");
    assert_eq!(source, YawSource::Class(3));
    let dimensions = dimensions.unwrap();
    // Length 196.2 in, width 72.6 in, front 89.8 in from the CG.
    assert_eq!(dimensions.class, Some(3));
    for (side, face, extent) in [
        (Side::Front, 89.8, 72.6),
        (Side::Rear, 196.2 - 89.8, 72.6),
        (Side::Left, 36.3, 196.2),
        (Side::Right, 36.3, 196.2),
    ] {
        assert!((dimensions.face(side) / 0.0254 - face).abs() < 1e-9, "{side:?}");
        assert!((dimensions.extent(side) / 0.0254 - extent).abs() < 1e-9, "{side:?}");
    }
    let outline = "length = \"4.4 m\"\nwidth = \"1.7 m\"\ncg_to_front = \"1.9 m\"";
    let (given, source, dimensions) = inertia(&format!("class = 3\n{YAW}\n{outline}"));
    assert!((given - 1500.0 * 1.4 * 1.4).abs() < 1e-9);
    assert_eq!((source, dimensions.unwrap().class), (YawSource::Given, None));
}

#[test]
fn one_pdof_and_two_headings_give_the_other_pdof() {
    let stiff = "stiffness = { category = 1 }\nmoment_arm = \"0 m\"";
    let [first, second] = vehicles(&cars([
        (&format!("{YAW}\nheading = \"0 deg\""), &format!("{FRONT}\n{stiff}\npdof = \"1 o'clock\"")),
        (
            &format!("{YAW}\nheading = \"90 deg\""),
            &format!("side = \"left\"\nwidth = \"2 m\"\ndepths = \"0.2 0.1 m\"\n{stiff}"),
        ),
    ]));
    // From the scene's −30° on vehicle 1, so from 150° on vehicle 2: 60° to the left of its heading.
    assert!((first.force.pdof.unwrap().to_degrees() - 30.0).abs() < 1e-12);
    assert!((second.force.pdof.unwrap().to_degrees() + 60.0).abs() < 1e-12);
    // And the other way round: vehicle 2 is struck from 60° on its left, so vehicle 1 from 30° on its right.
    let left =
        format!("side = \"left\"\nwidth = \"2 m\"\ndepths = \"0.2 0.1 m\"\n{stiff}\npdof = \"10 o'clock\"");
    let [first, _] = vehicles(&cars([
        (&format!("{YAW}\nheading = \"0 deg\""), &format!("{FRONT}\n{stiff}")),
        (&format!("{YAW}\nheading = \"90 deg\""), &left),
    ]));
    assert!((first.force.pdof.unwrap().to_degrees() - 30.0).abs() < 1e-12);
    // The back of the clock lies in (−180°, 180°]; 12 is straight ahead.
    for (clock, degrees) in
        [("2 o'clock", 60.0), ("6 o’clock", 180.0), ("9  o'clock ", -90.0), ("12 o'clock", 0.0)]
    {
        let crush = format!("{FRONT}\n{stiff}\npdof = \"{clock}\"");
        let [vehicle, _] = vehicles(&cars([(YAW, &crush), (YAW, &crush)]));
        assert!((vehicle.force.pdof.unwrap().to_degrees() - degrees).abs() < 1e-12, "{clock}");
    }
}

fn refusal(file: &CaseFile) -> String {
    file.case.damage().map_err(|error| error.to_string()).unwrap_err()
}

#[test]
fn what_is_missing_is_said() {
    let stiff = "stiffness = { category = 1 }";
    let crush = format!("{FRONT}\n{stiff}\n{FORCE}");
    let no_force = format!("{FRONT}\n{stiff}");
    let only_pdof = format!("{FRONT}\n{stiff}\npdof = \"0 deg\"");
    let inferred = format!("side = \"left\"\nfrom_force_balance = true\n{stiff}\n{FORCE}");
    for (first, key, remedy) in [
        ((YAW, &*no_force), "vehicle1.crush.pdof", "if both have a `heading`"),
        ((YAW, &*only_pdof), "vehicle1.crush.moment_arm", "through the centroid of the damage"),
        (
            ("", &*crush),
            "vehicle1.yaw_inertia",
            "CRASH3's size class, `class = 3`, or both `wheelbase` and `length`",
        ),
        (("wheelbase = \"2.6 m\"", &*crush), "vehicle1.yaw_inertia", "both `wheelbase` and `length`"),
        (
            (YAW, &*inferred),
            "vehicle1.crush.width",
            "to bound it, the vehicle's `length`, `width` and `cg_to_front`, or its `class`",
        ),
    ] {
        let text = refusal(&cars([first, (YAW, &crush)]));
        let missing = format!("`{key}` is missing");
        assert!(text.contains(&missing) && text.contains(remedy), "{key}: {text}");
    }
    // The other's PDOF alone is not enough: both headings are needed.
    let text =
        refusal(&cars([(YAW, &no_force), ("yaw_radius = \"1.4 m\"\nheading = \"0 deg\"", &only_pdof)]));
    assert!(text.contains("`vehicle1.crush.pdof` is missing"), "{text}");
}

#[test]
fn a_crush_that_was_not_measured_has_a_width_or_bounds() {
    let measured = format!("{FRONT}\nstiffness = {{ category = 1 }}\n{FORCE}");
    let inferred =
        format!("side = \"right\"\nfrom_force_balance = true\nstiffness = {{ category = 2 }}\n{FORCE}");
    let width = |vehicle: &str, crush: &str| {
        let [_, damage] = damages(&cars([(YAW, &measured), (vehicle, crush)]));
        let CrushEvidence::ForceBalance { width, .. } = damage.evidence else { panic!("inferred") };
        width
    };
    assert_eq!(width(YAW, &format!("{inferred}\nwidth = \"1.2 m\"")), InferredWidth::Given(1.2));
    let outline = "yaw_radius = \"1.4 m\"\nlength = \"4.4 m\"\nwidth = \"1.8 m\"\ncg_to_front = \"1.9 m\"";
    assert_eq!(width(outline, &inferred), InferredWidth::Bounded { widest: 4.4, deepest: 0.9 });
}

/// The energy has to be known before the impact is solved: the file gives the direction of the force.
#[test]
fn a_reconstruction_with_a_force_balance_needs_a_direction() {
    let measured = format!("{FRONT}\nstiffness = {{ category = 1 }}");
    let inferred =
        "side = \"rear\"\nwidth = \"1.5 m\"\nfrom_force_balance = true\nstiffness = { category = 1 }";
    let reconstruct = |pdof: &str| {
        let text = format!(
            "[vehicle1]\nmass = \"1500 kg\"\n{YAW}\nheading = \"0 deg\"\ncontact = {{ x = \"2 m\", y = \"0 m\" }}\n[vehicle1.crush]\n{measured}\n{pdof}\n\
             [vehicle2]\nmass = \"1500 kg\"\n{YAW}\nheading = \"0 deg\"\nspeed = \"0 m/s\"\ncontact = {{ x = \"-2 m\", y = \"0 m\" }}\n[vehicle2.crush]\n{inferred}\n\
             [impact]\ncrush_plane = \"0 deg\"\nrestitution = 0\ntangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n"
        );
        CaseFile::parse("rear-end.toml", &text)
            .unwrap()
            .case
            .reconstruction()
            .map_err(|error| error.to_string())
    };
    let text = reconstruct("").unwrap_err();
    assert!(
        text.contains("`vehicle1.crush.pdof` is missing") && text.contains("which the force balance needs"),
        "{text}"
    );
    let input = reconstruct("pdof = \"0 deg\"").unwrap();
    let pdof = input.collision.vehicles.map(|vehicle| vehicle.force.pdof.unwrap());
    assert_eq!(pdof[0], 0.0);
    assert!((pdof[1] - std::f64::consts::PI).abs() < 1e-15);
    assert!(
        reconstruct("oblique_angle = \"0 deg\"").unwrap_err().contains("`vehicle2.crush.pdof` is missing")
    );
}
