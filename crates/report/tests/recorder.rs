//! What the report of a recorder says of a pulse.

use case::CaseFile;
use report::Units;

/// An axis that ends before the other was stored all the same, unlike one that was not.
#[test]
fn an_axis_that_ends_early_was_stored() {
    let told = |lateral: &str| {
        let text = format!(
            "[vehicle1.recorder]\npulse = {{ time = \"0 10 20 30 40 50 60 ms\", \
             delta_v_longitudinal = \"0 -5 -12 -18 -20 -20 -20 km/h\"{lateral} }}\n"
        );
        let file = CaseFile::parse("case.toml", &text).unwrap();
        report::recorders(&file, &analysis::recorders(&file.case).unwrap(), Units::Si).text()
    };
    let (alone, ended) = ("Only longitudinal ΔV was stored", "After 30 ms one axis alone has a ΔV");
    let both = ", delta_v_lateral = \"0 1 3 5 5 5 5 km/h\"";
    let early = ", delta_v_lateral = \"0 1 3 5 - - - km/h\"";
    for (lateral, is_alone, has_ended) in [("", true, false), (both, false, false), (early, false, true)] {
        let text = told(lateral);
        assert_eq!([text.contains(alone), text.contains(ended)], [is_alone, has_ended], "{text}");
    }
}
