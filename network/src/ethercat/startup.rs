//! The start-up commands of a SubDevice.

use lexibus_codegen::facts::pdo::{assigns, configures, MAX_ENTRY};
use lexibus_codegen::ir::{Device, InitCommand, Pdo, PdoEntry, MAX_PDO_SUBS};

use super::assignment::direction;
use super::modules::{Offsets, Plugged};
use super::process_data::{Placed, PlacedContent};
use super::segment::StartupCommand;
use crate::values::Write;

/// State transitions in the order of their commands.
const TRANSITIONS: [&str; 6] = ["IP", "PS", "SO", "SP", "OP", "OS"];

/// Transition at which PDO mappings, the PDO assignment and `parameters` are written.
const CONFIGURATION: &str = "PS";

/// Index of the assignment object of sync manager 0 (ETG.1000.6 5.6.7.4).
const ASSIGNMENT: u16 = 0x1C10;

/// Index of the object that lists the idents of the configured modules (ETG.5001.1).
const MODULE_IDENTS: u16 = 0xF030;

/// Data from which the start-up commands of a SubDevice are computed.
pub(super) struct Startup<'d> {
    pub device: &'d Device,
    pub plugged: &'d [Plugged<'d>],
    pub placed: &'d [Placed<'d>],
    pub parameters: &'d [Write],
}

impl Startup<'_> {
    /// Returns the start-up commands. Within a transition, the order is that of `lexibus::ethercat::SlotPlan::commands`:
    /// module idents, commands of the device, commands of the modules. At the transition PS, PDO mappings, PDO
    /// assignment and `parameters` follow.
    pub fn commands(&self) -> Vec<StartupCommand> {
        let mut commands = Vec::new();
        for transition in TRANSITIONS {
            if self.downloads_idents(transition) {
                commands.extend(self.idents(transition));
            }
            commands.extend(self.declared(transition));
            if transition == CONFIGURATION {
                commands.extend(self.assignment());
                commands.extend(self.parameters.iter().map(|write| configuration(write.object, write.bytes.clone())));
            }
        }
        commands
    }

    /// Returns whether the module idents are written at a transition. The default transition is PS.
    fn downloads_idents(&self, transition: &str) -> bool {
        let settings = self.device.ethercat.as_ref();
        let Some(rules) = settings.and_then(|settings| settings.slots.as_ref()) else { return false };
        let mut names = rules.download_transition.split(|letter: char| !letter.is_ascii_alphabetic());
        let is_stated = names.clone().any(|name| TRANSITIONS.contains(&name));
        rules.download_idents
            && if is_stated { names.any(|name| name == transition) } else { transition == CONFIGURATION }
    }

    /// Returns the commands that write the module idents of all slots up to the last module.
    fn idents(&self, transition: &'static str) -> Vec<StartupCommand> {
        let count = self.plugged.last().map_or(0, |plugged| plugged.number + 1) as u8;
        let ident = |number: u8| {
            let module = self.plugged.iter().find(|plugged| plugged.number == u16::from(number));
            module.map_or(0, |plugged| plugged.module.number)
        };
        let entries = (0..count).map(|slot| ((MODULE_IDENTS, slot + 1), ident(slot).to_le_bytes().to_vec()));
        let first = std::iter::once(((MODULE_IDENTS, 0), vec![0]));
        let all = first.chain(entries).chain(std::iter::once(((MODULE_IDENTS, 0), vec![count])));
        all.map(|(object, data)| command(transition, object, data)).collect()
    }

    /// Returns the CoE commands that the descriptions of the device and of its modules declare for a transition.
    fn declared(&self, transition: &'static str) -> Vec<StartupCommand> {
        let coe = self.device.ethercat.as_ref().and_then(|settings| settings.mailbox.as_ref()?.coe.as_ref());
        let of_device = coe.map_or(&[][..], |coe| &coe.init_commands).iter();
        let of_modules = self
            .plugged
            .iter()
            .flat_map(|plugged| plugged.module.init_commands().iter().map(|command| (command, plugged.objects())));
        let all = of_device.map(|command| (command, Offsets::default())).chain(of_modules);
        let due = all.filter(|(command, _)| command.transitions.iter().any(|name| name == transition));
        due.map(|(command, offsets)| of_init_command(command, offsets, transition)).collect()
    }

    /// Returns the commands that clear the PDO assignment, write the mappings of the assigned PDOs, and write the
    /// assignment. Commands that the device does not allow are left out.
    fn assignment(&self) -> Vec<StartupCommand> {
        let managers = self.device.process_data.sync_managers.iter();
        let managers = managers.filter(|manager| direction(manager.purpose).is_some() && assigns(self.device));
        let managers: Vec<u8> = managers.map(|manager| manager.number).collect();
        let object = |manager: u8| ASSIGNMENT + u16::from(manager);
        let mut commands: Vec<StartupCommand> =
            managers.iter().map(|manager| configuration((object(*manager), 0), vec![0])).collect();
        commands.extend(self.placed.iter().filter(|_| configures(self.device)).flat_map(mapping));
        for manager in managers {
            let pdos = self.placed.iter().filter(|placed| placed.sync_manager == manager && placed.index != 0);
            let indices: Vec<u16> = pdos.map(|placed| placed.index).collect();
            let entries = indices.iter().zip(1..=u8::MAX);
            commands.extend(
                entries.map(|(index, sub)| configuration((object(manager), sub), index.to_le_bytes().to_vec())),
            );
            if !indices.is_empty() {
                commands.push(configuration((object(manager), 0), vec![indices.len() as u8]));
            }
        }
        commands
    }
}

fn configuration(object: (u16, u8), data: Vec<u8>) -> StartupCommand {
    command(CONFIGURATION, object, data)
}

fn command(transition: &'static str, object: (u16, u8), data: Vec<u8>) -> StartupCommand {
    let (index, sub_index) = object;
    StartupCommand { transition, index, sub_index, complete_access: false, data }
}

fn of_init_command(declared: &InitCommand, offsets: Offsets, transition: &'static str) -> StartupCommand {
    let index = offsets.apply(declared.index, declared.depends_on_slot, declared.depends_on_slot_group);
    let command = command(transition, (index, declared.sub_index), declared.data.clone());
    StartupCommand { complete_access: declared.complete_access, ..command }
}

/// Returns whether the mapping of a PDO can be written.
fn is_writable(pdo: &Pdo) -> bool {
    let fits = pdo.entries.len() <= MAX_PDO_SUBS && pdo.entries.iter().all(|entry| entry.bits <= MAX_ENTRY);
    !pdo.fixed && fits && pdo.is_mapping_known()
}

/// Returns the commands that write the mapping of a PDO or of padding: clear the mapping, write the entries, write the number of entries.
/// Returns no commands if the mapping cannot be written.
fn mapping(placed: &Placed<'_>) -> Vec<StartupCommand> {
    let words: Vec<u32> = match placed.content {
        PlacedContent::Pdo(pdo, offsets) if is_writable(pdo) => {
            pdo.entries.iter().map(|entry| word(entry, offsets)).collect()
        }
        PlacedContent::Padding if placed.index != 0 => padding(placed.bits),
        _ => return Vec::new(),
    };
    let count = words.len() as u8;
    let entries = words.into_iter().zip(1..=u8::MAX).map(|(word, sub)| (sub, word.to_le_bytes().to_vec()));
    let all = std::iter::once((0, vec![0])).chain(entries).chain(std::iter::once((0, vec![count])));
    all.map(|(sub, data)| configuration((placed.index, sub), data)).collect()
}

fn word(entry: &PdoEntry, offsets: Offsets) -> u32 {
    let index = offsets.apply(entry.index, entry.depends_on_slot, entry.depends_on_slot_group);
    u32::from(index) << 16 | u32::from(entry.sub_index) << 8 | entry.bits
}

/// Returns the entries of padding, each of at most 255 bits.
fn padding(bits: u32) -> Vec<u32> {
    let count = bits.div_ceil(MAX_ENTRY);
    (0..count).map(|at| (bits - at * MAX_ENTRY).min(MAX_ENTRY)).collect()
}
