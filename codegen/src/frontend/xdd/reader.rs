//! State of the XDD reader, and functions that read labels and descriptions.

use std::sync::Arc;

use compact_str::CompactString;

use crate::diagnostics::{codes, Code};
use crate::frontend::canopen::value::Converter;
use crate::frontend::xml::{self, Names, Read};
use crate::ir::Documentation;
use crate::syntax::xml::Tag;

pub(super) type Reader<'a, 'd> = xml::Reader<'a, 'd, Xdd<'d>>;

/// State of the XDD reader in addition to that of the XML reader.
pub(super) struct Xdd<'d> {
    /// Further names of the node-ID in formulas.
    pub aliases: &'d [String],
}

impl xml::Format for Xdd<'_> {
    const STANDARD: &'static str = "CiA 311";
    const UNKNOWN: &'static Code = &codes::UNKNOWN_ELEMENT;
    #[rustfmt::skip]
    const ELEMENTS: &'static [&'static str] = &[
        "ApplicationLayers", "ApplicationProcess", "CANopenGeneralFeatures", "CANopenMasterFeatures", "CANopenObject",
        "CANopenObjectList", "CANopenSubObject", "DeviceFunction", "DeviceIdentity", "DeviceManager", "NetworkManagement",
        "ProfileBody", "ProfileHeader", "actualValue", "allowedValues", "allowedValuesTemplate", "dataTypeList", "defaultValue",
        "deviceCommissioning", "dummyUsage", "dynamicChannel", "dynamicChannels", "enumValue", "parameter", "parameterGroup",
        "parameterGroupList", "parameterList", "parameterTemplate", "productID", "productName", "range", "struct", "subrange",
        "substituteValue", "templateList", "varDeclaration", "vendorID", "vendorName",
    ];
    const VALUE: &'static Code = &codes::XDD_VALUE;
    const ENGLISH: (&'static str, &'static str) = ("lang", "en");
}

/// Language in the attribute `lang`; empty if the attribute is missing.
#[derive(Clone, Debug, Default)]
pub(super) struct Lang(pub CompactString);

impl xml::Language for Lang {
    fn rank(&self) -> u8 {
        u8::from(self.0 != "en" && !self.0.starts_with("en-"))
    }

    fn tag(&self) -> CompactString {
        self.0.clone()
    }
}

/// Labels and descriptions of an element, in the languages of the file.
#[derive(Clone, Debug, Default)]
pub(super) struct Texts<'a> {
    pub labels: Names<'a, Lang>,
    pub descriptions: Option<Box<Names<'a, Lang>>>,
}

impl Texts<'_> {
    /// Returns the descriptions as documentation of an element, or `None` if there is no description.
    pub fn documentation(&self) -> Option<Arc<Documentation>> {
        self.descriptions.as_ref()?.documentation()
    }
}

impl<'a> Reader<'a, '_> {
    pub fn converter(&mut self) -> Converter<'_> {
        Converter { diagnostics: self.diagnostics, aliases: self.format.aliases }
    }

    /// Reads an element that should contain only labels and descriptions, up to its end tag.
    pub fn texts(&mut self, parent: &Tag<'a>) -> Read<Texts<'a>> {
        let mut texts = Texts::default();
        while let Some(tag) = self.child(parent)? {
            self.text_or_keep(&tag, &mut texts)?;
        }
        Ok(texts)
    }

    /// Reads a label or description into `texts`. Stores any other element as extensions.
    pub fn text_or_keep(&mut self, tag: &Tag<'a>, texts: &mut Texts<'a>) -> Read<()> {
        let names = match tag.name {
            "label" => &mut texts.labels,
            "description" => &mut **texts.descriptions.get_or_insert_default(),
            _ => return self.keep(tag),
        };
        let language = Lang(self.attribute(tag, "lang")?.compact());
        let given = self.content()?;
        if !given.is_empty() {
            names.push(language, given);
        }
        Ok(())
    }

    /// Returns the length in bytes of an element whose end tag was just read.
    pub fn length(&self, tag: &Tag<'a>) -> usize {
        self.cursor.offset().saturating_sub(tag.span.start) as usize
    }
}
