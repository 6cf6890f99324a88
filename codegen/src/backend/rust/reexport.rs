//! Definitions that a device has from an earlier one of the same file.

/// A module of a device that has definitions.
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
    /// The name of the module.
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

/// Definitions of a section that an earlier device has.
pub(super) struct Reexport {
    pub section: Section,
    /// The module of the earlier device.
    pub home: String,
    pub names: Vec<String>,
}
