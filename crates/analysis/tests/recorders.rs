//! A recorder's table as evidence, and data that disagree with it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::ops::ControlFlow;

use analysis::quantities::DELTA_V;
use analysis::{
    EstimatePlan, Evident, PieceDetail, UnusedReason, Warning, estimate, estimate_evidence, impact, judge,
    recorders,
};
use case::CaseFile;
use pim_core::VehicleId;

/// Two cars that meet front to front along one line.
fn head_on(recorder: &str) -> CaseFile {
    let vehicle = |n: u8, heading: u16, speed: u8| {
        format!(
            "[vehicle{n}]\nmass = \"1500 kg\"\nyaw_radius = \"1.4 m\"\nheading = \"{heading} deg\"\nspeed = \"{speed} km/h\"\n\
             contact = {{ x = \"2 m\", y = \"0 m\" }}\n"
        )
    };
    let text = format!(
        "{}{}[vehicle1.recorder]\n{recorder}\n[impact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\ntangential = \"critical\"\n",
        vehicle(1, 0, 50),
        vehicle(2, 180, 40)
    );
    CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn table(last: u8) -> String {
    format!(
        "pre_crash = {{ time = \"-1 -0.5 0 s\", speed = \"{last} {last} {last} km/h\", brake = \"off off off\" }}"
    )
}

fn differs(file: &CaseFile) -> Vec<Evident> {
    let analysis = impact(&file.case).unwrap();
    let warnings = analysis.warnings.iter();
    warnings
        .filter_map(|warning| match warning {
            Warning::EvidenceDiffers { evidence, .. } => Some(*evidence),
            _ => None,
        })
        .collect()
}

/// The case has 50 km/h: a table that ends at 50 agrees, and one at 65 does not.
#[test]
fn a_speed_that_the_table_contradicts_is_told() {
    assert_eq!(differs(&head_on(&table(50))), []);
    assert_eq!(differs(&head_on(&table(65))), [Evident::TabledSpeed]);
}

/// A table of a vehicle that stood up to the impact, of a case that has it at 50 km/h.
#[test]
fn a_table_of_a_standing_vehicle_contradicts_a_moving_one() {
    assert_eq!(differs(&head_on(&table(0))), [Evident::TabledSpeed]);
    let slow = head_on(&table(0)).source.text().replace("speed = \"50 km/h\"", "speed = \"4 km/h\"");
    assert_eq!(differs(&CaseFile::parse("case.toml", &slow).unwrap()), []);
}

/// After a steep fall either speed agrees, and one between them contradicts the table.
#[test]
fn either_speed_after_a_steep_fall_agrees() {
    let lines = |first: u8, last: u8| {
        format!(
            "pre_crash = {{ time = \"-1 -0.5 0 s\", speed = \"{first} {first} {last} km/h\", brake = \"on on on\" }}"
        )
    };
    for (first, last, expected) in [(53, 10, None), (110, 48, None), (100, 20, Some(Evident::TabledSpeed))] {
        assert_eq!(differs(&head_on(&lines(first, last))), expected.as_slice(), "{first} {last}");
    }
    // 20 km/h, read 3 km/h low in hard braking, is 30 km/h below the answer; 100 km/h is farther. What is
    // told is a speed that the table may mean, not the mean of both.
    let analysis = impact(&head_on(&lines(100, 20)).case).unwrap();
    let given = analysis.warnings.iter().find_map(|warning| match warning {
        Warning::EvidenceDiffers { given, .. } => Some(given * 3.6),
        _ => None,
    });
    assert!((given.unwrap() - 22.3).abs() < 0.5, "{given:?}");
}

/// The central impact turns nothing: 3 · 20 % of 90 °/s are 54 °/s, and 3 · 10 °/s are 30 °/s.
#[test]
fn a_yaw_rate_that_the_answer_contradicts_is_told() {
    let after = |rate: &str| {
        let text =
            head_on("").source.text().replace("[vehicle1.recorder]", &format!("[vehicle1.after]\n{rate}"));
        differs(&CaseFile::parse("case.toml", &text).unwrap())
    };
    for (rate, is_told) in [("yaw_rate = \"90 deg/s\"", true), ("yaw_rate = \"-29 deg/s\"", false)] {
        assert_eq!(differs(&head_on(rate)).contains(&Evident::RecordedYawRate), is_told, "{rate}");
        assert_eq!(after(rate).contains(&Evident::YawRateAfter), is_told, "{rate}");
    }
    assert_eq!(differs(&head_on("yaw_rate = \"90 deg/s\"\nyaw_rate_error = \"31 deg/s\"")), []);
}

/// A recorder away from the CG of a vehicle that turns: its ΔV is that of the CG and Ω × r, and the answer is
/// compared there, whether the record is a pulse or two numbers.
#[test]
fn an_answer_is_compared_at_the_place_of_the_recorder() {
    let text = |recorder: &str| head_on(recorder).source.text().replacen("y = \"0 m\"", "y = \"0.6 m\"", 1);
    let analysis = impact(&CaseFile::parse("case.toml", &text("")).unwrap().case).unwrap();
    let exchange = analysis.exchange().unwrap();
    let ([along, left], turned) = (exchange.delta_v_components[0], exchange.yaw_rates[0].unwrap());
    assert!(turned.abs() > 1.0, "{turned}");
    for (x, y) in [(-1.8, 0.3), (1.7, -0.5), (0.0, 0.0)] {
        // V = v + Ω × r
        let [there, across] = [along - turned * y, left + turned * x].map(|si| si * 3.6);
        let at = format!("at = {{ x = \"{x} m\", y = \"{y} m\" }}\n");
        let over_time =
            |whole: f64| [0.0, 0.2, 0.5, 0.8, 1.0, 1.0, 1.0].map(|part| (part * whole).to_string()).join(" ");
        let pulse = format!(
            "pulse = {{ time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"{} km/h\", \
             delta_v_lateral = \"{} km/h\" }}",
            over_time(there),
            over_time(-across)
        );
        let numbers = format!("delta_v_longitudinal = \"{there} km/h\"\ndelta_v_lateral = \"{across} km/h\"");
        for record in [pulse, numbers] {
            let told = |lines: &str| differs(&CaseFile::parse("case.toml", &text(lines)).unwrap());
            assert_eq!(told(&format!("{at}{record}")), [], "{x} {y} {record}");
            // Taken as the ΔV of the CG, the same record contradicts it.
            assert_eq!(told(&record).is_empty(), x == 0.0, "{x} {y} {record}");
        }
    }
}

/// Both of 1500 kg at 50 and 40 km/h with e = 0.1: ΔV = 1.1 · 90/2 = 49.5 km/h.
#[test]
fn a_pulse_that_disagrees_is_told_and_one_cut_off_is_not() {
    let pulse = |values: &str| {
        format!("pulse = {{ time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"{values} km/h\" }}")
    };
    assert_eq!(differs(&head_on(&pulse("0 -10 -25 -40 -49 -49 -49"))), []);
    assert_eq!(differs(&head_on(&pulse("0 -8 -15 -20 -25 -25 -25"))), [Evident::PulseLongitudinal]);
    // Still falling at its end: a lower bound.
    let cut = head_on(&pulse("0 -3 -6 -10 -15 -20 -25"));
    assert_eq!(differs(&cut), []);
    let reading = recorders(&cut.case).unwrap();
    let found = reading.vehicles[0].as_ref().unwrap();
    assert!(found.is_cut && found.delta_v.is_none());
}

/// (km/h) the recorded and the found ΔV, where the answer is below that of a record without the end of the
/// impact.
fn below(warnings: &[Warning]) -> Vec<[f64; 2]> {
    let of = |warning: &Warning| match warning {
        Warning::BelowRecord { recorded, found, .. } => Some([*recorded, *found].map(|si| si * 3.6)),
        _ => None,
    };
    warnings.iter().filter_map(of).collect()
}

/// The same impact, 49.5 km/h: a record that has more before it ends cannot be of it, and one of one axis
/// bounds the part along that axis alone.
#[test]
fn an_answer_below_a_record_that_ends_early_is_told() {
    let of = |lines: &str| below(&impact(&head_on(lines).case).unwrap().warnings);
    let cut = |values: &str| {
        format!("pulse = {{ time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"{values} km/h\" }}")
    };
    assert_eq!(of(&cut("0 -3 -6 -10 -25 -40 -54")), [[0.0; 2]; 0]);
    let [[recorded, found]] = of(&cut("0 -3 -6 -20 -40 -60 -75"))[..] else { panic!() };
    assert!((recorded - 75.0).abs() < 1e-9 && (found - 49.5).abs() < 1e-9, "{recorded} {found}");
    // Pushed from behind: the impact has no ΔV in this direction.
    let [[recorded, found]] = of(&cut("0 3 6 9 12 15 18"))[..] else { panic!() };
    assert!((recorded - 18.0).abs() < 1e-9 && (found + 49.5).abs() < 1e-9, "{recorded} {found}");
    let unfinished = "incomplete = true\ndelta_v_longitudinal = \"-75 km/h\"";
    assert_eq!(of(unfinished).len(), 1);
    assert_eq!(of(&unfinished.replace("true", "false")).len(), 0);
}

/// An estimate from 50 and 40 km/h has ΔV of some 50 km/h. A bound of 30 leaves that as it is, one of 55
/// leaves what is above it, and none reaches 120.
#[test]
fn an_estimate_takes_a_record_that_ends_early_as_a_bound() {
    let of = |last: u32| {
        let lines = format!(
            "pulse = {{ time = \"0 20 40 60 80 ms\", delta_v_longitudinal = \"0 -5 -12 -20 -{last} km/h\" }}"
        );
        let case = head_on(&lines).case;
        let plan = EstimatePlan { particles: 128, seed: 1, prior: None, pieces: PieceDetail::Apart };
        let found = estimate(&case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
        let delta_v = found.output(DELTA_V.of_vehicle(VehicleId::One)).unwrap().posterior.median.value * 3.6;
        (below(&found.warnings), delta_v)
    };
    let [(kept, low), (_, high)] = [of(30), of(55)];
    assert_eq!(kept, [[0.0; 2]; 0]);
    assert!(low > 47.0 && low < 52.0 && high > low + 2.0 && high < 60.0, "{low} {high}");
    let [[recorded, found]] = of(120).0[..] else { panic!() };
    assert!((recorded - 120.0).abs() < 1e-9 && found > 45.0 && found < 110.0, "{found}");
}

/// Keys that the estimate cannot use, as the vehicle cannot be followed to its rest, leave the exact answer
/// as it is.
#[test]
fn what_cannot_be_weighed_leads_nowhere() {
    let text = head_on("speed = \"51 km/h\"").source.text().replacen("speed = \"50 km/h\"\n", "", 1).replace(
        "[impact]",
        "[vehicle1.crush]\nside = \"front\"\nwidth = \"1.5 m\"\ndepths = \"30 30 cm\"\nstiffness = { category = 3 }\n\
         [vehicle2.crush]\nside = \"front\"\nwidth = \"1.5 m\"\ndepths = \"30 30 cm\"\nstiffness = { category = 3 }\n\
         [estimate]\ncrush_bias = \"100 %\"\n[reconstruct]\nfind = \"vehicle1.speed\"\n[impact]",
    );
    let is_weighed = |text: &str| {
        let case = CaseFile::parse("case.toml", text).unwrap_or_else(|errors| panic!("{errors}")).case;
        analysis::reconstruct(&case).unwrap().can_be_weighed
    };
    assert!(is_weighed(&text));
    let rest = "after = { rest = { x = \"9 m\", y = \"2 m\", heading = \"20 deg\" } }\n";
    let unusable = text.replace("[vehicle1.recorder]\nspeed = \"51 km/h\"\n", "").replacen(
        "heading",
        &format!("{rest}heading"),
        1,
    );
    assert!(unusable.contains("after"));
    assert!(!is_weighed(&unusable));
}

#[test]
fn an_estimate_takes_the_table_as_evidence() {
    let evidence = |recorder: &str| {
        let text = head_on(recorder)
            .source
            .text()
            .replace("speed = \"50 km/h\"", "")
            .replace("speed = \"40 km/h\"", "");
        estimate_evidence(&CaseFile::parse("case.toml", &text).unwrap().case).unwrap()
    };
    assert_eq!(evidence(&table(50)), ["vehicle1.recorder.speed"]);
    // A table of a vehicle that stood is left out; a pulse that was cut off is a bound.
    assert_eq!(evidence(&table(0)), [""; 0]);
    let whole = "pulse = { time = \"0 20 40 60 80 100 120 ms\", delta_v_longitudinal = \"0 -10 -25 -40 -49 -49 -49 km/h\" }";
    assert_eq!(evidence(whole), ["vehicle1.recorder.delta_v"]);
    assert_eq!(evidence(&whole.replace("-40 -49 -49 -49", "-40 -49 -59 -69")), ["vehicle1.recorder.delta_v"]);
    assert_eq!(evidence(&whole.replace("-10 -25 -40 -49 -49 -49", "0 0 0 0 0 0")), [""; 0]);
}

/// A recorder 1 m ahead of the centre of gravity; the vehicle then turns to the left by 90 °/s = π/2 rad/s:
/// its stored ΔV to the left is too large by π/2 m/s.
#[test]
fn a_recorder_away_from_the_centre_is_taken_there() {
    let file = head_on(
        "pulse = { time = \"0 20 40 60 80 100 ms\", delta_v_longitudinal = \"0 -20 -40 -49 -49 -49 km/h\", \
         delta_v_lateral = \"0 -4 -8 -10 -10 -10 km/h\" }\nat = { x = \"1 m\", y = \"0 m\" }\nyaw_rate = \"90 deg/s\"",
    );
    let told = file.case.vehicles[0].recorder.as_ref().unwrap().tells_delta_v(file.case.axes, 0.0).unwrap();
    assert!((told.along.unwrap() + 49.0 / 3.6).abs() < 1e-9);
    assert!((told.left.unwrap() - (10.0 / 3.6 - std::f64::consts::FRAC_PI_2)).abs() < 1e-9, "{told:?}");
}

/// The stored ΔV of one axis does not need the other. By v = ω × r with a yaw rate of π rad/s, a recorder 0.8
/// m to the left of the CG moves forward 0.8 π m/s slower than the CG, and one 0.5 m ahead of it moves to the
/// left 0.5 π m/s faster.
#[test]
fn one_axis_alone_is_taken_to_the_centre() {
    let told = |axis: &str, at: &str| {
        let file = head_on(&format!(
            "pulse = {{ time = \"0 20 40 60 80 100 ms\", delta_v_{axis} = \"0 -12 -20 -28 -28 -28 km/h\" }}\n\
             at = {at}\nyaw_rate = \"180 deg/s\""
        ));
        file.case.vehicles[0].recorder.as_ref().unwrap().tells_delta_v(file.case.axes, 0.0).unwrap()
    };
    let along = told("longitudinal", "{ x = \"-0.3 m\", y = \"0.8 m\" }");
    assert!((along.along.unwrap() - (-28.0 / 3.6 + 0.8 * std::f64::consts::PI)).abs() < 1e-9, "{along:?}");
    assert_eq!(along.left, None);
    // A pulse is positive to the right, so that this ΔV is to the left.
    let across = told("lateral", "{ x = \"0.5 m\", y = \"0.8 m\" }");
    assert!((across.left.unwrap() - (28.0 / 3.6 - 0.5 * std::f64::consts::PI)).abs() < 1e-9, "{across:?}");
    assert_eq!(across.along, None);
}

/// The same recorder in a vehicle that turned by 60 °/s before: ΔΩ is 30 °/s = π/6 rad/s.
#[test]
fn the_yaw_rate_before_the_impact_is_no_part_of_its_change() {
    let lines = "pulse = { time = \"0 20 40 60 80 100 ms\", delta_v_longitudinal = \"0 -20 -40 -49 -49 -49 km/h\", \
         delta_v_lateral = \"0 -4 -8 -10 -10 -10 km/h\" }\nat = { x = \"1 m\", y = \"0 m\" }\nyaw_rate = \"90 deg/s\"";
    let text = head_on(lines).source.text().replacen("contact =", "yaw_rate = \"60 deg/s\"\ncontact =", 1);
    let file = CaseFile::parse("case.toml", &text).unwrap();
    let reading = recorders(&file.case).unwrap().vehicles[0].clone().unwrap();
    let left = reading.delta_v.unwrap().left.unwrap();
    assert!((left - (10.0 / 3.6 - std::f64::consts::FRAC_PI_6)).abs() < 1e-9, "{left}");
}

/// The pulse contains the whole impact, but by its own flag the recorder did not finish the record.
#[test]
fn an_unfinished_record_is_a_lower_bound() {
    let lines = |incomplete: bool| {
        format!(
            "incomplete = {incomplete}\npulse = {{ time = \"0 20 40 60 80 100 120 ms\", \
             delta_v_longitudinal = \"0 -5 -12 -18 -20 -20 -20 km/h\" }}"
        )
    };
    for incomplete in [false, true] {
        let reading = recorders(&head_on(&lines(incomplete)).case).unwrap().vehicles[0].clone().unwrap();
        assert_eq!(reading.spans.len(), 3);
        assert!(reading.spans.iter().all(|span| span.complete != incomplete), "{:?}", reading.spans);
        assert_eq!(reading.delta_v.is_none(), incomplete);
        assert!(!reading.is_cut);
    }
}

/// A recorder 1 m behind and 0.9 m to the left of the centre of gravity, in a vehicle that turns to the left
/// by 90 °/s = 1.5708 rad/s: its ΔV along is 0.9 · 1.5708 = 1.4137 m/s = 5.089 km/h below that of the centre
/// of gravity, and ΔV of the rest of the impact is added to both. Of 23 km/h backward, 17.911 km/h are left;
/// of 4 km/h backward, nothing is.
#[test]
fn the_bound_of_a_cut_record_is_taken_to_the_centre() {
    for (pulse, least) in
        [("-2 -5 -9 -13 -16 -18 -20 -21 -22 -23", -17.911), ("0 -1 -1 -2 -2 -2 -3 -3 -3 -4", 0.0)]
    {
        let file = head_on(&format!(
            "pulse = {{ time = \"10 20 30 40 50 60 70 80 90 100 ms\", delta_v_longitudinal = \"{pulse} km/h\" }}\n\
             at = {{ x = \"-1 m\", y = \"0.9 m\" }}\nyaw_rate = \"90 deg/s\""
        ));
        let reading = recorders(&file.case).unwrap().vehicles[0].clone().unwrap();
        let found = reading.least_delta_v.unwrap();
        assert!(reading.delta_v.is_none() && reading.is_cut);
        assert!((found.along.unwrap() * 3.6 - least).abs() < 5e-4 && found.left.is_none(), "{found:?}");
    }
}

/// From 60 km/h at −0.5 s, with the brake off in every sample: to the impact, 0.5 s at the mean of 60 km/h
/// and the median of the speed at the impact. A brake at 0 s is kept in the point of the impact.
#[test]
fn the_path_ends_at_the_impact() {
    let path = |lines: &str| {
        let lines = format!("pre_crash = {{ {lines} }}");
        let reading = recorders(&head_on(&lines).case).unwrap().vehicles[0].clone().unwrap();
        (reading.path, reading.speed.unwrap().quantile(0.5))
    };
    let early = "time = \"-2.5 -1.5 -0.5 s\", speed = \"60 60 60 km/h\", brake = \"off off off\"";
    let (points, median) = path(early);
    let [first, .., last, impact] = &points[..] else { panic!("{points:?}") };
    let left = 0.5 * 0.5 * (60.0 / 3.6 + median);
    assert!((last.distance.unwrap().between - left).abs() < 1e-9, "{last:?} {left}");
    assert!((first.distance.unwrap().between - left - 2.0 * 60.0 / 3.6).abs() < 1e-9, "{first:?}");
    assert_eq!((last.speed_is_stored, impact.speed_is_stored), (Some(true), Some(false)));
    assert_eq!((impact.sample.time, impact.sample.speed), (0.0, Some(median)));
    assert_eq!((impact.distance.unwrap().at_most, impact.sample.brake), (0.0, None));
    let brake = "time = \"-1 -0.5 0 s\", speed = \"60 60 - km/h\", brake = \"off off on\"";
    let (points, median) = path(brake);
    let impact = points[2].sample;
    assert_eq!((points.len(), impact.brake, impact.speed), (3, Some(true), Some(median)));
    // A speed that was stored at 0 s stays.
    let (points, _) = path(&brake.replace("60 60 -", "60 60 57"));
    assert_eq!((points.len(), points[2].speed_is_stored), (3, Some(true)));
    assert!((points[2].sample.speed.unwrap() - 57.0 / 3.6).abs() < 1e-12);
}

/// Whole miles: ±0.5 mph instead of ±0.5 km/h over 2 s, or the step in `errors.step`.
#[test]
fn the_step_of_the_speeds_counts_in_the_distance() {
    let width = |speeds: &str, errors: &str| {
        let lines = format!(
            "pre_crash = {{ time = \"-2 -1 0 s\", speed = \"{speeds}\", brake = \"off off off\" }}\n{errors}"
        );
        let reading = recorders(&head_on(&lines).case).unwrap().vehicles[0].clone().unwrap();
        let bounds = reading.path[0].distance.unwrap();
        (bounds.at_most - bounds.at_least, reading.errors.step)
    };
    let (none, zero) = width("60 58 55 mph", "errors = { step = \"0 km/h\" }");
    assert_eq!(zero, 0.0);
    for (errors, step) in [("", 0.447_04), ("errors = { step = \"2 mph\" }", 0.894_08)] {
        let (wide, found) = width("60 58 55 mph", errors);
        assert!((found - step).abs() < 1e-12 && (wide - none - 2.0 * step).abs() < 1e-9, "{wide} {none}");
    }
    // The first speed is 97 km/h, so that none of it is a whole number of miles.
    assert!((width("97 93 89 km/h", "").1 - 1.0 / 3.6).abs() < 1e-12);
}

/// Front to front, both with 40 cm of crush: CRASH3's ΔV of both is near 45 km/h, from straight ahead.
fn crushed(recorder: &str) -> CaseFile {
    let crush = "crush = { side = \"front\", width = \"150 cm\", depths = \"40 40 cm\", stiffness = { category = 3 }, pdof = \"0 deg\" }\n";
    let text = head_on(recorder).source.text().replace("contact =", &format!("{crush}contact ="));
    CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

const TWO_RECORDS: &str = "records = [\n\
    { delta_v_longitudinal = \"7 km/h\", delta_v_lateral = \"0 km/h\", speed = \"52 km/h\" },\n\
    { since_previous = \"0.9 s\", delta_v_longitudinal = \"-44 km/h\", delta_v_lateral = \"1 km/h\", speed = \"50 km/h\" },\n\
    ]";

/// A small push from behind, and then the impact: the second record is of it.
#[test]
fn the_record_of_the_impact_is_found_by_direction_and_size() {
    let file = crushed(TWO_RECORDS);
    let reading = recorders(&file.case).unwrap();
    let found = reading.vehicles[0].as_ref().unwrap();
    assert_eq!((found.of_impact.number, found.of_impact.is_taken), (Some(2), true));
    assert_eq!(found.of_impact.since_previous, Some(0.9));
    let known = found.of_impact.impact;
    assert!((30.0..60.0).contains(&(known.delta_v.unwrap() * 3.6)), "{known:?}");
    assert!(found.of_impact.probability > 0.95 && found.of_impact.cannot.is_none());
    let other = &found.others[0].of_impact;
    assert!(other.probability < 0.01 && other.cannot.is_some() && !other.is_taken, "{other:?}");
    // An estimate uses that one, and says that it does not use the other.
    let evidence = estimate_evidence(&file.case).unwrap();
    assert!(evidence.contains(&"vehicle1.recorder.speed".to_owned()), "{evidence:?}");
    let told: Vec<String> = judge(&file.case).records.into_iter().map(|(key, _)| key).collect();
    assert_eq!(told, ["vehicle1.recorder.records[1]", "vehicle1.recorder.records[2]"]);
}

/// Two records and two impacts; nothing is known about this impact, and the second record agrees exactly with
/// the other one. A record is of none with 0.1, of each impact with 0.45 times its likelihood: 1 for what is
/// not known, and for direction and size without any difference 7.0407 · 3.5462 = 24.967, by hand (0.98/(√2π
/// · 20.047°) + 0.02/2π) · 2π and 4/(0.45 √2π). The direction has 20°, and the 1.378° that the rounding of 12
/// km/h to 1 km/h gives it.
#[test]
fn records_are_of_the_impacts_in_their_order() {
    let records = "records = [{ speed = \"50 km/h\" }, { delta_v_longitudinal = \"0 km/h\", delta_v_lateral = \"12 km/h\" }]";
    let other = |when: &str| {
        let lines = format!(
            "{records}\nother_impacts = [{{ when = \"{when}\", pdof = \"90 deg\", delta_v = \"12 km/h\" }}]"
        );
        // Without [impact], nothing tells the direction of its force.
        let file = head_on(&lines);
        let text = file.source.text().split("[impact]").next().unwrap();
        let found = judge(&CaseFile::parse("case.toml", text).unwrap().case).records;
        found.into_iter().map(|(_, one)| (one.probability, one.other.unwrap())).collect::<Vec<_>>()
    };
    let alike = 0.45 * 24.967_366;
    // None and none, none and one, one and none, one and the other.
    let whole = 0.01 + 0.1 * (0.45 + alike) + 0.1 * (0.45 + 0.45) + 0.45 * alike;
    let [first, second] = other("after")[..] else { panic!("two records") };
    assert!((first.0 - 0.45 * (0.1 + alike) / whole).abs() < 1e-5, "{first:?}");
    assert!((second.1.1 - alike * (0.1 + 0.45) / whole).abs() < 1e-5 && second.1.0 == 1, "{second:?}");
    // Before this impact, it leaves no place for the first record but none or itself.
    let whole = 0.01 + 0.1 * (0.45 + alike) + 0.1 * (0.45 + 0.45) + 0.45 * 0.45;
    let [first, second] = other("before")[..] else { panic!("two records") };
    assert!((first.0 - 0.1 * 0.45 / whole).abs() < 1e-5, "{first:?}");
    assert!((second.1.1 - 0.1 * alike / whole).abs() < 1e-5, "{second:?}");
}

/// The answer is that of the record alone, to the last digit.
#[test]
fn an_estimate_uses_the_record_of_the_impact_alone() {
    let answered = |recorder: &str| {
        let text = crushed(recorder).source.text().to_owned();
        let text = text.replace("\nspeed = \"50 km/h\"\n", "\n").replace("\nspeed = \"40 km/h\"\n", "\n");
        let file = CaseFile::parse("case.toml", &text).unwrap();
        let plan = EstimatePlan { particles: 256, seed: 1, prior: None, pieces: PieceDetail::Weighed };
        let found = estimate(&file.case, &plan, &mut |_, _, _| ControlFlow::Continue(())).unwrap();
        let answers: Vec<String> = found.outputs.iter().map(|one| format!("{:?}", one.posterior)).collect();
        (answers, found.unused)
    };
    let alone = "delta_v_longitudinal = \"-44 km/h\"\ndelta_v_lateral = \"1 km/h\"\nspeed = \"50 km/h\" ";
    let (answers, unused) = answered(TWO_RECORDS);
    assert_eq!(answers, answered(alone).0);
    let other: Vec<&str> = unused
        .iter()
        .filter(|one| one.reason == UnusedReason::OtherImpact)
        .map(|one| one.key.as_str())
        .collect();
    assert_eq!(other, ["vehicle1.recorder.records[1]"]);
}

/// Records of 50 and 30 km/h that are of the impact with nearly the same probability: the answer says so.
#[test]
fn a_record_that_is_hardly_more_likely_is_told() {
    let told = |file: &CaseFile| {
        let warnings = judge(&file.case).warnings;
        let uncertain = warnings.iter().find_map(|warning| match warning {
            Warning::RecordUncertain { vehicle, used, probability } => Some((*vehicle, *used, *probability)),
            _ => None,
        });
        uncertain.map(|(vehicle, used, probability)| (vehicle, used, (100.0 * probability).round()))
    };
    // 0.09/0.19 each
    let alike = head_on("records = [{ speed = \"50 km/h\" }, { speed = \"30 km/h\" }]");
    assert_eq!(told(&alike), Some((VehicleId::One, None, 47.0)));
    assert_eq!(told(&head_on("records = [{ speed = \"50 km/h\" }]")), None);
    assert_eq!(told(&head_on("speed = \"50 km/h\"")), None);
}

/// Nothing distinguishes the records: each is of the impact with 0.09/0.19, and none is used.
#[test]
fn where_nothing_tells_records_apart_none_is_used() {
    let file = head_on("records = [{ speed = \"50 km/h\" }, { speed = \"30 km/h\" }]");
    let reading = recorders(&file.case).unwrap();
    let found = reading.vehicles[0].as_ref().unwrap();
    assert!((found.of_impact.probability - 0.09 / 0.19).abs() < 1e-12 && !found.of_impact.is_taken);
    assert_eq!(differs(&file), []);
    // A single one is of the impact, unless the damage contradicts it.
    let alone = recorders(&head_on("records = [{ speed = \"65 km/h\" }]").case).unwrap();
    assert!(alone.vehicles[0].as_ref().unwrap().of_impact.is_taken);
    assert_eq!(differs(&head_on("records = [{ speed = \"65 km/h\" }]")), [Evident::RecordedSpeed]);
    let small = crushed("delta_v_longitudinal = \"-5 km/h\"\ndelta_v_lateral = \"0 km/h\"");
    let told = judge(&small.case).records;
    assert!(
        matches!(&told[..], [(key, one)] if key == "vehicle1.recorder" && one.cannot.is_some()),
        "{told:?}"
    );
    assert!(judge(&crushed("delta_v_longitudinal = \"-40 km/h\"").case).records.is_empty());
}

/// Struck from ahead, with the direction known from the other vehicle's damage: the record of a push from the
/// side is recognised as another impact's, whether the crush of this vehicle was measured or only its energy
/// is known.
#[test]
fn the_force_on_the_other_vehicle_tells_records_apart() {
    let records = "records = [\n\
         { delta_v_longitudinal = \"-25 km/h\", delta_v_lateral = \"2 km/h\" },\n\
         { delta_v_longitudinal = \"2 km/h\", delta_v_lateral = \"-24 km/h\" },\n]";
    let damage = "side = \"front\", width = \"150 cm\", depths = \"22 22 cm\", stiffness = { category = 3 }";
    for one in [damage, "side = \"front\", ees = \"30 km/h\""] {
        let text = head_on(records).source.text().to_owned();
        let text = text.replacen("contact =", &format!("crush = {{ {one} }}\ncontact ="), 1);
        let two = format!("[vehicle2]\ncrush = {{ {damage}, pdof = \"0 deg\" }}");
        let file = CaseFile::parse("case.toml", &text.replace("[vehicle2]", &two)).unwrap();
        let found = recorders(&file.case).unwrap().vehicles[0].clone().unwrap();
        assert_eq!((found.of_impact.number, found.of_impact.is_taken), (Some(1), true), "{one}");
        // Vehicle 2 is pushed straight along its heading, opposite to that of vehicle 1.
        assert!(found.of_impact.impact.force_direction.unwrap().abs() < 1e-9, "{one}");
        assert!(found.of_impact.probability > 0.95, "{one}: {}", found.of_impact.probability);
    }
}

/// Two cars that meet front to front, with unknown speeds and the crush of each, without a PDOF.
fn sought(crush: [&str; 2], recorder: &str) -> CaseFile {
    let mut text = head_on(recorder).source.text().to_owned();
    for (speed, crush) in ["50", "40"].into_iter().zip(crush) {
        let crush = format!("crush = {{ side = \"front\", {crush} }}\n");
        text = text.replacen(&format!("speed = \"{speed} km/h\"\n"), &crush, 1);
    }
    CaseFile::parse("case.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Both have an EES of 38 km/h. By hand, they approach with v = 2·38/√(1 − 0.1²) km/h, and have a ΔV of
/// 1.1 v/2 = 42.0 km/h: a record of 3 km/h is not of that impact, and one of 42 is.
#[test]
fn records_are_told_apart_without_a_pdof() {
    let records = "records = [\n\
         { delta_v_longitudinal = \"-3 km/h\", speed = \"60 km/h\" },\n\
         { delta_v_longitudinal = \"-42 km/h\", speed = \"58 km/h\" },\n]";
    let file = sought(["ees = \"38 km/h\""; 2], records);
    let reading = recorders(&file.case).unwrap();
    let of_impact = reading.vehicles[0].as_ref().unwrap().of_impact;
    assert_eq!(of_impact.number, Some(2), "{of_impact:?}");
    assert!(of_impact.probability > 0.97, "{of_impact:?}");
    let delta_v = 3.6 * of_impact.impact.delta_v.unwrap();
    assert!((delta_v - 42.01).abs() < 0.01, "{delta_v}");
    assert!(of_impact.impact.force_direction.unwrap().abs() < 1e-9);
    assert!(estimate_evidence(&file.case).unwrap().iter().any(|key| key == "vehicle1.recorder.speed"));
}

/// The crush that a balance of forces would give is no evidence; without a PDOF there is no such balance, and
/// the measured crush of the other vehicle stays what it is.
#[test]
fn crush_by_the_balance_of_forces_takes_nothing_from_that_of_the_other() {
    let of = |evidence: &str| format!("width = \"120 cm\", stiffness = {{ category = 3 }}, {evidence}");
    let crush = [of("depths = \"40 35 20 5 cm\""), of("from_force_balance = true")];
    let file = sought(crush.each_ref().map(String::as_str), "");
    assert_eq!(estimate_evidence(&file.case).unwrap(), ["crush"]);
}
