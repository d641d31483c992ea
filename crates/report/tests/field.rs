//! The plots of estimates against recorders.

use field::{Field, Figures, Group, Judged, PairKind, Truth};
use pim_core::VehicleId;

use super::fixtures::reader::{Reader, area, number, scales};

/// For each vehicle the value that its recorder stored, our median and WinSMASH's value, m/s.
const VEHICLES: [(PairKind, f64, f64, Option<f64>); 3] = [
    (PairKind::FrontFront, 10.0, 8.0, Some(5.0)),
    (PairKind::FrontSide, 5.0, 6.0, None),
    (PairKind::FrontSide, 4.0, 4.5, Some(3.0)),
];

fn judged() -> Field {
    let figures = |n: usize, rms: f64, pit: Option<[usize; 10]>| Figures {
        n,
        collisions: n,
        bias: [0.0, 0.1],
        rms: [rms, 0.1],
        coverage: None,
        width95: None,
        crps: 1.0,
        pit,
    };
    let all = Group {
        name: "all",
        ours: figures(90, 0.21, Some([9, 3, 12, 9, 9, 6, 12, 9, 0, 21])),
        winsmash: Some(figures(2, 0.53, None)),
        ours_of_these: None,
    };
    let vehicle = |(kind, recorder, median, winsmash)| Judged {
        case: "1".to_owned(),
        vehicle: VehicleId::One,
        kind,
        is_one_event: None,
        truth: Truth { delta_v: recorder, is_longitudinal: false, direction: None },
        median,
        intervals: [[0.0, 1.0]; 3],
        below: 0.5,
        crps: 1.0,
        converged: true,
        winsmash,
    };
    Field {
        other: false,
        objects: false,
        injured: false,
        pairs: 3,
        finished: 3,
        doubted: vec![("8".to_owned(), VehicleId::One)],
        judged: VEHICLES.map(vehicle).to_vec(),
        groups: vec![all],
    }
}

#[test]
fn estimates_stand_over_recorders_and_those_of_winsmash_beside() {
    let drawing = report::estimated_against_recorded(&judged());
    let (svg, reader) = (drawing.svg(), Reader::new());
    let texts = reader.readable("estimated against recorded", &svg);
    for words in
        ["front-front", "front-side", "WinSMASH: 2 vehicles, root mean square of ln(ΔV/recorder) 0.53"]
    {
        assert!(texts.iter().any(|(text, _)| text == words), "{words}");
    }
    assert!(!texts.iter().any(|(text, _)| text == "front-rear"));
    let tree = reader.tree(&svg);
    let beside: Vec<_> =
        VEHICLES.into_iter().filter_map(|(_, recorder, _, winsmash)| Some([recorder, winsmash?])).collect();
    let ours = VEHICLES.map(|(_, recorder, median, _)| [recorder, median]);
    for (panel, points) in [(0_u8, ours.to_vec()), (1, beside)] {
        let left = f64::from(panel) * 600.0;
        let [across, upward] = scales(&svg, left + 24.0, left + 624.0);
        for (k, point) in (1..).zip(points) {
            let id = format!("estimated-against-recorded-point-{}-{k}", panel + 1);
            let symbol = area(&tree, &id);
            let drawn = [
                across.value(f64::from(symbol.left() + symbol.right()) / 2.0),
                upward.value(f64::from(symbol.top() + symbol.bottom()) / 2.0),
            ];
            let [x, y] = point.map(|speed| 3.6 * speed);
            assert!((drawn[0] - x).abs() < 0.05 * across.pixel(), "{id}: {drawn:?} {x} {y}");
            assert!((drawn[1] - y).abs() < 1.1 * upward.pixel(), "{id}: {drawn:?} {x} {y}");
        }
    }
}

/// 90 vehicles are 9 in each tenth; by chance 9 ± 2 √(90 · 0.1 · 0.9) = 9 ± 5.692.
#[test]
fn ranks_have_a_bar_for_each_tenth_and_the_band_of_chance() {
    let drawing = report::ranks_of_recorders(&judged());
    let (svg, reader) = (drawing.svg(), Reader::new());
    reader.readable("ranks of recorders", &svg);
    assert!(drawing.description().ends_with("low to high: 9, 3, 12, 9, 9, 6, 12, 9, 0, 21."));
    let tree = reader.tree(&svg);
    let [across, upward] = scales(&svg, 0.0, 960.0);
    let last = area(&tree, "ranks-of-recorders-class-10");
    assert!((across.value(f64::from(last.left())) - 90.0).abs() < 0.1);
    assert!((upward.value(f64::from(last.top())) - 21.0).abs() < 0.1);
    for (id, level) in [("low", 3.308), ("expected", 9.0), ("high", 14.692)] {
        let drawn = upward.value(number(&svg, &format!("ranks-of-recorders-{id}"), "y1"));
        assert!((drawn - level).abs() < 0.05, "{id}: {drawn}");
    }
}
