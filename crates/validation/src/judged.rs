//! Both speeds of the staged collisions as a posterior, and whether its intervals contain the true ones.
//!
//! The known data of a test are its masses, its headings, its crush profiles and the published motion after
//! the impact. All further assumptions, [`FITTED`], were fitted to real crashes, none of them staged. The
//! errors specific to a staged test were set before any interval was compared with a true speed:
//!
//! | quantity | error | why |
//! |---|---|---|
//! | speed after the impact | ln-sd 0.12 | the velocities were integrated from accelerations; the impulses that they imply on the two vehicles of a test differ by 9 to 39 % |
//! | its direction | 8° | the same |
//! | crush plane Γ | 5° | measured in a staged test; half of that of the field |
//! | contact point C | 0.10 m along the vehicle and across | the same |
//! | masses, headings, yaw inertias | none | measured, or set by the test |
//! | stiffness | CRASH3's category as in the case, κ and β with the spread of the field | the fleet of the field is forty years younger |
//!
//! No source was found for the error of the yaw rate: most of it is that of the model, whose impulse acts at
//! one point. It is fitted to the other ten tests, with their true speeds given.

use estimate::{DrawnQuantity, ParticleSettings, Posterior, Verdict, sample_quietly};
use evidence::{
    Behind, BodyNumbers, Collision, CollisionModel, CrushNumbers, DamagedSide, DrawnOutput, FITTED, Fitted,
    Measured, MeasuredSpeed, Number, Observed, ObservedVehicle, PostImpactMotion, Speeds, VehicleNumbers,
};
use pim_core::{Motion, VehicleId};
use real::Real;
use real::elementary::{atan2, ln};
use uncertainty::{Distribution, InvalidDistribution};

use crate::Data;
use crate::error::ValidationError;
use crate::published::{DEGREE, Published};
use crate::scene::{Collided, Scene, length_and_direction, polar};
use crate::staged::Staged;

/// (rad/s) candidates for the spread of the yaw rate after the impact; the most likely one is used.
const YAW_RATE_SDS: [f64; 5] = [0.35, 0.5, 0.7, 1.0, 1.4];
/// (m/s) a vehicle below this speed was at rest, which is known.
const STOOD: f64 = 1e-9;
/// The index of the 95 % interval in a summary.
const NINETY_FIVE: usize = 3;

/// The errors of the data of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssumedErrors {
    /// (–) spread of the logarithm of a published speed after the impact.
    pub speed_ln_sd: f64,
    /// (rad) spread of its direction.
    pub direction_sd: f64,
    /// The figures fitted to real crashes, but with the spreads of crush plane and contact point, along the
    /// vehicle and across, for a staged test.
    pub fitted: Fitted,
}

impl AssumedErrors {
    /// Those in the table above.
    pub const STATED: Self = Self {
        speed_ln_sd: 0.12,
        direction_sd: 8.0 * DEGREE,
        fitted: Fitted { crush_plane_sd: 5.0 * DEGREE, contact_sd: 0.10, ..FITTED },
    };
}

/// The known data on the motion after the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterImpact {
    /// The velocities of both vehicles.
    Velocities,
    /// Their yaw rates too.
    VelocitiesAndYawRates,
}

/// A speed that was not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JudgedSpeed {
    /// The vehicle.
    pub vehicle: VehicleId,
    /// (m/s) true speed.
    pub true_speed: f64,
    /// (m/s) half of the posterior lies below.
    pub median: f64,
    /// (m/s) ends of the interval that contains 95 % of it.
    pub interval: [f64; 2],
}

impl JudgedSpeed {
    /// Whether the interval contains the true speed.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        let [low, high] = self.interval;
        (low..=high).contains(&self.true_speed)
    }

    /// (–) half of the interval's width, as a share of the true speed.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        0.5 * (self.interval[1] - self.interval[0]) / self.true_speed
    }

    /// (–) how far the median is off, as a share of the true speed.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.median / self.true_speed - 1.0
    }
}

/// A test, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedTest {
    /// The test.
    pub test: u8,
    /// The speeds of the vehicles that moved.
    pub speeds: Vec<JudgedSpeed>,
    /// (rad/s) spread of the yaw rates after the impact that was fitted to the other tests; `None` if the yaw
    /// rates are not used as evidence.
    pub yaw_rate_sd: Option<f64>,
    /// Whether the sampler converged.
    pub converged: bool,
}

/// All tests, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedTests {
    /// Each test.
    pub tests: Vec<JudgedTest>,
}

impl JudgedTests {
    /// Each speed.
    pub fn speeds(&self) -> impl Iterator<Item = &JudgedSpeed> {
        self.tests.iter().flat_map(|test| &test.speeds)
    }

    /// Number of speeds inside their intervals.
    #[must_use]
    pub fn inside(&self) -> usize {
        self.speeds().filter(|speed| speed.is_inside()).count()
    }

    /// (–) mean and largest half width, as shares of the true speeds.
    #[must_use]
    pub fn half_widths(&self) -> [f64; 2] {
        let [sum, most] = self.speeds().fold([0.0, 0.0], |[sum, most], speed| {
            [sum + speed.half_width(), f64::max(most, speed.half_width())]
        });
        #[expect(clippy::cast_precision_loss, reason = "a handful of speeds")]
        let count = self.speeds().count() as f64;
        [sum / count, most]
    }
}

/// Estimates the speeds of every test from crush and motion after the impact, with `particles` in each of the
/// sampler's islands.
///
/// # Errors
/// If the data cannot be run, which never happens with the built-in data, or the sampler has no draws.
pub fn judge_speeds(
    data: &Data,
    after_impact: AfterImpact,
    particles: usize,
    seed: u64,
) -> Result<JudgedTests, ValidationError> {
    judge_speeds_assuming(data, after_impact, &AssumedErrors::STATED, particles, seed)
}

/// The same with other errors, to see which of them makes the intervals wide.
///
/// # Errors
/// As for [`judge_speeds`], and if a spread is not positive.
pub fn judge_speeds_assuming(
    data: &Data,
    after_impact: AfterImpact,
    assumed: &AssumedErrors,
    particles: usize,
    seed: u64,
) -> Result<JudgedTests, ValidationError> {
    let (published, scene) = (Published::read(data)?, Scene::read(data)?);
    let subjects = published.collision.iter().map(|printed| {
        let staged = Staged::run(data, printed)?;
        Subject::of(&staged, &scene)
    });
    let subjects = subjects.collect::<Result<Vec<_>, ValidationError>>()?;
    let settings = ParticleSettings::new(particles, seed);
    let yaw_rate_sds = match after_impact {
        AfterImpact::Velocities => vec![None; subjects.len()],
        AfterImpact::VelocitiesAndYawRates => {
            yaw_rate_sds_of_others(&subjects, assumed, &settings)?.into_iter().map(Some).collect()
        }
    };
    let judged = subjects.iter().zip(yaw_rate_sds).map(|(subject, sd)| subject.judge(sd, assumed, &settings));
    Ok(JudgedTests { tests: judged.collect::<Result<_, _>>()? })
}

/// (rad/s) for each test, the spread of the yaw rates that is most likely for the other tests at their true
/// speeds.
fn yaw_rate_sds_of_others(
    subjects: &[Subject],
    assumed: &AssumedErrors,
    settings: &ParticleSettings,
) -> Result<Vec<f64>, ValidationError> {
    let mut of_sds = Vec::new();
    for sd in YAW_RATE_SDS {
        let log_evidence = |subject: &Subject| {
            let posterior = subject.posterior(&subject.collision(Some(sd), true, assumed)?, settings)?;
            Ok::<_, ValidationError>(posterior.log_evidence().value)
        };
        let each = subjects.iter().map(log_evidence).collect::<Result<Vec<_>, _>>()?;
        of_sds.push((sd, each.iter().sum::<f64>(), each));
    }
    let best = |test: usize| {
        let others = of_sds.iter().map(|(sd, sum, each)| (*sd, sum - each[test]));
        others.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(sd, _)| sd)
    };
    Ok((0..subjects.len()).map(best).collect())
}

/// The known data of a test, SI units.
struct Subject {
    test: u8,
    bodies: [BodyNumbers; 2],
    /// (rad)
    headings: [f64; 2],
    /// (m) ahead of the CG and to its left.
    contacts: [[f64; 2]; 2],
    /// (rad)
    crush_plane: f64,
    crushes: [CrushNumbers; 2],
    hit: [DamagedSide; 2],
    after: [Motion; 2],
    /// (m/s)
    true_speeds: [f64; 2],
}

impl Subject {
    fn of(staged: &Staged, scene: &Scene) -> Result<Self, ValidationError> {
        let test = staged.printed.test;
        let impact = staged.collision()?;
        let incomplete = ValidationError::Incomplete { test, what: "velocities after the impact" };
        let after = scene.after(test).ok_or(incomplete)?;
        let participants = impact.contact.participants();
        let Collided { headings, true_speeds, .. } = scene.collided(std::slice::from_ref(staged), test)?;
        Ok(Self {
            test,
            bodies: participants.each_ref().map(|participant| {
                let body = participant.body();
                // k² = I/m
                let yaw_radius = Real::sqrt(body.yaw_inertia() / body.mass());
                BodyNumbers { mass: body.mass().into(), yaw_radius: yaw_radius.into() }
            }),
            headings,
            contacts: participants.each_ref().map(|participant| {
                let (forward, arm) = (participant.forward(), participant.arm());
                [forward.dot(&arm), forward.perp(&arm)]
            }),
            crush_plane: impact.contact.normal_angle(),
            crushes: staged.crushes()?,
            hit: staged.hit()?,
            after: VehicleId::ALL.map(|id| after.motion(id)),
            true_speeds,
        })
    }

    /// (m/s) difference of the true velocities.
    fn relative_speed(&self) -> f64 {
        let [one, two] = [0, 1].map(|i| polar(self.true_speeds[i], self.headings[i]));
        length_and_direction(one - two).0
    }

    fn posterior(
        &self,
        collision: &Collision,
        settings: &ParticleSettings,
    ) -> Result<Posterior, ValidationError> {
        let model = CollisionModel::new(collision);
        sample_quietly(&model, &model, settings).map_err(|source| ValidationError::of_test(self.test, source))
    }

    fn judge(
        &self,
        yaw_rate_sd: Option<f64>,
        assumed: &AssumedErrors,
        settings: &ParticleSettings,
    ) -> Result<JudgedTest, ValidationError> {
        let posterior = self.posterior(&self.collision(yaw_rate_sd, false, assumed)?, settings)?;
        let moved = VehicleId::ALL.into_iter().zip(self.true_speeds).filter(|(_, speed)| *speed > STOOD);
        let speeds = moved.map(|(vehicle, true_speed)| {
            let summary = posterior.summary(DrawnQuantity::Output(DrawnOutput::Speed(vehicle).column()));
            let interval = summary.intervals[NINETY_FIVE];
            JudgedSpeed {
                vehicle,
                true_speed,
                median: summary.median.value,
                interval: [interval.low.value, interval.high.value],
            }
        });
        Ok(JudgedTest {
            test: self.test,
            speeds: speeds.collect(),
            yaw_rate_sd,
            converged: posterior.verdict() == Verdict::Converged,
        })
    }

    /// The collision with both speeds unknown, except that of a vehicle at rest, or with both known. Yaw
    /// rates after the impact are evidence if they have a spread (rad/s).
    fn collision(
        &self,
        yaw_rate_sd: Option<f64>,
        are_known: bool,
        &AssumedErrors { speed_ln_sd, direction_sd, fitted }: &AssumedErrors,
    ) -> Result<Collision, ValidationError> {
        let test = self.test;
        let unknown = |distribution: Result<Distribution, InvalidDistribution>| {
            distribution.map(Number::Unknown).map_err(|source| ValidationError::of_test(test, source))
        };
        let normal = |mean, sd| unknown(Distribution::normal(mean, sd));
        let factor = |ln_sd| unknown(Distribution::log_normal(1.0, ln_sd));
        let vehicle = |i: usize| {
            let [ahead, left] = self.contacts[i];
            Ok::<_, ValidationError>(VehicleNumbers {
                body: Some(self.bodies[i]),
                heading: self.headings[i].into(),
                contact: [normal(ahead, fitted.contact_sd)?, normal(left, fitted.contact_sd)?],
                yaw_rate: 0.0.into(),
                crush: Some(CrushNumbers {
                    slope: factor(fitted.slope_ln_sd)?,
                    no_damage_speed: factor(fitted.no_damage_speed_ln_sd)?,
                    ..self.crushes[i]
                }),
            })
        };
        let observed = |i: usize| {
            let (speed, direction) = length_and_direction(self.after[i].velocity);
            let after = PostImpactMotion {
                speed: Some(MeasuredSpeed { value: speed, ln_sd: speed_ln_sd, least: 0.0 }),
                direction: Some(Measured { value: direction, sd: direction_sd }),
                yaw_rate: yaw_rate_sd.map(|sd| Measured { value: self.after[i].yaw_rate, sd }),
                of_common_cg: false,
            };
            ObservedVehicle { after, ..ObservedVehicle::default() }
        };
        let [v1, v2] = self.true_speeds;
        let ln_relative =
            if are_known { ln(self.relative_speed()).into() } else { unknown(Speeds::any_ln_relative())? };
        let split = if are_known || v1 <= STOOD || v2 <= STOOD {
            // φ = atan(v₂/v₁)
            atan2(v2, v1).into()
        } else {
            unknown(Speeds::any_split())?
        };
        Ok(Collision {
            vehicles: [vehicle(0)?, vehicle(1)?],
            speeds: Speeds::Together { ln_relative, split },
            crush_plane: normal(self.crush_plane, fitted.crush_plane_sd)?,
            restitution: fitted.restitution_with(unknown(fitted.restitution_factor())?),
            friction: unknown(fitted.any_friction())?,
            tangential_share: unknown(fitted.any_tangential_share())?,
            other_crush: None,
            observed: Observed {
                vehicles: [observed(0), observed(1)],
                pdofs_differ: false,
                crush_is_bound: false,
                severity: Some(fitted.severity_of(&self.hit)),
                crush: Some(fitted.crush_misfit(&self.hit).into()),
                figures: fitted.crush_figures(&self.hit, [Behind::Misfit { bias: true, spread: true }; 2]),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use estimate::{DrawnQuantity, ParticleSettings};
    use evidence::DrawnOutput;
    use pim_core::VehicleId;

    use super::{AssumedErrors, Subject};
    use crate::Data;
    use crate::published::Published;
    use crate::scene::Scene;
    use crate::staged::Staged;

    /// The energy of the profile equals that of `crash3` for the vehicle of its kind; with its speeds given,
    /// a test has those speeds.
    #[test]
    fn a_subject_is_the_test() {
        let data = Data::built_in();
        let (published, scene) = (Published::read(&data).unwrap(), Scene::read(&data).unwrap());
        for printed in &published.collision {
            let staged = Staged::run(&data, printed).unwrap();
            let subject = Subject::of(&staged, &scene).unwrap();
            for (crush, energy) in subject.crushes.iter().zip(staged.from_profiles) {
                let sum = crush.constant + crush.linear + crush.square;
                assert!((sum - energy).abs() < 1e-9 * energy, "test {}: {sum} is not {energy}", subject.test);
            }
            let known = subject.collision(None, true, &AssumedErrors::STATED).unwrap();
            let posterior = subject.posterior(&known, &ParticleSettings::new(128, 1)).unwrap();
            for id in VehicleId::ALL {
                let speed =
                    posterior.summary(DrawnQuantity::Output(DrawnOutput::Speed(id).column())).median.value;
                assert!(
                    (speed - subject.true_speeds[id.index()]).abs() < 1e-9,
                    "test {}: {speed}",
                    subject.test
                );
            }
        }
    }
}
