//! Documentation of an EtherCAT segment: the pages of each SubDevice's device, and the page of the segment.

use lexibus_codegen::facts::words;
use lexibus_codegen::number::{self, bytes, hex16, hex32, hex8};
use lexibus_codegen::text::count_of;
use lexibus_site::segment::{self, Table};
use lexibus_site::{Page, Site};

use super::site::SEPARATOR;
use crate::ethercat::{
    direction_name, AssignedPdo, Clock, ClockSignal, Fmmu, PluggedModule, Segment, StartupCommand, SubDevice,
    SyncManager,
};
use crate::model::entry_name;

/// Bits of `AssignActivate`, the value of the registers 0x0980 and 0x0981, that activate SYNC0 and SYNC1.
const SYNC0_ACTIVE: u32 = 0x0200;
const SYNC1_ACTIVE: u32 = 0x0400;

/// Announces the devices of all SubDevices to the site.
pub(super) fn announce(segment: &Segment, title: &str, site: &mut Site) {
    for subdevice in &segment.subdevices {
        site.announce(&catalog_name(title, subdevice), subdevice.description.catalog());
    }
}

/// Returns the pages of a segment: those of the devices, and the page of the segment.
pub(super) fn pages(segment: &Segment, title: &str, site: &mut Site) -> Vec<Page> {
    let add = |one: &SubDevice| site.add(&catalog_name(title, one), one.description.catalog());
    let mut pages: Vec<Page> = segment.subdevices.iter().flat_map(add).collect();
    let page = segment::Segment {
        name: title.to_owned(),
        summary: words::sentence(&summary(segment)),
        subdevices: segment.subdevices.iter().map(|one| shown(title, one)).collect(),
    };
    pages.push(site.segment(&page));
    pages
}

/// Returns the number of SubDevices and the length of the process data: `1 SubDevice; 6 bytes of outputs, 7 bytes of inputs`.
pub fn summary(segment: &Segment) -> String {
    let bytes = |count: u32| count_of(count, "byte");
    let subdevices = count_of(segment.subdevices.len(), "SubDevice");
    format!("{subdevices}; {} of outputs, {} of inputs", bytes(segment.output_bytes), bytes(segment.input_bytes))
}

/// Returns the name of a SubDevice's catalog in a site. The part `EtherCAT` distinguishes it from the catalog of a CANopen node that has
/// the same name as the SubDevice.
fn catalog_name(title: &str, subdevice: &SubDevice) -> String {
    format!("{title}{SEPARATOR}EtherCAT{SEPARATOR}{}", subdevice.name)
}

fn shown(title: &str, subdevice: &SubDevice) -> segment::SubDevice {
    segment::SubDevice {
        name: subdevice.name.clone(),
        position: subdevice.position,
        catalog: catalog_name(title, subdevice),
        facts: facts(subdevice),
        tables: vec![
            modules(&subdevice.modules),
            pdos(&subdevice.pdos),
            sync_managers(&subdevice.sync_managers),
            fmmus(&subdevice.fmmus),
            startup(subdevice),
        ],
    }
}

fn facts(subdevice: &SubDevice) -> Vec<String> {
    let identity = subdevice.identity;
    let numbers = [
        ("Vendor-ID", identity.vendor_id),
        ("Product code", identity.product_code),
        ("Revision number", identity.revision_number),
    ];
    let numbers = numbers.into_iter().filter_map(|(name, number)| Some(format!("{name} {}.", hex32(number?))));
    let alias = (subdevice.alias != 0).then(|| format!("Station alias {}.", subdevice.alias));
    numbers.chain(alias).chain(subdevice.dc.as_ref().map(clock)).collect()
}

fn clock(clock: &Clock) -> String {
    let Clock { mode, assign_activate, sync0, sync1, .. } = clock;
    let signals = [("SYNC0", SYNC0_ACTIVE, sync0), ("SYNC1", SYNC1_ACTIVE, sync1)];
    let active = signals.into_iter().filter(|(_, bit, _)| assign_activate & bit != 0);
    let active: Vec<String> = active.map(|(name, _, signal)| sync_signal(name, signal)).collect();
    let active = if active.is_empty() { "no SYNC signal".to_owned() } else { active.join(", ") };
    format!("Clock mode {mode}: AssignActivate {}, {active}.", hex16(*assign_activate))
}

fn sync_signal(name: &str, signal: &ClockSignal) -> String {
    let reference = if signal.relative_to_inputs { " relative to the inputs" } else { "" };
    format!("{name} every {} ns, shifted by {} ns{reference}", signal.cycle_time, signal.shift_time)
}

fn modules(modules: &[PluggedModule]) -> Table {
    let row = |module: &PluggedModule| vec![module.slot.to_string(), hex32(module.ident), module.name.clone()];
    Table { title: "Modules", columns: &["Slot", "Ident", "Module"], rows: modules.iter().map(row).collect() }
}

fn pdos(pdos: &[AssignedPdo]) -> Table {
    let row = |pdo: &AssignedPdo| {
        let index = if pdo.index == 0 { String::new() } else { hex16(pdo.index) };
        let name = if pdo.is_padding { "Padding".to_owned() } else { pdo.name.clone() };
        let slot = pdo.slot.map_or_else(String::new, |slot| slot.to_string());
        let (manager, offset) =
            (pdo.sync_manager.to_string(), format!("{}.{}", pdo.bit_offset / 8, pdo.bit_offset % 8));
        vec![manager, offset, pdo.bits.to_string(), index, name, slot]
    };
    let columns = &["Sync manager", "Offset (byte.bit)", "Bits", "PDO", "Name", "Slot"];
    Table { title: "Process data", columns, rows: pdos.iter().map(row).collect() }
}

fn sync_managers(managers: &[SyncManager]) -> Table {
    let row = |manager: &SyncManager| {
        let SyncManager { number, purpose, start_address, length, control, .. } = manager;
        vec![
            number.to_string(),
            (*purpose).to_owned(),
            hex16(*start_address),
            length.to_string(),
            hex8(*control),
            enabled(manager.enable, manager.op_only),
        ]
    };
    let columns = &["Sync manager", "Purpose", "Start address", "Bytes", "Control register", "Enabled"];
    Table { title: "Sync managers", columns, rows: managers.iter().map(row).collect() }
}

fn fmmus(fmmus: &[Fmmu]) -> Table {
    let row = |fmmu: &Fmmu| {
        vec![
            fmmu.number.to_string(),
            fmmu.sync_manager.to_string(),
            direction_name(fmmu.direction).to_owned(),
            fmmu.logical_address.to_string(),
            fmmu.length.to_string(),
            hex16(fmmu.physical_address),
            enabled(true, fmmu.op_only),
        ]
    };
    let columns = &["FMMU", "Sync manager", "Direction", "Logical address", "Bytes", "Physical address", "Enabled"];
    Table { title: "FMMUs", columns, rows: fmmus.iter().map(row).collect() }
}

fn enabled(enable: bool, op_only: bool) -> String {
    let text = match (enable, op_only) {
        (false, _) => "no",
        (true, false) => "yes",
        (true, true) => "only in Operational",
    };
    text.to_owned()
}

fn startup(subdevice: &SubDevice) -> Table {
    let row = |command: &StartupCommand| {
        let StartupCommand { transition, index, sub_index, complete_access, data } = command;
        let object = number::object(*index, *sub_index);
        let (object, entry) = match complete_access {
            true => (format!("{object} (complete access)"), None),
            false => (object, Some(*sub_index)),
        };
        vec![(*transition).to_owned(), object, object_name(subdevice, *index, entry), bytes(data)]
    };
    let columns = &["Transition", "Object", "Name", "Bytes"];
    Table { title: "Start-up commands", columns, rows: subdevice.startup.iter().map(row).collect() }
}

/// Returns the name of an object of the device or of a module. If `sub_index` is an entry of the object, the name of the
/// entry follows. `sub_index` is `None` for the complete object. For an object that no description contains, returns its
/// purpose (ETG.1000.6, ETG.5001), or an empty text if the purpose is unknown.
fn object_name(subdevice: &SubDevice, index: u16, sub_index: Option<u8>) -> String {
    let mut devices = std::iter::once(subdevice.description.device()).chain(&subdevice.module_objects);
    let Some((device, group)) = devices.find_map(|device| Some((device, device.object(index)?))) else {
        return purpose(index);
    };
    match sub_index.filter(|sub_index| device.entry(index, *sub_index).is_some()) {
        Some(sub_index) => entry_name(device, (index, sub_index), SEPARATOR),
        None => group.name.to_string(),
    }
}

fn purpose(index: u16) -> String {
    match index {
        0x1600..=0x17FF => "RxPDO mapping".to_owned(),
        0x1A00..=0x1BFF => "TxPDO mapping".to_owned(),
        0x1C10..=0x1C2F => format!("PDO assignment of sync manager {}", index - 0x1C10),
        0xF030 => "Configured module idents".to_owned(),
        _ => String::new(),
    }
}
