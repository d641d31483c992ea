//! The sentences of the warnings: their advice to the reader, in the reader's units and axes.

use analysis::{Drive, JumpSide, Magnitude, Warning};
use case::Basis;
use case::{Axes, StiffnessSource, VehicleKind};
use crash3::Side;
use pim_core::{Switch, VehicleId};
use report::{Supplements, Units, message};

#[track_caller]
fn says(warning: &Warning, axes: Axes, words: &[&str]) {
    let text = message(&warning.seen(axes), Units::Us);
    for word in words {
        assert!(text.contains(word), "{word:?} is not in {text:?}");
    }
}

fn driven(sliding: f64, cause: Drive) -> Warning {
    Warning::SlidingDriven { tangential_work: -1_355.817_948, energy_loss: 13_558.179_48, sliding, cause }
}

/// 1 ft·lb is 1.355817948 J, 1 ft/s is 0.3048 m/s.
#[test]
fn the_sign_that_opposes_the_sliding_is_that_of_the_readers_axes() {
    let along = driven(3.048, Drive::RatioAlong { impulse_ratio: 0.3 });
    let common =
        ["-1,000 ft·lb", "-10.0 % of the energy loss", "friction cannot add energy", "friction limit"];
    says(&along, Axes::ZUp, &common);
    says(
        &along,
        Axes::ZUp,
        &["ratio of 0.3 has", "u_t = 6.82 mph (10.00 ft/s)", "opposes the sliding is negative"],
    );
    says(
        &along,
        Axes::ZDown,
        &["ratio of -0.3 has", "u_t = -6.82 mph (-10.00 ft/s)", "opposes the sliding is positive"],
    );
    let beyond = driven(-3.048, Drive::RatioBeyond { impulse_ratio: 0.5, critical: Some(0.2) });
    says(
        &beyond,
        Axes::ZDown,
        &["ratio of -0.5", "critical ratio of -0.2000", "u_t = 6.82 mph (10.00 ft/s)", "smaller"],
    );
    let nothing = driven(0.0, Drive::RatioWithoutSliding { impulse_ratio: 0.2 });
    says(&nothing, Axes::ZUp, &["there is no sliding", "ratio of 0.2", "friction limit"]);
    let change = driven(-3.048, Drive::Change { change: -0.3048 });
    says(&change, Axes::ZUp, &["change of -0.68 mph (-1.00 ft/s)", "u_t = -6.82 mph (-10.00 ft/s)"]);
}

/// A profile without depth and a stiffness without A mean no force: no ratio of forces is printed, and the
/// warning has none.
#[test]
fn no_force_has_no_ratio() {
    let text = "[vehicle1]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\n\
         contact = { x = \"1.9 m\", y = \"0.3 m\" }\n[vehicle1.crush]\nside = \"front\"\nwidth = \"1.5 m\"\n\
         depths = \"0 0 0 0 cm\"\nstiffness = { A = \"0 N/cm\", B = \"40 N/cm^2\" }\n[vehicle2]\nmass = \"1200 kg\"\n\
         yaw_radius = \"1.3 m\"\nheading = \"180 deg\"\nspeed = \"40 km/h\"\ncontact = { x = \"1.8 m\", y = \"0.2 m\" }\n\
         [vehicle2.crush]\nside = \"front\"\nwidth = \"1.4 m\"\ndepths = \"0 0 0 0 cm\"\n\
         stiffness = { A = \"100 N/cm\", B = \"40 N/cm^2\" }\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.2\n\
         tangential = \"critical\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n";
    let file = case::CaseFile::parse("case.toml", text).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let found = analysis.warnings.iter().find(|warning| matches!(warning, Warning::ForceBalance { .. }));
    says(found.unwrap(), Axes::ZUp, &["follow from the crush differ: 0 lb on vehicle 1, 3,1"]);
    for output in [
        report::results(&file.case, &analysis, Units::Us).text(),
        report::handover(&file, &analysis, Supplements::default(), Units::Us).unwrap().html(),
        report::json(&file, &analysis).unwrap(),
    ] {
        let words: Vec<&str> = output.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(!words.contains(&"inf") && !words.contains(&"NaN") && !words.contains(&"null"), "{output}");
        assert!(!output.contains("ratio of the peak forces"), "{output}");
    }
}

#[test]
fn a_law_that_finds_the_impulse_is_told_of_no_sign() {
    let coupling = driven(3.048, Drive::Coupling);
    says(&coupling, Axes::ZUp, &["-1,000 ft·lb", "No sign is wrong", "check crush plane and contact points"]);
    let text = message(&coupling.seen(Axes::ZUp), Units::Us);
    assert!(!text.contains("friction") && !text.contains("check the sign"), "{text}");
    let turned = |moment_restitution| Warning::RotationDriven {
        moment_work: -1_355.817_948,
        energy_loss: 13_558.179_48,
        moment_restitution,
    };
    says(&turned(0.5), Axes::ZUp, &["-10.0 %", "moment restitution of 0.5", "give 0 or less"]);
    says(&turned(0.0), Axes::ZUp, &["-10.0 %", "leave out `moment_restitution`"]);
}

#[test]
fn a_large_ratio_is_told_of_the_friction_limit_that_there_is() {
    let ratio = |limited| Warning::LargeImpulseRatio { impulse_ratio: -2.41, limited };
    says(
        &ratio(false),
        Axes::ZUp,
        &["μ of -2.41", "or give a friction limit, `tangential = { friction = 0.5 }`"],
    );
    says(&ratio(true), Axes::ZDown, &["μ of 2.41", "and the friction limit"]);
}

/// 1 ft·lb·s is 1.355817948 N·m·s. A fixed object has no yaw rate.
#[test]
fn both_sides_of_a_jump_are_told() {
    let side =
        |normal_work: f64, moment, rate| JumpSide { normal_work, moment, yaw_rates: [Some(rate), None] };
    let limit = Warning::NearJump {
        border: Switch::Limit(0.394_697),
        given: 0.4,
        sides: [
            side(135_581.794_8, Some(13_558.179_48), -2.3204),
            side(271_163.589_6, Some(1_355.817_948), -2.3666),
        ],
    };
    says(
        &limit,
        Axes::ZUp,
        &["a friction limit of 0.3947", "the limit given, 0.4000", "within 1 %", "report both"],
    );
    says(
        &limit,
        Axes::ZUp,
        &[
            "the full impulse gives W_n = 100,000 ft·lb, M = 10,000 ft·lb·s, Ω_1 = -2.320 rad/s;",
            "sliding gives W_n = 200,000 ft·lb, M = 1,000 ft·lb·s, Ω_1 = -2.367 rad/s.",
        ],
    );
    says(&limit, Axes::ZDown, &["of 0.3947", "given, 0.4000", "M = -10,000 ft·lb·s, Ω_1 = 2.320 rad/s;"]);
    let turn = Warning::NearJump {
        border: Switch::Direction(-3.048),
        given: -3.0632,
        sides: [side(135_581.794_8, None, 1.0), side(271_163.589_6, None, -1.0)],
    };
    says(
        &turn,
        Axes::ZUp,
        &[
            "u_t = -6.82 mph (-10.00 ft/s)",
            "the one before the impact, -6.85 mph (-10.05 ft/s)",
            "sliding as in the answer gives W_n = 100,000 ft·lb, Ω_1 = 1.000 rad/s; sliding the other way gives",
        ],
    );
    says(
        &turn,
        Axes::ZDown,
        &["u_t = 6.82 mph (10.00 ft/s)", "the one before the impact, 6.85 mph (10.05 ft/s)"],
    );
}

#[test]
fn what_is_implausible_is_named_with_what_is_usual() {
    for (magnitude, value, usual, words) in [
        (
            Magnitude::Mass,
            453_592.37,
            [45.359_237, 45_359.237],
            ["mass of vehicle 2 is 1,000,000 lb", "but 100 to 100,000 lb is usual"],
        ),
        (
            Magnitude::YawRadius,
            15.24,
            [0.3048, 3.048],
            ["√(I/m) of vehicle 2 is 50.00 ft", "but 1.0 to 10.0 ft is usual"],
        ),
        (
            Magnitude::Speed,
            447.04,
            [0.0, 44.704],
            ["speed of vehicle 2 is 1,000.00 mph", "at most 100 mph is usual"],
        ),
        (
            Magnitude::CrushDepth,
            16.0 * 0.3048,
            [0.0, 2.54],
            ["depth of crush of vehicle 2 is 192.0 in", "at most 100 in is usual"],
        ),
        (
            Magnitude::DamageWidth,
            25.4,
            [0.0, 2.54],
            ["width of the damage of vehicle 2 is 1,000.0 in", "at most 100 in"],
        ),
    ] {
        let warning = Warning::Implausible {
            vehicle: VehicleId::Two,
            magnitude,
            value,
            usual,
            kind: VehicleKind::Car,
            others: Vec::new(),
        };
        says(&warning, Axes::ZUp, &words);
        says(&warning, Axes::ZUp, &["check the unit"]);
    }
    let usual = [0.0, 44.704];
    let found = Warning::Implausible {
        vehicle: VehicleId::One,
        magnitude: Magnitude::SpeedFound,
        value: 447.04,
        usual,
        kind: VehicleKind::Motorcycle,
        others: Vec::new(),
    };
    says(
        &found,
        Axes::ZUp,
        &[
            "the speed found of vehicle 1 is 1,000.00 mph",
            "is usual for a motorcycle",
            "check the units of depths, widths and stiffness, and the angles",
        ],
    );
    for (magnitude, words) in [
        (Magnitude::Length, "the length of vehicle 1 is 32.81 ft"),
        (Magnitude::BodyWidth, "the width of vehicle 1 is 32.81 ft"),
        (Magnitude::TestMass, "the mass in the barrier test of vehicle 1 is 22 lb"),
        (Magnitude::TestSpeed, "the speed in the barrier test of vehicle 1 is 22.37 mph"),
        (Magnitude::TestDepth, "the depth of crush in the barrier test of vehicle 1 is 393.7 in"),
        (Magnitude::TestWidth, "the width of the damage in the barrier test of vehicle 1 is 393.7 in"),
    ] {
        let warning = Warning::Implausible {
            vehicle: VehicleId::One,
            magnitude,
            value: 10.0,
            usual: [0.0, 1.0],
            kind: VehicleKind::Car,
            others: vec![VehicleKind::HeavyTruck, VehicleKind::Trailer],
        };
        let remedy = "is usual for a car; check the unit, or give `kind = \"heavy-truck\"` or `kind = \"trailer\"` if that is what the vehicle is";
        says(&warning, Axes::ZUp, &[words, remedy]);
    }
}

#[test]
fn a_place_is_named_by_side() {
    let off = Warning::ContactOffDamage { vehicle: VehicleId::Two, side: Side::Left, distance: 0.254 };
    says(
        &off,
        Axes::ZUp,
        &["vehicle 2 lies 10.0 in beyond the end of the damage to its left side", "`offset`"],
    );
    for (side, words) in [
        (Side::Front, "behind the centre of gravity, but the damage is to its front"),
        (Side::Rear, "ahead of the centre of gravity, but the damage is to its rear"),
        (Side::Left, "to the right of the vehicle's axis, but the damage is to its left side"),
        (Side::Right, "to the left of the vehicle's axis, but the damage is to its right side"),
    ] {
        let other = Warning::ContactOtherHalf { vehicle: VehicleId::One, side, distance: 0.254 };
        says(&other, Axes::ZUp, &["vehicle 1 lies 10.0 in", words]);
    }
    for (side, words) in [
        (
            Side::Front,
            "24.5 in behind the deepest crush of its front; `contact` is measured from the centre of gravity, so check its unit, and that it is not measured from the bumper",
        ),
        (
            Side::Right,
            "deepest crush of its right side; `contact` is measured from the centre of gravity, so check its unit, and that it is not measured from the side of the body",
        ),
    ] {
        let deep = Warning::ContactDepth { vehicle: VehicleId::One, side, distance: 0.6223 };
        says(&deep, Axes::ZUp, &["the contact point of vehicle 1 lies", words]);
    }
    let outside = Warning::DamageOutside { vehicle: VehicleId::One, side: Side::Rear, distance: 0.254 };
    says(&outside, Axes::ZUp, &["damage to the rear of vehicle 1 reaches 10.0 in beyond"]);
}

#[test]
fn units_and_keys_to_check_are_named() {
    for (source, words) in [
        (StiffnessSource::Coefficients, "units of A and B, and that they are not swapped"),
        (StiffnessSource::Zones, "units of A and B"),
        (StiffnessSource::Roots, "units of d0 and d1"),
        (StiffnessSource::Typical(case::TypicalStiffness::Category(4)), "the category"),
        (StiffnessSource::Typical(case::TypicalStiffness::Fleet), "the damaged side"),
        (StiffnessSource::Test(case::Fit::Exact), "the barrier test"),
    ] {
        let warning = Warning::HighNoDamageSpeed { vehicle: VehicleId::One, speed: 8.9408, source };
        says(&warning, Axes::ZUp, &["b_0 = 20.00 mph", words]);
        let warning = Warning::LowNoDamageSpeed { vehicle: VehicleId::One, speed: 0.089_408, source };
        says(&warning, Axes::ZUp, &["implies damage from as little as b_0 = 0.20 mph", words]);
    }
    says(
        &Warning::UnusualFriction { friction: 45.0 },
        Axes::ZUp,
        &["friction limit is 45,", "0.3 to 1.0", "percentage"],
    );
    let ground =
        Warning::GroundFriction { path: "surface.friction".to_owned(), friction: 0.01, usual: [0.07, 1.2] };
    says(&ground, Axes::ZUp, &["`surface.friction` is 0.01,", "0.07 (smooth ice) to 1.2", "decimal point"]);
    let angle =
        |in_degrees| Warning::LargeAngle { path: "vehicle2.heading".to_owned(), turns: 12.7, in_degrees };
    says(&angle(false), Axes::ZUp, &["`vehicle2.heading` is 12.7 full turns", "did you mean deg?"]);
    says(&angle(true), Axes::ZUp, &["check the number"]);
    let none = Warning::NoResidualCrush { vehicle: VehicleId::One, energy: 1_355.817_948 };
    says(&none, Axes::ZUp, &["vehicle 1 are zero", "1,000 ft·lb", "upper bound"]);
}

#[test]
fn a_wall_has_no_delta_v_and_each_cause_its_own_words() {
    let differs = |restitution| Warning::DeltaVDiffers {
        impact: [Some(3.048), None],
        crash3: [Some(6.096), None],
        restitution,
    };
    says(
        &differs(true),
        Axes::ZUp,
        &["ΔV with the same restitution, 13.64 mph (20.00 ft/s),", "impact's, 6.82 mph (10.00 ft/s)"],
    );
    says(&differs(false), Axes::ZUp, &["ΔV without restitution, 13.64 mph (20.00 ft/s)"]);
    assert!(!message(&differs(true).seen(Axes::ZUp), Units::Us).contains(" and "));
    let backward = |found| Warning::MovesBackward { vehicle: VehicleId::Two, speed: -4.4704, found };
    says(
        &backward(true),
        Axes::ZUp,
        &["the speed found for vehicle 2 is -10.00 mph (-14.67 ft/s)", "the crush energy"],
    );
    says(
        &backward(false),
        Axes::ZUp,
        &["the speed given for vehicle 2 is -10.00 mph (-14.67 ft/s)", "check the sign"],
    );
    let energy = |basis, on_other_basis| Warning::DamageEnergyDiffers {
        normal_work: 1_355.817_948,
        crush_energy: 2_711.635_896,
        basis,
        on_other_basis,
    };
    let bases = &energy(Basis::Dissipated, Some(4_067.453_844));
    says(
        bases,
        Axes::ZUp,
        &["1,000 ft·lb", "2,000 ft·lb on the energy basis `dissipated` (3,000 ft·lb on `absorbed`)"],
    );
    let bases = &energy(Basis::Absorbed, Some(4_067.453_844));
    says(bases, Axes::ZUp, &["2,000 ft·lb on the energy basis `absorbed` (3,000 ft·lb on `dissipated`)"]);
    assert!(!message(&energy(Basis::Dissipated, None).seen(Axes::ZUp), Units::Us).contains("basis"));
}

/// 75 ft/s is 51.1 mph.
#[test]
fn a_computed_restitution_has_no_more_digits_than_anybody_knows() {
    let high = |restitution| Warning::HighRestitution { restitution, closing_speed: 22.86 };
    says(&high(0.589_572_590_500_772_2), Axes::ZUp, &["a restitution of 0.5896 at a closing speed of 51.1"]);
    says(&high(0.35), Axes::ZUp, &["a restitution of 0.35 at"]);
}
