//! Reading and writing of files, and their names in messages.

use std::fs;
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result};
use case::{CaseFile, Text};
use requests::read_records_beside;

use crate::sink::Sink;

pub(crate) fn case_file(path: &Path) -> Result<CaseFile> {
    let (name, bytes) = read(path)?;
    let mut file =
        CaseFile::parse_bytes(&name, &bytes).map_err(|errors| errors.in_words_of(&report::PROGRAM))?;
    read_records_beside(path, &mut file, &report::PROGRAM)?;
    Ok(file)
}

/// A path as shown in messages.
pub(crate) fn named(path: &Path) -> Text {
    path.display().to_string().into()
}

/// Reads at most one byte more than allowed, which is enough to refuse the source; a device or a pipe may
/// have no end.
pub(crate) fn read_at_most(most: usize, source: impl io::Read) -> io::Result<Vec<u8>> {
    // Most cases fit in this.
    let mut bytes = Vec::with_capacity(1 << 13);
    source.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A file with a part of a case, as text.
pub(crate) fn read_text(path: &Path) -> Result<(String, String)> {
    let (name, bytes) = read(path)?;
    let text = String::from_utf8(bytes).with_context(|| format!("{} is not UTF-8 text", named(path)))?;
    Ok((name, text))
}

/// The name to show in messages, and the content of the file.
pub(crate) fn read(path: &Path) -> Result<(String, Vec<u8>)> {
    if path == Path::new("-") {
        let bytes = read_at_most(CaseFile::LARGEST_FILE, io::stdin())
            .context("cannot read the case from standard input")?;
        return Ok(("standard input".to_owned(), bytes));
    }
    let name = path.display().to_string();
    if path.is_dir() {
        anyhow::bail!("{name} is a folder: name the case file in it", name = named(path));
    }
    let bytes = fs::File::open(path)
        .and_then(|file| read_at_most(CaseFile::LARGEST_FILE, file))
        .with_context(|| format!("cannot read the case file {}", named(path)))?;
    Ok((name, bytes))
}

pub(crate) fn write(path: Option<&Path>, output: impl AsRef<[u8]>) -> Result<()> {
    let written = Sink::open(path).and_then(|mut sink| {
        sink.write_all(output.as_ref())?;
        sink.finish()
    });
    match (written, path) {
        (written, Some(path)) => {
            written.with_context(|| format!("cannot write the output to {}", named(path)))
        }
        // The reader has read enough, as `head` does.
        (Err(error), None) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        (written, None) => written.context("cannot write to standard output"),
    }
}

/// A line on standard error, beside the output.
pub(crate) fn say(line: &str) -> Result<()> {
    writeln!(io::stderr(), "{line}").context("cannot write to standard error")
}

#[cfg(test)]
mod tests {
    use std::io;

    use case::CaseFile;

    use super::read_at_most;

    #[test]
    fn a_source_without_end_is_left_after_one_byte_too_many() {
        assert_eq!(
            read_at_most(CaseFile::LARGEST_FILE, io::repeat(b'x')).unwrap().len(),
            CaseFile::LARGEST_FILE + 1
        );
    }
}
