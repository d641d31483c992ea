//! The impact of one particle.

use estimate::Independent;
use pim_core::{Body, Contact, Law, Motion, Outcome, Participant, Tangential, Vector2, VehicleId};
use real::elementary::ln;
use uncertainty::{LANES, Lanes};

use crate::collision::{Collision, CrushNumbers, VehicleNumbers};
use crate::figures::CrushChange;
use crate::number::Slot;

/// (m/s) approach speed along the normal below which nothing is crushed.
pub const LEAST_APPROACH: f64 = 0.3;

/// Computes the impacts of the unknown numbers of a collision.
pub trait Impacts: Sync {
    /// The unknown numbers.
    fn unknown(&self) -> &Independent;

    /// The impact of each particle of a block of [`uncertainty::LANES`].
    fn impacts(&self, values: &[Lanes]) -> Vec<Impacted>;

    /// The same, but a vehicle is followed to rest only in the particles selected by `wanted`. That is called
    /// for each vehicle once the impacts are known and the vehicles before it have been followed, and again,
    /// for the distances of its path from observed points, once its rest is known. `None` if no vehicle is
    /// followed.
    fn impacts_as_wanted(
        &self,
        values: &[Lanes],
        wanted: &mut dyn FnMut(VehicleId, &[Impacted]) -> [bool; LANES],
    ) -> Option<Vec<Impacted>> {
        let _ = (values, wanted);
        None
    }

    /// The number of outputs of each draw.
    fn outputs_count(&self) -> usize {
        DrawnOutput::ALL.len()
    }

    /// (SI) an output of a draw, by its place: those of [`DrawnOutput`], in their order.
    fn output(&self, place: usize, impacted: &Impacted) -> f64 {
        DrawnOutput::ALL[place].of(impacted)
    }
}

/// An impact with the numbers of one particle.
#[derive(Clone, Debug)]
pub struct Impacted {
    /// (m/s) speeds along the headings before impact.
    pub speeds: [f64; 2],
    /// The impact.
    pub outcome: Outcome,
    /// (J) the energy that the impulses took and that should appear as crush, W_n + λ W_t.
    pub taken: f64,
    /// (J) crush energies.
    pub crush_energies: [f64; 2],
    /// The changes of the crush energies with fitted figures; zero where no figure behind them was fitted.
    pub crush_changes: [CrushChange; 2],
    /// (m/s) speed at the beginning of each vehicle's skid before the impact, if there is one.
    pub skid_speeds: [Option<f64>; 2],
    /// The path of each vehicle to rest, if it was followed.
    pub ways: [Option<Way>; 2],
    /// Whether such an impact is possible.
    pub is_possible: bool,
}

/// The path of a vehicle from the impact to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// (m) position of the CG at rest, in the scene.
    pub position: Vector2<f64>,
    /// (rad) heading at rest, including full turns.
    pub heading: f64,
    /// (m) least distance of the path from each observed point; `None` if it was not wanted.
    pub misses: Option<Vec<f64>>,
}

impl Collision<Slot> {
    #[inline(always)]
    pub(crate) fn impact(&self, values: &[Lanes], lane: usize) -> Impacted {
        let of = |slot: Slot| slot.of(values, lane);
        let [one, two] = &self.vehicles;
        let headings = [of(one.heading), of(two.heading)];
        let forward = headings.map(|heading| {
            let (sin, cos) = real::elementary::sin_cos(heading);
            Vector2::new(cos, sin)
        });
        let speeds = self.speeds.map(of).along(forward);
        let motions = [0, 1]
            .map(|i| Motion { velocity: forward[i] * speeds[i], yaw_rate: of(self.vehicles[i].yaw_rate) });
        let (p1, is_1) = one.participant(headings[0], values, lane);
        let (p2, is_2) = two.participant(headings[1], values, lane);
        let (contact, is_contact) = Contact::new_with_validity([p1, p2], of(self.crush_plane));
        let closing = -contact.approach(&motions).velocity.normal;
        let e = self.restitution.map(of).at(closing);
        let (law, is_law) = Law::new_with_validity(e, Tangential::Friction(of(self.friction)));
        let (outcome, is_impact) = contact.impact_with_validity(motions, &law);
        // E = W_n + λ W_t
        let taken = outcome.energy.normal_work + of(self.tangential_share) * outcome.energy.tangential_work;
        let factors = self.crush_factors(values, lane);
        let energy = |i: usize| self.vehicles[i].crush.as_ref().map_or(0.0, |crush| crush.energy(factors[i]));
        let known = [energy(0), energy(1)];
        let crush_energies = self.other_crush.map_or(known, |other| other.map(of).completed(known));
        let crush_changes = self.crush_changes(factors);
        let is_possible =
            is_1 & is_2 & is_contact & is_law & is_impact & (closing > LEAST_APPROACH) & (taken > 0.0);
        Impacted {
            speeds,
            outcome,
            taken,
            crush_energies,
            crush_changes,
            skid_speeds: [None, None],
            ways: [None, None],
            is_possible,
        }
    }

    /// How the crush energies change with fitted figures, for κ and β of each vehicle.
    #[inline(always)]
    fn crush_changes(&self, factors: [[f64; 2]; 2]) -> [CrushChange; 2] {
        if self.observed.figures.is_none() {
            return [CrushChange::default(); 2];
        }
        let change = |i: usize| self.vehicles[i].crush.as_ref().map(|crush| crush.change(factors[i]));
        match [change(0), change(1)] {
            // The energy of the other vehicle follows from that of this one.
            [Some(known), None] | [None, Some(known)] => [known; 2],
            [one, two] => [one.unwrap_or_default(), two.unwrap_or_default()],
        }
    }

    /// (–) κ and β of each vehicle, as in [`CrushNumbers`]; 1 if it has no crush.
    #[inline(always)]
    pub(crate) fn crush_factors(&self, values: &[Lanes], lane: usize) -> [[f64; 2]; 2] {
        let factors = |vehicle: &VehicleNumbers<Slot>| match &vehicle.crush {
            Some(crush) => [crush.slope.of(values, lane), crush.no_damage_speed.of(values, lane)],
            None => [1.0; 2],
        };
        [factors(&self.vehicles[0]), factors(&self.vehicles[1])]
    }
}

impl VehicleNumbers<Slot> {
    #[inline(always)]
    fn participant(&self, heading: f64, values: &[Lanes], lane: usize) -> (Participant, bool) {
        let of = |slot: Slot| slot.of(values, lane);
        let (body, is_body) = match self.body {
            None => (Body::fixed(), true),
            Some(body) => {
                let (mass, radius) = (of(body.mass), of(body.yaw_radius));
                // I = m k²
                Body::new_with_validity(mass, mass * radius * radius)
            }
        };
        let [ahead, left] = self.contact.map(of);
        let (participant, is_placed) = Participant::new_with_validity(body, heading, ahead, left);
        (participant, is_body & is_placed)
    }
}

impl<N> CrushNumbers<N> {
    /// (J) energy for the given κ and β.
    #[inline(always)]
    #[must_use]
    pub fn energy(&self, [slope, no_damage]: [f64; 2]) -> f64 {
        // E = L (G₀ β² + A₀ C̄ κ β + ½ B₀ C²̄ κ²)
        self.constant * no_damage * no_damage + self.linear * slope * no_damage + self.square * slope * slope
    }

    /// The changes of the energy with the figures behind it, for the given κ and β.
    #[inline(always)]
    #[must_use]
    pub fn change(&self, factors: [f64; 2]) -> CrushChange {
        let [slope, no_damage] = factors;
        let (constant, linear) = (self.constant * no_damage * no_damage, self.linear * slope * no_damage);
        // ∂ ln E/∂ ln b₀ = (2 L G₀ β² + L A₀ C̄ κ β)/E; that with respect to ln b₁ is 2 less this, as E ~ (b₀
        // + b₁ C)²
        let energy = self.energy(factors);
        let of_no_damage = if energy > 0.0 { (2.0 * constant + linear) / energy } else { 0.0 };
        let of_slope = 2.0 - of_no_damage;
        // κ = exp(τ z), so ∂ ln κ/∂ ln τ = ln κ
        CrushChange { slope: of_slope, slope_spread: of_slope * ln(slope), no_damage_speed: of_no_damage }
    }
}

/// A quantity of each draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnOutput {
    /// (m/s) speed before impact along the heading.
    Speed(VehicleId),
    /// (m/s) |ΔV|.
    DeltaV(VehicleId),
    /// (m/s) component of ΔV along the heading.
    LongitudinalDeltaV(VehicleId),
    /// (m/s) component of ΔV to the left of the heading.
    LateralDeltaV(VehicleId),
    /// (m/s) −u_n.
    ClosingSpeed,
    /// (J) E_L.
    EnergyLoss,
    /// (–) e.
    Restitution,
    /// (J) crush energy of both vehicles, with the stiffness of the draw, and the ratio of both if only that
    /// of one is known.
    CrushEnergy,
}

impl DrawnOutput {
    /// All, in the order of the columns.
    pub const ALL: [Self; 12] = {
        use VehicleId::{One, Two};
        [
            Self::Speed(One),
            Self::Speed(Two),
            Self::DeltaV(One),
            Self::DeltaV(Two),
            Self::LongitudinalDeltaV(One),
            Self::LongitudinalDeltaV(Two),
            Self::LateralDeltaV(One),
            Self::LateralDeltaV(Two),
            Self::ClosingSpeed,
            Self::EnergyLoss,
            Self::Restitution,
            Self::CrushEnergy,
        ]
    };

    /// Its column.
    #[must_use]
    pub fn column(self) -> usize {
        Self::ALL.iter().position(|other| *other == self).unwrap_or(Self::ALL.len())
    }

    #[inline(always)]
    pub(crate) fn of(self, impacted: &Impacted) -> f64 {
        let outcome = &impacted.outcome;
        match self {
            Self::Speed(id) => impacted.speeds[id.index()],
            Self::DeltaV(id) => outcome.delta_v_magnitude()[id.index()],
            Self::LongitudinalDeltaV(id) => outcome.delta_v_components()[id.index()][0],
            Self::LateralDeltaV(id) => outcome.delta_v_components()[id.index()][1],
            Self::ClosingSpeed => outcome.closing_speed(),
            Self::EnergyLoss => outcome.energy.loss,
            // e = −U_n/u_n
            Self::Restitution => -outcome.separation.normal / outcome.approach.normal,
            Self::CrushEnergy => impacted.crush_energies[0] + impacted.crush_energies[1],
        }
    }
}
