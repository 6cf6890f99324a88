//! Extension attributes and comments of the device: which section each one goes into.
//!
//! The IR has them as `section/key`, those of the header first, in the order of the source; the file has them in the
//! section that they name, and the sections of the header in the order in which they are named.

use super::note::{NoteKind, Notes, Subject};
use super::writer::Writer;
use super::{Context, Flavour};
use lexibus_codegen::ir::Extension;

/// The sections of the header and the object lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Header {
    FileInfo,
    DeviceInfo,
    DummyUsage,
    Comments,
    Commissioning,
    SupportedModules,
    ConnectedModules,
    DynamicChannels,
    Mandatory,
    Optional,
    Manufacturer,
}

/// In the order in which the standard introduces them.
const HEADERS: [Header; 11] = [
    Header::FileInfo,
    Header::DeviceInfo,
    Header::DummyUsage,
    Header::Comments,
    Header::Commissioning,
    Header::SupportedModules,
    Header::ConnectedModules,
    Header::DynamicChannels,
    Header::Mandatory,
    Header::Optional,
    Header::Manufacturer,
];

impl Header {
    pub(super) fn name(self) -> &'static str {
        match self {
            Header::FileInfo => "FileInfo",
            Header::DeviceInfo => "DeviceInfo",
            Header::DummyUsage => "DummyUsage",
            Header::Comments => "Comments",
            // The standard's own spelling.
            Header::Commissioning => "DeviceComissioning",
            Header::SupportedModules => "SupportedModules",
            Header::ConnectedModules => "ConnectedModules",
            Header::DynamicChannels => "DynamicChannels",
            Header::Mandatory => "MandatoryObjects",
            Header::Optional => "OptionalObjects",
            Header::Manufacturer => "ManufacturerObjects",
        }
    }

    /// Whether only a DCF has it.
    fn configures(self) -> bool {
        matches!(self, Header::Commissioning | Header::ConnectedModules)
    }
}

/// An extension attribute, with its key in the section.
#[derive(Clone, Copy)]
pub(super) struct Extra<'a> {
    pub(super) key: &'a str,
    pub(super) value: &'a str,
}

/// The extension attributes of a device by section.
pub(super) struct Extras<'a> {
    /// Comments above the first section.
    pub(super) preamble: Vec<&'a Extension>,
    /// Those of the header, in their order.
    header: Vec<(Header, Extra<'a>)>,
    /// Those of other sections, in their order.
    unknown: Vec<(&'a str, Extra<'a>)>,
}

impl<'a> Extras<'a> {
    pub(super) fn new(context: &Context<'a>, notes: &mut Notes) -> Self {
        let mut extras = Extras { preamble: Vec::new(), header: Vec::new(), unknown: Vec::new() };
        for extension in &context.device.extensions {
            extras.add(extension, context, notes);
        }
        extras
    }

    fn add(&mut self, extension: &'a Extension, context: &Context<'_>, notes: &mut Notes) {
        let value = extension.value.as_str();
        let Some((section, key)) = extension.key.split_once('/') else {
            let key = extension.key.as_str();
            match key {
                ";" => self.preamble.push(extension),
                _ => self.header.push((Header::DeviceInfo, Extra { key, value })),
            }
            return;
        };
        let extra = Extra { key, value };
        match HEADERS.into_iter().find(|header| header.name() == section) {
            Some(header) if header.configures() && context.flavour == Flavour::Eds => {
                notes.add(NoteKind::Configuration, Subject::Named(&extension.key));
            }
            Some(header) => self.header.push((header, extra)),
            // Elsewhere a slash leads to an element of XML.
            None if context.is_verbatim && !section.contains(['[', ']']) => self.unknown.push((section, extra)),
            None => notes.add(NoteKind::Extension, Subject::Named(&extension.key)),
        }
    }

    /// The sections of the header: those that have extension attributes in the order of these, in the places that the
    /// standard's order leaves them.
    pub(super) fn order(&self) -> Vec<Header> {
        let mut mentioned: Vec<Header> = Vec::new();
        for (header, _) in &self.header {
            if !mentioned.contains(header) {
                mentioned.push(*header);
            }
        }
        let mut next = mentioned.clone().into_iter();
        let in_place = |header: Header| if mentioned.contains(&header) { next.next() } else { Some(header) };
        HEADERS.into_iter().filter_map(in_place).collect()
    }

    /// The extension attributes of a section of the header.
    pub(super) fn of(&self, header: Header) -> impl Iterator<Item = Extra<'a>> + Clone + use<'_, 'a> {
        self.header.iter().filter(move |(other, _)| *other == header).map(|&(_, extra)| extra)
    }

    /// Sections of which CiA 306 knows nothing, and those about objects that aren't described.
    pub(super) fn write_unknown(&self, writer: &mut Writer) {
        let mut last = None;
        for &(section, extra) in &self.unknown {
            if last.replace(section) != Some(section) {
                writer.section(section);
            }
            writer.extension(extra.key, extra.value, Subject::Device);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eds::Reals;
    use lexibus_codegen::ir::Device;
    use lexibus_codegen::source::Span;

    #[test]
    fn sections_keep_the_order_of_their_attributes() {
        let extension = |key: &str| Extension { key: key.into(), value: "v".into(), span: Span::default() };
        let keys = [";", "DeviceInfo/a", "FileInfo/b", "DeviceInfo/;", "Vendor/x/y", "SupportedModules/Slots"];
        let device = Device { extensions: keys.map(extension).into(), ..Device::default() };
        let context = Context {
            device: &device,
            flavour: Flavour::Eds,
            reals: Reals::default(),
            file_name: "",
            is_verbatim: true,
            is_canopen: true,
        };
        let extras = Extras::new(&context, &mut Notes::default());
        let order = extras.order();
        assert_eq!(order[..3], [Header::DeviceInfo, Header::FileInfo, Header::DummyUsage]);
        assert_eq!(order.len(), HEADERS.len());
        assert_eq!(extras.of(Header::DeviceInfo).map(|extra| extra.key).collect::<Vec<_>>(), ["a", ";"]);
        let mut writer = Writer::new(true);
        extras.write_unknown(&mut writer);
        assert_eq!(writer.finish().0, "[Vendor]\r\nx/y=v\r\n");
    }
}
