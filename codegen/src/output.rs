//! Writes files only if their content has changed, and replaces regular files atomically.

use std::fs::{self, File, OpenOptions};
use std::io::{BufRead, BufReader, Error, ErrorKind, Result, Write};
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
    let content = content.as_ref();
    if is_no_regular_file(path) {
        return OpenOptions::new().write(true).open(path)?.write_all(content);
    }
    if has_content(path, content).unwrap_or(false) {
        return Ok(());
    }
    let _writing = writing();
    match fs::canonicalize(path) {
        Ok(target) => replace(&target, content),
        // `path` is a symbolic link whose target does not exist yet.
        Err(_) if path.is_symlink() => fs::write(path, content),
        Err(error) if error.kind() == ErrorKind::NotFound => replace(path, content),
        Err(error) => Err(error),
    }
}

/// Returns whether a file has this content. Reads the file in parts, and only if it has the same length.
fn has_content(path: &Path, mut content: &[u8]) -> Result<bool> {
    let file = File::open(path)?;
    if file.metadata()?.len() != content.len() as u64 {
        return Ok(false);
    }
    let mut file = BufReader::new(file);
    loop {
        let part = file.fill_buf()?;
        let length = part.len();
        match content.strip_prefix(part) {
            Some(rest) if length > 0 => content = rest,
            rest => return Ok(rest.is_some_and(<[u8]>::is_empty)),
        }
        file.consume(length);
    }
}

/// Writes a temporary file next to `path`, and renames it to `path`.
fn replace(path: &Path, content: &[u8]) -> Result<()> {
    let (file, temporary) = temporary(path)?;
    let written = fill(file, path, content).and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // The temporary file is incomplete, or was not renamed.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn fill(mut file: File, path: &Path, content: &[u8]) -> Result<()> {
    file.write_all(content)?;
    match fs::metadata(path) {
        Ok(old) => file.set_permissions(old.permissions()),
        Err(_) => Ok(()),
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
        for text in ["one", "two", "two", ""] {
            write_if_changed(&path, text).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert!(write_if_changed(&folder, "x").is_err(), "a folder");
        assert!(write_if_changed(&folder.join("missing/a.rs"), "x").is_err());
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
        write_if_changed(&dangling, "new").unwrap();
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
