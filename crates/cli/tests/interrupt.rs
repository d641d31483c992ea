//! Ctrl-C and a request to terminate during long runs.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The run ends with the results so far, and says so.
#[test]
fn ctrl_c_prints_the_results_so_far() {
    let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025-uncertain.toml");
    // Many times more than can be computed in the pause below.
    let child = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .args(["uncertainty", fixture, "--samples", "10000000", "--threads", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Long enough to have read the case and begun.
    sleep(Duration::from_secs(1));
    let interrupted = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupted.success());
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("of 10000000 samples"), "{message}");
    assert!(text.contains("Ended early: 10,000,000 samples were requested."), "{text}");
    assert!(text.contains("Speed of vehicle 1"), "{text}");
}

/// The result for a table of `rows` rows with `samples` each, whose run gets a signal after some
/// milliseconds: the status, the message and the output file, which existed before.
fn table(
    name: &str,
    signal: &str,
    (rows, samples): (usize, &str),
    after: u64,
) -> (Option<i32>, String, String) {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("interrupt").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let mut csv = "id,vehicle2.speed [mph]\n".to_owned();
    for row in 0..rows {
        csv.push_str(&format!("{row},10\n"));
    }
    std::fs::write(folder.join("rows.csv"), csv).unwrap();
    std::fs::write(folder.join("out.csv"), "old\n").unwrap();
    let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025-uncertain.toml");
    let child = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .current_dir(&folder)
        .args([
            "table",
            "rows.csv",
            "--template",
            fixture,
            "--samples",
            samples,
            "-o",
            "out.csv",
            "--threads",
            "2",
        ])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_millis(after));
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "{left:?}");
    let out = std::fs::read_to_string(folder.join("out.csv")).unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap(), out)
}

/// The rows that were finished are kept, each with all of its columns.
#[test]
fn an_ended_table_keeps_its_rows() {
    for signal in ["-INT", "-TERM"] {
        let (status, message, out) = table(&signal[1..], signal, (4000, "20000"), 3000);
        assert_eq!(status, Some(1), "{message}");
        let kept = out.lines().count() - 1;
        assert!(kept > 0 && kept < 4000, "{kept}: {message}");
        assert!(
            message.contains(&format!("ended early: the first {kept} of 4000 rows are written")),
            "{message}"
        );
        for (number, line) in out.lines().skip(1).enumerate() {
            assert!(line.starts_with(&format!("{number},")), "{line}");
        }
    }
}

/// Where no row was finished, the file that was there stays.
#[test]
fn an_old_table_is_not_replaced_by_an_empty_one() {
    let (status, message, out) = table("old", "-INT", (3, "10000000"), 1500);
    assert_eq!(status, Some(1), "{message}");
    assert!(message.contains("none of 3 rows was finished, and nothing is written"), "{message}");
    assert_eq!(out, "old\n");
}
