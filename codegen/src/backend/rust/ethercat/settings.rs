//! The EtherCAT settings of a device as statics and constants.

use super::super::code::{seq, Data, Declaration, Doc};
use super::super::literal;
use super::super::pdo::{PdoModel, PdoModels};
use super::ImageModel;
use super::{descriptor, image, startup};
use crate::collections::HashMap;
use crate::ir::{ClockMode, ClockTime, Device, EtherCatSettings, Fmmu, Module, ModuleId};

/// Paths of the modules' statics `MODULE`, by the module's position in the catalog.
pub(in super::super) type ModulePaths = HashMap<ModuleId, String>;

/// Returns the statics and constants that describe a device for an EtherCAT master, and the default process images.
pub(in super::super) fn device(
    device: &Device,
    title: &str,
    pdos: &[PdoModel],
    modules: &ModulePaths,
) -> Option<(Vec<Declaration>, Vec<ImageModel>)> {
    let settings = device.ethercat.as_deref().filter(|_| !device.dictionary_only)?;
    let assigned = device.process_data.assigned_by_default();
    let pdos = PdoModels::new(pdos);
    let descriptor = descriptor::device(device, settings, &pdos, modules, &assigned);
    let mut all = vec![description(title, "static DEVICE: rt::ethercat::Device", descriptor)];
    let modes = settings.clocks.iter().flat_map(|clocks| &clocks.modes);
    let lists: [(&str, &str, Vec<Doc>); 3] = [
        (
            "FMMUs of the slave controller, in the order of their numbers.",
            "FMMUS: &[rt::ethercat::Fmmu]",
            settings.fmmus.iter().map(fmmu).collect(),
        ),
        (
            "Operation modes of the distributed clocks. The first mode is the default.",
            "CLOCK_MODES: &[rt::ethercat::ClockMode]",
            modes.map(clock_mode).collect(),
        ),
        (
            "SDO writes that configure the default PDO assignment. Send them in the state \"Pre-Operational\".",
            "STARTUP: &[rt::SdoWrite]",
            startup::commands(device, settings, &assigned),
        ),
    ];
    let lists = lists.into_iter().filter(|(.., list)| !list.is_empty());
    all.extend(lists.map(|(docs, name, list)| Declaration::new([docs], seq!["const ", name], Data::slice(list))));
    all.extend(bytes(settings));
    Some((all, image::models(&pdos, &assigned)))
}

/// Returns the static `MODULE`.
pub(in super::super) fn module(module: &Module, title: &str, pdos: &[PdoModel]) -> Declaration {
    description(title, "static MODULE: rt::ethercat::Module", descriptor::module(module, &PdoModels::new(pdos)))
}

fn description(title: &str, start: &str, descriptor: Doc) -> Declaration {
    Declaration::new([format!("EtherCAT description of {title} for the master.")], start, descriptor)
}

fn fmmu(fmmu: &Fmmu) -> Doc {
    let purpose = match fmmu.purpose.as_str() {
        "Outputs" => "Outputs",
        "Inputs" => "Inputs",
        "MBoxState" => "MailboxState",
        _ => "Other",
    };
    Data::fields(
        "rt::ethercat::Fmmu",
        vec![
            ("purpose", Doc::from(format!("rt::ethercat::FmmuPurpose::{purpose}"))),
            ("sync_manager", Data::option(fmmu.sync_manager)),
            ("op_only", Doc::from((fmmu.op_only).to_string())),
        ],
    )
}

fn clock_mode(mode: &ClockMode) -> Doc {
    let time = |time: &ClockTime| {
        let factor = time.factor.unwrap_or(0);
        Doc::from(format!("rt::ethercat::ClockTime::new({}, {factor})", time.nanoseconds))
    };
    Data::fields(
        "rt::ethercat::ClockMode",
        vec![
            ("name", Doc::from(literal::string(&mode.name))),
            ("description", Doc::from(literal::string(&mode.description))),
            ("assign_activate", Data::index(mode.assign_activate as u16)),
            ("cycle_sync0", time(&mode.cycle_sync0)),
            ("shift_sync0", time(&mode.shift_sync0)),
            ("cycle_sync1", time(&mode.cycle_sync1)),
            ("shift_sync1", time(&mode.shift_sync1)),
        ],
    )
}

fn bytes(settings: &EtherCatSettings) -> Vec<Declaration> {
    let Some(eeprom) = &settings.eeprom else { return Vec::new() };
    let all = [
        ("EEPROM", "Content of the EEPROM.", &eeprom.data),
        (
            "EEPROM_CONFIG_DATA",
            "Configuration of the slave controller, from the first words of the EEPROM.",
            &eeprom.config_data,
        ),
        (
            "EEPROM_BOOT_STRAP",
            "Mailbox configuration for the state \"Bootstrap\", from the EEPROM.",
            &eeprom.boot_strap,
        ),
    ];
    let given = all.into_iter().filter(|(.., bytes)| !bytes.is_empty());
    let constant = |(name, docs, bytes): (&str, &str, &Vec<u8>)| {
        Declaration::new([docs], seq!["const ", name, ": &[u8]"], literal::bytes(bytes))
    };
    given.map(constant).collect()
}
