//! A block of samples of a reconstruction or an impact at once.
//!
//! The collisions of all samples are posed in [columns](crate::columns). Under the commonest laws the speed
//! has a closed form, which is found for all samples at once. Under any other law, and where a sample has no
//! such answer, the samples are solved from these columns one after the other. That saves what costs a
//! single case most, which is the case itself.
//!
//! What a block cannot say is left to the single case: each [`Alone`], and of an impact a sample whose damage
//! the engine refuses.

use ::uncertainty::dispatch;
use ::uncertainty::{Instructions, LANES, Lanes, SUCCEEDED};
use crash3::EnergyBasis;
use inputs::{
    Axes, Basis, BrachTangential, Case, DamageForm, Find, GivenVehicle, ImpactLaw, Reconstruct, Restitution,
};
use pim_core::{Law, Outcome, Tangential, VehicleId};
use reconcile::{Problem, Unknown};

use super::{Reason, as_beside};
use crate::columns::{Collisions, Columns, Number, uncertain_places};
use crate::found::refused;
use crate::output::Output;
use crate::quantities::{OUTPUTS, of_impact};

/// Why the samples of a case are solved one by one, each as a case of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Alone {
    /// It asks for both speeds, which are found from the momentum: that comes from the ways to rest.
    BothSpeeds,
    /// It follows vehicles to rest or back: what a sample costs then is its way, not its case.
    Ways,
    /// The damage of a vehicle is not known, or follows from the other's.
    NoDamage,
    /// What a case has to give is missing, or a result is asked for that an impact does not have.
    Incomplete,
    /// A range of a number that it does not read: one that no result depends on and that is not known to be
    /// idle.
    Unread,
}

/// A case of which a block of samples can be solved at once.
#[derive(Debug)]
pub(super) struct Block {
    axes: Axes,
    collisions: Collisions,
    /// What is sought, if not the impact at the speeds that are given.
    sought: Option<Sought>,
    /// Where the speed has a closed form.
    at_once: Option<AtOnce>,
    /// The place of each output among all that there are, and (SI) the central values of these, 0 where one
    /// is not wanted.
    places: Vec<usize>,
    central: [f64; OUTPUTS],
}

/// A law under which a speed is found for all samples at once. The others are solved one sample after the
/// other, which takes twice as long: a loop for each would take a compiler many times as long.
#[derive(Clone, Copy, Debug)]
struct AtOnce {
    restitution: Number,
    condition: Condition,
}

/// What such a law asks for along the crush plane.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// e_t: zero, U_t = 0, where the law asks for a common tangential velocity.
    Restitution(Number),
    /// μ of a friction limit.
    Friction(Number),
}

/// A speed that the crush energy gives.
#[derive(Clone, Copy, Debug)]
struct Sought {
    unknown: Unknown,
    basis: EnergyBasis,
    /// λ, where the crush takes a share of the tangential work.
    share: Option<Number>,
}

impl Block {
    /// Why the case is left to [`Sample`](super::Sample), if it is: where it has another shape, or where one
    /// of its `uncertain` numbers, so many, is none that a block reads.
    pub(super) fn new(
        case: Case<Number>,
        uncertain: usize,
        outputs: &[Output],
        central: &[f64],
    ) -> Result<Self, Alone> {
        let sought = match &case.reconstruct {
            None => None,
            Some(Reconstruct { find: Find::Both, .. }) => return Err(Alone::BothSpeeds),
            Some(_) if case.is_by_momentum() => return Err(Alone::BothSpeeds),
            Some(Reconstruct { find: Find::One(unknown), energy_basis }) => Some(Sought {
                unknown: *unknown,
                basis: energy_basis.energy(),
                share: match energy_basis {
                    Basis::Dissipated | Basis::Absorbed => None,
                    Basis::TangentialShare(share) => Some(*share),
                },
            }),
        };
        // Vehicles that are followed to rest have outputs that a block does not compute.
        let has_drag =
            |vehicle: &GivenVehicle<Number>| vehicle.after.as_ref().is_some_and(|after| after.drag.is_some());
        if case.surface.is_some() && case.vehicles.iter().any(has_drag) {
            return Err(Alone::Ways);
        }
        let seeks = sought.map(|sought| sought.unknown.vehicle());
        let axes = case.axes;
        let all = Output::of_two_vehicles(seeks.unwrap_or(VehicleId::One));
        let place = |wanted: &Output| all.iter().position(|output| output == wanted);
        let places = outputs.iter().map(place).collect::<Option<Vec<usize>>>().ok_or(Alone::Incomplete)?;
        let mut of_all = [0.0; OUTPUTS];
        for (place, central) in places.iter().zip(central) {
            of_all[*place] = *central;
        }
        let sought_ones = VehicleId::ALL.map(|id| seeks == Some(id));
        let collisions = Collisions::new(case, sought_ones);
        let form = collisions.form().ok_or(Alone::Incomplete)?;
        let is_unknown = |damage: &DamageForm<'_, Number>| match damage {
            DamageForm::Unknown => seeks.is_some(),
            DamageForm::Inferred(_) => true,
            DamageForm::Undamaged | DamageForm::Ees(_) | DamageForm::Measured(_) => false,
        };
        if form.vehicles.iter().any(|vehicle| is_unknown(&vehicle.damage)) {
            return Err(Alone::NoDamage);
        }
        if uncertain_places(form.numbers()) != uncertain {
            return Err(Alone::Unread);
        }
        let is_ahead = form.vehicles.iter().all(|vehicle| vehicle.course.is_none());
        let at_once = sought.filter(|_| is_ahead).and_then(|sought| AtOnce::new(&sought, form.law));
        Ok(Self { axes, collisions, sought, at_once, places, central: of_all })
    }

    /// Solves a block, and tells of each sample whether it is settled: that is its answer, or it has none for
    /// the reason that is noted.
    #[inline(always)]
    pub(super) fn evaluate(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
    ) -> [bool; LANES] {
        let mut columns = Columns::NOTHING;
        self.collisions.pose(inputs, &mut columns);
        let mut settled = [false; LANES];
        if let (Some(law), Some(sought)) = (&self.at_once, self.sought) {
            let e = law.restitution.lanes(inputs);
            let found = match law.condition {
                Condition::Restitution(number) => {
                    let numbers = [&e, &number.lanes(inputs)];
                    self.at_once(instructions, (Tangential::Restitution, numbers), sought, &columns, outputs)
                }
                Condition::Friction(number) => {
                    let numbers = [&e, &number.lanes(inputs)];
                    self.at_once(instructions, (Tangential::Friction, numbers), sought, &columns, outputs)
                }
            };
            (settled, *reasons) = found;
        }
        if settled != [true; LANES] {
            self.in_turn(&columns, inputs, outputs, reasons, &mut settled);
        }
        settled
    }

    /// How many of these samples of a block have more than one speed that gives their crush energy.
    #[inline(never)]
    pub(super) fn several_speeds(
        &self,
        instructions: Instructions,
        inputs: &[Lanes],
        lanes: impl Iterator<Item = usize>,
    ) -> usize {
        let Some(sought) = self.sought else { return 0 };
        let mut columns = Columns::NOTHING;
        dispatch!(instructions, self.collisions.pose(inputs, &mut columns));
        let has_several = |lane: &usize| {
            let problem = self.problem(&columns, sought, inputs, *lane);
            problem.is_ok_and(|problem| problem.has_several_speeds())
        };
        lanes.filter(has_several).count()
    }

    /// Which samples are settled, and why those have no answer that have none. A function of its own for each
    /// condition and instruction set: all in one would take a compiler many times as long.
    #[inline(never)]
    fn at_once(
        &self,
        instructions: Instructions,
        law: (impl Fn(f64) -> Tangential, [&Lanes; 2]),
        sought: Sought,
        columns: &Columns,
        outputs: &mut [Lanes],
    ) -> ([bool; LANES], [u8; LANES]) {
        dispatch!(instructions, self.at_once_with(law, sought, columns, outputs))
    }

    #[inline(always)]
    fn at_once_with(
        &self,
        (condition, [e, numbers]): (impl Fn(f64) -> Tangential, [&Lanes; 2]),
        Sought { unknown, basis, share: _ }: Sought,
        columns: &Columns,
        outputs: &mut [Lanes],
    ) -> ([bool; LANES], [u8; LANES]) {
        // On the stack of this function, so that the compiler knows that no column is part of another.
        let mut values = [Lanes::ZERO; OUTPUTS];
        let (mut settled, mut reasons) = ([false; LANES], [SUCCEEDED; LANES]);
        for lane in 0..LANES {
            let (law, is_law) = Law::new_with_validity(e[lane], condition(numbers[lane]));
            let (contact, motions, is_contact) = columns.contact(lane);
            let crush_energy = columns.crush_energy(lane);
            let law = law.into();
            let problem =
                Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share: 0.0 };
            let (speed, outcome, [is_answer, pulls]) = problem.solve_with_verdict();
            let is_taken = is_law & is_contact & !crush_energy.is_nan();
            settled[lane] = is_taken & (is_answer | pulls);
            reasons[lane] = if is_answer | !pulls { SUCCEEDED } else { Reason::Pulling.code() };
            for (column, value) in values.iter_mut().zip(answer(self.axes, &self.central, speed, &outcome)) {
                column[lane] = value;
            }
        }
        for (output, place) in outputs.iter_mut().zip(&self.places) {
            if let Some(column) = values.get(*place) {
                *output = *column;
            }
        }
        (settled, reasons)
    }

    /// Solves those samples that are not `settled` one after the other.
    ///
    /// Compiled once: it gains nothing from a copy for each instruction set.
    #[inline(never)]
    fn in_turn(
        &self,
        columns: &Columns,
        inputs: &[Lanes],
        outputs: &mut [Lanes],
        reasons: &mut [u8; LANES],
        settled: &mut [bool; LANES],
    ) {
        let unsettled = settled.iter_mut().zip(reasons).enumerate().filter(|(_, (settled, _))| !**settled);
        for (lane, (is_settled, reason)) in unsettled {
            match self.solve(columns, inputs, lane) {
                Ok((speed, outcome)) => {
                    let values = answer(self.axes, &self.central, speed, &outcome);
                    for (output, place) in outputs.iter_mut().zip(&self.places) {
                        if let Some(value) = values.get(*place) {
                            output[lane] = *value;
                        }
                    }
                    *is_settled = true;
                }
                Err(Some(refusal)) => {
                    *reason = refusal.code();
                    *is_settled = true;
                }
                Err(None) => {}
            }
        }
    }

    /// The speed of a sample, not a number where none is asked for, and its impact.
    ///
    /// # Errors
    /// Why there is none; `None` where the single case has to tell.
    fn solve(
        &self,
        columns: &Columns,
        inputs: &[Lanes],
        lane: usize,
    ) -> Result<(f64, Outcome), Option<Reason>> {
        if let Some(sought) = self.sought {
            let problem = self.problem(columns, sought, inputs, lane).map_err(Some)?;
            return problem.speed_and_impact().map_err(|why| Some(Reason::of(&refused(&problem, why))));
        }
        let Some((contact, law, motions)) = self.collisions.collision(columns, inputs, lane) else {
            return Err(Some(self.fault(inputs, lane)));
        };
        // A damage of which the engine refuses something has no energy. Of one whose energy is known an
        // impact asks nothing.
        if columns.crush_energy(lane).is_nan() {
            return Err(None);
        }
        let law = law.at(-contact.approach(&motions).velocity.normal);
        match contact.impact(motions, &law) {
            Ok(outcome) => Ok((f64::NAN, outcome)),
            Err(why) => Err(Some(Reason::of_impact(&why))),
        }
    }

    /// The equation for the speed of a sample.
    #[inline(always)]
    fn problem(
        &self,
        columns: &Columns,
        Sought { unknown, basis, share }: Sought,
        inputs: &[Lanes],
        lane: usize,
    ) -> Result<Problem, Reason> {
        let crush_energy = columns.crush_energy(lane);
        if crush_energy.is_nan() {
            return Err(self.fault(inputs, lane));
        }
        let Some((contact, law, motions)) = self.collisions.collision(columns, inputs, lane) else {
            return Err(self.fault(inputs, lane));
        };
        let tangential_share = share.map_or(0.0, |share| share.at(inputs, lane));
        Ok(Problem { contact, law, motions, unknown, crush_energy, basis, tangential_share })
    }

    /// Why the engine refuses something of a sample while it takes it in.
    #[cold]
    fn fault(&self, inputs: &[Lanes], lane: usize) -> Reason {
        Reason::of_structures(self.collisions.refused_stiffnesses(inputs, lane))
    }
}

impl AtOnce {
    /// Of no curve of restitution, no moment impulse and no share of the tangential work.
    fn new(sought: &Sought, law: &ImpactLaw<Number>) -> Option<Self> {
        let zero = Number::Known(0.0);
        if sought.share.is_some() {
            return None;
        }
        let (restitution, condition) = match law {
            ImpactLaw::Brach {
                restitution: Restitution::Constant(e),
                tangential,
                moment_restitution: None,
            } => match tangential {
                BrachTangential::Critical => (*e, Condition::Restitution(zero)),
                BrachTangential::Friction(limit) => (*e, Condition::Friction(*limit)),
                BrachTangential::FractionOfCritical(_) | BrachTangential::Ratio(_) => return None,
            },
            ImpactLaw::Ishikawa { restitution: Restitution::Constant(e), tangential_restitution } => {
                (*e, Condition::Restitution(*tangential_restitution))
            }
            // A common velocity along the normal.
            ImpactLaw::Woolley { tangential_velocity_change: None } => (zero, Condition::Restitution(zero)),
            _ => return None,
        };
        Some(Self { restitution, condition })
    }
}

/// The outputs of a reconstruction of two vehicles, in the order of [`Output::of_two_vehicles`].
#[inline(always)]
fn answer(axes: Axes, central: &[f64; OUTPUTS], speed: f64, outcome: &Outcome) -> [f64; OUTPUTS] {
    let mut central = central.iter().copied();
    of_impact!(VehicleId::One, output => {
        as_beside(output, central.next().unwrap_or_default(), output.of_impact(axes, speed, outcome))
    })
}
