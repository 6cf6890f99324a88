//! Compares modular devices: slots and pluggable modules.

use super::change::Judgment;
use super::comparison::{
    compare_fields, each, fact, fact_as, judged, list, optional, or_default, part, rules, slice, text, Comparison,
    Elements, COMPARED, KEY, POSITION,
};
use super::conditions::restricted;
use super::ethercat::mailbox;
use super::identity::identity;
use super::show::index;
use super::slots::{self, Use};
use super::texts::{documentation, extensions, renamed};
use super::{groups, item, pdos, profinet, types};
use lexibus_codegen::ir::{Catalog, Module, ModuleUse, ObjectBuses, ProcessData, Slot, SubExtension};

/// Compares slots, which are paired by number.
pub(super) fn slots() -> Elements<Slot> {
    Elements::titled(|slot: &Slot| format!("slot {}", slot.number))
}

rules!(pub(super) fn slot(Slot) {
    name: text("name"),
    instances: fact("minimum and maximum number of modules", Judgment::BEHAVIOR),
    names,
    fits: restricted("fitting modules"),
    default: fact("default module", Judgment::BEHAVIOR),
    group: fact("slot group", Judgment::WIRE),
    index_increment: fact_as("index increment", Judgment::WIRE, index),
    pdo_increment: fact("PDO increment", Judgment::WIRE),
    group_index_increment: fact_as("index increment of the group", Judgment::WIRE, index),
    group_pdo_increment: fact("PDO increment of the group", Judgment::WIRE),
}, KEY => [number]);

/// Returns the key that pairs modules: their number or ident number, and their identifier.
pub(super) fn key(module: &Module) -> String {
    format!("{:08X} {}", module.number, module.id)
}

/// Compares which modules fit a device, and into which slots each module fits.
pub(super) fn compare_uses(old: &[ModuleUse], new: &[ModuleUse], comparison: &mut Comparison<'_>) {
    let used = |catalog: &Catalog, one: &ModuleUse| {
        let module = catalog.modules.get(one.module.0 as usize).map(|module| (module.name.as_str(), key(module)));
        Use::new("module", one.module.0, module, &one.places)
    };
    slots::compare_uses(old, new, used, comparison);
}

/// Compares all facts of a module.
pub(super) fn compare(old: &Module, new: &Module, comparison: &mut Comparison<'_>) {
    let all = |module: &Module| [module.fixed_objects.as_slice(), &module.groups].concat();
    compare_fields!(Module, old, new, comparison, {
        class: part("module", fact("class", Judgment::BEHAVIOR)),
        name: part("module", judged("name", renamed)),
        names: part("module", text("name in other languages")),
        version: part("module", text("version")),
        revision: part("module", text("revision")),
        identity: part("module", identity),
        comments: part("module", text("comments")),
        documentation: part("module", or_default(documentation)),
        fixed_objects: |_: &_, _: &_, comparison: &mut Comparison<'_>| {
            groups::compare(&all(old), &all(new), comparison);
        },
        sub_extensions: list(
            Elements::titled(|extension: &SubExtension| format!("entries added to {}", index(&extension.index))),
            sub_extension,
        ),
        process_data: |old: &ProcessData, new: &ProcessData, comparison: &mut Comparison<'_>| {
            pdos::compare(old, new, ObjectBuses::COE, comparison);
        },
        pdo_group: part("module", fact("module PDO group", Judgment::WIRE)),
        mailbox: part("module", optional("mailbox", Judgment::ADDITION, Judgment::API_AND_WIRE, mailbox)),
        clock_mode: part("module", fact("mode of the distributed clocks", Judgment::BEHAVIOR)),
        add_info: part("module", fact("additional profile number", Judgment::BEHAVIOR)),
        sub_add_info: part("module", fact("further additional profile number", Judgment::BEHAVIOR)),
        attributes: part("module", fact("attributes", Judgment::BEHAVIOR)),
        submodules: part("module", slice(profinet::compare_uses)),
        subslots: part("module", fact("subslots", Judgment::BEHAVIOR)),
        subslot_names: part("module", each("names of subslots", Judgment::NONE, profinet::subslot_name)),
        profiles: part("module", fact("profiles", Judgment::BEHAVIOR)),
        extensions: part("module", extensions),
    }, KEY => [number, id], COMPARED => [types, groups], POSITION => [origin]);
    types::compare_unused(comparison);
}

rules!(fn sub_extension(SubExtension) {
    count: fact("number of entries", Judgment::WIRE),
    per: fact("modules of one entry", Judgment::WIRE),
    extends_object: fact("continues at the next index", Judgment::WIRE),
    template: item::compare,
}, KEY => [index]);
