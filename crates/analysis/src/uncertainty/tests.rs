use std::collections::{BTreeMap, BTreeSet};

use super::lanes::Alone;
use super::{REASONS, Reason, Sample, UncertainInput, beside, central, inputs};
use crate::columns::tests::{AnyCase, FORMS, any_case};
use crate::goal::Goal;
use crate::output::Output;
use crate::{Analysis, reconstruct};
use ::uncertainty::{
    Distribution, Instructions, LANES, Lanes, Model, Sampler, SamplingMethod, Settings, propagate,
};
use case::{CaseFile, to_toml};
use inputs::{Amount, Bounds, Case, Range, Spread};
use pim_core::VehicleId;
use std::fmt::Display;
use std::ops::ControlFlow;

const UNCERTAIN: &str = include_str!("../../../../fixtures/sae-980025-uncertain.toml");
const CATEGORIES: &str = include_str!("../../../../fixtures/t-bone-category.toml");
const EES: &str = include_str!("../../../../fixtures/ees.toml");
const BARRIER: &str = include_str!("../../../../fixtures/barrier.toml");
const CERTAIN: &str = include_str!("../../../../fixtures/sae-980025.toml");

#[test]
fn directions_are_counted_on_beyond_half_a_turn() {
    assert!((beside(-3.1, 3.1) - 3.183_185_307).abs() < 1e-9); // 2π − 3.1
    assert!((beside(3.1, -3.1) + 3.183_185_307).abs() < 1e-9);
    assert_eq!(beside(0.3, -0.2), 0.3);
}

#[test]
fn reasons_have_codes_of_their_own() {
    for reason in REASONS {
        assert_eq!(Reason::of_code(reason.code()), reason);
    }
    assert_eq!(Reason::of_code(::uncertainty::NOT_FINITE), Reason::Other);
}

/// A case with everything that is needed to sample it.
struct Sampled {
    case: Case,
    inputs: Vec<UncertainInput>,
    outputs: Vec<Output>,
    central: Vec<f64>,
    nominal: Analysis,
}

impl Sampled {
    fn new(text: &str) -> Self {
        Self::of(CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case)
    }

    fn of(case: Case) -> Self {
        let solved = Goal::of(&case).solve(&case);
        let nominal = solved.unwrap_or_else(|failure| panic!("{failure}\n{}", to_toml(&case)));
        let outputs = Output::of(&nominal, case.axes);
        let central = central(&nominal, &outputs, case.axes);
        Self { inputs: inputs(&case).unwrap(), central, outputs, case, nominal }
    }

    fn sample(&self) -> Sample<'_> {
        Sample::new(&self.case, &self.nominal, &self.inputs, &self.outputs, &self.central)
    }

    fn distributions(&self) -> Vec<Distribution> {
        self.inputs.iter().map(|input| input.distribution).collect()
    }
}

/// A restitution curve with a corner where most samples have their speed.
const CURVE: &str = "{ speeds = [\"4 m/s\", { value = \"18 m/s\", sd = \"1 m/s\" }, \"22 m/s\", \"26 m/s\"], \
                     values = [0.5, { value = 0.3, sd = 0.05 }, 0.25, { value = 0.1, sd = 0.05 }] }";
const FRICTION: &str = "{ friction = { value = 0.4, sd = 0.1 } }";

/// The paper's example, and the same in every other form that a block supports.
fn shapes() -> Vec<(&'static str, String)> {
    let changed = |changes: &[(&str, &str)]| {
        changes.iter().fold(UNCERTAIN.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        })
    };
    let law = |tangential: &str| changed(&[("\"critical\"", tangential)]);
    let share =
        |text: &str| text.replace("\"dissipated\"", "{ tangential_share = { value = 0.5, sd = 0.3 } }");
    let curve = |points: &str, tangential: &str| {
        changed(&[("{ low = 0.2, high = 0.4 }", points), ("\"critical\"", tangential)])
    };
    let stiffness = "stiffness = { d0 = { value = \"30 lb^0.5\", within = \"20 %\", confidence = 0.95 }, \
                     d1 = { value = \"77.5 lb^0.5/ft\", within = \"10 %\", confidence = 0.95 } }";
    let a_b = "stiffness = { A = { value = \"140 lb/in\", sd = \"10 lb/in\" }, B = { value = \"42 psi\", sd = \"4 psi\" } }";
    let a_b_g = "stiffness = { A = { value = \"140 lb/in\", sd = \"10 lb/in\" }, B = \"42 psi\", G = { value = \"233 lb\", sd = \"9 lb\" } }";
    // Some samples have a limit below A, and some a no-damage speed above the test speed.
    let a_b_limit = "stiffness = { A = { value = \"140 lb/in\", sd = \"10 lb/in\" }, B = \"42 psi\", limit = { value = \"300 lb/in\", sd = \"100 lb/in\" } }";
    let test = "stiffness = { test = { mass = { value = \"1500 kg\", sd = \"50 kg\" }, speed = \"56 km/h\", width = { value = \"1.6 m\", sd = \"5 cm\" }, \
                depths = \"42 50 54 54 50 42 cm\", no_damage_speed = { value = \"30 km/h\", sd = \"20 km/h\" } } }";
    let zones = format!(
        "stiffness = {{ zones = [{}] }}",
        [a_b_limit.trim_start_matches("stiffness = "); 5].join(", ")
    );
    let d_g = "stiffness = { d0 = \"30 lb^0.5\", d1 = { value = \"77.5 lb^0.5/ft\", sd = \"5 lb^0.5/ft\" }, G = { value = \"450 lb\", sd = \"9 lb\" } }";
    let speed = "speed       = { low = \"8 mph\", mode = \"10 mph\", high = \"12 mph\" }";
    let otherwise = changed(&[
        (
            "weight      = { value = \"3413 lb\", sd = \"50 lb\" }",
            "mass = { value = \"1548 kg\", sd = \"20 kg\" }",
        ),
        (
            "yaw_inertia = { value = \"2165 lb ft s^2\", within = \"10 %\", confidence = 0.95 }",
            "yaw_radius = { value = \"1.38 m\", sd = \"0.05 m\" }",
        ),
        (
            "contact     = { distance = { value = \"3.8 ft\", sd = \"3 in\" }, angle = { value = \"-39 deg\", sd = \"3 deg\" } }",
            "contact = { x = { value = \"0.9 m\", sd = \"5 cm\" }, y = \"-0.73 m\" }",
        ),
        (
            speed,
            "velocity = { x = { value = \"1.7 m/s\", sd = \"0.2 m/s\" }, y = { value = \"4.1 m/s\", sd = \"0.3 m/s\" } }\nyaw_rate = { value = \"10 deg/s\", sd = \"20 deg/s\" }",
        ),
    ]);
    vec![
        ("as it is", UNCERTAIN.to_owned()),
        ("absorbed", changed(&[("\"dissipated\"", "\"absorbed\"")])),
        ("z-down", format!("{UNCERTAIN}\n[scene]\naxes = \"z-down\"\n")),
        ("mass, radius, x and y, velocity, yaw rate", otherwise.clone()),
        ("the same, z-down", format!("{otherwise}\n[scene]\naxes = \"z-down\"\n")),
        ("A, B", changed(&[(stiffness, a_b)])),
        ("A, B, G", changed(&[(stiffness, a_b_g)])),
        ("d0, d1, G", changed(&[(stiffness, d_g)])),
        ("a limit", changed(&[(stiffness, a_b_limit)])),
        ("a limit, friction", changed(&[(stiffness, a_b_limit), ("\"critical\"", "{ friction = 0.4 }")])),
        ("zones, friction", changed(&[(stiffness, &zones), ("\"critical\"", "{ friction = 0.4 }")])),
        ("a test, friction", changed(&[(stiffness, test), ("\"critical\"", "{ friction = 0.4 }")])),
        (
            "the speed of vehicle 2, Ishikawa",
            changed(&[
                ("find         = \"vehicle1.speed\"", "find = \"vehicle2.speed\""),
                ("\"67 deg\"", "\"10 deg\""),
                ("[vehicle1]\n", "[vehicle1]\nspeed = { value = \"75 ft/s\", sd = \"3 ft/s\" }\n"),
                (&format!("{speed}             # a witness\n"), ""),
                (
                    "tangential  = \"critical\"",
                    "law = \"ishikawa\"\ntangential_restitution = { value = 0.1, sd = 0.3 }",
                ),
            ]),
        ),
        ("a share", changed(&[("\"dissipated\"", "{ tangential_share = { value = 0.5, sd = 0.3 } }")])),
        ("friction", law("{ friction = { value = 0.4, sd = 0.1 } }")),
        ("friction, a share", share(&law("{ friction = { value = 0.4, sd = 0.1 } }"))),
        (
            "friction, a moment",
            law("{ friction = { value = 0.4, sd = 0.1 } }\nmoment_restitution = { value = -0.5, sd = 0.3 }"),
        ),
        ("a fraction", law("{ fraction = { value = 0.8, sd = 0.2 } }")),
        (
            "a fraction, a moment",
            law("{ fraction = { value = 0.8, sd = 0.2 } }\nmoment_restitution = { value = -0.5, sd = 0.3 }"),
        ),
        ("a ratio", law("{ ratio = { value = -0.2, sd = 0.3 } }")),
        (
            "a ratio, z-down",
            format!("{}\n[scene]\naxes = \"z-down\"\n", law("{ ratio = { value = 0.2, sd = 0.3 } }")),
        ),
        ("a moment", law("\"critical\"\nmoment_restitution = { value = -0.5, sd = 0.3 }")),
        (
            "Kudlich and Slibar",
            changed(&[(
                "tangential  = \"critical\"",
                "law = \"kudlich-slibar\"\nfriction = { value = 0.4, sd = 0.1 }",
            )]),
        ),
        (
            "a curve of restitution",
            changed(&[("{ low = 0.2, high = 0.4 }", "{ speeds = \"5 20 m/s\", values = [0.4, 0.2] }")]),
        ),
        ("a curve with many points", curve(CURVE, "\"critical\"")),
        ("a curve, absorbed", curve(CURVE, "\"critical\"").replace("\"dissipated\"", "\"absorbed\"")),
        // Samples with an invalid restitution, and samples whose points do not ascend.
        (
            "a wide curve",
            curve(
                "{ speeds = [{ value = \"20 m/s\", sd = \"4 m/s\" }, \"25 m/s\"], \
                 values = [{ value = 0.4, sd = 0.3 }, { value = 0.1, sd = 0.1 }] }",
                "\"critical\"",
            ),
        ),
        // For some samples, the speed is where the curve turns.
        ("a curve that rises", curve("{ speeds = \"15 22 24 30 m/s\", values = [0.0, 0.7, 0.1, 0.2] }", FRICTION)),
        ("a curve, friction", curve(CURVE, FRICTION)),
        (
            "a curve, friction, a moment",
            curve(CURVE, &format!("{FRICTION}\nmoment_restitution = {{ value = -0.5, sd = 0.3 }}"))
                .replace("\"dissipated\"", "\"absorbed\""),
        ),
        (
            "a curve, Kudlich and Slibar",
            curve(CURVE, "0").replace(
                "tangential  = 0",
                "law = \"kudlich-slibar\"\nfriction = { value = 0.4, sd = 0.1 }",
            ),
        ),
        (
            "a change of velocity",
            changed(&[
                ("restitution = { low = 0.2, high = 0.4 }", ""),
                (
                    "tangential  = \"critical\"",
                    "law = \"woolley\"\ntangential_velocity_change = { value = \"2 m/s\", sd = \"1 m/s\" }",
                ),
            ]),
        ),
        // Samples whose damaged rear would lie ahead of the centre of gravity.
        (
            "an outline",
            changed(&[
                ("[vehicle1]\n", "[vehicle1]\nlength = \"4.4 m\"\nwidth = \"1.7 m\"\ncg_to_front = { value = \"3.5 m\", sd = \"1 m\" }\n"),
                ("side      = \"front\"", "side = \"rear\""),
            ]),
        ),
        // Its point determines the direction of the normal.
        (
            "a fixed object",
            BARRIER.replace(
                "fixed = true",
                "fixed = true\nheading = { value = \"180 deg\", sd = \"60 deg\" }\n\
                 contact = { x = { value = \"1.5 m\", sd = \"1.5 m\" }, y = { value = \"0.2 m\", sd = \"2 m\" } }",
            ),
        ),
        (
            "how the force acted",
            changed(&[(
                "side      = \"right\"",
                "side = \"right\"\noblique = { friction = { value = 0.2, sd = 0.3 } }\n\
                 pdof = { value = \"70 deg\", sd = \"50 deg\" }\noffset = { value = \"10 in\", sd = \"20 in\" }\n\
                 moment_arm = { value = \"2 ft\", sd = \"1 ft\" }",
            )]),
        ),
        (
            "Woolley",
            changed(&[
                ("restitution = { low = 0.2, high = 0.4 }", ""),
                ("tangential  = \"critical\"", "law = \"woolley\""),
            ]),
        ),
        (
            "Woolley's sideswipe, z down",
            changed(&[
                ("[vehicle1]\n", "[scene]\naxes = \"z-down\"\n\n[vehicle1]\n"),
                ("restitution = { low = 0.2, high = 0.4 }", "law = \"woolley\""),
                (
                    "tangential  = \"critical\"",
                    "tangential_velocity_change = { value = \"-5 m/s\", sd = \"4 m/s\" }",
                ),
            ]),
        ),
        // In these, the spreads of the estimates are uncertain, too.
        ("categories and classes", CATEGORIES.replace("{ friction = 0.5 }", "\"critical\"")),
        ("EES and classes", EES.to_owned()),
        (
            "EES, and no damage",
            EES.replace("ees  = { value = \"42 km/h\", sd = \"4 km/h\" }\nside = \"front\"\n", "")
                .replace("[vehicle2.crush]\n", "")
                .replace("[vehicle2]\n", "[vehicle2]\ncrush = \"none\"\n"),
        ),
        (
            "a sideslip",
            changed(&[(speed, &format!("{speed}\nsideslip = {{ value = \"3 deg\", sd = \"9 deg\" }}"))]),
        ),
        // Vehicle 1 is the one whose speed is sought.
        (
            "a direction of travel",
            changed(&[("[vehicle1]\n", "[vehicle1]\nvelocity = { x = \"-20 m/s\", y = \"1 m/s\" }\n")]),
        ),
        // Samples with a negative wheelbase or length, too.
        (
            "Burg's inertia",
            changed(&[(
                "yaw_inertia = { value = \"2165 lb ft s^2\", within = \"10 %\", confidence = 0.95 }",
                "wheelbase = { value = \"2.6 m\", sd = \"1.5 m\" }\nlength = { value = \"4.4 m\", sd = \"2.5 m\" }",
            )]),
        ),
        // Samples with a zone of no width, too.
        (
            "stations that lie apart",
            changed(&[(
                "width     = { value = \"65 in\", sd = \"1 in\" }",
                "spacing   = { values = \"11 15 13 12 14 in\", sd = \"5 in\" }",
            )]),
        ),
        // Samples that do not approach, that pull at each other, or whose speed has next to no effect.
        (
            "wide",
            changed(&[
                ("{ value = \"180 deg\", sd = \"3 deg\" }", "{ low = \"0 deg\", high = \"360 deg\" }"),
                ("{ value = \"-23 deg\", sd = \"3 deg\" }", "{ low = \"-113 deg\", high = \"67 deg\" }"),
                ("{ low = 0.2, high = 0.4 }", "{ value = 0.3, sd = 0.5 }"),
                (speed, "speed = { value = \"10 mph\", sd = \"60 mph\" }"),
            ]),
        ),
    ]
}

/// The reasons of a block of samples, which are the same in both models, as are the bits of all others.
fn same_bits(
    name: &dyn Display,
    sampled: &Sampled,
    columns: &[Lanes],
    models: [&Sample<'_>; 2],
) -> [u8; LANES] {
    let [(outputs, reasons), (expected, expected_reasons)] = models.map(|model| {
        let (mut outputs, mut reasons) = (vec![Lanes::ZERO; sampled.outputs.len()], [0; LANES]);
        model.evaluate(Instructions::best(), columns, &mut outputs, &mut reasons);
        (outputs, reasons)
    });
    assert_eq!(reasons, expected_reasons, "{name}");
    for (output, (column, expected)) in outputs.iter().zip(expected).enumerate() {
        for lane in (0..LANES).filter(|lane| reasons[*lane] == 0) {
            assert_eq!(column[lane].to_bits(), expected[lane].to_bits(), "{name}, output {output}");
        }
    }
    reasons
}

/// With and without a block, sample by sample: also if it fails, and far out in the ranges.
#[test]
fn a_block_has_the_bits_of_its_samples() {
    let mut reasons_seen = BTreeSet::new();
    for (name, text) in shapes() {
        let sampled = Sampled::new(&text);
        let in_blocks = sampled.sample();
        let block = in_blocks.block.as_ref().unwrap_or_else(|why| panic!("{name}: no block, {why:?}"));
        let one_by_one = Sample { block: Err(Alone::Incomplete), ..sampled.sample() };
        let distributions = sampled.distributions();
        let settings = Settings::new(SamplingMethod::LatinHypercube, 40 * LANES, 7);
        let sampler = Sampler::new(&distributions, &settings).unwrap();
        let mut columns = vec![Lanes::ZERO; distributions.len()];
        let mut answered = 0;
        for number in 0..40 {
            sampler.fill(number, &mut columns);
            let reasons = same_bits(&name, &sampled, &columns, [&in_blocks, &one_by_one]);
            let mut scratch = vec![Lanes::ZERO; sampled.outputs.len()];
            let mut scratch_reasons = [0; LANES];
            let by_block = block.evaluate(Instructions::best(), &columns, &mut scratch, &mut scratch_reasons);
            let has_answer = |(is_settled, reason)| is_settled && reason == 0;
            answered += by_block.into_iter().zip(scratch_reasons).filter(|lane| has_answer(*lane)).count();
            reasons_seen.extend(reasons);
        }
        assert!(answered > 8 * LANES, "{name}: a block answers only {answered} samples");
    }
    assert!(reasons_seen.len() > 1, "{reasons_seen:?}");
}

/// Shapes that a block does not support are left to the single case, with a reason.
#[test]
fn other_shapes_have_no_block() {
    let given = "yaw_inertia = { value = \"2165 lb ft s^2\", within = \"10 %\", confidence = 0.95 }";
    let wheelbase = "yaw_inertia = \"2165 lb ft s^2\"\nwheelbase = { value = \"2.6 m\", sd = \"1 cm\" }";
    let text = UNCERTAIN.replace(given, wheelbase);
    assert_ne!(text, UNCERTAIN);
    assert_eq!(Sampled::new(&text).sample().block.err(), Some(Alone::Unread));
}

/// The fixtures that reconstruct a speed or an impact, except those without an answer. Each number has a
/// standard deviation of this share of it.
fn fixtures(share: f64) -> Vec<(String, Sampled)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut names = Vec::new();
    for part in ["", "laws/", "roots/"] {
        for entry in std::fs::read_dir(folder.join(part)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            names.extend(name.strip_suffix(".toml").map(|name| format!("{part}{name}")));
        }
    }
    names.sort();
    let sampled = |name: String| {
        let text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
        let mut case = CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}")).case;
        case.ranges = case
            .inputs()
            .into_iter()
            .map(|number| {
                let sd = Amount { number: share * number.number.abs() + 1e-6, unit: number.unit };
                Range { path: number.path, spread: Spread::Normal { sd }, bounds: Bounds::None }
            })
            .collect();
        let goal = Goal::of(&case);
        // If only the motion is given, there is no impact to solve.
        let has_impact = goal != Goal::Motion && goal.solve(&case).is_ok();
        has_impact.then(|| (name, Sampled::of(case)))
    };
    names.into_iter().filter_map(sampled).collect()
}

/// Near the numbers of the fixtures, and so far off that many samples have no or another answer.
#[test]
fn blocks_of_fixtures_have_the_bits_of_their_samples() {
    let mut reasons_seen = BTreeSet::new();
    for share in [1e-3, 0.1] {
        for (name, sampled) in fixtures(share) {
            let in_blocks = sampled.sample();
            if in_blocks.block.is_err() {
                continue;
            }
            let one_by_one = Sample { block: Err(Alone::Incomplete), ..sampled.sample() };
            let distributions = sampled.distributions();
            let settings = Settings::new(SamplingMethod::LatinHypercube, 4 * LANES, 7);
            let sampler = Sampler::new(&distributions, &settings).unwrap();
            let mut columns = vec![Lanes::ZERO; distributions.len()];
            for number in 0..4 {
                sampler.fill(number, &mut columns);
                reasons_seen.extend(same_bits(&name, &sampled, &columns, [&in_blocks, &one_by_one]));
            }
        }
    }
    assert!(reasons_seen.len() > 3, "{reasons_seen:?}");
}

/// The fixtures with a range on each of their numbers: which are solved in blocks, and why the others are
/// not. Adding a shape to the blocks moves its fixtures in this list.
#[test]
fn fixtures_go_by_blocks_or_have_a_reason() {
    let mut found: BTreeMap<Option<Alone>, Vec<String>> = BTreeMap::new();
    for (name, sampled) in fixtures(1e-3) {
        found.entry(sampled.sample().block.err()).or_default().push(name);
    }
    let found: Vec<(Option<Alone>, String)> =
        found.into_iter().map(|(why, names)| (why, names.join(" "))).collect();
    let expected = [
        (
            None,
            "barrier contact-placed depths-independent depths-shared ees head-on jump-full jump-sliding laws/ishikawa laws/kudlich-slibar laws/moment \
             laws/restitution-curve laws/woolley laws/woolley-sideswipe leaning-tree lorry no-damage oncoming-sideswipe rear-end \
             roots/curve-ks-noanswer roots/curve-only roots/five-roots roots/fraction-moment roots/fraction0 \
             roots/hidden-root roots/method-label sae-980025 sae-980025-impact sae-980025-uncertain \
              sae-980025-z-down side-impact t-bone-category tangential-share wide-ranges",
        ),
        (Some(Alone::BothSpeeds), "edcrash-tutorial rear-end-rest rear-end-rest-uncertain"),
        (Some(Alone::Incomplete), "one-vehicle"),
    ];
    assert_eq!(found, expected.map(|(why, names)| (why, names.to_owned())), "{found:#?}");
}

/// The paper's example with other lines in place of those that begin with a word, for both vehicles.
fn with_lines(changes: &[(&str, &str)]) -> String {
    let changed = |line: &str| {
        let change = changes.iter().find(|(word, _)| line.split(' ').next() == Some(word));
        format!("{}\n", change.map_or(line, |(_, other)| *other))
    };
    assert!(
        changes.iter().all(|(word, _)| CERTAIN.lines().any(|line| line.starts_with(word))),
        "{changes:?}"
    );
    CERTAIN.lines().map(changed).collect()
}

/// Cases that together have every key that can be a range.
fn cases_of_all_keys() -> Vec<String> {
    let stiffness = |form: &str| with_lines(&[("stiffness", &format!("stiffness = {{ {form} }}"))]);
    let zones = |form: &str| stiffness(&format!("zones = [{}]", vec![format!("{{ {form} }}"); 5].join(", ")));
    let test = |mass: &str| {
        let rest = "speed = \"56 km/h\", width = \"1.6 m\", depths = \"42 50 54 54 50 42 cm\", no_damage_speed = \"8 km/h\"";
        stiffness(&format!("test = {{ {mass}, {rest} }}"))
    };
    let crush = |lines: &str| with_lines(&[("side", &format!("side = \"front\"\n{lines}"))]);
    let tangential = |lines: &str| with_lines(&[("tangential", lines)]);
    let a_b = "A = \"140 lb/in\", B = \"42 psi\"";
    let d0_d1 = "d0 = \"30 lb^0.5\", d1 = \"77.5 lb^0.5/ft\"";
    // A limit that every zone reaches.
    let [g, limit] = ["G = \"450 lb\"", "limit = \"45 kN/m\""];
    // The speed of vehicle 2 is the unknown one.
    let of_speed_2 = |motion: &str| {
        CERTAIN
            .replace("\nspeed  ", "\n# speed")
            .replace("vehicle1.speed", "vehicle2.speed")
            .replace("\"67 deg\"", "\"10 deg\"")
            .replace("[vehicle1]\n", &format!("[vehicle1]\n{motion}\n"))
    };
    let moving = |rest: &str, steer: &str, drag: &str| {
        let tables = |vehicle: &str| {
            format!(
                "[{vehicle}.before]\nskid = {{ length = \"12 m\", friction = 0.7 }}\nspeed = \"15 m/s\"\n[{vehicle}.after]\ndrag = {drag}\nsteer = {steer}\n\
                 rest = {{ x = \"9 m\", y = \"4 m\", {rest} }}\npoints = [{{ x = \"5 m\", y = \"2 m\", heading = \"40 deg\" }}]\n\
                 speed = \"9 m/s\"\ndirection = \"30 deg\"\nyaw_rate = \"1 rad/s\"\n"
            )
        };
        let case =
            with_lines(&[("name", "wheelbase = \"2.6 m\"\ntrack = \"1.5 m\"\ncg_to_front_axle = \"1.2 m\"")]);
        let ground = "[scene]\ncontact = { x = \"1 m\", y = \"2 m\" }\n[surface]\nfriction = 0.7\n\
                      grade = { slope = 0.02, uphill = \"90 deg\" }\n[[surface.zone]]\nfriction = 0.4\n\
                      edge = [{ x = \"0 m\", y = \"9 m\" }, { x = \"9 m\", y = \"9 m\" }]\nside = \"left\"\n";
        format!("{case}\n{}{}{ground}", tables("vehicle1"), tables("vehicle2"))
    };
    let object = |car: VehicleId| {
        format!(
            "[vehicle{car}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"0 deg\"\ncontact = {{ x = \"1.6 m\", y = \"0.2 m\" }}\n\
             [vehicle{car}.crush]\nees = \"8 m/s\"\n[vehicle{}]\nfixed = true\ndiameter = \"30 cm\"\ndeformation_energy = \"15 kJ\"\n\
             [impact]\ncrush_plane = \"5 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n\
             [reconstruct]\nfind = \"vehicle{car}.speed\"\n",
            car.other()
        )
    };
    vec![
        CERTAIN.to_owned(),
        of_speed_2("speed = \"75 ft/s\""),
        moving("heading = \"20 deg\"", "\"5 deg\"", "0.02"),
        moving(
            "turned = \"20 deg\"",
            "[{ time = \"0 s\", angle = \"0 deg\" }, { time = \"1 s\", angle = \"5 deg\" }]",
            "[0.02, \"locked\", 0.02, 0.02]",
        ),
        moving("heading = \"20 deg\"", "\"5 deg\"", "0.02")
            .replace("skid = { length = \"12 m\"", "skid = { from = { x = \"-9 m\", y = \"1 m\" }")
            .replace("drag = 0.02", "drag = 0.02\nfriction = 0.6")
            .replace("wheelbase", "position = { x = \"1 m\", y = \"1 m\" }\nsideslip = \"2 deg\"\nwheelbase"),
        of_speed_2("velocity = { x = \"-75 ft/s\", y = \"1 ft/s\" }"),
        with_lines(&[("speed", "velocity = { x = \"1.7 m/s\", y = \"4.1 m/s\" }")]),
        with_lines(&[
            ("weight", "mass = \"1600 kg\""),
            ("yaw_inertia", "yaw_radius = \"1.4 m\"\nyaw_rate = \"5 deg/s\""),
            ("contact", "contact = { x = \"1.2 m\", y = \"-0.73 m\" }"),
        ]),
        with_lines(&[("name", "length = \"4.4 m\"\nwheelbase = \"2.6 m\"")]),
        with_lines(&[(
            "weight",
            "weight = \"3500 lb\"\nlength = \"4.4 m\"\nwidth = \"1.7 m\"\ncg_to_front = \"2 m\"",
        )]),
        with_lines(&[("width", "spacing = \"13 13 13 13 13 in\"")]),
        with_lines(&[("width", "ees = \"40 km/h\""), ("depths", ""), ("stiffness", "")]),
        crush("offset = \"3 in\""),
        crush("pdof = \"20 deg\""),
        crush("oblique_angle = \"20 deg\""),
        crush("moment_arm = \"2 ft\""),
        crush("oblique = { friction = 0.5 }"),
        stiffness(a_b),
        stiffness(&format!("{a_b}, {g}, {limit}")),
        stiffness(&format!("{d0_d1}, {g}, {limit}")),
        stiffness(&format!("{a_b}, {g}")),
        stiffness(&format!("{d0_d1}, {g}")),
        stiffness(&format!("{a_b}, {limit}")),
        stiffness(&format!("{d0_d1}, {limit}")),
        zones(&format!("{a_b}, {g}, {limit}")),
        zones(&format!("{d0_d1}, {g}, {limit}")),
        test("mass = \"1500 kg\""),
        test("weight = \"3300 lb\""),
        with_lines(&[("restitution", "restitution = { speeds = \"1 30 m/s\", values = [0.4, 0.2] }")]),
        tangential("tangential = { ratio = -0.1 }"),
        tangential("tangential = { fraction = 0.5 }"),
        tangential("tangential = { friction = 0.1 }"),
        tangential("tangential = \"critical\"\nmoment_restitution = -0.9"),
        tangential("law = \"ishikawa\"\ntangential_restitution = 0.1"),
        tangential("law = \"kudlich-slibar\"\nfriction = 0.1"),
        with_lines(&[
            ("restitution", ""),
            ("tangential", "law = \"woolley\"\ntangential_velocity_change = \"-2 m/s\""),
        ]),
        with_lines(&[("energy_basis", "energy_basis = { tangential_share = 0.5 }")]),
        object(VehicleId::One),
        object(VehicleId::Two),
    ]
}

/// The path of a key, without the numbers of elements.
fn key_of(path: &str) -> String {
    path.split(['[', ']']).step_by(2).collect()
}

/// Ends of the keys that have no effect in a block.
const IDLE: [&str; 11] = [
    ".diameter",
    "crush.offset",
    "crush.pdof",
    "crush.oblique_angle",
    "crush.moment_arm",
    "crush.oblique.friction",
    "1.length",
    "2.length",
    "1.width",
    "2.width",
    "cg_to_front",
];

/// Whichever number of a case is the range: a block either gives the bits of its samples and reads that
/// number, or is not available.
#[test]
fn a_block_ignores_no_key() {
    // The keys of questions about the time before the impact do not enter the impact.
    let is_of_impact = |key: &String| !inputs::is_of_avoid(key);
    let mut missing: BTreeSet<String> = case::number_keys().into_iter().filter(is_of_impact).collect();
    let (mut with_block, mut without) = (BTreeSet::new(), BTreeSet::new());
    for text in cases_of_all_keys() {
        let parsed =
            || CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
        for number in parsed().case.inputs() {
            let (path, bounds) = (number.path.clone(), Bounds::None);
            let sd = Amount { number: 0.05 * number.number.abs() + 1e-3, unit: number.unit };
            let mut case = parsed().case;
            case.ranges = vec![Range { path, spread: Spread::Normal { sd }, bounds }];
            let sampled = Sampled::of(case);
            missing.remove(&key_of(&number.path));
            let in_blocks = sampled.sample();
            if in_blocks.block.is_err() {
                without.insert(key_of(&number.path));
                continue;
            }
            with_block.insert(key_of(&number.path));
            let one_by_one = Sample { block: Err(Alone::Incomplete), ..sampled.sample() };
            let distributions = sampled.distributions();
            let settings = Settings::new(SamplingMethod::LatinHypercube, LANES, 7);
            let mut columns = vec![Lanes::ZERO];
            Sampler::new(&distributions, &settings).unwrap().fill(0, &mut columns);
            let key = key_of(&number.path);
            let [results, expected] = [in_blocks, one_by_one].map(|model| {
                let mut outputs = vec![Lanes::ZERO; sampled.outputs.len()];
                let mut reasons = [0; LANES];
                model.evaluate(Instructions::best(), &columns, &mut outputs, &mut reasons);
                // The outputs of a sample without an answer are not read.
                let of_answer = |column: &Lanes| -> [u64; LANES] {
                    std::array::from_fn(|lane| if reasons[lane] == 0 { column[lane].to_bits() } else { 0 })
                };
                (outputs.iter().map(of_answer).collect::<Vec<_>>(), reasons)
            });
            assert!(results == expected, "{}: {text}", number.path);
            let varies = |column: &[u64; LANES]| column.iter().any(|bits| *bits != column[0]);
            let is_idle = IDLE.iter().any(|idle| key.ends_with(idle));
            assert!(results.0.iter().any(varies) != is_idle, "{}: {text}", number.path);
        }
    }
    assert!(missing.is_empty(), "no case has {missing:?}");
    // Both answers were seen, so that the loop above compared something.
    assert!(with_block.contains("vehicle1.crush.spacing") && without.contains("vehicle1.track"));
}

/// Its outputs are those of the list for which a block is compiled.
#[test]
fn a_reconstruction_of_two_vehicles_has_the_outputs_of_a_block() {
    for (text, found) in
        [(CERTAIN.to_owned(), VehicleId::One), (cases_of_all_keys().swap_remove(1), VehicleId::Two)]
    {
        let case = CaseFile::parse("case.toml", &text).unwrap().case;
        assert_eq!(Output::of(&reconstruct(&case).unwrap(), case.axes), Output::of_two_vehicles(found));
    }
}

/// The pin does not show that the result is right, which the tests above do. It guarantees the same bits on
/// every platform, with each instruction set and at every optimisation level. Renew it only for an intended
/// change.
#[test]
fn bits_of_the_example_are_pinned_for_every_instruction_set() {
    let sampled = Sampled::new(UNCERTAIN);
    let hashes = |method: SamplingMethod| {
        let of = |instructions: Instructions| {
            let settings = Settings { instructions, ..Settings::new(method, 4096, 1) };
            let done = &mut |_, _| ControlFlow::Continue(());
            let result = propagate(&sampled.sample(), &sampled.distributions(), &settings, done).unwrap();
            // The original outputs, and those added later.
            let columns = result.columns();
            let (first, later) = columns.split_at(9);
            [first, later].map(hash)
        };
        let mut hashes: Vec<[u64; 2]> = Instructions::available().into_iter().map(of).collect();
        hashes.dedup();
        hashes
    };
    let methods = [SamplingMethod::MonteCarlo, SamplingMethod::LatinHypercube, SamplingMethod::Sobol];
    let pins = [
        [0xED40_4D8E_AB81_E019, 0xC7D7_BD97_403C_5778],
        [0x63A4_DB24_AE8C_724E, 0x78B2_2F94_EAD7_40AF],
        [0x1C58_9480_FF2E_EC8C, 0xB38C_8287_B732_6E95],
    ];
    let found = methods.map(hashes);
    assert!(found == pins.map(|pin| vec![pin]), "{found:#018X?}");
}

/// FNV-1a
fn hash(columns: &[Vec<f64>]) -> u64 {
    let bytes = columns.iter().flatten().flat_map(|value| value.to_bits().to_le_bytes());
    bytes.fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
}

/// Whatever form the inputs of the impact have, a sample of a block has the bits of the single case with its
/// numbers.
#[test]
fn a_block_of_any_case_has_the_bits_of_its_samples() {
    let mut seen = BTreeSet::new();
    for seed in 0..300 {
        let AnyCase { text, forms } = any_case(seed);
        let case = CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}")).case;
        if Goal::of(&case).solve(&case).is_err() {
            continue;
        }
        let sampled = Sampled::of(case);
        let in_blocks = sampled.sample();
        assert!(in_blocks.block.is_ok(), "{:?}: {text}", in_blocks.block.err());
        let one_by_one = Sample { block: Err(Alone::Incomplete), ..sampled.sample() };
        let settings = Settings::new(SamplingMethod::LatinHypercube, LANES, seed);
        let mut columns = vec![Lanes::ZERO; sampled.inputs.len()];
        Sampler::new(&sampled.distributions(), &settings).unwrap().fill(0, &mut columns);
        let reasons = same_bits(&text, &sampled, &columns, [&in_blocks, &one_by_one]);
        if reasons.contains(&0) {
            seen.extend(forms);
        }
    }
    let unseen: Vec<&str> = FORMS.into_iter().filter(|form| !seen.contains(form)).collect();
    assert!(unseen.is_empty(), "{unseen:?}");
}
