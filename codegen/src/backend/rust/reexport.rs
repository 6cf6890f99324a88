//! Definitions that a device re-exports from an earlier device of the same file.

/// A module of a device that contains definitions.
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
    /// Returns the name of the module.
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

/// Definitions of a section that an earlier device contains.
pub(super) struct Reexport {
    pub section: Section,
    /// The module of the earlier device.
    pub home: String,
    pub names: Vec<String>,
}
