//! NHTSA's tables of CISS, in folders and ZIP files.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{BufReader, Read as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use field::FieldError;
use field::ciss::{CissCell, CissCrashes, CissFiles, OBJECTS, has_tables, objects, pairs};
use report::FieldYear;
use zip::ZipArchive;

use crate::files::{named, read_at_most};
use crate::progress::Progress;

/// (bytes) a table of all crashes that NHTSA has sampled is smaller.
pub(crate) const LARGEST_TABLE: usize = 1 << 28;

/// (bytes) all tables of a run together, unpacked.
const LARGEST_ALL: usize = 1 << 30;

/// (–) maximum number of tables read of a year.
const TABLES: usize = 5;

/// Crashes of NHTSA's tables.
pub(crate) struct Downloaded {
    /// As one table.
    pub(crate) table: String,
    pub(crate) years: Vec<FieldYear>,
}

/// The crashes of these downloads; `None` if there is one path, and it is a table.
pub(crate) fn downloaded(paths: &[PathBuf], is_of_objects: bool) -> Result<Option<Downloaded>> {
    let mut sources = Vec::new();
    for path in paths {
        if path.is_dir() {
            sources.extend(sources_in(path)?);
        } else if is_zip(path)? {
            sources.push(Source::zip(path)?);
        } else if is_table_of_year(path) {
            bail!(
                "{} is one table of NHTSA's download: give the folder or the ZIP file with all its tables",
                named(path)
            );
        } else if paths.len() == 1 {
            return Ok(None);
        } else {
            bail!(
                "{} is neither a folder nor a ZIP file: give NHTSA's downloads, or one table of crashes alone",
                named(path)
            );
        }
    }
    let mut reading = Reading {
        progress: Progress::new()?,
        done: 0,
        total: TABLES * sources.len(),
        left: LARGEST_ALL,
        sha256: Vec::new(),
    };
    let years = sources.iter_mut().enumerate().map(|(place, source)| {
        reading.done = TABLES * place;
        source.year(&mut reading, is_of_objects)
    });
    let years = years.collect::<Result<Vec<_>>>()?;
    check_distinct(&years)?;
    check_any(&years, is_of_objects)?;
    let table = CissCrashes::csv_of(is_of_objects, years.iter().map(|year| &year.crashes));
    Ok(Some(Downloaded { table, years }))
}

/// The files that may be read of a path.
pub(crate) fn files_of(path: &Path) -> Vec<PathBuf> {
    let in_it = |path: &Path| entries(path).unwrap_or_default();
    let mut files = vec![path.to_owned()];
    for entry in in_it(path) {
        files.extend(in_it(&entry));
        files.push(entry);
    }
    files
}

/// The entries of a folder, in the order of their names; none if it is a file.
fn entries(path: &Path) -> Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(Vec::new());
    }
    let read = || fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>();
    let mut entries = read().with_context(|| format!("cannot read the folder {}", named(path)))?;
    entries.sort();
    Ok(entries)
}

fn is_table_of_year(path: &Path) -> bool {
    has_tables(
        &path.file_name().map(|name| name.to_string_lossy().into_owned()).into_iter().collect::<Vec<_>>(),
    )
}

/// The first bytes of a ZIP file, and of one without any file.
const ZIP: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];

/// Whether it is a ZIP file by its first bytes.
fn is_zip(path: &Path) -> Result<bool> {
    // Bytes read from a pipe are gone.
    if path.exists() && !path.is_file() {
        return Ok(false);
    }
    let mut first = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4).read_to_end(&mut first));
    read.with_context(|| format!("cannot read {}", named(path)))?;
    let is_zip = ZIP.contains(&first.as_slice());
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip")) && !is_zip {
        bail!(
            "{} is named as a ZIP file, but is not one: the download may have failed; download it again",
            named(path)
        );
    }
    Ok(is_zip)
}

/// The folder itself if it has tables, or else the folders and ZIP files in it that have some.
fn sources_in(folder: &Path) -> Result<Vec<Source>> {
    let itself = Source::folder(folder)?;
    if has_tables(&itself.names) {
        return Ok(vec![itself]);
    }
    let mut found = Vec::new();
    for entry in entries(folder)? {
        if entry.is_dir() {
            found.push(Source::folder(&entry)?);
        } else if entry.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"))
            && is_zip(&entry)?
        {
            found.push(Source::zip(&entry)?);
        }
    }
    found.retain(|source| has_tables(&source.names));
    // The error on the folder itself names what it has instead.
    Ok(if found.is_empty() { vec![itself] } else { found })
}

/// The place of the tables of a year.
struct Source {
    path: PathBuf,
    /// The names of its files.
    names: Vec<String>,
    archive: Option<ZipArchive<BufReader<File>>>,
}

impl Source {
    fn folder(path: &Path) -> Result<Self> {
        let name = |entry: PathBuf| {
            let name = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if entry.is_dir() { name + "/" } else { name }
        };
        let names = entries(path)?.into_iter().map(name).collect();
        Ok(Self { path: path.to_owned(), names, archive: None })
    }

    fn zip(path: &Path) -> Result<Self> {
        let unreadable = || {
            format!("cannot read {} as a ZIP file: if the download is not complete, repeat it", named(path))
        };
        let file = File::open(path).with_context(unreadable)?;
        let archive = ZipArchive::new(BufReader::new(file)).with_context(unreadable)?;
        let names = (0..archive.len()).filter_map(|place| archive.name_for_index(place));
        let names = names.map(|name| name.map(String::from)).collect::<Result<_, _>>();
        let names = names.with_context(unreadable)?;
        Ok(Self { path: path.to_owned(), names, archive: Some(archive) })
    }

    fn year(&mut self, reading: &mut Reading, is_of_objects: bool) -> Result<FieldYear> {
        let source = named(&self.path).to_string();
        let make = if is_of_objects { objects } else { pairs };
        let crashes = make(&mut Year { source: self, reading }).with_context(|| source.clone())?;
        Ok(FieldYear { source, crashes, sha256: std::mem::take(&mut reading.sha256) })
    }

    /// At most one byte more than may be read.
    fn content(&mut self, place: usize, most: usize) -> Result<Vec<u8>> {
        let name = self.names.get(place).cloned().unwrap_or_default();
        let read = match &mut self.archive {
            None => File::open(self.path.join(&name)).and_then(|file| read_at_most(most, file)),
            Some(archive) => {
                let packed = archive.by_index(place);
                let packed = packed.with_context(|| format!("cannot unpack {}", case::shown(&name)))?;
                read_at_most(most, packed)
            }
        };
        read.with_context(|| format!("cannot read {}", case::shown(&name)))
    }
}

/// The state shared by the years of a run.
struct Reading {
    progress: Progress,
    done: usize,
    total: usize,
    /// (bytes) that may still be read.
    left: usize,
    /// The SHA-256 of each table of the year.
    sha256: Vec<String>,
}

struct Year<'a> {
    source: &'a mut Source,
    reading: &'a mut Reading,
}

impl CissFiles for Year<'_> {
    type Error = anyhow::Error;

    fn names(&self) -> Vec<String> {
        self.source.names.clone()
    }

    fn read(&mut self, place: usize) -> Result<Vec<u8>> {
        let Reading { progress, done, total, left, sha256 } = self.reading;
        if progress.at("tables", *done, *total).is_break() {
            return Err(FieldError::Ended.into());
        }
        *done += 1;
        let most = LARGEST_TABLE.min(*left);
        let content = self.source.content(place, most)?;
        if content.len() > most {
            let name = self.source.names.get(place).map(String::as_str).unwrap_or_default();
            bail!(
                "{}: too large, as at most {} MB of a table and {} MB of all tables are read; give fewer \
                 years at once, or \
                 another download",
                case::shown(name),
                LARGEST_TABLE >> 20,
                LARGEST_ALL >> 20
            );
        }
        *left -= content.len();
        sha256.push(report::sha256(&content));
        Ok(content)
    }
}

/// Refuses a crash that appears twice, because it would count twice.
fn check_distinct(years: &[FieldYear]) -> Result<()> {
    let mut places: BTreeMap<[String; 2], usize> = BTreeMap::new();
    for (place, FieldYear { source, crashes, .. }) in years.iter().enumerate() {
        for row in &crashes.rows {
            let [year, crash] =
                [0, 1].map(|column| row.get(column).map(CissCell::to_string).unwrap_or_default());
            let before = *places.entry([year.clone(), crash.clone()]).or_insert(place);
            if before != place {
                let before = years.get(before).map(|year| year.source.as_str()).unwrap_or_default();
                bail!("crash {crash} of {year} is in {before} and in {source}: give each year once");
            }
        }
    }
    Ok(())
}

fn check_any(years: &[FieldYear], is_of_objects: bool) -> Result<()> {
    if years.iter().any(|year| !year.crashes.rows.is_empty()) {
        return Ok(());
    }
    let sources: Vec<_> = years.iter().map(|year| year.source.as_str()).collect();
    let left_out = CissCrashes::left_out_of(years.iter().map(|year| &year.crashes));
    let reasons: Vec<_> =
        left_out.iter().map(|(reason, count)| format!("{count} {}", reason.why(is_of_objects))).collect();
    let what = if is_of_objects {
        format!("vehicle that struck a fixed object (OBJCONT {} to {})", OBJECTS.start(), OBJECTS.end())
    } else {
        "pair of vehicles that name each other as what they struck (OBJCONT)".to_owned()
    };
    let why = if reasons.is_empty() {
        String::new()
    } else {
        format!(" and can be judged; left out: {}", reasons.join(", "))
    };
    bail!("{}: the tables have no {what}{why}", sources.join(", "))
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use field::ciss::CissFiles as _;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    use super::{LARGEST_TABLE, Progress, Reading, Source, TABLES, Year};

    /// A megabyte of blanks, packed into a kilobyte.
    fn packed() -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut writer = ZipWriter::new(file.reopen().unwrap());
        writer.start_file("CRASH.csv", SimpleFileOptions::default()).unwrap();
        writer.write_all(&vec![b' '; 1 << 20]).unwrap();
        writer.finish().unwrap();
        file
    }

    #[test]
    fn no_more_is_unpacked_than_may_be_read() {
        let file = packed();
        assert!(file.as_file().metadata().unwrap().len() < 1 << 12);
        let mut source = Source::zip(file.path()).unwrap();
        let mut reading = Reading {
            progress: Progress::new().unwrap(),
            done: 0,
            total: TABLES,
            left: 3 << 19,
            sha256: Vec::new(),
        };
        let mut year = Year { source: &mut source, reading: &mut reading };
        assert_eq!(year.read(0).unwrap().len(), 1 << 20);
        let refused = year.read(0).unwrap_err().to_string();
        assert_eq!((year.reading.left, year.reading.sha256.len()), (1 << 19, 1));
        assert!(
            refused
                .starts_with("CRASH.csv: too large, as at most 256 MB of a table and 1024 MB of all tables"),
            "{refused}"
        );
        // The remaining number of bytes limits what a source hands over, whatever size it claims.
        assert_eq!(source.content(0, 10).unwrap().len(), 11);
        assert_eq!(LARGEST_TABLE, 256 << 20);
    }
}
