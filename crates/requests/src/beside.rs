//! The files that a case names.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// The path of a file that a case names. A case may come from somebody else: the file has to be in the folder
/// of the case, and no link may lead out of it.
pub(crate) fn beside(case: &Path, name: &str) -> io::Result<PathBuf> {
    let outside = || io::Error::other("it lies outside the folder of the case");
    let is_below = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if !Path::new(name).components().all(is_below) {
        return Err(outside());
    }
    let folder = case.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let path = folder.join(name);
    let metadata = fs::symlink_metadata(&path)?;
    if metadata.is_symlink() {
        return Err(io::Error::other("it is a link"));
    }
    if !metadata.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    // A folder on the path may be a link as well.
    if !fs::canonicalize(&path)?.starts_with(fs::canonicalize(folder)?) {
        return Err(outside());
    }
    Ok(path)
}
