//! Objects of implicit PDOs: PDOs that an EDS or DCF counts but does not describe (CiA 306, CompactPDO).
//!
//! For example, a device with CompactPDO, NrOfRXPDO = 4 and two described RPDOs has two implicit RPDOs. The objects of implicit
//! PDOs have the line number 0, because the file does not contain these objects.

use crate::ir::{
    Access, Binding, CompactString, Device, Fact, FactOrigins, Group, Item, ObjectCode, Rule, Type, Value,
};
use crate::limits;

/// Number of mapping entries of an implicit PDO: one for each byte of a CAN frame.
const MAPPING_ENTRIES: u8 = 8;

pub(super) fn run(device: &mut Device) {
    let Some(canopen) = &device.canopen else { return };
    if canopen.compact_pdo == 0 {
        return;
    }
    let mask = canopen.compact_pdo;
    let counts = [(canopen.rx_pdos, 0x1400), (canopen.tx_pdos, 0x1800)];
    let mut implicit = Vec::new();
    for (count, first) in counts {
        let count = count.unwrap_or(0).min(limits::MAX_IMPLICIT_PDOS);
        let described = (0..512).filter(|number| device.object(first + number).is_some()).count();
        let missing = usize::from(count).saturating_sub(described);
        for number in (0..512).filter(|number| device.object(first + number).is_none()).take(missing) {
            implicit.push(communication(first + number, number, mask, first == 0x1400));
            if device.object(first + 0x200 + number).is_none() {
                implicit.push(mapping(first + 0x200 + number));
            }
        }
    }
    if !implicit.is_empty() {
        device.groups.append(&mut implicit);
        device.groups.sort_by_key(Group::index);
    }
}

fn object(index: u16, name: &'static str) -> Group {
    let mut group = Group::object(index, ObjectCode::Record);
    group.name = CompactString::const_new(name);
    group.origins = FactOrigins::by_rule(&[Fact::Name], Rule::AnnouncedPdo);
    group
}

fn item(index: u16, sub: u8, name: CompactString, bits: u8, default: Option<Value>) -> Item {
    let mut item = Item::new(Binding::canopen(index, sub));
    item.name = name;
    item.ty = Type::Unsigned(bits);
    item.access = if sub == 0 { Access::ReadOnly } else { Access::ReadWrite };
    item.default = default;
    item.origins = FactOrigins::by_rule(&[Fact::Name, Fact::Type, Fact::Access, Fact::Default], Rule::AnnouncedPdo);
    item
}

/// Names and widths of the sub-indices of a communication object, starting with sub-index 1 (CiA 301 7.5.2.35).
const COMMUNICATION: [(&str, u8); 6] = [
    ("COB-ID", 32),
    ("Transmission type", 8),
    ("Inhibit time", 16),
    ("Compatibility entry", 8),
    ("Event timer", 16),
    ("SYNC start value", 8),
];

fn communication(index: u16, number: u16, mask: u8, receive: bool) -> Group {
    let mut group =
        object(index, if receive { "RPDO communication parameter" } else { "TPDO communication parameter" });
    let subs = (1..=6u8).filter(|sub| mask >> (sub - 1) & 1 == 1);
    let highest = subs.clone().next_back().unwrap_or(0);
    let count = Value::Int(i128::from(highest));
    group.items.push(item(index, 0, CompactString::const_new("NrOfObjects"), 8, Some(count)));
    for sub in subs {
        let (name, bits) = COMMUNICATION[usize::from(sub) - 1];
        let default = match sub {
            1 => Some(default_cob_id(number, receive)),
            2 => Some(Value::Int(255)),
            _ => None,
        };
        group.items.push(item(index, sub, CompactString::const_new(name), bits, default));
    }
    group
}

/// Returns the default COB-ID of a PDO. The first four PDOs of a direction have the CAN identifiers of the pre-defined connection
/// set. The other PDOs are disabled (bit 31) until they are configured (CiA 301 7.3.5).
fn default_cob_id(number: u16, receive: bool) -> Value {
    let first = if receive { 0x200 } else { 0x180 };
    match number {
        0..=3 => Value::NodeId(i128::from(first + 0x100 * number)),
        _ => Value::Int(0x8000_0000),
    }
}

fn mapping(index: u16) -> Group {
    let mut group = object(index, if index < 0x1800 { "RPDO mapping parameter" } else { "TPDO mapping parameter" });
    let mut count = item(index, 0, CompactString::const_new("NrOfObjects"), 8, Some(Value::Int(0)));
    count.access = Access::ReadWrite;
    group.items.push(count);
    for sub in 1..=MAPPING_ENTRIES {
        let name = compact_str::format_compact!("Mapping entry {sub}");
        group.items.push(item(index, sub, name, 32, Some(Value::Int(0))));
    }
    group
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::CanOpenSettings;

    #[test]
    fn counted_pdos_get_objects() {
        let canopen = CanOpenSettings { compact_pdo: 0x17, rx_pdos: Some(5), tx_pdos: Some(1), ..Default::default() };
        let mut device = Device { canopen: Some(Box::new(canopen)), ..Device::default() };
        device.groups.push(Group::object(0x1401, ObjectCode::Record));
        run(&mut device);
        let indices: Vec<_> = device.groups.iter().filter_map(Group::index).collect();
        assert_eq!(indices, [0x1400, 0x1401, 0x1402, 0x1403, 0x1404, 0x1600, 0x1602, 0x1603, 0x1604, 0x1800, 0x1A00]);
        let subs: Vec<_> = device.object(0x1400).unwrap().items.iter().filter_map(Item::object).collect();
        assert_eq!(subs, [(0x1400, 0), (0x1400, 1), (0x1400, 2), (0x1400, 3), (0x1400, 5)]);
        assert_eq!(device.entry(0x1400, 0).unwrap().default, Some(Value::Int(5)));
        assert_eq!(device.entry(0x1402, 1).unwrap().default, Some(Value::NodeId(0x400)));
        assert_eq!(device.entry(0x1404, 1).unwrap().default, Some(Value::Int(0x8000_0000)));
    }
}
