//! The program as an archive: as users get it.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result};

use super::Place;
use crate::tools::{cargo, is_installed, output, run, say};

/// The files that go into the archive as they are in the repository.
const TEXTS: [&str; 4] = ["LICENSE-APACHE", "LICENSE-MIT", "README.md", "CHANGELOG.md"];

/// The shells, and the files in which each looks for the completions.
const SHELLS: [(&str, &str); 4] =
    [("bash", "deltav.bash"), ("zsh", "_deltav"), ("fish", "deltav.fish"), ("powershell", "deltav.ps1")];

/// A target without dependencies on the machine on which the program is to run, if it can be built here.
pub(super) fn best_target() -> Result<String> {
    let told = String::from_utf8(output(Command::new("rustc").arg("-vV"))?)?;
    let host = told.lines().find_map(|line| line.strip_prefix("host: ")).context("rustc names no host")?;
    let musl = host.replace("-gnu", "-musl");
    let installed = || output(Command::new("rustup").args(["target", "list", "--installed"]));
    let has_target = || installed().is_ok_and(|list| String::from_utf8_lossy(&list).contains(&musl));
    let is_static = host.contains("linux") && is_installed("musl-gcc") && has_target();
    Ok(if is_static { musl } else { host.to_owned() })
}

/// Builds the program, and packs it; returns what could not be added.
pub(super) fn program(place: &Place) -> Result<Vec<String>> {
    let triple = &place.triple;
    run(Command::new(cargo())
        .args(["build", "--locked", "--release", "-p", "deltav-cli", "--target", triple])
        // Names of functions are only for debugging, and take half of the file.
        .env("CARGO_PROFILE_RELEASE_STRIP", "symbols")
        .envs(for_another_processor(triple))
        .current_dir(&place.root))?;
    let is_windows = triple.contains("windows");
    let file = if is_windows { "deltav.exe" } else { "deltav" };
    let built = place.target.join(triple).join("release").join(file);
    let name = format!("deltav-{}-{triple}", place.version);
    let folder = place.target.join("archive").join(&name);
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("cannot empty {}", folder.display()))?;
    }
    fs::create_dir_all(folder.join("completions"))
        .with_context(|| format!("cannot make {}", folder.display()))?;
    let copy = |from: &Path, name: &str| {
        fs::copy(from, folder.join(name)).with_context(|| format!("cannot copy {}", from.display()))
    };
    copy(&built, file)?;
    for text in TEXTS {
        copy(&place.root.join(text), text)?;
    }
    let mut left_out = Vec::new();
    if let Err(error) = completions(&built, &folder) {
        fs::remove_dir_all(folder.join("completions")).context("cannot remove an empty folder")?;
        left_out.push(format!(
            "completions and manual page of {triple}: the program writes them, and cannot run here ({error:#})"
        ));
    }
    if triple.contains("linux") && !triple.contains("musl") {
        left_out.push(format!(
            "a static program: {triple} needs the C library of this machine or a newer one; \
            musl-tools and `rustup target add x86_64-unknown-linux-musl` bring what a static one needs"
        ));
    }
    if is_windows {
        zip(place, &folder, &name)?;
    } else {
        tar(place, &folder, &name)?;
    }
    Ok(left_out)
}

/// The tools that build a static program for another processor than that of this machine: the linker of Rust,
/// as nothing of the system is linked, and the C compiler of Debian's gcc-aarch64-linux-gnu for the parts in
/// C.
fn for_another_processor(triple: &str) -> Vec<(String, &'static str)> {
    let Some(processor) = triple.strip_suffix("-unknown-linux-musl") else { return Vec::new() };
    if processor == env::consts::ARCH || processor != "aarch64" {
        return Vec::new();
    }
    let name = triple.replace('-', "_");
    vec![
        (format!("CARGO_TARGET_{}_LINKER", name.to_uppercase()), "rust-lld"),
        (format!("CC_{name}"), "aarch64-linux-gnu-gcc"),
        (format!("AR_{name}"), "aarch64-linux-gnu-ar"),
        // Its headers are those of another C library, whose checked functions musl does not have.
        (format!("CFLAGS_{name}"), "-U_FORTIFY_SOURCE"),
    ]
}

/// The files that the program itself writes.
fn completions(program: &Path, folder: &Path) -> Result<()> {
    for (shell, name) in SHELLS {
        let text = output(Command::new(program).args(["completions", shell]))?;
        fs::write(folder.join("completions").join(name), text).context("cannot write completions")?;
    }
    let manual = output(Command::new(program).arg("man"))?;
    fs::write(folder.join("deltav.1"), manual).context("cannot write the manual page")
}

/// Packs a folder under a name, with the time of the commit and without names of users. The same commit then
/// gives the same archive where tar is that of GNU.
pub(super) fn tar(place: &Place, folder: &Path, name: &str) -> Result<()> {
    let archive = place.out.join(format!("{name}.tar.gz"));
    let mut pack = Command::new("tar");
    if output(Command::new("tar").arg("--version"))?.starts_with(b"tar (GNU") {
        let time = output(Command::new("git").args(["log", "-1", "--format=%ct"]).current_dir(&place.root));
        let time = time.ok().and_then(|text| String::from_utf8(text).ok()).unwrap_or_default();
        let time = if time.trim().is_empty() { "0" } else { time.trim() };
        pack.args(["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--format=gnu"])
            // gzip would write the time.
            .arg("--use-compress-program=gzip -n")
            .arg(format!("--mtime=@{time}"))
            .arg(format!("--transform=s,^\\.,{name},"));
        pack.arg("-C").arg(folder).arg("-cf").arg(&archive).arg(".");
    } else {
        let (above, last) = parted(folder)?;
        pack.arg("-C").arg(above).arg("-czf").arg(&archive).arg(last);
    }
    run(&mut pack)?;
    say(&format!("{}", archive.display()))
}

/// Packs a folder for Windows, which opens a zip without further programs. Python writes it.
fn zip(place: &Place, folder: &Path, name: &str) -> Result<()> {
    let archive = place.out.join(format!("{name}.zip"));
    let (above, last) = parted(folder)?;
    let python = if env::consts::OS == "windows" { "python" } else { "python3" };
    let archive = env::current_dir().context("cannot tell the folder")?.join(archive);
    run(Command::new(python).args(["-m", "zipfile", "-c"]).arg(&archive).arg(last).current_dir(above))?;
    say(&format!("{}", archive.display()))
}

fn parted(folder: &Path) -> Result<(PathBuf, PathBuf)> {
    let above = folder.parent().context("a folder has no parent")?.to_owned();
    let last = folder.file_name().context("a folder has no name")?.into();
    Ok((above, last))
}
