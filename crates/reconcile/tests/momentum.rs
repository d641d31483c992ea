//! Both speeds from momentum, compared with the impacts that it undoes.

use std::f64::consts::{FRAC_PI_2, PI};

use oracle::compare::{assert_close, assert_direction, assert_relative};
use oracle::scenes::{Car, Scene, for_all, scene, tangential};
use oracle::{Effects, Verdict, approach, scanned, verdict};
use pim_core::{Body, Contact, InvalidInput, Law, Participant, Real, Tangential, Vector2, VehicleId};
use proptest::prelude::*;
use real::Duals;
use reconcile::{
    COLLINEAR, Departure, EnergyBasis, EvidenceErrors, Implied, Momentum, MomentumAndCrush,
    MomentumBesideCrush, MomentumError, SolutionMethod,
};

/// A collision in which both vehicles move along their headings, and its impact.
#[derive(Clone, Copy, Debug)]
struct Crash {
    scene: Scene,
    speeds: [f64; 2],
    effects: Effects,
}

impl Crash {
    /// The collision at these speeds, reversed if the vehicles would separate.
    fn of(scene: Scene, speeds: [f64; 2]) -> Option<Self> {
        let at = |speeds: [f64; 2]| scene.at_speed(0, speeds[0]).at_speed(1, speeds[1]);
        let moving = at(speeds);
        let (scene, speeds) = if approach(&moving)[0] < 0.0 {
            (moving, speeds)
        } else {
            let back = speeds.map(|speed| -speed);
            let turned = |car: Car| Car { yaw_rate: -car.yaw_rate, ..car };
            (at(back).with_cars(turned), back)
        };
        match verdict(&scene) {
            Verdict::Impact(effects) => Some(Self { scene, speeds, effects }),
            _ => None,
        }
    }

    fn momentum(&self) -> Momentum {
        momentum(&self.scene, &self.effects)
    }

    /// (m/s) the scale of rounding in the speed of each vehicle, for a sine of 1.
    fn scale(&self) -> [f64; 2] {
        let [m1, m2] = self.scene.cars.map(|car| car.mass);
        let [a, b] = self.effects.velocities.map(|v| v[0].hypot(v[1]));
        let size = m1 * a + m2 * b;
        [size / m1, size / m2]
    }
}

fn momentum(scene: &Scene, effects: &Effects) -> Momentum {
    let after = |i: usize| Departure {
        velocity: Vector2::new(effects.velocities[i][0], effects.velocities[i][1]),
        yaw_rate: Some(effects.yaw_rates[i]),
    };
    Momentum {
        contact: scene.contact(),
        yaw_rates: scene.cars.map(|car| car.yaw_rate),
        after: [after(0), after(1)],
    }
}

/// Two moving vehicles; `turn` is the angle between their headings.
fn crash(turn: impl Strategy<Value = f64>) -> impl Strategy<Value = (Scene, [f64; 2])> {
    (scene(), turn, -60.0..60.0, -60.0..60.0, tangential(), 0.0..0.95).prop_map(
        |(scene, turn, v1, v2, tangential, restitution)| {
            let mut scene = Scene { restitution, ..scene }.under(tangential);
            for car in &mut scene.cars {
                car.fixed = false;
            }
            scene.cars[1].heading = scene.cars[0].heading + turn;
            (scene, [v1, v2])
        },
    )
}

/// Vehicles exchanged: P acts on the other vehicle, n and t are reversed.
fn swapped(m: &Momentum, crush_plane: f64) -> Momentum {
    let [one, two] = *m.contact.participants();
    let ([w1, w2], [a1, a2]) = (m.yaw_rates, m.after);
    Momentum { contact: Contact::new([two, one], crush_plane).unwrap(), yaw_rates: [w2, w1], after: [a2, a1] }
}

fn mirrored(m: &Momentum) -> Momentum {
    Momentum {
        contact: m.contact.mirrored(),
        yaw_rates: m.yaw_rates.map(|w| -w),
        after: m.after.map(|Departure { velocity, yaw_rate }| Departure {
            velocity: Vector2::new(velocity.x, -velocity.y),
            yaw_rate: yaw_rate.map(|w| -w),
        }),
    }
}

#[test]
fn momentum_undoes_an_impact() {
    for_all(10_000, 0.5, crash(-PI..PI), |(scene, speeds)| {
        let Some(crash) = Crash::of(scene, speeds) else { return false };
        let m = crash.momentum();
        let sine = (scene.cars[1].heading - scene.cars[0].heading).sin();
        assert_close("sine", m.sine(), sine, 1e-14);
        assert_eq!(m.is_collinear(), sine.abs() <= 10_f64.to_radians().sin());
        if m.is_collinear() {
            assert!(matches!(m.speeds(), Err(MomentumError::Collinear { .. })));
            return false;
        }
        let found = m.speeds().unwrap();
        let [b, a] = swapped(&m, scene.crush_plane).speeds().unwrap();
        let turned = mirrored(&m).speeds().unwrap();
        for i in 0..2 {
            let tolerance = 1e-12 * crash.scale()[i];
            assert_close("speed", found[i], crash.speeds[i], tolerance);
            assert_close("speed, labels exchanged", [a, b][i], found[i], tolerance);
            assert_close("speed, mirrored", turned[i], found[i], tolerance);
        }
        true
    });
}

/// If one speed is known, the other follows at any angle, even along one line.
#[test]
fn momentum_beside_a_known_speed_undoes_an_impact() {
    for_all(10_000, 0.5, crash(-PI..PI), |(scene, speeds)| {
        let Some(crash) = Crash::of(scene, speeds) else { return false };
        let m = crash.momentum();
        for (id, i) in [(VehicleId::One, 0), (VehicleId::Two, 1)] {
            let found = m.speed_beside(id, crash.speeds[1 - i]).unwrap();
            assert_close("speed", found, crash.speeds[i], 1e-12 * (crash.scale()[i] + found.abs()));
        }
        assert!(m.speed_beside(VehicleId::One, f64::NAN).is_err());
        true
    });
}

/// By hand: 1500 kg and 1000 kg leave together at 12 m/s along x, but the 1000 kg also at 3 m/s across. The
/// transverse component does not affect the speed.
#[test]
fn momentum_across_the_heading_is_not_taken_for_speed() {
    let one = Participant::new(Body::new(1500.0, 2500.0).unwrap(), 0.0, 2.0, 0.0).unwrap();
    let two = Participant::new(Body::new(1000.0, 1500.0).unwrap(), 0.0, -2.0, 0.0).unwrap();
    let after = |y: f64| Departure { velocity: Vector2::new(12.0, y), yaw_rate: None };
    let contact = Contact::new([one, two], PI).unwrap();
    let m = Momentum { contact, yaw_rates: [0.0; 2], after: [after(0.0), after(3.0)] };
    // (2500·12 − 1000·3)/1500, and (2500·12 − 1500·16)/1000
    assert_close("v_1", m.speed_beside(VehicleId::One, 3.0).unwrap(), 18.0, 1e-12);
    assert_close("v_2", m.speed_beside(VehicleId::Two, 16.0).unwrap(), 6.0, 1e-12);
}

/// EDCRASH's border, at every orientation of the scene.
#[test]
fn approaches_within_ten_degrees_of_a_line_are_collinear() {
    assert_eq!(COLLINEAR, 10_f64.to_radians());
    let body = Body::new(1500.0, 2500.0).unwrap();
    for step in -180..180 {
        let heading = f64::from(step).to_radians();
        let at = |turn: f64| {
            let one = Participant::new(body, heading, 2.0, 0.0).unwrap();
            let two = Participant::new(body, heading + turn.to_radians(), 2.0, 1.0).unwrap();
            Momentum {
                contact: Contact::new([one, two], heading + 0.3).unwrap(),
                yaw_rates: [0.0; 2],
                after: [Departure { velocity: Vector2::new(3.0, 4.0), yaw_rate: None }; 2],
            }
        };
        for turn in [0.0, 9.999, 10.0, 170.0, 170.001, 180.0] {
            for turn in [turn, -turn] {
                let refused = at(turn).speeds();
                let Err(MomentumError::Collinear { angle }) = refused else { panic!("{turn} {refused:?}") };
                assert_direction("angle", angle, turn.to_radians(), 1e-12);
            }
        }
        for turn in [10.001, 90.0, 169.999] {
            for turn in [turn, -turn] {
                assert!(at(turn).speeds().is_ok(), "{turn}");
            }
        }
    }
}

/// If the impulse is the whole interaction, its effects are those of the oracle.
#[test]
fn what_the_speeds_imply_is_what_the_impact_did() {
    for_all(10_000, 0.4, crash(-PI..PI), |(scene, speeds)| {
        let Some(crash) = Crash::of(scene.without_moment(), speeds) else { return false };
        let (m, effects, scene) = (crash.momentum(), crash.effects, crash.scene);
        let implied = m.implied(crash.speeds).unwrap();
        let size = effects.impulse[0].hypot(effects.impulse[1]);
        // ΔV is a difference of velocities, and P one of momenta.
        let momenta: f64 = (0..2)
            .map(|i| {
                scene.cars[i].mass
                    * (crash.speeds[i].abs() + effects.velocities[i][0].hypot(effects.velocities[i][1]))
            })
            .sum();
        let rounding = 1e-14 * momenta;
        if rounding > 1e-9 * size {
            return false;
        }
        assert_close("apart", implied.disagreement(), 0.0, rounding);
        assert_close("P_x", implied.impulse_vector.x, effects.impulse_vector[0], rounding);
        assert_close("P_y", implied.impulse_vector.y, effects.impulse_vector[1], rounding);
        assert_close("P_n", implied.impulse.normal, effects.impulse[0], rounding);
        assert_close("P_t", implied.impulse.tangential, effects.impulse[1], rounding);
        for i in 0..2 {
            assert_close("ΔV", implied.delta_v[i].x, effects.delta_v[i][0], rounding / scene.cars[i].mass);
            assert_direction("PDOF", implied.pdof[i], effects.pdof[i], 1e-8);
            let spin = rounding * 8.0 * scene.cars[i].inverse_yaw_inertia();
            assert_close("Ω", implied.yaw_rates[i], effects.yaw_rates[i], spin + 1e-13);
        }
        assert_relative("u_n", implied.approach.normal, effects.approach[0], 1e-9);
        let exchanged =
            size * (effects.approach[0].abs() + effects.approach[1].abs() + effects.separation[1].abs());
        let energy = 1e-9 * (exchanged + effects.energy_before);
        assert_close("W_n", implied.normal_work, effects.normal_work, energy);
        assert_close("W_t", implied.tangential_work, effects.tangential_work, energy);
        assert_close("E_L", implied.energy_loss, effects.loss, energy);
        if effects.approach[0] < -1.0 && effects.impulse[0] > 0.01 * size {
            let ratio = implied.impulse_ratio.unwrap();
            assert_close("μ", ratio, effects.ratio, 1e-6 * (1.0 + ratio.abs()));
            assert_close("e", implied.restitution.unwrap(), scene.restitution, 1e-7);
            assert_close("e at C", implied.departure_restitution.unwrap(), scene.restitution, 1e-7);
            assert_close("U_t", implied.separation.tangential, effects.separation[1], 1e-7);
            assert_close("U_t at C", implied.departure.unwrap().tangential, effects.separation[1], 1e-7);
            if let Some(critical) = effects.critical_ratio.filter(|ratio| ratio.abs() < 50.0) {
                assert_close("μ_c", implied.critical_impulse_ratio.unwrap(), critical, 1e-5);
            }
        }
        // Without yaw rates after impact those from P are used, which are the same.
        let unknown = m.after.map(|departure| Departure { yaw_rate: None, ..departure });
        let blind = Momentum { after: unknown, ..m }.implied(crash.speeds).unwrap();
        assert_close("E_L", blind.energy_loss, effects.loss, energy);
        assert!(blind.departure.is_none() && blind.departure_restitution.is_none());
        let Implied { impulse_ratio, pdof, .. } = mirrored(&m).implied(crash.speeds).unwrap().mirrored();
        assert_eq!(impulse_ratio.is_some(), implied.impulse_ratio.is_some());
        for (mirrored, pdof) in pdof.into_iter().zip(implied.pdof) {
            // In the mirrored collision the force comes from the other side.
            assert_direction("PDOF", -mirrored, pdof, 1e-8);
        }
        true
    });
}

/// W_n at a pair of speeds, if there is an impact.
fn work(scene: &Scene, speeds: [f64; 2]) -> Option<f64> {
    match verdict(&scene.at_speed(0, speeds[0]).at_speed(1, speeds[1])) {
        Verdict::Impact(effects) => Some(effects.normal_work),
        _ => None,
    }
}

#[test]
fn momentum_along_an_axis_and_crush_undo_an_impact() {
    let near = prop_oneof![
        1 => Just(0.0),
        1 => Just(PI),
        4 => -0.17..0.17,
        4 => (-0.17..0.17).prop_map(|turn| PI + turn),
        // Any axis will do if the approaches cross.
        2 => -PI..PI,
    ];
    for_all(400, 0.4, (crash(near), -0.5..0.5), |((scene, speeds), tilt)| {
        let Some(crash) = Crash::of(scene, speeds) else { return false };
        let energy = crash.effects.normal_work;
        if energy < 10.0 {
            return false;
        }
        let (m, scene) = (crash.momentum(), crash.scene);
        let axis = if m.is_collinear() {
            m.common_axis()
        } else {
            let tilted: f64 = scene.cars[0].heading + tilt;
            Vector2::new(tilted.cos(), tilted.sin())
        };
        let weights =
            scene.cars.map(|car| car.mass * (car.heading.cos() * axis.x + car.heading.sin() * axis.y));
        let along = m.total().x * axis.x + m.total().y * axis.y;
        if weights[1].abs() < 0.05 * weights[0].abs() {
            return false;
        }
        let pair = |v1: f64| [v1, (along - weights[0] * v1) / weights[1]];
        let solver =
            match MomentumAndCrush::new(m, axis, scene.law().into(), energy, EnergyBasis::Dissipated, 0.0) {
                Ok(solver) => solver,
                Err(MomentumError::AlongCrushPlane { .. }) => return false,
                Err(error) => panic!("{error}"),
            };
        let found: Vec<[f64; 2]> = solver.speeds().collect();
        let answer = solver.solve().unwrap();
        assert_eq!(answer.speeds, found[0]);
        assert_eq!(answer.admissible, found.len());
        // Near an extremum of W_n the accuracy of a speed is the square root of that of the energy.
        let step = 1e-3;
        let steep = |v1: f64| match (work(&scene, pair(v1 - step)), work(&scene, pair(v1 + step))) {
            (Some(a), Some(b)) => ((b - a) / energy).abs() > 1e-6,
            _ => false,
        };
        for &[v1, v2] in &found {
            let size = weights[0].abs() * (v1.abs() + 1.0) + weights[1].abs() * (v2.abs() + 1.0);
            assert_close(
                "momentum",
                weights[0] * v1 + weights[1] * v2,
                along,
                1e-12 * size + 1e-12 * along.abs(),
            );
            if let Some(work) = work(&scene, [v1, v2])
                && steep(v1)
            {
                assert_relative("W_n", work, energy, 1e-6);
            }
        }
        let nearest = |wanted: [f64; 2]| {
            found.iter().map(|pair| (pair[0] - wanted[0]).abs()).fold(f64::INFINITY, f64::min)
        };
        let scale = crash.scale()[0] + crash.speeds[0].abs() + crash.speeds[1].abs();
        for v1 in scanned(&|v1| work(&scene, pair(v1)), energy, 200) {
            let wanted = pair(v1);
            let off = nearest(wanted);
            assert!(off <= 1e-6 * scale || !steep(wanted[0]), "{off} {wanted:?} {found:?}");
        }
        if !steep(crash.speeds[0]) {
            return false;
        }
        assert!(nearest(crash.speeds) <= 1e-6 * scale, "{:?} {found:?}", crash.speeds);
        true
    });
}

/// S of section 10, from the definition: errors along and across each velocity, the work by the brute-force
/// solution. Infinite if no impact is possible.
fn sum_of_squares(
    crash: &Crash,
    (energy, share): (f64, f64),
    errors: &EvidenceErrors,
    speeds: [f64; 2],
) -> f64 {
    let Crash { scene, effects, .. } = crash;
    let moving = scene.at_speed(0, speeds[0]).at_speed(1, speeds[1]);
    let Verdict::Impact(impact) = verdict(&moving) else { return f64::INFINITY };
    let work = impact.normal_work + share * impact.tangential_work;
    let [mut x, mut y, mut xx, mut xy, mut yy] = [0.0; 5];
    for (i, speed) in speeds.into_iter().enumerate() {
        let Car { mass, heading, .. } = scene.cars[i];
        let [vx, vy] = effects.velocities[i];
        let (size, direction) = (mass * vx.hypot(vy), vy.atan2(vx));
        let (along, across) = ((size * errors.speed).powi(2), (size * errors.direction).powi(2));
        let (sin, cos) = direction.sin_cos();
        xx += along * cos * cos + across * sin * sin;
        yy += along * sin * sin + across * cos * cos;
        xy += (along - across) * sin * cos;
        x += mass * (speed * heading.cos() - vx);
        y += mass * (speed * heading.sin() - vy);
    }
    let of_momentum = (x * x * yy - 2.0 * x * y * xy + y * y * xx) / (xx * yy - xy * xy);
    let of_crush = ((work / energy).ln() / errors.crush_ln).powi(2);
    let sum = of_momentum + of_crush;
    if sum.is_nan() { f64::INFINITY } else { sum }
}

/// The crush energy is that of the impact times a factor, so that momentum and damage do not agree. A search
/// on ever finer grids about the answer and about the speeds from momentum finds no smaller sum.
#[test]
fn momentum_beside_crush_has_the_least_sum_of_squares() {
    let smooth = prop_oneof![
        3 => Just(Tangential::Critical),
        2 => (-0.5..0.5).prop_map(Tangential::Ratio),
        1 => (-1.0..1.0).prop_map(Tangential::Restitution),
    ];
    let errors = (0.05..0.3, 0.05..0.3, 0.2..1.0, 0.4..2.5, prop_oneof![Just(0.0), 0.0..1.0]);
    for_all(300, 0.2, (crash(-PI..PI), smooth, errors), |((scene, speeds), tangential, errors)| {
        let scene = scene.under(tangential).without_moment();
        let Some(crash) = Crash::of(scene, speeds) else { return false };
        let (speed, direction, crush_ln, factor, share) = errors;
        let m = crash.momentum();
        let work = crash.effects.normal_work + share * crash.effects.tangential_work;
        // If momentum determines little, or one vehicle stops, the grid would have to be finer.
        if m.sine().abs() < 0.3 || work < 100.0 || crash.speeds.iter().any(|speed| speed.abs() < 5.0) {
            return false;
        }
        let errors = EvidenceErrors { speed, direction, crush_ln };
        let (energy, on) = (factor * work, (EnergyBasis::Dissipated, share));
        let law = crash.scene.law();
        let found = match MomentumBesideCrush::new(m, law.into(), energy, on, errors).unwrap().solve() {
            Ok(found) => found,
            Err(MomentumError::Inadmissible { speeds, .. }) => {
                let moving = crash.scene.at_speed(0, speeds[0]).at_speed(1, speeds[1]);
                assert!(!matches!(verdict(&moving), Verdict::Impact(_)), "{speeds:?}");
                return false;
            }
            Err(error) => panic!("{error}"),
        };
        let sum = |speeds: [f64; 2]| sum_of_squares(&crash, (energy, share), &errors, speeds);
        let least = found.apart.powi(2);
        assert_relative("S", sum(found.speeds), least, 1e-6);
        assert!(least <= sum(crash.speeds) * (1.0 + 1e-9));
        for centre in [crash.speeds, found.speeds] {
            let mut best = (sum(centre), centre);
            let mut width = 0.5 * crash.speeds[0].hypot(crash.speeds[1]);
            for _ in 0..20 {
                let middle = best.1;
                for i in -4..=4 {
                    for j in -4..=4 {
                        let at = [f64::from(i), f64::from(j)].map(|step| step * width / 4.0);
                        let at = [middle[0] + at[0], middle[1] + at[1]];
                        let here = sum(at);
                        if here < best.0 {
                            best = (here, at);
                        }
                    }
                }
                width *= 0.5;
            }
            assert!(best.0 >= least - 1e-6 * (1.0 + least), "{best:?} is below {found:?}");
        }
        true
    });
}

/// The weights decide: with a crush energy of no weight the speeds are those of momentum, and with velocities
/// of no weight they give the crush energy.
#[test]
fn what_is_exact_holds_beside_what_is_not() {
    let body = Body::new(1500.0, 2500.0).unwrap();
    let one = Participant::new(body, 0.0, 2.0, 0.0).unwrap();
    let two = Participant::new(body, FRAC_PI_2, 0.0, 0.9).unwrap();
    let after = |x: f64, y: f64| Departure { velocity: Vector2::new(x, y), yaw_rate: None };
    let momentum = Momentum {
        contact: Contact::new([one, two], PI).unwrap(),
        yaw_rates: [0.0; 2],
        after: [after(10.0, 4.0), after(8.0, 9.0)],
    };
    let law = Law::new(0.1, Tangential::Critical).unwrap();
    let solve = |energy: f64, errors: EvidenceErrors| {
        let on = (EnergyBasis::Absorbed, 0.0);
        MomentumBesideCrush::new(momentum, law.into(), energy, on, errors).unwrap().solve().unwrap()
    };
    let found = solve(1e5, EvidenceErrors { speed: 0.1, direction: 0.1, crush_ln: 1e4 });
    for (found, alone) in found.speeds.into_iter().zip([18.0, 13.0]) {
        assert_close("momentum is exact", found, alone, 1e-5);
    }
    let found = solve(1e5, EvidenceErrors { speed: 0.1, direction: 0.1, crush_ln: 1e-4 });
    // Absorbed: E = W_n/(1 − e²)
    assert_relative("crush is exact", found.outcome.energy.normal_work / 0.99, 1e5, 1e-5);

    let errors = EvidenceErrors { speed: 0.1, direction: 0.1, crush_ln: 0.5 };
    let new = |energy: f64, law: Law, share: f64, errors: EvidenceErrors| {
        MomentumBesideCrush::new(momentum, law.into(), energy, (EnergyBasis::Dissipated, share), errors).err()
    };
    let elastic = Law::new(1.0, Tangential::Critical).unwrap();
    assert!(matches!(new(0.0, law, 0.0, errors), Some(MomentumError::NoCrushEnergy { energy: 0.0 })));
    assert!(matches!(new(1e5, elastic, 0.0, errors), Some(MomentumError::NoRestitutionLoss { .. })));
    assert!(matches!(new(1e5, law, 1.1, errors), Some(MomentumError::TangentialShare { .. })));
    for wrong in [0.0, -0.1, f64::NAN] {
        for i in 0..3 {
            let mut of = [0.1, 0.1, 0.5];
            of[i] = wrong;
            let [speed, direction, crush_ln] = of;
            let error = new(1e5, law, 0.0, EvidenceErrors { speed, direction, crush_ln });
            assert!(matches!(error, Some(MomentumError::Invalid(_))), "{of:?}");
        }
    }
    assert!(new(1e5, law, 0.0, errors).is_none());
    // With reversed velocities the vehicles separate.
    let apart =
        Momentum { after: momentum.after.map(|d| Departure { velocity: -d.velocity, ..d }), ..momentum };
    let on = (EnergyBasis::Dissipated, 0.0);
    let refused = MomentumBesideCrush::new(apart, law.into(), 1e5, on, errors).unwrap().solve();
    assert!(matches!(refused, Err(MomentumError::Inadmissible { .. })));
}

/// Two vehicles of 1200 and 1800 kg on one line, with C on it; `turn` is the angle between their headings.
fn in_line(heading: f64, turn: f64, after: [f64; 2], yaw_known: bool) -> Momentum {
    let body = |mass: f64| Body::new(mass, 2.0 * mass).unwrap();
    let struck = if turn == 0.0 { -2.0 } else { 2.0 };
    let one = Participant::new(body(1200.0), heading, 2.0, 0.0).unwrap();
    let two = Participant::new(body(1800.0), heading + turn, struck, 0.0).unwrap();
    let along = |speed: f64| Vector2::new(speed * heading.cos(), speed * heading.sin());
    Momentum {
        contact: Contact::new([one, two], heading).unwrap(),
        yaw_rates: [0.0; 2],
        after: after.map(|speed| Departure { velocity: along(speed), yaw_rate: yaw_known.then_some(0.0) }),
    }
}

/// By hand, central and on one line: E = ½ m̄ (1−e²) σ², m̄ = 720 kg; the speeds share the momentum.
#[test]
fn rear_end_and_head_on_by_hand() {
    for step in -18..18 {
        let heading = f64::from(step) * 0.17;
        for (e, basis, share) in [
            (0.0, EnergyBasis::Dissipated, 1.0),
            (0.3, EnergyBasis::Dissipated, 1.0 - 0.09),
            // The absorbed energy is W_n/(1−e²) = ½ m̄ σ².
            (0.3, EnergyBasis::Absorbed, 1.0),
        ] {
            let (closing, before) = (15.0, [15.0, 0.0]);
            let energy = 0.5 * 720.0 * closing * closing * share;
            // V_i = common velocity ∓ e σ m_j/M
            let common = 1200.0 * 15.0 / 3000.0;
            let after = [common - e * closing * 0.6, common + e * closing * 0.4];
            // The second vehicle's heading and its speed are both reversed.
            for turn in [0.0, PI] {
                let m = in_line(heading, turn, after, true);
                for law in [Tangential::Critical, Tangential::Friction(0.5)] {
                    let law = Law::new(e, law).unwrap();
                    let solver =
                        MomentumAndCrush::new(m, m.common_axis(), law.into(), energy, basis, 0.0).unwrap();
                    let answer = solver.solve().unwrap();
                    assert_close("v_1", answer.speeds[0], before[0], 1e-9);
                    assert_close("v_2", answer.speeds[1], before[1], 1e-9);
                    assert_relative("W_n", answer.normal_work, 0.5 * 720.0 * 225.0 * (1.0 - e * e), 1e-12);
                    assert_close("V_1", answer.outcome.after[0].velocity.norm(), after[0].abs(), 1e-9);
                    assert_eq!(answer.admissible, 1);
                    assert!(matches!(answer.method, SolutionMethod::ClosedForm));
                }
                let implied = m.implied(before).unwrap();
                assert_close("e", implied.departure_restitution.unwrap(), e, 1e-12);
                assert_close("E_L", implied.energy_loss, 0.5 * 720.0 * 225.0 * (1.0 - e * e), 1e-8);
            }
        }
    }
    // Both moving, towards each other at 12 and 5 m/s: momentum 1200·12 − 1800·5 = 5400 kg·m/s, σ = 17 m/s.
    let m = in_line(0.0, PI, [1.8, 1.8], false);
    let law = Law::new(0.0, Tangential::Critical).unwrap();
    let energy = 0.5 * 720.0 * 17.0 * 17.0;
    let solver =
        MomentumAndCrush::new(m, m.common_axis(), law.into(), energy, EnergyBasis::Dissipated, 0.0).unwrap();
    let [v1, v2] = solver.solve().unwrap().speeds;
    assert_close("v_1", v1, 12.0, 1e-12);
    assert_close("v_2", v2, 5.0, 1e-12);
}

/// By hand: 1200 kg hit a wall at 5 m/s and leave it at 0.5 m/s. The impulse is that of the vehicle alone.
#[test]
fn a_fixed_object_takes_the_momentum() {
    let car = Participant::new(Body::new(1200.0, 2400.0).unwrap(), 0.0, 2.0, 0.0).unwrap();
    let wall = Participant::new(Body::fixed(), 0.0, -2.0, 0.0).unwrap();
    let thrown_back = Departure { velocity: Vector2::new(-0.5, 0.0), yaw_rate: None };
    let stays = Departure { velocity: Vector2::new(0.0, 0.0), yaw_rate: Some(0.0) };
    for (bodies, after, speeds) in
        [([car, wall], [thrown_back, stays], [5.0, 0.0]), ([wall, car], [stays, thrown_back], [0.0, 5.0])]
    {
        let contact = Contact::new(bodies, 0.0).unwrap();
        let implied = Momentum { contact, yaw_rates: [0.0; 2], after }.implied(speeds).unwrap();
        assert_close("P_n", implied.impulse.normal, 6600.0, 1e-9);
        assert_close("P_t", implied.impulse.tangential, 0.0, 1e-9);
        assert_close("difference of the impulses", implied.disagreement(), 0.0, 1e-9);
        assert_close("e", implied.restitution.unwrap(), 0.1, 1e-12);
        assert_close("E_L", implied.energy_loss, 0.5 * 1200.0 * (25.0 - 0.25), 1e-9);
        assert_close("W_n", implied.normal_work, 0.5 * 1200.0 * (25.0 - 0.25), 1e-9);
    }
}

/// By hand: a central impact at 2 m/s after it with e = 0.2 was one at 10 m/s.
#[test]
fn only_a_vehicle_comes_out_of_a_wall() {
    let body = || Body::new(1500.0, 2500.0).unwrap();
    let car = Participant::new(body(), 0.0, 1.5, 0.0).unwrap();
    let other = Participant::new(body(), PI, 1.5, 0.0).unwrap();
    let thrown_back = Departure { velocity: Vector2::new(-2.0, 0.0), yaw_rate: None };
    let stays = Departure { velocity: Vector2::new(0.0, 0.0), yaw_rate: None };
    let into = |hit: Participant| Momentum {
        contact: Contact::new([car, hit], 0.0).unwrap(),
        yaw_rates: [0.0; 2],
        after: [thrown_back, stays],
    };
    let wall = into(Participant::barrier());
    assert_close("v", wall.speed_into_wall(VehicleId::One, 0.2).unwrap(), 10.0, 1e-12);
    for e in [7.0, -0.2, f64::NAN, f64::INFINITY] {
        let refused = wall.speed_into_wall(VehicleId::One, e);
        assert!(matches!(refused, Err(MomentumError::Invalid(_))), "{refused:?}");
    }
    let two = VehicleId::Two;
    assert_eq!(wall.speed_into_wall(two, 0.2), Err(MomentumError::Fixed { vehicle: two }));
    let refused = into(other).speed_into_wall(VehicleId::One, 0.2);
    assert_eq!(refused, Err(MomentumError::Movable { vehicle: two }));
}

#[test]
fn what_has_no_answer_says_why() {
    let m = in_line(0.0, FRAC_PI_2, [3.0, 4.0], false);
    assert!(m.speeds().is_ok());
    let law = || Law::new(0.1, Tangential::Critical).unwrap().into();
    let basis = EnergyBasis::Dissipated;
    let with_body = |body: Body| {
        let [one, _] = *m.contact.participants();
        let two = Participant::new(body, FRAC_PI_2, -2.0, 0.0).unwrap();
        Momentum { contact: Contact::new([one, two], 0.0).unwrap(), ..m }
    };
    let barrier = with_body(Body::fixed());
    let fixed = MomentumError::Fixed { vehicle: VehicleId::Two };
    assert_eq!(barrier.speeds(), Err(fixed));
    assert_eq!(MomentumAndCrush::new(barrier, barrier.common_axis(), law(), 1e4, basis, 0.0), Err(fixed));
    let nan = Departure { velocity: Vector2::new(1.0, f64::NAN), yaw_rate: None };
    for after in [[nan, m.after[1]], [m.after[0], nan]] {
        let refused = Momentum { after, ..m }.speeds();
        assert!(
            matches!(refused, Err(MomentumError::Invalid(InvalidInput::NotFinite { what, .. })) if what.contains("along y"))
        );
    }
    let spinning = Departure { yaw_rate: Some(f64::INFINITY), ..m.after[0] };
    assert!(matches!(
        Momentum { after: [spinning, m.after[1]], ..m }.speeds(),
        Err(MomentumError::Invalid(InvalidInput::NotFinite { what: "yaw rate after impact", .. }))
    ));
    assert!(Momentum { yaw_rates: [0.0, f64::NAN], ..m }.speeds().is_err());
    assert!(m.implied([f64::NAN, 0.0]).is_err() && m.implied([0.0, f64::INFINITY]).is_err());
    // The squares of these speeds are infinite.
    assert!(m.implied([1e300, 1.0]).is_err() && m.implied([1.0, -1e300]).is_err());

    let along = in_line(0.0, 0.0, [6.0, 6.0], false);
    let refused = |axis: Vector2<f64>, energy: f64, e: f64| {
        let law = Law::new(e, Tangential::Critical).unwrap().into();
        MomentumAndCrush::new(along, axis, law, energy, basis, 0.0).map(|_| ())
    };
    let x = Vector2::new(1.0, 0.0);
    assert_eq!(refused(x, 1e4, 0.1), Ok(()));
    assert_eq!(refused(-x, 1e4, 0.1), Ok(()));
    assert_eq!(refused(x * 2.0, 1e4, 0.1), Err(MomentumError::NoAxis { length: 2.0 }));
    assert!(matches!(refused(x * f64::NAN, 1e4, 0.1), Err(MomentumError::NoAxis { .. })));
    let across = Vector2::new(0.0, 1.0);
    assert_eq!(refused(across, 1e4, 0.1), Err(MomentumError::AcrossAxis { cosines: [0.0; 2] }));
    assert_eq!(refused(x, 0.0, 0.1), Err(MomentumError::NoCrushEnergy { energy: 0.0 }));
    assert_eq!(refused(x, 1e4, 1.0), Err(MomentumError::NoRestitutionLoss { restitution: 1.0 }));
    let sideswipe = {
        let one = Participant::new(Body::new(1200.0, 2400.0).unwrap(), 0.0, 0.0, 1.0).unwrap();
        let two = Participant::new(Body::new(1800.0, 3600.0).unwrap(), PI, 0.0, 1.0).unwrap();
        Momentum { contact: Contact::new([one, two], FRAC_PI_2).unwrap(), ..along }
    };
    let axis = sideswipe.common_axis();
    assert!(matches!(
        MomentumAndCrush::new(sideswipe, axis, law(), 1e4, basis, 0.0),
        Err(MomentumError::AlongCrushPlane { .. })
    ));
    // An error text names what to change.
    for (error, part) in [
        (fixed, "vehicle 2 is fixed"),
        (MomentumError::Collinear { angle: 3.0_f64.to_radians() }, "3.00°"),
        (MomentumError::NotReached { energy: 1.0, tangential_share: 0.0 }, "normal impulse equal to 1.0 J"),
        (
            MomentumError::NotReached { energy: 1.0, tangential_share: 0.5 },
            "normal impulse plus 0.5 of that of the tangential impulse equal to 1.0 J",
        ),
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
}

/// Speeds and their implications, as functions of the inputs of the derivatives: masses, heading 2, V_1x,
/// V_2y, Ω_1, crush energy, axis, e.
fn chain<T: Real>([m1, m2, heading, vx, vy, yaw, energy, axis, e]: [T; 9]) -> Vec<T> {
    let t = |x: f64| T::from(x);
    let one = Participant::new(Body::new(m1, t(2400.0)).unwrap(), t(0.1), t(1.9), t(0.4)).unwrap();
    let two = Participant::new(Body::new(m2, t(3600.0)).unwrap(), heading, t(-0.3), t(0.9)).unwrap();
    let m = Momentum {
        contact: Contact::new([one, two], t(0.2)).unwrap(),
        yaw_rates: [t(0.1), t(0.0)],
        after: [
            Departure { velocity: Vector2::new(vx, t(2.0)), yaw_rate: Some(yaw) },
            Departure { velocity: Vector2::new(t(4.0), vy), yaw_rate: None },
        ],
    };
    let speeds = m.speeds().unwrap();
    let implied = m.implied(speeds).unwrap();
    let (sin, cos) = axis.sin_cos();
    let law = Law::new(e, Tangential::Critical).unwrap().into();
    let solver =
        MomentumAndCrush::new(m, Vector2::new(cos, sin), law, energy, EnergyBasis::Absorbed, T::ZERO)
            .unwrap();
    let answer = solver.closed_form().unwrap().unwrap();
    vec![
        speeds[0],
        speeds[1],
        implied.impulse_ratio.unwrap(),
        implied.energy_loss,
        implied.pdof[1],
        implied.yaw_rates[1],
        answer.speeds[0],
        answer.speeds[1],
        answer.outcome.energy.loss,
    ]
}

#[test]
fn derivatives_are_differences_in_the_limit() {
    let inputs = [1200.0, 1800.0, 1.3, 5.0, 3.0, 0.5, 5e4, 0.2, 0.2];
    let values = chain(inputs);
    for i in 0..inputs.len() {
        let mut dual = inputs.map(Duals::<1>::from);
        dual[i] = Duals::variable(inputs[i], 0);
        let exact = chain(dual);
        let step = 1e-5 * inputs[i].abs();
        let at = |sign: f64| {
            let mut moved = inputs;
            moved[i] += sign * step;
            chain(moved)
        };
        let (high, low) = (at(1.0), at(-1.0));
        for k in 0..values.len() {
            assert_relative("value", exact[k].value, values[k], 1e-14);
            let difference = (high[k] - low[k]) / (2.0 * step);
            let scale = values[k].abs() / inputs[i].abs();
            assert_close(
                &format!("{i} {k}"),
                exact[k].derivatives[0],
                difference,
                1e-6 * (difference.abs() + scale),
            );
        }
    }
}

/// A search without a closed form gives the derivatives of its residual.
#[test]
fn derivatives_under_a_friction_limit() {
    let solver = |energy: f64| {
        let m = in_line(0.3, 0.05, [5.5, 6.5], false);
        let law = Law::new(0.1, Tangential::Friction(0.01)).unwrap();
        MomentumAndCrush::new(m, m.common_axis(), law.into(), energy, EnergyBasis::Dissipated, 0.0).unwrap()
    };
    let energy = 6e4;
    let speeds = |energy: f64| solver(energy).solve().unwrap().speeds;
    let here = solver(energy);
    let relative = {
        let [v1, v2] = speeds(energy);
        let [a, b] = [here.speeds_at(0.0), here.speeds_at(1.0)];
        let relative = (v1 - a[0]) / (b[0] - a[0]);
        assert_close("σ", (v2 - a[1]) / (b[1] - a[1]), relative, 1e-9);
        relative
    };
    // dσ/dE = −(∂R/∂E)/(∂R/∂σ), ∂R/∂E = −1
    let step = 1e-5;
    let problem = here.problem();
    let slope = (problem.residual(relative + step) - problem.residual(relative - step)) / (2.0 * step);
    let by_speed = [0, 1].map(|i| here.speeds_at(1.0)[i] - here.speeds_at(0.0)[i]);
    let (high, low) = (speeds(energy + 1.0), speeds(energy - 1.0));
    for i in 0..2 {
        assert_relative("dv/dE", (high[i] - low[i]) / 2.0, by_speed[i] / slope, 1e-6);
    }
}
