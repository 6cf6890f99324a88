//! `lexibus docs`: writes a documentation site, or Markdown pages.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};

use lexibus_codegen::compile::Compilation;
use lexibus_codegen::output::write_if_changed;
use lexibus_site::{Format, Page, Site};

use super::args::{Docs, DocsFormat};
use super::docs_networks::Networks;
use super::files::{cannot_write, create_folder};
use super::output::difference;
use super::report::Reporter;
use super::{inputs, Failure};

pub(super) fn run(docs: &Docs) -> Result<bool, Failure> {
    let options = docs.inputs.options()?;
    let mut reporter = Reporter::new(&docs.inputs, false)?;
    let format = match docs.format {
        DocsFormat::Html => Format::Html,
        DocsFormat::Markdown => Format::Markdown,
    };
    if let Some(reason) = foreign(&docs.out, format) {
        reporter.error(&reason);
        return reporter.finish();
    }
    let mut files = inputs::sorted(&docs.inputs)?;
    if !docs.check {
        create_folder(&docs.out)?;
    }
    let mut site = Site::new(format);
    let networks = Networks::take(&mut files, &options.levels, &mut reporter)?;
    let names = Names::new(&files);
    // A single input needs no first pass, because the names of its folders in the site do not depend on other files.
    // Several inputs are compiled twice, so that not all compilations have to be kept in memory.
    if files.len() > 1 || !networks.is_empty() {
        inputs::compile_all(&files, &docs.inputs, &options, |input, compilation| {
            compilation.usable().into_iter().for_each(|catalog| site.announce(names.of(input), catalog));
            Ok(())
        })?;
        networks.announce(&mut site);
    }
    let mut written = HashSet::new();
    let mut put = |pages: &[Page], reporter: &mut Reporter| {
        for page in pages {
            let path = docs.out.join(&page.path);
            written.insert(path.clone());
            let error = if docs.check {
                difference(&path, &page.text).map(|found| found.message)
            } else {
                write(&path, page).err()
            };
            if let Some(error) = error {
                reporter.error(&error);
            }
        }
    };
    inputs::compile_all(&files, &docs.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        put(&site.add_compilation(names.of(input), &compilation), &mut reporter);
        Ok(())
    })?;
    put(&networks.pages(&mut site), &mut reporter);
    let names = Names::new(&docs.compare);
    for pair in pairs(&docs.compare)? {
        let compilations = pair.map(|path| inputs::compile_file(path, &options));
        let [Some(old), Some(new)] = compilations.each_ref().map(Compilation::usable) else {
            compilations.iter().try_for_each(|compilation| reporter.report(compilation))?;
            continue;
        };
        let [old_name, new_name] = pair.map(|path| names.of(path));
        put(&[site.compare((old_name, old), (new_name, new))], &mut reporter);
    }
    put(&site.finish(), &mut reporter);
    // After an error, keep the pages of earlier runs: they may be missing from this run only because of the error.
    let stale = if reporter.has_errors() { Vec::new() } else { stale(&docs.out, &written) };
    for path in stale {
        let error = match docs.check {
            true => Some(format!("{} is not part of this documentation any more", path.display())),
            false => remove(&docs.out, &path).err(),
        };
        error.iter().for_each(|error| reporter.error(error));
    }
    reporter.finish()
}

/// Maximum number of comparisons.
const MAX_COMPARISONS: usize = 20;

/// Returns the pairs of descriptions to compare.
fn pairs(paths: &[PathBuf]) -> Result<impl Iterator<Item = [&Path; 2]>, Failure> {
    if paths.len() > 2 * MAX_COMPARISONS {
        return Err(Failure::Usage(format!("--compare can be given up to {MAX_COMPARISONS} times")));
    }
    Ok(paths.chunks(2).filter_map(|pair| match pair {
        [old, new] => Some([old.as_path(), new.as_path()]),
        _ => None,
    }))
}

/// The names of the descriptions: the file name without its extension, or the whole path if several files have the same
/// name without extension.
struct Names(HashMap<PathBuf, String>);

impl Names {
    fn new(files: &[PathBuf]) -> Self {
        let stem = |path: &Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let files: BTreeSet<&PathBuf> = files.iter().collect();
        let mut counts: HashMap<String, usize> = HashMap::new();
        files.iter().for_each(|path| *counts.entry(stem(path)).or_default() += 1);
        let name = |path: &PathBuf| match counts[&stem(path)] {
            1 => stem(path),
            _ => path.display().to_string(),
        };
        Names(files.into_iter().map(|path| (path.clone(), name(path))).collect())
    }

    fn of(&self, path: &Path) -> &str {
        self.0.get(path).map_or("", String::as_str)
    }
}

/// Files that exist only in the main folder of a site.
const FILES_OF_SITES: [&str; 2] = ["site.js", "SUMMARY.md"];

/// Returns the pages in `folder` and its subfolders that an earlier run wrote and this run did not write, sorted by
/// path. Links, hidden folders, and folders with another site are left out.
fn stale(folder: &Path, written: &HashSet<PathBuf>) -> Vec<PathBuf> {
    let mut stale = Vec::new();
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    for path in entries {
        // Do not follow links, which can lead out of the folder.
        let is_link = path.symlink_metadata().is_ok_and(|data| data.is_symlink());
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        if path.is_dir() && !is_link {
            let is_site = FILES_OF_SITES.iter().any(|name| path.join(name).exists());
            if !is_hidden && !is_site {
                stale.extend(self::stale(&path, written));
            }
        } else if !is_link && !written.contains(&path) && was_written(&path) {
            stale.push(path);
        }
    }
    stale.sort();
    stale
}

/// Returns whether `lexibus docs` wrote the file at `path`.
fn was_written(path: &Path) -> bool {
    let page = Page { path: path.to_string_lossy().into_owned(), text: String::new() };
    std::fs::read(path).is_ok_and(|bytes| page.replaces(&String::from_utf8_lossy(&bytes)))
}

/// Removes a page, and then each folder between the page and `root` that has become empty.
fn remove(root: &Path, path: &Path) -> Result<(), String> {
    std::fs::remove_file(path).map_err(|error| format!("cannot remove {}: {error}", path.display()))?;
    for folder in path.ancestors().skip(1).take_while(|folder| *folder != root) {
        // Only an empty folder can be removed.
        if std::fs::remove_dir(folder).is_err() {
            break;
        }
    }
    Ok(())
}

/// Returns an error if the folder contains files, unless one of them is the first page of a site that `lexibus docs`
/// wrote. Hidden files do not count.
fn foreign(folder: &Path, format: Format) -> Option<String> {
    let names = std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.file_name()));
    let first = names.filter(|name| !name.as_encoded_bytes().starts_with(b".")).min()?;
    let page = Page { path: format.first_page(), text: String::new() };
    let path = folder.join(&page.path);
    match std::fs::read(&path) {
        Ok(bytes) if page.replaces(&String::from_utf8_lossy(&bytes)) => None,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Some(format!(
            "{} has files that `lexibus docs` did not write, such as {}: choose an empty folder with --out",
            folder.display(),
            Path::new(&first).display()
        )),
        _ => Some(not_overwritten(&path)),
    }
}

/// Returns the error for a file that `lexibus docs` must not overwrite.
fn not_overwritten(path: &Path) -> String {
    let reason = "exists and was not written by `lexibus docs`: choose an empty folder with --out";
    format!("{} {reason}", path.display())
}

/// Writes a page. Does not overwrite files that `lexibus docs` did not write.
fn write(path: &Path, page: &Page) -> Result<(), String> {
    let is_foreign = match std::fs::read(path) {
        Ok(bytes) => !page.replaces(&String::from_utf8_lossy(&bytes)),
        // Do not overwrite folders or unreadable files either.
        Err(error) => error.kind() != std::io::ErrorKind::NotFound,
    };
    if is_foreign {
        return Err(not_overwritten(path));
    }
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| write_if_changed(path, &page.text)).map_err(|error| cannot_write(path, &error))
}
