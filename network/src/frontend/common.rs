//! Reads the keys that `network.toml` and `bus.yml` have in common, some with different names. Also reads the keys that the
//! sections of `network.toml` have in common.

use std::ops::RangeInclusive;

use super::object_name::object_name;
use super::reader::{Reader, Table};
use crate::declared::{DeclaredCobId, DeclaredMaster, DeclaredNode, DeclaredParameter, DeclaredPdo, ObjectName};
use crate::syntax::{At, Content, Entry, Node, Scalar};

/// Names of keys that differ between the formats.
pub(crate) struct Names {
    pub id: &'static str,
    pub heartbeat: &'static str,
    pub mapping: &'static str,
}

/// Reads the section of the master.
pub(crate) fn master(reader: &mut Reader<'_>, table: Table<'_>, names: &Names) -> DeclaredMaster {
    let mut master = DeclaredMaster::new(table.node.span);
    master.has_node_id = table.get(names.id).is_some();
    master.node_id = reader.integer(table, names.id);
    let identity = ["vendor_id", "product_code", "revision_number", "serial_number"];
    master.identity = identity.map(|key| number(reader, table, key, 0));
    master.sync_period = reader.integer(table, "sync_period");
    master.sync_window = number(reader, table, "sync_window", 0);
    master.sync_overflow = number(reader, table, "sync_overflow", 0);
    master.time_cob_id = reader.integer(table, "time_cob_id").unwrap_or(master.time_cob_id);
    master.emcy_inhibit_time = number(reader, table, "emcy_inhibit_time", 0);
    master.heartbeat = reader.integer(table, names.heartbeat).unwrap_or(master.heartbeat);
    master.heartbeat_multiplier = reader.number(table, "heartbeat_multiplier").unwrap_or(master.heartbeat_multiplier);
    master.consumes_heartbeats = reader.flag(table, "heartbeat_consumer").unwrap_or(true);
    for At { value: (sub_index, value), .. } in error_behavior(reader, table) {
        master.error_behavior.retain(|(other, _)| *other != sub_index);
        master.error_behavior.push((sub_index, value));
    }
    master.error_behavior.sort_unstable();
    master.nmt_inhibit_time = number(reader, table, "nmt_inhibit_time", 0);
    master.startup = startup(reader, table);
    master.boot_time = number(reader, table, "boot_time", 0);
    master
}

fn number<T: TryFrom<i128>>(reader: &mut Reader<'_>, table: Table<'_>, key: &str, default: T) -> T {
    reader.integer(table, key).map_or(default, |number| number.value)
}

/// Returns the value of 0x1F80 (CiA 302-2): bit 0 makes the device the NMT master.
fn startup(reader: &mut Reader<'_>, table: Table<'_>) -> u32 {
    const FLAGS: [(&str, bool, u32); 5] = [
        ("start_all_nodes", true, 0x02),
        ("start", false, 0x04),
        ("start_nodes", false, 0x08),
        ("reset_all_nodes", true, 0x10),
        ("stop_all_nodes", true, 0x40),
    ];
    let is_set = |&(key, state, _): &(&str, bool, u32)| reader.flag(table, key) == Some(state);
    FLAGS.into_iter().filter(is_set).fold(1, |value, (_, _, bit)| value | bit)
}

fn error_behavior(reader: &mut Reader<'_>, table: Table<'_>) -> Vec<At<(u8, u8)>> {
    let entries = table.get("error_behavior").map_or(&[][..], |node| reader.entries(node, "sub-index = value"));
    let entry = |entry: &Entry| {
        let sub_index = numbered(reader, entry, "a sub-index", 1..=254)?;
        let value = reader.integer_of::<u8>(&entry.value, 0..=255)?;
        Some(At::new((sub_index as u8, value.value), value.span))
    };
    entries.iter().filter_map(entry).collect()
}

/// Returns the key of `entry` as a number. If it is not a number in `range`, reports the key and returns `None`.
pub(crate) fn numbered(reader: &mut Reader<'_>, entry: &Entry, what: &str, range: RangeInclusive<u16>) -> Option<u16> {
    let number = entry.key.parse().ok().filter(|number| range.contains(number));
    if number.is_none() {
        let key = Node { span: entry.key.span, content: Content::Scalar(Scalar::Text(entry.key.value.clone())) };
        reader.invalid(&key, &format!("{what} from {} to {}", range.start(), range.end()));
    }
    number
}

/// Reads the keys of a node that `network.toml` and `bus.yml` have in common.
pub(crate) fn node(reader: &mut Reader<'_>, table: Table<'_>, names: &Names, node: &mut DeclaredNode) {
    node.has_node_id = table.get(names.id).is_some();
    node.node_id = reader.integer(table, names.id);
    node.revision_number = reader.integer(table, "revision_number").map(|number| number.value);
    node.serial_number = reader.integer(table, "serial_number").map(|number| number.value);
    node.time_cob_id = reader.integer(table, "time_cob_id");
    node.heartbeat = reader.integer(table, names.heartbeat);
    let multiplier = reader.number(table, "heartbeat_multiplier");
    node.heartbeat_multiplier = multiplier.unwrap_or_else(|| node.heartbeat_multiplier.clone());
    node.consumes_heartbeat = reader.flag(table, "heartbeat_consumer").unwrap_or(false);
    node.guard_time = reader.integer(table, "guard_time");
    node.life_time_factor = reader.integer(table, "life_time_factor");
    node.error_behavior = error_behavior(reader, table);
    node.boot = reader.flag(table, "boot").unwrap_or(true);
    node.mandatory = reader.flag(table, "mandatory").unwrap_or(false);
    node.reset_communication = reader.flag(table, "reset_communication").unwrap_or(true);
    node.software_file = reader.text(table, "software_file");
    node.software_version = number(reader, table, "software_version", 0);
    node.restore = number(reader, table, "restore_configuration", 0);
    node.retry_factor = number(reader, table, "retry_factor", node.retry_factor);
}

/// Reads the PDOs below a key of a node.
pub(crate) fn pdos(
    reader: &mut Reader<'_>,
    table: Table<'_>,
    key: &str,
    section: &'static super::section::Section,
    names: &Names,
    mapped: fn(&mut Reader<'_>, &Node) -> Option<At<ObjectName>>,
) -> Vec<DeclaredPdo> {
    let entries = table.get(key).map_or(&[][..], |node| reader.entries(node, "number of the PDO = table"));
    let mut list = Vec::new();
    for entry in entries {
        let Some(number) = numbered(reader, entry, "the number of a PDO", 1..=512) else { continue };
        let pdo = reader.table(&entry.value, section);
        let mapping = pdo.get(names.mapping);
        let mapping = mapping.map(|node| {
            let objects = reader.list(node).iter();
            At::new(objects.filter_map(|object| mapped(reader, object)).collect(), node.span)
        });
        list.push(DeclaredPdo {
            is_tpdo: key == "tpdo",
            number: At::new(number, entry.key.span),
            enabled: reader.flag(pdo, "enabled").unwrap_or(true),
            cob_id: cob_id(reader, pdo),
            transmission: reader.integer(pdo, "transmission"),
            inhibit_time: reader.integer(pdo, "inhibit_time"),
            event_timer: reader.integer(pdo, "event_timer"),
            event_deadline: reader.integer(pdo, "event_deadline"),
            sync_start: reader.integer(pdo, "sync_start"),
            mapping,
        });
    }
    list
}

fn cob_id(reader: &mut Reader<'_>, pdo: Table<'_>) -> Option<At<DeclaredCobId>> {
    let node = pdo.get("cob_id")?;
    if let Content::Scalar(Scalar::Text(text)) = &node.content {
        return match sender(text) {
            Some(cob_id) => Some(At::new(cob_id, node.span)),
            None => {
                reader.invalid(node, "a COB-ID, \"auto\", or a TPDO of a node such as \"axis1.tpdo1\"");
                None
            }
        };
    }
    let number = reader.integer_of(node, 0..=u32::MAX.into())?;
    Some(At::new(DeclaredCobId::Number(number.value), number.span))
}

/// Parses the text of a COB-ID: `auto`, or a TPDO such as `node.tpdo1`.
fn sender(text: &str) -> Option<DeclaredCobId> {
    if text == "auto" {
        return Some(DeclaredCobId::Automatic);
    }
    let (node, pdo) = text.rsplit_once('.')?;
    let number = pdo.strip_prefix("tpdo")?.parse().ok().filter(|number| (1..=512).contains(number))?;
    Some(DeclaredCobId::Of(node.to_owned(), number))
}

/// Reads a text with the address or name of an object.
pub(crate) fn named_object(reader: &mut Reader<'_>, node: &Node) -> Option<At<ObjectName>> {
    reader.text_of(node).map(|text| At::new(object_name(&text.value), text.span))
}

/// Reads the key `parameters`: objects with their values.
pub(crate) fn parameters(reader: &mut Reader<'_>, table: Table<'_>) -> Vec<DeclaredParameter> {
    let entries = table.get("parameters").map_or(&[][..], |node| reader.entries(node, "object = value"));
    let parameter = |entry: &Entry| {
        let object = At::new(object_name(&entry.key), entry.key.span);
        Some(DeclaredParameter { object, value: reader.scalar(&entry.value)? })
    };
    entries.iter().filter_map(parameter).collect()
}
