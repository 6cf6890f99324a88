//! Heartbeat consumers (0x1016) of the nodes that monitor the master.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Bus;

use super::writer::Writer;
use crate::model::{consumer_time, Network, NetworkNode};

/// Configures the heartbeat consumers of all nodes. `consumers` states for each node whether it monitors the master. The writes come
/// after those of the description, and before all others of the network file, as in `dcfgen`.
pub(super) fn monitor_master(network: &mut Network, consumers: &[bool], diagnostics: &mut Diagnostics) {
    let Some(master) = &network.master else { return };
    let time = consumer_time(master.heartbeat.value, master.heartbeat_multiplier.value);
    let (master_id, span) = (network.master_id(), master.heartbeat.span);
    for (node, is_consumer) in network.nodes.iter_mut().zip(consumers) {
        let (declared, described) = entries(node);
        let monitors = |(_, value): &&(u8, u32)| value & 0xFFFF != 0 && (value >> 16) as u8 == master_id;
        let is_declared = declared.iter().any(|entry| monitors(&entry));
        let description = std::rc::Rc::clone(&node.description);
        let mut writer =
            Writer { device: description.device(), bus: Bus::CanOpen, id: node.id, writes: Vec::new(), diagnostics };
        if *is_consumer && time > 0 && !is_declared {
            match free_entry(&described, master_id) {
                Some(sub_index) => writer.write((0x1016, sub_index), u32::from(master_id) << 16 | time & 0xFFFF, span),
                None => {
                    let message = format!("the node `{}` cannot monitor the heartbeat of the master", node.name.value);
                    let found = Diagnostic::new(&codes::HEARTBEAT_TIME, node.name.span, message);
                    writer.diagnostics.push(found.label("object 0x1016 has no free entry"));
                }
            }
        } else {
            // In the entries of the description that monitor the master, sets the time to 0. Here, the master sends no
            // heartbeat, the network file does not request the monitoring, or the network file sets such an entry itself.
            for (sub_index, value) in described.iter().filter(monitors) {
                writer.write((0x1016, *sub_index), value & 0x00FF_0000, span);
            }
        }
        let first = node.writes.iter().take_while(|write| write.value.is_none()).count();
        node.writes.splice(first..first, writer.writes);
    }
}

/// Sub-index and value of entries of 0x1016.
type Entries = Vec<(u8, u32)>;

/// Returns the entries of 0x1016 that the network file sets, and the others, which have the values of the description.
fn entries(node: &NetworkNode) -> (Entries, Entries) {
    let items = node.device().object(0x1016).into_iter().flat_map(|group| &group.items);
    let subs = items.filter_map(|item| Some(item.object()?.1)).filter(|sub_index| *sub_index > 0);
    let values = node.values();
    let value = |sub_index| values.number((0x1016, sub_index)).unwrap_or(0);
    subs.map(|sub_index| (sub_index, value(sub_index))).partition(|(sub_index, _)| values.is_set((0x1016, *sub_index)))
}

/// Returns the sub-index of the first entry with the node-ID of the master or, if there is none, of the first unused entry.
fn free_entry(entries: &[(u8, u32)], master_id: u8) -> Option<u8> {
    let of_master = entries.iter().find(|(_, value)| (value >> 16) as u8 == master_id);
    let is_unused = |value: u32| value & 0xFFFF == 0 || !(1..=127).contains(&((value >> 16) as u8));
    of_master.or_else(|| entries.iter().find(|(_, value)| is_unused(*value))).map(|(sub_index, _)| *sub_index)
}
