//! The picture that `site_plan` of `[scene]` names.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const CASE: &str = include_str!("../../../fixtures/rear-end-rest.toml");
const PLAN: &str =
    "site_plan = { file = \"plan.jpg\", corner = { x = \"-10 m\", y = \"-8 m\" }, width = \"40 m\" }";

/// A folder with `case.toml` on the plan, and `bare.toml` without.
fn folder(name: &str, has_picture: bool) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("site_plan").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    let on_plan = CASE.replacen("[scene]\n", &format!("[scene]\n{PLAN}\n"), 1);
    assert_ne!(on_plan, CASE);
    fs::write(path.join("case.toml"), on_plan).unwrap();
    fs::write(path.join("bare.toml"), CASE).unwrap();
    if has_picture {
        fs::copy("../drawing/tests/plans/colour.jpg", path.join("plan.jpg")).unwrap();
    }
    path
}

/// Status, output and errors, run in another folder than that of the case.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_deltav")).current_dir(folder).args(arguments).output().unwrap();
    let [out, errors] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), out, errors)
}

/// The picture itself is in the page, once, at the place where `deltav draw` puts it by its options.
#[test]
fn reports_and_drawings_show_the_plan_of_the_case() {
    let folder = folder("shown", true);
    let elsewhere = folder.parent().unwrap();
    let html = |case: &str| run(elsewhere, &["reconstruct", case, "--exact", "--format", "html"]).1;
    let [on_plan, bare] = ["shown/case.toml", "shown/bare.toml"].map(html);
    assert_eq!(on_plan.matches("data:image/jpeg;base64,").count(), 1);
    assert!(!bare.contains("data:image/"));

    let motion = ["draw", "shown/case.toml", "--what", "motion"];
    let (_, by_key, _) = run(elsewhere, &motion);
    let options = ["--site-plan", "shown/plan.jpg", "--plan-corner", "-10 m, -8 m", "--plan-width", "40 m"];
    let bare = ["draw", "shown/bare.toml", "--what", "motion"];
    let (_, by_option, _) = run(elsewhere, &[&bare[..], &options].concat());
    assert!(by_key.contains("data:image/jpeg;base64,"));
    assert_eq!(by_key, by_option);
    // An option takes precedence.
    let wider = ["--site-plan", "shown/plan.jpg", "--plan-corner", "-10 m, -8 m", "--plan-width", "50 m"];
    let (_, other, _) = run(elsewhere, &[&motion[..], &wider].concat());
    assert!(other.contains("data:image/jpeg;base64,") && other != by_key);
}

/// A survey is not replaced by a drawing of it, by either name.
#[test]
fn a_drawing_is_not_written_over_its_plan() {
    let folder = folder("kept", true);
    fs::rename(folder.join("plan.jpg"), folder.join("plan.png")).unwrap();
    let text = fs::read_to_string(folder.join("case.toml")).unwrap().replace("plan.jpg", "plan.png");
    fs::write(folder.join("case.toml"), text).unwrap();
    let before = fs::read(folder.join("plan.png")).unwrap();
    let options = ["--site-plan", "plan.png", "--plan-corner", "0 m, 0 m", "--plan-width", "40 m"];
    for (case, options) in [("case.toml", &[][..]), ("bare.toml", &options[..])] {
        let draw = ["draw", case, "--what", "motion", "-o", "./plan.png"];
        let (status, _, errors) = run(&folder, &[&draw[..], options].concat());
        assert_eq!(status, Some(2), "{errors}");
        assert!(errors.contains("would overwrite the site plan"), "{errors}");
        assert_eq!(fs::read(folder.join("plan.png")).unwrap(), before);
    }
}

/// A picture that is not needed need not exist; if it is needed, the error has its place in the file.
#[test]
fn a_plan_that_cannot_be_drawn_is_told_with_its_place() {
    let folder = folder("missing", false);
    let (status, _, errors) = run(&folder, &["reconstruct", "case.toml", "--exact"]);
    assert_eq!(status, Some(0), "{errors}");
    let page = ["reconstruct", "case.toml", "--exact", "--format", "html"];
    let draw = ["draw", "case.toml", "--what", "motion"];
    for arguments in [&page[..], &draw] {
        let (status, out, errors) = run(&folder, arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{errors}");
        assert!(errors.contains("cannot read the site plan plan.jpg"), "{errors}");
        assert!(errors.contains("case.toml:") && errors.contains("site_plan"), "{errors}");
    }
    fs::write(folder.join("plan.jpg"), "no picture").unwrap();
    let (status, _, errors) = run(&folder, &page);
    assert_eq!(status, Some(2));
    assert!(errors.contains("the site plan is neither a PNG nor a JPEG"), "{errors}");
}
