//! Reads the root element of a file.

use super::budget::Budget;
use super::description::{Description, OtherFiles};
use super::dictionary::Dictionary;
use super::lower::lower;
use super::pdos::Pdos;
use super::reader::{Esi, Reader};
use super::templates::Templates;
use super::{diagnosis, info};
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::declared_encoding;
use crate::frontend::xml::Read;
use crate::ir::Device;
use crate::source::{FileId, Source};
use crate::syntax::xml::{Cursor, Tag};
use crate::text::brief;

/// Reads a file and adds its contents to `description`.
pub(super) fn document(
    source: &Source,
    file: FileId,
    description: &mut Description,
    diagnostics: &mut Diagnostics,
    budget: &mut Budget,
) -> Read<()> {
    declared_encoding::report(source, file, diagnostics);
    let templates = Templates::of(source.text(), file);
    let format = Esi { budget, templates: &templates };
    let mut reader = Reader::new(Cursor::new(source.text(), file), diagnostics, format);
    let root = reader.cursor.root()?;
    match root.name {
        "EtherCATInfo" | "EtherCATModule" => info::read(&mut reader, &root, description)?,
        "EtherCATInfoList" => reader.each(&root, "EtherCATInfo", |reader, tag| info::read(reader, tag, description))?,
        "EtherCATDict" => dictionary_only(&mut reader, &root, description)?,
        "EtherCATDiag" => messages_only(&mut reader, &root, description)?,
        name => {
            let message = format!("<{}> is not the root element of an ESI file", brief(name));
            return Err(Box::new(codes::UNKNOWN_FORMAT.at(root.name_span(), message)));
        }
    }
    after_root(&mut reader);
    description.catalog.extensions.append(&mut reader.extensions);
    Ok(())
}

/// Reports content after the root element and ignores it.
fn after_root(reader: &mut Reader<'_, '_>) {
    loop {
        match reader.cursor.read() {
            Ok(Some(_)) => {}
            Ok(None) => return,
            Err(error) => {
                let found = error.into_diagnostic();
                let message = format!("there is content after the root element: {}", found.message);
                reader.report(&codes::SECOND_ROOT, found.span, message, "ignored from here on");
                return;
            }
        }
    }
}

/// Reads the root element of a file that contains a dictionary but no device.
fn dictionary_only<'a>(reader: &mut Reader<'a, '_>, root: &Tag<'a>, description: &mut Description) -> Read<()> {
    let origin = reader.origin(root);
    let mut device = Device { dictionary_only: true, origin, ..Device::default() };
    let [version] = reader.attributes(root, ["Version"])?;
    device.header.format_version = version.compact();
    let mut dictionary = Dictionary::default();
    reader.each(root, "Dictionary", |reader, tag| dictionary.read(reader, tag))?;
    device.extensions = reader.extensions_since(0);
    let lowered = lower(reader, dictionary, Pdos::default(), &mut device.process_data, &mut OtherFiles::default());
    (device.types, device.groups) = lowered;
    device.ethercat = Some(Box::default());
    description.catalog.devices.push(device);
    Ok(())
}

/// Reads the root element of a file that contains diagnosis messages but no device.
fn messages_only<'a>(reader: &mut Reader<'a, '_>, root: &Tag<'a>, description: &mut Description) -> Read<()> {
    let [version] = reader.attributes(root, ["Version"])?;
    description.catalog.format_version = version.compact();
    reader.each(root, "DiagMessages", |reader, tag| {
        description.catalog.code_tables.extend(diagnosis::read(reader, tag)?);
        Ok(())
    })
}
