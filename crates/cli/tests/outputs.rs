//! No command writes over the case that it reads, nor over another, nor twice to one file.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const CASE: &str = include_str!("../../../fixtures/sae-980025-uncertain.toml");

/// An empty folder with `A.toml` and, equal to it, `case.txt`.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("outputs").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    for case in ["A.toml", "case.txt"] {
        fs::write(path.join(case), CASE).unwrap();
    }
    path
}

/// Status and message of a command that is run there, where `input` is a file for its standard input.
fn run(folder: &Path, arguments: &str, input: Option<&str>) -> (Option<i32>, String) {
    let input = input.map_or_else(Stdio::null, |name| fs::File::open(folder.join(name)).unwrap().into());
    let output = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .current_dir(folder)
        .args(arguments.split(' '))
        .stdin(input)
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// Refused in one sentence, with both cases as they were and nothing new beside them.
#[track_caller]
fn refused(folder: &Path, arguments: &str, input: Option<&str>) -> String {
    let names = || {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let before = names();
    let (status, message) = run(folder, arguments, input);
    assert_eq!(status, Some(2), "{arguments}: {message}");
    assert!(message.starts_with("error: ") && message.lines().count() == 1, "{arguments}: {message}");
    for case in ["A.toml", "case.txt"] {
        assert_eq!(fs::read_to_string(folder.join(case)).unwrap(), CASE, "{arguments}");
    }
    assert_eq!(names(), before, "{arguments}");
    message
}

#[test]
fn a_file_holds_what_its_name_says() {
    let folder = folder("format");
    for (arguments, advice) in [
        ("reconstruct A.toml -o r.html", "add --format html"),
        ("check A.toml -o r.json", "add --format json"),
        ("reconstruct A.toml --format html -o r.md", "add --format markdown"),
        ("reconstruct A.toml --format html -o r.pdf", "print that page as PDF"),
    ] {
        let message = refused(&folder, arguments, None);
        assert!(message.contains(advice), "{arguments}: {message}");
    }
    for arguments in ["check A.toml -o check.out", "check A.toml --format html -o check.htm"] {
        assert_eq!(run(&folder, arguments, None).0, Some(0), "{arguments}");
    }
}

#[test]
fn no_command_writes_over_its_case() {
    let folder = folder("case");
    for command in [
        "reconstruct",
        "reconstruct --format json",
        "reconstruct --format html",
        "reconstruct --format markdown",
        "reconstruct --format csv",
        "reconstruct --format jsonl",
        "impact",
        "crush --format json",
        "check",
        "compare",
        "sensitivity",
        "uncertainty --samples 100",
    ] {
        for case in ["A.toml", "case.txt"] {
            for output in [case.to_owned(), format!("./{case}"), format!("../case/{case}")] {
                let message = refused(&folder, &format!("{command} {case} -o {output}"), None);
                assert!(
                    message.contains(&format!("-o {output} would overwrite the case file {case}: ")),
                    "{message}"
                );
            }
        }
    }
    let message = refused(&folder, "reconstruct A.toml --format html -o A.toml", None);
    assert_eq!(
        message,
        "error: -o A.toml would overwrite the case file A.toml: give another name, such as -o A-report.html\n"
    );
    // One of several.
    let message = refused(&folder, "reconstruct A.toml case.txt --format csv -o case.txt", None);
    assert!(
        message.contains("the case file case.txt: give another name, such as -o case-rows.csv"),
        "{message}"
    );
    let message = refused(&folder, "uncertainty case.txt --samples 100 --samples-out case.txt", None);
    assert!(message.contains("such as --samples-out case-samples.csv"), "{message}");
    let message = refused(&folder, "reconstruct - -o case.txt", Some("case.txt"));
    assert!(message.contains("the case file that comes in on standard input"), "{message}");
}

#[cfg(unix)]
#[test]
fn links_to_the_case_are_the_case() {
    let folder = folder("links");
    std::os::unix::fs::symlink("A.toml", folder.join("symbolic.svg")).unwrap();
    fs::hard_link(folder.join("A.toml"), folder.join("hard.svg")).unwrap();
    std::os::unix::fs::symlink(".", folder.join("here")).unwrap();
    for output in ["symbolic.svg", "hard.svg"] {
        for command in ["reconstruct A.toml", "draw A.toml --what scene", "uncertainty A.toml --samples 100"]
        {
            let message = refused(&folder, &format!("{command} -o {output}"), None);
            assert!(message.contains("overwrite the case file A.toml"), "{message}");
        }
    }
    // The case by its link, and through a folder that is one.
    refused(&folder, "check symbolic.svg -o A.toml", None);
    refused(&folder, "check case.txt -o here/case.txt", None);
    // A link to a case, as the output of a command that reads no case.
    refused(&folder, "schema -o symbolic.svg", None);
    // A plot with the name of a link.
    fs::hard_link(folder.join("case.txt"), folder.join("tornado-vehicle1.speed.svg")).unwrap();
    let message = refused(&folder, "uncertainty case.txt --samples 100 --plots .", None);
    assert!(message.contains("--plots . would overwrite ./tornado-vehicle1.speed.svg"), "{message}");
    std::os::unix::fs::symlink("A.toml", folder.join("deltav.1")).unwrap();
    refused(&folder, "man --output-dir .", None);
    std::os::unix::fs::symlink("A.toml", folder.join("reconstructed-speed.svg")).unwrap();
    refused(&folder, "validate --plots .", None);
}

#[test]
fn no_command_writes_over_another_case() {
    let folder = folder("another");
    for arguments in [
        "check case.txt -o A.toml",
        "schema -o A.toml",
        "explain pdof -o A.toml",
        "explain pdof --format json -o A.toml",
        "validate -o A.toml",
        "uncertainty case.txt --samples 100 --samples-out A.toml",
    ] {
        let message = refused(&folder, arguments, None);
        assert!(message.contains("A.toml would overwrite a .toml file that exists"), "{message}");
    }
    // A file that does not exist cannot be lost, and a report may be written again.
    for _ in 0..2 {
        assert_eq!(run(&folder, "check case.txt -o report.txt", None), (Some(0), String::new()));
        assert_eq!(run(&folder, "schema -o case.schema.json", None), (Some(0), String::new()));
    }
    assert_eq!(run(&folder, "check case.txt -o new.toml", None), (Some(0), String::new()));
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder("two");
    let command = "uncertainty A.toml --samples 100";
    for pair in
        ["-o same --samples-out same", "-o same --samples-out ./same", "--samples-out same -o ../two/same"]
    {
        let message = refused(&folder, &format!("{command} {pair}"), None);
        assert!(message.contains("-o and --samples-out would both write to "), "{message}");
        assert!(message.contains("same-samples.csv"), "{message}");
    }
    fs::write(folder.join("there"), "").unwrap();
    refused(&folder, &format!("{command} -o there --samples-out there"), None);
    let message = refused(&folder, &format!("{command} --plots . -o tornado-vehicle1.speed.svg"), None);
    assert!(message.contains("-o and --plots . may both write to tornado-vehicle1.speed.svg"), "{message}");
    let all = format!("{command} -o a.txt --samples-out a.csv --plots .");
    assert_eq!(run(&folder, &all, None), (Some(0), String::new()));
    // An output that keeps nothing loses nothing.
    if cfg!(unix) {
        let none = format!("{command} -o /dev/null --samples-out /dev/null");
        assert_eq!(run(&folder, &none, None), (Some(0), String::new()));
    }
}

/// The table of crashes, and the picture that a case names, are read, too.
#[test]
fn what_else_is_read_is_not_written_over() {
    let folder = folder("read");
    fs::write(folder.join("pairs.csv"), "CASEID\n1\n").unwrap();
    let plan = "[scene]\nsite_plan = { file = \"plan.png\", corner = { x = \"0 m\", y = \"0 m\" }, width = \"9 m\" }\n";
    fs::write(folder.join("plan.toml"), format!("{CASE}\n{plan}")).unwrap();
    fs::write(folder.join("plan.png"), "a picture").unwrap();
    for arguments in ["validate --field pairs.csv -o pairs.csv", "validate --field pairs.csv -o ./pairs.csv"]
    {
        assert!(refused(&folder, arguments, None).contains("would overwrite the table pairs.csv"));
    }
    for command in [
        "reconstruct plan.toml -o plan.png",
        "check plan.toml -o plan.png",
        "reconstruct plan.toml --format html -o plan.png",
        "draw plan.toml --what scene -o plan.png",
        "uncertainty plan.toml --samples-out plan.png",
    ] {
        let message = refused(&folder, command, None);
        assert!(message.contains("would overwrite the site plan plan.png"), "{command}: {message}");
    }
    assert_eq!(fs::read_to_string(folder.join("plan.png")).unwrap(), "a picture");
    assert_eq!(fs::read_to_string(folder.join("pairs.csv")).unwrap(), "CASEID\n1\n");
}
