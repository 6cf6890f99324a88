//! Mapping objects for PDOs that the source describes outside the dictionary, as in ETG.2000.

use std::collections::HashSet;

use lexibus_codegen::ir::{
    Access, Binding, CompactString, Device, Direction, Group, Item, ObjectCode, Pdo, PdoEntry, Type, Value,
    MAX_PDO_SUBS,
};

/// For each PDO of `device` without a mapping object, returns a mapping object if it can express the PDO.
pub(super) fn objects(device: &Device) -> Vec<Group> {
    let mut seen: HashSet<u16> = device.groups.iter().filter_map(Group::index).collect();
    let expressible = device.process_data.pdos.iter().filter(|pdo| is_expressible(pdo));
    expressible.filter(|pdo| seen.insert(pdo.mapping_index)).map(object).collect()
}

/// Returns whether `pdo` needs a mapping object and a mapping object can express it. PDOs that CompactPDO implies, and
/// PDOs without entries, need no mapping object. The index must be that of a mapping object for the direction of the
/// PDO. The mapping must be known and fit into the sub-indices. Each entry must have at most 255 bits.
pub(super) fn is_expressible(pdo: &Pdo) -> bool {
    let in_range = match pdo.direction {
        Direction::Receive => (0x1600..0x1800).contains(&pdo.mapping_index),
        Direction::Transmit => (0x1A00..0x1C00).contains(&pdo.mapping_index),
    };
    in_range
        && !pdo.implicit
        && !pdo.entries.is_empty()
        && pdo.entries.len() <= MAX_PDO_SUBS
        && pdo.is_mapping_known()
        && pdo.entries.iter().all(|entry| entry.bits <= 0xFF)
}

fn object(pdo: &Pdo) -> Group {
    let mut group = Group::object(pdo.mapping_index, ObjectCode::Record);
    group.name = pdo.name.clone();
    let access = if pdo.fixed { Access::ReadOnly } else { Access::ReadWrite };
    let item = |sub: u8, name: CompactString, bits: u8, value: i128| {
        let mut item = Item::new(Binding::coe(pdo.mapping_index, sub));
        (item.name, item.ty, item.access) = (name, Type::Unsigned(bits), access);
        item.default = Some(Value::Int(value));
        item
    };
    let count = pdo.entries.len() as i128;
    group.items.push(item(0, CompactString::const_new("Number of entries"), 8, count));
    for (entry, sub) in pdo.entries.iter().zip(1..=254) {
        group.items.push(item(sub, name(entry, sub), 32, word(entry)));
    }
    group
}

fn name(entry: &PdoEntry, sub: u8) -> CompactString {
    match entry.name.as_str() {
        "" => compact_str::format_compact!("Mapping entry {sub}"),
        name => name.into(),
    }
}

/// Returns the value of an entry in a mapping object: `index << 16 | sub << 8 | bits` (CiA 301 7.5.2.36).
fn word(entry: &PdoEntry) -> i128 {
    i128::from(entry.index) << 16 | i128::from(entry.sub_index) << 8 | i128::from(entry.bits)
}
