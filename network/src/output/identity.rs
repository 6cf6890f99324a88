//! Identity of a node as a master compares it at boot.

use crate::model::NetworkNode;

/// Returns vendor-ID, product code, revision number and serial number that the master expects; 0 = not checked. A number is
/// not checked if the node lacks its sub-index of 0x1018.
pub(super) fn checked(node: &NetworkNode) -> [u32; 4] {
    let mut identity = node.identity;
    for (number, sub_index) in identity.iter_mut().zip(1..) {
        if node.item((0x1018, sub_index)).is_none() {
            *number = 0;
        }
    }
    identity
}
