//! From a case to the types of the engine: what each command demands of the file.

use std::f64::consts::{PI, TAU};

use crash3::{EnergyBasis, ObliqueCorrection, Profile, Side, Stiffness};
use pim_core::{Body, Contact, Law, Motion, Participant, RestitutionCurve, Vector2};
use reconcile::Unknown;

use crate::{
    CaseFile, ContactPoint, Crush, Diagnostic, Diagnostics, ImpactLaw, Quantity, Restitution, StiffnessForm,
    Vehicle, Velocity,
};

/// Two vehicles that collide, as the mechanics need them.
#[derive(Clone, Debug)]
pub struct Collision {
    /// The geometry.
    pub contact: Contact,
    /// The impact law; where there is a curve of restitution, with the coefficient of its first point.
    pub law: Law,
    /// The coefficient of restitution by closing speed, which replaces that of the law.
    pub restitution_curve: Option<RestitutionCurve>,
    /// Motions before impact. A vehicle whose speed is sought is at rest here but for its yaw rate.
    pub motions: [Motion; 2],
    /// What is known of each vehicle.
    pub vehicles: [Subject; 2],
}

/// One vehicle, as far as the file and the command have it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Mass and yaw inertia, or `None` for a fixed object.
    pub inertia: Option<Inertia>,
    /// (m) contact point C forward and left of the CG.
    pub contact: Option<[f64; 2]>,
    /// The damage.
    pub damage: Option<Damage>,
}

/// Mass and yaw inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// (kg) mass.
    pub mass: f64,
    /// (kg·m²) yaw inertia.
    pub yaw_inertia: f64,
}

/// Measured crush, and what the file says of the force that made it.
#[derive(Clone, Debug)]
pub struct Damage {
    /// The damaged side.
    pub side: Side,
    /// Depths along it.
    pub profile: Profile,
    /// Its stiffness.
    pub stiffness: Stiffness,
    /// How oblique forces are corrected.
    pub correction: ObliqueCorrection,
    /// (rad) PDOF as given.
    pub pdof: Option<f64>,
    /// (rad) α as given.
    pub oblique_angle: Option<f64>,
    /// (m) h as given.
    pub moment_arm: Option<f64>,
}

/// What `reconstruct` works on.
#[derive(Clone, Debug)]
pub struct ReconstructionInput {
    /// The collision, of which one speed is unknown.
    pub collision: Collision,
    /// Which one.
    pub unknown: Unknown,
    /// The energy basis.
    pub basis: EnergyBasis,
    /// (m/s) the speed that the file gives for the unknown all the same.
    pub given_speed: Option<f64>,
}

/// What `impact` works on.
#[derive(Clone, Debug)]
pub struct ImpactInput {
    /// The collision, of which all is known.
    pub collision: Collision,
    /// The energy basis, for CRASH3 beside it.
    pub basis: EnergyBasis,
}

/// What `crush` works on.
#[derive(Clone, Debug)]
pub struct CrushOnly {
    /// Both vehicles; the damage of each that is not fixed has a PDOF, or both an oblique angle and a moment arm.
    pub vehicles: [Subject; 2],
    /// The energy basis.
    pub basis: EnergyBasis,
    /// e, if the file has one that does not depend on the closing speed; 0 under Woolley's law.
    pub restitution: Option<f64>,
}

impl CaseFile {
    /// All that a reconstruction needs.
    ///
    /// # Errors
    /// Everything that is missing or does not fit together, with the place where it belongs.
    pub fn reconstruction(&self) -> Result<ReconstructionInput, Diagnostics> {
        let mut demand = Demand { file: self, command: "reconstruct", problems: Vec::new() };
        let unknown = demand.unknown();
        let collision = demand.collision(unknown);
        for (i, vehicle) in self.case.vehicles.iter().enumerate() {
            if !vehicle.fixed && vehicle.crush.is_none() {
                demand.missing(&format!("vehicle{}.crush", i + 1), CRUSH_EXAMPLE);
            }
        }
        demand.finish(collision.zip(unknown).map(|(collision, unknown)| ReconstructionInput {
            given_speed: self.case.vehicles[unknown.index()].motion.map(|motion| match motion {
                Velocity::Speed(speed) => speed.si(),
                Velocity::Vector { x, y } => (x.si() * x.si() + y.si() * y.si()).sqrt(),
            }),
            collision,
            unknown,
            basis: self.energy_basis(),
        }))
    }

    /// All that a calculation of the impact needs.
    ///
    /// # Errors
    /// Everything that is missing or does not fit together, with the place where it belongs.
    pub fn impact(&self) -> Result<ImpactInput, Diagnostics> {
        let mut demand = Demand { file: self, command: "impact", problems: Vec::new() };
        let collision = demand.collision(None);
        demand.finish(collision.map(|collision| ImpactInput { collision, basis: self.energy_basis() }))
    }

    /// All that an analysis of the damage alone needs.
    ///
    /// # Errors
    /// Everything that is missing or does not fit together, with the place where it belongs.
    pub fn crush(&self) -> Result<CrushOnly, Diagnostics> {
        let mut demand = Demand { file: self, command: "crush", problems: Vec::new() };
        let vehicles = [demand.subject(0), demand.subject(1)];
        for (i, vehicle) in self.case.vehicles.iter().enumerate() {
            if !vehicle.fixed {
                demand.direction_of_force(i, vehicle);
            }
        }
        let [v1, v2] = vehicles;
        demand.finish(v1.zip(v2).map(|(v1, v2)| CrushOnly {
            vehicles: [v1, v2],
            basis: self.energy_basis(),
            restitution: self.case.impact.as_ref().and_then(|impact| match impact.law.restitution() {
                Some(Restitution::Constant(e)) => Some(*e),
                Some(Restitution::OfClosingSpeed { .. }) => None,
                // Woolley: U_n = 0
                None => Some(0.0),
            }),
        }))
    }

    fn energy_basis(&self) -> EnergyBasis {
        self.case.reconstruct.as_ref().map_or(EnergyBasis::Dissipated, |reconstruct| reconstruct.energy_basis)
    }
}

/// (rad) the same direction in (−π, π].
fn wrapped(angle: f64) -> f64 {
    // φ − 2π ⌈(φ − π)/2π⌉
    angle - TAU * ((angle - PI) / TAU).ceil()
}

const CRUSH_EXAMPLE: &str = "a table with side, width, depths and stiffness";

/// Collects what a command needs, and everything that stands in its way.
struct Demand<'a> {
    file: &'a CaseFile,
    command: &'static str,
    problems: Vec<Diagnostic>,
}

impl Demand<'_> {
    fn missing(&mut self, path: &str, example: &str) {
        let message = format!("`{path}` is missing: `deltav {}` needs it", self.command);
        let help = format!("give {example}");
        self.problems.push(self.file.problem(path, message, Some(help)));
    }

    fn given<T: Copy>(&mut self, value: Option<T>, path: &str, example: &str) -> Option<T> {
        if value.is_none() {
            self.missing(path, example);
        }
        value
    }

    /// Turns the engine's refusal into a problem of the key that caused it.
    fn accepted<T>(&mut self, path: &str, result: Result<T, impl std::fmt::Display>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                self.problems.push(self.file.problem(path, error.to_string(), None));
                None
            }
        }
    }

    fn finish<T>(self, value: Option<T>) -> Result<T, Diagnostics> {
        match value {
            Some(value) if self.problems.is_empty() => Ok(value),
            _ => Err(Diagnostics::new(self.file.source.clone(), self.problems)),
        }
    }

    fn unknown(&mut self) -> Option<Unknown> {
        let find = self.file.case.reconstruct.as_ref().map(|reconstruct| reconstruct.find);
        self.given(find, "reconstruct.find", "`find = \"vehicle1.speed\"` in a table [reconstruct]")
    }

    fn collision(&mut self, unknown: Option<Unknown>) -> Option<Collision> {
        let vehicles = [self.subject(0), self.subject(1)];
        let participants = [self.participant(0), self.participant(1)];
        let motions = [self.motion(0, unknown), self.motion(1, unknown)];
        let law = self.law();
        let ([v1, v2], [p1, p2], [m1, m2]) = (vehicles, participants, motions);
        let contact = self.contact([p1?, p2?])?;
        let (law, restitution_curve) = law?;
        Some(Collision { contact, law, restitution_curve, motions: [m1?, m2?], vehicles: [v1?, v2?] })
    }

    fn subject(&mut self, i: usize) -> Option<Subject> {
        let vehicle = &self.file.case.vehicles[i];
        let contact = vehicle.contact.as_ref().map(ContactPoint::forward_left);
        if vehicle.fixed {
            return Some(Subject { inertia: None, contact, damage: None });
        }
        let inertia = self.inertia(i, vehicle);
        let damage = match &vehicle.crush {
            Some(crush) => Some(self.damage(i, crush)?),
            None => None,
        };
        Some(Subject { inertia: Some(inertia?), contact, damage })
    }

    fn inertia(&mut self, i: usize, vehicle: &Vehicle) -> Option<Inertia> {
        let table = format!("vehicle{}", i + 1);
        let mass = vehicle.mass.as_ref().map(crate::Mass::kg);
        let mass =
            self.given(mass, &format!("{table}.weight"), "`weight = \"3696 lb\"` or `mass = \"1676 kg\"`");
        let yaw = self.given(
            vehicle.yaw.as_ref(),
            &format!("{table}.yaw_inertia"),
            "`yaw_inertia = \"2437 lb ft s^2\"`, or the radius of gyration: `yaw_radius = \"1.40 m\"`",
        );
        let (mass, yaw) = (mass?, yaw?);
        Some(Inertia { mass, yaw_inertia: yaw.kg_m2(mass) })
    }

    fn participant(&mut self, i: usize) -> Option<Participant> {
        let table = format!("vehicle{}", i + 1);
        let vehicle = &self.file.case.vehicles[i];
        let heading = vehicle.heading.as_ref().map(Quantity::si);
        let contact = vehicle.contact.as_ref().map(ContactPoint::forward_left);
        if vehicle.fixed {
            // Heading and contact point of a fixed object are optional; they only help to orient the crush plane's normal.
            return match contact {
                Some([forward, left]) => {
                    let placed = Participant::new(Body::fixed(), heading.unwrap_or_default(), forward, left);
                    self.accepted(&format!("{table}.contact"), placed)
                }
                None => Some(Participant::barrier()),
            };
        }
        let inertia = vehicle.mass.as_ref().zip(vehicle.yaw.as_ref());
        let heading = self.given(heading, &format!("{table}.heading"), "`heading = \"180 deg\"`");
        let contact = self.given(
            contact,
            &format!("{table}.contact"),
            "`contact = { distance = \"6.3 ft\", angle = \"-22.4 deg\" }` or `contact = { x = \"1.78 m\", y = \"-0.73 m\" }`",
        );
        let (mass, yaw) = inertia?;
        let ([forward, left], heading) = (contact?, heading?);
        let body = self.accepted(&table, Body::new(mass.kg(), yaw.kg_m2(mass.kg())))?;
        self.accepted(&table, Participant::new(body, heading, forward, left))
    }

    fn motion(&mut self, i: usize, unknown: Option<Unknown>) -> Option<Motion> {
        let table = format!("vehicle{}", i + 1);
        let vehicle = &self.file.case.vehicles[i];
        if vehicle.fixed {
            return Some(Motion::rest());
        }
        let yaw_rate = vehicle.yaw_rate.as_ref().map_or(0.0, Quantity::si);
        if unknown.is_some_and(|unknown| unknown.index() == i) {
            return Some(Motion::rest().with_yaw_rate(yaw_rate));
        }
        let Some(velocity) = &vehicle.motion else {
            let example = "`speed = \"10 mph\"` along the heading, or `velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" }`";
            self.missing(&format!("{table}.speed"), example);
            return None;
        };
        let motion = match velocity {
            Velocity::Speed(speed) => Motion::along(vehicle.heading.as_ref()?.si(), speed.si()),
            Velocity::Vector { x, y } => Motion { velocity: Vector2::new(x.si(), y.si()), yaw_rate: 0.0 },
        };
        Some(motion.with_yaw_rate(yaw_rate))
    }

    fn law(&mut self) -> Option<(Law, Option<RestitutionCurve>)> {
        let Some(impact) = &self.file.case.impact else {
            self.missing("impact", "a table [impact] with crush_plane, restitution and tangential");
            return None;
        };
        let curve = match impact.law.restitution().and_then(Restitution::points) {
            Some(points) => Some(self.accepted("impact.restitution", RestitutionCurve::new(points))?),
            None => None,
        };
        let e = |restitution: &Restitution| match restitution {
            Restitution::Constant(e) => *e,
            Restitution::OfClosingSpeed { values, .. } => values.first().copied().unwrap_or_default(),
        };
        let law = match &impact.law {
            ImpactLaw::Brach { restitution, tangential, moment_restitution } => {
                Law::new(e(restitution), *tangential).and_then(|law| match moment_restitution {
                    Some(e_m) => law.with_moment_restitution(*e_m),
                    None => Ok(law),
                })
            }
            ImpactLaw::Woolley { tangential_velocity_change: None } => Ok(Law::woolley()),
            ImpactLaw::Woolley { tangential_velocity_change: Some(change) } => {
                Law::woolley_sideswipe(change.si())
            }
            ImpactLaw::Ishikawa { restitution, tangential_restitution } => {
                Law::ishikawa(e(restitution), *tangential_restitution)
            }
            ImpactLaw::KudlichSlibar { restitution, friction } => {
                Law::kudlich_slibar(e(restitution), *friction)
            }
        };
        Some((self.accepted("impact", law)?, curve))
    }

    fn contact(&mut self, participants: [Participant; 2]) -> Option<Contact> {
        let crush_plane = self.file.case.impact.as_ref()?.crush_plane.si();
        self.accepted("impact.crush_plane", Contact::new(participants, crush_plane))
    }

    fn damage(&mut self, i: usize, crush: &Crush) -> Option<Damage> {
        let path = |key: &str| format!("vehicle{}.crush.{key}", i + 1);
        let depths = crush.depths.iter().map(Quantity::si).collect();
        let profile = match (&crush.spacing, &crush.width) {
            (Some(spacing), _) => Profile::new(depths, spacing.iter().map(Quantity::si).collect()),
            (None, Some(width)) => Profile::equally_spaced(depths, width.si()),
            (None, None) => {
                self.missing(&path("width"), "`width = \"65 in\"` or `spacing`");
                return None;
            }
        };
        let stiffness = match &crush.stiffness {
            StiffnessForm::Crush { a, b, g: None } => Stiffness::from_ab(a.si(), b.si()),
            StiffnessForm::Crush { a, b, g: Some(g) } => Stiffness::from_abg(a.si(), b.si(), g.si()),
            StiffnessForm::Root { d0, d1, g: None } => Stiffness::from_d0_d1(d0.si(), d1.si()),
            StiffnessForm::Root { d0, d1, g: Some(g) } => Stiffness::from_d0_d1_g(d0.si(), d1.si(), g.si()),
        };
        let profile = self.accepted(&path("depths"), profile);
        let stiffness = self.accepted(&path("stiffness"), stiffness);
        Some(Damage {
            side: crush.side,
            profile: profile?,
            stiffness: stiffness?,
            correction: crush.oblique.unwrap_or_default(),
            pdof: crush.pdof.as_ref().map(|pdof| wrapped(pdof.si())),
            oblique_angle: crush.oblique_angle.as_ref().map(Quantity::si),
            moment_arm: crush.moment_arm.as_ref().map(Quantity::si),
        })
    }

    /// `crush` has no impulse to take the direction of the force from.
    fn direction_of_force(&mut self, i: usize, vehicle: &Vehicle) {
        let table = format!("vehicle{}", i + 1);
        let Some(crush) = &vehicle.crush else {
            self.missing(&format!("{table}.crush"), CRUSH_EXAMPLE);
            return;
        };
        if crush.pdof.is_none() && (crush.oblique_angle.is_none() || crush.moment_arm.is_none()) {
            self.missing(
                &format!("{table}.crush.pdof"),
                "the direction from which the force came, clockwise from the heading: `pdof = \"2.7 deg\"`, or else `oblique_angle` and `moment_arm`",
            );
        } else if crush.moment_arm.is_none() && vehicle.contact.is_none() {
            self.missing(
                &format!("{table}.crush.moment_arm"),
                "the distance of the force's line of action from the CG: `moment_arm = \"2.1 ft\"`, or else the vehicle's `contact` point",
            );
        }
    }
}
