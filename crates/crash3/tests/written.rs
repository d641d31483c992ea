//! Values written with the feature `serde` are read back unchanged, and values that no constructor accepts
//! are refused.

use crash3::{
    BarrierTest, DamagedFace, EnergyBasis, EnergyMoments, ObliqueCorrection, Profile, Side, SideStiffness,
    Stiffness, VehicleClass, Yielding, crush_range_from_force,
};
use oracle::scenes::for_all;
use oracle::written::{assert_again, assert_refused};
use serde_json::{from_value, json};

use crate::crush::{make, profile};

#[test]
fn damage() {
    for_all(500, 1.0, profile(), |plain| {
        let profile = make(&plain);
        assert_again(&profile);
        assert_again(&profile.sums());
        assert_again(&profile.zones().collect::<Vec<_>>());
        true
    });
    let profile = Profile::equally_spaced(vec![0.1, 0.5, 0.3], 1.2).unwrap();
    let rising = Stiffness::from_ab(40e3, 500e3).unwrap();
    let saturated = rising.with_saturation_force(150e3).unwrap();
    for stiffness in [rising, saturated] {
        assert_again(&stiffness);
        assert_again(&SideStiffness::Uniform(stiffness));
    }
    assert_again(&SideStiffness::Zones(vec![rising, saturated]));
    assert_again(&EnergyMoments::of(&profile, &SideStiffness::Uniform(rising)).unwrap());
    assert_again(&VehicleClass::new(3).unwrap());
    let yielding: Vec<Yielding> = profile.zones().map(|zone| zone.yielding(&saturated)).collect();
    assert!(matches!(yielding[0], Yielding::Partly { .. }));
    assert_again(&yielding);
    assert_again(&saturated.saturation());
    assert_again(&BarrierTest::new(1400.0, 15.6, profile, 2.0).unwrap());
    assert_again(&DamagedFace::new(Side::Left, 0.9, -0.2).unwrap());
    assert_again(&crush_range_from_force(2e5, 0.1, &rising, 1.0, 1.6, 2.0).unwrap());
    for correction in [ObliqueCorrection::Capped, ObliqueCorrection::Friction(0.5)] {
        assert_again(&correction);
        assert_again(&correction.factor(0.3).unwrap());
    }
    assert_again(&[EnergyBasis::Dissipated, EnergyBasis::Absorbed]);
}

#[test]
fn impossible_damage_is_refused() {
    assert_refused::<Profile>(json!({ "depths": [0.1, -0.1], "spacings": [0.5] }), "must not be negative");
    assert_refused::<Profile>(json!({ "depths": [0.1, 0.1], "spacings": [0.5, 0.5] }), "need 1 spacings");
    let stiffness = |force: f64| json!({ "a": 4e4, "b": 5e5, "g": 1600.0, "saturation_force": force });
    assert!(from_value::<Stiffness>(stiffness(5e4)).is_ok());
    assert_refused::<Stiffness>(stiffness(3e4), "must be at least A");
    assert_refused::<DamagedFace>(
        json!({ "side": "Left", "distance": 0.0, "offset": 0.0 }),
        "greater than zero",
    );
    let profile = json!({ "depths": [0.0, 0.0], "spacings": [0.5] });
    let test = json!({ "mass": 1400.0, "speed": 15.0, "profile": profile, "no_damage_speed": 2.0 });
    assert_refused::<BarrierTest>(test, "no crush");
}
