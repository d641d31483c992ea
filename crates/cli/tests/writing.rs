//! A file is written whole or not at all.

#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// An empty folder with `A.toml`.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("writing").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    fs::copy("../../fixtures/sae-980025-uncertain.toml", path.join("A.toml")).unwrap();
    path
}

/// Runs a script in a shell, in which `deltav` is the program.
fn shell(folder: &Path, script: &str) -> Output {
    Command::new("sh")
        .current_dir(folder)
        .args(["-c", &format!("deltav() {{ {} \"$@\"; }}; {script}", env!("CARGO_BIN_EXE_deltav"))])
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// No file may be longer than 1 or 2 KiB, which is as if the disk were full.
const FULL: &str = "trap '' XFSZ; ulimit -f 2;";

#[test]
fn a_write_that_fails_leaves_the_old_file_and_no_other() {
    let folder = folder("full");
    let old = ["report", "rows.csv", "scene.svg", "samples.csv", "deltav.1"];
    for name in old {
        fs::write(folder.join(name), "old").unwrap();
    }
    let before = names(&folder);
    for (arguments, message) in [
        ("reconstruct A.toml -o report", "cannot write the output to report: File too large"),
        ("reconstruct A.toml --format html -o report", "cannot write the output to report: File too large"),
        ("reconstruct A.toml --format html -o new", "cannot write the output to new: File too large"),
        (
            "reconstruct A.toml A.toml A.toml --format csv -o rows.csv",
            "cannot write the rows: File too large",
        ),
        ("draw A.toml --what scene -o scene.svg", "cannot write the output to scene.svg: File too large"),
        (
            "uncertainty A.toml --samples 1000 --samples-out samples.csv",
            "cannot write the samples to samples.csv",
        ),
        ("uncertainty A.toml --samples 100 --plots .", "cannot write the output to ./"),
        ("new -o case.toml", "cannot write the case to case.toml: File too large"),
        ("man --output-dir .", "cannot write the output to ./deltav-"),
    ] {
        let output = shell(&folder, &format!("{FULL} deltav {arguments}"));
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
        assert!(said.contains(message) && !said.contains(".deltav-"), "{arguments}: {said}");
        let mut after = names(&folder);
        // Pages and plots before the one that is too long.
        after.retain(|name| !(name.starts_with("deltav-") || name.starts_with("tornado-")));
        assert_eq!(after, before, "{arguments}");
        for name in old {
            assert_eq!(text(&folder, name), "old", "{arguments}: {name}");
        }
    }
    // The same without the limit.
    assert!(shell(&folder, "deltav reconstruct A.toml -o report").status.success());
    assert!(text(&folder, "report").starts_with("Intersection collision"));
    assert_eq!(names(&folder).iter().filter(|name| name.starts_with('.')).count(), 0);
}

/// Rows of files without an answer are rows.
#[test]
fn rows_with_an_error_are_kept() {
    let folder = folder("rows");
    let output = shell(&folder, "deltav reconstruct A.toml missing.toml --format csv -o rows.csv");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(text(&folder, "rows.csv").lines().count(), 3);
}

#[test]
fn permissions_stay_and_new_files_are_as_the_umask_says() {
    let folder = folder("permissions");
    let mode = |name: &str| fs::metadata(folder.join(name)).unwrap().permissions().mode() & 0o777;
    fs::write(folder.join("private"), "old").unwrap();
    fs::set_permissions(folder.join("private"), Permissions::from_mode(0o640)).unwrap();
    let output = shell(
        &folder,
        "umask 022; deltav check A.toml -o private; deltav check A.toml -o new; deltav new -o B.toml",
    );
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(["private", "new", "B.toml"].map(mode), [0o640, 0o644, 0o644]);
    assert_eq!(text(&folder, "private"), text(&folder, "new"));
}

/// A name that the user gave to the text of another file: only this name has the report.
#[test]
fn a_hard_link_is_no_way_to_another_case() {
    let folder = folder("hard");
    let case = text(&folder, "A.toml");
    fs::copy(folder.join("A.toml"), folder.join("B.toml")).unwrap();
    fs::hard_link(folder.join("B.toml"), folder.join("report.txt")).unwrap();
    assert!(shell(&folder, "deltav check A.toml -o report.txt").status.success());
    assert_eq!(text(&folder, "B.toml"), case);
    assert_ne!(text(&folder, "report.txt"), case);
}

#[test]
fn links_lead_to_their_file_and_pipes_stay_pipes() {
    let folder = folder("links");
    fs::create_dir(folder.join("kept")).unwrap();
    fs::write(folder.join("kept/report"), "old").unwrap();
    symlink("kept/report", folder.join("link")).unwrap();
    symlink("kept/new", folder.join("dangling")).unwrap();
    let script = "deltav check A.toml -o plain; deltav check A.toml -o link; deltav check A.toml -o dangling;
        mkfifo pipe; cat pipe > piped & deltav check A.toml -o pipe; wait;
        deltav check A.toml -o /dev/stdout > stdout; deltav check A.toml -o /dev/null;
        echo before > twice; deltav check A.toml -o /dev/stdout >> twice";
    let output = shell(&folder, script);
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    let plain = text(&folder, "plain");
    for name in ["kept/report", "kept/new", "piped", "stdout"] {
        assert_eq!(text(&folder, name), plain, "{name}");
    }
    assert_eq!(text(&folder, "twice"), format!("before\n{plain}"));
    for name in ["link", "dangling"] {
        assert!(folder.join(name).is_symlink(), "{name}");
    }
}

#[test]
fn a_hyphen_is_standard_output() {
    let folder = folder("hyphen");
    for arguments in [
        "reconstruct A.toml",
        "reconstruct A.toml --format html",
        "reconstruct A.toml --format csv",
        "check A.toml --format json",
        "compare A.toml",
        "uncertainty A.toml --samples 100",
        "draw A.toml --what energy",
        "new",
        "schema",
        "explain pdof",
    ] {
        let output = shell(&folder, &format!("deltav {arguments} -o - 2>/dev/null"));
        assert!(output.status.success(), "{arguments}");
        let without = shell(&folder, &format!("deltav {arguments} 2>/dev/null"));
        assert!(!output.stdout.is_empty() && output.stdout == without.stdout, "{arguments}");
    }
    for (option, command) in [
        ("--samples-out", "uncertainty A.toml"),
        ("--plots", "uncertainty A.toml"),
        ("--plots", "validate"),
        ("--output-dir", "man"),
    ] {
        let output = shell(&folder, &format!("deltav {command} {option} -"));
        assert_eq!(output.status.code(), Some(2), "{command}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with(&format!("error: {option} - : ")), "{message}");
    }
    assert_eq!(names(&folder), ["A.toml"]);
    assert!(shell(&folder, "deltav check A.toml -o ./-").status.success());
    assert!(text(&folder, "-").starts_with("Intersection"));
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_ends_with_status_2() {
    let folder = folder("dev-full");
    for arguments in [
        "--help",
        "--version",
        "check --help",
        "check A.toml",
        "schema",
        "explain",
        "man",
        "completions bash",
    ] {
        let output = shell(&folder, &format!("deltav {arguments} > /dev/full"));
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            message,
            "error: cannot write to standard output: No space left on device (os error 28)\n"
        );
    }
}
