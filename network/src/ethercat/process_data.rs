//! The process data of a SubDevice: PDOs of the device, PDOs of its modules, and padding in front of groups of modules.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::facts::pdo::MAX_ENTRY;
use lexibus_codegen::ir::{self, Device, Direction, Pdo, MAX_PDO_SUBS};
use lexibus_codegen::number::hex16;
use lexibus_codegen::source::Span;

use super::assignment::{assignable, direction, sync_manager, Assigned};
use super::modules::{Offsets, Plugged};
use super::segment::AssignedPdo;

/// Maximum length of padding in a PDO in bits: a mapping has at most 254 entries of at most 255 bits.
const MAX_PADDING: u32 = MAX_PDO_SUBS as u32 * MAX_ENTRY;

/// A PDO or padding in the process data of a sync manager.
#[derive(Clone, Copy)]
pub(super) struct Placed<'d> {
    /// Slot of the module that contains the PDO.
    pub slot: Option<u16>,
    /// Index of the PDO in this slot; 0 for padding without a PDO.
    pub index: u16,
    /// Number of the sync manager.
    pub sync_manager: u8,
    /// Offset in bits in the process data of the sync manager.
    pub bit_offset: u32,
    /// Length in bits.
    pub bits: u32,
    pub content: PlacedContent<'d>,
}

#[derive(Clone, Copy)]
pub(super) enum PlacedContent<'d> {
    /// A PDO, with the offsets of the objects that it maps.
    Pdo(&'d Pdo, Offsets),
    /// Padding in front of a group of modules.
    Padding,
}

/// Collects the process data of a SubDevice.
struct Layout<'d> {
    placed: Vec<Placed<'d>>,
}

impl<'d> Layout<'d> {
    fn end(&self, sync_manager: u8) -> u32 {
        let last = self.placed.iter().rev().find(|placed| placed.sync_manager == sync_manager);
        last.map_or(0, |last| last.bit_offset.saturating_add(last.bits))
    }

    fn add(&mut self, slot: Option<u16>, index: u16, sync_manager: u8, bits: u32, content: PlacedContent<'d>) {
        let bit_offset = self.end(sync_manager);
        self.placed.push(Placed { slot, index, sync_manager, bit_offset, bits, content });
    }

    fn add_assigned(&mut self, assigned: Assigned<'d>) {
        let (pdo, sync_manager) = assigned;
        self.add(None, pdo.mapping_index, sync_manager, pdo.bits(), PlacedContent::Pdo(pdo, Offsets::default()));
    }
}

/// Returns the process data of a device. The process data of a modular device are sorted by sync manager, and contain no elements of 0 bits.
pub(super) fn place<'d>(device: &'d Device, assigned: &[Assigned<'d>], plugged: &[Plugged<'d>]) -> Vec<Placed<'d>> {
    let mut layout = Layout { placed: Vec::new() };
    if device.slots.is_empty() {
        assigned.iter().for_each(|assigned| layout.add_assigned(*assigned));
        return layout.placed;
    }
    for manager in &device.process_data.sync_managers {
        let Some(direction) = direction(manager.purpose) else { continue };
        let of_manager = assigned.iter().filter(|(_, number)| *number == manager.number);
        of_manager.for_each(|assigned| layout.add_assigned(*assigned));
        for group in groups(device) {
            add_group(&mut layout, device, plugged, manager.number, direction, group);
        }
    }
    layout.placed.retain(|placed| placed.bits > 0);
    layout.placed
}

/// Returns the positions of the module groups; a single `None` if the device has no groups.
fn groups(device: &Device) -> Vec<Option<usize>> {
    match pdo_groups(device).len() {
        0 => vec![None],
        count => (0..count).map(Some).collect(),
    }
}

fn pdo_groups(device: &Device) -> &[ir::ModulePdoGroup] {
    let rules = device.ethercat.as_ref().and_then(|settings| settings.slots.as_ref());
    rules.map_or(&[], |rules| &rules.pdo_groups)
}

/// Adds the PDOs of one group of modules to a sync manager, after the padding of the group.
fn add_group<'d>(
    layout: &mut Layout<'d>,
    device: &'d Device,
    plugged: &[Plugged<'d>],
    manager: u8,
    direction: Direction,
    group: Option<usize>,
) {
    let groups = pdo_groups(device);
    // A module with an invalid group number belongs to the last group.
    let group_of = |module: &ir::Module| usize::from(module.pdo_group.unwrap_or(0)).min(groups.len().saturating_sub(1));
    let is_member = |plugged: &&Plugged<'d>| group.is_none_or(|group| group_of(plugged.module) == group);
    let mut pdos = Vec::new();
    for plugged in plugged.iter().filter(is_member) {
        let of_module = assignable(&plugged.module.process_data);
        let of_manager = of_module.filter(|pdo| sync_manager(&device.process_data, pdo) == Some(manager));
        pdos.extend(of_manager.map(|pdo| (*plugged, pdo)));
    }
    if let Some(rules) = group.map(|group| &groups[group]).filter(|rules| rules.alignment > 0 && !pdos.is_empty()) {
        let index = if direction == Direction::Receive { rules.rx_pdo } else { rules.tx_pdo };
        let end = layout.end(manager);
        let aligned = end.checked_next_multiple_of(u32::from(rules.alignment) * 8).unwrap_or(end);
        layout.add(None, index.unwrap_or(0), manager, aligned - end, PlacedContent::Padding);
    }
    for (plugged, pdo) in pdos {
        let index = plugged.pdos().apply(pdo.mapping_index, pdo.depends_on_slot, pdo.depends_on_slot_group);
        let content = PlacedContent::Pdo(pdo, plugged.objects());
        layout.add(Some(plugged.number), index, manager, pdo.bits(), content);
    }
}

/// Returns the length of the process data of a sync manager in bytes.
pub(super) fn bytes(placed: &[Placed<'_>], sync_manager: u8) -> u32 {
    let ends = placed.iter().filter(|placed| placed.sync_manager == sync_manager);
    ends.map(|placed| placed.bit_offset.saturating_add(placed.bits)).max().unwrap_or(0).div_ceil(8)
}

/// Reports padding that does not fit into a PDO. Also reports a sync manager with too many PDOs or with more process data
/// than its maximum length.
pub(super) fn check(device: &Device, placed: &[Placed<'_>], span: Span, diagnostics: &mut Diagnostics) {
    let is_padding = |placed: &&Placed<'_>| placed.index != 0 && matches!(placed.content, PlacedContent::Padding);
    for padding in placed.iter().filter(is_padding).filter(|padding| padding.bits > MAX_PADDING) {
        let message = format!(
            "the padding of PDO {} has {} bits, but the maximum is {MAX_PADDING}",
            hex16(padding.index),
            padding.bits
        );
        diagnostics.push(Diagnostic::new(&codes::PDO_ASSIGNMENT, span, message).help("use other modules"));
    }
    for manager in &device.process_data.sync_managers {
        let number = manager.number;
        let count = placed.iter().filter(|placed| placed.sync_manager == number && placed.index != 0).count();
        if count > MAX_PDO_SUBS {
            let message = format!("{count} PDOs are assigned to sync manager {number}; the maximum is {MAX_PDO_SUBS}");
            diagnostics.push(Diagnostic::new(&codes::PDO_ASSIGNMENT, span, message).help("assign fewer PDOs"));
        }
        let bytes = bytes(placed, number);
        let maximum = manager.size_range.1.unwrap_or(u16::MAX);
        if direction(manager.purpose).is_some() && bytes > u32::from(maximum) {
            let message = format!(
                "sync manager {number} has {bytes} bytes of process data, but its maximum length is {maximum} bytes"
            );
            let found = Diagnostic::new(&codes::SYNC_MANAGER_LENGTH, span, message);
            diagnostics.push(found.help(match device.slots.is_empty() {
                true => "assign fewer or shorter PDOs with `pdos`",
                false => "use fewer modules",
            }));
        }
    }
}

/// Returns the PDOs and padding with their positions, as data for a MainDevice.
pub(super) fn assigned_pdos(placed: &[Placed<'_>]) -> Vec<AssignedPdo> {
    let shown = |placed: &Placed<'_>| AssignedPdo {
        index: placed.index,
        name: match placed.content {
            PlacedContent::Pdo(pdo, _) => pdo.name.to_string(),
            PlacedContent::Padding => String::new(),
        },
        is_padding: matches!(placed.content, PlacedContent::Padding),
        slot: placed.slot,
        sync_manager: placed.sync_manager,
        bit_offset: placed.bit_offset,
        bits: placed.bits,
    };
    placed.iter().map(shown).collect()
}
