//! Whatever is in a file, it ends in an error that can be shown or in a case; what a case gives is finite.
#![no_main]

use analysis::{Analysis, Failure};
use case::{CaseFile, to_toml};
use libfuzzer_sys::fuzz_target;
use report::{Supplements, Units};
use serde_json::Value;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match CaseFile::parse("case.toml", text) {
        Ok(file) => {
            read_back(&file);
            for analyse in [analysis::reconstruct, analysis::impact, analysis::crush] {
                judge(&file, analyse(&file.case));
            }
        }
        Err(diagnostics) => {
            assert!(!diagnostics.list().is_empty(), "refused without a reason");
            assert!(!diagnostics.to_string().is_empty());
        }
    }
});

/// A case that is written is the same case when it is read.
fn read_back(file: &CaseFile) {
    let written = to_toml(&file.case);
    match CaseFile::parse("written.toml", &written) {
        Ok(again) => assert_eq!(again.case, file.case, "written as\n{written}"),
        Err(diagnostics) => panic!("what was written is refused:\n{diagnostics}"),
    }
}

fn judge(file: &CaseFile, result: Result<Analysis, Failure>) {
    let analysis = match result {
        Ok(analysis) => analysis,
        Err(failure) => {
            assert!(!failure.to_string().is_empty());
            return;
        }
    };
    for units in [Units::Us, Units::Si] {
        let text = report::results(&file.case, &analysis, units).text();
        assert_finite(file, &text);
    }
    let json = report::json(&file, &analysis).expect("an analysis is JSON");
    let value: Value = serde_json::from_str(&json).expect("what is written as JSON is JSON");
    // serde_json writes what is not finite as null.
    let fixed = [0, 1].map(|place| file.case.vehicles[place].fixed);
    assert!(!has_null(&value, fixed), "not finite:\n{json}");
    // The drawings take as long as a hundred analyses.
    if file.source.text().len() % 16 == 0 {
        let page = report::handover(file, &analysis, Supplements::default(), Units::Us);
        let page = page.expect("an analysis can be drawn").html();
        assert_finite(file, &page);
    }
}

/// No word of the text is a number that is none, unless the file itself has that word.
fn assert_finite(file: &CaseFile, text: &str) {
    let is_bad = |word: &str| matches!(word, "NaN" | "inf");
    let has_bad = |text: &str| text.split(|c: char| !c.is_alphanumeric()).any(is_bad);
    assert!(has_bad(file.source.text()) || !has_bad(text), "not finite:\n{text}");
}

/// What there is not where the vehicles do not close, the impulse does not push, or no push could end the
/// sliding.
const MAY_BE_NULL: [&str; 3] = ["restitution", "impulse_ratio", "critical_impulse_ratio"];

/// Whether something is null, but for the place of a fixed object in a pair and what there may not be.
fn has_null(value: &Value, fixed: [bool; 2]) -> bool {
    match value {
        Value::Null => true,
        Value::Array(list) => {
            let of_fixed = |place: usize| list.len() == 2 && fixed[place];
            let mut list = list.iter().enumerate();
            list.any(|(place, value)| !(value.is_null() && of_fixed(place)) && has_null(value, fixed))
        }
        Value::Object(map) => map.iter().any(|(key, value)| {
            let may_be = value.is_null() && MAY_BE_NULL.contains(&key.as_str());
            !may_be && has_null(value, fixed)
        }),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => false,
    }
}
