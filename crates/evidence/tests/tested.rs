//! The classes on which estimates were judged.

use evidence::TestedClass;

/// The figures are those that docs/calibration.md prints.
#[test]
fn figures_are_those_of_the_calibration() {
    let page = include_str!("../../../docs/calibration.md");
    for (class, start) in [
        ("two-fronts", "| two fronts, by category | 64 |"),
        ("front-side", "| front and side, by category | 172 |"),
        ("front-rear", "| front and rear, by category | 107 |"),
        ("recorder", "| the other vehicle's recorder given, by category | 104 |"),
        ("one-crush", "| the crush of the judged vehicle alone, by category | 348 |"),
        ("fixed-object", "| front and fixed object, by category | 94 |"),
        ("two-fronts-fleet", "| two fronts | 64 |"),
        ("front-side-fleet", "| front and side | 172 |"),
        ("front-rear-fleet", "| front and rear | 107 |"),
        ("recorder-fleet", "| all, the other vehicle's recorder given | 104 |"),
        ("one-crush-fleet", "| the vehicle that is judged | 348 |"),
        ("fixed-object-fleet", "| fixed objects, all | 94 |"),
    ] {
        let class = TestedClass::ALL.into_iter().find(|found| found.code == class);
        let line = page.lines().find(|line| line.starts_with(start));
        let (Some(class), Some(line)) = (class, line) else { panic!("{start}") };
        assert!(line.contains(&format!("| {:.1} ± ", 100.0 * class.inside95)), "{line}");
        assert!(line.contains(&format!(" {:.3}", class.rms.unwrap_or_default())), "{line}");
        assert!(start.contains(&class.n.to_string()));
    }
    assert!(page.contains("| crush, speeds and directions after the impact | 18 of 19 |"));
}
