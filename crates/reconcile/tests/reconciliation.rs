//! The speed at which the normal work equals the crush energy, compared with the impacts that it undoes and
//! the roots of [`oracle`].

use std::f64::consts::{FRAC_PI_2, PI};

use oracle::compare::{assert_close, assert_relative};
use oracle::scenes::{Car, Scene, for_all, scene};
use oracle::{Condition, Verdict, approach, solve, verdict};
use pim_core::{
    Body, Contact, ImpactError, InvalidInput, Law, Motion, Participant, Real, RestitutionCurve, Tangential,
    VehicleId,
};
use proptest::prelude::*;
use reconcile::{EnergyBasis, MAX_STEPS, Problem, Quadratic, ReconcileError, SolutionMethod};

/// A problem, or the reason why it is not valid.
pub(crate) fn posed<T: Real>(
    contact: Contact<T>,
    law: Law<T>,
    motions: [Motion<T>; 2],
    unknown: VehicleId,
    crush_energy: T,
    basis: EnergyBasis,
) -> Result<Problem<T>, ReconcileError> {
    let (law, tangential_share) = (law.into(), T::ZERO);
    let problem = Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share };
    problem.check().map(|()| problem)
}

/// The same problem under a restitution that depends on the closing speed.
pub(crate) fn with_curve(problem: &Problem, curve: &RestitutionCurve) -> Problem {
    let law = problem.law.nominal().with_restitution_curve(curve.clone());
    Problem { law, ..problem.clone() }
}

/// A collision in which one vehicle moves along its heading, at a speed to be found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) scene: Scene,
    pub(crate) unknown: VehicleId,
    pub(crate) speed: f64,
    pub(crate) basis: EnergyBasis,
}

impl Case {
    fn car(&self) -> usize {
        self.unknown.index()
    }

    pub(crate) fn at(&self, speed: f64) -> Scene {
        self.scene.at_speed(self.car(), speed)
    }

    /// The problem whose crush energy corresponds to the given `normal_work`.
    pub(crate) fn problem(&self, normal_work: f64) -> Problem {
        let e = self.scene.restitution;
        let energy = match self.basis {
            EnergyBasis::Dissipated => normal_work,
            EnergyBasis::Absorbed => normal_work / (1.0 - e * e),
        };
        // The velocity of the unknown must not matter.
        let scene = self.at(f64::MAX);
        posed(scene.contact(), scene.law(), scene.motions(), self.unknown, energy, self.basis).unwrap()
    }

    /// (m/s) scale of rounding in a speed: the size of the terms of u_n, divided by the change of u_n per
    /// m/s.
    pub(crate) fn speed_scale(&self) -> f64 {
        let size: f64 = self
            .scene
            .cars
            .iter()
            .map(|car| car.velocity[0].hypot(car.velocity[1]) + (car.yaw_rate * car.distance).abs())
            .sum();
        size / self.slope().abs()
    }

    /// du_n/ds.
    pub(crate) fn slope(&self) -> f64 {
        approach(&self.at(1.0))[0] - approach(&self.at(0.0))[0]
    }

    /// (J) the normal work of the impact at a speed, if there is one.
    fn work(&self, speed: f64) -> Option<f64> {
        match verdict(&self.at(speed)) {
            Verdict::Impact(effects) => Some(effects.normal_work),
            _ => None,
        }
    }

    /// (m/s) the approach speed at which a frictionless impact would take this normal work.
    pub(crate) fn frictionless(&self, normal_work: f64) -> f64 {
        let effects = solve(&self.scene.without_moment(), Condition::Ratio(0.0));
        -effects.approach[0] * (normal_work / effects.normal_work).sqrt()
    }
}

pub(crate) fn case(tangential: impl Strategy<Value = Tangential>) -> impl Strategy<Value = Case> {
    let unknown = prop_oneof![Just(VehicleId::One), Just(VehicleId::Two)];
    let basis = prop_oneof![Just(EnergyBasis::Dissipated), Just(EnergyBasis::Absorbed)];
    let restitution = prop_oneof![1 => Just(0.0), 4 => 0.0..0.95];
    (scene(), tangential, unknown, basis, restitution, -60.0..60.0).prop_map(
        |(scene, tangential, unknown, basis, restitution, speed)| {
            let mut scene = Scene { restitution, ..scene }.under(tangential);
            // A barrier has no speed to find, so the other vehicle's is sought.
            let unknown = match (scene.cars[0].fixed, scene.cars[1].fixed) {
                (true, _) => VehicleId::Two,
                (_, true) => VehicleId::One,
                _ => unknown,
            };
            scene = scene.at_speed(unknown.index(), speed);
            let approaching = scene.approaching();
            let speed = if approaching == scene { speed } else { -speed };
            Case { scene: approaching, unknown, speed, basis }
        },
    )
}

pub(crate) fn all_laws() -> impl Strategy<Value = Tangential> {
    oracle::scenes::tangential()
}

/// Whether the original speed can be distinguished from its neighbours to 1e-9: not if the vehicle hardly
/// moves along the normal, nor at an extremum of W_n.
fn is_well_conditioned(case: &Case, work: f64) -> bool {
    let step = 1e-4 * case.speed_scale() * approach(&case.scene)[0].abs().min(1.0);
    let change = match (case.work(case.speed + step), case.work(case.speed - step)) {
        (Some(high), Some(low)) => (high - low).abs() / work,
        _ => return false,
    };
    case.slope().abs() > 0.02 && change > 1e-6
}

#[test]
fn reconciliation_undoes_an_impact() {
    for_all(10_000, 0.6, case(all_laws()), |case| {
        let Ok(outcome) = case.scene.impact() else { return false };
        let work = outcome.energy.normal_work;
        if !is_well_conditioned(&case, work) {
            return false;
        }
        let problem = case.problem(work);
        assert_relative("W_n", problem.normal_work_sought(), work, 1e-14);
        assert_relative("W_n", problem.normal_work(case.speed), work, 1e-8);
        problem.solve().unwrap_or_else(|error| panic!("{error}"));
        let speeds: Vec<f64> = problem.speeds().collect();
        let nearest = speeds.iter().map(|speed| (speed - case.speed).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest <= 1e-9 * case.speed_scale(), "{nearest} {speeds:?}");
        true
    });
}

#[test]
fn the_answer_gives_the_energy_back() {
    for_all(10_000, 0.6, (case(all_laws()), 0.05..20.0), |(case, factor)| {
        let Ok(outcome) = case.scene.impact() else { return false };
        if case.slope().abs() < 0.02 {
            return false;
        }
        let problem = case.problem(outcome.energy.normal_work * factor);
        let Ok(answer) = problem.solve() else { return false };
        assert_eq!(answer.normal_work, problem.normal_work_sought());
        // W_n follows from differences of speeds of this scale, which are rounded.
        let scale = case.speed_scale() + answer.speed.abs();
        let step = 1e-6 * scale;
        let rise = problem.normal_work(answer.speed + step) - problem.normal_work(answer.speed - step);
        let size = 1.0 + (rise / (2.0 * step) * scale / answer.normal_work).abs();
        assert_relative("W_n", answer.outcome.energy.normal_work, answer.normal_work, 1e-12 * size + 1e-9);
        let speeds: Vec<f64> = problem.speeds().collect();
        assert_eq!(answer.admissible, speeds.len());
        assert_eq!(answer.speed, speeds[0]);
        assert_eq!(answer.outcome.before, problem.motions_at(answer.speed));
        // The answer agrees with the impact at that speed.
        let expected = case.at(answer.speed).impact().unwrap();
        let (dv, expected) = (answer.outcome.delta_v_magnitude(), expected.delta_v_magnitude());
        for i in 0..2 {
            assert_close("ΔV", dv[i], expected[i], 1e-9 * case.speed_scale() * size);
        }
        // The speeds go from the slowest approach to the fastest, each with that energy.
        let approaches: Vec<f64> = speeds.iter().map(|&speed| -approach(&case.at(speed))[0]).collect();
        assert!(approaches.is_sorted(), "{approaches:?}");
        for speed in speeds {
            assert_relative("W_n", problem.normal_work(speed), answer.normal_work, 1e-12 * size + 1e-9);
        }
        if let SolutionMethod::RootFinder(iterations) = answer.method {
            assert!(iterations.as_slice().len() <= MAX_STEPS);
            if let Some(last) = iterations.as_slice().last() {
                assert_close("the last step", last.speed, answer.speed, 1e-9 * case.speed_scale());
                assert_relative("its W_n", last.normal_work, answer.normal_work, 1e-6);
            }
        }
        true
    });
}

/// The admissible speeds of a case, from the raw equations: in one regime of the law P_n and u_n are affine
/// in the speed, and W_n = −½ (1−e) u_n P_n is quadratic in it. `None` if rounding decides.
fn expected_roots(case: &Case, normal_work: f64) -> Option<Vec<f64>> {
    let regimes = match case.scene.tangential {
        Tangential::Critical => vec![Condition::CommonTangential],
        Tangential::Ratio(mu) => vec![Condition::Ratio(mu)],
        Tangential::Friction(0.0) => vec![Condition::Ratio(0.0)],
        Tangential::Friction(limit) => {
            vec![Condition::CommonTangential, Condition::Ratio(limit), Condition::Ratio(-limit)]
        }
        Tangential::FractionOfCritical(_) => return Some(scanned_roots(case, normal_work)),
        Tangential::VelocityChange(change) => vec![Condition::Change(change)],
        Tangential::Restitution(e_t) => vec![Condition::Restitution(e_t)],
        Tangential::FullOrSliding(0.0) => vec![Condition::Ratio(0.0)],
        Tangential::FullOrSliding(limit) => {
            vec![Condition::Full, Condition::Ratio(limit), Condition::Ratio(-limit)]
        }
    };
    let mut roots = Vec::new();
    for regime in regimes {
        let reach = 50.0;
        let [zero, far] = [0.0, reach].map(|speed| solve(&case.at(speed), regime));
        let affine = |zero: f64, far: f64| [zero, (far - zero) / reach];
        let p = affine(zero.impulse[0], far.impulse[0]);
        let u = affine(zero.approach[0], far.approach[0]);
        let half = -0.5 * (1.0 - case.scene.restitution);
        let [c, b, a] =
            [half * u[0] * p[0] - normal_work, half * (u[0] * p[1] + u[1] * p[0]), half * u[1] * p[1]];
        let discriminant = b * b - 4.0 * a * c;
        if discriminant < 0.0 {
            continue;
        }
        let q = -0.5 * (b + discriminant.sqrt().copysign(b));
        for speed in [q / a, c / q].into_iter().filter(|speed| speed.abs() <= 1000.0) {
            // A product of differences smaller than a millionth of their terms is undecided.
            let left = |part: [f64; 2]| {
                (part[0] + part[1] * speed).abs() / (part[0].abs() + (part[1] * speed).abs())
            };
            if left(u) < 1e-6 || left(p) < 1e-6 {
                return None;
            }
            // The law must be in this regime there, and the impact must be possible.
            if case.work(speed).is_some_and(|work| (work / normal_work - 1.0).abs() < 1e-6) {
                roots.push(speed);
            }
        }
    }
    Some(sorted(case, roots))
}

/// The same by brute force if W_n is not quadratic: changes of sign on a fine grid, bisected to the last bit.
fn scanned_roots(case: &Case, normal_work: f64) -> Vec<f64> {
    let (slope, touch) = (case.slope(), approach(&case.at(0.0))[0]);
    let speed = |x: f64| -(x + touch) / slope;
    // Whether or not energy is created, W_n is a function of the approach speed x; without a possible push it
    // is zero.
    let missing = |x: f64| match verdict(&case.at(speed(x))) {
        Verdict::Impact(effects) | Verdict::EnergyCreated(effects) => effects.normal_work - normal_work,
        _ => -normal_work,
    };
    let frictionless = case.frictionless(normal_work);
    let grid = 3000;
    let samples: Vec<f64> = std::iter::once(1e-12)
        .chain((0..=grid).map(|i| frictionless * 1024_f64.powf(2.0 * f64::from(i) / f64::from(grid) - 1.0)))
        .collect();
    let mut roots = Vec::new();
    for pair in samples.windows(2) {
        let [mut low, mut high] = [pair[0], pair[1]];
        let sign = missing(low) < 0.0;
        if sign == (missing(high) < 0.0) {
            continue;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if (missing(middle) < 0.0) == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        if speed(low).abs() <= 1000.0 && matches!(verdict(&case.at(speed(low))), Verdict::Impact(_)) {
            roots.push(speed(low));
        }
    }
    sorted(case, roots)
}

/// From the slowest approach to the fastest.
fn sorted(case: &Case, mut roots: Vec<f64>) -> Vec<f64> {
    roots.sort_by(|&a, &b| approach(&case.at(b))[0].total_cmp(&approach(&case.at(a))[0]));
    roots
}

/// Whether the numbers of roots can be compared: no two so close that rounding decides whether they exist,
/// none beyond the root-finder's range, and none at the border of the possible.
fn is_decided(case: &Case, normal_work: f64, roots: &[f64]) -> bool {
    let frictionless = case.frictionless(normal_work);
    let x = |speed: f64| -approach(&case.at(speed))[0];
    let apart = roots.windows(2).all(|pair| (x(pair[1]) / x(pair[0]) - 1.0).abs() > 1e-3);
    // With a moment impulse P_n is a difference, which keeps few digits at a small energy.
    let reach = if case.scene.moment == -1.0 { 1000.0 } else { 30.0 };
    let within = roots.iter().all(|&speed| x(speed) < reach * frictionless);
    // Energies that differ by a millionth have the same number of roots.
    let stable = [1.0 - 1e-6, 1.0 + 1e-6]
        .into_iter()
        .all(|factor| expected_roots(case, normal_work * factor).is_some_and(|all| all.len() == roots.len()));
    case.slope().abs() > 0.02 && apart && within && stable
}

#[track_caller]
fn assert_roots(case: &Case, normal_work: f64) -> Option<usize> {
    let expected = expected_roots(case, normal_work)?;
    if !is_decided(case, normal_work, &expected) {
        return None;
    }
    let problem = case.problem(normal_work);
    let mut methods = vec![problem.root_finder()];
    methods.extend(problem.closed_form());
    methods.push(problem.solve());
    for answer in methods {
        match answer {
            Ok(answer) => {
                let speeds: Vec<f64> = problem.speeds().collect();
                assert_eq!([answer.admissible, speeds.len()], [expected.len(); 2], "{speeds:?} {expected:?}");
                for (actual, &expected) in
                    speeds.into_iter().chain([answer.speed]).zip(expected.iter().cycle())
                {
                    let scale = case.speed_scale() + actual.abs();
                    assert_close("a root", actual, expected, 1e-9 * scale);
                }
            }
            Err(error) => assert!(expected.is_empty(), "{error} {expected:?}"),
        }
    }
    Some(expected.len())
}

/// For random energies the number and values of the roots are those of the oracle.
#[track_caller]
fn assert_all_roots(cases: u32, least_kept: f64, case: impl Strategy<Value = Case>) {
    for_all(cases, least_kept, (case, -3.0..3.0), |(case, exponent)| {
        let pushed = solve(&case.scene.without_moment(), Condition::Ratio(0.0)).normal_work;
        assert_roots(&case, pushed * f64::exp(exponent)).is_some()
    });
}

#[test]
fn the_roots_for_a_common_tangential_velocity_are_all_there() {
    assert_all_roots(3000, 0.8, case(Just(Tangential::Critical)));
}

#[test]
fn the_roots_for_a_given_ratio_are_all_there() {
    assert_all_roots(3000, 0.8, case((-1.5..1.5).prop_map(Tangential::Ratio)));
}

#[test]
fn the_roots_under_friction_are_all_there() {
    assert_all_roots(
        5000,
        0.8,
        case(prop_oneof![
            1 => Just(Tangential::Friction(0.0)),
            9 => (0.0..2.0).prop_map(Tangential::Friction),
        ]),
    );
}

#[test]
fn the_roots_of_a_full_or_a_sliding_impact_are_all_there() {
    assert_all_roots(
        5000,
        0.8,
        case(prop_oneof![
            1 => Just(Tangential::FullOrSliding(0.0)),
            9 => (0.0..2.0).prop_map(Tangential::FullOrSliding),
        ]),
    );
}

#[test]
fn the_roots_for_a_tangential_restitution_or_a_change_of_velocity_are_all_there() {
    assert_all_roots(
        3000,
        0.7,
        case(prop_oneof![
            (-1.0..1.0).prop_map(Tangential::Restitution),
            (-20.0..20.0).prop_map(Tangential::VelocityChange),
        ]),
    );
}

#[test]
fn the_roots_for_a_fraction_of_the_critical_ratio_are_all_there() {
    let fraction = (0.0..=1.0).prop_map(Tangential::FractionOfCritical);
    let plain = case(fraction).prop_map(|case| Case { scene: case.scene.without_moment(), ..case });
    assert_all_roots(150, 0.8, plain);
}

#[test]
fn the_roots_for_a_fraction_of_the_critical_ratio_with_a_moment_impulse_are_all_there() {
    let fraction = (0.0..=1.0).prop_map(Tangential::FractionOfCritical);
    let turning = case(fraction).prop_filter("a moment impulse", |case| case.scene.moment != -1.0);
    assert_all_roots(100, 0.7, turning);
}

#[test]
fn closed_form_and_root_finder_agree() {
    let laws = prop_oneof![
        Just(Tangential::Critical),
        (-1.5..1.5).prop_map(Tangential::Ratio),
        (-1.0..1.0).prop_map(Tangential::Restitution),
        (-20.0..20.0).prop_map(Tangential::VelocityChange),
        (0.0..1.5).prop_map(Tangential::Friction),
        (0.0..1.5).prop_map(Tangential::FullOrSliding),
    ];
    // Half of the scenes with Brach's laws have a moment impulse.
    for_all(8000, 0.5, (case(laws), -3.0..3.0), |(case, exponent): (Case, f64)| {
        let work = solve(&case.scene.without_moment(), Condition::Ratio(0.0)).normal_work * exponent.exp();
        if !expected_roots(&case, work).is_some_and(|expected| is_decided(&case, work, &expected)) {
            return false;
        }
        let problem = case.problem(work);
        match (problem.closed_form().unwrap(), problem.root_finder()) {
            (Ok(closed), Ok(found)) => {
                assert!(matches!(closed.method, SolutionMethod::ClosedForm));
                assert!(matches!(found.method, SolutionMethod::RootFinder(_)));
                assert_eq!(closed.admissible, found.admissible);
                let scale = case.speed_scale() + closed.speed.abs();
                assert_close("the speed", found.speed, closed.speed, 1e-10 * scale);
                true
            }
            (Err(_), Err(_)) => false,
            (closed, found) => panic!("{closed:?} {found:?}"),
        }
    });
}

/// A friction limit equal to the ratio of the full impulse: rounding alone decides whether friction suffices,
/// or neither law might act at its own root. The speed is found in any case.
#[test]
fn a_speed_at_the_border_of_sticking_and_sliding_is_found() {
    for_all(20000, 0.3, case(Just(Tangential::Critical)), |case: Case| {
        let case = Case { scene: case.scene.without_moment(), ..case };
        let Ok(outcome) = case.scene.impact() else { return false };
        let at_limit = case.scene.under(Tangential::Friction(outcome.impulse_ratio.abs()));
        let problem = Case { scene: at_limit, ..case }.problem(outcome.energy.normal_work);
        let scale = case.speed_scale() + case.speed.abs();
        let is_it = |speed: f64| (speed - case.speed).abs() < 1e-6 * scale;
        // If W_n hardly changes with the speed, rounding moves it farther than this.
        let near = [-1e-3, 1e-3].map(|share| problem.normal_work(case.speed + share * scale));
        let rise = (near[1] - near[0]).abs();
        if rise.is_nan() || rise <= 1e-6 * outcome.energy.normal_work || outcome.impulse_ratio == 0.0 {
            return false;
        }
        assert!(problem.speeds().any(is_it), "{case:?}: {:?}", problem.speeds().collect::<Vec<_>>());
        assert_eq!(problem.speeds().filter(|speed| is_it(*speed)).count(), 1, "{case:?}");
        true
    });
}

#[test]
fn only_laws_with_a_quadratic_have_a_closed_form() {
    for (law, closed) in [
        (Tangential::Critical, true),
        (Tangential::Ratio(0.1), true),
        (Tangential::FractionOfCritical(0.5), false),
        (Tangential::Friction(0.5), true),
        (Tangential::VelocityChange(0.5), true),
        (Tangential::Restitution(0.5), true),
        (Tangential::FullOrSliding(0.5), true),
    ] {
        let problem = against_a_wall(law, 5.0, 1.5).unwrap();
        assert_eq!(problem.closed_form().is_some(), closed);
    }
}

/// Unit mass and unit radius of gyration, C at r = (−1, −1) from the CG, a wall along x below it, a heading
/// of 3 across to 1 down, e = 0.
///
/// By hand, along n = +y and t = −x: k_nn = k_tt = 2, k_nt = 1, det K = 3. With the yaw rate ω, u = −(ω +
/// s/√10, ω + 3s/√10); in the approach speed x = ω + s/√10 this gives u_t = 2ω − 3x, so that a common
/// velocity takes P_n = (2x + u_t)/3 = (2ω − x)/3 and W_n = x (2ω − x)/6.
fn against_a_wall(law: Tangential, yaw_rate: f64, energy: f64) -> Result<Problem, ReconcileError> {
    let heading = f64::atan2(-1.0, 3.0);
    let car = Car {
        fixed: false,
        mass: 1.0,
        yaw_radius: 1.0,
        heading,
        distance: 2_f64.sqrt(),
        angle: -0.75 * PI - heading,
        velocity: [0.0; 2],
        yaw_rate,
    };
    let contact = Contact::new([car.participant(), Participant::barrier()], FRAC_PI_2).unwrap();
    let law = Law::new(0.0, law).unwrap();
    let motions = [Motion::rest().with_yaw_rate(yaw_rate), Motion::rest()];
    posed(contact, law, motions, VehicleId::One, energy, EnergyBasis::Dissipated)
}

/// A motion that is no number is told as such, not as a speed that another vehicle does not reach.
#[test]
fn motions_are_finite() {
    let problem = against_a_wall(Tangential::Critical, 5.0, 1.5).unwrap();
    for bad in [f64::NAN, f64::INFINITY] {
        let moves = |velocity: [f64; 2], yaw_rate: f64| Motion { velocity: velocity.into(), yaw_rate };
        for known in [moves([bad, 0.0], 0.0), moves([0.0, bad], 0.0), moves([0.0; 2], bad)] {
            let problem = Problem { motions: [problem.motions[0], known], ..problem.clone() };
            let refused = problem.check();
            assert!(matches!(refused, Err(ReconcileError::Impact(ImpactError::Invalid(_)))), "{refused:?}");
            let unsolved = problem.solve();
            assert!(matches!(unsolved, Err(ReconcileError::Impact(ImpactError::Invalid(_)))), "{unsolved:?}");
        }
        let turning = Problem { motions: [moves([0.0; 2], bad), problem.motions[1]], ..problem.clone() };
        assert!(turning.check().is_err());
        // Its velocity is not used.
        let sought = Problem { motions: [moves([bad; 2], 5.0), problem.motions[1]], ..problem.clone() };
        assert_eq!(sought.check(), Ok(()));
    }
}

/// The numbers of the hand calculation above, with ω = 5: P_n = (10 − x)/3, and c = 2 · 1.5 J.
#[test]
fn the_numbers_on_the_way_by_hand() {
    let problem = against_a_wall(Tangential::Critical, 5.0, 1.5).unwrap();
    let (line, quadratic) = (problem.line(), problem.quadratic(&problem.law.nominal()).unwrap());
    for (what, actual, expected) in [
        ("u_n0", line.at_rest.normal, -5.0),
        ("u_t,rest", line.at_rest.tangential, -5.0),
        ("c_n", line.slope.normal, -1.0 / 10_f64.sqrt()),
        ("c_t", line.slope.tangential, -3.0 / 10_f64.sqrt()),
        ("ω₁ − ω₂", line.relative_yaw_rate, 5.0),
        ("τ", line.tangential_slope(), -3.0),
        ("u_t0", line.tangential_at_zero_approach(), 10.0),
        ("α", quadratic.alpha, -1.0 / 3.0),
        ("β", quadratic.beta, 10.0 / 3.0),
        ("c", quadratic.c, 3.0),
    ] {
        assert_close(what, actual, expected, 1e-13);
    }
    let mirrored = line.mirrored();
    assert_eq!(mirrored.at_rest.normal, line.at_rest.normal);
    assert_eq!(mirrored.slope.tangential, -line.slope.tangential);
    assert_eq!(mirrored.tangential_slope(), -line.tangential_slope());
    assert_eq!(mirrored.tangential_at_zero_approach(), -line.tangential_at_zero_approach());
    assert_eq!(mirrored.relative_yaw_rate, -5.0);
}

/// Each impact lies on the line and on P_n = α x + β, and x solves the quadratic.
#[test]
fn the_numbers_on_the_way_are_those_of_the_impact() {
    for_all(5000, 0.2, case(all_laws()), |case| {
        let (Verdict::Impact(effects), [u_n, u_t]) = (verdict(&case.scene), approach(&case.scene)) else {
            return false;
        };
        let problem = case.problem(effects.normal_work);
        let line = problem.line();
        let at = line.at(-u_n);
        let size = case.speed_scale() * case.slope().abs() * (1.0 + line.tangential_slope().abs());
        assert_close("u_t", at.velocity.tangential, u_t, 1e-12 * size);
        assert_close("s", line.speed(-u_n), case.speed, 1e-11 * (case.speed_scale() + case.speed.abs()));
        let outcome = case.scene.impact().unwrap();
        let acting = case.scene.law().acting(outcome.regime, outcome.impulse_ratio);
        let Some(Quadratic { alpha, beta, c }) = problem.quadratic(&acting) else {
            assert!(matches!(acting.tangential(), Tangential::FractionOfCritical(_)));
            return false;
        };
        let pushes = (alpha * u_n).abs() + beta.abs();
        assert_close("P_n", alpha * -u_n + beta, effects.impulse[0], 1e-9 * pushes);
        assert_close("c", (alpha * -u_n + beta) * -u_n, c, 1e-9 * (pushes * u_n.abs() + c));
        true
    });
}

/// With ω = 5 the work is x (10 − x)/6: 1.5 J at x = 1 and at x = 9, and never more than 25/6 J.
#[test]
fn a_common_velocity_may_have_two_speeds_or_none() {
    let problem = against_a_wall(Tangential::Critical, 5.0, 1.5).unwrap();
    for answer in [problem.solve().unwrap(), problem.root_finder().unwrap()] {
        let expected = [-4.0 * 10_f64.sqrt(), 4.0 * 10_f64.sqrt()];
        assert_eq!(answer.admissible, 2);
        for (speed, expected) in problem.speeds().zip(expected) {
            assert_relative("the speed", speed, expected, 1e-12);
        }
        // The slower approach is the answer.
        assert_relative("the speed", answer.speed, expected[0], 1e-12);
        assert_relative("u_n", answer.outcome.approach.normal, -1.0, 1e-12);
        assert_relative("P_n", answer.outcome.impulse.normal, 3.0, 1e-12);
    }
    for x in [1.0, 2.0, 7.0] {
        let work = problem.normal_work((x - 5.0) * 10_f64.sqrt());
        assert_relative("W_n", work, x * (10.0 - x) / 6.0, 1e-12);
    }

    let near = against_a_wall(Tangential::Critical, 5.0, 25.0 / 6.0 - 1e-3).unwrap();
    assert_eq!(near.solve().unwrap().admissible, 2);
    assert_eq!(near.root_finder().unwrap().admissible, 2);
    let beyond = against_a_wall(Tangential::Critical, 5.0, 25.0 / 6.0 + 1e-3).unwrap();
    let energy = 25.0 / 6.0 + 1e-3;
    let expected = ReconcileError::NotReached { vehicle: VehicleId::One, energy, tangential_share: 0.0 };
    assert_eq!(beyond.solve().unwrap_err(), expected);
    assert_eq!(beyond.root_finder().unwrap_err(), expected);
    let text = expected.to_string();
    assert!(text.contains("no speed of vehicle 1") && text.contains("4.2 J"), "{text}");
}

/// W_n = x (2 ω − x)/6 is at most ω²/6, at x = ω, where the car does not move along its heading. It pushes
/// from x = 0 to x = 2 ω, and never for ω ≤ 0.
#[test]
fn what_cannot_be_reached_is_told_how_near_it_comes() {
    for yaw_rate in [0.01_f64, 3.0, 5.0, 400.0] {
        let most = yaw_rate * yaw_rate / 6.0;
        let curve = RestitutionCurve::new(vec![(1.0, 0.0), (2.0, 0.0)]).unwrap();
        for share in [1.001, 3.0, 1e4] {
            let beyond = against_a_wall(Tangential::Critical, yaw_rate, share * most).unwrap();
            for problem in [with_curve(&beyond, &curve), beyond] {
                assert!(matches!(problem.root_finder(), Err(ReconcileError::NotReached { .. })));
                let nearest = problem.nearest().unwrap();
                assert_relative("the nearest W_n", nearest.normal_work, most, 1e-12);
                assert!(nearest.speed.abs() < 1e-5 * yaw_rate, "{nearest:?}");
            }
        }
    }
    for yaw_rate in [0.0, -3.0] {
        let pulls = against_a_wall(Tangential::Critical, yaw_rate, 1.5).unwrap();
        let Err(ReconcileError::NotReached { .. }) = pulls.solve() else { panic!("it has an answer") };
        // P_n = (2 ω − x)/3 at x = √(2 E k_nn) = √6
        let Err(ImpactError::Pulling { normal_impulse }) = pulls.nearest() else {
            panic!("an impact can happen")
        };
        assert_relative("P_n", normal_impulse, (2.0 * yaw_rate - 6_f64.sqrt()) / 3.0, 1e-12);
    }
}

#[test]
fn a_ratio_that_jams_says_so() {
    // k_nn + μ k_nt = 2 + μ.
    let problem = against_a_wall(Tangential::Ratio(-2.5), 5.0, 1.5).unwrap();
    let error = problem.solve().unwrap_err();
    assert!(
        matches!(error, ReconcileError::Impact(ImpactError::Jam { impulse_ratio: -2.5, .. })),
        "{error:?}"
    );
    assert!(problem.root_finder().is_err());
    assert!(against_a_wall(Tangential::Ratio(-1.9), 0.0, 1.5).is_ok());
}

/// With e = 0.9 and a μ that drives the sliding, the speed exists but the impact there creates energy.
#[test]
fn a_speed_that_creates_energy_is_refused_by_name() {
    let body = Body::new(1500.0, 2700.0).unwrap();
    let contact =
        Contact::new([Participant::new(body, 0.3, 2.0, 0.0).unwrap(), Participant::barrier()], 0.0).unwrap();
    // n = −x: with the heading 0.3 the car slides along +y, which is −t; friction against that has μ > 0.
    let law = Law::new(0.9, Tangential::Ratio(-1.5)).unwrap();
    let motions = [Motion::rest(), Motion::rest()];
    let problem = posed(contact, law, motions, VehicleId::One, 1e4, EnergyBasis::Dissipated).unwrap();
    for answer in [problem.solve(), problem.root_finder()] {
        let error = answer.unwrap_err();
        let ReconcileError::Inadmissible { vehicle, speed, reason } = error else { panic!("{error:?}") };
        assert_eq!(vehicle, VehicleId::One);
        assert!(speed > 0.0);
        assert!(matches!(reason, ImpactError::EnergyCreated { .. }), "{reason:?}");
        assert!(error.to_string().contains("create energy"));
    }
}

/// The search has no built-in scale: toys and trains, creeping or at the maximum speed, nearly elastic or
/// plastic.
#[test]
fn the_search_has_no_scale_of_its_own() {
    for mass in [1e-6, 1500.0, 1e9] {
        let body = Body::new(mass, 1.8 * mass).unwrap();
        let places =
            [Participant::new(body, 0.0, 2.0, 0.0).unwrap(), Participant::new(body, PI, 2.0, 0.0).unwrap()];
        for speed in [1e-4, 20.0, 900.0] {
            for e in [0.0, 0.9999, 1.0 - 3e-7] {
                // W_n = ½ m̄ (1−e²) v² with m̄ = m/2
                let energy = 0.25 * mass * (1.0 - e * e) * speed * speed;
                let problem = head_on(places, VehicleId::One, e, energy).unwrap();
                assert_relative("the speed", problem.root_finder().unwrap().speed, speed, 1e-9);
                assert_relative("the speed", problem.solve().unwrap().speed, speed, 1e-9);
            }
        }
    }
}

/// With the yaw rate 50 the work x (100 − x)/6 rises so steeply that it reaches 0.1 mJ at x = 3 µm/s, long
/// before the first sample.
#[test]
fn a_speed_below_the_first_sample_is_found() {
    let problem = against_a_wall(Tangential::Critical, 50.0, 1e-4).unwrap();
    let x = 50.0 - (2500.0_f64 - 6e-4).sqrt();
    for answer in [problem.solve().unwrap(), problem.root_finder().unwrap()] {
        assert_close("the first speed", answer.speed, (x - 50.0) * 10_f64.sqrt(), 1e-9);
    }
}

/// The steps are printed as a list.
#[test]
fn the_steps_of_a_search_are_printed() {
    let answer = against_a_wall(Tangential::Critical, 5.0, 1.5).unwrap().root_finder().unwrap();
    let SolutionMethod::RootFinder(iterations) = answer.method else { panic!("{:?}", answer.method) };
    assert!(!iterations.as_slice().is_empty());
    assert_eq!(format!("{iterations:?}"), format!("{:?}", iterations.as_slice()));
}

pub(crate) fn head_on(
    places: [Participant; 2],
    unknown: VehicleId,
    e: f64,
    energy: f64,
) -> Result<Problem, ReconcileError> {
    let contact = Contact::new(places, 0.0).unwrap();
    let law = Law::new(e, Tangential::Critical).unwrap();
    posed(contact, law, [Motion::rest(); 2], unknown, energy, EnergyBasis::Dissipated)
}

pub(crate) fn places(heading: f64) -> [Participant; 2] {
    let body = Body::new(1500.0, 2700.0).unwrap();
    [
        Participant::new(body, 0.0, 2.0, 0.0).unwrap(),
        Participant::new(body, heading, -2.0 * heading.cos(), 2.0 * heading.sin()).unwrap(),
    ]
}

#[test]
fn problems_without_an_answer_are_refused() {
    for energy in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = head_on(places(PI), VehicleId::One, 0.3, energy);
        assert!(
            matches!(refused, Err(ReconcileError::NoCrushEnergy { energy: named }) if named.to_bits() == energy.to_bits()),
            "{refused:?}"
        );
    }
    assert_eq!(
        head_on(places(PI), VehicleId::One, 1.0, 1e5).unwrap_err(),
        ReconcileError::NoRestitutionLoss { restitution: 1.0 }
    );
    assert!(head_on(places(PI), VehicleId::One, 0.99, 1e5).is_ok());

    let [car, _] = places(PI);
    let wall = Participant::barrier();
    let fixed = |vehicle| ReconcileError::Fixed { vehicle };
    assert_eq!(head_on([car, wall], VehicleId::Two, 0.3, 1e5).unwrap_err(), fixed(VehicleId::Two));
    assert_eq!(head_on([wall, car], VehicleId::One, 0.3, 1e5).unwrap_err(), fixed(VehicleId::One));
    assert!(head_on([car, wall], VehicleId::One, 0.3, 1e5).is_ok());

    // Vehicle 2 heads along the crush plane: its speed adds nothing to u_n.
    let across = places(FRAC_PI_2);
    let refused = head_on(across, VehicleId::Two, 0.3, 1e5).unwrap_err();
    assert!(
        matches!(refused, ReconcileError::SpeedWithoutEffect { vehicle: VehicleId::Two, cosine } if cosine.abs() < 1e-15),
        "{refused:?}"
    );
    assert!(head_on(across, VehicleId::One, 0.3, 1e5).is_ok());
    assert!(head_on(places(FRAC_PI_2 - 1e-6), VehicleId::Two, 0.3, 1e5).is_ok());

    let invalid: ReconcileError = InvalidInput::BothFixed.into();
    assert_eq!(invalid, ReconcileError::Impact(ImpactError::Invalid(InvalidInput::BothFixed)));
}

/// By hand, head-on and central with equal masses: W_n = ½ m̄ (1−e²) v², m̄ = 750 kg.
#[test]
fn a_central_impact_by_hand() {
    for (unknown, sign) in [(VehicleId::One, 1.0), (VehicleId::Two, 1.0)] {
        let energy = 0.5 * 750.0 * (1.0 - 0.09) * 400.0;
        let problem = head_on(places(PI), unknown, 0.3, energy).unwrap();
        assert_relative("the speed", problem.solve().unwrap().speed, sign * 20.0, 1e-13);
        assert_relative("the speed", problem.root_finder().unwrap().speed, sign * 20.0, 1e-12);
    }
}

/// Between the speeds at which friction holds the surfaces together, W_n has a hump narrower than a step of
/// the scan: three speeds give the same energy, and the mirrored collision has the same three.
#[test]
fn friction_may_have_three_speeds_close_together() {
    let truck = Car {
        fixed: false,
        mass: 33_000.0,
        yaw_radius: 1.0,
        heading: 0.0,
        distance: 0.0,
        angle: 0.0,
        velocity: [45.0, 12.0],
        yaw_rate: 0.0,
    };
    let light = Car { mass: 500.0, yaw_radius: 0.5, heading: 0.44, distance: 3.5, angle: 0.56, ..truck };
    let scene = Scene {
        cars: [truck, light.at_speed(40.0)],
        crush_plane: -0.73,
        restitution: 0.0,
        tangential: Tangential::Friction(0.365),
        moment: -1.0,
    };
    let mirrored = Scene { crush_plane: -scene.crush_plane, ..scene }.with_cars(|car| Car {
        heading: -car.heading,
        angle: -car.angle,
        velocity: [car.velocity[0], -car.velocity[1]],
        ..car
    });
    for scene in [scene, mirrored] {
        let case = Case { scene, unknown: VehicleId::Two, speed: 40.0, basis: EnergyBasis::Dissipated };
        for (energy, roots) in
            [(440.0, 1), (460.0, 3), (470.0, 3), (480.0, 3), (490.0, 3), (500.0, 3), (520.0, 1)]
        {
            assert_eq!(assert_roots(&case, energy), Some(roots), "{energy}");
        }
    }
}
