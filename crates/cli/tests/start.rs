//! What a user begins with: `deltav new`, `schema`, `completions` and `man`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

const TEMPLATES: [&str; 10] = [
    "front-side",
    "head-on",
    "rear-end",
    "rear-end-rest",
    "intersection",
    "barrier",
    "sideswipe",
    "ees",
    "heavy-truck",
    "one-vehicle",
];

/// The templates in which neither speed is known, and the speeds for which their rest positions were
/// computed,
/// in km/h and in mph.
const NEITHER_KNOWN: [(&str, [[f64; 2]; 2]); 2] =
    [("rear-end-rest", [[54.0, 0.0], [34.0, 0.0]]), ("intersection", [[50.0, 40.0], [32.0, 25.0]])];

fn deltav(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_deltav"));
    command.args(arguments).env("DELTAV_PROGRESS", "off").output().unwrap()
}

/// The output of the program, which must report no error.
#[track_caller]
fn printed(arguments: &[&str]) -> String {
    let output = deltav(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*message), (Some(0), ""), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// A path at which there is no file yet.
fn temporary(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    let _ = fs::remove_file(&path);
    path
}

/// Each template states its speed or its EES, which comes from a solution of the raw impulse equations and a
/// numerical integral of the crush energy, made without this program. Those in which neither speed is known
/// are tested below.
#[test]
fn every_template_runs_as_it_is_and_finds_what_it_states() {
    // (m/s) a kilometre and a mile (exactly 1609.344 m) per hour
    for (units, named, size) in [("si", "km/h", 1.0 / 3.6), ("us", "mph", 1609.344 / 3600.0)] {
        for template in TEMPLATES {
            let path = temporary(&format!("{template}-{units}.toml"));
            let name = path.to_str().unwrap();
            printed(&["new", "--template", template, "--units", units, "-o", name]);
            let text = fs::read_to_string(&path).unwrap();
            let alone = template == "one-vehicle";
            let (command, states, place) = if alone {
                ("crush", "it finds an EES of ", "/vehicle1/ees")
            } else {
                ("reconstruct", "it finds vehicle 1 at ", "/found/value")
            };
            assert!(text.contains(&format!("deltav {command} case.toml\n")), "{template}");
            let mut stated = text.split(states).nth(1).unwrap().split_whitespace();
            let speed: f64 = stated.next().unwrap().parse().unwrap();
            assert_eq!(stated.next().unwrap().trim_end_matches('.'), named, "{template}");
            let json = |command: &str, options: &[&str]| -> Value {
                let arguments = [&[command, name, "--format", "json"], options].concat();
                serde_json::from_str(&printed(&arguments)).unwrap()
            };
            let neither = NEITHER_KNOWN.iter().find(|(name, _)| *name == template);
            // Weighing all evidence takes long, and uses the same numbers in either system.
            let is_exact = units == "us" && !alone;
            let exact: &[&str] = if is_exact { &["--exact"] } else { &[] };
            let result = json(command, exact);
            if let Some((_, true_speeds)) = neither {
                let second = text.split("and vehicle 2 at ").nth(1).unwrap();
                let second: f64 = second.split_whitespace().next().unwrap().parse().unwrap();
                let true_speeds = true_speeds[usize::from(units == "us")];
                for (i, (stated, true_speed)) in [speed, second].into_iter().zip(true_speeds).enumerate() {
                    let found = result["found"][i]["value"].as_f64().unwrap() / size;
                    assert!((found - stated).abs() <= 0.05, "{template}: {found} {named}, not {stated}");
                    // Rounding the rest positions changes the speeds by less than 1 km/h.
                    assert!((found - true_speed).abs() * size <= 1.0 / 3.6, "{template}: {found} {named}");
                }
            } else {
                let found = result.pointer(place).unwrap().as_f64().unwrap() / size;
                // One decimal is stated.
                assert!((found - speed).abs() <= 0.05, "{template}: {found} {named}, not {speed}");
            }
            // The stiffness of the fleet is the usual one without a test of the car.
            let warnings = result["warnings"].as_array().unwrap();
            let mut others = warnings.iter().filter(|warning| warning["code"] != "fleet-energy");
            assert_eq!(others.next(), None, "{template} in {units}");
            assert!(warnings.is_empty() || text.contains("= \"fleet\""), "{template} in {units}");
            if !alone && neither.is_none() {
                assert_eq!(result["found"]["admissible_roots"], 1, "{template}");
            }
            // With more evidence than an exact solution uses, the estimate leads, and its interval contains
            // the stated value.
            let weighed = result["headline"]["by"] == "estimate";
            assert!(
                weighed || is_exact || result["headline"].is_null() || result["headline"]["by"] == "exact",
                "{template}"
            );
            if let Some((_, true_speeds)) = neither.filter(|_| weighed) {
                let true_speeds = true_speeds[usize::from(units == "us")];
                for (vehicle, true_speed) in ["vehicle1", "vehicle2"].into_iter().zip(true_speeds) {
                    let interval = &result["headline"][vehicle]["speed"]["interval95"];
                    let [low, high] = [0, 1].map(|end| interval[end].as_f64().unwrap() / size);
                    assert!(low <= true_speed && true_speed <= high, "{template}: {interval}");
                }
            }
            // A full report samples the search back from rest, too slowly for this test.
            for written in ["text", "html", "markdown"] {
                if neither.is_some() || (units == "us" && written != "markdown") {
                    continue;
                }
                let is_weighed = weighed && written == "text";
                let exact: &[&str] = if alone || is_weighed { &[] } else { &["--exact"] };
                let report = printed(&[&[command, name, "--format", written], exact].concat());
                let told = match (is_weighed, warnings.is_empty()) {
                    (true, _) => "Objections to the exact solution",
                    (_, true) => "No warnings.",
                    _ => "fleet-energy",
                };
                assert!(report.contains(told), "{template}");
                // A report on one vehicle does not speak of two.
                if written == "markdown" {
                    assert_eq!(report.contains("Two rigid bodies collide"), !alone, "{template}");
                    assert!(!alone || !report.contains("energy of both vehicles"), "{template}");
                }
            }
            let judged = json("check", &[]);
            assert_eq!(judged["warnings"], Value::Array(Vec::new()), "{template} in {units}");
            let runs =
                &judged["commands"].as_array().unwrap().iter().find(|ability| ability["command"] == command);
            assert_eq!(runs.unwrap()["runs"], true, "{template} in {units}");
            // A template in inches does not mention centimetres, and the other way round.
            let own: &[&str] = if units == "us" {
                &["lb", "in", "ft", "mph", "deg"]
            } else {
                &["kg", "t", "m", "cm", "km/h", "m/s", "deg"]
            };
            for input in judged["inputs"].as_array().unwrap() {
                if let Some(unit) = input["unit"].as_str() {
                    assert!(own.contains(&unit), "{template} in {units}: {input}");
                    // Round numbers in the unit: they do not look converted.
                    let number = input["number"].as_f64().unwrap() * if units == "us" { 2.0 } else { 100.0 };
                    assert!((number - number.round()).abs() < 1e-9, "{template} in {units}: {input}");
                }
            }
        }
    }
}

/// The units in the text of the templates.
const UNITS: [&str; 14] =
    ["lb", "kg", "kJ", "kN", "t", "in", "ft", "m", "cm", "mph", "ft/s", "lb/in", "N/cm", "lb/in^2"];

/// The two differ in their numbers and units alone, and quote no unit of the other system.
#[test]
fn the_templates_of_a_kind_say_the_same() {
    for template in TEMPLATES {
        let [si, us] = ["si", "us"].map(|units| {
            let text = printed(&["new", "--template", template, "--units", units]);
            if units == "si" {
                for foreign in [" lb\"", " in\"", " ft\"", " mph\"", "lb/in"] {
                    assert!(!text.contains(foreign), "{template}: {foreign}");
                }
            }
            let without = |line: &str| -> String {
                let masses = line.replace("weight", "mass").replace("km/h", "mph").replace("m/s", "ft/s");
                let words =
                    masses.split_whitespace().filter(|word| !word.contains(|c: char| c.is_ascii_digit()));
                let words = words.map(|word| word.trim_end_matches(['"', ',', '.']));
                words.filter(|word| !UNITS.contains(word)).collect::<Vec<_>>().join(" ")
            };
            text.lines().map(without).collect::<Vec<String>>()
        });
        assert_eq!(si, us, "{template}");
    }
}

/// The error of a missing speed points to the recipe for two unknown speeds, and that of one vehicle alone
/// to the second vehicle.
#[test]
fn what_a_case_lacks_is_told_with_the_way_on() {
    for (template, command, left_out, expected) in [
        (
            "rear-end",
            "reconstruct",
            "speed ",
            "if neither speed is known, `deltav estimate` finds both from all evidence; `deltav explain two unknown speeds`",
        ),
        ("one-vehicle", "impact", "", "`vehicle2` is missing: `deltav impact` needs it"),
    ] {
        let path = temporary(&format!("lacks-{template}.toml"));
        let text = printed(&["new", "--template", template]);
        let kept = text.lines().filter(|line| left_out.is_empty() || !line.starts_with(left_out));
        fs::write(&path, kept.collect::<Vec<_>>().join("\n")).unwrap();
        let output = deltav(&[command, path.to_str().unwrap()]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && message.contains(expected), "{message}");
    }
    assert!(printed(&["explain", "two", "unknown", "speeds"]).starts_with("two unknown speeds\n"));
}

/// A line of a template sets a value, or explains one.
#[test]
fn every_template_explains_its_tables() {
    for (template, units) in TEMPLATES.into_iter().flat_map(|template| [(template, "si"), (template, "us")]) {
        let text = printed(&["new", "--template", template, "--units", units]);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "#:schema case.schema.json");
        assert!(
            lines.iter().all(|line| line.chars().count() <= 125 && line.trim_end() == *line),
            "{template}"
        );
        // Of vehicle 1 and of the impact, each key has a comment behind it or above it.
        let mut table = "";
        for pair in lines.windows(2) {
            let [above, line] = *pair else { continue };
            if line.starts_with('[') {
                table = line.split(']').next().unwrap();
            }
            let explains = line.contains(" # ") || above.starts_with('#');
            let is_key = line.contains(" = ") && !line.starts_with('#');
            let is_first_of_its_kind =
                ["[vehicle1", "[vehicle1.crush", "[impact", "[reconstruct"].contains(&table);
            // The name speaks for itself.
            if is_key && is_first_of_its_kind && !line.starts_with("name") {
                assert!(explains, "{template}: {table}] {line}");
            }
        }
    }
    assert_eq!(printed(&["new"]), printed(&["new", "--template", "front-side", "--units", "si"]));
}

#[test]
fn an_existing_file_is_not_overwritten() {
    let path = temporary("existing.toml");
    fs::write(&path, "# mine").unwrap();
    let name = path.to_str().unwrap();
    let output = deltav(&["new", "-o", name]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        message,
        format!(
            "error: {name} exists already, and is not overwritten: give another name, or remove it first\n"
        )
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "# mine");
}

#[test]
fn the_schema_is_the_committed_one() {
    let path = temporary("case.schema.json");
    printed(&["schema", "-o", path.to_str().unwrap()]);
    let committed = include_str!("../../../docs/case.schema.json");
    assert!(fs::read_to_string(&path).unwrap() == committed && printed(&["schema"]) == committed);
}

/// The commands that the help lists.
fn commands() -> Vec<String> {
    let help = printed(&["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Do the job:").take_while(|line| *line != "Options:");
    let names = lines.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<String> =
        names.filter_map(|line| line.split_whitespace().next().map(str::to_owned)).collect();
    assert!(names.len() >= 18, "{names:?}");
    names.into_iter().filter(|name| name != "help").collect()
}

#[test]
fn completions_know_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = printed(&["completions", shell]);
        for command in commands() {
            assert!(script.contains(&command), "{shell} does not know {command}");
        }
        // The other two do not complete values.
        if ["bash", "zsh", "fish"].contains(&shell) {
            assert!(script.contains("front-side"), "{shell}");
        }
        // Of positional values, these two.
        if ["bash", "zsh"].contains(&shell) {
            assert!(script.contains("delta-v-differs"), "{shell}");
        }
    }
}

#[test]
fn bash_reads_its_completions() {
    let path = temporary("deltav.bash");
    fs::write(&path, printed(&["completions", "bash"])).unwrap();
    // Without bash, nobody needs them.
    if let Ok(output) = Command::new("bash").arg("-n").arg(&path).output() {
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = temporary("man1");
    fs::create_dir(&folder).unwrap();
    assert_eq!(printed(&["man", "--output-dir", folder.to_str().unwrap()]), "");
    let page_of_deltav = fs::read_to_string(folder.join("deltav.1")).unwrap();
    assert_eq!(page_of_deltav, printed(&["man"]));
    for command in commands() {
        let page_of_command = fs::read_to_string(folder.join(format!("deltav-{command}.1"))).unwrap();
        assert!(page_of_command.contains(&format!(".TH deltav-{command} 1")), "{command}");
        assert!(page_of_deltav.contains(&format!(r"deltav\-{command}(1)")), "{command}");
    }
    // An argument that may be given several times, and one that may not.
    for (command, argument) in
        [("reconstruct", "CASE…"), ("explain", "TOPIC…"), ("uncertainty", "CASE…"), ("check", "CASE")]
    {
        let page = fs::read_to_string(folder.join(format!("deltav-{command}.1"))).unwrap();
        assert!(page.contains(&format!("\\fI{argument}\\fR")), "{command}: {page}");
    }
    // A folder is made if there is none, but not within a file.
    let new = folder.join("made/for/them");
    assert_eq!(printed(&["man", "--output-dir", new.to_str().unwrap()]), "");
    assert_eq!(fs::read_to_string(new.join("deltav.1")).unwrap(), page_of_deltav);
    let nowhere = folder.join("deltav.1/folder");
    let nowhere = deltav(&["man", "--output-dir", nowhere.to_str().unwrap()]);
    assert_eq!(nowhere.status.code(), Some(2));
    let message = String::from_utf8(nowhere.stderr).unwrap();
    assert!(message.contains("deltav.1/folder cannot be made a folder: "), "{message}");
}

/// The file for the United Kingdom is that in SI units, with its speeds in whole miles per hour.
#[test]
fn the_templates_with_mph_are_those_in_si_units_but_for_speeds() {
    for template in TEMPLATES {
        let si = printed(&["new", "--template", template]);
        let path = temporary(&format!("{template}-uk.toml"));
        let name = path.to_str().unwrap();
        printed(&["new", "--template", template, "--units", "uk", "-o", name]);
        let uk = fs::read_to_string(&path).unwrap();
        assert!(!uk.contains("km/h"), "{template}");
        assert_eq!(si.lines().count(), uk.lines().count(), "{template}");
        for (si, uk) in si.lines().zip(uk.lines()).filter(|(si, _)| !si.starts_with("# As it stands")) {
            let [kilometres, miles]: [Vec<f64>; 2] = [(si, " km/h"), (uk, " mph")].map(|(line, unit)| {
                let parts: Vec<&str> = line.split(unit).collect();
                let before = parts[..parts.len() - 1].iter();
                before.map(|part| part.rsplit(['"', ' ']).next().unwrap().parse().unwrap()).collect()
            });
            assert_eq!(kilometres.len(), miles.len(), "{uk}");
            for (kilometres, miles) in kilometres.iter().zip(&miles) {
                // (km) a mile, exactly
                assert!((kilometres - 1.609344 * miles).abs() <= 0.8047, "{uk}");
            }
            if kilometres.is_empty() {
                assert_eq!(si, uk);
            }
        }
        let command: &[&str] =
            if template == "one-vehicle" { &["crush"] } else { &["reconstruct", "--exact"] };
        assert!(printed(&[command, &[name, "--units", "uk"]].concat()).contains(" mph"), "{template}");
    }
}

/// The values stated in the template of a recorder are those that `recorder` prints, and every command reads
/// it. In mph, the lists of km/h are lists of mph.
#[test]
fn the_template_of_a_recorder_finds_what_it_states() {
    for (units, unit) in [("si", "km/h"), ("us", "mph"), ("uk", "mph")] {
        let path = temporary(&format!("recorder-{units}.toml"));
        let name = path.to_str().unwrap();
        printed(&["new", "--template", "recorder", "--units", units, "-o", name]);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.lines().all(|line| line.chars().count() <= 125 && line.trim_end() == line), "{units}");
        // Without `--units`, in those of the file.
        let found = printed(&["recorder", name]);
        let speed = found.split("Speed of vehicle 1 at the impact: ").nth(1).unwrap();
        let speed = speed.split(" (").next().unwrap();
        assert!(speed.ends_with(unit), "{units}: {speed}");
        if units != "uk" {
            assert!(
                text.contains(&format!("# As it stands, deltav recorder finds car 1 at {speed}.")),
                "{units}: {speed}"
            );
        }
        assert!(found.contains("Pulse") && found.contains("complete"), "{found}");
        let check = printed(&["check", name]);
        assert!(check.contains("vehicle1.recorder.pre_crash") && check.contains("No warnings"), "{check}");
        // 1 mph = 1.609344 km/h: 12 14 16 18 20 km/h, and no list in which only one number was converted.
        assert_eq!(text.contains("\"7 9 10 11 12 mph\""), units != "si", "{units}");
    }
}
