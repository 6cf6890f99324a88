//! Initial values after power-on.

use crate::enumeration::Enumeration;
use crate::node_id::NodeId;
use crate::value::Value;

/// Initial value after power-on, according to the device description.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Initial<T> {
    /// The initial value is not in the device description.
    #[default]
    Unknown,
    /// A fixed value.
    Value(T),
    /// The node-ID of the device plus this value (`$NODEID+0x600` in an EDS; CiA 306).
    NodeId(T),
}

impl Initial<&'static [u8]> {
    /// Creates the initial value of a byte string from a byte string literal.
    #[must_use]
    pub const fn bytes(bytes: &'static [u8]) -> Self {
        Self::Value(bytes)
    }
}

impl<T: AddNodeId> Initial<T> {
    /// Returns the initial value on the device with this node-ID. Returns `None` if the value is unknown, or if the sum
    /// with the node-ID doesn't fit the type.
    #[must_use]
    pub fn resolve(&self, node: NodeId) -> Option<T> {
        match *self {
            Self::Unknown => None,
            Self::Value(value) => Some(value),
            Self::NodeId(value) => value.add_node_id(node),
        }
    }
}

/// Integers to which [`Initial::resolve`] can add a node-ID. You can implement this trait for newtypes of integers.
pub trait AddNodeId: Copy {
    /// Returns the sum of the integer and the node-ID, or `None` if the type cannot represent the sum.
    #[must_use]
    fn add_node_id(self, node: NodeId) -> Option<Self>;
}

macro_rules! add_node_id {
    ($($integer:ty)*) => {$(
        impl AddNodeId for $integer {
            fn add_node_id(self, node: NodeId) -> Option<Self> {
                // A node-ID is at most 127, so it fits every integer type.
                self.checked_add(node.get() as $integer)
            }
        }
    )*};
}

add_node_id! { u8 u16 u32 u64 i8 i16 i32 i64 }

impl<E: Enumeration> AddNodeId for E
where
    <E::Base as Value>::Native: AddNodeId,
{
    fn add_node_id(self, node: NodeId) -> Option<Self> {
        self.native().add_node_id(node).map(E::from_native)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resolves() {
        let node = NodeId::new(5).unwrap();
        assert_eq!(Initial::<u32>::Unknown.resolve(node), None);
        assert_eq!(Initial::Value(7_u32).resolve(node), Some(7));
        assert_eq!(Initial::NodeId(0x600_u32).resolve(node), Some(0x605));
        assert_eq!(Initial::NodeId(-5_i8).resolve(node), Some(0));
    }

    #[test]
    fn a_bit_field_has_it_in_its_number() {
        #[derive(Clone, Copy, Debug, PartialEq)]
        struct CobId(u32);

        impl Enumeration for CobId {
            type Base = u32;

            fn from_native(native: u32) -> Self {
                Self(native)
            }

            fn native(self) -> u32 {
                self.0
            }
        }

        let node = NodeId::new(5).unwrap();
        assert_eq!(Initial::NodeId(CobId(0x8000_0180)).resolve(node), Some(CobId(0x8000_0185)));
    }

    #[test]
    fn overflow_is_none() {
        let node = NodeId::new(127).unwrap();
        assert_eq!(Initial::NodeId(129_u8).resolve(node), None);
        assert_eq!(Initial::NodeId(1_i8).resolve(node), None);
        assert_eq!(Initial::NodeId(0_i8).resolve(node), Some(127));
    }
}
