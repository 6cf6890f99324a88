//! The pipeline: source → syntax → front end → resolve → check → output. The build script, the macro and the command
//! line use this pipeline.

use std::path::PathBuf;

use crate::backend::rust::{self, RustOptions};
use crate::check as lints;
use crate::diagnostics::{Diagnostic, Diagnostics, Levels};
use crate::frontend;
use crate::ir::{Catalog, FileInfo, Format};
use crate::resolve::{self, Changes, Profiles};
use crate::selection::Selection;
use crate::source::{FileId, Source};

/// Options of a compilation.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Lenient or strict mode, and levels of diagnostic codes.
    pub levels: Levels,
    /// Further names for `$NODEID` in formulas, such as `$MY_NODE_ID`.
    pub node_id_aliases: Vec<String>,
    /// Names of register-table options, and the choice for each.
    pub choices: Vec<(String, String)>,
    /// Filters that select devices, modules and objects.
    pub select: Selection,
    /// Overlays in the order in which they are applied.
    pub overlays: Vec<Source>,
    /// True if profiles are not applied.
    pub no_profiles: bool,
    /// Options of the generated Rust code.
    pub rust: RustOptions,
}

/// The result of a compilation, or of its first stages.
#[derive(Debug)]
pub struct Compilation {
    /// Source files that were read. A span refers to a file by its position in this list.
    pub sources: Vec<Source>,
    /// IR of the source files; `None` if the source files cannot be used.
    pub catalog: Option<Catalog>,
    /// Diagnostics. After [`check`], they are sorted by position.
    pub diagnostics: Diagnostics,
    /// Format of the description, if the compiler recognized it.
    pub format: Option<Format>,
    /// Files to which the description refers, but which do not exist. Each path is in the folder of the description or below it.
    pub missing: Vec<PathBuf>,
}

impl Compilation {
    /// Creates the compilation of a file that cannot be read or is not a description. The compilation has diagnostics, but no
    /// catalog.
    pub fn of_diagnostics(source: Source, diagnostics: Diagnostics) -> Self {
        Compilation { sources: vec![source], catalog: None, diagnostics, format: None, missing: Vec::new() }
    }

    /// Returns whether the compilation can produce output.
    pub fn is_usable(&self) -> bool {
        self.catalog.is_some() && !self.diagnostics.has_errors()
    }

    /// Returns the catalog, or `None` if the compilation cannot produce output.
    pub fn usable(&self) -> Option<&Catalog> {
        self.catalog.as_ref().filter(|_| self.is_usable())
    }

    /// Returns a diagnostic of this compilation on one line: `file:line:column: message [EDS020]`.
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

    /// Returns the generated Rust module, or `None` if there are errors or nothing to generate.
    pub fn rust(&self, options: &RustOptions) -> Option<String> {
        rust::emit_catalog(self.usable()?, options)
    }

    /// Returns the catalog, or `None` if the compilation cannot produce output. Drops the text of the source files, which only
    /// diagnostics need, and computes the SHA-256 of these files before.
    pub fn into_usable(self) -> Option<Catalog> {
        let mut catalog = self.is_usable().then_some(self.catalog).flatten()?;
        catalog.files.iter_mut().for_each(|file| file.sha256.detach());
        Some(catalog)
    }
}

/// Parses the choice for an option of a register table in the form `NAME=CHOICE`. Returns `None` if the name or the
/// choice is missing.
pub fn choice(text: &str) -> Option<(String, String)> {
    let (name, choice) = text.split_once('=')?;
    let (name, choice) = (name.trim(), choice.trim());
    (!name.is_empty() && !choice.is_empty()).then(|| (name.to_owned(), choice.to_owned()))
}

/// Message for a usable compilation for which [`Compilation::rust`] returns `None`.
pub const NOTHING_TO_GENERATE: &str =
    "there is nothing to generate, because the file describes neither a device nor a module, or is a GSDML without an access point";

/// Reads `source` into the IR, without selection, overlays or checks.
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

/// Reads and checks `source`. The result is the input of all back ends.
pub fn check(source: Source, options: &Options) -> Compilation {
    checked(read(source, options), options)
}

/// Reads the overlays, resolves the IR, checks it, and selects objects. These are the stages of [`check`] after the front end of the
/// description. Use this function for a front end in another crate.
pub fn checked(mut compilation: Compilation, options: &Options) -> Compilation {
    let Compilation { sources, catalog, diagnostics, .. } = &mut compilation;
    if let Some(catalog) = catalog {
        let mut overlays = Vec::new();
        for source in &options.overlays {
            overlays.extend(frontend::read_overlay(source, FileId(sources.len() as u32), diagnostics));
            catalog.files.push(file_info(source, Format::OF_OVERLAYS));
            sources.push(source.clone());
        }
        let profiles = if options.no_profiles { Profiles::Ignored } else { Profiles::Applied };
        resolve::resolve(catalog, &Changes { selection: &options.select, overlays, profiles }, diagnostics);
        lints::check(catalog, diagnostics);
        resolve::select_objects(&options.select, catalog, diagnostics);
    }
    // A row of a register table can describe several items, and so can a type or parameter in XML. The diagnostics about such a
    // row or element are reported only once.
    let described_by = compilation.catalog.as_ref().and_then(|catalog| catalog.files.first());
    if described_by.is_some_and(|file| file.format.has_shared_descriptions()) {
        compilation.diagnostics.forget_repeated(|_| true);
    }
    compilation.diagnostics.sort();
    compilation
}
