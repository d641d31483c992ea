//! All speeds at which a collision takes the crush energy, compared with a dense scan by an independent
//! engine.
//!
//! The engine solves for the impulses in generalised coordinates and shares nothing with the program's laws;
//! the scan has more than 20,000 approach speeds for each case. Run it manually, in some minutes:
//!
//! `cargo test --release -p deltav-tests all_speeds -- --ignored --nocapture`
//!
//! Each test prints a line: cases, roots, missed (speeds that the program does not find), spurious (found by
//! the program but not by the scan), miscounted (the number of speeds is wrong, or the answer is not the
//! slowest approach) and undecided (rounding decides, so that nothing is compared).

mod draws;
mod engine;
mod scan;

use oracle::compare::assert_close;
use oracle::scenes::{Car, Scene};
use oracle::{Scale, Verdict, verdict};
use pim_core::{Tangential, VehicleId};
use reconcile::{EnergyBasis, Problem, ReconcileError};

use self::draws::{Draws, Sought, sought};
use self::engine::Judgement;
use self::scan::Scan;

/// The program's results: the answer, the number of speeds, and the speeds.
struct Given {
    answer: f64,
    count: usize,
    speeds: Vec<f64>,
}

fn given(problem: &Problem) -> Result<Given, ReconcileError> {
    let answer = problem.solve()?;
    Ok(Given { answer: answer.speed, count: answer.admissible, speeds: problem.speeds().collect() })
}

/// The random cases are the same in every run, unless `PROPTEST_RNG_SEED` is set.
fn seed() -> u64 {
    std::env::var("PROPTEST_RNG_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(980_025)
}

#[derive(Default)]
struct Tally {
    cases: usize,
    roots: usize,
    several: usize,
    missed: usize,
    spurious: usize,
    miscounted: usize,
    undecided: usize,
    /// The first failing cases.
    wrong: Vec<String>,
}

impl Tally {
    fn compare(&mut self, scan: &Scan, sought: &Sought, energy: f64) {
        self.cases += 1;
        let expected = scan.expect(energy);
        if expected.undecided.is_some() {
            self.undecided += 1;
            return;
        }
        let roots: Vec<f64> = expected.approaches.iter().map(|&x| scan.engine.speed(x)).collect();
        self.roots += roots.len();
        self.several += usize::from(roots.len() > 1);
        let found = sought.ask(energy, given);
        let (count, answer, speeds) = match &found {
            Ok(found) => (found.count, Some(found.answer), &found.speeds[..]),
            Err(_) => (0, None, &[][..]),
        };
        // (m/s) accuracy of a root of the scan as a speed.
        let tolerance = |speed: f64| {
            let x = scan.engine.approach_speed(speed);
            (3e-8 * x + 1e-12 * (scan.engine.size + x)) / scan.engine.slope[0].abs()
        };
        let lacks = |all: &[f64], speed: f64| all.iter().all(|s| (s - speed).abs() > tolerance(speed));
        let missed = roots.iter().filter(|&&speed| lacks(speeds, speed)).count();
        let spurious = speeds.iter().filter(|&&speed| lacks(&roots, speed)).count();
        let slowest = match (answer, roots.first()) {
            (Some(answer), Some(&slowest)) => !lacks(&[slowest], answer),
            (answer, slowest) => answer.is_none() && slowest.is_none(),
        };
        let ascending = speeds
            .windows(2)
            .all(|pair| scan.engine.approach_speed(pair[0]) <= scan.engine.approach_speed(pair[1]));
        let miscounted = count != roots.len() || speeds.len() != roots.len() || !slowest || !ascending;
        self.missed += missed;
        self.spurious += spurious;
        self.miscounted += usize::from(miscounted);
        if (miscounted || missed + spurious > 0) && self.wrong.len() < 5 {
            let says = found.as_ref().map(|found| (found.answer, found.count, &found.speeds));
            self.wrong
                .push(format!("expected {roots:?}, the program says {says:?} for {energy:?} J: {sought:?}"));
        }
    }

    fn summary(&self, name: &str) -> String {
        let Self { cases, roots, several, missed, spurious, miscounted, undecided, .. } = self;
        format!(
            "{name}: cases {cases} ({several} with several roots), roots {roots}, missed {missed}, spurious {spurious}, \
             miscounted {miscounted}, undecided {undecided}"
        )
    }

    #[track_caller]
    fn assert_complete(&self, name: &str, least_several: f64) {
        let line = format!("{}\n{}", self.summary(name), self.wrong.join("\n"));
        assert_eq!(self.missed + self.spurious + self.miscounted, 0, "{line}");
        let of_cases = |count: usize| {
            f64::from(u32::try_from(count).unwrap()) / f64::from(u32::try_from(self.cases).unwrap())
        };
        assert!(of_cases(self.undecided) < 0.03, "{line}");
        assert!(of_cases(self.several) > least_several, "{line}");
    }
}

fn random_cases(cases: u64, density: u32) -> Tally {
    let mut tally = Tally::default();
    for index in 0..cases {
        let mut draws = Draws::new(seed(), index);
        let (sought, scan) = scanned(&mut draws, density);
        let energy = scan.any_energy(&mut draws);
        tally.compare(&scan, &sought, energy);
    }
    tally
}

fn aimed_cases(cases: u64, density: u32) -> Tally {
    let mut tally = Tally::default();
    for index in 0..cases {
        let mut draws = Draws::new(!seed(), index);
        let (scan, sought, energy) = loop {
            let (sought, scan) = scanned(&mut draws, density);
            if let Some(energy) = scan.aim(&mut draws) {
                break (scan, sought, energy);
            }
        };
        tally.compare(&scan, &sought, energy);
    }
    tally
}

fn scanned(draws: &mut Draws, density: u32) -> (Sought, Scan) {
    loop {
        let sought = sought(draws);
        if let Some(scan) = Scan::new(&sought, density) {
            return (sought, scan);
        }
    }
}

#[test]
#[ignore = "minutes long: run by hand in release"]
#[expect(clippy::print_stdout, reason = "its summary is what a run by hand is for")]
fn all_speeds_of_random_collisions_are_found() {
    let tally = random_cases(20_000, 1);
    println!("{}", tally.summary("random"));
    tally.assert_complete("random", 0.03);
}

#[test]
#[ignore = "minutes long: run by hand in release"]
#[expect(clippy::print_stdout, reason = "its summary is what a run by hand is for")]
fn all_speeds_near_turns_jumps_and_knots_are_found() {
    let tally = aimed_cases(5000, 1);
    println!("{}", tally.summary("aimed"));
    tally.assert_complete("aimed", 0.1);
}

/// A smaller run with a coarser grid.
#[test]
fn all_speeds_of_some_random_collisions_are_found() {
    random_cases(400, 4).assert_complete("random", 0.03);
}

#[test]
fn all_speeds_near_some_turns_jumps_and_knots_are_found() {
    aimed_cases(400, 4).assert_complete("aimed", 0.1);
}

/// The engine of the scan agrees with the oracle, which solves nine raw equations.
#[test]
fn the_engine_agrees_with_the_oracle() {
    let (mut possible, mut impossible) = (0, 0);
    for index in 0..3000 {
        let mut draws = Draws::new(seed(), index);
        let (sought, scan) = scanned(&mut draws, 1000);
        let speed = draws.between(-80.0, 80.0);
        let x = scan.engine.approach_speed(speed);
        if x < 0.01 {
            continue;
        }
        let mut scene = sought.at(speed);
        if scene.tangential == Tangential::FractionOfCritical(0.0) {
            // Without friction, whatever the critical condition would require.
            scene = scene.under(Tangential::Ratio(0.0));
        }
        let state = scan.engine.state(x);
        let judgement = scan.engine.judge(x, &state);
        match (verdict(&scene), judgement) {
            (_, Judgement::Undecided) => {}
            (Verdict::Impact(effects), Judgement::Possible) => {
                let scale = Scale::of(&scene, &effects);
                assert_close(
                    "W_n",
                    0.5 * (1.0 - state.restitution) * x * state.impulse[0],
                    effects.normal_work,
                    1e-10 * scale.work,
                );
                assert_close("P_n", state.impulse[0], effects.impulse[0], 1e-10 * scale.impulse);
                assert_close("P_t", state.impulse[1], effects.impulse[1], 1e-10 * scale.impulse);
                assert_close("M", state.impulse[2], effects.moment, 1e-10 * scale.moment);
                let [loss, _] = scan.engine.loss(&state);
                assert_close("E_L", loss, effects.loss, 1e-10 * (scale.energy + scale.work));
                possible += 1;
            }
            (Verdict::Jam | Verdict::Pulling(_) | Verdict::EnergyCreated(_), Judgement::Impossible) => {
                impossible += 1;
            }
            (verdict, judgement) => panic!("{judgement:?} is not {verdict:?}: {scene:?}"),
        }
    }
    assert!(possible > 500 && impossible > 100, "{possible} {impossible}");
}

/// By hand, head-on and central with equal masses and e = e₀ + (1 − e₀) v/v₁: W_n = 375 v² (1 − e²) is
/// greatest where 2 e² − e₀ e − 1 = 0.
#[test]
fn the_scan_sees_both_roots_about_a_turn() {
    let car = Car {
        fixed: false,
        mass: 1500.0,
        yaw_radius: 1.4,
        heading: 0.0,
        distance: 2.0,
        angle: 0.0,
        velocity: [0.0; 2],
        yaw_rate: 0.0,
    };
    let scene = Scene {
        cars: [car, Car { heading: std::f64::consts::PI, ..car }],
        crush_plane: 0.0,
        restitution: 0.0,
        tangential: Tangential::Critical,
        moment: -1.0,
    };
    for e0 in [0.0, 0.3, 0.7_f64] {
        let curve = vec![(0.0, e0), (20.0, 1.0)];
        let sought = Sought { scene, curve, unknown: VehicleId::One, basis: EnergyBasis::Dissipated };
        let scan = Scan::new(&sought, 1).unwrap();
        let e = (e0 + (e0 * e0 + 8.0).sqrt()) / 4.0;
        let v = (e - e0) / (1.0 - e0) * 20.0;
        let greatest = 375.0 * v * v * (1.0 - e * e);
        for below in [1e-2, 1e-5, 1e-8] {
            let expected = scan.expect(greatest * (1.0 - below));
            let [slow, fast] = expected.approaches[..] else { panic!("{expected:?}") };
            assert!(
                slow < v && v < fast && fast - slow < 2.0 * v * below.sqrt() && expected.undecided.is_none()
            );
        }
        assert!(scan.expect(greatest * (1.0 + 1e-6)).approaches.is_empty());
        assert!(scan.expect(greatest * (1.0 + 1e-6)).undecided.is_none());
        assert!(scan.expect(greatest * (1.0 + 1e-11)).undecided.is_some());
    }
}
