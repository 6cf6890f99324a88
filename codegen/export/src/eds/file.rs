//! Writes the file section by section.

use std::collections::HashSet;

use lexibus_codegen::ir::{Catalog, Device, Format, Group, Item};

use super::super::note::Subject;
use super::super::registers;
use super::context::{is_coe_only, Context, Options};
use super::extras::Extras;
use super::writer::Writer;
use super::{header, losses, mapping, modules, object};
use super::{Export, NoteKind};

/// Exports `device`, a device of `catalog`. Returns `None` if the device has no objects and is not a CANopen device.
///
/// Lines end with CR LF (CiA 306). The file is encoded in UTF-8; it is ASCII if the device has only ASCII texts.
pub fn export(catalog: &Catalog, device: &Device, options: impl Into<Options>) -> Option<Export> {
    let Options { flavor, reals } = options.into();
    let registers = registers::objects(device, Item::object);
    let completed = registers::completed(&registers);
    let derived = [mapping::objects(device), registers].concat();
    let objects = objects(device, &derived);
    if objects.is_empty() && device.canopen.is_none() {
        return None;
    }
    let format = catalog.files.first().map(|file| file.format);
    let context = Context {
        device,
        flavor,
        reals,
        file_name: catalog.files.first().map_or("", |file| &file.name),
        is_verbatim: matches!(format, Some(Format::Eds | Format::Dcf)),
        is_canopen: device.canopen.is_some(),
    };
    let mut writer = Writer::new(context.is_verbatim);
    losses::of_device(&context, catalog, &mut writer.notes);
    writer.notes.add_many(NoteKind::Completed, completed, Subject::Device);
    let extras = Extras::new(&context, &mut writer.notes);
    for comment in &extras.preamble {
        writer.comment(&comment.value);
    }
    let mut seen = HashSet::new();
    let (objects, repeated): (Vec<&Group>, Vec<&Group>) =
        objects.into_iter().partition(|group| seen.insert(group.index()));
    repeated.into_iter().for_each(|group| writer.notes.add(NoteKind::Duplicate, Subject::object(group)));
    for section in extras.order() {
        header::write(&mut writer, &context, catalog, section, extras.of(section), &objects);
    }
    object::all(
        &mut writer,
        &context,
        objects.iter().filter(|group| group.index().is_some_and(|index| index < 0x1000)),
    );
    modules::write(&mut writer, &context, catalog);
    extras.write_unknown(&mut writer);
    let (text, notes) = writer.finish();
    Some(Export { text, notes })
}

/// Returns the objects to write, sorted by index: those of the device and those in `derived`. Leaves out the
/// EtherCAT-only objects of a CANopen device. Leaves out an object that CompactPDO implies, unless the object has
/// configured values.
fn objects<'a>(device: &'a Device, derived: &'a [Group]) -> Vec<&'a Group> {
    let compact_pdos = device.canopen.as_ref().is_some_and(|canopen| canopen.compact_pdo != 0);
    let is_configured = |group: &Group| group.items.iter().any(|item| item.configured_value().is_some());
    let is_implied = |group: &Group| {
        compact_pdos
            && group.origin.line == 0
            && matches!(group.index(), Some(0x1400..=0x1BFF))
            && !is_configured(group)
    };
    let described = device.groups.iter().filter(|group| group.index().is_some() && !is_implied(group));
    let described = described.filter(|group| !is_coe_only(device, group));
    let mut objects: Vec<&Group> = described.chain(derived).collect();
    objects.sort_by_key(|group| group.index());
    objects
}
