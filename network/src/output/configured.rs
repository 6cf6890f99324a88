//! The catalog of a node with its node-ID, configured values and PDOs.

use lexibus_codegen::ir::{
    Catalog, Commissioning, Configured, Device, Direction, Entries, Pdo, PdoCommunication, PdoEntry, PdoEntryKind,
    Value,
};

use crate::model::{MappedObject, Network, NetworkNode, NetworkPdo};
use crate::values::Write;

/// Returns the catalog of a node with the node-ID, the configured values and the enabled PDOs of the network.
pub fn node_catalog(network: &Network, node: &NetworkNode) -> Catalog {
    let mut catalog = configured(network, node, node.description.catalog().clone());
    let device = &mut catalog.devices[0];
    let entries = Entries::new(&device.groups);
    for pdo in &node.pdos {
        let is_same = |other: &&mut Pdo| other.direction == pdo.direction && other.mapping_index == pdo.index() + 0x200;
        if let Some(described) = device.process_data.pdos.iter_mut().find(is_same) {
            described.entries = mapped(&entries, node, pdo);
            communicate(described, pdo);
        }
    }
    // A program cannot use a PDO that is disabled or that maps no objects.
    let is_used = |other: &Pdo| {
        let is_same =
            |pdo: &&NetworkPdo| other.direction == pdo.direction && other.mapping_index == pdo.index() + 0x200;
        node.pdos.iter().find(is_same).is_none_or(|pdo| pdo.is_enabled)
    };
    device.process_data.pdos.retain(is_used);
    catalog
}

/// Adds the node-ID, bit rate, names, serial number and configured values of a node to its catalog.
pub(super) fn configured(network: &Network, node: &NetworkNode, mut catalog: Catalog) -> Catalog {
    let device = &mut catalog.devices[0];
    let commissioning = device.commissioning.take().unwrap_or_default();
    device.commissioning = Some(Box::new(Commissioning {
        node_id: Some(node.id),
        node_name: node.name.value.as_str().into(),
        bit_rate: Some(network.bit_rate),
        network_name: network.name.as_str().into(),
        manager: false,
        lss_serial_number: Some(node.identity[3]).filter(|serial| *serial != 0),
        ..*commissioning
    }));
    node.writes.iter().for_each(|write| configure(device, write));
    catalog
}

/// Sets the configured value of the item that a write concerns. A write from the description changes nothing, because the item already has
/// its value.
fn configure(device: &mut Device, write: &Write) {
    let Some(value) = &write.value else { return };
    let items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    if let Some(item) = items.into_iter().find(|item| item.object() == Some(write.object)) {
        let others = item.configured.take().unwrap_or_default();
        item.configured = Some(Box::new(Configured { value: Some(value.clone()), ..*others }));
    }
}

/// Sets the communication parameters of a PDO to those of the network.
fn communicate(described: &mut Pdo, pdo: &NetworkPdo) {
    let communication = described.communication.get_or_insert_with(PdoCommunication::default);
    let is_sender = pdo.direction == Direction::Transmit;
    communication.index = pdo.index();
    communication.cob_id = Some(Value::Int(pdo.cob_id.into()));
    communication.transmission_type = Some(pdo.transmission);
    communication.inhibit_time = is_sender.then_some(pdo.inhibit_time).filter(|time| *time > 0);
    communication.event_timer =
        Some(if is_sender { pdo.event_timer } else { pdo.event_deadline }).filter(|time| *time > 0);
    communication.sync_start = is_sender.then_some(pdo.sync_start).filter(|start| *start > 0);
}

fn mapped(entries: &Entries<'_>, node: &NetworkNode, pdo: &NetworkPdo) -> Vec<PdoEntry> {
    let mut offset = 0;
    let entry = |mapped: &MappedObject| {
        let bits = u32::from(mapped.bits);
        let mut entry = PdoEntry { bit_offset: offset, ..PdoEntry::new(mapped.index, mapped.sub_index, bits) };
        offset += bits;
        match entries.get(mapped.index, mapped.sub_index).filter(|_| !mapped.is_gap()) {
            None if mapped.is_gap() => entry.kind = PdoEntryKind::Padding,
            None => {}
            Some(item) => {
                entry.kind = PdoEntryKind::Item;
                entry.item = entries.find(mapped.index, mapped.sub_index);
                entry.ty = item.ty;
                entry.name = node.entry_name((mapped.index, mapped.sub_index), " ").into();
            }
        }
        entry
    };
    pdo.entries.iter().map(entry).collect()
}
