//! The distance from the beginning of braking to the impact, backwards from the last speed, compared with
//! that by recorders.

use std::collections::{BTreeMap, BTreeSet};

use oracle::field::data;
use time_distance::{Response, Swell};

const KMH: f64 = 1.0 / 3.6;
const G: f64 = 9.80665;
/// (s) customary for hydraulic brakes.
const SWELL: f64 = 0.2;

/// A vehicle from its first sample with the brakes on to its last sample: the time (s) and the distance (m)
/// by the trapezoids between the samples, and the last speed (m/s).
struct Braked {
    time: f64,
    distance: f64,
    last: f64,
}

impl Braked {
    /// From samples with time (s), brake and speed (m/s) in the order of time; `None` if the brakes are not
    /// on at the last two, or the vehicle stood all the time.
    fn of(samples: &[(f64, bool, f64)]) -> Option<Self> {
        let off = samples.iter().rposition(|(_, brake, _)| !brake).map_or(0, |off| off + 1);
        let on = &samples[off..];
        let (first, last) = (on.first()?, on.last()?);
        let steps = on.iter().zip(on.iter().skip(1));
        let distance = steps.map(|(a, b)| 0.5 * (a.2 + b.2) * (b.0 - a.0)).sum();
        (on.len() > 1 && first.2 > 0.0).then_some(Self { time: last.0 - first.0, distance, last: last.2 })
    }

    /// (m) the distance backwards from the last speed over the time, with a deceleration (m/s²).
    fn backwards(&self, deceleration: f64) -> f64 {
        let response = Response::new(0.0, SWELL, deceleration, Swell::Linear).unwrap();
        let full = self.time - SWELL;
        let before = response.demand_before(self.last, (self.last + 0.5 * deceleration * full) * full);
        assert!((before.time - self.time).abs() < 1e-9);
        before.distance
    }

    /// Whether the distance lies in the interval with 95 %, if the deceleration lies evenly between two (g).
    fn is_within(&self, [low, high]: [f64; 2]) -> bool {
        let [low, high] = [0.025, 0.975].map(|share| self.backwards((low + share * (high - low)) * G));
        low <= self.distance && self.distance <= high
    }
}

/// The records in which the vehicle braked up to the last sample. A record that is there for several events
/// counts once.
fn braked(text: &str) -> Vec<Braked> {
    let mut records: BTreeMap<String, Vec<(f64, bool, f64)>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |k: usize| fields[k].parse::<f64>().ok();
        if let (Some(time), Some(speed)) = (number(4), number(7)) {
            let of = [0, 1, 2, 3, 10].map(|k| fields[k]).join("/");
            let brake = number(5).is_some_and(|brake| brake > 0.0);
            records.entry(of).or_default().push((time, brake, speed * KMH));
        }
    }
    let mut known = BTreeSet::new();
    let mut found = Vec::new();
    for mut samples in records.into_values() {
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        if known.insert(format!("{samples:?}")) {
            found.extend(Braked::of(&samples));
        }
    }
    found
}

/// How hard a driver braked is not known: from not at all to the greatest friction of the manual of EDCRASH,
/// 1.20 on new dry asphalt. Full braking on travelled dry asphalt, 0.55 to 0.80, is a wrong assumption in
/// most of the crashes.
#[test]
fn braked_distances_of_recorders_lie_within_their_intervals() {
    let Some(text) = data("ciren-precrash.csv") else { return };
    let records = braked(&text);
    let within = |range: [f64; 2]| records.iter().filter(|record| record.is_within(range)).count();
    let [any, full] = [[0.0, 1.2], [0.55, 0.8]].map(within);
    assert!(records.len() > 50);
    assert!(100 * any >= 93 * records.len(), "{any} of {}", records.len());
    assert!(2 * full < records.len(), "{full} of {}", records.len());
}
