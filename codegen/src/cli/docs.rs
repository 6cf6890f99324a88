//! `lexibus docs`: a site of documentation.

use std::path::Path;

use super::args::Docs;
use super::inputs;
use super::report::Reporter;
use super::Failure;
use crate::backend::docs::{Page, Site};
use crate::builder::write_if_changed;

pub(super) fn run(docs: &Docs) -> Result<bool, Failure> {
    let options = docs.inputs.options()?;
    let mut reporter = Reporter::new(&docs.inputs, false);
    let mut site = Site::default();
    inputs::each(&docs.inputs, &options, |input, compilation| {
        reporter.report(&compilation)?;
        if let Some(catalog) = compilation.catalog.as_ref().filter(|_| compilation.is_usable()) {
            let stem = input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
            write(&docs.out, &site.add(&stem, catalog), &mut reporter);
        }
        Ok(())
    })?;
    write(&docs.out, &site.finish(), &mut reporter);
    reporter.finish()
}

fn write(out: &Path, pages: &[Page], reporter: &mut Reporter) {
    for page in pages {
        let path = out.join(&page.path);
        let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        if let Err(error) = folder.and_then(|()| write_if_changed(&path, &page.text)) {
            reporter.error(&format!("can't write {}: {error}", path.display()));
            return;
        }
    }
}
