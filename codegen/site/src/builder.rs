//! Data of the PDO builder: the PDOs with a changeable mapping on CANopen and EtherCAT, and the objects that can be mapped.

use serde_json::{json, Value as Json};

use lexibus_codegen::backend::rust::{Calls, Usage};
use lexibus_codegen::collections::HashMap;
use lexibus_codegen::facts::pdo;
use lexibus_codegen::ir::{
    Binding, Device, Direction, Item, ItemId, Mappable, ObjectBuses, Pdo, PdoEntry, Value, MAX_PDO_SUBS,
};
use lexibus_codegen::number;

/// Maximum length of a PDO on CANopen in bits.
const MAX_BITS: u32 = 64;

/// Index of the object that assigns PDOs to sync manager 0 (ETG.1000.6 5.6.7.4).
const ASSIGNMENT: u16 = 0x1C10;

/// Returns the data as JSON, or `None` if no mapping can be changed or no object can be mapped.
pub(super) fn data(device: &Device, usage: &Usage) -> Option<String> {
    let pdos: Vec<Json> = device.process_data.pdos.iter().filter_map(|pdo| self::pdo(device, pdo, usage)).collect();
    let mapped = pdo::mapped_objects(&device.process_data.pdos);
    let groups = (0..).zip(&device.groups).flat_map(|(position, group)| group.items_at(position));
    let objects: Vec<Json> = groups.filter_map(|(id, item)| object(device, id, item, &mapped, &usage.calls)).collect();
    let data = json!({ "pdos": pdos, "objects": objects });
    (!pdos.is_empty() && !objects.is_empty()).then(|| data.to_string())
}

/// Returns the data of a PDO, or `None` if its mapping cannot be changed. Some data depend on the bus of the PDO.
fn pdo(device: &Device, pdo: &Pdo, usage: &Usage) -> Option<Json> {
    let of_bus = match pdo.communication {
        Some(_) => on_canopen(device, pdo),
        None => on_ethercat(device, pdo),
    };
    let mut data = of_bus.filter(|_| pdo::is_changeable(pdo))?;
    let entry = |entry: &PdoEntry| [u32::from(entry.index), u32::from(entry.sub_index), entry.bits];
    let common = json!({
        "title": pdo::title(pdo, pdo::buses(device)),
        "tx": pdo.direction == Direction::Transmit,
        "mapping": pdo.mapping_index,
        "mapped": pdo.entries.iter().map(entry).collect::<Vec<_>>(),
        "kept": pdo.entries.iter().filter(|entry| entry.fixed).map(entry).collect::<Vec<_>>(),
        "name": usage.pdos.get(&(pdo.mapping_index, pdo.buses)),
    });
    data.as_object_mut()?.extend(common.as_object()?.clone());
    Some(data)
}

/// Returns the data that only a PDO on CANopen has. Returns `None` if its mapping cannot be changed, for example
/// because the granularity is 0 (CiA 306), or if its COB-ID is unknown.
fn on_canopen(device: &Device, pdo: &Pdo) -> Option<Json> {
    let communication = pdo.communication.as_ref()?;
    let granularity = device.canopen.as_deref()?.granularity.unwrap_or(1);
    let (cob_id, of_node) = match communication.cob_id.as_ref()? {
        Value::Int(id) => (*id, false),
        Value::NodeId(offset) => (*offset, true),
        _ => return None,
    };
    (granularity > 0).then_some(())?;
    Some(json!({
        "bus": "c",
        "entries": pdo::writable_entries(device.object(pdo.mapping_index)?)?,
        "maxBits": MAX_BITS,
        "granularity": granularity,
        "communication": communication.writable.contains(&1).then_some(communication.index),
        "cobId": u32::try_from(cob_id).ok()?,
        "ofNode": of_node,
    }))
}

/// Returns the data that only a PDO on EtherCAT has. The field `assignment` contains the index of the assignment
/// object, and the PDOs that are assigned to the same sync manager by default. The field is `null` if the device does
/// not allow a master to write the assignment, or if the PDO is not assigned by default. Returns `None` if the mapping
/// cannot be changed, if the device is not an EtherCAT device, or if the description contains only a dictionary.
fn on_ethercat(device: &Device, pdo: &Pdo) -> Option<Json> {
    if device.ethercat.is_none() || device.dictionary_only {
        return None;
    }
    let writable = device.object(pdo.mapping_index).and_then(pdo::writable_entries);
    let assigned = |manager| {
        let pdos = device.process_data.pdos.iter().filter(move |pdo| pdo.sync_manager == Some(manager));
        json!([ASSIGNMENT + u16::from(manager), pdos.map(|pdo| pdo.mapping_index).collect::<Vec<_>>()])
    };
    Some(json!({
        "bus": "e",
        "entries": writable.or_else(|| pdo::configures(device).then_some(MAX_PDO_SUBS))?,
        "maxBits": u32::from(pdo::max_bytes_on_ethercat(device, pdo)) * 8,
        "granularity": 1,
        "assignment": pdo.sync_manager.filter(|_| pdo::assigns(device)).map(assigned),
    }))
}

/// Returns the data of an object, or `None` if no PDO can map the object. The data are: index, sub-index, length in
/// bits, address and name as one text, two flags (mappable into RPDOs, mappable into TPDOs), path in Rust, and letters
/// for the buses (`c` for CANopen, `e` for EtherCAT).
fn object(
    device: &Device,
    id: ItemId,
    item: &Item,
    mapped: &HashMap<(u16, u8), Mappable>,
    calls: &Calls,
) -> Option<Json> {
    let (index, sub_index) = item.object()?;
    let (mappable, buses) = (pdo::mappable(item, mapped), buses(item));
    if !(mappable.rpdo || mappable.tpdo) || buses.is_empty() {
        return None;
    }
    let bits = pdo::mapped_bits(item, &device.types)?;
    let call = calls.get(&id).and_then(|calls| calls.first()).map_or("", String::as_str);
    let path = call.trim_start_matches("device.").rsplit_once("().").map_or("", |(path, _)| path).replace("().", "::");
    let name = format!("{} {}", number::object(index, sub_index), item.name);
    Some(json!([index, sub_index, bits, name.trim(), mappable.rpdo, mappable.tpdo, path, buses]))
}

/// Returns the letters of the buses on which an item is an object.
fn buses(item: &Item) -> String {
    let has = |is_on: fn(&ObjectBuses) -> bool| {
        item.bindings.iter().any(|binding| matches!(binding, Binding::Object { buses, .. } if is_on(buses)))
    };
    let all = [("c", has(|buses| buses.canopen)), ("e", has(|buses| buses.coe))];
    all.into_iter().filter(|(_, has)| *has).map(|(letter, _)| letter).collect()
}
