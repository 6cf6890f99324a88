//! EtherCAT: what a master has to know of a slave, and the process image by default.

mod descriptor;
mod image;
mod startup;

use std::collections::HashMap;

use super::data::Data;
use super::literal;
use super::pdo::{PdoModel, PdoModels};
use crate::ir::{ClockMode, ClockTime, Device, EtherCatSettings, Fmmu, Module, ModuleId, Pdo};

pub(super) use image::ImageModel;

/// What a device has beside objects and PDOs.
pub(super) struct EtherCatModel {
    /// `DEVICE`.
    pub device: String,
    /// `FMMUS`.
    pub fmmus: Option<String>,
    /// `CLOCK_MODES`.
    pub clock_modes: Option<String>,
    /// `STARTUP`.
    pub startup: Option<String>,
    /// Constants of bytes: name, what it is, value.
    pub bytes: Vec<(&'static str, &'static str, String)>,
    /// The images by default.
    pub images: Vec<ImageModel>,
}

/// Where the constants of modules are, by the position of the module in the catalogue.
pub(super) type ModulePaths = HashMap<ModuleId, String>;

/// Renders data for a constant of this name and type, `nest` bytes further to the right than its place in the template.
fn constant(data: &Data, name: &str, ty: &str, nest: usize) -> String {
    data.render(0, format!("pub const {name}: {ty} = ").len(), 1, nest)
}

impl EtherCatModel {
    pub(super) fn new(device: &Device, pdos: &[PdoModel], modules: &ModulePaths, nest: usize) -> Option<Self> {
        let settings = device.ethercat.as_deref().filter(|_| !device.dictionary_only)?;
        let assigned = assigned_by_default(device);
        let pdos = PdoModels::new(pdos);
        let descriptor = descriptor::device(device, settings, &pdos, modules, &assigned);
        let column = "pub static DEVICE: rt::ethercat::Device = ".len();
        let clocks = settings.clocks.as_ref().filter(|clocks| !clocks.modes.is_empty());
        let list = |list: Vec<Data>, name: &str, ty: &str| {
            (!list.is_empty()).then(|| constant(&Data::Slice(list), name, ty, nest))
        };
        Some(EtherCatModel {
            device: descriptor.render(0, column, 1, nest),
            fmmus: list(settings.fmmus.iter().map(fmmu).collect(), "FMMUS", "&[rt::ethercat::Fmmu]"),
            clock_modes: clocks.and_then(|clocks| {
                let modes = clocks.modes.iter().map(clock_mode).collect();
                list(modes, "CLOCK_MODES", "&[rt::ethercat::ClockMode]")
            }),
            startup: list(startup::commands(device, settings, &assigned), "STARTUP", "&[rt::SdoWrite]"),
            bytes: bytes(settings),
            images: image::models(&pdos, &assigned),
        })
    }
}

/// `MODULE` of a module.
pub(super) fn module(module: &Module, pdos: &[PdoModel], nest: usize) -> String {
    let column = "pub static MODULE: rt::ethercat::Module = ".len();
    descriptor::module(module, &PdoModels::new(pdos)).render(0, column, 1, nest)
}

/// What an index grows with that is the same in every slot.
const NOTHING: &str = "rt::ethercat::DependsOn::Nothing";

/// What an index grows with.
pub(super) fn depends_on(slot: bool, group: bool) -> &'static str {
    match (slot, group) {
        (false, false) => NOTHING,
        (true, false) => "rt::ethercat::DependsOn::Slot",
        (false, true) => "rt::ethercat::DependsOn::SlotGroup",
        (true, true) => "rt::ethercat::DependsOn::Both",
    }
}

/// A PDO that is assigned by default, with its sync manager.
pub(super) struct Assigned<'a> {
    pub pdo: &'a Pdo,
    pub sync_manager: u8,
}

fn assigned_by_default(device: &Device) -> Vec<Assigned<'_>> {
    let assigned = device.process_data.assigned_by_default();
    assigned.into_iter().map(|(pdo, sync_manager)| Assigned { pdo, sync_manager }).collect()
}

fn fmmu(fmmu: &Fmmu) -> Data {
    let purpose = match fmmu.purpose.as_str() {
        "Outputs" => "Outputs",
        "Inputs" => "Inputs",
        "MBoxState" => "MailboxState",
        _ => "Other",
    };
    Data::Struct(
        "rt::ethercat::Fmmu",
        vec![
            ("purpose", Data::text(format!("rt::ethercat::FmmuPurpose::{purpose}"))),
            ("sync_manager", Data::option(fmmu.sync_manager)),
            ("op_only", Data::flag(fmmu.op_only)),
        ],
    )
}

fn clock_mode(mode: &ClockMode) -> Data {
    let time = |time: &ClockTime| {
        let factor = time.factor.unwrap_or(0);
        Data::text(format!("rt::ethercat::ClockTime::new({}, {factor})", time.nanoseconds))
    };
    Data::Struct(
        "rt::ethercat::ClockMode",
        vec![
            ("name", Data::text(literal::string(&mode.name))),
            ("description", Data::text(literal::string(&mode.description))),
            ("assign_activate", Data::index(mode.assign_activate as u16)),
            ("cycle_sync0", time(&mode.cycle_sync0)),
            ("shift_sync0", time(&mode.shift_sync0)),
            ("cycle_sync1", time(&mode.cycle_sync1)),
            ("shift_sync1", time(&mode.shift_sync1)),
        ],
    )
}

fn bytes(settings: &EtherCatSettings) -> Vec<(&'static str, &'static str, String)> {
    let Some(eeprom) = &settings.eeprom else { return Vec::new() };
    let all = [
        ("EEPROM", "Content of the EEPROM.", &eeprom.data),
        (
            "EEPROM_CONFIG_DATA",
            "First words of the EEPROM: configuration of the slave controller.",
            &eeprom.config_data,
        ),
        ("EEPROM_BOOT_STRAP", "Mailbox of the bootstrap state, as the EEPROM has it.", &eeprom.boot_strap),
    ];
    let given = all.into_iter().filter(|(.., bytes)| !bytes.is_empty());
    given.map(|(name, what, bytes)| (name, what, literal::bytes(bytes))).collect()
}
