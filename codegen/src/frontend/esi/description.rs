//! What was read of a description, and what it leaves to other files.

use std::collections::HashSet;

use crate::frontend::xml::Given;
use crate::ir::{Catalog, CodeTable, PdoEntry};
use crate::source::Span;

/// What was read, and the files that it refers to.
#[derive(Default)]
pub(super) struct Description {
    pub catalog: Catalog,
    pub references: Vec<(Owner, Reference)>,
    /// Types of entries that may be in those files.
    pub entry_types: Vec<(Owner, EntryType)>,
    /// Those to whom such a file was not copied.
    pub refused: HashSet<Owner>,
}

impl Description {
    /// Notes what a device or module leaves to other files.
    pub fn leave(&mut self, owner: Owner, elsewhere: Elsewhere) {
        self.references.extend(elsewhere.files.into_iter().map(|file| (owner, file)));
        self.catalog.code_tables.extend(elsewhere.messages);
        self.entry_types.extend(elsewhere.types.into_iter().map(|ty| (owner, ty)));
    }
}

/// What a file is expected to contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Target {
    /// Devices or modules (InfoReference).
    Info,
    /// Data types and objects (DictionaryFile).
    Dictionary,
    /// Messages (DiagFile).
    Diagnosis,
}

/// To what the content of a file belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Owner {
    Catalog,
    Device(usize),
    Module(usize),
}

/// A file that the description refers to.
#[derive(Clone, Debug)]
pub(super) struct Reference {
    pub name: String,
    pub span: Span,
    pub target: Target,
}

impl Reference {
    pub fn new(given: &Given<'_>, target: Target) -> Self {
        Reference { name: given.text.to_string(), span: given.span, target }
    }
}

/// What a device or module leaves to other files.
#[derive(Default)]
pub(super) struct Elsewhere {
    pub files: Vec<Reference>,
    pub types: Vec<EntryType>,
    /// Messages of a module, which are those of all.
    pub messages: Vec<CodeTable>,
}

/// The type of an entry of a PDO that the dictionary of its device does not have.
#[derive(Debug)]
pub(super) struct EntryType {
    /// Span of the entry.
    pub entry: Span,
    /// The name of the type.
    pub name: Given<'static>,
}

impl EntryType {
    pub fn new(entry: &PdoEntry, given: &Given<'_>) -> Self {
        EntryType { entry: entry.origin.span, name: Given { text: given.text.to_string().into(), span: given.span } }
    }
}
