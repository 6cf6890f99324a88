//! Reads files that a description refers to.

use std::fmt;
use std::path::{Component, Path, PathBuf};

use super::{FileId, Source};

/// Files to which a description refers: the files that were read, and the paths of files that do not exist. Only files in the
/// folder of the description or below it are read.
#[derive(Debug)]
pub struct References<'a> {
    main: &'a Source,
    read: Vec<Source>,
    missing: Vec<PathBuf>,
}

/// The reason why a file is not read.
#[derive(Debug)]
pub enum Refusal {
    /// The description was not read from a file, so no folder is known.
    NoFolder,
    /// The file name leads to a file outside of the description's folder, or on another computer.
    Outside,
    /// The file name is that of a folder, a pipe or a device.
    NoFile,
    /// The description refers to too many files.
    TooMany,
    /// The operating system cannot read the file.
    Unreadable(std::io::Error),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::NoFolder => f.write_str("the description was not read from a folder"),
            Refusal::Outside => f.write_str("it is not in the folder of the description"),
            Refusal::NoFile => f.write_str("it is not a regular file"),
            Refusal::TooMany => write!(f, "the description refers to more than {MAX_REFERENCES} files"),
            Refusal::Unreadable(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for Refusal {}

/// Maximum number of referenced files that are read for one description.
pub const MAX_REFERENCES: usize = 64;

impl<'a> References<'a> {
    /// Creates an empty list of the files to which `main` refers.
    pub fn new(main: &'a Source) -> Self {
        References { main, read: Vec::new(), missing: Vec::new() }
    }

    /// Reads the file `name`. The name is a path relative to the folder of the description, with `/` or `\`.
    ///
    /// # Errors
    ///
    /// Returns the reason if the file is not read.
    pub fn open(&mut self, name: &str) -> Result<Source, Refusal> {
        let folder = self.main.folder().ok_or(Refusal::NoFolder)?;
        if self.read.len() >= MAX_REFERENCES {
            return Err(Refusal::TooMany);
        }
        let name = name.trim().replace('\\', "/");
        let relative = Path::new(name.strip_prefix("./").unwrap_or(&name));
        let inside = relative.components().all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || name.contains(':') || !inside {
            return Err(Refusal::Outside);
        }
        // A symbolic link in the folder may lead anywhere, so the location of its target is checked.
        let path = folder.join(relative);
        let real = path.canonicalize().map_err(|error| {
            if error.kind() == std::io::ErrorKind::NotFound {
                self.missing.push(path.clone());
            }
            Refusal::Unreadable(error)
        })?;
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        if !real.starts_with(folder.canonicalize().map_err(Refusal::Unreadable)?) {
            return Err(Refusal::Outside);
        }
        if !real.is_file() {
            return Err(Refusal::NoFile);
        }
        Source::read_from(&real, &path).map_err(Refusal::Unreadable)
    }

    /// Returns the number that [`References::add`] assigns to the next file.
    pub fn next_file(&self) -> FileId {
        FileId(self.read.len() as u32 + 1)
    }

    /// Keeps a file that was read, so that spans can refer to it.
    pub fn add(&mut self, source: Source) -> FileId {
        let file = self.next_file();
        self.read.push(source);
        file
    }

    /// Returns the files in the order of their numbers, and the paths of files that do not exist.
    pub fn into_files(self) -> (Vec<Source>, Vec<PathBuf>) {
        (self.read, self.missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_below_the_folder_are_read() {
        let folder = std::env::temp_dir().join(format!("lexibus-references-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("device/Dicts")).unwrap();
        std::fs::write(folder.join("secret.xml"), "s").unwrap();
        std::fs::write(folder.join("device/Dicts/a b.xml"), "<x/>").unwrap();
        let main = Source::new("main.xml", Vec::new()).in_folder(folder.join("device"));
        let mut references = References::new(&main);
        for name in ["Dicts/a b.xml", "./Dicts/a b.xml", "Dicts\\a b.xml", " Dicts/a b.xml "] {
            assert_eq!(references.open(name).unwrap().text(), "<x/>", "{name}");
        }
        for name in ["../secret.xml", "Dicts/../../secret.xml", "/etc/passwd", "C:\\x.xml", "http://x/y.xml", ""] {
            assert!(matches!(references.open(name), Err(Refusal::Outside)), "{name}");
        }
        assert!(matches!(references.open("none.xml"), Err(Refusal::Unreadable(_))));
        assert_eq!(references.missing, [folder.join("device/none.xml")]);
        assert!(matches!(references.open("Dicts"), Err(Refusal::NoFile)));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.join("secret.xml"), folder.join("device/link.xml")).unwrap();
            assert!(matches!(references.open("link.xml"), Err(Refusal::Outside)));
            std::os::unix::fs::symlink(&folder, folder.join("device/up")).unwrap();
            assert!(matches!(references.open("up/secret.xml"), Err(Refusal::Outside)));
            std::os::unix::fs::symlink(folder.join("device/Dicts/a b.xml"), folder.join("device/within.xml")).unwrap();
            assert_eq!(references.open("within.xml").unwrap().text(), "<x/>");
        }
        std::fs::remove_dir_all(folder).unwrap();
        let unplaced = Source::new("x", Vec::new());
        assert!(matches!(References::new(&unplaced).open("a.xml"), Err(Refusal::NoFolder)));
    }
}
