//! Creates the files of a new crate in a new folder.

use std::path::{Path, PathBuf};

use crate::output::create;
use crate::Failure;

/// The files of a crate, with their paths in the folder of the crate.
#[derive(Default)]
pub(super) struct Files {
    texts: Vec<(&'static str, String)>,
    /// Copies of description files: name and content.
    copies: Vec<(String, Vec<u8>)>,
}

impl Files {
    pub(super) fn text(&mut self, path: &'static str, text: String) {
        // Templates have no final line break.
        self.texts.push((path, text.trim_end().to_owned() + "\n"));
    }

    pub(super) fn copy(&mut self, name: String, bytes: Vec<u8>) {
        self.copies.push((name, bytes));
    }

    /// Returns an error if `folder` exists.
    pub(super) fn check(folder: &Path) -> Result<(), Failure> {
        match folder.symlink_metadata() {
            Ok(_) => Err(taken(folder)),
            Err(_) => Ok(()),
        }
    }

    /// Creates `folder` with all files. Changes nothing if `folder` exists.
    pub(super) fn create(&self, folder: &Path) -> Result<(), Failure> {
        std::fs::create_dir(folder).map_err(|error| match error.kind() {
            std::io::ErrorKind::AlreadyExists => taken(folder),
            _ => Failure::Usage(format!("cannot create the folder {}: {error}", folder.display())),
        })?;
        for (name, bytes) in &self.copies {
            create(&folder.join(name), bytes)?;
        }
        for (path, text) in &self.texts {
            let path = folder.join(path);
            make_parent(&path)?;
            create(&path, text.as_bytes())?;
        }
        Ok(())
    }
}

fn taken(folder: &Path) -> Failure {
    Failure::Usage(format!("{} exists already and is not overwritten", folder.display()))
}

fn make_parent(path: &Path) -> Result<(), Failure> {
    let parent: PathBuf = path.parent().map(Path::to_owned).unwrap_or_default();
    std::fs::create_dir_all(&parent)
        .map_err(|error| Failure::Usage(format!("cannot create the folder {}: {error}", parent.display())))
}
