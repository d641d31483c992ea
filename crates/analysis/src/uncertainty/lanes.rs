//! A block of samples of a reconstruction or an impact at once.
//!
//! The collisions of all samples are posed in [columns](crate::columns). Under the most common laws the speed
//! has a closed form, which is evaluated for all samples at once. Under any other law, and for a sample
//! without such an answer, the samples are solved from these columns one after the other. That avoids
//! building a case for each sample, which is most of the cost of a single case.
//!
//! Cases that a block cannot handle are left to the single case: each [`Alone`], and samples of an impact
//! whose damage the engine refuses.

use ::uncertainty::dispatch;
use ::uncertainty::{Instructions, LANES, Lanes, SUCCEEDED};
use crash3::EnergyBasis;
use inputs::{Axes, Basis, BrachTangential, Case, DamageForm, Find, ImpactLaw, Reconstruct, Restitution};
use pim_core::{Law, Outcome, Tangential, VehicleId};
use reconcile::Problem;

use super::{Reason, as_beside};
use crate::columns::{Collisions, Columns, Number, uncertain_places};
use crate::found::refused;
use crate::goal::speed_and_impact;
use crate::output::Output;
use crate::quantities::{OUTPUTS, of_impact};

/// The reason why the samples of a case are solved one by one, each as a case of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Alone {
    /// It asks for both speeds, which follow from the momentum after the impact, and so from the paths to
    /// rest.
    BothSpeeds,
    /// It follows vehicles to rest or back: the path then costs far more than the case.
    Ways,
    /// The damage of a vehicle is unknown, or follows from the other's.
    NoDamage,
    /// An input is missing, or a requested result is not one of an impact.
    Incomplete,
    /// The block does not read one of the numbers with a range, probably because no result depends on it.
    Unread,
}

/// A case whose samples can be solved a block at a time.
#[derive(Debug)]
pub(super) struct Block {
    axes: Axes,
    collisions: Collisions,
    /// The unknown speed; `None` for an impact at given speeds.
    sought: Option<Sought>,
    /// The law, if the speed has a closed form.
    at_once: Option<AtOnce>,
    /// The place of each requested output among all outputs, and (SI) the central values of all, 0 for those
    /// that are not requested.
    places: Vec<usize>,
    central: [f64; OUTPUTS],
}

/// A law under which the speeds of all samples are found at once. Under other laws the samples are solved one
/// after the other, which takes twice as long; a loop for each law would multiply the compile time.
#[derive(Clone, Copy, Debug)]
struct AtOnce {
    restitution: Number,
    condition: Condition,
}

/// The condition of such a law along the crush plane.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// e_t: zero, U_t = 0, if the law requires a common tangential velocity.
    Restitution(Number),
    /// μ of a friction limit.
    Friction(Number),
}

/// A speed that the crush energy gives.
#[derive(Clone, Copy, Debug)]
struct Sought {
    unknown: VehicleId,
    basis: EnergyBasis,
    /// λ, if the crush absorbs a share of the tangential work.
    share: Option<Number>,
    /// (m/s) the speed at the central values, if it is not that with the slowest approach.
    chosen: Option<f64>,
}

impl Block {
    /// The block of a case with this number of `uncertain` numbers. `chosen` is the speed (m/s) at the
    /// central values, if it is not that with the slowest approach.
    ///
    /// # Errors
    /// [`Alone`] if the case is left to [`Sample`](super::Sample).
    pub(super) fn new(
        case: Case<Number>,
        uncertain: usize,
        outputs: &[Output],
        central: &[f64],
        chosen: Option<f64>,
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
                chosen,
            }),
        };
        // A block does not compute the outputs of vehicles that are followed to rest.
        if VehicleId::ALL.into_iter().any(|id| case.can_follow(id)) {
            return Err(Alone::Ways);
        }
        let seeks = sought.map(|sought| sought.unknown);
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
            DamageForm::Undamaged
            | DamageForm::OfObject(_)
            | DamageForm::Ees(_)
            | DamageForm::Measured(_) => false,
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

    /// Solves a block. Returns whether each sample is settled, with an answer or with a reason why it has
    /// none.
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

    /// The number of these samples that have more than one speed for their crush energy.
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

    /// Whether each sample is settled, and the reasons of those without an answer. A separate function for
    /// each condition and instruction set, because a single one would multiply the compile time.
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
        Sought { unknown, basis, .. }: Sought,
        columns: &Columns,
        outputs: &mut [Lanes],
    ) -> ([bool; LANES], [u8; LANES]) {
        // On the stack of this function, so that the compiler knows that the columns do not overlap.
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

    /// Solves the samples that are not `settled` one after the other.
    ///
    /// Compiled once: a copy for each instruction set gains nothing.
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

    /// The speed of a sample, NaN if none is unknown, and its impact.
    ///
    /// # Errors
    /// The reason why there is none; `None` if only the single case can find it.
    fn solve(
        &self,
        columns: &Columns,
        inputs: &[Lanes],
        lane: usize,
    ) -> Result<(f64, Outcome), Option<Reason>> {
        if let Some(sought) = self.sought {
            let problem = self.problem(columns, sought, inputs, lane).map_err(Some)?;
            return speed_and_impact(&problem, sought.chosen)
                .map_err(|why| Some(Reason::of(&refused(&problem, why))));
        }
        let Some((contact, law, motions)) = self.collisions.collision(columns, inputs, lane) else {
            return Err(Some(self.fault(inputs, lane)));
        };
        // A refused damage has no energy. An impact at given speeds does not use the energy.
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
        Sought { unknown, basis, share, .. }: Sought,
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

    /// The reason why the engine refuses the inputs of a sample.
    #[cold]
    fn fault(&self, inputs: &[Lanes], lane: usize) -> Reason {
        Reason::of_structures(self.collisions.refused_stiffnesses(inputs, lane))
    }
}

impl AtOnce {
    /// `None` for a curve of restitution, a moment impulse, a share of the tangential work, or a choice
    /// between speeds.
    fn new(sought: &Sought, law: &ImpactLaw<Number>) -> Option<Self> {
        let zero = Number::Known(0.0);
        if sought.share.is_some() || sought.chosen.is_some() {
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
