//! `lexibus fix`: applies the fixes that diagnostics suggest, and keeps all other bytes of a file.

use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::diagnostics::{render, Diagnostic, Severity};
use lexibus_codegen::output::{write_if_changed, writing};
use lexibus_codegen::source::Source;
use lexibus_codegen::text::count_of;

use super::args::Fix;
use super::files::cannot_write;
use super::report::Reporter;
use super::{inputs, say, unified, Failure};

/// Maximum number of rounds for a file. Each round applies up to 10,000 fixes of each code and compiles the file again.
const MAX_ROUNDS: usize = 100;

pub(super) fn run(fix: &Fix) -> Result<bool, Failure> {
    let options = fix.inputs.options()?;
    let mut reporter = Reporter::new(&fix.inputs, false)?;
    let mut totals = Totals::default();
    let files = distinct(inputs::sorted(&fix.inputs)?);
    inputs::compile_all(&files, &fix.inputs, &options, |path, compilation| {
        if compilation.catalog.is_none() {
            reporter.report(&compilation)?;
            return Ok(());
        }
        let old = compilation.sources[0].clone();
        match Fixed::of(compilation, &options) {
            Ok(fixed) => {
                let written = match fix.dry_run {
                    true => {
                        show(&old, &fixed)?;
                        Ok(())
                    }
                    false => write(path, &old, &fixed, !fix.no_backup),
                };
                match written {
                    Ok(()) => totals.add(path, &fixed, &reporter, fix.dry_run),
                    Err(error) => reporter.error(&cannot_write(path, &error)),
                }
            }
            Err(reason) => reporter.error(&format!("{}: {reason}: the file is unchanged", path.display())),
        }
        Ok(())
    })?;
    if totals.files > 0 {
        totals.print(&reporter, fix.dry_run);
    }
    reporter.finish()
}

/// Removes repeated files from a list, such as a link to another file of the list.
fn distinct(mut files: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut seen = HashSet::new();
    files.retain(|path| seen.insert(fs::canonicalize(path).unwrap_or_else(|_| path.clone())));
    files
}

/// The compilation of a description after its fixes were applied, and the number of these fixes.
struct Fixed {
    compilation: Compilation,
    /// Number of applied fixes.
    count: usize,
}

impl Fixed {
    /// Applies the fixes of a compilation, compiles the changed file, and repeats this until no fix is left. Fixes that
    /// overlap are applied in several rounds.
    ///
    /// # Errors
    ///
    /// Returns a message if the fixes cannot be applied, cause an error, or are still left after [`MAX_ROUNDS`] rounds.
    fn of(compilation: Compilation, options: &Options) -> Result<Self, String> {
        let was_usable = compilation.is_usable();
        let mut fixed = Fixed { compilation, count: 0 };
        for _ in 0..MAX_ROUNDS {
            let replacements = replacements(&fixed.compilation);
            if replacements.is_empty() {
                if was_usable && !fixed.compilation.is_usable() {
                    return Err("the fixes cause an error".to_owned());
                }
                return Ok(fixed);
            }
            let old = &fixed.compilation.sources[0];
            let new = old.replaced(&replacements).ok_or_else(|| {
                format!("the fixes cannot be written in the encoding of the file ({})", old.encoding().name())
            })?;
            fixed = Fixed { count: fixed.count + replacements.len(), compilation: compile::check(new, options) };
        }
        Err(format!("fixes are left after {MAX_ROUNDS} rounds"))
    }

    /// Returns the number of suggested fixes in each other file of the compilation, such as an overlay, by file name.
    fn elsewhere(&self) -> BTreeMap<&str, usize> {
        let mut counts = BTreeMap::new();
        let is_elsewhere = |diagnostic: &&Diagnostic| diagnostic.fix.is_some() && diagnostic.span.file.0 > 0;
        for diagnostic in self.compilation.diagnostics.list().iter().filter(is_elsewhere) {
            let Some(source) = self.compilation.sources.get(diagnostic.span.file.0 as usize) else { continue };
            *counts.entry(source.name()).or_default() += 1;
        }
        counts
    }
}

/// Returns the fixes in the first file of a compilation, in ascending order of their positions. Leaves out fixes that
/// have an empty span, overlap an earlier fix or change nothing.
fn replacements(compilation: &Compilation) -> Vec<(Range<usize>, &str)> {
    let source = &compilation.sources[0];
    let mut all: Vec<(Range<usize>, &str)> = Vec::new();
    for diagnostic in compilation.diagnostics.list() {
        let Some(fix) = diagnostic.fix.as_deref() else { continue };
        let span = diagnostic.span;
        if span.file.0 == 0 && !span.is_empty() && source.slice(span) != fix {
            all.push((span.range(), fix));
        }
    }
    all.sort_by_key(|(range, _)| (range.start, range.end));
    let mut end = 0;
    all.retain(|(range, _)| {
        let is_free = range.start >= end;
        end = if is_free { range.end } else { end };
        is_free
    });
    all
}

/// Prints the unified diff of a file and its fixed version to standard output.
fn show(old: &Source, fixed: &Fixed) -> io::Result<()> {
    let new = &fixed.compilation.sources[0];
    let mut out = io::stdout().lock();
    for line in unified::lines((old.name(), old.text()), (new.name(), new.text())) {
        writeln!(out, "{line}")?;
    }
    out.flush()
}

/// Writes a file to which fixes were applied. If `keep` is set, first saves the old content in a backup.
fn write(path: &Path, old: &Source, fixed: &Fixed, keep: bool) -> io::Result<()> {
    if fixed.count == 0 {
        return Ok(());
    }
    if fs::read(path)? != *old.bytes() {
        return Err(io::Error::other("the file has changed since it was read"));
    }
    let backup = if keep { Some(back_up(path)?) } else { None };
    let written = write_if_changed(path, fixed.compilation.sources[0].bytes());
    if let (Err(_), Some(backup)) = (&written, &backup) {
        // Remove the backup, because the file could not be written and still has its old content.
        let _ = fs::remove_file(backup);
    }
    written
}

/// Saves the content of a file in `FILE.bak`, with the same permissions. Does not replace an existing backup.
fn back_up(path: &Path) -> io::Result<PathBuf> {
    let mut name = path.as_os_str().to_owned();
    name.push(".bak");
    let backup = PathBuf::from(name);
    // Use a hard link: the file is later replaced by a new file, so the link keeps the old content.
    let linked = fs::canonicalize(path).and_then(|target| fs::hard_link(target, &backup));
    let made = match linked {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => copy(path, &backup),
        linked => linked,
    };
    match made {
        Ok(()) => Ok(backup),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(io::Error::other(format!(
            "the backup {} exists already: remove it, or use --no-backup",
            backup.display()
        ))),
        Err(error) => Err(io::Error::other(format!("cannot create the backup {}: {error}", backup.display()))),
    }
}

/// Copies a file to a new file, for file systems without hard links.
fn copy(path: &Path, backup: &Path) -> io::Result<()> {
    let _writing = writing();
    let mut file = fs::File::options().write(true).create_new(true).open(backup)?;
    let copied = fs::File::open(path).and_then(|mut old| {
        file.set_permissions(old.metadata()?.permissions())?;
        io::copy(&mut old, &mut file)
    });
    if copied.is_err() {
        // Remove the incomplete backup.
        let _ = fs::remove_file(backup);
    }
    copied.map(|_| ())
}

/// Numbers of files, changed files, fixes, and remaining errors and warnings of all inputs.
#[derive(Default)]
struct Totals {
    files: usize,
    changed: usize,
    fixes: usize,
    errors: usize,
    warnings: usize,
}

impl Totals {
    /// Adds a file, and reports its fixes.
    fn add(&mut self, path: &Path, fixed: &Fixed, reporter: &Reporter, is_dry_run: bool) {
        self.files += 1;
        self.errors += fixed.compilation.diagnostics.count(Severity::Error);
        self.warnings += fixed.compilation.diagnostics.count(Severity::Warning);
        if fixed.count > 0 {
            self.changed += 1;
            self.fixes += fixed.count;
            let applied = if is_dry_run { "" } else { " applied" };
            reporter.progress(&format!("{}: {}{applied}", path.display(), fixes(fixed.count)));
        }
        for (name, count) in fixed.elsewhere() {
            say(&format!("note: {}: {} in {name}: pass it as an input", path.display(), fixes(count)));
        }
    }

    fn print(&self, reporter: &Reporter, is_dry_run: bool) {
        let applied = if is_dry_run { "" } else { " applied" };
        let files = count_of(self.files, "file");
        let remaining = render::summary(self.errors, self.warnings);
        reporter.progress(&format!(
            "{}{applied} in {} of {files}; remaining: {remaining}",
            fixes(self.fixes),
            self.changed
        ));
    }
}

fn fixes(count: usize) -> String {
    format!("{count} {}", if count == 1 { "fix" } else { "fixes" })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
    use lexibus_codegen::source::{FileId, Span};

    /// `lexibus` acquires the guard `settled` before a signal ends it. While the test holds this guard, no backup must be
    /// started.
    #[test]
    fn a_backup_is_complete_when_the_program_ends() {
        let folder = std::env::temp_dir().join(format!("lexibus-fix-copy-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let (path, backup) = (folder.join("a"), folder.join("a.bak"));
        fs::write(&path, "old").expect("a file");
        let settled = lexibus_codegen::output::settled();
        let copying = std::thread::spawn({
            let (path, backup) = (path.clone(), backup.clone());
            move || copy(&path, &backup)
        });
        std::thread::sleep(Duration::from_millis(100));
        assert!(!backup.exists(), "the backup was started after the end");
        drop(settled);
        copying.join().expect("no panic").expect("a backup");
        assert_eq!(fs::read_to_string(&backup).expect("a backup"), "old");
        fs::remove_dir_all(folder).expect("a folder");
    }

    #[test]
    fn fixes_of_a_round_do_not_overlap_and_change_the_file() {
        let mut diagnostics = Diagnostics::default();
        for (file, start, end, fix) in [
            (0, 4, 6, Some("second")),
            (0, 0, 3, Some("first")),
            (0, 2, 5, Some("overlaps")),
            (0, 4, 6, Some("same place")),
            (0, 6, 7, Some("g")),
            (0, 7, 8, None),
            (0, 0, 0, Some("whole file")),
            (1, 7, 8, Some("other file")),
        ] {
            let mut diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(file), start, end), "");
            diagnostic.fix = fix.map(str::to_owned);
            diagnostics.push(diagnostic);
        }
        diagnostics.sort();
        let compilation = Compilation::of_diagnostics(Source::new("x", b"abcdefgh".to_vec()), diagnostics);
        assert_eq!(replacements(&compilation), [(0..3, "first"), (4..6, "second")]);
    }
}
