//! Compares ESI files with lxml's XPath: devices, modules, PDOs and settings. The module `esi_objects` compares the
//! objects.

use lexibus_codegen::compile::check;
use lexibus_codegen::ir::{
    Catalog, ClockMode, Device, Direction, EtherCatSettings, Fit, InitCommand, Module, Pdo, Slot, SyncManager, TypeDef,
};

use super::corpus_support::round_trip::{options, source};
use super::esi_objects::{data_types, objects};
use super::esi_reasons::{reason, rejection, Case, REASONS};
use super::facts::{put, put_flag, put_number, put_some, Elements, Facts};
use super::peer::answers;
use super::tally::Tally;
use super::values::{hex, put_documentation, put_names, type_name};

#[test]
fn xpath_reads_the_same_facts_from_esi() {
    let Some(answers) = answers("esi") else { return };
    let mut tally = Tally::new("ESI", REASONS);
    for (file, answer) in &answers {
        let compilation = check(source(file), &options());
        for error in &answer.errors {
            tally.rejected(&file.name, error, rejection(error));
        }
        let Some(peer) = &answer.elements else { continue };
        let elements = compilation.catalog.as_ref().map(elements).unwrap_or_default();
        let case = Case::new(file, peer, &elements);
        tally.file(&file.name, peer, &elements, |difference| reason(&case, &difference));
    }
    tally.finish(555_000);
}

/// Returns the facts that Lexibus reads from a file.
fn elements(catalog: &Catalog) -> Elements {
    let mut elements = Elements::new();
    for (at, catalog) in catalog.devices.iter().enumerate() {
        device(&mut elements, &format!("device {at}"), catalog);
    }
    for (at, catalog) in catalog.modules.iter().enumerate() {
        module(&mut elements, &format!("module {at}"), catalog);
    }
    elements
}

fn device(elements: &mut Elements, owner: &str, device: &Device) {
    let default = EtherCatSettings::default();
    let settings = device.ethercat.as_deref().unwrap_or(&default);
    elements.insert(owner.to_owned(), header(device, settings));
    for (at, fmmu) in settings.fmmus.iter().enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "purpose", fmmu.purpose.as_str());
        put_some(&mut facts, "Sm", fmmu.sync_manager);
        put_some(&mut facts, "Su", fmmu.sync_unit);
        put_flag(&mut facts, "OP only", fmmu.op_only);
        elements.insert(format!("{owner} FMMU {at}"), facts);
    }
    for (at, entry) in device.process_data.sync_managers.iter().enumerate() {
        elements.insert(format!("{owner} Sm {at}"), sync_manager(entry));
    }
    for (at, settings) in settings.clocks.iter().flat_map(|clocks| &clocks.modes).enumerate() {
        elements.insert(format!("{owner} mode {at}"), mode(settings));
    }
    if let Some(slots) = &settings.slots {
        let mut facts = Facts::new();
        put_some(&mut facts, "most", slots.max_slots);
        put_some(&mut facts, "groups", slots.max_groups);
        put_flag(&mut facts, "download", slots.download_idents);
        elements.insert(format!("{owner} slots"), facts);
    }
    for (at, entry) in device.slots.iter().enumerate() {
        elements.insert(format!("{owner} slot {at}"), slot(entry));
    }
    let coe = settings.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref());
    commands(elements, owner, coe.map_or(&[], |coe| &coe.init_commands));
    pdos(elements, owner, &device.process_data.pdos, &device.types);
    data_types(elements, owner, &device.types);
    objects(elements, owner, &device.groups, &device.types);
}

fn header(device: &Device, settings: &EtherCatSettings) -> Facts {
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &device.name, &device.names);
    put_documentation(&mut facts, "comment", device.documentation.as_deref());
    put(&mut facts, "type", device.id.as_str());
    put_some(&mut facts, "product code", device.identity.product_code);
    put_some(&mut facts, "revision", device.identity.revision_number);
    put(&mut facts, "vendor", device.identity.vendor_name.as_str());
    put_some(&mut facts, "vendor number", device.identity.vendor_id);
    put(&mut facts, "physics", settings.physics.as_str());
    put(&mut facts, "group", settings.group.as_str());
    if let Some(eeprom) = &settings.eeprom {
        put_some(&mut facts, "EEPROM size", eeprom.byte_size);
        put(&mut facts, "EEPROM configuration", hex(&eeprom.config_data));
        put(&mut facts, "EEPROM boot-strap", hex(&eeprom.boot_strap));
    }
    if let Some(coe) = settings.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref()) {
        let flags = [
            ("SdoInfo", coe.sdo_info),
            ("PdoAssign", coe.pdo_assign),
            ("PdoConfig", coe.pdo_config),
            ("PdoUpload", coe.pdo_upload),
            ("CompleteAccess", coe.complete_access),
            ("SegmentedSdo", coe.segmented_sdo),
        ];
        let set: Vec<&str> = flags.iter().filter(|(_, set)| *set).map(|(name, _)| *name).collect();
        put(&mut facts, "CoE", set.join(" "));
    }
    facts
}

fn module(elements: &mut Elements, owner: &str, module: &Module) {
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &module.name, &module.names);
    put(&mut facts, "type", module.id.as_str());
    put(&mut facts, "ident", module.number.to_string());
    put(&mut facts, "class", module.class.as_str());
    put(&mut facts, "vendor", module.identity.vendor_name.as_str());
    put_some(&mut facts, "vendor number", module.identity.vendor_id);
    elements.insert(owner.to_owned(), facts);
    commands(elements, owner, module.init_commands());
    pdos(elements, owner, &module.process_data.pdos, &module.types);
    data_types(elements, owner, &module.types);
    objects(elements, owner, &module.groups, &module.types);
}

fn sync_manager(sync_manager: &SyncManager) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "purpose", sync_manager.purpose.label());
    put_number(&mut facts, "address", sync_manager.start_address);
    put_some(&mut facts, "size", sync_manager.default_size);
    put_some(&mut facts, "least", sync_manager.size_range.0);
    put_some(&mut facts, "most", sync_manager.size_range.1);
    put_number(&mut facts, "control", sync_manager.control);
    put_number(&mut facts, "enable", u8::from(sync_manager.enable));
    put_flag(&mut facts, "OP only", sync_manager.op_only);
    put_flag(&mut facts, "virtual", sync_manager.is_virtual);
    facts
}

fn mode(mode: &ClockMode) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "name", mode.name.as_str());
    put(&mut facts, "description", mode.description.as_str());
    put_number(&mut facts, "assign", mode.assign_activate);
    let times = [
        ("CycleTimeSync0", mode.cycle_sync0),
        ("ShiftTimeSync0", mode.shift_sync0),
        ("CycleTimeSync1", mode.cycle_sync1),
        ("ShiftTimeSync1", mode.shift_sync1),
    ];
    for (name, time) in times {
        put_number(&mut facts, name, time.nanoseconds);
        put_some(&mut facts, &format!("{name} factor"), time.factor);
    }
    facts
}

fn slot(slot: &Slot) -> Facts {
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &slot.name, &slot.names);
    put(&mut facts, "least", slot.instances.0.to_string());
    put(&mut facts, "most", slot.instances.1.to_string());
    put_some(&mut facts, "group", slot.group);
    put(&mut facts, "SlotIndexIncrement", slot.index_increment.to_string());
    put(&mut facts, "SlotPdoIncrement", slot.pdo_increment.to_string());
    put(&mut facts, "SlotGroupIndexIncrement", slot.group_index_increment.to_string());
    put(&mut facts, "SlotGroupPdoIncrement", slot.group_pdo_increment.to_string());
    let idents = slot.fits.iter().filter_map(|fit| if let Fit::Ident(ident) = fit { Some(ident) } else { None });
    put(&mut facts, "idents", idents.map(ToString::to_string).collect::<Vec<_>>().join(" "));
    let classes =
        slot.fits.iter().filter_map(|fit| if let Fit::Class(class) = fit { Some(class.as_str()) } else { None });
    put(&mut facts, "classes", classes.collect::<Vec<_>>().join(" / "));
    facts
}

fn commands(elements: &mut Elements, owner: &str, commands: &[InitCommand]) {
    for (at, entry) in commands.iter().enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "transitions", entry.transitions.join(" "));
        put(&mut facts, "index", entry.index.to_string());
        put_number(&mut facts, "sub-index", entry.sub_index);
        put(&mut facts, "data", hex(&entry.data));
        put_flag(&mut facts, "complete", entry.complete_access);
        put_flag(&mut facts, "fixed", entry.fixed);
        put_flag(&mut facts, "by slot", entry.depends_on_slot);
        put(&mut facts, "comment", entry.comment.as_str());
        elements.insert(format!("{owner} command {at}"), facts);
    }
}

fn pdos(elements: &mut Elements, owner: &str, pdos: &[Pdo], types: &[TypeDef]) {
    for (kind, direction) in [("RxPdo", Direction::Receive), ("TxPdo", Direction::Transmit)] {
        for (at, item) in pdos.iter().filter(|pdo| pdo.direction == direction).enumerate() {
            let key = format!("{owner} {kind} {at}");
            for (place, entry) in item.entries.iter().enumerate() {
                let mut facts = Facts::new();
                put_number(&mut facts, "index", entry.index);
                put_number(&mut facts, "sub-index", entry.sub_index);
                put(&mut facts, "bits", entry.bits.to_string());
                put_names(&mut facts, "name", &entry.name, &entry.names);
                put(&mut facts, "type", type_name(entry.ty, types));
                put_flag(&mut facts, "fixed", entry.fixed);
                put_flag(&mut facts, "by slot", entry.depends_on_slot);
                elements.insert(format!("{key} entry {place}"), facts);
            }
            elements.insert(key, pdo(item));
        }
    }
}

fn pdo(pdo: &Pdo) -> Facts {
    let mut facts = Facts::new();
    put_number(&mut facts, "index", pdo.mapping_index);
    put_names(&mut facts, "name", &pdo.name, &pdo.names);
    put_some(&mut facts, "Sm", pdo.sync_manager);
    put_some(&mut facts, "Su", pdo.sync_unit);
    put_flag(&mut facts, "fixed", pdo.fixed);
    put_flag(&mut facts, "mandatory", pdo.mandatory);
    put_flag(&mut facts, "virtual", pdo.is_virtual);
    put_flag(&mut facts, "by slot", pdo.depends_on_slot);
    put(&mut facts, "excludes", pdo.excludes.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "));
    let excluded = pdo.excluded_sync_managers.iter().map(ToString::to_string);
    put(&mut facts, "excluded Sms", excluded.collect::<Vec<_>>().join(" "));
    facts
}
