//! Reads and writes files, and creates folders.

use std::io::Write;
use std::path::Path;

use lexibus_codegen::output::{write_if_changed, writing};
use lexibus_codegen::source::Source;

use super::Failure;

/// Reads a file as a source.
pub(super) fn read(path: &Path) -> Result<Source, Failure> {
    Source::read(path).map_err(|error| Failure::Failed(format!("cannot read {}: {error}", path.display())))
}

/// Writes a text to a file, or to standard output if `path` is `None`.
pub(super) fn put(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path {
        Some(path) => write_if_changed(path, text).map_err(|error| Failure::Failed(cannot_write(path, &error))),
        None => Ok(std::io::stdout().lock().write_all(text.as_bytes())?),
    }
}

/// Returns the message for a file that cannot be written.
pub(super) fn cannot_write(path: &Path, error: &std::io::Error) -> String {
    format!("cannot write {}: {error}", path.display())
}

/// Creates a folder with its missing parents, if the folder does not exist.
pub(super) fn create_folder(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path)
        .map_err(|error| Failure::Failed(format!("cannot create the folder {}: {error}", path.display())))
}

/// Creates a file that the user will edit. Does not overwrite an existing file.
pub(super) fn create(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let _writing = writing();
    let file = std::fs::File::options().write(true).create_new(true).open(path);
    let written = file.and_then(|mut file| file.write_all(content));
    written.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => {
            Failure::Usage(format!("{} exists already and is not overwritten", path.display()))
        }
        _ => Failure::Failed(cannot_write(path, &error)),
    })
}
