//! The equations allocate nothing: neither an impact nor the search for a speed.

use allocation_counter::measure;
use deltav_benches::spin_out;
use oracle::scenes::{Car, Scene};
use pim_core::{ImpactError, Tangential, VehicleId};
use reconcile::{Departure, EnergyBasis, Momentum, MomentumAndCrush, Problem};
use trajectory::{Control, Steer, Target, to_rest, to_start};

fn collision(tangential: Tangential) -> Scene {
    let car = Car {
        fixed: false,
        mass: 1500.0,
        yaw_radius: 1.4,
        heading: 0.0,
        distance: 1.9,
        angle: 0.3,
        velocity: [20.0, 0.0],
        yaw_rate: 0.2,
    };
    let other = Car { heading: 2.4, velocity: [-8.0, 7.0], mass: 1100.0, ..car };
    Scene { cars: [car, other], crush_plane: 3.0, restitution: 0.2, tangential, moment: -0.5 }
}

const LAWS: [Tangential; 7] = [
    Tangential::Critical,
    Tangential::Ratio(0.1),
    Tangential::FractionOfCritical(0.8),
    Tangential::Friction(0.3),
    Tangential::VelocityChange(1.0),
    Tangential::Restitution(0.1),
    Tangential::FullOrSliding(0.3),
];

#[test]
fn an_impact_allocates_nothing() {
    for law in LAWS {
        let scene = collision(law);
        let info = measure(|| {
            scene.impact().unwrap();
        });
        assert_eq!(info.count_total, 0, "{law:?}");
    }
    // Neither does a refusal.
    let parting = collision(LAWS[0]).with_cars(|car| Car { velocity: car.velocity.map(|v| -v), ..car });
    let info = measure(|| assert!(matches!(parting.impact(), Err(ImpactError::NotApproaching { .. }))));
    assert_eq!(info.count_total, 0);
}

#[test]
fn a_search_for_a_speed_allocates_nothing() {
    for law in LAWS {
        let scene = collision(law);
        let info = measure(|| {
            let problem = Problem {
                contact: scene.contact(),
                law: scene.law().into(),
                motions: scene.motions(),
                unknown: VehicleId::One,
                crush_energy: 1e5,
                basis: EnergyBasis::Dissipated,
                tangential_share: 0.0,
            };
            problem.check().unwrap();
            problem.solve().unwrap();
            problem.root_finder().unwrap();
            assert!(problem.speeds().count() > 0);
        });
        assert_eq!(info.count_total, 0, "{law:?}");
    }
}

#[test]
fn a_motion_to_rest_and_back_allocates_nothing() {
    let (chassis, ground, start) = spin_out().unwrap();
    let control = Control::default();
    let info = measure(|| {
        let rest = to_rest(&chassis, Steer::straight(), &ground, &start, &control, |_| {}).unwrap();
        let target = Target { position: rest.position, heading: rest.heading, turns_known: false, via: None };
        to_start(&chassis, Steer::straight(), &ground, start.position, start.heading, &target, &control)
            .unwrap();
    });
    assert_eq!(info.count_total, 0);
}

#[test]
fn the_counter_counts() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1_u8]))).count_total, 1);
}

#[test]
fn a_search_for_both_speeds_allocates_nothing() {
    for law in LAWS {
        let scene = collision(law).at_speed(0, 20.0).at_speed(1, -8.0);
        let Ok(outcome) = scene.impact() else { continue };
        let after = outcome
            .after
            .map(|motion| Departure { velocity: motion.velocity, yaw_rate: Some(motion.yaw_rate) });
        let momentum =
            Momentum { contact: scene.contact(), yaw_rates: scene.cars.map(|car| car.yaw_rate), after };
        let (energy, basis) = (outcome.energy.normal_work, EnergyBasis::Dissipated);
        let info = measure(|| {
            let speeds = momentum.speeds().unwrap();
            momentum.implied(speeds).unwrap();
            let axis = momentum.common_axis();
            let search = MomentumAndCrush::new(momentum, axis, scene.law().into(), energy, basis, 0.0);
            search.unwrap().solve().unwrap();
        });
        assert_eq!(info.count_total, 0, "{law:?}");
    }
}
