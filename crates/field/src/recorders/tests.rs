use pim_core::VehicleId;

use super::*;
use crate::recorded::read_recorders;

/// A head-on impact along one line, by default: 1425 kg + 75 kg each, both at 36 km/h.
const COLUMNS: [(&str, &str); 44] = [
    ("CASEID", "7"),
    ("CURBWT_1", "1425"),
    ("CARGOWT_1", ""),
    ("CDCPLANE_1", "F"),
    ("PDOF_1", "0"),
    ("HEADINGANG_1", "0"),
    ("FIELDL_1", "150"),
    ("DIRECTL_1", "150"),
    ("DIRECTD_1", "0"),
    ("C1_1", "30"),
    ("C2_1", "30"),
    ("C3_1", "30"),
    ("C4_1", "30"),
    ("C5_1", "30"),
    ("C6_1", "30"),
    ("DVTOTAL_1", ""),
    ("DVLONG_1", ""),
    ("MAXDVLONG_1", "-36"),
    ("MAXDVLAT_1", "0"),
    ("V_T0_KMH_1", "36"),
    ("V_T0_AT_S_1", "0"),
    ("V_1S_KMH_1", "36"),
    ("BRAKE_T0_1", "0"),
    ("CURBWT_2", "1425"),
    ("CARGOWT_2", ""),
    ("CDCPLANE_2", "F"),
    ("PDOF_2", "0"),
    ("HEADINGANG_2", "180"),
    ("FIELDL_2", "150"),
    ("DIRECTL_2", "150"),
    ("DIRECTD_2", "0"),
    ("C1_2", "30"),
    ("C2_2", "30"),
    ("C3_2", "30"),
    ("C4_2", "30"),
    ("C5_2", "30"),
    ("C6_2", "30"),
    ("DVTOTAL_2", ""),
    ("DVLONG_2", ""),
    ("MAXDVLONG_2", "-36"),
    ("V_T0_KMH_2", "36"),
    ("V_T0_AT_S_2", "0"),
    ("V_1S_KMH_2", "36"),
    ("BRAKE_T0_2", "0"),
];

fn table(changes: &[(&str, &str)]) -> String {
    let value = |(column, value): &(&'static str, &'static str)| {
        changes.iter().find(|(changed, _)| changed == column).map_or(*value, |(_, value)| *value).to_owned()
    };
    let names: Vec<&str> = COLUMNS.iter().map(|(column, _)| *column).chain(["MAXDVLAT_2"]).collect();
    let mut values: Vec<String> = COLUMNS.iter().map(value).collect();
    values.push(value(&("MAXDVLAT_2", "0")));
    format!("{}\n{}\n", names.join(","), values.join(","))
}

fn row(changes: &[(&str, &str)]) -> Result<RecordedPair, String> {
    read_recorders(&table(changes)).unwrap().remove(0).pair
}

#[test]
fn the_speed_at_impact_follows_from_the_last_samples() {
    let last = |gap, braked| {
        let [mean, sd] = LastSpeed::of(20.0, gap, braked, Some((1.0, 20.0))).unwrap().to_impact;
        assert!(sd > 0.1 && sd < 3.0, "{sd}");
        mean
    };
    // A recorder reads 1.4 % low while the wheels roll: 0.28 m/s.
    assert!((last(0.0, Some(false)) - 0.28).abs() < 0.02, "{}", last(0.0, Some(false)));
    // Half a second of braking takes at most 0.75 g · 0.5 s = 3.7 m/s.
    let braked = last(0.5, Some(true));
    assert!(braked < 0.28 && braked > 0.28 - 3.7, "{braked}");
    // If the stored speed is exact, only it counts.
    assert!(last(0.5, Some(false)) > braked);
}

#[test]
fn a_common_velocity_shares_the_closing_speed_by_the_masses() {
    // Each is 1.4 % low. Head-on, equal masses: each stops.
    let pair = row(&[]).unwrap();
    let speed = 36.0 + 3.6 * pair.last[0].to_impact[0];
    assert!((speed - 36.504).abs() < 0.05, "{speed}");
    let [one, two] = pair.to_common_velocity().unwrap();
    for [along, across] in [one, two] {
        assert!((3.6 * along + speed).abs() < 1e-9 && across.abs() < 1e-9, "{along} {across}");
    }
    // At a right angle, vehicle 2 to the east and three times as heavy: ΔV_1 = 3/4 (v_2 − v_1), as much
    // back as to the right.
    let pair = row(&[("HEADINGANG_2", "90"), ("CURBWT_2", "4425")]).unwrap();
    let [[along, across], [second, left]] = pair.to_common_velocity().unwrap().map(|dv| dv.map(|v| 3.6 * v));
    let (most, least) = (0.75 * speed, 0.25 * speed);
    assert!((along + most).abs() < 1e-9 && (across - most).abs() < 1e-9, "{along} {across}");
    // ΔV_2 = 1/4 (v_1 − v_2): back, and north is to the left of a vehicle that goes east.
    assert!((second + least).abs() < 1e-9 && (left + least).abs() < 1e-9, "{second} {left}");
}

#[test]
fn a_record_of_another_impact_is_doubted() {
    assert_eq!(row(&[]).unwrap().doubted(), []);
    // ln(36.5/9) = 1.4
    let doubted = row(&[("MAXDVLONG_2", "-9")]).unwrap().doubted();
    assert_eq!(doubted.iter().map(|record| record.vehicle).collect::<Vec<_>>(), [VehicleId::Two]);
    assert!((3.6 * doubted[0].common - 36.504).abs() < 0.05);
}

#[test]
fn a_row_that_lacks_something_says_what() {
    for (changes, reason) in [
        (&[("V_T0_KMH_2", "")][..], "the recorder of vehicle 2 stored no speed before the impact"),
        (&[("CURBWT_1", "")], "the mass of vehicle 1 is missing (CURBWT_1)"),
        (&[("HEADINGANG_1", "999")], "the heading of vehicle 1 is missing (HEADINGANG_1)"),
        (&[("PDOF_2", "")], "the PDOF of vehicle 2 is missing (PDOF_2)"),
        (&[("CDCPLANE_1", "T")], "the damage of vehicle 1 is to plane T, not to F, B, L or R"),
        (&[("C1_1", ""), ("C6_2", "")], "the crush of neither vehicle was measured"),
    ] {
        assert_eq!(row(changes).unwrap_err(), reason);
    }
    assert_eq!(row(&[("C1_1", "")]).unwrap().is_measured, [false, true]);
    let gone = table(&[]).replace("V_T0_AT_S_1", "V_T0");
    let error = read_recorders(&gone).unwrap_err().to_string();
    assert!(error.starts_with("there is no column V_T0_AT_S_1; --recorders needs"), "{error}");
    let error = read_recorders(&table(&[("V_T0_KMH_1", "9999")])).unwrap_err().to_string();
    assert!(error.starts_with("line 2, column V_T0_KMH_1: \"9999\" is not a plausible"), "{error}");
}

#[test]
fn speeds_are_judged_by_the_evidence_beside_the_own_recorder() {
    let rows = read_recorders(&table(&[])).unwrap();
    let options =
        Options { particles: 128, seed: 1, other: true, crush: crate::crash::KnownCrush::Both, injury: None };
    let judged =
        judge_recorders(&rows, &evidence::FITTED, &options, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert_eq!((judged.speeds.len(), judged.delta_vs.len()), (2, 2));
    for speed in &judged.speeds {
        // By hand: m_1 ΔV_1 = m_2 ΔV_2, so 36 km/h of the other vehicle's ΔV is a closing speed of 72 km/h or
        // a little less with restitution, and the other vehicle drove 36 of it.
        let [low, high] = speed.intervals[2].map(|v| 3.6 * v);
        assert!(low < 36.0 && high > 36.0 && high - low < 60.0, "{speed:?}");
        assert!((3.6 * speed.median - 36.0).abs() < 12.0, "{speed:?}");
    }
    assert_eq!(judged.other_speed.coverage.map(|[.., most]| most), Some(1.0));
    let by_momentum = judged.delta_v_from_speeds;
    // ln 1.014
    assert!((by_momentum.bias.unwrap() - 0.013_9).abs() < 0.001_5, "{by_momentum:?}");
    let exact = &judged.other_speed.half_width_without;
    assert!(
        exact.iter().all(|(_, width)| *width < 1.05 * judged.other_speed.half_width.unwrap()),
        "{exact:?}"
    );
}
