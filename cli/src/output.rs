//! Writes the output of a command to files or standard output, or compares it with existing files.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use lexibus_codegen::output::{is_no_regular_file, Writer};

use super::args::Inputs;
use super::files::{cannot_write, create_folder};
use super::report::Reporter;
use super::{unified, Failure};

/// Destination of the output.
pub(super) struct Target<'g> {
    out: Option<&'g Path>,
    /// Whether to compare the output with existing files instead of writing it.
    check: bool,
    is_folder: bool,
    /// Whether there are several inputs or a folder as an input.
    pub(super) many: bool,
    /// Output paths that have been used so far.
    names: BTreeSet<PathBuf>,
    /// Number of output files, including files that already had the same text.
    files: usize,
}

impl<'g> Target<'g> {
    pub(super) fn new(inputs: &Inputs, out: Option<&'g Path>, check: bool) -> Result<Self, Failure> {
        let many = inputs.paths.len() > 1 || inputs.paths.iter().any(|path| path.is_dir());
        let names_folder = |out: &Path| out.is_dir() || out.as_os_str().to_string_lossy().ends_with(['/', '\\']);
        let is_folder = out.is_some_and(|out| many || names_folder(out));
        if many && out.is_some_and(Path::is_file) {
            return Err(Failure::Usage("several inputs need an output folder, but --out is a file".into()));
        }
        if many && out.is_none() {
            return Err(Failure::Usage("several inputs need an output folder: name it with --out".into()));
        }
        let folder = out.and_then(|out| if is_folder { Some(out) } else { out.parent() });
        if let Some(out) = folder.filter(|out| !check && !out.as_os_str().is_empty()) {
            create_folder(out)?;
        }
        Ok(Target { out, check, is_folder, many, names: BTreeSet::new(), files: 0 })
    }

    /// Returns whether the target accepts several outputs.
    pub(super) fn takes_many(&self) -> bool {
        self.is_folder
    }

    /// Writes an output to standard output or a file, or compares it with the existing file. In a folder, the file name
    /// is `name` with the extension `ending`. A number makes repeated names unique.
    pub(super) fn put(
        &mut self,
        name: impl FnOnce() -> String,
        ending: &str,
        content: impl AsRef<[u8]>,
        reporter: &mut Reporter,
    ) -> Result<(), Failure> {
        let write = |sink: &mut dyn FnMut(&[u8])| {
            sink(content.as_ref());
            true
        };
        self.put_parts(name, ending, None, reporter, write).map(|_| ())
    }

    /// Does the same as [`put`](Self::put) for an output that `write` passes to its argument in parts. If `write` returns false,
    /// there is no output. Returns whether there is one. `summary` describes the input of an output that is reported.
    pub(super) fn put_parts(
        &mut self,
        name: impl FnOnce() -> String,
        ending: &str,
        summary: Option<String>,
        reporter: &mut Reporter,
        write: impl FnOnce(&mut dyn FnMut(&[u8])) -> bool,
    ) -> Result<bool, Failure> {
        let Some(out) = self.out else { return Ok(print(write)?) };
        let path = if self.is_folder { self.file_in(out, &name(), ending) } else { out.to_owned() };
        let (mut content, mut writer, mut lines) = (Vec::new(), None, 0);
        let exists = write(&mut |part| {
            lines += part.iter().filter(|byte| **byte == b'\n').count();
            match self.check {
                true => content.extend_from_slice(part),
                false => writer.get_or_insert_with(|| Writer::new(&path)).push(part),
            }
        });
        if !exists {
            self.names.remove(&path);
            return Ok(false);
        }
        if self.check {
            check_bytes(&path, &content, reporter);
            return Ok(true);
        }
        if let Err(error) = writer.unwrap_or_else(|| Writer::new(&path)).finish() {
            reporter.error(&cannot_write(&path, &error));
            return Ok(true);
        }
        self.files += 1;
        if let Some(summary) = summary {
            reporter.progress(&format!("read {summary}"));
            reporter.progress(&format!("wrote {}: {lines} lines", path.display()));
        }
        Ok(true)
    }

    /// Returns whether the output of a single input is written to files. If so, commands print a message with details
    /// about each file.
    pub(super) fn is_one_file(&self) -> bool {
        self.out.is_some() && !self.check && !self.many
    }

    /// Reports the number of files that were written to a folder.
    pub(super) fn summarize(&self, reporter: &mut Reporter) {
        if let Some(out) = self.out.filter(|_| !self.check && self.many) {
            reporter.progress(&format!("wrote {} files to {}", self.files, out.display()));
        }
    }

    /// Returns the path of a file in `folder`. If an earlier output of this run has the same path, adds a number to the
    /// name.
    fn file_in(&mut self, folder: &Path, name: &str, ending: &str) -> PathBuf {
        let mut path = folder.join(format!("{name}.{ending}"));
        let mut number = 2;
        while !self.names.insert(path.clone()) {
            path = folder.join(format!("{name}_{number}.{ending}"));
            number += 1;
        }
        path
    }
}

/// Prints the parts that `write` passes to its argument to standard output. Returns the result of `write`.
fn print(write: impl FnOnce(&mut dyn FnMut(&[u8])) -> bool) -> std::io::Result<bool> {
    let (mut stdout, mut printed) = (std::io::stdout().lock(), Ok(()));
    let exists = write(&mut |part| {
        if printed.is_ok() {
            printed = stdout.write_all(part);
        }
    });
    printed.map(|()| exists)
}

fn check(path: &Path, text: &str, reporter: &mut Reporter) {
    if let Some(difference) = difference(path, text) {
        reporter.error(&difference.message);
        difference.lines(path, text).iter().for_each(|line| reporter.progress(line));
    }
}

/// An output that differs from a file.
pub(super) struct Difference {
    pub message: String,
    /// Content of the file, if it can be read.
    old: Option<Vec<u8>>,
}

impl Difference {
    /// Returns the first lines of the unified diff. The list is empty if the file cannot be read.
    pub(super) fn lines(&self, path: &Path, text: &str) -> Vec<String> {
        let name = path.display();
        let old = self.old.as_deref().map(String::from_utf8_lossy);
        old.map_or(Vec::new(), |old| unified::short((&name.to_string(), &old), (&format!("{name} (new)"), text)))
    }
}

/// Reports an error if the content of a file differs from `content`, or if the file cannot be compared. If `content` is
/// UTF-8 and the file can be read, also prints the first lines of the unified diff.
pub(super) fn check_bytes(path: &Path, content: &[u8], reporter: &mut Reporter) {
    match std::str::from_utf8(content) {
        Ok(text) => check(path, text, reporter),
        Err(_) if std::fs::read(path).is_ok_and(|bytes| bytes == content) => {}
        Err(_) => reporter.error(&format!("{} is missing or stale: write it again without --check", path.display())),
    }
}

/// Returns a [`Difference`] if the content of a file differs from `text`, or if the file cannot be compared.
pub(super) fn difference(path: &Path, text: &str) -> Option<Difference> {
    let found = |reason: &str, old| Some(Difference { message: format!("{} {reason}", path.display()), old });
    if is_no_regular_file(path) {
        return found("cannot be compared: it is not a regular file", None);
    }
    match std::fs::read(path) {
        Ok(bytes) if bytes == text.as_bytes() => None,
        Ok(bytes) => found("is stale: write it again without --check", Some(bytes)),
        Err(error) => found(&format!("cannot be compared: {error}"), None),
    }
}
