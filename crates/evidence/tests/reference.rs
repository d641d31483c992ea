//! Ten posteriors compared with another program with another sampler: `reference/reference.py`, whose
//! result is `reference/reference.json`.

use std::f64::consts::{FRAC_PI_2, PI};

use estimate::{DrawnQuantity, DrawsSummary, ParticleSettings, Prior, sample_quietly};
use evidence::{
    Behind, BodyNumbers, CodedPdof, Collision, CollisionModel, CrushMisfit, CrushNumbers, DamagedSide,
    DrawnOutput, FIGURES, FITTED, FigureErrors, Fitted, Limits, Measured, MeasuredSpeed, Number,
    ObjectFigures, Observed, RecordedDeltaV, RestitutionModel, Severity, Speeds,
};
use pim_core::VehicleId::{One, Two};
use serde_json::Value;
use uncertainty::{Distribution, Estimate};

use crate::likelihood::vehicle;

const DEGREE: f64 = PI / 180.0;

/// The quantities, by their names in the reference.
const QUANTITIES: [(&str, DrawnOutput); 7] = [
    ("speed_1", DrawnOutput::Speed(One)),
    ("speed_2", DrawnOutput::Speed(Two)),
    ("delta_v_1", DrawnOutput::DeltaV(One)),
    ("delta_v_2", DrawnOutput::DeltaV(Two)),
    ("closing_speed", DrawnOutput::ClosingSpeed),
    ("energy_loss", DrawnOutput::EnergyLoss),
    ("restitution", DrawnOutput::Restitution),
];

fn normal(mean: f64, sd: f64) -> Number {
    Distribution::normal(mean, sd).unwrap().into()
}

fn log_normal(median: f64, ln_sd: f64) -> Number {
    Distribution::log_normal(median, ln_sd).unwrap().into()
}

fn uniform(low: f64, high: f64) -> Number {
    Distribution::uniform(low, high).unwrap().into()
}

fn truncated(mean: f64, sd: f64, low: f64, high: f64) -> Number {
    Distribution::truncated_normal(mean, sd, low, high).unwrap().into()
}

fn crush([constant, linear, square]: [f64; 3]) -> Option<CrushNumbers> {
    let (slope, no_damage_speed) = (log_normal(1.0, 0.16), log_normal(1.0, 0.38));
    Some(CrushNumbers { constant, linear, square, slope, no_damage_speed })
}

/// The misfits are those of the reference, independent of later fits.
const CRUSH: CrushMisfit = CrushMisfit { bias: -0.404, ln_sd: 0.366 };
const SEVERITY: Severity =
    Severity { median: 7.36, ln_sd: 0.47, speed: 25.0, injury: None, uniform_speeds: 0 };

/// A crash with both speeds unknown; the cases set everything else.
fn usual(masses: [Number; 2], yaw_radii: [f64; 2], crushes: [[f64; 3]; 2]) -> Collision {
    let vehicle = |i: usize| {
        let mut vehicle = vehicle(1.0, 0.0);
        if let Some(body) = &mut vehicle.body {
            (body.mass, body.yaw_radius) = (masses[i], yaw_radii[i].into());
        }
        vehicle.crush = crush(crushes[i]);
        vehicle
    };
    Collision {
        vehicles: [vehicle(0), vehicle(1)],
        speeds: Speeds::Together {
            ln_relative: uniform(0.3_f64.ln(), 120.0_f64.ln()),
            split: uniform(0.0, FRAC_PI_2),
        },
        crush_plane: normal(PI, 10.0 * DEGREE),
        restitution: by_closing_speed(),
        friction: log_normal(1.0, 0.4),
        tangential_share: truncated(0.5, 0.35, 0.0, 1.0),
        other_crush: None,
        observed: Observed { severity: Some(SEVERITY), crush: Some(CRUSH.into()), ..Observed::default() },
    }
}

fn by_closing_speed() -> RestitutionModel {
    RestitutionModel::ByClosingSpeed {
        low: 0.05,
        rise: 0.32,
        fade: 5.0,
        factor: log_normal(1.0, 0.6),
        most: 0.7,
    }
}

fn crossing() -> Collision {
    let masses = [log_normal(1500.0, 0.03), log_normal(1300.0, 0.03)];
    let mut collision = usual(masses, [1.35, 1.3], [[5e3, 18e3, 20e3], [3e3, 15e3, 24e3]]);
    collision.vehicles[0].heading = normal(0.0, 10.0 * DEGREE);
    collision.vehicles[0].contact = [1.9.into(), normal(0.1, 0.25)];
    collision.vehicles[1].heading = (-FRAC_PI_2).into();
    collision.vehicles[1].contact = [normal(0.4, 0.25), 0.7.into()];
    collision
}

fn rear_end() -> Collision {
    let masses = [log_normal(1800.0, 0.03), log_normal(1200.0, 0.03)];
    let mut collision = usual(masses, [1.4, 1.25], [[4e3, 12e3, 10e3], [5e3, 16e3, 15e3]]);
    collision.vehicles[0].contact = [2.0.into(), normal(0.3, 0.25)];
    collision.vehicles[1].heading = normal(0.1, 14.0 * DEGREE);
    collision.vehicles[1].contact = [(-2.1).into(), normal(-0.3, 0.25)];
    collision.observed.vehicles[0].pdof = Some(CodedPdof { pdof: 12.0 * DEGREE, scale: 6.0 * DEGREE });
    collision
}

fn fronts() -> Collision {
    let masses = [1400.0.into(), 1600.0.into()];
    let mut collision = usual(masses, [1.3, 1.35], [[8e3, 30e3, 40e3], [8e3, 28e3, 30e3]]);
    collision.crush_plane = normal(PI, 5.0 * DEGREE);
    collision.vehicles[0].contact = [normal(1.8, 0.1), normal(0.5, 0.1)];
    collision.vehicles[1].heading = (PI + 0.15).into();
    collision.vehicles[1].contact = [normal(1.7, 0.1), normal(0.45, 0.1)];
    let severity = Severity { median: 1.42 * SEVERITY.median, ..SEVERITY };
    collision.observed.severity = Some(severity);
    for (vehicle, speed, direction) in [(0, 4.4, -2.35), (1, 2.6, 2.95)] {
        let after = &mut collision.observed.vehicles[vehicle].after;
        after.speed = Some(MeasuredSpeed { value: speed, ln_sd: 0.12, least: 0.0 });
        after.direction = Some(Measured { value: direction, sd: 8.0 * DEGREE });
    }
    collision
}

fn recorder() -> Collision {
    let mut collision = crossing();
    let stored = |size: f64, is_longitudinal: bool| {
        let (ln_scale, freedom) = (0.155, FITTED.recorder_freedom);
        Some(RecordedDeltaV { size, is_longitudinal, ln_scale, least: 0.0, freedom })
    };
    let [one, two] = &mut collision.observed.vehicles;
    one.recorder.speed = Some(MeasuredSpeed { value: 13.0, ln_sd: 0.05, least: 0.0 }.into());
    one.recorder.delta_v = stored(6.0, false);
    two.recorder.delta_v = stored(4.0, true);
    collision
}

fn limits() -> Collision {
    let mut collision = crossing();
    collision.observed.severity = None;
    collision.speeds = Speeds::Each([normal(16.0, 6.0), uniform(0.0, 25.0)]);
    collision.restitution = RestitutionModel::Constant(truncated(0.1, 0.08, 0.0, 1.0));
    collision.tangential_share = 0.5.into();
    collision.observed.vehicles[0].limits = Limits { least: 11.0, most: 14.0 };
    collision.observed.vehicles[1].limits = Limits { most: 9.0, ..Limits::default() };
    collision
}

fn wall() -> Collision {
    let mut collision =
        usual([log_normal(1500.0, 0.03), 1.0.into()], [1.35, 1.0], [[10e3, 45e3, 50e3], [0.0; 3]]);
    collision.speeds = Speeds::Each([normal(14.0, 6.0), 0.0.into()]);
    collision.crush_plane = PI.into();
    collision.friction = log_normal(0.6, 0.3);
    collision.observed.severity = None;
    let [one, two] = &mut collision.vehicles;
    (one.heading, one.yaw_rate) = (normal(0.2, 0.1), 0.2.into());
    one.contact = [1.8.into(), normal(-0.4, 0.2)];
    (two.body, two.crush) = (None, None);
    two.contact = [0.0.into(), 0.0.into()];
    collision.observed.vehicles[0].after.yaw_rate = Some(Measured { value: -2.0, sd: 0.4 });
    collision
}

fn two_modes() -> Collision {
    let mut collision = crossing();
    collision.observed.severity = None;
    collision.observed.crush = Some(CrushMisfit { bias: 0.0, ln_sd: 0.2 }.into());
    collision.speeds = Speeds::Each([normal(6.0, 0.5), normal(0.0, 9.0)]);
    (collision.friction, collision.tangential_share) = (1.5.into(), 0.9.into());
    collision.restitution = RestitutionModel::Constant(0.1.into());
    collision.crush_plane = PI.into();
    let [one, two] = &mut collision.vehicles;
    (one.heading, one.contact[1]) = (0.0.into(), 0.0.into());
    two.contact[0] = normal(0.2, 0.1);
    (one.crush, two.crush) = (crush([14e3, 24e3, 20e3]), crush([8e3, 24e3, 25e3]));
    collision
}

/// The figures of collisions with a fixed object, as the reference has them.
const OBJECTS: ObjectFigures = ObjectFigures {
    severity: Severity { median: 7.7, ln_sd: 0.83, speed: 25.0, injury: None, uniform_speeds: 0 },
    misfit: CrushMisfit { bias: -0.770, ln_sd: 1.470 },
    covariance: [[0.059_07, -0.008_01], [-0.008_01, 0.024_70]],
};

/// The front of a vehicle against a tree, as a case with a class stiffness poses it: any speed.
fn tree() -> Collision {
    let mut collision = wall();
    collision.speeds = Speeds::Each([uniform(0.0, 70.0), 0.0.into()]);
    collision.crush_plane = normal(PI, 5.0 * DEGREE);
    collision.restitution = RestitutionModel::Constant(log_normal(0.1, 0.6));
    collision.friction = log_normal(1.0, 0.4);
    let one = &mut collision.vehicles[0];
    one.body = Some(BodyNumbers { mass: normal(1500.0, 29.5), yaw_radius: 1.4.into() });
    (one.heading, one.yaw_rate) = (normal(0.0, 2.0 * DEGREE), 0.0.into());
    one.contact = [normal(1.9, 0.1), normal(-0.3, 0.1)];
    let (slope, no_damage_speed) = (log_normal(1.0, 0.295), log_normal(1.0, 0.085));
    let [constant, linear, square] = [5.6e3, 27e3, 38e3];
    one.crush = Some(CrushNumbers { constant, linear, square, slope, no_damage_speed });
    let pdof = Some(CodedPdof { pdof: 10.0 * DEGREE, scale: 6.0 * DEGREE });
    let behind = [Behind::Misfit { bias: true, spread: true }, Behind::Nothing];
    collision.observed = Observed {
        severity: Some(Severity { uniform_speeds: 1, ..OBJECTS.severity }),
        crush: Some(OBJECTS.misfit.into()),
        figures: OBJECTS.figures(behind),
        ..Observed::default()
    };
    collision.observed.vehicles[0].pdof = pdof;
    collision
}

/// The figures of the field on which a front and a side depend, as the reference has them; there is no rear.
fn by_figures() -> Fitted {
    const PLACES: [usize; 6] = [0, 3, 4, 6, 7, 8];
    const COVARIANCE: [[f64; 6]; 6] = [
        [0.02542, -0.01025, 0.01470, -0.00791, 0.02657, 0.00534],
        [-0.01025, 0.04747, 0.00542, -0.01145, -0.01120, -0.01208],
        [0.01470, 0.00542, 0.02470, -0.00096, 0.01382, -0.01723],
        [-0.00791, -0.01145, -0.00096, 0.11381, -0.01002, -0.00220],
        [0.02657, -0.01120, 0.01382, -0.01002, 0.03742, -0.00328],
        [0.00534, -0.01208, -0.01723, -0.00220, -0.00328, 0.07919],
    ];
    let mut covariance = [[0.0; FIGURES]; FIGURES];
    for (row, k) in COVARIANCE.iter().zip(PLACES) {
        for (entry, l) in row.iter().zip(PLACES) {
            covariance[k][l] = *entry;
        }
    }
    Fitted {
        crush_bias: -0.521,
        crush_ln_sd: [f64::NAN, f64::NAN, 0.336],
        slope: [27.7, f64::NAN, 31.1],
        no_damage_speed: [2.22, f64::NAN, 1.58],
        errors: FigureErrors { covariance, ..FigureErrors::NONE },
        ..FITTED
    }
}

/// The crossing cars with the stiffness of the field, whose figures have errors, for the mean (m) and mean
/// square (m²) of the depths.
fn errors_of_figures(mean: f64, mean_square: f64) -> Collision {
    let (mut collision, by) = (crossing(), by_figures());
    let hit = [DamagedSide::Front, DamagedSide::Side];
    for (vehicle, damage) in collision.vehicles.iter_mut().zip(hit) {
        let (slope, no_damage_speed) = (log_normal(1.0, 0.18), log_normal(1.0, 0.38));
        vehicle.crush =
            Some(CrushNumbers { slope, no_damage_speed, ..by.crush_of(damage, 1.4, mean, mean_square) });
    }
    collision.observed.crush = Some(by.crush_misfit(&hit).into());
    collision.observed.figures = by.crush_figures(&hit, hit.map(Behind::Stiffness));
    collision
}

/// Value and Monte Carlo error.
fn reference(value: &Value) -> Estimate {
    let number = |place: usize| value[place].as_f64().unwrap();
    Estimate { value: number(0), standard_error: Some(number(1)) }
}

/// (–) difference of two estimates in combined standard errors, less a hundredth of the standard deviation
/// `sd` of the quantity, below which errors of the errors matter.
fn apart(ours: Estimate, theirs: Estimate, sd: f64) -> f64 {
    let error = ours.standard_error.unwrap().hypot(theirs.standard_error.unwrap());
    let difference = (ours.value - theirs.value).abs() - 0.01 * sd - 1e-9;
    if difference <= 0.0 { 0.0 } else { difference / error }
}

#[test]
fn posteriors_are_those_of_another_sampler() {
    let all: Value = serde_json::from_str(include_str!("reference/reference.json")).unwrap();
    let cases: [(&str, Collision, usize); 10] = [
        ("crush", crossing(), 15),
        ("crush and PDOF", rear_end(), 15),
        ("velocities after", fronts(), 14),
        ("recorder", recorder(), 15),
        ("limits", limits(), 14),
        ("wall and yaw rate", wall(), 9),
        ("two modes", two_modes(), 9),
        ("tree", tree(), 11),
        ("errors of figures", errors_of_figures(0.2, 0.05), 15),
        ("errors of figures, deep crush", errors_of_figures(0.5, 0.3), 15),
    ];
    assert_eq!(all.as_object().unwrap().len(), cases.len());
    let mut worst = 0.0_f64;
    for (name, collision, unknown) in cases {
        let model = CollisionModel::new(&collision);
        assert_eq!(model.values_count(), unknown, "{name}");
        let posterior = sample_quietly(&model, &model, &ParticleSettings::new(512, 1)).unwrap();
        let of = &all[name];
        let mut check = |what: &str, ours: Estimate, theirs: Estimate, sd: f64| {
            let apart = apart(ours, theirs, sd);
            worst = worst.max(apart);
            assert!(apart < 4.0, "{name}, {what}: {ours:?} is not {theirs:?}");
        };
        check("log evidence", posterior.log_evidence(), reference(&of["log_evidence"]), 1.0);
        for (quantity, output) in QUANTITIES {
            let DrawsSummary { mean, sd, median, intervals } =
                posterior.summary(DrawnQuantity::Output(output.column()));
            let spread = of[quantity]["sd"][0].as_f64().unwrap();
            let ends = intervals[2];
            assert_eq!(ends.level, 0.9);
            for (what, ours) in
                [("mean", mean), ("sd", sd), ("q05", ends.low), ("q50", median), ("q95", ends.high)]
            {
                check(&format!("{quantity} {what}"), ours, reference(&of[quantity][what]), spread);
            }
            let by_importance = reference(&of[quantity]["mean_by_importance"]);
            check(&format!("{quantity} mean by importance"), mean, by_importance, spread);
        }
    }
    println!("at most {worst:.1} standard errors apart");
}
