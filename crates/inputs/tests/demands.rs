//! The data that the engines get from a case, compared with hand calculations: units, axes, defaults, and
//! missing data.

use std::f64::consts::PI;

use crash3::{Side, SideStiffness};
use inputs::{
    Axes, Basis, BrachTangential, Case, ContactPoint, Crush, CrushEvidence, Dimension, Find, GivenImpact,
    GivenVehicle, ImpactLaw, Mass, Pdof, Purpose, Quantity, Reconstruct, Restitution, StiffnessForm,
    StiffnessLine, Velocity, YawInertia,
};
use pim_core::VehicleId;

fn q(number: f64, unit: &str, dimension: Dimension) -> Quantity {
    Quantity::new(number, dimension.unit(unit).unwrap()).unwrap()
}

#[track_caller]
fn assert_near(actual: f64, expected: f64) {
    assert!((actual - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{actual} is not {expected}");
}

fn vehicle(weight: f64, heading: f64, contact: [f64; 2], speed: f64) -> GivenVehicle {
    GivenVehicle {
        mass: Some(Mass::Weight(q(weight, "lb", Dimension::Weight))),
        yaw: Some(YawInertia::Radius(q(4.5, "ft", Dimension::Length))),
        heading: Some(q(heading, "deg", Dimension::Angle)),
        contact: Some(ContactPoint::Cartesian {
            x: q(contact[0], "ft", Dimension::Length),
            y: q(contact[1], "in", Dimension::Length),
        }),
        motion: Some(Velocity::Speed(q(speed, "mph", Dimension::Speed))),
        ..GivenVehicle::default()
    }
}

fn damage() -> Crush {
    let depth = |inches: f64| q(inches, "in", Dimension::Length);
    Crush {
        side: Side::Front,
        from_force_balance: false,
        width: Some(q(6.0, "ft", Dimension::Length)),
        depths: [10.0, 20.0, 0.0].map(depth).to_vec(),
        spacing: None,
        stiffness: StiffnessForm::Line(StiffnessLine::Crush {
            a: q(350.0, "lb/in", Dimension::StiffnessA),
            b: q(90.0, "lb/in^2", Dimension::StiffnessB),
            g: None,
            limit: None,
        }),
        offset: None,
        pdof: Some(Pdof::Clock(1)),
        oblique_angle: None,
        moment_arm: None,
        oblique: None,
    }
}

/// Vehicle 1 drives along x, vehicle 2 along y into its right side.
fn case() -> Case {
    let mut vehicles = [vehicle(3000.0, 0.0, [1.0, -30.0], 20.0), vehicle(4000.0, 90.0, [6.0, 12.0], 30.0)];
    vehicles[0].yaw_rate = Some(q(6.0, "rpm", Dimension::YawRate));
    Case {
        vehicles,
        impact: Some(GivenImpact {
            crush_plane: q(90.0, "deg", Dimension::Angle),
            law: ImpactLaw::Brach {
                restitution: Restitution::Constant(0.2),
                tangential: BrachTangential::Ratio(0.1),
                moment_restitution: None,
            },
        }),
        ..Case::default()
    }
}

const POUND: f64 = 0.453_592_37;
const FOOT: f64 = 0.3048;
const MPH: f64 = 1609.344 / 3600.0;

#[test]
fn the_engines_get_si_units() {
    let collision = case().collision().unwrap().collision;
    let [one, two] = collision.vehicles.each_ref().map(|data| data.inertia.unwrap());
    // A weight of 3000 lb is that of 3000 lb of mass; I = m k².
    assert_near(one.mass, 3000.0 * POUND);
    assert_near(two.mass, 4000.0 * POUND);
    assert_near(one.yaw_inertia.unwrap(), 3000.0 * POUND * 4.5 * FOOT * 4.5 * FOOT);
    let [a, b] = collision.vehicles.each_ref().map(|data| data.contact.unwrap());
    assert_near(a[0], FOOT);
    assert_near(a[1], -2.5 * FOOT);
    assert_near(b[0], 6.0 * FOOT);
    assert_near(b[1], FOOT);
    let [v1, v2] = collision.motions;
    assert_near(v1.velocity.x, 20.0 * MPH);
    assert_near(v1.velocity.y, 0.0);
    assert_near(v2.velocity.x, 0.0);
    assert_near(v2.velocity.y, 30.0 * MPH);
    assert_near(v1.yaw_rate, 0.2 * PI);
    assert_near(v2.yaw_rate, 0.0);
    // C of vehicle 1 moves at (v − ω y, ω x), that of vehicle 2 with its CG. The normal points from vehicle 2
    // to vehicle 1, along y, and the tangent along −x: u_n = ω x − v₂, u_t = −(v₁ − ω y).
    let approach = collision.contact.approach(&collision.motions).velocity;
    assert_near(approach.normal, 0.2 * PI * FOOT - 30.0 * MPH);
    assert_near(approach.tangential, -(20.0 * MPH + 0.2 * PI * 2.5 * FOOT));
}

/// The same scene written with y and angles to the right is the same collision.
#[test]
fn z_down_axes_are_a_mirror() {
    let up = case();
    let turned = |quantity: &Quantity| Quantity::new(-quantity.number(), quantity.unit()).unwrap();
    let mut down = up.clone();
    down.axes = Axes::ZDown;
    for vehicle in &mut down.vehicles {
        vehicle.heading = vehicle.heading.as_ref().map(turned);
        vehicle.yaw_rate = vehicle.yaw_rate.as_ref().map(turned);
        vehicle.contact = vehicle.contact.as_ref().map(|contact| match contact {
            ContactPoint::Cartesian { x, y } => ContactPoint::Cartesian { x: *x, y: turned(y) },
            ContactPoint::Polar { .. } => unreachable!(),
        });
    }
    let impact = down.impact.as_mut().unwrap();
    impact.crush_plane = turned(&impact.crush_plane);
    let ImpactLaw::Brach { tangential: BrachTangential::Ratio(ratio), .. } = &mut impact.law else {
        panic!()
    };
    *ratio = -*ratio;
    let [up, down] = [up, down].map(|case| case.collision().unwrap().collision);
    assert_eq!(up.contact, down.contact);
    assert_eq!(up.motions, down.motions);
    assert_eq!(up.law, down.law);
    assert_eq!(up.vehicles[0].contact, down.vehicles[0].contact);
}

#[test]
fn the_damage_is_in_si_units_and_its_force_has_an_opposite() {
    let mut case = case();
    case.vehicles[1].crush = Some(damage());
    case.vehicles[0].crush = Some(Crush { side: Side::Right, pdof: None, ..damage() });
    let found = case.damage().unwrap();
    let data = found.vehicles[1].damage.as_ref().unwrap();
    let CrushEvidence::Measured { profile, structure: SideStiffness::Uniform(stiffness) } = &data.evidence
    else {
        panic!("{data:?}")
    };
    assert_near(profile.width(), 6.0 * FOOT);
    assert_near(profile.depths()[1], 20.0 / 12.0 * FOOT);
    // By hand: two zones of 3 ft; the mean of the depths 10, 20, 0 in over the width is (15 + 10)/2 in.
    assert_near(profile.sums().mean_depth(), 12.5 / 12.0 * FOOT);
    let pound_force = POUND * 9.80665;
    assert_near(stiffness.a(), 350.0 * pound_force / (FOOT / 12.0));
    assert_near(stiffness.b(), 90.0 * pound_force * 144.0 / (FOOT * FOOT));
    // G = A²/2B
    assert_near(stiffness.g(), 350.0 * 350.0 / 180.0 * pound_force);
    // 1 o'clock is 30° clockwise of a heading of 90°: the force on vehicle 2 comes from 60° in the scene,
    // that on vehicle 1 from 240°, which is 120° clockwise of its heading.
    assert_near(found.vehicles[1].force.pdof.unwrap(), PI / 6.0);
    assert!(!found.vehicles[1].force.pdof_follows && found.vehicles[0].force.pdof_follows);
    assert_near(found.vehicles[0].force.pdof.unwrap(), 2.0 * PI / 3.0);
    assert_eq!(found.restitution, Some(0.2));
}

#[test]
fn each_missing_value_is_named_by_its_key() {
    let keys = |faults: inputs::Faults| -> Vec<String> {
        faults.list().iter().map(|fault| fault.key.clone()).collect()
    };
    let lacking = |change: fn(&mut Case)| {
        let mut case = case();
        change(&mut case);
        keys(case.collision().unwrap_err())
    };
    assert_eq!(lacking(|case| case.impact = None), ["impact"]);
    assert_eq!(lacking(|case| case.vehicles[1].heading = None), ["vehicle2.heading"]);
    // A case in US units has weights.
    assert_eq!(lacking(|case| case.vehicles[0].mass = None), ["vehicle1.weight"]);
    assert_eq!(lacking(|case| case.vehicles[0].yaw = None), ["vehicle1.yaw_inertia"]);
    assert_eq!(lacking(|case| case.vehicles[1].contact = None), ["vehicle2.contact"]);
    assert_eq!(lacking(|case| case.vehicles[1].motion = None), ["vehicle2.speed"]);
    // Those of both vehicles at once.
    let both = lacking(|case| case.vehicles.iter_mut().for_each(|vehicle| vehicle.mass = None));
    assert_eq!(both, ["vehicle1.weight", "vehicle2.weight"]);
    assert_eq!(case().furthest_purpose(), Purpose::Impact);
}

/// The speed sought is zero until it is found, whatever the case gives for the other.
#[test]
fn a_sought_speed_is_left_out() {
    let mut case = case();
    case.vehicles[0].motion = None;
    for vehicle in &mut case.vehicles {
        vehicle.crush = Some(damage());
    }
    case.vehicles[0].crush = Some(Crush { side: Side::Right, pdof: None, ..damage() });
    case.reconstruct = Some(Reconstruct { find: Find::One(VehicleId::One), energy_basis: Basis::Absorbed });
    let input = case.reconstruction().unwrap();
    assert_eq!(input.unknown, VehicleId::One);
    assert_eq!(input.basis, Basis::Absorbed);
    assert_eq!(input.collision.motions[0].velocity.norm(), 0.0);
    assert_near(input.collision.motions[0].yaw_rate, 0.2 * PI);
    assert_near(input.collision.motions[1].velocity.y, 30.0 * MPH);
}
