//! COB-IDs of PDOs.

use crate::node_id::NodeId;

/// The COB-ID of a PDO (CiA 301 7.5.2.35 and 7.5.2.37). A COB-ID may depend on the node-ID.
///
/// Bits 0 to 28 are the CAN-ID. Bit 29 selects a 29-bit CAN-ID. In a TPDO, bit 30 disallows remote requests. Bit 31
/// disables the PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CobId {
    base: u32,
    add_node: bool,
}

impl CobId {
    /// Creates a COB-ID that doesn't depend on the node-ID.
    #[must_use]
    pub const fn fixed(cob_id: u32) -> Self {
        Self { base: cob_id, add_node: false }
    }

    /// Creates a COB-ID that is the sum of `base` and the node-ID.
    #[must_use]
    pub const fn from_node(base: u32) -> Self {
        Self { base, add_node: true }
    }

    /// Returns the COB-ID for a node-ID. The addition wraps around at 32 bits.
    #[must_use]
    pub const fn resolve(self, node: NodeId) -> u32 {
        if self.add_node {
            self.base.wrapping_add(node.get() as u32)
        } else {
            self.base
        }
    }

    /// Returns whether the PDO is enabled. An enabled PDO has bit 31 = 0.
    #[must_use]
    pub const fn is_valid(self) -> bool {
        self.base >> 31 == 0
    }
}

/// Bit 29 of a COB-ID: the CAN-ID has 29 bits.
#[cfg(any(feature = "canopen", feature = "std"))]
pub(crate) const EXTENDED: u32 = 1 << 29;

/// Returns whether a number is a valid CAN-ID: 11 bits, or 29 bits with bit 29 set.
#[cfg(feature = "canopen")]
pub(crate) const fn is_can_id(id: u32) -> bool {
    id <= 0x7FF || id >> 29 == 1
}

/// Returns the CAN-ID of a COB-ID, with bit 29 set if the CAN-ID has 29 bits. Returns `None` if a CAN-ID with more than
/// 11 bits is used without bit 29. Ignores bits 30 and 31, whose meaning depends on the object.
#[cfg(feature = "canopen")]
pub(crate) const fn can_id(cob_id: u32) -> Option<u32> {
    let id = cob_id & (EXTENDED | 0x1FFF_FFFF);
    if is_can_id(id) {
        Some(id)
    } else {
        None
    }
}

/// Returns whether a CAN-ID is restricted: PDOs and further SDO channels must not use it (CiA 301 7.3.5). Restricted
/// CAN-IDs are the CAN-IDs of NMT, SDO and heartbeat, and reserved CAN-IDs.
#[cfg(any(feature = "canopen", feature = "std"))]
pub(crate) const fn is_restricted(can_id: u32) -> bool {
    // CAN-IDs of 29 bits are a separate range, of which none is restricted.
    can_id & EXTENDED == 0
        && matches!(can_id, 0..=0x7F | 0x101..=0x180 | 0x581..=0x5FF | 0x601..=0x67F | 0x6E0..=0x6FF | 0x701..)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(feature = "canopen")]
    fn can_ids() {
        assert_eq!(can_id(0x4000_0185), Some(0x185));
        assert_eq!(can_id(0xA000_0185), Some(EXTENDED | 0x185));
        assert_eq!((can_id(0x800), can_id(0x2000_0800)), (None, Some(EXTENDED | 0x800)));
    }

    #[test]
    fn resolves() {
        let node = NodeId::new(5).unwrap();
        assert_eq!(CobId::from_node(0x200).resolve(node), 0x205);
        assert_eq!(CobId::fixed(0x200).resolve(node), 0x200);
        assert_eq!(CobId::from_node(u32::MAX).resolve(node), 4);
    }

    #[test]
    fn bit_31_means_unused() {
        assert!(CobId::from_node(0x200).is_valid());
        assert!(!CobId::from_node(0x8000_0200).is_valid());
    }
}
