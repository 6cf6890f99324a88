//! The baseline of `lexibus check`: a file with the diagnostics that are known and not reported.
//!
//! The file contains one JSON object per line, sorted, so that a change is easy to review. An entry has no line number: it
//! identifies diagnostics by file path, code, message and marked line, and states their count. Inserted lines therefore do not change an entry.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::render::marked::{quoted, MarkedSource};
use lexibus_codegen::diagnostics::Diagnostic;
use lexibus_codegen::source::Source;
use lexibus_codegen::text::{count_of, printable};
use serde::{Deserialize, Serialize};

use super::files::put;
use super::report::json_line;
use super::Failure;

/// First line of a baseline.
const HEADER: &str = r#"{"lexibus_baseline":1}"#;

/// A diagnostic without its position.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
struct Key {
    /// Path relative to the folder of the baseline, with `/` between its parts.
    file: String,
    code: String,
    /// Message of the diagnostic; `None` if the diagnostic also represents diagnostics that were only counted.
    message: Option<String>,
    /// Marked line without surrounding whitespace; `None` if the diagnostic concerns a whole file.
    line: Option<String>,
}

/// An entry of the baseline: a line after the first line of the file.
#[derive(Serialize, Deserialize)]
struct Entry {
    #[serde(flatten)]
    key: Key,
    count: usize,
}

/// Numbers of equal diagnostics in the baseline and in this run.
#[derive(Clone, Copy, Default)]
struct Count {
    /// Number in the baseline.
    known: usize,
    /// Number in this run. Diagnostics of an overlay are counted once, although each compilation with the overlay
    /// repeats them.
    found: usize,
}

/// Known diagnostics.
pub(super) struct Baseline {
    path: PathBuf,
    folder: PathBuf,
    counts: BTreeMap<Key, Count>,
    /// Files that were checked in this run.
    checked: BTreeSet<String>,
    /// Number of diagnostics of this run that were left out because they are in the baseline.
    left_out: usize,
}

impl Baseline {
    /// Creates an empty baseline that will be written to `path`.
    pub(super) fn new(path: &Path) -> Result<Self, Failure> {
        let absolute = std::path::absolute(path)
            .map_err(|error| Failure::Usage(format!("cannot use the baseline {}: {error}", path.display())))?;
        let folder = normalized(absolute.parent().unwrap_or(Path::new("")));
        let (counts, checked) = (BTreeMap::new(), BTreeSet::new());
        Ok(Baseline { path: path.to_owned(), folder, counts, checked, left_out: 0 })
    }

    /// Reads the baseline at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        let failed = |reason: String| Failure::Usage(format!("cannot read the baseline {}: {reason}", path.display()));
        let source = Source::read(path).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => failed(format!("{error}: create it with --write-baseline")),
            _ => failed(error.to_string()),
        })?;
        let mut lines = source.text().lines();
        if lines.next() != Some(HEADER) {
            return Err(failed(format!("the first line is not {HEADER}")));
        }
        let mut baseline = Baseline::new(path)?;
        for (number, line) in (2..).zip(lines) {
            let entry: Entry = serde_json::from_str(line)
                .map_err(|error| failed(format!("line {number} is not an entry: {error}")))?;
            let known = &mut baseline.counts.entry(entry.key).or_default().known;
            *known = known.saturating_add(entry.count);
        }
        Ok(baseline)
    }

    /// Returns the diagnostics of a compilation, except those in the baseline. If a diagnostic occurs more often in
    /// this run than in the baseline, returns only the additional occurrences, which are the last ones.
    pub(super) fn without_known<'c>(&mut self, compilation: &'c Compilation) -> Vec<Cow<'c, Diagnostic>> {
        let names: Vec<String> = compilation.sources.iter().map(|source| self.name(source)).collect();
        let mut found: BTreeMap<Key, usize> = BTreeMap::new();
        let mut new = Vec::new();
        for diagnostic in compilation.diagnostics.list() {
            let key = key(diagnostic, &compilation.sources, &names);
            let known = self.counts.get(&key).map_or(0, |count| count.known);
            let before = found.entry(key).or_default();
            let left = diagnostic.occurrences().min(known.saturating_sub(*before));
            *before += diagnostic.occurrences();
            self.left_out += left;
            match diagnostic.occurrences() - left {
                0 => {}
                more if left > 0 => new.push(Cow::Owned(diagnostic.with_more(more))),
                _ => new.push(Cow::Borrowed(diagnostic)),
            }
        }
        self.checked.extend(names);
        for (key, number) in found {
            let count = self.counts.entry(key).or_default();
            count.found = count.found.max(number);
        }
        new
    }

    /// Returns the number of left-out diagnostics as an addition to the summary.
    pub(super) fn summary(&self) -> String {
        format!(" ({} in the baseline)", self.left_out)
    }

    /// Returns a note with the number of diagnostics in the baseline that no longer occur in the checked files, or
    /// `None` if there are none.
    pub(super) fn obsolete(&self) -> Option<String> {
        let is_checked = |key: &Key| self.checked.contains(&key.file);
        let counts = self.counts.iter().filter(|(key, _)| is_checked(key));
        let obsolete: usize = counts.map(|(_, count)| count.known.saturating_sub(count.found)).sum();
        let are = if obsolete == 1 { "diagnostic of the baseline does" } else { "diagnostics of the baseline do" };
        let path = self.path.display();
        (obsolete > 0)
            .then(|| format!("note: {obsolete} {are} not occur any more: write {path} again with --write-baseline"))
    }

    /// Writes the diagnostics of this run as the new baseline. Returns a summary.
    pub(super) fn write(&self) -> Result<String, Failure> {
        let mut text = format!("{HEADER}\n");
        let found = self.counts.iter().filter(|(_, count)| count.found > 0);
        for (key, count) in found.clone() {
            let entry = Entry { key: key.clone(), count: count.found };
            text += &json_line(&entry)?;
        }
        put(Some(&self.path), &text)?;
        let number: usize = found.map(|(_, count)| count.found).sum();
        Ok(format!("wrote {}: {}", self.path.display(), count_of(number, "diagnostic")))
    }

    /// Returns the path of a source relative to the folder of the baseline.
    fn name(&self, source: &Source) -> String {
        let name = Path::new(source.name());
        let path = std::path::absolute(name).map_or_else(|_| name.to_owned(), |path| normalized(&path));
        let shared = path.components().zip(self.folder.components()).take_while(|(a, b)| a == b).count();
        let up = self.folder.components().skip(shared).map(|_| "..".into());
        let down = path.components().skip(shared).map(|part| part.as_os_str().to_string_lossy());
        printable(&up.chain(down).collect::<Vec<_>>().join("/")).into_owned()
    }
}

/// Removes `.` and `..` from a path.
fn normalized(path: &Path) -> PathBuf {
    let mut normalized = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(normalized.pop()),
            _ => normalized.push(part),
        }
    }
    normalized
}

fn key(diagnostic: &Diagnostic, sources: &[Source], names: &[String]) -> Key {
    let line = MarkedSource::of(diagnostic.span, sources).and_then(|place| Some(quoted(place.source, &place.mark?)));
    Key {
        file: names.get(diagnostic.span.file.0 as usize).cloned().unwrap_or_default(),
        code: diagnostic.code.id.to_owned(),
        message: (diagnostic.more == 0).then(|| printable(&diagnostic.message).into_owned()),
        line: line.map(|line| printable(line.trim()).into_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::{codes, Diagnostics};
    use lexibus_codegen::limits::MAX_SAME_DIAGNOSTICS;
    use lexibus_codegen::source::{FileId, Span};

    /// Returns a compilation of `lines` with a diagnostic on each line.
    fn compilation(name: &str, lines: &str) -> Compilation {
        let mut diagnostics = Diagnostics::default();
        let mut start = 0;
        for line in lines.lines() {
            let end = start + line.len() as u32;
            diagnostics.push(Diagnostic::new(&codes::JUNK_LINE, Span::new(FileId(0), start, end), "junk"));
            start = end + 1;
        }
        diagnostics.sort();
        Compilation::of_diagnostics(Source::new(name, lines.into()), diagnostics)
    }

    /// Returns a baseline that contains the diagnostics of `file`.
    fn known(file: &Compilation) -> Baseline {
        let mut baseline = Baseline::new(Path::new("a/known")).ok().expect("a baseline");
        assert_eq!(baseline.without_known(file).len(), file.diagnostics.list().len());
        for count in baseline.counts.values_mut() {
            *count = Count { known: count.found, found: 0 };
        }
        baseline
    }

    #[test]
    fn only_diagnostics_on_other_lines_are_new() {
        let mut baseline = known(&compilation("x", "one\ntwo\none"));
        let moved = compilation("./b/../x", "two\n  one\nthree\none\none");
        let new: Vec<u32> = baseline.without_known(&moved).iter().map(|diagnostic| diagnostic.span.start).collect();
        assert_eq!(new, [10, 20], "the line `three`, and the last `one`");
        assert_eq!((baseline.left_out, baseline.obsolete()), (3, None));
        let mut baseline = known(&compilation("x", "one\ntwo\none"));
        assert!(baseline.without_known(&compilation("x", "one")).is_empty());
        assert!(baseline.obsolete().is_some_and(|note| note.starts_with("note: 2 diagnostics")));
        assert_eq!(baseline.without_known(&compilation("y", "one")).len(), 1, "another file");
    }

    #[test]
    fn names_are_relative_to_the_folder_of_the_baseline() {
        let baseline = Baseline::new(Path::new("a/b/known")).ok().expect("a baseline");
        let name = |path: &str| baseline.name(&Source::new(path, Vec::new()));
        assert_eq!((name("a/b/c/x").as_str(), name("./a/../x").as_str()), ("c/x", "../../x"));
    }

    #[test]
    fn the_number_beyond_the_bound_is_compared() {
        let lines = |count: usize| "one\n".repeat(count);
        let mut baseline = known(&compilation("x", &lines(MAX_SAME_DIAGNOSTICS + 3)));
        assert!(baseline.without_known(&compilation("x", &lines(MAX_SAME_DIAGNOSTICS + 3))).is_empty());
        let more = compilation("x", &lines(MAX_SAME_DIAGNOSTICS + 5));
        let new: Vec<usize> = baseline.without_known(&more).iter().map(|diagnostic| diagnostic.more).collect();
        assert_eq!(new, [2]);
    }
}
