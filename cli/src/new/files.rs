//! Creates the files of a new crate in a new folder.

use std::path::Path;

use lexibus_codegen::output::{temporary_path, writing};

use crate::Failure;

/// Names of files and folders in a crate that have a meaning for Cargo or rustup, in lower case. The path of a copied
/// description file must not begin with one of these names.
const OWN_NAMES: [&str; 11] = [
    ".cargo",
    "benches",
    "build.rs",
    "cargo.lock",
    "cargo.toml",
    "examples",
    "rust-toolchain",
    "rust-toolchain.toml",
    "src",
    "target",
    "tests",
];

/// The files of a crate, with their paths in the folder of the crate.
#[derive(Default)]
pub(super) struct Files {
    texts: Vec<(&'static str, String)>,
    /// Copies of description files: path and content.
    copies: Vec<(String, Vec<u8>)>,
}

impl Files {
    pub(super) fn text(&mut self, path: &'static str, text: String) {
        // Templates have no final line break.
        self.texts.push((path, text.trim_end().to_owned() + "\n"));
    }

    /// Adds a copy of a description file. `path` is relative to the folder of the crate, with `/` as separator.
    ///
    /// # Errors
    ///
    /// Returns an error if the first part of the path is one of [`OWN_NAMES`], or if a copy of another file has the
    /// same path. The comparison of paths ignores case, because some file systems do.
    pub(super) fn copy(&mut self, path: String, bytes: Vec<u8>) -> Result<(), Failure> {
        let lower = path.to_lowercase();
        let first = lower.split('/').next().unwrap_or_default();
        if OWN_NAMES.contains(&first) {
            let first = path.split('/').next().unwrap_or_default();
            return Err(Failure::Usage(format!(
                "cannot copy {path} to the crate, which has its own `{first}`: rename the description"
            )));
        }
        match self.copies.iter().find(|(other, _)| other.to_lowercase() == lower) {
            None => self.copies.push((path, bytes)),
            // The description refers to the file twice, with different spellings.
            Some((other, same)) if *other == path && *same == bytes => {}
            Some((other, _)) => {
                return Err(Failure::Usage(format!(
                    "cannot copy both {other} and {path} to the crate: rename one of the files"
                )))
            }
        }
        Ok(())
    }

    /// Returns an error if `folder` exists.
    pub(super) fn check(folder: &Path) -> Result<(), Failure> {
        match folder.symlink_metadata() {
            Ok(_) => Err(Failure::Usage(format!("{} exists already and is not overwritten", folder.display()))),
            Err(_) => Ok(()),
        }
    }

    /// Creates `folder` with all files. Changes nothing if `folder` exists or an error occurs. If Ctrl-C ends the
    /// program, `folder` is complete or absent.
    pub(super) fn create(&self, folder: &Path) -> Result<(), Failure> {
        let failed = |error| Failure::Failed(format!("cannot create the folder {}: {error}", folder.display()));
        let _writing = writing();
        let temporary = temporary_path(folder).map_err(failed)?;
        std::fs::create_dir(&temporary).map_err(failed)?;
        let written = self
            .write(&temporary)
            .and_then(|()| Self::check(folder))
            .and_then(|()| std::fs::rename(&temporary, folder).map_err(failed));
        if written.is_err() {
            // Remove the temporary folder, because it is incomplete or could not be renamed.
            let _ = std::fs::remove_dir_all(&temporary);
        }
        written
    }

    fn write(&self, folder: &Path) -> Result<(), Failure> {
        let texts = self.texts.iter().map(|(path, text)| (*path, text.as_bytes()));
        for (path, content) in self.copies.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice())).chain(texts) {
            let place = folder.join(path);
            let parent = place.parent().map_or(Ok(()), std::fs::create_dir_all);
            parent
                .and_then(|()| std::fs::write(&place, content))
                .map_err(|error| Failure::Failed(format!("cannot write {path} of the crate: {error}")))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    /// Creates an empty folder.
    fn empty(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lexibus-new-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder").flatten();
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
    }

    fn message(result: Result<(), Failure>) -> String {
        match result {
            Err(Failure::Usage(message) | Failure::Failed(message)) => message,
            _ => "no message".to_owned(),
        }
    }

    #[test]
    fn a_crate_is_created_completely_or_not_at_all() {
        let folder = empty("files");
        let mut files = Files::default();
        assert!(files.copy("Dicts/dict.xml".to_owned(), b"<x/>".to_vec()).is_ok());
        files.text("src/lib.rs", "//! x\n\n".to_owned());
        assert!(files.create(&folder.join("whole")).is_ok());
        assert_eq!(names(&folder), ["whole"]);
        let text = |path| std::fs::read_to_string(folder.join("whole").join(path)).expect("a file");
        assert_eq!((text("Dicts/dict.xml"), text("src/lib.rs")), ("<x/>".to_owned(), "//! x\n".to_owned()));
        assert!(message(files.create(&folder.join("whole"))).contains("exists already"));
        // The last file cannot be written, because its folder is a file.
        files.text("src/lib.rs/b.rs", String::new());
        assert!(message(files.create(&folder.join("partial"))).contains("cannot write src/lib.rs/b.rs"));
        assert_eq!(names(&folder), ["whole"]);
        std::fs::remove_dir_all(folder).expect("a folder");
    }

    #[test]
    fn a_copy_replaces_no_other_file() {
        let mut files = Files::default();
        for path in ["build.rs", "Cargo.toml", "CARGO.TOML", "src/lib.rs", "Tests/a.xml", ".cargo/config.toml"] {
            assert!(message(files.copy(path.to_owned(), Vec::new())).contains("rename the description"), "{path}");
        }
        assert!(files.copy("a.xml".to_owned(), vec![1]).is_ok());
        assert!(files.copy("b/a.xml".to_owned(), vec![2]).is_ok());
        assert!(files.copy("a.xml".to_owned(), vec![1]).is_ok());
        assert_eq!(files.copies.len(), 2);
        for (path, byte) in [("a.xml", 2), ("A.xml", 1), ("B/a.xml", 2)] {
            assert!(message(files.copy(path.to_owned(), vec![byte])).contains("rename one of the files"), "{path}");
        }
    }
}
