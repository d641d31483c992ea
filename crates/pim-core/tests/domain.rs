//! Coverage of the random collisions.

use oracle::scenes::{Scene, scene};
use pim_core::Tangential;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, RngSeed, TestRng, TestRunner};

/// The domain includes every tangential condition, barriers on both sides, and crush planes with and without
/// a turned normal; and most collisions have an impact.
#[test]
fn random_collisions_cover_the_domain() {
    let mut runner = TestRunner::new_with_rng(
        Config { rng_seed: RngSeed::Fixed(1), ..Config::default() },
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let count = 4000;
    let scenes: Vec<Scene> = (0..count)
        .map(|_| scene().new_tree(&mut runner).unwrap())
        .map(|tree| proptest::strategy::ValueTree::current(&tree))
        .collect();
    let share = |which: &dyn Fn(&Scene) -> bool| {
        f64::from(u32::try_from(scenes.iter().filter(|scene| which(scene)).count()).unwrap())
            / f64::from(count)
    };
    let with_law = |law: fn(&Tangential) -> bool| {
        let all = share(&|scene| law(&scene.tangential));
        let kept = share(&|scene| law(&scene.tangential) && scene.impact().is_ok());
        (all, kept / all)
    };
    for (law, least_kept) in [
        ((|law| matches!(law, Tangential::Critical)) as fn(&Tangential) -> bool, 0.8),
        // Half of the ratios have the sign that creates energy.
        (|law| matches!(law, Tangential::Ratio(_)), 0.5),
        (|law| matches!(law, Tangential::FractionOfCritical(_)), 0.8),
        (|law| matches!(law, Tangential::Friction(_)), 0.8),
        // Half of the changes have the sign that creates energy.
        (|law| matches!(law, Tangential::VelocityChange(_)), 0.4),
        (|law| matches!(law, Tangential::Restitution(_)), 0.5),
        (|law| matches!(law, Tangential::FullOrSliding(_)), 0.8),
    ] {
        let (all, kept) = with_law(law);
        assert!(all > 0.07 && kept > least_kept, "{all} {kept}");
    }
    let with_moment = |scene: &Scene| scene.moment > -1.0;
    assert!(share(&with_moment) > 0.25);
    assert!(share(&|scene| with_moment(scene) && scene.has_barrier()) > 0.04);
    assert!(share(&|scene| with_moment(scene) && scene.impact().is_ok()) > 0.15);
    assert!(share(&|scene| scene.cars[0].fixed) > 0.07);
    assert!(share(&|scene| scene.cars[1].fixed) > 0.07);
    let given = |scene: &Scene| {
        let n = scene.contact().normal();
        n.x * scene.crush_plane.cos() + n.y * scene.crush_plane.sin() > 0.0
    };
    assert!((share(&given) - 0.5).abs() < 0.05);
}
