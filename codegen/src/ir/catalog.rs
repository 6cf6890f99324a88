//! The root of the IR: a catalog, its files, and types that several parts of the IR use.

use thin_vec::ThinVec;

use super::{
    CodeTable, CompactString, Device, FactOrigin, Family, Format, Graphic, Module, ModuleId, ModuleUse, SlotNumbers,
    Submodule, Texts, TypeDef, UnitDiagnosis,
};
use crate::source::{Digest, Encoding, Origin, Span};

/// The devices, modules and submodules of one vendor, read from one or more files.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Catalog {
    /// Files from which the catalog was read. A span refers to a file by its position in this list.
    pub files: Vec<FileInfo>,
    /// Devices, in the order of the description file. Each device access point of a GSDML file is a separate device.
    pub devices: Vec<Device>,
    /// Modules of all devices.
    pub modules: Vec<Module>,
    /// Submodules of PROFINET modules and device access points.
    pub submodules: Vec<Submodule>,
    /// Types of the submodules' items. Each device and module has a separate list of types.
    pub types: Vec<TypeDef>,
    /// Code tables that apply to all devices, such as channel diagnosis and log book entries.
    pub code_tables: Vec<CodeTable>,
    /// Layouts of vendor-specific PROFINET diagnosis (user structures).
    pub unit_diagnoses: Vec<UnitDiagnosis>,
    /// Families of devices and modules.
    pub families: Vec<Family>,
    /// Pictures that devices and modules refer to.
    pub graphics: Vec<Graphic>,
    /// Name of the vendor in other languages.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Texts::is_empty"))]
    pub vendor_names: Texts,
    /// Description of the device family in languages other than that of [`Header::description`](super::Header::description).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Texts::is_empty"))]
    pub descriptions: Texts,
    /// Internet addresses of the vendor.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub vendor_urls: Vec<CompactString>,
    /// Version of the format, if the file contains only diagnosis messages (EtherCATDiag of ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub format_version: CompactString,
    /// Header of the device profile (GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub profile_header: Option<Box<ProfileHeader>>,
    /// Texts to which no element refers (GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub unused_texts: Vec<UnusedText>,
    /// Facts about the catalog that have no field in the IR.
    pub extensions: Extensions,
}

impl Catalog {
    /// Creates a catalog of one device that accepts all `modules`.
    pub fn of_device(mut device: Device, modules: Vec<Module>) -> Self {
        let ids = (0..modules.len()).map(|position| ModuleId(position as u32));
        device.modules.extend(ids.map(|module| ModuleUse { module, places: SlotNumbers::default() }));
        Catalog { devices: vec![device], modules, ..Catalog::default() }
    }

    /// Returns whether the catalog contains PROFINET devices or submodules.
    pub fn is_of_profinet(&self) -> bool {
        !self.submodules.is_empty() || self.devices.iter().any(|device| device.profinet.is_some())
    }
}

/// A file from which a catalog was read.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FileInfo {
    /// File name that the caller passed.
    pub name: String,
    /// Format of the file.
    pub format: Format,
    /// Character encoding of the file.
    pub encoding: Encoding,
    /// SHA-256 of the file's bytes.
    pub sha256: Digest,
}

/// A text in one language.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LocalText {
    /// BCP 47 tag (`en`, `de-DE`), or the language number of the source (`lcid:1033`).
    pub language: CompactString,
    /// The text in this language.
    pub text: CompactString,
}

/// Header of a device profile (ISO 15745-1), with its texts unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ProfileHeader {
    /// Identification of the profile.
    pub identification: CompactString,
    /// Revision of the profile.
    pub revision: CompactString,
    /// Name of the profile.
    pub name: CompactString,
    /// Organization that publishes the profile.
    pub source: CompactString,
    /// Class of the profile.
    pub class: CompactString,
    /// Date of the profile.
    pub date: CompactString,
    /// Address of further information.
    pub additional_information: CompactString,
    /// Part of ISO 15745 that the file follows.
    pub iso_part: CompactString,
    /// Edition of this part.
    pub iso_edition: CompactString,
    /// Technology of the profile, such as `GSDML`.
    pub technology: CompactString,
}

/// A text to which no element refers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnusedText {
    /// Identifier of the text.
    pub id: CompactString,
    /// The text in the primary language; empty if it exists only in other languages.
    pub text: CompactString,
    /// The text in other languages.
    pub translations: Texts,
}

/// A key with a value, for a fact that has no field in the IR.
///
/// Nothing looks up an extension by its key: a fact that a consumer needs has a field. `dump` and `diff` show all extensions of an
/// element. An export either writes all of them, or reports their number in a note. An export to EDS or DCF writes each extension in
/// the section that its key names. An export to ESI writes those of an object as properties.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extension {
    /// Key, element or attribute as the source spells it. The key of a comment is `;`. Keys that concern a whole EDS begin with
    /// the name of their section: `FileInfo/Author`, `Vendor stuff/;`.
    pub key: CompactString,
    /// Value of the key.
    pub value: CompactString,
    /// Location of the extension in the source.
    pub span: Span,
}

/// Extensions of an element. An empty list has the size of one pointer.
pub type Extensions = ThinVec<Extension>;

/// Ambiguities of an element. An empty list has the size of one pointer.
pub type Doubts = ThinVec<Doubt>;

/// An ambiguity in the source, with the assumption that was made.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Doubt {
    /// The contradictory statements of the source, or the fact that the source lacks.
    pub says: String,
    /// The assumption that was made.
    pub chosen: String,
    /// Reason for the assumption.
    pub why: String,
    /// Location of the ambiguity in the source.
    pub origin: Origin,
    /// Page, line or clause of the manual that is ambiguous.
    pub cite: Option<CompactString>,
    /// Consequence of a wrong assumption.
    #[cfg_attr(feature = "serde", serde(default))]
    pub severity: Severity,
    /// Row, bit, value, command or option that the ambiguity is about; empty for the whole element.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub part: CompactString,
}

/// The consequence of a wrong assumption. The variants are sorted from the most serious to the mildest consequence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Severity {
    /// Unexpected motion, or damage to the wiring.
    Hazard,
    /// A wrong value, such as a unit, limit, default or address.
    #[default]
    Value,
    /// No consequence: the rest of the source corrects the misprint.
    Print,
}

impl Severity {
    /// Returns the name of the severity in register tables.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Hazard => "hazard",
            Severity::Value => "value",
            Severity::Print => "print",
        }
    }
}

/// The manual that a description was transcribed from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Manual {
    /// Title of the manual.
    pub title: CompactString,
    /// Edition of the manual, as printed.
    pub edition: CompactString,
    /// Language of the manual (BCP 47); empty = not given.
    pub language: CompactString,
    /// Unit of the numbers in citations: pages or lines.
    pub counts: Option<CiteUnit>,
    /// Description of the manual, and of the parts of the manual that the register table leaves out.
    pub documentation: String,
    /// Sections and tables of the manual, sorted by their first page or line.
    pub sections: Vec<ManualSection>,
}

/// The unit of the numbers in citations of a manual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum CiteUnit {
    /// Citations contain page numbers.
    Page,
    /// Citations contain line numbers of the manual's text.
    Line,
}

/// A section or table of a manual.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ManualSection {
    /// Page or line on which the section begins.
    pub start: u32,
    /// Title of the section as printed.
    pub title: CompactString,
}

impl Manual {
    /// Returns the section that contains a page or line: the last section that begins at or before it.
    pub fn section(&self, number: u32) -> Option<&ManualSection> {
        let after = self.sections.partition_point(|section| section.start <= number);
        self.sections.get(after.checked_sub(1)?)
    }
}

/// Description of an element, with its translations, citation and origin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Documentation {
    /// Description in English, or in another language if the source has no English description.
    pub text: Box<str>,
    /// Description in other languages.
    pub translations: Texts,
    /// Page, line or clause of the manual that describes the element.
    pub cite: Option<CompactString>,
    /// Origin of the description; `None` = the source itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub text_from: Option<Box<FactOrigin>>,
}

impl Documentation {
    /// Returns the description of an element. Returns an empty text if the element has no documentation.
    pub fn text_of(documentation: Option<&Documentation>) -> &str {
        documentation.map_or("", |documentation| &documentation.text)
    }
}
