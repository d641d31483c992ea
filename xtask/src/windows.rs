//! The program for Windows, compared with the one for Linux.

use std::path::Path;
use std::process::Command;

use anyhow::Result;

use crate::tools::{cargo, run, target_folder};

const TARGET: &str = "x86_64-pc-windows-gnu";

/// Builds both programs, and has `tests/windows.sh` compare their output.
pub(crate) fn compare(root: &Path) -> Result<()> {
    let build = ["build", "--locked", "--release", "-p", "deltav-cli"];
    run(Command::new(cargo()).args(build).current_dir(root))?;
    run(Command::new(cargo()).args(build).args(["--target", TARGET]).current_dir(root))?;
    let target = std::path::absolute(target_folder(root))?;
    run(Command::new(root.join("tests/windows.sh"))
        .arg(target.join("release/deltav"))
        .arg(target.join(TARGET).join("release/deltav.exe"))
        .current_dir(root))
}
