//! Writes files only if their content has changed, and replaces regular files atomically.

use std::fs::{self, File, OpenOptions};
use std::io::{BufRead, BufReader, Error, ErrorKind, Read, Result, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Each write to a regular file holds a read lock. A program that ends on a signal takes the write lock first.
static WRITING: RwLock<()> = RwLock::new(());

/// Announces a write to a file. [`settled`] waits until the guard is dropped.
pub fn writing() -> RwLockReadGuard<'static, ()> {
    WRITING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Waits until all writes to files have ended, and blocks further writes until the guard is dropped. A program that ends on a
/// signal calls this function first, so that it leaves no incomplete and no temporary files.
pub fn settled() -> RwLockWriteGuard<'static, ()> {
    WRITING.write().unwrap_or_else(PoisonError::into_inner)
}

/// Returns whether a path exists and is a pipe, terminal or device, instead of a file or folder.
pub fn is_no_regular_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

/// Writes `content` to `path`, unless the file already has this content. Skipping the write avoids rebuilds of everything that
/// depends on the file.
///
/// Replaces a regular file atomically: if writing fails, the old file remains. If `path` is a symbolic link, replaces or creates
/// the target of the link. If `path` is a pipe or device, writes to it directly.
///
/// # Errors
///
/// Returns the error of the operating system, or an error if `path` has no file name.
pub fn write_if_changed(path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
    let mut writer = Writer::new(path);
    writer.push(content.as_ref());
    writer.finish()
}

/// Writes a file like [`write_if_changed`], but in parts.
///
/// As long as the parts are equal to the content of the file, nothing is written. From the first difference on, the content is in a
/// temporary file next to the file. The temporary file replaces the file when [`finish`](Self::finish) is called, and is removed if
/// the writer is dropped before. Until then, [`settled`] waits, and the thread of the writer must not begin another write: the two
/// would wait for each other.
#[derive(Debug)]
pub struct Writer<'p> {
    path: &'p Path,
    state: Result<State>,
}

#[derive(Debug)]
enum State {
    /// The first `count` bytes are equal to those at the beginning of the old file. `old` contains the following bytes.
    Equal { old: Option<BufReader<File>>, count: u64 },
    /// The content is written to `file`: a temporary file or, without a replacement, a pipe or device.
    Writing { file: File, replacement: Option<Replacement> },
}

/// A temporary file, and the file that it will replace. A temporary file that has not replaced a file is removed.
#[derive(Debug)]
struct Replacement {
    temporary: PathBuf,
    target: PathBuf,
    is_complete: bool,
    _writing: RwLockReadGuard<'static, ()>,
}

impl<'p> Writer<'p> {
    /// Creates a writer for the file `path`.
    pub fn new(path: &'p Path) -> Self {
        let state = if is_no_regular_file(path) {
            let file = OpenOptions::new().write(true).open(path);
            file.map(|file| State::Writing { file, replacement: None })
        } else {
            Ok(State::Equal { old: File::open(path).ok().map(BufReader::new), count: 0 })
        };
        Writer { path, state }
    }

    /// Adds bytes to the content. An error is returned by [`finish`](Self::finish).
    pub fn push(&mut self, part: &[u8]) {
        if let Ok(state) = &mut self.state {
            if let Err(error) = state.push(self.path, part) {
                self.state = Err(error);
            }
        }
    }

    /// Ends the content, and replaces the old file if it has another content.
    ///
    /// # Errors
    ///
    /// Returns the first error of the operating system, or an error if the path has no file name.
    pub fn finish(self) -> Result<()> {
        let mut state = self.state?;
        if let State::Equal { old, .. } = &mut state {
            let rest = old.as_mut().map(BufRead::fill_buf);
            if rest.is_some_and(|rest| rest.is_ok_and(<[u8]>::is_empty)) {
                return Ok(());
            }
            state.start(self.path)?;
        }
        match state {
            State::Writing { file, replacement: Some(replacement) } => {
                drop(file);
                replacement.rename()
            }
            State::Writing { .. } | State::Equal { .. } => Ok(()),
        }
    }
}

impl State {
    fn push(&mut self, path: &Path, mut part: &[u8]) -> Result<()> {
        if let State::Equal { old: Some(old), count } = self {
            let equal = skip_equal(old, part);
            *count += equal as u64;
            part = &part[equal..];
        }
        if !part.is_empty() {
            self.start(path)?;
        }
        match self {
            State::Writing { file, .. } => file.write_all(part),
            State::Equal { .. } => Ok(()),
        }
    }

    /// Creates the file to which the content is written, unless this has been done. Copies the bytes that are equal.
    fn start(&mut self, path: &Path) -> Result<()> {
        let State::Equal { old, count } = self else { return Ok(()) };
        let (mut file, replacement) = Replacement::create(path)?;
        if let Some(mut old) = old.take().map(BufReader::into_inner).filter(|_| *count > 0) {
            old.rewind()?;
            if std::io::copy(&mut old.take(*count), &mut file)? < *count {
                return Err(Error::other("the file was changed while it was compared with its new content"));
            }
        }
        *self = State::Writing { file, replacement: Some(replacement) };
        Ok(())
    }
}

/// Reads the bytes of a file that are equal to those at the beginning of `part`, and returns their number.
fn skip_equal(old: &mut BufReader<File>, part: &[u8]) -> usize {
    let mut count = 0;
    while let Ok(bytes) = old.fill_buf() {
        let equal = bytes.iter().zip(&part[count..]).take_while(|(old, new)| old == new).count();
        let is_end = equal == 0 || equal < bytes.len();
        old.consume(equal);
        count += equal;
        if is_end {
            break;
        }
    }
    count
}

impl Replacement {
    /// Creates a temporary file next to the file `path`, with the same permissions.
    fn create(path: &Path) -> Result<(File, Self)> {
        let _writing = writing();
        let target = target(path)?;
        let (file, temporary) = temporary(&target)?;
        let replacement = Replacement { temporary, target, is_complete: false, _writing };
        if let Ok(old) = fs::metadata(&replacement.target) {
            file.set_permissions(old.permissions())?;
        }
        Ok((file, replacement))
    }

    fn rename(mut self) -> Result<()> {
        fs::rename(&self.temporary, &self.target)?;
        self.is_complete = true;
        Ok(())
    }
}

/// Returns the path of a file without symbolic links. The file need not exist.
fn target(path: &Path) -> Result<PathBuf> {
    match fs::canonicalize(path) {
        // A chain of links whose last target does not exist is finite.
        Err(error) if error.kind() == ErrorKind::NotFound => match fs::read_link(path) {
            Ok(link) => target(&path.with_file_name(link)),
            Err(_) => Ok(path.to_owned()),
        },
        canonical => canonical,
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        if !self.is_complete {
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

/// Returns the hidden path of a temporary file or folder next to `path`. Each call returns a different path.
///
/// # Errors
///
/// Returns an error if `path` has no file name.
pub fn temporary_path(path: &Path) -> Result<PathBuf> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let Some(name) = path.file_name() else {
        return Err(Error::new(ErrorKind::InvalidInput, "the path has no file name"));
    };
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}-{}.tmp", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
    Ok(path.with_file_name(hidden))
}

/// Creates a temporary file in the folder of `path`.
fn temporary(path: &Path) -> Result<(File, PathBuf)> {
    loop {
        let temporary = temporary_path(path)?;
        match OpenOptions::new().write(true).create_new(true).open(&temporary) {
            Ok(file) => return Ok((file, temporary)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lexibus-output-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn files_are_replaced_without_temporary_files() {
        let folder = folder("replaced");
        let path = folder.join("a.rs");
        for text in ["one", "two", "two", "two and a half", "two and one", "two", ""] {
            write_if_changed(&path, text).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert!(write_if_changed(&folder, "x").is_err(), "a folder");
        assert!(write_if_changed(&folder.join("missing/a.rs"), "x").is_err());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    /// Writes parts and returns whether the file was written.
    fn is_written(path: &Path, parts: &[&str]) -> bool {
        let long_ago = std::time::SystemTime::UNIX_EPOCH;
        File::options().write(true).open(path).unwrap().set_modified(long_ago).unwrap();
        let mut writer = Writer::new(path);
        parts.iter().for_each(|part| writer.push(part.as_bytes()));
        writer.finish().unwrap();
        assert_eq!(fs::read_to_string(path).unwrap(), parts.concat());
        fs::metadata(path).unwrap().modified().unwrap() != long_ago
    }

    #[test]
    fn parts_are_written_from_the_first_difference() {
        let folder = folder("parts");
        let path = folder.join("a.rs");
        let long = "0123456789".repeat(3000);
        fs::write(&path, format!("{long}{long}")).unwrap();
        assert!(!is_written(&path, &[&long, "", &long]));
        assert!(!is_written(&path, &[&long[..9], &long[9..], &long]));
        assert!(is_written(&path, &[&long, &long, "x"]));
        assert!(is_written(&path, &[&long, "x", &long]));
        assert!(is_written(&path, &["y", &long]));
        assert!(is_written(&path, &["y"]));
        assert!(is_written(&path, &["y", &long]));

        let mut dropped = Writer::new(&path);
        dropped.push(b"z");
        drop(dropped);
        assert_eq!(fs::read_to_string(&path).unwrap(), format!("y{long}"));
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_stay() {
        use std::os::unix::fs::{symlink, PermissionsExt};
        let folder = folder("links");
        let (path, link, dangling) = (folder.join("a"), folder.join("link"), folder.join("dangling"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a", &link).unwrap();
        symlink("b", &dangling).unwrap();
        write_if_changed(&link, "new").unwrap();
        let mut dropped = Writer::new(&dangling);
        dropped.push(b"n");
        drop(dropped);
        assert!(!folder.join("b").exists());
        symlink("dangling", folder.join("chain")).unwrap();
        write_if_changed(&folder.join("chain"), "new").unwrap();
        assert!(link.is_symlink() && dangling.is_symlink());
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(fs::read_to_string(folder.join("b")).unwrap(), "new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_are_written_to() {
        assert!(is_no_regular_file(Path::new("/dev/null")));
        write_if_changed(Path::new("/dev/null"), "x").unwrap();
        let error = write_if_changed(Path::new("/dev/full"), "x").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::StorageFull);
    }
}
