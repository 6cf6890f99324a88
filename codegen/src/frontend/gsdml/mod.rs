//! PROFINET device descriptions (GSDML V1.0 to V2.45) to IR.
//!
//! A file describes a family of devices. Every device access point becomes a [`Device`](crate::ir::Device); modules and
//! submodules, which several of them take, belong to the catalogue, as do the types of their data. A file is read once,
//! from top to bottom, straight into the IR. What an element refers to often stands behind it, and the texts stand at the
//! very end: references are held with their places, and followed when the end is reached.
//!
//! Versions differ in what elements and attributes they have, not in what these mean. No version is told from another
//! here; what this front end doesn't know is kept, so that files of later versions can be read as well.
//!
//! | file | subject |
//! |---|---|
//! | `reader` | reading single attributes, and what has no place in the IR |
//! | `number` | numbers, truth values and lists |
//! | `texts`, `resolve` | the text list, and texts in the place of references to them |
//! | `links` | identifiers of elements, and references to them |
//! | `header` | name and version of the file, vendor, family |
//! | `device` | device access points |
//! | `module` | modules |
//! | `submodule` | submodules, interfaces and ports |
//! | `io_data` | cyclic data |
//! | `record` | parameter records |
//! | `value` | defaults and allowed values of parameters |
//! | `safety` | parameters of PROFIsafe |
//! | `data_type`, `types` | data types, and types of the catalogue |
//! | `diagnosis` | diagnosis, alarms and log book |

mod data_type;
mod device;
mod diagnosis;
mod header;
mod io_data;
mod links;
mod module;
mod number;
mod reader;
mod record;
mod resolve;
mod safety;
mod submodule;
mod texts;
mod types;
mod value;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::declared_encoding;
use crate::ir::{Catalog, CompactString, Extension, Family, Graphic, LocalText};
use crate::source::{FileId, Source};
use crate::syntax::xml::{Cursor, Tag};
use header::Header;
use links::{Kind, Links};
use reader::{Read, Reader};
use resolve::Resolver;
use texts::{Names, TextList};
use types::Types;

/// Reads the device access points, modules and submodules that `source` describes. Everything that had to be repaired goes
/// to `diagnostics`.
///
/// Returns `None`, with one error, for a file that isn't well formed or no GSDML.
pub fn read(source: &Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<Catalog> {
    declared_encoding::report(source, file, diagnostics);
    let text = source.text();
    let cursor = Cursor::new(text, file);
    let (names, types, links) = (Names::default(), Types::default(), Links::default());
    let mut reader = Reader { cursor, text, diagnostics, names, types, links, items: Vec::new() };
    let mut document = Document::default();
    if let Err(stop) = document.read(&mut reader) {
        reader.diagnostics.push(*stop);
        return None;
    }
    let Reader { diagnostics, names, types, links, .. } = reader;
    let Document { mut catalog, header, list } = document;
    header.check_file_name(source.name(), file, diagnostics);
    links.resolve(&mut catalog, diagnostics);
    catalog.types = types.finish(diagnostics);
    let mut resolver = Resolver::new(list, names, text.len(), diagnostics);
    resolve::catalog(&mut catalog, &mut resolver);
    header.apply(&mut catalog, &mut resolver);
    let Resolver { list, diagnostics, .. } = resolver;
    list.close(diagnostics, &mut catalog.extensions);
    Some(catalog)
}

/// What was read so far.
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
        while let Some(tag) = reader.cursor.child(&root)? {
            match tag.name {
                "ProfileBody" => self.body(reader, &tag)?,
                "ProfileHeader" | "Signature" => reader.keep(&tag, &mut self.catalog.extensions)?,
                _ => reader.unknown(&tag, &mut self.catalog.extensions)?,
            }
        }
        // What follows the root element has to be well formed, too.
        while reader.cursor.read()?.is_some() {}
        if self.catalog.devices.is_empty() {
            let message = "the file describes no device access point";
            let diagnostic = Diagnostic::new(&codes::NO_DEVICE_ACCESS_POINT, root.name_span(), message);
            reader.diagnostics.push(diagnostic.label("there is no <DeviceAccessPointItem> in it"));
        }
        Ok(())
    }

    fn body(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "DeviceIdentity" => self.header.identity(reader, &tag, &mut self.catalog.extensions)?,
                "DeviceFunction" => self.function(reader, &tag)?,
                "ApplicationProcess" => self.process(reader, &tag)?,
                _ => reader.unknown(&tag, &mut self.catalog.extensions)?,
            }
        }
        Ok(())
    }

    fn function(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "Family" => self.header.family(reader, &tag, &mut self.catalog.extensions)?,
                // Not its place, but nothing else can be meant.
                "ApplicationProcess" => {
                    let message = "<ApplicationProcess> belongs into <ProfileBody>";
                    let diagnostic = Diagnostic::new(&codes::GSDML_VALUE, tag.name_span(), message);
                    reader.diagnostics.push(diagnostic.label("read here"));
                    self.process(reader, &tag)?;
                }
                _ => reader.unknown(&tag, &mut self.catalog.extensions)?,
            }
        }
        Ok(())
    }

    fn process(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let catalog = &mut self.catalog;
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "DeviceAccessPointList" => reader.device_list(&tag, catalog)?,
                "ModuleList" => reader.module_list(&tag, catalog)?,
                "SubmoduleList" => reader.submodule_list(&tag, &mut catalog.submodules, &mut catalog.extensions)?,
                "ValueList" => reader.value_list(&tag, &mut catalog.extensions)?,
                "ChannelDiagList" => reader.channel_diagnosis(&tag, catalog)?,
                "ChannelProcessAlarmList" => reader.process_alarms(&tag, catalog)?,
                "UnitDiagTypeList" => reader.unit_diagnoses(&tag, catalog)?,
                "LogBookEntryList" => reader.log_book(&tag, catalog)?,
                "GraphicsList" => graphics_list(reader, &tag, catalog)?,
                "CategoryList" => category_list(reader, &tag, catalog)?,
                "ExternalTextList" => self.list.read(reader, &tag, &mut catalog.extensions)?,
                _ => reader.unknown(&tag, &mut catalog.extensions)?,
            }
        }
        Ok(())
    }
}

fn not_gsdml(root: &Tag<'_>) -> Box<Diagnostic> {
    let message = format!("<{}> isn't the root of a GSDML file", reader::shortened(root.name));
    let help = "a GSDML file has the root element ISO15745Profile, and in it a ProfileBody with an ApplicationProcess";
    Box::new(Diagnostic::new(&codes::NOT_A_GSDML, root.name_span(), message).help(help))
}

fn graphics_list<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
    while let Some(tag) = reader.cursor.child(list)? {
        if tag.name != "GraphicItem" {
            reader.unknown(&tag, &mut catalog.extensions)?;
            continue;
        }
        let [id, file] = reader.fields(&tag, &["ID", "GraphicFile"], &mut catalog.extensions)?;
        reader.register(&tag, Kind::Graphic, id.as_ref(), catalog.graphics.len());
        let text =
            |given: Option<reader::Given<'a>>| given.map_or_else(CompactString::default, |given| given.text.into());
        catalog.graphics.push(Graphic { id: text(id), file: text(file) });
        while let Some(child) = reader.cursor.child(&tag)? {
            if child.name != "Embedded" {
                reader.unknown(&child, &mut catalog.extensions)?;
                continue;
            }
            // A drawing is kept as it is written.
            reader.cursor.skip(&child)?;
            let drawing = reader.text.get(child.span.start as usize..reader.cursor.offset() as usize).unwrap_or("");
            let (key, value) = ("GraphicItem/Embedded".into(), drawing.into());
            catalog.extensions.push(Extension { key, value, span: child.span });
        }
    }
    Ok(())
}

fn category_list<'a>(reader: &mut Reader<'a, '_>, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
    while let Some(tag) = reader.cursor.child(list)? {
        if tag.name != "CategoryItem" {
            reader.unknown(&tag, &mut catalog.extensions)?;
            continue;
        }
        let origin = reader.cursor.origin(&tag);
        let [id, text] = reader.fields(&tag, &["ID", "TextId"], &mut catalog.extensions)?;
        reader.register(&tag, Kind::Category, id.as_ref(), catalog.families.len());
        let id = id.map_or_else(CompactString::default, |given| given.text.into());
        let mut family = Family { id, name: reader.name(&tag, text), origin, ..Family::default() };
        while let Some(child) = reader.cursor.child(&tag)? {
            match child.name {
                "InfoText" => {
                    let text = reader.text_reference(&child)?;
                    family.descriptions.push(LocalText { language: CompactString::default(), text });
                }
                _ => reader.unknown(&child, &mut catalog.extensions)?,
            }
        }
        catalog.families.push(family);
    }
    Ok(())
}
