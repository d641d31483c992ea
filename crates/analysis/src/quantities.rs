//! Every output quantity of an analysis, one row each.
//!
//! Every presentation of results selects from [`QUANTITIES`], the only place of labels, symbols, units,
//! sources and ways to read a number. Each row is a constant, called after its key.

use evidence::Impacted;
use inputs::{Axes, Geometry};
use pim_core::{Outcome, Real, VehicleId};
use reconcile::Implied;

use crate::analysis::Analysis;
use crate::damage::Crash3;
use crate::exchange::{AtContact, Exchange};
use crate::goal::length;
use crate::impact::Impact;
use crate::output::PathPart::{End, Start, Whole};
use crate::output::Reading::{self, OfDamage, OfImpact, OfPath, SkidSpeed};
use crate::output::{Kind, Of, Output, OutputQuantity};
use crate::seen::Seen;
use crate::speeds::BothFound;
use crate::travel::{Travel, Way};
use crate::vehicle::{Damage, Oblique, Vehicle};

/// The quantity with this key.
#[must_use]
pub fn quantity(key: &str) -> Option<&'static OutputQuantity> {
    QUANTITIES.iter().find(|quantity| quantity.key == key)
}

/// The outputs of an impact, the speed of the vehicle that is `$found` first: an array of `$value` for each
/// `$output`. A macro, because a loop would not be inlined in the solution of blocks of samples.
macro_rules! of_impact {
    ($found:expr, $output:ident => $value:expr) => {
        $crate::quantities::of_impact! {
            @ $output => $value;
            SPEED.of_vehicle($found)
            DELTA_V.of_vehicle(VehicleId::One)
            DELTA_V.of_vehicle(VehicleId::Two)
            PDOF.of_vehicle(VehicleId::One)
            PDOF.of_vehicle(VehicleId::Two)
            IMPACT_CLOSING_SPEED.of_collision()
            IMPACT_ENERGY_LOSS.of_collision()
            IMPACT_NORMAL_WORK.of_collision()
            IMPACT_TANGENTIAL_WORK.of_collision()
            DELTA_V_LONGITUDINAL.of_vehicle(VehicleId::One)
            DELTA_V_LATERAL.of_vehicle(VehicleId::One)
            DELTA_V_LONGITUDINAL.of_vehicle(VehicleId::Two)
            DELTA_V_LATERAL.of_vehicle(VehicleId::Two)
        }
    };
    (@ $output:ident => $value:expr; $($row:ident.$of:ident($($vehicle:expr)?))*) => {
        [$({
            let $output = $crate::quantities::$row.$of($($vehicle)?);
            $value
        }),*]
    };
}
pub(crate) use of_impact;

/// The number of outputs of an impact.
pub(crate) const OUTPUTS: usize = of_impact!(VehicleId::One, _output => ()).len();

/// The outputs of a path to rest.
const OF_PATH: &[OutputQuantity] =
    &[START_SPEED, START_DIRECTION, START_YAW_RATE, REST_X, REST_Y, REST_HEADING, REST_DISTANCE, REST_TIME];

/// The outputs of these quantities, first for vehicle 1, then for vehicle 2.
fn each(quantities: &'static [OutputQuantity]) -> impl Iterator<Item = Output> {
    VehicleId::ALL.into_iter().flat_map(|id| quantities.iter().map(move |quantity| quantity.of_vehicle(id)))
}

impl Output {
    /// The outputs of a reconstruction of two vehicles, where the speed of `found` is unknown.
    pub(crate) const fn of_two_vehicles(found: VehicleId) -> [Self; OUTPUTS] {
        of_impact!(found, output => output)
    }

    /// All outputs that can have an interval, whichever speed is unknown.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let [_, others @ ..] = Self::of_two_vehicles(VehicleId::One);
        each(&[SPEED])
            .chain(others)
            .chain(each(&[SKID_SPEED]))
            .chain(each(OF_PATH))
            // One vehicle alone is always the first.
            .chain([EES.of_vehicle(VehicleId::One), CRUSH_ENERGY.of_vehicle(VehicleId::One)])
            .collect()
    }

    /// The outputs of an analysis: the speeds found, if there are any; no ΔV and PDOF of a fixed object; the
    /// speeds where skid marks begin; and those of the paths to rest. Of one vehicle alone, its energies.
    pub(crate) fn of(analysis: &Analysis, axes: Axes) -> Vec<Self> {
        let seen = analysis.seen(axes);
        let both = analysis.both.as_ref();
        let is_result = |output: &Self| {
            let is_own = |vehicle: VehicleId| output.vehicle() == Some(vehicle);
            match output.quantity().sampled {
                Reading::No => false,
                Reading::Found => match both {
                    Some(both) => both.vehicles().any(is_own),
                    None => analysis.found.as_ref().is_some_and(|found| is_own(found.unknown)),
                },
                OfImpact(_, by_momentum) => {
                    let is_told = both.is_none() || by_momentum.is_some();
                    is_told && output.quantity().value(&seen, output.vehicle()).is_some()
                }
                OfDamage(_) => {
                    analysis.is_of_damage && output.quantity().value(&seen, output.vehicle()).is_some()
                }
                SkidSpeed => output.vehicle().is_some_and(|vehicle| seen.skids[vehicle.index()].is_some()),
                OfPath(part, _) => output.vehicle().is_some_and(|vehicle| {
                    travel(&seen, vehicle).is_some_and(|travel| part.results_from(travel.origin))
                }),
            }
        };
        Self::all().into_iter().filter(is_result).collect()
    }

    /// All outputs that an estimate can have, in the order of its tables.
    #[must_use]
    pub fn drawn() -> Vec<Self> {
        let quantities: &[OutputQuantity] = &[SPEED, DELTA_V, DELTA_V_LONGITUDINAL, DELTA_V_LATERAL, PDOF];
        let of_collision: &[OutputQuantity] = &[
            IMPACT_CLOSING_SPEED,
            IMPACT_ENERGY_LOSS,
            IMPACT_NORMAL_WORK,
            IMPACT_TANGENTIAL_WORK,
            IMPACT_RESTITUTION,
            IMPACT_IMPULSE_RATIO,
            CRUSH_ENERGY,
        ];
        quantities
            .chunks(1)
            .flat_map(each)
            .chain(of_collision.iter().map(OutputQuantity::of_collision))
            .chain(each(&[SKID_SPEED]))
            .chain(each(&[REST_X, REST_Y, REST_HEADING]))
            .collect()
    }
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

/// The exchange of a vehicle in the impact; `None` for a fixed object.
fn motion(analysis: &Seen, id: VehicleId) -> Option<Exchange> {
    analysis.exchange().filter(|_| analysis.moves(id))
}

/// The impact by the law at speeds from momentum; `None` for a fixed object.
fn checked(analysis: &Seen, id: VehicleId) -> Option<&Impact> {
    analysis.law_check().filter(|_| analysis.moves(id))
}

/// The outcome with the moment impulse and its work, under a law with one; momentum does not give them.
fn moment(analysis: &Seen) -> Option<&Outcome> {
    let impact = analysis.impact.as_ref().filter(|_| analysis.law_check().is_none())?;
    impact.law.has_moment().then_some(&impact.outcome)
}

/// The speeds of two vehicles by momentum; a fixed object has neither a direction of travel nor a CG.
fn of_movers(analysis: &Seen) -> Option<&BothFound> {
    let move_both = analysis.vehicles.iter().all(Vehicle::moves);
    analysis.both.as_ref().filter(|_| move_both)
}

/// (J) the work of the moment under a law with one or, by momentum, the loss that neither of the other works
/// explains.
fn moment_work(analysis: &Seen) -> Option<f64> {
    let work = at_contact(analysis).and(analysis.exchange())?.energy.moment_work;
    (work != 0.0 || moment(analysis).is_some()).then_some(work)
}

/// A function, because a closure of this size would not be inlined, and so compiled for the baseline
/// instruction set.
#[inline(always)]
fn pdof_of_impact<T: Real>(outcome: &Outcome<T>, id: VehicleId) -> T {
    outcome.pdof()[id.index()]
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

/// CRASH3's answer; `None` for a fixed object.
fn moved(analysis: &Seen, id: VehicleId) -> Option<&Crash3> {
    crash3(analysis).filter(|_| analysis.moves(id))
}

/// The consequences of both speeds and the motions after the impact.
fn implied(analysis: &Seen) -> Option<&Implied> {
    Some(&analysis.both.as_ref()?.implied)
}

/// The same, if the contact is known.
fn implied_at_contact(analysis: &Seen) -> Option<&Implied> {
    let both = analysis.both.as_ref().filter(|both| both.geometry != Geometry::PointMasses)?;
    Some(&both.implied)
}

fn travel(analysis: &Seen, id: VehicleId) -> Option<&Travel> {
    analysis.travel[id.index()].as_ref()
}

/// (rad) the direction at the start; zero for a vehicle that does not move.
fn start_direction<T: Real>(path: &Way<T>) -> T {
    let velocity = path.start.velocity;
    let stays = velocity.x == T::ZERO && velocity.y == T::ZERO;
    if stays { T::ZERO } else { velocity.y.atan2(velocity.x) }
}

/// (m, m, rad) the rest position and heading of a vehicle in a draw; zeros if it is not followed.
fn end(impacted: &Impacted, id: VehicleId) -> [f64; 3] {
    let path = impacted.ways[id.index()].as_ref();
    path.map_or([0.0; 3], |path| [path.position.x, path.position.y, path.heading])
}

macro_rules! quantities {
    ($(
        $name:ident: $key:literal at $pointer:literal, $texts:expr, $kind:ident, $of:ident($get:expr)
        $(, sampled($sampled:expr))? $(, drawn($drawn:expr))? $([$flag:ident])*;
    )*) => {
        $(
            #[doc = concat!("`", $key, "`")]
            pub const $name: OutputQuantity =
                OutputQuantity::new([$key, $pointer], $texts, Kind::$kind, Of::$of($get))
                    $(.sampled($sampled, $sampled))? $(.drawn($drawn))? $(.$flag())*;
        )*

        /// All quantities: those of the collision in the order of its tables, then those of each vehicle.
        pub const QUANTITIES: &[OutputQuantity] = &[$($name),*];
    };
}

quantities! {
    FOUND_VALUE: "found.value" at "/found/value", ["speed found", "speed found", "v", "theory 6"],
        Speed, Collision(found);
    IMPACT_RESTITUTION: "impact.restitution" at "/impact/restitution",
        ["restitution", "restitution e", "e", ""],
        Ratio, Collision(|a| a.exchange()?.restitution),
        // e = −U_n/u_n
        drawn(|i, _| -i.outcome.separation.normal / i.outcome.approach.normal);
    IMPACT_IMPULSE_RATIO: "impact.impulse_ratio" at "/impact/impulse_ratio",
        ["impulse ratio", "impulse ratio μ = P_t/P_n", "μ", "theory 3"],
        Ratio, Collision(|a| at_contact(a)?.impulse_ratio),
        drawn(|i, _| i.outcome.impulse_ratio) [lateral];
    IMPACT_CRITICAL_IMPULSE_RATIO: "impact.critical_impulse_ratio" at "/impact/critical_impulse_ratio",
        ["critical impulse ratio", "critical impulse ratio μ_c", "μ_c", "theory 3"],
        Ratio, Collision(|a| at_contact(a)?.critical_impulse_ratio);
    IMPACT_NORMAL_IMPULSE: "impact.normal_impulse" at "/impact/normal_impulse",
        ["impulse on vehicle 1", "impulse on vehicle 1, P", "P_n", "theory 3"],
        Impulse, Normal(|a| Some(at_contact(a)?.impulse.normal));
    IMPACT_TANGENTIAL_IMPULSE: "impact.tangential_impulse" at "/impact/tangential_impulse",
        ["impulse on vehicle 1", "impulse on vehicle 1, P", "P_t", "theory 3"],
        Impulse, Tangential(|a| Some(at_contact(a)?.impulse.tangential));
    IMPACT_NORMAL_VELOCITY_BEFORE: "impact.normal_velocity.before" at "/impact/normal_velocity/0",
        ["relative velocity before", "relative velocity before, u", "u_n", "theory 1"],
        Speed, Normal(|a| Some(at_contact(a)?.velocities[0].normal));
    IMPACT_NORMAL_VELOCITY_AFTER: "impact.normal_velocity.after" at "/impact/normal_velocity/1",
        ["relative velocity after", "relative velocity after, U", "U_n", "theory 2"],
        Speed, Normal(|a| Some(at_contact(a)?.velocities[1].normal));
    IMPACT_TANGENTIAL_VELOCITY_BEFORE: "impact.tangential_velocity.before" at "/impact/tangential_velocity/0",
        ["relative velocity before", "relative velocity before, u", "u_t", "theory 1"],
        Speed, Tangential(|a| Some(at_contact(a)?.velocities[0].tangential));
    IMPACT_TANGENTIAL_VELOCITY_AFTER: "impact.tangential_velocity.after" at "/impact/tangential_velocity/1",
        ["relative velocity after", "relative velocity after, U", "U_t", "theory 2"],
        Speed, Tangential(|a| Some(at_contact(a)?.velocities[1].tangential));
    IMPACT_CLOSING_SPEED: "impact.closing_speed" at "/impact/closing_speed",
        ["closing speed", "closing speed −u_n", "", "theory 1"],
        Speed, Collision(|a| Some(a.exchange()?.closing_speed)),
        sampled(OfImpact(|o, _| o.closing_speed(), Some(|m, _| -m.approach.normal)));
    IMPACT_INITIAL_ENERGY: "impact.initial_energy" at "/impact/initial_energy",
        ["initial kinetic energy", "initial kinetic energy", "", "theory 4"],
        Energy, Collision(|a| Some(a.exchange()?.energy.before));
    IMPACT_FINAL_ENERGY: "impact.final_energy" at "/impact/final_energy",
        ["final kinetic energy", "final kinetic energy", "", "theory 4"],
        Energy, Collision(|a| Some(a.exchange()?.energy.after));
    IMPACT_ENERGY_LOSS: "impact.energy_loss" at "/impact/energy_loss",
        ["energy loss", "energy loss E_L", "E_L", "theory 4"],
        Energy, Collision(|a| Some(a.exchange()?.energy.loss)),
        sampled(OfImpact(|o, _| o.energy.loss, Some(|m, _| m.energy_loss)));
    IMPACT_NORMAL_WORK: "impact.normal_work" at "/impact/normal_work",
        ["normal work", "normal work W_n", "W_n", "Eq 4"],
        Energy, Collision(|a| Some(at_contact(a).and(a.exchange())?.energy.normal_work)),
        sampled(OfImpact(|o, _| o.energy.normal_work, Some(|m, _| m.normal_work)));
    IMPACT_TANGENTIAL_WORK: "impact.tangential_work" at "/impact/tangential_work",
        ["tangential work", "tangential work W_t", "W_t", "Eq 4"],
        Energy, Collision(|a| Some(at_contact(a).and(a.exchange())?.energy.tangential_work)),
        sampled(OfImpact(|o, _| o.energy.tangential_work, Some(|m, _| m.tangential_work)));
    IMPACT_MOMENT_WORK: "impact.moment_work" at "/impact/moment_work",
        ["moment work", "moment work W_m", "W_m", "theory 4"],
        Energy, Collision(moment_work);
    IMPACT_MOMENT_IMPULSE: "impact.moment_impulse" at "/impact/moment_impulse",
        ["moment impulse on vehicle 1", "moment impulse on vehicle 1, M", "M", "theory 3"],
        MomentImpulse, Collision(|a| Some(moment(a)?.moment_impulse));
    IMPACT_IMPULSE_X: "impact.impulse.x" at "/impact/impulse/0",
        ["impulse on vehicle 1 in the scene", "impulse P in the scene", "P_x", "theory 2"],
        Impulse, Collision(|a| Some(a.exchange()?.impulse_vector.x));
    IMPACT_IMPULSE_Y: "impact.impulse.y" at "/impact/impulse/1",
        ["impulse on vehicle 1 in the scene", "impulse P in the scene", "P_y", "theory 2"],
        Impulse, Collision(|a| Some(a.exchange()?.impulse_vector.y));
    IMPACT_IMPULSE_DIRECTION: "impact.impulse_direction" at "/impact/impulse_direction",
        ["direction of the impulse", "direction of the impulse", "", "theory 2"],
        Angle, Collision(|a| Some(a.exchange()?.impulse_direction()));
    IMPACT_NORMAL_X: "impact.normal.x" at "/impact/normal/0",
        ["normal of the crush plane in the scene", "normal n in the scene", "n", "theory 1"],
        Ratio, Collision(|a| Some(at_contact(a)?.normal.x));
    IMPACT_NORMAL_Y: "impact.normal.y" at "/impact/normal/1",
        ["normal of the crush plane in the scene", "normal n in the scene", "n", "theory 1"],
        Ratio, Collision(|a| Some(at_contact(a)?.normal.y));
    MOMENTUM_APPROACH_ANGLE: "momentum.approach_angle" at "/momentum/approach_angle",
        ["angle between the approaches", "angle between the headings", "", "theory 10"],
        Angle, Collision(|a| Some(of_movers(a)?.momentum.angle()));
    MOMENTUM_IMPULSE_X: "momentum.impulse.x" at "/momentum/impulse/0",
        ["impulse on vehicle 1 by momentum", "impulse by momentum, P", "P_x", "theory 10"],
        Impulse, Collision(|a| Some(implied(a)?.impulse_vector.x));
    MOMENTUM_IMPULSE_Y: "momentum.impulse.y" at "/momentum/impulse/1",
        ["impulse on vehicle 1 by momentum", "impulse by momentum, P", "P_y", "theory 10"],
        Impulse, Collision(|a| Some(implied(a)?.impulse_vector.y));
    MOMENTUM_DISAGREEMENT: "momentum.disagreement" at "/momentum/disagreement",
        ["difference of the two impulses", "difference of the two impulses", "", "theory 10"],
        Impulse, Collision(|a| Some(implied(a)?.disagreement()));
    MOMENTUM_RESTITUTION: "momentum.restitution" at "/momentum/restitution",
        ["restitution by momentum", "restitution by momentum, e", "e", "theory 10"],
        Ratio, Collision(|a| implied(a)?.restitution);
    MOMENTUM_CG_CLOSING_SPEED: "momentum.cg_closing_speed" at "/momentum/cg_closing_speed",
        ["closing speed along the line of the CGs", "closing speed along the line of the CGs", "v_CG",
            "theory 10"],
        Speed, Collision(|a| Some(of_movers(a)?.cg_line?.closing_speed));
    MOMENTUM_CG_RESTITUTION: "momentum.cg_restitution" at "/momentum/cg_restitution",
        ["restitution along the line of the CGs", "restitution along the line of the CGs", "e_CG",
            "theory 10"],
        Ratio, Collision(|a| of_movers(a)?.cg_line?.restitution);
    MOMENTUM_IMPULSE_RATIO: "momentum.impulse_ratio" at "/momentum/impulse_ratio",
        ["impulse ratio by momentum", "impulse ratio by momentum, μ", "μ", "theory 10"],
        Ratio, Collision(|a| implied_at_contact(a)?.impulse_ratio);
    MOMENTUM_CRITICAL_IMPULSE_RATIO: "momentum.critical_impulse_ratio" at "/momentum/critical_impulse_ratio",
        ["critical impulse ratio by momentum", "μ_c with this U_n", "μ_c", "theory 10"],
        Ratio, Collision(|a| implied_at_contact(a)?.critical_impulse_ratio);
    MOMENTUM_ENERGY_LOSS: "momentum.energy_loss" at "/momentum/energy_loss",
        ["energy loss by momentum", "energy loss by momentum, E_L", "E_L", "theory 10"],
        Energy, Collision(|a| Some(implied(a)?.energy_loss));
    MOMENTUM_NORMAL_WORK: "momentum.normal_work" at "/momentum/normal_work",
        ["normal work by momentum", "normal work by momentum, W_n", "W_n", "theory 10"],
        Energy, Collision(|a| Some(implied_at_contact(a)?.normal_work));
    MOMENTUM_TANGENTIAL_WORK: "momentum.tangential_work" at "/momentum/tangential_work",
        ["tangential work by momentum", "tangential work by momentum", "W_t", "theory 10"],
        Energy, Collision(|a| Some(implied_at_contact(a)?.tangential_work));
    LAW_CHECK_RESTITUTION: "law_check.restitution" at "/law_check/restitution",
        ["restitution of the impact law", "restitution e of the law", "e", ""],
        Ratio, Collision(|a| Some(a.law_check()?.law.restitution()));
    LAW_CHECK_ENERGY_LOSS: "law_check.energy_loss" at "/law_check/energy_loss",
        ["energy loss by the impact law", "energy loss by the law, E_L", "E_L", "theory 4"],
        Energy, Collision(|a| Some(a.law_check()?.outcome.energy.loss));
    CRASH3_CRUSH_ENERGY: "crash3.crush_energy" at "/crash3/crush_energy",
        ["crush energy", "crush energy, total", "E", "Eq 5"],
        Energy, Collision(|a| Some(crash3(a)?.crush_energy));
    CRASH3_CORRECTED_CRUSH_ENERGY: "crash3.corrected_crush_energy" at "/crash3/corrected_crush_energy",
        ["corrected crush energy", "corrected crush energy, total", "E'", "Eq 8"],
        Energy, Collision(|a| Some(crash3(a)?.corrected?.crush_energy));
    CRASH3_RESTITUTION_FACTOR: "crash3.restitution_factor" at "/crash3/restitution_factor",
        ["restitution factor", "restitution factor f_e", "f_e", "theory 5"],
        Ratio, Collision(|a| crash3(a)?.restitution_factor);
    SPEED: "speed" at "/vehicle#/speed", ["speed", "speed before", "v", ""],
        Speed, Vehicle(|a, id| motion(a, id).map(|_| a.speed(id))),
        sampled(Reading::Found);
    VELOCITY_X: "velocity.x" at "/vehicle#/velocity/0", ["velocity before", "velocity before, v", "v_x", ""],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].velocity.x));
    VELOCITY_Y: "velocity.y" at "/vehicle#/velocity/1", ["velocity before", "velocity before, v", "v_y", ""],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].velocity.y));
    YAW_RATE: "yaw_rate" at "/vehicle#/yaw_rate", ["yaw rate before", "yaw rate before, ω", "ω", ""],
        YawRate, Vehicle(|a, id| Some(motion(a, id)?.before[id.index()].yaw_rate));
    FINAL_VELOCITY_X: "final_velocity.x" at "/vehicle#/final_velocity/0",
        ["velocity after", "velocity after, V", "V_x", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].x));
    FINAL_VELOCITY_Y: "final_velocity.y" at "/vehicle#/final_velocity/1",
        ["velocity after", "velocity after, V", "V_y", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].y));
    FINAL_SPEED: "final_speed" at "/vehicle#/final_speed", ["speed after", "speed after", "V", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.velocities[id.index()].norm()));
    FINAL_YAW_RATE: "final_yaw_rate" at "/vehicle#/final_yaw_rate",
        ["yaw rate after", "yaw rate after, Ω", "Ω", "theory 2"],
        YawRate, Vehicle(|a, id| motion(a, id)?.yaw_rates[id.index()]);
    DELTA_V: "delta_v" at "/vehicle#/delta_v", ["ΔV", "ΔV", "ΔV", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].norm())),
        // ΔV = |V − v|
        sampled(OfImpact(
            |o, id| o.delta_v_magnitude()[id.index()],
            Some(|m, id| length(m.delta_v[id.index()])),
        ));
    DELTA_V_LONGITUDINAL: "delta_v_longitudinal" at "/vehicle#/delta_v_longitudinal",
        ["longitudinal ΔV", "longitudinal ΔV, forward", "ΔV_long", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.delta_v_components[id.index()][0])),
        sampled(OfImpact(|o, id| o.delta_v_components()[id.index()][0], None));
    DELTA_V_LATERAL: "delta_v_lateral" at "/vehicle#/delta_v_lateral",
        ["lateral ΔV", "lateral ΔV, along y", "ΔV_lat", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.delta_v_components[id.index()][1])),
        sampled(OfImpact(|o, id| o.delta_v_components()[id.index()][1], None)) [lateral];
    DELTA_V_X: "delta_v.x" at "/vehicle#/delta_v_vector/0",
        ["ΔV in the scene", "ΔV in the scene", "ΔV_x", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].x));
    DELTA_V_Y: "delta_v.y" at "/vehicle#/delta_v_vector/1",
        ["ΔV in the scene", "ΔV in the scene", "ΔV_y", "theory 2"],
        Speed, Vehicle(|a, id| Some(motion(a, id)?.delta_v[id.index()].y));
    PDOF: "pdof" at "/vehicle#/pdof", ["PDOF", "PDOF, clockwise from heading", "PDOF", "theory 4"],
        Angle, Vehicle(pdof),
        sampled(OfImpact(pdof_of_impact, None)) [direction];
    CRUSH_ENERGY: "crush_energy" at "/vehicle#/crush_energy", ["crush energy", "crush energy E", "E", "Eq 5"],
        Energy, Vehicle(|a, id| a.vehicles[id.index()].crush_energy()), sampled(OfDamage(|c| c.energy)),
        // That of both.
        drawn(|i, _| i.crush_energies[0] + i.crush_energies[1]);
    CRUSH_ENERGY_BOUNDS_LOW: "crush_energy_bounds.low" at "/vehicle#/crush_energy_bounds/0",
        ["crush energy", "crush energy, bounds", "E", "theory 5"],
        Energy, Vehicle(|a, id| Some(damage(a, id)?.inferred?.range?.lowest.energy));
    CRUSH_ENERGY_BOUNDS_HIGH: "crush_energy_bounds.high" at "/vehicle#/crush_energy_bounds/1",
        ["crush energy", "crush energy, bounds", "E", "theory 5"],
        Energy, Vehicle(|a, id| Some(damage(a, id)?.inferred?.range?.highest.energy));
    EES: "ees" at "/vehicle#/ees",
        ["energy equivalent speed", "energy equivalent speed EES", "EES", "theory 5"],
        Speed, Vehicle(|a, id| a.vehicles[id.index()].ees()), sampled(OfDamage(|c| c.ees));
    OBLIQUE_ANGLE: "oblique_angle" at "/vehicle#/oblique_angle",
        ["angle to the normal", "angle to the normal α", "α", "theory 5"],
        Angle, Vehicle(|a, id| damage(a, id)?.oblique_angle);
    OBLIQUE_FACTOR: "oblique_factor" at "/vehicle#/oblique_factor",
        ["oblique correction factor", "oblique correction factor", "f", "Eq 8"],
        Ratio, Vehicle(|a, id| Some(oblique(a, id)?.factor.factor));
    CORRECTED_CRUSH_ENERGY: "corrected_crush_energy" at "/vehicle#/corrected_crush_energy",
        ["corrected crush energy", "corrected crush energy", "E'", "Eq 8"],
        Energy, Vehicle(|a, id| a.vehicles[id.index()].corrected_crush_energy());
    PEAK_FORCE: "peak_force" at "/vehicle#/peak_force", ["peak force", "peak force", "F", "theory 5"],
        Force, Vehicle(|a, id| Some(oblique(a, id)?.peak_force));
    NO_DAMAGE_SPEED: "no_damage_speed" at "/vehicle#/no_damage_speed",
        ["no-damage speed", "no-damage speed b_0", "b_0", "theory 5"],
        Speed, Vehicle(|a, id| a.vehicles[id.index()].no_damage_speed());
    MOMENTUM_DELTA_V: "momentum.delta_v" at "/momentum/delta_v/%",
        ["ΔV by momentum", "ΔV by momentum, |V − v|", "ΔV", "theory 10"],
        Speed, Vehicle(|a, id| Some(implied(a).filter(|_| a.moves(id))?.delta_v[id.index()].norm()));
    MOMENTUM_PDOF: "momentum.pdof" at "/momentum/pdof/%",
        ["PDOF by momentum", "PDOF by momentum", "PDOF", "theory 10"],
        Angle, Vehicle(|a, id| Some(implied(a).filter(|_| a.moves(id))?.pdof[id.index()]));
    MOMENTUM_FINAL_YAW_RATE: "momentum.final_yaw_rate" at "/momentum/final_yaw_rate/%",
        ["yaw rate after by momentum", "yaw rate after, from P at C", "Ω", "theory 10"],
        YawRate, Vehicle(|a, id| Some(implied_at_contact(a).filter(|_| a.moves(id))?.yaw_rates[id.index()]));
    LAW_CHECK_DELTA_V: "law_check.delta_v" at "/law_check/delta_v/%",
        ["ΔV by the impact law", "ΔV by the law", "ΔV", "theory 2"],
        Speed, Vehicle(|a, id| Some(checked(a, id)?.outcome.delta_v_magnitude()[id.index()]));
    LAW_CHECK_DELTA_V_DIFFERENCE: "law_check.delta_v_difference" at "/law_check/delta_v_difference/%",
        ["ΔV by the impact law, more than by momentum", "ΔV by the law − by momentum", "", "theory 10"],
        Speed, Vehicle(|a, id| {
            let by_law = checked(a, id)?.outcome.delta_v_magnitude()[id.index()];
            Some(by_law - a.both.as_ref()?.delta_v[id.index()])
        });
    LAW_CHECK_FINAL_SPEED: "law_check.final_speed" at "/law_check/final_speed/%",
        ["speed after by the impact law", "speed after by the law", "V", "theory 2"],
        Speed, Vehicle(|a, id| Some(checked(a, id)?.outcome.after[id.index()].velocity.norm()));
    LAW_CHECK_FINAL_YAW_RATE: "law_check.final_yaw_rate" at "/law_check/final_yaw_rate/%",
        ["yaw rate after by the impact law", "yaw rate after by the law", "Ω", "theory 2"],
        YawRate, Vehicle(|a, id| Some(checked(a, id)?.outcome.after[id.index()].yaw_rate));
    LAW_CHECK_PDOF: "law_check.pdof" at "/law_check/pdof/%",
        ["PDOF by the impact law", "PDOF by the law", "PDOF", "theory 4"],
        Angle, Vehicle(|a, id| Some(checked(a, id)?.pdof[id.index()]));
    SKID_SPEED: "skid.speed" at "/vehicle#/skid/speed",
        ["speed where the skid marks begin", "speed where the skid begins", "", "theory 11"],
        Speed, Vehicle(|a, id| Some(a.skids[id.index()]?.speed)), sampled(SkidSpeed),
        drawn(|i, id| i.skid_speeds[id.index()].unwrap_or_default());
    START_SPEED: "start.speed" at "/vehicle#/start/speed",
        ["speed at the start of the path to rest", "speed at the start", "V", "theory 11"],
        Speed, Vehicle(|a, id| Some(travel(a, id)?.start.motion.velocity.norm())),
        sampled(OfPath(Start, |path| length(path.start.velocity)));
    START_DIRECTION: "start.direction" at "/vehicle#/start/direction",
        ["direction at the start of the path to rest", "direction at the start", "", "theory 11"],
        Angle, Vehicle(|a, id| Some(travel(a, id)?.direction())),
        sampled(OfPath(Start, start_direction)) [lateral] [direction];
    START_YAW_RATE: "start.yaw_rate" at "/vehicle#/start/yaw_rate",
        ["yaw rate at the start of the path to rest", "yaw rate at the start", "Ω", "theory 11"],
        YawRate, Vehicle(|a, id| Some(travel(a, id)?.start.motion.yaw_rate)),
        sampled(OfPath(Start, |path| path.start.yaw_rate)) [lateral];
    REST_X: "rest.x" at "/vehicle#/rest/x", ["rest position", "rest position, CG", "", "theory 11"],
        Length, Vehicle(|a, id| Some(travel(a, id)?.rest.position.x)),
        sampled(OfPath(End, |path| path.rest.position.x)), drawn(|i, id| end(i, id)[0]);
    REST_Y: "rest.y" at "/vehicle#/rest/y", ["rest position", "rest position, CG", "", "theory 11"],
        Length, Vehicle(|a, id| Some(travel(a, id)?.rest.position.y)),
        sampled(OfPath(End, |path| path.rest.position.y)), drawn(|i, id| end(i, id)[1]) [lateral];
    REST_HEADING: "rest.heading" at "/vehicle#/rest/heading",
        ["heading at rest", "heading at rest", "θ", "theory 11"],
        Angle, Vehicle(|a, id| Some(travel(a, id)?.rest.heading)),
        sampled(OfPath(End, |path| path.rest.heading)), drawn(|i, id| end(i, id)[2]) [lateral];
    REST_TIME: "rest.time" at "/vehicle#/rest/time", ["time to rest", "time to rest", "", "theory 11"],
        Time, Vehicle(|a, id| Some(travel(a, id)?.rest.time)),
        sampled(OfPath(Whole, |path| path.rest.time));
    REST_DISTANCE: "rest.distance" at "/vehicle#/rest/distance",
        ["length of the path to rest", "length of the path to rest", "S", "theory 11"],
        Length, Vehicle(|a, id| Some(travel(a, id)?.rest.distance)),
        sampled(OfPath(Whole, |path| path.rest.distance));
    CRASH3_MOMENT_ARM: "crash3.moment_arm" at "/crash3/moment_arm/%",
        ["moment arm", "moment arm h", "h", "theory 5"],
        Length, Vehicle(|a, id| Some(moved(a, id)?.moment_arm[id.index()]));
    // That of a fixed object is 1.
    CRASH3_EFFECTIVE_MASS_RATIO: "crash3.effective_mass_ratio" at "/crash3/effective_mass_ratio/%",
        ["effective mass ratio", "effective mass ratio γ", "γ", "theory 5"],
        Ratio, Vehicle(|a, id| Some(crash3(a)?.effective_mass_ratio[id.index()]));
    CRASH3_DELTA_V: "crash3.delta_v" at "/crash3/delta_v/%",
        ["ΔV uncorrected", "ΔV uncorrected", "ΔV", "Eq 6, 7"],
        Speed, Vehicle(|a, id| Some(moved(a, id)?.delta_v[id.index()]));
    CRASH3_CORRECTED_DELTA_V: "crash3.corrected_delta_v" at "/crash3/corrected_delta_v/%",
        ["ΔV corrected", "ΔV corrected", "ΔV'", "Eq 6, 7, 8"],
        Speed, Vehicle(|a, id| Some(moved(a, id)?.corrected?.delta_v[id.index()]));
}

#[cfg(test)]
mod tests;
