//! The field data, which are not part of the repository.

use std::fs;
use std::path::{Path, PathBuf};

/// The text of a file of the field data, in the folder beside the repository or that of `FIELD_DATA`. `None`
/// if it is not there, which it prints.
#[expect(clippy::print_stdout, reason = "says what is skipped")]
pub fn data(file: &str) -> Option<String> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("FIELD_DATA").map_or(beside, PathBuf::from);
    let text = fs::read_to_string(folder.join(file)).ok();
    if text.is_none() {
        println!("{file} is not here: set FIELD_DATA to the folder that has it. Skipped.");
    }
    text
}
