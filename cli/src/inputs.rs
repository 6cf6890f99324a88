//! Reads and compiles files in parallel.

use std::collections::HashSet;
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::sync::mpsc;

use indicatif::{ProgressBar, ProgressStyle};
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::frontend::{self, detect};
use lexibus_codegen::ir::Format;
use lexibus_codegen::limits::MAX_FOLDER_DEPTH;
use lexibus_codegen::source::{FileId, Source, Span};

use super::args::Inputs;
use super::Failure;

/// Compiles all inputs in parallel. Passes the results to `use_it` in the order of the arguments on the command line.
pub(super) fn each(
    inputs: &Inputs,
    options: &Options,
    use_it: impl FnMut(&Path, Compilation) -> Result<(), Failure>,
) -> Result<(), Failure> {
    compile_all(&files(&inputs.paths)?, inputs, options, use_it)
}

/// Compiles all inputs like [`each`], but in the order of their paths and without duplicates.
///
/// The content of an output folder then does not depend on the order of the arguments.
pub(super) fn each_by_path(
    inputs: &Inputs,
    options: &Options,
    use_it: impl FnMut(&Path, Compilation) -> Result<(), Failure>,
) -> Result<(), Failure> {
    compile_all(&sorted(inputs)?, inputs, options, use_it)
}

/// Returns the input files in the order of their paths, without duplicates.
pub(super) fn sorted(inputs: &Inputs) -> Result<Vec<PathBuf>, Failure> {
    let mut files = files(&inputs.paths)?;
    files.sort();
    files.dedup();
    Ok(files)
}

/// Compiles files in parallel, and passes the results to `use_it` in the order of the files.
///
/// A single file is compiled without another thread: the memory of an allocator for several threads is less compact.
pub(super) fn compile_all(
    files: &[PathBuf],
    inputs: &Inputs,
    options: &Options,
    mut use_it: impl FnMut(&Path, Compilation) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if let [path] = files {
        return use_it(path, compile_file(path, options));
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads(inputs.jobs, files.len()))
        .build()
        .map_err(|error| Failure::Usage(format!("cannot start the threads: {error}")))?;
    let progress = progress(files.len());
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        let pool = &pool;
        scope.spawn(move || {
            pool.scope(|scope| {
                for (position, path) in files.iter().enumerate() {
                    let sender = sender.clone();
                    // Ignore a failure to send. Sending fails only if the receiver was dropped after an error.
                    scope.spawn(move |_| drop(sender.send((position, compile_file(path, options)))));
                }
            });
        });
        in_order(files, receiver, &progress, &mut use_it)
    })?;
    progress.finish_and_clear();
    Ok(())
}

/// Returns the number of threads: `asked` or the number of processors, but not more than the number of files.
fn threads(asked: Option<u16>, files: usize) -> usize {
    let available = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(available, usize::from).clamp(1, files.max(1))
}

/// Passes the results to `use_it` in the order of `files`.
fn in_order(
    files: &[PathBuf],
    receiver: mpsc::Receiver<(usize, Compilation)>,
    progress: &ProgressBar,
    use_it: &mut impl FnMut(&Path, Compilation) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut waiting: Vec<Option<Compilation>> = files.iter().map(|_| None).collect();
    let mut next = 0;
    for (position, compilation) in receiver {
        waiting[position] = Some(compilation);
        while let Some(compilation) = waiting.get_mut(next).and_then(Option::take) {
            progress.suspend(|| use_it(&files[next], compilation))?;
            progress.inc(1);
            next += 1;
        }
    }
    Ok(())
}

/// Compiles a file. If the file is unreadable, the result contains a diagnostic.
pub(super) fn compile_file(path: &Path, options: &Options) -> Compilation {
    match Source::read(path) {
        Ok(source) => compile::check(source, options),
        Err(error) => {
            let mut diagnostics = Diagnostics::new(options.levels.clone());
            let message = format!("cannot read the file: {error}");
            diagnostics.push(Diagnostic::new(&codes::UNREADABLE_FILE, Span::new(FileId(0), 0, 0), message));
            let source = Source::new(path.to_string_lossy(), Vec::new());
            Compilation::of_diagnostics(source, diagnostics)
        }
    }
}

/// Returns a progress bar. The bar is hidden if standard output or standard error is not a terminal, or if there are
/// fewer than two files.
fn progress(files: usize) -> ProgressBar {
    if files < 2 || !std::io::stderr().is_terminal() || !std::io::stdout().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(files as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos}/{len} files, {eta} left") {
        bar.set_style(style);
    }
    bar
}

/// Returns the input files. Each folder is replaced with the device descriptions in it and in its subfolders, sorted by
/// path. Returns an error if a folder contains no device description or its subfolders are nested too deeply.
pub(super) fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = files.len();
            search(path, 0, &mut HashSet::new(), &mut files)?;
            if files.len() == before {
                return Err(Failure::Usage(format!("there is no device description in {}", path.display())));
            }
        } else {
            files.push(path.clone());
        }
    }
    Ok(files)
}

/// Adds the device descriptions in `folder` and its subfolders to the list.
///
/// Each folder is searched only once, because a symbolic link to a parent folder would otherwise repeat the search.
fn search(
    folder: &Path,
    depth: usize,
    searched: &mut HashSet<PathBuf>,
    files: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    if !folder.canonicalize().is_ok_and(|folder| searched.insert(folder)) {
        return Ok(());
    }
    if depth > MAX_FOLDER_DEPTH {
        let message = format!(
            "{}: folders are searched to a depth of {MAX_FOLDER_DEPTH}: name this folder as an input",
            folder.display()
        );
        return Err(Failure::Usage(message));
    }
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(()) };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            search(&path, depth + 1, searched, files)?;
        } else if path.is_file() && is_description(&path) {
            // Skip pipes and devices, because reading them may never end.
            files.push(path);
        }
    }
    Ok(())
}

/// Returns whether a file is a device description. The file must have a known extension. An XML or TOML file must also
/// have matching content or be unreadable; the error of an unreadable file is reported later.
fn is_description(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if extension.eq_ignore_ascii_case("xml") {
        return is_xml_description(path);
    }
    if extension.eq_ignore_ascii_case("toml") {
        return is_table_of_device(path);
    }
    let mut endings = Format::ALL.iter().flat_map(|format| format.endings());
    endings.any(|ending| ending.eq_ignore_ascii_case(extension))
}

fn is_xml_description(path: &Path) -> bool {
    // Keep unreadable files, so that their errors are reported.
    head(path).is_none_or(|head| frontend::format(&head, FileId(0)).is_ok())
}

/// Returns whether a TOML file is a register table with a device, and not an overlay or a profile. Also returns `true`
/// for an unreadable file, so that its error is reported.
fn is_table_of_device(path: &Path) -> bool {
    head(path).is_none_or(|head| {
        let mut lines = head.text().lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
        let first = lines.next().unwrap_or_default();
        first.strip_prefix("lexibus").is_some_and(|rest| rest.trim_start().starts_with('='))
            && lines.any(|line| line.starts_with("[device]"))
    })
}

/// Reads the start of a file. Returns `None` if the file is unreadable.
fn head(path: &Path) -> Option<Source> {
    let mut head = Vec::new();
    let file = std::fs::File::open(path).ok()?;
    file.take(detect::LOOK_AHEAD as u64).read_to_end(&mut head).ok()?;
    Some(Source::new(path.to_string_lossy(), head))
}
