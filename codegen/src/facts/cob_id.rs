//! The identifier of a CAN frame and its flags (CiA 301, 7.5.2.5 and 7.5.2.35).

use crate::ir::{Item, Value};

/// The object does not exist, or is not used.
const INVALID: u32 = 1 << 31;

/// Of a PDO: no remote request is allowed. Of SYNC: the device produces it.
const BIT_30: u32 = 1 << 30;

/// The frame has an identifier of 29 bits.
const EXTENDED: u32 = 1 << 29;

/// What bit 30 means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// 0x1400 to 0x15FF, 0x1800 to 0x19FF.
    Pdo,
    /// 0x1005, 0x1012.
    Producer,
    /// 0x1014, 0x1200 to 0x12FF.
    Other,
}

/// What sort of COB-ID an item is; `None` if it is none.
pub(crate) fn kind(item: &Item) -> Option<Kind> {
    match item.object()? {
        (0x1400..=0x15FF | 0x1800..=0x19FF, 1) => Some(Kind::Pdo),
        (0x1005 | 0x1012, 0) => Some(Kind::Producer),
        (0x1014, 0) | (0x1200..=0x12FF, 1 | 2) => Some(Kind::Other),
        _ => None,
    }
}

/// `0x182, disabled`, `$NODEID+0x180, no RTR`: identifier and flags. `None` if the value is no COB-ID.
pub(crate) fn text(value: &Value, kind: Kind) -> Option<String> {
    let (number, is_of_node) = match value {
        Value::Int(number) => (*number, false),
        Value::NodeId(number) => (*number, true),
        _ => return None,
    };
    let raw = u32::try_from(number).ok()?;
    let mask = if raw & EXTENDED != 0 { 0x1FFF_FFFF } else { 0x7FF };
    // Further bits make it no identifier.
    if raw & !(INVALID | BIT_30 | EXTENDED | mask) != 0 {
        return None;
    }
    let mut text = match (is_of_node, raw & mask) {
        (true, 0) => "$NODEID".to_owned(),
        (true, identifier) => format!("$NODEID+0x{identifier:X}"),
        (false, identifier) => format!("0x{identifier:X}"),
    };
    let bit_30 = match kind {
        Kind::Pdo => "no RTR",
        Kind::Producer => "produced by the device",
        Kind::Other => "bit 30",
    };
    for (flag, name) in [(INVALID, "disabled"), (BIT_30, bit_30), (EXTENDED, "29-bit identifier")] {
        if raw & flag != 0 {
            text = text + ", " + name;
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
        assert_eq!(text(Value::Int(2_147_484_034), Kind::Pdo), "0x182, disabled");
        assert_eq!(text(Value::NodeId(0x4000_0180), Kind::Pdo), "$NODEID+0x180, no RTR");
        assert_eq!(text(Value::NodeId(0), Kind::Other), "$NODEID");
        assert_eq!(text(Value::Int(0x80), Kind::Producer), "0x80");
        assert_eq!(text(Value::Int(0x4000_0080), Kind::Producer), "0x80, produced by the device");
        assert_eq!(text(Value::Int(0x2001_0182), Kind::Pdo), "0x10182, 29-bit identifier");
        assert_eq!(text(Value::Int(0x1_0182), Kind::Pdo), "", "no identifier of 11 bits");
        assert_eq!(text(Value::Int(-1), Kind::Pdo), "");
        assert_eq!(text(Value::Bool(true), Kind::Pdo), "");
    }
}
