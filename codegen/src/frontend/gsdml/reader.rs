//! State of the GSDML reader, and functions for identifiers, text references and required attributes.

use std::sync::Arc;

use compact_str::{format_compact, ToCompactString};

use super::links::{ElementKind, Links};
use super::types::Types;
use crate::diagnostics::{codes, Code};
use crate::frontend::xml::{self, Attributes, Given, Read};
use crate::ir::{CompactString, Documentation, Item};
use crate::syntax::xml::Tag;
use crate::text::brief;

pub(super) type Reader<'a, 'd> = xml::Reader<'a, 'd, Gsdml<'a>>;

/// State of the GSDML reader in addition to that of the XML reader.
#[derive(Default)]
pub(super) struct Gsdml<'a> {
    /// References to the texts at the end of the file, in the order in which they were read.
    pub texts: Vec<Given<'a>>,
    /// Types found so far, which are moved to the catalog after the file is read.
    pub types: Types<'a>,
    /// Identifiers of elements, and references to these elements.
    pub links: Links<'a>,
    /// Buffer for the parameters of a record, which is reused for each record.
    pub items: Vec<Item>,
}

impl xml::Format for Gsdml<'_> {
    const STANDARD: &'static str = "GSDML V2.35";
    const UNKNOWN: &'static Code = &codes::UNKNOWN_GSDML_ELEMENT;
    #[rustfmt::skip]
    const ELEMENTS: &'static [&'static str] = &[
        "ApplicationProcess", "Assign", "Assignments", "BitDataItem", "CategoryItem", "CategoryList", "ChannelDiagItem",
        "ChannelDiagList", "Const", "DataItem", "DeviceAccessPointItem", "DeviceAccessPointList", "DeviceFunction",
        "DeviceIdentity", "ErrorCode2Item", "ErrorCode2List", "ExtChannelAddValue", "ExtChannelDiagItem", "ExtChannelDiagList",
        "ExternalTextList", "F_ParameterRecordDataItem", "IOConfigData", "IOData", "Input", "InterfaceSubmoduleItem", "ModuleInfo",
        "ModuleItem", "ModuleItemRef", "ModuleList", "Output", "ParameterRecordDataItem", "ParameterRef", "PortSubmoduleItem",
        "PrimaryLanguage", "ProfileBody", "ProfileHeader", "RecordDataList", "SlotItem", "SlotList", "SubmoduleItem",
        "SubmoduleItemRef", "SubmoduleList", "SubslotItem", "SubslotList", "SystemDefinedSubmoduleList", "TimingProperties",
        "UnitDiagTypeItem", "UnitDiagTypeList", "UseableModules", "UseableSubmodules", "ValueItem", "ValueList",
        "VirtualSubmoduleItem", "VirtualSubmoduleList",
    ];
    const VALUE: &'static Code = &codes::GSDML_VALUE;
    const CASE: Option<&'static Code> = Some(&codes::ATTRIBUTE_CASE);
    const EMPTY_IS_MISSING: bool = false;
}

impl<'a> Reader<'a, '_> {
    /// Reports that `tag` lacks the attribute or child `what`.
    pub fn missing(&mut self, tag: &Tag<'_>, what: &str, label: impl Into<String>) {
        let message = format!("<{}> has no {what}", brief(tag.name));
        self.report(&codes::GSDML_MISSING, tag.name_span(), message, label);
    }

    /// Reads attributes of `tag`. Adds all other attributes to `others`, with the element's name as a prefix:
    /// `TimingProperties@PreferredSendClock`.
    pub fn attributes_and_prefixed<const N: usize>(
        &mut self,
        tag: &Tag<'a>,
        names: [&'static str; N],
        others: &mut Attributes,
    ) -> Read<[Given<'a>; N]> {
        let mut found = Attributes::new();
        let given = self.attributes_and_others(tag, names, &mut found)?;
        others.extend(found.into_iter().map(|(key, value)| (format_compact!("{}@{key}", tag.name), value)));
        Ok(given)
    }

    /// Returns whether a required attribute is present. Reports a missing attribute.
    pub fn require(&mut self, tag: &Tag<'_>, given: &Given<'_>, name: &str, label: &str) -> bool {
        if given.is_missing() {
            self.missing(tag, name, label);
        }
        !given.is_missing()
    }

    /// Reads the required attribute `name` of an element that should have no other content.
    pub fn single(&mut self, tag: &Tag<'a>, name: &str) -> Read<Given<'a>> {
        let given = self.attribute(tag, name)?;
        self.require(tag, &given, name, "left empty");
        Ok(given)
    }

    /// Returns the placeholder for the text that names an element. Reports a missing text.
    pub fn name(&mut self, tag: &Tag<'a>, given: Given<'a>) -> CompactString {
        if given.is_missing() {
            let message = format!("<{}> has no TextId", tag.name);
            self.report(&codes::MISSING_TEXT, tag.name_span(), message, "the name is left empty");
            return CompactString::default();
        }
        self.placeholder(given)
    }

    /// Adds a reference to a text and returns its placeholder; see `resolve`.
    pub fn placeholder(&mut self, given: Given<'a>) -> CompactString {
        let placeholder = self.format.texts.len().to_compact_string();
        self.format.texts.push(given);
        placeholder
    }

    /// Reads an element that has only a `TextId`, and returns the placeholder for its text.
    pub fn text_reference(&mut self, tag: &Tag<'a>) -> Read<CompactString> {
        let given = self.attribute(tag, "TextId")?;
        Ok(self.name(tag, given))
    }

    /// Reads an element that has only a `TextId`, and returns the placeholder as documentation.
    pub fn documentation(&mut self, tag: &Tag<'a>) -> Read<Option<Arc<Documentation>>> {
        let text = self.text_reference(tag)?.into();
        Ok(Some(Arc::new(Documentation { text, ..Documentation::default() })))
    }

    /// Registers the identifier of the element `tag`, whose position in the catalog is `position`. The first element takes
    /// precedence if an identifier is repeated.
    pub fn register(&mut self, tag: &Tag<'a>, kind: ElementKind, id: &Given<'a>, position: usize) {
        if id.is_missing() {
            // Interfaces and ports of V2.0 have no identifier, and nothing refers to them.
            if kind != ElementKind::BuiltIn || tag.name == "VirtualSubmoduleItem" {
                self.missing(tag, "ID", "nothing can refer to it");
            }
            return;
        }
        if let Some(first) = self.format.links.register(kind, id, position) {
            let message = format!("another <{}> has the ID `{}`", brief(tag.name), brief(&id.text));
            let diagnostic = codes::DUPLICATE_ID.at(id.span, message);
            self.diagnostics.push(diagnostic.label("references resolve to the first one").note_at(first, "first one"));
        }
    }
}
