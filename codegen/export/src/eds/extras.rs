//! Extension attributes and comments of the device, and the sections of the file that contain them.
//!
//! The IR lists the attributes as `section/key`, in the order of the source; those of header sections come first. The
//! export writes each attribute to its section. Header sections with attributes have the order in which their first
//! attributes occur in the IR.

use super::note::{NoteKind, Notes, Subject};
use super::writer::Writer;
use super::{Context, Flavor};
use lexibus_codegen::ir::Extension;

/// The header sections and the object lists.
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

/// The names of the header sections and object lists, in the order of the standard.
const HEADERS: [(Header, &str); 11] = [
    (Header::FileInfo, "FileInfo"),
    (Header::DeviceInfo, "DeviceInfo"),
    (Header::DummyUsage, "DummyUsage"),
    (Header::Comments, "Comments"),
    // CiA 306 misspells the name of the section about commissioning.
    (Header::Commissioning, "DeviceComissioning"),
    (Header::SupportedModules, "SupportedModules"),
    (Header::ConnectedModules, "ConnectedModules"),
    (Header::DynamicChannels, "DynamicChannels"),
    (Header::Mandatory, "MandatoryObjects"),
    (Header::Optional, "OptionalObjects"),
    (Header::Manufacturer, "ManufacturerObjects"),
];

impl Header {
    pub(super) fn name(self) -> &'static str {
        HEADERS.iter().find(|(header, _)| *header == self).map_or("", |(_, name)| name)
    }

    /// Returns whether the section occurs only in a DCF.
    fn configures(self) -> bool {
        matches!(self, Header::Commissioning | Header::ConnectedModules)
    }
}

/// An extension attribute, with its key within the section.
#[derive(Clone, Copy)]
pub(super) struct Extra<'a> {
    pub(super) key: &'a str,
    pub(super) value: &'a str,
}

/// The extension attributes of a device, grouped by section.
pub(super) struct Extras<'a> {
    /// Comments above the first section.
    pub(super) preamble: Vec<&'a Extension>,
    /// Attributes of header sections, in the order of the source.
    header: Vec<(Header, Extra<'a>)>,
    /// Attributes of all other sections, in the order of the source.
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
        match HEADERS.into_iter().find(|(_, name)| *name == section).map(|(header, _)| header) {
            Some(header) if header.configures() && context.flavor == Flavor::Eds => {
                notes.add(NoteKind::Configuration, Subject::Named(&extension.key));
            }
            Some(header) => self.header.push((header, extra)),
            // Only names from a CiA 306 file are section names: in other formats, a slash separates the names of nested
            // XML elements.
            None if context.is_verbatim && !section.contains(['[', ']']) => self.unknown.push((section, extra)),
            None => notes.add(NoteKind::Extension, Subject::Named(&extension.key)),
        }
    }

    /// Returns the header sections. Sections with extension attributes follow the order of these attributes. Sections
    /// without extension attributes keep their position in the standard order.
    pub(super) fn order(&self) -> Vec<Header> {
        let mut mentioned: Vec<Header> = Vec::new();
        for (header, _) in &self.header {
            if !mentioned.contains(header) {
                mentioned.push(*header);
            }
        }
        let mut next = mentioned.clone().into_iter();
        let ordered = |header: Header| if mentioned.contains(&header) { next.next() } else { Some(header) };
        HEADERS.into_iter().map(|(header, _)| header).filter_map(ordered).collect()
    }

    /// Returns the extension attributes of a header section.
    pub(super) fn of(&self, header: Header) -> impl Iterator<Item = Extra<'a>> + Clone + use<'_, 'a> {
        self.header.iter().filter(move |(other, _)| *other == header).map(|&(_, extra)| extra)
    }

    /// Writes the sections that CiA 306 does not define, and the sections of objects that the description does not
    /// define.
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
            flavor: Flavor::Eds,
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
