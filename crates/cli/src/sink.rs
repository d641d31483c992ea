//! The destination of output. A file is written next to its place, and then takes the place in one step:
//! until then, and if the writing fails, the old file stays.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Stdout, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::NamedTempFile;

/// Takes bytes; [`finish`](Self::finish) puts them into their place.
pub(crate) enum Sink {
    StandardOutput(Stdout),
    /// A device or a pipe, which cannot be replaced, or a file that a link is to create.
    Device(File),
    /// A file next to its place.
    Beside {
        file: NamedTempFile,
        place: PathBuf,
    },
}

impl Sink {
    /// Opens the file, or standard output without one.
    pub(crate) fn open(path: Option<&Path>) -> io::Result<Self> {
        let Some(path) = path else { return Ok(Self::StandardOutput(io::stdout())) };
        // The file behind `/dev/stdout` is open already: what is in it stays.
        let is_open =
            ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"].iter().any(|open| path.starts_with(open));
        if is_open || fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
            return Ok(Self::Device(OpenOptions::new().append(true).open(path)?));
        }
        // The target of a link is replaced, not the link.
        let place = match fs::canonicalize(path) {
            Ok(place) => place,
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
            // A link whose file does not exist yet.
            Err(_) if path.is_symlink() => return Ok(Self::Device(File::create(path)?)),
            Err(_) => path.to_owned(),
        };
        let file = beside(&place)?;
        if place.exists() {
            // A file that is not to be written to is not replaced either, and the new one has its
            // permissions.
            let old = OpenOptions::new().write(true).open(&place)?;
            file.as_file().set_permissions(old.metadata()?.permissions())?;
        }
        Ok(Self::Beside { file, place })
    }

    /// Writes out the rest, and gives the file its name.
    pub(crate) fn finish(self) -> io::Result<()> {
        match self {
            Self::StandardOutput(mut stdout) => stdout.flush(),
            Self::Device(mut device) => device.flush(),
            Self::Beside { file, place } => {
                // Some file systems say only now that there is no room.
                file.as_file().sync_all()?;
                file.persist(place).map(|_| ()).map_err(|error| error.error)
            }
        }
    }

    fn target(&mut self) -> &mut dyn Write {
        match self {
            Self::StandardOutput(stdout) => stdout,
            Self::Device(device) => device,
            // The errors of the temporary file itself would name it.
            Self::Beside { file, .. } => file.as_file_mut(),
        }
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.target().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.target().flush()
    }
}

/// Writes a file that must not exist: another one of that name stays, even if it appears between a check and
/// the writing.
pub(crate) fn create_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if path.symlink_metadata().is_ok() {
        return Err(ErrorKind::AlreadyExists.into());
    }
    let mut file = beside(path)?;
    file.as_file_mut().write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist_noclobber(path).map(|_| ()).map_err(|error| error.error)
}

/// The unfinished file, under its temporary name.
static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Removes the file that is being written, before the program is left in the middle of it.
pub(crate) fn remove_unfinished() {
    let unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(path) = unfinished {
        // It may have its name by now.
        let _ = fs::remove_file(path);
    }
}

/// An empty file in the same folder, which goes away unless it is given a name.
fn beside(place: &Path) -> io::Result<NamedTempFile> {
    let folder = place.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".deltav-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // As any new file: whoever the umask lets read it may.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // The error of the library names its file, which nobody asked for.
    let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    *UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner) = Some(file.path().to_owned());
    Ok(file)
}
