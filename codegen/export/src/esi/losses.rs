//! Notes about facts that ETG.2000 cannot express.

use super::{diagnosis, Context};
use crate::note::{self, NoteKind, Notes, Subject};
use lexibus_codegen::ir::{Device, Module};

/// Adds notes for facts of the catalog that ETG.2000 cannot express, except those of devices and modules.
pub(super) fn of_catalog(context: &Context<'_>, notes: &mut Notes) {
    let catalog = context.catalog;
    let mut parts = catalog.submodules.len() + catalog.unit_diagnoses.len() + catalog.code_tables.len();
    parts += catalog.unused_texts.len() + usize::from(catalog.profile_header.is_some());
    if !context.is_esi {
        parts += catalog.families.len() + catalog.graphics.len();
    }
    notes.add_many(NoteKind::OtherPart, parts, Subject::Device);
}

/// Adds notes for facts of a device that ETG.2000 cannot express.
pub(super) fn of_device(context: &Context<'_>, device: &Device, notes: &mut Notes) {
    let subject = Subject::Named(&device.name);
    let other_buses = usize::from(device.canopen.is_some() && device.ethercat.is_none())
        + usize::from(device.profinet.is_some())
        + device.modbus.len();
    notes.add_many(NoteKind::OtherBus, other_buses, subject);
    notes.add_many(NoteKind::Configuration, device.commissioning.is_some(), subject);
    let parts = note::parts_of_tables(device)
        + device.code_tables.iter().filter(|table| !diagnosis::is_list(table)).count()
        + device.submodules.len()
        + device.process_data.images.len();
    notes.add_many(NoteKind::OtherPart, parts, subject);
    note::of_device(context.catalog, device, notes, subject);
    notes.add_many(NoteKind::Extension, device.extensions.len(), subject);
    note::of_chapters(device, notes);
    if !context.is_esi {
        let header = &device.header;
        let texts = [&header.file_version, &header.file_revision, &header.description, &header.created_by];
        let lost = texts.iter().filter(|text| !text.is_empty()).count() + header.comments.len();
        notes.add_many(NoteKind::FileInfo, lost, subject);
    }
}

/// Adds notes for facts of a module that ETG.2000 cannot express.
pub(super) fn of_module(module: &Module, notes: &mut Notes) {
    let subject = Subject::Named(&module.name);
    notes.add_many(NoteKind::Documentation, module.documentation.is_some(), subject);
    notes.add_many(NoteKind::Module, module.submodules.len() + module.fixed_objects.len(), subject);
}
