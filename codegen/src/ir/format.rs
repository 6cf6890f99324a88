//! Formats of device descriptions.

/// A format of description files that Lexibus reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Format {
    /// CANopen electronic data sheet (CiA 306).
    Eds,
    /// CANopen device configuration file (CiA 306).
    Dcf,
    /// CANopen device description or configuration in XML (CiA 311).
    Xdd,
    /// EtherCAT slave information (ETG.2000).
    Esi,
    /// PROFINET device description (GSDML).
    Gsdml,
    /// A register table of Lexibus.
    Table,
}

impl Format {
    /// All formats, including register tables.
    pub const ALL: &'static [Format] =
        &[Format::Eds, Format::Dcf, Format::Xdd, Format::Esi, Format::Gsdml, Format::Table];

    /// Formats of vendor files: all except register tables.
    pub const OF_VENDORS: &'static [Format] = &[Format::Eds, Format::Dcf, Format::Xdd, Format::Esi, Format::Gsdml];

    /// A list that contains only the format of register tables.
    pub const TABLES: &'static [Format] = &[Format::Table];

    /// The format of overlays.
    pub const OF_OVERLAYS: Format = Format::Table;

    /// Returns the name of the format, as `lexibus info` prints it.
    pub fn name(self) -> &'static str {
        match self {
            Format::Eds => "eds",
            Format::Dcf => "dcf",
            Format::Xdd => "xdd",
            Format::Esi => "esi",
            Format::Gsdml => "gsdml",
            Format::Table => "table",
        }
    }

    /// Returns the cargo feature of `lexibus-codegen` that is needed to read files of the format. Register tables with messages
    /// also need the feature `messages`.
    pub fn feature(self) -> &'static str {
        match self {
            Format::Dcf => Format::Eds.name(),
            other => other.name(),
        }
    }

    /// Returns the file name extensions that only this format uses.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Format::Eds => &["eds"],
            Format::Dcf => &["dcf"],
            Format::Xdd => &["xdd", "xdc", "xpd"],
            Format::Esi | Format::Gsdml | Format::Table => &[],
        }
    }

    /// Returns two texts for the diagnostic about an object without sub-indices: the part that is missing, and the help.
    pub(crate) fn missing_subs(self) -> (&'static str, &'static str) {
        match self {
            Format::Eds | Format::Dcf => (
                "neither sub-indices nor CompactSubObj",
                "add SubNumber and the sections of the sub-indices, or add CompactSubObj",
            ),
            _ => (
                "no sub-indices",
                "describe the sub-indices, including sub-index 0, or use VAR if the object has a single value",
            ),
        }
    }

    /// Returns a help text about the notations of a default value in the elements DefaultData and DefaultValue of an ESI
    /// (ETG.2000). Returns `None` for other formats.
    pub(crate) fn default_forms(self, default: u8) -> Option<String> {
        let forms = || format!("write `{default:02X}` in DefaultData, or `{default}` in DefaultValue");
        (self == Format::Esi).then(forms)
    }

    /// Returns whether one element of the format can describe several items. Such elements are rows of register tables, data types
    /// of an ESI, and parameters of an XDD.
    pub fn has_shared_descriptions(self) -> bool {
        matches!(self, Format::Table | Format::Esi | Format::Xdd)
    }

    /// Returns whether files of the format describe devices on PROFINET. The items of such devices belong to submodules
    /// in slots.
    pub fn is_of_profinet(self) -> bool {
        self == Format::Gsdml
    }

    /// Returns whether files of the format are transcripts of manuals.
    pub fn is_of_manual(self) -> bool {
        self == Format::Table
    }
}
