//! Turns a case into the types of the engines, and reports what each purpose needs and does not find.

mod motion;

use std::fmt::{self, Display};

use crash3::{
    CrushError, DamagedFace, EnergyMoments, ObliqueCorrection, Profile, Side, SideStiffness, Stiffness,
    VehicleClass,
};
use pim_core::{Body, Contact, Motion, Participant, Real, VaryingLaw, Vector2, VehicleId};
use reconcile::Unknown;

use crate::axes::Axes;
use crate::basis::Basis;
use crate::case::{Case, Find};
use crate::crush::{Crush, Fit, KnownEnergy, Pdof, StiffnessForm, StiffnessLine};
use crate::estimate::{FaceAxis, class_yaw_inertia, scaled};
use crate::fault::{Fault, FaultKind, Faults};
use crate::impact::Restitution;
use crate::inertia::Mass;
use crate::purpose::Purpose;
use crate::quantity::Quantity;
use crate::vehicle::{ContactPoint, GivenVehicle, Kind, Outline, Velocity};

/// Two vehicles that collide, as the mechanics need them.
#[derive(Clone, Debug)]
pub struct Collision<T = f64> {
    /// The geometry.
    pub contact: Contact<T>,
    /// The impact law.
    pub law: VaryingLaw<T>,
    /// Motions before impact. A vehicle whose speed is sought is at rest here but for its yaw rate.
    pub motions: [Motion<T>; 2],
    /// The data of each vehicle.
    pub vehicles: [VehicleData<T>; 2],
}

/// The data of one vehicle, as far as the case gives them.
#[derive(Clone, Debug)]
pub struct VehicleData<T = f64> {
    /// What it is, where the case says so.
    pub kind: Option<Kind>,
    /// Mass and yaw inertia, or `None` for a fixed object.
    pub inertia: Option<InertiaData<T>>,
    /// (m) contact point C forward and left of the CG.
    pub contact: Option<[T; 2]>,
    /// Whether that point was placed at the centroid of the damage, because the case gives none.
    pub contact_is_placed: bool,
    /// The body seen from above.
    pub dimensions: Option<Dimensions<T>>,
    /// The damage, where its crush was measured or is to be inferred.
    pub damage: Option<DamageData<T>>,
    /// The damage, where only its energy is known.
    pub energy: Option<EnergyData<T>>,
}

impl<T: Copy> VehicleData<T> {
    /// (rad) PDOF: as given, or opposite to the PDOF given for the other vehicle.
    #[must_use]
    pub fn pdof(&self) -> Option<T> {
        self.damage.as_ref().map(|damage| damage.pdof).or(self.energy.map(|energy| energy.pdof))?
    }

    /// Whether that PDOF was derived from that of the other vehicle, by Newton's third law.
    #[must_use]
    pub fn pdof_follows(&self) -> bool {
        let of_energy = self.energy.is_some_and(|energy| energy.pdof_follows);
        self.damage.as_ref().map_or(of_energy, |damage| damage.pdof_follows)
    }

    /// Whether the PDOF is known as the hour of a clock alone.
    #[must_use]
    pub fn pdof_is_hour(&self) -> bool {
        let of_energy = self.energy.is_some_and(|energy| energy.pdof_is_hour);
        self.damage.as_ref().map_or(of_energy, |damage| damage.pdof_is_hour)
    }
}

/// A damage of which only the energy is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyData<T = f64> {
    /// (m/s) energy equivalent speed; `None` without damage.
    pub ees: Option<T>,
    /// The damaged side, if the case gives it.
    pub side: Option<Side>,
    /// (rad) PDOF: as given, or opposite to the PDOF given for the other vehicle.
    pub pdof: Option<T>,
    /// Whether the PDOF was derived from that of the other vehicle, by Newton's third law.
    pub pdof_follows: bool,
    /// Whether the PDOF is known as the hour of a clock alone.
    pub pdof_is_hour: bool,
    /// (m) h as given.
    pub moment_arm: Option<T>,
}

/// Mass and yaw inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaData<T = f64> {
    /// (kg) mass.
    pub mass: T,
    /// (kg·m²) yaw inertia; only the damage of a vehicle alone does without.
    pub yaw_inertia: Option<T>,
    /// Where the yaw inertia comes from.
    pub yaw_source: YawSource,
}

/// Where a yaw inertia comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum YawSource {
    /// The case gives it, or the radius of gyration.
    Given,
    /// The radius of gyration of CRASH3's size class.
    Class(u8),
    /// Burg's estimate from wheelbase and length.
    Burg,
    /// It is not known.
    Unknown,
}

/// The body seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions<T = f64> {
    /// (m) length of the body.
    pub length: T,
    /// (m) width of the body.
    pub width: T,
    /// (m) from the CG forward to the front of the body.
    pub cg_to_front: T,
    /// CRASH3's size class, if the dimensions come from it.
    pub class: Option<u8>,
}

impl<T: Real> Dimensions<T> {
    /// Those of a size class.
    #[must_use]
    pub fn of_class(class: u8, known: &VehicleClass) -> Self {
        Self {
            length: T::from(known.length),
            width: T::from(known.width),
            cg_to_front: T::from(known.cg_to_front),
            class: Some(class),
        }
    }

    /// (m) distance of a side's face from the CG.
    #[must_use]
    pub fn face(&self, side: Side) -> T {
        match side {
            Side::Front => self.cg_to_front,
            Side::Rear => self.length - self.cg_to_front,
            Side::Left | Side::Right => self.width / 2.0,
        }
    }

    /// (m) length of a side's face.
    #[must_use]
    pub fn extent(&self, side: Side) -> T {
        match side {
            Side::Front | Side::Rear => self.width,
            Side::Left | Side::Right => self.length,
        }
    }
}

/// The damage, and what the case says about the force that caused it.
#[derive(Clone, Debug)]
pub struct DamageData<T = f64> {
    /// The damaged side.
    pub side: Side,
    /// How the crush is known.
    pub evidence: Evidence<T>,
    /// Where its stiffness comes from.
    pub stiffness_source: StiffnessSource,
    /// The damaged face and the place of the damage on it, where the dimensions of the vehicle are known.
    pub face: Option<DamagedFace<T>>,
    /// (m) offset of the middle of the damage: to the left of the axis on front and rear, forward of the CG
    /// on the sides. `None` if the case does not give it; it is then taken as zero.
    pub offset: Option<T>,
    /// How oblique forces are corrected.
    pub correction: ObliqueCorrection<T>,
    /// (rad) PDOF: as given, or opposite to the PDOF given for the other vehicle.
    pub pdof: Option<T>,
    /// Whether the PDOF was derived from that of the other vehicle, by Newton's third law.
    pub pdof_follows: bool,
    /// Whether it is an hour of the clock, the given one or that of the other vehicle: each is 30° wide.
    pub pdof_is_hour: bool,
    /// (rad) α as given.
    pub oblique_angle: Option<T>,
    /// (m) h as given.
    pub moment_arm: Option<T>,
}

/// How a crush is known.
#[derive(Clone, Debug)]
pub enum Evidence<T = f64> {
    /// It was measured.
    Measured {
        /// Depths along the side.
        profile: Profile<T>,
        /// What the side resisted with.
        structure: SideStiffness<T>,
    },
    /// It is to be inferred from the force on the other vehicle.
    ForceBalance {
        /// What the side resisted with.
        stiffness: Stiffness<T>,
        /// The width of the damage.
        width: InferredWidth<T>,
    },
}

/// The width of a damage that was not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InferredWidth<T = f64> {
    /// (m) width known from another source, for example from photographs.
    Given(T),
    /// Not known: only the vehicle's dimensions bound it.
    Bounded {
        /// (m) length of the side.
        widest: T,
        /// (m) from the face to the CG.
        deepest: T,
    },
}

/// Where a stiffness comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessSource {
    /// A and B as given.
    Coefficients,
    /// d_0 and d_1 as given.
    Roots,
    /// A category of CRASH3's table for the damaged side.
    Category(u8),
    /// Fitted to a barrier test.
    Test(Fit),
    /// Coefficients as given, zone by zone.
    Zones,
}

/// The input of a reconstruction.
#[derive(Clone, Debug)]
pub struct ReconstructionInput<T = f64> {
    /// The collision, in which one speed is unknown.
    pub collision: Collision<T>,
    /// The unknown speed.
    pub unknown: Unknown,
    /// The energy basis.
    pub basis: Basis<T>,
}

/// The input of an impact calculation.
#[derive(Clone, Debug)]
pub struct ImpactInput<T = f64> {
    /// The collision, in which both speeds are known.
    pub collision: Collision<T>,
    /// The energy basis, for the CRASH3 result.
    pub basis: Basis<T>,
}

/// The input of a CRASH3 analysis from the damage alone.
#[derive(Clone, Debug)]
pub struct CrushOnly<T = f64> {
    /// Both vehicles. The damage of each one that can move has a PDOF, or both an oblique angle and a moment
    /// arm, unless it is the only vehicle of the case.
    pub vehicles: [VehicleData<T>; 2],
    /// The energy basis.
    pub basis: Basis,
    /// e, if it does not depend on the closing speed; 0 for Woolley's law.
    pub restitution: Option<T>,
}

impl<T: Real> Case<T> {
    /// Everything that a reconstruction needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn reconstruction(&self) -> Result<ReconstructionInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Reconstruct);
        let unknown = demand.unknown();
        let collision = demand.collision(|id| unknown.is_some_and(|unknown| unknown.vehicle() != id));
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.vehicles) {
            if !vehicle.fixed && !vehicle.is_absent() && !vehicle.has_damage_data() {
                demand.missing_crush(id);
            }
        }
        if self.vehicles.iter().filter_map(|v| v.crush.as_ref()).any(|crush| crush.from_force_balance) {
            // The crush energy has to be known before the impact is, and so has the direction of the force.
            demand.directions_for_balance();
        }
        let input = collision.zip(unknown).map(|(collision, unknown)| ReconstructionInput {
            collision,
            unknown,
            basis: self.energy_basis(),
        });
        demand.finish(input)
    }

    /// Everything that an impact calculation needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn collision(&self) -> Result<ImpactInput<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Impact);
        let collision = demand.collision(|_| true);
        demand.finish(collision.map(|collision| ImpactInput { collision, basis: self.energy_basis() }))
    }

    /// The vehicles as they stand at the impact, at rest but for their yaw rates, whatever is known of their
    /// speeds: what a picture of them needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn geometry(&self) -> Result<Collision<T>, Faults> {
        let mut demand = Demand::new(self, Purpose::Draw);
        let collision = demand.collision(|_| false);
        demand.finish(collision)
    }

    fn energy_basis(&self) -> Basis<T> {
        self.reconstruct.as_ref().map_or(Basis::Dissipated, |reconstruct| reconstruct.energy_basis)
    }
}

impl Case {
    /// Everything that an analysis of the damage alone needs.
    ///
    /// # Errors
    /// Every value that is missing or contradicts another, each with its key.
    pub fn damage(&self) -> Result<CrushOnly, Faults> {
        let mut demand = Demand::new(self, Purpose::Crush);
        let vehicles = VehicleId::ALL.map(|id| demand.subject(id));
        // The energy of one vehicle alone needs no direction.
        let alone = self.vehicles.iter().any(GivenVehicle::is_absent);
        for (id, vehicle) in VehicleId::ALL.into_iter().zip(&self.vehicles) {
            if vehicle.fixed || vehicle.is_absent() {
                continue;
            }
            if !alone {
                demand.direction_of_force(id, vehicle);
            } else if !vehicle.has_damage_data() {
                demand.missing_crush(id);
            }
        }
        let [v1, v2] = vehicles;
        demand.finish(v1.zip(v2).map(|(v1, v2)| {
            let mut vehicles = [v1, v2];
            fill_opposite_pdof(self.headings(), vehicles.each_mut().map(Some));
            CrushOnly {
                vehicles,
                basis: self.energy_basis(),
                restitution: self.impact.as_ref().and_then(|impact| match impact.law.restitution() {
                    Some(Restitution::Constant(e)) => Some(*e),
                    Some(Restitution::OfClosingSpeed { .. }) => None,
                    // Woolley: U_n = 0
                    None => Some(0.0),
                }),
            }
        }))
    }

    /// (m) where the contact point of the impact lies, in the axes of the engine, by each source that the
    /// case has for it: as given for the scene, and as the CG of each vehicle and its arm put it.
    #[must_use]
    pub fn contact_places(&self) -> [Option<Vector2<f64>>; 3] {
        let mut demand = Demand::new(self, self.furthest_purpose());
        let given = self.scene_contact.as_ref().map(|place| demand.place(place));
        let [one, two] = VehicleId::ALL.map(|id| demand.contact_from(id));
        [given, one, two]
    }

    /// (m) where the contact point of the impact lies, in the axes of the engine: as given for the scene, or
    /// half-way between the points where both vehicles put it, or where one of them does.
    #[must_use]
    pub fn contact_place(&self) -> Option<Vector2<f64>> {
        let [given, one, two] = self.contact_places();
        let between = one.zip(two).map(|(one, two)| (one + two) * 0.5);
        given.or(between).or(one).or(two)
    }

    /// The purpose that takes this case furthest: to find a speed if it asks for one, to solve the impact if
    /// it gives both speeds, else to assess the damage alone.
    #[must_use]
    pub fn furthest_purpose(&self) -> Purpose {
        if self.reconstruct.is_some() {
            Purpose::Reconstruct
        } else if self.impact.is_some() && self.vehicles.iter().all(|v| v.fixed || v.motion.is_some()) {
            Purpose::Impact
        } else {
            Purpose::Crush
        }
    }

    /// The data of each vehicle for the [furthest purpose](Self::furthest_purpose), regardless of what that
    /// would need; `None` for a vehicle whose data are incomplete. If one PDOF and both headings are given,
    /// the other PDOF follows.
    #[must_use]
    pub fn subjects(&self) -> [Option<VehicleData>; 2] {
        let mut demand = Demand::new(self, self.furthest_purpose());
        let mut subjects = VehicleId::ALL.map(|id| demand.subject(id));
        fill_opposite_pdof(self.headings(), subjects.each_mut().map(Option::as_mut));
        subjects
    }
}

/// Contradictions between the vehicles of a case and the speed to find, which no purpose allows.
#[must_use]
pub fn contradictions<T>(vehicles: &[GivenVehicle<T>; 2], find: Option<Find>) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut contradiction = |key: &str, reason: String, advice: String| {
        let kind = FaultKind::Refused { reason };
        faults.push(Fault { key: key.to_owned(), kind, advice: Some(advice) });
    };
    let fixed = VehicleId::ALL
        .into_iter()
        .find(|id| vehicles[id.index()].fixed && find.is_some_and(|find| find.seeks(*id)));
    if vehicles.iter().all(|vehicle| vehicle.fixed) {
        contradiction(
            "vehicle2.fixed",
            "both vehicles are fixed, so nothing can collide".to_owned(),
            "remove fixed = true from the one that can move".to_owned(),
        );
    } else if let Some(id) = fixed {
        contradiction(
            "reconstruct.find",
            format!("\"reconstruct.find\" asks for the speed of [{}], which is fixed", table(id)),
            format!("write find = \"{}.speed\"", table(id.other())),
        );
    }
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(vehicles) {
        let Some(kind) = vehicle.kind.filter(|kind| *kind != Kind::Car) else { continue };
        let (table, kind) = (table(id), kind.name());
        if vehicle.class.is_some() {
            contradiction(
                &format!("{table}.class"),
                format!("CRASH3's size classes are of passenger cars, but [{table}] has kind = \"{kind}\""),
                "remove `class`, and give yaw_inertia or yaw_radius, and length, width and cg_to_front"
                    .to_owned(),
            );
        }
        if vehicle.crush.as_ref().is_some_and(|crush| matches!(crush.stiffness, StiffnessForm::Category(_))) {
            contradiction(
                &format!("{table}.crush.stiffness.category"),
                format!(
                    "CRASH3's stiffness categories are of passenger cars, but [{table}] has kind = \"{kind}\""
                ),
                "give A and B of its structure, or a test".to_owned(),
            );
        }
    }
    let inferred =
        |id: VehicleId| vehicles[id.index()].crush.as_ref().is_some_and(|crush| crush.from_force_balance);
    if VehicleId::ALL.into_iter().all(inferred) {
        contradiction(
            "vehicle2.crush.from_force_balance",
            "both vehicles take their crush from the force balance, so neither crush was measured".to_owned(),
            "give the width and depths of the inspected vehicle, and remove its from_force_balance"
                .to_owned(),
        );
    } else if let Some(id) =
        VehicleId::ALL.into_iter().find(|id| inferred(*id) && vehicles[id.other().index()].crush.is_none())
    {
        let [vehicle, other] = [table(id), table(id.other())];
        contradiction(
            &format!("{vehicle}.crush.from_force_balance"),
            format!(
                "[{vehicle}.crush] takes its crush from the force balance, but [{other}] has no measured crush"
            ),
            format!("add [{other}.crush] with side, width, depths and stiffness"),
        );
    }
    faults
}

/// Where one PDOF and both headings are given, the other PDOF follows by Newton's third law.
fn fill_opposite_pdof<T: Real>(headings: [Option<T>; 2], vehicles: [Option<&mut VehicleData<T>>; 2]) {
    let [Some(h1), Some(h2)] = headings else { return };
    let given = vehicles.each_ref().map(|vehicle| {
        let vehicle = vehicle.as_ref()?;
        Some((vehicle.pdof()?, vehicle.pdof_is_hour()))
    });
    let follows = [
        given[1].map(|(pdof, is_hour)| (crash3::opposite_pdof(pdof, [h2, h1]), is_hour)),
        given[0].map(|(pdof, is_hour)| (crash3::opposite_pdof(pdof, [h1, h2]), is_hour)),
    ];
    for (vehicle, follows) in vehicles.into_iter().zip(follows) {
        let Some(vehicle) = vehicle.filter(|vehicle| vehicle.pdof().is_none()) else { continue };
        let Some((pdof, is_hour)) = follows else { continue };
        if let Some(damage) = &mut vehicle.damage {
            (damage.pdof, damage.pdof_follows, damage.pdof_is_hour) = (Some(pdof), true, is_hour);
        }
        if let Some(energy) = &mut vehicle.energy {
            (energy.pdof, energy.pdof_follows, energy.pdof_is_hour) = (Some(pdof), true, is_hour);
        }
    }
}

const SPEED_FORMS: &str =
    "`speed = \"10 mph\"` along the heading, or `velocity = { x = \"-75 ft/s\", y = \"0 ft/s\" }`";

/// What finds a speed without any damage.
const WITHOUT_DAMAGE: &str = "; without damage data momentum gives the speed, from how the vehicles left the impact: leave `crush` out of both, and in [vehicle1.after] and \
                              [vehicle2.after] give `speed` and `direction`, or `rest` with `drag`";

/// The table of a vehicle.
fn table(id: VehicleId) -> &'static str {
    match id {
        VehicleId::One => "vehicle1",
        VehicleId::Two => "vehicle2",
    }
}

/// A key in the crush table of a vehicle, formatted only if it has a fault, because an uncertain case is
/// turned into the types of the engine a million times.
struct InCrush(VehicleId, &'static str);

impl Display for InCrush {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.crush.{}", table(self.0), self.1)
    }
}

/// Collects what a purpose needs, and every fault that prevents it.
struct Demand<'a, T> {
    case: &'a Case<T>,
    purpose: Purpose,
    /// Whether nothing turns, so that no yaw inertia and no contact point is needed.
    is_of_point_masses: bool,
    faults: Vec<Fault>,
}

impl<'a, T: Real> Demand<'a, T> {
    fn new(case: &'a Case<T>, purpose: Purpose) -> Self {
        let find = case.reconstruct.as_ref().map(|reconstruct| reconstruct.find);
        let faults = contradictions(&case.vehicles, find);
        Self { case, purpose, is_of_point_masses: false, faults }
    }

    /// Reports a missing key; `example` says what to give, with the lines that set it.
    fn missing(&mut self, key: impl Display, example: &str) {
        self.faults.push(Fault {
            key: key.to_string(),
            kind: FaultKind::Missing { needed_for: self.purpose },
            advice: Some(format!("give {example}")),
        });
    }

    fn missing_crush(&mut self, id: VehicleId) {
        let other = self.case.vehicles[id.other().index()].crush.as_ref();
        let inferred = if other.is_some_and(|crush| !crush.from_force_balance) {
            "; for a vehicle that could not be inspected, give side, stiffness and `from_force_balance = true`: its crush then follows from \
             the force on the other vehicle"
        } else {
            ""
        };
        let example = format!(
            "a table with side, width, depths and stiffness{inferred}; or `ees = \"45 km/h\"` alone, if the energy equivalent speed is known; or \
             `crush = \"none\"` in [{}], if the other vehicle alone was damaged{}",
            table(id),
            if self.purpose == Purpose::Reconstruct { WITHOUT_DAMAGE } else { "" }
        );
        self.missing(format_args!("{}.crush", table(id)), &example);
    }

    fn given<V: Copy>(&mut self, value: Option<V>, key: impl Display, example: &str) -> Option<V> {
        if value.is_none() {
            self.missing(key, example);
        }
        value
    }

    /// Turns the engine's refusal into a fault of the key that caused it.
    fn accepted<V>(&mut self, key: impl Display, result: Result<V, impl Display>) -> Option<V> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let kind = FaultKind::Refused { reason: error.to_string() };
                self.faults.push(Fault { key: key.to_string(), kind, advice: None });
                None
            }
        }
    }

    fn finish<V>(mut self, value: Option<V>) -> Result<V, Faults> {
        // Impact and motion may lack the same.
        let mut told: Vec<(String, FaultKind)> = Vec::new();
        self.faults.retain(|fault| {
            let is_new = !told.iter().any(|(key, kind)| *key == fault.key && *kind == fault.kind);
            if is_new {
                told.push((fault.key.clone(), fault.kind.clone()));
            }
            is_new
        });
        Faults::none_of(self.faults)?;
        // A missing value has been reported above, so there is one here.
        value.ok_or_else(|| {
            let reason = "the case cannot be analysed".to_owned();
            Fault { key: String::new(), kind: FaultKind::Refused { reason }, advice: None }.into()
        })
    }

    /// The SI value of a lateral or rotational quantity, in the axes of the engine.
    fn lateral(&self, quantity: &Quantity<T>) -> T {
        self.case.axes.lateral(quantity.si())
    }

    /// (m) C forward and left of the CG.
    fn contact_point(&self, vehicle: &GivenVehicle<T>) -> Option<[T; 2]> {
        let contact = vehicle.contact.as_ref().map(ContactPoint::xy);
        contact.map(|[x, y]| [x, self.case.axes.lateral(y)])
    }

    /// (m) C forward and left of the CG, at the centroid of a damage of which the case tells where it lies.
    fn placed_contact(
        &mut self,
        id: VehicleId,
        damage: &DamageData<T>,
        dimensions: Dimensions<T>,
    ) -> Option<[T; 2]> {
        let (Evidence::Measured { profile, structure }, Some(offset)) = (&damage.evidence, damage.offset)
        else {
            return None;
        };
        let moved = |axis| self.case.departures.of_contact(id, axis);
        let along = along_face(self.case.axes, damage.side, moved(FaceAxis::Along));
        let moved = [along, moved(FaceAxis::Inward)];
        let point = EnergyMoments::of(profile, structure)
            .and_then(|moments| placed_contact(damage.side, &dimensions, offset, moved, &moments));
        self.accepted(format_args!("{}.contact", table(id)), point)
    }

    /// Reports that a vehicle has no contact point, and what the program would place it by.
    fn missing_contact(&mut self, id: VehicleId) {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        let mut lacking = Vec::new();
        if let Some(crush) = vehicle.crush.as_ref().filter(|crush| !crush.from_force_balance) {
            if crush.width.is_none() && crush.spacing.is_none() {
                lacking.push("the `width` of the damage".to_owned());
            }
            if crush.offset.is_none() {
                let from = match crush.side {
                    Side::Front | Side::Rear => "from the vehicle's axis",
                    Side::Left | Side::Right => "forward of the centre of gravity",
                };
                lacking.push(format!(
                    "`offset = \"12 in\"` in [{table}.crush], the middle of the damage {from}"
                ));
            }
            if !vehicle.has_outline() {
                lacking.push("`length`, `width` and `cg_to_front`, or `class`".to_owned());
            }
        }
        let instead = match lacking.as_slice() {
            [] => String::new(),
            list => format!(
                "; where C is not known, give in its place {}: C is then placed at the centroid of the damage",
                list.join(", and ")
            ),
        };
        self.missing(
            format_args!("{table}.contact"),
            &format!(
                "`contact = {{ distance = \"6.3 ft\", angle = \"-22.4 deg\" }}` or `contact = {{ x = \"1.78 m\", y = \"-0.73 m\" }}`{instead}"
            ),
        );
    }

    fn unknown(&mut self) -> Option<Unknown> {
        if let Some(reconstruct) = &self.case.reconstruct {
            let unknown = reconstruct.find.unknown();
            if unknown.is_none() {
                let reason = "`reconstruct.find` asks for both speeds, where one is to be found";
                self.faults.push(Fault {
                    key: "reconstruct.find".to_owned(),
                    kind: FaultKind::Refused { reason: reason.to_owned() },
                    advice: Some(
                        "write find = \"vehicle1.speed\" and give the speed of vehicle 2".to_owned(),
                    ),
                });
            }
            return unknown;
        }
        // Of one vehicle alone nothing can be found.
        if self.case.vehicles.iter().any(GivenVehicle::is_absent) {
            return None;
        }
        // A moving vehicle without a speed is the one whose speed is to be found.
        let is_open = self.case.vehicles.each_ref().map(|vehicle| !vehicle.fixed && vehicle.motion.is_none());
        let found = if is_open == [false, true] { "vehicle2.speed" } else { "vehicle1.speed" };
        self.missing(
            "reconstruct.find",
            &format!("`find = \"{found}\"`, the speed to find, in a table [reconstruct]"),
        );
        if is_open == [true, true] {
            let advice = Some(format!("give one vehicle {SPEED_FORMS}"));
            self.faults.push(Fault { key: String::new(), kind: FaultKind::NoSpeed, advice });
        }
        None
    }

    /// Whether the case has both vehicles; reports the missing one.
    fn both_tables(&mut self) -> bool {
        let absent = VehicleId::ALL.into_iter().find(|id| self.case.vehicles[id.index()].is_absent());
        if let Some(id) = absent {
            let advice =
                "a table of its own for each vehicle; `fixed = true` in it is a barrier, a wall or a pole";
            self.missing(table(id), advice);
        }
        absent.is_none()
    }

    /// The collision; `needs_speed` says whether a vehicle must have a speed.
    fn collision(&mut self, needs_speed: impl Fn(VehicleId) -> bool) -> Option<Collision<T>> {
        if !self.both_tables() {
            return None;
        }
        let vehicles = VehicleId::ALL.map(|id| self.subject(id));
        let participants = VehicleId::ALL.map(|id| self.participant(id, vehicles[id.index()].as_ref()));
        let motions = VehicleId::ALL.map(|id| self.motion(id, needs_speed(id)));
        let law = self.law();
        self.skids();
        let ([v1, v2], [p1, p2], [m1, m2]) = (vehicles, participants, motions);
        let contact = self.contact([p1?, p2?])?;
        let law = law?;
        let mut vehicles = [v1?, v2?];
        fill_opposite_pdof(self.case.headings(), vehicles.each_mut().map(Some));
        Some(Collision { contact, law, motions: [m1?, m2?], vehicles })
    }

    fn subject(&mut self, id: VehicleId) -> Option<VehicleData<T>> {
        let vehicle = &self.case.vehicles[id.index()];
        let mut contact = self.contact_point(vehicle);
        let class = self.class(id, vehicle);
        let dimensions = dimensions(vehicle, class);
        if vehicle.fixed || vehicle.is_absent() {
            return Some(VehicleData {
                kind: None,
                inertia: None,
                contact,
                contact_is_placed: false,
                dimensions,
                damage: None,
                energy: None,
            });
        }
        let inertia = self.inertia(id, vehicle, class);
        let damage = match &vehicle.crush {
            Some(crush) => Some(self.damage(id, crush, dimensions)?),
            None => None,
        };
        let energy = vehicle.energy.map(|known| {
            let given = known.ees();
            EnergyData {
                ees: given.map(|given| given.ees.si()),
                side: given.and_then(|given| given.side),
                pdof: given.and_then(|given| given.pdof).map(|pdof| crash3::principal_angle(pdof.rad())),
                pdof_follows: false,
                pdof_is_hour: given.is_some_and(|given| matches!(given.pdof, Some(Pdof::Clock(_)))),
                moment_arm: given.and_then(|given| given.moment_arm).map(|arm| arm.si()),
            }
        });
        // The damage alone needs no point: its force acts through the centroid unless the case gives the arm.
        let needs_contact = self.purpose != Purpose::Crush && !self.is_of_point_masses;
        let contact_is_placed = vehicle.places_contact() && needs_contact;
        if let (true, Some(damage), Some(dimensions)) = (contact_is_placed, &damage, dimensions) {
            contact = Some(self.placed_contact(id, damage, dimensions)?);
        }
        Some(VehicleData {
            kind: vehicle.kind,
            inertia: Some(inertia?),
            contact,
            contact_is_placed,
            dimensions,
            damage,
            energy,
        })
    }

    fn class(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) -> Option<(u8, VehicleClass)> {
        let class = vehicle.class?;
        self.accepted(format_args!("{}.class", table(id)), VehicleClass::new(class))
            .map(|known| (class, known))
    }

    /// A given inertia takes precedence over the class, and the class over Burg's estimate.
    fn inertia(
        &mut self,
        id: VehicleId,
        vehicle: &GivenVehicle<T>,
        class: Option<(u8, VehicleClass)>,
    ) -> Option<InertiaData<T>> {
        let table = table(id);
        let mass = vehicle.mass.as_ref().map(Mass::kg);
        let mass = self.given(
            mass,
            format_args!("{table}.weight"),
            "`weight = \"3696 lb\"` or `mass = \"1676 kg\"`",
        );
        let length = vehicle.outline.map(|outline| outline.length).or(vehicle.length);
        let factor = self.case.departures.yaw_radius[id.index()].unwrap_or(T::ONE);
        if let Some(yaw) = &vehicle.yaw {
            let mass = mass?;
            let yaw_inertia = Some(yaw.kg_m2(mass));
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Given });
        }
        if let Some((class, known)) = class {
            let mass = mass?;
            let yaw_inertia = Some(class_yaw_inertia(&known, mass, factor));
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Class(class) });
        }
        let is_car = vehicle.kind.unwrap_or_default() == Kind::Car;
        if let Some((wheelbase, length)) = vehicle.wheelbase.zip(length).filter(|_| is_car) {
            let mass = mass?;
            let estimate = crash3::yaw_inertia_burg(mass, wheelbase.si(), length.si());
            // I = m k²
            let estimate = self.accepted(format_args!("{table}.wheelbase"), estimate)?;
            let yaw_inertia = Some(estimate * factor * factor);
            return Some(InertiaData { mass, yaw_inertia, yaw_source: YawSource::Burg });
        }
        if self.case.vehicles[id.other().index()].is_absent() || self.is_of_point_masses {
            return Some(InertiaData { mass: mass?, yaw_inertia: None, yaw_source: YawSource::Unknown });
        }
        if !is_car {
            self.missing(
                format_args!("{table}.yaw_inertia"),
                "`yaw_inertia = \"2437 lb ft s^2\"` or the radius of gyration, `yaw_radius = \"1.40 m\"`; if neither is known, √((l² + w²)/12) is \
                 the radius of gyration of a body of length l and width w that is loaded evenly",
            );
            return None;
        }
        self.missing(
            format_args!("{table}.yaw_inertia"),
            "`yaw_inertia = \"2437 lb ft s^2\"` or the radius of gyration, `yaw_radius = \"1.40 m\"`; if neither is known, give \
             CRASH3's size class, `class = 3`, or both `wheelbase` and `length`",
        );
        None
    }

    fn participant(&mut self, id: VehicleId, data: Option<&VehicleData<T>>) -> Option<Participant<T>> {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        let heading = self.case.headings()[id.index()];
        let contact = data.map_or_else(|| self.contact_point(vehicle), |data| data.contact);
        if vehicle.fixed {
            // The heading and the contact point of a fixed object are optional: they only help to orient the
            // normal of the crush plane.
            return match contact {
                Some([forward, left]) => {
                    let placed = Participant::new(Body::fixed(), heading.unwrap_or(T::ZERO), forward, left);
                    self.accepted(format_args!("{table}.contact"), placed)
                }
                None => Some(Participant::barrier()),
            };
        }
        let heading = self.given(heading, format_args!("{table}.heading"), "`heading = \"180 deg\"`");
        if contact.is_none() && !vehicle.places_contact() {
            self.missing_contact(id);
        }
        let InertiaData { mass, yaw_inertia, .. } = data?.inertia?;
        let ([forward, left], heading) = (contact?, heading?);
        let body = self.accepted(table, Body::new(mass, yaw_inertia?))?;
        let participant = self.accepted(table, Participant::new(body, heading, forward, left))?;
        match self.case.course(id) {
            Some(course) => self.accepted(format_args!("{table}.sideslip"), participant.with_course(course)),
            None => Some(participant),
        }
    }

    fn motion(&mut self, id: VehicleId, needs_speed: bool) -> Option<Motion<T>> {
        let table = table(id);
        let vehicle = &self.case.vehicles[id.index()];
        if vehicle.fixed {
            return Some(Motion::rest());
        }
        let yaw_rate = vehicle.yaw_rate.as_ref().map_or(T::ZERO, |rate| self.lateral(rate));
        if !needs_speed {
            return Some(Motion::rest().with_yaw_rate(yaw_rate));
        }
        let Some(velocity) = &vehicle.motion else {
            self.missing(format_args!("{table}.speed"), SPEED_FORMS);
            return None;
        };
        let motion = match velocity {
            Velocity::Speed(speed) => {
                let course = self.case.course(id).or(self.case.headings()[id.index()])?;
                Motion::along(course, speed.si())
            }
            Velocity::Vector { x, y } => {
                Motion { velocity: Vector2::new(x.si(), self.lateral(y)), yaw_rate: T::ZERO }
            }
        };
        Some(motion.with_yaw_rate(yaw_rate))
    }

    fn law(&mut self) -> Option<VaryingLaw<T>> {
        let Some(impact) = &self.case.impact else {
            self.missing("impact", "a table [impact] with crush_plane, restitution and tangential");
            return None;
        };
        match impact.law.of_engine(self.case.axes) {
            Ok(law) => Some(law),
            Err((key, refusal)) => self.accepted(key, Err(refusal)),
        }
    }

    fn contact(&mut self, participants: [Participant<T>; 2]) -> Option<Contact<T>> {
        let axes = self.case.axes;
        let crush_plane = self.lateral(&self.case.impact.as_ref()?.crush_plane);
        let contact = Contact::new(participants, crush_plane);
        let contact = contact.map_err(|refused| match axes {
            Axes::ZUp => refused,
            Axes::ZDown => refused.mirrored(),
        });
        self.accepted("impact.crush_plane", contact)
    }

    fn damage(
        &mut self,
        id: VehicleId,
        crush: &Crush<T>,
        dimensions: Option<Dimensions<T>>,
    ) -> Option<DamageData<T>> {
        let path = |key| InCrush(id, key);
        let structure = crush.stiffness.structure(crush.side);
        let structure = match self.case.departures.stiffness[id.index()] {
            Some(factor) => structure.and_then(|structure| scaled(structure, factor)),
            None => structure,
        };
        let structure = self.accepted(path("stiffness"), structure);
        let evidence = if crush.from_force_balance {
            let width = self.inferred_width(id, crush, dimensions)?;
            match structure? {
                SideStiffness::Uniform(stiffness) => Evidence::ForceBalance { stiffness, width },
                SideStiffness::Zones(_) => {
                    let reason =
                        "zones lie between stations, but a crush from the force balance has no stations";
                    return self.accepted(path("stiffness.zones"), Err(reason));
                }
            }
        } else {
            let profile = self.profile(id, crush);
            Evidence::Measured { profile: profile?, structure: structure? }
        };
        let offset = crush.offset.as_ref().map(|offset| along_face(self.case.axes, crush.side, offset.si()));
        let face = match dimensions {
            Some(dimensions) => {
                let face =
                    DamagedFace::new(crush.side, dimensions.face(crush.side), offset.unwrap_or(T::ZERO));
                Some(self.accepted(format_args!("{}.cg_to_front", table(id)), face)?)
            }
            None => None,
        };
        Some(DamageData {
            side: crush.side,
            evidence,
            stiffness_source: match &crush.stiffness {
                StiffnessForm::Line(StiffnessLine::Crush { .. }) => StiffnessSource::Coefficients,
                StiffnessForm::Line(StiffnessLine::Root { .. }) => StiffnessSource::Roots,
                StiffnessForm::Category(category) => StiffnessSource::Category(*category),
                StiffnessForm::Test(test) => StiffnessSource::Test(test.fit),
                StiffnessForm::Zones(_) => StiffnessSource::Zones,
            },
            face,
            offset,
            correction: crush.oblique.unwrap_or_default(),
            pdof: crush.pdof.as_ref().map(|pdof| crash3::principal_angle(pdof.rad())),
            pdof_follows: false,
            pdof_is_hour: matches!(crush.pdof, Some(Pdof::Clock(_))),
            oblique_angle: crush.oblique_angle.as_ref().map(Quantity::si),
            moment_arm: crush.moment_arm.as_ref().map(Quantity::si),
        })
    }

    fn profile(&mut self, id: VehicleId, crush: &Crush<T>) -> Option<Profile<T>> {
        let path = |key| InCrush(id, key);
        let depths = crush.depths.iter().map(Quantity::si).collect();
        let profile = match (&crush.spacing, &crush.width) {
            (Some(spacing), _) => Profile::new(depths, spacing.iter().map(Quantity::si).collect()),
            (None, Some(width)) => Profile::equally_spaced(depths, width.si()),
            (None, None) => {
                self.missing(path("width"), "`width = \"65 in\"` or `spacing`");
                return None;
            }
        };
        self.accepted(path("depths"), profile)
    }

    fn inferred_width(
        &mut self,
        id: VehicleId,
        crush: &Crush<T>,
        dimensions: Option<Dimensions<T>>,
    ) -> Option<InferredWidth<T>> {
        if let Some(width) = &crush.width {
            return Some(InferredWidth::Given(width.si()));
        }
        let Some(dimensions) = dimensions else {
            self.missing(
                format_args!("{}.crush.width", table(id)),
                "the width of the damage, which the force does not determine; or, to bound it, the vehicle's `length`, `width` and \
                 `cg_to_front`, or its `class`",
            );
            return None;
        };
        Some(InferredWidth::Bounded {
            widest: dimensions.extent(crush.side),
            deepest: dimensions.face(crush.side),
        })
    }

    /// Whether the case gives the PDOF of a vehicle, or the other vehicle's PDOF and both headings.
    fn has_pdof(&self, id: VehicleId) -> bool {
        let given = |id: VehicleId| {
            let vehicle = &self.case.vehicles[id.index()];
            let of_ees = vehicle.energy.as_ref().and_then(KnownEnergy::ees).and_then(|given| given.pdof);
            vehicle.crush.as_ref().and_then(|crush| crush.pdof).or(of_ees).is_some()
        };
        given(id) || (given(id.other()) && self.case.headings().iter().all(Option::is_some))
    }

    /// A force balance between two crushes needs the angle at which the force meets each.
    fn directions_for_balance(&mut self) {
        for id in VehicleId::ALL {
            let has_angle = self.case.vehicles[id.index()]
                .crush
                .as_ref()
                .is_some_and(|crush| crush.oblique_angle.is_some());
            if !has_angle && !self.has_pdof(id) {
                self.missing(
                    format_args!("{}.crush.pdof", table(id)),
                    "the direction of the force, which the force balance needs: `pdof` of one vehicle, from which the other's follows, or \
                     `oblique_angle` of both",
                );
            }
        }
    }

    /// `crush` has no impulse to take the direction of the force from.
    fn direction_of_force(&mut self, id: VehicleId, vehicle: &GivenVehicle<T>) {
        let table = table(id);
        let of_ees = vehicle.energy.as_ref().map(|known| known.ees().and_then(|given| given.moment_arm));
        let of_crush = vehicle.crush.as_ref().map(|crush| (crush.oblique_angle.is_some(), crush.moment_arm));
        // The energy of an EES is not corrected for an oblique force, so it takes no angle.
        let Some((has_angle, moment_arm)) = of_crush.or(of_ees.map(|moment_arm| (true, moment_arm))) else {
            self.missing_crush(id);
            return;
        };
        if !self.has_pdof(id) && (!has_angle || moment_arm.is_none()) {
            self.missing(
                format_args!("{table}.crush.pdof"),
                &format!(
                    "the direction from which the force came, clockwise from the heading: `pdof = \"2.7 deg\"` or `pdof = \"2 o'clock\"`; the \
                     other vehicle's `pdof` is enough if both have a `heading`; or give {}",
                    if vehicle.energy.is_some() { "`moment_arm`" } else { "both `oblique_angle` and `moment_arm`" }
                ),
            );
        } else if moment_arm.is_none() && vehicle.contact.is_none() && vehicle.energy.is_some() {
            self.missing(
                format_args!("{table}.contact"),
                "the point where the force acts: `contact = { x = \"1.78 m\", y = \"-0.73 m\" }`; or, in a table crush with `ees`, the distance of \
                 its line of action from the CG, `moment_arm = \"2.1 ft\"`",
            );
        } else if moment_arm.is_none() && vehicle.contact.is_none() && !vehicle.has_outline() {
            self.missing(
                format_args!("{table}.crush.moment_arm"),
                "the distance of the force's line of action from the CG: `moment_arm = \"2.1 ft\"`, or the vehicle's `contact` point; or, if \
                 the force acts through the centroid of the damage, `length`, `width` and `cg_to_front`, or `class`",
            );
        }
    }
}

/// (m) what counts along the face of a side, in the axes of the engine: to the left on front and rear,
/// forward on the sides, which is forward in any axes.
pub fn along_face<T: Real>(axes: Axes, side: Side, distance: T) -> T {
    match side {
        Side::Front | Side::Rear => axes.lateral(distance),
        Side::Left | Side::Right => distance,
    }
}

/// (m) the contact point, forward and left of the CG, that is placed at the centroid of a damage: its middle
/// lies at `offset` (m) [along the face](along_face), and it is `moved` as a whole along the face and inward,
/// which takes its centroid with it.
///
/// # Errors
/// Where the face then lies behind the CG, or a number is not finite.
pub fn placed_contact<T: Real>(
    side: Side,
    dimensions: &Dimensions<T>,
    offset: T,
    [along, inward]: [T; 2],
    moments: &EnergyMoments<T>,
) -> Result<[T; 2], CrushError> {
    let face = DamagedFace::new(side, dimensions.face(side) - inward, offset + along)?;
    Ok(face.centroid_of(moments))
}

fn dimensions<T: Real>(
    vehicle: &GivenVehicle<T>,
    class: Option<(u8, VehicleClass)>,
) -> Option<Dimensions<T>> {
    let given = vehicle.outline.as_ref().map(Outline::dimensions);
    given.or(class.map(|(class, known)| Dimensions::of_class(class, &known)))
}
