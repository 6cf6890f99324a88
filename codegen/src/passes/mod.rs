//! Passes over the IR, each named after the guarantee that it gives.
//!
//! [`check`] runs those that every output needs. A pass reports a broken element, leaves it as it is or sets it aside,
//! and goes on: after the first error come the others.

mod access_checked;
mod aliases_agree;
mod bit_fields_checked;
mod conditions_possible;
mod conditions_signed;
mod conversions_agree;
mod declared_pdos_checked;
mod directions_agree;
mod firmware_comparable;
mod identity_agrees;
mod implicit_pdos_exist;
mod lengths_checked;
mod limits_complete;
mod limits_named;
mod mapped_objects_exist;
mod mapping_steps_checked;
mod mentioned_objects_exist;
mod message_examples_agree;
mod message_frames;
mod messages_checked;
pub(crate) mod messages_shaped;
mod modbus_frames_agree;
mod modules_fit;
mod names_in_texts_exist;
mod names_tell_apart;
pub mod names_unique;
mod numbers_count_on;
mod objects_checked;
pub(crate) mod pdo_entries_resolved;
mod pdo_layout_checked;
mod physical;
mod procedures_possible;
mod process_image_checked;
mod quantities_agree;
mod records_checked;
mod subslots_distinct;
pub(crate) mod texts;
mod titles_are_no_names;
pub(crate) mod values_checked;
mod values_named_once;
mod windows;
mod windows_fit;
mod windows_possible;

use crate::diagnostics::Diagnostics;
use crate::ir::owner::Owner;
use crate::ir::{Catalog, CompactString, Device, Format, Module};
pub(crate) use firmware_comparable::apart;
use windows::Windows;

/// Completes and checks every device of `catalog`.
pub fn check(catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    // The first file describes the devices; the others only refer to it, or are overlays.
    let format = catalog.files.first().map(|file| file.format);
    for own in &mut catalog.devices {
        device(own, &catalog.modules, format, diagnostics);
    }
    for own in &mut catalog.modules {
        module(own, diagnostics);
    }
    records(catalog, diagnostics);
    modules_fit::run(catalog, diagnostics);
    subslots_distinct::run(catalog, diagnostics);
}

fn device(device: &mut Device, modules: &[Module], format: Option<Format>, diagnostics: &mut Diagnostics) {
    let is_table = format == Some(Format::Table);
    if is_table {
        declared_pdos_checked::run(device, diagnostics);
    }
    conditions_signed::run(device);
    identity_agrees::run(device, diagnostics);
    objects_checked::run(device, modules, format, diagnostics);
    values_checked::run(device.groups.iter(), &device.types, diagnostics);
    implicit_pdos_exist::run(device);
    pdo_layout_checked::run(device, modules, diagnostics);
    if device.ethercat.is_some() {
        pdo_entries_resolved::device(device, diagnostics);
        if !is_table {
            directions_agree::device(device, diagnostics);
        }
        mapped_objects_exist::device(device);
        process_image_checked::run(device, diagnostics);
    }
    let groups = [device.groups.as_slice()];
    meanings(Owner { types: &device.types, groups: &groups }, diagnostics);
    values_named_once::codes(device.code_tables.iter(), diagnostics);
    facts(device, is_table, diagnostics);
    if is_table {
        messages_shaped::run(device, diagnostics);
        messages_checked::run(device, diagnostics);
        quantities_agree::run(device, diagnostics);
        conversions_agree::run(device, diagnostics);
        modbus_frames_agree::run(device, diagnostics);
        numbers_count_on::run(device, diagnostics);
        mentioned_objects_exist::run(device, diagnostics);
        names_in_texts_exist::run(device, diagnostics);
        windows(device, diagnostics);
    }
}

/// The windows of a register table.
fn windows(device: &Device, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let Some(windows) = Windows::of(Owner { types: &device.types, groups: &groups }) else { return };
    windows_fit::run(&windows, &device.procedures, diagnostics);
    windows_possible::run(&windows, diagnostics);
}

fn module(module: &mut Module, diagnostics: &mut Diagnostics) {
    pdo_layout_checked::module(module, diagnostics);
    pdo_entries_resolved::module(module, diagnostics);
    directions_agree::module(module, diagnostics);
    mapped_objects_exist::module(module);
    process_image_checked::module(module, diagnostics);
    values_checked::run(module.fixed_objects.iter().chain(&module.groups), &module.types, diagnostics);
    let groups = [module.fixed_objects.as_slice(), module.groups.as_slice()];
    meanings(Owner { types: &module.types, groups: &groups }, diagnostics);
}

/// The parameter records of PROFINET. Their lists of values are shared by parameters of several types and limits.
fn records(catalog: &Catalog, diagnostics: &mut Diagnostics) {
    for submodule in &catalog.submodules {
        values_checked::run(submodule.records.iter(), &catalog.types, diagnostics);
        records_checked::run(submodule.records.iter(), diagnostics);
    }
    let settings = catalog.devices.iter().filter_map(|device| device.profinet.as_ref());
    let blocks = || settings.clone().flat_map(|settings| &settings.vendor_blocks).map(|block| &block.record);
    values_checked::run(blocks(), &catalog.types, diagnostics);
    records_checked::run(blocks(), diagnostics);
}

/// What bits, values, limits and lengths say was held against each other.
fn meanings(owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    bit_fields_checked::run(owner, diagnostics);
    values_named_once::run(owner, diagnostics);
    limits_named::run(owner, diagnostics);
    lengths_checked::run(owner, diagnostics);
}

/// What rows say, be it those of a table or of an overlay.
fn facts(device: &Device, is_table: bool, diagnostics: &mut Diagnostics) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    access_checked::run(owner, is_table, diagnostics);
    limits_named::both_given(owner, diagnostics);
    if is_table {
        limits_complete::run(owner, diagnostics);
    }
    conditions_possible::run(owner, diagnostics);
    names_tell_apart::run(device, is_table, diagnostics);
    titles_are_no_names::run(owner, diagnostics);
    firmware_comparable::run(device, diagnostics);
    aliases_agree::run(device, diagnostics);
    message_examples_agree::run(device, diagnostics);
    if is_table || !device.procedures.is_empty() {
        procedures_possible::run(device, diagnostics);
        mapping_steps_checked::run(device, diagnostics);
    }
}

/// A name that any number of entries may get from one object.
fn short(name: &CompactString) -> CompactString {
    const LONG: usize = 512;
    if name.len() > LONG {
        crate::text::brief(name).into()
    } else {
        name.clone()
    }
}
