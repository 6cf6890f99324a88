//! Definitions that a device re-exports from an earlier device of the same file.

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

/// Definitions that a device re-exports in one section.
pub(super) struct Reexport {
    pub section: Section,
    /// Module name of the earlier device that contains the definitions.
    pub home: String,
    pub names: Vec<String>,
}
