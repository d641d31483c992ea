//! Where a pulse begins and ends, and its ΔV at the center of gravity.

use proptest::prelude::{Strategy, any, prop, prop_assert, prop_assert_eq, proptest};
use proptest::test_runner::Config;
use recorder::{
    CrashPulse, EventRecord, KnownImpact, MatchErrors, Mismatch, OneAxis, PulseFault, PulseRule, PulseSample,
    RecordMatch, delta_v_at_center, force_direction, match_records,
};

const KMH: f64 = 1.0 / 3.6;

/// A half sine of acceleration between `start` and `start + 0.1` s with this ΔV, sampled every `step` until
/// `end`.
fn half_sine(delta_v: f64, start: f64, step: f64, end: f64) -> CrashPulse {
    let sample = |k: u32| {
        let time = step * f64::from(k);
        let share = ((time - start) / 0.1).clamp(0.0, 1.0);
        // ∫ sin = (1 − cos π s) / 2
        let value = delta_v * 0.5 * (1.0 - (std::f64::consts::PI * share).cos());
        PulseSample { time, longitudinal: Some(-value), lateral: None }
    };
    let within = |k: &u32| step * f64::from(*k) <= end + 1e-9;
    CrashPulse::new((0..).take_while(within).map(sample).collect()).unwrap()
}

#[test]
fn a_half_sine_begins_and_ends_where_it_does() {
    let pulse = half_sine(50.0 * KMH, 0.03, 0.01, 0.25);
    for rule in PulseRule::ALL {
        let span = pulse.span(rule).unwrap();
        assert!(span.complete, "{rule:?}");
        assert!((span.start - 0.03).abs() < 0.021 && (span.end - 0.13).abs() < 0.021, "{span:?}");
        assert!((span.resultant() - 50.0 * KMH).abs() < 1.5 * KMH, "{span:?}");
        assert_eq!(span.delta_v[1], None);
    }
    assert!(!pulse.is_cut());
    // 50 km/h in a half sine of 0.1 s has its greatest acceleration, π/2 of the mean, in its middle.
    let greatest =
        pulse.accelerations().into_iter().map(|(_, [along, _])| -along.unwrap()).fold(0.0, f64::max);
    assert!((greatest / (50.0 * KMH / 0.1 * std::f64::consts::PI / 2.0) - 1.0).abs() < 0.02);
}

#[test]
fn a_record_that_ends_within_the_impact_is_a_lower_bound() {
    let pulse = half_sine(50.0 * KMH, 0.0, 0.01, 0.07);
    let span = pulse.span(PulseRule::CHANGE).unwrap();
    assert!(!span.complete && pulse.is_cut());
    assert!(span.resultant() < 45.0 * KMH);
    assert!(!pulse.span(PulseRule::GreatestDeltaV).unwrap().complete);
    // One that changes by 0.7 km/h in 20 ms has ended, and one that never moves has no impact.
    let flat = CrashPulse::new(
        (0..20)
            .map(|k| PulseSample { time: 0.01 * f64::from(k), longitudinal: Some(0.0), lateral: None })
            .collect(),
    );
    assert_eq!(flat.unwrap().span(PulseRule::CHANGE), None);
}

/// A last digit that flickers after the impact is not an impact: it ends where ΔV no longer changes.
#[test]
fn a_flickering_digit_does_not_prolong_an_impact() {
    let stored =
        [0.0, 6.0, 18.0, 30.0, 41.0, 47.0, 50.0, 50.0, 50.0, 50.0, 51.0, 50.0, 50.0, 50.0, 50.0, 50.0];
    let samples = (0_u32..).zip(stored).map(|(k, value)| PulseSample {
        time: 0.01 * f64::from(k),
        longitudinal: Some(-value * KMH),
        lateral: None,
    });
    let pulse = CrashPulse::new(samples.collect()).unwrap();
    for rule in [PulseRule::CHANGE, PulseRule::TWO_G] {
        let span = pulse.span(rule).unwrap();
        assert!((span.end - 0.07).abs() < 0.011 && span.complete, "{span:?}");
    }
    assert!(!pulse.is_cut());
}

/// IIHS CF09009: longitudinal ΔV is greatest at 58 ms with −20.40 mph, and −16.60 at the end of the record at
/// 78 ms.
#[test]
fn iihs_cf09009_ends_before_the_impact_does() {
    let mph = 0.44704;
    let sample = |k: u32| {
        let time = 0.002 * f64::from(k);
        let value = if time <= 0.058 { 20.40 * time / 0.058 } else { 20.40 - 3.80 * (time - 0.058) / 0.02 };
        PulseSample { time, longitudinal: Some(-value * mph), lateral: None }
    };
    let pulse = CrashPulse::new((0..40).map(sample).collect()).unwrap();
    assert!(pulse.is_cut());
    let at_end = pulse.samples().last().unwrap().longitudinal.unwrap();
    assert!((at_end + 16.60 * mph).abs() < 1e-9, "{at_end}");
    let greatest = pulse.span(PulseRule::GreatestDeltaV).unwrap();
    assert!((greatest.end - 0.058).abs() < 1e-9 && greatest.complete);
}

/// Samples 10 ms apart, in km/h.
fn pulse(along: &[f64], across: &[f64]) -> CrashPulse {
    let sample = |k: usize| PulseSample {
        time: 0.01 * k as f64,
        longitudinal: along.get(k).map(|value| value * KMH),
        lateral: across.get(k).map(|value| value * KMH),
    };
    CrashPulse::new((0..along.len().max(across.len())).map(sample).collect()).unwrap()
}

/// From −28 km/h to 0 in 10 ms and no more: 79 g the other way, and then nothing. The zeros are not a ΔV.
#[test]
fn zeros_that_fill_up_a_record_are_no_samples() {
    let stored = [0.0, -2.0, -7.0, -13.0, -20.0, -25.0, -28.0];
    let padded = pulse(&[&stored[..], &[0.0; 3]].concat(), &[]);
    assert_eq!(padded.samples(), pulse(&stored, &[]).samples());
    assert!((padded.padded_from().unwrap() - 0.07).abs() < 1e-12 && padded.is_cut());
    for rule in PulseRule::ALL {
        let span = padded.span(rule).unwrap();
        assert!(!span.complete && (span.resultant() - 28.0 * KMH).abs() < 1e-9, "{span:?}");
    }
    // An impact that had ended by the rule before the record was filled up is as complete as without zeros.
    let ended = [0.0, -9.0, -18.0, -20.0, -20.0, -20.0];
    for pulse in [pulse(&ended, &[]), pulse(&[&ended[..], &[0.0; 2]].concat(), &[])] {
        assert!(pulse.span(PulseRule::CHANGE).unwrap().complete && !pulse.is_cut(), "{pulse:?}");
    }
    // A ΔV that really returns to 0, and one whose last digit does.
    for whole in
        [&[0.0, -8.0, -12.0, -9.0, -5.0, -2.0, 0.0, 0.0, 0.0][..], &[0.0, -1.0, -2.0, -2.0, 0.0, 0.0]]
    {
        let whole = pulse(whole, &[]);
        assert_eq!(whole.padded_from(), None);
        assert!(whole.samples().last().unwrap().longitudinal == Some(0.0));
    }
}

/// CIREN 12286: after 100 ms at 59.57 km/h, both axes change by one step of 1.61 km/h (1 mph) in the last
/// sample. That is 2.28 km/h in 10 ms, and yet no impact. Two steps are, at once or in turn.
#[test]
fn one_step_of_the_last_digit_does_not_cut_a_record() {
    let stored = [0.0, -22.54, -35.42, -46.69, -53.13, -56.35, -59.57, -59.57, -59.57, -59.57];
    let across = [0.0, 3.22, 8.05, 6.44, 3.22, 4.83, 6.44, 6.44, 6.44, 6.44];
    for (more, cut) in [
        (&[-61.18][..], false),
        (&[-61.18, -59.57], false),
        (&[-62.79], true),
        (&[-61.18, -62.79], true),
        (&[-57.96, -56.35, -54.74], true),
    ] {
        let along = [&stored[..], more].concat();
        let across = [&across[..], &vec![4.83; more.len()]].concat();
        let pulse = pulse(&along, &across);
        assert_eq!(pulse.is_cut(), cut, "{more:?}");
        assert!(cut || pulse.span(PulseRule::GreatestDeltaV).unwrap().complete, "{more:?}");
    }
}

/// The lateral part ends at 30 ms: longitudinal ΔV is nevertheless 20 km/h, at 40 ms, and complete.
#[test]
fn an_axis_that_ends_early_does_not_end_the_other() {
    let along = [0.0, -5.0, -12.0, -18.0, -20.0, -20.0, -20.0, -20.0];
    for found in
        [pulse(&along, &[0.0, 1.0, 3.0, 5.0]), pulse(&along, &[]).with(&pulse(&[], &[0.0, 1.0, 3.0, 5.0]))]
    {
        assert_eq!(found.samples().len(), 8);
        assert!((found.alone_from().unwrap() - 0.03).abs() < 1e-12, "{found:?}");
        let span = found.span(PulseRule::GreatestDeltaV).unwrap();
        assert!(span.complete && (span.end - 0.04).abs() < 1e-12, "{span:?}");
        assert!(
            (span.delta_v[0].unwrap() + 20.0 * KMH).abs() < 1e-9 && span.delta_v[1].is_none(),
            "{span:?}"
        );
    }
    assert_eq!(pulse(&along, &along).alone_from(), None);
    assert_eq!(pulse(&along, &[]).alone_from(), None);
    // A cell without a value between others takes its sample with it.
    let sample = |k: usize| PulseSample {
        time: 0.01 * k as f64,
        longitudinal: Some(along[k] * KMH),
        lateral: (k != 2).then_some(0.0),
    };
    assert_eq!(CrashPulse::new((0..8).map(sample).collect()).unwrap().samples().len(), 7);
}

/// 10 km/h, 60 ms of nothing, and 20 more: the rule of 49 CFR 563.5 ends at the pause, the others include
/// both.
#[test]
fn a_pause_in_a_pulse_is_told() {
    let two = [
        0.0, -2.0, -4.0, -6.0, -8.0, -10.0, -10.0, -10.0, -10.0, -10.0, -10.0, -15.0, -25.0, -30.0, -30.0,
        -30.0, -30.0,
    ];
    let two = pulse(&two, &[]);
    let size = |rule| two.span(rule).unwrap().resultant() / KMH;
    assert!(
        (size(PulseRule::CHANGE) - 10.0).abs() < 1e-9
            && (size(PulseRule::GreatestDeltaV) - 30.0).abs() < 1e-9
    );
    // A window of 20 ms that begins at 40 ms changes by 2 km/h; that from 90 ms on by 5.
    let [from, to] = two.pause().unwrap();
    assert!((from - 0.06).abs() < 1e-12 && (to - 0.09).abs() < 1e-12, "{from} {to}");
    assert_eq!(half_sine(50.0 * KMH, 0.03, 0.01, 0.25).pause(), None);
    // A last digit that flickers is not a second impact.
    let flickers =
        [0.0, -6.0, -18.0, -30.0, -40.0, -40.0, -40.0, -40.0, -40.0, -41.0, -40.0, -40.0, -40.0, -40.0];
    assert_eq!(pulse(&flickers, &[]).pause(), None);
}

#[test]
fn delta_v_at_the_center_is_less_the_rotation() {
    // A recorder 1 m ahead of the center, and an impact that turns the vehicle at 3 rad/s to the left: its ΔV
    // to the left is 3 m/s greater than the center's.
    assert_eq!(delta_v_at_center([-5.0, 5.0], 3.0, [1.0, 0.0]), [-5.0, 2.0]);
    // 1 m to the left of the center, the rotation takes 3 m/s off the forward speed of the recorder.
    assert_eq!(delta_v_at_center([-5.0, 5.0], 3.0, [0.0, 1.0]), [-2.0, 5.0]);
}

#[test]
fn forces_come_from_where_the_clock_says() {
    let degrees = |delta_v| force_direction(delta_v).to_degrees();
    // Slowed: 12 o'clock. Pushed to the left: from 3 o'clock. Pushed forward: from 6.
    assert!((degrees([-5.0, 0.0]) - 0.0).abs() < 1e-9);
    assert!((degrees([0.0, -5.0]) - 90.0).abs() < 1e-9);
    assert!((degrees([5.0, 0.0]).abs() - 180.0).abs() < 1e-9);
    assert!((degrees([-5.0, -5.0]) - 45.0).abs() < 1e-9);
}

#[test]
fn what_is_no_pulse_is_refused() {
    let sample = |time: f64, along: f64| PulseSample { time, longitudinal: Some(along), lateral: None };
    assert_eq!(CrashPulse::new(vec![sample(0.0, 1.0)]), Err(PulseFault::TooFew { found: 1 }));
    assert_eq!(
        CrashPulse::new(vec![sample(0.0, 1.0), sample(0.0, 1.0)]),
        Err(PulseFault::TimesTurn { sample: 2, time: 0.0, before: 0.0 })
    );
    assert_eq!(
        CrashPulse::new(vec![sample(0.0, 1.0), sample(0.1, f64::NAN)]),
        Err(PulseFault::NotFinite { sample: 2 })
    );
}

#[test]
fn errors_of_a_match_have_their_ranges() {
    let usual = MatchErrors::default();
    assert_eq!(usual.check(), Ok(()));
    for (bad, name) in [
        (MatchErrors { direction: 0.0, ..usual }, "direction"),
        (MatchErrors { direction: -0.3, ..usual }, "direction"),
        (MatchErrors { size: 0.0, ..usual }, "size"),
        (MatchErrors { of_none: 0.0, ..usual }, "of_none"),
        (MatchErrors { of_none: 2.0, ..usual }, "of_none"),
        (MatchErrors { of_none: f64::NAN, ..usual }, "of_none"),
    ] {
        assert_eq!(bad.check().unwrap_err().name, name);
    }
}

/// Crash 29357: a record of 9 km/h, where a common velocity would need 71.
#[test]
fn a_record_of_another_impact_is_none_of_this() {
    let errors = MatchErrors::default();
    let impact = KnownImpact { force_direction: Some(0.0), delta_v: Some(71.0 * KMH) };
    let record = |delta_v: f64, complete| EventRecord {
        delta_v: Some(delta_v * KMH),
        complete,
        ..EventRecord::default()
    };
    let found = match_records(&[record(9.0, true)], &[impact], &errors).remove(0);
    assert!(found.none > 0.99, "{found:?}");
    let Some(Mismatch::Size { ratio }) = found.cannot[0] else { panic!("{found:?}") };
    assert!((ratio - 9.0 / 71.0).abs() < 1e-9);
    // The beginning of a record that was cut may be that small.
    assert_eq!(match_records(&[record(9.0, false)], &[impact], &errors)[0].cannot, [None]);
    assert!(match_records(&[record(65.0, true)], &[impact], &errors)[0].impacts[0] > 0.9);
}

/// Two records and two impacts, all assignments counted by hand: both in order, one of them, none.
#[test]
fn records_are_matched_in_order() {
    let errors = MatchErrors::default();
    let at = |degrees: f64| Some(degrees.to_radians());
    let impacts = [0.0, 90.0].map(|degrees| KnownImpact { force_direction: at(degrees), delta_v: None });
    let records = [5.0, 80.0].map(|degrees| EventRecord {
        force_direction: at(degrees),
        complete: true,
        ..EventRecord::default()
    });
    let found = match_records(&records, &impacts, &errors);
    assert!(found[0].impacts[0] > 0.95 && found[1].impacts[1] > 0.95, "{found:?}");
    assert!(matches!(found[0].cannot[..], [None, Some(Mismatch::Direction { .. })]));
    for one in &found {
        assert!((one.impacts.iter().sum::<f64>() + one.none - 1.0).abs() < 1e-12);
    }
    // Nothing known: of one record and two impacts each is as likely.
    let blank = match_records(&[EventRecord::default()], &[KnownImpact::default(); 2], &errors).remove(0);
    assert!((blank.impacts[0] - 0.45).abs() < 1e-12 && (blank.none - 0.1).abs() < 1e-12, "{blank:?}");
    // Two records the wrong way round cannot both be of their impact: because of the order, one of them must
    // belong to no known impact.
    let turned = match_records(&[records[1], records[0]], &impacts, &errors);
    assert!(turned[0].impacts[1] + turned[1].impacts[0] < 1.02, "{turned:?}");
}

fn any_impact() -> impl Strategy<Value = KnownImpact> {
    let direction = proptest::option::of(-3.1..3.1_f64);
    (direction, proptest::option::of(2.0..110.0_f64)).prop_map(|(force_direction, delta_v)| KnownImpact {
        force_direction,
        delta_v: delta_v.map(|delta_v| delta_v * KMH),
    })
}

fn any_record() -> impl Strategy<Value = EventRecord> {
    (any_impact(), any::<bool>()).prop_map(|(impact, complete)| EventRecord {
        force_direction: impact.force_direction,
        delta_v: impact.delta_v,
        complete,
        ..EventRecord::default()
    })
}

proptest! {
    #![proptest_config(Config { cases: 20_000, failure_persistence: None, ..Config::default() })]

    /// "Cannot" is said where the probability is below 1 %, and nowhere else.
    #[test]
    fn the_words_follow_from_the_probability(
        records in prop::collection::vec(any_record(), 1..4),
        impacts in prop::collection::vec(any_impact(), 1..4),
    ) {
        for (record, found) in records.iter().zip(match_records(&records, &impacts, &MatchErrors::default())) {
            for ((probability, cannot), impact) in found.impacts.iter().zip(&found.cannot).zip(&impacts) {
                prop_assert_eq!(cannot.is_some(), *probability < 0.01, "{:?}", found);
                prop_assert_eq!(cannot.is_some(), RecordMatch::words(*probability).starts_with("cannot"));
                // The reason is the larger difference, in multiples of 0.45 in ln ΔV and of 20° in direction,
                // with the rounding of both parts to 1 km/h: 16.5° for a ΔV of 1 km/h, half for 2.
                let rounding = record.delta_v.map_or(0.0, |size| (KMH / 12_f64.sqrt() / size).to_degrees());
                let sd = 20_f64.hypot(rounding);
                let turned = |a: f64, b: f64| (a - b).abs().min(std::f64::consts::TAU - (a - b).abs());
                let direction = record.force_direction.zip(impact.force_direction);
                let direction = direction.map_or(0.0, |(a, b)| turned(a, b).to_degrees() / sd);
                let size = record.delta_v.zip(impact.delta_v).map_or(0.0, |(a, b)| (a / b).ln() / 0.45);
                let size = if record.complete { size.abs() } else { size.max(0.0) };
                match cannot {
                    Some(Mismatch::Direction { difference }) => {
                        prop_assert!(direction > 2.0 && direction >= size - 1e-9);
                        prop_assert!((difference.to_degrees() / sd - direction).abs() < 1e-9);
                    }
                    Some(Mismatch::Size { ratio }) => {
                        prop_assert!(size > 2.0 && size >= direction - 1e-9);
                        prop_assert!((ratio.ln().abs() / 0.45 - size).abs() < 1e-9);
                    }
                    Some(Mismatch::Others) => prop_assert!(direction <= 2.0 + 1e-9 && size <= 2.0 + 1e-9),
                    None => {}
                }
            }
        }
    }
}

/// From behind instead of from the front, with exactly the same size: 0.9 · L / (0.9 · L + 0.1) with
/// L = 0.02 · 4/(0.45 √(2π)) is 39 %, which is not a "cannot".
#[test]
fn a_reversed_direction_alone_excludes_nothing() {
    let impact = KnownImpact { force_direction: Some(0.0), delta_v: Some(40.0 * KMH) };
    let record = EventRecord {
        force_direction: Some(std::f64::consts::PI),
        delta_v: Some(40.0 * KMH),
        complete: true,
        ..EventRecord::default()
    };
    let found = match_records(&[record], &[impact], &MatchErrors::default()).remove(0);
    assert!((found.impacts[0] - 0.390).abs() < 0.001, "{found:?}");
    assert_eq!(found.cannot, [None]);
    assert_eq!(RecordMatch::words(found.impacts[0]), "may be of this impact");
}

/// The density of a normal number with mean 0.
fn normal(value: f64, sd: f64) -> f64 {
    (-0.5 * (value / sd).powi(2)).exp() / (sd * std::f64::consts::TAU.sqrt())
}

/// The middles of `count` equal parts from 0 to 1.
fn middles(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| (f64::from(k) + 0.5) / f64::from(count))
}

/// The likelihood of a ΔV in a record of a share of an impact, the mean over the share, over that for a
/// record of none: 1/4 from 2 km/h on, and less for a share of 2 km/h.
fn of_share(own: f64, whole: f64) -> f64 {
    let sum: f64 = middles(4_000).map(|share| normal((own / whole / share).ln(), 0.45)).sum();
    4.0 * sum / 4_000.0 / (own / 2.0).min(1.0)
}

/// 2.1 km/h of a record that was not finished, and 28.2 of a complete one, for an impact of 29: of the
/// assignments, the first record is of it, the second is, or neither is.
#[test]
fn a_small_piece_of_a_record_is_far_less_probable_than_a_whole_one() {
    let impact = KnownImpact { force_direction: None, delta_v: Some(29.0 * KMH) };
    let record =
        |size: f64, complete| EventRecord { delta_v: Some(size * KMH), complete, ..EventRecord::default() };
    let piece = 0.9 * 0.1 * of_share(2.1, 29.0);
    let whole = 0.9 * 0.1 * 4.0 * normal((28.2_f64 / 29.0).ln(), 0.45);
    let sum = piece + whole + 0.1 * 0.1;
    let found = match_records(&[record(2.1, false), record(28.2, true)], &[impact], &MatchErrors::default());
    assert!((found[0].impacts[0] - piece / sum).abs() < 1e-4, "{found:?} {}", piece / sum);
    assert!((found[1].impacts[0] - whole / sum).abs() < 1e-4, "{found:?} {}", whole / sum);
    assert!(found[0].impacts[0] < 0.1 && found[1].impacts[0] > 0.88, "{found:?}");
    // No piece is more probable than a complete record that matches, nor a tiny one than a large one.
    let of = |size: f64, complete| {
        match_records(&[record(size, complete)], &[impact], &MatchErrors::default())[0].impacts[0]
    };
    let pieces = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0].map(|size| of(size, false));
    assert!(pieces.windows(2).all(|pair| pair[0] < pair[1] + 1e-6), "{pieces:?}");
    assert!(pieces.iter().all(|piece| *piece < of(29.0, true)), "{pieces:?}");
    assert!((0..120).all(|size| of(f64::from(size), false) < of(29.0, true)));
}

/// The longitudinal axis alone, for an impact of 29 km/h from 80° right: the part along it is 5 km/h at an
/// error of 0°, and 18.6 at 30°. By the sum over all directions, with 2 % of them anywhere.
#[test]
fn one_axis_shows_the_part_of_the_impact_along_it() {
    let direction = 80_f64.to_radians();
    let impact = KnownImpact { force_direction: Some(direction), delta_v: Some(29.0 * KMH) };
    let expected = |part: f64, complete: bool| -> f64 {
        let turn = std::f64::consts::TAU;
        let of = |share: f64| {
            let off = turn * (share - 0.5);
            let along = -29.0 * (direction + off).cos();
            let density = 0.98 * normal(off, 20_f64.to_radians()) * turn + 0.02;
            let own = part.abs().max(0.5);
            let whole = along.abs().max(0.5);
            let size = if complete { 4.0 * normal((own / whole).ln(), 0.45) } else { of_share(own, whole) };
            if along * part > 0.0 { 2.0 * density * size } else { 0.0 }
        };
        // Of none, with a force from anywhere, a part below 2 km/h is one of a ΔV above it: |cos| < part/2.
        let of_none = if part.abs() < 2.0 { (part.abs() / 2.0).asin() / (turn / 4.0) } else { 1.0 };
        middles(720).map(of).sum::<f64>() / 720.0 / of_none
    };
    let of = |part: f64, complete: bool| {
        let record = EventRecord::new([Some(part * KMH), None], complete);
        match_records(&[record], &[impact], &MatchErrors::default())[0].impacts[0]
    };
    for (part, complete) in [(-9.0, true), (-1.0, true), (-9.0, false), (9.0, true), (-29.0, true)] {
        let likelihood = 0.9 * expected(part, complete);
        let probability = likelihood / (likelihood + 0.1);
        let found = of(part, complete);
        assert!((found - probability).abs() < 3e-3, "{part} {complete}: {found} {probability}");
    }
    // Of two records, that with the part that was to be expected; a part of 0 has no sign.
    let two = [-1.0, -9.0].map(|part: f64| EventRecord::new([Some(part * KMH), None], true));
    let [first, second] = &match_records(&two, &[impact], &MatchErrors::default())[..] else { panic!() };
    assert!(first.impacts[0] < 0.3 && second.impacts[0] > 0.65, "{first:?} {second:?}");
    assert!((of(0.0, true) - of(-0.0, true)).abs() < 1e-12);
    // Without the direction and the size of the impact, an axis shows nothing.
    let record = EventRecord::new([Some(-9.0 * KMH), None], true);
    let blank = match_records(&[record], &[KnownImpact::default()], &MatchErrors::default());
    assert!((blank[0].impacts[0] - 0.9).abs() < 1e-12, "{blank:?}");
}

/// Records drawn as the program assumes, rounded to 1 km/h: where it says that a share of them is of the
/// impact, that share is. Half have one axis, and half hold a part of the impact.
#[test]
fn the_probability_of_a_record_is_how_often_it_is_of_the_impact() {
    let mut seed = 5_u64;
    let mut uniform = move || {
        seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let turn = std::f64::consts::TAU;
    // (sum of probabilities, number of the impact, number)
    let mut bins = [[(0.0_f64, 0.0_f64, 0.0_f64); 5]; 4];
    for _ in 0..30_000 {
        let normal: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let other: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let (direction, whole) = (turn * uniform(), 10.0 * 6_f64.powf(uniform()));
        let (is_of_it, complete, has_one) = (uniform() < 0.9, uniform() < 0.5, uniform() < 0.5);
        let share = if complete { 1.0 } else { uniform() };
        let (size, from) = if is_of_it {
            let off = if uniform() < 0.02 { turn * uniform() } else { 20_f64.to_radians() * normal };
            (whole * (0.45 * other).exp() * share, direction + off)
        } else {
            (2.0 * (4.0 * uniform()).exp() * share, turn * uniform())
        };
        let along = -size * from.cos();
        let parts = [Some(along), (!has_one).then_some(-size * from.sin())];
        let parts = parts.map(|part| part.map(|part| part.round() * KMH));
        let impact = KnownImpact { force_direction: Some(direction), delta_v: Some(whole * KMH) };
        let record = EventRecord::new(parts, complete);
        let p = match_records(&[record], &[impact], &MatchErrors::default())[0].impacts[0];
        let place = [0.2, 0.5, 0.8, 0.95].iter().filter(|limit| p > **limit).count();
        let bin = &mut bins[usize::from(has_one) * 2 + usize::from(complete)][place];
        *bin = (bin.0 + p, bin.1 + f64::from(u8::from(is_of_it)), bin.2 + 1.0);
    }
    for (kind, bins) in bins.iter().enumerate() {
        for (expected, found, count) in bins.iter().filter(|bin| bin.2 > 100.0) {
            println!("{kind} {count} {:.3} {:.3}", expected / count, found / count);
            // Rounding adds to it, and a small ΔV or part of it tells more than the program knows.
            assert!((expected - found).abs() / count < 0.1, "{kind}: {expected} {found} {count}");
        }
    }
}

/// Stored in steps of 1 km/h, (−1, 0) km/h came from anywhere within some 45° of the front, and (0, 0) from
/// anywhere.
#[test]
fn a_small_delta_v_shows_little_of_its_direction() {
    let impact = KnownImpact { force_direction: Some(1.0), delta_v: None };
    let of = |along: f64| {
        let record = EventRecord::new([Some(along * KMH), Some(0.0)], true);
        (record.force_direction, match_records(&[record], &[impact], &MatchErrors::default())[0].impacts[0])
    };
    // The standard deviations of 20° and of 1/√12 km/h across 1 km/h add up to 25.9°.
    let likelihood = |sd: f64| 0.98 * normal(1.0, sd.to_radians()) * std::f64::consts::TAU + 0.02;
    let probability = |likelihood: f64| 0.9 * likelihood / (0.9 * likelihood + 0.1);
    let [(none, anywhere), (small, near), (large, far)] = [of(0.0), of(-1.0), of(-40.0)];
    assert_eq!((none, small, large), (None, Some(0.0), Some(0.0)));
    assert!((anywhere - 0.9).abs() < 1e-12, "{anywhere}");
    let rounded = (1.0 / 12_f64.sqrt()).to_degrees();
    assert!((near - probability(likelihood(20_f64.hypot(rounded)))).abs() < 1e-9, "{near}");
    assert!(
        (far - probability(likelihood(20_f64.hypot(rounded / 40.0)))).abs() < 1e-9 && far < near,
        "{far}"
    );
}

#[test]
fn a_record_has_the_axes_that_were_stored() {
    let both = EventRecord::new([Some(-3.0), Some(-4.0)], true);
    assert!((both.delta_v.unwrap() - 5.0).abs() < 1e-12 && both.one_axis.is_none() && both.complete);
    assert!((both.force_direction.unwrap() - (4_f64 / 3.0).atan()).abs() < 1e-12);
    let along = EventRecord::new([Some(-3.0), None], false);
    assert_eq!((along.delta_v, along.force_direction, along.complete), (Some(3.0), None, false));
    assert_eq!(along.one_axis, Some(OneAxis::Longitudinal(-3.0)));
    assert_eq!(EventRecord::new([None, Some(4.0)], true).one_axis, Some(OneAxis::Lateral(4.0)));
    assert_eq!(EventRecord::new([None, None], true).delta_v, None);
}

/// Of one axis, the reason is seen in the direction of the impact: pushed forward instead of backward, it
/// came from 150° and not from 30°; pushed back by 300 km/h where 40 · cos 30° was to be expected, it is too
/// large.
#[test]
fn a_record_of_one_axis_has_its_reason() {
    let impact = KnownImpact { force_direction: Some(30_f64.to_radians()), delta_v: Some(40.0 * KMH) };
    let reason = |delta_v: [Option<f64>; 2]| {
        let record = EventRecord::new(delta_v.map(|part| part.map(|part| part * KMH)), true);
        match_records(&[record], &[impact], &MatchErrors::default())[0].cannot[0]
    };
    let Some(Mismatch::Direction { difference }) = reason([Some(200.0), None]) else { panic!() };
    assert!((difference.to_degrees() - 120.0).abs() < 1e-9, "{difference}");
    let Some(Mismatch::Size { ratio }) = reason([Some(-300.0), None]) else { panic!() };
    assert!((ratio - 300.0 / (40.0 * 30_f64.to_radians().cos())).abs() < 1e-9, "{ratio}");
    assert_eq!(reason([Some(-34.0), None]), None);
}
