//! The EtherCAT settings of a device as statics and constants.

use super::super::code::{Data, Doc};
use super::super::literal;
use super::super::pdo::{PdoModel, PdoModels};
use super::ImageModel;
use super::{descriptor, image, startup};
use crate::collections::HashMap;
use crate::ir::{ClockMode, ClockTime, Device, EtherCatSettings, Fmmu, Module, ModuleId};

/// The description of a device for an EtherCAT master, ready to be printed.
pub(in super::super) struct EtherCatModel {
    /// Value of the static `DEVICE`.
    pub device: Doc,
    /// Value of the constant `FMMUS`.
    pub fmmus: Option<Doc>,
    /// Value of the constant `CLOCK_MODES`.
    pub clock_modes: Option<Doc>,
    /// Value of the constant `STARTUP`.
    pub startup: Option<Doc>,
    /// Constants with byte sequences: name, documentation and value of each constant.
    pub bytes: Vec<(&'static str, &'static str, String)>,
    /// Default process images.
    pub images: Vec<ImageModel>,
}

/// Paths of the modules' statics `MODULE`, by the module's position in the catalog.
pub(in super::super) type ModulePaths = HashMap<ModuleId, String>;

impl EtherCatModel {
    pub(in super::super) fn new(device: &Device, pdos: &[PdoModel], modules: &ModulePaths) -> Option<Self> {
        let settings = device.ethercat.as_deref().filter(|_| !device.dictionary_only)?;
        let assigned = device.process_data.assigned_by_default();
        let pdos = PdoModels::new(pdos);
        let descriptor = descriptor::device(device, settings, &pdos, modules, &assigned);
        let clocks = settings.clocks.as_ref().filter(|clocks| !clocks.modes.is_empty());
        let list = |list: Vec<Doc>| (!list.is_empty()).then(|| Data::slice(list));
        Some(EtherCatModel {
            device: descriptor,
            fmmus: list(settings.fmmus.iter().map(fmmu).collect()),
            clock_modes: clocks.and_then(|clocks| list(clocks.modes.iter().map(clock_mode).collect())),
            startup: list(startup::commands(device, settings, &assigned)),
            bytes: bytes(settings),
            images: image::models(&pdos, &assigned),
        })
    }
}

/// Returns the value of the static `MODULE`.
pub(in super::super) fn module(module: &Module, pdos: &[PdoModel]) -> Doc {
    descriptor::module(module, &PdoModels::new(pdos))
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

fn bytes(settings: &EtherCatSettings) -> Vec<(&'static str, &'static str, String)> {
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
    given.map(|(name, documentation, bytes)| (name, documentation, literal::bytes(bytes))).collect()
}
