//! The sources of the numbers in patterns: results of the program, its limits, other pages.

use std::f64::consts::PI;
use std::process::Command;

use analysis::Warning;
use case::CaseFile;
use serde_json::Value;

use crate::guide::prose::{Page, page, root};

/// Numbers with their units and an anchor word, separated by ` … `, and the page that contains them.
pub(super) struct Fact {
    pub(super) page: &'static str,
    pub(super) pattern: String,
}

/// The output and the exit status of the program, run in the root of the repository.
pub(super) fn deltav(arguments: &str) -> (String, i32) {
    let output = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .args(arguments.split(' '))
        .current_dir(root())
        .output()
        .unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

/// The JSON that the program prints.
pub(super) fn json(arguments: &str) -> Value {
    serde_json::from_str(&deltav(&format!("{arguments} --format json")).0).unwrap()
}

/// The number with so many decimals, a comma at the thousands and a true minus sign.
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let mut grouped = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index) % 3 == 0 {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    format!("{}{grouped}{rest}", if value < 0.0 { "−" } else { "" })
}

/// The number at this path of keys.
#[track_caller]
pub(super) fn at(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("there is no {path}"))
}

/// The least and the greatest value of a key, from the schema of the case file.
pub(super) fn bounds(key: &str) -> [String; 2] {
    fn find(value: &Value, key: &str) -> Option<[f64; 2]> {
        if let Some(bounds) = value
            .get(key)
            .and_then(|key| Some([key.get("minimum")?.as_f64()?, key.get("maximum")?.as_f64()?]))
        {
            return Some(bounds);
        }
        let inside: Vec<&Value> = match value {
            Value::Object(object) => object.values().collect(),
            Value::Array(array) => array.iter().collect(),
            _ => Vec::new(),
        };
        inside.into_iter().find_map(|value| find(value, key))
    }
    let schema = serde_json::from_str(&page("docs/case.schema.json").text).unwrap();
    find(&schema, key).unwrap_or_else(|| panic!("{key} has no bounds")).map(|bound| number(bound, 0))
}

/// (rad) in degrees, rounded.
pub(super) fn degrees(rad: f64) -> String {
    number(rad.to_degrees(), 0)
}

pub(super) const FOOT: f64 = 0.3048;
pub(super) const MILE_PER_HOUR: f64 = 0.44704;
pub(super) const FOOT_POUND: f64 = FOOT * 4.448_221_615_260_5;

/// The patterns of the pages, one page after the other.
#[derive(Default)]
pub(super) struct Ledger {
    pub(super) facts: Vec<Fact>,
    page: &'static str,
}

impl Ledger {
    /// Begins the patterns of this page.
    pub(super) fn page(&mut self, page: &'static str) {
        self.page = page;
    }

    /// Adds a pattern into which the caller has put the numbers.
    pub(super) fn made(&mut self, pattern: impl Into<String>) {
        self.facts.push(Fact { page: self.page, pattern: pattern.into() });
    }

    /// Adds a pattern whose numbers are in another page, in the given words.
    #[track_caller]
    pub(super) fn quoted(&mut self, pattern: &str, source: &Page, words: &str) {
        let one_line = source.text.split_whitespace().collect::<Vec<_>>().join(" ");
        let is_there = !super::places(&one_line, words, &super::numbers(&one_line)).is_empty();
        assert!(is_there, "{} does not say {words:?}", source.name);
        let of =
            |text: &str| super::numbers(text).into_iter().map(|at| text[at].to_owned()).collect::<Vec<_>>();
        let there = of(words);
        for value in of(pattern) {
            assert!(there.contains(&value), "{value} of {pattern:?} is not in {words:?}");
        }
        self.made(pattern);
    }

    /// Adds a pattern that is not computed: a definition, a date, a rule of thumb, with its source.
    pub(super) fn cited(&mut self, pattern: &str, _source: &'static str) {
        self.made(pattern);
    }
}

/// (deg) of `pdof = "hour o'clock"`.
pub(super) fn clock(hour: u8) -> f64 {
    case::Pdof::<f64>::Clock(hour).rad().to_degrees()
}

/// The limit that the program has for this check.
pub(super) fn limit(code: &str) -> f64 {
    let case = json(match code {
        "damage-energy" => "impact fixtures/ricsac/01.toml",
        _ => "reconstruct fixtures/sae-980025.toml",
    });
    let checks = case["checks"].as_array().unwrap();
    at(checks.iter().find(|check| check["code"] == code).unwrap(), "/limit")
}

/// (rad) how far two given PDOFs may be from opposite.
pub(super) fn opposite_limit() -> f64 {
    let text = page("fixtures/sae-980025.toml").text;
    let with_pdofs = ["front", "right"].iter().fold(text, |text, side| {
        let line = format!("side      = \"{side}\"");
        assert_eq!(text.matches(&line).count(), 1, "{line}");
        text.replace(&line, &format!("{line}\npdof = \"0 deg\""))
    });
    let analysis = analysis::crush(&CaseFile::parse("pdofs.toml", &with_pdofs).unwrap().case).unwrap();
    analysis.checks.iter().find(|check| check.code() == "pdofs-opposite").unwrap().limit
}

/// The value between two others at which the answer changes, found by trial.
pub(super) fn threshold(mut yes: f64, mut no: f64, answer: impl Fn(f64) -> bool) -> f64 {
    assert!(answer(yes) && !answer(no));
    for _ in 0..50 {
        let middle = f64::midpoint(yes, no);
        if answer(middle) { yes = middle } else { no = middle }
    }
    yes
}

/// The closing speed (m/s) and the restitution above which the program warns about the restitution.
pub(super) fn high_restitution() -> [String; 2] {
    let text = page("fixtures/sae-980025-impact.toml").text;
    let speed_line = text.lines().find(|line| line.starts_with("speed")).unwrap();
    let restitution_line = text.lines().find(|line| line.starts_with("restitution")).unwrap();
    let run = |speed: f64, restitution: f64| {
        let text = text.replacen(speed_line, &format!("speed = \"{speed} m/s\""), 1).replacen(
            restitution_line,
            &format!("restitution = {restitution}"),
            1,
        );
        analysis::impact(&CaseFile::parse("high.toml", &text).unwrap().case).unwrap()
    };
    let warns = |analysis: &analysis::Analysis| {
        analysis.warnings.iter().any(|warning| matches!(warning, Warning::HighRestitution { .. }))
    };
    let speed = threshold(30.0, 10.0, |speed| warns(&run(speed, 0.5)));
    let closing = -run(speed, 0.5).impact.unwrap().outcome.approach.normal;
    let restitution = threshold(0.6, 0.0, |restitution| warns(&run(30.0, restitution)));
    [number(closing, 0), number(restitution, 1)]
}

/// By how much width and spacing may differ, as a share of the width.
pub(super) fn width_tolerance() -> f64 {
    threshold(0.0, 0.5, |off| {
        let width = 1.0 + off;
        let text = format!(
            "[vehicle1]\nmass = \"1500 kg\"\n[vehicle1.crush]\nside = \"front\"\nwidth = \"{width} m\"\nspacing = \"0.25 0.75 m\"\n\
             depths = \"10 20 30 cm\"\nstiffness = {{ category = 3 }}\n[vehicle2]\nfixed = true\n"
        );
        CaseFile::parse("width.toml", &text).is_ok()
    })
}

/// (%) of a normal distribution within so many standard deviations, by Simpson's rule.
pub(super) fn within(deviations: f64) -> String {
    let (steps, step) = (1000, deviations / 1000.0);
    let weight = |index: i32| if index == 0 || index == steps { 1.0 } else { f64::from(2 + 2 * (index % 2)) };
    let sum: f64 =
        (0..=steps).map(|index| weight(index) * (-0.5 * (step * f64::from(index)).powi(2)).exp()).sum();
    number(100.0 * 2.0 * sum * step / 3.0 / (2.0 * PI).sqrt(), 0)
}
