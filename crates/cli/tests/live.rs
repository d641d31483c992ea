//! `--live`: the report that contains the program.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

const CASE: &str = include_str!("../../../fixtures/sae-980025.toml");
const ENGINE: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

/// A folder with a case and a page.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("live").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("A.toml"), CASE).unwrap();
    let slot = "<script type=\"application/json\" id=\"deltav-live\">null</script>";
    let page = format!("<!doctype html>\n<meta name=\"deltav-engine\" content=\"{ENGINE}\">\n{slot}\n");
    fs::write(path.join("page.html"), page).unwrap();
    path
}

fn run(folder: &Path, arguments: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_deltav"));
    let output = command.current_dir(folder).args(arguments.split(' ')).output().unwrap();
    let [out, errors] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), out, errors)
}

#[test]
fn the_page_holds_the_report_of_the_same_command() {
    let folder = folder("report");
    for command in ["reconstruct A.toml", "reconstruct A.toml --units si"] {
        let (status, live, errors) =
            run(&folder, &format!("{command} --format html --live --page page.html"));
        assert_eq!(status, Some(0), "{errors}");
        let json = live.split("id=\"deltav-live\">").nth(1).unwrap().split("</script>").next().unwrap();
        let data: Value = serde_json::from_str(json).unwrap();
        assert_eq!(data["text"], CASE);
        assert_eq!(data["name"], "A.toml");
        assert_eq!(data["engine_sha256"], ENGINE);
        let (_, plain, _) = run(&folder, &format!("{command} --format html"));
        assert_eq!(data["report_sha256"], report::sha256(plain.as_bytes()));
    }
    let (status, _, errors) =
        run(&folder, "reconstruct A.toml --format html --live --page page.html -o live.html");
    assert_eq!((status, errors.as_str()), (Some(0), ""));
    assert!(fs::read_to_string(folder.join("live.html")).unwrap().contains(ENGINE));
}

#[test]
fn what_it_cannot_do_is_said() {
    let folder = folder("refused");
    fs::write(folder.join("other.html"), "<p>").unwrap();
    for (arguments, expected) in [
        ("--live", "add --format html, or leave out --live"),
        ("--format html --page page.html", "--live"),
        ("--format html --live", "there is none beside the program"),
        ("--format html --live --page none.html", "cannot read the page none.html"),
        ("--format html --live --page other.html", "other.html: this is not the page deltav.html"),
        ("--format html --live --page page.html -o page.html", "would overwrite the page page.html"),
    ] {
        let (status, out, errors) = run(&folder, &format!("reconstruct A.toml {arguments}"));
        assert_eq!((status, out.as_str()), (Some(2), ""), "{arguments}");
        assert!(errors.contains(expected), "{arguments}: {errors}");
    }
    let (status, _, errors) = run(&folder, "reconstruct A.toml A.toml --format html --live --page page.html");
    assert_eq!(status, Some(2));
    assert!(errors.contains("2 case files are given"), "{errors}");
}
