//! Heartbeat consumers of the nodes (0x1016), which monitor the master.

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::ir::Group;

use super::described::initial;
use super::writer::Writer;
use crate::model::{consumer_time, Network};

/// Configures the heartbeat consumers of all nodes. `consumers` states for each node whether it monitors the master. The writes come
/// first, as in `dcfgen`.
pub(super) fn monitor_master(network: &mut Network, consumers: &[bool], diagnostics: &mut Diagnostics) {
    let Some(master) = &network.master else { return };
    let time = consumer_time(master.heartbeat.value, master.heartbeat_multiplier.value);
    let (master_id, span) = (network.master_id(), master.heartbeat.span);
    for (node, is_consumer) in network.nodes.iter_mut().zip(consumers) {
        let description = std::rc::Rc::clone(&node.description);
        let mut writer = Writer { device: description.device(), id: node.id, writes: Vec::new(), diagnostics };
        let entries = consumer_entries(writer.device.object(0x1016), &writer);
        if *is_consumer && time > 0 {
            let entry = free_entry(&entries, master_id);
            match entry {
                Some(sub_index) => writer.write((0x1016, sub_index), u32::from(master_id) << 16 | time & 0xFFFF, span),
                None => {
                    let message = format!("the node `{}` cannot monitor the heartbeat of the master", node.name.value);
                    let found = Diagnostic::new(&codes::HEARTBEAT_TIME, node.name.span, message);
                    writer.diagnostics.push(found.label("object 0x1016 has no free entry"));
                }
            }
        } else {
            // The description monitors the master, but the master sends no heartbeat, or the file does not ask for it.
            for (sub_index, value) in entries {
                if value & 0xFFFF != 0 && (value >> 16) as u8 == master_id {
                    writer.write((0x1016, sub_index), value & 0x00FF_0000, span);
                }
            }
        }
        for write in writer.writes {
            node.writes.insert(0, write);
        }
    }
}

/// Returns sub-index and value of the entries of 0x1016.
fn consumer_entries(group: Option<&Group>, writer: &Writer<'_>) -> Vec<(u8, u32)> {
    let subs = group.into_iter().flat_map(|group| &group.items).filter_map(|item| Some(item.object()?.1));
    let value = |sub_index| initial(writer.device, (0x1016, sub_index), writer.id).unwrap_or(0) as u32;
    subs.filter(|sub_index| *sub_index > 0).map(|sub_index| (sub_index, value(sub_index))).collect()
}

/// Returns the entry that monitors the master, or the first unused entry.
fn free_entry(entries: &[(u8, u32)], master_id: u8) -> Option<u8> {
    let of_master = entries.iter().find(|(_, value)| (value >> 16) as u8 == master_id);
    let is_unused = |value: u32| value & 0xFFFF == 0 || !(1..=127).contains(&((value >> 16) as u8));
    of_master.or_else(|| entries.iter().find(|(_, value)| is_unused(*value))).map(|(sub_index, _)| *sub_index)
}
