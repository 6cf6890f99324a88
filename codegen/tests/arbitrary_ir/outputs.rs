//! All that is made of a compilation.

use lexibus_codegen::backend::docs::{Format, Site};
use lexibus_codegen::backend::{eds, esi, gsdml, json};
use lexibus_codegen::compile::Compilation;

/// Runs every back end but that of Rust: files, pages and lists, as many as there are. An export that lacks a fact is none.
pub fn others(compilation: &Compilation) -> usize {
    json::info(compilation);
    let mut made = 0;
    for format in [Format::Html, Format::Markdown] {
        let mut site = Site::new(format);
        made += site.add_compilation("arbitrary", compilation).len() + site.finish().len();
    }
    let Some(catalog) = &compilation.catalog else { return made };
    made += usize::from(!json::dump(catalog).is_empty());
    for flavour in [eds::Flavour::Eds, eds::Flavour::Dcf] {
        made += catalog.devices.iter().filter_map(|device| eds::export(catalog, device, flavour)).count();
    }
    made += usize::from(esi::export(catalog, &Default::default()).is_ok());
    made + usize::from(gsdml::export(catalog, &Default::default()).is_ok())
}
