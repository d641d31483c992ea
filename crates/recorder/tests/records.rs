//! All records of CIREN's crashes with a recorder are read, or refused with a reason.

use std::collections::BTreeMap;

use oracle::field::data;
use recorder::{
    Channel, CrashPulse, EventRecord, ImpactSpeed, ImpactSpeedErrors, KnownImpact, MatchErrors, PreCrash,
    PulseRule, match_records, read_rows, read_tables,
};

/// The text of each record, with this heading, from the given columns; by case, vehicle, record and event.
fn records(text: &str, heading: &str, columns: &[usize]) -> BTreeMap<String, String> {
    let mut found: BTreeMap<String, String> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let of = [0, 1, 2, 3].map(|k| fields[k]).join("/") + "/" + fields[fields.len() - 1];
        let row: Vec<&str> = columns.iter().map(|k| fields[*k]).collect();
        let record = found.entry(of).or_insert_with(|| format!("{heading}\n"));
        record.push_str(&row.join(","));
        record.push('\n');
    }
    found
}

#[test]
fn every_record_before_an_impact_is_read_or_refused() {
    let Some(text) = data("ciren-precrash.csv") else { return };
    let heading = "PTIME (s),brake,pedal_pct,speed_kmh,steer_deg,throttle_pct";
    let all = records(&text, heading, &[4, 5, 6, 7, 8, 9]);
    assert_eq!(all.len(), 210);
    let mut silent = 0;
    for (name, text) in &all {
        let tables = read_tables(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        // The stored values are the printed ones, to the last sample.
        let printed = text.lines().skip(1).filter(|line| line.split(',').nth(3) != Some("")).count();
        let record = PreCrash::from_table(&tables[0]).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(record.speeds().count(), printed, "{name}");
        let Ok(speed) = ImpactSpeed::of(&record, &ImpactSpeedErrors::default()) else {
            assert_eq!(printed, 0, "{name}");
            silent += 1;
            continue;
        };
        let [low, high] = speed.interval(0.95);
        assert!(low <= speed.mean && speed.mean <= high && speed.sd > 0.0, "{name}: {speed:?}");
    }
    println!("{silent} without a speed");
}

#[test]
fn every_pulse_is_read_or_refused() {
    let Some(text) = data("ciren-pulse.csv") else { return };
    let all = records(&text, "ms,dv_lat_kmh,dv_long_kmh", &[4, 5, 6]);
    assert_eq!(all.len(), 158);
    let (mut read, mut cut, mut refused) = (0, 0, Vec::new());
    for (name, text) in &all {
        let tables = read_tables(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        match CrashPulse::from_table(&tables[0]) {
            Ok(pulse) => {
                read += 1;
                cut += usize::from(pulse.is_cut());
                for rule in PulseRule::ALL {
                    let Some(span) = pulse.span(rule) else { continue };
                    assert!(span.start < span.end || span.resultant() == 0.0, "{name}: {span:?}");
                }
            }
            Err(error) => refused.push(format!("{name}: {error}")),
        }
    }
    println!("{read} read, {cut} end before the impact does; refused: {refused:#?}");
    assert_eq!(read + refused.len(), all.len());
    assert!(refused.len() < 8, "{refused:#?}");
}

/// The same records with a row for each value, all of a file in one text, give the same series.
#[test]
fn the_long_tables_give_the_series_of_the_wide_ones() {
    let Some(text) = data("ciren-precrash.csv") else { return };
    let heading = "PTIME (s),brake,pedal_pct,speed_kmh,steer_deg,throttle_pct";
    let all = records(&text, heading, &[4, 5, 6, 7, 8, 9]);
    let names = ["CASEID", "VEHNO", "EDRSUMMNO", "EDREVENTNO"];
    let codes = [(5, 1040), (6, 1030), (7, 1010), (8, 1080), (9, 1020)];
    let rows = text.lines().skip(1).flat_map(|line| {
        let fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        codes.map(|(column, code)| {
            format!("{},{code},{},{}\n", fields[..4].join(","), fields[4], fields[column])
        })
    });
    let long = format!("{},PCODE,PTIME,PVALUE\n{}", names.join(","), rows.collect::<String>());
    for (name, wide) in all.iter().take(40) {
        let of = names.iter().zip(name.split('/')).map(|(name, value)| format!("{name} {value}"));
        let of: Vec<String> = of.collect();
        let found = read_rows(&long, &of.join(", ")).unwrap_or_else(|error| panic!("{name}: {error}"));
        let expected = &read_tables(wide).unwrap()[0];
        assert_eq!(found[0].times(), expected.times(), "{name}");
        for channel in [Channel::Speed, Channel::Brake, Channel::Steering, Channel::Throttle] {
            assert_eq!(found[0].values(channel), expected.values(channel), "{name} {channel:?}");
        }
    }
}

/// Where a recorder of CIREN has several records, and one of them was coded as of the event (`CDCEVENT`):
/// that record is the one found, against the coded PDOF and the ΔV that NHTSA reconstructed from the damage.
#[test]
fn the_record_that_was_coded_as_of_the_event_is_found() {
    let (Some(pulses), Some(pairs)) = (data("ciren-pulse.csv"), data("ciren-pairs.csv")) else { return };
    let all = records(&pulses, "ms,dv_lat_kmh,dv_long_kmh", &[4, 5, 6]);
    let names: Vec<&str> = pairs.lines().next().unwrap().split(',').collect();
    let mut counted = 0;
    for line in pairs.lines().skip(1) {
        // Names of models have commas in quotes: in every second part between quotes a comma is part of the
        // text.
        let parts = line.split('"').enumerate();
        let plain: String = parts
            .map(|(k, part)| if k % 2 == 1 { part.replace(',', " ") } else { part.to_owned() })
            .collect();
        let fields: Vec<&str> = plain.split(',').collect();
        let of = |name: &str| fields[names.iter().position(|own| *own == name).unwrap()];
        for vehicle in ["1", "2"] {
            let [pdof, delta_v] =
                ["PDOF", "DVTOTAL"].map(|name| of(&format!("{name}_{vehicle}")).parse::<f64>().ok());
            let impact = KnownImpact {
                force_direction: pdof.map(f64::to_radians),
                delta_v: delta_v.map(|delta_v| delta_v / 3.6),
            };
            let key = format!("{}/{}/", of("CASEID"), of(&format!("VEHNO_{vehicle}")));
            let stored: Vec<(bool, EventRecord)> = all
                .iter()
                .filter(|(name, _)| name.starts_with(&key))
                .filter_map(|(name, text)| {
                    let pulse = CrashPulse::from_table(&read_tables(text).unwrap()[0]).ok()?;
                    let event = name.rsplit('/').next().unwrap().parse::<f64>();
                    let is_of_event = event.is_ok_and(|event| of("EVENTNO").parse() == Ok(event));
                    let span = pulse.span(PulseRule::GreatestDeltaV);
                    let record = span.map_or_else(EventRecord::default, |span| {
                        EventRecord::new(span.delta_v, span.complete)
                    });
                    Some((is_of_event, record))
                })
                .collect();
            let coded = stored.iter().filter(|(is_of_event, _)| *is_of_event).count();
            if stored.len() < 2 || coded != 1 || delta_v.is_none() {
                continue;
            }
            let events: Vec<EventRecord> = stored.iter().map(|(_, event)| *event).collect();
            let found = match_records(&events, &[impact], &MatchErrors::default());
            for ((is_of_event, event), found) in stored.iter().zip(&found) {
                println!("{key} {is_of_event} {:.3} {event:?}", found.impacts[0]);
                assert_eq!(*is_of_event, found.impacts[0] > 0.5, "{key}: {found:?}");
            }
            counted += 1;
        }
    }
    assert!(counted >= 6, "{counted}");
}
