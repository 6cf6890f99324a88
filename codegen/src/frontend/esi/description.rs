//! Contents of a device description, and its references to other files.

use crate::collections::HashSet;
use crate::frontend::xml::Given;
use crate::ir::{Catalog, CodeTable, PdoEntry};
use crate::source::Span;

/// Contents of a device description, and the files that it refers to.
#[derive(Default)]
pub(super) struct Description {
    pub catalog: Catalog,
    pub references: Vec<(Owner, Reference)>,
    /// Types of PDO entries. The definitions of these types may be in the referenced files.
    pub entry_types: Vec<(Owner, EntryType)>,
    /// Devices and modules to which a referenced file was not copied because of the size limit.
    pub refused: HashSet<Owner>,
}

impl Description {
    /// Adds the references, unresolved types of PDO entries and diagnosis messages of a device or module.
    pub fn add_other_files(&mut self, owner: Owner, other_files: OtherFiles) {
        self.references.extend(other_files.files.into_iter().map(|file| (owner, file)));
        self.catalog.code_tables.extend(other_files.messages);
        self.entry_types.extend(other_files.types.into_iter().map(|ty| (owner, ty)));
    }
}

/// Expected content of a referenced file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Target {
    /// Devices or modules (element `InfoReference`).
    Info,
    /// Data types and objects (element `DictionaryFile`).
    Dictionary,
    /// Diagnosis messages (element `DiagFile`).
    Diagnosis,
}

/// Element to which the content of a referenced file is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Owner {
    Catalog,
    Device(usize),
    Module(usize),
}

/// Reference to another file, and the content that is expected in this file.
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

/// References of a device or module to other files, types of PDO entries that these files may define, and diagnosis
/// messages.
#[derive(Default)]
pub(super) struct OtherFiles {
    pub files: Vec<Reference>,
    pub types: Vec<EntryType>,
    /// Diagnosis messages that a module declares. In the IR, these messages belong to the catalog.
    pub messages: Vec<CodeTable>,
}

/// Type of a PDO entry, if the dictionary of the device or module does not define this type.
#[derive(Debug)]
pub(super) struct EntryType {
    /// Span of the PDO entry.
    pub entry: Span,
    /// Type name of the PDO entry.
    pub name: Given<'static>,
}

impl EntryType {
    pub fn new(entry: &PdoEntry, given: &Given<'_>) -> Self {
        EntryType { entry: entry.origin.span, name: Given { text: given.text.to_string().into(), span: given.span } }
    }
}
