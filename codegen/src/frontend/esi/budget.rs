//! What short references may add to a description: data types to objects, a vendor to devices, files to devices.

use crate::limits;

/// What may still be added.
#[derive(Debug)]
pub(super) struct Budget {
    /// Items that no element of their own describes.
    items: usize,
    /// Bytes of text that are copied into items.
    bytes: usize,
    pub exceeded: bool,
}

/// What an addition costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    pub items: usize,
    /// Bytes of text.
    pub bytes: usize,
}

impl Cost {
    /// Of text alone.
    pub fn text(bytes: usize) -> Self {
        Cost { items: 0, bytes }
    }
}

impl Budget {
    /// For a file of so many bytes.
    pub fn new(length: usize) -> Self {
        Budget {
            items: limits::MAX_DERIVED_ITEMS,
            bytes: length.saturating_mul(limits::MAX_COPIES_PER_BYTE),
            exceeded: false,
        }
    }

    /// Adds what a further file of so many bytes allows.
    pub fn extend(&mut self, length: usize) {
        self.bytes = self.bytes.saturating_add(length.saturating_mul(limits::MAX_COPIES_PER_BYTE));
    }

    /// Whether so much may still be added.
    pub fn take(&mut self, cost: Cost) -> bool {
        match (self.items.checked_sub(cost.items), self.bytes.checked_sub(cost.bytes)) {
            (Some(items), Some(bytes)) if !self.exceeded => {
                (self.items, self.bytes) = (items, bytes);
                true
            }
            _ => false,
        }
    }
}
