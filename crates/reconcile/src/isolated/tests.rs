use crash3::EnergyBasis;
use pim_core::{Body, Contact, Law, Motion, Participant, RestitutionCurve, Tangential, VehicleId};

use super::{Changes, Meeting, Push, Signs};
use crate::posed::Posed;
use crate::problem::Problem;
use crate::root::Root;
use crate::stretch::Stretch;

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
struct Draws(u64);

impl Draws {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        // The leading 52 bits as the mantissa of 1 + k·2⁻⁵².
        low + (high - low) * (f64::from_bits(1.0_f64.to_bits() | ((z ^ (z >> 31)) >> 12)) - 1.0)
    }
}

fn problem(draws: &mut Draws) -> Problem {
    let mut car = |heading: f64| {
        let mass = draws.between(700.0, 3000.0);
        let body = Body::new(mass, mass * draws.between(1.0, 3.0)).unwrap();
        let (forward, left) = (draws.between(0.5, 2.5), draws.between(-1.0, 1.0));
        Participant::new(body, heading + draws.between(-0.8, 0.8), forward, left).unwrap()
    };
    let places = [car(0.0), car(2.0)];
    let contact = Contact::new(places, draws.between(-0.6, 0.6)).unwrap();
    let yaw_rate = draws.between(-2.0, 2.0);
    let motions = [Motion { yaw_rate, ..Motion::rest() }, Motion::along(2.0, draws.between(0.0, 25.0))];
    let (kind, number) = (draws.between(0.0, 5.0), draws.between(0.05, 1.0));
    let law = match kind {
        ..1.0 => Law::new(0.0, Tangential::Critical),
        ..2.0 => Law::new(0.0, Tangential::Friction(number)),
        ..3.0 => Law::new(0.0, Tangential::FullOrSliding(number)),
        ..4.0 => Law::new(0.0, Tangential::VelocityChange(10.0 * number - 5.0)),
        _ => Law::new(0.0, Tangential::Ratio(number - 0.5)),
    };
    let moment = if kind.fract() < 0.5 { -1.0 } else { draws.between(-1.0, 1.0) };
    let law = law.and_then(|law| law.with_moment_restitution(moment)).unwrap();
    let mut speed = 0.0;
    let point = |_| {
        speed += draws.between(0.5, 8.0);
        (speed, draws.between(0.0, 1.0))
    };
    let points = (0..4).map(point).collect();
    let law = law.with_restitution_curve(RestitutionCurve::new(points).unwrap());
    let basis = if draws.between(0.0, 1.0) < 0.5 { EnergyBasis::Dissipated } else { EnergyBasis::Absorbed };
    // As many slow collisions as fast ones.
    let size = draws.between(0.1, 1.0);
    let crush_energy = 3e5 * size * size * size;
    Problem { contact, law, motions, unknown: VehicleId::One, crush_energy, basis, tangential_share: 0.0 }
}

/// Signs isolate the same roots as the polynomials find piece by piece, in every stretch of random curves.
#[test]
fn isolated_roots_are_those_of_the_pieces() {
    let mut draws = Draws(22);
    let [mut none, mut one, mut several] = [0; 3];
    for _ in 0..20_000 {
        let problem = problem(&mut draws);
        let posed = Posed { problem: &problem, line: problem.line() };
        let (law, meeting) = (problem.law.nominal(), posed.meeting());
        let pushes = posed.pushes(&meeting).unwrap();
        for stretch in posed.stretches() {
            let Signs::Isolated(roots) = meeting.signs(&stretch, &law, &pushes) else {
                several += 1;
                continue;
            };
            let roots: Vec<f64> = roots.map(|root| root.x).collect();
            let expected: Vec<f64> =
                posed.roots_by_pieces::<()>(stretch).map(|root| root.unwrap().x).collect();
            assert_eq!(roots.len(), expected.len(), "{roots:?} {expected:?} {problem:?}");
            for (x, expected) in roots.iter().zip(&expected) {
                assert!((x - expected).abs() <= 1e-10 * x, "{x} {expected} {problem:?}");
            }
            if roots.is_empty() {
                none += 1;
            } else {
                one += 1;
            }
        }
    }
    // Signs isolate the roots of nearly all stretches.
    assert!(none > 50_000 && one > 10_000 && (500..2000).contains(&several), "{none} {one} {several}");
}

/// With stretches halved if they may have several roots, the roots of a problem are those found by pieces.
#[test]
fn halving_loses_no_root() {
    let mut draws = Draws(1995);
    let mut several = 0;
    for _ in 0..20_000 {
        let problem = problem(&mut draws);
        several += usize::from(assert_all_roots(&problem) > 1);
    }
    assert!(several > 300, "{several}");
}

/// The Bernstein coefficients of F against F itself: at the ends they are its values, and without a change of
/// sign F keeps its sign between them.
#[test]
fn signs_without_a_change_are_those_of_f() {
    let mut draws = Draws(1912);
    let mut kept = 0;
    for _ in 0..10_000 {
        let problem = problem(&mut draws);
        let posed = Posed { problem: &problem, line: problem.line() };
        let meeting = posed.meeting();
        for (_, push) in posed.pushes(&meeting).unwrap().into_iter().flatten() {
            for stretch in posed.stretches() {
                let f = |share: f64| {
                    let [low, high] = stretch.range;
                    sign_of_f(&meeting, &stretch, &push, low + (high - low) * share)
                };
                let signs: Vec<bool> = (0..=50).map(|i| f(f64::from(i) / 50.0)).collect();
                let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
                match meeting.changes(&stretch, &push) {
                    Changes { none: true, .. } => assert_eq!(changes, 0, "{problem:?}"),
                    Changes { one: true, .. } => assert_eq!(changes, 1, "{problem:?}"),
                    Changes { is_sure, .. } => kept += usize::from(is_sure),
                }
            }
        }
    }
    assert!(kept > 50, "{kept}");
}

/// Whether F is negative.
fn sign_of_f(meeting: &Meeting, stretch: &Stretch, push: &Push, x: f64) -> bool {
    let e = stretch.restitution_at(x);
    let energy = meeting.crush_energy;
    match meeting.basis {
        EnergyBasis::Dissipated => 0.5 * (1.0 - e) * x * push.at(x, e) < energy,
        EnergyBasis::Absorbed => 0.5 * x * push.at(x, e) < (1.0 + e) * energy,
    }
}

/// Compares the roots of a problem, however found, with those of its pieces without halving.
fn assert_all_roots(problem: &Problem) -> usize {
    let posed = Posed { problem, line: problem.line() };
    let x = |root: Result<Root<()>, _>| root.unwrap().x;
    let roots: Vec<f64> = posed.roots().map(x).collect();
    let mut expected: Vec<f64> =
        posed.stretches().flat_map(|stretch| posed.roots_by_pieces(stretch).map(x)).collect();
    expected.dedup();
    assert_eq!(roots.len(), expected.len(), "{roots:?} {expected:?} {problem:?}");
    for (x, expected) in roots.iter().zip(&expected) {
        assert!((x - expected).abs() <= 1e-9 * x, "{x} {expected} {problem:?}");
    }
    roots.len()
}

fn fraction(draws: &mut Draws) -> Problem {
    let (e, f, e_m) = (draws.between(0.0, 0.9), draws.between(0.0, 1.0), draws.between(-1.0, 1.0));
    let law = Law::new(e, Tangential::FractionOfCritical(f)).and_then(|law| law.with_moment_restitution(e_m));
    Problem { law: law.unwrap().into(), ..problem(draws) }
}

/// A fraction of μ_c with a moment impulse: signs determine the number of roots in nearly every range.
#[test]
fn roots_of_a_quartic_are_those_of_the_pieces() {
    let mut draws = Draws(1987);
    let [mut several, mut unsure, mut parts] = [0; 3];
    for _ in 0..20_000 {
        let problem = fraction(&mut draws);
        several += usize::from(assert_all_roots(&problem) > 1);
        let posed = Posed { problem: &problem, line: problem.line() };
        let meeting = posed.meeting();
        let mut quartic = posed.quartic(&meeting).unwrap();
        while let Some(part) = quartic.next() {
            parts += 1;
            let signs = quartic.signs(&meeting, &part, &problem.law.nominal());
            unsure += usize::from(matches!(signs, Signs::Unsure));
        }
    }
    assert!(several > 200 && unsure * 10 < parts, "{several} {unsure} {parts}");
}
