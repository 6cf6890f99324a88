//! The top of the IR: a catalogue, the files it came from, and what every element shares.

use thin_vec::ThinVec;

use super::{
    CodeTable, CompactString, Device, FactOrigin, Family, Format, Graphic, Module, ModuleId, ModuleUse, Places,
    Submodule, Texts, TypeDef, UnitDiagnosis,
};
use crate::source::{Digest, Encoding, Origin, Span};

/// The devices of one vendor, as one or more files describe them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Catalog {
    /// The files that were read; spans refer to them by position.
    pub files: Vec<FileInfo>,
    /// The devices, in the order of the source. A device access point of GSDML is a device.
    pub devices: Vec<Device>,
    /// Modules that can be plugged into them.
    pub modules: Vec<Module>,
    /// Submodules of PROFINET modules and device access points.
    pub submodules: Vec<Submodule>,
    /// Types that items of submodules name. (Those of devices and modules are their own.)
    pub types: Vec<TypeDef>,
    /// Codes that all devices share: channel diagnosis, log book.
    pub code_tables: Vec<CodeTable>,
    /// User structures of PROFINET diagnosis.
    pub unit_diagnoses: Vec<UnitDiagnosis>,
    /// Families that devices and modules belong to.
    pub families: Vec<Family>,
    /// Pictures that devices and modules refer to.
    pub graphics: Vec<Graphic>,
    /// What the source says beyond that.
    pub extensions: Extensions,
}

impl Catalog {
    /// A catalogue of one device with modules of its own.
    pub fn of_device(mut device: Device, modules: Vec<Module>) -> Self {
        let places = (0..modules.len()).map(|position| ModuleId(position as u32));
        device.modules.extend(places.map(|module| ModuleUse { module, places: Places::default() }));
        Catalog { devices: vec![device], modules, ..Catalog::default() }
    }

    /// Whether it describes devices and submodules of PROFINET.
    pub fn is_of_profinet(&self) -> bool {
        !self.submodules.is_empty() || self.devices.iter().any(|device| device.profinet.is_some())
    }
}

/// One file of a catalogue.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FileInfo {
    /// Its name, as the caller gave it.
    pub name: String,
    /// Its format.
    pub format: Format,
    /// How its bytes were decoded.
    pub encoding: Encoding,
    /// SHA-256 of its bytes.
    pub sha256: Digest,
}

/// A text in one language.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LocalText {
    /// BCP 47 tag (`en`, `de-DE`), or the source's own number of the language (`lcid:1033`).
    pub language: CompactString,
    /// The text.
    pub text: CompactString,
}

/// A name with its value that the source has and the IR has no field for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extension {
    /// The key, element or attribute, as the source spells it. A comment with content is kept under `;`. Those of a whole
    /// EDS have the name of their section before them: `FileInfo/Author`, `Vendor stuff/;`.
    pub key: CompactString,
    /// Its value.
    pub value: CompactString,
    /// Where it stands.
    pub span: Span,
}

/// Most elements have none, so that an empty list takes one pointer.
pub type Extensions = ThinVec<Extension>;

/// Most elements have none, so that an empty list takes one pointer.
pub type Doubts = ThinVec<Doubt>;

/// A place where the source contradicts itself or leaves something open, and what was made of it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Doubt {
    /// What the source says, the contradicting statements side by side.
    pub says: String,
    /// What was chosen.
    pub chosen: String,
    /// Why.
    pub why: String,
    /// Where the source says it: file position, and for a manual also its page or line in `cite`.
    pub origin: Origin,
    /// Page, line or clause of a manual.
    pub cite: Option<CompactString>,
    /// What a wrong choice leads to.
    #[cfg_attr(feature = "serde", serde(default))]
    pub severity: Severity,
    /// What it is about, if that has no list of doubts of its own.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub subject: Option<Box<Subject>>,
}

/// What a doubt of a device is about.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Subject {
    /// Its kind.
    pub kind: SubjectKind,
    /// Its name.
    pub name: CompactString,
    /// The row, bit, value or code within it; empty if the whole is meant.
    pub element: CompactString,
}

/// The kinds of elements that a doubt of a device is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SubjectKind {
    /// Bits or values: a definition of a type.
    Type,
    /// A table of codes.
    Codes,
    /// A state machine, its commands or their outcomes.
    Machine,
    /// A sequence of steps.
    Procedure,
    /// A process image.
    Image,
    /// A number that is split over several items.
    Composite,
    /// A model of the family.
    Model,
    /// A choice that the manual leaves open.
    Option,
}

impl Doubt {
    /// Whether the doubt is about the element of this kind and name.
    pub fn is_about(&self, kind: SubjectKind, name: &str) -> bool {
        self.subject.as_ref().is_some_and(|subject| subject.kind == kind && subject.name == name)
    }
}

/// What a wrong choice in an ambiguity of the source leads to, the worst first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Severity {
    /// A motor moves or wiring is damaged.
    Hazard,
    /// A value is wrong: a unit, a limit, a default, an address.
    #[default]
    Value,
    /// Nothing: the source has a misprint that the rest of it corrects.
    Print,
}

impl Severity {
    /// The word of register tables.
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
    /// Its title.
    pub title: CompactString,
    /// Its edition.
    pub edition: CompactString,
    /// Its language (BCP 47), where it isn't the one of the description.
    pub language: CompactString,
    /// What the numbers of citations count.
    pub counts: Option<CiteUnit>,
    /// What it is, and what of it was left out.
    pub documentation: String,
    /// Its sections and tables, by the number of their first page or line, ascending.
    pub sections: Vec<ManualSection>,
}

/// What the numbers of citations count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum CiteUnit {
    /// Pages.
    Page,
    /// Lines of the manual as text.
    Line,
}

/// A section or table of a manual.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ManualSection {
    /// The page or line of its title.
    pub start: u32,
    /// The title as printed.
    pub title: CompactString,
}

impl Manual {
    /// The section that a page or line is in: the last one that begins at or before it.
    pub fn section(&self, number: u32) -> Option<&ManualSection> {
        let behind = self.sections.partition_point(|section| section.start <= number);
        self.sections.get(behind.checked_sub(1)?)
    }
}

/// What a source or a manual says about an element in words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Documentation {
    /// A description in English, or in the source's only language.
    pub text: String,
    /// The same in other languages.
    pub translations: Texts,
    /// Page, line or clause of the manual that the element was taken from.
    pub cite: Option<CompactString>,
    /// Where the text comes from, unless from the source itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub text_from: Option<Box<FactOrigin>>,
}
