//! Every key, value, piece of a case file and path that the text names exists.

use std::collections::BTreeSet;
use std::process::Command;
use std::sync::OnceLock;

use case::{CaseFile, CaseProblem, Dimension};

use crate::guide::prose::{Page, page, pages, root};

/// The tables in which a piece of a case file can be.
const TABLES: [&str; 13] = [
    "[scene]",
    "[vehicle1]",
    "[vehicle1.contact]",
    "[vehicle1.crush]",
    "[vehicle1.crush.stiffness]",
    "[vehicle1.crush.stiffness.test]",
    "[impact]",
    "[reconstruct]",
    "[surface]",
    "[vehicle1.before]",
    "[vehicle1.after]",
    "[estimate]",
    "[avoid]",
];

/// Keys whose value can be a table, each in its own table.
const BEFORE_A_TABLE: [&str; 9] = [
    "[vehicle1]\nspeed = ",
    "[vehicle1]\nyaw_inertia = ",
    "[vehicle1]\ncontact = ",
    "[vehicle1.crush]\nwidth = ",
    "[vehicle1.crush]\ndepths = ",
    "[vehicle1.crush]\nstiffness = ",
    "[vehicle1.crush]\noblique = ",
    "[impact]\nrestitution = ",
    "[impact]\ntangential = ",
];

/// Words that are not from the case file and have another meaning: how a console block begins, where it is
/// shortened and how it shows an exit status, the comment that names a schema, the mark of a misprint, a
/// field of the library, a key within a key of the JSON, keys of the JSON of a case whose evidence is
/// weighed, which takes a while, an environment variable.
const OTHER: [&str; 10] = [
    "$",
    "...",
    "? 2",
    "#:schema",
    "ERRATUM",
    "Problem::tangential_share",
    "headline.by",
    "solutions",
    "solution_warnings",
    "DELTAV_PROGRESS=off",
];

/// A piece may leave out keys of other topics.
fn is_of_a_piece(problem: &CaseProblem) -> bool {
    matches!(
        problem,
        CaseProblem::MissingTable { .. }
            | CaseProblem::MissingKey { .. }
            | CaseProblem::MissingKeyOfLaw { .. }
    )
}

fn reads(text: &str) -> bool {
    match CaseFile::parse("piece", text) {
        Ok(_) => true,
        Err(errors) => errors.list().iter().all(|diagnostic| is_of_a_piece(diagnostic.problem())),
    }
}

/// Whether this is a piece of a case file, by itself or in some table.
fn is_a_piece(code: &str) -> bool {
    if let Some((table, line)) = code.split_once("] ") {
        return reads(&format!("{table}]\n{line}"));
    }
    if code.starts_with('{') {
        return BEFORE_A_TABLE.iter().any(|before| reads(&format!("{before}{code}")));
    }
    TABLES.iter().any(|table| reads(&format!("{table}\n{code}")))
}

/// The words of letters, digits and underscores outside of quotes.
fn identifiers(code: &str) -> Vec<&str> {
    let unquoted = code.split('"').step_by(2);
    let words = unquoted.flat_map(|part| part.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')));
    words.filter(|word| !word.is_empty()).collect()
}

/// The keys of the case file and their values that are words, from its schema.
fn vocabulary() -> Vec<String> {
    fn gather(value: &serde_json::Value, words: &mut Vec<String>) {
        if let Some(object) = value.as_object() {
            if let Some(properties) = object.get("properties").and_then(|value| value.as_object()) {
                words.extend(properties.keys().cloned());
            }
            for value in ["const", "enum"].iter().filter_map(|key| object.get(*key)) {
                words.extend(value.as_str().map(str::to_owned));
                words.extend(
                    value.as_array().into_iter().flatten().filter_map(|one| one.as_str()).map(str::to_owned),
                );
            }
            object.values().for_each(|value| gather(value, words));
        } else if let Some(array) = value.as_array() {
            array.iter().for_each(|value| gather(value, words));
        }
    }
    let schema = serde_json::from_str(&page("docs/case.schema.json").text).unwrap();
    let mut words = Vec::new();
    gather(&schema, &mut words);
    words
}

/// The keys of the JSON that the program writes of some cases.
fn json_keys() -> &'static BTreeSet<String> {
    fn gather(value: &serde_json::Value, keys: &mut BTreeSet<String>) {
        match value {
            serde_json::Value::Object(object) => {
                keys.extend(object.keys().cloned());
                object.values().for_each(|value| gather(value, keys));
            }
            serde_json::Value::Array(array) => array.iter().for_each(|value| gather(value, keys)),
            _ => {}
        }
    }
    static KEYS: OnceLock<BTreeSet<String>> = OnceLock::new();
    KEYS.get_or_init(|| {
        let mut keys = BTreeSet::new();
        for line in [
            "reconstruct fixtures/edcrash-tutorial.toml --exact",
            "crush fixtures/one-inspected.toml",
            "check fixtures/estimate.toml",
            "compare fixtures/edcrash-tutorial.toml",
            "uncertainty fixtures/sae-980025-uncertain.toml --samples 100",
            "estimate fixtures/estimate.toml --particles 128 --no-pieces",
        ] {
            let output = Command::new(env!("CARGO_BIN_EXE_deltav"))
                .args(line.split(' '))
                .args(["--format", "json"])
                .current_dir(root())
                .output()
                .unwrap();
            gather(&serde_json::from_slice(&output.stdout).unwrap(), &mut keys);
        }
        keys
    })
}

/// A number with a unit of the program.
fn is_a_quantity(text: &str) -> bool {
    text.split_once(' ').is_some_and(|(number, unit)| {
        number.parse::<f64>().is_ok() && Dimension::ALL.iter().any(|dimension| dimension.unit(unit).is_some())
    })
}

fn csv(table: report::Table, units: report::Units) -> report::Csv {
    report::Csv { table, units, style: report::CsvStyle::International }
}

/// Whether a title that begins with this has an apostrophe before it in CSV, so that no spreadsheet runs it.
fn begins_a_formula(sign: &str) -> bool {
    let title = format!("{sign}1");
    let text = page("fixtures/sae-980025.toml").text;
    let line = text.lines().find(|line| line.starts_with("title")).unwrap();
    let file =
        CaseFile::parse("title.toml", &text.replacen(line, &format!("title = \"{title}\""), 1)).unwrap();
    let analysis = analysis::reconstruct(&file.case).unwrap();
    let answer = report::RowAnswer::Analysis(&analysis);
    let row = csv(report::Table::Analyses, report::Units::Si)
        .row(report::Row { file: "title.toml", answer: Ok((&file, answer)) })
        .unwrap();
    row.split(',').any(|cell| cell == format!("'{title}"))
}

/// A word of the case file, a topic of the glossary such as the code of a warning, a column of CSV, a value
/// of an option, a key of the JSON, a crate or another folder.
fn is_known(word: &str, vocabulary: &[String]) -> bool {
    const OF_OPTIONS: [&str; 4] = ["monte-carlo", "latin-hypercube", "sobol", "european"];
    let in_the_file = |word: &str| vocabulary.iter().any(|known| known == word);
    word.split('.').all(in_the_file)
        || report::topic(word).is_ok()
        || [report::Units::Si, report::Units::Us]
            .into_iter()
            .flat_map(|units| {
                [report::Table::Analyses, report::Table::Comparisons, report::Table::Uncertainties]
                    .map(|table| csv(table, units).columns())
            })
            .flatten()
            .any(|column| column == word)
        || OF_OPTIONS.contains(&word)
        || json_keys().contains(word)
        || root().join("crates").join(word).is_dir()
        || root().join(word).is_dir()
        || word == "deltav"
}

/// Whether a text with a star or without leads to a file.
fn exists(path: &str, of: &Page) -> bool {
    let folder = root().join(&of.name);
    let path = path.split_once("/*").map_or(path, |(folder, _)| folder);
    root().join(path).exists() || folder.parent().unwrap().join(path).exists()
}

/// Whether a table can have a column of this name, or its results have it.
fn is_a_column(code: &str) -> bool {
    use std::ops::ControlFlow;
    use std::sync::Arc;

    use arrow_array::RecordBatch;
    use arrow_schema::{DataType, Field, Schema};
    use tables::{Job, RowOptions, RowTemplate, columns_kept, result_schema, run};

    let is_read = |data_type: DataType| {
        let schema = Arc::new(Schema::new(vec![Field::new(code, data_type, true)]));
        let is_own = columns_kept(&schema).is_ok_and(|kept| kept.is_empty());
        let batch = RecordBatch::new_empty(schema);
        let goes_on = |_: usize, _: usize| ControlFlow::Continue(());
        is_own && run(Job::Crush, &batch, &RowTemplate::default(), &RowOptions::default(), &goes_on).is_ok()
    };
    let options = RowOptions { samples: Some(1000), ..RowOptions::default() };
    is_read(DataType::Float64)
        || is_read(DataType::Utf8)
        || [Job::Reconstruct, Job::Estimate, Job::Avoid]
            .iter()
            .any(|job| result_schema(*job, &options).field_with_name(code).is_ok())
}

fn judge(code: &str, of: &Page, vocabulary: &[String]) -> bool {
    let word = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_.-".contains(c);
    let is_path =
        code.contains('/') && !code.contains(' ') || code.ends_with(".toml") || code.ends_with(".md");
    if OTHER.contains(&code) || code.starts_with("cargo ") || is_a_column(code) {
        true
    } else if is_path {
        exists(code, of)
    } else if let Some(value) = code.strip_prefix('"').and_then(|code| code.strip_suffix('"')) {
        vocabulary.iter().any(|known| known == value)
            || is_a_piece(&format!("pdof = {code}"))
            || is_a_quantity(value)
    } else if let Some(table) = code.strip_prefix('[').and_then(|code| code.strip_suffix(']')) {
        table.split('.').all(|part| is_known(part, vocabulary))
    } else if code.contains(" = ") || code.starts_with('{') {
        // A shortened piece has its keys; one letter stands for a number.
        let shortened = code.contains('…') || !code.contains(" = ") || code.contains("= { x, y }") || {
            let value = code.rsplit("= ").next().unwrap().trim_end_matches([' ', '}']);
            value.chars().count() == 1 && value.chars().all(char::is_alphabetic)
        };
        let keys = || identifiers(code).into_iter().all(|key| key == "f" || is_known(key, vocabulary));
        if shortened { keys() } else { is_a_piece(code) }
    } else if code.chars().all(word) || code.len() == 1 {
        is_known(code, vocabulary) || code.len() == 1 && begins_a_formula(code)
    } else {
        Dimension::ALL.iter().any(|dimension| dimension.unit(code).is_some())
    }
}

#[test]
fn everything_that_the_text_names_exists() {
    let vocabulary = vocabulary();
    let mut count = 0;
    let mut wrong = Vec::new();
    // The development of the program has its own words, in docs/mutants.md and docs/versioning.md;
    // docs/guide/case-file.md is made from the list of the keys; docs/scale.md speaks of the Python package
    // and of Spark.
    let apart = [
        "docs/mutants.md",
        "docs/scale.md",
        "docs/versioning.md",
        "docs/validation.md",
        "docs/guide/case-file.md",
    ];
    for page in
        pages(&["docs", "docs/guide", "crates/report"]).iter().filter(|page| !apart.contains(&&page.name[..]))
    {
        let own = |code: &String| !code.starts_with("deltav ") && !code.starts_with('-');
        for code in page.inline_code().into_iter().filter(own) {
            if !judge(&code, page, &vocabulary) {
                wrong.push(format!("{}: `{code}`", page.name));
            }
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "the program does not know\n{}", wrong.join("\n"));
    assert!(count > 200, "the text names only {count}");
}

#[test]
fn what_does_not_exist_is_refused() {
    let (page, vocabulary) = (page("docs/guide/crush.md"), vocabulary());
    let wrong = [
        "crush_planes",
        "\"criticall\"",
        "fixture/pole.toml",
        "[impacts]",
        "axes = \"z-side\"",
        "{ frictions = 0.5 }",
        "{ frictions = … }",
        "lb ft s^3",
        "\"35 mhp\"",
        "\"3x mph\"",
        "errorss",
        "law_checks",
        "*",
        "? 3",
    ];
    for code in wrong {
        assert!(!judge(code, &page, &vocabulary), "{code}");
    }
}
