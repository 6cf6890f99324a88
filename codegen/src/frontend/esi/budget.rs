//! Limits for copies that short references cause: data types in objects, vendors and files in devices.

use crate::limits;

/// Remaining number of items and bytes that may be added.
#[derive(Debug)]
pub(super) struct Budget {
    /// Items that have no element in the file.
    items: usize,
    /// Bytes of text that are copied into items.
    bytes: usize,
    pub exceeded: bool,
}

/// Cost of an addition.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    pub items: usize,
    /// Bytes of text.
    pub bytes: usize,
}

impl Cost {
    /// Returns the cost of text without items.
    pub fn text(bytes: usize) -> Self {
        Cost { items: 0, bytes }
    }
}

impl Budget {
    /// Creates the budget for a file of `length` bytes.
    pub fn new(length: usize) -> Self {
        Budget {
            items: limits::MAX_DERIVED_ITEMS,
            bytes: length.saturating_mul(limits::MAX_COPIES_PER_BYTE),
            exceeded: false,
        }
    }

    /// Extends the budget for a further file of `length` bytes.
    pub fn extend(&mut self, length: usize) {
        self.bytes = self.bytes.saturating_add(length.saturating_mul(limits::MAX_COPIES_PER_BYTE));
    }

    /// Returns whether the cost is within the budget, and subtracts it.
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
