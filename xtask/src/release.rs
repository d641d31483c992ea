//! The files of a release, built without publishing anything: a machine builds its part with `--dry-run`, and
//! the workflow of a release puts the parts of several machines together.

mod archive;
mod bill;
mod notes;
mod order;
mod sums;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::book;
use crate::tools::{cargo, is_installed, output, run, say, target_folder};

/// The parts and steps of a release to do.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  cargo run -p xtask -- release --dry-run
  cargo run -p xtask -- release --dry-run --skip page,wheel
  cargo run -p xtask -- release --dry-run --only program --target x86_64-pc-windows-gnu
  cargo run -p xtask -- release --dry-run --only program --target aarch64-unknown-linux-musl
  cargo run -p xtask -- release --publish-order

A part whose tools are missing is left out, and a sentence at the end says so. A part that was named by --only
has to be built: without its tools, that is an error.")]
pub(crate) struct Options {
    #[command(flatten)]
    action: Action,

    /// The parts to build, separated by commas [default: all]
    #[arg(long, value_name = "PARTS", value_delimiter = ',', conflicts_with = "skip")]
    only: Vec<Part>,

    /// The parts to leave out, separated by commas
    #[arg(long, value_name = "PARTS", value_delimiter = ',')]
    skip: Vec<Part>,

    /// The machine to build the program for [default: Linux with musl where that is installed, or this machine]
    #[arg(long, value_name = "TRIPLE")]
    target: Option<String>,

    /// The folder to write into [default: target/dist]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Action {
    /// Build all parts that this machine can build, and publish nothing
    #[arg(long)]
    dry_run: bool,

    /// Print the crates, one a line, in an order in which the registry accepts them
    #[arg(long)]
    publish_order: bool,

    /// Print the notes of this version from CHANGELOG.md
    #[arg(long)]
    notes: bool,

    /// Write SHA256SUMS for all files of the folder
    #[arg(long)]
    sums: bool,

    /// Publish the crates in their order: this cannot be undone
    #[arg(long)]
    publish: bool,
}

/// A part of the files of a release.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The program with licences, manual page and completions, as an archive
    Program,
    /// The page, deltav.html
    Page,
    /// The wheel for Python
    Wheel,
    /// The source distribution for Python
    Sdist,
    /// The book, with a copy of the page that links into it
    Book,
    /// The packages of the crates
    Packages,
    /// The software bill of materials
    Bill,
}

/// The folders, and the version.
struct Place {
    root: PathBuf,
    target: PathBuf,
    out: PathBuf,
    version: String,
    triple: String,
    metadata: Value,
}

/// Carries out the options.
pub(crate) fn run_release(root: &Path, options: &Options) -> Result<()> {
    let place = place(root, options)?;
    let action = &options.action;
    if action.publish_order {
        order::of(&place.metadata)?.iter().try_for_each(|name| say(name))
    } else if action.notes {
        let changes =
            fs::read_to_string(place.root.join("CHANGELOG.md")).context("cannot read CHANGELOG.md")?;
        say(&notes::of(&changes, &place.version))
    } else if action.sums {
        sums::write(&place.out)
    } else if action.publish {
        let publish = |name: &String| {
            run(Command::new(cargo()).args(["publish", "--locked", "-p", name]).current_dir(&place.root))
        };
        order::of(&place.metadata)?.iter().try_for_each(publish)
    } else {
        dry_run(&place, options)
    }
}

fn place(root: &Path, options: &Options) -> Result<Place> {
    let root = root.canonicalize().context("cannot find the repository")?;
    let target = target_folder(&root);
    let out = options.out.clone().unwrap_or_else(|| target.join("dist"));
    let mut ask = Command::new(cargo());
    ask.args(["metadata", "--locked", "--format-version", "1"]).current_dir(&root);
    let metadata: Value = serde_json::from_slice(&output(&mut ask)?).context("cargo metadata is no JSON")?;
    let program = metadata["packages"]
        .as_array()
        .and_then(|packages| packages.iter().find(|package| package["name"] == "deltav-cli"));
    let version = program.and_then(|package| package["version"].as_str());
    let version = version.context("cargo metadata has no deltav-cli")?.to_owned();
    let triple = match &options.target {
        Some(triple) => triple.clone(),
        None => archive::best_target()?,
    };
    Ok(Place { root, target, out, version, triple, metadata })
}

fn dry_run(place: &Place, options: &Options) -> Result<()> {
    fs::create_dir_all(&place.out).with_context(|| format!("cannot make {}", place.out.display()))?;
    let wanted = |part: &&Part| match options.only.as_slice() {
        [] => !options.skip.contains(part),
        only => only.contains(part),
    };
    let mut left_out = Vec::new();
    for part in Part::value_variants() {
        let name = part.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
        if !wanted(&part) {
            left_out.push(format!("{name}: not asked for"));
            continue;
        }
        say(&format!("== {name}"))?;
        match missing(*part, &place.root) {
            Some(reason) if options.only.is_empty() => left_out.push(format!("{name}: {reason}")),
            Some(reason) => bail!("cannot build {name}: {reason}"),
            None => left_out.extend(build(*part, place).with_context(|| format!("cannot build {name}"))?),
        }
    }
    sums::write(&place.out)?;
    say(&format!("\ndeltav {} is in {}:", place.version, place.out.display()))?;
    say(fs::read_to_string(place.out.join(sums::NAME)).context("cannot read the sums")?.trim_end())?;
    if !left_out.is_empty() {
        say("\nNot built:")?;
        left_out.iter().try_for_each(|line| say(&format!("- {line}")))?;
    }
    Ok(())
}

/// Why a part cannot be built here, in words.
fn missing(part: Part, root: &Path) -> Option<&'static str> {
    match part {
        Part::Page if !is_installed("npm") => Some("npm is not installed"),
        Part::Wheel | Part::Sdist if !is_installed("maturin") => {
            Some("maturin is not installed; `pip install maturin` brings it")
        }
        Part::Book if book::program(root).is_none() => Some(book::HOW_TO_INSTALL),
        _ => None,
    }
}

/// Builds a part, and returns what could not be built.
fn build(part: Part, place: &Place) -> Result<Vec<String>> {
    match part {
        Part::Program => return archive::program(place),
        Part::Page => page(place)?,
        Part::Wheel => maturin(place, &["build", "--locked"])?,
        Part::Sdist => maturin(place, &["sdist"])?,
        Part::Book => {
            let folder = place.target.join("book/html");
            book::build(&place.root, Some(&folder))?;
            let page = place.out.join("deltav.html");
            if page.exists() {
                book::add_page(&folder, &page)?;
            }
            archive::tar(place, &folder, &format!("deltav-{}-book", place.version))?;
            if !page.exists() {
                return Ok(vec![format!("the page in the book: {} is not there", page.display())]);
            }
        }
        Part::Packages => packages(place)?,
        Part::Bill => {
            let lock = fs::read_to_string(place.root.join("Cargo.lock")).context("cannot read Cargo.lock")?;
            let bill = bill::of(&place.metadata, &lock, "deltav-cli")?;
            let file = place.out.join(format!("deltav-{}.cdx.json", place.version));
            let text = serde_json::to_string_pretty(&bill)? + "\n";
            fs::write(&file, text).with_context(|| format!("cannot write {}", file.display()))?;
        }
    }
    Ok(Vec::new())
}

fn page(place: &Place) -> Result<()> {
    crate::web(&place.root, &place.root.join("web/pkg"))?;
    let web = place.root.join("web");
    run(Command::new("npm").args(["ci", "--no-audit", "--no-fund"]).current_dir(&web))?;
    run(Command::new("npm").args(["run", "build"]).current_dir(&web))?;
    let built = web.join("dist/deltav.html");
    fs::copy(&built, place.out.join("deltav.html"))
        .with_context(|| format!("cannot copy {}", built.display()))?;
    Ok(())
}

fn maturin(place: &Place, task: &[&str]) -> Result<()> {
    run(Command::new("maturin")
        .args(task)
        .arg("--out")
        .arg(&place.out)
        .current_dir(place.root.join("python")))
}

/// Packs the crates as the registry would get them, without building each again.
fn packages(place: &Place) -> Result<()> {
    let mut pack = Command::new(cargo());
    pack.args(["package", "--locked", "--no-verify", "--allow-dirty", "--quiet"]).current_dir(&place.root);
    let names = order::of(&place.metadata)?;
    for name in &names {
        pack.args(["-p", name]);
    }
    run(&mut pack)?;
    for name in &names {
        let file = format!("{name}-{}.crate", place.version);
        let packed = place.target.join("package").join(&file);
        fs::copy(&packed, place.out.join(&file))
            .with_context(|| format!("cannot copy {}", packed.display()))?;
    }
    Ok(())
}
