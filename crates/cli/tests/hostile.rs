//! Case files, file names and command lines that try to write on the reader's screen.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The answer that the texts of the case try to forge, at the beginning of a line.
const FORGED: &str = "Speed of vehicle 1: 20.00 mph";

/// As TOML writes them: line feed, carriage return, escape, bell, backspace, null, CSI of C1, next line,
/// separators, characters that turn the direction of writing and some that leave no mark.
const ESCAPES: &str = r"\n\r\u001B[8m\u0007\b\u0000\u009B31m\u0085\u2028\u2029\u061C\u200E\u200F\u202A\u202E\u2066\u2069\u200B\u00AD\uFEFF\U000E0041\u007F";

/// An empty folder, and in it a case whose title, source, names and comment are hostile, as is its own name.
fn hostile(name: &str) -> (PathBuf, String) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("hostile").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let words = format!("Elm St.{ESCAPES}\\n{FORGED}{ESCAPES}");
    let text: String = fs::read_to_string("../../fixtures/sae-980025-uncertain.toml")
        .unwrap()
        .lines()
        .map(|line| match line.split_once(" = ").map(|(key, _)| key.trim()) {
            Some(key @ ("title" | "source" | "name")) => format!("{key} = \"{words}\"\n"),
            // For `deltav crush`.
            Some("side") => format!("{line}\npdof = \"10 deg\"\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    // TOML allows these in a comment as they are.
    let text = format!("# \u{9b}8m\u{202e}\u{85}\u{2066}\n{text}");
    let case = format!("a\n{FORGED}\r\u{1b}[8m\u{7}\u{9b}\u{202e}\u{2066}.toml");
    fs::write(folder.join(&case), text).unwrap();
    (folder, case)
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_deltav"))
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Neither acts on a terminal nor on the letters beside it; lines and their indents are the program's own.
#[track_caller]
fn harmless(what: &str, bytes: &[u8]) {
    let text = std::str::from_utf8(bytes).unwrap();
    for (number, line) in text.split('\n').enumerate() {
        assert!(!line.trim_start().starts_with(FORGED), "{what}: line {number} is forged: {line}");
        let acts = line.chars().find(|&c| {
            c.is_control()
                || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
                || matches!(c, '\u{ad}' | '\u{200b}' | '\u{feff}' | '\u{e0041}')
        });
        assert_eq!(acts, None, "{what}: line {number}: {line:?}");
    }
}

#[test]
fn no_text_of_a_case_acts_in_any_output() {
    let (folder, case) = hostile("outputs");
    let mut outputs = 0;
    let mut show = |arguments: &[&str]| {
        let what = arguments.join(" ").replace(&case, "CASE");
        let output = run(&folder, arguments);
        assert_eq!(output.status.code(), Some(0), "{what}: {}", String::from_utf8_lossy(&output.stderr));
        harmless(&what, &output.stdout);
        harmless(&what, &output.stderr);
        outputs += 1;
    };
    for command in ["reconstruct", "check", "crush", "compare", "sensitivity", "uncertainty"] {
        for format in ["text", "json", "html", "markdown"] {
            let mut arguments = vec![command, &case, "--format", format];
            if command == "uncertainty" {
                arguments.extend(["--samples", "2000", "--samples-out", "samples.csv", "--plots", "plots"]);
            }
            show(&arguments);
        }
    }
    for format in ["csv", "jsonl"] {
        show(&["reconstruct", &case, "--format", format]);
    }
    for what in ["scene", "damage", "reconciliation", "energy"] {
        show(&["draw", &case, "--what", what]);
    }
    assert_eq!(outputs, 30);
    for entry in fs::read_dir(folder.join("plots")).unwrap().chain(fs::read_dir(&folder).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "svg" || ending == "csv") {
            harmless(&path.display().to_string(), &fs::read(&path).unwrap());
        }
    }
}

/// Shown, not dropped: the reader sees that something is there.
#[test]
fn the_characters_are_shown() {
    let (folder, case) = hostile("shown");
    let output = run(&folder, &["reconstruct", &case]);
    let text = String::from_utf8(output.stdout).unwrap();
    let title = text.lines().next().unwrap();
    assert_eq!(
        title.split(FORGED).next().unwrap(),
        "Elm St.␊␍␛[8m␇␈␀⟨U+009B⟩31m⟨U+0085⟩⟨U+2028⟩⟨U+2029⟩⟨U+061C⟩⟨U+200E⟩⟨U+200F⟩⟨U+202A⟩⟨U+202E⟩⟨U+2066⟩⟨U+2069⟩⟨U+200B⟩⟨U+00AD⟩⟨U+FEFF⟩⟨U+E0041⟩␡␊"
    );
    let page = String::from_utf8(run(&folder, &["reconstruct", &case, "--format", "html"]).stdout).unwrap();
    assert!(page.contains("# ⟨U+009B⟩8m⟨U+202E⟩⟨U+0085⟩⟨U+2066⟩\n"), "the listing of the case file");
}

/// JSON escapes them: a program reads each letter.
#[test]
fn json_has_every_letter_of_a_title() {
    let (folder, case) = hostile("json");
    let output = run(&folder, &["reconstruct", &case, "--format", "json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let title = document["title"].as_str().unwrap();
    assert!(title.starts_with("Elm St.\n\r\u{1b}[8m\u{7}\u{8}\0\u{9b}31m\u{85}\u{2028}\u{2029}\u{61c}"));
    assert_eq!(document["vehicle1"]["name"], document["title"]);
}

#[test]
fn no_message_acts() {
    let (folder, case) = hostile("messages");
    let missing = format!("missing {case}");
    let other = format!("other {case}");
    let text = fs::read_to_string(folder.join(&case)).unwrap();
    let wrong =
        text.replacen("speed", &format!("\"sp\\u009Beed\\n{FORGED}\\u202E\" = \"\u{202e}\u{9b}\"\nspeed"), 1);
    let wrong = wrong.replacen("[impact]", "[impact]\nlaw = \"br\\nach\\u001b\\u009B\\u202E\"", 1);
    fs::write(folder.join(&other), wrong).unwrap();
    fs::copy("../../fixtures/estimate.toml", folder.join("both.toml")).unwrap();
    let output_over = ["reconstruct", &case, "-o", &other];
    for arguments in [
        &["reconstruct", &missing][..],
        &["reconstruct", &other],
        &["check", &other],
        &output_over,
        &["reconstruct", &case, "-o", &case],
        &["new", "-o", &case],
        &["draw", &case, "--what", "scene", "-o", &format!("{case}.gif")],
        &["draw", &case, "--what", &case],
        &["uncertainty", &case, "--plots", &case],
        &["uncertainty", &case, "--samples-out", &format!("none/{case}")],
        &["man", "--output-dir", &case],
        &["explain", &case],
        &["crush", &case, &case],
        &["validate", "--field", &missing],
        &["estimate", "both.toml", "--above", &format!("vehicle1.speed 5 {case}")],
        &["estimate", "both.toml", "--above", &format!("{case} 5 m/s")],
        &[&case],
        &["reconstruct", &format!("--{case}")],
    ] {
        let output = run(&folder, arguments);
        assert_ne!(output.status.code(), Some(0), "{arguments:?}");
        let message = format!("{arguments:?}");
        assert!(!output.stderr.is_empty(), "{message}");
        harmless(&message, &output.stdout);
        harmless(&message, &output.stderr);
    }
    // A row for a file that fails gives the reason.
    for format in ["csv", "jsonl"] {
        let output = run(&folder, &["reconstruct", &missing, &other, &case, "--format", format]);
        assert_eq!(output.status.code(), Some(1));
        harmless(format, &output.stdout);
        harmless(format, &output.stderr);
    }
}
