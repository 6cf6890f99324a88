//! `lexibus docs`: a site of documentation, or pages of Markdown.

use std::path::Path;

use lexibus_codegen::backend::docs::{Format, Page, Site};
use lexibus_codegen::builder::write_if_changed;

use super::args::{Docs, DocsFormat};
use super::output::difference;
use super::report::Reporter;
use super::{inputs, Failure};

pub(super) fn run(docs: &Docs) -> Result<bool, Failure> {
    let options = docs.inputs.options()?;
    let mut reporter = Reporter::new(&docs.inputs, false);
    let mut site = Site::new(match docs.format {
        DocsFormat::Html => Format::Html,
        DocsFormat::Markdown => Format::Markdown,
    });
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

/// Writes a page. A file that somebody else wrote is left alone.
fn write(path: &Path, page: &Page) -> Result<(), String> {
    let is_foreign = match std::fs::read(path) {
        Ok(bytes) => !page.replaces(&String::from_utf8_lossy(&bytes)),
        // A folder, for instance; the same holds for a file that nobody may read.
        Err(error) => error.kind() != std::io::ErrorKind::NotFound,
    };
    if is_foreign {
        return Err(format!(
            "{} is there already and was not written by `lexibus docs`: choose a folder of its own with --out",
            path.display()
        ));
    }
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder
        .and_then(|()| write_if_changed(path, &page.text))
        .map_err(|error| format!("can't write {}: {error}", path.display()))
}
