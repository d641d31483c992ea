//! A contact point that the program places: where it lies, what it does to the answer, and how far it is off.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking"
)]
#![expect(clippy::disallowed_methods, reason = "an oracle shares no function with what it judges")]

use std::ops::ControlFlow;

use analysis::quantities::IMPACT_CLOSING_SPEED;
use analysis::{
    Analysis, Assumption, ExactValue, Plan, Sweep, Uncertainty, Warning, crush, impact, judge, reconstruct,
    sensitivity, uncertainty,
};
use case::{CaseFile, to_toml};
use inputs::{Case, ContactSpread, EstimatedInput, FaceAxis, Origin};
use pim_core::VehicleId;
use proptest::prelude::*;
use uncertainty::{Lanes, Sampler, SamplingMethod, Settings, Shape};

const PLACED: &str = include_str!("../../../fixtures/contact-placed.toml");

const SIDES: [&str; 4] = ["front", "rear", "left", "right"];

fn read(text: &str) -> Case {
    CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
}

/// A damage on a body of 4.4 m by 1.8 m whose front is 1.9 m before its CG.
#[derive(Clone, Debug)]
struct Damaged {
    side: usize,
    offset: f64,
    width: f64,
    depths: Vec<f64>,
}

impl Damaged {
    /// (m) forward and left of the CG: each strip of the damage by the energy that crushed it, in the middle
    /// of its depth. By Gauss's rule of three points in each zone, which is exact: the energy is a square of
    /// the depth, and the depth is linear.
    fn centroid(&self) -> [f64; 2] {
        let spacing = self.width / (self.depths.len() as f64 - 1.0);
        let (mut energy, mut along, mut deep) = (0.0, 0.0, 0.0);
        for (zone, ends) in self.depths.windows(2).enumerate() {
            for (at, weight) in [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)] {
                let share = f64::midpoint(1.0, at);
                let depth = ends[0] + (ends[1] - ends[0]) * share;
                // (A + B C)²/2B, with the A and B of `lines`
                let strip = weight * (50e3 + 600e3 * depth).powi(2);
                energy += strip;
                along += strip * (zone as f64 + share) * spacing;
                deep += strip * depth / 2.0;
            }
        }
        let (along, depth) = (along / energy - self.width / 2.0, deep / energy);
        match SIDES[self.side] {
            // As the driver sees them: left to right in front and behind, rear to front on the sides.
            "front" => [1.9 - depth, self.offset - along],
            "rear" => [-2.5 + depth, self.offset - along],
            "left" => [self.offset + along, 0.9 - depth],
            _ => [self.offset + along, -0.9 + depth],
        }
    }

    /// Its lines; what is lateral has the sign `y`.
    fn lines(&self, y: f64) -> String {
        let depths: Vec<String> = self.depths.iter().map(f64::to_string).collect();
        let offset = if self.side < 2 { y * self.offset } else { self.offset };
        format!(
            "side = \"{}\"\nwidth = \"{} m\"\ndepths = \"{} m\"\noffset = \"{offset} m\"\n\
             stiffness = {{ A = \"50 kN/m\", B = \"600 kN/m^2\" }}\n",
            SIDES[self.side],
            self.width,
            depths.join(" ")
        )
    }
}

fn damaged() -> impl Strategy<Value = Damaged> {
    let depths = prop::collection::vec(0.05..0.6, 2..7);
    (0..4_usize, -0.4..0.4, 0.6..1.6, depths).prop_map(|(side, offset, width, depths)| Damaged {
        side,
        offset,
        width,
        depths,
    })
}

/// Vehicle 1 with the first damage against a standing vehicle 2 with the second, squarely against its damaged
/// side. `y` is −1 in z-down axes; `swapped` exchanges the labels.
fn collision([first, second]: &[Damaged; 2], y: f64, swapped: bool, contacts: [&str; 2]) -> String {
    let axes = if y < 0.0 { "[scene]\naxes = \"z-down\"\n" } else { "" };
    // (°) from the heading to the outward normal of a side: the normals are opposite in the scene.
    let normal = |damaged: &Damaged| [0.0, 180.0, 90.0, -90.0][damaged.side];
    let headings = [0.0, 180.0 + normal(first) - normal(second)];
    let plane = normal(first);
    // Towards the other: along the heading where the front is damaged.
    let speeds = [[8.0, 0.0], [-8.0, 0.0], [0.0, 8.0], [0.0, -8.0]][first.side];
    let [one, two] = if swapped { [2, 1] } else { [1, 2] };
    let vehicle = |number: usize, damage: &Damaged, heading: f64, [vx, vy]: [f64; 2], contact: &str| {
        format!(
            "[vehicle{number}]\nmass = \"{} kg\"\nyaw_radius = \"1.3 m\"\nheading = \"{} deg\"\n{contact}\n\
             velocity = {{ x = \"{vx} m/s\", y = \"{} m/s\" }}\nlength = \"4.4 m\"\nwidth = \"1.8 m\"\n\
             cg_to_front = \"1.9 m\"\n[vehicle{number}.crush]\n{}",
            if number == one { 1300 } else { 1600 },
            y * heading,
            y * vy,
            damage.lines(y)
        )
    };
    format!(
        "{axes}{}{}[impact]\ncrush_plane = \"{} deg\"\nrestitution = 0.1\ntangential = {{ friction = 0.5 }}\n",
        vehicle(one, first, headings[0], speeds, contacts[0]),
        vehicle(two, second, headings[1], [0.0, 0.0], contacts[1]),
        y * (plane + 4.0)
    )
}

fn points(analysis: &Analysis) -> [[f64; 2]; 2] {
    analysis.vehicles.each_ref().map(|vehicle| vehicle.subject.contact.unwrap())
}

fn delta_v(analysis: &Analysis) -> [f64; 2] {
    analysis.impact.as_ref().unwrap().outcome.delta_v_magnitude()
}

fn yaw_rates(analysis: &Analysis) -> [f64; 2] {
    analysis.impact.as_ref().unwrap().outcome.after.map(|motion| motion.yaw_rate)
}

fn close(what: &str, found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{what}: {found} instead of {expected}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_point_is_the_centroid_of_the_crush_energy(damages in [damaged(), damaged()]) {
        let analysis = impact(&read(&collision(&damages, 1.0, false, [""; 2]))).unwrap();
        for (point, damaged) in points(&analysis).into_iter().zip(&damages) {
            let [forward, left] = damaged.centroid();
            close("forward", point[0], forward, 1e-12);
            close("left", point[1], left, 1e-12);
        }
    }

    /// The same collision in other axes and with its labels exchanged.
    #[test]
    fn mirrored_and_with_labels_swapped_it_is_the_same(damages in [damaged(), damaged()]) {
        let analysis = impact(&read(&collision(&damages, 1.0, false, [""; 2]))).unwrap();
        let down = read(&collision(&damages, -1.0, false, [""; 2]));
        prop_assert_eq!(points(&analysis), points(&impact(&down).unwrap()), "the engine has one frame");
        let seen = impact(&down).unwrap().seen(down.axes);
        for (vehicle, seen) in analysis.vehicles.iter().zip(&seen.vehicles) {
            let [x, y] = vehicle.subject.contact.unwrap();
            prop_assert_eq!(seen.subject.contact, Some([x, -y]));
        }
        let assumed = judge(&down).assumptions;
        for (vehicle, [x, y]) in VehicleId::ALL.into_iter().zip(points(&analysis)) {
            let expected = Assumption::ContactPlaced { vehicle, point: [x, -y] };
            prop_assert!(assumed.contains(&expected), "{:?} in {:?}", expected, assumed);
        }
        let swapped = impact(&read(&collision(&damages, 1.0, true, [""; 2]))).unwrap();
        let [one, two] = delta_v(&analysis);
        let [of_two, of_one] = delta_v(&swapped);
        close("ΔV of 1", of_one, one, 1e-9 * one);
        close("ΔV of 2", of_two, two, 1e-9 * two);
        let [one, two] = yaw_rates(&analysis);
        let [of_two, of_one] = yaw_rates(&swapped);
        close("Ω of 1", of_one, one, 1e-9);
        close("Ω of 2", of_two, two, 1e-9);
    }

    /// All numbers of the answer, bit for bit.
    #[test]
    fn a_point_that_is_written_out_gives_the_same(damages in [damaged(), damaged()], y in prop::sample::select(vec![1.0, -1.0])) {
        let placed = impact(&read(&collision(&damages, y, false, [""; 2]))).unwrap();
        let written = points(&placed).map(|[forward, left]| {
            format!("contact = {{ x = \"{forward} m\", y = \"{} m\" }}", y * left)
        });
        let written = written.each_ref().map(String::as_str);
        let given = impact(&read(&collision(&damages, y, false, written))).unwrap();
        prop_assert_eq!(format!("{:?}", placed.impact), format!("{:?}", given.impact));
        prop_assert_eq!(format!("{:?}", placed.crash3), format!("{:?}", given.crash3));
        prop_assert_eq!(format!("{:?}", placed.checks), format!("{:?}", given.checks));
        let arms = |analysis: &Analysis| analysis.vehicles.each_ref().map(|vehicle| vehicle.moment_arm());
        prop_assert_eq!(arms(&placed), arms(&given));
        // Only the statement of its origin differs.
        let mut warnings = placed.warnings.clone();
        warnings.retain(|warning| !matches!(warning, Warning::ContactPlaced { .. }));
        prop_assert_eq!(warnings.len() + 2, placed.warnings.len());
        prop_assert_eq!(warnings, given.warnings);
    }
}

/// The unit vectors of [`FaceAxis`] in the vehicle: along the face in the sense of the offset, and inward.
fn directions(side: usize) -> [[f64; 2]; 2] {
    match SIDES[side] {
        "front" => [[0.0, 1.0], [-1.0, 0.0]],
        "rear" => [[0.0, 1.0], [1.0, 0.0]],
        "left" => [[1.0, 0.0], [0.0, -1.0]],
        _ => [[1.0, 0.0], [0.0, 1.0]],
    }
}

/// A sample moves the point as if an engineer had written it a little farther along the face or deeper.
#[test]
fn a_departure_moves_the_point_along_the_face_and_into_the_vehicle() {
    for (side, y) in (0..4).flat_map(|side| [(side, 1.0), (side, -1.0)]) {
        let damages = [
            Damaged { side, offset: 0.15, width: 1.3, depths: vec![0.1, 0.3, 0.4] },
            Damaged { side: 2, offset: -0.3, width: 1.5, depths: vec![0.2, 0.3, 0.1] },
        ];
        let case = read(&collision(&damages, y, false, [""; 2]));
        let [[forward, left], _] = points(&impact(&case).unwrap());
        for axis in FaceAxis::ALL {
            let moved = case.map(|input| match input.origin {
                Origin::Estimate(EstimatedInput::Contact { vehicle: VehicleId::One, axis: of })
                    if of == axis =>
                {
                    0.07
                }
                _ => input.number,
            });
            let [[moved_forward, moved_left], _] = points(&impact(&moved).unwrap());
            let [df, dl] = directions(side)[axis.index()];
            // On front and rear, along is along y, which points to the right in z-down axes.
            let sign = if axis == FaceAxis::Along && side < 2 { y } else { 1.0 };
            close("forward", moved_forward, forward + 0.07 * df, 1e-12);
            close("left", moved_left, left + sign * 0.07 * dl, 1e-12);
        }
    }
}

/// Derivatives by the two directions: those by the given point, turned into them.
#[test]
fn derivatives_by_the_directions_are_those_by_the_point() {
    const NO_SWEEP: Sweep = Sweep { step: 0.1, steps: 0 };
    let case = read(PLACED);
    let placed = sensitivity(&case, NO_SWEEP).unwrap();
    let mut text = PLACED.to_owned();
    for (vehicle, [forward, left]) in [1, 2].into_iter().zip(points(&placed.nominal)) {
        let head = format!("[vehicle{vehicle}]\n");
        let contact = format!("{head}contact = {{ x = \"{forward} m\", y = \"{left} m\" }}\n");
        text = text.replace(&head, &contact);
    }
    let given = sensitivity(&read(&text), NO_SWEEP).unwrap();
    let mut compared = 0;
    for row in &placed.derivatives {
        let Origin::Estimate(EstimatedInput::Contact { vehicle, axis }) = row.input.origin else { continue };
        let by = |key: &str| {
            let path = format!("vehicle{vehicle}.contact.{key}");
            let mut rows = given.derivatives.iter();
            rows.find(|other| other.output == row.output && other.input.path == path).unwrap().value
        };
        let side = if vehicle == VehicleId::One { 0 } else { 2 };
        let [df, dl] = directions(side)[axis.index()];
        let expected = by("x") * df + by("y") * dl;
        close(&row.input.path, row.value, expected, 1e-9 * expected.abs());
        // The influence is that of 1 cm.
        close("influence", row.influence(), 0.01 * expected / row.output_value, 1e-12);
        compared += 1;
    }
    // Speed and both ΔV by two directions of two vehicles.
    assert_eq!(compared, 12);
}

fn plan(samples: usize) -> Plan {
    Plan { settings: Settings::new(SamplingMethod::MonteCarlo, samples, 1), index_rows: None }
}

fn run(case: &Case) -> Uncertainty {
    uncertainty(case, &plan(64), &mut |_, _, _| ControlFlow::Continue(())).unwrap()
}

/// (m) the standard deviations along the face and across it of the point of vehicle 1; `None` where it has
/// none of its own.
fn default_sds(result: &Uncertainty) -> [Option<f64>; 2] {
    FaceAxis::ALL.map(|wanted| {
        let is_it = |origin| {
            matches!(origin, Origin::Estimate(EstimatedInput::Contact { vehicle: VehicleId::One, axis }) if axis == wanted)
        };
        let input = result.inputs.iter().find(|input| is_it(input.input.origin))?;
        let Shape::Normal { mean, sd } = input.distribution.shape() else { panic!("normal") };
        assert_eq!(mean, 0.0);
        Some(sd * input.input.factor())
    })
}

/// Smith and Noga: 1.8 in of the offset, 3.0 in of the length, 1.5 in of a depth. √(1.8² + 1.5²) in =
/// 2.34307 in = 59.514 mm.
#[test]
fn the_default_error_counts_nothing_twice() {
    let (both, offset, depth) = (0.059_514, 0.045_72, 0.0381);
    let width = "width     = { value = \"150 cm\", sd = \"2 cm\" }";
    let of_offset = "offset    = { value = \"-6 cm\", sd = \"2 cm\" }";
    let depths = "depths    = { values = \"12 18 24 26 30 34 cm\", sd = \"1 cm\" }";
    let with = |changes: &[(&str, &str)]| {
        changes.iter().fold(PLACED.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replacen(old, new, 1)
        })
    };
    let (old_width, old_offset) = ("width     = \"150 cm\"", "offset    = \"-6 cm\"");
    let old_depths = "depths    = \"12 18 24 26 30 34 cm\"";
    let exact = "[uncertainty]\nexact = [\"vehicle1.contact\"]\n\n[vehicle1]";
    let tape = "[[uncertainty.shared]]\nname = \"tape\"\nof = [\"vehicle1.crush.depths\"]\nsd = \"1 cm\"\n\n[vehicle1]";
    for (text, expected, listed) in [
        (with(&[]), [Some(both), Some(depth)], false),
        (with(&[(old_width, width)]), [Some(offset), Some(depth)], false),
        (with(&[(old_offset, of_offset)]), [None, Some(depth)], false),
        (with(&[(old_width, width), (old_offset, of_offset)]), [None, Some(depth)], false),
        (with(&[(old_depths, depths)]), [Some(both), None], false),
        (with(&[("[vehicle1]", tape)]), [Some(both), None], false),
        (with(&[(old_offset, of_offset), (old_depths, depths)]), [None, None], false),
        (with(&[("[vehicle1]", exact)]), [None, None], true),
        (with(&[("[vehicle1]", exact), (old_offset, of_offset)]), [None, None], true),
    ] {
        let case = read(&text);
        let result = run(&case);
        for (found, expected) in default_sds(&result).into_iter().zip(expected) {
            assert_eq!(found.is_some(), expected.is_some(), "{text}");
            close("sd", found.unwrap_or_default(), expected.unwrap_or_default(), 1e-6);
        }
        let contact: Vec<_> =
            result.taken_as_exact.iter().filter(|exact| exact.key == "vehicle1.contact").collect();
        assert_eq!(contact.len(), usize::from(listed), "{text}");
        assert!(contact.iter().all(|exact| matches!(exact.value, ExactValue::Estimate(_))));
        // The warning says the same.
        let warnings = &result.nominal.warnings;
        let said = warnings.iter().find_map(|warning| match warning {
            Warning::ContactPlaced { vehicle: VehicleId::One, spread, .. } => Some(*spread),
            _ => None,
        });
        for (spread, expected) in said.unwrap().into_iter().zip(expected) {
            match (spread, expected) {
                (ContactSpread::Default(sd), Some(expected)) => close("said", sd, expected, 1e-6),
                (ContactSpread::OfInputs | ContactSpread::Exact, None) => {}
                other => panic!("{other:?}: {text}"),
            }
        }
    }
}

/// The error of the offset is in that of the point, so that it is not listed as left out.
#[test]
fn an_offset_is_exact_only_where_the_point_is() {
    let lists = |text: &str| {
        let keys = run(&read(text)).taken_as_exact;
        keys.iter().any(|exact| exact.key == "vehicle1.crush.offset")
    };
    assert!(!lists(PLACED));
    assert!(lists(&PLACED.replacen(
        "[vehicle1]",
        "[uncertainty]\nexact = [\"vehicle1.contact\"]\n[vehicle1]",
        1
    )));
}

/// Sample by sample: the answer is that of a file with the moved points.
#[test]
fn a_sample_is_a_case_with_the_point_moved() {
    let result = run(&read(PLACED));
    let distributions: Vec<_> = result.inputs.iter().map(|input| input.distribution).collect();
    let mut columns = vec![Lanes::ZERO; distributions.len()];
    Sampler::new(&distributions, &result.settings).unwrap().fill(0, &mut columns);
    let column =
        |path: &str| columns[result.inputs.iter().position(|input| input.input.path == path).unwrap()];
    let place = result
        .outputs
        .iter()
        .position(|output| output.output == IMPACT_CLOSING_SPEED.of_collision())
        .unwrap();
    for lane in [0, 5, 31, 63] {
        let mut text = PLACED.replace(
            "{ value = \"32 km/h\", sd = \"2 km/h\" }",
            &format!("\"{} km/h\"", column("vehicle2.speed")[lane]),
        );
        // Class 3: k² = 3324 in². Category 3 of a side: A = 173 lb/in, B = 57 lb/in², G = 263 lb.
        let radius = 3324.0_f64.sqrt() * column("vehicle2.yaw_radius.factor")[lane];
        let factor = column("vehicle2.crush.stiffness.factor")[lane];
        let b = factor.powf(0.59 / 0.38);
        let stiffness = format!(
            "{{ A = \"{} lb/in\", B = \"{} lb/in^2\", G = \"{} lb\" }}",
            173.0 * factor,
            57.0 * b,
            263.0 * factor * factor / b
        );
        text = text
            .replace("class   = 3", &format!("class = 3\nyaw_radius = \"{radius} in\""))
            .replace("{ category = 3 }", &stiffness);
        // The energy of each strip places the point, so that it moves with the stiffness.
        let placed = points(&reconstruct(&read(&text)).unwrap());
        for (vehicle, (side, [forward, left])) in [1, 2].into_iter().zip([0, 2].into_iter().zip(placed)) {
            let [[af, al], [df, dl]] = directions(side);
            // The file gives the offsets in cm.
            let [along, deep] = ["along", "inward"]
                .map(|axis| column(&format!("vehicle{vehicle}.contact.{axis}"))[lane] / 100.0);
            let [x, y] = [forward + along * af + deep * df, left + along * al + deep * dl];
            let head = format!("[vehicle{vehicle}]\n");
            text = text.replace(&head, &format!("{head}contact = {{ x = \"{x} m\", y = \"{y} m\" }}\n"));
        }
        let expected = reconstruct(&read(&text)).unwrap().impact.unwrap().outcome.closing_speed();
        let found = result.propagation.columns()[place][lane];
        close("closing speed", found, expected, 1e-9 * expected);
    }
}

#[test]
fn each_analysis_says_what_it_does() {
    let case = read(PLACED);
    let codes = |warnings: &[Warning]| -> Vec<&'static str> { warnings.iter().map(Warning::code).collect() };
    let count = |codes: &[&str], code: &str| codes.iter().filter(|other| **other == code).count();
    for codes in [codes(&reconstruct(&case).unwrap().warnings), codes(&judge(&case).warnings)] {
        assert_eq!(count(&codes, "contact-placed"), 2, "{codes:?}");
        assert_eq!(count(&codes, "damage-centroid"), 0, "{codes:?}");
    }
    // What is written back has no point.
    assert!(!to_toml(&case).contains("contact ="));
    assert!(case.values().iter().all(|(path, _)| !path.contains(".contact")));
    // The damage alone lets the force act through the centroid, as before.
    let alone = PLACED.replace("offset    = \"40 cm\"", "offset = \"40 cm\"\npdof = \"-76 deg\"");
    let alone = alone.split("[impact]").next().unwrap();
    let analysis = crush(&read(alone)).unwrap();
    let codes = codes(&analysis.warnings);
    assert_eq!((count(&codes, "contact-placed"), count(&codes, "damage-centroid")), (0, 2), "{codes:?}");
    assert!(analysis.vehicles.iter().all(|vehicle| vehicle.subject.contact.is_none()));
    assert!(
        read(alone).estimates().iter().all(|estimate| !matches!(estimate, EstimatedInput::Contact { .. }))
    );
    assert!(
        judge(&read(alone)).assumptions.iter().all(|one| !matches!(one, Assumption::ContactPlaced { .. }))
    );
}

/// The keys that the error of a missing point offers instead do place the point.
#[test]
fn what_is_missing_to_place_the_point_is_said() {
    let advice = |text: &str| {
        let faults = read(text).reconstruction().unwrap_err();
        let fault = faults.list().iter().find(|fault| fault.key == "vehicle1.contact").unwrap().clone();
        fault.advice.unwrap()
    };
    let offset = PLACED.replacen("offset    = \"-6 cm\"", "", 1);
    let said = advice(&offset);
    assert!(
        said.ends_with(
            "give in its place `offset = \"12 in\"` in [vehicle1.crush], the middle of the damage from the \
             vehicle's axis: C is then placed at the centroid of the damage"
        ),
        "{said}"
    );
    let said = advice(&PLACED.replacen("cg_to_front = \"2.05 m\"", "", 1).replacen(
        "length      = \"4.40 m\"\nwidth       = \"1.76 m\"\n",
        "",
        1,
    ));
    assert!(
        said.contains("give in its place `length`, `width` and `cg_to_front`, or `class`: C is"),
        "{said}"
    );
    // On a side, an offset is not counted from the vehicle's axis.
    let side = offset.replacen("side      = \"front\"", "side = \"right\"", 1);
    assert!(advice(&side).contains("the middle of the damage forward of the centre of gravity: C is"));
    // Where the crush is not known, nothing places the point.
    for crush in ["crush = \"none\"\n[vehicle2]", "[vehicle1.crush]\nees = \"30 km/h\"\n\n[vehicle2]"] {
        let (head, tail) = PLACED.split_once("[vehicle1.crush]").unwrap();
        let (_, tail) = tail.split_once("[vehicle2]").unwrap();
        let said = advice(&format!("{head}{crush}{tail}"));
        assert!(said.ends_with("`contact = { x = \"1.78 m\", y = \"-0.73 m\" }`"), "{said}");
    }
    // Nor where it is inferred from the force.
    let inferred = PLACED.replacen(
        "depths    = \"12 18 24 26 30 34 cm\"",
        "from_force_balance = true\npdof = \"13 deg\"",
        1,
    );
    assert!(!advice(&inferred).contains("in its place"));
}
