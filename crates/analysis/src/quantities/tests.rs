#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use case::CaseFile;

use super::QUANTITIES;
use crate::goal::{Answer, Goal};
use crate::output::{Output, Reading};

/// A row that samples can read is of no use outside of the lists, which give the order.
#[test]
fn each_quantity_that_samples_or_draws_read_stands_in_a_list_once() {
    let (all, drawn) = (Output::all(), Output::drawn());
    for quantity in QUANTITIES {
        let count = |list: &[Output]| list.iter().filter(|output| output.is(quantity)).count();
        let each = if quantity.is_of_vehicle() { 2 } else { 1 };
        let is_sampled = !matches!(quantity.sampled, Reading::No);
        let sampled = if quantity.is_of_damage() { 1 } else { each };
        assert_eq!(count(&all), if is_sampled { sampled } else { 0 }, "{} in all()", quantity.key);
        // The crush energy is drawn of both vehicles together.
        let each = if quantity.key == "crush_energy" { 1 } else { each };
        let is_only_sampled = quantity.is_of_path() || quantity.is_of_damage();
        let is_drawn = quantity.drawn.is_some() || (is_sampled && !is_only_sampled);
        assert_eq!(count(&drawn), if is_drawn { each } else { 0 }, "{} in drawn()", quantity.key);
    }
}

/// The columns of a row say the same: what samples read of the answer is what tables read of the analysis.
#[test]
fn samples_read_what_the_tables_show() {
    let mut seen_keys = BTreeSet::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut paths: Vec<_> = ["", "laws", "motion", "roots"]
        .iter()
        .flat_map(|name| fs::read_dir(folder.join(name)).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    let mut texts: Vec<String> = paths.iter().map(|path| fs::read_to_string(path).unwrap()).collect();
    // No fixture has a skid of vehicle 2.
    let skid = "[vehicle2.before]\nskid = { length = \"8 m\", friction = 0.6 }\n";
    texts.push(fs::read_to_string(folder.join("sae-980025.toml")).unwrap() + skid);
    for text in texts {
        let Ok(file) = CaseFile::parse("case.toml", &text) else { continue };
        let case = file.case;
        for goal in [Goal::of(&case), Goal::Impact, Goal::Motion] {
            let Ok(analysis) = goal.solve(&case) else { continue };
            let (answer, seen) = (Answer::of(&analysis), analysis.seen(case.axes));
            for output in Output::of(&analysis, case.axes) {
                let sampled = output.of_answer(&answer, case.axes);
                let shown = output.quantity().value(&seen, output.vehicle()).unwrap();
                let is_same = (sampled - shown).abs() <= 1e-12 * shown.abs().max(1e-6);
                assert!(is_same, "{}: {sampled} {shown}\n{text}", output.path());
                seen_keys.insert(output.path());
            }
        }
    }
    let all: BTreeSet<String> = Output::all().into_iter().map(Output::path).collect();
    assert_eq!(seen_keys, all);
}
