//! Simulation-based calibration (S. Talts, M. Betancourt, D. Simpson, A. Vehtari and A. Gelman, 2018):
//! crashes drawn from the prior, evidence simulated from them, and the rank of the truth among the draws of
//! the posterior, which is uniform if impact, likelihood and sampler are consistent.
//!
//! Truth and evidence are generated here, not by the tested likelihood: the severity by rejection, every
//! error from its own distribution.

use std::f64::consts::{FRAC_PI_2, PI};

use estimate::{Independent, ParticleSettings, Prior, Verdict, sample_quietly};
use evidence::DamagedSide::{self, Front, Rear, Side};
use evidence::{
    Behind, CodedPdof, Collision, CollisionModel, CrushErrors, CrushMisfit, CrushNumbers, DrawnOutput,
    EnergyError, FITTED, Freedom, Impacted, Impacts, Measured, MeasuredRest, MeasuredSpeed, Number,
    ObjectFigures, Observed, PlaceError, RecordedDeltaV, RestitutionModel, Severity, Speeds, Way,
};
use pim_core::VehicleId::{self, One, Two};
use pim_core::{Motion, Vector2};
use uncertainty::random::{bits, key, unit};
use uncertainty::{Distribution, LANES, Lanes};

use crate::likelihood::vehicle;

const DEGREE: f64 = PI / 180.0;

/// The outputs that are ranked.
const OUTPUTS: [DrawnOutput; 7] = [
    DrawnOutput::Speed(One),
    DrawnOutput::Speed(Two),
    DrawnOutput::DeltaV(One),
    DrawnOutput::DeltaV(Two),
    DrawnOutput::ClosingSpeed,
    DrawnOutput::EnergyLoss,
    DrawnOutput::Restitution,
];

/// Number of ranks.
const RANKS: usize = 20;

/// χ² with 19 degrees of freedom: the largest of 33, four shapes with seven outputs each and one with five,
/// is above with a probability of 1 %.
const ALL: f64 = 47.48;
/// A single one is above with a probability of 1 %.
const SINGLE: f64 = 36.19;

/// Sequence of random numbers of one simulation.
struct Random {
    key: u64,
    next: u64,
}

impl Random {
    fn unit(&mut self) -> f64 {
        self.next += 1;
        unit(bits(self.key, self.next))
    }

    /// Box–Muller, which the library does not use here.
    fn normal(&mut self) -> f64 {
        (-2.0 * self.unit().ln()).sqrt() * (2.0 * PI * self.unit()).cos()
    }

    /// Z/√(χ²/ν), with χ² the sum of squares of ν standard normal numbers.
    fn student(&mut self, freedom: u32) -> f64 {
        let squares: f64 = (0..freedom).map(|_| self.normal().powi(2)).sum();
        self.normal() / (squares / f64::from(freedom)).sqrt()
    }
}

/// A kind of crash, and how a true one is observed.
struct Shape {
    collision: Collision,
    observe: fn(&mut Collision, &Impacted, &mut Random),
}

fn normal(mean: f64, sd: f64) -> Number {
    Distribution::normal(mean, sd).unwrap().into()
}

fn log_normal(median: f64, ln_sd: f64) -> Number {
    Distribution::log_normal(median, ln_sd).unwrap().into()
}

/// Two cars with all the unknown numbers of a crash in the field. `contacts` (m) are along the damaged faces.
fn usual(masses: [f64; 2], headings: [f64; 2], crush_plane: f64, contacts: [[Number; 2]; 2]) -> Collision {
    let [low, rise, fade, ln_sd] = FITTED.restitution;
    let ([friction, friction_ln_sd], [share, share_sd]) = (FITTED.friction, FITTED.tangential_share);
    let vehicle = |i: usize| {
        let mut vehicle = vehicle(masses[i], 0.0);
        if let Some(body) = &mut vehicle.body {
            body.mass = log_normal(masses[i], FITTED.mass_ln_sd);
        }
        vehicle.heading = if i == 0 { normal(headings[0], FITTED.heading_sd) } else { headings[1].into() };
        vehicle.contact = contacts[i];
        vehicle.crush = Some(CrushNumbers {
            constant: 5e3,
            linear: 20e3,
            square: 25e3,
            slope: log_normal(1.0, FITTED.slope_ln_sd),
            no_damage_speed: log_normal(1.0, FITTED.no_damage_speed_ln_sd),
        });
        vehicle
    };
    Collision {
        vehicles: [vehicle(0), vehicle(1)],
        speeds: Speeds::Together {
            ln_relative: Distribution::uniform(0.3_f64.ln(), 120.0_f64.ln()).unwrap().into(),
            split: Distribution::uniform(0.0, FRAC_PI_2).unwrap().into(),
        },
        crush_plane: normal(crush_plane, FITTED.crush_plane_sd),
        restitution: RestitutionModel::ByClosingSpeed {
            low,
            rise,
            fade,
            factor: log_normal(1.0, ln_sd),
            most: FITTED.most_restitution,
        },
        friction: log_normal(friction, friction_ln_sd),
        tangential_share: Distribution::truncated_normal(share, share_sd, 0.0, 1.0).unwrap().into(),
        other_crush: None,
        observed: Observed { severity: Some(FITTED.severity), ..Observed::default() },
    }
}

/// Profiles with the misfit of two vehicles.
fn crush(hit: [DamagedSide; 2], collision: &mut Collision, truth: &Impacted, random: &mut Random) {
    let misfit = FITTED.crush_misfit(&hit);
    profiles(misfit, collision, truth, random);
    collision.observed.crush = Some(misfit.into());
}

/// Profiles whose width gives the crush energy with its error. The energy is proportional to the width, so
/// that in effect the width is observed, whatever the stiffness.
fn profiles(misfit: CrushMisfit, collision: &mut Collision, truth: &Impacted, random: &mut Random) {
    let CrushMisfit { bias, ln_sd } = misfit;
    let energy = truth.taken * (bias + ln_sd * random.normal()).exp();
    let width = energy / truth.crush_energies.iter().sum::<f64>();
    for vehicle in &mut collision.vehicles {
        if let Some(crush) = &mut vehicle.crush {
            crush.constant *= width;
            crush.linear *= width;
            crush.square *= width;
        }
    }
}

fn direction(truth: &Impacted, id: VehicleId, random: &mut Random) -> Option<Measured> {
    let velocity = truth.outcome.after[id.index()].velocity;
    let sd = 8.0 * DEGREE;
    Some(Measured { value: velocity.y.atan2(velocity.x) + sd * random.normal(), sd })
}

/// A front that strikes the side of a crossing car: crush, the directions of both after the impact, and a
/// coded PDOF.
fn front_and_side() -> Shape {
    let contacts = [[1.9.into(), normal(0.1, 0.25)], [normal(0.4, 0.25), 0.7.into()]];
    Shape {
        collision: usual([1500.0, 1300.0], [0.0, -FRAC_PI_2], PI, contacts),
        observe: |collision, truth, random| {
            crush([Front, Side], collision, truth, random);
            for id in VehicleId::ALL {
                collision.observed.vehicles[id.index()].after.direction = direction(truth, id, random);
            }
            let scale = FITTED.pdof_scale;
            let pdof = truth.outcome.pdof()[0] + scale * random.student(2);
            collision.observed.vehicles[0].pdof = Some(CodedPdof { pdof, scale });
        },
    }
}

/// A front that strikes the rear of a car on the same line: crush, and the recorder of the striking car, with
/// its ΔV along the car and its speed.
fn front_and_rear() -> Shape {
    let contacts = [[2.0.into(), normal(0.2, 0.25)], [(-2.1).into(), normal(-0.2, 0.25)]];
    Shape {
        collision: usual([1800.0, 1200.0], [0.0, 0.0], PI, contacts),
        observe: |collision, truth, random| {
            crush([Front, Rear], collision, truth, random);
            let recorder = &mut collision.observed.vehicles[0].recorder;
            let (whole, along) =
                (truth.outcome.delta_v_magnitude()[0], truth.outcome.delta_v_components()[0][0].abs());
            let ln_scale = FITTED.recorder_ln_scale;
            recorder.delta_v = Some(RecordedDeltaV {
                // A recorder stores no component smaller than a twentieth of the whole.
                size: along.max(0.05 * whole) * (ln_scale * random.student(3)).exp(),
                is_longitudinal: true,
                ln_scale,
                least: 0.0,
                freedom: Freedom::Three,
            });
            let sd = 0.05;
            recorder.speed = Some(
                MeasuredSpeed {
                    value: truth.speeds[0] * (sd * random.normal()).exp(),
                    ln_sd: sd,
                    least: 0.0,
                }
                .into(),
            );
        },
    }
}

/// Two fronts, offset: crush, both velocities after the impact, and the yaw rate of one.
fn front_and_front() -> Shape {
    let contacts = [[1.8.into(), normal(0.5, 0.25)], [1.7.into(), normal(0.5, 0.25)]];
    let mut collision = usual([1400.0, 1600.0], [0.0, PI + 0.15], PI, contacts);
    let severity = Severity { median: FITTED.severity.median * FITTED.front_to_front, ..FITTED.severity };
    collision.observed.severity = Some(severity);
    Shape {
        collision,
        observe: |collision, truth, random| {
            crush([Front, Front], collision, truth, random);
            for id in VehicleId::ALL {
                let velocity = truth.outcome.after[id.index()].velocity;
                let speed = velocity.x.hypot(velocity.y);
                let after = &mut collision.observed.vehicles[id.index()].after;
                after.direction = direction(truth, id, random);
                after.speed = Some(MeasuredSpeed {
                    value: speed * (0.12 * random.normal()).exp(),
                    ln_sd: 0.12,
                    least: 0.0,
                });
            }
            let yaw_rate = truth.outcome.after[1].yaw_rate + 0.5 * random.normal();
            collision.observed.vehicles[1].after.yaw_rate = Some(Measured { value: yaw_rate, sd: 0.5 });
        },
    }
}

/// A front that strikes the side of a crossing car, and both slide to rest: crush, and both rest positions
/// and headings, without the number of full turns.
fn front_and_side_to_rest() -> Shape {
    let contacts = [[1.9.into(), normal(0.1, 0.25)], [normal(0.4, 0.25), 0.7.into()]];
    Shape {
        collision: usual([1500.0, 1300.0], [0.0, -FRAC_PI_2], PI, contacts),
        observe: |collision, truth, random| {
            crush([Front, Side], collision, truth, random);
            for (i, way) in ways(truth).into_iter().enumerate() {
                let heading_sd = 15.0 * DEGREE;
                let error = Vector2::new(random.normal(), random.normal()) * REST_SD;
                collision.observed.vehicles[i].rest = Some(MeasuredRest {
                    position: way.position + error,
                    impact: Vector2::new(0.0, 0.0),
                    error: PlaceError { least: REST_SD, share: 0.0, survey: 0.0 },
                    heading: way.heading + heading_sd * random.normal(),
                    turns_are_known: false,
                    heading_sd,
                });
            }
        },
    }
}

/// A front that strikes a fixed object, as a case with a class stiffness poses it, at any speed: crush, whose
/// bias and spread differ from those that were fitted by their errors, and a coded PDOF.
fn front_and_object() -> Shape {
    let contacts = [[1.9.into(), normal(-0.3, 0.25)], [0.0.into(), 0.0.into()]];
    let mut collision = usual([1500.0, 1.0], [0.0, 0.0], PI, contacts);
    collision.speeds = Speeds::Each([Distribution::uniform(0.0, 70.0).unwrap().into(), 0.0.into()]);
    collision.observed.severity = Some(Severity { uniform_speeds: 1, ..FITTED.objects.severity });
    let object = &mut collision.vehicles[1];
    (object.body, object.crush) = (None, None);
    Shape {
        collision,
        observe: |collision, truth, random| {
            let ObjectFigures { misfit, covariance: [[of_bias, both], [_, of_spread]], .. } = FITTED.objects;
            // Both errors jointly: that of the spread first, then that of the bias for it.
            let z = random.normal();
            let spread = of_spread.sqrt() * z;
            let drift = both / of_spread.sqrt();
            let bias = drift * z + (of_bias - drift * drift).sqrt() * random.normal();
            let figures = CrushMisfit { bias: misfit.bias + bias, ln_sd: misfit.ln_sd * spread.exp() };
            profiles(figures, collision, truth, random);
            let behind = [Behind::Misfit { bias: true, spread: true }, Behind::Nothing];
            collision.observed.crush = Some(misfit.into());
            collision.observed.figures = FITTED.objects.figures(behind);
            let scale = FITTED.pdof_scale;
            let pdof = truth.outcome.pdof()[0] + scale * random.student(2);
            collision.observed.vehicles[0].pdof = Some(CodedPdof { pdof, scale });
        },
    }
}

/// (m) standard deviation of a rest position, in each direction.
const REST_SD: f64 = 1.5;

/// Straight ahead to rest under a drag factor of 0.5, turning ever slower meanwhile. The position is that
/// from the impact.
fn slide(after: &Motion, heading: f64) -> Way {
    let deceleration = 0.5 * 9.806_65;
    let speed = after.velocity.norm();
    // s = v²/2a, t = v/a, ψ = ω t/2
    Way {
        position: after.velocity * (speed / (2.0 * deceleration)),
        heading: heading + 0.5 * after.yaw_rate * speed / deceleration,
        misses: None,
    }
}

/// The path of each vehicle. Their headings at the impact count as the mean ones, to which those at rest are
/// relative.
fn ways(impacted: &Impacted) -> [Way; 2] {
    let [one, two] = &impacted.outcome.after;
    [slide(one, 0.0), slide(two, -FRAC_PI_2)]
}

/// Impacts whose vehicles slide to rest where a rest is evidence, and are followed only where that is wanted.
struct Sliding {
    impacts: CollisionModel,
    followed: bool,
}

impl Impacts for Sliding {
    fn unknown(&self) -> &Independent {
        self.impacts.leads().unknown()
    }

    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted> {
        let impacts = self.impacts.leads().impacts(values).into_iter();
        let follow = |impacted: Impacted| Impacted { ways: ways(&impacted).map(Some), ..impacted };
        if self.followed { impacts.map(follow).collect() } else { impacts.collect() }
    }

    fn impacts_as_wanted(
        &self,
        values: &[Lanes],
        wanted: &mut dyn FnMut(VehicleId, &[Impacted]) -> [bool; LANES],
    ) -> Option<Vec<Impacted>> {
        let mut impacts = self.followed.then(|| self.impacts.leads().impacts(values))?;
        for id in VehicleId::ALL {
            let is_wanted = wanted(id, &impacts);
            for (impacted, _) in impacts.iter_mut().zip(is_wanted).filter(|(_, is_wanted)| *is_wanted) {
                let way = ways(impacted)[id.index()].clone();
                impacted.ways[id.index()] = Some(way);
            }
        }
        Some(impacts)
    }
}

/// A possible crash from the prior, accepted in proportion to the frequency of its severity.
fn truth(collision: &Collision, random: &mut Random) -> Impacted {
    let model = CollisionModel::new(collision);
    let severity = collision.observed.severity.unwrap();
    loop {
        let mut standard = vec![Lanes::ZERO; model.values_count()];
        for number in standard.iter_mut().flatten() {
            *number = random.normal();
        }
        let mut values = standard.clone();
        model.values(&standard, &mut values);
        for impacted in model.leads().impacts(&values) {
            let [dv1, dv2] = impacted.outcome.delta_v_magnitude();
            let [v1, v2] = impacted.speeds;
            // A fixed object has no ΔV: that of the vehicle alone counts.
            let mean = if collision.vehicles[1].body.is_some() { (dv1 * dv2).sqrt() } else { dv1 };
            let uniform = f64::from(severity.uniform_speeds) * severity.ln_sd * severity.ln_sd;
            let z = ((mean / severity.median).ln() + uniform) / severity.ln_sd;
            let frequency = (-0.5 * (z * z + (v1 * v1 + v2 * v2) / severity.speed.powi(2))).exp();
            if impacted.is_possible && random.unit() < frequency {
                return impacted;
            }
        }
    }
}

fn outputs(truth: &Impacted) -> [f64; OUTPUTS.len()] {
    let outcome = &truth.outcome;
    let ([v1, v2], [dv1, dv2]) = (truth.speeds, outcome.delta_v_magnitude());
    let e = -outcome.separation.normal / outcome.approach.normal;
    [v1, v2, dv1, dv2, -outcome.approach.normal, outcome.energy.loss, e]
}

/// Number of simulations in which the truth had each rank, for each of [`OUTPUTS`] that varies; `spoil`
/// changes the input of the estimate.
fn ranks(
    shape: &Shape,
    simulations: u64,
    islands: usize,
    spoil: impl Fn(&mut Collision),
) -> Vec<[f64; RANKS]> {
    let mut counts = [[0.0; RANKS]; OUTPUTS.len()];
    let mut converged = 0;
    for seed in 0..simulations {
        let mut random = Random { key: key(2026, &[seed]), next: 0 };
        let truth = truth(&shape.collision, &mut random);
        let mut collision = shape.collision.clone();
        (shape.observe)(&mut collision, &truth, &mut random);
        spoil(&mut collision);
        let followed = collision.observed.vehicles.iter().any(|vehicle| vehicle.rest.is_some());
        let impacts = Sliding { impacts: CollisionModel::new(&collision), followed };
        let model = CollisionModel::of(impacts, collision.observed);
        let settings = ParticleSettings { islands, ..ParticleSettings::new(128, seed) };
        let posterior = sample_quietly(&model, &model, &settings).unwrap();
        converged += u32::from(posterior.verdict() == Verdict::Converged);
        for ((counts, truth), output) in counts.iter_mut().zip(outputs(&truth)).zip(OUTPUTS) {
            let column = &posterior.outputs()[output.column()];
            let below = column.iter().filter(|draw| **draw < truth).count();
            counts[below * RANKS / (column.len() + 1)] += 1.0;
        }
    }
    println!("{converged} of {simulations} converged");
    // A fixed object has neither speed nor ΔV.
    let is_of_two = shape.collision.vehicles[1].body.is_some();
    let varies = |output: &DrawnOutput| {
        is_of_two || !matches!(output, DrawnOutput::Speed(Two) | DrawnOutput::DeltaV(Two))
    };
    counts.into_iter().zip(OUTPUTS).filter(|(_, output)| varies(output)).map(|(counts, _)| counts).collect()
}

fn squares(counts: &[[f64; RANKS]]) -> Vec<f64> {
    let square = |counts: &[f64; RANKS]| {
        let expected = counts.iter().sum::<f64>() / RANKS as f64;
        counts.iter().map(|count| (count - expected) * (count - expected) / expected).sum()
    };
    counts.iter().map(square).collect()
}

/// A thousand crashes; docs/calibration.md has the last result.
fn assert_calibrated(shape: &Shape) {
    let counts = ranks(shape, 1000, 16, |_| ());
    let squares = squares(&counts);
    let above = squares.iter().filter(|square| **square > SINGLE).count();
    println!("χ² {squares:.1?}, {above} above {SINGLE}");
    assert!(squares.iter().all(|square| *square < ALL), "{squares:?} {counts:?}");
}

#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn ranks_are_uniform_where_a_front_meets_a_side() {
    assert_calibrated(&front_and_side());
}

#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn ranks_are_uniform_where_a_front_meets_a_rear() {
    assert_calibrated(&front_and_rear());
}

#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn ranks_are_uniform_where_two_fronts_meet() {
    assert_calibrated(&front_and_front());
}

#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn ranks_are_uniform_where_both_slide_to_rest() {
    assert_calibrated(&front_and_side_to_rest());
}

#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn ranks_are_uniform_where_a_front_meets_a_fixed_object() {
    assert_calibrated(&front_and_object());
}

/// A wrong misfit of the crush, a wrong error of the rests, or the severity of another kind of collision
/// shows in three hundred crashes.
#[test]
#[ignore = "a thousand estimates: minutes with --release, and then -- --ignored --nocapture"]
fn wrong_errors_are_noticed() {
    let most = |shape: &Shape, spoil: fn(&mut Collision)| {
        let squares = squares(&ranks(shape, 300, 16, spoil));
        println!("χ² {squares:.1?}");
        squares.iter().copied().fold(0.0, f64::max)
    };
    // A crush misfit that is too small.
    let crush = most(&front_and_rear(), |collision| {
        let CrushErrors([EnergyError { bias, shared_ln_sd, .. }, _]) = collision.observed.crush.unwrap();
        collision.observed.crush = Some(CrushMisfit { bias, ln_sd: 0.5 * shared_ln_sd }.into());
    });
    // A crush misfit without its bias.
    let bias = most(&front_and_side(), |collision| {
        let CrushErrors([EnergyError { shared_ln_sd, .. }, _]) = collision.observed.crush.unwrap();
        collision.observed.crush = Some(CrushMisfit { bias: 0.0, ln_sd: shared_ln_sd }.into());
    });
    // Rests that err more than is stated.
    let rests = most(&front_and_side_to_rest(), |collision| {
        for rest in collision.observed.vehicles.iter_mut().filter_map(|vehicle| vehicle.rest.as_mut()) {
            rest.error.least *= 0.5;
        }
    });
    // Collisions with a fixed object, by the misfit and the severity of two vehicles.
    let of_objects = most(&front_and_object(), |collision| {
        let CrushMisfit { bias, ln_sd } = FITTED.objects.misfit;
        collision.observed.crush = Some(CrushMisfit { bias, ln_sd: 0.5 * ln_sd }.into());
    });
    let of_two = most(&front_and_object(), |collision| {
        collision.observed.severity = Some(Severity { uniform_speeds: 1, ..FITTED.severity });
    });
    let found = [crush, bias, rests, of_objects, of_two];
    assert!(found.iter().all(|square| *square > ALL), "{found:?}");
}

/// Twenty crashes: the number with speeds in the middle half of the draws is within the range of the heads of
/// twenty fair coins in all but one of ten thousand runs.
#[test]
fn half_of_the_truths_are_in_the_middle_half() {
    for shape in [front_and_rear(), front_and_side_to_rest(), front_and_object()] {
        for counts in ranks(&shape, 20, 4, |_| ()) {
            let middle: f64 = counts[5..15].iter().sum();
            assert!((2.0..=18.0).contains(&middle), "{counts:?}");
        }
    }
}
