//! The pipeline: source → syntax → IR → passes → output. The three entry points (build script, macro, command line) all end here.

use std::path::PathBuf;

use crate::backend::rust::{self, RustOptions};
use crate::check as lints;
use crate::diagnostics::{Diagnostic, Diagnostics, Levels};
use crate::frontend;
use crate::ir::{Catalog, FileInfo, Format};
use crate::profiles;
use crate::resolve;
use crate::selection::Selection;
use crate::source::{FileId, Source};

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Lenient or strict, and the level of each code.
    pub levels: Levels,
    /// Further names of `$NODEID` in formulas, such as `$MY_NODE_ID`.
    pub node_id_aliases: Vec<String>,
    /// The choices of a register table's options, by the option's name.
    pub choices: Vec<(String, String)>,
    /// What of the description is wanted.
    pub select: Selection,
    /// Tables that correct the description and add to it, in the order in which they are applied.
    pub overlays: Vec<Source>,
    /// Whether profiles add nothing to the objects of the devices that follow them.
    pub no_profiles: bool,
    /// What the generated Rust looks like.
    pub rust: RustOptions,
}

/// The outcome of a compilation, or of a part of it.
#[derive(Debug)]
pub struct Compilation {
    /// The files that were read; spans refer to them.
    pub sources: Vec<Source>,
    /// What they describe; `None` where they couldn't be used at all.
    pub catalog: Option<Catalog>,
    /// What there is to say about them, from top to bottom.
    pub diagnostics: Diagnostics,
    /// The format, where it was recognised.
    pub format: Option<Format>,
    /// Files of the folder that the description refers to, and that aren't there.
    pub missing: Vec<PathBuf>,
}

impl Compilation {
    /// Creates the compilation of a file that is no description or can't be read: it has diagnostics and no catalog.
    pub fn of_diagnostics(source: Source, diagnostics: Diagnostics) -> Self {
        Compilation { sources: vec![source], catalog: None, diagnostics, format: None, missing: Vec::new() }
    }

    /// Whether output may be produced.
    pub fn is_usable(&self) -> bool {
        self.catalog.is_some() && !self.diagnostics.has_errors()
    }

    /// `file:line:column: message [EDS020]`: a finding of this compilation on one line, for tools that want one.
    pub fn one_line(&self, diagnostic: &Diagnostic) -> String {
        let mut text = String::new();
        if let Some(source) = self.sources.get(diagnostic.span.file.0 as usize) {
            text += source.name();
            if !diagnostic.span.is_empty() {
                let at = source.position(diagnostic.span.start);
                text += &format!(":{}:{}", at.line, at.column);
            }
            text += ": ";
        }
        text += &format!("{} [{}]", diagnostic.message, diagnostic.code.id);
        text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
    }

    /// The Rust module of what was read, or `None` where there are errors.
    pub fn rust(&self, options: &RustOptions) -> Option<String> {
        if !self.is_usable() {
            return None;
        }
        rust::emit_catalog(self.catalog.as_ref()?, options)
    }
}

/// The choice of an option as the entry points take it: `NAME=CHOICE`.
pub fn choice(text: &str) -> Option<(String, String)> {
    let (name, choice) = text.split_once('=')?;
    let (name, choice) = (name.trim(), choice.trim());
    (!name.is_empty() && !choice.is_empty()).then(|| (name.to_owned(), choice.to_owned()))
}

/// What to say of a usable compilation whose [`Compilation::rust`] is `None`.
pub const NOTHING_TO_GENERATE: &str = "it describes no device and no module, so there is nothing to generate";

/// Reads `source` into the IR, as it stands.
pub fn read(source: Source, options: &Options) -> Compilation {
    let mut diagnostics = Diagnostics::new(options.levels.clone());
    let frontend::Description { format, catalog, mut others, missing } =
        frontend::read(&source, &options.node_id_aliases, &options.choices, &mut diagnostics);
    let mut sources = vec![source];
    sources.append(&mut others);
    let catalog = catalog.zip(format).map(|(mut catalog, format)| {
        catalog.files = sources.iter().map(|source| file_info(source, format)).collect();
        catalog
    });
    Compilation { sources, catalog, diagnostics, format, missing }
}

fn file_info(source: &Source, format: Format) -> FileInfo {
    FileInfo { name: source.name().to_owned(), format, encoding: source.encoding(), sha256: source.digest() }
}

/// Reads `source` and checks it: the IR that every back end starts from.
pub fn check(source: Source, options: &Options) -> Compilation {
    checked(read(source, options), options)
}

/// Selects, corrects, completes and checks what was read: the part of [`check`] that is the same for every front end, also
/// for one that isn't in this crate.
pub fn checked(mut compilation: Compilation, options: &Options) -> Compilation {
    if let Some(catalog) = &mut compilation.catalog {
        options.select.devices_and_modules(catalog, &mut compilation.diagnostics);
        for source in &options.overlays {
            let file = FileId(compilation.sources.len() as u32);
            frontend::apply_overlay(source, file, catalog, &mut compilation.diagnostics);
            catalog.files.push(file_info(source, Format::Table));
            compilation.sources.push(source.clone());
        }
        resolve::resolve(catalog, &mut compilation.diagnostics);
        lints::check(catalog, &mut compilation.diagnostics);
        if !options.no_profiles {
            profiles::apply(catalog);
        }
        options.select.objects(catalog, &mut compilation.diagnostics);
        resolve::resolve_references(catalog);
    }
    // One row of a table stands for several items, and so does a type or parameter of XML: they share what is wrong with it.
    let described_by = compilation.catalog.as_ref().and_then(|catalog| catalog.files.first());
    if described_by.is_some_and(|file| file.format.has_shared_descriptions()) {
        compilation.diagnostics.forget_repeated(0);
    }
    compilation.diagnostics.sort();
    compilation
}
