//! EtherCAT slave information (ESI, ETG.2000) to IR.
//!
//! Elements are taken in any order, for real files keep to none: what depends on something that may stand further down
//! (the objects on the data types, the devices on the vendor) is noted while the file is read, once, and settled when the
//! element ends that has both. Data types, objects and PDOs belong to one device or module; files that a description
//! refers to are read at the end.
//!
//! | file | subject |
//! |---|---|
//! | `reader` | reading single texts, attributes, numbers, names, and what has no place in the IR |
//! | `number` | numbers of ETG.2000 |
//! | `info` | the vendor, groups, lists of devices and modules |
//! | `device`, `device_info`, `eeprom` | devices |
//! | `sync`, `mailbox`, `clocks` | FMMUs and sync managers; the mailbox; distributed clocks |
//! | `pdo`, `templates` | PDOs and their entries; PDO templates of old files |
//! | `slots`, `modules` | slots, modules, and which fit where |
//! | `profile`, `diagnosis` | profiles, diagnosis messages |
//! | `dictionary` | dictionaries as they stand in the file: `data_type`, `object`, `flags` |
//! | `types` | data types to types |
//! | `items`, `value`, `array_default` | objects to groups and items |
//! | `references` | files that the description refers to |

mod array_default;
mod clocks;
mod data_type;
mod device;
mod device_info;
mod diagnosis;
mod dictionary;
mod eeprom;
mod flags;
mod info;
mod items;
mod mailbox;
mod modules;
mod number;
mod object;
mod pdo;
mod profile;
mod reader;
mod references;
mod slots;
mod sync;
mod templates;
mod types;
mod value;

use std::collections::HashSet;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::etg::{language, type_name, unit};
use crate::frontend::declared_encoding;
use crate::ir::{Catalog, Device};
use crate::source::{FileId, References, Source};
use crate::syntax::xml::{Cursor, Tag};
use dictionary::Dictionary;
use pdo::Pdos;
use reader::{Budget, Read, Reader};
use references::{Elsewhere, EntryType, Owner, Reference};
use templates::Templates;

/// What was read, and the files that it refers to.
#[derive(Default)]
struct Description {
    catalog: Catalog,
    references: Vec<(Owner, Reference)>,
    /// Types of entries that may be in those files.
    entry_types: Vec<(Owner, EntryType)>,
    /// To whom such a file wasn't copied.
    refused: HashSet<Owner>,
}

impl Description {
    /// Notes what a device or module leaves to other files.
    fn leave(&mut self, owner: Owner, elsewhere: Elsewhere) {
        self.references.extend(elsewhere.files.into_iter().map(|file| (owner, file)));
        self.catalog.code_tables.extend(elsewhere.messages);
        self.entry_types.extend(elsewhere.types.into_iter().map(|ty| (owner, ty)));
    }
}

/// Reads the devices and modules that `source` describes, and the files that it refers to. Everything that had to be
/// repaired goes to `diagnostics`.
///
/// Returns `None`, with one error, for a file that isn't well formed.
pub fn read(
    source: &Source,
    file: FileId,
    references: &mut References<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Catalog> {
    let mut description = Description::default();
    let mut budget = Budget::new(source.text().len());
    if let Err(stop) = document(source, file, &mut description, diagnostics, &mut budget) {
        diagnostics.push(*stop);
        return None;
    }
    references::follow(source, &mut description, references, diagnostics, &mut budget);
    modules::plug(&mut description.catalog, diagnostics);
    Some(description.catalog)
}

/// Reads one file.
fn document(
    source: &Source,
    file: FileId,
    description: &mut Description,
    diagnostics: &mut Diagnostics,
    budget: &mut Budget,
) -> Read<()> {
    declared_encoding::report(source, file, diagnostics);
    let templates = Templates::of(source.text(), file);
    let mut reader = Reader { cursor: Cursor::new(source.text(), file), diagnostics, budget, templates: &templates };
    let root = reader.cursor.root()?;
    match root.name {
        "EtherCATInfo" | "EtherCATModule" => info::read(&mut reader, &root, description)?,
        "EtherCATInfoList" => {
            while let Some(tag) = reader.cursor.child(&root)? {
                match tag.name {
                    "EtherCATInfo" => info::read(&mut reader, &tag, description)?,
                    _ => reader.unknown(&tag, &mut description.catalog.extensions)?,
                }
            }
        }
        "EtherCATDict" => dictionary_only(&mut reader, &root, description)?,
        "EtherCATDiag" => messages_only(&mut reader, &root, description)?,
        name => {
            let message = format!("<{}> is no root of a description of ETG.2000", reader::shortened(name));
            return Err(Box::new(Diagnostic::new(&codes::UNKNOWN_FORMAT, root.name_span(), message)));
        }
    }
    behind_root(&mut reader);
    Ok(())
}

/// Whatever follows the root element is left out.
fn behind_root(reader: &mut Reader<'_, '_>) {
    loop {
        match reader.cursor.read() {
            Ok(Some(_)) => {}
            Ok(None) => return,
            Err(error) => {
                let found = error.into_diagnostic();
                let message = format!("something follows the root element: {}", found.message);
                reader.report(&codes::SECOND_ROOT, found.span, message, "left out from here on");
                return;
            }
        }
    }
}

/// A dictionary without a device.
fn dictionary_only<'a>(reader: &mut Reader<'a, '_>, root: &Tag<'a>, description: &mut Description) -> Read<()> {
    let origin = reader.cursor.origin(root);
    let mut device = Device { dictionary_only: true, origin, ..Device::default() };
    let [version] = reader.fields(root, &["Version"], &mut device.extensions)?;
    device.header.format_version = version.compact();
    let mut dictionary = Dictionary::default();
    while let Some(tag) = reader.cursor.child(root)? {
        match tag.name {
            "Dictionary" => dictionary.read(reader, &tag)?,
            _ => reader.unknown(&tag, &mut device.extensions)?,
        }
    }
    device.extensions.append(&mut dictionary.take_extensions());
    let lowered =
        device::lower(reader, dictionary, Pdos::default(), &mut device.process_data, &mut Elsewhere::default());
    (device.types, device.groups) = lowered;
    device.ethercat = Some(Box::default());
    description.catalog.devices.push(device);
    Ok(())
}

/// Diagnosis messages without a device.
fn messages_only<'a>(reader: &mut Reader<'a, '_>, root: &Tag<'a>, description: &mut Description) -> Read<()> {
    let catalog = &mut description.catalog;
    let [version] = reader.fields(root, &["Version"], &mut catalog.extensions)?;
    reader::note("EtherCATDiag@Version", &version, &mut catalog.extensions);
    while let Some(tag) = reader.cursor.child(root)? {
        match tag.name {
            "DiagMessages" => {
                let tables = diagnosis::read(reader, &tag, &mut catalog.extensions)?;
                catalog.code_tables.extend(tables);
            }
            _ => reader.unknown(&tag, &mut catalog.extensions)?,
        }
    }
    Ok(())
}
