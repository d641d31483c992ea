//! Motions with a closed form, formulated independently here.

use std::f64::consts::FRAC_PI_2;

use trajectory::closed::{Slide, Spin, spins};
use trajectory::{
    Axles, Body, Chassis, Control, FrictionZone, GRAVITY, Ground, NoRest, Region, Rest, State, Steer,
    Vector2, to_rest,
};

use crate::scenes::{car, start};

fn rest(chassis: &Chassis, ground: &Ground<'_>, start: &State) -> Rest {
    to_rest(chassis, Steer::straight(), ground, start, &Control::default(), |_| {}).unwrap()
}

/// S = v²/(2 μ g), t = v/(μ g)
#[test]
fn a_straight_slide_with_locked_wheels() {
    for (heading, direction) in [(0.0, 0.0), (0.7, 0.7), (0.7, 2.0), (-2.0, 1.0)] {
        let v = 13.0_f64;
        let start = start(heading, [v * f64::cos(direction), v * f64::sin(direction)], 0.0);
        let rest = rest(&car([1.0; 4]), &Ground::level(0.7), &start);
        let way = v * v / (2.0 * 0.7 * GRAVITY);
        assert!((rest.position.x - way * f64::cos(direction)).abs() < 1e-9);
        assert!((rest.position.y - way * f64::sin(direction)).abs() < 1e-9);
        assert!((rest.time - v / (0.7 * GRAVITY)).abs() < 1e-9 && (rest.distance - way).abs() < 1e-9);
        assert_eq!(rest.heading, heading);
        let energy = rest.energy;
        assert!((energy.friction - 0.5 * 1500.0 * v * v).abs() < 1e-6 && energy.remainder.abs() < 1e-6);
    }
}

/// A vehicle with hardly any resistance rolls for hours, which does not count as rest.
#[test]
fn a_vehicle_without_drag_does_not_come_to_rest() {
    let start = start(0.3, [8.0, 2.0], 0.1);
    let ground = Ground::level(0.7);
    for drag in [0.0, 1e-4] {
        let rest = to_rest(&car([drag; 4]), Steer::straight(), &ground, &start, &Control::default(), |_| {});
        assert!(matches!(rest, Err(NoRest::StillMoving { .. })), "{drag}: {rest:?}");
    }
    // 8.2 m/s and 0.01: 84 s.
    assert!((rest(&car([0.01; 4]), &ground, &start).time - 84.0).abs() < 3.0);
}

/// S = v²/(2 g Σ d_i F_i/W): forward and backward.
#[test]
fn free_rolling() {
    let (a, b) = (1.2, 1.45);
    for (sign, drags) in [(1.0, [0.02, 0.05]), (-1.0, [0.02, 0.05]), (1.0, [0.1, 0.1])] {
        let [front, rear] = drags;
        let share = (front * b + rear * a) / (a + b);
        let v = 9.0;
        let rest =
            rest(&car([front, front, rear, rear]), &Ground::level(0.7), &start(0.0, [sign * v, 0.0], 0.0));
        assert!((rest.position.x - sign * v * v / (2.0 * share * GRAVITY)).abs() < 1e-9, "{rest:?}");
        assert!(rest.position.y.abs() < 1e-12 && rest.heading.abs() < 1e-12);
    }
}

/// About its own CG, with locked wheels at the distance ρ: I ω′ = −μ m g ρ, so Δψ = I ω²/(2 μ m g ρ).
#[test]
fn a_spin_about_the_centre() {
    let axles = Axles { cg_to_front: 1.3, cg_to_rear: 1.3, track: 1.5 };
    let chassis = Chassis::new(Body::new(1500.0, 2500.0).unwrap(), axles, [1.0; 4]).unwrap();
    for omega in [3.0, -5.0] {
        let rest = rest(&chassis, &Ground::level(0.6), &start(1.0, [0.0, 0.0], omega));
        let arm = f64::hypot(1.3, 0.75);
        let turn = 2500.0 * omega * omega / (2.0 * 0.6 * 1500.0 * GRAVITY * arm);
        assert!((rest.heading - 1.0 - turn * omega.signum()).abs() < 1e-9, "{rest:?}");
        assert!(rest.position.norm() < 1e-12 && rest.distance < 1e-12);
    }
}

/// a = g (μ cos θ + sin θ) uphill, tan θ the grade.
#[test]
fn uphill_and_downhill() {
    for (grade, direction) in [(0.1_f64, 0.0), (-0.1, 0.0), (0.06, 2.5)] {
        let along = [f64::cos(direction), f64::sin(direction)];
        let ground = Ground { grade: Vector2::new(grade * along[0], grade * along[1]), ..Ground::level(0.7) };
        let v = 12.0;
        let rest = rest(&car([1.0; 4]), &ground, &start(0.4, along.map(|x| x * v), 0.0));
        let angle = f64::atan(grade);
        let way = v * v / (2.0 * GRAVITY * (0.7 * f64::cos(angle) + f64::sin(angle)));
        assert!((rest.distance - way).abs() < 1e-9, "{rest:?}, {way}");
        let slide = Slide { friction: 0.7, drag_share: 1.0, grade, distance: way };
        assert!((slide.speed_at_start(0.0).unwrap() - v).abs() < 1e-9);
        assert!((rest.energy.grade + 1500.0 * GRAVITY * f64::sin(angle) * way).abs() < 1e-6);
        let slid = 1500.0 * GRAVITY * 0.7 * f64::cos(angle) * way;
        assert!((rest.energy.friction - slid).abs() < 1e-6, "{:?}, {slid}", rest.energy);
    }
}

#[test]
fn a_grade_holds_or_moves_the_vehicle() {
    let up = |grade: f64, drag: f64, friction: f64, v: f64| {
        let ground = Ground { grade: Vector2::new(grade, 0.0), ..Ground::level(friction) };
        to_rest(
            &car([drag; 4]),
            Steer::straight(),
            &ground,
            &start(0.0, [v, 0.0], 0.0),
            &Control::default(),
            |_| {},
        )
    };
    // A drag of 6 % of the load on the wheels holds if tan θ is less.
    assert!(up(0.059, 0.06, 0.7, 5.0).is_ok() && up(0.059, 0.06, 0.7, 0.0).is_ok());
    assert!(matches!(up(0.061, 0.06, 0.7, 5.0), Err(NoRest::RollsBack { .. })));
    assert!(matches!(up(0.061, 0.06, 0.7, 0.0), Err(NoRest::RollsBack { .. })));
    assert!(matches!(up(0.31, 1.0, 0.3, 5.0), Err(NoRest::SlidesDown { .. })));
    assert!(matches!(up(-0.1, 0.06, 0.7, 5.0), Err(NoRest::StillMoving { .. })));
}

/// One axle after the other enters the slippery part: v² falls by 2 g S (μ's mean over the load) each time.
#[test]
fn ground_that_changes() {
    let corners = [(8.0, -3.0), (30.0, -3.0), (30.0, 3.0), (8.0, 3.0)].map(|(x, y)| Vector2::new(x, y));
    let zones = [
        FrictionZone { region: Region::half_plane(Vector2::new(8.0, 5.0), 0.0), friction: 0.3 },
        FrictionZone { region: Region::Polygon(&corners), friction: 0.3 },
    ];
    let (a, b, v) = (1.2, 1.45, 14.0_f64);
    let front = b / (a + b);
    // The front axle at 8 m after 8 − a, the rear axle after 8 + b.
    let mut square = v * v;
    square -= 2.0 * GRAVITY * 0.8 * (8.0 - a);
    square -= 2.0 * GRAVITY * (0.3 * front + 0.8 * (1.0 - front)) * (a + b);
    let way = 8.0 + b + square / (2.0 * GRAVITY * 0.3);
    for zone in &zones {
        let ground = Ground { zones: std::slice::from_ref(zone), ..Ground::level(0.8) };
        let rest = rest(&car([1.0; 4]), &ground, &start(0.0, [v, 0.0], 0.0));
        assert!((rest.distance - way).abs() < 1e-9, "{rest:?}, {way}");
        assert!(rest.energy.remainder.abs() < 1e-6, "{:?}", rest.energy);
    }
}

/// The same turned by a quarter turn, with two zones of which the later counts.
#[test]
fn the_later_zone_counts() {
    let slippery =
        FrictionZone { region: Region::half_plane(Vector2::new(0.0, -50.0), FRAC_PI_2), friction: 0.1 };
    let rough = FrictionZone { friction: 0.8, ..slippery };
    let way = |zones: &[FrictionZone]| {
        rest(&car([1.0; 4]), &Ground { zones, ..Ground::level(0.5) }, &start(0.0, [0.0, 9.0], 0.0)).distance
    };
    assert!((way(&[slippery, rough]) - 81.0 / (1.6 * GRAVITY)).abs() < 1e-9);
    assert!((way(&[rough, slippery]) - 81.0 / (0.2 * GRAVITY)).abs() < 1e-9);
}

/// Marquard's two phases by hand: friction reduces the speed while sideways, the yaw rate while in line.
#[test]
fn a_spin_in_two_phases() {
    let (friction, yaw_radius, wheelbase) = (0.7, 1.3, 2.6);
    let start = Spin { friction, distance: 15.0, turn: -2.5, yaw_radius, wheelbase }.start().unwrap();
    // Sideways for t₁ the speed falls by μ g; in line for t₂ the yaw rate by μ g (a + b)/(2k²). Both fall
    // evenly over the whole, so S = V T/2 and Δψ = Ω T/2, and the times add up: t₁ + t₂ = T.
    let sideways = start.speed / (friction * GRAVITY);
    let in_line = start.yaw_rate.abs() * 2.0 * yaw_radius * yaw_radius / (friction * GRAVITY * wheelbase);
    assert!((sideways + in_line - start.time).abs() < 1e-12);
    assert!((start.speed * start.time / 2.0 - 15.0).abs() < 1e-12);
    assert!((start.yaw_rate * start.time / 2.0 + 2.5).abs() < 1e-12);
}

#[test]
fn edcrash_says_what_spins() {
    let spins = |sideslip: f64, turn: f64, steer: f64| spins(sideslip, turn, 20.0, 2.6, steer).unwrap();
    assert!(!spins(0.17, 0.0, 0.0) && spins(0.18, 0.0, 0.0) && spins(-0.18, 0.0, 0.0));
    assert!(spins(0.0, 0.5, 0.0) && !spins(0.0, 0.5, 0.1) && spins(0.0, -0.5, 0.1));
    assert!(spins(3.0, 0.0, 0.0));
}
