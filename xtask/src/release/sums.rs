//! The checksums of the released files.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};
use sha2::{Digest as _, Sha256};

/// The file with the sums.
pub(super) const NAME: &str = "SHA256SUMS";

/// Writes the sum of each file of a folder, as `sha256sum --check` reads it.
pub(super) fn write(folder: &Path) -> Result<()> {
    let cannot = || format!("cannot read {}", folder.display());
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).with_context(cannot)? {
        let entry = entry.with_context(cannot)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type().with_context(cannot)?.is_file() && name != NAME {
            names.push(name);
        }
    }
    names.sort();
    let mut text = String::new();
    for name in names {
        let content = fs::read(folder.join(&name)).with_context(|| format!("cannot read {name}"))?;
        writeln!(text, "{}  {name}", hex(&Sha256::digest(&content)))?;
    }
    fs::write(folder.join(NAME), text).with_context(|| format!("cannot write {NAME}"))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4, example of the message "abc".
    #[test]
    fn the_sum_of_abc_is_that_of_the_standard() {
        let sum = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hex(&Sha256::digest(b"abc")), sum);
    }
}
