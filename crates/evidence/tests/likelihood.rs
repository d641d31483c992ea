//! Each term compared with the formula, computed by hand for a central impact.

use std::f64::consts::PI;

use estimate::{DrawnQuantity, Evidence, Independent, ParticleSettings, sample_quietly};
use evidence::{
    BodyNumbers, CodedPdof, Collision, CollisionModel, CrushErrors, CrushMisfit, CrushNumbers, DamagedSide,
    DrawnOutput, EnergyError, FITTED, Freedom, Impacted, Impacts, InjuryRisk, Limits, Measured, MeasuredRest,
    MeasuredSpeed, Number, Observed, ObservedVehicle, OtherCrush, Piece, PlaceError, PostImpactMotion,
    RecordedData, RecordedDeltaV, RecordedPart, RecorderPlace, RestitutionModel, Severity, ShownSpeed,
    Speeds, VehicleNumbers, Way,
};
use pim_core::Vector2;
use pim_core::VehicleId::{One, Two};
use uncertainty::{Distribution, LANES, Lanes};

/// docs/calibration.md: by category, the energy of a rear is 1.72 times that of the front that struck it, and
/// that of a side 0.363 times; by the stiffness of the fleet, a rear does not differ from a front.
#[test]
fn shares_by_category_are_those_of_the_calibration() {
    use DamagedSide::{Front, Rear, Side};
    let ratio = |fitted: &evidence::Fitted, other: DamagedSide, known: DamagedSide| {
        fitted.other_crush(other, known).unwrap().quantile(0.5)
    };
    let by_category = FITTED.by_category(&[Front, Rear]);
    for (other, known, expected) in
        [(Rear, Front, 1.72), (Front, Rear, 1.0 / 1.72), (Side, Front, 0.363), (Side, Rear, 0.363 / 1.72)]
    {
        assert!((ratio(&by_category, other, known) / expected - 1.0).abs() < 1e-9, "{other:?} {known:?}");
    }
    assert!((ratio(&FITTED, Rear, Front) - 1.0).abs() < 1e-9);
    assert!((ratio(&FITTED, Side, Rear) / 0.73 - 1.0).abs() < 1e-9);
}

pub(crate) fn vehicle(mass: f64, ahead: f64) -> VehicleNumbers {
    VehicleNumbers {
        body: Some(BodyNumbers { mass: mass.into(), yaw_radius: 1.4.into() }),
        heading: 0.0.into(),
        contact: [ahead.into(), 0.0.into()],
        yaw_rate: 0.0.into(),
        crush: None,
    }
}

/// Vehicle 1, 1500 kg, runs at 15 m/s squarely into the rear of vehicle 2, 1000 kg, which stands; e = 0.1.
///
/// ΔV₁ = (1 + e) v m₂/(m₁ + m₂) = 6.6 m/s, ΔV₂ = 9.9 m/s, V₁ = 8.4 m/s, V₂ = 9.9 m/s,
/// E_L = ½ (1 − e²) m₁m₂/(m₁ + m₂) v² = 66825 J.
pub(crate) fn rear_end() -> Collision {
    Collision {
        vehicles: [vehicle(1500.0, 2.0), vehicle(1000.0, -2.0)],
        speeds: Speeds::Each([15.0.into(), 0.0.into()]),
        crush_plane: 0.0.into(),
        restitution: RestitutionModel::Constant(0.1.into()),
        friction: 0.7.into(),
        tangential_share: 0.5.into(),
        other_crush: None,
        observed: Observed::default(),
    }
}

fn terms(collision: &Collision) -> Vec<(Piece, f64)> {
    let model = CollisionModel::new(collision);
    let mut terms = vec![Lanes::ZERO; model.terms_count()];
    let mut reasons = [0; LANES];
    model.log_likelihood(&[], &mut terms, &mut reasons);
    assert!(reasons.iter().all(|reason| *reason == 0));
    assert!(terms.iter().all(|lanes| lanes.iter().all(|term| *term == lanes[0])));
    model.pieces().iter().copied().zip(terms.iter().map(|lanes| lanes[0])).collect()
}

fn close(ours: f64, expected: f64) {
    assert!((ours - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{ours} {expected}");
}

fn normal(z: f64, sd: f64) -> f64 {
    -0.5 * z * z - (sd * (2.0 * PI).sqrt()).ln()
}

#[test]
fn the_crush_energy_is_that_of_the_normal_work() {
    let mut collision = rear_end();
    // For a profile: κ = 1.1 and β = 0.9 change 10 + 20 + 15 kJ to 8.1 + 19.8 + 18.15 kJ.
    let crush = |slope: f64, no_damage_speed: f64| CrushNumbers {
        constant: 10e3,
        linear: 20e3,
        square: 15e3,
        slope: slope.into(),
        no_damage_speed: no_damage_speed.into(),
    };
    collision.vehicles[0].crush = Some(crush(1.0, 1.0));
    collision.vehicles[1].crush = Some(crush(1.1, 0.9));
    collision.observed.crush = Some(CrushMisfit { bias: -0.2, ln_sd: 0.4 }.into());
    let [(Piece::Crush, term)] = terms(&collision)[..] else { panic!() };
    let energy = 45e3 + 8.1e3 + 19.8e3 + 18.15e3;
    close(term, normal(((energy / 66_825.0_f64).ln() + 0.2) / 0.4, 0.4));
}

/// ln Φ(z), by Simpson's rule.
fn ln_cumulative(z: f64) -> f64 {
    let (from, steps) = (-12.0, 20_000);
    let step = (z - from) / f64::from(steps);
    let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * PI).sqrt();
    let weight = |k: i32| {
        if k == 0 || k == steps {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    (0..=steps).map(|k| weight(k) * density(from + f64::from(k) * step)).sum::<f64>().ln() + (step / 3.0).ln()
}

/// The energy at which residual crush begins is only as much as the impact took at most, and a collision
/// without residual crush is no more severe than one after which a vehicle was towed.
#[test]
fn without_residual_crush_energy_and_severity_are_bounds() {
    let mut collision = rear_end();
    let crush = |constant: f64| CrushNumbers {
        constant,
        linear: 0.0,
        square: 0.0,
        slope: Number::Exact(1.0),
        no_damage_speed: Number::Exact(1.0),
    };
    collision.vehicles[0].crush = Some(crush(30e3));
    collision.vehicles[1].crush = Some(crush(25e3));
    collision.observed.crush = Some(CrushMisfit { bias: -0.2, ln_sd: 0.4 }.into());
    collision.observed.crush_is_bound = true;
    let [(Piece::NoResidualCrush, term)] = terms(&collision)[..] else { panic!() };
    close(term, ln_cumulative(((55e3 / 66_825.0_f64).ln() + 0.2) / 0.4));
    let severity = Severity { uniform_speeds: 1, ..FITTED.severity };
    collision.observed.severity = Some(severity);
    let [(Piece::Severity, term), _] = terms(&collision)[..] else { panic!() };
    let model = CollisionModel::new(&collision);
    let impacted = &model.leads().impacts(&[])[0];
    let [dv1, dv2] = impacted.outcome.delta_v_magnitude();
    let [v1, v2] = impacted.speeds;
    let often = -0.5 * (v1 * v1 + v2 * v2) / (severity.speed * severity.speed);
    close(term, ln_cumulative(-((dv1 * dv2).sqrt() / severity.median).ln() / severity.ln_sd) + often);
}

/// For one vehicle: ln E₁ = ln(W_n + λ W_t) + ln s + b + error, with its share s of both energies.
#[test]
fn the_crush_of_one_vehicle_has_its_share_of_the_energy() {
    let crush = CrushNumbers {
        constant: 10e3,
        linear: 5e3,
        square: 5e3,
        slope: Number::Exact(1.0),
        no_damage_speed: Number::Exact(1.0),
    };
    let share = 0.3_f64;
    let ratio = Number::Exact((1.0 - share) / share);
    for (known, other) in [(One, Two), (Two, One)] {
        let mut collision = rear_end();
        collision.vehicles[known.index()].crush = Some(crush);
        collision.other_crush = Some(OtherCrush { vehicle: other, ratio });
        collision.observed.crush = Some(CrushMisfit { bias: -0.2, ln_sd: 0.4 }.into());
        let [(Piece::Crush, term)] = terms(&collision)[..] else { panic!() };
        close(term, normal(((20e3_f64).ln() - 66_825.0_f64.ln() - share.ln() + 0.2) / 0.4, 0.4));
        let model = CollisionModel::new(&collision);
        let impacted = &model.leads().impacts(&[])[0];
        close(impacted.crush_energies[known.index()], 20e3);
        close(impacted.crush_energies[other.index()], 20e3 * 7.0 / 3.0);
    }
}

/// The posterior of the speed compared with a sum over a grid of speeds and ratios.
#[test]
fn the_crush_of_one_vehicle_tells_the_speed() {
    let mut collision = rear_end();
    let crush = CrushNumbers {
        constant: 20e3,
        linear: 0.0,
        square: 0.0,
        slope: Number::Exact(1.0),
        no_damage_speed: Number::Exact(1.0),
    };
    collision.vehicles[1].crush = Some(crush);
    collision.speeds = Speeds::Each([Distribution::uniform(1.0, 60.0).unwrap().into(), 0.0.into()]);
    let ratio = FITTED.other_crush(DamagedSide::Side, DamagedSide::Front).unwrap();
    collision.other_crush = Some(OtherCrush { vehicle: One, ratio: ratio.into() });
    collision.observed.crush = Some(CrushMisfit { bias: -0.2, ln_sd: 0.4 }.into());
    let model = CollisionModel::new(&collision);
    let posterior = sample_quietly(&model, &model, &ParticleSettings::new(512, 1)).unwrap();
    let summary = posterior.summary(DrawnQuantity::Output(DrawnOutput::Speed(One).column()));

    // W_n = 66825 J at 15 m/s, and grows with the square of the speed.
    let taken = |v: f64| 66_825.0 * (v / 15.0).powi(2);
    let steps = 3000;
    let speed = |k: usize| 1.0 + 59.0 * (k as f64 + 0.5) / f64::from(steps);
    let weights: Vec<f64> = (0..steps as usize)
        .map(|k| {
            let of_ratio = |z: f64| {
                let ratio = FITTED.side_crush * (FITTED.other_crush_ln_sd * z).exp();
                let error = (20e3 * (1.0 + ratio)).ln() - taken(speed(k)).ln() + 0.2;
                (-0.5 * (error / 0.4).powi(2) - 0.5 * z * z).exp()
            };
            (-80..=80).map(|k| of_ratio(0.05 * f64::from(k))).sum()
        })
        .collect();
    let total: f64 = weights.iter().sum();
    let quantile = |share: f64| {
        let mut sum = 0.0;
        let place = weights.iter().position(|weight| {
            sum += weight / total;
            sum >= share
        });
        speed(place.unwrap())
    };
    let ends = summary.intervals[3];
    for (ours, share) in [(ends.low, 0.025), (summary.median, 0.5), (ends.high, 0.975)] {
        let (exact, error) = (quantile(share), ours.standard_error.unwrap());
        assert!((ours.value - exact).abs() < 4.0 * error + 2e-3 * exact, "{ours:?} {exact}");
        assert!(error < 0.03 * exact, "{ours:?} tells nothing");
    }
}

/// A skid that begins at 20 m/s according to the particle, and at 21 m/s according to a recorder.
#[test]
fn a_speed_before_the_skid_has_a_normal_error() {
    let observed = || {
        let mut observed = Observed::default();
        observed.vehicles[1].skid_speed = Some(MeasuredSpeed { value: 21.0, ln_sd: 0.05, least: 0.0 });
        observed
    };
    for (begins, expected) in
        [(Some(20.0), normal((21.0_f64 / 20.0).ln() / 0.05, 0.05)), (None, f64::NEG_INFINITY)]
    {
        let skidded = Skidded { model: CollisionModel::new(&rear_end()), begins };
        let model = CollisionModel::of(skidded, observed());
        assert_eq!(model.pieces(), [Piece::SkidSpeed(Two)]);
        let mut terms = [Lanes::ZERO; 1];
        model.log_likelihood(&[], &mut terms, &mut [0; LANES]);
        if expected.is_finite() { close(terms[0][2], expected) } else { assert_eq!(terms[0][2], expected) }
    }
}

/// The impact of a collision, with a given skid of vehicle 2.
struct Skidded {
    model: CollisionModel,
    begins: Option<f64>,
}

impl Impacts for Skidded {
    fn unknown(&self) -> &Independent {
        self.model.leads().unknown()
    }

    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted> {
        let impacts = self.model.leads().impacts(values).into_iter();
        impacts.map(|impacted| Impacted { skid_speeds: [None, self.begins], ..impacted }).collect()
    }
}

#[test]
fn velocities_after_the_impact_have_normal_errors() {
    let mut collision = rear_end();
    collision.observed.vehicles[1].after = PostImpactMotion {
        speed: Some(MeasuredSpeed { value: 11.0, ln_sd: 0.12, least: 0.0 }),
        direction: Some(Measured { value: 2.0 * PI - 0.1, sd: 0.14 }),
        yaw_rate: Some(Measured { value: 0.3, sd: 0.2 }),
        of_common_cg: false,
    };
    let terms = terms(&collision);
    let pieces: Vec<Piece> = terms.iter().map(|(piece, _)| *piece).collect();
    assert_eq!(pieces, [Piece::SpeedAfter(Two), Piece::DirectionAfter(Two), Piece::YawRateAfter(Two)]);
    close(terms[0].1, normal((11.0_f64 / 9.9).ln() / 0.12, 0.12));
    close(terms[1].1, normal(0.1 / 0.14, 0.14));
    close(terms[2].1, normal(1.5, 0.2));
}

#[test]
fn a_recorder_and_a_pdof_have_heavy_tails() {
    let mut collision = rear_end();
    let (ln_scale, freedom) = (0.16, Freedom::Three);
    let delta_v = Some(RecordedDeltaV { size: 6.0, is_longitudinal: true, ln_scale, least: 0.0, freedom });
    collision.observed.vehicles[0].recorder = RecordedData {
        delta_v,
        speed: Some(MeasuredSpeed { value: 16.0, ln_sd: 0.05, least: 0.0 }.into()),
        ..RecordedData::default()
    };
    collision.observed.vehicles[0].pdof = Some(CodedPdof { pdof: 0.2, scale: 0.1 });
    // The wider of two PDOFs does not count: both are the same observation.
    collision.observed.vehicles[1].pdof = Some(CodedPdof { pdof: PI, scale: 0.15 });
    let terms = terms(&collision);
    let pieces: Vec<Piece> = terms.iter().map(|(piece, _)| *piece).collect();
    assert_eq!(pieces, [Piece::Pdof(One), Piece::RecordedDeltaV(One), Piece::RecordedSpeed(One)]);
    // f(z) = (1 + z²/2)^(−3/2)/√8 with z = 2
    close(terms[0].1, (3.0_f64.powf(-1.5) / (8.0_f64.sqrt() * 0.1)).ln());
    // f(z) = 2/(π√3 (1 + z²/3)²)
    let z = (6.0_f64 / 6.6).ln() / ln_scale;
    close(terms[1].1, (2.0 / (PI * 3.0_f64.sqrt() * (1.0 + z * z / 3.0).powi(2) * ln_scale)).ln());
    close(terms[2].1, normal((16.0_f64 / 15.0).ln() / 0.05, 0.05));
}

/// A recorder 2 m behind the CG and 1 m to the left, in a vehicle that loses 6.6 m/s and a yaw rate of
/// 1.5 rad/s: ΔΩ × r = (1.5, 3) m/s, so it stores (−5.1, 3) m/s.
#[test]
fn a_recorder_away_from_the_centre_of_gravity_stores_the_rotation_too() {
    let mut collision = rear_end();
    let (ln_scale, freedom) = (0.16, Freedom::Three);
    let delta_v = Some(RecordedDeltaV { size: 6.0, is_longitudinal: false, ln_scale, least: 0.0, freedom });
    let shown = 3.0_f64.atan2(5.1);
    collision.observed.vehicles[0].recorder = RecordedData {
        delta_v,
        direction: Some(CodedPdof { pdof: shown + 0.2, scale: 0.1 }),
        place: Some(RecorderPlace { at: [-2.0, 1.0], yaw_rate: 1.5 }),
        ..RecordedData::default()
    };
    let terms = terms(&collision);
    let of = |piece: Piece| terms.iter().find(|(of, _)| *of == piece).unwrap().1;
    let z = (6.0 / 5.1_f64.hypot(3.0)).ln() / ln_scale;
    let size = 2.0 / (PI * 3.0_f64.sqrt() * (1.0 + z * z / 3.0).powi(2) * ln_scale);
    close(of(Piece::RecordedDeltaV(One)), size.ln());
    // f(z) = (1 + z²/2)^(−3/2)/√8 with z = 2
    close(of(Piece::RecordedDirection(One)), (3.0_f64.powf(-1.5) / (8.0_f64.sqrt() * 0.1)).ln());
}

/// Of two PDOFs with the same error, the mean counts, whichever vehicle is called 1: the force comes from 0
/// and 180°, both are 0.2 rad off to the right, so that in the scene they are 0.4 rad apart, about the
/// truth; or both are on one side of it.
#[test]
fn two_pdofs_of_one_error_count_as_their_mean() {
    let of = |pdofs: [f64; 2]| {
        let mut collision = rear_end();
        for (vehicle, pdof) in collision.observed.vehicles.iter_mut().zip(pdofs) {
            vehicle.pdof = Some(CodedPdof { pdof, scale: 0.1 });
        }
        let [(Piece::Pdof(One), term)] = terms(&collision)[..] else { panic!() };
        term
    };
    let student = |z: f64| ((1.0 + z * z / 2.0).powf(-1.5) / (8.0_f64.sqrt() * 0.1)).ln();
    close(of([0.2, PI - 0.2]), student(0.0));
    close(of([0.2, 0.2 - PI]), student(2.0));
    close(of([0.1, 0.2 - PI]), student(1.5));
    close(of([0.2, 0.1 - PI]), student(1.5));
}

/// The force on vehicle 1 comes from straight ahead; the recorder shows 0.2 rad, and angles beyond 180°.
#[test]
fn the_direction_of_a_recorder_has_heavy_tails() {
    for (id, shown) in [(One, 0.2), (Two, PI + 0.2), (Two, 0.2 - PI)] {
        let mut collision = rear_end();
        let direction = Some(CodedPdof { pdof: shown, scale: 0.1 });
        collision.observed.vehicles[id.index()].recorder.direction = direction;
        let [(Piece::RecordedDirection(of), term)] = terms(&collision)[..] else { panic!() };
        assert_eq!(of, id);
        close(term, (3.0_f64.powf(-1.5) / (8.0_f64.sqrt() * 0.1)).ln());
    }
}

/// The scales of docs/calibration.md: 6° for a PDOF and 5.4° for a recorder, 1.5 times as much on sides.
#[test]
fn directions_err_more_on_sides() {
    for (found, degrees) in [
        (FITTED.coded(0.3, false), 6.0),
        (FITTED.coded(0.3, true), 9.0),
        (FITTED.recorded_direction(0.3, false), 5.3),
        (FITTED.recorded_direction(0.3, true), 7.95),
    ] {
        assert_eq!(found.pdof, 0.3);
        close(found.scale, degrees * PI / 180.0);
    }
}

#[test]
fn limits_hold() {
    for (limits, term) in [
        (Limits { least: 0.0, most: 15.0 }, 0.0),
        (Limits { least: 15.5, most: 30.0 }, f64::NEG_INFINITY),
        (Limits { least: 0.0, most: 14.5 }, f64::NEG_INFINITY),
    ] {
        let mut collision = rear_end();
        collision.observed.vehicles[0].limits = limits;
        assert_eq!(terms(&collision), [(Piece::Limits(One), term)]);
    }
}

#[test]
fn severity_is_that_of_the_mean_delta_v() {
    let mut collision = rear_end();
    collision.observed.severity =
        Some(Severity { median: 7.0, ln_sd: 0.5, speed: 25.0, injury: None, uniform_speeds: 0 });
    let z = ((6.6_f64 * 9.9).sqrt() / 7.0).ln() / 0.5;
    assert_eq!(terms(&collision).len(), 1);
    close(terms(&collision)[0].1, normal(z, 0.5) - 0.5 * (15.0_f64 / 25.0).powi(2));
}

/// Half of the vehicles with a ΔV of 43.1 mph have a seriously injured occupant: −6.9774 + 0.1620 · 43.07 is
/// 0.
#[test]
fn a_serious_injury_makes_a_severe_collision_more_likely() {
    let half = 6.9774 / 0.1620 * 0.44704;
    close(InjuryRisk::SERIOUS.ln_in_either([half, half]), 0.75_f64.ln());
    let mut collision = rear_end();
    let usual = Severity { median: 7.0, ln_sd: 0.5, speed: 25.0, injury: None, uniform_speeds: 0 };
    let term = |severity: Severity, collision: &mut Collision| {
        collision.observed.severity = Some(severity);
        terms(collision)[0].1
    };
    let without = term(usual, &mut collision);
    let with = term(Severity { injury: Some(InjuryRisk::SERIOUS), ..usual }, &mut collision);
    let [one, two] = [6.6, 9.9].map(|dv: f64| 1.0 / (1.0 + (6.9774 - 0.1620 * dv / 0.44704).exp()));
    close(with - without, (one + two - one * two).ln());
}

#[test]
fn restitution_falls_with_the_closing_speed() {
    let mut collision = rear_end();
    let factor = Number::Exact(0.5);
    collision.restitution =
        RestitutionModel::ByClosingSpeed { low: 0.08, rise: 0.32, fade: 5.0, factor, most: 0.7 };
    let e = 0.5 * (0.08 + 0.32 * (-3.0_f64).exp());
    collision.observed.vehicles[0].after.speed =
        Some(MeasuredSpeed { value: 9.0 - 6.0 * e, ln_sd: 0.01, least: 0.0 });
    // V₁ = (m₁ − e m₂) v/(m₁ + m₂)
    close(terms(&collision)[0].1, normal(0.0, 0.01));
}

#[test]
fn together_the_speeds_have_their_relative_speed_and_split() {
    let mut collision = rear_end();
    // At right angles, with 5 and 12 m/s, the relative speed is 13 m/s.
    collision.vehicles[1].heading = (0.5 * PI).into();
    collision.vehicles[1].contact = [0.0.into(), 0.5.into()];
    let split = Number::Exact((12.0_f64 / 5.0).atan());
    for (k, speed) in [(0, 5.0), (1, 12.0)] {
        collision.observed.vehicles[k].recorder.speed =
            Some(MeasuredSpeed { value: speed, ln_sd: 0.01, least: 0.0 }.into());
    }
    for speeds in [
        Speeds::Together { ln_relative: Number::Exact(13.0_f64.ln()), split },
        Speeds::Within { vehicle: One, ln_speed: Number::Exact(5.0_f64.ln()), split },
        Speeds::Within { vehicle: Two, ln_speed: Number::Exact(12.0_f64.ln()), split },
    ] {
        collision.speeds = speeds;
        for (_, term) in terms(&collision) {
            close(term, normal(0.0, 0.01));
        }
    }
}

#[test]
fn vehicles_that_do_not_meet_have_no_impact() {
    let mut collision = rear_end();
    collision.speeds = Speeds::Each([5.0.into(), 6.0.into()]);
    let model = CollisionModel::new(&collision);
    let mut reasons = [0; LANES];
    model.log_likelihood(&[], &mut [], &mut reasons);
    assert_eq!(reasons, [1; LANES]);
}

/// The impact of a collision, with given paths.
struct Followed {
    model: CollisionModel,
    ways: [Option<Way>; 2],
}

impl Impacts for Followed {
    fn unknown(&self) -> &Independent {
        self.model.leads().unknown()
    }

    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted> {
        let impacts = self.model.leads().impacts(values).into_iter();
        impacts.map(|impacted| Impacted { ways: self.ways.clone(), ..impacted }).collect()
    }
}

#[test]
fn rests_and_points_have_normal_errors() {
    let way = Way { position: Vector2::new(10.0, 3.0), heading: 7.0, misses: Some(vec![0.4, -0.1]) };
    let rest = |heading, turns_are_known| MeasuredRest {
        position: Vector2::new(11.0, 2.5),
        impact: Vector2::new(2.0, -3.0),
        error: PlaceError { least: 0.3, share: 0.04, survey: 0.48 },
        heading,
        turns_are_known,
        heading_sd: 0.3,
    };
    // x − x̂ = 1 m, y − ŷ = −0.5 m, and 0.2 rad with and without the full turn. The rest is 10.548 m from the
    // impact, the computed one 10 m; σ² = (0.3 + 0.04 d)² + 0.48² for each.
    let sd = |distance: f64| (0.3 + 0.04 * distance).hypot(0.48);
    let (measured, computed) = (sd(9.0_f64.hypot(5.5)), sd(10.0));
    let place = -1.25 / (2.0 * measured * computed) - 2.0 * (measured * (2.0 * PI).sqrt()).ln();
    for (heading, turns_are_known, turned) in
        [(7.2, true, 0.2), (7.2 - 2.0 * PI, false, 0.2), (0.5, true, -6.5)]
    {
        let observed = Observed {
            vehicles: [
                ObservedVehicle::default(),
                ObservedVehicle {
                    rest: Some(rest(heading, turns_are_known)),
                    points: vec![0.5, 0.25],
                    ..ObservedVehicle::default()
                },
            ],
            ..Observed::default()
        };
        let followed = Followed { model: CollisionModel::new(&rear_end()), ways: [None, Some(way.clone())] };
        let model = CollisionModel::of(followed, observed);
        assert_eq!(model.pieces(), [Piece::Rest(Two), Piece::Points(Two)]);
        let mut terms = [Lanes::ZERO; 2];
        model.log_likelihood(&[], &mut terms, &mut [0; LANES]);
        let expected = [place + normal(turned / 0.3, 0.3), normal(0.4 / 0.5, 0.5) + normal(0.1 / 0.25, 0.25)];
        for (column, expected) in terms.iter().zip(expected) {
            assert!((column[3] - expected).abs() < 1e-9, "{} {expected}", column[3]);
        }
    }
}

/// A rest 2 m farther along the path, however the scene is turned.
#[test]
fn the_score_of_a_rest_is_that_along_the_way() {
    for direction in [0.0, 1.0, 2.5, -2.0_f64] {
        let ahead = |way: f64| Vector2::new(way * direction.cos(), way * direction.sin());
        let way = Way { position: ahead(10.0), heading: 0.0, misses: None };
        let rest = MeasuredRest {
            position: ahead(12.0),
            impact: Vector2::new(0.0, 0.0),
            error: PlaceError { least: 0.4, share: 0.1, survey: 0.0 },
            heading: 0.1,
            turns_are_known: true,
            heading_sd: 0.3,
        };
        let observed = Observed {
            vehicles: [
                ObservedVehicle { rest: Some(rest), ..ObservedVehicle::default() },
                ObservedVehicle::default(),
            ],
            ..Observed::default()
        };
        let followed = Followed { model: CollisionModel::new(&rear_end()), ways: [Some(way), None] };
        let impacts = followed.impacts(&[]);
        let mut scores = [Lanes::ZERO];
        CollisionModel::of(followed, observed).score(&impacts, &mut scores);
        // σ = 1.6 m at the measured distance, and 1.4 m at the computed one.
        close(scores[0][0], 2.0 / (1.6_f64 * 1.4).sqrt());
    }
}

#[test]
fn a_recorded_yaw_rate_is_that_after_the_impact() {
    let mut collision = rear_end();
    // A central impact turns nothing.
    collision.observed.vehicles[1].recorder.yaw_rate = Some(Measured { value: 0.3, sd: 0.2 });
    let [(Piece::RecordedYawRate(Two), term)] = terms(&collision)[..] else { panic!() };
    close(term, normal(0.3 / 0.2, 0.2));
}

/// A recorder whose last speeds fell too steeply stored one of two speeds: a mixture of two normal errors,
/// whose probability below is the share of the observation.
#[test]
fn a_recorder_may_mean_one_of_two_speeds() {
    let two = [(0.3, Measured { value: 12.0, sd: 0.5 }), (0.7, Measured { value: 25.0, sd: 1.0 })];
    for speed in [11.0, 12.2, 16.0, 24.0, 26.5] {
        let mut collision = rear_end();
        collision.speeds = Speeds::Each([speed.into(), 0.0.into()]);
        collision.observed.vehicles[0].recorder.speed = Some(ShownSpeed::Either(two));
        let [(Piece::RecordedSpeed(One), term)] = terms(&collision)[..] else { panic!() };
        let density = |(weight, Measured { value, sd }): (f64, Measured)| {
            let z = (value - speed) / sd;
            weight * (-0.5 * z * z).exp() / (sd * (2.0 * PI).sqrt())
        };
        assert!((term - two.map(density).iter().sum::<f64>().ln()).abs() < 1e-9, "{speed} {term}");
        let model = CollisionModel::new(&collision);
        let impacts = model.leads().impacts(&[]);
        let mut scores = [Lanes::ZERO];
        model.score(&impacts, &mut scores);
        // Φ(z) = Σ w Φ((v − v̂)/σ), by trapezoids.
        let below = |z: f64| {
            let (low, steps) = (-12.0, 4000);
            let h = (z - low) / f64::from(steps);
            let of = |k: i32| (-0.5 * (low + h * f64::from(k)).powi(2)).exp() / (2.0 * PI).sqrt();
            (0..steps).map(|k| 0.5 * h * (of(k) + of(k + 1))).sum::<f64>()
        };
        let expected: f64 =
            two.iter().map(|(weight, one)| weight * below((one.value - speed) / one.sd)).sum();
        assert!((below(scores[0][0]) - expected).abs() < 1e-4, "{speed} {}", scores[0][0]);
    }
}

#[test]
fn a_recorder_stores_no_speed_of_a_vehicle_that_moves_backward() {
    for (speed, is_possible) in [(15.0, true), (-3.0, false), (0.0, false)] {
        let mut collision = rear_end();
        collision.speeds = Speeds::Each([speed.into(), (-20.0).into()]);
        collision.observed.vehicles[0].recorder.speed =
            Some(MeasuredSpeed { value: 16.0, ln_sd: 0.05, least: 0.0 }.into());
        let [(Piece::RecordedSpeed(One), term)] = terms(&collision)[..] else { panic!() };
        assert_eq!(term > f64::NEG_INFINITY, is_possible, "{speed} {term}");
        assert!(!term.is_nan());
    }
}

/// Energies obtained by different methods: each is divided by its own exp(b), and the errors are weighted by
/// the shares, 30 kJ and 20 e^0.5 kJ.
#[test]
fn each_crush_energy_has_its_own_error() {
    let mut collision = rear_end();
    let crush = |energy: f64| CrushNumbers {
        constant: energy,
        linear: 0.0,
        square: 0.0,
        slope: Number::Exact(1.0),
        no_damage_speed: Number::Exact(1.0),
    };
    collision.vehicles[0].crush = Some(crush(30e3));
    collision.vehicles[1].crush = Some(crush(20e3));
    let ees = EnergyError { bias: 0.0, shared_ln_sd: 0.2, own_ln_sd: 0.1 };
    let class = EnergyError { bias: -0.5, shared_ln_sd: 0.4, own_ln_sd: 0.3 };
    collision.observed.crush = Some(CrushErrors([ees, class]));
    let [(Piece::Crush, term)] = terms(&collision)[..] else { panic!() };
    let right = [30e3, 20e3 * 0.5_f64.exp()];
    let sum = right[0] + right[1];
    let [w1, w2] = right.map(|energy| energy / sum);
    let sd = ((w1 * 0.2 + w2 * 0.4).powi(2) + (w1 * 0.1).powi(2) + (w2 * 0.3).powi(2)).sqrt();
    close(term, normal((sum / 66_825.0_f64).ln() / sd, sd));
    assert!((class.factor() - 1.648_721_270_700_128).abs() < 1e-12);
}

/// For energies obtained by the same method the bits are those of one bias and one error.
#[test]
fn energies_obtained_alike_have_one_error() {
    let misfit = FITTED.crush_misfit(&[DamagedSide::Front; 2]);
    let energies = [12_345.6, 7_890.1];
    let found = CrushErrors::from(misfit).log_likelihood(energies, 30e3);
    let error = real::elementary::ln((energies[0] + energies[1]) / 30e3) - misfit.bias;
    let z = error / misfit.ln_sd;
    assert_eq!(found, -0.5 * z * z - real::elementary::ln(misfit.ln_sd) - 0.918_938_533_204_672_8);
}

/// A record that ends early: the probability of what it would have shown at the end, by the sum of the
/// density of a whole record.
#[test]
fn a_record_that_ends_early_is_a_bound() {
    let term = |recorder: RecordedData| {
        let mut collision = rear_end();
        collision.observed.vehicles[0].recorder = recorder;
        let [(piece, term)] = terms(&collision)[..] else { panic!() };
        assert_eq!(piece == Piece::LeastDeltaV(One), recorder.ends_early);
        term
    };
    let part = |along: f64, ends_early| {
        let part = RecordedPart { along, ln_scale: 0.08, least: 0.3, freedom: Freedom::Three };
        term(RecordedData { longitudinal: Some(part), ends_early, ..RecordedData::default() })
    };
    let size = |size: f64, ends_early| {
        let (is_longitudinal, ln_scale, least) = (false, 0.08, 0.3);
        let whole = RecordedDeltaV { size, is_longitudinal, ln_scale, least, freedom: Freedom::Three };
        term(RecordedData { delta_v: Some(whole), ends_early, ..RecordedData::default() })
    };
    // Vehicle 1 lost 6.6 m/s. In steps that grow by a thousandth each, from 1 mm/s up to where only the tail
    // ∝ y⁻¹(ln y)⁻³ is left.
    let sum = |density: &dyn Fn(f64) -> f64, from: f64, sign: f64| -> f64 {
        let ends = |step: i32| 1.001_f64.powi(step) - 1.0;
        let step = |k: i32| {
            let [begin, end] = [ends(k), ends(k + 1)];
            density(from + sign * f64::midpoint(begin, end)).exp() * (end - begin)
        };
        (0..6_000).map(step).sum()
    };
    for stored in [-3.0, -6.0, -6.6, -7.5, -10.0] {
        let expected = sum(&|y| part(y, false), stored, -1.0);
        assert!(
            (part(stored, true).exp() - expected).abs() < 5e-4,
            "{stored}: {} {expected}",
            part(stored, true).exp()
        );
    }
    // The density of a size is one of ε = arsinh(σy/a): dε = σ dy/√(σ²y² + a²).
    let of_size = |y: f64| size(y, false) + (0.08 / (0.08 * y).hypot(0.3)).ln();
    for stored in [3.0, 6.6, 8.0] {
        let expected = sum(&of_size, stored, 1.0);
        assert!(
            (size(stored, true).exp() - expected).abs() < 5e-4,
            "{stored}: {} {expected}",
            size(stored, true).exp()
        );
    }
    assert!(part(-3.0, true) > -0.01 && part(-10.0, true) < -4.0 && part(3.0, true) < -4.0);
}

/// A longitudinal ΔV of −6.6 m/s and one of 0: Student's t in arsinh, with the density in m/s.
#[test]
fn a_longitudinal_part_has_its_sign() {
    let term = |along: f64| {
        let mut collision = rear_end();
        let part = RecordedPart { along, ln_scale: 0.08, least: 0.3, freedom: Freedom::Three };
        collision.observed.vehicles[0].recorder.longitudinal = Some(part);
        let [(Piece::RecordedDeltaV(One), term)] = terms(&collision)[..] else { panic!() };
        term
    };
    let a = 0.3_f64.hypot(0.05 * 6.6);
    for along in [-6.6, -5.0, 0.0, 5.0, 6.6_f64] {
        let z = ((0.08 * along / a).asinh() - (0.08 * -6.6 / a).asinh()) / 0.08;
        let density = 2.0 / (PI * 3.0_f64.sqrt() * (1.0 + z * z / 3.0).powi(2) * (0.08 * along).hypot(a));
        close(term(along), density.ln());
    }
    assert!(term(-6.6) > term(6.6) + 8.0);
}

#[test]
fn shares_far_out_are_none_and_all() {
    for freedom in [Freedom::Two, Freedom::Three] {
        for far in [1e100, 1e160, f64::INFINITY] {
            assert_eq!([-far, far].map(|z| freedom.share_below(z)), [0.0, 1.0], "{far}");
        }
        assert!((freedom.share_below(0.0) - 0.5).abs() < 1e-15 && freedom.share_below(f64::NAN).is_nan());
    }
}
