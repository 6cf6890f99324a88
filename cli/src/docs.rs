//! `lexibus docs`: writes a documentation site, or Markdown pages.

use std::path::Path;

use lexibus_codegen::output::write_if_changed;
use lexibus_site::{Format, Page, Site};

use super::args::{Docs, DocsFormat};
use super::output::difference;
use super::report::Reporter;
use super::{inputs, Failure};

pub(super) fn run(docs: &Docs) -> Result<bool, Failure> {
    let options = docs.inputs.options()?;
    let mut reporter = Reporter::new(&docs.inputs, false);
    let format = match docs.format {
        DocsFormat::Html => Format::Html,
        DocsFormat::Markdown => Format::Markdown,
    };
    if let Some(reason) = foreign(&docs.out, format) {
        reporter.error(&reason);
        return reporter.finish();
    }
    let mut site = Site::new(format);
    let put = |pages: &[Page], reporter: &mut Reporter| {
        for page in pages {
            let path = docs.out.join(&page.path);
            let error = if docs.check { difference(&path, &page.text) } else { write(&path, page).err() };
            if let Some(error) = error {
                reporter.error(&error);
            }
        }
    };
    inputs::each_by_path(&docs.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        put(&site.add_compilation(&stem, &compilation), &mut reporter);
        Ok(())
    })?;
    put(&site.finish(), &mut reporter);
    reporter.finish()
}

/// Returns an error if the folder contains files, unless one of them is the first page of a site that `lexibus docs` wrote.
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
    folder
        .and_then(|()| write_if_changed(path, &page.text))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))
}
