//! Large files give an error or a case, soon and in bounded memory, whatever they contain.

#![allow(clippy::panic, reason = "helpers of tests fail by panicking")]

use std::time::{Duration, Instant};

use case::{CaseFile, CaseProblem, Diagnostics};

const VEHICLE2: &str = "[vehicle2]\nfixed = true\n";

/// A linear reader takes less than a second for the worst of these, in a test build on a busy machine some
/// seconds. One that is quadratic in lines, keys or elements takes minutes.
const SOON: Duration = Duration::from_secs(20);

/// `head`, then `unit` as often as a case file has room for, then `tail`.
fn filled(head: &str, unit: &str, tail: &str) -> String {
    let room = CaseFile::LARGEST_FILE - head.len() - tail.len();
    format!("{head}{}{tail}", unit.repeat(room / unit.len()))
}

/// `line` with each number from zero, as often as a case file has room for.
fn numbered(line: impl Fn(usize) -> String) -> String {
    let mut text = String::new();
    for number in 0.. {
        let next = line(number);
        if text.len() + next.len() > CaseFile::LARGEST_FILE {
            break;
        }
        text += &next;
    }
    text
}

fn crush(line: &str) -> String {
    format!("[vehicle1]\n[vehicle1.crush]\n{line}")
}

/// Parses, and writes out what is wrong.
#[track_caller]
fn soon(name: &str, text: &str) -> Result<(), Diagnostics> {
    let start = Instant::now();
    let result = CaseFile::parse("large.toml", text).map(drop);
    if let Err(diagnostics) = &result {
        let shown = diagnostics.to_string();
        assert!(shown.len() < 100_000, "{name}: {} bytes of errors", shown.len());
    }
    assert!(start.elapsed() < SOON, "{name}: {:?}", start.elapsed());
    result
}

#[test]
fn ten_megabytes_are_refused_unread() {
    for part in ["\r", "[", "x\n", "[vehicle1]\n", "a.", "\0", "# comment\n"] {
        let text = part.repeat(10_000_000 / part.len());
        match soon(part, &text) {
            Ok(()) => panic!("{part:?} is accepted"),
            Err(found) => {
                assert_eq!(
                    *found.list()[0].problem(),
                    CaseProblem::TooLarge { limit: CaseFile::LARGEST_FILE }
                );
                assert_eq!(found.source().text(), "", "the text is not kept");
            }
        }
    }
}

#[test]
fn the_largest_file_is_read_soon() {
    let room = CaseFile::LARGEST_FILE;
    let vehicles = format!("[vehicle1]\nmass = \"1 kg\"\n{VEHICLE2}");
    for (name, text) in [
        ("comments", filled(&vehicles, "# x\n", "")),
        ("blank lines", filled(&vehicles, "\n", "")),
        ("one string", filled("title = \"", "x", &format!("\"\n{vehicles}"))),
        ("a string of many lines", filled("title = \"\"\"", "x\n", &format!("\"\"\"\n{vehicles}"))),
    ] {
        assert!(soon(name, &text).is_ok(), "{name} is refused");
    }
    for (name, text) in [
        ("unknown keys", numbered(|i| format!("k{i} = 1\n"))),
        ("near misses", numbered(|i| format!("vehicl_{i} = 1\n"))),
        ("unknown tables", numbered(|i| format!("[t{i}]\n"))),
        ("dotted keys", numbered(|i| format!("a.b.c{i} = 1\n"))),
        ("lists in lists", format!("a = {}{}", "[".repeat(room / 2 - 2), "]".repeat(room / 2 - 2))),
        ("tables in tables", format!("a = {}1{}", "{a=".repeat(room / 4 - 2), "}".repeat(room / 4 - 2))),
        ("open lists", filled("a = ", "[", "")),
        ("open tables", filled("a = ", "{a=", "")),
        ("one long key", filled("a", ".a", " = 1")),
        ("one long header", filled("[a", ".a", "]")),
        ("lines that are nothing", filled("", "x\n", "")),
        ("one line that is nothing", filled("", "x ", "")),
        ("quotes", filled("", "\"\n", "")),
        ("carriage returns", filled("", "\r", "")),
        ("zeros", filled("", "\0", "")),
        ("one key again and again", filled("", "a=1\n", "")),
        ("one table again and again", filled("", "[vehicle1]\n", "")),
        ("double brackets", filled("", "[[vehicle1]]\n", "")),
        ("a list of tables", filled("", "[[x]]\n", "")),
    ] {
        assert!(soon(name, &text).is_err(), "{name}: accepted");
    }
}

#[test]
fn profiles_and_zones_without_end_are_refused_soon() {
    let tail = &format!("\n{VEHICLE2}");
    let stations: Vec<String> = (0..100_000).map(|i| format!("{}.{}", 10 + i % 7, i % 10)).collect();
    let stations = stations.join(" ");
    let zone = "{ A = \"300 lb/in\", B = \"40 lb/in^2\" },";
    for (name, text) in [
        ("100,000 stations", crush(&format!("depths = \"{stations} in\"{tail}"))),
        ("depths in one text", filled(&crush("depths = \""), "1 ", &format!("in\"{tail}"))),
        ("depths one by one", filled(&crush("depths = ["), "\"1 in\",", &format!("]{tail}"))),
        ("depths without units", filled(&crush("depths = ["), "1,", &format!("]{tail}"))),
        (
            "ranges",
            filled(&crush("depths = ["), "{ low = \"19 in\", high = \"21 in\" },", &format!("]{tail}")),
        ),
        (
            "a range for each station",
            crush(&format!("depths = {{ values = \"{} in\", sd = \"1 in\" }}{tail}", "9 ".repeat(10_000))),
        ),
        (
            "zones",
            filled(&crush("depths = \"1 2 in\"\nstiffness = { zones = ["), zone, &format!("] }}{tail}")),
        ),
        ("zones of nothing", filled(&crush("stiffness = { zones = ["), "{},", &format!("] }}{tail}"))),
        (
            "zones with wrong keys",
            filled(&crush("stiffness = { zones = ["), "{a=1},", &format!("] }}{tail}")),
        ),
        ("zones that are numbers", filled(&crush("stiffness = { zones = ["), "1,", &format!("] }}{tail}"))),
    ] {
        assert!(soon(name, &text).is_err(), "{name}: accepted");
    }
}
