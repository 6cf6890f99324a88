//! Values relative to the node-ID.

use lexibus_codegen::facts::cob_id::{self, CobId};
use lexibus_codegen::ir::Value;

use crate::parameter::Parameter;

/// Bits of an 11-bit COB-ID that contain the node-ID in the predefined connection set (CiA 301 7.3.3).
const NODE: i128 = 0x7F;
/// CAN-IDs, without the node-ID, of emergency messages and of PDOs 1 to 4 in the predefined connection set.
const FUNCTIONS: [i128; 9] = [0x080, 0x180, 0x200, 0x280, 0x300, 0x380, 0x400, 0x480, 0x500];
/// Bits 30 and 31, which are flags.
const FLAGS: i128 = 0xC000_0000;

/// Returns a formula with `$NODEID` if the value is relative to the node-ID of the device; otherwise, returns the value.
/// Bits 30 and 31 are ignored. A value is relative if it equals a default value that is a formula. The COB-ID of a PDO or a
/// service is also relative if it is the sum of the node-ID and one of [`FUNCTIONS`].
pub(super) fn relative(parameter: &Parameter<'_>, value: Value, node_id: u8) -> Value {
    let node = i128::from(node_id);
    let Some(number) = value.as_int() else { return value };
    let identifier = number & !FLAGS;
    let is_relative = match parameter.default() {
        Some(Value::NodeId(offset)) => identifier == (offset & !FLAGS) + node,
        _ => false,
    };
    let is_predefined = matches!(cob_id::of(parameter.item()), Some(CobId::Rpdo | CobId::Tpdo | CobId::Service))
        && identifier <= 0x7FF
        && identifier & NODE == node
        && FUNCTIONS.contains(&(identifier & !NODE));
    if is_relative || is_predefined {
        Value::NodeId(number - node)
    } else {
        value
    }
}
