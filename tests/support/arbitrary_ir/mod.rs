//! Random catalogs that are created from bytes. The catalogs use all features of the IR, and their names conflict as
//! often as possible.
//!
//! Two crates use this module: the test of generated code, and the fuzz target `ir`.

pub mod bytes;
mod devices;
mod facts;
mod items;
mod machines;
mod messages;
mod names;
mod process;
mod profinet;
mod settings;
mod types;
mod values;

use lexibus_codegen::compile::{checked, Compilation, Options};
use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::{Catalog, FileInfo, Format};
use lexibus_codegen::source::Source;

use bytes::Bytes;

/// Returns a catalog in the form that a front end creates, before all checks.
pub fn catalog(b: &mut Bytes<'_>) -> Catalog {
    const FORMATS: [Format; 10] = [
        Format::Table,
        Format::Table,
        Format::Table,
        Format::Table,
        Format::Eds,
        Format::Dcf,
        Format::Xdd,
        Format::Esi,
        Format::Esi,
        Format::Gsdml,
    ];
    let format = b.pick(&FORMATS);
    let mut catalog = match format {
        Format::Gsdml => profinet::catalog(b),
        _ => devices::catalog(b, format),
    };
    let source = Source::new("arbitrary", Vec::new());
    let name = format!("{}.{}", names::name(b), format.name());
    let (encoding, sha256) = (source.encoding(), source.digest());
    catalog.files.push(FileInfo { name, format, encoding, sha256 });
    catalog
}

/// Returns a compilation of a random catalog after all passes.
pub fn compilation(bytes: &[u8], options: &Options) -> Compilation {
    let catalog = catalog(&mut Bytes::new(bytes));
    let format = catalog.files.first().map(|file| file.format);
    let read = Compilation {
        sources: vec![Source::new("arbitrary", Vec::new())],
        catalog: Some(catalog),
        diagnostics: Diagnostics::new(options.levels.clone()),
        format,
        missing: Vec::new(),
    };
    checked(read, options)
}
