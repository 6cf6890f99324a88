//! The statics `DEVICE` and `MODULE`, which describe a slave or a module with the types of the runtime.

use super::{Assigned, ModulePaths};
use crate::backend::rust::code::{Data, Doc};
use crate::backend::rust::literal;
use crate::backend::rust::pdo::{mapping_entry, PdoModels};
use crate::backend::rust::slot_dependency::{depends_on, NOTHING};
use crate::ir::{
    Coe, CompactString, Device, Direction, EtherCatSettings, Fit, Group, InitCommand, Mailbox, Module, ModulePdoGroup,
    Pdo, Slot, SlotRules, SyncManager, SyncManagerPurpose,
};
use crate::number::{hex, hex16, hex32, hex8};

/// State transitions that the runtime supports.
const TRANSITIONS: [&str; 6] = ["IP", "PS", "SO", "SP", "OP", "OS"];

pub(super) fn device(
    device: &Device,
    settings: &EtherCatSettings,
    pdos: &PdoModels<'_>,
    modules: &ModulePaths,
    assigned: &[Assigned<'_>],
) -> Doc {
    let slots = settings.slots.as_deref().map(|rules| slots(device, rules, modules));
    Data::fields(
        "rt::ethercat::Device",
        vec![
            ("identity", Doc::from("IDENTITY")),
            ("sync_managers", Data::slice(device.process_data.sync_managers.iter().map(sync_manager))),
            ("pdos", pdo_list(&device.process_data.pdos, pdos)),
            ("default_pdos", Data::slice(assigned.iter().map(|(pdo, _)| Data::index(pdo.mapping_index)))),
            ("mailbox", mailbox(settings.mailbox.as_deref())),
            ("slots", Data::optional(slots)),
        ],
    )
}

pub(super) fn module(module: &Module, pdos: &PdoModels<'_>) -> Doc {
    Data::fields(
        "rt::ethercat::Module",
        vec![
            ("ident", Doc::from(hex32(module.number))),
            ("name", Doc::from(literal::string(&module.name))),
            ("class", Doc::from(literal::string(&module.class))),
            ("pdo_group", Doc::from(module.pdo_group.unwrap_or(0).to_string())),
            ("pdos", pdo_list(&module.process_data.pdos, pdos)),
            ("init_commands", Data::slice(module.init_commands().iter().map(init_command))),
            ("objects", Data::slice(slot_objects(&module.groups))),
        ],
    )
}

/// Returns ranges of consecutive objects whose indices depend on the slot or slot group in the same way. Other objects
/// are left out.
fn slot_objects(groups: &[Group]) -> Vec<Doc> {
    let known = groups.iter().filter_map(|group| Some((group.index()?, group)));
    let known = known.map(|(index, group)| (index, depends_on(group.depends_on_slot, group.depends_on_slot_group)));
    let mut rows: Vec<(u16, u16, &str)> = Vec::new();
    for (index, depends_on) in known {
        match rows.last_mut() {
            Some(row) if row.2 == depends_on && row.1 < index => row.1 = index,
            _ => rows.push((index, index, depends_on)),
        }
    }
    rows.retain(|&(.., depends_on)| depends_on != NOTHING);
    let data = |(first, last, depends_on)| vec![Data::index(first), Data::index(last), Doc::from(depends_on)];
    rows.into_iter().map(|row| Data::call("rt::ethercat::SlotObjects::new", data(row))).collect()
}

fn sync_manager(manager: &SyncManager) -> Doc {
    let purpose = match manager.purpose {
        SyncManagerPurpose::MailboxOut => "MailboxOut",
        SyncManagerPurpose::MailboxIn => "MailboxIn",
        SyncManagerPurpose::Outputs => "Outputs",
        SyncManagerPurpose::Inputs => "Inputs",
    };
    Data::fields(
        "rt::ethercat::SyncManager",
        vec![
            ("number", Doc::from(manager.number.to_string())),
            ("purpose", Doc::from(format!("rt::ethercat::SyncManagerPurpose::{purpose}"))),
            ("start_address", Data::index(manager.start_address)),
            ("default_size", Doc::from(manager.default_size.unwrap_or(0).to_string())),
            ("min_size", Data::option(manager.size_range.0)),
            ("max_size", Data::option(manager.size_range.1)),
            ("control", Doc::from(hex8(manager.control))),
            ("enable", Doc::from((manager.enable).to_string())),
            ("op_only", Doc::from((manager.op_only).to_string())),
        ],
    )
}

/// Returns the code of the PDO list. Output PDOs come first, as the runtime expects.
fn pdo_list(pdos: &[Pdo], models: &PdoModels<'_>) -> Doc {
    // CANopen PDOs are excluded, because they may have the same indices as EtherCAT PDOs.
    let is_on_ethercat = |pdo: &&Pdo| !pdo.is_virtual && pdo.buses.is_none_or(|buses| buses.coe);
    let of = |direction| pdos.iter().filter(move |pdo| pdo.direction == direction).filter(is_on_ethercat);
    let all = of(Direction::Receive).chain(of(Direction::Transmit));
    Data::slice(all.map(|pdo| pdo_info(pdo, models)))
}

fn pdo_info(pdo: &Pdo, models: &PdoModels<'_>) -> Doc {
    let direction = match pdo.direction {
        Direction::Receive => "Output",
        Direction::Transmit => "Input",
    };
    let numbers = |list: Vec<String>| Data::slice(list.into_iter().map(Doc::from));
    Data::fields(
        "rt::ethercat::PdoInfo",
        vec![
            ("index", Data::index(pdo.mapping_index)),
            ("direction", Doc::from(format!("rt::ethercat::Direction::{direction}"))),
            ("bits", Doc::from(pdo.bits().to_string())),
            ("sync_manager", Data::option(pdo.sync_manager)),
            ("excluded_sync_managers", numbers(pdo.excluded_sync_managers.iter().map(u8::to_string).collect())),
            // A PDO whose mapping contains an unknown index cannot be remapped.
            ("fixed", Doc::from((pdo.fixed || !pdo.is_mapping_known()).to_string())),
            ("mandatory", Doc::from((pdo.mandatory).to_string())),
            ("depends_on", Doc::from(depends_on(pdo.depends_on_slot, pdo.depends_on_slot_group))),
            ("excludes", numbers(pdo.excludes.iter().map(|index| hex16(*index)).collect())),
            ("mapping", mapping(pdo, models)),
        ],
    )
}

/// Returns the mapping of a PDO. The returned code refers to the mapping constant of the PDO's struct if the PDO has a struct.
fn mapping(pdo: &Pdo, models: &PdoModels<'_>) -> Doc {
    match models.of(pdo) {
        Some(model) => Doc::from(format!("<pdo::{} as rt::Pdo>::MAPPING", model.name)),
        None => {
            let entry =
                |(path, arguments): (&'static str, Vec<String>)| Data::call(path, arguments.into_iter().map(Doc::from));
            Data::slice(pdo.entries.iter().map(mapping_entry).map(entry))
        }
    }
}

fn mailbox(mailbox: Option<&Mailbox>) -> Doc {
    let Some(mailbox) = mailbox else { return Doc::from("rt::ethercat::Mailbox::NONE") };
    let coe = mailbox.coe.as_ref().map(coe);
    Data::fields(
        "rt::ethercat::Mailbox",
        vec![
            ("coe", Data::optional(coe)),
            ("aoe", Doc::from((mailbox.aoe.is_some()).to_string())),
            ("eoe", Doc::from((mailbox.eoe.is_some()).to_string())),
            ("foe", Doc::from((mailbox.foe.is_some()).to_string())),
            ("soe", Doc::from((mailbox.soe.is_some()).to_string())),
            ("voe", Doc::from((mailbox.voe.is_some()).to_string())),
        ],
    )
}

fn coe(coe: &Coe) -> Doc {
    Data::fields(
        "rt::ethercat::Coe",
        vec![
            ("sdo_info", Doc::from((coe.sdo_info).to_string())),
            ("pdo_assign", Doc::from((coe.pdo_assign).to_string())),
            ("pdo_config", Doc::from((coe.pdo_config).to_string())),
            ("complete_access", Doc::from((coe.complete_access).to_string())),
            ("init_commands", Data::slice(coe.init_commands.iter().map(init_command))),
        ],
    )
}

fn init_command(command: &InitCommand) -> Doc {
    Data::fields(
        "rt::ethercat::InitCommand",
        vec![
            ("transitions", transitions(known_transitions(command.transitions.iter().map(CompactString::as_str)))),
            ("index", Data::index(command.index)),
            ("sub_index", Doc::from(hex8(command.sub_index))),
            ("complete_access", Doc::from((command.complete_access).to_string())),
            ("depends_on", Doc::from(depends_on(command.depends_on_slot, command.depends_on_slot_group))),
            ("data", Doc::from(literal::bytes(&command.data))),
        ],
    )
}

/// Returns the transitions in `names` that the runtime supports.
fn known_transitions<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'static str> {
    let names: Vec<&str> = names.collect();
    TRANSITIONS.into_iter().filter(|known| names.contains(known)).collect()
}

fn transitions(names: Vec<&str>) -> Doc {
    let list = names.into_iter().map(|name| Doc::from(format!("rt::ethercat::Transition::{name}")));
    Data::call("rt::ethercat::Transitions::of", vec![Data::slice(list)])
}

/// Returns the state transitions at which the master writes the list of modules to the device. The list is empty if the
/// device expects no such write. The default transition is PS.
fn download(rules: &SlotRules) -> Doc {
    if !rules.download_idents {
        return Doc::from("rt::ethercat::Transitions::NONE");
    }
    let names = rules.download_transition.split(|letter: char| !letter.is_ascii_alphabetic());
    let known = known_transitions(names);
    transitions(if known.is_empty() { vec!["PS"] } else { known })
}

fn slots(device: &Device, rules: &SlotRules, modules: &ModulePaths) -> Doc {
    let known = device.modules.iter().filter_map(|usage| modules.get(&usage.module));
    Data::fields(
        "rt::ethercat::Slots",
        vec![
            ("slots", Data::slice(device.slots.iter().map(slot))),
            ("modules", Data::slice(known.map(|path| Doc::from(format!("&{path}"))))),
            ("pdo_groups", Data::slice(rules.pdo_groups.iter().map(pdo_group))),
            ("download_idents", download(rules)),
        ],
    )
}

fn slot(slot: &Slot) -> Doc {
    let fit = |fit: &Fit| match fit {
        Fit::Ident(ident) => Doc::from(format!("rt::ethercat::Fit::Ident({})", hex32(*ident))),
        Fit::Class(name) | Fit::Name(name) => {
            Data::call("rt::ethercat::Fit::Class", vec![Doc::from(literal::string(name))])
        }
    };
    let default = match &slot.default {
        Some(Fit::Ident(ident)) => Some(hex32(*ident)),
        _ => None,
    };
    Data::fields(
        "rt::ethercat::Slot",
        vec![
            ("name", Doc::from(literal::string(&slot.name))),
            ("min", Doc::from(slot.instances.0.to_string())),
            ("max", Doc::from(slot.instances.1.to_string())),
            ("fits", Data::slice(slot.fits.iter().map(fit))),
            ("default", Data::option(default)),
            ("increments", increments(slot.index_increment, slot.pdo_increment)),
            ("group", Data::optional(slot.group.map(|number| slot_group(number, slot)))),
        ],
    )
}

fn increments(index: u16, pdo: u16) -> Doc {
    let numbers = [index, pdo].map(|number| Doc::from(hex(number)));
    Data::call("rt::ethercat::Increments::new", numbers)
}

fn slot_group(number: u16, slot: &Slot) -> Doc {
    let group_increments = increments(slot.group_index_increment, slot.group_pdo_increment);
    Data::call("rt::ethercat::SlotGroup::new", vec![Doc::from(number.to_string()), group_increments])
}

fn pdo_group(group: &ModulePdoGroup) -> Doc {
    let index = |index: Option<u16>| Data::option(index.map(hex16));
    Data::fields(
        "rt::ethercat::PdoGroup",
        vec![
            ("alignment", Doc::from(group.alignment.to_string())),
            ("rx_pdo", index(group.rx_pdo)),
            ("tx_pdo", index(group.tx_pdo)),
        ],
    )
}
