//! Builds what cargo alone does not: `cargo run -p xtask -- web` builds the engine for a browser, `…
//! same-bits` compares it with the program, `… book` builds the book, and `… release` what a release hands out.

mod book;
mod release;
mod tools;
mod windows;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};
use clap::Parser;
use wasm_bindgen_cli_support::Bindgen;

use crate::tools::{cargo, target_folder};

/// What there is to do.
#[derive(Debug, Parser)]
enum Task {
    /// Build the engine for a browser: WebAssembly, the JavaScript that calls it, and its types
    Web {
        /// The folder to write into [default: web/pkg]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
    /// Run all fixtures through the engine for a browser, in Node, and through the program, and compare every
    /// byte
    SameBits {
        /// The program
        #[arg(long, value_name = "FILE", default_value = "target/debug/deltav")]
        program: PathBuf,

        /// The folder of the engine, as `web` wrote it [default: web/pkg]
        #[arg(long, value_name = "FOLDER")]
        engine: Option<PathBuf>,
    },
    /// Build the book from the pages in docs, and check its links; needs mdbook
    Book {
        /// The folder to write into [default: target/book/html]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
    /// Build the program for Windows, and compare it under Wine with that for Linux
    Windows,
    /// Build what a release hands out, or publish the crates
    Release(release::Options),
}

const TARGET: &str = "wasm32-unknown-unknown";
const PROFILE: &str = "wasm";

fn main() -> Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = |given: Option<PathBuf>| given.unwrap_or_else(|| root.join("web/pkg"));
    match Task::parse() {
        Task::Web { out } => web(&root, &folder(out)),
        Task::SameBits { program, engine } => same_bits(&root, &folder(engine), &program),
        Task::Book { out } => book::build(&root, out.as_deref()),
        Task::Windows => windows::compare(&root),
        Task::Release(options) => release::run_release(&root, &options),
    }
}

fn web(root: &Path, out: &Path) -> Result<()> {
    // Without the library for Rust: otherwise every crate below would be compiled once for it, and once more
    // for the whole.
    let status = Command::new(cargo())
        .args(["rustc", "--locked", "--profile", PROFILE, "--target", TARGET, "-p", "deltav-web", "--lib"])
        .args(["--crate-type", "cdylib"])
        .current_dir(root)
        .status()
        .context("cannot run cargo")?;
    ensure!(status.success(), "cargo cannot build deltav-web; `rustup target add {TARGET}` adds its target");
    let built = target_folder(root).join(TARGET).join(PROFILE).join("deltav_web.wasm");
    Bindgen::new()
        .input_path(&built)
        .web(true)?
        .typescript(true)
        .omit_default_module_path(true)
        .generate(out)
        .with_context(|| format!("cannot make JavaScript for {}", built.display()))
}

fn same_bits(root: &Path, engine: &Path, program: &Path) -> Result<()> {
    let mut cases = Vec::new();
    cases_in(&root.join("fixtures"), &mut cases)?;
    let status = Command::new("node")
        .arg(root.join("xtask/same-bits.mjs"))
        .args([engine, program])
        .args(cases)
        .status()
        .context("cannot run node")?;
    ensure!(status.success(), "the engine for a browser and the program do not say the same");
    Ok(())
}

/// All case files of a folder, in the order of their names: including those with errors, for which both have
/// to print the same.
fn cases_in(folder: &Path, cases: &mut Vec<PathBuf>) -> Result<()> {
    let cannot = || format!("cannot read {}", folder.display());
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).with_context(cannot)? {
        paths.push(entry.with_context(cannot)?.path());
    }
    paths.sort();
    for path in paths {
        if path.is_dir() {
            cases_in(&path, cases)?;
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            cases.push(path);
        }
    }
    Ok(())
}
