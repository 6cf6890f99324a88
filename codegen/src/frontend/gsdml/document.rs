//! Reads a file and the main elements in it.

use super::header::Header;
use super::lists;
use super::reader::{Gsdml, Reader};
use super::resolve::{self, Resolver};
use super::text_list::TextList;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::declared_encoding;
use crate::frontend::xml::Read;
use crate::ir::{Catalog, ProfileHeader};
use crate::source::{FileId, Source};
use crate::syntax::xml::{Cursor, Tag};
use crate::text::brief;

/// Reads the device access points, modules and submodules that `source` describes. Reports repairs to `diagnostics`.
///
/// Returns `None` and reports one error if `source` is not well-formed or not a GSDML file.
pub fn read(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<Catalog> {
    declared_encoding::report(source, file, diagnostics);
    let mut reader = Reader::new(Cursor::new(source.text(), file), diagnostics, Gsdml::default());
    let mut document = Document::default();
    if let Err(stop) = document.read(&mut reader) {
        reader.diagnostics.push(*stop);
        return None;
    }
    let Reader { diagnostics, format, extensions, .. } = reader;
    let Gsdml { mut texts, types, links, items } = format;
    let Document { mut catalog, header, mut list } = document;
    // Freeing memory here reduces the peak memory use, which occurs while the texts are copied.
    drop(items);
    texts.shrink_to_fit();
    list.shrink_to_fit();
    catalog.modules.shrink_to_fit();
    catalog.submodules.shrink_to_fit();
    catalog.extensions = extensions;
    header.check_file_name(source.name(), file, diagnostics);
    links.resolve(&mut catalog, diagnostics);
    catalog.types = types.finish(diagnostics);
    let mut resolver = Resolver::new(list, texts, source.text().len(), diagnostics);
    resolve::catalog(&mut catalog, &mut resolver);
    header.apply(&mut catalog, &mut resolver);
    let (list, diagnostics) = resolver.into_list();
    list.close(diagnostics, &mut catalog.unused_texts);
    Some(catalog)
}

/// Contents of a file that were read so far.
#[derive(Default)]
struct Document<'a> {
    catalog: Catalog,
    header: Header,
    list: TextList<'a>,
}

impl<'a> Document<'a> {
    fn read(&mut self, reader: &mut Reader<'a, '_>) -> Read<()> {
        let root = reader.cursor.root()?;
        if root.name != "ISO15745Profile" {
            return Err(not_gsdml(&root));
        }
        self.header.root(reader, &root)?;
        while let Some(tag) = reader.child(&root)? {
            match tag.name {
                "ProfileBody" => self.body(reader, &tag)?,
                "ProfileHeader" => profile_header(reader, &tag, self.catalog.profile_header.get_or_insert_default())?,
                "Signature" => reader.keep(&tag)?,
                _ => reader.unknown(&tag)?,
            }
        }
        // The content after the root element must also be well-formed.
        while reader.cursor.read()?.is_some() {}
        if self.catalog.devices.is_empty() {
            let message = "the file does not describe a device access point";
            let label = "<DeviceAccessPointItem> is missing";
            reader.report(&codes::NO_DEVICE_ACCESS_POINT, root.name_span(), message, label);
        }
        Ok(())
    }

    fn body(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "DeviceIdentity" => self.header.identity(reader, &tag)?,
                "DeviceFunction" => self.function(reader, &tag)?,
                "ApplicationProcess" => self.process(reader, &tag)?,
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn function(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "Family" => self.header.family(reader, &tag)?,
                // In some files, `ApplicationProcess` has the wrong parent element, but its meaning is clear.
                "ApplicationProcess" => {
                    let message = "<ApplicationProcess> is not in <ProfileBody>";
                    reader.report(&codes::GSDML_VALUE, tag.name_span(), message, "read as a part of <ProfileBody>");
                    self.process(reader, &tag)?;
                }
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn process(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let catalog = &mut self.catalog;
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "DeviceAccessPointList" => reader.device_list(&tag, catalog)?,
                "ModuleList" => reader.module_list(&tag, catalog)?,
                "SubmoduleList" => reader.submodule_list(&tag, &mut catalog.submodules)?,
                "ValueList" => reader.value_list(&tag)?,
                "ChannelDiagList" => reader.channel_diagnosis(&tag, catalog)?,
                "ChannelProcessAlarmList" => reader.process_alarms(&tag, catalog)?,
                "UnitDiagTypeList" => reader.unit_diagnoses(&tag, catalog)?,
                "LogBookEntryList" => reader.log_book(&tag, catalog)?,
                "GraphicsList" => lists::graphics(reader, &tag, catalog)?,
                "CategoryList" => lists::categories(reader, &tag, catalog)?,
                "ExternalTextList" => self.list.read(reader, &tag)?,
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }
}

/// Reads a `ProfileHeader` element, or the `ISO15745Reference` element in it.
fn profile_header<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, header: &mut ProfileHeader) -> Read<()> {
    while let Some(tag) = reader.child(parent)? {
        let text = match tag.name {
            "ProfileIdentification" => &mut header.identification,
            "ProfileRevision" => &mut header.revision,
            "ProfileName" => &mut header.name,
            "ProfileSource" => &mut header.source,
            "ProfileClassID" => &mut header.class,
            "ProfileDate" => &mut header.date,
            "AdditionalInformation" => &mut header.additional_information,
            "ISO15745Part" => &mut header.iso_part,
            "ISO15745Edition" => &mut header.iso_edition,
            "ProfileTechnology" => &mut header.technology,
            "ISO15745Reference" if parent.name == "ProfileHeader" => {
                profile_header(reader, &tag, header)?;
                continue;
            }
            _ => {
                reader.keep(&tag)?;
                continue;
            }
        };
        *text = reader.text(&tag)?.compact();
    }
    Ok(())
}

fn not_gsdml(root: &Tag<'_>) -> Box<Diagnostic> {
    let message = format!("<{}> is not the root element of a GSDML file", brief(root.name));
    let help =
        "check that the file has <ISO15745Profile> as its root element, with <ApplicationProcess> in <ProfileBody>";
    Box::new(codes::NOT_A_GSDML.at(root.name_span(), message).help(help))
}
