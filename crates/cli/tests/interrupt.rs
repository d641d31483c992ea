//! Ctrl-C during a long run of samples.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// The run ends with the results of what was done, and says so.
#[test]
fn ctrl_c_prints_the_results_so_far() {
    let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/sae-980025-uncertain.toml");
    // Many times more than the pause below is long enough for.
    let child = Command::new(env!("CARGO_BIN_EXE_deltav"))
        .args(["uncertainty", fixture, "--samples", "30000000", "--threads", "1"])
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
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(text.contains("Ended early: 30,000,000 samples were requested."), "{text}");
    assert!(text.contains("Speed of vehicle 1"), "{text}");
}
