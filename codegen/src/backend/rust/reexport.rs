//! Definitions that a device re-exports from the runtime, or from an earlier device of the same file.

/// A Rust module in a device's module that contains one kind of definitions.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Section {
    Types,
    Codes,
    Objects,
    Pdo,
    View,
    Image,
}

impl Section {
    /// Returns the name of the Rust module.
    pub const fn name(self) -> &'static str {
        match self {
            Section::Types => "types",
            Section::Codes => "codes",
            Section::Objects => "objects",
            Section::Pdo => "pdo",
            Section::View => "view",
            Section::Image => "image",
        }
    }
}

/// The code that contains a definition.
#[derive(Clone, PartialEq, Eq)]
pub(super) enum Home {
    /// The runtime crate.
    Runtime,
    /// The Rust module of an earlier device. The field is the name of the module.
    Module(String),
}

/// Definitions that a device re-exports in one section.
pub(super) struct Reexport {
    pub section: Section,
    pub home: Home,
    pub names: Vec<String>,
    /// Documentation that precedes the documentation of the definition. The text is empty if there are several definitions,
    /// or if no item uses the definition.
    pub docs: String,
}

/// Adds the re-export of one definition. Definitions without additional documentation are re-exported together.
pub(super) fn add(reexports: &mut Vec<Reexport>, section: Section, home: &Home, name: &str, docs: String) {
    let is_same = |other: &&mut Reexport| {
        docs.is_empty() && other.docs.is_empty() && other.section == section && other.home == *home
    };
    match reexports.iter_mut().find(is_same) {
        Some(reexport) => reexport.names.push(name.to_owned()),
        None => reexports.push(Reexport { section, home: home.clone(), names: vec![name.to_owned()], docs }),
    }
}
