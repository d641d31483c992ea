//! There are no dependency cycles between the files of a crate: each can be read with only those below it.
//!
//! The arrows are the paths in the sources: `crate::a::b`, `super::`, `self::` and those that begin with a
//! module declared in the same file. A name that a file re-exports counts as the file that defines it, so
//! that no circle hides behind the crate root. Tests and items defined in the crate root do not count, nor do
//! methods, which have no path.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;
use std::path::Path;

/// The names that lead to a module; empty for the crate root.
type Module = Vec<String>;

/// The modules of the names that each file of a crate uses.
type Arrows = BTreeMap<Module, BTreeSet<Module>>;

/// The relevant content of a file of a crate.
#[derive(Default)]
struct File {
    /// The modules that it declares.
    children: BTreeSet<String>,
    /// The names given by its `use` declarations.
    names: BTreeMap<String, Vec<String>>,
    /// The paths in it.
    paths: Vec<Vec<String>>,
}

/// Identifiers, `::` and single characters, without comments and string literals.
fn tokens(source: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = source;
    let is_of_name = |letter: char| letter.is_alphanumeric() || letter == '_';
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if first == '"' {
            text(rest)
        } else if first == '\'' {
            letter(rest)
        } else if let Some(length) = raw_text(rest) {
            length
        } else {
            let length = match first {
                ':' if rest.starts_with("::") => 2,
                _ if is_of_name(first) => rest.find(|next| !is_of_name(next)).unwrap_or(rest.len()),
                _ => first.len_utf8(),
            };
            if !first.is_whitespace() {
                found.push(&rest[..length]);
            }
            length
        };
        rest = &rest[length..];
    }
    found
}

/// (bytes) length of a string literal in quotation marks.
fn text(source: &str) -> usize {
    let mut is_escaped = true;
    let end = source.char_indices().find(|&(_, letter)| {
        let ends = letter == '"' && !is_escaped;
        is_escaped = letter == '\\' && !is_escaped;
        ends
    });
    end.map_or(source.len(), |(place, _)| place + 1)
}

/// (bytes) length of a raw string literal such as `r#"…"#`, if it is one.
fn raw_text(source: &str) -> Option<usize> {
    let after = source.strip_prefix("br").or_else(|| source.strip_prefix('r'))?;
    let hashes = after.len() - after.trim_start_matches('#').len();
    let inside = after[hashes..].strip_prefix('"')?;
    let end = inside.find(&format!("\"{}", "#".repeat(hashes)))?;
    Some(source.len() - inside.len() + end + 1 + hashes)
}

/// (bytes) length of a character literal, or of the quote before the name of a lifetime.
fn letter(source: &str) -> usize {
    let mut letters = source.char_indices().skip(1);
    match letters.next() {
        Some((_, '\\')) => source[3..].find('\'').map_or(source.len(), |end| end + 4),
        Some(_) => letters.next().filter(|&(_, letter)| letter == '\'').map_or(1, |(place, _)| place + 1),
        None => 1,
    }
}

/// The tokens without the items that exist only for tests.
fn without_tests<'a>(all: &[&'a str]) -> Vec<&'a str> {
    let marked = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut kept, mut place) = (Vec::new(), 0);
    while place < all.len() {
        if !all[place..].starts_with(&marked) {
            kept.push(all[place]);
            place += 1;
            continue;
        }
        let mut depth = 0;
        // An item ends with a semicolon or with its braces.
        while let Some(&token) = all.get(place) {
            place += 1;
            match token {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth -= 1,
                _ => {}
            }
            if depth == 0 && (token == ";" || token == "}") {
                break;
            }
        }
    }
    kept
}

/// The paths that begin at a place, one for each leaf of their braces, each with the name given to its end;
/// also returns where they end.
fn leaves(
    all: &[&str],
    mut place: usize,
    before: &[String],
    found: &mut Vec<(Vec<String>, String)>,
) -> usize {
    let mut path = before.to_vec();
    loop {
        match all.get(place) {
            Some(&"{") => {
                place += 1;
                while let Some(&token) = all.get(place).filter(|token| **token != "}") {
                    place = if token == "," { place + 1 } else { leaves(all, place, &path, found) };
                }
                return place + 1;
            }
            Some(&name) => {
                path.push(name.to_owned());
                place += 1;
            }
            None => return place,
        }
        if all.get(place) != Some(&"::") {
            break;
        }
        place += 1;
    }
    // `a::b::{self}` is `a::b`.
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    let mut name = path.last().cloned().unwrap_or_default();
    if all.get(place) == Some(&"as") {
        name = all.get(place + 1).copied().unwrap_or_default().to_owned();
        place += 2;
    }
    found.push((path, name));
    place
}

fn is_name(token: &str) -> bool {
    token.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

fn file(source: &str) -> File {
    let all = tokens(source);
    let all = without_tests(&all);
    let mut file = File::default();
    let mut place = 0;
    while place < all.len() {
        match all[place..] {
            ["mod", name, ";", ..] => {
                file.children.insert(name.to_owned());
                place += 3;
            }
            ["use", ..] => {
                let mut found = Vec::new();
                place = leaves(&all, place + 1, &[], &mut found);
                file.paths.extend(found.iter().map(|(path, _)| path.clone()));
                file.names.extend(found.into_iter().map(|(path, name)| (name, path)));
            }
            [first, "::", ..] if is_name(first) => {
                let mut found = Vec::new();
                place = leaves(&all, place, &[], &mut found);
                file.paths.extend(found.into_iter().map(|(path, _)| path));
            }
            // After two colons without a name before them, a crate.
            ["::", ..] => place = leaves(&all, place + 1, &[], &mut Vec::new()),
            _ => place += 1,
        }
    }
    file
}

/// The declared files of a crate, from its root on.
fn files(read: impl Fn(&Module) -> String) -> BTreeMap<Module, File> {
    let mut found = BTreeMap::new();
    let mut open = vec![Module::new()];
    while let Some(module) = open.pop() {
        let file = file(&read(&module));
        open.extend(file.children.iter().map(|child| module.iter().chain([child]).cloned().collect()));
        found.insert(module, file);
    }
    found
}

fn files_of(folder: &Path) -> BTreeMap<Module, File> {
    let root = ["lib.rs", "main.rs"].into_iter().find(|name| folder.join(name).exists()).unwrap();
    files(|module| {
        let name = if module.is_empty() { root.to_owned() } else { format!("{}.rs", module.join("/")) };
        fs::read_to_string(folder.join(name)).unwrap()
    })
}

/// The module with the target of a path in another one; `None` if it is in another crate.
fn target(files: &BTreeMap<Module, File>, from: &Module, path: &[String], depth: usize) -> Option<Module> {
    let mut at = from.clone();
    let mut names = path.iter().peekable();
    match path.first()?.as_str() {
        "crate" => {
            at.clear();
            names.next();
        }
        "self" => drop(names.next()),
        "super" => {
            while names.next_if(|name| *name == "super").is_some() {
                at.pop();
            }
        }
        first if files[from].children.contains(first) => {}
        first => {
            let known = files[from].names.get(first).filter(|known| *known != path && depth > 0)?;
            let whole: Vec<String> = known.iter().chain(&path[1..]).cloned().collect();
            return target(files, from, &whole, depth - 1);
        }
    }
    while let Some(name) = names.next() {
        let file = &files[&at];
        if file.children.contains(name) {
            at.push(name.clone());
        } else if let Some(known) = file.names.get(name).filter(|_| depth > 0) {
            let whole: Vec<String> = known.iter().chain(names).cloned().collect();
            return target(files, &at, &whole, depth - 1).or(Some(at));
        } else {
            break;
        }
    }
    Some(at)
}

fn arrows(files: &BTreeMap<Module, File>) -> Arrows {
    /// Names are re-exported fewer times than this.
    const DEEPEST: usize = 8;
    let of = |(module, file): (&Module, &File)| {
        let targets = file.paths.iter().filter_map(|path| target(files, module, path, DEEPEST));
        (module.clone(), targets.filter(|target| target != module && !target.is_empty()).collect())
    };
    files.iter().filter(|(module, _)| !module.is_empty()).map(of).collect()
}

/// The shortest path along the arrows from a module back to it.
fn circle(arrows: &Arrows, start: &Module) -> Option<Vec<Module>> {
    let mut before: BTreeMap<&Module, &Module> = BTreeMap::new();
    let mut open = VecDeque::from([start]);
    while let Some(module) = open.pop_front() {
        for next in &arrows[module] {
            if next == start {
                let mut way = vec![start.clone(), module.clone()];
                while let Some(earlier) = before.get(way.last()?) {
                    way.push((*earlier).clone());
                }
                way.reverse();
                return Some(way);
            }
            if !before.contains_key(next) {
                before.insert(next, module);
                open.push_back(next);
            }
        }
    }
    None
}

/// A shortest circle, if there is any.
///
/// A module and its submodules may refer to each other. So first the arrows from a file to its enclosing
/// modules are left out, then those to its submodules: neither of the remaining graphs has a circle.
fn shortest_circle(files: &BTreeMap<Module, File>) -> Option<String> {
    let all = arrows(files);
    let without = |is_left_out: fn(&Module, &Module) -> bool| {
        let mut arrows = all.clone();
        for (module, targets) in &mut arrows {
            targets.retain(|target| !is_left_out(module, target));
        }
        arrows.keys().filter_map(|module| circle(&arrows, module)).min_by_key(Vec::len)
    };
    let outward = without(|module, target| module.starts_with(target));
    let inward = without(|module, target| target.starts_with(module));
    let found = outward.into_iter().chain(inward).min_by_key(Vec::len)?;
    Some(found.iter().map(|module| module.join("::")).collect::<Vec<_>>().join(" → "))
}

#[test]
fn no_files_of_a_crate_need_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path().join("src"));
    let (mut count, mut circles) = (0, Vec::new());
    for folder in crates {
        let files = files_of(&folder);
        count += files.values().map(|file| file.paths.len()).sum::<usize>();
        circles.extend(shortest_circle(&files).map(|circle| format!("{}: {circle}", folder.display())));
    }
    assert!(count > 5000, "{count}");
    assert!(circles.is_empty(), "files need each other in a circle: {circles:#?}");
}

/// The shortest circle in a crate of these files.
fn in_crate(sources: &[(&str, &str)]) -> Option<String> {
    shortest_circle(&files(|module| {
        let name = module.join("::");
        sources.iter().find(|(module, _)| *module == name).unwrap().1.to_owned()
    }))
}

#[test]
fn circles_are_found() {
    let root = ("", "mod a; mod b; pub use b::{B as C, other};");
    let b = ("b", "pub struct B; fn f() { super::a::g() }");
    // Through the module, through the name in the root, among others in braces, and through a third file.
    for a in ["crate::b::B::new()", "use crate::C;", "use crate::{other as x, C}; fn h() {}", "use super::b;"]
    {
        assert_eq!(in_crate(&[root, ("a", a), b]).as_deref(), Some("a → b → a"), "{a}");
    }
    let three = ("", "mod a; mod b; mod c;");
    let third = ("c", "use crate::b;");
    assert_eq!(in_crate(&[three, ("a", "use crate::c::b::B;"), b, third]).as_deref(), Some("a → b → a"));
    assert_eq!(in_crate(&[three, ("a", "use crate::c::X;"), b, third]).as_deref(), Some("a → c → b → a"));
}

#[test]
fn what_is_no_arrow_is_none() {
    let root = ("", "mod a; mod b; pub struct Of;");
    let b = ("b", "use crate::a::A;");
    for a in [
        "// use crate::b;",
        "/* crate::b */ fn f() -> &'static str { \"crate::b\" }",
        "const T: &str = r#\"\" crate::b::B\"#; const C: char = '\"'; fn f<'a>() {}",
        "#[cfg(test)]\nmod tests { use crate::b::B; }",
        "#[cfg(test)]\nuse crate::b::{B, C};",
        "use ::b::B; use crate::Of; use other::b;",
    ] {
        assert_eq!(in_crate(&[root, ("a", a), b]), None, "{a}");
    }
}

#[test]
fn a_module_and_those_inside_of_it_may_know_each_other() {
    let root = ("", "mod a; mod b;");
    let inside = ("a::c", "use super::A; use crate::b;");
    let a = ("a", "mod c; pub use c::C; fn f() { c::g() }");
    assert_eq!(in_crate(&[root, a, inside, ("b", "")]), None);
    // From outside, neither leads back.
    assert_eq!(in_crate(&[root, a, inside, ("b", "use crate::a::A;")]).as_deref(), Some("a → a::c → b → a"));
    assert_eq!(in_crate(&[root, a, inside, ("b", "use crate::a::C;")]).as_deref(), Some("a::c → b → a::c"));
}
