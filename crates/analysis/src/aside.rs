//! Evidence of a case that an answer does not use, and its contradictions with that answer.

use evidence::RecorderPlace;
use inputs::{Case, GivenVehicle, Purpose, Quantity, Recorder, RecordersDeltaV};
use pim_core::VehicleId;
use real::elementary::atan2;
use real::principal_angle;
use reconcile::are_collinear;

use crate::analysis::Analysis;
use crate::evident::Evident;
use crate::found::Found;
use crate::given::certain_limits;
use crate::recorded::with_records_of_impact;
use crate::speeds::BothMethod;
use crate::thresholds::{
    DIRECTION_AFTER_ERROR, RECORDER_DELTA_V_ERROR, RECORDER_SPEED_ERROR, SPEED_AFTER_ERROR, yaw_rate_error,
};
use crate::warning::Warning;

/// Number of standard deviations beyond which a piece of evidence contradicts an answer: by chance, one in
/// four hundred does.
const CONTRADICTS: f64 = 3.0;
/// (m/s) and at least 5 km/h: recorders store whole km/h or mph, and people round to five.
const LEAST_DIFFERENCE: f64 = 5.0 / 3.6;

/// (m/s) rounding of a speed at its limit, which is no contradiction.
const SPEED_ROUNDING: f64 = 1e-6;

/// The kinds of evidence that an answer uses: these are neither listed as unused nor compared with the
/// answer.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Used {
    /// The crush energy, to find a speed or as a check.
    pub(crate) crush: bool,
    /// How the vehicles left the impact.
    pub(crate) after: bool,
}

impl Used {
    pub(crate) fn of(found: Option<&Found>, both: Option<&BothMethod>) -> Self {
        Self { crush: !matches!(both, Some(BothMethod::Momentum)) || found.is_some(), after: both.is_some() }
    }
}

/// The keys of evidence that the exact answer of a purpose will not use, as far as that is known before it is
/// solved.
pub(crate) fn of_purpose(case: &Case, purpose: Purpose) -> Vec<String> {
    let used = match purpose {
        Purpose::Reconstruct if case.is_by_momentum() => Used { crush: is_along_line(case), after: true },
        Purpose::Motion => Used { crush: true, after: true },
        _ => Used { crush: true, after: false },
    };
    left_aside(case, used)
}

/// Whether the vehicles approach along one line, so that momentum alone does not give both speeds.
fn is_along_line(case: &Case) -> bool {
    case.approach_angle().is_some_and(are_collinear)
}

/// The keys of the evidence that an answer does not use, in the order of the case: tables and numbers.
pub(crate) fn left_aside(case: &Case, used: Used) -> Vec<String> {
    let mut keys = Vec::new();
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        let mut add = |there: bool, key: &str| {
            if there {
                keys.push(format!("vehicle{}.{key}", id.number()));
            }
        };
        add(!used.crush && has_crush(vehicle), "crush");
        if let Some(after) = vehicle.after.as_ref().filter(|_| !used.after) {
            add(after.speed.is_some(), "after.speed");
            add(after.direction.is_some(), "after.direction");
            add(after.yaw_rate.is_some(), "after.yaw_rate");
            add(after.rest.is_some(), "after.rest");
            add(!after.points.is_empty(), "after.points");
        }
        let skid_speed = vehicle.before.as_ref().and_then(|before| before.speed);
        add(skid_speed.is_some(), "before.speed");
        if let Some(recorder) = &vehicle.recorder {
            add(recorder.speed.is_some(), "recorder.speed");
            add(recorder.delta_v_longitudinal.is_some(), "recorder.delta_v_longitudinal");
            add(recorder.delta_v_lateral.is_some(), "recorder.delta_v_lateral");
            add(recorder.yaw_rate.is_some(), "recorder.yaw_rate");
            add(recorder.pre_crash.is_some(), "recorder.pre_crash");
            add(recorder.pulse.is_some(), "recorder.pulse");
            add(!recorder.records.is_empty(), "recorder.records");
        }
    }
    let bias = case.estimate.and_then(|given| given.crush_bias).filter(|percent| *percent != 100.0);
    if used.crush && case.reconstruct.is_some() && bias.is_some() {
        keys.push(CRUSH_BIAS.to_owned());
    }
    keys
}

/// The key that says how far crush energies are off, which only an estimate uses.
pub(crate) const CRUSH_BIAS: &str = "estimate.crush_bias";

/// Whether the case gives damage, rather than stating that there is none.
fn has_crush(vehicle: &GivenVehicle) -> bool {
    let has_ees = vehicle.energy.as_ref().is_some_and(|known| known.ees().is_some());
    !vehicle.fixed && (vehicle.crush.is_some() || has_ees)
}

/// The contradictions between evidence of the case and an impact whose speeds (m/s) were found without it.
pub(crate) fn contradictions(case: &Case, analysis: &Analysis, used: Used) -> Vec<Warning> {
    let Some(exchange) = analysis.exchange() else { return Vec::new() };
    let case = with_records_of_impact(case).case;
    let case = case.as_ref();
    let mut warnings = Vec::new();
    for (id, vehicle) in VehicleId::ALL.into_iter().zip(&case.vehicles) {
        if vehicle.fixed || vehicle.is_absent() {
            continue;
        }
        let place = id.index();
        let at_center = exchange.delta_v_components[place];
        // (m/s) the answer's ΔV at the place of a recorder.
        let sensed = |recorded: &RecordersDeltaV| match recorded.place {
            None => Some(at_center),
            Some(at) => {
                let before = case.axes.lateral(vehicle.yaw_rate_before());
                let place = RecorderPlace { at, yaw_rate: before };
                exchange.yaw_rates[id.index()].map(|after| place.sensed(at_center, after))
            }
        };
        let along_record = |least: &RecordersDeltaV| Some(least.part_of(sensed(least)?));
        warnings.extend(below_record(case, id, along_record, delta_v_limit));
        let mut add = |evidence: Evident, given: f64, found: f64| {
            warnings.push(Warning::EvidenceDiffers { vehicle: id, evidence, given, found });
        };
        let speed = analysis.speed(id);
        let differs_by = |given: f64, found: f64, sd: f64| (given - found).abs() > speed_limit(sd);
        let differs = |given: f64, found: f64, share: f64| differs_by(given, found, share * given.abs());
        if let Some(recorder) = &vehicle.recorder {
            let ground = case.ground_friction();
            if let Some(told) = recorder.tells_speed(ground) {
                let sd = told.error.unwrap_or(RECORDER_SPEED_ERROR) * told.speed.abs();
                let one = || vec![(told.speed, sd)];
                let meant =
                    told.humps.map_or_else(one, |humps| humps.map(|hump| (hump.mean, hump.sd)).to_vec());
                let is_apart = |(given, sd): &(f64, f64)| differs_by(*given, speed, *sd);
                let nearest = meant.iter().map(|(given, _)| *given);
                let nearest = nearest.min_by(|a, b| (a - speed).abs().total_cmp(&(b - speed).abs()));
                if let Some(given) = nearest.filter(|_| meant.iter().all(is_apart)) {
                    let evidence =
                        if told.is_of_table { Evident::TabledSpeed } else { Evident::RecordedSpeed };
                    add(evidence, given, speed);
                }
            } else if let Some(stood) = recorder.impact_speed(ground)
                && speed > stood.mean
                && differs_by(stood.mean, speed, stood.sd)
            {
                add(Evident::TabledSpeed, stood.mean, speed);
            }
            let told = recorder.tells_delta_v(case.axes, vehicle.yaw_rate_before());
            let is_of_table = told.is_some_and(|told| told.is_of_table);
            let [longitudinal, lateral] = if is_of_table {
                [Evident::PulseLongitudinal, Evident::PulseLateral]
            } else {
                [Evident::RecordedLongitudinal, Evident::RecordedLateral]
            };
            let [along, left] = told.as_ref().and_then(sensed).map_or([None; 2], |found| found.map(Some));
            let parts = [
                (longitudinal, told.and_then(|told| told.along).zip(along)),
                (lateral, told.and_then(|told| told.left).zip(left)),
            ];
            // The error of a component is that of the whole: a direction is not known better than a size.
            let limit = delta_v_limit(recorder, told.map_or(0.0, |told| told.size()));
            for (evidence, both) in parts {
                if let Some((given, found)) = both.filter(|(given, found)| (given - found).abs() > limit) {
                    add(evidence, given, found);
                }
            }
        }
        let of_recorder = vehicle.recorder.as_ref();
        let of_after = vehicle.after.as_ref().filter(|_| !used.after);
        let rates = [
            (
                Evident::RecordedYawRate,
                of_recorder.and_then(|recorder| recorder.yaw_rate),
                of_recorder.and_then(|recorder| recorder.yaw_rate_error),
            ),
            (Evident::YawRateAfter, of_after.and_then(|after| after.yaw_rate), None),
        ];
        for (evidence, given, error) in rates {
            let Some((given, found)) = given.zip(exchange.yaw_rates[place]) else { continue };
            let given = case.axes.lateral(given.si());
            let error = error.map_or(yaw_rate_error(given), |error| error.si());
            if (given - found).abs() > CONTRADICTS * error {
                add(evidence, given, found);
            }
        }
        let skid_speed = vehicle.before.as_ref().and_then(|before| before.speed).map(|speed| speed.si());
        if let (Some(given), Some(skid)) = (skid_speed, analysis.skids[place])
            && differs(given, skid.speed, RECORDER_SPEED_ERROR)
        {
            add(Evident::SkidSpeed, given, skid.speed);
        }
        if let Some(after) = of_after {
            let velocity = exchange.velocities[place];
            let found = velocity.norm();
            if let Some(given) = after.speed.as_ref().map(Quantity::si)
                && differs(given, found, SPEED_AFTER_ERROR)
            {
                add(Evident::SpeedAfter, given, found);
            }
            if let Some(given) = after.direction.as_ref().map(|given| case.axes.lateral(given.si()))
                && found > LEAST_DIFFERENCE
            {
                let direction = atan2(velocity.y, velocity.x);
                if principal_angle(given - direction).abs() > CONTRADICTS * DIRECTION_AFTER_ERROR {
                    add(Evident::DirectionAfter, principal_angle(given), direction);
                }
            }
        }
        let [least, most] = certain_limits(vehicle);
        if let Some(least) = least.filter(|least| speed < least - SPEED_ROUNDING) {
            add(Evident::AtLeast, least, speed);
        }
        if let Some(most) = most.filter(|most| speed > most + SPEED_ROUNDING) {
            add(Evident::AtMost, most, speed);
        }
    }
    warnings
}

/// (m/s) by how much a recorded ΔV of this size (m/s) may differ from an answer.
fn delta_v_limit(recorder: &Recorder, size: f64) -> f64 {
    let error = recorder.delta_v_error.map_or(RECORDER_DELTA_V_ERROR, |percent| percent / 100.0);
    speed_limit(error * size)
}

/// (m/s) by how much a speed with this standard deviation (m/s) may differ from an answer.
fn speed_limit(sd: f64) -> f64 {
    (CONTRADICTS * sd).max(LEAST_DIFFERENCE)
}

/// Warns if a record without the end of the impact has more ΔV than was `found` (m/s) for it, by more than a
/// `limit` (m/s) on a ΔV of its size.
fn below_record(
    case: &Case,
    vehicle: VehicleId,
    found: impl FnOnce(&RecordersDeltaV) -> Option<f64>,
    limit: impl FnOnce(&Recorder, f64) -> f64,
) -> Option<Warning> {
    let given = &case.vehicles[vehicle.index()];
    let recorder = given.recorder.as_ref()?;
    let least = recorder.least_delta_v(case.axes, given.yaw_rate_before())?;
    let (recorded, found) = (least.size(), found(&least)?);
    (recorded - found > limit(recorder, recorded)).then_some(Warning::BelowRecord {
        vehicle,
        recorded,
        found,
    })
}

/// The same for an estimate; `greatest` gives the upper end of its 95 % interval of ΔV (m/s).
pub(crate) fn below_records(case: &Case, greatest: impl Fn(VehicleId) -> Option<f64>) -> Vec<Warning> {
    let case = with_records_of_impact(case).case;
    let of = |id: VehicleId| below_record(&case, id, |_| greatest(id), |_, _| LEAST_DIFFERENCE);
    VehicleId::ALL.into_iter().filter_map(of).collect()
}

/// Warns if a skid begins faster than any speed in the table of the vehicle's recorder; `least` gives the
/// lower end of the 95 % interval of the speed where it begins (m/s).
pub(crate) fn above_records(case: &Case, least: impl Fn(VehicleId) -> Option<f64>) -> Vec<Warning> {
    let case = with_records_of_impact(case).case;
    let of = |vehicle: VehicleId| {
        let record = case.vehicles[vehicle.index()].recorder.as_ref()?.before_impact()?;
        let recorded = record.samples().iter().filter_map(|sample| sample.speed).reduce(f64::max)?;
        let found = least(vehicle)?;
        let limit = speed_limit(RECORDER_SPEED_ERROR * recorded);
        (found - recorded > limit).then_some(Warning::SkidAboveRecord { vehicle, recorded, found })
    };
    VehicleId::ALL.into_iter().filter_map(of).collect()
}
