//! The impact of each particle, from the case with the particle's numbers.

use ::estimate::Independent;
use ::uncertainty::{LANES, Lanes};
use evidence::{CrushChange, Impacted, Impacts, LEAST_APPROACH, OtherCrush, Way};
use inputs::{
    Axes, Basis, Case, CollisionData, Dimension, MotionInput, Quantity, SharedEffects, SkidData, Velocity,
};
use pim_core::{Law, Outcome, Tangential, Vector2, VehicleId};
use real::elementary::sin_cos;
use trajectory::{Control, FrictionZone, Ground, Outset, State, to_rests};

use super::block::Block;
use super::posed::{OpenSpeeds, Posed};
use crate::columns::{Columns, Number, si};
use crate::damage::{assess, crush_energy};
use crate::evidence::{needed, works};
use crate::impact::speed_along;
use crate::output::Output;
use crate::travel::{Followed, skid_speed};
use crate::uncertainty::beside;

/// The value that a number of the case has in each particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slot {
    /// The same in every particle.
    Given,
    /// One of the unknown values, by its place.
    Value(usize),
    /// The number of the case times one of the unknown values.
    Factor(usize),
}

/// A case with some unknown numbers.
#[derive(Debug)]
pub(super) struct Varied {
    pub(super) case: Case,
    /// The value of each of its numbers in a particle.
    pub(super) slots: Vec<Slot>,
    /// The effects of errors that several numbers share.
    pub(super) shared: Option<SharedEffects>,
}

impl Varied {
    /// The case with the numbers of a particle.
    pub(super) fn of(&self, values: &[Lanes], lane: usize) -> Case {
        let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
        let mut slots = self.slots.iter();
        let mut vary = |central: f64| match slots.next() {
            None | Some(Slot::Given) => central,
            Some(Slot::Value(place)) => of(*place),
            Some(Slot::Factor(place)) => central * of(*place),
        };
        let Some(shared) = &self.shared else { return self.case.map_numbers(vary) };
        let mut numbers = Vec::with_capacity(self.slots.len());
        drop(self.case.map_numbers(|central| numbers.push(vary(central))));
        shared.apply(&mut numbers);
        let mut numbers = numbers.into_iter();
        self.case.map_numbers(|central| numbers.next().unwrap_or(central))
    }
}

/// The impacts of a case with unknown numbers, and the paths after them.
#[derive(Debug)]
pub(super) struct CaseImpacts {
    /// The case without its texts.
    pub(super) impact: Varied,
    /// The parts of the case that the motion after the impact needs; `None` if it needs all of them.
    pub(super) motion: Option<Varied>,
    pub(super) speeds: OpenSpeeds,
    /// The place of the largest impulse ratio, if the case does not give it.
    pub(super) friction: Option<usize>,
    /// The place of λ, if the case does not give it.
    pub(super) tangential_share: Option<usize>,
    /// The crush energy of the one vehicle whose crush is not known, with the place of its ratio.
    pub(super) other_crush: Option<OtherCrush<usize>>,
    /// The skid marks of each vehicle before the impact.
    pub(super) skids: [Option<SkidNumbers>; 2],
    /// The placeholder for an impact that does not happen.
    pub(super) placeholder: Outcome,
    /// Whether each vehicle is followed to rest.
    pub(super) followed: [bool; 2],
    /// The results that are computed for each draw.
    pub(super) outputs: Vec<Output>,
    pub(super) axes: Axes,
    /// (rad) PDOF of both vehicles if the force were normal to the crush plane: the PDOFs of all draws are
    /// within half a turn of them.
    pub(super) reference: [f64; 2],
    pub(super) unknown: Independent,
    /// The same for a block at once, if the form of the case allows that.
    pub(super) block: Option<Block>,
}

/// Skid marks before the impact.
#[derive(Clone, Copy, Debug)]
pub(super) struct SkidNumbers {
    /// `None` if the case gives the place where they begin, and its distance from the impact differs between
    /// particles.
    pub(super) length: Option<Quantity<Number>>,
    pub(super) friction: Number,
    /// The place of a factor on the friction.
    pub(super) factor: Option<usize>,
}

impl SkidNumbers {
    fn lanes(&self, values: &[Lanes]) -> [SkidData; LANES] {
        let (mut length, mut friction) = (Lanes::ZERO, self.friction.lanes(values));
        if let Some(given) = &self.length {
            si(*given, values, &mut length);
        }
        if let Some(place) = self.factor {
            for (friction, factor) in friction.iter_mut().zip(&Number::Uncertain(place).lanes(values)) {
                *friction *= factor;
            }
        }
        std::array::from_fn(|lane| SkidData { length: length[lane], friction: friction[lane] })
    }
}

impl Impacts for CaseImpacts {
    fn unknown(&self) -> &Independent {
        &self.unknown
    }

    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted> {
        self.impacts_of(values, &mut |_, _| [true; LANES])
    }

    fn impacts_as_wanted(
        &self,
        values: &[Lanes],
        wanted: &mut dyn FnMut(VehicleId, &[Impacted]) -> [bool; LANES],
    ) -> Option<Vec<Impacted>> {
        (self.followed != [false, false]).then(|| self.impacts_of(values, wanted))
    }

    fn outputs_count(&self) -> usize {
        self.outputs.len()
    }

    fn output(&self, place: usize, impacted: &Impacted) -> f64 {
        let output = self.outputs[place];
        let value = output.of_draw(self.axes, impacted);
        match output.vehicle() {
            Some(vehicle) if output.quantity().is_direction => beside(value, self.reference[vehicle.index()]),
            _ => value,
        }
    }
}

impl CaseImpacts {
    /// A particle without an impact.
    fn impossible(outcome: Outcome) -> Impacted {
        Impacted {
            speeds: [0.0; 2],
            outcome,
            taken: 0.0,
            crush_energies: [0.0; 2],
            crush_changes: [CrushChange::default(); 2],
            skid_speeds: [None, None],
            ways: [None, None],
            is_possible: false,
        }
    }

    /// Compiled once: turning a case into the types of the engine gains nothing from a copy for each
    /// instruction set.
    #[inline(never)]
    fn impacts_of(
        &self,
        values: &[Lanes],
        wanted: &mut dyn FnMut(VehicleId, &[Impacted]) -> [bool; LANES],
    ) -> Vec<Impacted> {
        let mut columns = Columns::NOTHING;
        let block = self.block.as_ref().inspect(|block| block.pose(values, &mut columns));
        let marks = self.marks(values);
        let has_places = self.skids.iter().flatten().any(|skid| skid.length.is_none());
        let mut impacts = Vec::with_capacity(LANES);
        for (lane, marks) in marks.into_iter().enumerate() {
            let mut case = None;
            let mut posed = block.and_then(|block| block.of(&columns, values, lane));
            if posed.is_none() {
                posed = pose(case.insert(self.case_of(values, lane)));
            }
            // Only the case contains the errors that numbers share, so such a particle always needs its case.
            let marked = if self.impact.shared.is_some() || has_places {
                case.get_or_insert_with(|| self.case_of(values, lane)).skids()
            } else {
                marks
            };
            let impacted = posed.as_ref().and_then(|posed| self.impact_of(posed, marked, values, lane));
            impacts.push(impacted.unwrap_or_else(|| Self::impossible(self.placeholder)));
        }
        if self.followed == [false, false] {
            return impacts;
        }
        let of_motion = self.motion.as_ref().unwrap_or(&self.impact);
        let mut motions: Vec<Option<MotionInput>> = vec![None; LANES];
        for id in VehicleId::ALL.into_iter().filter(|id| self.followed[id.index()]) {
            let followed = wanted(id, &impacts);
            for (lane, motion) in motions.iter_mut().enumerate() {
                let impacted = &mut impacts[lane];
                if followed[lane] && impacted.is_possible && motion.is_none() {
                    *motion = of_motion.of(values, lane).run_out().and_then(Result::ok);
                    impacted.is_possible = motion.is_some();
                }
            }
            follow(id, followed, &motions, &mut impacts);
            if motions.iter().flatten().any(|motion| has_points(motion, id)) {
                let measured = wanted(id, &impacts);
                measure(id, measured, &motions, &mut impacts);
            }
        }
        impacts
    }

    /// The skid marks of each particle.
    pub(super) fn marks(&self, values: &[Lanes]) -> [[Option<SkidData>; 2]; LANES] {
        let lanes = self.skids.each_ref().map(|skid| skid.as_ref().map(|skid| skid.lanes(values)));
        std::array::from_fn(|lane| lanes.each_ref().map(|skid| skid.as_ref().map(|skid| skid[lane])))
    }

    /// The case with the numbers of a particle.
    pub(super) fn case_of(&self, values: &[Lanes], lane: usize) -> Case {
        let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
        let mut case = self.impact.of(values, lane);
        let speeds = self.speeds.along(of, || {
            let headings = case.headings();
            VehicleId::ALL.map(|id| {
                let course = case.course(id).or(headings[id.index()]);
                let (sin, cos) = sin_cos(course.unwrap_or_default());
                Vector2::new(cos, sin)
            })
        });
        for (vehicle, speed) in case.vehicles.iter_mut().zip(speeds) {
            if let Some(speed) = speed {
                vehicle.motion = Quantity::from_si(speed, Dimension::Speed).ok().map(Velocity::Speed);
            }
        }
        case
    }

    fn impact_of(
        &self,
        posed: &Posed,
        marks: [Option<SkidData>; 2],
        values: &[Lanes],
        lane: usize,
    ) -> Option<Impacted> {
        let of = |place: usize| values.get(place).map_or(f64::NAN, |column| column[lane]);
        let Posed { contact, law, motions, crush_energies, basis } = posed;
        let (motions, crush_energies) = (*motions, *crush_energies);
        let closing = -contact.approach(&motions).velocity.normal;
        if closing <= LEAST_APPROACH {
            return None;
        }
        let given = law.at(closing);
        let law = match self.friction {
            None => given,
            Some(place) => Law::new(given.restitution(), Tangential::Friction(of(place))).ok()?,
        };
        let outcome = contact.impact(motions, &law).ok()?;
        let speeds = VehicleId::ALL.map(|id| {
            let course = contact.participants()[id.index()].course();
            speed_along(course, motions[id.index()].velocity)
        });
        let basis = match self.tangential_share {
            Some(place) => Basis::TangentialShare(of(place)),
            None => *basis,
        };
        let taken = needed(basis, works(&outcome), law.restitution())?;
        let crush_energies = match self.other_crush {
            Some(other) => other.map(of).completed(crush_energies),
            None => crush_energies,
        };
        let mut skid_speeds = [None, None];
        for ((speed, given), motion) in skid_speeds.iter_mut().zip(marks).zip(motions) {
            if let Some(given) = given {
                *speed = Some(skid_speed(given, motion.velocity.norm())?);
            }
        }
        let is_possible = taken > 0.0;
        let ways = [None, None];
        // The stiffness is that of the case, which was not fitted.
        let crush_changes = [CrushChange::default(); 2];
        Some(Impacted {
            speeds,
            outcome,
            taken,
            crush_energies,
            crush_changes,
            skid_speeds,
            ways,
            is_possible,
        })
    }
}

/// The collision of a case; `None` if the engine refuses it.
fn pose(case: &Case) -> Option<Posed> {
    let input = case.collision().ok()?;
    let CollisionData { contact, law, motions, vehicles } = input.collision;
    let vehicles = assess(vehicles, [None, None]).ok()?;
    let whole = crush_energy(&vehicles);
    let first = vehicles[0].crush_energy().unwrap_or_default();
    let crush_energies = [first, whole - first];
    Some(Posed { contact, law, motions, crush_energies, basis: input.basis })
}

/// Follows a vehicle to rest in the particles that are wanted.
fn follow(id: VehicleId, wanted: [bool; LANES], motions: &[Option<MotionInput>], impacts: &mut [Impacted]) {
    let inputs = motions.iter().enumerate().filter(|(lane, _)| wanted[*lane] && impacts[*lane].is_possible);
    let inputs: Vec<_> = inputs.filter_map(|(lane, motion)| Some((lane, motion.as_ref()?))).collect();
    let zones: Vec<Vec<FrictionZone<'_>>> = inputs.iter().map(|(_, input)| input.surface.zones()).collect();
    let mut lanes = Vec::with_capacity(LANES);
    let mut outsets = Vec::with_capacity(LANES);
    for ((lane, input), zones) in inputs.into_iter().zip(&zones) {
        let Some(way) = &input.vehicles[id.index()] else { continue };
        let motion = impacts[lane].outcome.after[id.index()];
        lanes.push(lane);
        outsets.push(Outset {
            chassis: way.chassis,
            steer: way.steer.steer(),
            ground: Ground { friction: way.friction_on(&input.surface), zones, grade: input.surface.grade },
            start: State { position: way.position, heading: way.heading, motion },
        });
    }
    let control = Control { tolerance: WAY_TOLERANCE, ..Control::default() };
    let mut rests = vec![None; outsets.len()];
    to_rests(&outsets, &control, |place, rest| rests[place] = rest.ok());
    for (lane, rest) in lanes.into_iter().zip(rests) {
        let impacted = &mut impacts[lane];
        let way = rest.map(|rest| Way { position: rest.position, heading: rest.heading, misses: None });
        // A vehicle that does not come to rest within minutes does not lie where it was found.
        impacted.is_possible &= way.is_some();
        impacted.ways[id.index()] = way;
    }
}

/// (m) error allowed in a step of the path to rest: small compared with that of a measured rest position, 0.5
/// m and 10 % of the path.
pub(super) const WAY_TOLERANCE: f64 = 5e-3;

/// Whether the case has points that the vehicle passed.
fn has_points(input: &MotionInput, id: VehicleId) -> bool {
    input.vehicles[id.index()].as_ref().is_some_and(|way| !way.points.is_empty())
}

/// Measures the distance from each observed point to the path of a vehicle in the particles that are wanted.
fn measure(id: VehicleId, wanted: [bool; LANES], motions: &[Option<MotionInput>], impacts: &mut [Impacted]) {
    for (lane, (motion, impacted)) in motions.iter().zip(impacts).enumerate() {
        let (Some(input), Some(way)) = (motion, &mut impacted.ways[id.index()]) else { continue };
        if wanted[lane] {
            let start = impacted.outcome.after[id.index()];
            let passes = Followed::of(input, id).and_then(|of| of.passes(start, WAY_TOLERANCE).ok());
            way.misses = passes.map(|passes| passes.iter().map(|pass| pass.miss).collect());
            impacted.is_possible &= way.misses.is_some();
        }
    }
}
