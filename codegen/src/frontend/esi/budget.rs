//! Limits the number of items and text bytes that are copied because of references, such as those to data types and files.
//! Without this limit, a small file could become a very large description, because a short reference can copy a large
//! definition.

use crate::limits;

/// Remaining number of items and text bytes that references may add.
#[derive(Debug)]
pub(super) struct Budget {
    /// Remaining number of items that may be created without an element in the file.
    items: usize,
    /// Remaining number of text bytes that may be copied into items.
    bytes: usize,
    pub exceeded: bool,
}

/// Number of items and text bytes that a copy adds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    pub items: usize,
    /// Number of text bytes.
    pub bytes: usize,
}

impl Cost {
    /// Returns the cost of `bytes` bytes of text without an item.
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

    /// Increases the budget for a further file of `length` bytes.
    pub fn extend(&mut self, length: usize) {
        self.bytes = self.bytes.saturating_add(length.saturating_mul(limits::MAX_COPIES_PER_BYTE));
    }

    /// Subtracts `cost` from the budget. Returns false if the budget is too small or was exceeded before.
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
