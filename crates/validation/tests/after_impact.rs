//! From the impact to rest and back, and both speeds, compared with published values and other methods.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![allow(clippy::disallowed_methods, reason = "independent formulas, no bits of which are compared")]

use validation::{
    Cell, Data, ErrorRate, RestMethod, SpeedEvidence, Validation, ValidationError, speed_error, validate,
};

use crate::momentum::{AFTER, COLLINEAR, CROSSING};

const FOOT: f64 = 0.3048;
const G: f64 = 9.806_65;

fn built_in() -> Validation {
    validate(&Data::built_in()).unwrap()
}

/// The data with the first place after `mark` of one text of the motion replaced.
fn with_motion(mark: &str, old: &str, new: &str) -> Data {
    let mut data = Data::built_in();
    let (head, tail) = data.motion.split_at(data.motion.find(mark).unwrap());
    assert!(tail.contains(old), "{old:?} has to stand behind {mark:?}");
    data.motion = Box::leak(format!("{head}{}", tail.replacen(old, new, 1)).into_boxed_str());
    data
}

/// SAE 2004-01-1207: distance from impact to rest (ft), error in ft over error in % of Table 8; the turn
/// (degrees, counter-clockwise from above) is that from the heading of the test to the one of Table 7, which
/// counts clockwise from the course of vehicle 1.
const REST: [(u8, u8, f64, f64); 5] = [
    (3, 1, 102.8, 4.0),
    (3, 2, 155.0, 10.0 + 19.0),
    (6, 1, 60.2, -15.0),
    (6, 2, 21.5, 120.0 - 242.0),
    (10, 1, 43.0, -87.0),
];

/// The turns (degrees) of another simulation of one body on four wheels, at the same drags.
const OTHER_SIMULATION: [f64; 4] = [-2.0, -3.0, -4.0, -120.0];

#[test]
fn the_vehicles_roll_as_far_as_they_did() {
    let validation = built_in();
    assert_eq!(validation.motions.len(), REST.len());
    for (row, (test, vehicle, feet, turn)) in validation.motions.iter().zip(REST) {
        assert_eq!((row.test, row.vehicle.number()), (test, vehicle));
        assert!((row.distance.paper - feet * FOOT).abs() < 1e-9, "{row:?}");
        assert!((row.turn.paper - turn.to_radians()).abs() < 1e-9, "{row:?}");
        let free = test != 10;
        assert_eq!(row.distance.is_claimed(), free, "{row:?}");
        assert_eq!((row.distance.ours / (feet * FOOT) - 1.0).abs() <= 0.03, free, "{row:?}");
        // Only the Rabbit's turn is claimed, and only it comes out.
        let rabbit = (test, vehicle) == (6, 2);
        assert_eq!(row.turn.is_claimed(), rabbit, "{row:?}");
        assert_eq!((row.turn.ours.to_degrees() - turn).abs() <= 5.0, rabbit, "{row:?}");
        assert!(row.path >= row.distance.ours, "{row:?}");
    }
    for (row, turn) in validation.motions.iter().zip(OTHER_SIMULATION) {
        assert!((row.turn.ours.to_degrees() - turn).abs() <= 0.51, "{row:?}");
    }
}

/// The miss of test 6 by the cosine rule, from distance, path and angle of ours and of the print.
#[test]
fn the_rest_is_missed_by_a_tenth_of_the_way() {
    let validation = built_in();
    for row in &validation.motions {
        let Some(miss) = row.miss else {
            assert!(row.test != 6, "{row:?}");
            continue;
        };
        // From −x towards +y, 8° and 61° (Neades, Table 5.9); ours, by another simulation, 4.5° and 71.1°.
        let (printed, ours): (f64, f64) = if row.vehicle.number() == 1 { (8.0, 4.5) } else { (61.0, 71.1) };
        let [a, b] = [row.distance.ours, row.distance.paper];
        let rule = (a * a + b * b - 2.0 * a * b * (printed - ours).to_radians().cos()).sqrt();
        assert!((miss - rule).abs() < 0.02, "{row:?}: {rule}");
    }
}

/// A vector of a length (ft) at an angle (degrees) in the scene.
fn arm(length: f64, angle: f64) -> [f64; 2] {
    [length * angle.to_radians().cos(), length * angle.to_radians().sin()]
}

/// (ft) where the CG of vehicle 1 may have been at the impact, along and across the line between two centres:
/// on a circle around its own rest, and on one around that of vehicle 2, shifted by the distance of the CGs.
/// Half of the distance between the two possible places, squared, is below zero if there is none.
fn places(rest: [[f64; 2]; 2], distance: [f64; 2], apart: [f64; 2]) -> (f64, [[f64; 2]; 2]) {
    let (a, b) = (rest[0], [rest[1][0] - apart[0], rest[1][1] - apart[1]]);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = f64::hypot(dx, dy);
    let along = (distance[0].powi(2) - distance[1].powi(2) + length * length) / (2.0 * length);
    let square = distance[0].powi(2) - along * along;
    let places = [1.0, -1.0].map(|side| {
        let across = side * square.max(0.0).sqrt();
        [a[0] + (along * dx - across * dy) / length, a[1] + (along * dy + across * dx) / length]
    });
    (square, places)
}

/// The directions of Neades, Table 5.9 (8° and 61° from −x), beside those that rest positions (SAE
/// 2004-01-1207, Table 7: X, Y in ft, here −x, y), distances and contact points of test 6 tell: d_1 = 8.4 ft
/// at 180° − 17.9° and d_2 = 1.99 ft at 60° − 90° (its case). The CGs lie apart by r_1 − r_2.
#[test]
fn the_directions_of_test_6_agree_with_its_rest_positions() {
    let rest = [[-60.0, 11.0], [-20.0, 21.0]];
    let (r1, r2) = (arm(8.4, 162.1), arm(1.99, -30.0));
    let apart = [r1[0] - r2[0], r1[1] - r2[1]];
    let (square, places) = places(rest, [60.2, 21.5], apart);
    assert!(square > 0.0);
    // Of the two places, the one from which both vehicles went towards +y.
    let directions = places.map(|one| {
        let two = [one[0] + apart[0], one[1] + apart[1]];
        [(one, rest[0]), (two, rest[1])]
            .map(|(from, to)| 180.0 - f64::atan2(to[1] - from[1], to[0] - from[0]).to_degrees())
    });
    let [one, two] = directions.into_iter().find(|pair| pair.iter().all(|angle| *angle < 180.0)).unwrap();
    // The page says: 4° to 5° further round.
    assert!((4.0..5.0).contains(&(one - 8.0)) && (4.0..5.0).contains(&(two - 61.0)), "{one} {two}");
}

/// The rest positions and distances of test 2 have no such place: with contact points as in test 1, of the
/// same kind and vehicles (d_1 = 7.59 ft at 180° − 19.8°, d_2 = 3.44 ft at 60° − 38.7°), one circle lies
/// within the other.
#[test]
fn the_rest_positions_of_test_2_fit_no_impact() {
    let (r1, r2) = (arm(7.59, 160.2), arm(3.44, 21.3));
    let apart = [r1[0] - r2[0], r1[1] - r2[1]];
    let (square, _) = places([[-11.0, 9.4], [-23.6, 12.5]], [21.0, 28.0], apart);
    assert!(square < 0.0, "{square}");
}

#[test]
fn the_way_back_finds_the_published_velocity_again() {
    let validation = built_in();
    assert_eq!(validation.returns.len(), 4);
    for row in &validation.returns {
        let (_, after) = AFTER.iter().find(|(test, _)| *test == row.test).unwrap();
        let [x, y, yaw_rate] = after[row.vehicle.index()];
        let speed = f64::hypot(x, y);
        assert!((row.round_trip.paper - speed).abs() < 1e-12, "{row:?}");
        assert!((row.round_trip.ours / speed - 1.0).abs() < 0.001, "{row:?}");
        assert_eq!(row.from_rest.is_some(), row.test == 6, "{row:?}");
        let Some(found) = &row.from_rest else { continue };
        assert!((found.speed.paper - speed).abs() < 1e-12, "{row:?}");
        assert!((found.yaw_rate.paper - yaw_rate).abs() < 1e-12, "{row:?}");
        let cosine = f64::cos(found.direction.paper) * speed;
        assert!((cosine - x).abs() < 1e-9, "{row:?}");
    }
}

/// The statement on the published rest of test 6: it does not determine the velocity. The speeds are missed
/// by a third and by a half, and 5° in the direction of the path move that of vehicle 1 by a fifth.
#[test]
fn the_published_rest_does_not_tell_the_velocity() {
    let validation = built_in();
    let found: Vec<_> = validation.returns.iter().filter_map(|row| row.from_rest.as_ref()).collect();
    let share = |cell: &Cell| cell.ours / cell.paper - 1.0;
    assert!(share(&found[0].speed) > 0.3 && share(&found[1].speed) < -0.5, "{found:?}");
    assert!(found.iter().all(|found| !found.speed.is_claimed() && !found.yaw_rate.is_claimed()));
    let [less, more] = found[0].turned;
    assert!((less / found[0].speed.ours - 1.0).abs() > 0.15, "{found:?}");
    assert!((more / found[0].speed.ours - 1.0).abs() > 0.15, "{found:?}");
}

/// The errors of an independent calculation in plain arithmetic.
#[test]
fn both_speeds_are_those_of_plain_arithmetic() {
    let validation = built_in();
    let expected = CROSSING
        .map(|(test, errors)| (test, SpeedEvidence::Momentum, errors))
        .into_iter()
        .chain(COLLINEAR.map(|(test, errors)| (test, SpeedEvidence::MomentumAndCrush, errors)));
    let (mut all, mut shares) = (Vec::new(), Vec::new());
    for (test, evidence, errors) in expected {
        let row = validation.both_speeds.iter().find(|row| row.test == test).unwrap();
        assert_eq!(row.evidence, evidence);
        for (i, expected) in errors.into_iter().enumerate() {
            let (error, share) = speed_error(row.found[i], row.true_speeds[i]);
            let close = share.map_or((error - expected).abs(), |share| (100.0 * share - expected).abs());
            assert!(close <= 0.051, "{row:?}: {expected}");
            assert_eq!(share.is_none(), (3..=5).contains(&test) && i == 1);
            all.push(if share.is_some() { expected / 100.0 * row.true_speeds[i] } else { expected });
            shares.extend(share.map(|_| expected));
        }
    }
    assert_eq!(validation.both_speeds.len(), 11);
    // Of the listed errors, by hand.
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / f64::from(u32::try_from(errors.len()).unwrap());
    let rms = |errors: &[f64]| mean(&errors.iter().map(|error| error * error).collect::<Vec<_>>()).sqrt();
    let near = |rate: &ErrorRate, errors: &[f64], unit: f64| {
        assert_eq!(rate.count, errors.len());
        assert!((rate.mean / unit - mean(errors)).abs() < 0.03, "{rate:?}");
        assert!((rate.rms / unit - rms(errors)).abs() < 0.03, "{rate:?}");
    };
    let rates = &validation.both_speed_errors;
    near(&rates.all[0], &all, 1.0);
    near(&rates.all[1], &shares, 0.01);
    near(&rates.momentum[0], &all[..12], 1.0);
    near(&rates.momentum[1], &shares[..12], 0.01);
    near(&rates.momentum_and_crush[0], &all[12..], 1.0);
    near(&rates.momentum_and_crush[1], &shares[12..], 0.01);
}

/// m_1 ΔV_1 and −m_2 ΔV_2 at the true speeds, with masses (kg) and velocities (m/s) before impact of the
/// tests (Neades, Appendix D; Vossou 2018).
#[test]
fn the_impulses_of_the_vehicles_disagree() {
    let validation = built_in();
    for (test, [m1, m2], before) in [
        (1, [2096.0, 1398.0], [[-8.85, 0.0], [4.43, 7.67]]),
        (3, [2244.0, 1415.0], [[-9.48, 0.0], [0.0, 0.0]]),
        (6, [1950.0, 1190.0], [[-9.61, 0.0], [9.535 * 0.5, 9.535 * 0.866]]),
        (9, [1023.0, 2222.0], [[-9.48, 0.0], [0.0, 9.48]]),
        (10, [1046.0, 2141.0], [[-14.89, 0.0], [0.0, 14.89]]),
        (12, [1420.0, 2046.0], [[-14.08, 0.0], [13.87, -2.44]]),
    ] {
        let (_, after) = AFTER.iter().find(|(number, _)| *number == test).unwrap();
        let impulse = |i: usize, m: f64| [0, 1].map(|k: usize| m * (after[i][k] - before[i][k]));
        let (one, two) = (impulse(0, m1), impulse(1, m2).map(|p| -p));
        let apart = f64::hypot(one[0] - two[0], one[1] - two[1]);
        let mean = f64::hypot(one[0] + two[0], one[1] + two[1]) / 2.0;
        let row = validation.both_speeds.iter().find(|row| row.test == test).unwrap();
        // Vossou 2018 has (4.66, 8.32) for vehicle 2 of test 6; the impulses are those along its heading,
        // 60°.
        assert!((row.disagreement - apart / mean).abs() < 0.001, "{row:?}: {}", apart / mean);
    }
    let all = validation.both_speeds.iter().map(|row| row.disagreement);
    assert!(all.clone().fold(1.0, f64::min) > 0.085 && all.fold(0.0, f64::max) < 0.395);
}

/// Test 2 at 14.1 m/s each, test 3 at 9.48 m/s into a standing vehicle, test 6 at 9.61 and 9.54 m/s: the
/// results from the speeds after impact, by plain arithmetic.
#[test]
fn speeds_from_rest_follow_from_those_after_impact() {
    let validation = built_in();
    let methods: Vec<_> = validation.from_rest.iter().map(|row| (row.test, row.method)).collect();
    let (free, directed) = (RestMethod::Motion, RestMethod::MotionDirected);
    assert_eq!(methods, [(2, free), (2, directed), (3, RestMethod::Slide), (6, free), (6, directed)]);
    let mean = |drags: &[f64]| drags.iter().sum::<f64>() / f64::from(u32::try_from(drags.len()).unwrap());
    for row in &validation.from_rest {
        // The drags fitted to the other tests.
        let drag = match row.test {
            2 => mean(&[0.047, 0.050, 0.091, 0.062]),
            3 => mean(&[0.091, 0.062]),
            _ => mean(&[0.047, 0.050]),
        };
        assert!((row.drag - drag).abs() < 1e-12, "{row:?}");
        let (masses, angles) = match row.test {
            2 => ([2096.0, 1397.0], [19.0_f64, 64.0]),
            6 => ([1950.0, 1190.0], [8.0, 61.0]),
            _ => continue,
        };
        if row.method == RestMethod::Motion {
            continue;
        }
        let momentum = |of: fn(f64) -> f64| {
            (0..2).map(|i| masses[i] * row.after[i] * of(angles[i].to_radians())).sum::<f64>()
        };
        // Along −x and +y: v₂ sin 60° m₂ = p_y, m₁ v₁ − m₂ v₂ cos 60° = p_x
        let v2 = momentum(f64::sin) / (masses[1] * f64::sin(60_f64.to_radians()));
        let v1 = (momentum(f64::cos) + masses[1] * v2 / 2.0) / masses[0];
        assert!((row.found[0] - v1).abs() < 1e-9 && (row.found[1] - v2).abs() < 1e-9, "{row:?}");
    }
    // The statement of the page on the motion without a direction.
    assert!(validation.from_rest[3].found[1] < 0.0);
    let slide = &validation.from_rest[2];
    for (after, feet) in slide.after.into_iter().zip([102.8, 155.0]) {
        assert!((after - (2.0 * G * slide.drag * feet * FOOT).sqrt()).abs() < 1e-9, "{slide:?}");
    }
    // Along the line between the headings, 5° from either.
    let before = (2244.0 * slide.found[0] + 1415.0 * slide.found[1]) * f64::cos(5_f64.to_radians());
    let after = 2244.0 * slide.after[0] + 1415.0 * slide.after[1];
    assert!((before / after - 1.0).abs() < 1e-9, "{before} {after}");
    let truth: Vec<_> = validation.from_rest.iter().map(|row| (row.test, row.true_speeds)).collect();
    for (test, [one, two]) in truth {
        // 31.53 mph.
        let expected = match test {
            2 => [14.095, 14.095],
            3 => [9.48, 0.0],
            _ => [9.61, 9.535],
        };
        assert!((one - expected[0]).abs() < 1e-3 && (two - expected[1]).abs() < 1e-3, "{one} {two}");
    }
}

#[test]
fn a_wrong_digit_of_the_motion_is_found() {
    for (mark, old, new, expected) in [
        ("test     = 3\nvehicle  = 1", "102.8", "120.8", "motion to rest, test 3, vehicle 1, distance"),
        ("test      = 6\nvehicle   = 1", "0.091", "0.019", "motion to rest, test 6, vehicle 1, distance"),
        ("test      = 6\nvehicle   = 2", "242.0", "224.0", "motion to rest, test 6, vehicle 2, turn"),
        ("test   = 6\nmotion", "-3.14", "-3.41", "motion to rest, test 6, vehicle 2, distance"),
        ("friction", "0.87", "0.78", "motion to rest, test 6, vehicle 2, distance"),
    ] {
        let failures = validate(&with_motion(mark, old, new)).unwrap();
        let failures: Vec<_> = failures.failures().into_iter().map(|(place, _)| place).collect();
        assert!(failures.iter().any(|place| place == expected), "{new}: {failures:?}");
    }
}

#[test]
fn motions_that_do_not_fit_are_refused() {
    let refused = |mark, old, new| validate(&with_motion(mark, old, new)).unwrap_err();
    let error = refused("test   = 11", "test   = 11", "test   = 13");
    assert_eq!(
        error.to_string(),
        "the case of test 11 has no velocities after the impact, which the comparison needs"
    );
    let error = refused("friction", "friction =", "fraction =");
    assert!(matches!(error, ValidationError::Published(_)), "{error}");
    let error = refused("[[uncased]]", "test         = 2", "test         = 20");
    assert!(matches!(error, ValidationError::Incomplete { test: 2, .. }), "{error}");
    let error = refused("test     = 3\nvehicle  = 1", "0.047", "4.7");
    assert!(matches!(error, ValidationError::Law(_)), "{error}");
    assert!(error.to_string().contains("drag of a wheel"), "{error}");
}
