//! Records of one recorder that were assigned to each other's events.
//!
//! A recorder stores each impact of a crash, and its reader assigns each record to an event of the crash. If
//! two of its records fit both events far better when exchanged, their assignment is unknown.

use std::collections::BTreeMap;

use evidence::{FITTED, Freedom};
use pim_core::VehicleId;
use real::elementary::ln;
use real::{Real, principal_angle};

use crate::pair::{Pair, PairVehicle};

/// (–) likelihood ratio of exchanged to unexchanged records that makes them doubtful: as large as if one of a
/// hundred recorders had its records exchanged.
const DOUBTFUL: f64 = 100.0;

/// Both parts of a ΔV that is large enough to be relied on: its size (m/s) and the direction from which the
/// force came (rad).
#[derive(Clone, Copy)]
struct Record {
    size: f64,
    from: f64,
}

impl Record {
    fn of(vehicle: &PairVehicle) -> Option<Self> {
        let truth = vehicle.truth()?;
        Some(Self { size: truth.delta_v, from: truth.direction? })
    }
}

/// An event of a vehicle, and its evidence about a record: the coded PDOF and, if the other vehicle has a
/// record, the change of momentum by that record.
struct Event<'a> {
    vehicle: &'a PairVehicle,
    other: Option<f64>,
}

impl<'a> Event<'a> {
    fn of(pair: &'a Pair, id: VehicleId) -> Self {
        let other = &pair.vehicles[id.other().index()];
        Self {
            vehicle: &pair.vehicles[id.index()],
            // m ΔV (kg m/s)
            other: Record::of(other).map(|record| other.mass() * record.size),
        }
    }

    /// Logarithm of the likelihood of a record, up to a constant.
    fn log_likelihood(&self, record: Record) -> f64 {
        let wider = if self.vehicle.plane.is_side() { FITTED.pdof_side_factor } else { 1.0 };
        // Two errors make up each difference.
        let (pdof, direction) = (FITTED.pdof_scale, FITTED.recorder_direction_scale);
        let scale = wider * Real::sqrt(pdof * pdof + direction * direction);
        let turned = principal_angle(record.from - self.vehicle.pdof);
        let of_direction = Freedom::Two.log_density(turned, scale);
        let of_momentum = self.other.map_or(0.0, |other| {
            let scale = FITTED.recorder_ln_scale * std::f64::consts::SQRT_2;
            FITTED.recorder_freedom.log_density(ln(self.vehicle.mass() * record.size / other), scale)
        });
        of_direction + of_momentum
    }
}

/// Marks the vehicles whose [records are doubted](Vehicle::is_record_doubted).
pub(crate) fn mark(pairs: &mut [Pair]) {
    let mut of_vehicles: BTreeMap<(&str, u32), Vec<(usize, VehicleId)>> = BTreeMap::new();
    for (place, pair) in pairs.iter().enumerate() {
        for id in VehicleId::ALL {
            if let Some(number) = pair.vehicles[id.index()].number {
                of_vehicles.entry((&pair.case, number)).or_default().push((place, id));
            }
        }
    }
    let mut doubted = Vec::new();
    for events in of_vehicles.values() {
        let couples = (1..events.len()).flat_map(|b| (0..b).map(move |a| [events[a], events[b]]));
        doubted.extend(couples.filter(|couple| are_crossed(pairs, couple)).flatten());
    }
    for (place, id) in doubted {
        pairs[place].vehicles[id.index()].is_record_doubted = true;
    }
}

/// Whether the records of a vehicle fit two of its events far better when exchanged.
fn are_crossed(pairs: &[Pair], couple: &[(usize, VehicleId); 2]) -> bool {
    let [a, b] = couple.map(|(place, id)| Event::of(&pairs[place], id));
    let (Some(of_a), Some(of_b)) = (Record::of(a.vehicle), Record::of(b.vehicle)) else { return false };
    let as_they_stand = a.log_likelihood(of_a) + b.log_likelihood(of_b);
    let the_other_way = a.log_likelihood(of_b) + b.log_likelihood(of_a);
    the_other_way - as_they_stand > ln(DOUBTFUL)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use crate::crash::Crash as _;
    use crate::pair::Pair;
    use crate::read::read;

    /// A vehicle's CDCPLANE, PDOF, MAXDVLONG and MAXDVLAT.
    type Side<'a> = (&'a str, f64, &'a str);

    /// A crash of two events, each of vehicles 1 and 2.
    fn events(events: [[Side<'_>; 2]; 2], numbers: [&str; 2]) -> Vec<Pair> {
        let columns = "CURBWT,CARGOWT,CDCPLANE,PDOF,HEADINGANG,FIELDL,DIRECTL,DIRECTD,C1,C2,C3,C4,C5,C6,\
                       DVTOTAL,DVLONG,MAXDVLONG,MAXDVLAT";
        let header = |i: u8| columns.split(',').map(|name| format!("{name}_{i},")).collect::<String>();
        let mut text = format!("{}{}VEHNO_1,VEHNO_2,CASEID\n", header(1), header(2));
        for sides in events {
            for (plane, pdof, recorder) in sides {
                text += &format!("1425,0,{plane},{pdof},,150,150,0,9,9,9,9,9,9,,,{recorder},");
            }
            text += &format!("{},{},8\n", numbers[0], numbers[1]);
        }
        read(&text).unwrap()
    }

    fn doubted(pairs: &[Pair]) -> Vec<bool> {
        pairs.iter().flat_map(|pair| pair.vehicles.map(|vehicle| vehicle.is_record_doubted)).collect()
    }

    /// A front hits a right side from 60°, and then both slap together from 100°: 30 and 8 km/h.
    #[test]
    fn records_that_fit_the_other_way_round_are_doubted() {
        let (hit, slap) = ("-15,-26", "1.4,-7.9");
        let front = ("F", 330.0, "-26,15");
        let crash = |first, second, front, numbers| {
            let first = [("R", 60.0, first), front];
            doubted(&events([first, [("R", 100.0, second), ("L", 260.0, ",")]], numbers))
        };
        let same = ["1", "2"];
        assert_eq!(crash(hit, slap, front, same), [false; 4]);
        assert_eq!(crash(slap, hit, front, same), [true, false, true, false]);
        assert_eq!(crash(slap, hit, front, ["1", "2.0"]), [true, false, true, false]);
        // From 90° and 75°: the directions alone are too weak, and so are the sizes.
        assert_eq!(crash("0,-8.1", "-7.8,-29", front, same), [true, false, true, false]);
        assert_eq!(crash("0,-8.1", "-7.8,-29", ("F", 330.0, ","), same), [false; 4]);
        assert_eq!(crash("-4.1,-7", "5.2,-29.5", front, same), [false; 4]);
        // A record of one part has no direction, and that of a small ΔV is unreliable; without numbers, no
        // two vehicles are the same.
        assert_eq!(crash(slap, "-15,", front, same), [false; 4]);
        assert_eq!(crash("1.3,-7.8", hit, front, same), [false; 4]);
        assert_eq!(crash(slap, hit, front, ["", ""]), [false; 4]);
        // Such records are not judged, and the other vehicle has its own truth.
        let pairs = events([[("R", 60.0, slap), front], [("R", 100.0, hit), ("L", 260.0, ",")]], same);
        assert_eq!(pairs.iter().map(|pair| pair.truths().len()).collect::<Vec<_>>(), [1, 0]);
        assert_eq!(pairs[0].is_one_event(), None);
    }
}
