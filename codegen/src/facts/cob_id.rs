//! COB-IDs: identifiers of CAN frames with flags (CiA 301, 7.5.2.5 and 7.5.2.35).

use crate::ir::{Direction, Item, Value};
use crate::number::hex;

/// Bits 31 and 30, whose meaning depends on the object.
const BIT_31: u32 = 1 << 31;
const BIT_30: u32 = 1 << 30;

/// Flag of a COB-ID with a 29-bit identifier.
const EXTENDED: u32 = 1 << 29;

/// The kind of communication object that uses a COB-ID. The kind determines the meaning of the flags.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CobId {
    /// COB-ID of an RPDO, in the objects 0x1400 to 0x15FF.
    Rpdo,
    /// COB-ID of a TPDO, in the objects 0x1800 to 0x19FF.
    Tpdo,
    /// COB-ID of SYNC, in the object 0x1005.
    Sync,
    /// COB-ID of TIME, in the object 0x1012.
    Time,
    /// COB-ID of another service, in the objects 0x1014, 0x1028 and 0x1200 to 0x12FF.
    Service,
}

impl CobId {
    /// Returns the kind for PDOs of this direction.
    pub fn of_pdo(direction: Direction) -> Self {
        match direction {
            Direction::Receive => CobId::Rpdo,
            Direction::Transmit => CobId::Tpdo,
        }
    }

    /// Returns the meanings of bits 31 and 30; `None` for a reserved bit.
    fn flags(self) -> [Option<&'static str>; 2] {
        match self {
            CobId::Rpdo => [Some("disabled"), None],
            CobId::Tpdo => [Some("disabled"), Some("no RTR")],
            CobId::Sync => [None, Some("produced by the device")],
            CobId::Time => [Some("consumed by the device"), Some("produced by the device")],
            CobId::Service => [Some("disabled"), None],
        }
    }
}

/// Returns the kind of COB-ID that an item contains, or `None` if it contains another value.
pub fn of(item: &Item) -> Option<CobId> {
    match item.object()? {
        (0x1400..=0x15FF, 1) => Some(CobId::Rpdo),
        (0x1800..=0x19FF, 1) => Some(CobId::Tpdo),
        (0x1005, 0) => Some(CobId::Sync),
        (0x1012, 0) => Some(CobId::Time),
        (0x1014, 0) | (0x1028, 1..=0x7F) | (0x1200..=0x12FF, 1 | 2) => Some(CobId::Service),
        _ => None,
    }
}

/// Returns whether a COB-ID contains a CAN identifier. The identifier is often missing if the PDO is disabled by default.
pub fn has_identifier(value: &Value) -> bool {
    const IDENTIFIER: i128 = 0x1FFF_FFFF;
    matches!(value, Value::Int(id) | Value::NodeId(id) if id & IDENTIFIER != 0)
}

/// Returns identifier and flags: `0x182, disabled`, `$NODEID+0x180, no RTR`. Returns `None` if the value is not a COB-ID.
pub fn text(value: &Value, kind: CobId) -> Option<String> {
    let (number, is_of_node) = match value {
        Value::Int(number) => (*number, false),
        Value::NodeId(number) => (*number, true),
        _ => return None,
    };
    let raw = u32::try_from(number).ok()?;
    let mask = if raw & EXTENDED != 0 { 0x1FFF_FFFF } else { 0x7FF };
    // If any other bit is 1, the value is not a COB-ID.
    if raw & !(BIT_31 | BIT_30 | EXTENDED | mask) != 0 {
        return None;
    }
    let mut text = match (is_of_node, raw & mask) {
        (true, 0) => "$NODEID".to_owned(),
        (true, identifier) => format!("$NODEID+{}", hex(identifier)),
        (false, identifier) => hex(identifier),
    };
    let [bit_31, bit_30] = kind.flags();
    let flags = [(BIT_31, bit_31, "bit 31"), (BIT_30, bit_30, "bit 30"), (EXTENDED, Some("29-bit identifier"), "")];
    for (flag, name, number) in flags {
        if raw & flag != 0 {
            text = text + ", " + name.unwrap_or(number);
        }
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_named() {
        let text = |value, kind| text(&value, kind).unwrap_or_default();
        assert_eq!(text(Value::Int(2_147_484_034), CobId::Rpdo), "0x182, disabled");
        assert_eq!(text(Value::NodeId(0x4000_0180), CobId::Tpdo), "$NODEID+0x180, no RTR");
        assert_eq!(text(Value::NodeId(0), CobId::Service), "$NODEID");
        assert_eq!(text(Value::Int(0x80), CobId::Sync), "0x80");
        assert_eq!(text(Value::Int(0x4000_0080), CobId::Sync), "0x80, produced by the device");
        assert_eq!(text(Value::Int(0x8000_0100), CobId::Time), "0x100, consumed by the device");
        assert_eq!(text(Value::Int(0xC000_0180), CobId::Rpdo), "0x180, disabled, bit 30");
        assert_eq!(text(Value::Int(0x2001_0182), CobId::Tpdo), "0x10182, 29-bit identifier");
        assert_eq!(text(Value::Int(0x1_0182), CobId::Tpdo), "", "the identifier has more than 11 bits");
        assert_eq!(text(Value::Int(-1), CobId::Tpdo), "");
        assert_eq!(text(Value::Bool(true), CobId::Tpdo), "");
    }
}
