//! Many motions at once.

use trajectory::{
    Control, FrictionZone, Ground, NoRest, Outset, Region, Rest, State, Steer, Vector2, to_rest, to_rests,
};

use crate::scenes::{car, random, start, turned_car};

fn one_by_one(outsets: &[Outset<'_>], control: &Control) -> Vec<Result<Rest, NoRest>> {
    let alone = |outset: &Outset<'_>| {
        to_rest(&outset.chassis, outset.steer, &outset.ground, &outset.start, control, |_| {})
    };
    outsets.iter().map(alone).collect()
}

fn at_once(outsets: &[Outset<'_>], control: &Control) -> Vec<Result<Rest, NoRest>> {
    let mut rests = vec![None; outsets.len()];
    to_rests(outsets, control, |number, rest| {
        assert!(rests[number].replace(rest).is_none(), "{number} comes twice");
    });
    rests.into_iter().map(Option::unwrap).collect()
}

/// Spin-outs on level ground and on grades, with wheels straight and turned.
fn outsets(count: usize) -> Vec<Outset<'static>> {
    let mut random = random(31);
    let mut outset = || {
        let (chassis, start, ground) = turned_car(&mut random);
        let grade = Vector2::new(0.02 * random() - 0.01, 0.02 * random() - 0.01);
        let steer = if random() < 0.5 { Steer::straight() } else { Steer::Held(0.6 * random() - 0.3) };
        Outset { chassis, steer, ground: Ground { grade, ..ground }, start }
    };
    (0..count).map(|_| outset()).collect()
}

#[test]
fn each_motion_has_the_bits_of_a_run_alone() {
    let outsets = outsets(200);
    for control in [
        Control::default(),
        Control { tolerance: 5e-4, ..Control::default() },
        Control { closed_end: false, ..Control::default() },
        // With these, some have no rest.
        Control { longest_time: 2.0, ..Control::default() },
        Control { most_steps: 60, ..Control::default() },
    ] {
        assert!(at_once(&outsets, &control) == one_by_one(&outsets, &control), "{control:?}");
    }
}

/// Overlapping lines, strips and polygons of different friction in the path, on level ground and on grades.
#[test]
fn motions_over_zones_have_the_bits_of_runs_alone() {
    let mut random = random(37);
    let corners: Vec<[Vector2<f64>; 4]> = (0..40)
        .map(|_| {
            let [x, y, half] = [20.0 * random() - 10.0, 20.0 * random() - 10.0, 0.3 + 6.0 * random()];
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[a, b]| Vector2::new(x + half * a, y + half * b))
        })
        .collect();
    let zones: Vec<[FrictionZone<'_>; 2]> = corners
        .iter()
        .map(|corners| {
            let point = Vector2::new(12.0 * random() - 6.0, 12.0 * random() - 6.0);
            [
                FrictionZone {
                    region: Region::half_plane(point, 7.0 * random()),
                    friction: 0.2 + 0.5 * random(),
                },
                FrictionZone { region: Region::Polygon(corners), friction: 0.2 + 0.7 * random() },
            ]
        })
        .collect();
    let mut outsets = outsets(300);
    for (number, outset) in outsets.iter_mut().enumerate() {
        if number % 5 != 0 {
            let count = number % 3;
            outset.ground.zones = &zones[number % zones.len()][..count];
        }
    }
    let plain = Control::default();
    for control in [
        plain,
        Control { tolerance: 5e-3, ..plain },
        Control { longest_time: 2.0, ..plain },
        Control { most_steps: 60, ..plain },
    ] {
        assert!(at_once(&outsets, &control) == one_by_one(&outsets, &control), "{control:?}");
    }
    // The zones affect most of them.
    let (with, mut without) = (one_by_one(&outsets, &plain), outsets.clone());
    for outset in &mut without {
        outset.ground.zones = &[];
    }
    let changed = with.iter().zip(one_by_one(&without, &plain)).filter(|(a, b)| *a != b).count();
    assert!(changed > 100, "{changed}");
}

/// A motion that crosses a hundred stripes of a metre each takes more steps than are allowed.
#[test]
fn many_borders_end_like_those_of_a_run_alone() {
    let stripes: Vec<[Vector2<f64>; 4]> = (-50..50)
        .map(|stripe| {
            let (left, right) = (f64::from(stripe), f64::from(stripe) + 0.5);
            [(left, -99.0), (right, -99.0), (right, 99.0), (left, 99.0)].map(|(x, y)| Vector2::new(x, y))
        })
        .collect();
    let zones: Vec<FrictionZone<'_>> = stripes
        .iter()
        .map(|stripe| FrictionZone { region: Region::Polygon(stripe), friction: 0.3 })
        .collect();
    let mut outsets = outsets(40);
    for outset in &mut outsets {
        outset.ground.zones = &zones;
    }
    let plain = Control::default();
    for control in [
        plain,
        Control { most_steps: 40, ..plain },
        Control { most_steps: 100, ..plain },
        Control { longest_time: 0.5, ..plain },
    ] {
        let rests = at_once(&outsets, &control);
        assert!(rests == one_by_one(&outsets, &control), "{control:?}");
    }
    let few = at_once(&outsets, &Control { most_steps: 100, ..plain });
    assert!(few.iter().filter(|rest| matches!(rest, Err(NoRest::TooManySteps { .. }))).count() > 10);
}

/// For any number and order of motions.
#[test]
fn a_motion_does_not_depend_on_its_neighbours() {
    let (outsets, control) = (outsets(70), Control::default());
    let all = at_once(&outsets, &control);
    for count in [0, 1, 7, 8, 9, 33] {
        assert!(at_once(&outsets[..count], &control) == all[..count], "{count}");
    }
    let turned: Vec<Outset<'_>> = outsets.iter().rev().copied().collect();
    assert!(at_once(&turned, &control).iter().rev().eq(&all));
}

/// Motions that lanes do not follow, or not to the end, among those that they do.
#[test]
fn zones_steering_and_errors_stand_among_others() {
    let zones = [FrictionZone { region: Region::half_plane(Vector2::new(4.0, 0.0), 0.3), friction: 0.35 }];
    let steering = [(0.0, 0.0), (1.0, 0.3)];
    let mut outsets = outsets(20);
    outsets[3].ground = Ground { zones: &zones, ..Ground::level(0.8) };
    outsets[7].steer = Steer::Over(&steering);
    outsets[11].start.motion.yaw_rate = f64::NAN;
    outsets[13].ground.friction = 0.0;
    outsets[15] = Outset {
        chassis: car([0.0; 4]),
        start: start(0.0, [10.0, 0.0], 0.0),
        steer: Steer::straight(),
        ground: Ground::level(0.7),
    };
    outsets[17].start = State { motion: start(0.0, [0.0, 0.0], 0.0).motion, ..outsets[17].start };
    let (control, rests) = (Control::default(), at_once(&outsets, &Control::default()));
    assert!(matches!(rests[11], Err(NoRest::Invalid(_))) && matches!(rests[13], Err(NoRest::Invalid(_))));
    assert!(matches!(rests[15], Err(NoRest::StillMoving { .. })));
    for (number, (rest, alone)) in rests.iter().zip(one_by_one(&outsets, &control)).enumerate() {
        // The text, as NaN is not equal to itself.
        assert_eq!(format!("{rest:?}"), format!("{alone:?}"), "{number}");
    }
}
