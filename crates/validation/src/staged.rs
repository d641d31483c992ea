//! One staged collision, run: the impact at the true speeds, and CRASH3 in the direction of its impulse.

use analysis::{Analysis, Impact};
use case::CaseFile;
use crash3::{CrushError, EnergyBasis, Profile, Side, SideStiffness, StruckVehicle};
use evidence::{CrushNumbers, DamagedSide};
use pim_core::{Law, Tangential, VehicleId};
use real::principal_angle;
use reconcile::Problem;

use crate::Data;
use crate::error::ValidationError;
use crate::published::{Collision, FOOT_POUND, speeds};

/// A collision with all data for the tables. SI units.
#[derive(Debug)]
pub(crate) struct Staged {
    pub(crate) printed: Collision,
    /// The impact at the true speeds, and the damage.
    analysis: Analysis,
    /// (m/s) true speed of vehicle 1.
    pub(crate) true_speed: f64,
    /// (m/s) the speed found by `reconstruct`.
    pub(crate) found: f64,
    /// (J) crush energies of both vehicles from the published profiles and CRASH3's stiffness.
    pub(crate) from_profiles: [f64; 2],
    /// (J) crush energies of both vehicles that the paper's own numbers imply.
    pub(crate) implied: [f64; 2],
}

/// The data of a vehicle for CRASH3.
#[derive(Clone, Copy)]
struct Struck {
    mass: f64,
    yaw_inertia: f64,
    contact: [f64; 2],
    side: Side,
    correction: crash3::ObliqueCorrection,
    crush_energy: f64,
    pdof: f64,
}

impl Staged {
    pub(crate) fn run(data: &Data, printed: &Collision) -> Result<Self, ValidationError> {
        let test = printed.test;
        let text = data.cases.iter().find(|(number, _)| *number == test).map(|(_, text)| *text);
        let Some(text) = text else {
            let known: Vec<String> = data.cases.iter().map(|(number, _)| number.to_string()).collect();
            return Err(ValidationError::NoCase { test, known: known.join(", ") });
        };
        let file = CaseFile::parse(&format!("fixtures/ricsac/{test:02}.toml"), text)?;
        let analysis = analysis::impact(&file.case)?;
        let mut staged = Self {
            printed: printed.clone(),
            true_speed: 0.0,
            found: reconstructed(&file, test)?,
            from_profiles: [0.0; 2],
            implied: [0.0; 2],
            analysis,
        };
        [staged.true_speed, _] = staged.true_speeds()?;
        staged.from_profiles = staged.struck()?.map(|vehicle| vehicle.crush_energy);
        staged.implied = staged.implied_energies()?;
        Ok(staged)
    }

    fn incomplete(&self, what: &'static str) -> ValidationError {
        ValidationError::Incomplete { test: self.printed.test, what }
    }

    fn crushed(&self) -> impl Fn(CrushError) -> ValidationError {
        let test = self.printed.test;
        move |source| ValidationError::of_test(test, source)
    }

    /// The impact at the true speeds.
    pub(crate) fn collision(&self) -> Result<&Impact, ValidationError> {
        self.analysis.impact.as_ref().ok_or_else(|| self.incomplete("impact"))
    }

    /// (m/s) true speeds along the headings.
    pub(crate) fn true_speeds(&self) -> Result<[f64; 2], ValidationError> {
        let outcome = &self.collision()?.outcome;
        Ok([0, 1].map(|i| outcome.before[i].velocity.dot(&outcome.forward[i])))
    }

    /// Where each vehicle was hit.
    pub(crate) fn hit(&self) -> Result<[DamagedSide; 2], ValidationError> {
        Ok(self.struck()?.each_ref().map(|vehicle| vehicle.side.into()))
    }

    /// The crush of both vehicles from their profiles and the stiffness of the case.
    pub(crate) fn crushes(&self) -> Result<[CrushNumbers; 2], ValidationError> {
        let crush = |i: usize| {
            let damage = self.analysis.vehicles[i].damage.as_ref().ok_or_else(|| self.incomplete("crush"))?;
            let SideStiffness::Uniform(stiffness) = &damage.structure else {
                return Err(self.incomplete("one stiffness of a side"));
            };
            let sums =
                Profile::equally_spaced(damage.depths.clone(), damage.width).map_err(self.crushed())?.sums();
            // E = G L + A S₁ + B S₂
            Ok(CrushNumbers {
                constant: stiffness.g() * sums.width,
                linear: stiffness.a() * sums.area,
                square: stiffness.b() * sums.second_moment,
                slope: 1.0.into(),
                no_damage_speed: 1.0.into(),
            })
        };
        Ok([crush(0)?, crush(1)?])
    }

    fn struck(&self) -> Result<[Struck; 2], ValidationError> {
        let pdof = self.collision()?.outcome.pdof();
        let vehicle = |i: usize| {
            let vehicle = &self.analysis.vehicles[i];
            let subject = &vehicle.subject;
            let inertia = subject.inertia.ok_or_else(|| self.incomplete("mass"))?;
            let given = subject.damage.as_ref().ok_or_else(|| self.incomplete("crush"))?;
            let damage = vehicle.damage.as_ref().ok_or_else(|| self.incomplete("crush"))?;
            Ok::<_, ValidationError>(Struck {
                mass: inertia.mass,
                yaw_inertia: inertia.yaw_inertia.ok_or_else(|| self.incomplete("yaw inertia"))?,
                contact: subject.contact.ok_or_else(|| self.incomplete("contact point"))?,
                side: given.side,
                correction: given.correction,
                crush_energy: damage.crush_energy,
                pdof: pdof[i],
            })
        };
        Ok([vehicle(0)?, vehicle(1)?])
    }

    /// (m/s) CRASH3's velocity changes for the crush energies (J) of both vehicles, with the direction of the
    /// impulse turned counter-clockwise by `turn` (rad), uncorrected and corrected for oblique force.
    pub(crate) fn crash3(&self, energies: [f64; 2], turn: f64) -> Result<Crash3, ValidationError> {
        let vehicles = self.struck()?;
        let mut inertias = [StruckVehicle::fixed(); 2];
        let mut corrected = 0.0;
        for ((vehicle, inertia), energy) in vehicles.iter().zip(&mut inertias).zip(energies) {
            // A PDOF counts clockwise.
            let pdof = principal_angle(vehicle.pdof - turn);
            let arm = crash3::moment_arm(vehicle.contact, pdof);
            *inertia = StruckVehicle::new(vehicle.mass, vehicle.yaw_inertia, arm).map_err(self.crushed())?;
            let angle = vehicle.side.oblique_angle(pdof);
            // E' = Σ E_i (1 + tan²α_i)
            corrected += energy * vehicle.correction.factor(angle).map_err(self.crushed())?.factor;
        }
        let [e1, e2] = energies;
        Ok(Crash3 {
            uncorrected: crash3::delta_v(e1 + e2, inertias).map_err(self.crushed())?,
            corrected: crash3::delta_v(corrected, inertias).map_err(self.crushed())?,
        })
    }

    /// (m/s) velocity changes from the work of the normal impulse alone, by CRASH3's equations: the paper's
    /// "crush ΔV".
    pub(crate) fn crush_delta_v(&self) -> Result<[f64; 2], ValidationError> {
        let normal_work = self.collision()?.outcome.energy.normal_work;
        Ok(self.crash3([normal_work, 0.0], 0.0)?.uncorrected)
    }

    /// (J) crush energies that the paper's own numbers imply: of each vehicle if Table 3 has the test; else
    /// of both together from the uncorrected row of Table 2, divided in the ratio of the profiles.
    fn implied_energies(&self) -> Result<[f64; 2], ValidationError> {
        if let Some(table3) = &self.printed.table3 {
            return Ok(table3.implied_energies.map(|energy| energy * FOOT_POUND));
        }
        let [e1, e2] = self.from_profiles;
        let known = e1 + e2;
        let ours = self.crash3(self.from_profiles, 0.0)?.uncorrected;
        let printed = speeds(self.printed.table2.crash_uncorrected);
        // ΔV ∝ √E, so that E = E₀ (ΔV/ΔV₀)²; the mean of what the two vehicles imply
        let implied = |i: usize| known * (printed[i] / ours[i]) * (printed[i] / ours[i]);
        let total = (implied(0) + implied(1)) / 2.0;
        Ok([e1 / known * total, e2 / known * total])
    }

    /// (m/s) the speed of vehicle 1 for which the normal impulse takes this energy (J), under the law of the
    /// case or another.
    pub(crate) fn speed(&self, crush_energy: f64, law: Option<Law>) -> Result<f64, ValidationError> {
        self.speed_with_share(crush_energy, law, 0.0)
    }

    /// (m/s) the same if the crush energy includes a share λ of the tangential work.
    pub(crate) fn speed_with_share(
        &self,
        crush_energy: f64,
        law: Option<Law>,
        tangential_share: f64,
    ) -> Result<f64, ValidationError> {
        let impact = self.collision()?;
        let law = law.unwrap_or(impact.law);
        let problem = Problem {
            contact: impact.contact,
            law: law.into(),
            motions: impact.outcome.before,
            unknown: VehicleId::One,
            crush_energy,
            basis: EnergyBasis::Dissipated,
            tangential_share,
        };
        problem
            .solve()
            .map(|answer| answer.speed)
            .map_err(|source| ValidationError::Reconcile { test: self.printed.test, source })
    }

    /// The law of the case with μ = μ_c, and with the given restitution if there is one.
    pub(crate) fn critical(&self, restitution: Option<f64>) -> Result<Law, ValidationError> {
        let restitution = restitution.unwrap_or(self.collision()?.law.restitution());
        Ok(Law::new(restitution, Tangential::Critical)?)
    }
}

/// (m/s) CRASH3's velocity changes of vehicle 1 and vehicle 2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crash3 {
    pub(crate) uncorrected: [f64; 2],
    pub(crate) corrected: [f64; 2],
}

/// (m/s) the answer of `deltav reconstruct`.
fn reconstructed(file: &CaseFile, test: u8) -> Result<f64, ValidationError> {
    let found = analysis::reconstruct(&file.case)?.found;
    found.map(|found| found.speed).ok_or(ValidationError::Incomplete { test, what: "speed to find" })
}
