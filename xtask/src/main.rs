//! Builds what cargo alone does not: `cargo run -p xtask -- web` builds the engine for a browser.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};
use clap::Parser;
use wasm_bindgen_cli_support::Bindgen;

/// What there is to build.
#[derive(Debug, Parser)]
enum Task {
    /// Build the engine for a browser: WebAssembly, the JavaScript that calls it, and its types
    Web {
        /// Build it in a fifth of the time; it is larger and slower, and has the same bits
        #[arg(long)]
        quick: bool,

        /// The folder to write into
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
}

fn main() -> Result<()> {
    let Task::Web { quick, out } = Task::parse();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let profile = if quick { "wasm-quick" } else { "wasm" };
    let target = "wasm32-unknown-unknown";
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--locked", "--profile", profile, "--target", target, "-p", "deltav-web", "--lib"])
        .current_dir(&root)
        .status()
        .context("cannot run cargo")?;
    ensure!(status.success(), "cargo cannot build deltav-web; `rustup target add {target}` adds its target");
    let built = target_folder(&root).join(target).join(profile).join("deltav_web.wasm");
    Bindgen::new()
        .input_path(&built)
        .web(true)?
        .typescript(true)
        .omit_default_module_path(true)
        .generate(out.unwrap_or_else(|| root.join("web/pkg")))
        .with_context(|| format!("cannot make JavaScript for {}", built.display()))
}

/// Where cargo builds.
fn target_folder(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}
