//! Data of the PDO builder: the PDOs of a CANopen device with a changeable mapping, and the objects that can be mapped.

use std::collections::HashMap;

use serde_json::{json, Value as Json};

use lexibus_codegen::backend::rust::{Calls, Usage};
use lexibus_codegen::facts::{address, pdo};
use lexibus_codegen::ir::{Binding, Device, Direction, Item, ItemId, Mappable, ObjectBuses, Pdo, PdoEntryKind, Value};

/// Returns the data as JSON, or `None` if no mapping can be changed.
pub(super) fn data(device: &Device, usage: &Usage) -> Option<String> {
    let granularity = device.canopen.as_deref()?.granularity;
    if granularity == Some(0) {
        return None;
    }
    let pdos: Vec<Json> =
        device.process_data.pdos.iter().filter_map(|pdo| self::pdo(device, pdo, &usage.pdos)).collect();
    let mapped = pdo::mapped_objects(&device.process_data.pdos);
    let groups = (0..).zip(&device.groups).flat_map(|(position, group)| group.items_at(position));
    let objects: Vec<Json> = groups.filter_map(|(id, item)| object(device, id, item, &mapped, &usage.calls)).collect();
    let data = json!({ "granularity": granularity.unwrap_or(1), "pdos": pdos, "objects": objects });
    (!pdos.is_empty() && !objects.is_empty()).then(|| data.to_string())
}

fn pdo(device: &Device, pdo: &Pdo, names: &HashMap<u16, String>) -> Option<Json> {
    let communication = pdo.communication.as_ref()?;
    let entries = pdo::writable_entries(device.object(pdo.mapping_index)?).filter(|_| pdo::is_changeable(pdo))?;
    let mapped = pdo.entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding);
    let mapped: Vec<[u32; 2]> = mapped.map(|entry| [u32::from(entry.index), u32::from(entry.sub_index)]).collect();
    let (cob_id, of_node) = match communication.cob_id.as_ref()? {
        Value::Int(id) => (*id, false),
        Value::NodeId(offset) => (*offset, true),
        _ => return None,
    };
    Some(json!({
        "title": pdo::title(pdo, pdo::buses(device)),
        "tx": pdo.direction == Direction::Transmit,
        "mapping": pdo.mapping_index,
        "communication": communication.writable.contains(&1).then_some(communication.index),
        "cobId": u32::try_from(cob_id).ok()?,
        "ofNode": of_node,
        "entries": entries,
        "mapped": mapped,
        "name": names.get(&pdo.mapping_index),
    }))
}

/// Returns the data of an object that can be mapped: index, sub-index, length in bits, address and name as one text,
/// two flags (mappable into RPDOs, mappable into TPDOs), and path in Rust. Returns `None` if no PDO on CANopen can map
/// the object.
fn object(
    device: &Device,
    id: ItemId,
    item: &Item,
    mapped: &HashMap<(u16, u8), Mappable>,
    calls: &Calls,
) -> Option<Json> {
    let (index, sub_index) = item.object()?;
    let mappable = pdo::mappable(item, mapped);
    if !(mappable.rpdo || mappable.tpdo) || item.bindings.iter().all(|binding| !on_canopen(binding)) {
        return None;
    }
    let bits = pdo::mapped_bits(item, &device.types)?;
    let call = calls.get(&id).and_then(|calls| calls.first()).map_or("", String::as_str);
    let path = call.trim_start_matches("device.").rsplit_once("().").map_or("", |(path, _)| path).replace("().", "::");
    let name = format!("{} {}", address::object(index, sub_index), item.name);
    Some(json!([index, sub_index, bits, name.trim(), mappable.rpdo, mappable.tpdo, path]))
}

fn on_canopen(binding: &Binding) -> bool {
    matches!(binding, Binding::Object { buses: ObjectBuses { canopen: true, .. }, .. })
}
