//! How often the intervals of `estimate` hold where both vehicles roll to rest, from the text of the case to
//! the answer: crashes with a known truth, whose rests have the default errors.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "helpers of tests fail by panicking, slow tests print"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "the library's own functions would not be an independent check"
)]

use std::f64::consts::PI;
use std::ops::ControlFlow;

use ::uncertainty::random::{bits, key, unit};
use analysis::quantities::SPEED;
use analysis::{EstimatePlan, estimate, impact};
use case::{Case, CaseFile};
use pim_core::VehicleId;

const DEGREE: f64 = PI / 180.0;

struct Random {
    key: u64,
    next: u64,
}

impl Random {
    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.next += 1;
        low + (high - low) * unit(bits(self.key, self.next))
    }

    /// Box–Muller.
    fn normal(&mut self, mean: f64, sd: f64) -> f64 {
        let [first, second] = [self.uniform(0.0, 1.0), self.uniform(0.0, 1.0)];
        mean + sd * (-2.0 * first.ln()).sqrt() * (2.0 * PI * second).cos()
    }
}

/// The numbers of one crash: the true ones or those of the investigator.
struct Numbers {
    friction: f64,
    mass: [f64; 2],
    yaw_radius: [f64; 2],
    /// (deg)
    heading: [f64; 2],
    contact: [[f64; 2]; 2],
    drag: [f64; 2],
    /// (deg)
    crush_plane: f64,
    restitution: f64,
    impulse_ratio: f64,
}

impl Numbers {
    /// The values that the investigator writes down for every crash in which they are not measured.
    const USUAL: Self = Self {
        friction: 0.7,
        mass: [1450.0, 1280.0],
        yaw_radius: [1.37, 1.30],
        heading: [0.0, 90.0],
        contact: [[1.95, 0.0], [0.2, 0.68]],
        drag: [0.2, 0.2],
        crush_plane: 180.0,
        restitution: 0.1,
        impulse_ratio: 0.5,
    };

    fn true_ones(random: &mut Random) -> Self {
        let usual = Self::USUAL;
        Self {
            friction: random.normal(usual.friction, 0.035),
            mass: usual.mass.map(|mass| random.normal(mass, 0.015 * mass)),
            yaw_radius: usual.yaw_radius.map(|radius| random.normal(radius, 0.04)),
            heading: usual.heading.map(|heading| random.normal(heading, 2.0)),
            contact: [[1.95, random.uniform(-0.4, 0.4)], [random.uniform(-0.6, 1.0), 0.68]],
            drag: usual.drag.map(|_| random.uniform(0.1, 0.3)),
            crush_plane: random.normal(usual.crush_plane, 5.0),
            restitution: random.uniform(0.03, 0.2),
            impulse_ratio: random.uniform(0.4, 0.8),
        }
    }

    /// The numbers as found by the investigator: the place of the contact is measured, all others are the
    /// usual ones.
    fn found(&self, random: &mut Random) -> Self {
        let contact = self.contact.map(|place| place.map(|number| random.normal(number, 0.12)));
        Self { contact, ..Self::USUAL }
    }

    /// A case, with the lines of each vehicle, of its motion after the impact and of the end. An
    /// investigator's numbers have their errors.
    fn case(&self, is_true: bool, speeds: [&str; 2], rests: &[String; 2], end: &str) -> Case {
        let number = |value: f64, sd: f64, unit: &str| {
            let [value, sd] = [value, sd].map(|number| {
                if unit.is_empty() { number.to_string() } else { format!("\"{number} {unit}\"") }
            });
            if is_true { value } else { format!("{{ value = {value}, sd = {sd} }}") }
        };
        let vehicle = |i: usize| {
            let [ahead, left] = self.contact[i].map(|place| number(place, 0.12, "m"));
            let drag =
                if is_true { self.drag[i].to_string() } else { "{ low = 0.1, high = 0.3 }".to_owned() };
            format!(
                "[vehicle{}]\nclass = {}\nmass = {}\nyaw_radius = {}\nheading = {}\n{}\n\
                 contact = {{ x = {ahead}, y = {left} }}\n[vehicle{}.after]\ndrag = {drag}\n{}\n",
                i + 1,
                3 - i,
                number(self.mass[i], 0.015 * self.mass[i], "kg"),
                number(self.yaw_radius[i], 0.04, "m"),
                number(self.heading[i], 2.0, "deg"),
                speeds[i],
                i + 1,
                rests[i],
            )
        };
        let friction = number(self.friction, 0.035, "");
        let text = format!(
            "[scene]\ncontact = {{ x = \"0 m\", y = \"0 m\" }}\n[surface]\nfriction = {friction}\n{}{}[impact]\n\
             crush_plane = {}\nrestitution = {}\ntangential = {{ friction = {} }}\n{end}\n",
            vehicle(0),
            vehicle(1),
            number(self.crush_plane, 5.0, "deg"),
            self.restitution,
            self.impulse_ratio,
        );
        CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}\n{text}")).case
    }
}

/// A crash at an intersection: its true speeds (m/s), and the case without them.
fn crash(random: &mut Random) -> ([f64; 2], Case) {
    loop {
        let truth = Numbers::true_ones(random);
        let speeds = [random.uniform(9.7, 22.2), random.uniform(5.6, 18.0)];
        let given = speeds.map(|speed| format!("speed = \"{speed} m/s\""));
        let given = [given[0].as_str(), given[1].as_str()];
        let Ok(forward) = impact(&truth.case(true, given, &Default::default(), "")) else { continue };
        let [Some(one), Some(two)] = &forward.travel else { panic!("both are followed to rest") };
        let rests = [one, two].map(|travel| {
            let apart = travel.rest.position - travel.start.position;
            let turned = travel.rest.heading - travel.start.heading;
            // Of the survey and of the motion, each with its default error.
            let place = (0.5 + 0.1 * apart.norm()).hypot(0.3);
            let angle = (0.25 * turned.abs()).clamp(5.0 * DEGREE, 15.0 * DEGREE).hypot(3.0 * DEGREE);
            let [x, y] = [travel.rest.position.x, travel.rest.position.y].map(|at| random.normal(at, place));
            let heading = random.normal(travel.rest.heading, angle) / DEGREE;
            let far = apart.norm();
            let text = format!(
                "rest = {{ x = {{ value = \"{x} m\", sd = \"0.3 m\" }}, y = {{ value = \"{y} m\", sd = \"0.3 m\" }}, \
                 heading = {{ value = \"{} deg\", sd = \"3 deg\" }} }}",
                heading.rem_euclid(360.0)
            );
            (far, text)
        });
        let [(one, first), (two, second)] = rests;
        if one.max(two) > 60.0 || one.min(two) < 1.0 {
            continue;
        }
        let end = "[reconstruct]\nfind = [\"vehicle1.speed\", \"vehicle2.speed\"]";
        let found = truth.found(random);
        return (speeds, found.case(false, ["", ""], &[first, second], end));
    }
}

/// Of so many crashes, how many speeds lie in the 50, 80, 90 … % intervals.
fn held(crashes: u64, particles: usize) -> Vec<(f64, usize)> {
    let mut held: Vec<(f64, usize)> = Vec::new();
    for seed in 0..crashes {
        let mut random = Random { key: key(45, &[seed]), next: 0 };
        let (speeds, case) = crash(&mut random);
        let plan = EstimatePlan { particles, seed: 1, prior: None, pieces: analysis::PieceDetail::Weighed };
        let found = estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
        for (vehicle, truth) in VehicleId::ALL.into_iter().zip(speeds) {
            let wanted = SPEED.of_vehicle(vehicle);
            let intervals =
                &found.outputs.iter().find(|found| found.output == wanted).unwrap().posterior.intervals;
            held.resize(intervals.len(), (0.0, 0));
            for ((level, count), interval) in held.iter_mut().zip(intervals) {
                *level = interval.level;
                *count += usize::from((interval.low.value..=interval.high.value).contains(&truth));
            }
        }
    }
    held
}

/// 150 crashes with two speeds each: 95 % hold 92 to 98 %.
#[test]
#[ignore = "150 estimates with rests: twenty minutes with --release, and then -- --ignored --nocapture"]
fn intervals_hold_where_both_roll_to_rest() {
    let held = held(150, 256);
    println!("{held:?} of 300");
    let (_, within) = held.iter().copied().find(|(level, _)| *level == 0.95).unwrap();
    assert!((276..=294).contains(&within), "{within} of 300");
}
