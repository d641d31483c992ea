//! Every output quantity of an analysis, one row each.
//!
//! Every presentation of results selects from [`QUANTITIES`], the only place of labels, symbols, units and
//! sources.

use inputs::Geometry;
use pim_core::{Outcome, VehicleId};

use reconcile::Implied;

use crate::damage::Crash3;
use crate::exchange::{AtContact, Exchange};
use crate::impact::Impact;
use crate::seen::Seen;
use crate::travel::Travel;
use crate::vehicle::{Damage, Oblique};

/// A number that a finished analysis gives.
#[derive(Clone, Copy, Debug)]
pub struct OutputQuantity {
    /// Its name in columns and lists of outputs, where a quantity of a vehicle has the prefix `vehicle1.` or
    /// `vehicle2.`.
    pub key: &'static str,
    /// Its place in the JSON (RFC 6901); `#` is the number of the vehicle and `%` one less.
    pub pointer: &'static str,
    /// Its label in a list of outputs.
    pub name: &'static str,
    /// Its label in a table, with its symbol where that helps. The components of a vector share its label.
    pub label: &'static str,
    /// Its symbol in the equations; empty if it has none.
    pub symbol: &'static str,
    /// What kind of number it is.
    pub kind: Kind,
    /// Equation n of SAE 980025 or section n of docs/theory.md; empty if it needs no equation.
    pub source: &'static str,
    /// What it belongs to, and how to read it. Lateral and rotational numbers are in the axes of the
    /// analysis.
    pub of: Of,
}

/// What kind of number a quantity is: which units it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Without unit.
    Ratio,
    /// m/s
    Speed,
    /// m
    Length,
    /// rad
    Angle,
    /// rad/s
    YawRate,
    /// J
    Energy,
    /// N·s
    Impulse,
    /// N·m·s
    MomentImpulse,
    /// N
    Force,
    /// s
    Time,
}

/// What a quantity belongs to, with the function that reads it from an analysis, or returns `None` if it is
/// absent.
#[derive(Clone, Copy, Debug)]
pub enum Of {
    /// One number for the whole collision, not for a vehicle.
    Collision(fn(&Seen) -> Option<f64>),
    /// The part along the normal n.
    Normal(fn(&Seen) -> Option<f64>),
    /// The part along the tangent t.
    Tangential(fn(&Seen) -> Option<f64>),
    /// One number for each vehicle.
    Vehicle(fn(&Seen, VehicleId) -> Option<f64>),
}

/// The values of a quantity in one analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// The value of the collision, which a table shows across the columns of both vehicles.
    Shared(Option<f64>),
    /// The values of vehicles 1 and 2.
    Pair([Option<f64>; 2]),
}

impl OutputQuantity {
    /// Its values, in the axes of the analysis.
    #[must_use]
    pub fn values(&self, analysis: &Seen) -> Values {
        // No minus before zero.
        let plain = |value: Option<f64>| value.map(|value| value + 0.0);
        match self.of {
            Of::Collision(get) | Of::Normal(get) | Of::Tangential(get) => {
                Values::Shared(plain(get(analysis)))
            }
            Of::Vehicle(get) => Values::Pair(VehicleId::ALL.map(|id| plain(get(analysis, id)))),
        }
    }

    /// Whether each vehicle has one.
    #[must_use]
    pub fn is_of_vehicle(&self) -> bool {
        matches!(self.of, Of::Vehicle(_))
    }
}

/// The quantity with this key.
#[must_use]
pub fn quantity(key: &str) -> Option<&'static OutputQuantity> {
    QUANTITIES.iter().find(|quantity| quantity.key == key)
}

fn found(analysis: &Seen) -> Option<f64> {
    let by_momentum = || {
        let both = analysis.both.as_ref()?;
        Some(both.speeds[both.sought()?.index()])
    };
    analysis.found.as_ref().map(|found| found.speed).or_else(by_momentum)
}

fn at_contact(analysis: &Seen) -> Option<AtContact> {
    analysis.exchange()?.at_contact
}

/// What the impact did, where the vehicle takes part in it as one that can move.
fn motion(analysis: &Seen, id: VehicleId) -> Option<Exchange> {
    analysis.exchange().filter(|_| analysis.moves(id))
}

/// What the impact law makes of speeds by momentum, of a vehicle that can move.
fn checked(analysis: &Seen, id: VehicleId) -> Option<&Impact> {
    analysis.law_check().filter(|_| analysis.moves(id))
}

/// The moment impulse and its work, under a law with one; momentum does not tell one.
fn moment(analysis: &Seen) -> Option<&Outcome> {
    let impact = analysis.impact.as_ref().filter(|_| analysis.law_check().is_none())?;
    impact.law.has_moment().then_some(&impact.outcome)
}

fn pdof(analysis: &Seen, id: VehicleId) -> Option<f64> {
    let computed = motion(analysis, id).map(|motion| motion.pdof[id.index()]);
    computed.or_else(|| analysis.vehicles[id.index()].crash3_pdof())
}

fn damage(analysis: &Seen, id: VehicleId) -> Option<&Damage> {
    analysis.vehicles[id.index()].damage.as_ref()
}

fn oblique(analysis: &Seen, id: VehicleId) -> Option<Oblique> {
    damage(analysis, id)?.oblique
}

fn crash3(analysis: &Seen) -> Option<&Crash3> {
    analysis.crash3.as_ref()
}

/// CRASH3's answer, for a vehicle that can move.
fn moved(analysis: &Seen, id: VehicleId) -> Option<&Crash3> {
    crash3(analysis).filter(|_| analysis.moves(id))
}

/// What follows from both speeds and the motions after the impact.
fn implied(analysis: &Seen) -> Option<&Implied> {
    Some(&analysis.both.as_ref()?.implied)
}

/// The same, where the contact is known.
fn implied_at_contact(analysis: &Seen) -> Option<&Implied> {
    let both = analysis.both.as_ref().filter(|both| both.geometry != Geometry::PointMasses)?;
    Some(&both.implied)
}

fn travel(analysis: &Seen, id: VehicleId) -> Option<&Travel> {
    analysis.travel[id.index()].as_ref()
}

/// A row whose number is the collision's.
const fn row(
    key: &'static str,
    pointer: &'static str,
    [name, label, symbol, source]: [&'static str; 4],
    kind: Kind,
    of: Of,
) -> OutputQuantity {
    OutputQuantity { key, pointer, name, label, symbol, kind, source, of }
}

/// All quantities: those of the collision in the order of its tables, then those of each vehicle.
pub const QUANTITIES: &[OutputQuantity] = &[
    row(
        "found.value",
        "/found/value",
        ["speed found", "speed found", "v", "theory 6"],
        Kind::Speed,
        Of::Collision(found),
    ),
    row(
        "impact.restitution",
        "/impact/restitution",
        ["restitution", "restitution e", "e", ""],
        Kind::Ratio,
        Of::Collision(|a| a.exchange()?.restitution),
    ),
    row(
        "impact.impulse_ratio",
        "/impact/impulse_ratio",
        ["impulse ratio", "impulse ratio μ = P_t/P_n", "μ", "theory 3"],
        Kind::Ratio,
        Of::Collision(|a| at_contact(a)?.impulse_ratio),
    ),
    row(
        "impact.critical_impulse_ratio",
        "/impact/critical_impulse_ratio",
        ["critical impulse ratio", "critical impulse ratio μ_c", "μ_c", "theory 3"],
        Kind::Ratio,
        Of::Collision(|a| at_contact(a)?.critical_impulse_ratio),
    ),
    row(
        "impact.normal_impulse",
        "/impact/normal_impulse",
        ["impulse on vehicle 1", "impulse on vehicle 1, P", "P_n", "theory 3"],
        Kind::Impulse,
        Of::Normal(|a| Some(at_contact(a)?.impulse.normal)),
    ),
    row(
        "impact.tangential_impulse",
        "/impact/tangential_impulse",
        ["impulse on vehicle 1", "impulse on vehicle 1, P", "P_t", "theory 3"],
        Kind::Impulse,
        Of::Tangential(|a| Some(at_contact(a)?.impulse.tangential)),
    ),
    row(
        "impact.normal_velocity.before",
        "/impact/normal_velocity/0",
        ["relative velocity before", "relative velocity before, u", "u_n", "theory 1"],
        Kind::Speed,
        Of::Normal(|a| Some(at_contact(a)?.velocities[0].normal)),
    ),
    row(
        "impact.normal_velocity.after",
        "/impact/normal_velocity/1",
        ["relative velocity after", "relative velocity after, U", "U_n", "theory 2"],
        Kind::Speed,
        Of::Normal(|a| Some(at_contact(a)?.velocities[1].normal)),
    ),
    row(
        "impact.tangential_velocity.before",
        "/impact/tangential_velocity/0",
        ["relative velocity before", "relative velocity before, u", "u_t", "theory 1"],
        Kind::Speed,
        Of::Tangential(|a| Some(at_contact(a)?.velocities[0].tangential)),
    ),
    row(
        "impact.tangential_velocity.after",
        "/impact/tangential_velocity/1",
        ["relative velocity after", "relative velocity after, U", "U_t", "theory 2"],
        Kind::Speed,
        Of::Tangential(|a| Some(at_contact(a)?.velocities[1].tangential)),
    ),
    row(
        "impact.closing_speed",
        "/impact/closing_speed",
        ["closing speed", "closing speed −u_n", "", "theory 1"],
        Kind::Speed,
        Of::Collision(|a| Some(a.exchange()?.closing_speed)),
    ),
    row(
        "impact.initial_energy",
        "/impact/initial_energy",
        ["initial kinetic energy", "initial kinetic energy", "", "theory 4"],
        Kind::Energy,
        Of::Collision(|a| Some(a.exchange()?.energy.before)),
    ),
    row(
        "impact.final_energy",
        "/impact/final_energy",
        ["final kinetic energy", "final kinetic energy", "", "theory 4"],
        Kind::Energy,
        Of::Collision(|a| Some(a.exchange()?.energy.after)),
    ),
    row(
        "impact.energy_loss",
        "/impact/energy_loss",
        ["energy loss", "energy loss E_L", "E_L", "theory 4"],
        Kind::Energy,
        Of::Collision(|a| Some(a.exchange()?.energy.loss)),
    ),
    row(
        "impact.normal_work",
        "/impact/normal_work",
        ["normal work", "normal work W_n", "W_n", "Eq 4"],
        Kind::Energy,
        Of::Collision(|a| at_contact(a).and(a.exchange()).map(|exchange| exchange.energy.normal_work)),
    ),
    row(
        "impact.tangential_work",
        "/impact/tangential_work",
        ["tangential work", "tangential work W_t", "W_t", "Eq 4"],
        Kind::Energy,
        Of::Collision(|a| at_contact(a).and(a.exchange()).map(|exchange| exchange.energy.tangential_work)),
    ),
    row(
        "impact.moment_work",
        "/impact/moment_work",
        ["moment work", "moment work W_m", "W_m", "theory 4"],
        Kind::Energy,
        Of::Collision(|a| Some(moment(a)?.energy.moment_work)),
    ),
    row(
        "impact.moment_impulse",
        "/impact/moment_impulse",
        ["moment impulse on vehicle 1", "moment impulse on vehicle 1, M", "M", "theory 3"],
        Kind::MomentImpulse,
        Of::Collision(|a| Some(moment(a)?.moment_impulse)),
    ),
    row(
        "impact.impulse.x",
        "/impact/impulse/0",
        ["impulse on vehicle 1 in the scene", "impulse P in the scene", "P_x", "theory 2"],
        Kind::Impulse,
        Of::Collision(|a| Some(a.exchange()?.impulse_vector.x)),
    ),
    row(
        "impact.impulse.y",
        "/impact/impulse/1",
        ["impulse on vehicle 1 in the scene", "impulse P in the scene", "P_y", "theory 2"],
        Kind::Impulse,
        Of::Collision(|a| Some(a.exchange()?.impulse_vector.y)),
    ),
    row(
        "impact.impulse_direction",
        "/impact/impulse_direction",
        ["direction of the impulse", "direction of the impulse", "", "theory 2"],
        Kind::Angle,
        Of::Collision(|a| Some(a.exchange()?.impulse_direction())),
    ),
    row(
        "impact.normal.x",
        "/impact/normal/0",
        ["normal of the crush plane in the scene", "normal n in the scene", "n", "theory 1"],
        Kind::Ratio,
        Of::Collision(|a| Some(at_contact(a)?.normal.x)),
    ),
    row(
        "impact.normal.y",
        "/impact/normal/1",
        ["normal of the crush plane in the scene", "normal n in the scene", "n", "theory 1"],
        Kind::Ratio,
        Of::Collision(|a| Some(at_contact(a)?.normal.y)),
    ),
    row(
        "momentum.approach_angle",
        "/momentum/approach_angle",
        ["angle between the approaches", "angle between the headings", "", "theory 10"],
        Kind::Angle,
        Of::Collision(|a| Some(a.both.as_ref()?.momentum.angle())),
    ),
    row(
        "momentum.impulse.x",
        "/momentum/impulse/0",
        ["impulse on vehicle 1 by momentum", "impulse by momentum, P", "P_x", "theory 10"],
        Kind::Impulse,
        Of::Collision(|a| Some(implied(a)?.impulse_vector.x)),
    ),
    row(
        "momentum.impulse.y",
        "/momentum/impulse/1",
        ["impulse on vehicle 1 by momentum", "impulse by momentum, P", "P_y", "theory 10"],
        Kind::Impulse,
        Of::Collision(|a| Some(implied(a)?.impulse_vector.y)),
    ),
    row(
        "momentum.disagreement",
        "/momentum/disagreement",
        ["difference of the two impulses", "difference of the two impulses", "", "theory 10"],
        Kind::Impulse,
        Of::Collision(|a| Some(implied(a)?.disagreement())),
    ),
    row(
        "momentum.restitution",
        "/momentum/restitution",
        ["restitution by momentum", "restitution by momentum, e", "e", "theory 10"],
        Kind::Ratio,
        Of::Collision(|a| implied(a)?.restitution),
    ),
    row(
        "momentum.cg_closing_speed",
        "/momentum/cg_closing_speed",
        [
            "closing speed along the line of the CGs",
            "closing speed along the line of the CGs",
            "v_CG",
            "theory 10",
        ],
        Kind::Speed,
        Of::Collision(|a| Some(a.both.as_ref()?.cg_line?.closing_speed)),
    ),
    row(
        "momentum.cg_restitution",
        "/momentum/cg_restitution",
        [
            "restitution along the line of the CGs",
            "restitution along the line of the CGs",
            "e_CG",
            "theory 10",
        ],
        Kind::Ratio,
        Of::Collision(|a| a.both.as_ref()?.cg_line?.restitution),
    ),
    row(
        "momentum.impulse_ratio",
        "/momentum/impulse_ratio",
        ["impulse ratio by momentum", "impulse ratio by momentum, μ", "μ", "theory 10"],
        Kind::Ratio,
        Of::Collision(|a| implied_at_contact(a)?.impulse_ratio),
    ),
    row(
        "momentum.critical_impulse_ratio",
        "/momentum/critical_impulse_ratio",
        ["critical impulse ratio by momentum", "μ_c with this U_n", "μ_c", "theory 10"],
        Kind::Ratio,
        Of::Collision(|a| implied_at_contact(a)?.critical_impulse_ratio),
    ),
    row(
        "momentum.energy_loss",
        "/momentum/energy_loss",
        ["energy loss by momentum", "energy loss by momentum, E_L", "E_L", "theory 10"],
        Kind::Energy,
        Of::Collision(|a| Some(implied(a)?.energy_loss)),
    ),
    row(
        "momentum.normal_work",
        "/momentum/normal_work",
        ["normal work by momentum", "normal work by momentum, W_n", "W_n", "theory 10"],
        Kind::Energy,
        Of::Collision(|a| Some(implied_at_contact(a)?.normal_work)),
    ),
    row(
        "momentum.tangential_work",
        "/momentum/tangential_work",
        ["tangential work by momentum", "tangential work by momentum", "W_t", "theory 10"],
        Kind::Energy,
        Of::Collision(|a| Some(implied_at_contact(a)?.tangential_work)),
    ),
    row(
        "law_check.restitution",
        "/law_check/restitution",
        ["restitution of the impact law", "restitution e of the law", "e", ""],
        Kind::Ratio,
        Of::Collision(|a| Some(a.law_check()?.law.restitution())),
    ),
    row(
        "law_check.energy_loss",
        "/law_check/energy_loss",
        ["energy loss by the impact law", "energy loss by the law, E_L", "E_L", "theory 4"],
        Kind::Energy,
        Of::Collision(|a| Some(a.law_check()?.outcome.energy.loss)),
    ),
    row(
        "crash3.crush_energy",
        "/crash3/crush_energy",
        ["crush energy", "crush energy, total", "E", "Eq 5"],
        Kind::Energy,
        Of::Collision(|a| Some(crash3(a)?.crush_energy)),
    ),
    row(
        "crash3.corrected_crush_energy",
        "/crash3/corrected_crush_energy",
        ["corrected crush energy", "corrected crush energy, total", "E'", "Eq 8"],
        Kind::Energy,
        Of::Collision(|a| Some(crash3(a)?.corrected?.crush_energy)),
    ),
    row(
        "crash3.restitution_factor",
        "/crash3/restitution_factor",
        ["restitution factor", "restitution factor f_e", "f_e", "theory 5"],
        Kind::Ratio,
        Of::Collision(|a| crash3(a)?.restitution_factor),
    ),
    row(
        "speed",
        "/vehicle#/speed",
        ["speed", "speed before", "v", ""],
        Kind::Speed,
        Of::Vehicle(|a, id| motion(a, id).map(|_| a.speed(id))),
    ),
    row(
        "velocity.x",
        "/vehicle#/velocity/0",
        ["velocity before", "velocity before, v", "v_x", ""],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].velocity.x)),
    ),
    row(
        "velocity.y",
        "/vehicle#/velocity/1",
        ["velocity before", "velocity before, v", "v_y", ""],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].velocity.y)),
    ),
    row(
        "yaw_rate",
        "/vehicle#/yaw_rate",
        ["yaw rate before", "yaw rate before, ω", "ω", ""],
        Kind::YawRate,
        Of::Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].yaw_rate)),
    ),
    row(
        "final_velocity.x",
        "/vehicle#/final_velocity/0",
        ["velocity after", "velocity after, V", "V_x", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].x)),
    ),
    row(
        "final_velocity.y",
        "/vehicle#/final_velocity/1",
        ["velocity after", "velocity after, V", "V_y", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].y)),
    ),
    row(
        "final_speed",
        "/vehicle#/final_speed",
        ["speed after", "speed after", "V", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].norm())),
    ),
    row(
        "final_yaw_rate",
        "/vehicle#/final_yaw_rate",
        ["yaw rate after", "yaw rate after, Ω", "Ω", "theory 2"],
        Kind::YawRate,
        Of::Vehicle(|a, id| motion(a, id)?.yaw_rates[id.index()]),
    ),
    row(
        "delta_v",
        "/vehicle#/delta_v",
        ["ΔV", "ΔV", "ΔV", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].norm())),
    ),
    row(
        "delta_v_longitudinal",
        "/vehicle#/delta_v_longitudinal",
        ["longitudinal ΔV", "longitudinal ΔV, forward", "ΔV_long", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.delta_v_components[id.index()][0])),
    ),
    row(
        "delta_v_lateral",
        "/vehicle#/delta_v_lateral",
        ["lateral ΔV", "lateral ΔV, along y", "ΔV_lat", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.delta_v_components[id.index()][1])),
    ),
    row(
        "delta_v.x",
        "/vehicle#/delta_v_vector/0",
        ["ΔV in the scene", "ΔV in the scene", "ΔV_x", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].x)),
    ),
    row(
        "delta_v.y",
        "/vehicle#/delta_v_vector/1",
        ["ΔV in the scene", "ΔV in the scene", "ΔV_y", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].y)),
    ),
    row(
        "pdof",
        "/vehicle#/pdof",
        ["PDOF", "PDOF, clockwise from heading", "PDOF", "theory 4"],
        Kind::Angle,
        Of::Vehicle(pdof),
    ),
    row(
        "crush_energy",
        "/vehicle#/crush_energy",
        ["crush energy", "crush energy E", "E", "Eq 5"],
        Kind::Energy,
        Of::Vehicle(|a, id| a.vehicles[id.index()].crush_energy()),
    ),
    row(
        "crush_energy_bounds.low",
        "/vehicle#/crush_energy_bounds/0",
        ["crush energy", "crush energy, bounds", "E", "theory 5"],
        Kind::Energy,
        Of::Vehicle(|a, id| Some(damage(a, id)?.inferred?.range?.lowest.energy)),
    ),
    row(
        "crush_energy_bounds.high",
        "/vehicle#/crush_energy_bounds/1",
        ["crush energy", "crush energy, bounds", "E", "theory 5"],
        Kind::Energy,
        Of::Vehicle(|a, id| Some(damage(a, id)?.inferred?.range?.highest.energy)),
    ),
    row(
        "ees",
        "/vehicle#/ees",
        ["energy equivalent speed", "energy equivalent speed EES", "EES", "theory 5"],
        Kind::Speed,
        Of::Vehicle(|a, id| a.vehicles[id.index()].ees()),
    ),
    row(
        "oblique_angle",
        "/vehicle#/oblique_angle",
        ["angle to the normal", "angle to the normal α", "α", "theory 5"],
        Kind::Angle,
        Of::Vehicle(|a, id| damage(a, id)?.oblique_angle),
    ),
    row(
        "oblique_factor",
        "/vehicle#/oblique_factor",
        ["oblique correction factor", "oblique correction factor", "f", "Eq 8"],
        Kind::Ratio,
        Of::Vehicle(|a, id| Some(oblique(a, id)?.factor.factor)),
    ),
    row(
        "corrected_crush_energy",
        "/vehicle#/corrected_crush_energy",
        ["corrected crush energy", "corrected crush energy", "E'", "Eq 8"],
        Kind::Energy,
        Of::Vehicle(|a, id| a.vehicles[id.index()].corrected_crush_energy()),
    ),
    row(
        "peak_force",
        "/vehicle#/peak_force",
        ["peak force", "peak force", "F", "theory 5"],
        Kind::Force,
        Of::Vehicle(|a, id| Some(oblique(a, id)?.peak_force)),
    ),
    row(
        "no_damage_speed",
        "/vehicle#/no_damage_speed",
        ["no-damage speed", "no-damage speed b_0", "b_0", "theory 5"],
        Kind::Speed,
        Of::Vehicle(|a, id| a.vehicles[id.index()].no_damage_speed()),
    ),
    row(
        "momentum.delta_v",
        "/momentum/delta_v/%",
        ["ΔV by momentum", "ΔV by momentum, |V − v|", "ΔV", "theory 10"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(implied(a).filter(|_| a.moves(id))?.delta_v[id.index()].norm())),
    ),
    row(
        "momentum.pdof",
        "/momentum/pdof/%",
        ["PDOF by momentum", "PDOF by momentum", "PDOF", "theory 10"],
        Kind::Angle,
        Of::Vehicle(|a, id| Some(implied(a).filter(|_| a.moves(id))?.pdof[id.index()])),
    ),
    row(
        "momentum.final_yaw_rate",
        "/momentum/final_yaw_rate/%",
        ["yaw rate after by momentum", "yaw rate after, from P at C", "Ω", "theory 10"],
        Kind::YawRate,
        Of::Vehicle(|a, id| Some(implied_at_contact(a).filter(|_| a.moves(id))?.yaw_rates[id.index()])),
    ),
    row(
        "law_check.delta_v",
        "/law_check/delta_v/%",
        ["ΔV by the impact law", "ΔV by the law", "ΔV", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(checked(a, id)?.outcome.delta_v_magnitude()[id.index()])),
    ),
    row(
        "law_check.delta_v_difference",
        "/law_check/delta_v_difference/%",
        ["ΔV by the impact law, more than by momentum", "ΔV by the law − by momentum", "", "theory 10"],
        Kind::Speed,
        Of::Vehicle(|a, id| {
            let by_law = checked(a, id)?.outcome.delta_v_magnitude()[id.index()];
            Some(by_law - a.both.as_ref()?.delta_v[id.index()])
        }),
    ),
    row(
        "law_check.final_speed",
        "/law_check/final_speed/%",
        ["speed after by the impact law", "speed after by the law", "V", "theory 2"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(checked(a, id)?.outcome.after[id.index()].velocity.norm())),
    ),
    row(
        "law_check.final_yaw_rate",
        "/law_check/final_yaw_rate/%",
        ["yaw rate after by the impact law", "yaw rate after by the law", "Ω", "theory 2"],
        Kind::YawRate,
        Of::Vehicle(|a, id| Some(checked(a, id)?.outcome.after[id.index()].yaw_rate)),
    ),
    row(
        "law_check.pdof",
        "/law_check/pdof/%",
        ["PDOF by the impact law", "PDOF by the law", "PDOF", "theory 4"],
        Kind::Angle,
        Of::Vehicle(|a, id| Some(checked(a, id)?.pdof[id.index()])),
    ),
    row(
        "skid.speed",
        "/vehicle#/skid/speed",
        ["speed where the skid marks begin", "speed where the skid begins", "", "theory 11"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(a.skids[id.index()]?.speed)),
    ),
    row(
        "start.speed",
        "/vehicle#/start/speed",
        ["speed at the start of the path to rest", "speed at the start", "V", "theory 11"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(travel(a, id)?.start.motion.velocity.norm())),
    ),
    row(
        "start.direction",
        "/vehicle#/start/direction",
        ["direction at the start of the path to rest", "direction at the start", "", "theory 11"],
        Kind::Angle,
        Of::Vehicle(|a, id| Some(travel(a, id)?.direction())),
    ),
    row(
        "start.yaw_rate",
        "/vehicle#/start/yaw_rate",
        ["yaw rate at the start of the path to rest", "yaw rate at the start", "Ω", "theory 11"],
        Kind::YawRate,
        Of::Vehicle(|a, id| Some(travel(a, id)?.start.motion.yaw_rate)),
    ),
    row(
        "rest.x",
        "/vehicle#/rest/x",
        ["rest position", "rest position, CG", "", "theory 11"],
        Kind::Length,
        Of::Vehicle(|a, id| Some(travel(a, id)?.rest.position.x)),
    ),
    row(
        "rest.y",
        "/vehicle#/rest/y",
        ["rest position", "rest position, CG", "", "theory 11"],
        Kind::Length,
        Of::Vehicle(|a, id| Some(travel(a, id)?.rest.position.y)),
    ),
    row(
        "rest.heading",
        "/vehicle#/rest/heading",
        ["heading at rest", "heading at rest", "θ", "theory 11"],
        Kind::Angle,
        Of::Vehicle(|a, id| Some(travel(a, id)?.rest.heading)),
    ),
    row(
        "rest.time",
        "/vehicle#/rest/time",
        ["time to rest", "time to rest", "", "theory 11"],
        Kind::Time,
        Of::Vehicle(|a, id| Some(travel(a, id)?.rest.time)),
    ),
    row(
        "rest.distance",
        "/vehicle#/rest/distance",
        ["length of the path to rest", "length of the path to rest", "S", "theory 11"],
        Kind::Length,
        Of::Vehicle(|a, id| Some(travel(a, id)?.rest.distance)),
    ),
    row(
        "crash3.moment_arm",
        "/crash3/moment_arm/%",
        ["moment arm", "moment arm h", "h", "theory 5"],
        Kind::Length,
        Of::Vehicle(|a, id| Some(moved(a, id)?.moment_arm[id.index()])),
    ),
    row(
        "crash3.effective_mass_ratio",
        "/crash3/effective_mass_ratio/%",
        ["effective mass ratio", "effective mass ratio γ", "γ", "theory 5"],
        Kind::Ratio,
        // That of a fixed object is 1.
        Of::Vehicle(|a, id| Some(crash3(a)?.effective_mass_ratio[id.index()])),
    ),
    row(
        "crash3.delta_v",
        "/crash3/delta_v/%",
        ["ΔV uncorrected", "ΔV uncorrected", "ΔV", "Eq 6, 7"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(moved(a, id)?.delta_v[id.index()])),
    ),
    row(
        "crash3.corrected_delta_v",
        "/crash3/corrected_delta_v/%",
        ["ΔV corrected", "ΔV corrected", "ΔV'", "Eq 6, 7, 8"],
        Kind::Speed,
        Of::Vehicle(|a, id| Some(moved(a, id)?.corrected?.delta_v[id.index()])),
    ),
];
