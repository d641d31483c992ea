//! Courses, crossings, gaps and sight, compared with brute force.

use proptest::prelude::*;
use time_distance::{
    Advance, Course, Crossing, InvalidInput, Leg, Party, Phase, Response, Swell, Vector2, approach,
    first_contact, first_sight, free_since, least_gap, sees,
};

fn rest() -> Leg {
    Leg::at_rest(0.0, 0.0)
}

/// A pedestrian at 1.4 m/s, 5 m on the road of which the first is hidden (EVIDENCE: 4 m, 2 s walking at 2
/// m/s, 1 s running at 4).
#[test]
fn a_walk_takes_its_time() {
    for (speed, expected) in [(2.0, 2.0), (4.0, 1.0)] {
        let legs = [Leg { speed, ..rest() }];
        assert_eq!(Course::new(&legs).unwrap().reaches(4.0), Some(expected));
    }
    let still = [rest()];
    let still = Course::new(&still).unwrap();
    assert_eq!((still.reaches(1.0), still.reaches(0.0)), (None, Some(0.0)));
}

/// 12 m of skid at 7 m/s² to 20 km/h, before it 0.8 s at the same speed.
#[test]
fn an_approach_is_followed_backwards() {
    let impact = Leg { speed: 20.0 / 3.6, ..rest() };
    let skid = approach(&impact, Phase::Over { distance: 12.0, acceleration: -7.0 }).unwrap();
    let v = ((20.0 / 3.6_f64).powi(2) + 2.0 * 7.0 * 12.0).sqrt();
    assert!((skid.speed - v).abs() < 1e-12 && (skid.position + 12.0).abs() < 1e-12);
    assert!((skid.time + (v - 20.0 / 3.6) / 7.0).abs() < 1e-12);
    let before = approach(&skid, Phase::For { time: 0.8, acceleration: 0.0 }).unwrap();
    assert!((before.position - (skid.position - 0.8 * v)).abs() < 1e-12);
    // It sets out from a stop: v²/2a, v/a.
    let start = approach(&impact, Phase::FromRest { acceleration: 1.5 }).unwrap();
    assert!((start.position + (20.0 / 3.6_f64).powi(2) / 3.0).abs() < 1e-12);
    assert!((start.time + 20.0 / 3.6 / 1.5).abs() < 1e-12 && start.speed == 0.0);
    // Followed forward it is there again.
    let again = skid.after(-skid.time);
    assert!((again.speed - impact.speed).abs() < 1e-12 && again.position.abs() < 1e-12);
    // Any two of its numbers determine the others.
    let (speed, distance, time, acceleration) = (skid.speed, -skid.position, -skid.time, -7.0);
    for phase in [
        Phase::For { time, acceleration },
        Phase::From { speed, acceleration },
        Phase::FromOver { speed, distance },
        Phase::FromFor { speed, time },
        Phase::OverFor { distance, time },
    ] {
        let found = approach(&impact, phase).unwrap();
        for (found, expected) in [
            (found.speed, skid.speed),
            (found.position, skid.position),
            (found.time, skid.time),
            (found.acceleration, skid.acceleration),
        ] {
            assert!((found - expected).abs() < 1e-12, "{phase:?}: {found} {expected}");
        }
    }
    // Impossible values.
    assert!(approach(&impact, Phase::FromOver { speed: 1.0, distance: 0.0 }).is_err());
    assert!(approach(&impact, Phase::FromFor { speed: -1.0, time: 1.0 }).is_err());
    assert!(approach(&impact, Phase::OverFor { distance: 1.0, time: 1.0 }).is_err());
    assert!(approach(&impact, Phase::Over { distance: 12.0, acceleration: 7.0 }).is_err());
    assert!(approach(&impact, Phase::For { time: 60.0, acceleration: 1.5 }).is_err());
    assert!(approach(&rest(), Phase::Over { distance: 1.0, acceleration: 0.0 }).is_err());
    assert!(approach(&impact, Phase::From { speed: 1.0, acceleration: -1.0 }).is_err());
}

/// Wenxue City's van: 4 m long, lanes of 3.7 m, 3.56 m/s². It is in the second lane after 2.0799 s and out of
/// it after 2.5307 s.
#[test]
fn a_start_takes_its_time() {
    let van = Advance::FromStop { acceleration: 3.56, up_to: None };
    assert!((van.time_over(7.7_f64).unwrap() - 2.079_866).abs() < 1e-6);
    assert!((van.time_over(11.4).unwrap() - 2.530_710).abs() < 1e-6);
    // 1.5 m/s² up to 3 m/s: 2 s and 3 m to get there, then 4 s for 12 m.
    let walker = Advance::FromStop { acceleration: 1.5_f64, up_to: Some(3.0) };
    for (distance, time) in [(0.0, 0.0), (0.75, 1.0), (3.0, 2.0), (15.0, 6.0)] {
        assert!((walker.time_over(distance).unwrap() - time).abs() < 1e-15);
    }
    assert_eq!(Advance::Steady { speed: 1.5 }.time_over(6.0).unwrap(), 4.0);
    for refused in [
        van.time_over(-1.0),
        Advance::Steady { speed: 0.0 }.time_over(1.0),
        Advance::FromStop { acceleration: 0.0, up_to: None }.time_over(1.0),
        Advance::FromStop { acceleration: 1.0, up_to: Some(-1.0) }.time_over(1.0),
        van.time_over(f64::NAN),
    ] {
        assert!(refused.is_err());
    }
}

proptest! {
    /// The same as by legs of constant acceleration, with the time found by halving.
    #[test]
    fn a_start_is_that_of_its_legs(acceleration in 0.2..5.0_f64, most in 0.5..15.0_f64, distance in 0.0..80.0_f64) {
        let reached = most / acceleration;
        let begin = Leg { acceleration, ..rest() };
        let legs = [begin, Leg { speed: most, acceleration: 0.0, ..begin.after(reached) }];
        let expected = Course::new(&legs).unwrap().reaches(distance).unwrap();
        let found = Advance::FromStop { acceleration, up_to: Some(most) }.time_over(distance).unwrap();
        prop_assert!((found - expected).abs() < 1e-9 * (1.0 + expected), "{found}, {expected}");
    }

    /// Both outlines are turned and moved in small steps: while any of their points are in both strips'
    /// common part, the zone is occupied.
    #[test]
    fn a_zone_is_what_both_sweep(angle in 0.3..2.8_f64, w1 in 0.5..3.0_f64, w2 in 0.5..3.0_f64) {
        let of = |width| Party { front: 2.0, rear: 1.5, width };
        let crossing = Crossing::new(angle, [of(w1), of(w2)]).unwrap();
        for ((own, other), half) in [(w1, w2), (w2, w1)].into_iter().zip(crossing.half_zones()) {
            // Points of the own strip that lie in the other's: the extreme along the own path.
            let mut most = 0.0_f64;
            for i in 0..=2000 {
                let y = own * (f64::from(i) / 2000.0 - 0.5);
                // |x sin θ − y cos θ| ≤ w/2
                let x = (other / 2.0 + (y * angle.cos()).abs()) / angle.sin().abs();
                most = most.max(x);
            }
            prop_assert!((half - most).abs() < 1e-9, "{half} {most}");
        }
        // The other way round is the same.
        let turned = Crossing::new(-angle, [of(w1), of(w2)]).unwrap();
        prop_assert!((turned.half_zones()[0] - crossing.half_zones()[0]).abs() < 1e-12);
    }

    #[test]
    fn the_least_gap_is_that_of_small_steps(
        v1 in 1.0..40.0_f64, v2 in 0.0..40.0_f64, r1 in 0.0..2.0_f64, r2 in 0.0..1.0_f64, swell in 0.01..0.5_f64,
        a1 in 2.0..9.0_f64, a2 in 2.0..9.0_f64, gap in 0.0..60.0_f64,
    ) {
        let one = Response::new(r1, swell, a1, Swell::Linear).unwrap().legs(v1);
        let two = Response::new(r2, swell, a2, Swell::Linear).unwrap().legs(v2);
        let two = two.map(|leg| Leg { position: leg.position + gap, ..leg });
        let (behind, ahead) = (Course::new(&one).unwrap(), Course::new(&two).unwrap());
        let end = one[3].time.max(two[3].time);
        let found = least_gap(&behind, &ahead, [0.0, end]);
        let mut least = f64::INFINITY;
        for step in 0..=4000 {
            let t = end * f64::from(step) / 4000.0;
            least = least.min(ahead.at(t).position - behind.at(t).position);
        }
        prop_assert!(found.distance <= least + 1e-9, "{} {}", found.distance, least);
        prop_assert!(least - found.distance < 1e-3, "{} {}", found.distance, least);
        let at = ahead.at(found.time).position - behind.at(found.time).position;
        prop_assert!((at - found.distance).abs() < 1e-9);
        // The first contact is the first step without a gap.
        let step = end / 4000.0;
        let apart = |t: f64| ahead.at(t).position - behind.at(t).position;
        let met = (0..=4000).map(|k| step * f64::from(k)).find(|t| apart(*t) <= 0.0);
        match (first_contact(&behind, &ahead, [0.0, end]), met) {
            (Some(contact), Some(met)) => {
                prop_assert!(contact.time <= met + 1e-9 && contact.time >= met - step - 1e-9, "{:?} {}", contact, met);
                prop_assert!(contact.distance.abs() < 1e-9 && contact.closing >= -1e-9, "{:?}", contact);
            }
            // Between two steps they may touch.
            (contact, None) => prop_assert!(contact.is_none() || least < 1e-3, "{:?}", contact),
            (None, Some(met)) => prop_assert!(false, "{}", met),
        }
    }
}

/// A corner of a house: a pedestrian steps out behind it.
#[test]
fn a_corner_hides_until_the_line_is_free() {
    let p = |x, y| Vector2::new(x, y);
    let house = [p(0.0, 3.0), p(10.0, 3.0), p(10.0, 20.0), p(0.0, 20.0)];
    // The car drives along y = 0, the pedestrian waits at (12, 5) and sees it past the corner (10, 3): the
    // line of slope 1 meets y = 0 at x = 7.
    let positions = |t: f64| [p(-20.0 + 10.0 * t, 0.0), p(12.0, 5.0)];
    let seen = first_sight(positions, &[&house], [0.0, 5.0], 50).unwrap();
    assert!((seen - 2.7).abs() < 1e-9, "{seen}");
    assert!(sees(p(8.0, 0.0), p(12.0, 5.0), &house) && !sees(p(6.0, 0.0), p(12.0, 5.0), &house));
    // Inside of it nothing is seen, and nothing hides without an outline.
    assert!(!sees(p(1.0, 4.0), p(2.0, 5.0), &house) && sees(p(0.0, 0.0), p(1.0, 0.0), &[]));
    // Free from the left of the house, hidden by it, and free again: the last time counts.
    let wide = |t: f64| [p(-20.0 + 10.0 * t, 0.0), p(12.0 - 20.0 * (5.0 - t), 5.0)];
    // At 0 s the other one is at (−88, 5), left of the house.
    assert_eq!(first_sight(wide, &[&house], [0.0, 5.0], 500), Some(0.0));
    // It then goes through the house, and comes out of it at x = 10: −88 + 20 t = 10.
    let free = free_since(wide, &[&house], [0.0, 5.0], 500).unwrap();
    assert!((free - 4.9).abs() < 1e-9, "{free}");
    assert_eq!(free_since(wide, &[], [0.0, 5.0], 500), Some(0.0));
    assert_eq!(free_since(wide, &[&house], [0.0, 4.0], 500), None);
    let behind = |_: f64| [p(-20.0, 4.0), p(30.0, 4.0)];
    assert_eq!(first_sight(behind, &[&house], [0.0, 5.0], 50), None);
}

/// A line through corners is free only where it does not lead through the inside between them.
#[test]
fn a_line_through_a_corner_is_hidden_inside_only() {
    let p = |x, y| Vector2::new(x, y);
    // Its corners (10, 15) and (20, 5) lie on x + y = 25, (10, 5) and (20, 15) on y = x − 5.
    let square = [p(10.0, 5.0), p(20.0, 5.0), p(20.0, 15.0), p(10.0, 15.0)];
    let diamond = [p(0.0, 1.0), p(1.0, 0.0), p(0.0, -1.0), p(-1.0, 0.0)];
    // A slot from x = 2 to 4 opens upward; its floor is at y = 1.
    let u = [(0.0, 0.0), (6.0, 0.0), (6.0, 3.0), (4.0, 3.0), (4.0, 1.0), (2.0, 1.0), (2.0, 3.0), (0.0, 3.0)]
        .map(|(x, y)| p(x, y));
    let cases = [
        // through two corners, and from within through one
        (&square[..], [5.0, 0.0, 25.0, 20.0], false),
        (&square[..], [0.0, 25.0, 25.0, 0.0], false),
        (&diamond[..], [-5.0, 0.0, 5.0, 0.0], false),
        (&square[..], [15.0, 10.0, 25.0, 20.0], false),
        // in at a corner and out through a side
        (&square[..], [5.0, 0.0, 25.0, 10.0], false),
        (&square[..], [10.0, 0.0, 12.5, 20.0], false),
        // from side to side, from corner to corner, along a side within and beyond it
        (&square[..], [10.0, 7.0, 20.0, 9.0], false),
        (&square[..], [10.0, 5.0, 20.0, 15.0], false),
        (&square[..], [0.0, 5.0, 30.0, 5.0], true),
        (&square[..], [12.0, 5.0, 18.0, 5.0], true),
        // past one corner, to one corner, away from a side
        (&diamond[..], [-5.0, 1.0, 5.0, 1.0], true),
        (&square[..], [0.0, 0.0, 10.0, 5.0], true),
        (&square[..], [20.0, 9.0, 25.0, 9.0], true),
        // along the floor of the slot alone, on through a wall of it, over both walls, into the slot
        (&u[..], [2.0, 1.0, 4.0, 1.0], true),
        (&u[..], [2.0, 1.0, 5.0, 1.0], false),
        (&u[..], [-1.0, 3.0, 7.0, 3.0], true),
        (&u[..], [3.0, 5.0, 2.0, 1.0], true),
        (&u[..], [-1.0, 2.0, 3.0, 2.0], false),
        // through the reflex corner of the slot into the ground
        (&u[..], [3.0, 2.0, 1.0, 0.0], false),
        // what is nowhere sees nothing
        (&square[..], [f64::NAN, 0.0, 0.0, 0.0], false),
        (&square[..], [0.0, 0.0, 0.0, f64::INFINITY], false),
    ];
    for (outline, [x, y, to_x, to_y], free) in cases {
        for turned in 0..outline.len() {
            let mut corners = outline.to_vec();
            corners.rotate_left(turned);
            for _ in 0..2 {
                corners.reverse();
                assert_eq!(sees(p(x, y), p(to_x, to_y), &corners), free, "{x} {y} {to_x} {to_y} {corners:?}");
                assert_eq!(sees(p(to_x, to_y), p(x, y), &corners), free, "{to_x} {to_y} {x} {y} {corners:?}");
            }
        }
    }
    let through = |_: f64| [p(-5.0, 0.0), p(5.0, 0.0)];
    assert_eq!(first_sight(through, &[&diamond], [0.0, 5.0], 50), None);
    assert!(!sees(p(f64::NAN, 0.0), p(1.0, 0.0), &[]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// On a grid, where lines meet corners and run along sides all the time: hidden where one of many points
    /// of the line is inside of a triangle, by the signs of integers.
    #[test]
    fn sight_past_a_triangle_is_that_of_its_points(
        c in [[0..7_i64, 0..7_i64], [0..7_i64, 0..7_i64], [0..7_i64, 0..7_i64]],
        a in [0..7_i64, 0..7_i64],
        b in [0..7_i64, 0..7_i64],
    ) {
        let turn = |p: [i64; 2], q: [i64; 2], r: [i64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        if a == b || turn(c[0], c[1], c[2]) == 0 {
            return Ok(());
        }
        // Pieces inside are longer than a thousandth of the line.
        const PARTS: i64 = 2999;
        let scaled = c.map(|corner| corner.map(|x| x * PARTS));
        let is_inside = |point: [i64; 2]| {
            let signs = [0, 1, 2].map(|i| turn(scaled[i], scaled[(i + 1) % 3], point).signum());
            signs == [1; 3] || signs == [-1; 3]
        };
        let hidden = (1..PARTS).any(|i| is_inside([0, 1].map(|axis| a[axis] * (PARTS - i) + b[axis] * i)));
        let p = |[x, y]: [i64; 2]| Vector2::new(x as f64, y as f64);
        prop_assert_eq!(sees(p(a), p(b), &c.map(p)), !hidden);
    }
}

/// By halvings alone, the moment of a change between two steps.
fn by_halvings(mut before: f64, mut after: f64, sees: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = f64::midpoint(before, after);
        if sees(middle) == sees(after) { after = middle } else { before = middle }
    }
    after
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Two road users, one of which brakes, past two obstacles of four corners each.
    #[test]
    fn the_moment_of_sight_is_that_of_halvings(
        eye in [-30.0..-2.0_f64, -3.0..3.0_f64, 3.0..20.0_f64, -9.0..3.0_f64],
        point in [-4.0..4.0_f64, -15.0..15.0_f64, -2.0..2.0_f64, -6.0..6.0_f64],
        corners in [[-10.0..10.0_f64, -8.0..8.0_f64, 0.2..4.0_f64, 0.2..4.0_f64],
                    [-10.0..10.0_f64, -8.0..8.0_f64, 0.2..4.0_f64, 0.2..4.0_f64]],
        turned in 0.0..6.2_f64,
    ) {
        let box_of = |[x, y, ahead, aside]: [f64; 4]| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| {
                let (u, v) = (a * ahead, b * aside);
                Vector2::new(x + u * turned.cos() - v * turned.sin(), y + u * turned.sin() + v * turned.cos())
            })
        };
        let [one, two] = corners.map(box_of);
        let outlines: [&[Vector2<f64>]; 2] = [&one, &two];
        let positions = |t: f64| {
            [Vector2::new(eye[0] + (eye[2] + 0.5 * eye[3] * t) * t, eye[1]),
             Vector2::new(point[0] + point[2] * t, point[1] + point[3] * t)]
        };
        let is_seen = |t: f64| {
            let [from, to] = positions(t);
            outlines.iter().all(|outline| sees(from, to, outline))
        };
        let (end, steps) = (4.0, 80);
        let at = |step: u32| end * f64::from(step) / f64::from(steps);
        let first = (0..=steps).find(|step| is_seen(at(*step)));
        let expected = first.map(|step| {
            if step == 0 { 0.0 } else { by_halvings(at(step - 1), at(step), is_seen) }
        });
        let found = first_sight(positions, &outlines, [0.0, end], steps);
        prop_assert_eq!(found.is_some(), expected.is_some());
        let changes = |found: Option<f64>, expected: Option<f64>| match (found, expected) {
            // More than one change in a step may have more than one answer: each is one.
            (Some(found), Some(expected)) => (found - expected).abs() < 1e-11
                || is_seen(found - 1e-9) != is_seen(found + 1e-9),
            (found, expected) => found == expected,
        };
        prop_assert!(changes(found, expected), "{found:?} {expected:?}");
        let last = (0..=steps).rev().find(|step| !is_seen(at(*step)));
        let expected = match last {
            None => Some(0.0),
            Some(step) if step == steps => None,
            Some(step) => Some(by_halvings(at(step), at(step + 1), is_seen)),
        };
        let found = free_since(positions, &outlines, [0.0, end], steps);
        prop_assert!(changes(found, expected), "{found:?} {expected:?}");
    }
}

/// George and Bill (printed example): no collision in time, though not in space.
#[test]
fn who_is_in_the_zone_when() {
    let car = Party { front: 6.5, rear: 6.5, width: 7.0 };
    let crossing = Crossing::new(std::f64::consts::FRAC_PI_2, [car, car]).unwrap();
    let response = Response::new(0.0, 0.0, 30.0, Swell::Linear).unwrap();
    let george = response.legs(100.0).map(|leg| Leg { position: leg.position - 125.0, ..leg });
    let bill = [Leg { speed: 30.0, position: -150.0, ..rest() }];
    let (george, bill) = (Course::new(&george).unwrap(), Course::new(&bill).unwrap());
    let [george, bill] = crossing.occupancies([&george, &bill]);
    assert!((george.leaves.unwrap() - 1.880_367).abs() < 1e-6, "{george:?}");
    assert!((bill.enters.unwrap() - 4.666_667).abs() < 1e-6, "{bill:?}");
    assert!((george.margin_before(&bill).unwrap() - 2.7863).abs() < 1e-4 && !george.overlaps(&bill));
}

/// A road user who never comes leaves no margin; one who stays leaves none that is finite.
#[test]
fn who_never_enters_has_no_margin() {
    let party = Party { front: 1.0, rear: 1.0, width: 2.0 };
    let crossing = Crossing::new(1.0, [party, party]).unwrap();
    let [away, stays, comes] = [(-50.0, 0.0), (0.0, 0.0), (-50.0, 10.0)]
        .map(|(position, speed)| [Leg { position, speed, ..rest() }]);
    let [away, stays, comes] = [&away, &stays, &comes].map(|legs| Course::new(legs).unwrap());
    let [never, enters] = crossing.occupancies([&away, &comes]);
    assert_eq!((never.margin_before(&enters), enters.margin_before(&never)), (None, None));
    let [stays, enters] = crossing.occupancies([&stays, &comes]);
    assert_eq!(stays.margin_before(&enters), Some(f64::NEG_INFINITY));
}

#[test]
fn parallel_paths_do_not_cross() {
    let party = Party { front: 1.0, rear: 1.0, width: 2.0 };
    let pi = std::f64::consts::PI;
    for angle in [0.0, pi, -pi, 2.0 * pi, 1e-10] {
        let refusal = Crossing::new(angle, [party, party]).unwrap_err().to_string();
        assert!(refusal.contains("sine of the angle between the paths"), "{refusal}");
    }
    let refusal = Crossing::new(1e300, [party, party]).unwrap_err();
    assert!(matches!(refusal, InvalidInput::OutOfRange { what: "angle between the paths", .. }), "{refusal}");
    assert!(Crossing::new(1e-6, [party, party]).is_ok());
}

/// 10 m/s toward a vehicle that stands 50 m ahead, without an end to the search.
#[test]
fn a_contact_is_found_without_an_end() {
    let (behind, ahead) = ([Leg { speed: 10.0, ..rest() }], [Leg::at_rest(0.0, 50.0)]);
    let (behind, ahead) = (Course::new(&behind).unwrap(), Course::new(&ahead).unwrap());
    let met = first_contact(&behind, &ahead, [0.0, f64::INFINITY]).unwrap();
    assert!((met.time - 5.0).abs() < 1e-9 && met.distance.abs() < 1e-9, "{met:?}");
    assert_eq!(first_contact(&ahead, &behind, [0.0, f64::INFINITY]).map(|gap| gap.time), Some(0.0));
    assert_eq!(first_contact(&behind, &behind, [0.0, f64::INFINITY]).map(|gap| gap.time), Some(0.0));
    let apart = [Leg { speed: 10.0, position: 1.0, ..rest() }];
    assert_eq!(first_contact(&behind, &Course::new(&apart).unwrap(), [0.0, f64::INFINITY]), None);
}

#[test]
fn a_beginning_that_is_no_motion_is_refused() {
    let end = |speed: f64| Leg { speed, ..rest() };
    let phases = [
        Phase::Over { distance: 1.0, acceleration: -1.0 },
        Phase::For { time: 1.0, acceleration: -1.0 },
        Phase::FromRest { acceleration: 1.0 },
        Phase::From { speed: 10.0, acceleration: -1.0 },
        Phase::FromOver { speed: 1.0, distance: 1.0 },
        Phase::FromFor { speed: 1.0, time: 1.0 },
        Phase::OverFor { distance: 1.0, time: 1.0 },
    ];
    for phase in phases {
        for speed in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0] {
            assert!(approach(&end(speed), phase).is_err(), "{phase:?} {speed}");
        }
        assert!(approach(&Leg { time: f64::NAN, ..end(1.0) }, phase).is_err(), "{phase:?}");
        assert!(approach(&Leg { position: f64::INFINITY, ..end(1.0) }, phase).is_err(), "{phase:?}");
    }
    assert!(approach(&end(5e-324), Phase::Over { distance: 1.0, acceleration: 0.0 }).is_err());
    assert!(approach(&end(2.0), Phase::FromFor { speed: 1.0, time: 5e-324 }).is_err());
}

#[test]
fn a_start_is_refused_over_any_distance() {
    for distance in [0.0, 1.0] {
        assert!(Advance::FromStop { acceleration: 1.0, up_to: Some(-1.0) }.time_over(distance).is_err());
        assert!(
            Advance::FromStop { acceleration: 1.0, up_to: Some(f64::NAN) }.speed_after(distance).is_err()
        );
        assert!(Advance::FromStop { acceleration: 0.0, up_to: None }.time_over(distance).is_err());
    }
}
